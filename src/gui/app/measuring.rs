//! Error against time: measured, and written.

use super::App;
use crate::analysis::tradeoff::Wish;
use crate::export::figure::{Format, to_bytes};
use crate::export::folder::write_file;
use crate::export::tradeoff::{figure, write_csv};
use crate::gui::dialogs::Export;
use crate::gui::measured::{Measured, with_present};
use crate::gui::modal::Modal;
use crate::job::measurement::Measurement;
use crate::problem::Problem;
use eframe::egui;
use std::path::Path;
use std::time::Duration;

/// A measurement is drawn anew at most this often: what draws it is measured too.
const MEASURE_INTERVAL: Duration = Duration::from_millis(200);

impl App {
    /// Starts to measure, unless that goes on.
    pub(super) fn measure(&mut self, ctx: &egui::Context) {
        if self.measured.as_ref().is_some_and(Measured::running) {
            return;
        }
        let scene = self.document.scene().clone();
        let problem = match Problem::new(&scene) {
            Ok(problem) => problem,
            Err(error) => {
                self.modal = Some(Modal::Error(error.to_string()));
                return;
            }
        };
        let (mut candidates, effort) = (self.world.measure)(&problem);
        with_present(&mut candidates, self.document.aim(), scene.numerics);
        let now = self.world.now;
        let wake = ctx.clone();
        let wake = move |ended: bool| {
            if ended { wake.request_repaint() } else { wake.request_repaint_after(MEASURE_INTERVAL) }
        };
        match Measurement::start(problem, candidates, effort, now, wake) {
            Ok(job) => self.measured = Some(Measured::new(job, scene, now())),
            Err(error) => self.modal = Some(Modal::Error(format!("The measurement cannot be started: {error}"))),
        }
    }

    pub(super) fn write_tradeoff(&mut self, export: Export, path: &Path) {
        let Some(measured) = &self.measured else { return };
        let tradeoff = measured.tradeoff();
        let written = match export {
            Export::TradeoffTable => write_file(path, |out| write_csv(tradeoff, out)),
            _ => {
                let wishes = [Wish::Accuracy(self.view.accuracy), Wish::Budget(self.view.budget)];
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
            Ok(()) => self.exports.wrote(vec![path.to_owned()]),
            Err(error) => self.modal = Some(Modal::Error(error.to_string())),
        }
    }
}
