//! Contact pressure and film pressure along the wave, gauge, as in the paper's Fig. 4: line loads over the contact width.

use super::motor::Shown;
use super::paint::{Axes, Ink, band};
use eframe::egui::{Color32, Painter, Pos2, Rect, Stroke};

/// Draws both curves into `rect`; the y axis is fixed over the cycle.
pub(super) fn draw(painter: &Painter, ink: &Ink, rect: Rect, shown: &Shown<'_>) {
    let recording = shown.recording;
    let width = shown.motor.contact_width;
    let [low, high] = shown.scales.loads.map(|load| load / width);
    let margin = 0.06 * (high - low).max(1.0);
    let axes = Axes::new(rect, shown.x_range(), [low - margin, high + margin]);
    axes.canvas(painter, ink);
    axes.y_ticks(painter, ink, 1e3);
    let legend = [("contact", ink.palette.contact), ("film", ink.palette.film)];
    ink.title(painter, rect, "Gauge pressure", &["Pressure on the teeth, kPa gauge", "Pressure, kPa gauge"], &legend);

    let painter = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    axes.x_grid(painter, ink, 1e-3);
    shown.mark_followed(painter, ink, &axes);
    painter.hline(rect.x_range(), axes.py(0.0), Stroke::new(1.0, ink.palette.quiet));
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
            let fill = ink.palette.contact.gamma_multiply(0.35);
            band(painter, contact.iter().map(|at| (at.x, at.y, zero)), fill);
            painter.line(contact, stroke(ink.palette.contact));
        }
        painter.line(curve(&shown.lines.film), stroke(ink.palette.film));
    }
    axes.cursor(painter, ink, shown.cursor);
}
