//! A scene to be compared with others, solved in the background.

use super::task::TaskOf;
use super::work::Work;
use crate::analysis::compare::{ComparedRun, runs};
use crate::control::Cancel;
use crate::fidelity::Fidelity;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};

/// A scene to be compared, as it is sent to the thread or worker that solves it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Compared {
    /// The scene.
    pub scene: Scene,
    /// The fidelity that it is solved at.
    pub fidelity: Fidelity,
}

impl Work for Compared {
    const NAME: &'static str = "pin";
    type Message = ();
    /// `None` if it was cancelled.
    type Found = Option<ComparedRun>;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Self::Found {
        let settings = Settings { fidelity: self.fidelity, ..Settings::default() };
        // Every scene is solved by this method, and a run that was cancelled has nobody who waits for it.
        let solved = runs(&[self.scene], &settings, cancel, &|_| ()).ok().filter(|_| !cancel.is_cancelled());
        solved?.into_iter().next()
    }

    fn ended() -> Self::Found {
        None
    }
}

/// The solve of a scene to be compared.
pub type PinTask = TaskOf<Compared>;
