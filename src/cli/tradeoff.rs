//! `squeezefilm tradeoff`: error against time, measured now, on this machine.

use super::columns::{Columns, heading, paragraph};
use super::exit::{CliError, Exit};
use super::options::{MemoryOptions, OutputOptions, PRESET, SceneOptions, cancel_on_interrupt, whole};
use super::progress::Bar;
use super::terminal;
use crate::analysis::attempt::RunStatus;
use crate::analysis::quantity::Quantity;
use crate::analysis::tradeoff::{Effort, Target, Tradeoff, TradeoffPoint, candidates, measure};
use crate::digits::{duration, parse_duration, percent, significant};
use crate::export::files::Files;
use crate::export::tradeoff::{figure, object, settings};
use crate::export::{csv, json};
use crate::fidelity::parse_accuracy;
use crate::problem::Problem;
use crate::scene::show_text;
use crate::solve::{Settings, check};
use clap::Args;
use std::time::{Duration, Instant};

const EXAMPLES: &str = "\
Examples:
  squeezefilm tradeoff fundamental
  squeezefilm tradeoff fundamental --accuracy 1% --budget 16ms
  squeezefilm tradeoff levitating --repeats 9 --out results";

/// Measures error against solve time on this machine, for several accuracies, some grids and the paper's method
///
/// All but the paper's method solve the scene's own model, on different grids. Runs are interleaved and medians are reported. Errors are relative
/// to α (for a plate: to the film load). A setting is judged by the greater of two errors: its difference from the most accurate one
/// plus that one's stated error, and its own stated error. Takes up to about a minute.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    #[arg(value_name = "PRESET", help = PRESET)]
    preset: String,

    /// Recommends the cheapest setting with at most this error: 1% or 0.01
    #[arg(long, value_name = "ERROR", value_parser = parse_accuracy, allow_hyphen_values = true)]
    accuracy: Option<f64>,

    /// Recommends the most accurate setting within this time: 16ms, 2s or 1min
    #[arg(long, value_name = "TIME", value_parser = parse_duration, allow_hyphen_values = true)]
    budget: Option<Duration>,

    /// Runs of every setting [default: as many as fit into about a minute, 1 to 31]
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..=1000), allow_negative_numbers = true)]
    repeats: Option<u16>,

    #[command(flatten)]
    scene: SceneOptions,

    #[command(flatten)]
    memory: MemoryOptions,

    #[command(flatten)]
    output: OutputOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let scene = arguments.scene.scene(&arguments.preset)?;
    let problem = Problem::try_from(&scene)?;
    arguments.memory.apply();
    check(&problem, &Settings::default())?;
    let cancel = cancel_on_interrupt();
    let folder = arguments.output.folder(command)?;
    let effort = Effort { repeats: arguments.repeats.map(usize::from), ..Effort::default() };
    let bar = Bar::solve("");
    let started = Instant::now();
    let clock = || started.elapsed().as_secs_f64();
    let runs = measure(&problem, candidates(&problem), &effort, &clock, &cancel, &mut |runs, share| {
        let last = runs.iter().filter(|run| !run.times.is_empty()).min_by_key(|run| run.times.len());
        bar.share_done(share, last.map_or("", |run| &run.candidate.name));
    });
    let wall_s = clock();
    drop(bar);
    let tradeoff = Tradeoff::of(&runs);
    let human = text(&problem, &tradeoff);
    if cancel.is_cancelled() {
        terminal::note(&format!("cancelled; measurements so far:\n\n{human}"));
        return Ok(Exit::Other);
    }
    let budget = arguments.budget.map(|time| Target::Budget(time.as_secs_f64()));
    let targets = [arguments.accuracy.map(Target::Accuracy), budget];
    let targets: Vec<Target> = targets.into_iter().flatten().collect();
    let object = object(&scene.name, &tradeoff, &targets);
    let alone = arguments.scene.command(&arguments.preset) + &arguments.memory.option();
    let advice: String = targets.iter().map(|target| advice(&tradeoff, *target, &alone)).collect();
    terminal::result(arguments.output.json, || json::document(&object, command), || human + &advice);
    terminal::note(&format!("measured in {}", duration(wall_s)));
    if let Some(folder) = &folder {
        let mut files = Files::new(folder)?;
        files.add("tradeoff.csv", |out| csv::rows_of_ours(settings(&tradeoff), out))?;
        files.json("tradeoff.json", &object)?;
        let chosen: Vec<usize> = targets.iter().filter_map(|target| tradeoff.choose(*target)).collect();
        files.figure("tradeoff", &figure(&scene.name, &tradeoff, &chosen))?;
        terminal::wrote(folder.path, &files.commit()?);
    }
    // A target that no setting meets is a failure.
    let fulfilled = targets.iter().all(|target| tradeoff.choose(*target).is_some());
    Ok(if fulfilled { Exit::Solved } else { Exit::Other })
}

/// A recommendation in words, and the command to follow it; `alone` solves the scene as it is.
fn advice(tradeoff: &Tradeoff, target: Target, alone: &str) -> String {
    let asked = match target {
        Target::Accuracy(share) => format!("For an error of at most {}", percent(share)),
        Target::Budget(seconds) => format!("Within {}", duration(seconds)),
    };
    let Some(point) = tradeoff.choose(target).map(|i| &tradeoff.points[i]) else {
        return format!("\n{asked}: none of these.\n");
    };
    // The command is kept on one line, to be copied.
    format!(
        "\n{asked}: {}, {}, off by at most {}:\n  {alone} {}\n",
        point.run.candidate.name,
        duration(point.median),
        point.error.map_or_else(String::new, percent),
        point.run.candidate.options
    )
}

/// The table for people.
fn text(problem: &Problem, tradeoff: &Tradeoff) -> String {
    let judged = tradeoff.judged.label(problem);
    let mut text =
        heading(&format!("{}: error against solve time, measured now on this machine", show_text(&problem.name)));
    let mut columns = Columns::headed([
        "setting",
        "time",
        "quartiles",
        "runs",
        &judged,
        "error",
        "measured",
        "stated",
        "film steps",
        "rounds",
        "contacts",
        "",
    ]);
    for (i, point) in tradeoff.points.iter().enumerate() {
        columns.row(cells(point, tradeoff.judged, tradeoff.reference == Some(i)));
    }
    text.push_str(&columns.text(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 10]));
    text.push('\n');
    text.push_str(&paragraph(
        "measured: distance from the reference plus the reference's own stated error, relative to the value; stated: the error \
         that the run states; error: the greater of the two. best: no other setting is both faster and more accurate. Grids are film nodes along × across × \
         steps in a cycle, rounded up so that they can be halved twice.",
        "  ",
        "  ",
    ));
    text
}

fn cells(point: &TradeoffPoint, judged: Quantity, reference: bool) -> Vec<String> {
    let run = &point.run;
    let shown = |value: Option<f64>, show: &dyn Fn(f64) -> String| value.map_or_else(String::new, show);
    let count = |quantity: Quantity| shown(run.numbers.get(quantity), &|count| count.to_string());
    let time = |seconds: f64| if seconds.is_finite() { duration(seconds) } else { String::new() };
    let mark = match (&run.status, reference, point.best) {
        (_, true, _) => "reference".to_owned(),
        (RunStatus::Converged, _, true) => "best".to_owned(),
        (status, ..) => json::mark(&status.to_string()),
    };
    vec![
        run.candidate.name.clone(),
        time(point.median),
        format!("{} … {}", time(point.quartiles.0), time(point.quartiles.1)),
        run.times.len().to_string(),
        shown(run.numbers.get(judged), &|value| significant(value, 5)),
        shown(point.error, &percent),
        shown(point.measured, &percent),
        shown(point.stated, &percent),
        count(Quantity::FilmSteps),
        count(Quantity::Rounds),
        count(Quantity::ContactSolves),
        mark,
    ]
}
