//! Parts of the window that can be pointed at: lit by a lesson, shown by the tour. Whoever draws a part says where it is;
//! a part that is lit gets a ring as it is drawn.

use super::theme::{SPOT, palette};
use eframe::egui::{Context, CornerRadius, Id, Rect, Stroke, StrokeKind, Ui};

/// All parts that can be named, by lessons and by the tour.
pub const PLACES: &[&str] = &[
    "parameters",
    "wave",
    "gap",
    "pressure",
    "map",
    "tooth",
    "least gap",
    "loads",
    "loop",
    "held plate",
    "boyle",
    "start",
    "history",
    "torque",
    "numbers",
    "timeline",
    "tabs",
    "lessons",
];

/// What is lit in this frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lit {
    /// Parts and keys of parameters.
    pub names: Vec<String>,
    /// Whether lit parameters are scrolled to, and their group opened.
    pub reveal: bool,
}

fn lit_id() -> Id {
    Id::unique("spot, lit")
}

/// Says what is lit from now on.
pub fn light(ctx: &Context, lit: Lit) {
    ctx.data_mut(|data| data.insert_temp(lit_id(), lit));
}

/// Whether `name` is lit.
pub fn is_lit(ctx: &Context, name: &str) -> bool {
    ctx.data(|data| data.get_temp::<Lit>(lit_id())).is_some_and(|lit| lit.names.iter().any(|other| other == name))
}

/// Whether what is lit is scrolled to in this frame.
pub fn reveals(ctx: &Context) -> bool {
    ctx.data(|data| data.get_temp::<Lit>(lit_id())).is_some_and(|lit| lit.reveal)
}

/// Says that `name` is at `rect` in this frame; rings it if it is lit.
pub fn mark(ui: &Ui, name: &str, rect: Rect) {
    let frame = ui.ctx().cumulative_frame_nr();
    ui.ctx().data_mut(|data| data.insert_temp(Id::unique(("spot", name)), (frame, rect)));
    if is_lit(ui.ctx(), name) {
        ring(ui, rect);
    }
}

/// Where `name` was drawn in this frame or the one before.
pub fn place(ctx: &Context, name: &str) -> Option<Rect> {
    let now = ctx.cumulative_frame_nr();
    let (frame, rect) = ctx.data(|data| data.get_temp::<(u64, Rect)>(Id::unique(("spot", name))))?;
    (now.saturating_sub(frame) <= 1).then_some(rect)
}

/// A ring with a glow round `rect`.
pub fn ring(ui: &Ui, rect: Rect) {
    let colour = palette(ui.visuals().dark_mode).accent;
    let rect = rect.expand(SPOT.room);
    let corner = CornerRadius::same(SPOT.corner);
    ui.painter().rect_stroke(rect, corner, Stroke::new(SPOT.glow, colour.gamma_multiply(0.25)), StrokeKind::Middle);
    ui.painter().rect_stroke(rect, corner, Stroke::new(SPOT.line, colour), StrokeKind::Middle);
}
