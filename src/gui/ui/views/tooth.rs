//! The followed tooth: its map, and its gap and loads over the cycle.

use super::field::{self, Stamp, y_labels};
use super::frame::Frame;
use super::series::{Series, Trace};
use crate::gui::derived::scales::span;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::PlotStyle;
use crate::problem::Motor;
use eframe::egui::{Rect, Ui, pos2};
use egui_plot::LineStyle;

/// Draws into `row`, including titles, charts and the axes below. Returns the areas of the two charts over the cycle.
pub(super) fn draw(
    ui: &mut Ui,
    style: &PlotStyle,
    row: Rect,
    shown: &Frame<'_, Motor>,
    cx: &DrawContext<'_>,
) -> [Rect; 2] {
    let recording = shown.recording;
    let inside = &style.within(row.expand(2.0 * style.row));
    let gap = 0.6 * style.row;
    let cell = (row.width() - 2.0 * gap) / 3.0;
    let places: [Rect; 3] = std::array::from_fn(|i| {
        let left = row.left() + i as f32 * (cell + gap) + style.gutter;
        Rect::from_min_max(
            pos2(left, row.top() + style.row + 4.0),
            pos2(left + cell - style.gutter, row.bottom() - style.row - 2.0),
        )
    });
    let reach = recording.map_x.last().copied().unwrap_or(0.0);
    let (x, range) = ([-reach, reach], shown.ranges.pressure);
    let stamp = Stamp { run: shown.run, place: shown.place, tooth: shown.tooth, x, range };
    let axes = field::draw(ui, inside, places[0], recording, "followed tooth", stamp);
    let long = format!("Tooth {}, x from its middle", shown.tooth);
    inside.title(places[0], "Followed tooth", &[&long, &format!("Tooth {}", shown.tooth)], &[]);
    y_labels(inside, &axes);
    axes.x_labels(inside, 1e-3, "x, mm");
    let middle = shown.tooth as f64 * recording.pitch;
    axes.cursor(inside, shown.view.cursor_x.map(|x| x - middle));

    let [_, gap_chart, loads_chart] = places;
    let Some((curves, lag)) = shown.scales.tooth(shown.tooth) else { return [gap_chart, loads_chart] };
    // The same tooth of the run for comparison is drawn behind it.
    let (quiet, dashed, solid) = (style.palette.quiet, LineStyle::dashed_dense(), LineStyle::Solid);
    let first = shown.first.as_ref().and_then(|first| Some((first, first.scales.tooth(shown.tooth)?)));
    let behind = style.at_first(first);
    let trace = |curve, lag, offset, colour, dash| Trace { curve, lag, offset, colour, dash };
    let before = first.map(|(first, (curves, lag))| trace(&curves.thickness, lag, -first.of.spacing(), quiet, dashed));
    let present = trace(&curves.thickness, lag, -shown.of.spacing(), style.text, solid);
    let ranges = before.iter().chain([&present]).map(|trace| trace.curve.range().map(|value| value + trace.offset));
    let [low, high] = span(ranges.flatten());
    let spacing: Vec<Trace<'_>> = before.into_iter().chain([present]).collect();
    let series = Series {
        name: "Least gap over the cycle",
        titles: &[&format!("Least gap of tooth {}, µm", shown.tooth), "Least gap, µm", "Gap, µm"],
        word: "Least gap",
        legend: behind.as_slice(),
        traces: &spacing,
        range: [low.min(0.0), high.max(0.0)],
        unit: 1e-6,
        period: recording.period,
    };
    series.show(ui, style, gap_chart, cx);
    let before = first
        .map(|(_, (curves, lag))| [&curves.contact, &curves.film].map(|curve| trace(curve, lag, 0.0, quiet, dashed)));
    let present = [(&curves.contact, style.palette.contact), (&curves.film, style.palette.film)];
    let present = present.map(|(curve, colour)| trace(curve, lag, 0.0, colour, solid));
    let loads: Vec<Trace<'_>> = before.into_iter().flatten().chain(present).collect();
    let legend = [("contact", style.palette.contact), ("film", style.palette.film)];
    let unit = if shown.ranges.tooth_load[1] > 2.0 { ("N", 1.0) } else { ("mN", 1e-3) };
    let series = Series {
        name: "Loads over the cycle",
        titles: &[
            &format!("Loads of tooth {}, {}", shown.tooth, unit.0),
            &format!("Tooth {}, {}", shown.tooth, unit.0),
        ],
        word: "Loads",
        legend: &legend,
        traces: &loads,
        range: shown.ranges.tooth_load,
        unit: unit.1,
        ..series
    };
    series.show(ui, style, loads_chart, cx);
    [gap_chart, loads_chart]
}
