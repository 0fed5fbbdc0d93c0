//! A plate that is dropped, as JSON and as CSV, with the same names, and as a figure.

use super::json::kind;
use super::startup::periodic;
use crate::analysis::validity::{ExceededLimit, of_outcome};
use crate::estimate::Estimate;
use crate::export::figure::{Axis, Band, Colour, Figure, Line, Panel, Provenance, Style};
use crate::fall::{Cycle, Fall};
use crate::fidelity::Fidelity;
use crate::problem::{Problem, Scenario};
use crate::solution::Status;
use serde_json::{Value, json};

/// The plate at the end of a cycle of the vibration; cycle 0 is the beginning.
pub fn row(cycle: &Cycle) -> Value {
    json!({
        "cycle": cycle.number,
        "time_us": cycle.time * 1e6,
        "height_um": cycle.height.value * 1e6,
        "height_error_um": cycle.height.error * 1e6,
        "speed_mm_per_s": cycle.speed * 1e3,
        "rests": cycle.rests,
    })
}

/// The object of `--json`: a fall that ended, and its cycles. `wall_s` is the wall time by the caller's clock, including the periodic
/// solve. Unknown values are null.
pub fn object(problem: &Problem, fidelity: Fidelity, ended: &Fall, cycles: &[Cycle], wall_s: f64) -> Value {
    let floats = floats(ended);
    json!({
        "preset": problem.name,
        "scene": kind(problem),
        "fidelity": fidelity.to_string(),
        "converged": ended.status == Status::Converged,
        "mean_gap_um": floats.map(|found| found.value),
        "mean_gap_error_um": floats.map(|found| found.error),
        "wall_s": wall_s,
        "rows": cycles.iter().map(row).collect::<Vec<_>>(),
        "validity": validity(problem, ended, cycles),
        "warnings": ended.floats.as_ref().err().into_iter().collect::<Vec<_>>(),
    })
}

/// The limits of the model that are exceeded where the plate floats or, if it does not float, where it would rest. If it is thrown up
/// higher than it was dropped from, they are those at its greatest height.
pub fn validity(problem: &Problem, ended: &Fall, cycles: &[Cycle]) -> Vec<ExceededLimit> {
    let mut problem = problem.clone();
    let heights = || cycles.iter().map(|cycle| cycle.height.value);
    let highest = heights().fold(0.0, f64::max);
    let thrown = heights().next().is_some_and(|start| highest > start);
    if let Scenario::Plate(plate) = &mut problem.scenario {
        if thrown {
            plate.mean_gap = highest;
        } else if ended.outcome.is_none() {
            *plate = plate.resting();
        }
    }
    of_outcome(&problem, ended.outcome.as_ref().filter(|_| !thrown), &[])
}

/// The mean gap \[µm\] at which it floats; `None` if it does not.
pub fn floats(ended: &Fall) -> Option<Estimate> {
    ended.floats.as_ref().ok().map(|gap| *gap * 1e6)
}

/// Height over time, and the final height by the periodic solve, in µm.
pub fn panel(cycles: &[Cycle], floats: Option<Estimate>) -> Panel {
    let at = |cycle: &Cycle| (cycle.time * 1e3, cycle.height * 1e6);
    let around = |(t, Estimate { value, error }): (f64, Estimate)| [t, value - error, value + error];
    let line = cycles.iter().map(at).map(|(t, height)| [t, height.value]);
    let end = floats.into_iter().map(|gap| {
        let ends = [cycles.first(), cycles.last()].into_iter().flatten().map(|cycle| (at(cycle).0, gap));
        Band::new("", ends.map(around), Colour::ROTOR)
    });
    Panel::new("", Axis::new("t", "ms"), Axis::new("height", "µm").including([0.0]))
        .layers(end)
        .layers(floats.map(|gap| periodic(gap.value)))
        .layer(Band::new("error", cycles.iter().map(at).map(around), Colour::FILM))
        .layer(Line::new("height", line, Style::solid(Colour::FILM)))
}

/// The panel as a figure of its own.
pub fn figure(problem: &Problem, fidelity: Fidelity, ended: &Fall, cycles: &[Cycle]) -> Figure {
    let caption = "Height of the plate, the gap without the vibration, from where it is dropped.";
    let provenance = Provenance { fidelity: fidelity.to_string(), ..Provenance::named(&problem.name) };
    let figure = Figure { provenance, ..Figure::new("dropped on the vibration") };
    figure.panel(panel(cycles, floats(ended))).caption(caption)
}
