//! The frame of what is in the way, its heading, and what comes of it.

use crate::gui::command::Command;
use eframe::egui::{self, RichText, Ui};

/// Around the contents.
const MARGIN: i8 = 18;

/// The frame of all modals: as that of a popup, with room inside.
pub fn frame(ctx: &egui::Context) -> egui::Frame {
    egui::Frame::popup(&ctx.global_style()).inner_margin(MARGIN)
}

/// What the user answered, once that is clear: commands for when the question is gone.
pub(super) type Answer = Option<Vec<Command>>;

/// What is asked, in large letters.
pub(super) fn heading(ui: &mut Ui, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).heading()).wrap());
    ui.add_space(8.0);
}
