//! What the window takes from outside: the time, and what file dialogs answer. Tests bring their own.

use super::dialogs::{self, Answer, Purpose};
use std::time::Instant;

/// The outside world.
#[derive(Clone, Copy, Debug)]
pub struct World {
    /// The present moment.
    pub now: fn() -> Instant,
    /// Asks for a file, with a name to begin with; blocks until there is an answer.
    pub ask: fn(Purpose, &str) -> Answer,
}

impl Default for World {
    fn default() -> Self {
        Self { now: Instant::now, ask: dialogs::native }
    }
}
