//! A sweep, in the background.

use super::task::Task;
use super::work::{Work, shared};
use crate::analysis::sweep::{Row, Sweep, Vary};
use crate::control::Cancel;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What a sweep tells on the way.
#[derive(Debug, Serialize, Deserialize)]
pub enum SweepMessage {
    /// Its points are known.
    Built(#[serde(with = "shared")] Arc<Sweep>),
    /// A point is solved.
    Solved(Box<Row>),
}

/// The work of a sweep: it builds the points, unless they are known, and solves them. It returns all rows in order, or why there are none.
pub type SweepTask = Task<SweepMessage, Result<Vec<Row>, String>>;

/// A sweep, as it is carried to where it is computed.
#[derive(Debug, Serialize, Deserialize)]
pub enum Points {
    /// To be built of a scene, what is varied, and how it is solved. There can be 100 000 points to look at.
    New(Scene, Vec<Vary>, Settings),
    /// Built, with the rows that are known.
    Known(#[serde(with = "shared")] Arc<Sweep>, Vec<Row>),
}

impl Work for Points {
    const NAME: &'static str = "sweep";
    type Message = SweepMessage;
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
        // A pool of its own: an export or another task need not wait until this is done.
        Ok(match rayon::ThreadPoolBuilder::new().build() {
            Ok(pool) => pool.install(solve),
            Err(_) => solve(),
        })
    }

    fn ended() -> Self::Found {
        Ok(Vec::new())
    }
}

/// Starts a sweep of `scene`.
///
/// # Errors
/// If it cannot be done in the background.
pub fn start(
    scene: Scene,
    vary: Vec<Vary>,
    settings: Settings,
    wake: impl Fn(bool) + Send + Sync + 'static,
) -> std::io::Result<SweepTask> {
    Task::of(Points::New(scene, vary, settings), wake)
}

/// Goes on with a sweep of which some rows are known.
///
/// # Errors
/// If it cannot be done in the background.
pub fn go_on(
    sweep: &Arc<Sweep>,
    done: Vec<Row>,
    wake: impl Fn(bool) + Send + Sync + 'static,
) -> std::io::Result<SweepTask> {
    Task::of(Points::Known(Arc::clone(sweep), done), wake)
}
