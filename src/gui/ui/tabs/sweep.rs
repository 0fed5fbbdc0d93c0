//! The sweep tab: the form for one or two parameters, the points as they are solved, and the choice of the result that is shown.

use crate::analysis::attempt::RunStatus;
use crate::analysis::quantity::Quantity;
use crate::digits::capitalised;
use crate::gui::command::{Command, SweepCommand};
use crate::gui::state::sweep::{Form, Swept, candidates};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::fidelity;
use crate::gui::ui::form::{AxisRow, list};
use crate::gui::ui::glossary::Explained;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::panels::menu::{SWEEP, export_button};
use crate::gui::ui::panels::parameters::GROUPS;
use crate::gui::ui::parts::first_button;
use crate::gui::ui::theme::outline_fields;
use crate::gui::ui::views::swept::{self, Plotted};
use eframe::egui::{Button, Role, Ui};

/// Shows the tab.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let Some(form) = cx.state.sweep.form.as_ref() else { return };
    outline_fields(ui);
    let mut asked = form.clone();
    ask(ui, &mut asked, cx);
    if asked != *form {
        cx.push(SweepCommand::Form(asked.clone()));
    }
    buttons(ui, &asked, cx);
    let Some(swept) = cx.state.sweep.swept.as_ref() else { return cx.introduce(ui, INTRODUCTION) };
    state(ui, swept, cx);
    let quantity = cx.state.sweep.quantity(&swept.sweep.quantities());
    let present = if swept.stale(cx.state.document.scene()) { None } else { swept.present(cx.state.document.scene()) };
    swept::show(ui, &Plotted { swept, quantity, present: present.as_deref() }, cx);
}

/// The form, with its faults.
fn ask(ui: &mut Ui, form: &mut Form, cx: &DrawContext<'_>) {
    for i in 0..form.axes().len() {
        ui.push_id(i, |ui| {
            ui.horizontal_wrapped(|ui| axis_row(ui, form, i, cx));
            cx.alarm(ui, cx.state.sweep.faults.get(i).into_iter().flatten());
        });
    }
    cx.alarm(ui, &cx.state.sweep.refusal);
}

fn axis_row(ui: &mut Ui, form: &mut Form, i: usize, cx: &DrawContext<'_>) {
    let along = ["along x", "along y"][i];
    let groups = || {
        let group =
            |table: &str| candidates(cx.state.document.scene()).filter(|found| found.table() == table).collect();
        let groups = GROUPS.iter().map(|(table, title, _)| (*title, group(table)));
        groups.filter(|(_, group): &(_, Vec<_>)| !group.is_empty()).collect()
    };
    let row = AxisRow {
        usual_count: form.usual_count(),
        parameter: [if i == 0 { "Vary" } else { "and" }, "What is varied", &format!("Parameter {along}")],
        groups: &groups,
        values: [(&format!("From {along}"), "The first value"), (&format!("To {along}"), "The last value")],
        width: 3.6,
        count: Some(&format!("Values {along}")),
        log: (&format!("Equal ratios {along}"), "Equal ratios from value to value instead of equal steps"),
    };
    row.show(ui, &mut form.axes[i], cx);
    if i == 0 && !form.second {
        if ui.button("Add a second…").hint("A map over two parameters").clicked() {
            form.set_second(true);
        }
    } else if i == 1 {
        let less = "Back to one parameter";
        if ui.small_button("✕").hint(less).accessible_name(less).clicked() {
            form.set_second(false);
        }
    }
}

fn buttons(ui: &mut Ui, form: &Form, cx: &DrawContext<'_>) {
    let swept = cx.state.sweep.swept.as_ref();
    let running = swept.filter(|swept| swept.running);
    let building = cx.state.sweep.building();
    let busy = building || running.is_some();
    ui.horizontal_wrapped(|ui| {
        // The button stays where it was pressed, so that a second click neither continues the sweep nor starts another.
        if busy || swept.is_some_and(|swept| !swept.complete()) {
            let about = "Ends the sweep; the solved points are kept, and it can be continued";
            let button = ui.add_enabled(busy, Button::new("Cancel the sweep"));
            cx.on_click(&button.hint(about), Command::CancelTab);
        }
        match running {
            _ if building => drop(ui.label("The points are being prepared")),
            Some(swept) => {
                let text = format!("{} of {}", swept.rows.len(), swept.sweep.len());
                cx.progress(ui, 190.0, swept.share(), &text, Some(swept.since()));
            }
            None => {
                if let Some(swept) = swept.filter(|swept| !swept.complete()) {
                    let about = format!("{} of {} points are solved", swept.rows.len(), swept.sweep.len());
                    cx.button(ui, "Continue", about, SweepCommand::Continue);
                }
                let about = "Solves every point on all cores; the window stays usable";
                let good = cx.state.sweep.faults.iter().all(Option::is_none);
                let button = first_button(ui, "Start the sweep", (swept.is_none(), good), cx);
                cx.on_click(&button.hint(about), SweepCommand::Start);
                let (combo, chosen) = fidelity::choose(ui, "fidelity", form.fidelity, cx);
                if let Some(fidelity) = chosen {
                    cx.push(SweepCommand::Form(Form { fidelity, ..form.clone() }));
                }
                combo.called(Role::ComboBox, "Fidelity of the sweep").explained_here(ui, "Fidelity");
            }
        }
        quantity(ui, cx);
        export_button(ui, SWEEP, cx);
    });
}

/// Choice of the result that is drawn; changing it solves nothing.
fn quantity(ui: &mut Ui, cx: &DrawContext<'_>) {
    let swept = cx.state.sweep.swept.as_ref().map(|swept| swept.sweep.problem());
    let Some(problem) = swept.or(cx.state.problem.as_ref()) else { return };
    let all: Vec<Quantity> = Quantity::of(problem).collect();
    let present = cx.state.sweep.quantity(&all);
    let called = ("Result shown", "The result that is drawn; changing it solves nothing again");
    list(ui, "quantity", called, (&capitalised(present.words()), 11.0), |ui| {
        for quantity in all {
            let entry = ui.selectable_label(quantity == present, capitalised(&quantity.label(problem)));
            cx.on_click(&entry.explained(ui, quantity.words()), SweepCommand::Draw(quantity));
        }
    });
}

/// Text of the empty tab.
const INTRODUCTION: &[&str] = &[
    "How do the results of this scene change with one of its parameters, or with two?",
    "Choose what to vary and start. Every point is a solve of its own, with its own stated error; click one to \
         make its scene the present one. Nothing is solved before you ask.",
];

/// State of the sweep: whether it belongs to the present scene, and how many points failed.
fn state(ui: &mut Ui, swept: &Swept, cx: &DrawContext<'_>) {
    let name = swept.sweep.headline();
    let stale = swept.stale(cx.state.document.scene());
    cx.alarm(ui, stale.then(|| format!("Swept on “{name}” before the scene changed; sweep again")));
    if let Some(failure) = &swept.failure {
        cx.alarm(ui, [format!("The sweep ended early; Continue goes on with it: {failure}")]);
    } else if !swept.running && !swept.complete() {
        cx.note(ui, format!("Cancelled; {} of {} points are solved", swept.rows.len(), swept.sweep.len()));
    }
    let unsound = || swept.rows.iter().filter(|row| row.status != RunStatus::Converged);
    let count = |failed: bool| unsound().filter(|row| matches!(row.status, RunStatus::Failed(_)) == failed).count();
    for (number, what) in [(count(false), "are not converged or not resolved"), (count(true), "have no solution")] {
        if number > 0 {
            cx.note(ui, format!("{number} of the points {what}: they are drawn as crosses; point at one to read why"));
        }
    }
}
