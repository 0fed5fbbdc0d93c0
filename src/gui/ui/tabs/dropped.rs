//! A plate under a load, dropped on its vibration: its height over time, until it floats or rests.

use crate::digits::{percent, significant};
use crate::estimate::Estimate;
use crate::export::fall::panel;
use crate::fall::{Fall, struck};
use crate::gui::command::{Command, StartupCommand};
use crate::gui::state::dialogs::Export;
use crate::gui::state::transient::Dropped;
use crate::gui::ui::chart::Chart;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::panels::menu::export_button;
use crate::solution::{Outcome, Status};
use crate::startup::Settings;
use eframe::egui::{self, Color32, RichText};

/// Height of the chart, a share of the tab.
const SHARE: f32 = 0.75;

pub(super) fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let height = SHARE * ui.available_height();
    let dropped = cx.state.dropped.as_ref();
    ui.horizontal_wrapped(|ui| {
        if dropped.is_some_and(|dropped| dropped.work.running()) {
            cx.button(ui, "Cancel", "Ends the drop; the motion so far is kept", Command::CancelTab);
        } else {
            let button = ui.button("Drop it").hint("Lets the plate fall from twice the gap at which it floats");
            cx.name_part(ui, "start", button.rect);
            cx.lead_to(ui, "start", button.id);
            cx.on_click(&button, StartupCommand::Start);
        }
        export_button(ui, &[Export::Startup], cx);
    });
    let Some(dropped) = dropped else {
        return cx.introduce(ui, &[
            "What does a plate under a load do when it is dropped on the vibration?",
            "It falls from rest, at twice the gap at which it floats, through gas at ambient pressure, while the vibration comes up. Its \
             motion is computed with time steps of two lengths; the difference is the error of the height. In the tab Hold it \
             can be pushed by hand and let go, in slow motion.",
        ]);
    };
    let (text, colour) = ending(dropped, cx, ui.visuals().text_color());
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(text).color(colour));
        ui.label(RichText::new(format!("computed at {}", dropped.fidelity)).color(cx.colours.quiet));
    });
    let stale = dropped.stale(cx.state.document.scene());
    cx.alarm(ui, stale.then_some("Computed before the scene changed; drop it again"));
    if dropped.cycles.len() > 1 {
        way(ui, dropped, height, cx);
    }
}

/// Height over time as in the exported figure, with the mean gap of the periodic solve.
fn way(ui: &mut egui::Ui, dropped: &Dropped, height: f32, cx: &DrawContext<'_>) {
    let panel = panel(&dropped.cycles, periodic(dropped, cx).map(|gap| gap * 1e6));
    cx.note(ui, "Height of the plate, µm");
    let (name, words) = ("Height of the plate over time", (None, "Floating plate"));
    Chart { name, height, panel: &panel, words }.show(ui);
}

/// The mean gap of the periodic solve: after the end of the drop, that of its own solve; before, that of the run on screen.
fn periodic(dropped: &Dropped, cx: &DrawContext<'_>) -> Option<Estimate> {
    if let Some(ended) = &dropped.ended {
        return ended.as_ref().ok()?.floats.as_ref().ok().copied();
    }
    let run = cx.state.run.as_deref().filter(|run| !dropped.stale(&run.scene))?;
    match run.solution.outcome {
        Outcome::Plate(plate) => plate.floating.map(|floating| floating.mean_gap),
        Outcome::Motor(_) => None,
    }
}

/// The progress or the outcome, in words.
fn ending(dropped: &Dropped, cx: &DrawContext<'_>, usual: Color32) -> (String, Color32) {
    let last = dropped.cycles.last();
    let at = last.map_or_else(String::new, |cycle| {
        let (time, height) = (significant(1e3 * cycle.time, 3), cycle.height);
        format!("{time} ms: height {} µm", height * 1e6)
    });
    let hit = struck(&dropped.cycles).map_or_else(String::new, |words| format!(". {words}"));
    let steady = periodic(dropped, cx).map_or_else(String::new, |gap| {
        format!("; the periodic solve, in which it does not shake, gives {} µm (dashed)", gap * 1e6)
    });
    match &dropped.ended {
        None if last.is_none() => ("The gap at which it floats is being computed".to_owned(), usual),
        None => (format!("{at}{steady}"), usual),
        Some(Err(message)) => (message.clone(), cx.colours.alarm),
        Some(Ok(Fall { status, .. })) => {
            let rests = last.is_some_and(|cycle| cycle.rests);
            match status {
                Status::Converged if rests => (format!("{at}. It rests on its roughness"), cx.colours.alarm),
                Status::Converged => {
                    let within = percent(Settings::default().tolerance);
                    (format!("{at}. It floats, within {within} of where it settles{steady}{hit}"), cx.colours.good)
                }
                Status::Cancelled => (format!("Cancelled at {at}"), cx.colours.quiet),
                Status::NotConverged { .. } => (format!("{at}. It still moves{steady}{hit}"), cx.colours.alarm),
                Status::NotResolved { .. } => {
                    (format!("{at}. It is not resolved any further{steady}{hit}"), cx.colours.alarm)
                }
            }
        }
    }
}
