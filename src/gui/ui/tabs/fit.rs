//! The fit tab: parameters are fitted to measurements, or optimised for a result. It has the table, the form, and the result.

use crate::analysis::fit::{Bound, Fitted, FittedUnknown, MOST_UNKNOWNS, Measured, Optimum};
use crate::digits::{capitalised, counted, percent, signed, significant};
use crate::export::figure::{Layer, Panel};
use crate::export::fit::{BEYOND, figures, optimum_figure};
use crate::gui::command::{Command, FitCommand};
use crate::gui::derived::words::label;
use crate::gui::state::dialogs::{Export, Purpose};
use crate::gui::state::fit::{FitForm, FitResult, FitState, Sought, chooses};
use crate::gui::ui::cache::once;
use crate::gui::ui::chart::{Chart, legend, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::form::{AxisRow, field, list};
use crate::gui::ui::glossary;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::panels::menu::export_button;
use crate::gui::ui::parts::{BESIDE_CHARTS, first_button, heads, scrolled, table};
use crate::gui::ui::theme::outline_fields;
use crate::problem::Problem;
use eframe::egui::{Label, RichText, TextStyle, Ui};
use std::sync::Arc;

/// Height of a chart: its share of the tab, and at least this many lines of text.
const SHARE: f32 = 0.3;
const LEAST_LINES: f32 = 9.0;
/// Height of a measurement in the chart of residuals, in heights of the text.
const ROW: f32 = 1.3;
/// Width of the lists and of the field for limits, in heights of the text.
const WIDE: f32 = 13.0;
/// Most rows that are listed; the files of the command line have all rows.
const LISTED: usize = 200;

/// Shows the tab.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let height = ui.available_height();
    let state = &cx.state.fit;
    outline_fields(ui);
    scrolled(ui, "fit", BESIDE_CHARTS, |ui| {
        let mut form = state.form.clone();
        sought(ui, &mut form, cx);
        let agreement = state.form.sought == Sought::Agreement;
        if agreement {
            measurements(ui, state, cx);
        }
        let asks = state.measured.is_some() || !agreement;
        if asks {
            keys(ui, &mut form, cx);
        }
        if form != state.form {
            cx.push(FitCommand::Form(form.clone()));
        }
        if asks {
            buttons(ui, form, cx);
        }
        if !asks {
            cx.introduce(ui, INTRODUCTION);
        } else if !agreement && state.found.is_none() && !state.work.running() {
            cx.introduce(ui, OPTIMUM);
        }
        if let Some((scene, found)) = state.found.as_ref() {
            ui.add_space(6.0);
            let height = (SHARE * height).max(LEAST_LINES * ui.text_style_height(&TextStyle::Body));
            let (name, stale) = (scene.headline(), state.stale(cx.state.document.scene()));
            cx.alarm(ui, stale.then(|| format!("Fitted to “{name}” before the scene changed; fit again")));
            let another = state.asks_for_another();
            cx.alarm(ui, another.then(|| format!("Found for another question: {}", question(found))));
            // Both are computed once for each result.
            let drawn = once(ui, "fit", Arc::as_ptr(found) as usize, || drawn(found));
            match &**found {
                FitResult::Fit(measured, fitted) => result(ui, measured, fitted, &drawn, height, cx),
                FitResult::Optimum(found) => optimum(ui, found, &drawn, height, cx),
            }
        }
        ui.add_space(8.0);
    });
}

fn question(found: &FitResult) -> String {
    match found {
        FitResult::Fit(..) => "agreement with measurements".to_owned(),
        FitResult::Optimum(found) => {
            let kind = if found.goal.greatest { "greatest" } else { "least" };
            let limits: Vec<String> = found.goal.limits.iter().map(|(limit, _)| limit.to_string()).collect();
            let limits = if limits.is_empty() { "no limits".to_owned() } else { limits.join(", ") };
            format!("the {kind} value of {} with {limits}", found.goal.quantity.words())
        }
    }
}

/// Choice of the goal: agreement with measurements, or the optimum of a number, within limits on others.
fn sought(ui: &mut Ui, form: &mut FitForm, cx: &DrawContext<'_>) {
    const KINDS: [(Sought, &str); 3] = [
        (Sought::Agreement, "agreement with measurements"),
        (Sought::Greatest, "the greatest value of"),
        (Sought::Least, "the least value of"),
    ];
    let (sought, name) = (form.sought, form.quantity);
    ui.horizontal_wrapped(|ui| {
        ui.label("Look for");
        let chosen = KINDS.iter().find(|(kind, _)| *kind == sought).map_or("", |(_, words)| *words);
        let called = (
            "What is looked for",
            "Values that agree best with measurements, or at which a result is as large or as small as it can be",
        );
        list(ui, "sought", called, (chosen, WIDE), |ui| {
            for (kind, words) in KINDS {
                ui.selectable_value(&mut form.sought, kind, words);
            }
        });
        if sought == Sought::Agreement {
            return;
        }
        let known = &cx.state.fit.quantities;
        let words = known.iter().find(|(other, _)| Some(*other) == name).map_or("", |(_, words)| words.as_str());
        let called = ("Number that is sought", "The result whose optimum is sought");
        list(ui, "quantity", called, (words, WIDE), |ui| {
            for (other, words) in known {
                ui.selectable_value(&mut form.quantity, Some(*other), words);
            }
        });
        ui.label("with");
        let about = "Limits on other results, separated by commas: alpha<30 %, stall_torque_nm>0.2 N·m. The names are those of the exported columns";
        field(ui, ("Limits on other results", about), (&mut form.limits, "no limits"), WIDE);
    });
    cx.alarm(ui, cx.state.fit.goal_fault.as_ref().filter(|_| sought != Sought::Agreement));
}

fn measurements(ui: &mut Ui, state: &FitState, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let ask = Command::Ask(Purpose::Measurements);
        cx.button(ui, "Open measurements…", "A CSV file; or drop one on the window", ask);
        if let Some(measured) = state.measured.as_ref() {
            cx.button(ui, "Forget them", "The table is no longer drawn, nor fitted", FitCommand::Forget);
            let name = measured.name.rsplit(['/', '\\']).next().unwrap_or_default();
            ui.label(format!(
                "{name}: {} under {}",
                counted(measured.measurements.len(), "measurement", "measurements"),
                counted(measured.conditions.len(), "condition", "conditions")
            ));
        }
    });
}

/// Text of the tab without an optimum.
const OPTIMUM: &[&str] = &[
    "At which values of some parameters is a result as large or as small as it can be?",
    "Choose the result, and each parameter with its bounds. Limits on other results, such as alpha<30 %, stall_torque_nm>0.2 N·m, are \
         separated by commas.",
    "Nothing is solved before you ask.",
];

/// Text of the empty tab.
const INTRODUCTION: &[&str] = &[
    "Which values of some parameters agree best with what was measured, and how sure are they?",
    "The first line of the table names its columns. Keys of the scene, such as film.min_spacing_nm, are the conditions of each line. \
         Results of a solve, such as film_load_n, or rotor_speed_rpm with torque_nm, are what was measured. The same names with _error at \
         the end are standard errors, if they are known.",
    "Nothing is solved before you ask.",
];

/// The keys to be chosen, each with its bounds and its fault.
fn keys(ui: &mut Ui, form: &mut FitForm, cx: &DrawContext<'_>) {
    let mut less = None;
    for i in 0..form.axes.len() {
        ui.push_id(i, |ui| {
            if ui.horizontal_wrapped(|ui| key(ui, form, i, cx)).inner {
                less = Some(i);
            }
            cx.alarm(ui, cx.state.fit.faults.get(i).into_iter().flatten());
        });
    }
    less.map(|i| form.axes.remove(i));
}

/// One key with its bounds. Returns whether it was removed.
fn key(ui: &mut Ui, form: &mut FitForm, i: usize, cx: &DrawContext<'_>) -> bool {
    let (scene, of) = (cx.state.document.scene(), format!("parameter {}", i + 1));
    let row = AxisRow {
        usual_count: 2,
        parameter: [if i == 0 { "Choose" } else { "and" }, "What is chosen", &capitalised(&of)],
        groups: &|| vec![("", scene.parameters().filter(|parameter| chooses(scene, parameter)).collect())],
        values: [
            (&format!("Lower bound of {of}"), "No value below this is tried"),
            (&format!("Upper bound of {of}"), "No value above this is tried"),
        ],
        width: 4.0,
        count: None,
        log: (&format!("Equal ratios of {of}"), "Searched by equal ratios instead of equal steps"),
    };
    row.show(ui, &mut form.axes[i], cx);
    let (less, name) = ("Leaves it as it is in the scene", format!("Do not choose {of}"));
    form.axes.len() > 1 && ui.small_button("✕").hint(less).accessible_name(name).clicked()
}

fn buttons(ui: &mut Ui, mut form: FitForm, cx: &DrawContext<'_>) {
    let state = &cx.state.fit;
    let agreement = state.form.sought == Sought::Agreement;
    ui.horizontal_wrapped(|ui| {
        if state.work.running() {
            cx.button(ui, "Cancel the fit", "Ends the search; nothing is kept", Command::CancelTab);
            ui.spinner();
            let what = if agreement { "χ²" } else { "best" };
            ui.label(match state.told {
                Some((points, best)) => format!("{points} points tried, {what} {}", significant(best, 3)),
                None => "Solving the starts…".to_owned(),
            });
            return;
        }
        let good = state.faults.iter().all(Option::is_none) && !state.form.axes.is_empty();
        let good = good && (agreement || state.goal_fault.is_none());
        let about = "Searches on all cores; the window stays usable, and the scene as it is";
        let text = if agreement { "Fit the scene" } else { "Find the optimum" };
        cx.on_click(&first_button(ui, text, (state.found.is_none(), good), cx).hint(about), FitCommand::Start);
        if state.form.axes.len() < MOST_UNKNOWNS
            && ui.button("Add a key…").hint("One more parameter to choose").clicked()
        {
            form.add(cx.state.document.scene());
            cx.push(FitCommand::Form(form));
        }
    });
    cx.alarm(ui, &state.work.failure);
    if state.work.cancelled && state.work.failure.is_none() {
        cx.note(ui, if state.work.running() { "Ending…" } else { "Cancelled" });
    }
}

/// Charts of the result, and the text for its numbers.
#[derive(Default)]
struct FitDrawing {
    panels: Vec<Panel>,
    /// Numbers of an optimum in words: the one that is sought, then the limited ones.
    words: Vec<String>,
}

fn drawn(found: &FitResult) -> FitDrawing {
    // It was solved as it is.
    let Ok(problem) = Problem::try_from(found.scene()) else { return FitDrawing::default() };
    match found {
        FitResult::Fit(measured, fitted) => {
            let figures = figures(&problem, fitted, measured).into_iter();
            let panels = figures.filter(|(name, _)| ["fit", "residuals"].contains(name));
            FitDrawing { panels: panels.flat_map(|(_, figure)| figure.panels).collect(), words: Vec::new() }
        }
        FitResult::Optimum(found) => {
            let limited = found.goal.limits.iter().map(|(_, quantity)| *quantity);
            let words = std::iter::once(found.goal.quantity).chain(limited).map(|quantity| quantity.label(&problem));
            let mut panels = optimum_figure(&problem, found).panels;
            // The limits themselves are in the table; the glossary knows these names.
            for layer in panels.iter_mut().flat_map(|panel| &mut panel.layers) {
                let Layer::Line(line) = layer else { continue };
                match line.name.as_str() {
                    "" => {}
                    BEYOND => line.name = "a limit is not met".to_owned(),
                    _ => line.name = "within the limits".to_owned(),
                }
            }
            FitDrawing { panels, words: words.collect() }
        }
    }
}

fn result(ui: &mut Ui, measured: &Measured, found: &Fitted, drawn: &FitDrawing, height: f32, cx: &DrawContext<'_>) {
    cx.warn(ui, &found.warnings);
    table(ui, "values", 3, 10.0, |ui| {
        for one in &found.unknowns {
            value(ui, one, cx);
            ui.end_row();
        }
    });
    take(ui, cx);
    let how = match (found.errors_known, found.error_scale) {
        (true, _) => format!(
            "χ² = {} with {}, from the errors in the table.",
            significant(found.chi_squared, 3),
            counted(found.degrees_of_freedom, "degree of freedom", "degrees of freedom")
        ),
        (false, Some(_)) => "The table has no errors: they are estimated from the residuals.".to_owned(),
        (false, None) => "The table has no errors, and too few measurements to estimate them.".to_owned(),
    };
    cx.note(ui, how);
    ui.add_space(4.0);
    charts(ui, drawn, height);
    rows(ui, measured, found, cx);
}

/// Buttons that take over or export the values found.
fn take(ui: &mut Ui, cx: &DrawContext<'_>) {
    ui.horizontal(|ui| {
        let about = "Gives the scene these values: one edit, which can be undone";
        cx.button(ui, "Take these values", about, FitCommand::Take);
        export_button(ui, &[Export::Fit], cx);
    });
}

fn optimum(ui: &mut Ui, found: &Optimum, drawn: &FitDrawing, height: f32, cx: &DrawContext<'_>) {
    cx.warn(ui, &found.warnings);
    let Some((sought, limited)) = drawn.words.split_first() else { return };
    let strong = ui.visuals().strong_text_color();
    table(ui, "optimum", 3, 10.0, |ui| {
        let row = |ui: &mut Ui, name: &str, about: &str, value: String, beside: String| {
            ui.label(RichText::new(name).color(cx.colours.quiet)).hint(about);
            ui.label(RichText::new(value).color(strong));
            ui.scope(|ui| {
                // The text is wrapped between groups of words.
                let room = ui.available_width().max(0.7 * WIDE * ui.text_style_height(&TextStyle::Body));
                ui.set_max_width(room);
                ui.add(Label::new(beside).wrap());
            });
            ui.end_row();
        };
        let before = found.before.map_or_else(
            || "cannot be solved at the start of the search".to_owned(),
            |before| format!("{before} at the start of the search"),
        );
        let value = found.value.to_string();
        row(ui, sought, "The result that is sought, with its numerical error", value, before);
        for (((limit, _), words), reached) in found.goal.limits.iter().zip(limited).zip(&found.limited) {
            row(ui, words, "A result that is limited", reached.to_string(), limit.in_words(reached));
        }
        for scan in &found.lines {
            let parameter = scan.unknown.parameter;
            let at = scan.at.map(|bound| format!("at its {} bound", bound.name()));
            let (value, flat) = scan.in_digits();
            let flat = flat.map(|[from, to]| {
                let ends = format!("from {from} to {}", parameter.with_unit(to));
                format!("the result stays within {} of the optimum {ends}", percent(found.flatness()))
            });
            let beside: Vec<String> = at.into_iter().chain(flat).collect();
            row(ui, label(parameter), parameter.about, parameter.with_unit(value), beside.join("; "));
        }
    });
    take(ui, cx);
    ui.add_space(4.0);
    legend(ui, &drawn.panels.iter().collect::<Vec<_>>());
    for (scan, panel) in found.lines.iter().zip(&drawn.panels) {
        let (name, word) = (format!("{sought} over {}", label(scan.unknown.parameter)), "Line through the optimum");
        title(ui, &name, word);
        Chart { name: &name, height: 0.7 * height, panel, words: (None, word) }.show(ui);
    }
}

fn value(ui: &mut Ui, one: &FittedUnknown, cx: &DrawContext<'_>) {
    let parameter = one.unknown.parameter;
    let name = ui.label(RichText::new(label(parameter)).color(cx.colours.quiet));
    name.hint(parameter.about);
    let told = RichText::new(one.in_words()).color(ui.visuals().strong_text_color());
    glossary::term(ui, told, "Standard error");
    ui.label(match one.at {
        Some(Bound::Lower) => "at its lower bound",
        Some(Bound::Upper) => "at its upper bound",
        None => "",
    });
}

/// Charts of measured and computed values, one for each kind of measurement, with torques over the speed; and a chart of the residuals, row
/// by row.
fn charts(ui: &mut Ui, drawn: &FitDrawing, height: f32) {
    let Some((residuals, kinds)) = drawn.panels.split_last() else { return };
    for panel in kinds {
        let word = "Measured against computed";
        let name = match panel.x.label.strip_suffix(", computed") {
            Some(what) => format!("{word}: {what}"),
            None => format!("{word}: {}, {}", panel.y.label, panel.y.unit),
        };
        title(ui, &name, word);
        legend(ui, &[panel]);
        Chart { name: &name, height, panel, words: (Some(word), word) }.show(ui);
    }
    let (name, word) = ("Residuals: computed minus measured, in standard errors", "Residual");
    title(ui, name, word);
    let named = ROW * residuals.y.names.len() as f32 * ui.text_style_height(&TextStyle::Body);
    Chart { name, height: named.max(0.7 * height), panel: residuals, words: (Some(word), word) }.show(ui);
}

/// The measurements beside the computed values.
fn rows(ui: &mut Ui, measured: &Measured, found: &Fitted, cx: &DrawContext<'_>) {
    ui.add_space(4.0);
    table(ui, "measurements", 4, 10.0, |ui| {
        heads(ui, &["", "Measured", "Computed", "Residual"].map(|head| (head, head)), cx);
        for (one, row) in measured.measurements.iter().zip(&found.rows).take(LISTED) {
            ui.label(RichText::new(format!("{}, {}", one.label, one.what.name())).color(cx.colours.quiet));
            ui.label(significant(one.value, 4));
            drop(match &row.computed {
                Ok(computed) => ui.label(computed.to_string()),
                Err(why) => ui.label(RichText::new(why).color(cx.colours.alarm)),
            });
            ui.label(row.residual.map_or_else(|| "left out".to_owned(), |residual| signed(format!("{residual:.2}"))));
            ui.end_row();
        }
    });
    if found.rows.len() > LISTED {
        cx.note(ui, format!("and {} more", found.rows.len() - LISTED));
    }
}
