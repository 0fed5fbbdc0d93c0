//! The layout of the window: panels around the middle, and the parts that are drawn over them.

use super::context::DrawContext;
use super::modals;
use super::panels::{exports, held, lesson, menu, parameters, results, timeline};
use super::{tabs, views};
use crate::gui::command::LessonCommand;
use crate::gui::state::view::Tab;
use crate::problem::Scenario;
use eframe::egui::{self, Color32};

/// Width of a panel at the side of the views.
struct Side {
    default: f32,
    least: f32,
    /// The largest share of a narrow window that it takes.
    share: f32,
}

const PARAMETERS: Side = Side { default: 300.0, least: 210.0, share: 0.3 };
/// A lesson is text to read, so its panel is wider than that of the results, whose place it takes, even on a telephone.
const LESSON: Side = Side { default: 392.0, least: 240.0, share: 0.36 };
const RESULTS: Side = Side { default: 304.0, least: 190.0, share: 0.29 };

impl Side {
    fn most(&self, window: f32) -> f32 {
        (self.share * window).max(self.least)
    }

    /// Fits `panel` into a window of this width; the middle stays the widest part. `spare`: the panel starts at its least width.
    fn fit(&self, panel: egui::Panel, window: f32, spare: bool) -> egui::Panel {
        let most = self.most(window);
        let default = if spare { self.least } else { self.default };
        panel.default_size(default.min(most)).size_range(self.least..=most).resizable(true)
    }
}

/// A window of this width is crowded with panels at both sides.
const CROWDED: f32 = 900.0;

/// Draws the whole window into `ui`.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let state = cx.state;
    let (side, central) = (egui::Frame::side_top_panel(ui.style()), egui::Frame::central_panel(ui.style()));
    // The window has the colour of the panels, so the panels are not filled: that would paint the whole area twice.
    let [side, central] = [side, central].map(|frame| frame.fill(Color32::TRANSPARENT));
    egui::Panel::top("menu").frame(side).show(ui, |ui| menu::show(ui, cx));
    egui::Panel::bottom("status").frame(side).show(ui, |ui| {
        timeline::show(ui, cx);
        exports::show(ui, cx);
        timeline::status(ui, cx);
    });
    let width = ui.available_width();
    let telephone = ui.ctx().content_rect().height() < tabs::labels::LOW;
    // The widths of the panels are stored for each text size, and separately for a window that is too narrow or too low for the usual
    // widths: when it is enlarged again, the earlier widths come back. The size is that of this frame; a size that was just requested
    // applies from the next frame.
    let zoom = ui.ctx().zoom_factor();
    let id = |name: &str, side: &Side| {
        let window = match side.most(width) < side.default {
            _ if telephone => ", telephone",
            true => ", narrow",
            false => "",
        };
        format!("{name}, {zoom:.2}{window}")
    };
    // A lesson comes first in the order of the keyboard focus.
    if state.view.results && state.lessons.running.as_ref().is_some_and(|running| !running.all_results) {
        LESSON
            .fit(egui::Panel::right(id("lesson", &LESSON)), width, false)
            .frame(side)
            .show(ui, |ui| lesson::show(ui, cx));
    } else if state.view.results {
        RESULTS.fit(egui::Panel::right(id("results", &RESULTS)), width, telephone).frame(side).show(ui, |ui| {
            // The panel has the same width before the first result as after it.
            ui.set_min_width(ui.available_width());
            if state.lessons.running.is_some() && ui.button("Back to the lesson").clicked() {
                cx.push(LessonCommand::AllResults(false));
            }
            if let (Tab::Hold, Some(hold)) = (state.view.tab, &state.hold) {
                held::show(ui, hold, cx);
            } else if let Some(run) = &state.run {
                results::show(ui, run, cx);
            }
        });
    }
    // Where space is short, a held plate takes the place of the parameters, unless a lesson asks for them.
    let held =
        state.view.tab == Tab::Hold && state.lessons.step().is_some_and(|(_, step)| step.highlight_keys.is_empty());
    if state.view.parameters && !(held && width < CROWDED) {
        PARAMETERS.fit(egui::Panel::left(id("parameters", &PARAMETERS)), width, telephone).frame(side).show(ui, |ui| {
            cx.name_part(ui, "parameters", ui.max_rect().expand(2.0));
            parameters::show(ui, cx);
        });
    }
    egui::CentralPanel::default().frame(central).show(ui, |ui| {
        tabs::labels::show(ui, cx);
        middle(ui, cx);
    });
    let ctx = ui.ctx();
    if let Some(query) = &state.lessons.glossary {
        modals::glossary::show(ctx, query, cx);
    }
    if let Some(stop) = state.lessons.tour {
        modals::tour::show(ctx, stop, cx);
    }
    if state.shortcuts {
        modals::shortcuts::show(ctx, cx);
    }
    modals::question::show(ctx, cx);
}

fn middle(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    match (cx.state.view.tab, &cx.state.run) {
        (Tab::Motion, Some(run)) => {
            // This space is kept while the present scene is solved, so that nothing moves.
            if cx.state.activity.failure.is_some() {
                cx.say_if_stale(ui, run);
            }
            let first = cx.state.lessons.compared(cx.state.document.scene());
            views::run::show(ui, run, None, first.map(AsRef::as_ref), cx);
        }
        (Tab::Torque, Some(run)) => match run.problem.scenario {
            Scenario::Motor(_) => tabs::torque::show(ui, run, cx),
            Scenario::Plate(_) => tabs::exact::show(ui, run, cx),
        },
        (Tab::Motion | Tab::Torque, None) => {
            let failed = cx.state.activity.failure.is_some();
            let text = if failed { "This scene is not solved; the reason is below" } else { "Solving…" };
            ui.centered_and_justified(|ui| ui.label(text));
        }
        (Tab::Compare, _) => tabs::compare::show(ui, cx),
        (Tab::Sweep, _) => tabs::sweep::show(ui, cx),
        (Tab::Startup, _) => tabs::startup::show(ui, cx),
        (Tab::Hold, _) => tabs::hold::show(ui, cx),
        (Tab::Rotor, _) => tabs::rotor::show(ui, cx),
        (Tab::Fit, _) => tabs::fit::show(ui, cx),
        (Tab::Tradeoff, _) => tabs::tradeoff::show(ui, cx),
        (Tab::Sensitivity, _) => tabs::sensitivity::show(ui, cx),
    }
}
