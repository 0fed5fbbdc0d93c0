//! The background solver: the newest request wins, results stream back as they improve.
//!
//! A request is a checked problem. It is solved at draft, then standard, then fine, and each result is sent. A newer request cancels the
//! running solve, and a panic in a solver becomes an event. This module knows no window: the owner of the [`Solver`] passes a function
//! `wake`, which is called after every event. In a process a named thread solves (`thread`), which is cancelled and joined on drop. On a
//! page a worker does (`page`): scenes are sent to it as bytes, and it is ended and replaced when it is cancelled.

pub mod export;
pub mod fit;
pub mod hold;
#[cfg(target_arch = "wasm32")]
mod line;
#[cfg(target_arch = "wasm32")]
mod page;
pub mod sensitivity;
#[cfg(target_arch = "wasm32")]
pub mod serve;
pub mod single;
pub mod sweep;
pub mod task;
#[cfg(not(target_arch = "wasm32"))]
mod thread;
pub mod tradeoff;
pub mod transient;
pub mod work;

#[cfg(target_arch = "wasm32")]
pub use page::Solver;
#[cfg(not(target_arch = "wasm32"))]
pub use thread::Solver;

use crate::analysis::attempt::caught;
use crate::analysis::validity::{ExceededLimit, outside};
use crate::control::{Cancel, Progress};
use crate::fidelity::Fidelity;
use crate::motor::Warm;
use crate::platform::{Instant, timed};
use crate::problem::Problem;
use crate::scene::Scene;
use crate::solution::{Solution, Status, settled};
use crate::solve::{Settings, solve_from};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;
use std::time::Duration;
use work::Posed;

/// A scene and its solution at one fidelity. It is shared and does not change.
#[derive(Clone, Debug)]
pub struct SolvedScene {
    /// The request's number, ascending.
    pub number: u64,
    /// The scene that was solved.
    pub scene: Scene,
    /// The problem that it poses, checked and in SI units; a floating plate is at the gap that was found.
    pub problem: Problem,
    /// The fidelity it was solved at.
    pub fidelity: Fidelity,
    /// The result.
    pub solution: Arc<Solution>,
    /// The limits of the model that the scene exceeds.
    pub validity: Vec<ExceededLimit>,
    /// Wall time of this fidelity's solve \[s\].
    pub wall_s: f64,
    /// The convergence history: the residual of each round, all grids, in order.
    pub history: Vec<Progress>,
}

/// An event sent by the background solver.
#[derive(Clone, Debug)]
pub enum Event {
    /// A round of the running solve is done.
    Progress {
        /// The request's number.
        number: u64,
        /// The fidelity that is being solved.
        fidelity: Fidelity,
        /// The state of the solve after the round.
        progress: Progress,
    },
    /// A fidelity is solved; more may follow.
    Solved(Arc<SolvedScene>),
    /// There is no result: an error, or a panic of the solver.
    Failed {
        /// The request's number.
        number: u64,
        /// The message for the user.
        message: String,
    },
    /// No further event of this request will come.
    Done {
        /// The request's number.
        number: u64,
    },
}

/// A problem to solve, at each of the fidelities in turn.
#[derive(Clone, Debug)]
pub struct Request {
    /// The scene, carried into the results, and its problem.
    pub posed: Posed,
    /// Fidelities, coarse to fine.
    pub fidelities: Vec<Fidelity>,
    /// The time limit of each solve, if there is one. After it, the best result so far is taken.
    pub budget: Option<Duration>,
}

/// A solution, and the wall time of its solve \[s\].
type Timed = (Solution, f64);

/// Serialised without the problem and the limits, which follow from the scene and the solution.
impl Serialize for SolvedScene {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let timed = (&self.solution, self.wall_s);
        (self.number, &self.scene, self.fidelity, timed, &self.history).serialize(to)
    }
}

impl<'de> Deserialize<'de> for SolvedScene {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let (number, posed, fidelity, timed, history) = <(_, _, _, _, _)>::deserialize(from)?;
        Ok(Self::of(number, posed, fidelity, timed, history))
    }
}

impl SolvedScene {
    /// The result of request `number` at one fidelity, with the residual of each round.
    fn of(
        number: u64,
        Posed { scene, problem }: Posed,
        fidelity: Fidelity,
        (solution, wall_s): Timed,
        history: Vec<Progress>,
    ) -> Self {
        Self {
            number,
            scene,
            problem: settled(&problem, &solution.outcome).into_owned(),
            fidelity,
            validity: outside(&problem, &solution),
            solution: Arc::new(solution),
            wall_s,
            history,
        }
    }
}

/// Solves a problem at one fidelity, timed by the clock `now`. Returns the solution, `None` if it was cancelled, or the message for the user
/// if it failed.
fn solved(
    problem: &Problem,
    (fidelity, budget): (Fidelity, Option<Duration>),
    now: fn() -> Instant,
    warm: &mut Warm,
    cancel: &Cancel,
    mut listen: impl FnMut(&Progress),
) -> Result<Option<Timed>, String> {
    let settings = Settings { fidelity, ..Settings::default() };
    let limited = budget.map_or(cancel.clone(), |budget| timed(cancel, budget));
    let started = now();
    let found = caught(|| solve_from(warm, problem, &settings, &mut listen, &limited));
    let wall_s = now().duration_since(started).as_secs_f64();
    match found {
        Ok(Ok(solution)) if solution.status == Status::Cancelled => Ok(None),
        Ok(Ok(solution)) => Ok(Some((solution, wall_s))),
        Ok(Err(_)) if cancel.is_cancelled() => Ok(None),
        Ok(Err(error)) => Err(error.to_string()),
        Err(panic) => Err(failure(fidelity, &panic)),
    }
}

/// The message for the user after a panic.
fn failure(fidelity: Fidelity, panic: &str) -> String {
    format!("the solver failed at {fidelity}: {panic}")
}
