//! The glossary in the window: on hover, beside what is pointed at, and as a window that can be searched.

use super::Teach;
use super::rich::{self, Look};
use crate::gui::command::Command;
use crate::gui::panels::hint::{beside_with, describe};
use crate::gui::theme::palette;
use crate::lessons::glossary::{Term, find, terms};
use crate::lessons::text::plain_blocks;
use eframe::egui::{self, Id, RichText, Ui};

/// Widest explanation on hover.
const WIDTH: f32 = 320.0;
/// Size of the window.
const SIZE: [f32; 2] = [440.0, 520.0];

fn unexplained_id() -> Id {
    Id::unique("glossary, unexplained")
}

fn search_id() -> Id {
    Id::unique("glossary, search")
}

/// Whether what is looked for is being typed.
pub fn is_searched(ctx: &egui::Context) -> bool {
    ctx.memory(|memory| memory.has_focus(search_id()))
}

/// Words that were shown and that the glossary does not have: none, which a test asks for.
pub fn unexplained(ctx: &egui::Context) -> Vec<String> {
    ctx.data(|data| data.get_temp::<Vec<String>>(unexplained_id())).unwrap_or_default()
}

/// Explains `word` while the pointer rests on `response`, beside the panel that it is in.
pub fn hover(ui: &Ui, response: egui::Response, word: &str) -> egui::Response {
    explain(ui, response, word, Some(ui.clip_rect()))
}

/// Explains `word` while the pointer rests on `response`, close to it: for the middle of the window.
pub fn here(ui: &Ui, response: egui::Response, word: &str) -> egui::Response {
    explain(ui, response, word, None)
}

/// What is drawn at `place`, the `number`th of its drawing, as something to point at.
pub fn over(ui: &Ui, place: egui::Rect, word: &str, number: usize) -> egui::Response {
    let response = ui.interact(place, ui.scope_id().with(("term", word, number)), egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, format!("About: {word}")));
    response
}

fn explain(ui: &Ui, response: egui::Response, word: &str, panel: Option<egui::Rect>) -> egui::Response {
    match find(word) {
        Some(term) => {
            describe(&response, || format!("{}: {}", title(term), plain_blocks(&term.text)));
            let add = |ui: &mut Ui| {
                ui.set_max_width(WIDTH);
                explanation(ui, term);
            };
            match panel {
                Some(panel) => beside_with(panel, response, add),
                None => response.on_hover_ui(add),
            }
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
                let field = ui.add(egui::TextEdit::singleline(&mut text).id(search_id()).desired_width(f32::INFINITY));
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
