//! What charts have in common.

use crate::gui::derived::ticks::{Ticks, decades};
use crate::gui::ui::glossary;
use eframe::egui::{self, Color32, Id, Rect, RichText, TextStyle};
use egui_plot::{AxisHints, GridInput, GridMark, Line, LineStyle, Plot, PlotMemory, PlotPoints, PlotResponse, PlotUi};

/// Width of the column of numbers left of a chart, in heights of the text: charts below each other are aligned.
const NUMBERS: f32 = 3.6;
/// A number at the left at most every so many heights of the text.
const NUMBER_EVERY: f32 = 2.6;
/// A number below at most every so many.
const COLUMN_EVERY: f32 = 4.5;
/// A line without gaps. As one long path it would be drawn thinner where it is steep; this is a chain of segments.
pub(in crate::gui::ui) const SOLID: LineStyle = LineStyle::Dashed { length: 1e6 };
/// Length of a sample of a line in a legend, in heights of the text.
const SAMPLE: f32 = 1.5;

/// A plot: dragged to see what is beside, zoomed with Ctrl and the wheel or by a box drawn with the right button, and back with a
/// double click. The wheel alone scrolls the tab that it is in.
pub(in crate::gui::ui) fn bare<'a>(name: &str, height: f32) -> Plot<'a> {
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
pub(in crate::gui::ui) fn framed<'a, R>(
    ui: &mut egui::Ui,
    (name, plot): (&str, Plot<'a>),
    [x, y]: [[f64; 2]; 2],
    add: impl FnOnce(&mut PlotUi<'a>) -> R + 'a,
) -> PlotResponse<R> {
    // What is new is as after a double click: the ranges are followed until something is zoomed.
    let fresh = PlotMemory::load(ui.ctx(), id(name)).is_none();
    let wide = |[low, high]: [f64; 2]| if high > low { [low, high] } else { [low - 0.5, low + 0.5] };
    let ([left, right], [bottom, top]) = (wide(x), wide(y));
    plot.default_x_bounds(left, right).default_y_bounds(bottom, top).show(ui, move |plot| {
        if fresh {
            plot.set_auto_bounds(true);
        }
        add(plot)
    })
}

/// A line that does not answer to the pointer.
pub(in crate::gui::ui) fn line<'a>(points: &[[f64; 2]], colour: Color32, width: f32, style: LineStyle) -> Line<'a> {
    Line::new("", PlotPoints::from(points.to_vec())).color(colour).width(width).style(style).allow_hover(false)
}

/// A chart with its axes: values are read below it.
pub(in crate::gui::ui) fn chart<'a>(ui: &egui::Ui, name: &str, height: f32) -> Plot<'a> {
    let em = ui.text_style_height(&TextStyle::Body);
    let lines = f64::from((height / (NUMBER_EVERY * em)).max(1.0));
    let columns = f64::from((ui.available_width() / (COLUMN_EVERY * em)).max(1.0));
    // The spacers leave room for every number: none is to fade because others are near.
    let near = egui::Rangef::new(0.0, 1.0);
    bare(name, height)
        .custom_x_axes(vec![AxisHints::new_x().label_spacing(near)])
        .custom_y_axes(vec![AxisHints::new_y().label_spacing(near)])
        .show_x(false)
        .show_y(false)
        .grid_color(ui.visuals().widgets.noninteractive.bg_stroke.color)
        .y_axis_min_width(NUMBERS * em)
        .x_grid_spacer(move |input| round_ticks(&input, columns))
        .y_grid_spacer(move |input| round_ticks(&input, lines))
        .x_axis_formatter(|mark, _| tick(mark))
        .y_axis_formatter(|mark, _| tick(mark))
        .label_formatter(|_| None)
        .set_margin_fraction(egui::Vec2::ZERO)
}

/// The place of the next chart of this height, with its axes.
pub(in crate::gui::ui) fn place(ui: &egui::Ui, height: f32) -> Rect {
    Rect::from_min_size(ui.cursor().min, egui::vec2(ui.available_width(), height))
}

/// Explains the axes of a chart at `place` on hover, whose curves are within `frame`: that along x, and that along y.
pub(in crate::gui::ui) fn axes(ui: &egui::Ui, place: Rect, frame: Rect, x: Option<&str>, y: &str) {
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
pub(in crate::gui::ui) fn title(ui: &mut egui::Ui, text: &str, word: &str) {
    let label = ui.add(egui::Label::new(RichText::new(text).strong()).wrap());
    glossary::here(ui, label, word);
}

/// Entries of a legend, which the glossary knows: name, colour, how the line is drawn.
pub(in crate::gui::ui) fn legend(ui: &mut egui::Ui, entries: &[(&str, Color32, LineStyle)]) {
    ui.horizontal_wrapped(|ui| {
        for (text, colour, style) in entries {
            let font = TextStyle::Body.resolve(ui.style());
            let galley = ui.painter().layout_no_wrap((*text).to_owned(), font, ui.visuals().text_color());
            let em = galley.size().y;
            let indent = (SAMPLE + 0.35) * em;
            let (area, response) =
                ui.allocate_exact_size(egui::vec2(indent + galley.size().x + 0.5 * em, em), egui::Sense::hover());
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, *text));
            glossary::here(ui, response, text);
            let ends = [area.left_center(), area.left_center() + egui::vec2(SAMPLE * em, 0.0)];
            let stroke = egui::Stroke::new(2.0, *colour);
            match style {
                LineStyle::Solid => drop(ui.painter().line_segment(ends, stroke)),
                LineStyle::Dashed { length } => {
                    // A solid one is one dash.
                    ui.painter().extend(egui::Shape::dashed_line(&ends, stroke, *length, 0.6 * length));
                }
                LineStyle::Dotted { spacing } => {
                    ui.painter().extend(egui::Shape::dotted_line(&ends, *colour, *spacing, 1.2));
                }
            }
            let colour = ui.visuals().text_color();
            ui.painter().galley(area.left_top() + egui::vec2(indent, 0.0), galley, colour);
        }
    });
}

/// Ticks of an axis of log₁₀: powers of ten, at most about `most`, and 2 and 5 times them if they are few and that is `between`.
pub(in crate::gui::ui) fn powers(input: &GridInput, most: f64, between: bool) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    decades([from, to], most, between).into_iter().map(|value| GridMark { value, step_size: 1.0 }).collect()
}

/// As many decimals as the steps between ticks need, with a true minus sign.
fn tick(mark: GridMark) -> String {
    let decimals = (-mark.step_size.log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize;
    format!("{:.decimals$}", mark.value + 0.0).replace('-', "−")
}

/// Ticks at 1, 2 or 5 times a power of ten, at most about `most`.
fn round_ticks(input: &GridInput, most: f64) -> Vec<GridMark> {
    apart(input, (input.bounds.1 - input.bounds.0) / most.max(1.0))
}

/// Ticks at 1, 2 or 5 times a power of ten that is at least `least`.
pub(in crate::gui::ui) fn apart(input: &GridInput, least: f64) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    if !(least.is_finite() && least > 0.0) {
        return Vec::new();
    }
    let ticks = Ticks::apart([from, to], least);
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
