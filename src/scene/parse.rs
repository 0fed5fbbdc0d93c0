//! Reads a scene from TOML text. It walks the tree with its positions rather than using serde's types, so that every fault has its line,
//! and all faults are found in one reading.

use super::accept::{check_records, named};
use super::compliance::{self, check_row_count, in_order, not_a_pair};
use super::error::{Fault, FaultKind, SCHEMA, SceneError, did_you_mean};
use super::keys::tables;
use super::nearest::nearest;
use super::parameter::{Parameter, ParameterKind};
use super::value::{Value, show_text};
use super::values::{Kind, Scene};
use crate::input;
use std::collections::HashMap;
use std::ops::Range as Bytes;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// Largest file read \[MB\]. The largest compliance table takes a third of it.
const LARGEST_FILE: u64 = 16;

impl Scene {
    /// Reads a preset file.
    ///
    /// # Errors
    /// The file cannot be read, is not TOML, or breaks a rule; the first ten faults at once, with their lines.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::from_toml(&Self::text_of(path)?, path)
    }

    /// The text of a preset file.
    pub(super) fn text_of(path: &Path) -> Result<String, SceneError> {
        Ok(input::read_text(path, LARGEST_FILE).map_err(|error| Fault::of_file(path, error.into()))?)
    }

    /// Reads a preset from text. `origin` is the path that messages name; CSV files are looked for in its folder.
    pub fn from_toml(text: &str, origin: impl AsRef<Path>) -> Result<Self, SceneError> {
        let origin = origin.as_ref();
        let mut reader = PresetReader { text, origin, faults: SceneError::none(), spans: HashMap::new() };
        let scene = reader.read();
        // Without a scene there is a fault.
        reader.faults.or(scene.unwrap_or_else(Scene::motor))
    }
}

/// Reads the rows of the key `of` from the CSV file at `path`. `parameter` names the file, with the value `given`, which messages quote.
/// `wavelength` in \[m\].
pub(super) fn read_table(
    parameter: &'static Parameter,
    of: &'static Parameter,
    given: &str,
    path: &Path,
    wavelength: f64,
) -> Result<Value, SceneError> {
    let key = parameter.key;
    let ParameterKind::Rows { columns } = of.kind else {
        return Err(FaultKind::wrong_type(parameter, show_text(given)).into());
    };
    let text =
        input::read_text(path, LARGEST_FILE).map_err(|fault| FaultKind::csv(key, given, path, format!(" {fault}")))?;
    compliance::read_csv(key, columns, &text, path, wavelength).map(Value::Rows)
}

/// The rows of a table, or an array of tables, from the text of `--set`, written as in TOML.
pub(super) fn array_from_text(parameter: &'static Parameter, text: &str) -> Result<Value, SceneError> {
    let tree = DeValue::parse(text).map_err(|_| FaultKind::wrong_type(parameter, show_text(text)))?;
    let mut faults = SceneError::none();
    let value = array_from_toml(parameter, &tree, text, &mut |_, what| faults.push(what));
    faults.or(value)
}

struct PresetReader<'t> {
    text: &'t str,
    origin: &'t Path,
    faults: SceneError,
    /// Where the value of each key of the file is.
    spans: HashMap<&'static str, Bytes<usize>>,
}

/// A key of the file: where its name is, the dotted key, its value.
type Entry<'a, 't> = (Bytes<usize>, String, &'a Spanned<DeValue<'t>>);

impl PresetReader<'_> {
    fn read(&mut self) -> Option<Scene> {
        let tree = match DeTable::parse(self.text) {
            Ok(tree) => tree,
            Err(error) => {
                let (line, column) = error.span().map(|span| line_and_column(self.text, span.start)).unzip();
                let what = FaultKind::Syntax(syntax_message(error.message()));
                self.faults.push(Fault { line, column, ..Fault::of_file(self.origin, what) });
                return None;
            }
        };
        let root = tree.get_ref();
        if !self.schema(root) {
            return None;
        }
        let mut scene = self.empty_scene(root)?;
        let mut entries = self.entries(root, &scene);
        // A CSV file comes after the rows, so that it is reported if both are given.
        entries.sort_by_cached_key(|(at, key, _)| {
            let parameter = Parameter::find(key);
            let file = parameter.is_some_and(|parameter| matches!(parameter.kind, ParameterKind::CsvPath { .. }));
            (parameter.map_or(0, Parameter::rank), file, at.start)
        });
        for (at, key, value) in entries {
            self.key(&mut scene, at, &key, value);
        }
        self.rules(&scene);
        Some(scene)
    }

    /// Whether the file is of a schema this program reads.
    fn schema(&mut self, root: &DeTable<'_>) -> bool {
        let value = root.get("schema");
        let good = value.is_some_and(|value| integer(value.get_ref()) == Some(SCHEMA));
        if !good {
            self.fault(value.map(Spanned::span), |found| {
                let message = match value {
                    None => format!("the key schema is missing: write schema = {SCHEMA} at the top of the file"),
                    Some(_) => format!("schema = {found} is not supported: this program reads schema = {SCHEMA}"),
                };
                FaultKind::Rule { key: "schema", message }
            });
        }
        good
    }

    /// The default scene of the kind the file asks for.
    fn empty_scene(&mut self, root: &DeTable<'_>) -> Option<Scene> {
        let Some(value) = root.get("scene") else {
            let Some((plate, _)) = root.get_key_value("plate") else { return Some(Scene::motor()) };
            let missing = "the key scene is missing: write scene = \"plate\" at the top of the file";
            let message = format!(
                "{missing}; allowed \"motor\" or \"plate\", and without it the scene is a motor, which has no [plate]"
            );
            self.fault(Some(plate.span()), |_| FaultKind::Rule { key: "scene", message });
            return None;
        };
        let name = value.get_ref().as_str().unwrap_or_default();
        let kind = Kind::ALL.into_iter().find(|kind| kind.name() == name);
        if kind.is_none() {
            self.fault(Some(value.span()), |found| {
                let nearest = did_you_mean(nearest(name, Kind::ALL.map(Kind::name)));
                let message = format!("scene = {found} is not a scene: allowed \"motor\" or \"plate\"{nearest}");
                FaultKind::Rule { key: "scene", message }
            });
        }
        kind.map(Scene::new)
    }

    /// The keys of all tables that the scene has.
    fn entries<'a, 't>(&mut self, root: &'a DeTable<'t>, scene: &Scene) -> Vec<Entry<'a, 't>> {
        let (mut entries, tables) = (Vec::new(), tables());
        let mut root: Vec<_> = root.iter().collect();
        root.sort_by_key(|(key, _)| key.span().start);
        for (key, value) in root {
            let (name, at) = (key.get_ref().as_ref(), key.span());
            match (tables.iter().copied().find(|table| *table == name), value.get_ref()) {
                _ if matches!(name, "schema" | "scene") => {}
                (Some(table), DeValue::Table(inside)) => match scene.has_table(table, format!("[{table}]")) {
                    Err(foreign) => self.fault(Some(at), |_| foreign),
                    Ok(()) => {
                        let dotted = |key: &str| format!("{table}.{key}");
                        entries.extend(inside.iter().map(|(key, value)| (key.span(), dotted(key.get_ref()), value)));
                    }
                },
                (Some(table), _) => self.fault(Some(value.span()), |found| {
                    let message = format!("{table} = {found} is not a table: write [{table}] with its keys below");
                    FaultKind::Rule { key: table, message }
                }),
                (None, DeValue::Table(_)) => self.fault(Some(at), |_| {
                    let siblings = scene.tables();
                    let nearest = nearest(name, siblings.iter().copied()).map(|table| format!("[{table}]"));
                    FaultKind::Unknown { kind: "table", key: format!("[{}]", show_text(name)), nearest, siblings }
                }),
                (None, _) => entries.push((at, name.to_owned(), value)),
            }
        }
        entries
    }

    fn key(&mut self, scene: &mut Scene, at: Bytes<usize>, key: &str, value: &Spanned<DeValue<'_>>) {
        let Some(parameter) = Parameter::find(key) else {
            return self.fault(Some(at), |_| scene.unknown_key(key));
        };
        let span = value.span();
        if let Some(other) = parameter.alternatives().find(|other| self.spans.contains_key(other.key)) {
            return self.fault(Some(at), |_| FaultKind::BothGiven { key: parameter.key, other: other.key });
        }
        self.spans.insert(parameter.key, span.clone());
        match scene.applies(parameter) {
            // If the model itself is at fault, it is not known which keys there are.
            Err(FaultKind::Elsewhere { selector, .. }) if self.at_fault(&[selector]) => return,
            Err(what) => return self.fault(Some(at), |_| what),
            Ok(()) => {}
        }
        let read = match parameter.kind {
            ParameterKind::Rows { .. } | ParameterKind::Records { .. } => {
                let (mut in_order, text) = (true, self.text);
                let read = array_from_toml(parameter, value, text, &mut |span, what| {
                    in_order = false;
                    self.fault(Some(span), |_| what);
                });
                if !in_order {
                    return;
                }
                Ok(read)
            }
            ParameterKind::CsvPath { table } => return self.csv(scene, parameter, table, value),
            _ => value_from_toml(value.get_ref()).ok_or_else(|| FaultKind::wrong_type(parameter, String::new())),
        };
        if let Err(what) = read.and_then(|value| scene.assign(parameter, value)) {
            self.fault(Some(span), |found| match what {
                // The message shows the value as it is written in the file.
                FaultKind::Refused { parameter, why: "of the wrong type", .. } => {
                    FaultKind::wrong_type(parameter, found.to_owned())
                }
                what => what,
            });
        }
    }

    /// Sets the key `table`, or those that follow from measured heights, from the CSV file that a key names.
    fn csv(&mut self, scene: &mut Scene, file: &'static Parameter, table: Option<&str>, value: &Spanned<DeValue<'_>>) {
        let span = Some(value.span());
        let Some(given) = value.get_ref().as_str() else {
            return self.fault(span, |found| FaultKind::wrong_type(file, found.to_owned()));
        };
        if let Some(table) = table {
            if let Some(other) = Parameter::find(table).filter(|other| self.spans.contains_key(other.key)) {
                return self.fault(span, |_| FaultKind::BothGiven { key: file.key, other: other.key });
            }
            if self.at_fault(&["motor.contact_radius_mm", "motor.waves"]) {
                return;
            }
        }
        let path = self.origin.parent().unwrap_or(Path::new("")).join(given);
        if let Err(error) = scene.take_csv(file, table, given, &path) {
            match error.faults() {
                // The fault is about the whole file, and not about a line of it.
                [Fault { origin: None, what, .. }, ..] => self.fault(span, |_| what.clone()),
                _ => self.faults.join(error),
            }
        }
    }

    /// Checks the rules between keys whose own values are in order.
    fn rules(&mut self, scene: &Scene) {
        for (keys, what) in scene.broken_rules() {
            // A CSV file that was not read, because its wavelength is at fault, would break a rule too.
            let unread = ["rotor.compliance_csv", "rotor.green_csv"]
                .iter()
                .any(|key| keys.contains(key) && self.spans.contains_key(key));
            if !self.at_fault(keys) && !unread {
                // The line of the first key of the rule that the file gives.
                let span = keys.iter().find_map(|key| self.spans.get(key)).cloned();
                self.fault(span, |_| what);
            }
        }
    }

    fn at_fault(&self, keys: &[&str]) -> bool {
        self.faults.faults().iter().any(|fault| fault.what.key().is_some_and(|key| keys.contains(&key)))
    }

    /// Adds a fault, which `what` makes from the text at its place. The message is composed only if it will be shown, because a hostile
    /// file may have a fault on every line.
    fn fault(&mut self, span: Option<Bytes<usize>>, what: impl FnOnce(&str) -> FaultKind) {
        self.faults.push_with(|| {
            let line = span.as_ref().map(|span| line_and_column(self.text, span.start).0);
            let written = show_text(span.and_then(|span| self.text.get(span)).unwrap_or_default());
            Fault { line, ..Fault::of_file(self.origin, what(&written)) }
        });
    }
}

/// A value from TOML; `None` if it is of a type that no parameter has.
fn value_from_toml(value: &DeValue<'_>) -> Option<Value> {
    match value {
        DeValue::Float(_) => number(value).map(Value::Number),
        // A whole number of more than 64 bits is read as floating point.
        DeValue::Integer(_) => integer(value).map(Value::Whole).or_else(|| number(value).map(Value::Number)),
        DeValue::Boolean(flag) => Some(Value::Flag(*flag)),
        DeValue::String(text) => Some(Value::Text(text.clone().into_owned())),
        _ => None,
    }
}

/// Takes a fault, and the bytes of the text that are at fault.
type OnFault<'a> = &'a mut dyn FnMut(Bytes<usize>, FaultKind);

/// The valid rows of a table, or the valid tables of an array. `fault` is called for the others.
fn array_from_toml(
    parameter: &'static Parameter,
    value: &Spanned<DeValue<'_>>,
    text: &str,
    fault: OnFault<'_>,
) -> Value {
    let counted = |array: &DeArray<'_>| match parameter.kind {
        ParameterKind::Records { fewest, .. } => check_records(parameter.key, array.len(), fewest),
        _ => check_row_count(parameter.key, array.len()),
    };
    let wrong_type = || FaultKind::wrong_type(parameter, show_text(text.get(value.span()).unwrap_or_default()));
    let array = value.get_ref().as_array().ok_or_else(wrong_type);
    let array = array.and_then(|array| counted(array).map(|()| &array[..])).unwrap_or_else(|what| {
        fault(value.span(), what);
        &[]
    });
    match parameter.kind {
        ParameterKind::Records { columns, .. } => {
            Value::Records(records_from_toml(parameter, columns, array, text, fault))
        }
        ParameterKind::Rows { columns } => Value::Rows(rows_from_toml(parameter.key, columns, array, text, fault)),
        _ => Value::Rows(Vec::new()),
    }
}

/// Rows `[[wavenumber_per_m, compliance_m2_per_n], …]`.
fn rows_from_toml(
    key: &'static str,
    columns: &'static [Parameter; 2],
    array: &[Spanned<DeValue<'_>>],
    text: &str,
    fault: OnFault<'_>,
) -> Vec<(f64, f64)> {
    let pair = |row: &Spanned<DeValue<'_>>| {
        let numbers = row.get_ref().as_array().map(|pair| pair.iter().map(|value| number(value.get_ref())));
        match numbers.map(Vec::from_iter).as_deref() {
            Some([Some(first), Some(second)]) => Ok((*first, *second)),
            _ => Err(not_a_pair(text.get(row.span()).unwrap_or_default(), columns)),
        }
    };
    in_order(key, columns, array.iter().map(|row| (row.span(), pair(row))), fault)
}

/// An array of tables, each with a key for every column.
fn records_from_toml(
    parameter: &'static Parameter,
    columns: &'static [Parameter],
    array: &[Spanned<DeValue<'_>>],
    text: &str,
    fault: OnFault<'_>,
) -> Vec<Vec<Value>> {
    let written = |span: Bytes<usize>| show_text(text.get(span).unwrap_or_default());
    let key = parameter.key;
    let mut records = Vec::new();
    for (table, number) in array.iter().zip(1..) {
        let Some(given) = table.get_ref().as_table() else {
            fault(table.span(), FaultKind::wrong_type(parameter, written(table.span())));
            continue;
        };
        let name = columns.first().and_then(|column| given.get(column.key)).and_then(|value| value.get_ref().as_str());
        let which = named(name, number);
        let mut wrong = |span, what: FaultKind| {
            fault(span, FaultKind::Within { key, which: which.clone(), fault: what.into() });
        };
        let keys: Vec<&'static str> = columns.iter().map(|column| column.key).collect();
        for (unknown, _) in given.iter().filter(|(given, _)| !keys.contains(&given.get_ref().as_ref())) {
            let near = nearest(unknown.get_ref(), keys.iter().copied()).map(str::to_owned);
            let key = show_text(unknown.get_ref());
            wrong(unknown.span(), FaultKind::Unknown { kind: "key", key, nearest: near, siblings: keys.clone() });
        }
        let mut record = Vec::new();
        for column in columns {
            let Some(cell) = given.get(column.key) else {
                let message = format!("{} is missing: expected {}", column.key, column.accepts());
                wrong(table.span(), FaultKind::Rule { key: column.key, message });
                continue;
            };
            let read = value_from_toml(cell.get_ref())
                .ok_or_else(|| FaultKind::wrong_type(column, written(cell.span())))
                .and_then(|value| column.accept(value));
            match read {
                Ok(value) => record.push(value),
                Err(what) => wrong(cell.span(), what),
            }
        }
        if record.len() == columns.len() {
            records.push(record);
        }
    }
    records
}

/// A TOML integer or float as a number.
fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        // A decimal integer of any length rounds like a float; another radix fits 64 bits or is refused.
        DeValue::Integer(whole) if whole.radix() == 10 => whole.as_str().parse().ok(),
        DeValue::Integer(_) => integer(value).map(|whole| whole as f64),
        _ => None,
    }
}

/// A TOML integer, if it fits 64 bits.
fn integer(value: &DeValue<'_>) -> Option<i64> {
    value.as_integer().and_then(|whole| i64::from_str_radix(whole.as_str(), whole.radix()).ok())
}

/// A message of the TOML reader on one line.
fn syntax_message(message: &str) -> String {
    // The reader's message for a word without quotes that starts like true or false, such as first-order.
    if message.starts_with("invalid boolean") {
        return "text must be in quotes; the only bare words are true and false".to_owned();
    }
    message.lines().map(str::trim).collect::<Vec<_>>().join("; ")
}

/// Line and column, both from 1, of a byte of the text.
fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = &text.as_bytes()[..byte.min(text.len())];
    let line = before.iter().filter(|b| **b == b'\n').count() + 1;
    let start = before.iter().rposition(|b| *b == b'\n').map_or(0, |newline| newline + 1);
    (line, String::from_utf8_lossy(&before[start..]).chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_start_at_one() {
        let text = "ab\r\nµc\n";
        assert_eq!(line_and_column(text, 0), (1, 1));
        assert_eq!(line_and_column(text, 4), (2, 1));
        assert_eq!(line_and_column(text, 6), (2, 2));
        assert_eq!(line_and_column(text, 99), (3, 1));
    }

    #[test]
    fn numbers_of_every_notation_are_read() {
        for (text, expected) in [
            ("7", Some(7.0)),
            ("1_000", Some(1000.0)),
            ("0x10", Some(16.0)),
            ("1e-10", Some(1e-10)),
            ("-0.0", Some(-0.0)),
            ("99999999999999999999999", Some(1e23)),
            ("\"7\"", None),
            ("true", None),
        ] {
            let value = DeValue::parse(text).unwrap();
            assert_eq!(number(value.get_ref()).map(f64::to_bits), expected.map(f64::to_bits), "{text}");
        }
    }
}
