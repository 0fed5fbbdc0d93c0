//! Numbers and estimates in JSON objects.

use crate::analysis::quantity::{Numbers, Quantity};
use crate::estimate::Estimate;
use serde_json::Value;

/// Adds an estimate to an object under two names, such as `power_w` and `power_error_w`: its value, and its estimated absolute numerical
/// error. Unknown values are null.
pub(super) fn add(object: &mut Value, name: &str, unit: &str, found: Option<Estimate>) {
    object[format!("{name}{unit}")] = found.map(|found| found.value).into();
    object[format!("{name}_error{unit}")] = found.map(|found| found.error).into();
}

/// Numbers of a solve with their names, counts as whole numbers. Unknown values are null.
pub(super) fn named(
    quantities: impl IntoIterator<Item = Quantity>,
    numbers: &Numbers,
) -> impl Iterator<Item = (&'static str, Value)> {
    quantities.into_iter().map(|quantity| {
        let value = numbers.get(quantity);
        let value = if quantity.is_count() { value.map(|count| count as u64).into() } else { value.into() };
        (quantity.name(), value)
    })
}

/// A finite number; otherwise null in JSON and empty in CSV.
pub(super) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
