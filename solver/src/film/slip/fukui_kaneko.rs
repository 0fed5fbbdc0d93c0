//! The linearised Boltzmann equation between walls that reflect diffusely (Fukui and Kaneko 1990).

use super::mobility::Mobility;
use crate::numerics::gauss_legendre;
use std::sync::LazyLock;

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
pub(super) fn flow_rate(x: f64) -> (f64, f64) {
    if x > 1.0 {
        blend(piece(TRANSITION, x), piece(CONTINUUM, x), x, 5.0)
    } else if x >= RAREFIED_END {
        blend(piece(RAREFIED, x), piece(TRANSITION, x), x, 0.15)
    } else {
        let fall = std::f64::consts::PI.sqrt().recip();
        (piece(RAREFIED, RAREFIED_END).0 - fall * (x / RAREFIED_END).ln(), -fall)
    }
}

/// Inverse Knudsen number D below which the fit does not hold.
const RAREFIED_END: f64 = 0.01;
/// The corresponding Knudsen number, √π/(2D).
pub(super) const FIT_ENDS: f64 = 88.622_692_545_275_8;

/// D up to which F(D) = ∫ Q_P dD is tabulated, and the number of intervals of the table, uniform in ln D.
const LAST: f64 = 10.0;
const INTERVALS: usize = 800;

fn step() -> f64 {
    (LAST / RAREFIED_END).ln() / INTERVALS as f64
}

/// F, up to a constant, and dF/d ln D at the nodes of the table.
static NODES: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let slope = |s: f64| s.exp() * flow_rate(s.exp()).0;
    let mut sum = 0.0;
    let mut nodes = Vec::with_capacity(INTERVALS + 1);
    for i in 0..=INTERVALS {
        let here = RAREFIED_END.ln() + i as f64 * step();
        nodes.push((sum, slope(here)));
        sum += gauss_legendre(here, here + step(), slope);
    }
    nodes
});

/// F(D): cubic in ln D between nodes, and in closed form beyond either end of the table.
fn flow_potential(x: f64) -> f64 {
    let (first, last) = (NODES[0], NODES[INTERVALS]);
    if x <= RAREFIED_END {
        // The integral of end − fall ln(D/D₀).
        let (end, fall) = (piece(RAREFIED, RAREFIED_END).0, std::f64::consts::PI.sqrt().recip());
        let ratio = x / RAREFIED_END;
        let whole = |ratio: f64| RAREFIED_END * ratio * (end - fall * (ratio.ln() - 1.0));
        first.0 + whole(ratio) - whole(1.0)
    } else if x >= LAST {
        let [a, b, c, d] = CONTINUUM;
        let whole = |x: f64| x * (0.5 * a * x + b) + c * x.ln() - d / x;
        last.0 + whole(x) - whole(LAST)
    } else {
        let place = (x / RAREFIED_END).ln() / step();
        let left = (place as usize).min(INTERVALS - 1);
        let t = place - left as f64;
        let ((a, slope_a), (b, slope_b)) = (NODES[left], NODES[left + 1]);
        let (rise, start, end) = (b - a, slope_a * step(), slope_b * step());
        a + t * (start + t * (3.0 * rise - 2.0 * start - end + t * (start + end - 2.0 * rise)))
    }
}

impl FukuiKaneko {
    /// D of a trapped height `z` \[m\].
    pub(super) fn inverse_knudsen(self, z: f64) -> f64 {
        0.5 * std::f64::consts::PI.sqrt() * z / self.mean_free_path
    }
}

impl Mobility for FukuiKaneko {
    fn knudsen_limit(&self) -> f64 {
        FIT_ENDS
    }

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
        6.0 * unit * unit * flow_potential(z / unit)
    }
}
