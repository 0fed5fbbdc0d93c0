//! Runs one solve of many, so that an error or a panic in it does not stop the others.

use crate::control::{Cancel, Observer};
use crate::problem::Problem;
use crate::solution::{Solution, Status};
use crate::solve::{Settings, SolveError, solve};
use serde::{Deserialize, Serialize};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How one solve among many ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum RunStatus {
    /// Not solved yet.
    Waiting,
    /// The cycle repeats within the tolerance.
    Converged,
    /// A limit was reached first; the numbers are those at that point.
    NotConverged,
    /// The cycle repeats, but the stated error of the headline number is as large as the number.
    NotResolved,
    /// Cancelled, because it took longer than the time limit.
    GivenUp,
    /// There is no solution, and why.
    Failed(String),
}

impl From<Status> for RunStatus {
    fn from(status: Status) -> Self {
        match status {
            Status::Converged => Self::Converged,
            Status::NotConverged { .. } => Self::NotConverged,
            Status::NotResolved { .. } => Self::NotResolved,
            Status::Cancelled => Self::GivenUp,
        }
    }
}

/// `converged`, `not converged`, `failed: …`, as in files.
impl std::fmt::Display for RunStatus {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Waiting => f.write_str("waiting"),
            Self::Converged => f.write_str("converged"),
            Self::NotConverged => f.write_str("not converged"),
            Self::NotResolved => f.write_str("not resolved"),
            Self::GivenUp => f.write_str("given up"),
            Self::Failed(reason) => write!(f, "failed: {reason}"),
        }
    }
}

/// Solves. An error or a panic of the solver is returned as a message.
pub fn attempt(
    problem: &Problem,
    settings: &Settings,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Solution, String> {
    error_in_words(|| solve(problem, settings, observer, cancel))
}

/// Runs `solve`, and turns its error or panic into a message.
pub(super) fn error_in_words<T>(solve: impl FnOnce() -> Result<T, SolveError>) -> Result<T, String> {
    caught(solve).map_err(|panic| format!("the solver failed: {panic}"))?.map_err(|error| error.to_string())
}

/// Runs `work`; returns its result, or the text of its panic.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let text = panic.downcast_ref::<&str>().copied();
        text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no reason given").to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Scenario;
    use crate::scene::Scene;

    #[test]
    fn a_panic_is_told_in_words() {
        let mut broken = Problem::try_from(&Scene::motor()).unwrap();
        // No scene gives this problem; in it, the solver divides by zero teeth.
        if let Scenario::Motor(motor) = &mut broken.scenario {
            motor.teeth = 0;
        }
        let error = attempt(&broken, &Settings::default(), &mut (), &Cancel::new()).unwrap_err();
        assert!(error.starts_with("the solver failed: "), "{error}");
    }
}
