//! The real window without a display, as the tests of several files open and use it.
#![allow(dead_code, reason = "no file of tests uses all of it")]

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::app::App;
use squeezefilm::gui::state::document::Document;
use squeezefilm::gui::state::window::State;
use squeezefilm::gui::update::platform::Platform;
use squeezefilm::scene::presets;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

pub(crate) type Window = Harness<'static, App>;

/// A window on a document. A test answers the file dialogs of its platform: it never opens a real one.
pub(crate) fn open(opened: Document, height: f32, platform: Platform) -> Window {
    Harness::builder()
        .with_size(Vec2::new(1400.0, height))
        .build_eframe(move |context| App::on_platform(context, Some(opened), platform).unwrap())
}

/// A window that was there before and left `memory`, or never; it opens no file.
pub(crate) fn reopen(memory: Memory, height: f32, platform: Platform) -> Window {
    reopen_on(memory, None, height, platform)
}

/// The same that is to open a document.
pub(crate) fn reopen_on(memory: Memory, opened: Option<Document>, height: f32, platform: Platform) -> Window {
    let memory: &'static Memory = Box::leak(Box::new(memory));
    Harness::builder().with_size(Vec2::new(1400.0, height)).build_eframe(move |context| {
        context.storage = Some(memory);
        App::on_platform(context, opened, platform).unwrap()
    })
}

/// A window on a built-in preset.
pub(crate) fn preset(name: &str, height: f32, platform: Platform) -> Window {
    open(Document::opened(presets::find(name).unwrap(), None), height, platform)
}

/// What a window leaves behind.
pub(crate) fn left(window: &mut Window) -> Memory {
    let mut memory = Memory::default();
    eframe::App::save(window.state_mut(), &mut memory);
    memory
}

/// What a user does and sees. Whatever is done has some frames to take effect.
pub(crate) trait User {
    /// Presses a key.
    fn press(&mut self, key: Key) {
        self.press_with(Modifiers::NONE, key);
    }

    /// Presses a key with Ctrl.
    fn ctrl(&mut self, key: Key) {
        self.press_with(Modifiers::COMMAND, key);
    }

    /// Presses a key with others.
    fn press_with(&mut self, modifiers: Modifiers, key: Key);

    /// Clicks what has this label.
    fn click_on(&mut self, label: &str);

    /// Clicks what has this in its label.
    fn click_part(&mut self, part: &str);

    /// Opens the list of this name.
    fn open_list(&mut self, name: &str);

    /// Types over what is in a field, and leaves the cursor there.
    fn type_over(&mut self, role: Role, field: &str, text: &str);

    /// Types into a field, over what is there, and presses Enter.
    fn type_into(&mut self, field: &str, text: &str) {
        self.type_over(Role::TextInput, field, text);
        self.press(Key::Enter);
    }

    /// Whether a text is on screen.
    fn shows(&self, part: &str) -> bool;

    /// All that the window knows.
    fn known(&self) -> &State;
}

impl User for Window {
    fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.key_press_modifiers(modifiers, key);
        self.run_steps(3);
    }

    fn click_on(&mut self, label: &str) {
        self.get_by_label(label).click();
        self.run_steps(3);
    }

    fn click_part(&mut self, part: &str) {
        self.get_by_label_contains(part).click();
        self.run_steps(3);
    }

    fn open_list(&mut self, name: &str) {
        self.get_by_role_and_label(Role::ComboBox, name).click();
        self.run_steps(3);
    }

    fn type_over(&mut self, role: Role, field: &str, text: &str) {
        self.get_by_role_and_label(role, field).click();
        self.run_steps(3);
        self.key_press_modifiers(Modifiers::COMMAND, Key::A);
        self.get_by_role_and_label(role, field).type_text(text);
        self.step();
    }

    fn shows(&self, part: &str) -> bool {
        self.query_all_by_label_contains(part).next().is_some()
    }

    fn known(&self) -> &State {
        self.state().state()
    }
}

/// Steps until `ready`, and a little more; at most two minutes of waiting in all: solvers work on their own threads.
pub(crate) fn until(window: &mut Window, what: &str, ready: impl Fn(&App) -> bool) {
    for _ in 0..12_000 {
        window.step();
        if ready(window.state()) {
            window.run_steps(3);
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("{what}: did not happen");
}

/// Until the scene on screen is solved.
pub(crate) fn solved(window: &mut Window) {
    until(window, "the scene on screen is solved", |app| {
        let number = app.state().activity.number;
        app.state().activity.running.is_none()
            && app.state().run.as_deref().is_some_and(|run| run.number == number && run.fidelity == Fidelity::Fine)
    });
}

/// The window when its scene is solved.
pub(crate) fn once_solved(mut window: Window) -> Window {
    solved(&mut window);
    window
}

/// Whether torque over speed is known of the run on screen.
pub(crate) fn has_torque(app: &App) -> bool {
    app.state().run.as_deref().is_some_and(|run| app.state().torque.is_of(run))
}

/// Whether a measurement of error against time has ended.
pub(crate) fn measured(app: &App) -> bool {
    app.state().tradeoff.as_ref().is_some_and(|measured| !measured.work.running())
}

/// Drops a file on the window.
pub(crate) fn drop_file(window: &mut Window, path: impl Into<PathBuf>) {
    window.input_mut().dropped_files.push(std::sync::Arc::new(Dropped(path.into())));
    window.step();
    window.input_mut().dropped_files.clear();
    window.run_steps(3);
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl eframe::egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

/// Waits until a path is asked for, which a dialog that cannot be shown leads to; the name of its field.
pub(crate) fn await_path(window: &mut Window) -> &'static str {
    for _ in 0..500 {
        window.step();
        let there = |name: &&str| window.query_by_role_and_label(Role::TextInput, name).is_some();
        if let Some(name) = ["Path", "Folder"].into_iter().find(there) {
            window.run_steps(2);
            return name;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("no path is asked for");
}

/// Types the path that is asked for.
pub(crate) fn answer(window: &mut Window, path: &Path) {
    let name = await_path(window);
    window.type_into(name, path.to_str().unwrap());
}

/// Asks for an export in the menu and types where to.
pub(crate) fn begin_export(window: &mut Window, entry: &str, path: &Path) {
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
    window.click_part(entry);
    answer(window, path);
}

/// Heights of a face on which ridges lie along y.
pub(crate) fn face() -> String {
    let height = |i: u32, j: u32| {
        let (i, j) = (f64::from(i), f64::from(j));
        90.0 * (0.9 * i).sin() * (0.21 * j).cos() + 37.0 * (2.3 * i + 0.3 * j).sin()
    };
    let row = |j: u32| (0..48).map(|i| format!("{:.3}", height(i, j))).collect::<Vec<_>>().join(",");
    let rows: Vec<String> = (0..40).map(row).collect();
    format!("# dx_um = 2\n# dy_um = 2\n# height = nm\n{}\n", rows.join("\n"))
}

/// Storage in memory, as eframe keeps it in a file.
#[derive(Clone, Default)]
pub(crate) struct Memory(pub(crate) BTreeMap<String, String>);

impl eframe::Storage for Memory {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        self.0.insert(key.to_owned(), value);
    }

    fn remove_string(&mut self, key: &str) {
        self.0.remove(key);
    }

    fn flush(&mut self) {}
}
