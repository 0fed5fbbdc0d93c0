//! Derivatives of the results, and random scenes, in the background.

use super::task::Task;
use crate::analysis::sensitivity::{MonteCarlo, Sensitivity, Uncertainties};
use crate::scene::Scene;
use crate::solve::Settings;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Work that tells the share that is done, 0 to 1, and returns what was found; `None` if it was cancelled.
pub type Finding<T> = Task<f64, Option<T>>;

/// Starts to compute the derivatives of the results of `scene` by every key that acts. It returns them, or why there are none.
pub fn sensitivity(
    scene: Scene,
    settings: Settings,
    wake: impl Fn(bool) + Send + Sync + 'static,
) -> std::io::Result<Finding<Result<Arc<Sensitivity>, String>>> {
    Task::start("sensitivity", wake, move |cancel, tell| {
        let count = AtomicUsize::new(0);
        let solved = |all: usize| tell((count.fetch_add(1, Ordering::Relaxed) + 1) as f64 / all.max(1) as f64);
        let none: [&str; 0] = [];
        match Sensitivity::of(&scene, &none, &settings, cancel, &solved) {
            Ok(found) => found.map(|found| Ok(Arc::new(found))),
            Err(error) => Some(Err(error.to_string())),
        }
    })
}

/// Starts to solve `draws` random scenes.
pub fn monte_carlo(
    sensitivity: Arc<Sensitivity>,
    uncertainties: Uncertainties,
    (draws, seed): (usize, u64),
    wake: impl Fn(bool) + Send + Sync + 'static,
) -> std::io::Result<Finding<MonteCarlo>> {
    Task::start("monte-carlo", wake, move |cancel, tell| {
        let count = AtomicUsize::new(0);
        let solved = || tell((count.fetch_add(1, Ordering::Relaxed) + 1) as f64 / draws.max(1) as f64);
        sensitivity.monte_carlo(&uncertainties, draws, seed, cancel, &solved)
    })
}
