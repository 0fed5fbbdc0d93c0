//! `squeezefilm fit`: values of keys that agree best with measurements, or that maximise or minimise one result.

use super::columns::{Columns, heading, paragraph};
use super::exit::{CliError, Exit};
use super::options::{CommonOptions, PRESET, STANDARD_INPUT, spare_inputs, standard_input, whole};
use super::progress::Bar;
use super::terminal;
use crate::analysis::fit::{
    Bound, Bounds, ErrorSize, Fitted, Goal, LARGEST_TABLE, Limit, MOST_STARTS, Measured, Optimum, fit, optimise,
};
use crate::digits::{counted, duration, percent, short, signed, significant};
use crate::export::files;
use crate::export::fit as export;
use crate::export::json;
use crate::problem::Problem;
use crate::scene::{Parameter, Scene, show_text};
use clap::{ArgGroup, Args};
use serde_json::Value;

const EXAMPLES: &str = "\
Examples:
  squeezefilm fit fundamental --data table1 --vary film.min_spacing_nm=100:400 \\
      --vary stator.normal_amplitude_um=0.8:2
  squeezefilm fit my.toml --data torque.csv --vary motor.dry_friction=0.1:1 \\
      --vary stator.tangential_amplitude_um=0.2:3
  squeezefilm fit my.toml --data loads.csv --error 2% --vary film.min_spacing_nm=20:1000 \\
      --starts 50 --out fitted
  squeezefilm fit fundamental --maximise stall_torque_nm --vary motor.load_per_wave_n=0.5:10 \\
      --vary stator.tooth_width_mm=0.6:2.8
  squeezefilm fit fundamental --minimise alpha --vary stator.frequency_khz=20:80 \\
      --subject-to 'stall_torque_nm>0.2'";

const DATA: &str = "\
A table of measurements is a CSV file, with commas, semicolons or tabs
between the columns. Its first line names them:
  film.min_spacing_nm   a key of the scene: the condition under which the
                        line was measured; --vary chooses the key only where
                        the cell is empty
  film_load_n           a measured result, by its name in --json
  rotor_speed_rpm, torque_nm
                        torque of the ring at a rotor speed; all lines
                        of one condition share one solve
  film_load_n_error     the standard error of a measured column
  weight                how much the line counts, where errors are not known
  row, name, note       text
Empty cells were not measured, or leave the condition as in the preset.
If no errors are given, those of a column are taken to be equal, and their
size is estimated from the residuals.

Files of --out:
  fit.json     what --json prints
  fit.csv      measured, computed, residual: a row for each measurement
  fit, residuals, correlation (.svg .png)
               figures; for an optimum, lines through it: optimum.csv and
               optimum (.svg .png)
  fitted.toml  the preset with the values found";

/// Fits keys of a preset to measurements, or finds the values that maximise or minimise one result
///
/// A fit minimises the sum of ((computed − measured)/error)² within the bounds by least squares, and reports values, standard errors,
/// correlations and residuals. `table1` is a built-in table of measurements: Table I of Maeno and Bogy (1992).
#[derive(Debug, Args)]
#[command(
    after_help = EXAMPLES,
    after_long_help = format!("{DATA}\n\n{EXAMPLES}"),
    group = ArgGroup::new("sought").args(["data", "maximise", "minimise"]).required(true),
)]
pub(super) struct Arguments {
    #[arg(value_name = "PRESET", help = PRESET)]
    preset: String,

    /// A CSV file of measurements, - for one on standard input, or table1
    #[arg(long, value_name = "FILE", conflicts_with = "subject_to")]
    data: Option<String>,

    /// A key to vary, with bounds in the key's unit or another of its kind; may be repeated
    ///
    /// The search begins at the value in the preset or from --set, or, if that is not within the bounds, in their middle. Bounds
    /// with a ratio of ten or more are searched on a log scale; :log and :lin override this.
    #[arg(long, value_name = "KEY=FROM:TO[:log]", required = true)]
    vary: Vec<Bounds>,

    /// Standard errors of the measurements: 1%, 0.005 or film_load_n=1%; may be repeated
    #[arg(long, value_name = "[NAME=]SIZE", conflicts_with_all = ["maximise", "minimise"])]
    error: Vec<ErrorSize>,

    /// Leaves out a line of the table: its name, or `line 7`; may be repeated
    #[arg(long, value_name = "LINE", conflicts_with_all = ["maximise", "minimise"])]
    skip: Vec<String>,

    /// Number of starting points: the values of the preset and, if more than one, points spread over the bounds. Those are solved as
    /// drafts; the search then starts from the preset and from up to three of the best drafts that are far enough apart
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole::<u16>(1..=MOST_STARTS), allow_negative_numbers = true)]
    starts: u16,

    /// Maximises this result, by its name in --json
    #[arg(long, value_name = "NAME")]
    maximise: Option<String>,

    /// Minimises this result
    #[arg(long, value_name = "NAME")]
    minimise: Option<String>,

    /// A limit on another result at the optimum: alpha<30% or stall_torque_nm>0.2; may be repeated
    #[arg(long, value_name = "NAME<VALUE")]
    subject_to: Vec<Limit>,

    #[command(flatten)]
    common: CommonOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let varied: Vec<&str> = arguments.vary.iter().map(|bounds| bounds.key.as_str()).collect();
    let scene = arguments.common.scene.scene_varied(&arguments.preset, &varied)?;
    let (folder, settings, cancel) = arguments.common.begin(command)?;
    let greatest = arguments.maximise.as_ref().map(|name| (name, true));
    let sought = greatest.or(arguments.minimise.as_ref().map(|name| (name, false)));
    let starts = usize::from(arguments.starts);
    let preset = &scene.name;
    let tell = |object: &Value, text: &str, warnings: &[String], solves: usize, wall_s: f64| {
        let json = arguments.common.output.json;
        terminal::result(json, || json::document(object, command), || text.to_owned());
        warnings.iter().for_each(|warning| terminal::warning(warning));
        terminal::note(&format!("{solves} solves in {}", duration(wall_s)));
    };
    let (files, converged) = if let Some((name, greatest)) = sought {
        folder.iter().try_for_each(|folder| spare_inputs(folder, &["fitted.toml"]))?;
        let goal = Goal::new(&scene, name, greatest, &arguments.subject_to)?;
        let (found, wall_s) = Bar::solve("").timed(|bar| {
            let report =
                |points: usize, best: f64| bar.count(&format!("{points} points, {name} {}", significant(best, 5)));
            optimise(&scene, &arguments.vary, &goal, &settings, (starts, &cancel, &report as _))
        });
        let Some(found) = found? else { return Ok(cancelled()) };
        let problem = Problem::try_from(&found.scene)?;
        let text = optimum_text(&scene, &problem, &found);
        tell(&export::optimum(preset, &found), &text, &found.warnings, found.solves, wall_s);
        (folder.as_ref().map(|folder| files::optimum(folder, &problem, preset, &found)), found.converged)
    } else {
        let Some(data) = &arguments.data else {
            return Err(CliError::usage("give --data, --maximise or --minimise"));
        };
        let measured = if data == STANDARD_INPUT {
            let table = standard_input(LARGEST_TABLE)?;
            Measured::from_csv(&table, "standard input", &Problem::try_from(&scene)?)?
        } else {
            Measured::find(data, &scene, settings.method)?
        };
        folder.iter().try_for_each(|folder| spare_inputs(folder, &["fit.csv", "fitted.toml"]))?;
        let measured = measured.without(&arguments.skip)?.with_errors(&arguments.error)?;
        let (fitted, wall_s) = Bar::solve("").timed(|bar| {
            let report = |points: usize, chi_squared: f64| {
                bar.count(&format!("{points} points, χ² {}", significant(chi_squared, 4)));
            };
            fit(&scene, &arguments.vary, &measured, &settings, (starts, &cancel, &report as _))
        });
        let Some(fitted) = fitted? else { return Ok(cancelled()) };
        let problem = Problem::try_from(&fitted.scene)?;
        let object = export::object(preset, &fitted, &measured);
        tell(&object, &text(&scene, &fitted, &measured), &fitted.warnings, fitted.solves, wall_s);
        (folder.as_ref().map(|folder| files::fitted(folder, &problem, preset, &fitted, &measured)), fitted.converged)
    };
    if let (Some(folder), Some(files)) = (&folder, files) {
        terminal::wrote(folder.path, &files?);
    }
    Ok(if converged { Exit::Solved } else { Exit::NotConverged })
}

fn cancelled() -> Exit {
    terminal::note("cancelled before anything was found");
    Exit::Other
}

fn bounds((from, to): (f64, f64), parameter: &Parameter) -> String {
    parameter.with_unit(format!("{} … {}", short(from, 5), short(to, 5)))
}

fn at_bound(at: Option<Bound>) -> String {
    at.map_or_else(String::new, |bound| format!("AT ITS {} BOUND", bound.name().to_uppercase()))
}

/// A fit for people.
fn text(scene: &Scene, fitted: &Fitted, measured: &Measured) -> String {
    let title = format!("{}, fitted to {}", show_text(&scene.name), measured.name);
    let mut text = heading(&title);
    let mut columns = Columns::headed(["key", "value ± standard error", "start", "bounds", ""]);
    for found in &fitted.unknowns {
        let parameter = found.unknown.parameter;
        columns.row([
            parameter.key.to_owned(),
            found.in_words(),
            short(found.unknown.start, 5),
            bounds((found.unknown.from, found.unknown.to), parameter),
            at_bound(found.at),
        ]);
    }
    text.push_str(&columns.text(&[2]));
    if fitted.unknowns.len() > 1 {
        text.push_str("\nCorrelation:\n\n");
        let mut columns = Columns::new();
        for (i, found) in fitted.unknowns.iter().enumerate() {
            let cells = fitted.correlation[i][..=i].iter();
            let cells =
                cells.map(|value| if value.is_finite() { signed(format!("{value:.2}")) } else { "–".to_owned() });
            columns.row(std::iter::once(found.unknown.parameter.key.to_owned()).chain(cells));
        }
        text.push_str(&columns.text(&(1..=fitted.unknowns.len()).collect::<Vec<_>>()));
    }
    text.push('\n');
    text.push_str(&paragraph(&summary(fitted, measured), "", ""));
    text.push('\n');
    let mut columns = Columns::headed(["row", "measured", "", "computed", "difference", "residual"]);
    for (one, row) in measured.measurements.iter().zip(&fitted.rows) {
        let (computed, difference) = match &row.computed {
            Ok(found) => (found.to_string(), percent(found.value / one.value - 1.0)),
            Err(why) => (why.clone(), String::new()),
        };
        let residual = row.residual.map_or_else(|| "LEFT OUT".to_owned(), |residual| signed(format!("{residual:.2}")));
        columns.row([
            one.label.clone(),
            one.what.name().to_owned(),
            short(one.value, 6),
            computed,
            difference,
            residual,
        ]);
    }
    text.push_str(&columns.text(&[2, 4, 5]));
    text
}

/// How well a fit agrees, in sentences.
fn summary(fitted: &Fitted, measured: &Measured) -> String {
    let used = fitted.rows.iter().filter(|row| row.residual.is_some()).count();
    let freedom = counted(fitted.degrees_of_freedom, "degree of freedom", "degrees of freedom");
    let counts = format!("{}, {freedom}", counted(used, "measurement", "measurements"));
    let agreement = match fitted.error_scale {
        _ if fitted.errors_known => {
            format!("χ² = {} of {counts}, with the errors that were given.", significant(fitted.chi_squared, 4))
        }
        Some(_) => {
            let shares = measured.measurements.iter().zip(&fitted.rows).map(|(one, row)| row.error / one.value.abs());
            let (least, most) = shares
                .fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), share| (least.min(share), most.max(share)));
            let size =
                if most < 1.01 * least { percent(least) } else { format!("{} to {}", percent(least), percent(most)) };
            format!(
                "{counts}. No errors were given: the residuals say that one standard error of a measurement is {size} of its value, \
                 and all standard errors below are based on this estimate."
            )
        }
        None => format!("{counts}. No errors were given, and they cannot be estimated."),
    };
    let known = fitted.errors_known || fitted.error_scale.is_some();
    match fitted.numerical_error.filter(|_| known) {
        Some(worst) => format!(
            "{agreement} The numerical error of what is computed is at most {} standard errors of a measurement.",
            significant(worst, 2)
        ),
        None => agreement,
    }
}

/// An optimum for people.
fn optimum_text(scene: &Scene, problem: &Problem, found: &Optimum) -> String {
    let size = if found.goal.greatest { "large" } else { "small" };
    let title = format!("{}: {}, as {size} as possible", show_text(&scene.name), found.goal.quantity.label(problem));
    let mut text = heading(&title);
    let mut columns = Columns::new();
    let before = found.before.map_or_else(
        || "cannot be solved at the start of the search".to_owned(),
        |before| format!("{before} at the start of the search"),
    );
    columns.row([found.goal.quantity.name().to_owned(), found.value.to_string(), before]);
    for ((limit, quantity), reached) in found.goal.limits.iter().zip(&found.limited) {
        columns.row([quantity.name().to_owned(), reached.to_string(), limit.in_words(reached)]);
    }
    text.push_str(&columns.text(&[]));
    text.push('\n');
    let mut columns = Columns::headed([
        "key".to_owned(),
        "value".to_owned(),
        "bounds".to_owned(),
        format!("within {} of the optimum", percent(found.flatness())),
        String::new(),
    ]);
    for line in &found.lines {
        let parameter = line.unknown.parameter;
        let (value, flat) = line.in_digits();
        columns.row([
            parameter.key.to_owned(),
            parameter.with_unit(value),
            bounds((line.unknown.from, line.unknown.to), parameter),
            flat.map_or_else(|| "–".to_owned(), |ends| parameter.with_unit(ends.join(" … "))),
            at_bound(line.at),
        ]);
    }
    text.push_str(&columns.text(&[]));
    text
}
