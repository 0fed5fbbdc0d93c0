//! Edits the scene, and opens and saves scenes.

use super::updater::Updater;
use crate::fidelity::Fidelity;
use crate::gui::state::dialogs::{Purpose, complete};
use crate::gui::state::document::{Document, Next};
use crate::gui::state::edits::Change;
use crate::gui::state::modal::Modal;
use crate::gui::state::window::State;
use crate::problem::Numerics;
use crate::scene::{Parameter, ParameterKind, Scene, presets};
use eframe::egui;
use std::path::{Path, PathBuf};

impl Updater {
    /// Edits the scene, and solves everything that depends on it again.
    pub(super) fn edit(&mut self, key: &'static str, dragging: bool, change: Change) {
        match change.applied(self.state.document.scene(), key) {
            Ok(next) => {
                self.state.rejected.accept(key);
                let changed = next != *self.state.document.scene();
                self.state.document.edit(next, key, dragging);
                if changed {
                    if is_switch(key) {
                        self.state.switches.switched(key);
                    } else {
                        self.state.switches.edited();
                    }
                    self.state.rejected.review(self.state.document.scene());
                    self.refine();
                }
            }
            Err(error) => {
                if !dragging {
                    self.state.document.end_drag();
                }
                self.state.rejected.reject(key, change, error);
            }
        }
    }

    pub(super) fn reset(&mut self, key: &'static str) {
        let Some(parameter) = Parameter::find(key) else { return };
        match parameter.default() {
            Some(value) => self.edit(key, false, Change::Value(value)),
            None if parameter.absent.is_some() => self.edit(key, false, Change::Unset),
            None => {}
        }
    }

    /// Changes the numerics and the fidelity, as one edit.
    pub(super) fn use_setting(&mut self, target: Fidelity, numerics: Numerics) {
        let mut next = self.state.document.scene().clone();
        match next.set_numerics(&numerics).and_then(|()| next.check()) {
            Ok(()) => {
                if self.state.document.change(next, target) {
                    self.state.switches.edited();
                    self.state.rejected.review(self.state.document.scene());
                    self.refine();
                }
            }
            Err(error) => self.state.fail(error),
        }
    }

    /// Undoes or redoes an edit.
    pub(super) fn step_history(&mut self, step: fn(&mut Document) -> bool) {
        if step(&mut self.state.document) {
            self.scene_replaced();
        }
    }

    /// Opens a preset, or closes the window; asks first if that would lose unsaved changes.
    pub(super) fn proceed(&mut self, next: Next) {
        if next == Next::Quit && !self.state.unfinished().is_empty() && !self.state.quitting {
            self.state.modal = Some(Modal::Unfinished);
        } else {
            self.proceed_with_document(next);
        }
    }

    /// As [`Self::proceed`], but without a question about unfinished work.
    pub(super) fn proceed_with_document(&mut self, next: Next) {
        let State { document, lessons, .. } = &self.state;
        let student = lessons.student_document(document);
        if student.is_dirty() && !self.state.quitting {
            // The lesson goes on if the user does not answer.
            let file = student.path().and_then(Path::file_name).map(|file| format!(" ({})", file.display()));
            let name = student.scene().name.clone() + &file.unwrap_or_default();
            self.state.modal = Some(Modal::Unsaved { name, next });
            return;
        }
        self.leave_lesson();
        self.proceed_now(next);
    }

    /// Opens the preset in a file. If it cannot be opened, nothing is lost, and a lesson goes on.
    pub(super) fn open_file(&mut self, path: PathBuf) {
        match Scene::load(&path) {
            Ok(scene) => {
                let document = Document::opened(presets::disclaimed(scene), Some(path));
                self.proceed(Next::Given(Box::new(document)));
            }
            Err(error) => self.fail_at(Purpose::Open, &path, error),
        }
    }

    /// Whether something would be lost if the window closed now.
    pub fn quitting_loses(&self) -> bool {
        let State { lessons, document, .. } = &self.state;
        lessons.student_document(document).is_dirty() || !self.state.unfinished().is_empty()
    }

    /// As [`Self::proceed`], without any question.
    pub(super) fn proceed_now(&mut self, next: Next) {
        match next {
            Next::Preset(name) => match presets::find(name) {
                Ok(scene) => self.proceed_now(Next::Given(Box::new(Document::opened(scene, None)))),
                Err(error) => self.state.fail(error),
            },
            Next::Given(document) => {
                document.path().into_iter().for_each(|path| self.state.remember(path));
                self.state.document = document.with_target(self.state.document.target());
                self.state.view.opened += 1;
                self.scene_replaced();
            }
            Next::Quit => {
                self.state.quitting = true;
                self.ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            }
        }
    }

    /// Saves to the scene's file, or asks for one.
    pub(super) fn save(&mut self, then: Option<Next>) {
        if then.is_some() {
            self.leave_lesson();
        }
        match self.state.document.path().map(Path::to_path_buf) {
            Some(path) if self.state.document.is_changed_elsewhere() => {
                self.state.modal = Some(Modal::ChangedElsewhere(path, then));
            }
            _ => self.replace(then),
        }
    }

    /// As [`Self::save`], even if another program has changed the file.
    pub(super) fn replace(&mut self, then: Option<Next>) {
        match self.state.document.path().map(Path::to_path_buf) {
            Some(path) => {
                if let Err(reason) = self.save_to(&path, then) {
                    self.fail_at(Purpose::Save(None), &path, reason);
                }
            }
            None => self.ask(Purpose::Save(then)),
        }
    }

    /// Saves to a chosen file. A name without an extension gets `.toml`; another extension is refused.
    ///
    /// # Errors
    /// If nothing can be saved there; nothing changes then.
    pub(super) fn save_as(&mut self, path: PathBuf, then: Option<Next>) -> Result<(), String> {
        self.save_to(&complete(path, "preset", &["toml"])?, then)
    }

    /// Saves to this file, then goes on to `then`, unless that was read from this very file earlier: the window already shows what the file
    /// now holds.
    fn save_to(&mut self, path: &Path, then: Option<Next>) -> Result<(), String> {
        self.state.document.save(path).map_err(|error| error.to_string())?;
        self.state.remember(path);
        self.state.exports.written = Some((vec![path.to_owned()], self.now()));
        then.into_iter().filter(|next| !is_of_file(next, path)).for_each(|next| self.proceed_now(next));
        Ok(())
    }

    /// Discards unsaved changes, then goes on to `next`.
    pub(super) fn discard_then(&mut self, next: Next) {
        self.leave_lesson();
        if next == Next::Quit {
            // The next window begins with the saved scene.
            self.state.document = self.state.document.discarded();
        }
        self.proceed_now(next);
    }
}

/// Whether `next` is a document that was read from the file at `path`, possibly under another name.
fn is_of_file(next: &Next, path: &Path) -> bool {
    let Next::Given(document) = next else { return false };
    let file = document.path().and_then(|read| read.canonicalize().ok());
    file.is_some() && file == path.canonicalize().ok()
}

fn is_switch(key: &str) -> bool {
    Parameter::find(key)
        .is_some_and(|found| found.table() == "numerics" && matches!(found.kind, ParameterKind::Choice { .. }))
}
