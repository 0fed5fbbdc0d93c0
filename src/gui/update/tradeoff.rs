//! Starts the measurement of error against time.

use super::updater::Updater;
use crate::gui::state::tradeoff::{TradeoffState, with_present};
use crate::job::tradeoff::TradeoffWork;
use std::time::Duration;

/// Least interval between redraws during a measurement: drawing takes time that would be measured, too.
const MEASURE_INTERVAL: Duration = Duration::from_millis(200);

impl Updater {
    /// Starts a measurement, unless one is running.
    pub(super) fn measure(&mut self) {
        if self.state.tradeoff.as_ref().is_some_and(|measured| measured.work.running()) {
            return;
        }
        let Some(posed) = self.posed() else { return };
        let scene = posed.scene.clone();
        let (mut candidates, effort) = (self.platform.measure)(&posed.problem);
        with_present(&mut candidates, self.state.document.target(), scene.numerics());
        let now = self.platform.now;
        let work = TradeoffWork { posed, candidates, effort, now };
        if let Some(task) = self.start_work("The measurement cannot be started", work, MEASURE_INTERVAL) {
            self.state.tradeoff = Some(TradeoffState::new(task, scene, now()));
        }
    }
}
