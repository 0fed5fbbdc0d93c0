//! A rotor by itself, in the background.

use super::task::Task;
use super::work::{Posed, Work};
use crate::analysis::rotor::RotorCurves;
use crate::control::Cancel;
use crate::problem::Scenario;
use serde::{Deserialize, Serialize};

/// The computation: what was found, or why there is nothing; `None` if it was cancelled.
pub type RotorTask = Task<(), Option<Result<RotorCurves, String>>>;

/// A motor, as it is carried to where its rotor is computed.
#[derive(Debug, Serialize, Deserialize)]
pub struct Alone(Posed);

impl Work for Alone {
    const NAME: &'static str = "rotor";
    type Message = ();
    type Found = Option<Result<RotorCurves, String>>;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Self::Found {
        let Scenario::Motor(motor) = &self.0.problem.scenario else { return None };
        RotorCurves::of(motor, cancel).map_err(|error| error.to_string()).transpose()
    }

    fn ended() -> Self::Found {
        None
    }
}

/// Starts to compute the rotor of a motor.
///
/// # Errors
/// If it cannot be done in the background.
pub fn start(posed: Posed, wake: impl Fn(bool) + Send + Sync + 'static) -> std::io::Result<RotorTask> {
    Task::of(Alone(posed), wake)
}
