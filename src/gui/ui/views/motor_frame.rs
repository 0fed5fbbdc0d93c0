//! A motor at one instant: what its views draw.

use super::scales::FirstRun;
use crate::fidelity::Fidelity;
use crate::gui::derived::scales::Scales;
use crate::problem::{Motor, Scenario};
use crate::recording::Recording;
use crate::recording::sample::Lines;

/// A motor at one instant.
pub(super) struct MotorFrame<'a> {
    /// Number of the run, and its fidelity.
    pub(super) run: (u64, Fidelity),
    pub(super) recording: &'a Recording,
    pub(super) motor: &'a Motor,
    pub(super) scales: &'a Scales,
    /// The instant, in frames.
    pub(super) place: f64,
    /// Whole cycles that went before.
    pub(super) cycles: f64,
    /// The lines at that instant.
    pub(super) lines: Lines,
    /// The rotor's underside, as in [`Lines::underside`].
    pub(super) underside: Vec<[f64; 2]>,
    pub(super) tooth: usize,
    pub(super) cursor: Option<f64>,
    pub(super) first: Option<FirstMotor<'a>>,
}

/// The motor that it is compared with, at the same phase of its own cycle.
pub(super) struct FirstMotor<'a> {
    pub(super) recording: &'a Recording,
    pub(super) motor: &'a Motor,
    pub(super) lines: Lines,
    pub(super) scales: &'a Scales,
}

impl<'a> FirstMotor<'a> {
    /// Of a run that is a motor's.
    pub(super) fn of(first: &'a FirstRun<'a>) -> Option<Self> {
        let Scenario::Motor(motor) = first.scenario else { return None };
        let lines = Lines::at(first.recording, first.place);
        Some(Self { recording: first.recording, motor, lines, scales: &first.scales })
    }
}

impl MotorFrame<'_> {
    pub(super) fn x_range(&self) -> [f64; 2] {
        let half = 0.5 * self.recording.pitch;
        [-half, self.recording.length - half]
    }

    /// Phase of the instant.
    pub(super) fn phase(&self) -> f64 {
        self.place / self.recording.frames.max(1) as f64
    }

    /// The ends of the followed tooth \[m\].
    pub(super) fn followed(&self) -> [f64; 2] {
        let middle = self.tooth as f64 * self.recording.pitch;
        let reach = self.recording.x.last().copied().unwrap_or(0.0);
        [middle - reach, middle + reach]
    }
}
