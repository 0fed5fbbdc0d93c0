//! One run in the middle of the window.

use super::frame::Frame;
use super::{motor, plate};
use crate::gui::derived::scales::Ranges;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{has_fields, room};
use crate::job::SolvedScene;
use crate::problem::Scenario;
use eframe::egui::Ui;

/// Draws `run` at the view's phase, and behind it `first`, a run for comparison, with common ranges of the axes. If `run` is one cycle of
/// several, the axes have the ranges `within`.
pub fn show(ui: &mut Ui, run: &SolvedScene, within: Option<Ranges>, first: Option<&SolvedScene>, cx: &DrawContext<'_>) {
    if !has_fields(&run.solution.recording) {
        return drop(ui.label("This run has no fields to show."));
    }
    let Some(area) = room(ui) else { return };
    let first = first.filter(|first| first.number != run.number);
    let view = &cx.state.view;
    if let Some(shown) = Frame::of(ui, "scales", (run, first), within, Scenario::motor, view) {
        motor::show(ui, area, &shown, cx);
    } else if let Some(shown) = Frame::of(ui, "scales", (run, first), within, Scenario::plate, view) {
        plate::show(ui, area, &shown, cx);
    }
}
