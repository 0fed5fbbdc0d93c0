//! The transient from rest, cycle after cycle as it is computed: how the film pumps up until the cycle repeats.

use super::dropped;
use crate::digits::percent;
use crate::export::startup::unsettled;
use crate::gui::command::{Command, StartupCommand};
use crate::gui::state::dialogs::Export;
use crate::gui::state::startup::StartupState;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::panels::menu::export_button;
use crate::gui::ui::parts::first_button;
use crate::gui::ui::views;
use crate::scene;
use crate::solution::Status;
use crate::startup::Settings;
use eframe::egui::{self, RichText, TextStyle};

/// Height of the plots: their share of the tab, and at least and at most this many lines of text.
const PLOTS_SHARE: f32 = 0.22;
const LINES: (f32, f32) = (6.5, 13.0);

/// Shows the tab.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    if cx.state.document.scene().floats() {
        return dropped::show(ui, cx);
    }
    let height = ui.available_height();
    buttons(ui, cx);
    let Some(startup) = &cx.state.startup else { return introduction(ui, cx) };
    state(ui, startup, cx);
    if startup.points.is_empty() {
        return;
    }
    let line = ui.text_style_height(&TextStyle::Body);
    let plots = (PLOTS_SHARE * height).clamp(LINES.0 * line, LINES.1 * line);
    let periodic = cx.state.run.as_deref().filter(|run| !startup.transient.stale(&run.scene));
    let history = ui.scope(|ui| views::history::show(ui, startup, periodic, plots, cx));
    cx.name_part(ui, "history", history.response.rect);
    if let Some(run) = startup.run() {
        views::run::show(ui, run, startup.ranges, None, cx);
    }
}

fn buttons(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        if cx.state.startup.as_ref().is_some_and(|startup| startup.transient.work.running()) {
            let about = "Ends it; the cycles computed so far stay";
            cx.button(ui, "Cancel the start-up", about, Command::CancelTab);
        } else {
            let hover = "Computes every tooth, cycle by cycle, in the background; the window stays usable";
            let button = first_button(ui, "Start from rest", (cx.state.startup.is_none(), true), cx).hint(hover);
            cx.name_part(ui, "start", button.rect);
            cx.lead_to(ui, "start", button.id);
            cx.on_click(&button, StartupCommand::Start);
        }
        let Some(startup) = cx.state.startup.as_ref().filter(|startup| startup.run().is_some()) else { return };
        let mut follow = startup.follows_newest;
        let hover = "Shows each cycle as soon as it is computed";
        let checkbox = ui.checkbox(&mut follow, "Follow the newest cycle").hint(hover);
        cx.on_change(&checkbox, StartupCommand::Follow(follow));
        let hover = "Plays the cycles that are kept one after the other, from the first";
        cx.button(ui, "Play from rest", hover, StartupCommand::Replay);
        export_button(ui, &[Export::Startup], cx);
    });
}

fn introduction(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let rest = match cx.state.document.scene().kind() {
        scene::Kind::Motor => {
            "the wave stands still, pressed against the rotor. Then it moves. Every tooth is followed until"
        }
        scene::Kind::Plate => "the plate rests at its mean gap. Then it moves, away from the wall at first, until",
    };
    let paragraphs = [
        "How does the film come to carry load, from the moment at which the vibration begins?",
        &format!(
            "At first the gas is at ambient pressure everywhere, and {rest} the cycle repeats. Each cycle is shown as soon as it is \
             computed. Nothing is computed before you ask."
        ),
    ];
    cx.introduce(ui, &paragraphs);
}

/// The progress and the scene of the start-up, and the numbers of the cycle on screen.
fn state(ui: &mut egui::Ui, startup: &StartupState, cx: &DrawContext<'_>) {
    let (text, colour) = ending(startup, cx, ui.visuals().text_color());
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(text).color(colour));
        ui.label(RichText::new(format!("computed at {}", startup.transient.fidelity)).color(cx.colours.quiet));
    });
    if let Some(Ok(ended)) = &startup.transient.ended {
        cx.warn(ui, &ended.warnings);
    }
    let (name, stale) = (startup.transient.posed.scene.headline(), startup.transient.stale(cx.state.document.scene()));
    cx.alarm(ui, stale.then(|| format!("Of “{name}” before the scene changed; start again")));
    if let Some(row) = startup.points.get(startup.chosen.wrapping_sub(1)) {
        let text = format!("Shown is {}", views::history::words(row));
        ui.add(egui::Label::new(text).wrap());
    }
}

/// The progress or the outcome, in words.
fn ending(startup: &StartupState, cx: &DrawContext<'_>, usual: egui::Color32) -> (String, egui::Color32) {
    let cycles = startup.points.len();
    let remaining = startup.points.last().and_then(|row| row.remaining).unwrap_or(f64::INFINITY);
    let open = if remaining.is_finite() {
        format!("not yet repeating, trapped gas may still change by {:.1} %", 100.0 * remaining)
    } else {
        "not yet repeating".to_owned()
    };
    match &startup.transient.ended {
        None if cycles == 0 => ("The first cycle is being computed".to_owned(), usual),
        None if remaining < Settings::default().tolerance => {
            (format!("Cycle {cycles}: repeats; cycles follow on finer grids"), usual)
        }
        None => (format!("Cycle {cycles}: {open}"), usual),
        Some(Err(message)) => (message.clone(), cx.colours.alarm),
        Some(Ok(ended)) => match ended.status {
            Status::Converged => {
                let of_present = !startup.transient.stale(cx.state.document.scene());
                let colour = if of_present { cx.colours.good } else { cx.colours.quiet };
                (format!("Cycle {cycles}: repeats within {}", percent(ended.remaining)), colour)
            }
            Status::Cancelled if cycles == 0 => ("Cancelled in the first cycle".to_owned(), cx.colours.quiet),
            Status::Cancelled => (format!("Cancelled after cycle {cycles}: {open}"), cx.colours.quiet),
            Status::NotConverged { .. } if ended.stats.unsettled_steps > 0 => {
                (format!("Ended after cycle {cycles}: {}", unsettled(ended).unwrap_or_default()), cx.colours.alarm)
            }
            Status::NotConverged { .. } | Status::NotResolved { .. } => {
                (format!("Ended after cycle {cycles}: {open}"), cx.colours.alarm)
            }
        },
    }
}
