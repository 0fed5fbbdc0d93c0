//! The glossary in the window: on hover, beside what is pointed at, and as a window that can be searched.

use super::Teach;
use super::rich::{self, Look};
use crate::gui::command::Command;
use crate::gui::theme::palette;
use crate::lessons::glossary::{Term, find, terms};
use eframe::egui::{self, Id, RichText, Ui};

/// Widest explanation on hover.
const WIDTH: f32 = 320.0;
/// Between a title and its drawing, and above it.
const TITLE_ROOM: f32 = 6.0;
/// Size of the window.
const SIZE: [f32; 2] = [440.0, 520.0];

fn unexplained_id() -> Id {
    Id::unique("glossary, unexplained")
}

/// Words that were shown and that the glossary does not have: none, which a test asks for.
pub fn unexplained(ctx: &egui::Context) -> Vec<String> {
    ctx.data(|data| data.get_temp::<Vec<String>>(unexplained_id())).unwrap_or_default()
}

/// Explains `word` while the pointer rests on `response`.
pub fn hover(ui: &Ui, response: egui::Response, word: &str) -> egui::Response {
    match find(word) {
        Some(term) => {
            let panel = ui.clip_rect();
            crate::gui::panels::hint::beside_with(panel, response, |ui| {
                ui.set_max_width(WIDTH);
                explanation(ui, term);
            })
        }
        None => {
            ui.ctx().data_mut(|data| {
                let missing: &mut Vec<String> = data.get_temp_mut_or_default(unexplained_id());
                if !missing.iter().any(|other| other == word) {
                    missing.push(word.to_owned());
                }
            });
            response
        }
    }
}

/// Explains `word` while the pointer rests on the title of a drawing: the row of text above `drawing`.
pub fn over_title(ui: &Ui, drawing: egui::Rect, row: f32, word: &str) {
    let title = egui::Rect::from_min_max(drawing.left_top() - egui::vec2(0.0, row + TITLE_ROOM), drawing.right_top());
    let response = ui.interact(title, ui.scope_id().with(("title", word)), egui::Sense::hover());
    hover(ui, response, word);
}

fn explanation(ui: &mut Ui, term: &Term) {
    ui.label(RichText::new(title(term)).strong());
    let look = Look::usual(ui);
    rich::blocks(ui, &term.text, look);
}

fn title(term: &Term) -> String {
    if term.symbol.is_empty() { term.name.clone() } else { format!("{}  {}", term.name, term.symbol) }
}

/// Shows the glossary with what is looked for.
pub fn show(ctx: &egui::Context, query: &str, commands: &mut Vec<Command>) {
    let colours = palette(ctx.global_style().visuals.dark_mode);
    let room = ctx.content_rect();
    let size = egui::vec2(SIZE[0].min(0.9 * room.width()), SIZE[1].min(0.75 * room.height()));
    let mut open = true;
    egui::Window::new("Glossary")
        .open(&mut open)
        .default_size(size)
        .default_pos(room.center() - 0.5 * size)
        .max_height(0.85 * room.height())
        .collapsible(false)
        .show(ctx, |ui| {
            let mut text = query.to_owned();
            ui.horizontal(|ui| {
                let label = ui.label("Search");
                let field = ui.add(egui::TextEdit::singleline(&mut text).desired_width(f32::INFINITY));
                let field = field.labelled_by(label.id);
                if ui.memory(|memory| memory.focused().is_none()) && query.is_empty() {
                    field.request_focus();
                }
            });
            if text != query {
                commands.push(Command::Teach(Teach::Search(text.clone())));
            }
            ui.add_space(6.0);
            let mut found: Vec<&Term> = terms().iter().filter(|term| term.matches(&text)).collect();
            if !text.trim().is_empty() {
                found.sort_by_key(|term| term.rank(&text));
            }
            egui::ScrollArea::vertical().auto_shrink(false).max_height(size.y).show(ui, |ui| {
                ui.set_max_width(ui.available_width() - 10.0);
                if found.is_empty() {
                    ui.label(RichText::new("No term has all of these words").color(colours.quiet));
                }
                let look = Look::usual(ui);
                for term in found {
                    ui.label(RichText::new(title(term)).strong().color(colours.film));
                    rich::blocks(ui, &term.text, look);
                    ui.add_space(0.8 * look.size);
                }
            });
        });
    if !open {
        commands.push(Command::Teach(Teach::Glossary(false)));
    }
}
