//! Small charts over the cycle, with a vertical line at the present phase, which can be dragged.

use super::inset::{Inset, chosen};
use crate::gui::command::Command;
use crate::gui::derived::scales::{SampledCurve, with_margin};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::PlotStyle;
use crate::gui::ui::plot::{dots, line, upright};
use eframe::egui::{Color32, Rect, Ui};
use egui_plot::LineStyle;

/// One curve of a small chart.
pub(super) struct Trace<'a> {
    pub(super) curve: &'a SampledCurve,
    /// Phase that the curve is ahead, in cycles.
    pub(super) lag: f64,
    /// Added to the values.
    pub(super) offset: f64,
    pub(super) colour: Color32,
    pub(super) dash: LineStyle,
}

/// A small chart over the cycle.
pub(super) struct Series<'a> {
    /// Unique name of the chart.
    pub(super) name: &'a str,
    /// Titles with the unit, long to short; the longest that fits is written.
    pub(super) titles: &'a [&'a str],
    /// Its glossary term.
    pub(super) word: &'a str,
    /// Shown at the right end of the title, if it fits.
    pub(super) legend: &'a [(&'a str, Color32)],
    pub(super) traces: &'a [Trace<'a>],
    /// Range of the values.
    pub(super) range: [f64; 2],
    /// Value of the unit in the title.
    pub(super) unit: f64,
    /// Period \[s\]; NaN for curves with different periods.
    pub(super) period: f64,
}

impl Series<'_> {
    /// Draws the chart into `rect`, with its title above, the time below, and numbers in the gutter at the left. A click, or a drag of the
    /// vertical line, chooses the phase.
    pub(super) fn show(&self, ui: &mut Ui, style: &PlotStyle, rect: Rect, cx: &DrawContext<'_>) {
        // If all values are zero, the range is one unit.
        let range = if self.range == [0.0; 2] { [-0.5, 0.5] } else { self.range.map(|end| end / self.unit) };
        let (scale, below) = match self.period {
            period if period < 1e-3 => (1e6 * period, "t, µs"),
            period if period.is_finite() => (1e3 * period, "t, ms"),
            _ => (1.0, "t/T"),
        };
        let now = cx.state.view.phase;
        style.title(rect, self.word, self.titles, self.legend);
        let name = format!("{}: click to jump there", self.name);
        let bounds = [[0.0, scale], with_margin(range, 0.08)];
        let inset = Inset { name: &name, rect, bounds, below: Some(below) };
        let samples = (0.5 * rect.width()).clamp(24.0, 240.0) as usize;
        let shown = inset.show(ui, style, |plot| {
            plot.vline(upright(now * scale, style.palette.accent, 1.0));
            for trace in self.traces {
                let point =
                    |phase: f64| [phase * scale, (trace.offset + trace.curve.at(phase + trace.lag)) / self.unit];
                let points: Vec<_> = (0..=samples).map(|i| point(i as f64 / samples as f64)).collect();
                plot.line(line(&points, trace.colour, 1.6, trace.dash));
                plot.points(dots("", vec![point(now)], trace.colour, 3.5));
            }
        });
        if let Some(x) = chosen(ui, &shown, Some(now * scale), &name) {
            cx.push(Command::Seek((x / scale).clamp(0.0, 1.0 - 1e-9)));
        }
    }
}
