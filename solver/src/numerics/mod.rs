//! Numerical building blocks without physics.

pub mod anderson;
pub mod bessel;
pub mod grading;
pub mod legendre;
pub mod lines;
pub mod rows;
pub mod system;

/// Runs `work`, which has to be inlined whole, compiled for the widest vector registers of this processor. The operations
/// and their order stay the same, and so do the results of `work`, to the last bit, whatever the registers.
#[inline(always)]
pub fn vectorised<R>(work: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(work)
}

/// ∫ f from a to b by Gauss–Legendre quadrature with ten points.
pub fn gauss_legendre(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    const HALF: [(f64, f64); 5] = [
        (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
        (0.433_395_394_129_247_2, 0.269_266_719_309_996_3),
        (0.679_409_568_299_024_4, 0.219_086_362_515_982),
        (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
        (0.973_906_528_517_171_7, 0.066_671_344_308_688_1),
    ];
    let (middle, reach) = (0.5 * (a + b), 0.5 * (b - a));
    reach * HALF.iter().map(|(x, weight)| weight * (f(middle - reach * x) + f(middle + reach * x))).sum::<f64>()
}

/// Dot product.
#[inline(always)]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    sum_of(a, b, |u, v| u * v)
}

/// Sum of a term over all pairs of values, in sixteen partial sums, so that the compiler can use several vector registers at once. The
/// result is the same on every run.
#[inline(always)]
pub fn sum_of(a: &[f64], b: &[f64], term: impl Fn(f64, f64) -> f64) -> f64 {
    const SUMS: usize = 16;
    let mut sums = [0.0; SUMS];
    let (whole_a, rest_a) = a.as_chunks::<SUMS>();
    let (whole_b, rest_b) = b.as_chunks::<SUMS>();
    for (u, v) in whole_a.iter().zip(whole_b) {
        for lane in 0..SUMS {
            sums[lane] += term(u[lane], v[lane]);
        }
    }
    let rest: f64 = rest_a.iter().zip(rest_b).map(|(u, v)| term(*u, *v)).sum();
    sums.iter().sum::<f64>() + rest
}
