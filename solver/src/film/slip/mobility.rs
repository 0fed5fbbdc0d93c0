//! The trait that every slip law implements.

/// A slip law: ψ and dψ/dZ, and where it holds.
pub trait Mobility: Copy {
    /// `(ψ [m], dψ/dZ)` at trapped height `z` = h p/p_a \[m\], z > 0; |dψ/dZ| ≤ ψ/z.
    fn at(self, z: f64) -> (f64, f64);

    /// Φ = ∫ψ dZ \[m²\], up to a constant: for uniform gaps the flux is −M h ∇Φ.
    fn potential(self, z: f64) -> f64;

    /// Greatest Kn at which it is within a tenth of the Boltzmann equation's flow; of a fit to that, where the fit ends.
    fn knudsen_limit(&self) -> f64;
}
