//! Torque over speed, in the background.

use super::SolvedScene;
use super::task::TaskOf;
use super::work::Work;
use crate::analysis::torque::TorqueCurves;
use crate::control::Cancel;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The run whose curves are computed, as it is sent to the thread or worker that does it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Curves(pub Arc<SolvedScene>);

/// The computation in the background.
pub type TorqueTask = TaskOf<Curves>;

impl Work for Curves {
    const NAME: &'static str = "torque";
    type Message = ();
    /// The curves, or why there are none; `None` if it was cancelled.
    type Found = Option<Result<TorqueCurves, String>>;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Self::Found {
        let SolvedScene { problem, fidelity, solution, .. } = &*self.0;
        TorqueCurves::of_solve(problem, *fidelity, solution, cancel)
            .map_err(|error| format!("without film, {error}"))
            .transpose()
    }

    fn ended() -> Self::Found {
        None
    }
}
