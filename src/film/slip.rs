//! Slip laws: the mobility ψ(Z) of the film.
//!
//! The Poiseuille mass flux is −h² ψ(Z) ∇(p/p_a) p_a/(12μ) with Z = h p/p_a \[m\] and ψ = Z Q, Q the factor of slip, a
//! function of the local Knudsen number Kn = λ_a/Z only. Every law here has |d ln ψ/d ln Z| ≤ 1, which makes the
//! Jacobian of the discrete film an M-matrix (`film::stepper`).

mod specular;

use crate::numerics::gauss_legendre;
use crate::problem::{Gas, Slip};
use specular::Specular;
use std::sync::LazyLock;

/// ψ and dψ/dZ of a slip law.
pub trait Mobility: Copy {
    /// `(ψ [m], dψ/dZ)` at trapped height `z` = h p/p_a \[m\], z > 0.
    fn at(self, z: f64) -> (f64, f64);

    /// Φ = ∫ψ dZ \[m²\], up to a constant: for uniform gaps the flux is −M h ∇Φ.
    fn potential(self, z: f64) -> f64;
}

/// ψ = Z + s: no slip (s = 0) and first order (s = 6 λ_a).
#[derive(Clone, Copy, Debug)]
pub struct Affine {
    /// s \[m\].
    pub offset: f64,
}

impl Mobility for Affine {
    #[inline(always)]
    fn at(self, z: f64) -> (f64, f64) {
        (z + self.offset, 1.0)
    }

    #[inline(always)]
    fn potential(self, z: f64) -> f64 {
        z * (0.5 * z + self.offset)
    }
}

/// ψ = Z + 6 λ_a + 6 λ_a²/Z (Hsia and Domoto 1983).
#[derive(Clone, Copy, Debug)]
pub struct SecondOrder {
    /// λ_a \[m\].
    pub mean_free_path: f64,
}

impl Mobility for SecondOrder {
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

/// The flow rate of the linearised Boltzmann equation, as fitted by Fukui and Kaneko (ASME J. Tribology 112, 1990):
/// Q = 6 Q_P(D)/D, D = (√π/2) Z/λ_a, Q_P = aD + b + c/D + d/D² in three ranges of D.
///
/// The published pieces differ by 0.1 % where they meet; they are blended over a quarter of a decade, so that the
/// mobility is smooth. Below D = 0.01, where the fit ends, Q_P follows the free-molecular −ln(D)/√π.
#[derive(Clone, Copy, Debug)]
pub struct FukuiKaneko {
    /// λ_a \[m\], positive.
    pub mean_free_path: f64,
}

/// a, b, c, d of Q_P = aD + b + c/D + d/D².
type Piece = [f64; 4];
const CONTINUUM: Piece = [1.0 / 6.0, 1.0162, 1.0653, -2.1354];
const TRANSITION: Piece = [0.13852, 1.25087, 0.15653, -0.00969];
const RAREFIED: Piece = [-2.22919, 2.10673, 0.01653, -0.0000694];

/// Q_P and D dQ_P/dD of a piece.
fn piece([a, b, c, d]: Piece, x: f64) -> (f64, f64) {
    (a * x + b + c / x + d / (x * x), a * x - c / x - 2.0 * d / (x * x))
}

/// Blend of two pieces over ln D within ±`HALF_BLEND` of ln `join`.
fn blend(below: (f64, f64), above: (f64, f64), x: f64, join: f64) -> (f64, f64) {
    const HALF_BLEND: f64 = 0.25;
    let t = (0.5 + 0.5 * (x / join).ln() / HALF_BLEND).clamp(0.0, 1.0);
    let (s, ds) = (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) * 0.5 / HALF_BLEND);
    (below.0 + s * (above.0 - below.0), below.1 + s * (above.1 - below.1) + ds * (above.0 - below.0))
}

/// Q_P(D) and D dQ_P/dD.
fn flow_rate(x: f64) -> (f64, f64) {
    if x > 1.0 {
        blend(piece(TRANSITION, x), piece(CONTINUUM, x), x, 5.0)
    } else if x >= RAREFIED_END {
        blend(piece(RAREFIED, x), piece(TRANSITION, x), x, 0.15)
    } else {
        let fall = std::f64::consts::PI.sqrt().recip();
        (piece(RAREFIED, RAREFIED_END).0 - fall * (x / RAREFIED_END).ln(), -fall)
    }
}

/// D at which the fit ends.
const RAREFIED_END: f64 = 0.01;

/// F(D) = ∫ Q_P dD, up to a constant: cubics in ln D between nodes, and in closed form beyond either end.
struct FlowPotential {
    /// F and dF/d ln D at the nodes.
    nodes: Vec<(f64, f64)>,
}

impl FlowPotential {
    const FIRST: f64 = RAREFIED_END;
    const LAST: f64 = 10.0;
    const INTERVALS: usize = 800;

    fn step() -> f64 {
        (Self::LAST / Self::FIRST).ln() / Self::INTERVALS as f64
    }

    fn new() -> Self {
        let slope = |s: f64| s.exp() * flow_rate(s.exp()).0;
        let mut sum = 0.0;
        let mut nodes = Vec::with_capacity(Self::INTERVALS + 1);
        for i in 0..=Self::INTERVALS {
            let here = Self::FIRST.ln() + i as f64 * Self::step();
            nodes.push((sum, slope(here)));
            sum += gauss_legendre(here, here + Self::step(), slope);
        }
        Self { nodes }
    }

    fn at(&self, x: f64) -> f64 {
        let (first, last) = (self.nodes[0], self.nodes[Self::INTERVALS]);
        if x <= Self::FIRST {
            // ∫ of end − fall ln(D/D₀).
            let (end, fall) = (piece(RAREFIED, RAREFIED_END).0, std::f64::consts::PI.sqrt().recip());
            let ratio = x / Self::FIRST;
            let whole = |ratio: f64| Self::FIRST * ratio * (end - fall * (ratio.ln() - 1.0));
            first.0 + whole(ratio) - whole(1.0)
        } else if x >= Self::LAST {
            let [a, b, c, d] = CONTINUUM;
            let whole = |x: f64| x * (0.5 * a * x + b) + c * x.ln() - d / x;
            last.0 + whole(x) - whole(Self::LAST)
        } else {
            let place = (x / Self::FIRST).ln() / Self::step();
            let left = (place as usize).min(Self::INTERVALS - 1);
            let t = place - left as f64;
            let ((a, slope_a), (b, slope_b)) = (self.nodes[left], self.nodes[left + 1]);
            let (rise, start, end) = (b - a, slope_a * Self::step(), slope_b * Self::step());
            a + t * (start + t * (3.0 * rise - 2.0 * start - end + t * (start + end - 2.0 * rise)))
        }
    }
}

static FLOW_POTENTIAL: LazyLock<FlowPotential> = LazyLock::new(FlowPotential::new);

impl FukuiKaneko {
    /// D of a trapped height `z` \[m\].
    fn inverse_knudsen(self, z: f64) -> f64 {
        0.5 * std::f64::consts::PI.sqrt() * z / self.mean_free_path
    }
}

impl Mobility for FukuiKaneko {
    fn at(self, z: f64) -> (f64, f64) {
        let x = self.inverse_knudsen(z);
        let (flow, slope) = flow_rate(x);
        // ψ = Z·6 Q_P/D is proportional to Q_P, so dψ/dZ = ψ (D Q_P')/(Q_P Z).
        let psi = 6.0 * flow * z / x;
        (psi, psi * slope / (flow * z))
    }

    fn potential(self, z: f64) -> f64 {
        // ψ = 6 (2λ_a/√π) Q_P(D), and dZ = (2λ_a/√π) dD.
        let unit = 2.0 * self.mean_free_path / std::f64::consts::PI.sqrt();
        6.0 * unit * unit * FLOW_POTENTIAL.at(z / unit)
    }
}

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

/// A slip law chosen at run time.
#[derive(Clone, Copy, Debug)]
pub enum SlipLaw {
    /// No slip or first order.
    Affine(Affine),
    /// Second order.
    SecondOrder(SecondOrder),
    /// Linearised Boltzmann.
    FukuiKaneko(FukuiKaneko),
    /// Linearised Boltzmann, walls that are not wholly diffuse.
    Accommodated(Accommodated),
}

impl SlipLaw {
    /// The law of a gas. Without a mean free path every law is the continuum's.
    pub fn of(gas: &Gas) -> Self {
        let mean_free_path = gas.mean_free_path;
        match gas.slip {
            Slip::FirstOrder => Self::Affine(Affine { offset: 6.0 * mean_free_path }),
            Slip::SecondOrder if mean_free_path > 0.0 => Self::SecondOrder(SecondOrder { mean_free_path }),
            Slip::FukuiKaneko if mean_free_path > 0.0 && gas.accommodation < 1.0 => {
                Self::Accommodated(Accommodated::new(mean_free_path, gas.accommodation))
            }
            Slip::FukuiKaneko if mean_free_path > 0.0 => Self::FukuiKaneko(FukuiKaneko { mean_free_path }),
            _ => Self::Affine(Affine { offset: 0.0 }),
        }
    }
}

impl Mobility for SlipLaw {
    fn at(self, z: f64) -> (f64, f64) {
        match self {
            Self::Affine(law) => law.at(z),
            Self::SecondOrder(law) => law.at(z),
            Self::FukuiKaneko(law) => law.at(z),
            Self::Accommodated(law) => law.at(z),
        }
    }

    fn potential(self, z: f64) -> f64 {
        match self {
            Self::Affine(law) => law.potential(z),
            Self::SecondOrder(law) => law.potential(z),
            Self::FukuiKaneko(law) => law.potential(z),
            Self::Accommodated(law) => law.potential(z),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_potential_is_the_integral_of_the_mobility() {
        let range: [f64; 2] = [1e-10, 3e-5];
        for law in laws() {
            let exact = |z: f64| {
                let parts = 200;
                let (from, to) = (range[0].ln(), z.ln());
                let at = |i: usize| from + (to - from) * i as f64 / parts as f64;
                (0..parts).map(|i| gauss_legendre(at(i), at(i + 1), |s| s.exp() * law.at(s.exp()).0)).sum::<f64>()
            };
            for z in [2e-10_f64, 2e-8, 1e-7, 7.7e-7, 2.9e-5] {
                let found = law.potential(z) - law.potential(range[0]);
                assert!((found / exact(z) - 1.0).abs() < 1e-6, "{law:?} {z}: {found} {}", exact(z));
            }
        }
    }

    fn laws() -> Vec<SlipLaw> {
        let mean_free_path = 64e-9;
        [
            SlipLaw::Affine(Affine { offset: 0.0 }),
            SlipLaw::Affine(Affine { offset: 6.0 * mean_free_path }),
            SlipLaw::SecondOrder(SecondOrder { mean_free_path }),
            SlipLaw::FukuiKaneko(FukuiKaneko { mean_free_path }),
        ]
        .into_iter()
        .chain([0.99, 0.7, 0.3].map(|share| SlipLaw::Accommodated(Accommodated::new(mean_free_path, share))))
        .collect()
    }

    #[test]
    fn slopes_are_derivatives_and_keep_the_m_matrix() {
        for law in laws() {
            for i in 0..2000 {
                let z = 1e-12 * 10f64.powf(i as f64 * 0.004);
                let (psi, slope) = law.at(z);
                let step = 1e-6 * z;
                let difference = (law.at(z + step).0 - law.at(z - step).0) / (2.0 * step);
                assert!(psi > 0.0);
                assert!((slope - difference).abs() < 1e-4 * (psi / z), "{law:?} {z}: {slope} {difference}");
                assert!(slope.abs() * z <= psi * (1.0 + 1e-12), "{law:?} {z}: {}", slope * z / psi);
            }
        }
    }

    #[test]
    fn laws_agree_as_the_knudsen_number_falls() {
        for law in laws() {
            let z = 64e-9 * 1e4;
            // Slip grows as 2/α − 1 with the accommodation coefficient α, the least of which is 0.3.
            let most = if matches!(law, SlipLaw::Accommodated(_)) { 2.0 / 0.3 - 1.0 } else { 1.0 };
            assert!((law.at(z).0 / z - 1.0).abs() < 8e-4 * most);
        }
    }
}
