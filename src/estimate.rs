//! Extrapolation of a result from nested grids, and its error estimate.
//!
//! The schemes are of second order in space and time. From results r₁, r₂, r₃ on grids of spacing 4s, 2s, s,
//! Richardson's extrapolations are e₁₂ = r₂ + (r₂ − r₁)/3 and e₂₃ = r₃ + (r₃ − r₂)/3; e₂₃ is returned. Contact edges and
//! instants of first touch make the next error term irregular, so that the spread |e₂₃ − e₁₂| is taken as it is (a
//! third-order remainder would be a seventh of it), but never less than a fraction of the correction itself.

use serde::{Deserialize, Serialize};

/// A result and its estimated absolute error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The extrapolated result.
    pub value: f64,
    /// Estimated error of `value`, absolute.
    pub error: f64,
}

/// Share of |e₂₃ − e₁₂| that is taken as the error where the results converge at second order or faster (calibrated, as are all
/// constants here: docs/validation.md).
const SPREAD: f64 = 0.25;
/// Least share of the last correction that is taken as error.
const CORRECTION: f64 = 0.35;
/// Share of what a slower approach leaves that is taken as error, and the slowest one that it is taken for.
const REST: f64 = 1.3;
const SLOWEST: f64 = 1.3;
/// Least share of the change before the last that is taken as error: the last one may be small by chance.
const BEFORE: f64 = 0.025;

/// A cycle mean on one grid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mean {
    /// Over all steps.
    pub all: f64,
    /// Over every second step, those of the next coarser grid: what that one's mean is compared with, so that how a mean depends on its
    /// instants is not taken for an error of the scheme.
    pub shared: f64,
}

impl Mean {
    /// Of a cycle that does not repeat: it begins at `start`, and the mean so far is that over the ends of its `steps` steps, of which the
    /// last is `end` (the trapezoidal rule, of second order as the scheme is).
    pub fn from_to(self, start: f64, end: f64, steps: usize) -> Self {
        let excess = 0.5 * (end - start) / steps as f64;
        Self { all: self.all - excess, shared: self.shared - 2.0 * excess }
    }
}

/// From results on nested grids, coarse to fine. One grid gives no estimate (an infinite error).
pub fn extrapolate(results: &[f64]) -> Estimate {
    let last = &results[results.len().saturating_sub(3)..];
    let means: Vec<Mean> = last.iter().map(|result| Mean { all: *result, shared: *result }).collect();
    extrapolate_means(&means)
}

/// As [`extrapolate`], of cycle means.
pub fn extrapolate_means(means: &[Mean]) -> Estimate {
    match *means {
        [] => Estimate { value: 0.0, error: f64::INFINITY },
        [only] => Estimate { value: only.all, error: f64::INFINITY },
        [coarse, fine] => {
            let change = fine.shared - coarse.all;
            Estimate { value: fine.all + change / 3.0, error: change.abs() }
        }
        [.., first, second, third] => {
            let (earlier, change) = (second.shared - first.all, third.shared - second.all);
            let correction = change / 3.0;
            let (before, value) = (second.all + earlier / 3.0, third.all + correction);
            let ratio = if change == 0.0 { f64::INFINITY } else { earlier / change };
            let left = if ratio >= 4.0 {
                (SPREAD * (value - before).abs()).min(correction.abs())
            } else if ratio > 0.0 {
                REST * (change / (ratio.max(SLOWEST) - 1.0) - correction).abs()
            } else {
                0.5 * change.abs()
            };
            let least = (CORRECTION * correction.abs()).max(BEFORE * earlier.abs());
            Estimate { value, error: left.max(least) }
        }
    }
}

/// A value of extrapolated fields, judged by that of the fields extrapolated from the two coarser grids, `before`, and that of the
/// `finest` grid as it was solved.
pub fn judged(value: f64, before: f64, finest: f64) -> Estimate {
    Estimate { value, error: (SPREAD * (value - before).abs()).max(CORRECTION * (value - finest).abs()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_order_errors_vanish_and_the_remainder_is_bounded() {
        // r(s) = 1 + 2 s² − 5 s³
        let result = |s: f64| 1.0 + 2.0 * s * s - 5.0 * s * s * s;
        let estimate = extrapolate(&[result(0.4), result(0.2), result(0.1)]);
        let error = (estimate.value - 1.0).abs();
        assert!(error < 0.01 && error < estimate.error && estimate.error < 10.0 * error, "{estimate:?}");
        let exact = extrapolate(&[1.0 + 0.32, 1.0 + 0.08, 1.0 + 0.02]);
        assert!((exact.value - 1.0).abs() < 1e-15 && exact.error > 0.0);
    }

    #[test]
    fn the_mean_of_a_way_is_of_second_order() {
        // ∫₀¹ eᵗ dt, over the ends of the steps, and over every second of them.
        let mean = |steps: usize, every: usize| {
            let ends = (1..=steps).filter(|m| m.is_multiple_of(every)).map(|m| (m as f64 / steps as f64).exp());
            ends.sum::<f64>() / (steps / every) as f64
        };
        let off = |steps: usize| {
            let way = Mean { all: mean(steps, 1), shared: mean(steps, 2) }.from_to(1.0, 1.0_f64.exp(), steps);
            [way.all, way.shared].map(|mean| mean - (1.0_f64.exp() - 1.0))
        };
        let ([coarse, _], [fine, shared]) = (off(16), off(32));
        assert!((coarse / fine - 4.0).abs() < 0.01 && (shared - coarse).abs() < 1e-15, "{coarse} {fine} {shared}");
    }
}
