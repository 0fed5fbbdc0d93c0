//! `squeezefilm compare`: presets side by side.

use super::columns::{Columns, heading};
use super::exit::{CliError, Exit};
use super::options::CommonOptions;
use super::progress::Bar;
use super::terminal;
use crate::analysis::compare::{ComparedRun, runs};
use crate::analysis::decision::effort;
use crate::digits::{counted, duration};
use crate::export::compare::{frames, mark, object, parameter_rows, result_texts};
use crate::export::files::{self, Control, ExportError};
use crate::export::json;
use crate::scene::Value;
use crate::solve::Settings;
use clap::Args;
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  squeezefilm compare fundamental min-spacing-100nm
  squeezefilm compare fundamental rotor-width-0.6mm tooth-width-2.31mm --out results
  squeezefilm compare fundamental my.toml --set film.slip=fukui-kaneko --json
  squeezefilm compare fundamental --out report
  squeezefilm compare plate-viscous plate-crossover plate-trapped --out plates";

const FILES: &str = "\
Files of --out:
  report.html      everything in one file that opens offline: tables,
                   figures, animation, parameters, errors, the command
  compare.csv      a row for each run and quantity
  parameters.csv   a row for each key in which they differ (--all: each key)
  compare.json     what --json prints
  cycle.gif        one cycle of all runs in phase
  waves, loads, torque, maps, teeth (.svg .png)
                   figures of all runs overlaid; for plates
                   profiles, loads, loops, maps";

/// Solves several presets and shows them side by side, with differences against the first
///
/// Each is solved by itself, and its numbers are those of `squeezefilm solve`, to the last bit.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{FILES}\n\n{EXAMPLES}"))]
pub(super) struct Arguments {
    /// Built-in presets (see: squeezefilm presets), paths of TOML files, or - for standard input; a single preset is reported on its own
    #[arg(value_name = "PRESET", required = true, num_args = 1..)]
    presets: Vec<String>,

    /// Lists all parameters, not only those that differ
    #[arg(long)]
    all: bool,

    #[command(flatten)]
    common: CommonOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let scenes = arguments.common.scene.scenes(&arguments.presets)?;
    let (folder, settings, cancel) = arguments.common.begin(command)?;

    let (solved, wall_s) =
        Bar::points(scenes.len(), 0).timed(|bar| runs(&scenes, &settings, &cancel, &|run| bar.point_done(&run.label)));
    let runs = solved?;
    if cancel.is_cancelled() {
        return Err(ExportError::Cancelled.into());
    }
    runs.iter().for_each(|run| terminal::warnings(&run.label, &run.solved));
    let document = || json::document(&object(&runs, &settings), command);
    terminal::result(arguments.common.output.json, document, || {
        text(&runs, &settings, arguments.common.solve.accuracy.budget, arguments.all)
    });
    terminal::note(&format!("{} in {}", counted(runs.len(), "preset", "presets"), duration(wall_s)));
    if let Some(folder) = &folder {
        let bar = Bar::points(frames(&runs), 0);
        let control = Control { cancel: &cancel, drawn: &|_, _| bar.point_done("frames") };
        let paths = files::comparison(folder, &runs, &settings, arguments.all, &control)?;
        drop(bar);
        terminal::wrote(folder.path, &paths);
    }
    Ok(Exit::worst(runs.iter().map(|run| Exit::from(&run.status()))))
}

/// The tables for people. Runs are lettered, so that long names do not widen them.
fn text(runs: &[ComparedRun], settings: &Settings, budget: Option<Duration>, all: bool) -> String {
    let how = effort(settings, budget);
    let all = all || runs.len() < 2;
    let title = if runs.len() < 2 {
        format!("one preset, {how}")
    } else {
        format!("{} presets, {how}; differences are against {}", runs.len(), letter(0))
    };
    let mut text = heading(&title);
    let mut columns = Columns::new();
    for (i, run) in runs.iter().enumerate() {
        columns.row([letter(i), run.label.clone(), mark(run)]);
    }
    text.push_str(&columns.text(&[]));

    let letters = |first: &str| std::iter::once(first.to_owned()).chain((0..runs.len()).map(letter));
    let mut columns = Columns::headed(letters("parameter"));
    let mut listed = 0;
    for row in parameter_rows(runs).iter().filter(|row| all || row.differs()) {
        listed += 1;
        let shown = |(place, value): (usize, &Option<Value>)| {
            value.as_ref().map_or_else(|| row.missing(place).to_owned(), Value::to_string)
        };
        columns.row(std::iter::once(row.parameter.key.to_owned()).chain(row.values.iter().enumerate().map(shown)));
    }
    let right: Vec<usize> = (1..=2 * runs.len()).collect();
    text.push('\n');
    if listed == 0 {
        text.push_str("  no parameter differs\n");
    } else {
        text.push_str(&columns.text(&right));
    }

    let pair = |i: usize| if i == 0 { vec![letter(i)] } else { vec![letter(i), format!("{} − A", letter(i))] };
    let mut columns = Columns::headed(std::iter::once("result".to_owned()).chain((0..runs.len()).flat_map(pair)));
    for (_, name, texts) in result_texts(runs) {
        // The first has no difference.
        let texts = texts.into_iter().enumerate().flat_map(|(i, texts)| texts.into_iter().take(1 + usize::from(i > 0)));
        columns.row(std::iter::once(name).chain(texts));
    }
    text.push('\n');
    text.push_str(&columns.text(&right));
    text
}

/// `A`, `B`, …; after `Z` numbers.
fn letter(index: usize) -> String {
    match u8::try_from(index).ok().filter(|index| *index < 26) {
        Some(index) => char::from(b'A' + index).to_string(),
        None => (index + 1).to_string(),
    }
}
