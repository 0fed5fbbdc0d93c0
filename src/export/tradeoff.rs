//! Error against time as JSON and as CSV, with the same names.

use super::sweep::status as sweep_status;
use crate::analysis::quantity::Quantity;
use crate::analysis::sweep::Ending;
use crate::analysis::tradeoff::{Ended, Family, Point, Tradeoff};
use serde::Serialize;
use std::io::{self, Write};

/// The version of the object.
pub const SCHEMA: u32 = 1;

/// The object of `--json`.
#[derive(Clone, Debug, Serialize)]
pub struct Object<'a> {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Name of the scene.
    pub preset: &'a str,
    /// The number that is judged: `alpha` or `film_load_n`.
    pub judged: &'static str,
    /// The setting that the others are judged by.
    pub reference: Option<&'a str>,
    /// One for each setting.
    pub settings: Vec<SettingObject>,
    /// The settings that were asked for, if any.
    pub chosen: Vec<ChoiceObject>,
    /// Version of this program.
    pub version: &'static str,
    /// The command line, word by word; empty if there was none.
    pub command: &'a [String],
}

/// A setting chosen.
#[derive(Clone, Debug, Serialize)]
pub struct ChoiceObject {
    /// `accuracy` or `budget_s`.
    pub wish: &'static str,
    /// The share, or the time \[s\].
    pub value: f64,
    /// The setting, or null if none serves.
    pub setting: Option<String>,
    /// Options of the command line that choose it.
    pub options: Option<String>,
}

/// One setting, a row of the CSV. What is not known is null, or empty.
#[derive(Clone, Debug, Serialize)]
pub struct SettingObject {
    /// Its name.
    pub setting: String,
    /// `fidelity`, `grid` or `paper`.
    pub family: &'static str,
    /// `converged`, `not converged`, `given up`, `failed: …`, or `waiting`.
    pub status: String,
    /// Median time \[s\].
    pub median_s: Option<f64>,
    /// Lower quartile \[s\].
    pub lower_quartile_s: Option<f64>,
    /// Upper quartile \[s\].
    pub upper_quartile_s: Option<f64>,
    /// Number of runs.
    pub runs: usize,
    /// The value that is judged.
    pub value: Option<f64>,
    /// The greater of the next two, by which it is judged.
    pub error: Option<f64>,
    /// Distance from the reference plus the reference's own stated error, relative.
    pub measured_error: Option<f64>,
    /// The error it states of itself, relative.
    pub stated_error: Option<f64>,
    /// No other is at once as fast and as accurate.
    pub pareto: bool,
    /// The one that the others are judged by.
    pub reference: bool,
    /// Film nodes of the finest grid.
    pub film_nodes: usize,
    /// Steps in a cycle of the finest grid.
    pub steps_per_cycle: usize,
    /// Time steps of one tooth's film.
    pub film_steps: Option<u64>,
    /// Rounds of film and contact.
    pub coupling_iterations: Option<u64>,
    /// Contact problems solved.
    pub contact_solves: Option<u64>,
    /// Options of the command line that choose it.
    pub options: String,
}

impl SettingObject {
    fn new(point: &Point, judged: Quantity, reference: bool) -> Self {
        let finite = |value: f64| value.is_finite().then_some(value);
        let run = &point.run;
        let count = |quantity| run.numbers.get(quantity).map(|count| count as u64);
        Self {
            setting: run.candidate.name.clone(),
            family: match run.candidate.family {
                Family::Fidelity => "fidelity",
                Family::Grid => "grid",
                Family::Paper => "paper",
            },
            status: status(&run.ended),
            median_s: finite(point.median),
            lower_quartile_s: finite(point.quartiles.0),
            upper_quartile_s: finite(point.quartiles.1),
            runs: run.times.len(),
            value: run.numbers.get(judged),
            error: point.error.and_then(finite),
            measured_error: point.measured.and_then(finite),
            stated_error: point.stated.and_then(finite),
            pareto: point.best,
            reference,
            film_nodes: run.grid.0,
            steps_per_cycle: run.grid.1,
            film_steps: count(Quantity::FilmSteps),
            coupling_iterations: count(Quantity::Rounds),
            contact_solves: count(Quantity::ContactSolves),
            options: run.candidate.options(),
        }
    }
}

/// How a setting ended, in words.
pub fn status(ended: &Ended) -> String {
    match ended {
        Ended::Waiting => "waiting".to_owned(),
        Ended::Converged => sweep_status(&Ending::Converged),
        Ended::NotConverged => sweep_status(&Ending::NotConverged),
        Ended::GivenUp => "given up".to_owned(),
        Ended::Failed(reason) => sweep_status(&Ending::Failed(reason.clone())),
    }
}

/// One for each setting, in the order of the curve.
pub fn settings(tradeoff: &Tradeoff) -> Vec<SettingObject> {
    let object = |(i, point)| SettingObject::new(point, tradeoff.judged, tradeoff.reference == Some(i));
    tradeoff.points.iter().enumerate().map(object).collect()
}

/// Writes the settings as CSV, the header first.
///
/// # Errors
/// Those of the writer.
pub fn write_csv(tradeoff: &Tradeoff, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    for setting in settings(tradeoff) {
        writer.serialize(setting)?;
    }
    writer.flush()
}
