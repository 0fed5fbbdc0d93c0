//! The plan in the window: the decision on each part of the model, the bound of its effect, and a switch to decide otherwise.
//! After a switch, its effect.

use crate::analysis::decision;
use crate::analysis::tradeoff::without_grid;
use crate::digits::{capitalised, power_of_ten, significant};
use crate::gui::command::Command;
use crate::gui::derived::words;
use crate::gui::state::document::Document;
use crate::gui::state::switch_effect::SwitchEffect;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::fidelity;
use crate::gui::ui::form::choices;
use crate::gui::ui::hint::{Hint, text_width};
use crate::job::SolvedScene;
use crate::plan::Decision;
use crate::scene::{Parameter, ParameterKind, Scene, Value};
use eframe::egui::{self, Align, Layout, RichText, TextStyle, vec2};

/// Width that a combo box needs beside its text, in heights of the text.
const COMBO_ICON: f32 = 2.2;

/// Shows the decisions of `run` and their switches.
pub fn show(ui: &mut egui::Ui, run: &SolvedScene, cx: &DrawContext<'_>) {
    if let Some(effect) = cx.state.switches.effect() {
        changed(ui, &effect, cx);
    }
    let decisions = &run.solution.model.decisions;
    let columns = Columns::of(ui, decisions);
    let row = SwitchRow { run, columns, cx };
    row.target(ui);
    for decision in decisions {
        ui.push_id(decision::term(decision), |ui| match decision.key().and_then(Parameter::find) {
            Some(parameter) => row.switch(ui, decision, parameter),
            None => row.fixed(ui, decision),
        });
    }
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
pub fn sentence(change: &SwitchEffect) -> String {
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

/// A share in per cent, two digits; of less than a hundred-thousandth, the power of ten that it is below.
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
    // What is one digit already stays, whatever rounding has left of it.
    let (up, decimals) = ((value / unit - 1e-9).ceil() * unit, (-exponent).max(0.0) as usize);
    format!("{up:.decimals$} %")
}

/// Bound of a decision's effect; empty for a grid, whose error is stated elsewhere.
fn bound(decision: &Decision) -> String {
    if decision.key().is_none() && decision.effect == 0.0 {
        return String::new();
    }
    if decision.effect > 0.0 { format!("≤ {}", at_most(decision.effect)) } else { "exact".to_owned() }
}

/// The choice in the scene for a key; empty if it is not a choice.
fn asked(scene: &Scene, key: &str) -> String {
    match scene.get(key) {
        Some(Value::Text(name)) => name,
        _ => String::new(),
    }
}

/// Widths, so that the switches begin and end at one place.
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
        // As if anything were decided: rows must not jump when something is.
        let bound = widest(&mut [0.06, 6e-4].into_iter().map(|share| format!("≤ {}", at_most(share))));
        let wide = widest(&mut switches().flat_map(|(_, parameter)| {
            options(parameter).iter().map(|option| words::automatic(parameter.key, option))
        }));
        let combo = wide + COMBO_ICON * ui.text_style_height(&TextStyle::Body);
        let gaps = 3.0 * ui.spacing().item_spacing.x;
        Self { term, bound, one_line: term + combo + bound + gaps < ui.available_width() }
    }
}

fn options(parameter: &Parameter) -> &'static [&'static str] {
    match parameter.kind {
        ParameterKind::Choice { options, .. } => options,
        _ => &[],
    }
}

struct SwitchRow<'a> {
    run: &'a SolvedScene,
    columns: Columns,
    cx: &'a DrawContext<'a>,
}

impl SwitchRow<'_> {
    fn document(&self) -> &Document {
        &self.cx.state.document
    }

    /// Up to which fidelity edits are solved.
    fn target(&self, ui: &mut egui::Ui) {
        let (target, numerics) = (self.document().target(), self.document().scene().numerics());
        ui.horizontal(|ui| {
            let label = ui.label(RichText::new("Solved up to").color(self.cx.colours.quiet));
            let (combo, chosen) = fidelity::choose_target(ui, target, ui.available_width(), self.cx);
            if let Some(target) = chosen {
                self.cx.push(Command::Use(target, numerics));
            }
            let hint = "Every edit is solved at draft first, then refined up to this";
            combo.hint_beside(ui, hint).labelled_by(label.id);
        });
        ui.add_space(4.0);
    }

    /// A decision that can be overruled.
    fn switch(&self, ui: &mut egui::Ui, decision: &Decision, parameter: &'static Parameter) {
        let explanation = capitalised(&decision::words(decision));
        let height = ui.spacing().interact_size.y;
        if self.columns.one_line {
            ui.horizontal(|ui| {
                let term = cell(ui, self.columns.term, height, Align::Min, |ui| self.term(ui, decision))
                    .hint_beside(ui, &explanation);
                let room = ui.available_width() - self.columns.bound - ui.spacing().item_spacing.x;
                self.combo(ui, parameter, room, &explanation, term.id);
                cell(ui, self.columns.bound, height, Align::Max, |ui| self.bound(ui, decision));
            });
        } else {
            let term = self.heading(ui, decision).hint_beside(ui, &explanation);
            self.combo(ui, parameter, ui.available_width(), &explanation, term.id);
        }
        let asked = asked(self.document().scene(), parameter.key);
        if asked != words::AUTO_NAME && !asked.is_empty() {
            let back = Command::Reset(parameter.key);
            self.overruled(ui, decision, back);
        }
    }

    /// A decision without a switch: what and why in words.
    fn fixed(&self, ui: &mut egui::Ui, decision: &Decision) {
        ui.add_space(2.0);
        self.heading(ui, decision);
        self.cx.note(ui, capitalised(&decision::words(decision)));
        if decision.overruled {
            let numerics = without_grid(&self.document().scene().numerics());
            self.overruled(ui, decision, Command::Use(self.document().target(), numerics));
        }
    }

    fn heading(&self, ui: &mut egui::Ui, decision: &Decision) -> egui::Response {
        ui.horizontal(|ui| {
            let term = self.term(ui, decision);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| self.bound(ui, decision));
            term
        })
        .inner
    }

    fn term(&self, ui: &mut egui::Ui, decision: &Decision) -> egui::Response {
        ui.add(egui::Label::new(capitalised(decision::term(decision))).extend())
    }

    fn bound(&self, ui: &mut egui::Ui, decision: &Decision) {
        let text = bound(decision);
        if text.is_empty() {
            return;
        }
        let text = RichText::new(text).color(self.cx.colours.quiet);
        let about = if decision.effect > 0.0 {
            "What is left out changes α by at most this, relative"
        } else {
            "Nothing is left out"
        };
        ui.add(egui::Label::new(text).extend()).hint_beside(ui, about);
    }

    fn combo(&self, ui: &mut egui::Ui, parameter: &'static Parameter, width: f32, about: &str, labelled_by: egui::Id) {
        let name = asked(self.document().scene(), parameter.key);
        let decisions = &self.run.solution.model.decisions;
        let combo = choices(ui, (parameter, options(parameter)), &name, decisions, width, self.cx);
        combo.hint_beside(ui, about).labelled_by(labelled_by);
    }

    /// Says that the scene decides, and offers to leave it to the plan again.
    fn overruled(&self, ui: &mut egui::Ui, decision: &Decision, back: Command) {
        ui.horizontal_wrapped(|ui| {
            let (text, colour) = if decision.overruled {
                ("Overruled", self.cx.colours.accent)
            } else {
                ("As the plan would", self.cx.colours.quiet)
            };
            ui.add(egui::Label::new(RichText::new(text).color(colour)).extend());
            let name = format!("{} back to auto", capitalised(decision::term(decision)));
            self.cx.small_button(ui, ("Back to auto", "Leaves this to the program again"), &name, back);
        });
        ui.add_space(2.0);
    }
}

/// `add` in a box of this size, at its left or right.
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
