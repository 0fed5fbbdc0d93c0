//! Velocity of the gas across the film, from wall to wall, which the Reynolds equation has integrated out.
//!
//! Between walls at z = 0 and z = h, which move at U₀ and U₁ along x, gas is driven by the pressure and dragged by the walls:
//!
//! ```text
//! u(z) = −(1/2μ) ∂p/∂x (z (h − z) + ℓ h) + U₀ + (U₁ − U₀) (z + ℓ)/(h + 2ℓ)
//! ∫u dz = −(h³/12μ) (1 + 6 ℓ/h) ∂p/∂x + h (U₀ + U₁)/2
//! ```
//!
//! This is a plane Poiseuille flow and a plane Couette flow with Maxwell's slip: at either wall the gas velocity differs from the wall's by
//! ℓ times the slope of u. With first-order slip the slip length ℓ is the local mean free path λ_a/P. For the other laws ℓ is chosen so
//! that the parabola carries their flow, ℓ = (ψ(Z)/P − h)/6, so that ∫u dz is always the flow with which the film is solved. The profiles
//! of these laws are in fact steeper within about a mean free path of the walls. Between rough faces the profile is that of smooth faces at
//! the same distance.

use super::slip::{Mobility, SlipLaw};
use crate::problem::Gas;

/// Velocity along x at one place of the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Velocity {
    /// Film thickness h \[m\].
    pub thickness: f64,
    /// Slip length ℓ \[m\].
    pub slip_length: f64,
    /// −(1/2μ) ∂p/∂x \[1/(m s)\].
    pub driven: f64,
    /// Velocities U₀ and U₁ of the lower and the upper wall \[m/s\].
    pub walls: [f64; 2],
}

impl Velocity {
    /// The velocity of `gas` in a film of `thickness` \[m\] at absolute `pressure` \[Pa\], whose slope along x is `gradient` \[Pa/m\],
    /// between walls that move at `walls` \[m/s\], the lower one first.
    pub fn new(gas: &Gas, thickness: f64, pressure: f64, gradient: f64, walls: [f64; 2]) -> Self {
        let ratio = pressure / gas.ambient_pressure;
        let mobility = SlipLaw::of(gas).at(thickness * ratio).0;
        let slip_length = ((mobility / ratio - thickness) / 6.0).max(0.0);
        Self { thickness, slip_length, driven: -0.5 * gradient / gas.viscosity, walls }
    }

    /// Velocity u \[m/s\] at height `z` \[m\] above the lower wall, 0 ≤ z ≤ h.
    pub fn at(&self, z: f64) -> f64 {
        let Self { thickness, slip_length, driven, walls: [lower, upper] } = *self;
        driven * (z * (thickness - z) + slip_length * thickness)
            + lower
            + (upper - lower) * (z + slip_length) / (thickness + 2.0 * slip_length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Slip;

    const LAWS: [Slip; 4] = [Slip::None, Slip::FirstOrder, Slip::SecondOrder, Slip::FukuiKaneko];
    const THICKNESS: f64 = 3e-7;

    fn gas(slip: Slip) -> Gas {
        Gas { slip, ..Gas::default() }
    }

    /// By Simpson's rule, exact for a parabola.
    fn integral(velocity: &Velocity) -> f64 {
        let h = velocity.thickness;
        h / 6.0 * (velocity.at(0.0) + 4.0 * velocity.at(0.5 * h) + velocity.at(h))
    }

    #[test]
    fn its_integral_is_the_flow_of_the_film_for_every_law() {
        for slip in LAWS {
            for (pressure, gradient, walls) in
                [(2.5e5, 4e8, [0.0, 0.0]), (6e4, -3e7, [0.19, 0.0]), (1e5, 0.0, [-0.2, 0.4]), (8e5, 1e9, [0.1, 0.7])]
            {
                let gas = gas(slip);
                let velocity = Velocity::new(&gas, THICKNESS, pressure, gradient, walls);
                // Of the trapped height Z = hP the film carries −M h² ψ(Z) ∂P/∂x + Z U/2, seen from the lower wall.
                let ratio = pressure / gas.ambient_pressure;
                let mobility = gas.ambient_pressure / (12.0 * gas.viscosity) * THICKNESS * THICKNESS;
                let trapped = THICKNESS * ratio;
                let carried = -mobility * SlipLaw::of(&gas).at(trapped).0 * gradient / gas.ambient_pressure
                    + 0.5 * trapped * (walls[1] - walls[0]);
                let flow = integral(&velocity) - walls[0] * THICKNESS;
                let size = carried.abs().max(1e-12);
                assert!((ratio * flow - carried).abs() < 1e-12 * size, "{slip:?}: {flow} {carried}");
            }
        }
    }

    #[test]
    fn poiseuille_and_couette_flow_slip_by_the_mean_free_path() {
        let gas = gas(Slip::FirstOrder);
        let (pressure, gradient) = (2.0 * gas.ambient_pressure, -5e8);
        // Half the mean free path at twice the pressure.
        let path = 0.5 * gas.mean_free_path;
        let still = Velocity::new(&gas, THICKNESS, pressure, gradient, [0.0; 2]);
        assert!((still.slip_length / path - 1.0).abs() < 1e-9);
        let poiseuille = |z: f64| -gradient / (2.0 * gas.viscosity) * (THICKNESS * z - z * z + path * THICKNESS);
        let dragged = Velocity::new(&gas, THICKNESS, pressure, 0.0, [0.2, 1.0]);
        let rate = 0.8 / (THICKNESS + 2.0 * path);
        for part in [0.0, 0.1, 0.5, 1.0] {
            let z = part * THICKNESS;
            assert!((still.at(z) / poiseuille(z) - 1.0).abs() < 1e-9);
            assert!((dragged.at(z) - (0.2 + rate * (z + path))).abs() < 1e-12);
        }
        // Both at once: at each wall the gas velocity exceeds the wall's by the path times the slope into the film.
        let both = Velocity::new(&gas, THICKNESS, pressure, gradient, [0.2, 1.0]);
        let step = 1e-3 * THICKNESS;
        let slope = |z: f64| (both.at(z + step) - both.at(z - step)) / (2.0 * step);
        for (z, wall, inwards) in [(0.0, 0.2, 1.0), (THICKNESS, 1.0, -1.0)] {
            let slip = both.at(z) - wall;
            assert!((slip - path * inwards * slope(z)).abs() < 1e-9 * slip.abs(), "{slip}");
        }
    }

    #[test]
    fn without_slip_the_gas_sticks_to_the_walls() {
        let velocity = Velocity::new(&gas(Slip::None), THICKNESS, 1e5, 3e8, [0.3, -0.1]);
        assert_eq!(velocity.slip_length, 0.0);
        assert!((velocity.at(0.0) - 0.3).abs() < 1e-12 && (velocity.at(THICKNESS) + 0.1).abs() < 1e-12);
    }
}
