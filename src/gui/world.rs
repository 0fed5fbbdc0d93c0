//! What the window takes from outside: the time, what file dialogs answer, and how much is measured. Tests bring their own.

use super::dialogs::{self, Answer, Purpose};
use crate::analysis::tradeoff::{Candidate, Effort, candidates};
use crate::problem::Problem;
use std::time::Instant;

/// The outside world.
#[derive(Clone, Copy, Debug)]
pub struct World {
    /// The present moment.
    pub now: fn() -> Instant,
    /// Asks for a file, with a name to begin with; blocks until there is an answer.
    pub ask: fn(Purpose, &str) -> Answer,
    /// What to measure for the trade-off, and how long.
    pub measure: fn(&Problem) -> (Vec<Candidate>, Effort),
}

impl Default for World {
    fn default() -> Self {
        Self { now: Instant::now, ask: dialogs::native, measure: |problem| (candidates(problem), Effort::default()) }
    }
}
