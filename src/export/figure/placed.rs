//! A panel's position on the paper, with its legend and colour bar, and the sizes that the layout and the drawing share.

use super::axis::{Axis, Scale};
use super::colour::Colour;
use super::description::Panel;
use super::layers::{Direction, Layer, Map, Mark};
use super::scale::{Scaled, Ticks};
use super::style::{Marker, Style};
use super::svg::Rect;
use super::text;
use crate::digits::power_of_ten;

/// Points per millimetre.
pub(super) const MM: f64 = 72.0 / 25.4;
/// Sizes of type \[pt\].
pub(super) const TITLE: f64 = 9.5;
pub(super) const HEAD: f64 = 8.5;
pub(super) const LABEL: f64 = 8.5;
pub(super) const TICK: f64 = 8.0;
pub(super) const NOTE: f64 = 7.5;
pub(super) const FOOT: f64 = 6.0;
/// Height of a line, relative to the size of its type.
pub(super) const LEADING: f64 = 1.25;
/// Lengths of a major and of a minor tick.
pub(super) const MAJOR: f64 = 2.8;
pub(super) const MINOR: f64 = 1.6;
/// Gap between a tick and its label.
pub(super) const GAP: f64 = 2.2;
/// Width of an upright colour bar.
pub(super) const BAR: f64 = 7.0;
/// Length of the sample of a line.
const SAMPLE: f64 = 17.0;
/// Distance between a sample and its name.
pub(super) const SPACE: f64 = 3.5;

/// The scale along an axis or a colour bar: range, ticks and label.
#[derive(Clone, Debug, Default)]
pub(super) struct Ruler {
    pub(super) range: Scaled,
    pub(super) ticks: Ticks,
    /// The quantity and its unit.
    pub(super) label: String,
}

impl Ruler {
    pub(super) fn new(axis: &Axis, range: Scaled, ticks: Ticks) -> Self {
        Self { range, label: axis_label(&axis.label, &axis.unit, ticks.power), ticks }
    }

    /// Distance that ticks and their labels extend beside a vertical axis; the quantity is written beyond them.
    pub(super) fn reach(&self) -> f64 {
        let labels = self.ticks.ticks.iter().filter_map(|tick| tick.label.as_deref());
        MAJOR + GAP + labels.map(|label| text::width(label, TICK)).fold(0.0, f64::max)
    }
}

/// The position of a colour bar.
#[derive(Clone, Debug)]
pub(super) struct Bar {
    pub(super) rect: Rect,
    pub(super) upright: bool,
    pub(super) ruler: Ruler,
}

/// A panel at its place.
#[derive(Clone, Debug)]
pub(super) struct Placed<'a> {
    pub(super) panel: &'a Panel,
    pub(super) rect: Rect,
    pub(super) x: Ruler,
    pub(super) y: Ruler,
    pub(super) right: Option<Ruler>,
    /// Whether there are labels below the x axis.
    pub(super) x_labels: bool,
    pub(super) bar: Option<Bar>,
    pub(super) legend: Vec<(Entry, [f64; 2])>,
    /// The box of a legend inside the axes.
    pub(super) legend_box: Option<Rect>,
    pub(super) title: [f64; 2],
}

impl<'a> Placed<'a> {
    /// A panel whose plotting area and axes have this place, without anything round them.
    pub(super) fn new(panel: &'a Panel, rect: Rect, x: Ruler, y: Ruler) -> Self {
        let (legend, title) = (Vec::new(), [0.0; 2]);
        Self { panel, rect, x, y, right: None, x_labels: false, bar: None, legend, legend_box: None, title }
    }

    /// The left vertical axis, or the right one if `right` and there is one.
    fn upright(&self, right: bool) -> &Scaled {
        &self.right.as_ref().filter(|_| right).unwrap_or(&self.y).range
    }

    /// Position of an x value across the paper.
    pub(super) fn px(&self, x: f64) -> f64 {
        self.rect.x + self.x.range.fraction(x) * self.rect.width
    }

    /// Position of a y value down the paper, on the left or right axis.
    pub(super) fn py(&self, y: f64, right: bool) -> f64 {
        self.rect.bottom() - self.upright(right).fraction(y) * self.rect.height
    }

    pub(super) fn at(&self, [x, y]: [f64; 2], right: bool) -> [f64; 2] {
        [self.px(x), self.py(y, right)]
    }

    /// The ends of a mark across the axes.
    pub(super) fn mark_ends(&self, mark: &Mark) -> [[f64; 2]; 2] {
        match mark.direction {
            Direction::Vertical => [self.rect.bottom(), self.rect.y].map(|y| [self.px(mark.at), y]),
            Direction::Horizontal => [self.rect.x, self.rect.right()].map(|x| [x, self.py(mark.at, false)]),
        }
    }
}

/// Symbol of a layer in the legend.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Sign {
    Line(Style),
    Patch(Colour, f64),
    Point(Marker, Colour),
}

/// An entry of the legend.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) sign: Sign,
    pub(super) name: String,
}

impl Entry {
    /// Width of its symbol.
    pub(super) fn sample(&self) -> f64 {
        match self.sign {
            Sign::Line(_) => SAMPLE,
            Sign::Patch(..) => 9.0,
            Sign::Point(..) => 6.0,
        }
    }

    /// Width of symbol and name.
    pub(super) fn width(&self) -> f64 {
        self.sample() + SPACE + text::width(&self.name, NOTE)
    }
}

/// `gap (10⁻⁹ m)`
fn axis_label(label: &str, unit: &str, exponent: i32) -> String {
    let power = if exponent == 0 { String::new() } else { power_of_ten(f64::from(exponent)) };
    let unit = format!("{power} {unit}");
    match (label, unit.trim()) {
        (label, "") => label.to_owned(),
        ("", unit) => unit.to_owned(),
        (label, unit) => format!("{label} ({unit})"),
    }
}

/// Whether a panel contains a map; its axes then end where the map ends.
pub(super) fn fills(panel: &Panel) -> bool {
    panel.layers.iter().any(|layer| matches!(layer, Layer::Map(_) | Layer::Categories(_)))
}

/// The map whose colours the bar explains.
pub(super) fn first_map(panel: &Panel) -> Option<&Map> {
    panel.layers.iter().find_map(|layer| match layer {
        Layer::Map(map) => Some(map),
        _ => None,
    })
}

/// The range of a map's colours.
pub(super) fn map_range(map: &Map) -> Scaled {
    Scaled::new(&map.range, Scale::Linear, map.grid.values.iter().copied(), false)
}
