//! A scene to be compared with others, solved in the background.

use super::work::Work;
use crate::analysis::compare::{ComparedRun, runs};
use crate::control::Cancel;
use crate::fidelity::Fidelity;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};

/// A scene to be compared, as it is sent to the thread or worker that solves it.
#[derive(Debug, Serialize, Deserialize)]
pub struct PinWork {
    /// The scene.
    pub scene: Scene,
    /// The fidelity that it is solved at.
    pub fidelity: Fidelity,
}

impl Work for PinWork {
    const NAME: &'static str = "pin";
    type Message = ();
    type Output = ComparedRun;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        let settings = Settings { fidelity: self.fidelity, ..Settings::default() };
        // Every scene is solved by this method, and a run that was cancelled has nobody who waits for it.
        let solved = runs(&[self.scene], &settings, cancel, &|_| ()).ok().filter(|_| !cancel.is_cancelled());
        Ok(solved.and_then(|runs| runs.into_iter().next()))
    }
}
