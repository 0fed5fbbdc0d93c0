//! Torque over speed of a finished run, in the background: one named thread, cancelled and joined on drop. The contact
//! without film is solved here, so nothing is computed before somebody asks.

use super::worker::Worker;
use super::{Run, panic_text};
use crate::analysis::torque::TorqueCurves;
use crate::control::Cancel;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// What came of it: the numbers, or why there are none, in words.
pub type Told = Result<TorqueCurves, String>;

/// A computation under way, or ended.
#[derive(Debug)]
pub struct MeritJob {
    told: Receiver<Told>,
    /// Held for its drop.
    _worker: Worker,
}

impl MeritJob {
    /// Starts on `run`; `wake` is called from the worker's thread when it has ended.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn start(run: Arc<Run>, wake: impl FnOnce() + Send + 'static) -> std::io::Result<Self> {
        let (sender, told) = channel();
        let worker = Worker::start("torque", move |cancel| {
            let found = catch_unwind(AssertUnwindSafe(|| found(&run, cancel)));
            let found = found.unwrap_or_else(|panic| Some(Err(format!("it failed: {}", panic_text(panic.as_ref())))));
            if let Some(found) = found {
                // Nobody may be left to listen: then the owner has cancelled it too.
                let _ = sender.send(found);
            }
            wake();
        })?;
        Ok(Self { told, _worker: worker })
    }

    /// What was told, once it is.
    pub fn drain(&self) -> Option<Told> {
        self.told.try_recv().ok()
    }
}

/// `None` if it was cancelled, or there is no motor.
fn found(run: &Run, cancel: &Cancel) -> Option<Told> {
    TorqueCurves::of_solve(&run.problem, run.fidelity, &run.solution, cancel)
        .map_err(|error| format!("without film, {error}"))
        .transpose()
}
