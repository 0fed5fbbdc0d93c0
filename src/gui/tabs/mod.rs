//! What can be in the middle of the window, one of them at a time: the motion is in `views`, the others are here.

pub mod compare;
pub mod sweep;
pub mod tradeoff;

use super::command::Command;
use super::keys;
use super::pinned::Pinning;
use super::state::Tab;
use eframe::egui;

/// The labels above the middle, and at their right what pins the run. `pinned`: how many runs are pinned.
pub fn labels(ui: &mut egui::Ui, present: Tab, pinned: usize, solved: bool, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for &(tab, name) in Tab::ALL {
            let text = if tab == Tab::Compare && pinned > 0 { format!("{name} ({pinned})") } else { name.to_owned() };
            let label = ui.selectable_label(tab == present, text).on_hover_text(keys::of(&Command::Show(tab)));
            if label.clicked() && tab != present {
                commands.push(Command::Show(tab));
            }
        }
        if present != Tab::Compare {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let pin = Command::Pin(Pinning::Shown);
                let about = format!("Keeps this run for comparison ({})", keys::of(&pin));
                if ui.add_enabled(solved, egui::Button::new("Pin")).on_hover_text(about).clicked() {
                    commands.push(pin);
                }
            });
        }
    });
    ui.separator();
}
