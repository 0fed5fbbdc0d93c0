//! Areas that react to the pointer, and the row of values below a view.

use crate::gui::ui::hint::Hint;
use crate::gui::ui::paint::PlotStyle;
use eframe::egui::{Align2, Rect, Response, Role, Sense, Ui, pos2};

/// A named area that can be pointed at, clicked or dragged.
pub(super) fn named(ui: &Ui, rect: Rect, name: &str, sense: Sense) -> Response {
    ui.interact(rect, ui.scope_id().with(name), sense).called(Role::Image, name)
}

/// Values beside each other, in as many lines as they take.
fn lines<T: AsRef<str>>(values: &[T], style: &PlotStyle, width: f32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for value in values.iter().map(AsRef::as_ref) {
        let longer = lines.last().map(|line| format!("{line}   {value}"));
        match (lines.last_mut(), longer.filter(|longer| style.width(longer) <= width)) {
            (Some(line), Some(longer)) => *line = longer,
            _ => lines.push(value.to_owned()),
        }
    }
    lines
}

/// Height of the lines that `values` take.
pub(super) fn readout_height(values: &[&str], style: &PlotStyle, width: f32) -> f32 {
    lines(values, style, width).len() as f32 * style.row + 4.0
}

/// Writes the values under the pointer; a single text is a hint.
pub(super) fn read_out(values: &[String], style: &PlotStyle, rect: Rect) {
    let mut at = pos2(rect.left(), rect.top() + 4.0);
    let colour = if values.len() == 1 { style.palette.quiet } else { style.text };
    for line in lines(values, style, rect.width()) {
        style.write(at, Align2::LEFT_TOP, &line, colour);
        at.y += style.row;
    }
}
