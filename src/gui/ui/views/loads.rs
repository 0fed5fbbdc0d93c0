//! Contact pressure and film pressure along the wave, gauge, as in the paper's Fig. 4: line loads over the contact width.

use super::motor_frame::MotorFrame;
use crate::gui::ui::paint::{Axes, PlotStyle, band};
use eframe::egui::{Color32, Painter, Pos2, Rect, Stroke};

/// Draws both curves into `rect`; the y axis is fixed over the cycle.
pub(super) fn draw(painter: &Painter, style: &PlotStyle, rect: Rect, shown: &MotorFrame<'_>) {
    let recording = shown.recording;
    let width = shown.motor.contact_width;
    let [low, high] = shown.scales.loads.map(|load| load / width);
    let margin = 0.06 * (high - low).max(1.0);
    let axes = Axes::new(rect, shown.x_range(), [low - margin, high + margin]);
    axes.canvas(painter, style);
    axes.y_ticks(painter, style, 1e3);
    let legend = [("contact", style.palette.contact), ("film", style.palette.film)];
    style.title(painter, rect, "Gauge pressure", &["Pressure on the teeth, kPa gauge", "Pressure, kPa gauge"], &legend);

    let painter = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    axes.x_grid(painter, style, 1e-3);
    shown.mark_followed(painter, style, &axes);
    painter.hline(rect.x_range(), axes.py(0.0), Stroke::new(1.0, style.palette.quiet));
    let zero = axes.py(0.0);
    for tooth in 0..recording.teeth {
        let line = shown.lines.of(tooth);
        let middle = tooth as f64 * recording.pitch;
        let curve = |field: &[f64]| -> Vec<Pos2> {
            recording.x.iter().zip(&field[line.clone()]).map(|(xi, load)| axes.at(middle + xi, load / width)).collect()
        };
        let stroke = |colour: Color32| Stroke::new(1.8, colour);
        let contact = curve(&shown.lines.contact);
        if shown.lines.contact[line.clone()].iter().any(|load| *load != 0.0) {
            let fill = style.palette.contact.gamma_multiply(0.35);
            band(painter, contact.iter().map(|at| (at.x, at.y, zero)), fill);
            painter.line(contact, stroke(style.palette.contact));
        }
        painter.line(curve(&shown.lines.film), stroke(style.palette.film));
    }
    axes.cursor(painter, style, shown.cursor);
}
