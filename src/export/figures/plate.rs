//! Figures of a plate.

use super::series::{mirrored, over_cycle, phase, pressure_map, rest, span, whole_plane, with_margin};
use super::unit::{prefixed, pressure_unit};
use crate::export::figure::{
    Axis, Band, Colour, Dash, Figure, Grid, Line, Map, Mark, Marker, Panel, Points, Range, Shape, Style, Width,
};
use crate::problem::Plate;
use crate::recording::Recording;

/// Absolute pressure along the plate, at y = 0, at four instants a quarter of a cycle apart.
pub fn profile(plate: &Plate, recording: &Recording) -> Figure {
    let ambient = plate.gas.ambient_pressure;
    let (unit, scale) = pressure_unit(span(recording.pressure.iter().copied(), ambient)[1]);
    let quarters = ["t = 0", "T/4", "T/2", "3T/4"].into_iter().enumerate().map(|(quarter, name)| {
        let points = along_the_middle(recording, quarter * recording.frames / 4, scale, |x| x * 1e3);
        Line::new(name, points, Style::unmarked(quarter))
    });
    let panel = Panel::new("", Axis::new("x", "mm"), Axis::new(pressure_at_the_middle(plate), &unit))
        .layer(rest(ambient * scale, "ambient"))
        .layers(quarters);
    Figure::new("pressure along the plate")
        .panel(panel)
        .caption("Pressure along the plate at four instants; the gap is greatest at t/T = 0.")
}

fn pressure_at_the_middle(plate: &Plate) -> &'static str {
    if plate.width.is_some() { "absolute pressure at y = 0" } else { "absolute pressure" }
}

/// Pressure along x at the y nearest to the middle, over both halves. `scale` converts from pascal, and `place` gives the position of a
/// node \[m\].
pub(super) fn along_the_middle(
    recording: &Recording,
    frame: usize,
    scale: f64,
    place: impl Fn(f64) -> f64,
) -> Vec<[f64; 2]> {
    let line = middle_line(recording, frame);
    let x = mirrored(&recording.map_x, recording.half_length);
    x.iter().filter_map(|(x, i)| line.get(*i).map(|p| [place(*x), p * scale])).collect()
}

/// Pressure along x at the y nearest to the middle.
fn middle_line(recording: &Recording, frame: usize) -> Vec<f64> {
    let (nx, ny) = (recording.map_x.len(), recording.map_y.len());
    let distance = |j: &usize| recording.map_y[*j].abs();
    let Some(j) = (0..ny).min_by(|a, b| distance(a).total_cmp(&distance(b))) else { return Vec::new() };
    (0..nx).filter_map(|i| recording.pressure.get((frame * nx + i) * ny + j).copied()).collect()
}

/// Pressure along the middle line and over the cycle. `scale` converts from pascal, and `place` gives the position of a node \[m\].
pub(super) fn over_length_and_cycle(recording: &Recording, scale: f64, place: impl Fn(f64) -> f64) -> Grid {
    let x = mirrored(&recording.map_x, recording.half_length);
    let frames = recording.frames;
    let columns: Vec<Vec<f64>> = (0..=frames).map(|m| middle_line(recording, m % frames.max(1))).collect();
    let at = |i: usize, m: usize| columns[m].get(i).map_or(f64::NAN, |p| p * scale);
    Grid {
        values: x.iter().flat_map(|(_, i)| (0..=frames).map(move |m| (*i, m))).map(|(i, m)| at(i, m)).collect(),
        x: x.into_iter().map(|(x, _)| place(x)).collect(),
        y: (0..=frames).map(|m| phase(recording, m)).collect(),
    }
}

/// `N`; for a strip `N/m`.
pub(super) fn force(plate: &Plate) -> &'static str {
    if plate.is_strip() { "N/m" } else { "N" }
}

/// Load and gap over the cycle.
pub fn loads(plate: &Plate, recording: &Recording) -> Figure {
    let greatest = recording.film_load.iter().fold(0.0f64, |most, load| most.max(load.abs()));
    let (unit, scale) = prefixed(greatest, force(plate));
    let (length, gaps) = prefixed(plate.mean_gap + plate.amplitude, "m");
    let style = Style::solid(Colour::ROTOR).dash(Dash::Dashed);
    let gap = Line { right: true, ..Line::new("gap", over_cycle(&recording.min_film_thickness, gaps), style) };
    let mut panel = Panel::new("", Axis::new("t/T", "").fixed(0.0, 1.0), Axis::new("film load", unit))
        .layer(rest(0.0, ""))
        .layer(Line::new("film load", over_cycle(&recording.film_load, scale), Style::solid(Colour::FILM)))
        .layer(gap);
    panel.right = Some(Axis::new("gap", length));
    Figure::new("load over the cycle")
        .panel(panel)
        .caption("Load of the film above ambient, and the gap, over one cycle.")
}

/// Mean gauge pressure over the gap for one cycle.
pub fn pressure_gap_loop(plate: &Plate, recording: &Recording) -> Figure {
    Figure::new("pressure against gap").panel(loop_panel("", plate, recording, 0, "t = 0")).caption(
        "Mean gauge pressure of the film against the gap, once round the cycle. The area of the loop is what \
         the film takes from the plate in a cycle, for each unit of area.",
    )
}

/// The loop, with a point of this name at a frame.
fn loop_panel(title: &str, plate: &Plate, recording: &Recording, frame: usize, name: &str) -> Panel {
    let area = plate.area();
    let greatest = recording.film_load.iter().fold(0.0f64, |most, load| most.max((load / area).abs()));
    let (unit, scale) = pressure_unit(greatest);
    let (length, gaps) = prefixed(plate.mean_gap + plate.amplitude, "m");
    let at = |m: usize| Some([recording.min_film_thickness.get(m)? * gaps, recording.film_load.get(m)? / area * scale]);
    let closed = (0..=recording.frames).map(|m| m % recording.frames.max(1));
    let line = Line::new("", closed.filter_map(at), Style::solid(Colour::FILM));
    let now = Points::new(name, at(frame), Colour::CONTACT, Marker { size: 5.0, ..Marker::solid(Shape::Circle) });
    Panel::new(title, Axis::new("gap", length), Axis::new("mean gauge pressure", unit))
        .layer(rest(0.0, ""))
        .layer(line)
        .layer(now)
}

/// Gap, pressure profile and loop at a frame, for animations.
pub fn moving(plate: &Plate, recording: &Recording, frame: usize) -> Figure {
    let half = 0.5 * plate.length * 1e3;
    let highest = plate.mean_gap + plate.amplitude;
    let (length, gaps) = prefixed(highest, "m");
    let gap = recording.min_film_thickness.get(frame).copied().unwrap_or(0.0) * gaps;
    let body = |ends: [f64; 2], low: f64, high: f64| ends.map(|x| [x, low, high]);
    let solid = |points: [[f64; 3]; 2], colour: Colour| Band { opacity: 0.6, ..Band::new("", points, colour) };
    let (floor, roof) = (-0.12 * highest * gaps, 1.35 * highest * gaps);
    let mut surfaces = Panel::new(
        "(a) plate above the wall",
        Axis::new("x", "mm").fixed(-half, half),
        Axis::new("gap", length).fixed(floor, roof),
    )
    .layer(solid(body([-half, half], floor, 0.0), Colour::STATOR));
    for ends in plate.spans().into_iter().map(|ends| ends.map(|x| x * 1e3)) {
        surfaces = surfaces.layer(solid(body(ends, gap, gap + 0.3 * highest * gaps), Colour::ROTOR)).layer(Band::new(
            "",
            body(ends, 0.0, gap),
            Colour::FILM,
        ));
    }
    let ambient = plate.gas.ambient_pressure;
    let range = span(recording.pressure.iter().copied(), ambient);
    let (unit, scale) = pressure_unit(range[1]);
    let [low, high] = with_margin(range, 0.06);
    let points = along_the_middle(recording, frame, scale, |x| x * 1e3);
    let area = points.iter().map(|[x, p]| [*x, ambient * scale, *p]);
    let y = Axis::new(pressure_at_the_middle(plate), unit).fixed(low * scale, high * scale);
    let pressure = Panel::new("(c) pressure", Axis::new("x", "mm").fixed(-half, half), y)
        .layer(Band::new("", area, Colour::FILM))
        .layer(rest(ambient * scale, ""))
        .layer(Line::new("", points.iter().copied(), Style::solid(Colour::FILM)));
    let round = loop_panel("(b) once round the cycle", plate, recording, frame, "");
    let mut load = loads(plate, recording).panels.remove(0);
    load.title = "(d) over the cycle".to_owned();
    load = load.layer(Mark::vertical(phase(recording, frame), ""));
    let panels = [surfaces, round, pressure, load].map(|panel| panel.height(32.0)).into();
    Figure { panels, columns: 2, width: Width::Millimetres(150.0), ..Figure::default() }
}

/// Absolute pressure over the plate at the instant of its greatest value; for a strip, along it and over the cycle.
pub fn map(plate: &Plate, recording: &Recording) -> Figure {
    let (unit, scale) = pressure_unit(span(recording.pressure.iter().copied(), 0.0)[1]);
    let ny = recording.map_y.len();
    let strip = plate.width.is_none() || ny < 2;
    let along = if recording.radial { "diameter" } else { "strip" };
    let (title, y_axis, grid) = if strip {
        let grid = over_length_and_cycle(recording, scale, |x| x * 1e3);
        (format!("pressure along the {along}"), Axis::new("t/T", ""), grid)
    } else {
        let most = recording.max_pressure.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(m, _)| m);
        let plane = recording.pressure.get(most * recording.map_x.len() * ny..).unwrap_or(&[]);
        let title = format!("pressure at t/T = {:.3}", phase(recording, most));
        (title, Axis::new("y", "mm"), whole_plane(recording, plane, scale))
    };
    let error = recording.max_pressure_error.iter().copied().fold(0.0, f64::max);
    let map = Map { contours: Some(error * scale), ..pressure_map(grid, &unit, Range::Auto) };
    let panel = Panel::new("", Axis::new("x", "mm"), y_axis).layer(map).height(60.0);
    let caption = if strip {
        format!("Absolute pressure of the film along the {along} and over one cycle.")
    } else {
        "Absolute pressure of the film over the plate, at the instant at which it is greatest.".to_owned()
    };
    Figure { width: Width::Millimetres(110.0), caption, ..Figure::new(title) }.panel(panel)
}
