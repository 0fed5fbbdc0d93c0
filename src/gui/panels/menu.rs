//! The menu bar.

use super::hint::{Hint, beside};
use crate::gui::command::Command;
use crate::gui::dialogs::Export;
use crate::gui::document::Document;
use crate::gui::keys;
use crate::gui::lessons::{Teach, Teaching};
use crate::gui::spot;
use crate::gui::state::Tab;
use crate::lessons::text::plain_blocks;
use crate::scene::presets;
use eframe::egui::{self, Button};
use std::path::PathBuf;

/// Shows the menus.
pub fn show(
    ui: &mut egui::Ui,
    document: &Document,
    recent: &[PathBuf],
    available: &dyn Fn(Export) -> bool,
    dark: bool,
    teaching: &Teaching,
    commands: &mut Vec<Command>,
) {
    egui::MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| file(ui, recent, available, commands));
        ui.menu_button("Presets", |ui| built_in(ui, commands));
        ui.menu_button("Edit", |ui| {
            item(ui, "Undo", document.can_undo(), Command::Undo, commands);
            item(ui, "Redo", document.can_redo(), Command::Redo, commands);
        });
        ui.menu_button("View", |ui| {
            let other = if dark { "Light theme" } else { "Dark theme" };
            for &(tab, name) in Tab::ALL {
                item(ui, name, true, Command::Show(tab), commands);
            }
            ui.separator();
            item(ui, other, true, Command::ToggleTheme, commands);
            item(ui, "Lecture size", true, Command::ToggleLecture, commands);
            ui.separator();
            item(ui, "Parameters, show or hide", true, Command::ToggleParameters, commands);
            item(ui, "Results, show or hide", true, Command::ToggleResults, commands);
            ui.separator();
            item(ui, "Picture of the window…", true, Command::Screenshot, commands);
        });
        let menu = ui.menu_button("Lessons", |ui| lessons(ui, teaching, commands));
        spot::mark(ui, "lessons", menu.response.rect);
        ui.menu_button("Help", |ui| {
            item(ui, "Glossary", true, Command::Teach(Teach::Glossary(true)), commands);
            item(ui, "Take the tour", true, Command::Teach(Teach::Tour(Some(0))), commands);
            ui.separator();
            item(ui, "Keyboard shortcuts", true, Command::ToggleShortcuts, commands);
        });
        ui.separator();
        let mark = if document.is_dirty() { " •" } else { "" };
        let name = document.scene().title(document.saved());
        let title = ui.add(egui::Label::new(egui::RichText::new(format!("{name}{mark}")).strong()).truncate());
        let place = document.path().map_or_else(
            || {
                if document.is_lent() {
                    "lent by the lesson, to try things on".to_owned()
                } else {
                    "built-in preset, not saved".to_owned()
                }
            },
            |p| p.display().to_string(),
        );
        title.hint(if document.is_dirty() { format!("{place} (changes not saved)") } else { place });
    });
}

fn item(ui: &mut egui::Ui, text: &str, enabled: bool, command: Command, commands: &mut Vec<Command>) {
    if ui.add_enabled(enabled, Button::new(text).shortcut_text(keys::of(&command))).clicked() {
        commands.push(command);
        ui.close();
    }
}

/// What can be exported, in groups: of the run on screen, of the pinned runs, of the sweep, of the trade-off.
const EXPORTS: &[&[(&str, Export)]] = &[RUN, COMPARISON, SWEEP, TRADEOFF];

const RUN: &[(&str, Export)] = &[
    ("All results, into a folder…", Export::Data),
    ("Figures, into a folder…", Export::Figures),
    ("Fields as NumPy archive…", Export::Fields),
    ("Animation…", Export::Animation),
    ("Report as HTML…", Export::Report),
];

/// What can be exported of the pinned runs.
pub const COMPARISON: &[(&str, Export)] =
    &[("Comparison, into a folder…", Export::Comparison), ("Comparison as HTML…", Export::ComparisonReport)];

/// What can be exported of the sweep.
pub const SWEEP: &[(&str, Export)] = &[
    ("Sweep, into a folder…", Export::Sweep),
    ("Sweep as table…", Export::SweepTable),
    ("Sweep as figure…", Export::SweepFigure),
];

const TRADEOFF: &[(&str, Export)] =
    &[("Trade-off as table…", Export::TradeoffTable), ("Trade-off as figure…", Export::TradeoffFigure)];

/// A button with a menu of exports.
pub fn export_button(ui: &mut egui::Ui, group: &[(&str, Export)], commands: &mut Vec<Command>) {
    let menu = ui.menu_button("Export ▾", |ui| {
        for (text, export) in group {
            export_item(ui, text, *export, true, commands);
        }
    });
    menu.response.hint("Writes this to files, as the command line does");
}

fn export_item(ui: &mut egui::Ui, text: &str, export: Export, enabled: bool, commands: &mut Vec<Command>) {
    let entry = ui.add_enabled(enabled, Button::new(text));
    if beside(ui.max_rect(), entry, export.about()).clicked() {
        commands.push(Command::Export(export));
        ui.close();
    }
}

fn exports(ui: &mut egui::Ui, available: &dyn Fn(Export) -> bool, commands: &mut Vec<Command>) {
    for (i, group) in EXPORTS.iter().enumerate() {
        if i > 0 {
            ui.separator();
        }
        for (text, export) in *group {
            export_item(ui, text, *export, available(*export), commands);
        }
    }
}

fn file(ui: &mut egui::Ui, recent: &[PathBuf], available: &dyn Fn(Export) -> bool, commands: &mut Vec<Command>) {
    item(ui, "Open…", true, Command::OpenDialog, commands);
    item(ui, "Open or save by path…", true, Command::OpenPathPrompt, commands);
    ui.menu_button("Recent", |ui| {
        if recent.is_empty() {
            ui.weak("Nothing opened yet");
        }
        for path in recent {
            item(ui, &path.display().to_string(), true, Command::OpenPath(path.clone()), commands);
        }
    });
    ui.separator();
    item(ui, "Save", true, Command::Save, commands);
    item(ui, "Save as…", true, Command::SaveAs, commands);
    ui.separator();
    ui.menu_button("Export", |ui| exports(ui, available, commands));
    ui.separator();
    item(ui, "Quit", true, Command::Quit, commands);
}

fn lessons(ui: &mut egui::Ui, teaching: &Teaching, commands: &mut Vec<Command>) {
    for (i, lesson) in teaching.lessons().iter().enumerate() {
        let progress = teaching.progress(lesson);
        let mark = match (progress.step, progress.done) {
            (0, true) => "✔ done".to_owned(),
            (0, false) => format!("{} steps", lesson.steps.len()),
            (step, _) => format!("at step {} of {}", (step + 1).min(lesson.steps.len()), lesson.steps.len()),
        };
        let entry = ui.add(Button::new(format!("{}  {}", i + 1, lesson.title)).shortcut_text(mark));
        if beside(ui.max_rect(), entry, &plain_blocks(&lesson.about)).clicked() {
            commands.push(Command::Teach(Teach::Open(i)));
            ui.close();
        }
    }
    ui.separator();
    let running = teaching.running().is_some();
    item(ui, "Leave the lesson", running, Command::Teach(Teach::Leave), commands);
    item(ui, "Open a folder of lessons…", true, Command::Teach(Teach::ChooseFolder), commands);
    if !teaching.faults().is_empty() {
        item(ui, "What was wrong with lessons…", true, Command::Teach(Teach::Faults), commands);
    }
}

fn built_in(ui: &mut egui::Ui, commands: &mut Vec<Command>) {
    presets_menu(ui, Command::OpenBuiltIn, commands);
}

/// All built-in presets; `command` is asked with the one that is clicked.
pub fn presets_menu(ui: &mut egui::Ui, command: impl Fn(&'static str) -> Command, commands: &mut Vec<Command>) {
    let room = 0.85 * ui.ctx().content_rect().height();
    egui::ScrollArea::vertical().max_height(room).min_scrolled_height(room).show(ui, |ui| {
        let mut kind = "motor";
        for preset in presets::BUILT_IN {
            // Built-in presets parse: a test opens every one.
            let Ok(scene) = preset.scene() else { continue };
            if std::mem::replace(&mut kind, scene.scene()) != kind {
                ui.separator();
            }
            let entry = ui.add(Button::new(scene.name.as_str()).shortcut_text(preset.name));
            if beside(ui.max_rect(), entry, &scene.about).clicked() {
                commands.push(command(preset.name));
                ui.close();
            }
        }
    });
}
