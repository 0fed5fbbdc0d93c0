//! A solved plate beside what is known exactly: the curves that its tab draws, computed once for a run.

use super::format::load_unit;
use super::scales::span;
use crate::analysis::exact::{Comparison, Harmonic, crossover, linear};
use crate::job::SolvedScene;
use crate::problem::{Outline, Plate};
use crate::solution::{Outcome, PlateResult};

/// Points of a curve over the squeeze number.
const SAMPLES: usize = 81;
/// Decades to either side of the crossover, and beyond the present point.
const AROUND: f64 = 2.5;
const BEYOND: f64 = 0.6;
/// A limit whose range is at most this many times that of the load is shown whole.
const WHOLE: f64 = 2.0;
/// A run beside exact results.
#[derive(Debug)]
pub struct ExactCurves {
    /// Spring, damping, limits and the invariant, computed and exact.
    pub comparison: Comparison,
    /// Range of the squeeze number: log₁₀ σ/Q from, to.
    pub window: [f64; 2],
    /// Load over the cycle, as (t/T, load) in the unit.
    pub load: Vec<[f64; 2]>,
    /// The same of gas that has no time to leave.
    pub boyle: Vec<[f64; 2]>,
    /// The same of an incompressible film.
    pub viscous: Vec<[f64; 2]>,
    /// Unit of the load.
    pub unit: &'static str,
    /// Range of the axis of the load, in the unit.
    pub bounds: [f64; 2],
}

impl ExactCurves {
    /// Reads the recording of `run`, a solved `plate`.
    pub fn new(run: &SolvedScene, plate: &Plate) -> Self {
        let recording = &run.solution.recording;
        let result = match run.solution.outcome {
            Outcome::Plate(result) => result,
            Outcome::Motor(_) => PlateResult::default(),
        };
        let comparison = Comparison::of(plate, &result, recording);
        let window = window(comparison.effective_squeeze_number, plate.outline());
        let frames = recording.frames.max(1);
        let greatest = recording.film_load.iter().fold(0.0f64, |most, load| most.max(load.abs()));
        let (unit, size) = load_unit(greatest, plate.is_strip());
        let over = |series: &[f64]| -> Vec<[f64; 2]> {
            let count = series.len();
            (0..=count).filter(|_| count > 0).map(|m| [m as f64 / frames as f64, series[m % count] / size]).collect()
        };
        let range = |series: &[[f64; 2]]| span(series.iter().map(|[_, y]| *y).chain([0.0]));
        let load = over(&recording.film_load);
        let (boyle, viscous) = (over(&comparison.limits.boyle), over(&comparison.limits.viscous));
        let mut bounds = range(&load);
        let most = WHOLE * (bounds[1] - bounds[0]);
        for limit in [&boyle, &viscous] {
            let [low, high] = range(limit);
            if high - low <= most {
                bounds = [bounds[0].min(low), bounds[1].max(high)];
            }
        }
        let margin = 0.08 * (bounds[1] - bounds[0]).max(f64::MIN_POSITIVE);
        Self { comparison, window, load, boyle, viscous, unit, bounds: [bounds[0] - margin, bounds[1] + margin] }
    }
}

/// Decades of σ/Q that are shown: around the crossover of spring and damping, and the present.
fn window(present: f64, outline: Outline) -> [f64; 2] {
    let crossover = crossover(outline).log10();
    let present = if present > 0.0 { present.log10() } else { crossover };
    [(crossover - AROUND).min(present - BEYOND), (crossover + AROUND).max(present + BEYOND)]
}

/// Spring and damping of a film of small amplitude over log₁₀ σ/Q, as (log₁₀ σ/Q, S) and (log₁₀ σ/Q, D).
pub fn small_amplitude(outline: Outline, window: [f64; 2]) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let at = |i: usize| {
        let x = window[0] + (window[1] - window[0]) * i as f64 / (SAMPLES - 1) as f64;
        let Harmonic { spring, damping } = linear(10f64.powf(x), outline);
        ([x, spring], [x, damping])
    };
    (0..SAMPLES).map(at).unzip()
}
