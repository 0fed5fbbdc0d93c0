//! Comparison, sweep and export through the real application, without a display.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use squeezefilm::analysis::compare;
use squeezefilm::analysis::quantity::Quantity;
use squeezefilm::analysis::sweep::Sweep;
use squeezefilm::control::Cancel;
use squeezefilm::export::compare::{difference_text, value_text};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::app::App;
use squeezefilm::gui::dialogs::Answer;
use squeezefilm::gui::pinned::Page;
use squeezefilm::gui::state::Tab;
use squeezefilm::gui::sweeping::Swept;
use squeezefilm::gui::world::World;
use squeezefilm::scene::{Value, presets};
use squeezefilm::solve::Settings;
use std::path::{Path, PathBuf};
use std::time::Duration;

type Window = Harness<'static, App>;

/// A window whose paths are typed.
fn window(preset: &str) -> Window {
    let scene = presets::find(preset).unwrap();
    let world = World { ask: |_, _| Answer::NoDialog, ..World::default() };
    Harness::builder()
        .with_size(Vec2::new(1400.0, 1000.0))
        .build_eframe(move |context| App::in_world(context, Some((scene, None)), world).unwrap())
}

/// Steps until `ready`, at most a minute of waiting in all: solvers work on their own threads.
fn until(window: &mut Window, what: &str, ready: impl Fn(&App) -> bool) {
    for _ in 0..6000 {
        window.step();
        if ready(window.state()) {
            window.run_steps(3);
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("{what}: did not happen");
}

fn solved(window: &mut Window) {
    until(window, "the scene on screen is solved", |app| {
        let number = app.activity().number;
        app.activity().running.is_none()
            && app.shown().is_some_and(|run| run.number == number && run.fidelity == Fidelity::Fine)
    });
}

fn ctrl(window: &mut Window, key: Key) {
    window.key_press_modifiers(Modifiers::COMMAND, key);
    window.run_steps(3);
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

/// Types into a field, over what is there.
fn type_into(window: &mut Window, field: &str, text: &str) {
    window.get_by_role_and_label(Role::TextInput, field).click();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.get_by_role_and_label(Role::TextInput, field).type_text(text);
    window.step();
    window.key_press(Key::Enter);
    window.run_steps(3);
}

fn labels(app: &App) -> Vec<String> {
    app.pins().runs().iter().map(|run| run.label.clone()).collect()
}

/// A window in which the fundamental case and one with half the spacing are pinned.
fn two_pinned() -> Window {
    let mut window = window("fundamental");
    solved(&mut window);
    ctrl(&mut window, Key::D);
    type_into(&mut window, "Minimum spacing H_m in nm", "100");
    solved(&mut window);
    click(&mut window, "Pin");
    ctrl(&mut window, Key::Num2);
    window
}

#[test]
fn two_runs_are_pinned_and_the_table_has_their_difference() {
    let mut window = two_pinned();
    let name = presets::find("fundamental").unwrap().name;
    assert_eq!(labels(window.state()), [name.clone(), format!("{name}, min spacing 100 nm")]);
    window.get_by_label("Compare (2)");

    // The numbers are those of the analysis, of runs that were solved by themselves.
    let scenes: Vec<_> = window.state().pins().runs().iter().map(|run| run.scene.clone()).collect();
    let settings = Settings { fidelity: Fidelity::Fine, ..Settings::default() };
    let alone = compare::runs(&scenes, &settings, &Cancel::new(), &|_| ()).unwrap();
    let rows = compare::results(&alone);
    let alpha = rows.iter().find(|row| row.quantity == Quantity::Alpha).unwrap();
    let shown = window.state().pins().results().iter().find(|row| row.quantity == Quantity::Alpha).unwrap();
    let (ours, theirs) = (&shown.cells[1], &alpha.cells[1]);
    // The window starts from the last solve: the same to a fraction of the stated error.
    let within = theirs.difference_error_percent.unwrap();
    assert!((ours.difference_percent.unwrap() - theirs.difference_percent.unwrap()).abs() < within);
    let texts = [value_text(shown, ours), difference_text(ours)];
    click(&mut window, "Numbers");
    for text in &texts {
        assert!(!text.is_empty() && window.query_all_by_label(text).next().is_some(), "{text}");
    }
    // Parameters: the one that was changed, and all of them if asked.
    let tooth = "Tooth width, mm";
    window.get_by_label("Minimum spacing H_m, nm");
    assert!(window.query_by_label(tooth).is_none());
    click(&mut window, "Only those that differ");
    window.get_by_label(tooth);
    assert_eq!(window.state().pins().page, Page::Numbers);
    assert!(window.query_by_label("Time in the cycle").is_none(), "numbers do not move");
}

#[test]
fn fields_move_in_phase_and_maps_share_one_scale() {
    let mut window = two_pinned();
    let pressure = window.state().pins().runs().iter().map(|run| &run.solved.as_ref().unwrap().recording.pressure);
    let all: Vec<f64> = pressure.flatten().copied().collect();
    let (low, high) = all.iter().fold((f64::INFINITY, 0.0f64), |(low, high), p| (low.min(*p), high.max(*p)));
    let own: Vec<f64> = window.state().pins().pins().iter().map(|pin| pin.kept.pressure()[1]).collect();
    assert!(own[0] != own[1], "each alone would have another scale");
    for label in labels(window.state()) {
        let about = format!("Pressure map of {label}, colours from ");
        let node = window.get_by_label_contains(&about);
        let name = node.accesskit_node().label().unwrap();
        let ends = name.strip_prefix(&about).unwrap().strip_suffix(" kPa").unwrap().split_once(" to ").unwrap();
        for (text, expected) in [(ends.0, low), (ends.1, high)] {
            let stated = 1e3 * text.parse::<f64>().unwrap();
            assert!((stated / expected - 1.0).abs() < 5e-3, "{name}: expected {expected} Pa");
        }
    }
    // The timeline is the one of the motion.
    window.get_by_label("Pause");
    let phase = window.state().view().phase;
    std::thread::sleep(Duration::from_millis(30));
    window.run_steps(2);
    assert_ne!(window.state().view().phase, phase);
    window.key_press(Key::Home);
    window.key_press(Key::ArrowRight);
    window.run_steps(2);
    let frames = window.state().pins().runs()[0].solved.as_ref().unwrap().recording.frames;
    assert!((window.state().view().phase - 1.0 / frames as f64).abs() < 1e-12);
}

#[test]
fn pins_are_renamed_opened_and_removed() {
    let mut window = two_pinned();
    let first = labels(window.state())[0].clone();
    type_into(&mut window, &format!("Label of {first}"), "as published");
    assert_eq!(labels(window.state())[0], "as published");
    let spacing = |window: &Window| window.state().document().scene().get("film.min_spacing_nm").unwrap();
    assert_eq!(spacing(&window), Value::Number(100.0));
    click(&mut window, "Open as published");
    assert_eq!(spacing(&window), Value::Number(200.0));
    ctrl(&mut window, Key::Z);
    assert_eq!(spacing(&window), Value::Number(100.0));
    click(&mut window, "Remove as published");
    assert_eq!(window.state().pins().runs().len(), 1);
    // What is left is what differences are from.
    assert!(window.state().pins().results().iter().all(|row| row.cells[0].difference_percent.is_none()));
    window.get_by_label("Compare (1)");
}

#[test]
fn a_preset_is_solved_in_the_background_and_a_plate_is_told_from_a_motor() {
    let mut window = window("fundamental");
    ctrl(&mut window, Key::Num2);
    assert!(window.state().pins().runs().is_empty());
    window.get_by_label_contains("Pin a run, change the scene");
    let plate = presets::find("plate-crossover").unwrap().name;
    for preset in [&plate, &presets::find("levitating").unwrap().name] {
        window.get_by_label_contains("Pin a preset").click();
        window.run_steps(3);
        window.get_by_label_contains(preset).click();
        window.run_steps(2);
        until(&mut window, preset, |app| app.pins().waiting().is_empty() && labels(app).contains(preset));
    }
    let fidelities = window.state().pins().runs().iter().map(|run| run.solved.as_ref().unwrap().model.fidelity.clone());
    assert!(fidelities.into_iter().all(|fidelity| fidelity == window.state().document().aim().name()));
    window.get_by_label_contains("Motors and plates cannot be laid over each other");
    // The scene being edited is as it was.
    assert_eq!(window.state().document().scene(), &presets::find("fundamental").unwrap());
    click(&mut window, "Remove all");
    assert!(window.state().pins().runs().is_empty());
}

fn swept(app: &App) -> &Swept {
    app.sweeps().swept().unwrap()
}

#[test]
fn a_sweep_arrives_in_part_is_cancelled_gone_on_with_and_equals_an_unbroken_one() {
    let mut window = window("fundamental");
    solved(&mut window);
    ctrl(&mut window, Key::Num3);
    assert_eq!(window.state().view().tab, Tab::Sweep);
    assert!(window.state().sweeps().swept().is_none(), "nothing is solved before it is asked for");
    type_into(&mut window, "Values along x", "40");
    click(&mut window, "Start the sweep");
    until(&mut window, "some points", |app| !swept(app).rows().is_empty());
    window.get_by_label("Cancel the sweep").click();
    until(&mut window, "the end", |app| !swept(app).running());
    let part = swept(window.state()).rows().len();
    assert!(part > 0 && part < 40, "{part}");
    window.get_by_label_contains("Cancelled");
    click(&mut window, "Continue");
    until(&mut window, "all points", |app| swept(app).complete() && !swept(app).running());

    let sweep = swept(window.state()).sweep();
    let vary = ["film.min_spacing_nm=50:800:40:log".parse().unwrap()];
    let unbroken = Sweep::new(&presets::find("fundamental").unwrap(), &vary, sweep.settings()).unwrap();
    assert_eq!(sweep.fingerprint(), unbroken.fingerprint(), "the range asked for by default");
    assert_eq!(swept(window.state()).rows(), unbroken.run(&[], &Cancel::new(), &|_| ()));

    // Another quantity solves nothing.
    let before = swept(window.state()).rows().to_vec();
    window.get_by_role_and_label(Role::ComboBox, "Result shown").click();
    window.run_steps(3);
    click(&mut window, "Highest pressure, kPa");
    assert_eq!(window.state().sweeps().quantity(&sweep_quantities(&window)), Quantity::MaxPressure);
    assert!(!swept(window.state()).running() && swept(window.state()).rows() == before);
}

fn sweep_quantities(window: &Window) -> Vec<Quantity> {
    swept(window.state()).sweep().quantities()
}

#[test]
fn a_point_is_read_and_opened_as_one_edit() {
    let mut window = window("plate-crossover");
    solved(&mut window);
    ctrl(&mut window, Key::Num3);
    type_into(&mut window, "Values along x", "5");
    click(&mut window, "Start the sweep");
    until(&mut window, "all points", |app| app.sweeps().swept().is_some_and(|swept| !swept.running()));
    let drawing = "Sweep: point to read a value, click to make its scene the present one";
    let rect = window.get_by_label(drawing).rect();
    // Right of the middle: the fourth of five.
    let at = rect.lerp_inside(Vec2::new(0.76, 0.5));
    window.hover_at(at);
    window.run_steps(20);
    window.get_by_label_contains("Click to make this the present scene");
    let before = window.state().document().scene().clone();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(3);
    let opened = window.state().document().scene().clone();
    assert_eq!(opened, swept(window.state()).sweep().scene_at(3).unwrap());
    assert!(window.query_by_label_contains("before the scene changed").is_none(), "it is a point of the sweep");
    ctrl(&mut window, Key::Z);
    assert_eq!(window.state().document().scene(), &before);
}

#[test]
fn two_parameters_make_a_map_and_bad_input_is_refused_in_place() {
    let mut window = window("plate-trapped");
    ctrl(&mut window, Key::Num3);
    click(&mut window, "Add a second…");
    type_into(&mut window, "Values along x", "4");
    type_into(&mut window, "Values along y", "1");
    window.get_by_label_contains("allowed 2 to 10000");
    click(&mut window, "Start the sweep");
    assert!(window.state().sweeps().swept().is_none());
    type_into(&mut window, "Values along y", "3");
    assert!(window.query_by_label_contains("allowed 2 to 10000").is_none());
    type_into(&mut window, "From along x", "-1");
    window.get_by_label_contains("plate.frequency_khz = -1");
    type_into(&mut window, "From along x", "1");
    // A fault that only both keys together have is told when it begins.
    click(&mut window, "Start the sweep");
    until(&mut window, "all points", |app| app.sweeps().swept().is_some_and(|swept| !swept.running()));
    assert_eq!(swept(window.state()).rows().len(), 12);
    assert_eq!(swept(window.state()).sweep().axes().len(), 2);
    click(&mut window, "Back to one parameter");
    assert!(window.query_by_role_and_label(Role::TextInput, "Values along y").is_none());
}

#[test]
fn closing_the_window_ends_a_sweep_and_what_is_being_solved() {
    let mut window = window("fundamental");
    ctrl(&mut window, Key::Num3);
    type_into(&mut window, "Values along x", "9000");
    click(&mut window, "Start the sweep");
    assert!(swept(window.state()).running());
    ctrl(&mut window, Key::Num2);
    window.get_by_label_contains("Pin a preset").click();
    window.run_steps(3);
    let slow = presets::find("doubled-mesh").unwrap().name;
    window.get_by_label_contains(&slow).click();
    window.run_steps(2);
    drop(window);
}

/// Asks for an export in the menu and types where to; waits until it has ended.
fn export(window: &mut Window, entry: &str, path: &Path) {
    begin_export(window, entry, path);
    until(window, "the export ends", |app| !app.exports().running());
}

fn begin_export(window: &mut Window, entry: &str, path: &Path) {
    // A modal that has just been closed takes the first click while it fades.
    for _ in 0..5 {
        window.get_by_label("File").click();
        window.run_steps(10);
        if window.query_by_label("Export").is_some() {
            break;
        }
    }
    window.get_by_label("Export").hover();
    window.run_steps(5);
    window.get_by_label_contains(entry).click();
    window.run_steps(2);
    answer(window, path);
}

fn answer(window: &mut Window, path: &Path) {
    let field = |window: &Window| {
        ["Path", "Folder"].into_iter().find(|name| window.query_by_role_and_label(Role::TextInput, name).is_some())
    };
    for _ in 0..500 {
        window.step();
        if field(window).is_some() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    window.run_steps(2);
    let name = field(window).unwrap();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.get_by_role_and_label(Role::TextInput, name).type_text(path.to_str().unwrap());
    window.step();
    window.key_press(Key::Enter);
    window.run_steps(2);
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn what_is_exported_is_what_the_command_line_writes() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| -> PathBuf { folder.path().join(name) };
    let mut window = window("plate-crossover");
    solved(&mut window);
    export(&mut window, "All results, into a folder…", &at("results"));
    let expected = [
        "convergence.png",
        "convergence.svg",
        "exact.png",
        "exact.svg",
        "fields.csv",
        "fields.npz",
        "loads.png",
        "loads.svg",
        "loop.png",
        "loop.svg",
        "map.png",
        "map.svg",
        "pressure.csv",
        "profile.png",
        "profile.svg",
        "scene.toml",
        "series.csv",
        "summary.json",
    ];
    assert_eq!(names(&at("results")), expected);
    window.get_by_label_contains("Wrote 18 files");
    let summary: serde_json::Value =
        serde_json::from_slice(&std::fs::read(at("results/summary.json")).unwrap()).unwrap();
    assert_eq!(summary["model"]["fidelity"], "fine");

    export(&mut window, "Fields as NumPy archive…", &at("fields.npz"));
    assert_eq!(std::fs::read(at("fields.npz")).unwrap(), std::fs::read(at("results/fields.npz")).unwrap());
    export(&mut window, "Figures, into a folder…", &at("figures"));
    assert_eq!(names(&at("figures")).len(), 6 * 3);
    export(&mut window, "Animation…", &at("cycle.gif"));
    assert!(std::fs::read(at("cycle.gif")).unwrap().starts_with(b"GIF89a"));
    export(&mut window, "Report as HTML…", &at("report.html"));
    let page = std::fs::read_to_string(at("report.html")).unwrap();
    let document = roxmltree::Document::parse_with_options(
        &page,
        roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() },
    );
    let name = presets::find("plate-crossover").unwrap().name;
    let heading =
        document.unwrap().descendants().find(|node| node.has_tag_name("h1")).unwrap().text().unwrap().to_owned();
    assert_eq!(heading, name, "a report of one run names no other");
    let nothing_left = |names: Vec<String>| names.iter().all(|name| !name.starts_with('.'));
    assert!(nothing_left(names(folder.path())));

    // What cannot be written is told, and leaves nothing.
    let missing = at("no/such/folder/cycle.gif");
    export(&mut window, "Animation…", &missing);
    window.get_by_label("This did not work");
    window.get_by_label_contains("cannot be written");
    click(&mut window, "Close");
    export(&mut window, "Animation…", &at("cycle.avi"));
    window.get_by_label_contains("animations are written as .gif");
    click(&mut window, "Close");
    assert!(!missing.exists() && !at("cycle.avi").exists());
}

#[test]
fn comparison_and_sweep_are_exported_and_a_long_export_is_cancelled() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| -> PathBuf { folder.path().join(name) };
    let mut window = window("plate-crossover");
    solved(&mut window);
    ctrl(&mut window, Key::D);
    type_into(&mut window, "Frequency in kHz", "30");
    solved(&mut window);
    ctrl(&mut window, Key::D);
    export(&mut window, "Comparison, into a folder…", &at("comparison"));
    let found = names(&at("comparison"));
    for name in ["report.html", "compare.csv", "parameters.csv", "compare.json", "cycle.gif", "maps.svg"] {
        assert!(found.iter().any(|found| found == name), "{name}: {found:?}");
    }
    let object: serde_json::Value =
        serde_json::from_slice(&std::fs::read(at("comparison/compare.json")).unwrap()).unwrap();
    assert_eq!(object["runs"][1]["label"], labels(window.state())[1].as_str());

    ctrl(&mut window, Key::Num3);
    type_into(&mut window, "Values along x", "3");
    click(&mut window, "Start the sweep");
    until(&mut window, "all points", |app| app.sweeps().swept().is_some_and(|swept| !swept.running()));
    export(&mut window, "Sweep as table…", &at("sweep.csv"));
    let text = std::fs::read_to_string(at("sweep.csv")).unwrap();
    let rows = squeezefilm::export::sweep::read_csv(swept(window.state()).sweep(), &text).unwrap();
    assert_eq!(rows, swept(window.state()).rows());
    export(&mut window, "Sweep as figure…", &at("sweep.pdf"));
    assert!(std::fs::read(at("sweep.pdf")).unwrap().starts_with(b"%PDF"));
    export(&mut window, "Sweep, into a folder…", &at("sweep"));
    assert_eq!(names(&at("sweep")), ["scene.toml", "sweep.csv", "sweep.json", "sweep.png", "sweep.svg"]);

    // A long one is cancelled, and leaves nothing; meanwhile no other begins.
    begin_export(&mut window, "Animation…", &at("long.mp4"));
    until(&mut window, "it begins", |app| app.exports().running());
    begin_export(&mut window, "Fields as NumPy archive…", &at("fields.npz"));
    window.get_by_label_contains("Another export goes on");
    click(&mut window, "Close");
    click(&mut window, "Cancel the export");
    until(&mut window, "it ends", |app| !app.exports().running());
    assert!(window.query_by_label("This did not work").is_none(), "that it was cancelled is no error");
    assert!(names(folder.path()).iter().all(|name| !name.contains("long") && !name.contains(".tmp")));
}
