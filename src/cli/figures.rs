//! Figures among the files of `--out`.

use super::options::{FigureFormat, figure_format};
use crate::atomic::{Staged, WriteError};
use crate::export::figure::{Figure, Format};
use crate::export::files::stage_figure;
use clap::Args;

/// Which formats figures are written in.
#[derive(Clone, Debug, Args)]
pub(super) struct FigureOptions {
    /// Formats of the figures in --out: svg, png, pdf; none for no figures
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', requires = "out", default_values = ["svg", "png"], value_parser = figure_format())]
    figures: Vec<FigureFormat>,
}

impl FigureOptions {
    /// The formats asked for.
    pub(super) fn formats(&self) -> Vec<Format> {
        self.figures.iter().filter_map(|format| format.0).collect()
    }

    /// Stages a figure under a name, once in each format.
    pub(super) fn stage(&self, staged: &mut Staged, name: &str, figure: &Figure) -> Result<(), WriteError> {
        stage_figure(staged, name, figure, &self.formats())
    }
}
