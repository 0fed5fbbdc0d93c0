//! What charts have in common.

use crate::gui::ui::glossary;
use crate::gui::ui::paint::{PlotStyle, widened};
use crate::ticks::{Steps, decades};
use eframe::egui::{self, Align2, Color32, CursorIcon, Id, Rect, RichText, Sense, TextStyle, UiBuilder, pos2, vec2};
use egui_plot::{
    AxisHints, FilledArea, GridInput, GridMark, HLine, Line, LineStyle, Plot, PlotMemory, PlotPoints, PlotResponse,
    PlotTransform, PlotUi, Points, VLine,
};

/// Width of the column of numbers left of a chart, in heights of the text: charts below each other are aligned.
const NUMBERS: f32 = 3.6;
/// A number at the left at most every so many heights of the text.
const NUMBER_EVERY: f32 = 2.6;
/// A number below at most every so many.
const COLUMN_EVERY: f32 = 4.5;
/// A line without gaps. As one long path it would be drawn thinner where it is steep; this is a chain of segments.
pub(super) const SOLID: LineStyle = LineStyle::Dashed { length: 1e6 };
/// Width of a line of a tab.
pub(super) const WIDTH: f32 = 2.0;
/// Length of a sample of a line in a legend, in heights of the text.
const SAMPLE: f32 = 1.5;

/// A plot: dragged to see what is beside, zoomed with Ctrl and the wheel or by a box drawn with the right button, and back with a
/// double click. The wheel alone scrolls the tab that it is in.
pub(super) fn bare<'a>(name: &str, height: f32) -> Plot<'a> {
    Plot::new(name.to_owned())
        .id(id(name))
        .height(height)
        .allow_scroll(false)
        .allow_axis_zoom_drag(false)
        .show_crosshair(false)
}

fn id(name: &str) -> Id {
    Id::unique(("chart", name))
}

/// Shows the chart `name` from `x[0]` to `x[1]` and from `y[0]` to `y[1]`, or where it was dragged or zoomed to.
fn framed<'a, R>(
    ui: &mut egui::Ui,
    (name, plot): (&str, Plot<'a>),
    [x, y]: [[f64; 2]; 2],
    add: impl FnOnce(&mut PlotUi<'a>) -> R + 'a,
) -> PlotResponse<R> {
    // A new chart starts with automatic ranges, as after a double click.
    let fresh = PlotMemory::load(ui.ctx(), id(name)).is_none();
    let ([left, right], [bottom, top]) = (widened(x), widened(y));
    plot.default_x_bounds(left, right).default_y_bounds(bottom, top).show(ui, move |plot| {
        if fresh {
            plot.set_auto_bounds(true);
        }
        add(plot)
    })
}

/// A line that does not answer to the pointer.
pub(super) fn line<'a>(points: &[[f64; 2]], colour: Color32, width: f32, style: LineStyle) -> Line<'a> {
    Line::new("", PlotPoints::from(points.to_vec())).color(colour).width(width).style(style).allow_hover(false)
}

/// A chart of a tab, over its whole width, whose axes are explained on hover. Values are read below it.
pub(super) struct Chart<'n> {
    /// What tells it from other charts, and screen readers what it is.
    pub(super) name: &'n str,
    /// Its height, with the axis below.
    pub(super) height: f32,
    /// Ranges of the axes until they are zoomed.
    pub(super) bounds: [[f64; 2]; 2],
    /// Name of the axis below; empty if there is none.
    pub(super) below: &'n str,
    /// What the glossary explains the axis below under, if it does, and the one at the left.
    pub(super) words: (Option<&'n str>, &'n str),
}

impl Chart<'_> {
    /// Shows what `add` draws.
    pub(super) fn show<'a, R>(self, ui: &mut egui::Ui, add: impl FnOnce(&mut PlotUi<'a>) -> R + 'a) -> PlotResponse<R> {
        self.show_with(ui, |plot| plot, add)
    }

    /// As [`Self::show`], with changes to the plot, such as marks of its own.
    pub(super) fn show_with<'a, R>(
        self,
        ui: &mut egui::Ui,
        change: impl FnOnce(Plot<'a>) -> Plot<'a>,
        add: impl FnOnce(&mut PlotUi<'a>) -> R + 'a,
    ) -> PlotResponse<R> {
        let Self { name, height, bounds, below, words: (x, y) } = self;
        let (whole, mut plot) = (place(ui, height), chart(ui, name, height));
        if bounds[0][0] == 0.0 && bounds[1][0] == 0.0 {
            // One zero is enough for both axes.
            plot = plot.y_axis_formatter(|mark, range| {
                let above = (mark.value - range.start()) / (range.end() - range.start());
                if mark.value == 0.0 && above < 0.02 { String::new() } else { tick(mark) }
            });
        }
        let plot = if below.is_empty() { plot } else { plot.x_axis_label(below) };
        let shown = framed(ui, (name, change(plot)), bounds, add);
        shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
        axes(ui, whole, *shown.transform.frame(), x, y);
        shown
    }
}

/// A plot with marks at round numbers, as far apart as they have to be.
fn chart<'a>(ui: &egui::Ui, name: &str, height: f32) -> Plot<'a> {
    let em = ui.text_style_height(&TextStyle::Body);
    let lines = f64::from((height / (NUMBER_EVERY * em)).max(1.0));
    let columns = f64::from((ui.available_width() / (COLUMN_EVERY * em)).max(1.0));
    numbered(name, height, [AxisHints::new_x(), AxisHints::new_y()])
        .grid_color(ui.visuals().widgets.noninteractive.bg_stroke.color)
        .y_axis_min_width(NUMBERS * em)
        .x_grid_spacer(move |input| round_ticks(&input, columns))
        .y_grid_spacer(move |input| round_ticks(&input, lines))
        .x_axis_formatter(|mark, _| tick(mark))
        .y_axis_formatter(|mark, _| tick(mark))
}

/// A plot with numbers at its axes, and no words at the pointer.
pub(super) fn numbered<'a>(name: &str, height: f32, axes: [AxisHints<'a>; 2]) -> Plot<'a> {
    // The spacers leave room for every number: none is to fade because others are near.
    let [x, y] = axes.map(|axis| vec![axis.label_spacing(egui::Rangef::new(0.0, 1.0))]);
    bare(name, height)
        .custom_x_axes(x)
        .custom_y_axes(y)
        .show_x(false)
        .show_y(false)
        .label_formatter(|_| None)
        .set_margin_fraction(egui::Vec2::ZERO)
}

/// A chart that stands among drawings of the painter, with the size of its text.
pub(super) struct Inset<'a> {
    /// What tells it from other charts, and screen readers what it is.
    pub(super) name: &'a str,
    /// Where its curves are. Its numbers are left of it, and below.
    pub(super) rect: Rect,
    /// Ranges of the axes until they are zoomed.
    pub(super) bounds: [[f64; 2]; 2],
    /// Name of the axis below; `None` if its numbers are below another drawing, empty if it is
    /// written elsewhere.
    pub(super) below: Option<&'a str>,
}

impl<'a> Inset<'a> {
    /// Shows what `add` draws.
    pub(super) fn show(
        &self,
        ui: &mut egui::Ui,
        style: &PlotStyle,
        add: impl FnOnce(&mut PlotUi<'a>) + 'a,
    ) -> PlotResponse<()> {
        self.show_with(ui, style, |plot| plot, add)
    }

    /// As [`Self::show`], with changes to the plot, such as marks of its own.
    pub(super) fn show_with(
        &self,
        ui: &mut egui::Ui,
        style: &PlotStyle,
        change: impl FnOnce(Plot<'a>) -> Plot<'a>,
        add: impl FnOnce(&mut PlotUi<'a>) + 'a,
    ) -> PlotResponse<()> {
        let Self { name, rect, below, .. } = *self;
        let (gutter, axis) = (style.gutter, style.axis);
        let low = pos2(rect.right(), rect.bottom() + if below.is_some() { axis } else { 0.0 });
        let whole = Rect::from_min_max(pos2(rect.left() - gutter, rect.top()), low);
        let (row, height) = (style.row, rect.height());
        // As many marks as the painter has, in drawings above and below.
        let columns = (rect.width() / (3.6 * row)).clamp(1.0, 12.0) as usize;
        let lines = (height / (2.2 * row)).clamp(1.0, 6.0) as usize;
        let hints = |hints: AxisHints<'a>, thick: f32| {
            hints.min_thickness(thick).tick_label_font(style.font.clone()).tick_label_color(style.palette.quiet)
        };
        // What is written below has the corner.
        let hidden = if below.is_some() { 0.35 * row / height } else { 0.0 };
        let value = move |mark: GridMark, range: &std::ops::RangeInclusive<f64>| {
            let above = (mark.value - range.start()) / (range.end() - range.start());
            if above < f64::from(hidden) { String::new() } else { tick(mark) }
        };
        // The name has the left end, and a neighbour begins soon after the right one.
        let named = below.filter(|name| !name.is_empty());
        let spare = named.map_or(0.0, |name| gutter - 4.0 - style.width(ui.painter(), name)).clamp(0.0, 0.6 * row);
        let place = move |mark: GridMark, range: &std::ops::RangeInclusive<f64>| {
            let text = tick(mark);
            let half = 0.28 * row * text.chars().count() as f32;
            let along = ((mark.value - range.start()) / (range.end() - range.start())) as f32 * rect.width();
            let fits = along - half > -2.0 - spare && along + half < rect.width() + 0.5 * row;
            if fits || named.is_none() { text } else { String::new() }
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
        let shown = framed(child, (name, change(chart)), self.bounds, add);
        shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
        if let Some(name) = named {
            let corner = pos2(shown.transform.frame().left() - 4.0 - spare, rect.bottom() + 1.0);
            let place = style.write(ui.painter(), corner, Align2::RIGHT_TOP, name, style.palette.quiet);
            style.term(place, name.split(',').next().unwrap_or(name));
        }
        shown
    }
}

/// A vertical line of the chart `name` that is dragged along x: where it was dragged to. A double click is the chart's.
pub(super) fn dragged(ui: &egui::Ui, at: &PlotTransform, x: f64, name: &str) -> Option<f64> {
    let place = pos2(at.position_from_point_x(x), at.frame().center().y);
    let strip = Rect::from_center_size(place, vec2(8.0, at.frame().height())).intersect(*at.frame());
    if !strip.is_positive() {
        return None;
    }
    let response = ui.interact(strip, id(name).with("line"), Sense::click_and_drag());
    let text = format!("Line of {}: drag it", name.split(':').next().unwrap_or(name));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &text));
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

/// A line across a chart along x, that does not answer to the pointer.
pub(super) fn level(y: f64, colour: Color32, width: f32) -> HLine {
    HLine::new("", y).color(colour).width(width).allow_hover(false)
}

/// A line across a chart along y, that does not answer to the pointer.
pub(super) fn upright(x: f64, colour: Color32, width: f32) -> VLine {
    VLine::new("", x).color(colour).width(width).allow_hover(false)
}

/// Dots that do not answer to the pointer.
pub(super) fn dots<'a>(points: Vec<[f64; 2]>, colour: Color32, radius: f32) -> Points<'a> {
    Points::new("", points).color(colour).radius(radius).allow_hover(false)
}

/// The area between two curves, given as (x, one y, other y).
pub(super) fn between(columns: &[[f64; 3]], colour: Color32) -> FilledArea {
    let [x, one, other] = [0, 1, 2].map(|k| columns.iter().map(|column| column[k]).collect::<Vec<_>>());
    FilledArea::new("", &x, &one, &other).fill_color(colour).allow_hover(false)
}

/// The place of the next chart of this height, with its axes.
pub(super) fn place(ui: &egui::Ui, height: f32) -> Rect {
    Rect::from_min_size(ui.cursor().min, egui::vec2(ui.available_width(), height))
}

/// Explains the axes of a chart at `place` on hover, whose curves are within `frame`: that along x, and that along y.
pub(super) fn axes(ui: &egui::Ui, place: Rect, frame: Rect, x: Option<&str>, y: &str) {
    let below = Rect::from_x_y_ranges(frame.x_range(), frame.bottom()..=place.bottom());
    let left = Rect::from_x_y_ranges(place.left()..=frame.left(), frame.y_range());
    for (number, (rect, word)) in [(below, x), (left, Some(y))].into_iter().enumerate() {
        if let Some(word) = word {
            // Charts of one tab are told apart by where they are.
            let number = number + 2 * place.top().max(0.0) as usize + 100_000 * place.left().max(0.0) as usize;
            let response = glossary::over(ui, rect, word, number);
            glossary::here(ui, response, word);
        }
    }
}

/// A title above a chart, with its unit, which the glossary explains under `word`.
pub(super) fn title(ui: &mut egui::Ui, text: &str, word: &str) {
    let label = ui.add(egui::Label::new(RichText::new(text).strong()).wrap());
    glossary::here(ui, label, word);
}

/// Entries of a legend, which the glossary knows: name, colour, how the line is drawn.
pub(super) fn legend(ui: &mut egui::Ui, entries: &[(&str, Color32, LineStyle)]) {
    ui.horizontal_wrapped(|ui| {
        for (text, colour, style) in entries {
            key(ui, text, SAMPLE + 0.35, 0.5, |painter, left, em| {
                let ends = [left, left + egui::vec2(SAMPLE * em, 0.0)];
                let stroke = egui::Stroke::new(2.0, *colour);
                // A solid one is one dash.
                let length = if let LineStyle::Dashed { length } = style { *length } else { 1e6 };
                painter.extend(egui::Shape::dashed_line(&ends, stroke, length, 0.6 * length));
            });
        }
    });
}

/// An entry of a legend, in one piece, so that it is a whole that goes to the next line. What `draw` draws from a place on, at half the
/// height of the text, has `indent` before the text, which has `after` behind it, in heights of the text.
pub(super) fn key(
    ui: &mut egui::Ui,
    text: &str,
    indent: f32,
    after: f32,
    draw: impl FnOnce(&egui::Painter, egui::Pos2, f32),
) {
    let (font, colour) = (TextStyle::Body.resolve(ui.style()), ui.visuals().text_color());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, colour);
    let em = galley.size().y;
    let size = egui::vec2(indent * em + galley.size().x + after * em, em);
    let (area, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, text));
    glossary::here(ui, response, text);
    draw(ui.painter(), area.left_center(), em);
    ui.painter().galley(area.left_top() + egui::vec2(indent * em, 0.0), galley, colour);
}

/// Marks of an axis of log₁₀: powers of ten, at most about `most`, and 2 and 5 times them if they are few and that is `between`.
pub(super) fn powers(input: &GridInput, most: f64, between: bool) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    decades([from, to], most, between).into_iter().map(|value| GridMark { value, step_size: 1.0 }).collect()
}

/// As many decimals as the steps between ticks need, with a true minus sign.
pub(super) fn tick(mark: GridMark) -> String {
    Steps::of([mark.value; 2], mark.step_size).format(mark.value)
}

/// Marks at 1, 2 or 5 times a power of ten, at most about `most`.
fn round_ticks(input: &GridInput, most: f64) -> Vec<GridMark> {
    apart(input, (input.bounds.1 - input.bounds.0) / most.max(1.0))
}

/// Marks at 1, 2 or 5 times a power of ten that is at least `least`.
pub(super) fn apart(input: &GridInput, least: f64) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    if !(least.is_finite() && least > 0.0) {
        return Vec::new();
    }
    marks(Steps::apart([from, to], least))
}

/// Marks at whole numbers, at most about `most`.
pub(super) fn whole(input: &GridInput, most: f64) -> Vec<GridMark> {
    apart(input, ((input.bounds.1 - input.bounds.0) / most).max(1.0))
}

/// Round marks, about `about`, and two at least beyond the share `hidden` of the axis at its beginning if it has room for `most`.
fn several(input: &GridInput, hidden: f32, about: usize, most: f32) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    marks(Steps::several([from, to], from + f64::from(hidden) * (to - from), about, most.into()))
}

/// Marks at these numbers.
pub(super) fn marks(ticks: Steps) -> Vec<GridMark> {
    ticks.values().map(|value| GridMark { value, step_size: ticks.step() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(marks: &[GridMark]) -> Vec<f64> {
        marks.iter().map(|mark| mark.value).collect()
    }

    #[test]
    fn ticks_are_round_inside_and_few() {
        let input = |bounds| GridInput { bounds, base_step_size: 1.0 };
        assert_eq!(values(&round_ticks(&input((0.0, 104.0)), 4.0)), [0.0, 50.0, 100.0]);
        assert_eq!(values(&round_ticks(&input((-30.0, 150.0)), 5.0)), [0.0, 50.0, 100.0, 150.0]);
        let texts: Vec<String> = round_ticks(&input((-0.5, 1.6)), 5.0).into_iter().map(tick).collect();
        assert_eq!(texts, ["−0.5", "0.0", "0.5", "1.0", "1.5"]);
        for bounds in [(0.0, 0.0), (f64::NEG_INFINITY, f64::INFINITY)] {
            assert!(round_ticks(&input(bounds), 4.0).is_empty());
        }
    }
}
