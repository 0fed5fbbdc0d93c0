//! Measured heights in a preset: `surface.heights_csv = "face.csv"`, a path relative to the preset's folder, in the format of
//! [`crate::surface::height_map`]. Both faces are assumed to be like the measured one. Keys that the preset does not give get their values
//! from the file. The scene keeps these values, so that a saved preset needs no second file.

use super::error::{FaultKind, SceneError};
use super::parameter::Parameter;
use crate::digits::rounded;
use crate::input;
use crate::surface::height_map::HeightMapError;
use crate::surface::texture::{Pair, measured};
use std::path::Path;

/// Largest file \[MB\].
pub const LARGEST: u64 = 256;
/// Significant digits of the values that follow.
const DIGITS: usize = 4;

/// The keys whose values follow from measured faces, and these values, each in the unit of its key.
pub fn keys_of(pair: &Pair) -> [(&'static str, f64); 4] {
    [
        ("surface.rms_nm", pair.rms * 1e9),
        ("surface.summit_radius_um", pair.summit_radius * 1e6),
        ("surface.summit_density_per_mm2", pair.summit_density * 1e-6),
        ("surface.lay", pair.lay),
    ]
    .map(|(key, value)| (key, rounded(value, DIGITS)))
}

/// Reads the file at `path`. `parameter` names it, with the value `given`, which messages quote.
pub(super) fn read(parameter: &'static Parameter, given: &str, path: &Path) -> Result<Pair, SceneError> {
    let fault = |fault| FaultKind::csv(parameter.key, given, path, fault);
    let text = input::read_text(path, LARGEST).map_err(|error| fault(format!(" {error}")))?;
    let (_, texture) = measured(&text, 1).map_err(|error| match error {
        // The line is not quoted, because the path may be that of any file on this machine.
        HeightMapError::Line { line, .. } => fault(format!(": line {line} has no heights of a measured face")),
        other => fault(format!(": {other}")),
    })?;
    Ok(Pair::of(&texture, &texture))
}
