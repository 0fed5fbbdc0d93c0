//! The contact problem against exact elastic contacts, and its conditions.

// clippy.toml allows this inside #[test] functions; the helpers of this file are tests too.
#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use squeezefilm::contact::{Contact, Instant, Modes, Shape, cutoff};
use squeezefilm::control::Cancel;
use squeezefilm::problem::RotorCompliance;
use squeezefilm::rotor::ring::Band;
use squeezefilm::rotor::{Compliances, Wave};
use std::f64::consts::{PI, TAU};

const WAVE: f64 = 0.026;
const SPACING: f64 = 200e-9;

/// The rotor as contact knows it.
fn resolved(rotor: &RotorCompliance) -> Compliances {
    rotor
        .resolve(&Wave { length: WAVE, waves: 7, band: Band { radius: 0.029, width: 3e-4 } }, 200, &Cancel::new())
        .unwrap()
}

/// Nodes over a whole wavelength, no film (vacuum), `stator` profile.
fn dry(
    rotor: &RotorCompliance,
    harmonics: usize,
    nodes: usize,
    load: f64,
    stator: impl Fn(f64) -> f64,
) -> (Vec<f64>, Instant, f64) {
    let x: Vec<f64> = (0..nodes).map(|i| WAVE * i as f64 / nodes as f64).collect();
    let length = WAVE / nodes as f64;
    let modes = Modes::new(&resolved(rotor), harmonics, 0.0, &x);
    let mut contact = Contact::new(modes, vec![length; nodes], &vec![0.0; nodes], 101_325.0, SPACING, load);
    let stator: Vec<f64> = x.iter().map(|x| stator(*x)).collect();
    let mut out = Instant::default();
    contact.solve(&stator, &vec![0.0; nodes], &mut Shape::default(), &mut out).unwrap();
    (x, out, length)
}

fn check_conditions(out: &Instant, lengths: &[f64], load: f64) {
    let total: f64 = out.contact.iter().zip(lengths).map(|(c, l)| c * l).sum();
    assert!((total / load - 1.0).abs() < 1e-12, "Σf = {total}, L = {load}");
    for (c, h) in out.contact.iter().zip(&out.film_thickness) {
        assert!(*c >= 0.0 && *h >= SPACING && *c * (*h - SPACING) == 0.0, "c = {c}, h = {h}");
    }
}

#[test]
fn a_sinusoidal_wave_on_an_elastic_half_plane_is_westergaards() {
    // Compliance inversely proportional to the wavenumber is an elastic half-plane. Westergaard (1939): contact over
    // |x| < a with sin²(πa/λ) = L/L*, L* = λ A/C(k₁), and line load
    // q = 2 (L/λ) cos(πx/λ)/sin²(πa/λ) √(sin²(πa/λ) − sin²(πx/λ)).
    let rotor = RotorCompliance::Table(vec![(1.0, 1e-6), (1e9, 1e-15)]);
    let amplitude = 1.3e-6;
    let closing = WAVE * amplitude / resolved(&rotor).harmonic(1);
    let mut errors = Vec::new();
    for (harmonics, nodes) in [(32, 256), (64, 512), (128, 1024)] {
        let mut error = 0.0_f64;
        for fraction in [0.1, 0.4, 0.8] {
            let load = fraction * closing;
            let (x, out, length) = dry(&rotor, harmonics, nodes, load, |x| amplitude * (TAU * x / WAVE).cos());
            check_conditions(&out, &vec![length; nodes], load);
            let mean = load / WAVE;
            for (x, c) in x.iter().zip(&out.contact) {
                let sine = (PI * x / WAVE).sin().powi(2);
                let exact = 2.0 * mean * (PI * x / WAVE).cos().abs() / fraction * (fraction - sine).max(0.0).sqrt();
                error += (c - exact).abs() * length / load;
            }
            let touching = out.contact.iter().filter(|c| **c > 0.0).count() as f64 / nodes as f64;
            let exact = 2.0 / PI * fraction.sqrt().asin();
            assert!(
                (touching - exact).abs() < 4.0 / nodes as f64 + 0.3 / harmonics as f64,
                "{fraction}: {touching} {exact}"
            );
        }
        errors.push(error / 3.0);
    }
    println!("Westergaard, area between the curves: {errors:.6?}");
    // Area between the curves over the load; how the contact's edge falls between nodes makes it irregular.
    assert!(errors[0] < 2e-3 && errors[1] < 0.5 * errors[0] && errors[2] < 0.8 * errors[1], "{errors:?}");
}

#[test]
fn full_contact_follows_the_wave_exactly() {
    // Pressed flat everywhere, the rotor takes the stator's shape: q = L/λ + A/C(k₁) cos kx, whatever the compliance.
    let rotor = RotorCompliance::Beam { decay_length: 4e-3, point_compliance: 0.64e-6, local_compliance: 1.05e-10 };
    let (amplitude, load) = (1.3e-6, 60.0);
    let (x, out, length) = dry(&rotor, 24, 240, load, |x| amplitude * (TAU * x / WAVE).cos());
    check_conditions(&out, &vec![length; 240], load);
    let mut worst = 0.0_f64;
    for (x, c) in x.iter().zip(&out.contact) {
        let exact = load / WAVE + amplitude / resolved(&rotor).harmonic(1) * (TAU * x / WAVE).cos();
        worst = worst.max((c / exact - 1.0).abs());
        assert!((c / exact - 1.0).abs() < 1e-9, "{x}: {c} {exact}");
    }
    println!("full contact: {worst:.1e}");
}

#[test]
fn a_crowned_tooth_on_springs_is_the_parabola_of_winkler() {
    // Constant compliance C: q = (δ − ξ²/2R)/C within |ξ| < a, L = 2a³/(3RC).
    let compliance = 1e-10;
    let rotor = RotorCompliance::Table(vec![(1.0, compliance)]);
    let (radius, half_width): (f64, f64) = (2.0, 1.2e-3);
    let load = 2.0 * half_width.powi(3) / (3.0 * radius * compliance);
    let nodes = 2001;
    let (x, out, length) = dry(&rotor, 8, nodes, load, |x| -(x - 0.5 * WAVE).powi(2) / (2.0 * radius));
    check_conditions(&out, &vec![length; nodes], load);
    let top = half_width * half_width / (2.0 * radius * compliance);
    let mut worst = 0.0_f64;
    for (x, c) in x.iter().zip(&out.contact) {
        let exact = (top - (x - 0.5 * WAVE).powi(2) / (2.0 * radius * compliance)).max(0.0);
        worst = worst.max((c - exact).abs() / top);
        assert!((c - exact).abs() < 2e-3 * top, "{x}: {c} {exact}");
    }
    println!("Winkler parabola: {worst:.1e}");
}

#[test]
fn a_point_load_deflects_the_rotor_by_its_greens_function() {
    // Deflection under a single loaded node far from its periodic images: C_p e^{−|x|/ℓ}(cos x/ℓ + sin|x|/ℓ).
    let (decay_length, point_compliance) = (1e-3, 0.64e-6);
    let rotor = RotorCompliance::Beam { decay_length, point_compliance, local_compliance: 0.0 };
    let nodes = 401;
    let x: Vec<f64> = (0..nodes).map(|i| WAVE * i as f64 / nodes as f64).collect();
    let modes = Modes::new(&resolved(&rotor), 120, 0.0, &x);
    let mut force = vec![0.0; nodes];
    force[200] = 1.0;
    let (mut projected, mut deflection) = (vec![0.0; modes.unknowns()], vec![0.0; nodes]);
    modes.project(&force, &mut projected);
    projected[0] = 0.0;
    modes.deflection(&projected, &mut deflection);
    let green =
        |d: f64| point_compliance * (-d / decay_length).exp() * ((d / decay_length).cos() + (d / decay_length).sin());
    // The mean (harmonic 0) is not part of the compliance. Harmonics from 120 on, and the compliance of harmonic 120 that
    // is counted as local, make 1.4e-4 at the loaded node.
    let mean: f64 = 2.0 * decay_length * point_compliance / WAVE;
    let mut worst = 0.0_f64;
    for i in 0..nodes {
        let exact = green((x[i] - x[200]).abs()) - mean;
        worst = worst.max((deflection[i] - exact).abs() / point_compliance);
        assert!((deflection[i] - exact).abs() < 2e-4 * point_compliance, "{i}: {} {exact}", deflection[i]);
    }
    println!("Green's function: {worst:.1e}");
}

/// Deflection of every node of a uniform mesh under a unit force on each \[m/N\], harmonic by harmonic, with nothing split off.
fn flexibility(rotor: &RotorCompliance, nodes: usize) -> Vec<Vec<f64>> {
    let rotor = resolved(rotor);
    let by_distance: Vec<f64> = (0..nodes)
        .map(|d| {
            let term = |n: usize| {
                // The highest harmonic of the mesh has no sine.
                let parts = if 2 * n == nodes { 1.0 } else { 2.0 };
                parts / WAVE * rotor.harmonic(n) * (TAU * (n * d) as f64 / nodes as f64).cos()
            };
            (1..=nodes / 2).map(term).sum()
        })
        .collect();
    (0..nodes).map(|i| (0..nodes).map(|j| by_distance[(i + nodes - j) % nodes]).collect()).collect()
}

/// Nodal contact forces \[N\] by projected Gauss–Seidel: raise or lower one force at a time until its gap or itself is zero, and the
/// rigid offset by bisection.
fn by_brute_force(flexibility: &[Vec<f64>], stator: &[f64], load: f64) -> Vec<f64> {
    let nodes = stator.len();
    let mut force = vec![load / nodes as f64; nodes];
    let mut relax = |z0: f64| -> (f64, Vec<f64>) {
        for _ in 0..4000 {
            let mut moved = 0.0_f64;
            for i in 0..nodes {
                let gap = z0 - stator[i] + flexibility[i].iter().zip(&force).map(|(g, f)| g * f).sum::<f64>();
                let next = (force[i] - gap / flexibility[i][i]).max(0.0);
                moved = moved.max((next - force[i]).abs());
                force[i] = next;
            }
            if moved < 1e-13 * load {
                break;
            }
        }
        (force.iter().sum(), force.clone())
    };
    let (mut low, mut high) = (-1e-4, 1e-4);
    let mut found = Vec::new();
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let (total, forces) = relax(middle);
        found = forces;
        if total > load { low = middle } else { high = middle }
    }
    found
}

#[test]
fn a_table_with_a_dip_is_solved_as_it_stands() {
    let beam = RotorCompliance::Beam { decay_length: 4e-3, point_compliance: 0.64e-6, local_compliance: 1.05e-10 };
    let nodes = 64;
    // Harmonics that are stiffer than the last: one at the fourth, a deep one at the first, several.
    for dips in [&[(4, 0.2)][..], &[(1, 0.02)], &[(2, 0.5), (3, 0.1), (7, 0.3), (12, 0.05)]] {
        let beam = resolved(&beam);
        let last = beam.harmonic(32);
        let row = |n: usize| {
            let k = TAU * n as f64 / WAVE;
            let dip = dips.iter().find(|(at, _)| *at == n);
            (k, dip.map_or(beam.harmonic(n), |(_, share)| share * last))
        };
        let rotor = RotorCompliance::Table((1..=nodes / 2).map(row).collect());
        let stator = |x: f64| 1.3e-6 * (TAU * x / WAVE).cos() + 2e-7 * (4.0 * TAU * x / WAVE).sin();
        for load in [0.3, 2.45, 30.0] {
            let (x, out, length) = dry(&rotor, nodes / 2, nodes, load, stator);
            check_conditions(&out, &vec![length; nodes], load);
            let stator: Vec<f64> = x.iter().map(|x| stator(*x)).collect();
            let exact = by_brute_force(&flexibility(&rotor, nodes), &stator, load);
            for (c, f) in out.contact.iter().zip(&exact) {
                assert!((c * length - f).abs() < 1e-6 * load, "{dips:?}, {load} N: {} {f}", c * length);
            }
        }
    }
}

#[test]
fn a_dip_is_kept_whatever_comes_after_it() {
    let wave = |n: usize| TAU * n as f64 / WAVE;
    let flat = |dip: usize| {
        RotorCompliance::Table((1..=40).map(|n| (wave(n), if n == dip { 2e-11 } else { 1e-10 })).collect())
    };
    for (dip, harmonics) in [(1, 4), (3, 4), (4, 5), (17, 18)] {
        assert_eq!(cutoff(&resolved(&flat(dip)), 0.03, 32), harmonics, "dip at {dip}");
    }
}

/// Gas that differs from node to node, under a wave: the problem is solved, the conditions hold and the load is balanced.
fn balances(
    modes: Modes,
    x: &[f64],
    lengths: Vec<f64>,
    [pressure, spacing, load, amplitude, trapped]: [f64; 5],
    seed: u32,
) -> Result<(), TestCaseError> {
    let (nodes, width, seed) = (x.len(), 3e-4, f64::from(seed));
    let mut contact = Contact::new(modes, lengths.clone(), &vec![width; nodes], pressure, spacing, load);
    let stator: Vec<f64> = x.iter().map(|x| amplitude * (TAU * x / WAVE + seed).cos()).collect();
    let gas: Vec<f64> = (0..nodes).map(|i| width * trapped * (1.0 + 0.9 * (i as f64 * seed).sin())).collect();
    let mut out = Instant::default();
    let solved = contact.solve(&stator, &gas, &mut Shape::default(), &mut out);
    prop_assert!(solved.is_ok(), "{solved:?}");
    let (mut total, mut scale) = (0.0, load);
    for i in 0..nodes {
        let (c, h) = (out.contact[i], out.film_thickness[i]);
        prop_assert!(c >= 0.0 && h >= spacing && c * (h - spacing) == 0.0, "{} {}", c, h);
        let force = (c + pressure * (gas[i] / h - width)) * lengths[i];
        total += force;
        scale += force.abs();
    }
    prop_assert!((total - load).abs() < 1e-10 * scale, "Σf = {}, L = {}, scale {}", total, load, scale);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Contact with trapped gas, over the documented ranges.
    #[test]
    fn conditions_hold_for_any_gas_and_load(
        load in -2.0f64..2.0, spacing in -8.3f64..-5.0, amplitude in -9.0f64..-4.7, pressure in 1.0f64..7.0,
        decay in -4.0f64..-1.0, point in -9.0f64..-3.0, local in -12.0f64..-6.0, trapped in -9.0f64..-5.0, seed in 0u32..1000,
    ) {
        let ten = |e: f64| 10f64.powf(e);
        let rotor = RotorCompliance::Beam { decay_length: ten(decay), point_compliance: ten(point), local_compliance: ten(local) };
        let nodes = 120;
        let x: Vec<f64> = (0..nodes).map(|i| WAVE * (i as f64 + 0.3) / nodes as f64).collect();
        let lengths: Vec<f64> = (0..nodes).map(|i| WAVE / nodes as f64 * if i % 10 < 7 { 1.0 } else { 0.3 }).collect();
        let modes = Modes::new(&resolved(&rotor), 24, 0.0, &x);
        balances(modes, &x, lengths, [pressure, spacing, load, amplitude, trapped].map(ten), seed)?;
    }

    /// Any positive table, rough as it may be, also on nodes too few for its harmonics.
    #[test]
    fn any_positive_table_is_solved(
        compliances in proptest::collection::vec(-12.0f64..-7.0, 60), along in 3usize..17, most in 8usize..64,
        load in -2.0f64..2.0, spacing in -8.3f64..-6.0, amplitude in -8.0f64..-5.0, trapped in -9.0f64..-6.0, seed in 0u32..1000,
    ) {
        let ten = |e: f64| 10f64.powf(e);
        let row = |(n, c): (usize, &f64)| (TAU * (n + 1) as f64 / WAVE, ten(*c));
        let rotor = RotorCompliance::Table(compliances.iter().enumerate().map(row).collect());
        // Nine teeth on two thirds of the wavelength.
        let node = |i: usize| WAVE / 9.0 * ((i / along) as f64 + 0.667 * ((i % along) as f64 + 0.5) / along as f64);
        let x: Vec<f64> = (0..9 * along).map(node).collect();
        let lengths = vec![0.667 * WAVE / x.len() as f64; x.len()];
        let modes = Modes::new(&resolved(&rotor), cutoff(&resolved(&rotor), 1e-2, most), 0.0, &x);
        balances(modes, &x, lengths, [101_325.0, ten(spacing), ten(load), ten(amplitude), ten(trapped)], seed)?;
    }
}
