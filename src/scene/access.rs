//! A scene by dotted key: get, set, and what applies. The list in `locate!` is the only place that ties a key to a
//! field; `every_parameter_has_a_field` compares it with [`PARAMETERS`].

use super::error::{SceneError, What};
use super::nearest::{nearest, nearest_key};
use super::parameter::{Belongs, PARAMETERS, Parameter, ParameterKind, TABLES};
use super::value::{Value, show_text};
use super::{Kind, RotorModel, Scene, blank_beam, compliance, parse};
use crate::problem::Named;
use std::path::Path;

/// A field to read.
enum View<'a> {
    Number(&'a f64),
    OptionalNumber(&'a Option<f64>),
    Whole(&'a u32),
    OptionalCount(&'a Option<usize>),
    Flag(&'a bool),
    Text(&'a String),
    Choice(&'a dyn Named),
    Model(&'a RotorModel),
    Rows(&'a Vec<(f64, f64)>),
}

/// A field to write.
enum Place<'a> {
    Number(&'a mut f64),
    OptionalNumber(&'a mut Option<f64>),
    Whole(&'a mut u32),
    OptionalCount(&'a mut Option<usize>),
    Flag(&'a mut bool),
    Text(&'a mut String),
    Choice(&'a mut dyn Named),
    Model(&'a mut RotorModel),
    Rows(&'a mut Vec<(f64, f64)>),
}

/// The field of `$key`, as a `$Field` that borrows `$($borrow)*`.
macro_rules! locate {
    ($scene:expr, $key:expr, $Field:ident, $($borrow:tt)*) => {{
        let scene = $scene;
        match $key {
            "name" => return Some($Field::Text($($borrow)* scene.name)),
            "about" => return Some($Field::Text($($borrow)* scene.about)),
            "numerics.film_nodes_along" => {
                return Some($Field::OptionalCount($($borrow)* scene.numerics.film_nodes_along));
            }
            "numerics.film_nodes_across" => {
                return Some($Field::OptionalCount($($borrow)* scene.numerics.film_nodes_across));
            }
            "numerics.contact_nodes" => {
                return Some($Field::OptionalCount($($borrow)* scene.numerics.contact_nodes));
            }
            "numerics.steps_per_cycle" => {
                return Some($Field::OptionalCount($($borrow)* scene.numerics.steps_per_cycle));
            }
            "numerics.tolerance" => return Some($Field::OptionalNumber($($borrow)* scene.numerics.tolerance)),
            "numerics.wedge" => return Some($Field::Choice($($borrow)* scene.numerics.wedge)),
            "numerics.teeth" => return Some($Field::Choice($($borrow)* scene.numerics.teeth)),
            "numerics.width" => return Some($Field::Choice($($borrow)* scene.numerics.width)),
            "numerics.flow" => return Some($Field::Choice($($borrow)* scene.numerics.flow)),
            "numerics.time" => return Some($Field::Choice($($borrow)* scene.numerics.time)),
            key if key.starts_with("film.") => {
                let (Kind::Motor { film, .. } | Kind::Plate { film, .. }) = $($borrow)* scene.kind;
                return match key {
                    "film.min_spacing_nm" => Some($Field::Number($($borrow)* film.min_spacing_nm)),
                    "film.ambient_pressure_kpa" => Some($Field::Number($($borrow)* film.ambient_pressure_kpa)),
                    "film.viscosity_upa_s" => Some($Field::Number($($borrow)* film.viscosity_upa_s)),
                    "film.mean_free_path_nm" => Some($Field::Number($($borrow)* film.mean_free_path_nm)),
                    "film.slip" => Some($Field::Choice($($borrow)* film.slip)),
                    "film.shear" => Some($Field::Flag($($borrow)* film.shear)),
                    _ => None,
                };
            }
            _ => {}
        }
        match $($borrow)* scene.kind {
            Kind::Motor { motor, stator, rotor, .. } => match $key {
                "motor.contact_radius_mm" => Some($Field::Number($($borrow)* motor.contact_radius_mm)),
                "motor.waves" => Some($Field::Whole($($borrow)* motor.waves)),
                "motor.load_per_wave_n" => Some($Field::Number($($borrow)* motor.load_per_wave_n)),
                "motor.dry_friction" => Some($Field::Number($($borrow)* motor.dry_friction)),
                "motor.rotor_speed_rpm" => Some($Field::Number($($borrow)* motor.rotor_speed_rpm)),
                "stator.frequency_khz" => Some($Field::Number($($borrow)* stator.frequency_khz)),
                "stator.normal_amplitude_um" => Some($Field::Number($($borrow)* stator.normal_amplitude_um)),
                "stator.tangential_amplitude_um" => Some($Field::Number($($borrow)* stator.tangential_amplitude_um)),
                "stator.teeth_per_wave" => Some($Field::Whole($($borrow)* stator.teeth_per_wave)),
                "stator.tooth_width_mm" => Some($Field::Number($($borrow)* stator.tooth_width_mm)),
                "stator.tooth_radius_m" => Some($Field::OptionalNumber($($borrow)* stator.tooth_radius_m)),
                "rotor.contact_width_mm" => Some($Field::Number($($borrow)* rotor.contact_width_mm)),
                "rotor.model" => Some($Field::Model($($borrow)* rotor.model)),
                key => match $($borrow)* rotor.model {
                    RotorModel::Beam { decay_length_mm, point_compliance_um_per_n, local_compliance_m2_per_n } => {
                        match key {
                            "rotor.decay_length_mm" => Some($Field::Number(decay_length_mm)),
                            "rotor.point_compliance_um_per_n" => Some($Field::Number(point_compliance_um_per_n)),
                            "rotor.local_compliance_m2_per_n" => Some($Field::Number(local_compliance_m2_per_n)),
                            _ => None,
                        }
                    }
                    RotorModel::Table { compliance } => (key == "rotor.compliance").then_some($Field::Rows(compliance)),
                },
            },
            Kind::Plate { plate, .. } => match $key {
                "plate.length_mm" => Some($Field::Number($($borrow)* plate.length_mm)),
                "plate.width_mm" => Some($Field::OptionalNumber($($borrow)* plate.width_mm)),
                "plate.mean_gap_um" => Some($Field::Number($($borrow)* plate.mean_gap_um)),
                "plate.amplitude_um" => Some($Field::Number($($borrow)* plate.amplitude_um)),
                "plate.frequency_khz" => Some($Field::Number($($borrow)* plate.frequency_khz)),
                _ => None,
            },
        }
    }};
}

impl Scene {
    /// The value of a dotted key, in the key's unit. `None` for an optional key that is absent, a key of another scene
    /// or rotor model, an unknown key, and `rotor.compliance_csv` (the scene keeps the rows, under `rotor.compliance`).
    pub fn get(&self, key: &str) -> Option<Value> {
        match key {
            "schema" => return Some(Value::Whole(super::SCHEMA)),
            "scene" => return Some(Value::Text(self.scene().to_owned())),
            _ => {}
        }
        Some(match self.view(key)? {
            View::Number(number) => Value::Number(*number),
            View::OptionalNumber(number) => Value::Number((*number)?),
            View::Whole(whole) => Value::Whole(i64::from(*whole)),
            View::OptionalCount(count) => Value::Whole(i64::try_from((*count)?).unwrap_or(i64::MAX)),
            View::Flag(flag) => Value::Flag(*flag),
            View::Text(text) => Value::Text(text.clone()),
            View::Choice(choice) => Value::Text(choice.name().to_owned()),
            View::Model(model) => Value::Text(model.name().to_owned()),
            View::Rows(rows) => Value::Rows(rows.clone()),
        })
    }

    /// Sets a dotted key from text, as `--set key=value` does: numbers in the key's unit, names without quotes.
    /// `none` or nothing removes an optional key. A path given for `rotor.compliance_csv` is relative to the current
    /// folder. Giving a compliance table makes `rotor.model` "table".
    ///
    /// # Errors
    ///
    /// An unknown key, a key of another scene or rotor model, a value of the wrong type or outside the key's own range;
    /// the scene is then unchanged. Rules between keys are left to [`Scene::check`], so that several keys can be set
    /// one by one; [`Scene::set_all`] does both.
    pub fn set(&mut self, key: &str, text: &str) -> Result<(), SceneError> {
        let parameter = self.settable(key)?;
        let text = text.trim();
        if parameter.absent.is_some() && (text.is_empty() || text == "none") {
            return Ok(self.clear(parameter)?);
        }
        if parameter.kind == ParameterKind::CsvPath {
            let path = Path::new(text);
            let rows = parse::read_compliance(text, path, self.wavelength()).map_err(|faults| {
                // There is at least one fault; if not, the table is missing.
                SceneError::unless_empty(faults).err().unwrap_or_else(|| What::ComplianceMissing.into())
            })?;
            self.put(parameter, Value::Rows(rows));
            return Ok(());
        }
        let value = parse::value_from_text(parameter, text)?;
        Ok(self.assign(parameter, value)?)
    }

    /// Sets a dotted key from a value in the key's unit. A number without a fraction is accepted for a whole number.
    ///
    /// # Errors
    ///
    /// As [`Scene::set`].
    pub fn set_value(&mut self, key: &str, value: Value) -> Result<(), SceneError> {
        let parameter = self.settable(key)?;
        Ok(self.assign(parameter, value)?)
    }

    /// Removes an optional key, or gives another key its default.
    ///
    /// # Errors
    ///
    /// An unknown key, or a key of another scene or rotor model.
    pub fn unset(&mut self, key: &str) -> Result<(), SceneError> {
        let parameter = self.settable(key)?;
        self.reset(parameter);
        Ok(())
    }

    /// Applies `key=value` pairs as one change: in any order, with the rules between keys checked at the end. The last
    /// of several values for one key holds.
    ///
    /// # Errors
    ///
    /// All faults of all pairs; the scene is then unchanged.
    pub fn set_all<'a>(&mut self, pairs: impl IntoIterator<Item = (&'a str, &'a str)>) -> Result<(), SceneError> {
        let mut pairs: Vec<_> = pairs.into_iter().collect();
        // The rotor's model decides which of its keys exist, and a table of harmonics needs the wavelength.
        pairs.sort_by_key(|(key, _)| match *key {
            "rotor.model" => 0,
            "rotor.compliance" | "rotor.compliance_csv" => 2,
            _ => 1,
        });
        let mut changed = self.clone();
        let mut faults = Vec::new();
        for (key, text) in pairs {
            if let Err(error) = changed.set(key, text) {
                faults.extend_from_slice(error.faults());
            }
        }
        SceneError::unless_empty(faults)?;
        changed.check()?;
        *self = changed;
        Ok(())
    }

    /// The parameters that apply to this scene and its rotor model, in the order of the file, the absent ones included.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> + '_ {
        PARAMETERS.iter().filter(|parameter| self.applies(parameter).is_ok())
    }

    /// Whether a key that applies to this scene can change its results. A plate's file may hold keys of the film and of the numerics
    /// that only a motor heeds; to set or to vary one is refused.
    pub fn heeds(&self, key: &str) -> bool {
        const MOTOR_ONLY: [&str; 8] = [
            "film.min_spacing_nm",
            "film.shear",
            "numerics.contact_nodes",
            "numerics.wedge",
            "numerics.teeth",
            "numerics.width",
            "numerics.flow",
            "numerics.time",
        ];
        self.rotor_model().is_some() || !MOTOR_ONLY.contains(&key)
    }

    /// Whether a key applies to this scene; if not, why.
    pub(super) fn applies(&self, parameter: &'static Parameter) -> Result<(), What> {
        let key = parameter.key;
        let other_scene = |needs| What::OtherScene { key: key.to_owned(), needs, scene: self.scene() };
        match (parameter.belongs, self.rotor_model()) {
            (Belongs::Any, _) | (Belongs::Motor, Some(_)) | (Belongs::Plate, None) => Ok(()),
            (Belongs::Beam, Some(RotorModel::Beam { .. })) | (Belongs::Table, Some(RotorModel::Table { .. })) => Ok(()),
            (Belongs::Plate, Some(_)) => Err(other_scene("plate")),
            (Belongs::Motor | Belongs::Beam | Belongs::Table, None) => Err(other_scene("motor")),
            (Belongs::Beam, Some(model)) => Err(What::OtherModel { key, needs: "beam", model: model.name() }),
            (Belongs::Table, Some(model)) => Err(What::OtherModel { key, needs: "table", model: model.name() }),
        }
    }

    /// The fault of a key that does not exist.
    pub(super) fn unknown_key(&self, key: &str) -> What {
        let table = key.split_once('.').map_or("", |(table, _)| table);
        let keys_of = |table: &str| self.parameters().filter(|p| p.table() == table).map(|p| p.key).collect::<Vec<_>>();
        let unknown = |nearest: Option<&str>, siblings| What::UnknownKey {
            key: show_text(key),
            nearest: nearest.map(str::to_owned),
            siblings,
        };
        if TABLES.contains(&key) {
            return unknown(None, keys_of(key));
        }
        let foreign = PARAMETERS.iter().find(|p| p.table() == table).and_then(|p| self.applies(p).err());
        if let Some(What::OtherScene { needs, scene, .. }) = foreign {
            return What::OtherScene { key: show_text(key), needs, scene };
        }
        let known: Vec<_> = self.parameters().map(|parameter| parameter.key).collect();
        let siblings = if keys_of(table).is_empty() { self.tables() } else { keys_of(table) };
        unknown(nearest_key(key, &known), siblings)
    }

    /// The tables this scene has.
    pub(super) fn tables(&self) -> Vec<&'static str> {
        TABLES.iter().copied().filter(|table| self.parameters().any(|p| p.table() == *table)).collect()
    }

    /// The parameter of a key, if it exists and applies. A compliance table may be given to a beam: it replaces it.
    fn settable(&self, key: &str) -> Result<&'static Parameter, What> {
        match key {
            "schema" => return Err(What::Fixed { key: "schema" }),
            "scene" => return Err(What::Fixed { key: "scene" }),
            _ => {}
        }
        let parameter = Parameter::find(key).ok_or_else(|| self.unknown_key(key))?;
        match self.applies(parameter) {
            Ok(()) if !self.heeds(parameter.key) => Err(What::NoEffect { key: parameter.key, scene: self.scene() }),
            Err(What::OtherModel { needs: "table", .. }) => Ok(parameter),
            applies => applies.map(|()| parameter),
        }
    }

    /// Checks a value against the key's own type and range, and stores it.
    pub(super) fn assign(&mut self, parameter: &'static Parameter, value: Value) -> Result<(), What> {
        let value = accept(parameter, value)?;
        self.put(parameter, value);
        Ok(())
    }

    /// Removes an optional key.
    fn clear(&mut self, parameter: &'static Parameter) -> Result<(), What> {
        match self.place(parameter.key) {
            Some(Place::OptionalNumber(number)) => *number = None,
            Some(Place::OptionalCount(count)) => *count = None,
            _ => return Err(What::WrongType { parameter, found: "none".to_owned() }),
        }
        Ok(())
    }

    /// Gives a key its default; an optional key, and a table of rows, becomes absent or empty. A key that does not
    /// apply is left alone.
    pub(super) fn reset(&mut self, parameter: &'static Parameter) {
        if parameter.absent.is_some() {
            let _ = self.clear(parameter);
            return;
        }
        let value = match parameter.kind {
            ParameterKind::Number { default, .. } => Value::Number(default),
            ParameterKind::Whole { default, .. } => Value::Whole(i64::from(default)),
            ParameterKind::Flag { default } => Value::Flag(default),
            ParameterKind::Choice { default, .. } | ParameterKind::Text { default } => Value::Text(default.to_owned()),
            ParameterKind::Rows => match self.rotor_model() {
                Some(RotorModel::Table { .. }) => Value::Rows(Vec::new()),
                _ => return,
            },
            ParameterKind::CsvPath => return,
        };
        self.put(parameter, value);
    }

    /// Stores a value that fits; one that does not apply is dropped.
    fn put(&mut self, parameter: &'static Parameter, value: Value) {
        if let (ParameterKind::Rows | ParameterKind::CsvPath, Kind::Motor { rotor, .. }) =
            (parameter.kind, &mut self.kind)
            && rotor.model.name() != "table"
        {
            rotor.model = RotorModel::Table { compliance: Vec::new() };
        }
        let key = if parameter.kind == ParameterKind::CsvPath { "rotor.compliance" } else { parameter.key };
        match (self.place(key), value) {
            (Some(Place::Rows(place)), Value::Rows(rows)) => *place = rows,
            (Some(Place::Number(place)), Value::Number(value)) => *place = value,
            (Some(Place::OptionalNumber(place)), Value::Number(value)) => *place = Some(value),
            (Some(Place::Whole(place)), Value::Whole(value)) => *place = u32::try_from(value).unwrap_or(u32::MAX),
            (Some(Place::OptionalCount(place)), Value::Whole(value)) => *place = usize::try_from(value).ok(),
            (Some(Place::Flag(place)), Value::Flag(value)) => *place = value,
            (Some(Place::Text(place)), Value::Text(value)) => *place = value,
            (Some(Place::Choice(place)), Value::Text(name)) => {
                place.choose(&name);
            }
            (Some(Place::Model(place)), Value::Text(name)) if name != place.name() => {
                if name == "table" {
                    *place = RotorModel::Table { compliance: Vec::new() };
                } else {
                    *place = blank_beam();
                    PARAMETERS.iter().filter(|p| p.belongs == Belongs::Beam).for_each(|p| self.reset(p));
                }
            }
            // `accept` has let no other pair through.
            _ => {}
        }
    }

    fn view(&self, key: &str) -> Option<View<'_>> {
        locate!(self, key, View, &)
    }

    fn place(&mut self, key: &str) -> Option<Place<'_>> {
        locate!(self, key, Place, &mut)
    }
}

/// The value, if the parameter accepts it; whole numbers are numbers, and numbers without a fraction are whole.
pub(super) fn accept(parameter: &'static Parameter, value: Value) -> Result<Value, What> {
    let wrong_type = |value: &Value| What::WrongType { parameter, found: value.to_string() };
    match (parameter.kind, value) {
        (ParameterKind::Number { range, .. }, Value::Number(value)) => within(parameter, range, value),
        (ParameterKind::Number { range, .. }, Value::Whole(value)) => within(parameter, range, value as f64),
        (ParameterKind::Whole { min, max, .. }, Value::Whole(value)) => {
            if (i64::from(min)..=i64::from(max)).contains(&value) {
                Ok(Value::Whole(value))
            } else {
                let range = super::Range::new(f64::from(min), f64::from(max));
                Err(What::OutOfRange { parameter, value: Value::Whole(value), range })
            }
        }
        (ParameterKind::Whole { .. }, Value::Number(value)) if !value.is_finite() => {
            Err(What::NotFinite { parameter, value })
        }
        (ParameterKind::Whole { .. }, Value::Number(value)) if value.fract() == 0.0 => {
            // Saturates far outside every range.
            accept(parameter, Value::Whole(value as i64))
        }
        (ParameterKind::Flag { .. }, value @ Value::Flag(_)) => Ok(value),
        (ParameterKind::Text { .. }, value @ Value::Text(_)) => Ok(value),
        (ParameterKind::Choice { options, .. }, Value::Text(value)) => {
            if options.contains(&value.as_str()) {
                Ok(Value::Text(value))
            } else if parameter.key == "rotor.model" && value == "ring" {
                Err(What::ReservedModel)
            } else {
                let nearest = nearest(&value, options.iter().copied()).map(str::to_owned);
                Err(What::NotAChoice { parameter, value: show_text(&value), nearest })
            }
        }
        (ParameterKind::Rows, Value::Rows(rows)) => {
            match compliance::check_rows(parameter.key, &rows).into_iter().next() {
                Some(fault) => Err(fault),
                None => Ok(Value::Rows(rows)),
            }
        }
        (_, value) => Err(wrong_type(&value)),
    }
}

fn within(parameter: &'static Parameter, range: super::Range, value: f64) -> Result<Value, What> {
    if !value.is_finite() {
        Err(What::NotFinite { parameter, value })
    } else if !range.contains(value) {
        Err(What::OutOfRange { parameter, value: Value::Number(value), range })
    } else {
        Ok(Value::Number(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Scene {
        let mut scene = Scene::motor();
        scene.set("rotor.compliance", "[[100, 1e-9]]").unwrap();
        scene
    }

    #[test]
    fn every_parameter_has_a_field() {
        let mut scenes = [Scene::motor(), table(), Scene::plate()];
        for parameter in PARAMETERS {
            let found = scenes.iter_mut().filter_map(|scene| {
                let applies = scene.applies(parameter).is_ok();
                assert!(applies || scene.view(parameter.key).is_none(), "{}", parameter.key);
                let seen = scene.view(parameter.key).is_some();
                assert_eq!(seen, scene.place(parameter.key).is_some(), "{}", parameter.key);
                seen.then_some(())
            });
            assert!(found.count() > 0 || parameter.kind == ParameterKind::CsvPath, "{}", parameter.key);
        }
    }

    #[test]
    fn every_choice_of_the_table_is_one_of_the_field() {
        let mut scene = Scene::motor();
        for parameter in PARAMETERS.iter().filter(|p| p.belongs != Belongs::Plate && p.key != "rotor.model") {
            if let ParameterKind::Choice { options, .. } = parameter.kind {
                for name in options {
                    scene.set(parameter.key, name).unwrap();
                    assert_eq!(scene.get(parameter.key), Some(Value::Text((*name).to_owned())), "{}", parameter.key);
                }
            }
        }
    }

    #[test]
    fn a_new_model_brings_its_defaults() {
        let mut scene = table();
        scene.set("rotor.model", "beam").unwrap();
        assert_eq!(scene, Scene::motor());
        scene.set("rotor.model", "table").unwrap();
        assert!(scene.check().unwrap_err().to_string().contains("needs rotor.compliance_csv"));
    }
}
