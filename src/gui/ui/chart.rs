//! What charts have in common.

use super::glossary::{self, Explained};
use super::hint::text_width;
use super::paint::{PlotStyle, widened};
use super::theme::on_screen;
use crate::digits::{power_of_ten, short};
use crate::export::figure::{self, Axis, Colour, Dash, Direction, Layer, Mark, Panel, Scale, Shape, ends};
use crate::gui::derived::scales::span;
use crate::ticks::{Steps, decades};
use eframe::egui::{
    self, Align2, Color32, CursorIcon, Id, Rect, RichText, Sense, Stroke, TextStyle, UiBuilder, Visuals, pos2, vec2,
};
use egui_plot::{
    AxisHints, FilledArea, GridInput, GridMark, HLine, HoverPosition, Line, LineStyle, MarkerShape, Plot, PlotMemory,
    PlotPoint, PlotPoints, PlotResponse, PlotTransform, PlotUi, Points, VLine,
};

/// Width of the column of numbers left of a chart, in heights of the text: charts below each other are aligned.
const NUMBERS: f32 = 3.6;
/// A number at the left at most every so many heights of the text.
const NUMBER_EVERY: f32 = 2.6;
/// A number below at most every so many.
const COLUMN_EVERY: f32 = 4.5;
/// Width of a line of a tab.
const WIDTH: f32 = 2.0;
/// Significant digits of a value of a logarithmic axis, or of one that is pointed at.
const DIGITS: usize = 4;
/// Values of a logarithmic axis up to this many decades from 1 are written out.
const PLAIN_DECADES: f64 = 3.5;
/// A curve is drawn as exactly as this share of its size.
const STRAIGHT: f64 = 5e-4;
/// Length of a sample of a line in a legend, in heights of the text.
const SAMPLE: f32 = 1.5;

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

/// A line that does not answer to the pointer. As one path a solid one would be drawn thinner where it is steep, and with spikes where it
/// turns: it is a chain of segments.
pub(super) fn line<'a>(points: &[[f64; 2]], colour: Color32, width: f32, style: LineStyle) -> Line<'a> {
    let style = if style == LineStyle::Solid { LineStyle::Dashed { length: 1e6 } } else { style };
    let size = [0, 1].map(|k| span(points.iter().map(|point| point[k]))).map(|[low, high]| high - low);
    let mut kept = Vec::new();
    thin(points, size, &mut kept);
    kept.extend(points.last());
    Line::new("", PlotPoints::from(kept)).color(colour).width(width).style(style).allow_hover(false)
}

/// Keeps of a curve of this size the points that straight lines between others would miss, but for the last one (Ramer 1972).
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

/// A chart of a tab, over its whole width, whose axes are explained on hover: a panel as figures describe it, in the colours of the window.
/// Points that have a name tell their values; other values are read below it.
pub(super) struct Chart<'n> {
    /// What tells it from other charts, and screen readers what it is.
    pub(super) name: &'n str,
    /// Its height, with the axis below.
    pub(super) height: f32,
    /// Axes, and what is drawn, but for maps. Axes have these ranges until they are zoomed.
    pub(super) panel: &'n Panel,
    /// What the glossary explains the axis below under, if it does, and the one at the left.
    pub(super) words: (Option<&'n str>, &'n str),
}

impl<'n> Chart<'n> {
    pub(super) fn show(self, ui: &mut egui::Ui) {
        self.show_with(ui, |plot| plot);
    }

    /// As [`Self::show`], with changes to the plot; the x that is pointed at.
    pub(super) fn show_with(
        self,
        ui: &mut egui::Ui,
        change: impl FnOnce(Plot<'n>) -> Plot<'n>,
    ) -> PlotResponse<Option<f64>> {
        self.show_over(ui, change, |_| ())
    }

    /// The same over what `ground` draws.
    pub(super) fn show_over(
        self,
        ui: &mut egui::Ui,
        change: impl FnOnce(Plot<'n>) -> Plot<'n>,
        ground: impl FnOnce(&mut PlotUi<'n>) + 'n,
    ) -> PlotResponse<Option<f64>> {
        let Self { name, height, panel, words } = self;
        let (x, y) = (&panel.x, &panel.y);
        let em = ui.text_style_height(&TextStyle::Body);
        let whole = Rect::from_min_size(ui.cursor().min, vec2(ui.available_width(), height));
        let lines = f64::from((height / (NUMBER_EVERY * em)).max(1.0));
        let columns = f64::from((whole.width() / (COLUMN_EVERY * em)).max(1.0));
        let ends = ends(panel);
        let bounds = [ends[0].map(|end| x.scale.place(end)), ends[1].map(|end| y.scale.place(end))];
        // One zero is enough for both axes.
        let zeros = ends[0][0] == 0.0 && ends[1][0] == 0.0;
        let named = y.names.iter().map(|(_, name)| text_width(ui, name) + 0.8 * em).fold(NUMBERS * em, f32::max);
        let below = if x.unit.is_empty() { x.label.clone() } else { format!("{}, {}", x.label, x.unit) };
        let plot = numbered(name, height, [AxisHints::new_x(), AxisHints::new_y()])
            .grid_color(ui.visuals().widgets.noninteractive.bg_stroke.color)
            .y_axis_min_width(named)
            .x_grid_spacer(move |input| axis_marks(x, &input, columns))
            .y_grid_spacer(move |input| axis_marks(y, &input, lines))
            .x_axis_formatter(|mark, _| written(x, mark.value, mark.step_size))
            .y_axis_formatter(move |mark, range| {
                let above = (mark.value - range.start()) / (range.end() - range.start());
                if zeros && mark.value == 0.0 && above < 0.02 {
                    String::new()
                } else {
                    written(y, mark.value, mark.step_size)
                }
            })
            .label_formatter(|at| match at {
                HoverPosition::NearDataPoint { plot_name, position, .. } if !plot_name.is_empty() => {
                    Some(format!("{plot_name}\n{}: {}", written(x, position.x, 0.0), written(y, position.y, 0.0)))
                }
                _ => None,
            });
        let plot = if below.is_empty() { plot } else { plot.x_axis_label(below) };
        let visuals = ui.visuals().clone();
        let shown = framed(ui, (name, change(plot)), bounds, move |plot| {
            ground(plot);
            panel.layers.iter().for_each(|layer| draw(plot, panel, layer, &visuals));
            plot.pointer_coordinate().map(|at| at.x)
        });
        shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
        axes(ui, whole, *shown.transform.frame(), words.0, words.1);
        names(ui, panel, &shown.transform);
        PlotResponse { inner: shown.inner.filter(|_| shown.response.hovered()), ..shown }
    }
}

/// Marks of an axis, at most about `most` where they are numbers.
fn axis_marks(axis: &Axis, input: &GridInput, most: f64) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    let by_one = |value: f64| GridMark { value, step_size: 1.0 };
    let least = (to - from) / most.max(1.0);
    let least = if axis.whole { least.max(1.0) } else { least };
    match axis.scale {
        _ if !axis.names.is_empty() => axis.names.iter().map(|(at, _)| by_one(*at)).collect(),
        Scale::Log if from.abs().max(to.abs()) < PLAIN_DECADES => log_marks([from, to], most),
        Scale::Log => decades([from, to], most, false).into_iter().map(by_one).collect(),
        Scale::Linear if least.is_finite() && least > 0.0 => marks(Steps::apart([from, to], least)),
        Scale::Linear => Vec::new(),
    }
}

/// How a value is written: as a mark of an axis with such steps, or without steps with all its digits.
fn written(axis: &Axis, value: f64, step_size: f64) -> String {
    let name = axis.names.iter().find(|(at, _)| *at == value);
    match (name, axis.scale) {
        (Some((_, name)), _) => name.clone(),
        (None, Scale::Log) if value.abs() > PLAIN_DECADES => power_of_ten(value.round()),
        (None, Scale::Log) => short(10f64.powf(value), DIGITS),
        (None, Scale::Linear) if step_size == 0.0 => short(value, DIGITS),
        (None, Scale::Linear) => tick(GridMark { value, step_size }),
    }
}

fn draw(plot: &mut PlotUi<'_>, panel: &Panel, layer: &Layer, visuals: &Visuals) {
    let at = |[x, y]: [f64; 2]| [panel.x.scale.place(x), panel.y.scale.place(y)];
    let colour = |of: Colour| on_screen(of, visuals);
    match layer {
        Layer::Line(figure::Line { name, points, style, .. }) => {
            let (colour, width) = (colour(style.colour), WIDTH * style.width as f32);
            let pieces = pieces(points.iter().map(|point| at(*point)));
            for piece in &pieces {
                plot.line(line(piece, colour, width, dashes(style.dash)));
            }
            if style.marker.is_some() {
                plot.points(dots(name, pieces.concat(), colour, 2.0));
            }
        }
        Layer::Band(band) => {
            let y = |value: f64| panel.y.scale.place(value);
            let columns = band.points.iter().map(|[x, low, high]| [panel.x.scale.place(*x), y(*low), y(*high)]);
            for piece in pieces(columns) {
                plot.add(between(&piece, colour(band.colour).gamma_multiply(band.opacity as f32)));
            }
        }
        Layer::Points(figure::Points { name, points, errors, colour: of, marker }) => {
            for ([x, y], error) in points.iter().zip(errors).filter(|(_, error)| error.is_finite()) {
                let bar = [-1.0, 1.0].map(|sign| at([*x, y + sign * error]));
                plot.line(line(&bar, colour(*of), 1.0, LineStyle::Solid));
            }
            let points = pieces(points.iter().map(|point| at(*point))).concat();
            let dots = dots(name, points, colour(*of), 0.9 * marker.size as f32);
            plot.points(dots.shape(shape(marker.shape)).filled(!marker.hollow));
        }
        Layer::Mark(Mark { direction, at: value, style, .. }) => {
            let (colour, width, dash) = (colour(style.colour), 1.5 * style.width as f32, dashes(style.dash));
            match direction {
                Direction::Horizontal => plot.hline(level(panel.y.scale.place(*value), colour, width).style(dash)),
                Direction::Vertical => plot.vline(upright(panel.x.scale.place(*value), colour, width).style(dash)),
            }
        }
        Layer::Map(_) | Layer::Categories(_) | Layer::Text(_) => {}
    }
}

/// Curves and areas are interrupted by what is not a number on its axis.
fn pieces<const N: usize>(points: impl Iterator<Item = [f64; N]>) -> Vec<Vec<[f64; N]>> {
    let points: Vec<[f64; N]> = points.collect();
    let pieces = points.split(|point| !point.iter().all(|part| part.is_finite()));
    pieces.filter(|piece| !piece.is_empty()).map(<[_]>::to_vec).collect()
}

/// Names of places, right of them and below; those that would lie on each other, one below the other.
fn names(ui: &egui::Ui, panel: &Panel, at: &PlotTransform) {
    let painter = ui.painter_at(*at.frame());
    let mut taken: Vec<Rect> = Vec::new();
    for layer in &panel.layers {
        let Layer::Text(figure::Text { at: [x, y], text }) = layer else { continue };
        let place = at.position_from_point(&PlotPoint::new(panel.x.scale.place(*x), panel.y.scale.place(*y)));
        let font = TextStyle::Body.resolve(ui.style());
        let galley = painter.layout_no_wrap(text.clone(), font, ui.visuals().text_color());
        let mut rect = Rect::from_min_size(place + vec2(5.0, 3.0), galley.size());
        while let Some(other) = taken.iter().find(|other| other.intersects(rect)) {
            rect = rect.translate(vec2(0.0, other.bottom() - rect.top() + 1.0));
        }
        painter.galley(rect.min, galley, ui.visuals().text_color());
        taken.push(rect);
    }
}

fn dashes(dash: Dash) -> LineStyle {
    match dash {
        Dash::Solid => LineStyle::Solid,
        Dash::Dashed => LineStyle::dashed_loose(),
        Dash::Dotted => LineStyle::dotted_dense(),
        Dash::DashDot => LineStyle::dashed_dense(),
    }
}

fn shape(shape: Shape) -> MarkerShape {
    match shape {
        Shape::Circle => MarkerShape::Circle,
        Shape::Square => MarkerShape::Square,
        Shape::Triangle => MarkerShape::Up,
        Shape::Diamond => MarkerShape::Diamond,
        Shape::Cross => MarkerShape::Cross,
    }
}

/// A plot with numbers at its axes, and no words at the pointer: dragged to see what is beside, zoomed with Ctrl and the wheel or by a box drawn
/// with the right button, and back with a double click. The wheel alone scrolls the tab that it is in.
fn numbered<'a>(name: &str, height: f32, axes: [AxisHints<'a>; 2]) -> Plot<'a> {
    // The spacers leave room for every number: none is to fade because others are near.
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
    pub(super) fn show(
        &self,
        ui: &mut egui::Ui,
        style: &PlotStyle,
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
        let spare = named.map_or(0.0, |name| gutter - 4.0 - style.width(name)).clamp(0.0, 0.6 * row);
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
        let shown = framed(child, (name, chart), self.bounds, add);
        shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
        if let Some(name) = named {
            let corner = pos2(shown.transform.frame().left() - 4.0 - spare, rect.bottom() + 1.0);
            let place = style.write(corner, Align2::RIGHT_TOP, name, style.palette.quiet);
            style.term(place, name.split(',').next().unwrap_or(name));
        }
        shown
    }
}

/// The x of the chart `name` that was clicked, or that its vertical line was dragged to.
pub(super) fn chosen(ui: &egui::Ui, shown: &PlotResponse<()>, line: Option<f64>, name: &str) -> Option<f64> {
    let clicked = shown.response.interact_pointer_pos().filter(|_| shown.response.clicked());
    let clicked = clicked.map(|at| shown.transform.value_from_position(at).x);
    line.and_then(|x| dragged(ui, &shown.transform, x, name)).or(clicked)
}

/// A vertical line of the chart `name` that is dragged along x: where it was dragged to. A double click is the chart's.
fn dragged(ui: &egui::Ui, at: &PlotTransform, x: f64, name: &str) -> Option<f64> {
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

/// Dots, which say what they are when the pointer is near, if they have a name.
pub(super) fn dots<'a>(name: &str, points: Vec<[f64; 2]>, colour: Color32, radius: f32) -> Points<'a> {
    Points::new(name, points).color(colour).radius(radius).allow_hover(!name.is_empty())
}

/// The area between two curves, given as (x, one y, other y).
pub(super) fn between(columns: &[[f64; 3]], colour: Color32) -> FilledArea {
    let [x, one, other] = [0, 1, 2].map(|k| columns.iter().map(|column| column[k]).collect::<Vec<_>>());
    FilledArea::new("", &x, &one, &other).fill_color(colour).allow_hover(false)
}

/// Explains the axes of a chart at `place` on hover, whose curves are within `frame`: that along x, and that along y.
fn axes(ui: &egui::Ui, place: Rect, frame: Rect, x: Option<&str>, y: &str) {
    let below = Rect::from_x_y_ranges(frame.x_range(), frame.bottom()..=place.bottom());
    let left = Rect::from_x_y_ranges(place.left()..=frame.left(), frame.y_range());
    for (number, (rect, word)) in [(below, x), (left, Some(y))].into_iter().enumerate() {
        if let Some(word) = word {
            // Charts of one tab are told apart by where they are.
            let number = number + 2 * place.top().max(0.0) as usize + 100_000 * place.left().max(0.0) as usize;
            glossary::over(ui, rect, word, number).explained_here(ui, word);
        }
    }
}

/// A title above a chart, with its unit, which the glossary explains under `word`.
pub(super) fn title(ui: &mut egui::Ui, text: &str, word: &str) {
    ui.add(egui::Label::new(RichText::new(text).strong()).wrap()).explained_here(ui, word);
}

/// The names of what panels draw, each once, which the glossary knows.
pub(super) fn legend(ui: &mut egui::Ui, panels: &[&Panel]) {
    let mut entries: Vec<(&str, Colour, &Layer)> = Vec::new();
    for layer in panels.iter().flat_map(|panel| &panel.layers) {
        let (name, colour) = match layer {
            Layer::Line(figure::Line { name, style, .. }) => (name, style.colour),
            Layer::Points(figure::Points { name, colour, .. }) => (name, *colour),
            Layer::Band(figure::Band { name, colour, .. }) => (name, *colour),
            Layer::Mark(Mark { label, style, .. }) => (label, style.colour),
            _ => continue,
        };
        if !name.is_empty() && entries.iter().all(|(other, ..)| other != name) {
            entries.push((name, colour, layer));
        }
    }
    if entries.is_empty() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for (name, colour, layer) in entries {
            let colour = on_screen(colour, ui.visuals());
            key(ui, name, SAMPLE + 0.35, 0.5, |painter, left, em| match layer {
                Layer::Line(figure::Line { style, .. }) | Layer::Mark(Mark { style, .. }) => {
                    let ends = [left, left + vec2(SAMPLE * em, 0.0)];
                    // A solid one is one dash.
                    let length = if let LineStyle::Dashed { length } = dashes(style.dash) { length } else { 1e6 };
                    painter.extend(egui::Shape::dashed_line(&ends, Stroke::new(2.0, colour), length, 0.6 * length));
                }
                Layer::Points(figure::Points { marker, .. }) => {
                    let (at, radius) = (left + vec2(0.5 * SAMPLE * em, 0.0), 0.25 * em);
                    let corner = |x: f32, y: f32| at + radius * vec2(x, y);
                    match marker {
                        figure::Marker { shape: Shape::Square, hollow, .. } => {
                            let square = Rect::from_center_size(at, vec2(1.6, 1.6) * radius);
                            let fill = if *hollow { Color32::TRANSPARENT } else { colour };
                            painter.rect(square, 0.0, fill, Stroke::new(1.5, colour), egui::StrokeKind::Inside);
                        }
                        figure::Marker { hollow: true, .. } => {
                            painter.circle_stroke(at, 1.2 * radius, Stroke::new(2.0, colour));
                        }
                        figure::Marker { shape: Shape::Triangle, .. } => {
                            let corners = vec![corner(0.0, -1.1), corner(1.0, 0.8), corner(-1.0, 0.8)];
                            painter.add(egui::Shape::convex_polygon(corners, colour, Stroke::NONE));
                        }
                        _ => drop(painter.circle_filled(at, radius, colour)),
                    }
                }
                _ => {
                    let area = Rect::from_center_size(left + vec2(0.5 * SAMPLE * em, 0.0), vec2(SAMPLE * em, 0.5 * em));
                    painter.rect_filled(area, 1.0, colour);
                }
            });
        }
    });
}

/// An entry of a legend, in one piece, so that it is a whole that goes to the next line. What `draw` draws from a place on, at half the
/// height of the text, has `indent` before the text, which has `after` behind it, in heights of the text.
fn key(ui: &mut egui::Ui, text: &str, indent: f32, after: f32, draw: impl FnOnce(&egui::Painter, egui::Pos2, f32)) {
    let (font, colour) = (TextStyle::Body.resolve(ui.style()), ui.visuals().text_color());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, colour);
    let em = galley.size().y;
    let size = vec2(indent * em + galley.size().x + after * em, em);
    let (area, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, text));
    response.explained_here(ui, text);
    draw(ui.painter(), area.left_center(), em);
    ui.painter().galley(area.left_top() + vec2(indent * em, 0.0), galley, colour);
}

/// Marks of an axis of log₁₀ at round numbers, about `most`: equal steps, where the logarithm has them, if the range is less than a few powers.
fn log_marks(range: [f64; 2], most: f64) -> Vec<GridMark> {
    let mut found = decades(range, most, true);
    if found.len() as f64 > 1.5 * most {
        found = decades(range, most, false);
    }
    if found.len() < 2 {
        let ticks = Steps::new(range.map(|end| 10f64.powf(end)), most as usize);
        found = ticks.values().filter(|value| *value > 0.0).map(f64::log10).collect();
    }
    // A step is what is free beside a mark.
    let gap = |pair: &[f64]| (pair[1] - pair[0]).abs();
    let free = |i: usize| found[i.saturating_sub(1)..(i + 2).min(found.len())].windows(2).map(gap).fold(1.0, f64::min);
    found.iter().enumerate().map(|(i, value)| GridMark { value: *value, step_size: free(i) }).collect()
}

/// As many decimals as the steps between ticks need, with a true minus sign.
fn tick(mark: GridMark) -> String {
    Steps::of([mark.value; 2], mark.step_size).format(mark.value)
}

/// Round marks, about `about`, and two at least beyond the share `hidden` of the axis at its beginning if it has room for `most`.
fn several(input: &GridInput, hidden: f32, about: usize, most: f32) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    marks(Steps::several([from, to], from + f64::from(hidden) * (to - from), about, most.into()))
}

/// Marks at these numbers.
fn marks(ticks: Steps) -> Vec<GridMark> {
    ticks.values().map(|value| GridMark { value, step_size: ticks.step() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Progress;
    use crate::export::figures::convergence;

    fn values(marks: &[GridMark]) -> Vec<f64> {
        marks.iter().map(|mark| mark.value).collect()
    }

    #[test]
    fn every_grid_has_a_line_and_a_residual_of_zero_is_left_out() {
        let round = |level, iteration, residual| Progress {
            level,
            levels: 2,
            iteration,
            residual,
            tolerance: 1e-6,
            film_load: 0.0,
        };
        let history = [round(0, 1, 1e-2), round(0, 2, 0.0), round(1, 1, 1e-4), round(1, 1, 1e-5)];
        let panel = &convergence(&history).panels[0];
        let drawn = panel.layers.iter().filter_map(|layer| match layer {
            Layer::Line(line) => Some(pieces(line.points.iter().map(|[x, y]| [*x, panel.y.scale.place(*y)]))),
            _ => None,
        });
        assert_eq!(drawn.collect::<Vec<_>>(), [[vec![[1.0, -2.0]]], [vec![[1.0, -4.0]]], [vec![[1.0, -5.0]]]]);
    }

    #[test]
    fn marks_of_equal_ratios_are_round_whatever_the_range() {
        let texts = |axis: &Axis, bounds: [f64; 2], most: f64| {
            let bounds = bounds.map(|end| axis.scale.place(end));
            let input = GridInput { bounds: (bounds[0], bounds[1]), base_step_size: 1.0 };
            axis_marks(axis, &input, most)
                .into_iter()
                .map(|mark| written(axis, mark.value, mark.step_size))
                .collect::<Vec<_>>()
        };
        let log = Axis::default().log();
        assert_eq!(texts(&log, [50.0, 800.0], 8.0), ["50", "100", "200", "500"]);
        assert_eq!(texts(&log, [0.01, 1000.0], 8.0), ["0.01", "0.1", "1", "10", "100", "1000"]);
        assert!(texts(&log, [100.0, 130.0], 8.0).len() >= 3);
        assert_eq!(texts(&Axis::default(), [0.0, 1.0], 8.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    }

    #[test]
    fn ticks_are_round_inside_and_few() {
        let input = |bounds| GridInput { bounds, base_step_size: 1.0 };
        let linear = |input: &GridInput, most: f64| axis_marks(&Axis::default(), input, most);
        assert_eq!(values(&linear(&input((0.0, 104.0)), 4.0)), [0.0, 50.0, 100.0]);
        assert_eq!(values(&linear(&input((-30.0, 150.0)), 5.0)), [0.0, 50.0, 100.0, 150.0]);
        let texts: Vec<String> = linear(&input((-0.5, 1.6)), 5.0).into_iter().map(tick).collect();
        assert_eq!(texts, ["−0.5", "0.0", "0.5", "1.0", "1.5"]);
        for bounds in [(0.0, 0.0), (f64::NEG_INFINITY, f64::INFINITY)] {
            assert!(linear(&input(bounds), 4.0).is_empty());
        }
    }
}
