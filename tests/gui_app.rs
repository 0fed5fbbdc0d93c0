//! The window through its real application, without a display.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod window;

use eframe::egui::accesskit::Role;
use eframe::egui::epaint::{Primitive, Shape};
use eframe::egui::{Event, Key, Modifiers, PointerButton, Vec2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use squeezefilm::analysis::attempt::RunStatus;
use squeezefilm::analysis::tradeoff::{Candidate, Effort, candidates};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::app::App;
use squeezefilm::gui::command::Command;
use squeezefilm::gui::state::dialogs::{Answer, Purpose};
use squeezefilm::gui::state::document::{Document, Next};
use squeezefilm::gui::state::modal::Modal;
use squeezefilm::gui::state::view::Tab;
use squeezefilm::gui::update::platform::{DialogStart, Platform};
use squeezefilm::job::SolvedScene;
use squeezefilm::problem::Problem;
use squeezefilm::scene::{Scene, Value, presets};
use squeezefilm::solution::{Outcome, StoppedBy};
use std::collections::HashSet;
use std::time::Duration;
use window::{
    Memory, User, Window, answer, await_path, drop_file, has_torque, left, measured, once_solved, open, reopen, solved,
    until,
};

fn window(preset: &str) -> Window {
    window_asking(preset, |_, _| Answer::Cancelled)
}

/// A window whose file dialogs are answered by `ask`: a test never opens a real one.
fn window_asking(preset: &str, ask: fn(Purpose, &DialogStart) -> Answer) -> Window {
    window_in(preset, 900.0, Platform { ask, ..Platform::default() })
}

fn window_in(preset: &str, height: f32, platform: Platform) -> Window {
    window::preset(preset, height, platform)
}

fn alpha(run: Option<&SolvedScene>) -> f64 {
    match run.unwrap().solution.outcome {
        Outcome::Motor(result) => result.alpha.value,
        Outcome::Plate(_) => panic!("a motor"),
    }
}

fn spacing(app: &App) -> Value {
    app.state().document.scene().get("film.min_spacing_nm").unwrap()
}

#[test]
fn it_opens_solved_and_moves_smoothly_between_recorded_frames() {
    let mut window = once_solved(window("fundamental"));
    assert!((alpha(window.known().run.as_deref()) - 0.24586).abs() < 1e-4);
    let before = window.known().view.phase;
    let mut between = 0;
    for _ in 0..10 {
        std::thread::sleep(Duration::from_millis(5));
        window.step();
        let state = window.known();
        let place = state.view.place(&state.run.as_deref().unwrap().solution.recording);
        between += usize::from(place.fract() > 0.0);
    }
    assert!(between > 5, "{between} of 10 redraws are between two frames");
    assert_ne!(window.known().view.phase, before);
}

#[test]
fn play_step_and_scrub_by_key_and_button() {
    let mut window = once_solved(window("fundamental"));
    window.click_on("Pause");
    assert!(!window.known().view.playing);
    let frames = window.known().run.as_deref().unwrap().solution.recording.frames;
    let place = |window: &Window| {
        let app = window.state();
        app.state().view.place(&app.state().run.as_deref().unwrap().solution.recording)
    };
    window.press(Key::Home);
    assert_eq!(place(&window), 0.0);
    window.press(Key::ArrowLeft);
    assert_eq!(place(&window), (frames - 1) as f64);
    window.key_press(Key::ArrowRight);
    window.press(Key::ArrowRight);
    assert_eq!(place(&window), 1.0);
    window.press(Key::CloseBracket);
    assert_eq!(window.known().view.tooth, 1);
    // A tap, within one frame.
    let at = window.get_by_role_and_label(Role::Slider, "Time in the cycle").rect().center();
    window.event(Event::PointerMoved(at));
    window.step();
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        window.input_mut().events.push(Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    window.run_steps(3);
    assert!((place(&window) - 0.5 * frames as f64).abs() < 0.5, "{} of {frames}", place(&window));
    window.press(Key::Space);
    assert!(window.known().view.playing);
}

#[test]
fn without_a_file_dialog_the_path_is_typed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("typed.toml");
    let mut window = window_asking("fundamental", |_, _| Answer::NoDialog);
    let type_path = |window: &mut Window, text: &str| {
        window.step();
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.get_by_role_and_label(Role::TextInput, "Path").type_text(text);
        window.step();
    };
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    await_path(&mut window);
    window.get_by_label("Save the preset");
    // What has no extension gets its own.
    type_path(&mut window, folder.path().join("typed").to_str().unwrap());
    window.press(Key::Enter);
    assert_eq!(window.known().document.path(), Some(path.as_path()));
    assert!(window.shows(&format!("Wrote {}", path.display())) && Scene::load(&path).is_ok());

    // Where nothing can be saved the prompt stays, with the path and the reason, and what was to come after still comes.
    window.state_mut().carry_out(Command::DiscardThen(Next::Preset("fundamental")));
    edit_spacing(&mut window, "80");
    window.state_mut().carry_out(Command::Proceed(Next::Preset("asperities")));
    window.run_steps(3);
    window.click_on("Save");
    await_path(&mut window);
    let nowhere = folder.path().join("absent").join("kept.toml");
    type_path(&mut window, nowhere.to_str().unwrap());
    window.press(Key::Enter);
    window.get_by_label_contains("there is no folder");
    let Some(Modal::Path(prompt)) = &window.known().modal else { panic!("the prompt is gone") };
    assert_eq!(prompt.path, nowhere.to_str().unwrap());
    type_path(&mut window, folder.path().join("kept.toml").to_str().unwrap());
    window.step();
    assert!(window.query_by_label_contains("there is no folder").is_none(), "of another path");
    window.press(Key::Enter);
    assert!(window.known().modal.is_none() && folder.path().join("kept.toml").is_file());
    assert_eq!(window.known().document.scene().name, presets::find("asperities").unwrap().name);
    window.state_mut().carry_out(Command::Chosen(Purpose::Open, path.clone()));
    window.run_steps(3);

    // What is there already is not replaced by Enter, only by the button that says so.
    let other = folder.path().join("other.toml");
    std::fs::write(&other, "not a preset").unwrap();
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    await_path(&mut window);
    type_path(&mut window, other.to_str().unwrap());
    window.get_by_label("There is such a file already");
    window.press(Key::Enter);
    assert_eq!(std::fs::read_to_string(&other).unwrap(), "not a preset");
    window.click_on("Replace");
    assert!(Scene::load(&other).is_ok());

    // Opening: a bad file is explained, a good one is opened.
    std::fs::write(&other, "not a preset").unwrap();
    edit_spacing(&mut window, "90");
    window.ctrl(Key::S);
    window.click_on("Replace it");
    for (file, good) in [("absent.toml", false), ("typed.toml", true)] {
        window.key_press_modifiers(Modifiers::COMMAND, Key::O);
        await_path(&mut window);
        window.get_by_label("Open a preset");
        // The path that could not be opened is there to be mended.
        let Some(Modal::Path(prompt)) = &window.known().modal else { panic!("no path is asked for") };
        assert_eq!(prompt.path.ends_with("absent.toml"), good, "{}", prompt.path);
        type_path(&mut window, folder.path().join(file).to_str().unwrap());
        window.press(Key::Enter);
        assert_eq!(window.query_by_label("This did not work").is_none(), good, "{file}");
        window.press(Key::Escape);
    }
    assert_eq!(window.known().document.path(), Some(path.as_path()));
    assert_eq!(spacing(window.state()), Value::Number(200.0));
}

#[test]
fn a_table_of_the_rotor_is_opened_by_the_dialog_and_told_at_its_field_if_it_is_refused() {
    fn ask(purpose: Purpose, _: &DialogStart) -> Answer {
        match purpose {
            Purpose::Csv("rotor.compliance_csv") => Answer::Path("absent.csv".into()),
            _ => Answer::NoDialog,
        }
    }
    let mut window = window_asking("fundamental", ask);
    let key = "rotor.compliance_csv";
    window.state_mut().carry_out(Command::Ask(Purpose::Csv(key)));
    until(&mut window, "it is refused", |app| app.state().rejected.of(key).is_some());
    assert!(window.known().rejected.of(key).is_some_and(|why| why.matches("absent.csv").count() == 1));
    // The refusal has opened its group.
    window.get_by_label("Open: Compliance from a CSV file");
    // Without a dialog the path is typed.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("green.csv");
    std::fs::write(&path, "x_mm,deflection_um_per_n\n0,0.6\n1,0.5\n").unwrap();
    window.state_mut().carry_out(Command::Ask(Purpose::Csv("rotor.green_csv")));
    answer(&mut window, &path);
    assert_eq!(window.known().document.scene().get("rotor.model"), Some(Value::Text("green".into())));
}

#[test]
fn a_path_that_cannot_be_read_is_offered_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("absent.csv");
    let mut window = window_asking("fundamental", |_, _| Answer::NoDialog);
    let csv = Purpose::Csv("rotor.compliance_csv");
    for purpose in [Purpose::Measurements, Purpose::Heights, csv.clone(), Purpose::Lessons] {
        window.state_mut().carry_out(Command::Chosen(purpose.clone(), path.clone()));
        until(&mut window, "it is refused", |app| app.state().failed_path.is_some());
        window.state_mut().carry_out(Command::CloseModal);
        window.state_mut().carry_out(Command::Ask(purpose));
        await_path(&mut window);
        let Some(Modal::Path(prompt)) = &window.known().modal else { panic!("no path is asked for") };
        assert_eq!(prompt.path, path.to_str().unwrap());
        window.state_mut().carry_out(Command::CloseModal);
    }
    // The scene may have changed before the dialog was answered: there is no field at which to tell it.
    window.state_mut().carry_out(Command::Proceed(Next::Preset("plate-crossover")));
    window.state_mut().carry_out(Command::Chosen(csv, path));
    assert!(matches!(&window.known().modal, Some(Modal::Error(why)) if why.contains("rotor.compliance_csv")));
}

#[test]
fn a_refusal_goes_with_its_cause() {
    let mut window = window("fundamental");
    let (radius, viscosity) = ("motor.contact_radius_mm", "film.viscosity_upa_s");
    let reason = |window: &Window, key: &str| window.known().rejected.of(key).map(str::to_owned);
    window.state_mut().carry_out(Command::SetText(viscosity, "0".to_owned()));
    window.type_into("Contact radius in mm", "5");
    window.get_by_label_contains("of the tooth pitch");
    // A little narrower: other numbers in the reason. Much narrower: no reason left.
    let before = reason(&window, radius);
    window.type_into("Tooth width in mm", "1");
    assert!(before.is_some() && reason(&window, radius).is_some_and(|reason| Some(reason) != before));
    window.type_into("Tooth width in mm", "0.3");
    assert!(window.query_by_label_contains("of the tooth pitch").is_none());
    assert_eq!(reason(&window, radius), None);
    assert!(reason(&window, viscosity).is_some(), "that one is out of range whatever else holds");
    assert_eq!(window.known().document.scene().get("motor.contact_radius_mm"), Some(Value::Number(29.0)));
}

#[test]
fn the_views_can_have_the_whole_window() {
    let mut window = once_solved(window("fundamental"));
    let label = "Minimum spacing H_m";
    assert!(window.query_all_by_label(label).next().is_some());
    for key in [Key::F2, Key::F3] {
        window.key_press(key);
    }
    window.run_steps(2);
    assert!(window.query_all_by_label(label).next().is_none());
    assert!(window.query_by_label("share of the load carried by air").is_none());
    window.press(Key::F2);
    assert!(window.query_all_by_label(label).next().is_some());
}

#[test]
fn a_preset_of_the_menu_is_opened_and_solved() {
    let mut window = once_solved(window("fundamental"));
    window.click_on("Presets");
    let name = presets::find("levitating").unwrap().name;
    window.click_part(&name);
    assert_eq!(window.known().document.scene().name, name);
    solved(&mut window);
    assert!((alpha(window.known().run.as_deref()) - 1.0).abs() < 1e-5);
    // A plate has no rotor to show.
    window.ctrl(Key::Num8);
    assert_eq!(window.known().view.tab, Tab::Rotor);
    window.click_on("Presets");
    let name = presets::find("floating-finger-pad").unwrap().name;
    window.click_part(&name);
    assert_eq!((window.known().document.scene().name.as_str(), window.known().view.tab), (name.as_str(), Tab::Motion));
}

/// What a form for a new motor needs.
const DATA_SHEET: [(&str, &str); 3] =
    [("Outer diameter of the stator, mm", "60"), ("Frequency, kHz", "40"), ("Axial load on the rotor, N", "150")];

#[test]
fn enter_makes_a_new_motor_once_its_form_is_complete() {
    let mut window = window("fundamental");
    window.state_mut().carry_out(Command::NewMotor);
    window.run_steps(10);
    for (field, text) in DATA_SHEET {
        window.get_by_label("Make this motor");
        window.type_into(field, text);
    }
    until(&mut window, "the new motor", |app| {
        app.state().document.scene().get("motor.load_n") == Some(Value::Number(150.0))
    });
}

#[test]
fn a_new_motor_is_made_of_the_answers_of_a_data_sheet() {
    let mut window = once_solved(window("fundamental"));
    window.click_on("File");
    window.run_steps(5);
    window.click_part("New motor…");
    window.run_steps(5);
    let make = |window: &Window| window.get_by_label("Make this motor").accesskit_node().is_disabled();
    assert!(make(&window));
    for (field, text) in DATA_SHEET {
        window.type_over(Role::TextInput, field, text);
        window.run_steps(5);
    }
    window.get_by_label_contains("Assumed: Minimum spacing H_m 200 nm: as in the motor of Maeno and Bogy");
    // The one behind it, of the scene, has another gas.
    let mut gases = window.query_all_by_role_and_label(Role::ComboBox, "Gas").map(|list| list.accesskit_node().value());
    let air = gases.any(|gas| gas.as_deref() == Some("Air"));
    drop(gases);
    assert!(air);
    assert!(!make(&window));
    window.get_by_label("Make this motor").click();
    until(&mut window, "the new motor", |app| {
        app.state().document.scene().get("motor.load_n") == Some(Value::Number(150.0))
    });
    let document = &window.known().document;
    assert!(document.is_dirty() && document.path().is_none() && document.scene().name == "My motor");
    assert!(window.known().modal.is_none());
    // What it was made as is what its parameters are reset to.
    assert!(!window.shows("Reset "));
    window.type_into("Frequency in kHz", "41");
    window.click_on("Reset frequency");
    let frequency = |window: &Window| window.known().document.scene().get("stator.frequency_khz");
    assert_eq!(frequency(&window), Some(Value::Number(40.0)));
    // It stays unsaved after a crash.
    let memory = left(&mut window);
    drop(window);
    let window = reopen(memory, 900.0, Platform::default());
    let document = &window.known().document;
    assert!(document.is_dirty() && frequency(&window) == Some(Value::Number(40.0)));
    assert!(!window.shows("Reset "));
}

#[test]
fn an_error_keeps_the_dialog_below_it() {
    let mut window = window("fundamental");
    window.state_mut().carry_out(Command::NewMotor);
    window.run_steps(2);
    window.get_by_label("Make this motor");
    // Something that went on in the background fails meanwhile, twice.
    for file in ["absent.toml", "missing.toml"] {
        window.state_mut().carry_out(Command::Chosen(Purpose::Open, file.into()));
    }
    window.run_steps(2);
    window.get_by_label_contains("missing.toml");
    window.click_on("Close");
    window.get_by_label("Make this motor");
    window.press(Key::Escape);
    assert!(window.known().modal.is_none());
}

#[test]
fn a_dropped_preset_is_opened_and_unsaved_changes_are_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let mut scene = presets::find("fundamental").unwrap();
    scene.name = "Mine".to_owned();
    scene.set("film.min_spacing_nm", "150").unwrap();
    scene.save(&path).unwrap();
    let mut window = window("fundamental");
    drop_file(&mut window, path.clone());
    assert_eq!(spacing(window.state()), Value::Number(150.0));
    assert_eq!(window.known().document.path(), Some(path.as_path()));
    assert!(!window.known().document.is_dirty());

    // An edit, undone and redone by the keyboard, then a file over it: the question, and "Cancel" keeps everything.
    edit_spacing(&mut window, "120");
    assert_eq!(spacing(window.state()), Value::Number(120.0));
    assert!(window.known().document.is_dirty());
    window.ctrl(Key::Z);
    assert_eq!(spacing(window.state()), Value::Number(150.0));
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(spacing(window.state()), Value::Number(120.0));
    drop_file(&mut window, path.clone());
    window.get_by_label_contains("Save the changes");
    window.click_on("Keep editing");
    assert_eq!(spacing(window.state()), Value::Number(120.0));

    // Saved by the keyboard, the file holds the edit.
    window.ctrl(Key::S);
    assert!(!window.known().document.is_dirty());
    assert_eq!(&Scene::load(&path).unwrap(), window.known().document.scene());

    // The same file again: what the question has saved is shown, not what the file held before.
    window.state_mut().carry_out(Command::SetText("film.min_spacing_nm", "170".to_owned()));
    drop_file(&mut window, path.clone());
    window.click_on("Save");
    assert_eq!(spacing(window.state()), Value::Number(170.0));
    assert_eq!(&Scene::load(&path).unwrap(), window.known().document.scene());
}

/// Types a minimum spacing.
fn edit_spacing(window: &mut Window, text: &str) {
    window.type_into("Minimum spacing H_m in nm", text);
}

/// Presses the keys of a tab.
fn show(window: &mut Window, tab: Tab) {
    let keys = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7];
    let place = Tab::ALL.iter().position(|(other, _)| *other == tab).unwrap();
    window.key_press_modifiers(Modifiers::COMMAND, keys[place]);
}

#[test]
fn an_edit_is_solved_again_and_the_headline_follows() {
    let mut window = once_solved(window("fundamental"));
    window.get_by_label_contains("0.2458");
    edit_spacing(&mut window, "100");
    solved(&mut window);
    assert!((alpha(window.known().run.as_deref()) - 0.4988).abs() < 1e-3);
    window.step();
    window.get_by_label_contains("0.4987");
    // What is out of range is refused in place; nothing changes.
    edit_spacing(&mut window, "3");
    window.get_by_label_contains("allowed 5 to 10000 nm");
    assert_eq!(spacing(window.state()), Value::Number(100.0));
}

#[test]
fn nothing_is_redrawn_while_nothing_moves() {
    let mut window = once_solved(window("fundamental"));
    window.key_press(Key::Space);
    for _ in 0..10 {
        window.step();
    }
    let delay = |window: &Window| {
        window.output().viewport_output.values().map(|viewport| viewport.repaint_delay).min().unwrap()
    };
    // But for the frame in which what was done is written away.
    assert!((Duration::from_secs(1)..Duration::from_secs(3)).contains(&delay(&window)), "{:?}", delay(&window));
    eframe::App::save(window.state_mut(), &mut Memory::default());
    window.step();
    assert!(delay(&window) > Duration::from_secs(3), "{:?}", delay(&window));
    window.press(Key::Space);
    assert!(delay(&window) < Duration::from_millis(50), "{:?}", delay(&window));
}

/// Software renderers take their time for every pixel that is painted.
#[test]
fn a_redraw_paints_the_ground_once_and_less_than_the_window_besides() {
    for preset in ["fundamental", "plate-trapped"] {
        let window = once_solved(window(preset));
        let whole = window.ctx.content_rect();
        let ground = window.ctx.global_style().visuals.panel_fill;
        let grounds = window.output().shapes.iter().filter(|shape| match &shape.shape {
            Shape::Rect(rect) => rect.fill == ground && rect.rect.area() > 0.01 * whole.area(),
            _ => false,
        });
        // OpenGL clears with it: then it is not painted at all.
        assert_eq!(grounds.count(), 1, "{preset}");
        let (mut painted, mut vertices) = (0.0, 0);
        for clipped in window.ctx.tessellate(window.output().shapes.clone(), 1.0) {
            let Primitive::Mesh(mesh) = clipped.primitive else { continue };
            vertices += mesh.vertices.len();
            for triangle in mesh.indices.chunks_exact(3) {
                let [a, b, c] = [0, 1, 2].map(|i| mesh.vertices[triangle[i] as usize].pos);
                painted += 0.5 * ((b - a).x * (c - a).y - (b - a).y * (c - a).x).abs();
            }
        }
        let windows = painted / whole.area() - 1.0;
        assert!(windows < 1.0, "{preset}: {windows} windows without the ground");
        assert!(vertices < 30_000, "{preset}: {vertices} vertices");
    }
}

#[test]
fn unsaved_work_survives_a_crash() {
    let mut window = window("tooth-radius-3m");
    edit_spacing(&mut window, "123");
    let memory = left(&mut window);
    drop(window);
    let window = reopen(memory, 700.0, Platform::default());
    let document = &window.known().document;
    assert_eq!(spacing(window.state()), Value::Number(123.0));
    assert_eq!(document.scene().get("stator.tooth_radius_m"), Some(Value::Number(3.0)));
    assert!(document.is_dirty());
}

#[test]
fn a_window_left_with_a_scene_too_large_for_memory_opens_and_says_so() {
    let large = [
        ("numerics.film_nodes_along", "2001"),
        ("numerics.film_nodes_across", "501"),
        ("numerics.steps_per_cycle", "100000"),
        ("numerics.teeth", "all"),
    ];
    let mut scene = presets::find("fundamental").unwrap();
    scene.set_all(large).unwrap();
    let mut first = open(Document::opened(scene, None), 900.0, Platform::default());
    until(&mut first, "the refusal", |app| app.state().activity.failure.is_some());
    let memory = left(&mut first);
    drop(first);
    let mut window = reopen(memory, 900.0, Platform::default());
    until(&mut window, "the refusal", |app| {
        app.state().activity.failure.is_some() && app.state().activity.running.is_none()
    });
    let steps = window.known().document.scene().get("numerics.steps_per_cycle");
    assert_eq!(steps, Some(Value::Whole(100_000)));
    window.step();
    window.get_by_label_contains("2001 × 505 film nodes on 9 teeth and 100008 steps a cycle need");
    window.get_by_label_contains("allow more with --memory");
}

#[test]
fn the_sheet_of_shortcuts_opens_and_closes() {
    let mut window = once_solved(window("plate-crossover"));
    // What explains a slider under the pointer does not stay above it.
    let explained = |window: &Window| window.query_by_label_contains("plate.frequency_khz").is_some();
    window.get_by_role_and_label(Role::Slider, "Frequency").hover();
    window.run_steps(120);
    assert!(explained(&window));
    window.press(Key::F1);
    window.get_by_label("Keyboard shortcuts");
    window.get_by_label("Ctrl+0");
    assert!(!explained(&window));
    window.press(Key::Escape);
    assert!(window.query_by_label("Keyboard shortcuts").is_none());
}

#[test]
fn a_scene_that_is_opened_is_shown_from_its_beginning() {
    let mut window = once_solved(window_in("fundamental", 600.0, Platform::default()));
    let tops = |window: &Window| ["Main", "Regime"].map(|label| window.get_by_label(label).rect().top());
    let before = tops(&window);
    window.get_by_label("Film").scroll_to_me();
    window.get_by_label("How it was solved").scroll_to_me();
    window.run_steps(20);
    let scrolled = tops(&window);
    assert!(scrolled[0] < before[0] - 50.0 && scrolled[1] < before[1] - 50.0, "{before:?} {scrolled:?}");
    window.state_mut().carry_out(Command::Proceed(Next::Preset("doubled-mesh")));
    window.run_steps(3);
    // Its description has another number of lines.
    assert!((tops(&window)[0] - before[0]).abs() < 40.0);
    assert!(tops(&window)[1] > scrolled[1] + 50.0);
}

#[test]
fn every_built_in_preset_can_be_shown() {
    for preset in presets::BUILT_IN {
        if preset.name == "doubled-mesh" {
            continue;
        }
        let mut window = window(preset.name);
        until(&mut window, preset.name, |app| app.state().run.as_deref().is_some());
        for _ in 0..3 {
            window.step();
        }
    }
}

/// A window tall enough for all results.
fn tall_window(measure: fn(&Problem) -> (Vec<Candidate>, Effort)) -> Window {
    let platform = Platform { ask: |_, _| Answer::NoDialog, measure, ..Platform::default() };
    window_in("fundamental", 1600.0, platform)
}

/// Draft and standard, twice each.
fn little(problem: &Problem) -> (Vec<Candidate>, Effort) {
    let mut few = candidates(problem);
    few.retain(|candidate| ["draft", "standard"].contains(&candidate.name.as_str()));
    (few, Effort { repeats: Some(2), ..Effort::default() })
}

/// More than anyone waits for.
fn endless(problem: &Problem) -> (Vec<Candidate>, Effort) {
    let (few, effort) = little(problem);
    (few, Effort { repeats: Some(1_000_000), ..effort })
}

#[test]
fn a_term_is_switched_and_the_window_says_what_it_changed() {
    let key = "numerics.wedge";
    let mut window = once_solved(tall_window(little));
    let decision = |app: &App| {
        let decisions = &app.state().run.as_deref().unwrap().solution.model.decisions;
        *decisions.iter().find(|decision| decision.key() == Some(key)).unwrap()
    };
    let other = if decision(window.state()).value() == "off" { "Solved" } else { "Left out" };
    window.open_list("Wedge term");
    let before = window.known().activity.number;
    window.click_on(other);
    assert!(window.known().activity.number > before, "it is solved anew at once");
    assert!(window.known().document.can_undo());
    solved(&mut window);
    let change = window.known().switches.effect().unwrap();
    assert_eq!((change.key, change.fidelity), (key, Fidelity::Fine));
    assert!(change.before != change.after && change.bound > 0.0 && change.held(), "{change:?}");
    window.get_by_label("Wedge term switched");
    window.get_by_label_contains("stated bound");
    assert!(decision(window.state()).overruled);
    window.get_by_label("Overruled");

    // One click and it is the plan's again, bit for bit what it was; an edit of something else ends the comparison.
    window.click_on("Wedge term back to auto");
    assert_eq!(window.known().document.scene().get(key), Some(Value::Text("auto".to_owned())));
    solved(&mut window);
    assert!(window.query_by_label("Overruled").is_none());
    edit_spacing(&mut window, "150");
    assert!(window.query_by_label("Wedge term switched").is_none());
}

#[test]
fn tabs_are_changed_by_the_keyboard_and_the_timeline_is_the_motions() {
    let mut window = once_solved(window("fundamental"));
    window.get_by_label("Pause");
    show(&mut window, Tab::Tradeoff);
    window.run_steps(3);
    assert_eq!(window.known().view.tab, Tab::Tradeoff);
    assert!(window.query_by_label("Pause").is_none() && window.query_by_label("Time in the cycle").is_none());
    assert!(window.known().tradeoff.as_ref().is_none(), "nothing is measured before it is asked for");
    let phase = window.known().view.phase;
    window.key_press(Key::Space);
    std::thread::sleep(Duration::from_millis(30));
    window.run_steps(3);
    assert!(window.known().view.playing && window.known().view.phase == phase);
    window.ctrl(Key::Num1);
    assert_eq!(window.known().view.tab, Tab::Motion);
    window.get_by_label("Pause");
}

#[test]
fn what_the_keyboard_goes_to_is_scrolled_into_sight() {
    let mut window = window_in("fundamental", 500.0, Platform { ask: |_, _| Answer::Cancelled, ..Platform::default() });
    solved(&mut window);
    let mut reached = HashSet::new();
    for _ in 0..60 {
        window.press(Key::Tab);
        let at = window.ctx.memory(|memory| memory.focused()).and_then(|id| window.ctx.read_response(id));
        let Some(at) = at else { continue };
        assert!(at.interact_rect.contains(at.rect.center()), "{:?} shows {:?}", at.rect, at.interact_rect);
        reached.insert(at.id);
    }
    assert!(reached.len() > 30, "{} controls", reached.len());
    // In a table that can be scrolled sideways, too.
    window.ctrl(Key::Num9);
    window.click_on("Compute sensitivities");
    until(&mut window, "sensitivities", |app| app.state().sensitivity.found.is_some());
    let field = |window: &Window| window.get_by_label("Uncertainty of Mean free path").rect();
    assert!(field(&window).center().y > 500.0);
    window.get_by_label("Uncertainty of Mean free path").focus();
    window.run_steps(5);
    assert!(field(&window).center().y < 500.0, "{:?}", field(&window));
}

#[test]
fn a_lit_button_shows_that_the_keyboard_is_at_it() {
    let mut window = window("plate-crossover");
    solved(&mut window);
    window.ctrl(Key::Num5);
    let outlined = |window: &Window| {
        let (place, line) =
            (window.get_by_label("Measure").rect(), window.ctx.global_style().visuals.widgets.active.bg_stroke);
        window.output().shapes.iter().any(|shape| match &shape.shape {
            Shape::Rect(rect) => place.contains(rect.rect.center()) && rect.stroke == line,
            _ => false,
        })
    };
    assert!(!outlined(&window));
    window.get_by_label("Measure").focus();
    window.run_steps(3);
    assert!(outlined(&window));
}

#[test]
fn error_against_time_is_measured_and_a_setting_is_used() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = once_solved(tall_window(little));
    show(&mut window, Tab::Tradeoff);
    window.run_steps(2);
    window.click_on("Measure");
    until(&mut window, "the measurement ends", measured);
    let points = &window.known().tradeoff.as_ref().unwrap().tradeoff.points;
    let names: Vec<&str> = points.iter().map(|point| point.run.candidate.name.as_str()).collect();
    assert_eq!(names, ["draft", "standard", "present setting"]);
    assert!(points.iter().all(|point| point.run.status == RunStatus::Converged && point.error.is_some()));

    // The cheapest that serves is used, which is one edit.
    let aim = |window: &Window| window.known().document.target();
    assert_eq!(aim(&window), Fidelity::Fine);
    window.type_over(Role::SpinButton, "Accuracy", "30");
    window.press(Key::Enter);
    assert!((window.known().view.accuracy - 0.3).abs() < 1e-12);
    window.click_on("Use it for the accuracy");
    assert!(aim(&window) < Fidelity::Fine);
    until(&mut window, "solved as asked", |app| {
        let number = app.state().activity.number;
        app.state()
            .run
            .as_deref()
            .is_some_and(|run| run.number == number && run.fidelity == app.state().document.target())
    });
    window.ctrl(Key::Z);
    assert_eq!(aim(&window), Fidelity::Fine);

    // The table and the figure, as the command line writes them.
    for (button, file, begins) in [("Export CSV…", "t.csv", "setting,family"), ("Export figure…", "t.svg", "<")] {
        let path = folder.path().join(file);
        window.get_by_label(button).click();
        answer(&mut window, &path);
        until(&mut window, "written", |app| app.state().exports.written.is_some());
        assert!(std::fs::read_to_string(&path).unwrap().starts_with(begins), "{file}");
    }

    // Another scene: what was measured is not of it.
    assert!(window.query_by_label_contains("before the scene changed").is_none());
    edit_spacing(&mut window, "150");
    window.get_by_label_contains("before the scene changed");
}

#[test]
fn a_measurement_is_cancelled_by_its_button_and_by_closing_the_window() {
    let mut window = tall_window(endless);
    show(&mut window, Tab::Tradeoff);
    window.run_steps(2);
    window.click_on("Measure");
    until(&mut window, "points appear", |app| {
        app.state()
            .tradeoff
            .as_ref()
            .is_some_and(|measured| measured.tradeoff.points.iter().any(|point| point.median.is_finite()))
    });
    window.click_on("Cancel the measurement");
    until(&mut window, "it ends", measured);
    window.get_by_label_contains("Cancelled");
    // What was measured stays, another can begin, and the window does not wait for it.
    window.click_on("Measure");
    assert!(window.known().tradeoff.as_ref().unwrap().work.running());
    drop(window);
}

#[test]
fn torque_over_speed_is_computed_when_its_tab_is_shown_and_follows_edits() {
    let mut window = once_solved(tall_window(little));
    assert!(window.known().torque.found().is_none(), "nothing is computed for a tab that is not shown");
    show(&mut window, Tab::Torque);
    window.run_steps(2);
    until(&mut window, "torque over speed", has_torque);
    let merit = |window: &Window| window.known().torque.found().unwrap().as_ref().unwrap().clone();
    let before = merit(&window);
    for name in ["Torque of the ring, N·m", "Power, W", "Efficiency, %"] {
        window.get_by_role_and_label(Role::Image, name);
    }
    // The results beside it lead with the stall torque, too.
    for name in ["Stall torque", "No-load speed", "Greatest power", "Greatest efficiency", "With film", "Without film"]
    {
        assert!(window.get_all_by_label(name).count() >= 1, "{name}");
    }
    window.get_by_label_contains("A model without film needs the friction coefficient 0.527");
    window.get_by_label("Point at a chart to read its values");
    window.get_by_role_and_label(Role::Image, "Power, W").hover();
    window.run_steps(3);
    window.get_by_label_contains("rpm: with film");

    // The film carries more under smoother faces, and the curve falls.
    edit_spacing(&mut window, "100");
    solved(&mut window);
    until(&mut window, "torque of the edited scene", has_torque);
    let after = merit(&window);
    assert!(after.with_film.stall_torque.value < 0.8 * before.with_film.stall_torque.value);
    assert_eq!(after.without_film.max_torque, before.without_film.max_torque);
    // Back in the motion nothing more is computed.
    show(&mut window, Tab::Motion);
    edit_spacing(&mut window, "150");
    solved(&mut window);
    assert!(!has_torque(window.state()));
    show(&mut window, Tab::Torque);
    until(&mut window, "torque once more", has_torque);
    // Both columns of the table are within a narrow tab.
    window.set_size(vec2(1024.0, 1600.0));
    window.run_steps(4);
    let edge = window.get_by_label("share of the load carried by air").rect().left() - 4.0;
    let speeds = window.get_all_by_label_contains(" ± ").map(|number| number.rect());
    let speeds: Vec<_> = speeds.filter(|number| number.left() < edge).collect();
    assert!(speeds.len() > 4 && speeds.iter().all(|number| number.right() <= edge), "{edge}: {speeds:?}");
}

#[test]
fn a_floating_rotor_and_a_still_stator_have_a_torque_tab_too() {
    let mut window = once_solved(window("levitating"));
    show(&mut window, Tab::Torque);
    window.run_steps(2);
    until(&mut window, "torque over speed", has_torque);
    assert!(window.query_all_by_label("none").next().is_some());
    window.type_into("Tangential amplitude in µm", "0");
    solved(&mut window);
    until(&mut window, "torque over speed", has_torque);
    window.get_by_label_contains("it drives nothing");
}

#[test]
fn a_plate_has_exact_results_in_place_of_torque() {
    for preset in ["plate-crossover", "plate-viscous", "plate-trapped"] {
        let mut window = once_solved(window(preset));
        window.get_by_label("Exact");
        assert!(window.query_by_label("Torque").is_none());
        show(&mut window, Tab::Torque);
        window.run_steps(3);
        for name in ["Spring and damping against the squeeze number", "Load over the cycle and its limits"] {
            window.get_by_role_and_label(Role::Image, name);
        }
        let dynamic = ["Dynamic stiffness, N/m²", "Dynamic damping, N·s/m²"];
        for name in ["Spring S", "Damping D", "Invariant, off by"].into_iter().chain(dynamic) {
            window.get_by_label(name);
        }
        // Formulae that are set, in plain text.
        for formula in ["κ^2 = (iσ)/Q", "⟨P⟩ = √(", "= ⟨H^3/2 + 6mH^2⟩"] {
            window.get_by_label_contains(formula);
        }
        assert!(window.known().torque.found().is_none());
    }
}

#[test]
fn an_accuracy_is_typed_in_place_of_a_name() {
    let mut window = once_solved(window("plate-crossover"));
    let type_in = |window: &mut Window, text: &str| into_target(window, "Accuracy", text);
    type_in(&mut window, "0,7 %");
    let asked = Fidelity::to(0.007);
    assert_eq!(window.known().document.target(), asked);
    until(&mut window, "it is solved for", |app| app.state().run.as_deref().is_some_and(|run| run.fidelity == asked));
    window.get_by_label("0.7%");
    type_in(&mut window, "70%");
    window.get_by_label_contains("a relative error from 0.0001% to 50%");
    assert_eq!(window.known().document.target(), asked);
}

/// Types into a field of the list of fidelities, and presses Enter.
fn into_target(window: &mut Window, field: &str, text: &str) {
    if window.query_by_role_and_label(Role::TextInput, field).is_none() {
        window.open_list("Solved up to");
    }
    window.get_by_role_and_label(Role::TextInput, field).focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.key_press(Key::Delete);
    window.get_by_role_and_label(Role::TextInput, field).type_text(text);
    window.run_steps(2);
    window.press(Key::Enter);
}

#[test]
fn a_solve_takes_no_longer_than_was_allowed() {
    let mut window = once_solved(window("plate-crossover"));
    into_target(&mut window, "Accuracy", "0.0001%");
    // So short that the coarsest grids are all there is time for.
    into_target(&mut window, "Time for a solve", "0,1 ms");
    assert_eq!(window.known().budget, Some(Duration::from_micros(100)));
    let list = window.get_by_role_and_label(Role::ComboBox, "Solved up to");
    assert_eq!(list.accesskit_node().value().as_deref(), Some("0.0001%, within 100µs"));
    let asked = Fidelity::to(1e-6);
    until(&mut window, "the best within the time is shown", |app| {
        let run = app.state().run.as_deref();
        run.is_some_and(|run| {
            run.number == app.state().activity.number
                && run.fidelity == asked
                && run.solution.accuracy.stopped_by == StoppedBy::Budget
        })
    });
    let within = &window.known().run.as_deref().unwrap().solution;
    assert!(within.accuracy.stated > 1e-6 && within.stats.film_steps < 1000, "{:?}", within.stats);
    window.get_by_label("The time allowed was up before the error was as small as asked for");
    into_target(&mut window, "Time for a solve", "soon");
    window.get_by_label_contains("soon has none of the units µs, ms, s, min and h");
    assert_eq!(window.known().budget, Some(Duration::from_micros(100)));
    window.press(Key::Escape);
    into_target(&mut window, "Accuracy", "2%");
    into_target(&mut window, "Time for a solve", "");
    assert_eq!(window.known().budget, None);
    until(&mut window, "it is solved for as long as it takes", |app| {
        app.state().run.as_deref().is_some_and(|run| run.solution.accuracy.stopped_by == StoppedBy::Accuracy)
    });
}

#[test]
fn light_and_dark_leave_the_zoom_alone() {
    let mut window = once_solved(window("plate-crossover"));
    window.ctx.set_zoom_factor(1.2);
    window.run_steps(2);
    for (key, zoom) in [(Key::T, 1.2), (Key::L, 1.2 * 1.35), (Key::T, 1.2 * 1.35), (Key::L, 1.2)] {
        window.ctrl(key);
        assert!((window.ctx.zoom_factor() - zoom).abs() < 1e-4, "{key:?}: {}", window.ctx.zoom_factor());
    }
}

#[test]
fn panels_are_as_wide_again_as_before_the_window_was_small() {
    let mut window = once_solved(window("fundamental"));
    let width = |window: &Window| window.get_by_role_and_label(Role::Slider, "Minimum spacing H_m").rect().width();
    let before = width(&window);
    window.set_size(Vec2::new(800.0, 600.0));
    window.run_steps(4);
    assert!(width(&window) < before);
    // On a telephone that lies on its side half of it is the middle's.
    window.set_size(Vec2::new(844.0, 390.0));
    window.run_steps(4);
    let left = window.get_by_role_and_label(Role::Button, "Motion").rect();
    let right = window.get_by_label_contains("Converged").rect();
    assert!(right.left() - left.left() > 422.0, "{left} {right}");
    window.set_size(Vec2::new(1400.0, 900.0));
    window.run_steps(4);
    assert_eq!(width(&window), before);
}

#[test]
fn panels_are_as_wide_after_lecture_size_as_before() {
    let mut window = once_solved(window("fundamental"));
    let edge = |window: &Window| window.get_by_label("share of the load carried by air").rect().left();
    let zoom = |window: &mut Window, zoom: f32| {
        window.ctx.set_zoom_factor(zoom);
        window.set_size(vec2(1024.0, 700.0) / zoom);
        window.run_steps(4);
    };
    zoom(&mut window, 1.0);
    let before = edge(&window);
    // A real window is still drawn once as large as before, when the size has already been asked for.
    for (lecture, size) in [(true, 1.35), (false, 1.0)] {
        window.state_mut().updater.state.lecture = lecture;
        window.step();
        zoom(&mut window, size);
    }
    assert!((edge(&window) - before).abs() < 1.0, "{before} {}", edge(&window));
}

#[test]
fn what_pins_is_beside_the_labels_or_below_them() {
    let mut window = once_solved(window("fundamental"));
    for width in [1024.0, 1240.0, 1260.0, 1280.0, 1300.0, 1400.0] {
        window.set_size(Vec2::new(width, 800.0));
        window.run_steps(4);
        let [pin, fit] = ["Pin", "Fit"].map(|label| window.get_by_role_and_label(Role::Button, label).rect());
        assert!(!pin.intersects(fit), "{width}: {pin} is over {fit}");
    }
}

#[test]
fn a_key_without_effect_on_a_plate_is_read_and_not_set() {
    let mut window = once_solved(window_in("plate-crossover", 2400.0, Platform::default()));
    window.get_by_label("Film").click();
    window.run_steps(10);
    let disabled = |name: &str| {
        let slider = window.get_by_role_and_label(Role::Slider, name);
        slider.accesskit_node().is_disabled()
    };
    assert!(disabled("Minimum spacing H_m") && !disabled("Ambient pressure"));
}

#[test]
fn the_first_drag_of_a_main_slider_goes_on_while_its_value_changes() {
    for name in ["Minimum spacing H_m", "Frequency"] {
        let mut window = once_solved(window("fundamental"));
        let slider = window.get_by_role_and_label(Role::Slider, name).rect();
        let at = |share: f32| slider.left_center() + vec2(share * slider.width(), 0.0);
        let key = if name == "Frequency" { "stator.frequency_khz" } else { "film.min_spacing_nm" };
        let value = |window: &Window| window.known().document.scene().get(key).unwrap().as_number().unwrap();
        let mut last = value(&window);
        window.hover_at(at(0.7));
        window.drag_at(at(0.7));
        window.step();
        for share in [0.75, 0.8, 0.85, 0.9] {
            window.hover_at(at(share));
            window.run_steps(2);
            let now = value(&window);
            assert!(now > last, "{name} at {share}: {now} after {last}");
            last = now;
        }
        window.drop_at(at(0.9));
    }
}

#[test]
fn a_number_that_was_entered_is_typed_over_after_another_click() {
    let mut window = once_solved(window("fundamental"));
    const FIELD: &str = "Minimum spacing H_m in nm";
    window.type_into(FIELD, "150");
    for digits in ["25", "30"] {
        let at = window.get_by_role_and_label(Role::TextInput, FIELD).rect().center();
        window.hover_at(at);
        window.drag_at(at);
        window.drop_at(at);
        window.step();
        for digit in digits.chars() {
            window.event(eframe::egui::Event::Text(digit.to_string()));
            window.step();
        }
        window.press(Key::Enter);
        assert_eq!(spacing(window.state()).to_string(), digits, "no digit is lost, and none of the last number stays");
    }
}
