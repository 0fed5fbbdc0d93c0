//! The sheet of keyboard shortcuts.

use crate::gui::keys::SHORTCUTS;
use eframe::egui;

/// Shows the sheet; false once it is closed.
pub fn show(ctx: &egui::Context) -> bool {
    let response = egui::Modal::new(egui::Id::unique("shortcuts")).show(ctx, |ui| {
        ui.heading("Keyboard shortcuts");
        ui.add_space(8.0);
        egui::Grid::new("shortcut grid").num_columns(2).spacing([24.0, 6.0]).striped(true).show(ui, |ui| {
            for shortcut in SHORTCUTS {
                ui.label(ui.ctx().format_shortcut(&shortcut.keys));
                ui.label(shortcut.about);
                ui.end_row();
            }
        });
        ui.add_space(8.0);
        ui.button("Close").clicked()
    });
    !(response.inner || response.should_close())
}
