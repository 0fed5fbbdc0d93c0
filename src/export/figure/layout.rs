//! The positions of everything on the paper: plotting areas that are aligned, with room for what is around them.

use super::axis::{Axis, Scale};
use super::description::{Figure, Panel};
use super::layers::{Layer, Shading};
use super::legend;
use super::placed::{
    BAR, Bar, FOOT, GAP, HEAD, LABEL, LEADING, MAJOR, MM, NOTE, Placed, Ruler, TICK, TITLE, fills, first_map, map_range,
};
use super::plane;
use super::scale::{Scaled, Tick, Ticks};
use super::svg::Rect;
use super::text;

/// Margin round the figure.
const MARGIN: f64 = 3.0;
/// Between rows and between columns of panels.
const ROW_GAP: f64 = 9.0;
const COLUMN_GAP: f64 = 11.0;
/// Distance between a map and its vertical colour bar.
const BAR_GAP: f64 = 6.0;
/// Maps lower than this \[pt\] have their colour bar above.
const LOW: f64 = 75.0;
/// Height that a colour bar takes above a map.
const BAR_ABOVE: f64 = 19.0;
/// Least size of a plotting area, even if the panel is too narrow for its labels.
const LEAST: f64 = 24.0;

/// The positions of everything in a figure.
#[derive(Clone, Debug)]
pub(super) struct Layout<'a> {
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) title: Vec<([f64; 2], String)>,
    pub(super) panels: Vec<Placed<'a>>,
    pub(super) foot: Vec<([f64; 2], String)>,
}

impl<'a> Layout<'a> {
    pub(super) fn new(figure: &'a Figure) -> Self {
        let width = figure.width.points();
        let count = figure.panels.len();
        let columns = figure.columns.clamp(1, count.max(1));
        let mut panels: Vec<Placed<'_>> = Vec::with_capacity(count);
        for (index, panel) in figure.panels.iter().enumerate() {
            let shared = |i: usize| i == index || (figure.share_x && i % columns == index % columns);
            let together = (0..count).filter(|i| shared(*i)).map(|i| &figure.panels[i]);
            let lowest = index + columns >= count;
            panels.push(Placed::beside(panel, ranges(panel, together), !figure.share_x || lowest));
        }
        place_columns(&mut panels, columns, width);

        let mut y = MARGIN;
        let title = set(text::wrapped(&figure.title, TITLE, width - 2.0 * MARGIN), TITLE, &mut y);
        if !title.is_empty() {
            y += 5.0;
        }
        for start in (0..count).step_by(columns) {
            let row = &mut panels[start..(start + columns).min(count)];
            let top = y + row.iter().map(Placed::above).fold(0.0, f64::max);
            let mut bottom = top;
            for panel in row {
                panel.lower(y, top);
                bottom = bottom.max(top + panel.rect.height + panel.below());
            }
            y = bottom + ROW_GAP;
        }
        if count > 0 {
            y -= ROW_GAP;
        }
        let foot = text::wrapped(&figure.provenance.line(), FOOT, width - 2.0 * MARGIN);
        if !foot.is_empty() {
            y += 4.0;
        }
        let foot = set(foot, FOOT, &mut y);
        Self { width, height: y + MARGIN, title, panels, foot }
    }
}

/// Lines of text at the left margin, each with its position; `y` is moved to where they end.
fn set(lines: Vec<String>, size: f64, y: &mut f64) -> Vec<([f64; 2], String)> {
    let place = |line| {
        *y += size * LEADING;
        ([MARGIN, *y - 0.25 * size], line)
    };
    lines.into_iter().map(place).collect()
}

/// Ranges of a panel's axes: x, y and right.
type Ranges = (Scaled, Scaled, Option<Scaled>);

/// The ends of the axes of a single panel: x, and the left axis.
#[cfg(feature = "gui")]
pub(crate) fn ends(panel: &Panel) -> [[f64; 2]; 2] {
    let (x, y, _) = ranges(panel, std::iter::once(panel));
    [x, y].map(|range| [range.from, range.to])
}

/// `together` is the panels that share one x axis, including this one.
fn ranges<'a>(panel: &Panel, together: impl Iterator<Item = &'a Panel>) -> Ranges {
    let values = together.flat_map(|other| covered(other, panel.x.scale, 0, false));
    // Curves extend from end to end of the axes; markers keep a distance from them.
    let curve = |layer: &Layer| matches!(layer, Layer::Line(line) if !line.is_marked());
    let margin = !(fills(panel) || panel.layers.iter().any(curve));
    let x = Scaled::new(&panel.x.range, panel.x.scale, values, margin);
    let upright = |axis: &Axis, right: bool| {
        let values = covered(panel, axis.scale, 1, right).into_iter();
        Scaled::new(&axis.range, axis.scale, values, right || !fills(panel))
    };
    (x, upright(&panel.y, false), panel.right.as_ref().map(|axis| upright(axis, true)))
}

/// Values that the layers cover along x (0), or along the left or right vertical axis (1).
fn covered(panel: &Panel, scale: Scale, along: usize, right: bool) -> Vec<f64> {
    let log = scale == Scale::Log;
    let of = |layer: &Layer| match layer {
        Layer::Line(line) if along == 0 || line.right == right => line.points.iter().map(|p| p[along]).collect(),
        _ if right => Vec::new(),
        Layer::Band(band) => band.points.iter().flat_map(|p| [p[along], p[2 * along]]).collect(),
        Layer::Points(points) => {
            let bar = |(i, p): (usize, &[f64; 2])| {
                let error = along as f64 * points.error(i);
                [p[along], p[along] - error, p[along] + error]
            };
            points.points.iter().enumerate().flat_map(bar).collect()
        }
        Layer::Map(map) => plane::ends([&map.grid.x, &map.grid.y][along], map.shading == Shading::Cells, log),
        Layer::Categories(kinds) => plane::ends([&kinds.x, &kinds.y][along], true, log),
        Layer::Line(_) | Layer::Mark(_) | Layer::Text(_) => Vec::new(),
    };
    panel.layers.iter().flat_map(of).collect()
}

fn ticks(axis: &Axis, range: &Scaled, most: usize) -> Ticks {
    if axis.names.is_empty() {
        return Ticks::new(range, most, axis.whole);
    }
    let named = axis.names.iter().filter(|(at, _)| range.holds(*at));
    let ticks = named.map(|(at, name)| Tick { at: *at, label: Some(name.clone()) }).collect();
    Ticks { ticks, power: 0 }
}

/// A vertical axis, with as many ticks as its height has room for. If labels would touch, every other label is left out.
fn upright(axis: &Axis, range: Scaled, height: f64) -> Ruler {
    let mut ticks = ticks(axis, &range, ((height / (2.0 * TICK)) as usize).clamp(2, 7));
    let touch = |ticks: &Ticks| {
        let labelled = ticks.ticks.iter().filter(|tick| tick.label.is_some());
        let places: Vec<f64> = labelled.map(|tick| range.fraction(tick.at) * height).collect();
        places.windows(2).any(|pair| (pair[1] - pair[0]).abs() < LEADING * TICK)
    };
    while touch(&ticks) && leave_out_every_other(&mut ticks) {}
    Ruler::new(axis, range, ticks)
}

/// Width that a vertical axis needs beside the plotting area.
fn room(axis: &Ruler) -> f64 {
    axis.reach() + if axis.label.is_empty() { 0.0 } else { GAP + LABEL * 1.05 }
}

/// Ticks of a horizontal axis whose labels do not touch: at most this many, but at least two. If even their labels would touch, every other
/// one is left out.
fn level_ticks(axis: &Axis, range: &Scaled, width: f64, mut most: usize) -> Ticks {
    loop {
        let mut ticks = ticks(axis, range, most);
        while most <= 2 && touch(&ticks, range, width) && leave_out_every_other(&mut ticks) {}
        if most <= 2 || !touch(&ticks, range, width) {
            return ticks;
        }
        most -= 1;
    }
}

/// Leaves out every other label, if there are more than two.
fn leave_out_every_other(ticks: &mut Ticks) -> bool {
    let labelled: Vec<&mut Tick> = ticks.ticks.iter_mut().filter(|tick| tick.label.is_some()).collect();
    let many = labelled.len() > 2;
    labelled.into_iter().skip(1).step_by(2).filter(|_| many).for_each(|tick| tick.label = None);
    many
}

fn touch(ticks: &Ticks, range: &Scaled, width: f64) -> bool {
    let mut end = f64::NEG_INFINITY;
    for tick in &ticks.ticks {
        let Some(label) = &tick.label else { continue };
        let (at, half) = (range.fraction(tick.at) * width, 0.5 * text::width(label, TICK));
        if at - half < end {
            return true;
        }
        end = at + half + 4.0;
    }
    false
}

impl<'a> Placed<'a> {
    /// The part of the layout that does not depend on the width: ranges, and what is beside the axes.
    fn beside(panel: &'a Panel, (x, y, right): Ranges, x_labels: bool) -> Self {
        let height = if panel.height.is_finite() { panel.height.clamp(5.0, 1000.0) } else { 45.0 } * MM;
        let bar = first_map(panel).map(|map| {
            // The ticks of a horizontal axis depend on its width.
            let (axis, range) = (Axis::new(&map.label, &map.unit), map_range(map));
            Bar { rect: Rect::default(), upright: height >= LOW, ruler: upright(&axis, range, height) }
        });
        let rect = Rect { height, ..Rect::default() };
        let (x, y) = (Ruler::new(&panel.x, x, Ticks::default()), upright(&panel.y, y, height));
        Self {
            right: panel.right.as_ref().zip(right).map(|(axis, range)| upright(axis, range, height)),
            x_labels,
            bar,
            ..Self::new(panel, rect, x, y)
        }
    }

    /// Width needed at the right of the plotting area, for the axis and the colour bar.
    fn right_side(&self) -> f64 {
        let axis = self.right.as_ref().map_or(0.0, room);
        let bar = self.bar.as_ref().filter(|bar| bar.upright).map_or(0.0, |bar| BAR_GAP + BAR + room(&bar.ruler));
        // Half of the last label of the x axis.
        (axis + bar).max(7.0)
    }

    /// Height needed above the plotting area, for title, legend and colour bar.
    fn above(&self) -> f64 {
        let text = legend::height(self);
        let bar = if self.bar.as_ref().is_some_and(|bar| !bar.upright) { BAR_ABOVE } else { 0.0 };
        let title = if self.panel.title.trim().is_empty() { 0.0 } else { HEAD * LEADING + 2.0 };
        // A title and a colour bar are on one line if there is room for both.
        let stacked = text::width(&self.panel.title, HEAD) + 8.0 + self.bar_above() > self.rect.width;
        text + if bar == 0.0 || stacked { bar + title } else { bar.max(title) }.max(0.5 * TICK)
    }

    /// Width of a colour bar above the axes, its label included.
    fn bar_above(&self) -> f64 {
        self.bar.as_ref().map_or(0.0, |bar| level_bar(&self.rect) + 5.0 + text::width(&bar.ruler.label, NOTE))
    }

    /// Height needed below the plotting area: ticks, their labels and the axis label.
    fn below(&self) -> f64 {
        if !self.x_labels {
            return MAJOR;
        }
        MAJOR + GAP + TICK + if self.x.label.is_empty() { 0.0 } else { GAP + LABEL * 1.15 }
    }

    /// Sets the top of the plotting area, and places what is above it; titles of a row are at the same height, at its top.
    fn lower(&mut self, row: f64, top: f64) {
        self.rect.y = top;
        let rect = self.rect;
        let legend = legend::height(self);
        self.title = [rect.x, row + HEAD];
        legend::place(self);
        if let Some(bar) = &mut self.bar {
            bar.rect = if bar.upright {
                Rect { x: rect.right() + BAR_GAP, y: rect.y, width: BAR, height: rect.height }
            } else {
                let width = level_bar(&rect);
                Rect { x: rect.right() - width, y: top - BAR_ABOVE - legend + 1.0, width, height: 4.5 }
            };
        }
    }
}

/// Width of a colour bar above the axes.
fn level_bar(rect: &Rect) -> f64 {
    (0.42 * rect.width).clamp(0.0, 150.0)
}

/// Sets the left edge and width of every panel; the plotting areas of a column have the same.
fn place_columns(panels: &mut [Placed<'_>], columns: usize, width: f64) {
    let sides: Vec<[f64; 2]> = (0..columns)
        .map(|column| {
            let of_column = || panels.iter().skip(column).step_by(columns);
            let left = of_column().map(|placed| room(&placed.y)).fold(0.0, f64::max);
            let right = of_column().map(Placed::right_side).fold(0.0, f64::max);
            [left, right]
        })
        .collect();
    let taken: f64 = sides.iter().flatten().sum::<f64>() + 2.0 * MARGIN + COLUMN_GAP * (columns - 1) as f64;
    let plot = ((width - taken) / columns as f64).max(LEAST);
    let mut x = MARGIN;
    for (column, [left, right]) in sides.iter().enumerate() {
        for placed in panels.iter_mut().skip(column).step_by(columns) {
            placed.rect.width = plot;
            let (axis, range) = (&placed.panel.x, placed.x.range);
            placed.x = Ruler::new(axis, range, level_ticks(axis, &range, plot, ((plot / 26.0) as usize).clamp(2, 9)));
            let width = level_bar(&placed.rect);
            if let (Some(bar), Some(map)) = (placed.bar.as_mut().filter(|bar| !bar.upright), first_map(placed.panel)) {
                let (axis, range) = (Axis::new(&map.label, &map.unit), bar.ruler.range);
                bar.ruler = Ruler::new(&axis, range, level_ticks(&axis, &range, width, 4));
            }
            legend::choose(placed);
            placed.rect.x = x + left;
        }
        x += left + plot + right + COLUMN_GAP;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_a_low_map_and_of_its_colour_bar_do_not_touch() {
        use crate::export::figure::{Grid, Map, Width};
        for width in [60.0, 85.0, 170.0] {
            for (height, end) in [(5.0, 0.15), (7.0, 0.15), (11.0, 0.3), (20.0, 123.0)] {
                let grid = Grid { x: vec![0.0, 1.0], y: vec![-end, end], values: vec![-1.0, 1.0, 0.5, -0.5] };
                let map = Map { label: "correlation".to_owned(), grid, ..Map::default() };
                let panel = Panel::new("", Axis::new("x", ""), Axis::new("y", "mm")).height(height).layer(map);
                let figure = Figure { width: Width::Millimetres(width), ..Figure::new("").panel(panel) };
                let placed = &Layout::new(&figure).panels[0];
                let bar = placed.bar.as_ref().unwrap();
                assert!(!touch(&bar.ruler.ticks, &bar.ruler.range, bar.rect.width), "{width} {height}: {bar:?}");
                let labelled = placed.y.ticks.ticks.iter().filter(|tick| tick.label.is_some());
                let at: Vec<f64> = labelled.map(|tick| placed.y.range.fraction(tick.at) * placed.rect.height).collect();
                assert!(at.len() >= 2 && at.windows(2).all(|pair| pair[1] - pair[0] >= TICK), "{height}: {at:?}");
            }
        }
    }

    #[test]
    fn a_legend_that_would_fill_the_axes_is_above_them() {
        use crate::export::figure::{Line, Style, Width};
        let with = |names: &[&str], height| {
            let line = |name: &&str| Line::new(*name, [[0.0, 0.0], [1.0, 0.1]], Style::unmarked(0));
            let axis = || Axis::new("x", "").fixed(0.0, 1.0);
            let panel = names.iter().fold(Panel::new("", axis(), axis()), |panel, name| panel.layer(line(name)));
            let figure = Figure { width: Width::Millimetres(60.0), ..Figure::new("").panel(panel.height(height)) };
            Layout::new(&figure).panels[0].legend_box.is_some()
        };
        assert!(with(&["film", "contact"], 45.0));
        assert!(!with(&[&"wide ".repeat(12)], 45.0));
        assert!(!with(&["1", "2", "3", "4", "5", "6", "7", "8"], 20.0));
        assert!(!with(&[&"w".repeat(14), "2", "3", "4", "5", "6", "7", "8"], 45.0));
    }

    #[test]
    fn long_titles_and_feet_keep_the_margins() {
        for words in 60..90 {
            let mut figure = Figure::new("il ".repeat(words));
            figure.provenance.note = "lli ".repeat(words);
            let Layout { width, title, foot, .. } = Layout::new(&figure);
            assert!(title.len() > 1 && foot.len() > 1);
            for (size, lines) in [(TITLE, title), (FOOT, foot)] {
                for ([x, _], line) in lines {
                    assert!(x >= MARGIN && x + text::width(&line, size) <= width - MARGIN, "{words}: {line}");
                }
            }
        }
    }
}
