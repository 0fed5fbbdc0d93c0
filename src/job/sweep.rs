//! A sweep, in the background.

use super::work::{Work, pooled};
use crate::analysis::sweep::{Sweep, SweepRow, Vary};
use crate::control::Cancel;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A message of a sweep.
#[derive(Debug, Serialize, Deserialize)]
pub enum SweepMessage {
    /// The points are built.
    Built(Arc<Sweep>),
    /// A point is solved.
    Solved(Box<SweepRow>),
}

/// A sweep, as it is sent to the thread or worker that computes it. The points are built there, unless they are known, and solved.
#[derive(Debug, Serialize, Deserialize)]
pub enum SweepWork {
    /// A sweep to be built, of at most 100 000 points: the scene, the keys that are varied, and how it is solved.
    New(Scene, Vec<Vary>, Settings),
    /// A sweep whose points are built, and the rows that are solved already.
    Known(Arc<Sweep>, Vec<SweepRow>),
}

impl Work for SweepWork {
    const NAME: &'static str = "sweep";
    type Message = SweepMessage;
    /// All rows in order.
    type Output = Vec<SweepRow>;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(SweepMessage) + Sync)) -> Result<Option<Self::Output>, String> {
        let (sweep, done) = match self {
            Self::New(scene, vary, settings) => {
                let sweep = Arc::new(Sweep::new(&scene, &vary, &settings).map_err(|error| error.in_place())?);
                tell(SweepMessage::Built(Arc::clone(&sweep)));
                (sweep, Vec::new())
            }
            Self::Known(sweep, done) => (sweep, done),
        };
        let solve = || sweep.run(&done, cancel, &|row| tell(SweepMessage::Solved(Box::new(row.clone()))));
        Ok(Some(pooled(solve)))
    }
}
