//! Chooses keys of a scene so that computed values agree with measurements, or so that one number is as large or as small as possible.
//!
//! [`Measured`] holds the measurements: each belongs to a [condition](Measured::conditions), the values of some keys, and each
//! condition is solved once, however many measurements share it. [`Unknown`]s are the keys that are chosen, each within its bounds; the
//! search runs in x from 0 to 1 between them, linear or logarithmic. Where a condition sets such a key, its value is known and is not
//! chosen.
//!
//! [`fit()`] minimises χ² = Σ ((computed − measured)/error)² by trust-region reflective least squares (the step of Levenberg and
//! Marquardt within bounds; Branch, Coleman and Li, SIAM J. Sci. Comput. 21, 1999) of the crate `basin`. Derivatives are differences
//! of solves on one grid ([`super::variation`]). At the minimum, with J = ∂(computed/error)/∂x of the unknowns that are not at a bound, the covariance is
//! (JᵀJ)⁻¹, times χ²/(measurements − unknowns) where the sizes of the errors are not known. The numerical error of what is computed, δ in errors of the
//! measurements, adds up to Σ |(JᵀJ)⁻¹Jᵀ| δ to that of an unknown, root of the sum of squares.
//!
//! [`optimise`] looks for the greatest or least value of one number within limits on others by COBYLA (Powell 1994) of the same
//! crate, which needs no derivatives.

mod least_squares;
mod measured;
mod model;
mod optimum;
mod starts;
mod statistics;
mod unknown;

use super::attempt::caught;
use super::error::AnalysisError;
use basin::ConstraintSolveError;

pub use least_squares::{Fitted, FittedRow, FittedUnknown, Minimum, fit};
pub use measured::{ErrorSize, LARGEST_TABLE, Measured, Measurement, Observable, TABLE1, measurable};
pub use model::Computed;
pub use optimum::{Goal, Limit, Optimum, Scan, optimise};
pub use starts::MOST_STARTS;
pub use unknown::{Bound, Bounds, MOST_UNKNOWNS, Unknown};

/// Reports the progress of a fit or an optimisation: the number of points tried, and the best value so far (χ² for a fit, the sought number
/// for an optimum; NaN before there is one).
pub type Report<'a> = &'a (dyn Fn(usize, f64) + Sync);

/// The error that tells the search library that the caller has cancelled.
#[derive(Debug)]
struct Stopped;

/// Runs the search library, which reports problems that it cannot handle by an error or a panic; `None` if cancelled.
fn searched<T>(run: impl FnOnce() -> Result<T, ConstraintSolveError<Stopped>>) -> Result<Option<T>, AnalysisError> {
    let failed = |reason: String| Err(AnalysisError::Search(format!("the search failed: {reason}")));
    match caught(run) {
        Ok(Ok(ended)) => Ok(Some(ended)),
        Ok(Err(ConstraintSolveError::Evaluation(Stopped))) => Ok(None),
        Ok(Err(error)) => failed(format!("{error:?}")),
        Err(panic) => failed(panic),
    }
}
