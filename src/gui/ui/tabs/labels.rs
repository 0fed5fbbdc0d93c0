//! The tabs' labels, above the middle of the window.

use crate::gui::command::{Command, PinCommand};
use crate::gui::state::view::Tab;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::keys;
use crate::scene::Kind;
use eframe::egui;

/// Windows lower than this have the height of a telephone in landscape format.
pub const LOW: f32 = 480.0;

/// The labels above the middle, and at their right the button that pins the run.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let state = cx.state;
    let (present, pinned, solved) = (state.view.tab, state.pins.runs.len(), state.run.is_some());
    let plate = state.document.scene().kind() == Kind::Plate;
    let labels = |ui: &mut egui::Ui| {
        for &(tab, _) in Tab::ALL.iter().filter(|(tab, _)| tab.is_listed(plate)) {
            let name = tab.label(plate);
            let text = if tab == Tab::Compare && pinned > 0 { format!("{name} ({pinned})") } else { name.to_owned() };
            let label = ui.selectable_label(tab == present, text).hint(keys::about(&Command::Show(tab)));
            if label.clicked() && tab != present {
                cx.push(Command::Show(tab));
            }
        }
        if present != Tab::Compare {
            // The button is below the labels where they leave no space for it.
            let room = ui.available_size_before_wrap().x;
            if room < ui.spacing().interact_size.x {
                ui.end_row();
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let pin = Command::Pin(PinCommand::Shown);
                let about = format!("Keeps this run for comparison ({})", keys::of(&pin));
                cx.on_click(&ui.add_enabled(solved, egui::Button::new("Pin")).hint(about), pin);
            });
        }
    };
    // On a telephone the labels stay on one line, which is scrolled with a finger.
    let row = if ui.ctx().content_rect().height() < LOW {
        egui::ScrollArea::horizontal().id_salt("tabs").show(ui, |ui| ui.horizontal(labels)).inner
    } else {
        ui.horizontal_wrapped(labels)
    };
    cx.name_part(ui, "tabs", row.response.rect);
    ui.separator();
}
