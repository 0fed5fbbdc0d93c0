//! A rotor by itself, in the background.

use super::work::{Posed, Work};
use crate::analysis::rotor::RotorCurves;
use crate::control::Cancel;
use crate::problem::Scenario;
use serde::{Deserialize, Serialize};

/// A motor, as it is sent to the thread or worker that computes its rotor.
#[derive(Debug, Serialize, Deserialize)]
pub struct RotorWork(pub Posed);

impl Work for RotorWork {
    const NAME: &'static str = "rotor";
    type Message = ();
    type Output = RotorCurves;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        let Scenario::Motor(motor) = &self.0.problem.scenario else { return Ok(None) };
        RotorCurves::of(motor, cancel).map_err(|error| error.to_string())
    }
}
