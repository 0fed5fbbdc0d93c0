//! The start-up from rest ends where the periodic solve says, by another way: every tooth marched, nothing accelerated.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod scenes;

use scenes::problem;
use squeezefilm::analysis::validity::{names, outside};
use squeezefilm::control::Cancel;
use squeezefilm::estimate::Estimate;
use squeezefilm::export::startup::validity;
use squeezefilm::fall::fall;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::motor::MotorTransient;
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Problem, RotorCompliance, Scenario};
use squeezefilm::solution::{Outcome, PlateResult, Stats, Status, StoppedBy};
use squeezefilm::solve::{self, solve};
use squeezefilm::startup::{Cycle, Settings, Startup, startup};

fn run(problem: &Problem, settings: &Settings) -> (Vec<Cycle>, Startup) {
    let mut cycles: Vec<Cycle> = Vec::new();
    let mut each = |cycle: Cycle| {
        // The next one, or one that was there on finer grids.
        let place = cycle.number - 1;
        assert!(
            place <= cycles.len() && cycles.get(place).is_none_or(|old| old.recording.frames < cycle.recording.frames)
        );
        if place == cycles.len() { cycles.push(cycle) } else { cycles[place] = cycle }
    };
    let ended = startup(problem, settings, &mut each, &Cancel::new()).unwrap();
    assert_eq!(ended.cycles, cycles.len());
    (cycles, ended)
}

/// α or load ratio, and its error.
fn main_number(problem: &Problem, outcome: &Outcome) -> (f64, f64) {
    match (outcome, &problem.scenario) {
        (Outcome::Motor(result), _) => (result.alpha.value, result.alpha.error),
        (Outcome::Plate(result), Scenario::Plate(plate)) => {
            (PlateResult::ratio(result.film_load.value, plate), PlateResult::ratio(result.film_load.error, plate))
        }
        _ => panic!("a plate's result of a motor"),
    }
}

#[test]
fn a_start_up_ends_at_the_periodic_state() {
    for (preset, changes) in [
        ("fundamental", &[][..]),
        ("fundamental", &[("film.min_spacing_nm", "20")]),
        ("fundamental", &[("motor.rotor_speed_rpm", "1000")]),
        ("frequency-3khz", &[]),
        ("frequency-100khz", &[]),
        ("tooth-radius-3m", &[]),
        ("rotor-width-0.6mm", &[]),
        ("levitating", &[]),
        ("plate-viscous", &[]),
        ("plate-crossover", &[]),
    ] {
        let problem = problem(preset, changes);
        for fidelity in [Fidelity::Draft, Fidelity::Standard] {
            let settings = Settings { fidelity, tolerance: 1e-4, ..Settings::default() };
            let (cycles, ended) = run(&problem, &settings);
            assert_eq!(ended.status, Status::Converged, "{preset} {changes:?}: {ended:?}");
            let asked = solve::Settings { fidelity, ..solve::Settings::default() };
            let periodic = solve(&problem, &asked, &mut (), &Cancel::new()).unwrap();
            let (found, error) = main_number(&problem, &ended.outcome);
            let (expected, stated) = main_number(&problem, &periodic.outcome);
            println!(
                "{preset} {changes:?} {fidelity}: {} cycles, {found} ± {error}, {expected} ± {stated}",
                cycles.len()
            );
            // Either states its error; what a start-up has still to go is its own.
            assert!((found - expected).abs() <= stated + ended.remaining, "{preset}: {found} {expected} ± {stated}");
            assert!((found - expected).abs() <= error + stated, "{preset}: {found} ± {error}, {expected} ± {stated}");
            // The fields of the last cycle are those of the periodic state.
            let mean = |loads: &[f64]| loads.iter().sum::<f64>() / loads.len() as f64;
            let (last, there) = (&cycles[cycles.len() - 1].recording, &periodic.recording);
            let (a, b) = (mean(&last.film_load), mean(&there.film_load));
            assert!((a / b - 1.0).abs() < 0.01, "{preset} {fidelity}: {a} N, {b} N");
        }
    }
}

#[test]
fn gas_that_still_leaks_out_slowly_is_not_at_rest() {
    // It diffuses out of the whole plate, and the slower the longer: changes fall fast at first, as if they were soon over.
    let changes = [
        ("plate.length_mm", "10"),
        ("plate.mean_gap_um", "1"),
        ("plate.amplitude_um", "0.1"),
        ("plate.frequency_khz", "100"),
    ];
    let problem = problem("plate-crossover", &changes);
    let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
    let (cycles, ended) = run(&problem, &settings);
    assert!(matches!(ended.status, Status::NotConverged { .. }) && cycles.len() == settings.cycles, "{ended:?}");
    let steady = ended.steady.unwrap();
    let left = |ended: &Startup| (steady.value - ended.outcome.plate().unwrap().film_load.value).abs() / steady.value;
    assert!(left(&ended) > 0.3 && (0.9..1.1).contains(&(ended.remaining / left(&ended))), "{ended:?}");
    let (_, ended) = run(&problem, &Settings { cycles: 20_000, tolerance: 1e-2, ..settings });
    assert_eq!(ended.status, Status::Converged, "{ended:?}");
    assert!(ended.cycles > 1000 && left(&ended) < 0.02, "{ended:?}");
}

#[test]
fn cycles_follow_each_other_without_a_gap() {
    let problem = problem("fundamental", &[]);
    let (cycles, _) = run(&problem, &Settings { fidelity: Fidelity::Draft, cycles: 3, ..Settings::default() });
    let Scenario::Motor(motor) = &problem.scenario else { panic!("a motor") };
    assert_eq!(cycles.len(), 3);
    for cycle in &cycles {
        let recording = &cycle.recording;
        assert_eq!((recording.stored_teeth, recording.teeth), (motor.teeth, motor.teeth));
        // At every instant film and contact carry the load.
        for frame in 0..recording.frames {
            let total = recording.film_load[frame] + recording.contact_load[frame];
            assert!((total / motor.load - 1.0).abs() < 2e-3, "cycle {}, frame {frame}: {total} N", cycle.number);
        }
    }
    // Rest: gas at ambient pressure, the whole load on the teeth.
    let first = &cycles[0].recording;
    assert!(first.film_load[0].abs() < 1e-9 && (first.contact_load[0] / motor.load - 1.0).abs() < 1e-9);
    // A cycle begins where the one before would have gone on: no jump larger than within a cycle.
    let (a, b) = (&cycles[1].recording, &cycles[2].recording);
    let step = |m: usize| (a.film_load[m + 1] - a.film_load[m]).abs();
    let largest = (0..a.frames - 1).map(step).fold(0.0, f64::max);
    assert!((b.film_load[0] - a.film_load[a.frames - 1]).abs() < 1.5 * largest);
}

#[test]
fn the_film_pumps_up_from_rest() {
    let problem = problem("frequency-100khz", &[]);
    let (cycles, _) = run(&problem, &Settings { fidelity: Fidelity::Draft, ..Settings::default() });
    let alphas: Vec<f64> = cycles.iter().map(|cycle| main_number(&problem, &cycle.outcome).0).collect();
    assert!(alphas.len() > 8, "{alphas:?}");
    assert!(alphas.windows(2).all(|pair| pair[1] > pair[0] - 1e-4), "{alphas:?}");
    assert!(alphas[0] < 0.7 * alphas[alphas.len() - 1], "{alphas:?}");
    // Two rounds of film and contact a step: it is cheap.
    assert!(cycles.iter().all(|cycle| cycle.change.is_finite()));
}

#[test]
fn a_limit_and_a_cancelled_run_say_so_and_keep_their_cycles() {
    let problem = problem("plate-trapped", &[]);
    let (cycles, ended) = run(&problem, &Settings { fidelity: Fidelity::Draft, cycles: 5, ..Settings::default() });
    assert_eq!(cycles.len(), 5);
    assert!(matches!(ended.status, Status::NotConverged { residual, tolerance } if residual > tolerance));
    let cancel = Cancel::new();
    let mut seen = 0;
    let mut stop = |cycle: Cycle| {
        seen = cycle.number;
        if cycle.number == 3 {
            cancel.cancel();
        }
    };
    let ended = startup(&problem, &Settings::default(), &mut stop, &cancel).unwrap();
    assert_eq!((ended.status, ended.cycles, seen), (Status::Cancelled, 3, 3));
    assert!(ended.accuracy.stated.is_finite());
}

#[test]
fn a_step_that_does_not_settle_is_counted_and_told() {
    // Film and contact cannot agree to less than round-off: every step ends at its round limit.
    let settles = problem("fundamental", &[]);
    let mut problem = settles.clone();
    problem.numerics.tolerance = Some(1e-17);
    let settings = Settings { fidelity: Fidelity::Draft, cycles: 40, tolerance: 1e-2, kept: 1 };
    let (_, ended) = run(&problem, &settings);
    assert!(ended.remaining < settings.tolerance && ended.stats.unsettled_steps > 0, "{ended:?}");
    let Status::NotConverged { residual, tolerance } = ended.status else { panic!("{ended:?}") };
    assert!(residual > tolerance && tolerance < 1e-17, "{ended:?}");
    let words = squeezefilm::export::startup::unsettled(&ended).unwrap();
    assert!(words.contains(&format!("in {} steps", ended.stats.unsettled_steps)), "{words}");
    assert_eq!(squeezefilm::export::startup::unsettled(&run(&settles, &settings).1), None);
}

#[test]
fn a_small_vibration_repeats_only_when_its_mean_load_does() {
    let problem = problem("plate-mems", &[]);
    let (_, ended) = run(&problem, &Settings::default());
    assert_eq!(ended.status, Status::Converged);
    let (steady, Outcome::Plate(last)) = (ended.steady.unwrap(), &ended.outcome) else { panic!("{ended:?}") };
    let allowed = last.film_load.error + steady.error + Settings::default().tolerance * steady.value;
    assert!((last.film_load.value - steady.value).abs() < allowed, "{} {steady}", last.film_load);
}

#[test]
fn the_error_of_every_cycle_is_what_was_asked_or_it_is_said_why_not() {
    for (preset, reached) in [("fundamental", true), ("plate-crossover", true), ("levitating", false)] {
        let problem = problem(preset, &[]);
        let series = |fidelity| {
            let (cycles, ended) = run(&problem, &Settings { fidelity, ..Settings::default() });
            let series: Vec<_> = cycles.iter().map(|cycle| main_number(&problem, &cycle.outcome)).collect();
            (series, ended.accuracy)
        };
        let (exact, _) = series(Fidelity::Fine);
        for fidelity in [Fidelity::Draft, Fidelity::to(0.01), Fidelity::Standard] {
            let (found, accuracy) = series(fidelity);
            println!("{preset} {fidelity}: {accuracy:?} {found:?}");
            assert_eq!(accuracy.asked, fidelity.accuracy());
            let stopped_by = if accuracy.stated <= accuracy.asked { StoppedBy::Accuracy } else { StoppedBy::Limit };
            assert_eq!(accuracy.stopped_by, stopped_by, "{preset} {fidelity}: {accuracy:?}");
            assert!(!reached || stopped_by == StoppedBy::Accuracy, "{preset} {fidelity}: {accuracy:?}");
            let greatest = found.iter().chain(&exact).map(|(value, _)| *value).fold(0.0, f64::max);
            for ((found, error), (exact, rest)) in found.iter().zip(&exact) {
                // (The periodic state is among what the greatest is of.)
                assert!(*error <= 1.01 * accuracy.stated * greatest, "{preset} {fidelity}: {found} ± {error}");
                assert!(
                    (found - exact).abs() <= error + rest,
                    "{preset} {fidelity}: {found} ± {error}, {exact} ± {rest}"
                );
            }
        }
    }
    // More than there are grids for; on grids that the scene prescribes there is nothing to refine.
    let problem = problem("plate-crossover", &[]);
    let far = Settings { fidelity: Fidelity::To(1), ..Settings::default() };
    assert_eq!(run(&problem, &far).1.accuracy.stopped_by, StoppedBy::Limit);
    let mut grid = problem.clone();
    grid.numerics.steps_per_cycle = Some(48);
    let (_, ended) = run(&grid, &Settings::default());
    assert_eq!((ended.accuracy.asked, ended.accuracy.stopped_by), (0.0, StoppedBy::Limit));
    // With a budget it begins on coarse grids; cycles that are not exact enough come again on finer ones.
    let mut seen = Vec::new();
    let cancel = Cancel::new().with_budget(|| || false);
    let fine = Settings { fidelity: Fidelity::to(1e-4), ..Settings::default() };
    let ended = startup(&problem, &fine, &mut |cycle| seen.push(cycle.number), &cancel).unwrap();
    assert!(seen.len() > ended.cycles && seen.iter().max() == Some(&ended.cycles), "{seen:?}");
    assert_eq!((ended.status, ended.accuracy.stopped_by), (Status::Converged, StoppedBy::Accuracy), "{ended:?}");
    // With a budget that is spent at once there is the whole way, on coarse grids.
    let cancel = Cancel::new().with_budget(|| || true);
    let ended = startup(&problem, &fine, &mut |_| (), &cancel).unwrap();
    assert_eq!((ended.status, ended.accuracy.stopped_by), (Status::Converged, StoppedBy::Budget));
    assert!(ended.accuracy.stated > ended.accuracy.asked, "{ended:?}");
}

#[test]
fn a_compliance_that_does_not_cover_the_wave_is_told() {
    let mut problem = problem("fundamental", &[]);
    let Scenario::Motor(motor) = &mut problem.scenario else { panic!("a motor") };
    let wave = std::f64::consts::TAU / motor.wavelength();
    motor.rotor = RotorCompliance::Table(vec![(3.0 * wave, 4e-10), (40.0 * wave, 1e-10)]);
    let told = motor.compliance_not_covered();
    assert!(told.is_some());
    let (_, ended) = run(&problem, &Settings { fidelity: Fidelity::Draft, cycles: 2, ..Settings::default() });
    assert_eq!(ended.warnings, told.into_iter().collect::<Vec<_>>());
}

#[test]
fn a_start_up_names_the_limits_that_its_solve_does() {
    for (preset, set) in [("fundamental", &[][..]), ("plate-crossover", &[("film.slip", "none")])] {
        let problem = problem(preset, set);
        let (_, ended) = run(&problem, &Settings { fidelity: Fidelity::Draft, cycles: 3, ..Settings::default() });
        let solution = solve(&problem, &solve::Settings::default(), &mut (), &Cancel::new()).unwrap();
        let (found, known) = (validity(&problem, &ended), outside(&problem, &solution));
        assert!(names(&found) == names(&known) && !known.is_empty(), "{found:?} {known:?}");
    }
}

#[test]
fn the_heights_of_a_fall_are_as_exact_as_they_say() {
    // The ring is thrown up to where hardly any film is left, and what there is leaks at once.
    let ring = [
        ("plate.amplitude_um", "4.8475"),
        ("plate.frequency_khz", "3.5849"),
        ("plate.mass_g", "915.93"),
        ("film.slip", "none"),
        ("plate.shape", "ring"),
        ("plate.radius_mm", "5.2991"),
        ("plate.inner_radius_mm", "2.3889"),
    ];
    for (set, cycles) in [(&[][..], 60), (&ring, 20)] {
        let problem = problem("floating-disc", set);
        let [draft, fine] = [Fidelity::Draft, Fidelity::Fine].map(|fidelity| {
            let mut found = Vec::new();
            fall(&problem, fidelity, cycles, 1e-3, &mut |cycle| found.push(cycle.height), &Cancel::new()).unwrap();
            found
        });
        assert!(draft[0].error > 0.0);
        for (cycle, (draft, fine)) in draft.iter().zip(&fine).enumerate() {
            assert!((draft.value - fine.value).abs() < draft.error + fine.error, "{cycle}: {draft:?} {fine:?}");
            assert!(draft.error < 0.02 * draft.value, "{cycle}: {draft:?}");
        }
    }
}

#[test]
fn a_fall_ends_where_its_height_is_no_longer_resolved() {
    let problem = problem("floating-disc", &[("plate.mass_g", "2000")]);
    let mut heights = Vec::new();
    let each = &mut |cycle: squeezefilm::fall::Cycle| heights.push(cycle.height);
    let ended = fall(&problem, Fidelity::Draft, 5000, 1e-3, each, &Cancel::new()).unwrap().unwrap();
    let (last, before) = heights.split_last().unwrap();
    println!("{} cycles, {last}", ended.cycles);
    assert!(matches!(ended.status, Status::NotResolved { .. }) && last.error > 0.5 * last.value, "{ended:?}");
    assert!(before.iter().all(|height| height.error <= 0.5 * height.value));
}

#[test]
fn a_fall_within_a_budget_ends_when_that_is_spent() {
    let problem = problem("floating-disc", &[]);
    let cancel = Cancel::new().with_budget(|| || true);
    let ended = fall(&problem, Fidelity::Draft, 5000, 1e-3, &mut |_| (), &cancel).unwrap().unwrap();
    assert!(matches!(ended.status, Status::NotConverged { .. }) && ended.cycles == 1, "{ended:?}");
}

#[test]
fn a_plate_that_rests_is_planned_and_judged_where_it_does() {
    // Trapped gas would carry it at half a nanometre, where a grid takes gigabytes.
    let problem = problem("floating-disc", &[("plate.mass_g", "100000")]);
    let ended = fall(&problem, Fidelity::Draft, 3, 1e-3, &mut |_| (), &Cancel::new()).unwrap().unwrap();
    assert!(ended.floats.is_err());
    let limits = squeezefilm::export::fall::validity(&problem, &ended, &[]);
    let slip = limits.iter().find(|limit| limit.text.starts_with("At Kn")).unwrap();
    assert!(slip.text.contains("in a film of 200 nm"), "{limits:?}");
    // One that is thrown up is judged where it is highest.
    let at = |height| squeezefilm::fall::Cycle {
        number: 0,
        time: 0.0,
        height: Estimate::exact(height),
        speed: 0.0,
        rests: false,
    };
    let thrown = squeezefilm::export::fall::validity(&problem, &ended, &[at(3e-6), at(3e-4), at(1e-6)]);
    assert!(thrown.iter().any(|limit| limit.name == "gas-inertia" && limit.value > 10.0), "{thrown:?}");
}

#[test]
fn extremes_of_a_rectangle_that_starts_have_the_error_of_the_nodes_across() {
    let set = [
        ("plate.mean_gap_um", "9.48415"),
        ("plate.amplitude_um", "3.3635"),
        ("plate.length_mm", "0.872164"),
        ("plate.width_mm", "5.34707"),
        ("plate.frequency_khz", "0.235303"),
        ("film.slip", "second-order"),
    ];
    let problem = problem("plate-crossover", &set);
    let [draft, fine] = [Fidelity::Draft, Fidelity::Fine].map(|fidelity| {
        let (cycles, _) = run(&problem, &Settings { fidelity, ..Settings::default() });
        let Outcome::Plate(result) = cycles[0].outcome else { panic!("a plate") };
        [result.film_load_min, result.film_load_max, result.max_pressure]
    });
    for (draft, fine) in draft.into_iter().zip(fine) {
        println!("{draft}, {fine}");
        assert!((draft.value - fine.value).abs() < draft.error + fine.error, "{draft} {fine}");
        assert!(draft.error < 0.05 * fine.value.abs(), "{draft} {fine}");
    }
}

#[test]
fn a_start_up_has_the_doubt_that_a_solve_has_in_what_grids_tell() {
    let problem = problem("fundamental", &[]);
    let Scenario::Motor(motor) = &problem.scenario else { panic!("a motor") };
    let plan = Plan::motor(motor, Fidelity::Draft, &problem.numerics).unwrap();
    let error = |doubt: f64| {
        let plan = Plan { irregular: doubt * plan.irregular, ..plan.clone() };
        let mut transient = MotorTransient::at_rest(motor, &plan, 0.0).unwrap();
        let cycle = transient.cycle(&mut Stats::default(), &Cancel::new()).unwrap().unwrap();
        main_number(&problem, &cycle.outcome).1
    };
    // What else is in the error stays as it is.
    let [usual, twice, thrice] = [1.0, 2.0, 3.0].map(error);
    println!("{usual} {twice} {thrice}");
    assert!(twice > 1.3 * usual && ((thrice - twice) / (twice - usual) - 1.0).abs() < 1e-9);
}
