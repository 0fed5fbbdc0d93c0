//! The pressure map of all teeth.

use super::field::{self, Stamp};
use super::frame::Frame;
use crate::gui::derived::format::plain;
use crate::gui::ui::paint::{Axes, PlotStyle, title_with_bar};
use crate::problem::Motor;
use eframe::egui::{Align2, Painter, Rect, Stroke, StrokeKind, Ui, pos2};

/// Draws the map into `rect`, with the colour bar in its title and the values of x below.
pub(super) fn draw(ui: &Ui, painter: &Painter, style: &PlotStyle, rect: Rect, shown: &Frame<'_, Motor>) {
    let range = shown.ranges.pressure;
    let stamp = Stamp { run: shown.run, place: shown.place, tooth: 0, x: shown.x_range(), range };
    let axes = field::draw(ui, style, painter, rect, shown.recording, "all teeth", stamp);
    let titles = ["Pressure map of the film, kPa absolute", "Film, absolute", "Film"];
    title_with_bar(painter, style, rect, "Pressure map", &titles, range);
    y_labels(painter, style, &axes);
    axes.x_labels(painter, style, 1e-3, "x, mm");
    // The followed tooth.
    let [left, right] = shown.followed().map(|x| axes.px(x));
    let outline = Rect::from_x_y_ranges(left..=right, rect.y_range());
    painter.rect_stroke(outline, 0.0, Stroke::new(1.5, style.palette.accent), StrokeKind::Outside);
    axes.cursor(painter, style, shown.view.cursor_x);
}

/// The ends of y, and its name between them if there is room.
pub(super) fn y_labels(painter: &Painter, style: &PlotStyle, axes: &Axes) {
    let x = axes.rect.left() - 4.0;
    let (top, bottom) = (axes.rect.top(), axes.rect.bottom());
    let write = |y: f32, anchor: Align2, text: &str| {
        style.write(painter, pos2(x, y), anchor, text, style.palette.quiet);
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
