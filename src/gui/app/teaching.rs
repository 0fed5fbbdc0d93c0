//! What is asked of lessons, tour and glossary, carried out.

use super::App;
use crate::gui::dialogs::Purpose;
use crate::gui::holding;
use crate::gui::lessons::{Stage, Teach};
use crate::gui::modal::Modal;
use crate::gui::state::Tab;
use crate::lessons::Act;
use eframe::egui;
use std::path::Path;

impl App {
    /// Adds the lessons of a folder; says what is wrong with those that cannot be read.
    pub fn load_lessons(&mut self, folder: &Path) {
        if self.teaching.load(folder) {
            self.leave_lesson();
        }
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
            Teach::LoadFolder(folder) => self.load_lessons(&folder),
            Teach::Faults => self.say_faults(),
            teach => {
                let stage = Stage { document: &mut self.document, view: &mut self.view };
                let sets_up = matches!(teach, Teach::Open(_) | Teach::Next | Teach::Back | Teach::SetUp);
                let shows = teach == Teach::ShowMe;
                if self.teaching.carry_out(teach, stage) {
                    self.scene_replaced();
                }
                if sets_up {
                    self.put_to_rest();
                }
                if shows {
                    self.teaching.acts().into_iter().for_each(|act| self.act(ctx, act));
                }
            }
        }
    }

    /// A step begins with a plate that was not moved, and with nothing started.
    fn put_to_rest(&mut self) {
        if let (true, Some(holding)) = (self.teaching.is_about(Tab::Hold), &mut self.holding) {
            holding.carry_out(holding::Ask::Reset);
        }
        if self.teaching.is_about(Tab::Startup) {
            self.starting = None;
        }
    }

    /// Does in a tab what a lesson shows.
    fn act(&mut self, ctx: &egui::Context, act: Act) {
        match act {
            Act::Hold(gap) => {
                self.view.tab = Tab::Hold;
                self.hold(ctx);
                if let Some(holding) = &mut self.holding {
                    holding.carry_out(holding::Ask::To(gap * 1e-6));
                }
            }
            Act::StartUp => {
                self.view.tab = Tab::Startup;
                self.start_from_rest(ctx);
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
