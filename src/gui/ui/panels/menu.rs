//! The menu bar.

use crate::gui::command::{Command, LessonCommand};
use crate::gui::state::dialogs::{Described, Export, Purpose};
use crate::gui::state::document::Next;
use crate::gui::state::view::Tab;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::{Hint, beside};
use crate::gui::ui::keys;
use crate::lessons::text::plain_blocks;
use crate::platform::HAS_FILES;
use crate::scene::{Kind, Scene, presets};
use eframe::egui::{self, Button, Response};
use std::sync::LazyLock;

/// Shows the menus.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let document = &cx.state.document;
    egui::MenuBar::new().ui(ui, |ui| {
        menu(ui, "File", &mut |ui| file(ui, cx));
        menu(ui, "Presets", &mut |ui| presets_menu(ui, |name| Next::Preset(name).into(), cx));
        menu(ui, "Edit", &mut |ui| {
            item(ui, "Undo", document.can_undo(), Command::Undo, cx);
            item(ui, "Redo", document.can_redo(), Command::Redo, cx);
            ui.separator();
            item(ui, "Copy link", true, Command::CopyLink, cx);
        });
        menu(ui, "View", &mut |ui| {
            let other = if cx.state.dark { "Light theme" } else { "Dark theme" };
            let plate = document.scene().kind() == Kind::Plate;
            for &(tab, _) in Tab::ALL {
                item(ui, tab.label(plate), tab.is_listed(plate), Command::Show(tab), cx);
            }
            ui.separator();
            item(ui, other, true, Command::ToggleTheme, cx);
            item(ui, "Lecture size", true, Command::ToggleLecture, cx);
            ui.separator();
            item(ui, "Parameters, show or hide", true, Command::ToggleParameters, cx);
            item(ui, "Results, show or hide", true, Command::ToggleResults, cx);
            ui.separator();
            item(ui, "Picture of the window…", true, Command::Screenshot, cx);
        });
        let lessons = menu(ui, "Lessons", &mut |ui| lessons(ui, cx));
        cx.name_part(ui, "lessons", lessons.rect);
        menu(ui, "Help", &mut |ui| {
            item(ui, "Glossary", true, Command::Glossary(true), cx);
            item(ui, "Take the tour", true, Command::Tour(Some(0)), cx);
            ui.separator();
            item(ui, "Keyboard shortcuts", true, Command::ToggleShortcuts, cx);
            item(ui, "About squeezefilm", true, Command::About, cx);
        });
        ui.separator();
        let title = ui.add(egui::Label::new(egui::RichText::new(document.title()).strong()).truncate());
        let place = match document.path() {
            Some(path) => path.display().to_string(),
            None if document.practice => "set up by the lesson, to try things on".to_owned(),
            None => "built-in preset, not saved".to_owned(),
        };
        title.hint(if document.is_dirty() { format!("{place} (changes not saved)") } else { place });
    });
}

/// A menu. Its entries are a trait object, so that egui's menus are compiled only once.
pub fn menu(ui: &mut egui::Ui, name: &str, entries: &mut dyn FnMut(&mut egui::Ui)) -> Response {
    ui.menu_button(name, |ui| entries(ui)).response
}

fn item(ui: &mut egui::Ui, text: &str, enabled: bool, command: impl Into<Command>, cx: &DrawContext<'_>) {
    let command = command.into();
    let entry = ui.add_enabled(enabled, Button::new(text).shortcut_text(keys::of(&command)));
    take(ui, entry, command, cx);
}

/// Requests `command` if this entry was clicked, and closes the menu.
fn take(ui: &egui::Ui, entry: Response, command: impl Into<Command>, cx: &DrawContext<'_>) {
    if entry.clicked() {
        cx.push(command);
        ui.close();
    }
}

/// Kinds of export, grouped for the menu.
const EXPORTS: &[&[Export]] = &[
    &[Export::Data, Export::Figures, Export::Fields, Export::Animation, Export::Report],
    COMPARISON,
    SWEEP,
    &[Export::TradeoffTable, Export::TradeoffFigure],
    &[Export::Sensitivity],
    &[Export::Fit],
    &[Export::Startup],
];
/// Exports of the pinned runs.
pub const COMPARISON: &[Export] = &[Export::Comparison, Export::ComparisonReport];
/// Exports of the sweep.
pub const SWEEP: &[Export] = &[Export::Sweep, Export::SweepTable, Export::SweepFigure];

/// A button with a menu of exports; it is shown once there is something to export.
pub fn export_button(ui: &mut egui::Ui, group: &[Export], cx: &DrawContext<'_>) {
    if group.iter().any(|export| cx.state.can_export(*export)) {
        let button = menu(ui, "Export ▾", &mut |ui| group.iter().for_each(|export| export_item(ui, *export, cx)));
        button.hint("Writes this to files, as the command line does");
    }
}

fn export_item(ui: &mut egui::Ui, export: Export, cx: &DrawContext<'_>) {
    let Described { entry, about, .. } = export.described();
    let entry = ui.add_enabled(cx.state.can_export(export), Button::new(entry));
    take(ui, beside(ui.max_rect(), entry, about), Command::Ask(Purpose::Export(export)), cx);
}

fn exports(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    for (i, group) in EXPORTS.iter().enumerate() {
        if i > 0 {
            ui.separator();
        }
        group.iter().for_each(|export| export_item(ui, *export, cx));
    }
}

fn file(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    item(ui, "New motor…", true, Command::NewMotor, cx);
    item(ui, "Open…", true, Command::Ask(Purpose::Open), cx);
    if HAS_FILES {
        item(ui, "Open or save by path…", true, Command::OpenPathPrompt, cx);
        menu(ui, "Recent", &mut |ui| {
            if cx.state.recent.is_empty() {
                ui.weak("Nothing opened yet");
            }
            for path in &cx.state.recent {
                item(ui, &path.display().to_string(), true, Command::Chosen(Purpose::Open, path.clone()), cx);
            }
        });
    }
    ui.separator();
    item(ui, "Save", true, Command::Save(None), cx);
    item(ui, "Save as…", true, Command::Ask(Purpose::Save(None)), cx);
    ui.separator();
    menu(ui, "Export", &mut |ui| exports(ui, cx));
    if HAS_FILES {
        ui.separator();
        item(ui, "Quit", true, Command::Proceed(Next::Quit), cx);
    }
}

fn lessons(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let state = &cx.state.lessons;
    for (i, lesson) in state.lessons.iter().enumerate() {
        let progress = state.progress(lesson);
        let steps = lesson.steps.len();
        let skipped = lesson.steps.iter().zip(&progress.work).filter(|(step, work)| work.is_skipped(step)).count();
        let mark = match (progress.step, progress.done, skipped) {
            (0, true, _) => "✔ done".to_owned(),
            (0, false, 0) => format!("{steps} steps"),
            (0, false, skipped) => format!("{} of {steps} done", steps - skipped),
            (step, ..) => format!("at step {} of {steps}", (step + 1).min(steps)),
        };
        let entry = ui.add(Button::new(format!("{}  {}", i + 1, lesson.title)).shortcut_text(mark));
        take(ui, beside(ui.max_rect(), entry, &plain_blocks(&lesson.about)), LessonCommand::Open(i, None), cx);
    }
    ui.separator();
    let running = state.running.is_some();
    item(ui, "Leave the lesson", running, LessonCommand::Leave, cx);
    if HAS_FILES {
        item(ui, "Open a folder of lessons…", true, Command::Ask(Purpose::Lessons), cx);
        item(ui, "Reload the lessons of folders", !state.folders.is_empty(), LessonCommand::Reload, cx);
    }
    export_item(ui, Export::Answers, cx);
    if !state.faults.is_empty() {
        item(ui, "What was wrong with lessons…", true, LessonCommand::Faults, cx);
    }
}

/// All built-in presets; a click requests the `command` for that preset.
pub fn presets_menu(ui: &mut egui::Ui, command: impl Fn(&'static str) -> Command, cx: &DrawContext<'_>) {
    // Built-in presets parse: a test opens every one.
    static ALL: LazyLock<Vec<(&presets::BuiltIn, Scene)>> =
        LazyLock::new(|| presets::BUILT_IN.iter().filter_map(|preset| Some((preset, preset.scene().ok()?))).collect());
    let room = 0.85 * ui.ctx().content_rect().height();
    egui::ScrollArea::vertical().max_height(room).min_scrolled_height(room).show(ui, |ui| {
        let mut last = None;
        for (preset, scene) in ALL.iter() {
            if last.replace(preset.group).is_some_and(|group| group != preset.group) {
                ui.separator();
            }
            let entry = ui.add(Button::new(scene.name.as_str()).shortcut_text(preset.name));
            take(ui, beside(ui.max_rect(), entry, &scene.about), command(preset.name), cx);
        }
    });
}
