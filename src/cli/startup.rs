//! `squeezefilm startup`: the transient from rest.

use super::columns::{Columns, heading, paragraph};
use super::exit::{CliError, Exit};
use super::fall;
use super::options::{CommonOptions, PRESET, whole, within};
use super::progress::Bar;
use super::summary::limits;
use super::terminal;
use crate::analysis::quantity::{Quantity, force_unit};
use crate::analysis::validity::{ExceededLimit, beside_headline};
use crate::digits::{counted, duration, percent, significant};
use crate::estimate::Estimate;
use crate::export::files;
use crate::export::json;
use crate::export::startup::{CycleRow, object, place, steady, validity, warnings};
use crate::fall::CYCLES;
use crate::problem::Problem;
use crate::scene::{Scene, show_text};
use crate::solution::{Accuracy, Status, StoppedBy};
use crate::solve::Method;
use crate::startup::{self, Cycle, Startup};
use clap::Args;

const EXAMPLES: &str = "\
Examples:
  squeezefilm startup fundamental
  squeezefilm startup frequency-100khz --fidelity fine --out results
  squeezefilm startup plate-trapped --cycles 500 --json
  squeezefilm startup floating-disc";

const FILES: &str = "\
Files of --out:
  startup.csv   a row for each cycle
  startup.json  what --json prints
  startup.svg   cycle means, and the film load at every instant; and startup.png
  scene.toml    the scene, as a preset";

/// Starts a preset from rest and follows it, cycle by cycle, until the cycle repeats
///
/// At t = 0 the wave is frozen at full amplitude, with the rotor pressed on it and the gas at ambient pressure; then it starts to travel.
/// A plate starts at rest at its mean gap and first moves away from the wall. Its cycles are counted from a quarter of a period later,
/// when the gap is widest. Every tooth is solved. The result is compared
/// with the periodic solve, which does not march in time: the two agree within their stated errors plus the remaining change, which
/// --tolerance bounds. Grids are refined until the main result of every cycle is as accurate as asked, relative to the largest of them.
///
/// A plate under a load is dropped instead, from twice the gap at which it floats, while the vibration builds up within four cycles. Its
/// height is computed until it no longer changes. The plate shakes a little with the vibration, unlike that of the periodic solve. A heavy
/// plate bounces for thousands of cycles, which may take a minute.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{FILES}\n\n{EXAMPLES}"))]
pub(super) struct Arguments {
    #[arg(value_name = "PRESET", help = PRESET)]
    preset: String,

    /// Maximum cycles; exit status 3 if the cycle does not repeat by then [default: 300; for a dropped plate, 5000]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..=100_000), allow_negative_numbers = true)]
    cycles: Option<u32>,

    /// Remaining relative change below which the cycle counts as repeating: of the gas p h at every node, and of α or the mean load. For a
    /// dropped plate, remaining relative change of its height below which it counts as floating
    #[arg(long, value_name = "CHANGE", default_value_t = startup::Settings::default().tolerance, value_parser = within(1e-8..=0.1, "a number"), allow_negative_numbers = true)]
    tolerance: f64,

    #[command(flatten)]
    common: CommonOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let scene = arguments.common.scene.scene(&arguments.preset)?;
    let problem = Problem::try_from(&scene)?;
    let (folder, chosen, cancel) = arguments.common.begin(command)?;
    if chosen.method == Method::Paper {
        return Err(CliError::usage("--method paper: a start-up is computed by our own method; allowed here: auto"));
    }
    let cycles = |otherwise| arguments.cycles.map_or(otherwise, |cycles| cycles as usize);
    let (output, limits) = ((arguments.common.output.json, folder.as_ref()), (cycles(CYCLES), arguments.tolerance));
    if let Some(exit) = fall::run((&scene, &problem), chosen.fidelity, limits, output, &cancel, command)? {
        return Ok(exit);
    }
    let usual = startup::Settings::default();
    let (cycles, tolerance) = (cycles(usual.cycles), arguments.tolerance);
    let settings = startup::Settings { fidelity: chosen.fidelity, cycles, tolerance, ..usual };

    let mut marched: Vec<Cycle> = Vec::new();
    let (ended, wall_s) = Bar::solve("").timed(|bar| {
        let mut each = |cycle: Cycle| {
            let row = CycleRow::of(&problem, &cycle);
            let main = significant(row.numbers.main().value, 4);
            if row.cycle > marched.len() {
                bar.share_done(row.share(&settings), &format!("cycle {}: {main}", row.cycle));
            } else {
                bar.share_done(1.0, &format!("cycle {} on finer grids: {main}", row.cycle));
            }
            place(&mut marched, cycle.number, cycle.slim());
        };
        startup::startup(&problem, &settings, &mut each, &cancel)
    });
    let ended = ended?;
    arguments.common.solve.tell_if_late("the start-up", wall_s);
    let rows: Vec<CycleRow> = marched.iter().map(|cycle| CycleRow::of(&problem, cycle)).collect();
    let steady = steady(&problem, &ended);
    let validity = validity(&problem, &ended);
    let object = object(&problem, &settings, &ended, &rows, wall_s);
    warnings(&ended).iter().for_each(|warning| terminal::warning(warning));
    let human = text((&scene, &problem), &rows, (&ended, &validity), steady);
    terminal::result(arguments.common.output.json, || json::document(&object, command), || human);
    let cycles = counted(ended.cycles, "cycle", "cycles");
    terminal::note(&format!("{cycles}, {} film steps in {}", ended.stats.film_steps, duration(wall_s)));
    if let Some(folder) = &folder {
        let paths = files::startup(folder, (&scene, &problem), &settings, (&ended, &marched), wall_s)?;
        terminal::wrote(folder.path, &paths);
    }
    Ok(Exit::of(&ended.status))
}

/// Cycles shown to people at the beginning, and as powers of two after that.
const SHOWN: usize = 8;

fn text(
    (scene, problem): (&Scene, &Problem),
    rows: &[CycleRow],
    (ended, validity): (&Startup, &[ExceededLimit]),
    steady: Option<Estimate>,
) -> String {
    let how = match ended.status {
        Status::Converged => format!("the cycle repeats after {}", ended.cycles),
        Status::NotConverged { .. } if ended.stats.unsettled_steps > 0 => {
            format!("NOT CONVERGED in some steps, {}", counted(ended.cycles, "cycle", "cycles"))
        }
        Status::NotConverged { .. } | Status::NotResolved { .. } => {
            format!("NOT REPEATING after {}; --cycles allows more", ended.cycles)
        }
        Status::Cancelled => format!("CANCELLED after {}", ended.cycles),
    };
    let beside = beside_headline(validity).map(|words| format!("; {words}")).unwrap_or_default();
    let mut text = heading(&format!("{}, start-up from rest: {how}{beside}", show_text(&scene.name)));
    let motor = scene.scene() == "motor";
    let unit = force_unit(problem);
    let main = if motor { "film share α" } else { "load ratio" };
    let mut columns = Columns::headed([
        "cycle",
        "t, µs",
        main,
        &format!("film load, {unit}"),
        "least film thickness, nm",
        "highest p, kPa",
        "change of ln(p h)",
    ]);
    for row in rows {
        let last = row.cycle == rows.len();
        if row.cycle > SHOWN && !row.cycle.is_power_of_two() && !last {
            continue;
        }
        columns.row([
            row.cycle.to_string(),
            significant(row.time_us, 4),
            row.numbers.main().to_string(),
            row.numbers.text(Quantity::FilmLoad),
            row.numbers.text(Quantity::MinGap),
            row.numbers.text(Quantity::MaxPressure),
            significant(row.change, 2),
        ]);
    }
    text.push_str(&columns.text(&[0, 1, 2, 3, 4, 5, 6]));
    if let Some(found) = steady {
        let mut words = format!("The periodic solve, without marching, gives {main} = {found}.");
        let off = |last: Estimate| (last.value - found.value).abs() > last.error + found.error;
        if rows.last().is_some_and(|row| off(row.numbers.main())) {
            words.push_str(" The ± of the last cycle does not include the change still to come.");
        }
        text.push_str(&paragraph(&words, "\n", ""));
    }
    if ended.accuracy.stated.is_finite() {
        text.push_str(&paragraph(&exactness(&ended.accuracy), "", ""));
    }
    text.push_str(&limits(validity));
    text
}

/// The stated error and the one asked for, in a sentence.
fn exactness(accuracy: &Accuracy) -> String {
    let mut text =
        format!("The stated error of each cycle mean is at most {} of the largest mean", percent(accuracy.stated));
    if accuracy.asked > 0.0 {
        text.push_str(&format!(" ({} asked for)", percent(accuracy.asked)));
    }
    text.push_str(match accuracy.stopped_by {
        StoppedBy::Accuracy => ".",
        StoppedBy::Budget => "; the time allowed was up.",
        StoppedBy::Limit if accuracy.asked > 0.0 => "; finer grids would not reduce it, or would take too long.",
        StoppedBy::Limit => ", on the grids of the scene.",
    });
    text
}
