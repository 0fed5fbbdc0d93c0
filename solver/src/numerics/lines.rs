//! Linear systems of nodes in rows that couple to their neighbours only: multigrid that coarsens the columns.
//!
//! The system is that of [`super::system`], with a tridiagonal A. All nodes of a column, along x, form a line. The tridiagonal systems of
//! all odd lines, or of all even ones, are solved together, which suits vector registers. A cycle first solves the odd lines. It then
//! solves the even lines as a system of their own, with half as many columns, the conductances of every two intervals in series and twice
//! the width, by a cycle of its own. Finally it solves the odd, the even and the odd lines again. A cycle leaves about a tenth of the
//! error, whatever the number of nodes, their clustering, and the flow within a step; its work is proportional to the number of nodes.

use super::system::{Coupling, Tridiagonal};
use super::vectorised;

/// Allowed residual, relative to the largest right-hand side: when Newton's method converges, what is left hardly changes anything.
const LEFT: f64 = 1e-4;
/// Cycles after which the solution is accepted as it is.
const MOST_CYCLES: usize = 20;

/// Solver for systems of one size and one A, with its workspace.
#[derive(Clone, Debug)]
pub struct LineSolver {
    /// The level of all columns, that of every other one, and so on.
    levels: Vec<Columns>,
    /// The single column that remains.
    last: Lines,
}

/// The columns of one level, two at least.
#[derive(Clone, Debug)]
struct Columns {
    even: Lines,
    odd: Lines,
    /// Width of each even column over the width that it has on the next level.
    share: Vec<f64>,
}

/// Every other column of a level. Fields are `[row][line]`.
#[derive(Clone, Debug)]
struct Lines {
    across: Tridiagonal,
    coupling: Coupling,
    /// Reciprocal pivots of the elimination along the lines, and east over pivot.
    inverse: Vec<f64>,
    ahead: Vec<f64>,
    /// The right-hand side, the same minus the contributions of the neighbouring lines, and the solution.
    given: Vec<f64>,
    known: Vec<f64>,
    solution: Vec<f64>,
}

impl LineSolver {
    /// A solver for `rows` × columns unknowns.
    pub fn new(rows: usize, across: &Tridiagonal) -> Self {
        let mut levels = Vec::new();
        let mut across = across.clone();
        while across.columns() > 1 {
            let [even, odd] = across.apart().map(|across| Lines::new(rows, across));
            let share;
            (across, share) = across.every_other();
            levels.push(Columns { even, odd, share });
        }
        Self { levels, last: Lines::new(rows, across) }
    }

    /// Replaces `rhs` by the solution of the system with `coupling`, but with `centre` \[one value for each unknown\] in place of its own.
    pub fn solve(&mut self, coupling: &Coupling, centre: &[f64], rhs: &mut [f64]) {
        vectorised(
            #[inline(always)]
            || self.cycles(coupling, centre, rhs),
        );
    }

    /// The same; returns the number of cycles.
    #[inline(always)]
    fn cycles(&mut self, coupling: &Coupling, centre: &[f64], rhs: &mut [f64]) -> usize {
        self.factor([centre, &coupling.west, &coupling.east, &coupling.within]);
        let allowed = LEFT * largest(rhs);
        self.levels[0].take(rhs, |lines| &mut lines.given);
        rhs.fill(0.0);
        for cycle in 1..=MOST_CYCLES {
            self.cycle();
            self.levels[0].add_to(rhs);
            let Columns { even, odd, .. } = &mut self.levels[0];
            // The residual: zero on the odd lines; on the even ones the change of the known part since they were solved.
            odd.given.fill(0.0);
            even.solution.copy_from_slice(&even.known);
            even.beside(odd, 0);
            for ((given, known), taken) in even.given.iter_mut().zip(&even.known).zip(&even.solution) {
                *given = known - taken;
            }
            if largest(&even.given) <= allowed {
                return cycle;
            }
        }
        MOST_CYCLES
    }

    /// Eliminates the lines of every level; `fields`: centre, west, east, within.
    #[inline(always)]
    fn factor(&mut self, fields: [&[f64]; 4]) {
        let mut fields = fields;
        for level in &mut self.levels {
            let [centre, west, east, within] = fields;
            level.take(centre, |lines| &mut lines.coupling.centre);
            level.take(west, |lines| &mut lines.coupling.west);
            level.take(east, |lines| &mut lines.coupling.east);
            level.take(within, |lines| &mut lines.coupling.within);
            level.even.factor();
            level.odd.factor();
            let Coupling { centre, west, east, within } = &level.even.coupling;
            fields = [centre, west, east, within];
        }
        for (from, to) in fields.into_iter().zip(self.last.coupling.fields()) {
            to.copy_from_slice(from);
        }
        self.last.factor();
    }

    /// One cycle from a zero initial guess, for the right-hand side of the first level.
    #[inline(always)]
    fn cycle(&mut self) {
        for k in 0..self.levels.len() {
            let (here, fewer) = self.levels.split_at_mut(k + 1);
            let Columns { even, odd, share } = &mut here[k];
            odd.known.copy_from_slice(&odd.given);
            odd.solve();
            even.beside(odd, 0);
            for row in even.known.chunks_exact_mut(share.len()) {
                row.iter_mut().zip(&*share).for_each(|(value, share)| *value *= share);
            }
            match fewer.first_mut() {
                Some(fewer) => fewer.take(&even.known, |lines| &mut lines.given),
                None => self.last.known.copy_from_slice(&even.known),
            }
        }
        self.last.solve();
        for k in (0..self.levels.len()).rev() {
            let (here, fewer) = self.levels.split_at_mut(k + 1);
            let Columns { even, odd, .. } = &mut here[k];
            match fewer.first() {
                Some(fewer) => {
                    even.solution.fill(0.0);
                    fewer.add_to(&mut even.solution);
                }
                None => even.solution.copy_from_slice(&self.last.solution),
            }
            odd.beside(even, 1);
            odd.solve();
            even.beside(odd, 0);
            even.solve();
            odd.beside(even, 1);
            odd.solve();
        }
    }
}

impl Columns {
    /// Splits the columns of `all` into even and odd ones.
    #[inline(always)]
    fn take(&mut self, all: &[f64], field: impl Fn(&mut Lines) -> &mut Vec<f64>) {
        let (many, few) = (self.even.across.columns(), self.odd.across.columns());
        let rows = field(&mut self.even).chunks_exact_mut(many).zip(field(&mut self.odd).chunks_exact_mut(few));
        for (all, (even, odd)) in all.chunks_exact(many + few).zip(rows) {
            for (pair, (even, odd)) in all.chunks_exact(2).zip(even.iter_mut().zip(&mut *odd)) {
                (*even, *odd) = (pair[0], pair[1]);
            }
            // There may be one more even column than odd ones.
            if many > few {
                even[few] = all[2 * few];
            }
        }
    }

    /// Adds the solution of each column to `all`.
    #[inline(always)]
    fn add_to(&self, all: &mut [f64]) {
        let (many, few) = (self.even.across.columns(), self.odd.across.columns());
        let rows = self.even.solution.chunks_exact(many).zip(self.odd.solution.chunks_exact(few));
        for (all, (even, odd)) in all.chunks_exact_mut(many + few).zip(rows) {
            for (pair, (even, odd)) in all.chunks_exact_mut(2).zip(even.iter().zip(odd)) {
                pair[0] += even;
                pair[1] += odd;
            }
            if many > few {
                all[2 * few] += even[few];
            }
        }
    }
}

impl Lines {
    fn new(rows: usize, across: Tridiagonal) -> Self {
        let zero = vec![0.0; rows * across.columns()];
        Self {
            across,
            coupling: Coupling::new(zero.len()),
            inverse: zero.clone(),
            ahead: zero.clone(),
            given: zero.clone(),
            known: zero.clone(),
            solution: zero,
        }
    }

    /// Eliminates along the lines.
    #[inline(always)]
    fn factor(&mut self) {
        let n = self.across.columns();
        for first in (0..self.inverse.len()).step_by(n) {
            let nodes = first..first + n;
            let (before, ahead) = self.ahead.split_at_mut(first);
            let (ahead, inverse) = (&mut ahead[..n], &mut self.inverse[nodes.clone()]);
            let (centre, within) = (&self.coupling.centre[nodes.clone()], &self.coupling.within[nodes.clone()]);
            let (west, east) = (&self.coupling.west[nodes.clone()], &self.coupling.east[nodes]);
            let diagonal = &self.across.diagonal[..n];
            for j in 0..n {
                inverse[j] = centre[j] + diagonal[j] * within[j];
            }
            if first > 0 {
                let before = &before[first - n..];
                for j in 0..n {
                    inverse[j] -= west[j] * before[j];
                }
            }
            for j in 0..n {
                inverse[j] = 1.0 / inverse[j];
                ahead[j] = east[j] * inverse[j];
            }
        }
    }

    /// Solves the lines for their known part, each by itself.
    #[inline(always)]
    fn solve(&mut self) {
        let (n, all) = (self.across.columns(), self.solution.len());
        for first in (0..all).step_by(n) {
            let nodes = first..first + n;
            let (before, here) = self.solution.split_at_mut(first);
            let (here, known, inverse) = (&mut here[..n], &self.known[nodes.clone()], &self.inverse[nodes.clone()]);
            if first == 0 {
                for j in 0..n {
                    here[j] = known[j] * inverse[j];
                }
            } else {
                let (before, west) = (&before[first - n..], &self.coupling.west[nodes]);
                for j in 0..n {
                    here[j] = (known[j] - west[j] * before[j]) * inverse[j];
                }
            }
        }
        for first in (n..all).step_by(n).rev() {
            let (here, behind) = self.solution.split_at_mut(first);
            let nodes = first - n..first;
            let (here, behind, ahead) = (&mut here[nodes.clone()], &behind[..n], &self.ahead[nodes]);
            for j in 0..n {
                here[j] -= ahead[j] * behind[j];
            }
        }
    }

    /// Sets the known part to the right-hand side minus the contributions of the `other` lines. Line j lies between lines j − 1 and j of
    /// the others if `first` = 0 (even lines), and between j and j + 1 if it is 1 (odd lines).
    #[inline(always)]
    fn beside(&mut self, other: &Self, first: usize) {
        let (n, m) = (self.across.columns(), other.across.columns());
        let (lines, below, above) = (n.min(m - first), &self.across.below[1 - first..n], &self.across.above[..n]);
        for (row, known) in self.known.chunks_exact_mut(n).enumerate() {
            known.copy_from_slice(&self.given[row * n..][..n]);
            let (values, within) = (&other.solution[row * m..][..m], &other.coupling.within[row * m..][..m]);
            let lower = &mut known[1 - first..];
            let (values_below, within_below) = (&values[..lower.len()], &within[..lower.len()]);
            for j in 0..lower.len() {
                lower[j] -= below[j] * (within_below[j] * values_below[j]);
            }
            let (upper, values, within) = (&mut known[..lines], &values[first..][..lines], &within[first..][..lines]);
            for j in 0..lines {
                upper[j] -= above[j] * (within[j] * values[j]);
            }
        }
    }
}

#[inline(always)]
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::grading;
    use crate::numerics::system::Across;
    use nalgebra::{DMatrix, DVector};

    /// The system of a film: nodes clustered by β, conductivities that vary by a factor of ten, a diffusion number `flows`, and a
    /// convection `wind` along x.
    fn system(rows: usize, columns: usize, beta: f64, flows: f64, wind: f64) -> (Vec<f64>, Coupling) {
        let nodes = grading::one_sided(1.0, columns, beta);
        let lengths = grading::node_lengths(&nodes);
        let face = |low: usize| 1.0 / (nodes[low + 1] - nodes[low]);
        let mut across = vec![0.0; columns * columns];
        for i in 0..columns {
            let before = if i > 0 { face(i - 1) } else { 0.0 };
            across[i * columns + i] = (before + face(i)) / lengths[i];
            if i > 0 {
                across[i * columns + i - 1] = -before / lengths[i];
            }
            if i + 1 < columns {
                across[i * columns + i + 1] = -face(i) / lengths[i];
            }
        }
        let mut coupling = Coupling::new(rows * columns);
        let conducted = |i: usize, j: usize| 1.0 + 9.0 * ((i as f64 * 0.9).sin() * (j as f64 * 0.4).cos()).powi(2);
        let (along, drift) = (flows * (rows * rows) as f64, wind * rows as f64);
        for k in 0..rows * columns {
            let (i, j) = (k / columns, k % columns);
            coupling.within[k] = flows * conducted(i, j);
            coupling.centre[k] = 1.5 + 2.0 * along * conducted(i, j) + drift;
            coupling.west[k] = if i > 0 { -along * conducted(i - 1, j) - drift } else { 0.0 };
            coupling.east[k] = -along * conducted(i + 1, j);
        }
        (across, coupling)
    }

    #[test]
    fn a_few_cycles_solve_films_of_any_size_flow_and_clustering() {
        for (rows, columns) in [(1, 20), (9, 21), (16, 33), (12, 47), (5, 64)] {
            for (beta, flows, wind) in [
                (0.0, 1.0, 0.0),
                (2.5, 1e-5, 0.0),
                (0.0, 1e-3, 0.0),
                (2.5, 1.0, 30.0),
                (5.0, 1e6, 0.0),
                (1.0, 1e-4, 1e3),
            ] {
                let (across, coupling) = system(rows, columns, beta, flows, wind);
                let n = rows * columns;
                let dense = DMatrix::from_fn(n, n, |k, l| {
                    let (same_row, same_column) = (k / columns == l / columns, k % columns == l % columns);
                    let own = if k == l { coupling.centre[k] } else { 0.0 };
                    let beside =
                        if same_row { across[k % columns * columns + l % columns] * coupling.within[l] } else { 0.0 };
                    let west = if same_column && l + columns == k { coupling.west[k] } else { 0.0 };
                    let east = if same_column && k + columns == l { coupling.east[k] } else { 0.0 };
                    own + beside + west + east
                });
                let known = DVector::from_fn(n, |k, _| (k as f64 * 0.7).cos() + 0.3);
                let expected = dense.clone().lu().solve(&known).unwrap();
                let Across::Neighbours(bands) = Across::new(columns, &across) else { panic!("{columns} columns") };
                let mut solver = LineSolver::new(rows, &bands);
                let mut found = known.as_slice().to_vec();
                let cycles = solver.cycles(&coupling, &coupling.centre, &mut found);
                let found = DVector::from_vec(found);
                let (left, off) =
                    ((&dense * &found - &known).amax() / known.amax(), (found - &expected).amax() / expected.amax());
                let case = format!("{rows} × {columns}, β {beta}, flow {flows}, wind {wind}");
                assert!(
                    cycles <= 8 && left <= 1.1 * LEFT && off < 10.0 * LEFT,
                    "{case}: {cycles} cycles, {left:.1e}, {off:.1e}"
                );
            }
        }
    }
}
