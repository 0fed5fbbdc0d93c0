//! A fit to measurements, or the search for an optimum, in the background.

use super::task::Task;
use super::work::{Work, shared};
use crate::analysis::fit::{Bounds, FitError, Fitted, Goal, Measured, Model, Optimum, fit, optimise};
use crate::control::Cancel;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Places that the search starts from.
const STARTS: usize = 16;

/// A search under way: how many points were tried, with the least χ² or the best number so far; then what was found, nothing if it was
/// cancelled, or why there is nothing.
pub type FitTask = Task<(usize, f64), Result<Option<Found>, String>>;

/// What was found.
#[derive(Debug, Serialize, Deserialize)]
pub enum Found {
    /// Of the measurements that were fitted.
    Fit(#[serde(with = "shared")] Arc<Measured>, Fitted),
    /// An optimum.
    Optimum(Optimum),
}

impl Found {
    /// The scene with the values that were found.
    pub fn scene(&self) -> &Scene {
        match self {
            Self::Fit(_, fitted) => &fitted.scene,
            Self::Optimum(optimum) => &optimum.scene,
        }
    }

    /// The keys that were chosen, and their values.
    pub fn values(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Fit(_, fitted) => fitted.unknowns.iter().map(|one| (one.unknown.parameter.key, one.value)).collect(),
            Self::Optimum(optimum) => {
                optimum.lines.iter().map(|line| (line.unknown.parameter.key, line.value)).collect()
            }
        }
    }
}

/// What is looked for, as it is carried to where it is done: an optimum, if there is a goal, or agreement with what was measured.
#[derive(Debug, Serialize, Deserialize)]
pub struct Asked {
    scene: Scene,
    measured: Option<Measured>,
    bounds: Vec<Bounds>,
    goal: Option<Goal>,
    settings: Settings,
}

impl Work for Asked {
    const NAME: &'static str = "fit";
    type Message = (usize, f64);
    type Found = Result<Option<Found>, String>;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn((usize, f64)) + Sync)) -> Self::Found {
        let Self { scene, measured, bounds, goal, settings } = self;
        let told = |points: usize, best: f64| tell((points, best));
        let solve = || {
            if let Some(goal) = &goal {
                let found = optimise(&scene, &bounds, goal, &settings, (STARTS, cancel, &told))?;
                return Ok(found.map(Found::Optimum));
            }
            let Some(measured) = measured else { return Ok(None) };
            let model = Model::new(&scene, &bounds, &settings)?.under(&measured)?;
            let found = fit(&model, &measured, STARTS, cancel, &told)?;
            Ok(found.map(|fitted| Found::Fit(Arc::new(measured), fitted)))
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

/// Starts to look for the `goal`, if there is one, or to fit `scene` to what was measured, its keys within `bounds`.
///
/// # Errors
/// If it cannot be done in the background.
pub fn start(
    scene: Scene,
    measured: Option<Measured>,
    bounds: Vec<Bounds>,
    goal: Option<Goal>,
    settings: Settings,
    wake: impl Fn(bool) + Send + Sync + 'static,
) -> std::io::Result<FitTask> {
    Task::of(Asked { scene, measured, bounds, goal, settings }, wake)
}
