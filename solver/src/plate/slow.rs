//! Slow motion of a plate that floats: its creep back to equilibrium, and its oscillation.
//!
//! A plate pushed off its height h by δ e^(st), slowly beside the vibration, has m s² + K(s) = 0 with
//!
//! ```text
//! K(s) = −dF/dh + k_T (1 − m(κ)),   κ² = 12 μ b² s/(p_a h ψ(Z_e)),   k_T = p_a A (dZ_e/dh)/√(h² − a²)
//! ```
//!
//! −dF/dh is what remains of the force when gas has had time to leave, 1 − m the answer of the linear film ([`linear_response`]): gas that
//! has none is a spring, k_T, and one that is leaving damps, c = dK/ds at 0. Both follow from the film of high frequency averaged over a cycle
//! (`film::trapped`), ∂Z/∂t = ∇·[M h ψ(Z) ∇Z] with Z = Z_e(h, a) at the edges, whose load is p_a ∫ Z dA/√(h² − a²) − p_a A.
//!
//! Where the vibrating film leaks within a cycle, c is the mean over the cycle of the damping of an incompressible film. In between, both
//! are mixed in proportion to the square of 1 − S, with S the spring of the linear film at the least gap and the frequency of the
//! vibration; half of S (1 − S) times their difference counts as error. A plate that is light enough to shake has an amplitude of its own,
//! |K(iω)|/(m ω²) of the vibration's: twice that fraction of both stiffnesses counts as error, too.
//!
//! K(s) is that of springs and dashpots: the equation has one pair of complex roots or none, and all other roots are real.

use crate::dimensionless::Dimensionless;
use crate::estimate::Estimate;
use crate::film::exact::{linear_response, viscous_force};
use crate::film::slip::{Mobility, SlipLaw};
use crate::film::trapped::edge_height;
use crate::numerics::bessel::ZERO_OF_J0;
use crate::problem::{GRAVITY, Outline, Plate};
use crate::solution::{Floating, SlowMotion};
use nalgebra::Complex;
use std::f64::consts::{PI, TAU};

/// Samples of a cycle.
const SAMPLES: usize = 256;
/// Fraction of S (1 − S) times the difference of the two dampings that counts as error.
const MIXED: f64 = 0.5;
/// Creep is reported if at least this fraction of a displacement decays by it.
const TOLD: f64 = 0.01;
/// Ratio of successive rates in the search for a root, and the smallest rate, as a fraction of the leak rate.
const RATES: f64 = 1.25;
const LEAST_RATE: f64 = 1e-9;

/// Slow motion of `plate` at the gap at which it floats, for the mass whose weight is its `load`; `None` if the plate is not stable, or its
/// motion is not slower than the vibration.
pub(super) fn slow_motion(plate: &Plate, load: f64, floating: &Floating) -> Option<SlowMotion> {
    let (mass, Estimate { value: stiffness, error }) = (load / GRAVITY, floating.stiffness);
    if !floating.is_stable() {
        return None;
    }
    let film = SlowFilm::of(plate, mass, stiffness)?;
    let higher = Plate { mean_gap: plate.mean_gap + floating.mean_gap.error, ..plate.clone() };
    let mut others = vec![SlowFilm { stiffness: stiffness * (1.0 + 2.0 * film.shakes) + error, ..film }];
    // No gap above is known: then neither is an error.
    others.extend(SlowFilm::of(&higher, mass, stiffness));
    others.push(SlowFilm { trapped: film.trapped * (1.0 + film.doubt), ..film });
    others.push(SlowFilm { time: film.time * (1.0 + film.doubt), ..film });
    let known = others.len() == 4;
    let estimate = |number: &dyn Fn(&SlowFilm) -> Option<f64>| {
        let value = number(&film)?;
        let off = |other: &SlowFilm| number(other).map_or(f64::INFINITY, |other| (other - value).abs());
        let error = if known { others.iter().map(off).sum() } else { f64::INFINITY };
        Some(Estimate { value, error })
    };
    let (creep, swing) = film.roots();
    let near = |root: Option<Complex<f64>>| move |film: &SlowFilm| film.newton(root?);
    let (creep, swing) = (near(creep), near(swing));
    let damping = estimate(&|film| Some(film.damping()))?;
    let ratio = |film: &SlowFilm| film.damping() / (2.0 * (film.stiffness * mass).sqrt());
    Some(SlowMotion {
        damping,
        damping_ratio: estimate(&|film| Some(ratio(film)))?,
        creep_time: estimate(&|film| Some(-1.0 / creep(film)?.re)),
        swing_frequency: estimate(&|film| Some(swing(film)?.im / TAU)),
        swing_decay: estimate(&|film| Some(-1.0 / swing(film)?.re)),
    })
}

/// The film as the mass on it feels it.
#[derive(Clone, Copy, Debug)]
struct SlowFilm {
    mass: f64,
    /// −dF/dh.
    stiffness: f64,
    /// k_T.
    trapped: f64,
    /// κ²/s \[s\].
    time: f64,
    outline: Outline,
    /// Relative uncertainty of the damping and the spring of the gas.
    doubt: f64,
    /// Relative change of the amplitude of a plate that is light enough to shake, due to the acceleration by the swing of the force.
    shakes: f64,
}

impl SlowFilm {
    fn of(plate: &Plate, mass: f64, stiffness: f64) -> Option<Self> {
        let (gas, law, outline) = (&plate.gas, SlipLaw::of(&plate.gas), plate.outline());
        let (h, a) = (plate.mean_gap, plate.amplitude);
        let phases = || (0..SAMPLES).map(|i| i as f64 / SAMPLES as f64);
        let edge = |h: f64| edge_height(law, || phases().map(move |phase| h + a * (TAU * phase).cos()));
        let step = 1e-4 * (h - a);
        let (height, slope) = (edge(h), (edge(h + step) - edge(h - step)) / (2.0 * step));
        let omega = TAU * plate.frequency;
        let per_rate = Dimensionless::of_plate(plate).squeeze_number * h / omega;
        let trapped = gas.ambient_pressure * plate.area() * slope / ((h - a) * (h + a)).sqrt();
        let mut film =
            Self { mass, stiffness, trapped, time: per_rate / law.at(height).0, outline, doubt: 0.0, shakes: 0.0 };
        let leaking = phases().map(|phase| viscous_force(plate, plate.gap(phase), -1.0)).sum::<f64>() / SAMPLES as f64;
        // The film damps most where the gap is least.
        let least = h - a;
        let vibrating = linear_response(Complex::new(0.0, omega * per_rate * h / (least * law.at(least).0)), outline);
        let (leaks, more) = ((1.0 + vibrating.re).clamp(0.0, 1.0), leaking / film.damping() - 1.0);
        film.trapped *= 1.0 + leaks * leaks * more;
        let shaken = Complex::new(0.0, omega);
        film.shakes = (film.balance(shaken) / (shaken * shaken * mass) - 1.0).norm();
        film.doubt = MIXED * leaks * (1.0 - leaks) * more.abs() + 2.0 * film.shakes;
        (film.doubt < 1.0 && film.time.is_finite()).then_some(film)
    }

    /// dK/ds at 0 \[N s/m\].
    fn damping(&self) -> f64 {
        let slow = 1e-4;
        -self.trapped * self.time * linear_response(Complex::new(slow, 0.0), self.outline).re / slow
    }

    /// m s² + K(s).
    fn balance(&self, s: Complex<f64>) -> Complex<f64> {
        s * s * self.mass + self.stiffness - linear_response(s * self.time, self.outline) * self.trapped
    }

    fn slope(&self, s: Complex<f64>) -> Complex<f64> {
        let step = s * 1e-5;
        (self.balance(s + step) - self.balance(s - step)) / (step * 2.0)
    }

    /// The root that Newton's method finds from `s`.
    fn newton(&self, mut s: Complex<f64>) -> Option<Complex<f64>> {
        for _ in 0..60 {
            let step = self.balance(s) / self.slope(s);
            s -= step;
            if step.norm() < 1e-9 * s.norm() {
                return (s.re < 0.0).then_some(s);
            }
        }
        None
    }

    /// The rate of creep, the slowest real root, if it is worth reporting; and the complex root of the oscillation.
    fn roots(&self) -> (Option<Complex<f64>>, Option<Complex<f64>>) {
        let fast = ((self.stiffness + self.trapped) / self.mass).sqrt();
        let slow = (self.stiffness / self.mass).sqrt();
        let starts = [fast, slow, (fast * slow).sqrt()].into_iter().flat_map(|size| {
            [-0.1, -0.5, -0.9].map(|cosine: f64| Complex::new(cosine, (1.0 - cosine * cosine).sqrt()) * size)
        });
        let found: Vec<_> = starts.filter_map(|start| self.newton(start)).collect();
        let (pairs, real): (Vec<_>, Vec<_>) = found.into_iter().partition(|s| s.im.abs() > 1e-6 * s.norm());
        let swing = pairs.first().map(|s| Complex::new(s.re, s.im.abs()));
        // The slowest real root lies below the slowest leak rate of the film.
        let leak = match self.outline {
            Outline::Strip | Outline::Ring { .. } => PI * PI,
            Outline::Rectangle { aspect } => PI * PI * (1.0 + aspect.powi(-2)),
            Outline::Disc => ZERO_OF_J0 * ZERO_OF_J0,
        } / self.time;
        let beyond = |rate: f64| {
            let s = Complex::new(-rate, 0.0);
            self.balance(s).re < 0.0 || linear_response(s * self.time, self.outline).re < -1.0
        };
        let mut low = LEAST_RATE * leak;
        while low * RATES < leak && !beyond(low * RATES) {
            low *= RATES;
        }
        let mut high = (low * RATES).min(leak);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if beyond(middle) { high = middle } else { low = middle }
        }
        let slowest = real.into_iter().fold(Complex::new(-low, 0.0), |a, b| if b.re > a.re { b } else { a });
        let share = (self.slope(slowest) * slowest).inv().norm() * self.stiffness;
        ((swing.is_none() || share > TOLD).then_some(slowest), swing)
    }
}
