//! `squeezefilm solve`: one scene's periodic steady state.

use super::exit::{CliError, Exit};
use super::options::{CommonOptions, STANDARD_INPUT};
use super::progress::Bar;
use super::{summary, terminal};
use crate::analysis::compare::unique;
use crate::analysis::quantity::force_unit;
use crate::analysis::torque::TorqueCurves;
use crate::atomic::check_for_results;
use crate::control::Cancel;
use crate::digits::duration;
use crate::export::files::{self, Control, ExportError, Folder, Solved};
use crate::export::json::{self, Summary};
use crate::memory;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::scene::presets::BuiltIn;
use crate::solution::{Status, settled};
use crate::solve::{Settings, check, solve};
use clap::Args;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  squeezefilm solve fundamental
  squeezefilm solve fundamental --set film.min_spacing_nm=100 --set stator.tooth_radius_m=3
  squeezefilm solve my.toml --fidelity fine --json | jq .alpha
  squeezefilm solve fundamental levitating plate-mems --out results
  squeezefilm presets fundamental --set film.slip=none | squeezefilm solve -";

const FILES: &str = "\
Files of --out, with the unit in every column's name:
  summary.json   what --json prints
  scene.toml     the scene as solved, changes included, as a preset
  series.csv     loads, teeth in contact, least film thickness and
                 highest pressure, over one cycle
  fields.csv     surfaces, film thickness and line loads at every node of
                 every tooth, over one cycle; a line load × length_m,
                 summed at one time_s, is the load in series.csv
  pressure.csv   pressure under one tooth, over one cycle
  fields.npz     all these fields as NumPy arrays (numpy.load)
  torque.csv     torque, power and efficiency of a motor over the speed of
                 its rotor, with the film and without (dry_)
  wave, loads, map, torque, convergence (.svg .png)
                 figures of a motor: surfaces and pressures along the
                 wave, loads over the cycle, pressure map, torque and
                 power over speed, rounds of the solve
  profile, loads, loop, map, exact, convergence (.svg .png)
                 figures of a plate; exact: beside exact results
For a symmetric film the files hold only the half solved: y_m >= 0,
and for a plate x_m >= 0 as well.";

/// Solves presets for their periodic steady state and prints a summary of each
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{FILES}\n\n{EXAMPLES}"))]
pub(super) struct Arguments {
    /// Built-in presets (see: squeezefilm presets), paths of TOML files, or - for standard input; for several, --json prints an
    /// array, and each gets its own folder in --out
    #[arg(value_name = "PRESET", required = true, num_args = 1..)]
    presets: Vec<String>,

    #[command(flatten)]
    common: CommonOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let scenes = arguments.common.scene.scenes(&arguments.presets)?;
    let problems = scenes.iter().map(Problem::try_from).collect::<Result<Vec<_>, _>>()?;
    let (settings, cancel) = arguments.common.solve.begin()?;
    let folder = arguments.common.output.folder_of_fields(command)?;
    let several = scenes.len() > 1;
    if several {
        // Before the first is solved.
        problems.iter().try_for_each(|problem| check(problem, &settings))?;
    }
    let mut names = Vec::new();
    let mut path = |preset: &String| {
        let name = folder_name(preset, &mut names);
        let path = folder.as_ref()?.path;
        Some(if several { path.join(name) } else { path.to_owned() })
    };
    let paths: Vec<Option<PathBuf>> = arguments.presets.iter().map(&mut path).collect();
    paths.iter().flatten().filter(|path| several && path.exists()).try_for_each(|path| check_for_results(path))?;
    let (mut exits, mut objects) = (Vec::new(), Vec::new());
    for (((preset, scene), problem), path) in arguments.presets.iter().zip(&scenes).zip(&problems).zip(&paths) {
        let folder = folder.as_ref().zip(path.as_deref()).map(|(folder, path)| Folder { path, ..folder.clone() });
        if several {
            terminal::note(&format!("{preset}:"));
            if !exits.is_empty() && !arguments.common.output.json {
                terminal::text("\n");
            }
        }
        match one(arguments, scene, problem, &settings, &cancel, folder.as_ref(), command) {
            Ok((exit, object)) => {
                exits.push(exit);
                objects.extend(object);
            }
            // The others are still solved.
            Err(error) if several => {
                terminal::error(&format!("{preset}: {error}"));
                exits.push(error.exit());
            }
            Err(error) => return Err(error),
        }
        if cancel.is_cancelled() {
            break;
        }
    }
    if several && arguments.common.output.json {
        terminal::data(&json::text(&objects));
    }
    Ok(Exit::worst(exits))
}

/// Time \[s\] above which the time for torque over speed is reported, if it is also longer than the solve.
const LONG: f64 = 0.3;

/// Solves one preset, prints its result and writes its files. The object of `--json` is printed only if it is alone; it is
/// returned unless the solve was cancelled.
fn one(
    arguments: &Arguments,
    scene: &Scene,
    problem: &Problem,
    settings: &Settings,
    cancel: &Cancel,
    folder: Option<&Folder<'_>>,
    command: &[String],
) -> Result<(Exit, Option<Summary>), CliError> {
    let mut bar = Bar::solve(force_unit(problem));
    let started = Instant::now();
    let solved = solve(problem, settings, &mut bar, cancel);
    let wall_s = started.elapsed().as_secs_f64();
    let (reached, history) = (bar.reached(), bar.history().to_vec());
    drop(bar);
    let solution = solved?;
    if solution.status == Status::Cancelled {
        // The fields are those of an incomplete cycle, so only the last complete round is reported.
        terminal::note(&format!("cancelled {reached}"));
        return Ok((Exit::Other, None));
    }
    let problem = &*settled(problem, &solution.outcome);
    let mut result = Summary::new(problem, &solution, wall_s, command);
    result.add_torque(TorqueCurves::of(problem, settings.fidelity, &solution, cancel));
    let more = started.elapsed().as_secs_f64() - wall_s;
    if more > wall_s.max(LONG) {
        terminal::note(&format!("torque over speed took another {}, which the cost does not include", duration(more)));
    }
    result.warnings.iter().for_each(|warning| terminal::warning(warning));
    arguments.common.solve.tell_if_late("the solve", wall_s);
    if !arguments.common.output.json {
        terminal::text(&summary::text(scene, &result));
    } else if arguments.presets.len() == 1 {
        terminal::data(&json::text(&result));
    }
    let mut exit = Exit::of(&solution.status);
    if let Some(folder) = folder {
        let solved = Solved { scene, problem, solution: &solution, history: &history };
        if let Some(text) = announced(folder.path, files::expected_size(folder, problem, &solution.recording)) {
            terminal::note(&text);
        }
        let control = Control { cancel, drawn: &|_, _| () };
        let written_files = files::solve(folder, &solved, &result, &control).map(|mut paths| {
            // Of the many VTK files, only the file of the series is named.
            paths.retain(|path| path.extension() != Some(OsStr::new("vtk")));
            paths
        });
        match written_files {
            Err(ExportError::Cancelled) => {
                terminal::note(&ExportError::Cancelled.to_string());
                exit = Exit::Other;
            }
            paths => terminal::wrote(folder.path, &paths?),
        }
    }
    Ok((exit, Some(result)))
}

/// The folder of one preset among several: its name, or that of its file, once.
fn folder_name(preset: &str, names: &mut Vec<String>) -> String {
    let built_in = BuiltIn::find(preset).is_some();
    let name = match Path::new(preset).file_stem() {
        _ if preset == STANDARD_INPUT => "standard-input".to_owned(),
        Some(stem) if !built_in => stem.to_string_lossy().into_owned(),
        _ => preset.to_owned(),
    };
    let name = unique(&name, |name| names.iter().any(|other| other == name));
    names.push(name.clone());
    name
}
/// Number of bytes above which the amount of output is announced before it is written.
const MUCH: u64 = 500_000_000;

/// `writing about 1.2 GB to results …`, if that is much.
fn announced(folder: &Path, bytes: u64) -> Option<String> {
    (bytes > MUCH).then(|| format!("writing about {} to {} …", memory::size(bytes), folder.display()))
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
