//! Lessons, tour and glossary through the real application, as a student meets them, without a display.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod window;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use squeezefilm::analysis::quantity::{Numbers, Quantity};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::app::App;
use squeezefilm::gui::command::{Command, LessonCommand};
use squeezefilm::gui::derived::words as labels;
use squeezefilm::gui::state::dialogs::Answer;
use squeezefilm::gui::state::lessons::{LessonState, PLACES, window_names};
use squeezefilm::gui::state::link::Link;
use squeezefilm::gui::state::running_lesson::RunningLesson;
use squeezefilm::gui::state::tour;
use squeezefilm::gui::state::view::Tab;
use squeezefilm::gui::state::window::State;
use squeezefilm::gui::update::platform::Platform;
use squeezefilm::job::SolvedScene;
use squeezefilm::lessons::live::Live;
use squeezefilm::lessons::work::{Score, Stage, StepWork};
use squeezefilm::lessons::{self, Act, Doing, Lesson, LessonError, Prediction, Question, QuestionKind, Step, text};
use squeezefilm::scene::{Parameter, ParameterKind, Scene, Value, presets};
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};
use window::{Memory, User, Window, answer, drop_file, left, reopen, until};

fn platform() -> Platform {
    Platform { ask: |_, _| Answer::NoDialog, ..Platform::default() }
}

/// A window tall enough that nothing has to be scrolled.
fn window(preset: &str) -> Window {
    window::preset(preset, 1700.0, platform())
}

/// A window that was there before, or never, and opens no file.
fn window_with(memory: Memory) -> Window {
    reopen(memory, 1700.0, platform())
}

/// Until the scene on the table is solved well enough to judge by.
fn solved(window: &mut Window) {
    until(window, "the scene on screen is solved", |app| {
        app.state()
            .run
            .as_deref()
            .is_some_and(|run| run.scene == *app.state().document.scene() && run.fidelity >= Fidelity::Standard)
    });
}

/// Opens a lesson from the menu.
fn open(window: &mut Window, title: &str) {
    window.click_on("Lessons");
    window.get_by_label_contains(title).click();
    window.run_steps(20);
    assert!(window.known().lessons.running.is_some(), "{title}");
}

fn step(window: &Window) -> (usize, Step) {
    let state = window.known();
    (running(state).step, state.lessons.step().unwrap().1.clone())
}

fn running(state: &State) -> &RunningLesson {
    state.lessons.running.as_ref().unwrap()
}

fn work(window: &Window) -> StepWork {
    work_in(window.known()).clone()
}

fn work_in(state: &State) -> &StepWork {
    &running(state).work[running(state).step]
}

/// Changes a parameter as a student does: types a number, or chooses a name.
fn change(window: &mut Window, key: &str, value: &str) {
    let parameter = Parameter::find(key).unwrap();
    match parameter.kind {
        ParameterKind::Choice { .. } => {
            window.open_list(labels::label(parameter));
            window.click_on(&labels::choice(key, value));
        }
        _ => {
            if window.known().document.scene().get(key).is_none() {
                window.click_on(parameter.switch);
            }
            window.type_into(&labels::field_name(parameter), value);
        }
    }
    let set = window.known().document.scene().get(key).unwrap();
    assert_eq!(set.to_string().trim_matches('"'), value, "{key}");
}

/// Drags the held plate to a gap \[µm\], in a few frames.
fn drag_plate(window: &mut Window, gap: f64) {
    let rect = window.get_by_label("Held plate: drag it up and down").rect();
    let holding = window.known().hold.as_ref().unwrap();
    let (from, reach) = (holding.now.reading.gap * 1e6, holding.reach()[1] * 1e6);
    // Its reach is seven tenths of the drawing.
    let way = 0.7 * rect.height() * ((from - gap) / reach) as f32;
    let begin = rect.center();
    window.hover_at(begin);
    window.drag_at(begin);
    window.step();
    for i in 1_u8..=4 {
        window.hover_at(begin + vec2(0.0, 0.25 * f32::from(i) * way));
        window.step();
    }
    window.drop_at(begin + vec2(0.0, way));
    let target = gap / reach;
    until(window, "the plate is there", |app| {
        let now = app.state().hold.as_ref().unwrap().now.reading.gap * 1e6;
        (now / reach - target).abs() < 0.02
    });
}

/// Does what is said, by hand, and waits until all of its results are there.
fn act(window: &mut Window, doing: &Doing) {
    for (key, value) in &doing.changes {
        change(window, key, value);
    }
    solved(window);
    for act in &doing.acts {
        match act {
            Act::Hold(gap) => drag_plate(window, *gap),
            Act::StartUp => {
                window.click_on("Start from rest");
                until(window, "the start-up ends", |app| {
                    app.state().startup.as_ref().is_some_and(|starting| starting.transient.ended.is_some())
                });
            }
        }
    }
    read_off(window);
}

/// Until the torque over speed of the run is known, if its tab is shown.
fn read_off(window: &mut Window) {
    until(window, "the curves over speed", |app| {
        let plate = app.state().document.scene().scene() == "plate";
        plate
            || app.state().view.tab != Tab::Torque
            || app.state().run.as_deref().is_some_and(|run| app.state().torque.of(run).is_some())
    });
}

/// Text of the first block, with the numbers of the run as the window shows them.
fn first_line(window: &Window, blocks: &[text::Block], told: bool) -> String {
    let state = window.known();
    let quoted = |reading: &_| state.lessons.quoted(reading, state.document.scene(), told);
    match &blocks[0] {
        text::Block::Paragraph(parts) | text::Block::Item(parts) => text::plain(&text::filled(parts, &quoted)),
        other => text::plain_blocks(std::slice::from_ref(other)),
    }
}

fn stage(window: &Window) -> Stage {
    work(window).stage(&step(window).1)
}

fn radio(window: &mut Window, choice: &lessons::Choice) {
    window.get_all_by_role_and_label(Role::RadioButton, &text::plain(&choice.text)).last().unwrap().click();
    window.run_steps(3);
}

/// Goes on by so many steps, whatever is still to be done in them.
fn go_on(window: &mut Window, steps: usize) {
    for _ in 0..steps {
        window.press(Key::PageDown);
    }
}

/// A window in which this lesson is open, so many steps on.
fn at(title: &str, steps: usize) -> Window {
    let mut window = window("fundamental");
    open(&mut window, title);
    go_on(&mut window, steps);
    window
}

/// The step on screen, once its scene is solved and its question answered.
fn predicted(window: &mut Window) -> Step {
    let (_, step) = step(window);
    solved(window);
    predict(window, &step);
    step
}

/// The window of whoever closes it and opens it again.
fn restarted(mut window: Window) -> Window {
    let memory = left(&mut window);
    drop(window);
    window_with(memory)
}

/// Asks for all hints, and then to be shown how.
fn show_me(window: &mut Window) {
    for button in ["Give me a hint", "One more hint", "Show me"] {
        window.click_on(button);
    }
}

/// Answers the question of the step: the answer must not be seen before.
fn predict(window: &mut Window, step: &Step) {
    let Some(question) = &step.question else { return };
    let why = first_line(window, &question.why, true);
    let button = if question.kind == QuestionKind::Calculate { "This is my result" } else { "This is my prediction" };
    assert!(!window.shows(&why) && !window.shows("Your turn"), "{}: shown before the prediction", step.title);
    let disabled = window.get_by_label(button).accesskit_node().is_disabled();
    assert!(disabled, "{}: nothing is predicted yet", step.title);
    match &question.answer {
        lessons::Answer::Choice { choices, right } => {
            // First another one: a prediction may be changed until it is made.
            for choice in [(right + 1) % choices.len(), *right] {
                radio(window, &choices[choice]);
                assert_eq!(work(window).prediction, Some(Prediction::Choice(choice)), "{}", step.title);
            }
        }
        lessons::Answer::Number { value, .. } => {
            // A calculation that is wrong is not told: it has a second try.
            calculate(window, 7.0 * value);
            window.click_on(button);
            assert!(!work(window).committed && work(window).wrong == 1 && window.shows("Not quite"), "{}", step.title);
            assert!(!window.shows(&why), "{}: told after the first try", step.title);
            // The same number again is no second try.
            window.press(Key::Enter);
            assert!(!work(window).committed && work(window).wrong == 1, "{}", step.title);
            calculate(window, *value);
        }
    }
    assert!(!window.shows(&why), "{}: shown before the prediction was made", step.title);
    window.click_on(button);
    assert!(work(window).committed);
    let why = first_line(window, &question.why, true);
    assert_eq!(window.shows(&why), step.task.is_none(), "{}: the answer comes after the trial", step.title);
}

/// Types a number into the field of a calculation.
fn calculate(window: &mut Window, value: f64) {
    window.type_over(Role::SpinButton, "Your number", &value.to_string());
    window.press(Key::Enter);
    let Some(Prediction::Number(given)) = work(window).prediction else { panic!("no number was given") };
    assert!((given - value).abs() < 1e-6);
}

/// Says what was seen: first something else, which is told to be wrong.
fn look(window: &mut Window, observe: &Question, title: &str) {
    assert!(window.shows("What did you see?"), "{title}");
    assert_eq!(stage(window), Stage::Observation, "{title}: nothing is told before it was looked at");
    let lessons::Answer::Choice { choices, right } = &observe.answer else { panic!("{title}: it has choices") };
    radio(window, &choices[(right + 1) % choices.len()]);
    assert!(stage(window) == Stage::Observation && window.shows("not what your run shows"), "{title}");
    radio(window, &choices[*right]);
    assert_eq!((stage(window), work(window).misread), (Stage::Told, 1), "{title}");
}

/// Walks a lesson: at each task first what does not do, then what does.
fn walk(lesson: usize) {
    let mut window = window("fundamental");
    let title = window.known().lessons.lessons[lesson].title.clone();
    let before = window.known().document.scene().clone();
    open(&mut window, &title);
    let steps = window.known().lessons.lessons[lesson].steps.len();
    for number in 0..steps {
        let (at, step) = step(&window);
        assert_eq!(at, number);
        window.get_by_label(&step.title);
        assert_eq!(window.known().document.scene(), &step.scene, "{}", step.title);
        solved(&mut window);
        read_off(&mut window);
        window.run_steps(2);
        for block in &step.body {
            let text = first_line(&window, std::slice::from_ref(block), false);
            assert!(window.query_all_by_label(&text).next().is_some(), "{}: {text}", step.title);
            assert!(!text.contains('…'), "{}: a number is not known: {text}", step.title);
        }
        predict(&mut window, &step);
        if let Some(task) = &step.task {
            let name = &step.title;
            assert!(window.shows("Your turn"), "{name}");
            solved(&mut window);
            read_off(&mut window);
            assert!(!work(&window).fulfilled, "{name}: done before anything was done");
            assert!(!task.wrong.is_empty() && !task.example.is_empty(), "{name}");
            act(&mut window, &task.wrong);
            assert!(!work(&window).fulfilled, "{name}: the wrong thing does it");
            assert!(window.shows("Not yet."), "{name}");
            // Help comes on request, one hint after the other; only then is the task shown.
            assert_eq!(task.hints.len(), 2, "{name}");
            for (asked, button) in ["Give me a hint", "One more hint"].into_iter().enumerate() {
                let hint = first_line(&window, &task.hints[asked], false);
                assert!(!window.shows(&hint) && !window.shows("Show me"), "{name}");
                window.click_on(button);
                assert!(window.shows(&hint), "{name}");
            }
            window.get_by_label("Show me");
            window.click_on("Start over");
            solved(&mut window);
            assert_eq!(window.known().document.scene(), &step.scene, "{name}");
            if step.tab.as_deref() == Some("Hold") {
                until(&mut window, "the plate is at rest again", |app| {
                    app.state().hold.as_ref().is_some_and(|holding| holding.now.reading.time == 0.0)
                });
            }
            let started = step.tab.as_deref() == Some("Start-up") && window.known().startup.as_ref().is_some();
            assert!(!started, "{name}: nothing is started yet");
            // What does it, by hand; gas needs time to leave.
            act(&mut window, &task.example);
            if !task.example.acts.is_empty() {
                until(&mut window, name, |app| work_in(app.state()).fulfilled);
            }
            assert!(work(&window).fulfilled, "{name}: {:?}", work(&window).unmet);
            assert!(window.shows("✔ Done"), "{name}");
            // Every number that is quoted from here on is known.
            for reading in text::readings(step.after_task()) {
                assert!(work(&window).readings.contains_key(&reading.source), "{name}: {}", reading.source);
            }
            if let Some(observe) = &step.observe {
                look(&mut window, observe, name);
            }
            if let Some(question) = &step.question {
                let why = first_line(&window, &question.why, true);
                let title = if question.kind == QuestionKind::Calculate { "✔ Right" } else { "As you expected" };
                assert!(window.shows(&why) && window.shows(title), "{name}");
            }
        }
        assert_eq!(stage(&window), Stage::Told);
        window.click_on(if number + 1 == steps { "Finish" } else { "Next" });
        window.run_steps(20);
    }
    // The recap: everything was right but the first looks.
    let lesson_state = &window.known().lessons;
    let (running, followed) = (running(window.known()), &lesson_state.lessons[lesson]);
    assert_eq!(running.step, steps);
    let score = Score::of(followed.steps.iter().zip(&running.work));
    assert_eq!((score.observations[0], score.skipped[0]), (0, 0));
    let [points, all] = score.points();
    assert_eq!(points, all - score.observations[1]);
    assert!(window.shows(&format!("{points} of {all} points")) && lesson_state.progress(followed).done);
    window.click_on("Close");
    window.run_steps(20);
    solved(&mut window);
    let app = window.state();
    assert!(app.state().lessons.running.is_none() && app.state().document.scene() == &before);
    assert!(app.state().lessons.progress(&app.state().lessons.lessons[lesson]).done);
    window.get_by_label("share of the load carried by air");
}

macro_rules! walks {
    ($($name:ident: $lesson:literal),* $(,)?) => {
        $(#[test] fn $name() { walk($lesson); })*
        const WALKED: usize = [$($lesson),*].len();
    };
}

walks![
    trapped_air_to_its_end: 0,
    air_that_leaves_to_its_end: 1,
    squeeze_number_to_its_end: 2,
    mean_force_to_its_end: 3,
    thin_gaps_to_its_end: 4,
    travelling_wave_to_its_end: 5,
    contact_and_air_to_its_end: 6,
    lost_torque_to_its_end: 7,
    floating_to_its_end: 8,
    accelerometers_to_their_end: 9,
];

/// The lessons in a folder, and what is wrong with others.
fn load(folder: &Path) -> (Vec<Lesson>, Vec<LessonError>) {
    window_names(|known| lessons::load(folder, known))
}

#[test]
fn every_built_in_lesson_is_read_listed_and_walked() {
    let (read, faults) = window_names(lessons::built_in);
    assert!(faults.is_empty(), "{faults:?}");
    assert_eq!((read.len(), WALKED), (lessons::BUILT_IN.len(), lessons::BUILT_IN.len()));
    assert!(read.len() >= 10);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lessons");
    let (from_disk, faults) = load(&folder);
    assert!(faults.is_empty(), "{faults:?}");
    assert_eq!(from_disk, read, "built in are all that are there, in the order of their names");
    for lesson in &read {
        assert!((4..=7).contains(&lesson.steps.len()) && !lesson.about.is_empty(), "{}", lesson.title);
        assert!(lesson.steps.iter().any(|step| step.question.is_some() && step.task.is_some()), "{}", lesson.title);
    }
}

#[test]
fn what_is_lit_is_seen_and_its_group_opens() {
    let mut window = window("fundamental");
    assert!(window.query_by_role_and_label(Role::ComboBox, "Slip at the walls").is_none(), "the group is closed");
    open(&mut window, "Thin gaps and slip");
    for _ in 0..2 {
        go_on(&mut window, 1);
        window.run_steps(20);
    }
    window.get_by_role_and_label(Role::ComboBox, "Slip at the walls");
    // The tab that a lesson needs comes forward, and goes back after it.
    window.press(Key::F3);
    assert!(!window.shows("Lesson ·"));
    window.press(Key::PageDown);
    assert!(window.shows("Lesson ·"), "a new step is seen");
    assert_eq!(step(&window).0, 3);
    window.press(Key::PageUp);
    assert_eq!(step(&window).0, 2);
    // All results, and back to the lesson.
    window.click_on("All results");
    assert!(window.shows("Squeeze number σ") && !window.shows("Lesson ·"));
    window.click_on("Back to the lesson");
    assert!(window.shows("Lesson ·"));
}

#[test]
fn leaving_brings_the_students_scene_back_with_its_history() {
    let mut window = window("tooth-radius-3m");
    solved(&mut window);
    window.type_into("Minimum spacing H_m in nm", "123");
    let own = window.known().document.scene().clone();
    open(&mut window, "The squeeze number");
    assert_ne!(window.known().document.scene(), &own);
    window.type_into("Frequency in kHz", "3");
    assert!(!window.known().document.is_dirty(), "what a lesson lends is never unsaved");
    go_on(&mut window, 1);
    window.click_on("Leave");
    assert_eq!(window.known().document.scene(), &own);
    assert!(window.known().document.is_dirty());
    window.ctrl(Key::Z);
    assert_eq!(window.known().document.scene().get("film.min_spacing_nm"), Some(Value::Number(200.0)));
    assert!(!window.known().document.is_dirty());
}

#[test]
fn unsaved_changes_are_asked_about_from_within_a_lesson_too() {
    let mut window = window("fundamental");
    window.type_into("Minimum spacing H_m in nm", "123");
    let own = window.known().document.scene().clone();
    open(&mut window, "Pushing on trapped air");
    window.click_on("Presets");
    window.click_part("Levitating");
    window.get_by_label_contains("Save the changes");
    window.click_on("Keep editing");
    assert!(window.known().lessons.running.is_some(), "the lesson goes on");
    window.click_on("Leave");
    assert_eq!(window.known().document.scene(), &own);
    // Nothing unsaved: no question, and the preset is opened.
    window.ctrl(Key::Z);
    open(&mut window, "Pushing on trapped air");
    window.click_on("Presets");
    window.click_part("Levitating");
    assert!(window.known().document.scene().name.starts_with("Levitating"));
    assert!(window.known().lessons.running.is_none());
}

#[test]
fn progress_and_the_own_scene_survive_a_restart() {
    let mut window = window_with(Memory::default());
    window.step();
    window.click_on("Skip the tour");
    window.type_into("Minimum spacing H_m in nm", "123");
    open(&mut window, "The squeeze number");
    go_on(&mut window, 2);
    let progress = window.known().lessons.progress_text();
    let memory = left(&mut window);
    assert_eq!(memory.0["unsaved"], "true");
    drop(window);
    let mut window = window_with(memory);
    window.run_steps(2);
    let app = window.state();
    assert!(progress.contains("prediction") && app.state().lessons.progress_text() == progress);
    let mut other = LessonState::new();
    assert!(other.restore("nonsense").is_err() && other.progress_text() == "{}");
    assert!(app.state().lessons.running.is_none() && app.state().document.is_dirty());
    assert_eq!(app.state().document.scene().get("film.min_spacing_nm"), Some(Value::Number(123.0)));
    window.click_on("Lessons");
    window.get_by_label_contains("at step 3 of 6");
    window.click_part("The squeeze number");
    assert_eq!(step(&window).0, 2, "it goes on where it was left");
    assert_eq!(window.known().document.scene(), &step(&window).1.scene);
}

#[test]
fn the_tour_is_for_the_first_start_and_can_be_found_again() {
    let titles: Vec<&str> = tour::STOPS.iter().map(|stop| stop.title).collect();
    assert_eq!(titles.len(), 4);
    // Over a file that was asked for: no.
    let mut asked = window("fundamental");
    asked.run_steps(3);
    assert!(asked.known().lessons.tour.is_none());
    drop(asked);

    let mut window = window_with(Memory::default());
    solved(&mut window);
    for (i, stop) in tour::STOPS.iter().enumerate() {
        window.run_steps(4);
        window.get_by_label(stop.title);
        let spot = squeezefilm::gui::ui::highlight::place(&window.ctx, stop.place);
        assert!(spot.is_some(), "{} is on screen", stop.place);
        let callout = window.get_by_label(stop.title).rect();
        assert!(!spot.unwrap().intersects(callout), "{}: covered", stop.title);
        // Enter goes on as the button does, and the last card starts the first lesson.
        if i == 1 {
            window.press(Key::Enter);
        } else {
            window.click_on(if i == 3 { "Start lesson 1" } else { "Next" });
        }
    }
    assert!(window.known().lessons.tour.is_none());
    assert_eq!((running(window.known()).lesson, step(&window).0), (0, 0));
    window.click_on("Leave");
    let mut window = restarted(window);
    window.run_steps(3);
    assert!(titles.iter().all(|title| window.query_by_label(title).is_none()), "only once");
    // Where the callout stands depends on what is there to be shown.
    solved(&mut window);
    // Found again, with hidden panels brought back; skipped.
    window.press(Key::F2);
    window.click_on("Help");
    window.click_part("Take the tour");
    window.get_by_label(titles[0]);
    assert!(window.known().view.parameters);
    window.click_on("Next");
    window.click_on("Back");
    window.get_by_label(titles[0]);
    window.click_on("Skip the tour");
    assert!(window.query_by_label(titles[0]).is_none());
}

#[test]
fn a_drag_counts_when_it_ends_and_an_extreme_is_no_success() {
    let mut window = at("Why the mean force", 5);
    let (_, step) = step(&window);
    assert!(step.task.as_ref().unwrap().too_far.is_some());
    solved(&mut window);
    let drag = |window: &mut Window, value: f64, dragging: bool| {
        let key = "plate.amplitude_um";
        window.state_mut().carry_out(Command::Set { key, value: Value::Number(value), dragging });
        solved(window);
    };
    // Past the aim and back, with the pointer down: nothing was reached.
    for value in [0.6, 0.8, 0.7] {
        drag(&mut window, value, true);
        assert!(!work(&window).fulfilled, "{value}");
    }
    drag(&mut window, 0.7, false);
    assert!(!work(&window).fulfilled && window.shows("Not yet."));
    // The end of the slider is told to be absurd.
    drag(&mut window, 0.999, false);
    assert!(!work(&window).fulfilled && work(&window).too_far && window.shows("Too far."));
    drag(&mut window, 0.8, true);
    assert!(!work(&window).fulfilled, "still held");
    drag(&mut window, 0.8, false);
    assert!(work(&window).fulfilled);
}

#[test]
fn a_lesson_compares_on_one_scale_and_shows_the_first_run() {
    let mut window = at("A travelling wave", 4);
    solved(&mut window);
    let compared = |window: &Window| {
        let state = window.known();
        state.lessons.compared(state.document.scene()).map(|run| run.scene.clone())
    };
    assert_eq!(compared(&window), None, "nothing has changed yet");
    let first = window.known().document.scene().clone();
    change(&mut window, "stator.normal_amplitude_um", "0.65");
    solved(&mut window);
    assert_eq!(compared(&window), Some(first));
    assert!(window.shows("About: at first"));
    // The next step begins anew.
    go_on(&mut window, 1);
    solved(&mut window);
    assert_eq!(compared(&window), None);
}

#[test]
fn skipped_steps_are_shown_as_skipped_and_answers_come_back() {
    let mut window = window_with(Memory::default());
    window.step();
    window.click_on("Skip the tour");
    open(&mut window, "Pushing on trapped air");
    // Answered, not tried, and left.
    let (_, first) = step(&window);
    predict(&mut window, &first);
    window.click_on("Skip");
    assert!(running(window.known()).work[0].is_skipped(&first));
    go_on(&mut window, 5);
    assert!(window.shows("What you found") && window.shows("4 steps were skipped"));
    assert!(window.shows("1 of 10 points"));
    let mut window = restarted(window);
    window.run_steps(2);
    window.click_on("Lessons");
    window.get_by_label_contains("2 of 6 done");
    window.click_part("Pushing on trapped air");
    assert!(work(&window).committed && !work(&window).fulfilled && window.shows("Prediction made"));
    // Once more from the start, with nothing answered.
    go_on(&mut window, 6);
    window.click_on("Take it again");
    assert_eq!((step(&window).0, work(&window)), (0, StepWork::default()));
    // The next lesson is what is lit at the end.
    go_on(&mut window, 6);
    window.press(Key::Enter);
    assert_eq!(running(window.known()).lesson, 1);
}

/// Milliseconds that the clock of a test has been put forward.
static SKIPPED: AtomicU64 = AtomicU64::new(0);

/// A clock that hardly moves, so that no test depends on how fast it runs, and that can be put forward.
fn slow_clock() -> Instant {
    static START: OnceLock<Instant> = OnceLock::new();
    let start = *START.get_or_init(Instant::now);
    start + start.elapsed() / 1000 + Duration::from_millis(SKIPPED.load(Relaxed))
}

#[test]
fn a_number_that_is_still_being_typed_is_given_with_one_click() {
    let mut window = window::preset("fundamental", 1700.0, platform());
    let calculation =
        |window: &Window| step(window).1.question.is_some_and(|question| question.kind == QuestionKind::Calculate);
    let found = (1..=6).any(|step| {
        window.state_mut().updater.follow(Link::Lesson { lesson: 1, step });
        solved(&mut window);
        calculation(&window)
    });
    assert!(found, "a step of the first lesson is a calculation");
    let button = "This is my result";
    assert!(window.get_by_label(button).accesskit_node().is_disabled(), "nothing is given yet");
    window.type_over(Role::SpinButton, "Your number", "7000");
    let at = window.get_by_label(button).rect().center();
    window.hover_at(at);
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(3);
    assert_eq!((work(&window).prediction, work(&window).wrong), (Some(Prediction::Number(7000.0)), 1));
    // What is no number stays in the field, with the cursor, to be corrected.
    window.type_over(Role::SpinButton, "Your number", "abc");
    window.press(Key::Enter);
    let field = window.get_by_role_and_label(Role::SpinButton, "Your number");
    assert!(field.is_focused() && field.value().is_some_and(|text| text == "abc"), "{:?}", field.value());
}

#[test]
fn the_keyboard_alone_walks_the_first_lesson() {
    let mut window = window::preset("fundamental", 1700.0, Platform { now: slow_clock, ..platform() });
    window.state_mut().updater.follow(Link::Lesson { lesson: 1, step: 1 });
    solved(&mut window);
    let keys = [Key::Num1, Key::Num2, Key::Num3, Key::Num4];
    while window.known().lessons.step().is_some() {
        let (number, step) = step(&window);
        solved(&mut window);
        if let Some(question) = &step.question {
            match &question.answer {
                lessons::Answer::Choice { right, .. } => window.press(keys[*right]),
                lessons::Answer::Number { value, .. } => {
                    window.press(Key::Enter);
                    window.run_steps(20);
                    // While it is typed into, it is a text field.
                    let field = window.get_by_label("Your number");
                    assert!(field.is_focused());
                    field.type_text(&value.to_string());
                    window.step();
                    window.press(Key::Enter);
                }
            }
            window.press(Key::Enter);
            assert!(work(&window).committed, "{}", step.title);
        }
        if let Some(task) = &step.task {
            match &task.example.changes[..] {
                // The plate in the hand goes down a step with each press.
                [] => {
                    for _ in 0..10 {
                        window.press(Key::ArrowDown);
                    }
                }
                [(_, value), ..] => {
                    window.press(Key::Enter);
                    window.run_steps(20);
                    let field = labels::field_name(step.highlight_keys[0]);
                    assert!(window.get_by_role_and_label(Role::TextInput, &field).is_focused(), "{field}");
                    window.get_by_role_and_label(Role::TextInput, &field).type_text(value);
                    window.step();
                    window.press(Key::Enter);
                }
            }
            until(&mut window, &step.title, |app| {
                // A held plate moves with the clock.
                SKIPPED.fetch_add(20, Relaxed);
                running(app.state()).work[number].fulfilled
            });
            let Some(lessons::Answer::Choice { right, .. }) = step.observe.as_ref().map(|observe| &observe.answer)
            else {
                continue;
            };
            window.press(keys[*right]);
            // Whoever presses Enter after every answer reads what is told all the same.
            window.press(Key::Enter);
            assert_eq!(running(window.known()).step, number, "{}", step.title);
            SKIPPED.fetch_add(1000, Relaxed);
        }
        assert_eq!(stage(&window), Stage::Told, "{}", step.title);
        window.press(Key::Enter);
        window.run_steps(5);
    }
    assert_eq!(running(window.known()).step, window.known().lessons.lessons[0].steps.len());
}

#[test]
fn enter_leads_to_a_list_and_to_a_button_that_are_marked() {
    for (lesson, number, role, name) in
        [(5, 3, Role::ComboBox, "Slip at the walls"), (4, 4, Role::Button, "Start from rest")]
    {
        let mut window = window("fundamental");
        window.state_mut().updater.follow(Link::Lesson { lesson, step: number });
        let step = predicted(&mut window);
        window.press(Key::Enter);
        window.run_steps(20);
        assert!(window.get_by_role_and_label(role, name).is_focused(), "{}", step.title);
    }
}

#[test]
fn the_answer_button_is_in_sight_in_lecture_size() {
    let mut window = window::preset("fundamental", 768.0, platform());
    window.state_mut().updater.follow(Link::Lesson { lesson: 1, step: 3 });
    window.state_mut().carry_out(Command::ToggleLecture);
    window.run_steps(10);
    let button = window.get_by_label("This is my prediction").rect();
    assert!(window.ctx.content_rect().contains_rect(button), "{button:?}");
}

#[test]
fn an_explanation_on_hover_does_not_cover_what_a_step_looks_at() {
    let mut window = window("fundamental");
    window.state_mut().updater.follow(Link::Lesson { lesson: 1, step: 2 });
    solved(&mut window);
    window.run_steps(4);
    let ring = squeezefilm::gui::ui::highlight::place(&window.ctx, "gap").unwrap();
    window.get_by_label("About: Gap").hover();
    window.run_steps(40);
    let term = lessons::glossary::find("Gap").unwrap();
    let text = text::plain_blocks(&term.text[..1]);
    let explained = window.get_all_by_label(&text).last().unwrap().rect();
    assert!(!explained.intersects(ring), "{explained:?} {ring:?}");
}

#[test]
fn lessons_of_a_folder_are_read_again_and_go_on_where_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let two = format!("{GOOD}\n## Second step\n\nAs it was.\n");
    write(folder.path(), "mine", &two);
    let mut window = window("fundamental");
    window.state_mut().updater.load_lessons(folder.path());
    let place = window.known().lessons.lessons.len() - 1;
    window.state_mut().updater.follow(Link::Lesson { lesson: place + 1, step: 2 });
    window.run_steps(4);
    assert!(window.shows("As it was."));
    let read_again = |window: &mut Window, words: &str| {
        write(folder.path(), "mine", &two.replace("As it was.", words));
        window.key_press(Key::F5);
        window.run_steps(6);
    };
    read_again(&mut window, "As it is.");
    assert!(step(&window).0 == 1 && window.shows("As it is."));
    // A picture beside the text, and one that is not there.
    let mut encoder = png::Encoder::new(std::fs::File::create(folder.path().join("mine/a.png")).unwrap(), 3, 2);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[99; 18]).unwrap();
    read_again(&mut window, "![A grey square](a.png)");
    assert!(window.query_by_role_and_label(Role::Image, "A grey square").is_some());
    read_again(&mut window, "![A grey square](b.png)");
    window.get_by_label_contains("picture b.png: there is no such file beside lesson.md");
    window.click_on("Close");
    // A place that is not there is named.
    window.state_mut().updater.follow(Link::Lesson { lesson: place + 1, step: 8 });
    window.run_steps(3);
    window.get_by_label_contains("step 8: lesson");
}

#[test]
fn the_glossary_is_searched() {
    let mut window = window("plate-crossover");
    window.click_on("Help");
    window.click_part("Glossary");
    window.get_by_label_contains("Knudsen number  Kn");
    let count = |window: &Window| window.query_all_by_label_contains("mean free path").count();
    assert!(count(&window) > 0);
    window.get_by_role_and_label(Role::TextInput, "Search").type_text("levitation");
    window.run_steps(4);
    window.get_by_label("Levitated");
    assert!(window.query_by_label_contains("Knudsen number  Kn").is_none());
    window.get_by_role_and_label(Role::TextInput, "Search").type_text(" xyzzy");
    window.run_steps(4);
    window.get_by_label("No term has all of these words");
}

#[test]
fn escape_closes_the_tour_the_glossary_and_whatever_is_over_them() {
    let mut window = window("plate-crossover");
    solved(&mut window);
    let glossary = |window: &mut Window| {
        window.click_on("Help");
        window.click_part("Glossary");
        assert!(window.known().lessons.glossary.is_some());
    };
    // While what is looked for is being typed too.
    glossary(&mut window);
    window.get_by_role_and_label(Role::TextInput, "Search").type_text("spring");
    window.run_steps(3);
    window.press(Key::Escape);
    assert!(window.known().lessons.glossary.is_none());

    // A text that is being typed elsewhere goes first, and so does a menu.
    glossary(&mut window);
    window.get_by_role_and_label(Role::TextInput, "Frequency in kHz").click();
    window.run_steps(2);
    window.get_by_role_and_label(Role::TextInput, "Frequency in kHz").type_text("7");
    window.run_steps(2);
    window.press(Key::Escape);
    assert!(window.known().lessons.glossary.is_some());
    for (menu, entry) in [("Lessons", "Open a folder of lessons"), ("Presets", "Plate, viscous")] {
        window.click_on(menu);
        window.run_steps(5);
        assert!(window.shows(entry), "{menu}");
        window.press(Key::Escape);
        window.run_steps(10);
        assert!(!window.shows(entry), "{menu}");
        assert!(window.known().lessons.glossary.is_some(), "{menu}");
    }

    // The tour before the glossary, the sheet of shortcuts before both.
    window.click_on("Help");
    window.click_part("Take the tour");
    window.press(Key::F1);
    window.get_by_label("Keyboard shortcuts");
    window.press(Key::Escape);
    assert!(window.query_by_label("Keyboard shortcuts").is_none());
    assert!(window.known().lessons.tour.is_some());
    window.press(Key::Escape);
    assert!(window.known().lessons.tour.is_none() && window.known().lessons.glossary.is_some());
    window.press(Key::Escape);
    assert!(window.known().lessons.glossary.is_none());

    // A question, an error, a path to type.
    window.click_on("File");
    window.click_part("Open or save by path");
    window.get_by_role_and_label(Role::TextInput, "Path");
    window.press(Key::Escape);
    assert!(window.query_by_role_and_label(Role::TextInput, "Path").is_none());
}

#[test]
fn every_term_of_the_results_is_in_the_glossary_and_shown_on_hover() {
    for preset in ["fundamental", "levitating", "plate-crossover", "plate-trapped", "floating-disc"] {
        let mut window = window(preset);
        solved(&mut window);
        let missing = squeezefilm::gui::ui::glossary::unexplained(&window.ctx);
        assert!(missing.is_empty(), "{preset}: {missing:?}");
    }
    // The numbers beside a lesson's text too.
    for lesson in window_names(lessons::built_in).0 {
        for name in lesson.steps.iter().flat_map(|step| &step.show) {
            assert!(lessons::glossary::find(&name.words()).is_some(), "{}", name.words());
        }
    }
    let mut window = window("fundamental");
    solved(&mut window);
    let meaning = "turns the rotor";
    assert!(!window.shows(meaning));
    window.get_by_label("Contact load").hover();
    window.run_steps(30);
    assert!(window.shows(meaning));
}

const GOOD: &str = include_str!("lessons/good.md");

/// Writes a lesson into a folder of its own.
fn write(folder: &Path, id: &str, text: &str) {
    std::fs::create_dir_all(folder.join(id)).unwrap();
    std::fs::write(folder.join(id).join("lesson.md"), text).unwrap();
}

#[test]
fn the_example_of_the_documentation_is_a_lesson_that_works() {
    let page = include_str!("../docs/lessons.md");
    let example = page.split("````markdown\n").nth(1).unwrap().split("````").next().unwrap();
    assert_eq!(example, GOOD);
    let mut window = window("fundamental");
    open_own(&mut window, GOOD, "A lesson of my own");
    predicted(&mut window);
    show_me(&mut window);
    solved(&mut window);
    assert!(work(&window).fulfilled);
}

/// Opens the lesson that `text` is.
fn open_own(window: &mut Window, text: &str, title: &str) {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "my-lesson", text);
    window.state_mut().updater.load_lessons(folder.path());
    window.run_steps(2);
    open(window, title);
}

#[test]
fn what_is_told_after_a_task_is_as_exact_as_the_run_on_screen() {
    let mut window = window("fundamental");
    open_own(&mut window, GOOD, "A lesson of my own");
    predicted(&mut window);
    show_me(&mut window);
    until(&mut window, "the finest run", |app| {
        let done = |run: &SolvedScene| run.scene == *app.state().document.scene() && run.fidelity == Fidelity::Fine;
        app.state().run.as_deref().is_some_and(done)
    });
    let run = window.known().run.clone().unwrap();
    let finest = Numbers::of(&run.problem, &run.solution).get(Quantity::LoadRatio).unwrap();
    assert_eq!(work(&window).readings["mean_load_ratio:2"], finest);
}

#[test]
fn what_is_told_after_a_task_follows_the_run_on_screen_or_says_that_it_does_not() {
    const ANOTHER: &str = "not from the one on screen";
    let told = |window: &Window| work(window).readings["max_pressure_kpa"];
    let mut window = at("Pushing on trapped air", 2);
    let step = predicted(&mut window);
    change(&mut window, "plate.amplitude_um", "0.52");
    solved(&mut window);
    let first = told(&window);
    look(&mut window, step.observe.as_ref().unwrap(), &step.title);
    assert!(window.shows("0.480 µm") && window.shows("211 kPa") && !window.shows(ANOTHER));
    // Another amplitude that is about half of the gap.
    change(&mut window, "plate.amplitude_um", "0.5");
    solved(&mut window);
    assert!(told(&window) < first - 5.0);
    assert!(window.shows("0.500 µm") && window.shows("203 kPa") && !window.shows(ANOTHER));
    // And one that is not.
    let kept = told(&window);
    change(&mut window, "plate.amplitude_um", "0.2");
    solved(&mut window);
    assert!(told(&window) == kept && window.shows(ANOTHER));
    // Opened again, it is the one that did the task.
    let mut window = restarted(window);
    open(&mut window, "Pushing on trapped air");
    until(&mut window, "the run that did the task", |app| {
        app.state().document.scene().get("plate.amplitude_um") == Some(Value::Number(0.5))
    });
    solved(&mut window);
    assert!(window.shows("203 kPa") && !window.shows(ANOTHER));
}

#[test]
fn a_step_that_is_shown_again_has_its_tab_and_the_run_that_did_its_task() {
    const KEY: &str = "plate.amplitude_um";
    let amplitude = |app: &App| app.state().document.scene().get(KEY);
    let mut window = at("Why the mean force", 1);
    let (_, step) = step(&window);
    assert!(step.tab.is_none(), "the step before has set one");
    solved(&mut window);
    predict(&mut window, &step);
    change(&mut window, KEY, "0.5");
    solved(&mut window);
    assert!(work(&window).fulfilled);
    go_on(&mut window, 1);
    window.click_on("Leave");
    // Then from the step before.
    window.ctrl(Key::Num9);
    assert_eq!(window.known().view.tab, Tab::Sensitivity);
    open(&mut window, "Why the mean force");
    window.press(Key::PageUp);
    assert_eq!((self::step(&window).0, window.known().view.tab), (1, Tab::Motion));
    until(&mut window, "the run that did the task", |app| amplitude(app) == Some(Value::Number(0.5)));
    solved(&mut window);
    let start = &running(window.known()).start;
    assert!(start.scene == step.scene && start.numbers.get(Quantity::LoadRatio).is_some());
    assert!(window.shows("✔ Done") && work(&window).fulfilled);
    // Whoever changes something first keeps that.
    let app = window.state_mut();
    app.carry_out(Command::Lesson(LessonCommand::Back));
    app.carry_out(Command::Lesson(LessonCommand::Next));
    app.carry_out(Command::Set { key: KEY, value: Value::Number(0.3), dragging: false });
    solved(&mut window);
    window.run_steps(5);
    assert_eq!(amplitude(window.state()), Some(Value::Number(0.3)));
}

#[test]
fn the_highest_pressure_of_a_push_is_kept() {
    let mut window = at("Pushing on trapped air", 0);
    predicted(&mut window);
    let live = |window: &Window, live: Live| running(window.known()).tabs.now.get(live).unwrap();
    let highest = |window: &Window| {
        let hold = window.known().hold.as_ref().unwrap();
        hold.trail().map(|reading| 1e-3 * reading.mean_pressure).fold(0.0, f64::max)
    };
    drag_plate(&mut window, 0.5);
    until(&mut window, "the air has left", |app| app.state().hold.as_ref().unwrap().now.reading.ratio < 0.2);
    let (now, kept) = (live(&window, Live::HeldPressure), live(&window, Live::HeldPeak));
    assert!(now < 125.0 && kept > 160.0, "{now} {kept}");
    assert!((kept - highest(&window)).abs() < 1e-6, "{kept}: that of the chart is {}", highest(&window));
    // With the charts it begins anew.
    window.click_on("Reset");
    until(&mut window, "it is at rest", |app| app.state().hold.as_ref().unwrap().now.reading.time == 0.0);
    assert!(live(&window, Live::HeldPeak) < 102.0);
}

#[test]
fn why_there_is_no_result_is_told_where_the_task_is() {
    let mut window = window("fundamental");
    let text = "# Heavy\n\nA disc.\n\n## Load it\n\n```setup\npreset = \"floating-disc\"\nhighlight_keys = [\"plate.mass_g\"]\n```\n\nIt floats.\n\n\
        ```task\nask = \"Load it.\"\nhints = [\"More.\"]\ncheck = \"plate.mass_g > 2500 and min_gap_nm >= 200\"\n```\n";
    open_own(&mut window, text, "Heavy");
    solved(&mut window);
    change(&mut window, "plate.mass_g", "300");
    solved(&mut window);
    assert!(window.shows("Not yet. Mass is 300 g"));
    change(&mut window, "plate.mass_g", "4000");
    until(&mut window, "it does not float", |app| app.state().activity.failure.is_some());
    // In the line of the window and in the box of the task, where nothing is left of the run before.
    assert_eq!(window.query_all_by_label_contains("does not float").count(), 2);
    assert!(!window.shows("Not yet."));
}

#[test]
fn a_folder_of_lessons_is_opened_from_the_menu() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "my-lesson", GOOD);
    std::fs::write(folder.path().join("my-lesson/mine.toml"), "schema = 1\nscene = \"plate\"\n").unwrap();
    write(folder.path(), "second", &GOOD.replace("plate-trapped", "mine.toml").replace("A lesson", "Another"));
    std::fs::copy(folder.path().join("my-lesson/mine.toml"), folder.path().join("second/mine.toml")).unwrap();
    write(folder.path(), "third", &GOOD.replace("check = ", "chek = "));
    let mut window = window("fundamental");
    window.click_on("Lessons");
    window.click_part("Open a folder of lessons…");
    answer(&mut window, folder.path());
    // The bad one is reported, the others are there.
    window.get_by_label("This did not work");
    window.get_by_label_contains("task.chek is not known");
    window.click_on("Close");
    let titles: Vec<&str> = window.known().lessons.lessons.iter().map(|lesson| lesson.title.as_str()).collect();
    assert_eq!(&titles[lessons::BUILT_IN.len()..], ["A lesson of my own", "Another of my own"]);
    open(&mut window, "Another of my own");
    assert_eq!(window.known().document.scene().scene(), "plate");
    window.click_on("Lessons");
    window.click_part("What was wrong with lessons…");
    window.get_by_label_contains("task.chek is not known");
}

#[test]
fn broken_lessons_are_reported_with_file_line_and_what_is_allowed() {
    // What is changed, into what, words of the line at fault, and what is told of it.
    let mutations = [
        ("\"plate-trapped\"", "\"plate-traped\"", "", "no such file beside lesson.md | plate-traped"),
        ("preset = \"plate-trapped\"", "", "## ", "setup.preset is missing"),
        ("preset =", "prest =", "", "setup.prest is not known | preset, set, highlight_keys"),
        ("\"plate.amplitude_um = 0.1\"", "\"plate.amplitud_um = 0.1\"", "", "plate.amplitude_um"),
        ("\"plate.amplitude_um = 0.1\"", "\"plate.amplitude_um = -1\"", "", "out of range | 0 to"),
        ("\"plate.amplitude_um = 0.1\"", "\"plate.amplitude_um\"", "", "is no change: expected"),
        (
            "highlight_keys = [\"plate.amplitude_um\"]",
            "highlight_keys = [\"film.nothing\"]",
            "",
            "film.nothing | plate.mean_gap_um",
        ),
        (
            "highlight_keys = [\"plate.amplitude_um\"]",
            "highlight_keys = \"plate.amplitude_um\"",
            "",
            "wrong type | a list",
        ),
        (
            "highlight_parts = [\"loop\"]",
            "highlight_parts = [\"moon\"]",
            "",
            "setup.highlight_parts = \"moon\" | wave, gap",
        ),
        (
            "tab = \"Motion\"",
            "tab = \"Movies\"",
            "",
            "setup.tab = \"Movies\" | Motion, Compare, Sweep, Exact, Trade-off, Start-up, Hold",
        ),
        ("tab = \"Motion\"", "tab = \"Torque\"", "", "setup.tab = \"Torque\" | Exact"),
        (
            "show = [\"mean_load_ratio\"]",
            "show = [\"torque.stall_nm\"]",
            "",
            "setup.show = \"torque.stall_nm\" | hold.gap_um",
        ),
        ("try = [\"plate.amplitude_um = 0.9\"]", "try = [\"hold.gap_um = no\"]", "", "hold.gap_um"),
        ("try = [\"plate.amplitude_um = 0.9\"]", "try = [\"startup\"]", "", "is no change"),
        ("show = [\"mean_load_ratio\"]", "show = [\"alpha\"]", "", "setup.show = \"alpha\" | mean_load_ratio"),
        ("answer = 2", "answer = 7", "", "question.answer = 7 is out of range | 1 to 3"),
        ("answer = 2", "answer = \"b\"", "", "wrong type | a number"),
        ("answer = 2", "", "```question", "question.answer is missing"),
        ("mean_load_ratio > 2", "mean_load_rato > 2", "", "mean_load_rato is neither | did you mean mean_load_ratio?"),
        ("mean_load_ratio > 2", "mean_load_ratio 2", "", "2 is not expected here | < <= >"),
        ("check = ", "check == ", "", "is not valid TOML"),
        ("```task", "```taks", "", "a block ```taks is not known: expected setup, question, task or observe"),
        ("answer = 2", "answer = 2\nkind = \"guess\"", "", "question.kind = \"guess\" | predict, calculate"),
        ("answer = 2", "answer = 2\nkind = \"calculate\"", "choices =", "question.choices does not go with"),
        ("replies = [", "replies = [\"\", ", "", "question.replies = 4 texts | 3, one for each choice"),
        ("hints = [", "hint = [", "", "task.hint is not known | hints"),
        ("too_far_says = ", "then_says = ", "```task", "task.too_far_says is missing"),
        ("plate.amplitude_um > 0.95", "plate.amplitud_um > 0.95", "", "task.too_far | did you mean"),
        ("{min_gap_nm:2}", "{min_gap:2}", "", "{min_gap:2} | did you mean min_gap_nm?"),
        ("{start.max_pressure_kpa}", "{alpha}", "", "alpha belongs to another kind of scene | write \\{"),
        ("{start.max_pressure_kpa}", "{start.max_pressure_kpa", "", "begins with { and does not end"),
        ("\\frac{h_0}{h}", "\\frc{h_0}{h}", "why =", "\\frc is not known in formulas"),
        ("# A lesson of my own", "", "", "has no title"),
    ];
    for (good, bad, place, parts) in mutations {
        assert_eq!(GOOD.matches(good).count(), 1, "{good}");
        let lesson = GOOD.replacen(good, bad, 1);
        // Without words it is the line that was changed.
        let at_fault = |(line, was): (&str, &str)| if place.is_empty() { line != was } else { line.contains(place) };
        let line = lesson.lines().zip(GOOD.lines()).position(at_fault).unwrap() + 1;
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), "bad", &lesson);
        write(folder.path(), "good", GOOD);
        let (read, faults) = load(folder.path());
        assert_eq!(read.len(), 1, "{bad}: the good one is there");
        let text: Vec<String> = faults.iter().map(ToString::to_string).collect();
        let text = text.join("\n");
        assert!(text.contains(&format!("{}:{line}:", Path::new("bad").join("lesson.md").display())), "{bad}: {text}");
        assert!(parts.split(" | ").all(|part| text.contains(part)), "{bad}: {text}");
    }
    // No bytes of a lesson bring the program down: cut anywhere, with anything in it.
    let folder = tempfile::tempdir().unwrap();
    for (cut, _) in GOOD.char_indices().step_by(7) {
        for rest in ["", "```", "$", "\\", "\0", "[[", "= \"", "## \n"] {
            write(folder.path(), "cut", &format!("{}{rest}", &GOOD[..cut]));
            let (read, faults) = load(folder.path());
            assert!(read.len() + usize::from(!faults.is_empty()) == 1, "{cut} {rest}");
        }
    }
    std::fs::write(folder.path().join("cut/lesson.md"), [0xff, 0xfe, 0x00]).unwrap();
    let told = |folder: &Path| load(folder).1[0].to_string();
    assert!(told(folder.path()).contains("cannot be read"));
    assert!(told(&folder.path().join("absent")).contains("cannot be read"));
    assert!(told(tempfile::tempdir().unwrap().path()).contains("holds no lesson"));
}

#[test]
fn what_the_window_lights_and_lessons_name_is_drawn() {
    let mut motor = window("fundamental");
    solved(&mut motor);
    let mut plate = window("plate-crossover");
    solved(&mut plate);
    open(&mut motor, "Lost torque");
    let drawn = |window: &Window, place: &str| squeezefilm::gui::ui::highlight::place(&window.ctx, place).is_some();
    let mut missing: Vec<&str> = PLACES.to_vec();
    missing.retain(|place| !drawn(&motor, place) && !drawn(&plate, place));
    // The rest is in other tabs.
    motor.click_on("Torque");
    read_off(&mut motor);
    plate.click_on("Hold");
    missing.retain(|place| !drawn(&motor, place) && !drawn(&plate, place));
    plate.click_on("Start-up");
    missing.retain(|place| !drawn(&plate, place));
    plate.click_on("Start from rest");
    until(&mut plate, "a cycle", |app| {
        app.state().startup.as_ref().is_some_and(|starting| !starting.points.is_empty())
    });
    missing.retain(|place| !drawn(&plate, place));
    assert!(missing.is_empty(), "{missing:?} are drawn nowhere");
}

#[test]
fn a_file_that_cannot_be_opened_leaves_a_lesson_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let (bad, good) = (folder.path().join("bad.toml"), folder.path().join("good.toml"));
    std::fs::write(&bad, "schema = 1\n[film]\nmin_spacing_nm = 3\n").unwrap();
    std::fs::write(&good, "schema = 1\nscene = \"plate\"\nname = \"Good\"\n").unwrap();
    let mut window = window("fundamental");
    window.type_into("Minimum spacing H_m in nm", "123");
    open(&mut window, "The squeeze number");
    go_on(&mut window, 1);
    solved(&mut window);
    window.type_into("Frequency in kHz", "0.5");
    let lent = window.known().document.scene().clone();
    for (path, why) in [(&bad, "film.min_spacing_nm = 3"), (&folder.path().join("absent.toml"), "absent.toml")] {
        drop_file(&mut window, path);
        window.get_by_label("This did not work");
        window.get_by_label_contains(why);
        window.click_on("Close");
        assert_eq!(step(&window).0, 1);
        assert_eq!(window.known().document.scene(), &lent);
        assert!(window.shows("Lesson ·"));
    }
    // So does a folder without lessons; and one with lessons adds them.
    window.state_mut().updater.load_lessons(&folder.path().join("absent"));
    window.run_steps(3);
    window.click_on("Close");
    write(folder.path(), "mine", GOOD);
    window.state_mut().updater.load_lessons(folder.path());
    window.run_steps(3);
    assert_eq!((step(&window).0, window.known().document.scene()), (1, &lent));
    // Another text of the lesson that is followed ends it.
    write(folder.path(), "3-squeeze-number", GOOD);
    window.state_mut().updater.load_lessons(folder.path());
    window.run_steps(3);
    assert!(window.known().lessons.running.is_none());
    // A good file ends a lesson; what is unsaved is asked about.
    open(&mut window, "Pushing on trapped air");
    drop_file(&mut window, &good);
    window.get_by_label_contains("Save the changes");
    window.click_on("Don't save");
    assert_eq!(window.known().document.scene().name, "Good");
    assert!(window.known().lessons.running.is_none());
}

#[test]
fn what_a_lesson_shows_in_a_tab_it_does_itself() {
    let mut window = at("Why the mean force", 3);
    assert_eq!(window.known().view.tab, Tab::Startup);
    predicted(&mut window);
    // In another tab, too.
    window.click_on("Motion");
    show_me(&mut window);
    assert_eq!(window.known().view.tab, Tab::Startup);
    until(&mut window, "it comes to its end", |app| work_in(app.state()).fulfilled);
    // A start-up of before does not count when the step begins again.
    window.click_on("Back");
    go_on(&mut window, 1);
    assert!(window.known().startup.as_ref().is_none());
    window.click_on("Leave");
    assert_eq!(window.known().view.tab, Tab::Motion);

    open(&mut window, "Pushing on trapped air");
    assert_eq!(window.known().view.tab, Tab::Hold);
    predicted(&mut window);
    window.click_on("Motion");
    show_me(&mut window);
    until(&mut window, "the plate is pushed", |app| work_in(app.state()).fulfilled);
}

#[test]
fn a_preset_that_a_lesson_lends_can_be_saved_as_a_copy() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("copy.toml");
    let mut window = window("fundamental");
    let own = window.known().document.scene().clone();
    open(&mut window, "The squeeze number");
    let lent = window.known().document.scene().clone();
    window.ctrl(Key::S);
    answer(&mut window, &path);
    // Its values are no longer those that the description of the preset names.
    assert_eq!(Scene::load(&path).unwrap(), presets::disclaimed(lent));
    window.click_on("Leave");
    assert_eq!(window.known().document.scene(), &own);
    assert!(window.known().document.path().is_none(), "the own scene has no file by that");
}
