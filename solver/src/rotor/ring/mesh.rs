//! The mesh of a section: quadratic quadrilaterals on a tensor grid, dense at the contact and at corners.
//!
//! Every edge of a part, a support or the contact band is a grid line. Elements are small at a line and grow in proportion to the distance
//! from it, so that they follow the singular stress at a corner. All sizes are scaled by one factor, so that the mesh has about as many
//! elements as asked for. A finer mesh halves every element and contains the displacements of the coarser one, so its compliance can only
//! be greater.
//!
//! Nodes are numbered in the order in which their displacements are eliminated, so that the factor of the matrix has few entries, and the
//! matrix is factorised as it is assembled: by approximate minimum degree (P. R. Amestoy and others, SIAM J. Matrix Anal. Appl. 17 (1996) 886).

use super::section::{Band, Part, RingError, Section, common, mm, same};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Nodes of an element.
pub const NODES: usize = 9;
/// The three quadratic shape functions at 0, ¼, ½, ¾ and 1 of an element.
const QUARTERS: [[f64; 3]; 5] =
    [[1.0, 0.0, 0.0], [0.375, 0.75, -0.125], [0.0, 1.0, 0.0], [-0.125, 0.75, 0.375], [0.0, 0.0, 1.0]];

/// A mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// (r, z) of each node \[m\].
    pub nodes: Vec<[f64; 2]>,
    /// The elements.
    pub elements: Vec<Element>,
    /// For each node, whether a support holds it along r, θ and z.
    pub held: Vec<[bool; 3]>,
    /// For each node, which column and row of the grid it is in: those of elements' corners are even.
    places: Vec<[usize; 2]>,
}

/// One element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Element {
    /// Its nodes, three from left to right, of the lower side first, of the upper side last: number 4 is its middle.
    pub nodes: [usize; NODES],
    /// Which part of the section it belongs to.
    pub part: usize,
}

/// Interpolation from the nodes of a mesh to those of the mesh with every element halved.
pub(super) struct Halved {
    /// Nodes of the mesh that was halved.
    count: usize,
    /// For each node of the other: the nodes of the element in which it is, and their shape functions there.
    parents: Vec<([usize; NODES], [f64; NODES])>,
}

impl Halved {
    /// From `mesh` to `finer`, which is `mesh` with every element halved both ways.
    pub(super) fn new(mesh: &Mesh, finer: &Mesh) -> Self {
        let at: HashMap<[usize; 2], &Element> =
            mesh.elements.iter().map(|element| (mesh.places[element.nodes[0]], element)).collect();
        let mut parents = vec![([0; NODES], [0.0; NODES]); finer.nodes.len()];
        for element in &finer.elements {
            let [column, row] = finer.places[element.nodes[0]];
            if let Some(parent) = at.get(&[column / 4 * 2, row / 4 * 2]) {
                for (k, node) in element.nodes.into_iter().enumerate() {
                    let (along, up) = (QUARTERS[column % 4 + k % 3], QUARTERS[row % 4 + k / 3]);
                    parents[node] = (parent.nodes, std::array::from_fn(|i| along[i % 3] * up[i / 3]));
                }
            }
        }
        Self { count: mesh.nodes.len(), parents }
    }

    /// Displacements of the mesh that was halved.
    pub(super) fn size(&self) -> usize {
        3 * self.count
    }

    /// Interpolates displacements to the finer mesh.
    pub(super) fn finer(&self, moved: &[f64]) -> Vec<f64> {
        let (moved, _) = moved.as_chunks::<3>();
        let at = |(nodes, shares): &([usize; NODES], [f64; NODES])| {
            let of = nodes.iter().zip(shares);
            of.fold([0.0; 3], |sum, (node, share)| std::array::from_fn(|d| sum[d] + share * moved[*node][d]))
        };
        self.parents.iter().flat_map(at).collect()
    }

    /// Forces on the nodes of the finer mesh as those on the other that do the same work.
    pub(super) fn coarser(&self, forces: &[f64]) -> Vec<f64> {
        let (forces, _) = forces.as_chunks::<3>();
        let mut out = vec![[0.0; 3]; self.count];
        for ((nodes, shares), force) in self.parents.iter().zip(forces) {
            for (node, share) in nodes.iter().zip(shares) {
                (0..3).for_each(|d| out[*node][d] += share * force[d]);
            }
        }
        out.into_flattened()
    }
}

/// Elements of the coarser mesh, which is halved to make the finer one. A finer pair has a multiple of them.
const COARSE: usize = 500;
/// Most elements of that mesh, if the grid lines alone need more than are asked for.
const MOST: usize = 4 * COARSE;
/// Size of elements at a line, as a fraction of the narrower interval beside it. With more elements it is less: in proportion to 1/√elements,
/// so that those at a corner shrink faster than the others.
const AT_LINE: f64 = 0.03;
/// Size of elements at the contact, in shares of its width or of the height of the part that is in contact.
const AT_CONTACT: f64 = 0.1;
/// Growth of the element size per distance from a line.
const GROWTH: f64 = 1.0;

impl Section {
    /// The mesh on which the ring is solved with a contact `band`.
    ///
    /// # Errors
    /// [`RingError`] if the band is not within the lowest face or the mesh would be too large.
    pub fn mesh(&self, band: Band) -> Result<Mesh, RingError> {
        Mesh::new(self, Some(band), COARSE, 2)
    }

    /// How many elements the finer mesh has, with a contact band or without, of a pair with so many times the usual number.
    ///
    /// # Errors
    /// As [`Self::mesh`].
    pub fn elements(&self, band: Option<Band>, times: usize) -> Result<usize, RingError> {
        let Divided { grid, pattern, scale } = Divided::new(self, band, COARSE * times)?;
        Ok(4 * pattern.as_ref().unwrap_or(&grid).elements(scale))
    }

    /// A mesh with so many times the usual number of elements, and that with every element halved both ways.
    pub(super) fn meshes(&self, band: Option<Band>, times: usize) -> Result<[Mesh; 2], RingError> {
        let of = |halves| Mesh::new(self, band, COARSE * times, halves);
        let (coarse, fine) = rayon::join(|| of(1), || of(2));
        Ok([coarse?, fine?])
    }

    /// Whether the band is within one of the lowest faces.
    pub(super) fn check_band(&self, band: Band) -> Result<(), RingError> {
        let (inner, outer) = band.radii();
        let within = |face: &(f64, f64)| {
            (face.0 < inner || same(face.0, inner)) && (outer < face.1 || same(outer, face.1)) && band.width > 0.0
        };
        if self.contact_faces().iter().any(within) {
            return Ok(());
        }
        let faces = self.contact_faces().into_iter().map(|(a, b)| format!("{} to {} mm", mm(a), mm(b)));
        let allowed = faces.collect::<Vec<_>>().join(" or ");
        Err(RingError::Band { inner_mm: mm(inner), outer_mm: mm(outer), allowed })
    }
}

/// The lines of the grid along one coordinate.
#[derive(Clone, Debug)]
struct Lines {
    /// Ascending.
    at: Vec<f64>,
    /// For each interval between two lines, how many elements fit from its beginning up to each of `POINTS` equal
    /// parts of it, before scaling.
    sums: Vec<Vec<f64>>,
}

impl Lines {
    /// Points of the trapezoidal rule.
    const POINTS: usize = 128;

    /// Of `edges` in any order, those that are one counted once; elements at a line have the share `at_line` of the interval beside it, and
    /// `fine` are lines with elements no larger than given.
    fn new(mut edges: Vec<f64>, at_line: f64, fine: &[(f64, f64)]) -> Self {
        edges.sort_by(f64::total_cmp);
        edges.dedup_by(|a, b| same(*a, *b));
        let gap = |i: usize| edges.get(i + 1).map_or(f64::INFINITY, |next| next - edges[i]);
        let size = |i: usize| {
            let narrower = gap(i).min(if i > 0 { gap(i - 1) } else { f64::INFINITY });
            let asked = fine.iter().filter(|(line, _)| same(*line, edges[i])).map(|(_, size)| *size);
            asked.fold(at_line * narrower, f64::min)
        };
        let sizes: Vec<f64> = (0..edges.len()).map(size).collect();
        let density = |x: f64| {
            let size = edges.iter().zip(&sizes).map(|(line, size)| size + GROWTH * (x - line).abs());
            1.0 / size.fold(f64::INFINITY, f64::min)
        };
        let sums = edges.windows(2).map(|ends| {
            let step = (ends[1] - ends[0]) / Self::POINTS as f64;
            let trapezium = |i: usize| {
                let x = ends[0] + step * i as f64;
                0.5 * step * (density(x) + density(x + step))
            };
            let parts = (0..Self::POINTS).scan(0.0, |sum, i| {
                *sum += trapezium(i);
                Some(*sum)
            });
            std::iter::once(0.0).chain(parts).collect()
        });
        Self { sums: sums.collect(), at: edges }
    }

    /// Elements of the interval `i` with sizes `scale` as large.
    fn count(&self, i: usize, scale: f64) -> usize {
        (self.sums[i][Self::POINTS] / scale).ceil().max(1.0) as usize
    }

    /// Edges of the elements, and the interval of each element: equal shares of the density, each divided into
    /// `halves`.
    fn divided(&self, scale: f64, halves: usize) -> (Vec<f64>, Vec<usize>) {
        let (mut edges, mut intervals) = (vec![self.at[0]], Vec::new());
        for (interval, (ends, sums)) in self.at.windows(2).zip(&self.sums).enumerate() {
            let (count, mut before) = (self.count(interval, scale), ends[0]);
            for part in 1..=count {
                let share = sums[Self::POINTS] * part as f64 / count as f64;
                let i = sums.partition_point(|sum| *sum < share).clamp(1, Self::POINTS);
                let between = i as f64 - 1.0 + (share - sums[i - 1]) / (sums[i] - sums[i - 1]);
                let end =
                    if part == count { ends[1] } else { ends[0] + (ends[1] - ends[0]) * between / Self::POINTS as f64 };
                edges.extend((1..=halves).map(|half| before + (end - before) * half as f64 / halves as f64));
                intervals.extend(std::iter::repeat_n(interval, halves));
                before = end;
            }
        }
        (edges, intervals)
    }
}

impl Mesh {
    /// About `elements` elements, each divided into `halves` both ways.
    pub(super) fn new(
        section: &Section,
        band: Option<Band>,
        elements: usize,
        halves: usize,
    ) -> Result<Self, RingError> {
        let Divided { grid, pattern, scale } = Divided::new(section, band, elements)?;
        grid.mesh(section, pattern.as_ref().unwrap_or(&grid), scale, halves)
    }

    /// Inner and outer radius, bottom and top of `element`.
    pub(super) fn corners(&self, element: &Element) -> [f64; 4] {
        let ([inner, bottom], [outer, top]) = (self.nodes[element.nodes[0]], self.nodes[element.nodes[8]]);
        [inner, outer, bottom, top]
    }
}

/// For each of `count` nodes itself and, ascending, those of a greater number that it shares an element with: where those of each node
/// begin, and all of them.
pub(super) fn neighbours(count: usize, elements: &[Element]) -> (Vec<usize>, Vec<usize>) {
    // On a tensor grid a node has four elements at most.
    let mut touching = vec![(0, [0; 4]); count];
    for (k, element) in elements.iter().enumerate() {
        for node in element.nodes {
            let (known, all) = &mut touching[node];
            all[*known] = k;
            *known += 1;
        }
    }
    let (mut first, mut others, mut of_one) = (vec![0], Vec::new(), Vec::new());
    for (node, (known, all)) in touching.iter().enumerate() {
        of_one.clear();
        of_one.extend(all[..*known].iter().flat_map(|k| elements[*k].nodes).filter(|other| *other >= node));
        of_one.sort_unstable();
        of_one.dedup();
        others.extend_from_slice(&of_one);
        first.push(others.len());
    }
    (first, others)
}

/// Elimination order of `count` nodes, and the position of each node in it.
fn elimination(count: usize, elements: &[Element]) -> Result<[Vec<usize>; 2], RingError> {
    let (first, others) = neighbours(count, elements);
    let (mut order, mut number) = (vec![0; count], vec![0; count]);
    let scratch = amd::order_scratch::<usize>(count, others.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| RingError::Memory)?;
    let graph = SymbolicSparseColMatRef::new_checked(count, count, &first, None, &others);
    amd::order(&mut order, &mut number, graph, Default::default(), MemStack::new(&mut memory))
        .map_err(|_| RingError::Memory)?;
    Ok([order, number])
}

impl Section {
    /// Whether this section under its contact `band` has as many lines, between the same parts, as `other` has under its own.
    ///
    /// # Errors
    /// [`RingError`] if a band is not within the lowest face.
    pub fn is_meshed_like(&self, band: Band, other: &Self, of: Band) -> Result<bool, RingError> {
        Ok(Grid::of(self, Some(band), AT_LINE)?.is_like(&Grid::of(other, Some(of), AT_LINE)?))
    }

    /// The size below which the stress of the contact varies: the width of the band, or the height of the lowest part
    /// it is on.
    pub(super) fn depth(&self, band: Band) -> f64 {
        let height = self.contact_height();
        let touching =
            self.parts().iter().filter(|part| same(part.bottom, height) && common(part.radii(), band.radii()) > 0.0);
        touching.map(|part| part.top - part.bottom).fold(band.width, f64::min)
    }
}

/// A section with its lines, before any element is made.
struct Divided {
    grid: Grid,
    /// The lines whose elements are moved to those of `grid`, if not its own.
    pattern: Option<Grid>,
    /// Of the sizes of elements.
    scale: f64,
}

impl Divided {
    /// For about `elements` elements.
    fn new(section: &Section, band: Option<Band>, elements: usize) -> Result<Self, RingError> {
        let at_line = AT_LINE * (COARSE as f64 / elements as f64).sqrt().min(1.0);
        let grid = Grid::of(section, band, at_line)?;
        let pattern = section.pattern().map(|(other, of)| Grid::of(other, band.and(Some(of)), at_line)).transpose()?;
        let pattern = pattern.filter(|pattern| pattern.is_like(&grid));
        let lines = pattern.as_ref().unwrap_or(&grid);
        // The smallest elements of which there are no more than asked for, within a hundredth.
        let (mut many, mut few) = (1e-2_f64, 1e4_f64);
        while few / many > 1.01 {
            let scale = (many * few).sqrt();
            if lines.elements(scale) > elements { many = scale } else { few = scale }
        }
        let least = lines.elements(few);
        if least > elements.max(MOST) {
            return Err(RingError::Elements { elements: least, most: elements.max(MOST) });
        }
        Ok(Self { grid, pattern, scale: few })
    }
}

/// The lines both ways, and which part is between them.
struct Grid {
    along: Lines,
    up: Lines,
    /// Part of each interval i along r and j along z, `[i + j · intervals along r]`.
    parts: Vec<Option<usize>>,
}

impl Grid {
    /// Of a section with a contact band or without.
    fn of(section: &Section, band: Option<Band>, at_line: f64) -> Result<Self, RingError> {
        let (mut along, mut up) = (Vec::new(), Vec::new());
        for part in section.parts() {
            along.extend([part.inner_radius, part.outer_radius]);
            up.extend([part.bottom, part.top]);
        }
        // Of a support, what is within the section.
        let add = |edges: &mut Vec<f64>, ends: [f64; 2]| {
            let low = edges.iter().copied().fold(f64::INFINITY, f64::min);
            let high = edges.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            edges.extend(ends.into_iter().filter(|x| *x > low && *x < high));
        };
        for support in section.supports() {
            add(&mut along, [support.inner_radius, support.outer_radius]);
            add(&mut up, [support.bottom, support.top]);
        }
        let (mut fine_along, mut fine_up) = (Vec::new(), Vec::new());
        if let Some(band) = band {
            section.check_band(band)?;
            let size = AT_CONTACT * section.depth(band);
            let (inner, outer) = band.radii();
            along.extend([inner, outer]);
            fine_along.extend([(inner, size), (outer, size)]);
            fine_up.push((section.contact_height(), size));
        }
        let (along, up) = (Lines::new(along, at_line, &fine_along), Lines::new(up, at_line, &fine_up));
        let within = |ends: &[f64], (low, high): (f64, f64)| (low..high).contains(&(0.5 * (ends[0] + ends[1])));
        let mut parts = Vec::new();
        for high in up.at.windows(2) {
            let here = |wide: &[f64], part: &Part| within(wide, part.radii()) && within(high, part.heights());
            parts.extend(along.at.windows(2).map(|wide| section.parts().iter().position(|part| here(wide, part))));
        }
        Ok(Self { along, up, parts })
    }

    /// Whether both have as many lines, between the same parts.
    fn is_like(&self, other: &Self) -> bool {
        self.along.at.len() == other.along.at.len() && self.parts == other.parts
    }

    /// Elements with sizes `scale` as large.
    fn elements(&self, scale: f64) -> usize {
        let columns = self.along.sums.len();
        let filled = self.parts.iter().enumerate().filter(|(_, part)| part.is_some());
        filled.map(|(k, _)| self.along.count(k % columns, scale) * self.up.count(k / columns, scale)).sum()
    }

    /// Elements as in `pattern`, which is like this grid or this grid itself, moved with the lines.
    fn mesh(&self, section: &Section, pattern: &Self, scale: f64, halves: usize) -> Result<Mesh, RingError> {
        let (radii, along) = pattern.along.divided(scale, halves);
        let (heights, up) = pattern.up.divided(scale, halves);
        let radii = moved(radii, &along, &pattern.along.at, &self.along.at);
        let heights = moved(heights, &up, &pattern.up.at, &self.up.at);
        let (columns, intervals) = (2 * along.len() + 1, self.along.sums.len());
        let mut elements = Vec::new();
        for (j, row) in up.iter().enumerate() {
            for (i, column) in along.iter().enumerate() {
                if let Some(part) = self.parts[column + row * intervals] {
                    let nodes = std::array::from_fn(|node| 2 * i + node % 3 + (2 * j + node / 3) * columns);
                    elements.push(Element { nodes, part });
                }
            }
        }
        // Places of the grid without an element have no node.
        let mut number = vec![usize::MAX; columns * (2 * up.len() + 1)];
        elements.iter().flat_map(|element| element.nodes).for_each(|place| number[place] = 0);
        let places: Vec<usize> = (0..number.len()).filter(|place| number[*place] == 0).collect();
        places.iter().enumerate().for_each(|(node, place)| number[*place] = node);
        let renumber = |elements: &mut [Element], number: &[usize]| {
            elements.iter_mut().for_each(|element| element.nodes = element.nodes.map(|node| number[node]));
        };
        renumber(&mut elements, &number);
        let [order, number] = elimination(places.len(), &elements)?;
        renumber(&mut elements, &number);
        let places = order.iter().map(|node| [places[*node] % columns, places[*node] / columns]);
        let places: Vec<[usize; 2]> = places.collect();
        let middle = |edges: &[f64], i: usize| 0.5 * (edges[i / 2] + edges[i.div_ceil(2)]);
        let nodes: Vec<[f64; 2]> = places.iter().map(|[i, j]| [middle(&radii, *i), middle(&heights, *j)]).collect();
        let held = nodes.iter().map(|node| section.held(*node)).collect();
        Ok(Mesh { nodes, elements, held, places })
    }
}

/// Edges of elements, each in its interval, moved as the ends of the intervals are.
fn moved(mut edges: Vec<f64>, intervals: &[usize], from: &[f64], to: &[f64]) -> Vec<f64> {
    if from != to {
        for (edge, i) in edges.iter_mut().zip(intervals.iter().copied().chain(intervals.last().copied())) {
            let share = (*edge - from[i]) / (from[i + 1] - from[i]);
            *edge = to[i] + share * (to[i + 1] - to[i]);
        }
    }
    edges
}

impl Section {
    /// Which directions (r, θ, z) supports hold at a point.
    fn held(&self, [r, z]: [f64; 2]) -> [bool; 3] {
        let inside = |x: f64, low: f64, high: f64| (x > low || same(x, low)) && (x < high || same(x, high));
        let mut held = [false; 3];
        for support in self.supports() {
            if inside(r, support.inner_radius, support.outer_radius) && inside(z, support.bottom, support.top) {
                held[0] |= support.radial;
                held[1] |= support.circumferential;
                held[2] |= support.axial;
            }
        }
        held
    }
}
