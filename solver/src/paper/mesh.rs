//! The two meshes, contact along the wavelength and film on each tooth, and the linear interpolation between them.
//!
//! Contact nodes are spaced λ/N round one wavelength (N spacings: the paper's 181 nodes count both ends, N = 180), and
//! node 0 is at the middle of tooth 0. A node is on a tooth top when it is within b/2 of the tooth's middle, give or
//! take 1 % of a spacing. Film nodes are uniform over each tooth, both edges counted.
//!
//! * film → contact: the force of each film node, line load × film spacing, is shared linearly by the two contact nodes
//!   beside it; over the groove, all goes to the node on the tooth. No force is lost, so the paper's equation (11), α =
//!   Σ f₁/L, is the film's own load over L. (Sampling the line load at the contact nodes, times their spacing, which is
//!   the other reading of "linear interpolation", loses 4 % of the film's load on a tooth of 12 spacings, whose edge
//!   nodes weigh nothing: α of the fundamental case would be 0.2258, against 0.238 published.)
//! * contact → film: the gap is interpolated at the film node. Where a tooth edge is not a contact node, the first node
//!   beyond it, over the groove, takes part with the gap that the tooth's profile would have there were it continued,
//!   but never less than zero; that node carries no force and cannot touch.
//!
//! A tooth's *entries* are the nodes of its interpolation, ascending; entries of tooth k are
//! `first[k]..first[k + 1]` of the flat arrays.

use crate::problem::{Motor, Numerics};

/// The paper's film nodes along and across a tooth, and its contact nodes in a wavelength, ends counted.
pub(super) const PAPER_MESH: (usize, usize, usize) = (51, 11, 181);
/// Steps in a cycle, which the paper does not give.
const STEPS_PER_CYCLE: usize = 180;
/// How far beyond the tooth edge a node may be and still be on the tooth, in spacings.
const EDGE_TOLERANCE: f64 = 0.01;

/// Sizes of the meshes: the paper's, unless numerics say otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mesh {
    /// Film nodes along a tooth.
    pub nx: usize,
    /// Film nodes across the width.
    pub ny: usize,
    /// Contact spacings in a wavelength.
    pub n: usize,
    /// Time steps in a cycle.
    pub steps: usize,
}

impl Mesh {
    /// As `numerics` say.
    pub fn of(numerics: &Numerics) -> Self {
        Self {
            nx: numerics.film_nodes_along.unwrap_or(PAPER_MESH.0).max(3),
            ny: numerics.film_nodes_across.unwrap_or(PAPER_MESH.1).max(3),
            n: numerics.contact_nodes.unwrap_or(PAPER_MESH.2).max(5) - 1,
            steps: numerics.steps_per_cycle.unwrap_or(STEPS_PER_CYCLE).max(4),
        }
    }
}

/// Linear interpolation: `values[at] * (1 − weight) + values[at + 1] * weight`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interpolation {
    pub(super) at: usize,
    pub(super) weight: f64,
}

impl Interpolation {
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

/// How the force of a film node is shared by tops `low` and `high`: `1 − weight` and `weight` of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    pub(super) low: usize,
    pub(super) high: usize,
    pub(super) weight: f64,
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
    pub(super) to_film: Vec<Interpolation>,
    /// Per tooth and film node, the tops that its force goes to; `[tooth][ix]`.
    pub(super) shares: Vec<Share>,
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
            shares: Vec::new(),
            alike: true,
        };
        let mut top_of = vec![None; n];
        for tooth in 0..motor.teeth {
            // In spacings from node 0.
            let middle = (tooth * n) as f64 / motor.teeth as f64;
            let (left, right) = (middle - half, middle + half);
            let mut on = ((left - EDGE_TOLERANCE).ceil() as i64, (right + EDGE_TOLERANCE).floor() as i64);
            if on.0 > on.1 {
                // Narrower than a spacing, between two nodes: the nearest stands for the tooth.
                on = (middle.round() as i64, middle.round() as i64);
            }
            let low = if on.0 as f64 > left + EDGE_TOLERANCE || on.0 == on.1 { on.0 - 1 } else { on.0 };
            let high = if (on.1 as f64) < right - EDGE_TOLERANCE || on.0 == on.1 { on.1 + 1 } else { on.1 };
            for node in low..=high {
                let at = node as f64;
                let on_tooth = (on.0..=on.1).contains(&node);
                let entry = Entry {
                    node: node.rem_euclid(n as i64) as usize,
                    xi: (at - middle) * spacing,
                    x: at * spacing,
                    on_tooth,
                };
                if on_tooth && top_of[entry.node].is_none() {
                    top_of[entry.node] = Some(meshes.tops.len());
                    meshes.tops.push(Top { node: entry.node, tooth, entry: meshes.entries.len() });
                }
                meshes.entries.push(entry);
            }
            // Every node on the tooth is a top, of this tooth or of the one it adjoins.
            let top_at = |node: i64| top_of[node.clamp(on.0, on.1).rem_euclid(n as i64) as usize].unwrap_or_default();
            for i in 0..nx {
                let at = left + 2.0 * half * i as f64 / (nx - 1) as f64;
                let between = Interpolation::uniform(at - low as f64, (high - low) as usize);
                let node = low + between.at as i64;
                meshes.to_film.push(between);
                meshes.shares.push(Share { low: top_at(node), high: top_at(node + 1), weight: between.weight });
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
