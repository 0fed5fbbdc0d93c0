//! The layers of a panel: curves, areas, points, fields, text.

use super::axis::Range;
use super::colour::{Colour, Colours};
use super::style::{Marker, Style};

/// One thing in a panel.
#[derive(Clone, Debug, PartialEq)]
pub enum Layer {
    /// A curve.
    Line(Line),
    /// The area between two curves.
    Band(Band),
    /// Single points, with error bars or without.
    Points(Points),
    /// A straight line across the axes.
    Mark(Mark),
    /// Values over a plane as colours.
    Map(Map),
    /// Categories over a plane as colours.
    Categories(Categories),
    /// A text that names a place.
    Text(Text),
}

/// A line with at most this many points has a marker on each of them.
pub(super) const MARKED: usize = 24;

/// A curve. Points that are not finite, or not positive on a logarithmic axis, interrupt it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// `[x, y]` of each point.
    pub points: Vec<[f64; 2]>,
    /// How it looks.
    pub style: Style,
    /// Whether it is read on the right axis.
    pub right: bool,
}

impl Line {
    /// A curve read on the left axis.
    pub fn new(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>, style: Style) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), style, right: false }
    }

    /// Whether every point has a marker.
    pub(super) fn is_marked(&self) -> bool {
        self.style.marker.is_some() && self.points.len() <= MARKED
    }
}

/// The area between two curves of the same x: an error band, or a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Band {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// `[x, low, high]`; what is not finite interrupts it.
    pub points: Vec<[f64; 3]>,
    /// Colour.
    pub colour: Colour,
    /// Opacity: 0 is invisible, 1 is solid.
    pub opacity: f64,
}

impl Band {
    /// A pale band.
    pub fn new(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 3]>, colour: Colour) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), colour, opacity: 0.25 }
    }
}

/// Single points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// `[x, y]`.
    pub points: Vec<[f64; 2]>,
    /// Half the length of each point's error bar along y; if there are fewer than points, the rest have none.
    pub errors: Vec<f64>,
    /// Colour.
    pub colour: Colour,
    /// Shape.
    pub marker: Marker,
}

impl Points {
    /// Points without error bars.
    pub fn new(
        name: impl Into<String>,
        points: impl IntoIterator<Item = [f64; 2]>,
        colour: Colour,
        marker: Marker,
    ) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), colour, marker, ..Self::default() }
    }

    /// Half the length of the error bar of a point; 0 if it has none.
    pub(super) fn error(&self, point: usize) -> f64 {
        self.errors.get(point).copied().filter(|error| error.is_finite()).unwrap_or(0.0).abs()
    }
}

/// A straight line across the axes, with a text at its end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mark {
    /// Which way it runs.
    pub direction: Direction,
    /// The x of a vertical line, or the y of a horizontal one.
    pub at: f64,
    /// The text beside it; may be empty.
    pub label: String,
    /// How it looks.
    pub style: Style,
}

impl Mark {
    /// A thin grey line at `x`.
    pub fn vertical(x: f64, label: impl Into<String>) -> Self {
        Self { direction: Direction::Vertical, at: x, label: label.into(), style: Style::quiet() }
    }

    /// A thin grey line at `y`.
    pub fn horizontal(y: f64, label: impl Into<String>) -> Self {
        Self { direction: Direction::Horizontal, at: y, label: label.into(), style: Style::quiet() }
    }
}

/// Which way a [`Mark`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// At one x.
    Vertical,
    /// At one y.
    #[default]
    Horizontal,
}

/// Values at the nodes of a plane, as colours. Nothing is drawn where a value is not finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Map {
    /// The quantity, written at the colour bar.
    pub label: String,
    /// Its unit; empty for none.
    pub unit: String,
    /// Where the values are.
    pub grid: Grid,
    /// How values become colours.
    pub colours: Colours,
    /// Range of values that the colours cover.
    pub range: Range,
    /// Whether colours are interpolated between nodes or each node has a cell.
    pub shading: Shading,
    /// Draws up to ten labelled contours at round values, black or white depending on the colours. The number is a typical error of the
    /// values: if round values would be closer to each other than the error, there are no contours. `None`: no contours.
    pub contours: Option<f64>,
}

/// Values at the nodes of a plane; the nodes need not be uniform.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Ascending.
    pub x: Vec<f64>,
    /// Ascending.
    pub y: Vec<f64>,
    /// Values at `[ix][iy]`, as a flat array.
    pub values: Vec<f64>,
}

/// How the plane between nodes is filled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// Interpolated linearly between nodes, for fields.
    #[default]
    Smooth,
    /// A cell round every node: sweeps, where every value is a solve.
    Cells,
}

/// Categories over a plane: the cell of each node has the colour of its category.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Categories {
    /// Ascending.
    pub x: Vec<f64>,
    /// Ascending.
    pub y: Vec<f64>,
    /// Indices into `kinds` at `[ix][iy]`, as a flat array; nothing is drawn for an index beyond them.
    pub values: Vec<usize>,
    /// Names, shown in the legend, and colours.
    pub kinds: Vec<(String, Colour)>,
}

/// A text that names a place, written beside it: on the first side where nothing else is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Text {
    /// `[x, y]` of the left axis.
    pub at: [f64; 2],
    /// The text.
    pub text: String,
}

impl Text {
    /// A text beside a place.
    pub fn new(at: [f64; 2], text: impl Into<String>) -> Self {
        Self { at, text: text.into() }
    }
}

macro_rules! layer_from {
    ($($kind:ident),*) => {
        $(impl From<$kind> for Layer {
            fn from(layer: $kind) -> Self {
                Self::$kind(layer)
            }
        })*
    };
}
layer_from!(Line, Band, Points, Mark, Map, Categories, Text);
