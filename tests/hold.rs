//! A plate held by hand against exact results: Boyle, the viscous film, the slowest mode of the leak, and the balance of mass.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod scenes;

use proptest::prelude::{ProptestConfig, prop, proptest};
use squeezefilm::control::Cancel;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::film::exact::viscous_strip_force;
use squeezefilm::hold::{Hold, REACH, leak_time};
use squeezefilm::plan::Plan;
use squeezefilm::problem::{GRAVITY, Numerics, Plate, Scenario};
use squeezefilm::solution::{Outcome, PlateResult, SlowMotion, settled};
use squeezefilm::solve::{Settings, solve};

fn plate(set: &[(&str, &str)]) -> Plate {
    scenes::plate("plate-crossover", set)
}

fn held(plate: &Plate) -> Hold {
    Hold::new(plate, &Plan::plate(plate, Fidelity::Standard, &Numerics::default()))
}

fn plates() -> [Plate; 2] {
    [plate(&[]), plate(&[("plate.width_mm", "0.7")])]
}

#[test]
fn in_no_time_boyle_holds_everywhere() {
    for plate in plates() {
        let ambient = plate.gas.ambient_pressure;
        for share in [REACH[0], 0.5, 2.0, REACH[1]] {
            let mut hold = held(&plate);
            hold.advance(share * plate.mean_gap, 0.0).unwrap();
            let middle = hold.pressure().next().unwrap();
            assert!((middle * share / ambient - 1.0).abs() < 1e-12);
            // Over all but the nodes on the edges, which stay ambient: those stand for the difference, which is in the error.
            let reading = hold.reading();
            let exact = ambient * plate.area() * (1.0 / share - 1.0);
            assert!((reading.force - exact).abs() < 0.2 * exact.abs(), "{share}: {reading:?} {exact}");
        }
    }
}

#[test]
fn moved_fast_it_is_boyle_but_for_a_layer_at_the_edges() {
    for plate in plates() {
        let mut hold = held(&plate);
        let time = 1e-3 * leak_time(&plate, plate.mean_gap);
        hold.advance(0.6 * plate.mean_gap, time).unwrap();
        let ratio = hold.pressure().next().unwrap() / plate.gas.ambient_pressure;
        assert!((0.6 * ratio - 1.0).abs() < 1e-5, "{ratio}");
        // What has left is what diffuses through the edges, over about √(D t) at each: little, and less than nothing left.
        let reading = hold.reading();
        let boyle = 1.0 / 0.6 - 1.0;
        assert!(reading.ratio < boyle && reading.ratio > 0.85 * boyle, "{reading:?}");
    }
}

#[test]
fn moved_slowly_it_is_the_viscous_film() {
    let plate = plate(&[]);
    let (gap, leak) = (plate.mean_gap, leak_time(&plate, plate.mean_gap));
    for speed in [1e-4, -1e-4] {
        // Long enough to be steady, and by a thousandth of the gap.
        let mut hold = held(&plate);
        for i in 1..=100 {
            hold.advance(gap * (1.0 - speed * f64::from(i) / 10.0), 0.1 * leak).unwrap();
        }
        let reading = hold.reading();
        let gas = plate.gas;
        let exact =
            viscous_strip_force(gas.viscosity, plate.length, reading.gap, -speed * gap / leak, gas.mean_free_path);
        let off = (reading.force - exact).abs();
        // The gas is a little compressible, and the force lags by a leak time: 2e-4 of it.
        assert!(off < reading.error + 4e-4 * exact.abs(), "{reading:?}, {exact}");
        assert!(reading.error < 0.02 * exact.abs(), "{reading:?}");
    }
}

#[test]
fn held_still_the_pressure_falls_at_the_rate_of_the_slowest_mode() {
    for plate in plates() {
        for share in [0.999, 1.001] {
            let gap = share * plate.mean_gap;
            let leak = leak_time(&plate, gap);
            let mut hold = held(&plate);
            hold.advance(gap, 1e-2 * leak).unwrap();
            // The second mode has decayed by e⁻⁹ for each e⁻¹ of the first, of a rectangle at least e⁻³ or so.
            hold.advance(gap, 3.0 * leak).unwrap();
            let before = hold.reading().ratio;
            hold.advance(gap, leak).unwrap();
            let rate = (before / hold.reading().ratio).ln();
            assert!((rate - 1.0).abs() < 5e-3, "{rate}");
            hold.advance(gap, 20.0 * leak).unwrap();
            assert!(hold.unrest() < 1e-9, "{}", hold.unrest());
        }
    }
}

#[test]
fn what_the_film_loses_is_what_leaves_at_its_edge() {
    for plate in [plate(&[]), plate(&[("plate.shape", "disc"), ("plate.radius_mm", "0.5")])] {
        what_leaves(&plate);
    }
}

fn what_leaves(plate: &Plate) {
    let gap = 0.5 * plate.mean_gap;
    let mut hold = held(plate);
    hold.advance(gap, 1e-2 * leak_time(plate, gap)).unwrap();
    // Equal steps from here on, each of two on the finer grid.
    let step = 1e-3 * leak_time(plate, gap);
    for _ in 0..20 {
        hold.advance(gap, step).unwrap();
    }
    let nodes = hold.grid().x.nodes.clone();
    let last = nodes.len() - 1;
    let (ambient, gas) = (plate.gas.ambient_pressure, plate.gas);
    // Through the last face: M h (Φ₁ − Φ₀)/Δ, Φ = Z²/2 + 6 λ Z, at either end.
    let potential = |z: f64| 0.5 * z * z + 6.0 * gas.mean_free_path * z;
    let outflow = |hold: &Hold| {
        let z = gap * hold.pressure().nth(last - 1).unwrap() / ambient;
        let drop = potential(z) - potential(gap);
        // Of a strip both edges, of a disc its circumference.
        let edges = plate.hole.map_or(2.0, |_| std::f64::consts::PI * (nodes[last] + nodes[last - 1]));
        edges * ambient / (12.0 * gas.viscosity) * gap * drop / (nodes[last] - nodes[last - 1])
    };
    for _ in 0..50 {
        let (before, flow) = (hold.carried_gas(), outflow(&hold));
        hold.advance(gap, step).unwrap();
        let left = (before - hold.carried_gas()) / step;
        // The flow at the end of either half of the step: so short a time it falls evenly.
        let mean = 0.25 * flow + 0.75 * outflow(&hold);
        assert!((left / mean - 1.0).abs() < 2e-4, "{left} {mean}");
    }
}

#[test]
fn the_stated_error_holds_against_a_finer_grid() {
    for plate in plates() {
        let plan = |fidelity| Plan::plate(&plate, fidelity, &Numerics::default());
        let mut usual = Hold::new(&plate, &plan(Fidelity::Standard));
        let mut finer = Hold::new(&plate, &plan(Fidelity::Fine));
        let leak = leak_time(&plate, plate.mean_gap);
        // A hand that shakes: up and down twice in a leak time.
        for i in 1..=60 {
            let gap = plate.mean_gap * (1.0 + 0.5 * (0.2 * f64::from(i)).sin());
            usual.advance(gap, leak / 60.0).unwrap();
            finer.advance(gap, leak / 60.0).unwrap();
            let (a, b) = (usual.reading(), finer.reading());
            assert!((a.force - b.force).abs() < a.error + b.error, "step {i}: {a:?} {b:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_jump_and_no_pause_disturb_it(moves in prop::collection::vec((0.05..4.0f64, -6.0..0.3f64), 1..12), wide in prop::bool::ANY) {
        let plate = if wide { plate(&[]) } else { plate(&[("plate.width_mm", "0.3"), ("film.slip", "fukui-kaneko")]) };
        let mut hold = held(&plate);
        let leak = leak_time(&plate, plate.mean_gap);
        for (share, time) in moves {
            hold.advance(share * plate.mean_gap, leak * 10f64.powf(time)).unwrap();
            let reading = hold.reading();
            let least = hold.pressure().fold(f64::INFINITY, f64::min);
            let most = hold.pressure().fold(0.0, f64::max);
            // Nothing compresses gas further than from one end of the reach to the other.
            let bound = plate.gas.ambient_pressure * REACH[1] / REACH[0];
            assert!(least > 0.0 && most < 1.01 * bound, "{least} {most}");
            assert!(reading.force.is_finite() && reading.error.is_finite() && reading.mean_pressure > 0.0);
            assert_eq!(reading.gap, plate.mean_gap * share.clamp(REACH[0], REACH[1]));
        }
    }
}

#[test]
fn a_gap_that_is_no_number_is_the_mean_gap_and_reset_is_rest() {
    let plate = plate(&[]);
    let mut hold = held(&plate);
    hold.advance(f64::NAN, 1e-5).unwrap();
    assert_eq!(hold.gap(), plate.mean_gap);
    hold.advance(0.4 * plate.mean_gap, 1e-5).unwrap();
    hold.advance(0.5 * plate.mean_gap, f64::INFINITY).unwrap();
    hold.reset();
    assert_eq!((hold.gap(), hold.unrest()), (plate.mean_gap, 0.0));
    assert!(hold.reading().force.abs() < 1e-12);
}

// ---- let go

/// A plate under a load, and the gap at which it floats \[m\].
fn floating(set: &[(&str, &str)]) -> (Plate, f64) {
    let problem = scenes::problem("floating-disc", set);
    let settings = Settings { fidelity: Fidelity::Fine, ..Settings::default() };
    let solution = solve(&problem, &settings, &mut (), &Cancel::new()).unwrap();
    let Scenario::Plate(plate) = settled(&problem, &solution.outcome).into_owned().scenario else { panic!("a plate") };
    let gap = plate.mean_gap;
    (plate, gap)
}

fn dropped(plate: &Plate, from: f64) -> Hold {
    let mut hold = Hold::new(plate, &Plan::plate(plate, Fidelity::Draft, &Numerics::default()));
    hold.rest_at(from);
    hold
}

#[test]
fn dropped_it_settles_where_the_periodic_solve_floats_and_sinks_when_the_vibration_stops() {
    for set in [&[][..], &[("plate.shape", "ring"), ("plate.inner_radius_mm", "4"), ("plate.mass_g", "20")]] {
        let (plate, gap) = floating(set);
        let cycle = 1.0 / plate.frequency;
        for from in [1.4, 0.8] {
            let mut hold = dropped(&plate, from * gap);
            hold.fall(1600.0 * cycle, true).unwrap();
            let before = hold.height();
            hold.fall(20.0 * cycle, true).unwrap();
            println!("{set:?}, from {from}: {} of {gap}, {:?}", hold.height(), hold.free());
            assert!((hold.height() / gap - 1.0).abs() < 5e-3, "{} {gap}", hold.height());
            assert!((hold.height() / before - 1.0).abs() < 1e-4 && hold.free().rests == 0);
            // The mean force is the weight.
            let force = hold.fall(50.0 * cycle, true).unwrap().force;
            assert!((force / plate.load.unwrap() - 1.0).abs() < 0.01, "{force}");
            hold.fall(100.0 * cycle, false).unwrap();
            let sinking = hold.height();
            assert_eq!(hold.free().amplitude, 0.0);
            hold.fall(100.0 * cycle, false).unwrap();
            assert!(hold.height() < sinking && sinking < gap, "{sinking} {gap}");
        }
    }
}

#[test]
fn the_mean_pressure_of_a_plate_let_go_has_the_mean_force() {
    // Over a part of a cycle, and over many.
    let (plate, gap) = floating(&[]);
    let mut hold = dropped(&plate, 0.6 * gap);
    hold.fall(20.3 / plate.frequency, true).unwrap();
    for cycles in [0.0, 0.1, 0.7, 12.0] {
        let reading = hold.fall(cycles / plate.frequency, true).unwrap();
        let (x, ambient) = (&hold.grid().x, plate.gas.ambient_pressure);
        let sum = |pressure: &mut dyn Iterator<Item = f64>| -> f64 {
            pressure.zip(&x.lengths).map(|(p, length)| (p - ambient) * length).sum::<f64>() * x.copies()
        };
        let (mean, at_the_end) = (sum(&mut hold.mean_pressure()), sum(&mut hold.pressure()));
        println!("{cycles}: {mean} and {at_the_end}, {reading:?}");
        assert!((mean - reading.force).abs() < 3.0 * reading.error + 1e-3 * ambient * plate.area(), "{cycles}");
    }
}

#[test]
fn the_mean_force_on_a_plate_let_go_does_not_shake_with_the_vibration() {
    let (plate, gap) = floating(&[]);
    let mut hold = dropped(&plate, gap);
    hold.fall(400.0 / plate.frequency, true).unwrap();
    // Read ten times in each cycle.
    let forces: Vec<f64> = (0..40).map(|_| hold.fall(0.1 / plate.frequency, true).unwrap().force).collect();
    let load = plate.load.unwrap();
    assert!(forces.iter().all(|force| (force / load - 1.0).abs() < 0.1), "{forces:?}");
    assert!(!hold.free().struck);
}

#[test]
fn a_face_that_strikes_the_plate_throws_it_no_higher_than_its_own_speed_does() {
    let (plate, gap) = floating(&[("plate.mass_g", "2000")]);
    let mut hold = dropped(&plate, gap);
    let (cycle, mut highest) = (1.0 / plate.frequency, 0.0f64);
    for _ in 0..400 {
        hold.fall(cycle, true).unwrap();
        highest = highest.max(hold.height());
    }
    let speed = std::f64::consts::TAU * plate.frequency * plate.amplitude;
    let most = speed * speed / (2.0 * GRAVITY);
    println!("{highest} of {most}, {:?}", hold.free());
    assert!(hold.free().struck && highest > 5.0 * gap && highest < most, "{highest} of {most}");
    // Whoever takes it in the hand forgets that.
    hold.advance(gap, cycle).unwrap();
    assert!(!hold.free().struck);
}

/// What a solve of such a plate says of its slow motion.
fn said(set: &[(&str, &str)]) -> SlowMotion {
    let problem = scenes::problem("floating-disc", set);
    let solution = solve(&problem, &Settings::default(), &mut (), &Cancel::new()).unwrap();
    let Outcome::Plate(PlateResult { floating: Some(found), .. }) = solution.outcome else { panic!("it floats") };
    found.slow.unwrap()
}

#[test]
fn pushed_away_it_creeps_back_as_fast_as_is_said() {
    let ((plate, gap), slow) = (floating(&[]), said(&[]));
    assert!(slow.damping_ratio.value > 5.0, "{slow:?}");
    let within = slow.creep_time.unwrap().value;
    // Three heights at equal times give the rate, wherever it ends; at the same instant of the vibration, in which the plate trembles.
    let cycle = 1.0 / plate.frequency;
    let pause = (within / cycle).round() * cycle;
    let mut hold = dropped(&plate, 1.1 * gap);
    hold.fall(3.0 * pause, true).unwrap();
    let heights = [0, 1, 2].map(|_| {
        hold.fall(pause, true).unwrap();
        hold.height()
    });
    let share = (heights[1] - heights[2]) / (heights[0] - heights[1]);
    println!("within {within} s, {heights:?}: {share} of exp(-1)");
    assert!((-share.ln() * within / pause - 1.0).abs() < 0.02, "{share}");
}

#[test]
fn a_heavy_disc_swings_as_is_said() {
    // 488 Hz on the stiffness at this height alone, and 7.8 times critical by the damping of a film that is not compressed.
    let (plate, gap) = floating(&[("plate.mass_g", "500")]);
    let slow = said(&[("plate.mass_g", "500")]);
    let (frequency, decay) = (slow.swing_frequency.unwrap(), slow.swing_decay.unwrap());
    let cycle = 1.0 / plate.frequency;
    let mut hold = dropped(&plate, 1.03 * gap);
    hold.fall(4.0 * cycle, true).unwrap();
    let heights: Vec<f64> = (0..200)
        .map(|_| {
            hold.fall(cycle, true).unwrap();
            hold.height()
        })
        .collect();
    // What creeps is nearly even over a swing: how much the middle of three heights half a swing apart is off them is the swing's alone.
    let half = (0.5 / frequency.value / cycle).round() as usize;
    let off: Vec<f64> = (half..200 - half).map(|i| 2.0 * heights[i] - heights[i - half] - heights[i + half]).collect();
    let peaks: Vec<usize> = (1..off.len() - 1).filter(|i| off[*i] > off[i - 1] && off[*i] >= off[i + 1]).collect();
    let (first, last) = (peaks[0], peaks[peaks.len() - 1]);
    let (swings, time) = ((peaks.len() - 1) as f64, (last - first) as f64 * cycle);
    let (swung, died) = (swings / time, time / (off[first] / off[last]).ln());
    println!("said {frequency} Hz, {} s; found {swung} Hz, {died} s, {peaks:?}", decay);
    assert!(
        (swung / frequency.value - 1.0).abs() < 0.05 && (died / decay.value - 1.0).abs() < 0.1,
        "{swung} {died} {slow:?}"
    );
}

#[test]
fn without_vibration_a_disc_sinks_as_reynolds_has_it_and_comes_to_rest() {
    // d(1/h²)/dt = 4 m g/(3 π μ R⁴): no slip, so light that the gas is hardly compressed, so slow that its inertia is nothing.
    let set = [("plate.mass_g", "1"), ("film.slip", "none"), ("plate.amplitude_um", "1")];
    let (plate, _) = floating(&set);
    let rate = 4.0 * plate.load.unwrap() / (3.0 * std::f64::consts::PI * plate.gas.viscosity * plate.radius().powi(4));
    let start = 3e-6;
    let mut hold = dropped(&plate, start);
    let time = 0.01 / (rate * start * start);
    hold.fall(0.2 * time, false).unwrap();
    let from = hold.gap().powi(-2);
    hold.fall(time, false).unwrap();
    let found = (hold.gap().powi(-2) - from) / time;
    println!("sinking: {found:e}, Reynolds {rate:e}");
    assert!((found / rate - 1.0).abs() < 0.01, "{found} {rate}");
    // To its roughness, and no further.
    let least = 0.997 * start;
    let mut hold = dropped(&Plate { min_spacing: least, ..plate }, start);
    hold.fall(2.0 * time, false).unwrap();
    assert_eq!((hold.gap(), hold.is_still()), (least, true));
    assert!(hold.free().rests > 0);
}

#[test]
fn energy_only_leaves_a_plate_that_bounces() {
    // Fast on a film that has no time to leak: it bounces, and each time a little lower.
    let (plate, gap) = floating(&[("plate.radius_mm", "50"), ("plate.mass_g", "5000"), ("film.min_spacing_nm", "5")]);
    let mut hold = dropped(&plate, 1.5 * gap);
    let mass = plate.load.unwrap() / GRAVITY;
    let ambient = plate.gas.ambient_pressure;
    // Of the trapped gas ∫ [p ln(p/p_a) − (p − p_a)] h dA, the work that isothermal gas can still do on the plate.
    let left_in_gas = |hold: &Hold| {
        let work = |p: f64| p * (p / ambient).ln() - (p - ambient);
        let x = &hold.grid().x;
        hold.gap() * hold.pressure().zip(&x.lengths).map(|(p, area)| work(p) * area).sum::<f64>()
    };
    let energy = |hold: &Hold| 0.5 * mass * hold.free().speed.powi(2) + mass * GRAVITY * hold.gap() + left_in_gas(hold);
    let start = energy(&hold);
    let (mut last, mut kinetic, mut turns, mut up) = (start, 0.0f64, 0, false);
    let tick = 0.003 * leak_time(&plate, gap);
    for _ in 0..600 {
        hold.fall(tick, false).unwrap();
        let now = energy(&hold);
        kinetic = kinetic.max(0.5 * mass * hold.free().speed.powi(2));
        // Half the square of a step, of what moves at most.
        assert!(now < last + 1e-4 * start, "{now} after {last} of {start}");
        last = now;
        let rises = hold.free().speed > 0.0;
        turns += i32::from(rises != up);
        up = rises;
    }
    println!("energy {start:e} to {last:e}, kinetic up to {kinetic:e}, {turns} turns");
    assert!(last < start && turns > 3 && hold.free().rests == 0);
}

#[test]
fn a_fall_converges_with_the_square_of_the_step() {
    let (plate, gap) = floating(&[]);
    let height = |finer: f64| {
        let mut hold = Hold::new(&plate, &Plan::plate(&plate, Fidelity::Draft, &Numerics::default())).finer(finer);
        hold.rest_at(1.6 * gap);
        hold.fall(20.0 / plate.frequency, true).unwrap();
        hold.height()
    };
    let [one, two, four, eight] = [1.0, 2.0, 4.0, 8.0].map(height);
    let orders = [(two - one) / (four - two), (four - two) / (eight - four)].map(f64::log2);
    println!("heights {one} {two} {four} {eight}, orders {orders:?}");
    assert!(orders[1] > 1.6 && (two - one).abs() < 2e-3 * gap, "{orders:?}");
}
