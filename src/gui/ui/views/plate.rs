//! The plate: gap, pressure profile and map, load over the cycle, pressure–gap loop.

use super::field;
use super::frame::Frame;
use super::inset::Inset;
use super::pointer::{named, read_out, readout_height};
use super::series::{Series, Trace};
use super::velocity::FilmPosition;
use crate::gui::derived::format::{load_unit, number, times};
use crate::gui::derived::scales::with_margin;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{Axes, DrawingStack, PlotStyle};
use crate::gui::ui::plot::{dots, level, line, under_pointer};
use crate::problem::Plate;
use crate::recording::Recording;
use crate::recording::sample;
use eframe::egui::{self, Color32, CursorIcon, Rangef, Rect, Sense, Stroke, pos2};
use egui_plot::{LineStyle, PlotResponse};
use std::ops::RangeInclusive;

const LOOP_SAMPLES: u32 = 180;

type PlateFrame<'a> = Frame<'a, Plate>;

impl PlateFrame<'_> {
    fn thickness(&self) -> f64 {
        self.lines.film_thickness[0]
    }
}

pub(super) fn show(ui: &mut egui::Ui, area: Rect, shown: &PlateFrame<'_>, cx: &DrawContext<'_>) {
    let style = PlotStyle::new(ui);
    let inside = style.within(area);

    let (title, axis) = (style.title, style.axis);
    let reserved = readout_height(&LONGEST, &style, area.width());
    let with_map = shown.of.width.is_some();
    let heads = if with_map { 4.0 } else { 3.0 };
    let body = (area.height() - reserved - heads * title - 2.0 * axis - 6.0).max(60.0);
    let parts = if with_map { [0.23, 0.25, 0.20] } else { [0.28, 0.38, 0.0] };
    let mut column = DrawingStack::of(area, &style);
    let right = column.x.max;
    let mut next = |part: f32| column.next(title, part * body);
    let (wall, profile) = (next(parts[0]), next(parts[1]));
    let axes = draw_gap(&inside, wall, shown);
    let charted = draw_profile(ui, &style, profile, shown);
    let mut last = profile;
    if with_map {
        last = next(parts[2]);
        let titles = ["Pressure map, kPa absolute", "Map, absolute", "Map"];
        field::of_run(ui, &inside, last, shown, ("plate", &titles));
    }
    Axes::new(last, shown.x_range(), [0.0, 1.0]).x_labels(&inside, 1e-3, "x, mm");

    let bottom = (area.bottom() - reserved - axis).max(last.bottom() + axis + title + style.row);
    let count = if area.width() > 40.0 * style.row { 3 } else { 2 };
    // Between the last number of a chart and the name of the axis of the next.
    let between = 1.3 * style.row;
    let wide = (right - area.left() + between) / count as f32;
    let plots: Vec<Rect> = (0..count)
        .map(|i| {
            let left = area.left() + i as f32 * wide;
            let corner = pos2(left + style.gutter, last.bottom() + axis + title + 2.0);
            Rect::from_min_max(corner, pos2(left + wide - between, bottom))
        })
        .collect();
    draw_load(ui, &style, plots[0], shown, cx);
    draw_loop(ui, &style, plots[1], shown);
    if let Some(rect) = plots.get(2) {
        draw_velocity(ui, &style, *rect, shown);
    }
    let place = Rect::from_min_max(pos2(area.left(), area.bottom() - reserved), area.max);
    read_out(&readout(shown), &inside, place);

    let wall_response = named(ui, wall, "Plate along its length: point to read values", Sense::click());
    let name = "Pressure map of the plate: point to read values";
    let map_response = with_map.then(|| named(ui, last, name, Sense::click()));
    let painted = [Some(wall_response), map_response].into_iter().flatten();
    let painted =
        painted.filter_map(|response| axes.x_at(response.on_hover_cursor(CursorIcon::Crosshair).hover_pos()?.x));
    charted.response.on_hover_cursor(CursorIcon::Crosshair);
    if let Some(x) = painted.chain(charted.inner.map(|x| 1e-3 * x)).last() {
        cx.point_at(x);
    }
    for (name, rect) in [("gap", wall), ("pressure", profile), ("loads", plots[0]), ("loop", plots[1])] {
        cx.name_plot(ui, name, rect);
    }
    if with_map {
        cx.name_plot(ui, "map", last);
    }
    style.explain(ui);
}

/// The wall, the plate above it, the film between them.
fn draw_gap(style: &PlotStyle, rect: Rect, shown: &PlateFrame<'_>) -> Axes {
    let highest = shown.ranges.thickness[1].max(1e-9);
    let above = 0.26;
    let axes = Axes::of_heights(style, (rect, shown.x_range()), [0.0, highest], [0.16, above]);
    let title = format!("Gap {} µm, vertical {}", number(shown.thickness() * 1e6), times(axes.exaggeration()));
    let short = format!("Gap {} µm", number(shown.thickness() * 1e6));
    let legend = [("plate", style.palette.rotor), ("wall", style.palette.stator)];
    style.title(rect, "Gap", &[&title, &short], &legend);

    let style = &style.within(rect);
    let (wall, plate) = (axes.py(0.0), axes.py(shown.thickness()));
    for [left, right] in shown.of.spans().into_iter().map(|ends| ends.map(|x| axes.px(x))) {
        let film = Rect::from_x_y_ranges(left..=right, plate..=wall);
        style.painter.rect_filled(film, 0.0, style.palette.film.gamma_multiply(0.25));
    }
    wall_and_plate(style, &axes, shown.of, [wall, plate], 0.8 * above as f32 * rect.height());
    axes.cursor(style, shown.view.cursor_x);
    axes
}

/// The wall below one height, and above another one the plate, which keeps its thickness and moves.
pub(super) fn wall_and_plate(style: &PlotStyle, axes: &Axes, of: &Plate, [wall, under]: [f32; 2], thickness: f32) {
    let part = |x: Rangef, face: f32, heights: RangeInclusive<f32>, colour: Color32| {
        style.painter.rect_filled(Rect::from_x_y_ranges(x, heights), 0.0, style.solid(colour));
        style.painter.hline(x, face, Stroke::new(1.5, colour));
    };
    part(axes.rect.x_range(), wall, wall..=axes.rect.bottom(), style.palette.stator);
    for ends in of.spans() {
        let [left, right] = ends.map(|x| axes.px(x));
        part(Rangef::new(left, right), under, under - thickness..=under, style.palette.rotor);
    }
}

/// Pressure along x at y = 0, over x \[mm\].
fn draw_profile(ui: &mut egui::Ui, style: &PlotStyle, rect: Rect, shown: &PlateFrame<'_>) -> PlotResponse<Option<f64>> {
    let ambient = shown.of.gas.ambient_pressure;
    let [low, high] = shown.ranges.pressure;
    let range = with_margin([low.min(ambient), high.max(ambient)], 0.06);
    let bounds = [shown.x_range().map(|x| x * 1e3), range.map(|pressure| pressure * 1e-3)];
    let title = if shown.of.width.is_some() { "Pressure at y = 0, kPa absolute" } else { "Pressure, kPa absolute" };
    let (film, quiet) = (style.palette.film, style.palette.quiet);
    let behind = style.at_first(shown.first.as_ref());
    // Both are grey; the ambient line is fainter if the run for comparison is drawn too, so that they can be distinguished.
    let faint = if behind.is_some() { quiet.gamma_multiply(0.55) } else { quiet };
    let legend: Vec<_> = [("film", film)].into_iter().chain(behind).chain([("ambient", faint)]).collect();
    style.title(rect, "Film pressure", &[title, "p, kPa absolute"], &legend);
    let name = "Pressure along the plate: point to read values";
    Inset { name, rect, bounds, below: None }.show(ui, style, |plot| {
        plot.hline(level(ambient * 1e-3, faint, 1.0));
        if let Some(first) = &shown.first {
            plot.line(line(&profile(first.recording, first.place), quiet, 1.4, LineStyle::dashed_loose()));
        }
        plot.line(line(&profile(shown.recording, shown.place), film, 1.8, LineStyle::Solid));
        under_pointer(plot, shown.view.cursor_x.map(|x| x * 1e3), style.palette.accent);
    })
}

/// Absolute pressure at y = 0 from end to end: (x \[mm\], pressure \[kPa\]).
pub(super) fn profile(recording: &Recording, place: f64) -> Vec<[f64; 2]> {
    let at = |x: f64| Some([x * 1e3, sample::middle_pressure(recording, 0, x, place)? * 1e-3]);
    let mirrored = recording.map_x.iter().rev().filter(|x| recording.half_length && **x > 0.0).map(|x| -x);
    mirrored.chain(recording.map_x.iter().copied()).filter_map(at).collect()
}

fn draw_load(ui: &mut egui::Ui, style: &PlotStyle, place: Rect, shown: &PlateFrame<'_>, cx: &DrawContext<'_>) {
    let Some((curves, lag)) = shown.scales.tooth(0) else { return };
    let [low, high] = shown.ranges.tooth_load;
    let (name, unit) = load_unit(high.max(-low), shown.of.is_strip());
    let trace = |curve, lag, colour, dash| Trace { curve, lag, offset: 0.0, colour, dash };
    let first = shown.first.as_ref().and_then(|first| first.scales.tooth(0));
    let first = first.map(|(curves, lag)| trace(&curves.film, lag, style.palette.quiet, LineStyle::dashed_dense()));
    let legend = style.at_first(first.as_ref());
    let present = trace(&curves.film, lag, style.palette.film, LineStyle::Solid);
    let series = Series {
        name: "Load over the cycle",
        titles: &[&format!("Film load, {name}")],
        word: "Film load",
        legend: legend.as_slice(),
        traces: &first.into_iter().chain([present]).collect::<Vec<_>>(),
        range: [low, high],
        unit,
        period: shown.recording.period,
    };
    series.show(ui, style, place, cx);
}

/// Velocity across the film under the pointer, or else half-way between the middle and the end of the plate, or between the rims of a ring.
fn draw_velocity(ui: &mut egui::Ui, style: &PlotStyle, place: Rect, shown: &PlateFrame<'_>) {
    let Some((curves, _)) = shown.scales.tooth(0) else { return };
    let [left, right] = shown.x_range();
    let usual = match shown.of.spans()[..] {
        [_, [inner, outer]] => 0.5 * (inner + outer),
        _ => 0.5 * right,
    };
    let xi = shown.view.cursor_x.unwrap_or(usual).clamp(left, right);
    let frames = shown.recording.frames.max(1) as f64;
    let thickness = |instant: f64| Some(curves.thickness.at(instant / frames));
    let of = FilmPosition { shown, gas: &shown.of.gas, tooth: 0, xi, walls: &|_| [0.0; 2], thickness: &thickness };
    of.draw(ui, style, place);
}

/// Mean gauge pressure over the gap for one cycle.
fn draw_loop<'a>(ui: &mut egui::Ui, style: &PlotStyle, place: Rect, shown: &'a PlateFrame<'a>) {
    let area = shown.of.area();
    let ranges = [shown.ranges.thickness.map(|gap| gap * 1e6), shown.ranges.tooth_load.map(|load| load / area * 1e-3)];
    let of = |shown: &'a PlateFrame<'a>, colour: Color32| -> Option<Loop<'a>> {
        let ((curves, _), area) = (shown.scales.tooth(0)?, shown.of.area());
        let at = move |phase: f64| [curves.thickness.at(phase) * 1e6, curves.film.at(phase) / area * 1e-3];
        Some((colour, LineStyle::Solid, Box::new(at)))
    };
    let first = shown.first.as_deref().and_then(|first| of(first, style.palette.quiet));
    let legend = style.at_first(first.as_ref());
    let Some(present) = of(shown, style.palette.film) else { return };
    let loops: Vec<Loop<'_>> = first.into_iter().chain([present]).collect();
    show_loops(ui, style, place, ("gap, µm", ranges), (&loops, legend.as_slice()), shown.phase());
}

/// The colour and the dashes of a curve, and the curve over the phase.
pub(super) type Loop<'a> = (Color32, LineStyle, Box<dyn Fn(f64) -> [f64; 2] + 'a>);

/// Curves of mean gauge pressure \[kPa\] over the gap for one cycle, with dots at `phase`. `along` is the name of the gap's axis, and the
/// ranges of both axes.
pub(super) fn show_loops(
    ui: &mut egui::Ui,
    style: &PlotStyle,
    rect: Rect,
    (along, ranges): (&str, [[f64; 2]; 2]),
    (loops, legend): (&[Loop<'_>], &[(&str, Color32)]),
    phase: f64,
) {
    let bounds = ranges.map(|range| with_margin(range, 0.08));
    let titles = [
        "Mean pressure against the gap, kPa gauge",
        "Mean pressure, kPa gauge",
        "Mean p, kPa gauge",
        "p, kPa gauge",
        "p, kPa",
    ];
    style.title(rect, "Loop", &titles, legend);
    let name = "Mean pressure against the gap";
    Inset { name, rect, bounds, below: Some(along) }.show(ui, style, |plot| {
        plot.hline(level(0.0, style.palette.quiet, 1.0));
        for (colour, dash, at) in loops {
            let points: Vec<_> = (0..=LOOP_SAMPLES).map(|i| at(f64::from(i) / f64::from(LOOP_SAMPLES))).collect();
            plot.line(line(&points, *colour, 1.6, *dash));
            plot.points(dots("", vec![at(phase)], *colour, 3.5));
        }
    });
}

const LONGEST: [&str; 4] = ["x −00.00 mm", "gap 0.0000 µm", "p(y = 0) = 0000 kPa absolute", "load −0000 mN/m"];

fn readout(shown: &PlateFrame<'_>) -> Vec<String> {
    let [left, right] = shown.x_range();
    let Some(x) = shown.view.cursor_x.filter(|x| (left..=right).contains(x)) else {
        return vec!["Point at a view to read its values".to_owned()];
    };
    // A ring has no gap in its hole.
    let gap = match shown.of.hole {
        Some(hole) if x.abs() < hole => "hole".to_owned(),
        _ => format!("gap {} µm", number(shown.thickness() * 1e6)),
    };
    let mut values = vec![format!("x {} mm", number(x * 1e3)), gap];
    if let Some(pressure) = sample::middle_pressure(shown.recording, 0, x, shown.place) {
        let place = if shown.of.width.is_some() { "p(y = 0)" } else { "p" };
        values.push(format!("{place} = {} kPa absolute", number(pressure / 1e3)));
    }
    if let Some((curves, lag)) = shown.scales.tooth(0) {
        let load = curves.film.at(shown.phase() + lag);
        let [low, high] = shown.ranges.tooth_load;
        let (name, unit) = load_unit(high.max(-low), shown.of.is_strip());
        values.push(format!("load {} {name}", number(load / unit)));
    }
    values
}
