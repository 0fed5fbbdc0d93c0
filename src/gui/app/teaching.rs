//! What is asked of lessons, tour and glossary, carried out.

use super::App;
use crate::gui::dialogs::Purpose;
use crate::gui::lessons::{Stage, Teach};
use crate::gui::modal::Modal;
use eframe::egui;
use std::path::Path;

impl App {
    /// Adds the lessons of a folder; says what is wrong with those that cannot be read.
    pub fn load_lessons(&mut self, folder: &Path) {
        self.teaching.load(folder);
        self.say_faults();
    }

    pub(super) fn say_faults(&mut self) {
        let text = self.teaching.fault_text();
        if !text.is_empty() {
            self.modal = Some(Modal::Error(text));
        }
    }

    /// Something of the lessons, the tour or the glossary.
    pub(super) fn teach(&mut self, ctx: &egui::Context, teach: Teach) {
        match teach {
            Teach::ChooseFolder => self.ask(ctx, Purpose::Lessons, ""),
            Teach::LoadFolder(folder) => {
                self.leave_lesson();
                self.load_lessons(&folder);
            }
            Teach::Faults => self.say_faults(),
            teach => {
                let stage = Stage { document: &mut self.document, view: &mut self.view };
                if self.teaching.carry_out(teach, stage) {
                    self.scene_replaced();
                }
            }
        }
    }

    /// Another scene is on the table.
    pub(super) fn scene_replaced(&mut self) {
        self.refusals.clear();
        self.comparison.edited();
        self.refine();
    }

    /// Brings the student's own scene back, if a lesson has set it aside.
    pub(super) fn leave_lesson(&mut self) {
        let stage = Stage { document: &mut self.document, view: &mut self.view };
        if self.teaching.leave(stage) {
            self.scene_replaced();
        }
    }
}
