//! The real window without a display, as the tests of several files open and use it.
#![allow(dead_code, reason = "no file of tests uses all of it")]

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::app::App;
use squeezefilm::gui::state::document::Document;
use squeezefilm::gui::update::platform::Platform;
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
    let memory: &'static Memory = Box::leak(Box::new(memory));
    Harness::builder().with_size(Vec2::new(1400.0, height)).build_eframe(move |context| {
        context.storage = Some(memory);
        App::on_platform(context, None, platform).unwrap()
    })
}

/// Steps until `ready`, at most a minute of waiting in all: solvers work on their own threads.
pub(crate) fn until(window: &mut Window, what: &str, ready: impl Fn(&App) -> bool) {
    for _ in 0..6000 {
        window.step();
        if ready(window.state()) {
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
    // Where the solver was faster than the window, its results are in a layout that the next frames still move.
    window.run_steps(3);
}

pub(crate) fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
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
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.get_by_role_and_label(Role::TextInput, name).type_text(path.to_str().unwrap());
    window.step();
    window.key_press(Key::Enter);
    window.run_steps(3);
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
    window.get_by_label_contains(entry).click();
    window.run_steps(2);
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
