//! The smooth part of the rotor's deflection as a few harmonics of the wavelength.
//!
//! Amplitudes are scaled by √(2|C_n − C_∞|/λ), so that every mode's own stiffness is ±1 and the matrices are well
//! conditioned. Order of unknowns: z₀, cos₁ … cos_{N−1}, sin₁ … sin_{N−1}.
//!
//! A table may have a harmonic that is stiffer than the last one, C_n < C_∞. Its part of the deflection and its stiffness are then
//! negative, and the solution is not a minimum but a saddle point, convex in all other unknowns and concave in this one. There is still
//! exactly one, because the whole compliance, C_n > 0, is positive.

use crate::numerics::{dot, vectorised};
use crate::rotor::Compliances;
use nalgebra::{DMatrix, DVectorView};

/// Cosines and sines of the harmonics at the contact nodes, and the compliance of each.
#[derive(Clone, Debug)]
pub struct Modes {
    nodes: usize,
    /// Harmonics with a smooth part, N − 1.
    count: usize,
    local: f64,
    /// √(2|C_n − C_∞|/λ) for n = 1 … N−1.
    scale: Vec<f64>,
    /// Sign of C_n − C_∞ for n = 1 … N−1: −1 for a harmonic that is stiffer than the local part.
    sign: Vec<f64>,
    /// cos(k_n x_i), `[n][i]`, n = 0 … 2(N−1).
    cosines: Vec<f64>,
    /// sin(k_n x_i), `[n][i]`.
    sines: Vec<f64>,
    /// 1 − C_n/C_∞ of the stiffest harmonic, or 0.
    stiffest: f64,
}

/// The unknowns of one instant, kept as the start of the next solve; by default nothing is known yet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shape {
    /// z₀ \[m\], then the scaled cosine and sine amplitudes; empty before the first solve.
    pub(super) amplitudes: Vec<f64>,
}

impl Shape {
    /// The same shape with the number of these modes, cut or padded.
    pub fn resized(&self, modes: &Modes) -> Self {
        let Some(old) = self.amplitudes.len().checked_sub(1).map(|both| both / 2) else { return Self::default() };
        let mut amplitudes = vec![0.0; modes.unknowns()];
        amplitudes[0] = self.amplitudes[0];
        for n in 0..old.min(modes.count) {
            amplitudes[1 + n] = self.amplitudes[1 + n];
            amplitudes[1 + modes.count + n] = self.amplitudes[1 + old + n];
        }
        Self { amplitudes }
    }
}

/// Number of harmonics N that a rotor needs, at least 4 and at most `most`: the smallest N from which on the compliances of all harmonics
/// differ from the local compliance by at most `fraction` of it.
///
/// Harmonics from N on are given the local compliance. The error is at most `fraction` or, if `most` limits N, is estimated from the
/// differences between grids.
pub fn cutoff(rotor: &Compliances, fraction: f64, most: usize) -> usize {
    let last = rotor.beyond(most);
    let matters = |n: usize| (rotor.harmonic(n) - last).abs() > fraction * last;
    (4..most).rev().find(|&n| matters(n)).map_or(4.min(most), |n| n + 1)
}

impl Modes {
    /// The modes of `harmonics` = N harmonics at nodes `x` \[m\], with C(k_N) as the local compliance. As a rule C(k_N) differs from its
    /// limit by at most `fraction` of it ([`cutoff`]). Where it differs by less, because N is a whole number and at least 4, a local
    /// compliance nearer to the limit is used.
    pub fn new(rotor: &Compliances, harmonics: usize, fraction: f64, x: &[f64]) -> Self {
        let wavelength = rotor.wavelength();
        let (last, limit) = (rotor.harmonic(harmonics), rotor.beyond(harmonics));
        let excess = (last - limit).abs() / limit;
        let local = if excess < fraction { limit + excess / fraction * (last - limit) } else { last };
        let count = harmonics - 1;
        let smooth = |n: usize| rotor.harmonic(n) - local;
        let scale = (1..=count).map(|n| (2.0 * smooth(n).abs() / wavelength).sqrt()).collect();
        let sign = (1..=count).map(|n| if smooth(n) < 0.0 { -1.0 } else { 1.0 }).collect();
        // Each harmonic is obtained from the one before, by a rotation through the angle of the first harmonic at each node.
        let nodes = x.len();
        let size = (1 + 2 * count) * nodes;
        let (mut cosines, mut sines) = (vec![1.0; size], vec![0.0; size]);
        let (sin, cos): (Vec<f64>, Vec<f64>) =
            x.iter().map(|x| (std::f64::consts::TAU / wavelength * x).sin_cos()).unzip();
        for at in (nodes..size).step_by(nodes) {
            let ((c, next_c), (s, next_s)) = (cosines.split_at_mut(at), sines.split_at_mut(at));
            let (c, s) = (&c[at - nodes..], &s[at - nodes..]);
            let next = next_c.iter_mut().zip(next_s);
            for (((next_c, next_s), (c, s)), (cos, sin)) in next.zip(c.iter().zip(s)).zip(cos.iter().zip(&sin)) {
                (*next_c, *next_s) = (c * cos - s * sin, s * cos + c * sin);
            }
        }
        let stiffest = (1..=count).map(|n| -smooth(n) / local).fold(0.0, f64::max);
        Self { nodes, count, local, scale, sign, cosines, sines, stiffest }
    }

    /// Keeps the whole compliance positive on nodes that stand for `lengths` \[m\]. On too few nodes, short waves are aliased as longer
    /// ones, and together their negative parts might exceed the local part. Then all harmonics stiffer than the local part are made less
    /// stiff.
    pub(super) fn keep_positive(&mut self, lengths: &[f64]) {
        let stiff: Vec<usize> = (1..self.unknowns()).filter(|k| self.sign(*k) < 0.0).collect();
        if stiff.is_empty() {
            return;
        }
        // Both matrices have the same largest eigenvalue; the smaller one is used.
        let taken = if stiff.len() < self.nodes {
            self.stiffness(lengths).select_rows(&stiff).select_columns(&stiff)
        } else {
            let mut taken = self.compliance(|sign| f64::from(sign < 0.0));
            scale_both(&mut taken, &lengths.iter().map(|length| length.sqrt()).collect::<Vec<_>>());
            taken
        };
        let (allowed, most) = (self.stiffest, taken.symmetric_eigenvalues().max() / self.local);
        if most > allowed {
            for (scale, _) in self.scale.iter_mut().zip(&self.sign).filter(|(_, sign)| **sign < 0.0) {
                *scale *= (allowed / most).sqrt();
            }
        }
    }

    /// Deflection \[m/N\] at each node under a unit force at each node, of all harmonics, each weighted by a function of its sign.
    pub(super) fn compliance(&self, weight: impl Fn(f64) -> f64) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.nodes, self.nodes);
        for n in 1..=self.count {
            for wave in [self.cosine(n), self.sine(n)] {
                let wave = DVectorView::from_slice(wave, self.nodes);
                matrix.ger(weight(self.sign[n - 1]) * self.scale[n - 1].powi(2), &wave, &wave, 1.0);
            }
        }
        matrix
    }

    /// C_∞ \[m²/N\].
    pub fn local_compliance(&self) -> f64 {
        self.local
    }

    /// Sign of the stiffness of mode `index` by itself (not of z₀): −1 for a mode stiffer than the local part.
    pub(super) fn sign(&self, index: usize) -> f64 {
        self.sign[(index - 1) % self.count]
    }

    /// Number of unknowns: z₀ and two for each harmonic.
    pub fn unknowns(&self) -> usize {
        1 + 2 * self.count
    }

    #[inline(always)]
    fn cosine(&self, n: usize) -> &[f64] {
        &self.cosines[n * self.nodes..(n + 1) * self.nodes]
    }

    #[inline(always)]
    fn sine(&self, n: usize) -> &[f64] {
        &self.sines[n * self.nodes..(n + 1) * self.nodes]
    }

    /// z₀ + smooth deflection \[m\] at the nodes.
    pub fn deflection(&self, amplitudes: &[f64], out: &mut [f64]) {
        out.fill(amplitudes[0]);
        vectorised(
            #[inline(always)]
            || {
                for n in 1..=self.count {
                    let scale = self.sign[n - 1] * self.scale[n - 1];
                    let (a, b) = (amplitudes[n] * scale, amplitudes[self.count + n] * scale);
                    for ((u, c), s) in out.iter_mut().zip(self.cosine(n)).zip(self.sine(n)) {
                        *u += a * c + b * s;
                    }
                }
            },
        );
    }

    /// The total of nodal forces \[N\], then their projection on each scaled mode.
    pub fn project(&self, force: &[f64], out: &mut [f64]) {
        out[0] = force.iter().sum();
        let (cosines, sines) = out[1..].split_at_mut(self.count);
        self.fourier(force, 1, cosines, sines);
        for (out, scale) in out[1..].iter_mut().zip(self.scale.iter().cycle()) {
            *out *= scale;
        }
    }

    /// Sums of nodal `values` times the cosines and sines of the harmonics from number `first` on.
    fn fourier(&self, values: &[f64], first: usize, cosines: &mut [f64], sines: &mut [f64]) {
        vectorised(
            #[inline(always)]
            || {
                for (n, (cosine, sine)) in cosines.iter_mut().zip(sines).enumerate() {
                    *cosine = dot(values, self.cosine(first + n));
                    *sine = dot(values, self.sine(first + n));
                }
            },
        );
    }

    /// Largest force \[N\] by which the load or a mode is out of balance, from the gradient of the energy.
    pub fn imbalance(&self, gradient: &[f64]) -> f64 {
        let modal = gradient[1..].iter().zip(self.scale.iter().cycle()).filter(|(_, scale)| **scale > 0.0);
        let newtons = modal.map(|(g, scale)| (g / scale).abs());
        newtons.fold(gradient[0].abs(), |top, f| if f.is_nan() { f64::INFINITY } else { top.max(f) })
    }

    /// Σ_i κ_i ψ_a(x_i) ψ_b(x_i) for nodal stiffness κ \[N/m\]: products of harmonics are sums of harmonics, so that the
    /// matrix is made of the first 2(N−1) Fourier coefficients of κ (a Toeplitz and a Hankel part).
    pub fn stiffness(&self, nodal: &[f64]) -> DMatrix<f64> {
        let m = self.count;
        let (mut c, mut s) = (vec![0.0; 1 + 2 * m], vec![0.0; 1 + 2 * m]);
        self.fourier(nodal, 0, &mut c, &mut s);
        let mut matrix = DMatrix::zeros(1 + 2 * m, 1 + 2 * m);
        matrix[(0, 0)] = c[0];
        for a in 1..=m {
            matrix[(a, 0)] = self.scale[a - 1] * c[a];
            matrix[(m + a, 0)] = self.scale[a - 1] * s[a];
            for b in 1..=a {
                let scale = 0.5 * self.scale[a - 1] * self.scale[b - 1];
                matrix[(a, b)] = scale * (c[a - b] + c[a + b]);
                matrix[(m + a, m + b)] = scale * (c[a - b] - c[a + b]);
                // The block of sin_a cos_b and its mirror image, sin_b cos_a.
                matrix[(m + a, b)] = scale * (s[a + b] + s[a - b]);
                matrix[(m + b, a)] = scale * (s[a + b] - s[a - b]);
            }
        }
        matrix.fill_upper_triangle_with_lower_triangle();
        matrix
    }
}

/// Entry (i, j) times `factors` i and j.
pub(super) fn scale_both(matrix: &mut DMatrix<f64>, factors: &[f64]) {
    for (mut column, factor) in matrix.column_iter_mut().zip(factors) {
        column.iter_mut().zip(factors).for_each(|(value, other)| *value *= factor * other);
    }
}
