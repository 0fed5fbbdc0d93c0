//! An editor for an array of tables, such as the parts of a ring: one small table for each, with a number, choice or text a row.

use crate::gui::command::Command;
use crate::gui::derived::words::{choice, field_name, label};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::form::show_list;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::parts::number_box;
use crate::scene::edges::{inner_edge, with_edge};
use crate::scene::{Parameter, ParameterKind, Value};
use eframe::egui::{self, RichText};

/// Change of a length per point of dragging \[mm\].
const SPEED: f64 = 0.02;

/// Decimals of a number that are shown.
const DECIMALS: usize = 4;

/// Shows `records` of the key `parameter`, each with the values of `columns`, and pushes the array that an edit makes of them.
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
    for (number, record) in records.iter().enumerate() {
        let name = match record.first() {
            Some(Value::Text(name)) if !name.is_empty() => name.clone(),
            _ => format!("{one} {}", number + 1),
        };
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
                    if let Some((value, dragging)) = cell(ui, of, value, (named.id, &spoken), cx) {
                        let mut edited = records.to_vec();
                        match value {
                            // What two parts share moves in both.
                            Value::Number(to) if fewest > 0 => {
                                let side = columns[..place].iter().filter(|column| column.range().is_some()).count();
                                edited = with_edge(records, (number, side), to);
                            }
                            value => edited[number][place] = value,
                        }
                        set(edited, dragging);
                    }
                    ui.end_row();
                }
            });
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
        // On top of the last one, so that it is connected and nothing overlaps.
        let at = |key: &str| columns.iter().position(|column| column.key == key);
        if let (Some(bottom), Some(top)) = (at("z_bottom_mm"), at("z_top_mm")) {
            let height = |i: usize| another[i].as_number().unwrap_or_default();
            let (low, high) = (height(bottom), height(top));
            if fewest > 0 {
                (another[bottom], another[top]) = (Value::Number(high), Value::Number(high + (high - low)));
            }
        }
        if let Some(Value::Text(name)) = another.first_mut().filter(|_| columns[0].key == "name") {
            *name = format!("{one} {}", records.len() + 1);
        }
        set(records.iter().cloned().chain([another]).collect(), false);
    }
}

/// One value; what an edit makes of it, and whether a pointer still drags it.
fn cell(
    ui: &mut egui::Ui,
    of: &'static Parameter,
    value: &Value,
    (name, spoken): (egui::Id, &str),
    cx: &DrawContext<'_>,
) -> Option<(Value, bool)> {
    match (of.kind, value) {
        (ParameterKind::Number { range, .. }, value) => {
            let present = value.as_number()?;
            let mut number = present;
            let drag =
                egui::DragValue::new(&mut number).speed(SPEED).max_decimals(DECIMALS).suffix(format!(" {}", of.unit));
            let response = number_box(ui, drag, (range.min..=range.max, of.unit), cx);
            let response = response.labelled_by(name).accessible_name(spoken).hint_beside(ui, of.about);
            // What a drag makes of it is round; a field that is only left keeps the decimals that it does not show.
            let shown = |number: f64| format!("{number:.DECIMALS$}");
            let number = match number {
                number if response.dragged() => (100.0 * number).round() / 100.0,
                number if shown(number) == shown(present) => present,
                number => number,
            };
            let done = response.drag_stopped();
            ((response.changed() && number != present) || done).then(|| (Value::Number(number), response.dragged()))
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
            picked.map(|value| (value, false))
        }
        (_, Value::Text(text)) => {
            let id = name.with("text");
            let mut edited = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| text.clone());
            let response = ui.add(egui::TextEdit::singleline(&mut edited).desired_width(120.0)).labelled_by(name);
            let response = response.accessible_name(spoken).hint_beside(ui, of.about);
            if response.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                let kept = edited != *text && !ui.input(|input| input.key_pressed(egui::Key::Escape));
                return kept.then_some((Value::Text(edited), false));
            }
            if response.has_focus() {
                ui.data_mut(|data| data.insert_temp(id, edited));
            }
            None
        }
        _ => None,
    }
}
