//! The first harmonic of a plate's load. With the gap h = h₀(1 + ε cos τ) and the plate's area A,
//!
//! ```text
//! F = F₀ + p_a A ε (−S cos τ + D sin τ) + …
//! ```
//!
//! S is the *spring*, in phase with the approach, and D the *damping*, in phase with its speed. For ε → 0 both are known for
//! every σ (`film::exact`); slip enters by its factor Q at the mean gap, as σ/Q.

use super::result::first_harmonic;
use crate::dimensionless::Dimensionless;
use crate::estimate::Estimate;
use crate::film::exact::linear_load;
use crate::film::slip::{Mobility, SlipLaw};
use crate::problem::{Outline, Plate};
use crate::recording::Recording;
use crate::solution::{Harmonic, PlateResult};

/// Least errors of spring and damping, as shares of the mean error of the load over the cycle (calibrated: docs/validation.md).
const SPRING_SHARE: f64 = 1.4;
const DAMPING_SHARE: f64 = 0.4;
/// Ratio of damping to spring below which the solve took the gas as trapped; the rest is rounding.
const IN_PHASE: f64 = 1e-9;

/// Spring and damping of a solve of `plate`, over p_a · area · ε; `None` if nothing vibrates.
pub fn solved(plate: &Plate, result: &PlateResult, recording: &Recording) -> Option<Harmonic<Estimate>> {
    let excursion = plate.amplitude / plate.mean_gap;
    let scale = plate.gas.ambient_pressure * plate.area() * excursion;
    let errors = &recording.film_load_error;
    let of_load = errors.iter().sum::<f64>() / errors.len().max(1) as f64 / scale;
    let of = |part: usize, share: f64| {
        let found = recording.estimate(|lines| first_harmonic(&lines.film_loads())[part] / scale);
        Estimate { error: found.error.max(share * of_load) + result.harmonic_error[part] / scale, ..found }
    };
    (excursion > 0.0 && !recording.film_load.is_empty()).then(|| {
        let (mut spring, mut damping) = (of(0, SPRING_SHARE), of(1, DAMPING_SHARE));
        // If the load is one peak, its first harmonic is twice its mean.
        let peak = result.film_load * (2.0 / scale);
        let share = (peak.value.abs() / spring.value.abs().max(f64::MIN_POSITIVE)).min(1.0);
        spring.error = spring.error.max(share * peak.error);
        if damping.value.abs() < IN_PHASE * spring.value.abs() {
            // The neglected leakage causes damping, and softens the spring by as much; the effect is greatest at a small amplitude.
            let leaks = linear(effective_squeeze_number(plate), plate.outline()).damping;
            spring.error += leaks * spring.value.abs();
            damping.error += leaks;
        }
        Harmonic { spring, damping }
    })
}

/// Spring and damping for ε → 0 at σ/Q.
pub fn linear(effective_squeeze_number: f64, outline: Outline) -> Harmonic<f64> {
    let load = linear_load(effective_squeeze_number, outline);
    Harmonic { spring: -load.re, damping: -load.im }
}

/// σ over the slip's factor at the mean gap and ambient pressure.
pub fn effective_squeeze_number(plate: &Plate) -> f64 {
    let (mobility, _) = SlipLaw::of(&plate.gas).at(plate.mean_gap);
    Dimensionless::of_plate(plate).squeeze_number * plate.mean_gap / mobility
}
