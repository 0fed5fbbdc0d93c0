//! A start-up as JSON and as CSV, with the same names, and as a figure.

use super::csv;
use super::estimates::finite;
use super::json::{TIME_UP, kind};
use crate::analysis::quantity::{Numbers, Quantity, force_unit};
use crate::analysis::validity::{ExceededLimit, of_outcome};
use crate::estimate::Estimate;
use crate::export::figure::{Axis, Band, Colour, Dash, Figure, Line, Mark, Marker, Panel, Provenance, Style};
use crate::problem::{Problem, Scenario};
use crate::solution::{Accuracy, PlateResult, Status, StoppedBy};
use crate::startup::{Cycle, Settings, Startup};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The numbers of a cycle, in their order in files: means and extremes over it.
fn numbers() -> impl Iterator<Item = Quantity> {
    use Quantity::{
        Alpha, ContactLoad, LoadRatio, LoadRatioError, MaxPressureError, MinGap, TeethInContact, TeethInContactError,
    };
    let ranges = [
        Alpha..=ContactLoad,
        TeethInContact..=TeethInContactError,
        LoadRatio..=LoadRatioError,
        MinGap..=MaxPressureError,
    ];
    Quantity::all().filter(move |number| ranges.iter().any(|range| range.contains(number)))
}

/// One cycle. Its errors are those that follow from the grids.
#[derive(Clone, Copy, Debug)]
pub struct CycleRow {
    /// From 1.
    pub cycle: usize,
    /// The time at its end.
    pub time_us: f64,
    /// Its means and extremes.
    pub numbers: Numbers,
    /// Largest change of ln Z over the cycle.
    pub change: f64,
    /// The remaining change of ln Z; `None` while it is not known.
    pub remaining: Option<f64>,
}

impl CycleRow {
    /// The numbers of a cycle.
    pub fn of(problem: &Problem, cycle: &Cycle) -> Self {
        Self {
            cycle: cycle.number,
            time_us: cycle.number as f64 * cycle.recording.period * 1e6,
            numbers: Numbers::of_outcome(problem, &cycle.outcome),
            change: cycle.change,
            remaining: finite(cycle.remaining),
        }
    }

    /// The numbers as an object, each under the name from `name`, except `load_ratio`; numbers that the scene does not have are null.
    fn object(&self, name: impl Fn(Quantity) -> String) -> Value {
        let mut row = json!({ "cycle": self.cycle, "time_us": self.time_us });
        for number in numbers() {
            row[name(number).trim_start_matches("mean_")] = self.numbers.get(number).into();
        }
        row["change"] = self.change.into();
        row["remaining"] = self.remaining.into();
        row
    }

    /// Progress, 0 to 1, by the logarithm of the remaining change.
    pub fn share(&self, settings: &Settings) -> f64 {
        let by_cycles = self.cycle as f64 / settings.cycles as f64;
        let by_change = self.remaining.map_or(0.0, |left| (left.ln() / settings.tolerance.ln()).clamp(0.0, 1.0));
        by_cycles.max(by_change)
    }
}

/// The object of `--json`: a start-up that ended, and its cycles. `wall_s` is the wall time by the caller's clock, including the periodic
/// solve. Unknown values are null.
pub fn object(problem: &Problem, settings: &Settings, ended: &Startup, rows: &[CycleRow], wall_s: f64) -> Value {
    let (steady, Accuracy { asked, stated, stopped_by }) = (steady(problem, ended), ended.accuracy);
    json!({
        "preset": problem.name,
        "scene": kind(problem),
        "fidelity": settings.fidelity.to_string(),
        "force_unit": force_unit(problem),
        "converged": ended.status == Status::Converged,
        "remaining": ended.remaining,
        "tolerance": settings.tolerance,
        "accuracy_asked": (asked > 0.0).then_some(asked),
        "accuracy_stated": stated,
        "stopped_by": stopped_by.name(),
        "steady": steady.map(|found| found.value),
        "steady_error": steady.map(|found| found.error),
        "film_steps": ended.stats.film_steps,
        "contact_solves": ended.stats.contact_solves,
        "coupling_iterations": ended.stats.coupling_iterations,
        "unsettled_steps": ended.stats.unsettled_steps,
        "wall_s": wall_s,
        "rows": rows.iter().map(|row| row.object(|number| number.name().to_owned())).collect::<Vec<_>>(),
        "validity": validity(problem, ended),
        "warnings": warnings(ended),
    })
}

/// The limits of the model that its last cycle exceeds; without a cycle, those that the scene exceeds by itself.
pub fn validity(problem: &Problem, ended: &Startup) -> Vec<ExceededLimit> {
    of_outcome(problem, (ended.cycles > 0).then_some(&ended.outcome), &ended.decisions)
}

/// Warnings about a start-up for the user.
pub fn warnings(ended: &Startup) -> Vec<String> {
    ended.warnings.iter().cloned().chain(unsettled(ended)).collect()
}

/// Inserts a cycle: after the others, or in place of the same cycle on coarser grids.
pub fn place<T>(rows: &mut Vec<T>, number: usize, row: T) {
    match rows.get_mut(number - 1) {
        Some(coarser) => *coarser = row,
        None => rows.push(row),
    }
}

/// Final value of a start-up by the periodic solve: α, or the load ratio, and its stated error.
pub fn steady(problem: &Problem, startup: &Startup) -> Option<Estimate> {
    startup.steady.map(|found| match &problem.scenario {
        Scenario::Motor(_) => found,
        Scenario::Plate(plate) => found * PlateResult::ratio(1.0, plate),
    })
}

/// A message about steps in which film and contact did not agree; `None` if every step converged.
pub fn unsettled(startup: &Startup) -> Option<String> {
    let (stats, Status::NotConverged { residual, tolerance }) = (&startup.stats, startup.status) else { return None };
    (stats.unsettled_steps > 0).then(|| {
        format!(
            "in {} steps film and contact did not agree within their rounds: they still changed by up to {residual:.1e}, \
             allowed {tolerance:.0e}",
            stats.unsettled_steps
        )
    })
}

/// Writes the rows as CSV, the header first; what is null is empty. Columns of a strip's forces are named `film_load_n_per_m`.
pub fn write_csv(problem: &Problem, rows: &[CycleRow], out: &mut dyn Write) -> io::Result<()> {
    let own: Vec<Quantity> = Quantity::of(problem).collect();
    let column =
        |number: Quantity| if own.contains(&number) { number.column(problem) } else { number.name().to_owned() };
    csv::rows(rows.iter().map(|row| row.object(column)), out)
}

/// The line at the value of the periodic solve.
pub(super) fn periodic(value: f64) -> Mark {
    Mark { style: Style::solid(Colour::ROTOR).dash(Dash::Dashed), ..Mark::horizontal(value, "periodic solve") }
}

/// Cycle means as they approach the steady state, and the film load at every instant. `rows` are those of the cycles.
pub fn figure(problem: &Problem, settings: &Settings, ended: &Startup, rows: &[CycleRow], cycles: &[Cycle]) -> Figure {
    let label = match &problem.scenario {
        Scenario::Motor(_) => "film share of the load α",
        Scenario::Plate(plate) if plate.is_strip() => "film load over p_a × length",
        Scenario::Plate(_) => "film load over p_a × area",
    };
    let at = |row: &CycleRow| (row.cycle as f64, row.numbers.main());
    let band = rows.iter().map(at).map(|(x, Estimate { value, error })| [x, value - error, value + error]);
    let line = rows.iter().map(at).map(|(x, found)| [x, found.value]);
    // A single cycle is drawn as a point.
    let alone = (rows.len() == 1).then(Marker::default);
    let means = Panel::new("", Axis::new("cycle", "").whole(), Axis::new(label, "").including([0.0]))
        .layer(Band::new("error of the grids", band, Colour::FILM))
        .layer(Line::new("mean of the cycle", line, Style { marker: alone, ..Style::solid(Colour::FILM) }))
        .layers(steady(problem, ended).map(|found| periodic(found.value)));
    let loads = cycles.iter().map(|cycle| &cycle.recording.film_load);
    let instants = loads.enumerate().flat_map(|(cycle, loads)| {
        let at = move |step: usize| cycle as f64 + step as f64 / loads.len() as f64;
        loads.iter().enumerate().map(move |(step, load)| [at(step), *load])
    });
    let every = Line::new("", instants, Style::solid(Colour::FILM));
    let film = Panel::new("", Axis::new("t/T", ""), Axis::new("film load", force_unit(problem))).layer(every);
    let caption = "From rest, the film pumps up until the cycle repeats: cycle means above, every instant below.";
    let provenance = Provenance {
        fidelity: settings.fidelity.to_string(),
        error: rows.last().map_or_else(String::new, |last| format!("ends at {}", last.numbers.main())),
        note: if ended.accuracy.stopped_by == StoppedBy::Budget { TIME_UP.to_owned() } else { String::new() },
        ..Provenance::named(&problem.name)
    };
    let figure = Figure { provenance, ..Figure::new("start-up from rest") };
    figure.panel(means).panel(film).caption(caption)
}
