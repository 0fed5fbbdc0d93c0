//! Several runs at the same phase of their own cycles: surfaces, pressures and loads are overlaid, pressure maps are beside each other with
//! one colour scale. Motors and plates are drawn separately, because they have no axis in common.

use super::field::{self, Stamp};
use super::inset::Inset;
use super::loads::pressure;
use super::plate::{Loop, profile, show_loops};
use super::pointer::named;
use super::series::{Series, Trace};
use crate::fidelity::Fidelity;
use crate::gui::derived::format::{number, times};
use crate::gui::derived::scales::{RunCurves, SampledCurve, span, with_margin};
use crate::gui::state::pins::Pin;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{Axes, DrawingStack, PlotStyle, has_fields};
use crate::gui::ui::plot::{level, line, stroked, under_pointer};
use crate::gui::ui::theme::{run_colour, run_dash};
use crate::problem::{Motor, Plate, Scenario};
use crate::recording::Recording;
use crate::recording::sample::{self, Lines};
use eframe::egui::{self, Color32, CursorIcon, Rect, Response, Sense, Stroke, Ui, pos2, vec2};
use egui_plot::{LineStyle, PlotResponse};

/// Relative difference below which wavelengths, or lengths of plates, are the same.
const SAME: f64 = 1e-9;
/// Heights of the drawings, in lines of text: least of a plot, of a map of a motor, of a map of a plate.
const LEAST_PLOT: f32 = 3.8;
const LEAST_MAP: f32 = 1.8;
const MOST_MAP: f32 = 4.0;
const PLATE_MAP: f32 = 7.0;

/// A pinned motor or plate at the present instant.
struct Pinned<'a, T> {
    /// The pin, with scales and curves of its cycle.
    pin: &'a Pin,
    label: &'a str,
    colour: Color32,
    dash: LineStyle,
    recording: &'a Recording,
    of: &'a T,
    place: f64,
    lines: Lines,
}

impl<T> Pinned<'_, T> {
    /// Draws its map over this range of x \[m\], with colours for this range, and a strip in the run's own colour at the left. `name` is
    /// the name of the picture.
    fn map(&self, ui: &Ui, style: &PlotStyle, rect: Rect, name: &str, (x, range): ([f64; 2], [f64; 2])) -> Axes {
        let stamp = Stamp { run: (self.pin.id, Fidelity::Draft), place: self.place, tooth: 0, x, range };
        let axes = field::draw(ui, style, rect, self.recording, name, stamp);
        let strip = Rect::from_min_max(pos2(rect.left() - 9.0, rect.top()), pos2(rect.left() - 4.0, rect.bottom()));
        if self.dash == LineStyle::Solid {
            style.painter.rect_filled(strip, 1.0, self.colour);
        } else {
            let ends = [strip.center_top(), strip.center_bottom()];
            style.painter.extend(stroked(&ends, Stroke::new(strip.width(), self.colour), self.dash));
        }
        let [low, high] = range.map(|pressure| number(pressure / 1e3));
        named(ui, rect, &format!("Pressure map of {}, colours from {low} to {high} kPa", self.label), Sense::hover());
        axes
    }
}

/// Draws the pinned runs at the view's phase; scrolls if there is not enough space.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let (mut motors, mut plates) = (Vec::new(), Vec::new());
    for (pin, run) in cx.state.pins.pins.iter().zip(&cx.state.pins.runs) {
        let Ok(recording) = run.solved.as_ref().map(|solution| &solution.recording) else { continue };
        if !has_fields(recording) {
            continue;
        }
        let (label, place) = (&*run.label, cx.state.view.place(recording));
        let (colour, dash) = (run_colour(pin.slot, cx.state.dark), run_dash(pin.slot));
        let lines = Lines::at(recording, place);
        match &run.problem.scenario {
            Scenario::Motor(of) => motors.push(Pinned { pin, label, colour, dash, recording, of, place, lines }),
            Scenario::Plate(of) => plates.push(Pinned { pin, label, colour, dash, recording, of, place, lines }),
        }
    }
    let mixed = !motors.is_empty() && !plates.is_empty();
    let height = ui.available_height();
    egui::ScrollArea::vertical().id_salt("overlaid").auto_shrink(false).show(ui, |ui| {
        if mixed {
            let text = "Motors and plates cannot be laid over each other: a wave and a plate have no axis in common. Each \
                        kind has its own drawings; the numbers that both have are under Numbers.";
            cx.note(ui, text);
        }
        let share = if mixed { 0.8 * height } else { ui.available_height() };
        if !motors.is_empty() {
            draw_motors(ui, &motors, share, cx);
        }
        if !plates.is_empty() {
            draw_plates(ui, &plates, share, cx);
        }
    });
}

/// Allocates the whole width and this height.
fn take(ui: &mut Ui, height: f32) -> Rect {
    let size = vec2(ui.available_width().min(6000.0), height.min(20_000.0));
    ui.allocate_exact_size(size, Sense::hover()).0
}

/// An x axis for lengths: in metres if all runs have the same length, otherwise in lengths of each run.
struct Along {
    alike: bool,
    first: f64,
}

impl Along {
    fn of(mut lengths: impl Iterator<Item = f64>) -> Self {
        let first = lengths.next().unwrap_or(1.0);
        Self { alike: lengths.all(|length| (length / first - 1.0).abs() < SAME), first }
    }

    /// Units of the axis per metre, for a run of this length \[m\].
    fn metre(&self, length: f64) -> f64 {
        if self.alike { 1.0 } else { 1.0 / length }
    }

    /// Factor from units of the axis to the numbers that are written.
    fn written(&self) -> f64 {
        if self.alike { 1e3 } else { 1.0 }
    }

    /// Units of the axis per metre of the first run, to which the x shared by all views refers.
    fn of_first(&self) -> f64 {
        self.metre(self.first)
    }

    /// Tells the other views where the pointer is on the axis, and shows the values of all `runs` there: `of` writes those of one run,
    /// below `heads`. `lengths` is the unit of the axis if the lengths differ.
    fn read<T>(
        &self,
        (response, x): (Response, Option<f64>),
        (lengths, heads): (&str, &[&str]),
        runs: &[Pinned<'_, T>],
        cx: &DrawContext<'_>,
        of: impl Fn(&mut Ui, &Pinned<'_, T>, f64),
    ) {
        let response = response.on_hover_cursor(CursorIcon::Crosshair);
        let Some(x) = x else { return };
        cx.point_at(x / self.of_first());
        response.on_hover_ui_at_pointer(|ui| {
            let (value, unit) = if self.alike { (x * 1e3, "mm") } else { (x, lengths) };
            ui.label(format!("x {} {unit}", number(value)));
            egui::Grid::new(lengths).spacing([12.0, 2.0]).show(ui, |ui| {
                ui.weak("");
                heads.iter().for_each(|head| drop(ui.weak(*head)));
                ui.end_row();
                for run in runs {
                    ui.colored_label(run.colour, run.label);
                    of(ui, run, x);
                    ui.end_row();
                }
            });
        });
    }
}

fn draw_motors(ui: &mut Ui, runs: &[Pinned<'_, Motor>], height: f32, cx: &DrawContext<'_>) {
    let style = PlotStyle::new(ui);
    let (title, axis) = (style.title, style.axis);
    let count = runs.len() as f32;
    let gap = 4.0;
    let fixed = 5.0 * title + 2.0 * axis + (count - 1.0) * gap + 8.0;
    let least = fixed + 4.0 * LEAST_PLOT * style.row + count * LEAST_MAP * style.row;
    let area = take(ui, height.max(least));
    let inside = style.within(area);
    let body = area.height() - fixed;
    let map = (0.20 * body / count).clamp(LEAST_MAP * style.row, MOST_MAP * style.row);
    let rest = body - count * map;
    let mut column = DrawingStack::of(area, &style);
    let right = column.x.max;
    let wave = column.next(title, 0.36 * rest);
    let contact = column.next(title, 0.21 * rest);
    let film = column.next(title, 0.21 * rest);
    let maps: Vec<Rect> = (0..runs.len()).map(|i| column.next(if i == 0 { title } else { gap }, map)).collect();
    let loads = column.next(axis + title, 0.22 * rest);

    let along = Along::of(runs.iter().map(|run| run.recording.length));
    let ends = runs.iter().map(|run| {
        let (half, metre) = (0.5 * run.recording.pitch, along.metre(run.recording.length));
        [-half * metre, (run.recording.length - half) * metre]
    });
    let x = span(ends.flatten());
    let cursor = cx.state.view.cursor_x.map(|x| x * along.of_first());

    let axes = draw_surfaces(&inside, wave, runs, x, &along, cursor);
    let names = [("Contact pressure, kPa", "Contact pressure"), ("Film pressure, kPa gauge", "Gauge pressure")];
    let charts = [0, 1]
        .map(|field| draw_pressure(ui, &style, [contact, film][field], runs, (x, &along, cursor), names[field], field));

    let range = span(runs.iter().flat_map(|run| run.pin.curves.scales.ranges.pressure));
    let titles = [
        "Pressure maps of the film, kPa absolute, one scale of colours",
        "Pressure maps, absolute, one scale",
        "Maps, one scale",
        "Maps",
    ];
    inside.title_with_bar(maps[0], "Pressure map", &titles, range);
    for (slot, (run, rect)) in runs.iter().zip(&maps).enumerate() {
        let metre = along.metre(run.recording.length);
        // x is in metres of this run, so that its own teeth are found.
        let x = x.map(|x| x / metre);
        let axes = run.map(ui, &inside, *rect, &format!("overlaid motor {slot}"), (x, range));
        axes.cursor(&inside, cursor.map(|x| x / metre));
    }
    if let Some(last) = maps.last() {
        let name = if along.alike { "x, mm" } else { "x/λ" };
        Axes::new(*last, x, [0.0, 1.0]).x_labels(&inside, 1.0 / along.written(), name);
    }

    let middle = 0.5 * (area.left() + right);
    let halves = [(column.x.min, middle - 0.4 * style.row), (middle + 0.4 * style.row + style.gutter, right)];
    type Of = fn(&RunCurves) -> &SampledCurve;
    let curves: [(&str, Of); 2] = [
        ("Film load on one wave, N", |curves| &curves.film),
        ("Contact load on one wave, N", |curves| &curves.contact),
    ];
    for ((left, right), (title, of)) in halves.into_iter().zip(curves) {
        let place = Rect::from_x_y_ranges(left..=right, loads.y_range());
        over_cycle(ui, &style, (place, title), runs, of, 1.0, cx);
    }

    let maps = maps.iter().copied().reduce(Rect::union).unwrap_or(wave);
    let names =
        ["Motors along one wavelength: point to read values", "Pressure maps of the motors: point to read values"];
    let painted = [(wave, names[0]), (maps, names[1])].map(|(rect, name)| {
        let response = named(ui, rect, name, Sense::click());
        let x = response.hover_pos().and_then(|at| axes.x_at(at.x));
        (response, x)
    });
    let on_a_term = style.explain(ui);
    let charts = charts.map(|chart| (chart.response, chart.inner.map(|x| x / along.written())));
    let heads = ["gap, nm", "contact, kPa", "film, kPa gauge"];
    for (response, x) in painted.into_iter().chain(charts) {
        let at = (response, x.filter(|_| !on_a_term));
        along.read(at, ("λ", &heads), runs, cx, |ui, run, x| values(ui, run, x / along.metre(run.recording.length)));
    }
}

/// The curves `of` all runs over the cycle; the cycles have different lengths.
fn over_cycle<T>(
    ui: &mut Ui,
    style: &PlotStyle,
    (place, title): (Rect, &str),
    runs: &[Pinned<'_, T>],
    of: fn(&RunCurves) -> &SampledCurve,
    unit: f64,
    cx: &DrawContext<'_>,
) {
    let traces: Vec<_> = runs
        .iter()
        .map(|run| Trace { curve: of(&run.pin.curves), lag: 0.0, offset: 0.0, colour: run.colour, dash: run.dash })
        .collect();
    let range = span(traces.iter().map(|trace| trace.curve.range()).chain([[0.0, 0.0]]).flatten());
    let period = Along::of(runs.iter().map(|run| run.recording.period));
    let period = if period.alike { period.first } else { f64::NAN };
    let word = title.split(',').next().unwrap_or(title);
    let short = title.replace(" on one wave", "");
    let series =
        Series { name: title, titles: &[title, &short], word, legend: &[], traces: &traces, range, unit, period };
    series.show(ui, style, place, cx);
}

fn draw_surfaces(
    style: &PlotStyle,
    rect: Rect,
    runs: &[Pinned<'_, Motor>],
    x: [f64; 2],
    along: &Along,
    cursor: Option<f64>,
) -> Axes {
    let heights = runs.iter().map(|run| {
        let scales = &run.pin.curves.scales.ranges;
        [scales.stator[0], (scales.rotor[1] - run.of.spacing()).max(scales.stator[1])]
    });
    let [low, high] = span(heights.flatten());
    let margin = 0.08 * (high - low).max(1e-9);
    let axes = Axes::of_heights(style, (rect, x), [low - margin, high + margin], [0.0, 0.0]);
    let vertical = times(axes.exaggeration() / along.of_first());
    let titles = [
        format!("Rotor undersides (thick) over tooth tops (thin), vertical {vertical}"),
        format!("Rotor (thick), teeth (thin), {vertical}"),
        "Rotor and teeth".to_owned(),
    ];
    style.title(rect, "Travelling wave", &titles.each_ref().map(String::as_str), &[]);
    let style = &style.within(rect);
    axes.x_grid(style, 1.0 / along.written());
    for run in runs {
        let metre = along.metre(run.recording.length);
        for tooth in 0..run.recording.teeth {
            let middle = tooth as f64 * run.recording.pitch;
            let top = run.recording.x.iter().zip(&run.lines.stator[run.lines.of(tooth)]);
            let top: Vec<_> = top.map(|(x, height)| axes.at((middle + x) * metre, *height)).collect();
            style.painter.extend(stroked(&top, Stroke::new(1.0, run.colour), run.dash));
        }
        let underside = run.lines.underside(run.recording);
        let underside: Vec<_> = underside.iter().map(|[x, height]| axes.at(x * metre, *height)).collect();
        style.painter.extend(stroked(&underside, Stroke::new(2.2, run.colour), run.dash));
    }
    axes.cursor(style, cursor);
    axes
}

fn draw_pressure(
    ui: &mut Ui,
    style: &PlotStyle,
    rect: Rect,
    runs: &[Pinned<'_, Motor>],
    (x, along, cursor): ([f64; 2], &Along, Option<f64>),
    (name, word): (&str, &str),
    field: usize,
) -> PlotResponse<Option<f64>> {
    let kilo = |run: &Pinned<'_, Motor>| 1e-3 / run.of.contact_width;
    let ranges = runs.iter().map(|run| run.pin.curves.lines[field].map(|load| load * kilo(run)));
    let [low, high] = span(ranges.chain([[0.0, 0.0]]).flatten());
    let margin = 0.06 * (high - low).max(1e-3);
    let written = along.written();
    style.title(rect, word, &[name], &[]);
    let bounds = [x.map(|x| x * written), [low - margin, high + margin]];
    Inset { name, rect, bounds, below: None }.show(ui, style, |plot| {
        plot.hline(level(0.0, style.palette.quiet, 1.0));
        for run in runs {
            let metre = along.metre(run.recording.length) * written;
            let loads = [&run.lines.contact, &run.lines.film][field];
            pressure(plot, (run.recording, run.of.contact_width), loads, metre, (run.colour, run.dash, 0.16));
        }
        under_pointer(plot, cursor.map(|x| x * written), style.palette.accent);
    })
}

/// Values of a motor at x \[m\].
fn values(ui: &mut Ui, run: &Pinned<'_, Motor>, x: f64) {
    let (tooth, xi) = sample::tooth_at(x, run.recording.pitch, run.recording.teeth);
    let Some(node) = sample::locate(&run.recording.x, xi) else { return drop(ui.weak("groove")) };
    let at = |field: &[f64]| sample::between(&field[run.lines.of(tooth)], node);
    let gap = at(&run.lines.film_thickness) - run.of.spacing();
    ui.label(number(gap.max(0.0) * 1e9));
    for field in [&run.lines.contact, &run.lines.film] {
        ui.label(number(at(field) / run.of.contact_width / 1e3));
    }
}

fn draw_plates(ui: &mut Ui, runs: &[Pinned<'_, Plate>], height: f32, cx: &DrawContext<'_>) {
    let style = PlotStyle::new(ui);
    let (title, axis) = (style.title, style.axis);
    let with_map: Vec<&Pinned<'_, Plate>> = runs.iter().filter(|run| run.of.width.is_some()).collect();
    let columns = with_map.len().clamp(1, 3);
    let rows = with_map.len().div_ceil(columns) as f32;
    let map = PLATE_MAP * style.row;
    let fixed = 2.0 * title + 2.0 * axis + 8.0 + if rows > 0.0 { title + rows * (map + 6.0) } else { 0.0 };
    let area = take(ui, height.max(fixed + 3.2 * LEAST_PLOT * style.row));
    let inside = style.within(area);
    let body = area.height() - fixed;
    let mut column = DrawingStack::of(area, &style);
    let (start, right) = (column.x.min, column.x.max);

    // Pressure along the plates.
    let chart = column.next(title, 0.52 * body);
    let along = Along::of(runs.iter().map(|run| run.of.length));
    let x = span(runs.iter().flat_map(|run| [-0.5, 0.5].map(|x| x * run.of.length * along.metre(run.of.length))));
    let cursor = cx.state.view.cursor_x.map(|x| x * along.of_first());
    let range = span(runs.iter().flat_map(|run| run.pin.curves.scales.ranges.pressure));
    let ambient = span(runs.iter().flat_map(|run| [run.of.gas.ambient_pressure; 2]));
    let pressures = span([range, ambient].into_iter().flatten()).map(|pressure| pressure * 1e-3);
    let titles = ["Pressure along the plate at y = 0, kPa absolute", "Pressure, kPa absolute"];
    inside.title(chart, "Film pressure", &titles, &[]);
    let written = along.written();
    let bounds = [x.map(|x| x * written), with_margin(pressures, 0.06)];
    let name = "Plates along their length: point to read values";
    // For round plates the length is the diameter.
    let round = runs.iter().all(|run| run.recording.radial);
    let (below, lengths) = if round { ("x/D", "diameters") } else { ("x/length", "lengths") };
    let below = Some(if along.alike { "x, mm" } else { below });
    let charted = Inset { name, rect: chart, bounds, below }.show(ui, &style, |plot| {
        for run in runs {
            plot.hline(level(1e-3 * run.of.gas.ambient_pressure, style.palette.quiet, 1.0));
            let to_axis = 1e-3 * along.metre(run.of.length) * written;
            let points: Vec<_> = profile(run.recording, run.place).iter().map(|[x, p]| [x * to_axis, *p]).collect();
            plot.line(line(&points, run.colour, 1.8, run.dash));
        }
        under_pointer(plot, cursor.map(|x| x * written), style.palette.accent);
    });
    column.bottom += axis;

    // Maps, of plates that have a width.
    let mut row = chart;
    for (slot, run) in with_map.iter().enumerate() {
        if slot.is_multiple_of(columns) {
            row = column.next(if slot == 0 { title } else { 6.0 }, map);
        }
        if slot == 0 {
            let titles = ["Pressure maps, kPa absolute, one scale of colours", "Maps, one scale", "Maps"];
            inside.title_with_bar(row, "Pressure map", &titles, range);
        }
        let (beside, step) = ((slot % columns) as f32, (right - start) / columns as f32);
        let left = start + beside * step;
        let rect = row.with_min_x(left + if beside > 0.0 { 16.0 } else { 0.0 }).with_max_x(left + step);
        let x = [-0.5, 0.5].map(|x| x * run.of.length);
        run.map(ui, &inside, rect, &format!("overlaid plate {slot}"), (x, range));
    }

    // Over the cycle, and against the gap.
    let (plots, bottom) = (column.bottom + title, area.bottom() - axis);
    let middle = 0.5 * (area.left() + right);
    let left = Rect::from_min_max(pos2(start, plots), pos2(middle - 2.2 * style.row, bottom));
    let right = Rect::from_min_max(pos2(middle + 0.4 * style.row + style.gutter, plots), pos2(right, bottom));
    over_cycle(ui, &style, (left, "Mean pressure, kPa gauge"), runs, |curves| &curves.film, 1e3, cx);
    draw_loops(ui, &style, right, runs, cx.state.view.phase);

    let on_a_term = style.explain(ui);
    let at = (charted.response, charted.inner.map(|x| x / written).filter(|_| !on_a_term));
    along.read(at, (lengths, &["p, kPa absolute"]), runs, cx, |ui, run, x| {
        let pressure = sample::middle_pressure(run.recording, 0, x / along.metre(run.of.length), run.place);
        ui.label(pressure.map_or_else(String::new, |pressure| number(pressure / 1e3)));
    });
}

/// Mean gauge pressure against the gap over its mean.
fn draw_loops(ui: &mut Ui, style: &PlotStyle, place: Rect, runs: &[Pinned<'_, Plate>], phase: f64) {
    let loads = span(runs.iter().map(|run| run.pin.curves.film.range()).chain([[0.0, 0.0]]).flatten());
    let gaps =
        span(runs.iter().flat_map(|run| run.pin.curves.scales.ranges.thickness.map(|gap| gap / run.of.mean_gap)));
    let kept = runs.iter().filter_map(|run| {
        let (curves, _) = run.pin.curves.scales.tooth(0)?;
        let at = move |phase: f64| [curves.thickness.at(phase) / run.of.mean_gap, 1e-3 * run.pin.curves.film.at(phase)];
        Some((run.colour, run.dash, Box::new(at) as _))
    });
    let kept: Vec<Loop<'_>> = kept.collect();
    show_loops(ui, style, place, ("gap/mean", [gaps, loads.map(|load| load * 1e-3)]), (&kept, &[]), phase);
}
