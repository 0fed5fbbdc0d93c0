//! The program as its users see it: what it prints where, the exit status, the files.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod program;

use program::{done, err, json, out, refused, run, squeezefilm};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

fn with_input(arguments: &[&str], text: &[u8]) -> Output {
    let mut command = squeezefilm(arguments);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), text).unwrap();
    child.wait_with_output().unwrap()
}

/// Runs with `--json` at draft fidelity and reads the whole of standard output.
fn solved(arguments: &[&str]) -> Value {
    let output = done(&[&["solve", "--fidelity", "draft", "--json"], arguments].concat());
    assert_eq!(err(&output), "");
    json(&output)
}

const NUMBERS: [&str; 9] = [
    "film_load_n",
    "film_load_min_n",
    "film_load_max_n",
    "min_gap_nm",
    "max_pressure_kpa",
    "squeeze_number",
    "bearing_number",
    "knudsen_number",
    "film_load_error_n",
];
const MOTOR_NUMBERS: [&str; 7] = [
    "alpha",
    "alpha_error",
    "contact_load_n",
    "stall_torque_nm",
    "stall_torque_error_nm",
    "max_torque_nm",
    "teeth_in_contact",
];
const PLATE_NUMBERS: [&str; 3] = ["mean_load_ratio", "load_ratio_min", "load_ratio_max"];
const STATS: [&str; 8] = [
    "wall_s",
    "film_steps",
    "cycles",
    "coupling_iterations",
    "contact_solves",
    "film_nodes",
    "contact_nodes",
    "steps_per_cycle",
];

fn check_common(result: &Value, name: &str, scene: &str) {
    assert_eq!(result["schema"], 1);
    assert_eq!((&result["preset"], &result["scene"]), (&Value::from(name), &Value::from(scene)));
    assert_eq!((&result["converged"], &result["status"]), (&Value::from(true), &Value::from("converged")));
    NUMBERS.iter().for_each(|key| assert!(result[key].is_number(), "{key}"));
    STATS.iter().for_each(|key| assert!(result["stats"][key].is_number(), "stats.{key}"));
    let model = &result["model"];
    assert_eq!((&model["fidelity"], &model["method"]), (&Value::from("draft"), &Value::from("auto")));
    assert!(model["teeth_solved"] == 1 && model["half_width"].is_boolean() && model["shear"].is_boolean());
    assert!(model["why"].as_array().unwrap().iter().all(Value::is_string));
    assert_eq!(result["warnings"], Value::Array(Vec::new()));
}

#[test]
fn json_of_a_motor_has_every_name() {
    let result = solved(&["fundamental"]);
    check_common(&result, "Fundamental case", "motor");
    MOTOR_NUMBERS.iter().for_each(|key| assert!(result[key].is_number(), "{key}"));
    PLATE_NUMBERS.iter().for_each(|key| assert!(result.get(key).is_some_and(Value::is_null), "{key}"));
    assert_eq!(result["levitated"], false);
    let number = |key: &str| result[key].as_f64().unwrap();
    assert!((number("alpha") - 0.2459).abs() < number("alpha_error"));
    assert!((number("film_load_n") + number("contact_load_n") - 2.45).abs() < 1e-9);
    assert!((number("film_load_error_n") - 2.45 * number("alpha_error")).abs() < 1e-9);
    let range =
        ["min", "max"].map(|end| [number(&format!("film_load_{end}_n")), number(&format!("film_load_{end}_error_n"))]);
    assert!(range.iter().all(|[load, error]| *error > 0.0 && *error < 0.1 * load), "{range:?}");
    let [pressure, error] = ["max_pressure_kpa", "max_pressure_error_kpa"].map(number);
    assert!(pressure > 101.325 && error > 0.0 && error < 0.1 * pressure, "{pressure} ± {error}");
    assert!((number("max_torque_nm") - 0.7 * 7.0 * 0.029 * number("contact_load_n")).abs() < 1e-9);
    // Where it touches, the least gap is H_m exactly; afloat it has an error, in nanometres too.
    let floating = solved(&["levitating"]);
    let gap =
        ["min_gap_nm", "min_gap_error_nm"].map(|key| (result[key].as_f64().unwrap(), floating[key].as_f64().unwrap()));
    assert!((gap[0].0 - 200.0).abs() < 1e-9 && gap[0].1 > 10.0, "{gap:?}");
    assert!(gap[1].1 > 1e-5 * gap[0].1 && gap[1].1 < 0.1 * gap[0].1, "{gap:?}");
}

#[test]
fn json_of_a_plate_has_every_name_and_null_where_there_is_no_motor() {
    for (width, unit, name) in [("none", "N/m", "Plate, crossover"), ("1", "N", "Plate, crossover, changed: 1 key")] {
        let result = solved(&["plate-crossover", "--set", &format!("plate.width_mm={width}")]);
        check_common(&result, name, "plate");
        assert_eq!(result["force_unit"], unit);
        PLATE_NUMBERS.iter().for_each(|key| assert!(result[key].is_number(), "{key}"));
        MOTOR_NUMBERS.iter().for_each(|key| assert!(result.get(key).is_some_and(Value::is_null), "{key}"));
        assert!(result.get("levitated").is_some_and(Value::is_null));
        let number = |key: &str| result[key].as_f64().unwrap();
        let area = if unit == "N" { 1e-6 } else { 1e-3 };
        assert!((number("mean_load_ratio") * 101_325.0 * area / number("film_load_n") - 1.0).abs() < 1e-9);
        assert!(number("load_ratio_min") < number("mean_load_ratio"));
    }
}

#[test]
fn summary_names_the_numbers_with_units() {
    let output = run(&["solve", "fundamental", "--fidelity", "draft"]);
    assert_eq!((output.status.code(), err(&output)), (Some(0), ""));
    for words in [
        "film share of the load  α",
        "\n  stall torque ",
        " ± ",
        " N·m",
        "levitated",
        " nm",
        " kPa",
        "σ",
        "Λ",
        "Kn",
        " ms",
    ] {
        assert!(out(&output).contains(words), "{words:?} is not in\n{}", out(&output));
    }
}

#[test]
fn a_named_gas_is_told_and_a_mean_free_path_that_stays_behind_too() {
    let helium = run(&["solve", "motor-60mm-helium", "--fidelity", "draft"]);
    let line = "helium at 20 °C  at 79.50 kPa: viscosity 19.61 µPa·s, mean free path 241.3 nm";
    assert!(out(&helium).contains(line) && err(&helium).is_empty(), "{}", out(&helium));
    let (pressure, stays) = ("film.ambient_pressure_kpa=50", "the mean free path stays at 64 nm at another pressure");
    let solve =
        |more: &[&str]| run(&[&["solve", "plate-crossover", "--fidelity", "draft", "--set", pressure], more].concat());
    assert!(err(&solve(&[])).contains(stays));
    for follows in ["film.gas=air", "film.mean_free_path_nm=130", "film.slip=none"] {
        assert_eq!(err(&solve(&["--set", follows])), "", "{follows}");
    }
    let sweep = |more: &[&str]| {
        let vary = ["sweep", "plate-crossover", "--fidelity", "draft", "--vary", "film.ambient_pressure_kpa=50,100"];
        run(&[&vary, more].concat())
    };
    assert!(err(&sweep(&[])).contains(stays));
    let air = sweep(&["--set", "film.gas=air", "--json"]);
    assert!(!err(&air).contains("mean free path"));
    let air = json(&air);
    let knudsen = |row: usize| air["rows"][row]["knudsen_number"].as_f64().unwrap();
    assert!(close(knudsen(0), 2.0 * knudsen(1)), "{air}");
}

#[test]
fn a_scene_outside_the_limits_of_the_model_says_so() {
    // The default law of slip holds for a mean gap of 1 µm, and not for the least, 0.5 µm.
    let exact = ["plate-crossover", "--set", "film.slip=fukui-kaneko"];
    assert_eq!(solved(&exact)["validity"], Value::Array(Vec::new()));
    let slip = &solved(&["plate-crossover"])["validity"][0];
    assert_eq!((&slip["name"], &slip["value"]), (&"slip-law".into(), &0.128.into()));
    let far = ["plate-crossover", "--set", "plate.mean_gap_um=500", "--set", "plate.frequency_khz=40"];
    let result = solved(&far);
    let names: Vec<&str> =
        result["validity"].as_array().unwrap().iter().map(|entry| entry["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["gas-inertia", "isothermal", "thinness"]);
    let first = &result["validity"][0];
    assert!((first["value"].as_f64().unwrap() - 348.3).abs() < 0.1 && first["limit"] == 0.1);
    assert!(first["text"].as_str().unwrap().starts_with("The inertia of the gas matters"));
    let output = run(&[&["solve", "--fidelity", "draft"], &far[..]].concat());
    for words in ["Outside the limits of the model", "gas-inertia: 348, limit 0.1.", "isothermal: 38.5, limit 1."] {
        assert!(out(&output).contains(words), "{words:?} is not in\n{}", out(&output));
    }
    assert!(!out(&run(&[&["solve", "--fidelity", "draft"], &exact[..]].concat())).contains("Outside the limits"));
}

#[test]
fn a_motor_pressed_all_round_the_wave_leads_with_its_stall_torque_and_warns() {
    let set = ["stator.frequency_khz=40", "motor.contact_radius_mm=60", "motor.waves=9", "motor.load_per_wave_n=16.67"];
    let arguments: Vec<&str> = ["solve", "fundamental", "--fidelity", "draft"]
        .into_iter()
        .chain(set.into_iter().flat_map(|set| ["--set", set]))
        .collect();
    let output = done(&arguments);
    let lines: Vec<&str> = out(&output).lines().collect();
    let place = |name: &str| lines.iter().position(|line| line.starts_with(name)).unwrap();
    let (stall, bound) = (place("  stall torque "), place("  maximum operating torque "));
    let words: Vec<&str> = lines[stall].split_whitespace().collect();
    let [value, error] = [words[2], words[4]].map(|word| word.parse::<f64>().unwrap());
    assert!(stall < bound && (value - 2.4845).abs() < error && error < 0.05, "{}", lines[stall]);
    assert!(lines[bound].contains(" 6.301") && lines[bound].contains("bound"), "{}", lines[bound]);
    for word in ["every tooth", "at all times", words[2], "6.301"] {
        assert!(err(&output).contains(word), "{word:?} is not in {}", err(&output));
    }
    // The contact of the fundamental case is near the crests: it is not warned of.
    assert_eq!(solved(&["fundamental"])["warnings"], Value::Array(Vec::new()));
}

#[test]
fn changes_reach_the_scene() {
    let smoother = solved(&["fundamental", "--set", "film.min_spacing_nm=100"]);
    assert!((smoother["alpha"].as_f64().unwrap() - 0.499).abs() < 0.01);
    let set = ["--set", "stator.tooth_radius_m=3", "--set", "stator.tooth_radius_m=none"];
    assert_eq!(
        solved(&[&["fundamental"][..], &set].concat())["film_load_n"],
        solved(&["fundamental", "--threads", "1"])["film_load_n"]
    );
}

#[test]
fn a_changed_preset_says_so_wherever_its_name_leads() {
    let folder = tempfile::tempdir().unwrap();
    let results = folder.path().to_str().unwrap();
    let arguments =
        ["solve", "fundamental", "--fidelity=draft", "--set=stator.tooth_radius_m=3", "--set=film.slip=none"];
    let output = run(&[&arguments[..], &["--out", results, "--figures", "svg"]].concat());
    let name = "Fundamental case, changed: 2 keys";
    let named = "Fundamental case, tooth radius 3 m, slip at the walls none";
    assert!(out(&output).starts_with(&format!("{name}: ")) && !out(&output).contains("first row"), "{}", out(&output));
    assert!(out(&output).contains("stator.tooth_radius_m = 3 m, was none"), "{}", out(&output));
    for (file, words) in [
        ("summary.json", format!("\"preset\": \"{name}\"")),
        ("scene.toml", format!("name = \"{name}\"")),
        // A figure has to tell by itself what was changed.
        ("wave.svg", named.to_owned()),
    ] {
        let text = fs::read_to_string(folder.path().join(file)).unwrap();
        assert!(text.contains(&words), "{file}");
    }
}

#[test]
fn forces_of_a_strip_are_named_per_metre_and_not_compared_with_newtons() {
    let folder = tempfile::tempdir().unwrap();
    let to = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let vary = ["--fidelity=draft", "--vary=plate.frequency_khz=10:20:2", "--figures=none"];
    for (changes, column) in [(&[][..], "film_load_min_n_per_m"), (&["--set=plate.width_mm=1"], "film_load_min_n")] {
        done(&[&["sweep", "plate-crossover", "--out", &to(column)][..], &vary, changes].concat());
        let text = fs::read_to_string(folder.path().join(column).join("sweep.csv")).unwrap();
        assert!(text.lines().next().unwrap().split(',').any(|name| name == column), "{text}");
    }
    let cycles =
        ["startup", "plate-crossover", "--fidelity=draft", "--cycles=2", "--figures=none", "--out", &to("start")];
    run(&cycles);
    let text = fs::read_to_string(folder.path().join("start/startup.csv")).unwrap();
    let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    assert!(head.contains(&"film_load_n_per_m") && head.contains(&"contact_load_n"), "{text}");
    assert_eq!(text.lines().count(), 3);

    let output = run(&["compare", "fundamental", "plate-crossover", "--fidelity", "draft"]);
    let line = out(&output).lines().find(|line| line.trim_start().starts_with("film load ")).unwrap().to_owned();
    assert!(line.contains(" N/m") && line.ends_with("N/m, not N"), "{line}");
    let squeeze = |presets: [&str; 2]| {
        let output = run(&[&["compare", "--fidelity", "draft"], &presets[..]].concat());
        out(&output).lines().find(|line| line.trim_start().starts_with("squeeze number")).unwrap().to_owned()
    };
    let line = squeeze(["floating-disc", "plate-crossover"]);
    assert!(line.contains(" by radius ") && line.ends_with("by length, not by radius"), "{line}");
    assert!(squeeze(["plate-viscous", "plate-crossover"]).ends_with("× 45.5"));
    let result = json(&done(&["compare", "fundamental", "plate-crossover", "--fidelity", "draft", "--json"]));
    assert_eq!((&result["runs"][0]["force_unit"], &result["runs"][1]["force_unit"]), (&"N".into(), &"N/m".into()));
    assert!(result["runs"][1]["difference_percent"].get("film_load_n").is_none());
}

#[test]
fn a_plate_that_is_dropped_says_where_it_will_float() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("drop");
    let drop =
        ["startup", "floating-disc", "--fidelity=draft", "--cycles=3", "--figures=svg", "--out", to.to_str().unwrap()];
    let output = run(&drop);
    let floating = &solved(&["floating-disc"])["floating"];
    let gap = floating["mean_gap_um"].as_f64().unwrap();
    let result: Value = serde_json::from_slice(&fs::read(to.join("startup.json")).unwrap()).unwrap();
    for name in ["mean_gap_um", "mean_gap_error_um"] {
        assert!((result[name].as_f64().unwrap() / floating[name].as_f64().unwrap() - 1.0).abs() < 1e-6, "{name}");
    }
    // From twice the height, at rest.
    let rows = result["rows"].as_array().unwrap();
    let number = |row: usize, name: &str| rows[row][name].as_f64().unwrap();
    assert_eq!((rows.len(), number(0, "speed_mm_per_s")), (4, 0.0));
    assert!((number(0, "height_um") / gap - 2.0).abs() < 1e-6 && number(3, "height_um") < number(0, "height_um"));
    assert_eq!((result["converged"].as_bool(), rows[3]["rests"].as_bool()), (Some(false), Some(false)));
    let text = out(&output);
    assert!(text.contains("STILL MOVING after 3 cycles"), "{text}");
    let one = run(&["startup", "plate-crossover", "--cycles", "1", "--fidelity", "draft"]);
    assert!(err(&one).contains("1 cycle, "), "{}", err(&one));
    assert!(text.contains(&format!("gives a mean gap of {}", &gap.to_string()[..4])), "{text}");
    let table = fs::read_to_string(to.join("startup.csv")).unwrap();
    assert_eq!(table.lines().count(), 5, "{table}");
    assert!(fs::read_to_string(to.join("startup.svg")).unwrap().contains("height"));
}

#[test]
fn bad_input_is_named_and_exits_with_2() {
    let motor = |change: &'static str| ["solve", "fundamental", "--set", change];
    refused(&motor("film.min_spacing_nm=3"), 2, &["film.min_spacing_nm", "= 3", "5 to 10000 nm"]);
    refused(&motor("film.min_spacing_nm=nan"), 2, &["film.min_spacing_nm", "NaN"]);
    refused(
        &["solve", "plate-viscous", "--set", "film.min_spacing_nm=100"],
        2,
        &["film.min_spacing_nm", "no effect on a plate"],
    );
    refused(&["sweep", "plate-viscous", "--vary", "film.min_spacing_nm=50:100:2"], 2, &["no effect on a plate"]);
    let contrary = ["solve", "fundamental", "--set", "film.shear=false", "--set", "numerics.wedge=on"];
    refused(&contrary, 2, &["film.shear", "numerics.wedge"]);
    let contrary = ["solve", "fundamental", "--set", "numerics.flow=across", "--set", "numerics.wedge=on"];
    refused(&contrary, 2, &["numerics.flow", "numerics.wedge"]);
    let light = ["startup", "floating-disc", "--set", "plate.amplitude_um=1000", "--fidelity", "draft"];
    refused(&light, 2, &["floats higher than 1000 µm"]);
    refused(&motor("film.slip=second"), 2, &["film.slip", "second-order"]);
    refused(&motor("film.min_spacing=100"), 2, &["unknown key film.min_spacing", "film.min_spacing_nm"]);
    refused(&motor("plate.length_mm=1"), 2, &["plate.length_mm", "motor"]);
    refused(&motor("film.min_spacing_nm"), 2, &["key=value"]);
    refused(&motor("=3"), 2, &["key=value"]);
    let two = ["solve", "fundamental", "--set", "film.min_spacing_nm=3", "--set", "motor.waves=0"];
    refused(&two, 2, &["film.min_spacing_nm", "motor.waves"]);
    refused(&["solve", "fundamentl"], 2, &["fundamentl", "did you mean fundamental?"]);
    refused(&["solve", "no/such/file.toml"], 2, &["no/such/file.toml"]);
    refused(&["solve", ""], 2, &["unknown preset"]);
    refused(&["solve", "."], 2, &["cannot be read"]);
    refused(&["solve"], 2, &["PRESET"]);
    refused(&["sovle", "fundamental"], 2, &["sovle", "solve"]);
    refused(&["fundamental"], 2, &["fundamental is a preset, not a command: squeezefilm solve fundamental"]);
    refused(&["fundamentel"], 2, &["unrecognized subcommand"]);
    refused(&["solve", "fundamental", "--accuracy", "-1%"], 2, &["from 0.0001% to 50%"]);
    refused(&["solve", "fundamental", "--fidelity", "best"], 2, &["draft, standard, fine, reference"]);
    refused(&["solve", "fundamental", "--method", "best"], 2, &["auto, paper"]);
    refused(&["solve", "fundamental", "--threads", "0"], 2, &["--threads", "expected a whole number from 1 to 1024"]);
    refused(&["solve", "plate-viscous", "--method", "paper"], 2, &["paper", "motors"]);
    refused(&["table1", "--converged", "--set", "film.min_spacing_nm=3"], 2, &["5 to 10000 nm"]);
    refused(&["table1", "--converged", "--method", "paper"], 2, &["--converged"]);
    let sweep = |vary: &'static str| ["sweep", "fundamental", "--vary", vary];
    refused(&sweep("film.min_spacing_nm=3:200:3"), 2, &["film.min_spacing_nm", "= 3", "5 to 10000 nm"]);
    refused(&sweep("film.min_spacing_nm=100:200"), 2, &["--vary", "key=from:to:count"]);
    refused(&sweep("film.min_spacing_nm=100:200:1"), 2, &["count = 1", "2 to 10000"]);
    refused(&sweep("film.slip=0:1:2"), 2, &["film.slip", "only a number"]);
    refused(&sweep("stator.tooth_width_mm=2.95:3:2"), 2, &["stator.tooth_width_mm", "= 2.95", "tooth pitch"]);
    refused(&sweep("film.slip=none,second"), 2, &["film.slip", "second-order"]);
    let four =
        ["film.slip=none,first-order", "motor.waves=7,8", "film.min_spacing_nm=100,200", "film.shear=true,false"];
    let four: Vec<&str> =
        ["sweep", "fundamental"].into_iter().chain(four.iter().flat_map(|vary| ["--vary", vary])).collect();
    refused(&four, 2, &["4 keys given", "1 to 3"]);
    refused(&["sweep", "fundamental"], 2, &["--vary"]);
    let varied = ["sweep", "fundamental", "--vary=motor.load_per_wave_n=1:2:3", "--set=motor.load_per_wave_n=1"];
    refused(&varied, 2, &["--set has no effect on motor.load_per_wave_n, which is varied"]);
    refused(&["sweep", "plate-viscous", "--vary=plate.length_mm=1:2:2", "--method=paper"], 2, &["paper", "motors"]);
    refused(&["presets", "--set", "film.min_spacing_nm=100"], 2, &["PRESET"]);
    refused(&["compare"], 2, &["PRESET"]);
    refused(&["compare", "fundamental", "fundamentl"], 2, &["fundamental"]);
    refused(&["compare", "fundamental", "plate-viscous", "--method", "paper"], 2, &["motors"]);
}

#[test]
fn a_scene_in_a_file_that_is_not_one_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    for (bytes, word) in [(&b"schema = 2\n"[..], "schema"), (b"\xff\xff", "UTF-8"), (b"a = [", "TOML"), (b"", "schema")]
    {
        fs::write(&path, bytes).unwrap();
        refused(&["solve", path.to_str().unwrap()], 2, &["mine.toml", word]);
    }
}

#[test]
fn shells_and_man_are_told_every_command() {
    let help = run(&["--help"]);
    let listed: Vec<&str> = out(&help)
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|command| *command != "help")
        .collect();
    assert!(listed.contains(&"solve") && listed.contains(&"man"), "{listed:?}");
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let script = done(&["completions", shell]);
        assert!(listed.iter().all(|command| out(&script).contains(command)), "{shell}");
    }
    let folder = tempfile::tempdir().unwrap();
    done(&["man", folder.path().to_str().unwrap()]);
    for command in listed {
        let page = std::fs::read_to_string(folder.path().join(format!("squeezefilm-{command}.1"))).unwrap();
        assert!(page.contains(".SH OPTIONS") && page.contains(".SH SYNOPSIS"), "{page}");
        let head = format!(".TH squeezefilm-{command} 1 {} ", squeezefilm::citation::RELEASED);
        assert!(page.contains(&head), "{head}: {page}");
    }
    assert!(folder.path().join("squeezefilm-lessons-check.1").is_file());
    // Examples keep their lines.
    let solve = std::fs::read_to_string(folder.path().join("squeezefilm-solve.1")).unwrap();
    let notes = &solve[solve.find(".SH NOTES\n.nf\n").unwrap()..];
    assert!(notes.contains("Examples:\n  squeezefilm solve fundamental\n") && notes.contains("\n.fi\n"), "{notes}");
    let program = std::fs::read_to_string(folder.path().join("squeezefilm.1")).unwrap();
    assert!(program.contains("Exit status") && program.contains("squeezefilm\\-solve(1)"), "{program}");
}

#[test]
fn help_and_version_go_to_standard_output() {
    for arguments in [&["--help"][..], &["help", "solve"], &["solve", "--help"], &["--version"], &["table1", "-h"]] {
        let output = run(arguments);
        assert_eq!((output.status.code(), err(&output)), (Some(0), ""), "{arguments:?}");
        assert!(!out(&output).is_empty());
    }
    // That two parts of a ring stay together is told where one of them is set.
    let help = out(&run(&["solve", "--help"])).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("the edge of that part moves with it"), "{help}");
}

/// A CSV file as columns by name. Every field is a finite number.
fn columns(path: &Path) -> BTreeMap<String, Vec<f64>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut columns: BTreeMap<String, Vec<f64>> = names.iter().map(|name| (name.clone(), Vec::new())).collect();
    for record in reader.records() {
        for (name, field) in names.iter().zip(&record.unwrap()) {
            // Where a rotor is not driven there is no efficiency.
            let none = field.is_empty() && name.contains("efficiency");
            let number: f64 = if none { f64::NAN } else { field.parse().unwrap() };
            assert!(none || number.is_finite(), "{name}");
            columns.get_mut(name).unwrap().push(number);
        }
    }
    columns
}

fn mean(series: &[f64]) -> f64 {
    series.iter().sum::<f64>() / series.len() as f64
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * (a.abs() + b.abs()) + 1e-12
}

#[test]
fn files_of_a_motor_agree_with_the_summary() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("a/b");
    let arguments = ["solve", "fundamental", "--fidelity", "draft", "--json", "--out", folder.to_str().unwrap()];
    let output = done(&arguments);
    assert!(err(&output).contains("series.csv"));

    let mut names: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    let figures = ["convergence", "loads", "map", "torque", "wave"]
        .iter()
        .flat_map(|f| ["png", "svg"].map(|e| format!("{f}.{e}")));
    let data = ["fields.csv", "fields.npz", "pressure.csv", "scene.toml", "series.csv", "summary.json", "torque.csv"]
        .map(str::to_owned);
    let mut expected: Vec<String> = figures.chain(data).collect();
    expected.sort();
    assert!(names.iter().eq(expected.iter().map(String::as_str)), "{names:?}");
    let summary: Value = serde_json::from_slice(&fs::read(folder.join("summary.json")).unwrap()).unwrap();
    assert_eq!(summary, json(&output));
    assert_eq!(summary["command"][0], "squeezefilm");
    let number = |key: &str| summary[key].as_f64().unwrap();

    let series = columns(&folder.join("series.csv"));
    let steps = summary["stats"]["steps_per_cycle"].as_u64().unwrap() as usize;
    let film = &series["film_load_n"];
    assert_eq!((film.len(), series.len()), (steps, 10));
    // A tooth is known to touch or not where it does not begin or end to.
    assert!(series["teeth_in_contact_error"].iter().all(|error| [0.0, 1.0, 2.0].contains(error)));
    // The mean of the series is the headline.
    assert!(close(mean(film), number("film_load_n")));
    assert!(series["film_load_error_n"].iter().all(|error| *error > 0.0 && *error < 0.1 * mean(film)));
    assert!(close(film.iter().copied().fold(f64::INFINITY, f64::min), number("film_load_min_n")));
    assert!(close(film.iter().copied().fold(0.0, f64::max), number("film_load_max_n")));
    assert!(close(mean(&series["teeth_in_contact"]), number("teeth_in_contact")));
    assert!(close(series["max_pressure_kpa"].iter().copied().fold(0.0, f64::max), number("max_pressure_kpa")));
    assert!(close(series["min_film_thickness_nm"].iter().copied().fold(f64::INFINITY, f64::min), number("min_gap_nm")));

    let fields = columns(&folder.join("fields.csv"));
    let nodes = summary["stats"]["contact_nodes"].as_u64().unwrap() as usize;
    assert_eq!(fields["time_s"].len(), steps * nodes);
    assert_eq!(fields["tooth"].iter().copied().fold(0.0, f64::max), 8.0);
    for step in 0..steps {
        let rows = step * nodes..(step + 1) * nodes;
        let sum = |name: &str| rows.clone().map(|row| fields[name][row] * fields["length_m"][row]).sum::<f64>();
        assert!(rows.clone().all(|row| close(fields["time_s"][row], series["time_s"][step])));
        assert!(close(sum("film_n_per_m"), film[step]), "step {step}");
        assert!(close(sum("contact_n_per_m"), series["contact_load_n"][step]), "step {step}");
        // x runs along one wavelength, and nothing is pressed into anything.
        assert!(rows.clone().skip(1).all(|row| fields["x_m"][row] > fields["x_m"][row - 1]));
        assert!(rows.clone().all(|row| fields["gap_nm"][row] >= -1e-6 && fields["contact_n_per_m"][row] >= 0.0));
        // Nine digits of a micrometre.
        let same = |a: f64, b: f64| (a - b).abs() < 1e-4;
        assert!(rows.clone().all(|row| same(fields["film_thickness_nm"][row], fields["gap_nm"][row] + 200.0)));
        let surfaces = |row: usize| (fields["rotor_nm"][row], fields["stator_nm"][row] + fields["gap_nm"][row]);
        assert!(rows.clone().map(surfaces).all(|(rotor, sum)| same(rotor, sum)));
    }

    let pressure = columns(&folder.join("pressure.csv"));
    let film_nodes = summary["stats"]["film_nodes"].as_u64().unwrap() as usize;
    assert_eq!(pressure["pressure_kpa"].len(), steps * film_nodes);
    assert!(pressure["y_m"].iter().all(|y| *y >= 0.0));
    assert!(close(pressure["pressure_kpa"].iter().copied().fold(0.0, f64::max), number("max_pressure_kpa")));

    let torque = columns(&folder.join("torque.csv"));
    let merit = |side: &str, key: &str| summary["merit"][side][key].as_f64().unwrap();
    assert!(close(torque["torque_nm"][0], merit("with_film", "stall_torque_nm")));
    assert_eq!(summary["stall_torque_nm"], summary["merit"]["with_film"]["stall_torque_nm"]);
    assert_eq!(summary["stall_torque_error_nm"], summary["merit"]["with_film"]["stall_torque_error_nm"]);
    assert!(close(merit("with_film", "max_torque_nm"), number("max_torque_nm")));
    assert!(close(merit("without_film", "max_torque_nm"), number("dry_torque_nm")));
    for (column, side) in [("torque_nm", "with_film"), ("dry_torque_nm", "without_film")] {
        // The no-load speed is among the speeds, and there the torque changes its sign.
        let speed = merit(side, "no_load_speed_rpm");
        let row = torque["speed_rpm"].iter().position(|rpm| close(*rpm, speed)).unwrap();
        assert!(torque[column][row].abs() < 1e-9 && torque[column][row - 1] > 0.0 && torque[column][row + 1] < 0.0);
    }

    // The scene that was written solves to the same, into the same folder.
    let scene = folder.join("scene.toml");
    let again = solved(&[scene.to_str().unwrap()]);
    assert_eq!(again["film_load_n"], summary["film_load_n"]);
    done(&arguments);
}

#[test]
fn files_of_a_strip_are_per_metre() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let summary = json(&done(&["solve", "plate-crossover", "--fidelity", "draft", "--json", "--out", path]));
    let series = columns(&folder.path().join("series.csv"));
    let fields = columns(&folder.path().join("fields.csv"));
    assert!(close(mean(&series["film_load_n_per_m"]), summary["film_load_n"].as_f64().unwrap()));
    let steps = series["time_s"].len();
    let loads = fields["film_n_per_m2"].iter().zip(&fields["length_m"]).map(|(load, length)| load * length);
    assert!(close(loads.sum::<f64>() / steps as f64, mean(&series["film_load_n_per_m"])));
    assert!(!fields.contains_key("contact_n_per_m"));
    // A plate has no torque; a motor no exact results.
    assert!(summary["merit"].is_null() && !folder.path().join("torque.csv").exists());
    assert!(folder.path().join("exact.svg").exists());
    let exact = |key: &str| summary["exact"][key].as_f64().unwrap();
    assert!(exact("invariant_deviation") < 1e-3 && exact("spring") > 0.0 && exact("damping") > 0.0);
    // The amplitude of the load over that of the gap, in either unit.
    let unit = 101.325e3 * 1e-3 / 1e-6;
    let omega = std::f64::consts::TAU * 1e3;
    for (same, key, unit) in [
        ("spring", "stiffness_n_per_m", unit),
        ("spring_error", "stiffness_error_n_per_m", unit),
        ("linear_spring", "linear_stiffness_n_per_m", unit),
        ("damping", "damping_n_s_per_m", unit / omega),
        ("damping_error", "damping_error_n_s_per_m", unit / omega),
        ("linear_damping", "linear_damping_n_s_per_m", unit / omega),
    ] {
        assert!(close(exact(key), exact(same) * unit), "{key}");
    }
    assert!(close(exact("mean_pressure_ratio"), 1.0 + summary["mean_load_ratio"].as_f64().unwrap()));
    assert!(solved(&["fundamental"])["exact"].is_null());
}

#[test]
fn figures_are_written_in_the_formats_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    for (formats, expected) in
        [("none", vec![]), ("pdf", vec!["loads.pdf"]), ("svg,pdf", vec!["loads.pdf", "loads.svg"])]
    {
        let out = folder.path().join(formats);
        let arguments =
            ["solve", "plate-viscous", "--fidelity", "draft", "--figures", formats, "--out", out.to_str().unwrap()];
        done(&arguments);
        let names = fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.filter(|name| name.starts_with("loads.")).collect();
        names.sort();
        assert_eq!(names, expected, "{formats}");
    }
    // The film at every instant, and a note where there is none.
    let out = folder.path().join("vtk");
    let vtk = ["--fidelity", "draft", "--figures", "vtk", "--out", out.to_str().unwrap()];
    done(&[&["solve", "plate-viscous"], &vtk[..]].concat());
    let series: Value = serde_json::from_slice(&fs::read(out.join("film.vtk.series")).unwrap()).unwrap();
    let files = series["files"].as_array().unwrap();
    assert!(files.len() > 30 && files.iter().all(|file| out.join(file["name"].as_str().unwrap()).exists()));
    refused(
        &[&["sweep", "plate-viscous", "--vary=plate.frequency_khz=1,2"], &vtk[..]].concat(),
        2,
        &["--figures vtk: only solve"],
    );
    refused(&["solve", "plate-viscous", "--figures", "jpg", "--out", "x"], 2, &["jpg", "svg, png, pdf, none"]);
    refused(&["solve", "plate-viscous", "--figures", "svg"], 2, &["--out"]);
    refused(&["compare", "plate-viscous", "--figures", "none,png", "--out", "x"], 2, &["--figures none", "alone"]);
    assert!(!Path::new("x").exists());
}

#[test]
fn a_cycle_is_animated() {
    let folder = tempfile::tempdir().unwrap();
    let animate = |out: &Path| {
        let arguments = ["animate", "plate-crossover", "--fidelity", "draft", "--width", "200", "--frames", "4"];
        run(&[&arguments[..], &["--out", out.to_str().unwrap()]].concat())
    };
    let mp4 = b"\0\0\0\x20ftypisom".as_slice();
    for (name, begins) in [("a.gif", b"GIF89a".as_slice()), ("a.png", b"\x89PNG"), ("a.mp4", mp4)] {
        let path = folder.path().join(name);
        let output = animate(&path);
        assert_eq!((output.status.code(), out(&output)), (Some(0), ""), "{}", err(&output));
        assert!(err(&output).contains("4 frames"), "{}", err(&output));
        let bytes = fs::read(&path).unwrap();
        assert!(bytes.starts_with(begins));
        let version = concat!("squeezefilm ", env!("CARGO_PKG_VERSION")).as_bytes();
        assert!(bytes.windows(version.len()).any(|part| part == version), "{name} says where it comes from");
    }
    let frames = folder.path().join("frames");
    assert_eq!(animate(&frames).status.code(), Some(0));
    assert_eq!(fs::read_dir(&frames).unwrap().count(), 4);
    fs::write(frames.join("frame-0005.png"), "").unwrap();
    assert!(err(&animate(&frames)).contains("1 frame of an earlier run there, from frame-0005.png on"));
    for name in ["a.gif", "a.mp4"] {
        let nowhere = folder.path().join("no").join(name);
        let told = [&format!("{name}: cannot be written"), "there is no folder"];
        refused(&["animate", "plate-crossover", "--out", nowhere.to_str().unwrap()], 1, &told);
    }
    refused(&["animate", "plate-crossover", "--out", "a.avi"], 2, &["a.avi", ".gif", ".mp4", ".png"]);
    refused(&["animate", "plate-crossover", "--out", "a.gif", "--seconds", "0"], 2, &["0.2 to 120"]);
}

#[test]
fn an_unwritable_folder_is_named_before_anything_is_solved() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "mine").unwrap();
    for path in [file.clone(), file.join("below")] {
        let path = path.to_str().unwrap();
        refused(&["solve", "plate-viscous", "--fidelity", "draft", "--json", "--out", path], 1, &[path]);
        refused(&["table1", "--converged", "--fidelity", "draft", "--out", path], 1, &[path]);
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// Rows that a sweep would go on with are read as any other file: a pipe, which nobody may ever write to, is not waited for.
#[cfg(unix)]
#[test]
fn a_pipe_in_the_place_of_saved_rows_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("sweep.incomplete.csv");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let vary = "film.min_spacing_nm=50:100:2";
    let output = run(&["sweep", "fundamental", "--vary", vary, "--out", folder.path().to_str().unwrap()]);
    assert!(!output.status.success());
    let told = err(&output);
    assert!(told.contains("cannot be continued") && told.contains("a pipe or a device"), "{told}");
}

#[test]
fn a_folder_where_a_file_would_be_is_told_before_anything_is_solved() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("summary.json"), "older").unwrap();
    fs::create_dir(folder.path().join("series.csv")).unwrap();
    let path = folder.path().to_str().unwrap();
    let arguments = ["solve", "plate-viscous", "--fidelity", "draft", "--json", "--out", path];
    refused(&arguments, 1, &["series.csv: cannot be written: it is a folder"]);
    assert_eq!(fs::read_to_string(folder.path().join("summary.json")).unwrap(), "older");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    // Of several presets, each in its own folder.
    let several = folder.path().join("several");
    fs::create_dir_all(several.join("levitating/film.vtk.series")).unwrap();
    let several_path = several.to_str().unwrap();
    let presets = ["solve", "plate-viscous", "levitating", "--fidelity", "draft", "--out", several_path];
    refused(&presets, 1, &["film.vtk.series: cannot be written: it is a folder"]);
    assert!(!several.join("plate-viscous").exists());
}

#[test]
fn several_presets_are_solved_each_into_its_own_folder() {
    let folder = tempfile::tempdir().unwrap();
    let mine = folder.path().join("plate-viscous.toml");
    fs::write(&mine, &run(&["presets", "plate-viscous"]).stdout).unwrap();
    let out_dir = folder.path().join("out");
    let presets = ["plate-viscous", mine.to_str().unwrap(), "rotor-width-0.6mm"];
    let rest = ["--fidelity", "draft", "--figures", "none", "--quiet", "--out", out_dir.to_str().unwrap()];
    let output = run(&[&["solve", "--json"], &presets[..], &rest].concat());
    assert_eq!((output.status.code(), err(&output)), (Some(0), ""));
    let all: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(all.len(), 3);
    for (name, object) in ["plate-viscous", "plate-viscous (2)", "rotor-width-0.6mm"].iter().zip(&all) {
        let summary = fs::read(out_dir.join(name).join("summary.json")).unwrap();
        assert_eq!(&serde_json::from_slice::<Value>(&summary).unwrap(), object, "{name}");
    }
    let output = run(&[&["solve"], &presets[..2], &["--fidelity", "draft"]].concat());
    assert_eq!(out(&output).matches("Plate, viscous: converged").count(), 2, "{}", out(&output));
    refused(&["solve", "fundamental", "plate-viscous", "--method", "paper"], 2, &["motors"]);
    refused(&["solve", "fundamental", "fundamentl"], 2, &["did you mean fundamental?"]);
}

#[test]
fn a_preset_is_read_from_standard_input() {
    let toml = run(&["presets", "fundamental", "--set", "film.min_spacing_nm=100"]).stdout;
    let output = with_input(&["solve", "-", "--fidelity", "draft", "--json"], &toml);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let piped = json(&output);
    assert_eq!(piped["film_load_n"], solved(&["fundamental", "--set", "film.min_spacing_nm=100"])["film_load_n"]);
    let output = with_input(&["compare", "-"], b"schema = 2\n");
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("standard input:1: schema"), "{}", err(&output));
}

#[test]
fn a_table_and_a_face_are_read_from_standard_input_and_nothing_is_written_to_it() {
    let told = |arguments: &[&str], text: &str| {
        let output = with_input(arguments, text.as_bytes());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", err(&output));
        err(&output).to_owned()
    };
    let fit = ["fit", "fundamental", "--vary", "rotor.decay_length_mm=2:6", "--data", "-"];
    assert!(told(&fit, "alpha\nhigh\n").contains("standard input:2: column alpha: high is not a number"));
    assert!(told(&fit, "").contains("standard input: it is empty"));
    let face = "# dx_um = 1\n# dy_um = 1\n# height = nm\n1,2\n3,4\n";
    assert!(told(&["surface", "-"], face).contains("standard input: 2 × 2 points"));
    // It would be a file, or a folder, of this name.
    let folder = tempfile::tempdir().unwrap();
    for arguments in [
        &["solve", "fundamental", "--out", "-"][..],
        &["table1", "--out", "-"],
        &["animate", "fundamental", "--out", "-"],
        &["presets", "fundamental", "--out", "-"],
        &["new", "-", "--diameter-mm", "60", "--frequency-khz", "40", "--load-n", "150"],
        &["man", "-"],
        &["join", "-"],
    ] {
        let output = squeezefilm(arguments).current_dir(folder.path()).output().unwrap();
        assert_eq!((output.status.code(), out(&output)), (Some(2), ""), "{arguments:?}");
        assert!(err(&output).contains("only a preset, fit --data and surface"), "{arguments:?}: {}", err(&output));
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn sizes_that_a_preset_does_not_give_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    fs::write(&path, "schema = 1\nscene = \"plate\"\n[plate]\nshape = \"disc\"\nmass_g = 50\namplitude_um = 5\n")
        .unwrap();
    let solve = ["solve", path.to_str().unwrap(), "--fidelity", "draft", "--set", "plate.frequency_khz=30"];
    let told = err(&run(&solve)).to_owned();
    let assumed = "assumed, since they are not given: plate.radius_mm = 10 mm, film.min_spacing_nm = 200 nm, film.ambient_pressure_kpa = ";
    assert!(told.contains(assumed) && !told.contains("frequency_khz ="), "{told}");
    let vary = ["--vary", "plate.amplitude_um=4,5", "--set", "plate.frequency_khz=30"];
    assert!(
        err(&run(&[&["sweep", path.to_str().unwrap(), "--fidelity", "draft"][..], &vary].concat())).contains(assumed)
    );
    assert!(!err(&run(&["solve", "floating-disc", "--fidelity", "draft"])).contains("assumed"));
    // What a change brings with it is not given either.
    let changes = ["--set", "plate.mass_g=none", "--set", "plate.amplitude_um=0.5"];
    let told = err(&run(&[&["solve", "floating-disc", "--fidelity", "draft"][..], &changes].concat())).to_owned();
    assert!(told.contains("floating-disc: assumed, since they are not given: plate.mean_gap_um = 1 µm\n"), "{told}");
}

#[test]
fn a_command_replaces_none_of_its_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let (out, scene, data) = (folder.path(), folder.path().join("scene.toml"), folder.path().join("fit.csv"));
    let words = |path: &Path| path.to_str().unwrap().to_owned();
    let written = run(&["presets", "fundamental", "--set", "film.min_spacing_nm=150"]).stdout;
    let noted = [b"# With the worn rotor.\n", &written[..]].concat();
    fs::write(&scene, &noted).unwrap();
    fs::write(&data, "motor.load_per_wave_n,alpha\n2,0.3\n3,0.2\n").unwrap();
    let kept = fs::read(&data).unwrap();
    let into = ["--fidelity", "draft", "--out", &words(out)];
    let vary = ["--vary", "film.min_spacing_nm=50:1000", "--data", &words(&data)];
    let (scene_word, fit) = (words(&scene), [&["fit", "fundamental"][..], &vary, &into].concat());
    for (arguments, path) in [([&["solve", &scene_word][..], &into].concat(), &scene), (fit, &data)] {
        let output = run(&arguments);
        let told = err(&output);
        assert!(!output.status.success() && told.contains(path.file_name().unwrap().to_str().unwrap()), "{told}");
        assert!(told.contains("it is an input of this command"), "{told}");
    }
    assert!(fs::read(&scene).unwrap() == noted && fs::read(&data).unwrap() == kept);
    assert!(!out.join("summary.json").exists());
    // What would be written again as it is, is no loss.
    fs::write(&scene, &written).unwrap();
    done(&[&["solve", &scene_word][..], &into].concat());
}

#[test]
fn a_new_motor_is_made_of_options_or_of_answers() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let path = file.to_str().unwrap();
    let given = ["new", path, "--diameter-mm", "60", "--frequency-khz", "40", "--load-n", "150", "--altitude-m", "-30"];
    let output = run(&given);
    assert_eq!((output.status.code(), out(&output)), (Some(0), ""), "{}", err(&output));
    for words in ["Assumed, and why:", "film.min_spacing_nm", "measure the surfaces", "wrote "] {
        assert!(err(&output).contains(words), "{words:?} is not in\n{}", err(&output));
    }
    assert_eq!(solved(&[path])["preset"], "My motor");
    // An answer that was changed is told, however quiet it is.
    let uneven = done(&["new", "--teeth", "10", "--quiet", given[2], given[3], given[4], given[5], given[6], given[7]]);
    assert!(err(&uneven).starts_with("warning: The motor has 9 teeth, not 10: "), "{}", err(&uneven));
    refused(&given, 2, &["there is such a file already; --replace replaces it"]);
    done(&[&given[..], &["--replace"]].concat());
    // What is not given is asked for, again where the answer is refused; the end of the answers leaves the rest to assumptions.
    let asked = with_input(&["new", "--diameter-mm", "60"], b"Mine\nfast\n40\n\n150\n9\n");
    assert_eq!(asked.status.code(), Some(0), "{}", err(&asked));
    assert!(err(&asked).contains("Frequency, kHz: ") && err(&asked).contains("frequency-khz = fast is not accepted"));
    let piped = json(&with_input(&["solve", "-", "--fidelity", "draft", "--json"], &asked.stdout));
    assert_eq!(piped["preset"], "Mine");
    // The answers end behind a question: what is missing stands on lines of its own.
    refused(
        &["new", "--diameter-mm", "60"],
        2,
        &["[My motor]: \nerror: frequency-khz is missing", "\nerror: load-n is missing", "from 0.01 to 10000 N"],
    );
    refused(
        &["new", "--load-n", "heavy"],
        2,
        &["load-n = heavy is not accepted: expected a number from 0.01 to 10000 N"],
    );
    let nowhere = folder.path().join("no/such.toml");
    refused(&[&["new", nowhere.to_str().unwrap()], &given[2..]].concat(), 2, &["no: there is no such folder"]);
}

/// A name that is a formula to a spreadsheet, moves the cursor of a terminal, turns the direction of text, and is long.
const HOSTILE: &str = "name==HYPERLINK(1)\u{1b}[2J\u{202e}\u{9b}1m";

#[test]
fn names_do_nothing_to_terminals_spreadsheets_and_reports() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let name = format!("{HOSTILE}{}", "x".repeat(5000));
    let rest = ["--set", &name, "--fidelity", "draft", "--out", path, "--figures", "svg"];
    let harmless = |text: &str| !text.chars().any(|c| (c.is_control() && c != '\n') || c == '\u{202e}');
    for command in [&["compare", "plate-viscous", "plate-crossover"][..], &["solve", "plate-viscous"]] {
        let output = done(&[command, &rest].concat());
        assert!(harmless(out(&output)) && harmless(err(&output)), "{}", out(&output));
        let title = out(&output).lines().find(|line| line.contains("=HYPERLINK(1)\\u{1b}[2J\\u{202e}")).unwrap();
        assert!(title.contains("xxx…") && title.chars().count() < 150, "{title}");
    }
    for name in ["report.html", "loads.svg"] {
        let text = fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(harmless(&text.replace("\t", "")) && text.contains("=HYPERLINK(1)"), "{name}");
    }
    for name in ["compare.csv", "parameters.csv"] {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(folder.path().join(name)).unwrap();
        let cells: Vec<String> =
            reader.records().flat_map(|row| row.unwrap().iter().map(str::to_owned).collect::<Vec<_>>()).collect();
        assert!(cells.iter().any(|cell| cell.starts_with("'=HYPERLINK")), "{name}");
        let formula = |cell: &&String| cell.starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err();
        assert_eq!(cells.iter().find(formula), None, "{name}");
    }
}

#[test]
fn words_and_three_keys_are_swept_and_points_that_are_no_scene_are_marked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let vary = [
        "--vary=film.slip=first-order,fukui-kaneko",
        "--vary=motor.waves=8:20:2",
        "--vary=film.min_spacing_nm=100,200",
    ];
    let output = run(&[&["sweep", "fundamental", "--fidelity=draft", "--json", "--out", path], &vary[..]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let object = json(&output);
    assert_eq!(
        (&object["axes"][0]["values"][1], &object["axes"][0]["scale"]),
        (&"fukui-kaneko".into(), &"list".into())
    );
    let rows = object["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 8);
    for row in rows {
        let sound = row["motor.waves"] == 8.0;
        assert_eq!(row["status"] == "converged", sound, "{row}");
        assert!(sound || row["status"].as_str().unwrap().contains("tooth pitch"), "{row}");
    }
    let text = fs::read_to_string(folder.path().join("sweep.csv")).unwrap();
    assert!(text.lines().nth(5).unwrap().contains(",4,fukui-kaneko,8.0,100.0,converged,"), "{text}");
    let svg = fs::read_to_string(folder.path().join("sweep.svg")).unwrap();
    assert_eq!(svg.matches("data-area").count(), 2);
    assert!(err(&output).contains("film.slip = first-order, motor.waves = 20"), "{}", err(&output));
}

#[test]
fn presets_are_listed_and_printed_as_files() {
    let listed = run(&["presets"]);
    assert_eq!((listed.status.code(), err(&listed)), (Some(0), ""));
    let objects = run(&["presets", "--json"]);
    let objects: Vec<Value> = serde_json::from_slice(&objects.stdout).unwrap();
    assert_eq!(objects.len(), 25);
    for object in &objects {
        let name = object["preset"].as_str().unwrap();
        assert!(out(&listed).contains(&format!("\n  {name} ")), "{name}");
        assert!(object["about"].is_string() && object["group"].is_string());
    }
    let printed = run(&["presets", "fundamental"]);
    assert!(out(&printed).contains("\nschema = 1\n") && out(&printed).contains("inferred"));
    let folder = tempfile::tempdir().unwrap();
    let mine = folder.path().join("my.toml");
    let changed = run(&["presets", "fundamental", "--set", "film.min_spacing_nm=100"]);
    fs::write(&mine, &changed.stdout).unwrap();
    let as_file = solved(&[mine.to_str().unwrap()]);
    assert_eq!(as_file["film_load_n"], solved(&["fundamental", "--set", "film.min_spacing_nm=100"])["film_load_n"]);
}

#[test]
fn every_number_of_a_preset_has_an_error_or_is_exact() {
    let names = squeezefilm::scene::presets::BUILT_IN.iter().map(|preset| preset.name);
    let solved = done(&[&["solve", "--fidelity", "draft"][..], &names.collect::<Vec<_>>()].concat());
    assert!(!out(&solved).contains("not estimated"), "{}", out(&solved));
    let plates = out(&solved).lines().filter(|line| line.trim_start().starts_with("least film thickness"));
    let given = plates.filter(|line| line.contains("the mean gap is") && !line.contains('±')).count();
    assert!(given >= 4, "{}", out(&solved));
}

#[test]
fn table_1_has_14_rows_each_near_the_published_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let arguments = ["table1", "--converged", "--fidelity", "draft", "--threads", "2"];
    let output = done(&[&arguments[..], &["--json", "--out", path]].concat());
    let rows: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(rows.len(), 14);
    for row in &rows {
        let difference = row["difference_percent"].as_f64().unwrap();
        let limit = if row["row"] == "rotor_width_0.6mm" { 15.0 } else { 9.0 };
        assert!((-2.0..limit).contains(&difference), "{row}");
        assert!(row["converged"] == true && row["alpha_error"].as_f64().unwrap() < 0.02);
    }
    // Mesh-converged, a doubled mesh is the fundamental case.
    assert_eq!(rows[0]["film_load_n"], rows[1]["film_load_n"]);

    let mut reader = csv::Reader::from_path(folder.path().join("table1.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let load = header.iter().position(|name| name == "film_load_n").unwrap();
    for (record, row) in reader.records().zip(&rows) {
        assert!(close(record.unwrap()[load].parse().unwrap(), row["film_load_n"].as_f64().unwrap()));
    }
    let table = done(&arguments);
    assert!(rows.iter().all(|row| out(&table).contains(row["row"].as_str().unwrap())));

    // A row that cannot be solved says so, and the others are solved.
    let lining = ["--set", "rotor.part.lining.r_inner_mm=28.85", "--set", "rotor.part.lining.r_outer_mm=29.15"];
    let one_less = run(&[&arguments[..], &["--json", "--set", "rotor.model=ring"], &lining].concat());
    assert_eq!(one_less.status.code(), Some(2), "{}", err(&one_less));
    assert!(err(&one_less).contains("rotor_width_0.6mm: rotor.model = \"ring\""), "{}", err(&one_less));
    let rows: Vec<Value> = serde_json::from_slice(&one_less.stdout).unwrap();
    assert_eq!(rows.iter().filter(|row| row["converged"] == true).count(), 13);
}

#[test]
fn a_reader_that_leaves_is_told_by_the_status_and_costs_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let solve = ["solve", "plate-viscous", "--fidelity", "draft", "--figures", "none", "--quiet", "--out", path];
    for arguments in [&["presets"][..], &solve, &["--help"]] {
        // It has left before the program begins: a pipe takes as much as this without a reader.
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = squeezefilm(arguments).stdout(writer).output().unwrap();
        assert_eq!((output.status.code(), err(&output)), (Some(141), ""), "{arguments:?}");
    }
    assert!(folder.path().join("summary.json").is_file() && folder.path().join("fields.npz").is_file());
}

/// A solve that takes minutes.
#[cfg(unix)]
const LONG: [&str; 10] = [
    "solve",
    "fundamental",
    "--fidelity",
    "reference",
    "--set",
    "numerics.film_nodes_along=201",
    "--set",
    "numerics.film_nodes_across=201",
    "--set",
    "numerics.steps_per_cycle=900",
];

#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_long_solve_and_leaves_no_file() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("out");
    // The paper's own meshes and algorithm: 20 s where the engine's take half a second.
    let table = ["table1", "--threads", "1"];
    let sweep = ["sweep", "fundamental", "--vary=motor.load_per_wave_n=1:5:5", "--fidelity=reference", "--threads=1"];
    let sets: Vec<&str> = LONG[4..].to_vec();
    let sweep = [&sweep[..], &sets].concat();
    for arguments in [&LONG[..], &table, &sweep] {
        let interrupted_after = |milliseconds| {
            let child = squeezefilm(arguments)
                .args(["--json", "--out", folder.to_str().unwrap()])
                .stdout(Stdio::piped())
                .stderr(Stdio::piped())
                .spawn()
                .unwrap();
            std::thread::sleep(std::time::Duration::from_millis(milliseconds));
            assert!(
                std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success()
            );
            child.wait_with_output().unwrap()
        };
        // The solve takes far longer. Of a program that has not yet begun to listen, the signal itself is the end.
        let mut output = interrupted_after(500);
        if output.status.code().is_none() {
            output = interrupted_after(5000);
        }
        assert_eq!((output.status.code(), out(&output)), (Some(1), ""), "{}", err(&output));
        assert!(err(&output).starts_with("cancelled"), "{}", err(&output));
        assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 0);
    }
}

#[test]
fn what_does_not_converge_is_reported_marked_and_exits_with_3() {
    // The paper's alternation diverges for a stiff film; ours solves the same scene (tests/motor.rs).
    let coarse = ["film_nodes_along=21", "film_nodes_across=7", "contact_nodes=91", "steps_per_cycle=60"];
    let mut arguments = vec!["solve", "fundamental", "--method", "paper", "--set", "film.min_spacing_nm=20"];
    let sets: Vec<String> = coarse.iter().map(|set| format!("--set=numerics.{set}")).collect();
    arguments.extend(sets.iter().map(String::as_str));
    arguments.push("--json");
    let output = run(&arguments);
    assert_eq!(output.status.code(), Some(3), "{}", err(&output));
    let result = json(&output);
    assert_eq!((&result["converged"], &result["status"]), (&Value::from(false), &Value::from("not converged")));
    assert!(result["alpha"].is_number() && result["residual"].as_f64() > result["tolerance"].as_f64());
    assert!(!result["warnings"].as_array().unwrap().is_empty());
    arguments.pop();
    let output = run(&arguments);
    assert_eq!(output.status.code(), Some(3));
    assert!(
        out(&output).contains("NOT CONVERGED: further rounds would still change the result by"),
        "{}",
        out(&output)
    );
}

#[test]
fn a_preset_is_written_into_a_file_and_read_from_what_powershell_makes_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let output = run(&["presets", "levitating", "--out", &at("mine.toml")]);
    let wrote = format!("wrote {}\n", at("mine.toml"));
    assert_eq!((output.status.code(), out(&output), err(&output)), (Some(0), "", &*wrote));
    let text = fs::read_to_string(at("mine.toml")).unwrap();
    assert_eq!(text, out(&run(&["presets", "levitating"])));
    let utf16: Vec<u8> =
        ["\u{feff}", &text].concat().replace('\n', "\r\n").encode_utf16().flat_map(u16::to_le_bytes).collect();
    fs::write(at("theirs.toml"), &utf16).unwrap();
    let read = run(&["presets", &at("theirs.toml")]);
    assert_eq!((read.status.code(), out(&read)), (Some(0), out(&run(&["presets", &at("mine.toml")]))));
    assert_eq!(with_input(&["presets", "-"], &utf16).stdout, read.stdout);
    refused(&["presets", "--out", &at("all.toml")], 2, &["PRESET"]);
    let mut permissions = fs::metadata(at("mine.toml")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(at("mine.toml"), permissions).unwrap();
    // What was edited is lost only if that is wished.
    let again = ["presets", "fundamental", "--out", &at("mine.toml")];
    refused(&again, 2, &["there is such a file already; --replace replaces it"]);
    refused(&[&again[..], &["--replace"]].concat(), 1, &["mine.toml: cannot be written: it is read-only"]);
    refused(&["presets", "fundamental", "--out", &at("none/mine.toml")], 1, &["there is no folder", "none"]);
}

#[test]
fn what_is_less_sure_than_it_seems_is_said() {
    let few = run(&["sweep", "fundamental", "--vary", "motor.waves=5:7:9", "--fidelity", "draft"]);
    assert!(err(&few).contains("motor.waves is a whole number: 3 different values, not 9"), "{}", err(&few));
    let thin = run(&["solve", "fundamental", "--set", "film.min_spacing_nm=5", "--fidelity", "draft"]);
    assert!(err(&thin).contains("is not resolved at this fidelity"), "{}", err(&thin));
    let wide = ["sensitivity", "fundamental", "--fidelity", "draft", "--uncertainty", "film.min_spacing_nm=500%"];
    assert!(out(&run(&wide)).contains("more uncertain than they are large, to first order"));
    let wide = ["sensitivity", "fundamental", "--fidelity", "draft", "--uncertainty", "film.min_spacing_nm=50%"];
    let drawn = run(&[&wide[..], &["--monte-carlo", "400"]].concat());
    let words: String = out(&drawn).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains(
            "Film share of the load α, stall torque, no-load speed: the mean of the random scenes is not the value"
        ),
        "{words}"
    );
}

#[test]
fn a_small_mean_load_is_resolved_on_a_grid_that_is_given() {
    let grid = ["numerics.film_nodes_along=17", "numerics.film_nodes_across=9", "numerics.steps_per_cycle=108"];
    let given: Vec<&str> = grid.iter().flat_map(|key| ["--set", key]).collect();
    let [own, given] = [solved(&["plate-mems"]), solved(&[&["plate-mems"], &given[..]].concat())];
    let [load, error] =
        ["film_load_n", "film_load_error_n"].map(|key| [&own, &given].map(|one| one[key].as_f64().unwrap()));
    assert!(error[1] < 5e-3 * load[1], "{load:?} ± {error:?}");
    assert!((load[0] - load[1]).abs() < error[0] + error[1], "{load:?} ± {error:?}");
}

#[test]
fn a_point_that_cannot_be_solved_is_named_once() {
    let output = run(&["sweep", "fundamental", "--vary", "stator.tooth_width_mm=2:4:2", "--fidelity", "draft"]);
    let said = err(&output);
    assert_eq!(said.matches("stator.tooth_width_mm = 4").count(), 1, "{said}");
}

// A display is looked for beforehand on Linux alone.
#[cfg(target_os = "linux")]
#[test]
#[cfg(feature = "gui")]
fn the_window_without_a_display_names_the_headless_command() {
    for arguments in [&[][..], &["gui"], &["gui", "levitating"]] {
        let output = squeezefilm(arguments).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {}", err(&output));
        assert!(err(&output).contains("squeezefilm solve fundamental"), "{}", err(&output));
    }
    refused(&["gui", "levitatin"], 2, &["levitating"]);
}

#[test]
fn measured_faces_are_read_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let face = |size: usize| {
        let height = |i: usize| 40.0 * (0.7 * (i % size) as f64).sin() + 30.0 * (0.5 * (i / size) as f64).cos();
        let row = |iy: usize| (0..size).map(|ix| height(iy * size + ix).to_string()).collect::<Vec<_>>().join(",");
        let rows: String = (0..size).map(|iy| row(iy) + "\n").collect();
        format!("# dx_um = 0.5\n# dy_um = 0.5\n# height = nm\n{rows}")
    };
    fs::write(at("rotor.csv"), face(64)).unwrap();
    fs::write(at("stator.csv"), face(48)).unwrap();
    let output = run(&["surface", &at("rotor.csv"), &at("stator.csv"), "--json", "--out", &at("out"), "--quiet"]);
    assert_eq!((output.status.code(), err(&output)), (Some(0), ""));
    let told = json(&output);
    assert_eq!(told["faces"].as_array().unwrap().len(), 2);
    let sizes = [0, 1].map(|face| told["faces"][face]["sz_nm"].as_f64().unwrap());
    assert!((told["min_spacing_nm"].as_f64().unwrap() - 0.5 * (sizes[0] + sizes[1])).abs() < 1e-9, "{told}");
    for name in ["surface.json", "surface.toml", "face-1.svg", "face-2.png"] {
        assert!(Path::new(&at("out")).join(name).is_file(), "{name}");
    }
    assert!(out(&run(&["surface", &at("stator.csv")])).contains("Both faces are taken to be like it"));
    fs::write(at("bare.csv"), "1,2\n3,4\n").unwrap();
    refused(&["surface", &at("bare.csv")], 2, &["bare.csv", "unit of the heights", "# height = nm"]);
    refused(&["surface", &at("absent.csv")], 2, &["absent.csv", "cannot be read"]);
    fs::write(
        at("flat.csv"),
        format!("# dx_um = 1\n# dy_um = 1\n# height = nm\n{}", (["0"; 20].join(",") + "\n").repeat(20)),
    )
    .unwrap();
    refused(&["surface", &at("flat.csv")], 2, &["flat.csv", "nothing is left"]);
}
