//! Torque over speed, in the background.

use super::SolvedScene;
use super::task::{Started, Task, TaskOf, Wake};
use super::work::{Posed, Work};
use crate::analysis::torque::TorqueCurves;
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::fidelity::Fidelity;
use crate::solution::{Performance, Solution};
use serde::{Deserialize, Serialize};

/// The run whose curves are computed, as it is sent to the thread or worker that does it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Curves {
    posed: Posed,
    fidelity: Fidelity,
    solution: Solution,
}

impl Curves {
    /// The work for a solution of a scene at this fidelity.
    pub fn new(posed: Posed, fidelity: Fidelity, solution: Solution) -> Self {
        Self { posed, fidelity, solution }
    }
}

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
        TorqueCurves::of_solve(&self.posed.problem, self.fidelity, &self.solution, cancel)
            .map(|curves| curves.map(Found))
            .map_err(|error| format!("without film, {error}"))
            .transpose()
    }

    fn ended() -> Self::Found {
        None
    }
}

/// Starts to compute the curves of `run`.
///
/// # Errors
/// If it cannot be done in the background.
pub fn start(run: &SolvedScene, wake: impl Wake) -> Started<Curves> {
    let SolvedScene { scene, problem, fidelity, solution, .. } = run;
    let posed = Posed { scene: scene.clone(), problem: problem.clone() };
    Task::of(Curves::new(posed, *fidelity, solution.clone()), wake)
}
