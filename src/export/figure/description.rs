//! The description of a figure: plain data that can be stored and compared. Nothing is drawn here.

use super::axis::Axis;
use super::layers::Layer;
use super::provenance::Provenance;

/// A figure: panels in rows and columns, and where its numbers come from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// A line above the panels; may be empty.
    pub title: String,
    /// How wide it is printed.
    pub width: Width,
    /// Number of panels in a row; 0 counts as 1.
    pub columns: usize,
    /// Whether the panels of a column share one x axis, which is labelled below the lowest panel.
    pub share_x: bool,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
    /// Caption of the figure, in sentences: stored in the file as its description, not drawn.
    pub caption: String,
    /// Where the numbers come from: drawn small below the panels, and kept in the file.
    pub provenance: Provenance,
}

impl Figure {
    /// A figure without panels, as wide as a journal column.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Adds a panel.
    #[must_use]
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Sets the caption.
    #[must_use]
    pub fn caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
    }
}

/// Width of a figure on paper.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

    /// In points, 72 to the inch.
    pub fn points(self) -> f64 {
        self.millimetres() * 72.0 / 25.4
    }
}

/// Axes with layers drawn one over the other, the first lowest.
#[derive(Clone, Debug, PartialEq)]
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
    /// Layers of the panel.
    pub layers: Vec<Layer>,
    /// Where the names of the layers stand.
    pub legend: Legend,
}

impl Default for Panel {
    fn default() -> Self {
        Self::new("", Axis::default(), Axis::default())
    }
}

impl Panel {
    /// Empty axes.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), height: 45.0, x, y, right: None, layers: Vec::new(), legend: Legend::Auto }
    }

    /// Adds a layer on top.
    #[must_use]
    pub fn layer(self, layer: impl Into<Layer>) -> Self {
        self.layers([layer])
    }

    /// Adds layers on top.
    #[must_use]
    pub fn layers(mut self, layers: impl IntoIterator<Item: Into<Layer>>) -> Self {
        self.layers.extend(layers.into_iter().map(Into::into));
        self
    }

    /// Sets the height \[mm\].
    #[must_use]
    pub fn height(mut self, millimetres: f64) -> Self {
        self.height = millimetres;
        self
    }

    /// Sets the place of the legend.
    #[must_use]
    pub fn legend(mut self, legend: Legend) -> Self {
        self.legend = legend;
        self
    }
}

/// Where the names of the layers stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Legend {
    /// In the emptiest corner; above the axes if every corner is taken.
    #[default]
    Auto,
    /// In a row above the axes.
    Above,
    /// Nowhere.
    None,
}
