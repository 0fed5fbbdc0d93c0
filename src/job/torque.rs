//! Torque over speed, in the background.

use super::SolvedScene;
use super::work::Work;
use crate::analysis::torque::TorqueCurves;
use crate::control::Cancel;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The run whose curves are computed, as it is sent to the thread or worker that does it.
#[derive(Debug, Serialize, Deserialize)]
pub struct TorqueWork(pub Arc<SolvedScene>);

impl Work for TorqueWork {
    const NAME: &'static str = "torque";
    type Message = ();
    type Output = TorqueCurves;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        let SolvedScene { problem, fidelity, solution, .. } = &*self.0;
        TorqueCurves::of(problem, *fidelity, solution, cancel).map_err(|error| format!("without film, {error}"))
    }
}
