//! Dry air. Viscosity by Lemmon and Jacobsen (2004), 60 K to 2000 K.

use super::collision::lemmon_jacobsen;
use super::species::Species;

pub(super) const AIR: Species =
    Species { name: "air", molar_mass: 28.9586e-3, viscosity, heat_ratio: 1.402, prandtl: 0.708 };

fn viscosity(temperature: f64) -> f64 {
    lemmon_jacobsen(28.9586, 0.360, 103.3).viscosity(temperature)
}
