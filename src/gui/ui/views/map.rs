//! The pressure map of all teeth, or of a plate.

use super::field::{self, Stamp};
use super::frame::Frame;
use crate::gui::derived::format::plain;
use crate::gui::ui::paint::{Axes, PlotStyle};
use eframe::egui::{Align2, Rect, Ui, pos2};

/// Draws the map, of this name, into `rect`, with the colour bar in its title, one of `titles`, and the values of y at the left.
pub(super) fn draw<T>(
    ui: &Ui,
    style: &PlotStyle,
    rect: Rect,
    shown: &Frame<'_, T>,
    (name, titles): (&str, &[&str]),
) -> Axes {
    let range = shown.ranges.pressure;
    let stamp = Stamp { run: shown.run, place: shown.place, tooth: 0, x: shown.x_range(), range };
    let axes = field::draw(ui, style, rect, shown.recording, name, stamp);
    style.title_with_bar(rect, "Pressure map", titles, range);
    y_labels(style, &axes);
    axes.cursor(style, shown.view.cursor_x);
    axes
}

/// The ends of y, and its name between them if there is room.
pub(super) fn y_labels(style: &PlotStyle, axes: &Axes) {
    let x = axes.rect.left() - 4.0;
    let (top, bottom) = (axes.rect.top(), axes.rect.bottom());
    let write = |y: f32, anchor: Align2, text: &str| {
        style.write(pos2(x, y), anchor, text, style.palette.quiet);
    };
    if bottom - top > 2.0 * style.row {
        let text = |value: f64| plain(value * 1e3);
        write(top - 0.15 * style.row, Align2::RIGHT_TOP, &text(axes.y[1]));
        write(bottom + 0.1 * style.row, Align2::RIGHT_BOTTOM, &text(axes.y[0]));
    }
    if bottom - top > 3.2 * style.row || bottom - top <= 2.0 * style.row {
        write(axes.rect.center().y, Align2::RIGHT_CENTER, "y, mm");
    }
}
