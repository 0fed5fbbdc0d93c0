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

mod asperities;
mod exponential;
pub mod flow;
mod gaussian;
mod greenwood_tripp;
mod greenwood_williamson;
pub mod height_map;
mod law;
pub mod texture;

pub use asperities::Asperities;
pub use law::{Heights, Law, Order, Summits};

/// All contact laws that a scene can name.
pub static LAWS: &[&Law] = &[&greenwood_williamson::LAW, &greenwood_tripp::LAW];

/// All distributions of the heights of summits.
pub static HEIGHTS: &[&Heights] = &[&gaussian::HEIGHTS, &exponential::HEIGHTS];

/// How the faces of a motor meet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surface {
    /// The asperities that they meet on; `None`: a hard stop at a minimum spacing.
    pub asperities: Option<Asperities>,
    /// How their roughness changes the flow of the gas; `None`: not at all.
    pub flow: Option<flow::Roughness>,
}

impl Surface {
    /// The law with this name.
    pub fn law(name: &str) -> Option<&'static Law> {
        LAWS.iter().copied().find(|law| law.name == name)
    }

    /// The distribution with this name.
    pub fn heights(name: &str) -> Option<&'static Heights> {
        HEIGHTS.iter().copied().find(|heights| heights.name == name)
    }
}

#[cfg(test)]
mod tests;
