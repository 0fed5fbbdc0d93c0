//! Changes of a scene, key by key, and its title after a change.

use super::error::{FaultKind, SceneError};
use super::heights;
use super::parameter::{Parameter, ParameterKind};
use super::parse;
use super::value::{Value, show_text};
use super::values::Scene;
use crate::digits::{counted, rounded};
use std::borrow::Borrow;
use std::path::Path;

/// Digits of the numbers in a description; the scene has all of them.
const DIGITS: usize = 6;
/// Most values of an array that a description lists.
const MOST_CELLS: usize = 4;

impl Scene {
    /// Sets a dotted key from text, as `--set key=value` does: numbers in the key's unit, names without quotes, tables as in TOML.
    /// `none` or an empty text removes an optional key. The path of a CSV file is relative to the current folder. A table, or the parts of
    /// a ring, also set `rotor.model` to the model that has them. A ring that is chosen without its parts gets some that suit the contact.
    ///
    /// # Errors
    /// An unknown key, a key of another scene or rotor model, a value of the wrong type or outside the key's own range;
    /// the scene is then unchanged. Rules between keys are left to [`Scene::check`], so that several keys can be set
    /// one by one; [`Scene::set_all`] does both.
    pub fn set(&mut self, key: &str, text: &str) -> Result<(), SceneError> {
        let parameter = self.settable(key)?;
        let text = text.trim();
        if parameter.absent.is_some() && (text.is_empty() || text == "none") {
            self.reset(parameter);
            return Ok(());
        }
        let value = match parameter.kind {
            ParameterKind::Rows { .. } | ParameterKind::Records { .. } => parse::array_from_text(parameter, text)?,
            ParameterKind::CsvPath { table } => return self.take_csv(parameter, table, text, Path::new(text)),
            _ => parameter.read(text)?,
        };
        Ok(self.change(parameter, value)?)
    }

    /// Reads the CSV file at `path`, and sets the key `table`, or those that follow from measured heights and that this scene has.
    /// `parameter` names the file, with the value `given`, which messages quote.
    pub(super) fn take_csv(
        &mut self,
        parameter: &'static Parameter,
        table: Option<&str>,
        given: &str,
        path: &Path,
    ) -> Result<(), SceneError> {
        if let Some(table) = table {
            let of = self.parameter(table)?;
            let rows = parse::read_table(parameter, of, given, path, self.wavelength()?)?;
            return Ok(self.assign(of, rows)?);
        }
        let mut changed = self.clone();
        for (key, value) in heights::keys_of(&heights::read(parameter, given, path)?) {
            let of = changed.parameter(key)?;
            if changed.has(of) {
                changed.assign(of, Value::Number(value))?;
            }
        }
        *self = changed;
        Ok(())
    }

    /// Sets a dotted key from a value in the key's unit. A number without a fraction is accepted for a whole number.
    pub fn set_value(&mut self, key: &str, value: Value) -> Result<(), SceneError> {
        let parameter = self.settable(key)?;
        Ok(self.change(parameter, value).map_err(|fault| self.narrowed(fault))?)
    }

    /// The scene with numbers of keys, each in its unit, set one after the other as [`Scene::set_value`] does.
    pub fn with_numbers<'a>(&self, numbers: impl IntoIterator<Item = (&'a str, f64)>) -> Result<Self, SceneError> {
        let mut changed = self.clone();
        for (key, number) in numbers {
            changed.set_value(key, Value::Number(number))?;
        }
        Ok(changed)
    }

    /// Removes an optional key, or gives another key its default.
    pub fn unset(&mut self, key: &str) -> Result<(), SceneError> {
        let parameter = self.settable(key)?;
        self.reset(parameter);
        Ok(())
    }

    /// Applies `key=value` pairs as one change, in any order; the rules between keys are checked at the end. If a key has several values, the
    /// last one counts.
    ///
    /// # Errors
    /// The faults of all pairs; the scene is then unchanged.
    pub fn set_all<K: AsRef<str>, V: AsRef<str>>(
        &mut self,
        pairs: impl IntoIterator<Item: Borrow<(K, V)>>,
    ) -> Result<(), SceneError> {
        *self = self.with(pairs)?;
        Ok(())
    }

    /// The scene with `key=value` pairs applied as [`Scene::set_all`] does.
    ///
    /// # Errors
    /// The faults of all pairs.
    pub fn with<K: AsRef<str>, V: AsRef<str>>(
        &self,
        pairs: impl IntoIterator<Item: Borrow<(K, V)>>,
    ) -> Result<Self, SceneError> {
        let pairs: Vec<_> = pairs.into_iter().collect();
        let mut pairs: Vec<_> =
            pairs.iter().map(Borrow::borrow).map(|(key, text)| (key.as_ref(), text.as_ref())).collect();
        // `key=none` changes nothing if another key for the same quantity is set too.
        let set: Vec<_> = pairs.iter().filter(|(_, text)| *text != "none").map(|(key, _)| *key).collect();
        let replaced = |parameter: &'static Parameter| parameter.alternatives().any(|other| set.contains(&other.key));
        pairs.retain(|(key, text)| *text != "none" || !Parameter::find(key).is_some_and(replaced));
        // The keys of the contact come first, because the parts of a new ring depend on them.
        let contact = |key: &str| matches!(key, "motor.contact_radius_mm" | "rotor.contact_width_mm");
        pairs.sort_by_key(|(key, _)| (!contact(key), Parameter::find(key).map_or(0, Parameter::rank)));
        let mut changed = self.clone();
        let mut faults = SceneError::none();
        let mut given: Vec<&'static Parameter> = Vec::new();
        for (key, text) in pairs {
            changed.set(key, text).unwrap_or_else(|error| faults.join(error));
            let Some(parameter) = Parameter::find(key).filter(|parameter| changed.get(parameter.key).is_some()) else {
                continue;
            };
            if let Some(other) = parameter.alternatives().find(|other| given.contains(other)) {
                faults.push(FaultKind::BothGiven { key: parameter.key, other: other.key });
            }
            given.push(parameter);
        }
        faults.map(|fault| changed.narrowed(fault)).or(())?;
        changed.check()?;
        Ok(changed)
    }

    /// The parameter of a key that can be set. A table can be set on a rotor of another model: it then replaces that model.
    fn settable(&self, key: &str) -> Result<&'static Parameter, FaultKind> {
        if let Some(key) = ["schema", "scene"].into_iter().find(|fixed| *fixed == key) {
            return Err(FaultKind::Rule {
                key,
                message: format!("{key} cannot be changed: start from another preset"),
            });
        }
        let parameter = self.parameter(key)?;
        match (self.applies(parameter), parameter.kind) {
            (Ok(()), _) if !self.heeds(key) => {
                let scene = self.scene();
                let message = format!("{key} has no effect on a {scene}: it cannot be changed or varied here");
                Err(FaultKind::Rule { key: parameter.key, message })
            }
            (
                Err(FaultKind::Elsewhere { selector, .. }),
                ParameterKind::Rows { .. } | ParameterKind::CsvPath { table: Some(_) } | ParameterKind::Records { .. },
            ) if selector != "scene" => Ok(parameter),
            // The key that is set replaces the one that was given.
            (Err(FaultKind::BothGiven { .. }), _) => Ok(parameter),
            (applies, _) => applies.map(|()| parameter),
        }
    }

    /// The keys in which this scene differs from `original`, except for name and description, and for the defaults of keys that `original`
    /// does not have.
    pub fn changed<'a>(&'a self, original: &'a Self) -> impl Iterator<Item = &'static Parameter> + 'a {
        let compared = self.parameters().filter(|parameter| !matches!(parameter.key, "name" | "about"));
        compared.filter(move |parameter| {
            let value = self.get(parameter.key);
            value != original.get(parameter.key) && (original.has(parameter) || value != self.default_of(parameter))
        })
    }

    /// The title of a scene that was made from `original`: `Fundamental case, changed: 3 keys`, unless it has another name.
    pub fn title(&self, original: &Self) -> String {
        match self.changed(original).count() {
            keys if keys > 0 && self.name == original.name => {
                let keys = counted(keys, "key", "keys");
                match self.unchanged_name() {
                    name if name != self.name => format!("{name}, changed again: {keys}"),
                    name => format!("{name}, changed: {keys}"),
                }
            }
            _ => self.name.clone(),
        }
    }

    /// Its name without what [`Scene::title`] has added to it.
    pub fn unchanged_name(&self) -> &str {
        self.name.split(", changed").next().unwrap_or_default()
    }

    /// Gives a scene that was made from `original` a name and a description that say so, and that stay true after further changes. A name
    /// or a description of its own is kept.
    pub fn made_from(&mut self, original: &Self) {
        if self.about == original.about {
            self.about = format!("Made from {}.", original.name);
        }
        if self.name == original.name {
            self.name = format!("{}, changed", original.unchanged_name());
        }
    }

    /// Gives a scene that was made from `original` its [`Scene::title`] as a name, and a description that lists the changes. A name or a
    /// description of its own is kept.
    pub fn retitle(&mut self, original: &Self) {
        let shown = |scene: &Self, parameter: &Parameter| match scene.get(parameter.key) {
            None => "none".to_owned(),
            Some(value) => {
                let value = value.as_number().map_or(value, |number| Value::Number(rounded(number, DIGITS)));
                format!("{value} {}", scene.unit(parameter)).trim_end().to_owned()
            }
        };
        let change = |parameter: &'static Parameter| {
            format!("{} = {}, was {}", parameter.key, shown(self, parameter), shown(original, parameter))
        };
        let changes = self.changed(original).flat_map(|parameter| match parameter.kind {
            ParameterKind::Rows { .. } | ParameterKind::Records { .. } => {
                let cells = self.changed_cells(original, parameter);
                let few = (1..=MOST_CELLS).contains(&cells.len());
                if few {
                    cells.into_iter().map(change).collect::<Vec<_>>()
                } else {
                    vec![format!("another {}", parameter.key)]
                }
            }
            _ => vec![change(parameter)],
        });
        let changes = changes.collect::<Vec<_>>().join("; ");
        let title = self.title(original);
        if !changes.is_empty() && self.about == original.about {
            self.about = format!("{} with {changes}.", original.name);
        }
        self.name = title;
    }

    /// Its name above a figure. If [`Scene::retitle`] gave the title and the description, and the changes are few enough to be read, they
    /// are named in place of their number: `Fundamental case, minimum spacing H_m 300 nm`.
    pub fn headline(&self) -> String {
        self.headline_over(&[])
    }

    /// [`Scene::headline`] of a figure that varies these keys: it does not say what they, or the keys that they replace, were changed to.
    pub fn headline_over(&self, varied: &[&Parameter]) -> String {
        let changes = || {
            let (head, _) = self.name.rsplit_once(": ")?;
            let original = head.strip_suffix(" again").or_else(|| head.strip_suffix(", changed"))?;
            let changes = self.about.strip_prefix(original)?.strip_prefix(" with ")?.strip_suffix('.')?.split("; ");
            let key = |change: &str| match change.strip_prefix("another ") {
                Some(key) => Parameter::find(key),
                None => Parameter::find(change.split_once(" = ")?.0),
            };
            let quantity = |parameter: &Parameter| parameter.instead_of.unwrap_or(parameter.key);
            let unvaried = |change: &&str| {
                key(change).is_none_or(|key| !varied.iter().any(|axis| quantity(axis) == quantity(key)))
            };
            let changes: Vec<&str> = changes.filter(unvaried).collect();
            if changes.is_empty() {
                return Some(original.to_owned());
            }
            let named = |change: &&str| {
                let (_, value) = change.split_once(", was ")?.0.split_once(" = ")?;
                Some(format!("{} {value}", key(change)?.words()))
            };
            let named = changes.iter().map(named).collect::<Option<Vec<_>>>();
            let title = named.map(|named| format!("{original}, {}", named.join(", ")));
            // Longer names are cut.
            let title = title.filter(|title| show_text(title) == *title);
            Some(title.unwrap_or_else(|| format!("{head}: {}", counted(changes.len(), "key", "keys"))))
        };
        changes().unwrap_or_else(|| self.name.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Kind, PARAMETERS, presets};

    fn table() -> Scene {
        let mut scene = Scene::motor();
        scene.set("rotor.compliance", "[[100, 1e-9]]").unwrap();
        scene
    }

    /// Values that a key takes, other than its default.
    fn others(parameter: &'static Parameter) -> Vec<Value> {
        let all = match parameter.kind {
            ParameterKind::Number { range, .. } => vec![Value::Number(range.min), Value::Number(range.max)],
            ParameterKind::Whole { min, max, .. } => vec![Value::Whole(min.into()), Value::Whole(max.into())],
            ParameterKind::Flag { .. } => vec![Value::Flag(false), Value::Flag(true)],
            ParameterKind::Choice { options, .. } => options.iter().map(|name| Value::Text((*name).into())).collect(),
            ParameterKind::Text { .. } => vec![Value::Text("other".into())],
            ParameterKind::Rows { columns } => {
                let first = if columns[0].key == "x_mm" { 0.0 } else { 7.0 };
                vec![Value::Rows(vec![(first, 1e-9), (8.0, 1e-10)])]
            }
            ParameterKind::Records { columns, .. } => {
                let lowest = |column: &Parameter| match column.range() {
                    Some(range) => Value::Number(range.min),
                    None => column.default().unwrap(),
                };
                vec![Value::Records(vec![columns.iter().map(lowest).collect()])]
            }
            ParameterKind::CsvPath { .. } => Vec::new(),
        };
        all.into_iter().filter(|value| parameter.default().as_ref() != Some(value)).collect()
    }

    #[test]
    fn every_value_of_every_key_reaches_the_problem() {
        let helium = Scene::plate().with([("film.gas", "helium"), ("film.slip", "fukui-kaneko")]).unwrap();
        for base in [Scene::motor(), table(), Scene::plate(), helium] {
            let keys = base.parameters().filter(|parameter| base.heeds(parameter.key) && parameter.key != "about");
            for parameter in keys {
                let mut problems = vec![base.unchecked().unwrap()];
                for value in
                    others(parameter).into_iter().filter(|value| base.get(parameter.key).as_ref() != Some(value))
                {
                    let mut scene = base.clone();
                    scene.set_value(parameter.key, value.clone()).unwrap();
                    assert_eq!(scene.get(parameter.key), Some(value), "{}", parameter.key);
                    // The rules between keys are not checked here.
                    let problem = scene.unchecked().unwrap();
                    assert!(!problems.contains(&problem), "{}", parameter.key);
                    problems.push(problem);
                    scene.unset(parameter.key).unwrap();
                    let same = base.get(parameter.key) != parameter.default() || scene == base;
                    assert!(same, "{}", parameter.key);
                }
            }
        }
    }

    #[test]
    fn numerics_are_the_keys_of_their_table() {
        for kind in Kind::ALL {
            let mut scene = Scene::new(kind);
            for parameter in PARAMETERS.iter().filter(|parameter| parameter.table() == "numerics") {
                scene.assign(parameter, others(parameter).swap_remove(0)).unwrap();
            }
            let mut copy = Scene::new(kind);
            copy.set_numerics(&scene.numerics()).unwrap();
            assert_eq!(copy, scene);
            copy.set_numerics(&Default::default()).unwrap();
            assert_eq!(copy, Scene::new(kind));
            let wrong = crate::problem::Numerics { steps_per_cycle: Some(3), ..scene.numerics() };
            assert_eq!(
                scene.set_numerics(&wrong).unwrap_err().faults()[0].what.key(),
                Some("numerics.steps_per_cycle")
            );
        }
    }

    #[test]
    fn defaults_of_a_new_model_are_no_changes() {
        let (original, mut scene) = (Scene::motor(), Scene::motor());
        scene.set_all([("film.gas", "helium"), ("film.slip", "fukui-kaneko")]).unwrap();
        assert_eq!(scene.changed(&original).map(|p| p.key).collect::<Vec<_>>(), ["film.gas", "film.slip"]);
        scene.set("film.temperature_c", "30").unwrap();
        assert_eq!(scene.changed(&original).count(), 3);
    }

    #[test]
    fn a_description_tells_every_edge_that_moves() {
        let original = presets::find("ring-rotor").unwrap();
        let about = |key: &str, text: &str| {
            let mut scene = original.with([(key, text)]).unwrap();
            scene.retitle(&original);
            scene.about
        };
        assert_eq!(
            about("rotor.part.flange.r_inner_mm", "26.5"),
            "Ring rotor with rotor.part.flange.r_inner_mm = 26.5 mm, was 26.9 mm; rotor.part.body.r_outer_mm = 26.5 mm, was 26.9 mm."
        );
        let web = "[{name = \"web\", r_inner_mm = 28, r_outer_mm = 30, z_bottom_mm = 0, z_top_mm = 1.5, material = \"brass\"}]";
        assert_eq!(about("rotor.part", web), "Ring rotor with another rotor.part.");
    }

    #[test]
    fn a_new_model_brings_its_defaults() {
        let mut scene = table();
        scene.set("rotor.model", "beam").unwrap();
        assert_eq!(scene, Scene::motor());
        scene.set("rotor.decay_length_mm", "3").unwrap();
        scene.set("rotor.model", "table").unwrap();
        assert!(scene.check().unwrap_err().to_string().contains("needs rotor.compliance_csv"));
        scene.set("rotor.model", "beam").unwrap();
        assert_eq!(scene, Scene::motor());
    }
}
