//! Small plots over the cycle, with a marker at the present phase.

use crate::gui::derived::format::number;
use crate::gui::derived::scales::Curve;
use crate::gui::ui::paint::{Axes, PlotStyle};
use eframe::egui::{Align2, Color32, Painter, Pos2, Rect, Stroke, pos2};

/// One curve of a small plot.
pub(super) struct Trace<'a> {
    pub(super) curve: &'a Curve,
    /// By how much of a cycle the curve is ahead.
    pub(super) lag: f64,
    /// Added to the values.
    pub(super) offset: f64,
    pub(super) colour: Color32,
}

/// A small plot over the cycle.
pub(super) struct Series<'a> {
    /// With the unit, long to short.
    pub(super) titles: &'a [&'a str],
    /// What the glossary explains it under.
    pub(super) word: &'a str,
    /// Shown at the right end of the title, if it fits.
    pub(super) legend: &'a [(&'a str, Color32)],
    pub(super) traces: &'a [Trace<'a>],
    /// Range of the values.
    pub(super) range: [f64; 2],
    /// Size of the unit in the title.
    pub(super) unit: f64,
    /// Period \[s\]; not a number for curves of several periods.
    pub(super) period: f64,
    /// Phase at which the markers stand.
    pub(super) phase: f64,
}

impl Series<'_> {
    /// Draws the plot into `rect`, its title above and the time below.
    pub(super) fn draw(&self, painter: &Painter, style: &PlotStyle, rect: Rect) -> Axes {
        // Of nothing at all the unit is the scale.
        let [low, high] = if self.range == [0.0; 2] { [-0.5, 0.5].map(|end| end * self.unit) } else { self.range };
        let margin = 0.08 * (high - low);
        let axes = Axes::new(rect, [0.0, 1.0], [low - margin, high + margin]);
        axes.canvas(painter, style);
        axes.y_ticks(painter, style, self.unit);
        style.title(painter, rect, self.word, self.titles, self.legend);
        let quiet = style.palette.quiet;
        let top = rect.bottom() + 1.0;
        let (scale, unit) = if self.period < 1e-3 { (1e6, "µs") } else { (1e3, "ms") };
        let (start, period) = if self.period.is_finite() {
            (format!("0 {unit}"), format!("{} {unit}", number(self.period * scale)))
        } else {
            ("0".to_owned(), "one cycle".to_owned())
        };
        let last = style.write(painter, pos2(rect.right(), top), Align2::RIGHT_TOP, &period, quiet);
        if style.width(painter, &start) + style.row < last.left() - rect.left() {
            style.write(painter, pos2(rect.left(), top), Align2::LEFT_TOP, &start, quiet);
        }
        let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
        inside.vline(axes.px(self.phase), rect.y_range(), Stroke::new(1.0, style.palette.accent));
        let samples = (0.5 * rect.width()).clamp(24.0, 240.0) as usize;
        for trace in self.traces {
            let point = |phase: f64| axes.at(phase, trace.offset + trace.curve.at(phase + trace.lag));
            let line: Vec<Pos2> = (0..=samples).map(|i| point(i as f64 / samples as f64)).collect();
            inside.line(line, Stroke::new(1.6, trace.colour));
            painter.circle(point(self.phase), 3.5, trace.colour, Stroke::new(1.0, style.palette.canvas));
        }
        axes
    }
}
