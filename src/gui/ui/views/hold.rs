//! The held plate: the plate above its stator, to be dragged; the force on it; the pressure below it; both against time, and
//! pressure against gap with Boyle's hyperbola.

use super::field::{self, Stamp};
use super::map::y_labels;
use super::plate::wall_and_plate;
use crate::fidelity::Fidelity;
use crate::gui::command::HoldCommand;
use crate::gui::derived::format::{load_unit, number, times, with_known_digits};
use crate::gui::derived::scales::span;
use crate::gui::state::hold::HoldState;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{Axes, Column, PlotStyle, band, field_colours, room, scale_bar, shaded, title_with_bar};
use crate::hold::Reading;
use crate::recording::{LineLoads, Recording};
use eframe::egui::epaint::Shape;
use eframe::egui::{self, Align2, Color32, CursorIcon, Painter, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Parts of the drawing below the stator's face, and above the highest underside of the plate.
const BELOW: f32 = 0.10;
const ABOVE: f32 = 0.20;
/// Part of the drawing that is the plate.
const PLATE: f32 = 0.15;
/// Longest arrow, part of the drawing.
const ARROW: f32 = 0.42;
/// The drawing, the profile and the map, parts of what the charts leave; the charts, part of the height.
const PARTS: [f32; 2] = [0.66, 0.34];
const PARTS_WITH_MAP: [f32; 3] = [0.52, 0.26, 0.22];
const CHARTS: f32 = 0.34;
/// An area so many times as wide as high has the charts beside the plate, which takes this share of the width.
const WIDE: f32 = 1.8;
const BESIDE: f32 = 0.55;
/// Samples of Boyle's hyperbola.
const SAMPLES: usize = 80;

/// The held plate and what all of its drawings need.
struct HoldFrame<'a> {
    hold: &'a HoldState,
    ambient: f64,
    half: f64,
    unit: (&'static str, f64),
}

/// Draws into what is left of `ui`.
pub fn show(ui: &mut Ui, hold: &HoldState, cx: &DrawContext<'_>) {
    let Some(area) = room(ui) else { return };
    let style = PlotStyle::new(ui);
    let painter = ui.painter_at(area);
    let plate = hold.plate();
    let ambient = plate.gas.ambient_pressure;
    // One unit whatever the hand does: that of ambient pressure on a tenth of the plate.
    let unit = load_unit(0.1 * ambient * plate.area(), plate.is_strip());
    let shown = HoldFrame { hold, ambient, half: 0.5 * plate.length, unit };
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
    let mut column = Column::of(views, &style);
    let mut next = |part: f32| column.next(title, part * body);
    let drawing = next(parts[0]);
    let profile_place = next(parts[1]);
    let axes = draw_plate(&painter, &style, drawing, &shown);
    profile(&painter, &style, profile_place, &shown);
    let mut last = profile_place;
    if with_map {
        last = next(parts[2]);
        map(ui, &painter, &style, last, &shown);
    }
    Axes::new(last, [-shown.half, shown.half], [0.0, 1.0]).x_labels(&painter, &style, 1e-3, "x, mm");

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
    chart(&painter, &style, gap_chart, &shown, "Gap, µm", 1e-6, style.palette.rotor, |r| [r.gap, 0.0], None);
    let text = format!("Force, {}", unit.0);
    let force = Some(hold.force_range);
    let axes_of_force =
        chart(&painter, &style, force_chart, &shown, &text, unit.1, style.palette.film, |r| [r.force, r.error], force);
    time_labels(&painter, &style, &axes_of_force, &shown);
    let boyle_chart = place(middle + 0.5 * style.row, right, top, bottom);
    boyle(&painter, &style, boyle_chart, &shown);
    for (name, rect) in [("held plate", drawing), ("boyle", boyle_chart)] {
        cx.mark_plot(ui, name, rect);
    }
    grab(ui, &axes, hold, cx);
    style.explain(ui);
}

/// The drag that moves the plate: where it was taken it stays in the hand.
fn grab(ui: &Ui, axes: &Axes, hold: &HoldState, cx: &DrawContext<'_>) {
    let name = "Held plate: drag it up and down";
    let response = ui.interact(axes.rect, ui.scope_id().with(name), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Image, true, name));
    let per_point = (axes.y[1] - axes.y[0]) / f64::from(axes.rect.height());
    let id = response.id.with("in hand");
    if let Some(at) = response.interact_pointer_pos() {
        let wanted = if response.drag_started() {
            // What the pointer has moved until it counted as a drag is the plate's too.
            let from = ui.input(|input| input.pointer.press_origin()).unwrap_or(at);
            Some(hold.target() + per_point * f64::from(from.y - at.y))
        } else {
            // From where it was, and not from where the drawing is: that may move under a still hand.
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

fn draw_plate(painter: &Painter, style: &PlotStyle, rect: Rect, shown: &HoldFrame<'_>) -> Axes {
    let Reading { gap, force, error, ratio, mean_pressure, .. } = shown.hold.shown().reading;
    let highest = shown.hold.reach()[1];
    let part = f64::from(1.0 - BELOW - ABOVE);
    let bottom = -highest * f64::from(BELOW) / part;
    let axes = Axes::new(rect, [-shown.half, shown.half], [bottom, bottom + highest / part]);
    axes.canvas(painter, style);
    scale_bar(painter, style, &axes);
    let (name, unit) = shown.unit;
    let force_text = with_known_digits(force / unit, error / unit);
    let numbers = format!("gap {} µm   force {force_text} {name}", number(gap * 1e6));
    let more = format!("   load ratio {}   mean pressure {} kPa absolute", number(ratio), number(mean_pressure / 1e3));
    let exaggerated = format!("   vertical {}", times(axes.exaggeration()));
    let titles = [format!("{numbers}{more}{exaggerated}"), format!("{numbers}{more}"), numbers];
    let titles = titles.each_ref().map(String::as_str);
    let legend = [("plate", style.palette.rotor), ("wall", style.palette.stator)];
    style.title(painter, rect, "Held plate", &titles, &legend);

    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    let (wall, under) = (axes.py(0.0), axes.py(gap));
    film(inside, &axes, [under, wall], shown);
    let thickness = PLATE * rect.height();
    wall_and_plate(inside, style, rect, [wall, under], thickness);
    // Where it was before it was taken.
    let mean = axes.py(shown.hold.plate().mean_gap);
    let ends = [pos2(rect.left(), mean), pos2(rect.right(), mean)];
    inside.extend(egui::Shape::dashed_line(&ends, Stroke::new(1.0, style.palette.quiet), 6.0, 5.0));
    tag(inside, style, pos2(rect.right() - 6.0, mean), Align2::RIGHT_CENTER, "mean gap");
    arrow(inside, style, rect, under - 0.5 * thickness, force, shown);
    axes
}

/// The film, coloured by the pressure at mid-width.
fn film(painter: &Painter, axes: &Axes, [top, bottom]: [f32; 2], shown: &HoldFrame<'_>) {
    let [low, high] = shown.hold.pressure_range;
    let colours = field_colours();
    let colour = |pressure: f64| colours[(255.0 * (pressure - low) / (high - low)).clamp(0.0, 255.0) as usize];
    shaded(painter, profile_points(shown).map(|(x, pressure)| (axes.px(x), top, bottom, colour(pressure))));
}

/// (x, absolute pressure) at mid-width, from end to end.
fn profile_points<'a>(shown: &'a HoldFrame<'_>) -> impl Iterator<Item = (f64, f64)> + 'a {
    let now = shown.hold.shown();
    let across = now.y.len().max(1);
    let half = move |i: usize| (now.x[i], now.pressure[i * across]);
    let mirrored = (1..now.x.len()).rev().map(move |i| (-half(i).0, half(i).1));
    mirrored.chain((0..now.x.len()).map(half))
}

/// The force of the film on the plate: up where it pushes, down where it pulls.
fn arrow(painter: &Painter, style: &PlotStyle, rect: Rect, from: f32, force: f64, shown: &HoldFrame<'_>) {
    let [low, high] = shown.hold.force_range;
    // A tenth of the ambient pressure is seen, and what was greatest is as long as there is room.
    let greatest = high.max(-low).max(0.1 * shown.ambient * shown.hold.plate().area());
    let length = ARROW * rect.height() * (force / greatest) as f32;
    let colour = style.palette.film;
    let at = pos2(rect.left() + 0.12 * rect.width(), from);
    painter.circle_filled(at, 4.0, colour);
    // Below that the dot covers it.
    if length.abs() > 6.0 {
        let tip = at - vec2(0.0, length);
        let size = style.row.min(length.abs());
        let head = vec2(0.45 * size, 0.7 * size * length.signum());
        painter.line_segment([at, tip + vec2(0.0, head.y)], Stroke::new(5.0, colour));
        let corners = vec![tip, tip + head, tip + vec2(-head.x, head.y)];
        painter.add(Shape::convex_polygon(corners, colour, Stroke::new(1.0, style.palette.canvas)));
    }
    let (name, unit) = shown.unit;
    let text = format!("{} {name}", number(force / unit));
    tag(painter, style, at + vec2(0.9 * style.row, 0.0), Align2::LEFT_CENTER, &text);
}

/// Text that can be read on any colour.
fn tag(painter: &Painter, style: &PlotStyle, at: Pos2, anchor: Align2, text: &str) {
    let size = vec2(style.width(painter, text), style.row);
    let ground = anchor.anchor_size(at, size).expand2(vec2(4.0, 1.0));
    painter.rect_filled(ground, 3.0, style.palette.canvas.gamma_multiply(0.8));
    style.write(painter, at, anchor, text, style.text);
}

/// Pressure along x at mid-width.
fn profile(painter: &Painter, style: &PlotStyle, rect: Rect, shown: &HoldFrame<'_>) {
    let [low, high] = shown.hold.pressure_range;
    let margin = 0.06 * (high - low);
    let axes = Axes::new(rect, [-shown.half, shown.half], [low - margin, high + margin]);
    axes.canvas(painter, style);
    axes.y_ticks(painter, style, 1e3);
    let wide = shown.hold.plate().width.is_some();
    title_with_bar(
        painter,
        style,
        rect,
        "Film pressure",
        &[if wide { "Pressure at y = 0, kPa absolute" } else { "Pressure, kPa absolute" }, "Pressure"],
        [low, high],
    );
    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    axes.x_grid(inside, style, 1e-3);
    inside.hline(rect.x_range(), axes.py(shown.ambient), Stroke::new(1.0, style.palette.quiet));
    let line: Vec<Pos2> = profile_points(shown).map(|(x, pressure)| axes.at(x, pressure)).collect();
    inside.line(line, Stroke::new(1.8, style.palette.film));
}

/// The pressure over the whole plate.
fn map(ui: &Ui, painter: &Painter, style: &PlotStyle, rect: Rect, shown: &HoldFrame<'_>) {
    let now = shown.hold.shown();
    let length = 2.0 * shown.half;
    let recording = Recording {
        lines: LineLoads { frames: 1, length, teeth: 1, stored_teeth: 1, pitch: length, ..LineLoads::default() },
        map_x: now.x.clone(),
        map_y: now.y.clone(),
        half_width: true,
        half_length: true,
        pressure: now.pressure.clone(),
        ..Recording::default()
    };
    let range = shown.hold.pressure_range;
    let x = [-shown.half, shown.half];
    let stamp = Stamp { run: (now.number, Fidelity::Standard), place: 0.0, tooth: 0, x, range };
    let axes = field::draw(ui, style, painter, rect, &recording, "held plate", stamp);
    style.title(painter, rect, "Pressure map", &["Pressure map, colours as above", "Map"], &[]);
    y_labels(painter, style, &axes);
}

/// What was read off lately, against time. `of`: the value and its error; `range`: what the axis holds at least.
fn chart(
    painter: &Painter,
    style: &PlotStyle,
    rect: Rect,
    shown: &HoldFrame<'_>,
    title: &str,
    unit: f64,
    colour: Color32,
    of: fn(&Reading) -> [f64; 2],
    range: Option<[f64; 2]>,
) -> Axes {
    let hold = shown.hold;
    let end = hold.now().reading.time;
    let reach = range.unwrap_or(hold.reach());
    let [low, high] = span(reach.into_iter().chain([of(&hold.now().reading)[0]]));
    let margin = 0.08 * (high - low);
    let axes = Axes::new(rect, [end - hold.window(), end], [low - margin, high + margin]);
    axes.canvas(painter, style);
    axes.y_ticks(painter, style, unit);
    style.title(painter, rect, title.split(',').next().unwrap_or(title), &[title], &[]);
    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    let quiet = Stroke::new(1.0, style.palette.quiet);
    inside.hline(rect.x_range(), axes.py(if range.is_some() { 0.0 } else { hold.plate().mean_gap }), quiet);
    let columns = hold.trail().map(|reading| {
        let [value, error] = of(reading);
        (axes.px(reading.time), axes.py(value + error), axes.py(value - error))
    });
    band(inside, columns, colour.gamma_multiply(0.3));
    let line: Vec<Pos2> = hold.trail().map(|reading| axes.at(reading.time, of(reading)[0])).collect();
    inside.line(line, Stroke::new(1.6, colour));
    let now = hold.shown().reading;
    painter.circle_filled(axes.at(now.time, of(&now)[0]), 3.0, colour);
    axes
}

/// How far the chart goes back.
fn time_labels(painter: &Painter, style: &PlotStyle, axes: &Axes, shown: &HoldFrame<'_>) {
    let window = shown.hold.window();
    let (scale, unit) = if window < 1e-2 { (1e6, "µs") } else { (1e3, "ms") };
    let top = axes.rect.bottom() + 1.0;
    let text = format!("{} {unit} ago", number(window * scale));
    style.write(painter, pos2(axes.rect.left(), top), Align2::LEFT_TOP, &text, style.palette.quiet);
    style.write(painter, pos2(axes.rect.right(), top), Align2::RIGHT_TOP, "now", style.palette.quiet);
}

/// Mean pressure against the gap: the way just gone, and Boyle's hyperbola, which gas follows that has no time to leave.
fn boyle(painter: &Painter, style: &PlotStyle, rect: Rect, shown: &HoldFrame<'_>) {
    let hold = shown.hold;
    let [near, far] = hold.reach();
    let law = |gap: f64| shown.ambient * hold.plate().mean_gap / gap;
    let means = hold.trail().map(|reading| reading.mean_pressure);
    let [low, high] = span(means.chain([law(far), 2.0 * shown.ambient]));
    let side = 0.04 * (far - near);
    let axes = Axes::new(rect, [near - side, far + side], [0.9 * low, 1.06 * high]);
    axes.canvas(painter, style);
    axes.y_ticks(painter, style, 1e3);
    axes.x_labels(painter, style, 1e-6, "gap, µm");
    let (film, quiet) = (style.palette.film, style.palette.quiet);
    let titles = [
        "Mean pressure against the gap, kPa absolute",
        "Mean pressure, kPa absolute",
        "Mean p, kPa absolute",
        "p, kPa",
    ];
    style.title(painter, rect, "Loop", &titles, &[("film", film), ("Boyle", style.palette.contact)]);
    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    axes.x_grid(inside, style, 1e-6);
    inside.hline(rect.x_range(), axes.py(shown.ambient), Stroke::new(1.0, quiet));
    let at = |i: usize| near + (far - near) * (i as f64 / SAMPLES as f64).powi(2);
    let hyperbola: Vec<Pos2> = (0..=SAMPLES).map(|i| axes.at(at(i), law(at(i)))).collect();
    inside.extend(Shape::dashed_line(&hyperbola, Stroke::new(1.4, style.palette.contact), 6.0, 4.0));
    let line: Vec<Pos2> = hold.trail().map(|reading| axes.at(reading.gap, reading.mean_pressure)).collect();
    inside.line(line, Stroke::new(1.6, film));
    let now = hold.shown().reading;
    painter.circle(axes.at(now.gap, now.mean_pressure), 4.0, film, Stroke::new(1.0, style.palette.canvas));
}
