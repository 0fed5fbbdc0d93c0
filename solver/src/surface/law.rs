//! The types of contact laws and of distributions of summit heights.

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
    /// ln Fₙ(u) and its derivative by u, for u ≥ `DEEPEST`.
    pub moment: fn(Order, f64) -> (f64, f64),
}

/// Below this separation over σ every summit is pressed in, and no law holds: the faces meet as a whole, and are as stiff as a layer of the
/// contact modulus σ thick.
pub(super) const DEEPEST: f64 = -4.0;
