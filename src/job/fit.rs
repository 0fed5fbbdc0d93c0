//! A fit to measurements, or the search for an optimum, in the background.

use super::work::{Work, pooled};
use crate::analysis::error::AnalysisError;
use crate::analysis::fit::{Bounds, Fitted, Goal, Measured, Optimum, fit, optimise};
use crate::control::Cancel;
use crate::scene::Scene;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Points that the search starts from.
const STARTS: usize = 16;

/// Result of a fit to measurements, or of the search for an optimum.
#[derive(Debug, Serialize, Deserialize)]
pub enum FitResult {
    /// A fit, and the measurements that were fitted.
    Fit(Arc<Measured>, Fitted),
    /// An optimum.
    Optimum(Optimum),
}

impl FitResult {
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

/// A search, as it is sent to the thread or worker that does it: for an optimum if there is a goal, or else for agreement with
/// measurements.
#[derive(Debug, Serialize, Deserialize)]
pub struct FitWork {
    /// The scene whose keys are chosen.
    pub scene: Scene,
    /// The measurements of a fit; `None` for an optimum.
    pub measured: Option<Arc<Measured>>,
    /// The keys, which stay within these bounds.
    pub bounds: Vec<Bounds>,
    /// The optimum that is sought; `None` for a fit.
    pub goal: Option<Goal>,
    /// Settings of the solves.
    pub settings: Settings,
}

impl Work for FitWork {
    const NAME: &'static str = "fit";
    /// Number of points tried, and the least χ² or the best value so far.
    type Message = (usize, f64);
    type Output = FitResult;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn((usize, f64)) + Sync)) -> Result<Option<Self::Output>, String> {
        let Self { scene, measured, bounds, goal, settings } = self;
        let told = |points: usize, best: f64| tell((points, best));
        let solve = || {
            if let Some(goal) = &goal {
                let found = optimise(&scene, &bounds, goal, &settings, (STARTS, cancel, &told))?;
                return Ok(found.map(FitResult::Optimum));
            }
            let Some(measured) = measured else { return Ok(None) };
            let found = fit(&scene, &bounds, &measured, &settings, (STARTS, cancel, &told))?;
            Ok(found.map(|fitted| FitResult::Fit(measured, fitted)))
        };
        pooled(solve).map_err(|error: AnalysisError| error.to_string())
    }
}
