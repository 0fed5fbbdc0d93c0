//! An edit of one parameter, and the edits that were rejected.

use crate::scene::{Parameter, Scene, Value, quantity_text};
use std::collections::BTreeMap;

/// A change of one parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// It is set to a value.
    Value(Value),
    /// It is set from typed text.
    Text(String),
    /// It is removed.
    Unset,
}

impl Change {
    /// `scene` with `key` changed.
    ///
    /// # Errors
    /// If the value is not allowed, by itself or in combination with the other keys.
    pub fn applied(&self, scene: &Scene, key: &str) -> Result<Scene, String> {
        let mut next = scene.clone();
        let number = Parameter::find(key).filter(|parameter| parameter.range().is_some());
        let set = match (self, number) {
            (Self::Value(value), _) => next.set_value(key, value.clone()),
            (Self::Text(text), Some(parameter)) if !matches!(text.trim(), "" | "none") => {
                next.set_value(key, Value::Number(quantity_text::read(parameter, text)?))
            }
            (Self::Text(text), _) => next.set(key, text),
            (Self::Unset, _) => next.unset(key),
        };
        set.and_then(|()| next.check()).map_err(|error| error.to_string())?;
        Ok(next)
    }
}

/// Rejected edits by key, with the reason: shown at the parameter until it is corrected, or until the reason no longer holds.
#[derive(Clone, Debug, Default)]
pub struct RejectedEdits(BTreeMap<&'static str, (Change, String)>);

impl RejectedEdits {
    /// Why the last edit of `key` was rejected.
    pub fn of(&self, key: &str) -> Option<&str> {
        self.0.get(key).map(|(_, message)| message.as_str())
    }

    /// Why `value` of `key` was rejected; `None` if another edit of it was, or none.
    pub fn of_value(&self, key: &str, value: &Value) -> Option<&str> {
        let (change, message) = self.0.get(key)?;
        matches!(change, Change::Value(rejected) if rejected == value).then_some(message.as_str())
    }

    /// Remembers a rejected change.
    pub fn reject(&mut self, key: &'static str, change: Change, message: String) {
        self.0.insert(key, (change, message));
    }

    /// Forgets the rejected edits of `key`, and of the keys that could be given in its place.
    pub fn accept(&mut self, key: &str) {
        let other_form =
            |other: &str| Parameter::find(key).is_some_and(|found| found.alternatives().any(|form| form.key == other));
        self.0.retain(|other, _| *other != key && !other_form(other));
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Checks the rejected edits again after a change of the scene: drops those that it would accept now, and updates the reasons of the
    /// others. An edit of an array is always dropped, because it was based on the previous scene.
    pub fn review(&mut self, scene: &Scene) {
        self.0.retain(|key, (change, message)| match change.applied(scene, key) {
            Ok(_) => false,
            Err(error) => {
                *message = error;
                !matches!(change, Change::Value(Value::Records(_)))
            }
        });
    }
}
