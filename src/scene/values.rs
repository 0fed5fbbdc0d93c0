//! A scene: the values of its keys, and which keys it has.

use super::error::{FaultKind, SCHEMA, SceneError};
use super::keys::{PARAMETERS, tables};
use super::nearest::{nearest, nearest_key};
use super::parameter::{Belongs, Model, Parameter, ParameterKind};
use super::section::parts_at;
use super::value::{Value, show_text};
use crate::problem::Numerics;
use std::collections::BTreeMap;

/// Kind of scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A ring-type travelling-wave motor.
    Motor,
    /// A plate vibrating above a wall.
    Plate,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Motor, Self::Plate];

    /// The name in the file: "motor" or "plate".
    pub fn name(self) -> &'static str {
        match self {
            Self::Motor => "motor",
            Self::Plate => "plate",
        }
    }
}

/// One scene: a preset, whether built in, on disk or in the window.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name, shown with every result.
    pub name: String,
    /// A description of the scene in one line.
    pub about: String,
    kind: Kind,
    /// The values of all other keys that this scene has, by dotted key, except for defaults. Each value was accepted by its
    /// [`Parameter`], so that only rules between keys can be broken.
    values: BTreeMap<&'static str, Value>,
}

impl Scene {
    /// A scene with every key at its default.
    pub fn new(kind: Kind) -> Self {
        let mut scene = Self { name: String::new(), about: String::new(), kind, values: BTreeMap::new() };
        PARAMETERS.iter().filter(|parameter| parameter.table().is_empty()).for_each(|parameter| scene.reset(parameter));
        scene
    }

    /// A motor with every key at its default: the fundamental case.
    pub fn motor() -> Self {
        Self::new(Kind::Motor)
    }

    /// A plate with every key at its default: an infinitely wide strip.
    pub fn plate() -> Self {
        Self::new(Kind::Plate)
    }

    /// Kind of scene.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The kind of scene as named in the file: "motor" or "plate".
    pub fn scene(&self) -> &'static str {
        self.kind.name()
    }

    /// The value of a dotted key, in the key's unit. `None` for an optional key that is absent, for a key that this scene does not have, for
    /// an unknown key, and for the path of a CSV file (the scene keeps what follows from the file, under other keys).
    pub fn get(&self, key: &str) -> Option<Value> {
        match key {
            "schema" => Some(Value::Whole(SCHEMA)),
            "scene" => Some(Value::Text(self.scene().to_owned())),
            "name" => Some(Value::Text(self.name.clone())),
            "about" => Some(Value::Text(self.about.clone())),
            _ => self.values.get(key).cloned().or_else(|| {
                let parameter = Parameter::find(key).filter(|parameter| self.has(parameter))?;
                self.cell_value(key).or_else(|| parameter.default())
            }),
        }
    }

    /// The value that a key begins with in this scene: its default, or for the parts of a ring those that suit the contact. `None` if its absence
    /// has a meaning of its own.
    pub fn default_of(&self, parameter: &Parameter) -> Option<Value> {
        match [self.number("motor.contact_radius_mm"), self.number("rotor.contact_width_mm")] {
            [Ok(radius), Ok(width)] if parameter.key == "rotor.part" => Some(Value::Records(parts_at(radius, width))),
            _ => parameter.default(),
        }
    }

    /// The parameters that apply to this scene and its rotor model, in the order of the file, the absent ones included.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> + '_ {
        PARAMETERS.iter().filter(|parameter| self.has(parameter))
    }

    /// Whether this scene has a key: its own kind and model do, and no other key replaces it.
    pub fn has(&self, parameter: &Parameter) -> bool {
        self.elsewhere(parameter).is_none() && self.replacing(parameter).is_none()
    }

    /// Whether a key that this scene has can change its results. The file of a plate may have keys that only a motor uses; setting or varying
    /// one of them is an error. A plate under a load uses the minimum spacing, because it may come to rest on its roughness.
    pub fn heeds(&self, key: &str) -> bool {
        let idle = |parameter: &Parameter| parameter.belongs == Belongs::IdleOnPlate;
        let rests = key == "film.min_spacing_nm" && self.floats();
        self.kind == Kind::Motor || rests || !Parameter::find(key).is_some_and(idle)
    }

    /// Whether a plate has a load on it in place of a gap.
    pub fn floats(&self) -> bool {
        ["plate.load_n", "plate.mass_g"].iter().any(|key| self.is_set(key))
    }

    /// The unit of a key in this scene: load and mass of a strip are those of a metre of its width.
    pub fn unit(&self, parameter: &Parameter) -> String {
        let of_metre = ["plate.load_n", "plate.mass_g"].contains(&parameter.key)
            && self.text("plate.shape").is_ok_and(|shape| shape == "rectangle")
            && !self.is_set("plate.width_mm");
        format!("{}{}", parameter.unit, if of_metre { "/m" } else { "" })
    }

    /// Whether `other` is the same motor or plate: equal but for name, description and numerics.
    pub fn same_model(&self, other: &Self) -> bool {
        let [ours, theirs] =
            [self, other].map(|scene| scene.values.iter().filter(|(key, _)| !key.starts_with("numerics.")));
        self.kind == other.kind && ours.eq(theirs)
    }

    /// The table `[numerics]`.
    pub fn numerics(&self) -> Numerics {
        let given = self.values.iter().filter_map(|(key, value)| Some((key.strip_prefix("numerics.")?, value)));
        let table = toml::Table::try_from(given.collect::<BTreeMap<_, _>>()).ok();
        // Every key of the table is a field of the same name and type, which a test checks.
        table.and_then(|table| table.try_into().ok()).unwrap_or_default()
    }

    /// Replaces the table `[numerics]`.
    ///
    /// # Errors
    /// A number outside its range; the scene is then unchanged.
    pub fn set_numerics(&mut self, numerics: &Numerics) -> Result<(), SceneError> {
        let mut changed = self.clone();
        let table = toml::Table::try_from(numerics).ok();
        let mut given: BTreeMap<String, Value> = table.and_then(|table| table.try_into().ok()).unwrap_or_default();
        for parameter in PARAMETERS.iter().filter(|parameter| parameter.table() == "numerics") {
            match given.remove(parameter.leaf()) {
                Some(value) => changed.assign(parameter, value)?,
                None => changed.reset(parameter),
            }
        }
        *self = changed;
        Ok(())
    }

    /// If the scene or its model does not have a key: the key that chooses the scene or model, and those of its values that have the key.
    fn elsewhere(&self, parameter: &Parameter) -> Option<Model> {
        match (parameter.belongs, self.kind) {
            (Belongs::Motor, Kind::Plate) => return Some(("scene", &["motor"])),
            (Belongs::Plate, Kind::Motor) => return Some(("scene", &["plate"])),
            _ => {}
        }
        let chosen = |(selector, needs): &Model| self.text(selector).is_ok_and(|model| needs.contains(&model));
        parameter.when.first().filter(|_| !parameter.when.iter().any(chosen)).copied()
    }

    /// The key that is given in place of another one.
    fn replacing(&self, parameter: &Parameter) -> Option<&'static Parameter> {
        PARAMETERS.iter().find(|other| other.instead_of == Some(parameter.key) && self.is_set(other.key))
    }

    /// Whether a key applies to this scene; if not, why.
    pub(super) fn applies(&self, parameter: &Parameter) -> Result<(), FaultKind> {
        if let Some(model) = self.elsewhere(parameter) {
            return Err(self.foreign(parameter.key.to_owned(), model));
        }
        match self.replacing(parameter) {
            Some(other) => Err(FaultKind::BothGiven { key: parameter.key, other: other.key }),
            None => Ok(()),
        }
    }

    /// The fault of a key or table that only other scenes or models have.
    fn foreign(&self, key: String, (selector, needs): Model) -> FaultKind {
        let chosen = if selector == "scene" { self.scene() } else { self.text(selector).unwrap_or_default() };
        FaultKind::Elsewhere { key, selector, needs, chosen: chosen.to_owned() }
    }

    /// The fault of a key that does not exist.
    pub(super) fn unknown_key(&self, key: &str) -> FaultKind {
        let table = key.split_once('.').map_or("", |(table, _)| table);
        let keys_of = |table: &str| self.parameters().filter(|p| p.table() == table).map(|p| p.key).collect::<Vec<_>>();
        let unknown = |nearest: Option<&str>, siblings| {
            let (key, nearest) = (show_text(key), nearest.map(str::to_owned));
            FaultKind::Unknown { kind: "key", key, nearest, siblings }
        };
        if tables().contains(&key) {
            return unknown(None, keys_of(key));
        }
        if let Err(foreign) = self.has_table(table, show_text(key)) {
            return foreign;
        }
        if key.matches('.').count() > 2 {
            let cells = self.cell_keys();
            return unknown(nearest(key, cells.iter().map(String::as_str)), keys_of(table));
        }
        let known: Vec<_> = self.parameters().map(|parameter| parameter.key).collect();
        let in_no_table = table.is_empty() || keys_of(table).is_empty();
        let siblings = if in_no_table { self.tables() } else { keys_of(table) };
        unknown(nearest_key(key, &known), siblings)
    }

    pub(super) fn tables(&self) -> Vec<&'static str> {
        tables().into_iter().filter(|table| self.parameters().any(|p| p.table() == *table)).collect()
    }

    /// Whether this kind of scene has a table; if not, why, with `key` as the subject of the message. A table that does not exist is not a
    /// fault here.
    pub(super) fn has_table(&self, table: &str, key: String) -> Result<(), FaultKind> {
        match PARAMETERS.iter().find(|p| p.table() == table).and_then(|p| self.elsewhere(p)) {
            Some(model @ ("scene", _)) => Err(self.foreign(key, model)),
            _ => Ok(()),
        }
    }

    /// Checks a value against the key's own type and range, and stores it.
    pub(super) fn assign(&mut self, parameter: &'static Parameter, value: Value) -> Result<(), FaultKind> {
        let value = parameter.accept(value)?;
        if let Some(array) = self.with_cell(parameter.key, &value) {
            let (array, records) = array?;
            return self.assign(array, records);
        }
        // A table chooses the model that it belongs to.
        let table = matches!(parameter.kind, ParameterKind::Rows { .. } | ParameterKind::Records { .. });
        if let (true, Some((selector, model))) = (table, parameter.when.first()) {
            self.assign(self.parameter(selector)?, Value::Text(model.concat()))?;
        }
        self.put(parameter, Some(value));
        Ok(())
    }

    /// As [`Self::assign`], for a change of this scene. If the change chooses a ring, the ring begins with a section that suits the
    /// contact, or with the section that `value` is.
    pub(super) fn change(&mut self, parameter: &'static Parameter, value: Value) -> Result<(), FaultKind> {
        let section = self.parameter("rotor.part")?;
        let before = self.has(section);
        self.assign(parameter, value)?;
        if !before && parameter != section && self.has(section) {
            self.reset(section);
        }
        Ok(())
    }

    /// Gives a key its default, or removes it if it is optional.
    pub(super) fn reset(&mut self, parameter: &'static Parameter) {
        // A single value of an array has no default.
        if self.cell_value(parameter.key).is_none() {
            self.put(parameter, self.default_of(parameter));
        }
    }

    /// Stores a value that has been accepted, or removes it. If it chooses a model, the keys of other models are removed; if it is given in
    /// place of another key, that key is removed.
    pub(super) fn put(&mut self, parameter: &'static Parameter, value: Option<Value>) {
        if value.is_some() {
            for other in parameter.alternatives() {
                self.values.remove(other.key);
            }
        }
        match (parameter.key, value) {
            ("name", Some(Value::Text(name))) => self.name = name,
            ("about", Some(Value::Text(about))) => self.about = about,
            (key, Some(value)) if parameter.default().as_ref() != Some(&value) => {
                self.values.insert(key, value);
            }
            (key, _) => {
                self.values.remove(key);
            }
        }
        if parameter.selects() {
            let foreign = PARAMETERS.iter().filter(|parameter| !self.has(parameter));
            for key in foreign.map(|parameter| parameter.key).collect::<Vec<_>>() {
                self.values.remove(key);
            }
        }
    }

    pub(super) fn parameter(&self, key: &str) -> Result<&'static Parameter, FaultKind> {
        Parameter::find(key).ok_or_else(|| self.unknown_key(key))
    }

    /// The number of a key, also if it is a whole number, or if it follows from other keys; `None` if the key is absent.
    pub(super) fn optional_number(&self, parameter: &'static Parameter) -> Option<f64> {
        let stored = self.values.get(parameter.key).and_then(Value::as_number);
        stored.or_else(|| self.following(parameter.key)).or_else(|| parameter.default()?.as_number())
    }

    /// Whether a key has another value than its default.
    pub(super) fn is_set(&self, key: &str) -> bool {
        self.values.contains_key(key)
    }

    /// The number of a key that differs from its default; `None` if it does not.
    pub(super) fn given(&self, key: &str) -> Option<f64> {
        self.values.get(key).and_then(Value::as_number)
    }

    /// The number of a key, in its unit.
    pub(super) fn number(&self, key: &str) -> Result<f64, FaultKind> {
        self.optional_number(self.parameter(key)?).ok_or_else(|| self.unknown_key(key))
    }

    /// The text of a key, or the name of its choice.
    pub(super) fn text(&self, key: &str) -> Result<&str, FaultKind> {
        match (self.values.get(key), self.parameter(key)?.kind) {
            (Some(Value::Text(text)), _) => Ok(text),
            (_, ParameterKind::Choice { default, .. } | ParameterKind::Text { default }) => Ok(default),
            _ => Err(self.unknown_key(key)),
        }
    }

    /// Whether a key is true.
    pub(super) fn flag(&self, key: &str) -> Result<bool, FaultKind> {
        match (self.values.get(key), self.parameter(key)?.kind) {
            (Some(Value::Flag(flag)), _) => Ok(*flag),
            (_, ParameterKind::Flag { default }) => Ok(default),
            _ => Err(self.unknown_key(key)),
        }
    }

    /// The rows of a table; empty if the scene has no such table.
    pub(super) fn rows(&self, key: &str) -> &[(f64, f64)] {
        match self.values.get(key) {
            Some(Value::Rows(rows)) => rows,
            _ => &[],
        }
    }

    /// Pitch of the teeth of a motor \[mm\].
    pub(super) fn pitch_mm(&self) -> Result<f64, FaultKind> {
        Ok(self.wavelength()? * 1e3 / self.number("stator.teeth_per_wave")?)
    }

    /// Wavelength \[m\] of a motor, 2πr/waves.
    pub(super) fn wavelength(&self) -> Result<f64, FaultKind> {
        let radius = self.number("motor.contact_radius_mm")? / 1e3;
        Ok(std::f64::consts::TAU * radius / self.number("motor.waves")?)
    }
}
