//! The laws against exact results.

use super::*;
use crate::numerics::gauss_legendre;
use std::f64::consts::{PI, TAU};

const SUMMITS: Summits = Summits { rms: 1e-7, radius: 5e-5, density: 1e10, modulus: 5.5e10 };

fn all() -> impl Iterator<Item = Asperities> {
    LAWS.iter().flat_map(|law| HEIGHTS.iter().map(|heights| Asperities::new(SUMMITS, law, heights)))
}

/// Fₙ by adding up the heights one by one.
fn moment(n: f64, u: f64) -> f64 {
    let density = |s: f64| (-0.5 * s * s).exp() / TAU.sqrt();
    let panel = |i: usize| {
        gauss_legendre(i as f64 / 40.0, (i + 1) as f64 / 40.0, |x| 2.0 * x.powf(2.0 * n + 1.0) * density(u + x * x))
    };
    (0..240).map(panel).sum()
}

#[test]
fn gaussian_moments_are_those_of_the_normal_distribution() {
    for (order, n) in [(Order::One, 1.0), (Order::ThreeHalves, 1.5), (Order::FiveHalves, 2.5)] {
        for u in [-4.0, -1.007, 0.0, 0.503, 1.0, 2.71, 4.0, 8.3] {
            let (log, _) = (gaussian::HEIGHTS.moment)(order, u);
            let exact = moment(n, u);
            assert!((log.exp() / exact - 1.0).abs() < 1e-9, "F_{n}({u}) = {}, {exact}", log.exp());
        }
    }
    // Whole moments: of half the distribution, Γ((n + 1)/2) 2^{n/2}/(2 √π).
    let half = (gaussian::HEIGHTS.moment)(Order::One, 0.0).0.exp();
    assert!((half - 1.0 / TAU.sqrt()).abs() < 1e-12, "{half}");
    // Published: F_{5/2}(0) = 0.61664, F_{3/2}(0) = 0.43003 (Greenwood and Tripp 1970).
    let [gt, gw] = [Order::FiveHalves, Order::ThreeHalves].map(|order| (gaussian::HEIGHTS.moment)(order, 0.0).0.exp());
    assert!((gt - 0.616_64).abs() < 1e-5 && (gw - 0.430_02).abs() < 2e-5, "{gt} {gw}");
}

#[test]
fn pressure_falls_and_is_convex_everywhere() {
    for asperities in all() {
        let mut last = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..4000 {
            let d = (-8.0 + 0.01 * f64::from(i)) * SUMMITS.rms;
            let (p, slope) = asperities.pressure(d);
            assert!(
                p >= 0.0 && p < last.0 && slope >= last.1 - 1e-9 * slope.abs(),
                "{asperities:?} {d}: {p} {slope} {last:?}"
            );
            let step = 1e-5 * SUMMITS.rms;
            let [more, less] = [d + step, d - step].map(|d| asperities.pressure(d).0);
            let difference = (more - less) / (2.0 * step);
            assert!(i == 400 || (slope - difference).abs() < 1e-6 * slope.abs() + 1e-3, "{d}: {slope} {difference}");
            last = (p, slope);
        }
        assert_eq!(asperities.pressure(1e-3).0, 0.0);
    }
}

#[test]
fn exponential_heights_make_the_logarithm_of_the_load_fall_with_the_separation() {
    for law in LAWS {
        let asperities = Asperities::new(SUMMITS, law, &exponential::HEIGHTS);
        let (first, _) = asperities.pressure(0.0);
        for d in [0.3e-7, 1e-7, 5e-7, 2e-6] {
            let expected = first * (-d / SUMMITS.rms).exp();
            assert!((asperities.pressure(d).0 / expected - 1.0).abs() < 1e-12, "{} {d}", law.name);
        }
    }
}

/// Summits of one height are Hertz contacts, and far fewer than one asperity reaches further than a few σ: the law's factor by hand.
#[test]
fn stiffness_by_hand() {
    let gw = Asperities::new(SUMMITS, &greenwood_williamson::LAW, &exponential::HEIGHTS).pressure(0.0).0;
    // 4/3 · 55 GPa · 10⁴/mm² · √(50 µm) · (0.1 µm)^{3/2} · ¾√π.
    let expected = 4.0 / 3.0 * 5.5e10 * 1e10 * 5e-5_f64.sqrt() * 1e-7_f64.powf(1.5) * 0.75 * PI.sqrt();
    assert!((gw / expected - 1.0).abs() < 1e-12, "{gw} {expected}");
    let gt = Asperities::new(SUMMITS, &greenwood_tripp::LAW, &exponential::HEIGHTS).pressure(0.0).0;
    // ηRσ = 0.05, √(σ/R) = 0.0447; 16 √2 π/15 = 4.739.
    assert!((gt / (4.739 * 0.0025 * 0.044_72 * 5.5e10 * 3.3234) - 1.0).abs() < 1e-3, "{gt}");
}

#[test]
fn the_mean_gap_is_that_of_gaussian_heights_and_back() {
    let asperities = all().next().unwrap();
    for u in [0.0, 0.2, 1.0, 2.5, 6.0, 100.0] {
        let (gap, slope) = asperities.mean_gap(u * SUMMITS.rms);
        // ⟨max(u + s, 0)⟩ = u + F₁(u).
        let exact = u + if u < 12.0 { moment(1.0, u) } else { 0.0 };
        assert!((gap / SUMMITS.rms - exact).abs() < 1e-9, "{u}: {gap}");
        assert!((0.5 - 1e-9..=1.0).contains(&slope));
        assert!((asperities.separation(gap) / SUMMITS.rms - u).abs() < 1e-9, "{u}");
    }
    assert!((asperities.least_gap() / SUMMITS.rms - 0.398_942).abs() < 1e-6);
}

#[test]
fn separation_under_a_pressure_carries_it() {
    for asperities in all() {
        for pressure in [1.0, 1e5, 1e7, 1e9, 1e13] {
            let found = asperities.pressure(asperities.separation_under(pressure)).0;
            assert!((found / pressure - 1.0).abs() < 1e-9, "{asperities:?} {pressure}: {found}");
        }
    }
}
