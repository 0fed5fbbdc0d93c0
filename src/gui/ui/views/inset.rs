//! A chart among the painted drawings of a view.

use crate::gui::ui::hint::Hint;
use crate::gui::ui::paint::PlotStyle;
use crate::gui::ui::plot::{framed, id, marks, numbered, tick};
use crate::ticks::Steps;
use eframe::egui::{self, Align2, CursorIcon, Rect, Sense, UiBuilder, pos2, vec2};
use egui_plot::{AxisHints, GridInput, GridMark, PlotMemory, PlotResponse, PlotTransform, PlotUi};

/// A chart that stands among drawings of the painter, with the size of its text.
pub(super) struct Inset<'a> {
    /// Unique name, also read by screen readers.
    pub(super) name: &'a str,
    /// Area of the curves. The numbers are left of it, and below.
    pub(super) rect: Rect,
    /// Ranges of the axes until they are zoomed.
    pub(super) bounds: [[f64; 2]; 2],
    /// Name of the axis below; `None` if its numbers are below another drawing.
    pub(super) below: Option<&'a str>,
}

impl<'a> Inset<'a> {
    pub(super) fn show(
        &self,
        ui: &mut egui::Ui,
        style: &PlotStyle,
        add: impl FnOnce(&mut PlotUi<'a>) + 'a,
    ) -> PlotResponse<Option<f64>> {
        let Self { name, rect, below, .. } = *self;
        let (gutter, axis) = (style.gutter, style.axis);
        let low = pos2(rect.right(), rect.bottom() + if below.is_some() { axis } else { 0.0 });
        let whole = Rect::from_min_max(pos2(rect.left() - gutter, rect.top()), low);
        let (row, height) = (style.row, rect.height());
        // As many marks as the painted drawings above and below have.
        let columns = (rect.width() / (3.6 * row)).clamp(1.0, 12.0) as usize;
        let lines = (height / (2.2 * row)).clamp(1.0, 6.0) as usize;
        let hints = |hints: AxisHints<'a>, thick: f32| {
            hints.min_thickness(thick).tick_label_font(style.font.clone()).tick_label_color(style.palette.quiet)
        };
        // The corner is reserved for the numbers below.
        let hidden = if below.is_some() { 0.35 * row / height } else { 0.0 };
        let value = move |mark: GridMark, range: &std::ops::RangeInclusive<f64>| {
            let above = (mark.value - range.start()) / (range.end() - range.start());
            if above < f64::from(hidden) { String::new() } else { tick(mark) }
        };
        // The name is at the left end, and a neighbour begins soon after the right end.
        let spare = below.map_or(0.0, |name| gutter - 4.0 - style.width(name)).clamp(0.0, 0.6 * row);
        let place = move |mark: GridMark, range: &std::ops::RangeInclusive<f64>| {
            let text = tick(mark);
            let half = 0.28 * row * text.chars().count() as f32;
            let along = ((mark.value - range.start()) / (range.end() - range.start())) as f32 * rect.width();
            let fits = along - half > -2.0 - spare && along + half < rect.width() + 0.5 * row;
            if fits || below.is_none() { text } else { String::new() }
        };
        let (x, y) = (AxisHints::new_x().formatter(place), AxisHints::new_y().formatter(value));
        let chart = numbered(name, whole.height(), [hints(x, axis), hints(y, gutter)])
            .show_axes([below.is_some(), true])
            .grid_color(style.grid)
            .grid_fade(0.0)
            .x_grid_spacer(move |input| several(&input, 0.0, columns, rect.width() / (1.5 * row)))
            .y_grid_spacer(move |input| several(&input, hidden, lines, height / row));
        let child = &mut ui.new_child(UiBuilder::new().id_salt(name).max_rect(whole));
        child.visuals_mut().extreme_bg_color = style.palette.canvas;
        let shown = framed(child, (name, chart), self.bounds, add);
        if let Some(name) = below {
            let corner = pos2(shown.transform.frame().left() - 4.0 - spare, rect.bottom() + 1.0);
            let place = style.write(corner, Align2::RIGHT_TOP, name, style.palette.quiet);
            style.term(place, name.split(',').next().unwrap_or(name));
        }
        shown
    }
}

/// The x of the chart `name` that was clicked, or that its vertical line was dragged to.
pub(super) fn chosen(ui: &egui::Ui, shown: &PlotResponse<Option<f64>>, line: Option<f64>, name: &str) -> Option<f64> {
    let clicked = shown.response.interact_pointer_pos().filter(|_| shown.response.clicked());
    let clicked = clicked.map(|at| shown.transform.value_from_position(at).x);
    line.and_then(|x| dragged(ui, &shown.transform, x, name)).or(clicked)
}

/// A vertical line of the chart `name` that can be dragged along x. Returns where it was dragged to. A double click goes to the chart.
fn dragged(ui: &egui::Ui, at: &PlotTransform, x: f64, name: &str) -> Option<f64> {
    let place = pos2(at.position_from_point_x(x), at.frame().center().y);
    let strip = Rect::from_center_size(place, vec2(8.0, at.frame().height())).intersect(*at.frame());
    if !strip.is_positive() {
        return None;
    }
    let text = format!("Line of {}: drag it", name.split(':').next().unwrap_or(name));
    let response = ui.interact(strip, id(name).with("line"), Sense::click_and_drag()).called(egui::Role::Image, &text);
    let response = response.on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
    if response.double_clicked()
        && let Some(mut memory) = PlotMemory::load(ui.ctx(), id(name))
    {
        memory.auto_bounds = true.into();
        memory.store(ui.ctx(), id(name));
    }
    let pointer = response.interact_pointer_pos().filter(|_| response.dragged())?;
    Some(at.value_from_position(pointer).x)
}

/// Round marks, about `about` of them. If there is space for `most`, at least two lie beyond the share `hidden` at the beginning of the
/// axis.
fn several(input: &GridInput, hidden: f32, about: usize, most: f32) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    marks(Steps::several([from, to], from + f64::from(hidden) * (to - from), about, most.into()))
}
