//! `squeezefilm reproduce`: every table and figure of the paper, in one report.

use super::columns::{Columns, heading};
use super::exit::{CliError, Exit};
use super::options::{OutputOptions, SolveOptions};
use super::progress::Bar;
use super::terminal;
use crate::analysis::reproduce::{Both, ReproducedRow, Reproduction, number_of_solves, reproduce};
use crate::control::Cancel;
use crate::digits::duration;
use crate::export::animation::{Format, Options, count, cycle};
use crate::export::files::{self, ExportError, Files, Folder};
use crate::export::reproduce::{figures, object, report, row_object};
use crate::export::{csv, json};
use crate::fidelity::Fidelity;
use crate::solve::Method;
use clap::Args;
use std::path::PathBuf;
use std::time::Instant;

const FILES: &str = "\
Files of --out:
  report.html  everything in one file that opens offline
  table1.csv   Table I: published, by the paper's algorithm, converged
  figures.json what --json prints
  fig3 … fig12 (.svg .png)
               the figures
  cycle.gif    the fundamental case, moving";

/// Reproduces every table and figure that the paper's text defines, in one HTML report
///
/// Table I and Figs. 3, 4 and 6–12 of Maeno and Bogy (1992): published numbers beside those of the paper's algorithm on its
/// own meshes and converged ones. Statements in the paper's text are checked, too. This takes less than a minute on two cores.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  squeezefilm reproduce\n  squeezefilm reproduce --out paper --figures pdf", after_long_help = FILES, mut_arg("out", |out| out.default_value("reproduction")), mut_arg("method", |method| method.hide(true)))]
pub(super) struct Arguments {
    #[command(flatten)]
    solve: SolveOptions,

    #[command(flatten)]
    output: OutputOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    if arguments.solve.method.is_some() {
        return Err(CliError::usage("reproduce solves by both methods: leave --method out"));
    }
    let (settings, cancel) = arguments.solve.begin_with(Fidelity::Fine, Method::Auto)?;
    let Some(folder) = arguments.output.folder(command)? else { return Err(CliError::usage("give --out")) };
    let started = Instant::now();
    let bar = Bar::points(number_of_solves(), 0);
    let solved = reproduce(&settings, &cancel, &|name| bar.point_done(name));
    drop(bar);
    let all = solved?;
    let paths = write(&folder, &all, &cancel)?;
    terminal::result(arguments.output.json, || json::document(&object(&all), command), || text(&all));
    terminal::wrote(folder.path, &paths);
    terminal::note(&format!(
        "{} solves and the report in {}; open {}",
        number_of_solves(),
        duration(started.elapsed().as_secs_f64()),
        folder.path.join("report.html").display()
    ));
    Ok(if all.unsolved() == 0 { Exit::Solved } else { Exit::NotConverged })
}

/// Writes the files; none if it was cancelled meanwhile.
fn write(folder: &Folder<'_>, all: &Reproduction, cancel: &Cancel) -> Result<Vec<PathBuf>, CliError> {
    let check = || if cancel.is_cancelled() { Err(ExportError::Cancelled) } else { Ok(()) };
    check()?;
    let mut gif = None;
    if let Some((both, solution)) =
        all.row("fundamental").and_then(|row| Some((&row.both, row.both.ours.as_ref().ok()?)))
    {
        let options = Options { width: 860, ..Options::default() };
        let bar = Bar::points(count(&solution.recording, &options, Format::Gif), 0);
        let movie = cycle(&both.problem, solution, &options, &|| bar.point_done("frames"), cancel)?;
        gif = Some(files::gif(&movie, &folder.path.join("cycle.gif"), cancel)?);
    }
    let mut files = Files::new(folder)?;
    files.text("report.html", &report(all, gif.as_deref(), folder.command))?;
    files.add("table1.csv", |out| csv::rows(all.rows.iter().map(row_object), out))?;
    files.json("figures.json", &object(all))?;
    for (number, figure) in figures(all) {
        check()?;
        files.figure(&format!("fig{number}"), &figure)?;
    }
    if let Some(gif) = &gif {
        files.add("cycle.gif", |out| out.write_all(gif))?;
    }
    check()?;
    Ok(files.commit()?)
}

/// Table I for people.
fn text(all: &Reproduction) -> String {
    let mut text = heading("Table I of Maeno and Bogy (1992): film share α of the load");
    let mut columns = Columns::headed(["row", "published", "paper's algorithm", "converged"]);
    let share = |solved| Both::result(solved).map_or_else(|| "failed".to_owned(), |result| result.alpha.to_string());
    for ReproducedRow { published, both } in &all.rows {
        columns.row([
            published.row.clone(),
            format!("{:.3}", published.published_alpha),
            share(&both.paper),
            share(&both.ours),
        ]);
    }
    text.push_str(&columns.text(&[1, 2, 3]));
    text
}
