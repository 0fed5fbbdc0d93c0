//! The limits of the model: for each neglected effect, a number beside the limit up to which it may be neglected.
//!
//! Numbers, limits, derivations and sources are listed in `docs/theory.md`, section 9. `rotor-resonance` applies only to a ring that has
//! been solved, because a beam or a table has no mass.
//!
//! Density, heat and sound are those of the gas that the scene names. **One that is given by viscosity and mean free path is taken to
//! be air at 20 °C**: kinetic theory gives ρ = πμ²/(2 p_a λ_a²), which is air's within 3 % for the preset values; but λ_a may be 0, and
//! stays what it was while pressure is swept. The thermal diffusivity κ = μ/(ρ Pr) follows the viscosity in either case.

mod limits;

pub(super) use limits::known_names;
pub use limits::{ExceededLimit, NAMES, mach};

use crate::plan::{Choice, Decision};
use crate::problem::{Motor, Plate, Problem, Scenario};
use crate::solution::{Outcome, Solution, settled};
use limits::{Film, curvature, dense, nearness, resonance, roughness, sliding, stress};
use std::borrow::Cow;
use std::f64::consts::TAU;

/// The limits that a scene exceeds, from its solution; empty if it exceeds none.
pub fn outside(problem: &Problem, solution: &Solution) -> Vec<ExceededLimit> {
    of_outcome(problem, Some(&solution.outcome), &solution.model.decisions)
}

/// The limits that a scene exceeds, from an outcome and the decisions made for it. Without an outcome, they follow from the scene alone;
/// the closed film of a motor then has the minimum spacing, and there is no contact.
pub fn of_outcome(problem: &Problem, outcome: Option<&Outcome>, decisions: &[Decision]) -> Vec<ExceededLimit> {
    let problem = &*outcome.map_or(Cow::Borrowed(problem), |outcome| settled(problem, outcome));
    match &problem.scenario {
        Scenario::Motor(motor) => of_motor(motor, outcome, decisions),
        Scenario::Plate(plate) => of_plate(plate, outcome),
    }
}

/// Their names, without repetitions.
pub fn names(exceeded: &[ExceededLimit]) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = exceeded.iter().map(|excess| excess.name).collect();
    // Entries with the same name are adjacent.
    names.dedup();
    names
}

/// Note beside a headline: `outside the limits of the model: sound, thinness`; `None` if no limit is exceeded.
pub fn beside_headline(exceeded: &[ExceededLimit]) -> Option<String> {
    let names: Vec<String> = names(exceeded).iter().map(|name| name.replace('-', " ")).collect();
    (!names.is_empty()).then(|| format!("outside the limits of the model: {}", names.join(", ")))
}

fn of_motor(motor: &Motor, outcome: Option<&Outcome>, decisions: &[Decision]) -> Vec<ExceededLimit> {
    let result = outcome.and_then(Outcome::motor);
    let closed =
        result.map(|result| result.min_film_thickness.value).filter(|gap| gap.is_finite()).unwrap_or(motor.min_spacing);
    let contact = result.map_or(0.0, |result| result.max_contact);
    let natural = decisions.iter().find_map(|decision| match decision.chosen {
        Choice::Rotor { resonances, .. } => resonances,
        _ => None,
    });
    let film = Film {
        gas: &motor.gas,
        omega: TAU * motor.frequency,
        gap: closed + motor.normal_amplitude,
        closed,
        side: motor.tooth_width.min(motor.contact_width),
        amplitude: motor.normal_amplitude,
        body: "tooth top",
    };
    let found = [
        film.inertia(),
        film.heat(),
        film.slip(),
        film.sound(),
        sliding(motor),
        dense(highest_pressure(outcome)),
        natural.and_then(|natural| resonance(motor, &natural)),
        stress(motor, contact / motor.contact_width),
        roughness(motor, closed),
        film.thinness(),
        curvature(motor),
    ];
    found.into_iter().flatten().collect()
}

/// Highest pressure of the gas \[Pa\], as far as it is known.
fn highest_pressure(outcome: Option<&Outcome>) -> f64 {
    outcome.map_or(0.0, |outcome| match outcome {
        Outcome::Motor(result) => result.max_pressure.value,
        Outcome::Plate(result) => result.max_pressure.value,
    })
}

fn of_plate(plate: &Plate, outcome: Option<&Outcome>) -> Vec<ExceededLimit> {
    let film = Film {
        gas: &plate.gas,
        omega: TAU * plate.frequency,
        gap: plate.mean_gap,
        closed: plate.mean_gap - plate.amplitude,
        side: plate.width.map_or(plate.section(), |width| width.min(plate.length)),
        amplitude: plate.amplitude,
        body: "plate",
    };
    let dense = dense(highest_pressure(outcome));
    let found = [film.inertia(), film.heat(), film.slip(), film.sound(), dense, film.thinness(), nearness(plate)];
    found.into_iter().flatten().collect()
}
