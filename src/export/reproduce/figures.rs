//! The paper's figures, computed again.

use crate::analysis::reproduce::{Both, FIELDS, Reproduction};
use crate::estimate::Estimate;
use crate::export::figure::{
    Axis, Band, Colour, Dash, Figure, Legend, Line, Marker, Panel, Points, Provenance, Shape, Style, Width,
};
use crate::export::figures::compare::{MotorRun, pressures};
use crate::export::figures::motor::{crest_in_the_middle, surfaces};
use crate::problem::{RotorCompliance, Scenario};
use crate::recording::Recording;
use crate::solution::Solution;

/// The figures with their numbers; those that could not be solved are left out.
pub fn figures(all: &Reproduction) -> Vec<(u32, Figure)> {
    let mut figures = Vec::new();
    if let Some(figure) = all.row("fundamental").and_then(|row| green(&row.both)) {
        figures.push((3, figure));
    }
    figures.extend(FIELDS.iter().filter_map(|(number, preset, name)| {
        let row = all.row(preset)?;
        Some((*number, fields(&row.both, &format!("Fig. {number}: {name}"))?))
    }));
    figures.push((10, frequencies(all)));
    figures.sort_by_key(|(number, _)| *number);
    figures
}

/// Deflection of the rotor under a point load.
fn green(both: &Both) -> Option<Figure> {
    let Scenario::Motor(motor) = &both.problem.scenario else { return None };
    let RotorCompliance::Beam { decay_length, point_compliance, local_compliance } = motor.rotor else { return None };
    let half = 0.5 * motor.wavelength();
    let beam = |x: f64| {
        let s = x.abs() / decay_length;
        point_compliance * (-s).exp() * (s.cos() + s.sin())
    };
    let points = (-200..=200).map(|i| f64::from(i) / 200.0 * half).map(|x| [x * 1e3, beam(x) * 1e6]);
    let spacing = motor.wavelength() / 180.0;
    let nodes = (-90..=90).map(|j| (f64::from(j) * spacing, if j == 0 { local_compliance / spacing } else { 0.0 }));
    let nodes = nodes.map(|(x, local)| [x * 1e3, (beam(x) + local) * 1e6]);
    let marker = Marker { size: 2.4, ..Marker::solid(Shape::Circle) };
    let panel = Panel::new(
        "",
        Axis::new("x from the load", "mm").fixed(-half * 1e3, half * 1e3),
        Axis::new("deflection", "µm/N").including([0.0]),
    )
    .layer(Points::new("on the 181 nodes, with the local compliance", nodes, Colour::BLACK, marker))
    .layer(Line::new("beam on an elastic foundation", points, Style::solid(Colour::FILM)))
    .height(44.0)
    .legend(Legend::Above);
    let (width, provenance) = (Width::Millimetres(110.0), Provenance::named(&both.problem.name));
    let title = "Fig. 3: deflection of the rotor under a unit point load";
    Some(Figure { width, provenance, ..Figure::new(title) }.panel(panel).caption(
        "The paper took this Green's function from a finite element model of the rotor (2162 elements) and shows it as a curve, \
         which is not known to us. Here it is the beam that was fitted to Table I; the point at the load carries the local \
         compliance, spread over one contact spacing.",
    ))
}

const PAPER: &str = "paper's algorithm";
const OURS: &str = "converged";

fn recording(solution: &Solution) -> Option<&Recording> {
    Some(&solution.recording).filter(|recording| recording.frames > 0)
}

/// Surfaces, contact pressure and film pressure with the crest in the middle, as in the paper's figures, by both methods.
fn fields(both: &Both, title: &str) -> Option<Figure> {
    let Scenario::Motor(motor) = &both.problem.scenario else { return None };
    let solution = both.ours.as_ref().ok()?;
    let ours = recording(solution)?;
    let frame = crest_in_the_middle(ours);
    let phase = frame as f64 / ours.frames as f64;
    let run = |name, recording, style| MotorRun { name, scene: motor, recording, style };
    let mut contact = vec![run(OURS, ours, Style::solid(Colour::CONTACT))];
    let mut film = vec![run(OURS, ours, Style::solid(Colour::FILM))];
    if let Some(paper) = both.paper.as_ref().ok().and_then(recording) {
        let style = Style { width: 0.8, ..Style::solid(Colour::BLACK).dash(Dash::Dotted) };
        contact.push(run(PAPER, paper, style));
        film.push(run(PAPER, paper, style));
    }
    let panel =
        |runs: &[MotorRun<'_>], title: &str, of| pressures(runs, phase, title, of).height(28.0).legend(Legend::Above);
    let (width, provenance) = (Width::Millimetres(115.0), Provenance::of(&both.problem, solution));
    let figure = Figure { share_x: true, width, provenance, ..Figure::new(title) }
        .panel(surfaces(motor, ours, frame).height(36.0))
        .panel(panel(&contact, "(b) contact pressure", |recording| &recording.contact))
        .panel(panel(&film, "(c) film pressure, gauge", |recording| &recording.film));
    Some(figure)
}

/// α over the frequency, with the published points.
fn frequencies(all: &Reproduction) -> Figure {
    let value = |point: &crate::analysis::reproduce::FrequencyPoint| {
        point.solved.as_ref().map_or(Estimate::exact(f64::NAN), |result| result.alpha)
    };
    let band = all.frequencies.iter().map(|point| {
        let Estimate { value: alpha, error } = value(point);
        [point.frequency_khz, alpha - error, alpha + error]
    });
    let curve = all.frequencies.iter().map(|point| [point.frequency_khz, value(point).value]);
    let (mut published, mut paper) = (Vec::new(), Vec::new());
    for row in &all.rows {
        let name = row.published.preset.as_str();
        if name != "fundamental" && !name.starts_with("frequency-") {
            continue;
        }
        let Scenario::Motor(motor) = &row.both.problem.scenario else { continue };
        published.push([motor.frequency * 1e-3, row.published.published_alpha]);
        if let Some(result) = Both::result(&row.both.paper) {
            paper.push([motor.frequency * 1e-3, result.alpha.value]);
        }
    }
    let square = Marker { size: 6.0, ..Marker::hollow(Shape::Square) };
    let panel = Panel::new("", Axis::new("frequency of the stator", "kHz").log(), Axis::new("α", "").including([0.0]))
        .layer(Band::new("stated error", band, Colour::FILM))
        .layer(Line::new(OURS, curve, Style::solid(Colour::FILM)))
        .layer(Points::new("published", published, Colour::CONTACT, square))
        .layer(Points::new(PAPER, paper, Colour::BLACK, Marker { size: 2.6, ..Marker::solid(Shape::Circle) }))
        .height(52.0);
    let (width, provenance) = (Width::Millimetres(110.0), Provenance::named("Fundamental case"));
    let title = "Fig. 10: effect of the stator vibrating frequency";
    Figure { width, provenance, ..Figure::new(title) }.panel(panel).caption(
        "The ratio α over the frequency, all else as in the fundamental case. Published: the rows of Table I, whose points \
         Fig. 10 shows. The stated error is narrower than the line nearly everywhere.",
    )
}
