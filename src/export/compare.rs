//! A comparison as JSON, CSV, figures, animations and a report.
//!
//! Numbers are written with the fewest digits that read back to the same bits.

use super::animation::{Movie, Options};
use super::csv::words as csv_words;
use super::error::ExportError;
use super::estimates;
use super::figure::{Figure, Provenance, Style};
use super::figures::compare::{self as figures, DrawnRun, MotorRun, PlateRun};
use super::html::{CellKind, Page, Table, shell};
use super::json::{self, TIME_UP, accuracy_entries, beside_limit, mark_of, status_name};
use crate::analysis::compare::{ComparedRun, ParameterRow, ResultCell, ResultRow, parameters, results};
use crate::analysis::decision::{effort, exactness, sentences};
use crate::analysis::quantity::{Quantity, force_unit, labelled};
use crate::analysis::regime;
use crate::analysis::torque::with_film;
use crate::analysis::validity::{ExceededLimit, outside};
use crate::control::Cancel;
use crate::digits::{capitalised, change, raised, significant, with_error};
use crate::estimate::Estimate;
use crate::problem::Scenario;
use crate::recording::Recording;
use crate::scene;
use crate::solution::Performance;
use crate::solve::{Method, Settings};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// `converged`, `not converged`, `cancelled` or `failed: …`.
pub fn status(run: &ComparedRun) -> String {
    match &run.solved {
        Ok(solution) => status_name(&solution.status).to_owned(),
        Err(reason) => format!("failed: {reason}"),
    }
}

/// How a solve ended, if the reader should see it at once: it did not converge, or its time limit was reached before the requested
/// accuracy.
pub fn mark(run: &ComparedRun) -> String {
    run.solved.as_ref().map_or_else(|_| json::mark(&status(run)), |solution| mark_of(solution))
}

/// The object of `--json`: the runs, of which the first is the reference for differences, and the keys in which their scenes differ.
pub fn object(runs: &[ComparedRun], settings: &Settings) -> Value {
    let rows = results(runs);
    let differing = parameter_rows(runs).into_iter().filter(ParameterRow::differs).map(|row| {
        let ParameterRow { parameter, values, .. } = row;
        json!({ "key": parameter.key, "unit": parameter.unit, "values": values })
    });
    json!({
        "method": settings.method.name(),
        // The paper's method has no fidelity.
        "fidelity": (settings.method == Method::Auto).then(|| settings.fidelity.to_string()),
        "runs": runs.iter().enumerate().map(|(i, run)| run_object(run, i, &rows)).collect::<Vec<_>>(),
        "differing": differing.collect::<Vec<_>>(),
    })
}

/// The run with this index, with the names of `solve --json` as far as the scene has them.
fn run_object(run: &ComparedRun, place: usize, rows: &[ResultRow]) -> Value {
    let mut object = json!({
        "label": run.label,
        "preset": run.problem.name,
        "scene": run.scene.scene(),
        "status": status(run),
        "converged": run.converged(),
        "force_unit": force_unit(&run.problem),
    });
    let solution = run.solved.as_ref().ok();
    for (name, value) in accuracy_entries(solution.map(|solution| solution.accuracy)) {
        object[name] = value;
    }
    for (name, value) in estimates::named(Quantity::of(&run.problem), &run.numbers()) {
        object[name] = value;
    }
    let difference = |row: &ResultRow| Some((row.quantity.name(), row.cells[place].difference_percent?));
    let differences: BTreeMap<_, _> = rows.iter().filter_map(difference).collect();
    let of = |part: fn(&Estimate) -> f64| {
        json!(differences.iter().map(|(name, found)| (name, part(found))).collect::<BTreeMap<_, _>>())
    };
    object["difference_percent"] = of(|found| found.value);
    object["difference_error_percent"] = of(|found| found.error);
    object["why"] = solution.map(|solution| sentences(&solution.model)).into();
    object["validity"] = json!(solution.map(|solution| outside(&run.problem, solution)));
    object["warnings"] = json!(solution.map(|solution| &solution.warnings));
    object["scene_toml"] = run.scene.to_toml().into();
    object
}

/// The parameters of the runs' scenes.
pub fn parameter_rows(runs: &[ComparedRun]) -> Vec<ParameterRow> {
    parameters(&runs.iter().map(|run| &run.scene).collect::<Vec<_>>())
}

/// Writes the results as CSV, a row for each run and quantity; missing values are empty.
pub fn write_csv(runs: &[ComparedRun], out: &mut dyn Write) -> io::Result<()> {
    let rows = results(runs).into_iter().flat_map(|row| {
        let of_run = |(i, (run, cell)): (usize, (&ComparedRun, &ResultCell))| {
            json!({
                "run": i + 1,
                "label": run.label,
                "scene": run.scene.scene(),
                "status": status(run),
                "stopped_by": run.solved.as_ref().ok().map(|solution| solution.accuracy.stopped_by.name()),
                "validity": run.outside().join(";"),
                "quantity": row.quantity.name(),
                "unit": cell.unit,
                "value": cell.found.map(|found| found.value),
                "error": cell.found.map(|found| found.error),
                "difference_percent": cell.difference_percent.map(|found| found.value),
                "difference_error_percent": cell.difference_percent.map(|found| found.error),
            })
        };
        runs.iter().zip(&row.cells).enumerate().map(of_run).collect::<Vec<_>>()
    });
    super::csv::rows(rows, out)
}

/// Writes the parameters as CSV, a row for each key and a column for each run.
pub fn write_parameters_csv(runs: &[ComparedRun], all: bool, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let labels = runs.iter().map(|run| csv_words(&run.label).into_owned());
    writer.write_record(["key", "unit"].map(str::to_owned).into_iter().chain(labels))?;
    for row in parameter_rows(runs).iter().filter(|row| all || row.differs()) {
        let values = row.values.iter().map(|value| match value {
            None => String::new(),
            Some(scene::Value::Text(text)) => csv_words(text).into_owned(),
            Some(value) => value.to_string(),
        });
        let first = [row.parameter.key.to_owned(), row.parameter.unit.to_owned()];
        writer.write_record(first.into_iter().chain(values))?;
    }
    writer.flush()
}

/// Runs that have fields and whose scene is a motor, or a plate, as `of` says.
fn runs_of<'a, S>(runs: &'a [ComparedRun], of: impl Fn(&'a Scenario) -> Option<&'a S>) -> Vec<DrawnRun<'a, S>> {
    let drawn = |(i, run): (usize, &'a ComparedRun)| {
        let recording = &run.solved.as_ref().ok().filter(|solution| solution.recording.frames > 0)?.recording;
        Some(DrawnRun { name: &run.label, scene: of(&run.problem.scenario)?, recording, style: Style::unmarked(i) })
    };
    runs.iter().enumerate().filter_map(drawn).collect()
}

fn motors_and_plates(runs: &[ComparedRun]) -> (Vec<MotorRun<'_>>, Vec<PlateRun<'_>>) {
    (runs_of(runs, Scenario::motor), runs_of(runs, Scenario::plate))
}

/// Torque and power of the motors that have fields.
fn performances(runs: &[ComparedRun]) -> Vec<Performance> {
    let performance = |run: &ComparedRun| {
        let solution = run.solved.as_ref().ok().filter(|solution| solution.recording.frames > 0)?;
        let (motor, result) = run.problem.scenario.motor().zip(solution.outcome.motor())?;
        Some(with_film(motor, result, &solution.recording))
    };
    runs.iter().filter_map(performance).collect()
}

/// The name of a run above figures: its label or, if that is the name of its scene, the scene's headline, which names the changes.
fn headline(run: &ComparedRun) -> String {
    if run.label == run.scene.name { run.scene.headline() } else { run.label.clone() }
}

/// Where the numbers of a comparison come from.
pub fn provenance(runs: &[ComparedRun]) -> Provenance {
    let fidelity = runs.iter().find_map(|run| Some(run.solved.as_ref().ok()?.model.fidelity.clone()));
    let unsolved = runs.iter().filter(|run| !run.converged()).count();
    let late = runs.iter().filter(|run| mark(run) == TIME_UP).count();
    let notes = [(unsolved, "NOT CONVERGED".to_owned()), (late, format!("where {TIME_UP}"))];
    let notes = notes.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
    let main = |run: &ComparedRun| {
        let numbers = run.numbers();
        let (quantity, name) = match &run.problem.scenario {
            Scenario::Motor(_) => (Quantity::Alpha, "α"),
            Scenario::Plate(plate) if plate.load.is_some() => (Quantity::MeanGap, "mean gap in µm"),
            Scenario::Plate(_) => (Quantity::LoadRatio, "load ratio"),
        };
        let found = numbers.estimate(quantity)?;
        Some(format!("{name} = {found}"))
    };
    Provenance {
        fidelity: fidelity.unwrap_or_default(),
        error: runs.iter().filter_map(main).collect::<Vec<_>>().join(", "),
        note: notes.collect::<Vec<_>>().join(", "),
        ..Provenance::named(&runs.iter().map(headline).collect::<Vec<_>>().join(", "))
    }
}

/// The figures, each with its file name without extension; the names of plates' figures begin with `plate-` if there are motors too.
pub fn all_figures(runs: &[ComparedRun]) -> Vec<(String, Figure)> {
    let (motors, plates) = motors_and_plates(runs);
    let prefix = if motors.is_empty() { "" } else { "plate-" };
    let of_motors = figures::motors(&motors, &performances(runs)).into_iter().map(|named| ("", named));
    let of_plates = figures::plates(&plates).into_iter().map(|named| (prefix, named));
    let provenance = provenance(runs);
    let whole = |figure| Figure { provenance: provenance.clone(), ..figure };
    of_motors.chain(of_plates).map(|(prefix, (name, figure))| (format!("{prefix}{name}"), whole(figure))).collect()
}

/// Animations of the runs in phase, one of the motors and one of the plates, each with its file name without extension.
/// `done` is called after each frame, from several threads.
pub fn movies(
    runs: &[ComparedRun],
    done: &(dyn Fn() + Sync),
    cancel: &Cancel,
) -> Result<Vec<(&'static str, Movie)>, ExportError> {
    let (motors, plates) = motors_and_plates(runs);
    let (provenance, options) = (provenance(runs), Options::default());
    let movie = |recordings: Vec<&Recording>, draw: &(dyn Fn(f64) -> Figure + Sync)| {
        let count = figures::common_frames(recordings.into_iter(), options.frames);
        let figure = |frame: usize| {
            let phase = frame as f64 / count as f64;
            Figure { title: format!("t/T = {phase:.2}"), provenance: provenance.clone(), ..draw(phase) }
        };
        Movie::of(count, &options, &figure, done, cancel)
    };
    let mut movies = Vec::new();
    if !motors.is_empty() {
        let recordings = motors.iter().map(|run| run.recording).collect();
        movies.push(("cycle", movie(recordings, &|phase| figures::moving_motors(&motors, phase))?));
    }
    if !plates.is_empty() {
        let recordings = plates.iter().map(|run| run.recording).collect();
        let name = if motors.is_empty() { "cycle" } else { "plate-cycle" };
        movies.push((name, movie(recordings, &|phase| figures::moving_plates(&plates, phase))?));
    }
    Ok(movies)
}

/// Number of frames that [`movies`] draws.
pub fn frames(runs: &[ComparedRun]) -> usize {
    let (motors, plates) = motors_and_plates(runs);
    let most = Options::default().frames;
    figures::common_frames(motors.iter().map(|run| run.recording), most)
        + figures::common_frames(plates.iter().map(|run| run.recording), most)
}

/// A value with its error, with as many digits as the error justifies; counts as whole numbers. It has its unit if the runs have different
/// units.
pub fn value_text(row: &ResultRow, cell: &ResultCell) -> String {
    let text = match (row.quantity, cell.found) {
        // This is the form in the tab Torque.
        (Quantity::MaxEfficiency, Some(found)) => format!("{} %", found * 100.0),
        _ => row.quantity.text(cell.found),
    };
    if row.unit.is_none() && cell.found.is_some() { format!("{text} {}", cell.unit) } else { text }
}

/// `+3.2 ± 0.1 %`; for a value in another unit than that of the first run, the two units in place of a difference: `N/m, not N`.
pub fn difference_text(row: &ResultRow, cell: &ResultCell) -> String {
    let first = row.cells.first().filter(|first| first.found.is_some() && cell.found.is_some());
    if let Some(first) = first.filter(|first| first.unit != cell.unit) {
        return format!("{}, not {}", cell.unit, first.unit);
    }
    let Some(Estimate { value, error }) = cell.difference_percent else { return String::new() };
    match value {
        _ if error.is_finite() && error > 0.0 => {
            format!("{}{} %", if value > 0.0 { "+" } else { "" }, with_error(value, error))
        }
        0.0 => "0 %".to_owned(),
        _ if value.abs() >= 1000.0 => format!("× {}", significant(1.0 + value / 100.0, 3)),
        _ => change(value, if value.abs() < 0.1 { 3 } else { 1 }),
    }
}

/// The rows of a table of results: the quantity, its description, and for each run its value and its difference from the first. If runs
/// exceed limits of the model, the last row lists these limits.
pub fn result_texts(runs: &[ComparedRun]) -> Vec<(Option<Quantity>, String, Vec<[String; 2]>)> {
    let texts = |row: ResultRow| {
        let cells = row.cells.iter().map(|cell| [value_text(&row, cell), difference_text(&row, cell)]);
        (Some(row.quantity), row.label(), cells.collect())
    };
    let limits: Vec<_> = runs.iter().map(|run| [run.outside().join(", "), String::new()]).collect();
    let exceeded = limits.iter().any(|[names, _]| !names.is_empty());
    let limits = exceeded.then(|| (None, LIMITS.to_owned(), limits));
    results(runs).into_iter().map(texts).chain(limits).collect()
}

/// The comparison as one self-contained HTML file. `all`: lists also parameters that do not differ. `movies`: animations as GIF, each with
/// its name. `command`: the command that makes it again, empty if the window makes it.
pub fn report(
    runs: &[ComparedRun],
    settings: &Settings,
    all: bool,
    movies: &[(String, Vec<u8>)],
    command: &[String],
) -> String {
    if runs.is_empty() {
        return Page::new("squeezefilm", "Nothing to compare", "").finish("");
    }
    let names: Vec<String> = runs.iter().map(headline).collect();
    let others = &names[1..];
    let mut found: Vec<String> = Vec::new();
    for solution in runs.iter().filter_map(|run| run.solved.as_ref().ok()) {
        let exactness = exactness(&solution.model.fidelity);
        if !found.contains(&exactness) {
            found.push(exactness);
        }
    }
    let how = match settings.method {
        Method::Auto if found.is_empty() => effort(settings, None),
        Method::Auto => found.join(", "),
        Method::Paper => "the algorithm of Maeno and Bogy on its own meshes".to_owned(),
    };
    let lead = if others.is_empty() {
        format!(
            "One scene, solved for its periodic steady state ({how}). The ± is the solver's estimate of its numerical error."
        )
    } else {
        format!(
            "{} scenes, each solved by itself for its periodic steady state ({how}). Differences are from the first, in per \
             cent of its value. The ± is the solver's estimate of its numerical error; that of a difference is the most that both make of it.",
            runs.len()
        )
    };
    let mut page = if others.is_empty() {
        Page::new("squeezefilm · report", &names[0], &lead)
    } else {
        Page::new("squeezefilm · comparison", &names.join(" · "), &lead)
    };
    for run in runs {
        if !run.converged() {
            page.warning(&format!("{}: {}", run.label, status(run)));
        } else if mark(run) == TIME_UP {
            page.warning(&format!("{}: {TIME_UP} before the result was as accurate as requested", run.label));
        }
    }

    page.section(if others.is_empty() { "Parameters" } else { "What differs" });
    let rows = parameter_rows(runs);
    let [asked, all] = [all, all || others.is_empty()];
    if all || rows.iter().any(|row| row.differs()) {
        page.table(&parameter_table(runs, rows.iter().filter(|row| all || row.differs())));
    } else {
        page.text("The scenes do not differ in any parameter.");
    }

    page.section("Results");
    page.table(&result_table(runs));

    page.section("Fields");
    for (name, gif) in movies {
        let [alternative, caption] = if others.is_empty() {
            ["One cycle", "The cycle repeats."]
        } else {
            [
                "One cycle of all runs in phase",
                "All runs at the same phase of their own cycle, whatever its frequency; the cycle repeats.",
            ]
        };
        page.picture(gif, alternative, if name == "cycle" { "One cycle." } else { "One cycle, plates." }, caption);
    }
    let figures = all_figures(runs);
    page.figures(figures.iter().map(|(_, figure)| ("", figure)));

    page.section("What was modelled");
    for run in runs {
        page.heading(&run.label);
        if !run.scene.about.is_empty() {
            page.text(&run.scene.about);
        }
        match &run.solved {
            Ok(solution) => {
                page.list(sentences(&solution.model));
                page.text(&format!("The film: {}.", regime::weight(&run.problem, &solution.outcome)));
                limits(&mut page, &outside(&run.problem, solution));
                solution.warnings.iter().for_each(|warning| page.warning(warning));
            }
            Err(reason) => page.warning(reason),
        }
        page.folded("the scene as a preset", &run.scene.to_toml());
    }
    if command.is_empty() {
        again_from_scenes(&mut page, runs, settings, asked && !others.is_empty());
    } else {
        again(&mut page, command);
    }
    page.finish(&provenance(runs).line())
}

/// Limits of the model that are exceeded; empty if none.
pub(super) fn limits(page: &mut Page, validity: &[ExceededLimit]) {
    if !validity.is_empty() {
        page.warning("Outside the limits of the model:");
        let name = |excess: &ExceededLimit| capitalised(&excess.name.replace('-', " "));
        page.list(validity.iter().map(|excess| format!("{}: {}. {}", name(excess), beside_limit(excess), excess.text)));
    }
}

/// Title of the section that says how a report is made again.
const AGAIN: &str = "To make this report again";

/// The section that says how to make the report again, with the command that made it.
pub(super) fn again(page: &mut Page, command: &[String]) {
    page.section(AGAIN);
    page.code(&shell(command));
    page.note(&format!(
        "squeezefilm {}. A run repeats to the last bit, whatever the number of threads; only times differ.",
        env!("CARGO_PKG_VERSION")
    ));
}

/// The same section of a report that the window made: a command that reads the scenes in the page.
fn again_from_scenes(page: &mut Page, runs: &[ComparedRun], settings: &Settings, all: bool) {
    page.section(AGAIN);
    let files: Vec<String> = match runs.len() {
        1 => vec!["scene.toml".to_owned()],
        count => (1..=count).map(|place| format!("scene-{place}.toml")).collect(),
    };
    let (each, named) = if runs.len() == 1 {
        ("", "scene.toml".to_owned())
    } else {
        (" of each run", format!("scene-1.toml to scene-{}.toml, in their order here", runs.len()))
    };
    page.text(&format!(
        "This needs squeezefilm {}, and the text under “the scene as a preset”{each}, above, saved as {named}.",
        env!("CARGO_PKG_VERSION")
    ));
    let how = match settings.method {
        Method::Auto => settings.fidelity.option(),
        Method::Paper => format!("--method {}", settings.method.name()),
    };
    let begins = ["squeezefilm", "compare"].map(str::to_owned).into_iter().chain(files);
    let options = how.split(' ').chain(all.then_some("--all")).chain(["--out", "report"]).map(str::to_owned);
    page.code(&shell(&begins.chain(options).collect::<Vec<_>>()));
    page.note("The window starts each solve from the one before: another run agrees with it within the stated errors.");
}

/// The row of a table of results with the limits of the model that each run exceeds.
pub const LIMITS: &str = "limits exceeded";

/// With more runs than this, the differences are below the values instead of beside them.
const BESIDE: usize = 2;

fn parameter_table<'a>(runs: &[ComparedRun], rows: impl Iterator<Item = &'a ParameterRow>) -> Table {
    let labels = runs.iter().map(|run| (CellKind::Number, run.label.clone()));
    let names = ["parameter", "key"].map(|head| (CellKind::Words, head.to_owned()));
    let mut table = Table::default().heads(names.into_iter().chain(labels));
    for row in rows {
        // Values that differ from the first run are marked.
        let values = row.values.iter().enumerate().map(|(place, value)| match value {
            Some(shown) if *value == row.values[0] => (CellKind::Number, shown.to_string()),
            Some(shown) => (CellKind::Strong, shown.to_string()),
            None => (CellKind::Quiet, row.missing(place).to_owned()),
        });
        let name = capitalised(&labelled(&row.parameter.words(), row.parameter.unit));
        table.row([(CellKind::Words, name), (CellKind::Quiet, row.parameter.key.to_owned())].into_iter().chain(values));
    }
    table
}

fn result_table(runs: &[ComparedRun]) -> Table {
    let beside = runs.len() <= BESIDE;
    let mut heads = vec![(CellKind::Words, "result".to_owned())];
    for (i, run) in runs.iter().enumerate() {
        heads.push((CellKind::Number, run.label.clone()));
        if beside && i > 0 {
            heads.push((CellKind::Number, "difference".to_owned()));
        }
    }
    let mut table = Table::default().heads(heads);
    for (quantity, name, texts) in result_texts(runs) {
        let kind = match quantity {
            Some(quantity) if Quantity::HEADLINES.contains(&quantity) => CellKind::Strong,
            Some(_) => CellKind::Number,
            None => CellKind::Words,
        };
        let mut cells = vec![(CellKind::Words, name)];
        for (i, [value, difference]) in texts.into_iter().enumerate() {
            // The limits are given in words.
            let value = if quantity.is_none() { value.replace('-', " ") } else { raised(&value) };
            let difference = raised(&difference);
            match (beside, i) {
                (true, 1..) => cells.extend([(kind, value), (CellKind::Number, difference)]),
                _ => cells.push((kind, format!("{value}\n{difference}").trim_end().to_owned())),
            }
        }
        table.row(cells);
    }
    table
}
