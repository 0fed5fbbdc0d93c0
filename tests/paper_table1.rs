//! Table I of the paper by the paper's own method (`src/paper`), on the paper's own meshes.
use std::time::Instant;

use rayon::prelude::*;
use squeezefilm::control::{Cancel, Progress};
use squeezefilm::paper;
use squeezefilm::problem::{Gas, Motor, Numerics, RotorCompliance, Slip};
use squeezefilm::solution::{MotorResult, Outcome, Solution, Status};

fn fundamental() -> Motor {
    Motor {
        contact_radius: 29e-3,
        waves: 7,
        load: 2.45,
        dry_friction: 0.7,
        rotor_speed: 0.0,
        frequency: 30e3,
        normal_amplitude: 1.30e-6,
        tangential_amplitude: 1.0e-6,
        teeth: 9,
        tooth_width: 1.7353e-3,
        tooth_radius: None,
        contact_width: 0.3e-3,
        rotor: RotorCompliance::Beam { decay_length: 4.0e-3, point_compliance: 0.64e-6, local_compliance: 1.05e-10 },
        min_spacing: 200e-9,
        gas: Gas { ambient_pressure: 101_325.0, viscosity: 18.1e-6, mean_free_path: 64e-9, slip: Slip::FirstOrder },
        shear: true,
    }
}

fn solve(motor: &Motor, numerics: &Numerics) -> (Solution, MotorResult) {
    let solution = paper::solve(motor, numerics, &mut (), &Cancel::new());
    match solution.outcome {
        Outcome::Motor(result) => (solution, result),
        Outcome::Plate(_) => panic!("a motor's solution"),
    }
}

/// Row, published α, what changes.
type Row = (&'static str, f64, fn(&mut Motor));

#[allow(clippy::approx_constant, reason = "0.318 is a row of the table, not 1/π")]
const ROWS: [Row; 13] = [
    ("fundamental", 0.238, |_| ()),
    ("min_spacing_100nm", 0.481, |m| m.min_spacing = 100e-9),
    ("rotor_width_0.6mm", 0.466, |m| m.contact_width = 0.6e-3),
    ("tooth_width_1.16mm", 0.157, |m| m.tooth_width = 1.157e-3),
    ("tooth_width_2.31mm", 0.318, |m| m.tooth_width = 2.314e-3),
    ("frequency_3khz", 0.078, |m| m.frequency = 3e3),
    ("frequency_20khz", 0.224, |m| m.frequency = 20e3),
    ("frequency_40khz", 0.245, |m| m.frequency = 40e3),
    ("frequency_60khz", 0.251, |m| m.frequency = 60e3),
    ("frequency_100khz", 0.257, |m| m.frequency = 100e3),
    ("tooth_radius_3m", 0.235, |m| m.tooth_radius = Some(3.0)),
    ("tooth_radius_6.5m", 0.239, |m| m.tooth_radius = Some(6.5)),
    ("tooth_radius_10m", 0.239, |m| m.tooth_radius = Some(10.0)),
];

/// The doubled mesh of Table I.
const DOUBLED: Numerics = Numerics {
    film_nodes_along: Some(101),
    film_nodes_across: Some(21),
    contact_nodes: Some(361),
    steps_per_cycle: None,
};

fn assert_finite(result: &MotorResult) {
    let all = [
        result.alpha,
        result.alpha_error,
        result.film_load,
        result.film_load_min,
        result.film_load_max,
        result.contact_load,
        result.max_torque,
        result.teeth_in_contact,
        result.min_gap,
        result.max_pressure,
    ];
    assert!(all.iter().all(|v| v.is_finite()), "{result:?}");
}

#[test]
fn rows_of_table_1() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let results: Vec<_> = pool.install(|| {
        ROWS.par_iter()
            .map(|(name, published, change)| {
                let mut motor = fundamental();
                change(&mut motor);
                let begun = Instant::now();
                let (solution, result) = solve(&motor, &Numerics::default());
                (*name, *published, solution, result, begun.elapsed())
            })
            .collect()
    });
    for (name, published, solution, result, time) in &results {
        let off = result.alpha / published - 1.0;
        let stats = solution.stats;
        println!(
            "{name:20} {:.4} {published:.3} {:+5.2} %  {:4.2} teeth  {:2} cycles  {:4.1} rounds/step  {:.2} s  {:?}",
            result.alpha,
            100.0 * off,
            result.teeth_in_contact,
            stats.cycles,
            stats.coupling_iterations as f64 / (stats.cycles * 180) as f64,
            time.as_secs_f64(),
            solution.status,
        );
    }
    for (name, published, solution, result, _) in &results {
        let off = (result.alpha / published - 1.0).abs();
        // The rotor of that row was probably stiffer (docs/theory.md); it is not tuned away.
        let allowed = if *name == "rotor_width_0.6mm" { 0.09 } else { 0.02 };
        assert!(off < allowed, "{name}: {} against {published}", result.alpha);
        assert_finite(result);
        if let Status::NotConverged { residual, .. } = solution.status {
            assert!(*name == "min_spacing_100nm" && residual < 2e-3, "{name}: {:?}", solution.warnings);
        }
        assert!(solution.recording.teeth_in_contact.iter().all(|teeth| (2..=4).contains(teeth)), "{name}");
        assert!((result.film_load + result.contact_load - 2.45).abs() < 2e-3 * 2.45, "{name}");
    }
    // A slowdown fails: the fundamental case is marched in 10 cycles, about 4 rounds to a step.
    let (_, _, solution, _, _) = &results[0];
    assert_eq!(solution.stats.cycles, 10);
    assert_eq!(solution.stats.film_steps, 9 * 180 * 10);
    assert!(solution.stats.coupling_iterations < 5 * 180 * 10, "{:?}", solution.stats);
    assert!(solution.recording.teeth_in_contact.iter().all(|teeth| (3..=4).contains(teeth)));
}

/// The paper's own check of its mesh, + 2.1 %. The expanded form, differenced as printed, gives + 3.1 %, of which 2.6 %
/// are from the mesh across the width alone.
#[test]
fn doubling_the_mesh() {
    let (_, once) = solve(&fundamental(), &Numerics::default());
    let (solution, twice) = solve(&fundamental(), &DOUBLED);
    assert_eq!(solution.status, Status::Converged);
    println!("{} {} {:+.2} %", once.alpha, twice.alpha, 100.0 * (twice.alpha / once.alpha - 1.0));
    // Doubled once more α is 0.24492, so about 0.2458 in the limit: both estimates of the error hold.
    assert!((once.alpha - 0.2458).abs() < once.alpha_error && (twice.alpha - 0.2458).abs() < twice.alpha_error);
    assert!((twice.alpha / 0.243 - 1.0).abs() < 0.005, "{}", twice.alpha);
    assert!((0.028..0.034).contains(&(twice.alpha / once.alpha - 1.0)), "{} {}", once.alpha, twice.alpha);
}

#[test]
fn steps_per_cycle_hardly_matter() {
    let alpha = |steps| {
        let numerics = Numerics { steps_per_cycle: Some(steps), ..Numerics::default() };
        solve(&fundamental(), &numerics).1.alpha
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
    assert!((plain.alpha / sheared.alpha - 1.0).abs() < 1e-3, "{} {}", plain.alpha, sheared.alpha);
}

/// Where freezing the pressure is unstable or has no answer, the solve ends, says so, and its numbers are finite.
#[test]
fn stiff_films_and_light_loads_are_reported_not_hidden() {
    let coarse = Numerics { film_nodes_along: Some(21), steps_per_cycle: Some(90), ..Numerics::default() };
    for (min_spacing, load) in [(60e-9, 2.45), (20e-9, 2.45), (1e-9, 2.45), (200e-9, 0.2), (200e-9, 1e-6)] {
        let (solution, result) = solve(&Motor { min_spacing, load, ..fundamental() }, &coarse);
        println!("{min_spacing:e} {load} {:?} {:?} {:?}", solution.status, result, solution.warnings);
        assert!(matches!(solution.status, Status::NotConverged { residual, .. } if residual.is_finite()));
        assert!(!solution.warnings.is_empty());
        assert_finite(&result);
        assert!(solution.recording.pressure.iter().all(|p| p.is_finite()));
        assert!(solution.recording.film_thickness.iter().all(|h| h.is_finite()));
    }
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
    assert!((result.film_load + result.contact_load - 2.45).abs() < 5e-3 * 2.45);
    assert!(solution.model.why.iter().any(|why| why.contains("whole number")));

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
    );
    assert_eq!((solution.status, heard, solution.stats.cycles), (Status::Cancelled, 1, 1));

    let mut motor = fundamental();
    motor.gas.slip = Slip::FukuiKaneko;
    let (solution, _) = solve(&motor, &Numerics { steps_per_cycle: Some(30), ..Numerics::default() });
    assert!(solution.warnings.iter().any(|warning| warning.contains("first-order")));
}
