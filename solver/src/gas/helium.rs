//! Helium. Viscosity by Arp, McCarty and Friend (NIST Technical Note 1334, 1998), 100 K to 1500 K.

use super::species::Species;

pub(super) const HELIUM: Species =
    Species { name: "helium", molar_mass: 4.002602e-3, viscosity, heat_ratio: 1.667, prandtl: 0.664 };

fn viscosity(temperature: f64) -> f64 {
    196e-7 * temperature.powf(0.71938) * (12.451 / temperature - 295.67 / (temperature * temperature) - 4.1249).exp()
}
