//! A plate that is dropped on its vibration, in the background. Each cycle is sent when it has been computed.

use super::work::{Posed, Work};
use crate::control::Cancel;
use crate::fall::{CYCLES, Cycle, Fall, fall};
use crate::fidelity::Fidelity;
use crate::startup::Settings;
use serde::{Deserialize, Serialize};

/// A drop, as it is sent to the thread or worker that computes it.
#[derive(Debug, Serialize, Deserialize)]
pub struct DropWork {
    /// The scene of a plate under a load, and its problem.
    pub posed: Posed,
    /// The fidelity of its grids and steps.
    pub fidelity: Fidelity,
}

impl Work for DropWork {
    const NAME: &'static str = "drop";
    type Message = Cycle;
    /// How the drop ended.
    type Output = Fall;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(Cycle) + Sync)) -> Result<Option<Self::Output>, String> {
        let mut each = |cycle| tell(cycle);
        let found = fall(&self.posed.problem, self.fidelity, CYCLES, Settings::default().tolerance, &mut each, cancel);
        let ended = found.map_err(|error| error.to_string())?;
        ended.map(Some).ok_or_else(|| "there is no plate under a load".to_owned())
    }
}
