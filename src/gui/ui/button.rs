//! The button to press next.

use super::context::DrawContext;
use eframe::egui::{Button, Response, RichText, Stroke, Ui};

/// A button, lit if it is what comes next.
pub(super) fn next(ui: &mut Ui, text: &str, lit: bool, cx: &DrawContext<'_>) -> Response {
    let mut button = Button::new(RichText::new(text).strong());
    if lit {
        button = button.fill(ui.visuals().selection.bg_fill).stroke(Stroke::new(1.0, cx.colours.film));
    }
    ui.add(button)
}

/// The start button of a tab, highlighted while the tab is empty.
pub(super) fn first(ui: &mut Ui, text: &str, (empty, good): (bool, bool), cx: &DrawContext<'_>) -> Response {
    match empty && good {
        true => next(ui, text, true, cx),
        false => ui.add_enabled(good, Button::new(text)),
    }
}
