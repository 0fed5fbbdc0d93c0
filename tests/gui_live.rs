//! What is computed while the user looks: the start-up from rest, and the plate that is held. The real window, without a display.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod window;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, vec2};
use egui_kittest::kittest::Queryable;
use squeezefilm::analysis::quantity::Numbers;
use squeezefilm::gui::app::App;
use squeezefilm::gui::command::Command;
use squeezefilm::gui::state::dialogs::Answer;
use squeezefilm::gui::state::document::{Document, Next};
use squeezefilm::gui::state::hold::HoldState;
use squeezefilm::gui::state::startup::StartupState;
use squeezefilm::gui::state::view::Tab;
use squeezefilm::gui::update::platform::Platform;
use squeezefilm::hold::Reading;
use squeezefilm::problem::Scenario;
use squeezefilm::scene::presets;
use squeezefilm::solution::Status;
use std::time::Duration;
use window::{User, Window, once_solved, until};

const STARTUP: Key = Key::Num6;
const HOLD: Key = Key::Num7;

fn window(preset: &str, tab: Key) -> Window {
    let mut window = window::preset(preset, 900.0, Platform { ask: |_, _| Answer::Cancelled, ..Platform::default() });
    window.ctrl(tab);
    window
}

fn starting(app: &App) -> &StartupState {
    app.state().startup.as_ref().unwrap()
}

fn cycles(app: &App) -> usize {
    app.state().startup.as_ref().map_or(0, |starting| starting.points.len())
}

/// The last cycle agrees with the periodic solve: within both estimated errors, and what the trapped gas may still change,
/// times the force of that gas.
fn agrees(app: &App) {
    let last = starting(app).points.last().unwrap();
    let ours = last.numbers.main();
    let run = app.state().run.as_deref().unwrap();
    let periodic = Numbers::of_outcome(&run.problem, &run.solution.outcome).main();
    let ambient = match &run.problem.scenario {
        Scenario::Motor(motor) => {
            let area = motor.contact_width * motor.tooth_width * motor.teeth as f64;
            motor.gas.ambient_pressure * area / motor.load
        }
        // Its load ratio is a share of just that force.
        Scenario::Plate(_) => 1.0,
    };
    let going_on = last.remaining.unwrap() * (ambient + periodic.value.abs());
    assert!(
        (ours.value - periodic.value).abs() < ours.error + periodic.error + going_on,
        "{ours}, {periodic}, still {going_on}"
    );
}

#[test]
fn a_motor_starts_from_rest_and_comes_to_its_periodic_state() {
    let mut window = once_solved(window("fundamental", STARTUP));
    assert!(window.known().startup.is_none(), "nothing is computed before it is asked for");
    assert!(window.query_by_label("Pause").is_none());
    window.click_on("Start from rest");
    until(&mut window, "a cycle arrives", |app| cycles(app) >= 1);
    let first = starting(window.state()).points[0].numbers.main().value;
    until(&mut window, "it repeats", |app| starting(app).transient.ended.is_some());
    assert_eq!(starting(window.state()).transient.ended.as_ref().unwrap().as_ref().unwrap().status, Status::Converged);
    window.get_by_label_contains("repeats within");
    agrees(window.state());
    // It is not the bar of a plate that would be dropped.
    let (own, other) = (window.known().document.scene().clone(), presets::find("floating-disc").unwrap());
    assert!(window.known().on_timeline().is_some());
    for (scene, there) in [(other, false), (own, true)] {
        window.state_mut().carry_out(Command::Proceed(Next::Given(Box::new(Document::opened(scene, None)))));
        window.run_steps(2);
        assert_eq!(window.known().on_timeline().is_some(), there);
    }
    // Every tooth, and from rest: the first cycle carries less than the last.
    let app = window.state();
    let run = starting(app).run().unwrap();
    assert_eq!(run.solution.recording.stored_teeth, run.solution.recording.teeth);
    let recording = &run.solution.recording;
    assert!(recording.transient);
    assert_eq!(recording.other_pressure.len(), (recording.teeth - 1) * recording.pressure.len());
    assert!(first < 0.9 * starting(app).points.last().unwrap().numbers.main().value);
    assert_eq!(starting(app).chosen, cycles(app));

    // A cycle is looked at by a click, then the cycles are played one after the other.
    let plot = window.get_by_label_contains("α against the cycle: click").rect();
    window.hover_at(plot.left_center() + vec2(4.0, 0.0));
    window.drag_at(plot.left_center() + vec2(4.0, 0.0));
    window.step();
    window.drop_at(plot.left_center() + vec2(4.0, 0.0));
    window.run_steps(2);
    assert_eq!(starting(window.state()).chosen, 1);
    window.get_by_label_contains("Shown is cycle 1:");
    window.get_by_role_and_label(Role::Slider, "Speed").click();
    window.run_steps(3);
    window.click_part("one cycle in 0.5 s");
    window.click_on("Play from rest");
    until(&mut window, "the third cycle is played", |app| starting(app).chosen == 3);
    window.click_on("Follow the newest cycle");
    assert_eq!(starting(window.state()).chosen, cycles(window.state()));
}

#[test]
fn an_edit_ends_it_and_marks_it_stale_and_a_button_cancels_it() {
    // Its steps are short, so that a start-up does not end before the click that cancels it.
    let mut window = window("doubled-mesh", STARTUP);
    window.click_on("Start from rest");
    until(&mut window, "a cycle arrives", |app| cycles(app) >= 1);
    window.type_into("Minimum spacing H_m in nm", "150");
    window.get_by_label_contains("before the scene changed; start again");
    until(&mut window, "it has ended", |app| !starting(app).transient.work.running());

    window.click_on("Start from rest");
    assert!(window.query_by_label_contains("before the scene changed; start again").is_none());
    until(&mut window, "a cycle arrives", |app| cycles(app) >= 1);
    window.click_on("Cancel the start-up");
    until(&mut window, "it has ended", |app| !starting(app).transient.work.running());
    window.get_by_label_contains("Cancelled after cycle");
    // The scene that it was started on was an edited one, the present one is not.
    window.ctrl(Key::Z);
    window.get_by_label_contains("minimum spacing H_m 150 nm” before the scene changed; start again");
    // One that goes on does not keep the window open.
    window.click_on("Start from rest");
    drop(window);
}

#[test]
fn a_plate_starts_from_rest_too() {
    let mut window = once_solved(window("plate-crossover", STARTUP));
    window.click_on("Start from rest");
    until(&mut window, "it repeats", |app| starting(app).transient.ended.is_some());
    window.get_by_label_contains("repeats within");
    window.get_by_label_contains("load ratio");
    window.get_by_label_contains("film load over p_a × length, against the cycle: click");
    // (That of a plate at standard is half of what a finer grid shows.)
    agrees(window.state());
    let kept = starting(window.state()).kept().count();
    assert_eq!(kept, cycles(window.state()), "a plate's recordings are small");
}

fn held(app: &App) -> &HoldState {
    app.state().hold.as_ref().unwrap()
}

fn ratio(app: &App) -> f64 {
    held(app).now.reading.ratio
}

fn gap(app: &App) -> f64 {
    held(app).now.reading.gap / held(app).plate.mean_gap
}

fn at_rest(window: &mut Window) {
    until(window, "the film is at rest", |app| ratio(app).abs() < 2e-4);
    let number = |window: &Window| held(window.state()).now.number;
    for _ in 0..200 {
        let before = number(window);
        std::thread::sleep(Duration::from_millis(200));
        window.run_steps(2);
        if number(window) == before {
            return;
        }
    }
    panic!("its thread does not sleep");
}

#[test]
fn a_motor_cannot_be_held_but_a_plate_is_offered() {
    let mut window = window("fundamental", HOLD);
    assert!(window.known().hold.is_none());
    window.get_by_label_contains("Only a plate can be held");
    window.click_on("Open the plate at its crossover");
    assert_eq!(window.known().view.tab, Tab::Hold);
    assert!(window.known().hold.is_some());
    window.get_by_label_contains("slowed 6");
}

#[test]
fn a_dragged_plate_pushes_back_then_lets_its_gas_go() {
    let mut window = once_solved(window("plate-crossover", HOLD));
    let rect = window.get_by_label("Held plate: drag it up and down").rect();
    let begin = rect.center();
    window.hover_at(begin);
    window.drag_at(begin);
    window.step();
    // Beside it are its own numbers, not those of the vibrating plate.
    window.get_by_label_contains("The plate at this moment");
    window.get_by_label("Since it was at rest");
    assert!(window.query_by_label("mean load of the film over the cycle").is_none());
    // A tenth of the drawing is about four tenths of the mean gap.
    for i in 1_u8..=8 {
        window.hover_at(begin + vec2(0.0, 0.0125 * f32::from(i) * rect.height()));
        window.step();
    }
    until(&mut window, "it pushes back", |app| ratio(app) > 0.2);
    let app = window.state();
    assert!(gap(app) < 0.9 && held(app).target < 0.8 * held(app).plate.mean_gap);
    // Held there, the pressure falls though nothing moves.
    until(&mut window, "it relaxes", |app| ratio(app) < 0.02);
    let kept = gap(window.state());
    window.drop_at(begin + vec2(0.0, 0.1 * rect.height()));
    at_rest(&mut window);
    assert!((gap(window.state()) - kept).abs() < 1e-3, "it stays where the hand left it");
    // At rest nothing is computed, and nothing is drawn again.
    let number = held(window.state()).now.number;
    std::thread::sleep(Duration::from_millis(200));
    window.run();
    assert_eq!(held(window.state()).now.number, number);

    // Let go, it flies back and sucks.
    window.click_on("Let go");
    until(&mut window, "it sucks", |app| ratio(app) < -0.05);
    until(&mut window, "it is back", |app| (gap(app) - 1.0).abs() < 1e-3);
    window.click_on("Reset");
    until(&mut window, "it is at rest", |app| held(app).now.reading.time == 0.0);
    assert_eq!(ratio(window.state()), 0.0);
}

/// What is read off the held plate now, and as it is shown.
fn readings(window: &Window) -> [Reading; 2] {
    let hold = held(window.state());
    [hold.now.reading, hold.shown().reading]
}

/// Some redraws, in which a held plate that goes on would have gone on.
fn wait(window: &mut Window) {
    for _ in 0..10 {
        std::thread::sleep(Duration::from_millis(20));
        window.run_steps(2);
    }
}

#[test]
fn a_plate_that_was_let_go_is_paused_goes_on_from_there_and_is_replayed() {
    let mut window = once_solved(window("floating-disc", HOLD));
    window.get_by_role_and_label(Role::Slider, "Recorded time");
    for _ in 0..12 {
        window.press(Key::ArrowDown);
    }
    until(&mut window, "it is pushed down", |app| gap(app) < 0.45);
    window.click_on("Let go");
    until(&mut window, "it rises", |app| gap(app) > 0.5 && held(app).trail().len() > 30);

    window.key_press(Key::Space);
    wait(&mut window);
    window.get_by_label("Play");
    window.get_by_label("paused");
    let [paused, _] = readings(&window);
    wait(&mut window);
    assert_eq!(readings(&window), [paused; 2], "nothing goes on");

    // Back to what was recorded, and step by step.
    window.press(Key::Home);
    let [now, first] = readings(&window);
    assert_eq!(now, paused);
    let recorded: Vec<Reading> = held(window.state()).trail().copied().collect();
    assert!(recorded.len() > 30 && first == recorded[0], "{first:?}");
    window.get_by_label_contains(" ago");
    window.press(Key::ArrowRight);
    assert_eq!(readings(&window), [paused, recorded[1]]);
    window.press(Key::ArrowLeft);
    assert_eq!(readings(&window), [paused, first]);

    // Played to its end, it is paused where it was.
    window.click_on("Replay");
    until(&mut window, "it is played", |app| {
        let shown = held(app).shown().reading.time;
        shown > recorded[5].time && shown < paused.time
    });
    window.get_by_label("Pause");
    until(&mut window, "it is played to the end", |app| !held(app).playing);
    assert_eq!(readings(&window), [paused; 2]);
    window.get_by_label("paused");

    // It goes on from there: neither held nor at rest, and no time is missed.
    window.click_on("Play");
    until(&mut window, "it goes on", |app| held(app).now.reading.time > paused.time);
    window.get_by_label("Stop");
    let hold = held(window.state());
    let next = hold.trail().find(|reading| reading.time > paused.time).unwrap();
    // The first reading is 20 ms of the clock later, however long it was paused.
    assert!((next.time - paused.time) * hold.slowed() < 0.0201, "{next:?} after {paused:?}");
    assert!((next.gap / paused.gap - 1.0).abs() < 0.15, "{next:?} after {paused:?}");

    // A hand that takes it is not kept waiting.
    window.key_press(Key::Space);
    wait(&mut window);
    window.key_press(Key::ArrowDown);
    until(&mut window, "it follows the hand", |app| held(app).playing);
    until(&mut window, "it is there", |app| (held(app).now.reading.gap / held(app).target - 1.0).abs() < 1e-3);
}

#[test]
fn the_charts_begin_at_rest() {
    let mut window = window("plate-trapped", HOLD);
    for _ in 0..8 {
        window.key_press(Key::ArrowDown);
        window.step();
    }
    until(&mut window, "it is pushed down", |app| gap(app) < 0.62);
    let first = held(window.state()).trail().next().unwrap();
    assert_eq!((first.time, first.gap, first.force), (0.0, held(window.state()).plate.mean_gap, 0.0));
}

#[test]
fn numbers_and_pressure_of_a_plate_let_go_are_of_one_instant() {
    let mut window = once_solved(window("floating-disc", HOLD));
    window.click_on("Let go");
    until(&mut window, "it floats", |app| held(app).trail().len() > 60);
    window.key_press(Key::Space);
    wait(&mut window);
    for _ in 0..40 {
        let shown = held(window.state()).shown();
        let highest = shown.pressure.iter().copied().fold(0.0, f64::max);
        let lowest = shown.pressure.iter().copied().fold(f64::INFINITY, f64::min);
        let Reading { mean_pressure: mean, error, .. } = shown.reading;
        // The mean is extrapolated.
        let off = 3.0 * error / held(window.state()).plate.area();
        assert!(lowest <= mean + off && mean <= highest + off, "{lowest} {mean} {highest}");
        window.press(Key::ArrowLeft);
    }
}

#[test]
fn a_plate_under_a_load_is_let_go_stops_and_is_dropped() {
    let mut window = once_solved(window("floating-disc", HOLD));
    window.get_by_label("Load / (p_a · area)");
    window.click_on("Let go");
    until(&mut window, "it floats by itself", |app| held(app).now.reading.time > 1e-4);
    assert!(gap(window.state()) > 0.9);
    window.click_on("Stop");
    until(&mut window, "it sinks", |app| gap(app) < 0.8);
    window.click_on("Vibrate");
    until(&mut window, "it rises", |app| gap(app) > 0.85);
    window.get_by_label("Stop");
    // In the start-up it falls from twice that height.
    window.ctrl(Key::Num6);
    window.click_on("Drop it");
    until(&mut window, "it falls", |app| app.state().dropped.as_ref().is_some_and(|dropped| dropped.cycles.len() > 60));
    let dropped = window.known().dropped.as_ref().unwrap();
    let heights: Vec<f64> = dropped.cycles.iter().map(|cycle| cycle.height.value).collect();
    assert!(heights[0] > 9.9e-6 && heights[60] < 0.8 * heights[0], "{heights:?}");
    window.run_steps(2);
    assert!(window.known().dropped.as_ref().unwrap().work.running());
    window.get_by_label_contains("does not shake, gives 4.96");
    window.get_by_role_and_label(Role::Image, "Height of the plate over time");
    window.click_on("Cancel");
    until(&mut window, "it ends", |app| app.state().dropped.as_ref().is_some_and(|dropped| !dropped.work.running()));
    window.get_by_label_contains("Cancelled at");
    window.get_by_label("Drop it");
}

#[test]
fn a_plate_that_its_face_throws_up_says_so_and_is_not_taken_in_the_hand() {
    // Its reach ends at no round number of nanometres.
    let scene = presets::find("floating-disc").unwrap().with([("plate.mass_g", "4000")]).unwrap();
    let mut window = window::open(Document::opened(scene, None), 900.0, Platform::default());
    window.ctrl(HOLD);
    until(&mut window, "it is held", |app| app.state().hold.is_some());
    window.get_by_label_contains("It does not float: its mean gap");
    window.click_on("Let go");
    until(&mut window, "it is above the slider", |app| gap(app) > 3.5);
    for _ in 0..20 {
        window.run_steps(1);
        assert!(held(window.state()).free.is_some());
    }
    window.get_by_label_contains("has struck the plate");
}

#[test]
fn keys_and_slider_move_it_within_its_reach_only() {
    let mut window = window("plate-crossover", HOLD);
    for _ in 0..4 {
        window.press(Key::ArrowDown);
    }
    until(&mut window, "it is lower", |app| (gap(app) - 0.8).abs() < 1e-3);
    assert!(ratio(window.state()) > 0.01);
    window.press(Key::ArrowUp);
    until(&mut window, "it is higher", |app| (gap(app) - 0.85).abs() < 1e-3);
    for _ in 0..60 {
        window.press(Key::ArrowUp);
    }
    until(&mut window, "it is as high as it goes", |app| (gap(app) - 3.0).abs() < 1e-3);
    window.get_by_role_and_label(Role::Slider, "Gap");
    window.get_by_role_and_label(Role::Slider, "Leak time takes");
    // Elsewhere the same keys do nothing to it.
    window.ctrl(Key::Num1);
    window.press(Key::ArrowDown);
    assert!((held(window.state()).target / held(window.state()).plate.mean_gap - 3.0).abs() < 1e-9);
}
