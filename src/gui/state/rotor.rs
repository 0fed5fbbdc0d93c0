//! The rotor by itself: computed in the background while its tab is shown, and kept until the rotor or the wave is another.

use crate::analysis::rotor::RotorCurves;
use crate::job::rotor::RotorTask;
use crate::problem::{Motor, RotorCompliance};
use crate::rotor::Wave;
use std::sync::Arc;

/// A rotor and the wave that runs round it.
type RingedRotor = (RotorCompliance, Wave);

/// What is known, and what is being computed.
#[derive(Debug, Default)]
pub struct RotorState {
    asked: Option<RingedRotor>,
    task: Option<RotorTask>,
    found: Option<(RingedRotor, Result<Arc<RotorCurves>, String>)>,
}

impl RotorState {
    /// Whether the rotor of `motor` is still to be computed, and nothing else is at work: while a dimension is dragged, one after the other.
    pub fn lacks(&self, motor: &Motor) -> bool {
        self.task.is_none() && !self.asked.as_ref().is_some_and(|asked| is_of(asked, motor))
    }

    /// `task` computes that of `motor`. What was found before stays until then.
    pub fn begin(&mut self, motor: &Motor, task: std::io::Result<RotorTask>) {
        let of = (motor.rotor.clone(), motor.wave());
        self.asked = Some(of.clone());
        match task {
            Ok(task) => self.task = Some(task),
            Err(error) => self.found = Some((of, Err(format!("no thread can be started: {error}")))),
        }
    }

    /// Takes what was found since the last time.
    pub fn drain(&mut self) {
        if let (Some(end), Some(of)) = (self.task.as_ref().and_then(|task| task.drain().end), self.asked.clone()) {
            self.task = None;
            match end {
                Ok(Some(found)) => self.found = Some((of, found.map(Arc::new))),
                Ok(None) => {}
                Err(panic) => self.found = Some((of, Err(format!("it failed: {panic}")))),
            }
        }
    }

    /// The newest that is known.
    pub fn found(&self) -> Option<&Result<Arc<RotorCurves>, String>> {
        self.found.as_ref().map(|(_, found)| found)
    }

    /// Whether what is known is of the rotor of `motor`.
    pub fn is_of(&self, motor: &Motor) -> bool {
        self.found.as_ref().is_some_and(|(of, _)| is_of(of, motor))
    }
}

fn is_of((rotor, wave): &(RotorCompliance, Wave), motor: &Motor) -> bool {
    *rotor == motor.rotor && *wave == motor.wave()
}
