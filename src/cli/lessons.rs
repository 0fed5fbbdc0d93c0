//! `squeezefilm lessons`: checks the lessons of a teacher, prints lessons on paper, and sums up the answers of a class.

use super::exit::{CliError, Exit};
use super::options::{cancel_on_interrupt, named_path};
use super::progress::Bar;
use super::terminal;
use crate::atomic::{Staged, write_file};
use crate::digits::counted;
use crate::export::figure::{Piece, sheets_to_pdf};
use crate::export::files::ExportError;
use crate::gui::state::lessons::window_names;
use crate::lessons::trial::{self, Finding};
use crate::lessons::{self, Lesson, LessonError, handout, record};
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};

/// Checks your lessons, prints lessons on paper, and sums up the records of a class
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  squeezefilm lessons check my-course
  squeezefilm lessons print --out handouts
  squeezefilm lessons print my-course --out handouts
  squeezefilm lessons summary answers/*.csv --out class.html")]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Reads the lessons in a folder and tests every task: try must fulfil its check, wrong must not
    Check {
        /// A folder of lessons, or one lesson
        #[arg(value_name = "DIR", value_parser = named_path())]
        folder: PathBuf,
    },
    /// Writes worksheets and answer sheets as HTML and PDF, a page for each lesson
    Print {
        /// A folder of lessons, or one lesson; without it, the built-in lessons
        #[arg(value_name = "DIR", value_parser = named_path())]
        folder: Option<PathBuf>,
        /// Folder for worksheets and answers
        #[arg(long, value_name = "DIR", default_value = "handouts", value_parser = named_path())]
        out: PathBuf,
    },
    /// Writes a page summing up a class's answers, from records that students saved as CSV
    Summary {
        /// Records, one for each student
        #[arg(value_name = "FILE", required = true, value_parser = named_path())]
        records: Vec<PathBuf>,
        /// The page
        #[arg(long, value_name = "FILE", default_value = "summary.html", value_parser = named_path())]
        out: PathBuf,
    },
}

pub(super) fn run(arguments: &Arguments) -> Result<Exit, CliError> {
    match &arguments.command {
        Command::Check { folder } => check(folder),
        Command::Print { folder, out } => print(folder.as_deref(), out),
        Command::Summary { records, out } => summary(records, out),
    }
}

/// The lessons of a folder, or the built-in ones, and the faults of those that cannot be read; the faults are also printed.
fn read(folder: Option<&Path>) -> (Vec<Lesson>, Vec<LessonError>) {
    let read = |names: lessons::WindowNames<'_>| match folder {
        Some(folder) => lessons::load(folder, names),
        None => lessons::built_in(names),
    };
    let (lessons, faults) = window_names(read);
    faults.iter().for_each(|fault| terminal::error(&fault.to_string()));
    (lessons, faults)
}

fn check(folder: &Path) -> Result<Exit, CliError> {
    let (lessons, faults) = read(Some(folder));
    let cancel = cancel_on_interrupt();
    let mut failed = !faults.is_empty();
    for lesson in &lessons {
        let bar = Bar::points(lesson.steps.len(), 0);
        let findings = trial::lesson(lesson, &mut |step| bar.point_done(&step.title), &cancel);
        drop(bar);
        if cancel.is_cancelled() {
            return Ok(Exit::Other);
        }
        let errors = findings.iter().filter(|(_, finding)| matches!(finding, Finding::Error(_))).count();
        failed |= errors > 0;
        let tasks = lesson.steps.iter().filter(|step| step.task.is_some()).count();
        let words = match errors {
            0 => "all done by try, none by wrong".to_owned(),
            errors => counted(errors, "error", "errors"),
        };
        terminal::text(&format!(
            "{}: {}, {}, {}: {words}\n",
            lesson.id,
            lesson.title,
            counted(lesson.steps.len(), "step", "steps"),
            counted(tasks, "task", "tasks")
        ));
        for (step, finding) in &findings {
            let (kind, words) = match finding {
                Finding::Error(words) => ("error", words),
                Finding::Advice(words) => ("warning", words),
            };
            terminal::text(&format!("  {kind}: step {}, {}: {words}\n", step + 1, lesson.steps[*step].title));
        }
    }
    Ok(if failed { Exit::BadInput } else { Exit::Solved })
}

fn print(folder: Option<&Path>, out: &Path) -> Result<Exit, CliError> {
    let (lessons, faults) = read(folder);
    if lessons.is_empty() {
        // The faults have been printed already; earlier handouts stay as they are.
        return Err(CliError::Input("there is no lesson to print: nothing was written".to_owned()));
    }
    let cancel = cancel_on_interrupt();
    let mut staged = Staged::new(out)?;
    for (name, title, answers) in [("worksheets", "Worksheets", false), ("answers", "Answers", true)] {
        let sheets: Result<Vec<Vec<Piece>>, String> =
            lessons.iter().map(|lesson| handout::sheet(lesson, answers, &cancel)).collect();
        let sheets = sheets.map_err(CliError::Input)?;
        let html = handout::to_html(title, &sheets).into_bytes();
        let pdf = sheets_to_pdf(title, &sheets).map_err(ExportError::from)?;
        for (bytes, extension) in [(html, "html"), (pdf, "pdf")] {
            staged.add(format!("{name}.{extension}"), |file| file.write_all(&bytes))?;
        }
    }
    terminal::wrote(out, &staged.commit()?);
    Ok(if faults.is_empty() { Exit::Solved } else { Exit::BadInput })
}

fn summary(records: &[PathBuf], out: &Path) -> Result<Exit, CliError> {
    let class: Result<Vec<_>, String> = records.iter().map(|path| record::read(path)).collect();
    let page = record::summary(&class.map_err(CliError::Input)?);
    write_file(out, |file| file.write_all(page.as_bytes()))?;
    terminal::note(&format!("wrote {}", out.display()));
    Ok(Exit::Solved)
}
