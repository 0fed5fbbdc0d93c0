//! A sweep, in the background.

use super::task::{Started, Task, TaskOf, Wake};
use super::work::{Work, pooled, shared};
use crate::analysis::sweep::{Row, Sweep, Vary};
use crate::control::Cancel;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A message of a sweep.
#[derive(Debug, Serialize, Deserialize)]
pub enum SweepMessage {
    /// The points are built.
    Built(#[serde(with = "shared")] Arc<Sweep>),
    /// A point is solved.
    Solved(Box<Row>),
}

/// A sweep in the background.
pub type SweepTask = TaskOf<Points>;

/// A sweep, as it is sent to the thread or worker that computes it. The points are built there, unless they are known, and solved.
#[derive(Debug, Serialize, Deserialize)]
pub enum Points {
    /// Points to be built, at most 100 000: the scene, the keys that are varied, and how it is solved.
    New(Scene, Vec<Vary>, Settings),
    /// A sweep whose points are built, and the rows that are solved already.
    Known(#[serde(with = "shared")] Arc<Sweep>, Vec<Row>),
}

impl Work for Points {
    const NAME: &'static str = "sweep";
    type Message = SweepMessage;
    /// All rows in order, or why there are none.
    type Found = Result<Vec<Row>, String>;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(SweepMessage) + Sync)) -> Self::Found {
        let (sweep, done) = match self {
            Self::New(scene, vary, settings) => {
                let sweep = Arc::new(Sweep::new(&scene, &vary, &settings).map_err(|error| error.in_place())?);
                tell(SweepMessage::Built(Arc::clone(&sweep)));
                (sweep, Vec::new())
            }
            Self::Known(sweep, done) => (sweep, done),
        };
        let solve = || sweep.run(&done, cancel, &|row| tell(SweepMessage::Solved(Box::new(row.clone()))));
        Ok(pooled(solve))
    }

    fn ended() -> Self::Found {
        Ok(Vec::new())
    }
}

/// Starts a sweep of `scene`.
///
/// # Errors
/// If it cannot be done in the background.
pub fn start(scene: Scene, vary: Vec<Vary>, settings: Settings, wake: impl Wake) -> Started<Points> {
    Task::of(Points::New(scene, vary, settings), wake)
}

/// Continues a sweep of which some rows are solved already.
///
/// # Errors
/// If it cannot be done in the background.
pub fn go_on(sweep: &Arc<Sweep>, done: Vec<Row>, wake: impl Wake) -> Started<Points> {
    Task::of(Points::Known(Arc::clone(sweep), done), wake)
}
