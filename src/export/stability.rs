//! Maps of where a method solves, as JSON and as CSV, with the same names.

use crate::analysis::quantity::Quantity;
use crate::analysis::stability::{Cell, Verdict};
use crate::fidelity::Fidelity;
use crate::solve::Method;
use serde::Serialize;
use std::io::{self, Write};

/// The version of the object.
pub const SCHEMA: u32 = 1;

/// The object of `--json`.
#[derive(Clone, Debug, Serialize)]
pub struct Object<'a> {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Name of the scene whose parameters are mapped.
    pub preset: &'a str,
    /// Fidelity of method auto.
    pub fidelity: &'static str,
    /// One for each cell.
    pub cells: Vec<CellObject>,
    /// Version of this program.
    pub version: &'static str,
    /// The command line, word by word; empty if there was none.
    pub command: &'a [String],
}

impl<'a> Object<'a> {
    /// The object of a survey.
    pub fn new(preset: &'a str, fidelity: Fidelity, cells: &[Cell], command: &'a [String]) -> Self {
        Self {
            schema: SCHEMA,
            preset,
            fidelity: fidelity.name(),
            cells: cells.iter().map(CellObject::new).collect(),
            version: env!("CARGO_PKG_VERSION"),
            command,
        }
    }
}

/// One cell, a row of the CSV. What is not known is null, or empty.
#[derive(Clone, Debug, Serialize)]
pub struct CellObject {
    /// The map.
    pub map: &'static str,
    /// `auto` or `paper`.
    pub method: &'static str,
    /// Key along x.
    pub x_key: &'static str,
    /// Its value, in the unit of the key.
    pub x: f64,
    /// Key along y.
    pub y_key: &'static str,
    /// Its value, in the unit of the key.
    pub y: f64,
    /// `solved`, `not converged`, `non-physical`, `failed` or `refused`.
    pub verdict: &'static str,
    /// α.
    pub alpha: Option<f64>,
    /// Its stated error, absolute.
    pub alpha_error: Option<f64>,
    /// Change of the last round, if it did not converge.
    pub residual: Option<f64>,
    /// Rounds of film and contact.
    pub coupling_iterations: Option<u64>,
    /// Cycles marched.
    pub cycles: Option<u64>,
    /// Time steps of one tooth's film.
    pub film_steps: Option<u64>,
    /// Why, and what about the numbers cannot be.
    pub detail: String,
    /// Options of the command line that solve it.
    pub options: String,
}

impl CellObject {
    fn new(cell: &Cell) -> Self {
        let number = |quantity| cell.numbers.get(quantity);
        let count = |quantity| number(quantity).map(|count| count as u64);
        Self {
            map: cell.map.name,
            method: cell.method.name(),
            x_key: cell.changes[0].0,
            x: cell.changes[0].1,
            y_key: cell.changes[1].0,
            y: cell.changes[1].1,
            verdict: cell.verdict.name(),
            alpha: number(Quantity::Alpha),
            alpha_error: number(Quantity::AlphaError),
            residual: number(Quantity::Residual),
            coupling_iterations: count(Quantity::Rounds),
            cycles: count(Quantity::Cycles),
            film_steps: count(Quantity::FilmSteps),
            detail: detail(cell),
            options: cell.options(),
        }
    }
}

/// Why a cell is not solved, and what about its numbers cannot be.
pub fn detail(cell: &Cell) -> String {
    let mut reasons: Vec<String> = cell.faults.iter().map(ToString::to_string).collect();
    match &cell.verdict {
        Verdict::Failed(reason) | Verdict::Refused(reason) => reasons.insert(0, reason.clone()),
        Verdict::NotConverged => reasons.insert(
            0,
            match cell.numbers.get(Quantity::Residual) {
                Some(residual) => format!("the last round still changed by {residual:.1e}"),
                None if cell.method == Method::Paper => "stopped: too many cycles".to_owned(),
                None => "no number left".to_owned(),
            },
        ),
        Verdict::Solved | Verdict::NonPhysical => {}
    }
    reasons.join("; ")
}

/// Writes the cells as CSV, the header first.
///
/// # Errors
/// Those of the writer.
pub fn write_csv(cells: &[Cell], out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    for cell in cells {
        writer.serialize(CellObject::new(cell))?;
    }
    writer.flush()
}
