//! The command line: one file per command. Data goes to standard output, everything else to standard error.

mod animate;
mod columns;
mod compare;
mod completions;
mod exit;
mod fall;
mod fit;
#[cfg(feature = "gui")]
mod gui;
mod join;
#[cfg(feature = "gui")]
mod lessons;
mod new;
mod options;
mod presets;
mod progress;
mod reproduce;
mod sensitivity;
mod solve;
mod stability;
mod startup;
mod summary;
mod surface;
mod sweep;
mod table1;
mod terminal;
mod tradeoff;

use crate::export::files::ExportError;
use crate::scene::presets::BuiltIn;
use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser, Subcommand};
use exit::{CliError, Exit};
use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;
use std::{panic, thread};

/// The squeezed air film of an ultrasonic motor, solved.
///
/// The film of air between the vibrating teeth of a ring-type ultrasonic motor and its rotor is squeezed tens of thousands
/// of times a second. It carries part of the axial load (the share α) and reduces friction, hence torque, by that share.
/// squeezefilm solves the film (compressible Reynolds equation with slip), the elastic rotor and the unilateral contact
/// together for the periodic steady state, and estimates the numerical error of every α.
#[derive(Debug, Parser)]
#[command(name = "squeezefilm", version)]
#[cfg_attr(not(feature = "gui"), command(arg_required_else_help = true, subcommand_required = true))]
#[command(after_help = AFTER)]
struct Cli {
    /// Only warnings and errors on standard error
    #[arg(long, global = true)]
    quiet: bool,

    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    #[cfg(feature = "gui")]
    Gui(gui::Arguments),
    Solve(solve::Arguments),
    Sweep(sweep::Arguments),
    Join(join::Arguments),
    Fit(fit::Arguments),
    Compare(compare::Arguments),
    Table1(table1::Arguments),
    Reproduce(reproduce::Arguments),
    Tradeoff(tradeoff::Arguments),
    Stability(stability::Arguments),
    Sensitivity(sensitivity::Arguments),
    Startup(startup::Arguments),
    Animate(animate::Arguments),
    Presets(presets::Arguments),
    New(new::Arguments),
    Surface(surface::Arguments),
    Completions(completions::CompletionsArguments),
    Man(completions::ManArguments),
    #[cfg(feature = "gui")]
    Lessons(lessons::Arguments),
}

const AFTER: &str = "\
Examples:
  squeezefilm solve fundamental
  squeezefilm solve fundamental --set film.min_spacing_nm=100 --fidelity fine --json
  squeezefilm solve levitating --out results
  squeezefilm sweep fundamental --vary stator.frequency_khz=3:100:20:log
  squeezefilm compare fundamental min-spacing-100nm --out results
  squeezefilm fit my.toml --data measured.csv --vary film.min_spacing_nm=20:1000
  squeezefilm reproduce
  squeezefilm sensitivity fundamental --uncertainty film.min_spacing_nm=20%
  squeezefilm startup fundamental
  squeezefilm animate fundamental --out wave.gif
  squeezefilm new my.toml
  squeezefilm surface rotor.csv stator.csv
  squeezefilm presets fundamental --out my.toml && squeezefilm solve my.toml
  squeezefilm presets fundamental --set film.slip=none | squeezefilm solve -

Exit status:
  0  solved
  2  bad input: the key, its value and the allowed range are named
  3  not converged, or not resolved (the stated error of α, or of a plate's load, is as large as
     the value, and not negligible): the last result is reported, and marked
  1  anything else, Ctrl-C included
141  standard output was closed before all was written; the files of --out are complete";

/// Runs the program with its arguments, the program's name first.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let cli = match Cli::try_parse_from(&arguments) {
        Ok(cli) => cli,
        Err(usage) => {
            if let Some(ContextValue::String(word)) = usage.get(ContextKind::InvalidSubcommand)
                && (BuiltIn::find(word).is_some() || Path::new(word).is_file())
            {
                terminal::error(&format!("{word} is a preset, not a command: squeezefilm solve {word}"));
                return Exit::BadInput.code();
            }
            // Help and version go to standard output with status 0, faults to standard error with status 2.
            return match usage.print() {
                Err(error) if !usage.use_stderr() => fail(&CliError::Output(error)),
                _ => ExitCode::from(u8::try_from(usage.exit_code()).unwrap_or(2)),
            };
        }
    };
    if cli.quiet {
        terminal::be_quiet();
    }
    let ended = match cli.command {
        #[cfg(feature = "gui")]
        Some(Command::Gui(arguments)) => gui::run(&arguments),
        #[cfg(feature = "gui")]
        None => gui::run(&gui::Arguments::default()),
        // clap asks for a command where there is no window.
        #[cfg(not(feature = "gui"))]
        None => Ok(Exit::Solved),
        Some(command) => on_a_thread(|| carry_out(command, &command_line(&arguments))),
    };
    let ended = match ended {
        Err(CliError::Export(cancelled @ ExportError::Cancelled)) => {
            terminal::note(&cancelled.to_string());
            Ok(Exit::Other)
        }
        ended => ended,
    };
    match ended.and_then(|exit| terminal::ended().map(|()| exit)) {
        Ok(exit) => exit.code(),
        Err(error) => fail(&error),
    }
}

/// Says what went wrong, unless nobody listens, and returns the exit status.
fn fail(error: &CliError) -> ExitCode {
    if !error.is_silent() {
        terminal::error(&error.to_string());
    }
    error.exit().code()
}

/// Runs `squeezefilm gui` for a program without a terminal. The first argument is the program's name; `tell` shows a message.
#[cfg(feature = "gui")]
pub fn run_window(arguments: impl IntoIterator<Item = OsString>, tell: impl FnOnce(&str)) -> ExitCode {
    let mut arguments = arguments.into_iter();
    let words = arguments.next().into_iter().chain(["gui".into()]).chain(arguments);
    let (text, exit) = match Cli::try_parse_from(words) {
        Ok(Cli { command: Some(Command::Gui(arguments)), .. }) => match gui::run(&arguments) {
            Ok(exit) => return exit.code(),
            Err(error) => (error.to_string(), error.exit()),
        },
        Ok(_) => return Exit::Solved.code(),
        Err(usage) => (usage.to_string(), if usage.use_stderr() { Exit::BadInput } else { Exit::Solved }),
    };
    tell(&text);
    exit.code()
}

/// Stack size of the thread that a command runs on \[bytes\]. On Windows the main thread has only one megabyte.
const STACK: usize = 8 << 20;

/// Runs a command on a thread of its own. On Windows the main thread also rounds differently from the threads that solve.
fn on_a_thread(command: impl FnOnce() -> Result<Exit, CliError> + Send) -> Result<Exit, CliError> {
    thread::scope(|scope| {
        let thread = thread::Builder::new().name("squeezefilm-command".to_owned()).stack_size(STACK);
        let thread = thread.spawn_scoped(scope, command);
        let thread = thread.map_err(|fault| CliError::System(format!("no thread can be started: {fault}")))?;
        thread.join().unwrap_or_else(|panic| panic::resume_unwind(panic))
    })
}

fn carry_out(command: Command, words: &[String]) -> Result<Exit, CliError> {
    match command {
        #[cfg(feature = "gui")]
        Command::Gui(arguments) => gui::run(&arguments),
        Command::Solve(arguments) => solve::run(&arguments, words),
        Command::Sweep(arguments) => sweep::run(&arguments, words),
        Command::Join(arguments) => join::run(&arguments),
        Command::Fit(arguments) => fit::run(&arguments, words),
        Command::Compare(arguments) => compare::run(&arguments, words),
        Command::Table1(arguments) => table1::run(&arguments),
        Command::Reproduce(arguments) => reproduce::run(&arguments, words),
        Command::Tradeoff(arguments) => tradeoff::run(&arguments, words),
        Command::Stability(arguments) => stability::run(&arguments, words),
        Command::Sensitivity(arguments) => sensitivity::run(&arguments, words),
        Command::Startup(arguments) => startup::run(&arguments, words),
        Command::Animate(arguments) => animate::run(&arguments),
        Command::Presets(arguments) => presets::run(&arguments),
        Command::New(arguments) => new::run(&arguments),
        Command::Surface(arguments) => surface::run(&arguments, words),
        Command::Completions(arguments) => completions::completions(&arguments, Cli::command()),
        Command::Man(arguments) => completions::man(&arguments, Cli::command()),
        #[cfg(feature = "gui")]
        Command::Lessons(arguments) => lessons::run(&arguments),
    }
}

/// The command line as it is recorded with results, with the name of the program instead of its path.
fn command_line(arguments: &[OsString]) -> Vec<String> {
    let words = arguments.iter().skip(1).map(|word| word.to_string_lossy().into_owned());
    std::iter::once("squeezefilm".to_owned()).chain(words).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_consistent() {
        Cli::command().debug_assert();
    }

    #[cfg(feature = "gui")]
    #[test]
    fn without_a_terminal_everything_is_told_to_the_box() {
        let told = |words: &[&str]| {
            let mut told = String::new();
            run_window(words.iter().map(OsString::from), |text| text.clone_into(&mut told));
            told
        };
        assert!(told(&["squeezefilm-window", "levitatin"]).contains("levitating"));
        assert!(told(&["squeezefilm-window", "--lesson", "0"]).contains("--lesson"));
        assert!(told(&["squeezefilm-window", "--help"]).contains("PRESET"));
    }
}
