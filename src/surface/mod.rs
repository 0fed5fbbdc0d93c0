//! Rough faces: what their asperities carry, how much gas stays between them, and how easily it flows.
//!
//! Two faces whose mean planes are d apart, of heights with a combined standard deviation σ, touch at the summits that reach across.
//! The mean pressure of that contact, over the nominal area, is
//!
//! ```text
//! p(d) = K Fₙ(d/σ),      Fₙ(u) = ∫ᵤ^∞ (s − u)ⁿ φ(s) ds
//! ```
//!
//! with φ the distribution of the heights of summits, and K and n those of a contact law. Each law is a file of its own with its line in
//! [`LAWS`], each distribution one with its line in [`HEIGHTS`]. p is positive and convex and falls with d, whatever the law: contact
//! stays a convex problem.

mod exponential;
pub mod flow;
mod gaussian;
mod greenwood_tripp;
mod greenwood_williamson;
pub mod height_map;
pub mod texture;

/// All contact laws that a scene can name.
pub static LAWS: &[&Law] = &[&greenwood_williamson::LAW, &greenwood_tripp::LAW];

/// All distributions of the heights of summits.
pub static HEIGHTS: &[&Heights] = &[&gaussian::HEIGHTS, &exponential::HEIGHTS];

/// The summits of two faces, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summits {
    /// Standard deviation σ of the heights of both faces together, √(σ₁² + σ₂²) \[m\].
    pub rms: f64,
    /// Radius R of a summit \[m\].
    pub radius: f64,
    /// Summits on an area η \[1/m²\].
    pub density: f64,
    /// Contact modulus E*, 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ \[Pa\].
    pub modulus: f64,
}

/// The exponent n of Fₙ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// n = 1: mean gaps.
    One,
    /// n = 3/2: summits against a plane.
    ThreeHalves,
    /// n = 5/2: summits against summits.
    FiveHalves,
}

/// A contact law: p = K Fₙ(d/σ).
#[derive(Debug)]
pub struct Law {
    /// Its name in presets.
    pub name: &'static str,
    /// n.
    pub order: Order,
    /// K \[Pa\].
    pub stiffness: fn(&Summits) -> f64,
}

/// A distribution of the heights of summits about the mean plane, in units of σ.
#[derive(Debug)]
pub struct Heights {
    /// Its name in presets.
    pub name: &'static str,
    /// ln Fₙ(u) and its derivative by u, for u ≥ [`DEEPEST`].
    pub moment: fn(Order, f64) -> (f64, f64),
}

/// Below this separation over σ every summit is pressed in, and no law holds: the faces meet as a whole, and are as stiff as a layer of the
/// contact modulus σ thick.
pub const DEEPEST: f64 = -4.0;

/// Asperity contact of two faces: pressure and mean gap over the separation of the mean planes.
#[derive(Clone, Copy, Debug)]
pub struct Asperities {
    summits: Summits,
    law: &'static Law,
    heights: &'static Heights,
    /// K \[Pa\].
    stiffness: f64,
}

impl PartialEq for Asperities {
    fn eq(&self, other: &Self) -> bool {
        let names = |of: &Self| (of.law.name, of.heights.name);
        self.summits == other.summits && names(self) == names(other)
    }
}

impl Asperities {
    /// Those of `summits` by a law and a distribution of heights.
    pub fn new(summits: Summits, law: &'static Law, heights: &'static Heights) -> Self {
        Self { stiffness: (law.stiffness)(&summits), summits, law, heights }
    }

    /// The summits.
    pub fn summits(&self) -> &Summits {
        &self.summits
    }

    /// Mean contact pressure p \[Pa\] and dp/dd \[Pa/m\] of mean planes `separation` d \[m\] apart.
    pub fn pressure(&self, separation: f64) -> (f64, f64) {
        let u = separation / self.summits.rms;
        let (log, slope) = (self.heights.moment)(self.law.order, u.max(DEEPEST));
        let value = self.stiffness * log.exp();
        let below = (DEEPEST - u).max(0.0);
        let bulk = if below > 0.0 { self.summits.modulus } else { 0.0 };
        (value * (1.0 - slope * below) + bulk * below, (value * slope - bulk) / self.summits.rms)
    }

    /// Mean gap h = ⟨max(d + heights, 0)⟩ \[m\], of Gaussian heights, and dh/dd. Mean planes that have passed each other leave the
    /// gap that they have where they meet, 0.4 σ: what gas the valleys then hold no law tells.
    pub fn mean_gap(&self, separation: f64) -> (f64, f64) {
        let rms = self.summits.rms;
        let u = separation / rms;
        if u < 0.0 {
            return (rms * gaussian::mean_excess(0.0).0, 0.0);
        }
        let (excess, slope) = gaussian::mean_excess(u);
        (rms * (u + excess), 1.0 + slope)
    }

    /// The least mean gap \[m\].
    pub fn least_gap(&self) -> f64 {
        self.mean_gap(0.0).0
    }

    /// Separation of the mean planes \[m\], 0 or more, at a mean gap \[m\].
    pub fn separation(&self, mean_gap: f64) -> f64 {
        if mean_gap <= self.least_gap() {
            return 0.0;
        }
        // h is convex and above d: from d = h on, Newton's method falls to the answer.
        let mut separation = mean_gap;
        for _ in 0..60 {
            let (gap, slope) = self.mean_gap(separation);
            let step = (gap - mean_gap) / slope;
            separation = (separation - step).max(0.0);
            if step.abs() <= 1e-14 * mean_gap {
                break;
            }
        }
        separation
    }

    /// Separation \[m\] at which the asperities carry `pressure` \[Pa\].
    pub fn separation_under(&self, pressure: f64) -> f64 {
        let rms = self.summits.rms;
        let (mut low, mut high) = (DEEPEST, 40.0);
        let deepest = self.pressure(DEEPEST * rms).0;
        if pressure >= deepest {
            return DEEPEST * rms + (pressure - deepest) / self.pressure((DEEPEST - 1.0) * rms).1;
        }
        while high - low > 1e-14 * high.abs().max(1.0) {
            let middle = 0.5 * (low + high);
            if middle == low || middle == high {
                break;
            }
            if self.pressure(middle * rms).0 > pressure { low = middle } else { high = middle }
        }
        0.5 * (low + high) * rms
    }
}

/// How the faces of a motor meet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surface {
    /// The asperities that they meet on; `None`: a hard stop at a minimum spacing.
    pub asperities: Option<Asperities>,
    /// How their roughness changes the flow of the gas; `None`: not at all.
    pub flow: Option<flow::Roughness>,
}

impl Surface {
    /// The law of a name.
    pub fn law(name: &str) -> Option<&'static Law> {
        LAWS.iter().copied().find(|law| law.name == name)
    }

    /// The distribution of a name.
    pub fn heights(name: &str) -> Option<&'static Heights> {
        HEIGHTS.iter().copied().find(|heights| heights.name == name)
    }
}

#[cfg(test)]
mod tests;
