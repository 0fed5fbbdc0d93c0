//! How the residual fell, round by round.

use crate::control::Progress;
use crate::export::figures::convergence;
use crate::gui::ui::chart::Chart;
use eframe::egui;

/// Height of the plot, in lines of text.
const HEIGHT: f32 = 9.0;

/// Shows the rounds of `history`: one line for each grid, and dashed what each had to fall below.
pub fn show(ui: &mut egui::Ui, history: &[Progress]) {
    let panel = &convergence(history).panels[0];
    let height = HEIGHT * ui.text_style_height(&egui::TextStyle::Body);
    let words = (Some("Rounds"), "Change of the last round");
    Chart { name: "Change in each round", height, panel, words }.show(ui);
}
