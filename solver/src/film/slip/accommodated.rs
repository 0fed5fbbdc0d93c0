//! The linearised Boltzmann equation between walls that reflect some of the molecules specularly.
//!
//! With Maxwell's boundary condition a fraction α of the molecules leaves a wall diffusely and the others are reflected specularly. The
//! flow rate Q_P(D) of the linearised BGK equation with this condition was computed by discrete ordinates, as `tests/boltzmann.rs` does
//! again. Its excess over the flow rate for α = 1 is fitted here for 0.3 ≤ α ≤ 1 and 0.01 ≤ D ≤ 100:
//!
//! ΔQ_P = (1 − α)/α · (a₀ + a₁ ln(1 + α d₁/D) + a₂ d₂/(d₂ + D) + a₃ d₃/(d₃ + D)), aᵢ linear in α,
//!
//! to 0.2 % of Q_P. It falls with D, as −ln D towards free molecules, to a constant: that of slip.

use super::fukui_kaneko::{FIT_ENDS, FukuiKaneko, flow_rate};
use super::mobility::Mobility;

/// d₁, d₂, d₃ of the fit.
const RANGES: [f64; 3] = [1.335, 0.14, 1.472];
/// a₀ to a₃ of the fit, at an accommodation coefficient α of 0.
const TERMS: [f64; 4] = [1.7651, 0.7453, -0.7838, 0.1894];
/// Increase of each of them up to α = 1.
const GROWTH: [f64; 4] = [0.1369, 0.4021, -0.7898, -1.5492];

/// As [`FukuiKaneko`], between walls that reflect a fraction of the molecules specularly, which increases the flow.
#[derive(Clone, Copy, Debug)]
pub struct Accommodated {
    diffuse: FukuiKaneko,
    /// Accommodation coefficient α times d₁.
    range: f64,
    /// aᵢ times (1 − α)/α.
    terms: [f64; 4],
}

impl Accommodated {
    /// The law for a mean free path λ_a \[m\], positive, and an accommodation coefficient α, 0 < α ≤ 1.
    pub fn new(mean_free_path: f64, accommodation: f64) -> Self {
        let share = (1.0 - accommodation) / accommodation;
        let term = |i: usize| share * (TERMS[i] + accommodation * GROWTH[i]);
        Self {
            diffuse: FukuiKaneko { mean_free_path },
            range: accommodation * RANGES[0],
            terms: std::array::from_fn(term),
        }
    }

    /// ΔQ_P and D dΔQ_P/dD.
    fn excess(&self, x: f64) -> (f64, f64) {
        let [constant, log, short, long] = self.terms;
        let [short_part, long_part] = [RANGES[1] / (RANGES[1] + x), RANGES[2] / (RANGES[2] + x)];
        let flow = constant + log * (self.range / x).ln_1p() + short * short_part + long * long_part;
        let slope = -log * self.range / (self.range + x)
            - short * short_part * (1.0 - short_part)
            - long * long_part * (1.0 - long_part);
        (flow, slope)
    }

    /// ∫ΔQ_P dD from 0.
    fn excess_potential(&self, x: f64) -> f64 {
        let [constant, log, short, long] = self.terms;
        let logarithm = x * (self.range / x).ln_1p() + self.range * (x / self.range).ln_1p();
        let rational = |i: usize| RANGES[i] * (x / RANGES[i]).ln_1p();
        constant * x + log * logarithm + short * rational(1) + long * rational(2)
    }
}

impl Mobility for Accommodated {
    fn knudsen_limit(&self) -> f64 {
        FIT_ENDS
    }

    fn at(self, z: f64) -> (f64, f64) {
        let x = self.diffuse.inverse_knudsen(z);
        let ((flow, slope), (more, more_slope)) = (flow_rate(x), self.excess(x));
        // ψ = (6 Z/D) Q_P, and Z/D is constant.
        (6.0 * (flow + more) * z / x, 6.0 * (slope + more_slope) / x)
    }

    fn potential(self, z: f64) -> f64 {
        let x = self.diffuse.inverse_knudsen(z);
        self.diffuse.potential(z) + 6.0 * (z / x) * (z / x) * self.excess_potential(x)
    }
}
