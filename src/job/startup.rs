//! A start-up in the background. Each cycle is sent when it is complete.

use super::work::{Posed, Work};
use crate::control::Cancel;
use crate::startup::{self, Cycle, Settings, Startup};
use serde::{Deserialize, Serialize};

/// Most cycles, each with all its fields, that wait to be taken. A thread that is further ahead waits.
const AHEAD: usize = 4;

/// A start-up, as it is sent to the thread or worker that computes it.
#[derive(Debug, Serialize, Deserialize)]
pub struct StartupWork {
    /// The scene that is started.
    pub posed: Posed,
    /// How it is solved.
    pub settings: Settings,
}

impl Work for StartupWork {
    const NAME: &'static str = "startup";
    const AHEAD: Option<usize> = Some(AHEAD);
    type Message = Cycle;
    /// How the start-up ended.
    type Output = Startup;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(Cycle) + Sync)) -> Result<Option<Self::Output>, String> {
        // Kept are also those that wait to be taken, and the one that the thread holds while it waits for room.
        let settings = Settings { kept: self.settings.kept + AHEAD + 1, ..self.settings };
        startup::startup(&self.posed.problem, &settings, &mut |cycle| tell(cycle), cancel)
            .map(Some)
            .map_err(|error| error.to_string())
    }
}
