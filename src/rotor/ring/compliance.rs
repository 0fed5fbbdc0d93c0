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
use super::mesh::Mesh;
use super::section::{Band, RingError, Section};
use super::solve::{System, contact_load, free_motions};
use crate::numerics::dot;
use nalgebra::{Cholesky, DMatrix, DVector};
use rayon::prelude::*;

/// A number and its estimated absolute numerical error, in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stated {
    /// The number.
    pub value: f64,
    /// Estimated error of `value`.
    pub error: f64,
}

impl Stated {
    /// From a mesh and one with elements half as large.
    pub(super) fn extrapolated(coarse: f64, fine: f64) -> Self {
        let rest = (fine - coarse) / 3.0;
        Self { value: fine + rest, error: rest.abs() }
    }
}

/// The compliance of each harmonic of the wave.
#[derive(Clone, Debug, PartialEq)]
pub struct RingCompliances {
    /// C(k_n) \[m²/N\] for n = 1, 2, …: order m = waves·n, wavenumber k_n = waves·n/r. All that were asked for.
    pub harmonics: Vec<Stated>,
    /// How many of them the finite elements resolve. Beyond, each continues the last that is resolved as an elastic
    /// half-space under the same band does: the local part, which no longer depends on the shape of the section.
    pub resolved: usize,
    /// Elements of the finer mesh.
    pub elements: usize,
}

/// How the section moves under a line load of 1 N/m (amplitude) of one order, node by node of [`Section::mesh`]:
/// displacements per unit line load \[m²/N\], u_r = `radial` cos mθ, u_θ = `circumferential` sin mθ, u_z = `axial`
/// cos mθ.
#[derive(Clone, Debug, PartialEq)]
pub struct Deflection {
    /// U.
    pub radial: Vec<f64>,
    /// V.
    pub circumferential: Vec<f64>,
    /// W.
    pub axial: Vec<f64>,
}

/// Greatest k times the depth to which the contact is resolved ([`Section::depth`]): the half-space differs from
/// there on by less than e⁻⁸.
const RESOLVED: f64 = 8.0;
/// Orders that are solved on the way from the first to the last.
const SAMPLES: usize = 4;
/// The solution and its derivatives by the order that are taken of each.
const DERIVATIVES: usize = 5;
/// What these leave out of a compliance at most, relative: a test asserts it.
const LEFT_OUT: f64 = 1e-5;
/// A vector that is this small without its part along the others, relative, adds nothing.
const DEPENDENT: f64 = 1e-10;

impl Section {
    /// Compliances of the first `count` harmonics of a wave that goes `waves` times round the ring, on the contact
    /// `band`.
    ///
    /// # Errors
    /// [`RingError`] if the band is not within the lowest face, if `waves` = 1 and nothing holds the ring
    /// against tilting, or if the mesh would be too large.
    pub fn compliances(&self, band: Band, waves: u32, count: usize) -> Result<RingCompliances, RingError> {
        self.check_band(band)?;
        let first = f64::from(waves);
        let last = RESOLVED * band.radius / self.depth(band);
        let resolved = ((last / first) as usize).clamp(1, count.max(1));
        let last = first * resolved as f64;
        let orders = samples(first, last);
        let meshes = self.meshes(Some(band))?;
        self.check_held(&meshes[0], waves)?;
        let [coarse, fine] = &meshes;
        let reduced = |mesh: &Mesh| Reduced::new(self, mesh, band, &orders);
        let (coarse, fine) = rayon::join(|| reduced(coarse), || reduced(fine));
        let (coarse, fine) = (coarse?, fine?);
        let mut harmonics = Vec::with_capacity(count);
        for n in 1..=count.min(resolved) {
            let order = first * n as f64;
            let mut found = Stated::extrapolated(coarse.compliance(order)?, fine.compliance(order)?);
            found.error += LEFT_OUT * found.value;
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
                Stated { value, error: value * (known.error / known.value + (edges / from_edges - 1.0).abs()) }
            }));
        }
        Ok(RingCompliances { harmonics, resolved, elements: meshes[1].elements.len() })
    }

    /// How the section moves under a unit line load of order `order` on the contact `band`.
    ///
    /// # Errors
    /// As [`Section::compliances`].
    pub fn deflection(&self, band: Band, order: u32) -> Result<Deflection, RingError> {
        let mesh = self.mesh(band)?;
        self.check_held(&mesh, order)?;
        let system = System::new(self, &mesh)?;
        let mut moved = contact_load(self, &mesh, band);
        system.factor(f64::from(order), 0.0)?.solve(&mut moved, 1)?;
        let direction = |d: usize| moved.iter().skip(d).step_by(DIRECTIONS).copied().collect();
        Ok(Deflection { radial: direction(0), circumferential: direction(1), axial: direction(2) })
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

/// The orders that are solved on the way from `first` to `last`, each the same multiple of the one before.
fn samples(first: f64, last: f64) -> Vec<f64> {
    let count = if last > first { SAMPLES } else { 1 };
    (0..count).map(|i| first * (last / first).powf(i as f64 / (count - 1).max(1) as f64)).collect()
}

/// The equations of a mesh for the displacements that a few orders span.
struct Reduced {
    /// K₀, K₁, K₂.
    stiffness: [DMatrix<f64>; 3],
    load: DVector<f64>,
    radius: f64,
}

impl Reduced {
    fn new(section: &Section, mesh: &Mesh, band: Band, orders: &[f64]) -> Result<Self, RingError> {
        let system = System::new(section, mesh)?;
        let load = contact_load(section, mesh, band);
        let solved: Result<Vec<_>, RingError> =
            orders.par_iter().map(|order| derivatives(&system, &load, *order)).collect();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for mut vector in solved?.into_iter().flatten() {
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
        let size = basis.len();
        let products: Vec<_> = basis.par_iter().map(|vector| system.products(vector)).collect();
        let stiffness =
            std::array::from_fn(|part| DMatrix::from_fn(size, size, |i, j| dot(&basis[i], &products[j][part])));
        let load = DVector::from_iterator(size, basis.iter().map(|vector| dot(vector, &load)));
        Ok(Self { stiffness, load, radius: band.radius })
    }

    fn compliance(&self, order: f64) -> Result<f64, RingError> {
        let [constant, linear, square] = &self.stiffness;
        let stiffness = constant + linear * order + square * (order * order);
        let factor = Cholesky::new(stiffness).ok_or(RingError::Singular { order: order as u32 })?;
        Ok(self.load.dot(&factor.solve(&self.load)) / self.radius)
    }
}

/// The solution of one order and its derivatives by the order.
fn derivatives(system: &System, load: &[f64], order: f64) -> Result<Vec<Vec<f64>>, RingError> {
    let factor = system.factor(order, 0.0)?;
    let mut found: Vec<Vec<f64>> = Vec::new();
    let (mut pushed, mut before) = (load.to_vec(), vec![0.0; load.len()]);
    for derivative in 0..DERIVATIVES {
        factor.solve(&mut pushed, 1)?;
        found.push(pushed);
        // K u⁽ⁿ⁾ = −n K′ u⁽ⁿ⁻¹⁾ − n(n − 1)/2 K″ u⁽ⁿ⁻²⁾, K′ = K₁ + 2m K₂, K″ = 2 K₂.
        let n = (derivative + 1) as f64;
        let [_, linear, square, _] = system.products(&found[derivative]);
        pushed = linear.iter().zip(&square).map(|(l, s)| -n * (l + 2.0 * order * s)).collect();
        pushed.iter_mut().zip(&before).for_each(|(x, s)| *x -= n * (n - 1.0) * s);
        before = square;
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::gauss_legendre;
    use crate::rotor::ring::section::{MATERIALS, Material, Part, Support};

    fn rubbery(name: &'static str, youngs_modulus: f64, poisson_ratio: f64) -> Material {
        Material { name, youngs_modulus, poisson_ratio, density: 1000.0 }
    }

    /// Out-of-plane bending of a thin ring of square section under q cos mθ, which twists it as well: with bending
    /// curvature β/R − w″/R² and twist β′/R + w′/R² (A. E. H. Love, *Treatise*, §293) the energy is least for C = R⁴
    /// (EI + m² GJ)/(EI GJ m² (m² − 1)²), J = 0.140577 a⁴ (Timoshenko and Goodier, §109).
    #[test]
    fn a_thin_ring_bends_and_twists_out_of_its_plane() {
        let (radius, side, steel) = (0.1_f64, 1e-3_f64, MATERIALS[1]);
        let section = Section::rectangle((radius - 0.5 * side, radius + 0.5 * side), (0.0, side), steel, Vec::new());
        let found = section.compliances(Band { radius, width: side }, 2, 3).unwrap();
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
        let part = |name: &str, bottom: f64, top: f64, material: Material| Part {
            name: name.to_owned(),
            inner_radius: radius - 0.5 * side,
            outer_radius: radius + 0.5 * side,
            bottom,
            top,
            material,
        };
        let parts = vec![part("beam", 0.0, side, beam), part("layer", side, side + layer, soft)];
        let held = Support::at_height(side + layer, [true, true, true]);
        let section = Section::new(parts, vec![held]).unwrap();
        let found = section.compliances(Band { radius, width: side }, 25, 8).unwrap();
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
        let found = section.compliances(Band { radius, width }, 1500, 8).unwrap();
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
        let part = |name: &str, radii: (f64, f64), heights: (f64, f64)| {
            let [inner_radius, outer_radius, bottom, top] =
                [radii.0, radii.1, heights.0, heights.1].map(|mm| 1e-3 * mm);
            Part { name: name.to_owned(), inner_radius, outer_radius, bottom, top, material: MATERIALS[0] }
        };
        let parts = vec![
            part("rib", (28.85, 29.15), (0.0, 1.0)),
            part("flange", (27.0, 29.15), (1.0, 1.5)),
            part("body", (25.0, 27.0), (1.0, 6.0)),
        ];
        (Section::new(parts, Vec::new()).unwrap(), Band { radius: 29e-3, width: 0.3e-3 })
    }

    #[test]
    fn a_few_orders_stand_for_all() {
        let (section, band) = rotor();
        let mesh = Mesh::new(&section, Some(band), 200, 1).unwrap();
        let system = System::new(&section, &mesh).unwrap();
        let load = contact_load(&section, &mesh, band);
        let (first, last) = (7.0, RESOLVED * band.radius / section.depth(band));
        let reduced = Reduced::new(&section, &mesh, band, &samples(first, last)).unwrap();
        for n in [1, 2, 3, 4, 6, 9, 14, 20, 30, 45, 70, 100] {
            let order = first * f64::from(n);
            let mut moved = load.clone();
            system.factor(order, 0.0).unwrap().solve(&mut moved, 1).unwrap();
            let full = dot(&load, &moved) / band.radius;
            let off = 1.0 - reduced.compliance(order).unwrap() / full;
            // From below, as of every part of the displacements.
            assert!(off > -1e-8 && off < LEFT_OUT, "order {order}: {off}");
        }
    }

    #[test]
    fn the_stated_error_covers_what_a_finer_mesh_finds() {
        let (section, band) = rotor();
        let found = section.compliances(band, 7, 100).unwrap();
        let mesh = Mesh::new(&section, Some(band), 4000, 2).unwrap();
        let system = System::new(&section, &mesh).unwrap();
        let load = contact_load(&section, &mesh, band);
        for n in [1, 2, 3, 5, 8, 16, 32, 64, 100] {
            let mut moved = load.clone();
            system.factor(7.0 * n as f64, 0.0).unwrap().solve(&mut moved, 1).unwrap();
            let finer = dot(&load, &moved) / band.radius;
            let Stated { value, error } = found.harmonics[n - 1];
            assert!((value - finer).abs() < 1.5 * error && error < 2e-3 * value, "{n}: {value} ± {error}, {finer}");
        }
    }

    #[test]
    fn bits_do_not_depend_on_the_number_of_threads() {
        let (section, band) = rotor();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| section.compliances(band, 7, 40)).unwrap()
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn what_cannot_be_answered_is_refused_with_what_is_allowed() {
        let (section, band) = rotor();
        let beside = section.compliances(Band { radius: 28e-3, ..band }, 7, 4).unwrap_err().to_string();
        assert!(
            beside.contains("from r = 27.85 to 28.15 mm") && beside.contains("allowed 28.85 to 29.15 mm"),
            "{beside}"
        );
        let tilting = section.compliances(band, 1, 4).unwrap_err().to_string();
        assert!(tilting.contains("tilting") && tilting.contains("fix it axially and radially"), "{tilting}");
        let lifted = section.deflection(band, 0).unwrap_err().to_string();
        assert!(lifted.contains("along its axis"), "{lifted}");
        assert!(section.compliances(band, 7, 0).unwrap().harmonics.is_empty());
    }

    #[test]
    fn the_deflection_does_the_work_of_the_compliance() {
        let (section, band) = rotor();
        let (mesh, moved) = (section.mesh(band).unwrap(), section.deflection(band, 14).unwrap());
        let at =
            |r: f64| mesh.nodes.iter().position(|node| (node[0] - r).abs() < 1e-9 && node[1].abs() < 1e-9).unwrap();
        let compliance = section.compliances(band, 7, 2).unwrap().harmonics[1].value;
        let edges = [28.85e-3, 29.15e-3].map(|r| moved.axial[at(r)]);
        assert!(
            edges[0].min(edges[1]) < compliance && compliance < 1.1 * edges[0].max(edges[1]),
            "{edges:?} {compliance}"
        );
    }
}
