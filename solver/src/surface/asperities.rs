//! Asperities that meet: pressure and mean gap over the separation of the mean planes.

use super::gaussian::mean_excess;
use super::law::{DEEPEST, Heights, Law, Summits};

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
            return (rms * mean_excess(0.0).0, 0.0);
        }
        let (excess, slope) = mean_excess(u);
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
