//! Linear systems of five-point stencils on a tensor grid: block LU without pivoting.
//!
//! Unknown k = row × columns + column couples to its neighbours in its own row (south, north: k ∓ 1) and to the same
//! column of the rows on either side (west, east: k ∓ columns). By rows the matrix is block tridiagonal, with tridiagonal
//! blocks D on the diagonal and diagonal blocks W, E beside it:
//!
//! ```text
//! D̃₀ = D₀,   D̃ᵢ = Dᵢ − Wᵢ D̃ᵢ₋₁⁻¹ Eᵢ₋₁,   yᵢ = D̃ᵢ⁻¹ (rᵢ − Wᵢ yᵢ₋₁),   xᵢ = yᵢ − D̃ᵢ⁻¹ Eᵢ xᵢ₊₁
//! ```
//!
//! The inverses are formed in place by Gauss–Jordan elimination, columns³ operations each, as many as a banded LU would
//! take; unlike that, every operation is on whole columns that stay where they are, which suits vector registers: three
//! times fewer instructions (docs/performance.md). For M-matrices, such as those of the film, all D̃ are M-matrices too and
//! no pivoting is needed.

use super::vectorised;

/// The coefficients of a five-point stencil, one value an unknown.
#[derive(Clone, Debug, Default)]
pub struct FivePoint {
    /// Node itself.
    pub centre: Vec<f64>,
    /// Neighbour at smaller x.
    pub west: Vec<f64>,
    /// Neighbour at larger x.
    pub east: Vec<f64>,
    /// Neighbour at smaller y.
    pub south: Vec<f64>,
    /// Neighbour at larger y.
    pub north: Vec<f64>,
}

impl FivePoint {
    /// All zero, for `unknowns` nodes.
    pub fn new(unknowns: usize) -> Self {
        let zero = vec![0.0; unknowns];
        Self { centre: zero.clone(), west: zero.clone(), east: zero.clone(), south: zero.clone(), north: zero }
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        for diagonal in [&mut self.centre, &mut self.west, &mut self.east, &mut self.south, &mut self.north] {
            diagonal.fill(0.0);
        }
    }
}

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

/// Solver for five-point systems of one size, with its workspace.
#[derive(Clone, Debug)]
pub struct BlockSolver {
    columns: usize,
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
    /// For `rows` × `columns` unknowns.
    pub fn new(rows: usize, columns: usize) -> Self {
        let groups = columns.div_ceil(LANES);
        let line = vec![[0.0; LANES]; groups];
        let mut units = vec![[0.0; LANES]; columns * groups];
        for p in 0..columns {
            units[p * groups + p / LANES][p % LANES] = 1.0;
        }
        Self {
            columns,
            inverses: vec![[0.0; LANES]; rows * columns * groups],
            west: line.clone(),
            known: line.clone(),
            image: line.clone(),
            pivot: line,
            units,
        }
    }

    /// Replaces `rhs` by the solution of the system with `stencil`'s neighbours and `centre` \[a value an unknown\] in place
    /// of its own. Couplings that leave the grid are ignored.
    pub fn solve(&mut self, stencil: &FivePoint, centre: &[f64], rhs: &mut [f64]) {
        with_columns!(self.columns, B => vectorised(
            #[inline(always)]
            || self.solve_columns::<B>(stencil, centre, rhs)
        ));
    }

    #[inline(always)]
    fn solve_columns<const B: usize>(&mut self, stencil: &FivePoint, centre: &[f64], rhs: &mut [f64]) {
        let b = if B == 0 { self.columns } else { B };
        let groups = b.div_ceil(LANES);
        let block = b * groups;
        let rows = centre.len() / b;
        let (west, known, image) = (&mut self.west[..groups], &mut self.known[..groups], &mut self.image[..groups]);
        for row in 0..rows {
            let at = row * b;
            let (before, rest) = self.inverses.split_at_mut(row * block);
            let inverse = &mut rest[..block];
            inverse.fill([0.0; LANES]);
            let entries = inverse.as_flattened_mut();
            let s = groups * LANES;
            for c in 0..b {
                entries[c * s + c] = centre[at + c];
                if c > 0 {
                    entries[c * s + c - 1] = stencil.north[at + c - 1];
                }
                if c + 1 < b {
                    entries[c * s + c + 1] = stencil.south[at + c + 1];
                }
            }
            known.as_flattened_mut()[..b].copy_from_slice(&rhs[at..at + b]);
            if row > 0 {
                let last = &before[(row - 1) * block..][..block];
                west.as_flattened_mut()[..b].copy_from_slice(&stencil.west[at..at + b]);
                for g in 0..groups {
                    known[g] = minus(known[g], times(west[g], image[g]));
                }
                let east = &stencil.east[at - b..at];
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
                *known = stencil.east[at + r] * rhs[at + b + r];
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
            let mut stencil = FivePoint::new(n);
            let mut dense = DMatrix::<f64>::zeros(n, n);
            let value = |k: usize, d: usize| -0.1 - ((k * 7 + d * 13) % 11) as f64 / 11.0;
            for k in 0..n {
                stencil.centre[k] = 5.0 + (k % 3) as f64;
                (stencil.west[k], stencil.east[k]) = (value(k, 1), value(k, 2));
                (stencil.south[k], stencil.north[k]) = (value(k, 3), value(k, 4));
                dense[(k, k)] = stencil.centre[k];
                if k >= columns {
                    dense[(k, k - columns)] = stencil.west[k];
                }
                if k + columns < n {
                    dense[(k, k + columns)] = stencil.east[k];
                }
                if k % columns > 0 {
                    dense[(k, k - 1)] = stencil.south[k];
                }
                if (k + 1) % columns > 0 {
                    dense[(k, k + 1)] = stencil.north[k];
                }
            }
            let mut rhs: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
            let expected = dense.lu().solve(&DVector::from_vec(rhs.clone())).unwrap();
            let centre = stencil.centre.clone();
            BlockSolver::new(rows, columns).solve(&stencil, &centre, &mut rhs);
            for i in 0..n {
                assert!((rhs[i] - expected[i]).abs() < 1e-13, "{rows} × {columns}, {i}: {} {}", rhs[i], expected[i]);
            }
        }
    }
}
