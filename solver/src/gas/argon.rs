//! Argon. Viscosity by Lemmon and Jacobsen (2004), 84 K to 2000 K.

use super::collision::lemmon_jacobsen;
use super::species::Species;

pub(super) const ARGON: Species =
    Species { name: "argon", molar_mass: 39.948e-3, viscosity, heat_ratio: 1.670, prandtl: 0.665 };

fn viscosity(temperature: f64) -> f64 {
    lemmon_jacobsen(39.948, 0.335, 143.2).viscosity(temperature)
}
