//! A rotor by itself, in the background.

use super::task::TaskOf;
use super::work::{Posed, Work};
use crate::analysis::rotor::RotorCurves;
use crate::control::Cancel;
use crate::problem::Scenario;
use serde::{Deserialize, Serialize};

/// The computation in the background.
pub type RotorTask = TaskOf<Alone>;

/// A motor, as it is sent to the thread or worker that computes its rotor.
#[derive(Debug, Serialize, Deserialize)]
pub struct Alone(pub Posed);

impl Work for Alone {
    const NAME: &'static str = "rotor";
    type Message = ();
    /// The curves, or why there are none; `None` if it was cancelled.
    type Found = Option<Result<RotorCurves, String>>;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Self::Found {
        let Scenario::Motor(motor) = &self.0.problem.scenario else { return None };
        RotorCurves::of(motor, cancel).map_err(|error| error.to_string()).transpose()
    }

    fn ended() -> Self::Found {
        None
    }
}
