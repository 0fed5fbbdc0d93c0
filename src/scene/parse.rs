//! TOML text to a scene. Reads the spanned tree rather than serde's types, so that every fault has its line and all of
//! them are found in one reading.

use super::compliance::{self, MOST_ROWS, RowFault, check_row};
use super::error::{Fault, SceneError, What};
use super::nearest::nearest;
use super::parameter::{PARAMETERS, Parameter, ParameterKind, SCENES, TABLES};
use super::value::{Value, show_text};
use super::{RotorModel, SCHEMA, Scene};
use std::collections::HashMap;
use std::io::Read;
use std::ops::Range as Bytes;
use std::path::{Path, PathBuf};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Largest file read \[bytes\]. The largest compliance table takes a third of it.
const LARGEST_FILE: u64 = 16 << 20;

impl Scene {
    /// Reads a preset file.
    ///
    /// # Errors
    ///
    /// The file cannot be read, is not TOML, or breaks a rule; all faults at once, with their lines.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        let text = read_text(path).map_err(|what| SceneError::from(what).at(path))?;
        Self::from_toml(&text, path)
    }

    /// Reads a preset from text. `origin` is the name faults are reported under; `rotor.compliance_csv` is looked for
    /// in the folder it is in.
    ///
    /// # Errors
    ///
    /// As [`Scene::load`].
    pub fn from_toml(text: &str, origin: impl AsRef<Path>) -> Result<Self, SceneError> {
        let mut reader = Reader { text, origin: origin.as_ref(), faults: Vec::new(), spans: HashMap::new() };
        let scene = reader.read();
        SceneError::unless_empty(reader.faults)?;
        // A scene is missing only together with a fault.
        scene.ok_or_else(|| What::SchemaMissing { supported: SCHEMA }.into())
    }
}

/// The text of a file.
pub(super) fn read_text(path: &Path) -> Result<String, What> {
    let unreadable = |error: std::io::Error| What::Unreadable { reason: error.to_string() };
    let file = std::fs::File::open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(What::TooLarge { limit: LARGEST_FILE });
    }
    String::from_utf8(bytes).map_err(|_| What::NotText)
}

/// Reads the CSV file at `path`; `given` is the value of the key, for the message. `wavelength` in \[m\].
pub(super) fn read_compliance(given: &str, path: &Path, wavelength: f64) -> Result<Vec<(f64, f64)>, Vec<Fault>> {
    let text = read_text(path).map_err(|fault| {
        let (given, path) = (show_text(given), path.to_owned());
        vec![Fault::from(What::Csv { given, path, fault: Box::new(fault) })]
    })?;
    compliance::read_csv(&text, path, wavelength)
}

/// The value of a parameter from the text of `--set`.
pub(super) fn value_from_text(parameter: &'static Parameter, text: &str) -> Result<Value, What> {
    let wrong_type = || What::WrongType { parameter, found: show_text(text) };
    match parameter.kind {
        ParameterKind::Number { .. } => text.parse().map(Value::Number).map_err(|_| wrong_type()),
        ParameterKind::Whole { .. } => text.parse().map(Value::Whole).map_err(|_| wrong_type()),
        ParameterKind::Flag { .. } => text.parse().map(Value::Flag).map_err(|_| wrong_type()),
        ParameterKind::Choice { .. } | ParameterKind::Text { .. } => Ok(Value::Text(text.to_owned())),
        ParameterKind::CsvPath => Err(wrong_type()),
        ParameterKind::Rows => {
            let tree = DeValue::parse(text).map_err(|_| wrong_type())?;
            let faults = |mut faults: Vec<Placed>| {
                if faults.is_empty() { wrong_type() } else { faults.swap_remove(0).1 }
            };
            rows_from_toml(parameter, &tree, text).map(Value::Rows).map_err(faults)
        }
    }
}

/// What is wrong, and where in the text.
type Placed = (Bytes<usize>, What);

struct Reader<'t> {
    text: &'t str,
    origin: &'t Path,
    faults: Vec<Fault>,
    /// Where the value of each key of the file is.
    spans: HashMap<&'static str, Bytes<usize>>,
}

impl Reader<'_> {
    fn read(&mut self) -> Option<Scene> {
        let tree = match DeTable::parse(self.text) {
            Ok(tree) => tree,
            Err(error) => {
                let message = syntax_message(error.message());
                self.fault(error.span(), What::Syntax { message });
                return None;
            }
        };
        let root = tree.get_ref();
        if !self.schema(root) {
            return None;
        }
        let mut scene = self.empty_scene(root)?;
        let model_known = self.rotor_model(root, &mut scene);
        for (key, value) in root {
            let name = key.get_ref().as_ref();
            match (TABLES.iter().find(|table| **table == name), value.get_ref()) {
                _ if matches!(name, "schema" | "scene") => {}
                (Some(table), DeValue::Table(entries)) => {
                    if self.table_applies(&scene, table, key.span()) {
                        for (key, value) in entries {
                            self.key(&mut scene, &format!("{table}.{}", key.get_ref()), key.span(), value, model_known);
                        }
                    }
                }
                (Some(table), _) => {
                    let found = self.written(value.span());
                    self.fault(Some(value.span()), What::NotATable { table, found });
                }
                (None, DeValue::Table(_)) => {
                    let siblings = scene.tables();
                    let nearest = nearest(name, siblings.iter().copied()).map(|table| format!("[{table}]"));
                    self.fault(Some(key.span()), What::UnknownTable { table: show_text(name), nearest, siblings });
                }
                (None, _) => self.key(&mut scene, name, key.span(), value, model_known),
            }
        }
        self.csv(root, &mut scene);
        self.rules(&scene);
        Some(scene)
    }

    /// Whether the file is of a schema this program reads.
    fn schema(&mut self, root: &DeTable<'_>) -> bool {
        let Some(value) = root.get("schema") else {
            self.fault(None, What::SchemaMissing { supported: SCHEMA });
            return false;
        };
        if integer(value.get_ref()) == Some(SCHEMA) {
            return true;
        }
        let found = self.written(value.span());
        self.fault(Some(value.span()), What::SchemaUnsupported { found, supported: SCHEMA });
        false
    }

    /// The default scene of the kind the file asks for.
    fn empty_scene(&mut self, root: &DeTable<'_>) -> Option<Scene> {
        let Some(value) = root.get("scene") else { return Some(Scene::motor()) };
        match value.get_ref().as_str() {
            Some("motor") => Some(Scene::motor()),
            Some("plate") => Some(Scene::plate()),
            other => {
                let nearest = other.and_then(|name| nearest(name, SCENES.iter().copied())).map(str::to_owned);
                let found = self.written(value.span());
                self.fault(Some(value.span()), What::UnknownScene { found, nearest });
                None
            }
        }
    }

    /// Sets the rotor's model, on which the meaning of the other rotor keys depends. False if it is not a model.
    fn rotor_model(&mut self, root: &DeTable<'_>, scene: &mut Scene) -> bool {
        let model = root.get("rotor").and_then(|rotor| rotor.get_ref().get("model"));
        match (model.map(|model| model.get_ref().as_str()), Parameter::find("rotor.model")) {
            (Some(Some(name)), Some(parameter)) => scene.assign(parameter, Value::Text(name.to_owned())).is_ok(),
            (Some(None), _) => false,
            _ => true,
        }
    }

    fn table_applies(&mut self, scene: &Scene, table: &'static str, span: Bytes<usize>) -> bool {
        let foreign = PARAMETERS.iter().find(|p| p.table() == table).and_then(|p| match scene.applies(p) {
            Err(What::OtherScene { needs, scene, .. }) => Some((needs, scene)),
            _ => None,
        });
        if let Some((needs, scene)) = foreign {
            self.fault(Some(span), What::OtherScene { key: format!("[{table}]"), needs, scene });
        }
        foreign.is_none()
    }

    fn key(
        &mut self,
        scene: &mut Scene,
        key: &str,
        span: Bytes<usize>,
        value: &Spanned<DeValue<'_>>,
        model_known: bool,
    ) {
        let Some(parameter) = Parameter::find(key) else {
            let what = scene.unknown_key(key);
            return self.fault(Some(span), what);
        };
        self.spans.insert(parameter.key, value.span());
        if let Err(what) = scene.applies(parameter) {
            if model_known {
                self.fault(Some(span), what);
            }
            return;
        }
        match parameter.kind {
            ParameterKind::Rows => match rows_from_toml(parameter, value, self.text) {
                Ok(rows) => {
                    if let Err(what) = scene.assign(parameter, Value::Rows(rows)) {
                        self.fault(Some(value.span()), what);
                    }
                }
                Err(faults) => faults.into_iter().for_each(|(span, what)| self.fault(Some(span), what)),
            },
            // Read at the end, when the wavelength is known.
            ParameterKind::CsvPath => {}
            _ => {
                let read = value_from_toml(parameter, value.get_ref()).unwrap_or_else(|| {
                    let found = self.written(value.span());
                    Err(What::WrongType { parameter, found })
                });
                if let Err(what) = read.and_then(|value| scene.assign(parameter, value)) {
                    self.fault(Some(value.span()), what);
                }
            }
        }
    }

    /// Reads the compliance from the CSV file, if the rotor is a table and names one.
    fn csv(&mut self, root: &DeTable<'_>, scene: &mut Scene) {
        let Some(RotorModel::Table { .. }) = scene.rotor_model() else { return };
        let rotor = root.get("rotor").map(Spanned::get_ref);
        let (csv, inline) =
            (rotor.and_then(|rotor| rotor.get("compliance_csv")), rotor.and_then(|rotor| rotor.get("compliance")));
        let (Some(parameter), Some(rows)) =
            (Parameter::find("rotor.compliance_csv"), Parameter::find("rotor.compliance"))
        else {
            return;
        };
        match (csv, inline) {
            (Some(csv), Some(_)) => self.fault(Some(csv.span()), What::ComplianceTwice),
            (Some(csv), None) => {
                let Some(given) = csv.get_ref().as_str() else {
                    let found = self.written(csv.span());
                    return self.fault(Some(csv.span()), What::WrongType { parameter, found });
                };
                if self.at_fault(&["motor.contact_radius_mm", "motor.waves"]) {
                    return;
                }
                let path: PathBuf = self.origin.parent().unwrap_or(Path::new("")).join(given);
                match read_compliance(given, &path, scene.wavelength()) {
                    Ok(read) => {
                        if let Err(what) = scene.assign(rows, Value::Rows(read)) {
                            self.fault(Some(csv.span()), what);
                        }
                    }
                    Err(faults) => {
                        for fault in faults {
                            match fault.origin {
                                Some(_) => self.faults.push(fault),
                                None => self.fault(Some(csv.span()), fault.what),
                            }
                        }
                    }
                }
            }
            (None, None) => {
                let span = self.spans.get("rotor.model").cloned();
                self.fault(span, What::ComplianceMissing);
            }
            (None, Some(_)) => {}
        }
    }

    /// The rules between keys, for keys that are themselves in order.
    fn rules(&mut self, scene: &Scene) {
        for broken in scene.broken_rules() {
            if !self.at_fault(broken.keys) {
                // The line of the first key of the rule that the file gives.
                let span = broken.keys.iter().find_map(|key| self.spans.get(key)).cloned();
                self.fault(span, broken.what);
            }
        }
    }

    fn at_fault(&self, keys: &[&str]) -> bool {
        self.faults.iter().any(|fault| fault.what.key().is_some_and(|key| keys.contains(&key)))
    }

    fn fault(&mut self, span: Option<Bytes<usize>>, what: What) {
        let (line, column) = span.map(|span| line_and_column(self.text, span.start)).unzip();
        self.faults.push(Fault { origin: Some(self.origin.to_owned()), line, column, what });
    }

    /// A value as it is written in the file.
    fn written(&self, span: Bytes<usize>) -> String {
        show_text(self.text.get(span).unwrap_or_default())
    }
}

/// The value of a parameter from TOML; `None` if it is of a type the parameter never has.
fn value_from_toml(parameter: &'static Parameter, value: &DeValue<'_>) -> Option<Result<Value, What>> {
    Some(match (parameter.kind, value) {
        (ParameterKind::Number { .. }, value) => Ok(Value::Number(number(value)?)),
        (ParameterKind::Whole { .. }, value @ DeValue::Integer(_)) => match integer(value) {
            Some(whole) => Ok(Value::Whole(whole)),
            // Beyond 64 bits, hence beyond every range.
            None => {
                let (value, range) = (Value::Number(number(value)?), parameter.range()?);
                Err(What::OutOfRange { parameter, value, range })
            }
        },
        (ParameterKind::Whole { .. }, DeValue::Float(_)) => {
            let value = number(value).filter(|value| !value.is_finite())?;
            Err(What::NotFinite { parameter, value })
        }
        (ParameterKind::Flag { .. }, DeValue::Boolean(flag)) => Ok(Value::Flag(*flag)),
        (ParameterKind::Choice { .. } | ParameterKind::Text { .. }, DeValue::String(text)) => {
            Ok(Value::Text(text.clone().into_owned()))
        }
        _ => return None,
    })
}

/// Rows `[[wavenumber_per_m, compliance_m2_per_n], …]`, or each fault with the place of its row.
fn rows_from_toml(
    parameter: &'static Parameter,
    value: &Spanned<DeValue<'_>>,
    text: &str,
) -> Result<Vec<(f64, f64)>, Vec<Placed>> {
    let written = |span: Bytes<usize>| show_text(text.get(span).unwrap_or_default());
    let key = parameter.key;
    let Some(array) = value.get_ref().as_array() else {
        return Err(vec![(value.span(), What::WrongType { parameter, found: written(value.span()) })]);
    };
    if array.is_empty() || array.len() > MOST_ROWS {
        return Err(vec![(value.span(), What::TooManyRows { key, rows: array.len(), limit: MOST_ROWS })]);
    }
    let mut rows: Vec<(f64, f64)> = Vec::with_capacity(array.len());
    let mut faults = Vec::new();
    for (i, row) in array.iter().enumerate() {
        let pair = row.get_ref().as_array().and_then(|pair| {
            let mut numbers = pair.iter().map(|value| number(value.get_ref()));
            match (numbers.next(), numbers.next(), numbers.next()) {
                (Some(Some(wavenumber)), Some(Some(compliance)), None) => Some((wavenumber, compliance)),
                _ => None,
            }
        });
        let before = rows.last().map(|row| row.0);
        let checked = pair
            .ok_or_else(|| RowFault::NotAPair { found: written(row.span()) })
            .and_then(|row| check_row(row, before).map(|()| row));
        match checked {
            Ok(row) => rows.push(row),
            Err(fault) => faults.push((row.span(), What::Row { key, row: i + 1, fault })),
        }
    }
    if faults.is_empty() { Ok(rows) } else { Err(faults) }
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
    // What the reader says of a bare word that starts like true or false, such as first-order.
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
