//! Why an analysis of a scene cannot be made.

use crate::scene::{SceneError, nearest, show_text};
use crate::solve::SolveError;

/// Why there is no sweep, comparison, fit, optimum or sensitivity. All errors except those of the solver and of a search are found before
/// anything is solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// Invalid request, or a table that cannot be used: the option, key or line, its value, and what is allowed.
    #[error("{0}")]
    Input(String),
    /// Invalid fields of the form of a sweep.
    #[error("{message}")]
    Field {
        /// Message for the command line, as [`Self::Input`].
        message: String,
        /// Message without key or option, for display beside the fields.
        in_place: String,
    },
    /// A key or value of a scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The solver: a method that does not apply, more memory than is allowed, or a scene that cannot be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A search found nothing; the reason.
    #[error("{0}")]
    Search(String),
}

impl AnalysisError {
    /// The error for a name that no result of the scene has, given for `option`; `allowed` is the names that exist, separated by commas.
    pub fn no_such_number(option: &str, name: &str, allowed: &str) -> Self {
        let allowed = match nearest(name, allowed.split(", ")) {
            Some(near) => format!("did you mean {near}? Allowed: {allowed}"),
            None => format!("allowed: {allowed}"),
        };
        Self::Input(format!("{option} {}: no such number; {allowed}", show_text(name)))
    }

    /// Whether the input is at fault.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Solve(error) => error.is_bad_input(),
            Self::Search(_) => false,
            Self::Input(_) | Self::Field { .. } | Self::Scene(_) => true,
        }
    }

    /// The message for display beside the fields of the key, without the key if possible.
    pub fn in_place(&self) -> String {
        match self {
            Self::Field { in_place, .. } => in_place.clone(),
            other => other.to_string(),
        }
    }
}
