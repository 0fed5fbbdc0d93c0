//! `squeezefilm completions` and `squeezefilm man`: completion scripts for shells, and man pages.

use super::exit::{CliError, Exit};
use super::options::named_path;
use super::terminal;
use crate::atomic::Staged;
use crate::citation::{RELEASED, VERSION};
use clap::{Args, Command};
use clap_complete::Shell;
use clap_mangen::Man;
use std::path::PathBuf;

/// Prints a completion script for a shell
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  squeezefilm completions bash > ~/.local/share/bash-completion/completions/squeezefilm
  squeezefilm completions fish > ~/.config/fish/completions/squeezefilm.fish")]
pub(super) struct CompletionsArguments {
    /// The shell
    shell: Shell,
}

/// Writes a man page for every command
#[derive(Debug, Args)]
#[command(after_help = "Example:
  squeezefilm man ~/.local/share/man/man1")]
pub(super) struct ManArguments {
    /// Folder for the pages
    #[arg(value_name = "DIR", value_parser = named_path())]
    folder: PathBuf,
}

/// `program`: the whole command line.
pub(super) fn completions(arguments: &CompletionsArguments, mut program: Command) -> Result<Exit, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut program, "squeezefilm", &mut script);
    terminal::data(&String::from_utf8_lossy(&script));
    Ok(Exit::Solved)
}

/// `program`: the whole command line.
pub(super) fn man(arguments: &ManArguments, program: Command) -> Result<Exit, CliError> {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let mut pages = Staged::new(&arguments.folder)?;
    let nested = program.get_subcommands().flat_map(|command| command.get_subcommands());
    for command in std::iter::once(&program).chain(program.get_subcommands()).chain(nested) {
        let page = Man::new(command.clone()).date(RELEASED).source(format!("squeezefilm {VERSION}"));
        pages.add(page.get_filename(), |file| {
            let mut text = Vec::new();
            page.render(&mut text)?;
            // The text after the options keeps its line breaks: tables of files, and examples to copy.
            let text = String::from_utf8_lossy(&text);
            let (before, after) = text.split_once(".SH EXTRA\n").unwrap_or((&text, ""));
            let (notes, rest) = after.split_at(after.find("\n.SH ").map_or(after.len(), |end| end + 1));
            let notes = if notes.is_empty() { String::new() } else { format!(".SH NOTES\n.nf\n{notes}.fi\n") };
            file.write_all(format!("{before}{notes}{rest}").as_bytes())
        })?;
    }
    pages.commit()?;
    Ok(Exit::Solved)
}
