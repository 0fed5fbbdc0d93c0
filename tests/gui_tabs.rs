//! Comparison, sweep and export through the real application, without a display.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod window;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, Pos2, Rect, Vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use squeezefilm::analysis::compare;
use squeezefilm::analysis::quantity::Quantity;
use squeezefilm::analysis::sensitivity::{Sensitivity, Uncertainties};
use squeezefilm::analysis::sweep::Sweep;
use squeezefilm::analysis::tradeoff::{Candidate, Effort, candidates};
use squeezefilm::control::Cancel;
use squeezefilm::digits::significant;
use squeezefilm::export::compare::{difference_text, value_text};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::app::App;
use squeezefilm::gui::command::Command;
use squeezefilm::gui::derived::format::uncertain;
use squeezefilm::gui::state::dialogs::Answer;
use squeezefilm::gui::state::document::Next;
use squeezefilm::gui::state::fit::FitResult;
use squeezefilm::gui::state::pins::Page;
use squeezefilm::gui::state::sweep::Swept;
use squeezefilm::gui::state::view::Tab;
use squeezefilm::gui::ui::cache::made;
use squeezefilm::gui::ui::glossary::unexplained;
use squeezefilm::gui::update::platform::Platform;
use squeezefilm::lessons::glossary;
use squeezefilm::problem::{Problem, Scenario};
use squeezefilm::scene::{Value, heights, presets};
use squeezefilm::solution::Outcome;
use squeezefilm::solve::Settings;
use std::path::{Path, PathBuf};
use std::time::Duration;
use window::{
    Memory, User, Window, begin_export, drop_file, face, has_torque, left, measured, once_solved, reopen, solved, until,
};

/// One of each family, twice each.
fn few(problem: &Problem) -> (Vec<Candidate>, Effort) {
    let mut few: Vec<Candidate> = Vec::new();
    for candidate in candidates(problem) {
        if few.iter().all(|other| other.family != candidate.family) {
            few.push(candidate);
        }
    }
    (few, Effort { repeats: Some(2), ..Effort::default() })
}

/// A window whose paths are typed.
fn window(preset: &str) -> Window {
    let platform = Platform { ask: |_, _| Answer::NoDialog, measure: few, ..Platform::default() };
    window::preset(preset, 1000.0, platform)
}

fn show_fit(window: &mut Window) {
    window.press_with(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::F);
}

fn labels(app: &App) -> Vec<String> {
    app.state().pins.runs.iter().map(|run| run.label.clone()).collect()
}

/// A window in which the fundamental case and one with half the spacing are pinned.
fn two_pinned() -> Window {
    let mut window = once_solved(window("fundamental"));
    window.ctrl(Key::D);
    window.type_into("Minimum spacing H_m in nm", "100");
    solved(&mut window);
    window.click_on("Pin");
    window.ctrl(Key::Num2);
    window
}

#[test]
fn two_runs_are_pinned_and_the_table_has_their_difference() {
    let mut window = two_pinned();
    let name = presets::find("fundamental").unwrap().name;
    assert_eq!(labels(window.state()), [name.clone(), format!("{name}, minimum spacing H_m 100 nm")]);
    window.get_by_label("Compare (2)");

    // The numbers are those of the analysis, of runs that were solved by themselves.
    let scenes: Vec<_> = window.known().pins.runs.iter().map(|run| run.scene.clone()).collect();
    let settings = Settings { fidelity: Fidelity::Fine, ..Settings::default() };
    let alone = compare::runs(&scenes, &settings, &Cancel::new(), &|_| ()).unwrap();
    let rows = compare::results(&alone);
    let alpha = rows.iter().find(|row| row.quantity == Quantity::Alpha).unwrap();
    let shown = window.known().pins.results.iter().find(|row| row.quantity == Quantity::Alpha).unwrap();
    let (ours, theirs) = (&shown.cells[1], &alpha.cells[1]);
    // The window starts from the last solve: the same to a fraction of the stated error.
    let [ours_less, theirs_less] = [ours, theirs].map(|cell| cell.difference_percent.unwrap());
    assert!((ours_less.value - theirs_less.value).abs() < theirs_less.error);
    let texts = [value_text(shown, ours), difference_text(shown, ours)];
    window.click_on("Numbers");
    for text in &texts {
        assert!(!text.is_empty() && window.query_all_by_label(text).next().is_some(), "{text}");
    }
    // Parameters: the one that was changed, and all of them if asked.
    let tooth = "Tooth width, mm";
    window.get_by_label("Minimum spacing H_m, nm");
    assert!(window.query_by_label(tooth).is_none());
    window.click_on("Only those that differ");
    window.get_by_label(tooth);
    assert_eq!(window.known().pins.page, Page::Numbers);
    assert!(window.query_by_label("Time in the cycle").is_none(), "numbers do not move");
}

#[test]
fn fields_move_in_phase_and_maps_share_one_scale() {
    let mut window = two_pinned();
    let pressure = window.known().pins.runs.iter().map(|run| &run.solved.as_ref().unwrap().recording.pressure);
    let all: Vec<f64> = pressure.flatten().copied().collect();
    let (low, high) = all.iter().fold((f64::INFINITY, 0.0f64), |(low, high), p| (low.min(*p), high.max(*p)));
    let own: Vec<f64> = window.known().pins.pins.iter().map(|pin| pin.curves.scales.ranges.pressure[1]).collect();
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
    window.get_by_label_contains("t = ");
    let phase = window.known().view.phase;
    std::thread::sleep(Duration::from_millis(30));
    window.run_steps(2);
    assert_ne!(window.known().view.phase, phase);
    window.key_press(Key::Home);
    window.press(Key::ArrowRight);
    let frames = window.known().pins.runs[0].solved.as_ref().unwrap().recording.frames;
    assert!((window.known().view.phase - 1.0 / frames as f64).abs() < 1e-12);
}

#[test]
fn pins_are_renamed_opened_and_removed() {
    let mut window = two_pinned();
    let first = labels(window.state())[0].clone();
    window.type_into(&format!("Label of {first}"), "as published");
    assert_eq!(labels(window.state())[0], "as published");
    let spacing = |window: &Window| window.known().document.scene().get("film.min_spacing_nm").unwrap();
    assert_eq!(spacing(&window), Value::Number(100.0));
    window.click_on("Open as published");
    assert_eq!(spacing(&window), Value::Number(200.0));
    window.ctrl(Key::Z);
    assert_eq!(spacing(&window), Value::Number(100.0));
    window.click_on("Remove as published");
    assert_eq!(window.known().pins.runs.len(), 1);
    // What is left is what differences are from.
    assert!(window.known().pins.results.iter().all(|row| row.cells[0].difference_percent.is_none()));
    window.get_by_label("Compare (1)");
    window.click_on("Bring the pin back");
    assert_eq!(labels(window.state())[0], "as published");
    assert!(window.query_by_label("Bring the pin back").is_none());
}

#[test]
fn a_preset_is_solved_in_the_background_and_a_plate_is_told_from_a_motor() {
    let mut window = window("fundamental");
    window.ctrl(Key::Num2);
    assert!(window.known().pins.runs.is_empty());
    window.get_by_label_contains("Pin a run, change the scene");
    let plate = presets::find("plate-crossover").unwrap().name;
    for preset in [&plate, &presets::find("levitating").unwrap().name] {
        window.click_part("Pin a preset");
        window.click_part(preset);
        until(&mut window, preset, |app| app.state().pins.waiting.is_empty() && labels(app).contains(preset));
    }
    let fidelities = window.known().pins.runs.iter().map(|run| run.solved.as_ref().unwrap().model.fidelity.clone());
    assert!(fidelities.into_iter().all(|fidelity| fidelity == window.known().document.target().name()));
    window.get_by_label_contains("Motors and plates cannot be laid over each other");
    // Each has its own period: no time is that of all.
    window.get_by_label_contains("° of each cycle");
    assert!(window.query_by_label_contains("t = ").is_none());
    // The scene being edited is as it was.
    assert_eq!(window.known().document.scene(), &presets::find("fundamental").unwrap());
    // Words of the window for what is chosen, and which of the two a name belongs to.
    window.click_on("Numbers");
    for text in
        ["Beam on a foundation", "Rectangle or strip", "Frequency of the stator, kHz", "Frequency of the plate, kHz"]
    {
        assert!(window.query_all_by_label(text).next().is_some(), "{text}");
    }
    window.click_on("Remove all");
    assert!(window.known().pins.runs.is_empty());
}

fn swept(app: &App) -> &Swept {
    app.state().sweep.swept.as_ref().unwrap()
}

#[test]
fn a_sweep_arrives_in_part_is_cancelled_gone_on_with_and_equals_an_unbroken_one() {
    let mut window = once_solved(window("fundamental"));
    window.ctrl(Key::Num3);
    assert_eq!(window.known().view.tab, Tab::Sweep);
    assert!(window.known().sweep.swept.is_none(), "nothing is solved before it is asked for");
    // So many that the sweep is still at work when it is cancelled, whatever else the machine does.
    window.type_into("Values along x", "1000");
    window.click_on("Start the sweep");
    until(&mut window, "some points", |app| {
        app.state().sweep.swept.as_ref().is_some_and(|swept| !swept.rows.is_empty())
    });
    let place = window.get_by_label("Cancel the sweep").rect().center();
    window.get_by_label("Cancel the sweep").click();
    until(&mut window, "the end", |app| !swept(app).running);
    let part = swept(window.state()).rows.len();
    assert!(part > 0 && part < 1000, "{part}");
    window.get_by_label_contains("Cancelled");
    // A second click in the same place is one too many, and does nothing.
    click_at(&mut window, place);
    assert!(!swept(window.state()).running && swept(window.state()).rows.len() == part);
    window.click_on("Continue");
    assert!(swept(window.state()).running);
    window.press(Key::Escape);
    until(&mut window, "Escape ends it too", |app| !swept(app).running);
    window.click_on("Continue");
    until(&mut window, "all points", |app| swept(app).complete() && !swept(app).running);

    let sweep = &swept(window.state()).sweep;
    let vary = ["film.min_spacing_nm=50:800:1000:log".parse().unwrap()];
    let unbroken = Sweep::new(&presets::find("fundamental").unwrap(), &vary, sweep.settings()).unwrap();
    assert_eq!(sweep.fingerprint(), unbroken.fingerprint(), "the range asked for by default");
    assert_eq!(swept(window.state()).rows, unbroken.run(&[], &Cancel::new(), &|_| ()));

    // Another quantity solves nothing.
    let before = swept(window.state()).rows.to_vec();
    window.open_list("Result shown");
    window.click_on("Film load, N");
    let quantities = swept(window.state()).sweep.quantities();
    assert_eq!(window.known().sweep.quantity(&quantities), Quantity::FilmLoad);
    assert!(!swept(window.state()).running && swept(window.state()).rows == before);
}

/// Starts the sweep, and waits for its end.
fn sweep(window: &mut Window) {
    window.click_on("Start the sweep");
    until(window, "all points", |app| app.state().sweep.swept.as_ref().is_some_and(|swept| !swept.running));
}

/// A window after a sweep over five points, and where its chart is.
fn five_points() -> (Window, Rect) {
    let mut window = once_solved(window("plate-crossover"));
    window.ctrl(Key::Num3);
    window.type_into("Values along x", "5");
    sweep(&mut window);
    let rect = window.get_by_label("Sweep: point to read a value, click to make its scene the present one").rect();
    (window, rect)
}

#[test]
fn a_point_is_read_and_opened_as_one_edit() {
    let (mut window, rect) = five_points();
    // Right of the middle: the fourth of five.
    let at = rect.lerp_inside(Vec2::new(0.76, 0.5));
    window.hover_at(at);
    window.run_steps(20);
    window.get_by_label_contains("Click to make this the present scene");
    let before = window.known().document.scene().clone();
    click_at(&mut window, at);
    let opened = window.known().document.scene().clone();
    assert_eq!(opened, swept(window.state()).sweep.scene_at(3).unwrap());
    assert!(window.query_by_label_contains("before the scene changed").is_none(), "it is a point of the sweep");
    window.ctrl(Key::Z);
    assert_eq!(window.known().document.scene(), &before);
}

#[test]
fn a_double_click_brings_a_moved_chart_back_and_opens_no_point() {
    let (mut window, rect) = five_points();
    // Two points farther: another one is now where the fourth was.
    let [from, to] = [0.285, 0.76].map(|share| rect.lerp_inside(Vec2::new(share, 0.5)));
    let before = window.known().document.scene().clone();
    drag(&mut window, from, to);
    // Every event has a step of its own, and its time. Those before are long past.
    window.ctx.options_mut(|options| options.input_options.max_double_click_delay = 10.0);
    window.run_steps(100);
    for _ in 0..2 {
        window.drag_at(to);
        window.drop_at(to);
    }
    window.run_steps(100);
    assert_eq!(window.known().document.scene(), &before, "it was dragged, and two clicks bring it back");
    click_at(&mut window, to);
    let point = |window: &Window, place: usize| swept(window.state()).sweep.scene_at(place).unwrap();
    assert_eq!(window.known().document.scene(), &point(&window, 3), "one click opens a point");
    // Where a click may be the first of two it waits.
    drag(&mut window, from, to);
    window.run_steps(100);
    click_at(&mut window, to);
    assert_eq!(window.known().document.scene(), &point(&window, 3));
    window.run_steps(60);
    assert_eq!(window.known().document.scene(), &point(&window, 1));
}

#[test]
fn two_parameters_make_a_map_and_bad_input_is_refused_in_place() {
    let mut window = window("plate-trapped");
    window.ctrl(Key::Num3);
    window.click_on("Add a second…");
    window.type_into("Values along x", "4");
    window.type_into("Values along y", "1");
    window.get_by_label_contains("allowed 2 to 10000");
    window.click_on("Start the sweep");
    assert!(window.known().sweep.swept.is_none());
    window.type_into("Values along y", "3");
    assert!(window.query_by_label_contains("allowed 2 to 10000").is_none());
    window.type_into("From along x", "-1");
    window.get_by_label_contains("plate.frequency_khz = -1");
    window.type_into("From along x", "1");
    // A fault that only both keys together have is told when it begins.
    sweep(&mut window);
    assert_eq!(swept(window.state()).rows.len(), 12);
    assert_eq!(swept(window.state()).sweep.axes().len(), 2);
    // Its contours are computed once.
    window.run_steps(2);
    let before = made(&window.ctx);
    window.run_steps(10);
    assert_eq!(made(&window.ctx), before);
    window.open_list("Result shown");
    window.click_on("Greatest load ratio");
    assert_eq!(made(&window.ctx), before + 1);
    window.click_on("Back to one parameter");
    assert!(window.query_by_role_and_label(Role::TextInput, "Values along y").is_none());
}

#[test]
fn closing_the_window_ends_a_sweep_and_what_is_being_solved() {
    let mut window = window("fundamental");
    window.ctrl(Key::Num3);
    window.type_into("Values along x", "9000");
    window.click_on("Start the sweep");
    until(&mut window, "its points", |app| app.state().sweep.swept.as_ref().is_some_and(|swept| swept.running));
    window.ctrl(Key::Num2);
    window.click_part("Pin a preset");
    let slow = presets::find("doubled-mesh").unwrap().name;
    window.click_part(&slow);
    drop(window);
}

/// Asks for an export in the menu and types where to; waits until it has ended.
fn export(window: &mut Window, entry: &str, path: &Path) {
    begin_export(window, entry, path);
    until(window, "the export ends", |app| app.state().exports.running.is_none());
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
    let mut window = once_solved(window("plate-crossover"));
    export(&mut window, "All results, into a folder…", &at("results"));
    let figures = ["convergence", "exact", "loads", "loop", "map", "profile"];
    let figures = figures.iter().flat_map(|name| ["png", "svg"].map(|format| format!("{name}.{format}")));
    let data = ["fields.csv", "fields.npz", "pressure.csv", "scene.toml", "series.csv", "summary.json"];
    let mut expected: Vec<String> = figures.chain(data.map(str::to_owned)).collect();
    expected.sort();
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
    assert!(page.contains("squeezefilm compare scene.toml --"), "how it is made again");
    let nothing_left = |names: Vec<String>| names.iter().all(|name| !name.starts_with('.'));
    assert!(nothing_left(names(folder.path())));

    // What cannot be written is told, and leaves nothing.
    let missing = at("no/such/folder/cycle.gif");
    export(&mut window, "Animation…", &missing);
    window.get_by_label("This did not work");
    window.get_by_label_contains("there is no folder");
    assert_eq!(window.known().failed_path.as_ref().map(|(_, path)| path.into()), Some(missing.clone()));
    window.click_on("Close");
    export(&mut window, "Animation…", &at("cycle.avi"));
    window.get_by_label_contains("allowed .gif, .mp4, .png, .apng");
    window.click_on("Close");
    assert!(!missing.exists() && !at("cycle.avi").exists());
}

#[test]
fn comparison_and_sweep_are_exported_and_a_long_export_is_cancelled() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| -> PathBuf { folder.path().join(name) };
    let mut window = once_solved(window("plate-crossover"));
    window.ctrl(Key::D);
    window.type_into("Frequency in kHz", "30");
    solved(&mut window);
    window.ctrl(Key::D);
    export(&mut window, "Comparison, into a folder…", &at("comparison"));
    let found = names(&at("comparison"));
    for name in ["report.html", "compare.csv", "parameters.csv", "compare.json", "cycle.gif", "maps.svg"] {
        assert!(found.iter().any(|found| found == name), "{name}: {found:?}");
    }
    let object: serde_json::Value =
        serde_json::from_slice(&std::fs::read(at("comparison/compare.json")).unwrap()).unwrap();
    assert_eq!(object["runs"][1]["label"], labels(window.state())[1].as_str());

    window.ctrl(Key::Num3);
    window.type_into("Values along x", "3");
    sweep(&mut window);
    export(&mut window, "Sweep as table…", &at("sweep.csv"));
    let text = std::fs::read_to_string(at("sweep.csv")).unwrap();
    let (shown, mut written) = (swept(window.state()), Vec::new());
    squeezefilm::export::sweep::write_csv(&shown.sweep, &shown.rows, &mut written).unwrap();
    assert!(text.as_bytes() == written && text.lines().count() == 4, "{text}");
    export(&mut window, "Sweep as figure…", &at("sweep.pdf"));
    assert!(std::fs::read(at("sweep.pdf")).unwrap().starts_with(b"%PDF"));
    export(&mut window, "Sweep, into a folder…", &at("sweep"));
    assert_eq!(names(&at("sweep")), ["scene.toml", "sweep.csv", "sweep.json", "sweep.png", "sweep.svg"]);

    // A long one is cancelled, and leaves nothing; meanwhile no other begins.
    begin_export(&mut window, "Animation…", &at("long.mp4"));
    until(&mut window, "it begins", |app| app.state().exports.running.is_some());
    begin_export(&mut window, "Fields as NumPy archive…", &at("fields.npz"));
    window.get_by_label_contains("Another export goes on");
    window.click_on("Close");
    window.click_on("Cancel the export");
    until(&mut window, "it ends", |app| app.state().exports.running.is_none());
    assert!(window.query_by_label("This did not work").is_none(), "that it was cancelled is no error");
    assert!(names(folder.path()).iter().all(|name| !name.contains("long") && !name.contains(".tmp")));
}

/// What the parts of the window are, what they are called, and what the pointer and a screen reader are told about them.
fn told(window: &Window) -> Vec<(Role, String, Option<String>)> {
    let parts = window.root().children_recursive();
    parts
        .map(|node| {
            let node = node.accesskit_node();
            (node.role(), node.label().or(node.value()).unwrap_or_default(), node.description())
        })
        .collect()
}

/// The tab on screen explains these words, each where it stands; nothing in it is without a word about it.
fn explains(faults: &mut Vec<String>, window: &Window, tab: &str, words: &[&str]) {
    let told = told(window);
    for word in words {
        let term = glossary::find(word).unwrap_or_else(|| panic!("{tab}: {word} is not in the glossary"));
        let about = format!("{}  {}", term.name, term.symbol);
        let explained = told.iter().any(|(_, _, text)| {
            let title = text.as_deref().and_then(|text| text.split_once(": ")).map(|(title, _)| title);
            title.is_some_and(|title| title == about || title == term.name)
        });
        if !explained {
            faults.push(format!("{tab}: nothing explains {word}"));
        }
    }
    faults.extend(unexplained(&window.ctx).iter().map(|word| format!("{tab}: {word} is not in the glossary")));
    use Role::{Button, CheckBox, ComboBox, RadioButton, Slider, SpinButton, TextInput};
    const MENUS: &[&str] = &["File", "Presets", "Edit", "View", "Lessons", "Help"];
    for (role, name, text) in &told {
        // The number beside a slider is part of it.
        let beside = |(other, label, text): &(Role, String, Option<String>)| {
            *role == Role::SpinButton && *other == Role::Slider && label == name && text.is_some()
        };
        let used = matches!(role, Button | CheckBox | ComboBox | TextInput | SpinButton | Slider | RadioButton);
        let used = used && !MENUS.contains(&name.as_str()) && !told.iter().any(beside);
        if used && text.as_ref().is_none_or(String::is_empty) {
            faults.push(format!("{tab}: {role:?} {name} says nothing on hover"));
        }
    }
}

/// Resting on what is called `name` shows `text`.
fn hovers(faults: &mut Vec<String>, window: &mut Window, name: &str, text: &str) {
    assert!(!window.shows(text), "{text}");
    let words = window.query_all_by_role_and_label(Role::Label, name).next();
    let Some(part) = words.or_else(|| window.query_all_by_label(name).next()) else {
        faults.push(format!("there is no {name}"));
        return;
    };
    part.hover();
    window.run_steps(40);
    if !window.shows(text) {
        faults.push(format!("{name} does not show “{text}”"));
    }
    window.hover_at(eframe::egui::pos2(1390.0, 2.0));
    window.run_steps(10);
}

#[test]
fn every_term_and_every_button_of_every_tab_is_explained_on_hover() {
    // The panels at the sides explain some of the same words: they are not there.
    let quiet = |window: &mut Window| {
        for key in [Key::F2, Key::F3] {
            window.press(key);
        }
        window.get_by_label("Pause").click();
        window.run_steps(10);
    };
    let faults = &mut Vec::new();
    let mut window = two_pinned();
    explains(faults, &window, "All panels", &["α", "Model", "How it was solved", "Squeeze number"]);
    quiet(&mut window);
    let fields =
        ["Travelling wave", "Contact pressure", "Gauge pressure", "Pressure map", "Film load", "Contact load", "x"];
    explains(faults, &window, "Compare", &fields);
    hovers(faults, &mut window, "About: Gauge pressure", "Below zero it sucks");
    hovers(faults, &mut window, "Remove all", "Takes all pins away");
    window.click_on("Numbers");
    explains(faults, &window, "Compare, numbers", &["α", "Film load", "Difference", "Knudsen number", "Film steps"]);
    hovers(faults, &mut window, "difference", "that of the first pinned run");
    hovers(faults, &mut window, "Minimum spacing H_m, nm", "film.min_spacing_nm");

    window.ctrl(Key::Num1);
    let motion = ["Travelling wave", "Rotor", "Stator", "Gauge pressure", "Film", "Contact", "Pressure map"];
    explains(faults, &window, "Motion", &motion);
    explains(faults, &window, "Motion, at the side", &["Ring", "Velocity across the film", "u"]);
    explains(faults, &window, "Motion, followed tooth", &["Followed tooth", "Least gap", "Loads", "Slow motion"]);

    window.ctrl(Key::Num3);
    explains(faults, &window, "Sweep, before", &["Fidelity"]);
    window.type_into("Values along x", "3");
    sweep(&mut window);
    explains(faults, &window, "Sweep", &["α", "Computed", "Stated error", "Table I", "Present"]);
    hovers(faults, &mut window, "About: Minimum spacing H_m", "film.min_spacing_nm");
    hovers(faults, &mut window, "stated error", "the numerical error only");

    window.ctrl(Key::Num4);
    until(&mut window, "torque over speed", has_torque);
    let torque =
        ["Torque over speed", "Power", "Efficiency", "With film", "Without film", "Friction heat", "Rotor speed"];
    explains(faults, &window, "Torque", &torque);
    explains(
        faults,
        &window,
        "Torque, table",
        &["Stall torque", "Maximum operating torque", "No-load speed", "Greatest power"],
    );
    hovers(faults, &mut window, "Stall torque", "held at rest");
    hovers(faults, &mut window, "without film", "in a vacuum");

    window.ctrl(Key::Num5);
    explains(faults, &window, "Trade-off, before", &[]);
    window.click_on("Measure");
    until(&mut window, "measured", measured);
    let tradeoff = [
        "fidelities",
        "other grids",
        "the paper's method",
        "present setting",
        "best",
        "asked for",
        "Solve time",
        "Error of α",
    ];
    explains(faults, &window, "Trade-off", &tradeoff);
    explains(faults, &window, "Trade-off, table", &["Setting", "Stated error", "Accuracy", "Budget"]);
    hovers(faults, &mut window, "other grids", "spend their points well");

    window.ctrl(Key::Num6);
    explains(faults, &window, "Start-up, before", &[]);
    window.click_on("Start from rest");
    until(&mut window, "a cycle arrives", |app| {
        app.state().startup.as_ref().is_some_and(|starting| starting.points.len() > 1)
    });
    let startup = ["α", "Least film thickness", "Highest pressure", "Cycle", "Periodic solve"];
    explains(faults, &window, "Start-up", &startup);

    window.ctrl(Key::Num8);
    until(&mut window, "the rotor", |app| matches!(app.state().rotor.found(), Some(Ok(_))));
    explains(faults, &window, "Rotor", &["Compliance", "Harmonic", "Green's function"]);
    hovers(faults, &mut window, "present rotor", "single unit force");

    window.ctrl(Key::Num9);
    explains(faults, &window, "Sensitivity, before", &[]);
    window.click_on("Compute sensitivities");
    until(&mut window, "sensitivities", |app| app.state().sensitivity.found.is_some());
    window.type_into("Uncertainty of Minimum spacing H_m", "20%");
    window.click_on("Draw and solve");
    until(&mut window, "random scenes", |app| app.state().sensitivity.carlo.is_some());
    let words = ["α", "Stall torque", "No-load speed", "Elasticity", "Uncertainty", "Stated error", "Random scenes"];
    explains(faults, &window, "Sensitivity", &words);
    explains(faults, &window, "Sensitivity, table", &["Parameter", "Share of the variance"]);
    hovers(faults, &mut window, "Decay length", "rotor.decay_length_mm");
    show_fit(&mut window);
    explains(faults, &window, "Fit, before", &[]);
    let _loads = drop_text(&mut window, "loads.csv", LOADS);
    explains(faults, &window, "Fit, form", &[]);
    window.click_on("Fit the scene");
    until(&mut window, "the fit", |app| app.state().fit.found.is_some());
    let words = ["Standard error", "Measured", "Computed", "Residual", "Measured against computed"];
    explains(faults, &window, "Fit", &words);
    hovers(faults, &mut window, "Take these values", "one edit, which can be undone");
    drop(window);

    let mut window = once_solved(self::window("rough-flow"));
    quiet(&mut window);
    window.ctrl(Key::Num8);
    until(&mut window, "the rotor", |app| matches!(app.state().rotor.found(), Some(Ok(_))));
    explains(faults, &window, "Rough faces", &["Compliance", "Asperities", "Flow factors", "along the wave"]);
    drop(window);

    let mut window = once_solved(self::window("plate-trapped"));
    quiet(&mut window);
    explains(
        faults,
        &window,
        "Motion of a plate",
        &["Gap", "Plate", "Wall", "Film pressure", "Ambient", "Film load", "Loop", "Velocity across the film"],
    );
    window.ctrl(Key::Num4);
    let exact = ["Squeeze number", "Spring", "Damping", "σ/Q", "Spring and damping", "Boyle", "t/T", "Film load"];
    explains(faults, &window, "Exact", &exact);
    explains(faults, &window, "Exact, in units", &["Stiffness of the film", "Damping coefficient"]);
    explains(
        faults,
        &window,
        "Exact, table",
        &["Computed", "Exact", "⟨P⟩", "Invariant", "incompressible: off the scale"],
    );
    hovers(faults, &mut window, "Mean pressure / p_a", "comes to a limit");
    window.ctrl(Key::Num7);
    let held = ["Gap", "Leak time", "Slow motion", "Held plate", "Film pressure", "Force", "Loop", "Boyle"];
    explains(faults, &window, "Hold", &held);
    hovers(faults, &mut window, "Leak time takes", "until about a third is left");
    assert!(faults.is_empty(), "{faults:#?}");
}

/// Drops a file with this text on the window; the folder that it is in, and its path.
fn drop_text(window: &mut Window, name: &str, text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    drop_file(window, &path);
    (folder, path)
}

/// Film loads of the paper's motor at other frequencies, as Table I has them.
const LOADS: &str = "stator.frequency_khz,film_load_n\n20,0.550\n40,0.600\n60,0.615\n100,0.630\n";

#[test]
fn a_fit_gives_values_that_are_taken_and_taken_back() {
    let mut window = once_solved(window("fundamental"));
    show_fit(&mut window);
    assert!(window.shows("Which values of some parameters agree best"));
    let (folder, table) = drop_text(&mut window, "loads.csv", LOADS);
    assert!(window.shows("loads.csv: 4 measurements under 4 conditions"));
    // What is wrong with a bound is said at the bound.
    window.type_into("Lower bound of parameter 1", "3");
    assert!(window.shows("film.min_spacing_nm = 3 is out of range"));
    window.type_into("Lower bound of parameter 1", "100");
    window.type_into("Upper bound of parameter 1", "400");
    window.click_on("Fit the scene");
    until(&mut window, "the fit", |app| app.state().fit.found.is_some());
    let spacing = |window: &Window| window.known().document.scene().get("film.min_spacing_nm").unwrap();
    assert_eq!(spacing(&window), Value::Number(200.0));
    let found = window.known().fit.found.as_ref().unwrap().1.values()[0].1;
    assert!((190.0..230.0).contains(&found), "{found}");
    // What is exported is what the command writes.
    let [ours, theirs] = ["ours", "theirs"].map(|name| folder.path().join(name));
    export(&mut window, "Fit, into a folder…", &ours);
    let vary = ["--vary", "film.min_spacing_nm=100:400:log", "--starts", "16", "--fidelity", "fine"];
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_squeezefilm"));
    command.args(["fit", "fundamental", "--quiet", "--data"]).arg(&table).args(vary).arg("--out").arg(&theirs);
    assert!(command.output().unwrap().status.success());
    assert_eq!(names(&ours), names(&theirs));
    let [csv, again] = [&ours, &theirs].map(|folder| std::fs::read_to_string(folder.join("fit.csv")).unwrap());
    assert_eq!(csv, again);
    window.click_on("Take these values");
    assert_eq!(spacing(&window), Value::Number(found));
    // It is of the scene as it now is, until that changes.
    assert!(!window.shows("before the scene changed"));
    window.ctrl(Key::Z);
    assert_eq!(spacing(&window), Value::Number(200.0));
    window.type_into("Minimum spacing H_m in nm", "100");
    assert!(window.shows("before the scene changed; fit again"));
    let bad = folder.path().join("bad.csv");
    std::fs::write(&bad, "film.min_spacing,alpha\n1,2\n").unwrap();
    drop_file(&mut window, &bad);
    assert!(window.shows("bad.csv:1: column film.min_spacing: unknown"));
}

#[test]
fn a_fit_that_is_cancelled_leaves_nothing() {
    let mut window = once_solved(window("fundamental"));
    show_fit(&mut window);
    let _loads = drop_text(&mut window, "loads.csv", LOADS);
    for _ in 0..2 {
        window.click_on("Add a key…");
    }
    window.click_on("Fit the scene");
    assert!(window.known().fit.work.running());
    window.click_on("Cancel the fit");
    until(&mut window, "it ends", |app| !app.state().fit.work.running());
    assert!(window.known().fit.found.is_none());
    assert!(window.shows("Cancelled") && !window.shows("Take these values"));
    // Another one can be begun.
    window.click_on("Fit the scene");
    assert!(window.known().fit.work.running());
}

#[test]
fn an_optimum_is_found_within_limits_and_taken() {
    let mut window = once_solved(window("fundamental"));
    show_fit(&mut window);
    let choose = |window: &mut Window, combo: &str, entry: &str| {
        window.open_list(combo);
        window.get_by_role_and_label(Role::Button, entry).click();
        window.run_steps(3);
    };
    choose(&mut window, "What is looked for", "the greatest value of");
    assert!(window.shows("At which values of some parameters"));
    choose(&mut window, "Number that is sought", "stall torque, N·m");
    // No table is needed, and a limit that cannot be read is said.
    window.type_into("Limits on other results", "alpha=0.3");
    assert!(window.shows("alpha=0.3") && window.shows("name<value"));
    window.type_into("Limits on other results", "alpha<0.3");
    assert!(!window.shows("name<value"));
    choose(&mut window, "Parameter 1", "Load on one wave");
    window.type_into("Lower bound of parameter 1", "1");
    window.type_into("Upper bound of parameter 1", "3");
    window.click_on("Find the optimum");
    until(&mut window, "the optimum", |app| app.state().fit.found.is_some());
    let state = window.known();
    let (_, found) = state.fit.found.as_ref().unwrap();
    let FitResult::Optimum(optimum) = &**found else { panic!("an optimum") };
    // Torque grows with the load, and the share of the air falls.
    assert!((optimum.lines[0].value - 3.0).abs() < 0.01 && optimum.value.value > 0.3, "{:?}", optimum.value);
    assert!(optimum.limited[0].value < 0.3);
    let load = found.values()[0];
    assert!(window.shows("at its upper bound") && window.shows("allowed: alpha < 0.3"));
    assert!(window.shows("the result stays within "));
    for name in ["within the limits", "a limit is not met"] {
        window.get_by_label(name);
    }
    let faults = &mut Vec::new();
    explains(faults, &window, "Fit, optimum", &["Line through the optimum"]);
    assert!(faults.is_empty(), "{faults:#?}");
    // What answers another question than the one that is asked now says which.
    assert!(!window.shows("Found for another question"));
    window.type_into("Limits on other results", "alpha<0.4");
    assert!(window.shows("Found for another question") && window.shows("stall torque with alpha < 0.3"));
    choose(&mut window, "What is looked for", "agreement with measurements");
    assert!(window.shows("Found for another question"));
    choose(&mut window, "What is looked for", "the greatest value of");
    window.type_into("Limits on other results", "α ≤ 0,3");
    assert!(!window.shows("Found for another question"));
    window.click_on("Take these values");
    assert_eq!(window.known().document.scene().get(load.0), Some(Value::Number(load.1)));
    fits_beside_the_results(&mut window);
}

/// In a small window no chart of the tab lies under the results.
fn fits_beside_the_results(window: &mut Window) {
    window.set_size(Vec2::new(1024.0, 700.0));
    window.run_steps(5);
    let results = window.query_all_by_label_contains("share of the load carried by air").next().unwrap().rect().left();
    if let Some(sentence) = window.query_by_label_contains("the result stays within ") {
        assert!(sentence.rect().right() < results, "{:?} {results}", sentence.rect());
    }
    let charts: Vec<Rect> = window.query_all_by_role(Role::Image).map(|image| image.rect()).collect();
    let charts: Vec<Rect> = charts.into_iter().filter(|chart| chart.left() < results).collect();
    assert!(!charts.is_empty() && charts.iter().all(|chart| chart.right() <= results), "{charts:?} {results}");
    window.set_size(Vec2::new(1400.0, 1000.0));
    window.run_steps(5);
}

#[test]
fn torques_dropped_on_the_torque_tab_are_drawn_over_the_curve() {
    let mut window = once_solved(window("fundamental"));
    window.ctrl(Key::Num4);
    until(&mut window, "torque over speed", has_torque);
    assert!(!window.shows("measured"));
    let rows = "rotor_speed_rpm,torque_nm,film.min_spacing_nm\n0,0.26,\n20,0.24,\n40,0.2,100\n";
    let _torques = drop_text(&mut window, "torque.csv", rows);
    assert_eq!(window.known().view.tab, Tab::Torque);
    assert_eq!(window.known().torques(), (vec![[0.0, 0.26], [20.0, 0.24]], 1));
    assert!(window.shows("measured") && window.shows("1 measured torques are not drawn"));
    // An edit is of the same scene; another one that is opened is not.
    window.state_mut().carry_out(Command::SetText("film.min_spacing_nm", "190".to_owned()));
    assert_eq!(window.known().torques().0.len(), 2);
    window.state_mut().carry_out(Command::DiscardThen(Next::Preset("doubled-mesh")));
    assert_eq!(window.known().document.scene(), &presets::find("doubled-mesh").unwrap());
    assert_eq!(window.known().torques(), (Vec::new(), 3));
}

#[test]
fn sensitivities_are_those_of_the_command_and_uncertainties_answer_at_once() {
    let mut window = once_solved(window("fundamental"));
    window.ctrl(Key::Num9);
    assert!(window.known().sensitivity.found.is_none(), "nothing is computed before it is asked for");
    window.click_on("Compute sensitivities");
    until(&mut window, "sensitivities", |app| app.state().sensitivity.found.is_some());
    let scene = presets::find("fundamental").unwrap();
    let settings = Settings { fidelity: window.known().document.target(), ..Settings::default() };
    let none: [&str; 0] = [];
    let alone = Sensitivity::of(&scene, &none, &settings, &Cancel::new(), &|_| ()).unwrap().unwrap();
    let found = std::sync::Arc::clone(window.known().sensitivity.found.as_ref().unwrap());
    assert_eq!(found.columns, alone.columns);
    let value = |output: usize| uncertain(found.values[output]);
    window.get_by_label(&value(0));
    window.click_on("stall torque");
    window.get_by_label(&format!("{}\u{a0}N·m", value(1)));

    // An uncertainty makes one of the result; what makes no sense is refused in its place.
    let spacing = "Uncertainty of Minimum spacing H_m";
    window.type_into(spacing, "20%");
    let given = [("film.min_spacing_nm", "20%".parse().unwrap())];
    let uncertainties = Uncertainties::new(&scene, &given).unwrap();
    let spread = found.propagated(1, &uncertainties).deviation.value;
    window.get_by_label(&format!("standard deviation {} from the parameters", significant(spread, 2)));
    let frequency = "Uncertainty of Frequency";
    let place = |window: &Window| window.get_by_role_and_label(Role::TextInput, frequency).rect();
    let before = place(&window);
    window.type_into(frequency, "much");
    assert_eq!(place(&window), before, "the rows stay where they are");
    let refused = window.known().sensitivity.refused("stator.frequency_khz").unwrap().to_owned();
    assert!(refused.contains("expected a standard deviation"), "{refused}");
    window.get_by_label(&format!("standard deviation {} from the parameters", significant(spread, 2)));

    // Nothing is drawn while one is refused. Random scenes are those of the command, and go when the uncertainties are others.
    let draws = |window: &Window| !window.get_by_label("Draw and solve").accesskit_node().is_disabled();
    assert!(window.shows(&refused) && !draws(&window));
    window.type_over(Role::TextInput, frequency, "");
    window.press(Key::Delete);
    assert!(window.known().sensitivity.typed("stator.frequency_khz").is_empty() && draws(&window));
    window.click_on("Draw and solve");
    until(&mut window, "random scenes", |app| app.state().sensitivity.carlo.is_some());
    let carlo = window.known().sensitivity.carlo.as_ref().unwrap().clone();
    assert_eq!(Some(carlo), alone.monte_carlo(&uncertainties, 500, 1, &Cancel::new(), &|| ()));
    let below = |window: &Window| place(window).top() - window.get_by_label("Draw and solve").rect().top();
    let before = below(&window);
    window.type_into(spacing, "10%");
    // Those of before stay in place, marked as such, and are not exported.
    let state = &window.known().sensitivity;
    assert!(state.carlo.is_none() && state.drawn().is_some_and(|(.., earlier)| earlier));
    assert!(window.shows("Random scenes of the earlier uncertainties"));
    assert!((below(&window) - before).abs() < 1.0, "the rows stay where they are");
    // A plain number has the unit of its key, which is shown.
    window.get_by_label("s.d. 20 nm");
    assert!(!window.shows("is more than the value itself"));
    window.type_over(Role::TextInput, spacing, "300");
    window.run_steps(4);
    window.get_by_label("s.d. 300 nm");
    assert!(window.shows("Minimum spacing H_m: a standard deviation of 300 nm is more than the value itself, 200 nm"));
    window.type_over(Role::TextInput, spacing, "10%");

    // Of another scene they say so.
    assert!(!window.shows("before the scene changed"));
    window.type_into("Minimum spacing H_m in nm", "150");
    assert!(window.shows("before the scene changed; compute again"));
}

#[test]
fn exports_say_what_they_write() {
    let mut window = once_solved(window("plate-crossover"));
    window.get_by_label("File").click();
    window.run_steps(10);
    window.get_by_label("Export").hover();
    window.run_steps(10);
    let told = told(&window);
    let exports: Vec<_> = told.iter().filter(|(role, name, _)| *role == Role::Button && name.ends_with('…')).collect();
    for entry in [
        "All results, into a folder…",
        "Sweep as table…",
        "Comparison as HTML…",
        "Trade-off as figure…",
        "Sensitivities, into a folder…",
        "Fit, into a folder…",
    ] {
        let found = exports.iter().find(|(_, name, _)| name == entry).unwrap_or_else(|| panic!("{entry}: {exports:?}"));
        assert!(found.2.as_ref().is_some_and(|text| text.len() > 20), "{found:?}");
    }
}

#[test]
fn measured_heights_dropped_on_the_window_are_shown_and_taken() {
    let mut window = once_solved(window("asperities"));
    window.ctrl(Key::Num8);
    assert!(window.shows("after the lines # dx_um"), "what the file must hold");
    window.ctrl(Key::Num1);
    let (_folder, path) = drop_text(&mut window, "face.csv", &face());
    until(&mut window, "the heights are read", |app| app.state().face.found.is_some());
    assert_eq!(window.known().view.tab, Tab::Rotor);
    until(&mut window, "the rotor", |app| matches!(app.state().rotor.found(), Some(Ok(_))));
    assert!(window.shows("face.csv") && window.shows("Profile along x, nm"));
    let faults = &mut Vec::new();
    explains(faults, &window, "Measured face", &["Measured face"]);
    assert!(faults.is_empty(), "{faults:#?}");
    fits_beside_the_results(&mut window);
    let follows = heights::keys_of(&window.known().face.found.as_ref().unwrap().pair);
    let rms = |window: &Window| window.known().document.scene().get("surface.rms_nm");
    let before = rms(&window);
    let about = told(&window).into_iter().find(|(_, name, _)| name == "Take roughness from it").unwrap().2.unwrap();
    let rounded = Value::Number(follows[0].1);
    assert!(about.contains(&format!("to {rounded} nm")) && about.contains("1/mm²"), "{about}");
    assert!(!about.contains("Minimum spacing") && about.contains("press this again"), "{about}");
    window.click_on("Take roughness from it");
    for (key, value) in follows {
        let taken = window.known().document.scene().get(key);
        // This preset has no flow factors, and so no lay.
        assert_eq!(taken, (key != "surface.lay").then_some(Value::Number(value)), "{key}");
    }
    window.ctrl(Key::Z);
    assert_eq!(rms(&window), before);
    window.click_on("Forget it");
    assert!(!window.shows("face.csv"));
    std::fs::write(&path, "# height = nm\n1,2\n").unwrap();
    drop_file(&mut window, &path);
    until(&mut window, "it is refused", |app| app.state().modal.is_some());
    assert!(window.shows("face.csv: no spacing along x"));
}

/// The window after that.
fn next(memory: Memory) -> Window {
    reopen(memory, 1000.0, Platform { ask: |_, _| Answer::NoDialog, ..Platform::default() })
}

#[test]
fn pins_outlive_the_window_and_are_solved_again_after_the_scene() {
    let mut window = two_pinned();
    let first = labels(window.state())[0].clone();
    window.type_into(&format!("Label of {first}"), "as published");
    // The first colour is free again, and is not taken by what comes back.
    window.click_part("Pin a preset");
    let levitating = presets::find("levitating").unwrap().name;
    window.click_part(&levitating);
    until(&mut window, "a third", |app| app.state().pins.runs.len() == 3);
    let changed = labels(window.state())[1].clone();
    window.click_on(&format!("Remove {changed}"));
    let kept = |app: &App| -> Vec<_> {
        let pins = app.state().pins.pins.iter().zip(&app.state().pins.runs);
        pins.map(|(pin, run)| {
            let fidelity = run.solved.as_ref().unwrap().model.fidelity.clone();
            (run.label.clone(), pin.slot, fidelity, run.scene.clone())
        })
        .collect()
    };
    let before = kept(window.state());
    assert_eq!(before.iter().map(|pin| pin.1).collect::<Vec<_>>(), [0, 2]);
    let alpha = |app: &App| {
        let row = app.state().pins.results.iter().find(|row| row.quantity == Quantity::Alpha).unwrap();
        row.cells.iter().map(|cell| cell.found.map(|found| (found.value, found.error)).unwrap()).collect::<Vec<_>>()
    };
    let numbers = alpha(window.state());
    let memory = left(&mut window);
    drop(window);

    let mut window = next(memory.clone());
    window.step();
    // A slow frame may see the first one solved already.
    let pins = &window.known().pins;
    assert_eq!(pins.waiting.len() + pins.runs.len(), 2, "they are there at once, to be solved");
    // Closed before they are solved, they are there the next time.
    assert_eq!(left(&mut window).0["pins"], memory.0["pins"]);
    until(&mut window, "the pins", |app| {
        if app.state().run.as_deref().is_none_or(|run| run.fidelity < Fidelity::Fine) {
            assert!(app.state().pins.runs.is_empty(), "the scene on screen comes first");
        }
        app.state().pins.waiting.is_empty()
    });
    assert_eq!(kept(window.state()), before);
    for ((ours, error), (theirs, other)) in alpha(window.state()).into_iter().zip(numbers) {
        assert!((ours - theirs).abs() <= error + other, "{ours} {theirs}");
    }
    // A new one comes after them.
    window.ctrl(Key::D);
    assert_eq!(labels(window.state())[..2], before.iter().map(|pin| pin.0.clone()).collect::<Vec<_>>());
    assert_eq!(window.known().pins.runs.len(), 3);
    // What was forgotten does not come back.
    window.ctrl(Key::Num2);
    window.click_on("Remove all");
    assert_eq!(left(&mut window).0["pins"], "[]");
}

#[test]
fn stored_pins_that_cannot_be_read_are_reported_and_the_others_come_back() {
    let mut window = once_solved(window("plate-crossover"));
    window.ctrl(Key::D);
    let good = left(&mut window);
    drop(window);
    let stored = good.0["pins"].clone();
    let broken = |from: &str, to: &str| {
        let twice =
            format!("[{0},{1}]", stored.trim_matches(['[', ']']).replace(from, to), &stored[1..stored.len() - 1]);
        assert!(twice.contains(to), "{twice}");
        twice
    };
    for (pins, said, left_over) in [
        ("nonsense".to_owned(), "expected", 0),
        (broken("mean_gap_um", "mean_gaps"), "mean_gaps", 1),
        (broken("\"fine\"", "\"finest\""), "allowed draft, standard, fine, reference", 1),
    ] {
        let mut memory = good.clone();
        memory.0.insert("pins".to_owned(), pins);
        let mut window = next(memory);
        window.run_steps(3);
        window.get_by_label("This did not work");
        window.get_by_label_contains("Not all pinned runs of the last window can be read");
        window.get_by_label_contains(said);
        window.click_on("Close");
        solved(&mut window);
        until(&mut window, "the others", |app| app.state().pins.waiting.is_empty());
        assert_eq!(window.known().pins.runs.len(), left_over);
    }
}

/// Presses and lets go.
fn click_at(window: &mut Window, place: Pos2) {
    window.drag_at(place);
    window.drop_at(place);
    window.run_steps(3);
}

/// Presses at `from`, moves to `to`, lets go.
fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.drag_at(from);
    window.run_steps(2);
    window.hover_at(to);
    window.run_steps(2);
    window.drop_at(to);
    window.run_steps(2);
}

#[test]
fn a_chart_is_dragged_and_zoomed_and_a_double_click_brings_it_back() {
    for (preset, tab, name) in [
        ("plate-crossover", Key::Num4, "Load over the cycle and its limits"),
        ("plate-crossover", Key::Num1, "Mean pressure against the gap"),
        ("plate-crossover", Key::Num1, "Pressure along the plate: point to read values"),
        ("fundamental", Key::Num1, "Loads over the cycle: click to jump there"),
        ("fundamental", Key::Num1, "Pressures along one wavelength: point to read values, click a tooth to follow it"),
    ] {
        let mut window = once_solved(window(preset));
        window.key_press(Key::Space);
        window.ctrl(tab);
        let id = eframe::egui::Id::unique(("chart", name));
        let range = |window: &Window| {
            let memory = egui_plot::PlotMemory::load(&window.ctx, id).unwrap();
            [memory.bounds().min()[0], memory.bounds().max()[0]]
        };
        let at_first = range(&window);
        let width = at_first[1] - at_first[0];
        // Beside the line at the present instant, which is dragged by itself.
        let middle = window.get_by_role_and_label(Role::Image, name).rect().center() + Vec2::new(11.0, 0.0);
        drag(&mut window, middle, middle + Vec2::new(60.0, 0.0));
        let dragged = range(&window);
        assert!(dragged[0] < at_first[0] - 0.01 * width, "{name}: {at_first:?} {dragged:?}");
        window.run_steps(3);
        assert_eq!(range(&window), dragged, "{name}: it stays where it is");
        window.hover_at(middle);
        window.event(Event::Zoom(2.0));
        window.run_steps(3);
        let zoomed = range(&window);
        assert!(zoomed[1] - zoomed[0] < 0.6 * width, "{name}: {dragged:?} {zoomed:?}");
        // Every event has a step of its own, and its time.
        window.ctx.options_mut(|options| options.input_options.max_double_click_delay = 10.0);
        for _ in 0..2 {
            window.drag_at(middle);
            window.drop_at(middle);
        }
        window.run_steps(3);
        assert_eq!(range(&window), at_first, "{name}");
        // Not so far out that its numbers have no meaning.
        window.hover_at(middle);
        for _ in 0..30 {
            window.event(Event::Zoom(0.5));
            window.run_steps(1);
            let out = range(&window);
            assert!(out[1] - out[0] < 250.0 * width, "{name}: {out:?}");
        }
    }
}

#[test]
fn the_ring_is_turned_with_the_mouse_and_with_the_arrow_keys() {
    const NAME: &str = "The whole ring: drag to turn it, double-click to put it back";
    let mut window = once_solved(window("fundamental"));
    window.click_on("Pause");
    let seen = |window: &Window| {
        let view = &window.known().view;
        (view.orbit, view.phase)
    };
    let (first, phase) = seen(&window);
    let middle = window.get_by_role_and_label(Role::Image, NAME).rect().center();
    drag(&mut window, middle, middle + Vec2::new(40.0, 30.0));
    let (dragged, _) = seen(&window);
    assert!(dragged.elevation > first.elevation + 0.1, "what is in front goes down with the pointer: {dragged:?}");
    assert!(dragged.azimuth > std::f64::consts::PI, "and to the right: {dragged:?}");
    // Once it has the keyboard the arrows are its own, and step no frames.
    window.get_by_role_and_label(Role::Image, NAME).focus();
    window.run_steps(2);
    for key in [Key::ArrowUp, Key::ArrowLeft, Key::ArrowLeft] {
        window.press(key);
    }
    let (turned, same) = seen(&window);
    let by = [turned.azimuth - dragged.azimuth, turned.elevation - dragged.elevation];
    assert!((by[0] - 0.2).abs() < 1e-9 && (by[1] - 0.1).abs() < 1e-9, "{by:?}");
    window.press(Key::Home);
    assert_eq!((seen(&window), same), ((first, phase), phase));
    drop(window);
    let window = once_solved(self::window("plate-trapped"));
    assert!(window.query_by_label(NAME).is_none(), "a plate is no ring");
}

#[test]
fn the_line_of_a_chart_over_the_cycle_is_dragged_to_another_instant() {
    let mut window = once_solved(window("plate-crossover"));
    window.click_on("Pause");
    let chart = window.get_by_role_and_label(Role::Image, "Load over the cycle: click to jump there").rect();
    let line = |window: &Window| window.get_by_label_contains("Line of Load over the cycle").rect().center();
    let (from, phase) = (line(&window), window.known().view.phase);
    let to = chart.lerp_inside(Vec2::new(if phase < 0.5 { 0.75 } else { 0.25 }, 0.3));
    drag(&mut window, from, to);
    let moved = window.known().view.phase;
    assert!((moved - if phase < 0.5 { 0.75 } else { 0.25 }).abs() < 0.02, "{phase} {moved}");
    assert!((line(&window).x - to.x).abs() < 3.0);
}

/// The ring's tab, its rotor computed and the scene solved.
fn ring() -> Window {
    let mut window = once_solved(window("ring-rotor"));
    window.ctrl(Key::Num8);
    until(&mut window, "the rotor is computed", |app| {
        let run = app.state().run.as_deref().map(|run| &run.problem.scenario);
        matches!(run, Some(Scenario::Motor(motor)) if app.state().rotor.is_of(motor))
    });
    window
}

/// A number of a part of the ring.
fn length(window: &Window, part: usize, column: usize) -> f64 {
    let Some(Value::Records(parts)) = window.known().document.scene().get("rotor.part") else { panic!("no parts") };
    parts[part][column].as_number().unwrap()
}

fn share(window: &Window) -> f64 {
    match &window.known().run.as_deref().unwrap().solution.outcome {
        Outcome::Motor(result) => result.alpha.value,
        Outcome::Plate(_) => panic!("a motor"),
    }
}

#[test]
fn an_edge_of_the_section_is_dragged_and_the_share_answers() {
    let mut window = ring();
    let before = share(&window);
    let at_first = window.known().document.scene().clone();
    // What two parts share moves with both: the rim stays on its lining.
    let edge = window.get_by_label("Top of lining, to drag").rect().center();
    drag(&mut window, edge, edge - Vec2::new(0.0, 12.0));
    let (top, bottom) = (length(&window, 0, 4), length(&window, 1, 3));
    assert!(top > 0.2 && top == bottom, "{top} {bottom}");
    solved(&mut window);
    let after = share(&window);
    assert!((after / before - 1.0).abs() > 0.005, "{before} {after}");
    // No further than to its other side.
    let edge = window.get_by_label("Outer radius of flange, to drag").rect().center();
    drag(&mut window, edge, edge - Vec2::new(2000.0, 0.0));
    assert_eq!((length(&window, 2, 2), length(&window, 1, 1)), (26.91, 26.91));
    // Each drag is one step back.
    window.ctrl(Key::Z);
    window.ctrl(Key::Z);
    assert_eq!(window.known().document.scene(), &at_first);
}

#[test]
fn the_length_of_an_edge_is_told_while_it_is_dragged() {
    let mut window = ring();
    let edge = window.get_by_label("Top of lining, to drag").rect().center();
    let told = |window: &Window| format!("Top of lining: {} mm", significant(length(window, 0, 4), 5));
    window.drag_at(edge);
    window.run_steps(2);
    for up in [6.0, 12.0] {
        window.hover_at(edge - Vec2::new(0.0, up));
        window.run_steps(3);
        assert!(length(&window, 0, 4) > 0.15 && window.shows(&told(&window)), "{}", told(&window));
    }
    window.drop_at(edge - Vec2::new(0.0, 12.0));
    window.run_steps(2);
}

#[test]
fn a_part_is_edited_in_its_table() {
    let mut window = ring();
    let before = share(&window);
    let labels = window.query_all_by_label("Rotor").count();
    (0..labels).for_each(|label| {
        window.query_all_by_label("Rotor").nth(label).unwrap().click();
        window.run_steps(10);
    });
    let field = "Top in mm, lining";
    window.get_by_role_and_label(Role::SpinButton, field).scroll_to_me();
    window.run_steps(10);
    window.type_over(Role::SpinButton, field, "0.1");
    window.press(Key::Enter);
    // The rim comes down with it.
    assert_eq!((length(&window, 0, 4), length(&window, 1, 3)), (0.1, 0.1));
    // Any unit, a comma, one step back; what is no length of a part is refused with the reason.
    for (text, top) in [("0,15", 0.15), ("120um", 0.12), ("99999", 0.12), ("wide", 0.12)] {
        window.type_over(Role::SpinButton, field, text);
        assert_eq!(length(&window, 0, 4), if text == "0,15" { 0.1 } else { length(&window, 1, 3) }, "{text}, typed");
        window.press(Key::Enter);
        window.run_steps(2);
        assert_eq!(length(&window, 0, 4), top, "{text}");
        let reason = format!("{text}: expected a number from");
        assert_eq!(window.query_by_label_contains(&reason).is_some(), text == "99999" || text == "wide", "{text}");
    }
    window.ctrl(Key::Z);
    window.ctrl(Key::Z);
    assert_eq!(length(&window, 0, 4), 0.1);
    // A field that is only left changes nothing, though it shows four decimals.
    let Some(Value::Records(mut parts)) = window.known().document.scene().get("rotor.part") else { panic!("no parts") };
    (parts[0][4], parts[1][3]) = (Value::Number(0.123_456), Value::Number(0.123_456));
    let value = Value::Records(parts);
    window.state_mut().carry_out(Command::Set { key: "rotor.part", value, dragging: false });
    window.run_steps(2);
    window.get_by_role_and_label(Role::SpinButton, field).click();
    window.run_steps(2);
    window.press(Key::Enter);
    window.run_steps(2);
    assert_eq!(length(&window, 0, 4), 0.123_456);
    solved(&mut window);
    let after = share(&window);
    assert!((after / before - 1.0).abs() > 0.005, "{before} {after}");
}
