//! Parts of forms: a field, a list, and a row with a parameter and the two ends of its range.

use super::context::DrawContext;
use super::hint::Hint;
use crate::gui::command::Command;
use crate::gui::derived::words::{choice, chosen, label};
use crate::gui::state::sweep::AxisForm;
use crate::scene::{Parameter, Value};
use eframe::egui::{Button, ComboBox, Key, Response, RichText, Role, TextEdit, TextStyle, Ui};

/// Width of the list of parameters, in heights of the text.
const PARAMETERS: f32 = 11.0;

/// A field for a line of text with the name `name`; `empty` is its placeholder. The width is in heights of the text.
pub(super) fn field(ui: &mut Ui, (name, about): (&str, &str), (text, empty): (&mut String, &'static str), width: f32) {
    let width = width * ui.text_style_height(&TextStyle::Body);
    let response = ui.add(TextEdit::singleline(text).desired_width(width).hint_text(empty));
    response.called(Role::TextInput, name).hint(about);
}

/// Shows the `entries` of a list, and returns its box. The list closes when Enter or the space bar chooses an entry, as it does after a
/// click; then the box gets the keyboard focus again.
pub(super) fn show_list(ui: &mut Ui, list: ComboBox<'_>, entries: impl FnOnce(&mut Ui)) -> Response {
    let shown = list.show_ui(ui, |ui| {
        entries(ui);
        // The key that opens the list is pressed while the box has the focus; the box is in another layer.
        let pressed = ui.input(|input| [Key::Enter, Key::Space].iter().any(|key| input.key_pressed(*key)));
        let focused = ui.memory(|memory| memory.focused()).filter(|_| pressed);
        let focused = focused.and_then(|id| ui.ctx().read_response(id));
        let taken = focused.is_some_and(|entry| entry.layer_id == ui.layer_id());
        if taken {
            ui.close();
        }
        taken
    });
    if shown.inner == Some(true) {
        shown.response.request_focus();
    }
    shown.response
}

/// A list with the name `name` that shows the present choice; `entries` draws the options. The width of the box is in heights of the text.
pub(super) fn list(
    ui: &mut Ui,
    id: &str,
    (name, about): (&str, &str),
    (chosen, width): (&str, f32),
    entries: impl FnOnce(&mut Ui),
) {
    let em = ui.text_style_height(&TextStyle::Body);
    let list = ComboBox::from_id_salt(id).selected_text(chosen).width(width * em).height(36.0 * em);
    show_list(ui, list, entries).called(Role::ComboBox, name).hint(about);
}

/// A list of the options of a parameter, with the decision of the plan for an automatic choice. A new choice is set at once.
pub(super) fn choices(ui: &mut Ui, parameter: &'static Parameter, width: f32, cx: &DrawContext<'_>) -> Response {
    let plan = cx.state.run.as_ref().map_or(&[][..], |run| &run.solution.model.decisions);
    let name = match cx.state.document.scene().get(parameter.key) {
        Some(Value::Text(name)) => name,
        // This is the switch of a run of the other kind of scene.
        _ => String::new(),
    };
    let list = ComboBox::from_id_salt(parameter.key).selected_text(chosen(parameter.key, &name, plan));
    show_list(ui, list.width(width).truncate(), |ui| {
        for option in parameter.options() {
            // The option of a table is chosen by giving its file, below.
            let file = parameter.key == "rotor.model" && ["table", "green"].contains(option);
            let possible = !file || *option == name;
            let text = choice(parameter.key, option);
            let picked = ui.add_enabled(possible, Button::selectable(*option == name, text));
            if picked.on_disabled_hover_text("Give a CSV file below").clicked() && *option != name {
                let value = Value::Text((*option).to_owned());
                cx.push(Command::Set { key: parameter.key, value, dragging: false });
            }
        }
    })
}

/// A parameter with two values, as typed.
pub(super) struct AxisRow<'a> {
    /// Default number of values when another parameter is chosen.
    pub(super) usual_count: usize,
    /// Text before the list, purpose of the parameter, and name of the list for screen readers.
    pub(super) parameter: [&'a str; 3],
    /// Parameters to choose from, in groups; a group with an empty title has no heading.
    pub(super) groups: &'a dyn Fn() -> Vec<(&'static str, Vec<&'static Parameter>)>,
    /// Name and explanation of the fields of both values.
    pub(super) values: [(&'a str, &'a str); 2],
    /// Their width, in heights of the text.
    pub(super) width: f32,
    /// Name of the field for the number of values, if there is one.
    pub(super) count: Option<&'a str>,
    /// Name and explanation of the checkbox for equal ratios.
    pub(super) log: (&'a str, &'a str),
}

impl AxisRow<'_> {
    /// Shows what was typed, to be changed.
    pub(super) fn show(self, ui: &mut Ui, axis: &mut AxisForm, cx: &DrawContext<'_>) {
        let Self { usual_count, parameter: [before, what, name], groups, values: [from, to], width, count, log } = self;
        ui.label(before);
        let parameter = Parameter::find(axis.key);
        let about = format!("{what}. {}", parameter.map_or("", |parameter| parameter.about));
        list(ui, "parameter", (name, &about), (parameter.map_or(axis.key, label), PARAMETERS), |ui| {
            for (title, group) in groups() {
                if !title.is_empty() {
                    ui.label(RichText::new(title).color(cx.colours.quiet));
                }
                for parameter in group {
                    let entry = ui.selectable_label(parameter.key == axis.key, label(parameter));
                    if entry.hint_beside(ui, parameter.about).clicked() {
                        *axis = AxisForm::around(cx.state.document.scene(), parameter.key, usual_count);
                    }
                }
            }
        });
        ui.label("from");
        field(ui, from, (&mut axis.from, ""), width);
        ui.label("to");
        field(ui, to, (&mut axis.to, ""), width);
        if let Some(unit) = parameter.map(|parameter| parameter.unit).filter(|unit| !unit.is_empty()) {
            ui.label(RichText::new(unit).color(cx.colours.quiet));
        }
        if let Some(name) = count {
            field(ui, (name, "How many values, both ends counted"), (&mut axis.count, ""), 4.0);
            ui.label("values");
        }
        ui.checkbox(&mut axis.log, "log").hint(log.1).accessible_name(log.0);
    }
}
