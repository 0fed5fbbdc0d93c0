//! Compliance of the contact face, harmonic by harmonic.
//!
//! A pressure p cos mθ, uniform over the contact band of width w about the radius r, is a line load q cos kx with q =
//! p w, k = m/r and x = rθ. Its work is done on the mean axial displacement of the band, ū cos kx, the mean over its
//! area. C(k) = ū/q \[m²/N\], as in [`crate::rotor`].
//!
//! **All orders from a few.** The stiffness is K(m) = K₀ + m K₁ + m² K₂, and the load is the same for every order.
//! Where K(m) u = f is solved for one order, the derivatives du/dm, d²u/dm², … follow from the same factorisation.
//! The solutions of a few orders and these derivatives span those of all others (reduced basis, Rayleigh and Ritz):
//! what that leaves out is part of the stated error. Source: A. Quarteroni, A. Manzoni, F. Negri, *Reduced Basis
//! Methods for Partial Differential Equations* (2016), chapter 3.
//!
//! **The finer mesh from the coarser.** The finer mesh has all displacements of the coarser one, and the same energy for them. What it
//! adds varies from element to element, and to such displacements the stiffness of all orders is nearly the same as long as an element is short
//! beside the wave. So the coarser mesh has the few orders, and the finer one is factorised for one order between the first and the last only: what
//! the coarser solutions of a few orders leave out of balance, solved for with that, are the vectors by which the span is extended. This is one
//! step of an iteration with the stiffness of another order in place of the right one, made good by Rayleigh and Ritz: exact is the energy, not the
//! vector. What it leaves out is a share of the change from mesh to mesh.
//!
//! **Error.** Finite elements are too stiff: C is a maximum over all displacements, and the finer mesh has those of
//! the coarser one. So C grows from mesh to mesh, and the change d = C_fine − C_coarse says how far there is to go.
//! With convergence of order h² in the energy, which a corner without grading would not reach, d/3 is left: it is
//! added, and is the stated error as well.
//!
//! **The local part.** Where k is large, only what is within 1/k of the contact deforms. The ring is then an elastic
//! half-space, which a pressure p cos kx over a band of width w deflects by
//!
//! ```text
//! C(k) = 4 (1 − ν²)/(π E w²) ∫₀ʷ (w − s) K₀(ks) ds  →  2 (1 − ν²)/(E k w) · (1 − 2/(π k w))        k w ≫ 1
//! ```
//!
//! because ∫ (1 − ν²)/(π E ρ) cos kx dx of Boussinesq's point load is 2 (1 − ν²)/(π E) K₀(k|y|), and ∫₀^∞ K₀ = π/2.
//! Harmonics that the mesh does not resolve continue the last one that it does in this proportion.

use super::element::DIRECTIONS;
use super::mesh::{Halved, Mesh};
use super::section::{Band, RingError, Section};
use super::solve::{Factor, System, cancelled, contact_load, free_motions};
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::numerics::dot;
use nalgebra::{Cholesky, DMatrix, DVector};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// From a mesh and one with elements half as large.
pub(super) fn of_two_meshes(coarse: f64, fine: f64) -> Estimate {
    let rest = (fine - coarse) / 3.0;
    Estimate { value: fine + rest, error: rest.abs() }
}

/// The compliance of each harmonic of the wave.
#[derive(Clone, Debug, PartialEq)]
pub struct RingCompliances {
    /// C(k_n) \[m²/N\] for n = 1, 2, …: order m = waves·n, wavenumber k_n = waves·n/r. All that were asked for.
    pub harmonics: Vec<Estimate>,
    /// How many of them the finite elements resolve. Beyond, each continues the last that is resolved as an elastic
    /// half-space under the same band does: the local part, which no longer depends on the shape of the section.
    pub resolved: usize,
}

/// How the section moves under a line load of 1 N/m (amplitude) of one order, node by node of [`Section::mesh`]:
/// displacements per unit line load \[m²/N\], u_r = `radial` cos mθ, u_θ = `circumferential` sin mθ, u_z = `axial`
/// cos mθ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Deflection {
    /// Amplitude U of the radial deflection, for each node.
    pub radial: Vec<f64>,
    /// Amplitude V of the circumferential deflection.
    pub circumferential: Vec<f64>,
    /// Amplitude W of the axial deflection.
    pub axial: Vec<f64>,
}

/// Greatest k times the depth to which the contact is resolved ([`Section::depth`]): the half-space differs from
/// there on by less than e⁻⁸.
const RESOLVED: f64 = 8.0;
/// Greatest ratio of neighbouring orders that are solved.
const SAMPLED: f64 = 5.0;
/// The solution and its derivatives by the order that are taken of each.
const DERIVATIVES: usize = 4;
/// Bound of the relative error of a compliance from these; a test asserts it.
const LEFT_OUT: f64 = 1e-5;
/// Orders at which the finer mesh is corrected.
const CORRECTED: usize = 7;
/// Vectors that are solved for, or multiplied, together.
const TOGETHER: usize = 4;
/// A vector that is this small without its part along the others, relative, adds nothing.
const DEPENDENT: f64 = 1e-10;

impl Section {
    /// Compliances of the first `count` harmonics of a wave that goes `waves` times round the ring, on the contact
    /// `band`, from meshes with so many `times` the usual number of elements.
    ///
    /// # Errors
    /// [`RingError`] if the band is not within the lowest face, if `waves` = 1 and nothing holds the ring
    /// against tilting, if the mesh would be too large, or if it is cancelled.
    pub fn compliances(
        &self,
        band: Band,
        waves: u32,
        count: usize,
        times: usize,
        cancel: &Cancel,
    ) -> Result<RingCompliances, RingError> {
        self.check_band(band)?;
        let first = f64::from(waves);
        let last = RESOLVED * band.radius / self.depth(band);
        let resolved = ((last / first) as usize).clamp(1, count.max(1));
        let last = first * resolved as f64;
        let meshes = self.meshes(Some(band), times)?;
        self.check_held(&meshes[0], waves)?;
        let [coarse, fine] = &meshes;
        let loads = [coarse, fine].map(|mesh| contact_load(self, mesh, band));
        let (base, finer) = rayon::join(
            || Reduced::new(&System::new(self, coarse)?, &loads[0], &samples(first, last), cancel),
            || {
                let system = System::new(self, fine)?;
                cancelled(cancel)?;
                let factor = system.factor((first * last).sqrt(), 0.0)?;
                Ok((system, factor))
            },
        );
        let (base, (system, factor)) = (base?, finer?);
        let halved = Halved::new(coarse, fine);
        let refined = base.refined(&system, &factor, &loads[1], &halved, &corrected(first, last), cancel)?;
        let (coarse, fine) = (&base.equations, &refined);
        let mut harmonics = Vec::with_capacity(count);
        for n in 1..=count.min(resolved) {
            let order = first * n as f64;
            let [coarse, fine] = [coarse.compliance(order)?, fine.compliance(order)?].map(|work| work / band.radius);
            let mut found = of_two_meshes(coarse, fine);
            let left_out = not_refined(order / last);
            found.error += LEFT_OUT * found.value + 4.0 / 3.0 * left_out / (1.0 - left_out) * (fine - coarse).abs();
            harmonics.push(found);
        }
        if let Some(known) = harmonics.last().copied() {
            let local = |n: usize| {
                let kw = first * n as f64 * band.width / band.radius;
                (1.0 / kw, 1.0 - 2.0 / (std::f64::consts::PI * kw.max(1.0)))
            };
            let (from, from_edges) = local(resolved);
            harmonics.extend((resolved + 1..=count).map(|n| {
                let (share, edges) = local(n);
                let value = known.value * share * edges / (from * from_edges);
                Estimate { value, error: value * (known.error / known.value + (edges / from_edges - 1.0).abs()) }
            }));
        }
        Ok(RingCompliances { harmonics, resolved })
    }

    /// How the section moves under a unit line load of each of the `orders` on the contact `band`.
    ///
    /// # Errors
    /// As [`Section::compliances`].
    pub fn deflections(&self, band: Band, orders: &[u32], cancel: &Cancel) -> Result<Vec<Deflection>, RingError> {
        let mesh = self.mesh(band)?;
        orders.iter().try_for_each(|order| self.check_held(&mesh, *order))?;
        let system = System::new(self, &mesh)?;
        let load = contact_load(self, &mesh, band);
        let of_order = |order: &u32| {
            cancelled(cancel)?;
            let moved = system.moved(&load, f64::from(*order))?;
            let direction = |d: usize| moved.iter().skip(d).step_by(DIRECTIONS).copied().collect();
            Ok(Deflection { radial: direction(0), circumferential: direction(1), axial: direction(2) })
        };
        orders.iter().map(of_order).collect()
    }

    /// Whether the supports hold the ring against the rigid motions of an order that a contact pressure may set off.
    fn check_held(&self, mesh: &Mesh, order: u32) -> Result<(), RingError> {
        let free = free_motions(mesh, order);
        let lifted = free.iter().any(|motion| motion.iter().skip(2).step_by(DIRECTIONS).any(|axial| *axial != 0.0));
        match order {
            0 if lifted => {
                Err(RingError::Free { motion: "moving along its axis", allowed: "fix it axially somewhere" })
            }
            1 if !free.is_empty() => Err(RingError::Free {
                motion: "tilting and moving sideways, which a single wave round the ring makes it do",
                allowed: "fix it axially and radially somewhere",
            }),
            _ => Ok(()),
        }
    }
}

/// Greatest share of the change from mesh to mesh that the corrections miss, at an order that is this share of the last: a test asserts it.
fn not_refined(share: f64) -> f64 {
    0.03 + 0.22 * share
}

/// The orders at which the finer mesh is corrected, from `first` to `last`: nearer to each other where waves are as short as elements.
fn corrected(first: f64, last: f64) -> Vec<f64> {
    let count = if last > first { CORRECTED } else { 1 };
    let left = |i: usize| 1.0 - i as f64 / (count - 1).max(1) as f64;
    (0..count).map(|i| first * (last / first).powf(1.0 - left(i).powf(1.3))).collect()
}

/// The orders that are solved on the way from `first` to `last`, each the same multiple of the one before.
fn samples(first: f64, last: f64) -> Vec<f64> {
    let count = 1 + ((last / first).ln() / SAMPLED.ln()).ceil().max(0.0) as usize;
    (0..count).map(|i| first * (last / first).powf(i as f64 / (count - 1).max(1) as f64)).collect()
}

/// The equations for the displacements that a few vectors span.
struct Spanned {
    /// K₀, K₁, K₂.
    stiffness: [DMatrix<f64>; 3],
    load: DVector<f64>,
}

impl Spanned {
    /// The share of each vector in the solution of an order.
    fn shares(&self, order: f64) -> Result<DVector<f64>, RingError> {
        let [constant, linear, square] = &self.stiffness;
        let stiffness = constant + linear * order + square * (order * order);
        let factor = Cholesky::new(stiffness).ok_or(RingError::Singular { order: order as u32 })?;
        Ok(factor.solve(&self.load))
    }

    /// The work of the load of 1 N/m, which is the compliance times the contact radius \[m³/N\].
    fn compliance(&self, order: f64) -> Result<f64, RingError> {
        Ok(self.load.dot(&self.shares(order)?))
    }
}

/// The equations of a mesh for the displacements that the solutions of a few orders span.
struct Reduced {
    basis: Vec<Vec<f64>>,
    equations: Spanned,
}

impl Reduced {
    fn new(system: &System, load: &[f64], orders: &[f64], cancel: &Cancel) -> Result<Self, RingError> {
        let solved: Result<Vec<_>, RingError> =
            orders.par_iter().map(|order| derivatives(system, load, *order, cancel)).collect();
        let basis = independent(solved?.into_iter().flatten());
        let products = products(system, &basis);
        let size = basis.len();
        let stiffness =
            std::array::from_fn(|part| DMatrix::from_fn(size, size, |i, j| dot(&basis[i], &products[j][part])));
        let load = DVector::from_iterator(size, basis.iter().map(|vector| dot(vector, load)));
        Ok(Self { basis, equations: Spanned { stiffness, load } })
    }

    /// The equations of the mesh with `halved` elements, a `factor` of which is that of one order between the first and the last, for what
    /// the vectors of this one and their corrections at `orders` span.
    fn refined(
        &self,
        system: &System,
        factor: &Factor,
        load: &[f64],
        halved: &Halved,
        orders: &[f64],
        cancel: &Cancel,
    ) -> Result<Spanned, RingError> {
        let unbalanced = |orders: &[f64]| {
            cancelled(cancel)?;
            let mut moved = vec![vec![0.0; halved.size()]; orders.len()];
            for (moved, order) in moved.iter_mut().zip(orders) {
                for (vector, share) in self.basis.iter().zip(&self.equations.shares(*order)?) {
                    moved.iter_mut().zip(vector).for_each(|(x, y)| *x += share * y);
                }
            }
            let moved: Vec<Vec<f64>> = moved.iter().map(|moved| halved.finer(moved)).collect();
            let forces = system.products(&moved.iter().map(Vec::as_slice).collect::<Vec<_>>());
            let left = |(order, [constant, linear, square]): (&f64, &[Vec<f64>; 3])| {
                let forces = constant.iter().zip(linear).zip(square).map(|((c, l), s)| c + order * (l + order * s));
                load.iter().zip(forces).map(|(load, force)| load - force).collect::<Vec<f64>>()
            };
            Ok(orders.iter().zip(&forces).map(left).collect::<Vec<_>>())
        };
        let unbalanced: Vec<Vec<Vec<f64>>> =
            orders.par_chunks(TOGETHER).map(unbalanced).collect::<Result<_, RingError>>()?;
        let together = |some: &[Vec<f64>]| {
            cancelled(cancel)?;
            let mut moved = some.concat();
            factor.solve(&mut moved, some.len())?;
            Ok(moved.chunks(system.size).map(<[f64]>::to_vec).collect::<Vec<_>>())
        };
        let corrections: Result<Vec<_>, RingError> = unbalanced.par_iter().map(|some| together(some)).collect();
        let corrections = independent(corrections?.into_iter().flatten());
        let forces: Vec<_> = products(system, &corrections)
            .into_par_iter()
            .map(|parts| parts.map(|force| (halved.coarser(&force), force)))
            .collect();
        // Of displacements that both meshes have, both have the same energy.
        let (known, size) = (self.basis.len(), self.basis.len() + corrections.len());
        let stiffness = std::array::from_fn(|part| {
            let mut all = self.equations.stiffness[part].clone().resize(size, size, 0.0);
            for (j, forces) in forces.iter().enumerate() {
                let (coarser, force) = &forces[part];
                for i in 0..size {
                    let work =
                        if i < known { dot(&self.basis[i], coarser) } else { dot(&corrections[i - known], force) };
                    (all[(i, known + j)], all[(known + j, i)]) = (work, work);
                }
            }
            all
        });
        let of_corrections = corrections.iter().map(|vector| dot(vector, load));
        let load = DVector::from_iterator(size, self.equations.load.iter().copied().chain(of_corrections));
        Ok(Spanned { stiffness, load })
    }
}

/// The vectors at right angles to each other and of length 1, without those that depend on the ones before.
fn independent(vectors: impl Iterator<Item = Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut vector in vectors {
        let norm = |vector: &[f64]| dot(vector, vector).sqrt();
        let before = norm(&vector);
        // Twice is enough (Giraud and others, Numer. Math. 101 (2005) 87).
        for _ in 0..2 {
            for other in &basis {
                let part = dot(&vector, other);
                vector.iter_mut().zip(other).for_each(|(x, y)| *x -= part * y);
            }
        }
        let left = norm(&vector);
        if left > DEPENDENT * before {
            vector.iter_mut().for_each(|x| *x /= left);
            basis.push(vector);
        }
    }
    basis
}

/// The products of each vector with the three parts of the stiffness.
fn products(system: &System, vectors: &[Vec<f64>]) -> Vec<[Vec<f64>; 3]> {
    let some = |some: &[Vec<f64>]| system.products(&some.iter().map(Vec::as_slice).collect::<Vec<_>>());
    vectors.par_chunks(TOGETHER).flat_map_iter(some).collect()
}

/// The solution of one order and its derivatives by the order.
fn derivatives(system: &System, load: &[f64], order: f64, cancel: &Cancel) -> Result<Vec<Vec<f64>>, RingError> {
    cancelled(cancel)?;
    let factor = system.factor(order, 0.0)?;
    let mut found: Vec<Vec<f64>> = Vec::new();
    let (mut pushed, mut before) = (load.to_vec(), vec![0.0; load.len()]);
    factor.solve(&mut pushed, 1)?;
    for n in 1..DERIVATIVES {
        // K u⁽ⁿ⁾ = −n K′ u⁽ⁿ⁻¹⁾ − n(n − 1)/2 K″ u⁽ⁿ⁻²⁾, K′ = K₁ + 2m K₂, K″ = 2 K₂.
        let [_, linear, square] = &system.products(&[&pushed])[0];
        found.push(pushed);
        let n = n as f64;
        pushed = linear.iter().zip(square).map(|(l, s)| -n * (l + 2.0 * order * s)).collect();
        pushed.iter_mut().zip(&before).for_each(|(x, s)| *x -= n * (n - 1.0) * s);
        before.clone_from(square);
        factor.solve(&mut pushed, 1)?;
    }
    found.push(pushed);
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::gauss_legendre;
    use crate::rotor::ring::section::{MATERIALS, Material, Part, Support};

    fn rubbery(name: &'static str, youngs_modulus: f64, poisson_ratio: f64) -> Material {
        Material { name, youngs_modulus, poisson_ratio, density: 1000.0, yield_stress: 1e6 }
    }

    /// Out-of-plane bending of a thin ring of square section under q cos mθ, which twists it as well: with bending
    /// curvature β/R − w″/R² and twist β′/R + w′/R² (A. E. H. Love, *Treatise*, §293) the energy is least for C = R⁴
    /// (EI + m² GJ)/(EI GJ m² (m² − 1)²), J = 0.140577 a⁴ (Timoshenko and Goodier, §109).
    #[test]
    fn a_thin_ring_bends_and_twists_out_of_its_plane() {
        let (radius, side, steel) = (0.1_f64, 1e-3_f64, MATERIALS[1]);
        let section = Section::rectangle((radius - 0.5 * side, radius + 0.5 * side), (0.0, side), steel, Vec::new());
        let found = section.compliances(Band { radius, width: side }, 2, 3, 1, &Cancel::new()).unwrap();
        let bending = steel.youngs_modulus * side.powi(4) / 12.0;
        let torsion = steel.youngs_modulus / (2.0 * (1.0 + steel.poisson_ratio)) * 0.140_577 * side.powi(4);
        for (n, found) in found.harmonics.iter().enumerate() {
            let m2 = (2.0 * (n as f64 + 1.0)).powi(2);
            let exact = radius.powi(4) * (bending + m2 * torsion) / (bending * torsion * m2 * (m2 - 1.0).powi(2));
            assert!((found.value / exact - 1.0).abs() < 2e-3 && found.error < 1e-3 * exact, "{n}: {found:?} {exact}");
        }
    }

    /// A beam on an elastic foundation, C = 1/(EI k⁴/(1 + EI k²/(κGA)) + K), the limit of a ring so large that a wave
    /// hardly bends round it: a stiff ring of square section under a soft one that is held at its top, K = E b/h (M.
    /// Hetényi, *Beams on Elastic Foundation*; shear after Timoshenko with κ = 5/6).
    #[test]
    fn a_large_ring_on_a_soft_layer_is_a_beam_on_an_elastic_foundation() {
        let (radius, side, layer) = (10.0_f64, 10e-3_f64, 2e-3);
        let (beam, soft) = (rubbery("beam", 200e9, 0.0), rubbery("soft", 1.33e6, 0.0));
        let radii = (radius - 0.5 * side, radius + 0.5 * side);
        let parts =
            vec![Part::of("beam", radii, (0.0, side), beam), Part::of("layer", radii, (side, side + layer), soft)];
        let held = Support::at_height(side + layer, [true, true, true]);
        let section = Section::new(parts, vec![held]).unwrap();
        let found = section.compliances(Band { radius, width: side }, 25, 8, 1, &Cancel::new()).unwrap();
        let (bending, foundation) = (200e9 * side.powi(4) / 12.0, 1.33e6 * side / layer);
        let shear = 5.0 / 6.0 * 100e9 * side * side;
        for (n, found) in found.harmonics.iter().enumerate() {
            let k = 25.0 * (n as f64 + 1.0) / radius;
            let exact = 1.0 / (bending * k.powi(4) / (1.0 + bending * k * k / shear) + foundation);
            assert!((found.value / exact - 1.0).abs() < 5e-3, "k = {k}: {found:?} {exact}");
        }
    }

    /// K₀(x) = ∫₀^∞ exp(−x cosh t) dt (Abramowitz and Stegun 9.6.24).
    fn bessel_k0(x: f64) -> f64 {
        let end = (40.0 / x + 1.0).acosh();
        let step = end / 20.0;
        (0..20).map(|i| gauss_legendre(step * i as f64, step * (i as f64 + 1.0), |t| (-x * t.cosh()).exp())).sum()
    }

    /// C of the half-space as the module says, the integral over s = w t⁴, which takes the logarithm out of K₀ at 0.
    fn half_space(material: &Material, k: f64, width: f64) -> f64 {
        let Material { youngs_modulus, poisson_ratio, .. } = *material;
        let of = |t: f64| {
            let s = width * t.powi(4);
            (width - s) * bessel_k0(k * s) * 4.0 * width * t.powi(3)
        };
        let integral: f64 = (0..8).map(|i| gauss_legendre(0.125 * f64::from(i), 0.125 * f64::from(i + 1), of)).sum();
        4.0 * (1.0 - poisson_ratio * poisson_ratio) / (std::f64::consts::PI * youngs_modulus * width * width) * integral
    }

    #[test]
    fn the_half_space_is_what_the_module_says_for_short_waves() {
        let (material, width) = (MATERIALS[0], 1e-3);
        for kw in [4.0, 8.0, 16.0] {
            let k = kw / width;
            let Material { youngs_modulus, poisson_ratio, .. } = material;
            let short = 2.0 * (1.0 - poisson_ratio * poisson_ratio) / (youngs_modulus * kw)
                * (1.0 - 2.0 / (std::f64::consts::PI * kw));
            let off = half_space(&material, k, width) / short - 1.0;
            assert!(off.abs() < (-kw).exp(), "kw = {kw}: {off}");
        }
    }

    #[test]
    fn a_large_block_is_a_half_space_to_short_waves() {
        let (radius, width, aluminium) = (1.0, 1e-3, MATERIALS[0]);
        let held = Support::at_height(10e-3, [true, true, true]);
        let section = Section::rectangle((radius - 10e-3, radius + 10e-3), (0.0, 10e-3), aluminium, vec![held]);
        let found = section.compliances(Band { radius, width }, 1500, 8, 1, &Cancel::new()).unwrap();
        // k w = 1.5, 3, … 7.5; from k w = 8 on the local part.
        assert_eq!(found.resolved, 5);
        for (n, found) in found.harmonics.iter().enumerate() {
            let exact = half_space(&aluminium, 1500.0 * (n as f64 + 1.0), width);
            let off = (found.value - exact).abs();
            assert!(off < 2e-3 * exact && off < 2.0 * found.error + 3e-4 * exact, "{n}: {found:?} {exact}");
        }
    }

    /// A flange with a rib below it and a body beside it.
    fn rotor() -> (Section, Band) {
        let parts = vec![
            Part::in_mm("rib", (28.85, 29.15), (0.0, 1.0)),
            Part::in_mm("flange", (27.0, 29.15), (1.0, 1.5)),
            Part::in_mm("body", (25.0, 27.0), (1.0, 6.0)),
        ];
        (Section::new(parts, Vec::new()).unwrap(), Band { radius: 29e-3, width: 0.3e-3 })
    }

    /// The elements of the same section are moved, so that what they leave of C is nearly the same however small the step is.
    #[test]
    fn on_moved_elements_a_derivative_does_not_depend_on_the_step() {
        let (middle, band) = rotor();
        let with = |change: f64, moved: bool| {
            let mut parts = middle.parts().to_vec();
            parts[2].inner_radius *= 1.0 + change;
            parts[2].top *= 1.0 + change;
            let section = Section::new(parts, Vec::new()).unwrap();
            assert!(section.is_meshed_like(band, &middle, band).unwrap());
            let section = if moved { section.meshed_as(&middle, band) } else { section };
            section.compliances(band, 7, 1, 1, &Cancel::new()).unwrap().harmonics[0].value
        };
        let slope = |step: f64, moved: bool| (with(step, moved) - with(-step, moved)) / (2.0 * step);
        let [short, long] = [1e-5, 1e-3].map(|step| slope(step, true));
        assert!((short / long - 1.0).abs() < 5e-3, "{short} {long}");
        // Not moved they are those of the section itself.
        assert_eq!(with(0.0, true), with(0.0, false));
        let mut torn = middle.parts().to_vec();
        torn[2].bottom -= 1e-5;
        let torn = Section::new(torn, Vec::new()).unwrap();
        assert!(!torn.is_meshed_like(band, &middle, band).unwrap());
        let other = torn.meshed_as(&middle, band).compliances(band, 7, 1, 1, &Cancel::new()).unwrap();
        assert_eq!(other, torn.compliances(band, 7, 1, 1, &Cancel::new()).unwrap());
    }

    #[test]
    fn a_few_orders_stand_for_all() {
        let (section, band) = rotor();
        stands_for_all(&section, band, 7.0);
        stands_for_all(&section, band, 2.0);
        // On a soft lining.
        let mut parts = section.parts().to_vec();
        parts[0].material = MATERIALS[3];
        stands_for_all(&Section::new(parts, Vec::new()).unwrap(), band, 7.0);
    }

    fn stands_for_all(section: &Section, band: Band, first: f64) {
        let mesh = Mesh::new(section, Some(band), 200, 1).unwrap();
        let system = System::new(section, &mesh).unwrap();
        let load = contact_load(section, &mesh, band);
        let last = RESOLVED * band.radius / section.depth(band);
        let reduced = Reduced::new(&system, &load, &samples(first, last), &Cancel::new()).unwrap().equations;
        for n in [1, 2, 3, 4, 6, 9, 14, 20, 30, 45, 70, 100] {
            let order = first * f64::from(n);
            let moved = system.moved(&load, order).unwrap();
            let off = 1.0 - reduced.compliance(order).unwrap() / dot(&load, &moved);
            // From below, as of every part of the displacements.
            assert!(off > -1e-8 && off < LEFT_OUT, "order {order}: {off}");
        }
    }

    #[test]
    fn one_factorisation_of_the_finer_mesh_stands_for_all_orders() {
        let (section, band) = rotor();
        let meshes = [1, 2].map(|halves| Mesh::new(&section, Some(band), 200, halves).unwrap());
        let systems = [0, 1].map(|i| System::new(&section, &meshes[i]).unwrap());
        let loads = [0, 1].map(|i| contact_load(&section, &meshes[i], band));
        let (first, last) = (7.0, RESOLVED * band.radius / section.depth(band));
        let coarse = Reduced::new(&systems[0], &loads[0], &samples(first, last), &Cancel::new()).unwrap();
        let factor = systems[1].factor((first * last).sqrt(), 0.0).unwrap();
        let halved = Halved::new(&meshes[0], &meshes[1]);
        let orders = corrected(first, last);
        let refined = coarse.refined(&systems[1], &factor, &loads[1], &halved, &orders, &Cancel::new()).unwrap();
        for n in [1, 2, 3, 4, 6, 9, 14, 20, 30, 45, 70, 100] {
            let order = first * f64::from(n);
            let moved = systems[1].moved(&loads[1], order).unwrap();
            let (full, known) = (dot(&loads[1], &moved), coarse.equations.compliance(order).unwrap());
            let left_out = (full - refined.compliance(order).unwrap()) / (full - known);
            assert!((-1e-4..not_refined(order / last)).contains(&left_out), "order {order}: {left_out}");
        }
    }

    #[test]
    fn the_finer_mesh_has_the_displacements_of_the_coarser_one_at_the_same_energy() {
        let (section, band) = rotor();
        let held = Support::at_height(6e-3, [true, false, true]);
        let section = Section::new(section.parts().to_vec(), vec![held]).unwrap();
        let meshes = [1, 2].map(|halves| Mesh::new(&section, Some(band), 200, halves).unwrap());
        let halved = Halved::new(&meshes[0], &meshes[1]);
        let energy = |i: usize, moved: &[f64]| {
            let [constant, linear, square] = &System::new(&section, &meshes[i]).unwrap().products(&[moved])[0];
            (0..moved.len()).map(|i| moved[i] * (constant[i] + 7.0 * (linear[i] + 7.0 * square[i]))).sum::<f64>()
        };
        let held = meshes[0].held.iter().flatten().enumerate();
        let moved: Vec<f64> = held.map(|(i, held)| if *held { 0.0 } else { (1.7 * i as f64).sin() }).collect();
        let finer = halved.finer(&moved);
        assert!((energy(1, &finer) / energy(0, &moved) - 1.0).abs() < 1e-12);
        // The same work of the same load.
        let loads = [0, 1].map(|i| contact_load(&section, &meshes[i], band));
        let works = [dot(&loads[0], &moved), dot(&loads[1], &finer), dot(&halved.coarser(&loads[1]), &moved)];
        assert!(works.iter().all(|work| (work / works[0] - 1.0).abs() < 1e-12), "{works:?}");
    }

    #[test]
    fn the_stated_error_covers_what_a_finer_mesh_finds() {
        let (section, band) = rotor();
        let found = section.compliances(band, 7, 100, 1, &Cancel::new()).unwrap();
        let denser = section.compliances(band, 7, 100, 4, &Cancel::new()).unwrap();
        let mesh = Mesh::new(&section, Some(band), 8000, 2).unwrap();
        let system = System::new(&section, &mesh).unwrap();
        let load = contact_load(&section, &mesh, band);
        for n in [1, 2, 3, 5, 8, 16, 32, 64, 100] {
            let moved = system.moved(&load, 7.0 * n as f64).unwrap();
            let finer = dot(&load, &moved) / band.radius;
            let Estimate { value, error } = found.harmonics[n - 1];
            assert!((value - finer).abs() < 1.5 * error && error < 2e-3 * value, "{n}: {value} ± {error}, {finer}");
            let Estimate { value, error } = denser.harmonics[n - 1];
            assert!((value - finer).abs() < error && error < 4e-4 * value, "{n}: {value} ± {error}, {finer}");
        }
    }

    #[test]
    fn bits_do_not_depend_on_the_number_of_threads() {
        let (section, band) = rotor();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| section.compliances(band, 7, 40, 1, &Cancel::new())).unwrap()
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn it_can_be_cancelled() {
        let (section, band) = rotor();
        let cancel = Cancel::new();
        cancel.cancel();
        assert_eq!(section.compliances(band, 7, 40, 1, &cancel), Err(RingError::Cancelled));
        assert_eq!(section.natural_frequencies(&[7], 1, &cancel), Err(RingError::Cancelled));
    }

    #[test]
    fn what_cannot_be_answered_is_refused_with_what_is_allowed() {
        let (section, band) = rotor();
        let beside =
            section.compliances(Band { radius: 28e-3, ..band }, 7, 4, 1, &Cancel::new()).unwrap_err().to_string();
        assert!(
            beside.contains("from r = 27.85 to 28.15 mm") && beside.contains("allowed 28.85 to 29.15 mm"),
            "{beside}"
        );
        let tilting = section.compliances(band, 1, 4, 1, &Cancel::new()).unwrap_err().to_string();
        assert!(tilting.contains("tilting") && tilting.contains("fix it axially and radially"), "{tilting}");
        let lifted = section.deflections(band, &[0], &Cancel::new()).unwrap_err().to_string();
        assert!(lifted.contains("along its axis"), "{lifted}");
        assert!(section.compliances(band, 7, 0, 1, &Cancel::new()).unwrap().harmonics.is_empty());
    }

    #[test]
    fn the_deflection_does_the_work_of_the_compliance() {
        let (section, band) = rotor();
        let (mesh, moved) =
            (section.mesh(band).unwrap(), section.deflections(band, &[14], &Cancel::new()).unwrap().swap_remove(0));
        let at =
            |r: f64| mesh.nodes.iter().position(|node| (node[0] - r).abs() < 1e-9 && node[1].abs() < 1e-9).unwrap();
        let compliance = section.compliances(band, 7, 2, 1, &Cancel::new()).unwrap().harmonics[1].value;
        let edges = [28.85e-3, 29.15e-3].map(|r| moved.axial[at(r)]);
        assert!(
            edges[0].min(edges[1]) < compliance && compliance < 1.1 * edges[0].max(edges[1]),
            "{edges:?} {compliance}"
        );
    }
}
