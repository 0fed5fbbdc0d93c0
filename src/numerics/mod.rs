//! Numerical building blocks that know no physics.

pub mod anderson;
pub mod banded;
pub mod grading;

/// Dot product with four running sums, so that the compiler may use vector registers. Same result on every run.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, a_rest) = a.as_chunks::<4>();
    let (b4, b_rest) = b.as_chunks::<4>();
    for (u, v) in a4.iter().zip(b4) {
        for lane in 0..4 {
            sums[lane] += u[lane] * v[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(u, v)| u * v).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
