//! The equations of one mesh, for every order, and their factorisation.
//!
//! Unknown 3 i + d is the displacement of node i in the direction d = 0 (r), 1 (θ) or 2 (z). What a support holds is
//! left without coupling, so that it stays 0 and the pattern of the matrix is that of the mesh alone: one symbolic
//! factorisation serves all orders. Unknowns are eliminated in the order of their numbers.

use super::element::{self, DIRECTIONS, Integrals, Pair};
use super::mesh::{Mesh, neighbours};
use super::section::{Band, RingError, SAME, Section, same};
use crate::control::Cancel;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use std::collections::HashMap;
use std::sync::Arc;

/// Stiffness and mass of a mesh: for each node, what it has to do with itself and with those after it.
pub(super) struct System {
    /// Unknowns.
    pub(super) size: usize,
    /// Where the pairs of each node begin.
    first: Vec<usize>,
    /// The first node of each pair, ascending for each second one, which is the first of them itself.
    others: Vec<usize>,
    pairs: Vec<Pair>,
    /// The lower triangle of the matrix, column by column: where each begins, and the rows.
    starts: Vec<u32>,
    rows: Vec<u32>,
    symbolic: Arc<SymbolicCholesky<u32>>,
}

/// A factorised matrix.
pub(super) struct Factor {
    symbolic: Arc<SymbolicCholesky<u32>>,
    values: Vec<f64>,
}

/// Blocks of up to so many columns are joined if less than this share of the joined one is zeros. With more zeros, as faer has it unless told, a
/// ring on one core takes a sixth longer.
const JOINED: &[(usize, f64)] = &[(12, 1.0), (32, 0.3), (usize::MAX, 0.02)];

/// Ends what is being computed if it has been cancelled.
///
/// # Errors
/// [`RingError::Cancelled`] if it has.
pub(super) fn cancelled(cancel: &Cancel) -> Result<(), RingError> {
    if cancel.is_cancelled() { Err(RingError::Cancelled) } else { Ok(()) }
}

/// Whether an entry of a 3 × 3 block couples θ with another direction.
fn mixed(p: usize, q: usize) -> bool {
    (p == 1) != (q == 1)
}

impl System {
    /// Assembles the equations of a mesh of `section`.
    pub(super) fn new(section: &Section, mesh: &Mesh) -> Result<Self, RingError> {
        let count = mesh.nodes.len();
        let (first, others) = neighbours(count, &mesh.elements);
        let (mut starts, mut rows) = (vec![0_u32], Vec::with_capacity(DIRECTIONS * DIRECTIONS * others.len()));
        for node in 0..count {
            for q in 0..DIRECTIONS {
                for a in &others[first[node]..first[node + 1]] {
                    let of_node: [u32; DIRECTIONS] = std::array::from_fn(|p| (DIRECTIONS * a + p) as u32);
                    rows.extend_from_slice(&of_node[if *a == node { q } else { 0 }..]);
                }
                starts.push(rows.len() as u32);
            }
        }
        let mut pairs = vec![Pair::default(); others.len()];
        let mut integrals: [HashMap<[u64; 2], Integrals>; 2] = [HashMap::new(), HashMap::new()];
        for element in &mesh.elements {
            let [inner, outer, bottom, top] = mesh.corners(element);
            let [along, up] = &mut integrals;
            let along = along.entry([inner, outer].map(f64::to_bits)).or_insert_with(|| Integrals::new(inner, outer));
            let up = up.entry([bottom, top].map(f64::to_bits)).or_insert_with(|| Integrals::new(bottom, top));
            let material = &section.parts()[element.part].material;
            for (j, b) in element.nodes.into_iter().enumerate() {
                let known = &others[first[b]..first[b + 1]];
                for (i, a) in element.nodes.into_iter().enumerate().filter(|(_, a)| *a >= b) {
                    pairs[first[b] + known.partition_point(|node| *node < a)]
                        .add(&element::pair(material, along, up, i, j));
                }
            }
        }
        for (b, held) in mesh.held.iter().enumerate() {
            for k in first[b]..first[b + 1] {
                pairs[k].hold(mesh.held[others[k]], *held, others[k] == b);
            }
        }
        let size = DIRECTIONS * count;
        // Its rows, of which the symbolic factorisation reads the transposed matrix as columns.
        let lower = SymbolicSparseColMatRef::new_checked(size, size, &starts, None, &rows).to_row_major();
        let upper = lower.as_ref().map_err(|_| RingError::Memory)?.transpose();
        // In blocks also where faer would not: half the time on the coarser mesh of 500 elements.
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            supernodal_params: SymbolicSupernodalParams { relax: Some(JOINED) },
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(upper, Side::Upper, SymmetricOrdering::Identity, params)
            .map_err(|_| RingError::Memory)?;
        Ok(Self { size, first, others, pairs, starts, rows, symbolic: Arc::new(symbolic) })
    }

    /// Factorises the stiffness of order `order` plus `shift` times the mass.
    pub(super) fn factor(&self, order: f64, shift: f64) -> Result<Factor, RingError> {
        let mut matrix = Vec::with_capacity(self.rows.len());
        for b in 0..self.size / DIRECTIONS {
            let pairs = self.first[b]..self.first[b + 1];
            for q in 0..DIRECTIONS {
                for (pair, a) in self.pairs[pairs.clone()].iter().zip(&self.others[pairs.clone()]) {
                    let mut of_node: [f64; DIRECTIONS] =
                        std::array::from_fn(|p| pair.base[p][q] * if mixed(p, q) { order } else { 1.0 });
                    of_node[q] += order * order * pair.square[q] + shift * pair.mass[q];
                    matrix.extend_from_slice(&of_node[if *a == b { q } else { 0 }..]);
                }
            }
        }
        let pattern = SymbolicSparseColMatRef::new_checked(self.size, self.size, &self.starts, None, &self.rows);
        let mut values = vec![0.0; self.symbolic.len_val()];
        let scratch = self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| RingError::Memory)?;
        self.symbolic
            .factorize_numeric_llt(
                &mut values,
                SparseColMatRef::new(pattern, &matrix),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| RingError::Singular { order: order.round() as u32 })?;
        Ok(Factor { symbolic: self.symbolic.clone(), values })
    }

    /// The displacements of order `order` under the nodal forces `load`.
    pub(super) fn moved(&self, load: &[f64], order: f64) -> Result<Vec<f64>, RingError> {
        let mut moved = load.to_vec();
        self.factor(order, 0.0)?.solve(&mut moved, 1)?;
        Ok(moved)
    }

    /// The products of each of the `vectors` with the three parts of the stiffness, K = K₀ + m K₁ + m² K₂. The parts, larger than a processor's
    /// cache, are read once for all of them.
    pub(super) fn products(&self, vectors: &[&[f64]]) -> Vec<[Vec<f64>; 3]> {
        /// Of the places that do not couple θ with another direction, and of those that do.
        fn apart(base: [[f64; DIRECTIONS]; DIRECTIONS], [r, t, z]: [f64; DIRECTIONS]) -> [[f64; DIRECTIONS]; 2] {
            let [[rr, rt, rz], [tr, tt, tz], [zr, zt, zz]] = base;
            [[rr * r + rz * z, tt * t, zr * r + zz * z], [rt * t, tr * r + tz * z, zt * t]]
        }
        let nodes = self.size / DIRECTIONS;
        let moved: Vec<&[[f64; DIRECTIONS]]> = vectors.iter().map(|vector| vector.as_chunks().0).collect();
        let mut out = vec![[(); 3].map(|()| vec![[0.0; DIRECTIONS]; nodes]); vectors.len()];
        let mut sums = vec![[[0.0; DIRECTIONS]; 3]; vectors.len()];
        for b in 0..nodes {
            sums.fill([[0.0; DIRECTIONS]; 3]);
            for (a, pair) in self.coupled(b) {
                let Pair { base, square, .. } = *pair;
                let across = std::array::from_fn(|p| std::array::from_fn(|q| base[q][p]));
                for ((moved, out), sums) in moved.iter().zip(&mut out).zip(&mut sums) {
                    let at = &moved[b];
                    let other = &moved[a];
                    let [constant, linear] = apart(if a == b { base } else { across }, *other);
                    for p in 0..DIRECTIONS {
                        sums[0][p] += constant[p];
                        sums[1][p] += linear[p];
                        sums[2][p] += square[p] * other[p];
                    }
                    if a != b {
                        let [constant, linear] = apart(base, *at);
                        for p in 0..DIRECTIONS {
                            out[0][a][p] += constant[p];
                            out[1][a][p] += linear[p];
                            out[2][a][p] += square[p] * at[p];
                        }
                    }
                }
            }
            for (out, sums) in out.iter_mut().zip(&sums) {
                for (out, sums) in out.iter_mut().zip(sums) {
                    (0..DIRECTIONS).for_each(|p| out[b][p] += sums[p]);
                }
            }
        }
        out.into_iter().map(|parts| parts.map(Vec::into_flattened)).collect()
    }

    /// The product of `vector` with the mass.
    pub(super) fn inertia(&self, vector: &[f64]) -> Vec<f64> {
        let (moved, _) = vector.as_chunks::<DIRECTIONS>();
        let mut out = vec![[0.0; DIRECTIONS]; moved.len()];
        for b in 0..moved.len() {
            for (a, pair) in self.coupled(b) {
                for p in 0..DIRECTIONS {
                    out[a][p] += pair.mass[p] * moved[b][p];
                    out[b][p] += if a == b { 0.0 } else { pair.mass[p] * moved[a][p] };
                }
            }
        }
        out.into_flattened()
    }

    /// The nodes from `b` on that have to do with it, and what.
    fn coupled(&self, b: usize) -> impl Iterator<Item = (usize, &Pair)> {
        let pairs = self.first[b]..self.first[b + 1];
        self.others[pairs.clone()].iter().copied().zip(&self.pairs[pairs])
    }
}

impl Factor {
    /// Solves for `columns` right-hand sides, one after the other in `vectors`, in place.
    pub(super) fn solve(&self, vectors: &mut [f64], columns: usize) -> Result<(), RingError> {
        let size = self.symbolic.nrows();
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq);
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| RingError::Memory)?;
        LltRef::new(&*self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(vectors, size, columns),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        Ok(())
    }
}

/// The rigid motions of an order that no support holds: U, V, W of every node, node by node.
pub(super) fn free_motions(mesh: &Mesh, order: u32) -> Vec<Vec<f64>> {
    let motion =
        |of: fn([f64; 2]) -> [f64; DIRECTIONS]| mesh.nodes.iter().flat_map(|node| of(*node)).collect::<Vec<f64>>();
    let motions = match order {
        0 => vec![motion(|_| [0.0, 0.0, 1.0]), motion(|[r, _]| [0.0, r, 0.0])],
        1 => vec![motion(|_| [1.0, -1.0, 0.0]), motion(|[r, z]| [-z, z, r])],
        _ => Vec::new(),
    };
    let moves = |motion: &[f64]| motion.iter().zip(mesh.held.iter().flatten()).any(|(x, held)| *held && x.abs() > SAME);
    // Of order 1, what is held may still turn about where it is held.
    let (held, mut free): (Vec<_>, Vec<_>) = motions.into_iter().partition(|motion| moves(motion));
    if let (1, [first, second]) = (order, held.as_slice()) {
        let at = first.iter().zip(mesh.held.iter().flatten()).position(|(x, held)| *held && x.abs() > SAME);
        if let Some(share) = at.map(|at| second[at] / first[at]) {
            let both: Vec<f64> = second.iter().zip(first).map(|(b, a)| b - share * a).collect();
            if !moves(&both) {
                free.push(both);
            }
        }
    }
    free
}

/// Nodal forces \[N per radian\] of a line load of 1 N/m at the radius of `band`: a uniform axial pressure over it.
pub(super) fn contact_load(section: &Section, mesh: &Mesh, band: Band) -> Vec<f64> {
    let (height, (first, last)) = (section.contact_height(), band.radii());
    let mut load = vec![0.0; DIRECTIONS * mesh.nodes.len()];
    for element in &mesh.elements {
        let [inner, outer, bottom, _] = mesh.corners(element);
        let middle = 0.5 * (inner + outer);
        if same(bottom, height) && first < middle && middle < last {
            for (node, weight) in element.nodes.iter().zip(element::weights(inner, outer)) {
                load[DIRECTIONS * node + 2] += weight / band.width;
            }
        }
    }
    for (node, held) in mesh.held.iter().enumerate() {
        if held[2] {
            load[DIRECTIONS * node + 2] = 0.0;
        }
    }
    load
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::dot;
    use crate::rotor::ring::section::{MATERIALS, Material, Part, Support};

    /// Two parts of one material, so that lines run through the section, and its mesh.
    fn two_parts(supports: Vec<Support>) -> (Section, Mesh) {
        let parts = vec![Part::in_mm("low", (20.0, 24.0), (0.0, 3.0)), Part::in_mm("high", (20.0, 24.0), (3.0, 5.0))];
        let section = Section::new(parts, supports).unwrap();
        let mesh = Mesh::new(&section, None, 100, 1).unwrap();
        (section, mesh)
    }

    fn field(mesh: &Mesh, of: impl Fn(f64, f64) -> [f64; DIRECTIONS]) -> Vec<f64> {
        mesh.nodes.iter().flat_map(|[r, z]| of(*r, *z)).collect()
    }

    /// Forces K u of order `order`.
    fn forces(system: &System, moved: &[f64], order: f64) -> Vec<f64> {
        let [constant, linear, square] = &system.products(&[moved])[0];
        (0..moved.len()).map(|i| constant[i] + order * (linear[i] + order * square[i])).collect()
    }

    /// Magnitude of single terms of K u.
    fn scale(system: &System, moved: &[f64], order: f64) -> f64 {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |top: f64, x| top.max(x.abs()));
        let stiffest = largest(&mut system.pairs.iter().map(|pair| pair.base[0][0] + order * order * pair.square[0]));
        stiffest * largest(&mut moved.iter().copied())
    }

    #[test]
    fn rigid_motions_cost_no_energy() {
        let (section, mesh) = two_parts(Vec::new());
        let system = System::new(&section, &mesh).unwrap();
        let shear_modulus = MATERIALS[0].youngs_modulus / (2.0 * (1.0 + MATERIALS[0].poisson_ratio));
        for (order, count) in [(0, 2), (1, 2), (2, 0)] {
            let motions = free_motions(&mesh, order);
            assert_eq!(motions.len(), count);
            for motion in motions {
                let largest =
                    forces(&system, &motion, f64::from(order)).into_iter().fold(0.0, |top: f64, f| top.max(f.abs()));
                assert!(largest < 1e-12 * scale(&system, &motion, f64::from(order)), "order {order}: {largest}");
                // Of another order the same displacements are strains of about 1/r.
                let energy = dot(&motion, &forces(&system, &motion, f64::from(order) + 1.0));
                let largest = motion.iter().fold(0.0, |top: f64, x| top.max(x.abs()));
                assert!(
                    energy > 0.1 * shear_modulus * 4e-3 * 5e-3 / 22e-3 * largest * largest,
                    "order {order}: {energy}"
                );
            }
        }
    }

    #[test]
    fn a_support_takes_away_the_motions_that_it_holds() {
        let free =
            |supports: Vec<Support>| [0, 1].map(|order| free_motions(&two_parts(supports.clone()).1, order).len());
        let at = |directions| Support::at_height(0.0, directions);
        assert_eq!(free(vec![at([false, true, false])]), [1, 1]);
        assert_eq!(free(vec![at([true, false, false])]), [2, 1]);
        assert_eq!(free(vec![at([true, true, true])]), [0, 0]);
        // Held along r on one circle the ring may still tilt about it; on two it may not.
        assert_eq!(free(vec![at([true, false, false]), Support::at_height(5e-3, [true, false, false])]), [2, 0]);
    }

    /// Patch test (B. M. Irons; Zienkiewicz and Taylor, chapter 9): under displacements of constant strain the nodes
    /// inside are in balance. In Cartesian coordinates: stretching along the axis with contraction (m = 0), shear u_x
    /// = z and u_z = x (m = 1), u_x = x with u_y = −y (m = 2).
    #[test]
    fn constant_strain_leaves_the_inside_in_balance() {
        let (section, mesh) = two_parts(Vec::new());
        let system = System::new(&section, &mesh).unwrap();
        let inside = |[r, z]: [f64; 2]| r > 20e-3 + 1e-9 && r < 24e-3 - 1e-9 && z > 1e-9 && z < 5e-3 - 1e-9;
        let greatest = |moved: &[f64], order: f64| {
            let all = forces(&system, moved, order);
            let of_node = all.chunks(DIRECTIONS).zip(&mesh.nodes).filter(|(_, node)| inside(**node));
            of_node.flat_map(|(forces, _)| forces).fold(0.0, |top: f64, f| top.max(f.abs()))
                / scale(&system, moved, order)
        };
        assert!(mesh.nodes.iter().filter(|node| inside(**node)).count() > 100);
        assert!(greatest(&field(&mesh, |r, z| [-0.3 * r, 0.0, z]), 0.0) < 1e-12);
        assert!(greatest(&field(&mesh, |_, z| [z, -z, 0.0]), 1.0) < 1e-12);
        assert!(greatest(&field(&mesh, |r, _| [0.0, 0.0, r]), 1.0) < 1e-12);
        assert!(greatest(&field(&mesh, |r, _| [r, -r, 0.0]), 2.0) < 1e-12);
        // Strain that is not constant is not in balance.
        assert!(greatest(&field(&mesh, |r, z| [r * z, 0.0, 0.0]), 0.0) > 1e-4);
    }

    #[test]
    fn stiffness_and_mass_are_symmetric_and_positive() {
        let (section, mesh) = two_parts(Vec::new());
        let system = System::new(&section, &mesh).unwrap();
        let [a, b] = [1.7, 2.3].map(|turn| (0..system.size).map(|i| (turn * i as f64).sin()).collect::<Vec<f64>>());
        for order in [2.0, 7.0, 300.0] {
            let (ab, ba) = (dot(&a, &forces(&system, &b, order)), dot(&b, &forces(&system, &a, order)));
            let aa = dot(&a, &forces(&system, &a, order));
            assert!((ab - ba).abs() < 1e-12 * aa && aa > 0.0, "{ab} {ba} {aa}");
            // Cholesky's factorisation is the proof; without a shift orders 0 and 1 of a free ring are only
            // semi-definite.
            assert!(system.factor(order, 0.0).is_ok());
        }
        assert!(
            system.factor(0.0, 1e6).is_ok() && system.factor(1.0, 1e6).is_ok() && system.factor(0.0, -1e12).is_err()
        );
        // The mass of the whole: a ring of one radian moved by 1 along its axis.
        let along = field(&mesh, |_, _| [0.0, 0.0, 1.0]);
        let inertia = system.inertia(&along);
        let exact = MATERIALS[0].density * 5e-3 * 0.5 * (24e-3_f64.powi(2) - 20e-3_f64.powi(2));
        assert!((dot(&along, &inertia) / exact - 1.0).abs() < 1e-12);
    }

    /// Nodal forces per radian of a pressure of 1 Pa on the inner face of one rectangle.
    fn inner_pressure(section: &Section, mesh: &Mesh) -> Vec<f64> {
        let mut load = vec![0.0; DIRECTIONS * mesh.nodes.len()];
        let inner = section.parts()[0].inner_radius;
        for element in &mesh.elements {
            let [at, _, bottom, top] = mesh.corners(element);
            if same(at, inner) {
                for (k, share) in [1.0, 4.0, 1.0].into_iter().enumerate() {
                    load[DIRECTIONS * element.nodes[3 * k]] += share / 6.0 * (top - bottom) * inner;
                }
            }
        }
        load
    }

    /// Thick-walled ring under internal pressure, its ends held in plane strain (Lamé; S. P. Timoshenko and J. N.
    /// Goodier, *Theory of Elasticity*, 3rd ed., §28): u = (1 + ν) a² p/(E (b² − a²)) ((1 − 2ν) r + b²/r). The work
    /// of the pressure converges with the fourth power of the size of elements.
    #[test]
    fn a_thick_ring_widens_as_lame_says() {
        let (a, b, height, steel) = (10e-3, 20e-3, 1e-3, MATERIALS[1]);
        let ends = [0.0, height].map(|z| Support::at_height(z, [false, true, true])).to_vec();
        let section = Section::rectangle((a, b), (0.0, height), steel, ends);
        let Material { youngs_modulus: e, poisson_ratio: nu, .. } = steel;
        let exact = |r: f64| (1.0 + nu) * a * a / (e * (b * b - a * a)) * ((1.0 - 2.0 * nu) * r + b * b / r);
        let mut errors = Vec::new();
        for halves in [1, 2, 4] {
            let mesh = Mesh::new(&section, None, 40, halves).unwrap();
            let system = System::new(&section, &mesh).unwrap();
            let load = inner_pressure(&section, &mesh);
            let moved = system.moved(&load, 0.0).unwrap();
            errors.push((dot(&load, &moved) / (a * height * exact(a)) - 1.0).abs());
            for (node, moved) in mesh.nodes.iter().zip(moved.chunks(DIRECTIONS)).filter(|_| halves == 4) {
                assert!(
                    (moved[0] / exact(node[0]) - 1.0).abs() < 1e-5 && moved[2].abs() < 1e-5 * exact(a),
                    "{node:?} {moved:?}"
                );
            }
        }
        assert!(errors[0] / errors[1] > 12.0 && errors[1] / errors[2] > 12.0 && errors[2] < 1e-6, "{errors:?}");
    }

    /// In-plane bending of a thin ring under q cos mθ along r (Timoshenko and Gere, *Theory of Elastic Stability*,
    /// §7.1, without extension): u_r = q R⁴/(EI (m² − 1)²).
    #[test]
    fn a_thin_ring_bends_in_its_plane() {
        let (radius, side, steel) = (0.1, 1e-3, MATERIALS[1]);
        let section = Section::rectangle((radius - 0.5 * side, radius + 0.5 * side), (0.0, side), steel, Vec::new());
        let mesh = Mesh::new(&section, None, 16, 1).unwrap();
        let system = System::new(&section, &mesh).unwrap();
        let load = inner_pressure(&section, &mesh);
        // A line load of `side` × 1 Pa at the inner radius is that much less on the middle line.
        let line = side * (radius - 0.5 * side) / radius;
        for order in [2.0_f64, 3.0, 6.0] {
            let moved = system.moved(&load, order).unwrap();
            let mean = dot(&load, &moved) / load.iter().sum::<f64>();
            let stiffness = steel.youngs_modulus * side.powi(4) / 12.0;
            let exact = line * radius.powi(4) / (stiffness * (order * order - 1.0).powi(2));
            assert!((mean / exact - 1.0).abs() < 2e-3, "order {order}: {mean} {exact}");
        }
    }
}
