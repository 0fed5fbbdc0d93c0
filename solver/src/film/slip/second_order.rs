//! Slip of second order (Hsia and Domoto 1983).

use super::mobility::Mobility;

/// ψ = Z + 6 λ_a + 6 λ_a²/Z (Hsia and Domoto 1983).
#[derive(Clone, Copy, Debug)]
pub struct SecondOrder {
    /// λ_a \[m\].
    pub mean_free_path: f64,
}

impl Mobility for SecondOrder {
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
