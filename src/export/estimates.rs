//! Numbers and estimates in JSON objects.

use crate::analysis::quantity::{Numbers, Quantity};
use crate::estimate::Estimate;
use serde::ser::SerializeMap;

/// Adds an estimate to an object under two names, as `power_w` and `power_error_w`: its value, and its estimated numerical error,
/// absolute. What is not known is null.
pub(super) fn add<M: SerializeMap>(
    map: &mut M,
    name: &str,
    unit: &str,
    found: Option<Estimate>,
) -> Result<(), M::Error> {
    let Estimate { value, error } = found.unwrap_or(Estimate { value: f64::NAN, error: f64::NAN });
    map.serialize_entry(&format!("{name}{unit}"), &value)?;
    map.serialize_entry(&format!("{name}_error{unit}"), &error)
}

/// Adds numbers of a solve under their names, counts as whole numbers. What is not known is null.
pub(super) fn add_numbers<M: SerializeMap>(
    map: &mut M,
    quantities: impl IntoIterator<Item = Quantity>,
    numbers: &Numbers,
) -> Result<(), M::Error> {
    for quantity in quantities {
        let value = numbers.get(quantity);
        if quantity.is_count() {
            map.serialize_entry(quantity.name(), &value.map(|count| count as u64))?;
        } else {
            map.serialize_entry(quantity.name(), &value)?;
        }
    }
    Ok(())
}

/// A number that is one; what is not is null in JSON and empty in CSV.
pub(super) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
