//! A fit to measurements, in the background.

use super::task::Task;
use super::work::{Work, shared};
use crate::analysis::fit::{Bounds, FitError, Fitted, Measured, Model, fit};
use crate::control::Cancel;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Places that the search starts from.
const STARTS: usize = 16;

/// A fit under way: how many points were tried with the least χ² so far; then what was found, nothing if it was cancelled, or why
/// there is nothing.
pub type FitTask = Task<(usize, f64), Result<Option<Fitted>, String>>;

/// A fit, as it is carried to where it is made.
#[derive(Debug, Serialize, Deserialize)]
pub struct Asked {
    scene: Scene,
    #[serde(with = "shared")]
    measured: Arc<Measured>,
    bounds: Vec<Bounds>,
    settings: Settings,
}

impl Work for Asked {
    const NAME: &'static str = "fit";
    type Message = (usize, f64);
    type Found = Result<Option<Fitted>, String>;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn((usize, f64)) + Sync)) -> Self::Found {
        let Self { scene, measured, bounds, settings } = &self;
        let solve = || {
            let model = Model::new(scene, bounds, settings)?.under(measured)?;
            fit(&model, measured, STARTS, cancel, &|points, chi_squared| tell((points, chi_squared)))
        };
        // A pool of its own: an export or another task need not wait until this is done.
        let found = match rayon::ThreadPoolBuilder::new().build() {
            Ok(pool) => pool.install(solve),
            Err(_) => solve(),
        };
        found.map_err(|error: FitError| error.to_string())
    }

    fn ended() -> Self::Found {
        Ok(None)
    }
}

/// Starts to fit `scene` to what was measured, its keys within `bounds`.
///
/// # Errors
/// If it cannot be done in the background.
pub fn start(
    scene: Scene,
    measured: Arc<Measured>,
    bounds: Vec<Bounds>,
    settings: Settings,
    wake: impl Fn(bool) + Send + Sync + 'static,
) -> std::io::Result<FitTask> {
    Task::of(Asked { scene, measured, bounds, settings }, wake)
}
