//! A held plate: it is dragged up and down, and the film answers with a force.

use crate::gui::command::HoldCommand;
use crate::gui::derived::format::{thousands, time};
use crate::gui::state::document::Next;
use crate::gui::state::hold::{HoldState, SECONDS};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::parts::number_box;
use crate::gui::ui::tabs::labels::LOW;
use crate::gui::ui::{glossary, views};
use crate::hold::{STRUCK, leak_time};
use eframe::egui::{self, DragValue, Slider, TextStyle};

/// Preset that is offered while the scene is a motor.
const PRESET: &str = "plate-crossover";
/// The film is reported as slower than real time below this share of the requested speed.
const SLOW: f64 = 0.85;
/// Decimals of the gap in µm.
const GAP_DECIMALS: usize = 3;
/// Change of a number for each point that its box is dragged, relative to its range or to itself.
const SPEED: f64 = 5e-3;
/// Greatest and least width of the slider, and the width of the widgets beside it, in heights of the text.
const WIDEST: f32 = 18.0;
const NARROWEST: f32 = 5.0;
const BESIDE_GAP: f32 = 18.0;
const BESIDE_SECONDS: f32 = 21.0;

/// Shows the tab.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let Some(hold) = &cx.state.hold else {
        if cx.state.document.scene().floats() {
            return cx.introduce(ui, &["Solving…"]);
        }
        let text = "Only a plate can be held: the teeth of a motor follow their wave. Open a plate to feel how the film answers.";
        cx.introduce(ui, &[text]);
        let hover = "A built-in preset in which part of the gas escapes and part is compressed";
        return cx.button(ui, "Open the plate at its crossover", hover, Next::Preset(PRESET));
    };
    controls(ui, hold, cx);
    if ui.ctx().content_rect().height() >= LOW {
        pace(ui, hold, cx);
    }
    views::hold::show(ui, hold, cx);
}

fn controls(ui: &mut egui::Ui, hold: &HoldState, cx: &DrawContext<'_>) {
    ui.horizontal(|ui| {
        let [least, most] = hold.reach().map(|gap| gap * 1e6);
        // These are rounded as the slider rounds them, including the ends of its range; otherwise drawing the slider could hold a plate
        // that falls.
        let digits = 10f64.powi(GAP_DECIMALS as i32);
        let (least, most) = ((least * digits).ceil() / digits, (most * digits).floor() / digits);
        let gap = egui::emath::round_to_decimals(hold.target * 1e6, GAP_DECIMALS);
        let mut gap = gap.max(least).min(most);
        let label = glossary::term(ui, "Gap", "Gap");
        let slider = |gap| Slider::new(gap, least..=most).max_decimals(GAP_DECIMALS).smart_aim(false);
        let moved = slide(ui, &mut gap, slider, BESIDE_GAP).map(|slider| slider.labelled_by(label.id));
        let number = DragValue::new(&mut gap).suffix(" µm").max_decimals(GAP_DECIMALS).speed(SPEED * (most - least));
        let number = number_box(ui, number, (least..=most, "µm"), cx).labelled_by(label.id);
        for changed in moved.into_iter().chain([number]) {
            cx.on_change(&changed.hint("Or drag the plate, or press ↑ and ↓"), HoldCommand::To(gap * 1e-6));
        }
        let floats = hold.plate.load.is_some();
        let hint = if floats { "It falls, and floats where its vibration carries it" } else { "Back to the mean gap" };
        let (text, about, vibrates) = match hold.free {
            Some(true) => ("Stop", "The vibration ends, and the plate sinks", false),
            Some(false) => ("Vibrate", "The vibration begins again", true),
            None => ("Let go", hint, true),
        };
        cx.button(ui, text, about, HoldCommand::LetGo { vibrates });
        cx.button(ui, "Reset", "Mean gap, ambient pressure, empty charts", HoldCommand::Reset);
    });
    ui.horizontal(|ui| {
        let mut seconds = hold.seconds;
        let label = glossary::term(ui, "Leak time takes", "Leak time");
        let slider = |seconds| Slider::new(seconds, SECONDS).logarithmic(true).max_decimals(1);
        let moved = slide(ui, &mut seconds, slider, BESIDE_SECONDS).map(|slider| slider.labelled_by(label.id));
        let number = DragValue::new(&mut seconds).suffix(" s").max_decimals(2).speed(SPEED * hold.seconds);
        let number = number_box(ui, number, (SECONDS, "s"), cx).labelled_by(label.id);
        for changed in moved.into_iter().chain([number]) {
            cx.on_change(&changed.hint("How slow the slow motion is"), HoldCommand::Seconds(seconds));
        }
        glossary::term(ui, format!("slowed {}×", thousands(hold.slowed())), "Slow motion");
    });
}

/// A slider that fills the remaining width of a row, which is given in heights of the text; `None` if that is too short.
fn slide<'v>(
    ui: &mut egui::Ui,
    value: &'v mut f64,
    slider: impl FnOnce(&'v mut f64) -> Slider<'v>,
    others: f32,
) -> Option<egui::Response> {
    let em = ui.text_style_height(&TextStyle::Body);
    let room = ui.available_width() - others * em;
    ui.spacing_mut().slider_width = room.min(WIDEST * em);
    (room > NARROWEST * em).then(|| ui.add(slider(value).show_value(false)))
}

/// How slow the slow motion is, in words, and whether this computer can keep up.
fn pace(ui: &mut egui::Ui, hold: &HoldState, cx: &DrawContext<'_>) {
    let leak = time(leak_time(&hold.plate, hold.plate.mean_gap));
    cx.note(ui, format!("The film's leak time at the mean gap is {leak}. Drag the plate."));
    let now = &hold.now;
    let longer = 1.0 / now.pace.max(1e-3);
    let slow = (now.pace < SLOW)
        .then(|| format!("This computer is slower than real time: it takes {longer:.1} times as long"));
    let floating = hold.plate.load.is_some() && hold.plate == hold.plate.resting();
    let rests =
        floating.then_some("It does not float: its mean gap here is that at which it would rest on its roughness");
    let struck = now.struck.then_some(STRUCK);
    cx.alarm(ui, slow.as_deref().into_iter().chain(rests).chain(struck).chain(now.failure.as_deref()));
}
