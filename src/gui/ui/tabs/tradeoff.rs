//! Error against solve time of the present scene, measured on this machine on request: each setting is a point. The front of the settings
//! that no other beats is drawn, the present setting has a ring, and the cheapest setting that meets a target is listed.

use crate::analysis::attempt::RunStatus;
use crate::analysis::tradeoff::{Candidate, Target, Tradeoff, TradeoffPoint};
use crate::digits::{self, capitalised, short};
use crate::export::figure::{Dash, Line, Mark, Style};
use crate::export::tradeoff::{panel, words};
use crate::gui::command::Command;
use crate::gui::state::dialogs::{Export, Purpose};
use crate::gui::state::tradeoff::{TradeoffState, is_present};
use crate::gui::ui::chart::{Chart, legend, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::parts::{self, first_button, joined, number_box, scrolled};
use crate::gui::ui::theme::{ACCENT, on_screen};
use crate::solve::Method;
use eframe::egui::{self, RichText, TextStyle};
use egui_plot::HoverPosition;

/// Height of the plot: its share of the tab, and at least this many lines of text.
const PLOT_SHARE: f32 = 0.56;
const LEAST_LINES: f32 = 12.0;
/// Ranges of the targets: accuracy \[%\] and time \[ms\].
const ACCURACY: std::ops::RangeInclusive<f64> = 1e-4..=100.0;
const BUDGET: std::ops::RangeInclusive<f64> = 1e-2..=600_000.0;

/// Shows the tab.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let height = ui.available_height();
    scrolled(ui, "trade-off", 20.0, |ui| {
        buttons(ui, cx);
        let Some(measured) = &cx.state.tradeoff else { return cx.introduce(ui, INTRODUCTION) };
        state(ui, measured, cx);
        let tradeoff = &measured.tradeoff;
        if !tradeoff.points.iter().any(|point| point.error.is_some()) {
            return;
        }
        let least = LEAST_LINES * ui.text_style_height(&TextStyle::Body);
        plot(ui, tradeoff, (PLOT_SHARE * height).max(least), cx);
        ui.add_space(4.0);
        for target in [Target::Accuracy(cx.state.view.accuracy), Target::Budget(cx.state.view.budget)] {
            advice(ui, tradeoff, target, cx);
        }
        ui.add_space(6.0);
        table(ui, tradeoff, cx);
        ui.add_space(8.0);
    });
}

fn buttons(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let running = cx.state.tradeoff.as_ref().filter(|measured| measured.work.running());
        match running {
            Some(measured) => {
                let hover = "Ends the measurement; the results so far are kept";
                cx.button(ui, "Cancel the measurement", hover, Command::CancelTab);
                let share = measured.share;
                cx.progress(ui, 140.0, share, &format!("{:.0} %", 100.0 * share), Some((measured.started, share)));
            }
            None => {
                let about = "Takes up to about a minute; the window stays usable";
                let button = first_button(ui, "Measure", (cx.state.tradeoff.is_none(), true), cx);
                cx.on_click(&button.hint(about), Command::Measure);
            }
        }
        if running.is_none() && cx.state.can_export(Export::TradeoffTable) {
            for (text, export) in [("Export CSV…", Export::TradeoffTable), ("Export figure…", Export::TradeoffFigure)]
            {
                cx.button(ui, text, export.described().about, Command::Ask(Purpose::Export(export)));
            }
        }
    });
}

/// Text of the empty tab.
const INTRODUCTION: &[&str] = &[
    "How accurately can this scene be solved, and how fast, on this machine?",
    "Each fidelity, some grids beside them and the method of the paper on its meshes are timed in turn, in the \
         background, and judged by the error of α (of a plate, of the film load). Nothing is measured before you ask.",
];

/// State of the measurement: whether it belongs to the present scene, was cancelled, or failed.
fn state(ui: &mut egui::Ui, measured: &TradeoffState, cx: &DrawContext<'_>) {
    if measured.stale(cx.state.document.scene()) {
        let name = measured.scene.headline();
        cx.alarm(ui, [format!("Measured on “{name}” before the scene changed; measure again")]);
    } else if measured.work.cancelled {
        let text = if measured.work.running() { "Ending…" } else { "Cancelled; these are the results so far" };
        cx.note(ui, text);
    }
    let failed = |failure: &String| format!("The measurement failed: {failure}");
    cx.alarm(ui, measured.work.failure.as_ref().map(failed));
    let usable = |point: &&TradeoffPoint| matches!(point.run.status, RunStatus::Waiting | RunStatus::Converged);
    let unconverged = measured.tradeoff.points.iter().filter(|point| !usable(point)).count();
    if unconverged > 0 {
        cx.note(ui, format!("{unconverged} of the settings did not converge: they are in the table only"));
    }
}

/// Whether the window solves with exactly this setting.
fn in_use(candidate: &Candidate, cx: &DrawContext<'_>) -> bool {
    is_present(candidate, cx.state.document.target(), cx.state.document.scene().numerics())
}

/// Error against time as in the exported figure, with lines at the targets and bars from quartile to quartile.
fn plot(ui: &mut egui::Ui, tradeoff: &Tradeoff, height: f32, cx: &DrawContext<'_>) {
    let used = (0..tradeoff.points.len()).filter(|i| in_use(&tradeoff.points[*i].run.candidate, cx));
    let mut panel = panel(tradeoff, ("present setting", ACCENT, &used.collect::<Vec<_>>()));
    let (accuracy, budget) = (100.0 * cx.state.view.accuracy, cx.state.view.budget);
    for mark in [Mark::horizontal(accuracy, "asked for"), Mark::vertical(budget, "asked for")] {
        // Dashes are reserved for the front.
        panel.layers.push(Mark { style: Style { width: 0.9, ..Style::quiet() }.dash(Dash::Dotted), ..mark }.into());
    }
    for TradeoffPoint { quartiles: (low, high), error, run, .. } in &tradeoff.points {
        let bar = [*low, *high].map(|time| [time, 100.0 * error.unwrap_or(f64::NAN)]);
        let (_, colour) = words(run.candidate.family);
        panel.layers.push(Line::new("", bar, Style { width: 0.5, ..Style::solid(colour) }).into());
    }
    let judged = format!("error of {}", tradeoff.of_what());
    let name = format!("{} against solve time, %", capitalised(&judged));
    title(ui, &name, &judged);
    legend(ui, &[&panel]);
    let chart = Chart { name: &name, height, panel: &panel, words: (Some("Solve time"), &judged) };
    chart.show_with(ui, |plot| plot.label_formatter(|at| setting_at(tradeoff, at)));
}

/// The setting under the pointer, in words.
fn setting_at(tradeoff: &Tradeoff, at: &HoverPosition<'_>) -> Option<String> {
    let HoverPosition::NearDataPoint { position, .. } = at else { return None };
    let point = tradeoff.points.iter().find(|point| point.median.log10() == position.x)?;
    let error = point.error.map_or_else(String::new, |error| format!("\nerror {}", percent(error)));
    Some(format!("{}{error}\ntime {}", point.run.candidate.name, duration(point.median)))
}

/// A target, the setting that meets it, and the button to use that setting.
fn advice(ui: &mut egui::Ui, tradeoff: &Tradeoff, target: Target, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let (name, mut value, unit, range, about) = match target {
            Target::Accuracy(share) => {
                ("Accuracy", 100.0 * share, " %", ACCURACY, "The cheapest with at most this error")
            }
            Target::Budget(time) => ("Budget", 1e3 * time, " ms", BUDGET, "The most accurate within this time"),
        };
        let label = glossary::term(ui, name, name);
        let (present, speed) = (value, 0.01 * value);
        let drag =
            egui::DragValue::new(&mut value).suffix(unit).speed(speed).custom_formatter(|value, _| short(value, 3));
        let field = number_box(ui, drag, (range, unit.trim()), cx).labelled_by(label.id).hint(about);
        // A field that only loses the focus keeps the digits that it does not show.
        let value = if short(value, 3) == short(present, 3) { present } else { value };
        let changed = match target {
            Target::Accuracy(_) => Target::Accuracy(1e-2 * value),
            Target::Budget(_) => Target::Budget(1e-3 * value),
        };
        cx.on_change(&field, Command::Target(changed));
        let Some(point) = tradeoff.choose(target).and_then(|i| tradeoff.points.get(i)) else {
            ui.add(egui::Label::new(RichText::new("no setting meets this").color(cx.colours.alarm)));
            return;
        };
        let candidate = &point.run.candidate;
        let error = point.error.map_or_else(String::new, |error| format!(", error at most {}", percent(error)));
        ui.add(egui::Label::new(format!("→ {}: {}{error}", candidate.name, duration(point.median))).wrap());
        if in_use(candidate, cx) {
            ui.label(RichText::new("in use").color(cx.colours.good));
            return;
        }
        let ours = candidate.settings.method == Method::Auto;
        let button = ui.add_enabled(ours, egui::Button::new("Use it"));
        let button = button.on_disabled_hover_text("The window solves by its own method only");
        let named = button.accessible_name(format!("Use it for the {}", name.to_lowercase()));
        let setting = Command::Use(candidate.settings.fidelity, candidate.numerics);
        cx.on_click(&named.hint("One edit, undone like any other"), setting);
    });
}

/// Every setting in words, the fastest first.
fn table(ui: &mut egui::Ui, tradeoff: &Tradeoff, cx: &DrawContext<'_>) {
    let mut order: Vec<&TradeoffPoint> = tradeoff.points.iter().collect();
    order.sort_by(|a, b| a.median.total_cmp(&b.median));
    parts::table(ui, "settings", 4, 14.0, |ui| {
        let heads = [("Setting", "Setting"), ("Time", "Solve time"), ("Error", "Stated error"), ("", "")];
        parts::heads(ui, &heads, cx);
        for point in order {
            let candidate = &point.run.candidate;
            let (family, colour) = words(candidate.family);
            let colour = on_screen(colour, ui.visuals());
            glossary::term(ui, RichText::new(&candidate.name).color(colour), family);
            ui.label(if point.median.is_finite() { duration(point.median) } else { "…".to_owned() });
            ui.label(point.error.map_or_else(String::new, percent));
            let mut marks = Vec::new();
            match &point.run.status {
                RunStatus::Waiting | RunStatus::Converged => {}
                RunStatus::Failed(_) => marks.push("failed".to_owned()),
                other => marks.push(other.to_string()),
            }
            if point.best {
                marks.push("best".to_owned());
            }
            if in_use(candidate, cx) {
                marks.push("in use".to_owned());
            }
            let marks = ui.label(RichText::new(marks.join(", ")).color(cx.colours.quiet));
            if let RunStatus::Failed(reason) = &point.run.status {
                marks.hint(reason);
            }
            ui.end_row();
        }
    });
}

fn duration(seconds: f64) -> String {
    joined(&digits::duration(seconds))
}

fn percent(share: f64) -> String {
    joined(&digits::percent(share))
}
