//! The frame of modal dialogs, their heading, and their answer.

use crate::gui::command::Command;
use eframe::egui::{self, RichText, Ui};

/// Margin around the contents \[points\].
const MARGIN: i8 = 18;

/// The frame of all modals: as that of a popup, with room inside.
pub fn frame(ctx: &egui::Context) -> egui::Frame {
    egui::Frame::popup(&ctx.global_style()).inner_margin(MARGIN)
}

/// Commands to carry out when the dialog is closed; `None` until it is answered.
pub(super) type Answer = Option<Vec<Command>>;

/// The heading, in large letters.
pub(super) fn heading(ui: &mut Ui, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).heading()).wrap());
    ui.add_space(8.0);
}
