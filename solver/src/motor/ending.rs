//! How a solve of a motor ends early, and the reference of its relative accuracy.

use crate::contact::ContactError;
use crate::film::cycle::Interrupted;
use crate::film::stepper::FilmError;
use crate::rotor::RotorError;

/// Why a motor could not be solved. No input is known for which a film step or a contact problem fails.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotorError {
    /// A film step failed.
    #[error("film, step {step} of the cycle: {source}")]
    Film {
        /// Which step.
        step: usize,
        /// Why.
        source: FilmError,
    },
    /// A contact problem failed.
    #[error("contact, instant {instant} of the cycle: {source}")]
    Contact {
        /// Which instant.
        instant: usize,
        /// Why.
        source: ContactError,
    },
    /// The rotor has no compliance.
    #[error(transparent)]
    Rotor(#[from] RotorError),
}

/// Interrupted or failed: what ends a round early.
pub(super) enum Stop {
    Cancelled,
    Failed(MotorError),
}

impl From<MotorError> for Stop {
    fn from(error: MotorError) -> Self {
        Self::Failed(error)
    }
}

impl From<Interrupted> for Stop {
    fn from(interrupted: Interrupted) -> Self {
        match interrupted {
            Interrupted::Cancelled => Self::Cancelled,
            Interrupted::Failed { step, source } => Self::Failed(MotorError::Film { step, source }),
        }
    }
}

/// The result; `None` if the solve was cancelled.
pub(super) fn unless_cancelled<T>(found: Result<T, Stop>) -> Result<Option<T>, MotorError> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(Stop::Cancelled) => Ok(None),
        Err(Stop::Failed(error)) => Err(error),
    }
}

/// Reference for the relative error of α: α itself, or 0.01 where the film carries less than a hundredth of the load.
pub fn unit(alpha: f64) -> f64 {
    alpha.abs().max(0.01)
}
