//! `squeezefilm solve`: one scene's periodic steady state.

use super::exit::{CliError, Exit};
use super::figures::FigureOptions;
use super::interrupt::cancel_on_interrupt;
use super::options::{OutputOptions, SceneOptions, SolveOptions};
use super::progress::Bar;
use super::{summary, terminal};
use crate::analysis::torque::TorqueCurves;
use crate::export::files::{self, Control, ExportError, Solved};
use crate::export::json::{Summary, force_unit};
use crate::fidelity::Fidelity;
use crate::memory;
use crate::problem::Problem;
use crate::solution::Status;
use crate::solve::{Method, solve};
use clap::Args;
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

    #[command(flatten)]
    figures: FigureOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let scene = arguments.scene.scene(&arguments.preset)?;
    let problem = Problem::new(&scene)?;
    let settings = arguments.solve.prepare(Fidelity::default(), Method::default())?;
    let cancel = arguments.solve.within_budget(cancel_on_interrupt());

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
    let torque = result.add_torque(TorqueCurves::of_solve(&problem, settings.fidelity, &solution, &cancel));
    for warning in &result.warnings {
        terminal::warning(warning);
    }
    terminal::data(&if arguments.output.json {
        result.to_text()
    } else {
        summary::text(&scene, &problem, &solution.outcome, &result)
    })?;
    if let Some(folder) = &arguments.output.out {
        let solved = Solved {
            scene: &scene,
            problem: &problem,
            solution: &solution,
            history: &history,
            torque: torque.as_ref(),
        };
        if let Some(text) = announced(folder, files::expected_size(&problem, &solution.recording)) {
            terminal::note(&text);
        }
        let control = Control { cancel: &cancel, drawn: &|_, _| () };
        match files::solve(folder, &solved, &result, &arguments.figures.formats(), &control) {
            Err(ExportError::Cancelled) => {
                terminal::note(&ExportError::Cancelled.to_string());
                return Ok(Exit::Other);
            }
            paths => terminal::note(&written(folder, &paths?)),
        }
    }
    Ok(Exit::of(&solution.status))
}

/// Bytes above which it is told beforehand how much will be written.
const MUCH: u64 = 500_000_000;

/// `writing about 1.2 GB to results …`, if that is much.
fn announced(folder: &Path, bytes: u64) -> Option<String> {
    (bytes > MUCH).then(|| format!("writing about {} to {} …", memory::size(bytes), folder.display()))
}

/// `wrote results: summary.json, scene.toml, …`
pub(super) fn written(folder: &Path, paths: &[PathBuf]) -> String {
    let names: Vec<_> = paths.iter().filter_map(|path| path.file_name()).map(|name| name.to_string_lossy()).collect();
    format!("wrote to {}: {}", folder.display(), names.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn much_is_announced() {
        let folder = Path::new("results");
        assert_eq!(announced(folder, MUCH), None);
        assert_eq!(announced(folder, 1_240_000_000).as_deref(), Some("writing about 1.2 GB to results …"));
    }
}
