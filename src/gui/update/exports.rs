//! Exports: the same code and the same names as those of the command line, on a thread of their own.

use super::updater::Updater;
use crate::analysis::compare::ComparedRun;
use crate::analysis::tradeoff::Target;
use crate::atomic::write_file;
use crate::export::figure;
use crate::export::files::{self, ExportError};
use crate::export::sweep::{figure_of, write_csv};
use crate::export::{csv, sensitivity, tradeoff};
use crate::gui::state::dialogs::Export;
use crate::gui::state::fit::Found;
use crate::job::SolvedScene;
use crate::job::export::{BESIDE_DATA, Files, OfRun, OfRuns, Ran, reason};
use crate::job::task::Task;
use crate::job::work::Posed;
use crate::lessons::record;
use crate::problem::Problem;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Progress is drawn at most this often.
const REDRAW: Duration = Duration::from_millis(100);
/// What is left to do once everything that it needs is at hand.
type Work = Box<dyn FnOnce() -> Result<Vec<PathBuf>, ExportError> + Send>;

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
        let task = match self.files(export, &path) {
            Some(files) => Task::of(files, self.wake(REDRAW)),
            None => {
                let Some(work) = self.export_work(export, path) else { return };
                Task::start("export", self.wake(REDRAW), move |_, _| work().map_err(reason))
            }
        };
        match task {
            Ok(task) => self.state.exports.begin(export, task, self.now()),
            Err(error) => self.state.fail(format!("The export cannot be started: {error}")),
        }
    }

    /// The run on screen; its scene has a name and a description that claim no more than is true of it.
    fn named(&self) -> Option<Ran> {
        let run = self.state.run.as_ref()?;
        let mut scene = run.scene.clone();
        scene.retitle(self.state.document.saved());
        let problem = Problem { name: scene.name.clone(), ..run.problem.clone() };
        let SolvedScene { fidelity, solution, wall_s, history, .. } = &**run;
        let (posed, solution, history) = (Posed { scene, problem }, solution.clone(), history.clone());
        Some(Ran { posed, fidelity: *fidelity, solution, wall_s: *wall_s, history })
    }

    /// Files of runs, which a page has made elsewhere.
    fn files(&self, export: Export, path: &Path) -> Option<Files> {
        let of_run = |what| Some(Files::Run(what, path.to_owned(), Box::new(self.named()?)));
        let of_runs = |what, runs: &[ComparedRun]| Some(Files::of(what, path.to_owned(), runs));
        match export {
            Export::Data => of_run(OfRun::Data),
            Export::Figures => of_run(OfRun::Figures),
            Export::Fields => of_run(OfRun::Fields),
            Export::Animation => of_run(OfRun::Animation),
            Export::Report => {
                let Ran { posed: Posed { scene, problem }, solution, .. } = self.named()?;
                let run = ComparedRun { label: scene.name.clone(), scene, problem, solved: Ok(Arc::new(solution)) };
                of_runs(OfRuns::Report, &[run])
            }
            Export::ComparisonReport => of_runs(OfRuns::Report, self.state.pins.runs()),
            Export::Comparison => {
                of_runs(OfRuns::Comparison { all: self.state.pins.all_parameters }, self.state.pins.runs())
            }
            _ => None,
        }
    }

    /// What else there is to be done, with its own share of all that it needs. It takes a page less than a few redraws.
    fn export_work(&self, export: Export, path: PathBuf) -> Option<Work> {
        Some(match export {
            Export::Data
            | Export::Figures
            | Export::Fields
            | Export::Animation
            | Export::Report
            | Export::Comparison
            | Export::ComparisonReport => return None,
            Export::SweepTable | Export::SweepFigure | Export::Sweep => {
                let swept = self.state.sweep.swept()?;
                let (sweep, rows) = (Arc::clone(swept.sweep()), swept.rows().to_vec());
                let quantity = self.state.sweep.quantity(&sweep.quantities());
                Box::new(move || match export {
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
                Box::new(move || {
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
                Box::new(move || {
                    let of = (name.as_str(), &problem);
                    Ok(match &*found {
                        Found::Fit(measured, fitted) => files::fitted(&path, of, (fitted, measured), &[], BESIDE_DATA)?,
                        Found::Optimum(optimum) => files::optimum(&path, of, optimum, &[], BESIDE_DATA)?,
                    })
                })
            }
            Export::Answers => {
                let records = self.state.lessons.records();
                Box::new(move || {
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
                Box::new(move || {
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
