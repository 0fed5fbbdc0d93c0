//! The plate: gap, pressure profile and map, load over the cycle, pressure–gap loop.

use crate::gui::command::Command;
use crate::gui::state::View;
use crate::job::Run;
use eframe::egui;

/// Draws `run` at the view's phase.
pub fn show(ui: &mut egui::Ui, run: &Run, view: &mut View, commands: &mut Vec<Command>) {
    let _ = (run, view, commands);
    ui.label("plate");
}
