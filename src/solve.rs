//! One call for either scene: problem and settings in, solution out.

use crate::control::{Cancel, Observer};
use crate::fidelity::Fidelity;
use crate::film::cycle::Interrupted;
use crate::motor::{self, MotorError};
use crate::paper;
use crate::plan::Plan;
use crate::plate;
use crate::problem::{Problem, Scenario};
use crate::solution::{Model, Outcome, Solution, Status};

/// How to solve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Ours: only what the scene needs, at a fidelity.
    #[default]
    Auto,
    /// The paper's algorithm, literally.
    Paper,
}

impl Method {
    /// The name used on the command line and in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Paper => "paper",
        }
    }
}

/// What a caller chooses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// Accuracy of `Method::Auto`.
    pub fidelity: Fidelity,
    /// Algorithm.
    pub method: Method,
}

/// Why there is no solution at all.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The motor.
    #[error(transparent)]
    Motor(#[from] MotorError),
    /// The plate.
    #[error("film, {0}")]
    Plate(Interrupted),
    /// The paper has no plate.
    #[error("method = paper is for motors: it has no plate scene; allowed here: auto")]
    PaperPlate,
}

/// Solves `problem` for its periodic steady state.
///
/// Reaching a limit or being cancelled is a [`Status`], not an error.
///
/// # Errors
/// [`SolveError`] when a step has no solution to working precision, or the method does not apply.
pub fn solve(
    problem: &Problem,
    settings: &Settings,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Solution, SolveError> {
    match (&problem.scenario, settings.method) {
        (Scenario::Motor(motor), Method::Auto) => {
            let plan = Plan::motor(motor, settings.fidelity, &problem.numerics);
            let found = motor::periodic(motor, &plan, observer, cancel)?;
            let teeth = if plan.every_tooth { motor.teeth } else { 1 };
            Ok(Solution {
                warnings: warnings(&found.status),
                status: found.status,
                outcome: Outcome::Motor(found.result),
                stats: found.stats,
                model: model(&plan, teeth),
                recording: found.recording,
            })
        }
        (Scenario::Plate(plate), Method::Auto) => {
            let plan = Plan::plate(plate, settings.fidelity, &problem.numerics);
            let found = plate::periodic(plate, &plan, observer, cancel).map_err(SolveError::Plate)?;
            Ok(Solution {
                warnings: warnings(&found.status),
                status: found.status,
                outcome: Outcome::Plate(found.result),
                stats: found.stats,
                model: model(&plan, 1),
                recording: found.recording,
            })
        }
        (Scenario::Motor(motor), Method::Paper) => Ok(paper::solve(motor, &problem.numerics, observer, cancel)),
        (Scenario::Plate(_), Method::Paper) => Err(SolveError::PaperPlate),
    }
}

fn model(plan: &Plan, teeth_solved: usize) -> Model {
    Model {
        fidelity: plan.fidelity.clone(),
        method: Method::Auto.name().to_owned(),
        teeth_solved,
        half_width: plan.half_width,
        shear: plan.shear,
        why: plan.why.clone(),
    }
}

fn warnings(status: &Status) -> Vec<String> {
    match status {
        Status::Converged => Vec::new(),
        Status::NotConverged { residual, tolerance } => vec![format!(
            "not converged: the last round still changed by {residual:.1e}, allowed {tolerance:.0e}; the numbers are what was reached"
        )],
        Status::Cancelled => vec!["cancelled: the numbers are what was reached".to_owned()],
    }
}
