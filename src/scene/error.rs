//! What can be wrong with a scene. A [`SceneError`] holds the first faults and counts the others; its `Display` is what
//! the user sees, one line per fault: `my.toml:12: film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm`.

use super::parameter::{Parameter, Range};
use super::value::{Value, show_number};
use crate::input::ReadError;
use std::fmt;
use std::path::{Path, PathBuf};

/// The version of the file format this program reads and writes.
pub const SCHEMA: i64 = 1;

/// Most faults told at once.
const MOST_FAULTS: usize = 10;

/// What is wrong with a scene: at least one fault and at most ten, in the order of the file, and how many more there are.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    faults: Vec<Fault>,
    more: usize,
}

impl SceneError {
    /// No fault so far.
    pub(super) fn none() -> Self {
        Self { faults: Vec::new(), more: 0 }
    }

    /// Whether further faults are only counted.
    pub(super) fn is_full(&self) -> bool {
        self.faults.len() >= MOST_FAULTS
    }

    /// Adds a fault.
    pub(super) fn push(&mut self, fault: impl Into<Fault>) {
        if self.is_full() { self.more += 1 } else { self.faults.push(fault.into()) }
    }

    /// Counts a fault beyond those that are told.
    pub(super) fn count_one(&mut self) {
        self.more += 1;
    }

    /// Adds the faults of another error.
    pub(super) fn join(&mut self, other: Self) {
        self.more += other.more;
        other.faults.into_iter().for_each(|fault| self.push(fault));
    }

    /// `value`, or the error if there are faults.
    pub(super) fn or<T>(mut self, value: T) -> Result<T, Self> {
        // Stable, so that faults on one line keep the order in which they were found.
        self.faults.sort_by(|a, b| (&a.origin, a.line).cmp(&(&b.origin, b.line)));
        if self.faults.is_empty() { Ok(value) } else { Err(self) }
    }

    /// The faults, at least one and at most ten.
    pub fn faults(&self) -> &[Fault] {
        &self.faults
    }

    /// How many faults there are beside those.
    pub fn more(&self) -> usize {
        self.more
    }

    /// The same faults, said of `origin`, where they name no file of their own.
    pub(super) fn at(mut self, origin: &Path) -> Self {
        for fault in &mut self.faults {
            fault.origin.get_or_insert_with(|| origin.to_owned());
        }
        self
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, fault) in self.faults.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            write!(f, "{fault}")?;
        }
        if self.more > 0 { write!(f, "\nand {} more", self.more) } else { Ok(()) }
    }
}

impl std::error::Error for SceneError {}

impl<F: Into<Fault>> From<F> for SceneError {
    fn from(fault: F) -> Self {
        Self { faults: vec![fault.into()], more: 0 }
    }
}

/// One fault, and where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The file, or the name of the built-in preset; `None` for `--set` and for scenes made in memory.
    pub origin: Option<PathBuf>,
    /// Line in the file, from 1.
    pub line: Option<usize>,
    /// Column in the line, in characters, from 1.
    pub column: Option<usize>,
    /// What is wrong.
    pub what: What,
}

impl From<What> for Fault {
    fn from(what: What) -> Self {
        Self { origin: None, line: None, column: None, what }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(origin) = &self.origin {
            write!(f, "{}:", origin.display())?;
            if let Some(line) = self.line {
                write!(f, "{line}:")?;
            }
            if let (What::Syntax { .. }, Some(column)) = (&self.what, self.column) {
                write!(f, "{column}:")?;
            }
            f.write_str(" ")?;
        }
        write!(f, "{}", self.what)
    }
}

/// What is wrong. Values carry the unit of their key.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum What {
    /// The file is not read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file cannot be written.
    #[error("cannot be written: {reason}")]
    Unwritable {
        /// The system's reason.
        reason: String,
    },
    /// The text is not TOML.
    #[error("not valid TOML: {message}")]
    Syntax {
        /// What the TOML reader expected.
        message: String,
    },
    /// No `schema` key.
    #[error("the key schema is missing: write schema = {SCHEMA} at the top of the file")]
    SchemaMissing,
    /// A `schema` this program does not read.
    #[error("schema = {found} is not supported: this program reads schema = {SCHEMA}")]
    SchemaUnsupported {
        /// The value in the file.
        found: String,
    },
    /// A `scene` that does not exist.
    #[error("scene = {found} is not a scene: allowed \"motor\" or \"plate\"{}", did_you_mean(nearest.as_deref()))]
    UnknownScene {
        /// The value in the file.
        found: String,
        /// The nearest name.
        nearest: Option<String>,
    },
    /// A key that no scene has.
    #[error("unknown key {key}{}", suggestion(nearest.as_deref(), siblings))]
    UnknownKey {
        /// The dotted key.
        key: String,
        /// The nearest known key.
        nearest: Option<String>,
        /// The keys of the same table, or else the tables of the scene, for when nothing is near.
        siblings: Vec<&'static str>,
    },
    /// A table that no scene has.
    #[error("unknown table [{table}]{}", suggestion(nearest.as_deref(), siblings))]
    UnknownTable {
        /// The table.
        table: String,
        /// The nearest known table, in brackets.
        nearest: Option<String>,
        /// The tables of this scene.
        siblings: Vec<&'static str>,
    },
    /// A plain value where a table belongs.
    #[error("{table} = {found} is not a table: write [{table}] with its keys below")]
    NotATable {
        /// The table.
        table: &'static str,
        /// The value in the file.
        found: String,
    },
    /// A key or table of the other kind of scene.
    #[error("{key} belongs to scene = \"{needs}\", and this is scene = \"{scene}\"")]
    OtherScene {
        /// The dotted key, or the table in brackets.
        key: String,
        /// The scene it belongs to.
        needs: &'static str,
        /// The scene this is.
        scene: &'static str,
    },
    /// A key of another model, such as that of the rotor.
    #[error("{key} belongs to {selector} = \"{needs}\", and this is {selector} = \"{chosen}\"")]
    OtherModel {
        /// The dotted key.
        key: &'static str,
        /// The key that chooses the model.
        selector: &'static str,
        /// The model it belongs to.
        needs: &'static str,
        /// The model this is.
        chosen: String,
    },
    /// A rotor model that is planned.
    #[error("rotor.model = \"ring\" is reserved and not available: allowed \"beam\" or \"table\"")]
    ReservedModel,
    /// A key that this kind of scene does not heed.
    #[error("{key} has no effect on a {scene}: it cannot be changed or varied here")]
    NoEffect {
        /// The dotted key.
        key: &'static str,
        /// The scene this is.
        scene: &'static str,
    },
    /// The wedge term is asked for and ruled out.
    #[error(
        "numerics.wedge = \"on\" solves the wedge term, and film.shear = false says that there is none: \
         change one of the two"
    )]
    WedgeWithoutShear,
    /// A key that makes the scene what it is.
    #[error("{key} cannot be changed: start from another preset")]
    Fixed {
        /// The key.
        key: &'static str,
    },
    /// A value of another type.
    #[error("{} = {found} is of the wrong type: expected {}", parameter.key, parameter.accepts())]
    WrongType {
        /// The key, and what it accepts.
        parameter: &'static Parameter,
        /// The value as written.
        found: String,
    },
    /// Infinity or not a number.
    #[error("{} = {value} is not finite: expected {}", parameter.key, parameter.accepts())]
    NotFinite {
        /// The key, and what it accepts.
        parameter: &'static Parameter,
        /// The value.
        value: f64,
    },
    /// A number outside its range.
    #[error("{} = {value} is out of range: allowed {range}{}", parameter.key, with_unit(parameter))]
    OutOfRange {
        /// The key.
        parameter: &'static Parameter,
        /// The value.
        value: Value,
        /// What is allowed.
        range: Range,
    },
    /// A name that is not one of the choices.
    #[error("{} = \"{value}\" is not available: expected {}{}", parameter.key, parameter.accepts(), did_you_mean(nearest.as_deref()))]
    NotAChoice {
        /// The key, and the choices.
        parameter: &'static Parameter,
        /// The value.
        value: String,
        /// The nearest choice.
        nearest: Option<String>,
    },
    /// A tooth too wide or too narrow for its pitch.
    #[error(
        "stator.tooth_width_mm = {} is out of range: allowed {range} mm, 1 % to 100 % of the tooth pitch \
         2π × {} mm / {waves} waves / {teeth} teeth",
        show_number(*width_mm), show_number(*radius_mm)
    )]
    ToothAndPitch {
        /// Tooth width \[mm\].
        width_mm: f64,
        /// What the pitch allows \[mm\].
        range: Range,
        /// Contact radius \[mm\].
        radius_mm: f64,
        /// Wavelengths round the ring.
        waves: u32,
        /// Teeth in one wavelength.
        teeth: u32,
    },
    /// A plate that would touch the wall.
    #[error(
        "plate.amplitude_um = {} is out of range: allowed 0 to below plate.mean_gap_um = {} µm, or the plate touches",
        show_number(*amplitude_um), show_number(*mean_gap_um)
    )]
    AmplitudeAndGap {
        /// Amplitude \[µm\].
        amplitude_um: f64,
        /// Mean gap \[µm\].
        mean_gap_um: f64,
    },
    /// The rotor is a table, and no table is given.
    #[error("rotor.model = \"table\" needs rotor.compliance_csv or rotor.compliance")]
    ComplianceMissing,
    /// The rotor is a table, and two are given.
    #[error("rotor.compliance and rotor.compliance_csv are both given: keep one")]
    ComplianceTwice,
    /// More rows than any compliance needs.
    #[error("{key} has {rows} rows: allowed 1 to {limit}")]
    TooManyRows {
        /// The dotted key.
        key: &'static str,
        /// Rows given.
        rows: usize,
        /// Most rows.
        limit: usize,
    },
    /// A row of the compliance table is wrong.
    #[error("{key}, row {row}: {fault}")]
    Row {
        /// The dotted key.
        key: &'static str,
        /// Row, from 1, header not counted.
        row: usize,
        /// What is wrong with it.
        fault: RowFault,
    },
    /// The CSV file of the compliance cannot be read.
    #[error("rotor.compliance_csv = \"{given}\": {} {fault}", path.display())]
    Csv {
        /// The value of the key.
        given: String,
        /// The file looked for.
        path: PathBuf,
        /// What is wrong with the file.
        fault: ReadError,
    },
    /// The CSV file has another header. What is in it is not shown: it may be any file of this machine.
    #[error(
        "rotor.compliance_csv: this is no compliance table: expected the header harmonic,compliance_m2_per_n or \
         wavenumber_per_m,compliance_m2_per_n"
    )]
    CsvHeader,
    /// Neither a built-in preset nor a file.
    #[error(
        "unknown preset {name}: it is neither a built-in preset nor a file{}; squeezefilm presets lists the built-in ones",
        did_you_mean(nearest.as_deref())
    )]
    UnknownPreset {
        /// The name asked for.
        name: String,
        /// The nearest built-in name.
        nearest: Option<String>,
    },
}

impl What {
    /// The dotted key the fault is about, if it is about one.
    pub fn key(&self) -> Option<&str> {
        Some(match self {
            Self::UnknownKey { key, .. } | Self::OtherScene { key, .. } | Self::UnknownTable { table: key, .. } => key,
            Self::OtherModel { key, .. } | Self::Fixed { key } | Self::NoEffect { key, .. } => key,
            Self::TooManyRows { key, .. } | Self::Row { key, .. } | Self::NotATable { table: key, .. } => key,
            Self::WrongType { parameter, .. } | Self::NotFinite { parameter, .. } => parameter.key,
            Self::OutOfRange { parameter, .. } | Self::NotAChoice { parameter, .. } => parameter.key,
            Self::SchemaMissing | Self::SchemaUnsupported { .. } => "schema",
            Self::UnknownScene { .. } => "scene",
            Self::WedgeWithoutShear => "numerics.wedge",
            Self::ReservedModel | Self::ComplianceMissing => "rotor.model",
            Self::ToothAndPitch { .. } => "stator.tooth_width_mm",
            Self::AmplitudeAndGap { .. } => "plate.amplitude_um",
            Self::ComplianceTwice | Self::Csv { .. } | Self::CsvHeader => "rotor.compliance_csv",
            Self::Read(_) | Self::Unwritable { .. } | Self::Syntax { .. } | Self::UnknownPreset { .. } => return None,
        })
    }
}

fn with_unit(parameter: &Parameter) -> String {
    let mut tail = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
    if let Some(meaning) = parameter.absent {
        tail.push_str(&format!(", or none ({meaning})"));
    }
    tail
}

fn did_you_mean(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!(": did you mean {name}?"))
}

fn suggestion(nearest: Option<&str>, siblings: &[&str]) -> String {
    match nearest {
        Some(name) => format!(": did you mean {name}?"),
        None => format!(": known are {}", siblings.join(", ")),
    }
}

/// What is wrong with a row.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RowFault {
    /// Not two numbers.
    #[error("{found} is not a pair of numbers, wavenumber_per_m and compliance_m2_per_n")]
    NotAPair {
        /// What is there instead.
        found: String,
    },
    /// Not a number.
    #[error("{column} = {found} is not a number")]
    NotANumber {
        /// The column.
        column: &'static str,
        /// What is there instead.
        found: String,
    },
    /// Outside the range.
    #[error("{column} = {} is out of range: allowed {range} {unit}", show_number(*value))]
    OutOfRange {
        /// The column.
        column: &'static str,
        /// The value.
        value: f64,
        /// What is allowed.
        range: Range,
        /// The unit.
        unit: &'static str,
    },
    /// Harmonics are counted: 1, 2, 3 …
    #[error("harmonic = {} is not a whole number from 1 up", show_number(*value))]
    NotAHarmonic {
        /// The value.
        value: f64,
    },
    /// Wavenumbers must ascend.
    #[error(
        "wavenumber_per_m = {} is not above {}, the one before: sort the rows",
        show_number(*value), show_number(*before)
    )]
    NotAscending {
        /// The wavenumber \[1/m\].
        value: f64,
        /// The one in the row before \[1/m\].
        before: f64,
    },
}
