//! LU factors of a banded matrix without pivoting, in place.
//!
//! For matrices that are diagonally dominant by columns (M-matrices of conservative schemes), where pivoting is not
//! needed for stability. Row k is stored as `a[k·(2b+1) + (j−k+b)]`, |j−k| ≤ b.

/// A square banded matrix of order n and half bandwidth b, and then its LU factors.
#[derive(Clone, Debug, Default)]
pub struct Banded {
    order: usize,
    half: usize,
    rows: Vec<f64>,
}

impl Banded {
    /// A zero matrix.
    pub fn new(order: usize, half_bandwidth: usize) -> Self {
        Self { order, half: half_bandwidth, rows: vec![0.0; order * (2 * half_bandwidth + 1)] }
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        self.rows.fill(0.0);
    }

    /// Row `k`: entry j is at `[j − k + b]`.
    pub fn row_mut(&mut self, k: usize) -> &mut [f64] {
        let width = 2 * self.half + 1;
        &mut self.rows[k * width..(k + 1) * width]
    }

    /// Replaces the matrix by its factors and `rhs` by the solution. About 2 n b² operations.
    pub fn solve_in_place(&mut self, rhs: &mut [f64]) {
        let (n, b) = (self.order, self.half);
        let width = 2 * b + 1;
        for k in 0..n {
            let (head, tail) = self.rows.split_at_mut((k + 1) * width);
            let pivot_row = &head[k * width + b + 1..];
            let inverse = 1.0 / head[k * width + b];
            let rhs_k = rhs[k];
            for r in 1..=b.min(n - 1 - k) {
                let row = &mut tail[(r - 1) * width..r * width];
                let factor = row[b - r] * inverse;
                for (target, source) in row[b - r + 1..].iter_mut().zip(pivot_row) {
                    *target -= factor * source;
                }
                rhs[k + r] -= factor * rhs_k;
            }
        }
        for k in (0..n).rev() {
            let row = &self.rows[k * width..(k + 1) * width];
            let mut sum = rhs[k];
            for r in 1..=b.min(n - 1 - k) {
                sum -= row[b + r] * rhs[k + r];
            }
            rhs[k] = sum / row[b];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn agrees_with_a_dense_solve() {
        for (n, b) in [(1, 0), (5, 1), (17, 4), (9, 8)] {
            let mut dense = DMatrix::<f64>::zeros(n, n);
            let mut banded = Banded::new(n, b);
            for i in 0..n {
                for j in i.saturating_sub(b)..(i + b + 1).min(n) {
                    let value = ((i * 7 + j * 13) % 11) as f64 / 11.0 + if i == j { 2.0 * b as f64 + 1.0 } else { 0.0 };
                    dense[(i, j)] = value;
                    banded.row_mut(i)[j + b - i] = value;
                }
            }
            let mut rhs: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
            let expected = dense.lu().solve(&DVector::from_vec(rhs.clone())).unwrap();
            banded.solve_in_place(&mut rhs);
            for i in 0..n {
                assert!((rhs[i] - expected[i]).abs() < 1e-13, "{n} {b} {i}");
            }
        }
    }
}
