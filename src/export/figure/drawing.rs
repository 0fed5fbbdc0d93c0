//! A figure as it is drawn.

use super::colour::Colour;
use super::description::Figure;
use super::layout::Layout;
use super::placed::{FOOT, TITLE};
use super::svg::{Raster, Svg, Type};

/// A figure as it is drawn: the part that is common to all formats.
pub(super) struct Drawing {
    /// Width and height \[pt\].
    pub(super) size: [f64; 2],
    /// Pictures, which are below everything else.
    pub(super) pictures: Vec<Raster>,
    /// The elements of an SVG, without its root.
    pub(super) body: String,
}

impl Drawing {
    pub(super) fn new(figure: &Figure) -> Self {
        let layout = Layout::new(figure);
        let mut svg = Svg::default();
        let mut pictures = Vec::new();
        for (at, line) in &layout.title {
            svg.text(*at, line, &Type::new(TITLE, "start"));
        }
        for panel in &layout.panels {
            pictures.extend(panel.pictures());
            panel.draw(&mut svg);
        }
        for (at, line) in &layout.foot {
            svg.text(*at, line, &Type { colour: Colour::QUIET, ..Type::new(FOOT, "start") });
        }
        Self { size: [layout.width, layout.height], pictures, body: svg.body }
    }
}
