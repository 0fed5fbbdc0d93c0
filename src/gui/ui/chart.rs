//! Charts of the tabs: a panel as in exported figures, with its axes, names and legend.

use super::glossary::{self, Explained};
use super::hint::{Hint, text_width};
use super::plot::{between, dots, framed, level, line, marks, numbered, stroked, tick, upright};
use super::theme::on_screen;
use crate::digits::{power_of_ten, raised, short};
use crate::export::figure::{self, Axis, Colour, Dash, Direction, Layer, Mark, Panel, Scale, Shape, ends};
use crate::ticks::{Steps, decades};
use eframe::egui::{self, Color32, Rect, RichText, Stroke, TextStyle, Visuals, vec2};
use egui_plot::{
    AxisHints, GridInput, GridMark, HoverPosition, LineStyle, MarkerShape, Plot, PlotResponse, PlotTransform, PlotUi,
};

/// Width of the column of numbers at the left of a chart, in heights of the text. All charts have the same, so that charts below each other
/// are aligned.
const NUMBERS: f32 = 3.6;
/// Least distance between numbers at the left axis, in heights of the text.
const NUMBER_EVERY: f32 = 2.6;
/// Least distance between numbers at the axis below, in heights of the text.
const COLUMN_EVERY: f32 = 4.5;
/// Share of an axis within which a zero counts as in the corner.
const CORNER: f64 = 0.02;
/// Width of a line of a tab.
const WIDTH: f32 = 2.0;
/// Significant digits of a value on a logarithmic axis, or under the pointer.
const DIGITS: usize = 4;
/// Values on a logarithmic axis up to this many decades from 1 are written without a power of ten.
const PLAIN_DECADES: f64 = 3.5;
/// Pixels on screen for one point of a figure.
const POINT: f32 = 1.8;
/// Length of a sample of a line in a legend, in heights of the text.
const SAMPLE: f32 = 1.5;

/// A chart over the whole width of a tab: a panel as in exported figures, in the colours of the window. Its axes are explained on hover,
/// and points that have a name show their values on hover.
pub(super) struct Chart<'n> {
    /// Unique name, also read by screen readers.
    pub(super) name: &'n str,
    /// Its height, with the axis below.
    pub(super) height: f32,
    /// Axes, and all layers except maps. The axes have the ranges of the panel until they are zoomed.
    pub(super) panel: &'n Panel,
    /// Glossary terms of the axis below, if it has one, and of the axis at the left.
    pub(super) words: (Option<&'n str>, &'n str),
}

impl<'n> Chart<'n> {
    pub(super) fn show(self, ui: &mut egui::Ui) {
        self.show_with(ui, |plot| plot);
    }

    /// As [`Self::show`], with changes to the plot. Returns the x under the pointer.
    pub(super) fn show_with(self, ui: &mut egui::Ui, change: impl FnOnce(Plot<'n>) -> Plot<'n>) -> Option<f64> {
        self.show_over(ui, change, |_| ()).inner
    }

    /// As [`Self::show_with`], over a background that `ground` draws.
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
        // If both axes have a zero in the corner, one of the two is enough.
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
                if zeros && mark.value == 0.0 && above < CORNER {
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
        });
        let frame = *shown.transform.frame();
        let below = Rect::from_x_y_ranges(frame.x_range(), frame.bottom()..=whole.bottom());
        let left = Rect::from_x_y_ranges(whole.left()..=frame.left(), frame.y_range());
        for (axis, rect, word) in [("x", below, words.0), ("y", left, Some(words.1))] {
            if let Some(word) = word {
                glossary::over(ui, rect, word, (name, axis)).explained_here(ui, word);
            }
        }
        names(ui, panel, &shown.transform);
        shown
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
        Scale::Log => log_marks([from, to], most),
        Scale::Linear if least.is_finite() && least > 0.0 => {
            let found = marks(Steps::apart([from, to], least));
            // One number beside the corner, where zero may be left out, does not show a scale.
            let corner = from + CORNER * (to - from);
            let alone = !axis.whole && found.iter().filter(|mark| mark.value > corner).count() < 2;
            if alone { marks(Steps::several([from, to], corner, most.max(2.0) as usize, 2.0 * most)) } else { found }
        }
        Scale::Linear => Vec::new(),
    }
}

/// Text of a value: as a mark of an axis with steps of this size, or with all its digits if that is 0.
fn written(axis: &Axis, value: f64, step_size: f64) -> String {
    let name = axis.names.iter().find(|(at, _)| *at == value);
    match (name, axis.scale) {
        (Some((_, name)), _) => name.clone(),
        (None, Scale::Log) if value.abs() > PLAIN_DECADES && value.fract() == 0.0 => power_of_ten(value),
        (None, Scale::Log) => raised(&short(10f64.powf(value), DIGITS)),
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
            let dots = dots(name, points, colour(*of), 0.5 * POINT * marker.size as f32);
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

/// Curves and areas are interrupted where a value is not a number on its axis.
fn pieces<const N: usize>(points: impl Iterator<Item = [f64; N]>) -> Vec<Vec<[f64; N]>> {
    let points: Vec<[f64; N]> = points.collect();
    let pieces = points.split(|point| !point.iter().all(|part| part.is_finite()));
    pieces.filter(|piece| !piece.is_empty()).map(<[_]>::to_vec).collect()
}

/// Draws the names of points at the places where exported figures have them.
fn names(ui: &egui::Ui, panel: &Panel, at: &PlotTransform) {
    let (frame, bounds, colour) = (*at.frame(), at.bounds(), ui.visuals().text_color());
    let painter = ui.painter_at(frame);
    let galley = |text: &str| painter.layout_no_wrap(text.to_owned(), TextStyle::Body.resolve(ui.style()), colour);
    let points = |size: egui::Vec2| [size.x / POINT, size.y / POINT].map(f64::from);
    let (low, high) = (bounds.min(), bounds.max());
    let value = |scale: Scale, place: f64| if scale == Scale::Log { 10f64.powf(place) } else { place };
    let ends = [
        [low[0], high[0]].map(|end| value(panel.x.scale, end)),
        [low[1], high[1]].map(|end| value(panel.y.scale, end)),
    ];
    let place = |[x, y]: [f64; 2]| frame.min + POINT * vec2(x as f32, y as f32);
    let thin = Stroke::new(1.0, ui.visuals().weak_text_color());
    for (name, corner, leader) in figure::names(panel, ends, points(frame.size()), |text| points(galley(text).size())) {
        if let Some(leader) = leader {
            painter.line_segment(leader.map(place), thin);
        }
        painter.galley(place(corner), galley(&name), colour);
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

/// A title above a chart, with its unit; the glossary explains it under `word`.
pub(super) fn title(ui: &mut egui::Ui, text: &str, word: &str) {
    ui.add(egui::Label::new(RichText::new(text).strong()).wrap()).explained_here(ui, word);
}

/// A legend: the name of each layer of the panels, once, with its glossary term.
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
    let (font, text) = (TextStyle::Body.resolve(ui.style()), ui.visuals().text_color());
    ui.horizontal_wrapped(|ui| {
        for (name, colour, layer) in entries {
            let galley = ui.painter().layout_no_wrap(name.to_owned(), font.clone(), text);
            let em = galley.size().y;
            let indent = (SAMPLE + 0.35) * em;
            // An entry is not broken between lines.
            let size = vec2(indent + galley.size().x + 0.5 * em, em);
            let (area, response) = ui.allocate_exact_size(size, egui::Sense::hover());
            response.called(egui::Role::Label, name).explained_here(ui, name);
            let (painter, left) = (ui.painter(), area.left_center());
            let colour = on_screen(colour, ui.visuals());
            match layer {
                Layer::Line(figure::Line { style, .. }) | Layer::Mark(Mark { style, .. }) => {
                    let ends = [left, left + vec2(SAMPLE * em, 0.0)];
                    // A solid line is drawn as one dash.
                    let dash = match dashes(style.dash) {
                        LineStyle::Solid => LineStyle::Dashed { length: 1e6 },
                        dash => dash,
                    };
                    painter.extend(stroked(&ends, Stroke::new(2.0, colour), dash));
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
            }
            painter.galley(area.left_top() + vec2(indent, 0.0), galley, text);
        }
    });
}

/// Marks of an axis of log₁₀ at round numbers, about `most`. If there are few powers of ten, they have equal steps where the logarithm has
/// such numbers.
fn log_marks(range: [f64; 2], most: f64) -> Vec<GridMark> {
    let found: Vec<f64> = match decades(range, most as usize) {
        Some(numbers) => {
            numbers.into_iter().filter(|number| number.major).map(|number| number.value().log10()).collect()
        }
        None => {
            let steps = Steps::new(range.map(|end| 10f64.powf(end)), most as usize);
            steps.values().filter(|value| *value > 0.0).map(f64::log10).collect()
        }
    };
    // The step of a mark is the free space beside it.
    let gap = |pair: &[f64]| (pair[1] - pair[0]).abs();
    let free = |i: usize| found[i.saturating_sub(1)..(i + 2).min(found.len())].windows(2).map(gap).fold(1.0, f64::min);
    found.iter().enumerate().map(|(i, value)| GridMark { value: *value, step_size: free(i) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Progress;
    use crate::export::figures::convergence;

    /// The numbers at an axis with these bounds, about `most`.
    fn texts(axis: &Axis, bounds: [f64; 2], most: f64) -> Vec<String> {
        let [from, to] = bounds.map(|end| axis.scale.place(end));
        let input = GridInput { bounds: (from, to), base_step_size: 1.0 };
        axis_marks(axis, &input, most).into_iter().map(|mark| written(axis, mark.value, mark.step_size)).collect()
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
    fn names_of_close_points_are_beside_them_and_clear_of_each_other_and_of_lines() {
        let named = [([1.0, 1.0], "draft"), ([1.05, 1.02], "accuracy 1%"), ([1.1, 0.98], "standard")];
        let panel = Panel::new("", Axis::default(), Axis::default())
            .layer(figure::Line::new("", [[0.0, 1.0], [2.0, 1.0]], figure::Style::quiet()))
            .layer(figure::Points::new("", named.map(|(at, _)| at), Colour::FILM, figure::Marker::default()))
            .layers(named.map(|(at, name)| figure::Text::new(at, name)));
        let size = |text: &str| [4.0 * text.len() as f64, 7.5];
        let names = figure::names(&panel, [[0.0, 2.0]; 2], [300.0, 150.0], size);
        let rect = |(name, [x, y], _): &(String, [f64; 2], Option<[[f64; 2]; 2]>)| {
            let [width, height] = size(name).map(|length| length as f32);
            Rect::from_min_size(egui::pos2(*x as f32, *y as f32), vec2(width, height))
        };
        let rects: Vec<Rect> = names.iter().map(rect).collect();
        assert_eq!(rects.len(), 3);
        for (i, (rect, ([x, y], _))) in rects.iter().zip(named).enumerate() {
            assert!(rect.top() > 75.0 || rect.bottom() < 75.0, "{names:?}");
            assert!(rects[..i].iter().all(|other| !other.intersects(*rect)), "{names:?}");
            let point = egui::pos2(150.0 * x as f32, 150.0 - 75.0 * y as f32);
            assert!(rect.distance_to_pos(point) < 25.0, "{names:?}");
            // A name that is farther from its point than the others has a line to it.
            assert_eq!(names[i].2.is_some(), rect.distance_to_pos(point) > 8.0, "{names:?}");
        }
    }

    #[test]
    fn marks_of_equal_ratios_are_round_whatever_the_range() {
        let log = Axis::default().log();
        assert_eq!(texts(&log, [50.0, 800.0], 8.0), ["50", "100", "200", "500"]);
        assert_eq!(texts(&log, [0.01, 1000.0], 8.0), ["0.01", "0.1", "1", "10", "100", "1000"]);
        assert!(texts(&log, [100.0, 130.0], 8.0).len() >= 3);
        assert_eq!(texts(&Axis::default(), [0.0, 1.0], 8.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    }

    #[test]
    fn ticks_are_round_inside_and_few() {
        let linear = |bounds: [f64; 2], most: f64| texts(&Axis::default(), bounds, most);
        assert_eq!(linear([0.0, 104.0], 4.0), ["0", "50", "100"]);
        assert_eq!(linear([-30.0, 150.0], 5.0), ["0", "50", "100", "150"]);
        assert_eq!(linear([-0.5, 1.6], 5.0), ["−0.5", "0.0", "0.5", "1.0", "1.5"]);
        for bounds in [[0.0, 0.0], [f64::NEG_INFINITY, f64::INFINITY]] {
            assert!(linear(bounds, 4.0).is_empty());
        }
    }
}
