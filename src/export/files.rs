//! The files of results: those of `--out` on the command line, and those that the window exports. The files get their names only when all
//! of them are complete; a cancelled export leaves nothing behind.

use super::animation::{self, Movie, Options};
use super::compare::{self, all_figures, movies, report};
pub use super::error::ExportError;
use super::figure::{Figure, FigureError, Format, Pixels, png_bytes, to_bytes};
use super::json::{self, Summary};
use super::{csv, fall, figures, fit, npz, sensitivity, startup, sweep, torque, vtk};
use crate::analysis::compare::ComparedRun;
use crate::analysis::fit::{Fitted, Measured, Optimum};
use crate::analysis::quantity::Quantity;
use crate::analysis::sweep::{Sweep, SweepRow};
use crate::analysis::torque::TorqueCurves;
use crate::atomic::{Staged, WriteError, write_file};
use crate::control::{Cancel, Progress};
use crate::fall::Fall;
use crate::fidelity::Fidelity;
use crate::input::read_so_far;
use crate::problem::{Problem, Scenario};
use crate::recording::Recording;
use crate::scene::Scene;
use crate::solution::Solution;
use crate::solve::Settings;
use crate::startup::Startup;
use rayon::prelude::*;
use serde::Serialize;
use std::io;
use std::path::{Path, PathBuf};

/// Progress and cancellation of an export.
#[derive(Clone, Copy)]
pub struct Control<'a> {
    /// Checked between pictures.
    pub cancel: &'a Cancel,
    /// Called with the number of pictures drawn and their total, from several threads.
    pub drawn: &'a (dyn Fn(usize, usize) + Sync),
}

impl Control<'_> {
    fn check(&self) -> Result<(), ExportError> {
        if self.cancel.is_cancelled() { Err(ExportError::Cancelled) } else { Ok(()) }
    }

    /// Runs `draw`, and reports how many of `all` pictures it has drawn.
    fn counted<R>(&self, all: usize, draw: impl FnOnce(&(dyn Fn() + Sync)) -> R) -> R {
        let count = std::sync::atomic::AtomicUsize::new(0);
        draw(&|| (self.drawn)(count.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1, all))
    }
}

/// One solve, with everything that its files contain.
#[derive(Clone, Copy, Debug)]
pub struct Solved<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The scene, checked and in SI units.
    pub problem: &'a Problem,
    /// Its solution.
    pub solution: &'a Solution,
    /// The rounds, if they were kept.
    pub history: &'a [Progress],
}

/// The folder for results, and how they are written.
#[derive(Clone, Debug)]
pub struct Folder<'a> {
    /// The folder; it is created if necessary.
    pub path: &'a Path,
    /// The command line that gave the results, word by word; empty if there was none.
    pub command: &'a [String],
    /// Formats of the figures.
    pub formats: Vec<Format>,
    /// Whether the fields of a solve are also written as VTK: a file for each instant, and the series of them for ParaView.
    pub vtk: bool,
}

/// Files to be written into a folder.
pub struct Files<'a> {
    staged: Staged,
    folder: &'a Folder<'a>,
}

impl<'a> Files<'a> {
    /// Begins without files for this folder.
    pub fn new(folder: &'a Folder<'a>) -> Result<Self, WriteError> {
        let mut staged = Staged::new(folder.path)?;
        // A command must not replace its own input.
        if !folder.command.is_empty() {
            staged.spare(read_so_far());
        }
        Ok(Self { staged, folder })
    }

    /// Adds a file with the content that `write` writes.
    pub fn add(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        self.staged.add(name, write)
    }

    /// Adds a text.
    pub fn text(&mut self, name: &str, text: &str) -> Result<(), WriteError> {
        self.staged.add(name, |out| out.write_all(text.as_bytes()))
    }

    /// Adds an object of `--json`.
    pub fn json(&mut self, name: &str, object: &impl Serialize) -> Result<(), WriteError> {
        self.text(name, &json::document(object, self.folder.command))
    }

    /// Adds a figure in each format. Fails also if it cannot be drawn.
    pub fn figure(&mut self, name: &str, figure: &Figure) -> Result<(), WriteError> {
        for format in &self.folder.formats {
            self.staged.add(format!("{name}.{}", format.name()), |out| {
                out.write_all(&to_bytes(figure, *format).map_err(io::Error::other)?)
            })?;
        }
        Ok(())
    }

    /// Gives every file its name, and returns the paths.
    pub fn commit(self) -> Result<Vec<PathBuf>, WriteError> {
        self.staged.commit()
    }
}

/// Bytes of a number in a CSV file, including its comma: `1.23456789e-6,`.
const WRITTEN: u64 = 14;

/// Approximate number of bytes that [`solve`] will write: fields as text, as an archive and as VTK. Everything else is small beside large
/// fields.
pub fn expected_size(folder: &Folder<'_>, problem: &Problem, recording: &Recording) -> u64 {
    let lines = (recording.frames * recording.teeth * recording.x.len()) as u64;
    let map = recording.pressure.len() as u64;
    let (columns, arrays) = if matches!(problem.scenario, Scenario::Motor(_)) { (10, 5) } else { (6, 2) };
    let series = recording.frames as u64;
    let mut first = Vec::new();
    if folder.vtk {
        // All instants have the size of the first. Writing to memory cannot fail.
        let _ = vtk::write(problem, recording, 0, &mut first);
    }
    let vtk = series * first.len() as u64;
    lines * (columns * WRITTEN + arrays * 8) + map * (4 * WRITTEN + 8) + series * 8 * (WRITTEN + 8) + vtk
}

/// Writes the files of `squeezefilm solve --out` into a folder.
pub fn solve(
    folder: &Folder<'_>,
    solved: &Solved<'_>,
    summary: &Summary,
    control: &Control<'_>,
) -> Result<Vec<PathBuf>, ExportError> {
    let Solved { scene, problem, solution, .. } = *solved;
    let mut files = Files::new(folder)?;
    files.text("summary.json", &json::text(summary))?;
    files.text("scene.toml", &scene.to_toml())?;
    files.add("series.csv", |out| csv::series(problem, &solution.recording, out))?;
    files.add("fields.csv", |out| csv::fields(problem, &solution.recording, out))?;
    files.add("pressure.csv", |out| csv::pressure(&solution.recording, out))?;
    files.add("fields.npz", |out| npz::write(scene, problem, solution, out))?;
    if let Some(curves) = &summary.torque {
        files.add("torque.csv", |out| torque::write_csv(curves, out))?;
    }
    add_figures(&mut files, solved, summary.torque.as_ref(), control)?;
    if folder.vtk {
        let (names, series) = vtk::series(&solution.recording);
        for (frame, name) in names.iter().enumerate() {
            control.check()?;
            files.add(name, |out| vtk::write(problem, &solution.recording, frame, out))?;
        }
        files.text("film.vtk.series", &series)?;
    }
    control.check()?;
    Ok(files.commit()?)
}

/// Writes only the figures of a solve; `torque` is torque over speed, for a motor.
pub fn solve_figures(
    folder: &Folder<'_>,
    solved: &Solved<'_>,
    torque: Option<&TorqueCurves>,
    control: &Control<'_>,
) -> Result<Vec<PathBuf>, ExportError> {
    let mut files = Files::new(folder)?;
    add_figures(&mut files, solved, torque, control)?;
    control.check()?;
    Ok(files.commit()?)
}

/// The problem with the name for titles of its figures, which may include changes.
fn titled(solved: &Solved<'_>) -> Problem {
    let name =
        if solved.problem.name == solved.scene.name { solved.scene.headline() } else { solved.problem.name.clone() };
    Problem { name, ..solved.problem.clone() }
}

/// Adds the figures of a solve, drawn several at a time.
fn add_figures(
    files: &mut Files<'_>,
    solved: &Solved<'_>,
    torque: Option<&TorqueCurves>,
    control: &Control<'_>,
) -> Result<(), ExportError> {
    let mut formats = files.folder.formats.clone();
    formats.sort_unstable();
    formats.dedup();
    if formats.is_empty() {
        return Ok(());
    }
    let figures = figures::of(&titled(solved), solved.solution, solved.history, torque);
    let asked: Vec<_> = figures.iter().flat_map(|figure| formats.iter().map(move |format| (figure, *format))).collect();
    let drawn = control.counted(asked.len(), |done| {
        let draw = |((name, figure), format): &(&(&str, Figure), Format)| {
            control.check()?;
            let bytes = to_bytes(figure, *format)?;
            done();
            Ok((format!("{name}.{}", format.name()), bytes))
        };
        asked.par_iter().map(draw).collect::<Result<Vec<_>, ExportError>>()
    })?;
    for (name, bytes) in drawn {
        files.add(&name, |out| out.write_all(&bytes))?;
    }
    Ok(())
}

/// Writes a single file with the content that `write` writes. Returns its path.
pub fn alone(
    path: &Path,
    write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>,
) -> Result<Vec<PathBuf>, ExportError> {
    write_file(path, write)?;
    Ok(vec![path.to_owned()])
}

/// The fields of a solve as a NumPy archive.
pub fn fields(path: &Path, solved: &Solved<'_>) -> Result<Vec<PathBuf>, ExportError> {
    alone(path, |out| npz::write(solved.scene, solved.problem, solved.solution, out))
}

/// The cycle of a solve as an animation, in the format of its path.
pub fn animation(
    path: &Path,
    solved: &Solved<'_>,
    options: &Options,
    control: &Control<'_>,
) -> Result<Vec<PathBuf>, ExportError> {
    let all = animation::count(&solved.solution.recording, options, animation::Format::of(path)?);
    control.counted(all, |done| animation::write(path, &titled(solved), solved.solution, options, done, control.cancel))
}

/// A movie as GIF. `path` is that of the file, for errors.
pub fn gif(movie: &Movie, path: &Path, cancel: &Cancel) -> Result<Vec<u8>, ExportError> {
    let mut gif = Vec::new();
    let failed = |source| animation::stopped(WriteError { path: path.to_owned(), source }, cancel);
    movie.gif(&mut gif, cancel).map_err(failed)?;
    Ok(gif)
}

/// Animations of several runs as GIF, each with its name.
fn moving(runs: &[ComparedRun], folder: &Path, control: &Control<'_>) -> Result<Vec<(String, Vec<u8>)>, ExportError> {
    if !cfg!(feature = "render") {
        return Ok(Vec::new());
    }
    let drawn = control.counted(compare::frames(runs), |done| movies(runs, done, control.cancel))?;
    let named = |(name, movie): (&str, Movie)| {
        let bytes = gif(&movie, &folder.join(format!("{name}.gif")), control.cancel)?;
        Ok((name.to_owned(), bytes))
    };
    drawn.into_iter().map(named).collect()
}

/// Writes the files of `squeezefilm compare --out` into a folder. `all`: lists parameters that do not differ, too.
pub fn comparison(
    folder: &Folder<'_>,
    runs: &[ComparedRun],
    settings: &Settings,
    all: bool,
    control: &Control<'_>,
) -> Result<Vec<PathBuf>, ExportError> {
    let all = all || runs.len() < 2;
    let movies = moving(runs, folder.path, control)?;
    let mut files = Files::new(folder)?;
    files.text("report.html", &report(runs, settings, all, &movies, folder.command))?;
    files.add("compare.csv", |out| compare::write_csv(runs, out))?;
    files.add("parameters.csv", |out| compare::write_parameters_csv(runs, all, out))?;
    files.json("compare.json", &compare::object(runs, settings))?;
    for (name, gif) in &movies {
        files.add(&format!("{name}.gif"), |out| out.write_all(gif))?;
    }
    for (name, figure) in all_figures(runs) {
        control.check()?;
        files.figure(&name, &figure)?;
    }
    control.check()?;
    Ok(files.commit()?)
}

/// The report of one run, or of several, as one HTML file.
pub fn html(
    path: &Path,
    runs: &[ComparedRun],
    settings: &Settings,
    control: &Control<'_>,
) -> Result<Vec<PathBuf>, ExportError> {
    let movies = moving(runs, path, control)?;
    let page = report(runs, settings, runs.len() < 2, &movies, &[]);
    control.check()?;
    alone(path, |out| out.write_all(page.as_bytes()))
}

/// A picture of the window of this size \[pixels\]: red, green and blue, row by row from the top.
pub fn picture(path: &Path, [width, height]: [u32; 2], rgb: Vec<u8>) -> Result<Vec<PathBuf>, ExportError> {
    let pixels = Pixels { width, height, rgb };
    let bytes = png_bytes(&pixels, None, &[]).map_err(|error| FigureError::Draw(error.to_string()))?;
    alone(path, |out| out.write_all(&bytes))
}

/// Writes the files of `squeezefilm sweep --out` into a folder. `shown` is the quantity in the figure.
pub fn swept(
    folder: &Folder<'_>,
    swept: &Sweep,
    rows: &[SweepRow],
    shown: Quantity,
) -> Result<Vec<PathBuf>, WriteError> {
    let mut files = Files::new(folder)?;
    files.add("sweep.csv", |out| sweep::write_csv(swept, rows, out))?;
    files.json("sweep.json", &sweep::object(swept, rows))?;
    files.figure("sweep", &sweep::figure(swept, rows, shown))?;
    files.text("scene.toml", &swept.scene().to_toml())?;
    files.commit()
}

/// Writes the files of `squeezefilm fit --out` for a fit to measurements into a folder; `problem` has the values that were found.
pub fn fitted(
    folder: &Folder<'_>,
    problem: &Problem,
    preset: &str,
    fitted: &Fitted,
    measured: &Measured,
) -> Result<Vec<PathBuf>, WriteError> {
    let mut files = Files::new(folder)?;
    files.json("fit.json", &fit::object(preset, fitted, measured))?;
    files.add("fit.csv", |out| fit::write_csv(fitted, measured, out))?;
    for (name, figure) in fit::figures(problem, fitted, measured) {
        files.figure(name, &figure)?;
    }
    files.text("fitted.toml", &fitted.scene.to_toml())?;
    files.commit()
}

/// Writes the files of `squeezefilm fit --out` for an optimum into a folder.
pub fn optimum(
    folder: &Folder<'_>,
    problem: &Problem,
    preset: &str,
    found: &Optimum,
) -> Result<Vec<PathBuf>, WriteError> {
    let mut files = Files::new(folder)?;
    files.json("fit.json", &fit::optimum(preset, found))?;
    files.add("optimum.csv", |out| fit::write_optimum_csv(found, out))?;
    files.figure("optimum", &fit::optimum_figure(problem, found))?;
    files.text("fitted.toml", &found.scene.to_toml())?;
    files.commit()
}

/// Writes the files of `squeezefilm startup --out` into a folder. `wall_s` is the wall time by the caller's clock, or NaN.
pub fn startup(
    folder: &Folder<'_>,
    (scene, problem): (&Scene, &Problem),
    settings: &crate::startup::Settings,
    (ended, cycles): (&Startup, &[crate::startup::Cycle]),
    wall_s: f64,
) -> Result<Vec<PathBuf>, WriteError> {
    let rows: Vec<_> = cycles.iter().map(|cycle| startup::CycleRow::of(problem, cycle)).collect();
    let mut files = Files::new(folder)?;
    files.add("startup.csv", |out| startup::write_csv(problem, &rows, out))?;
    files.json("startup.json", &startup::object(problem, settings, ended, &rows, wall_s))?;
    files.figure("startup", &startup::figure(problem, settings, ended, &rows, cycles))?;
    files.text("scene.toml", &scene.to_toml())?;
    files.commit()
}

/// Writes into a folder the files of `squeezefilm startup --out` for a plate that is dropped. `wall_s` is the wall time by the caller's
/// clock, or NaN.
pub fn fall(
    folder: &Folder<'_>,
    (scene, problem): (&Scene, &Problem),
    fidelity: Fidelity,
    (ended, cycles): (&Fall, &[crate::fall::Cycle]),
    wall_s: f64,
) -> Result<Vec<PathBuf>, WriteError> {
    let mut files = Files::new(folder)?;
    files.add("startup.csv", |out| csv::rows(cycles.iter().map(fall::row), out))?;
    files.json("startup.json", &fall::object(problem, fidelity, ended, cycles, wall_s))?;
    files.figure("startup", &fall::figure(problem, fidelity, ended, cycles))?;
    files.text("scene.toml", &scene.to_toml())?;
    files.commit()
}

/// Writes the files of `squeezefilm sensitivity --out` into a folder.
pub fn sensitivity(folder: &Folder<'_>, found: &sensitivity::SensitivityStudy<'_>) -> Result<Vec<PathBuf>, WriteError> {
    let mut files = Files::new(folder)?;
    files.add("sensitivity.csv", |out| csv::rows(found.rows(), out))?;
    files.json("sensitivity.json", &found.object())?;
    files.figure("sensitivity", &found.tornado())?;
    if let Some(uncertainty) = found.uncertainty() {
        files.figure("uncertainty", &uncertainty)?;
    }
    if let Some(histogram) = found.histogram() {
        files.add("monte-carlo.csv", |out| found.write_draws(out))?;
        files.figure("monte-carlo", &histogram)?;
    }
    files.text("scene.toml", &found.sensitivity.scene().to_toml())?;
    files.commit()
}
