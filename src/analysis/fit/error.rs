//! What cannot be fitted. Found before anything is solved, but for the last.

use crate::input::ReadError;
use crate::scene::{Parameter, SceneError};
use crate::solve::SolveError;
use std::path::PathBuf;

/// Why there is no fit, or no optimum.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Bounds that are not of the form asked for.
    #[error("vary {found}: expected key=from:to or key=from:to:log, as in film.min_spacing_nm=100:400")]
    Bounds {
        /// What was given.
        found: String,
    },
    /// No range, or one that has no logarithm.
    #[error("vary {key}: from {from} to {to} {why}")]
    Range {
        /// The key.
        key: &'static str,
        /// Lower bound.
        from: f64,
        /// Upper bound.
        to: f64,
        /// What is wrong with it.
        why: &'static str,
    },
    /// A key whose values are not numbers.
    #[error("vary {}: it accepts {}; only a key that is a number, and not a whole one, can be chosen between two bounds", parameter.key, parameter.accepts())]
    NotANumber {
        /// The key.
        parameter: &'static Parameter,
    },
    /// A key given twice.
    #[error("vary {key}: {why}")]
    Twice {
        /// The key.
        key: &'static str,
        /// As what.
        why: &'static str,
    },
    /// No unknown, or too many.
    #[error("vary: {found} keys given: allowed 1 to {most}")]
    Count {
        /// How many.
        found: usize,
        /// How many are allowed.
        most: usize,
    },
    /// The file.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why it is not read.
        source: ReadError,
    },
    /// A table of measurements.
    #[error("{origin}{}: {what}", line.map_or_else(String::new, |line| format!(":{line}")))]
    Table {
        /// The file.
        origin: String,
        /// The line, from 1.
        line: Option<u64>,
        /// Column, value, and what is allowed.
        what: String,
    },
    /// A name of a number that a scene of this kind does not have.
    #[error("{option} {found}: no such number; allowed: {allowed}")]
    Number {
        /// The option it was given for.
        option: &'static str,
        /// What was given.
        found: String,
        /// The names.
        allowed: String,
    },
    /// An option that is not of the form asked for.
    #[error("{option} {found}: expected {expected}")]
    Option {
        /// The option.
        option: &'static str,
        /// What was given.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// Fewer measurements than unknowns.
    #[error(
        "measurements: {measurements}, keys varied: {unknowns}; give at least as many measurements as keys, or vary fewer{left_out}"
    )]
    TooFew {
        /// How many there are.
        measurements: usize,
        /// How many keys are varied.
        unknowns: usize,
        /// How many could not be computed, and why the first of them could not, in words.
        left_out: String,
    },
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
