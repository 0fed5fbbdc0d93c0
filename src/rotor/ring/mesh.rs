//! The mesh of a section: quadratic quadrilaterals on a tensor grid, dense at the contact and at corners.
//!
//! Every edge of a part, a support or the contact band is a line of the grid. Between two lines the size of an element grows from what
//! is fine there by a constant share of the distance, so that it follows the singular stress at a corner. All sizes are scaled
//! by one factor, so that the mesh has about as many elements as were asked for. A finer mesh halves every element, and contains
//! the displacements of the coarser one: its compliance can only be greater.
//!
//! Nodes are numbered by nested dissection (A. George, SIAM J. Numer. Anal. 10 (1973) 345): first what is on either side of a line of the
//! grid, then the line. In this order the Cholesky factor has few entries.

use super::section::{Band, RingError, Section, common, mm, same};

/// Nodes of an element.
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
    /// Its nodes, three from left to right, of the lower side first, of the upper side last: number 4 is its middle.
    pub nodes: [usize; NODES],
    /// Which part of the section it belongs to.
    pub part: usize,
}

/// Elements of the mesh that is to be halved once more.
const COARSE: usize = 500;
/// The most elements of it, if lines alone make that many.
const MOST: usize = 4 * COARSE;
/// Size of elements at a line, in shares of the narrower of the intervals beside it.
const AT_LINE: f64 = 0.1;
/// Size of elements at the contact, in shares of its width or of the height of the part that is in contact.
const AT_CONTACT: f64 = 0.1;
/// Growth of elements with the distance from a line.
const GROWTH: f64 = 0.6;

impl Section {
    /// The mesh on which the ring is solved with a contact `band`.
    ///
    /// # Errors
    /// [`RingError`] if the band is not within the lowest face or the mesh would be too large.
    pub fn mesh(&self, band: Band) -> Result<Mesh, RingError> {
        self.meshes(Some(band)).map(|[_, fine]| fine)
    }

    /// A mesh and that with every element halved both ways.
    pub(super) fn meshes(&self, band: Option<Band>) -> Result<[Mesh; 2], RingError> {
        let [coarse, fine] = [1, 2].map(|halves| Mesh::new(self, band, COARSE, halves));
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

/// The lines of the grid along one coordinate, ascending, and the size of elements at each.
#[derive(Clone, Debug)]
struct Lines {
    at: Vec<f64>,
    size: Vec<f64>,
}

impl Lines {
    /// Of `edges` in any order, those that are one counted once; `fine` are lines with elements no larger than given.
    fn new(mut edges: Vec<f64>, fine: &[(f64, f64)]) -> Self {
        edges.sort_by(f64::total_cmp);
        edges.dedup_by(|a, b| same(*a, *b));
        let gap = |i: usize| edges.get(i + 1).map_or(f64::INFINITY, |next| next - edges[i]);
        let size = |i: usize| {
            let narrower = gap(i).min(if i > 0 { gap(i - 1) } else { f64::INFINITY });
            let asked = fine.iter().filter(|(line, _)| same(*line, edges[i])).map(|(_, size)| *size);
            asked.fold(AT_LINE * narrower, f64::min)
        };
        let size = (0..edges.len()).map(size).collect();
        Self { at: edges, size }
    }

    /// Share of an element that fits into a unit length at `x`, before scaling.
    fn density(&self, x: f64) -> f64 {
        let size = self.at.iter().zip(&self.size).map(|(line, size)| size + GROWTH * (x - line).abs());
        1.0 / size.fold(f64::INFINITY, f64::min)
    }

    /// Edges of elements: each interval in equal shares of the density, as many as there are with sizes `scale` as large, each halved
    /// `halves` − 1 times.
    fn divided(&self, scale: f64, halves: usize) -> Vec<f64> {
        /// Points of the trapezoidal rule.
        const POINTS: usize = 256;
        let mut edges = vec![self.at[0]];
        for ends in self.at.windows(2) {
            let at = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / POINTS as f64;
            let mut sums = vec![0.0];
            for i in 0..POINTS {
                sums.push(sums[i] + 0.5 * (at(i + 1) - at(i)) * (self.density(at(i)) + self.density(at(i + 1))));
            }
            let count = (sums[POINTS] / scale).ceil().max(1.0) as usize;
            let mut before = ends[0];
            for part in 1..=count {
                let share = sums[POINTS] * part as f64 / count as f64;
                let i = sums.partition_point(|sum| *sum < share).clamp(1, POINTS);
                let between = (share - sums[i - 1]) / (sums[i] - sums[i - 1]);
                let end = if part == count { ends[1] } else { at(i - 1) + between * (at(i) - at(i - 1)) };
                edges.extend((1..=halves).map(|half| before + (end - before) * half as f64 / halves as f64));
                before = end;
            }
        }
        edges
    }
}

/// Which part the element between two edges along r and two along z belongs to.
fn part_at(section: &Section, radii: &[f64], heights: &[f64]) -> Option<usize> {
    let middle = |ends: &[f64]| 0.5 * (ends[0] + ends[1]);
    let (r, z) = (middle(radii), middle(heights));
    section
        .parts()
        .iter()
        .position(|part| (part.inner_radius..part.outer_radius).contains(&r) && (part.bottom..part.top).contains(&z))
}

impl Mesh {
    /// About `elements` elements, each divided into `halves` both ways.
    pub(super) fn new(
        section: &Section,
        band: Option<Band>,
        elements: usize,
        halves: usize,
    ) -> Result<Self, RingError> {
        let (mut along, mut up) = (Vec::new(), Vec::new());
        for part in section.parts() {
            along.extend([part.inner_radius, part.outer_radius]);
            up.extend([part.bottom, part.top]);
        }
        let within = |edges: &[f64], x: f64| {
            let low = edges.iter().copied().fold(f64::INFINITY, f64::min);
            let high = edges.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            x > low && x < high
        };
        for support in section.supports() {
            for radius in [support.inner_radius, support.outer_radius] {
                if within(&along, radius) {
                    along.push(radius);
                }
            }
            for height in [support.bottom, support.top] {
                if within(&up, height) {
                    up.push(height);
                }
            }
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
        let (along, up) = (Lines::new(along, &fine_along), Lines::new(up, &fine_up));
        let grid = |scale: f64, halves: usize| Grid::new(section, &along, &up, scale, halves);
        // The sizes of the largest mesh that has no more elements than asked for, within a hundredth.
        let (mut fine, mut coarse) = (1e-2_f64, 1e4_f64);
        while coarse / fine > 1.01 {
            let scale = (fine * coarse).sqrt();
            if grid(scale, 1).elements() > elements { fine = scale } else { coarse = scale }
        }
        let least = grid(coarse, 1).elements();
        if least > elements.max(MOST) {
            return Err(RingError::Elements { elements: least, most: MOST });
        }
        Ok(grid(coarse, halves).mesh(section))
    }

    /// The nodes of `element`, and its inner and outer radius, bottom and top.
    pub(super) fn corners(&self, element: &Element) -> [f64; 4] {
        let ([inner, bottom], [outer, top]) = (self.nodes[element.nodes[0]], self.nodes[element.nodes[8]]);
        [inner, outer, bottom, top]
    }
}

impl Section {
    /// The size below which the stress of the contact varies: the width of the band, or the height of the lowest part it is on.
    pub(super) fn depth(&self, band: Band) -> f64 {
        let height = self.contact_height();
        let touching =
            self.parts().iter().filter(|part| same(part.bottom, height) && common(part.radii(), band.radii()) > 0.0);
        touching.map(|part| part.top - part.bottom).fold(band.width, f64::min)
    }
}

/// A tensor grid and the parts of its cells.
struct Grid {
    along: Vec<f64>,
    up: Vec<f64>,
    /// Part of each cell, `[i + j · cells along]`.
    parts: Vec<Option<usize>>,
}

impl Grid {
    fn new(section: &Section, along: &Lines, up: &Lines, scale: f64, halves: usize) -> Self {
        let (along, up) = (along.divided(scale, halves), up.divided(scale, halves));
        let cells =
            up.windows(2).flat_map(|heights| along.windows(2).map(move |radii| part_at(section, radii, heights)));
        let parts = cells.collect();
        Self { along, up, parts }
    }

    fn elements(&self) -> usize {
        self.parts.iter().flatten().count()
    }

    fn mesh(&self, section: &Section) -> Mesh {
        let (nx, ny) = (self.along.len() - 1, self.up.len() - 1);
        let columns = 2 * nx + 1;
        let place = |edges: &[f64], i: usize| 0.5 * (edges[i / 2] + edges[i.div_ceil(2)]);
        let mut used = vec![false; columns * (2 * ny + 1)];
        let of_cell = |i: usize, j: usize| -> [usize; NODES] {
            std::array::from_fn(|node| 2 * i + node % 3 + (2 * j + node / 3) * columns)
        };
        let mut cells = Vec::new();
        for j in 0..ny {
            for i in 0..nx {
                if let Some(part) = self.parts[i + j * nx] {
                    of_cell(i, j).iter().for_each(|place| used[*place] = true);
                    cells.push((of_cell(i, j), part));
                }
            }
        }
        let mut order = Vec::new();
        dissect([0, 2 * nx], [0, 2 * ny], &mut |i, j| {
            if used[i + j * columns] {
                order.push((i, j));
            }
        });
        let mut number = vec![usize::MAX; used.len()];
        for (k, (i, j)) in order.iter().enumerate() {
            number[i + j * columns] = k;
        }
        let nodes: Vec<[f64; 2]> = order.iter().map(|(i, j)| [place(&self.along, *i), place(&self.up, *j)]).collect();
        let element = |(places, part): &([usize; NODES], usize)| Element {
            nodes: places.map(|place| number[place]),
            part: *part,
        };
        let elements = cells.iter().map(element).collect();
        let held = nodes.iter().map(|node| section.held(*node)).collect();
        Mesh { nodes, elements, held }
    }
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

/// Visits the nodes of the box `along` × `up` (first and last index) by nested dissection. Lines that part it have an even index: they are edges of
/// elements, so that no element has nodes on both sides.
fn dissect(along: [usize; 2], up: [usize; 2], visit: &mut impl FnMut(usize, usize)) {
    /// Nodes along a side of a box that is not divided any more.
    const LEAST: usize = 7;
    let side = |[first, last]: [usize; 2]| (last + 1).saturating_sub(first);
    if side(along) == 0 || side(up) == 0 {
        return;
    }
    let middle = |[first, last]: [usize; 2]| {
        let middle = (first + last) / 2;
        middle + middle % 2
    };
    if side(along).max(side(up)) <= LEAST {
        (up[0]..=up[1]).for_each(|j| (along[0]..=along[1]).for_each(|i| visit(i, j)));
    } else if side(along) >= side(up) {
        let line = middle(along);
        dissect([along[0], line - 1], up, visit);
        dissect([line + 1, along[1]], up, visit);
        (up[0]..=up[1]).for_each(|j| visit(line, j));
    } else {
        let line = middle(up);
        dissect(along, [up[0], line - 1], visit);
        dissect(along, [line + 1, up[1]], visit);
        (along[0]..=along[1]).for_each(|i| visit(i, line));
    }
}
