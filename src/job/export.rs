//! Files, made in the background: the same code and the same names as those of the command line.

use super::work::{Posed, Work};
use super::{SolvedScene, fit};
use crate::analysis::compare::ComparedRun;
use crate::analysis::quantity::Quantity;
use crate::analysis::sensitivity::{MonteCarlo, Sensitivity, Uncertainties};
use crate::analysis::sweep::{Sweep, SweepRow};
use crate::analysis::torque::TorqueCurves;
use crate::analysis::tradeoff::Tradeoff;
use crate::control::Cancel;
use crate::export::animation::Options;
use crate::export::figure::{self, Figure, Format};
use crate::export::files::{self, Control, ExportError, Folder, Solved};
use crate::export::json::Summary;
use crate::export::sweep::{self as swept, primary, write_csv};
use crate::export::{csv, sensitivity, tradeoff};
use crate::fall::{self, Fall};
use crate::fidelity::Fidelity;
use crate::lessons::record::{self, Record};
use crate::motor::MotorError;
use crate::solve::Settings;
use crate::startup::{self, Startup};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Formats of the figures beside data: those of the command line without `--figures`.
pub const BESIDE_DATA: &[Format] = if cfg!(feature = "render") { &[Format::Svg, Format::Png] } else { Format::WRITTEN };

/// A picture of the window.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Picture {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Red, green and blue of each pixel, row by row from the top.
    pub rgb: Arc<Vec<u8>>,
}

/// The content of the files.
#[derive(Debug, Serialize, Deserialize)]
pub enum Content {
    /// All of a run, in a folder.
    Run(Box<SolvedScene>),
    /// The figures of a run, in a folder.
    Figures(Box<SolvedScene>),
    /// The fields of a run, as an archive.
    Fields(Box<SolvedScene>),
    /// The cycle of a run as an animation.
    Animation(Box<SolvedScene>),
    /// A report of one run or several.
    Report(Vec<ComparedRun>),
    /// The files of a comparison, in a folder; whether parameters that do not differ are listed, too.
    Comparison(Vec<ComparedRun>, bool),
    /// All of a sweep and its rows, in a folder.
    Sweep(Arc<Sweep>, Vec<SweepRow>),
    /// The table of a sweep.
    SweepTable(Arc<Sweep>, Vec<SweepRow>),
    /// The figure of a result of a sweep.
    SweepFigure(Arc<Sweep>, Vec<SweepRow>, Quantity),
    /// Sensitivities, the uncertainties of keys, and random scenes.
    Sensitivity(Arc<Sensitivity>, Uncertainties, Option<MonteCarlo>),
    /// A fit or an optimum: the name of the scene, the scene that was found, and how it was found.
    Fit(String, Box<Posed>, Arc<fit::FitResult>),
    /// A start-up: its scene, how it was computed, how it ended, and its cycles without fields.
    Startup(Box<Posed>, startup::Settings, Box<Startup>, Vec<startup::Cycle>),
    /// A plate that was dropped: its scene, the fidelity, how it ended, and its cycles.
    Fall(Box<Posed>, Fidelity, Fall, Vec<fall::Cycle>),
    /// The table of error against time.
    TradeoffTable(Tradeoff),
    /// The figure of error against time of the scene of this name, with these settings marked.
    TradeoffFigure(String, Tradeoff, Vec<usize>),
    /// The record of what a student did.
    Answers(Vec<Record>),
    /// A picture of the window.
    Picture(Picture),
}

/// Files to be made, as they are sent to the thread or worker that makes them.
#[derive(Debug, Serialize, Deserialize)]
pub struct Files {
    /// The file, or the folder.
    pub path: PathBuf,
    /// Content of the files.
    pub content: Content,
}

impl Work for Files {
    const NAME: &'static str = "files";
    /// Pictures of an animation drawn so far, and their total.
    type Message = (usize, usize);
    /// The paths of the files that were written.
    type Output = Vec<PathBuf>;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn((usize, usize)) + Sync)) -> Result<Option<Self::Output>, String> {
        let control = Control { cancel, drawn: &|drawn, all| tell((drawn, all)) };
        match write(&self.path, self.content, &control) {
            Ok(paths) => Ok(Some(paths)),
            Err(ExportError::Cancelled) => Ok(None),
            Err(error) => Err(error.to_string()),
        }
    }
}

/// Writes the files of `content` into a folder, or to the file `path`. Returns the paths of what was written.
fn write(path: &Path, content: Content, control: &Control<'_>) -> Result<Vec<PathBuf>, ExportError> {
    let figure = |drawn: &Figure| figure::write(drawn, path).map(|()| vec![path.to_owned()]);
    let out = folder(path, BESIDE_DATA);
    Ok(match content {
        Content::Run(run) => {
            let mut summary = Summary::new(&run.problem, &run.solution, run.wall_s, &[]);
            summary.add_torque(torque(&run, control));
            files::solve(&out, &solved(&run), &summary, control)?
        }
        Content::Figures(run) => {
            // If torque cannot be computed, the other figures are still worth having.
            let torque = torque(&run, control).ok().flatten();
            files::solve_figures(&folder(path, Format::WRITTEN), &solved(&run), torque.as_ref(), control)?
        }
        Content::Fields(run) => files::fields(path, &solved(&run))?,
        Content::Animation(run) => files::animation(path, &solved(&run), &Options::default(), control)?,
        Content::Report(runs) => files::html(path, &runs, &coarsest(&runs), control)?,
        Content::Comparison(runs, all) => files::comparison(&out, &runs, &coarsest(&runs), all, control)?,
        Content::Sweep(sweep, rows) => files::swept(&out, &sweep, &rows, primary(&sweep))?,
        Content::SweepTable(sweep, rows) => files::alone(path, |out| write_csv(&sweep, &rows, out))?,
        Content::SweepFigure(sweep, rows, quantity) => figure(&swept::figure(&sweep, &rows, quantity))?,
        Content::Sensitivity(sensitivity, uncertainties, carlo) => {
            let (uncertainties, carlo) = (&uncertainties, carlo.as_ref());
            let found = sensitivity::SensitivityStudy { sensitivity: &sensitivity, uncertainties, carlo };
            files::sensitivity(&out, &found)?
        }
        Content::Startup(posed, settings, ended, cycles) => {
            files::startup(&out, (&posed.scene, &posed.problem), &settings, (&ended, &cycles), f64::NAN)?
        }
        Content::Fall(posed, fidelity, ended, cycles) => {
            files::fall(&out, (&posed.scene, &posed.problem), fidelity, (&ended, &cycles), f64::NAN)?
        }
        Content::Fit(name, posed, found) => match &*found {
            fit::FitResult::Fit(measured, fitted) => files::fitted(&out, &posed.problem, &name, fitted, measured)?,
            fit::FitResult::Optimum(found) => files::optimum(&out, &posed.problem, &name, found)?,
        },
        Content::TradeoffTable(tradeoff) => {
            files::alone(path, |out| csv::rows_of_ours(tradeoff::settings(&tradeoff), out))?
        }
        Content::TradeoffFigure(name, tradeoff, chosen) => figure(&tradeoff::figure(&name, &tradeoff, &chosen))?,
        Content::Answers(records) => {
            let lines = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("jsonl"));
            files::alone(path, |out| match lines {
                true => out.write_all(record::statements(&record::student(path), &records).as_bytes()),
                false => csv::rows(&records, out),
            })?
        }
        Content::Picture(Picture { size, rgb }) => files::picture(path, size, Arc::unwrap_or_clone(rgb))?,
    })
}

fn solved(run: &SolvedScene) -> Solved<'_> {
    let SolvedScene { scene, problem, solution, history, .. } = run;
    Solved { scene, problem, solution, history }
}

fn torque(run: &SolvedScene, control: &Control<'_>) -> Result<Option<TorqueCurves>, MotorError> {
    TorqueCurves::of(&run.problem, run.fidelity, &run.solution, control.cancel)
}

/// A folder for what the window writes, with figures in these formats.
fn folder<'a>(path: &'a Path, formats: &[Format]) -> Folder<'a> {
    Folder { path, command: &[], formats: formats.to_vec(), vtk: false }
}

/// Settings of runs, as a report names them: at the coarsest of their fidelities.
fn coarsest(runs: &[ComparedRun]) -> Settings {
    let known = runs.iter().filter_map(|run| run.solved.as_ref().ok()?.model.fidelity.parse::<Fidelity>().ok());
    Settings { fidelity: known.min().unwrap_or_default(), ..Settings::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::fit::{Goal, optimise};
    use crate::analysis::tradeoff::{Effort, candidates, measure};
    use crate::job::work::tests::{carried, draft, posed};
    use crate::problem::Problem;
    use crate::scene::presets;
    use crate::solve::solve;
    use std::collections::BTreeMap;

    fn read(path: &Path) -> BTreeMap<std::ffi::OsString, Vec<u8>> {
        let name = |path: &Path| path.file_name().unwrap().to_owned();
        if path.is_file() {
            return [(name(path), std::fs::read(path).unwrap())].into();
        }
        let files = std::fs::read_dir(path).unwrap().map(|file| file.unwrap().path());
        files.map(|file| (name(&file), std::fs::read(&file).unwrap())).collect()
    }

    /// Makes the files of this name here and elsewhere, and compares them. Returns how many there are.
    fn made_twice(name: &str, content: &dyn Fn() -> Content) -> usize {
        let folder = tempfile::tempdir().unwrap();
        let made = |place: &str, sent: bool| {
            let path = folder.path().join(place).join(name);
            std::fs::create_dir(path.parent().unwrap()).unwrap();
            let files = Files { path: path.clone(), content: content() };
            let files = if sent { carried(&files) } else { files };
            files.run(&Cancel::new(), &|_| ()).unwrap();
            read(&path)
        };
        let (here, there) = (made("here", false), made("there", true));
        for (file, bytes) in &here {
            assert!(there[file] == *bytes, "{name}: {file:?}");
        }
        assert_eq!(here.len(), there.len(), "{name}");
        here.len()
    }

    #[test]
    fn files_of_a_run_that_are_made_elsewhere_are_the_same() {
        let posed = posed("floating-disc");
        let solution = solve(&posed.problem, &draft(), &mut (), &Cancel::new()).unwrap();
        let timed = (solution, 0.5);
        let run = SolvedScene::of(1, posed.clone(), Fidelity::Draft, timed, Vec::new());
        assert!(made_twice("run", &|| Content::Run(Box::new(run.clone()))) > 8);
        let runs = [ComparedRun::new("a".to_owned(), run.scene, posed.problem, Ok(run.solution))];
        assert!(made_twice("report.html", &|| Content::Report(runs.to_vec())) == 1);
    }

    #[test]
    fn files_of_tabs_that_are_made_elsewhere_are_the_same() {
        let scene = presets::find("plate-crossover").unwrap();
        let problem = Problem::try_from(&scene).unwrap();
        let cancel = Cancel::new();

        let vary = "plate.amplitude_um=0.1:0.5:3".parse().unwrap();
        let swept = Arc::new(Sweep::new(&scene, &[vary], &draft()).unwrap());
        let rows = swept.run(&[], &cancel, &|_| ());
        let swept = || (Arc::clone(&swept), rows.clone());
        assert!(made_twice("sweep", &|| Content::Sweep(swept().0, swept().1)) > 3);
        made_twice("sweep.csv", &|| Content::SweepTable(swept().0, swept().1));
        made_twice("sweep.svg", &|| Content::SweepFigure(swept().0, swept().1, Quantity::LoadRatio));

        let key = "plate.amplitude_um";
        let found = Sensitivity::of(&scene, &[key], &draft(), &cancel, &|_: usize| ()).unwrap().unwrap();
        let uncertainties = Uncertainties::new(&scene, &[(key, "10%".parse().unwrap())]).unwrap();
        let carlo = found.monte_carlo(&uncertainties, 5, 1, &cancel, &|| ()).unwrap();
        let found = Arc::new(found);
        let content = || Content::Sensitivity(Arc::clone(&found), uncertainties.clone(), Some(carlo.clone()));
        assert!(made_twice("sensitivity", &content) > 4);

        let bounds = ["plate.amplitude_um=0.1:0.5".parse().unwrap()];
        let goal = Goal::new(&scene, "mean_load_ratio", true, &[]).unwrap();
        let optimum = optimise(&scene, &bounds, &goal, &draft(), (1, &cancel, &|_, _| ())).unwrap().unwrap();
        let posed = Posed::try_from(optimum.scene.clone()).unwrap();
        let found = Arc::new(fit::FitResult::Optimum(optimum));
        let content = || Content::Fit(scene.name.clone(), Box::new(posed.clone()), Arc::clone(&found));
        assert!(made_twice("fit", &content) > 3);

        let mut cycles = Vec::new();
        let settings = startup::Settings { fidelity: Fidelity::Draft, cycles: 3, ..startup::Settings::default() };
        let each = &mut |cycle: startup::Cycle| cycles.push(cycle.slim());
        let ended = startup::startup(&problem, &settings, each, &cancel).unwrap();
        let from_rest = Box::new(Posed::try_from(scene.clone()).unwrap());
        let content = || Content::Startup(from_rest.clone(), settings, Box::new(ended.clone()), cycles.clone());
        assert!(made_twice("startup", &content) > 3);

        let heavy = Box::new(crate::job::work::tests::posed("floating-disc"));
        let mut way = Vec::new();
        let ended = fall::fall(&heavy.problem, Fidelity::Draft, 3, 1e-3, &mut |cycle| way.push(cycle), &cancel);
        let ended = ended.unwrap().unwrap();
        let content = || Content::Fall(heavy.clone(), Fidelity::Draft, ended.clone(), way.clone());
        assert!(made_twice("fall", &content) > 3);

        let candidates = candidates(&problem).into_iter().take(2).collect();
        let effort = Effort { repeats: Some(1), ..Effort::default() };
        let tradeoff = Tradeoff::of(&measure(&problem, candidates, &effort, &|| 0.0, &cancel, &mut |_, _| ()));
        made_twice("tradeoff.csv", &|| Content::TradeoffTable(tradeoff.clone()));
        made_twice("tradeoff.svg", &|| Content::TradeoffFigure(scene.name.clone(), tradeoff.clone(), vec![0]));

        let (text, success) = ("a".to_owned(), Some(true));
        let [lesson, title, kind, verb, response, time] = [(); 6].map(|()| text.clone());
        let record = Record { lesson, step: 1, title, kind, verb, response, success, tries: 2, time };
        made_twice("answers.jsonl", &|| Content::Answers(vec![record.clone()]));
        made_twice("answers.csv", &|| Content::Answers(vec![record.clone()]));
        let rgb = Arc::new((0..18).collect());
        made_twice("window.png", &|| Content::Picture(Picture { size: [3, 2], rgb: Arc::clone(&rgb) }));
    }
}
