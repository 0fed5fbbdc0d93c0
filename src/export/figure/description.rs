//! What a figure is: plain data that can be kept, compared and sent. Nothing in here draws.

use super::colour::{Colour, Colours};
use crate::export::json::status_name;
use crate::problem::Problem;
use crate::solution::{Outcome, Solution};
use serde::{Deserialize, Serialize};

/// A figure: panels in rows and columns, and where its numbers come from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Figure {
    /// A line above the panels; may be empty.
    pub title: String,
    /// How wide it is printed.
    pub width: Width,
    /// Panels in a row; 0 is 1.
    pub columns: usize,
    /// Panels of a column have one x axis, labelled below the lowest.
    pub share_x: bool,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
    /// What the figure shows, in sentences: kept in the file as its description, not drawn.
    pub caption: String,
    /// Where the numbers come from: drawn small below the panels, and kept in the file.
    pub provenance: Provenance,
}

impl Figure {
    /// A figure of a journal column's width without panels.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// With one more panel.
    #[must_use]
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }
}

/// Width of a figure on paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Width {
    /// One column of a journal: 85 mm.
    #[default]
    Column,
    /// A page of a journal: 175 mm.
    Page,
    /// Any, 30 to 1000 mm.
    Millimetres(f64),
}

impl Width {
    /// In millimetres.
    pub fn millimetres(self) -> f64 {
        match self {
            Self::Column => 85.0,
            Self::Page => 175.0,
            Self::Millimetres(width) if width.is_finite() => width.clamp(30.0, 1000.0),
            Self::Millimetres(_) => 85.0,
        }
    }

    /// In points, of which an inch has 72.
    pub fn points(self) -> f64 {
        self.millimetres() * 72.0 / 25.4
    }
}

/// Where the numbers of a figure come from. What is empty is left out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// The scene's name, or the names of several.
    pub preset: String,
    /// Version of this program.
    pub version: String,
    /// `draft`, `standard`, …, or `paper mesh`.
    pub fidelity: String,
    /// The estimated numerical error, in words with numbers.
    pub error: String,
    /// Anything else: `not converged`, the instant shown.
    pub note: String,
}

impl Provenance {
    /// Of one solve.
    pub fn of(problem: &Problem, solution: &Solution) -> Self {
        use crate::export::digits::with_error;
        let error = match &solution.outcome {
            Outcome::Motor(result) => format!("α = {}", with_error(result.alpha, result.alpha_error)),
            Outcome::Plate(result) => {
                let unit = crate::export::json::force_unit(problem);
                format!("film load {} {unit}", with_error(result.film_load, result.film_load_error))
            }
        };
        let status = status_name(&solution.status);
        Self {
            preset: crate::scene::show_text(&problem.name),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            fidelity: solution.model.fidelity.clone(),
            error,
            note: if status == "converged" { String::new() } else { status.to_uppercase() },
        }
    }

    /// One line for people; empty if nothing is known.
    pub fn line(&self) -> String {
        let program = if self.version.is_empty() { String::new() } else { format!("squeezefilm {}", self.version) };
        let parts = [&self.preset, &self.fidelity, &self.error, &self.note, &program];
        parts.iter().filter(|part| !part.is_empty()).map(|part| part.as_str()).collect::<Vec<_>>().join(" · ")
    }
}

/// Axes with layers drawn one over the other, the first lowest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Panel {
    /// A line above the axes, as in `(a) surfaces`; may be empty.
    pub title: String,
    /// Height of the plotting area \[mm\].
    pub height: f64,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis on the left.
    pub y: Axis,
    /// A second vertical axis on the right, for the layers that ask for it.
    pub right: Option<Axis>,
    /// What is drawn.
    pub layers: Vec<Layer>,
    /// Where the names of the layers stand.
    pub legend: Legend,
}

impl Default for Panel {
    fn default() -> Self {
        Self {
            title: String::new(),
            height: 45.0,
            x: Axis::default(),
            y: Axis::default(),
            right: None,
            layers: Vec::new(),
            legend: Legend::default(),
        }
    }
}

impl Panel {
    /// Empty axes.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, ..Self::default() }
    }

    /// With one more layer on top.
    #[must_use]
    pub fn layer(mut self, layer: impl Into<Layer>) -> Self {
        self.layers.push(layer.into());
        self
    }

    /// With another height \[mm\].
    #[must_use]
    pub fn height(mut self, millimetres: f64) -> Self {
        self.height = millimetres;
        self
    }
}

/// Where the names of the layers stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Legend {
    /// In the emptiest corner; above the axes if every corner is taken.
    #[default]
    Auto,
    /// In a row above the axes.
    Above,
    /// Nowhere.
    None,
}

/// One axis.
///
/// Labels may raise and lower: `m^{2}`, `p_{a}`; raised and lowered characters of Unicode are set alike.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Axis {
    /// The quantity.
    pub label: String,
    /// Its unit; empty for none.
    pub unit: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// What it covers.
    pub range: Range,
    /// Only whole numbers are labelled: rounds, teeth.
    pub whole: bool,
    /// Names at places instead of numbers; empty for numbers.
    pub names: Vec<(f64, String)>,
}

impl Axis {
    /// A linear axis that covers the data.
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), ..Self::default() }
    }

    /// Logarithmic.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.scale = Scale::Log;
        self
    }

    /// Only whole numbers are labelled.
    #[must_use]
    pub fn whole(mut self) -> Self {
        self.whole = true;
        self
    }

    /// From here to there.
    #[must_use]
    pub fn fixed(mut self, from: f64, to: f64) -> Self {
        self.range = Range::Fixed(from, to);
        self
    }

    /// Covers the data and these values.
    #[must_use]
    pub fn including(mut self, values: impl IntoIterator<Item = f64>) -> Self {
        self.range = Range::Including(values.into_iter().collect());
        self
    }
}

/// How values are spread along an axis or over colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// By their logarithm; values that are not positive are left out.
    Log,
}

/// What an axis or a colour bar covers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Range {
    /// The data.
    #[default]
    Auto,
    /// The data and these values.
    Including(Vec<f64>),
    /// From here to there.
    Fixed(f64, f64),
}

/// One thing in a panel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Layer {
    /// A curve.
    Line(Line),
    /// What lies between two curves.
    Band(Band),
    /// Single points, with error bars or without.
    Points(Points),
    /// A straight line across the axes.
    Mark(Mark),
    /// Values over a plane as colours.
    Map(Map),
    /// Lines of equal value over a plane.
    Contours(Contours),
    /// Kinds over a plane.
    Categories(Categories),
    /// Words at a place.
    Text(Text),
}

/// A line with at most this many points has a marker on each.
pub(super) const MARKED: usize = 24;

/// A curve. Points that are not finite, or not positive on a logarithmic axis, interrupt it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Line {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// `[x, y]`.
    pub points: Vec<[f64; 2]>,
    /// How it looks.
    pub style: Style,
    /// Read on the right axis.
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
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Band {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// `[x, low, high]`; what is not finite interrupts it.
    pub points: Vec<[f64; 3]>,
    /// Colour.
    pub colour: Colour,
    /// 0 is invisible, 1 is solid.
    pub opacity: f64,
    /// Read on the right axis.
    pub right: bool,
}

impl Band {
    /// A pale band read on the left axis.
    pub fn new(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 3]>, colour: Colour) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), colour, opacity: 0.25, right: false }
    }
}

/// Single points.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Points {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// `[x, y]`.
    pub points: Vec<[f64; 2]>,
    /// Half the length of each point's error bar along y; shorter than `points`, the rest have none.
    pub errors: Vec<f64>,
    /// Colour.
    pub colour: Colour,
    /// Shape.
    pub marker: Marker,
    /// Read on the right axis.
    pub right: bool,
}

impl Points {
    /// Points without error bars, read on the left axis.
    pub fn new(
        name: impl Into<String>,
        points: impl IntoIterator<Item = [f64; 2]>,
        colour: Colour,
        marker: Marker,
    ) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), colour, marker, ..Self::default() }
    }
}

/// A straight line across the axes, with words at its end.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Mark {
    /// Which way it runs.
    pub direction: Direction,
    /// The x of a vertical, the y of a horizontal one.
    pub at: f64,
    /// Words beside it; may be empty.
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// At one x.
    Vertical,
    /// At one y.
    #[default]
    Horizontal,
}

/// Values at the nodes of a plane, as colours. Where a value is not finite nothing is drawn.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Map {
    /// The quantity, at the colour bar.
    pub label: String,
    /// Its unit; empty for none.
    pub unit: String,
    /// Where the values are.
    pub grid: Grid,
    /// How values become colours.
    pub colours: Colours,
    /// Linear or logarithmic colours.
    pub scale: Scale,
    /// What the colours cover.
    pub range: Range,
    /// Whether colours run from node to node or every node has its cell.
    pub shading: Shading,
}

/// Values at the nodes of a plane; the nodes need not be uniform.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Grid {
    /// Ascending.
    pub x: Vec<f64>,
    /// Ascending.
    pub y: Vec<f64>,
    /// `[ix][iy]`, flat.
    pub values: Vec<f64>,
}

/// How the plane between nodes is filled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shading {
    /// Linear from node to node: fields.
    #[default]
    Smooth,
    /// A cell round every node: sweeps, where every value is a solve.
    Cells,
}

/// Lines of equal value.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Contours {
    /// Where the values are.
    pub grid: Grid,
    /// The values of the lines; empty for up to ten round ones.
    pub levels: Vec<f64>,
    /// Whether each line carries its value.
    pub labels: bool,
    /// Colour; without one, black or white as the map below asks.
    pub colour: Option<Colour>,
    /// Dashes.
    pub dash: Dash,
}

/// Kinds over a plane, each node's cell in the colour of its kind.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Categories {
    /// Ascending.
    pub x: Vec<f64>,
    /// Ascending.
    pub y: Vec<f64>,
    /// `[ix][iy]`, flat: which of `kinds`; beyond them nothing is drawn.
    pub values: Vec<usize>,
    /// Names, in the legend, and colours.
    pub kinds: Vec<(String, Colour)>,
}

/// Words at a place.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Text {
    /// `[x, y]` of the left axis.
    pub at: [f64; 2],
    /// The words.
    pub text: String,
    /// Which part of the words is there.
    pub anchor: Anchor,
    /// Colour.
    pub colour: Colour,
}

impl Text {
    /// Black words that begin at `at`.
    pub fn new(at: [f64; 2], text: impl Into<String>) -> Self {
        Self { at, text: text.into(), ..Self::default() }
    }
}

/// Which part of a text lies at its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Anchor {
    /// Its beginning.
    #[default]
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
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
layer_from!(Line, Band, Points, Mark, Map, Contours, Categories, Text);

/// How a line looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Style {
    /// Colour.
    pub colour: Colour,
    /// Width \[pt\].
    pub width: f64,
    /// Dashes.
    pub dash: Dash,
    /// Markers on the line: on every point of a few, on some of many.
    pub marker: Option<Marker>,
}

impl Default for Style {
    fn default() -> Self {
        Self { colour: Colour::BLACK, width: 1.0, dash: Dash::Solid, marker: None }
    }
}

impl Style {
    /// A solid line of a colour.
    pub fn solid(colour: Colour) -> Self {
        Self { colour, ..Self::default() }
    }

    /// With dashes.
    #[must_use]
    pub fn dash(mut self, dash: Dash) -> Self {
        self.dash = dash;
        self
    }

    /// With markers.
    #[must_use]
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = Some(marker);
        self
    }

    /// A thin grey line for marks.
    pub fn quiet() -> Self {
        Self { colour: Colour::QUIET, width: 0.6, dash: Dash::Solid, marker: None }
    }

    /// The style of curve `index` of several: colour, dashes and marker all differ, so that they can be told apart in grey.
    pub fn nth(index: usize) -> Self {
        let dash = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted];
        let shape = [Shape::Circle, Shape::Square, Shape::Triangle, Shape::Diamond, Shape::Cross];
        let hollow = (index / shape.len()) % 2 == 1;
        let marker = Marker { shape: shape[index % shape.len()], hollow, ..Marker::default() };
        Self {
            colour: Colour::CYCLE[index % Colour::CYCLE.len()],
            width: 1.0,
            dash: dash[index % dash.len()],
            marker: Some(marker),
        }
    }
}

/// Dashes of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Dash {
    /// None.
    #[default]
    Solid,
    /// Long.
    Dashed,
    /// Dots.
    Dotted,
    /// Long and dot in turn.
    DashDot,
}

/// A point's sign.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Marker {
    /// Shape.
    pub shape: Shape,
    /// Only the outline, filled with white.
    pub hollow: bool,
    /// Diameter \[pt\].
    pub size: f64,
}

impl Default for Marker {
    fn default() -> Self {
        Self { shape: Shape::Circle, hollow: false, size: 4.0 }
    }
}

impl Marker {
    /// A filled marker.
    pub fn solid(shape: Shape) -> Self {
        Self { shape, ..Self::default() }
    }

    /// An outline.
    pub fn hollow(shape: Shape) -> Self {
        Self { shape, hollow: true, ..Self::default() }
    }
}

/// Shape of a marker.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A circle.
    #[default]
    Circle,
    /// A square.
    Square,
    /// A triangle on its base.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// Two crossing strokes.
    Cross,
}
