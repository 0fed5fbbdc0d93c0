//! Contact pressure and film pressure along the wave, gauge, as in the paper's Fig. 4: line loads over the contact width.

use super::frame::Frame;
use super::inset::Inset;
use crate::gui::ui::paint::PlotStyle;
use crate::gui::ui::plot::{between, level, line, under_pointer};
use crate::problem::Motor;
use crate::recording::Recording;
use eframe::egui::{Color32, Rect, Ui};
use egui_plot::{LineStyle, PlotResponse, PlotUi, Span};

const NAME: &str = "Pressures along one wavelength: point to read values, click a tooth to follow it";

/// Draws both curves into `rect`, over x \[mm\]; the y axis is fixed for the whole cycle until it is zoomed.
pub(super) fn draw(ui: &mut Ui, style: &PlotStyle, rect: Rect, shown: &Frame<'_, Motor>) -> PlotResponse<Option<f64>> {
    let width = shown.of.contact_width;
    let (contact, film) = (style.palette.contact, style.palette.film);
    let title = [
        "Pressure on the teeth, mean over the width, kPa gauge",
        "Pressure on the teeth, kPa gauge",
        "Pressure, kPa gauge",
    ];
    let mut legend = vec![("contact", contact), ("film", film)];
    legend.extend(style.at_first(shown.first.as_ref()));
    style.title(rect, "Gauge pressure", &title, &legend);
    let [low, high] = shown.ranges.loads.map(|load| load * 1e-3 / width);
    let margin = 0.06 * (high - low).max(1e-3);
    let bounds = [shown.x_range().map(|x| x * 1e3), [low - margin, high + margin]];
    let inset = Inset { name: NAME, rect, bounds, below: None };
    inset.show(ui, style, |plot| {
        let [left, right] = shown.followed().map(|x| x * 1e3);
        let column = Span::new("", left..=right).fill(style.palette.accent.gamma_multiply(0.10));
        plot.span(column);
        plot.hline(level(0.0, style.palette.quiet, 1.0));
        let quiet = (style.palette.quiet, LineStyle::Solid, 0.0);
        if let Some(Frame { recording, of: motor, lines, .. }) = shown.first.as_deref() {
            for field in [&lines.contact, &lines.film] {
                pressure(plot, (recording, motor.contact_width), field, 1e3, quiet);
            }
        }
        pressure(plot, (shown.recording, width), &shown.lines.contact, 1e3, (contact, LineStyle::Solid, 0.35));
        pressure(plot, (shown.recording, width), &shown.lines.film, 1e3, (film, LineStyle::Solid, 0.0));
        under_pointer(plot, shown.view.cursor_x.map(|x| x * 1e3), style.palette.accent);
    })
}

/// The line loads of all teeth as pressures \[kPa\], for a contact of this width \[m\], with these dashes, and a filled area of this
/// opacity. `metre` is the length of a metre on the axis.
pub(super) fn pressure(
    plot: &mut PlotUi<'_>,
    (recording, width): (&Recording, f64),
    loads: &[f64],
    metre: f64,
    (colour, dash, opacity): (Color32, LineStyle, f32),
) {
    // Where a tooth does not touch, nothing is drawn rather than a line at zero.
    let nodes = recording.x.len().max(1);
    for (tooth, loads) in loads.chunks(nodes).enumerate().filter(|(_, loads)| loads.iter().any(|load| *load != 0.0)) {
        let middle = tooth as f64 * recording.pitch;
        let points = recording.x.iter().zip(loads).map(|(x, load)| [(middle + x) * metre, load * 1e-3 / width]);
        let points: Vec<[f64; 2]> = points.collect();
        if opacity > 0.0 {
            let columns: Vec<[f64; 3]> = points.iter().map(|at| [at[0], at[1], 0.0]).collect();
            plot.add(between(&columns, colour.gamma_multiply(opacity)));
        }
        plot.line(line(&points, colour, 1.6, dash));
    }
}
