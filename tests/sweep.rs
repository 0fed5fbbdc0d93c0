//! Sweeps: each row is the solve of its scene, whatever the number of threads and however often it was cancelled.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod program;

use program::{done, err, json, out, refused, run, squeezefilm};
use serde_json::Value;
use squeezefilm::analysis::attempt::RunStatus;
use squeezefilm::analysis::quantity::{Numbers, Quantity};
use squeezefilm::analysis::sweep::{Sweep, SweepPart, SweepRow, Vary};
use squeezefilm::analysis::validity::{names, outside};
use squeezefilm::atomic::Lock;
use squeezefilm::control::Cancel;
use squeezefilm::export::saved;
use squeezefilm::export::sweep::write_csv;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::problem::Problem;
use squeezefilm::scene::presets;
use squeezefilm::solve::{Method, Record, Settings, solve};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

const DRAFT: Settings = Settings { fidelity: Fidelity::Draft, method: Method::Auto, record: Record::Everything };

fn sweep(preset: &str, vary: &[&str]) -> Sweep {
    sweep_of(&[], preset, vary)
}

fn sweep_of(changes: &[(&str, &str)], preset: &str, vary: &[&str]) -> Sweep {
    let vary: Vec<Vary> = vary.iter().map(|text| text.parse().unwrap()).collect();
    let scene = presets::find(preset).unwrap().with(changes).unwrap();
    Sweep::new(&scene, &vary, &DRAFT).unwrap()
}

fn with_threads(threads: usize, sweep: &Sweep) -> Vec<SweepRow> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| sweep.run(&[], &Cancel::new(), &|_| ()))
}

fn csv_of(sweep: &Sweep, rows: &[SweepRow]) -> String {
    let mut text = Vec::new();
    write_csv(sweep, rows, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

/// What is kept of a part, or of the whole that is not complete.
fn saved_text(sweep: &Sweep, part: SweepPart, rows: &[SweepRow]) -> String {
    let mut text = Vec::new();
    saved::write(sweep, part, rows, &[], &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

#[test]
fn each_row_is_the_single_solve_of_its_scene_with_any_number_of_threads() {
    let maps = [
        sweep("fundamental", &["film.min_spacing_nm=80:400:3:log", "stator.frequency_khz=10:50:5"]),
        sweep("plate-crossover", &["plate.frequency_khz=1:100:6:log"]),
        // The narrow one yields: that is known from the fields, which a sweep does not keep.
        sweep_of(&[("motor.load_per_wave_n", "60")], "fundamental", &["rotor.contact_width_mm=0.01:0.3:2"]),
    ];
    for sweep in &maps {
        let rows = with_threads(1, sweep);
        assert_eq!(rows.len(), sweep.len());
        for (point, row) in rows.iter().enumerate() {
            let problem = Problem::try_from(&sweep.scene_at(point).unwrap()).unwrap();
            let alone = solve(&problem, &DRAFT, &mut (), &Cancel::new()).unwrap();
            assert_eq!((row.point, &row.status), (point, &RunStatus::Converged));
            assert_eq!(row.outside, names(&outside(&problem, &alone)), "point {point}");
            let alone = Numbers::of(&problem, &alone);
            // The first of a chunk starts cold, a plate always; the others from their neighbour.
            let line = sweep.axes().last().unwrap().values.len();
            if (point % line).is_multiple_of(4) || row.numbers.get(Quantity::Alpha).is_none() {
                assert_eq!(row.numbers, alone, "point {point}");
            } else {
                let get = |numbers: &Numbers, quantity| numbers.get(quantity).unwrap();
                let apart = (get(&row.numbers, Quantity::Alpha) - get(&alone, Quantity::Alpha)).abs();
                let stated = get(&alone, Quantity::AlphaError);
                assert!(apart < 0.3 * stated, "point {point}: {apart:.1e} apart, stated {stated:.1e}");
            }
        }
        let yields = |row: &SweepRow| row.outside.contains(&"contact-stress");
        assert_eq!(rows.iter().map(yields).collect::<Vec<_>>()[..2], [sweep.len() == 2, false]);
        for threads in [2, 3, 8] {
            assert_eq!(with_threads(threads, sweep), rows, "{threads} threads");
        }
    }
}

#[test]
fn a_sweep_of_the_load_finds_the_motor_that_is_pressed_too_hard() {
    // From a contact on the crests alone to one all round the wave: the bound goes on rising, and the stall torque falls behind.
    let set = [("stator.frequency_khz", "40"), ("motor.contact_radius_mm", "60"), ("motor.waves", "9")];
    let scene = presets::find("fundamental").unwrap().with(set).unwrap();
    let sweep = Sweep::new(&scene, &["motor.load_per_wave_n=1.67:16.67:4".parse().unwrap()], &DRAFT).unwrap();
    let rows = with_threads(2, &sweep);
    let column = |quantity| rows.iter().map(|row| row.numbers.get(quantity).unwrap()).collect::<Vec<_>>();
    let (stall, bound) = (column(Quantity::StallTorque), column(Quantity::MaxTorque));
    let share: Vec<f64> = stall.iter().zip(&bound).map(|(stall, bound)| stall / bound).collect();
    assert!(bound.windows(2).all(|pair| pair[0] < pair[1]), "{bound:?}");
    assert!((share[0] - 1.0).abs() < 1e-12 && share.windows(2).all(|pair| pair[1] < pair[0]), "{share:?}");
    assert!((stall[3] - 2.4845).abs() < column(Quantity::StallTorqueError)[3] && bound[3] > 6.29, "{stall:?}");
    for error in [Quantity::NoLoadSpeedError, Quantity::MaxPowerError, Quantity::MaxEfficiencyError] {
        assert!(column(error).iter().all(|error| *error > 0.0), "{error:?}");
    }
}

#[test]
fn a_cancelled_sweep_gone_on_with_equals_an_unbroken_one() {
    let sweep = sweep("fundamental", &["stator.normal_amplitude_um=0.5:2:10"]);
    let whole = with_threads(2, &sweep);
    for after in [1, 4, 6] {
        let (cancel, count) = (Cancel::new(), AtomicUsize::new(0));
        let some = sweep.run(&[], &cancel, &|_| {
            if count.fetch_add(1, Ordering::Relaxed) + 1 == after {
                cancel.cancel();
            }
        });
        assert!((after..sweep.len()).contains(&some.len()), "{}", some.len());
        // By way of the file.
        let kept = saved::read(&sweep, SweepPart::WHOLE, &saved_text(&sweep, SweepPart::WHOLE, &some)).unwrap();
        assert_eq!(kept, some);
        let told = AtomicUsize::new(0);
        let rest = sweep.run(&kept, &Cancel::new(), &|_| {
            told.fetch_add(1, Ordering::Relaxed);
        });
        assert_eq!(rest, whole);
        assert_eq!(told.into_inner(), sweep.len() - some.len());
        assert_eq!(csv_of(&sweep, &rest), csv_of(&sweep, &whole));
    }
    // What was cancelled before it began has no rows.
    let cancel = Cancel::new();
    cancel.cancel();
    assert!(sweep.run(&[], &cancel, &|_| ()).is_empty());
}

/// The arguments with a folder for the files.
fn into<'a>(arguments: &[&'a str], folder: &'a Path) -> Vec<&'a str> {
    [arguments, &["--out", folder.to_str().unwrap()]].concat()
}

const COMMAND: [&str; 4] = ["sweep", "fundamental", "--fidelity=draft", "--vary=stator.frequency_khz=10:50:5"];

#[test]
fn a_title_says_how_exactly_it_is_solved() {
    let title = |asked: &[&str]| {
        let output = run(&[&["sweep", "levitating", "--vary", "stator.frequency_khz=30,40"], asked].concat());
        out(&output).lines().next().unwrap_or_default().to_owned()
    };
    for (asked, words) in [
        (&["--fidelity", "draft"][..], "fidelity draft"),
        (&["--accuracy", "1%"], "accuracy 1 %"),
        (&["--budget", "2ms"], "fidelity reference, in at most 2ms a solve"),
    ] {
        let title = title(asked);
        assert!(title.ends_with(&format!("over stator.frequency_khz, {words}")), "{title}");
    }
}

#[test]
fn files_and_json_agree_and_are_gone_on_with() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("out");
    let object = json(&done(&into(&[&COMMAND[..], &["--json"]].concat(), &folder)));
    assert_eq!(object, serde_json::from_slice::<Value>(&fs::read(folder.join("sweep.json")).unwrap()).unwrap());
    assert_eq!((&object["complete"], &object["axes"][0]["key"]), (&true.into(), &"stator.frequency_khz".into()));
    assert_eq!(object["published"].as_array().unwrap().len(), 4);

    // The figure is of α, or of whatever was asked for.
    let drawn = |folder: &Path| fs::read_to_string(folder.join("sweep.svg")).unwrap();
    assert!(drawn(&folder).contains("error of α up to 0.0"), "{}", drawn(&folder));
    let other = parent.path().join("other");
    done(&into(&[&COMMAND[..], &["--quantity", "stall_torque_nm"]].concat(), &other));
    assert!(
        drawn(&other).contains("error of the stall torque up to 0.0") && !drawn(&other).contains("share of the load")
    );
    let wrong = [&COMMAND[..], &["--quantity", "torque"]].concat();
    refused(&into(&wrong, &other), 2, &["torque: no such number; did you mean max_torque_nm? Allowed: alpha"]);

    // The CSV by a reader of its own: columns by name.
    let text = fs::read_to_string(folder.join("sweep.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names = reader.headers().unwrap().clone();
    let column = |name: &str| names.iter().position(|found| found == name).unwrap();
    let rows = object["rows"].as_array().unwrap();
    let mut count = 0;
    for (record, row) in reader.records().zip(rows) {
        let record = record.unwrap();
        for name in [
            "stator.frequency_khz",
            "alpha",
            "alpha_error",
            "film_load_n",
            "stall_torque_nm",
            "stall_torque_error_nm",
            "no_load_speed_rpm",
            "no_load_speed_error_rpm",
            "max_power_w",
            "max_power_error_w",
            "max_efficiency",
            "max_efficiency_error",
            "max_torque_nm",
            "film_steps",
        ] {
            // The reader of JSON is not exact in the last bit.
            let (csv, json) = (record[column(name)].parse::<f64>().unwrap(), row[name].as_f64().unwrap());
            assert!((csv - json).abs() <= 1e-15 * csv.abs(), "{name}: {csv} {json}");
        }
        assert_eq!((&record[column("status")], row["status"].as_str()), ("converged", Some("converged")));
        assert_eq!((&record[column("residual")], &row["residual"]), ("", &Value::Null));
        count += 1;
    }
    assert_eq!(count, 5);
    // The first row, which starts cold, is what solve prints.
    let first = format!("--set=stator.frequency_khz={}", rows[0]["stator.frequency_khz"]);
    let alone = json(&done(&["solve", "fundamental", "--fidelity=draft", "--json", &first]));
    for name in ["alpha", "alpha_error", "stall_torque_nm", "stall_torque_error_nm", "max_torque_nm"] {
        assert_eq!(rows[0][name], alone[name], "{name}");
    }
    for name in ["no_load_speed_rpm", "max_power_w", "max_power_error_w", "max_efficiency", "max_efficiency_error"] {
        assert_eq!(rows[0][name], alone["merit"]["with_film"][name], "{name}");
    }

    // Two of the five points, as a cancelled run leaves them; the rest is solved, with the same files in the end.
    let again = parent.path().join("again");
    fs::create_dir(&again).unwrap();
    let left = again.join("sweep.incomplete.csv");
    let ours = sweep("fundamental", &["stator.frequency_khz=10:50:5"]);
    let saved = saved_text(&ours, SweepPart::WHOLE, &with_threads(2, &ours)[..2]);
    fs::write(&left, &saved).unwrap();
    assert!(err(&done(&into(&COMMAND, &again))).contains("2 of 5 points were solved before"));
    assert_eq!(fs::read_to_string(again.join("sweep.csv")).unwrap(), text);
    assert!(!left.exists());
    // What belongs to another sweep is neither used nor lost.
    fs::write(&left, &saved).unwrap();
    let other = [&COMMAND[..], &["--set=motor.load_per_wave_n=2"]].concat();
    refused(&into(&other, &again), 2, &["--restart"]);
    assert!(left.exists());
    done(&into(&[&other[..], &["--restart"]].concat(), &again));
    assert!(!left.exists());
    // What somebody has changed is not taken for a result.
    let changed = saved.replacen(",accuracy,slip-law,0.", ",accuracy,slip-law,1.", 1);
    assert_ne!(changed, saved);
    fs::write(&left, &changed).unwrap();
    refused(&into(&COMMAND, &again), 2, &["line 3: the row was changed after it was saved"]);
    assert_eq!(fs::read_to_string(&left).unwrap(), changed);
}

#[test]
fn rows_of_another_budget_are_not_gone_on_with() {
    let ours = sweep("fundamental", &["film.min_spacing_nm=100:300:3"]);
    let mut hasty = ours.clone();
    hasty.budget = Some(Duration::from_millis(1));
    let rows = with_threads(2, &ours);
    let text = saved_text(&hasty, SweepPart::WHOLE, &rows);
    assert!(saved::read(&ours, SweepPart::WHOLE, &text).unwrap_err().contains("budget"));
    assert_eq!(saved::read(&hasty, SweepPart::WHOLE, &text).unwrap(), rows);
    assert_eq!(saved::join(&[("whole".to_owned(), text)]).unwrap().sweep.budget, hasty.budget);
}

#[test]
fn parts_solved_one_by_one_and_joined_are_the_whole_byte_by_byte() {
    let map = sweep("fundamental", &["film.min_spacing_nm=80:400:3:log", "stator.frequency_khz=10:50:6"]);
    let whole = with_threads(2, &map);
    for of in [1, 2, 5, 9] {
        let rows_of = |part: SweepPart| map.run_part(part, &[], &Cancel::new(), &|_| ());
        let part = |part: SweepPart| (part.to_string(), saved_text(&map, part, &rows_of(part)));
        let joined = saved::join(&SweepPart::all(of).map(part).collect::<Vec<_>>()).unwrap();
        assert_eq!(joined.rows, whole, "{of} parts");
        assert_eq!(csv_of(&joined.sweep, &joined.rows), csv_of(&map, &whole), "{of} parts");
    }
}

#[test]
fn a_part_that_is_killed_is_gone_on_with_and_joined_to_the_files_of_the_whole() {
    let parent = tempfile::tempdir().unwrap();
    let (folder, whole) = (parent.path().join("results"), parent.path().join("whole"));
    let map = ["--vary=film.min_spacing_nm=80:400:300:log", "--vary=stator.frequency_khz=10:50:300"];
    let long = ["sweep", "fundamental", "--fidelity=standard", "--threads=1", map[0], map[1]];
    let file = |part: &str| folder.join(format!("sweep.part-{part}.csv"));
    // Killed as soon as something is saved.
    let mut command = squeezefilm(&into(&[&long[..], &["--part=2/3"]].concat(), &folder));
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while !file("2-of-3").exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = fs::read_to_string(file("2-of-3")).unwrap().lines().count() - 2;
    assert!((1..30_000).contains(&left), "{left}");
    let told = format!("{left} of the 30000 points of part 2/3 are solved");
    refused(&["join", file("2-of-3").to_str().unwrap()], 2, &[told.as_str()]);

    // The same with fewer points, to its end: what was solved of its second part is not solved again.
    let folder = parent.path().join("few");
    let file = |part: &str| folder.join(format!("sweep.part-{part}.csv"));
    let command = ["sweep", "fundamental", "--fidelity=draft", "--vary=stator.frequency_khz=10:50:13"];
    let ours = sweep("fundamental", &["stator.frequency_khz=10:50:13"]);
    let second: SweepPart = "2/3".parse().unwrap();
    let rows = ours.run_part(second, &[], &Cancel::new(), &|_| ());
    fs::create_dir(&folder).unwrap();
    fs::write(file("2-of-3"), saved_text(&ours, second, &rows[..1])).unwrap();
    for (part, told) in [("1/3", ""), ("2/3", "1 of 4 points were solved before"), ("3/3", "")] {
        let output = done(&into(&[&command[..], &["--part", part]].concat(), &folder));
        assert!(err(&output).contains(told), "{}", err(&output));
    }
    // A part that is complete is not solved again.
    let again = done(&into(&[&command[..], &["--part=3/3"]].concat(), &folder));
    assert!(err(&again).contains("5 of 5 points were solved before"));
    // Another sweep does not take it for its own.
    let other = ["sweep", "fundamental", "--vary=stator.frequency_khz=10:50:13", "--part=3/3"];
    refused(&into(&other, &folder), 2, &[]);

    done(&into(&command, &whole));
    let parts = ["3-of-3", "1-of-3", "2-of-3"].map(|part| file(part).to_str().unwrap().to_owned());
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    refused(&[&["join"], &parts[..2]].concat(), 2, &["parts are missing: 2/3"]);
    let out = parent.path().join("whole/joined");
    done(&into(&[&["join", "--json"], &parts[..]].concat(), &out));
    for name in ["sweep.csv", "sweep.svg", "sweep.png", "scene.toml"] {
        assert_eq!(fs::read(out.join(name)).unwrap(), fs::read(whole.join(name)).unwrap(), "{name}");
    }
    // But for the folder in the command, which differs here.
    let object = |path: &Path| {
        let text = fs::read_to_string(path.join("sweep.json")).unwrap();
        text.replace(folder.to_str().unwrap(), "OUT").replace(whole.to_str().unwrap(), "OUT")
    };
    assert_eq!(object(&out), object(&whole));
}

#[test]
fn of_ten_million_points_a_part_is_solved_and_the_whole_is_refused() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("results");
    let map = ["--vary=film.min_spacing_nm=80:400:10000:log", "--vary=stator.frequency_khz=10:50:1000"];
    let command = ["sweep", "fundamental", "--fidelity=draft", map[0], map[1]];
    done(&into(&[&command[..], &["--part=50000/100000"]].concat(), &folder));
    let file = folder.join("sweep.part-50000-of-100000.csv");
    // 250 chunks a line, so 25 a part, of four points each.
    assert_eq!(fs::read_to_string(&file).unwrap().lines().count(), 2 + 100);
    refused(&command, 2, &["vary: 10000000 points: allowed up to 100000, or as many in each part"]);
    refused(&["join", file.to_str().unwrap()], 2, &["10000000 points: joined are up to 100000"]);
}

#[test]
fn two_sweeps_into_one_folder_do_not_destroy_each_other() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("out");
    fs::create_dir(&folder).unwrap();
    let lock = Lock::of(&folder, "sweep").unwrap();
    let other = ["sweep", "fundamental", "--fidelity=draft", "--vary=motor.load_per_wave_n=1:2:2"];
    for command in [&COMMAND[..], &other, &["sweep", "fundamental", "--restart", "--vary=motor.load_per_wave_n=1:2:2"]]
    {
        refused(&into(command, &folder), 2, &["another sweep is being saved into this folder"]);
    }
    // Without it the folder is free, and nothing of the lock is left.
    drop(lock);
    done(&into(&[&other[..], &["--figures=none"]].concat(), &folder));
    let mut names: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["scene.toml", "sweep.csv", "sweep.json"]);
}

#[test]
fn what_does_not_converge_is_marked_and_the_rest_goes_on() {
    let coarse = ["film_nodes_along=21", "film_nodes_across=7", "contact_nodes=91", "steps_per_cycle=60"];
    let sets: Vec<String> = coarse.iter().map(|set| format!("--set=numerics.{set}")).collect();
    let mut arguments = vec!["sweep", "fundamental", "--method=paper", "--vary=film.min_spacing_nm=20:200:2"];
    arguments.extend(sets.iter().map(String::as_str));
    arguments.push("--json");
    let output = run(&arguments);
    assert_eq!(output.status.code(), Some(3), "{}", err(&output));
    let object = json(&output);
    assert_eq!(object["rows"][0]["status"], "not converged");
    assert!(object["rows"][0]["residual"].as_f64() > object["rows"][0]["tolerance"].as_f64());
    assert_eq!(object["rows"][1]["status"], "converged");
    assert!(object["rows"][1][Quantity::Alpha.name()].is_number());
    // A solve says the same.
    let scene = ["fundamental", "--json", "--set=numerics.time=trapped", "--set=film.min_spacing_nm=5000"];
    let swept = json(&run(&[&["sweep", "--vary=motor.load_per_wave_n=2,3"], &scene[..]].concat()));
    let solved = json(&run(&[&["solve", "--set=motor.load_per_wave_n=2"], &scene[..]].concat()));
    assert_eq!(solved["status"], "not resolved");
    assert_eq!(swept["rows"][0]["status"], solved["status"]);
}

#[test]
fn stiffness_and_damping_of_a_strip_are_those_of_a_solve() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("out");
    let sweep =
        ["sweep", "plate-crossover", "--vary=plate.frequency_khz=1,2", "--quantity=stiffness_n_per_m", "--json"];
    let swept = json(&done(&into(&sweep, &folder)));
    for (row, frequency) in swept["rows"].as_array().unwrap().iter().zip(["1", "2"]) {
        let set = format!("plate.frequency_khz={frequency}");
        let solved = json(&done(&["solve", "plate-crossover", "--set", &set, "--json"]));
        for name in ["stiffness_n_per_m", "damping_n_s_per_m"] {
            let [one, other] = [&row[name], &solved["exact"][name]].map(|found| found.as_f64().unwrap());
            assert!((one / other - 1.0).abs() < 1e-9, "{name} {one} {other}");
        }
    }
    assert!(fs::read_to_string(folder.join("sweep.svg")).unwrap().contains("dynamic stiffness"));
}
