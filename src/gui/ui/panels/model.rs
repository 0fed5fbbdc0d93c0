//! The plan in the window: the decision on each part of the model, the bound of its effect, and a switch to decide otherwise.
//! After a switch, its effect.

use crate::analysis::decision;
use crate::analysis::tradeoff::without_grid;
use crate::digits::{capitalised, power_of_ten, significant};
use crate::gui::command::Command;
use crate::gui::derived::words;
use crate::gui::state::switch_effect::SwitchEffect;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::fidelity;
use crate::gui::ui::form::choices;
use crate::gui::ui::hint::{Hint, text_width};
use crate::job::SolvedScene;
use crate::plan::Decision;
use crate::scene::{Parameter, Value};
use eframe::egui::{self, Align, Layout, RichText, TextStyle, vec2};

/// Width that a combo box needs beside its text, in heights of the text.
const COMBO_ICON: f32 = 2.2;

/// Shows the decisions of `run` and their switches.
pub fn show(ui: &mut egui::Ui, run: &SolvedScene, cx: &DrawContext<'_>) {
    if let Some(effect) = cx.state.switches.effect() {
        changed(ui, &effect, cx);
    }
    let decisions = &run.solution.model.decisions;
    target(ui, cx);
    let columns = Columns::of(ui, decisions);
    for decision in decisions {
        ui.push_id(decision::term(decision), |ui| match decision.key().and_then(Parameter::find) {
            Some(parameter) => switch(ui, decision, parameter, columns, cx),
            None => fixed(ui, decision, cx),
        });
    }
    run.solution.model.remarks.iter().for_each(|remark| cx.note(ui, capitalised(remark)));
    ui.add_space(4.0);
}

/// Effect of the last switch, beside the bound that the plan had stated.
fn changed(ui: &mut egui::Ui, change: &SwitchEffect, cx: &DrawContext<'_>) {
    let colour = if change.held() { cx.colours.good } else { cx.colours.alarm };
    let ground = ui.visuals().panel_fill.lerp_to_gamma(colour, 0.16);
    egui::Frame::new().fill(ground).corner_radius(4).inner_margin(egui::Margin::symmetric(8, 6)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        let name = Parameter::find(change.key).map_or(change.key, words::label);
        ui.add(egui::Label::new(RichText::new(format!("{name} switched")).strong().color(colour)).wrap());
        ui.add(egui::Label::new(sentence(change)).wrap());
        let verdict = if change.held() { "" } else { "; that is more than was stated" };
        let share = percent(change.errors / change.before.abs().max(f64::MIN_POSITIVE));
        let text = format!("Both at {}, numerical errors together {share}{verdict}", change.fidelity);
        cx.note(ui, text);
    });
    ui.add_space(4.0);
}

/// `α 0.24583 → 0.25401 (+3.3 %), stated bound 5.0 %`.
fn sentence(change: &SwitchEffect) -> String {
    let [before, after] = [change.before, change.after].map(|alpha| significant(alpha, 5));
    let relative = change.relative();
    let sign = if relative > 0.0 {
        "+"
    } else if relative < 0.0 {
        "−"
    } else {
        ""
    };
    let bound = if change.bound > 0.0 {
        format!("stated bound {}", percent(change.bound))
    } else {
        "stated as exact".to_owned()
    };
    format!("α {before} → {after} ({sign}{}), {bound}", percent(relative.abs()))
}

/// A share in per cent, with two digits; below a hundred-thousandth, the next power of ten above it.
fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value > 0.0 && value < 1e-3 {
        format!("{} %", power_of_ten(value.log10().ceil()))
    } else {
        crate::digits::percent(share)
    }
}

/// A share in per cent, rounded up to one digit.
fn at_most(share: f64) -> String {
    let value = 100.0 * share;
    if value < 1e-3 {
        return percent(share);
    }
    let exponent = value.log10().floor();
    let unit = 10f64.powf(exponent);
    // A number that has one digit already is kept, whatever rounding has added to it.
    let (up, decimals) = ((value / unit - 1e-9).ceil() * unit, (-exponent).max(0.0) as usize);
    format!("{up:.decimals$} %")
}

/// Widths of the columns, so that the switches are aligned.
#[derive(Clone, Copy)]
struct Columns {
    term: f32,
    bound: f32,
    /// Whether term, switch and bound fit side by side.
    one_line: bool,
}

impl Columns {
    fn of(ui: &egui::Ui, decisions: &[Decision]) -> Self {
        let widest =
            |texts: &mut dyn Iterator<Item = String>| texts.map(|text| text_width(ui, &text)).fold(0.0, f32::max);
        let switches = || decisions.iter().filter_map(|decision| Some((decision, Parameter::find(decision.key()?)?)));
        let term = widest(&mut switches().map(|(decision, _)| capitalised(decision::term(decision))));
        // There is always space for a decision, so that rows do not jump when one appears.
        let bound = text_width(ui, "≤ 0.06 %");
        let wide = widest(&mut switches().flat_map(|(_, parameter)| {
            parameter.options().iter().map(|option| words::automatic(parameter.key, option))
        }));
        let combo = wide + COMBO_ICON * ui.text_style_height(&TextStyle::Body);
        let gaps = 3.0 * ui.spacing().item_spacing.x;
        Self { term, bound, one_line: term + combo + bound + gaps < ui.available_width() }
    }
}

/// The fidelity up to which edits are solved.
fn target(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let (target, numerics) = (cx.state.document.target(), cx.state.document.scene().numerics());
    ui.horizontal(|ui| {
        let label = ui.label(RichText::new("Solved up to").color(cx.colours.quiet));
        let (combo, chosen) = fidelity::choose_target(ui, target, ui.available_width(), cx);
        if let Some(target) = chosen {
            cx.push(Command::Use(target, numerics));
        }
        let hint = "Every edit is solved at draft first, then refined up to this";
        combo.hint_beside(ui, hint).labelled_by(label.id);
    });
    ui.add_space(4.0);
}

/// A decision that can be overruled.
fn switch(
    ui: &mut egui::Ui,
    decision: &Decision,
    parameter: &'static Parameter,
    columns: Columns,
    cx: &DrawContext<'_>,
) {
    let explanation = capitalised(&decision::words(decision));
    let combo = |ui: &mut egui::Ui, width: f32, labelled_by: egui::Id| {
        let combo = choices(ui, parameter, width, cx);
        combo.hint_beside(ui, &explanation).labelled_by(labelled_by);
    };
    let height = ui.spacing().interact_size.y;
    if columns.one_line {
        ui.horizontal(|ui| {
            let named = cell(ui, columns.term, height, Align::Min, |ui| term(ui, decision));
            let named = named.hint_beside(ui, &explanation);
            let room = ui.available_width() - columns.bound - ui.spacing().item_spacing.x;
            combo(ui, room, named.id);
            cell(ui, columns.bound, height, Align::Max, |ui| bound(ui, decision, cx));
        });
    } else {
        let named = heading(ui, decision, cx).hint_beside(ui, &explanation);
        combo(ui, ui.available_width(), named.id);
    }
    if matches!(cx.state.document.scene().get(parameter.key), Some(Value::Text(name)) if name != words::AUTO_NAME) {
        overruled(ui, decision, Command::Reset(parameter.key), cx);
    }
}

/// A decision without a switch: the choice and the reason in words.
fn fixed(ui: &mut egui::Ui, decision: &Decision, cx: &DrawContext<'_>) {
    ui.add_space(2.0);
    heading(ui, decision, cx);
    cx.note(ui, capitalised(&decision::words(decision)));
    if decision.overruled {
        let document = &cx.state.document;
        let back = Command::Use(document.target(), without_grid(&document.scene().numerics()));
        overruled(ui, decision, back, cx);
    }
}

fn heading(ui: &mut egui::Ui, decision: &Decision, cx: &DrawContext<'_>) -> egui::Response {
    ui.horizontal(|ui| {
        let term = term(ui, decision);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| bound(ui, decision, cx));
        term
    })
    .inner
}

fn term(ui: &mut egui::Ui, decision: &Decision) -> egui::Response {
    ui.add(egui::Label::new(capitalised(decision::term(decision))).extend())
}

/// Bound of a decision's effect; a grid has none, because its error is stated elsewhere.
fn bound(ui: &mut egui::Ui, decision: &Decision, cx: &DrawContext<'_>) {
    let (text, about) = if decision.effect > 0.0 {
        (format!("≤ {}", at_most(decision.effect)), "What is left out changes α by at most this, relative")
    } else if decision.key().is_some() {
        ("exact".to_owned(), "Nothing is left out")
    } else {
        return;
    };
    ui.add(egui::Label::new(RichText::new(text).color(cx.colours.quiet)).extend()).hint_beside(ui, about);
}

/// Says that the scene decides this part, and offers to return the decision to the plan.
fn overruled(ui: &mut egui::Ui, decision: &Decision, back: Command, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let (text, colour) =
            if decision.overruled { ("Overruled", cx.colours.accent) } else { ("Same as auto", cx.colours.quiet) };
        ui.add(egui::Label::new(RichText::new(text).color(colour)).extend());
        let name = format!("{} back to auto", capitalised(decision::term(decision)));
        cx.small_button(ui, ("Back to auto", "Leaves this to the program again"), &name, back);
    });
    ui.add_space(2.0);
}

/// Draws `add` in a box of this size, aligned left or right.
fn cell<R>(ui: &mut egui::Ui, width: f32, height: f32, align: Align, add: impl FnOnce(&mut egui::Ui) -> R) -> R {
    let layout =
        if align == Align::Max { Layout::right_to_left(Align::Center) } else { Layout::left_to_right(Align::Center) };
    ui.allocate_ui_with_layout(vec2(width, height), layout, |ui| {
        ui.set_min_width(width);
        add(ui)
    })
    .inner
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fidelity::Fidelity;

    #[test]
    fn a_change_is_one_sentence() {
        let change = SwitchEffect {
            key: "numerics.wedge",
            fidelity: Fidelity::Fine,
            before: 0.245_834,
            after: 0.254_012,
            errors: 1e-5,
            bound: 0.05,
        };
        assert_eq!(sentence(&change), "α 0.24583 → 0.25401 (+3.3 %), stated bound 5.0 %");
        assert_eq!([at_most(0.05), at_most(5.3e-4), at_most(0.3)], ["5 %", "0.06 %", "30 %"]);
        let same = SwitchEffect { after: change.before, bound: 0.0, ..change };
        assert_eq!(sentence(&same), "α 0.24583 → 0.24583 (0 %), stated as exact");
        let tiny = SwitchEffect { after: change.before * (1.0 - 3e-7), ..change };
        assert_eq!(sentence(&tiny), "α 0.24583 → 0.24583 (−10⁻⁴ %), stated bound 5.0 %");
    }
}
