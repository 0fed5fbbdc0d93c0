//! Exports: the same code and the same names as those of the command line, on a thread of their own.

use super::updater::Updater;
use crate::analysis::compare;
use crate::analysis::torque::TorqueCurves;
use crate::analysis::tradeoff::Target;
use crate::atomic::write_file;
use crate::control::Cancel;
use crate::export::animation::Options;
use crate::export::figure::{self, Format};
use crate::export::files::{self, Control, ExportError, Solved};
use crate::export::json::Summary;
use crate::export::sweep::{figure_of, write_csv};
use crate::export::{csv, sensitivity, tradeoff};
use crate::fidelity::Fidelity;
use crate::gui::state::dialogs::Export;
use crate::gui::state::fit::Found;
use crate::gui::state::pins::{fidelity, to_compare};
use crate::job::SolvedScene;
use crate::job::task::Task;
use crate::lessons::record;
use crate::motor::MotorError;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::solve::Settings;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Progress is drawn at most this often.
const REDRAW: Duration = Duration::from_millis(100);
/// Formats of the figures beside data, as without `--figures`.
const BESIDE_DATA: &[Format] = if cfg!(feature = "render") { &[Format::Svg, Format::Png] } else { Format::WRITTEN };

/// What is left to do once everything that it needs is at hand.
type Work = Box<dyn FnOnce(&Control<'_>) -> Result<Vec<PathBuf>, ExportError> + Send>;

impl Updater {
    pub(super) fn export(&mut self, export: Export, path: &Path) {
        if self.state.exports.running().is_some() {
            self.state.fail("Another export goes on: wait until it has ended, or cancel it.");
            return;
        }
        let path = match export.complete(path.to_owned()) {
            Ok(path) => path,
            Err(reason) => return self.state.fail(reason),
        };
        let Some(work) = self.export_work(export, path) else { return };
        let task = Task::start("export", self.wake(REDRAW), move |cancel, tell| {
            let control = Control { cancel, drawn: &|drawn, all| tell((drawn, all)) };
            work(&control).map_err(|error| match error {
                ExportError::Cancelled => None,
                error => Some(error.to_string()),
            })
        });
        match task {
            Ok(task) => self.state.exports.begin(export, task, self.now()),
            Err(error) => self.state.fail(format!("The export cannot be started: {error}")),
        }
    }

    /// The run on screen, and its scene with a name and a description that claim no more than is true of it.
    fn named(&self) -> Option<(Arc<SolvedScene>, (Scene, Problem))> {
        let run = self.state.run.clone()?;
        let mut scene = run.scene.clone();
        scene.retitle(self.state.document.saved());
        let problem = Problem { name: scene.name.clone(), ..run.problem.clone() };
        Some((run, (scene, problem)))
    }

    /// What is to be done, with its own share of all that it needs.
    fn export_work(&self, export: Export, path: PathBuf) -> Option<Work> {
        Some(match export {
            Export::Data => {
                let (run, named) = self.named()?;
                Box::new(move |control| {
                    let mut summary = Summary::new(&named.1, &run.solution, run.wall_s, &[]);
                    summary.add_torque(merit(&run, control.cancel));
                    let solved = Solved { torque: summary.torque.as_ref(), ..solved(&run, &named) };
                    files::solve(&path, &solved, &summary, BESIDE_DATA, control)
                })
            }
            Export::Figures => {
                let (run, named) = self.named()?;
                Box::new(move |control| {
                    // Without it the other figures are still worth having.
                    let merit = merit(&run, control.cancel).ok().flatten();
                    let solved = Solved { torque: merit.as_ref(), ..solved(&run, &named) };
                    files::solve_figures(&path, &solved, Format::WRITTEN, control)
                })
            }
            Export::Fields => {
                let (run, named) = self.named()?;
                Box::new(move |_| files::fields(&path, &solved(&run, &named)))
            }
            Export::Animation => {
                let (run, named) = self.named()?;
                Box::new(move |control| files::animation(&path, &solved(&run, &named), &Options::default(), control))
            }
            Export::Report => {
                let (run, (scene, problem)) = self.named()?;
                let run = compare::ComparedRun { label: scene.name.clone(), scene, problem, ..to_compare(&run) };
                let settings = at(&[fidelity(&run)]);
                Box::new(move |control| files::html(&path, &[run], &settings, control))
            }
            Export::Comparison | Export::ComparisonReport => {
                let runs = self.state.pins.runs().to_vec();
                let settings = at(&runs.iter().map(fidelity).collect::<Vec<_>>());
                if export == Export::ComparisonReport {
                    Box::new(move |control| files::html(&path, &runs, &settings, control))
                } else {
                    let all = self.state.pins.all_parameters;
                    Box::new(move |control| {
                        files::comparison(&path, &runs, (&settings, all, &[]), BESIDE_DATA, control)
                    })
                }
            }
            Export::SweepTable | Export::SweepFigure | Export::Sweep => {
                let swept = self.state.sweep.swept()?;
                let (sweep, rows) = (Arc::clone(swept.sweep()), swept.rows().to_vec());
                let quantity = self.state.sweep.quantity(&sweep.quantities());
                Box::new(move |_| match export {
                    Export::SweepTable => {
                        write_file(&path, |out| write_csv(&sweep, &rows, out))?;
                        Ok(vec![path])
                    }
                    Export::SweepFigure => {
                        figure::write(&figure_of(&sweep, &rows, quantity), &path)?;
                        Ok(vec![path])
                    }
                    _ => Ok(files::swept(&path, &sweep, &rows, &[], BESIDE_DATA)?),
                })
            }
            Export::Sensitivity => {
                let state = &self.state.sensitivity;
                let (found, uncertainties) = (Arc::clone(state.found()?), state.uncertainties()?.clone());
                let (carlo, fidelity) = (state.carlo().cloned(), state.fidelity().to_string());
                Box::new(move |_| {
                    let found = sensitivity::Found {
                        sensitivity: &found,
                        uncertainties: &uncertainties,
                        carlo: carlo.as_ref(),
                    };
                    Ok(files::sensitivity(&path, &found, &fidelity, &[], BESIDE_DATA)?)
                })
            }
            Export::Fit => {
                let (scene, found) = self.state.fit.found()?;
                let (name, found) = (scene.name.clone(), Arc::clone(found));
                let problem = Problem::new(found.scene()).ok()?;
                Box::new(move |_| {
                    let of = (name.as_str(), &problem);
                    Ok(match &*found {
                        Found::Fit(measured, fitted) => files::fitted(&path, of, (fitted, measured), &[], BESIDE_DATA)?,
                        Found::Optimum(optimum) => files::optimum(&path, of, optimum, &[], BESIDE_DATA)?,
                    })
                })
            }
            Export::Answers => {
                let records = self.state.lessons.records();
                Box::new(move |_| {
                    let lines = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("jsonl"));
                    write_file(&path, |out| match lines {
                        true => out.write_all(record::statements(&record::student(&path), &records).as_bytes()),
                        false => csv::rows(&records, out),
                    })?;
                    Ok(vec![path])
                })
            }
            Export::TradeoffTable | Export::TradeoffFigure => {
                let measured = self.state.tradeoff.as_ref()?;
                let (name, tradeoff) = (measured.name().to_owned(), measured.tradeoff().clone());
                let targets = [Target::Accuracy(self.state.view.accuracy), Target::Budget(self.state.view.budget)];
                Box::new(move |_| {
                    if export == Export::TradeoffTable {
                        write_file(&path, |out| csv::rows(tradeoff::settings(&tradeoff), out))?;
                    } else {
                        let chosen: Vec<usize> =
                            targets.into_iter().filter_map(|target| tradeoff.choose(target)).collect();
                        figure::write(&tradeoff::figure(&name, &tradeoff, &chosen), &path)?;
                    }
                    Ok(vec![path])
                })
            }
        })
    }
}

fn solved<'a>(run: &'a SolvedScene, (scene, problem): &'a (Scene, Problem)) -> Solved<'a> {
    let SolvedScene { solution, history, .. } = run;
    Solved { scene, problem, solution, history, torque: None }
}

fn merit(run: &SolvedScene, cancel: &Cancel) -> Result<Option<TorqueCurves>, MotorError> {
    TorqueCurves::of_solve(&run.problem, run.fidelity, &run.solution, cancel)
}

/// Settings of runs at these fidelities: of several, the coarsest.
fn at(fidelities: &[&str]) -> Settings {
    let known = fidelities.iter().filter_map(|name| name.parse::<Fidelity>().ok());
    Settings { fidelity: known.min().unwrap_or_default(), ..Settings::default() }
}
