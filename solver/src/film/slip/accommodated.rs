//! The linearised Boltzmann equation between walls that reflect some molecules as a mirror does.

use super::fukui_kaneko::{FIT_ENDS, FukuiKaneko, flow_rate};
use super::mobility::Mobility;
use super::specular::Specular;

/// As [`FukuiKaneko`], between walls that reflect a share of the molecules specularly: more flow.
#[derive(Clone, Copy, Debug)]
pub struct Accommodated {
    diffuse: FukuiKaneko,
    specular: Specular,
}

impl Accommodated {
    /// The law for a mean free path λ_a \[m\] and an accommodation coefficient, both positive.
    pub fn new(mean_free_path: f64, accommodation: f64) -> Self {
        Self { diffuse: FukuiKaneko { mean_free_path }, specular: Specular::new(accommodation) }
    }
}

impl Mobility for Accommodated {
    fn knudsen_limit(&self) -> f64 {
        FIT_ENDS
    }

    fn at(self, z: f64) -> (f64, f64) {
        let x = self.diffuse.inverse_knudsen(z);
        let ((flow, slope), (more, more_slope)) = (flow_rate(x), self.specular.flow(x));
        // ψ = (6 Z/D) Q_P, and Z/D is constant.
        (6.0 * (flow + more) * z / x, 6.0 * (slope + more_slope) / x)
    }

    fn potential(self, z: f64) -> f64 {
        let x = self.diffuse.inverse_knudsen(z);
        self.diffuse.potential(z) + 6.0 * (z / x) * (z / x) * self.specular.potential(x)
    }
}
