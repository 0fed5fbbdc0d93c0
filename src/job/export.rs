//! Files of runs, made in the background: the same code and the same names as those of the command line.

use super::pin::Found;
use super::task::Task;
use super::work::{Posed, Work};
use crate::analysis::compare::ComparedRun;
use crate::analysis::torque::TorqueCurves;
use crate::control::{Cancel, Progress};
use crate::export::animation::Options;
use crate::export::figure::Format;
use crate::export::files::{self, Control, ExportError, Solved};
use crate::export::json::Summary;
use crate::fidelity::Fidelity;
use crate::solution::{Solution, settled};
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Formats of the figures beside data, as without `--figures`.
pub const BESIDE_DATA: &[Format] = if cfg!(feature = "render") { &[Format::Svg, Format::Png] } else { Format::WRITTEN };

/// A run, with all that its files say of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Ran {
    /// The scene.
    pub posed: Posed,
    /// What it was solved at.
    pub fidelity: Fidelity,
    /// What came of it.
    pub solution: Solution,
    /// Wall time of the solve \[s\].
    pub wall_s: f64,
    /// Its rounds.
    pub history: Vec<Progress>,
}

/// Which files of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum OfRun {
    /// All, in a folder.
    Data,
    /// Its figures, in a folder.
    Figures,
    /// Its fields, as an archive.
    Fields,
    /// Its cycle in moving pictures.
    Animation,
}

/// Which files of several runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum OfRuns {
    /// A report.
    Report,
    /// What compares them, in a folder; `all`: with the parameters that do not differ.
    Comparison {
        /// Whether those are listed, too.
        all: bool,
    },
}

/// Files to be made, as they are carried to where that is done.
#[derive(Debug, Serialize, Deserialize)]
pub enum Files {
    /// Of one run.
    Run(OfRun, PathBuf, Box<Ran>),
    /// Of several.
    Runs(OfRuns, PathBuf, Vec<Found>),
}

impl Files {
    /// Files of several runs.
    pub fn of(files: OfRuns, path: PathBuf, runs: &[ComparedRun]) -> Self {
        Self::Runs(files, path, runs.iter().map(Found::of).collect())
    }
}

/// The work of an export: it tells how many pictures are drawn, of how many, and returns what was written, or why nothing
/// was; nothing at all if it was cancelled.
pub type ExportTask = Task<(usize, usize), Result<Vec<PathBuf>, Option<String>>>;

impl Work for Files {
    const NAME: &'static str = "files";
    type Message = (usize, usize);
    type Found = Result<Vec<PathBuf>, Option<String>>;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn((usize, usize)) + Sync)) -> Self::Found {
        let control = Control { cancel, drawn: &|drawn, all| tell((drawn, all)) };
        let written = match self {
            Self::Run(what, path, run) => of_run(what, &path, &run, &control),
            Self::Runs(what, path, runs) => {
                let runs: Vec<ComparedRun> = runs.into_iter().map(Found::into_run).collect();
                match what {
                    OfRuns::Report => files::html(&path, &runs, &coarsest(&runs), &control),
                    OfRuns::Comparison { all } => {
                        files::comparison(&path, &runs, (&coarsest(&runs), all, &[]), BESIDE_DATA, &control)
                    }
                }
            }
        };
        written.map_err(reason)
    }

    fn ended() -> Self::Found {
        Err(None)
    }
}

/// Why nothing was written; nothing if it was cancelled.
pub fn reason(error: ExportError) -> Option<String> {
    match error {
        ExportError::Cancelled => None,
        error => Some(error.to_string()),
    }
}

fn of_run(what: OfRun, path: &std::path::Path, run: &Ran, control: &Control<'_>) -> Result<Vec<PathBuf>, ExportError> {
    let Ran { posed, fidelity, solution, wall_s, history } = run;
    let problem = &*settled(&posed.problem, &solution.outcome);
    let solved = Solved { scene: &posed.scene, problem, solution, history, torque: None };
    let merit = || TorqueCurves::of_solve(problem, *fidelity, solution, control.cancel);
    match what {
        OfRun::Data => {
            let mut summary = Summary::new(problem, solution, *wall_s, &[]);
            summary.add_torque(merit());
            let solved = Solved { torque: summary.torque.as_ref(), ..solved };
            files::solve(path, &solved, &summary, BESIDE_DATA, control)
        }
        OfRun::Figures => {
            // Without it the other figures are still worth having.
            let merit = merit().ok().flatten();
            files::solve_figures(path, &Solved { torque: merit.as_ref(), ..solved }, Format::WRITTEN, control)
        }
        OfRun::Fields => files::fields(path, &solved),
        OfRun::Animation => files::animation(path, &solved, &Options::default(), control),
    }
}

/// Settings of runs, as a report names them: at the coarsest of their fidelities.
fn coarsest(runs: &[ComparedRun]) -> Settings {
    let known = runs.iter().filter_map(|run| run.solved.as_ref().ok()?.model.fidelity.parse::<Fidelity>().ok());
    Settings { fidelity: known.min().unwrap_or_default(), ..Settings::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;
    use crate::scene::presets;
    use crate::solve::solve;
    use std::collections::BTreeMap;

    fn read(folder: &std::path::Path) -> BTreeMap<std::ffi::OsString, Vec<u8>> {
        let files = std::fs::read_dir(folder).unwrap().map(Result::unwrap);
        files.map(|file| (file.file_name(), std::fs::read(file.path()).unwrap())).collect()
    }

    #[test]
    fn files_that_are_made_elsewhere_are_the_same() {
        let scene = presets::find("floating-disc").unwrap();
        let posed = Posed { problem: Problem::new(&scene).unwrap(), scene };
        let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
        let solution = solve(&posed.problem, &settings, &mut (), &Cancel::new()).unwrap();
        // As the window has it.
        let problem = settled(&posed.problem, &solution.outcome).into_owned();
        let posed = Posed { problem, ..posed };
        let ran = Ran { posed, fidelity: Fidelity::Draft, solution, wall_s: 0.5, history: Vec::new() };
        let here = tempfile::tempdir().unwrap();
        let [one, other] = ["one", "other"].map(|name| here.path().join(name));
        let write = |files: Files| files.run(&Cancel::new(), &|_| ()).unwrap();
        write(Files::Run(OfRun::Data, one.clone(), Box::new(ran.clone())));
        let files = Files::Run(OfRun::Data, other.clone(), Box::new(ran));
        write(postcard::from_bytes(&postcard::to_stdvec(&files).unwrap()).unwrap());
        let (one, other) = (read(&one), read(&other));
        assert!(one.len() > 8, "{:?}", one.keys());
        for (name, bytes) in &one {
            assert!(other[name] == *bytes, "{name:?}");
        }
    }
}
