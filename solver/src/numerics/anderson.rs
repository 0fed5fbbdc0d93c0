//! Anderson acceleration of a fixed-point iteration x ← g(x) (Walker and Ni, SIAM J. Numer. Anal. 49, 2011).

use super::dot;
use nalgebra::{DMatrix, DVector};

/// Remembers the last few steps of a fixed-point iteration and proposes the next point.
#[derive(Clone, Debug)]
pub struct Anderson {
    depth: usize,
    longest_step: f64,
    previous: Option<(Vec<f64>, Vec<f64>)>,
    steps: Vec<Vec<f64>>,
    changes: Vec<Vec<f64>>,
    previous_norm: f64,
}

impl Anderson {
    /// Uses at most `depth` earlier steps; no component moves by more than `longest_step` at once.
    pub fn new(depth: usize, longest_step: f64) -> Self {
        Self {
            depth,
            longest_step,
            previous: None,
            steps: Vec::new(),
            changes: Vec::new(),
            previous_norm: f64::INFINITY,
        }
    }

    /// Replaces `x` by the next point, given `image` = g(x).
    pub fn advance(&mut self, x: &mut [f64], image: &[f64]) {
        let residual: Vec<f64> = image.iter().zip(x.iter()).map(|(g, x)| g - x).collect();
        let norm = dot(&residual, &residual).sqrt();
        if norm > 3.0 * self.previous_norm {
            // Discard the history.
            *self = Self::new(self.depth, self.longest_step);
        }
        if let Some((last_x, last_residual)) = &self.previous {
            if self.steps.len() == self.depth {
                self.steps.remove(0);
                self.changes.remove(0);
            }
            self.steps.push(x.iter().zip(last_x).map(|(a, b)| a - b).collect());
            self.changes.push(residual.iter().zip(last_residual).map(|(a, b)| a - b).collect());
        }
        self.previous = Some((x.to_vec(), residual.clone()));
        self.previous_norm = norm;

        let mut step = residual.clone();
        let count = self.steps.len();
        if count > 0 {
            let gram = DMatrix::from_fn(count, count, |i, j| dot(&self.changes[i], &self.changes[j]));
            let right = DVector::from_fn(count, |i, _| dot(&self.changes[i], &residual));
            // Columns are scaled to unit length; singular directions, which repeat others, are left out.
            let scale: Vec<f64> = (0..count).map(|i| gram[(i, i)].max(f64::MIN_POSITIVE).sqrt().recip()).collect();
            let gram = DMatrix::from_fn(count, count, |i, j| gram[(i, j)] * scale[i] * scale[j]);
            let right = DVector::from_fn(count, |i, _| right[i] * scale[i]);
            let eigen = gram.symmetric_eigen();
            let mut weights = DVector::<f64>::zeros(count);
            for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
                if *value > 1e-12 {
                    weights += vector * (vector.dot(&right) / value);
                }
            }
            for k in 0..count {
                let weight = weights[k] * scale[k];
                for ((s, dx), dr) in step.iter_mut().zip(&self.steps[k]).zip(&self.changes[k]) {
                    *s -= weight * (dx + dr);
                }
            }
        }
        for (x, s) in x.iter_mut().zip(&step) {
            *x += s.clamp(-self.longest_step, self.longest_step);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_linear_problem_in_as_many_steps_as_it_has_modes() {
        // x ← A x + b with slow modes 0.99, 0.9, −0.5: plain iteration needs a thousand rounds.
        let (rates, shift) = ([0.99, 0.9, -0.5], [1.0, -2.0, 0.3]);
        let mut x = vec![0.0; 3];
        let mut anderson = Anderson::new(5, 1e6);
        for _ in 0..6 {
            let image: Vec<f64> = (0..3).map(|i| rates[i] * x[i] + shift[i]).collect();
            anderson.advance(&mut x, &image);
        }
        for i in 0..3 {
            let exact: f64 = shift[i] / (1.0 - rates[i]);
            assert!((x[i] - exact).abs() < 1e-8 * exact.abs(), "{i}: {} {exact}", x[i]);
        }
    }
}
