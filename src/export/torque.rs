//! Torque, power and efficiency as the `merit` object of `solve --json`, and its curves as CSV. Speeds in rpm, for the
//! whole ring.

use super::csv::{Cell, Table};
use super::estimates;
use crate::analysis::torque::TorqueCurves;
use crate::estimate::Estimate;
use crate::solution::{Performance, Point};
use serde::ser::{Serialize, SerializeMap, Serializer};
use std::io::{self, Write};

/// The object: with and without the film, the friction coefficient that a model without film needs for the same maximum operating
/// torque, the mean power spent on squeezing the film, a bound of its viscous drag (signed), the greatest speed of the stator's surface,
/// and a bound of what the film's answer to another rotor speed changes, relative to the torque. What is not known is null.
pub(super) struct Merit<'a>(pub(super) &'a TorqueCurves);

impl Serialize for Merit<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(curves) = self;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("with_film", &Side(curves, &curves.with_film))?;
        map.serialize_entry("without_film", &Side(curves, &curves.without_film))?;
        estimates::add(&mut map, "dry_equivalent_friction", "", Some(curves.dry_equivalent))?;
        estimates::add(&mut map, "film_power", "_w", Some(curves.film_power))?;
        map.serialize_entry("viscous_drag_nm", &curves.viscous_drag)?;
        map.serialize_entry("surface_speed_rpm", &curves.rpm(curves.stator_speed))?;
        map.serialize_entry("speed_effect", &curves.speed_effect)?;
        map.end()
    }
}

/// Torque, power and efficiency with the film, or without.
struct Side<'a>(&'a TorqueCurves, &'a Performance);

impl Serialize for Side<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(curves, found) = self;
        let rpm = |speed: Estimate| speed * curves.rpm(1.0);
        let mut map = serializer.serialize_map(None)?;
        for (name, unit, estimate) in [
            ("stall_torque", "_nm", Some(found.stall_torque)),
            ("max_torque", "_nm", Some(found.max_torque)),
            ("no_load_speed", "_rpm", found.no_load_speed.map(rpm)),
            ("max_power", "_w", Some(found.max_power)),
            ("max_power_speed", "_rpm", found.max_power_speed.map(rpm)),
            ("max_efficiency", "", found.max_efficiency),
            ("max_efficiency_speed", "_rpm", found.max_efficiency_speed.map(rpm)),
        ] {
            estimates::add(&mut map, name, unit, estimate)?;
        }
        map.serialize_entry("present", &Present(curves, &found.present))?;
        map.end()
    }
}

/// At the rotor speed of the scene: power given to the rotor, heat of friction, and the output over what the stator gives, null where
/// the rotor is not driven.
struct Present<'a>(&'a TorqueCurves, &'a Point);

impl Serialize for Present<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(curves, point) = self;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("speed_rpm", &curves.rpm(point.speed))?;
        estimates::add(&mut map, "torque", "_nm", Some(point.torque))?;
        estimates::add(&mut map, "output", "_w", Some(point.output))?;
        estimates::add(&mut map, "friction", "_w", Some(point.friction))?;
        estimates::add(&mut map, "efficiency", "", point.efficiency)?;
        map.end()
    }
}

/// Writes both curves, one row for each speed. Where a value is not known, or the rotor is not driven, a field is empty.
pub fn write_csv(curves: &TorqueCurves, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new(out);
    let columns = [("torque", "_nm"), ("output", "_w"), ("friction", "_w"), ("efficiency", "")];
    let mut header = vec!["speed_rpm".to_owned()];
    for side in ["", "dry_"] {
        header
            .extend(columns.iter().flat_map(|(name, unit)| ["", "_error"].map(|of| format!("{side}{name}{of}{unit}"))));
    }
    table.header(&header)?;
    for (wet, dry) in curves.with_film.curve.iter().zip(&curves.without_film.curve) {
        let mut row = vec![cell(curves.rpm(wet.speed))];
        for point in [wet, dry] {
            let numbers = [Some(point.torque), Some(point.output), Some(point.friction), point.efficiency];
            let unknown = Estimate { value: f64::NAN, error: f64::NAN };
            let numbers = numbers.map(|number| number.unwrap_or(unknown));
            row.extend(numbers.iter().flat_map(|number| [number.value, number.error]).map(cell));
        }
        table.row(row)?;
    }
    table.finish()
}

/// Empty if it is not known.
fn cell(value: f64) -> Cell {
    if value.is_finite() { Cell::Number(value) } else { Cell::Nothing }
}
