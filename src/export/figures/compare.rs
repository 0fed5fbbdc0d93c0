//! Figures of several runs: curves are overlaid, maps are side by side with one colour scale. All runs are at the same phase of the cycle,
//! and the axes cover the whole cycle of every run.

use super::motor::{all_teeth, crest_in_the_middle, one_tooth, pressure_span};
use super::plate;
use super::series::{
    along, along_where_not_zero, over_cycle, phase as phase_of, pressure_map, rest, span, tooth_map, with_margin,
};
use super::unit::{prefixed, pressure_unit};
use crate::export::figure::{Axis, Figure, Legend, Line, Marker, Panel, Points, Range, Style, Width, extent};
use crate::problem::{Motor, Plate, rpm};
use crate::recording::Recording;
use crate::recording::sample::Lines;
use crate::solution::{OperatingPoint, Performance};

/// One run: of a motor, or of a plate.
#[derive(Clone, Copy, Debug)]
pub struct DrawnRun<'a, S> {
    /// Its name in the legend.
    pub name: &'a str,
    /// The motor, or the plate.
    pub scene: &'a S,
    /// Its fields.
    pub recording: &'a Recording,
    /// How its curves look.
    pub style: Style,
}

/// A motor's run.
pub type MotorRun<'a> = DrawnRun<'a, Motor>;
/// A plate's run.
pub type PlateRun<'a> = DrawnRun<'a, Plate>;

/// The part of a caption that says whose numbers they are, if there are several runs.
fn of_every<S>(runs: &[DrawnRun<'_, S>]) -> &'static str {
    if runs.len() > 1 { " of every run" } else { "" }
}

/// Greatest number of maps in an animation.
const MOVING_MAPS: usize = 4;

/// All figures of several motors, each with its file name; `performances` are those of the runs. Empty without runs.
pub fn motors(runs: &[MotorRun<'_>], performances: &[Performance]) -> Vec<(&'static str, Figure)> {
    let Some(first) = runs.first() else { return Vec::new() };
    let frame = crest_in_the_middle(first.recording);
    let phase = phase_of(first.recording, frame);
    vec![
        ("waves", waves(runs, phase)),
        ("loads", loads(runs)),
        ("torque", torques(runs, performances)),
        ("maps", maps(runs, phase)),
        ("teeth", teeth(runs, phase)),
    ]
}

/// The frame of a recording that is nearest to a phase of the cycle, 0 to 1.
fn nearest_frame(recording: &Recording, phase: f64) -> usize {
    (phase * recording.frames as f64).round() as usize % recording.frames.max(1)
}

/// Number of frames of an animation of these recordings, at most `most`: if possible, it divides every cycle evenly.
pub fn common_frames<'a>(recordings: impl Iterator<Item = &'a Recording>, most: usize) -> usize {
    let mut steps: Vec<usize> = recordings.map(|recording| recording.frames).collect();
    steps.retain(|frames| *frames > 0);
    let Some(least) = steps.iter().copied().min() else { return 0 };
    let most = most.min(least).max(1);
    let even = (1..=most).rev().find(|count| steps.iter().all(|frames| frames.is_multiple_of(*count)));
    // Few frames at exact time steps are worse than many at nearly exact ones.
    even.filter(|count| 2 * count >= most).unwrap_or(most)
}

/// The wave's x axis: in millimetres or, if the wavelengths differ, in wavelengths. Also the length of a metre on it.
fn wave_axis(runs: &[MotorRun<'_>]) -> (Axis, impl Fn(&Recording) -> f64) {
    let first = runs.first().map_or(1.0, |run| run.recording.length);
    let alike = runs.iter().all(|run| (run.recording.length / first - 1.0).abs() < 1e-9);
    let scale = move |recording: &Recording| if alike { 1e3 } else { 1.0 / recording.length };
    let ends = runs.iter().map(|run| {
        let (half, scale) = (0.5 * run.recording.pitch, scale(run.recording));
        [-half * scale, (run.recording.length - half) * scale]
    });
    let [low, high] = extent(ends.flatten());
    let axis = if alike { Axis::new("x", "mm") } else { Axis::new("x/λ", "") };
    (axis.fixed(low, high), scale)
}

/// Surfaces, contact pressure and film pressure along one wavelength at a phase of the cycle, all runs in each panel.
pub fn waves(runs: &[MotorRun<'_>], phase: f64) -> Figure {
    let panels = vec![
        surfaces(runs, phase).height(40.0),
        pressures(runs, phase, "(b) contact pressure", |recording| &recording.contact).height(30.0),
        pressures(runs, phase, "(c) film pressure, gauge", |recording| &recording.film).height(30.0),
    ];
    let caption = format!(
        "Rotor (thick) and tooth tops (thin) (a), contact pressure (b) and gauge pressure of the air film (c), both averaged over the \
         contact width, along one wavelength at t/T = {phase:.3}{}.",
        of_every(runs)
    );
    let width = Width::Millimetres(150.0);
    Figure { panels, share_x: true, width, caption, ..Figure::new(format!("t/T = {phase:.3}")) }
}

fn surfaces(runs: &[MotorRun<'_>], phase: f64) -> Panel {
    let underside =
        |run: &MotorRun<'_>, i: usize| run.recording.stator[i] + run.recording.film_thickness[i] - run.scene.spacing();
    let all = runs.iter().flat_map(|run| {
        let heights = (0..run.recording.stator.len()).flat_map(move |i| [run.recording.stator[i], underside(run, i)]);
        heights.chain([run.scene.spacing()])
    });
    let [low, high] = with_margin(span(all, 0.0), 0.08);
    let (unit, scale) = prefixed(high.max(-low), "m");
    let (x, metre) = wave_axis(runs);
    let tops = runs.iter().map(|run| {
        let frame = nearest_frame(run.recording, phase);
        let tops = along(run.recording, frame, metre(run.recording), |i| run.recording.stator[i] * scale);
        Line::new("", tops, run.style.width(0.6))
    });
    let rotors = runs.iter().map(|run| {
        let rotor = Lines::at(run.recording, nearest_frame(run.recording, phase) as f64).underside(run.recording);
        let rotor = rotor.into_iter().map(|[x, height]| [x * metre(run.recording), height * scale]);
        Line::new(run.name, rotor, run.style.width(1.3))
    });
    let y = Axis::new("displacement", unit).fixed(low * scale, high * scale);
    Panel::new("(a) surfaces", x, y).layers(tops).layers(rotors).legend(Legend::Above)
}

/// Pressure of the contact or of the film, averaged over the contact width, of all runs.
pub fn pressures(runs: &[MotorRun<'_>], phase: f64, title: &str, of: fn(&Recording) -> &Vec<f64>) -> Panel {
    let all = runs.iter().flat_map(|run| of(run.recording).iter().map(|load| load / run.scene.contact_width));
    let [low, high] = with_margin(span(all, 0.0), 0.06);
    let (unit, scale) = pressure_unit(high.max(-low));
    let (x, metre) = wave_axis(runs);
    let y = Axis::new("pressure", unit).fixed(low * scale, high * scale);
    let lines = runs.iter().map(|run| {
        let (frame, values) = (nearest_frame(run.recording, phase), of(run.recording));
        let pressure = |i: usize| values[i] / run.scene.contact_width * scale;
        Line::new(run.name, along_where_not_zero(run.recording, frame, metre(run.recording), pressure), run.style)
    });
    Panel::new(title, x, y).layer(rest(0.0, "")).layers(lines).legend(Legend::None)
}

/// Film load and contact load over the cycle.
pub fn loads(runs: &[MotorRun<'_>]) -> Figure {
    let greatest = runs.iter().flat_map(|run| run.recording.film_load.iter().chain(&run.recording.contact_load));
    let (unit, scale) = prefixed(span(greatest.copied(), 0.0)[1], "N");
    let panel = |title: &str, of: fn(&Recording) -> &Vec<f64>| {
        let y = Axis::new("load", &unit).including([0.0]);
        let lines = runs.iter().map(|run| Line::new(run.name, over_cycle(of(run.recording), scale), run.style));
        Panel::new(title, Axis::new("t/T", "").fixed(0.0, 1.0), y).height(36.0).layers(lines)
    };
    let film = panel("(a) load of the air film on one wavelength", |recording| &recording.film_load);
    let contact = panel("(b) contact load", |recording| &recording.contact_load);
    let of_every = of_every(runs);
    let caption = format!("Load of the air film (a) and contact load (b) on one wavelength, over one cycle{of_every}.");
    stacked("loads over the cycle", [film, contact], caption)
}

/// Panels below each other; the legend of all is in the first.
fn stacked<const N: usize>(title: &str, panels: [Panel; N], caption: String) -> Figure {
    let mut panels = panels.map(|panel| panel.legend(Legend::None));
    panels[0].legend = Legend::Above;
    let width = Width::Millimetres(110.0);
    Figure { panels: panels.into(), share_x: true, width, caption, ..Figure::new(title) }
}

/// Torque and power over the speed of the rotor.
pub fn torques(runs: &[MotorRun<'_>], performances: &[Performance]) -> Figure {
    let speed = |run: &MotorRun<'_>, speed: f64| rpm(speed, run.scene.contact_radius);
    let fastest = runs.iter().map(|run| speed(run, run.scene.stator_speed())).fold(f64::MIN_POSITIVE, f64::max);
    let panel = |title: &str, name: &str, unit: &str, value: fn(&OperatingPoint) -> f64| {
        let x = Axis::new("speed of the rotor", "rpm").fixed(0.0, fastest);
        let lines = runs.iter().zip(performances).map(|(run, found)| {
            // Values where the rotor is braked are left out; at the end of the driven range the torque is zero except for rounding.
            let end = found.no_load_speed.map_or(f64::INFINITY, |speed| speed.value);
            let driven = found.curve.iter().filter(|point| point.speed <= end);
            let points = driven.map(|point| [speed(run, point.speed), value(point).max(0.0)]);
            Line::new(run.name, points, run.style)
        });
        Panel::new(title, x, Axis::new(name, unit).including([0.0])).height(36.0).layer(rest(0.0, "")).layers(lines)
    };
    let torque = panel("(a) torque of the ring", "torque", "N·m", |point| point.torque.value);
    let power = panel("(b) power given to the rotor", "power", "W", |point| point.output.value);
    let caption = format!(
        "Torque (a) and power given to the rotor (b) of the whole ring over the speed of the rotor{}, with the air film, for Coulomb \
         friction at every point of contact; as far as the rotor is driven.",
        of_every(runs)
    );
    stacked("torque and power over speed", [torque, power], caption)
}

/// Least and greatest pressure of all runs, and its unit.
fn common_pressure<'a>(recordings: impl Iterator<Item = &'a Recording>) -> ([f64; 2], (String, f64)) {
    let span = extent(recordings.flat_map(pressure_span));
    (span, pressure_unit(span[1]))
}

/// The film's pressure under all teeth of every run, with one colour scale.
pub fn maps(runs: &[MotorRun<'_>], phase: f64) -> Figure {
    let (span, _) = common_pressure(runs.iter().map(|run| run.recording));
    let panels = runs
        .iter()
        .map(|run| all_teeth(run.name, run.recording, nearest_frame(run.recording, phase), span).height(11.0));
    let caption = format!(
        "Absolute pressure of the air film under all teeth at t/T = {phase:.3}{}; one scale of colours covers the whole cycle.",
        of_every(runs)
    );
    let title = format!("pressure of the air film, t/T = {phase:.3}");
    Figure { panels: panels.collect(), width: Width::Page, caption, ..Figure::new(title) }
}

/// The film's pressure under the middle tooth of every run, with one colour scale.
pub fn teeth(runs: &[MotorRun<'_>], phase: f64) -> Figure {
    let maps =
        runs.iter().map(|run| tooth_map(run.recording, run.recording.teeth / 2, nearest_frame(run.recording, phase)));
    let [low, high] = extent(maps.flatten());
    let (unit, scale) = pressure_unit(high);
    let panels = runs.iter().map(|run| {
        let frame = nearest_frame(run.recording, phase);
        let range = Range::Fixed(low * scale, high * scale);
        Panel { title: run.name.to_owned(), ..one_tooth(run.recording, frame, range, (unit.clone(), scale)) }
    });
    let caption = format!(
        "Absolute pressure of the air film under the tooth in the middle, with lines of equal pressure, at t/T = {phase:.3}{}.",
        if runs.len() > 1 { "; one scale of colours for all" } else { "" }
    );
    in_pairs("under the tooth in the middle", panels.collect(), caption)
}

/// Panels in rows of two, as wide as a page.
fn in_pairs(title: &str, panels: Vec<Panel>, caption: String) -> Figure {
    Figure { columns: panels.len().clamp(1, 2), panels, width: Width::Page, caption, ..Figure::new(title) }
}

/// Surfaces, pressures and maps at a phase of the cycle, for animations.
pub fn moving_motors(runs: &[MotorRun<'_>], phase: f64) -> Figure {
    let mut figure = waves(runs, phase);
    figure.panels[0].height = 30.0;
    figure.panels[1].height = 20.0;
    figure.panels[2].height = 20.0;
    if runs.len() <= MOVING_MAPS && runs.iter().all(|run| run.recording.length == runs[0].recording.length) {
        figure.panels.extend(maps(runs, phase).panels.into_iter().map(|panel| panel.height(7.0)));
    }
    figure.title = String::new();
    figure
}

/// All figures of several plates, each with its file name. Empty without runs.
pub fn plates(runs: &[PlateRun<'_>]) -> Vec<(&'static str, Figure)> {
    if runs.is_empty() {
        return Vec::new();
    }
    vec![("profiles", profiles(runs)), ("loads", plate_loads(runs)), ("loops", loops(runs)), ("maps", plate_maps(runs))]
}

/// The plates' x axis in lengths or, if all plates are round, in radii; also the length of the unit.
fn plate_axis(runs: &[PlateRun<'_>]) -> (Axis, fn(&Plate) -> f64) {
    let round = runs.iter().filter(|run| run.scene.hole.is_some()).count();
    match round {
        0 => (Axis::new("x/length", "").fixed(-0.5, 0.5), |plate| plate.length),
        all if all == runs.len() => (Axis::new("r/radius", "").fixed(-1.0, 1.0), Plate::radius),
        _ => (Axis::new("x/length, of round plates x/diameter", "").fixed(-0.5, 0.5), |plate| plate.length),
    }
}

fn profile_panel(runs: &[PlateRun<'_>], phase: f64, title: &str) -> Panel {
    let (span, (unit, scale)) = common_pressure(runs.iter().map(|run| run.recording));
    let [low, high] = with_margin(span, 0.06);
    let y = Axis::new("absolute pressure", unit).fixed(low * scale, high * scale);
    let (axis, length) = plate_axis(runs);
    let lines = runs.iter().map(|run| {
        let frame = nearest_frame(run.recording, phase);
        let points = plate::along_the_middle(run.recording, frame, scale, |x| x / length(run.scene));
        Line::new(run.name, points, run.style)
    });
    Panel::new(title, axis, y).layers(lines)
}

/// Pressure along every plate, at y = 0, at the greatest and the least gap.
pub fn profiles(runs: &[PlateRun<'_>]) -> Figure {
    let wide = profile_panel(runs, 0.0, "(a) greatest gap, t = 0").height(34.0);
    let narrow = profile_panel(runs, 0.5, "(b) least gap, t = T/2").height(34.0);
    let caption = format!(
        "Absolute pressure along the middle of {} plate, at the greatest and at the least gap.",
        if runs.len() > 1 { "every" } else { "the" }
    );
    stacked("pressure along the plate", [wide, narrow], caption)
}

/// The load as a mean gauge pressure, so that strips and plates can be overlaid.
fn mean_pressure(runs: &[PlateRun<'_>]) -> (String, f64) {
    let all = runs.iter().flat_map(|run| run.recording.film_load.iter().map(|load| (load / run.scene.area()).abs()));
    pressure_unit(span(all, 0.0)[1])
}

/// Mean gauge pressure over the cycle.
pub fn plate_loads(runs: &[PlateRun<'_>]) -> Figure {
    let (unit, scale) = mean_pressure(runs);
    let lines = runs.iter().map(|run| {
        let points = over_cycle(&run.recording.film_load, scale / run.scene.area());
        Line::new(run.name, points, run.style)
    });
    let panel = Panel::new("", Axis::new("t/T", "").fixed(0.0, 1.0), Axis::new("mean gauge pressure", unit));
    let caption = format!("Load of the film above ambient, over the area, over one cycle{}.", of_every(runs));
    stacked("load over the cycle", [panel.layer(rest(0.0, "")).layers(lines)], caption)
}

/// Mean gauge pressure over the gap relative to its mean.
pub fn loops(runs: &[PlateRun<'_>]) -> Figure {
    let (unit, scale) = mean_pressure(runs);
    let lines = runs.iter().map(|run| {
        let recording = run.recording;
        let at = |m: usize| {
            let gap = recording.min_film_thickness.get(m)? / run.scene.mean_gap;
            Some([gap, recording.film_load.get(m)? / run.scene.area() * scale])
        };
        let closed = (0..=recording.frames).map(|m| m % recording.frames.max(1));
        Line::new(run.name, closed.filter_map(at), run.style)
    });
    let panel = Panel::new("", Axis::new("gap over its mean", ""), Axis::new("mean gauge pressure", unit));
    let caption = format!("Mean gauge pressure of the film against the gap, once round the cycle{}.", of_every(runs));
    stacked("pressure against gap", [panel.layer(rest(0.0, "")).layers(lines)], caption)
}

/// Pressure along every plate and over the cycle, with one colour scale.
pub fn plate_maps(runs: &[PlateRun<'_>]) -> Figure {
    let ([low, high], (unit, scale)) = common_pressure(runs.iter().map(|run| run.recording));
    let panels = runs.iter().map(|run| {
        // Each map is of one plate.
        let (axis, length) = plate_axis(std::slice::from_ref(run));
        let grid = plate::over_length_and_cycle(run.recording, scale, |x| x / length(run.scene));
        let map = pressure_map(grid, &unit, Range::Fixed(low * scale, high * scale));
        let panel = Panel::new(run.name, axis, Axis::new("t/T", "").fixed(0.0, 1.0));
        panel.layer(map).height(40.0)
    });
    let caption = format!(
        "Absolute pressure along the middle of {} and over one cycle.",
        if runs.len() > 1 { "every plate, with one scale of colours for all," } else { "the plate" }
    );
    in_pairs("pressure along the plate and over the cycle", panels.collect(), caption)
}

/// Profiles and loops at a phase of the cycle, for animations.
pub fn moving_plates(runs: &[PlateRun<'_>], phase: f64) -> Figure {
    let profile = profile_panel(runs, phase, "(a) pressure along the plate").legend(Legend::Above);
    let mut round = loops(runs).panels.remove(0).legend(Legend::None);
    round.title = "(b) once round the cycle".to_owned();
    let unit = mean_pressure(runs).1;
    let marker = Marker { size: 5.0, ..Marker::default() };
    let now = runs.iter().filter_map(|run| {
        let m = nearest_frame(run.recording, phase);
        let (gap, load) = (run.recording.min_film_thickness.get(m)?, run.recording.film_load.get(m)?);
        let at = [gap / run.scene.mean_gap, load / run.scene.area() * unit];
        Some(Points::new("", [at], run.style.colour, marker))
    });
    let panels = vec![profile.height(46.0), round.layers(now).height(46.0)];
    Figure { panels, columns: 2, width: Width::Millimetres(170.0), ..Figure::default() }
}
