//! A plate in the hand: dragged up and down, and the film's answer felt as a force.

use crate::gui::command::Command;
use crate::gui::holding::{Ask, Holding, SECONDS};
use crate::gui::lessons::glossary;
use crate::gui::panels::hint::Hint;
use crate::gui::panels::timeline::{thousands, time};
use crate::gui::theme::Palette;
use crate::gui::views;
use eframe::egui::{self, Color32, RichText, Slider, TextStyle};

/// What a motor is changed for.
const PRESET: &str = "plate-crossover";
/// Below this share of what was asked for, the film is said to be slower.
const SLOW: f64 = 0.85;
/// Widest slider, and what stands beside either, in heights of the text.
const WIDEST: f32 = 18.0;
const BESIDE_GAP: f32 = 18.0;
const BESIDE_SECONDS: f32 = 21.0;

/// Shows the tab.
pub fn show(ui: &mut egui::Ui, holding: Option<&Holding>, colours: &Palette, commands: &mut Vec<Command>) {
    let Some(holding) = holding else {
        ui.add_space(8.0);
        let text = "Only a plate can be held: the teeth of a motor follow their wave. Open a plate to feel how the film answers.";
        ui.add(egui::Label::new(RichText::new(text).color(colours.quiet)).wrap());
        ui.add_space(4.0);
        let hover = "A built-in preset: some of its gas escapes, some is squeezed";
        if ui.button("Open the plate at its crossover").hint(hover).clicked() {
            commands.push(Command::OpenBuiltIn(PRESET));
        }
        return;
    };
    controls(ui, holding, commands);
    pace(ui, holding, colours);
    views::hold(ui, holding, commands);
}

fn controls(ui: &mut egui::Ui, holding: &Holding, commands: &mut Vec<Command>) {
    let em = ui.text_style_height(&TextStyle::Body);
    // Sliders do not go to the next row: they take what is left of theirs.
    let room = |ui: &egui::Ui, others: f32| (ui.available_width() - others * em).clamp(2.0 * em, WIDEST * em);
    ui.horizontal(|ui| {
        let [least, most] = holding.reach().map(|gap| gap * 1e6);
        let mut gap = holding.target() * 1e6;
        ui.spacing_mut().slider_width = room(ui, BESIDE_GAP);
        let label = ui.label("Gap");
        let label = glossary::here(ui, label, "Gap");
        let slider = Slider::new(&mut gap, least..=most).suffix(" µm").max_decimals(3).smart_aim(false);
        if ui.add(slider).labelled_by(label.id).hint("Or drag the plate, or press ↑ and ↓").changed() {
            commands.push(Command::Hold(Ask::To(gap * 1e-6)));
        }
        if ui.button("Let go").hint("Back to the mean gap").clicked() {
            commands.push(Command::Hold(Ask::LetGo));
        }
        if ui.button("Reset").hint("Mean gap, ambient pressure, empty charts").clicked() {
            commands.push(Command::Hold(Ask::Reset));
        }
    });
    ui.horizontal(|ui| {
        let mut seconds = holding.seconds();
        ui.spacing_mut().slider_width = room(ui, BESIDE_SECONDS);
        let label = ui.label("Leak time takes");
        let label = glossary::here(ui, label, "Leak time");
        let slider = Slider::new(&mut seconds, SECONDS).logarithmic(true).suffix(" s").max_decimals(1);
        if ui.add(slider).labelled_by(label.id).hint("How slow the slow motion is").changed() {
            commands.push(Command::Hold(Ask::Seconds(seconds)));
        }
        let label = ui.label(format!("slowed {}×", thousands(holding.slowed())));
        glossary::here(ui, label, "Slow motion");
    });
}

/// How slow the slow motion is, in words; and whether this computer keeps up.
fn pace(ui: &mut egui::Ui, holding: &Holding, colours: &Palette) {
    let words = |ui: &mut egui::Ui, text: String, colour: Color32| {
        ui.add(egui::Label::new(RichText::new(text).color(colour)).wrap());
    };
    let leak = time(holding.leak_time());
    words(ui, format!("The film's leak time at the mean gap is {leak}. Drag the plate."), colours.quiet);
    let now = holding.now();
    if now.pace < SLOW {
        let text = format!("This computer takes {:.1} times as long as that", 1.0 / now.pace.max(1e-3));
        words(ui, text, colours.alarm);
    }
    if let Some(failure) = &now.failure {
        words(ui, failure.clone(), colours.alarm);
    }
}
