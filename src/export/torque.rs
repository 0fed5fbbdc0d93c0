//! Torque, power and efficiency as the `merit` object of `solve --json`, and its curves as CSV. Speeds in rpm, for the
//! whole ring.

use super::csv::Table;
use super::estimates;
use crate::analysis::torque::TorqueCurves;
use crate::estimate::Estimate;
use crate::solution::{OperatingPoint, Performance};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The object: with and without the film, the friction coefficient that a model without film needs for the same maximum operating torque,
/// the mean power needed to squeeze the film, a bound of its viscous drag (signed), the greatest speed of the stator's surface, and a bound
/// of the relative change of the torque because the film changes with the rotor speed. Unknown values are null.
pub(super) fn merit(curves: &TorqueCurves) -> Value {
    let [with, without] = [&curves.with_film, &curves.without_film].map(|found| side(curves, found));
    let mut object = json!({ "with_film": with, "without_film": without });
    estimates::add(&mut object, "dry_equivalent_friction", "", Some(curves.dry_equivalent));
    estimates::add(&mut object, "film_power", "_w", Some(curves.film_power));
    object["viscous_drag_nm"] = curves.viscous_drag.into();
    object["surface_speed_rpm"] = curves.rpm(curves.stator_speed).into();
    object["speed_effect"] = curves.speed_effect.into();
    object
}

/// Torque, power and efficiency with the film, or without.
fn side(curves: &TorqueCurves, found: &Performance) -> Value {
    let rpm = |speed: Estimate| speed * curves.rpm(1.0);
    let mut object = json!({});
    for (name, unit, estimate) in [
        ("stall_torque", "_nm", Some(found.stall_torque)),
        ("max_torque", "_nm", Some(found.max_torque)),
        ("no_load_speed", "_rpm", found.no_load_speed.map(rpm)),
        ("max_power", "_w", Some(found.max_power)),
        ("max_power_speed", "_rpm", found.max_power_speed.map(rpm)),
        ("max_efficiency", "", found.max_efficiency),
        ("max_efficiency_speed", "_rpm", found.max_efficiency_speed.map(rpm)),
    ] {
        estimates::add(&mut object, name, unit, estimate);
    }
    object["present"] = present(curves, &found.present);
    object
}

/// At the rotor speed of the scene: power given to the rotor, friction heat, and the ratio of the output to the power from the stator,
/// which is null if the rotor is not driven.
fn present(curves: &TorqueCurves, point: &OperatingPoint) -> Value {
    let mut object = json!({ "speed_rpm": curves.rpm(point.speed) });
    estimates::add(&mut object, "torque", "_nm", Some(point.torque));
    estimates::add(&mut object, "output", "_w", Some(point.output));
    estimates::add(&mut object, "friction", "_w", Some(point.friction));
    estimates::add(&mut object, "efficiency", "", point.efficiency);
    object
}

/// Writes both curves, one row for each speed. A field is empty if its value is not known, or if the rotor is not driven.
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
        let mut row = vec![curves.rpm(wet.speed)];
        for point in [wet, dry] {
            let numbers = [Some(point.torque), Some(point.output), Some(point.friction), point.efficiency];
            let unknown = Estimate { value: f64::NAN, error: f64::NAN };
            let numbers = numbers.map(|number| number.unwrap_or(unknown));
            row.extend(numbers.iter().flat_map(|number| [number.value, number.error]));
        }
        table.row(row)?;
    }
    table.finish()
}
