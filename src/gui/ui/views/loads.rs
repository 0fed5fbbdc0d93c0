//! Contact pressure and film pressure along the wave, gauge, as in the paper's Fig. 4: line loads over the contact width.

use super::frame::Frame;
use crate::gui::ui::chart::{Inset, between, level, line, upright};
use crate::gui::ui::paint::PlotStyle;
use crate::problem::Motor;
use crate::recording::Recording;
use eframe::egui::{Rect, Ui};
use egui_plot::{LineStyle, PlotResponse, Span};

/// Name of the chart.
const NAME: &str = "Pressures along one wavelength: point to read values, click a tooth to follow it";

/// Draws both curves into `rect`, over x \[mm\]; the y axis is fixed over the cycle until it is zoomed.
pub(super) fn draw(ui: &mut Ui, style: &PlotStyle, rect: Rect, shown: &Frame<'_, Motor>) -> PlotResponse<()> {
    let kilo = 1e-3 / shown.of.contact_width;
    let (contact, film) = (style.palette.contact, style.palette.film);
    let title = [
        "Pressure on the teeth, mean over the width, kPa gauge",
        "Pressure on the teeth, kPa gauge",
        "Pressure, kPa gauge",
    ];
    let mut legend = vec![("contact", contact), ("film", film)];
    legend.extend(style.at_first(shown.first.as_ref()));
    style.title(ui.painter(), rect, "Gauge pressure", &title, &legend);
    let [low, high] = shown.ranges.loads.map(|load| load * kilo);
    let margin = 0.06 * (high - low).max(1e-3);
    let bounds = [shown.x_range().map(|x| x * 1e3), [low - margin, high + margin]];
    let inset = Inset { name: NAME, rect, bounds, below: None };
    inset.show(ui, style, |plot| {
        let [left, right] = shown.followed().map(|x| x * 1e3);
        let column = Span::new("", left..=right).fill(style.palette.accent.gamma_multiply(0.10));
        plot.span(column);
        plot.hline(level(0.0, style.palette.quiet, 1.0));
        if let Some(first) = &shown.first {
            let Frame { recording, of: motor, lines, .. } = &**first;
            for tooth in 0..recording.teeth {
                for field in [&lines.contact, &lines.film] {
                    let curve = curve(recording, motor, tooth, &field[lines.of(tooth)]);
                    plot.line(line(&curve, style.palette.quiet, 1.2, LineStyle::Solid));
                }
            }
        }
        for tooth in 0..shown.recording.teeth {
            let nodes = shown.lines.of(tooth);
            let curve = |field: &[f64]| curve(shown.recording, shown.of, tooth, &field[nodes.clone()]);
            let touching = curve(&shown.lines.contact);
            if touching.iter().any(|at| at[1] != 0.0) {
                let columns: Vec<[f64; 3]> = touching.iter().map(|at| [at[0], at[1], 0.0]).collect();
                plot.add(between(&columns, contact.gamma_multiply(0.35)));
                plot.line(line(&touching, contact, 1.8, LineStyle::Solid));
            }
            plot.line(line(&curve(&shown.lines.film), film, 1.8, LineStyle::Solid));
        }
        if let Some(x) = shown.view.cursor_x {
            plot.vline(upright(x * 1e3, style.palette.accent, 1.0));
        }
    })
}

/// The line loads of a tooth as pressures: (x \[mm\], pressure \[kPa\]).
fn curve(recording: &Recording, motor: &Motor, tooth: usize, loads: &[f64]) -> Vec<[f64; 2]> {
    let (middle, kilo) = (tooth as f64 * recording.pitch, 1e-3 / motor.contact_width);
    recording.x.iter().zip(loads).map(|(x, load)| [(middle + x) * 1e3, load * kilo]).collect()
}
