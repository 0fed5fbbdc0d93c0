//! Pictures of the window, compared with those in `tests/snapshots`. Needs a Vulkan driver; without one it says so and
//! passes, unless SQUEEZEFILM_SNAPSHOTS=required. After a change that is meant to be seen:
//!
//! ```sh
//! UPDATE_SNAPSHOTS=1 cargo test --features snapshots --test gui_snapshots
//! ```
//!
//! and look at every picture that git reports as changed.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::print_stderr, reason = "says that it was skipped")]

mod window;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::wgpu::{WgpuTestRenderer, default_wgpu_setup};
use egui_kittest::{Harness, SnapshotResults};
use squeezefilm::analysis::tradeoff::{Candidate, Effort, candidates};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::app::App;
use squeezefilm::gui::state::dialogs::Answer;
use squeezefilm::gui::state::document::Document;
use squeezefilm::gui::state::view::Tab;
use squeezefilm::gui::update::platform::Platform;
use squeezefilm::problem::{Problem, Scenario};
use squeezefilm::scene::presets;
use squeezefilm::solve::Method;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};
use window::{User, Window, await_path, drop_file, face, has_torque, measured};

const USUAL: [f32; 2] = [1400.0, 900.0];
const SMALL: [f32; 2] = [1024.0, 700.0];
const THEME: (Modifiers, Key) = (Modifiers::COMMAND, Key::T);
const LECTURE: (Modifiers, Key) = (Modifiers::COMMAND, Key::L);
const SHEET: (Modifiers, Key) = (Modifiers::NONE, Key::F1);
const TORQUE: (Modifiers, Key) = (Modifiers::COMMAND, Key::Num4);
const HOLD: (Modifiers, Key) = (Modifiers::COMMAND, Key::Num7);
const OPEN: (Modifiers, Key) = (Modifiers::COMMAND, Key::O);

const LOOKS: &[Look] = &[
    ("motor-dark", "fundamental", USUAL, &[]),
    ("motor-light", "fundamental", USUAL, &[THEME]),
    ("motor-lecture", "fundamental", USUAL, &[LECTURE]),
    ("motor-small", "fundamental", SMALL, &[]),
    ("levitating-small-light", "levitating", SMALL, &[THEME]),
    ("plate-dark", "plate-crossover", USUAL, &[]),
    ("plate-small-light", "plate-trapped", SMALL, &[THEME]),
    ("torque-dark", "fundamental", USUAL, &[TORQUE]),
    ("torque-lecture", "fundamental", USUAL, &[LECTURE, TORQUE]),
    ("torque-small-light", "tooth-radius-6.5m", SMALL, &[THEME, TORQUE]),
    ("exact-dark", "plate-crossover", USUAL, &[TORQUE]),
    ("exact-lecture", "plate-viscous", USUAL, &[LECTURE, TORQUE]),
    ("exact-small-light", "plate-trapped", SMALL, &[THEME, TORQUE]),
    ("shortcuts-lecture", "plate-viscous", USUAL, &[LECTURE, SHEET]),
    ("hold-dark", "plate-crossover", USUAL, &[HOLD]),
    ("hold-lecture-light", "plate-crossover", SMALL, &[HOLD, THEME, LECTURE]),
];

/// A clock that stands: solves take no time, and the animation does not move by itself.
fn standing() -> Instant {
    static MOMENT: OnceLock<Instant> = OnceLock::new();
    *MOMENT.get_or_init(Instant::now)
}

/// The same, but the measurement of error against time sees time pass, as much each time as the last time and a little more.
fn measuring() -> Instant {
    static LOOKED: AtomicU32 = AtomicU32::new(0);
    if std::thread::current().name() != Some("squeezefilm-measure") {
        return standing();
    }
    let looked = LOOKED.fetch_add(1, Ordering::Relaxed);
    standing() + looked * looked * Duration::from_micros(40)
}

/// The fidelities that have names and a few grids, in this order, twice each.
fn few(problem: &Problem) -> (Vec<Candidate>, Effort) {
    let mut few = candidates(problem);
    few.retain(|candidate| candidate.name != "reference" && candidate.settings.method == Method::Auto);
    few.retain(|candidate| !matches!(candidate.settings.fidelity, Fidelity::To(_)));
    few.truncate(6);
    (few, Effort { repeats: Some(2), ..Effort::default() })
}

/// Name of the picture, preset, size of the window, keys that are pressed.
type Look = (&'static str, &'static str, [f32; 2], &'static [(Modifiers, Key)]);

/// No results yet; `None`, and why, if there is no driver to draw with.
fn results() -> Option<SnapshotResults> {
    let instance = pollster_wait(default_wgpu_setup().new_instance());
    if pollster_wait(instance.enumerate_adapters(eframe::wgpu::Backends::VULKAN)).is_empty() {
        let required = std::env::var_os("SQUEEZEFILM_SNAPSHOTS").is_some_and(|value| value == "required");
        assert!(!required, "there is no Vulkan driver");
        eprintln!("skipped: there is no Vulkan driver (Debian: mesa-vulkan-drivers)");
        return None;
    }
    Some(SnapshotResults::new())
}

fn pollster_wait<T>(future: impl std::future::Future<Output = T>) -> T {
    let mut future = std::pin::pin!(future);
    let mut context = std::task::Context::from_waker(std::task::Waker::noop());
    loop {
        if let std::task::Poll::Ready(value) = future.as_mut().poll(&mut context) {
            return value;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// The window on a preset, solved, standing at a phase in which several teeth touch.
fn window(preset: &str, size: [f32; 2], keys: &[(Modifiers, Key)]) -> Window {
    let scene = presets::find(preset).unwrap();
    let platform = Platform { now: measuring, ask: |_, _| Answer::NoDialog, measure: few, ..Platform::default() };
    let mut window = Harness::builder()
        .with_size(Vec2::from(size))
        .with_pixels_per_point(1.0)
        .renderer(WgpuTestRenderer::new())
        .build_eframe(move |context| App::on_platform(context, Some(Document::opened(scene, None)), platform).unwrap());
    // How long the solver takes decides how long a cursor has been blinking.
    window.ctx.all_styles_mut(|style| style.visuals.text_cursor.blink = false);
    window.key_press(Key::Space);
    solved(&mut window);
    window.press(Key::Home);
    for _ in 0..7 {
        window.press(Key::ArrowRight);
    }
    for _ in 0..2 {
        window.press(Key::CloseBracket);
    }
    for (modifiers, key) in keys {
        window.key_press_modifiers(*modifiers, *key);
        settle(&mut window);
    }
    until(&mut window, "what a tab computes in the background", |app| {
        app.state().view.tab != Tab::Torque
            || has_torque(app)
            || app.state().run.as_deref().is_some_and(|run| matches!(run.problem.scenario, Scenario::Plate(_)))
    });
    window
}

/// Steps until `ready`, and until nothing moves any more.
fn until(window: &mut Window, what: &str, ready: impl Fn(&App) -> bool) {
    window::until(window, what, ready);
    settle(window);
}

/// Until the scene on screen is solved, and nothing moves any more.
fn solved(window: &mut Window) {
    window::solved(window);
    settle(window);
}

/// Two pinned runs of a preset that differ in one key, and a preset beside them.
fn compared(preset: &str, (field, text): (&str, &str), size: [f32; 2], keys: &[(Modifiers, Key)]) -> Window {
    let mut window = window(preset, size, keys);
    window.ctrl(Key::D);
    settle(&mut window);
    window.type_into(field, text);
    solved(&mut window);
    window.ctrl(Key::D);
    settle(&mut window);
    window.ctrl(Key::Num2);
    settle(&mut window);
    window
}

/// A sweep that has ended.
fn swept(preset: &str, two: bool, size: [f32; 2], keys: &[(Modifiers, Key)]) -> Window {
    let mut window = window(preset, size, keys);
    window.ctrl(Key::Num3);
    settle(&mut window);
    if two {
        window.get_by_label("Add a second…").click();
        settle(&mut window);
    }
    window.click_on("Start the sweep");
    until(&mut window, "swept", |app| app.state().sweep.swept.as_ref().is_some_and(|swept| !swept.running));
    window
}

/// Until panels have their sizes and nothing fades in any more.
fn settle(window: &mut Window) {
    window.run_steps(20);
}

/// Compares the window with its picture of this name; what differs is told at the end.
fn compare(results: &mut SnapshotResults, window: &mut Window, name: &str) {
    window.snapshot(name);
    results.extend_harness(window);
}

/// A start-up that has come to its end.
fn started(results: &mut SnapshotResults) {
    const STARTUP: (Modifiers, Key) = (Modifiers::COMMAND, Key::Num6);
    for (name, preset, size, keys) in [
        ("startup-dark", "fundamental", USUAL, &[STARTUP][..]),
        ("startup-plate-small-light", "plate-crossover", SMALL, &[STARTUP, THEME]),
    ] {
        let mut window = window(preset, size, keys);
        window.get_by_label("Start from rest").click();
        until(&mut window, "the start-up ends", |app| {
            app.state().startup.as_ref().is_some_and(|starting| starting.transient.ended.is_some())
        });
        compare(results, &mut window, name);
    }
}

#[test]
fn the_window_looks_as_it_did() {
    let Some(mut results) = results() else { return };
    for &(name, preset, size, keys) in LOOKS {
        let mut window = window(preset, size, keys);
        compare(&mut results, &mut window, name);
    }
    let spacing = ("Minimum spacing H_m in nm", "100");
    let mut window = compared("fundamental", spacing, USUAL, &[]);
    window.snapshot("compare-dark");
    window.get_by_label("Numbers").click();
    settle(&mut window);
    compare(&mut results, &mut window, "compare-numbers");
    let mut window = compared("plate-crossover", ("Frequency in kHz", "40"), SMALL, &[THEME]);
    compare(&mut results, &mut window, "compare-plates-small-light");
    let mut window = compared("fundamental", spacing, USUAL, &[LECTURE]);
    compare(&mut results, &mut window, "compare-lecture");
    for (name, preset, two, size, keys) in [
        ("sweep-dark", "fundamental", false, USUAL, &[][..]),
        ("sweep-lecture", "fundamental", false, USUAL, &[LECTURE]),
        ("sweep-map-small-light", "plate-crossover", true, SMALL, &[THEME]),
    ] {
        let mut window = swept(preset, two, size, keys);
        compare(&mut results, &mut window, name);
    }
    let mut window = self::window("fundamental", USUAL, &[(Modifiers::COMMAND, Key::Num5)]);
    window.click_on("Measure");
    until(&mut window, "measured", measured);
    compare(&mut results, &mut window, "trade-off");
    let mut window = self::window("plate-crossover", USUAL, &[LECTURE, TORQUE]);
    window.get_by_label_contains("6mH^2").scroll_to_me();
    settle(&mut window);
    compare(&mut results, &mut window, "exact-formulas");
    started(&mut results);
    open_by_path(&mut results);
}

/// What the results depend on, before and after parameters are uncertain.
#[test]
fn sensitivities_look_as_they_did() {
    let Some(mut results) = results() else { return };
    let mut window = window("fundamental", USUAL, &[(Modifiers::COMMAND, Key::Num9)]);
    window.click_on("Compute sensitivities");
    until(&mut window, "sensitivities", |app| app.state().sensitivity.found.is_some());
    window.snapshot("sensitivity");
    for (parameter, amount) in [("Minimum spacing H_m", "20%"), ("Load on one wave", "±10%")] {
        window.type_over(Role::TextInput, &format!("Uncertainty of {parameter}"), amount);
        window.run_steps(2);
    }
    window.click_on("Draw and solve");
    until(&mut window, "random scenes", |app| app.state().sensitivity.carlo.is_some());
    window.get_by_label("Draw and solve").scroll_to_me();
    settle(&mut window);
    compare(&mut results, &mut window, "sensitivity-uncertain");
}

/// The rotor by itself: a ring with its parts among the parameters, and a beam.
#[test]
fn a_rotor_looks_as_it_did() {
    const ROTOR: (Modifiers, Key) = (Modifiers::COMMAND, Key::Num8);
    let Some(mut results) = results() else { return };
    let computed = |app: &App| match app.state().run.as_deref().map(|run| &run.problem.scenario) {
        Some(Scenario::Motor(motor)) => app.state().rotor.is_of(motor),
        _ => false,
    };
    let mut window = window("ring-rotor", USUAL, &[ROTOR]);
    until(&mut window, "the rotor is computed", computed);
    // The label of the tab, and the heading of the group.
    let labels = window.query_all_by_label("Rotor").count();
    for label in 0..labels {
        window.query_all_by_label("Rotor").nth(label).unwrap().click();
        settle(&mut window);
    }
    compare(&mut results, &mut window, "rotor-ring");
    let mut window = self::window("fundamental", SMALL, &[ROTOR, THEME]);
    until(&mut window, "the rotor is computed", computed);
    compare(&mut results, &mut window, "rotor-beam-small-light");
    let mut window = self::window("rough-flow", USUAL, &[ROTOR]);
    until(&mut window, "the rotor is computed", computed);
    window.snapshot("rotor-rough-faces");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("face.csv");
    std::fs::write(&path, face()).unwrap();
    drop_file(&mut window, &path);
    until(&mut window, "the heights are read", |app| app.state().face.found.is_some());
    window.get_by_role_and_label(Role::Image, "Profile along x, nm").scroll_to_me();
    settle(&mut window);
    compare(&mut results, &mut window, "rotor-measured-face");
}

/// A fit with its residuals, in a small window and light too; and measured torques over the curve.
#[test]
fn measurements_look_as_they_did() {
    const FIT: (Modifiers, Key) = (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::F);
    let Some(mut results) = results() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (loads, torques) = (folder.path().join("loads.csv"), folder.path().join("torques.csv"));
    let rows = "row,stator.frequency_khz,film_load_n\nlow,20,0.550\n,40,0.600\n,60,0.615\nhigh,100,0.630\n";
    std::fs::write(&loads, rows).unwrap();
    std::fs::write(&torques, "rotor_speed_rpm,torque_nm\n0,0.27\n20,0.255\n40,0.24\n50,0.21\n55,0.12\n").unwrap();
    for (name, size, keys) in [("fit-dark", USUAL, &[FIT][..]), ("fit-small-light", SMALL, &[FIT, THEME][..])] {
        let mut window = window("fundamental", size, keys);
        drop_file(&mut window, &loads);
        window.get_by_label("Add a key…").click();
        settle(&mut window);
        window.get_by_label("Fit the scene").click();
        until(&mut window, "the fit", |app| app.state().fit.found.is_some());
        compare(&mut results, &mut window, name);
    }
    let mut window = window("fundamental", USUAL, &[TORQUE]);
    drop_file(&mut window, &torques);
    settle(&mut window);
    compare(&mut results, &mut window, "torque-measured");
}

/// A path to type, and what cannot be opened, in a small window with large text.
fn open_by_path(results: &mut SnapshotResults) {
    let mut window = window("fundamental", SMALL, &[LECTURE, OPEN]);
    await_path(&mut window);
    settle(&mut window);
    window.snapshot("open-by-path");
    window.get_by_role_and_label(Role::TextInput, "Path").type_text("/absent.toml");
    window.step();
    window.key_press(Key::Enter);
    settle(&mut window);
    compare(results, &mut window, "error");
}

/// Clicks these one after the other, by their names.
fn click(window: &mut Window, labels: &[&str]) {
    for label in labels {
        // A choice is there twice: its mark, and its words.
        window.query_all_by_label_contains(label).next().unwrap().click();
        settle(window);
    }
}

/// Until the scene of a lesson's step is solved, with the pointer where nothing is.
fn still(window: &mut Window) {
    solved(window);
    window.hover_at(eframe::egui::pos2(700.0, 1.0));
    settle(window);
}

#[test]
fn lessons_tour_and_glossary_look_as_they_did() {
    let Some(mut results) = results() else { return };
    // A formula, a question and a task; small and light, a task that is done.
    for (name, size, keys) in [
        ("lesson-dark", USUAL, &[][..]),
        ("lesson-small-light", SMALL, &[THEME][..]),
        ("lesson-lecture", USUAL, &[LECTURE][..]),
    ] {
        let mut window = window("fundamental", size, keys);
        click(&mut window, &["Lessons", "Pushing on trapped air"]);
        if name == "lesson-dark" {
            still(&mut window);
            window.snapshot("lesson-hold");
        }
        for _ in 0..2 {
            window.key_press(Key::PageDown);
            settle(&mut window);
        }
        still(&mut window);
        if name != "lesson-lecture" {
            click(&mut window, &["More than double", "This is my prediction"]);
        }
        if name == "lesson-small-light" {
            click(&mut window, &["Give me a hint", "One more hint", "Show me"]);
        }
        still(&mut window);
        compare(&mut results, &mut window, name);
    }
    let mut window = window("fundamental", USUAL, &[]);
    click(&mut window, &["Lessons", "Why the mean force"]);
    for _ in 0..2 {
        window.key_press(Key::PageDown);
        settle(&mut window);
    }
    still(&mut window);
    window.snapshot("lesson-formula");
    click(&mut window, &["Leave", "Help", "Take the tour", "Next"]);
    still(&mut window);
    window.snapshot("tour");
    click(&mut window, &["Skip the tour", "Help", "Glossary"]);
    window.get_by_role_and_label(Role::TextInput, "Search").type_text("squeeze");
    still(&mut window);
    compare(&mut results, &mut window, "glossary");
}
