//! Torque over speed, in the background.

use super::SolvedScene;
use super::task::TaskOf;
use super::work::Work;
use crate::analysis::torque::TorqueCurves;
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::solution::Performance;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The run whose curves are computed, as it is sent to the thread or worker that does it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Curves(pub Arc<SolvedScene>);

/// The curves, in a form that can be sent as bytes.
#[derive(Debug, Serialize, Deserialize)]
pub struct Found(#[serde(with = "Parts")] pub TorqueCurves);

impl From<Found> for TorqueCurves {
    fn from(found: Found) -> Self {
        found.0
    }
}

/// The fields of [`TorqueCurves`]. In JSON they have other names.
#[derive(Serialize, Deserialize)]
#[serde(remote = "TorqueCurves")]
struct Parts {
    with_film: Performance,
    without_film: Performance,
    radius: f64,
    stator_speed: f64,
    dry_equivalent: Estimate,
    film_power: Estimate,
    viscous_drag: f64,
    speed_effect: f64,
}

/// The computation in the background.
pub type TorqueTask = TaskOf<Curves>;

impl Work for Curves {
    const NAME: &'static str = "torque";
    type Message = ();
    /// The curves, or why there are none; `None` if it was cancelled.
    type Found = Option<Result<Found, String>>;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Self::Found {
        let SolvedScene { problem, fidelity, solution, .. } = &*self.0;
        TorqueCurves::of_solve(problem, *fidelity, solution, cancel)
            .map(|curves| curves.map(Found))
            .map_err(|error| format!("without film, {error}"))
            .transpose()
    }

    fn ended() -> Self::Found {
        None
    }
}
