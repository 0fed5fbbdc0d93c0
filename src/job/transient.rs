//! A transient from rest, in the background: a start-up, or a plate that is dropped on its vibration. Each cycle is sent when it is complete.

use super::work::{Posed, Work};
use crate::control::Cancel;
use crate::fall::{self, CYCLES, Fall, fall};
use crate::fidelity::Fidelity;
use crate::startup::{self, Settings, Startup, startup};
use serde::{Deserialize, Serialize};

/// Most cycles of a start-up, each with all its fields, that wait to be taken. A thread that is further ahead waits.
const AHEAD: usize = 4;

/// A scene that is started from rest, and how it is solved.
#[derive(Debug, Serialize, Deserialize)]
pub struct StartupWork(pub Posed, pub Settings);

impl Work for StartupWork {
    const NAME: &'static str = "startup";
    const AHEAD: Option<usize> = Some(AHEAD);
    type Message = startup::Cycle;
    /// How the start-up ended.
    type Output = Startup;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(startup::Cycle) + Sync)) -> Result<Option<Self::Output>, String> {
        // Kept are also those that wait to be taken, and the one that the thread holds while it waits for room.
        let settings = Settings { kept: self.1.kept + AHEAD + 1, ..self.1 };
        let ended = startup(&self.0.problem, &settings, &mut |cycle| tell(cycle), cancel);
        ended.map(Some).map_err(|error| error.to_string())
    }
}

/// A plate under a load that is dropped, and the fidelity of its grids and steps.
#[derive(Debug, Serialize, Deserialize)]
pub struct DropWork(pub Posed, pub Fidelity);

impl Work for DropWork {
    const NAME: &'static str = "drop";
    type Message = fall::Cycle;
    /// How the drop ended.
    type Output = Fall;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(fall::Cycle) + Sync)) -> Result<Option<Self::Output>, String> {
        let tolerance = Settings::default().tolerance;
        let found = fall(&self.0.problem, self.1, CYCLES, tolerance, &mut |cycle| tell(cycle), cancel);
        let ended = found.map_err(|error| error.to_string())?;
        ended.map(Some).ok_or_else(|| "there is no plate under a load".to_owned())
    }
}
