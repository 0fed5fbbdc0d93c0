//! Draws error messages, questions and the prompt for a path.

use super::{Answer, frame, heading, new_motor};
use crate::citation::{LICENCE, VERSION, bibtex};
use crate::gui::command::Command;
use crate::gui::state::dialogs::Purpose;
use crate::gui::state::document::{Next, absolute};
use crate::gui::state::modal::{Modal, PathPrompt};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::panels::field::select_all;
use eframe::egui::{self, Id, Key, Response, Ui};
use std::path::{Path, PathBuf, is_separator};

const WIDTH: f32 = 460.0;

/// Shows the open modal dialog, if there is one.
pub fn show(ctx: &egui::Context, cx: &DrawContext<'_>) {
    let Some(modal) = &cx.state.modal else { return };
    let response = egui::Modal::new(Id::unique("question")).frame(frame(ctx)).show(ctx, |ui| {
        ui.set_width(WIDTH.min(0.8 * ctx.content_rect().width()));
        match modal {
            Modal::Error(message) => error(ui, message),
            Modal::Unsaved { name, next } => unsaved(ui, name, next),
            Modal::ChangedElsewhere(path, then) => changed_elsewhere(ui, path, then.as_ref()),
            Modal::Unfinished => unfinished(ui, &cx.state.unfinished()),
            Modal::Path(prompt) => path(ui, prompt, cx),
            Modal::NewMotor(answers) => new_motor::show(ui, answers, cx),
            Modal::About => about(ui, cx),
        }
    });
    let closed = response.should_close().then(Vec::new);
    if let Some(commands) = response.inner.or(closed) {
        cx.push(Command::CloseModal);
        commands.into_iter().for_each(|command| cx.push(command));
    }
}

/// A button that has the keyboard focus until another widget takes it.
fn button_with_keyboard(ui: &mut Ui, text: &str) -> Response {
    let button = ui.button(text);
    if ui.memory(|memory| memory.focused().is_none()) {
        button.request_focus();
    }
    button
}

fn error(ui: &mut Ui, message: &str) -> Answer {
    heading(ui, "This did not work");
    // A long message scrolls, so that the button below stays in the window.
    egui::ScrollArea::vertical().max_height(0.6 * ui.ctx().content_rect().height()).show(ui, |ui| {
        ui.add(egui::Label::new(message).wrap());
    });
    ui.add_space(12.0);
    button_with_keyboard(ui, "Close").clicked().then(Vec::new)
}

fn about(ui: &mut Ui, cx: &DrawContext<'_>) -> Answer {
    heading(ui, &format!("squeezefilm {VERSION}"));
    let text = "What a few hundred nanometres of air do inside an ultrasonic motor: the film between stator and rotor, the elastic \
                rotor and their contact, solved together, with an error for every number.";
    ui.add(egui::Label::new(text).wrap());
    ui.add_space(6.0);
    cx.note(
        ui,
        format!(
            "Licence: {LICENCE}; its fonts have their own, in assets/fonts. Equations and what they were checked against: docs/theory.md and docs/validation.md."
        ),
    );
    ui.add_space(12.0);
    ui.label("To cite it:");
    let citation = bibtex();
    ui.add(
        egui::TextEdit::multiline(&mut citation.trim_end())
            .font(egui::TextStyle::Monospace)
            .desired_width(f32::INFINITY)
            .desired_rows(1),
    );
    ui.add_space(12.0);
    ui.horizontal_wrapped(|ui| {
        cx.on_click(&ui.button("Copy citation"), Command::CopyCitation);
        button_with_keyboard(ui, "Close").clicked().then(Vec::new)
    })
    .inner
}

fn unsaved(ui: &mut Ui, name: &str, next: &Next) -> Answer {
    heading(ui, &format!("Save the changes to “{name}”?"));
    let answers = [
        ("Save", vec![Command::Save(Some(next.clone()))]),
        ("Don't save", vec![Command::DiscardThen(next.clone())]),
        ("Keep editing", Vec::new()),
    ];
    buttons(ui, 0, answers)
}

fn changed_elsewhere(ui: &mut Ui, path: &Path, then: Option<&Next>) -> Answer {
    let file = path.file_name().unwrap_or_default().display();
    heading(ui, &format!("“{file}” has changed since it was opened or saved here"));
    ui.add(egui::Label::new("Saving replaces what another program has written there.").wrap());
    ui.add_space(12.0);
    let answers = [
        ("Save under another name…", vec![Command::Ask(Purpose::Save(then.cloned()))]),
        ("Replace it", vec![Command::Replace(then.cloned())]),
        ("Keep editing", Vec::new()),
    ];
    buttons(ui, 0, answers)
}

/// A row of buttons; the one with the index `first` has the keyboard focus. Returns the commands of the one that was clicked.
fn buttons<const N: usize>(ui: &mut Ui, first: usize, answers: [(&str, Vec<Command>); N]) -> Answer {
    ui.horizontal_wrapped(|ui| {
        let mut clicked = None;
        for (i, (text, commands)) in answers.into_iter().enumerate() {
            let button = if i == first { button_with_keyboard(ui, text) } else { ui.button(text) };
            if button.clicked() {
                clicked = Some(commands);
            }
        }
        clicked
    })
    .inner
}

fn unfinished(ui: &mut Ui, work: &[String]) -> Answer {
    heading(ui, if work.is_empty() { "Everything is done. Quit?" } else { "Quit before this is done?" });
    for what in work {
        ui.add(egui::Label::new(what).wrap());
    }
    ui.add_space(12.0);
    let quit = if work.is_empty() { "Quit" } else { "Quit anyway" };
    buttons(ui, 1, [(quit, vec![Command::QuitAnyway]), ("Keep the window open", Vec::new())])
}

fn path(ui: &mut Ui, prompt: &PathPrompt, cx: &DrawContext<'_>) -> Answer {
    if let [only] = &prompt.purposes[..] {
        heading(ui, only.title());
        cx.note(ui, "This system shows no file dialog: type the path.");
        ui.add_space(6.0);
    } else {
        heading(ui, "Open or save a preset");
    }
    let folder = prompt.purposes.iter().all(|purpose| purpose.filter().is_none());
    let label = ui.label(if folder { "Folder" } else { "Path" });
    let mut typed = prompt.path.clone();
    let field = ui.add(egui::TextEdit::singleline(&mut typed).desired_width(f32::INFINITY)).labelled_by(label.id);
    if prompt.fresh {
        field.request_focus();
        // Typed text replaces the suggested name.
        select_all(ui, field.id, &typed);
    }
    if prompt.fresh || field.changed() {
        cx.push(Command::TypePath(typed.clone()));
    }
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let path = expanded(&typed);
    let named = !typed.trim().is_empty();
    let writes = prompt.purposes.iter().any(Purpose::writes);
    let replaces = writes && named && cx.state.document.path() != Some(path.as_path()) && path.is_file();
    let alone = replaces && !prompt.purposes.contains(&Purpose::Open);
    cx.alarm(ui, alone.then_some("There is such a file already"));
    cx.alarm(ui, prompt.refused.as_deref());
    ui.add_space(12.0);
    ui.horizontal_wrapped(|ui| {
        for (i, purpose) in prompt.purposes.iter().enumerate() {
            let text = match purpose.writes() {
                false => "Open",
                true if replaces => "Replace",
                true => "Save",
            };
            let clicked = ui.add_enabled(named, egui::Button::new(text)).clicked();
            // Enter chooses the first button, but never replaces a file.
            let replacing = replaces && *purpose != Purpose::Open;
            if clicked || (entered && named && i == 0 && !replacing) {
                cx.push(Command::Typed(purpose.clone(), path.clone()));
            }
        }
        ui.button("Cancel").clicked().then(Vec::new)
    })
    .inner
}

/// A typed path as an absolute path; `~/` is the home folder, and on Windows `~\` too.
fn expanded(path: &str) -> PathBuf {
    let path = path.trim();
    let rest = path.strip_prefix('~').and_then(|rest| rest.strip_prefix(is_separator));
    match (rest, std::env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest),
        _ => absolute(Path::new(path)),
    }
}
