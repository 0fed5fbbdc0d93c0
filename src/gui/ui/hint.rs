//! Explanations on hover, which screen readers get too. For a panel they are shown beside it, so that they do not cover the rows around the
//! widget. Also the width of a text.

use eframe::egui::{Color32, Rect, RectAlign, Response, Role, TextStyle, Tooltip, Ui, WidgetInfo};

/// Distance between the panel and the explanation.
const GAP: f32 = 12.0;

/// Gives screen readers the explanation that is shown on hover.
pub fn describe(response: &Response, text: impl FnOnce() -> String) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_description(text()));
}

/// A widget with an explanation on hover.
pub trait Hint {
    /// Shows `text` at the widget.
    fn hint(self, text: impl Into<String>) -> Self;
    /// Shows `text` beside the panel `ui`.
    fn hint_beside(self, ui: &Ui, text: &str) -> Self;
    /// Sets the name and the role for screen readers.
    fn called(self, role: Role, name: &str) -> Self;
}

impl Hint for Response {
    fn hint(self, text: impl Into<String>) -> Self {
        let text = text.into();
        describe(&self, || text.clone());
        self.on_hover_text(text)
    }

    fn hint_beside(self, ui: &Ui, text: &str) -> Self {
        beside(ui.clip_rect(), self, text)
    }

    fn called(self, role: Role, name: &str) -> Self {
        self.widget_info(|| WidgetInfo::labeled(role, true, name));
        self
    }
}

/// Shows `text` beside `panel` while the pointer rests on `response`, a widget in the panel.
pub fn beside(panel: Rect, response: Response, text: &str) -> Response {
    describe(&response, || text.to_owned());
    beside_with(panel, response, |ui| drop(ui.label(text)))
}

/// As [`beside`], with whatever `add` shows.
pub fn beside_with(panel: Rect, response: Response, add: impl FnOnce(&mut Ui)) -> Response {
    // egui keeps an explanation open when a dialog opens over it.
    // While a value is dragged, the views show the effect, and an explanation would cover them.
    if response.dragged() || !response.ctx.memory(|memory| memory.allows_interaction(response.layer_id)) {
        return response;
    }
    let mut tooltip = Tooltip::for_enabled(&response);
    let row = Rect::from_x_y_ranges(panel.x_range(), response.rect.y_range());
    tooltip.popup = tooltip
        .popup
        .anchor(row)
        .align(RectAlign::RIGHT_START)
        .align_alternatives(&[
            RectAlign::RIGHT_END,
            RectAlign::LEFT_START,
            RectAlign::LEFT_END,
            RectAlign::BOTTOM_START,
        ])
        .gap(GAP);
    tooltip.show(add);
    response
}

/// Width of a line of usual text \[points\].
pub fn text_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER).size().x
}
