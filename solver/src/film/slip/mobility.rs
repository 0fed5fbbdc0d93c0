//! The trait that every slip law implements.

/// A slip law: ψ and dψ/dZ, and its range of validity.
pub trait Mobility: Copy {
    /// `(ψ [m], dψ/dZ)` at trapped height `z` = h p/p_a \[m\], z > 0; |dψ/dZ| ≤ ψ/z.
    fn at(self, z: f64) -> (f64, f64);

    /// Φ = ∫ψ dZ \[m²\], up to a constant; in a uniform gap the flux is −M h ∇Φ.
    fn potential(self, z: f64) -> f64;

    /// Largest Kn at which the law is within a tenth of the flow of the Boltzmann equation; for a fit to that equation, the end of the fit.
    fn knudsen_limit(&self) -> f64;
}
