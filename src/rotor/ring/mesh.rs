//! The mesh of a section: quadratic quadrilaterals on a tensor grid, dense at the contact and at corners.

use super::section::{Band, RingError, Section};

/// Nodes of an element: its corners anticlockwise from the one at the least r and z, the middles of its sides likewise (the first is
/// that of the lower side), its middle.
pub const NODES: usize = 9;

/// A mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// (r, z) of each node \[m\].
    pub nodes: Vec<[f64; 2]>,
    /// The elements.
    pub elements: Vec<Element>,
    /// For each node, whether a support holds it along r, θ and z.
    pub held: Vec<[bool; 3]>,
}

/// One element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Element {
    /// Its nodes.
    pub nodes: [usize; NODES],
    /// Which part of the section it belongs to.
    pub part: usize,
}

impl Section {
    /// The mesh on which the ring is solved with a contact `band`.
    ///
    /// # Errors
    /// [`RingError`] if the band is not within the lowest face or the mesh would be too large.
    pub fn mesh(&self, band: Band) -> Result<Mesh, RingError> {
        let _ = band;
        Err(RingError::NoPart)
    }
}
