//! Axes: what they show, and over which range.

pub use crate::scene::Scale;

/// One axis.
///
/// Labels may contain raised and lowered text: `m^{2}`, `p_{a}`; the raised and lowered characters of Unicode look the same.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// The quantity.
    pub label: String,
    /// Its unit; empty for none.
    pub unit: String,
    /// Linear, or logarithmic: values that are not positive are then left out.
    pub scale: Scale,
    /// Range that it covers.
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

    /// Sets labels only at whole numbers.
    #[must_use]
    pub fn whole(mut self) -> Self {
        self.whole = true;
        self
    }

    /// Sets the range from the first number to the second.
    #[must_use]
    pub fn fixed(mut self, from: f64, to: f64) -> Self {
        self.range = Range::Fixed(from, to);
        self
    }

    /// Extends the range of the data to these values.
    #[must_use]
    pub fn including(mut self, values: impl IntoIterator<Item = f64>) -> Self {
        self.range = Range::Including(values.into_iter().collect());
        self
    }
}

/// Least and greatest of the values, without NaN; for none, infinity and minus infinity.
pub(in crate::export) fn extent(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    values.into_iter().fold(ends, |[low, high], value| [low.min(value), high.max(value)])
}

/// Range of an axis or a colour bar.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Range {
    /// From the least to the greatest value of the data.
    #[default]
    Auto,
    /// Likewise, of the data and these values.
    Including(Vec<f64>),
    /// From the first number to the second.
    Fixed(f64, f64),
}
