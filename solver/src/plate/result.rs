//! The numbers of a plate's cycle, from its fields.

use crate::estimate::Estimate;
use crate::problem::Plate;
use crate::recording::{LineLoads, Recording};
use crate::solution::PlateResult;
use std::f64::consts::TAU;

impl PlateResult {
    /// Cycle mean and extremes of a recording; no error of the mean is known.
    pub fn of(recording: &Recording) -> Self {
        type Series = fn(&LineLoads) -> Vec<f64>;
        let extreme = |series: Series, found: &[f64], errors: &[f64], greater: fn(f64, f64) -> f64| {
            let Estimate { value, error } = recording.extreme(series, found, errors, greater, f64::INFINITY);
            Estimate { value, error: error + between_frames(found, greater) }
        };
        let (loads, errors) = (&recording.film_load, &recording.film_load_error);
        let load = |greater| extreme(LineLoads::film_loads, loads, errors, greater);
        let (pressures, errors) = (&recording.max_pressure, &recording.max_pressure_error);
        Self {
            film_load: Estimate::exact(loads.iter().sum::<f64>() / recording.frames as f64),
            film_load_min: load(f64::min),
            film_load_max: load(f64::max),
            min_film_thickness: Estimate::exact(
                recording.min_film_thickness.iter().copied().fold(f64::INFINITY, f64::min),
            ),
            max_pressure: extreme(LineLoads::max_pressures, pressures, errors, f64::max),
            ..Self::default()
        }
    }

    /// Load over ambient pressure × area.
    pub fn ratio(load: f64, plate: &Plate) -> f64 {
        load / (plate.gas.ambient_pressure * plate.area())
    }
}

/// Least and greatest load, greatest pressure, and the first harmonic of the load.
pub(super) fn numbers(loads: &[f64], pressures: &[f64]) -> [f64; 5] {
    let most = |series: &[f64]| series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let [spring, damping] = first_harmonic(loads);
    [loads.iter().copied().fold(f64::INFINITY, f64::min), most(loads), most(pressures), spring, damping]
}

/// Parts of `load`, one value a frame, in phase with −cos τ and with sin τ, in the same unit.
pub(super) fn first_harmonic(load: &[f64]) -> [f64; 2] {
    let count = load.len().max(1) as f64;
    let (mut spring, mut damping) = (0.0, 0.0);
    for (frame, load) in load.iter().enumerate() {
        let (sin, cos) = (TAU * frame as f64 / count).sin_cos();
        spring -= 2.0 / count * cos * load;
        damping += 2.0 / count * sin * load;
    }
    [spring, damping]
}

/// Adds to the errors of [`numbers`].
pub(super) fn add_errors(result: &mut PlateResult, more: [f64; 5]) {
    let [spring, damping] = &mut result.harmonic_error;
    let (load_min, load_max) = (&mut result.film_load_min.error, &mut result.film_load_max.error);
    for (error, more) in [load_min, load_max, &mut result.max_pressure.error, spring, damping].into_iter().zip(more) {
        *error += more;
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extreme_between_two_frames_is_that_of_a_parabola() {
        // 5 − 2 (m − 3.25)², the greatest of whose frames is 4.875; about the first and the last frame as anywhere else.
        let parabola = |top: f64| -> Vec<f64> { (0..7).map(|m| 5.0 - 2.0 * (f64::from(m) - top).powi(2)).collect() };
        let mut series = parabola(3.25);
        assert!((between_frames(&series, f64::max) - 0.125).abs() < 1e-15);
        series.rotate_left(3);
        assert!((between_frames(&series, f64::max) - 0.125).abs() < 1e-15);
        let upside_down: Vec<f64> = series.iter().map(|value| -value).collect();
        assert!((between_frames(&upside_down, f64::min) - 0.125).abs() < 1e-15);
        assert_eq!(between_frames(&[2.0; 5], f64::max), 0.0);
    }
}
