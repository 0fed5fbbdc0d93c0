//! Faults of a scene. A [`SceneError`] holds the first faults and counts the others; its `Display` is what
//! the user sees, one line per fault: `my.toml:12: film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm`.

use super::parameter::{Parameter, Range};
use super::value::{Value, show_text};
use crate::input::ReadError;
use std::fmt;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// The version of the file format this program reads and writes.
pub const SCHEMA: i64 = 1;

/// Most faults reported at once.
const MOST_FAULTS: usize = 10;

/// Faults of a scene: at least one and at most ten, in the order of the file, and how many more there are.
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

    pub(super) fn push(&mut self, fault: impl Into<Fault>) {
        self.push_with(|| fault.into());
    }

    /// Adds a fault, which is composed only if it will be reported.
    pub(super) fn push_with(&mut self, fault: impl FnOnce() -> Fault) {
        if self.faults.len() < MOST_FAULTS { self.faults.push(fault()) } else { self.more += 1 }
    }

    /// Adds the faults of another error.
    pub(super) fn join(&mut self, other: Self) {
        self.more += other.more;
        other.faults.into_iter().for_each(|fault| self.push(fault));
    }

    /// With other faults in place of these.
    pub(super) fn map(mut self, other: impl Fn(FaultKind) -> FaultKind) -> Self {
        self.faults = self.faults.into_iter().map(|fault| Fault { what: other(fault.what), ..fault }).collect();
        self
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
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.faults.iter().map(Fault::to_string).collect::<Vec<_>>().join("\n"))?;
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
    /// Column in the line, in characters, from 1, where the text is not TOML.
    pub column: Option<usize>,
    /// The fault itself.
    pub what: FaultKind,
}

impl Fault {
    /// A fault of a whole file.
    pub(super) fn of_file(path: &Path, what: FaultKind) -> Self {
        Self { origin: Some(path.to_owned()), ..what.into() }
    }
}

impl From<FaultKind> for Fault {
    fn from(what: FaultKind) -> Self {
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
            if let Some(column) = self.column {
                write!(f, "{column}:")?;
            }
            f.write_str(" ")?;
        }
        write!(f, "{}", self.what)
    }
}

/// A fault of a scene. Values carry the unit of their key.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaultKind {
    /// The file is not read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file cannot be written; the reason that the operating system gives.
    #[error("cannot be written: {0}")]
    Unwritable(String),
    /// The text is not TOML; what its reader says.
    #[error("not valid TOML: {0}")]
    Syntax(String),
    /// A key or table that no scene has.
    #[error("unknown {kind} {key}{}", suggestion(nearest.as_deref(), siblings))]
    Unknown {
        /// "key" or "table".
        kind: &'static str,
        /// The dotted key, or the table in brackets.
        key: String,
        /// The nearest known one.
        nearest: Option<String>,
        /// The keys of the same table, or else the tables of the scene, for when nothing is near.
        siblings: Vec<&'static str>,
    },
    /// A key or table of the other kind of scene, or a key of another model.
    #[error("{key} belongs to {selector} = {}, and this is {selector} = \"{chosen}\"", listed(needs))]
    Elsewhere {
        /// The dotted key, or the table in brackets.
        key: String,
        /// The key that selects: `scene`, or the key of the model.
        selector: &'static str,
        /// The scenes or models it belongs to.
        needs: &'static [&'static str],
        /// The one this is.
        chosen: String,
    },
    /// A key that another one, which is given, replaces.
    #[error("{other} and {key} are both given: keep one")]
    BothGiven {
        /// The dotted key.
        key: &'static str,
        /// The key that replaces it.
        other: &'static str,
    },
    /// A value that the key does not take, whatever its size.
    #[error("{} = {found} is {why}: expected {}{}", parameter.key, parameter.accepts(), did_you_mean(nearest.as_deref()))]
    Refused {
        /// The key, and what it accepts.
        parameter: &'static Parameter,
        /// The value as written.
        found: String,
        /// "of the wrong type", "not finite" or "not available".
        why: &'static str,
        /// The nearest of the choices.
        nearest: Option<String>,
    },
    /// A number outside its range.
    #[error("{} = {value} is out of range: allowed {}{}", parameter.key, parameter.with_unit(range), parameter.or_none())]
    OutOfRange {
        /// The key.
        parameter: &'static Parameter,
        /// The value.
        value: Value,
        /// The allowed range.
        range: Range,
    },
    /// A broken rule between keys, or another fault that consists of a message only.
    #[error("{message}")]
    Rule {
        /// The dotted key to change first.
        key: &'static str,
        /// The whole message: the key, its value, and what is allowed.
        message: String,
    },
    /// One row of a table, or one of an array of tables such as a part of the rotor, is wrong.
    #[error("{key}, {which}: {fault}")]
    Within {
        /// The dotted key of the table or array.
        key: &'static str,
        /// Which row or table it is: its name, or its number from 1; the header of a CSV file does not count.
        which: String,
        /// The fault of that row or table. Its columns or keys are named without those of the table around them.
        fault: Box<FaultKind>,
    },
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

impl FaultKind {
    /// A value of the wrong type, as written.
    pub(super) fn wrong_type(parameter: &'static Parameter, found: String) -> Self {
        Self::Refused { parameter, found, why: "of the wrong type", nearest: None }
    }

    /// A CSV file at `path` that cannot be used. `key` names it, with the value `given`, and `fault` follows in the message, after the path
    /// if that is another.
    pub(super) fn csv(key: &'static str, given: &str, path: &Path, fault: String) -> Self {
        let (given, path) = (show_text(given), path.display().to_string());
        let path = if path == given { String::new() } else { format!(": {path}") };
        Self::Rule { key, message: format!("{key} = \"{given}\"{path}{fault}") }
    }

    /// The dotted key the fault is about, if it is about one.
    pub fn key(&self) -> Option<&str> {
        Some(match self {
            Self::Unknown { key, .. } | Self::Elsewhere { key, .. } => key,
            Self::BothGiven { key, .. } | Self::Rule { key, .. } | Self::Within { key, .. } => key,
            Self::Refused { parameter, .. } | Self::OutOfRange { parameter, .. } => parameter.key,
            Self::Read(_) | Self::Unwritable(_) | Self::Syntax(_) | Self::UnknownPreset { .. } => return None,
        })
    }
}

/// Checks how many rows a table has, or how many tables an array has; `what` says which, in the plural.
pub(super) fn check_count(
    key: &'static str,
    what: &str,
    count: usize,
    allowed: RangeInclusive<usize>,
) -> Result<(), FaultKind> {
    let message = || format!("{key} has {count} {what}: allowed {} to {}", allowed.start(), allowed.end());
    if allowed.contains(&count) { Ok(()) } else { Err(FaultKind::Rule { key, message: message() }) }
}

/// `"a", "b" or "c"`.
fn listed(names: &[&str]) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("\"{name}\"")).collect();
    match &quoted[..] {
        [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => quoted.join(", "),
    }
}

/// The end of a message that offers the nearest name, if there is one.
pub(super) fn did_you_mean(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!(": did you mean {name}?"))
}

fn suggestion(nearest: Option<&str>, siblings: &[&str]) -> String {
    match nearest {
        Some(_) => did_you_mean(nearest),
        None => format!(": known are {}", siblings.join(", ")),
    }
}
