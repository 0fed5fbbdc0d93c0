//! One parameter varied, or two: what is asked for, the points as they are solved, and any number of their results.

use crate::analysis::attempt::RunStatus;
use crate::analysis::quantity::Quantity;
use crate::digits::capitalised;
use crate::gui::command::SweepCommand;
use crate::gui::derived::format::rough;
use crate::gui::derived::words::label;
use crate::gui::state::sweep::{AxisForm, Form, Swept, candidates};
use crate::gui::ui::button;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::fidelity;
use crate::gui::ui::glossary;
use crate::gui::ui::hint::{Hint, beside};
use crate::gui::ui::panels::menu::{SWEEP, export_button};
use crate::gui::ui::views::swept::{self, Plotted};
use crate::scene::Parameter;
use eframe::egui::accesskit::Role;
use eframe::egui::{self, ComboBox, RichText, TextStyle, Ui, WidgetInfo};

/// Names of the groups of parameters, by table.
const TABLES: &[(&str, &str)] = &[
    ("motor", "Motor"),
    ("stator", "Stator"),
    ("rotor", "Rotor"),
    ("plate", "Plate"),
    ("film", "Film"),
    ("surface", "Surface"),
    ("numerics", "Numerics"),
];

/// Shows the tab.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let Some(form) = cx.state.sweep.form() else { return };
    // Fields and boxes get an outline: in the light theme their fill is nearly that of the panel.
    let visuals = ui.visuals_mut();
    visuals.widgets.inactive.bg_stroke = visuals.widgets.noninteractive.bg_stroke;
    ask(ui, form, cx);
    buttons(ui, form, cx);
    let Some(swept) = cx.state.sweep.swept() else {
        introduction(ui, cx);
        return;
    };
    state(ui, swept, cx);
    let sweep = swept.sweep();
    let quantity = cx.state.sweep.quantity(&sweep.quantities());
    let present = if swept.stale(cx.state.document.scene()) { None } else { swept.present(cx.state.document.scene()) };
    let (number, rows, published) = (swept.number(), swept.rows(), swept.published());
    let plotted = Plotted { number, sweep, rows, quantity, published, present: present.as_deref() };
    swept::show(ui, &plotted, cx);
}

/// What a field asks for.
type Send = fn(usize, String) -> SweepCommand;

/// The form, with what is wrong with it.
fn ask(ui: &mut Ui, form: &Form, cx: &DrawContext<'_>) {
    let faults = cx.state.sweep.faults();
    for (i, axis) in form.axes().enumerate() {
        ui.push_id(i, |ui| {
            ui.horizontal_wrapped(|ui| axis_row(ui, form, i, axis, cx));
            if let Some(fault) = faults.get(i).and_then(Option::as_ref) {
                cx.say(ui, fault, cx.colours.alarm);
            }
        });
    }
    if let Some(refusal) = cx.state.sweep.refusal() {
        cx.say(ui, refusal, cx.colours.alarm);
    }
}

fn axis_row(ui: &mut Ui, form: &Form, i: usize, axis: &AxisForm, cx: &DrawContext<'_>) {
    let em = ui.text_style_height(&TextStyle::Body);
    let which = ["x", "y"][i];
    ui.label(if i == 0 { "Vary" } else { "and" });
    let parameter = Parameter::find(axis.key);
    let chosen = parameter.map_or(axis.key, label);
    let combo = ComboBox::from_id_salt("parameter").selected_text(chosen).width(11.0 * em).height(24.0 * em).show_ui(
        ui,
        |ui| {
            for (table, title) in TABLES {
                let group: Vec<_> =
                    candidates(cx.state.document.scene()).filter(|parameter| parameter.table() == *table).collect();
                if group.is_empty() {
                    continue;
                }
                ui.label(RichText::new(*title).color(cx.colours.quiet));
                for parameter in group {
                    let entry = ui.selectable_label(parameter.key == axis.key, label(parameter));
                    if beside(ui.clip_rect(), entry, parameter.about).clicked() {
                        cx.push(SweepCommand::Choose(i, parameter.key));
                    }
                }
            }
        },
    );
    combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, format!("Parameter along {which}")));
    combo.response.hint(format!("What is varied. {}", parameter.map_or("", |parameter| parameter.about)));
    let field = |ui: &mut Ui, (name, about): (&str, &str), text: &str, wide: f32, send_it: Send| {
        let mut text = text.to_owned();
        let response = ui.add(egui::TextEdit::singleline(&mut text).desired_width(wide * em));
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, format!("{name} along {which}")));
        if response.hint(about).changed() {
            cx.push(send_it(i, text));
        }
    };
    ui.label("from");
    field(ui, ("From", "The first value"), &axis.from, 3.6, SweepCommand::From);
    ui.label("to");
    field(ui, ("To", "The last value"), &axis.to, 3.6, SweepCommand::To);
    if let Some(unit) = parameter.map(|parameter| parameter.unit).filter(|unit| !unit.is_empty()) {
        ui.label(RichText::new(unit).color(cx.colours.quiet));
    }
    field(ui, ("Values", "How many values, both ends counted"), &axis.count, 2.2, SweepCommand::Count);
    ui.label("values");
    let mut log = axis.log;
    let checkbox = ui.checkbox(&mut log, "log").hint("Equal ratios from value to value instead of equal steps");
    let checkbox = checkbox.accessible_name(format!("Equal ratios along {which}"));
    if checkbox.changed() {
        cx.push(SweepCommand::Log(i, log));
    }
    if i == 0 && !form.second {
        let more = ui.button("Add a second…").hint("A map over two parameters");
        if more.clicked() {
            cx.push(SweepCommand::Second(true));
        }
    } else if i == 1 {
        let less = ui.small_button("✕").hint("Back to one parameter");
        if less.accessible_name("Back to one parameter").clicked() {
            cx.push(SweepCommand::Second(false));
        }
    }
}

fn buttons(ui: &mut Ui, form: &Form, cx: &DrawContext<'_>) {
    let swept = cx.state.sweep.swept();
    let running = swept.filter(|swept| swept.running());
    let building = cx.state.sweep.building();
    ui.horizontal_wrapped(|ui| {
        if (building || running.is_some())
            && ui.button("Cancel the sweep").hint("Ends it; what is solved stays, and it can go on").clicked()
        {
            cx.push(SweepCommand::Cancel);
        }
        match running {
            _ if building => drop(ui.label("Its points are being made")),
            Some(swept) => {
                let left = swept.left(cx.now).map_or_else(String::new, |left| format!(", {} left", rough(left)));
                let text = format!("{} of {}{left}", swept.rows().len(), swept.sweep().len());
                ui.add(egui::ProgressBar::new(swept.share() as f32).desired_width(190.0).text(text));
                // What is left grows less even while nothing new is told.
                ui.ctx().request_repaint_after(std::time::Duration::from_secs(1));
            }
            None => {
                // First, where "Cancel" has been: a second click loses nothing.
                if let Some(swept) = swept.filter(|swept| !swept.complete()) {
                    let about = format!("{} of {} points are solved", swept.rows().len(), swept.sweep().len());
                    if ui.button("Continue").hint(about).clicked() {
                        cx.push(SweepCommand::Continue);
                    }
                }
                let about = "Solves every point on all cores; the window stays usable";
                let good = cx.state.sweep.faults().iter().all(Option::is_none);
                if button::first(ui, "Start the sweep", (swept.is_none(), good), cx).hint(about).clicked() {
                    cx.push(SweepCommand::Start);
                }
                let (combo, chosen) = fidelity::choose(ui, "fidelity", form.fidelity, None, cx);
                if let Some(fidelity) = chosen {
                    cx.push(SweepCommand::Fidelity(fidelity));
                }
                combo.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Fidelity of the sweep"));
                glossary::here(ui, combo, "Fidelity");
            }
        }
        quantity(ui, cx);
        if swept.is_some_and(|swept| !swept.rows().is_empty()) {
            export_button(ui, SWEEP, cx);
        }
    });
}

/// What is drawn of the points: changing it solves nothing.
fn quantity(ui: &mut Ui, cx: &DrawContext<'_>) {
    let swept = cx.state.sweep.swept().map(|swept| swept.sweep().problem());
    let Some(problem) = swept.or_else(|| cx.state.sweep.problem()) else { return };
    let all: Vec<Quantity> = Quantity::of(problem).collect();
    let present = cx.state.sweep.quantity(&all);
    let em = ui.text_style_height(&TextStyle::Body);
    let combo = ComboBox::from_id_salt("quantity")
        .selected_text(capitalised(present.words()))
        .width(11.0 * em)
        .height(36.0 * em)
        .show_ui(ui, |ui| {
            for quantity in all {
                let entry = ui.selectable_label(quantity == present, capitalised(&quantity.label(problem)));
                if glossary::hover(ui, entry, quantity.words()).clicked() {
                    cx.push(SweepCommand::Draw(quantity));
                }
            }
        });
    combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Result shown"));
    combo.response.hint("Which result is drawn; another one solves nothing anew");
}

fn introduction(ui: &mut Ui, cx: &DrawContext<'_>) {
    ui.add_space(8.0);
    for text in [
        "How do the results of this scene change with one of its parameters, or with two?",
        "Choose what to vary and start. Every point is a solve of its own, with its own stated error; click one to \
         make its scene the present one. Nothing is solved before you ask.",
    ] {
        cx.note(ui, text);
        ui.add_space(4.0);
    }
}

/// Of what the points are, and what is wrong with some.
fn state(ui: &mut Ui, swept: &Swept, cx: &DrawContext<'_>) {
    let mut say = |text: String, colour| cx.say(ui, text, colour);
    if swept.stale(cx.state.document.scene()) {
        let text = format!("Swept on “{}” before the scene changed; sweep again", swept.sweep().scene().name);
        say(text, cx.colours.alarm);
    }
    if let Some(failure) = swept.failure() {
        say(format!("The sweep ended early; Continue goes on with it: {failure}"), cx.colours.alarm);
    } else if !swept.running() && !swept.complete() {
        let text = format!("Cancelled; {} of {} points are solved", swept.rows().len(), swept.sweep().len());
        say(text, cx.colours.quiet);
    }
    let count = |failed: bool| {
        swept
            .rows()
            .iter()
            .filter(|row| matches!(row.status, RunStatus::Failed(_)) == failed && !converged(&row.status))
            .count()
    };
    for (number, what) in [(count(false), "did not converge"), (count(true), "have no solution")] {
        if number > 0 {
            say(format!("{number} of the points {what}: crosses, point at one to read why"), cx.colours.quiet);
        }
    }
}

fn converged(ending: &RunStatus) -> bool {
    *ending == RunStatus::Converged
}
