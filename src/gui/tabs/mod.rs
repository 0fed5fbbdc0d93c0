//! What can be in the middle of the window, one of them at a time: the motion is in `views`, the others are here.

mod chart;
pub mod exact;
pub mod torque;
pub mod tradeoff;

use super::command::Command;
use super::keys;
use super::state::Tab;
use eframe::egui;

/// The labels above the middle. `plate`: the scene is a plate, which has no torque.
pub fn labels(ui: &mut egui::Ui, present: Tab, plate: bool, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for &(tab, name) in Tab::ALL {
            let name = if tab == Tab::Torque && plate { "Exact" } else { name };
            let label = ui.selectable_label(tab == present, name).on_hover_text(keys::of(&Command::Show(tab)));
            if label.clicked() && tab != present {
                commands.push(Command::Show(tab));
            }
        }
    });
    ui.separator();
}
