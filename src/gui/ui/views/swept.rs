//! A sweep: over one parameter a line with its error as a band, over two a map with lines of equal value. Points appear as
//! they are solved; the nearest to the pointer is read out, and a click asks for its scene.

use super::pointer::named;
use crate::analysis::attempt::RunStatus;
use crate::analysis::quantity::Quantity;
use crate::analysis::sweep::{Axis, Row, typical_error};
use crate::analysis::table1::Published;
use crate::digits::{capitalised, short, significant};
use crate::estimate::Estimate;
use crate::export::figure::{contour, is_contour};
use crate::gui::command::SweepCommand;
use crate::gui::derived::format::raised;
use crate::gui::derived::scales::span;
use crate::gui::derived::words::label;
use crate::gui::state::sweep::Swept;
use crate::gui::ui::cache::once;
use crate::gui::ui::chart::{self, Inset, between, dots, tick, upright};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{Axes, PlotStyle, field_colours, title_with_ends};
use crate::scene::{ParameterKind, Scale};
use crate::solution::StoppedBy;
use crate::ticks::{Steps, decades};
use eframe::egui::epaint::Mesh;
use eframe::egui::{
    Align2, Color32, CursorIcon, Painter, Pos2, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2,
};
use egui_plot::{GridMark, LineStyle, MarkerShape, Plot, PlotPoint};
use std::sync::Arc;

/// Each point has its dot if they are at least this far apart.
const DOT_SPACING: f32 = 7.0;
/// Radius of a dot, and of the ring round the one that is pointed at.
const DOT: f32 = 3.0;
const RING: f32 = 7.0;
/// Radius of what stands for a point without a value, and of one of Table I.
const CROSS: f32 = 5.0;
const SQUARE: f32 = 5.5;
/// What the drawing is called.
const NAME: &str = "Sweep: point to read a value, click to make its scene the present one";
/// Significant digits of a value that is varied, at most.
const DIGITS: usize = 6;
/// How near the pointer has to be.
const NEAR: f32 = 40.0;
/// Lines of equal value, about.
const LEVELS: usize = 7;
/// An end of the colours that is less than this share of the range is zero.
const NOTHING: f64 = 1e-3;
/// Values whose greatest is more than this many times the least have many sizes.
const MANY_SIZES: f64 = 300.0;
/// An axis of values that reach below this share of the greatest begins at zero.
const FROM_ZERO: f64 = 0.6;

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Plotted<'a> {
    /// The sweep, with its rows so far.
    pub swept: &'a Swept,
    /// What is read off them.
    pub quantity: Quantity,
    /// Where the present scene is.
    pub present: Option<&'a [f64]>,
}

impl Plotted<'_> {
    /// The value at a row that converged.
    fn sound(&self, row: &Row) -> Option<Estimate> {
        row.numbers.estimate(self.quantity).filter(|_| row.status == RunStatus::Converged)
    }

    /// What Table I says of the quantity.
    fn published(&self, point: &Published) -> Option<f64> {
        match self.quantity {
            Quantity::Alpha => Some(point.alpha),
            Quantity::FilmLoad => Some(point.film_load),
            _ => None,
        }
    }

    /// A row in words.
    fn words(&self, row: &Row) -> String {
        let mut lines: Vec<String> = Vec::new();
        for (axis, value) in self.swept.sweep.axes().iter().zip(&row.values) {
            lines.push(format!("{} {} {}", label(axis.parameter), short(*value, DIGITS), axis.parameter.unit));
        }
        let unit = self.quantity.unit(self.swept.sweep.problem());
        let name = capitalised(self.quantity.words());
        let value = raised(&row.numbers.text(self.quantity));
        lines.push(if value.is_empty() { format!("{name}: none") } else { format!("{name} {value} {unit}") });
        match &row.status {
            RunStatus::Converged if row.stopped_by == Some(StoppedBy::Budget) => {
                lines.push("As far as time allowed".to_owned());
            }
            RunStatus::Converged => {}
            other => lines.push(other.to_string()),
        }
        lines.push("Click to make this the present scene".to_owned());
        lines.iter().map(|line| line.trim_end()).collect::<Vec<_>>().join("\n")
    }
}

/// Draws the sweep into all of `ui`.
pub fn show(ui: &mut Ui, plotted: &Plotted<'_>, cx: &DrawContext<'_>) {
    let size = ui.available_size().min(vec2(6000.0, 6000.0));
    let (area, _) = ui.allocate_exact_size(size, Sense::hover());
    if area.width() < 160.0 || area.height() < 120.0 {
        return;
    }
    let mut style = PlotStyle::new(ui);
    style.gutter = 3.0 * style.row;
    let (response, pointed) = match plotted.swept.sweep.axes() {
        [x] => line(ui, &style, area, plotted, x),
        [x, y] => {
            let pointed = map(ui, &style, area, plotted, x, y);
            (named(ui, area, NAME), pointed)
        }
        _ => return,
    };
    let on_a_term = style.explain(ui);
    // What is drawn follows the pointer of the frame before, which is this one while it rests.
    let Some(row) = pointed.filter(|_| !on_a_term) else { return };
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    if response.clicked() {
        cx.push(SweepCommand::Open(row.point));
    }
    response.on_hover_ui_at_pointer(|ui| {
        ui.label(plotted.words(row));
    });
}

/// Where a value of an axis is: equal ratios are equal steps of the logarithm.
fn place(axis: &Axis, value: f64) -> f64 {
    if axis.scale == Scale::Log { value.log10() } else { value }
}

fn ends(axis: &Axis) -> [f64; 2] {
    span(axis.values.iter().map(|value| place(axis, *value)))
}

/// Round numbers with their places, about as many as there is room for.
fn marks(axis: &Axis, range: [f64; 2], most: usize) -> Vec<GridMark> {
    if axis.scale != Scale::Log {
        let counted = matches!(axis.parameter.kind, ParameterKind::Whole { .. });
        let least = (range[1] - range[0]) / most.max(1) as f64;
        return chart::marks(Steps::apart(range, if counted { least.max(1.0) } else { least }));
    }
    let mut found = decades(range, most as f64, true);
    if !(2..=most.max(2)).contains(&found.len()) {
        // Less than a few: equal steps, where the logarithm has them.
        let ticks = Steps::new(range.map(|end| 10f64.powf(end)), most);
        found = ticks.values().filter(|value| *value > 0.0).map(f64::log10).collect();
    }
    // A step is what is free beside a mark.
    let gap = |pair: &[f64]| (pair[1] - pair[0]).abs();
    let free = |i: usize| found[i.saturating_sub(1)..(i + 2).min(found.len())].windows(2).map(gap).fold(1.0, f64::min);
    found.iter().enumerate().map(|(i, value)| GridMark { value: *value, step_size: free(i) }).collect()
}

/// What is written at a mark.
fn written(axis: &Axis, mark: GridMark) -> String {
    if axis.scale == Scale::Log { short(10f64.powf(mark.value), DIGITS) } else { tick(mark) }
}

/// The name of an axis.
fn name(axis: &Axis) -> String {
    let unit = axis.parameter.unit;
    if unit.is_empty() { label(axis.parameter).to_owned() } else { format!("{}, {unit}", label(axis.parameter)) }
}

/// About how many values there is room for along x.
fn columns(style: &PlotStyle, width: f32) -> usize {
    (width / (4.2 * style.row)).clamp(2.0, 12.0) as usize
}

/// Values and name of the axis along x of a map.
fn draw_x(painter: &Painter, style: &PlotStyle, axes: &Axes, axis: &Axis) {
    let mut free = f32::NEG_INFINITY;
    for mark in marks(axis, axes.x, columns(style, axes.rect.width())) {
        let (x, text) = (axes.px(mark.value), written(axis, mark));
        let half = 0.5 * style.width(painter, &text);
        if x - half > free {
            style.write(painter, pos2(x, axes.rect.bottom() + 2.0), Align2::CENTER_TOP, &text, style.palette.quiet);
            free = x + half + 6.0;
        }
    }
    name_x(painter, style, axes.rect, axis);
}

/// The name of the axis along x, below its values.
fn name_x(painter: &Painter, style: &PlotStyle, rect: Rect, axis: &Axis) {
    let below = pos2(rect.center().x, rect.bottom() + 3.0 + style.row);
    about(style, style.write(painter, below, Align2::CENTER_TOP, &name(axis), style.text), axis);
}

/// What the marks in a map are, at the right end of the line above it, right of `free`.
fn marked(painter: &Painter, style: &PlotStyle, rect: Rect, free: f32, plotted: &Plotted<'_>) {
    let marks = [
        ("○ present", "present", plotted.present.is_some()),
        ("□ Table I", "Table I", !plotted.swept.published.is_empty()),
    ];
    let mut right = rect.right();
    for (text, word, _) in marks.into_iter().filter(|mark| mark.2) {
        if right - style.width(painter, text) > free + style.row {
            let corner = pos2(right, rect.top() - 2.0);
            let place = style.write(painter, corner, Align2::RIGHT_BOTTOM, text, style.palette.quiet);
            style.term(place, word);
            right = place.left() - style.row;
        }
    }
}

/// What is varied is explained where it is named.
fn about(style: &PlotStyle, named: Rect, axis: &Axis) {
    let text = format!("{}\n{}", axis.parameter.about, axis.parameter.key);
    style.parameter(named, label(axis.parameter), text);
}

/// The plot within `area`: titles above, values left and below.
fn plot(area: Rect, style: &PlotStyle, gutter: f32, titles: f32) -> Rect {
    Rect::from_min_max(
        pos2(area.left() + gutter, area.top() + titles * (style.row + 6.0)),
        pos2(area.right() - 0.8 * style.row, area.bottom() - 2.0 * style.row - 8.0),
    )
}

fn pointer(ui: &Ui, rect: Rect) -> Option<Pos2> {
    ui.ctx().pointer_hover_pos().filter(|at| rect.contains(*at) && ui.ctx().layer_id_at(*at) == Some(ui.layer_id()))
}

fn cross(painter: &Painter, at: Pos2, reach: f32, stroke: Stroke) {
    for (a, b) in [(vec2(-reach, -reach), vec2(reach, reach)), (vec2(-reach, reach), vec2(reach, -reach))] {
        painter.line_segment([at + a, at + b], stroke);
    }
}

/// One parameter: the response of its chart, and the row that is pointed at.
fn line<'a>(
    ui: &mut Ui,
    style: &PlotStyle,
    area: Rect,
    plotted: &Plotted<'a>,
    axis: &Axis,
) -> (Response, Option<&'a Row>) {
    let mut rows: Vec<(&Row, f64)> = plotted.swept.rows.iter().map(|row| (row, place(axis, row.values[0]))).collect();
    rows.sort_by(|a, b| a.1.total_cmp(&b.1));
    let x = ends(axis);
    let table: Vec<[f64; 2]> = plotted
        .swept
        .published
        .iter()
        .filter_map(|point| Some([place(axis, point.values[0]), plotted.published(point)?]))
        .filter(|at| (x[0] - 1e-9..=x[1] + 1e-9).contains(&at[0]))
        .collect();
    let bands = rows.iter().filter_map(|(row, _)| plotted.sound(row)).flat_map(|Estimate { value, error }| {
        // An error without bounds is not drawn.
        if error.is_finite() { [value - error, value + error] } else { [value; 2] }
    });
    let unsound = rows.iter().filter(|(row, _)| row.status == RunStatus::NotConverged);
    let unsound = unsound.filter_map(|(row, _)| row.numbers.get(plotted.quantity));
    let [mut low, mut high] = span(bands.chain(unsound).chain(table.iter().map(|at| at[1])));
    if low > 0.0 && low < FROM_ZERO * high {
        low = 0.0;
    } else if high < 0.0 && high > FROM_ZERO * low {
        high = 0.0;
    }
    let margin = 0.06 * (high - low);
    let y = [if low == 0.0 { 0.0 } else { low - margin }, if high == 0.0 { 0.0 } else { high + margin }];
    let side = 0.02 * (x[1] - x[0]);
    let colour = style.palette.film;
    let most = columns(style, area.width());
    let rect = plot(area, style, style.gutter, 1.0);
    let inset = Inset { name: NAME, rect, bounds: [[x[0] - side, x[1] + side], y], below: Some("") };
    let present = plotted.present.map(|values| place(axis, values[0]));
    let many = rect.width() / (axis.values.len() as f32) < DOT_SPACING && rows.len() > 2;
    let marked = |chart| -> Plot<'_> {
        let chart: Plot<'_> = chart;
        chart
            .x_grid_spacer(move |input| marks(axis, [input.bounds.0, input.bounds.1], most))
            .x_axis_formatter(move |mark, _| written(axis, mark))
    };
    let shown = inset.show_with(ui, style, marked, |chart| {
        if let Some(present) = present {
            chart.vline(upright(present, style.palette.accent, 1.0).style(LineStyle::dashed_dense()));
        }
        // Neighbours on screen are joined if no point is missing between them that will still come.
        let step = (x[1] - x[0]) / (axis.values.len().max(2) - 1) as f64;
        let reach = if matches!(axis.parameter.kind, ParameterKind::Whole { .. }) { f64::INFINITY } else { 1.5 * step };
        let joined = |a: &(&Row, f64), b: &(&Row, f64)| {
            b.1 - a.1 <= reach && [a, b].iter().all(|(row, _)| plotted.sound(row).is_some())
        };
        for piece in rows.chunk_by(joined).filter(|piece| piece.len() > 1) {
            let columns = piece.iter().filter_map(|(row, at)| {
                let Estimate { value, error } = plotted.sound(row)?;
                Some(([*at, value], if error.is_finite() { error } else { 0.0 }))
            });
            let (curve, errors): (Vec<[f64; 2]>, Vec<f64>) = columns.unzip();
            let columns = curve.iter().zip(&errors).map(|([at, value], error)| [*at, value + error, value - error]);
            chart.add(between(&columns.collect::<Vec<_>>(), colour.gamma_multiply(0.22)));
            chart.line(chart::line(&curve, colour, 1.8, LineStyle::Solid));
        }
        let (sound, unsound): (Vec<_>, Vec<_>) = rows.iter().partition(|(row, _)| plotted.sound(row).is_some());
        let points = |rows: &[(&Row, f64)]| -> Vec<[f64; 2]> {
            rows.iter().map(|(row, at)| [*at, row.numbers.get(plotted.quantity).unwrap_or(y[0])]).collect()
        };
        if !many {
            chart.points(dots(points(&sound), colour, DOT));
        }
        chart.points(dots(points(&unsound), style.palette.alarm, CROSS).shape(MarkerShape::Cross));
        chart.points(dots(table.clone(), style.palette.contact, SQUARE).shape(MarkerShape::Square).filled(false));
    });
    let at = shown.transform;
    let frame = *at.frame();
    let painter = ui.painter_at(area);
    name_x(&painter, style, frame, axis);
    let mut legend = vec![("computed", colour)];
    if plotted.quantity.error().is_some() {
        legend.push(("stated error", colour.gamma_multiply(0.4)));
    }
    if !table.is_empty() {
        legend.push(("Table I", style.palette.contact));
    }
    let title = capitalised(&plotted.quantity.label(plotted.swept.sweep.problem()));
    style.title(&painter, frame, plotted.quantity.words(), &[&title], &legend);
    if let Some(x) = present.map(|x| at.position_from_point_x(x)).filter(|x| frame.x_range().contains(*x)) {
        let left = x > frame.center().x;
        let (anchor, gap) = if left { (Align2::RIGHT_BOTTOM, -4.0) } else { (Align2::LEFT_BOTTOM, 4.0) };
        let place = pos2(x + gap, frame.bottom() - 2.0);
        style.term(style.write(&painter, place, anchor, "present", style.palette.accent), "present");
    }
    let pointed = shown.response.hover_pos().and_then(|pointer| {
        let on_screen = |(row, at_x): &(&Row, f64)| {
            let value = row.numbers.get(plotted.quantity).unwrap_or(y[0]);
            at.position_from_point(&PlotPoint::new(*at_x, value))
        };
        let far = |row: &(&Row, f64)| (on_screen(row).x - pointer.x).abs();
        let row = rows.iter().min_by(|a, b| far(a).total_cmp(&far(b))).filter(|row| far(row) < NEAR)?;
        painter.with_clip_rect(frame.expand(RING)).circle_stroke(
            on_screen(row),
            RING,
            Stroke::new(2.0, style.palette.accent),
        );
        Some(row.0)
    });
    (shown.response, pointed)
}

/// Ascending places, and the edges of the cells round them.
fn cells(axis: &Axis) -> (Vec<f64>, Vec<f64>) {
    let mut places: Vec<f64> = axis.values.iter().map(|value| place(axis, *value)).collect();
    places.sort_by(f64::total_cmp);
    let mut edges: Vec<f64> = places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    if let ([first, second, ..], [.., before, last]) = (&places[..], &places[..]) {
        edges.insert(0, 1.5 * first - 0.5 * second);
        edges.push(1.5 * last - 0.5 * before);
    }
    (places, edges)
}

/// Two parameters.
fn map<'a>(ui: &Ui, style: &PlotStyle, area: Rect, plotted: &Plotted<'a>, x: &Axis, y: &Axis) -> Option<&'a Row> {
    let painter = ui.painter_at(area);
    let ((xs, x_edges), (ys, y_edges)) = (cells(x), cells(y));
    let nearest = |places: &[f64], at: f64| {
        let right = places.partition_point(|place| *place < at).clamp(1, places.len().max(2) - 1);
        if at - places[right - 1] < places[right] - at { right - 1 } else { right }
    };
    let cell = |row: &Row| (nearest(&xs, place(x, row.values[0])), nearest(&ys, place(y, row.values[1])));
    let shown = || plotted.swept.rows.iter().filter_map(|row| plotted.sound(row)).map(|found| found.value);
    let extent = span(shown());
    // Values of many sizes get colours by their logarithm, else all but the greatest look the same; a share lies between 0 and 1.
    let log = extent[0] > 0.0 && extent[1] > MANY_SIZES * extent[0] && !plotted.quantity.is_share();
    let tone = |value: f64| if log { value.log10() } else { value };
    let range = extent.map(tone);
    let limits = [[x_edges[0], x_edges[x_edges.len() - 1]], [y_edges[0], y_edges[y_edges.len() - 1]]];
    let most = (area.height() / (2.6 * style.row)).clamp(2.0, 10.0) as usize;
    let y_marks = marks(y, limits[1], most);
    let widest = y_marks.iter().map(|mark| style.width(&painter, &written(y, *mark))).fold(0.0, f32::max);
    let rect = plot(area, style, widest.max(2.0 * style.row) + 8.0, 2.0);
    let axes = Axes::new(rect, limits[0], limits[1]);
    axes.canvas(&painter, style);
    let title = capitalised(&plotted.quantity.label(plotted.swept.sweep.problem()));
    let title = if log { format!("{title}, logarithmic colours") } else { title };
    if plotted.swept.rows.iter().any(|row| plotted.sound(row).is_some()) {
        let nothing = if log { 0.0 } else { NOTHING * (extent[1] - extent[0]) };
        let written = |end: f64| if end.abs() < nothing { "0".to_owned() } else { significant(end, 3) };
        let ends = extent.map(written);
        let above = rect.translate(vec2(0.0, -style.row - 6.0));
        let ends = ends.each_ref().map(String::as_str);
        title_with_ends(&painter, style, above, plotted.quantity.words(), &[&title], ends);
    }
    let corner = pos2(rect.left(), rect.top() - 2.0);
    let named = style.write(&painter, corner, Align2::LEFT_BOTTOM, &format!("↑ {}", name(y)), style.text);
    about(style, named, y);
    marked(&painter, style, rect, named.right(), plotted);
    draw_x(&painter, style, &axes, x);
    for mark in y_marks {
        let (at, text) = (pos2(rect.left() - 4.0, axes.py(mark.value)), written(y, mark));
        style.write(&painter, at, Align2::RIGHT_CENTER, &text, style.palette.quiet);
    }

    let inner = painter.with_clip_rect(painter.clip_rect().intersect(rect));
    let area_of = |(i, j): (usize, usize)| {
        Rect::from_x_y_ranges(
            axes.px(x_edges[i])..=axes.px(x_edges[i + 1]),
            axes.py(y_edges[j + 1])..=axes.py(y_edges[j]),
        )
    };
    let mut values = vec![f64::NAN; xs.len() * ys.len()];
    let mut mesh = Mesh::default();
    let colours = field_colours();
    let per_colour = if range[1] > range[0] { 255.0 / (range[1] - range[0]) } else { 0.0 };
    for row in &plotted.swept.rows {
        let at = cell(row);
        if let Some(Estimate { value, .. }) = plotted.sound(row) {
            let value = tone(value);
            values[at.0 * ys.len() + at.1] = value;
            let colour = ((value - range[0]) * per_colour).clamp(0.0, 255.0) as usize;
            mesh.add_colored_rect(area_of(at), colours[colour]);
        }
    }
    inner.add(Shape::Mesh(Arc::new(mesh)));
    let lines = once(ui, "contours", (plotted.swept.number, plotted.swept.rows.len(), plotted.quantity), || {
        let ticks = Steps::new(range, LEVELS);
        // Where lines would be nearer to each other than values are told apart there are none.
        if !log && ticks.step() <= typical_error(&plotted.swept.rows, plotted.quantity) {
            return Vec::new();
        }
        let levels = levels(ticks, range, log);
        levels.map(|level| (level, contour(&xs, &ys, &values, level))).collect::<Vec<Contour>>()
    });
    contours(&inner, style, &axes, &lines, (range, log));
    for row in plotted.swept.rows.iter().filter(|row| plotted.sound(row).is_none()) {
        cross(&inner, area_of(cell(row)).center(), 4.0, Stroke::new(1.8, style.palette.alarm));
    }
    for point in &plotted.swept.published {
        let at = axes.at(place(x, point.values[0]), place(y, point.values[1]));
        for (size, width, colour) in [(9.0, 1.8, Color32::BLACK), (12.0, 1.0, Color32::WHITE)] {
            let square = Rect::from_center_size(at, vec2(size, size));
            inner.rect_stroke(square, 0.0, Stroke::new(width, colour), StrokeKind::Middle);
        }
    }
    if let Some([px, py]) = plotted.present.and_then(|values| <[f64; 2]>::try_from(values).ok()) {
        let at = axes.at(place(x, px), place(y, py));
        inner.circle_stroke(at, RING, Stroke::new(3.5, Color32::BLACK));
        inner.circle_stroke(at, RING, Stroke::new(1.8, Color32::WHITE));
    }
    let pointer = pointer(ui, rect)?;
    let row = plotted.swept.rows.iter().find(|row| area_of(cell(row)).contains(pointer))?;
    inner.rect_stroke(area_of(cell(row)), 0.0, Stroke::new(2.0, Color32::WHITE), StrokeKind::Inside);
    Some(row)
}

/// Values that get a line: none so near to an end that it would follow what the error is of.
fn levels(ticks: Steps, range: [f64; 2], log: bool) -> impl Iterator<Item = f64> {
    let fraction = move |level: f64| (level - range[0]) / (range[1] - range[0]);
    let whole = move |level: &f64| !log || (level - level.round()).abs() < 1e-6;
    ticks.values().filter(move |level| is_contour(fraction(*level))).filter(whole)
}

/// A value, and the lines on which it is found.
type Contour = (f64, Vec<Vec<[f64; 2]>>);

/// Lines of equal value, each with its value once.
fn contours(painter: &Painter, style: &PlotStyle, axes: &Axes, lines: &[Contour], (range, log): ([f64; 2], bool)) {
    let ticks = Steps::new(range, LEVELS);
    let mut written: Vec<Rect> = Vec::new();
    for (level, pieces) in lines {
        let level = *level;
        let part = (level - range[0]) / (range[1] - range[0]);
        let colour = if part > 0.55 { Color32::from_black_alpha(190) } else { Color32::from_white_alpha(190) };
        let text = if log { short(10f64.powf(level.round()), DIGITS) } else { ticks.format(level) };
        let size = vec2(style.width(painter, &text) + 4.0, style.row);
        for piece in pieces {
            let points: Vec<Pos2> = piece.iter().map(|[x, y]| axes.at(*x, *y)).collect();
            let middle = points[points.len() / 2];
            let length: f32 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            painter.line(points, Stroke::new(1.2, colour));
            let place = Rect::from_center_size(middle, size);
            let free =
                axes.rect.contains_rect(place) && written.iter().all(|other| !other.intersects(place.expand(4.0)));
            if free && length > 3.0 * size.x {
                let fill = field_colours()[(255.0 * part).clamp(0.0, 255.0) as usize];
                painter.rect_filled(place, 2.0, fill);
                style.write(painter, middle, Align2::CENTER_CENTER, &text, colour.to_opaque());
                written.push(place);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::sweep::Vary;
    use crate::scene::presets;

    fn axis(vary: &str) -> Axis {
        let vary: Vary = vary.parse().unwrap();
        Axis::new(&presets::find("fundamental").unwrap(), &vary).unwrap()
    }

    #[test]
    fn ticks_of_equal_ratios_are_round_whatever_the_range() {
        let texts = |vary: &str| {
            let axis = axis(vary);
            marks(&axis, ends(&axis), 8).into_iter().map(|mark| written(&axis, mark)).collect::<Vec<_>>()
        };
        assert_eq!(texts("film.min_spacing_nm=50:800:9:log"), ["50", "100", "200", "500"]);
        assert_eq!(texts("stator.frequency_khz=0.01:1000:9:log"), ["0.01", "0.1", "1", "10", "100", "1000"]);
        assert!(texts("film.min_spacing_nm=100:130:9:log").len() >= 3);
        assert_eq!(texts("motor.dry_friction=0:1:5"), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    }

    #[test]
    fn no_line_of_equal_value_follows_what_is_error_alone() {
        let range = [-1.1e-5, 1.0];
        let found: Vec<String> =
            levels(Steps::new(range, LEVELS), range, false).map(|level| format!("{level:.1}")).collect();
        assert_eq!(found, ["0.2", "0.4", "0.6", "0.8"]);
        let range = [-5.2, 0.5];
        assert_eq!(levels(Steps::new(range, LEVELS), range, true).count(), 6);
    }

    #[test]
    fn cells_touch_and_cover_their_points() {
        for vary in ["film.min_spacing_nm=400:50:6:log", "stator.teeth_per_wave=5:12:5"] {
            let (places, edges) = cells(&axis(vary));
            assert_eq!(edges.len(), places.len() + 1);
            for (i, place) in places.iter().enumerate() {
                assert!(edges[i] < *place && *place < edges[i + 1], "{vary}: {places:?} {edges:?}");
            }
        }
    }
}
