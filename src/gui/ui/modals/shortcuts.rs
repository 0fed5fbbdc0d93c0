//! The sheet of keyboard shortcuts.

use super::frame;
use crate::gui::command::Command;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::keys::{self, GROUPS, Shortcut, WINDOW};
use eframe::egui::gui_zoom::kb_shortcuts::{ZOOM_IN, ZOOM_OUT, ZOOM_RESET};
use eframe::egui::{self, RichText, TextStyle};

/// Distance between the two columns, and between a key and its description.
const GAP: f32 = 28.0;

/// Shows the sheet.
pub fn show(ctx: &egui::Context, cx: &DrawContext<'_>) {
    let response = egui::Modal::new(egui::Id::unique("shortcuts")).frame(frame(ctx)).show(ctx, |ui| {
        ui.heading("Keyboard shortcuts");
        ui.add_space(10.0);
        // Two columns of nearly equal length.
        let rows =
            |groups: &[(&str, &[Shortcut])]| groups.iter().map(|(_, shortcuts)| shortcuts.len() + 2).sum::<usize>();
        let sides = (0..GROUPS.len()).map(|at| GROUPS.split_at(at));
        let columns = sides.min_by_key(|(left, right)| rows(left).max(rows(right))).unwrap_or_default();
        // All keys have one width, so that their descriptions are aligned.
        let font = TextStyle::Monospace.resolve(ui.style());
        let width = |shortcut: &Shortcut| {
            let text = keys::name(&shortcut.keys);
            ui.painter().layout_no_wrap(text, font.clone(), egui::Color32::PLACEHOLDER).size().x
        };
        let widest = GROUPS.iter().flat_map(|(_, shortcuts)| shortcuts.iter()).map(width).fold(0.0, f32::max);
        ui.spacing_mut().scroll = egui::style::ScrollStyle::solid();
        let height = 0.75 * ctx.content_rect().height();
        egui::ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                for (i, groups) in [columns.0, columns.1].into_iter().enumerate() {
                    if i > 0 {
                        ui.add_space(GAP);
                    }
                    ui.vertical(|ui| {
                        groups.iter().for_each(|(title, shortcuts)| group(ui, title, shortcuts, widest, cx))
                    });
                }
            });
        });
        ui.add_space(6.0);
        ui.button("Close").clicked()
    });
    if response.inner || response.should_close() {
        cx.push(Command::ToggleShortcuts);
    }
}

fn group(ui: &mut egui::Ui, title: &str, shortcuts: &[Shortcut], widest: f32, cx: &DrawContext<'_>) {
    ui.label(RichText::new(title).color(cx.colours.quiet));
    let grid = egui::Grid::new(("shortcuts", title)).num_columns(2).min_col_width(widest).spacing([GAP / 2.0, 5.0]);
    grid.show(ui, |ui| {
        let own = shortcuts.iter().map(|shortcut| (shortcut.keys, shortcut.also, shortcut.about));
        // These shortcuts are egui's own.
        let zoom = [(ZOOM_IN, "Larger"), (ZOOM_OUT, "Smaller"), (ZOOM_RESET, "Usual size")];
        let zoom = zoom.into_iter().filter(|_| title == WINDOW).map(|(keys, about)| (keys, None, about));
        for (keys, also, about) in own.chain(zoom) {
            ui.label(RichText::new(keys::name(&keys)).monospace().strong());
            let also = also.map_or_else(String::new, |keys| format!(" (also {})", keys::name(&keys)));
            ui.add(egui::Label::new(format!("{about}{also}")).extend());
            ui.end_row();
        }
    });
    ui.add_space(12.0);
}
