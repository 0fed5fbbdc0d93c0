//! Carbon dioxide. Viscosity by Fenghour, Wakeham and Vesovic (J. Phys. Chem. Ref. Data 27, 1998, 31), 200 K to 1500 K. Below −56 °C it is
//! not gaseous at every pressure that a scene may have: at −70 °C it freezes at 0.2 MPa.

use super::collision::Collision;
use super::species::Species;

pub(super) const CARBON_DIOXIDE: Species =
    Species { name: "carbon-dioxide", molar_mass: 44.0098e-3, viscosity, heat_ratio: 1.297, prandtl: 0.764 };

fn viscosity(temperature: f64) -> f64 {
    let terms = [0.235156, -0.491266, 5.211155e-2, 5.347906e-2, -1.537102e-2];
    Collision { scale: 1.00697e-6, energy: 251.196, terms }.viscosity(temperature)
}
