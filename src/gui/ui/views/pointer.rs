//! Regions that are pointed at and clicked, and the row of values below a view.

use crate::gui::ui::paint::PlotStyle;
use eframe::egui::{self, Align2, Painter, Rect, Response, Sense, Ui, WidgetInfo, pos2};

/// A named region that is clicked.
pub(super) fn named(ui: &Ui, rect: Rect, name: &str) -> Response {
    let response = ui.interact(rect, ui.scope_id().with(name), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Image, true, name));
    response
}

/// Values under the cursor.
pub(super) struct Readout {
    pub(super) values: Vec<String>,
}

impl Readout {
    fn lines(&self, painter: &Painter, style: &PlotStyle, width: f32) -> Vec<String> {
        let mut lines = vec![String::new()];
        for value in &self.values {
            let Some(line) = lines.last_mut() else { break };
            let longer = if line.is_empty() { value.clone() } else { format!("{line}   {value}") };
            if line.is_empty() || style.width(painter, &longer) <= width {
                *line = longer;
            } else {
                lines.push(value.clone());
            }
        }
        lines
    }

    pub(super) fn height(&self, painter: &Painter, style: &PlotStyle, width: f32) -> f32 {
        self.lines(painter, style, width).len() as f32 * style.row + 4.0
    }

    pub(super) fn draw(&self, painter: &Painter, style: &PlotStyle, rect: Rect) {
        let mut at = pos2(rect.left(), rect.top() + 4.0);
        let hint = self.values.len() == 1;
        for line in self.lines(painter, style, rect.width()) {
            let colour = if hint { style.palette.quiet } else { style.text };
            style.write(painter, at, Align2::LEFT_TOP, &line, colour);
            at.y += style.row;
        }
    }
}
