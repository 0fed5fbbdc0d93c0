//! Natural frequencies: K u = ω² M u, by subspace iteration.
//!
//! A few vectors are multiplied by (K + sM)⁻¹ M again and again, which turns them towards the lowest modes, and the lowest modes in
//! their span are taken each time (Rayleigh and Ritz). The
//! shift s > 0 makes the matrix positive definite where nothing holds a rigid motion.
//! Source: K.-J. Bathe, *Finite Element Procedures* (1996), section 11.6.

use super::compliance::of_two_meshes;
use super::element::DIRECTIONS;
use super::mesh::{Halved, Mesh};
use super::section::{RingError, Section};
use super::solve::{System, cancelled, free_motions};
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::numerics::dot;
use nalgebra::{DMatrix, SymmetricEigen};
use rayon::prelude::*;

/// Additional vectors of the iteration, beyond those asked for: on the coarser mesh, and on the finer one, which starts from the coarser
/// modes.
const BESIDE: usize = 8;
const BESIDE_FINER: usize = 2;
/// The most iterations.
const MOST: usize = 60;
/// Relative change of a squared frequency at which it counts as found.
const SETTLED: f64 = 1e-8;

impl Section {
    /// The lowest `count` natural frequencies \[Hz\] of each of the `orders`, ascending; rigid motions that nothing holds
    /// are left out. Order 0 has those with torsion alone and those without.
    ///
    /// # Errors
    /// [`RingError`] if the mesh would be too large, or if it is cancelled.
    pub fn natural_frequencies(
        &self,
        orders: &[u32],
        count: usize,
        cancel: &Cancel,
    ) -> Result<Vec<Vec<Estimate>>, RingError> {
        let meshes = self.meshes(None, 1)?;
        let [coarse, fine] = &meshes;
        let equations = |mesh: &Mesh| cancelled(cancel).and_then(|()| System::new(self, mesh));
        let (first, second) = rayon::join(|| equations(coarse), || equations(fine));
        let (first, second) = (first?, second?);
        let halved = Halved::new(coarse, fine);
        let of_order = |order: &u32| {
            let rigid = free_motions(coarse, *order).len();
            let held: Vec<bool> = coarse.held.iter().flatten().copied().collect();
            let free = held.iter().filter(|held| !**held).count();
            let wanted = (count + rigid).min(free);
            let of =
                |j: usize| held.iter().enumerate().map(|(i, held)| if *held { 0.0 } else { start(i, j) }).collect();
            let vectors: Vec<Vec<f64>> = (0..(wanted + BESIDE).min(free)).map(of).collect();
            let shift = self.shift();
            let from = Iteration { system: &first, order: *order, shift, wanted, cancel };
            let (coarse, mut modes) = from.lowest(vectors)?;
            modes.truncate(wanted + BESIDE_FINER);
            let finer = modes.iter().map(|mode| second.inertia(&halved.finer(mode))).collect();
            let (fine, _) = Iteration { system: &second, ..from }.lowest(finer)?;
            let hertz = |square: &f64| (square - shift).max(0.0).sqrt() / std::f64::consts::TAU;
            let both = coarse.iter().zip(&fine).take(wanted).skip(rigid);
            Ok(both.map(|(coarse, fine)| of_two_meshes(hertz(coarse), hertz(fine))).collect())
        };
        orders.par_iter().map(of_order).collect()
    }

    /// Spectral shift of the squared frequencies \[1/s²\]: far below that of a wave as long as the circumference, far above round-off.
    fn shift(&self) -> f64 {
        let squares = self.parts().iter().map(|part| part.material.youngs_modulus / part.material.density);
        let outer = self.parts().iter().map(|part| part.outer_radius).fold(0.0, f64::max);
        1e-2 * squares.fold(f64::INFINITY, f64::min) / (outer * outer)
    }
}

/// The iteration on one mesh.
#[derive(Clone, Copy)]
struct Iteration<'a> {
    system: &'a System,
    order: u32,
    shift: f64,
    wanted: usize,
    cancel: &'a Cancel,
}

impl Iteration<'_> {
    /// Squared frequencies plus the shift, ascending, and their modes, from `pushed`, which are vectors times the mass.
    fn lowest(&self, mut pushed: Vec<Vec<f64>>) -> Result<(Vec<f64>, Vec<Vec<f64>>), RingError> {
        let Self { system, order, shift, wanted, cancel } = *self;
        let (vectors, size) = (pushed.len(), system.size);
        if vectors == 0 {
            return Ok((Vec::new(), Vec::new()));
        }
        cancelled(cancel)?;
        let factor = system.factor(f64::from(order), shift)?;
        let (mut found, mut modes) = (vec![f64::INFINITY; vectors], Vec::new());
        for _ in 0..MOST {
            cancelled(cancel)?;
            let mut moved = pushed.concat();
            factor.solve(&mut moved, vectors)?;
            let mut moved: Vec<Vec<f64>> = moved.chunks(size).map(<[f64]>::to_vec).collect();
            let mut inertia: Vec<Vec<f64>> = moved.iter().map(|moved| system.inertia(moved)).collect();
            // Each at right angles to those before it in the sense of the mass; twice, because they are nearly parallel.
            for j in (0..vectors).flat_map(|j| [j, j]) {
                for i in 0..j {
                    let share = -dot(&moved[j], &inertia[i]);
                    for all in [&mut moved, &mut inertia, &mut pushed] {
                        add(all, j, share, i);
                    }
                }
                let norm = dot(&moved[j], &inertia[j]).sqrt();
                for all in [&mut moved, &mut inertia, &mut pushed] {
                    all[j].iter_mut().for_each(|x| *x /= norm);
                }
            }
            let stiffness = DMatrix::from_fn(vectors, vectors, |i, j| {
                0.5 * (dot(&moved[i], &pushed[j]) + dot(&moved[j], &pushed[i]))
            });
            let eigen = SymmetricEigen::try_new(stiffness, f64::EPSILON, 1000).ok_or(RingError::Singular { order })?;
            let mut ascending: Vec<usize> = (0..vectors).collect();
            ascending.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
            let squares: Vec<f64> = ascending.iter().map(|k| eigen.eigenvalues[*k]).collect();
            let mixed = |of: &[Vec<f64>], k: usize| {
                let mut mixed = vec![0.0; size];
                for (j, vector) in of.iter().enumerate() {
                    let share = eigen.eigenvectors[(j, k)];
                    mixed.iter_mut().zip(vector).for_each(|(x, y)| *x += share * y);
                }
                mixed
            };
            let settled =
                squares.iter().zip(&found).take(wanted).all(|(now, before)| (now / before - 1.0).abs() < SETTLED);
            found = squares;
            modes = ascending.iter().map(|k| mixed(&moved, *k)).collect();
            if settled {
                break;
            }
            pushed = ascending.iter().map(|k| mixed(&inertia, *k)).collect();
        }
        Ok((found, modes))
    }
}

/// Adds `share` times the vector `i` to the vector `j`, i < j.
fn add(all: &mut [Vec<f64>], j: usize, share: f64, i: usize) {
    let (before, from) = all.split_at_mut(j);
    from[0].iter_mut().zip(&before[i]).for_each(|(x, y)| *x += share * y);
}

/// Component `i` of the vector `j` that the iteration starts from: anything that has a part along every mode.
fn start(i: usize, j: usize) -> f64 {
    let turn = (i / DIRECTIONS) as f64 * (1.0 + j as f64) * 0.618_033_988_749_894_9 + (i % DIRECTIONS) as f64 * 0.3;
    1.0 / (1.0 + j as f64) + (std::f64::consts::TAU * turn).sin()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotor::ring::section::{MATERIALS, Support};

    /// Frequencies of a thin ring of square section, in its plane (A. E. H. Love, *Treatise on the Mathematical
    /// Theory of Elasticity*, 4th ed. (1927), §293: ω² = EI m²(m²−1)²/(ρA R⁴(m²+1))) and out of it, with torsion: m²
    /// + EI/GJ in place of m² + 1, which is Love's m² + 1 + ν of a round wire.
    #[test]
    fn a_thin_ring_vibrates_as_love_says() {
        let (radius, side, steel) = (0.1, 1e-3, MATERIALS[1]);
        let section = Section::rectangle((radius - 0.5 * side, radius + 0.5 * side), (0.0, side), steel, Vec::new());
        let bending_over_torsion = (1.0 / 12.0) * 2.0 * (1.0 + steel.poisson_ratio) / 0.140_577;
        for order in [2_u32, 3, 5] {
            let found = section.natural_frequencies(&[order], 2, &Cancel::new()).unwrap()[0].clone();
            let m2 = f64::from(order * order);
            let scale = steel.youngs_modulus * side * side / 12.0 / (steel.density * radius.powi(4));
            let hertz = |below: f64| (scale * m2 * (m2 - 1.0).powi(2) / below).sqrt() / std::f64::consts::TAU;
            for (found, exact) in found.iter().zip([hertz(m2 + bending_over_torsion), hertz(m2 + 1.0)]) {
                assert!((found.value / exact - 1.0).abs() < 1e-3, "order {order}: {found:?}, {exact}");
                assert!(found.error < 1e-3 * exact, "order {order}: {found:?}");
            }
        }
    }

    /// Order 0 of the same ring: torsion of the section as a whole at the speed of extension is the breathing mode,
    /// ω² = E/(ρR²). Free, it has two rigid motions, which are left out; held axially only one, and the stated modes
    /// stay ascending.
    #[test]
    fn rigid_motions_are_left_out() {
        let (radius, side, steel) = (0.1, 1e-3, MATERIALS[1]);
        let whole = ((radius - 0.5 * side, radius + 0.5 * side), (0.0, side));
        let free = Section::rectangle(whole.0, whole.1, steel, Vec::new());
        let breathing = (steel.youngs_modulus / steel.density).sqrt() / radius / std::f64::consts::TAU;
        let found = free.natural_frequencies(&[0], 2, &Cancel::new()).unwrap()[0].clone();
        let near = |value: f64, exact: f64| (value / exact - 1.0).abs() < 1e-3;
        // The other is rotation of the section about its middle, hoop stress against the moment of inertia of a
        // square: ω² = E/(2ρR²).
        assert!(near(found[0].value, breathing / 2.0_f64.sqrt()) && near(found[1].value, breathing), "{found:?}");
        let first = free.natural_frequencies(&[1], 1, &Cancel::new()).unwrap()[0].clone()[0];
        assert!(first.value > 0.5 * breathing, "{first:?}");
        let held = Support::at_height(0.0, [false, true, true]);
        let held = Section::rectangle(whole.0, whole.1, steel, vec![held]);
        let found = held.natural_frequencies(&[0], 2, &Cancel::new()).unwrap()[0].clone();
        assert!(found[0].value > 0.9 * breathing && found[1].value > found[0].value, "{found:?}");
    }
}
