//! Explanations on hover that do not cover the rows around them: beside the panel.

use eframe::egui::{Rect, RectAlign, Response, Tooltip, Ui};

/// Between the panel and the explanation.
const GAP: f32 = 12.0;

/// Shows `text` beside `panel` while the pointer rests on `response`, a widget in it.
pub fn beside(panel: Rect, response: Response, text: &str) -> Response {
    beside_with(panel, response, |ui| drop(ui.label(text)))
}

/// As [`beside`], with whatever `add` shows.
pub fn beside_with(panel: Rect, response: Response, add: impl FnOnce(&mut Ui)) -> Response {
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
