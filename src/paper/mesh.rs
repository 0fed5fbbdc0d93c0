//! The two meshes, contact along the wavelength and film on each tooth, and the linear interpolation between them.
//!
//! Contact nodes are spaced λ/N round one wavelength (N spacings: the paper's 181 nodes count both ends, N = 180), and
//! node 0 is at the middle of tooth 0. A node is on a tooth top when it is within b/2 of the tooth's middle, give or
//! take 1 % of a spacing. Film nodes are uniform over each tooth, both edges counted.
//!
//! * film → contact: the line load is interpolated at the node and multiplied by the spacing. A node on the edge, where
//!   p = p_a, gets nothing.
//! * contact → film: the gap is interpolated at the film node. Where a tooth edge is not a contact node, the first node
//!   beyond it, over the groove, takes part with the gap that the tooth's profile would have there were it continued,
//!   but never less than zero; that node carries no force and cannot touch.
//!
//! A tooth's *entries* are the nodes of its interpolation, ascending; entries of tooth k are
//! `first[k]..first[k + 1]` of the flat arrays.

use crate::problem::Motor;

/// How far beyond the tooth edge a node may be and still be on the tooth, in spacings.
const EDGE_TOLERANCE: f64 = 0.01;

/// Linear interpolation: `values[at] * (1 − weight) + values[at + 1] * weight`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between {
    pub(super) at: usize,
    pub(super) weight: f64,
}

impl Between {
    /// Position `s` on nodes 0, 1, …, `last`; beyond the ends, the end value.
    pub(super) fn uniform(s: f64, last: usize) -> Self {
        let s = s.clamp(0.0, last as f64);
        let at = (s.floor() as usize).min(last.saturating_sub(1));
        Self { at, weight: s - at as f64 }
    }

    pub(super) fn of(self, values: &[f64]) -> f64 {
        values[self.at] * (1.0 - self.weight) + values[self.at + 1] * self.weight
    }
}

/// One contact node in the interpolation of one tooth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// Contact node, 0..N.
    pub(super) node: usize,
    /// Distance from the tooth's middle \[m\].
    pub(super) xi: f64,
    /// Distance from the middle of tooth 0 \[m\].
    pub(super) x: f64,
    /// Whether the node is on the tooth, not over the groove beside it.
    pub(super) on_tooth: bool,
    /// Where the node is on the film mesh of its tooth.
    pub(super) on_film: Between,
}

/// A contact node that can touch and carry load.
#[derive(Clone, Copy, Debug)]
pub(super) struct Top {
    /// Contact node, 0..N.
    pub(super) node: usize,
    /// Its tooth. A node shared by two adjoining teeth belongs to the first.
    pub(super) tooth: usize,
    /// Its entry.
    pub(super) entry: usize,
}

/// Both meshes and the maps between them.
#[derive(Clone, Debug)]
pub(super) struct Meshes {
    /// Contact spacings in a wavelength, N.
    pub(super) n: usize,
    /// Contact spacing λ/N \[m\].
    pub(super) spacing: f64,
    /// Where each tooth's entries begin; `teeth + 1`.
    pub(super) first: Vec<usize>,
    /// Entries, tooth by tooth.
    pub(super) entries: Vec<Entry>,
    /// Nodes that can touch, each once.
    pub(super) tops: Vec<Top>,
    /// Per tooth and film node, position among the tooth's entries; `[tooth][ix]`.
    pub(super) to_film: Vec<Between>,
    /// Every tooth has the same `xi` at its entries.
    pub(super) alike: bool,
}

impl Meshes {
    pub(super) fn new(motor: &Motor, n: usize, nx: usize) -> Self {
        let spacing = motor.wavelength() / n as f64;
        let half = 0.5 * motor.tooth_width / spacing;
        let mut meshes = Self {
            n,
            spacing,
            first: vec![0],
            entries: Vec::new(),
            tops: Vec::new(),
            to_film: Vec::new(),
            alike: true,
        };
        let mut taken = vec![false; n];
        for tooth in 0..motor.teeth {
            // In spacings from node 0.
            let middle = (tooth * n) as f64 / motor.teeth as f64;
            let (left, right) = (middle - half, middle + half);
            let mut low = (left - EDGE_TOLERANCE).ceil() as i64;
            let mut high = (right + EDGE_TOLERANCE).floor() as i64;
            if low as f64 > left + EDGE_TOLERANCE || low >= high {
                low -= 1;
            }
            if (high as f64) < right - EDGE_TOLERANCE || low >= high {
                high += 1;
            }
            for node in low..=high {
                let at = node as f64;
                let on_tooth = at >= left - EDGE_TOLERANCE && at <= right + EDGE_TOLERANCE;
                let film_position = (at - left) / (2.0 * half) * (nx - 1) as f64;
                let entry = Entry {
                    node: node.rem_euclid(n as i64) as usize,
                    xi: (at - middle) * spacing,
                    x: at * spacing,
                    on_tooth,
                    on_film: Between::uniform(film_position, nx - 1),
                };
                if on_tooth && !taken[entry.node] {
                    taken[entry.node] = true;
                    meshes.tops.push(Top { node: entry.node, tooth, entry: meshes.entries.len() });
                }
                meshes.entries.push(entry);
            }
            for i in 0..nx {
                let at = left + 2.0 * half * i as f64 / (nx - 1) as f64;
                meshes.to_film.push(Between::uniform(at - low as f64, (high - low) as usize));
            }
            meshes.first.push(meshes.entries.len());
        }
        meshes.alike = (0..motor.teeth).all(|tooth| {
            let (own, zeroth) = (meshes.tooth(tooth), meshes.tooth(0));
            own.len() == zeroth.len()
                && own.iter().zip(zeroth).all(|(a, b)| (a.xi - b.xi).abs() < EDGE_TOLERANCE * spacing)
        });
        meshes
    }

    /// Entries of a tooth.
    pub(super) fn tooth(&self, tooth: usize) -> &[Entry] {
        &self.entries[self.first[tooth]..self.first[tooth + 1]]
    }
}
