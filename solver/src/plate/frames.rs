//! The frames of a plate's recording among the steps of its cycle.

use crate::problem::Plate;

/// The frames of a recording, uniform in time, among the steps of a cycle, which cluster about its middle.
#[derive(Debug)]
pub(super) struct Frames {
    /// Gap of each frame \[m\].
    pub(super) gap: Vec<f64>,
    /// The step before each frame, and the fraction of the way to the next; empty if each step is a frame.
    places: Vec<(usize, f64)>,
    steps: usize,
}

impl Frames {
    pub(super) fn new(plate: &Plate, beta: f64, steps: usize, per_step: usize) -> Self {
        let frames = steps * per_step;
        let gap = (0..frames).map(|frame| plate.gap(frame as f64 / frames as f64)).collect();
        Self { gap, places: if beta == 0.0 { Vec::new() } else { places(frames, steps, beta) }, steps }
    }

    pub(super) fn len(&self) -> usize {
        self.gap.len()
    }

    /// Interpolates `value(step, k)` > 0, known at the steps, to a frame: cubic in the step number.
    pub(super) fn mix(&self, frame: usize, out: &mut [f64], value: impl Fn(usize, usize) -> f64) {
        let Some((step, t)) = self.places.get(frame).copied() else {
            out.iter_mut().enumerate().for_each(|(k, out)| *out = value(frame, k));
            return;
        };
        let at = |ahead: usize| (step + self.steps + ahead - 1) % self.steps;
        let (before, behind) = (t + 1.0, t - 1.0);
        let weights = [
            -t * behind * (t - 2.0) / 6.0,
            before * behind * (t - 2.0) / 2.0,
            -before * t * (t - 2.0) / 2.0,
            before * t * behind / 6.0,
        ];
        for (k, out) in out.iter_mut().enumerate() {
            let near = [0, 1, 2, 3].map(|ahead| value(at(ahead), k));
            let cubic = near.iter().zip(weights).map(|(value, weight)| value * weight).sum::<f64>();
            *out = cubic.clamp(0.5 * near[1].min(near[2]), 2.0 * near[1].max(near[2]));
        }
    }
}

/// The step before each of `frames`, and the fraction of the way to the next.
fn places(frames: usize, steps: usize, beta: f64) -> Vec<(usize, f64)> {
    let place = |frame: usize| {
        let share = 2.0 * frame as f64 / frames as f64 - 1.0;
        let place = 0.5 * (1.0 + (share * beta.sinh()).asinh() / beta) * steps as f64;
        let step = (place as usize).min(steps - 1);
        (step, place - step as f64)
    };
    (0..frames).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::grading::map;
    use std::f64::consts::TAU;

    #[test]
    fn a_frame_has_what_a_smooth_cycle_has_between_its_steps() {
        let (count, steps, beta) = (256, 96, 2.5);
        let frames = Frames { gap: Vec::new(), places: places(count, steps, beta), steps };
        let cycle = |time: f64| 2.0 + (TAU * (time + 0.1)).cos();
        // When the step is, as a share of the cycle: `FilmCycle` and `places` stretch it alike.
        let time = |step: usize| 0.5 * (1.0 + map(-beta, 2.0 * step as f64 / steps as f64 - 1.0));
        let mut out = [0.0];
        for frame in 0..count {
            frames.mix(frame, &mut out, |step, _| cycle(time(step)));
            let exact = cycle(frame as f64 / count as f64);
            assert!((out[0] - exact).abs() < 5e-4, "{frame}: {} {exact}", out[0]);
        }
    }
}
