//! Torque over speed, in the background.

use super::SolvedScene;
use super::task::Task;
use super::work::{Posed, Work};
use crate::analysis::torque::TorqueCurves;
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::fidelity::Fidelity;
use crate::solution::{Performance, Solution};
use serde::{Deserialize, Serialize};

/// The curves of a run, as they are carried to where they are computed.
#[derive(Debug, Serialize, Deserialize)]
pub struct Curves {
    posed: Posed,
    fidelity: Fidelity,
    solution: Solution,
}

/// What was found, in bytes.
#[derive(Debug, Serialize, Deserialize)]
pub struct Found(#[serde(with = "Parts")] pub TorqueCurves);

/// The parts of [`TorqueCurves`]: as text they have other names.
#[derive(Serialize, Deserialize)]
#[serde(remote = "TorqueCurves")]
struct Parts {
    with_film: Performance,
    without_film: Performance,
    radius: f64,
    surface_speed: f64,
    dry_equivalent: Estimate,
    film_power: Estimate,
    viscous_drag: f64,
    speed_effect: f64,
}

/// The curves, or why there are none; nothing if it was cancelled.
pub type TorqueTask = Task<(), Option<Result<Found, String>>>;

impl Work for Curves {
    const NAME: &'static str = "torque";
    type Message = ();
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
pub fn start(run: &SolvedScene, wake: impl Fn(bool) + Send + Sync + 'static) -> std::io::Result<TorqueTask> {
    let SolvedScene { scene, problem, fidelity, solution, .. } = run;
    let posed = Posed { scene: scene.clone(), problem: problem.clone() };
    Task::of(Curves { posed, fidelity: *fidelity, solution: solution.clone() }, wake)
}
