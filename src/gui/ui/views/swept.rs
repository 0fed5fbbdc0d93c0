//! A sweep: over one parameter, a line with its error as a band; over two, a map with contour lines. Points appear as they are solved; the
//! point nearest to the pointer is read out, and a click makes its scene the present one.

use crate::analysis::attempt::RunStatus;
use crate::analysis::quantity::Quantity;
use crate::analysis::sweep::{Axis, SweepRow, typical_error};
use crate::digits::{capitalised, raised, short, significant};
use crate::estimate::Estimate;
use crate::export::figure::{
    self, Colour, Dash, Layer, Mark, Marker, Panel, Points, Shape, Style, contour, is_contour,
};
use crate::export::sweep::{curve_panel, map_panel};
use crate::gui::command::SweepCommand;
use crate::gui::derived::scales::{span, with_margin};
use crate::gui::derived::words::label;
use crate::gui::state::sweep::Swept;
use crate::gui::ui::cache::once;
use crate::gui::ui::chart::{Chart, legend, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::paint::{PlotStyle, colour_between};
use crate::gui::ui::plot::{self, line};
use crate::gui::ui::theme::{ACCENT, on_screen};
use crate::scene::Scale;
use crate::solution::StoppedBy;
use crate::ticks::Steps;
use eframe::egui::{
    self, Color32, CursorIcon, FontId, Id, Pos2, Rect, Response, RichText, Sense, Stroke, StrokeKind, Ui, vec2,
};
use egui_plot::{
    LineStyle, PlotBounds, PlotGeometry, PlotItem, PlotItemBase, PlotMemory, PlotPoint, PlotResponse, PlotTransform,
    PlotUi, Text,
};
use std::ops::RangeInclusive;

/// Radius of the ring round the point under the pointer.
const RING: f32 = 7.0;
const NAME: &str = "Sweep: point to read a value, click to make its scene the present one";
/// Least size of a mark other than a dot of the curve, as in printed figures \[pt\].
const MARK: f64 = 5.0;
/// Most significant digits of a value that is varied.
const DIGITS: usize = 6;
/// Greatest distance from the pointer at which a point reacts to it \[points\].
const NEAR: f32 = 40.0;
/// Approximate number of contour lines.
const LEVELS: usize = 7;
/// An end of the colour range below this share of the range is set to zero.
const NOTHING: f64 = 1e-3;
/// Values count as of many orders of magnitude if the greatest is more than this many times the least.
const MANY_SIZES: f64 = 300.0;
/// If the least value is below this share of the greatest, the axis begins at zero.
const FROM_ZERO: f64 = 0.6;

/// A sweep to draw, the quantity shown, and the present scene.
#[derive(Clone, Copy, Debug)]
pub struct Plotted<'a> {
    /// The sweep, with its rows so far.
    pub swept: &'a Swept,
    /// The quantity shown.
    pub quantity: Quantity,
    /// The present scene's values of the varied parameters, if it has them.
    pub present: Option<&'a [f64]>,
}

impl Plotted<'_> {
    /// The value of a row that converged.
    fn sound(&self, row: &SweepRow) -> Option<Estimate> {
        row.numbers.estimate(self.quantity).filter(|_| row.status == RunStatus::Converged)
    }

    fn words(&self, row: &SweepRow) -> String {
        let mut lines: Vec<String> = Vec::new();
        for (axis, value) in self.swept.sweep.axes().iter().zip(&row.values) {
            let unit = self.swept.sweep.scene().unit(axis.parameter);
            lines.push(format!("{} {} {unit}", label(axis.parameter), short(*value, DIGITS)));
        }
        let unit = self.quantity.unit(self.swept.sweep.problem());
        let name = capitalised(self.quantity.words());
        let value = raised(&row.numbers.text(self.quantity));
        lines.push(if value.is_empty() { format!("{name}: none") } else { format!("{name} {value} {unit}") });
        match &row.status {
            RunStatus::Converged if row.stopped_by == Some(StoppedBy::Budget) => {
                lines.push("Stopped by the time limit".to_owned());
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
    let size = ui.available_size();
    if size.x < 160.0 || size.y < 120.0 {
        return;
    }
    let (response, pointed) = match plotted.swept.sweep.axes() {
        [x] => curve(ui, plotted, x),
        [x, y] => map(ui, plotted, [x, y]),
        _ => return,
    };
    // The drawing uses the pointer position of the previous frame, which is the present one while the pointer rests.
    if let Some(point) = clicked(ui, &response, pointed.map(|row| row.point)) {
        cx.push(SweepCommand::Open(point));
    }
    let Some(row) = pointed else { return };
    response.on_hover_cursor(CursorIcon::PointingHand).on_hover_ui_at_pointer(|ui| {
        ui.label(plotted.words(row));
    });
}

/// The point that was clicked. In a chart that was moved or zoomed, a double click resets the view; there a click therefore waits for a
/// second one.
fn clicked(ui: &Ui, response: &Response, pointed: Option<usize>) -> Option<usize> {
    let waiting = Id::unique("the point that was clicked");
    let (now, longest) =
        (ui.input(|input| input.time), ui.options(|options| options.input_options.max_double_click_delay));
    let moved = PlotMemory::load(ui.ctx(), plot::id(NAME)).is_some_and(|memory| !memory.auto_bounds.all());
    let mut waits: Option<(usize, f64)> = ui.data(|data| data.get_temp(waiting)).flatten();
    let mut found = waits.take_if(|(_, since)| now - *since > longest).map(|(point, _)| point);
    if response.double_clicked() {
        waits = None;
    } else if response.clicked() && moved {
        waits = pointed.map(|point| (point, now));
        ui.request_repaint_after_secs(longest as f32);
    } else if response.clicked() {
        found = pointed;
    }
    ui.data_mut(|data| data.insert_temp(waiting, waits));
    found
}

/// Explanation of a varied parameter, shown on hover.
fn about(axis: &Axis) -> String {
    format!("{}\n{}", axis.parameter.about, axis.parameter.key)
}

/// A chart over one parameter, filling `ui`. Returns its response, and the row under the pointer.
fn curve<'a>(ui: &mut Ui, plotted: &Plotted<'a>, axis: &Axis) -> (Response, Option<&'a SweepRow>) {
    let (swept, quantity) = (plotted.swept, plotted.quantity);
    let drawn = once(ui, "curve", (swept.number, swept.rows.len(), quantity), || {
        curve_panel(&swept.sweep, &swept.rows, axis, quantity)
    });
    let mut panel = on_screen_as(&drawn, axis);
    let [from, to] = span(axis.values.iter().copied());
    if let Some(values) = plotted.present.filter(|values| (from..=to).contains(&values[0])) {
        let style = Style::solid(ACCENT).dash(Dash::DashDot);
        panel = panel.layer(Mark { style, ..Mark::vertical(values[0], "present") });
    }
    if axis.words.is_empty() {
        let ends = with_margin(span(axis.values.iter().map(|value| axis.scale.place(*value))), 0.02);
        let [from, to] = ends.map(|place| if axis.scale == Scale::Log { 10f64.powf(place) } else { place });
        panel.x = panel.x.fixed(from, to);
    }
    let [low, high] = span(swept.rows.iter().filter_map(|row| plotted.sound(row)).map(|found| found.value));
    let from_zero = low > 0.0 && low < FROM_ZERO * high || high < 0.0 && high > FROM_ZERO * low;
    // The title names the quantity.
    panel.y = figure::Axis::new("", "").including(from_zero.then_some(0.0));
    // A point without a value is drawn as a cross at the axis.
    let bottom = figure::ends(&panel)[1][0];
    let failed = swept.rows.iter().filter(|row| row.numbers.get(quantity).is_none());
    let failed = failed.map(|row| [row.values[0], bottom]);
    panel = panel.layer(Points::new("", failed, Colour::CONTACT, Marker::solid(Shape::Cross)));

    title(ui, &capitalised(&quantity.label(swept.sweep.problem())), quantity.words());
    legend(ui, &[&panel]);
    let shown = chart(ui, &panel, axis, quantity.words(), |_| ());
    let transform = shown.transform;
    let pointed = shown.response.hover_pos().and_then(|pointer| {
        let shown_at = |row: &SweepRow| {
            let value = row.numbers.get(quantity).unwrap_or(bottom);
            transform.position_from_point(&PlotPoint::new(axis.scale.place(row.values[0]), value))
        };
        let far = |row: &&SweepRow| (shown_at(row).x - pointer.x).abs();
        let row = swept.rows.iter().min_by(|a, b| far(a).total_cmp(&far(b))).filter(|row| far(row) < NEAR)?;
        let painter = ui.painter_at(transform.frame().expand(RING));
        painter.circle_stroke(shown_at(row), RING, Stroke::new(2.0, on_screen(ACCENT, ui.visuals())));
        Some(row)
    });
    (shown.response, pointed)
}

/// A panel as it is exported, with the words of the window and larger marks.
fn on_screen_as(exported: &Panel, x: &Axis) -> Panel {
    let mut panel = exported.clone();
    label(x.parameter).clone_into(&mut panel.x.label);
    for layer in &mut panel.layers {
        if let Layer::Points(points) = layer
            && points.colour != Colour::FILM
        {
            points.marker.size = points.marker.size.max(MARK);
        }
    }
    panel
}

/// Shows `panel` in the remaining area of `ui`, with `x` as the axis below, over what `ground` draws. `word` is the glossary term of the
/// other axis.
fn chart<'p>(
    ui: &mut Ui,
    panel: &'p Panel,
    x: &Axis,
    word: &'p str,
    ground: impl FnOnce(&mut PlotUi<'p>) + 'p,
) -> PlotResponse<Option<f64>> {
    let chart = Chart { name: NAME, height: ui.available_height(), panel, words: (None, word) };
    let shown = chart.show_over(ui, |plot| plot, ground);
    let below = Rect::from_x_y_ranges(
        shown.transform.frame().x_range(),
        shown.transform.frame().bottom()..=ui.min_rect().bottom(),
    );
    glossary::over(ui, below, label(x.parameter), 0).hint(about(x));
    shown
}

/// Positions in ascending order, and the edges of the cells round them.
fn cells(axis: &Axis) -> (Vec<f64>, Vec<f64>) {
    let mut places: Vec<f64> = axis.values.iter().map(|value| axis.scale.place(*value)).collect();
    places.sort_by(f64::total_cmp);
    let mut edges: Vec<f64> = places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    if let ([first, second, ..], [.., before, last]) = (&places[..], &places[..]) {
        edges.insert(0, 1.5 * first - 0.5 * second);
        edges.push(1.5 * last - 0.5 * before);
    }
    (places, edges)
}

/// Drawing data of a sweep over two parameters. Positions and values are on the scales of their axes.
struct MapDrawing {
    panel: Panel,
    /// Least and greatest value.
    extent: [f64; 2],
    /// Whether the colours are logarithmic: if values of many orders of magnitude had linear colours, all except the greatest would look
    /// the same.
    log: bool,
    /// Edges of the cells along x and y, and their values.
    edges: [Vec<f64>; 2],
    values: Vec<f64>,
    lines: Vec<Contour>,
}

impl MapDrawing {
    fn new(plotted: &Plotted<'_>, axes: [&Axis; 2]) -> Self {
        let (swept, quantity) = (plotted.swept, plotted.quantity);
        let panel = map_panel(&swept.sweep, &swept.rows, axes, quantity, figure::Range::Auto);
        let mut values = match panel.layers.first() {
            Some(Layer::Map(map)) => map.grid.values.clone(),
            _ => Vec::new(),
        };
        let extent = span(values.iter().copied());
        // A share lies between 0 and 1.
        let log = extent[0] > 0.0 && extent[1] > MANY_SIZES * extent[0] && !quantity.is_share();
        if log {
            values.iter_mut().for_each(|value| *value = value.log10());
        }
        let [(xs, x_edges), (ys, y_edges)] = axes.map(cells);
        let range = span(values.iter().copied());
        let ticks = Steps::new(range, LEVELS);
        // If contour lines would be closer to each other than the error of the values, there are none.
        let told_apart = log || ticks.step() > typical_error(&swept.rows, quantity);
        let levels = levels(ticks, range, log).filter(|_| told_apart);
        let lines = levels.map(|level| (level, contour(&xs, &ys, &values, level))).collect();
        Self { panel, extent, log, edges: [x_edges, y_edges], values, lines }
    }

    /// The corners of a cell: least x and y, greatest x and y.
    fn cell(&self, i: usize, j: usize) -> [[f64; 2]; 2] {
        [0, 1].map(|end| [self.edges[0][i + end], self.edges[1][j + end]])
    }
}

/// Two parameters: a map that fills `ui`. Returns its response, and the row under the pointer.
fn map<'a>(ui: &mut Ui, plotted: &Plotted<'a>, [x, y]: [&Axis; 2]) -> (Response, Option<&'a SweepRow>) {
    let (swept, quantity) = (plotted.swept, plotted.quantity);
    let key = (swept.number, swept.rows.len(), quantity);
    let drawn = &*once(ui, "map", key, || MapDrawing::new(plotted, [x, y]));
    let style = &PlotStyle::new(ui);
    let title = capitalised(&quantity.label(swept.sweep.problem()));
    let title = if drawn.log { format!("{title}, logarithmic colours") } else { title };
    if drawn.values.iter().any(|value| value.is_finite()) {
        let nothing = if drawn.log { 0.0 } else { NOTHING * (drawn.extent[1] - drawn.extent[0]) };
        let written = |end: f64| if end.abs() < nothing { "0".to_owned() } else { significant(end, 3) };
        let ends = drawn.extent.map(written);
        let (row, _) = ui.allocate_exact_size(vec2(ui.available_width(), style.title), Sense::hover());
        let below = row.translate(vec2(0.0, row.height()));
        style.title_with_ends(below, quantity.words(), &[&title], ends.each_ref().map(String::as_str));
    }
    let up = format!("↑ {}, {}", label(y.parameter), swept.sweep.scene().unit(y.parameter));
    ui.label(up.trim_end_matches(", ")).hint(about(y));
    let here = plotted.present.and_then(|values| <[f64; 2]>::try_from(values).ok());
    let ring = Points::new("present", here, Colour::BLACK, Marker { size: 7.5, ..Marker::hollow(Shape::Circle) });
    let panel = on_screen_as(&drawn.panel, x).layer(ring);
    legend(ui, &[&panel]);
    let small = style.font.clone();
    let shown = chart(ui, &panel, x, "Parameter", |plot| ground(plot, drawn, small));

    let (transform, frame) = (shown.transform, *shown.transform.frame());
    let painter = ui.painter_at(frame);
    let at = |[x, y]: [f64; 2]| transform.position_from_point(&PlotPoint::new(x, y));
    // It has to be visible on any colour.
    for point in &swept.published {
        let at = at([x.scale.place(point.values[0]), y.scale.place(point.values[1])]);
        for (size, width, colour) in [(9.0, 1.8, Color32::BLACK), (12.0, 1.0, Color32::WHITE)] {
            let square = Rect::from_center_size(at, vec2(size, size));
            painter.rect_stroke(square, 0.0, Stroke::new(width, colour), StrokeKind::Middle);
        }
    }
    for at in here.into_iter().map(|[px, py]| at([x.scale.place(px), y.scale.place(py)])) {
        painter.circle_stroke(at, RING, Stroke::new(3.5, Color32::BLACK));
        painter.circle_stroke(at, RING, Stroke::new(1.8, Color32::WHITE));
    }
    let area_of = |row: &SweepRow| {
        let cell = |edges: &[f64], at: f64| edges.partition_point(|edge| *edge < at).clamp(1, edges.len() - 1) - 1;
        let [i, j] = [(0, x), (1, y)].map(|(k, axis)| cell(&drawn.edges[k], axis.scale.place(row.values[k])));
        let [low, high] = drawn.cell(i, j).map(at);
        Rect::from_two_pos(low, high)
    };
    let pointed = shown.response.hover_pos().and_then(|at| swept.rows.iter().find(|row| area_of(row).contains(at)));
    if let Some(row) = pointed {
        painter.rect_stroke(area_of(row), 0.0, Stroke::new(2.0, Color32::WHITE), StrokeKind::Inside);
    }
    style.explain(ui);
    (shown.response, pointed)
}

/// Coloured cells, given by their corners. All are one plot item, because a large map has too many cells for an item each.
struct Cells {
    base: PlotItemBase,
    cells: Vec<([[f64; 2]; 2], Color32)>,
}

impl PlotItem for Cells {
    fn shapes(&self, _: &Ui, transform: &PlotTransform, shapes: &mut Vec<egui::Shape>) {
        let mut mesh = egui::Mesh::default();
        for (corners, colour) in &self.cells {
            let [low, high] = corners.map(|[x, y]| transform.position_from_point(&PlotPoint::new(x, y)));
            mesh.add_colored_rect(Rect::from_two_pos(low, high), *colour);
        }
        shapes.push(egui::Shape::mesh(mesh));
    }

    fn initialize(&mut self, _: RangeInclusive<f64>) {}

    fn color(&self) -> Color32 {
        Color32::TRANSPARENT
    }

    fn geometry(&self) -> PlotGeometry<'_> {
        PlotGeometry::None
    }

    // The axes have ranges of their own.
    fn bounds(&self) -> PlotBounds {
        PlotBounds::NOTHING
    }

    fn base(&self) -> &PlotItemBase {
        &self.base
    }

    fn base_mut(&mut self) -> &mut PlotItemBase {
        &mut self.base
    }
}

/// The cells of a map in their colours, and contour lines, each with its value, in this font.
fn ground(plot: &mut PlotUi<'_>, drawn: &MapDrawing, font: FontId) {
    let [low, high] = span(drawn.values.iter().copied());
    let part = |value: f64| if high > low { (value - low) / (high - low) } else { 0.0 };
    let colour = colour_between([low, high]);
    let rows = drawn.edges[1].len().saturating_sub(1).max(1);
    let known = drawn.values.iter().enumerate().filter(|(_, value)| value.is_finite());
    let cells = known.map(|(k, value)| (drawn.cell(k / rows, k % rows), colour(*value)));
    plot.add(Cells { base: PlotItemBase::new(String::new()), cells: cells.collect() });
    let ticks = Steps::new([low, high], LEVELS);
    let mut written: Vec<Rect> = Vec::new();
    for (level, pieces) in &drawn.lines {
        let shade = if part(*level) > 0.55 { Color32::from_black_alpha(190) } else { Color32::from_white_alpha(190) };
        let text = if drawn.log { short(10f64.powf(level.round()), DIGITS) } else { ticks.format(*level) };
        let size = vec2(0.6 * text.chars().count() as f32 + 0.5, 1.2) * font.size;
        for piece in pieces {
            plot.line(line(piece, shade, 1.2, LineStyle::Solid));
            let places: Vec<Pos2> = piece.iter().map(|[x, y]| plot.screen_from_plot(PlotPoint::new(*x, *y))).collect();
            let length: f32 = places.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            let middle = Rect::from_center_size(places[places.len() / 2], size);
            let free = plot.transform().frame().contains_rect(middle)
                && written.iter().all(|other| !other.intersects(middle.expand(4.0)));
            if free && length > 3.0 * size.x {
                let text = RichText::new(&text).font(font.clone()).background_color(colour(*level));
                let [x, y] = piece[piece.len() / 2];
                plot.text(Text::new("", PlotPoint::new(x, y), text).color(shade.to_opaque()).allow_hover(false));
                written.push(middle);
            }
        }
    }
}

/// The values of contour lines. None is so near to an end of the range that its line would follow the errors.
fn levels(ticks: Steps, range: [f64; 2], log: bool) -> impl Iterator<Item = f64> {
    let fraction = move |level: f64| (level - range[0]) / (range[1] - range[0]);
    let whole = move |level: &f64| !log || (level - level.round()).abs() < 1e-6;
    ticks.values().filter(move |level| is_contour(fraction(*level))).filter(whole)
}

/// A value, and the lines along which the quantity has it.
type Contour = (f64, Vec<Vec<[f64; 2]>>);

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
