//! What the window must not do: lose what was typed or asked for, act behind a question, or show old results as new ones.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod window;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use squeezefilm::gui::app::App;
use squeezefilm::gui::state::dialogs::{Answer, Purpose};
use squeezefilm::gui::state::document::Document;
use squeezefilm::gui::state::tradeoff::TradeoffState;
use squeezefilm::gui::update::platform::{DialogStart, Platform};
use squeezefilm::gui::update::storage::StoragePlace;
use squeezefilm::job::task::BackgroundTask;
use squeezefilm::scene::{Scene, Value, presets};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use window::{Memory, User, Window, begin_export, drop_file, has_torque, left, open, reopen, reopen_on, solved, until};

const CTRL: Modifiers = Modifiers::COMMAND;
const SPACING: &str = "film.min_spacing_nm";
const FIELD: &str = "Minimum spacing H_m in nm";

fn window(ask: fn(Purpose, &DialogStart) -> Answer, (scene, path): (Scene, Option<PathBuf>)) -> Window {
    let platform = Platform { ask, ..Platform::default() };
    open(Document::opened(scene, path), 900.0, platform)
}

/// A window on a built-in preset, whose file dialogs are cancelled.
fn preset(name: &str) -> Window {
    window(|_, _| Answer::Cancelled, (presets::find(name).unwrap(), None))
}

fn value(app: &App, key: &str) -> Value {
    app.state().document.scene().get(key).unwrap()
}

#[test]
fn what_is_being_typed_is_saved_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let scene = presets::find("fundamental").unwrap();
    scene.save(&path).unwrap();
    let mut window = window(|_, _| Answer::Cancelled, (scene, Some(path.clone())));
    window.type_over(Role::TextInput, FIELD, "120");
    window.ctrl(Key::S);
    assert_eq!(Scene::load(&path).unwrap().get(SPACING), Some(Value::Number(120.0)));
    assert!(!window.known().document.is_dirty());
    // What is refused is not taken for saved: the field says why, and the file is as it was.
    let before = std::fs::metadata(&path).unwrap().modified().unwrap();
    window.type_over(Role::TextInput, FIELD, "3");
    window.ctrl(Key::S);
    window.get_by_label_contains("allowed 5 to 10000 nm");
    assert_eq!(std::fs::metadata(&path).unwrap().modified().unwrap(), before);
}

#[test]
fn a_file_that_another_program_has_changed_is_not_replaced_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let scene = presets::find("fundamental").unwrap();
    scene.save(&path).unwrap();
    let mut window = window(|_, _| Answer::Cancelled, (scene, Some(path.clone())));
    let other = presets::find("levitating").unwrap();
    other.save(&path).unwrap();
    window.type_over(Role::TextInput, FIELD, "120");
    for (button, replaced) in [("Keep editing", false), ("Replace it", true)] {
        window.ctrl(Key::S);
        assert_eq!(Scene::load(&path).unwrap(), other);
        window.click_on(button);
        let now = Scene::load(&path).unwrap();
        assert_eq!((now == other, window.known().document.is_dirty()), (!replaced, !replaced), "{button}");
    }
    // What it has written itself it knows.
    window.type_over(Role::TextInput, FIELD, "130");
    window.ctrl(Key::S);
    assert_eq!(Scene::load(&path).unwrap().get(SPACING), Some(Value::Number(130.0)));
}

#[test]
fn what_is_being_typed_is_asked_about_before_the_window_closes() {
    for by_key in [true, false] {
        let mut window = preset("fundamental");
        window.type_over(Role::TextInput, FIELD, "120");
        if by_key {
            window.ctrl(Key::Q);
        } else {
            close(&mut window);
        }
        assert!(!window.known().quitting, "by key: {by_key}");
        window.get_by_label_contains("Save the changes");
        assert_eq!(value(window.state(), SPACING), Value::Number(120.0));
    }
}

/// The system asks the window to close, as its button and the Dock do.
fn close(window: &mut Window) {
    let id = window.input().viewport_id;
    window.input_mut().viewports.entry(id).or_default().events.push(eframe::egui::ViewportEvent::Close);
    window.step();
    window.input_mut().viewports.entry(id).or_default().events.clear();
    window.run_steps(3);
}

#[test]
fn shortcuts_do_not_act_behind_a_question_or_in_a_text() {
    let mut window = preset("plate-crossover");
    let key = "plate.frequency_khz";
    window.type_into("Frequency in kHz", "12");
    assert_eq!(value(window.state(), key), Value::Number(12.0));
    // A text has an undo of its own.
    window.type_over(Role::TextInput, "Frequency in kHz", "13");
    window.ctrl(Key::Z);
    assert_eq!(value(window.state(), key), Value::Number(12.0));
    window.press(Key::Escape);
    // Behind the question nothing is undone, pinned or opened; the theme may be changed.
    window.ctrl(Key::Q);
    window.get_by_label_contains("Save the changes");
    let tab = window.known().view.tab;
    for asked in [Key::Z, Key::D, Key::Num3] {
        window.ctrl(asked);
    }
    let state = window.known();
    assert_eq!(value(window.state(), key), Value::Number(12.0));
    assert!(state.pins.runs.is_empty() && state.view.tab == tab && state.dark);
    window.ctrl(Key::T);
    assert!(!window.known().dark);
    window.click_on("Keep editing");
    window.ctrl(Key::Z);
    assert_ne!(value(window.state(), key), Value::Number(12.0));
    window.ctrl(Key::Y);
    assert_eq!(value(window.state(), key), Value::Number(12.0));
}

#[test]
fn results_of_an_earlier_scene_are_not_shown_as_present_ones() {
    let mut window = preset("fundamental");
    solved(&mut window);
    window.ctrl(Key::Num4);
    until(&mut window, "torque over speed", has_torque);
    window.get_by_label_contains("✔ Converged");
    assert!(window.query_by_label_contains("Result of the scene before this edit").is_none());
    // A scene that no memory holds is refused at once: what is shown is of the one before.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.toml");
    let mut large = presets::find("fundamental").unwrap();
    let sizes = [("film_nodes_along", "2001"), ("film_nodes_across", "501"), ("steps_per_cycle", "100000")];
    sizes.iter().for_each(|(key, size)| large.set(&format!("numerics.{key}"), size).unwrap());
    large.set("numerics.teeth", "all").unwrap();
    large.save(&path).unwrap();
    drop_file(&mut window, path);
    until(&mut window, "the refusal", |app| app.state().activity.failure.is_some());
    assert!(window.query_by_label_contains("✔ Converged").is_none());
    // In the panel of results, and in the tab.
    for tab in [Key::Num4, Key::Num1] {
        window.ctrl(tab);
        let told = window.query_all_by_label_contains("Result of the scene before this edit; the present scene has no");
        assert_eq!(told.count(), 2);
    }
}

#[test]
fn what_was_saved_under_another_name_is_pinned_under_it() {
    static FOLDER: OnceLock<tempfile::TempDir> = OnceLock::new();
    FOLDER.set(tempfile::tempdir().unwrap()).unwrap();
    fn ask(_: Purpose, _: &DialogStart) -> Answer {
        Answer::Path(FOLDER.get().unwrap().path().join("mine.toml"))
    }
    let original = presets::find("plate-crossover").unwrap();
    let mut window = window(ask, (original.clone(), None));
    window.type_into("Frequency in kHz", "12");
    until(&mut window, "its run", |app| {
        app.state().run.as_ref().is_some_and(|run| run.scene.get("plate.frequency_khz") == Some(Value::Number(12.0)))
    });
    window.press_with(CTRL | Modifiers::SHIFT, Key::S);
    until(&mut window, "the file", |app| app.state().document.path().is_some());
    window.ctrl(Key::D);
    let pin = &window.known().pins.runs[0];
    assert_eq!(pin.label, format!("{}, changed", original.name));
    assert_eq!(pin.scene.about, format!("Made from {}.", original.name));
}

#[test]
fn cancelling_one_dialog_leaves_the_others_alone_and_none_is_there_twice() {
    static SHOWN: AtomicUsize = AtomicUsize::new(0);
    static CANCELLED: AtomicBool = AtomicBool::new(false);
    // "Save" is answered only after "Open" was cancelled.
    fn ask(purpose: Purpose, _: &DialogStart) -> Answer {
        match purpose {
            Purpose::Save(_) => {
                SHOWN.fetch_add(1, Ordering::SeqCst);
                while !CANCELLED.load(Ordering::SeqCst) {
                    std::thread::sleep(Duration::from_millis(5));
                }
                Answer::Path(std::env::temp_dir().join(format!("squeezefilm-{}.toml", std::process::id())))
            }
            _ => Answer::Cancelled,
        }
    }
    let mut window = window(ask, (presets::find("plate-crossover").unwrap(), None));
    window.type_over(Role::TextInput, "Frequency in kHz", "12");
    window.ctrl(Key::Q);
    window.click_on("Save");
    window.press_with(CTRL | Modifiers::SHIFT, Key::S);
    window.ctrl(Key::O);
    std::thread::sleep(Duration::from_millis(50));
    window.run_steps(3);
    CANCELLED.store(true, Ordering::SeqCst);
    until(&mut window, "saved, and closed as asked", |app| app.state().quitting);
    assert_eq!(SHOWN.load(Ordering::SeqCst), 1);
    let path = window.known().document.path().unwrap().to_owned();
    assert_eq!(Scene::load(&path).unwrap().get("plate.frequency_khz"), Some(Value::Number(12.0)));
    std::fs::remove_file(path).unwrap();
}

#[test]
fn a_path_is_kept_in_full() {
    let path = PathBuf::from("presets/plate-crossover.toml");
    let window = window(|_, _| Answer::Cancelled, (Scene::load(&path).unwrap(), Some(path.clone())));
    let state = window.known();
    assert_eq!(state.document.path(), Some(std::env::current_dir().unwrap().join(&path).as_path()));
}

#[test]
fn a_file_holds_what_its_name_says() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window(|_, _| Answer::NoDialog, (presets::find("plate-crossover").unwrap(), None));
    solved(&mut window);
    // Another kind of file is refused, and nothing is written.
    begin_export(&mut window, "Fields as NumPy archive…", &folder.path().join("x.jpg"));
    window.get_by_label_contains("allowed .npz");
    window.click_on("Close");
    assert!(!folder.path().join("x.jpg").exists());
    // Without an extension it gets its own, but replaces nothing that nobody was asked about.
    begin_export(&mut window, "Fields as NumPy archive…", &folder.path().join("x"));
    until(&mut window, "written", |app| app.state().exports.written.is_some());
    assert!(folder.path().join("x.npz").is_file() && !folder.path().join("x").exists());
    begin_export(&mut window, "Fields as NumPy archive…", &folder.path().join("x"));
    window.get_by_label_contains("give its whole name");
    window.click_on("Close");
    begin_export(&mut window, "Animation…", &folder.path().join("cycle"));
    until(&mut window, "the animation is under way or done", |app| {
        app.state().exports.running.is_some() || app.state().exports.written.is_some()
    });
    until(&mut window, "the animation", |app| app.state().exports.running.is_none());
    assert!(folder.path().join("cycle.gif").is_file() && !folder.path().join("cycle").exists());
}

#[test]
fn quitting_asks_about_work_that_goes_on() {
    let mut window = preset("plate-crossover");
    solved(&mut window);
    window.ctrl(Key::Num3);
    window.type_over(Role::TextInput, "Values along x", "2000");
    window.step();
    window.get_by_label("Start the sweep").click();
    until(&mut window, "the sweep", |app| app.state().sweep.swept.as_ref().is_some_and(|swept| swept.running));
    close(&mut window);
    assert!(!window.known().quitting);
    window.get_by_label_contains("of 2000 points");
    window.click_on("Keep the window open");
    assert!(window.known().sweep.swept.as_ref().is_some_and(|swept| swept.running));
    window.ctrl(Key::Q);
    window.click_on("Quit anyway");
    assert!(window.known().quitting);
}

#[test]
fn pins_that_were_removed_together_come_back() {
    let mut window = preset("plate-crossover");
    for frequency in ["12", "13"] {
        window.type_into("Frequency in kHz", frequency);
        solved(&mut window);
        window.ctrl(Key::D);
    }
    window.ctrl(Key::Num2);
    assert_eq!(window.known().pins.runs.len(), 2);
    window.click_on("Remove all");
    assert!(window.known().pins.runs.is_empty());
    window.click_on("Bring the pins back");
    assert_eq!(window.known().pins.runs.len(), 2);
}

#[test]
fn nothing_is_undone_behind_an_open_menu() {
    let mut window = preset("fundamental");
    window.type_into("Minimum spacing H_m in nm", "123");
    let spacing = |window: &Window| window.known().document.scene().get("film.min_spacing_nm");
    window.click_on("Presets");
    window.ctrl(Key::Z);
    assert_eq!(spacing(&window), Some(Value::Number(123.0)));
    window.press(Key::Escape);
    window.ctrl(Key::Z);
    assert_eq!(spacing(&window), Some(Value::Number(200.0)));
}

fn saved_scene() -> String {
    presets::find("fundamental").unwrap().to_toml()
}

#[test]
fn changes_that_the_last_window_left_unsaved_are_asked_for_before_another_scene_is_opened() {
    let mut edited = presets::find("fundamental").unwrap();
    edited.set("film.min_spacing_nm", "77").unwrap();
    let left = [("scene", edited.to_toml()), ("saved", saved_scene())].map(|(key, text)| (key.to_owned(), text));
    let opened = Document::opened(presets::find("levitating").unwrap(), None);
    let platform = Platform { ask: |_, _| Answer::Cancelled, ..Platform::default() };
    let mut window = reopen_on(Memory(left.into()), Some(opened.clone()), 900.0, platform);
    window.run_steps(2);
    let name = |window: &Window| window.known().document.scene().name.clone();
    assert_eq!(name(&window), edited.name);
    window.get_by_label_contains("Save the changes");
    window.click_on("Don't save");
    window.run_steps(2);
    assert_eq!(name(&window), opened.scene().name);
}

#[test]
fn what_the_last_window_left_and_cannot_be_read_is_told_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("app.json");
    let open = || {
        let storage = StoragePlace::File(file.clone());
        let platform = Platform { storage, ask: |_, _| Answer::Cancelled, ..Platform::default() };
        let mut window = reopen(Memory::default(), 900.0, platform);
        window.run_steps(2);
        window
    };
    let leave = |entries: &[(&str, &str)]| {
        let entries: BTreeMap<_, _> = entries.iter().copied().collect();
        std::fs::write(&file, serde_json::to_string(&entries).unwrap()).unwrap();
    };
    let kept = || std::fs::read_dir(folder.path()).unwrap().count();
    // A scene of a later version.
    leave(&[("scene", "schema = 1\nname = \"later\"\n[film]\nnot_yet_known = 3\n")]);
    let window = open();
    window.get_by_label_contains("not_yet_known");
    window.get_by_label_contains("app.unreadable-1.json");
    assert_eq!(kept(), 2);
    drop(window);
    std::fs::write(&file, "{\"scene\": \"cut sho").unwrap();
    let window = open();
    window.get_by_label_contains("this file was not written by a window of this version");
    assert_eq!(std::fs::read_to_string(folder.path().join("app.unreadable-2.json")).unwrap(), "{\"scene\": \"cut sho");
    drop(window);
    // So are progress in lessons and settings that cannot be read.
    leave(&[
        ("lessons", "{\"a\": {\"step\": \"3\"}}"),
        ("budget", "soon"),
        ("lecture", "maybe"),
        ("eyesight", "of a later version"),
        ("scene", &saved_scene()),
    ]);
    let window = open();
    for fault in [
        "The progress in lessons cannot be read",
        "soon",
        "lecture = maybe: false or true is allowed",
        "The state of the last window holds what this version does not know: eyesight.",
        "app.unreadable-3.json",
    ] {
        window.get_by_label_contains(fault);
    }
    drop(window);
    // The first window of all has nothing to complain about.
    std::fs::remove_file(&file).unwrap();
    let window = open();
    assert!(window.query_by_label("This did not work").is_none());
    assert_eq!(kept(), 3);
}

#[test]
fn what_a_window_cannot_keep_is_told_once() {
    let folder = tempfile::tempdir().unwrap();
    let storage = StoragePlace::File(folder.path().join("absent/app.json"));
    let mut window = reopen(Memory::default(), 900.0, Platform { storage, ..Platform::default() });
    window.run_steps(2);
    let told = |window: &Window| window.query_by_label_contains("is not kept for the next start").is_some();
    assert!(!told(&window));
    assert!(left(&mut window).0.is_empty());
    window.run_steps(2);
    assert!(told(&window));
    window.click_on("Close");
    left(&mut window);
    window.run_steps(2);
    assert!(!told(&window));
    // What it can keep, the next one begins with.
    std::fs::create_dir(folder.path().join("absent")).unwrap();
    left(&mut window);
    assert!(std::fs::read_to_string(folder.path().join("absent/app.json")).unwrap().contains("\"scene\""));
}

#[test]
fn a_panic_of_a_measurement_ends_it_and_is_told() {
    let task = BackgroundTask::start("test", None, |_| (), |_, _| panic!("out of luck")).unwrap();
    let mut state = TradeoffState::new(task, Scene::motor(), Instant::now());
    for _ in 0..6000 {
        state.drain();
        if !state.work.running() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    assert!(!state.work.running());
    assert_eq!(state.work.failure.as_deref(), Some("it failed: out of luck"));
}

#[test]
fn a_file_that_is_dropped_waits_for_the_text_and_does_not_answer_a_question() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.toml");
    presets::find("levitating").unwrap().save(&path).unwrap();
    let mut window = preset("plate-crossover");
    window.type_over(Role::TextInput, "Mean gap in µm", "1.25");
    drop_file(&mut window, &path);
    window.get_by_label_contains("Save the changes");
    assert_eq!(value(window.state(), "plate.mean_gap_um"), Value::Number(1.25));
    // Another one while it is asked.
    drop_file(&mut window, folder.path().join("none.toml"));
    window.get_by_label_contains("Save the changes");
    window.click_on("Don't save");
    assert!(window.known().document.scene().name.starts_with("Levitating"));
}
