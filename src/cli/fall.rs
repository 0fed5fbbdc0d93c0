//! `squeezefilm startup` of a plate under a load: the plate is dropped while the vibration starts.

use super::columns::{Columns, heading, paragraph};
use super::exit::{CliError, Exit};
use super::progress::Bar;
use super::summary::limits;
use super::terminal;
use crate::analysis::validity::{ExceededLimit, beside_headline};
use crate::control::Cancel;
use crate::digits::{counted, duration, percent, significant, with_error};
use crate::estimate::Estimate;
use crate::export::fall::{floats, object, validity};
use crate::export::files::{self, Folder};
use crate::export::json;
use crate::fall::{Cycle, Fall, fall, struck};
use crate::fidelity::Fidelity;
use crate::problem::Problem;
use crate::scene::{Scene, show_text};
use crate::solution::Status;

/// Approximate number of rows in the table on the terminal.
const SHOWN: usize = 24;

/// Drops the plate and prints its motion; `None` if the scene has no plate under a load.
pub(super) fn run(
    (scene, problem): (&Scene, &Problem),
    fidelity: Fidelity,
    (cycles, tolerance): (usize, f64),
    (json, folder): (bool, Option<&Folder<'_>>),
    cancel: &Cancel,
    command: &[String],
) -> Result<Option<Exit>, CliError> {
    let mut marched: Vec<Cycle> = Vec::new();
    let (ended, wall_s) = Bar::solve("").timed(|bar| {
        let mut each = |cycle: Cycle| {
            let (share, height) = (cycle.number as f64 / cycles as f64, significant(cycle.height.value * 1e6, 4));
            bar.share_done(share, &format!("cycle {}: {height} µm", cycle.number));
            marched.push(cycle);
        };
        fall(problem, fidelity, cycles, tolerance, &mut each, cancel)
    });
    let Some(ended) = ended? else { return Ok(None) };
    let (floats, validity) = (floats(&ended), validity(problem, &ended, &marched));
    let object = object(problem, fidelity, &ended, &marched, wall_s);
    ended.floats.as_ref().err().iter().for_each(|warning| terminal::warning(warning));
    let human = text(scene, &marched, &ended, (cycles, tolerance), floats, &validity);
    terminal::result(json, || json::document(&object, command), || human);
    terminal::note(&format!("{} in {}", counted(ended.cycles, "cycle", "cycles"), duration(wall_s)));
    if let Some(folder) = folder {
        let paths = files::fall(folder, (scene, problem), fidelity, (&ended, &marched), wall_s)?;
        terminal::wrote(folder.path, &paths);
    }
    Ok(Some(Exit::of(&ended.status)))
}

fn text(
    scene: &Scene,
    cycles: &[Cycle],
    ended: &Fall,
    (most, tolerance): (usize, f64),
    floats: Option<Estimate>,
    validity: &[ExceededLimit],
) -> String {
    let rests = cycles.last().is_some_and(|cycle| cycle.rests);
    let after = counted(ended.cycles, "cycle", "cycles");
    let how = match ended.status {
        Status::Converged if rests => format!("it rests after {after}"),
        Status::Converged => {
            let near = percent(tolerance);
            format!("it floats, within {near} of the height at which it settles, after {after}")
        }
        Status::NotResolved { .. } => {
            format!(
                "NOT RESOLVED after {after}: the plate bounces, and the errors of steps and grids have grown to half of its height"
            )
        }
        Status::NotConverged { .. } if ended.cycles < most => {
            format!("STILL MOVING after {after}, when the time allowed was up")
        }
        Status::NotConverged { .. } => format!("STILL MOVING after {after}; --cycles allows more"),
        Status::Cancelled => format!("CANCELLED after {after}"),
    };
    let beside = beside_headline(validity).map(|words| format!("; {words}")).unwrap_or_default();
    let mut text = heading(&format!("{}, dropped on its vibration: {how}{beside}", show_text(&scene.name)));
    let mut columns = Columns::headed(["cycle", "t, µs", "height, µm", "mean speed, mm/s"]);
    let every = cycles.len().div_ceil(SHOWN).max(1);
    for cycle in cycles {
        if cycle.number % every != 0 && cycle.number + 1 != cycles.len() {
            continue;
        }
        columns.row([
            cycle.number.to_string(),
            significant(cycle.time * 1e6, 4),
            with_error(cycle.height.value * 1e6, cycle.height.error * 1e6),
            significant(cycle.speed * 1e3, 3),
        ]);
    }
    text.push_str(&columns.text(&[0, 1, 2, 3]));
    if let Some(gap) = floats {
        let words = format!("The periodic solve, in which the plate does not shake, gives a mean gap of {gap} µm.");
        text.push_str(&paragraph(&words, "\n", ""));
    }
    if let Some(words) = struck(cycles) {
        text.push_str(&paragraph(&format!("{words}."), "\n", ""));
    }
    text.push_str(&limits(validity));
    text
}
