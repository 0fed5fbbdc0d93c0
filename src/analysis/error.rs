//! Why an analysis of a scene is not made.

use crate::scene::{SceneError, nearest, show_text};
use crate::solve::SolveError;

/// Why there is no sweep, comparison, fit, optimum or sensitivity. Found before anything is solved, but for errors of the solver and the last.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// Invalid request, or a table that cannot be used: the option, key or line, its value, and what is allowed.
    #[error("{0}")]
    Input(String),
    /// Invalid fields of what is swept.
    #[error("{told}")]
    Field {
        /// Message for the command line, as [`Self::Input`].
        told: String,
        /// Message without key or option, for display beside the fields.
        in_place: String,
    },
    /// A key or value of a scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The solver: a method that does not apply, more memory than is allowed, or a scene that cannot be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A search that found nothing, and why.
    #[error("{0}")]
    Search(String),
}

impl AnalysisError {
    /// The fault of a name that results of the scene do not have, given for `option`; `allowed`: those that they have, separated by commas.
    pub fn no_such_number(option: &str, name: &str, allowed: &str) -> Self {
        let allowed = match nearest(name, allowed.split(", ")) {
            Some(near) => format!("did you mean {near}? Allowed: {allowed}"),
            None => format!("allowed: {allowed}"),
        };
        Self::Input(format!("{option} {}: no such number; {allowed}", show_text(name)))
    }

    /// Whether the input asked for what is not allowed.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Solve(error) => error.is_bad_input(),
            Self::Search(_) => false,
            Self::Input(_) | Self::Field { .. } | Self::Scene(_) => true,
        }
    }

    /// Message for display beside the fields of the key, which it need not name.
    pub fn in_place(&self) -> String {
        match self {
            Self::Field { in_place, .. } => in_place.clone(),
            other => other.to_string(),
        }
    }
}
