//! A node that meets the rotor on asperities.
//!
//! Its separation d solves d = s + C_∞ q(d) with q = w p(d) + p_a ζ/h(d) − B. Every term of q falls with d, so there is one root. With R(d)
//! the part of the equation without the asperities, the equation is C_∞ w p(d) = R(d). Where both sides are positive, Newton's method on
//! their logarithms is fast, because ln p is nearly a parabola or a straight line; elsewhere Newton's method is applied to their
//! difference. Both stay within a bracket.

use crate::surface::Asperities;

/// Asperities at the nodes.
#[derive(Clone, Debug)]
pub(super) struct Rough {
    law: Asperities,
    /// w \[m\].
    width: f64,
    /// Where the search of each node starts: the separation found last \[m\].
    last: Vec<f64>,
}

/// Solution at one node.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoughNode {
    /// q \[N/m\].
    pub(super) force: f64,
    /// −dq/ds \[N/m²\].
    pub(super) stiffness: f64,
    /// h \[m\].
    pub(super) thickness: f64,
    /// c \[N/m\].
    pub(super) contact: f64,
    /// d \[m\].
    pub(super) separation: f64,
}

const ITERATION_LIMIT: usize = 200;
/// Separation over σ beyond which the asperities carry a negligible load.
const OUT_OF_REACH: f64 = 38.0;

impl Rough {
    pub(super) fn new(law: Asperities, width: f64, nodes: usize) -> Self {
        Self { law, width, last: vec![0.0; nodes] }
    }

    /// Line load and its stiffness from [`Rough::node`]; keeps the separation as the start of the node's next search.
    pub(super) fn next(&mut self, i: usize, local: f64, s: f64, gas: f64, ambient: f64) -> (f64, f64) {
        let found = self.node(i, local, s, gas, ambient);
        self.last[i] = found.separation;
        (found.force, found.stiffness)
    }

    /// Node `i`, given s \[m\], the trapped gas p_aζ `gas`, the force B \[N/m\] that is subtracted, `ambient`, and the local compliance C_∞
    /// `local`.
    pub(super) fn node(&self, i: usize, local: f64, s: f64, gas: f64, ambient: f64) -> RoughNode {
        let rms = self.law.summits().rms;
        // The line loads of contact and film, each with its slope, and h.
        let forces = |d: f64| {
            let ((pressure, softer), (h, wider)) = (self.law.pressure(d), self.law.mean_gap(d));
            ([self.width * pressure, self.width * softer], [gas / h - ambient, -gas / (h * h) * wider], h)
        };
        let mut low = s - local * ambient;
        let far = s.max(OUT_OF_REACH * rms);
        let ([contact, _], [film, _], _) = forces(far);
        let mut high = far + local * (contact + film).max(0.0);
        let mut d = self.last[i].clamp(low, high);
        for _ in 0..ITERATION_LIMIT {
            let ([contact, softer], [film, thinner], _) = forces(d);
            let (rest, rises) = (d - s - local * film, 1.0 - local * thinner);
            let pressed = local * contact;
            let missing = rest - pressed;
            if missing < 0.0 {
                low = d
            } else {
                high = d
            }
            let by_difference = -missing / (rises - local * softer);
            let by_logarithm = (pressed / rest).ln() / (rises / rest - softer / contact);
            let step =
                if rest > 0.0 && pressed > 0.0 && by_logarithm.is_finite() { by_logarithm } else { by_difference };
            let mut next = d + step;
            if !(low..=high).contains(&next) {
                next = d + by_difference;
            }
            if !(low..=high).contains(&next) {
                next = 0.5 * (low + high);
            }
            let moved = (next - d).abs();
            d = next;
            if moved <= 2.0 * f64::EPSILON * (d.abs() + s.abs().min(rms)) || missing == 0.0 {
                break;
            }
        }
        let ([contact, softer], [film, thinner], thickness) = forces(d);
        let slope = softer + thinner;
        let stiffness = -slope / (1.0 - local * slope);
        // Where round-off of d changes the force by more than the deflection, the force is computed from the deflection.
        let (force, contact) = if -local * slope > 1.0 {
            let force = (d - s) / local;
            (force, (force - film).max(0.0))
        } else {
            (contact + film, contact)
        };
        RoughNode { force, stiffness, thickness, contact, separation: d }
    }
}
