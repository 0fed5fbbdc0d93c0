//! What is in the way until it is answered: an error, a question, a path to type.

use super::command::Command;
use super::dialogs::Purpose;
use super::lessons::Teach;
use super::theme::Palette;
use eframe::egui::{self, Id, Key, RichText, Ui};
use std::path::{Path, PathBuf};

/// Around the contents.
const MARGIN: i8 = 18;
/// Widest text.
const WIDTH: f32 = 460.0;

/// A modal.
#[derive(Clone, Debug)]
pub enum Modal {
    /// Something went wrong; nothing changed.
    Error(String),
    /// Unsaved changes of this scene, before this command.
    Unsaved {
        /// The scene's name.
        name: String,
        /// What would lose them.
        next: Box<Command>,
    },
    /// A path to type.
    Path(PathPrompt),
}

/// A path, and what it may be used for.
#[derive(Clone, Debug)]
pub struct PathPrompt {
    purposes: Vec<Purpose>,
    path: String,
    no_dialog: bool,
    fresh: bool,
}

impl PathPrompt {
    /// A prompt that was asked for.
    pub fn asked(purposes: &[Purpose], path: String) -> Self {
        Self { purposes: purposes.to_vec(), path, no_dialog: false, fresh: true }
    }

    /// A prompt in place of a file dialog that could not be shown.
    pub fn instead_of_dialog(purpose: Purpose, path: String) -> Self {
        Self { purposes: vec![purpose], path, no_dialog: true, fresh: true }
    }
}

/// The frame of all modals: as that of a popup, with room inside.
pub fn frame(ctx: &egui::Context) -> egui::Frame {
    egui::Frame::popup(&ctx.global_style()).inner_margin(MARGIN)
}

/// Shows a modal; false once it is answered. `file`: where the scene is saved already.
pub fn show(
    ctx: &egui::Context,
    modal: &mut Modal,
    file: Option<&Path>,
    palette: &Palette,
    commands: &mut Vec<Command>,
) -> bool {
    let response = egui::Modal::new(Id::unique("question")).frame(frame(ctx)).show(ctx, |ui| {
        ui.set_width(WIDTH.min(0.8 * ctx.content_rect().width()));
        match modal {
            Modal::Error(message) => error(ui, message),
            Modal::Unsaved { name, next } => unsaved(ui, name, next, commands),
            Modal::Path(prompt) => path(ui, prompt, file, palette, commands),
        }
    });
    if response.should_close() && response.inner {
        commands.push(Command::Dismissed);
        return false;
    }
    response.inner
}

fn heading(ui: &mut Ui, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).heading()).wrap());
    ui.add_space(8.0);
}

fn error(ui: &mut Ui, message: &str) -> bool {
    heading(ui, "This did not work");
    // A long message scrolls: the button below stays in the window.
    egui::ScrollArea::vertical().max_height(0.6 * ui.ctx().content_rect().height()).show(ui, |ui| {
        ui.add(egui::Label::new(message).wrap());
    });
    ui.add_space(12.0);
    let close = ui.button("Close");
    if ui.memory(|memory| memory.focused().is_none()) {
        close.request_focus();
    }
    !close.clicked()
}

fn unsaved(ui: &mut Ui, name: &str, next: &Command, commands: &mut Vec<Command>) -> bool {
    heading(ui, &format!("Save the changes to “{name}”?"));
    let mut open = true;
    ui.horizontal_wrapped(|ui| {
        let save = ui.button("Save");
        if ui.memory(|memory| memory.focused().is_none()) {
            save.request_focus();
        }
        if save.clicked() {
            commands.push(Command::SaveThen(Box::new(next.clone())));
            open = false;
        }
        if ui.button("Don't save").clicked() {
            commands.push(Command::DiscardThen(Box::new(next.clone())));
            open = false;
        }
        if ui.button("Keep editing").clicked() {
            commands.push(Command::Dismissed);
            open = false;
        }
    });
    open
}

fn path(
    ui: &mut Ui,
    prompt: &mut PathPrompt,
    file: Option<&Path>,
    palette: &Palette,
    commands: &mut Vec<Command>,
) -> bool {
    heading(
        ui,
        match prompt.purposes[..] {
            [Purpose::Open] => "Open a preset",
            [Purpose::Save] => "Save the preset",
            [Purpose::Lessons] => "Open a folder of lessons",
            [Purpose::Screenshot] => "Save a picture of the window",
            [Purpose::Export(export)] => export.title(),
            _ => "Open or save a preset",
        },
    );
    if prompt.no_dialog {
        let text = "No file dialog answers on this machine: type the path.";
        ui.add(egui::Label::new(RichText::new(text).color(palette.quiet)).wrap());
        ui.add_space(6.0);
    }
    let folder = matches!(prompt.purposes[..], [Purpose::Export(export)] if export.is_folder());
    let label = ui.label(if folder { "Folder" } else { "Path" });
    let field = ui.add(egui::TextEdit::singleline(&mut prompt.path).desired_width(f32::INFINITY)).labelled_by(label.id);
    if std::mem::take(&mut prompt.fresh) {
        field.request_focus();
    }
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let path = expanded(&prompt.path);
    let named = !prompt.path.trim().is_empty();
    let writes = prompt.purposes.iter().any(|purpose| !matches!(purpose, Purpose::Open | Purpose::Lessons));
    let replaces = writes && named && file != Some(path.as_path()) && path.is_file();
    if replaces && !prompt.purposes.contains(&Purpose::Open) {
        ui.add(egui::Label::new(RichText::new("There is such a file already").color(palette.alarm)).wrap());
    }
    ui.add_space(12.0);
    let mut open = true;
    ui.horizontal_wrapped(|ui| {
        for (i, &purpose) in prompt.purposes.iter().enumerate() {
            let text = match purpose {
                Purpose::Open | Purpose::Lessons => "Open",
                _ if replaces => "Replace",
                Purpose::Save | Purpose::Screenshot | Purpose::Export(_) => "Save",
            };
            let clicked = ui.add_enabled(named, egui::Button::new(text)).clicked();
            // Enter takes the first, but replaces nothing.
            let replacing = replaces && purpose != Purpose::Open;
            if clicked || (entered && named && i == 0 && !replacing) {
                commands.push(match purpose {
                    Purpose::Open => Command::OpenPath(path.clone()),
                    Purpose::Lessons => Command::Teach(Teach::LoadFolder(path.clone())),
                    Purpose::Save => Command::SavePath(path.clone()),
                    Purpose::Screenshot => Command::WritePicture(path.clone()),
                    Purpose::Export(export) => Command::WriteExport(export, path.clone()),
                });
                open = false;
            }
        }
        if ui.button("Cancel").clicked() {
            commands.push(Command::Dismissed);
            open = false;
        }
    });
    open
}

/// A typed path, `~/` being the home folder.
fn expanded(path: &str) -> PathBuf {
    let path = path.trim();
    match (path.strip_prefix("~/"), std::env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest),
        _ => PathBuf::from(path),
    }
}
