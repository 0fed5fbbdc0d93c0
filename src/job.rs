//! The background solver: the newest request wins, results stream back as they improve.
//!
//! A request is a checked problem. It is solved at draft, then standard, then fine, and each result is sent; a newer request cancels the
//! running solve. A panic in a solver becomes an event. No window in here: whoever owns the [`Solver`] passes a `wake` function, called
//! after every event. In a process a named thread solves (`thread`), which is cancelled and joined on drop; on a page it is a worker
//! (`page`), to which scenes are sent as bytes, and which is ended and replaced when it is cancelled.

pub mod drop;
pub mod export;
pub mod face;
pub mod fit;
pub mod hold;
#[cfg(target_arch = "wasm32")]
mod line;
#[cfg(target_arch = "wasm32")]
mod page;
pub mod pin;
pub mod rotor;
pub mod sensitivity;
#[cfg(target_arch = "wasm32")]
pub mod serve;
pub mod startup;
pub mod sweep;
pub mod task;
#[cfg(not(target_arch = "wasm32"))]
mod thread;
pub mod torque;
pub mod tradeoff;
pub mod work;

#[cfg(target_arch = "wasm32")]
pub use page::Solver;
#[cfg(not(target_arch = "wasm32"))]
pub use thread::Solver;

use crate::analysis::attempt::caught;
use crate::analysis::validity::Excess;
use crate::control::{Cancel, Progress};
use crate::fidelity::Fidelity;
use crate::motor::Warm;
use crate::platform::timed;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::solution::{Solution, Status};
use crate::solve::{Settings, solve_from};
use std::sync::Arc;
use std::time::Duration;

/// A scene and what came of solving it at one fidelity: immutable, shared.
#[derive(Debug)]
pub struct SolvedScene {
    /// The request's number, ascending.
    pub number: u64,
    /// What was solved.
    pub scene: Scene,
    /// The same, checked and in SI units; a plate that floats is at the gap that was found.
    pub problem: Problem,
    /// At which fidelity.
    pub fidelity: Fidelity,
    /// The result.
    pub solution: Solution,
    /// Limits of the model that it exceeds.
    pub validity: Vec<Excess>,
    /// Wall time of this fidelity's solve \[s\].
    pub wall_s: f64,
    /// Whether it was started from the fields of a scene before it: effort, not the result, then depends on that one.
    pub warm: bool,
    /// Residual of each round, all grids, in order: the convergence history.
    pub history: Vec<Progress>,
}

/// What the worker tells.
#[derive(Clone, Debug)]
pub enum Event {
    /// A round of the running solve is done.
    Progress {
        /// The request's number.
        number: u64,
        /// At which fidelity.
        fidelity: Fidelity,
        /// How far it is.
        progress: Progress,
    },
    /// A fidelity is solved; more may follow.
    Solved(Arc<SolvedScene>),
    /// There is no result: an error, or a panic of the solver.
    Failed {
        /// The request's number.
        number: u64,
        /// What the user is told.
        message: String,
    },
    /// Nothing more will come of this request.
    Done {
        /// The request's number.
        number: u64,
        /// Whether it was cancelled before its last fidelity.
        cancelled: bool,
    },
}

/// A problem to solve, at each of the fidelities in turn.
#[derive(Clone, Debug)]
pub struct Request {
    /// The scene, carried into the results.
    pub scene: Scene,
    /// The same, checked.
    pub problem: Problem,
    /// Fidelities, coarse to fine.
    pub fidelities: Vec<Fidelity>,
    /// Time for each of them, if it is limited: then the best so far is the result.
    pub budget: Option<Duration>,
}

/// One fidelity of a request, solved: what it came to, or what the user is told. `None` if it was cancelled.
fn solved(
    problem: &Problem,
    (fidelity, budget): (Fidelity, Option<Duration>),
    warm: &mut Warm,
    cancel: &Cancel,
    mut listen: impl FnMut(&Progress),
) -> Option<Result<Solution, String>> {
    let settings = Settings { fidelity, ..Settings::default() };
    let limited = budget.map_or(cancel.clone(), |budget| timed(cancel, budget));
    Some(match caught(|| solve_from(warm, problem, &settings, &mut listen, &limited)) {
        Ok(Ok(solution)) if solution.status == Status::Cancelled => return None,
        Ok(Ok(solution)) => Ok(solution),
        Ok(Err(_)) if cancel.is_cancelled() => return None,
        Ok(Err(error)) => Err(error.to_string()),
        Err(panic) => Err(failure(fidelity, &panic)),
    })
}

/// What the user is told of a panic.
fn failure(fidelity: Fidelity, panic: &str) -> String {
    format!("the solver failed at {fidelity}: {panic}")
}
