//! No slip, and slip of first order (Burgdorfer 1959).

use super::mobility::Mobility;

/// ψ = Z + s: no slip (s = 0) and first order (s = 6 λ_a).
#[derive(Clone, Copy, Debug)]
pub struct Affine {
    /// s \[m\].
    pub offset: f64,
}

impl Mobility for Affine {
    fn knudsen_limit(&self) -> f64 {
        if self.offset == 0.0 { 0.01 } else { 0.1 }
    }

    #[inline(always)]
    fn at(self, z: f64) -> (f64, f64) {
        (z + self.offset, 1.0)
    }

    #[inline(always)]
    fn potential(self, z: f64) -> f64 {
        z * (0.5 * z + self.offset)
    }
}
