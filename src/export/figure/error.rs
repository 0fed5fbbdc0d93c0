//! A figure in pixels, and the reasons why there is none.

use std::path::PathBuf;

/// No picture is larger than this along a side.
pub(super) const MOST: f64 = 20_000.0;

/// The reason why a figure cannot be made or written.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The extension belongs to no known format.
    #[error("{}: figures are written as .svg, .png or .pdf", path.display())]
    Extension {
        /// The path asked for.
        path: PathBuf,
    },
    /// The program was built without a renderer.
    #[error("this program was built without what draws figures in pixels and on pages; it writes them as .svg")]
    NotBuilt,
    /// The renderer does not understand the drawing.
    #[error("the figure cannot be drawn: {0}")]
    Draw(String),
    /// It would have too many pixels, or none.
    #[error("a figure of {width:.0} × {height:.0} pixels cannot be drawn: 1 to {MOST} along a side")]
    Size {
        /// Pixels across.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] crate::atomic::WriteError),
}

pub(in crate::export) struct Pixels {
    pub(in crate::export) width: u32,
    pub(in crate::export) height: u32,
    /// Red, green, blue, row by row from the top.
    pub(in crate::export) rgb: Vec<u8>,
}
