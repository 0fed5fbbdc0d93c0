//! Nodes of the film on one tooth or plate: a tensor grid with nodes on the edges, graded towards ambient edges.

use crate::numerics::grading;

/// What lies beyond the first node along an axis. Beyond the last there is always ambient gas.
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
    /// Length each node stands for \[m\].
    pub lengths: Vec<f64>,
    /// What lies before the first node.
    pub start: Start,
}

impl Axis {
    /// An axis of `intervals` over half-length `half` \[m\], whose intervals at an ambient edge are `edge_spacing` \[m\]
    /// (or uniform, if that is smaller).
    pub fn graded(half: f64, start: Start, intervals: usize, edge_spacing: f64) -> Self {
        let length = if start == Start::Mirror { half } else { 2.0 * half };
        Self::clustered(half, start, intervals, grading::clustering(edge_spacing * intervals as f64 / length))
    }

    /// An axis with a given clustering parameter β (`numerics::grading`).
    pub fn clustered(half: f64, start: Start, intervals: usize, beta: f64) -> Self {
        let nodes = match start {
            Start::Ambient => grading::two_sided(half, intervals, beta),
            Start::Mirror => grading::one_sided(half, intervals, beta),
        };
        let lengths = grading::node_lengths(&nodes);
        Self { nodes, lengths, start }
    }

    /// The single node of an infinitely wide film, standing for one metre.
    pub fn unit() -> Self {
        Self::single(1.0)
    }

    /// The single node of a film that does not flow along this axis, standing for all of its `length` \[m\].
    pub fn single(length: f64) -> Self {
        Self { nodes: vec![0.0], lengths: vec![length], start: Start::Mirror }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are no nodes: never.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Nodes whose pressure is unknown.
    pub fn unknown(&self) -> std::ops::Range<usize> {
        if self.len() == 1 {
            return 0..1;
        }
        usize::from(self.start == Start::Ambient)..self.len() - 1
    }

    /// How many times the solved part makes the whole.
    pub fn copies(&self) -> f64 {
        if self.start == Start::Mirror && self.len() > 1 { 2.0 } else { 1.0 }
    }
}

/// The film's nodes. Field values are stored `[ix][iy]`, y fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmGrid {
    /// Along the ring.
    pub x: Axis,
    /// Across, radially. One node: an infinitely wide strip.
    pub y: Axis,
}

impl FilmGrid {
    /// Nodes in all.
    pub fn len(&self) -> usize {
        self.x.len() * self.y.len()
    }

    /// Whether there are no nodes: never.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Nodes with unknown pressure.
    pub fn unknowns(&self) -> usize {
        self.x.unknown().len() * self.y.unknown().len()
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
