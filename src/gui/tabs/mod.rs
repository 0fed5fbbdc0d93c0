//! What can be in the middle of the window, one of them at a time: the motion is in `views`, the others are here.

mod chart;
pub mod compare;
pub mod exact;
pub mod hold;
pub mod startup;
pub mod sweep;
pub mod torque;
pub mod tradeoff;

use super::command::Command;
use super::keys;
use super::panels::hint::Hint;
use super::pinned::Pinning;
use super::state::Tab;
use eframe::egui;

/// What the labels show.
#[derive(Clone, Copy, Debug)]
pub struct Bar {
    /// The tab shown.
    pub present: Tab,
    /// How many runs are pinned.
    pub pinned: usize,
    /// There is a run to pin.
    pub solved: bool,
    /// The scene is a plate, which has no torque.
    pub plate: bool,
}

/// The labels above the middle, and at their right what pins the run.
pub fn labels(ui: &mut egui::Ui, bar: &Bar, commands: &mut Vec<Command>) {
    let &Bar { present, pinned, solved, plate } = bar;
    let row = ui.horizontal_wrapped(|ui| {
        for &(tab, _) in Tab::ALL {
            let name = tab.label(plate);
            let text = if tab == Tab::Compare && pinned > 0 { format!("{name} ({pinned})") } else { name.to_owned() };
            let label = ui.selectable_label(tab == present, text).hint(keys::about(&Command::Show(tab)));
            if label.clicked() && tab != present {
                commands.push(Command::Show(tab));
            }
        }
        if present != Tab::Compare {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let pin = Command::Pin(Pinning::Shown);
                let about = format!("Keeps this run for comparison ({})", keys::of(&pin));
                if ui.add_enabled(solved, egui::Button::new("Pin")).hint(about).clicked() {
                    commands.push(pin);
                }
            });
        }
    });
    super::spot::mark(ui, "tabs", row.response.rect);
    ui.separator();
}
