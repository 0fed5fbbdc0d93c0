//! Heights of summits by the normal distribution, φ(s) = e^{−s²/2}/√(2π).
//!
//! ln Fₙ is a cubic in u between nodes, by value and slope, F′ₙ = −n Fₙ₋₁; off by 10⁻¹⁰. It is made when it is first asked for.

use super::law::{DEEPEST, Heights, Order};
use crate::numerics::gauss_legendre;
use std::f64::consts::TAU;
use std::sync::LazyLock;

pub(super) static HEIGHTS: Heights = Heights { name: "gaussian", moment };

const STEP: f64 = 1.0 / 64.0;
const LAST: f64 = 38.0;

/// For each [`Order`], ln Fₙ and its slope times `STEP` at the nodes, from [`DEEPEST`] on.
static NODES: [LazyLock<Vec<(f64, f64)>>; 3] =
    [LazyLock::new(|| nodes(2)), LazyLock::new(|| nodes(3)), LazyLock::new(|| nodes(5))];

/// ln Fₙ and its slope. Beyond the last node it falls as steeply as there: to nothing.
fn moment(order: Order, u: f64) -> (f64, f64) {
    let nodes = &NODES[order as usize];
    let place = (u - DEEPEST) / STEP;
    let left = (place.max(0.0) as usize).min(nodes.len() - 2);
    let ((a, start), (b, end)) = (nodes[left], nodes[left + 1]);
    if u > LAST {
        return (b + end * (u - LAST) / STEP, end / STEP);
    }
    let (t, rise) = (place - left as f64, b - a);
    let (square, cube) = (3.0 * rise - 2.0 * start - end, start + end - 2.0 * rise);
    (a + t * (start + t * (square + t * cube)), (start + t * (2.0 * square + 3.0 * t * cube)) / STEP)
}

/// F₁(u) and its derivative, u ≥ 0: what the mean gap exceeds the separation by.
pub(super) fn mean_excess(u: f64) -> (f64, f64) {
    let (log, slope) = moment(Order::One, u);
    let value = log.exp();
    (value, value * slope)
}

/// ∫₀^∞ tⁿ e^{−ut − t²/2} dt, n > −1, given 2n: Fₙ(u) √(2π) e^{u²/2}. With t = x² the integrand is smooth for an odd 2n too.
fn scaled(twice: i32, u: f64) -> f64 {
    const PANELS: usize = 6;
    let furthest = ((u.min(0.0).powi(2) + 80.0 + u.max(0.0).powi(2)).sqrt() - u).sqrt();
    let at = |panel: usize| furthest * panel as f64 / PANELS as f64;
    let integrand = |x: f64| 2.0 * x.powi(twice + 1) * (-(u + 0.5 * x * x) * x * x).exp();
    (0..PANELS).map(|panel| gauss_legendre(at(panel), at(panel + 1), integrand)).sum()
}

/// The nodes of n, given 2n.
fn nodes(twice: i32) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let u = DEEPEST + i as f64 * STEP;
        let whole = scaled(twice, u);
        (whole.ln() - 0.5 * (u * u + TAU.ln()), -0.5 * f64::from(twice) * scaled(twice - 2, u) / whole * STEP)
    };
    (0..=((LAST - DEEPEST) / STEP) as usize).map(node).collect()
}
