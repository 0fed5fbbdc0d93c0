//! Building blocks of tabs and panels: the button to press next, tables, and columns that are scrolled.

use super::context::DrawContext;
use super::glossary;
use crate::digits::{as_given, signed};
use crate::scene::quantity_text;
use crate::scene::show_text;
use eframe::egui::style::ScrollAnimation;
use eframe::egui::{
    AsIdSalt, Button, DragValue, Event, Grid, Id, Key, Rangef, Response, RichText, ScrollArea, Stroke, Tooltip, Ui,
};
use std::cell::Cell;
use std::ops::RangeInclusive;

/// Space at the right of a tab with charts, so that half of the last number of an axis is clear of the scroll bar.
pub(super) const BESIDE_CHARTS: f32 = 14.0;

/// A button, highlighted if it is the next step.
pub(super) fn next_button(ui: &mut Ui, text: &str, lit: bool, cx: &DrawContext<'_>) -> Response {
    let mut button = Button::new(RichText::new(text).strong());
    if lit {
        // It has the same outline as any other button with the keyboard focus.
        let id = ui.next_auto_id();
        let focused = ui.memory(|memory| memory.has_focus(id));
        let line = if focused { ui.visuals().widgets.active.bg_stroke } else { Stroke::new(1.0, cx.colours.film) };
        button = button.fill(ui.visuals().selection.bg_fill).stroke(line);
    }
    ui.add(button)
}

/// The start button of a tab, highlighted while the tab is empty.
pub(super) fn first_button(ui: &mut Ui, text: &str, (empty, good): (bool, bool), cx: &DrawContext<'_>) -> Response {
    match empty && good {
        true => next_button(ui, text, true, cx),
        false => ui.add_enabled(good, Button::new(text)),
    }
}

/// A text that was entered, and why it is refused; `None` if it is a number in the range.
pub(super) type Entered = (String, Option<String>);

/// A number that can be dragged, or typed with any unit of its kind. Also returns the text if one was entered in this frame.
pub(super) fn entered_box(
    ui: &mut Ui,
    drag: DragValue<'_>,
    (range, unit): (RangeInclusive<f64>, &str),
) -> (Response, Option<Entered>) {
    // After Escape has dropped the text, it must not be read when the frame is laid out again.
    let (key, frame) = (ui.next_auto_id().with("escaped"), ui.ctx().cumulative_frame_nr());
    let dropped = ui.data(|data| data.get_temp::<u64>(key)).is_some_and(|at| frame <= at + 1);
    let entered = Cell::new(None);
    let read = |text: &str| {
        let found = quantity_text::number(unit, text).filter(|number| range.contains(number));
        if !dropped {
            entered.set(Some((text.to_owned(), found.is_none().then(|| refusal(text, &range, unit)))));
        }
        found.filter(|_| !dropped)
    };
    let response = ui.add(drag.range(range.clone()).update_while_editing(false).custom_parser(read));
    if response.lost_focus() && ui.input(|input| input.key_pressed(Key::Escape)) {
        ui.data_mut(|data| data.insert_temp(key, frame));
    }
    (response, entered.take())
}

/// As [`entered_box`]. If text entered by Enter is refused, it stays in the box with the cursor, and the reason is shown beside it until
/// something else is done.
pub(super) fn number_box(
    ui: &mut Ui,
    drag: DragValue<'_>,
    allowed: (RangeInclusive<f64>, &str),
    cx: &DrawContext<'_>,
) -> Response {
    let (response, entered) = entered_box(ui, drag, allowed);
    let key = response.id.with("refused");
    let acts =
        |event: &Event| matches!(event, Event::Key { pressed: true, .. } | Event::PointerButton { pressed: true, .. });
    if ui.input(|input| input.events.iter().any(acts)) {
        ui.data_mut(|data| data.remove::<String>(key));
    }
    if let Some((_, Some(reason))) = entered {
        ui.data_mut(|data| data.insert_temp::<String>(key, reason));
        if ui.input(|input| input.key_pressed(Key::Enter)) {
            response.request_focus();
        }
    }
    if let Some(reason) = ui.data(|data| data.get_temp::<String>(key)) {
        Tooltip::for_widget(&response).show(|ui| cx.alarm(ui, [reason]));
    }
    response
}

/// Why a text is not accepted as a number in this range and unit.
fn refusal(text: &str, range: &RangeInclusive<f64>, unit: &str) -> String {
    let [least, most] = [range.start(), range.end()].map(|end| signed(as_given(*end).to_string()));
    let within = match range.end().is_finite() {
        true => format!(" from {least} to {most} {unit}"),
        false if unit.is_empty() => String::new(),
        false => format!(", in {unit}"),
    };
    format!("{}: expected a number{within}", show_text(text)).trim_end().to_owned()
}

/// The key under which the window notes which widget it scrolls to in this frame.
pub const FOLLOWED: &str = "scrolled to";

/// A striped table with the name `name` and this distance between its columns. If it is wider than the tab, it scrolls, so that the parts
/// below keep the width of the tab.
pub(super) fn table(ui: &mut Ui, name: &str, columns: usize, gap: f32, rows: impl FnOnce(&mut Ui)) {
    let grid = Grid::new(name).num_columns(columns).striped(true).spacing([gap, 4.0]);
    let area = ScrollArea::horizontal().id_salt((name, "table")).auto_shrink(true);
    let shown = area.show(ui, |ui| grid.show(ui, rows));
    // A scroll area handles a request to scroll also in directions in which it does not scroll; therefore the request is repeated here.
    let followed = ui.data(|data| data.get_temp::<Id>(Id::unique(FOLLOWED))).and_then(|id| ui.ctx().read_response(id));
    let rows = Rangef::new(shown.inner_rect.top(), shown.inner_rect.top() + shown.content_size.y);
    if let Some(found) = followed.filter(|found| rows.contains(found.rect.center().y)) {
        ui.scroll_to_rect_animation(found.rect, None, ScrollAnimation::none());
    }
}

/// A row of column heads, each with its glossary term; a head with an empty term is not explained.
pub(super) fn heads(ui: &mut Ui, heads: &[(&str, &str)], cx: &DrawContext<'_>) {
    for (head, word) in heads {
        let head = RichText::new(*head).color(cx.colours.quiet);
        match word.is_empty() {
            true => ui.label(head),
            false => glossary::term(ui, head, word),
        };
    }
    ui.end_row();
}

/// A number and its unit, without a line break between them.
pub(super) fn joined(text: &str) -> String {
    text.replace(' ', "\u{a0}")
}

/// Shows what `add` draws, in a scroll area of the full height. At the right, the width `bar` is left free for the floating scroll bar, and
/// for half a number at the end of an axis.
pub fn scrolled(ui: &mut Ui, id: impl AsIdSalt, bar: f32, add: impl FnOnce(&mut Ui)) {
    scroll(ui, ScrollArea::vertical().id_salt(id), bar, add);
}

/// As [`scrolled`], but scrolls to the top whenever `number` changes.
pub fn scrolled_anew(ui: &mut Ui, id: &'static str, number: u64, bar: f32, add: impl FnOnce(&mut Ui)) {
    let key = Id::unique((id, "scrolled"));
    let last = ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or(key, number), number));
    let area = ScrollArea::vertical().id_salt(id);
    scroll(ui, if last == number { area } else { area.vertical_scroll_offset(0.0) }, bar, add);
}

fn scroll(ui: &mut Ui, area: ScrollArea, bar: f32, add: impl FnOnce(&mut Ui)) {
    area.auto_shrink(false).show(ui, |ui| {
        ui.set_max_width(ui.available_width() - bar);
        add(ui);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refused_text_is_told_what_is_allowed() {
        let any = f64::NEG_INFINITY..=f64::INFINITY;
        assert_eq!(refusal("few", &any, "atmospheres"), "few: expected a number, in atmospheres");
        assert_eq!(refusal("few", &any, ""), "few: expected a number");
        assert_eq!(refusal("9", &(-1.0..=2.0), "mm"), "9: expected a number from −1 to 2 mm");
        assert_eq!(refusal("9", &(0.0..=2.0), ""), "9: expected a number from 0 to 2");
    }
}
