//! A plate beside what is known exactly, as the `exact` object of `solve --json`.

use super::estimates;
use super::figure::extent;
use crate::analysis::exact::Comparison;
use serde_json::{Value, json};

/// The object: σ/Q, Q the factor by which slip raises the flow at the mean gap; spring and damping over p_a · area · ε, and the same as
/// stiffness \[N/m, of a strip per metre of width\] and damping \[N s/m\]; `linear_…` is exact for ε → 0 (Langlois 1962 of a strip, Blech 1983
/// of a rectangle), `trapped_…` for σ → ∞ (Langlois 1962, Salbu 1964; with slip); loads in the object's force unit, of gas that cannot
/// leave (Boyle), and of gas that is not compressed, whose least is its greatest, negative. What is not known is null.
pub(super) fn object(found: &Comparison) -> Value {
    let [boyle, viscous] = [&found.limits.boyle, &found.limits.viscous].map(|load| extent(load.iter().copied()));
    let (linear, unit, absolute) = (found.linear, found.unit, found.stiffness_and_damping());
    let mut object = json!({ "effective_squeeze_number": found.effective_squeeze_number });
    for (name, of_unit, solved, exact) in [
        ("spring", "", found.solved.map(|solved| solved.spring), linear.spring),
        ("damping", "", found.solved.map(|solved| solved.damping), linear.damping),
        ("stiffness", "_n_per_m", absolute.map(|solved| solved.spring), linear.spring * unit.spring),
        ("damping", "_n_s_per_m", absolute.map(|solved| solved.damping), linear.damping * unit.damping),
    ] {
        estimates::add(&mut object, name, of_unit, solved);
        object[format!("linear_{name}{of_unit}")] = exact.into();
    }
    estimates::add(&mut object, "mean_pressure_ratio", "", Some(found.mean_pressure));
    object["trapped_mean_pressure_ratio"] = found.trapped_mean_pressure.into();
    object["invariant_deviation"] = found.invariant_deviation.into();
    object["boyle_load_min_n"] = boyle[0].into();
    object["boyle_load_max_n"] = boyle[1].into();
    object["incompressible_load_max_n"] = viscous[1].into();
    object
}
