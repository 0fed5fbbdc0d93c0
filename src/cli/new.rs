//! `squeezefilm new`: makes a preset from the data sheet of a motor.

use super::columns::{Columns, paragraph};
use super::exit::{CliError, Exit};
use super::options::{from_input, named_path};
use super::terminal;
use crate::analysis::data_sheet::agreeing;
use crate::control::Cancel;
use crate::input::ReadError;
use crate::scene::new_motor::{Answers, NewMotor, QUESTIONS, Question};
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};
use std::io::BufRead;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  squeezefilm new my.toml
  squeezefilm new my.toml --diameter-mm 60 --frequency-khz 40 --load-n 150 --stall-torque-nm 1
  squeezefilm new --diameter-mm 60 --frequency-khz 40 --load-n 150 | squeezefilm solve -";

/// Makes a preset of your motor from its data sheet
///
/// If a required value is missing, the program asks for everything that no option gives; an empty answer accepts the assumed value. The
/// assumptions and the reasons for them are listed, and written at the head of the file.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The preset file to write; without it, to standard output
    #[arg(value_name = "FILE", value_parser = named_path())]
    file: Option<PathBuf>,

    /// Replaces an existing file
    #[arg(long, requires = "file")]
    replace: bool,

    #[command(flatten)]
    answers: Given,
}

/// Answers given as options, one for each question.
#[derive(Debug, Default)]
struct Given(Answers);

impl Args for Given {
    fn augment_args(command: Command) -> Command {
        command.args(QUESTIONS.iter().map(|question| {
            let otherwise = question.otherwise.map_or_else(String::new, |assumed| format!(" [assumed: {assumed}]"));
            let help = format!("{}: {}{otherwise}", question.words, question.allowed());
            let check = |answer: &str| Question::check(question, answer).map(|()| answer.to_owned());
            Arg::new(question.name)
                .long(question.name)
                .value_name("ANSWER")
                .help(help)
                .allow_negative_numbers(true)
                .value_parser(check)
        }))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for Given {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let answer =
            |question: &Question| Some((question.name.to_owned(), matches.get_one::<String>(question.name)?.clone()));
        Ok(Self(QUESTIONS.iter().filter_map(answer).collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        self.0.extend(Self::from_arg_matches(matches)?.0);
        Ok(())
    }
}

/// Refuses to overwrite an existing `file`, unless `replace` allows it.
pub(super) fn free(file: &Path, replace: bool) -> Result<(), CliError> {
    if file.exists() && !replace {
        return Err(CliError::file(file, "there is such a file already; --replace replaces it"));
    }
    Ok(())
}

pub(super) fn run(arguments: &Arguments) -> Result<Exit, CliError> {
    if let Some(file) = &arguments.file {
        free(file, arguments.replace)?;
        if let Some(folder) = file.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
            return Err(CliError::file(folder, "there is no such folder"));
        }
    }
    let mut answers = arguments.answers.0.clone();
    if QUESTIONS.iter().any(|question| question.otherwise.is_none() && !answers.contains_key(question.name)) {
        ask(&mut answers)?;
    }
    let motor = agreeing(&answers, &Cancel::new()).map_err(CliError::Input)?;
    print_assumptions(&motor);
    motor.unmet.iter().for_each(|words| terminal::warning(words));
    match &arguments.file {
        Some(file) => {
            motor.save(file)?;
            terminal::note(&format!("wrote {}", file.display()));
        }
        None => terminal::data(&motor.to_toml()),
    }
    Ok(Exit::Solved)
}

/// Asks the open questions on standard error, and reads the answers from standard input, one per line. When the input ends, nothing more
/// is asked.
fn ask(answers: &mut Answers) -> Result<(), CliError> {
    let mut lines = std::io::stdin().lock().lines();
    let open = QUESTIONS.iter().filter(|question| !answers.contains_key(question.name)).collect::<Vec<_>>();
    for question in open {
        loop {
            terminal::prompt(&match question.otherwise {
                Some(assumed) => format!("{} [{assumed}]: ", question.title()),
                None => format!("{}: ", question.title()),
            });
            let Some(line) = lines.next() else {
                // Later output begins on a new line, not after the question.
                terminal::say("");
                return Ok(());
            };
            let answer = line.map_err(|error| from_input(ReadError::System(error.to_string())))?.trim().to_owned();
            let wrong = match question.check(&answer) {
                _ if answer.is_empty() && question.otherwise.is_some() => break,
                _ if answer.is_empty() => format!("an answer is needed: {}", question.allowed()),
                Err(wrong) => wrong,
                Ok(()) => {
                    answers.insert(question.name.to_owned(), answer);
                    break;
                }
            };
            terminal::note(&wrong);
        }
    }
    Ok(())
}

/// Prints the assumptions, and the reason for each.
fn print_assumptions(motor: &NewMotor) {
    let mut columns = Columns::new();
    for assumption in &motor.assumed {
        columns.row([assumption.key, &assumption.value, &assumption.why]);
    }
    terminal::note(&format!("\n{}{}", paragraph("Assumed, and why:", "", ""), columns.text(&[])));
}
