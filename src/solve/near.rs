//! Solves of problems that are near each other, for differences between them.
//!
//! Two solves to an accuracy of half a per cent differ by up to as much, even if the problems hardly do: each chooses its own grids, terms
//! and harmonics, and stops as soon as its cycle repeats well enough. Here one problem is solved first, and all others by its plan: on
//! the same grids, which move with what is varied, with the same terms left out, and until the cycle repeats much more exactly than an
//! accuracy asks for. The error of the grid is then nearly the same in all of them, and cancels in a difference.

use super::{Method, Record, Settings, SolveError, motor_plan, of_motor, of_plate, perform, plate_plan};
use crate::control::Cancel;
use crate::ladder::Nested;
use crate::memory;
use crate::motor::{self, Warm};
use crate::plan::Plan;
use crate::plate;
use crate::problem::{Problem, Scenario};
use crate::solution::Solution;

/// What a cycle has to repeat to, relative: the change of the trapped gas, and of the load.
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
}

impl Centre {
    /// Solves `problem` as exactly as `settings` ask for, of which method and record have no effect; `last` is one to start from.
    ///
    /// # Errors
    /// As [`super::solve`].
    pub fn new(
        problem: &Problem,
        settings: &Settings,
        last: Option<&Self>,
        cancel: &Cancel,
    ) -> Result<Self, SolveError> {
        let settings = Settings { record: Record::Numbers, method: Method::Auto, ..*settings };
        let spec = settings.fidelity.spec();
        let cold = Warm::default();
        let warm = last.map_or(&cold, |last| &last.warm);
        match &problem.scenario {
            Scenario::Motor(motor) => {
                let plan = motor_plan(motor, problem, &settings, &spec)?;
                let _taken = memory::take(memory::motor(motor, &plan), cancel)?;
                // To find the grids that the accuracy needs; then by them until the cycle repeats.
                let (_, warm, pinned) = motor::periodic_near(warm, motor, &plan, cancel)?;
                let plan = tight(pinned);
                let (found, warm, plan) = motor::periodic_near(&warm, motor, &plan, cancel)?;
                let solved = found.map(|found| performed(problem, of_motor(found, motor, &plan, cancel)));
                Ok(Self { plan, warm, problem: problem.clone(), solved })
            }
            Scenario::Plate(plate) => {
                let plan = plate_plan(plate, problem, &settings, &spec);
                let _taken = memory::take(memory::plate(plate, &plan), cancel)?;
                let (_, pinned) = plate::periodic_near(plate, &plan, cancel).map_err(SolveError::Plate)?;
                let plan = tight(pinned);
                let (found, plan) = plate::periodic_near(plate, &plan, cancel).map_err(SolveError::Plate)?;
                let solved = found.map(|found| of_plate(found, &plan, cancel));
                Ok(Self { plan, warm: cold, problem: problem.clone(), solved })
            }
        }
    }

    /// Solves a problem near this one, by its plan and from its state: the result does not depend on what else was solved. `None` if it has
    /// no periodic state on all of these grids: it is then not near.
    ///
    /// # Errors
    /// As [`super::solve`].
    pub fn solve(&self, problem: &Problem, cancel: &Cancel) -> Result<Option<Nested<Solution>>, SolveError> {
        match &problem.scenario {
            Scenario::Motor(motor) => {
                let settings = Settings { record: Record::Numbers, ..Settings::default() };
                let own = motor_plan(motor, problem, &settings, &settings.fidelity.spec())?;
                let plan = self.plan.near(&own.rotor);
                let _taken = memory::take(memory::motor(motor, &plan), cancel)?;
                let (found, _, used) = motor::periodic_near(&self.warm, motor, &plan, cancel)?;
                Ok(alike(&plan, &used)
                    .then(|| found.map(|found| performed(problem, of_motor(found, motor, &plan, cancel)))))
            }
            Scenario::Plate(plate) => {
                let _taken = memory::take(memory::plate(plate, &self.plan), cancel)?;
                let (found, used) = plate::periodic_near(plate, &self.plan, cancel).map_err(SolveError::Plate)?;
                Ok(alike(&self.plan, &used).then(|| found.map(|found| of_plate(found, &self.plan, cancel))))
            }
        }
    }
}

fn tight(plan: Plan) -> Plan {
    Plan { tolerance: plan.tolerance.min(TOLERANCE), accuracy: REPEATING, ..plan }
}

/// Whether both have the same grids.
fn alike(asked: &Plan, used: &Plan) -> bool {
    asked.grids == used.grids && asked.spectral == used.spectral
}

fn performed(problem: &Problem, mut solution: Solution) -> Solution {
    perform(problem, &mut solution);
    solution
}
