//! The held plate: the plate above its stator, to be dragged; the force on it; the pressure below it; both against time, and
//! pressure against gap with Boyle's hyperbola.

use super::field::{self, Stamp};
use super::map::y_labels;
use super::paint::{Axes, Ink, field_colours, number, scale_bar, times, title_with_bar};
use super::plate::load_unit;
use super::scales::span;
use crate::fidelity::Fidelity;
use crate::gui::command::Command;
use crate::gui::holding::{Ask, Holding};
use crate::gui::spot;
use crate::hold::Reading;
use crate::recording::{LineLoads, Recording};
use eframe::egui::epaint::{Mesh, Shape};
use eframe::egui::{self, Align2, Color32, CursorIcon, Painter, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};
use std::sync::Arc;

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
/// Samples of Boyle's hyperbola.
const SAMPLES: usize = 80;

/// What is drawn.
struct Shown<'a> {
    holding: &'a Holding,
    ambient: f64,
    half: f64,
    unit: (&'static str, f64),
}

/// Draws into what is left of `ui`.
pub(super) fn show(ui: &mut Ui, holding: &Holding, commands: &mut Vec<Command>) {
    let size = ui.available_size().min(vec2(6000.0, 6000.0));
    let (area, _) = ui.allocate_exact_size(size, Sense::hover());
    if area.width() < 160.0 || area.height() < 160.0 {
        return;
    }
    let ink = Ink::new(ui);
    let painter = ui.painter_at(area);
    let plate = holding.plate();
    let ambient = plate.gas.ambient_pressure;
    // One unit whatever the hand does: that of ambient pressure on a tenth of the plate.
    let unit = load_unit(0.1 * ambient * plate.area(), plate.width.is_none());
    let shown = Shown { holding, ambient, half: 0.5 * plate.length, unit };
    let gutter = ink.width(&painter, "−0.000") + 6.0;
    let (title, axis) = (ink.row + 7.0, ink.row + 3.0);
    let right = area.right() - 0.5 * ink.row;
    let with_map = plate.width.is_some();
    let parts: &[f32] = if with_map { &PARTS_WITH_MAP } else { &PARTS };
    let charts = (CHARTS * area.height()).max(6.0 * ink.row + title + axis);
    let body = (area.height() - charts - parts.len() as f32 * title - axis).max(40.0);
    let mut top = area.top();
    let mut next = |part: f32| {
        let low = pos2(right, top + title + part * body);
        let rect = Rect::from_min_max(pos2(area.left() + gutter, top + title), low);
        top = rect.bottom();
        rect
    };
    let drawing = next(parts[0]);
    let profile_place = next(parts[1]);
    let axes = draw_plate(&painter, &ink, drawing, &shown);
    profile(&painter, &ink, profile_place, &shown);
    let mut last = profile_place;
    if with_map {
        last = next(parts[2]);
        map(ui, &painter, &ink, last, &shown);
    }
    Axes::new(last, [-shown.half, shown.half], [0.0, 1.0]).x_labels(&painter, &ink, 1e-3, "x, mm");

    let top = last.bottom() + axis + title;
    let bottom = area.bottom() - axis;
    let middle = area.left() + 0.56 * (right - area.left());
    let place = |left: f32, right: f32, top: f32, bottom: f32| {
        Rect::from_min_max(pos2(left + gutter, top), pos2(right, bottom.max(top + 8.0)))
    };
    let between = 0.5 * (bottom - top - title);
    let left_end = middle - 0.5 * ink.row;
    let gap_chart = place(area.left(), left_end, top, top + between);
    let force_chart = place(area.left(), left_end, top + between + title, bottom);
    chart(&painter, &ink, gap_chart, &shown, "Gap, µm", 1e-6, ink.palette.rotor, |r| [r.gap, 0.0], None);
    let text = format!("Force, {}", unit.0);
    let force = Some(holding.force_range());
    let axes_of_force =
        chart(&painter, &ink, force_chart, &shown, &text, unit.1, ink.palette.film, |r| [r.force, r.error], force);
    time_labels(&painter, &ink, &axes_of_force, &shown);
    let boyle_chart = place(middle + 0.5 * ink.row, right, top, bottom);
    boyle(&painter, &ink, boyle_chart, &shown);
    for (name, rect) in [("held plate", drawing), ("boyle", boyle_chart)] {
        spot::mark(ui, name, rect.shrink(2.0));
    }
    grab(ui, &axes, holding, commands);
    ink.explain(ui);
}

/// The drag that moves the plate: where it was taken it stays in the hand.
fn grab(ui: &Ui, axes: &Axes, holding: &Holding, commands: &mut Vec<Command>) {
    let name = "Held plate: drag it up and down";
    let response = ui.interact(axes.rect, ui.scope_id().with(name), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Image, true, name));
    let gap_at =
        |y: f32| axes.y[0] + f64::from((axes.rect.bottom() - y) / axes.rect.height()) * (axes.y[1] - axes.y[0]);
    let id = response.id.with("in hand");
    if let Some(at) = response.interact_pointer_pos() {
        if response.drag_started() {
            // What the pointer has moved until it counted as a drag is the plate's too.
            let from = ui.input(|input| input.pointer.press_origin()).unwrap_or(at);
            ui.data_mut(|data| data.insert_temp(id, gap_at(from.y) - holding.target()));
        }
        if response.dragged()
            && let Some(offset) = ui.data(|data| data.get_temp::<f64>(id))
        {
            commands.push(Command::Hold(Ask::To(gap_at(at.y) - offset)));
        }
    }
    response.on_hover_and_drag_cursor(CursorIcon::Grab);
}

fn draw_plate(painter: &Painter, ink: &Ink, rect: Rect, shown: &Shown<'_>) -> Axes {
    let Reading { gap, force, error, ratio, mean_pressure, .. } = shown.holding.now().reading;
    let highest = shown.holding.reach()[1];
    let part = f64::from(1.0 - BELOW - ABOVE);
    let bottom = -highest * f64::from(BELOW) / part;
    let axes = Axes::new(rect, [-shown.half, shown.half], [bottom, bottom + highest / part]);
    let scale = f64::from(rect.height()) * part / highest;
    let along = f64::from(rect.width()) / (axes.x[1] - axes.x[0]);
    axes.canvas(painter, ink);
    scale_bar(painter, ink, rect, scale);
    let (name, unit) = shown.unit;
    let force_text = with_error(force / unit, error / unit);
    let numbers = format!("gap {} µm   force {force_text} {name}", number(gap * 1e6));
    let more = format!("   load ratio {}   mean pressure {} kPa absolute", number(ratio), number(mean_pressure / 1e3));
    let exaggerated = format!("   vertical {}", times(scale / along));
    let titles = [format!("{numbers}{more}{exaggerated}"), format!("{numbers}{more}"), numbers];
    let titles = titles.each_ref().map(String::as_str);
    let legend = [("plate", ink.palette.rotor), ("stator", ink.palette.stator)];
    ink.title(painter, rect, "Held plate", &titles, &legend);

    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    let (wall, under) = (axes.py(0.0), axes.py(gap));
    film(inside, &axes, [under, wall], shown);
    let block = |top: f32, bottom: f32| Rect::from_min_max(pos2(rect.left(), top), pos2(rect.right(), bottom));
    inside.rect_filled(block(wall, rect.bottom()), 0.0, ink.solid(ink.palette.stator));
    inside.hline(rect.x_range(), wall, Stroke::new(1.5, ink.palette.stator));
    let top = under - PLATE * rect.height();
    inside.rect_filled(block(top, under), 0.0, ink.solid(ink.palette.rotor));
    inside.hline(rect.x_range(), under, Stroke::new(1.5, ink.palette.rotor));
    // Where it was before it was taken.
    let mean = axes.py(shown.holding.plate().mean_gap);
    let ends = [pos2(rect.left(), mean), pos2(rect.right(), mean)];
    inside.extend(egui::Shape::dashed_line(&ends, Stroke::new(1.0, ink.palette.quiet), 6.0, 5.0));
    tag(inside, ink, pos2(rect.right() - 6.0, mean), Align2::RIGHT_CENTER, "mean gap");
    arrow(inside, ink, rect, 0.5 * (top + under), force, shown);
    axes
}

/// The film, coloured by the pressure at mid-width.
fn film(painter: &Painter, axes: &Axes, [top, bottom]: [f32; 2], shown: &Shown<'_>) {
    let [low, high] = shown.holding.pressure_range();
    let colours = field_colours();
    let colour = |pressure: f64| colours[(255.0 * (pressure - low) / (high - low)).clamp(0.0, 255.0) as usize];
    let mut mesh = Mesh::default();
    for (x, pressure) in profile_points(shown) {
        let next = mesh.vertices.len() as u32;
        let x = axes.px(x);
        mesh.colored_vertex(pos2(x, top), colour(pressure));
        mesh.colored_vertex(pos2(x, bottom), colour(pressure));
        if next > 0 {
            mesh.add_triangle(next - 2, next - 1, next);
            mesh.add_triangle(next - 1, next, next + 1);
        }
    }
    painter.add(Shape::Mesh(Arc::new(mesh)));
}

/// (x, absolute pressure) at mid-width, from end to end.
fn profile_points<'a>(shown: &'a Shown<'_>) -> impl Iterator<Item = (f64, f64)> + 'a {
    let now = shown.holding.now();
    let across = now.y.len().max(1);
    let half = move |i: usize| (now.x[i], now.pressure[i * across]);
    let mirrored = (1..now.x.len()).rev().map(move |i| (-half(i).0, half(i).1));
    mirrored.chain((0..now.x.len()).map(half))
}

/// The force of the film on the plate: up where it pushes, down where it pulls.
fn arrow(painter: &Painter, ink: &Ink, rect: Rect, from: f32, force: f64, shown: &Shown<'_>) {
    let [low, high] = shown.holding.force_range();
    // A tenth of the ambient pressure is seen, and what was greatest is as long as there is room.
    let greatest = high.max(-low).max(0.1 * shown.ambient * shown.holding.plate().area());
    let length = ARROW * rect.height() * (force / greatest) as f32;
    let colour = ink.palette.film;
    let at = pos2(rect.left() + 0.12 * rect.width(), from);
    painter.circle_filled(at, 4.0, colour);
    if length.abs() > 3.0 {
        let tip = at - vec2(0.0, length);
        let head = vec2(0.45 * ink.row, 0.7 * ink.row.min(length.abs()) * length.signum());
        painter.line_segment([at, tip + vec2(0.0, head.y)], Stroke::new(5.0, colour));
        let corners = vec![tip, tip + head, tip + vec2(-head.x, head.y)];
        painter.add(Shape::convex_polygon(corners, colour, Stroke::new(1.0, ink.palette.canvas)));
    }
    let (name, unit) = shown.unit;
    let text = format!("{} {name}", number(force / unit));
    tag(painter, ink, at + vec2(0.9 * ink.row, 0.0), Align2::LEFT_CENTER, &text);
}

/// Text that can be read on any colour.
fn tag(painter: &Painter, ink: &Ink, at: Pos2, anchor: Align2, text: &str) {
    let size = vec2(ink.width(painter, text), ink.row);
    let ground = anchor.anchor_size(at, size).expand2(vec2(4.0, 1.0));
    painter.rect_filled(ground, 3.0, ink.palette.canvas.gamma_multiply(0.8));
    ink.write(painter, at, anchor, text, ink.text);
}

/// A value to the digit that its error leaves known, at most three decimals.
fn with_error(value: f64, error: f64) -> String {
    let decimals = if error > 0.0 { (-error.log10().floor()).clamp(0.0, 3.0) } else { 3.0 };
    let least = 10f64.powf(-decimals);
    let decimals = decimals as usize;
    let sign = if value < -0.5 * least { "−" } else { "" };
    format!("{sign}{:.decimals$} ± {:.decimals$}", value.abs(), error.max(least))
}

/// Pressure along x at mid-width.
fn profile(painter: &Painter, ink: &Ink, rect: Rect, shown: &Shown<'_>) {
    let [low, high] = shown.holding.pressure_range();
    let margin = 0.06 * (high - low);
    let axes = Axes::new(rect, [-shown.half, shown.half], [low - margin, high + margin]);
    axes.canvas(painter, ink);
    axes.y_ticks(painter, ink, 1e3);
    let wide = shown.holding.plate().width.is_some();
    title_with_bar(
        painter,
        ink,
        rect,
        "Film pressure",
        [if wide { "Pressure at y = 0, kPa absolute" } else { "Pressure, kPa absolute" }, "Pressure"],
        [low, high],
    );
    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    axes.x_grid(inside, ink, 1e-3);
    inside.hline(rect.x_range(), axes.py(shown.ambient), Stroke::new(1.0, ink.palette.quiet));
    let line: Vec<Pos2> = profile_points(shown).map(|(x, pressure)| axes.at(x, pressure)).collect();
    inside.line(line, Stroke::new(1.8, ink.palette.film));
}

/// The pressure over the whole plate.
fn map(ui: &Ui, painter: &Painter, ink: &Ink, rect: Rect, shown: &Shown<'_>) {
    let now = shown.holding.now();
    let half = now.y.last().copied().unwrap_or(0.0);
    let axes = Axes::new(rect, [-shown.half, shown.half], [-half, half]);
    axes.canvas(painter, ink);
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
    let range = shown.holding.pressure_range();
    let stamp = Stamp { run: (now.number, Fidelity::Standard), place: 0.0, tooth: 0, x: axes.x, range };
    field::draw(ui, painter, &axes, &recording, "held plate", stamp);
    ink.title(painter, rect, "Pressure map", &["Pressure map, colours as above", "Map"], &[]);
    y_labels(painter, ink, &axes);
}

/// What was read off lately, against time. `of`: the value and its error; `range`: what the axis holds at least.
fn chart(
    painter: &Painter,
    ink: &Ink,
    rect: Rect,
    shown: &Shown<'_>,
    title: &str,
    unit: f64,
    colour: Color32,
    of: fn(&Reading) -> [f64; 2],
    range: Option<[f64; 2]>,
) -> Axes {
    let holding = shown.holding;
    let end = holding.now().reading.time;
    let reach = range.unwrap_or(holding.reach());
    let [low, high] = span(reach.into_iter().chain([of(&holding.now().reading)[0]]));
    let margin = 0.08 * (high - low);
    let axes = Axes::new(rect, [end - holding.window(), end], [low - margin, high + margin]);
    axes.canvas(painter, ink);
    axes.y_ticks(painter, ink, unit);
    ink.title(painter, rect, title.split(',').next().unwrap_or(title), &[title], &[]);
    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    let quiet = Stroke::new(1.0, ink.palette.quiet);
    inside.hline(rect.x_range(), axes.py(if range.is_some() { 0.0 } else { holding.plate().mean_gap }), quiet);
    let columns = holding.trail().iter().map(|reading| {
        let [value, error] = of(reading);
        (axes.px(reading.time), axes.py(value + error), axes.py(value - error))
    });
    super::paint::band(inside, columns, colour.gamma_multiply(0.3));
    let line: Vec<Pos2> = holding.trail().iter().map(|reading| axes.at(reading.time, of(reading)[0])).collect();
    inside.line(line, Stroke::new(1.6, colour));
    painter.circle_filled(axes.at(end, of(&holding.now().reading)[0]), 3.0, colour);
    axes
}

/// How far the chart goes back.
fn time_labels(painter: &Painter, ink: &Ink, axes: &Axes, shown: &Shown<'_>) {
    let window = shown.holding.window();
    let (scale, unit) = if window < 1e-2 { (1e6, "µs") } else { (1e3, "ms") };
    let top = axes.rect.bottom() + 1.0;
    let text = format!("{} {unit} ago", number(window * scale));
    ink.write(painter, pos2(axes.rect.left(), top), Align2::LEFT_TOP, &text, ink.palette.quiet);
    ink.write(painter, pos2(axes.rect.right(), top), Align2::RIGHT_TOP, "now", ink.palette.quiet);
}

/// Mean pressure against the gap: the way just gone, and Boyle's hyperbola, which gas follows that has no time to leave.
fn boyle(painter: &Painter, ink: &Ink, rect: Rect, shown: &Shown<'_>) {
    let holding = shown.holding;
    let [near, far] = holding.reach();
    let law = |gap: f64| shown.ambient * holding.plate().mean_gap / gap;
    let means = holding.trail().iter().map(|reading| reading.mean_pressure);
    let [low, high] = span(means.chain([law(far), 2.0 * shown.ambient]));
    let side = 0.04 * (far - near);
    let axes = Axes::new(rect, [near - side, far + side], [0.9 * low, 1.06 * high]);
    axes.canvas(painter, ink);
    axes.y_ticks(painter, ink, 1e3);
    axes.x_labels(painter, ink, 1e-6, "gap, µm");
    let (film, quiet) = (ink.palette.film, ink.palette.quiet);
    let titles = [
        "Mean pressure against the gap, kPa absolute",
        "Mean pressure, kPa absolute",
        "Mean p, kPa absolute",
        "p, kPa",
    ];
    ink.title(painter, rect, "Loop", &titles, &[("film", film), ("Boyle", ink.palette.contact)]);
    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    axes.x_grid(inside, ink, 1e-6);
    inside.hline(rect.x_range(), axes.py(shown.ambient), Stroke::new(1.0, quiet));
    let at = |i: usize| near + (far - near) * (i as f64 / SAMPLES as f64).powi(2);
    let hyperbola: Vec<Pos2> = (0..=SAMPLES).map(|i| axes.at(at(i), law(at(i)))).collect();
    inside.extend(Shape::dashed_line(&hyperbola, Stroke::new(1.4, ink.palette.contact), 6.0, 4.0));
    let line: Vec<Pos2> = holding.trail().iter().map(|reading| axes.at(reading.gap, reading.mean_pressure)).collect();
    inside.line(line, Stroke::new(1.6, film));
    let now = holding.now().reading;
    painter.circle(axes.at(now.gap, now.mean_pressure), 4.0, film, Stroke::new(1.0, ink.palette.canvas));
}

#[cfg(test)]
mod tests {
    use super::with_error;

    #[test]
    fn a_force_has_the_digits_that_are_known() {
        assert_eq!(with_error(186.04, 0.63), "186.0 ± 0.6");
        assert_eq!(with_error(-35.104, 0.061), "−35.10 ± 0.06");
        assert_eq!(with_error(-0.0001, 1e-7), "0.000 ± 0.001");
        assert_eq!(with_error(0.0, 0.0), "0.000 ± 0.001");
    }
}
