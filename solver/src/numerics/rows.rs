//! Solves the systems of [`super::system`], dense within a row: block LU without pivoting. Of many nodes to a row that couple to their neighbours
//! alone: [`super::lines`].
//!
//! By rows the system is block tridiagonal, with dense blocks D = diag(centre) + A diag(within) on the diagonal and diagonal blocks W, E
//! beside it:
//!
//! ```text
//! D̃₀ = D₀,   D̃ᵢ = Dᵢ − Wᵢ D̃ᵢ₋₁⁻¹ Eᵢ₋₁,   yᵢ = D̃ᵢ⁻¹ (rᵢ − Wᵢ yᵢ₋₁),   xᵢ = yᵢ − D̃ᵢ⁻¹ Eᵢ xᵢ₊₁
//! ```
//!
//! The inverses are formed in place by Gauss–Jordan elimination, columns³ operations each, whatever A is. Every operation is
//! on whole columns that stay where they are, which suits vector registers (docs/performance.md). For M-matrices all D̃ are
//! M-matrices too and no pivoting is needed; nor is it where the symmetric part is definite, as with a spectral A.

use super::lines::LineSolver;
use super::system::{Across, Coupling};
use super::vectorised;

/// Calls a function with the number of columns as a constant where it is a usual one, so that its loops are unrolled and
/// vectorised, and with the constant 0 (take it at run time) where it is not.
macro_rules! with_columns {
    ($columns:expr, $constant:ident => $call:expr) => {
        with_columns!(@ $columns, $constant => $call; 1 2 3 4 5 6 7 8 10 12 16 20 24)
    };
    (@ $columns:expr, $constant:ident => $call:expr; $($known:literal)*) => {
        match $columns {
            $($known => { const $constant: usize = $known; $call })*
            _ => { const $constant: usize = 0; $call }
        }
    };
}
pub(crate) use with_columns;

/// Four values, a vector register.
type Lanes = [f64; LANES];
const LANES: usize = 4;

/// Solver for systems of one size and one A, with its workspace.
#[derive(Clone, Debug)]
pub enum RowSolver {
    /// By elimination.
    Blocks(BlockSolver),
    /// Where A is [`Across::Neighbours`].
    Lines(LineSolver),
}

impl RowSolver {
    /// For `rows` rows of so many columns.
    pub fn new(rows: usize, columns: usize, across: &Across) -> Self {
        match across {
            Across::Full(matrix) => Self::Blocks(BlockSolver::new(rows, columns, matrix)),
            Across::Neighbours(across) => Self::Lines(LineSolver::new(rows, across)),
        }
    }

    /// Replaces `rhs` by the solution of the system with `coupling`, and `centre` \[a value an unknown\] in place of its
    /// own. Couplings that leave the grid are ignored.
    pub fn solve(&mut self, coupling: &Coupling, centre: &[f64], rhs: &mut [f64]) {
        match self {
            Self::Blocks(solver) => solver.solve(coupling, centre, rhs),
            Self::Lines(solver) => solver.solve(coupling, centre, rhs),
        }
    }
}

/// Block LU.
#[derive(Clone, Debug)]
pub struct BlockSolver {
    columns: usize,
    /// A, column by column, each padded with zeros to whole registers.
    matrix: Vec<Lanes>,
    /// D̃⁻¹ of every row, column by column, each column padded with zeros to whole registers.
    inverses: Vec<Lanes>,
    /// W of the row at hand, what D̃⁻¹ is multiplied with, and the product.
    west: Vec<Lanes>,
    known: Vec<Lanes>,
    image: Vec<Lanes>,
    pivot: Vec<Lanes>,
    /// Unit vectors, a column each.
    units: Vec<Lanes>,
}

impl BlockSolver {
    /// For `rows` × `columns` unknowns, with A column by column.
    fn new(rows: usize, columns: usize, matrix: &[f64]) -> Self {
        let groups = columns.div_ceil(LANES);
        let line = vec![[0.0; LANES]; groups];
        let mut units = vec![[0.0; LANES]; columns * groups];
        for p in 0..columns {
            units[p * groups + p / LANES][p % LANES] = 1.0;
        }
        let mut padded = vec![[0.0; LANES]; columns * groups];
        for (k, entry) in matrix.iter().enumerate() {
            let (column, row) = (k / columns, k % columns);
            padded[column * groups + row / LANES][row % LANES] = *entry;
        }
        Self {
            columns,
            matrix: padded,
            inverses: vec![[0.0; LANES]; rows * columns * groups],
            west: line.clone(),
            known: line.clone(),
            image: line.clone(),
            pivot: line,
            units,
        }
    }

    fn solve(&mut self, coupling: &Coupling, centre: &[f64], rhs: &mut [f64]) {
        with_columns!(self.columns, B => vectorised(
            #[inline(always)]
            || self.solve_columns::<B>(coupling, centre, rhs)
        ));
    }

    #[inline(always)]
    fn solve_columns<const B: usize>(&mut self, coupling: &Coupling, centre: &[f64], rhs: &mut [f64]) {
        let b = if B == 0 { self.columns } else { B };
        let groups = b.div_ceil(LANES);
        let block = b * groups;
        let rows = centre.len() / b;
        let (west, known, image) = (&mut self.west[..groups], &mut self.known[..groups], &mut self.image[..groups]);
        for row in 0..rows {
            let at = row * b;
            let (before, rest) = self.inverses.split_at_mut(row * block);
            let inverse = &mut rest[..block];
            for c in 0..b {
                let (factor, own) = (coupling.within[at + c], centre[at + c]);
                let (column, unit) = (&self.matrix[c * groups..][..groups], &self.units[c * groups..][..groups]);
                for (g, entry) in inverse[c * groups..][..groups].iter_mut().enumerate() {
                    *entry = plus(scaled(column[g], factor), scaled(unit[g], own));
                }
            }
            known.as_flattened_mut()[..b].copy_from_slice(&rhs[at..at + b]);
            if row > 0 {
                let last = &before[(row - 1) * block..][..block];
                west.as_flattened_mut()[..b].copy_from_slice(&coupling.west[at..at + b]);
                for g in 0..groups {
                    known[g] = minus(known[g], times(west[g], image[g]));
                }
                let east = &coupling.east[at - b..at];
                for ((column, last), east) in inverse.chunks_exact_mut(groups).zip(last.chunks_exact(groups)).zip(east)
                {
                    for g in 0..groups {
                        column[g] = minus(column[g], scaled(times(west[g], last[g]), *east));
                    }
                }
            }
            invert::<B>(inverse, b, &mut self.pivot, &self.units);
            multiply::<B>(inverse, b, known, image);
            rhs[at..at + b].copy_from_slice(&image.as_flattened()[..b]);
        }
        for row in (0..rows.saturating_sub(1)).rev() {
            let at = row * b;
            for (r, known) in known.as_flattened_mut()[..b].iter_mut().enumerate() {
                *known = coupling.east[at + r] * rhs[at + b + r];
            }
            multiply::<B>(&self.inverses[row * block..][..block], b, known, image);
            for (x, image) in rhs[at..at + b].iter_mut().zip(image.as_flattened()) {
                *x -= image;
            }
        }
    }
}

#[inline(always)]
fn minus(a: Lanes, b: Lanes) -> Lanes {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]]
}

#[inline(always)]
fn plus(a: Lanes, b: Lanes) -> Lanes {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

#[inline(always)]
fn times(a: Lanes, b: Lanes) -> Lanes {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]]
}

#[inline(always)]
fn scaled(a: Lanes, by: f64) -> Lanes {
    [a[0] * by, a[1] * by, a[2] * by, a[3] * by]
}

/// Gauss–Jordan inversion in place of a b × b matrix of stored columns; `pivot` is workspace.
///
/// Columns are only ever written in whole registers: an entry written alone would hold up the next load of its
/// register. The pivot column's entry in row p is taken out by its unit vector.
#[inline(always)]
fn invert<const B: usize>(matrix: &mut [Lanes], b: usize, pivot: &mut [Lanes], units: &[Lanes]) {
    let b = if B == 0 { b } else { B };
    let groups = b.div_ceil(LANES);
    let pivot = &mut pivot[..groups];
    for p in 0..b {
        let unit = &units[p * groups..][..groups];
        let column = &matrix[p * groups..][..groups];
        let reciprocal = 1.0 / column[p / LANES][p % LANES];
        for g in 0..groups {
            let rest = minus([1.0; LANES], unit[g]);
            pivot[g] = scaled(plus(times(column[g], rest), unit[g]), reciprocal);
        }
        for column in matrix.chunks_exact_mut(groups) {
            let factor = column[p / LANES][p % LANES];
            for g in 0..groups {
                let rest = minus([1.0; LANES], unit[g]);
                column[g] = minus(times(column[g], rest), scaled(pivot[g], factor));
            }
        }
        matrix[p * groups..][..groups].copy_from_slice(pivot);
    }
}

/// `image` = matrix × `known`.
#[inline(always)]
fn multiply<const B: usize>(matrix: &[Lanes], b: usize, known: &[Lanes], image: &mut [Lanes]) {
    let b = if B == 0 { b } else { B };
    let groups = b.div_ceil(LANES);
    for (g, image) in image[..groups].iter_mut().enumerate() {
        let mut sum = [0.0; LANES];
        for (column, known) in matrix[..b * groups].chunks_exact(groups).zip(known.as_flattened()) {
            sum = plus(sum, scaled(column[g], *known));
        }
        *image = sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn agrees_with_a_dense_solve() {
        for (rows, columns) in
            [(1, 1), (9, 1), (7, 2), (1, 5), (6, 3), (5, 4), (4, 7), (5, 8), (3, 13), (4, 16), (3, 25)]
        {
            let n = rows * columns;
            let mut coupling = Coupling::new(n);
            let mut dense = DMatrix::<f64>::zeros(n, n);
            let value = |k: usize, d: usize| -0.1 - ((k * 7 + d * 13) % 11) as f64 / 11.0;
            let matrix: Vec<f64> = (0..columns * columns).map(|k| 0.2 * value(k, 3)).collect();
            for k in 0..n {
                coupling.centre[k] = 9.0 + (k % 3) as f64;
                coupling.within[k] = 0.5 - value(k, 5);
                (coupling.west[k], coupling.east[k]) = (value(k, 1), value(k, 2));
                for j in 0..columns {
                    dense[(k / columns * columns + j, k)] = matrix[j * columns + k % columns] * coupling.within[k];
                }
                dense[(k, k)] += coupling.centre[k];
                if k >= columns {
                    dense[(k, k - columns)] = coupling.west[k];
                }
                if k + columns < n {
                    dense[(k, k + columns)] = coupling.east[k];
                }
            }
            let mut rhs: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
            let expected = dense.lu().solve(&DVector::from_vec(rhs.clone())).unwrap();
            let centre = coupling.centre.clone();
            RowSolver::new(rows, columns, &Across::new(columns, &matrix)).solve(&coupling, &centre, &mut rhs);
            for i in 0..n {
                assert!((rhs[i] - expected[i]).abs() < 1e-13, "{rows} × {columns}, {i}: {} {}", rhs[i], expected[i]);
            }
        }
    }
}
