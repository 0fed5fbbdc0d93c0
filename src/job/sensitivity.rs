//! Derivatives of the results, and random scenes, in the background.

use super::work::Work;
use crate::analysis::sensitivity::{MonteCarlo, Sensitivity, Uncertainties};
use crate::control::Cancel;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Counts one more solve. Returns the share of all that is done.
fn one_more(count: &AtomicUsize, all: usize) -> f64 {
    (count.fetch_add(1, Ordering::Relaxed) + 1) as f64 / all.max(1) as f64
}

/// A scene, as it is sent to the thread or worker that computes its derivatives.
#[derive(Debug, Serialize, Deserialize)]
pub struct Derivatives {
    /// The scene.
    pub scene: Scene,
    /// How it is solved.
    pub settings: Settings,
}

impl Work for Derivatives {
    const NAME: &'static str = "sensitivity";
    /// The share that is done, 0 to 1.
    type Message = f64;
    type Output = Box<Sensitivity>;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(f64) + Sync)) -> Result<Option<Self::Output>, String> {
        let count = AtomicUsize::new(0);
        let solved = |all: usize| tell(one_more(&count, all));
        let none: [&str; 0] = [];
        let found = Sensitivity::of(&self.scene, &none, &self.settings, cancel, &solved);
        found.map(|found| found.map(Box::new)).map_err(|error| error.to_string())
    }
}

/// Random scenes, as they are sent to the thread or worker that solves them.
#[derive(Debug, Serialize, Deserialize)]
pub struct Draws {
    /// The scene, solved.
    pub sensitivity: Arc<Sensitivity>,
    /// How uncertain its keys are.
    pub uncertainties: Uncertainties,
    /// How many random scenes are solved.
    pub draws: usize,
    /// Where the random numbers begin.
    pub seed: u64,
}

impl Work for Draws {
    const NAME: &'static str = "monte-carlo";
    /// The share that is done, 0 to 1.
    type Message = f64;
    type Output = MonteCarlo;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(f64) + Sync)) -> Result<Option<Self::Output>, String> {
        let Self { sensitivity, uncertainties, draws, seed } = self;
        let count = AtomicUsize::new(0);
        let solved = || tell(one_more(&count, draws));
        Ok(sensitivity.monte_carlo(&uncertainties, draws, seed, cancel, &solved).filter(|_| !cancel.is_cancelled()))
    }
}
