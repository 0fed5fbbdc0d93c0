//! `squeezefilm solve`: one scene's periodic steady state.

use super::exit::{CliError, Exit};
use super::interrupt::cancel_on_interrupt;
use super::options::{FigureFormat, OutputOptions, SceneOptions, SolveOptions, figure_format};
use super::progress::Bar;
use super::{summary, terminal};
use crate::analysis::torque::Merit;
use crate::control::{Cancel, Progress};
use crate::export::csv;
use crate::export::figure::{FigureError, Format, to_bytes};
use crate::export::figures;
use crate::export::folder::Staged;
use crate::export::json::{Summary, force_unit};
use crate::export::merit::{MeritObject, write_csv};
use crate::export::npz;
use crate::fidelity::Fidelity;
use crate::motor::MotorError;
use crate::problem::{Problem, Scenario};
use crate::scene::Scene;
use crate::solution::{Outcome, Solution, Status};
use crate::solve::{Method, solve};
use clap::Args;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  squeezefilm solve fundamental
  squeezefilm solve fundamental --set film.min_spacing_nm=100 --set stator.tooth_radius_m=3
  squeezefilm solve my.toml --fidelity fine --json | jq .alpha
  squeezefilm solve levitating --out results";

const FILES: &str = "\
Files of --out, with the unit in every column's name:
  summary.json   what --json prints
  scene.toml     the scene as solved, changes included: a preset again
  series.csv     loads, teeth in contact, least film thickness and
                 highest pressure, over one cycle
  fields.csv     surfaces, film thickness and line loads at every node of
                 every tooth, over one cycle; a line load × length_m,
                 summed over one time_s, is the load in series.csv
  pressure.csv   pressure under one tooth, over one cycle
  fields.npz     all of these fields as NumPy arrays: numpy.load
  torque.csv     torque, power and efficiency of a motor over the speed of
                 its rotor, with the film and without (dry_)
  wave, loads, map, torque, convergence (.svg .png)
                 figures of a motor: surfaces and pressures along the
                 wave, loads over the cycle, pressure map, torque and
                 power over speed, rounds of the solve
  profile, loads, loop, map, exact, convergence (.svg .png)
                 figures of a plate; exact: beside what is known exactly
Of a symmetric film only the half that was solved is there: y_m >= 0,
and of a plate x_m >= 0 as well.";

/// Solves a preset for its periodic steady state and prints a summary
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{FILES}\n\n{EXAMPLES}"))]
pub(super) struct Arguments {
    /// A built-in preset (see: squeezefilm presets) or the path of a TOML file
    #[arg(value_name = "PRESET")]
    preset: String,

    #[command(flatten)]
    scene: SceneOptions,

    #[command(flatten)]
    solve: SolveOptions,

    #[command(flatten)]
    output: OutputOptions,

    /// Formats of the figures in --out: svg, png, pdf; none for no figures
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', requires = "out", default_values = ["svg", "png"], value_parser = figure_format())]
    figures: Vec<FigureFormat>,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let scene = arguments.scene.scene(&arguments.preset)?;
    let problem = Problem::new(&scene)?;
    let settings = arguments.solve.prepare(Fidelity::default(), Method::default())?;
    let cancel = cancel_on_interrupt();

    let mut bar = Bar::solve(force_unit(&problem));
    let started = Instant::now();
    let solved = solve(&problem, &settings, &mut bar, &cancel);
    let wall_s = started.elapsed().as_secs_f64();
    let (reached, history) = (bar.reached(), bar.history().to_vec());
    drop(bar);
    let solution = solved?;
    if solution.status == Status::Cancelled {
        // The fields are of a cycle cut short; the last complete round is what there is to tell.
        terminal::note(&format!("cancelled {reached}"));
        return Ok(Exit::Other);
    }
    let mut result = Summary::new(&problem, &solution, wall_s, command);
    let merit = match merit(&problem, settings.fidelity, &solution, &cancel) {
        Ok(merit) => merit,
        Err(error) => {
            result.warnings.push(format!("torque over speed is not known: without film, {error}"));
            None
        }
    };
    result.merit = merit.as_ref().map(MeritObject::new);
    for warning in &result.warnings {
        terminal::warning(warning);
    }
    terminal::data(&if arguments.output.json { result.to_text() } else { summary::text(&scene, &problem, &result) })?;
    if let Some(folder) = &arguments.output.out {
        let figures = Figures { formats: &arguments.figures, history: &history, merit: merit.as_ref() };
        match write(folder, &scene, &problem, &solution, &result, &figures, &cancel)? {
            Some(paths) => terminal::note(&written(folder, &paths)),
            None => {
                terminal::note("cancelled; no file was written");
                return Ok(Exit::Other);
            }
        }
    }
    Ok(Exit::of(&solution.status))
}

/// Writes the files of `--out`; `None` if it was cancelled meanwhile, and then no file is there.
fn write(
    folder: &Path,
    scene: &Scene,
    problem: &Problem,
    solution: &Solution,
    summary: &Summary,
    figures: &Figures<'_>,
    cancel: &Cancel,
) -> Result<Option<Vec<PathBuf>>, CliError> {
    let mut staged = Staged::new(folder)?;
    staged.add("summary.json", |out| out.write_all(summary.to_text().as_bytes()))?;
    staged.add("scene.toml", |out| out.write_all(scene.to_toml().as_bytes()))?;
    staged.add("series.csv", |out| csv::series(problem, &solution.recording, out))?;
    staged.add("fields.csv", |out| csv::fields(problem, &solution.recording, out))?;
    staged.add("pressure.csv", |out| csv::pressure(&solution.recording, out))?;
    staged.add("fields.npz", |out| npz::write(scene, problem, solution, out))?;
    if let Some(merit) = figures.merit {
        staged.add("torque.csv", |out| write_csv(merit, out))?;
    }
    for (name, bytes) in figures.drawn(problem, solution, cancel)? {
        staged.add(&name, |out| out.write_all(&bytes))?;
    }
    if cancel.is_cancelled() {
        return Ok(None);
    }
    Ok(Some(staged.commit()?))
}

/// What a designer wants of a motor; nothing of a plate, and if it was cancelled.
fn merit(
    problem: &Problem,
    fidelity: Fidelity,
    solution: &Solution,
    cancel: &Cancel,
) -> Result<Option<Merit>, MotorError> {
    match (&problem.scenario, &solution.outcome) {
        (Scenario::Motor(motor), Outcome::Motor(result)) => {
            Merit::of(motor, &problem.numerics, fidelity, result, &solution.recording, cancel)
        }
        _ => Ok(None),
    }
}

/// Which figures are to be written, and torque over speed.
struct Figures<'a> {
    formats: &'a [FigureFormat],
    history: &'a [Progress],
    merit: Option<&'a Merit>,
}

impl Figures<'_> {
    /// Names and contents of the files; fewer if it was cancelled meanwhile.
    fn drawn(
        &self,
        problem: &Problem,
        solution: &Solution,
        cancel: &Cancel,
    ) -> Result<Vec<(String, Vec<u8>)>, FigureError> {
        let mut formats: Vec<_> = self.formats.iter().filter_map(|format| format.0).collect();
        formats.sort_unstable();
        formats.dedup();
        if formats.is_empty() {
            return Ok(Vec::new());
        }
        let mut figures = figures::of(problem, solution, self.history);
        if let Some(merit) = self.merit {
            figures.push(("torque", figures::dressed(problem, solution, figures::torque::torque(merit))));
        }
        let files: Vec<_> =
            figures.iter().flat_map(|figure| formats.iter().map(move |format| (figure, *format))).collect();
        let draw = |((name, figure), format): &(&(&str, _), _)| {
            let format: Format = *format;
            if cancel.is_cancelled() {
                return Ok(None);
            }
            Ok(Some((format!("{name}.{}", format.name()), to_bytes(figure, format)?)))
        };
        let drawn: Result<Vec<_>, FigureError> = files.par_iter().map(draw).collect();
        Ok(drawn?.into_iter().flatten().collect())
    }
}

/// `wrote results: summary.json, scene.toml, …`
pub(super) fn written(folder: &Path, paths: &[PathBuf]) -> String {
    let names: Vec<_> = paths.iter().filter_map(|path| path.file_name()).map(|name| name.to_string_lossy()).collect();
    format!("wrote to {}: {}", folder.display(), names.join(", "))
}
