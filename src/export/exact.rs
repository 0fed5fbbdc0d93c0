//! A plate beside what is known exactly, as the `exact` object of `solve --json`.

use crate::analysis::exact::Comparison;
use crate::estimate::Estimate;
use crate::problem::Plate;
use serde::Serialize;

/// The object. Numbers that are not known are null.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ExactObject {
    /// σ/Q, Q the factor by which slip raises the flow at the mean gap.
    pub effective_squeeze_number: Option<f64>,
    /// Load amplitude in phase with the approach, over p_a · area · ε.
    pub spring: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub spring_error: Option<f64>,
    /// Exact for ε → 0 (Langlois 1962 of a strip, Blech 1983 of a rectangle).
    pub linear_spring: Option<f64>,
    /// Load amplitude in phase with the speed of the approach, over p_a · area · ε.
    pub damping: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub damping_error: Option<f64>,
    /// Exact for ε → 0.
    pub linear_damping: Option<f64>,
    /// First harmonic of the load over the amplitude \[N/m, of a strip per metre of width\]: its part that pushes back, …
    pub stiffness_n_per_m: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub stiffness_error_n_per_m: Option<f64>,
    /// Exact for ε → 0.
    pub linear_stiffness_n_per_m: Option<f64>,
    /// … and its part in phase with the speed, over ω \[N s/m, of a strip per metre of width\].
    pub damping_n_s_per_m: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub damping_error_n_s_per_m: Option<f64>,
    /// Exact for ε → 0.
    pub linear_damping_n_s_per_m: Option<f64>,
    /// Cycle mean of P over the plate.
    pub mean_pressure_ratio: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub mean_pressure_ratio_error: Option<f64>,
    /// Exact for σ → ∞ (Langlois 1962, Salbu 1964; with slip).
    pub trapped_mean_pressure_ratio: Option<f64>,
    /// Greatest deviation of the invariant from its exact value at any point, relative.
    pub invariant_deviation: Option<f64>,
    /// Least load of gas that cannot leave (Boyle), in the object's force unit.
    pub boyle_load_min_n: Option<f64>,
    /// Its greatest.
    pub boyle_load_max_n: Option<f64>,
    /// Greatest load of gas that is not compressed, in the object's force unit; its least is the same, negative.
    pub incompressible_load_max_n: Option<f64>,
}

/// What stiffness and damping of a plate are in; those of a strip are per metre of width.
pub fn units(plate: &Plate) -> [&'static str; 2] {
    if plate.width.is_some() { ["N/m", "N·s/m"] } else { ["N/m²", "N·s/m²"] }
}

impl ExactObject {
    /// Of what was found.
    pub fn new(found: &Comparison) -> Self {
        let finite = |value: f64| value.is_finite().then_some(value);
        let pair = |estimate: Option<Estimate>| {
            estimate.map_or([None, None], |found| [finite(found.value), finite(found.error)])
        };
        let [spring, spring_error] = pair(found.solved.map(|solved| solved.spring));
        let [damping, damping_error] = pair(found.solved.map(|solved| solved.damping));
        let solved = found.stiffness_and_damping();
        let [stiffness_n_per_m, stiffness_error_n_per_m] = pair(solved.map(|solved| solved.spring));
        let [damping_n_s_per_m, damping_error_n_s_per_m] = pair(solved.map(|solved| solved.damping));
        let [mean_pressure_ratio, mean_pressure_ratio_error] = pair(Some(found.mean_pressure));
        let least = |series: &[f64]| finite(series.iter().copied().fold(f64::INFINITY, f64::min));
        let most = |series: &[f64]| finite(series.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        Self {
            effective_squeeze_number: finite(found.effective_squeeze_number),
            spring,
            spring_error,
            linear_spring: finite(found.linear.spring),
            damping,
            damping_error,
            linear_damping: finite(found.linear.damping),
            stiffness_n_per_m,
            stiffness_error_n_per_m,
            linear_stiffness_n_per_m: finite(found.linear.spring * found.unit.spring),
            damping_n_s_per_m,
            damping_error_n_s_per_m,
            linear_damping_n_s_per_m: finite(found.linear.damping * found.unit.damping),
            mean_pressure_ratio,
            mean_pressure_ratio_error,
            trapped_mean_pressure_ratio: finite(found.trapped_mean_pressure),
            invariant_deviation: found.invariant_deviation.and_then(finite),
            boyle_load_min_n: least(&found.limits.boyle),
            boyle_load_max_n: most(&found.limits.boyle),
            incompressible_load_max_n: most(&found.limits.viscous),
        }
    }
}
