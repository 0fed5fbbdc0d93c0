//! Torque, power and efficiency as the `merit` object of `solve --json`, and its curves as CSV. Speeds in rotations a
//! minute, for the whole ring.

use crate::analysis::torque::TorqueCurves;
use crate::estimate::Estimate;
use crate::solution::{Performance, Point};
use serde::Serialize;
use std::io::{self, Write};

/// The object. Numbers that are not known are null.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TorqueObject {
    /// With the film.
    pub with_film: PerformanceObject,
    /// The same motor in a vacuum.
    pub without_film: PerformanceObject,
    /// The friction coefficient that a model without film needs for the same maximum operating torque.
    pub dry_equivalent_friction: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub dry_equivalent_friction_error: Option<f64>,
    /// Mean power spent on squeezing the film.
    pub film_power_w: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub film_power_error_w: Option<f64>,
    /// Bound of the film's own viscous drag, signed.
    pub viscous_drag_nm: Option<f64>,
    /// The greatest speed of the stator's surface, as a rotation of the rotor.
    pub surface_speed_rpm: Option<f64>,
    /// Bound of what the film's answer to another rotor speed changes, relative to the torque.
    pub speed_effect: Option<f64>,
}

/// Torque, power and efficiency with the film, or without.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PerformanceObject {
    /// Torque at rest, and its error.
    pub stall_torque_nm: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub stall_torque_error_nm: Option<f64>,
    /// The paper's maximum operating torque, a bound: all of the contact pulls one way.
    pub max_torque_nm: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub max_torque_error_nm: Option<f64>,
    /// Speed at which the torque vanishes.
    pub no_load_speed_rpm: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub no_load_speed_error_rpm: Option<f64>,
    /// Greatest power given to the rotor.
    pub max_power_w: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub max_power_error_w: Option<f64>,
    /// Its speed.
    pub max_power_speed_rpm: Option<f64>,
    /// Error of that speed, absolute.
    pub max_power_speed_error_rpm: Option<f64>,
    /// Greatest efficiency.
    pub max_efficiency: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub max_efficiency_error: Option<f64>,
    /// Its speed.
    pub max_efficiency_speed_rpm: Option<f64>,
    /// Error of that speed, absolute.
    pub max_efficiency_speed_error_rpm: Option<f64>,
    /// At the rotor speed of the scene.
    pub present: PointObject,
}

/// One speed.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PointObject {
    /// The rotor's speed.
    pub speed_rpm: Option<f64>,
    /// Torque on the rotor.
    pub torque_nm: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub torque_error_nm: Option<f64>,
    /// Power given to the rotor.
    pub output_w: Option<f64>,
    /// Heat of friction.
    pub friction_w: Option<f64>,
    /// Output over what the stator gives; null where the rotor is not driven.
    pub efficiency: Option<f64>,
}

impl TorqueObject {
    /// Of what was found.
    pub fn new(curves: &TorqueCurves) -> Self {
        Self {
            with_film: PerformanceObject::new(curves, &curves.with_film),
            without_film: PerformanceObject::new(curves, &curves.without_film),
            dry_equivalent_friction: finite(curves.dry_equivalent.value),
            dry_equivalent_friction_error: finite(curves.dry_equivalent.error),
            film_power_w: finite(curves.film_power.value),
            film_power_error_w: finite(curves.film_power.error),
            viscous_drag_nm: finite(curves.viscous_drag),
            surface_speed_rpm: finite(curves.rpm(curves.surface_speed)),
            speed_effect: finite(curves.speed_effect),
        }
    }
}

impl PerformanceObject {
    fn new(curves: &TorqueCurves, found: &Performance) -> Self {
        let rpm = |speed: Estimate| Estimate { value: curves.rpm(speed.value), error: curves.rpm(speed.error) };
        let [stall_torque_nm, stall_torque_error_nm] = pair(Some(found.stall_torque));
        let [max_torque_nm, max_torque_error_nm] = pair(Some(found.max_torque));
        let [no_load_speed_rpm, no_load_speed_error_rpm] = pair(found.no_load_speed.map(rpm));
        let [max_power_w, max_power_error_w] = pair(Some(found.max_power));
        let [max_power_speed_rpm, max_power_speed_error_rpm] = pair(found.max_power_speed.map(rpm));
        let [max_efficiency, max_efficiency_error] = pair(found.max_efficiency);
        let [max_efficiency_speed_rpm, max_efficiency_speed_error_rpm] = pair(found.max_efficiency_speed.map(rpm));
        Self {
            stall_torque_nm,
            stall_torque_error_nm,
            max_torque_nm,
            max_torque_error_nm,
            no_load_speed_rpm,
            no_load_speed_error_rpm,
            max_power_w,
            max_power_error_w,
            max_power_speed_rpm,
            max_power_speed_error_rpm,
            max_efficiency,
            max_efficiency_error,
            max_efficiency_speed_rpm,
            max_efficiency_speed_error_rpm,
            present: PointObject::new(curves, &found.present),
        }
    }
}

impl PointObject {
    fn new(curves: &TorqueCurves, point: &Point) -> Self {
        Self {
            speed_rpm: finite(curves.rpm(point.speed)),
            torque_nm: finite(point.torque.value),
            torque_error_nm: finite(point.torque.error),
            output_w: finite(point.output),
            friction_w: finite(point.friction),
            efficiency: point.efficiency.and_then(finite),
        }
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn pair(estimate: Option<Estimate>) -> [Option<f64>; 2] {
    estimate.map_or([None, None], |found| [finite(found.value), finite(found.error)])
}

/// Writes both curves, one row for each speed. Where a value is not known, or the rotor is not driven, a field is empty.
///
/// # Errors
/// Those of the writer.
pub fn write_csv(curves: &TorqueCurves, out: &mut dyn Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let columns = ["torque_nm", "torque_error_nm", "output_w", "friction_w", "efficiency"];
    let mut header = vec!["speed_rpm".to_owned()];
    for side in ["", "dry_"] {
        header.extend(columns.iter().map(|column| format!("{side}{column}")));
    }
    table.write_record(&header)?;
    for (wet, dry) in curves.with_film.curve.iter().zip(&curves.without_film.curve) {
        let mut row = vec![text(Some(curves.rpm(wet.speed)))];
        for point in [wet, dry] {
            let numbers = [point.torque.value, point.torque.error, point.output, point.friction].map(Some);
            row.extend(numbers.into_iter().chain([point.efficiency]).map(text));
        }
        table.write_record(&row)?;
    }
    table.flush()
}

/// Nine digits; empty if it is not known.
fn text(value: Option<f64>) -> String {
    match value {
        Some(0.0) => "0".to_owned(),
        Some(value) if value.is_finite() => format!("{value:.8e}"),
        _ => String::new(),
    }
}
