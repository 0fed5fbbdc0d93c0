//! Where parts of the window are, and the ring round one that a lesson or the tour points at.

use super::theme::{HIGHLIGHT, palette};
use eframe::egui::{Context, CornerRadius, Id, Rect, Stroke, StrokeKind, Ui};

/// Remembers that `name` is at `rect` in this frame.
pub fn remember(ui: &Ui, name: &str, rect: Rect) {
    let frame = ui.ctx().cumulative_frame_nr();
    ui.ctx().data_mut(|data| data.insert_temp(Id::unique(("highlight", name)), (frame, rect)));
}

/// Where `name` was drawn in this frame or the one before.
pub fn place(ctx: &Context, name: &str) -> Option<Rect> {
    let now = ctx.cumulative_frame_nr();
    let (frame, rect) = ctx.data(|data| data.get_temp::<(u64, Rect)>(Id::unique(("highlight", name))))?;
    (now.saturating_sub(frame) <= 1).then_some(rect)
}

/// A ring with a glow round `rect`.
pub fn ring(ui: &Ui, rect: Rect) {
    let colour = palette(ui.visuals().dark_mode).accent;
    let rect = rect.expand(HIGHLIGHT.gap);
    let corner = CornerRadius::same(HIGHLIGHT.corner);
    ui.painter().rect_stroke(
        rect,
        corner,
        Stroke::new(HIGHLIGHT.glow, colour.gamma_multiply(0.25)),
        StrokeKind::Middle,
    );
    ui.painter().rect_stroke(rect, corner, Stroke::new(HIGHLIGHT.line, colour), StrokeKind::Middle);
}
