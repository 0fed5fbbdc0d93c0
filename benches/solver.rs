//! What the solver's parts cost on this machine. `cargo bench` runs all; `cargo bench -- fundamental` runs some.
//!
//! Times differ between machines and with what else runs; what may not grow unnoticed (rounds, steps, allocations) is
//! counted and asserted by the tests instead.

use divan::{Bencher, black_box};
use squeezefilm::contact::{Contact, Instant, Modes, Shape};
use squeezefilm::control::Cancel;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::film::grid::{Axis, FilmGrid, Start};
use squeezefilm::film::stepper::{Film, FilmState};
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Motor, Problem, Scenario};
use squeezefilm::rotor::ring::{Band, MATERIALS, Part, Section};
use squeezefilm::scene::presets;
use squeezefilm::solve::{Method, Settings, solve};

fn main() {
    divan::main();
}

fn problem(preset: &str) -> Problem {
    presets::find(preset)
        .and_then(|scene| Problem::try_from(&scene))
        .unwrap_or_else(|fault| panic!("{preset}: {fault}"))
}

fn fundamental() -> (Motor, Plan) {
    match problem("fundamental") {
        Problem { scenario: Scenario::Motor(motor), numerics, .. } => {
            let plan = Plan::motor(&motor, Fidelity::Standard, &numerics).unwrap_or_else(|fault| panic!("{fault}"));
            (motor, plan)
        }
        Problem { scenario: Scenario::Plate(_), .. } => panic!("the fundamental case is a motor"),
    }
}

/// One implicit time step of one tooth's film on the standard grid, the gap opening and closing.
#[divan::bench]
fn film_step(bencher: Bencher<'_, '_>) {
    let (motor, plan) = fundamental();
    let grid = plan.grids[plan.grids.len() - 1];
    let nodes = FilmGrid {
        x: Axis::clustered(0.5 * motor.tooth_width, Start::Ambient, grid.along, plan.clustering_along),
        y: Axis::spectral(0.5 * motor.contact_width, Start::Mirror, grid.across, plan.clustering_across),
    };
    let (nx, unknowns) = (nodes.x.len(), nodes.unknowns());
    let mut film = Film::new(nodes, &motor.gas);
    let mut state = FilmState::at_rest(vec![motor.min_spacing; unknowns]);
    let mut h = vec![motor.min_spacing; nx];
    let (dt, mut step) = (motor.period() / grid.steps as f64, 0_u32);
    bencher.bench_local(|| {
        step += 1;
        let phase = std::f64::consts::TAU * f64::from(step) / grid.steps as f64;
        h.fill(motor.min_spacing + 0.5 * motor.normal_amplitude * (1.0 - phase.cos()));
        film.step(black_box(&h), None, dt, &mut state, None)
    });
}

/// One contact problem of a wavelength, from nothing: nine teeth, gas of ambient pressure at the minimum spacing.
#[divan::bench]
fn contact_solve(bencher: Bencher<'_, '_>) {
    let (motor, plan) = fundamental();
    let grid = plan.grids[plan.grids.len() - 1];
    let x = Axis::clustered(0.5 * motor.tooth_width, Start::Ambient, grid.along, plan.clustering_along);
    let nodes = || (0..motor.teeth).flat_map(|tooth| x.nodes.iter().map(move |xi| (tooth, *xi)));
    let positions: Vec<f64> = nodes().map(|(tooth, xi)| tooth as f64 * motor.pitch() + xi).collect();
    let stator: Vec<f64> = nodes().zip(&positions).map(|((_, xi), x)| motor.stator_displacement(*x, xi, 0.0)).collect();
    let lengths: Vec<f64> = (0..motor.teeth).flat_map(|_| x.lengths.iter().copied()).collect();
    let harmonics = plan.harmonics(&grid);
    let modes = Modes::new(&plan.rotor, harmonics, 0.0, &positions);
    let widths = vec![motor.contact_width; positions.len()];
    let trapped = vec![motor.contact_width * motor.min_spacing; positions.len()];
    let mut contact = Contact::new(modes, lengths, &widths, motor.gas.ambient_pressure, motor.min_spacing, motor.load);
    let mut out = Instant::default();
    bencher.bench_local(|| contact.solve(black_box(&stator), &trapped, &mut Shape::default(), &mut out));
}

/// Compliances of 96 harmonics of a ring with a flange, a rim and a lining, on two meshes, the finer of up to 2000 elements.
#[divan::bench(sample_count = 20, sample_size = 1)]
fn ring_compliances(bencher: Bencher<'_, '_>) {
    let part = |name: &str, [inner_radius, outer_radius, bottom, top]: [f64; 4], material: usize| Part {
        name: name.to_owned(),
        inner_radius,
        outer_radius,
        bottom,
        top,
        material: MATERIALS[material],
    };
    let parts = vec![
        part("lining", [28.85e-3, 29.15e-3, 0.0, 0.145e-3], 3),
        part("rim", [28.3e-3, 29.7e-3, 0.145e-3, 1.2e-3], 0),
        part("flange", [26.9e-3, 28.3e-3, 0.75e-3, 1.2e-3], 0),
        part("body", [24.9e-3, 26.9e-3, 0.75e-3, 5.75e-3], 0),
    ];
    let section = Section::new(parts, Vec::new()).unwrap_or_else(|fault| panic!("{fault}"));
    let band = Band { radius: 29e-3, width: 0.3e-3 };
    bencher.bench_local(|| black_box(&section).compliances(band, 7, 96, 1, &Cancel::new()));
}

/// The fundamental case, all three grids and the error estimate.
#[divan::bench(args = [Fidelity::Draft, Fidelity::Standard, Fidelity::Fine], sample_count = 10)]
fn fundamental_case(bencher: Bencher<'_, '_>, fidelity: Fidelity) {
    let problem = problem("fundamental");
    let settings = Settings { fidelity, ..Settings::default() };
    bencher.bench_local(|| solve(black_box(&problem), &settings, &mut (), &Cancel::new()));
}

/// The paper's algorithm on the paper's meshes.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn fundamental_case_by_the_papers_method(bencher: Bencher<'_, '_>) {
    let problem = problem("fundamental");
    let settings = Settings { fidelity: Fidelity::Standard, method: Method::Paper, ..Settings::default() };
    bencher.bench_local(|| solve(black_box(&problem), &settings, &mut (), &Cancel::new()));
}
