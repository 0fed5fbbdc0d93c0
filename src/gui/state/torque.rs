//! Torque over speed of the run on screen: computed in the background while its tab is shown, and kept.

use super::followed::Followed;
use crate::analysis::torque::TorqueCurves;
use crate::fidelity::Fidelity;
use crate::job::SolvedScene;
use crate::job::task::TaskOf;
use crate::job::torque::TorqueWork;
use crate::problem::Scenario;
use std::sync::Arc;

/// What is known of a run, and what is being computed.
pub type TorqueState = Followed<Arc<SolvedScene>, TorqueCurves, TorqueCurves>;

impl TorqueState {
    /// Whether the curves of `run` are still to be computed.
    pub fn lacks(&self, run: &SolvedScene) -> bool {
        !self.asked.as_ref().is_some_and(|asked| same(asked, run)) && matches!(run.problem.scenario, Scenario::Motor(_))
    }

    /// `task` computes those of `run`.
    pub fn begin(&mut self, run: &Arc<SolvedScene>, task: Option<TaskOf<TorqueWork>>) {
        self.follow(Arc::clone(run), task);
    }

    /// The run that the newest that is known is of.
    pub fn found_of(&self) -> Option<&SolvedScene> {
        self.known.as_ref().map(|(of, _)| of.as_ref())
    }

    /// Those of the scene of `run`, of a solve that is good enough to judge by: while a finer one is under way, of the one before.
    pub fn of(&self, run: &SolvedScene) -> Option<&TorqueCurves> {
        let good = run.fidelity.min(Fidelity::Standard);
        let (_, found) = self.known.as_ref().filter(|(of, _)| of.number == run.number && of.fidelity >= good)?;
        found.as_ref().ok()
    }

    /// Whether what is known is of `run`.
    pub fn is_of(&self, run: &SolvedScene) -> bool {
        self.known.as_ref().is_some_and(|(of, _)| same(of, run))
    }
}

fn same(a: &SolvedScene, b: &SolvedScene) -> bool {
    (a.number, a.fidelity) == (b.number, b.fidelity)
}
