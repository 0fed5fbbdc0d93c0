//! A plate in the hand: dragged up and down, and the film's answer felt as a force.

use crate::gui::command::Command;
use crate::gui::holding::{Ask, Holding, SECONDS};
use crate::gui::panels::timeline::{thousands, time};
use crate::gui::theme::Palette;
use crate::gui::views;
use eframe::egui::{self, RichText, Slider};

/// What a motor is changed for.
const PRESET: &str = "plate-crossover";
/// Below this share of what was asked for, the film is said to be slower.
const SLOW: f64 = 0.85;

/// Shows the tab.
pub fn show(ui: &mut egui::Ui, holding: Option<&Holding>, colours: &Palette, commands: &mut Vec<Command>) {
    let Some(holding) = holding else {
        ui.add_space(8.0);
        let text = "Only a plate can be held: the teeth of a motor follow their wave. Open a plate to feel how the film answers.";
        ui.add(egui::Label::new(RichText::new(text).color(colours.quiet)).wrap());
        ui.add_space(4.0);
        if ui.button("Open the plate at its crossover").clicked() {
            commands.push(Command::OpenBuiltIn(PRESET));
        }
        return;
    };
    controls(ui, holding, commands);
    pace(ui, holding, colours);
    views::hold(ui, holding, commands);
}

fn controls(ui: &mut egui::Ui, holding: &Holding, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        let [least, most] = holding.reach().map(|gap| gap * 1e6);
        let mut gap = holding.target() * 1e6;
        let label = ui.label("Gap");
        let slider = Slider::new(&mut gap, least..=most).suffix(" µm").max_decimals(3).smart_aim(false);
        if ui.add(slider).labelled_by(label.id).on_hover_text("Or drag the plate, or press ↑ and ↓").changed() {
            commands.push(Command::Hold(Ask::To(gap * 1e-6)));
        }
        let mut seconds = holding.seconds();
        let label = ui.label("Leak time takes");
        let slider = Slider::new(&mut seconds, SECONDS).logarithmic(true).suffix(" s").max_decimals(1);
        if ui.add(slider).labelled_by(label.id).on_hover_text("How slow the slow motion is").changed() {
            commands.push(Command::Hold(Ask::Seconds(seconds)));
        }
        if ui.button("Let go").on_hover_text("Back to the mean gap").clicked() {
            commands.push(Command::Hold(Ask::LetGo));
        }
        if ui.button("Reset").on_hover_text("Mean gap, ambient pressure, empty charts").clicked() {
            commands.push(Command::Hold(Ask::Reset));
        }
    });
}

/// How slow the slow motion is, always; and whether this computer keeps up.
fn pace(ui: &mut egui::Ui, holding: &Holding, colours: &Palette) {
    let quiet = |text: String| RichText::new(text).color(colours.quiet);
    ui.horizontal_wrapped(|ui| {
        let leak = time(holding.leak_time());
        ui.label(format!("Slowed {}×", thousands(holding.slowed())));
        ui.label(quiet(format!(
            "the film's leak time at the mean gap is {leak}, and takes {:.1} s here",
            holding.seconds()
        )));
        let now = holding.now();
        if now.pace < SLOW {
            let text = format!("this computer takes {:.1} times as long", 1.0 / now.pace.max(1e-3));
            ui.label(RichText::new(text).color(colours.alarm));
        }
        if let Some(failure) = &now.failure {
            ui.label(RichText::new(failure).color(colours.alarm));
        }
    });
}
