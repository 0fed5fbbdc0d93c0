//! Derivatives by the keys of a scene against exact ones and against solves that know nothing of each other; uncertainties, linear and drawn;
//! the command.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod program;

use program::{done, json, out};
use serde_json::Value;
use squeezefilm::analysis::quantity::{Numbers, Quantity};
use squeezefilm::analysis::sensitivity::{MonteCarlo, Sensitivity, Uncertainties};
use squeezefilm::analysis::variation::Sides;
use squeezefilm::control::Cancel;
use squeezefilm::estimate::Estimate;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::problem::Problem;
use squeezefilm::scene::{Scene, presets};
use squeezefilm::solve::{Record, Settings, solve};
use std::sync::atomic::{AtomicUsize, Ordering};

fn at(fidelity: Fidelity) -> Settings {
    Settings { fidelity, ..Settings::default() }
}

fn sensitivity(scene: &Scene, keys: &[&str], fidelity: Fidelity) -> Sensitivity {
    Sensitivity::of(scene, keys, &at(fidelity), &Cancel::new(), &|_| ()).unwrap().unwrap()
}

fn uncertainties(scene: &Scene, given: &[(&str, &str)]) -> Uncertainties {
    let given: Vec<_> = given.iter().map(|(key, amount)| (*key, amount.parse().unwrap())).collect();
    Uncertainties::new(scene, &given).unwrap()
}

fn number(scene: &Scene, key: &str) -> f64 {
    scene.get(key).unwrap().as_number().unwrap()
}

const MOTOR_QUANTITIES: [Quantity; 3] = [Quantity::Alpha, Quantity::StallTorque, Quantity::NoLoadSpeed];

/// Elasticities from reference solves on both sides, cold, each on grids of its own.
fn independent(preset: &str, key: &str, share: f64) -> [f64; 3] {
    let scene = presets::find(preset).unwrap();
    let solved = |factor: f64| {
        let mut scene = scene.clone();
        scene.set(key, &(factor * number(&scene, key)).to_string()).unwrap();
        let problem = Problem::try_from(&scene).unwrap();
        let settings = Settings { record: Record::Numbers, ..at(Fidelity::Reference) };
        let numbers = Numbers::of(&problem, &solve(&problem, &settings, &mut (), &Cancel::new()).unwrap());
        MOTOR_QUANTITIES.map(|quantity| numbers.get(quantity).unwrap())
    };
    let (less, middle, more) = (solved(1.0 - share), solved(1.0), solved(1.0 + share));
    std::array::from_fn(|i| (more[i] - less[i]) / (2.0 * share * middle[i]))
}

#[test]
fn derivatives_are_as_exact_as_they_say() {
    let keys = [
        "film.min_spacing_nm",
        "stator.normal_amplitude_um",
        "motor.load_per_wave_n",
        "stator.tooth_width_mm",
        "rotor.decay_length_mm",
        "motor.contact_radius_mm",
        "film.viscosity_upa_s",
    ];
    for preset in ["fundamental", "min-spacing-100nm"] {
        let exact: Vec<[f64; 3]> = keys.iter().map(|key| independent(preset, key, 0.02)).collect();
        for (fidelity, most) in [(Fidelity::Draft, 0.25), (Fidelity::Standard, 0.15), (Fidelity::Fine, 0.04)] {
            let found = sensitivity(&presets::find(preset).unwrap(), &keys, fidelity);
            for (column, key) in keys.iter().enumerate() {
                for (output, quantity) in MOTOR_QUANTITIES.iter().enumerate() {
                    let Estimate { value, error } = found.elasticity(output, column).unwrap();
                    let exact = exact[column][output];
                    // The solves that it is compared with are off by a little too: twice 2e-5 over a change of 4 %.
                    let off = (value - exact).abs();
                    assert!(off <= error + 1e-3, "{preset} {fidelity} {key} {quantity:?}: {value} ± {error}, {exact}");
                    assert!(
                        error < most * value.abs().max(0.2),
                        "{preset} {fidelity} {key} {quantity:?}: {value} ± {error}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_trapped_plate_has_the_derivatives_of_its_formula() {
    let set = [("plate.length_mm", "1000"), ("plate.frequency_khz", "10000"), ("film.slip", "none")];
    let scene = presets::find("plate-trapped").unwrap().with(set).unwrap();
    let keys = ["plate.amplitude_um", "plate.mean_gap_um", "film.ambient_pressure_kpa", "plate.length_mm"];
    let found = sensitivity(&scene, &keys, Fidelity::Fine);
    let (amplitude, gap) = (number(&scene, keys[0]), number(&scene, keys[1]));
    let (pressure, length) = (1e3 * number(&scene, keys[2]), 1e-3 * number(&scene, keys[3]));
    // Load p_a A (√(N/D) − 1), N = 1 + 3ε²/2, D = 1 − ε² (Langlois 1962, Salbu 1964).
    let excursion = amplitude / gap;
    let (above, below) = (1.0 + 1.5 * excursion * excursion, 1.0 - excursion * excursion);
    let ratio = (above / below).sqrt();
    let slope = ratio * (1.5 * excursion / above + excursion / below);
    let exact = [
        pressure * length * slope / gap,
        -pressure * length * slope * excursion / gap,
        1e3 * length * (ratio - 1.0),
        1e-3 * pressure * (ratio - 1.0),
    ];
    for (column, exact) in exact.into_iter().enumerate() {
        let Estimate { value, error } = found.slope(0, column).unwrap();
        assert!(
            (value - exact).abs() <= error && error < 5e-3 * exact.abs(),
            "{}: {value} ± {error}, {exact}",
            keys[column]
        );
    }
}

#[test]
fn a_plate_that_floats_on_trapped_gas_is_as_high_as_its_amplitude_and_less_so_under_its_load() {
    let disc = [("plate.radius_mm", "100"), ("plate.mass_g", "10000")];
    let set = disc.into_iter().chain([("plate.frequency_khz", "10000"), ("film.slip", "none")]);
    let scene = presets::find("floating-disc").unwrap().with(set).unwrap();
    let found = sensitivity(&scene, &["plate.amplitude_um", "plate.mass_g"], Fidelity::Fine);
    // h = a √((s + 3/2)/(s − 1)), s = (1 + w)²: d ln h/d ln w = w (1 + w) [1/(s + 3/2) − 1/(s − 1)].
    let w = 10.0 * 9.80665 / (101_325.0 * std::f64::consts::PI * 0.01);
    let s = (1.0 + w) * (1.0 + w);
    let by_load = w * (1.0 + w) * (1.0 / (s + 1.5) - 1.0 / (s - 1.0));
    for (column, exact) in [(0, 1.0), (1, by_load)] {
        let Estimate { value, error } = found.elasticity(0, column).unwrap();
        assert!((value - exact).abs() <= error + 2e-3 && error < 0.02, "{column}: {value} ± {error}, {exact}");
    }
}

#[test]
fn at_an_end_of_a_range_there_is_one_side() {
    let slope = |at: &str| {
        let scene = presets::find("plate-crossover").unwrap().with([("film.ambient_pressure_kpa", at)]).unwrap();
        let column = &sensitivity(&scene, &["film.ambient_pressure_kpa"], Fidelity::Standard).columns[0];
        (column.sides, column.slopes.as_ref().unwrap()[0])
    };
    let [(sides, one_sided), (_, before), (_, earlier)] = ["1000", "960", "920"].map(slope);
    assert_eq!(sides, Sides::Below);
    let continued = 2.0 * before.value - earlier.value;
    let tolerance = one_sided.step_error + (continued - before.value).abs();
    assert!((one_sided.value - continued).abs() < tolerance, "{one_sided:?} {before:?} {earlier:?}");
    assert!(one_sided.step_error < 0.05 * one_sided.value.abs(), "{one_sided:?}");
}

#[test]
fn where_a_ring_does_not_reach_there_is_one_side() {
    let scene = presets::find("ring-rotor").unwrap();
    let found = sensitivity(&scene, &["rotor.contact_width_mm", "motor.contact_radius_mm"], Fidelity::Draft);
    assert_eq!(found.columns[0].sides, Sides::Below);
    let Estimate { value, error } = found.elasticity(0, 0).unwrap();
    // From solves at fine, 5 % apart. The elements are others for each width, and what they leave of the compliance does not cancel in a difference.
    assert!((value - 1.19).abs() < error && error < 2.0, "{value} ± {error}");
    let why = found.columns[1].slopes.as_ref().unwrap_err();
    assert!(why.contains("is not within the lowest face of the section"), "{why}");
}

#[test]
fn what_is_proportional_has_the_elasticity_one() {
    let found = sensitivity(
        &presets::find("fundamental").unwrap(),
        &["motor.dry_friction", "stator.tangential_amplitude_um", "motor.rotor_speed_rpm"],
        Fidelity::Standard,
    );
    for (output, column, exact) in [(0, 0, 0.0), (1, 0, 1.0), (2, 0, 0.0), (0, 1, 0.0), (2, 1, 1.0), (0, 2, 0.0)] {
        let Estimate { value, error } = found.elasticity(output, column).unwrap();
        assert!((value - exact).abs() < 1e-6, "{output} {column}: {value}");
        // The wedge term is left out, by which sliding acts on the film: that is not nothing, and not known to be.
        assert!(error > 0.0 && error < 0.01, "{output} {column}: {error}");
    }
    let propagated = found.propagated(1, &uncertainties(found.scene(), &[("motor.dry_friction", "10%")]));
    assert!((propagated.deviation.value / found.values[1].value - 0.1).abs() < 1e-7);
}

#[test]
fn what_all_grids_have_alike_may_still_be_off() {
    // A rectangle so slow that its gas is not compressed: the damping by its width is known from a series, and every grid has the same nodes across.
    let set = [
        ("plate.shape", "rectangle"),
        ("plate.length_mm", "0.475"),
        ("plate.width_mm", "4.238"),
        ("plate.mean_gap_um", "4.491"),
        ("plate.frequency_khz", "0.09151"),
        ("plate.amplitude_um", "0.02563"),
        ("film.slip", "none"),
    ];
    let scene = presets::find("plate-crossover").unwrap().with(set).unwrap();
    let found = sensitivity(&scene, &["plate.width_mm"], Fidelity::Standard).elasticity(2, 0).unwrap();
    let exact = 1.076_008_2;
    assert!((found.value - exact).abs() <= found.error && found.error < 1e-2, "{found:?}");
}

#[test]
fn what_is_nothing_but_its_error_has_no_elasticity() {
    let mut found = sensitivity(&presets::find("fundamental").unwrap(), &["motor.load_per_wave_n"], Fidelity::Draft);
    assert!(found.elasticity(0, 0).is_some());
    found.values[0].error = found.values[0].value;
    assert!(found.elasticity(0, 0).is_none() && found.elasticity(1, 0).is_some());
}

#[test]
fn small_uncertainties_are_linear() {
    let scene = presets::find("fundamental").unwrap();
    let given = [("film.min_spacing_nm", "1%"), ("motor.load_per_wave_n", "±0.02"), ("motor.dry_friction", "0.005")];
    let uncertain = uncertainties(&scene, &given);
    let found = sensitivity(&scene, &[], Fidelity::Standard);
    const DRAWS: usize = 800;
    let carlo = found.monte_carlo(&uncertain, DRAWS, 7, &Cancel::new(), &|| ()).unwrap();
    assert_eq!((carlo.draws.len(), carlo.failures.len(), carlo.redrawn), (DRAWS, 0, 0));
    let limit = 0.02 + 1e-12;
    assert!(carlo.draws.iter().all(|draw| (draw.values[1] - 2.45).abs() <= limit));
    for output in 0..found.outputs.len() {
        let (linear, drawn) = (found.propagated(output, &uncertain), carlo.spread(output).unwrap());
        // Four standard deviations of what so many draws leave open.
        let open = 4.0 / (2.0 * DRAWS as f64).sqrt();
        assert!((drawn.deviation / linear.deviation.value - 1.0).abs() < open, "{output}: {linear:?} {drawn:?}");
        assert!((drawn.mean - found.values[output].value).abs() < 4.0 * drawn.mean_error() + 0.02 * drawn.deviation);
        let shares: f64 =
            given.iter().map(|(key, _)| linear.share(squeezefilm::scene::Parameter::find(key).unwrap()).unwrap()).sum();
        assert!((shares - 1.0).abs() < 1e-12);
        let [low, median, high] = drawn.quantiles;
        assert!(low.value < median.value && median.value < high.value);
        assert!(drawn.bins.2.iter().sum::<usize>() == DRAWS);
        // Of a normal distribution √(π/2) times that of the mean, and about twice that of the mean at the ends.
        let errors = [low, median, high].map(|quantile| quantile.error / drawn.mean_error());
        assert!((0.7..2.0).contains(&errors[1]) && errors[0] > 0.9 && errors[2] > 0.9, "{output}: {errors:?}");
    }
    // It is not the linear estimate in disguise: far away the film is not linear.
    let far = uncertainties(&scene, &[("film.min_spacing_nm", "40%")]);
    let drawn = found.monte_carlo(&far, DRAWS, 7, &Cancel::new(), &|| ()).unwrap();
    assert!(drawn.spread(0).unwrap().mean > found.values[0].value + 4.0 * drawn.spread(0).unwrap().mean_error());
}

#[test]
fn draws_out_of_range_are_drawn_again_and_counted() {
    let scene = presets::find("fundamental").unwrap();
    let found = sensitivity(&scene, &["motor.dry_friction"], Fidelity::Draft);
    let carlo =
        found.monte_carlo(&uncertainties(&scene, &[("motor.dry_friction", "0.7")]), 500, 1, &Cancel::new(), &|| ());
    let carlo = carlo.unwrap();
    // α does not depend on friction; the mean of the torque moved with the draws that were not allowed.
    let off = |output: usize| carlo.spread(output).unwrap().is_off(found.values[output]);
    assert_eq!([off(0), off(1)], [false, true]);
    let MonteCarlo { draws, failures, redrawn, .. } = carlo;
    assert!(redrawn > 5 && failures.is_empty() && draws.len() == 500);
    assert!(draws.iter().all(|draw| (0.0..=2.0).contains(&draw.values[0])));
    // What was drawn before it was cancelled stays.
    let cancel = Cancel::new();
    let (few, drawn) = (uncertainties(&scene, &[("motor.dry_friction", "0.1")]), AtomicUsize::new(0));
    let until_cancelled = || {
        if drawn.fetch_add(1, Ordering::Relaxed) == 20 {
            cancel.cancel();
        }
    };
    let part = found.monte_carlo(&few, 5000, 1, &cancel, &until_cancelled).unwrap().draws;
    assert!((15..2500).contains(&part.len()) && part.iter().all(|draw| !draw.results.is_empty()), "{}", part.len());
    assert!(found.monte_carlo(&few, 10, 1, &cancel, &|| ()).is_none());
    let settings = at(Fidelity::Draft);
    assert!(Sensitivity::of(&scene, &["motor.dry_friction"], &settings, &cancel, &|_| ()).unwrap().is_none());
}

#[test]
fn the_film_under_a_drawn_plate_carries_it() {
    let scene = presets::find("floating-disc").unwrap();
    let uncertain = uncertainties(&scene, &[("plate.mass_g", "30%"), ("plate.amplitude_um", "20%")]);
    let found = sensitivity(&scene, &["plate.mass_g"], Fidelity::Draft);
    let carlo = found.monte_carlo(&uncertain, 12, 1, &Cancel::new(), &|| ()).unwrap();
    assert_eq!((carlo.draws.len(), carlo.failures.len()), (12, 0));
    for draw in &carlo.draws {
        // Its stiffness and damping, too.
        assert!(draw.results.len() == 3 && draw.results.iter().all(|found| found.error < found.value), "{draw:?}");
        let mut held = scene.clone();
        held.set_all([
            ("plate.mass_g", "none".to_owned()),
            ("plate.mean_gap_um", draw.results[0].value.to_string()),
            ("plate.amplitude_um", draw.values[1].to_string()),
        ])
        .unwrap();
        let problem = Problem::try_from(&held).unwrap();
        let solution = solve(&problem, &at(Fidelity::Fine), &mut (), &Cancel::new()).unwrap();
        let carried = Numbers::of(&problem, &solution).get(Quantity::FilmLoad).unwrap();
        let off = carried / (9.80665e-3 * draw.values[0]) - 1.0;
        // F falls about as the square of the gap, nearer by as its fourth power.
        let allowed = 4.0 * draw.results[0].error / draw.results[0].value + 2e-3;
        assert!(off.abs() < allowed && allowed < 0.02, "{draw:?}: {off} of {allowed}");
    }
}

#[test]
fn threads_change_no_bit() {
    let scene = presets::find("fundamental").unwrap();
    let by = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let found = sensitivity(&scene, &[], Fidelity::Draft);
            let uncertain = uncertainties(&scene, &[("film.min_spacing_nm", "20%"), ("motor.load_per_wave_n", "5%")]);
            let carlo = found.monte_carlo(&uncertain, 40, 3, &Cancel::new(), &|| ()).unwrap();
            (found.columns.clone(), carlo)
        })
    };
    assert_eq!(by(1), by(2));
}

// ---- the command

fn refused(arguments: &[&str], words: &str) {
    program::refused(&[&["sensitivity"], arguments].concat(), 2, &[words]);
}

#[test]
fn what_makes_no_sense_is_refused_by_name() {
    refused(&["fundamental", "--keys", "film.min_spacing"], "did you mean film.min_spacing_nm?");
    refused(&["fundamental", "--keys", "motor.waves"], "motor.waves: it accepts a whole number");
    refused(&["fundamental", "--uncertainty", "film.min_spacing_nm=-3"], "expected a standard deviation above 0");
    refused(&["fundamental", "--uncertainty", "film.min_spacing_nm"], "expected key=value");
    refused(
        &["fundamental", "--uncertainty", "motor.rotor_speed_rpm=5%"],
        "motor.rotor_speed_rpm = 5%: its value is 0 rpm",
    );
    refused(&["fundamental", "--monte-carlo", "10"], "--uncertainty");
    refused(&["fundamental", "--method", "paper"], "allowed here: auto");
    refused(&["fundamental", "--budget", "1s"], "--accuracy");
    refused(&["fundamental", "--set", "film.min_spacing_nm=3"], "allowed 5 to 10000 nm");
}

#[test]
fn text_object_and_files_agree() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let words = ["--uncertainty", "film.min_spacing_nm=20%", "--monte-carlo", "20", "--fidelity", "draft"];
    let arguments =
        [&["sensitivity", "fundamental", "--keys", "motor.load_per_wave_n", "--json", "--out", path][..], &words];
    let output = done(&arguments.concat());
    let object = json(&output);
    let outputs = object["outputs"].as_array().unwrap();
    assert_eq!(object["whole_numbers"], serde_json::json!(["motor.waves", "stator.teeth_per_wave"]));
    assert_eq!(
        object["monte_carlo"],
        serde_json::json!({ "seed": 1, "asked": 20, "solved": 20, "failed": 0, "redrawn": 0 })
    );
    let mut rows = csv::Reader::from_path(folder.path().join("sensitivity.csv")).unwrap();
    let names = rows.headers().unwrap().clone();
    let records: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    assert_eq!(records.len(), 6);
    for (i, record) in records.iter().enumerate() {
        let by = &outputs[i / 2]["by"][i % 2];
        for (name, cell) in names.iter().zip(record) {
            match &by[name] {
                Value::Null => assert_eq!(cell, "", "{name}"),
                Value::String(text) => assert_eq!(cell, text, "{name}"),
                number => {
                    let (cell, number) = (cell.parse::<f64>().unwrap(), number.as_f64().unwrap());
                    assert!((cell - number).abs() <= 1e-14 * number.abs(), "{name}");
                }
            }
        }
    }
    for output in outputs {
        let by = output["by"].as_array().unwrap();
        assert_eq!(by[1]["key"], "film.min_spacing_nm");
        let [slope, deviation] = ["derivative", "uncertainty"].map(|name| by[1][name].as_f64().unwrap());
        let uncertainty = output["uncertainty"].as_f64().unwrap();
        assert!(deviation == 40.0 && (uncertainty / (slope * deviation).abs() - 1.0).abs() < 1e-12);
        assert_eq!((&by[0]["uncertainty"], &by[1]["variance_share"]), (&Value::Null, &1.0.into()));
        assert!(output["monte_carlo"]["count"] == 20 && output["error"].as_f64().unwrap() < uncertainty);
    }
    let figure = std::fs::read_to_string(folder.path().join("monte-carlo.svg")).unwrap();
    assert!(figure.contains(" drawn, ± ") && figure.contains(" linear, ± "), "which deviation is which");
    let draws = std::fs::read_to_string(folder.path().join("monte-carlo.csv")).unwrap();
    let heads = "film.min_spacing_nm,alpha,alpha_error,stall_torque_nm,stall_torque_error_nm,no_load_speed_rpm,no_load_speed_error_rpm";
    assert_eq!(draws.lines().next(), Some(heads));
    let cells =
        draws.lines().skip(1).flat_map(|row| row.split(',').skip(1).step_by(2).zip(row.split(',').skip(2).step_by(2)));
    for (value, error) in cells.map(|(value, error)| (value.parse::<f64>().unwrap(), error.parse::<f64>().unwrap())) {
        assert!(0.0 < error && error < 0.1 * value, "{value} ± {error}");
    }
    assert_eq!(draws.lines().count(), 21);
    for name in ["sensitivity.json", "sensitivity.png", "uncertainty.png", "monte-carlo.png", "scene.toml"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
    for (name, of, keys) in [("sensitivity.svg", "1 %", 2), ("uncertainty.svg", "1 s.d.", 1)] {
        let figure = std::fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(figure.contains(&format!("for {of} more")), "{name}");
        assert_eq!(figure.contains("load on one wave"), keys == 2, "{name}");
    }
    assert_eq!(std::fs::read(folder.path().join("sensitivity.json")).unwrap(), output.stdout);

    let text = done(&["sensitivity", "levitating", "--fidelity", "draft", "--keys", "motor.load_per_wave_n"]);
    let cells: Vec<&str> =
        out(&text).lines().find(|line| line.contains("motor.load_per_wave_n")).unwrap().split_whitespace().collect();
    assert_eq!(cells, ["motor.load_per_wave_n", "0", "none", "none"]);

    // Large numbers are rounded, too, and so are those of random scenes.
    let words =
        ["sensitivity", "floating-disc", "--fidelity=draft", "--keys=plate.mass_g", "--uncertainty=plate.mass_g=5%"];
    let text = done(&[&words[..], &["--monte-carlo=5"]].concat());
    let lines: Vec<&str> =
        out(&text).lines().filter(|line| line.trim_start().starts_with("dynamic stiffness")).collect();
    let [line] = lines[..] else { panic!("{}", out(&text)) };
    let numbers: Vec<&str> = line.split(|c: char| !c.is_ascii_digit()).filter(|number| number.len() > 4).collect();
    assert!(numbers.len() >= 6 && numbers.iter().all(|number| number.ends_with("00")), "{line}");
}

#[test]
fn two_ladders_that_agree_by_chance_are_no_proof() {
    let set = [
        ("plate.shape", "disc"),
        ("plate.radius_mm", "0.7436"),
        ("plate.frequency_khz", "279.1"),
        ("plate.mean_gap_um", "6.5465"),
        ("plate.amplitude_um", "0.52814"),
        ("film.slip", "none"),
        ("film.viscosity_upa_s", "24.08"),
        ("film.ambient_pressure_kpa", "100.5"),
    ];
    let scene = presets::find("plate-crossover").unwrap().with(set).unwrap();
    let found = sensitivity(&scene, &["plate.amplitude_um"], Fidelity::Standard);
    let slope = found.slope(2, 0).unwrap();
    // By solves to an accuracy of 10⁻⁶ on both sides.
    assert!((slope.value + 2.3795e-5).abs() < slope.error, "{slope:?}");
    assert!(slope.error < 2.0 * slope.value.abs(), "{slope:?}");
    // What is proportional to a key is so to rounding.
    let found = sensitivity(&presets::find("fundamental").unwrap(), &["motor.dry_friction"], Fidelity::Draft);
    let elasticity = found.elasticity(1, 0).unwrap();
    assert!((elasticity.value - 1.0).abs() <= elasticity.error && elasticity.error < 1e-2, "{elasticity:?}");
}

#[test]
fn a_plate_that_floats_has_its_stiffness_at_the_gap_where_it_floats_on_one_side_too() {
    let mut scene = presets::find("floating-disc").unwrap();
    for (key, value) in [("film.slip", "fukui-kaneko"), ("plate.load_n", "0.41"), ("plate.amplitude_um", "0.62")] {
        scene.set(key, value).unwrap();
    }
    let found = sensitivity(&scene, &["film.accommodation"], Fidelity::Standard);
    assert_eq!(found.columns[0].sides, Sides::Below);
    let stiffness = |accommodation: &str| {
        scene.set("film.accommodation", accommodation).unwrap();
        sensitivity(&scene, &["plate.load_n"], Fidelity::to(2e-5)).values[1].value
    };
    let [far, near, at] = ["0.92", "0.96", "1"].map(stiffness);
    let exact = (3.0 * at - 4.0 * near + far) / 0.08;
    let slope = found.columns[0].slopes.as_ref().unwrap()[1];
    assert!((slope.value - exact).abs() < 0.02 * exact.abs(), "{slope:?} {exact}");
}
