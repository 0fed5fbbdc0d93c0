//! Normal hydrogen. Viscosity by Muzny, Huber and Kazakov (J. Chem. Eng. Data 58, 2013, 969), 14 K to 1000 K.

use super::collision::Collision;
use super::species::Species;

pub(super) const HYDROGEN: Species =
    Species { name: "hydrogen", molar_mass: 2.01588e-3, viscosity, heat_ratio: 1.406, prandtl: 0.685 };

fn viscosity(temperature: f64) -> f64 {
    let terms = [0.209630, -0.455274, 0.143602, -0.0335325, 0.00276981];
    let scale = 2.1357e-8 * 2.01588_f64.sqrt() / (0.297 * 0.297);
    Collision { scale, energy: 30.41, terms }.viscosity(temperature)
}
