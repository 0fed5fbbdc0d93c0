//! The figures of one solve: what `--out` writes, what the window offers, what reports are made of.
//!
//! | scene | figure | what it shows |
//! | --- | --- | --- |
//! | motor | `wave` | surfaces, contact pressure and film pressure along one wavelength at an instant, as the paper's Fig. 4 |
//! | motor | `loads` | film load, contact load and teeth in contact over the cycle |
//! | motor | `map` | pressure of the film under all teeth at that instant, and under the tooth in the middle |
//! | motor | `torque` | torque, power and efficiency over the speed of the rotor, with the film and without |
//! | plate | `profile` | pressure along the plate at four instants |
//! | plate | `loads` | load and gap over the cycle |
//! | plate | `loop` | mean pressure against the gap |
//! | plate | `map` | pressure over the plate at its greatest; of a strip, along it and over the cycle |
//! | plate | `exact` | spring and damping over the squeeze number, load over the cycle, beside what is known exactly |
//! | several motors | `waves`, `loads`, `torque`, `maps`, `teeth` | runs laid over each other, maps with one scale of colours |
//! | several plates | `profiles`, `loads`, `loops`, `maps` | the same |
//! | both | `convergence` | change in every round, if the rounds were kept |

pub mod compare;
pub mod exact;
pub mod motor;
pub mod plate;
mod series;
pub mod surface;
pub mod torque;
mod unit;

pub(super) use series::mirrored;

use super::figure::{Axis, Dash, Figure, Line, Mark, Panel, Provenance, Style};
use crate::analysis::exact::ExactComparison;
use crate::analysis::torque::TorqueCurves;
use crate::control::Progress;
use crate::problem::{Problem, Scenario};
use crate::scene::show_text;
use crate::solution::{Outcome, Solution};

/// All figures of a solve, each with its file name without extension. `history` is the rounds, if they were kept; `curves` is torque over
/// speed, if it is known.
pub fn of(
    problem: &Problem,
    solution: &Solution,
    history: &[Progress],
    curves: Option<&TorqueCurves>,
) -> Vec<(&'static str, Figure)> {
    let recording = &solution.recording;
    let mut figures = Vec::new();
    match &problem.scenario {
        _ if recording.frames == 0 || recording.x.is_empty() => {}
        Scenario::Motor(scene) => {
            let frame = motor::crest_in_the_middle(recording);
            figures.push(("wave", motor::wave(scene, recording, frame)));
            figures.push(("loads", motor::loads(scene, recording)));
            figures.push(("map", motor::map(scene, recording, frame)));
        }
        Scenario::Plate(scene) => {
            figures.push(("profile", plate::profile(scene, recording)));
            figures.push(("loads", plate::loads(scene, recording)));
            figures.push(("loop", plate::pressure_gap_loop(scene, recording)));
            figures.push(("map", plate::map(scene, recording)));
            if let Outcome::Plate(result) = &solution.outcome {
                let comparison = ExactComparison::of(scene, result, recording);
                figures.push(("exact", exact::exact(scene, &comparison, recording)));
            }
        }
    }
    if !history.is_empty() {
        figures.push(("convergence", convergence(history)));
    }
    figures.extend(curves.map(|curves| ("torque", torque::torque(curves))));
    // The scene's name is above the figure, and the provenance below.
    for (_, figure) in &mut figures {
        figure.title = format!("{}: {}", show_text(&problem.name), figure.title);
        figure.provenance = Provenance::of(problem, solution);
    }
    figures
}

/// The change in every round on every grid, and the tolerance.
pub fn convergence(history: &[Progress]) -> Figure {
    // A plate that floats was solved at several gaps.
    let history = Progress::last_solve(history);
    let grids = Progress::grids(history).count();
    let mut tolerances: Vec<f64> = Vec::new();
    for round in history {
        if !tolerances.contains(&round.tolerance) {
            tolerances.push(round.tolerance);
        }
    }
    let allowed = tolerances.iter().map(|tolerance| {
        let mut mark = Mark::horizontal(*tolerance, if *tolerance == tolerances[0] { "allowed" } else { "" });
        mark.style.dash = Dash::Dashed;
        mark
    });
    let changes = Progress::grids(history).enumerate().map(|(grid, rounds)| {
        let points = rounds.iter().enumerate().map(|(i, round)| [i as f64 + 1.0, round.residual]);
        Line::new(format!("grid {} of {grids}", grid + 1), points, Style::nth(grid))
    });
    let y = Axis::new("relative change in a round", "").log().including(tolerances.clone());
    let panel = Panel::new("", Axis::new("round", "").whole(), y).layers(allowed).layers(changes);
    let least = history.iter().map(|round| round.residual).fold(f64::INFINITY, f64::min);
    Figure::new("convergence").panel(panel).caption(format!(
        "Relative change in every round of the outer iteration on each of {grids} grids; the least was {least:.1e}."
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_change_is_that_of_a_round_although_less_was_allowed() {
        let round = |iteration, residual| Progress {
            level: 0,
            levels: 1,
            iteration,
            residual,
            tolerance: 1e-6,
            film_load: 0.0,
        };
        let caption = convergence(&[round(1, 2e-2), round(2, 3e-4)]).caption;
        assert!(caption.ends_with("the least was 3.0e-4."), "{caption}");
    }
}
