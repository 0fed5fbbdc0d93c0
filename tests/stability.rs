//! Maps of where a method solves, as the user sees them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod program;

use program::{done, json, out, refused};
use squeezefilm::analysis::stability::{self, Cell, MAPS, Verdict, survey};
use squeezefilm::control::Cancel;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::scene::Scene;
use squeezefilm::solve::{Method, Settings};

#[test]
fn a_survey_does_not_depend_on_threads_and_keeps_what_is_done_when_cancelled() {
    let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
    let cells = |threads: usize, cancel: &Cancel, finished: &(dyn Fn(&Cell) + Sync)| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let asked = stability::cells(&Scene::motor(), &[&MAPS[1]], &[Method::Auto], 3);
        pool.install(|| survey(&Scene::motor(), asked, &settings, cancel, finished))
    };
    let all = cells(1, &Cancel::new(), &|_| ());
    assert_eq!((all.len(), &cells(3, &Cancel::new(), &|_| ())), (9, &all));
    assert!(all.iter().all(|cell| cell.verdict == Verdict::Solved), "{all:?}");
    let cancel = Cancel::new();
    assert_eq!(
        cells(1, &cancel, &|cell| if cell.place == [1, 1] {
            cancel.cancel()
        }),
        all[..5]
    );
}

#[test]
fn a_map_by_both_methods_in_json_and_csv() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let meshes = ["film_nodes_along=21", "film_nodes_across=7", "contact_nodes=91", "steps_per_cycle=60"];
    let meshes: Vec<String> = meshes.iter().map(|mesh| format!("--set=numerics.{mesh}")).collect();
    let mut arguments = vec!["stability", "--map=spacing-frequency", "--cells=2", "--fidelity=draft", "--json"];
    arguments.extend(meshes.iter().map(String::as_str));
    arguments.extend(["--out", path]);
    // What a cancelled run has left goes when all is there.
    let left = folder.path().join("stability.incomplete.csv");
    std::fs::write(&left, "map\n").unwrap();
    let object = json(&done(&arguments));
    let cells = object["cells"].as_array().unwrap();
    assert_eq!((cells.len(), left.exists()), (8, false));
    let mut reader = csv::Reader::from_path(folder.path().join("stability.csv")).unwrap();
    let names = reader.headers().unwrap().clone();
    let column = |name: &str| names.iter().position(|found| found == name).unwrap();
    for (record, cell) in reader.records().zip(cells) {
        let record = record.unwrap();
        for name in ["map", "method", "verdict", "x_key", "options"] {
            assert_eq!(&record[column(name)], cell[name].as_str().unwrap());
        }
        assert_eq!(record[column("x")].parse::<f64>().unwrap(), cell["x"].as_f64().unwrap());
    }
    let of = |method: &str| cells.iter().filter(|cell| cell["method"] == method).collect::<Vec<_>>();
    assert_eq!((of("auto").len(), of("paper").len()), (4, 4));
    // The paper's coupling loses its way in the stiffest film; where it does, it says so.
    let stiff = of("paper").into_iter().find(|cell| cell["x"] == 5.0 && cell["y"] == 10000.0).unwrap();
    assert!(stiff["verdict"] != "solved" && !stiff["detail"].as_str().unwrap().is_empty(), "{stiff}");
}

#[test]
fn what_cannot_be_mapped_has_status_2() {
    for (arguments, words) in [
        (&["stability", "plate-viscous"][..], "motor"),
        (&["stability", "--map", "spacing"], "spacing-frequency"),
        (&["stability", "--cells", "1"], "--cells"),
        (&["stability", "--set", "film.min_spacing_nm=3"], "5 to 10000 nm"),
        (
            &["stability", "asperities", "--map", "steps-spacing"],
            "No map steps-spacing, which varies numerics.steps_per_cycle and film.min_spacing_nm: film.min_spacing_nm belongs to",
        ),
    ] {
        refused(arguments, 2, &[words]);
    }
}

#[test]
fn maps_that_a_scene_does_not_have_are_told_with_the_reason() {
    let base = ["stability", "asperities", "--method=auto", "--cells=2", "--fidelity=draft"];
    let maps = ["--map=spacing-frequency", "--map=load-amplitude", "--set=motor.load_n=20"];
    let arguments = [&base[..], &maps].concat();
    let output = done(&arguments);
    let text = out(&output);
    assert!(text.contains("  load-amplitude  auto        4 "), "{text}");
    assert!(
        text.contains("\nNo map spacing-frequency, which varies film.min_spacing_nm and stator.frequency_khz:"),
        "{text}"
    );
    let object = json(&done(&[&arguments[..], &["--json"]].concat()));
    assert_eq!(object["cells"].as_array().unwrap().len(), 4);
    assert_eq!(object["unmapped"][0]["map"], "spacing-frequency");
}
