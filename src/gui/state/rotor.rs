//! The rotor by itself: computed in the background while its tab is shown, and kept until the rotor or the wave is another.

use super::followed::Followed;
use crate::analysis::rotor::RotorCurves;
use crate::job::rotor::RotorWork;
use crate::job::task::TaskOf;
use crate::problem::{Motor, RotorCompliance};
use crate::rotor::Wave;
use std::sync::Arc;

/// What is known of a rotor and the wave that runs round it, and what is being computed.
pub type RotorState = Followed<(RotorCompliance, Wave), RotorCurves, Arc<RotorCurves>>;

impl RotorState {
    /// Whether the rotor of `motor` is still to be computed, and nothing else is at work: while a dimension is dragged, one after the other.
    pub fn lacks(&self, motor: &Motor) -> bool {
        !self.work.running() && !self.asked.as_ref().is_some_and(|asked| is_of(asked, motor))
    }

    /// `task` computes that of `motor`.
    pub fn begin(&mut self, motor: &Motor, task: Option<TaskOf<RotorWork>>) {
        self.follow((motor.rotor.clone(), motor.wave()), task);
    }

    /// Whether what is known is of the rotor of `motor`.
    pub fn is_of(&self, motor: &Motor) -> bool {
        self.known.as_ref().is_some_and(|(of, _)| is_of(of, motor))
    }
}

fn is_of((rotor, wave): &(RotorCompliance, Wave), motor: &Motor) -> bool {
    *rotor == motor.rotor && *wave == motor.wave()
}
