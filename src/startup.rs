//! Start-up: the transient from rest, cycle after cycle, until the cycle repeats.
//!
//! At t = 0 the wave stands still at its full amplitude, pressed against the rotor, and the gas is at ambient pressure; then it
//! travels. Every tooth is marched and nothing is accelerated, because the way is the result. (A plate likewise, from the gap of
//! t = 0.) It ends where the periodic solve starts: `tests/startup.rs` compares the two.

use crate::control::Cancel;
use crate::fidelity::Fidelity;
use crate::memory::{self, Taken};
use crate::motor;
use crate::plan::Plan;
use crate::plate;
use crate::problem::{Numerics, Problem, Scenario, Time};
use crate::recording::Recording;
use crate::solution::{Outcome, Stats, Status};
use crate::solve::SolveError;

/// One cycle of the transient.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// From 1.
    pub number: usize,
    /// Means and extremes over this cycle, with the error that its grids show.
    pub outcome: Outcome,
    /// Largest change of ln Z from its beginning to its end.
    pub change: f64,
    /// By how much ln Z may still change until the cycle repeats, if changes go on to shrink as they did; infinite at first.
    pub remaining: f64,
    /// Fields; the first frame is the beginning of the cycle.
    pub recording: Recording,
}

/// How a start-up is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Grids and steps: those of this fidelity.
    pub fidelity: Fidelity,
    /// Cycles at most.
    pub cycles: usize,
    /// What [`Cycle::remaining`] has to fall below.
    pub tolerance: f64,
    /// Cycles that whoever they are handed to keeps at a time, for the memory that they take.
    pub kept: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { fidelity: Fidelity::Standard, cycles: 300, tolerance: 1e-3, kept: 1 }
    }
}

/// How a start-up ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Startup {
    /// Converged: the cycle repeats, and film and contact agreed in every step on the way.
    pub status: Status,
    /// Cycles completed.
    pub cycles: usize,
    /// Of the last cycle; zeros if there is none.
    pub outcome: Outcome,
    /// Of the last cycle.
    pub remaining: f64,
    /// What it cost.
    pub stats: Stats,
}

/// Starts `problem` from rest and hands over each cycle as it is completed.
///
/// # Errors
/// [`SolveError`] if a step has no solution to working precision, or it would need more memory than is allowed.
pub fn startup(
    problem: &Problem,
    settings: &Settings,
    each: &mut dyn FnMut(Cycle),
    cancel: &Cancel,
) -> Result<Startup, SolveError> {
    let mut ended = Startup {
        status: Status::NotConverged { residual: f64::INFINITY, tolerance: settings.tolerance },
        cycles: 0,
        outcome: match problem.scenario {
            Scenario::Motor(_) => Outcome::Motor(Default::default()),
            Scenario::Plate(_) => Outcome::Plate(Default::default()),
        },
        remaining: f64::INFINITY,
        stats: Stats::default(),
    };
    let (mut transient, _taken) = Transient::at_rest(problem, settings, cancel)?;
    let mut last = f64::INFINITY;
    for number in 1..=settings.cycles {
        let Some((outcome, recording, change)) = transient.cycle(cancel)? else {
            ended.status = Status::Cancelled;
            return Ok(ended);
        };
        // The change of the next cycles, as a geometric series; a sudden fall is not trusted to go on.
        let ratio = (change / last).max(0.5);
        let remaining = if change == 0.0 {
            0.0
        } else if last.is_finite() && ratio < 1.0 {
            change * ratio / (1.0 - ratio)
        } else {
            f64::INFINITY
        };
        let recording = Recording { transient: true, ..recording };
        last = change;
        ended = Startup {
            status: transient
                .unsettled()
                .unwrap_or(Status::NotConverged { residual: remaining, tolerance: settings.tolerance }),
            cycles: number,
            outcome,
            remaining,
            stats: transient.stats(),
        };
        each(Cycle { number, outcome, change, remaining, recording });
        if remaining < settings.tolerance {
            ended.status = transient.unsettled().unwrap_or(Status::Converged);
            break;
        }
    }
    Ok(ended)
}

/// Either scene on its way.
enum Transient<'a> {
    Motor(Box<motor::Transient<'a>>),
    Plate(Box<plate::Transient>),
}

impl<'a> Transient<'a> {
    /// With the memory that it takes.
    fn at_rest(
        problem: &'a Problem,
        settings: &Settings,
        cancel: &Cancel,
    ) -> Result<(Self, Taken<'static>), SolveError> {
        // A transient leaks: there is no limit to take.
        let numerics = Numerics { time: Time::March, ..problem.numerics };
        Ok(match &problem.scenario {
            Scenario::Motor(motor) => {
                let plan = Plan::motor(motor, settings.fidelity, &numerics);
                let taken = memory::take(memory::motor_startup(motor, &plan, settings.kept), cancel)?;
                (Self::Motor(Box::new(motor::Transient::at_rest(motor, &plan)?)), taken)
            }
            Scenario::Plate(plate) => {
                let plan = Plan::plate(plate, settings.fidelity, &numerics);
                let taken = memory::take(memory::plate_startup(plate, &plan, settings.kept), cancel)?;
                (Self::Plate(Box::new(plate::Transient::at_rest(plate, &plan))), taken)
            }
        })
    }

    fn cycle(&mut self, cancel: &Cancel) -> Result<Option<(Outcome, Recording, f64)>, SolveError> {
        Ok(match self {
            Self::Motor(transient) => {
                transient.cycle(cancel)?.map(|(result, recording, change)| (Outcome::Motor(result), recording, change))
            }
            Self::Plate(transient) => transient
                .cycle(cancel)
                .map_err(SolveError::Plate)?
                .map(|(result, recording, change)| (Outcome::Plate(result), recording, change)),
        })
    }

    /// If steps on the way did not settle; a plate has nothing to agree with.
    fn unsettled(&self) -> Option<Status> {
        match self {
            Self::Motor(transient) => transient.unsettled(),
            Self::Plate(_) => None,
        }
    }

    fn stats(&self) -> Stats {
        match self {
            Self::Motor(transient) => transient.stats(),
            Self::Plate(transient) => transient.stats(),
        }
    }
}
