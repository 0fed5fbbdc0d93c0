//! Measured heights as a preset gives them: `surface.heights_csv = "face.csv"`, a path relative to the preset's folder, in the format of
//! [`crate::surface::height_map`]. Both faces are taken to be like it. The keys that follow, and that the preset does not give, take their
//! values from it; the scene keeps those, so that a saved preset needs no second file.

use super::error::{SceneError, What};
use super::parameter::Parameter;
use super::value::show_text;
use crate::digits::rounded;
use crate::input;
use crate::surface::height_map::HeightMapError;
use crate::surface::texture::{Pair, measured};
use std::path::Path;

/// Largest file \[MB\].
pub const LARGEST: u64 = 256;
/// Digits of what follows.
const DIGITS: usize = 4;

/// The keys that follow from measured faces, and their values, each in the unit of its key.
pub fn keys_of(pair: &Pair) -> [(&'static str, f64); 4] {
    [
        ("surface.rms_nm", pair.rms * 1e9),
        ("surface.summit_radius_um", pair.summit_radius * 1e6),
        ("surface.summit_density_per_mm2", pair.summit_density * 1e-6),
        ("surface.lay", pair.lay),
    ]
    .map(|(key, value)| (key, rounded(value, DIGITS)))
}

/// Reads the file at `path`, which `parameter` names; `given` is the value of the key, for the message.
pub(super) fn read(parameter: &'static Parameter, given: &str, path: &Path) -> Result<Pair, SceneError> {
    let (key, path) = (parameter.key, path.to_owned());
    let given = show_text(given);
    let text = match input::read_text(&path, LARGEST) {
        Ok(text) => text,
        Err(fault) => return Err(What::Csv { key, given, path, fault }.into()),
    };
    // Nothing is quoted: it may be any file of this machine.
    let fault = |fault| match fault {
        HeightMapError::Line { line, .. } => format!("line {line} has no heights of a measured face"),
        other => other.to_string(),
    };
    let (_, texture) =
        measured(&text, 1).map_err(|error| What::Heights { key, given, path: path.clone(), fault: fault(error) })?;
    Ok(Pair::of(&texture, &texture))
}
