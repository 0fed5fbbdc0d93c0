//! Replacements for the functions that draw pixels and pages, in a program that is built without a renderer.

use super::drawing::Drawing;
use super::error::{FigureError, Pixels};

/// Always [`FigureError::NotBuilt`].
pub(super) fn pixels(_: &Drawing, _: &str, _: f64, _: [f64; 2]) -> Result<Pixels, FigureError> {
    Err(FigureError::NotBuilt)
}

/// Always [`FigureError::NotBuilt`].
pub(super) fn pdf(_: &[(Drawing, String)], _: &[(&str, String)]) -> Result<Vec<u8>, FigureError> {
    Err(FigureError::NotBuilt)
}
