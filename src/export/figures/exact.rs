//! A plate beside exact results.

use super::plate::force;
use super::series::{over_cycle, rest, span, with_margin};
use super::unit::prefixed;
use crate::analysis::exact::{ExactComparison, crossover};
use crate::export::figure::{Axis, Colour, Dash, Figure, Legend, Line, Mark, Marker, Panel, Points, Shape, Style};
use crate::plate::harmonic::linear;
use crate::problem::Plate;
use crate::recording::Recording;
use crate::solution::Harmonic;

/// Points of a curve.
const SAMPLES: usize = 121;
/// A limit is shown whole if its range is at most this many times that of the load.
const WHOLE: f64 = 2.0;
/// Least share of the cycle in which a limit must be on the axes; otherwise it would be only a few steep lines.
const LEAST_INSIDE: f64 = 0.3;

/// Spring and damping over the squeeze number, with the present solve as points, and the load over the cycle with its limits.
pub fn exact(plate: &Plate, found: &ExactComparison, recording: &Recording) -> Figure {
    let caption = format!(
        "Spring and damping of the film, parts of the load in phase with the approach and with its speed over p_a · area · ε, for \
         small amplitudes over the squeeze number (a) with those of this solve as points, ε = {}; load over one cycle with \
         those of gas that cannot leave (Boyle) and of gas that is not compressed (b).",
        crate::digits::significant(plate.amplitude / plate.mean_gap, 3)
    );
    Figure::new("computed and exact")
        .panel(coefficients(plate, found).height(42.0))
        .panel(cycle(plate, found, recording).height(38.0))
        .caption(caption)
}

fn coefficients(plate: &Plate, found: &ExactComparison) -> Panel {
    let present = found.effective_squeeze_number;
    let crossover = crossover(plate.outline());
    let (from, to) = ((crossover / 300.0).min(present / 4.0), (crossover * 300.0).max(present * 4.0));
    let at = |i: usize| {
        let sigma = from * (to / from).powf(i as f64 / (SAMPLES - 1) as f64);
        let Harmonic { spring, damping } = linear(sigma, plate.outline());
        ([sigma, spring], [sigma, damping])
    };
    let (spring, damping): (Vec<_>, Vec<_>) = (0..SAMPLES).map(at).unzip();
    let computed = found.solved.map(|solved| [solved.spring, solved.damping]);
    let top = computed.into_iter().flatten().map(|part| part.value).fold(1.0, f64::max);
    let x = Axis::new("squeeze number over slip factor, σ/Q", "").log().fixed(from, to);
    let y = Axis::new("part of load / p_{a} A ε", "").fixed(0.0, 1.12 * top);
    let parts =
        [("spring, computed", Colour::FILM, Shape::Circle), ("damping, computed", Colour::CONTACT, Shape::Square)];
    let parts = computed.into_iter().flatten().zip(parts).map(|(part, (name, colour, shape))| {
        let marker = Marker { size: 5.0, ..Marker::solid(shape) };
        let errors = if part.error.is_finite() { vec![part.error] } else { Vec::new() };
        Points { errors, ..Points::new(name, [[present, part.value]], colour, marker) }
    });
    Panel::new("(a) first harmonic of the load", x, y)
        .layer(Mark::vertical(present, ""))
        .layer(Line::new("spring, ε → 0", spring, Style::solid(Colour::FILM)))
        .layer(Line::new("damping, ε → 0", damping, Style::solid(Colour::CONTACT).dash(Dash::Dashed)))
        .layers(parts)
        .legend(Legend::Above)
}

fn cycle(plate: &Plate, found: &ExactComparison, recording: &Recording) -> Panel {
    let load = &recording.film_load;
    let mut range = span(load.iter().copied(), 0.0);
    let most = WHOLE * (range[1] - range[0]);
    for limit in [&found.boyle, &found.viscous] {
        let [low, high] = span(limit.iter().copied(), 0.0);
        if high - low <= most {
            range = [range[0].min(low), range[1].max(high)];
        }
    }
    let (unit, scale) = prefixed(range[1].max(-range[0]), force(plate));
    let [low, high] = with_margin(range, 0.08);
    let y = Axis::new("film load", unit).fixed(low * scale, high * scale);
    let lines = [
        ("trapped (Boyle)", &found.boyle, Style::solid(Colour::CONTACT).dash(Dash::Dashed)),
        ("incompressible", &found.viscous, Style::solid(Colour::ROTOR).dash(Dash::DashDot)),
        ("computed", load, Style::solid(Colour::FILM)),
    ];
    Panel::new("(b) load over the cycle", Axis::new("t/T", "").fixed(0.0, 1.0), y)
        .layer(rest(0.0, ""))
        .layers(lines.map(|(name, loads, style)| {
            let inside = loads.iter().filter(|load| (low..=high).contains(*load)).count();
            if inside < (LEAST_INSIDE * loads.len() as f64) as usize {
                return Line::new(format!("{name}: off the scale"), [], style);
            }
            Line::new(name, over_cycle(loads, scale), style)
        }))
        .legend(Legend::Above)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Cancel;
    use crate::export::figure::{Layer, Range};
    use crate::problem::Problem;
    use crate::scene::presets;
    use crate::solve::{Settings, solve};

    #[test]
    fn the_present_squeeze_number_is_well_inside_the_curves() {
        for khz in ["0.001", "1", "10000"] {
            let scene = presets::find("plate-crossover").unwrap().with([("plate.frequency_khz", khz)]).unwrap();
            let problem = Problem::try_from(&scene).unwrap();
            let solution = solve(&problem, &Settings::default(), &mut (), &Cancel::new()).unwrap();
            let (plate, result) = problem.scenario.plate().zip(solution.outcome.plate()).unwrap();
            let found = ExactComparison::of(plate, result, &solution.recording);
            let panel = coefficients(plate, &found);
            let (present, Range::Fixed(from, to)) = (found.effective_squeeze_number, &panel.x.range) else {
                panic!("{:?}", panel.x.range)
            };
            assert!(*from <= 0.26 * present && 3.9 * present <= *to, "{from} {present} {to}");
            // The incompressible film is far from the solution where the gas is trapped, and the trapped gas where all of it leaves.
            let panel = cycle(plate, &found, &solution.recording);
            let lines =
                panel.layers.iter().filter_map(|layer| if let Layer::Line(line) = layer { Some(line) } else { None });
            let off: Vec<&str> =
                lines.map(|line| line.name.as_str()).filter(|name| name.contains("off the scale")).collect();
            let expected: &[&str] = match khz {
                "0.001" => &["trapped (Boyle): off the scale"],
                "1" => &[],
                _ => &["incompressible: off the scale"],
            };
            assert_eq!(off, expected, "{khz}");
        }
    }
}
