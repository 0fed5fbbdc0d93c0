//! The film against exact results (docs/theory.md, section 12): nothing in here is compared with ourselves.

// clippy.toml allows this inside #[test] functions; the helpers of this file are tests too.
#![allow(clippy::unwrap_used)]

mod scenes;

use squeezefilm::analysis::exact::ExactComparison;
use squeezefilm::control::Cancel;
use squeezefilm::estimate::Estimate;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::film::cycle::FilmCycle;
use squeezefilm::film::exact;
use squeezefilm::film::grid::{Axis, FilmGrid, Start};
use squeezefilm::film::stepper::{Film, FilmState};
use squeezefilm::plan::Plan;
use squeezefilm::plate::{self, Periodic};
use squeezefilm::problem::{Gas, Numerics, Plate, Slip};
use squeezefilm::solution::Status;

const GAP: f64 = 1e-6;
const LENGTH: f64 = 1e-3;

fn air(mean_free_path: f64) -> Gas {
    Gas { ambient_pressure: 101_325.0, viscosity: 18.1e-6, mean_free_path, ..Gas::default() }
}

/// A plate with squeeze number `sigma`, relative excursion `epsilon`, Knudsen number `m`, and width/length `aspect`.
fn plate(sigma: f64, epsilon: f64, m: f64, aspect: Option<f64>) -> Plate {
    let gas = air(m * GAP);
    let omega = sigma * gas.ambient_pressure * GAP * GAP / (12.0 * gas.viscosity * LENGTH * LENGTH);
    Plate {
        length: LENGTH,
        width: aspect.map(|a| a * LENGTH),
        hole: None,
        load: None,
        min_spacing: 0.0,
        mean_gap: GAP,
        amplitude: epsilon * GAP,
        frequency: omega / std::f64::consts::TAU,
        gas,
    }
}

fn solve_with(plate: &Plate, fidelity: Fidelity, numerics: &Numerics) -> Periodic {
    let plan = Plan::plate(plate, fidelity, numerics);
    let found = plate::periodic(plate, &plan, &mut (), &Cancel::new()).unwrap();
    assert_eq!(found.status, Status::Converged, "{plate:?}");
    found
}

fn solve(plate: &Plate, fidelity: Fidelity) -> Periodic {
    solve_with(plate, fidelity, &Numerics::default())
}

/// On one grid, as it is solved, the cycle repeating to 1e-7: what the scheme does, and no extrapolation.
fn solve_on_one_grid(plate: &Plate, intervals: usize) -> Periodic {
    let numerics = Numerics {
        film_nodes_along: Some(2 * intervals + 1),
        steps_per_cycle: Some(4 * intervals),
        tolerance: Some(1e-7),
        ..Numerics::default()
    };
    let plan = Plan::plate(plate, Fidelity::Standard, &numerics).on_one_grid();
    plate::periodic(plate, &plan, &mut (), &Cancel::new()).unwrap()
}

/// ⟨h (Z²/2 + 6λZ)⟩ at every node against ⟨h³/2 + 6λh²⟩ of the same time steps: the discrete film keeps the invariant
/// exactly, so that only the tolerance of the periodic state is left.
fn largest_invariant_error(plate: &Plate, found: &Periodic) -> f64 {
    let recording = &found.recording;
    let (nodes, slip) = (recording.map_x.len() * recording.map_y.len(), 6.0 * plate.gas.mean_free_path);
    let gaps: Vec<f64> = (0..recording.frames).map(|m| recording.film_thickness[m * recording.x.len()]).collect();
    let expected: f64 = gaps.iter().map(|h| h * h * (0.5 * h + slip)).sum();
    (0..nodes)
        .map(|node| {
            let sum: f64 = (0..recording.frames)
                .map(|m| {
                    let z = gaps[m] * recording.pressure[m * nodes + node] / plate.gas.ambient_pressure;
                    gaps[m] * z * (0.5 * z + slip)
                })
                .sum();
            (sum / expected - 1.0).abs()
        })
        .fold(0.0, f64::max)
}

#[test]
fn invariant_holds_at_every_node_for_all_squeeze_numbers() {
    for m in [0.0, 0.32] {
        for sigma in [0.1, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5] {
            let strip = plate(sigma, 0.5, m, None);
            let error = largest_invariant_error(&strip, &solve_on_one_grid(&strip, 24));
            println!("invariant, strip, σ = {sigma}, m = {m}: {error:.1e}");
            assert!(error < 3e-6, "strip, σ = {sigma}, m = {m}: {error:.1e}");
        }
        for sigma in [0.1, 30.0, 1e5] {
            let rectangle = plate(sigma, 0.5, m, Some(0.6));
            let error = largest_invariant_error(&rectangle, &solve_on_one_grid(&rectangle, 12));
            println!("invariant, rectangle, σ = {sigma}, m = {m}: {error:.1e}");
            assert!(error < 3e-5, "rectangle, σ = {sigma}, m = {m}: {error:.1e}");
        }
    }
}

#[test]
fn trapped_limit_is_langlois_and_is_approached_as_the_edge_layer_thins() {
    for (epsilon, m) in [(0.5, 0.0), (0.2, 0.1), (0.8, 0.3)] {
        // ψ⟨1/H⟩, with ψ from ⟨H³/2 + 6mH²⟩ (Langlois 1962, Salbu 1964; with first-order slip).
        let (square, slip) = (epsilon * epsilon, 6.0 * m);
        let height = exact::trapped_height(0.5 + 0.75 * square + slip * (1.0 + 0.5 * square), 1.0, slip);
        let limit = height / (1.0_f64 - square).sqrt() - 1.0;
        let deficit = |sigma: f64| {
            let strip = plate(sigma, epsilon, m, None);
            let found = solve(&strip, Fidelity::Fine);
            1.0 - found.result.film_load.value / (strip.gas.ambient_pressure * LENGTH) / limit
        };
        // The layer is O(σ^-1/2) thick: a hundred times σ makes a tenth of the deficit.
        let (near, far) = (deficit(1e4), deficit(1e6));
        println!("trapped limit, ε = {epsilon}, m = {m}: deficit {near:.4} at σ = 1e4, {far:.4} at 1e6");
        assert!(far.abs() < 0.02, "ε = {epsilon}, m = {m}: {far}");
        assert!((near / far - 10.0).abs() < 1.0, "ε = {epsilon}, m = {m}: {near} {far}");
    }
}

#[test]
fn gas_trapped_under_a_crowned_tooth_that_rocks_is_in_proportion_to_the_mean_gap() {
    // No time to move, and ends that stand still: Z = ⟨h⟩ everywhere (`film::trapped`), on any grid, however steep the
    // crown is from node to node.
    let steps = 72;
    for (intervals, law) in [
        (6, Slip::FirstOrder),
        (12, Slip::None),
        (12, Slip::FirstOrder),
        (12, Slip::SecondOrder),
        (12, Slip::FukuiKaneko),
    ] {
        let gas = Gas { slip: law, ..air(64e-9) };
        let x = Axis::clustered(0.5 * LENGTH, Start::Ambient, intervals, 1.0);
        let share: Vec<f64> = x.nodes.iter().map(|x| 2.0 * x / LENGTH).collect();
        let gap = |step: usize, s: f64| {
            let phase = std::f64::consts::TAU * step as f64 / steps as f64;
            100e-9 + 2e-6 * s * s + 200e-9 * (1.0 - s * s).powi(2) * (1.0 + (phase + 2.0 * s).cos())
        };
        let h: Vec<f64> = (0..steps).flat_map(|step| share.iter().map(move |s| gap(step, *s))).collect();
        assert!((share[0] + 1.0).abs() < 1e-12, "{share:?}");
        let mut film = FilmCycle::new(Film::new(FilmGrid { x, y: Axis::single(1e-3) }, &gas), steps);
        let mut state = FilmState::at_rest(h[1..intervals].to_vec());
        let mut line = vec![0.0; h.len()];
        for _ in 0..40 {
            film.march(&h, None, |_| 1e-8 / steps as f64, &mut state, &mut line, &Cancel::new()).unwrap();
            film.shift(&mut state);
        }
        for (ix, z) in (1..).zip(&state.trapped) {
            let mean = (0..steps).map(|step| h[step * (intervals + 1) + ix]).sum::<f64>() / steps as f64;
            assert!((z / mean - 1.0).abs() < 1e-3, "{law:?}, {intervals} intervals, node {ix}: Z/⟨h⟩ = {}", z / mean);
        }
    }
}

#[test]
fn viscous_limit_is_the_incompressible_film_with_no_mean_load() {
    let (epsilon, m) = (0.3, 0.1);
    let strip = plate(1e-3, epsilon, m, None);
    let found = solve(&strip, Fidelity::Fine);
    let omega = std::f64::consts::TAU * strip.frequency;
    let recording = &found.recording;
    let scale = exact::viscous_strip_force(strip.gas.viscosity, LENGTH, GAP, omega * GAP, m * GAP).abs();
    let mut worst = 0.0_f64;
    for frame in 0..recording.frames {
        let phase = std::f64::consts::TAU * frame as f64 / recording.frames as f64;
        let gap = strip.gap(frame as f64 / recording.frames as f64);
        let rate = -omega * strip.amplitude * phase.sin();
        let force = exact::viscous_strip_force(strip.gas.viscosity, LENGTH, gap, rate, strip.gas.mean_free_path);
        let load = recording.film_load[frame];
        worst = worst.max((load - force).abs() / scale);
        // Finite volumes on 52 graded intervals and 256 steps: 0.2 % of the largest force.
        assert!((load - force).abs() < 2e-3 * scale, "{frame}: {load} {force}");
    }
    println!(
        "viscous limit: {worst:.1e}, mean load {:.1e}, of the largest force",
        found.result.film_load.value.abs() / scale
    );
    assert!(found.result.film_load.value.abs() < 1e-3 * scale, "{} {scale}", found.result.film_load);
}

#[test]
fn the_greatest_load_of_gas_that_is_not_compressed_is_that_of_its_formula() {
    // Without slip it goes with sin τ/(1 + ε cos τ)³, which is greatest where 2ε cos²τ − cos τ = 3ε.
    for epsilon in [0.5, 0.95] {
        let plate = plate(1.0, epsilon, 0.0, None);
        let found = solve(&plate, Fidelity::Draft);
        let compared = ExactComparison::of(&plate, &found.result, &found.recording);
        let cos: f64 = (1.0 - (1.0 + 24.0 * epsilon * epsilon).sqrt()) / (4.0 * epsilon);
        let speed = std::f64::consts::TAU * plate.frequency * plate.amplitude * (1.0 - cos * cos).sqrt();
        let known = exact::viscous_force(&plate, plate.mean_gap * (1.0 + epsilon * cos), -speed);
        assert!((compared.greatest_viscous / known - 1.0).abs() < 1e-9, "{} {known}", compared.greatest_viscous);
    }
}

/// Spring and damping of the load over a cycle, divided by p_a·area·ε.
fn first_harmonic(plate: &Plate, found: &Periodic) -> (f64, f64) {
    let frames = found.recording.frames as f64;
    let scale = 2.0 / frames / (plate.gas.ambient_pressure * plate.area() * plate.amplitude / GAP);
    let mut sum = (0.0, 0.0);
    for (frame, load) in found.recording.film_load.iter().enumerate() {
        let phase = std::f64::consts::TAU * frame as f64 / frames;
        // Re(F e^{iτ}) = F_r cos τ − F_i sin τ.
        sum = (sum.0 + load * phase.cos(), sum.1 - load * phase.sin());
    }
    (scale * sum.0, scale * sum.1)
}

#[test]
fn small_amplitudes_have_the_linear_spring_and_damping() {
    for (aspect, fidelity, bound) in [
        // Fields of the finest grid, not extrapolated: 96 intervals and 512 steps, 24 and 128.
        (None, Fidelity::Reference, 5e-4),
        (Some(1.0), Fidelity::Standard, 6e-3),
        (Some(0.3), Fidelity::Standard, 6e-3),
    ] {
        for m in [0.0, 0.2] {
            for sigma in [1.0, 30.0, 1000.0] {
                let plate = plate(sigma, 1e-4, m, aspect);
                let found = solve(&plate, fidelity);
                let (spring, damping) = first_harmonic(&plate, &found);
                let exact = exact::linear_load(sigma / (1.0 + 6.0 * m), plate.outline());
                let error = (spring - exact.re).hypot(damping - exact.im) / exact.norm();
                println!("linear, aspect {aspect:?}, m = {m}, σ = {sigma}: {error:.1e}");
                assert!(
                    error < bound,
                    "{aspect:?} m = {m} σ = {sigma}: {spring} {damping}, exact {exact:?}: {error:.1e}"
                );
            }
        }
    }
}

#[test]
fn the_plate_of_two_other_codes() {
    // 1.735 mm × 0.3 mm, h = 1 µm (1 + 0.5 cos ωt), 30 kHz: mean gauge load 13.850 mN without slip (two independent
    // codes, mesh-extrapolated), 12.26 mN with first-order slip at λ_a = 65 nm.
    for (mean_free_path, expected, digits) in [(0.0, 13.850e-3, 2e-6), (65e-9, 12.26e-3, 6e-6)] {
        let (length, width, gas) = (1.735e-3, Some(0.3e-3), air(mean_free_path));
        let plate = Plate { length, width, frequency: 30e3, gas, ..plate(1.0, 0.5, 0.0, None) };
        let Estimate { value: load, error } = solve(&plate, Fidelity::Standard).result.film_load;
        println!("plate benchmark: {:.4} ± {:.4} mN", 1e3 * load, 1e3 * error);
        assert!((load - expected).abs() < digits, "{load:.6e} ± {error:.1e}, expected {expected}");
    }
}

#[test]
fn the_published_stiffness_and_damping_of_a_plate() {
    // The benchmark of a commercial code prints 28.65e3 N/m and 15.29e-3 N s/m. One unit of the last digit is allowed, as
    // the last digit of the damping is cut, not rounded: the linear film, which the benchmark is about, has 15.298e-3.
    let plate = scenes::plate("plate-mems", &[]);
    let found = solve(&plate, Fidelity::Reference);
    let compared = ExactComparison::of(&plate, &found.result, &found.recording);
    let solved = compared.stiffness_and_damping().unwrap();
    for (what, solved, published, digit, exact) in [
        ("stiffness", solved.spring, 28.65e3, 0.01e3, compared.linear.spring * compared.unit.spring),
        ("damping", solved.damping, 15.29e-3, 0.01e-3, compared.linear.damping * compared.unit.damping),
    ] {
        println!("{what}: {:.6e} ± {:.1e}, linear film {exact:.6e}", solved.value, solved.error);
        assert!((exact - published).abs() < digit, "{what}: {exact}");
        assert!((solved.value - published).abs() < digit, "{what}: {solved:?}");
        assert!((solved.value - exact).abs() < solved.error, "{what}: {solved:?}, linear film {exact}");
        assert!(solved.error < 2e-3 * exact, "{what}: {solved:?}");
    }
}

#[test]
fn slip_laws_agree_at_small_knudsen_numbers_and_differ_at_ours() {
    let load = |slip: Slip, mean_free_path: f64| {
        let mut plate = plate(100.0, 0.5, 0.0, None);
        plate.gas.slip = slip;
        plate.gas.mean_free_path = mean_free_path;
        solve(&plate, Fidelity::Standard).result.film_load.value
    };
    let laws = [Slip::FirstOrder, Slip::SecondOrder, Slip::FukuiKaneko];
    let continuum = load(Slip::None, 64e-9);
    for law in laws {
        assert!((load(law, 1e-10) / continuum - 1.0).abs() < 1e-3, "{law:?}");
        assert_eq!(load(law, 0.0), load(Slip::None, 0.0));
    }
    let ours: Vec<f64> = laws.iter().map(|law| load(*law, 0.3 * GAP)).collect();
    assert!((ours[0] - ours[1]).abs() > 1e-2 * ours[0], "{ours:?}");
}

#[test]
fn convergence_is_of_second_order_in_space_and_time() {
    // A crossover strip, its mean load on grids and steps that are doubled one at a time: the differences of a
    // second-order scheme fall by 4.
    let strip = plate(30.0, 0.5, 0.1, None);
    let load = |along: usize, steps: usize| {
        let numerics =
            Numerics { film_nodes_along: Some(2 * along + 1), steps_per_cycle: Some(steps), ..Numerics::default() };
        *solve_with(&strip, Fidelity::Reference, &numerics).headlines.last().unwrap()
    };
    let space: Vec<f64> = [16, 32, 64, 128].iter().map(|n| load(*n, 64)).collect();
    let time: Vec<f64> = [32, 64, 128, 256].iter().map(|n| load(16, *n)).collect();
    for (what, r) in [("space", space), ("time", time)] {
        let orders: Vec<f64> = (0..2).map(|i| ((r[i + 1] - r[i]) / (r[i + 2] - r[i + 1])).abs().log2()).collect();
        println!("order in {what}: {orders:.3?}");
        assert!(orders.iter().all(|order| (1.8..2.4).contains(order)), "{what}: orders {orders:?} of {r:?}");
    }
}

#[test]
fn many_nodes_across_take_no_more_solves_and_agree_with_a_polynomial() {
    // Line by line from 20 across half the width on: one solve costs in proportion to the nodes, so that what counts is how many there are.
    for (sigma, epsilon) in [(1.0, 0.3), (50.0, 0.8), (1e3, 0.5)] {
        let square = plate(sigma, epsilon, 0.1, Some(1.0));
        let found = |nodes: usize, across: usize| {
            let numerics = Numerics {
                film_nodes_along: Some(nodes),
                film_nodes_across: Some(across),
                steps_per_cycle: Some(160),
                tolerance: Some(1e-9),
                ..Numerics::default()
            };
            let one = Plan::plate(&square, Fidelity::Standard, &numerics).on_one_grid();
            let cycle = plate::periodic(&square, &one, &mut (), &Cancel::new()).unwrap();
            let off = largest_invariant_error(&square, &cycle);
            assert!(off < 1e-7, "σ = {sigma}, {nodes} × {across} nodes: ⟨hΦ⟩ off by {off:.1e}");
            (cycle.stats.film_solves, solve_with(&square, Fidelity::Standard, &numerics).result.film_load.value)
        };
        let ((few, _), (many, load), (_, polynomial)) = (found(49, 49), found(129, 129), found(129, 25));
        println!("σ = {sigma}: {few} and {many} solves, load {load}, of a polynomial {polynomial}");
        assert!((many as f64) < 1.1 * few as f64, "{few} solves, {many} on seven times as many nodes");
        assert!((load / polynomial - 1.0).abs() < 1e-4, "σ = {sigma}: {load}, of a polynomial {polynomial}");
    }
}

// ---- what a plan makes of a plate

#[test]
fn a_plate_turned_by_a_quarter_is_the_same_plate() {
    for sigma in [1.0, 1e5] {
        let long = plate(sigma, 0.5, 0.1, Some(1.0 / 40.0));
        let [found, other] = [&long, &long.turned()].map(|plate| solve(plate, Fidelity::Standard));
        let (load, turned) = (found.result.film_load.value, other.result.film_load.value);
        assert!((turned / load - 1.0).abs() < 1e-9, "{load} {turned}");
        let (a, b) = (&found.recording, &other.recording);
        assert_eq!((&a.map_x, &a.map_y), (&b.map_y, &b.map_x));
        assert!((a.length / b.length - 40.0).abs() < 1e-9);
        let (nx, ny) = (a.map_x.len(), a.map_y.len());
        for (k, p) in a.pressure.iter().enumerate() {
            let (frame, ix, iy) = (k / (nx * ny), k / ny % nx, k % ny);
            assert_eq!(*p, b.pressure[(frame * ny + iy) * nx + ix]);
        }
        for frame in 0..b.frames {
            let line = &b.film[frame * b.x.len()..][..b.x.len()];
            let sum: f64 = line.iter().zip(&b.node_length).map(|(film, length)| film * length).sum();
            let force = long.gas.ambient_pressure * long.area();
            assert!((sum - b.film_load[frame]).abs() < 1e-12 * force, "{frame}");
        }
    }
}

#[test]
fn steps_that_follow_the_gap_agree_with_even_ones() {
    for sigma in [0.1, 30.0, 1e4] {
        let strip = plate(sigma, 0.9995, 0.0, None);
        let even = Numerics { steps_per_cycle: Some(4096), film_nodes_along: Some(129), ..Numerics::default() };
        let (even, found) = (solve_with(&strip, Fidelity::Fine, &even), solve(&strip, Fidelity::Fine));
        let (a, b) = (found.result, even.result);
        for (ours, theirs) in [(a.film_load, b.film_load), (a.film_load_max, b.film_load_max)] {
            println!("σ {sigma}: {ours} even {theirs}");
            assert!((ours.value - theirs.value).abs() < ours.error + theirs.error);
        }
        assert!(a.film_load.error < 2e-3 * a.film_load.value);
        assert!(2 * found.stats.steps_per_cycle < even.stats.steps_per_cycle);
    }
}

#[test]
fn what_trapped_gas_leaves_out_is_bounded() {
    for (epsilon, m, aspect) in [(0.02, 0.0, None), (0.5, 1.0, Some(0.5)), (0.99, 0.1, None)] {
        let plate = plate(1e7 * (1.0 + 6.0 * m), epsilon, m, aspect);
        let plan = Plan::plate(&plate, Fidelity::Draft, &Numerics::default());
        assert!(plan.trapped && plan.left_out < 4e-3, "{}", plan.left_out);
        let marched = Plan { trapped: false, left_out: 0.0, accuracy: 5e-4, ..plan.clone() };
        let load = |plan: &Plan| plate::periodic(&plate, plan, &mut (), &Cancel::new()).unwrap().result.film_load;
        let [trapped, marched] = [&plan, &marched].map(load);
        let effect = trapped.value / marched.value - 1.0;
        println!("ε {epsilon}: effect {effect:.2e} of {:.2e}", plan.left_out);
        assert!(effect.abs() > 0.2 * plan.left_out && effect.abs() < plan.left_out, "{effect}");
        assert!((trapped.value - marched.value).abs() < trapped.error + marched.error);
    }
}

#[test]
fn the_nodes_across_a_long_plate_are_in_the_error_of_its_damping() {
    let set = [
        ("plate.length_mm", "12.79"),
        ("plate.width_mm", "1.601"),
        ("plate.mean_gap_um", "0.6838"),
        ("plate.amplitude_um", "0.006838"),
        ("film.slip", "none"),
        ("plate.frequency_khz", "60.628"),
    ];
    let plate = scenes::plate("plate-crossover", &set);
    let found = solve(&plate, Fidelity::Draft);
    let compared = ExactComparison::of(&plate, &found.result, &found.recording);
    let damping = compared.solved.unwrap().damping;
    assert!((damping.value - compared.linear.damping).abs() < damping.error, "{damping:?} {:?}", compared.linear);
}

/// A plate, changed from `plate-mems`, solved at a draft and at reference.
fn draft_and_reference(changes: &[(&str, &str)]) -> [(ExactComparison, Periodic); 2] {
    let plate = scenes::plate("plate-mems", changes);
    [Fidelity::Draft, Fidelity::Reference].map(|fidelity| {
        let found = solve(&plate, fidelity);
        (ExactComparison::of(&plate, &found.result, &found.recording), found)
    })
}

#[test]
fn the_error_of_a_plate_that_nearly_touches_reaches_its_spring_and_its_mean_by_every_slip_law() {
    // 1 − ε = 8e-4 and 7e-4.
    let ring = [
        ("plate.shape", "ring"),
        ("plate.radius_mm", "20.18"),
        ("plate.inner_radius_mm", "15.054"),
        ("plate.mean_gap_um", "0.12965"),
        ("plate.amplitude_um", "0.129541895"),
        ("plate.frequency_khz", "6.5923"),
        ("film.slip", "second-order"),
        ("film.ambient_pressure_kpa", "10.363"),
        ("film.mean_free_path_nm", "1328.5"),
    ];
    let disc = [
        ("plate.shape", "disc"),
        ("plate.radius_mm", "99.225"),
        ("plate.mean_gap_um", "0.11428"),
        ("plate.amplitude_um", "0.114198294"),
        ("plate.frequency_khz", "0.0012261"),
        ("film.gas", "argon"),
        ("film.temperature_c", "16.723"),
        ("film.ambient_pressure_kpa", "3.4693"),
        ("film.slip", "second-order"),
    ];
    for changes in [&ring[..], &disc] {
        let [(draft, coarse), (reference, fine)] = draft_and_reference(changes);
        let numbers =
            |exact: &ExactComparison, found: &Periodic| [exact.solved.unwrap().spring, found.result.film_load];
        for (draft, reference) in numbers(&draft, &coarse).into_iter().zip(numbers(&reference, &fine)) {
            assert!((draft.value - reference.value).abs() < draft.error + reference.error, "{draft} for {reference}");
        }
    }
}

#[test]
fn an_error_by_the_nodes_across_is_that_of_every_instant() {
    let [(_, draft), (_, reference)] = draft_and_reference(&[
        ("plate.length_mm", "0.97514"),
        ("plate.width_mm", "4.8549"),
        ("plate.mean_gap_um", "1.3372"),
        ("plate.amplitude_um", "1.76590632e-06"),
        ("plate.frequency_khz", "22.337"),
        ("film.ambient_pressure_kpa", "29.063"),
        ("film.viscosity_upa_s", "37.029"),
        ("film.mean_free_path_nm", "245.53"),
        ("film.slip", "none"),
    ]);
    let (draft, reference) = (draft.recording, reference.recording);
    let finer = reference.frames / draft.frames;
    for frame in 0..draft.frames {
        let (found, error) = (draft.film_load[frame], draft.film_load_error[frame]);
        let (exact, known) = (reference.film_load[finer * frame], reference.film_load_error[finer * frame]);
        assert!((found - exact).abs() < error + known, "frame {frame}: {found:e} ± {error:e} for {exact:e}");
    }
}
