//! What a lesson reads off the tabs: of a plate in the hand, of a start-up, of torque over speed, of a plate beside its exact results.

use super::hold::HoldState;
use super::startup::{Point, StartupState};
use super::torque::TorqueState;
use crate::analysis::exact;
use crate::job::SolvedScene;
use crate::lessons::live::{Live, Readings};
use crate::problem::{Plate, Scenario};
use crate::solution::{Outcome, PlateResult};
use std::sync::Arc;

/// A held plate this near to its mean gap has not been moved, relative.
const AT_REST: f64 = 0.01;

/// What the window shows, to be read by a check.
#[derive(Clone, Copy, Debug)]
pub struct OnScreen<'a> {
    /// The run on screen.
    pub run: Option<&'a Arc<SolvedScene>>,
    /// Torque over speed.
    pub torque: &'a TorqueState,
    /// The start-up.
    pub startup: Option<&'a StartupState>,
    /// The plate in the hand.
    pub hold: Option<&'a HoldState>,
}

/// Numbers that are read off the tabs.
#[derive(Clone, Copy, Debug, Default)]
pub struct OffTabs {
    /// What was read off when the step began.
    pub start: Readings,
    /// What is read off now.
    pub now: Readings,
    /// Whether the held plate was at rest since the step was set up: what was done with it before does not count.
    rested: bool,
}

impl OffTabs {
    /// Reads off the tabs what they show of `run`; of a start-up and of a held plate also what they began with.
    pub fn read(&mut self, run: &SolvedScene, seen: OnScreen<'_>) {
        self.now = Readings::default();
        let live = &mut self.now;
        if let Some(hold) = seen.hold.filter(|hold| !hold.stale(&run.scene)) {
            let (plate, now) = (hold.plate(), hold.now().reading);
            self.rested |= (now.gap / plate.mean_gap - 1.0).abs() < AT_REST;
            let rest = (plate.mean_gap, plate.gas.ambient_pressure);
            let present = if self.rested { (now.gap, now.mean_pressure) } else { rest };
            for (readings, (gap, pressure)) in [(&mut self.start, rest), (&mut *live, present)] {
                readings.set(Live::HeldGap, gap * 1e6);
                readings.set(Live::HeldPressure, pressure * 1e-3);
            }
        }
        if let Some(startup) = seen.startup.filter(|startup| !startup.stale(&run.scene)) {
            let points = startup.points();
            for (readings, point) in [(&mut self.start, points.first()), (&mut *live, points.last())] {
                point.into_iter().for_each(|point| read_cycle(readings, point, &run.problem.scenario));
            }
        }
        match (&run.problem.scenario, seen.torque.of(run)) {
            (Scenario::Plate(plate), _) => read_exact(live, run, plate),
            (Scenario::Motor(_), Some(merit)) => {
                let (with, without) = (&merit.with_film, &merit.without_film);
                live.set(Live::Stall, with.stall_torque.value);
                live.set(Live::PresentTorque, with.present.torque.value);
                live.set(Live::DryStall, without.stall_torque.value);
                live.set(Live::Output, with.max_power.value);
                live.set(Live::DryOutput, without.max_power.value);
                if let Some(speed) = with.no_load_speed {
                    live.set(Live::NoLoad, merit.rpm(speed.value));
                }
            }
            (Scenario::Motor(_), None) => {}
        }
    }
}

fn read_cycle(readings: &mut Readings, point: &Point, scenario: &Scenario) {
    readings.set(Live::Cycles, point.number as f64);
    readings.set(Live::Remaining, point.remaining);
    match (point.outcome, scenario) {
        (Outcome::Motor(result), _) => readings.set(Live::StartAlpha, result.alpha),
        (Outcome::Plate(result), Scenario::Plate(plate)) => {
            readings.set(Live::StartLoadRatio, PlateResult::ratio(result.film_load, plate));
        }
        _ => {}
    }
}

fn read_exact(readings: &mut Readings, run: &SolvedScene, plate: &Plate) {
    if let Some(found) = exact::solved(plate, &run.solution.recording) {
        readings.set(Live::Spring, found.spring.value);
        readings.set(Live::Damping, found.damping.value);
    }
}
