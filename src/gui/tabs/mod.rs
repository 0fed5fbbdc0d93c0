//! What can be in the middle of the window, one of them at a time: the motion is in `views`, the others are here.

pub mod hold;
pub mod startup;
pub mod tradeoff;

use super::command::Command;
use super::keys;
use super::state::Tab;
use eframe::egui;

/// The labels above the middle.
pub fn labels(ui: &mut egui::Ui, present: Tab, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for &(tab, name) in Tab::ALL {
            let label = ui.selectable_label(tab == present, name).on_hover_text(keys::of(&Command::Show(tab)));
            if label.clicked() && tab != present {
                commands.push(Command::Show(tab));
            }
        }
    });
    ui.separator();
}
