//! Torque over speed of the run on screen: computed in the background while its tab is shown, and kept.

use crate::analysis::torque::TorqueCurves;
use crate::fidelity::Fidelity;
use crate::job::Run;
use crate::job::merit::MeritJob;
use crate::problem::Scenario;
use eframe::egui;
use std::sync::Arc;

/// Of which run.
type Key = (u64, Fidelity);

/// What is known, and what is being computed.
#[derive(Debug, Default)]
pub struct Merits {
    asked: Option<Key>,
    job: Option<MeritJob>,
    found: Option<(Key, Result<TorqueCurves, String>)>,
}

impl Merits {
    /// Sees to it that those of `run` are known soon. Those before stay until then.
    pub fn follow(&mut self, run: &Arc<Run>, ctx: &egui::Context) {
        let key = (run.number, run.fidelity);
        if self.asked == Some(key) || !matches!(run.problem.scenario, Scenario::Motor(_)) {
            return;
        }
        self.asked = Some(key);
        let wake = ctx.clone();
        match MeritJob::start(Arc::clone(run), move || wake.request_repaint()) {
            Ok(job) => self.job = Some(job),
            Err(error) => self.found = Some((key, Err(format!("no thread can be started: {error}")))),
        }
    }

    /// Takes what was found since the last time.
    pub fn drain(&mut self) {
        if let (Some(told), Some(key)) = (self.job.as_ref().and_then(MeritJob::drain), self.asked) {
            self.found = Some((key, told));
            self.job = None;
        }
    }

    /// The newest that is known.
    pub fn found(&self) -> Option<&Result<TorqueCurves, String>> {
        self.found.as_ref().map(|(_, found)| found)
    }

    /// Those of the scene of `run`, of a solve that is good enough to judge by: while a finer one is under way, of the one before.
    pub fn of(&self, run: &Run) -> Option<&TorqueCurves> {
        let good = run.fidelity.min(Fidelity::Standard);
        let (_, found) = self.found.as_ref().filter(|((number, found), _)| *number == run.number && *found >= good)?;
        found.as_ref().ok()
    }

    /// Whether what is known is of `run`.
    pub fn is_of(&self, run: &Run) -> bool {
        self.found.as_ref().is_some_and(|(key, _)| *key == (run.number, run.fidelity))
    }
}
