//! The choice of a fidelity, one of four names or a typed accuracy, and of the time limit of a solve.

use super::context::DrawContext;
use super::glossary::Explained;
use super::hint::Hint;
use crate::digits::parse_duration;
use crate::fidelity::{Fidelity, parse_accuracy};
use crate::gui::command::Command;
use eframe::egui::{ComboBox, Id, Key, PopupCloseBehavior, Response, TextEdit, Tooltip, Ui};

/// Width of a field, and least width of the list \[points\].
const FIELD: f32 = 72.0;
const LIST: f32 = 190.0;

/// The fields of a list; each identifier is appended to that of the list.
const ACCURACY: &str = "accuracy";
const BUDGET: &str = "budget";

/// A combo box that shows `present`; returns the choice if it is another.
pub fn choose(ui: &mut Ui, id: &'static str, present: Fidelity, cx: &DrawContext<'_>) -> (Response, Option<Fidelity>) {
    list(ui, (id, None), present.to_string(), |ui| fidelities(ui, id, present, cx))
}

/// As [`choose`], for all later solves, with a field for the time limit of a solve.
pub fn choose_target(ui: &mut Ui, present: Fidelity, width: f32, cx: &DrawContext<'_>) -> (Response, Option<Fidelity>) {
    const ID: &str = "target";
    let budget = cx.state.budget.map(|budget| format!("{budget:?}"));
    let shown = budget.as_ref().map_or_else(|| present.to_string(), |budget| format!("{present}, within {budget}"));
    list(ui, (ID, Some(width)), shown, |ui| {
        let chosen = fidelities(ui, ID, present, cx);
        let hint = "The longest time that a solve may take, such as 20ms or 1.5s; after it, the best result so far is shown. \
                    Leave it empty for no limit";
        let read = |text: &str| if text.trim().is_empty() { Ok(None) } else { parse_duration(text).map(Some) };
        let field = Field { label: "in at most", name: "Time for a solve", example: "any time", hint };
        if let Some(budget) = field.show(ui, (ID, BUDGET), budget.unwrap_or_default(), read, cx) {
            cx.push(Command::Budget(budget));
        }
        chosen
    })
}

/// The combo box. Returns the choice made in its list. Text typed there is dropped when the list closes.
fn list(
    ui: &mut Ui,
    (id, width): (&'static str, Option<f32>),
    shown: String,
    show: impl FnOnce(&mut Ui) -> Option<Fidelity>,
) -> (Response, Option<Fidelity>) {
    let combo = ComboBox::from_id_salt(id)
        .selected_text(shown)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .truncate();
    let combo = if let Some(width) = width { combo.width(width) } else { combo };
    let shown = combo.show_ui(ui, |ui| {
        ui.set_min_width(LIST);
        show(ui)
    });
    if shown.inner.is_none() {
        ui.data_mut(|data| {
            for field in [ACCURACY, BUDGET] {
                data.remove::<Typed>(Id::unique((id, field)));
            }
        });
    }
    (shown.response, shown.inner.flatten())
}

fn fidelities(ui: &mut Ui, id: &'static str, present: Fidelity, cx: &DrawContext<'_>) -> Option<Fidelity> {
    let mut chosen = None;
    for fidelity in Fidelity::ALL {
        if ui.selectable_label(fidelity == present, fidelity.name()).explained(ui, fidelity.name()).clicked() {
            ui.close();
            chosen = Some(fidelity);
        }
    }
    ui.separator();
    let hint = "The stated relative error to solve for: from 0.0001 % to 50 %";
    let field = Field { label: "or an error of", name: "Accuracy", example: "0.1 %", hint };
    let named = Fidelity::ALL.contains(&present);
    let number = if named { String::new() } else { present.to_string() };
    let typed = field.show(ui, (id, ACCURACY), number, parse_accuracy, cx);
    chosen.or(typed.map(Fidelity::to)).filter(|fidelity| *fidelity != present)
}

/// Text of a field, with the reason if it was refused.
type Typed = (String, Option<String>);

/// A field whose text is committed when the field loses the focus.
struct Field {
    label: &'static str,
    name: &'static str,
    example: &'static str,
    hint: &'static str,
}

impl Field {
    /// The value that was typed to replace `present`, once it can be read; other text stays, with the reason beside it.
    fn show<T>(
        &self,
        ui: &mut Ui,
        id: (&'static str, &'static str),
        present: String,
        read: impl Fn(&str) -> Result<T, String>,
        cx: &DrawContext<'_>,
    ) -> Option<T> {
        let id = Id::unique(id);
        let typed = ui.data(|data| data.get_temp::<Typed>(id));
        let (mut text, mut refused) = typed.unwrap_or_else(|| (present.clone(), None));
        let field = ui.horizontal(|ui| {
            let label = ui.label(self.label);
            let field = TextEdit::singleline(&mut text).desired_width(FIELD).hint_text(self.example);
            ui.add(field).labelled_by(label.id).accessible_name(self.name)
        });
        let field = field.inner.hint(self.hint);
        let mut taken = None;
        if field.lost_focus() && text != present && !ui.input(|input| input.key_pressed(Key::Escape)) {
            match read(&text) {
                Ok(found) => {
                    taken = Some(found);
                    ui.close();
                }
                Err(fault) => {
                    refused = Some(fault);
                    ui.data_mut(|data| data.insert_temp::<Typed>(id, (text, refused.clone())));
                }
            }
        } else if field.changed() {
            refused = None;
            ui.data_mut(|data| data.insert_temp::<Typed>(id, (text, None)));
        }
        if let Some(fault) = refused {
            // Beside the list, which does not grow once it is open.
            Tooltip::for_widget(&field).show(|ui| cx.alarm(ui, [fault]));
        }
        taken
    }
}
