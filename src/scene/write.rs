//! Writes a scene as TOML text, and to disk. All keys are written, absent optional ones as comments. Numbers have the fewest digits that
//! read back to the same bits.

use super::comments::carried;
use super::error::{Fault, FaultKind, SCHEMA, SceneError};
use super::parameter::{Parameter, ParameterKind};
use super::value::{Value, is_unseen};
use super::values::Scene;
use crate::atomic::write_file;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt::Write as _;
use std::path::Path;

impl Scene {
    /// The scene as a TOML file, with the meaning of each key beside it.
    pub fn to_toml(&self) -> String {
        let mut text = format!("schema = {SCHEMA}\n");
        let mut table = "";
        for parameter in self.parameters() {
            if parameter.table() != table {
                if table.is_empty() {
                    let _ = writeln!(text, "scene = \"{}\"", self.scene());
                }
                table = parameter.table();
                let _ = writeln!(text, "\n[{table}]");
            }
            match (self.get(parameter.key), parameter.absent) {
                (Some(value), _) => write_key(&mut text, parameter, &value),
                (None, Some(meaning)) => {
                    let _ = writeln!(text, "# {:<38} # {}; absent: {meaning}", parameter.leaf(), parameter.about);
                }
                // The path of a CSV file: the keys that follow from it are written instead.
                (None, None) => {}
            }
        }
        text
    }

    /// The value of a key as [`Scene::set`] takes it; `None` if it is absent.
    pub fn given_text(&self, parameter: &Parameter) -> Option<String> {
        Some(match self.get(parameter.key)? {
            Value::Text(words) => words,
            value => match items(parameter, &value) {
                Some(items) => format!("[{}]", items.join(", ")),
                None => value.to_string(),
            },
        })
    }

    /// Writes the scene to `path`, by way of a temporary file in the same folder: no reader sees half a file, and if writing fails, an
    /// older file stays as it was.
    ///
    /// # Errors
    /// The faults of [`Scene::check`], as such a file would not load; [`FaultKind::Unwritable`] if the folder or the file
    /// cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), SceneError> {
        self.save_instead_of(path, None)
    }

    /// Likewise, with the comments of the file `before`, which the scene was read from.
    ///
    /// # Errors
    /// Those of [`Scene::save`]. A file `before` that cannot be read has no comments.
    pub fn save_instead_of(&self, path: &Path, before: Option<&Path>) -> Result<(), SceneError> {
        self.check()?;
        let mut text = self.to_toml();
        if let Some(old) = before.and_then(|before| Self::text_of(before).ok()) {
            text = carried(&text, &old);
        }
        write_file(path, |out| out.write_all(text.as_bytes()))
            .map_err(|error| Fault::of_file(path, FaultKind::Unwritable(error.source.to_string())).into())
    }
}

/// A scene is serialized as the text of its file.
impl Serialize for Scene {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.to_toml().serialize(to)
    }
}

impl<'de> Deserialize<'de> for Scene {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Self::from_toml(&String::deserialize(from)?, "the scene").map_err(D::Error::custom)
    }
}

/// A parameter is serialized as its key.
impl Serialize for Parameter {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.key.serialize(to)
    }
}

/// A parameter is deserialized from its key; one that does not exist is an error.
impl<'de> Deserialize<'de> for &'static Parameter {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let key = String::deserialize(from)?;
        Parameter::find(&key).ok_or_else(|| D::Error::custom(key))
    }
}

fn write_key(text: &mut String, parameter: &Parameter, value: &Value) {
    let leaf = parameter.leaf();
    if let Some(items) = items(parameter, value) {
        let _ = match parameter.kind {
            ParameterKind::Rows { columns: [first, second] } => {
                writeln!(text, "{leaf} = [  # [{}, {}]", first.key, second.key)
            }
            _ => writeln!(text, "{leaf} = [  # {}", parameter.about),
        };
        for item in items {
            let _ = writeln!(text, "  {item},");
        }
        text.push_str("]\n");
        return;
    }
    let assignment = format!("{leaf} = {}", literal(value));
    let _ = if parameter.table().is_empty() {
        writeln!(text, "{assignment}")
    } else {
        writeln!(text, "{assignment:<40} # {}", parameter.about)
    };
}

/// A single value in TOML.
fn literal(value: &Value) -> String {
    match value {
        // Debug keeps a point or an exponent, without which TOML would read an integer.
        Value::Number(number) => format!("{number:?}"),
        Value::Text(words) => quote(words),
        value => value.to_string(),
    }
}

/// The rows of a table, or an array of tables, each as an item of an array in TOML; `None` of any other value.
fn items(parameter: &Parameter, value: &Value) -> Option<Vec<String>> {
    match (value, parameter.kind) {
        (Value::Rows(rows), _) => Some(rows.iter().map(|(a, b)| format!("[{a:?}, {b:?}]")).collect()),
        (Value::Records(records), ParameterKind::Records { columns, .. }) => {
            Some(records.iter().map(|record| inline(columns, record)).collect())
        }
        _ => None,
    }
}

/// One of an array of tables, as an inline table.
fn inline(columns: &[Parameter], record: &[Value]) -> String {
    let pair = |(column, value): (&Parameter, &Value)| format!("{} = {}", column.key, literal(value));
    let pairs: Vec<_> = columns.iter().zip(record).map(pair).collect();
    format!("{{ {} }}", pairs.join(", "))
}

/// A TOML basic string.
fn quote(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            c if is_unseen(c) => {
                let _ = write!(quoted, "\\U{:08X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
