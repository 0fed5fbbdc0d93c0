//! Fits: values that are known are found again within the errors that are stated, and an optimum is that of a fine sweep.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod program;

use program::{done, err, json, out, refused, run};
use serde_json::Value as Json;
use squeezefilm::analysis::fit::{Bound, Bounds, ErrorSize, Fitted, Goal, Limit, Measured, Optimum, fit, optimise};
use squeezefilm::analysis::quantity::{Numbers, Quantity};
use squeezefilm::analysis::sweep::{Sweep, Vary};
use squeezefilm::control::Cancel;
use squeezefilm::drive::Scaled;
use squeezefilm::export::figure::{Colour, Layer};
use squeezefilm::export::fit::figures;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::problem::{Problem, Scenario, rpm};
use squeezefilm::scene::{Scene, presets};
use squeezefilm::solution::Outcome;
use squeezefilm::solve::{Method, Record, Settings, solve};
use std::fmt::Write as _;
use std::sync::Mutex;

const STANDARD: Settings = Settings { fidelity: Fidelity::Standard, method: Method::Auto, record: Record::Numbers };
const DRAFT: Settings = Settings { fidelity: Fidelity::Draft, ..STANDARD };

fn bounds(vary: &[&str]) -> Vec<Bounds> {
    vary.iter().map(|text| text.parse().unwrap()).collect()
}

fn scene(preset: &str, changes: &[(&str, &str)]) -> Scene {
    presets::find(preset).unwrap().with(changes).unwrap()
}

fn table(scene: &Scene, text: &str) -> Measured {
    Measured::from_csv(text, "table.csv", &Problem::try_from(scene).unwrap()).unwrap()
}

fn fitted(scene: &Scene, vary: &[&str], measured: &Measured, settings: &Settings, starts: usize) -> Fitted {
    fit(scene, &bounds(vary), measured, settings, (starts, &Cancel::new(), &|_, _| ())).unwrap().unwrap()
}

/// Why there is no fit.
fn no_fit(scene: &Scene, vary: &[Bounds], measured: &Measured) -> String {
    fit(scene, vary, measured, &DRAFT, (1, &Cancel::new(), &|_, _| ())).unwrap_err().to_string()
}

/// The greatest (or least) value of a number within limits, by drafts.
fn optimum(scene: &Scene, vary: &[&str], (name, greatest): (&str, bool), limits: &[&str], starts: usize) -> Optimum {
    let limits: Vec<Limit> = limits.iter().map(|limit| limit.parse().unwrap()).collect();
    let goal = Goal::new(scene, name, greatest, &limits).unwrap();
    optimise(scene, &bounds(vary), &goal, &DRAFT, (starts, &Cancel::new(), &|_, _| ())).unwrap().unwrap()
}

/// The film load of a scene with changes.
fn load(scene: &Scene, changes: &[(&str, String)]) -> f64 {
    let scene = scene.with(changes).unwrap();
    let problem = Problem::try_from(&scene).unwrap();
    let solution = solve(&problem, &STANDARD, &mut (), &Cancel::new()).unwrap();
    Numbers::of(&problem, &solution).get(Quantity::FilmLoad).unwrap()
}

/// Normally distributed numbers, the same ones for the same seed.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        // SplitMix64.
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

const FREQUENCIES: [f64; 8] = [3.0, 6.0, 12.0, 20.0, 35.0, 60.0, 100.0, 150.0];
const PLATE: [&str; 2] = ["plate.amplitude_um=0.2:0.8", "film.viscosity_upa_s=8:40"];

/// Loads of a plate over its frequency at an amplitude of 0.5 µm and a viscosity of 18.1 µPa·s, with errors of 1 %.
fn plate_loads(exact: &[f64], seed: u64) -> String {
    let mut noise = Noise(seed);
    let mut text = "plate.frequency_khz,film_load_n,film_load_n_error\n".to_owned();
    for (frequency, exact) in FREQUENCIES.iter().zip(exact) {
        let error = 0.01 * exact;
        writeln!(text, "{frequency},{},{error}", exact + error * noise.next()).unwrap();
    }
    text
}

fn exact_loads() -> Vec<f64> {
    let plate = scene("plate-crossover", &[]);
    FREQUENCIES.iter().map(|frequency| load(&plate, &[("plate.frequency_khz", frequency.to_string())])).collect()
}

#[test]
fn what_is_known_is_found_again_within_the_stated_errors() {
    let exact = exact_loads();
    let start = scene("plate-crossover", &[("plate.amplitude_um", "0.3"), ("film.viscosity_upa_s", "30")]);
    let truth = [0.5, 18.1];
    let (mut within, mut all, mut chi_squared) = (0, 0, 0.0);
    for seed in 0..30 {
        let measured = table(&start, &plate_loads(&exact, seed));
        let found = fitted(&start, &PLATE, &measured, &DRAFT, 1);
        assert!(found.converged && found.errors_known && found.degrees_of_freedom == 6);
        chi_squared += found.chi_squared;
        for (one, truth) in found.unknowns.iter().zip(truth) {
            let off = (one.value - truth) / one.error.unwrap();
            assert!(off.abs() < 4.0, "seed {seed}: {} is off by {off} standard errors", one.unknown.parameter.key);
            within += usize::from(off.abs() < 1.0);
            all += 1;
        }
    }
    // 68 % of 60, give or take 3.6 at one standard deviation.
    assert!((30..=52).contains(&within), "{within} of {all}");
    // Six degrees of freedom in each of 30: 180, give or take 19.
    assert!((120.0..240.0).contains(&chi_squared), "{chi_squared}");
}

#[test]
fn the_numerical_error_of_what_is_computed_counts() {
    // Measured a thousand times as accurately as a draft computes.
    let motor = scene("fundamental", &[]);
    let mut text = "film.ambient_pressure_kpa,film_load_n,film_load_n_error\n".to_owned();
    for pressure in [40.0, 70.0, 100.0, 140.0, 200.0] {
        let load = load(&motor, &[("film.ambient_pressure_kpa", pressure.to_string())]);
        writeln!(text, "{pressure},{load},{}", 1e-6 * load).unwrap();
    }
    let start = scene("fundamental", &[("film.min_spacing_nm", "250"), ("stator.normal_amplitude_um", "1.1")]);
    let vary = ["film.min_spacing_nm=100:400", "stator.normal_amplitude_um=0.8:2"];
    let found = fitted(&start, &vary, &table(&start, &text), &DRAFT, 1);
    let mut beyond_noise = 0.0f64;
    for (k, truth) in [200.0, 1.3].into_iter().enumerate() {
        let (one, noise) = (&found.unknowns[k], found.covariance[k][k].sqrt());
        let off = (one.value - truth).abs();
        assert!(off < one.error.unwrap(), "{}: {off}, {noise}", one.unknown.parameter.key);
        beyond_noise = beyond_noise.max(off / noise);
    }
    assert!(beyond_noise > 4.0, "{beyond_noise}");
}

#[test]
fn errors_that_are_not_given_follow_from_the_residuals() {
    let exact = exact_loads();
    let start = scene("plate-crossover", &[]);
    let text = plate_loads(&exact, 1);
    let given = fitted(&start, &PLATE, &table(&start, &text), &DRAFT, 1);
    // The same table with relative weights in place of errors.
    let mut weights = "plate.frequency_khz,film_load_n,weight\n".to_owned();
    for line in text.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        writeln!(weights, "{},{},{}", cells[0], cells[1], 1.0 / (cells[2] * cells[2])).unwrap();
    }
    let estimated = fitted(&start, &PLATE, &table(&start, &weights), &DRAFT, 1);
    assert!(!estimated.errors_known);
    let scale = (given.chi_squared / 6.0).sqrt();
    for (given, estimated) in given.unknowns.iter().zip(&estimated.unknowns) {
        assert!((given.value / estimated.value - 1.0).abs() < 1e-3, "{given:?} {estimated:?}");
        let ratio = estimated.error.unwrap() / given.error.unwrap();
        assert!((ratio / scale - 1.0).abs() < 0.05, "{ratio} {scale}");
    }
    let sum: f64 = estimated.rows.iter().map(|row| row.residual.unwrap().powi(2)).sum();
    assert!((sum - 6.0).abs() < 1e-9, "{sum}");
}

#[test]
fn a_bound_in_the_way_is_told() {
    let start = scene("plate-crossover", &[]);
    let measured = table(&start, &plate_loads(&exact_loads(), 2));
    let found = fitted(&start, &["film.viscosity_upa_s=25:400", PLATE[0]], &measured, &DRAFT, 1);
    let viscosity = &found.unknowns[0];
    assert_eq!((viscosity.at, viscosity.value, viscosity.error), (Some(Bound::Lower), 25.0, None));
    assert!(found.unknowns[1].error.is_some() && found.degrees_of_freedom == 7);
    assert!(found.warnings.iter().any(|text| text.starts_with("film.viscosity_upa_s is at its lower bound, 25 µPa·s")));
}

#[test]
fn residuals_of_several_results_of_a_line_are_named() {
    let start = scene("plate-crossover", &[]);
    let labels = |text: &str| {
        let measured = table(&start, text);
        let found = fitted(&start, &["plate.amplitude_um=0.3:0.7"], &measured, &DRAFT, 1);
        let figures = figures(&Problem::try_from(&start).unwrap(), &found, &measured);
        let (_, residuals) = figures.into_iter().find(|(name, _)| *name == "residuals").unwrap();
        residuals.panels[0].y.names.iter().map(|(_, name)| name.clone()).collect::<Vec<_>>()
    };
    let both = labels("film_load_n,mean_load_ratio\n20.265,0.21\n");
    assert_eq!(both, ["line 2, film_load_n", "line 2, mean_load_ratio"]);
    assert_eq!(labels("film_load_n\n20.265\n20.3\n"), ["line 2", "line 3"]);
}

#[test]
fn what_cannot_be_told_apart_is_told() {
    let start = scene("plate-crossover", &[]);
    let amplitudes =
        [0.2, 0.4, 0.6].map(|amplitude| (amplitude, load(&start, &[("plate.amplitude_um", format!("{amplitude}"))])));
    let rows = amplitudes.map(|(amplitude, load)| format!("{amplitude},{load}\n")).concat();
    let measured = table(&start, &format!("plate.amplitude_um,film_load_n\n{rows}"));
    // The film knows the squeeze number, which is proportional to their product.
    let found = fitted(&start, &["film.viscosity_upa_s=8:40", "plate.frequency_khz=0.3:3"], &measured, &DRAFT, 1);
    let told = "the measurements do not determine film.viscosity_upa_s and plate.frequency_khz";
    assert!(found.warnings.iter().any(|text| text.starts_with(told)), "{found:?}");
    assert_eq!(found.unknowns[0].error, None);
}

#[test]
fn a_length_of_a_part_of_a_ring_is_found_again() {
    let ring = scene("ring-rotor", &[]);
    let top = "rotor.part.flange.z_top_mm";
    let film = load(&ring, &[(top, "1.25".to_owned())]);
    let measured = table(&ring, &format!("film_load_n\n{film}\n"));
    let found = fitted(&ring, &[&format!("{top}=1.1:1.4")], &measured, &STANDARD, 1);
    println!("{:?}, {} solves", found.unknowns[0], found.solves);
    assert!(found.converged && (found.unknowns[0].value - 1.25).abs() < 2e-3, "{:?}", found.unknowns[0]);
}

#[test]
fn several_starts_find_the_same_minimum() {
    let start = scene("plate-crossover", &[("plate.amplitude_um", "0.21"), ("film.viscosity_upa_s", "39")]);
    let measured = table(&start, &plate_loads(&exact_loads(), 3));
    let found = fitted(&start, &PLATE, &measured, &DRAFT, 20);
    assert_eq!(found.minima.iter().map(|minimum| minimum.starts).sum::<usize>(), 4);
    assert!((found.unknowns[0].value - 0.5).abs() < 4.0 * found.unknowns[0].error.unwrap());
    assert_eq!(found.scene.get("plate.amplitude_um").unwrap().as_number(), Some(found.unknowns[0].value));
    assert!(found.scene.name.ends_with(", fitted"), "{}", found.scene.name);
}

#[test]
fn rows_of_one_condition_share_a_solve() {
    let motor = scene("fundamental", &[]);
    let problem = Problem::try_from(&motor).unwrap();
    let solution = solve(&problem, &Settings { record: Record::Everything, ..DRAFT }, &mut (), &Cancel::new()).unwrap();
    let (Scenario::Motor(of), Outcome::Motor(result)) = (&problem.scenario, &solution.outcome) else { panic!() };
    let speeds: Vec<f64> = (0..10).map(|i| 0.1 * f64::from(i) * of.stator_speed()).collect();
    let curve = Scaled::with_film(of, result, &solution.recording).performance(&speeds).curve;
    let mut text = "rotor_speed_rpm,torque_nm\n".to_owned();
    let mut noise = Noise(7);
    for point in &curve {
        let torque = point.torque.value + 0.002 * noise.next();
        writeln!(text, "{},{torque}", rpm(point.speed, of.contact_radius)).unwrap();
    }
    let start = scene("fundamental", &[("motor.dry_friction", "0.4"), ("stator.tangential_amplitude_um", "1.4")]);
    let measured = table(&start, &text);
    assert_eq!((measured.conditions.len(), measured.measurements.len()), (1, 10));
    let vary = ["motor.dry_friction=0.1:1", "stator.tangential_amplitude_um=0.3:3"];
    let found = fitted(&start, &vary, &measured, &DRAFT, 1);
    for (one, truth) in found.unknowns.iter().zip([0.7, 1.0]) {
        assert!((one.value - truth).abs() < 4.0 * one.error.unwrap() && one.error.unwrap() < 0.05 * truth, "{one:?}");
    }
    // The curve goes on between the measured speeds, and through what is computed there.
    let curve = &found.curves[0];
    let ends = [0, measured.measurements.len() - 1].map(|i| found.rows[i].computed.as_ref().unwrap().value);
    assert!(curve.len() > 50 && curve.iter().all(|point| point[1].is_finite()), "{curve:?}");
    assert_eq!((curve[0], curve.last().unwrap()[1]), ([0.0, ends[0]], ends[1]));
    // Points of a single condition are black, beside the coloured curve.
    let (_, figure) = figures(&problem, &found, &measured).into_iter().find(|(name, _)| *name == "fit").unwrap();
    let of_points = |layer: &Layer| if let Layer::Points(points) = layer { Some(points.colour) } else { None };
    assert_eq!(figure.panels[0].layers.iter().find_map(of_points), Some(Colour::BLACK));
    // Far less than ten for each point that was tried.
    assert!(found.solves < 150, "{}", found.solves);
}

#[test]
fn a_row_that_cannot_be_solved_is_left_out_and_reported() {
    let start = scene("plate-crossover", &[]);
    // Under this gap the plate of the start would strike.
    let mut text =
        plate_loads(&exact_loads(), 4).replace("_error\n", "_error,plate.mean_gap_um\n").replace('\n', ",\n");
    text = text.replace("plate.mean_gap_um,", "plate.mean_gap_um") + "20,1,0.1,0.55\n";
    let found = fitted(&start, &["plate.amplitude_um=0.56:0.8", PLATE[1]], &table(&start, &text), &DRAFT, 1);
    let last = found.rows.last().unwrap();
    assert!(last.residual.is_none() && last.computed.is_err(), "{last:?}");
    let told = &found.warnings;
    assert!(told.iter().any(|text| text.contains("1 of 9 measurements were left out")), "{told:?}");
    assert!(found.rows[..8].iter().all(|row| row.residual.is_some()));
}

#[test]
fn bad_tables_are_refused_with_line_column_value_and_what_is_allowed() {
    let problem = Problem::try_from(&scene("fundamental", &[])).unwrap();
    for (text, words) in [
        ("film.min_spacing_nm\n100\n", "table.csv:1: no column holds what was measured; allowed: alpha, film_load_n"),
        (
            "film.min_spacing,alpha\n100,0.2\n",
            "table.csv:1: column film.min_spacing: unknown: did you mean film.min_spacing_nm? Allowed: keys of the scene",
        ),
        ("rotor_speed_rpm,torque_mnm\n0,200\n", "column torque_mnm: unknown: did you mean torque_nm?"),
        ("rotor_speed,torque_nm\n0,200\n", "column rotor_speed: unknown: did you mean rotor_speed_rpm?"),
        ("qqq,alpha\n0,0.2\n", "column qqq: unknown; allowed: keys of the scene"),
        ("", "table.csv: no table: expected a line that names the columns, as in rotor_speed_rpm,torque_nm"),
        ("\n\n", "table.csv: no table"),
        ("alpha,alpha\n1,2\n", "table.csv:1: column alpha: given twice"),
        ("# rig 2\nalpha,alpha\n1,2\n", "table.csv:2: column alpha: given twice"),
        ("alpha\n0.2\nhigh\n", "table.csv:3: column alpha: high is not a number"),
        ("alpha\n0.2\ninf\n", "table.csv:3: column alpha: inf is not a number"),
        ("alpha\n0.2\n\n# hot\nhigh\n", "table.csv:5: column alpha: high is not a number"),
        ("alpha\n# hot\n0.2,100\n", "table.csv:3: 2 cells: expected 1, one for each column"),
        ("alpha,alpha_error\n0.2,0\n", "table.csv:2: column alpha_error: \"0\": expected a number above 0"),
        (
            "alpha,film_load_n,alpha_error\n0.2,0.5,0.1\n",
            "table.csv:1: give the errors of all that was measured, or of none",
        ),
        ("torque_nm\n0.2\n", "table.csv:1: torque_nm needs a column rotor_speed_rpm, the speed of each torque"),
        ("rotor_speed_rpm,alpha\n3,0.2\n", "table.csv:1: rotor_speed_rpm needs a column torque_nm"),
        ("alpha;film.min_spacing_nm\n0,2,1;100\n", "table.csv:2: column alpha: 0,2,1 is not a number"),
        ("torque_nm,rotor_speed_rpm\n0.2,\n", "table.csv:2: column rotor_speed_rpm: empty"),
        ("alpha,weight\n0.2,-1\n", "table.csv:2: column weight: \"-1\": expected a number above 0"),
        ("alpha,mean_load_ratio\n0.2,1\n", "column mean_load_ratio: unknown"),
        ("alpha\n", "table.csv: no measurements"),
        ("alpha,film.min_spacing_nm\n0.2\n", "table.csv:2: 1 cell: expected 2, one for each column"),
        ("alpha\n0.2\n0.2,100\n", "table.csv:3: 2 cells: expected 1, one for each column"),
        ("film_steps\n3\n", "column film_steps: unknown"),
    ] {
        // A line is the same one however lines end.
        for text in [text.to_owned(), text.replace('\n', "\r\n")] {
            let error = Measured::from_csv(&text, "table.csv", &problem).unwrap_err().to_string();
            assert!(error.contains(words), "{text:?}: {error}");
        }
    }
    let motor = scene("fundamental", &[]);
    // As spreadsheets write it where the comma is in decimals.
    let [dots, commas] = ["speed_rpm,torque_nm\n1.5,0.2\n", "speed_rpm;torque_nm\n1,5;0,2\n"];
    assert_eq!(table(&motor, dots).measurements, table(&motor, commas).measurements);
    for tabs in [dots.replace(',', "\t"), commas.replace(';', "\t")] {
        assert_eq!(table(&motor, dots).measurements, table(&motor, &tabs).measurements, "{tabs:?}");
    }
    let measured = table(&motor, "alpha,film.min_spacing_nm\n0.2,100\n0.2,3\n");
    let vary = bounds(&["rotor.decay_length_mm=2:6", "film.min_spacing_nm=100:300"]);
    let error = no_fit(&motor, &vary[..1], &measured);
    assert!(error.contains(", line 3: film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm"), "{error}");
    let measured = table(&motor, "alpha,rotor.decay_length_mm\n0.2,3\n");
    let error = no_fit(&motor, &vary[..1], &measured);
    assert!(error.contains("every line of the table of measurements sets it"), "{error}");
    let one = table(&motor, "alpha\n0.2\n");
    let error = no_fit(&motor, &vary, &one);
    assert!(error.starts_with("measurements: 1, keys varied: 2; give"), "{error}");
    for (size, words) in [
        ("alpha=x", "expected a number above 0"),
        ("film_load_n=1%", "no such number; allowed: alpha"),
        ("-1%", "above 0"),
    ] {
        let error =
            size.parse::<ErrorSize>().and_then(|size| one.clone().with_errors(&[size])).unwrap_err().to_string();
        assert!(error.contains(words), "{size}: {error}");
    }
    for (skip, words) in
        [("nobody", "no line has this name; allowed: line 2"), ("line 2", "table.csv: skip: no measurement is left")]
    {
        let error = one.clone().without(&[skip.to_owned()]).unwrap_err().to_string();
        assert!(error.contains(words), "{skip}: {error}");
    }
}

#[test]
fn bounds_are_read_and_checked() {
    let motor = scene("fundamental", &[]);
    let measured = table(&motor, "alpha\n0.2\n");
    for (vary, words) in [
        ("film.min_spacing_nm", "expected key=from:to"),
        ("film.min_spacing_nm=100:200:3", "expected key=from:to"),
        ("film.min_spacing_nm=3:200", "film.min_spacing_nm = 3 is out of range"),
        ("film.min_spacing_nm=3nm:200", "film.min_spacing_nm = 3 is out of range"),
        ("film.min_spacing_nm=3kHz:200", "3kHz is not a number: expected a number from 5 to 10000 nm, in nm, µm, mm"),
        ("film.min_spacing=100:200", "did you mean film.min_spacing_nm?"),
        ("film.min_spacing_nm=200:200", "is no range"),
        ("motor.rotor_speed_rpm=0:20:log", "both ends have to be above 0"),
        ("motor.waves=4:9", "motor.waves: it accepts"),
        ("film.gas=air:helium", "film.gas: it accepts one of"),
        ("plate.length_mm=1:2", "belongs to scene = \"plate\""),
    ] {
        let error = match vary.parse::<Bounds>() {
            Ok(bounds) => no_fit(&motor, &[bounds], &measured),
            Err(error) => error.to_string(),
        };
        assert!(error.contains(words), "{vary}: {error}");
    }
    assert_eq!(bounds(&["film.min_spacing_nm=0.1um:0,2 µm:log"]), bounds(&["film.min_spacing_nm=100:200:log"]));
    let twice = bounds(&["rotor.decay_length_mm=2:6", "rotor.decay_length_mm=2:7"]);
    assert!(no_fit(&motor, &twice, &measured).contains("given twice"));
    assert!(no_fit(&motor, &[], &measured).contains("0 keys given: allowed 1 to 12"));
}

#[test]
fn table_one_gives_the_fundamental_values_again() {
    let measured = Measured::table1(Method::Auto).unwrap().without(&["rotor_width_0.6mm".to_owned()]).unwrap();
    // Far from the fundamental values.
    let start = scene("fundamental", &[("film.min_spacing_nm", "300"), ("stator.normal_amplitude_um", "1.0")]);
    let vary = ["film.min_spacing_nm=50:600", "stator.normal_amplitude_um=0.5:3"];
    let found = fitted(&start, &vary, &measured, &DRAFT, 1);
    assert_eq!((found.rows.len(), found.degrees_of_freedom), (13, 11));
    assert!((found.unknowns[0].value - 200.0).abs() < 20.0, "{:?}", found.unknowns[0]);
    assert!((found.unknowns[1].value - 1.3).abs() < 0.13, "{:?}", found.unknowns[1]);
    // Table I agrees with the model to some per cent.
    assert!((0.005..0.05).contains(&found.error_scale.unwrap()), "{:?}", found.error_scale);
}

#[test]
fn the_optimum_is_that_of_a_fine_sweep() {
    let motor = scene("fundamental", &[]);
    let goal = Goal::new(&motor, "stall_torque_nm", true, &[]).unwrap();
    let vary = bounds(&["motor.load_per_wave_n=1:60"]);
    let best_told = Mutex::new(f64::NAN);
    let tell = |_, best| *best_told.lock().unwrap() = best;
    let found = optimise(&motor, &vary, &goal, &DRAFT, (1, &Cancel::new(), &tell)).unwrap().unwrap();
    assert!((best_told.into_inner().unwrap() / found.value.value - 1.0).abs() < 0.01, "{found:?}");
    let sweep: Vary = "motor.load_per_wave_n=1:60:120:log".parse().unwrap();
    let rows = Sweep::new(&motor, &[sweep], &DRAFT).unwrap().run(&[], &Cancel::new(), &|_| ());
    let best = rows.iter().filter_map(|row| Some((row.numbers.get(Quantity::StallTorque)?, row.values[0])));
    let best = best.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    assert!((found.value.value / best.0 - 1.0).abs() < 0.01, "{found:?} {best:?}");
    assert!(found.warnings.iter().any(|text| text.contains("always brake")), "{:?}", found.warnings);
    let line = &found.lines[0];
    let (from, to) = line.flat.unwrap();
    assert!(from <= line.value && line.value <= to && (from..=to).contains(&best.1));
}

#[test]
fn a_lesser_optimum_is_told_unless_it_breaks_a_limit() {
    let motor = scene("fundamental", &[]);
    let vary = ["motor.load_per_wave_n=0.1:20", "film.min_spacing_nm=20:1000"];
    let told = |limits: &[&str]| {
        let found = optimum(&motor, &vary, ("max_efficiency", true), limits, 5);
        let other = found.warnings.iter().find_map(|text| Some(text.split_once("with max_efficiency = ")?.1));
        let other = other.map(|text| text.split_once(':').unwrap().0.parse::<f64>().unwrap());
        (found.value.value, other)
    };
    // One is at the greatest spacing, another at a sixth of it.
    let (best, other) = told(&[]);
    assert!(other.is_some_and(|other| (0.85..best).contains(&other)), "{best} {other:?}");
    assert_eq!(told(&["max_power_w>100"]).1, None);
}

#[test]
fn an_optimum_keeps_its_limits() {
    let motor = scene("fundamental", &[]);
    let vary = "film.min_spacing_nm=100:400";
    let found = optimum(&motor, &[vary], ("film_load_n", true), &["alpha<0.2"], 1);
    assert!((found.limited[0].value - 0.2).abs() < 5e-4, "{found:?}");
    assert!((found.value.value - 0.2 * 2.45).abs() < 2e-3, "{found:?}");
    assert!(found.warnings.iter().any(|text| text == "the limit alpha < 0.2 is what stops it"), "{:?}", found.warnings);
    // Spacings below the optimum are told to be beyond the limit.
    let line = &found.lines[0];
    assert_eq!(line.kept.len(), line.points.len());
    assert!(
        line.points.iter().zip(&line.kept).all(|((spacing, _), kept)| *kept == (*spacing >= line.value)),
        "{line:?}"
    );
    // The range in which it hardly changes ends there, too.
    assert_eq!(line.flat.unwrap().0, line.value);
    // Where it is kept nowhere, that is no optimum, and no range round it is stated.
    let arguments = ["fit", "fundamental", "--maximise", "film_load_n", "--vary", vary];
    let output = run(&[&arguments[..], &["--subject-to", "alpha<0.05", "--fidelity", "draft", "--json"]].concat());
    let said = [out(&output), err(&output)].concat();
    assert!(output.status.code() == Some(3) && said.contains("the limit alpha < 0.05 cannot be kept"), "{said}");
    let unknown = &json(&output)["unknowns"][0];
    assert!(unknown["flat_from"].is_null() && unknown["flat_to"].is_null(), "{unknown}");
    // Without it the bound is reached, and said to be.
    let found = optimum(&motor, &[vary], ("film_load_n", true), &[], 1);
    assert_eq!((found.lines[0].at, found.lines[0].value), (Some(Bound::Lower), 100.0));
    assert!(
        found.warnings[0].ends_with("is at its lower bound, 100 nm: a better value, if there is one, lies beyond it")
    );
    // A key without a unit.
    let found = optimum(&motor, &["motor.dry_friction=0.1:0.3"], ("stall_torque_nm", true), &[], 1);
    assert!(found.warnings[0].contains("is at its upper bound, 0.3: a better"), "{:?}", found.warnings);
    // In next to a vacuum the torque does not depend on the pressure.
    let found = optimum(&motor, &["film.ambient_pressure_kpa=0.01:1"], ("max_torque_nm", false), &[], 1);
    assert!(found.warnings[0].contains("bound, ") && found.warnings[0].contains("max_torque_nm changes by less than "));
    let error = Goal::new(&motor, "torque", true, &[]).unwrap_err().to_string();
    assert!(error.contains("maximise torque: no such number; did you mean max_torque_nm? Allowed: alpha,"), "{error}");
}

#[test]
fn the_command_writes_what_it_prints_and_a_preset_that_solves() {
    let folder = tempfile::tempdir().unwrap();
    let (data, out) = (folder.path().join("loads.csv"), folder.path().join("out"));
    std::fs::write(&data, plate_loads(&exact_loads(), 5)).unwrap();
    let [data, out_text] = [&data, &out].map(|path| path.to_str().unwrap());
    let mut arguments =
        vec!["fit", "plate-crossover", "--data", data, "--out", out_text, "--json", "--fidelity", "draft"];
    arguments.extend(PLATE.iter().flat_map(|vary| ["--vary", vary]));
    let object = json(&done(&arguments));
    assert_eq!(object["unknowns"][0]["key"], "plate.amplitude_um");
    assert_eq!(object["rows"].as_array().unwrap().len(), 8);
    assert_eq!(object["correlation"][0][0], 1.0);
    let written: Json = serde_json::from_str(&std::fs::read_to_string(out.join("fit.json")).unwrap()).unwrap();
    assert_eq!(written, object);
    for name in ["fit.csv", "fit.svg", "residuals.svg", "correlation.png"] {
        assert!(out.join(name).metadata().unwrap().len() > 100, "{name}");
    }
    let preset = Scene::load(&out.join("fitted.toml")).unwrap();
    let value = object["unknowns"][0]["value"].as_f64().unwrap();
    assert_eq!(preset.get("plate.amplitude_um").unwrap().as_number(), Some(value));
    let missing = ["fit", "fundamental", "--data", "nowhere.csv", "--vary", "film.min_spacing_nm=100:200"];
    refused(&missing, 2, &["nowhere.csv: cannot be read"]);
}

#[test]
fn errors_that_are_given_are_those_of_the_measurements() {
    let measured =
        table(&scene("fundamental", &[]), "film.min_spacing_nm,alpha,film_load_n\n200,0.25,0.6\n100,-0.5,1.2\n");
    assert!(!measured.errors_known);
    // The last that applies counts.
    let sizes = ["4%", "film_load_n=0.03"].map(|size| size.parse::<ErrorSize>().unwrap());
    let given = measured.with_errors(&sizes).unwrap();
    let errors: Vec<f64> = given.measurements.iter().map(|one| one.error).collect();
    assert!(given.errors_known);
    for (found, expected) in errors.iter().zip([0.01, 0.03, 0.02, 0.03]) {
        assert!((found - expected).abs() < 1e-12, "{errors:?}");
    }
}
