//! Reasons why results are not written.

use super::figure::FigureError;
use crate::atomic::WriteError;
use std::path::PathBuf;

/// The reason why results were not written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The caller cancelled; no file was written.
    #[error("cancelled; no file was written")]
    Cancelled,
    /// The extension belongs to no format of animations.
    #[error("{}: animations are written as .gif, as .mp4, as .png (animated), or into a folder, whose name has no extension", path.display())]
    Extension {
        /// The path asked for.
        path: PathBuf,
    },
    /// The solve has no fields of a cycle.
    #[error("there is no cycle to animate")]
    NoCycle,
    /// Frames of an animation differ in size.
    #[error("frame {frame} has another size than the first")]
    Size {
        /// Which frame, from 0.
        frame: usize,
    },
    /// A folder or a file.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A figure, or a frame.
    #[error(transparent)]
    Figure(#[from] FigureError),
}
