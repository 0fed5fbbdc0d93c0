//! The numbers of a plate's cycle, from its fields.

use crate::problem::Plate;
use crate::recording::{LineLoads, Recording};
use crate::solution::PlateResult;

impl PlateResult {
    /// Cycle mean and extremes of a recording; no error of the mean is known.
    pub fn of(recording: &Recording) -> Self {
        let [least, most, highest] = extremes(&recording.film_load, &recording.max_pressure);
        let error =
            |series: fn(&LineLoads) -> Vec<f64>, found: &[f64], errors: &[f64], greater: fn(f64, f64) -> f64| {
                recording.extreme_error(series, found, errors, greater) + between_frames(found, greater)
            };
        let (loads, errors) = (&recording.film_load, &recording.film_load_error);
        let load_error = |greater| error(LineLoads::film_loads, loads, errors, greater);
        let (pressures, errors) = (&recording.max_pressure, &recording.max_pressure_error);
        Self {
            film_load: loads.iter().sum::<f64>() / recording.frames as f64,
            film_load_error: 0.0,
            film_load_min: least,
            film_load_max: most,
            min_gap: recording.min_film_thickness.iter().copied().fold(f64::INFINITY, f64::min),
            max_pressure: highest,
            film_load_range_error: [f64::min, f64::max].map(load_error),
            max_pressure_error: error(LineLoads::max_pressures, pressures, errors, f64::max),
            floating: None,
        }
    }

    /// Load over ambient pressure × area.
    pub fn ratio(load: f64, plate: &Plate) -> f64 {
        load / (plate.gas.ambient_pressure * plate.area())
    }
}

/// Least and greatest load, and greatest pressure.
pub(super) fn extremes(loads: &[f64], pressures: &[f64]) -> [f64; 3] {
    let most = |series: &[f64]| series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [loads.iter().copied().fold(f64::INFINITY, f64::min), most(loads), most(pressures)]
}

/// By how much the extreme of a cycle exceeds that of its frames: the parabola through the three about it.
fn between_frames(series: &[f64], greater: fn(f64, f64) -> f64) -> f64 {
    let frames = series.len();
    let extreme = series.iter().copied().reduce(greater);
    let Some(top) = series.iter().position(|value| Some(*value) == extreme) else { return 0.0 };
    let (before, behind) = (series[(top + frames - 1) % frames], series[(top + 1) % frames]);
    let bend = 2.0 * series[top] - before - behind;
    if bend == 0.0 { 0.0 } else { ((before - behind).powi(2) / (8.0 * bend)).abs() }
}
