//! Keys that name one value in an array of tables, so that the value can be set and varied like any other: `rotor.part.flange.r_outer_mm`,
//! or, with a number from 1 in place of the name, `rotor.support.1.z_top_mm`.
//!
//! The [`Parameter`] of such a key is made from those of the array and of the column. It is not among `PARAMETERS`, and a scene keeps its
//! value in the array.

use super::edges::{self, with_edge};
use super::error::FaultKind;
use super::keys::PARAMETERS;
use super::parameter::{Parameter, ParameterKind};
use super::value::Value;
use super::values::Scene;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The parts of such a key: the array, the name or number of one of its tables, and the index of the column.
type Named<'a> = (&'static Parameter, &'a str, usize);

/// The place of a value in a scene: the array, its tables, and the indices of the table and the column.
type Place = (&'static Parameter, Vec<Vec<Value>>, [usize; 2]);

/// Longest key that is read \[bytes\].
const LONGEST: usize = 100;

fn named(key: &str) -> Option<Named<'_>> {
    if key.len() > LONGEST || key.matches('.').count() < 3 {
        return None;
    }
    PARAMETERS.iter().find_map(|array| {
        let ParameterKind::Records { columns, .. } = array.kind else { return None };
        let (which, leaf) = key.strip_prefix(array.key)?.strip_prefix('.')?.rsplit_once('.')?;
        let of_value = |column: &Parameter| column.key == leaf && !matches!(column.kind, ParameterKind::Text { .. });
        Some((array, which, columns.iter().position(of_value)?))
    })
}

/// The parameters of such keys that were asked for. They are few, and are kept until the program ends.
static KNOWN: Mutex<BTreeMap<String, &'static Parameter>> = Mutex::new(BTreeMap::new());
/// Most parameters that are kept.
const MOST: usize = 10_000;

impl Parameter {
    /// The parameter of a dotted key, which may name one value of an array of tables.
    pub fn find(key: &str) -> Option<&'static Self> {
        PARAMETERS.iter().find(|parameter| parameter.key == key).or_else(|| find(key))
    }
}

/// The parameter of a key that names one value of an array.
fn find(key: &str) -> Option<&'static Parameter> {
    let (array, _, column) = named(key)?;
    let ParameterKind::Records { columns, .. } = array.kind else { return None };
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(found) = known.get(key) {
        return Some(found);
    }
    if known.len() == MOST {
        return None;
    }
    let parameter =
        Parameter { key: key.to_owned().leak(), belongs: array.belongs, when: array.when, ..columns[column] };
    let parameter: &'static Parameter = Box::leak(Box::new(parameter));
    known.insert(key.to_owned(), parameter);
    Some(parameter)
}

impl Scene {
    /// The place of the value that a key names in an array, a fault if there is no such table; `None` for any other key.
    fn cell(&self, key: &str) -> Option<Result<Place, FaultKind>> {
        let (array, which, column) = named(key)?;
        let Some(Value::Records(records)) = self.get(array.key) else { return Some(Err(self.unknown_key(key))) };
        let called = |record: &Vec<Value>| record.first().and_then(Value::as_text) == Some(which);
        let counted = || which.parse::<usize>().ok()?.checked_sub(1).filter(|number| *number < records.len());
        let place = records.iter().position(called).or_else(counted);
        Some(place.ok_or_else(|| self.unknown_key(key)).map(|row| (array, records, [row, column])))
    }

    /// The value that a key names in an array.
    pub(super) fn cell_value(&self, key: &str) -> Option<Value> {
        let (_, records, [row, column]) = self.cell(key)?.ok()?;
        records.get(row)?.get(column).cloned()
    }

    /// The array in which a key names a value, with `value` in that place; `None` for any other key. An edge that two parts share moves
    /// in both.
    pub(super) fn with_cell(&self, key: &str, value: &Value) -> Option<Result<(&'static Parameter, Value), FaultKind>> {
        let put = |(array, mut records, [row, column]): Place| {
            match (value.as_number(), array.kind) {
                (Some(to), ParameterKind::Records { columns, fewest: 1.., .. }) => {
                    let side = columns[..column].iter().filter(|column| column.range().is_some()).count();
                    records = with_edge(&records, (row, side), to);
                }
                _ => records[row][column] = value.clone(),
            }
            (array, Value::Records(records))
        };
        Some(self.cell(key)?.map(put))
    }

    /// The keys that name the values by which an array differs from that of `original`; empty if keys cannot name all differences,
    /// because the arrays have different tables.
    pub(super) fn changed_cells(&self, original: &Self, array: &Parameter) -> Vec<&'static Parameter> {
        let (Some(Value::Records(ours)), Some(Value::Records(theirs))) = (self.get(array.key), original.get(array.key))
        else {
            return Vec::new();
        };
        let keys = self.cell_keys();
        if keys != original.cell_keys() {
            return Vec::new();
        }
        let of_array = |key: &&String| key.strip_prefix(array.key).is_some_and(|rest| rest.starts_with('.'));
        let differs = |key: &&String| self.cell_value(key) != original.cell_value(key);
        let found: Vec<_> =
            keys.iter().filter(of_array).filter(differs).filter_map(|key| Parameter::find(key)).collect();
        let all = ours.iter().flatten().zip(theirs.iter().flatten()).filter(|(value, other)| value != other).count();
        if found.len() == all { found } else { Vec::new() }
    }

    /// All keys that name one value in an array of this scene.
    pub(super) fn cell_keys(&self) -> Vec<String> {
        let mut keys = Vec::new();
        for array in self.parameters() {
            let (ParameterKind::Records { columns, .. }, Some(Value::Records(records))) =
                (array.kind, self.get(array.key))
            else {
                continue;
            };
            for (row, record) in records.iter().enumerate() {
                let name = edges::name(record).map_or_else(|| (row + 1).to_string(), str::to_owned);
                let values = columns.iter().filter(|column| !matches!(column.kind, ParameterKind::Text { .. }));
                keys.extend(values.map(|column| format!("{}.{name}.{}", array.key, column.key)));
            }
        }
        keys
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_of_a_part_is_a_key() {
        let mut scene = Scene::motor();
        let (by_name, by_number) = ("rotor.part.flange.r_inner_mm", "rotor.part.3.r_inner_mm");
        assert_eq!(scene.get(by_name), None);
        let refused = scene.set(by_name, "26.5").unwrap_err().to_string();
        assert!(refused.contains("rotor.model") && refused.contains("ring"), "{refused}");
        scene.set_all([(by_name, "26.5"), ("rotor.model", "ring")]).unwrap();
        assert_eq!(
            [by_name, by_number].map(|key| scene.get(key)),
            [26.5, 26.5].map(|length| Some(Value::Number(length)))
        );
        // The edge of the body moves with it.
        assert_eq!(scene.get("rotor.part.body.r_outer_mm"), Some(Value::Number(26.5)));
        scene.set("rotor.part.body.material", "steel").unwrap();
        assert_eq!(scene.get("rotor.part.4.material"), Some(Value::Text("steel".into())));
        scene.check().unwrap();
        let refused = |key: &str, text: &str| scene.clone().set(key, text).unwrap_err().to_string();
        assert!(refused(by_name, "0.01").contains("rotor.part.flange.r_inner_mm = 0.01 is out of range: allowed 0.05"));
        assert!(refused("rotor.part.flang.r_inner_mm", "1").contains("did you mean rotor.part.flange.r_inner_mm?"));
        for key in ["rotor.part.0.r_inner_mm", "rotor.part.5.r_inner_mm", "rotor.part.rim.width_mm", "rotor.part.rim"] {
            assert!(refused(key, "1").contains(&format!("unknown key {key}")), "{key}");
        }
        // Removing it changes nothing, because a value in an array has no default.
        let before = scene.clone();
        scene.unset(by_name).unwrap();
        assert_eq!(scene, before);
    }
}
