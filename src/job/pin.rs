//! A scene to be compared with others, solved in the background.

use super::task::{Started, Task, TaskOf, Wake};
use super::work::{Posed, Work};
use crate::analysis::compare::{ComparedRun, runs};
use crate::control::Cancel;
use crate::fidelity::Fidelity;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::solution::Solution;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A scene to be compared, as it is sent to the thread or worker that solves it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Compared {
    posed: Posed,
    fidelity: Fidelity,
}

impl Compared {
    /// A scene, and the fidelity that it is solved at.
    pub fn new(posed: Posed, fidelity: Fidelity) -> Self {
        Self { posed, fidelity }
    }
}

/// A solved scene: its label, and its solution or why there is none.
#[derive(Debug, Serialize, Deserialize)]
pub struct Found {
    label: String,
    posed: Posed,
    solved: Result<Solution, String>,
}

impl Found {
    /// That of a run of a comparison.
    pub(super) fn of(run: &ComparedRun) -> Self {
        let ComparedRun { label, scene, problem, solved } = run;
        let posed = Posed { scene: scene.clone(), problem: problem.clone() };
        let solved = solved.as_ref().map(|solution| solution.as_ref().clone()).map_err(Clone::clone);
        Self { label: label.clone(), posed, solved }
    }

    /// As a run of a comparison.
    pub fn into_run(self) -> ComparedRun {
        let Self { label, posed: Posed { scene, problem }, solved } = self;
        ComparedRun { label, scene, problem, solved: solved.map(Arc::new) }
    }
}

impl Work for Compared {
    const NAME: &'static str = "pin";
    type Message = ();
    /// `None` if it was cancelled.
    type Found = Option<Found>;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Self::Found {
        let settings = Settings { fidelity: self.fidelity, ..Settings::default() };
        // Every scene is solved by this method, and a run that was cancelled has nobody who waits for it.
        let solved = runs(&[self.posed.scene], &settings, cancel, &|_| ()).ok().filter(|_| !cancel.is_cancelled());
        let ComparedRun { label, scene, problem, solved } = solved?.into_iter().next()?;
        Some(Found { label, posed: Posed { scene, problem }, solved: solved.map(Arc::unwrap_or_clone) })
    }

    fn ended() -> Self::Found {
        None
    }
}

/// The solve of a scene to be compared.
pub type PinTask = TaskOf<Compared>;

/// Starts to solve a scene to be compared.
///
/// # Errors
/// If it cannot be done in the background.
pub fn start(scene: Scene, fidelity: Fidelity, wake: impl Wake) -> Started<Compared> {
    let problem = Problem::try_from(&scene).map_err(std::io::Error::other)?;
    Task::of(Compared::new(Posed { scene, problem }, fidelity), wake)
}
