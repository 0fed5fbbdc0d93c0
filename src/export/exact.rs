//! A plate beside what is known exactly, as the `exact` object of `solve --json`.

use super::estimates;
use super::figure::extent;
use crate::analysis::exact::Comparison;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The object: σ/Q, Q the factor by which slip raises the flow at the mean gap; spring and damping over p_a · area · ε, and the same as
/// stiffness \[N/m, of a strip per metre of width\] and damping \[N s/m\]; `linear_…` is exact for ε → 0 (Langlois 1962 of a strip, Blech 1983
/// of a rectangle), `trapped_…` for σ → ∞ (Langlois 1962, Salbu 1964; with slip); loads in the object's force unit, of gas that cannot
/// leave (Boyle), and of gas that is not compressed, whose least is its greatest, negative. What is not known is null.
impl Serialize for Comparison {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [boyle, viscous] = [&self.limits.boyle, &self.limits.viscous].map(|load| extent(load.iter().copied()));
        let (linear, unit, absolute) = (self.linear, self.unit, self.stiffness_and_damping());
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("effective_squeeze_number", &self.effective_squeeze_number)?;
        for (name, of_unit, solved, exact) in [
            ("spring", "", self.solved.map(|solved| solved.spring), linear.spring),
            ("damping", "", self.solved.map(|solved| solved.damping), linear.damping),
            ("stiffness", "_n_per_m", absolute.map(|solved| solved.spring), linear.spring * unit.spring),
            ("damping", "_n_s_per_m", absolute.map(|solved| solved.damping), linear.damping * unit.damping),
        ] {
            estimates::add(&mut map, name, of_unit, solved)?;
            map.serialize_entry(&format!("linear_{name}{of_unit}"), &exact)?;
        }
        estimates::add(&mut map, "mean_pressure_ratio", "", Some(self.mean_pressure))?;
        map.serialize_entry("trapped_mean_pressure_ratio", &self.trapped_mean_pressure)?;
        map.serialize_entry("invariant_deviation", &self.invariant_deviation)?;
        map.serialize_entry("boyle_load_min_n", &boyle[0])?;
        map.serialize_entry("boyle_load_max_n", &boyle[1])?;
        map.serialize_entry("incompressible_load_max_n", &viscous[1])?;
        map.end()
    }
}
