//! Exports, in the background. They use the same code and the same file names as the command line.

use super::updater::{REDRAW, Updater};
use crate::analysis::compare::ComparedRun;
use crate::analysis::tradeoff::Target;
use crate::gui::state::dialogs::{Export, Purpose, complete};
use crate::job::SolvedScene;
use crate::job::export::{Content, Files};
use crate::job::work::Posed;
use crate::startup::Settings;
use std::path::Path;
use std::sync::Arc;

impl Updater {
    pub(super) fn export(&mut self, export: Export, path: &Path) {
        if self.state.exports.running.is_some() {
            let reason = "Another export goes on: wait until it has ended, or cancel it.";
            return self.fail_at(Purpose::Export(export), path, reason);
        }
        let kind = export.described().filter;
        let path = match kind.map_or(Ok(path.to_owned()), |(kind, allowed)| complete(path.to_owned(), kind, allowed)) {
            Ok(path) => path,
            Err(reason) => return self.fail_at(Purpose::Export(export), path, reason),
        };
        let Some(content) = self.content(export) else { return };
        let work = Files { path, content };
        if let Some(task) = self.start_work("The export cannot be started", work, REDRAW) {
            self.state.exports.begin(export, task, self.now());
        }
    }

    /// The run on screen, with the present name and description of its scene, which saving may have changed since the solve.
    pub(super) fn shown(&self) -> Option<SolvedScene> {
        let mut run = SolvedScene::clone(self.state.run.as_ref()?);
        let scene = self.state.document.scene();
        // Keys that only a motor or only a plate has are not compared.
        if run.scene.scene() == scene.scene() && run.scene.changed(scene).next().is_none() {
            run.scene = scene.clone();
        }
        Some(run)
    }

    /// As [`Self::shown`], with a new title if the scene was changed since it was saved.
    fn named(&self) -> Option<SolvedScene> {
        let mut run = self.shown()?;
        run.scene.retitle(self.state.document.saved());
        run.problem.name = run.scene.name.clone();
        Some(run)
    }

    /// Content of an export, with owned or shared copies of its data; `None` if there is nothing to export.
    fn content(&self, export: Export) -> Option<Content> {
        let run = || self.named().map(Box::new);
        let swept = || self.state.sweep.swept.as_ref();
        let sweep = || swept().map(|swept| Arc::clone(&swept.sweep));
        let rows = || swept().map(|swept| swept.rows.to_vec());
        Some(match export {
            Export::Data => Content::Run(run()?),
            Export::Figures => Content::Figures(run()?),
            Export::Fields => Content::Fields(run()?),
            Export::Animation => Content::Animation(run()?),
            Export::Report => {
                let SolvedScene { scene, problem, solution, .. } = self.named()?;
                Content::Report(vec![ComparedRun::new(scene.name.clone(), scene, problem, Ok(solution))])
            }
            Export::ComparisonReport => Content::Report(self.state.pins.runs.to_vec()),
            Export::Comparison => Content::Comparison(self.state.pins.runs.to_vec(), self.state.pins.all_parameters),
            Export::Sweep => Content::Sweep(sweep()?, rows()?),
            Export::SweepTable => Content::SweepTable(sweep()?, rows()?),
            Export::SweepFigure => {
                let sweep = sweep()?;
                let quantity = self.state.sweep.quantity(&sweep.quantities());
                Content::SweepFigure(sweep, rows()?, quantity)
            }
            Export::Sensitivity => {
                let state = &self.state.sensitivity;
                let (found, uncertainties) = (state.found.clone()?, state.uncertainties.clone()?);
                Content::Sensitivity(found, uncertainties, state.carlo.clone())
            }
            Export::Fit => {
                let (scene, found) = self.state.fit.found.as_ref()?;
                let posed = Posed::try_from(found.scene().clone()).ok()?;
                Content::Fit(scene.name.clone(), Box::new(posed), Arc::clone(found))
            }
            Export::Startup if self.state.document.scene().floats() => {
                let dropped = self.state.dropped.as_ref()?;
                let (posed, ended) = (Box::new(dropped.posed.clone()), dropped.ended.clone()?.ok()?);
                Content::Fall(posed, dropped.fidelity, ended, dropped.cycles.clone())
            }
            Export::Startup => {
                let startup = &self.state.startup.as_ref()?.transient;
                let settings = Settings { fidelity: startup.fidelity, ..Settings::default() };
                let ended = Box::new(startup.ended.clone()?.ok()?);
                Content::Startup(Box::new(startup.posed.clone()), settings, ended, startup.cycles.clone())
            }
            Export::Answers => Content::Answers(self.state.lessons.records()),
            Export::TradeoffTable => Content::TradeoffTable(self.state.tradeoff.as_ref()?.tradeoff.clone()),
            Export::TradeoffFigure => {
                let measured = self.state.tradeoff.as_ref()?;
                let targets = [Target::Accuracy(self.state.view.accuracy), Target::Budget(self.state.view.budget)];
                let chosen = targets.into_iter().filter_map(|target| measured.tradeoff.choose(target)).collect();
                Content::TradeoffFigure(measured.scene.name.clone(), measured.tradeoff.clone(), chosen)
            }
        })
    }
}
