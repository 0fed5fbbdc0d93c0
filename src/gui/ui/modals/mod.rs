//! Overlays: dialogs, the sheet of shortcuts, the tour, the glossary; and the common parts of modal ones.

pub mod glossary;
mod new_motor;
pub mod question;
pub mod shortcuts;
pub mod tour;

use crate::gui::command::Command;
use eframe::egui::{self, RichText, Ui};

/// Margin around the contents \[points\].
const MARGIN: i8 = 18;

/// Commands to carry out when the dialog is closed; `None` until it is answered.
type Answer = Option<Vec<Command>>;

/// The frame of all modals: that of a popup, with a wider margin.
fn frame(ctx: &egui::Context) -> egui::Frame {
    egui::Frame::popup(&ctx.global_style()).inner_margin(MARGIN)
}

/// The heading, in large letters.
fn heading(ui: &mut Ui, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).heading()).wrap());
    ui.add_space(8.0);
}
