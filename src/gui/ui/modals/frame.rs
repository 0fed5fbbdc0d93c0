//! The frame of what is in the way.

use eframe::egui;

/// Around the contents.
const MARGIN: i8 = 18;

/// The frame of all modals: as that of a popup, with room inside.
pub fn frame(ctx: &egui::Context) -> egui::Frame {
    egui::Frame::popup(&ctx.global_style()).inner_margin(MARGIN)
}
