//! `squeezefilm join`: joins the parts of a sweep that were solved separately.

use super::exit::{CliError, Exit};
use super::options::{OutputOptions, named_path};
use super::sweep::tell;
use super::terminal;
use crate::export::files;
use crate::export::saved::{Joined, LARGEST, join};
use crate::export::sweep::primary;
use crate::input::read_text;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  squeezefilm join results/sweep.part-*.csv --out results
  squeezefilm join a/sweep.part-1-of-2.csv b/sweep.part-2-of-2.csv --json";

const FILES: &str = "\
Files of --out: the same as those of squeezefilm sweep, byte for byte what one machine
would write.";

/// Joins the parts of a sweep that were solved with sweep --part
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{FILES}\n\n{EXAMPLES}"))]
pub(super) struct Arguments {
    /// The files of all parts, in any order
    #[arg(value_name = "PART", required = true, value_parser = named_path())]
    parts: Vec<PathBuf>,

    #[command(flatten)]
    output: OutputOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<Exit, CliError> {
    let read = |path: &PathBuf| match read_text(path, LARGEST) {
        Ok(text) => Ok((path.display().to_string(), text)),
        Err(fault) => Err(CliError::file(path, fault)),
    };
    let parts = arguments.parts.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let Joined { sweep, rows, command } = join(&parts).map_err(CliError::Input)?;
    let folder = arguments.output.folder(&command)?;
    let exit = tell(&sweep, &rows, arguments.output.json, &command);
    if let Some(folder) = &folder {
        terminal::wrote(folder.path, &files::swept(folder, &sweep, &rows, primary(&sweep))?);
    }
    Ok(exit)
}
