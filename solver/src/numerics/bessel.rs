//! Modified Bessel functions of orders 0 and 1 of a complex argument in the right half plane, |arg z| ≤ π/4, scaled so that nothing
//! overflows: I e^(−z) and K e^z.
//!
//! Up to |z| = 25, I is computed by its power series, in which cancellation leaves thirteen digits, and K(z) e^z = ∫ exp(−z (cosh t − 1))
//! cosh νt dt by the trapezoidal rule, which converges exponentially. Beyond that, Hankel's asymptotic series is used. (Abramowitz and
//! Stegun 1964, sections 9.6 and 9.7.)

use nalgebra::Complex;

/// I₀, I₁ times e^(−z), and K₀, K₁ times e^z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bessel {
    /// I₀(z) e^(−z), I₁(z) e^(−z).
    pub i: [Complex<f64>; 2],
    /// K₀(z) e^z, K₁(z) e^z.
    pub k: [Complex<f64>; 2],
}

/// First zero of the Bessel function J₀.
pub const ZERO_OF_J0: f64 = 2.404_825_557_695_773;

/// Largest |z| at which the power series is used.
const SMALL: f64 = 25.0;
/// Step of the trapezoidal rule, and the exponent beyond which its integrand is negligible.
const STEP: f64 = 0.1;
const NOTHING: f64 = 45.0;

/// The functions at `z`.
pub fn scaled(z: Complex<f64>) -> Bessel {
    if z.norm() > SMALL {
        let root = (z * std::f64::consts::TAU).sqrt();
        let i = [0, 1].map(|order| hankel(order, z, -1.0) / root);
        let k = [0, 1].map(|order| hankel(order, z, 1.0) / root * std::f64::consts::PI);
        return Bessel { i, k };
    }
    let decay = (-z).exp();
    Bessel { i: [0, 1].map(|order| series(order, z) * decay), k: [0, 1].map(|order| integral(order, z)) }
}

/// Σ (z/2)^(2k + ν)/(k! (k + ν)!).
fn series(order: i32, z: Complex<f64>) -> Complex<f64> {
    let square = z * z * 0.25;
    let mut term = if order == 0 { Complex::new(1.0, 0.0) } else { z * 0.5 };
    let mut sum = term;
    for k in 1..200 {
        term *= square / f64::from(k * (k + order));
        sum += term;
        if term.norm() < f64::EPSILON * sum.norm() {
            break;
        }
    }
    sum
}

fn integral(order: i32, z: Complex<f64>) -> Complex<f64> {
    let mut sum = Complex::new(0.5, 0.0);
    for step in 1..1000 {
        let t = STEP * f64::from(step);
        let excess = t.cosh() - 1.0;
        if excess * z.re - f64::from(order) * t > NOTHING {
            break;
        }
        sum += (-z * excess).exp() * (f64::from(order) * t).cosh();
    }
    sum * STEP
}

/// Σ (±1)^k a_k/z^k, a_k = (4ν² − 1²)(4ν² − 3²) … (4ν² − (2k − 1)²)/(8^k k!).
fn hankel(order: i32, z: Complex<f64>, sign: f64) -> Complex<f64> {
    let mut term = Complex::new(1.0, 0.0);
    let mut sum = term;
    for k in 1..30 {
        let odd = f64::from(2 * k - 1);
        term *= Complex::new(sign * (4.0 * f64::from(order * order) - odd * odd), 0.0) / (z * (8.0 * f64::from(k)));
        sum += term;
        if term.norm() < f64::EPSILON {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabulated_values() {
        // Abramowitz and Stegun 1964, tables 9.8 and 9.11, and I and K on the ray arg z = π/4 from the Kelvin functions at 1:
        // ber = 0.98438178, bei = 0.24956604, ker = 0.28670621, kei = −0.49499464.
        let one = scaled(Complex::new(1.0, 0.0));
        for (found, exact) in [
            (one.i[0], 0.465_759_607_6),
            (one.i[1], 0.207_910_415_3),
            (one.k[0], 1.144_463_079_8),
            (one.k[1], 1.636_153_486_3),
        ] {
            assert!((found - exact).norm() < 1e-10, "{found} {exact}");
        }
        let z = Complex::from_polar(1.0, std::f64::consts::FRAC_PI_4);
        let ray = scaled(z);
        let (i, k) = (ray.i[0] * z.exp(), ray.k[0] * (-z).exp());
        assert!((i - Complex::new(0.984_381_78, 0.249_566_04)).norm() < 1e-8, "{i}");
        assert!((k - Complex::new(0.286_706_21, -0.494_994_64)).norm() < 1e-8, "{k}");
    }

    #[test]
    fn the_wronskian_is_one_over_z_at_every_size() {
        for size in [1e-6, 0.01, 1.0, 5.0, 20.0, 24.99, 25.01, 100.0, 1e6, 1e12] {
            let z = Complex::from_polar(size, std::f64::consts::FRAC_PI_4);
            let Bessel { i, k } = scaled(z);
            let wronskian = (i[0] * k[1] + i[1] * k[0]) * z;
            assert!((wronskian - 1.0).norm() < 1e-11, "{size}: {wronskian}");
        }
    }

    #[test]
    fn series_and_asymptotes_meet() {
        for order in [0, 1] {
            let z = Complex::from_polar(SMALL, std::f64::consts::FRAC_PI_4);
            let far = hankel(order, z, -1.0) / (z * std::f64::consts::TAU).sqrt();
            assert!((series(order, z) * (-z).exp() / far - 1.0).norm() < 1e-11);
        }
    }
}
