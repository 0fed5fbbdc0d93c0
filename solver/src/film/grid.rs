//! Nodes of the film on one tooth or plate: a tensor grid with nodes on the edges, graded towards ambient edges.

use crate::numerics::system::Across;
use crate::numerics::{grading, legendre};
use std::f64::consts::PI;
use std::ops::Range;

/// Boundary at the first node of an axis. The last node is always at ambient pressure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// An edge at ambient pressure: the interval is the whole length, from −half to half.
    Ambient,
    /// A line of mirror symmetry: the interval is half the length, from 0 to half.
    Mirror,
}

/// Nodes along one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Node positions \[m\] from the middle, ascending; the last is an ambient edge.
    pub nodes: Vec<f64>,
    /// Length that each node stands for \[m\]; on a radial axis, area \[m²\].
    pub lengths: Vec<f64>,
    /// Boundary at the first node.
    pub start: Start,
    /// Derivative matrix of a spectral axis: slope at every node from the values at every node \[1/m\], `[node][value]`; empty for finite
    /// volumes.
    slopes: Vec<f64>,
    /// Whether the axis runs along the radius of a round film; each node then stands for the whole circumference.
    pub radial: bool,
}

impl Axis {
    /// An axis of `intervals` over half-length `half` \[m\], clustered by β (`numerics::grading`; 0 is uniform).
    pub fn clustered(half: f64, start: Start, intervals: usize, beta: f64) -> Self {
        let nodes = match start {
            Start::Ambient => grading::two_sided(half, intervals, beta),
            Start::Mirror => grading::one_sided(half, intervals, beta),
        };
        let lengths = grading::node_lengths(&nodes);
        Self { nodes, lengths, start, slopes: Vec::new(), radial: false }
    }

    /// The radius of a round film from `inner` to `outer` \[m\], clustered by β at its ambient edges. If `inner` is 0, the axis of
    /// symmetry, the outer edge is the only one.
    pub fn radial(inner: f64, outer: f64, intervals: usize, beta: f64) -> Self {
        let (start, nodes) = if inner > 0.0 {
            let (middle, half) = (0.5 * (outer + inner), 0.5 * (outer - inner));
            let nodes = grading::two_sided(half, intervals, beta);
            (Start::Ambient, nodes.into_iter().map(|node| middle + node).collect())
        } else {
            (Start::Mirror, grading::one_sided(outer, intervals, beta))
        };
        let face = |after: usize| 0.5 * (nodes[after] + nodes[after + 1]);
        let ring = |i: usize| {
            let from = if i > 0 { face(i - 1) } else { nodes[i] };
            let to = if i + 1 < nodes.len() { face(i) } else { nodes[i] };
            PI * (to - from) * (to + from)
        };
        Self { lengths: (0..nodes.len()).map(ring).collect(), nodes, start, slopes: Vec::new(), radial: true }
    }

    /// Width of the face after node `face`, in the unit of the lengths: 1, or the circumference \[m\].
    pub fn face(&self, face: usize) -> f64 {
        if self.radial { PI * (self.nodes[face] + self.nodes[face + 1]) } else { 1.0 }
    }

    /// An axis on which a field is one polynomial: `count` Gauss–Lobatto–Legendre nodes over half-length `half` \[m\], not counting the
    /// edge, further clustered by β. Over a whole length there are as many again on the other side.
    pub fn spectral(half: f64, start: Start, count: usize, beta: f64) -> Self {
        let (positions, weights) = legendre::lobatto(2 * count);
        let derivative = legendre::derivative(&positions);
        let all = positions.len();
        let stretch: Vec<f64> = positions.iter().map(|eta| half * grading::slope(beta, *eta)).collect();
        // In a mirrored field the node at −y has the same value as the node at y.
        let first = if start == Start::Mirror { count } else { 0 };
        let entry = |node: usize, value: usize| {
            let own = derivative[node * all + value];
            let twin = all - 1 - value;
            let both = if first > 0 && twin != value { own + derivative[node * all + twin] } else { own };
            both / stretch[node]
        };
        let share = |node: usize| if first > 0 && node == first { 0.5 } else { 1.0 };
        Self {
            nodes: positions[first..].iter().map(|eta| half * grading::map(beta, *eta)).collect(),
            lengths: (first..all).map(|node| share(node) * weights[node] * stretch[node]).collect(),
            start,
            slopes: (first..all)
                .flat_map(|node| (first..all).map(move |value| (node, value)))
                .map(|(n, v)| entry(n, v))
                .collect(),
            radial: false,
        }
    }

    /// The single node of a film that does not flow along this axis. It stands for all of its `length` \[m\], or for one metre of an
    /// infinitely wide film.
    pub fn single(length: f64) -> Self {
        Self { nodes: vec![0.0], lengths: vec![length], start: Start::Mirror, slopes: Vec::new(), radial: false }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are no nodes: never.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The range of nodes whose pressure is unknown.
    pub fn unknown(&self) -> Range<usize> {
        if self.len() == 1 {
            return 0..1;
        }
        usize::from(self.start == Start::Ambient)..self.len() - 1
    }

    /// −∂²/∂y² \[1/m²\] between the unknown nodes, for a field that vanishes on the edges: `[node][value]`. Finite volumes give an M-matrix
    /// of second order; a spectral axis gives the weak form of the same operator, ∫ f′v′ = Σ lengths × f′v′.
    pub fn diffusion(&self) -> Vec<f64> {
        let (unknown, count) = (self.unknown(), self.len());
        let mut matrix = Vec::with_capacity(unknown.len().pow(2));
        for i in unknown.clone() {
            for j in unknown.clone() {
                let stiffness = if !self.slopes.is_empty() {
                    let term = |node: usize| {
                        self.lengths[node] * self.slopes[node * count + i] * self.slopes[node * count + j]
                    };
                    (0..count).map(term).sum()
                } else {
                    let face = |low: usize| 1.0 / (self.nodes[low + 1] - self.nodes[low]);
                    if i == j {
                        (if i > 0 { face(i - 1) } else { 0.0 }) + if i + 1 < count { face(i) } else { 0.0 }
                    } else if i.abs_diff(j) == 1 {
                        -face(i.min(j))
                    } else {
                        0.0
                    }
                };
                matrix.push(stiffness / self.lengths[i]);
            }
        }
        matrix
    }

    /// Number of copies of the solved part that make up the whole.
    pub fn copies(&self) -> f64 {
        if self.start == Start::Mirror && self.len() > 1 && !self.radial { 2.0 } else { 1.0 }
    }
}

/// The film's nodes. Field values are stored `[ix][iy]`, y fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmGrid {
    /// Along the ring, or along the plate; of a round plate its radius.
    pub x: Axis,
    /// Across the width. One node: an infinitely wide strip, a round plate, or a film that does not flow this way.
    pub y: Axis,
}

impl FilmGrid {
    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.x.len() * self.y.len()
    }

    /// Number of nodes with unknown pressure.
    pub fn unknowns(&self) -> usize {
        self.x.unknown().len() * self.y.unknown().len()
    }

    /// −∂²/∂y² between the unknown nodes of one x \[1/m²\] ([`Axis::diffusion`]).
    pub fn across(&self) -> Across {
        Across::new(self.y.unknown().len(), &self.y.diffusion())
    }

    /// Each node along x with unknown pressure, and the range of the unknown nodes across it in a field of all nodes.
    pub fn rows(&self) -> impl Iterator<Item = (usize, Range<usize>)> {
        let (across, ny) = (self.y.unknown(), self.y.len());
        self.x.unknown().map(move |ix| (ix, ix * ny + across.start..ix * ny + across.end))
    }

    /// Width \[m\] that the unknown nodes of one x stand for, both halves; the edge's own half interval, always at
    /// ambient pressure, is not part of it.
    pub fn interior_width(&self) -> f64 {
        self.y.copies() * self.y.unknown().map(|j| self.y.lengths[j]).sum::<f64>()
    }

    /// Sum over y of `field` at the unknown nodes × width \[field × m\], for each node along x; both halves.
    /// `field` holds unknown nodes only; x nodes on an ambient edge get 0.
    pub fn line_integral(&self, field: &[f64], out: &mut [f64]) {
        let (ux, uy) = (self.x.unknown(), self.y.unknown());
        out.fill(0.0);
        let widths = &self.y.lengths[uy.clone()];
        for (column, ix) in field.chunks_exact(uy.len()).zip(ux) {
            out[ix] = self.y.copies() * column.iter().zip(widths).map(|(f, w)| f * w).sum::<f64>();
        }
    }
}

/// A position between two nodes of another grid.
#[derive(Clone, Copy, Debug)]
pub struct Between {
    /// The node before it.
    pub low: usize,
    fraction: f64,
}

impl Between {
    /// The position of node `i` of `fine` intervals on a grid of `coarse` intervals.
    pub fn of(i: usize, fine: usize, coarse: usize) -> Self {
        let (low, rest) = (i * coarse / fine, i * coarse % fine);
        Self { low, fraction: rest as f64 / fine as f64 }
    }

    /// The position among `nodes` at the fraction `place` of the coordinate of the last one.
    pub fn at(place: f64, nodes: &[f64]) -> Self {
        let place = place * nodes[nodes.len() - 1];
        let high = nodes.partition_point(|node| *node <= place).min(nodes.len() - 1);
        let low = high.saturating_sub(1);
        let fraction = if high > low { (place - nodes[low]) / (nodes[high] - nodes[low]) } else { 0.0 };
        Self { low, fraction: if fraction.is_finite() { fraction.clamp(0.0, 1.0) } else { 0.0 } }
    }

    /// The value there, by interpolation that is cubic in the index of `nodes` nodes (quadratic next to an end), limited to the range of
    /// the two neighbouring values.
    pub fn curve(&self, nodes: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (t, low) = (self.fraction, value(self.low));
        if t == 0.0 {
            return low;
        }
        let high = value(self.low + 1);
        let before = (self.low > 0).then(|| value(self.low - 1) - 2.0 * low + high);
        let after = (self.low + 2 < nodes).then(|| low - 2.0 * high + value(self.low + 2));
        let bend = match (before, after) {
            (Some(before), Some(after)) => ((2.0 - t) * before + (1.0 + t) * after) / 3.0,
            (before, after) => before.or(after).unwrap_or(0.0),
        };
        (low + t * (high - low) - 0.5 * t * (1.0 - t) * bend).clamp(low.min(high), low.max(high))
    }

    /// The node after it, or the one it is on.
    pub fn high(&self) -> usize {
        if self.fraction > 0.0 { self.low + 1 } else { self.low }
    }

    /// The value there, interpolated linearly from those of the two nodes.
    pub fn mix(&self, low: f64, high: f64) -> f64 {
        if self.fraction > 0.0 { low + self.fraction * (high - low) } else { low }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spectral_axis_is_exact_for_polynomials_and_finite_volumes_for_a_parabola() {
        let half = 0.3;
        for start in [Start::Mirror, Start::Ambient] {
            let spectral = Axis::spectral(half, start, 4, 0.0);
            let volumes = Axis::clustered(half, start, if start == Start::Mirror { 4 } else { 8 }, 0.0);
            for (axis, power, within) in [(&spectral, 2, 1e-11), (&spectral, 4, 1e-11), (&volumes, 2, 1e-12)] {
                let field = |y: f64| 1.0 - (y / half).powi(power);
                let exact = |y: f64| f64::from(power * (power - 1)) * (y / half).powi(power - 2) / (half * half);
                let unknown = axis.unknown();
                let values: Vec<f64> = unknown.clone().map(|i| field(axis.nodes[i])).collect();
                for (row, i) in axis.diffusion().chunks_exact(values.len()).zip(unknown) {
                    let found: f64 = row.iter().zip(&values).map(|(a, v)| a * v).sum();
                    assert!(
                        (found - exact(axis.nodes[i])).abs() < within / (half * half),
                        "{start:?} {power} {i}: {found}"
                    );
                }
            }
            let length: f64 = spectral.lengths.iter().sum::<f64>() * spectral.copies();
            assert!((length - 2.0 * half).abs() < 1e-14);
        }
    }

    #[test]
    fn a_layer_at_the_edge_is_found_spectrally() {
        // f″ = κ²(f − 1), f = 0 on the edges: mean of f is 1 − tanh κ/κ.
        let kappa: f64 = 8.0;
        let error = |count: usize, beta: f64| {
            let axis = Axis::spectral(1.0, Start::Mirror, count, beta);
            let n = axis.unknown().len();
            let matrix = nalgebra::DMatrix::from_row_slice(n, n, &axis.diffusion())
                + nalgebra::DMatrix::identity(n, n) * (kappa * kappa);
            let found = matrix.lu().solve(&nalgebra::DVector::from_element(n, kappa * kappa)).unwrap();
            let mean: f64 = found.iter().zip(&axis.lengths).map(|(f, l)| f * l).sum();
            (mean / (1.0 - kappa.tanh() / kappa) - 1.0).abs()
        };
        assert!(error(4, 0.0) < 1e-3 && error(6, 0.0) < 1e-6, "{} {}", error(4, 0.0), error(6, 0.0));
        assert!(error(8, 1.0) < 1e-6, "{}", error(8, 1.0));
    }
}
