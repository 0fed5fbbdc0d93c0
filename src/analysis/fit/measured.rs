//! Tables of measurements in CSV format, with one or more measurements in each line.

use crate::analysis::error::AnalysisError;
use crate::analysis::quantity::Quantity;
use crate::analysis::table1::scene_of;
use crate::input::{csv_fault, csv_line, read_text};
use crate::problem::Problem;
use crate::scene::table1::published;
use crate::scene::{PARAMETERS, Parameter, Scene, SceneError, nearest, presets, show_text};
use crate::solve::Method;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::str::FromStr;

/// Largest table of measurements that is read \[MB\].
pub const LARGEST_TABLE: u64 = 10;
/// The name of the table that is built into the program: Table I of Maeno and Bogy (1992).
pub const TABLE1: &str = "table1";
const MOST_LINES: usize = 10_000;
/// Names of lines in a message, at most.
const MOST_NAMED: usize = 20;

/// The column of the rotor's speed, which goes with [`TORQUE`].
const SPEED: &str = "rotor_speed_rpm";
/// The column of torques, each at the speed in [`SPEED`].
const TORQUE: &str = "torque_nm";
/// The column with the weight of a line.
const WEIGHT: &str = "weight";
/// Columns with names or notes.
const LABELS: [&str; 3] = ["row", "name", "note"];

/// A number that was measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Observable {
    /// A number of a solve.
    Number(Quantity),
    /// The torque of the whole ring \[N m\] at a speed of its rotor, computed with the pressures at the scene's own speed.
    Torque {
        /// The speed \[rpm\].
        speed_rpm: f64,
    },
}

impl Observable {
    /// Its name in files, with its unit.
    pub fn name(self) -> &'static str {
        match self {
            Self::Number(quantity) => quantity.name(),
            Self::Torque { .. } => TORQUE,
        }
    }

    /// Its description with its unit: `film load, N`.
    pub fn label(self, problem: &Problem) -> String {
        match self {
            Self::Number(quantity) => quantity.label(problem),
            Self::Torque { .. } => "torque, N·m".to_owned(),
        }
    }

    /// The speed of the rotor \[rpm\] that a torque belongs to.
    pub fn speed_rpm(self) -> Option<f64> {
        if let Self::Torque { speed_rpm } = self { Some(speed_rpm) } else { None }
    }
}

/// One measured number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// The name of its line, or its number in the file.
    pub label: String,
    /// Which of the conditions it was measured under.
    pub condition: usize,
    /// The observable that was measured.
    pub what: Observable,
    /// The value, in the unit of its name.
    pub value: f64,
    /// Its standard error; if [`Measured::errors_known`] is false, only the ratios of errors count.
    pub error: f64,
}

/// A table of measurements, and the conditions under which they were made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Name of the table.
    pub name: String,
    /// Keys and values, as in `--set`, by which each condition differs from the scene; no two conditions are equal.
    pub conditions: Vec<Vec<(String, String)>>,
    /// The measurements, line by line.
    pub measurements: Vec<Measurement>,
    /// Whether the sizes of the errors are known.
    pub errors_known: bool,
}

/// The size of the errors: `1%`, `0.005`, `film_load_n=1%`.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorSize {
    /// The name of what was measured; `None` for everything.
    name: Option<String>,
    size: f64,
    /// Whether it is a share of the measured value.
    relative: bool,
}

impl FromStr for ErrorSize {
    type Err = AnalysisError;

    fn from_str(text: &str) -> Result<Self, AnalysisError> {
        let fault = || {
            let expected = "expected a number above 0, or a share, as in 0.005, 1% or film_load_n=1%";
            AnalysisError::Input(format!("error {}: {expected}", show_text(text)))
        };
        let (name, size) = match text.split_once('=') {
            Some((name, size)) => (Some(name.trim().to_owned()), size.trim()),
            None => (None, text.trim()),
        };
        let (number, relative) = size.strip_suffix('%').map_or((size, false), |number| (number.trim(), true));
        let number: f64 = number.parse().map_err(|_| fault())?;
        if !(number > 0.0 && number.is_finite()) {
            return Err(fault());
        }
        Ok(Self { name, size: if relative { number / 100.0 } else { number }, relative })
    }
}

/// Kind of a column.
#[derive(Clone, Copy, PartialEq)]
enum Column {
    Key,
    Value(Option<Quantity>),
    Error(Option<Quantity>),
    Speed,
    Weight,
    Label,
}

/// Numbers that can be measured: those of a solve except its cost and its own errors.
pub fn measurable(problem: &Problem) -> Vec<Quantity> {
    let other = |quantity: &Quantity| matches!(quantity, Quantity::Residual | Quantity::Tolerance);
    Quantity::of(problem).filter(|quantity| !quantity.is_count() && !quantity.is_error() && !other(quantity)).collect()
}

/// Names of measurable numbers, separated by commas.
pub(super) fn names(problem: &Problem) -> String {
    measurable(problem).into_iter().map(|quantity| quantity.column(problem)).collect::<Vec<_>>().join(", ")
}

/// The measurable number of a name.
pub(super) fn named(problem: &Problem, name: &str) -> Option<Quantity> {
    measurable(problem).into_iter().find(|quantity| quantity.name() == name || quantity.column(problem) == name)
}

impl Measured {
    /// The table of a `--data` argument, [`TABLE1`] or the path of a CSV file, for a fit of `scene`.
    pub fn find(name_or_path: &str, scene: &Scene, method: Method) -> Result<Self, AnalysisError> {
        if name_or_path == TABLE1 {
            return Ok(Self::table1(method)?);
        }
        let path = Path::new(name_or_path);
        let text = read_text(path, LARGEST_TABLE)
            .map_err(|fault| AnalysisError::Input(format!("{}: {fault}", path.display())))?;
        Self::from_csv(&text, &show_text(name_or_path), &Problem::try_from(scene)?)
    }

    /// The published film loads of Table I, each with the changes of its row. Their errors are not known and are taken to be the same share
    /// of every load. With `Method::Auto` the rows are converged, so the row with the doubled mesh has no change.
    ///
    /// # Errors
    /// An error in a built-in preset; a test reads them all.
    pub fn table1(method: Method) -> Result<Self, SceneError> {
        let fundamental = presets::find("fundamental")?;
        let mut measured =
            Self { name: "Table I".to_owned(), conditions: Vec::new(), measurements: Vec::new(), errors_known: false };
        for row in published() {
            let scene = scene_of(&row, method)?;
            let changed = scene
                .changed(&fundamental)
                .filter_map(|parameter| Some((parameter.key.to_owned(), scene.get(parameter.key)?.to_string())));
            let condition = measured.condition(changed.collect());
            let what = Observable::Number(Quantity::FilmLoad);
            let value = row.published_load_n;
            measured.measurements.push(Measurement { label: row.row, condition, what, value, error: value });
        }
        Ok(measured)
    }

    /// Reads a table with commas, semicolons or tabs; with semicolons or tabs it may have decimal commas. Its first line names the columns:
    ///
    /// * a key of the scene, as `film.min_spacing_nm`: the condition of the line; an empty cell leaves it as the scene has it;
    /// * a number of a solve, as `film_load_n`, or `torque_nm` with `rotor_speed_rpm`: measured; an empty cell was not measured;
    /// * such a name with `_error` behind it: the standard error of that; `weight`: how much the line counts, if errors are not known;
    /// * `row`, `name` or `note`: words.
    ///
    /// # Errors
    /// [`AnalysisError::Input`], with line, column, value and what is allowed.
    pub fn from_csv(text: &str, origin: &str, problem: &Problem) -> Result<Self, AnalysisError> {
        let fault = |line: Option<u64>, what: String| {
            let line = line.map_or_else(String::new, |line| format!(":{line}"));
            AnalysisError::Input(format!("{origin}{line}: {what}"))
        };
        // The reader counts lines that end in CRLF wrongly.
        let text = &text.replace("\r\n", "\n");
        // If commas are used as decimal commas, semicolons or tabs separate the columns.
        let delimiter = match text.lines().find(|line| !line.starts_with('#')).unwrap_or_default() {
            names if names.contains(';') => b';',
            names if names.contains('\t') && !names.contains(',') => b'\t',
            _ => b',',
        };
        let decimal = |text: &str| if delimiter == b',' { text.to_owned() } else { text.replace(',', ".") };
        let mut reader = csv::ReaderBuilder::new();
        reader.trim(csv::Trim::All).comment(Some(b'#')).delimiter(delimiter);
        let mut reader = reader.from_reader(text.as_bytes());
        let head = reader.headers().map_err(|error| fault(Some(1), csv_fault(&error)))?.clone();
        let first = csv_line(text, head.position());
        let in_head = |what: String| fault(first, what);
        if head.iter().all(str::is_empty) {
            let expected = "expected a line that names the columns, as in rotor_speed_rpm,torque_nm, and a line for each measurement";
            return Err(fault(None, format!("no table: {expected}")));
        }
        let columns: Vec<Column> =
            head.iter().map(|name| column(problem, name)).collect::<Result<_, _>>().map_err(in_head)?;
        for (i, name) in head.iter().enumerate() {
            if head.iter().take(i).any(|other| other == name) {
                return Err(in_head(format!("column {name}: given twice")));
            }
        }
        let place = |wanted: Column| columns.iter().position(|column| *column == wanted);
        let (speed, weight) = (place(Column::Speed), place(Column::Weight));
        let values: Vec<usize> = (0..columns.len()).filter(|i| matches!(columns[*i], Column::Value(_))).collect();
        if values.is_empty() {
            let allowed = names(problem);
            return Err(in_head(format!(
                "no column holds what was measured; allowed: {allowed}, {TORQUE} with {SPEED}"
            )));
        }
        let torque = place(Column::Value(None)).is_some();
        if torque != speed.is_some() {
            let what = if torque {
                format!("{TORQUE} needs a column {SPEED}, the speed of each torque")
            } else {
                format!("{SPEED} needs a column {TORQUE}")
            };
            return Err(in_head(what));
        }
        let error_of = |value: usize| {
            let Column::Value(of) = columns[value] else { return None };
            place(Column::Error(of))
        };
        let known: Vec<bool> = values.iter().map(|value| error_of(*value).is_some()).collect();
        let errors = columns.iter().any(|column| matches!(column, Column::Error(_)));
        if errors && (known.contains(&false) || weight.is_some()) {
            let expected = "give the errors of all that was measured, or of none; a weight only where there are none";
            return Err(in_head(expected.to_owned()));
        }
        let mut measured =
            Self { name: origin.to_owned(), conditions: Vec::new(), measurements: Vec::new(), errors_known: errors };
        for record in reader.records().take(MOST_LINES + 1) {
            let record = record.map_err(|error| fault(csv_line(text, error.position()), csv_fault(&error)))?;
            let line = csv_line(text, record.position());
            if measured.measurements.len() >= MOST_LINES {
                return Err(fault(line, format!("more than {MOST_LINES} measurements")));
            }
            let cell = |i: usize| record.get(i).unwrap_or_default();
            let number = |i: usize| -> Result<Option<f64>, AnalysisError> {
                let text = cell(i);
                match decimal(text).parse::<f64>() {
                    _ if text.is_empty() => Ok(None),
                    Ok(number) if number.is_finite() => Ok(Some(number)),
                    _ => Err(fault(line, format!("column {}: {} is not a number", &head[i], show_text(text)))),
                }
            };
            let above_zero = |i: usize| match number(i)? {
                Some(number) if number > 0.0 => Ok(number),
                _ => Err(fault(
                    line,
                    format!("column {}: \"{}\": expected a number above 0", &head[i], show_text(cell(i))),
                )),
            };
            let changes: Vec<(String, String)> = (0..columns.len())
                .filter(|i| columns[*i] == Column::Key && !cell(*i).is_empty())
                .map(|i| (head[i].to_owned(), decimal(cell(i))))
                .collect();
            let named = (0..columns.len()).find(|i| columns[*i] == Column::Label && !cell(*i).is_empty());
            let label = match named {
                Some(named) => show_text(cell(named)),
                None => line.map_or_else(String::new, |line| format!("line {line}")),
            };
            let counts = weight.map_or(Ok(1.0), &above_zero)?;
            for i in &values {
                let Some(value) = number(*i)? else { continue };
                let what = match (columns[*i], speed) {
                    (Column::Value(Some(quantity)), _) => Observable::Number(quantity),
                    (_, Some(speed)) => match number(speed)? {
                        Some(speed_rpm) => Observable::Torque { speed_rpm },
                        None => return Err(fault(line, format!("column {SPEED}: empty, where there is a {TORQUE}"))),
                    },
                    _ => continue,
                };
                let error = error_of(*i).map_or(Ok(1.0 / f64::sqrt(counts)), &above_zero)?;
                let condition = measured.condition(changes.clone());
                measured.measurements.push(Measurement { label: label.clone(), condition, what, value, error });
            }
        }
        if measured.measurements.is_empty() {
            return Err(fault(None, "no measurements".to_owned()));
        }
        if !errors {
            measured.scale_errors();
        }
        Ok(measured)
    }

    /// Without errors, the errors of a column are assumed to be equal, and proportional to the values in the column.
    fn scale_errors(&mut self) {
        let sizes: Vec<f64> = self
            .measurements
            .iter()
            .map(|one| {
                let alike = self.measurements.iter().filter(|other| other.what.name() == one.what.name());
                let (sum, count) =
                    alike.fold((0.0, 0.0), |(sum, count), other| (sum + other.value * other.value, count + 1.0));
                if sum > 0.0 { f64::sqrt(sum / count) } else { 1.0 }
            })
            .collect();
        self.measurements.iter_mut().zip(sizes).for_each(|(one, size)| one.error *= size);
    }

    /// Sets errors of these sizes; of several that apply, the last one. All measurements must have errors then, from here or from the
    /// table.
    ///
    /// # Errors
    /// A name that was not measured, a share of a value that is 0, or a measurement without an error.
    pub fn with_errors(mut self, sizes: &[ErrorSize]) -> Result<Self, AnalysisError> {
        if sizes.is_empty() {
            return Ok(self);
        }
        let mut names: Vec<&str> = self.measurements.iter().map(|one| one.what.name()).collect();
        names.dedup();
        for name in sizes.iter().filter_map(|size| size.name.as_deref()) {
            if !names.contains(&name) {
                names.sort_unstable();
                names.dedup();
                return Err(AnalysisError::no_such_number("error", name, &names.join(", ")));
            }
        }
        for one in &mut self.measurements {
            let applies = |size: &&ErrorSize| size.name.as_deref().is_none_or(|name| name == one.what.name());
            match sizes.iter().rev().find(applies) {
                Some(size) => one.error = if size.relative { size.size * one.value.abs() } else { size.size },
                None if self.errors_known => {}
                None => one.error = 0.0,
            }
            if one.error <= 0.0 {
                return Err(AnalysisError::Input(format!(
                    "{}: {}: {} = {} has no error: give one, absolute if the value is 0",
                    self.name,
                    one.label,
                    one.what.name(),
                    one.value
                )));
            }
        }
        self.errors_known = true;
        Ok(self)
    }

    /// Removes the lines with these names; at least one must remain.
    pub fn without(mut self, labels: &[String]) -> Result<Self, AnalysisError> {
        for label in labels {
            let before = self.measurements.len();
            self.measurements.retain(|one| one.label != *label);
            if self.measurements.len() == before {
                let mut known: Vec<String> = self.measurements.iter().map(|one| show_text(&one.label)).collect();
                known.dedup();
                known.truncate(MOST_NAMED);
                let (label, known) = (show_text(label), known.join(", "));
                let message = format!("{}: skip {label}: no line has this name; allowed: {known}", self.name);
                return Err(AnalysisError::Input(message));
            }
        }
        if self.measurements.is_empty() {
            return Err(AnalysisError::Input(format!("{}: skip: no measurement is left", self.name)));
        }
        Ok(self)
    }

    /// The index of a condition, which is added if it is new.
    fn condition(&mut self, changes: Vec<(String, String)>) -> usize {
        match self.conditions.iter().position(|other| *other == changes) {
            Some(place) => place,
            None => {
                self.conditions.push(changes);
                self.conditions.len() - 1
            }
        }
    }
}

/// The kind of the column with this name, or why there is none.
fn column(problem: &Problem, name: &str) -> Result<Column, String> {
    if Parameter::find(name).is_some() {
        return Ok(Column::Key);
    }
    if let Some(quantity) = named(problem, name) {
        return Ok(Column::Value(Some(quantity)));
    }
    match name {
        TORQUE => return Ok(Column::Value(None)),
        // The program writes the column in this form in torque.csv.
        SPEED | "speed_rpm" => return Ok(Column::Speed),
        WEIGHT => return Ok(Column::Weight),
        name if LABELS.contains(&name) => return Ok(Column::Label),
        _ => {}
    }
    let of = |stem: &str| if stem == TORQUE { Some(None) } else { named(problem, stem).map(Some) };
    let error = name.strip_suffix("_error").and_then(of).or_else(|| {
        // The program writes such names: film_load_error_n.
        let found =
            measurable(problem).into_iter().find(|quantity| quantity.error().is_some_and(|error| error.name() == name));
        found.map(Some)
    });
    error.map(Column::Error).ok_or_else(|| {
        let measured = measurable(problem).into_iter().map(|quantity| quantity.column(problem));
        let measured: Vec<String> = measured.chain([TORQUE.to_owned()]).collect();
        let errors: Vec<String> = measured.iter().map(|name| format!("{name}_error")).collect();
        let others = PARAMETERS.iter().map(|parameter| parameter.key).chain([SPEED, WEIGHT]).chain(LABELS);
        let near = nearest(name, measured.iter().chain(&errors).map(String::as_str).chain(others))
            .map_or_else(|| "; allowed".to_owned(), |near| format!(": did you mean {near}? Allowed"));
        format!(
            "column {}: unknown{near}: keys of the scene (film.min_spacing_nm), what was measured ({}, {TORQUE} with {SPEED}), \
             each with _error behind it for its standard error, {WEIGHT}, {}",
            show_text(name),
            names(problem),
            LABELS.join(", ")
        )
    })
}
