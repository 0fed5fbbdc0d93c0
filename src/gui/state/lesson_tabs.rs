//! Numbers that a lesson reads off the tabs: a held plate, a start-up, torque over speed, a plate beside its exact results.

use super::followed::TorqueState;
use super::hold::HoldState;
use super::startup::StartupState;
use crate::job::SolvedScene;
use crate::lessons::live::{Live, Readings};
use crate::problem::Scenario;
use std::sync::Arc;

/// Relative distance from the mean gap below which a held plate has not been moved.
const AT_REST: f64 = 0.01;

/// The parts of the window that the check of a task reads.
#[derive(Clone, Copy, Debug)]
pub struct OnScreen<'a> {
    /// The run on screen.
    pub run: Option<&'a Arc<SolvedScene>>,
    /// Torque over speed.
    pub torque: &'a TorqueState,
    /// The start-up.
    pub startup: Option<&'a StartupState>,
    /// The held plate.
    pub hold: Option<&'a HoldState>,
}

/// Numbers that are read from the tabs.
#[derive(Clone, Copy, Debug, Default)]
pub struct OffTabs {
    /// Readings when the step began.
    pub start: Readings,
    /// Present readings.
    pub now: Readings,
    /// Whether the held plate was at rest since the step was set up: what was done with it before does not count.
    rested: bool,
}

impl OffTabs {
    /// Reads from the tabs what they show of `run`, and for a start-up and a held plate also the values at the beginning.
    pub fn read(&mut self, run: &SolvedScene, seen: OnScreen<'_>) {
        if let Some(hold) = seen.hold.filter(|hold| !hold.stale(&run.scene)) {
            let (plate, now) = (&hold.plate, hold.now.reading);
            self.rested |= (now.gap / plate.mean_gap - 1.0).abs() < AT_REST;
            let rest = (plate.mean_gap, plate.gas.ambient_pressure);
            self.start.read_held(rest.0, rest.1);
            if self.rested {
                self.now.read_held(now.gap, now.mean_pressure);
                // It may have been higher between two redraws.
                self.now.set(Live::HeldPeak, hold.highest_mean_pressure() * 1e-3);
            } else {
                self.now.read_held(rest.0, rest.1);
            }
        }
        if let Some(startup) = seen.startup.filter(|startup| !startup.transient.stale(&run.scene)) {
            let points = &startup.points;
            for (readings, point) in [(&mut self.start, points.first()), (&mut self.now, points.last())] {
                point.into_iter().for_each(|row| readings.read_cycle(row));
            }
        }
        match (&run.problem.scenario, seen.torque.of(run)) {
            (Scenario::Plate(plate), _) => self.now.read_exact(plate, &run.solution.recording),
            (Scenario::Motor(_), Some(curves)) => self.now.read_torque(curves),
            (Scenario::Motor(_), None) => {}
        }
    }
}
