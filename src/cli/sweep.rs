//! `squeezefilm sweep`: varies up to three keys of a scene.

use super::columns::{Columns, heading};
use super::exit::{CliError, Exit};
use super::options::{CommonOptions, PRESET, PRESSURE, warn_of_given_path};
use super::progress::Bar;
use super::terminal;
use crate::analysis::attempt::RunStatus;
use crate::analysis::decision::effort;
use crate::analysis::error::AnalysisError;
use crate::analysis::quantity::Quantity;
use crate::analysis::sweep::{Axis, Sweep, SweepPart, SweepRow, Values, Vary};
use crate::atomic::{Lock, WriteError, remove_file, write_file};
use crate::digits::{duration, significant};
use crate::estimate::Estimate;
use crate::export::compare::LIMITS;
use crate::export::files::{self, Folder};
use crate::export::json::{self, TIME_UP};
use crate::export::saved::{self, LARGEST};
use crate::export::sweep::{object, primary};
use crate::input::read_text;
use crate::scene::show_text;
use crate::solution::StoppedBy;
use clap::Args;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::sync::{Mutex, Once, PoisonError};
use std::time::{Duration, Instant};

const EXAMPLES: &str = "\
Examples:
  squeezefilm sweep fundamental --vary stator.frequency_khz=3:100:20:log
  squeezefilm sweep fundamental --vary film.min_spacing_nm=20:500:30:log --fidelity fine \\
      --out results
  squeezefilm sweep fundamental --vary motor.load_per_wave_n=0.5:5:12 \\
      --vary film.min_spacing_nm=50:400:12:log --out map
  squeezefilm sweep fundamental --vary film.slip=first-order,fukui-kaneko,none \\
      --vary film.min_spacing_nm=50,100,200
  squeezefilm sweep plate-crossover --vary plate.frequency_khz=0.1:1000:40:log --json
  squeezefilm sweep fundamental --vary stator.frequency_khz=3:100:1000:log --part 3/64 \\
      --out results";

const FILES: &str = "\
Files of --out:
  sweep.csv   a row for each point: its keys, its status and its numbers
  sweep.json  what --json prints
  sweep.svg   curves, or a map with contours; for three keys a map for
              each value of the first (twelve at most); and sweep.png
  scene.toml  the scene that is varied, as a preset
A sweep that is cancelled (Ctrl-C) or killed leaves sweep.incomplete.csv
instead; the same command continues it, to the same result. Points are
saved after 1 s and then every 5 s, and at Ctrl-C. With --part 3/64 there
is only sweep.part-3-of-64.csv, complete or to be continued.";

/// Solves a preset over values of one, two or three keys
///
/// All cores are used, and the results do not depend on their number. Most points start from the fields of their neighbour, so that they take
/// fewer film steps and rounds than the same point solved alone; the results agree within their stated errors. A point that fails, does not converge, or breaks a rule
/// between keys is marked, and the others go on. If a motor has two periodic states, one in which its rotor floats and one in
/// which teeth touch, a point has the one found first; solve looks for both.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{FILES}\n\n{EXAMPLES}"))]
pub(super) struct Arguments {
    #[arg(value_name = "PRESET", help = PRESET)]
    preset: String,

    /// A key and its values (range or list), in the key's unit or another of its kind; twice for a map, three times for maps
    ///
    /// A key whose value is a number can have a range: --vary film.min_spacing_nm=50:400:8:log, or 0.05um:0.4um:8:log, gives 8 values at
    /// equal ratios; without :log, at equal steps. A key of whole numbers takes the nearest ones. Any key can have a list:
    /// --vary film.slip=first-order,fukui-kaneko, with values as for --set.
    #[arg(long, value_name = "KEY=FROM:TO:COUNT[:log] or KEY=VALUE,VALUE…", required = true)]
    vary: Vec<Vary>,

    /// Solves one part of the points: 3/64 is the third of 64 parts; squeezefilm join puts them together
    ///
    /// Parts depend on the points alone. Each can be solved on a different machine, and together they are what one machine gives, byte
    /// for byte. The same command continues an interrupted part. At most 100 000 points can be in a part, or be joined; all parts
    /// together may have more.
    #[arg(long, value_name = "NUMBER/COUNT", requires = "out")]
    part: Option<SweepPart>,

    /// Starts again and discards what a cancelled sweep left in the folder of --out
    #[arg(long, requires = "out")]
    restart: bool,

    /// Result to draw, by its name in sweep.csv [default: alpha, for a plate mean_load_ratio, or mean_gap_um if it floats]
    #[arg(long, value_name = "NAME", requires = "out")]
    quantity: Option<String>,

    #[command(flatten)]
    common: CommonOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let varied: Vec<&str> = arguments.vary.iter().map(|vary| vary.key.as_str()).collect();
    let scene = arguments.common.scene.scene_varied(&arguments.preset, &varied)?;
    let (settings, cancel) = arguments.common.solve.begin()?;
    let part = arguments.part.unwrap_or(SweepPart::WHOLE);
    let mut sweep = Sweep::of_part(&scene, &arguments.vary, &settings, part)?;
    sweep.budget = arguments.common.solve.accuracy.budget;
    let varies = |key: &str| sweep.axes().iter().any(|axis| axis.parameter.key == key);
    if varies(PRESSURE) && !varies("film.mean_free_path_nm") && !varies("film.gas") {
        warn_of_given_path(&scene);
    }
    if let Some((key, _)) = arguments.common.scene.changes.iter().find(|(key, _)| varies(key)) {
        return Err(CliError::usage(&format!(
            "--set has no effect on {key}, which is varied: leave one of the two out"
        )));
    }
    for (vary, axis) in arguments.vary.iter().zip(sweep.axes()) {
        if let Values::Range { count, .. } = vary.values
            && axis.values.len() < count
        {
            let key = axis.parameter.key;
            terminal::note(&format!("{key} is a whole number: {} different values, not {count}", axis.values.len()));
        }
    }
    let shown = shown(&sweep, arguments.quantity.as_deref())?;
    let points = sweep.points_of(part).len();
    let command = &of_the_whole(command);
    let folder = arguments.common.output.folder(command)?;
    let folder = folder.map(|out| Saved::open(out, &sweep, arguments.part)).transpose()?;
    let done = match &folder {
        Some(folder) if !arguments.restart => folder.left_over()?,
        _ => Vec::new(),
    };
    if !done.is_empty() {
        terminal::note(&format!("continuing: {} of {points} points were solved before", done.len()));
    }

    let saved = Mutex::new((done.clone(), Instant::now(), SAVE_FIRST));
    let warned = Once::new();
    let (rows, wall_s) = Bar::points(points, done.len()).timed(|bar| {
        sweep.run_part(part, &done, &cancel, &|row| {
            bar.point_done(&place(&sweep, row));
            let Some(folder) = &folder else { return };
            let mut saved = saved.lock().unwrap_or_else(PoisonError::into_inner);
            saved.0.push(row.clone());
            if saved.1.elapsed() > saved.2 {
                // Saving at the end may succeed, and is an error if it fails.
                if let Err(error) = folder.save_unfinished(&saved.0) {
                    warned.call_once(|| terminal::warning(&format!("{error}; the points are still being solved")));
                }
                (saved.1, saved.2) = (Instant::now(), SAVE_EVERY);
            }
        })
    });

    if rows.len() < points {
        terminal::note(&format!("cancelled: {} of {points} points are solved", rows.len()));
        let so_far = || terminal::note(&format!("results so far:\n\n{}", text(&sweep, &rows)));
        match &folder {
            Some(_) if rows.is_empty() => {}
            Some(folder) => {
                let path = folder.save_unfinished(&rows).inspect_err(|_| so_far())?;
                terminal::note(&format!("they are kept in {}; the same command continues from there", path.display()));
            }
            None => so_far(),
        }
        return Ok(Exit::Other);
    }
    let exit = tell(&sweep, &rows, arguments.common.output.json, command);
    terminal::note(&format!("{} points in {}", rows.len() - done.len(), duration(wall_s)));
    if let Some(folder) = &folder {
        terminal::wrote(folder.out.path, &folder.save(&rows, shown)?);
    }
    Ok(exit)
}

/// The quantity of this name, or without a name the main result of the sweep.
fn shown(sweep: &Sweep, name: Option<&str>) -> Result<Quantity, CliError> {
    let Some(name) = name else { return Ok(primary(sweep)) };
    let column = |quantity: &Quantity| quantity.column(sweep.problem());
    sweep.quantities().into_iter().find(|quantity| quantity.name() == name || column(quantity) == name).ok_or_else(
        || {
            let allowed: Vec<String> = sweep.quantities().iter().map(column).collect();
            AnalysisError::no_such_number("--quantity", name, &allowed.join(", ")).into()
        },
    )
}

/// Prints the rows, for people or as JSON, and returns the exit status.
pub(super) fn tell(sweep: &Sweep, rows: &[SweepRow], json: bool, command: &[String]) -> Exit {
    for row in rows {
        if let RunStatus::Failed(reason) = &row.status {
            let place = place(sweep, row);
            let message = if reason.starts_with(&place) { reason.clone() } else { format!("{place}: {reason}") };
            terminal::error(&message);
        }
    }
    terminal::result(json, || json::document(&object(sweep, rows), command), || text(sweep, rows));
    Exit::worst(rows.iter().map(|row| Exit::from(&row.status)))
}

/// The command line without `--part`, because results record the command for the whole sweep.
fn of_the_whole(command: &[String]) -> Vec<String> {
    let mut words = command.iter();
    let mut whole = Vec::new();
    while let Some(word) = words.next() {
        match word.strip_prefix("--part") {
            Some("") => drop(words.next()),
            Some(rest) if rest.starts_with('=') => {}
            _ => whole.push(word.clone()),
        }
    }
    whole
}

/// Time after which the points solved so far are saved for the first time.
const SAVE_FIRST: Duration = Duration::from_secs(1);
/// Time between later saves.
const SAVE_EVERY: Duration = Duration::from_secs(5);
/// End of the file name of a sweep that is not complete.
const UNFINISHED: &str = ".incomplete.csv";

/// Name of the file with the points solved so far of the whole sweep, or with those of a part.
fn unfinished(part: Option<SweepPart>) -> String {
    match part {
        None => format!("sweep{UNFINISHED}"),
        Some(part) => format!("sweep.part-{}-of-{}.csv", part.number(), part.of()),
    }
}

/// The folder of `--out`, locked against other sweeps; the parts of one sweep share it.
struct Saved<'a> {
    out: Folder<'a>,
    sweep: &'a Sweep,
    part: Option<SweepPart>,
    /// `None` only while being dropped.
    lock: Option<Lock>,
    /// Whether this command made the folder, and has to remove it again if it stays empty.
    made: bool,
}

impl<'a> Saved<'a> {
    /// Locks the folder before anything is solved; an error if another sweep is being saved there.
    fn open(out: Folder<'a>, sweep: &'a Sweep, part: Option<SweepPart>) -> Result<Self, CliError> {
        let path = out.path;
        let made = !path.exists();
        let failed = |source| WriteError { path: path.to_owned(), source };
        std::fs::create_dir_all(path).map_err(failed)?;
        match Lock::of(path, unfinished(part).trim_end_matches(UNFINISHED)).map_err(failed)? {
            None => {
                let busy = "another sweep is being saved into this folder; give another folder, or wait for it";
                Err(CliError::file(path, busy))
            }
            lock => Ok(Self { out, sweep, part, lock, made }),
        }
    }

    /// The rows that were solved before.
    fn left_over(&self) -> Result<Vec<SweepRow>, CliError> {
        let path = self.out.path.join(unfinished(self.part));
        let fault = |fault: String| {
            let way_out = "give another folder, or --restart to begin anew";
            CliError::file(&path, format!("cannot be continued: {fault}; {way_out}"))
        };
        if matches!(path.symlink_metadata(), Err(error) if error.kind() == ErrorKind::NotFound) {
            return Ok(Vec::new());
        }
        let text = read_text(&path, LARGEST).map_err(|error| fault(error.to_string()))?;
        saved::read(self.sweep, self.part.unwrap_or(SweepPart::WHOLE), &text).map_err(fault)
    }

    fn save_unfinished(&self, rows: &[SweepRow]) -> Result<PathBuf, WriteError> {
        let path = self.out.path.join(unfinished(self.part));
        let part = self.part.unwrap_or(SweepPart::WHOLE);
        write_file(&path, |out| saved::write(self.sweep, part, rows, self.out.command, out))?;
        Ok(path)
    }

    fn save(&self, rows: &[SweepRow], shown: Quantity) -> Result<Vec<PathBuf>, WriteError> {
        if self.part.is_some() {
            return self.save_unfinished(rows).map(|path| vec![path]);
        }
        // If the files cannot be written, the rows are saved, so that the same command can continue from there.
        let paths =
            files::swept(&self.out, self.sweep, rows, shown).inspect_err(|_| drop(self.save_unfinished(rows)))?;
        remove_file(&self.out.path.join(unfinished(self.part)))?;
        Ok(paths)
    }
}

impl Drop for Saved<'_> {
    fn drop(&mut self) {
        self.lock.take();
        if self.made {
            // Only an empty folder is removed.
            let _ = std::fs::remove_dir(self.out.path);
        }
    }
}

/// The keys and values of a row: `film.min_spacing_nm = 100`.
fn place(sweep: &Sweep, row: &SweepRow) -> String {
    let at = |(axis, value): (&Axis, &f64)| format!("{} = {}", axis.parameter.key, axis.text(*value));
    sweep.axes().iter().zip(&row.values).map(at).collect::<Vec<_>>().join(", ")
}

/// The table for people.
fn text(sweep: &Sweep, rows: &[SweepRow]) -> String {
    let keys: Vec<&str> = sweep.axes().iter().map(|axis| axis.parameter.key).collect();
    let how = effort(sweep.settings(), sweep.budget);
    let title = format!("{}, {} points over {}, {how}", show_text(&sweep.scene().name), rows.len(), keys.join(", "));
    let mut text = heading(&title);
    let shown: Vec<Quantity> = SHOWN.into_iter().filter(|shown| sweep.quantities().contains(shown)).collect();
    let labels = |quantities: &[Quantity]| {
        let keys = keys.iter().map(ToString::to_string);
        keys.chain(quantities.iter().map(|quantity| quantity.label(sweep.problem()))).collect::<Vec<_>>()
    };
    // Limits of the model that are exceeded; empty if none.
    let limits = if rows.iter().any(|row| !row.outside.is_empty()) { LIMITS } else { "" };
    let mut columns = Columns::headed(labels(&shown).into_iter().chain([limits.to_owned()]));
    for row in rows {
        let mut cells: Vec<String> =
            sweep.axes().iter().zip(&row.values).map(|(axis, value)| axis.text(*value)).collect();
        cells.extend(shown.iter().map(|quantity| number(row, *quantity)));
        cells.push(row.outside.join(", "));
        cells.push(match &row.status {
            RunStatus::Failed(_) => "FAILED".to_owned(),
            RunStatus::Converged if row.stopped_by == Some(StoppedBy::Budget) => TIME_UP.to_owned(),
            status => json::mark(&status.to_string()),
        });
        columns.row(cells);
    }
    let numbers: Vec<usize> = (0..keys.len() + shown.len()).collect();
    text.push_str(&columns.text(&numbers));
    let published = sweep.published();
    if !published.is_empty() {
        text.push_str("\nPublished there (Table I):\n\n");
        let mut columns = Columns::headed(labels(&[Quantity::Alpha, Quantity::FilmLoad]));
        for point in &published {
            let mut cells: Vec<String> = point.values.iter().map(f64::to_string).collect();
            cells.extend([format!("{:.3}", point.alpha), format!("{:.3}", point.film_load), point.row.clone()]);
            columns.row(cells);
        }
        text.push_str(&columns.text(&numbers[..keys.len() + 2]));
    }
    text
}

/// Quantities in the table on the terminal; the files have all of them.
const SHOWN: [Quantity; 12] = [
    Quantity::Alpha,
    Quantity::MeanGap,
    Quantity::FloatingStiffness,
    Quantity::SlowDamping,
    Quantity::CreepTime,
    Quantity::SwingFrequency,
    Quantity::FilmLoad,
    Quantity::LoadRatio,
    Quantity::StallTorque,
    Quantity::TeethInContact,
    Quantity::MinGap,
    Quantity::FilmSteps,
];

/// Relative error up to which a number may be shown without its error.
const WELL_KNOWN: f64 = 0.1;

fn number(SweepRow { numbers, .. }: &SweepRow, quantity: Quantity) -> String {
    // The film load repeats α or the load ratio, which shows its error; the load ratio of a floating plate follows from the given load.
    let floats = || numbers.get(Quantity::MeanGap).is_some();
    let said = quantity == Quantity::FilmLoad || quantity == Quantity::LoadRatio && floats();
    match numbers.estimate(quantity) {
        Some(Estimate { value, error }) if said && error <= WELL_KNOWN * value.abs() => significant(value, 4),
        _ => numbers.text(quantity),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::quantity::Numbers;
    use crate::scene::presets;
    use crate::solve::Settings;

    #[test]
    fn the_worst_row_decides_and_is_marked() {
        let scene = presets::find("fundamental").unwrap();
        let vary: Vary = "film.min_spacing_nm=100:200:3".parse().unwrap();
        let sweep = Sweep::new(&scene, &[vary], &Settings::default()).unwrap();
        let mut numbers = Numbers::default();
        numbers.set(Quantity::Alpha, 0.25);
        let row = |point: usize, status: RunStatus| {
            let outside = if point == 2 { vec!["slip-law", "sound"] } else { Vec::new() };
            let stopped_by = Some(if point == 0 { StoppedBy::Budget } else { StoppedBy::Accuracy });
            SweepRow { point, values: sweep.values(point), status, stopped_by, numbers, outside }
        };
        let mut rows = vec![row(0, RunStatus::Converged)];
        assert_eq!(Exit::worst(rows.iter().map(|row| Exit::from(&row.status))), Exit::Solved);
        rows.push(row(1, RunStatus::NotConverged));
        assert_eq!(Exit::worst(rows.iter().map(|row| Exit::from(&row.status))), Exit::NotConverged);
        rows.push(row(2, RunStatus::Failed("no".to_owned())));
        assert_eq!(Exit::worst(rows.iter().map(|row| Exit::from(&row.status))), Exit::Other);
        assert!(!text(&sweep, &rows[..2]).contains("limits exceeded"));
        let shown = text(&sweep, &rows);
        assert!(shown.contains("limits exceeded"), "{shown}");
        assert!(shown.lines().any(|line| line.contains("100 ") && line.ends_with("  time was up")), "{shown}");
        assert!(shown.lines().any(|line| line.contains("150 ") && line.ends_with("NOT CONVERGED")), "{shown}");
        assert!(
            shown.lines().any(|line| line.contains("200 ") && line.ends_with("slip-law, sound  FAILED")),
            "{shown}"
        );
        assert!(shown.contains("0.2500 (error not estimated)") && shown.contains("0.481"), "{shown}");
    }
}
