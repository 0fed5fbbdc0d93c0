//! Error against time as the user sees it. No time is asserted: a machine is as fast as it is.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use serde_json::Value;
use std::process::{Command, Output, Stdio};

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_squeezefilm")).args(arguments).stdin(Stdio::null()).output().unwrap()
}

#[test]
fn table_and_files_of_a_plate_agree() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let wishes = ["--accuracy=50%", "--budget=10min", "--repeats=2"];
    let output = run(&[&["tradeoff", "plate-crossover", "--json", "--out", path][..], &wishes].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let object: Value = serde_json::from_slice(&output.stdout).unwrap();
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
        assert_eq!(&record[column("setting")], setting["setting"].as_str().unwrap());
        assert_eq!(record[column("film_steps")].parse::<u64>().unwrap(), setting["film_steps"].as_u64().unwrap());
        assert!((record[column("error")].parse::<f64>().unwrap() / number(setting, "error") - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_wish_that_is_none_has_status_2_and_one_that_nothing_fulfils_1() {
    for (wish, words) in [("--accuracy=-1%", "1% or 0.01"), ("--budget=16", "16ms, 2s"), ("--repeats=0", "--repeats")] {
        let output = run(&["tradeoff", "plate-crossover", wish]);
        assert_eq!((output.status.code(), &output.stdout[..]), (Some(2), &b""[..]), "{wish}");
        assert!(String::from_utf8_lossy(&output.stderr).contains(words), "{wish}");
    }
    let output = run(&["tradeoff", "plate-crossover", "--repeats=1", "--accuracy=1e-15"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("none of these"));
}
