//! An editor for an array of tables, such as the parts of a ring: one small table for each, with a number, choice or text in each row. A
//! refused number stays in its field, with the reason below its table, until it is corrected, Escape restores the value, or anything else
//! is edited.

use crate::gui::command::Command;
use crate::gui::derived::words::{choice, field_name, label};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::form::show_list;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::parts::{Entered, entered_box};
use crate::scene::edges::{self, inner_edge, with_edge};
use crate::scene::{Parameter, ParameterKind, Value};
use eframe::egui::{self, Id, RichText};

/// Change of a length per point of dragging \[mm\].
const SPEED: f64 = 0.02;

/// Decimals of a number that are shown.
const DECIMALS: usize = 4;

/// The last edit in one of the tables of an array.
#[derive(Clone, Debug)]
struct LastEdit {
    /// The index of the table, and the index of the value in it.
    at: [usize; 2],
    /// The text, if a number was typed.
    entered: Option<Entered>,
    /// The array after the edit; the present array if the text is invalid.
    array: Value,
    /// The frame in which the edit was made; it is carried out after that frame is drawn.
    frame: u64,
}

impl LastEdit {
    fn id_of(key: &'static str) -> Id {
        Id::unique(("tried", key))
    }

    /// The last edit in the array of `key`, and why it is refused. An edit that is accepted is forgotten.
    fn refused(ui: &egui::Ui, cx: &DrawContext<'_>, key: &'static str) -> Option<(Self, String)> {
        let tried: Self = ui.data(|data| data.get_temp(Self::id_of(key)))?;
        let fault = tried.entered.as_ref().and_then(|(_, fault)| fault.clone());
        let fault = fault.filter(|_| cx.state.document.scene().get(key).as_ref() == Some(&tried.array));
        let why = fault.or_else(|| cx.state.rejected.of_value(key, &tried.array).map(str::to_owned));
        if why.is_none() && ui.ctx().cumulative_frame_nr() > tried.frame {
            ui.data_mut(|data| data.remove::<Self>(Self::id_of(key)));
        }
        Some((tried, why?))
    }
}

/// Whether the reason for the refusal of the last edit of `key` is shown at one of its tables.
pub fn tells(ui: &egui::Ui, key: &'static str) -> bool {
    ui.data(|data| data.get_temp::<LastEdit>(LastEdit::id_of(key))).is_some()
}

/// Shows `records` of the key `parameter`, each with the values of `columns`, and pushes the array that results from an edit.
pub fn show(
    ui: &mut egui::Ui,
    cx: &DrawContext<'_>,
    parameter: &'static Parameter,
    columns: &'static [Parameter],
    fewest: usize,
    records: &[Vec<Value>],
) {
    let set = |records: Vec<Vec<Value>>, dragging: bool| {
        cx.push(Command::Set { key: parameter.key, value: Value::Records(records), dragging });
    };
    let one = label(parameter).trim_end_matches('s').to_lowercase();
    let drawn = ui.ctx().cumulative_frame_nr();
    let refused = LastEdit::refused(ui, cx, parameter.key);
    for (number, record) in records.iter().enumerate() {
        let name = edges::name(record).map_or_else(|| format!("{one} {}", number + 1), str::to_owned);
        let refused = refused.as_ref().filter(|(tried, _)| tried.at[0] == number);
        let frame = egui::Frame::new().stroke(ui.visuals().widgets.noninteractive.bg_stroke).corner_radius(4);
        frame.inner_margin(4).show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.horizontal(|ui| {
                ui.add(egui::Label::new(RichText::new(&name).strong()).truncate().selectable(false));
                if records.len() > fewest {
                    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                        let hint = format!("Take {name} out of the section");
                        if ui.small_button("Remove").hint(hint).clicked() {
                            let rest = records.iter().enumerate().filter(|(i, _)| *i != number);
                            set(rest.map(|(_, record)| record.clone()).collect(), false);
                        }
                    });
                }
            });
            egui::Grid::new((parameter.key, number)).num_columns(2).show(ui, |ui| {
                for (place, (of, value)) in columns.iter().zip(record).enumerate() {
                    let named = ui.add(egui::Label::new(label(of)).selectable(false)).hint_beside(ui, of.about);
                    let spoken = format!("{}, {name}", field_name(of));
                    let kept = refused.filter(|(tried, _)| tried.at[1] == place);
                    let kept = kept.and_then(|(tried, _)| tried.entered.as_ref()).map(|(text, _)| text.as_str());
                    if let Some(ValueEdit { value, dragging, entered }) =
                        cell(ui, (of, value, kept), (named.id, &spoken), cx)
                    {
                        let mut edited = records.to_vec();
                        match value {
                            // An edge that two parts share is moved in both.
                            Some(Value::Number(to)) if fewest > 0 => {
                                let lengths = columns[..place].iter().filter(|column| column.range().is_some());
                                edited = with_edge(records, (number, lengths.count()), to);
                            }
                            Some(value) => edited[number][place] = value,
                            None => {}
                        }
                        if !matches!(entered, Some((_, Some(_)))) {
                            // Setting the present value again withdraws a refusal.
                            set(edited.clone(), dragging);
                        }
                        let tried =
                            LastEdit { at: [number, place], entered, array: Value::Records(edited), frame: drawn };
                        ui.data_mut(|data| data.insert_temp(LastEdit::id_of(parameter.key), tried));
                    }
                    ui.end_row();
                }
            });
            cx.alarm(ui, refused.map(|(_, why)| why.as_str()));
        });
    }
    if ui.button(format!("Add {one}")).hint(format!("Another {one}, as the last one")).clicked() {
        // The first support is on the inner edge of the ring, because one that touches no part is refused.
        let edge = match cx.state.document.scene().get("rotor.part") {
            Some(Value::Records(parts)) => inner_edge(&parts),
            _ => None,
        };
        let new = || {
            let mut lengths = edge.into_iter().flatten().map(Value::Number);
            let first = |column: &Parameter| column.range().and_then(|_| lengths.next()).or_else(|| column.default());
            columns.iter().map(first).map(|value| value.unwrap_or(Value::Number(0.0))).collect()
        };
        let mut another: Vec<Value> = records.last().cloned().unwrap_or_else(new);
        // The new part is on top of the last one, so that it is connected and nothing overlaps.
        let at = |key: &str| columns.iter().position(|column| column.key == key);
        if let (Some(bottom), Some(top), true) = (at("z_bottom_mm"), at("z_top_mm"), fewest > 0) {
            let [low, high] = [bottom, top].map(|i| another[i].as_number().unwrap_or_default());
            (another[bottom], another[top]) = (Value::Number(high), Value::Number(high + (high - low)));
        }
        if let Some(Value::Text(name)) = another.first_mut().filter(|_| columns[0].key == "name") {
            *name = format!("{one} {}", records.len() + 1);
        }
        set(records.iter().cloned().chain([another]).collect(), false);
    }
}

/// An edit of one value.
struct ValueEdit {
    /// The new value; `None` if invalid text was entered, or if Escape dropped the text.
    value: Option<Value>,
    /// Whether a pointer still drags it.
    dragging: bool,
    /// The text, if a number was typed.
    entered: Option<Entered>,
}

/// A value, or the refused text in its place. Returns the edit of it.
fn cell(
    ui: &mut egui::Ui,
    (of, value, refused): (&'static Parameter, &Value, Option<&str>),
    (name, spoken): (Id, &str),
    cx: &DrawContext<'_>,
) -> Option<ValueEdit> {
    let taken = |value: Value| ValueEdit { value: Some(value), dragging: false, entered: None };
    match (of.kind, value) {
        (ParameterKind::Number { range, .. }, value) => {
            let present = value.as_number()?;
            let mut number = present;
            let drag = egui::DragValue::new(&mut number).speed(SPEED).max_decimals(DECIMALS);
            let drag = match refused {
                Some(text) => drag.custom_formatter(move |_, _| text.to_owned()),
                None => drag.suffix(format!(" {}", of.unit)),
            };
            let usual = ui.visuals().override_text_color;
            // There is no scope here, because it would change the ids of the fields below.
            if refused.is_some() {
                ui.visuals_mut().override_text_color = Some(cx.colours.alarm);
            }
            let (response, entered) = entered_box(ui, drag, (range.min..=range.max, of.unit));
            if refused.is_some() {
                ui.visuals_mut().override_text_color = usual;
            }
            let response = response.labelled_by(name).accessible_name(spoken).hint_beside(ui, of.about);
            let faulty = matches!(entered, Some((_, Some(_))));
            let escaped = response.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Escape));
            if faulty || refused.is_some() && escaped {
                return Some(ValueEdit { value: None, dragging: false, entered });
            }
            // A drag sets a round value; a field that only loses the focus keeps the decimals that it does not show.
            let shown = |number: f64| format!("{number:.DECIMALS$}");
            let number = match number {
                number if response.dragged() => (100.0 * number).round() / 100.0,
                number if shown(number) == shown(present) => present,
                number => number,
            };
            let done = response.drag_stopped() || (refused.is_some() && entered.is_some());
            let edit = ValueEdit { value: Some(Value::Number(number)), dragging: response.dragged(), entered };
            ((response.changed() && number != present) || done).then_some(edit)
        }
        (ParameterKind::Choice { options, .. }, Value::Text(chosen)) => {
            let mut picked = None;
            let combo = egui::ComboBox::from_id_salt(name).selected_text(choice(of.key, chosen));
            let combo = show_list(ui, combo, |ui| {
                for option in options {
                    let row = ui.add(egui::Button::selectable(*option == chosen, choice(of.key, option)));
                    if row.clicked() && *option != chosen {
                        picked = Some(Value::Text((*option).to_owned()));
                    }
                }
            });
            combo.labelled_by(name).hint_beside(ui, of.about);
            picked.map(taken)
        }
        (_, Value::Text(text)) => {
            let id = name.with("text");
            let mut edited = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| text.clone());
            let response = ui.add(egui::TextEdit::singleline(&mut edited).desired_width(120.0)).labelled_by(name);
            let response = response.accessible_name(spoken).hint_beside(ui, of.about);
            if response.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                let kept = edited != *text && !ui.input(|input| input.key_pressed(egui::Key::Escape));
                return kept.then(|| taken(Value::Text(edited)));
            }
            if response.has_focus() {
                ui.data_mut(|data| data.insert_temp(id, edited));
            }
            None
        }
        _ => None,
    }
}
