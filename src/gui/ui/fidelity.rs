//! The choice of a fidelity: one of the four names, or an accuracy that is typed.

use super::context::DrawContext;
use super::glossary;
use super::hint::Hint;
use crate::fidelity::{Fidelity, parse_accuracy};
use eframe::egui::{ComboBox, Id, Key, PopupCloseBehavior, Response, Ui};

/// Width of the field for an accuracy \[points\].
const FIELD: f32 = 72.0;

/// A combo box that shows `present`, and what was chosen instead of it. `width` is that of the box; none is the usual one.
pub fn choose(
    ui: &mut Ui,
    id: &'static str,
    present: Fidelity,
    width: Option<f32>,
    cx: &DrawContext<'_>,
) -> (Response, Option<Fidelity>) {
    let mut chosen = None;
    let combo = ComboBox::from_id_salt(id)
        .selected_text(present.to_string())
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .truncate();
    let combo = if let Some(width) = width { combo.width(width) } else { combo };
    let shown = combo.show_ui(ui, |ui| {
        for fidelity in Fidelity::ALL {
            let entry = ui.selectable_label(fidelity == present, fidelity.name());
            if glossary::hover(ui, entry, fidelity.name()).clicked() {
                chosen = Some(fidelity);
            }
        }
        ui.separator();
        let (typed, refused) = (Id::unique((id, "typed")), Id::unique((id, "refused")));
        let mut text: String = ui.data(|data| data.get_temp(typed)).unwrap_or_default();
        let field = ui.horizontal(|ui| {
            let label = ui.label("or");
            let field = eframe::egui::TextEdit::singleline(&mut text).desired_width(FIELD).hint_text("0.1 %");
            ui.add(field).labelled_by(label.id).accessible_name("Accuracy")
        });
        let field = field.inner.hint("The stated relative error to solve for, then Enter: from 0.0001 % to 50 %");
        if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
            let read = parse_accuracy(&text);
            ui.data_mut(|data| data.insert_temp(refused, read.clone().err().unwrap_or_default()));
            chosen = read.ok().map(Fidelity::to);
        } else if field.changed() {
            ui.data_mut(|data| data.remove::<String>(refused));
        }
        if chosen.is_some() {
            text.clear();
            ui.close();
        }
        ui.data_mut(|data| data.insert_temp(typed, text));
        if let Some(fault) = ui.data(|data| data.get_temp::<String>(refused)).filter(|fault| !fault.is_empty()) {
            cx.say(ui, fault, cx.colours.alarm);
        }
    });
    (shown.response, chosen.filter(|fidelity| *fidelity != present))
}
