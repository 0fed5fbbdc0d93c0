//! Stiffness and mass of one element: a rectangle, quadratic both ways.
//!
//! With u_r = U cos mθ, u_θ = V sin mθ, u_z = W cos mθ the strains are
//!
//! ```text
//! ε_rr = U_r              γ_rz = U_z + W_r           (cos mθ)
//! ε_zz = W_z              γ_rθ = V_r − (V + mU)/r    (sin mθ)
//! ε_θθ = (U + mV)/r       γ_zθ = V_z − mW/r          (sin mθ)
//! ```
//!
//! and the energy for an angle of one radian, but for the mean ½ of cos² and sin², is ½ ∫ [λ(ε_rr + ε_zz + ε_θθ)² +
//! 2G(ε_rr² + ε_zz² + ε_θθ²) + G(γ_rz² + γ_rθ² + γ_zθ²)] r dr dz. Between two nodes the stiffness is a block of 3 ×
//! 3. Its places without θ and the one of θθ hold a constant; those that couple θ with another direction are
//! proportional to m; the diagonal has a part with m². So one block and one number, m²/r² G or (λ+2G), describe all
//! orders.
//!
//! The shape functions are products of polynomials in r and in z, and so are the integrals.

use super::section::Material;
use crate::numerics::gauss_legendre;

/// Directions: r, θ, z.
pub(super) const DIRECTIONS: usize = 3;

/// Stiffness and mass that couple two nodes of an element.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pair {
    /// Stiffness for order 1 but for its part with m², `[direction of the first node][of the second]` \[N/m per
    /// radian\].
    pub(super) base: [[f64; DIRECTIONS]; DIRECTIONS],
    /// Addition to the diagonal of the stiffness for each m².
    pub(super) square: [f64; DIRECTIONS],
    /// Mass \[kg per radian\], for each direction.
    pub(super) mass: [f64; DIRECTIONS],
}

impl Pair {
    /// Adds what another element brings.
    pub(super) fn add(&mut self, other: &Self) {
        for p in 0..DIRECTIONS {
            (0..DIRECTIONS).for_each(|q| self.base[p][q] += other.base[p][q]);
            self.square[p] += other.square[p];
            self.mass[p] += other.mass[p];
        }
    }

    /// Takes out what a support holds of the first node and of the second. The diagonal of what is held stays,
    /// without mass: nothing drives it, so that it does not move.
    pub(super) fn hold(&mut self, first: [bool; DIRECTIONS], second: [bool; DIRECTIONS], itself: bool) {
        for p in 0..DIRECTIONS {
            for q in (0..DIRECTIONS).filter(|q| first[p] || second[*q]) {
                if p != q || !itself {
                    self.base[p][q] = 0.0;
                }
                if p == q {
                    self.square[p] = 0.0;
                    self.mass[p] = 0.0;
                }
            }
        }
    }
}

/// Integrals of products of two of the three quadratic shape functions over an interval.
#[derive(Clone, Debug)]
pub(super) struct Integrals([[[f64; 3]; 3]; 7]);

/// Which derivatives and which weight.
const PLAIN: usize = 0;
const SLOPE_FIRST: usize = 1;
const SLOPES: usize = 2;
const WEIGHTED: usize = 3;
const WEIGHTED_SLOPES: usize = 4;
const WEIGHTED_SLOPE_FIRST: usize = 5;
const DIVIDED: usize = 6;

/// The three shape functions and their derivatives at `x` of [a, b].
fn shapes(a: f64, b: f64, x: f64) -> ([f64; 3], [f64; 3]) {
    let (s, scale) = ((2.0 * x - a - b) / (b - a), 2.0 / (b - a));
    ([0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)], [(s - 0.5) * scale, -2.0 * s * scale, (s + 0.5) * scale])
}

impl Integrals {
    /// Over [a, b], with the weights 1, `x` and 1/x: all for r, those with 1 for z.
    pub(super) fn new(a: f64, b: f64) -> Self {
        let of = |i: usize, j: usize, kind: usize| {
            gauss_legendre(a, b, |x| {
                let (shape, slope) = shapes(a, b, x);
                match kind {
                    PLAIN => shape[i] * shape[j],
                    SLOPE_FIRST => slope[i] * shape[j],
                    SLOPES => slope[i] * slope[j],
                    WEIGHTED => shape[i] * shape[j] * x,
                    WEIGHTED_SLOPES => slope[i] * slope[j] * x,
                    WEIGHTED_SLOPE_FIRST => slope[i] * shape[j] * x,
                    _ => shape[i] * shape[j] / x,
                }
            })
        };
        Self(std::array::from_fn(|kind| std::array::from_fn(|i| std::array::from_fn(|j| of(i, j, kind)))))
    }
}

/// ∫ N_i r dr of the three shape functions over [a, b].
pub(super) fn weights(a: f64, b: f64) -> [f64; 3] {
    std::array::from_fn(|i| gauss_legendre(a, b, |r| shapes(a, b, r).0[i] * r))
}

/// Nodes `a` and `b` of the element whose integrals along r and z are given.
pub(super) fn pair(material: &Material, along: &Integrals, up: &Integrals, a: usize, b: usize) -> Pair {
    let Material { youngs_modulus: e, poisson_ratio: nu, density, .. } = *material;
    let g = e / (2.0 * (1.0 + nu));
    let lambda = 2.0 * g * nu / (1.0 - 2.0 * nu);
    let (stiff, (i, k), (j, l)) = (lambda + 2.0 * g, (a % 3, a / 3), (b % 3, b / 3));
    let (r, z) = (|kind: usize| along.0[kind][i][j], |kind: usize| up.0[kind][k][l]);
    // Derivative of the second function alone.
    let (r_second, z_second) = (along.0[SLOPE_FIRST][j][i], up.0[SLOPE_FIRST][l][k]);
    let weighted_second = along.0[WEIGHTED_SLOPE_FIRST][j][i];
    let height = z(PLAIN);
    let (rr, zz) = (r(WEIGHTED_SLOPES) * height, r(WEIGHTED) * z(SLOPES));
    let (rz, zr) = (r(WEIGHTED_SLOPE_FIRST) * z_second, weighted_second * z(SLOPE_FIRST));
    let (r0, z0) = (r(SLOPE_FIRST) * height, r(PLAIN) * z(SLOPE_FIRST));
    let (r0_second, z0_second) = (r_second * height, r(PLAIN) * z_second);
    let hoop = r(DIVIDED) * height;
    let both = r0 + r0_second;
    Pair {
        base: [
            [
                stiff * (rr + hoop) + lambda * both + g * zz,
                lambda * r0 + (stiff + g) * hoop - g * r0_second,
                lambda * (rz + z0_second) + g * zr,
            ],
            [
                lambda * r0_second + (stiff + g) * hoop - g * r0,
                g * (rr - both + hoop + zz),
                lambda * z0_second - g * z0,
            ],
            [lambda * (zr + z0) + g * rz, lambda * z0 - g * z0_second, stiff * zz + g * rr],
        ],
        square: [g * hoop, stiff * hoop, g * hoop],
        mass: [density * r(WEIGHTED) * height; DIRECTIONS],
    }
}
