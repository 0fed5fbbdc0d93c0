//! Scenes as a user meets them: files, `--set`, messages, saving.

// clippy.toml allows this inside #[test] functions; the helpers of this file are tests too.
#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use squeezefilm::dimensionless::Dimensionless;
use squeezefilm::input::ReadError;
use squeezefilm::problem::{Gas, Motor, Problem, RotorCompliance};
use squeezefilm::scene::{
    FaultKind, PARAMETERS, Parameter, ParameterKind, Range, Scene, SceneError, Value, heights, presets, table1,
};
use squeezefilm::surface::texture::{Pair, measured};
use std::path::Path;

fn read(text: &str) -> Result<Scene, SceneError> {
    Scene::from_toml(text, "my.toml")
}

/// The message for a motor file of these lines after `schema` and `scene`, so that the first is line 3.
fn message(lines: &str) -> String {
    read(&format!("schema = 1\nscene = \"motor\"\n{lines}")).unwrap_err().to_string()
}

/// The motor of a scene.
fn motor(scene: &Scene) -> Motor {
    Problem::try_from(scene).unwrap().scenario.motor().unwrap().clone()
}

fn dimensionless(scene: &Scene) -> Dimensionless {
    Dimensionless::of(&Problem::try_from(scene).unwrap())
}

fn plate_message(lines: &str) -> String {
    read(&format!("schema = 1\nscene = \"plate\"\n{lines}")).unwrap_err().to_string()
}

// ---- reading

#[test]
fn an_empty_file_of_the_schema_is_the_fundamental_case() {
    let mut fundamental = presets::find("fundamental").unwrap();
    let bare = read("schema = 1\n").unwrap();
    assert_eq!(bare, Scene::motor());
    fundamental.name = bare.name.clone();
    fundamental.about = bare.about.clone();
    assert_eq!(fundamental, bare);
}

#[test]
fn a_plate_without_a_width_is_a_strip() {
    let strip = read("schema = 1\nscene = \"plate\"\n").unwrap();
    assert_eq!(strip, Scene::plate());
    assert_eq!(strip.get("plate.width_mm"), None);
    let plate = read("schema = 1\nscene = \"plate\"\n[plate]\nwidth_mm = 1\n").unwrap();
    assert_eq!(plate.get("plate.width_mm"), Some(Value::Number(1.0)));
}

#[test]
fn whole_numbers_inline_tables_and_dotted_keys_are_read() {
    let scene = read("schema = 1\nmotor = { waves = 7, load_per_wave_n = 2 }\nfilm.min_spacing_nm = 1_00\n").unwrap();
    assert_eq!(scene.get("motor.load_per_wave_n"), Some(Value::Number(2.0)));
    assert_eq!(scene.get("film.min_spacing_nm"), Some(Value::Number(100.0)));
    assert_eq!(
        read("\u{feff}schema = 1\r\n[motor]\r\nwaves = 6\r\n").unwrap().get("motor.waves"),
        Some(Value::Whole(6))
    );
    // As --set takes it.
    assert_eq!(read("schema = 1\n[motor]\nwaves = 6.0\n").unwrap().get("motor.waves"), Some(Value::Whole(6)));
}

// ---- messages

#[test]
fn messages_name_file_line_key_value_and_range() {
    for (lines, expected) in [
        ("[film]\nmin_spacing_nm = 3\n", "my.toml:4: film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm"),
        ("[film]\n\nmin_spacing = 200\n", "my.toml:5: unknown key film.min_spacing: did you mean film.min_spacing_nm?"),
        (
            "[motor]\nfrequency_khz = 30\n",
            "my.toml:4: unknown key motor.frequency_khz: did you mean stator.frequency_khz?",
        ),
        ("waves = 7\n", "my.toml:3: unknown key waves: did you mean motor.waves?"),
        (
            "[film]\nqqq = 1\n",
            "my.toml:4: unknown key film.qqq: known are film.min_spacing_nm, film.gas, \
             film.ambient_pressure_kpa, film.viscosity_upa_s, film.mean_free_path_nm, film.slip, film.shear",
        ),
        ("[flim]\nslip = \"none\"\n", "my.toml:3: unknown table [flim]: did you mean [film]?"),
        ("film = 3\n", "my.toml:3: film = 3 is not a table: write [film] with its keys below"),
        ("[[film]]\nshear = true\n", "is not a table: write [film]"),
        (
            "[motor]\nwaves = 7.5\n",
            "my.toml:4: motor.waves = 7.5 is of the wrong type: expected a whole number from 1 to 100",
        ),
        (
            "[motor]\nload_per_wave_n = \"2\"\n",
            "my.toml:4: motor.load_per_wave_n = \"2\" is of the wrong type: expected a number from 0.01 to 100 N",
        ),
        ("[film]\nshear = 1\n", "my.toml:4: film.shear = 1 is of the wrong type: expected true or false"),
        (
            "[film]\nviscosity_upa_s = nan\n",
            "my.toml:4: film.viscosity_upa_s = NaN is not finite: expected a number from 1 to 1000 µPa·s",
        ),
        ("[film]\nviscosity_upa_s = -inf\n", "my.toml:4: film.viscosity_upa_s = -inf is not finite"),
        ("[motor]\nwaves = inf\n", "my.toml:4: motor.waves = inf is not finite: expected a whole number"),
        ("[motor]\nwaves = 0\n", "my.toml:4: motor.waves = 0 is out of range: allowed 1 to 100"),
        ("[motor]\nwaves = -1\n", "my.toml:4: motor.waves = -1 is out of range: allowed 1 to 100"),
        ("[motor]\nwaves = 99999999999999999999\n", "my.toml:4: motor.waves = 1e20 is out of range: allowed 1 to 100"),
        (
            "[film]\nslip = \"first order\"\n",
            "my.toml:4: film.slip = \"first order\" is not available: expected one of \"none\", \"first-order\", \
             \"second-order\", \"fukui-kaneko\": did you mean first-order?",
        ),
        (
            "[stator]\ntooth_radius_m = 0.001\n",
            "my.toml:4: stator.tooth_radius_m = 0.001 is out of range: allowed 0.01 to 1e6 m, or none (flat teeth)",
        ),
        ("[plate]\nlength_mm = 1\n", "my.toml:3: [plate] belongs to scene = \"plate\", and this is scene = \"motor\""),
        (
            "[rotor]\nmodel = \"plank\"\n",
            "my.toml:4: rotor.model = \"plank\" is not available: expected one of \"beam\", \"section\", \"ring\", \"table\", \"green\"",
        ),
        (
            "[numerics]\ncontact_nodes = 5\n",
            "my.toml:4: numerics.contact_nodes = 5 is out of range: allowed 19 to 5001, or none (left to the fidelity)",
        ),
        (
            "[stator]\ntooth_width_mm = 3\n",
            "my.toml:4: stator.tooth_width_mm = 3 is out of range: allowed 0.0289226 to 2.89225 mm, 1 % to 100 % of the \
             tooth pitch 2π × 29 mm / 7 waves / 9 teeth",
        ),
        ("[stator]\nteeth_per_wave = 40\n", "my.toml:4: stator.tooth_width_mm = 1.7353 is out of range"),
    ] {
        let message = message(lines);
        assert!(message.contains(expected), "{message}\nexpected {expected}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}

#[test]
fn plate_messages() {
    assert_eq!(
        plate_message("[plate]\nmean_gap_um = 2\namplitude_um = 2\n"),
        "my.toml:5: plate.amplitude_um = 2 is out of range: allowed 0 to below plate.mean_gap_um = 2 µm, or the plate \
         touches"
    );
    assert_eq!(
        plate_message("[stator]\n[motor]\n"),
        "my.toml:3: [stator] belongs to scene = \"motor\", and this is scene = \"plate\"\n\
         my.toml:4: [motor] belongs to scene = \"motor\", and this is scene = \"plate\""
    );
    assert_eq!(
        read("schema = 1\n[plate]\nlength_mm = 1\n").unwrap_err().to_string(),
        "my.toml:2: the key scene is missing: write scene = \"plate\" at the top of the file; allowed \"motor\" or \"plate\", and \
         without it the scene is a motor, which has no [plate]"
    );
}

#[test]
fn all_faults_are_reported_in_the_order_of_the_file() {
    let text = "[stator]\ntooth_width_mm = -1\nteeth = 9\n[film]\nshear = 0\n[motor]\nwaves = 101\n";
    let error = read(&format!("schema = 1\n{text}")).unwrap_err();
    let found: Vec<_> = error.faults().iter().map(|f| (f.line.unwrap(), f.what.key().unwrap())).collect();
    assert_eq!(
        found,
        [(3, "stator.tooth_width_mm"), (4, "stator.teeth"), (6, "film.shear"), (8, "motor.waves")],
        "{error}"
    );
}

#[test]
fn the_schema_is_required_and_checked() {
    let error = |text: &str| read(text).unwrap_err().to_string();
    assert_eq!(
        error("scene = \"motor\"\n"),
        "my.toml: the key schema is missing: write schema = 1 at the top of the file"
    );
    let supported = "is not supported: this program reads schema = 1";
    assert_eq!(error("\nschema = 2\nunknown = 3\n"), format!("my.toml:2: schema = 2 {supported}"));
    assert_eq!(error("schema = \"1\"\n"), format!("my.toml:1: schema = \"1\" {supported}"));
    assert_eq!(
        error("schema = 1\nscene = \"moter\"\n"),
        "my.toml:2: scene = \"moter\" is not a scene: allowed \"motor\" or \"plate\": did you mean motor?"
    );
}

#[test]
fn syntax_errors_have_line_and_column() {
    let error = read("schema = 1\n[film\nshear = true\n").unwrap_err();
    assert!(error.to_string().starts_with("my.toml:2:"), "{error}");
    assert!(error.to_string().contains("not valid TOML"), "{error}");
    assert!(error.faults()[0].column.is_some());
    let bare = read("schema = 1\n[film]\nslip = first-order\n").unwrap_err();
    assert!(bare.to_string().starts_with("my.toml:3:8: not valid TOML: text must be in quotes"), "{bare}");
    let twice = read("schema = 1\n[film]\nshear = true\nshear = true\n").unwrap_err();
    assert!(twice.to_string().starts_with("my.toml:4:1: not valid TOML: duplicate key"), "{twice}");
}

#[test]
fn a_hostile_key_stays_on_its_line() {
    let message = message("\"a\\nb\\u001b[2J\" = 1\n");
    assert_eq!(message.lines().count(), 1);
    assert!(!message.contains('\u{1b}'), "{message:?}");
}

#[test]
fn deep_nesting_is_refused() {
    for (open, middle, close) in
        [("compliance = ", "[", ""), ("a", ".a", " = 1"), ("a = ", "{a = ", "1"), ("[a", ".a", "]")]
    {
        let text = format!("schema = 1\n[rotor]\n{open}{}{close}\n", middle.repeat(100_000));
        let error = read(&text).unwrap_err().to_string();
        assert!(error.len() < 1000 && error.starts_with("my.toml:"), "{error}");
    }
    assert!(Scene::motor().set("rotor.compliance", &"[".repeat(100_000)).is_err());
}

#[test]
fn files_that_cannot_be_read_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let load = |name: &str| Scene::load(&folder.path().join(name)).unwrap_err();
    assert!(load("missing.toml").to_string().contains("missing.toml: cannot be read: "));
    std::fs::write(folder.path().join("latin1.toml"), b"name = \"\xe9\"\n").unwrap();
    assert!(load("latin1.toml").to_string().ends_with("latin1.toml: cannot be read: it is not UTF-8 text"));
    std::fs::File::create(folder.path().join("huge.toml")).unwrap().set_len(100_000_000).unwrap();
    assert!(load("huge.toml").to_string().ends_with("huge.toml: cannot be read: it is larger than 16 MB"));
    std::fs::write(folder.path().join("large.toml"), format!("schema = 1\n#{}", "x".repeat(15_999_988))).unwrap();
    Scene::load(&folder.path().join("large.toml")).unwrap();
    std::fs::write(folder.path().join("larger.toml"), format!("schema = 1\n#{}", "x".repeat(15_999_989))).unwrap();
    assert!(matches!(load("larger.toml").faults()[0].what, FaultKind::Read(ReadError::TooLarge(16))));
    let message = Scene::load(folder.path()).unwrap_err().to_string();
    assert!(message.ends_with(": cannot be read: it is a folder, not a regular file"), "{message}");
}

/// Whatever never ends or never begins is refused before it is opened, as a preset and as a table.
#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    std::os::unix::fs::symlink(&pipe, folder.path().join("link")).unwrap();
    let socket = folder.path().join("socket");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    let refused = "cannot be read: it is a pipe or a device, not a regular file";
    for path in [&pipe, &folder.path().join("link"), &socket, Path::new("/dev/zero"), Path::new("/dev/tty")] {
        if !path.exists() {
            continue;
        }
        let path = path.to_str().unwrap();
        assert_eq!(presets::find(path).unwrap_err().to_string(), format!("{path}: {refused}"));
        let message = Scene::motor().set("rotor.compliance_csv", path).unwrap_err().to_string();
        assert!(message.ends_with(refused), "{message}");
    }
    let preset = folder.path().join("p.toml");
    std::fs::write(&preset, "schema = 1\n[rotor]\nmodel = \"table\"\ncompliance_csv = \"pipe\"\n").unwrap();
    let message = Scene::load(&preset).unwrap_err().to_string();
    assert!(message.contains("p.toml:4: rotor.compliance_csv = \"pipe\": ") && message.ends_with(refused), "{message}");
}

/// A file with a fault on every line is read, told about and counted, in the order of the file.
#[test]
fn of_many_faults_ten_are_told_and_the_others_counted() {
    let many = 300_000;
    let lines = |line: fn(usize) -> String, count| (0..count).map(line).collect::<String>();
    let near = "my.toml:3: unknown key film.min_spacing_nm0: did you mean film.min_spacing_nm?";
    let rows = lines(|i| format!("[{}, 0],\n", i + 1), 90_000);
    for (text, count, first, last) in [
        (lines(|i| format!("frequenzy_{i} = 1\n"), many), many, "my.toml:2: unknown key frequenzy_0", 11),
        (format!("[film]\n{}", lines(|i| format!("min_spacing_nm{i} = 1\n"), many)), many, near, 12),
        (
            lines(|i| format!("[motor{i}]\n"), many),
            many,
            "my.toml:2: unknown table [motor0]: did you mean [motor]?",
            11,
        ),
        (
            format!("[rotor]\nmodel = \"table\"\ncompliance = [{rows}]"),
            90_000,
            "my.toml:4: rotor.compliance, row 1: compliance_m2_per_n = 0 is out of range",
            13,
        ),
    ] {
        let error = read(&format!("schema = 1\n{text}")).unwrap_err();
        assert_eq!(error.faults().len(), 10);
        let message = error.to_string();
        let told: Vec<_> = message.lines().collect();
        assert_eq!((told.len(), told[10]), (11, format!("and {} more", count - 10).as_str()));
        assert!(told[0].starts_with(first) && message.len() < 3000, "{message}");
        assert_eq!(error.faults()[9].line, Some(last), "{message}");
    }
}

/// To find the nearest name takes time in proportion to both lengths: a very long one has none.
#[test]
fn names_of_any_length_are_refused_in_few_words() {
    let long = "x".repeat(1_000_000);
    let error =
        read(&format!("schema = 1\n{long} = 1\n[{long}y]\n[film]\nslip = \"{long}\"\n{long} = 1\n")).unwrap_err();
    assert_eq!(error.faults().len(), 4);
    assert!(error.to_string().len() < 2000, "{error}");
}

#[test]
fn a_file_that_is_no_table_is_not_quoted() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in
        [("a", "hunter2:secret\n1,2\n"), ("b", "\"hunter2\nsecret"), ("c", "hunter2,compliance_m2_per_n\n")]
    {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        let message = Scene::motor().set("rotor.compliance_csv", path.to_str().unwrap()).unwrap_err().to_string();
        assert!(!message.contains("hunter2") && !message.contains("secret"), "{message}");
        assert!(message.contains("expected the header harmonic,compliance_m2_per_n or wavenumber_per_m,"), "{message}");
    }
}

#[test]
fn a_key_at_fault_hides_the_rules_about_it() {
    assert_eq!(
        message("[motor]\nwaves = 0\n[film]\nviscosity_upa_s = nan\nshear = 0\n[numerics]\nwedge = \"on\"\n"),
        "my.toml:4: motor.waves = 0 is out of range: allowed 1 to 100\n\
         my.toml:6: film.viscosity_upa_s = NaN is not finite: expected a number from 1 to 1000 µPa·s\n\
         my.toml:7: film.shear = 0 is of the wrong type: expected true or false"
    );
    // A table of harmonics is not read without a wavelength, and is not missing either.
    assert_eq!(
        message("[rotor]\nmodel = \"table\"\ncompliance_csv = \"no.csv\"\n[motor]\nwaves = 0\n").lines().count(),
        1
    );
}

// ---- the gas

#[test]
fn viscosity_and_mean_free_path_follow_a_named_gas() {
    let gas = |scene: &Scene| motor(scene).gas;
    let mut scene = Scene::motor();
    assert_eq!(gas(&scene), Gas::default());
    scene.set("film.viscosity_upa_s", "30").unwrap();
    // The motor: helium at 2000 m. 79.501 kPa (U.S. Standard Atmosphere), 19.6 µPa·s; 194 nm at 20 °C and 101.325 kPa.
    scene.set_all([("film.gas", "helium"), ("film.altitude_m", "2000")]).unwrap();
    let (helium, sea_level) = (gas(&scene), 101.325 / 79.501);
    assert!((helium.ambient_pressure / 79_501.0 - 1.0).abs() < 1e-4, "{helium:?}");
    assert!((helium.viscosity / 19.6e-6 - 1.0).abs() < 2e-3, "{helium:?}");
    assert!((helium.mean_free_path / (190e-9 * sea_level) - 1.0).abs() < 0.02, "{helium:?}");
    assert_eq!(scene.following("film.mean_free_path_nm").map(|value| value / 1e9), Some(helium.mean_free_path));
    assert_eq!((scene.get("film.viscosity_upa_s"), scene.get("film.ambient_pressure_kpa")), (None, None));
    // Twice the pressure, half the path; what was swept before is replaced.
    scene.set("film.ambient_pressure_kpa", "50").unwrap();
    let path = gas(&scene).mean_free_path;
    scene.set("film.ambient_pressure_kpa", "100").unwrap();
    assert!((gas(&scene).mean_free_path / path - 0.5).abs() < 1e-12);
    assert_eq!(scene.get("film.altitude_m"), None);
    // A warmer gas is more viscous, and thinner.
    scene.set("film.temperature_c", "100").unwrap();
    assert!(gas(&scene).viscosity > 1.15 * helium.viscosity && gas(&scene).mean_free_path > 1.25 * 0.5 * path);
    scene.set("film.gas", "custom").unwrap();
    scene.set("film.ambient_pressure_kpa", "101.325").unwrap();
    assert_eq!(scene, Scene::motor());
}

#[test]
fn a_gas_is_either_named_or_given_and_so_is_its_pressure() {
    let of = |lines: &str| message(&format!("[film]\n{lines}"));
    let custom = "belongs to film.gas = \"custom\", and this is film.gas = \"air\"";
    let named = "belongs to film.gas = \"air\", \"nitrogen\", \"helium\", \"argon\", \"carbon-dioxide\" or \"hydrogen\", and this is \
                 film.gas = \"custom\"";
    for (lines, expected) in [
        ("viscosity_upa_s = 18.1\ngas = \"air\"\n", format!("my.toml:4: film.viscosity_upa_s {custom}")),
        ("gas = \"air\"\nmean_free_path_nm = 64\n", format!("my.toml:5: film.mean_free_path_nm {custom}")),
        ("temperature_c = 20\n", format!("my.toml:4: film.temperature_c {named}")),
        ("altitude_m = 0\n", format!("my.toml:4: film.altitude_m {named}")),
        (
            "gas = \"air\"\naltitude_m = 0\nambient_pressure_kpa = 101.325\n",
            "my.toml:5: film.ambient_pressure_kpa and film.altitude_m are both given: keep one".to_owned(),
        ),
        (
            "gas = \"neon\"\naltitude_m = 0\n",
            "my.toml:4: film.gas = \"neon\" is not available: expected one of \"custom\", \"air\", \"nitrogen\", \"helium\", \
             \"argon\", \"carbon-dioxide\", \"hydrogen\""
                .to_owned(),
        ),
        (
            "gas = \"air\"\naltitude_m = 61e3\n",
            "my.toml:5: film.altitude_m = 61000 is out of range: allowed -1000 to 60000 m, or none (the pressure is given)".to_owned(),
        ),
    ] {
        assert_eq!(of(lines), expected);
    }
    let pairs = [("film.ambient_pressure_kpa", "50"), ("film.gas", "air"), ("film.altitude_m", "100")];
    for both in [pairs, [pairs[2], pairs[1], pairs[0]]] {
        let message = Scene::motor().set_all(both).unwrap_err().to_string();
        assert_eq!(message, "film.ambient_pressure_kpa and film.altitude_m are both given: keep one");
    }
    Scene::motor().set_all([pairs[0], pairs[1], ("film.altitude_m", "none")]).unwrap();
    let saved = read("schema = 1\nfilm = { gas = \"argon\", altitude_m = 300, temperature_c = 0 }\n").unwrap();
    assert_eq!(read(&saved.to_toml()).unwrap(), saved);
    assert!(!saved.to_toml().contains("viscosity_upa_s") && !saved.to_toml().contains("ambient_pressure_kpa"));
}

#[test]
fn that_the_replaced_key_is_not_given_may_be_said() {
    for (key, value, replaced) in
        [("motor.load_n", "20", "motor.load_per_wave_n"), ("stator.tooth_share", "0.5", "stator.tooth_width_mm")]
    {
        let with = |pairs: &[(&str, &str)]| Scene::motor().with(pairs);
        assert_eq!(with(&[(key, value), (replaced, "none")]).unwrap(), with(&[(key, value)]).unwrap());
        let alone = with(&[(replaced, "none")]).unwrap_err().to_string();
        assert!(alone.contains("none: this key cannot be left out"), "{alone}");
    }
}

// ---- measured heights

/// Heights \[nm\] of a face on which ridges lie along y.
fn face() -> String {
    let height = |i: u32, j: u32| {
        let (i, j) = (f64::from(i), f64::from(j));
        90.0 * (0.9 * i).sin() * (0.21 * j).cos() + 37.0 * (2.3 * i + 0.3 * j).sin()
    };
    let row = |j: u32| (0..48).map(|i| format!("{:.3}", height(i, j))).collect::<Vec<_>>().join(",");
    let rows: Vec<String> = (0..40).map(row).collect();
    format!("# dx_um = 2\n# dy_um = 2\n# height = nm\n{}\n", rows.join("\n"))
}

#[test]
fn what_is_not_given_follows_from_measured_heights() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("face.csv");
    std::fs::write(&csv, face()).unwrap();
    let preset = folder.path().join("p.toml");
    let lines =
        "heights_csv = \"face.csv\"\nmodel = \"asperities\"\nflow_factors = \"patir-cheng\"\nsummit_radius_um = 20\n";
    std::fs::write(&preset, format!("schema = 1\n[surface]\n{lines}")).unwrap();
    let scene = Scene::load(&preset).unwrap();
    let number = |scene: &Scene, key: &str| scene.get(key).unwrap().as_number().unwrap();
    let (map, texture) = measured(&face(), 1).unwrap();
    let rms = (map.heights.iter().map(|z| z * z).sum::<f64>() / map.heights.len() as f64).sqrt();
    // Of two faces alike, to four digits.
    assert!((number(&scene, "surface.rms_nm") / (1e9 * rms * 2f64.sqrt()) - 1.0).abs() < 5e-4);
    for (key, value) in heights::keys_of(&Pair::of(&texture, &texture)) {
        let given = if key == "surface.summit_radius_um" { 20.0 } else { value };
        assert_eq!(number(&scene, key), given, "{key}");
    }
    assert!(number(&scene, "surface.lay") < 0.5, "ridges across the wave");

    // What is saved needs the CSV file no more, and --set takes it in any order.
    assert_eq!(read(&scene.to_toml()).unwrap(), scene);
    let path = csv.to_str().unwrap();
    let pairs = [
        ("surface.summit_radius_um", "20"),
        ("surface.heights_csv", path),
        ("surface.flow_factors", "patir-cheng"),
        ("surface.model", "asperities"),
    ];
    let other = Scene::motor().with(pairs).unwrap();
    assert!(other.same_model(&scene));
    assert_eq!(Scene::motor().with(pairs.into_iter().rev()).unwrap(), other);
    // Of a hard stop with flow factors only what those need.
    let flow = [("surface.flow_factors", "patir-cheng"), ("surface.heights_csv", path)];
    let stop = Scene::motor().with(flow).unwrap();
    assert_eq!(stop.get("surface.lay"), scene.get("surface.lay"));
    assert_eq!(stop.get("surface.summit_density_per_mm2"), None);

    let message = Scene::motor().set("surface.heights_csv", path).unwrap_err().to_string();
    assert!(message.contains("surface.heights_csv belongs to surface.model = \"asperities\""), "{message}");
    for (text, expected) in [
        ("secret\n", "line 1 has no heights of a measured face"),
        ("# dx_um = 1\n# dy_um = 1\n# height = nm\n1,secret\n", "line 4 has no heights of a measured face"),
        ("x_um,z_nm\n0,1\n", "points: allowed 16"),
    ] {
        std::fs::write(&csv, text).unwrap();
        let message = Scene::load(&preset).unwrap_err().to_string();
        assert!(
            message.contains("p.toml:3: surface.heights_csv = \"face.csv\": ") && message.contains(expected),
            "{message}"
        );
        assert!(!message.contains("secret"), "{message}");
    }
    std::fs::write(&csv, face().replace("= nm", "= um")).unwrap();
    let message = Scene::load(&preset).unwrap_err().to_string();
    assert!(message.contains("surface.rms_nm = ") && message.contains("allowed 10 to 5000 nm"), "{message}");
}

// ---- the compliance table

#[test]
fn a_compliance_table_is_read_inline_and_from_csv() {
    let inline = read("schema = 1\n[rotor]\nmodel = \"table\"\ncompliance = [[241.5, 2e-9],\n[483, 1e-9]]\n").unwrap();
    assert_eq!(motor(&inline).rotor, RotorCompliance::Table(vec![(241.5, 2e-9), (483.0, 1e-9)]));

    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("r.csv"), "harmonic,compliance_m2_per_n\n1,2e-9\n2,1e-9\n").unwrap();
    let preset = folder.path().join("p.toml");
    let text = "schema = 1\n[rotor]\ncompliance_csv = \"r.csv\"\nmodel = \"table\"\n[motor]\nwaves = 6\n";
    std::fs::write(&preset, text).unwrap();
    let scene = Scene::load(&preset).unwrap();
    let motor = motor(&scene);
    let RotorCompliance::Table(rows) = &motor.rotor else { panic!("a table") };
    assert_eq!(rows.len(), 2);
    assert!((rows[1].0 * motor.wavelength() / std::f64::consts::TAU - 2.0).abs() < 1e-14);

    // What is saved needs the CSV file no more.
    let saved = folder.path().join("saved.toml");
    scene.save(&saved).unwrap();
    std::fs::remove_file(folder.path().join("r.csv")).unwrap();
    assert_eq!(Scene::load(&saved).unwrap(), scene);
    assert!(Scene::load(&preset).unwrap_err().to_string().contains("p.toml:3: rotor.compliance_csv = \"r.csv\": "));
}

#[test]
fn compliance_faults_are_told_apart() {
    for (lines, expected) in [
        ("model = \"table\"\n", "my.toml:4: rotor.model = \"table\" needs rotor.compliance_csv or rotor.compliance"),
        (
            "model = \"table\"\ncompliance = [[1, 1e-9]]\ncompliance_csv = \"a.csv\"\n",
            "my.toml:6: rotor.compliance and rotor.compliance_csv are both given: keep one",
        ),
        (
            "model = \"table\"\ncompliance = [[1, 1e-9],\n[2, 0]]\n",
            "my.toml:6: rotor.compliance, row 2: compliance_m2_per_n = 0 is out of range: allowed 1e-20 to 1 m²/N",
        ),
        (
            "model = \"table\"\ncompliance = [[2, 1e-9], [1, 1e-9]]\n",
            "my.toml:5: rotor.compliance, row 2: wavenumber_per_m = 1 is not above 2, the one before: sort the rows",
        ),
        ("model = \"table\"\ncompliance = [[2, 1e-9, 3]]\n", "row 1: [2, 1e-9, 3] is not a pair of numbers"),
        ("model = \"table\"\ncompliance = []\n", "my.toml:5: rotor.compliance has 0 rows: allowed 1 to 100000"),
        (
            "model = \"table\"\ncompliance_csv = 3\n",
            "my.toml:5: rotor.compliance_csv = 3 is of the wrong type: expected the path of a CSV file",
        ),
        (
            "model = \"table\"\ndecay_length_mm = 4.0\ncompliance = [[1, 1e-9]]\n",
            "my.toml:5: rotor.decay_length_mm belongs to rotor.model = \"beam\" or \"section\", and this is rotor.model = \"table\"",
        ),
        (
            "compliance = [[1, 1e-9]]\n",
            "my.toml:4: rotor.compliance belongs to rotor.model = \"table\", and this is rotor.model = \"beam\"",
        ),
    ] {
        let message = message(&format!("[rotor]\n{lines}"));
        assert!(message.contains(expected), "{message}\nexpected {expected}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}

// ---- the ring

const WEB: &str = "[[rotor.part]]\nname = \"web\"\nr_inner_mm = 28\nr_outer_mm = 30\nz_bottom_mm = 0\nz_top_mm = 1.5\n";

#[test]
fn a_section_is_read_in_either_notation_and_saved() {
    let text = format!(
        "schema = 1\n[rotor]\nmodel = \"ring\"\n{WEB}material = \"brass\"\n[[rotor.support]]\nr_inner_mm = 30\n\
         r_outer_mm = 30\nz_bottom_mm = 0\nz_top_mm = 2\nfixed = \"axial-radial\"\n[film]\nmin_spacing_nm = 100\n"
    );
    let scene = read(&text).unwrap();
    let motor = motor(&scene);
    let RotorCompliance::Ring(section) = &motor.rotor else { panic!("a ring") };
    let (part, support) = (&section.parts()[0], &section.supports()[0]);
    assert_eq!((part.name.as_str(), part.material.name), ("web", "brass"));
    assert_eq!((part.inner_radius, part.outer_radius, part.bottom, part.top), (0.028, 0.03, 0.0, 1.5e-3));
    assert_eq!((support.axial, support.radial, support.circumferential), (true, true, false));
    assert_eq!(read(&scene.to_toml()).unwrap(), scene);

    let mut set = Scene::motor();
    set.set_all([
        ("rotor.part", "[{name = \"web\", r_inner_mm = 28, r_outer_mm = 30, z_bottom_mm = 0, z_top_mm = 1.5, material = \"brass\"}]"),
        ("rotor.support", "[{r_inner_mm = 30, r_outer_mm = 30, z_bottom_mm = 0, z_top_mm = 2, fixed = \"axial-radial\"}]"),
        ("film.min_spacing_nm", "100"),
    ])
    .unwrap();
    assert!(set.same_model(&scene));
    // No support is a value of its own, and a model that is chosen brings a section.
    set.set("rotor.support", "[]").unwrap();
    assert_eq!(read(&set.to_toml()).unwrap().get("rotor.support"), Some(Value::Records(Vec::new())));
    let default = Scene::motor().with([("rotor.model", "ring")]).unwrap();
    assert!(presets::find("ring-rotor").unwrap().same_model(&default));
    assert_eq!(read(&default.to_toml()).unwrap(), default);
}

#[test]
fn a_ring_that_is_chosen_suits_the_contact() {
    // Also where there is little room towards the axis.
    for (radius, width) in [("29", "0.3"), ("27", "1.8"), ("500", "10"), ("5.5", "10"), ("1", "0.01")] {
        let contact = [("motor.contact_radius_mm", radius), ("rotor.contact_width_mm", width)];
        let ring = [("rotor.model", "ring"), ("stator.tooth_share", "0.5")];
        let mut scene = Scene::motor().with([ring, contact].concat()).unwrap();
        let motor = motor(&scene);
        let RotorCompliance::Ring(section) = &motor.rotor else { panic!("a ring") };
        let [(inner, outer)] = section.contact_faces()[..] else { panic!("one lining") };
        let (middle, wide) = (0.5 * (inner + outer), outer - inner);
        let beside = [middle - motor.contact_radius, wide - motor.contact_width];
        assert!(beside.iter().all(|by| by.abs() < 1e-9), "{radius}, {width}: {inner} to {outer}");
        assert_eq!(read(&scene.to_toml()).unwrap(), scene);
        // It is no change by itself, and stays as it is when the contact or the same model is set.
        let before = scene.get("rotor.part");
        let mut beam = scene.clone();
        beam.set("rotor.model", "beam").unwrap();
        assert_eq!(scene.changed(&beam).map(|parameter| parameter.key).collect::<Vec<_>>(), ["rotor.model"]);
        for (key, value) in [("rotor.model", "ring"), ("rotor.contact_width_mm", "0.02")] {
            scene.set(key, value).unwrap();
            assert_eq!(scene.get("rotor.part"), before);
        }
    }
    // Parts that are given are the section, and so is what a file leaves out.
    let part =
        "[{name = \"web\", r_inner_mm = 26, r_outer_mm = 28, z_bottom_mm = 0, z_top_mm = 1, material = \"brass\"}]";
    let set = [("rotor.part", part), ("rotor.model", "ring"), ("motor.contact_radius_mm", "27")];
    let scene = Scene::motor().with(set).unwrap();
    assert_eq!(scene.get("rotor.part.web.r_outer_mm"), Some(Value::Number(28.0)));
    let file = read("schema = 1\n[motor]\ncontact_radius_mm = 27\n[rotor]\nmodel = \"ring\"\n").unwrap();
    assert_eq!(file.get("rotor.part"), Parameter::find("rotor.part").unwrap().default());
}

#[test]
fn faults_of_a_section_name_the_part_and_its_key() {
    for (lines, expected) in [
        (
            format!("{WEB}material = \"wood\"\n"),
            "my.toml:11: rotor.part, web: material = \"wood\" is not available: expected one of \"aluminium\", \"steel\"",
        ),
        (WEB.to_owned(), "my.toml:5: rotor.part, web: material is missing: expected one of \"aluminium\""),
        (
            WEB.replace("1.5", "5e9") + "material = \"steel\"\n",
            "my.toml:10: rotor.part, web: z_top_mm = 5e9 is out of range: allowed -1000 to 1000 mm",
        ),
        (
            WEB.replace("\"web\"", "\"\"") + "material = \"steel\"\nwidth_mm = 3\n",
            "my.toml:12: rotor.part, number 1: unknown key width_mm: known are name, r_inner_mm",
        ),
        (
            WEB.replace("= 30", "= 27") + "material = \"steel\"\n",
            "my.toml:5: rotor.part: part web: outer radius = 27 mm: allowed above its inner radius, 28 mm",
        ),
        ("part = []\n".to_owned(), "my.toml:5: rotor.part has 0 tables: allowed 1 to 32"),
        ("part = 3\n".to_owned(), "my.toml:5: rotor.part = 3 is of the wrong type: expected tables with name, r_inner"),
        (
            "support = [{r_inner_mm = 1, r_outer_mm = 1, z_bottom_mm = 0, z_top_mm = 0, fixed = \"all\"}]\n".to_owned(),
            "my.toml:5: rotor.support: support 1: no part is within r = 1 to 1 mm",
        ),
    ] {
        let message = message(&format!("[rotor]\nmodel = \"ring\"\n{lines}"));
        assert!(message.contains(expected), "{message}\nexpected {expected}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}

// ---- --set

#[test]
fn set_reads_text_in_the_unit_of_the_key() {
    let mut scene = Scene::motor();
    scene.set("stator.tooth_radius_m", "3").unwrap();
    assert_eq!(scene.get("stator.tooth_radius_m"), Some(Value::Number(3.0)));
    scene.set("stator.tooth_radius_m", "none").unwrap();
    assert_eq!(scene.get("stator.tooth_radius_m"), None);
    scene.set("numerics.contact_nodes", "361").unwrap();
    scene.set("numerics.contact_nodes", "").unwrap();
    scene.set("film.slip", "none").unwrap();
    assert_eq!(scene.get("film.slip"), Some(Value::Text("none".into())));
    scene.set("film.shear", "false").unwrap();
    scene.set("name", "Mine").unwrap();
    assert_eq!(scene.name, "Mine");
    scene.set_value("motor.waves", Value::Number(6.0)).unwrap();
    assert_eq!(scene.get("motor.waves"), Some(Value::Whole(6)));
    for (text, nanometres) in [("0.25um", 250.0), ("250 nm", 250.0), ("2 * 150", 300.0)] {
        scene.set("film.min_spacing_nm", text).unwrap();
        assert_eq!(scene.get("film.min_spacing_nm"), Some(Value::Number(nanometres)), "{text}");
    }
}

#[test]
fn set_refuses_and_changes_nothing() {
    let mut scene = Scene::motor();
    for (key, text, expected) in [
        ("film.min_spacing_nm", "3", "film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm"),
        (
            "film.min_spacing_nm",
            "none",
            "film.min_spacing_nm = none: this key cannot be left out: expected a number from 5 to 10000 nm, in nm, µm, mm,",
        ),
        ("film.min_spacing_nm", "1,5", "film.min_spacing_nm = 1,5 is not a number"),
        ("film.min_spacing_nm", "1um,5", "film.min_spacing_nm = 1um,5 is not a number"),
        (
            "film.min_spacing_nm",
            "5kHz",
            "film.min_spacing_nm = 5kHz is not a number: expected a number from 5 to 10000 nm, in nm, µm, mm, cm, m,",
        ),
        ("film.min_spacing_nm", "NaN", "film.min_spacing_nm = NaN is not finite"),
        ("motor.waves", "7.5", "motor.waves = 7.5 is of the wrong type: expected a whole number from 1 to 100"),
        ("film.spacing_nm", "3", "unknown key film.spacing_nm: did you mean film.min_spacing_nm?"),
        ("plate.length_mm", "1", "plate.length_mm belongs to scene = \"plate\", and this is scene = \"motor\""),
        ("plate.x", "1", "plate.x belongs to scene = \"plate\", and this is scene = \"motor\""),
        ("qqq.x", "1", "unknown key qqq.x: known are motor, stator, rotor, film, surface, numerics"),
        ("film", "1", "unknown key film: known are film.min_spacing_nm, film.gas, film.ambient"),
        ("scene", "plate", "scene cannot be changed: start from another preset"),
        (
            "rotor.model",
            "plank",
            "rotor.model = \"plank\" is not available: expected one of \"beam\", \"section\", \"ring\", \"table\", \"green\"",
        ),
        ("rotor.compliance_csv", "no.csv", "rotor.compliance_csv = \"no.csv\" cannot be read: "),
        ("rotor.compliance", "[[1, 2, 3]]", "rotor.compliance, row 1: [1, 2, 3] is not a pair"),
    ] {
        let message = scene.set(key, text).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{message}\nexpected {expected}");
        assert_eq!(scene, Scene::motor(), "{key}");
    }
    assert!(scene.set_value("motor.waves", Value::Number(6.5)).is_err());
}

#[test]
fn pairs_are_set_in_any_order() {
    // Twice the teeth leave no room for the tooth, until the tooth is narrower.
    let pairs = [("stator.teeth_per_wave", "18"), ("stator.tooth_width_mm", "1")];
    let mut scene = Scene::motor().with(pairs).unwrap();
    assert_eq!(scene, Scene::motor().with(pairs.into_iter().rev()).unwrap());

    let before = scene.clone();
    assert!(scene.set_all([("stator.tooth_width_mm", "2")]).is_err());
    let error = scene.set_all([("film.slip", "no"), ("motor.waves", "0")]).unwrap_err();
    assert_eq!(error.faults().len(), 2);
    assert_eq!(scene, before);

    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("r.csv");
    std::fs::write(&csv, "harmonic,compliance_m2_per_n\n1,2e-9\n").unwrap();
    let set = [("rotor.compliance_csv", csv.to_str().unwrap()), ("motor.waves", "6")];
    let table = Scene::motor().with(set).unwrap();
    let Some(Value::Rows(compliance)) = table.get("rotor.compliance") else { panic!("a table") };
    assert!((compliance[0].0 - 6.0 / 29e-3).abs() < 1e-9, "{compliance:?}");
}

// ---- presets

#[test]
fn every_preset_is_a_problem_and_saves_equal() {
    let folder = tempfile::tempdir().unwrap();
    for built_in in presets::BUILT_IN {
        let scene = built_in.scene().unwrap();
        assert!(!scene.about.is_empty(), "{}", built_in.name);
        Problem::try_from(&scene).unwrap();
        let path = folder.path().join(built_in.name);
        scene.save(&path).unwrap();
        assert_eq!(presets::find(path.to_str().unwrap()).unwrap(), scene);
    }
}

#[test]
fn every_published_row_has_its_preset_and_its_change() {
    assert_eq!(table1::published().len(), 14);
    for row in table1::published() {
        let preset = presets::find(&row.preset).unwrap();
        let mut expected = presets::find("fundamental").unwrap();
        match row.change.split_once('=') {
            Some((key, value)) if key.contains('.') => expected.set(key, value).unwrap(),
            _ if row.row == "doubled_mesh" => {
                expected.set_all([("numerics.film_nodes_along", "101"), ("numerics.film_nodes_across", "21")]).unwrap();
                expected.set("numerics.contact_nodes", "361").unwrap();
            }
            _ => assert_eq!(row.row, "fundamental"),
        }
        assert!(preset.same_model(&expected), "{}", row.row);
        assert_eq!(preset.numerics(), expected.numerics(), "{}", row.row);
        // The description quotes the published numbers as printed in the paper.
        let (load, alpha) = (row.published_load_n, row.published_alpha);
        assert!((load / 2.45 - alpha).abs() < 1e-3, "{}", row.row);
        assert!(preset.about.contains(&format!("{load:.3} N, share of the load {alpha:.3}")), "{}", preset.about);
    }
}

#[test]
fn every_built_in_name_is_an_embedded_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap().replace(".toml", ""))
        .collect();
    files.sort();
    let mut names: Vec<_> = presets::BUILT_IN.iter().map(|built_in| built_in.name.to_owned()).collect();
    names.sort();
    assert_eq!(files, names);
}

#[test]
fn an_unknown_preset_suggests_the_nearest() {
    for (name, meant) in [
        ("fundemental", "fundamental"),
        ("frequency-30khz", "frequency-3khz"),
        ("plate_trapped", "plate-trapped"),
        ("no/such/levitating.toml", "levitating"),
    ] {
        let message = presets::find(name).unwrap_err().to_string();
        assert!(message.starts_with(&format!("unknown preset {name}: ")), "{message}");
        assert!(message.contains(&format!("did you mean {meant}?")), "{message}");
    }
    assert!(!presets::find("").unwrap_err().to_string().contains("did you mean"));
}

// ---- to SI

#[test]
fn the_fundamental_case_in_si() {
    let scene = presets::find("fundamental").unwrap().with([("motor.rotor_speed_rpm", "60")]).unwrap();
    let problem = Problem::try_from(&scene).unwrap();
    let motor = problem.scenario.motor().unwrap();
    assert_eq!(problem.name, "Fundamental case");
    assert_eq!((motor.waves, motor.teeth, motor.tooth_radius), (7, 9, None));
    let RotorCompliance::Beam { decay_length, point_compliance, local_compliance } = motor.rotor else {
        panic!("a beam")
    };
    // A decimal fraction is not exact, so its thousandth may be the double next to the one written here.
    for (found, expected) in [
        (motor.contact_radius, 29e-3),
        (motor.load, 2.45),
        (motor.dry_friction, 0.7),
        (motor.frequency, 30e3),
        (motor.normal_amplitude, 1.3e-6),
        (motor.tangential_amplitude, 1e-6),
        (motor.tooth_width, 1.7353e-3),
        (motor.contact_width, 0.3e-3),
        (motor.gas.ambient_pressure, 101_325.0),
        (motor.gas.viscosity, 18.1e-6),
        (point_compliance, 0.64e-6),
        (local_compliance, 1.05e-10),
    ] {
        assert!((found / expected - 1.0f64).abs() <= f64::EPSILON, "{found:e} {expected:e}");
    }
    // Whole numbers are exact.
    assert_eq!((motor.min_spacing, motor.gas.mean_free_path, decay_length), (200e-9, 64e-9, 4e-3));
    // One turn a second.
    assert!((motor.rotor_speed - std::f64::consts::TAU * 0.029).abs() < 1e-16);
    assert!((motor.tooth_width / motor.wavelength() - 12.0 / 180.0).abs() < 1e-5);
}

#[test]
fn a_scene_that_breaks_a_rule_between_keys_is_no_problem_and_is_not_saved() {
    let mut scene = Scene::plate();
    scene.set("plate.amplitude_um", "1").unwrap();
    assert!(Problem::try_from(&scene).unwrap_err().to_string().starts_with("plate.amplitude_um = 1 is out of range"));
    let folder = tempfile::tempdir().unwrap();
    assert!(scene.save(&folder.path().join("p.toml")).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// Scenes are made for each point of a sweep.
#[test]
fn a_point_of_a_sweep_costs_few_allocations() {
    for (preset, most) in [("fundamental", 6), ("plate-trapped", 8), ("doubled-mesh", 15)] {
        let scene = presets::find(preset).unwrap();
        let counted = allocation_counter::measure(|| {
            let mut point = scene.clone();
            point.set_value("film.viscosity_upa_s", Value::Number(20.0)).unwrap();
            std::hint::black_box(Problem::try_from(&point).unwrap());
        });
        assert!(counted.count_total <= most, "{preset}: {counted:?}");
    }
}

// ---- saving

#[test]
fn saving_replaces_the_file_and_leaves_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.toml");
    std::fs::write(&path, "old").unwrap();
    Scene::motor().save(&path).unwrap();
    assert_eq!(Scene::load(&path).unwrap(), Scene::motor());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let error = Scene::motor().save(&folder.path().join("no/p.toml")).unwrap_err();
    assert!(matches!(error.faults()[0].what, FaultKind::Unwritable { .. }), "{error}");
    assert!(Scene::motor().save(folder.path()).is_err());
}

#[test]
fn a_saved_file_has_every_key() {
    let mut table = Scene::motor();
    table.set("rotor.compliance", "[[1, 1e-9]]").unwrap();
    let ring = Scene::motor().with([("rotor.model", "ring")]).unwrap();
    for scene in [Scene::motor(), Scene::plate(), table, ring] {
        let text = scene.to_toml();
        for parameter in scene.parameters().filter(|p| !matches!(p.kind, ParameterKind::CsvPath { .. })) {
            assert!(text.contains(&format!("{} ", parameter.leaf())), "{} in\n{text}", parameter.key);
        }
    }
}

/// A number anywhere in a range, its ends and small numbers included.
fn anywhere(range: Range) -> BoxedStrategy<f64> {
    let Range { min, max } = range;
    let log = (min.max(1e-12).ln()..=max.ln()).prop_map(move |ln| ln.exp().clamp(min, max));
    prop_oneof![1 => Just(min), 1 => Just(max), 4 => min..=max, 4 => log].boxed()
}

fn any_value(kind: ParameterKind) -> BoxedStrategy<Option<Value>> {
    match kind {
        ParameterKind::Number { range, .. } => anywhere(range).prop_map(|x| Some(Value::Number(x))).boxed(),
        ParameterKind::Whole { min, max, .. } => {
            (i64::from(min)..=i64::from(max)).prop_map(|n| Some(Value::Whole(n))).boxed()
        }
        ParameterKind::Flag { .. } => any::<bool>().prop_map(|flag| Some(Value::Flag(flag))).boxed(),
        ParameterKind::Choice { options, .. } => {
            proptest::sample::select(options).prop_map(|name| Some(Value::Text(name.to_owned()))).boxed()
        }
        ParameterKind::Text { .. } => any::<String>().prop_map(|text| Some(Value::Text(text))).boxed(),
        ParameterKind::Rows { columns } => {
            // A Green's function begins at 0.
            let first = u32::from(columns[0].key != "x_mm");
            proptest::collection::btree_map(1u32..10_000_000, anywhere(columns[1].range().unwrap()), 1..20)
                .prop_map(move |rows| {
                    let x = |i: usize, k: u32| if i == 0 { first } else { first + k };
                    let rows = rows.into_iter().enumerate();
                    Some(Value::Rows(rows.map(|(i, (k, c))| (f64::from(x(i, k)) / 1e3, c)).collect()))
                })
                .boxed()
        }
        // Parts on top of each other, and boxes round all of them.
        ParameterKind::Records { columns, fewest, .. } => {
            let number = |x: f64| Value::Number(x);
            let stacked = move |names: Vec<(String, f64)>| {
                let parts = names.into_iter().enumerate().map(|(i, (name, inner))| {
                    let (low, high) = (i as f64, i as f64 + 1.0);
                    let text = |words: &str| Value::Text(words.to_owned());
                    match columns.len() {
                        6 => vec![
                            Value::Text(name),
                            number(inner),
                            number(40.0),
                            number(low),
                            number(high),
                            text("peek"),
                        ],
                        _ => vec![number(0.0), number(1000.0), number(-1000.0), number(1000.0), text("axial-radial")],
                    }
                });
                Some(Value::Records(parts.collect()))
            };
            proptest::collection::vec((any::<String>(), 0.1..30.0f64), fewest..5).prop_map(stacked).boxed()
        }
        ParameterKind::CsvPath { .. } => Just(None).boxed(),
    }
}

/// Scenes all over the ranges: every key drawn, then those that others limit drawn again within what is left.
fn any_scene() -> impl Strategy<Value = Scene> {
    let values: Vec<_> = PARAMETERS
        .iter()
        .map(
            |p| if p.absent.is_some() { prop_oneof![Just(None), any_value(p.kind)].boxed() } else { any_value(p.kind) },
        )
        .collect();
    (any::<bool>(), values, 0.0..1.0f64).prop_map(|(is_motor, values, share)| {
        let mut scene = if is_motor { Scene::motor() } else { Scene::plate() };
        // The model first: it decides which keys apply.
        for keep in ["rotor.model", ""] {
            for (parameter, value) in PARAMETERS.iter().zip(&values) {
                let applies = parameter.key.starts_with(keep)
                    && scene.parameters().any(|p| p.key == parameter.key)
                    && scene.heeds(parameter.key);
                if let (true, Some(value)) = (applies, value) {
                    scene.set_value(parameter.key, value.clone()).unwrap();
                }
            }
        }
        let closed = scene.get("numerics.flow") == Some(Value::Text("across".to_owned()));
        if (closed || scene.get("film.shear") == Some(Value::Flag(false))) && is_motor {
            scene.set("numerics.wedge", "off").unwrap();
        }
        if scene.get("surface.flow_factors") == Some(Value::Text("patir-cheng".to_owned())) {
            scene.set("numerics.time", "march").unwrap();
        }
        // A section may be too stiff or too soft for any rotor.
        if scene.check().is_err_and(|error| error.faults().iter().any(|fault| fault.what.key() == Some("rotor.model")))
        {
            scene.set("rotor.model", "beam").unwrap();
        }
        let limited = ["stator.tooth_width_mm", "plate.amplitude_um", "plate.inner_radius_mm"];
        for key in limited.into_iter().chain(["motor.load_n", "motor.rotor_speed_mm_per_s"]) {
            if let Some(range) = scene.range(key).filter(|_| scene.get(key).is_some()) {
                let value = range.min + share * (range.max - range.min);
                scene.set_value(key, Value::Number(value)).unwrap();
            }
        }
        scene
    })
}

fn bits(value: Value) -> Vec<u64> {
    match value {
        Value::Number(x) => vec![x.to_bits()],
        Value::Rows(rows) => rows.iter().flat_map(|(k, c)| [k.to_bits(), c.to_bits()]).collect(),
        Value::Records(records) => records.into_iter().flatten().flat_map(bits).collect(),
        _ => Vec::new(),
    }
}

proptest! {
    #[test]
    fn a_saved_scene_loads_back_bit_for_bit(scene in any_scene()) {
        scene.check().unwrap();
        let text = scene.to_toml();
        let loaded = read(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        prop_assert_eq!(&loaded, &scene);
        for parameter in scene.parameters() {
            prop_assert_eq!(loaded.get(parameter.key).map(bits), scene.get(parameter.key).map(bits));
        }
        Problem::try_from(&loaded).unwrap();
    }

    #[test]
    fn set_of_what_get_shows_changes_nothing(scene in any_scene()) {
        let mut copy = scene.clone();
        for parameter in scene.parameters().filter(|parameter| scene.heeds(parameter.key)) {
            match scene.get(parameter.key) {
                Some(Value::Number(number)) => copy.set(parameter.key, &number.to_string()).unwrap(),
                Some(Value::Whole(whole)) => copy.set(parameter.key, &whole.to_string()).unwrap(),
                Some(value) => copy.set_value(parameter.key, value).unwrap(),
                None => {}
            }
        }
        prop_assert_eq!(copy, scene);
    }

    #[test]
    fn no_text_panics(text in "(schema = 1\n)?(\\[(film|motor|rotor)\\]\n)?(compliance|waves|model|slip)? ?=? ?\\PC{0,40}") {
        let _ = read(&text);
        let mut scene = Scene::motor();
        for parameter in PARAMETERS {
            let _ = scene.set(parameter.key, &text);
        }
        let _ = presets::find(&text);
    }
}

#[test]
fn a_plate_refuses_changes_of_what_it_does_not_heed_and_loads_files_that_have_it() {
    let text =
        "schema = 1\nscene = \"plate\"\n[film]\nmin_spacing_nm = 100\nshear = false\n[numerics]\nwedge = \"on\"\n";
    let mut plate = read(text).unwrap();
    assert_eq!(plate.get("film.min_spacing_nm"), Some(Value::Number(100.0)));
    assert_eq!(Scene::from_toml(&plate.to_toml(), "saved.toml").unwrap(), plate);
    let before = plate.clone();
    for (key, text) in [("film.min_spacing_nm", "200"), ("film.shear", "true"), ("numerics.teeth", "all")] {
        let message = plate.set(key, text).unwrap_err().to_string();
        assert_eq!(message, format!("{key} has no effect on a plate: it cannot be changed or varied here"));
        assert_eq!(plate, before);
    }
    plate.set("film.viscosity_upa_s", "20").unwrap();
    plate.set("numerics.steps_per_cycle", "72").unwrap();
}

#[test]
fn the_wedge_cannot_be_asked_for_and_ruled_out() {
    let error = read("schema = 1\n[film]\nshear = false\n[numerics]\nwedge = \"on\"\n").unwrap_err();
    assert_eq!((error.faults().len(), error.faults()[0].line), (1, Some(5)), "{error}");
    let told = error.to_string();
    assert!(told.contains("numerics.wedge = \"on\"") && told.contains("film.shear = false"), "{told}");
    let mut scene = Scene::motor();
    assert!(scene.set_all([("film.shear", "false"), ("numerics.wedge", "on")]).is_err());
    assert_eq!(scene, Scene::motor());
    scene.set_all([("film.shear", "false"), ("numerics.wedge", "off")]).unwrap();
}

// ---- the numbers of a scene that tell its regime

fn close(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 1e-12
}

#[test]
fn fundamental_case_by_hand() {
    let numbers = dimensionless(&Scene::motor());
    let omega = std::f64::consts::TAU * 30e3;
    let sigma = 12.0 * 18.1e-6 * omega * 1.7353e-3 * 1.7353e-3 / (101_325.0 * 200e-9 * 200e-9);
    assert!(close(numbers.squeeze_number, sigma));
    assert!((numbers.squeeze_number - 30_418.0).abs() < 1.0, "{}", numbers.squeeze_number);
    let lambda = 6.0 * 18.1e-6 * (omega * 1e-6) * 1.7353e-3 / (101_325.0 * 200e-9 * 200e-9);
    assert!(close(numbers.bearing_number, lambda));
    assert!(close(numbers.bearing_to_squeeze, lambda / sigma));
    assert!(close(numbers.knudsen_number, 0.32));
    // D = (h² p + 6 λ p h)/(12 μ); about 24 µm, one cell of the paper's grid.
    let d = (200e-9 * 200e-9 * 101_325.0 + 6.0 * 64e-9 * 101_325.0 * 200e-9) / (12.0 * 18.1e-6);
    assert!(close(numbers.boundary_layer, (2.0 * d / omega).sqrt()));
}

#[test]
fn the_rotor_adds_to_the_sliding_speed_whichever_way_it_turns() {
    let of = |rpm: &str| dimensionless(&Scene::motor().with([("motor.rotor_speed_rpm", rpm)]).unwrap()).bearing_number;
    assert!(of("300") > 2.0 * of("0"));
    assert_eq!(of("300"), of("-300"));
}

#[test]
fn slip_thickens_the_layer() {
    let of = |slip: &str| dimensionless(&Scene::plate().with([("film.slip", slip)]).unwrap()).boundary_layer;
    assert!(close((of("first-order") / of("none")).powi(2), 1.384));
    assert!(of("second-order") > of("first-order"));
}

#[test]
fn plate_presets_span_the_regimes() {
    let of = |name: &str| dimensionless(&presets::find(name).unwrap());
    assert!((0.25..0.35).contains(&of("plate-viscous").squeeze_number));
    assert!((10.0..20.0).contains(&of("plate-crossover").squeeze_number));
    assert!(of("plate-trapped").squeeze_number > 3000.0);
    assert_eq!(of("plate-trapped").bearing_number, 0.0);
}

#[test]
fn a_table_says_what_it_does_not_cover() {
    let motor = motor(&presets::find("fundamental").unwrap());
    let told = |rows: &[(f64, f64)]| {
        Motor { rotor: RotorCompliance::Table(rows.to_vec()), ..motor.clone() }.compliance_not_covered()
    };
    assert_eq!(motor.compliance_not_covered(), None);
    assert_eq!(told(&[(241.4, 2e-9), (4000.0, 1e-10)]), None);
    let below = told(&[(300.0, 2e-9), (4000.0, 1e-10)]).unwrap();
    assert!(below.contains("300 to 4000 1/m: the wave itself, 241.4") && !below.contains("tooth"), "{below}");
    let above = told(&[(200.0, 2e-9), (900.0, 1e-10)]).unwrap();
    assert!(above.contains("a tooth, 3621") && !above.contains("the wave itself"), "{above}");
    let neither = told(&[(100.0, 2e-9)]).unwrap();
    assert!(neither.contains("100 1/m only") && neither.contains("of the last row; waves"), "{neither}");
}
