//! A field for typed values. Refused text stays in the field, with the reason below it, until it is corrected or Escape restores the value.

use crate::digits::rounded;
use crate::gui::command::Command;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::text_width;
use crate::scene::Value;
use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{self, Id, Key, TextStyle};

/// Width of a field for numbers, in heights of the text.
const NUMBER: f32 = 4.4;
/// Most and fewest significant digits of a number that is not being edited; as many are shown as fit. While the cursor is in the field, all
/// digits are shown.
const DIGITS: usize = 6;
const FEWEST_DIGITS: usize = 3;
/// Texts longer than this \[bytes\] stay on one line, so that they do not fill the panel.
const LONGEST_WRAPPED: usize = 400;

/// Text that differs from the scene.
#[derive(Clone, Debug)]
struct Edit {
    text: String,
    stage: Stage,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    /// The cursor is in the field.
    Typing,
    /// Committed by Enter; if the text is refused, the cursor stays in the field.
    Entered,
    /// Committed because the field lost the focus, or refused already.
    Left,
}

/// One field.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// Dotted key.
    pub key: &'static str,
    /// The value in the scene; `None` if there is no value to restore.
    pub value: Option<&'a Value>,
    /// Name for screen readers.
    pub name: &'a str,
    /// Placeholder of an empty field.
    pub hint: &'static str,
}

impl Field<'_> {
    /// Shows the field, and pushes the commands that follow from the input.
    pub fn show(&self, ui: &mut egui::Ui, cx: &DrawContext<'_>) -> egui::Response {
        let id = id_of(self.key);
        let present = self.value.map(plain).unwrap_or_default();
        let refused = cx.state.rejected.of(self.key).is_some();
        let edit = pending(ui, id, refused);
        let focused = ui.memory(|memory| memory.has_focus(id));
        let mut text = match (&edit, self.value) {
            (Some(edit), _) => edit.text.clone(),
            (None, Some(Value::Number(number))) if !focused => fitting(ui, *number),
            (None, _) => present.clone(),
        };
        let alarmed = refused && edit.is_some();
        let (align, width) = match self.value {
            None | Some(Value::Text(_)) => (egui::Align2::LEFT_CENTER, f32::INFINITY),
            Some(_) => (egui::Align2::RIGHT_CENTER, number_width(ui)),
        };
        let editor = if matches!(self.value, Some(Value::Text(_))) && text.len() <= LONGEST_WRAPPED {
            egui::TextEdit::multiline(&mut text).desired_rows(1).return_key(None)
        } else {
            egui::TextEdit::singleline(&mut text)
        };
        let entered = focused && ui.input(|input| input.key_pressed(Key::Enter));
        let response = editor
            .id(id)
            .desired_width(width)
            .align(align)
            .hint_text(self.hint)
            .text_color_opt(alarmed.then_some(cx.colours.alarm))
            .show(ui)
            .response
            .response
            .accessible_name(self.name);
        if entered {
            ui.memory_mut(|memory| memory.surrender_focus(id));
        }
        if response.gained_focus() {
            select_all(ui, id, edit.as_ref().map_or(&present, |edit| &edit.text));
        }
        let escaped = ui.input(|input| input.key_pressed(Key::Escape));
        let typing = edit.as_ref().is_some_and(|edit| edit.stage == Stage::Typing) || response.changed();
        if response.has_focus() {
            if typing || edit.is_some() {
                keep(ui, id, text, Stage::Typing);
            }
        } else if typing || (refused && response.lost_focus() && escaped) {
            // A field that was not shown for a while has not just lost the focus.
            let left = response.lost_focus() && !escaped;
            let handed = if entered { Stage::Entered } else { Stage::Left };
            self.finish(ui, id, &text, (left && text.trim() != present).then_some(handed), cx);
        }
        response
    }

    /// The cursor has left the field: commits the text, with this stage, or drops it.
    fn finish(&self, ui: &egui::Ui, id: Id, text: &str, handed: Option<Stage>, cx: &DrawContext<'_>) {
        if let Some(stage) = handed {
            cx.push(self.submit(text));
            keep(ui, id, text.to_owned(), stage);
            return;
        }
        ui.data_mut(|data| data.remove::<Edit>(id));
        if let (Some(_), Some(value)) = (cx.state.rejected.of(self.key), self.value) {
            // Setting the present value again withdraws the refusal.
            cx.push(Command::Set { key: self.key, value: value.clone(), dragging: false });
        }
    }

    fn submit(&self, text: &str) -> Command {
        match self.value {
            // Free text is taken as it is, on one line.
            Some(Value::Text(_)) => {
                let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
                Command::Set { key: self.key, value: Value::Text(line), dragging: false }
            }
            _ => Command::SetText(self.key, text.trim().to_owned()),
        }
    }
}

/// Width of a field for a number \[points\].
pub fn number_width(ui: &egui::Ui) -> f32 {
    NUMBER * ui.text_style_height(&TextStyle::Body)
}

/// The number, with as many digits as fit.
fn fitting(ui: &egui::Ui, number: f64) -> String {
    let room = number_width(ui).min(ui.available_width()) - 2.0 * ui.spacing().button_padding.x;
    let text = |digits| plain(&Value::Number(rounded(number, digits)));
    let fits = |digits: &usize| text_width(ui, &text(*digits)) <= room;
    text((FEWEST_DIGITS..=DIGITS).rev().find(fits).unwrap_or(FEWEST_DIGITS))
}

/// Text that differs from the scene, if there is any.
fn pending(ui: &egui::Ui, id: Id, refused: bool) -> Option<Edit> {
    let edit: Edit = ui.data(|data| data.get_temp(id))?;
    match edit.stage {
        Stage::Typing => {}
        _ if !refused => {
            ui.data_mut(|data| data.remove::<Edit>(id));
            return None;
        }
        Stage::Entered => {
            ui.memory_mut(|memory| memory.request_focus(id));
            keep(ui, id, edit.text.clone(), Stage::Left);
        }
        Stage::Left => {}
    }
    Some(edit)
}

/// Whether the field of `key` holds text that differs from the scene.
pub fn holds_text(ui: &egui::Ui, key: &'static str) -> bool {
    ui.data(|data| data.get_temp::<Edit>(id_of(key))).is_some()
}

/// Puts the cursor into the field of `key`, which shows `value`; typed text replaces it.
pub fn enter(ui: &egui::Ui, key: &'static str, value: &Value) {
    ui.memory_mut(|memory| memory.request_focus(id_of(key)));
    select_all(ui, id_of(key), &plain(value));
}

fn id_of(key: &'static str) -> Id {
    Id::unique(("parameter", key))
}

/// The value in the form in which it is edited: texts in full.
fn plain(value: &Value) -> String {
    match value {
        Value::Text(text) => text.clone(),
        other => other.to_string(),
    }
}

fn keep(ui: &egui::Ui, id: Id, text: String, stage: Stage) {
    ui.data_mut(|data| data.insert_temp(id, Edit { text, stage }));
}

/// Selects all of a text field.
pub fn select_all(ui: &egui::Ui, id: Id, text: &str) {
    let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
    let all = CCursorRange::two(CCursor::default(), CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(all));
    state.store(ui.ctx(), id);
}
