//! An export under way, or what the last one wrote.

use super::command::Command;
use super::dialogs::Export;
use super::panels::hint::Hint;
use super::tabs::sweep::rough;
use super::theme::Palette;
use crate::job::task::Task;
use eframe::egui::{self, RichText};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// What is asked of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exporting {
    /// Ends it; nothing is written.
    Cancel,
    /// What it wrote has been read.
    Close,
}

/// What the worker tells.
#[derive(Debug)]
pub enum Told {
    /// So many pictures are drawn, of so many.
    Drawn(usize, usize),
    /// It has ended: what was written, or why nothing was; nothing at all if it was cancelled.
    Done(Result<Vec<PathBuf>, Option<String>>),
}

/// An export under way.
#[derive(Debug)]
struct Running {
    export: Export,
    task: Task<Told>,
    started: Instant,
    drawn: (usize, usize),
    cancelled: bool,
    /// It has told how it ended.
    done: bool,
}

/// All that the window knows of exports.
#[derive(Debug, Default)]
pub struct Exports {
    running: Option<Running>,
    written: Option<Vec<PathBuf>>,
}

impl Exports {
    /// Whether one is under way.
    pub fn running(&self) -> bool {
        self.running.is_some()
    }

    /// What the last one wrote.
    pub fn written(&self) -> Option<&[PathBuf]> {
        self.written.as_deref()
    }

    /// One has begun.
    pub fn begin(&mut self, export: Export, task: Task<Told>, started: Instant) {
        self.written = None;
        self.running = Some(Running { export, task, started, drawn: (0, 0), cancelled: false, done: false });
    }

    /// One ended at once.
    pub fn wrote(&mut self, paths: Vec<PathBuf>) {
        self.written = Some(paths);
    }

    /// Carries out what is asked.
    pub fn carry_out(&mut self, asked: Exporting) {
        match asked {
            Exporting::Cancel => {
                if let Some(running) = &mut self.running {
                    running.task.cancel();
                    running.cancelled = true;
                }
            }
            Exporting::Close => self.written = None,
        }
    }

    /// Takes what has been told since the last time; an error is to be shown.
    pub fn drain(&mut self) -> Option<String> {
        let running = self.running.as_mut()?;
        let (told, ended) = running.task.drain();
        let mut error = None;
        for told in told {
            match told {
                // Several threads count: the last to tell need not have counted last.
                Told::Drawn(drawn, all) => running.drawn = (drawn.max(running.drawn.0), all),
                Told::Done(Ok(paths)) => (self.written, running.done) = (Some(paths), true),
                Told::Done(Err(reason)) => (error, running.done) = (reason, true),
            }
        }
        if ended {
            if !running.done {
                error = Some("The export ended before it was done; nothing was written".to_owned());
            }
            self.running = None;
        }
        error
    }
}

/// One line above the status: how far an export is, or what it wrote.
pub fn show(ui: &mut egui::Ui, exports: &Exports, now: Instant, colours: &Palette, commands: &mut Vec<Command>) {
    if let Some(running) = &exports.running {
        ui.horizontal(|ui| {
            if ui.button("Cancel the export").hint("Ends it; nothing is written").clicked() {
                commands.push(Command::Exporting(Exporting::Cancel));
            }
            let (drawn, all) = running.drawn;
            if all > 0 {
                let share = drawn as f32 / all as f32;
                let spent = now.saturating_duration_since(running.started).as_secs_f64();
                let left = spent * (all - drawn.min(all)) as f64 / drawn.max(1) as f64;
                let left = if drawn > 0 && drawn < all { format!(", {} left", rough(left)) } else { String::new() };
                let text = format!("{drawn} of {all} pictures{left}");
                ui.add(egui::ProgressBar::new(share).desired_width(220.0).text(text));
            } else {
                ui.spinner();
            }
            ui.label(if running.cancelled { "Ending…" } else { running.export.title() });
        });
        ui.ctx().request_repaint_after(Duration::from_secs(1));
    } else if let Some(paths) = &exports.written {
        ui.horizontal(|ui| {
            if ui.small_button("✕").hint("Closes this note").accessible_name("Close the note").clicked() {
                commands.push(Command::Exporting(Exporting::Close));
            }
            let list = paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join("\n");
            let text = RichText::new(summary(paths)).color(colours.good);
            ui.add(egui::Label::new(text).truncate()).hint(list);
        });
    }
}

/// Where the files are.
fn summary(paths: &[PathBuf]) -> String {
    match paths {
        [] => "Nothing to write".to_owned(),
        [only] => format!("Wrote {}", only.display()),
        [first, ..] => {
            let folder = first.parent().map(|folder| folder.display().to_string()).unwrap_or_default();
            format!("Wrote {} files to {folder}", paths.len())
        }
    }
}
