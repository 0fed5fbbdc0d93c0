//! The sensitivity tab: how much each result changes with every parameter, and how uncertain it is if the parameters are.

use crate::analysis::sensitivity::{Sensitivity, Uncertainties};
use crate::digits::{percent, short, significant, with_error};
use crate::export::sensitivity::{bars, distribution};
use crate::gui::command::{Command, SensitivityCommand};
use crate::gui::derived::format::uncertain;
use crate::gui::derived::words::{explanation, label};
use crate::gui::state::dialogs::{Export, Purpose};
use crate::gui::state::sensitivity::SensitivityState;
use crate::gui::ui::chart::{Chart, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary::{self, Explained};
use crate::gui::ui::hint::Hint;
use crate::gui::ui::parts::{self, BESIDE_CHARTS, first_button, number_box, scrolled};
use crate::scene::Parameter;
use eframe::egui::{self, RichText, TextStyle, Ui};

/// Height of a bar with the space to the next, in heights of the text; and of the histogram.
const BAR: f32 = 1.35;
const HISTOGRAM: f32 = 11.0;
/// Random scenes that can be asked for.
const DRAWS: std::ops::RangeInclusive<f64> = 10.0..=1e5;

/// Shows the tab.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    scrolled(ui, "sensitivity", BESIDE_CHARTS, |ui| {
        let state = &cx.state.sensitivity;
        buttons(ui, state, cx);
        cx.alarm(ui, state.failure().map(|failure| format!("Nothing was found: {failure}")));
        let (Some(found), Some(uncertainties)) = (state.found.as_ref(), state.uncertainties.as_ref()) else {
            return cx.introduce(ui, INTRODUCTION);
        };
        let (name, stale) = (found.scene().headline(), state.stale(cx.state.document.scene()));
        cx.alarm(ui, stale.then(|| format!("Computed for “{name}” before the scene changed; compute again")));
        cx.warn(ui, &found.warnings);
        let output = state.output.min(found.outputs.len() - 1);
        choose(ui, found, output, cx);
        result(ui, found, output, uncertainties, cx);
        tornado(ui, found, output, cx);
        monte_carlo(ui, found, output, cx);
        table(ui, found, output, uncertainties, cx);
        // The message is below the rows, so that none of them moves while text is typed.
        cx.alarm(ui, state.all_refused(found.scene()));
        cx.alarm(ui, excessive(found, uncertainties));
        let whole = found.whole();
        if !whole.is_empty() {
            let names: Vec<&str> = whole.iter().filter_map(|key| Some(label(Parameter::find(key)?))).collect();
            cx.note(ui, format!("Whole numbers have no derivative; sweep them: {}.", names.join(", ")));
        }
        ui.add_space(8.0);
    });
}

fn buttons(ui: &mut Ui, state: &SensitivityState, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        if let Some(share) = state.running() {
            cx.button(ui, "Cancel", "Ends the work; earlier results stay", Command::CancelTab);
            cx.progress(ui, 140.0, share, &format!("{:.0} %", 100.0 * share), None);
        } else {
            let hover =
                "Solves the scene with each parameter changed a little, in the background; takes about a second";
            let button = first_button(ui, "Compute sensitivities", (state.found.is_none(), true), cx).hint(hover);
            cx.on_click(&button, SensitivityCommand::Start);
        }
        if state.found.is_some() {
            let export = Command::Ask(Purpose::Export(Export::Sensitivity));
            cx.button(ui, "Export…", Export::Sensitivity.described().about, export);
        }
    });
}

/// Text of the empty tab.
const INTRODUCTION: &[&str] = &[
    "Which parameters matter, and how well do they have to be known?",
    "Every parameter is changed a little, up and down, and the scene solved each time. Give parameters an uncertainty, and see how \
         uncertain the results are. Nothing is computed before you ask.",
];

/// Choice of the result that is shown.
fn choose(ui: &mut Ui, found: &Sensitivity, present: usize, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        for (i, output) in found.outputs.iter().enumerate() {
            let button = ui.selectable_label(i == present, output.words());
            cx.on_click(&button.explained_here(ui, output.words()), SensitivityCommand::Look(i));
        }
    });
}

/// The result with its two uncertainties, which are shown separately.
fn result(ui: &mut Ui, found: &Sensitivity, output: usize, uncertainties: &Uncertainties, cx: &DrawContext<'_>) {
    let value = found.values[output];
    if !value.value.is_finite() {
        return cx.note(ui, "This scene has no such result");
    }
    let unit = found.outputs[output].unit(&found.problem);
    let unit = if unit.is_empty() { String::new() } else { format!("\u{a0}{unit}") };
    ui.horizontal_wrapped(|ui| {
        let known = value.error.is_finite();
        let text = if known { uncertain(value) } else { significant(value.value, 4) };
        ui.label(RichText::new(format!("{text}{unit}")).strong());
        if known {
            glossary::term(ui, RichText::new("numerical").color(cx.colours.quiet), "Stated error");
        }
        if !uncertainties.is_empty() {
            let spread = found.propagated(output, uncertainties);
            let text = format!("standard deviation {} from the parameters", significant(spread.deviation.value, 2));
            glossary::term(ui, RichText::new(text).color(cx.colours.accent), "Uncertainty of a parameter");
            let unknown = (!spread.unknown.is_empty()).then(|| format!("without {}", spread.unknown.join(", ")));
            cx.alarm(ui, unknown);
        }
        let drawn = cx.state.sensitivity.drawn();
        let drawn = drawn.and_then(|(carlo, _, earlier)| Some((carlo.spread(output)?, earlier)));
        if let Some((spread, earlier)) = drawn {
            let [low, _, high] = spread.quantiles;
            let text = format!(
                "{}random scenes: mean {}, standard deviation {}, 90 % of them from {low} to {high}",
                if earlier { "earlier " } else { "" },
                with_error(spread.mean, spread.mean_error()),
                significant(spread.deviation, 2),
            );
            let colour = if earlier { cx.colours.quiet } else { cx.colours.film };
            glossary::term(ui, RichText::new(text).color(colour), "Random scenes");
        }
    });
}

fn tornado(ui: &mut Ui, found: &Sensitivity, output: usize, cx: &DrawContext<'_>) {
    ui.add_space(4.0);
    title(ui, "Change for 1 % more of each parameter, %", "Elasticity");
    let mut panel = bars(found, output, None);
    if panel.y.names.is_empty() {
        return cx.note(ui, "It depends on none of them");
    }
    panel.x.label = String::new();
    for (_, name) in &mut panel.y.names {
        let column = found.columns.iter().find(|column| column.parameter.words() == *name);
        column.into_iter().for_each(|column| label(column.parameter).clone_into(name));
    }
    let height = (BAR * panel.y.names.len() as f32 + 1.6) * ui.text_style_height(&TextStyle::Body);
    let chart = Chart { name: "Tornado chart", height, panel: &panel, words: (Some("Elasticity"), "Elasticity") };
    chart.show_with(ui, |plot| plot.allow_zoom(false).allow_drag(false));
    if !panel.title.is_empty() {
        cx.note(ui, &panel.title);
    }
}

fn monte_carlo(ui: &mut Ui, found: &Sensitivity, output: usize, cx: &DrawContext<'_>) {
    let state = &cx.state.sensitivity;
    let present = state.uncertainties.as_ref().is_some_and(|uncertainties| !uncertainties.is_empty());
    ui.add_space(6.0);
    ui.horizontal_wrapped(|ui| {
        let words = glossary::term(ui, "Random scenes", "Random scenes");
        let mut draws = state.draws() as f64;
        let field = egui::DragValue::new(&mut draws).speed(10.0).max_decimals(0);
        let field = number_box(ui, field, (DRAWS, ""), cx).labelled_by(words.id).hint("How many are solved");
        cx.on_change(&field, SensitivityCommand::Draws(draws as usize));
        let refused = state.all_refused(found.scene()).next();
        let can = present && refused.is_none() && state.running().is_none();
        let button = ui.add_enabled(can, egui::Button::new("Draw and solve"));
        let needed = "Give a parameter an uncertainty in the table below first".to_owned();
        let why = refused.map_or(needed, |why| format!("Correct what is refused in the table below first. {why}"));
        let button = button.on_disabled_hover_text(why);
        let about = "Draws every uncertain parameter at random and solves the scene, again and again (Monte Carlo)";
        cx.on_click(&button.hint(about), SensitivityCommand::Draw);
    });
    let Some((carlo, uncertainties, earlier)) = state.drawn() else { return };
    let failed = carlo.failures.len();
    let because = |first| format!("{failed} could not be solved and are missing, the first because {first}");
    cx.alarm(ui, carlo.failures.first().map(because));
    if carlo.redrawn > 0 {
        let what = "were outside of what is allowed and were drawn again, which makes the spread smaller";
        cx.note(ui, format!("{} {what}", carlo.redrawn));
    }
    let Some(panel) = distribution(found, output, uncertainties, carlo) else { return };
    let name = "Histogram of the random scenes";
    // The heading takes one line in both cases, so that the rows below do not move while an uncertainty is typed.
    let heading = if earlier { "Random scenes of the earlier uncertainties; draw and solve again" } else { name };
    title(ui, heading, "Random scenes");
    let height = HISTOGRAM * ui.text_style_height(&TextStyle::Body);
    let words = (Some(found.outputs[output].words()), "Random scenes");
    Chart { name, height, panel: &panel, words }.show(ui);
    cx.note(ui, "Dashed: the normal distribution that the derivatives give. The line: the result of the scene itself.");
}

/// Warnings about standard deviations that are larger than the values.
fn excessive(found: &Sensitivity, uncertainties: &Uncertainties) -> Vec<String> {
    // A temperature in °C has no natural zero, and the value of a key may be zero.
    let uncertain = uncertainties.iter().filter(|(parameter, at, _)| *at != 0.0 && parameter.unit != "°C");
    let uncertain = uncertain.map(|(parameter, at, given)| (parameter, at, given.deviation(at)));
    let excessive = uncertain.filter(|(_, at, deviation)| *deviation > at.abs());
    let told = |(parameter, at, deviation): (&'static Parameter, f64, f64)| {
        let [at, deviation] = [(at, 10), (deviation, 3)].map(|(value, digits)| {
            format!("{} {}", short(value, digits), found.scene().unit(parameter)).trim_end().to_owned()
        });
        format!("{}: a standard deviation of {deviation} is more than the value itself, {at}", label(parameter))
    };
    excessive.map(told).collect()
}

/// A table of every parameter: the change of the result with it, and a field for its uncertainty.
fn table(ui: &mut Ui, found: &Sensitivity, output: usize, uncertainties: &Uncertainties, cx: &DrawContext<'_>) {
    let propagated = found.propagated(output, uncertainties);
    let magnitude = |column: usize| {
        let relative = found.columns[column].scale().is_some();
        (relative, found.elasticity(output, column).map_or(0.0, |found| found.value.abs()))
    };
    let mut order: Vec<usize> = (0..found.columns.len()).collect();
    order.sort_by(|a, b| {
        let (a, b) = (magnitude(*a), magnitude(*b));
        b.0.cmp(&a.0).then(b.1.total_cmp(&a.1))
    });
    let em = ui.text_style_height(&TextStyle::Body);
    ui.add_space(6.0);
    let heads = [
        ("Parameter", "Parameter"),
        ("Value", "Parameter"),
        ("Uncertainty", "Uncertainty of a parameter"),
        ("% for 1 % more", "Elasticity"),
        ("Share", "Share of the variance"),
    ];
    parts::table(ui, "sensitivities", heads.len(), 14.0, |ui| {
        parts::heads(ui, &heads, cx);
        for column in order {
            let by = &found.columns[column];
            let parameter = by.parameter;
            ui.label(label(parameter)).hint(explanation(found.scene(), parameter, None));
            let unit = found.scene().unit(parameter);
            ui.label(format!("{} {unit}", short(by.at, 10)).trim_end().to_owned());
            ui.horizontal(|ui| {
                field(ui, parameter, 6.0 * em, cx);
                // The unit of a plain number, and the value of a given one.
                let given =
                    uncertainties.deviation(parameter).map(|deviation| format!("s.d. {} ", short(deviation, 3)));
                let read = given.unwrap_or_default() + &unit;
                ui.label(RichText::new(read.trim_end()).color(cx.colours.quiet));
            });
            match (&by.slopes, found.elasticity(output, column)) {
                (Err(why), _) => drop(ui.label(RichText::new("none").color(cx.colours.alarm)).hint(why)),
                (Ok(_), None) => drop(ui.label("–")),
                (Ok(_), Some(found)) if by.scale().is_some() => drop(ui.label(uncertain(found))),
                (Ok(_), Some(found)) => {
                    let text = format!("{} per {}", uncertain(found * 100.0), parameter.unit);
                    ui.label(text).hint(
                        "Per cent of the result for one unit of the parameter, which is zero or has no natural zero",
                    );
                }
            }
            ui.label(propagated.share(parameter).map_or_else(String::new, percent));
            ui.end_row();
        }
    });
}

fn field(ui: &mut Ui, parameter: &'static Parameter, width: f32, cx: &DrawContext<'_>) {
    let state = &cx.state.sensitivity;
    let mut text = state.typed(parameter.key).to_owned();
    let refused = state.refused(parameter.key);
    let editor = egui::TextEdit::singleline(&mut text)
        .id(egui::Id::unique(("uncertainty", parameter.key)))
        .desired_width(width)
        .hint_text("none")
        .text_color_opt(refused.map(|_| cx.colours.alarm));
    let unit = if parameter.unit.is_empty() { "plain numbers" } else { parameter.unit };
    let usual = format!(
        "A standard deviation in {unit} or in per cent, such as 20%; with ± in front it means limits, such as ±10%"
    );
    let about = refused.map_or(usual, str::to_owned);
    let name = format!("Uncertainty of {}", label(parameter));
    let field = ui.add(editor).accessible_name(name).hint(about);
    cx.on_change(&field, SensitivityCommand::Uncertainty(parameter.key, text));
}
