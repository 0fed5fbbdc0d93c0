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

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::wgpu::{WgpuTestRenderer, default_wgpu_setup};
use egui_kittest::{Harness, SnapshotResults};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::app::App;
use squeezefilm::gui::dialogs::Answer;
use squeezefilm::gui::world::World;
use squeezefilm::scene::presets;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

const USUAL: [f32; 2] = [1400.0, 900.0];
const SMALL: [f32; 2] = [1024.0, 700.0];
const THEME: (Modifiers, Key) = (Modifiers::COMMAND, Key::T);
const LECTURE: (Modifiers, Key) = (Modifiers::COMMAND, Key::L);
const SHEET: (Modifiers, Key) = (Modifiers::NONE, Key::F1);
const OPEN: (Modifiers, Key) = (Modifiers::COMMAND, Key::O);

const LOOKS: &[Look] = &[
    ("motor-dark", "fundamental", USUAL, &[]),
    ("motor-light", "fundamental", USUAL, &[THEME]),
    ("motor-lecture", "fundamental", USUAL, &[LECTURE]),
    ("motor-small", "fundamental", SMALL, &[]),
    ("levitating-small-light", "levitating", SMALL, &[THEME]),
    ("plate-dark", "plate-crossover", USUAL, &[]),
    ("plate-small-light", "plate-trapped", SMALL, &[THEME]),
    ("shortcuts-lecture", "plate-viscous", USUAL, &[LECTURE, SHEET]),
];

/// A clock that stands: solves take no time, and the animation does not move by itself.
fn standing() -> Instant {
    static MOMENT: OnceLock<Instant> = OnceLock::new();
    *MOMENT.get_or_init(Instant::now)
}

/// Name of the picture, preset, size of the window, keys that are pressed.
type Look = (&'static str, &'static str, [f32; 2], &'static [(Modifiers, Key)]);

/// Whether there is a driver to draw with.
fn can_draw() -> bool {
    let instance = pollster_wait(default_wgpu_setup().new_instance());
    !pollster_wait(instance.enumerate_adapters(eframe::wgpu::Backends::VULKAN)).is_empty()
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
fn window(preset: &str, size: [f32; 2], keys: &[(Modifiers, Key)]) -> Harness<'static, App> {
    let scene = presets::find(preset).unwrap();
    let world = World { now: standing, ask: |_, _| Answer::NoDialog, ..World::default() };
    let mut window = Harness::builder()
        .with_size(Vec2::from(size))
        .with_pixels_per_point(1.0)
        .renderer(WgpuTestRenderer::new())
        .build_eframe(move |context| App::in_world(context, Some((scene, None)), world).unwrap());
    // How long the solver takes decides how long a cursor has been blinking.
    window.ctx.all_styles_mut(|style| style.visuals.text_cursor.blink = false);
    window.key_press(Key::Space);
    for _ in 0..6000 {
        window.step();
        let app = window.state();
        let fine = app.shown().is_some_and(|run| run.fidelity == Fidelity::Fine);
        if fine && app.activity().running.is_none() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    window.key_press(Key::Home);
    window.step();
    for _ in 0..7 {
        window.key_press(Key::ArrowRight);
        window.step();
    }
    for _ in 0..2 {
        window.key_press(Key::CloseBracket);
        window.step();
    }
    for (modifiers, key) in keys {
        window.key_press_modifiers(*modifiers, *key);
        settle(&mut window);
    }
    settle(&mut window);
    window
}

/// Until panels have their sizes and nothing fades in any more.
fn settle(window: &mut Harness<'static, App>) {
    window.run_steps(20);
}

/// A start-up that has come to its end, and a held plate at rest.
fn live(results: &mut SnapshotResults) {
    const STARTUP: (Modifiers, Key) = (Modifiers::COMMAND, Key::Num2);
    const HOLD: (Modifiers, Key) = (Modifiers::COMMAND, Key::Num3);
    for (name, preset, size, keys) in [
        ("startup-dark", "fundamental", USUAL, &[STARTUP][..]),
        ("startup-plate-small-light", "plate-crossover", SMALL, &[STARTUP, THEME]),
    ] {
        let mut window = window(preset, size, keys);
        window.get_by_label("Start from rest").click();
        for _ in 0..6000 {
            window.step();
            if window.state().starting().is_some_and(|starting| starting.ended().is_some()) {
                break;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        settle(&mut window);
        window.snapshot(name);
        results.extend_harness(&mut window);
    }
    for (name, size, keys) in
        [("hold-dark", USUAL, &[HOLD][..]), ("hold-lecture-light", SMALL, &[HOLD, THEME, LECTURE])]
    {
        let mut window = window("plate-crossover", size, keys);
        window.snapshot(name);
        results.extend_harness(&mut window);
    }
}

#[test]
fn the_window_looks_as_it_did() {
    if !can_draw() {
        let required = std::env::var_os("SQUEEZEFILM_SNAPSHOTS").is_some_and(|value| value == "required");
        assert!(!required, "there is no Vulkan driver");
        eprintln!("skipped: there is no Vulkan driver (Debian: mesa-vulkan-drivers)");
        return;
    }
    let mut results = SnapshotResults::new();
    for &(name, preset, size, keys) in LOOKS {
        let mut window = window(preset, size, keys);
        window.snapshot(name);
        results.extend_harness(&mut window);
    }
    live(&mut results);
    // A path to type, and what cannot be opened, in a small window with large text.
    let mut window = window("fundamental", SMALL, &[LECTURE, OPEN]);
    for _ in 0..200 {
        if window.query_all_by_label("Path").next().is_some() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
        window.step();
    }
    settle(&mut window);
    window.snapshot("open-by-path");
    window.get_by_role_and_label(Role::TextInput, "Path").type_text("absent.toml");
    window.step();
    window.key_press(Key::Enter);
    settle(&mut window);
    window.snapshot("error");
    results.extend_harness(&mut window);
}
