//! The common parts of all charts that egui_plot draws: a plot that can be dragged and zoomed, its curves, dots and areas, and the marks of
//! its axes.

use super::paint::widened;
use crate::gui::derived::scales::span;
use crate::ticks::Steps;
use eframe::egui::{self, Color32, Id, Pos2, Shape, Stroke};
use egui_plot::{
    AxisHints, FilledArea, GridMark, HLine, Line, LineStyle, Plot, PlotMemory, PlotPoints, PlotResponse, PlotUi,
    Points, VLine,
};

/// A chart cannot be zoomed out to more than this many times its ranges.
const FARTHEST: f64 = 100.0;
/// Greatest deviation of a drawn curve, as a share of its size.
const STRAIGHT: f64 = 5e-4;

pub(super) fn id(name: &str) -> Id {
    Id::unique(("chart", name))
}

/// Shows the chart with the name `name`, also for screen readers, over the ranges of x and y, or over those to which it was dragged or
/// zoomed. Also returns the x under the pointer.
pub(super) fn framed<'a>(
    ui: &mut egui::Ui,
    (name, plot): (&str, Plot<'a>),
    [x, y]: [[f64; 2]; 2],
    add: impl FnOnce(&mut PlotUi<'a>) + 'a,
) -> PlotResponse<Option<f64>> {
    // A new chart starts with automatic ranges, as after a double click.
    let fresh = PlotMemory::load(ui.ctx(), id(name)).is_none();
    let ([left, right], [bottom, top]) = (widened(x), widened(y));
    let mut shown = plot.default_x_bounds(left, right).default_y_bounds(bottom, top).show(ui, move |plot| {
        if fresh {
            plot.set_auto_bounds(true);
        }
        let bounds = plot.plot_bounds();
        if bounds.width() > FARTHEST * (right - left) || bounds.height() > FARTHEST * (top - bottom) {
            plot.set_auto_bounds(true);
        }
        add(plot);
        None
    });
    shown.inner = shown.response.hover_pos().map(|at| shown.transform.value_from_position(at).x);
    shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
    shown
}

/// A plot with numbers at its axes, and no text at the pointer. It is dragged to move, zoomed with Ctrl and the wheel or by a box drawn
/// with the right button, and reset by a double click. The wheel alone scrolls the tab.
pub(super) fn numbered<'a>(name: &str, height: f32, axes: [AxisHints<'a>; 2]) -> Plot<'a> {
    // The grid spacers leave enough space for every number, so no number has to fade because of its neighbours.
    let [x, y] = axes.map(|axis| vec![axis.label_spacing(egui::Rangef::new(0.0, 1.0))]);
    Plot::new(name.to_owned())
        .id(id(name))
        .height(height)
        .allow_scroll(false)
        .allow_axis_zoom_drag(false)
        .show_crosshair(false)
        .custom_x_axes(x)
        .custom_y_axes(y)
        .show_x(false)
        .show_y(false)
        .label_formatter(|_| None)
        .set_margin_fraction(egui::Vec2::ZERO)
}

/// A line that does not react to the pointer. A solid line is drawn as a chain of segments: as one path it would be thinner where it is
/// steep, and would have spikes at sharp turns.
pub(super) fn line<'a>(points: &[[f64; 2]], colour: Color32, width: f32, style: LineStyle) -> Line<'a> {
    let style = if style == LineStyle::Solid { LineStyle::Dashed { length: 1e6 } } else { style };
    let size = [0, 1].map(|k| span(points.iter().map(|point| point[k]))).map(|[low, high]| high - low);
    let mut kept = Vec::new();
    thin(points, size, &mut kept);
    kept.extend(points.last());
    Line::new("", PlotPoints::from(kept)).color(colour).width(width).style(style).allow_hover(false)
}

/// A line outside of a plot, with the dashes of those in one.
pub(super) fn stroked(points: &[Pos2], stroke: Stroke, style: LineStyle) -> Vec<Shape> {
    match style {
        LineStyle::Dotted { spacing } => Shape::dotted_line(points, stroke.color, spacing, 0.6 * stroke.width),
        LineStyle::Dashed { length } => Shape::dashed_line(points, stroke, length, 0.6 * length),
        LineStyle::Solid => vec![Shape::line(points.to_vec(), stroke)],
    }
}

/// Keeps the points of a curve that straight lines between the others would miss, except for the last one (Ramer 1972). `size` is the size
/// of the curve.
fn thin(points: &[[f64; 2]], size: [f64; 2], kept: &mut Vec<[f64; 2]>) {
    let [first, .., last] = points else { return };
    let from_first = |point: &[f64; 2]| [0, 1].map(|k| (point[k] - first[k]) / size[k].max(f64::MIN_POSITIVE));
    let [dx, dy] = from_first(last);
    let off = |point: &[f64; 2]| {
        let [x, y] = from_first(point);
        let part = ((x * dx + y * dy) / (dx * dx + dy * dy).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (x - part * dx).hypot(y - part * dy)
    };
    let furthest = (1..points.len() - 1).max_by(|a, b| off(&points[*a]).total_cmp(&off(&points[*b])));
    match furthest.filter(|i| off(&points[*i]) > STRAIGHT) {
        Some(i) => [&points[..=i], &points[i..]].into_iter().for_each(|part| thin(part, size, kept)),
        None => kept.push(*first),
    }
}

/// A horizontal line across a chart that does not react to the pointer.
pub(super) fn level(y: f64, colour: Color32, width: f32) -> HLine {
    HLine::new("", y).color(colour).width(width).allow_hover(false)
}

/// A vertical line across a chart that does not react to the pointer.
pub(super) fn upright(x: f64, colour: Color32, width: f32) -> VLine {
    VLine::new("", x).color(colour).width(width).allow_hover(false)
}

/// The vertical line at the x under the pointer, if there is one.
pub(super) fn under_pointer(plot: &mut PlotUi<'_>, x: Option<f64>, colour: Color32) {
    x.into_iter().for_each(|x| plot.vline(upright(x, colour, 1.0)));
}

/// Dots. If they have a name, it is shown when the pointer is near.
pub(super) fn dots<'a>(name: &str, points: Vec<[f64; 2]>, colour: Color32, radius: f32) -> Points<'a> {
    Points::new(name, points).color(colour).radius(radius).allow_hover(!name.is_empty())
}

/// The area between two curves, given as (x, one y, other y).
pub(super) fn between(columns: &[[f64; 3]], colour: Color32) -> FilledArea {
    let [x, one, other] = [0, 1, 2].map(|k| columns.iter().map(|column| column[k]).collect::<Vec<_>>());
    FilledArea::new("", &x, &one, &other).fill_color(colour).allow_hover(false)
}

/// As many decimals as the steps between ticks need, with a true minus sign.
pub(super) fn tick(mark: GridMark) -> String {
    Steps::of([mark.value; 2], mark.step_size).format(mark.value)
}

/// Marks at these numbers.
pub(super) fn marks(ticks: Steps) -> Vec<GridMark> {
    ticks.values().map(|value| GridMark { value, step_size: ticks.step() }).collect()
}
