//! Error against time: measured, and written.

use super::updater::Updater;
use crate::analysis::tradeoff::Wish;
use crate::export::figure::{Format, to_bytes};
use crate::export::folder::write_file;
use crate::export::tradeoff::{figure, write_csv};
use crate::gui::state::dialogs::Export;
use crate::gui::state::tradeoff::{TradeoffState, with_present};
use crate::job;
use std::path::Path;
use std::time::Duration;

/// A measurement is drawn anew at most this often: what draws it is measured too.
const MEASURE_INTERVAL: Duration = Duration::from_millis(200);

impl Updater {
    /// Starts to measure, unless that goes on.
    pub(super) fn measure(&mut self) {
        if self.state.tradeoff.as_ref().is_some_and(TradeoffState::running) {
            return;
        }
        let Some(problem) = self.problem() else { return };
        let scene = self.state.document.scene().clone();
        let (mut candidates, effort) = (self.platform.measure)(&problem);
        with_present(&mut candidates, self.state.document.target(), scene.numerics());
        let now = self.platform.now;
        match job::tradeoff::measure(problem, candidates, effort, now, self.wake(MEASURE_INTERVAL)) {
            Ok(task) => self.state.tradeoff = Some(TradeoffState::new(task, scene, now())),
            Err(error) => self.state.fail(format!("The measurement cannot be started: {error}")),
        }
    }

    pub(super) fn write_tradeoff(&mut self, export: Export, path: &Path) {
        let Some(measured) = &self.state.tradeoff else { return };
        let tradeoff = measured.tradeoff();
        let written = match export {
            Export::TradeoffTable => write_file(path, |out| write_csv(tradeoff, out)),
            _ => {
                let wishes = [Wish::Accuracy(self.state.view.accuracy), Wish::Budget(self.state.view.budget)];
                let chosen: Vec<usize> = wishes.into_iter().filter_map(|wish| tradeoff.choose(wish)).collect();
                let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
                let named = Format::ALL.into_iter().find(|format| extension.as_deref() == Some(format.name()));
                let figure = figure(measured.name(), tradeoff, &chosen);
                write_file(path, |out| {
                    out.write_all(&to_bytes(&figure, named.unwrap_or(Format::Svg)).map_err(std::io::Error::other)?)
                })
            }
        };
        match written {
            Ok(()) => self.state.exports.wrote(vec![path.to_owned()]),
            Err(error) => self.state.fail(error),
        }
    }
}
