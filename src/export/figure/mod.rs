//! Figures for print: described as plain data, drawn as SVG, PNG and PDF.
//!
//! A [`Figure`] holds [`Panel`]s in rows and columns; a panel holds two or three [`Axis`] and [`Layer`]s. What the same
//! description looks like is decided here, once, for the command line, the window and the reports: type of 8 to 9 pt at
//! the widths of journals, thin axes, colours of Okabe and Ito, dashes and markers that survive grey printing.
//!
//! ```
//! use squeezefilm::export::figure::{self, Axis, Figure, Line, Panel, Style};
//!
//! let squared = (0..=100).map(|i| f64::from(i) / 100.0).map(|x| [x, x * x]);
//! let panel = Panel::new("", Axis::new("x", "mm"), Axis::new("load", "N").including([0.0]))
//!     .layer(Line::new("x²", squared, Style::nth(0)));
//! let svg = figure::to_svg(&Figure::new("A parabola").panel(panel));
//! assert!(svg.starts_with("<svg") && svg.contains("load (N)"));
//! ```
//!
//! # How it is made
//!
//! | step | where |
//! | --- | --- |
//! | description | `description`, `colour` |
//! | values to places, ticks | `scale` |
//! | plotting areas that line up, legends | `layout`, `legend` |
//! | lines, areas, contours, cut to the axes | `geometry`, `isoline` |
//! | fields as pictures | `plane` |
//! | one panel as SVG | `panel`, `svg`, `text` |
//! | SVG to PNG (resvg) and PDF (svg2pdf), with the bundled font | `files` |
//!
//! The SVG is written here because no library drew what a journal prints: kuva 0.6 neither lines up the axes of panels, nor
//! places a map on nodes that are not uniform, and labels a tick 4.9999999999999995e-11; plotters has whole-pixel
//! coordinates. Coordinates are in points; every panel carries the place and the range of its axes as attributes
//! (`data-area`, `data-x`, `data-y`), so that a reader of the file can get back to the values.

mod colour;
mod description;
mod files;
mod geometry;
mod isoline;
mod layout;
mod legend;
mod panel;
mod plane;
mod scale;
mod svg;
mod text;

pub use colour::{Colour, Colours};
pub use description::{
    Anchor, Axis, Band, Categories, Contours, Dash, Direction, Figure, Grid, Layer, Legend, Line, Map, Mark, Marker,
    Panel, Points, Provenance, Range, Scale, Shading, Shape, Style, Text, Width,
};
pub use files::{FigureError, Format, PRINT, to_bytes, to_pdf, to_png, to_svg, write};

#[cfg(feature = "gui")]
pub(crate) use geometry::{contour, is_contour};

pub(super) use files::{Pixels, pixels, png_bytes};

use layout::{FOOT, Layout, TITLE};
use svg::{Picture, Svg, Type};

/// A figure as it is drawn: what the formats have in common.
struct Drawing {
    /// Width and height \[pt\].
    size: [f64; 2],
    /// Under everything else.
    pictures: Vec<Picture>,
    /// The elements of an SVG, without its root.
    body: String,
}

impl Drawing {
    fn new(figure: &Figure) -> Self {
        let layout = Layout::new(figure);
        let mut svg = Svg::default();
        let mut pictures = Vec::new();
        for (at, line) in &layout.title {
            svg.text(*at, line, &Type::new(TITLE, "start"));
        }
        for (placed, panel) in layout.panels.iter().zip(&figure.panels) {
            pictures.extend(panel::pictures(placed, panel));
            panel::draw(&mut svg, placed, panel);
        }
        for (at, line) in &layout.foot {
            svg.text(*at, line, &Type { colour: Colour::QUIET, ..Type::new(FOOT, "start") });
        }
        Self { size: [layout.width, layout.height], pictures, body: svg.body }
    }
}
