//! The stator's travelling wave with its teeth, the rotor's deflected underside, the film between them, and the places where they touch.
//! Heights are exaggerated; the factor and a scale bar are shown. While the rotor turns, the view also shows, on the scale of the heights,
//! the elliptic path of the followed tooth's top with its speed along the ring, and marks that move with the rotor.

use super::frame::Frame;
use crate::gui::derived::format::times;
use crate::gui::ui::paint::{Axes, PlotStyle};
use crate::problem::Motor;
use eframe::egui::{Align2, Pos2, Rect, Stroke, pos2, vec2};
use std::f64::consts::TAU;

/// Share of the height below the lowest stator top, and the share of the teeth in it.
const BELOW: f64 = 0.36;
pub(super) const TOOTH: f32 = 0.15;
/// Distance between two marks on a turning rotor, in lines of text.
const MARKS: f32 = 3.0;
const POINTS: u32 = 48;
/// Share of the height above the highest point of the rotor's underside.
const ABOVE: f64 = 0.16;

/// Draws the wave into `rect`, with the rotor's `underside` as in [`Lines::underside`](crate::recording::sample::Lines). Returns the axes, whose
/// y is height \[m\].
pub(super) fn draw(style: &PlotStyle, rect: Rect, shown: &Frame<'_, Motor>, underside: &[[f64; 2]]) -> Axes {
    let low = shown.ranges.stator[0];
    let high = shown.ranges.rotor[1] - shown.of.spacing();
    let high = if high > low { high } else { low + 1e-7 };
    let axes = Axes::of_heights(style, (rect, shown.x_range()), [low, high], [BELOW, ABOVE]);
    let title = format!("Rotor on the travelling wave, vertical {}", times(axes.exaggeration()));
    let mut legend =
        vec![("rotor", style.palette.rotor), ("stator", style.palette.stator), ("contact", style.palette.contact)];
    legend.extend(style.at_first(shown.first.as_ref()));
    let short = format!("Wave, vertical {}", times(axes.exaggeration()));
    style.title(rect, "Travelling wave", &[&title, &short], &legend);

    let style = &style.within(rect);
    let [left, right] = shown.followed().map(|x| axes.px(x));
    let column = Rect::from_x_y_ranges(left..=right, rect.y_range());
    style.painter.rect_filled(column, 0.0, style.palette.accent.gamma_multiply(0.10));
    stator(style, &axes, shown);
    rotor(style, &axes, shown, underside);
    touching(style, &axes, shown);
    if let Some(first) = &shown.first {
        outline(style, &axes, first);
    }
    axes.cursor(style, shown.view.cursor_x);
    axes
}

fn stator(style: &PlotStyle, axes: &Axes, shown: &Frame<'_, Motor>) {
    let colour = style.palette.stator;
    let recording = shown.recording;
    let phase = shown.phase();
    let depth = TOOTH * axes.rect.height();
    let body = |x: f64| axes.py(shown.of.stator_displacement(x, 0.0, phase)) + depth;
    // The body below the grooves.
    let samples = 96;
    let at = |i: usize| axes.x[0] + (axes.x[1] - axes.x[0]) * i as f64 / samples as f64;
    let fill = style.solid(colour);
    style.band((0..=samples).map(|i| (axes.px(at(i)), body(at(i)), axes.rect.bottom())), fill);
    let numbered = f64::from(axes.rect.width()) / recording.teeth.max(1) as f64 > 1.6 * f64::from(style.row);
    style.painter.line((0..=samples).map(|i| pos2(axes.px(at(i)), body(at(i)))).collect(), Stroke::new(1.0, colour));
    for tooth in 0..recording.teeth {
        let middle = tooth as f64 * recording.pitch;
        let heights = &shown.lines.stator[shown.lines.of(tooth)];
        let top: Vec<Pos2> = recording.x.iter().zip(heights).map(|(xi, w)| axes.at(middle + xi, *w)).collect();
        let (Some(first), Some(last)) = (recording.x.first(), recording.x.last()) else { continue };
        let feet = [first, last].map(|end| pos2(axes.px(middle + end), body(middle + end)));
        // It begins two pixels below the body's edge, so that neither edge nor seam shows.
        let columns = top.iter().zip(&recording.x).map(|(point, xi)| (point.x, point.y, body(middle + xi) + 2.0));
        style.band(columns, fill);
        let followed = tooth == shown.tooth;
        let stroke = if followed { Stroke::new(2.0, style.palette.accent) } else { Stroke::new(1.0, colour) };
        style.painter.line([&feet[..1], &top[..], &feet[1..]].concat(), stroke);
        if numbered {
            let at = pos2(axes.px(middle), axes.rect.bottom() - 2.0);
            let colour = if followed { style.palette.accent } else { style.palette.canvas };
            style.write(at, Align2::CENTER_BOTTOM, &tooth.to_string(), colour);
        }
    }
}

fn rotor(style: &PlotStyle, axes: &Axes, shown: &Frame<'_, Motor>, underside: &[[f64; 2]]) {
    let recording = shown.recording;
    let lines = &shown.lines;
    // The film, where there is any.
    let film = style.palette.film.gamma_multiply(0.25);
    for tooth in 0..recording.teeth {
        let middle = tooth as f64 * recording.pitch;
        let columns = recording.x.iter().zip(lines.of(tooth)).map(|(xi, k)| {
            let top = lines.stator[k] + lines.film_thickness[k] - shown.of.spacing();
            (axes.px(middle + xi), axes.py(top), axes.py(lines.stator[k]))
        });
        style.band(columns, film);
    }
    let underside: Vec<Pos2> = underside.iter().map(|[x, height]| axes.at(*x, *height)).collect();
    let colour = style.palette.rotor;
    style.band(underside.iter().map(|at| (at.x, at.y, axes.rect.top())), style.solid(colour));
    if shown.of.rotor_speed != 0.0 {
        marks(style, &underside, axes, shown);
    }
    style.painter.line(underside, Stroke::new(1.5, colour));
}

/// Marks on the rotor above its underside, which runs from left to right; they move with the rotor.
fn marks(style: &PlotStyle, underside: &[Pos2], axes: &Axes, shown: &Frame<'_, Motor>) {
    let (Some(first), Some(last)) = (underside.first(), underside.last()) else { return };
    let (apart, scale) = (MARKS * style.row, axes.points_per_metre());
    let turned = shown.of.rotor_speed / shown.of.frequency * (shown.view.cycles + shown.phase()) * scale;
    let mut x = first.x + turned.rem_euclid(f64::from(apart)) as f32;
    let stroke = Stroke::new(2.0, style.palette.canvas);
    while x < last.x {
        let right = underside.partition_point(|at| at.x < x).max(1);
        let (a, b) = (underside[right - 1], underside[right]);
        let y = a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x).max(f32::EPSILON);
        style.painter.line_segment([pos2(x, y - 2.0), pos2(x, y - 2.0 - 0.8 * style.row)], stroke);
        x += apart;
    }
}

/// While the rotor turns: the elliptic path of the top of the followed tooth, its present position, and its speed along the ring. The
/// ellipse of an outer tooth may extend beyond the view, so it is drawn last.
pub(super) fn ellipse(style: &PlotStyle, axes: &Axes, shown: &Frame<'_, Motor>) {
    let motor = shown.of;
    if motor.rotor_speed == 0.0 {
        return;
    }
    let scale = axes.points_per_metre();
    let middle = shown.tooth as f64 * shown.recording.pitch;
    let centre = axes.at(middle, 0.0);
    let [high, wide] = [motor.normal_amplitude, motor.tangential_amplitude].map(|amplitude| (scale * amplitude) as f32);
    let at = |turns: f64| {
        let (sin, cos) = (TAU * turns).sin_cos();
        centre + vec2(wide * sin as f32, -high * cos as f32)
    };
    let stroke = Stroke::new(1.0, style.palette.accent);
    style.painter.line((0..=POINTS).map(|i| at(f64::from(i) / f64::from(POINTS))).collect(), stroke);
    let phase = shown.phase() + middle / shown.recording.length;
    let (top, along) = (at(phase), wide * (TAU * phase).cos() as f32);
    style.painter.circle_filled(top, 4.0, style.palette.accent);
    style.painter.arrow(top, vec2(along, 0.0), Stroke::new(2.5, style.palette.accent));
}

/// The tops of the teeth and the rotor's underside above them, for the motor of the run for comparison.
fn outline(style: &PlotStyle, axes: &Axes, first: &Frame<'_, Motor>) {
    let stroke = Stroke::new(1.5, style.palette.quiet);
    let (recording, lines) = (first.recording, &first.lines);
    for tooth in 0..recording.teeth {
        let middle = tooth as f64 * recording.pitch;
        let underside = |k: usize| lines.stator[k] + lines.film_thickness[k] - first.of.spacing();
        let top = |k: usize| lines.stator[k];
        for height in [&top as &dyn Fn(usize) -> f64, &underside] {
            let points = recording.x.iter().zip(lines.of(tooth)).map(|(x, k)| axes.at(middle + x, height(k)));
            style.painter.line(points.collect(), stroke);
        }
    }
}

/// A thick line wherever the contact carries load.
fn touching(style: &PlotStyle, axes: &Axes, shown: &Frame<'_, Motor>) {
    let (recording, lines) = (shown.recording, &shown.lines);
    let stroke = Stroke::new(4.0, style.palette.contact);
    for tooth in 0..recording.teeth {
        let middle = tooth as f64 * recording.pitch;
        let nodes: Vec<(usize, usize)> = lines.of(tooth).enumerate().collect();
        let touches = |k: usize| lines.contact[k] > shown.of.touching_from();
        for run in nodes.split(|(_, k)| !touches(*k)).filter(|run| !run.is_empty()) {
            let mut points: Vec<Pos2> =
                run.iter().map(|(i, k)| axes.at(middle + recording.x[*i], lines.stator[*k])).collect();
            if let ([only], [(i, _)]) = (&points[..], run) {
                // Each node represents a length of the tooth.
                let half = 0.5 * recording.node_length[*i];
                let reach = vec2((axes.px(half) - axes.px(0.0)).max(1.0), 0.0);
                points = vec![*only - reach, *only + reach];
            }
            style.painter.line(points, stroke);
        }
    }
}
