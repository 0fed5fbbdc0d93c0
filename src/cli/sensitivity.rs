//! `squeezefilm sensitivity`: derivatives of the results with respect to every key, and the effect of uncertain keys on the results.

use super::columns::{Columns, heading, paragraph};
use super::exit::{CliError, Exit};
use super::options::{CommonOptions, PRESET, pair, whole};
use super::progress::Bar;
use super::terminal;
use crate::analysis::sensitivity::{MonteCarlo, Sensitivity, Uncertainties, Uncertainty};
use crate::digits::{capitalised, counted, duration, percent, rounded, significant, with_error};
use crate::export::files;
use crate::export::json;
use crate::export::sensitivity::SensitivityStudy;
use crate::problem::Problem;
use crate::scene::show_text;
use crate::solve::{Method, check};
use clap::Args;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  squeezefilm sensitivity fundamental
  squeezefilm sensitivity fundamental --keys film.min_spacing_nm,motor.load_per_wave_n --json
  squeezefilm sensitivity fundamental --uncertainty film.min_spacing_nm=20% \\
      --uncertainty film.viscosity_upa_s=0.2
  squeezefilm sensitivity fundamental --uncertainty film.min_spacing_nm=±30 --monte-carlo 500 \\
      --out results";

const FILES: &str = "\
Files of --out:
  sensitivity.csv   a row for each result and key: derivative, elasticity, errors, share of the uncertainty
  sensitivity.json  what --json prints
  sensitivity.svg   a tornado chart for each result: its change for 1 % more of each key; and sensitivity.png
  uncertainty.svg   with --uncertainty: the same for one standard deviation more of each uncertain key; and uncertainty.png
  monte-carlo.csv   with --monte-carlo: a row for each draw, its results with their errors
  monte-carlo.svg   with --monte-carlo: a histogram of each result; and monte-carlo.png
  scene.toml        the scene, as a preset";

/// Shows how the results depend on each parameter, and how parameter uncertainties affect them
///
/// Derivatives of α, stall torque and no-load speed (for a plate: load, stiffness and damping) with respect to every numeric key are
/// computed from solves on one set of grids. Each has its own error. 1 % of a temperature is 1 % of its value in kelvins. Parameter
/// uncertainties give an uncertainty of each result, apart from the numerical error.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{FILES}\n\n{EXAMPLES}"), mut_arg("budget", |budget| budget.hide(true)))]
pub(super) struct Arguments {
    #[arg(value_name = "PRESET", help = PRESET)]
    preset: String,

    /// Only these keys, separated by commas [default: all in use, except whole numbers and values of the parts of a ring]
    #[arg(long, value_name = "KEYS", value_delimiter = ',')]
    keys: Vec<String>,

    /// Uncertainty of a key; may be repeated
    ///
    /// A standard deviation in the unit of the key or in per cent of its value: film.min_spacing_nm=20% or =40. With ± in front it is
    /// a limit, and all values between are equally likely. Keys are independent of each other.
    #[arg(long = "uncertainty", value_name = "KEY=AMOUNT", value_parser = uncertainty)]
    uncertainties: Vec<(String, Uncertainty)>,

    /// Also solves this many random scenes drawn from the uncertainties
    #[arg(long, value_name = "N", requires = "uncertainties", value_parser = whole::<u32>(2..=1_000_000), allow_negative_numbers = true)]
    monte_carlo: Option<u32>,

    /// Seed of the random numbers: the same seed draws the same scenes
    #[arg(long, value_name = "SEED", default_value_t = 1, requires = "monte_carlo", allow_negative_numbers = true)]
    seed: u64,

    #[command(flatten)]
    common: CommonOptions,
}

fn uncertainty(text: &str) -> Result<(String, Uncertainty), String> {
    let (key, amount) = pair(text)?;
    Ok((key, amount.parse()?))
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let scene = arguments.common.scene.scene(&arguments.preset)?;
    let uncertainties = Uncertainties::new(&scene, &arguments.uncertainties)?;
    let mut keys = arguments.keys.clone();
    if !keys.is_empty() {
        keys.extend(
            arguments.uncertainties.iter().map(|(key, _)| key.clone()).filter(|key| !arguments.keys.contains(key)),
        );
    }
    let (folder, settings, cancel) = arguments.common.begin(command)?;
    if settings.method == Method::Paper {
        return Err(CliError::usage("--method paper: sensitivities are those of our own method; allowed here: auto"));
    }
    if arguments.common.solve.accuracy.budget.is_some() {
        return Err(CliError::usage(
            "--budget: solves that are compared must be equally accurate; allowed here: --fidelity or --accuracy",
        ));
    }
    check(&Problem::try_from(&scene)?, &settings)?;
    let draws = arguments.monte_carlo.unwrap_or(0) as usize;

    let started = Instant::now();
    let bar = Bar::solve("");
    let count = AtomicUsize::new(0);
    let solved = |all: usize, what: &str| {
        let done = count.fetch_add(1, Ordering::Relaxed) + 1;
        bar.share_done(done as f64 / all.max(1) as f64, what);
    };
    let sensitivity = Sensitivity::of(&scene, &keys, &settings, &cancel, &|all| solved(all, "derivatives"))?;
    count.store(0, Ordering::Relaxed);
    let carlo = sensitivity.as_ref().filter(|_| draws > 0).and_then(|sensitivity| {
        sensitivity.monte_carlo(&uncertainties, draws, arguments.seed, &cancel, &|| solved(draws, "random scenes"))
    });
    let wall_s = started.elapsed().as_secs_f64();
    drop(bar);
    let Some(sensitivity) = sensitivity else {
        terminal::note("cancelled; nothing was written");
        return Ok(Exit::Other);
    };

    sensitivity.warnings.iter().for_each(|warning| terminal::warning(warning));
    if let Some(warning) = carlo.as_ref().and_then(warning) {
        terminal::warning(&warning);
    }
    let found = SensitivityStudy { sensitivity: &sensitivity, uncertainties: &uncertainties, carlo: carlo.as_ref() };
    terminal::result(arguments.common.output.json, || json::document(&found.object(), command), || text(&found));
    let made = carlo.as_ref().map_or(0, |carlo| carlo.draws.len() + carlo.failures.len());
    if made < draws {
        terminal::warning(&format!("cancelled: {made} of {draws} random scenes were drawn"));
    }
    terminal::note(&format!("computed in {}", duration(wall_s)));
    if let Some(folder) = &folder {
        terminal::wrote(folder.path, &files::sensitivity(folder, &found)?);
    }
    Ok(if made < draws { Exit::Other } else { Exit::of(&sensitivity.status) })
}

/// Warning about random scenes that failed or were drawn again; `None` if there are none.
fn warning(carlo: &MonteCarlo) -> Option<String> {
    let all = carlo.draws.len() + carlo.failures.len();
    let failed = carlo.failures.first().map(|first| {
        format!(
            "{} of {all} random scenes could not be solved and are missing, the first because {first}",
            carlo.failures.len()
        )
    });
    let redrawn = (carlo.redrawn > 0).then(|| {
        let scenes = counted(carlo.redrawn, "random scene was", "random scenes were");
        format!("{scenes} outside of what is allowed and drawn again, which makes the spread smaller")
    });
    let all: Vec<String> = failed.into_iter().chain(redrawn).collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// An elasticity below this is round-off, and is shown as 0.
const NOTHING: f64 = 1e-9;

/// The result for people: elasticities by key, and the effect of uncertain keys on the results.
fn text(found: &SensitivityStudy<'_>) -> String {
    let sensitivity = found.sensitivity;
    let (problem, outputs) = (&sensitivity.problem, sensitivity.outputs);
    let name = show_text(&sensitivity.scene().name);
    let mut text =
        heading(&format!("{name}: change of each result, in per cent, for a 1 % increase of each parameter"));
    let mut columns =
        Columns::headed(std::iter::once(String::new()).chain(outputs.iter().map(|output| output.label(problem))));
    let values = sensitivity
        .values
        .iter()
        .map(|found| if found.value.is_finite() { found.to_string() } else { "none".to_owned() });
    columns.row(std::iter::once("value".to_owned()).chain(values));
    let greatest = |column: usize| {
        let of = |output: usize| sensitivity.elasticity(output, column).map_or(0.0, |found| found.value.abs());
        let headline = of(0);
        (
            sensitivity.columns[column].scale().is_some(),
            if headline > 0.0 { headline } else { (1..outputs.len()).map(of).fold(0.0, f64::max) },
        )
    };
    let mut order: Vec<usize> = (0..sensitivity.columns.len()).collect();
    order.sort_by(|a, b| {
        let (a, b) = (greatest(*a), greatest(*b));
        b.0.cmp(&a.0).then(b.1.total_cmp(&a.1))
    });
    for column in &order {
        let by = &sensitivity.columns[*column];
        let relative = by.scale().is_some();
        let key = if relative {
            by.parameter.key.to_owned()
        } else {
            format!("{} (per {})", by.parameter.key, by.parameter.unit)
        };
        let unit = if relative { 1.0 } else { 100.0 };
        let cell = |output: usize| match sensitivity.elasticity(output, *column) {
            Some(found) if found.value.abs() + found.error < NOTHING => "0".to_owned(),
            Some(found) => (found * unit).to_string(),
            None => "none".to_owned(),
        };
        columns.row(std::iter::once(key).chain((0..outputs.len()).map(cell)));
    }
    let right: Vec<usize> = (1..=outputs.len()).collect();
    text.push_str(&columns.text(&right));
    for column in sensitivity.columns.iter().filter(|column| column.parameter.unit == "°C") {
        let absolute = column.scale().map_or_else(String::new, |kelvins| significant(kelvins, 5));
        let words = format!("1 % of {} is 1 % of its {absolute} K above absolute zero.", column.parameter.key);
        text.push_str(&paragraph(&words, "\n", ""));
    }
    let unknown =
        sensitivity.columns.iter().filter_map(|column| Some((column.parameter.key, column.slopes.as_ref().err()?)));
    for (key, why) in unknown {
        text.push_str(&paragraph(&format!("No derivative with respect to {key}: {why}"), "\n", ""));
    }
    let whole = sensitivity.whole();
    if !whole.is_empty() {
        text.push_str(&paragraph(&format!("Whole numbers have no derivative: {}.", whole.join(", ")), "\n", ""));
    }
    if !found.uncertainties.is_empty() {
        text.push_str(&uncertain(found));
    }
    text
}

/// A number rounded to so many digits, a large whole number too: `4123000`. Numbers with an error are rounded in the same way.
fn to_digits(value: f64, digits: usize) -> String {
    significant(rounded(value, digits), digits)
}

fn uncertain(found: &SensitivityStudy<'_>) -> String {
    let sensitivity = found.sensitivity;
    let problem = &sensitivity.problem;
    let given = found.uncertainties.iter().map(|(parameter, at, given)| {
        let deviation = significant(given.deviation(at), 3);
        format!("{} = {} ({})", parameter.key, parameter.with_unit(at), parameter.with_unit(deviation))
    });
    let given: Vec<String> = given.collect();
    let mut text = paragraph(&format!("Uncertain parameters (standard deviation): {}", given.join(", ")), "\n", "");
    text.push('\n');
    let mut head = vec!["", "value", "std. dev. from parameters", "numerical error", "largest contribution"];
    if found.carlo.is_some() {
        head.extend(["Monte Carlo (std. dev.)", "5 % … 95 %"]);
    }
    let mut columns = Columns::headed(head);
    let (mut beyond, mut bent, mut missing) = (Vec::new(), Vec::new(), Vec::new());
    for (i, output) in sensitivity.outputs.iter().enumerate() {
        let value = sensitivity.values[i];
        if !value.value.is_finite() {
            continue;
        }
        let propagated = sensitivity.propagated(i, found.uncertainties);
        let mut parts = propagated.parts.clone();
        parts.sort_by(|a, b| b.1.value.abs().total_cmp(&a.1.value.abs()));
        let most = parts.first().and_then(|(parameter, _)| Some((parameter.key, propagated.share(parameter)?)));
        let mut row = vec![
            output.label(problem),
            to_digits(value.value, 4),
            to_digits(propagated.deviation.value, 2),
            if value.error.is_finite() { format!("± {}", to_digits(value.error, 2)) } else { String::new() },
            most.map_or_else(String::new, |(key, share)| format!("{key}, {}", percent(share))),
        ];
        if propagated.deviation.value > value.value.abs() {
            beyond.push(output.words());
        }
        if let Some(carlo) = found.carlo {
            let spread = carlo.spread(i);
            if spread.as_ref().is_some_and(|spread| spread.is_off(value)) {
                bent.push(output.words());
            }
            if spread.is_none() {
                missing.push(output.words());
            }
            row.push(spread.as_ref().map_or_else(String::new, |spread| {
                format!("{} ({})", with_error(spread.mean, spread.mean_error()), to_digits(spread.deviation, 2))
            }));
            row.push(
                spread.map_or_else(String::new, |spread| format!("{} … {}", spread.quantiles[0], spread.quantiles[2])),
            );
        }
        columns.row(row);
    }
    text.push_str(&columns.text(&[1]));
    if let Some(carlo) = found.carlo {
        text.push_str(&format!("\n{} random scenes, seed {}.\n", carlo.draws.len(), carlo.seed));
    }
    let mut remark = |of: &[&str], what: &str| {
        if !of.is_empty() {
            text.push_str(&paragraph(&format!("{}: {what}", capitalised(&of.join(", "))), "\n", ""));
        }
    };
    if found.carlo.is_none() {
        remark(
            &beyond,
            "more uncertain than they are large, to first order; --monte-carlo 500 shows the effect of such large changes.",
        );
    }
    remark(&missing, "fewer than two of the random scenes have such a result.");
    let again = if found.carlo.is_some_and(|carlo| carlo.redrawn > 0) {
        ", or because draws outside of the ranges were drawn again"
    } else {
        ""
    };
    let words = format!(
        "the mean of the random scenes is not the value, because the results do not change in proportion to the parameters{again}. Here the range is more informative than the standard deviation."
    );
    remark(&bent, &words);
    text
}
