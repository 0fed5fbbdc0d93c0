//! What a solve is estimated to need of memory, against what it allocates at most.

// clippy.toml allows this inside #[test] functions; the helpers of this file are tests too.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod scenes;

use scenes::problem;
use squeezefilm::budget::MemoryUse;
use squeezefilm::control::{Cancel, Progress};
use squeezefilm::export::files::{self, Control, Folder, Solved};
use squeezefilm::export::json::Summary;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::memory;
use squeezefilm::paper;
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Numerics, Problem, RotorCompliance, Scenario, Time};
use squeezefilm::rotor;
use squeezefilm::rotor::ring::{Band, MATERIALS, Part, Section};
use squeezefilm::scene::presets;
use squeezefilm::solve::{Method, Record, Settings, SolveError, check, solve};
use squeezefilm::startup::{self, startup};
use std::process::Command;

/// At most a tenth too low, or a factor of 2 too high.
const ALLOWED: std::ops::RangeInclusive<f64> = 0.9..=2.0;

/// The fault of an estimate, which `run` returns, if it is not as much as that allocates.
fn fault(what: &str, run: impl FnOnce() -> u64) -> Option<String> {
    let mut bytes = 0;
    let most = allocation_counter::measure(|| bytes = run()).bytes_max;
    let ratio = bytes as f64 / most as f64;
    println!("{what}: estimated {:.2} MB, allocated {:.2} MB, ratio {ratio:.2}", bytes as f64 / 1e6, most as f64 / 1e6);
    (!ALLOWED.contains(&ratio)).then(|| format!("{what}: the estimate is {ratio:.2} times what is allocated"))
}

/// Rings: the preset's, one rectangle, and one whose mesh is as large as it may be.
fn rings() -> Vec<(&'static str, Section, Band)> {
    let part = |name: &str, [inner, outer, bottom, top]: [f64; 4]| {
        let [inner_radius, outer_radius, bottom, top] = [inner, outer, bottom, top].map(|mm| 1e-3 * mm);
        Part { name: name.to_owned(), inner_radius, outer_radius, bottom, top, material: MATERIALS[0] }
    };
    let motor = scenes::motor("ring-rotor", &[]);
    let RotorCompliance::Ring(preset) = &motor.rotor else { unreachable!("its rotor is a ring") };
    let band = motor.wave().band;
    let block = Section::new(vec![part("block", [20.0, 32.0, 0.0, 8.0])], Vec::new()).unwrap();
    let rib = |i: usize| part(&format!("rib {i}"), [20.0 + i as f64, 20.4 + i as f64, -0.1 * i as f64, 1.0]);
    let ribs = [part("plate", [20.0, 32.0, 1.0, 2.0])].into_iter().chain((0..10).map(rib)).collect();
    let ribs = Section::new(ribs, Vec::new()).unwrap();
    let lowest = Band { radius: 29.2e-3, width: 0.3e-3 };
    vec![("ring-rotor", preset.clone(), band), ("block", block, band), ("ribs", ribs, lowest)]
}

#[test]
fn a_ring_takes_what_is_estimated() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for ((name, section, band), times) in rings().into_iter().zip([4, 1, 1]) {
        let need = [rotor::need(&section, band, times).unwrap(), rotor::need_of_frequencies(&section).unwrap()];
        let compliances = || {
            section.compliances(band, 7, 200, times, &Cancel::new()).unwrap();
            need[0].bytes
        };
        let frequencies = || {
            section.natural_frequencies(&[7], 1, &Cancel::new()).unwrap();
            need[1].bytes / rotor::RESONANCES as u64
        };
        println!("{:?}", need.map(|need| need.what));
        // What is allocated is counted thread by thread.
        assert_eq!(one.install(|| fault(&format!("{name}, compliances"), compliances)), None);
        assert_eq!(one.install(|| fault(&format!("{name}, frequencies"), frequencies)), None);
    }
}

/// What a solve that ended with so many steps a cycle on its finest grid was estimated to need.
fn need(problem: &Problem, settings: &Settings, steps: usize) -> u64 {
    let reached = |plan: Plan| {
        let finest = plan.grids.last().unwrap().steps;
        let further = (0..plan.most_grids).find(|doublings| finest << doublings >= steps).unwrap();
        let maps = settings.record == Record::Everything;
        Plan { maps, most_grids: plan.grids.len() + further, ..plan }
    };
    match (&problem.scenario, settings.method) {
        (Scenario::Motor(motor), Method::Auto) => {
            memory::motor(motor, &reached(Plan::motor(motor, settings.fidelity, &problem.numerics).unwrap())).bytes
        }
        (Scenario::Motor(motor), Method::Paper) => {
            let paper::Mesh { nx, ny, n, steps } = paper::Mesh::of(&problem.numerics);
            memory::paper(motor, (nx, ny, n, steps)).bytes
        }
        (Scenario::Plate(plate), _) => {
            memory::plate(plate, &reached(Plan::plate(plate, settings.fidelity, &problem.numerics))).bytes
        }
    }
}

#[test]
fn the_estimate_is_what_is_allocated() {
    type Case = (&'static str, &'static [(&'static str, &'static str)], Fidelity, Method, Record);
    let (auto, paper, all, numbers) = (Method::Auto, Method::Paper, Record::Everything, Record::Numbers);
    let teeth = &[("numerics.teeth", "all"), ("numerics.width", "full"), ("numerics.wedge", "on")];
    let fine = &[("numerics.film_nodes_along", "61"), ("numerics.film_nodes_across", "61")];
    let cases: &[Case] = &[
        ("fundamental", &[], Fidelity::Standard, auto, all),
        ("fundamental", &[], Fidelity::Reference, auto, all),
        ("fundamental", &[], Fidelity::Reference, auto, numbers),
        ("fundamental", teeth, Fidelity::Fine, auto, all),
        ("fundamental", &[("numerics.time", "trapped")], Fidelity::Reference, auto, all),
        ("fundamental", &[("numerics.steps_per_cycle", "20000")], Fidelity::Draft, auto, all),
        ("fundamental", fine, Fidelity::Draft, auto, all),
        ("plate-trapped", &[("numerics.steps_per_cycle", "20000")], Fidelity::Draft, auto, all),
        ("plate-trapped", &[("plate.width_mm", "1")], Fidelity::Standard, auto, all),
        ("plate-mems", fine, Fidelity::Draft, auto, all),
        (
            "plate-trapped",
            &[("plate.width_mm", "1"), ("numerics.steps_per_cycle", "16")],
            Fidelity::Fine,
            auto,
            numbers,
        ),
        ("fundamental", &[], Fidelity::Standard, paper, all),
        ("fundamental", &[("numerics.film_nodes_across", "201")], Fidelity::Standard, paper, all),
    ];
    let mut wrong = Vec::new();
    for (preset, set, fidelity, method, record) in cases {
        let problem = problem(preset, set);
        let settings = Settings { fidelity: *fidelity, method: *method, record: *record };
        let cancel = Cancel::new();
        // Enough of a long march: what it holds, it holds from the beginning.
        let mut watch = |progress: &Progress| {
            if *method == Method::Paper && progress.iteration == 2 {
                cancel.cancel();
            }
        };
        let what = format!("{preset} {set:?}, {fidelity}, {}, {record:?}", method.name());
        wrong.extend(fault(&what, || {
            let solution = solve(&problem, &settings, &mut watch, &cancel).unwrap();
            need(&problem, &settings, solution.stats.steps_per_cycle)
        }));
    }
    // On grids that are asked for, which are not refined.
    for (preset, set) in [
        ("fundamental", &[("numerics.steps_per_cycle", "72")][..]),
        ("plate-trapped", &[("plate.width_mm", "1"), ("numerics.steps_per_cycle", "64")]),
    ] {
        let problem = problem(preset, set);
        let settings = startup::Settings { fidelity: Fidelity::Draft, cycles: 3, ..startup::Settings::default() };
        let numerics = Numerics { time: Time::March, ..problem.numerics };
        let need = match &problem.scenario {
            Scenario::Motor(motor) => {
                memory::motor_startup(motor, &Plan::motor(motor, settings.fidelity, &numerics).unwrap(), settings.kept)
            }
            Scenario::Plate(plate) => {
                memory::plate_startup(plate, &Plan::plate(plate, settings.fidelity, &numerics), settings.kept)
            }
        };
        let mut last = None;
        wrong.extend(fault(&format!("{preset} from rest"), || {
            startup(&problem, &settings, &mut |cycle| last = Some(cycle), &Cancel::new()).unwrap();
            need.bytes
        }));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn what_needs_too_much_is_refused_before_it_is_allocated() {
    // More than any machine: the default, a part of what this one has, cannot allow it.
    let numerics = [
        ("numerics.film_nodes_along", "2001"),
        ("numerics.film_nodes_across", "501"),
        ("numerics.steps_per_cycle", "100000"),
        ("numerics.teeth", "all"),
        ("stator.teeth_per_wave", "64"),
        ("stator.tooth_width_mm", "0.2"),
    ];
    let problem = problem("fundamental", &numerics);
    let settings = Settings::default();
    let mut told = None;
    let allocated = allocation_counter::measure(|| {
        told = solve(&problem, &settings, &mut (), &Cancel::new()).err();
    });
    assert!(allocated.bytes_max < 1_000_000, "{allocated:?}");
    let Some(SolveError::Memory(excess)) = told else { panic!("{told:?}") };
    assert_eq!(check(&problem, &settings), Err(SolveError::Memory(excess)));
    let MemoryUse::Film { along, across, teeth, .. } = excess.need.what else { panic!("{excess:?}") };
    // Of finite volumes across, rounded up so that half and a quarter of the intervals are whole.
    assert_eq!((along, across, teeth), (2001, 505, 64));
    assert!(excess.need.bytes > excess.allowed && excess.allowed == memory::allowed(), "{excess:?}");
    let message = excess.to_string();
    for words in ["2001 × 505 film nodes on 64 teeth", "numerics.steps_per_cycle", "--memory", "allowed"] {
        assert!(message.contains(words), "{message}");
    }
    let refused = startup(&problem, &startup::Settings::default(), &mut |_| (), &Cancel::new()).unwrap_err();
    assert!(matches!(refused, SolveError::Memory(_)), "{refused}");
}

#[test]
fn the_size_of_the_files_is_known_before_they_are_written() {
    for (preset, set, vtk) in [
        ("fundamental", &[][..], false),
        ("fundamental", &[], true),
        ("plate-trapped", &[], false),
        ("plate-trapped", &[("plate.width_mm", "1")], true),
    ] {
        let problem = problem(preset, set);
        let settings = Settings { fidelity: Fidelity::Standard, ..Settings::default() };
        let solution = solve(&problem, &settings, &mut (), &Cancel::new()).unwrap();
        let summary = Summary::new(&problem, &solution, 0.0, &[]);
        let scene = presets::find(preset).unwrap();
        let solved = Solved { scene: &scene, problem: &problem, solution: &solution, history: &[] };
        let folder = tempfile::tempdir().unwrap();
        let control = Control { cancel: &Cancel::new(), drawn: &|_, _| () };
        let out = Folder { path: folder.path(), command: &[], formats: Vec::new(), vtk };
        let paths = files::solve(&out, &solved, &summary, &control).unwrap();
        let written: u64 = paths.iter().map(|path| path.metadata().unwrap().len()).sum();
        let ratio = files::expected_size(&out, &problem, &solution.recording) as f64 / written as f64;
        println!("{preset} {set:?}: {written} bytes written, expected {ratio:.3} of them");
        assert!((0.9..1.1).contains(&ratio), "{preset} {set:?}: {ratio}");
    }
}

#[test]
fn every_command_that_solves_takes_a_budget_and_keeps_it() {
    let run = |arguments: &str| {
        let command = Command::new(env!("CARGO_BIN_EXE_squeezefilm")).args(arguments.split(' ')).output().unwrap();
        (command.status.code(), String::from_utf8(command.stderr).unwrap())
    };
    let folder = tempfile::tempdir().unwrap();
    let movie = folder.path().join("wave.gif");
    for command in [
        "solve fundamental",
        "solve plate-trapped",
        "solve fundamental --method paper",
        "sweep fundamental --vary film.min_spacing_nm=100:200:3",
        "compare fundamental levitating",
        "startup fundamental",
        "tradeoff fundamental",
        "table1",
        &format!("animate fundamental --out {}", movie.display()),
    ] {
        let (status, told) = run(&format!("{command} --memory 20KB"));
        assert_eq!(status, Some(2), "{command}: {told}");
        assert!(told.contains("of memory: allowed 20 kB") && told.contains("--memory"), "{command}: {told}");
    }
    assert!(!movie.exists());
    assert_eq!(run("solve fundamental --memory 100MB").0, Some(0));
    // A dropped plate takes 16 MB.
    let dropped = run("startup floating-disc --fidelity draft --cycles 1 --memory 50MB");
    assert_eq!(dropped.0, Some(3), "{}", dropped.1);
    let one = run("sweep fundamental --fidelity draft --vary film.min_spacing_nm=100:200:12 --memory 1MB --threads 8");
    assert_eq!(one.0, Some(0), "{}", one.1);
    for wrong in ["4", "-1GB", "0MB", "nanGB", "many", "GB"] {
        let (status, told) = run(&format!("solve fundamental --memory={wrong}"));
        assert!(status == Some(2) && told.contains("as in 4GB or 500MB"), "{wrong}: {told}");
    }
}
