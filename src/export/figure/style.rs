//! The style of lines and points.

use super::colour::Colour;

/// The style of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Colour.
    pub colour: Colour,
    /// Width \[pt\].
    pub width: f64,
    /// Dashes.
    pub dash: Dash,
    /// Markers on the line: on every point if there are few, on some if there are many.
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

    /// Sets the width \[pt\].
    #[must_use]
    pub fn width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Sets the dashes.
    #[must_use]
    pub fn dash(mut self, dash: Dash) -> Self {
        self.dash = dash;
        self
    }

    /// A thin grey line for marks.
    pub fn quiet() -> Self {
        Self::solid(Colour::QUIET).width(0.6)
    }

    /// The style of curve `index` of several. Colour, dashes and marker all differ, so that the curves can be distinguished in grey print.
    pub fn nth(index: usize) -> Self {
        let shape = [Shape::Circle, Shape::Square, Shape::Triangle, Shape::Diamond, Shape::Cross];
        let hollow = (index / shape.len()) % 2 == 1;
        let marker = Marker { hollow, ..Marker::solid(shape[index % shape.len()]) };
        Self { marker: Some(marker), ..Self::unmarked(index) }
    }

    /// As [`Self::nth`], without markers, for curves with many points.
    pub fn unmarked(index: usize) -> Self {
        let dash = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted];
        Self::solid(Colour::CYCLE[index % Colour::CYCLE.len()]).dash(dash[index % dash.len()])
    }
}

/// Dashes of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dash {
    /// A solid line.
    #[default]
    Solid,
    /// Long dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Long dashes and dots in turn.
    DashDot,
}

/// A marker on a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    /// Shape.
    pub shape: Shape,
    /// Whether only the outline is drawn, filled with white.
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
