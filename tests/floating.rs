//! Plates, round ones and ones that float, against exact results: trapped gas, small amplitudes, the viscous film; and against solves at the
//! gap that was found.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod scenes;

use squeezefilm::analysis::exact::ExactComparison;
use squeezefilm::analysis::quantity::Quantity;
use squeezefilm::analysis::sweep::Sweep;
use squeezefilm::control::Cancel;
use squeezefilm::estimate::Estimate;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::problem::{GRAVITY, Plate, Problem, Scenario};
use squeezefilm::scene::{Scene, presets};
use squeezefilm::solution::{Floating, Outcome, PlateResult, Solution, Status, StoppedBy, settled};
use squeezefilm::solve::{Settings, SolveError, solve};
use std::sync::atomic::{AtomicUsize, Ordering};

const DISC: &[(&str, &str)] = &[("plate.shape", "disc"), ("plate.radius_mm", "1")];
const RECTANGLE: &[(&str, &str)] = &[("plate.width_mm", "0.7")];
const RING: &[(&str, &str)] = &[("plate.shape", "ring"), ("plate.radius_mm", "1"), ("plate.inner_radius_mm", "0.4")];

fn scene(preset: &str, set: &[&[(&str, &str)]]) -> Scene {
    scenes::scene(preset, &set.concat())
}

fn solved(scene: &Scene, fidelity: Fidelity) -> (Problem, Result<Solution, SolveError>) {
    let problem = Problem::try_from(scene).unwrap();
    let settings = Settings { fidelity, ..Settings::default() };
    let solution = solve(&problem, &settings, &mut (), &Cancel::new());
    let problem = solution.as_ref().map_or_else(|_| problem.clone(), |s| settled(&problem, &s.outcome).into_owned());
    (problem, solution)
}

fn found(preset: &str, set: &[&[(&str, &str)]], fidelity: Fidelity) -> (Plate, PlateResult, Solution) {
    let (problem, solution) = solved(&scene(preset, set), fidelity);
    let solution = solution.unwrap();
    assert_eq!(solution.status, Status::Converged, "{preset} {set:?}");
    (problem.scenario.plate().unwrap().clone(), *solution.outcome.plate().unwrap(), solution)
}

fn compared(preset: &str, set: &[&[(&str, &str)]], fidelity: Fidelity) -> ExactComparison {
    let (plate, result, solution) = found(preset, set, fidelity);
    ExactComparison::of(&plate, &result, &solution.recording)
}

// ---- held films

#[test]
fn small_amplitudes_lie_on_the_linear_curves() {
    for shape in [DISC, RING, RECTANGLE, &[]] {
        for frequency in ["0.3", "30", "3000"] {
            for slip in ["none", "second-order", "fukui-kaneko"] {
                let set = [("plate.amplitude_um", "0.001"), ("plate.frequency_khz", frequency), ("film.slip", slip)];
                let exact = compared("plate-crossover", &[shape, &set], Fidelity::Fine);
                let solved = exact.solved.unwrap();
                for (part, known) in [(solved.spring, exact.linear.spring), (solved.damping, exact.linear.damping)] {
                    let told = format!("{shape:?} {frequency} kHz {slip}: {part:?}, exact {known}");
                    println!("{told}");
                    // The amplitude itself changes them by its square.
                    assert!((part.value - known).abs() < part.error + 3e-6, "{told}");
                    assert!(part.error < 2e-3, "{told}");
                }
            }
        }
    }
}

#[test]
fn plates_have_both_limits_and_the_invariant() {
    for shape in [DISC, RING, RECTANGLE, &[]] {
        let slow = [("plate.frequency_khz", "0.001"), ("film.slip", "none"), ("plate.mean_gap_um", "2")];
        let (plate, _, solution) = found("plate-viscous", &[shape, &slow], Fidelity::Fine);
        let exact = compared("plate-viscous", &[shape, &slow], Fidelity::Fine);
        let greatest = exact.viscous.iter().fold(0.0f64, |most, load| most.max(load.abs()));
        for (load, viscous) in solution.recording.film_load.iter().zip(&exact.viscous) {
            assert!((load - viscous).abs() < 0.01 * greatest, "{shape:?}: {load} {viscous} of {greatest}");
        }
        // Reynolds' disc, in his own words: F = 3πμR⁴V/(2h³).
        if shape == DISC {
            let speed = std::f64::consts::TAU * plate.frequency * plate.amplitude;
            let reynolds = 1.5 * std::f64::consts::PI * plate.gas.viscosity * plate.radius().powi(4) * speed
                / plate.mean_gap.powi(3);
            let quarter = solution.recording.film_load[solution.recording.frames / 4];
            assert!((quarter / reynolds - 1.0).abs() < 0.01, "{quarter} {reynolds}");
        }
        for slip in ["none", "first-order"] {
            let set = [("plate.frequency_khz", "3000"), ("film.slip", slip)];
            let (plate, result, solution) = found("plate-crossover", &[shape, &set], Fidelity::Fine);
            let exact = ExactComparison::of(&plate, &result, &solution.recording);
            // The layer at the edges leaks a share of its thickness, σ to the power −1/2.
            let layer = 6.0 / exact.effective_squeeze_number.sqrt();
            let greatest = exact.boyle.iter().fold(0.0f64, |most, load| most.max(load.abs()));
            for (load, boyle) in solution.recording.film_load.iter().zip(&exact.boyle) {
                assert!((load - boyle).abs() < layer * greatest, "{shape:?} {slip}: {load} {boyle} of {greatest}");
            }
            let ratio = exact.mean_pressure.value / exact.trapped_mean_pressure;
            assert!((ratio - 1.0).abs() < layer && layer < 0.2, "{shape:?} {slip}: {ratio} {layer}");
            // As that of a strip, whose edge layers are as thin.
            let strip = compared("plate-crossover", &[&set], Fidelity::Fine).invariant_deviation.unwrap();
            assert!(exact.invariant_deviation.unwrap() < 1.5 * strip, "{shape:?} {slip}: {exact:?} {strip}");
        }
        // What is stated covers what a finer solve finds.
        let draft = found("plate-crossover", &[shape], Fidelity::Draft).1;
        let fine = found("plate-crossover", &[shape], Fidelity::Reference).1;
        let off = (draft.film_load.value - fine.film_load.value).abs();
        assert!(off < draft.film_load.error + fine.film_load.error, "{shape:?}: {draft:?} {fine:?}");
    }
}

#[test]
fn the_invariant_holds_at_every_point_for_every_law() {
    for (slip, most) in [("none", 1e-4), ("first-order", 1e-4), ("second-order", 2e-3), ("fukui-kaneko", 2e-3)] {
        let set = [("film.slip", slip), ("plate.width_mm", "0.5")];
        let (plate, result, mut solution) = found("plate-crossover", &[&set], Fidelity::Fine);
        let deviation = |solution: &Solution| {
            ExactComparison::of(&plate, &result, &solution.recording).invariant_deviation.unwrap()
        };
        assert!(deviation(&solution) < most, "{slip}");
        // It sees a film that is wrong by a tenth at one point.
        let size = solution.recording.map_x.len() * solution.recording.map_y.len();
        for map in solution.recording.pressure.chunks_exact_mut(size) {
            map[0] *= 1.1;
        }
        assert!(deviation(&solution) > 0.05, "{slip}");
    }
}

#[test]
fn a_plate_at_rest_has_no_harmonic() {
    let found = compared("plate-crossover", &[&[("plate.amplitude_um", "0")]], Fidelity::Fine);
    assert_eq!(found.solved, None);
    assert!((found.trapped_mean_pressure - 1.0).abs() < 1e-12 && found.invariant_deviation.unwrap() < 1e-9);
}

#[test]
fn a_thin_ring_is_a_strip_bent_round() {
    let ring = [("plate.shape", "ring"), ("plate.radius_mm", "50"), ("plate.inner_radius_mm", "49")];
    let (plate, ring, _) = found("plate-crossover", &[&ring], Fidelity::Fine);
    let strip = found("plate-crossover", &[], Fidelity::Fine).1;
    let circumference = std::f64::consts::TAU * (plate.radius() - 0.5e-3);
    assert!((ring.film_load.value / circumference / strip.film_load.value - 1.0).abs() < 1e-3, "{ring:?} {strip:?}");
}

// ---- floating

#[test]
fn trapped_gas_carries_at_the_exact_gap() {
    // h = a √((s + 3/2)/(s − 1)), s = (1 + F/(p_a A))², from (1 + F/(p_a A))² = (1 + 3ε²/2)/(1 − ε²); at a squeeze number of 10⁶ and more.
    for (load, shape) in [("0.3", DISC), ("0.01", DISC), ("0.1", RING), ("20", &[][..])] {
        let set = [
            ("plate.load_n", load),
            ("plate.frequency_khz", "10000"),
            ("film.viscosity_upa_s", "900"),
            ("film.min_spacing_nm", "5"),
            ("film.slip", "none"),
        ];
        let (plate, result, _) = found("plate-trapped", &[shape, &set], Fidelity::Fine);
        let floating = result.floating.unwrap();
        let ratio = 1.0 + result.film_load.value / (plate.gas.ambient_pressure * plate.area());
        // Langlois: the mean pressure over ambient.
        let pressure = |gap: f64| {
            let square = (plate.amplitude / gap).powi(2);
            ((1.0 + 1.5 * square) / (1.0 - square)).sqrt()
        };
        let exact = pressure(plate.mean_gap);
        println!("{load} N: {:?}, trapped {}", floating.mean_gap, plate.trapped_gap(load.parse().unwrap()));
        assert!((ratio / exact - 1.0).abs() < 2e-3 * (exact - 1.0) + 1e-3 * (ratio - 1.0), "{load}: {ratio} {exact}");
        let trapped = plate.trapped_gap(load.parse().unwrap());
        assert!((plate.mean_gap / trapped - 1.0).abs() < 2e-3, "{load}: {} {trapped}", plate.mean_gap);
        // dF/dh of the same law, by its difference.
        let force = |gap: f64| pressure(gap) * plate.gas.ambient_pressure * plate.area();
        let step = 1e-4 * plate.mean_gap;
        let stiffness = (force(plate.mean_gap - step) - force(plate.mean_gap + step)) / (2.0 * step);
        let off = (floating.stiffness.value - stiffness).abs();
        assert!(off < floating.stiffness.error + 2e-3 * stiffness, "{load}: {:?} {stiffness}", floating.stiffness);
    }
    // A small load: a √(1.25 p_a A/F).
    let (plate, ..) = found("plate-trapped", &[DISC, &[("plate.load_n", "0.1")]], Fidelity::Draft);
    let load = 1e-4 * plate.gas.ambient_pressure * plate.area();
    let small = plate.amplitude * (1.25e4f64).sqrt();
    assert!((plate.trapped_gap(load) / small - 1.0).abs() < 1e-3);
}

#[test]
fn a_published_height_fits_its_amplitude_from_peak_to_peak() {
    // 5.5 µm under 4.9 N, and 9.8 N carried, at 800 Hz and "3 µm" (report of the grant KAKENHI 09750163, 1998), which may be from peak to peak.
    let gap = |load: &str, amplitude: &str| {
        let set = [
            ("plate.radius_mm", "15"),
            ("plate.load_n", load),
            ("plate.amplitude_um", amplitude),
            ("plate.frequency_khz", "0.8"),
        ];
        found("floating-disc", &[&set], Fidelity::Fine).0.mean_gap * 1e6
    };
    let (peak_to_peak, zero_to_peak) = (gap("4.9", "1.5"), gap("4.9", "3"));
    println!("{peak_to_peak} {zero_to_peak}");
    // The first within a tenth; the report's second pad and the object's own vibration are left out.
    assert!((peak_to_peak / 5.5 - 1.0).abs() < 0.1 && zero_to_peak > 5.5);
    assert!(gap("9.8", "1.5") > 1.5 && gap("9.8", "3") > 3.0);
}

#[test]
fn the_film_carries_the_load_at_the_gap_that_is_found() {
    for (preset, set) in [
        ("floating-disc", &[][..]),
        ("floating-finger-pad", &[]),
        ("plate-crossover", &[("plate.load_n", "20")]),
        ("plate-viscous", &[("plate.load_n", "0.05")]),
        ("plate-mems", &[("plate.mass_g", "20"), ("plate.amplitude_um", "1")]),
        ("plate-crossover", &[("plate.load_n", "0.001"), ("plate.width_mm", "0.3")]),
    ] {
        let mut given = scene(preset, &[set]);
        let (draft, ..) = found(preset, &[set], Fidelity::Draft);
        let (plate, result, solution) = found(preset, &[set], Fidelity::Standard);
        let floating = result.floating.unwrap();
        let (load, Estimate { value: gap, error }) = (plate.load.unwrap(), floating.mean_gap);
        println!("{preset}: {gap:e} ± {error:e}, load {load} {result:?}, {:?}", solution.stats);
        assert!((result.film_load.value - load).abs() < 2e-3 * load && floating.stiffness.value > 0.0);
        assert!(error < 0.01 * gap && solution.accuracy.stated <= solution.accuracy.asked, "{:?}", solution.accuracy);
        assert!((draft.mean_gap / gap - 1.0).abs() < 0.05, "{preset}: {} {gap}", draft.mean_gap);
        // The gap given, and solved more exactly, carries the load within the error that is stated of the gap.
        given.set("plate.mean_gap_um", &(gap * 1e6).to_string()).unwrap();
        let (_, again) = solved(&given, Fidelity::Fine);
        let Outcome::Plate(fine) = again.unwrap().outcome else { panic!("a plate") };
        let off = (fine.film_load.value - load).abs() - fine.film_load.error;
        assert!(off < error * floating.stiffness.value, "{preset}: {fine:?} {load}");
        // Stiffness as the difference of two given gaps.
        let at = |share: f64| {
            let near = given.with([("plate.mean_gap_um", (gap * share * 1e6).to_string())]).unwrap();
            solved(&near, Fidelity::Reference).1.unwrap().outcome.plate().unwrap().film_load.value
        };
        let away = 0.02 * (gap - plate.amplitude) / gap;
        let stiffness = (at(1.0 - away) - at(1.0 + away)) / (2.0 * away * gap);
        let stated = floating.stiffness;
        assert!((stated.value - stiffness).abs() < stated.error + 0.01 * stiffness, "{preset}: {stated:?} {stiffness}");
        let natural = (stated.value * GRAVITY / load).sqrt() / std::f64::consts::TAU;
        assert!((floating.natural_frequency.value / natural - 1.0).abs() < 1e-12);
    }
}

#[test]
fn what_the_gap_is_off_by_is_in_all_errors_there() {
    let off_damping = "plate.shape=disc plate.radius_mm=0.4352 plate.frequency_khz=43.73 plate.amplitude_um=6.037 plate.load_n=7.922e-05 \
        film.min_spacing_nm=5.953 film.slip=fukui-kaneko film.accommodation=0.3406 film.viscosity_upa_s=21.81 \
        film.mean_free_path_nm=111.4 film.ambient_pressure_kpa=241.1";
    let off_pressure = "plate.shape=disc plate.radius_mm=5.183 plate.frequency_khz=10.24 plate.amplitude_um=19.81 plate.load_n=9.676 \
        film.min_spacing_nm=209.1 film.slip=second-order film.gas=air film.temperature_c=33.8 film.altitude_m=1.316e4";
    for set in [off_damping, off_pressure] {
        let set: Vec<_> = set.split(' ').filter_map(|change| change.split_once('=')).collect();
        let [standard, reference] = [Fidelity::Standard, Fidelity::Reference].map(|fidelity| {
            let (plate, result, solution) = found("plate-crossover", &[&set], fidelity);
            let film = ExactComparison::of(&plate, &result, &solution.recording).stiffness_and_damping().unwrap();
            let Floating { mean_gap, stiffness, slow, .. } = result.floating.unwrap();
            let extremes = [result.film_load_min, result.film_load_max, result.max_pressure];
            let slow = slow.map_or(Estimate::default(), |slow| slow.damping);
            [mean_gap, stiffness, slow, film.spring, film.damping, extremes[0], extremes[1], extremes[2]]
        });
        for (standard, reference) in standard.into_iter().zip(reference) {
            println!("{standard} {reference}");
            let off = (standard.value - reference.value).abs();
            assert!(off <= standard.error + reference.error, "{standard:?} {reference:?}");
        }
    }
}

/// What a budget gives that is spent after so many looks at it.
fn hurried(problem: &Problem, looks: usize) -> (PlateResult, Solution) {
    let settings = Settings { fidelity: Fidelity::Reference, ..Settings::default() };
    let cancel = Cancel::new().with_budget(move || {
        let looked = AtomicUsize::new(0);
        move || looked.fetch_add(1, Ordering::Relaxed) >= looks
    });
    let solution = solve(problem, &settings, &mut (), &cancel).unwrap();
    let Outcome::Plate(result) = solution.outcome else { panic!("a plate") };
    (result, solution)
}

#[test]
fn a_budget_that_is_spent_leaves_the_gap_within_its_error() {
    // The gap of trapped gas, from which the search begins, is far off: these films leak. The second just floats above its roughness.
    let thin = "plate.shape=ring plate.radius_mm=2.048 plate.inner_radius_mm=1.915 plate.frequency_khz=2.704 plate.amplitude_um=2.582 \
        plate.load_n=0.005918 film.min_spacing_nm=16.15";
    let rough = thin.replace("16.15", "225.6");
    let slow = "plate.shape=ring plate.radius_mm=1.902 plate.inner_radius_mm=1.536 plate.frequency_khz=0.2504 plate.amplitude_um=2.48 \
        plate.load_n=0.01097 film.min_spacing_nm=23.81 film.slip=fukui-kaneko film.accommodation=0.4374";
    let narrow = "plate.shape=rectangle plate.length_mm=17.5 plate.width_mm=6.328 plate.frequency_khz=10.09 plate.amplitude_um=1.723 \
        plate.load_n=0.001136 film.min_spacing_nm=50.58 film.slip=none";
    for set in [thin, &rough, slow, narrow] {
        let set: Vec<_> = set.split(' ').filter_map(|change| change.split_once('=')).collect();
        let problem = scenes::problem("plate-crossover", &set);
        let reference = found("plate-crossover", &[&set], Fidelity::Reference).1.floating.unwrap();
        assert!(reference.is_stable(), "{reference:?}");
        for looks in [0, 1, 30, 300, 1000, 3000, 10_000] {
            let (result, solution) = hurried(&problem, looks);
            let (floating, load) = (result.floating.unwrap(), result.film_load);
            println!("{looks}: {} {} {load} {:?}", floating.mean_gap, floating.stiffness, solution.accuracy);
            for (early, late) in [(floating.mean_gap, reference.mean_gap), (floating.stiffness, reference.stiffness)] {
                let off = (early.value - late.value).abs();
                assert!(off <= early.error + late.error, "{set:?} {looks}: {early:?} {late:?}");
            }
            assert!(floating.mean_gap.error < 0.5 * floating.mean_gap.value, "{set:?} {looks}: {floating:?}");
            // It is where the film of these grids carries the load.
            let Scenario::Plate(Plate { load: Some(asked), .. }) = problem.scenario else { panic!("a load") };
            assert!((load.value - asked).abs() < 0.02 * asked, "{set:?} {looks}: {load:?}");
            let unstable = solution.warnings.iter().any(|warning| warning.starts_with("not stable"));
            assert!(!unstable, "{set:?} {looks}: {floating:?}");
        }
        let (_, solution) = hurried(&problem, 0);
        assert_eq!(solution.accuracy.stopped_by, StoppedBy::Budget, "{set:?}");
    }
}

#[test]
fn a_stiffness_that_may_be_none_leaves_stability_open() {
    let of = |value: f64, error: f64| {
        let floating = Floating { stiffness: Estimate { value, error }, ..Floating::default() };
        assert_eq!(floating.is_stable(), floating.stability() == Some(true));
        floating.stability()
    };
    assert_eq!([of(2.0, 1.0), of(-2.0, 1.0)], [Some(true), Some(false)]);
    assert_eq!([of(1.0, 2.0), of(-1.0, 2.0), of(1.0, f64::INFINITY), of(f64::NAN, 1.0)], [None; 4]);
}

#[test]
fn a_load_that_no_film_carries_is_refused_with_the_amplitude_it_needs() {
    let with = |amplitude: &str, load: &str| {
        let set = [("plate.amplitude_um", amplitude), ("plate.load_n", load)];
        solved(&scene("floating-disc", &[&set]), Fidelity::Draft).1
    };
    let error = with("0.01", "5").unwrap_err().to_string();
    println!("{error}");
    let needed: f64 = error.split("about ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!(
        error.contains("does not float: it would with an amplitude of about ")
            && error.ends_with(" % of the load")
            && (0.05..0.2).contains(&needed),
        "{error}"
    );
    assert!(with(&(1.01 * needed).to_string(), "5").is_ok());
    assert!(with(&(0.9 * needed).to_string(), "5").unwrap_err().to_string().contains("does not float"));
    assert!(with("0", "5").unwrap_err().to_string().contains("about "));
    // With a large one gas leaves again: it floats from about 30 µm to less than 60.
    for too_large in ["60", "300"] {
        let error = with(too_large, "196").unwrap_err().to_string();
        let needed: f64 = error.split("about ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        assert!((25.0..32.0).contains(&needed), "{error}");
        assert!(with(&(1.02 * needed).to_string(), "196").is_ok(), "{needed}");
    }
    // A strip that is 16 µm long carries next to nothing at the first amplitudes that are tried.
    let narrow = |amplitude: &str| {
        let plate = [("plate.length_mm", "0.01607"), ("plate.load_n", "7e-6"), ("plate.frequency_khz", "5.308")];
        let gas = [
            ("film.ambient_pressure_kpa", "374.7"),
            ("film.mean_free_path_nm", "313.2"),
            ("film.slip", "fukui-kaneko"),
        ];
        let set = [("plate.amplitude_um", amplitude)];
        solved(&scene("plate-crossover", &[&plate, &gas, &set]), Fidelity::Draft).1
    };
    let error = narrow("0.00725").unwrap_err().to_string();
    let needed: f64 =
        error.split("about ").nth(1).unwrap_or_else(|| panic!("{error}")).split(' ').next().unwrap().parse().unwrap();
    assert!(narrow(&(1.02 * needed).to_string()).is_ok() && narrow(&(0.95 * needed).to_string()).is_err(), "{needed}");
    // A load that is 10¹⁸ times what ambient pressure would carry, as well.
    for absurd in [&[("plate.load_n", "1e5")][..], &[("plate.load_n", "1e6"), ("plate.radius_mm", "0.001")]] {
        let refused = solved(&scene("floating-disc", &[absurd]), Fidelity::Draft).1.unwrap_err();
        assert!(refused.is_bad_input() && refused.to_string().contains("no amplitude up to 1000 µm"), "{refused}");
    }
    let light = [("plate.radius_mm", "100"), ("plate.amplitude_um", "50"), ("plate.load_n", "1e-6")];
    let error = solved(&scene("floating-disc", &[&light]), Fidelity::Draft).1.unwrap_err().to_string();
    assert!(error.contains("higher than 1000 µm"), "{error}");
}

#[test]
fn two_of_gap_load_and_mass_are_refused_and_one_drops_the_others() {
    let toml = presets::find("floating-disc").unwrap().to_toml();
    for key in ["mean_gap_um = 3.0", "load_n = 1.0"] {
        let both = toml.replace("[plate]\n", &format!("[plate]\n{key}\n"));
        let error = Scene::from_toml(&both, "my.toml").unwrap_err().to_string();
        assert!(error.contains("plate.mass_g") && error.contains(key.split(' ').next().unwrap()), "{error}");
    }
    let mut scene = presets::find("floating-disc").unwrap();
    for (key, others) in [
        ("plate.load_n", ["plate.mass_g", "plate.mean_gap_um"]),
        ("plate.mean_gap_um", ["plate.mass_g", "plate.load_n"]),
        ("plate.mass_g", ["plate.mean_gap_um", "plate.load_n"]),
    ] {
        scene.set_all([(key, "3")]).unwrap();
        assert!(scene.get(key).is_some() && others.iter().all(|other| scene.get(other).is_none()), "{key}");
    }
    // The weight is the mass's.
    let Scenario::Plate(plate) = Problem::try_from(&scene).unwrap().scenario else { panic!("a plate") };
    assert!((plate.load.unwrap() - 3e-3 * GRAVITY).abs() < 1e-15);
    // An amplitude above the default gap is no fault then, and the roughness is heeded.
    scene.set_all([("plate.amplitude_um", "30"), ("film.min_spacing_nm", "500")]).unwrap();
    let error = scene.set_all([("plate.mean_gap_um", "3")]).unwrap_err().to_string();
    assert!(error.contains("plate.amplitude_um"), "{error}");
    let hole = scene.set_all([("plate.shape", "ring"), ("plate.inner_radius_mm", "8")]).unwrap_err().to_string();
    assert!(hole.contains("plate.inner_radius_mm = 8") && hole.contains("0.99"), "{hole}");
}

#[test]
fn a_sweep_of_the_amplitude_follows_the_law() {
    // Far in the trapped regime the height is proportional to the amplitude.
    let scene = scene("floating-disc", &[&[("plate.frequency_khz", "200"), ("film.slip", "none")]]);
    let vary = ["plate.amplitude_um=0.5:2:3".parse().unwrap()];
    let sweep = Sweep::new(&scene, &vary, &Settings { fidelity: Fidelity::Draft, ..Settings::default() }).unwrap();
    for quantity in [Quantity::MeanGap, Quantity::FloatingStiffness, Quantity::SlowDamping, Quantity::CreepTime] {
        assert!(sweep.quantities().contains(&quantity));
    }
    let rows = sweep.run(&[], &Cancel::new(), &|_| ());
    for row in &rows {
        let get = |quantity| row.numbers.get(quantity).unwrap();
        let (gap, error) = (get(Quantity::MeanGap), get(Quantity::MeanGapError));
        let problem = Problem::try_from(&sweep.scene_at(row.point).unwrap()).unwrap();
        let plate = problem.scenario.plate().unwrap();
        let law = plate.trapped_gap(plate.load.unwrap()) * 1e6;
        assert!(get(Quantity::SlowDampingError) < 0.1 * get(Quantity::SlowDamping));
        println!("{:?}: {gap} ± {error}, law {law}", row.values);
        assert!((gap / law - 1.0).abs() < 0.05 && error < 0.02 * gap, "{row:?}");
    }
}
