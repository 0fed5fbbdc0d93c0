//! Solves of neighbouring problems, for differences between them.
//!
//! Two solves to an accuracy of half a per cent differ by up to as much, even if the problems hardly do: each chooses its own grids, terms
//! and harmonics, and stops as soon as its cycle repeats well enough. Here one problem is solved first, and all others by its plan: on
//! the same grids, which move with what is varied, with the same terms left out, with the same elements of a ring, and, where it can, until the cycle repeats much more
//! exactly than an accuracy asks for. The error of the grid is then nearly the same in all of them, and cancels in a difference.

use super::{Method, Record, Settings, SolveError, motor_plan, of_motor, of_plate, performed, plate_plan};
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::ladder::Nested;
use crate::memory;
use crate::motor::{self, Warm};
use crate::plan::Plan;
use crate::plate;
use crate::problem::{Motor, Plate, Problem, RotorCompliance, Scenario};
use crate::solution::{Floating, Outcome, PlateResult, Solution, Status};

/// Relative tolerances for a repeating cycle: of the change of the trapped gas, and of the load.
const TOLERANCE: f64 = 1e-6;
const REPEATING: f64 = 1e-6;

/// A solved problem, near which others can be solved.
#[derive(Debug)]
pub struct Centre {
    plan: Plan,
    warm: Warm,
    /// The problem.
    pub problem: Problem,
    /// Its solution.
    pub solved: Nested<Solution>,
    /// For a plate under a load.
    floating: Option<Afloat>,
}

/// A plate that floats: where, and how stiffly. Near it the gap follows by Newton's method with this stiffness.
#[derive(Clone, Copy, Debug)]
struct Afloat {
    gap: f64,
    stiffness: Estimate,
    harmonic_error: [f64; 2],
}

impl Afloat {
    fn of(problem: &Problem, settings: &Settings, cancel: &Cancel) -> Result<Option<Self>, SolveError> {
        if !matches!(problem.scenario, Scenario::Plate(Plate { load: Some(_), .. })) {
            return Ok(None);
        }
        Ok(match super::solve(problem, settings, &mut (), cancel)?.outcome {
            Outcome::Plate(PlateResult { floating: Some(floating), harmonic_error, .. }) => {
                Some(Self { gap: floating.mean_gap.value, stiffness: floating.stiffness, harmonic_error })
            }
            _ => None,
        })
    }

    /// The plate at this gap, if one is given.
    fn at(plate: &Plate, gap: Option<f64>) -> Plate {
        Plate { mean_gap: gap.unwrap_or(plate.mean_gap), ..plate.clone() }
    }

    /// The gap \[m\] at which a film that has this `carried` load \[N or N/m\] at `gap` carries that of `plate`.
    fn next(&self, plate: &Plate, gap: f64, carried: f64) -> f64 {
        gap + (carried - plate.load.unwrap_or(carried)) / self.stiffness.value
    }
}

/// The solution of a plate, with the gap at which it floats.
fn solution_of_plate(
    found: plate::Periodic,
    problem: &Problem,
    floating: Option<&Afloat>,
    plate: &Plate,
    plan: &Plan,
    cancel: &Cancel,
) -> Solution {
    let mut solution = of_plate(found, plan, cancel);
    if let (Some(afloat), Outcome::Plate(result)) = (floating, &mut solution.outcome) {
        let stiffness = afloat.stiffness;
        let value = afloat.next(plate, plate.mean_gap, result.film_load.value);
        let mean_gap = Estimate { value, error: result.film_load.error / stiffness.value.abs() };
        // The stiffness is that of the centre, and so is what the error of the gap adds to others: how they differ here is not known.
        let natural_frequency = Estimate { value: f64::NAN, error: f64::NAN };
        result.floating = Some(Floating { mean_gap, stiffness, natural_frequency, slow: None });
        result.harmonic_error = afloat.harmonic_error;
        result.min_film_thickness.error = mean_gap.error;
    }
    performed(problem, solution)
}

/// Number of solves at gaps near that of the centre until the film carries the load. If the stiffness has a relative error e, the last gap
/// is off by e² times its change.
const NEWTON: usize = 3;
/// If the next gap would differ by more than this fraction, the problem is not near.
const ARRIVED: f64 = 0.01;

/// A plate as it was solved, at the gap at which it floats, and the plan with the grids that were used.
struct Floated {
    solved: Nested<plate::Periodic>,
    plate: Plate,
    plan: Plan,
}

/// Solves the plate by this plan; one under a load where the film of this plan carries it.
fn float(plate: &Plate, plan: &Plan, floating: Option<&Afloat>, cancel: &Cancel) -> Result<Floated, SolveError> {
    let mut plate = plate.clone();
    let mut solves = 1;
    loop {
        let (solved, used) = plate::periodic_near(&plate, plan, cancel)?;
        let near = is_settled(solved.fine.status) && alike(plan, &used);
        match floating.filter(|_| near && solves < NEWTON) {
            Some(afloat) => plate.mean_gap = afloat.next(&plate, plate.mean_gap, solved.fine.result.film_load.value),
            None => return Ok(Floated { solved, plate, plan: used }),
        }
        solves += 1;
    }
}

impl Centre {
    /// Solves `problem` as exactly as `settings` ask for, of which method and record have no effect.
    ///
    /// # Errors
    /// As [`super::solve`].
    pub fn new(problem: &Problem, settings: &Settings, cancel: &Cancel) -> Result<Self, SolveError> {
        let settings = Settings { record: Record::Numbers, method: Method::Auto, ..*settings };
        let spec = settings.fidelity.spec();
        let cold = Warm::default();
        // First to find the grids that the accuracy needs; then by them, until the cycle repeats.
        match &problem.scenario {
            Scenario::Motor(motor) => {
                let plan = motor_plan(motor, problem, &settings, &spec, cancel)?;
                let _taken = memory::take(memory::motor(motor, &plan), cancel)?;
                let (mut found, mut warm, mut plan) = motor::periodic_near(&cold, motor, &plan, cancel)?;
                if is_settled(found.fine.status) {
                    let (again, state, exact) = motor::periodic_near(&warm, motor, &tight(&plan), cancel)?;
                    if is_settled(again.fine.status) && alike(&plan, &exact) {
                        (found, warm, plan) = (again, state, exact);
                    }
                }
                let of = |found| {
                    let mut solution = performed(problem, of_motor(found, motor, &plan, cancel));
                    solution.warnings.extend(motor.compliance_not_covered());
                    solution
                };
                let solved = found.map(of);
                Ok(Self { plan, warm, problem: problem.clone(), solved, floating: None })
            }
            Scenario::Plate(plate) => {
                let floating = Afloat::of(problem, &settings, cancel)?;
                let plate = &Afloat::at(plate, floating.as_ref().map(|afloat| afloat.gap));
                let plan = plate_plan(plate, problem, &settings, &spec);
                let _taken = memory::take(memory::plate(plate, &plan), cancel)?;
                let mut found = float(plate, &plan, floating.as_ref(), cancel)?;
                if is_settled(found.solved.fine.status) {
                    let exact = float(plate, &tight(&found.plan), floating.as_ref(), cancel)?;
                    if is_settled(exact.solved.fine.status) && alike(&found.plan, &exact.plan) {
                        found = exact;
                    }
                }
                let Floated { solved, plate, plan } = found;
                let of = |found| solution_of_plate(found, problem, floating.as_ref(), &plate, &plan, cancel);
                let solved = solved.map(of);
                Ok(Self { plan, warm: cold, problem: problem.clone(), solved, floating })
            }
        }
    }

    /// Whether its cycle repeats: if it does not, a difference from it means nothing.
    pub fn is_settled(&self) -> bool {
        is_settled(self.solved.fine.status)
    }

    /// Bound of what the plan leaves out of the model, as a share of the headline; a rotor that floats carries its load whatever that is.
    pub fn left_out(&self) -> f64 {
        match &self.solved.fine.outcome {
            Outcome::Motor(result) if result.levitated => self.plan.forced,
            _ => self.plan.left_out,
        }
    }

    /// Solves a problem of the same kind near this one, by its plan and from its state: the result does not depend on what else was solved.
    /// `None` if it has no periodic state on all of these grids, or the plate floats at quite another gap: it is then not near.
    ///
    /// # Errors
    /// As [`super::solve`].
    pub fn solve(&self, problem: &Problem, cancel: &Cancel) -> Result<Option<Nested<Solution>>, SolveError> {
        match &problem.scenario {
            Scenario::Motor(motor) => {
                let settings = Settings { record: Record::Numbers, ..Settings::default() };
                let meshed = self.meshed(motor);
                let own = motor_plan(&meshed, problem, &settings, &settings.fidelity.spec(), cancel)?;
                let plan = self.plan.near(&own.rotor);
                let _taken = memory::take(memory::motor(motor, &plan), cancel)?;
                let (found, _, used) = motor::periodic_near(&self.warm, motor, &plan, cancel)?;
                let near = is_settled(found.fine.status) && alike(&plan, &used);
                Ok(near.then(|| found.map(|found| performed(problem, of_motor(found, motor, &plan, cancel)))))
            }
            Scenario::Plate(plate) => {
                let plate = Afloat::at(plate, self.floating.map(|afloat| afloat.gap));
                let _taken = memory::take(memory::plate(&plate, &self.plan), cancel)?;
                let Floated { solved, plate, plan } = float(&plate, &self.plan, self.floating.as_ref(), cancel)?;
                let left = |afloat: Afloat| afloat.next(&plate, plate.mean_gap, solved.fine.result.film_load.value);
                let arrived = self.floating.is_none_or(|afloat| (left(afloat) / plate.mean_gap - 1.0).abs() < ARRIVED);
                let near = arrived && is_settled(solved.fine.status) && alike(&self.plan, &plan);
                let of = |found| solution_of_plate(found, problem, self.floating.as_ref(), &plate, &self.plan, cancel);
                Ok(near.then(|| solved.map(of)))
            }
        }
    }

    /// The motor, whose ring has the elements of that of this one: what they leave of its compliance then cancels in a difference.
    fn meshed(&self, motor: &Motor) -> Motor {
        let Scenario::Motor(own) = &self.problem.scenario else { return motor.clone() };
        match (&motor.rotor, &own.rotor) {
            (RotorCompliance::Ring(section), RotorCompliance::Ring(pattern))
                if section != pattern || motor.wave() != own.wave() =>
            {
                let section = section.meshed_as(pattern, own.wave().band);
                Motor { rotor: RotorCompliance::Ring(section), ..motor.clone() }
            }
            _ => motor.clone(),
        }
    }
}

fn tight(plan: &Plan) -> Plan {
    Plan { tolerance: plan.tolerance.min(TOLERANCE), accuracy: REPEATING, ..plan.clone() }
}

/// Whether a cycle repeats, however exactly its numbers are known.
pub fn is_settled(status: Status) -> bool {
    matches!(status, Status::Converged | Status::NotResolved { .. })
}

/// Whether both have the same grids.
fn alike(asked: &Plan, used: &Plan) -> bool {
    asked.grids == used.grids && asked.spectral == used.spectral
}
