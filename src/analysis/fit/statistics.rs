//! How well measurements determine the unknowns.

use nalgebra::DMatrix;

/// Singular values below this share of the largest count as zero, because differences of solves are no more accurate.
const RANK: f64 = 1e-4;

/// Certainty of the unknowns x, from the derivatives J of (computed/error).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Certainty {
    /// (JᵀJ)⁻¹ of the directions that are determined.
    pub(super) covariance: DMatrix<f64>,
    /// Directions of x, of length 1, that the measurements do not determine.
    pub(super) undetermined: Vec<Vec<f64>>,
}

impl Certainty {
    /// `columns`: of each unknown ∂(computed/error)/∂x for all measurements.
    pub(super) fn of(columns: &[Vec<f64>]) -> Self {
        let (rows, unknowns) = (columns.first().map_or(0, Vec::len), columns.len());
        let jacobian = DMatrix::from_fn(rows, unknowns, |row, unknown| columns[unknown][row]);
        let nothing = || Self { covariance: DMatrix::zeros(unknowns, unknowns), undetermined: Vec::new() };
        if jacobian.is_empty() {
            return nothing();
        }
        let Some(decomposed) = jacobian.try_svd(false, true, f64::EPSILON, 0) else { return nothing() };
        let Some(directions) = decomposed.v_t else { return nothing() };
        let values = decomposed.singular_values;
        let greatest = values.max();
        let mut found = nothing();
        for (i, value) in values.iter().enumerate() {
            let direction = directions.row(i);
            if *value > RANK * greatest {
                found.covariance += direction.transpose() * direction / (value * value);
            } else {
                found.undetermined.push(direction.iter().copied().collect());
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_the_covariance_of_the_textbook() {
        // y = a + b t, errors 1: (JᵀJ)⁻¹ = 1/(n Σt² − (Σt)²) [Σt², −Σt; −Σt, n].
        let t = [0.0, 1.0, 2.0, 5.0];
        let found = Certainty::of(&[vec![1.0; 4], t.to_vec()]);
        let (sum, squares) = (8.0, 30.0);
        let determinant = 4.0 * squares - sum * sum;
        let expected = [squares, -sum, -sum, 4.0].map(|value| value / determinant);
        for (found, expected) in found.covariance.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
        assert!(found.undetermined.is_empty());
    }

    #[test]
    fn what_only_a_sum_is_measured_of_is_not_determined() {
        let found = Certainty::of(&[vec![1.0, 2.0, 3.0], vec![1.0, 2.0, 3.0]]);
        let [direction] = &found.undetermined[..] else { panic!("{found:?}") };
        assert!((direction[0] + direction[1]).abs() < 1e-12 && direction[0].abs() > 0.7);
    }
}
