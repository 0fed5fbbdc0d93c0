//! Exact and asymptotic solutions of the film, used by the tests, the lessons and the window.
//!
//! All are for a plate with a gap that is uniform in space, H = h/h₀ = 1 + ε cos τ, in the dimensionless form
//! σ ∂(PH)/∂τ = ∇·[(P H³ + 6 m H²) ∇P], σ = 12μωb²/(p_a h₀²), m = λ_a/h₀.

use super::slip::{Mobility, SlipLaw};
use crate::numerics::bessel::{self, Bessel};
use crate::problem::{Outline, Plate};
use nalgebra::Complex;
use std::f64::consts::PI;

/// Trapped height Z for σ → ∞ away from the edges, constant in time and space: Z²/2 + slip Z = invariant_mean/gap_mean,
/// with `invariant_mean` = ⟨H³/2 + slip H²⟩ and `gap_mean` = ⟨H⟩. `slip` is 6m; with all lengths in metres it is
/// 6λ_a \[m\].
pub fn trapped_height(invariant_mean: f64, gap_mean: f64, slip: f64) -> f64 {
    let right = invariant_mean / gap_mean;
    // (−6m + √(36m² + 2·right)), written without cancellation.
    2.0 * right / (slip + (slip * slip + 2.0 * right).sqrt())
}

/// Amplitude of a plate's net load for ε → 0, divided by p_a·area·ε: the load at κ² = iσ, σ based on [`Plate::squeezed_length`] and, with
/// first-order slip, divided by 1 + 6m. The real part is the spring, negative if it restores; the imaginary part is minus the damping,
/// negative if it dissipates.
pub fn linear_load(squeeze_number: f64, outline: Outline) -> Complex<f64> {
    let square = Complex::new(0.0, squeeze_number);
    match outline {
        Outline::Ring { hole } => vibrating_ring(square, hole),
        _ => linear_response(square, outline),
    }
}

/// The same for any κ². For a plate that moves as e^(st), κ² = s·σ/ω: the response of a film at rest to a motion that oscillates, grows or
/// decays.
pub fn linear_response(square: Complex<f64>, outline: Outline) -> Complex<f64> {
    match outline {
        Outline::Strip => strip(square),
        Outline::Rectangle { aspect } => rectangle(square, aspect),
        Outline::Disc => disc(square),
        Outline::Ring { hole } => ring(square, hole),
    }
}

/// Load of a strip at κ²: tanh(κ/2)/(κ/2) − 1.
fn strip(square: Complex<f64>) -> Complex<f64> {
    let half = square.sqrt() * 0.5;
    tanh(half) / half - 1.0
}

/// tanh without overflow at large arguments.
fn tanh(z: Complex<f64>) -> Complex<f64> {
    if z.re > 20.0 { Complex::new(1.0, 0.0) } else { z.tanh() }
}

/// Load of a rectangle of length 1 along x and width `aspect` along y, by Blech's double series (ASME J. Lubrication Technology 105,
/// 1983), summed over the index across in closed form.
///
/// Linearised: κ²(P₁ + 1) = ∇²P₁, P₁ = 0 on the edge. Expanded in sin nπx, n odd: P₁ = Σ (4/nπ) f_n(y) sin nπx,
/// f_n'' − (n²π² + κ²) f_n = κ². Mean of f_n over y ∈ (−a/2, a/2): −κ²/q² (1 − tanh(qa/2)/(qa/2)), q² = n²π² + κ². The load is
/// Σ 8/(n²π²) ⟨f_n⟩.
fn rectangle(square: Complex<f64>, aspect: f64) -> Complex<f64> {
    if aspect < 1.0 {
        // The same plate, turned by a quarter, takes fewer terms.
        return rectangle(square * (aspect * aspect), aspect.recip());
    }
    let mut load = Complex::new(0.0, 0.0);
    for n in (1..MOST_TERMS).step_by(2) {
        let k = f64::from(n) * PI;
        let with_along = square + k * k;
        let half = with_along.sqrt() * (0.5 * aspect);
        let profile = Complex::new(1.0, 0.0) - tanh(half) / half;
        let term = -square / with_along * profile * (8.0 / (k * k));
        load += term;
        // The terms fall at least as 1/n², so the remainder is at most n/2 times the last term.
        if f64::from(n) * term.norm() < 2.0 * SERIES_TOLERANCE * load.norm() {
            break;
        }
    }
    load
}

/// Load of a disc of radius 1 at κ²: 2 I₁(κ)/(κ I₀(κ)) − 1.
fn disc(square: Complex<f64>) -> Complex<f64> {
    let kappa = square.sqrt();
    let Bessel { i, .. } = bessel::scaled(kappa);
    i[1] / (kappa * i[0]) * 2.0 - 1.0
}

/// Load at an imaginary κ² of a ring whose inner radius is `hole` times the outer one, and which is 1 wide.
fn vibrating_ring(square: Complex<f64>, hole: f64) -> Complex<f64> {
    // P₁ + 1 = a I₀(κr) + b K₀(κr), 1 at both radii, whose difference is 1. ∫ r I₀ = r I₁/κ, ∫ r K₀ = −r K₁/κ; I is taken times
    // exp(−κ r_o), K times exp(κ r_i).
    let kappa = square.sqrt();
    let radii = [hole / (1.0 - hole), 1.0 / (1.0 - hole)];
    let [inner, outer] = radii.map(|r| bessel::scaled(kappa * r));
    let across = (-kappa).exp();
    let (i, k) = ([inner.i[0] * across, outer.i[0]], [inner.k[0], outer.k[0] * across]);
    let determinant = i[1] * k[0] - i[0] * k[1];
    let (a, b) = ((k[0] - k[1]) / determinant, (i[1] - i[0]) / determinant);
    let of_i = (outer.i[1] * radii[1] - inner.i[1] * across * radii[0]) / kappa;
    let of_k = (inner.k[1] * radii[0] - outer.k[1] * across * radii[1]) / kappa;
    (a * of_i + b * of_k) * 2.0 / (radii[1] * radii[1] - radii[0] * radii[0]) - 1.0
}

/// Load of a ring at any κ², also where K₀ cannot be used, by finite volumes in the radius: (r u')' = κ² r u, u = 1 at both edges.
fn ring(square: Complex<f64>, hole: f64) -> Complex<f64> {
    let (inner, step) = (hole / (1.0 - hole), 1.0 / RING_INTERVALS as f64);
    let radius = |i: f64| inner + i * step;
    // Elimination from the inside out, u_i = a_i u_(i+1) + b_i; then back-substitution, with ∫ r u.
    let mut rows = vec![(Complex::new(0.0, 0.0), Complex::new(1.0, 0.0))];
    for i in 1..RING_INTERVALS {
        let [below, above] = [-0.5, 0.5].map(|side| radius(i as f64 + side));
        let (a, b) = rows[i - 1];
        let diagonal = square * (radius(i as f64) * step * step) + below + above - a * below;
        rows.push((diagonal.inv() * above, b * below / diagonal));
    }
    let mut u = Complex::new(1.0, 0.0);
    let mut sum = u * (0.5 * (radius(0.0) + radius(RING_INTERVALS as f64)));
    for (i, (a, b)) in rows.iter().enumerate().skip(1).rev() {
        u = a * u + b;
        sum += u * radius(i as f64);
    }
    sum * step / (inner + 0.5) - 1.0
}

/// Number of intervals along the radius of a ring.
const RING_INTERVALS: usize = 256;
/// A series is ended when its estimated remainder is below this fraction of the sum.
const SERIES_TOLERANCE: f64 = 1e-10;
/// Largest index of a series.
const MOST_TERMS: i32 = 20_001;

/// Force per metre of an incompressible strip film (σ → 0), −μ b³ ḣ/h³/(1 + 6 λ_a/h) \[N/m\], from viscosity \[Pa s\], length
/// b \[m\], gap h \[m\], its rate ḣ \[m/s\] and the mean free path \[m\].
pub fn viscous_strip_force(viscosity: f64, length: f64, gap: f64, rate: f64, mean_free_path: f64) -> f64 {
    -viscosity * length.powi(3) * rate / gap.powi(3) / (1.0 + 6.0 * mean_free_path / gap)
}

/// Force of an incompressible film under a rectangle \[N\] of `width` w along y \[m\]; the other arguments are those of the strip. It is
/// the strip's force times the width, times 1 − (192/π⁵)(b/w) Σ tanh(nπw/2b)/n⁵, n odd, the ratio of a duct's flow to a slit's.
fn viscous_rectangle_force(viscosity: f64, length: f64, width: f64, gap: f64, rate: f64, mean_free_path: f64) -> f64 {
    width * rectangle_to_strip(width / length) * viscous_strip_force(viscosity, length, gap, rate, mean_free_path)
}

/// Force of an incompressible film under a ring of radii `inner` and `outer` \[m\], or under a disc (inner = 0; Reynolds 1886), \[N\]:
/// −(3πμḣ/2h³) [r_o⁴ − r_i⁴ − (r_o² − r_i²)²/ln(r_o/r_i)]/(1 + 6 λ_a/h).
fn viscous_ring_force(viscosity: f64, inner: f64, outer: f64, gap: f64, rate: f64, mean_free_path: f64) -> f64 {
    let squares = (outer - inner) * (outer + inner);
    let pumped = if inner > 0.0 { squares * squares / (outer / inner).ln() } else { 0.0 };
    let shape = squares * (outer * outer + inner * inner) - pumped;
    -1.5 * PI * viscosity * rate / gap.powi(3) * shape / (1.0 + 6.0 * mean_free_path / gap)
}

/// Force \[N, of a strip N/m\] of an incompressible film at ambient pressure, for a `gap` \[m\] that changes at `rate` \[m/s\].
pub fn viscous_force(plate: &Plate, gap: f64, rate: f64) -> f64 {
    let gas = &plate.gas;
    // The slip factor at ambient pressure, 1 + 6 λ/h with an effective mean free path λ.
    let factor = SlipLaw::of(gas).at(gap).0 / gap;
    let path = (factor - 1.0) * gap / 6.0;
    match (plate.width, plate.hole) {
        (_, Some(hole)) => viscous_ring_force(gas.viscosity, hole, plate.radius(), gap, rate, path),
        (None, None) => viscous_strip_force(gas.viscosity, plate.length, gap, rate, path),
        (Some(width), None) => viscous_rectangle_force(gas.viscosity, plate.length, width, gap, rate, path),
    }
}

/// Incompressible load, per unit of width, of a rectangle of length 1 and width `aspect`, over that of a strip.
fn rectangle_to_strip(aspect: f64) -> f64 {
    if aspect < 1.0 {
        // The same plate, turned: here the sum would nearly cancel the 1.
        return aspect * aspect * rectangle_to_strip(aspect.recip());
    }
    let sum: f64 = (1..400)
        .step_by(2)
        .map(|n| {
            let n = f64::from(n);
            (0.5 * n * PI * aspect).tanh() / n.powi(5)
        })
        .sum();
    1.0 - 192.0 / PI.powi(5) / aspect * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_viscous_rectangle_looks_the_same_from_both_sides_and_is_the_slow_limit() {
        let force = |b: f64, w: f64| viscous_rectangle_force(2.0, b, w, 0.3, 0.7, 0.01);
        assert!((force(1.0, 0.4) / force(0.4, 1.0) - 1.0).abs() < 1e-9);
        // The load of a strip, per metre of the longer side.
        let strip = 5.0 * viscous_strip_force(2.0, 1e-4, 0.3, 0.7, 0.01);
        assert!((force(5.0, 1e-4) / strip - 1.0).abs() < 1e-4, "{}", force(5.0, 1e-4) / strip);
        assert!((force(1.0, 1e6) / (1e6 * viscous_strip_force(2.0, 1.0, 0.3, 0.7, 0.01)) - 1.0).abs() < 1e-5);
        for aspect in [0.2, 1.0, 7.0] {
            let slow = 1e-4;
            let damping = -linear_load(slow, Outline::Rectangle { aspect }).im;
            assert!((damping / (slow / 12.0 * rectangle_to_strip(aspect)) - 1.0).abs() < 1e-6, "{aspect}");
        }
    }

    #[test]
    fn round_films_have_the_viscous_and_the_trapped_limit() {
        let near = |(a, b): (f64, f64), within: f64| (a / b - 1.0).abs() < within;
        for hole in [0.0, 0.05, 0.3, 0.9] {
            let outline = if hole == 0.0 { Outline::Disc } else { Outline::Ring { hole } };
            let load = |sigma: f64| linear_load(sigma, outline);
            let across = 1.0 / (1.0 - hole);
            // σ → 0: damping is that of the incompressible film, σ × force for 12 μ ω = 1, h = 1 over the area.
            let area = PI * across * across * (1.0 - hole * hole);
            let viscous = viscous_ring_force(1.0 / 12.0, hole * across, across, 1.0, 1.0, 0.0) / area;
            assert!(near((load(1e-3).im, 1e-3 * viscous), 1e-6), "{hole}: {:?} {viscous}", load(1e-3));
            // σ → ∞: a layer of 1/κ at the edges leaks, for each of them.
            let edges = 2.0 * PI * across * (1.0 + hole) / area;
            let far = load(1e10);
            assert!(
                near((1.0 + far.re, edges * 0.5f64.sqrt() * 1e-5), 1e-3) && near((-far.im, far.re + 1.0), 1e-3),
                "{hole}: {far:?}"
            );
        }
        // A thin ring is a strip.
        let [ring, strip] = [Outline::Ring { hole: 0.999 }, Outline::Strip].map(|outline| linear_load(12.5, outline));
        assert!((ring.re - strip.re).abs() < 1e-6 && (ring.im - strip.im).abs() < 1e-6, "{ring:?} {strip:?}");
    }

    #[test]
    fn a_strip_at_any_squeeze_number_has_its_limit() {
        for sigma in [1e5, 1e7, 1e13] {
            let (load, layer) = (linear_load(sigma, Outline::Strip), (2.0 / sigma).sqrt());
            assert!((load.re + 1.0 - layer).abs() < 1e-6 * layer && (load.im + layer).abs() < 1e-6 * layer, "{load:?}");
        }
    }

    #[test]
    fn the_response_to_any_motion_is_that_to_a_vibration_and_to_a_decay() {
        for sigma in [0.3, 20.0, 900.0] {
            for hole in [0.02, 0.4, 0.97] {
                let square = Complex::new(0.0, sigma);
                let (exact, found) = (vibrating_ring(square, hole), ring(square, hole));
                assert!((found - exact).norm() < 2e-4 * found.norm(), "{found} {exact}");
            }
        }
        // Dying out, a strip's pressure is a cosine, tan(q/2)/(q/2) in the mean; so is a thin ring's and a long rectangle's.
        for q in [0.5f64, 2.0, 3.0] {
            let exact = (0.5 * q).tan() / (0.5 * q) - 1.0;
            for outline in [Outline::Strip, Outline::Ring { hole: 0.999 }, Outline::Rectangle { aspect: 1e5 }] {
                let found = linear_response(Complex::new(-q * q, 0.0), outline);
                assert!((found.re / exact - 1.0).abs() < 2e-3 && found.im.abs() < 1e-9, "{outline:?} {found} {exact}");
            }
        }
    }

    #[test]
    fn a_very_wide_rectangle_is_a_strip() {
        for sigma in [0.1, 10.0, 1000.0] {
            let [strip, wide] =
                [Outline::Strip, Outline::Rectangle { aspect: 1e7 }].map(|outline| linear_load(sigma, outline));
            assert!((strip.re - wide.re).abs() < 1e-6 && (strip.im - wide.im).abs() < 1e-6, "{strip:?} {wide:?}");
        }
    }

    #[test]
    fn a_rectangle_looks_the_same_from_both_sides() {
        // Swapping length and width rescales σ by aspect².
        let load = |sigma: f64, aspect: f64| linear_load(sigma / 1.6, Outline::Rectangle { aspect });
        let (a, b) = (load(20.0, 0.4), load(20.0 * 0.16, 2.5));
        assert!((a.re - b.re).abs() < 1e-6 && (a.im - b.im).abs() < 1e-6, "{a:?} {b:?}");
    }
}
