//! `squeezefilm stability`: where each method solves, to the edges of the ranges.

use super::columns::{Columns, heading, paragraph};
use super::exit::{CliError, Exit};
use super::options::{CommonOptions, whole};
use super::progress::Bar;
use super::terminal;
use crate::analysis::decision::exactness;
use crate::analysis::stability::{Cell, MAPS, Map, VERDICTS, Verdict, cells, survey};
use crate::atomic::remove_file;
use crate::digits::duration;
use crate::export::files::Files;
use crate::export::stability::{cell_object, detail, figure, object};
use crate::export::{csv, json};
use crate::fidelity::Fidelity;
use crate::problem::{Problem, Scenario};
use crate::scene::{Parameter, show_text};
use crate::solve::Method;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser, ValueParser};

const EXAMPLES: &str = "\
Examples:
  squeezefilm stability --out results
  squeezefilm stability --map spacing-frequency --cells 15 --method auto
  squeezefilm stability levitating --fidelity draft";

/// Maps where each method (ours and the paper's) finds a solution, over the full ranges of the parameters
///
/// Every cell is solved by itself and judged: solved, not converged, non-physical (α outside 0 … 1 by more than its stated error, a
/// negative pressure or contact force,
/// or loads that do not add up to the applied load), failed or refused. This takes about a minute and a half on two cores, nearly all of it
/// for the paper's method, which --method auto omits. A map of a key that the motor does not have, such as the minimum
/// spacing of rough faces, is left out, with the reason.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The motor whose parameters are mapped: a built-in preset or a path
    #[arg(value_name = "PRESET", default_value = "fundamental")]
    preset: String,

    /// A map; may be repeated [default: all]
    #[arg(long = "map", value_name = "NAME", value_parser = map())]
    maps: Vec<&'static Map>,

    /// Cells along each axis of a map
    #[arg(long, value_name = "N", default_value = "5", value_parser = whole::<u16>(2..=200), allow_negative_numbers = true)]
    cells: u16,

    #[command(flatten)]
    common: CommonOptions,
}

/// Name of the file that a cancelled run leaves.
const INCOMPLETE: &str = "stability.incomplete.csv";

fn map() -> ValueParser {
    // Only names of maps are possible, so that the fallback to the first map is never used.
    PossibleValuesParser::new(MAPS.map(|map| map.name)).map(|name| Map::find(&name).unwrap_or(&MAPS[0])).into()
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let varied: Vec<&str> = MAPS.iter().flat_map(|map| map.axes).collect();
    let scene = arguments.common.scene.scene_varied(&arguments.preset, &varied)?;
    if matches!(Problem::try_from(&scene)?.scenario, Scenario::Plate(_)) {
        return Err(CliError::usage("stability maps the parameters of a motor, and this preset is a plate"));
    }
    let mut maps: Vec<&'static Map> =
        if arguments.maps.is_empty() { MAPS.iter().collect() } else { arguments.maps.clone() };
    let faults = maps.iter().filter_map(|map| Some((*map, map.fault(&scene)?.to_string())));
    let unmapped: Vec<(&Map, String)> = faults.collect();
    maps.retain(|map| unmapped.iter().all(|(other, _)| other.name != map.name));
    if maps.is_empty() {
        let reasons: Vec<String> = unmapped.iter().map(no_map).collect();
        return Err(CliError::usage(&reasons.join("\n")));
    }
    let (folder, settings, cancel) = arguments.common.begin(command)?;
    let methods =
        arguments.common.solve.method.map_or_else(|| vec![Method::Auto, Method::Paper], |method| vec![method]);
    let asked = cells(&scene, &maps, &methods, usize::from(arguments.cells));
    let total = asked.len();
    let (cells, wall_s) = Bar::points(total, 0).timed(|bar| {
        survey(&scene, asked, &settings, &cancel, &|cell| {
            bar.point_done(&format!("{}, method {}", cell.map.name, cell.method.name()));
        })
    });

    let alone = |cell: &Cell| {
        // The key of a cell replaces any other key for the same quantity.
        let mut given = arguments.common.scene.clone();
        let varied = cell.changes.iter().filter_map(|(key, _)| Parameter::find(key));
        let replaced = varied.flat_map(|key| key.alternatives().chain([key])).map(|other| other.key);
        let replaced: Vec<&str> = replaced.collect();
        given.changes.retain(|(key, _)| !replaced.contains(&key.as_str()));
        format!("{} {} {}", given.command(&arguments.preset), settings.fidelity.option(), cell.options())
    };
    let mut human = text(&scene.name, settings.fidelity, &maps, &methods, &cells, &alone);
    for missing in &unmapped {
        human.push_str(&paragraph(&no_map(missing), "\n", ""));
    }
    let complete = cells.len() == total;
    if complete {
        let document = || json::document(&object(&scene.name, settings.fidelity, &cells, &unmapped), command);
        terminal::result(arguments.common.output.json, document, || human);
        terminal::note(&format!("{total} cells in {}", duration(wall_s)));
    } else {
        terminal::note(&format!("cancelled after {} of {total} cells\n\n{human}", cells.len()));
    }
    if let Some(folder) = folder.filter(|_| !cells.is_empty()) {
        let mut files = Files::new(&folder)?;
        // A cancelled run must not be mistaken for a complete map.
        let name = if complete { "stability.csv" } else { INCOMPLETE };
        files.add(name, |out| csv::rows_of_ours(cells.iter().map(cell_object), out))?;
        if complete {
            files.figure("stability", &figure(&scene.name, settings.fidelity, &cells))?;
        }
        let paths = files.commit()?;
        if complete {
            remove_file(&folder.path.join(INCOMPLETE))?;
        }
        terminal::wrote(folder.path, &paths);
    }
    let solved = cells.iter().any(|cell| !matches!(cell.verdict, Verdict::Failed(_)));
    Ok(if complete && solved { Exit::Solved } else { Exit::Other })
}

/// Why there is no such map.
fn no_map((map, reason): &(&Map, String)) -> String {
    format!("No map {}, which varies {}: {reason}", map.name, map.axes.join(" and "))
}

/// The number of cells with each verdict, and for every cell that our method does not solve the command that solves it alone.
fn text(
    name: &str,
    fidelity: Fidelity,
    maps: &[&'static Map],
    methods: &[Method],
    cells: &[Cell],
    alone: &dyn Fn(&Cell) -> String,
) -> String {
    let title = format!(
        "{}: where it is solved, to the edges of the ranges; method auto at {}",
        show_text(name),
        exactness(&fidelity.to_string())
    );
    let mut text = heading(&title);
    let mut columns = Columns::headed(["map", "method", "cells"].into_iter().chain(VERDICTS));
    for map in maps {
        for method in methods {
            let of = |cell: &&Cell| cell.map.name == map.name && cell.method == *method;
            let mut counts = [0_usize; VERDICTS.len()];
            cells.iter().filter(of).for_each(|cell| counts[cell.verdict.number()] += 1);
            let mut row = vec![map.name.to_owned(), method.name().to_owned(), counts.iter().sum::<usize>().to_string()];
            row.extend(counts.iter().map(usize::to_string));
            columns.row(row);
        }
    }
    text.push_str(&columns.text(&[2, 3, 4, 5, 6, 7]));
    let ours = |cell: &&Cell| cell.method == Method::Auto && cell.verdict != Verdict::Solved;
    let unsolved: Vec<&Cell> = cells.iter().filter(ours).collect();
    if !unsolved.is_empty() {
        text.push_str("\nNot solved by method auto:\n");
        for cell in unsolved {
            text.push_str(&format!("  {}\n    {}: {}\n", alone(cell), cell.verdict.name(), detail(cell)));
        }
    }
    text
}
