//! Slip of second order (Hsia and Domoto 1983).

use super::mobility::Mobility;
use crate::problem::{Gas, Slip};

/// ψ = Z + 6 λ_a + 6 λ_a²/Z (Hsia and Domoto 1983).
#[derive(Clone, Copy, Debug)]
pub struct SecondOrder {
    /// λ_a \[m\].
    pub mean_free_path: f64,
}

impl Mobility for SecondOrder {
    fn of(gas: &Gas) -> Option<Self> {
        let mean_free_path = gas.mean_free_path;
        (gas.slip == Slip::SecondOrder && mean_free_path > 0.0).then_some(Self { mean_free_path })
    }

    fn knudsen_limit(&self) -> f64 {
        0.6
    }

    #[inline(always)]
    fn at(self, z: f64) -> (f64, f64) {
        let knudsen = self.mean_free_path / z;
        (z + 6.0 * self.mean_free_path * (1.0 + knudsen), 1.0 - 6.0 * knudsen * knudsen)
    }

    #[inline(always)]
    fn potential(self, z: f64) -> f64 {
        let path = self.mean_free_path;
        z * (0.5 * z + 6.0 * path) + 6.0 * path * path * (z / path).ln()
    }
}
