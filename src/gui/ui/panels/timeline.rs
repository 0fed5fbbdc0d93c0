//! The bottom panel: the timeline of the cycle or of a held plate, and the state of the solver.

use crate::digits::{duration, percent};
use crate::fidelity::Fidelity;
use crate::gui::command::{Command, HoldCommand};
use crate::gui::derived::format::{thousands, time};
use crate::gui::derived::words::without_keys;
use crate::gui::state::hold::HoldState;
use crate::gui::state::view::Tab;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::form::show_list;
use crate::gui::ui::glossary::Explained;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::keys;
use crate::platform::SOLVED_HERE;
use crate::solution::{Accuracy, Status, StoppedBy};
use eframe::egui::{self, ProgressBar, RichText, Slider};

/// Seconds on screen for one cycle that can be chosen.
const SPEEDS: [f64; 6] = [0.5, 1.5, 3.0, 6.0, 12.0, 30.0];

/// Play, step, scrub and speed.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    if let (Tab::Hold, Some(hold)) = (cx.state.view.tab, &cx.state.hold) {
        return of_held(ui, hold, cx);
    }
    let Some(recording) = cx.state.on_timeline() else { return };
    let (periods, view) = (cx.state.periods(recording), &cx.state.view);
    ui.add_space(2.0);
    let (frames, place) = (recording.frames.max(1) as f64, view.place(recording));
    let row = ui.horizontal(|ui| {
        play_and_step(ui, view.playing, cx);
        // Whether all runs that are animated have the same period.
        let alike = periods[1] / periods[0] - 1.0 < 1e-9;
        let slowed = |seconds: f64| {
            let [most, least] = periods.map(|period| thousands(seconds / period));
            if alike { format!("slowed {most}×") } else { format!("slowed {least} to {most}×") }
        };
        let speed = egui::ComboBox::from_id_salt("speed").selected_text(slowed(view.seconds_per_cycle));
        let speed = show_list(ui, speed, |ui| {
            for seconds in SPEEDS {
                let text = format!("one cycle in {seconds} s, {}", slowed(seconds));
                let entry = ui.selectable_label(seconds == view.seconds_per_cycle, text);
                cx.on_click(&entry, Command::SecondsPerCycle(seconds));
            }
        });
        speed.called(egui::Role::Slider, "Speed").explained_here(ui, "Slow motion");
        if let Some(at) = scrub(ui, place, frames, ["Time in the cycle", "Drag to an instant of the cycle"]) {
            // The slider stops at recorded frames; the end of the cycle is its start.
            cx.push(Command::Seek(at.round().clamp(0.0, frames - 1.0) / frames));
        }
        let phase = place / frames;
        let degrees = (360.0 * phase).round() % 360.0;
        ui.label(if alike {
            format!("t = {}  ({degrees:.0}°)", time(recording.period * phase))
        } else {
            format!("{degrees:.0}° of each cycle")
        });
    });
    cx.name_part(ui, "timeline", row.response.rect);
}

/// Controls to pause, step and scrub the recent recording of a held plate.
fn of_held(ui: &mut egui::Ui, hold: &HoldState, cx: &DrawContext<'_>) {
    ui.add_space(2.0);
    let newest = hold.trail().len().saturating_sub(1);
    let row = ui.horizontal(|ui| {
        play_and_step(ui, hold.playing, cx);
        let hover = "Replays what the charts show, in slow motion; the plate waits meanwhile";
        cx.on_click(&ui.add_enabled(newest > 0, egui::Button::new("Replay")).hint(hover), HoldCommand::Replay);
        let most = newest.max(1) as f64;
        let place = if newest == 0 { most } else { hold.place() as f64 };
        if let Some(at) = scrub(ui, place, most, ["Recorded time", "Drag to an instant that was recorded"]) {
            cx.push(Command::Seek(at / most));
        }
        let ago = hold.now.reading.time - hold.shown().reading.time;
        ui.label(match (ago > 0.0, hold.playing) {
            (true, _) => format!("{} ago", time(ago)),
            (false, true) => "now".to_owned(),
            (false, false) => "paused".to_owned(),
        });
    });
    cx.name_part(ui, "timeline", row.response.rect);
}

fn play_and_step(ui: &mut egui::Ui, playing: bool, cx: &DrawContext<'_>) {
    let play = if playing { "Pause" } else { "Play" };
    let button = ui.add_sized([64.0, ui.spacing().interact_size.y], egui::Button::new(play));
    cx.on_click(&button.hint(keys::about(&Command::TogglePlay)), Command::TogglePlay);
    for (arrow, by) in [("◀", -1), ("▶", 1)] {
        cx.button(ui, arrow, keys::about(&Command::StepFrames(by)), Command::StepFrames(by));
    }
}

/// A slider from 0 to `most` that fills the row except for a label. Returns the position it was dragged to.
fn scrub(ui: &mut egui::Ui, mut at: f64, most: f64, [called, hover]: [&str; 2]) -> Option<f64> {
    ui.spacing_mut().slider_width = (ui.available_width() - 190.0).max(60.0);
    let slider = Slider::new(&mut at, 0.0..=most).clamping(egui::SliderClamping::Never).show_value(false);
    ui.add(slider.smart_aim(false)).called(egui::Role::Slider, called).hint(hover).changed().then_some(at)
}

/// Fidelity, error, time; progress and cancel while something runs.
pub fn status(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let (run, activity) = (cx.state.run.as_deref(), &cx.state.activity);
    ui.horizontal(|ui| {
        if let Some(run) = run {
            let Accuracy { stated, stopped_by, .. } = run.solution.accuracy;
            let error = if stated.is_finite() { format!("error {}, ", percent(stated)) } else { String::new() };
            let stale = cx.state.stale(run);
            let ended = if run.solution.status == Status::Converged && !stale { "converged, " } else { "" };
            let cut = if stopped_by == StoppedBy::Budget { " as far as time allowed" } else { "" };
            let took = if run.wall_s < 1.0 { format!("{:.1} ms", 1e3 * run.wall_s) } else { duration(run.wall_s) };
            let text = format!("Shown: {}{cut}, {ended}{error}solved{SOLVED_HERE} in {took}", run.fidelity);
            ui.label(text).explained(ui, "Fidelity");
            match run.solution.status {
                Status::NotConverged { .. } => drop(ui.label(RichText::new("not converged").color(cx.colours.alarm))),
                Status::NotResolved { .. } => drop(ui.label(RichText::new("not resolved").color(cx.colours.alarm))),
                _ => {}
            }
            if stale {
                ui.label(RichText::new("of the scene before this edit").weak());
            }
        } else {
            ui.label("Nothing solved yet");
        }
        if let Some(message) = &activity.failure {
            // A long message is shown in full on hover, with the keys as they are in a file.
            let words = RichText::new(without_keys(message)).color(cx.colours.alarm);
            ui.add(egui::Label::new(words).truncate()).hint(message);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if let Some(running) = &activity.running {
                cx.button(ui, "Cancel", keys::about(&Command::CancelSolve), Command::CancelSolve);
                ui.add(ProgressBar::new(running.round.fraction() as f32).desired_width(120.0));
                ui.label(running.text());
            } else if run.is_some_and(|run| run.fidelity < Fidelity::Reference && !cx.state.stale(run)) {
                let text = "Solve for reference";
                let hover = "Takes some seconds and reduces the error to a few millionths";
                cx.on_click(&ui.small_button(text).hint(hover), Command::Refine(Fidelity::Reference));
            }
        });
    });
}
