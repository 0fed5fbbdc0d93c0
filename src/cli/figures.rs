//! Figures among the files of `--out`.

use crate::export::figure::{Figure, Format, to_bytes};
use crate::export::folder::{Staged, WriteError};
use std::io;

/// Formats that `--out` writes.
const FORMATS: [Format; 2] = [Format::Svg, Format::Png];

/// Stages a figure under a name, once in each format.
pub(super) fn stage_figure(staged: &mut Staged, name: &str, figure: &Figure) -> Result<(), WriteError> {
    for format in FORMATS {
        staged.add(&format!("{name}.{}", format.name()), |out| {
            out.write_all(&to_bytes(figure, format).map_err(io::Error::other)?)
        })?;
    }
    Ok(())
}
