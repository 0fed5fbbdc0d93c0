//! Estimates in JSON objects.

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
