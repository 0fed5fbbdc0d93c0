//! Progress of an export, or the files that it wrote.

use crate::gui::command::Command;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::Hint;
use eframe::egui::{self, RichText};
use std::path::PathBuf;
use std::time::Duration;

/// One line above the status: progress of an export, or the files that it wrote.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let exports = &cx.state.exports;
    if let Some(running) = &exports.running {
        ui.horizontal(|ui| {
            cx.button(ui, "Cancel the export", "Ends the export; nothing is written", Command::CancelExport);
            let (drawn, all) = running.drawn;
            if all > 0 {
                let (share, words) = (drawn as f64 / all as f64, format!("{drawn} of {all} pictures"));
                cx.progress(ui, 220.0, share, &words, Some((running.started, share)));
            } else {
                ui.spinner();
            }
            ui.label(if running.work.cancelled { "Ending…" } else { running.export.title() });
        });
    } else if let Some((paths, _)) = &exports.written {
        ui.horizontal(|ui| {
            cx.small_button(ui, ("✕", "Closes this note"), "Close the note", Command::CloseExportNote);
            let list = paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join("\n");
            let text = RichText::new(summary(paths)).color(cx.colours.good);
            ui.add(egui::Label::new(text).truncate()).hint(list);
        });
        ui.ctx().request_repaint_after(Duration::from_secs(1));
    }
}

/// The files that were written, in words.
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
