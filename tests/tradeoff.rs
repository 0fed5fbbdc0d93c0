//! Error against time as the user sees it. No time is asserted: a machine is as fast as it is.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on fails")]

mod program;

use program::{done, err, json, out, refused, run};
use serde_json::Value;
use squeezefilm::analysis::quantity::Quantity;
use squeezefilm::analysis::tradeoff::{Effort, candidates, measure};
use squeezefilm::control::Cancel;
use squeezefilm::problem::Problem;
use squeezefilm::scene::presets;

#[test]
fn table_and_files_of_a_plate_agree() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let wishes = ["--accuracy=50%", "--budget=10min", "--repeats=2"];
    let object = json(&done(&[&["tradeoff", "plate-crossover", "--json", "--out", path][..], &wishes].concat()));
    assert_eq!((&object["judged"], &object["schema"]), (&"film_load_n".into(), &1.into()));
    let settings = object["settings"].as_array().unwrap();
    let number = |setting: &Value, name: &str| setting[name].as_f64().unwrap();
    for setting in settings {
        assert_eq!((&setting["status"], &setting["runs"]), (&"converged".into(), &2.into()));
        assert!(number(setting, "lower_quartile_s") <= number(setting, "median_s"));
        let (error, measured, stated) =
            (number(setting, "error"), number(setting, "measured_error"), number(setting, "stated_error"));
        assert!(error == measured.max(stated) && error > 0.0);
    }
    assert!(settings.iter().any(|setting| setting["pareto"] == true));
    let reference = settings.iter().find(|setting| setting["reference"] == true).unwrap();
    assert_eq!(object["reference"], reference["setting"]);
    // Ten minutes are enough for the most accurate, and half the value is any setting's error.
    let least = settings.iter().map(|s| number(s, "error")).fold(f64::INFINITY, f64::min);
    let chosen = |i: usize| settings.iter().find(|s| s["setting"] == object["chosen"][i]["setting"]).unwrap();
    assert_eq!(number(chosen(1), "error"), least);
    let fastest = settings.iter().map(|s| number(s, "median_s")).fold(f64::INFINITY, f64::min);
    assert_eq!(number(chosen(0), "median_s"), fastest);

    let mut reader = csv::Reader::from_path(folder.path().join("tradeoff.csv")).unwrap();
    let names = reader.headers().unwrap().clone();
    let column = |name: &str| names.iter().position(|found| found == name).unwrap();
    let records: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(records.len(), settings.len());
    for (record, setting) in records.iter().zip(settings) {
        for name in ["setting", "options"] {
            assert_eq!(&record[column(name)], setting[name].as_str().unwrap());
        }
        assert_eq!(record[column("film_steps")].parse::<u64>().unwrap(), setting["film_steps"].as_u64().unwrap());
        assert!((record[column("error")].parse::<f64>().unwrap() / number(setting, "error") - 1.0).abs() < 1e-12);
    }
}

/// What a printed command without quoting, after the program's name, gives as JSON.
fn solve_again(words: &str) -> String {
    let words: Vec<&str> = words.split_whitespace().chain(["--json"]).collect();
    let output = run(&words);
    assert!([Some(0), Some(3)].contains(&output.status.code()), "{words:?}: {}", err(&output));
    out(&output).to_owned()
}

/// A number as it is written, which is with the digits that read back to the same bits (serde_json's own reader rounds).
fn number_in(json: &str, name: &str) -> Option<f64> {
    json.split(&format!("\"{name}\": ")).nth(1)?.split([',', '\n']).next()?.parse().ok()
}

#[test]
fn every_setting_is_the_solve_that_its_options_ask_for_to_the_last_bit() {
    for (preset, changes) in [
        ("fundamental", &[][..]),
        // A switch of the model is kept; a grid of the scene gives way, and is one of the settings.
        ("fundamental", &[("numerics.flow", "along"), ("numerics.wedge", "on")]),
        ("doubled-mesh", &[("film.min_spacing_nm", "150"), ("numerics.steps_per_cycle", "72")]),
        ("plate-viscous", &[("numerics.film_nodes_across", "9")]),
    ] {
        let scene = presets::find(preset).unwrap().with(changes).unwrap();
        let problem = Problem::try_from(&scene).unwrap();
        let mut all = candidates(&problem);
        // What takes seconds each is one of its family.
        let slow = ["reference", "accuracy 0.05%", "paper", "paper, twice its mesh", "fine, 65 × 33 × 180"];
        all.retain(|candidate| !slow.contains(&candidate.name.as_str()));
        let effort = Effort { repeats: Some(1), longest: f64::INFINITY, ..Effort::default() };
        let runs = measure(&problem, all, &effort, &|| 0.0, &Cancel::new(), &mut |_, _| ());
        let set: String = changes.iter().map(|(key, value)| format!(" --set {key}={value}")).collect();
        for run in runs {
            let command = format!("solve {preset}{set} {}", run.candidate.options);
            let again = solve_again(&command);
            let judged = if preset.starts_with("plate") { Quantity::FilmLoad } else { Quantity::Alpha };
            let value = run.numbers.get(judged);
            assert!(value.is_some(), "{command}: {:?}", run.status);
            assert_eq!(number_in(&again, judged.name()), value, "{command}");
            let error = judged.error().unwrap();
            assert_eq!(number_in(&again, error.name()), run.numbers.get(error), "{command}");
        }
    }
}

#[test]
fn settings_share_the_time_equally() {
    let problem = Problem::try_from(&presets::find("fundamental").unwrap()).unwrap();
    let all: Vec<_> =
        candidates(&problem).into_iter().filter(|one| ["draft", "standard"].contains(&&*one.name)).collect();
    assert_eq!(all.len(), 2);
    // It is a quarter of a second later whenever the clock is looked at.
    let looks = std::cell::Cell::new(0.0);
    let clock = || {
        looks.set(looks.get() + 0.25);
        looks.get()
    };
    let effort = Effort { repeats: None, seconds: 60.0, ..Effort::default() };
    for run in measure(&problem, all, &effort, &clock, &Cancel::new(), &mut |_, _| ()) {
        assert_eq!(run.times.len(), (30.0 / run.times[0]) as usize, "{:?}", run.times);
    }
}

#[test]
fn the_command_that_is_recommended_gives_what_the_table_shows() {
    let set = ["--set", "film.slip=second-order", "--set", "numerics.film_nodes_along=21"];
    let output = run(&[&["tradeoff", "plate-crossover", "--repeats=1", "--accuracy=0.2%"][..], &set].concat());
    let text = out(&output);
    let command = text.lines().find_map(|line| line.strip_prefix("  squeezefilm ")).unwrap();
    assert!(set.iter().all(|word| command.contains(word)), "{command}");
    let (_, chosen) = text.split_once("at most 0.20 %: ").unwrap();
    let name = chosen.split(", off").next().unwrap().rsplit_once(", ").unwrap().0;
    let row = text.lines().find(|line| line.trim_start().starts_with(&format!("{name}  "))).unwrap();
    let load = number_in(&solve_again(command), "film_load_n").unwrap();
    let shown = squeezefilm::digits::significant(load, 5);
    assert!(row.split_whitespace().any(|cell| cell == shown), "{command} gives {shown}, but: {row}");
}

#[test]
fn a_wish_that_is_none_has_status_2_and_one_that_nothing_fulfils_1() {
    for (wish, words) in
        [("--accuracy=-1%", "0.0001% to 50%"), ("--budget=16", "20ms, 1.5s"), ("--repeats=0", "--repeats")]
    {
        refused(&["tradeoff", "plate-crossover", wish], 2, &[words]);
    }
    let output = run(&["tradeoff", "plate-crossover", "--repeats=1", "--accuracy=0.0001%"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("none of these"));
}

#[cfg(feature = "gui")]
#[test]
fn the_present_setting_of_the_window_is_always_measured() {
    use squeezefilm::fidelity::Fidelity;
    use squeezefilm::gui::state::tradeoff::{is_present, with_present};
    use squeezefilm::problem::Numerics;
    let problem = Problem::try_from(&presets::find("fundamental").unwrap()).unwrap();
    let mut all = candidates(&problem);
    let count = all.len();
    with_present(&mut all, Fidelity::Fine, Numerics::default());
    assert_eq!(all.len(), count, "a fidelity is there already");
    let own = Numerics { steps_per_cycle: Some(48), ..Numerics::default() };
    with_present(&mut all, Fidelity::Draft, own);
    assert!(all.len() == count + 1 && is_present(&all[count], Fidelity::Draft, own));
}
