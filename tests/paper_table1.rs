//! Table I of the paper by the paper's own method (`solver/src/paper`), on the paper's own meshes.
#![allow(clippy::unwrap_used)] // helpers of tests are not tests to clippy

mod scenes;

use rayon::prelude::*;
use squeezefilm::control::{Cancel, Progress};
use squeezefilm::drive::Scaled;
use squeezefilm::paper;
use squeezefilm::problem::{Motor, Numerics, Slip};
use squeezefilm::scene::table1;
use squeezefilm::solution::{MotorResult, Solution, Status};

fn fundamental() -> Motor {
    scenes::motor("fundamental", &[])
}

fn solve(motor: &Motor, numerics: &Numerics) -> (Solution, MotorResult) {
    let solution = paper::solve(motor, numerics, &mut (), &Cancel::new()).unwrap_or_else(|error| panic!("{error}"));
    let Some(&result) = solution.outcome.motor() else { panic!("a motor's solution") };
    (solution, result)
}

fn assert_finite(result: &MotorResult) {
    let all = [
        result.alpha.value,
        result.alpha.error,
        result.film_load.value,
        result.film_load_min.value,
        result.film_load_max.value,
        result.contact_load.value,
        result.max_torque.value,
        result.teeth_in_contact.value,
        result.min_film_thickness.value,
        result.max_pressure.value,
    ];
    assert!(all.iter().all(|v| v.is_finite()), "{result:?}");
}

/// Every row, compared by its load, which the paper gives to three digits.
#[test]
fn rows_of_table_1() {
    let results: Vec<_> = table1::published()
        .into_par_iter()
        .map(|row| {
            let problem = scenes::problem(&row.preset, &[]);
            let (solution, result) = solve(problem.scenario.motor().unwrap(), &problem.numerics);
            (row, solution, result)
        })
        .collect();
    assert_eq!(results.len(), 14);
    for (row, solution, result) in &results {
        println!(
            "{:20} {:.4} N {:.3} N {:+5.2} %  α {:.4} {:.3}  {:4.2} teeth  {:2} cycles  {:4.1} rounds/step  {:?}",
            row.row,
            result.film_load.value,
            row.published_load_n,
            100.0 * (result.film_load.value / row.published_load_n - 1.0),
            result.alpha.value,
            row.published_alpha,
            result.teeth_in_contact.value,
            solution.stats.cycles,
            solution.stats.coupling_iterations as f64 / (solution.stats.cycles * 180) as f64,
            solution.status,
        );
    }
    // The torque's curves have the bound that the result states.
    let (row, solution, result) = &results[0];
    let motor = scenes::motor(&row.preset, &[]);
    let bound = Scaled::with_film(&motor, result, &solution.recording).performance(&[]).max_torque.value;
    assert!((bound / result.max_torque.value - 1.0).abs() < 1e-14, "{bound}: {result:?}");
    for (row, solution, result) in &results {
        let off = (result.film_load.value / row.published_load_n - 1.0).abs();
        // The rotor of that row was probably stiffer (docs/theory.md); it is not tuned away.
        let allowed = if row.row == "rotor_width_0.6mm" { 0.09 } else { 0.02 };
        assert!(off < allowed, "{}: {} against {}", row.row, result.film_load, row.published_load_n);
        assert_finite(result);
        assert_eq!(solution.status, Status::Converged, "{}: {:?}", row.row, solution.warnings);
        assert_eq!(solution.warnings.is_empty(), row.row != "min_spacing_100nm", "{:?}", solution.warnings);
        assert!(solution.recording.teeth_in_contact.iter().all(|teeth| (2..=4).contains(teeth)), "{}", row.row);
        assert!((result.film_load.value + result.contact_load.value - 2.45).abs() < 2e-3 * 2.45, "{}", row.row);
    }
    // A slowdown fails: the fundamental case is marched in 10 cycles, about 4 rounds to a step.
    let (_, solution, _) = &results[0];
    assert_eq!(solution.stats.cycles, 10);
    assert_eq!(solution.stats.film_steps, 9 * 180 * 10);
    assert!(solution.stats.coupling_iterations < 5 * 180 * 10, "{:?}", solution.stats);
    assert!(solution.recording.teeth_in_contact.iter().all(|teeth| (3..=4).contains(teeth)));
    // The paper's own check of its mesh, +2.1 %.
    let increment = results[1].2.film_load.value / results[0].2.film_load.value - 1.0;
    assert_eq!(results[1].0.row, "doubled_mesh");
    assert!((0.015..0.026).contains(&increment), "{increment}");
    // Both error estimates hold against the converged value.
    for (_, _, result) in &results[..2] {
        assert!((result.alpha.value - 0.24586).abs() < result.alpha.error, "{result:?}");
    }
}

#[test]
fn steps_per_cycle_hardly_matter() {
    let alpha = |steps| {
        let numerics = Numerics { steps_per_cycle: Some(steps), ..Numerics::default() };
        solve(&fundamental(), &numerics).1.alpha.value
    };
    let (coarse, middle, fine) = (alpha(90), alpha(180), alpha(360));
    println!("{coarse} {middle} {fine}");
    assert!((coarse / fine - 1.0).abs() < 2e-3);
    assert!((middle / fine - 1.0).abs() < 5e-4);
}

#[test]
fn the_wedge_hardly_matters() {
    let (with, sheared) = solve(&fundamental(), &Numerics::default());
    let (without, plain) = solve(&Motor { shear: false, ..fundamental() }, &Numerics::default());
    assert!(with.model.shear && !without.model.shear);
    assert!((plain.alpha.value / sheared.alpha.value - 1.0).abs() < 1e-3, "{} {}", plain.alpha, sheared.alpha);
}

/// Where freezing the pressure is unstable or has no answer, the solve ends, says so, and its numbers are finite.
#[test]
fn stiff_films_and_light_loads_are_reported_not_hidden() {
    let coarse = Numerics { film_nodes_along: Some(21), steps_per_cycle: Some(90), ..Numerics::default() };
    let mut overloaded = false;
    for (min_spacing, load) in [(60e-9, 2.45), (20e-9, 2.45), (1e-9, 2.45), (200e-9, 0.2), (200e-9, 1e-6)] {
        let (solution, result) = solve(&Motor { min_spacing, load, ..fundamental() }, &coarse);
        println!("{min_spacing:e} {load} {:?} {:?} {:?}", solution.status, result, solution.warnings);
        assert!(matches!(solution.status, Status::NotConverged { residual, .. } if residual.is_finite()));
        assert!(!solution.warnings.is_empty());
        assert_finite(&result);
        // A film that carries more than the load leaves no torque, and no negative one.
        assert!(
            result.max_torque.value >= 0.0 && (result.alpha.value < 1.0 || result.max_torque.value == 0.0),
            "{result:?}"
        );
        overloaded |= result.alpha.value > 1.0;
        assert!(solution.recording.pressure.iter().all(|p| p.is_finite()));
        assert!(solution.recording.film_thickness.iter().all(|h| h.is_finite()));
    }
    assert!(overloaded);
}

/// Lag symmetry is not used, so it is a check: tooth k at frame m is tooth 0 at frame m + k frames/teeth.
#[test]
fn every_tooth_does_the_same_in_turn() {
    let (solution, _) = solve(&fundamental(), &Numerics::default());
    let recording = &solution.recording;
    let nodes = recording.x.len();
    assert_eq!((recording.stored_teeth, nodes, recording.frames), (9, 13, 180));
    let greatest = recording.film.iter().copied().fold(0.0, f64::max);
    for tooth in 0..9 {
        for frame in 0..180 {
            let here = recording.line_offset(tooth, frame);
            let there = recording.line_offset(0, (frame + 20 * tooth) % 180);
            for node in 0..nodes {
                let apart = recording.film[here + node] - recording.film[there + node];
                assert!(apart.abs() < 5e-3 * greatest, "tooth {tooth} frame {frame} node {node}");
            }
        }
    }
    // Lines add up to loads.
    for frame in 0..180 {
        let (mut film, mut contact) = (0.0, 0.0);
        for tooth in 0..9 {
            let at = recording.line_offset(tooth, frame);
            for node in 0..nodes {
                film += recording.film[at + node] * recording.node_length[node];
                contact += recording.contact[at + node] * recording.node_length[node];
            }
        }
        assert!((film - recording.film_load[frame]).abs() < 1e-9);
        assert!((contact - recording.contact_load[frame]).abs() < 1e-9);
    }
}

#[test]
fn teeth_off_the_contact_nodes_and_extreme_meshes() {
    let short = Numerics { steps_per_cycle: Some(60), ..Numerics::default() };
    let eight = Motor { teeth: 8, ..fundamental() };
    let (solution, result) = solve(&eight, &short);
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.warnings);
    assert!((result.film_load.value + result.contact_load.value - 2.45).abs() < 5e-3 * 2.45);
    assert!(solution.model.remarks.iter().any(|remark| remark.contains("whole number")));

    let touching = Motor { tooth_width: fundamental().pitch(), ..fundamental() };
    let ring = Motor { teeth: 1, tooth_width: fundamental().wavelength(), ..fundamental() };
    let sliver = Motor { tooth_width: 1e-5, ..fundamental() };
    let coarse = Numerics { contact_nodes: Some(5), film_nodes_along: Some(1), film_nodes_across: Some(0), ..short };
    let odd = Numerics { contact_nodes: Some(100), ..short };
    for motor in [eight, touching, ring, sliver, fundamental()] {
        for numerics in [short, odd, coarse] {
            let (solution, result) = solve(&motor, &numerics);
            assert_finite(&result);
            assert!(solution.stats.cycles <= 200);
        }
    }
}

#[test]
fn cancelling_and_other_slip_laws() {
    let cancel = Cancel::new();
    let flag = cancel.clone();
    let mut heard = 0;
    let solution = paper::solve(
        &fundamental(),
        &Numerics::default(),
        &mut |progress: &Progress| {
            heard = progress.iteration;
            flag.cancel();
        },
        &cancel,
    )
    .unwrap();
    assert_eq!((solution.status, heard, solution.stats.cycles), (Status::Cancelled, 1, 1));

    let mut motor = fundamental();
    motor.gas.slip = Slip::FukuiKaneko;
    let (solution, _) = solve(&motor, &Numerics { steps_per_cycle: Some(30), ..Numerics::default() });
    assert!(solution.warnings.iter().any(|warning| warning.contains("first-order")));
}
