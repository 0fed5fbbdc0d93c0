//! Torque over speed of the run on screen: computed in the background while its tab is shown, and kept.

use crate::analysis::torque::TorqueCurves;
use crate::fidelity::Fidelity;
use crate::job::SolvedScene;
use crate::job::torque::TorqueTask;
use crate::problem::Scenario;
use std::sync::Arc;

/// What is known, and what is being computed.
#[derive(Debug, Default)]
pub struct TorqueState {
    asked: Option<Arc<SolvedScene>>,
    task: Option<TorqueTask>,
    found: Option<(Arc<SolvedScene>, Result<TorqueCurves, String>)>,
}

impl TorqueState {
    /// Whether the curves of `run` are still to be computed.
    pub fn lacks(&self, run: &SolvedScene) -> bool {
        !self.asked.as_ref().is_some_and(|asked| same(asked, run)) && matches!(run.problem.scenario, Scenario::Motor(_))
    }

    /// `task` computes those of `run`. Those before stay until then.
    pub fn begin(&mut self, run: &Arc<SolvedScene>, task: std::io::Result<TorqueTask>) {
        self.asked = Some(Arc::clone(run));
        match task {
            Ok(task) => self.task = Some(task),
            Err(error) => self.found = Some((Arc::clone(run), Err(format!("no thread can be started: {error}")))),
        }
    }

    /// Takes what was found since the last time.
    pub fn drain(&mut self) {
        if let (Some(end), Some(of)) = (self.task.as_ref().and_then(|task| task.drain().end), self.asked.clone()) {
            self.task = None;
            match end {
                Ok(Some(found)) => self.found = Some((of, found.map(|found| found.0))),
                Ok(None) => {}
                Err(panic) => self.found = Some((of, Err(format!("it failed: {panic}")))),
            }
        }
    }

    /// The run that the newest that is known is of.
    pub fn found_of(&self) -> Option<&SolvedScene> {
        self.found.as_ref().map(|(of, _)| of.as_ref())
    }

    /// The newest that is known.
    pub fn found(&self) -> Option<&Result<TorqueCurves, String>> {
        self.found.as_ref().map(|(_, found)| found)
    }

    /// Those of the scene of `run`, of a solve that is good enough to judge by: while a finer one is under way, of the one before.
    pub fn of(&self, run: &SolvedScene) -> Option<&TorqueCurves> {
        let good = run.fidelity.min(Fidelity::Standard);
        let (_, found) = self.found.as_ref().filter(|(of, _)| of.number == run.number && of.fidelity >= good)?;
        found.as_ref().ok()
    }

    /// Whether what is known is of `run`.
    pub fn is_of(&self, run: &SolvedScene) -> bool {
        self.found.as_ref().is_some_and(|(of, _)| same(of, run))
    }
}

fn same(a: &SolvedScene, b: &SolvedScene) -> bool {
    (a.number, a.fidelity) == (b.number, b.fidelity)
}
