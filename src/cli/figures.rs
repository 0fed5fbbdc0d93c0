//! Figures among the files of `--out`.

use super::options::{FigureFormat, figure_format};
use crate::export::figure::{Figure, to_bytes};
use crate::export::folder::Staged;
use crate::export::folder::WriteError;
use clap::Args;
use std::io;

/// Which formats figures are written in.
#[derive(Clone, Debug, Args)]
pub(super) struct FigureOptions {
    /// Formats of the figures in --out: svg, png, pdf; none for no figures
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', requires = "out", default_values = ["svg", "png"], value_parser = figure_format())]
    figures: Vec<FigureFormat>,
}

impl FigureOptions {
    /// Stages a figure under a name, once in each format.
    pub(super) fn stage(&self, staged: &mut Staged, name: &str, figure: &Figure) -> Result<(), WriteError> {
        let mut formats: Vec<_> = self.figures.iter().filter_map(|format| format.0).collect();
        formats.sort_unstable();
        formats.dedup();
        for format in formats {
            staged.add(&format!("{name}.{}", format.name()), |out| {
                out.write_all(&to_bytes(figure, format).map_err(io::Error::other)?)
            })?;
        }
        Ok(())
    }
}
