//! Data of a whole cycle for the views, computed once per run: fixed ranges of the axes, and curves over the cycle.

use crate::analysis::compare::ComparedRun;
use crate::problem::Scenario;
use crate::recording::Recording;

/// A curve, uniformly sampled over one cycle.
#[derive(Debug, Default)]
pub struct SampledCurve {
    values: Vec<f64>,
    /// Whether the curve is not periodic; the last value then holds to the end of the cycle.
    once: bool,
}

impl SampledCurve {
    /// A curve of one value for each frame of `recording`.
    fn new(recording: &Recording, values: impl Iterator<Item = f64>) -> Self {
        Self { values: values.collect(), once: recording.transient }
    }

    /// The value at a phase; for a periodic curve the phase may be any number of cycles away.
    pub fn at(&self, phase: f64) -> f64 {
        let count = self.values.len();
        if count == 0 {
            return 0.0;
        }
        let place = if self.once { phase.clamp(0.0, 1.0) } else { phase.rem_euclid(1.0) } * count as f64;
        let left = (place as usize).min(count - 1);
        let weight = place - left as f64;
        let right = if self.once { (left + 1).min(count - 1) } else { (left + 1) % count };
        self.values[left] + weight * (self.values[right] - self.values[left])
    }

    /// Least and greatest value.
    pub fn range(&self) -> [f64; 2] {
        span(self.values.iter().copied())
    }
}

/// Curves of one tooth over the cycle.
#[derive(Debug, Default)]
pub struct ToothCurves {
    /// Least film thickness on the tooth \[m\].
    pub thickness: SampledCurve,
    /// Film's net gauge load \[N\].
    pub film: SampledCurve,
    /// Contact load \[N\].
    pub contact: SampledCurve,
}

/// Ranges of the axes over a whole cycle, or over several.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ranges {
    /// Absolute pressure in the map \[Pa\].
    pub pressure: [f64; 2],
    /// Stator's displacement \[m\].
    pub stator: [f64; 2],
    /// Stator plus film thickness \[m\].
    pub rotor: [f64; 2],
    /// Line loads \[N/m\], film and contact, zero included.
    pub loads: [f64; 2],
    /// Film thickness \[m\].
    pub thickness: [f64; 2],
    /// Film load of a tooth and contact load of a tooth \[N\], zero included.
    pub tooth_load: [f64; 2],
}

impl Ranges {
    /// The ranges that cover both cycles.
    pub fn and(self, other: Self) -> Self {
        let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self {
            pressure: both(self.pressure, other.pressure),
            stator: both(self.stator, other.stator),
            rotor: both(self.rotor, other.rotor),
            loads: both(self.loads, other.loads),
            thickness: both(self.thickness, other.thickness),
            tooth_load: both(self.tooth_load, other.tooth_load),
        }
    }
}

/// Ranges and curves of a whole cycle.
#[derive(Debug, Default)]
pub struct Scales {
    /// Ranges of the axes.
    pub ranges: Ranges,
    /// For each stored tooth.
    teeth: Vec<ToothCurves>,
    lag: f64,
}

impl Scales {
    /// Reads the whole recording once.
    pub fn new(recording: &Recording) -> Self {
        let (nodes, frames) = (recording.x.len().max(1), recording.frames);
        let lines = (recording.film.len() / nodes).min(recording.stored_teeth * frames);
        let load = |line: usize, field: &[f64]| -> f64 {
            field[line * nodes..(line + 1) * nodes].iter().zip(&recording.node_length).map(|(f, l)| f * l).sum()
        };
        let mut teeth: Vec<ToothCurves> = Vec::with_capacity(recording.stored_teeth);
        for first in (0..lines).step_by(frames.max(1)) {
            let all = first..(first + frames).min(lines);
            let least =
                |line: usize| span(recording.film_thickness[line * nodes..(line + 1) * nodes].iter().copied())[0];
            teeth.push(ToothCurves {
                thickness: SampledCurve::new(recording, all.clone().map(least)),
                film: SampledCurve::new(recording, all.clone().map(|line| load(line, &recording.film))),
                contact: SampledCurve::new(recording, all.map(|line| load(line, &recording.contact))),
            });
        }
        let loads = span(recording.film.iter().chain(&recording.contact).copied().chain([0.0]));
        let curves = teeth.iter().flat_map(|tooth| tooth.film.values.iter().chain(&tooth.contact.values));
        Self {
            ranges: Ranges {
                pressure: span(recording.pressure.iter().chain(&recording.other_pressure).copied()),
                stator: span(recording.stator.iter().copied()),
                rotor: span(recording.stator.iter().zip(&recording.film_thickness).map(|(w, h)| w + h)),
                loads,
                thickness: span(recording.film_thickness.iter().copied()),
                tooth_load: span(curves.copied().chain([0.0])),
            },
            lag: if recording.stored_teeth == recording.teeth { 0.0 } else { 1.0 / recording.teeth.max(1) as f64 },
            teeth,
        }
    }

    /// The curves of a tooth, and their phase lead in cycles. `None` without a recording.
    pub fn tooth(&self, tooth: usize) -> Option<(&ToothCurves, f64)> {
        if self.lag > 0.0 {
            return Some((self.teeth.first()?, self.lag * tooth as f64));
        }
        Some((self.teeth.get(tooth)?, 0.0))
    }
}

/// Scales and curves of one of several runs over its whole cycle.
#[derive(Debug, Default)]
pub struct RunCurves {
    /// Ranges, and the curves of each tooth.
    pub scales: Scales,
    /// Film load \[N\]; for a plate, film load over its area \[Pa\].
    pub film: SampledCurve,
    /// Contact load \[N\].
    pub contact: SampledCurve,
    /// Least and greatest line loads of contact and film \[N/m\].
    pub lines: [[f64; 2]; 2],
}

impl RunCurves {
    /// Reads the whole recording once.
    pub fn new(run: &ComparedRun) -> Self {
        let Ok(solution) = &run.solved else { return Self::default() };
        let recording = &solution.recording;
        let area = match &run.problem.scenario {
            Scenario::Motor(_) => 1.0,
            Scenario::Plate(plate) => plate.area(),
        };
        Self {
            scales: Scales::new(recording),
            film: SampledCurve::new(recording, recording.film_load.iter().map(|load| load / area)),
            contact: SampledCurve::new(recording, recording.contact_load.iter().copied()),
            lines: [&recording.contact, &recording.film].map(|field| span(field.iter().copied())),
        }
    }
}

/// Least and greatest of the finite values; 0 to 0 for none.
pub fn span(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = values
        .filter(|value| value.is_finite())
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    if low <= high { [low, high] } else { [0.0, 0.0] }
}

/// The range, extended at both ends by this share of its length.
pub fn with_margin([low, high]: [f64; 2], share: f64) -> [f64; 2] {
    let margin = share * (high - low);
    [low - margin, high + margin]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::LineLoads;

    fn recording(stored_teeth: usize) -> Recording {
        let (teeth, frames) = (3, 6);
        let line = |tooth: usize, frame: usize| ((frame + 2 * tooth) % frames) as f64;
        let film = (0..stored_teeth).flat_map(|t| (0..frames).flat_map(move |m| [line(t, m); 2])).collect::<Vec<_>>();
        let stator = vec![0.0; film.len()];
        let lines = LineLoads {
            frames,
            teeth,
            stored_teeth,
            x: vec![-1.0, 1.0],
            node_length: vec![1.0, 1.0],
            contact: vec![0.0; film.len()],
            film_thickness: film.clone(),
            film,
            ..LineLoads::default()
        };
        Recording { lines, stator, ..Recording::default() }
    }

    #[test]
    fn lag_symmetry_gives_what_every_tooth_stored_gives() {
        let (one, all) = (Scales::new(&recording(1)), Scales::new(&recording(3)));
        for tooth in 0..3 {
            let ((a, ahead_a), (b, ahead_b)) = (one.tooth(tooth).unwrap(), all.tooth(tooth).unwrap());
            for frame in 0..6 {
                let phase = f64::from(frame) / 6.0;
                assert!((a.film.at(phase + ahead_a) - b.film.at(phase + ahead_b)).abs() < 1e-9);
                let expected = f64::from((frame + 2 * tooth as i32) % 6);
                assert!((b.film.at(phase) - 2.0 * expected).abs() < 1e-9);
            }
        }
        assert_eq!(one.ranges, all.ranges);
    }

    #[test]
    fn cycles_of_a_transient_have_axes_in_common_and_do_not_run_back() {
        let (small, mut large) = (recording(3), recording(3));
        large.film.iter_mut().for_each(|film| *film = 2.0 * *film - 1.0);
        let [of_small, of_large] = [&small, &large].map(|recording| Scales::new(recording).ranges);
        let both = of_small.and(of_large);
        assert_eq!(both.loads, [-1.0, 9.0]);
        assert_eq!(both, both.and(of_small));
        let once = Scales::new(&Recording { transient: true, ..small });
        let (curves, _) = once.tooth(0).unwrap();
        assert_eq!([5.0 / 6.0, 0.99, 1.0].map(|phase| curves.film.at(phase)), [10.0; 3]);
    }

    #[test]
    fn an_empty_recording_has_ranges_too() {
        let scales = Scales::new(&Recording::default());
        assert_eq!(scales.ranges, Ranges::default());
        assert!(scales.tooth(0).is_none());
        assert!(SampledCurve::default().at(0.3).abs() < 1e-12);
    }
}
