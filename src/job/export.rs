//! Files of runs, made in the background: the same code and the same names as those of the command line.

use super::fit;
use super::pin::Found;
use super::task::Task;
use super::work::{Posed, Work, shared};
use crate::analysis::compare::ComparedRun;
use crate::analysis::quantity::Quantity;
use crate::analysis::sensitivity::{MonteCarlo, Sensitivity, Uncertainties};
use crate::analysis::sweep::{Row, Sweep};
use crate::analysis::torque::TorqueCurves;
use crate::analysis::tradeoff::Tradeoff;
use crate::atomic::write_file;
use crate::control::{Cancel, Progress};
use crate::export::animation::Options;
use crate::export::figure::{self, Format};
use crate::export::files::{self, Control, ExportError, Solved};
use crate::export::json::Summary;
use crate::export::sweep::{figure_of, write_csv};
use crate::export::{csv, sensitivity, tradeoff};
use crate::fidelity::Fidelity;
use crate::lessons::record::{self, Record};
use crate::solution::{Solution, settled};
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

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

/// Which files of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum OfSweep {
    /// All, in a folder.
    Data,
    /// Its table.
    Table,
    /// A figure of this number.
    Figure(Quantity),
}

/// Which file of the measurement of error against time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum OfTradeoff {
    /// The table.
    Table,
    /// The figure, with these settings marked.
    Figure(Vec<usize>),
}

/// A picture of the window.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Picture {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Red, green and blue of each pixel, row by row from the top.
    #[serde(with = "shared")]
    pub rgb: Arc<Vec<u8>>,
}

/// What files are made of.
#[derive(Debug, Serialize, Deserialize)]
pub enum Content {
    /// One run.
    Run(OfRun, Box<Ran>),
    /// Several runs.
    Runs(OfRuns, Vec<Found>),
    /// A sweep, and its rows.
    Sweep(OfSweep, #[serde(with = "shared")] Arc<Sweep>, Vec<Row>),
    /// Sensitivities at a fidelity, how uncertain keys are, and random scenes.
    Sensitivity(#[serde(with = "shared")] Arc<Sensitivity>, Uncertainties, Option<MonteCarlo>, Fidelity),
    /// A fit, or an optimum, of the scene of this name; and the scene that was found.
    Fit(String, Box<Posed>, #[serde(with = "shared")] Arc<fit::Found>),
    /// Error against time of the scene of this name.
    Tradeoff(OfTradeoff, String, Tradeoff),
    /// What a student did.
    Answers(Vec<Record>),
    /// The window.
    Picture(Picture),
}

impl Content {
    /// Several runs.
    pub fn of_runs(files: OfRuns, runs: &[ComparedRun]) -> Self {
        Self::Runs(files, runs.iter().map(Found::of).collect())
    }
}

/// Files to be made, as they are carried to where that is done.
#[derive(Debug, Serialize, Deserialize)]
pub struct Files {
    /// The file, or the folder.
    pub path: PathBuf,
    /// What is in them.
    pub content: Content,
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
        write(&self.path, self.content, &control).map_err(|error| match error {
            ExportError::Cancelled => None,
            error => Some(error.to_string()),
        })
    }

    fn ended() -> Self::Found {
        Err(None)
    }
}

fn write(path: &Path, content: Content, control: &Control<'_>) -> Result<Vec<PathBuf>, ExportError> {
    Ok(match content {
        Content::Run(what, run) => of_run(what, path, &run, control)?,
        Content::Runs(what, runs) => {
            let runs: Vec<ComparedRun> = runs.into_iter().map(Found::into_run).collect();
            match what {
                OfRuns::Report => files::html(path, &runs, &coarsest(&runs), control)?,
                OfRuns::Comparison { all } => {
                    files::comparison(path, &runs, (&coarsest(&runs), all, &[]), BESIDE_DATA, control)?
                }
            }
        }
        Content::Sweep(OfSweep::Data, sweep, rows) => files::swept(path, &sweep, &rows, &[], BESIDE_DATA)?,
        Content::Sweep(OfSweep::Table, sweep, rows) => {
            write_file(path, |out| write_csv(&sweep, &rows, out))?;
            vec![path.to_owned()]
        }
        Content::Sweep(OfSweep::Figure(quantity), sweep, rows) => {
            figure::write(&figure_of(&sweep, &rows, quantity), path)?;
            vec![path.to_owned()]
        }
        Content::Sensitivity(sensitivity, uncertainties, carlo, fidelity) => {
            let (uncertainties, carlo) = (&uncertainties, carlo.as_ref());
            let found = sensitivity::Found { sensitivity: &sensitivity, uncertainties, carlo };
            files::sensitivity(path, &found, &fidelity.to_string(), &[], BESIDE_DATA)?
        }
        Content::Fit(name, posed, found) => {
            let of = (name.as_str(), &posed.problem);
            match &*found {
                fit::Found::Fit(measured, fitted) => files::fitted(path, of, (fitted, measured), &[], BESIDE_DATA)?,
                fit::Found::Optimum(optimum) => files::optimum(path, of, optimum, &[], BESIDE_DATA)?,
            }
        }
        Content::Tradeoff(OfTradeoff::Table, _, tradeoff) => {
            write_file(path, |out| csv::rows(tradeoff::settings(&tradeoff), out))?;
            vec![path.to_owned()]
        }
        Content::Tradeoff(OfTradeoff::Figure(chosen), name, tradeoff) => {
            figure::write(&tradeoff::figure(&name, &tradeoff, &chosen), path)?;
            vec![path.to_owned()]
        }
        Content::Answers(records) => {
            let lines = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("jsonl"));
            write_file(path, |out| match lines {
                true => out.write_all(record::statements(&record::student(path), &records).as_bytes()),
                false => csv::rows(&records, out),
            })?;
            vec![path.to_owned()]
        }
        Content::Picture(Picture { size, rgb }) => files::picture(path, size, &rgb)?,
    })
}

fn of_run(what: OfRun, path: &Path, run: &Ran, control: &Control<'_>) -> Result<Vec<PathBuf>, ExportError> {
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
        let posed = Posed { problem: Problem::try_from(&scene).unwrap(), scene };
        let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
        let solution = solve(&posed.problem, &settings, &mut (), &Cancel::new()).unwrap();
        // As the window has it.
        let problem = settled(&posed.problem, &solution.outcome).into_owned();
        let posed = Posed { problem, ..posed };
        let ran = Ran { posed, fidelity: Fidelity::Draft, solution, wall_s: 0.5, history: Vec::new() };
        let here = tempfile::tempdir().unwrap();
        let [one, other] = ["one", "other"].map(|name| here.path().join(name));
        let write = |files: Files| files.run(&Cancel::new(), &|_| ()).unwrap();
        let files =
            |path: &Path| Files { path: path.to_owned(), content: Content::Run(OfRun::Data, Box::new(ran.clone())) };
        write(files(&one));
        let files = files(&other);
        write(postcard::from_bytes(&postcard::to_stdvec(&files).unwrap()).unwrap());
        let (one, other) = (read(&one), read(&other));
        assert!(one.len() > 8, "{:?}", one.keys());
        for (name, bytes) in &one {
            assert!(other[name] == *bytes, "{name:?}");
        }
    }
}
