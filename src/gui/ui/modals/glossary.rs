//! The glossary as a window that can be searched.

use crate::gui::command::Command;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary::title;
use crate::gui::ui::rich::{self, Look};
use crate::lessons::glossary::{Term, terms};
use eframe::egui::{self, Id, RichText};

const SIZE: [f32; 2] = [440.0, 520.0];

fn search_id() -> Id {
    Id::unique("glossary, search")
}

/// Whether the search field has the keyboard.
pub fn is_searched(ctx: &egui::Context) -> bool {
    ctx.memory(|memory| memory.has_focus(search_id()))
}

/// Shows the glossary with the terms that match `query`.
pub fn show(ctx: &egui::Context, query: &str, cx: &DrawContext<'_>) {
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
                cx.push(Command::SearchGlossary(text.clone()));
            }
            ui.add_space(6.0);
            let mut found: Vec<&Term> = terms().iter().filter(|term| term.matches(&text)).collect();
            if !text.trim().is_empty() {
                found.sort_by_key(|term| term.rank(&text));
            }
            egui::ScrollArea::vertical().auto_shrink(false).max_height(size.y).show(ui, |ui| {
                ui.set_max_width(ui.available_width() - 10.0);
                if found.is_empty() {
                    ui.label(RichText::new("No term has all of these words").color(cx.colours.quiet));
                }
                let look = Look::usual(ui);
                for term in found {
                    ui.label(RichText::new(title(term)).strong().color(cx.colours.film));
                    rich::blocks(ui, &term.text, look);
                    ui.add_space(0.8 * look.size);
                }
            });
        });
    if !open {
        cx.push(Command::Glossary(false));
    }
}
