//! The measurement of error against solve time, in the background.

use super::work::{Posed, Work};
use crate::analysis::tradeoff::{Candidate, Effort, MeasuredSetting, measure};
use crate::control::Cancel;
use crate::platform::Instant;
use serde::{Deserialize, Serialize};

/// Progress of a measurement: all settings with their results so far, and the share of the work that is done, 0 to 1.
pub type Progress = (Vec<MeasuredSetting>, f64);

/// A measurement, as it is sent to the thread or worker that makes it.
#[derive(Debug, Serialize, Deserialize)]
pub struct TradeoffWork {
    /// The scene.
    pub posed: Posed,
    /// The settings that are measured.
    pub candidates: Vec<Candidate>,
    /// Effort of the measurement.
    pub effort: Effort,
    /// The clock. It is not sent: a worker uses its own.
    #[serde(skip, default = "clock")]
    pub now: fn() -> Instant,
}

fn clock() -> fn() -> Instant {
    Instant::now
}

impl Work for TradeoffWork {
    const NAME: &'static str = "measure";
    type Message = Progress;
    /// All settings with their results.
    type Output = Vec<MeasuredSetting>;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(Progress) + Sync)) -> Result<Option<Self::Output>, String> {
        let started = (self.now)();
        let clock = || (self.now)().duration_since(started).as_secs_f64();
        let mut each = |runs: &[MeasuredSetting], share| tell((runs.to_vec(), share));
        Ok(Some(measure(&self.posed.problem, self.candidates, &self.effort, &clock, cancel, &mut each)))
    }
}
