//! The held plate: the plate above its stator, which can be dragged; the force on it; the pressure below it; both over time, and the
//! pressure over the gap with Boyle's hyperbola.

use super::field::{self, Stamp, y_labels};
use super::inset::Inset;
use super::plate::wall_and_plate;
use super::pointer::named;
use crate::fidelity::Fidelity;
use crate::gui::command::HoldCommand;
use crate::gui::derived::format::{load_unit, number, time, times, with_known_digits};
use crate::gui::derived::scales::{span, with_margin};
use crate::gui::state::hold::HoldState;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{Axes, DrawingStack, PlotStyle, colour_between, room};
use crate::gui::ui::plot::{between, dots, level, line};
use crate::hold::Reading;
use crate::problem::Plate;
use crate::recording::{LineLoads, Recording};
use eframe::egui::epaint::Shape;
use eframe::egui::{self, Align2, Color32, CursorIcon, Pos2, Rect, Sense, Stroke, Ui, pos2, vec2};
use egui_plot::LineStyle;

/// Shares of the drawing below the stator's face, and above the highest position of the plate's underside.
const BELOW: f64 = 0.10;
const ABOVE: f64 = 0.20;
/// Part of the drawing that is the plate.
const PLATE: f32 = 0.15;
/// Longest arrow, as a share of the drawing.
const ARROW: f32 = 0.42;
/// The drawing, the profile and the map, as shares of the height that the charts leave; the charts, as a share of the whole height.
const PARTS: [f32; 2] = [0.66, 0.34];
const PARTS_WITH_MAP: [f32; 3] = [0.52, 0.26, 0.22];
const CHARTS: f32 = 0.34;
/// If the area is this many times as wide as high, the charts are beside the plate, which takes this share of the width.
const WIDE: f32 = 1.8;
const BESIDE: f32 = 0.55;
const SAMPLES: usize = 80;

/// Draws into the remaining area of `ui`.
pub fn show(ui: &mut Ui, hold: &HoldState, cx: &DrawContext<'_>) {
    let Some(area) = room(ui) else { return };
    let style = PlotStyle::new(ui);
    let clipped = style.within(area);
    let plate = &hold.plate;
    let (unit, half) = (unit(plate), 0.5 * plate.length);
    let (title, axis) = (style.title, style.axis);
    let with_map = plate.width.is_some();
    let parts: &[f32] = if with_map { &PARTS_WITH_MAP } else { &PARTS };
    let charts = (CHARTS * area.height()).max(6.0 * style.row + title + axis);
    let (views, charts) = if area.width() > WIDE * area.height() {
        area.split_left_right_at_fraction(BESIDE)
    } else {
        area.split_top_bottom_at_y(area.bottom() - charts)
    };
    let body = (views.height() - parts.len() as f32 * title - axis).max(40.0);
    let mut column = DrawingStack::of(views, &style);
    let mut next = |part: f32| column.next(title, part * body);
    let drawing = next(parts[0]);
    let profile_place = next(parts[1]);
    let axes = draw_plate(&clipped, drawing, hold);
    profile(ui, &style, profile_place, hold);
    let mut last = profile_place;
    if with_map {
        last = next(parts[2]);
        map(ui, &clipped, last, hold);
    }
    Axes::new(last, [-half, half], [0.0, 1.0]).x_labels(&clipped, 1e-3, "x, mm");

    let top = charts.top() + title;
    let (right, bottom) = (charts.right() - 0.5 * style.row, charts.bottom() - axis);
    let middle = charts.left() + 0.56 * (right - charts.left());
    let place = |left: f32, right: f32, top: f32, bottom: f32| {
        Rect::from_min_max(pos2(left + style.gutter, top), pos2(right, bottom.max(top + 8.0)))
    };
    let between = 0.5 * (bottom - top - title);
    let left_end = middle - 0.5 * style.row;
    let gap_chart = place(charts.left(), left_end, top, top + between);
    let force_chart = place(charts.left(), left_end, top + between + title, bottom);
    let rotor = style.palette.rotor;
    let gap = Trail {
        title: "Gap, µm",
        unit: 1e-6,
        colour: rotor,
        of: |r| [r.gap, 0.0],
        reach: hold.reach(),
        rest: plate.mean_gap,
    };
    gap.show(ui, &style, gap_chart, hold);
    let (title, film) = (&format!("Force, {}", unit.0), style.palette.film);
    let of = |r: &Reading| [r.force, r.error];
    let force = Trail { title, unit: unit.1, colour: film, of, reach: hold.force_range, rest: 0.0 };
    force.show(ui, &style, force_chart, hold);
    time_labels(&clipped, force_chart, hold.window());
    let boyle_chart = place(middle + 0.5 * style.row, right, top, bottom);
    boyle(ui, &style, boyle_chart, hold);
    for (name, rect) in [("held plate", drawing), ("boyle", boyle_chart)] {
        cx.name_plot(ui, name, rect);
    }
    grab(ui, &axes, hold, cx);
    style.explain(ui);
}

/// The drag that moves the plate: the point where it was grabbed stays under the pointer.
fn grab(ui: &Ui, axes: &Axes, hold: &HoldState, cx: &DrawContext<'_>) {
    let name = "Held plate: drag it up and down";
    let response = named(ui, axes.rect, name, Sense::drag());
    let per_point = (axes.y[1] - axes.y[0]) / f64::from(axes.rect.height());
    let id = response.id.with("in hand");
    if let Some(at) = response.interact_pointer_pos() {
        let wanted = if response.drag_started() {
            // The distance that the pointer moved before it counted as a drag is applied to the plate, too.
            let from = ui.input(|input| input.pointer.press_origin()).unwrap_or(at);
            Some(hold.target + per_point * f64::from(from.y - at.y))
        } else {
            // The drag is relative to the position where it began, not to the drawing, which may move under a pointer that rests.
            ui.data(|data| data.get_temp::<f64>(id)).map(|gap| gap - per_point * f64::from(response.drag_delta().y))
        };
        if response.dragged()
            && let Some(wanted) = wanted
        {
            ui.data_mut(|data| data.insert_temp(id, wanted));
            cx.push(HoldCommand::To(wanted));
        }
    }
    response.on_hover_and_drag_cursor(CursorIcon::Grab);
}

/// The unit of forces, which does not change during a drag: that for ambient pressure on a tenth of the plate.
fn unit(plate: &Plate) -> (&'static str, f64) {
    load_unit(0.1 * plate.gas.ambient_pressure * plate.area(), plate.is_strip())
}

fn draw_plate(style: &PlotStyle, rect: Rect, hold: &HoldState) -> Axes {
    let Reading { gap, force, error, ratio, mean_pressure, .. } = hold.shown().reading;
    let half = 0.5 * hold.plate.length;
    let axes = Axes::of_heights(style, (rect, [-half, half]), [0.0, hold.reach()[1]], [BELOW, ABOVE]);
    let (name, unit) = unit(&hold.plate);
    let force_text = with_known_digits(force / unit, error / unit);
    let numbers = format!("gap {} µm   force {force_text} {name}", number(gap * 1e6));
    let more = format!("   load ratio {}   mean pressure {} kPa absolute", number(ratio), number(mean_pressure / 1e3));
    let exaggerated = format!("   vertical {}", times(axes.exaggeration()));
    let titles = [format!("{numbers}{more}{exaggerated}"), format!("{numbers}{more}"), numbers];
    let titles = titles.each_ref().map(String::as_str);
    let legend = [("plate", style.palette.rotor), ("wall", style.palette.stator)];
    style.title(rect, "Held plate", &titles, &legend);

    let inside = &style.within(rect);
    let (wall, under) = (axes.py(0.0), axes.py(gap));
    film(inside, &axes, [under, wall], hold);
    let thickness = PLATE * rect.height();
    wall_and_plate(inside, &axes, &hold.plate, [wall, under], thickness);
    // The position before the drag.
    let mean = axes.py(hold.plate.mean_gap);
    let ends = [pos2(rect.left(), mean), pos2(rect.right(), mean)];
    inside.painter.extend(egui::Shape::dashed_line(&ends, Stroke::new(1.0, style.palette.quiet), 6.0, 5.0));
    tag(inside, pos2(rect.right() - 6.0, mean), Align2::RIGHT_CENTER, "mean gap");
    arrow(inside, rect, under - 0.5 * thickness, force, hold);
    axes
}

/// The film, coloured by the pressure at mid-width.
fn film(style: &PlotStyle, axes: &Axes, [top, bottom]: [f32; 2], hold: &HoldState) {
    let colour = colour_between(hold.pressure_range);
    let points: Vec<_> = profile_points(hold).collect();
    // The film on both sides of the hole of a ring.
    let whole = hold.plate.spans().len() == 1;
    for right in if whole { &[true][..] } else { &[false, true] } {
        let there = points.iter().filter(|(x, _)| whole || (*x > 0.0) == *right);
        style.shaded(there.map(|(x, pressure)| (axes.px(*x), top, bottom, colour(*pressure))));
    }
}

/// (x, absolute pressure) at mid-width, from end to end.
fn profile_points(hold: &HoldState) -> impl Iterator<Item = (f64, f64)> {
    let now = hold.shown();
    let across = now.y.len().max(1);
    let half = move |i: usize| (now.x[i], now.pressure[i * across]);
    // A ring has no node in the middle.
    let mirrored = (0..now.x.len()).rev().filter(|i| now.x[*i] > 0.0).map(move |i| (-half(i).0, half(i).1));
    mirrored.chain((0..now.x.len()).map(half))
}

/// The force of the film on the plate: up where it pushes, down where it pulls.
fn arrow(style: &PlotStyle, rect: Rect, from: f32, force: f64, hold: &HoldState) {
    let [low, high] = hold.force_range;
    // A force of a tenth of the ambient pressure is visible, and the greatest force so far fills the available length.
    let greatest = high.max(-low).max(0.1 * hold.plate.gas.ambient_pressure * hold.plate.area());
    let length = ARROW * rect.height() * (force / greatest) as f32;
    let colour = style.palette.film;
    let at = pos2(rect.left() + 0.12 * rect.width(), from);
    style.painter.circle_filled(at, 4.0, colour);
    // A shorter arrow would be hidden by the dot.
    if length.abs() > 6.0 {
        let tip = at - vec2(0.0, length);
        let size = style.row.min(length.abs());
        let head = vec2(0.45 * size, 0.7 * size * length.signum());
        style.painter.line_segment([at, tip + vec2(0.0, head.y)], Stroke::new(5.0, colour));
        let corners = vec![tip, tip + head, tip + vec2(-head.x, head.y)];
        style.painter.add(Shape::convex_polygon(corners, colour, Stroke::new(1.0, style.palette.canvas)));
    }
    let (name, unit) = unit(&hold.plate);
    let text = format!("{} {name}", number(force / unit));
    tag(style, at + vec2(0.9 * style.row, 0.0), Align2::LEFT_CENTER, &text);
}

/// Text that can be read on any colour.
fn tag(style: &PlotStyle, at: Pos2, anchor: Align2, text: &str) {
    let size = vec2(style.width(text), style.row);
    let ground = anchor.anchor_size(at, size).expand2(vec2(4.0, 1.0));
    style.painter.rect_filled(ground, 3.0, style.palette.canvas.gamma_multiply(0.8));
    style.write(at, anchor, text, style.text);
}

/// Pressure along x at mid-width.
fn profile(ui: &mut Ui, style: &PlotStyle, rect: Rect, hold: &HoldState) {
    let range = with_margin(hold.pressure_range.map(|pressure| pressure * 1e-3), 0.06);
    let wide = hold.plate.width.is_some();
    let titles = [if wide { "Pressure at y = 0, kPa absolute" } else { "Pressure, kPa absolute" }, "Pressure"];
    style.title_with_bar(rect, "Film pressure", &titles, hold.pressure_range);
    let bounds = [[-0.5, 0.5].map(|end| 1e3 * end * hold.plate.length), range];
    Inset { name: "Pressure along the held plate", rect, bounds, below: None }.show(ui, style, |plot| {
        plot.hline(level(hold.plate.gas.ambient_pressure * 1e-3, style.palette.quiet, 1.0));
        let points: Vec<_> = profile_points(hold).map(|(x, pressure)| [x * 1e3, pressure * 1e-3]).collect();
        plot.line(line(&points, style.palette.film, 1.8, LineStyle::Solid));
    });
}

/// The pressure over the whole plate.
fn map(ui: &Ui, style: &PlotStyle, rect: Rect, hold: &HoldState) {
    let now = hold.shown();
    let length = hold.plate.length;
    let recording = Recording {
        lines: LineLoads { frames: 1, length, teeth: 1, stored_teeth: 1, pitch: length, ..LineLoads::default() },
        map_x: now.x.clone(),
        map_y: now.y.clone(),
        half_width: true,
        half_length: true,
        pressure: now.pressure.clone(),
        ..Recording::default()
    };
    let range = hold.pressure_range;
    let x = [-0.5 * length, 0.5 * length];
    let stamp = Stamp { run: (now.number, Fidelity::Standard), place: 0.0, tooth: 0, x, range };
    let axes = field::draw(ui, style, rect, &recording, "held plate", stamp);
    style.title(rect, "Pressure map", &["Pressure map, colours as above", "Map"], &[]);
    y_labels(style, &axes);
}

/// A chart of recent readings against time.
struct Trail<'a> {
    title: &'a str,
    /// Of the axis, in SI.
    unit: f64,
    colour: Color32,
    /// The value and its error.
    of: fn(&Reading) -> [f64; 2],
    /// Least range of the axis.
    reach: [f64; 2],
    /// The value at rest.
    rest: f64,
}

impl Trail<'_> {
    fn show(&self, ui: &mut Ui, style: &PlotStyle, rect: Rect, hold: &HoldState) {
        let Self { title, unit, colour, of, reach, rest } = *self;
        let end = hold.now.reading.time;
        let range = span(reach.into_iter().chain([of(&hold.now.reading)[0]])).map(|value| value / unit);
        let name = title.split(',').next().unwrap_or(title);
        style.title(rect, name, &[title], &[]);
        // The clip rectangle leaves room for the whole dot at the present instant.
        let bounds = [[-hold.window(), 0.02 * hold.window()], with_margin(range, 0.08)];
        Inset { name: &format!("{name} of the held plate"), rect, bounds, below: None }.show(ui, style, |plot| {
            let at = |reading: &Reading| [reading.time - end, of(reading)[0] / unit];
            let band = hold.trail().map(|reading| {
                let ([time, value], error) = (at(reading), of(reading)[1] / unit);
                [time, value + error, value - error]
            });
            plot.hline(level(rest / unit, style.palette.quiet, 1.0));
            plot.add(between(&band.collect::<Vec<_>>(), colour.gamma_multiply(0.3)));
            plot.line(line(&hold.trail().map(at).collect::<Vec<_>>(), colour, 1.6, LineStyle::Solid));
            plot.points(dots("", vec![at(&hold.shown().reading)], colour, 3.0));
        });
    }
}

/// Labels of the time axis: how far the charts go back.
fn time_labels(style: &PlotStyle, chart: Rect, window: f64) {
    let top = chart.bottom() + 1.0;
    let text = format!("{} ago", time(window));
    style.write(pos2(chart.left(), top), Align2::LEFT_TOP, &text, style.palette.quiet);
    style.write(pos2(chart.right(), top), Align2::RIGHT_TOP, "now", style.palette.quiet);
}

/// Mean pressure over the gap: the recent path, and Boyle's hyperbola, which gas without time to leave follows.
fn boyle(ui: &mut Ui, style: &PlotStyle, rect: Rect, hold: &HoldState) {
    let [near, far] = hold.reach();
    let law = |gap: f64| hold.plate.gas.ambient_pressure * hold.plate.mean_gap / gap;
    let means = hold.trail().map(|reading| reading.mean_pressure);
    let [low, high] =
        span(means.chain([law(far), 2.0 * hold.plate.gas.ambient_pressure])).map(|pressure| pressure * 1e-3);
    let (film, contact) = (style.palette.film, style.palette.contact);
    let titles = [
        "Mean pressure against the gap, kPa absolute",
        "Mean pressure, kPa absolute",
        "Mean p, kPa absolute",
        "p, kPa",
    ];
    style.title(rect, "Loop", &titles, &[("film", film), ("Boyle", contact)]);
    let bounds = [with_margin([near, far], 0.04).map(|gap| gap * 1e6), [0.9 * low, 1.06 * high]];
    let name = "Mean pressure against the gap of the held plate";
    Inset { name, rect, bounds, below: Some("gap, µm") }.show(ui, style, |plot| {
        let at = |gap: f64, pressure: f64| [gap * 1e6, pressure * 1e-3];
        let gap = |i: usize| near + (far - near) * (i as f64 / SAMPLES as f64).powi(2);
        let hyperbola: Vec<_> = (0..=SAMPLES).map(|i| at(gap(i), law(gap(i)))).collect();
        let way: Vec<_> = hold.trail().map(|reading| at(reading.gap, reading.mean_pressure)).collect();
        let now = hold.shown().reading;
        plot.hline(level(hold.plate.gas.ambient_pressure * 1e-3, style.palette.quiet, 1.0));
        plot.line(line(&hyperbola, contact, 1.4, LineStyle::dashed_dense()));
        plot.line(line(&way, film, 1.6, LineStyle::Solid));
        plot.points(dots("", vec![at(now.gap, now.mean_pressure)], film, 4.0));
    });
}
