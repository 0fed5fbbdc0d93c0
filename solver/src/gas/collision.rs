//! Viscosity of a dilute gas by Chapman and Enskog, with the collision integral as a fit:
//! μ = C √T/S, ln S = Σ aᵢ (ln T/T₀)ⁱ.

/// A fit of the collision integral.
pub(super) struct Collision {
    /// C \[Pa s/√K\].
    pub(super) scale: f64,
    /// T₀ = ε/k \[K\].
    pub(super) energy: f64,
    /// a₀ to a₄.
    pub(super) terms: [f64; 5],
}

impl Collision {
    /// Viscosity \[Pa s\] at a temperature \[K\].
    pub(super) fn viscosity(&self, temperature: f64) -> f64 {
        let x = (temperature / self.energy).ln();
        let [a, b, c, d, e] = self.terms;
        self.scale * temperature.sqrt() / (a + x * (b + x * (c + x * (d + x * e)))).exp()
    }
}

/// As Lemmon and Jacobsen write C: 0.0266958 √M/σ² µPa·s/√K, molar mass M \[g/mol\], diameter σ \[nm\].
pub(super) fn lemmon_jacobsen(molar_mass: f64, diameter: f64, energy: f64) -> Collision {
    Collision { scale: 2.66958e-8 * molar_mass.sqrt() / (diameter * diameter), energy, terms: LEMMON_JACOBSEN }
}

/// The collision integral by Lemmon and Jacobsen (Int. J. Thermophys. 25, 2004, 21), one for air, nitrogen and argon; from the
/// melting point to 2000 K, within 1 % of the measurements at low density.
const LEMMON_JACOBSEN: [f64; 5] = [0.431, -0.4623, 0.08406, 0.005341, -0.00331];
