//! Nitrogen. Viscosity by Lemmon and Jacobsen (2004), 63 K to 2000 K.

use super::collision::lemmon_jacobsen;
use super::species::Species;

pub(super) const NITROGEN: Species =
    Species { name: "nitrogen", molar_mass: 28.01348e-3, viscosity, heat_ratio: 1.401, prandtl: 0.718 };

fn viscosity(temperature: f64) -> f64 {
    lemmon_jacobsen(28.01348, 0.3656, 98.94).viscosity(temperature)
}
