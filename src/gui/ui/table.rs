//! Tables in tabs.

use super::glossary;
use eframe::egui::{Color32, Grid, RichText, ScrollArea, Ui};

/// A striped table called `name`, with so much room between its columns. Wider than the tab only in a small window with large text: then it
/// is scrolled.
pub(super) fn table(ui: &mut Ui, name: &str, columns: usize, gap: f32, rows: impl FnOnce(&mut Ui)) {
    let grid = Grid::new(name).num_columns(columns).striped(true).spacing([gap, 4.0]);
    ScrollArea::horizontal().id_salt((name, "table")).auto_shrink(true).show(ui, |ui| grid.show(ui, rows));
}

/// Heads of columns, each with what the glossary explains it under; one without words is empty.
pub(super) fn heads(ui: &mut Ui, heads: &[(&str, &str)], colour: Color32) {
    for (head, word) in heads {
        let label = ui.label(RichText::new(*head).color(colour));
        if !word.is_empty() {
            glossary::here(ui, label, word);
        }
    }
}
