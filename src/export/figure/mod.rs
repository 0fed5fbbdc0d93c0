//! Figures for print: described as plain data, drawn as SVG, PNG and PDF.
//!
//! A [`Figure`] holds [`Panel`]s in rows and columns; a panel holds two or three [`Axis`] and [`Layer`]s. How a description is drawn is
//! decided here, once, for the command line, the window and the reports: type of 8 to 9 pt at the widths of journals, thin axes, colours of
//! Okabe and Ito, and dashes and markers that can still be distinguished in grey print.
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
//! | description | `colour`, `style`, `axis`, `layers`, `provenance`, `description` |
//! | values to places, ticks | `scale` |
//! | plotting areas that line up, legends | `placed`, `legend`, `layout` |
//! | lines, areas, contours, cut to the axes | `geometry`, `isoline` |
//! | fields as pictures | `plane` |
//! | one panel as SVG, all of them | `svg`, `text`, `panel`, `drawing` |
//! | SVG to PNG (resvg) and PDF (svg2pdf), with the bundled font | `render`, `files` |
//! | sheets of paper with text, to write and sketch on | `sheet` |
//!
//! The SVG is written here because no library draws what a journal prints: kuva 0.6 does not align the axes of panels, cannot place a map
//! on non-uniform nodes, and labels a tick 4.9999999999999995e-11; plotters has whole-pixel coordinates. Coordinates are in points. Every
//! panel has the position and the range of its axes as attributes (`data-area`, `data-x`, `data-y`), from which a reader of the file can
//! compute the values.

mod axis;
mod colour;
mod description;
mod drawing;
mod error;
mod files;
mod geometry;
mod isoline;
mod layers;
mod layout;
mod legend;
mod panel;
mod placed;
mod plane;
mod provenance;
#[cfg_attr(not(feature = "render"), path = "not_rendered.rs")]
mod render;
mod scale;
mod sheet;
mod style;
mod svg;
mod text;

pub use axis::{Axis, Range, Scale};
pub use colour::{Colour, Colours};
pub use description::{Figure, Legend, Panel, Width};
pub use error::FigureError;
pub use files::{Format, to_bytes, to_pdf, to_png, to_svg, write};
pub use layers::{Band, Categories, Direction, Grid, Layer, Line, Map, Mark, Points, Shading, Text};
pub use plane::PRINT;
pub use provenance::Provenance;
pub use sheet::{Piece, sheets_to_pdf};
pub use style::{Dash, Marker, Shape, Style};
pub use svg::escaped;

#[cfg(feature = "gui")]
pub(crate) use geometry::{contour, is_contour};
#[cfg(feature = "gui")]
pub(crate) use layout::ends;
#[cfg(feature = "gui")]
pub(crate) use panel::names;

pub(super) use axis::extent;
pub(super) use error::Pixels;
pub(super) use files::{pixels, png_bytes};
