//! Extrapolation of a result from nested grids, and its error estimate.
//!
//! The schemes are of second order in space and time. From results r₁, r₂, r₃ on grids of spacing 4s, 2s, s,
//! Richardson's extrapolations are e₁₂ = r₂ + (r₂ − r₁)/3 and e₂₃ = r₃ + (r₃ − r₂)/3; e₂₃ is returned. Contact edges and
//! instants of first touch make the next error term irregular, so that a quarter of the spread |e₂₃ − e₁₂| is
//! taken (a third-order remainder would be a seventh of it), but never less than a fraction of the correction itself. Where nothing touches, the
//! next term is regular, and less is taken ([`extrapolate_smooth`]).

use crate::digits::with_error;
use serde::{Deserialize, Serialize};
use std::fmt::{Display, Formatter};
use std::ops::Mul;

/// A result and its estimated absolute error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The extrapolated result.
    pub value: f64,
    /// Estimated error of `value`, absolute.
    pub error: f64,
}

impl Estimate {
    /// A number without an error.
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// The ends of a range as text, with a common power of ten if both are small: `(−1.5 ± 0.1 … 1.5 ± 0.1) × 10^-4`.
    pub fn range(ends: [Self; 2]) -> String {
        let size = |end: &Self| if end.error.is_finite() { end.value.abs().max(end.error) } else { end.value.abs() };
        let exponent = size(&ends[0]).max(size(&ends[1])).log10().floor();
        let scale = 10f64.powf(-exponent);
        let join = |ends: [Self; 2]| ends.map(|end| end.to_string()).join(" … ");
        if exponent <= SMALL && scale.is_finite() && ends.iter().all(|end| size(end) * scale > 10f64.powf(SMALL)) {
            return format!("({}) × 10^{exponent}", join(ends.map(|end| end * scale)));
        }
        join(ends)
    }
}

/// Exponent of ten up to which the ends of a range share a power of ten, and the least that the mantissa of either may then be.
const SMALL: f64 = -3.0;

/// Conversion to another unit.
impl Mul<f64> for Estimate {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error * factor.abs() }
    }
}

/// With as many digits as the error justifies: [`with_error`].
impl Display for Estimate {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str(&with_error(self.value, self.error))
    }
}

/// Share of |e₂₃ − e₁₂| that is taken as the error where the results converge at second order or faster (calibrated, as are all
/// constants here: docs/validation.md).
const SPREAD: f64 = 0.25;
/// The error is at least this multiple of the last Richardson correction, |d₂|/3.
const CORRECTION: f64 = 0.35;
/// Below second order, the error is `REST` times the remainder of a geometric series with the observed ratio d₁/d₂, which is taken to be at
/// least `SLOWEST`.
const REST: f64 = 1.3;
const SLOWEST: f64 = 1.3;
/// The error is at least this fraction of the last change but one, because the last change may be small by chance.
const BEFORE: f64 = 0.025;
/// Share of the spread that a third-order term leaves where the error is a power series in the spacing.
const THIRD_ORDER: f64 = 1.0 / 7.0;
/// Share of the spread, and of the last correction, for the orders after the third, times the spacing.
const HIGHER_ORDERS: f64 = 0.6;
/// Ratio d₁/d₂ above which the convergence of a smooth film counts as second order.
const NEARLY_SECOND_ORDER: f64 = 3.5;
/// The error is at least this share of the spread where successive changes have opposite signs.
const TURNING: f64 = 0.4;
/// The error is at least this share of the change of the middle grid's mean due to the instants that the coarsest grid lacks: with contact, and
/// for a film without contact.
const SAMPLING: f64 = 0.07;
const SMOOTH_SAMPLING: f64 = 0.1;
/// The same for the first grid.
const FIRST_SAMPLING: f64 = 0.02;

/// A cycle mean on one grid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mean {
    /// Over all steps.
    pub all: f64,
    /// Over every second step, those of the next coarser grid. The coarser grid's mean is compared with this one, so that the effect of the
    /// sampling instants on a mean is not mistaken for an error of the scheme.
    pub shared: f64,
}

impl Mean {
    /// The mean over a cycle that does not repeat: `self` is the mean over the ends of its `steps` steps, of which the last is `end`; the
    /// cycle begins at `start`. The result is that of the trapezoidal rule, which is of second order like the scheme.
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

/// As [`extrapolate`], for cycle means. The change of a mean due to additional instants shows how much it still depends on them: errors of
/// opposite sign, from the time steps and from the nodes, may cancel in the changes between grids.
pub fn extrapolate_means(means: &[Mean]) -> Estimate {
    extrapolate_by(means, |steps| {
        let correction = steps.correction().abs();
        let left = if steps.ratio() >= 4.0 {
            (SPREAD * steps.spread).min(correction)
        } else if steps.ratio() > 0.0 {
            REST * steps.slow_rest()
        } else {
            0.5 * steps.change.abs()
        };
        left.max((CORRECTION * correction).max(BEFORE * steps.earlier.abs())).max(SAMPLING * steps.sampling.abs())
    })
}

/// As [`extrapolate_means`], for a film without contact, whose error is a power series in the spacing. The third-order term leaves a
/// seventh of the spread |e₂₃ − e₁₂|, and each higher order leaves less by a factor of the spacing. √(|r₂ − r₁|/unit) serves as the
/// spacing, since that change is of second order. Where a mean still depends on its sampling instants, three grids may agree by chance, so
/// part of that dependence also counts as error. `unit` is the reference of relative errors.
pub fn extrapolate_smooth(means: &[Mean], unit: f64) -> Estimate {
    extrapolate_by(means, |steps| {
        let spacing = (steps.earlier.abs() / unit).min(1.0).sqrt();
        let share = THIRD_ORDER + HIGHER_ORDERS * spacing;
        let left = if steps.ratio() >= NEARLY_SECOND_ORDER {
            share * steps.spread
        } else if steps.ratio() > 0.0 {
            steps.slow_rest()
        } else {
            share.max(TURNING) * steps.spread
        };
        let sampled = (SMOOTH_SAMPLING * steps.sampling.abs()).max(FIRST_SAMPLING * steps.first_sampling.abs());
        left.max((HIGHER_ORDERS * spacing * steps.correction().abs()).max(sampled))
    })
}

/// Extrapolates the means of three grids or more, with `error` of their changes as the error. Two grids give a rougher estimate,
/// and one gives none.
fn extrapolate_by(means: &[Mean], error: impl Fn(&Changes) -> f64) -> Estimate {
    match *means {
        [] => Estimate { value: 0.0, error: f64::INFINITY },
        [only] => Estimate { value: only.all, error: f64::INFINITY },
        [coarse, fine] => {
            let change = fine.shared - coarse.all;
            Estimate { value: fine.all + change / 3.0, error: change.abs() }
        }
        [.., first, second, third] => {
            let (earlier, change) = (second.shared - first.all, third.shared - second.all);
            let (before, value) = (second.all + earlier / 3.0, third.all + change / 3.0);
            let spread = (value - before).abs();
            let [first_sampling, sampling] = [first, second].map(|mean| mean.all - mean.shared);
            Estimate { value, error: error(&Changes { earlier, change, spread, sampling, first_sampling }) }
        }
    }
}

/// How a mean changed over three nested grids, from r₁ to r₂ (`earlier`) and from there to r₃ (`change`).
struct Changes {
    earlier: f64,
    change: f64,
    /// Difference between the extrapolated mean and the one extrapolated from the two coarser grids.
    spread: f64,
    /// Change of the second mean due to the instants that the first grid lacks, and of the first mean due to every other of its own
    /// instants: where a plate nearly touches, the steps of the first grid may be as long as the near-contact lasts.
    sampling: f64,
    first_sampling: f64,
}

impl Changes {
    fn correction(&self) -> f64 {
        self.change / 3.0
    }

    /// 4 where the mean converges at second order.
    fn ratio(&self) -> f64 {
        if self.change == 0.0 { f64::INFINITY } else { self.earlier / self.change }
    }

    /// Error left by the correction if the mean keeps converging at the observed ratio.
    fn slow_rest(&self) -> f64 {
        (self.change / (self.ratio().max(SLOWEST) - 1.0) - self.correction()).abs()
    }
}

/// A value of extrapolated fields; its error is estimated from the value `before`, of the fields extrapolated from the two coarser grids,
/// and from that of the `finest` grid without extrapolation.
pub fn judged(value: f64, before: f64, finest: f64) -> Estimate {
    Estimate { value, error: (SPREAD * (value - before).abs()).max(CORRECTION * (value - finest).abs()) }
}

/// Estimated distance to the limit of a sequence whose last two changes have these sizes: the geometric series if
/// after/before < `slowest`, otherwise `creep` times the last change.
pub fn left(before: f64, after: f64, slowest: f64, creep: f64) -> f64 {
    let ratio = after / before;
    if ratio < slowest { after * ratio / (1.0 - ratio) } else { creep * after }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_of_an_approach() {
        // 1 − 0.4ⁿ: after the changes from n = 1 to 2 to 3, 0.4³.
        let value = |n: i32| 1.0 - 0.4_f64.powi(n);
        let changes = [value(2) - value(1), value(3) - value(2)];
        assert!((left(changes[0], changes[1], 0.5, 1.0) - 0.4_f64.powi(3)).abs() < 1e-15);
        assert_eq!((left(1e-3, 8e-4, 0.7, 10.0), left(0.0, 8e-4, 0.5, 1.0)), (8e-3, 8e-4));
    }

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
    fn a_smooth_remainder_is_bounded_closely() {
        // r(s) = 1 + 2 s² − 5 s³ + 9 s⁴, whose extrapolation leaves 5 s³/3 and more.
        let mean = |s: f64| 1.0 + 2.0 * s * s - 5.0 * s * s * s + 9.0 * s.powi(4);
        let grids = |s: f64| [4.0 * s, 2.0 * s, s].map(mean).map(|all| Mean { all, shared: all });
        for spacing in [0.1, 0.05, 0.02, 0.01] {
            let estimate = extrapolate_smooth(&grids(spacing), 1.0);
            let error = (estimate.value - 1.0).abs();
            assert!(error < estimate.error && estimate.error < 3.0 * error, "{spacing}: {estimate:?}");
        }
        // Three grids that agree by chance, though the mean depends on its instants.
        let [first, mut second, mut third] = grids(0.01);
        (second.all, third.all, third.shared) = (first.all + 0.02, first.all + 0.02, first.all + 0.02);
        second.shared = first.all;
        assert!(extrapolate_smooth(&[first, second, third], 1.0).error >= 0.002);
    }

    #[test]
    fn a_range_of_small_numbers_has_one_power_of_ten() {
        let range = |ends: [f64; 2]| Estimate::range(ends.map(|value| Estimate { value, error: 5.5e-7 }));
        assert_eq!(range([-1.508e-4, 1.5132e-4]), "(−1.5080 ± 0.0055 … 1.5132 ± 0.0055) × 10^-4");
        assert_eq!(range([0.5, 0.6]), "0.50000000 ± 0.00000055 … 0.60000000 ± 0.00000055");
        assert_eq!(range([-1e-3, 1e-12]), "−0.00100000 ± 0.00000055 … (0.0 ± 5.5) × 10^-7");
        assert_eq!(Estimate::range([Estimate::exact(0.0); 2]), "0 … 0");
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
