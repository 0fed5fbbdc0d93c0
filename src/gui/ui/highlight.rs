//! The positions of the parts of the window, and the ring round a part that a lesson or the tour highlights.

use super::theme::palette;
use eframe::egui::{Context, CornerRadius, Id, Rect, Stroke, StrokeKind, Ui};

/// Gap between a part and the ring round it, widths of the ring and of its glow, and its corners.
pub(super) const GAP: f32 = 3.0;
const LINE: f32 = 2.0;
pub(super) const GLOW: f32 = 6.0;
const CORNER: u8 = 6;

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

const RINGS: &str = "highlight, rings";

/// A ring of this frame or the one before that `rect` touches: pop-ups stay outside of it.
pub fn ring_round(ctx: &Context, rect: Rect) -> Option<Rect> {
    let now = ctx.cumulative_frame_nr();
    let rings: Vec<(u64, Rect)> = ctx.data(|data| data.get_temp(Id::unique(RINGS))).unwrap_or_default();
    let fresh = rings.into_iter().filter(|(frame, _)| now.saturating_sub(*frame) <= 1);
    fresh.map(|(_, ring)| ring).find(|ring| ring.expand(GAP).intersects(rect))
}

/// A ring with a glow round `rect`.
pub fn ring(ui: &Ui, rect: Rect) {
    let now = ui.ctx().cumulative_frame_nr();
    ui.ctx().data_mut(|data| {
        let rings: &mut Vec<(u64, Rect)> = data.get_temp_mut_or_default(Id::unique(RINGS));
        rings.retain(|(frame, _)| now.saturating_sub(*frame) <= 1);
        rings.push((now, rect));
    });
    let colour = palette(ui.visuals().dark_mode).accent;
    let rect = rect.expand(GAP);
    let corner = CornerRadius::same(CORNER);
    for (width, colour) in [(GLOW, colour.gamma_multiply(0.25)), (LINE, colour)] {
        ui.painter().rect_stroke(rect, corner, Stroke::new(width, colour), StrokeKind::Middle);
    }
}
