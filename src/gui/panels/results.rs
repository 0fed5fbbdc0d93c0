//! The right panel: the numbers of a run.

use crate::job::Run;
use eframe::egui;

/// Shows the results of `run`.
pub fn show(ui: &mut egui::Ui, run: &Run, dark: bool) {
    let _ = dark;
    ui.label(format!("{}", run.fidelity));
}
