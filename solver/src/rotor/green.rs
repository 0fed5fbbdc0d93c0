//! A rotor given by its Green's function, the deflection G(x) under a unit force at 0.
//!
//! A line load q cos kx deflects it by q cos kx ∫ G(s) cos ks ds, so that
//!
//! ```text
//! C(k_n) = 2 ∫₀^X G(x) cos k_n x dx,
//! ```
//!
//! X being half the wavelength if the table reaches that far: it then is the answer to one force in every wavelength, as the paper's
//! Fig. 3. A shorter table ends where G has died out. The integral is the trapezoidal sum over the rows, which of even rows is exactly
//! the inverse of the sum that the paper's equation (8) makes of its nodes, a local compliance at x = 0 included.
//!
//! The excess of G(0) over the line through the next two rows is taken to be such a local compliance, times the first step.
//!
//! Two errors are stated: a third of the difference to the sum over every second row, the rule being of second order; and the contribution
//! of a tail beyond X, at most 2 |G(X)|/k_n if it dies out without turning (the second mean value theorem). No more harmonics are resolved
//! than the rows tell apart, and beyond the last of these the compliance is taken to be local.

use super::compliances::{Compliances, RotorError, Wave, smooth_share};
use std::f64::consts::{PI, TAU};

/// A table that ends within this share of half the wavelength reaches that far.
const NEAR: f64 = 1e-3;

/// Compliances of the first `count` harmonics of `wave`.
pub(super) fn resolve(rows: &[(f64, f64)], wave: &Wave, count: usize) -> Result<Compliances, RotorError> {
    let half = 0.5 * wave.length;
    let inside: Vec<(f64, f64)> = rows.iter().copied().filter(|(x, _)| *x <= (1.0 + NEAR) * half).collect();
    let (end, last) = inside.last().copied().unwrap_or_default();
    let periodic = end >= (1.0 - NEAR) * half;
    let steps = inside.windows(2).map(|pair| pair[1].0 - pair[0].0);
    let finest = steps.fold(f64::INFINITY, f64::min);
    let (smooth, local) = split(&inside);
    let coarse: Vec<(f64, f64)> = smooth.iter().copied().step_by(2).collect();
    let mut harmonics = Vec::with_capacity(count);
    let (mut off, mut lost) = (0.0, false);
    for n in 1..=count {
        let k = TAU * n as f64 / wave.length;
        if k * finest > PI * (1.0 + NEAR) {
            break;
        }
        let bent = transform(&smooth, k);
        let sampling = if 2.0 * k * finest < PI { (bent - transform(&coarse, k)).abs() / 3.0 } else { 0.0 };
        let compliance = bent + local;
        let error = sampling + if periodic { 0.0 } else { 2.0 * last.abs() / k };
        if compliance <= error || lost {
            // Not known but for its size: it is given that of the last one that is.
            let Some(last) = harmonics.last() else {
                return Err(RotorError::Green { harmonic: n, compliance, error });
            };
            (lost, off) = (true, off + last);
            continue;
        }
        harmonics.push(compliance);
        off += error;
    }
    let Some(local) = harmonics.last().copied() else {
        return Err(RotorError::Green { harmonic: 1, compliance: 0.0, error: f64::INFINITY });
    };
    let relative_error = smooth_share(&harmonics, off);
    Ok(Compliances { wavelength: wave.length, harmonics: harmonics.into(), local, relative_error })
}

/// The rows without the local compliance at x = 0, and that \[m²/N\].
fn split(rows: &[(f64, f64)]) -> (Vec<(f64, f64)>, f64) {
    let mut smooth = rows.to_vec();
    let [first, (x1, g1), (x2, g2), ..] = &mut smooth[..] else { return (smooth, 0.0) };
    let without = *g1 + (*g1 - *g2) * *x1 / (*x2 - *x1);
    let local = (first.1 - without) * *x1;
    if local <= 0.0 {
        return (smooth, 0.0);
    }
    first.1 = without;
    (smooth, local)
}

/// 2 ∫ G cos kx dx over the rows, by the trapezoidal rule.
fn transform(rows: &[(f64, f64)], k: f64) -> f64 {
    let values = rows.iter().map(|(x, g)| (x, g * (k * x).cos()));
    let pairs = values.clone().zip(values.skip(1));
    pairs.map(|((x0, g0), (x1, g1))| (x1 - x0) * (g0 + g1)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Cancel;
    use crate::problem::RotorCompliance;
    use crate::rotor::ring::Band;

    const WAVE: Wave = Wave { length: 0.026, waves: 7, band: Band { radius: 0.029, width: 3e-4 } };

    /// Deflection of the beam on its foundation under a point force.
    fn beam(x: f64, decay: f64) -> f64 {
        0.64e-6 * (-x / decay).exp() * ((x / decay).cos() + (x / decay).sin())
    }

    fn rows(end: f64, steps: usize, green: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let x = |i: usize| end * i as f64 / steps as f64;
        (0..=steps).map(|i| (x(i), green(x(i)))).collect()
    }

    #[test]
    fn the_beam_comes_back_within_the_stated_error() {
        let decay = 1.5e-3;
        let rotor = RotorCompliance::Beam { decay_length: decay, point_compliance: 0.64e-6, local_compliance: 0.0 };
        let exact = rotor.resolve(&WAVE, 30, &Cancel::new()).unwrap();
        // One force alone, until the deflection has died out or not quite, and one in every wavelength.
        let images = |x: f64| (-3..=3).map(|i| beam((x + f64::from(i) * WAVE.length).abs(), decay)).sum::<f64>();
        for (end, most, table) in [
            (12e-3, 2e-3, rows(12e-3, 240, |x| beam(x, decay))),
            (5e-3, 0.4, rows(5e-3, 100, |x| beam(x, decay))),
            (13e-3, 1e-3, rows(13e-3, 260, images)),
        ] {
            let found = resolve(&table, &WAVE, 30).unwrap();
            let sum = |c: &Compliances| (1..=30).map(|n| c.harmonic(n)).sum::<f64>();
            let off = (sum(&found) / sum(&exact) - 1.0).abs();
            assert!(off < found.relative_error && found.relative_error < most, "{end}: {off} {found:?}");
            assert!((found.harmonic(1) / exact.harmonic(1) - 1.0).abs() < 2.0 * most, "{end}");
        }
    }

    #[test]
    fn a_local_compliance_at_the_force_is_local() {
        // c δ(x) on nodes is c over their spacing; half of it belongs to either side.
        let (spacing, local) = (WAVE.length / 180.0, 1.05e-10);
        let table = rows(0.5 * WAVE.length, 90, |x| if x == 0.0 { local / spacing } else { 0.0 });
        let found = resolve(&table, &WAVE, 90).unwrap();
        assert!((1..=90).all(|n| (found.harmonic(n) / local - 1.0).abs() < 1e-12), "{found:?}");
        assert!(found.relative_error < 1e-12, "{found:?}");
        assert_eq!(found.harmonic(1000), found.harmonic(90));
    }

    #[test]
    fn a_table_that_does_not_yield_is_refused() {
        let refused = resolve(&rows(13e-3, 130, |x| -beam(x, 1.5e-3)), &WAVE, 30).unwrap_err().to_string();
        assert!(refused.contains("rotor.green: harmonic 1 of the wave has the compliance -"), "{refused}");
    }
}
