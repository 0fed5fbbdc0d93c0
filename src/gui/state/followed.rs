//! Results computed in the background while their tab is shown, and kept until there are newer ones: torque over speed of a run,
//! and the properties of a rotor.

use super::background::Background;
use crate::analysis::rotor::RotorCurves;
use crate::analysis::torque::TorqueCurves;
use crate::fidelity::Fidelity;
use crate::job::SolvedScene;
use crate::job::task::BackgroundTask;
use crate::problem::{Motor, RotorCompliance, Scenario};
use crate::rotor::Wave;
use std::sync::Arc;

/// The result `T` for one `K`, and the task that computes the next.
#[derive(Debug)]
pub struct Followed<K, T> {
    asked: Option<K>,
    work: Background<(), T>,
    known: Option<(K, Result<T, String>)>,
}

impl<K, T> Default for Followed<K, T> {
    fn default() -> Self {
        Self { asked: None, work: Background::default(), known: None }
    }
}

impl<K: Clone, T: Send + 'static> Followed<K, T> {
    /// Computes the result for `of` by `task`. The previous result stays until then.
    pub fn follow(&mut self, of: K, task: Option<BackgroundTask<(), T>>) {
        self.asked = Some(of);
        task.into_iter().for_each(|task| self.work = task.into());
    }

    /// Takes a result that has come since the last call.
    pub fn drain(&mut self) {
        if let Some(end) = self.work.news().end
            && let Some(of) = self.asked.clone()
        {
            self.known = end.transpose().map(|found| (of, found)).or(self.known.take());
        }
    }

    /// The newest result, or why it failed.
    pub fn found(&self) -> Option<&Result<T, String>> {
        self.known.as_ref().map(|(_, found)| found)
    }

    /// The `K` that the newest result belongs to.
    pub fn found_of(&self) -> Option<&K> {
        self.known.as_ref().map(|(of, _)| of)
    }
}

/// Torque over speed of a run.
pub type TorqueState = Followed<Arc<SolvedScene>, TorqueCurves>;

impl TorqueState {
    /// Whether the curves of `run` have not been computed yet.
    pub fn lacks(&self, run: &SolvedScene) -> bool {
        !self.asked.as_ref().is_some_and(|asked| same(asked, run)) && matches!(run.problem.scenario, Scenario::Motor(_))
    }

    /// The curves for the scene of `run`, computed at least at standard fidelity, or at the fidelity of `run` if that is lower.
    pub fn of(&self, run: &SolvedScene) -> Option<&TorqueCurves> {
        let good = run.fidelity.min(Fidelity::Standard);
        let (_, found) = self.known.as_ref().filter(|(of, _)| of.number == run.number && of.fidelity >= good)?;
        found.as_ref().ok()
    }

    /// Whether the newest result belongs to `run`.
    pub fn is_of(&self, run: &SolvedScene) -> bool {
        self.found_of().is_some_and(|of| same(of, run))
    }
}

fn same(a: &SolvedScene, b: &SolvedScene) -> bool {
    (a.number, a.fidelity) == (b.number, b.fidelity)
}

/// A rotor, and the wave that runs round it.
pub type RotorState = Followed<(RotorCompliance, Wave), RotorCurves>;

impl RotorState {
    /// Whether the rotor of `motor` has still to be computed and no computation is running: while a dimension is dragged, rotors are
    /// computed one after the other.
    pub fn lacks(&self, motor: &Motor) -> bool {
        !self.work.running() && !self.asked.as_ref().is_some_and(|asked| is_of(asked, motor))
    }

    /// Whether the newest result belongs to the rotor of `motor`.
    pub fn is_of(&self, motor: &Motor) -> bool {
        self.found_of().is_some_and(|of| is_of(of, motor))
    }
}

fn is_of((rotor, wave): &(RotorCompliance, Wave), motor: &Motor) -> bool {
    *rotor == motor.rotor && *wave == motor.wave()
}
