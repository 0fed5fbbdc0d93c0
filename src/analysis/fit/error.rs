//! What cannot be fitted. Found before anything is solved, but for the last.

use crate::scene::SceneError;
use crate::solve::SolveError;

/// Why there is no fit, or no optimum.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// What was asked for is not allowed, or a table cannot be used: the option, key or line, its value, and what is allowed.
    #[error("{0}")]
    Input(String),
    /// Nothing could be solved.
    #[error("no start can be solved: {0}")]
    NoStart(String),
    /// A key or value of a scene.
    #[error("{0}")]
    Scene(#[from] SceneError),
    /// A method that does not apply, or more memory than is allowed.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The library that searches gave up.
    #[error("the search failed: {0}")]
    Search(String),
}

impl FitError {
    /// Whether the input asked for what is not allowed.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Search(_) | Self::NoStart(_) => false,
            Self::Solve(error) => error.is_bad_input(),
            _ => true,
        }
    }
}
