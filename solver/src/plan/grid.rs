//! Grids of a plan: how many nodes, and how they cluster.

use crate::fidelity::GRIDS;
use crate::numerics::grading::{clustering, map};
use crate::numerics::system::MANY_COLUMNS;
use serde::{Deserialize, Serialize};

/// One grid of a motor or a plate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Intervals along a tooth (of a plate: along half its length).
    pub along: usize,
    /// Across half the width: intervals of finite volumes, or unknown nodes of a polynomial.
    pub across: usize,
    /// Time steps in a cycle.
    pub steps: usize,
    /// Rotor harmonics are kept until they fall below this fraction of the local compliance: four times as large on a
    /// grid of twice the spacing, so that what the cut changes is extrapolated, and estimated, with the rest.
    pub harmonic_fraction: f64,
}

impl Grid {
    /// Work of one cycle, in multiplications of the elimination, whose blocks are full across the width unless they have many nodes.
    pub fn work(&self) -> f64 {
        (self.along * self.across.max(1) * self.across.clamp(1, MANY_COLUMNS) * self.steps) as f64
    }

    /// A grid of half the spacing. The number of nodes of a polynomial across does not change.
    pub fn finer(&self, spectral: bool) -> Self {
        Self {
            along: 2 * self.along,
            across: if spectral { self.across } else { 2 * self.across },
            steps: 2 * self.steps,
            harmonic_fraction: 0.25 * self.harmonic_fraction,
        }
    }
}

/// Edge intervals are not made smaller than this fraction of a uniform grid's.
const SMALLEST_RATIO: f64 = 1e-5;

/// `count` rounded up so that it can be halved for the coarser grids.
pub(super) fn round_up(count: usize) -> usize {
    count.max(1).next_multiple_of(1 << (GRIDS - 1))
}

/// The grids from the coarsest to `finest`. The nodes of a polynomial across are the same on all of them.
pub(super) fn nested(finest: Grid, spectral: bool) -> Vec<Grid> {
    (0..GRIDS)
        .rev()
        .map(|halved| Grid {
            along: finest.along >> halved,
            across: if spectral { finest.across } else { finest.across >> halved },
            steps: finest.steps >> halved,
            harmonic_fraction: finest.harmonic_fraction * (1 << (2 * halved)) as f64,
        })
        .collect()
}

/// Clustering of spectral nodes for a boundary layer of `layer` times the half width: the edge's interval of a polynomial with three
/// nodes, 0.17 of the half width without clustering, is at most 1.5 layers.
pub(super) fn spectral_clustering(layer: f64) -> f64 {
    const OUTERMOST: f64 = 0.830_223_896_278_567;
    let interval = |beta: f64| 1.0 - map(beta, OUTERMOST);
    let asked = 1.5 * layer;
    let (mut low, mut high) = (0.0, 20.0);
    if interval(low) <= asked {
        return 0.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if interval(middle) > asked { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Intervals over `length` and their clustering, so that the first is `edge` \[m\]. A thin layer gets more of them: the map
/// stretches its interior by about ln(1/ratio)/2.
pub(super) fn graded(base: usize, asked: Option<usize>, length: f64, edge: f64) -> (usize, f64) {
    let ratio = |intervals: usize| (edge * intervals as f64 / length).max(SMALLEST_RATIO);
    let intervals = match asked {
        Some(asked) => round_up(asked),
        None => round_up((base as f64 * (1.0 + 0.15 * (1.0 / ratio(base)).ln().max(0.0))) as usize),
    };
    (intervals, clustering(ratio(intervals)))
}
