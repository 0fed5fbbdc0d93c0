//! Explanations from the glossary, shown on hover beside the widget.

use super::highlight::ring_round;
use super::rich::{self, Look};
use crate::gui::ui::hint::{Hint, beside_with, describe};
use crate::lessons::glossary::{Term, find};
use crate::lessons::text::plain_blocks;
use eframe::egui::{self, Id, RichText, Ui};

/// The title of a view may be this near to the ring round the view.
const RING_NEAR: f32 = 24.0;
/// Widest explanation on hover.
const WIDTH: f32 = 320.0;

const UNEXPLAINED: &str = "glossary, unexplained";

/// Words that were shown and that the glossary lacks. A test checks that there are none.
pub fn unexplained(ctx: &egui::Context) -> Vec<String> {
    ctx.data(|data| data.get_temp::<Vec<String>>(Id::unique(UNEXPLAINED))).unwrap_or_default()
}

/// Shows a glossary entry while the pointer rests on a widget.
pub trait Explained {
    /// Explains `word` on hover, beside the panel `ui`.
    fn explained(self, ui: &Ui, word: &str) -> Self;
    /// Explains `word` on hover, close to the widget: for the middle of the window.
    fn explained_here(self, ui: &Ui, word: &str) -> Self;
}

impl Explained for egui::Response {
    fn explained(self, ui: &Ui, word: &str) -> Self {
        explain(ui, self, word, Some(ui.clip_rect()))
    }

    fn explained_here(self, ui: &Ui, word: &str) -> Self {
        explain(ui, self, word, None)
    }
}

/// Writes `text`, and explains `word` on hover, close to it.
pub fn term(ui: &mut Ui, text: impl Into<egui::WidgetText>, word: &str) -> egui::Response {
    ui.label(text).explained_here(ui, word)
}

/// A hover area over a term at `place`; `id` distinguishes it from the same term elsewhere in `ui`.
pub fn over(ui: &Ui, place: egui::Rect, word: &str, id: impl egui::AsIdSalt) -> egui::Response {
    let response = ui.interact(place, ui.scope_id().with(("term", word, id)), egui::Sense::hover());
    response.called(egui::Role::Label, &format!("About: {word}"))
}

fn explain(ui: &Ui, response: egui::Response, word: &str, panel: Option<egui::Rect>) -> egui::Response {
    let Some(term) = find(word) else {
        ui.ctx().data_mut(|data| {
            let missing: &mut Vec<String> = data.get_temp_mut_or_default(Id::unique(UNEXPLAINED));
            if !missing.iter().any(|other| other == word) {
                missing.push(word.to_owned());
            }
        });
        return response;
    };
    describe(&response, || format!("{}: {}", title(term), plain_blocks(&term.text)));
    let add = |ui: &mut Ui| {
        ui.set_max_width(WIDTH);
        ui.label(RichText::new(title(term)).strong());
        let look = Look::usual(ui);
        rich::blocks(ui, &term.text, look);
    };
    // The part that a lesson highlights is not covered either.
    match panel.or_else(|| ring_round(ui.ctx(), response.rect.expand(RING_NEAR))) {
        Some(rect) => beside_with(rect, response, add),
        None => response.on_hover_ui(add),
    }
}

/// A term with its symbol.
pub fn title(term: &Term) -> String {
    if term.symbol.is_empty() { term.name.clone() } else { format!("{}  {}", term.name, term.symbol) }
}
