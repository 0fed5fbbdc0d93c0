//! The left panel: every parameter of the scene.

use crate::gui::command::Command;
use crate::scene::Scene;
use eframe::egui;
use std::collections::BTreeMap;

/// Texts that were typed and refused, by key, with what is allowed.
pub type Refusals = BTreeMap<&'static str, String>;

/// Shows the parameters of `scene`; `refusals` are shown at their parameters.
pub fn show(ui: &mut egui::Ui, scene: &Scene, refusals: &Refusals, commands: &mut Vec<Command>) {
    let _ = (refusals, commands);
    for parameter in scene.parameters() {
        ui.label(parameter.key);
    }
}
