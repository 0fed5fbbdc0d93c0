//! The transient from rest, cycle after cycle as it is computed: how the film pumps up until the cycle repeats.

use crate::export::startup::unsettled;
use crate::gui::command::Command;
use crate::gui::panels::hint::Hint;
use crate::gui::spot;
use crate::gui::starting::{Ask, Starting};
use crate::gui::state::View;
use crate::gui::theme::Palette;
use crate::gui::views;
use crate::job::Run;
use crate::scene::Scene;
use crate::solution::Status;
use eframe::egui::{self, RichText, TextStyle};

/// Height of the plots: their share of the tab, and at least and at most this many lines of text.
const PLOTS_SHARE: f32 = 0.22;
const LINES: (f32, f32) = (6.5, 13.0);

/// What the tab shows.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// The scene as edited.
    pub scene: &'a Scene,
    /// The start-up, if there was one.
    pub starting: Option<&'a Starting>,
    /// The run on screen: what the start-up converges to, if it is of the same scene.
    pub run: Option<&'a Run>,
}

/// Shows the tab.
pub fn show(ui: &mut egui::Ui, shown: &Shown<'_>, colours: &Palette, view: &mut View, commands: &mut Vec<Command>) {
    let height = ui.available_height();
    buttons(ui, shown, commands);
    let Some(starting) = shown.starting else {
        introduction(ui, colours);
        return;
    };
    state(ui, shown, starting, colours);
    if starting.points().is_empty() {
        return;
    }
    let line = ui.text_style_height(&TextStyle::Body);
    let plots = (PLOTS_SHARE * height).clamp(LINES.0 * line, LINES.1 * line);
    let periodic = shown.run.filter(|run| !starting.stale(&run.scene));
    let history = ui.scope(|ui| views::history(ui, starting, periodic, plots, commands));
    spot::mark(ui, "history", history.response.rect);
    if let Some(run) = starting.run() {
        views::show_within(ui, run, starting.ranges(), view, commands);
    }
}

fn buttons(ui: &mut egui::Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        match shown.starting.filter(|starting| starting.running()) {
            Some(_) => {
                if ui.button("Cancel the start-up").hint("Ends it; the cycles computed so far stay").clicked() {
                    commands.push(Command::Startup(Ask::Cancel));
                }
            }
            None => {
                let hover = "Computes every tooth, cycle by cycle, in the background; the window stays usable";
                let button = ui.button("Start from rest").hint(hover);
                spot::mark(ui, "start", button.rect);
                if button.clicked() {
                    commands.push(Command::Startup(Ask::Start));
                }
            }
        }
        let Some(starting) = shown.starting.filter(|starting| starting.run().is_some()) else { return };
        let mut follow = starting.follows();
        let hover = "Shows each cycle as soon as it is computed";
        if ui.checkbox(&mut follow, "Follow the newest cycle").hint(hover).changed() {
            commands.push(Command::Startup(Ask::Follow(follow)));
        }
        let hover = "Plays the cycles that are kept one after the other, from the first";
        if ui.button("Play from rest").hint(hover).clicked() {
            commands.push(Command::Startup(Ask::Replay));
        }
    });
}

fn introduction(ui: &mut egui::Ui, colours: &Palette) {
    ui.add_space(8.0);
    for text in [
        "How does the film come to carry load, from the moment at which the vibration begins?",
        "At t = 0 the gas is at ambient pressure everywhere: the wave stands still, pressed against the rotor (a plate is held \
         at its largest gap). Then it moves. Every tooth is followed, with nothing accelerated, until the cycle repeats; each \
         cycle is shown as soon as it is computed. Nothing is computed before you ask.",
    ] {
        ui.add(egui::Label::new(RichText::new(text).color(colours.quiet)).wrap());
        ui.add_space(4.0);
    }
}

/// How far it is, and of what; then the numbers of the cycle looked at.
fn state(ui: &mut egui::Ui, shown: &Shown<'_>, starting: &Starting, colours: &Palette) {
    let (text, colour) = ending(starting, colours, ui.visuals().text_color());
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(text).color(colour));
        ui.label(RichText::new(format!("computed at {}", starting.fidelity())).color(colours.quiet));
    });
    if starting.stale(shown.scene) {
        let text = format!("Of “{}” before the scene changed; start again", starting.name());
        ui.add(egui::Label::new(RichText::new(text).color(colours.alarm)).wrap());
    }
    if let Some(point) = starting.points().get(starting.chosen().wrapping_sub(1)) {
        let text = format!("Shown is {}", views::words(point, &starting.problem().scenario));
        ui.add(egui::Label::new(text).wrap());
    }
}

/// How far it is, in words.
fn ending(starting: &Starting, colours: &Palette, usual: egui::Color32) -> (String, egui::Color32) {
    let cycles = starting.points().len();
    let remaining = starting.points().last().map_or(f64::INFINITY, |point| point.remaining);
    let open = if remaining.is_finite() {
        format!("not yet repeating, trapped gas may still change by {:.1} %", 100.0 * remaining)
    } else {
        "not yet repeating".to_owned()
    };
    match starting.ended() {
        None if cycles == 0 => ("The first cycle is being computed".to_owned(), usual),
        None => (format!("Cycle {cycles}: {open}"), usual),
        Some(Err(message)) => (message.clone(), colours.alarm),
        Some(Ok(ended)) => match ended.status {
            Status::Converged => (format!("Cycle {cycles}: repeats to {:.1e}", ended.remaining), colours.good),
            Status::Cancelled if cycles == 0 => ("Cancelled in the first cycle".to_owned(), colours.quiet),
            Status::Cancelled => (format!("Cancelled after cycle {cycles}: {open}"), colours.quiet),
            Status::NotConverged { .. } if ended.stats.unsettled_steps > 0 => {
                (format!("Ended after cycle {cycles}: {}", unsettled(ended).unwrap_or_default()), colours.alarm)
            }
            Status::NotConverged { .. } | Status::NotResolved { .. } => {
                (format!("Ended after cycle {cycles}: {open}"), colours.alarm)
            }
        },
    }
}
