//! Film, contact and rotor together: the periodic steady state of a motor.
//!
//! Unknown is the trapped gas ζ on every tooth at every step of the cycle. Given ζ, one contact problem an instant gives
//! the film thickness h (`contact`: the film is a spring of trapped gas, so that stiff films and a floating rotor are
//! ordinary cases). Given h, one cycle of the film gives a new ζ, shifted towards the periodic state by the slow shift of
//! `film::cycle`. Anderson acceleration of ln ζ drives both to the common periodic state at once.
//!
//! In the steady state tooth k at time t is tooth 0 at t + kT/n_t, because the wave travels towards −x and the rotor looks
//! the same everywhere. One tooth, and the contact problems of the first T/n_t, then stand for all. Solving every tooth
//! gives the same (tested).

mod dry;
mod level;

pub use dry::without_film;

use crate::contact::ContactError;
use crate::control::{Cancel, Observer, Reporter};
use crate::estimate::extrapolate;
use crate::film::cycle::Interrupted;
use crate::film::stepper::FilmError;
use crate::plan::Plan;
use crate::problem::Motor;
use crate::recording::Recording;
use crate::solution::{MotorResult, Stats, Status};
use level::Level;

/// Why a motor could not be solved. No input is known to lead here.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MotorError {
    /// A film step failed.
    #[error("film, step {step} of the cycle: {source}")]
    Film {
        /// Which step.
        step: usize,
        /// Why.
        source: FilmError,
    },
    /// A contact problem failed.
    #[error("contact, instant {instant} of the cycle: {source}")]
    Contact {
        /// Which instant.
        instant: usize,
        /// Why.
        source: ContactError,
    },
}

/// Rounds that a start from another motor's state is given.
const WARM_ROUNDS: usize = 12;
/// Rounds after which a coarse grid is left for the next one.
const COARSE_ROUNDS: usize = 120;

/// Interrupted or failed: what ends a round early.
enum Stop {
    Cancelled,
    Failed(MotorError),
}

impl From<Interrupted> for Stop {
    fn from(interrupted: Interrupted) -> Self {
        match interrupted {
            Interrupted::Cancelled => Self::Cancelled,
            Interrupted::Failed { step, source } => Self::Failed(MotorError::Film { step, source }),
        }
    }
}

/// A motor's periodic state: the numbers, how they were reached, and the fields.
#[derive(Clone, Debug)]
pub struct Periodic {
    /// How the finest grid ended.
    pub status: Status,
    /// The numbers, with the error estimate.
    pub result: MotorResult,
    /// α of each grid, coarse to fine.
    pub alphas: Vec<f64>,
    /// What it cost, all grids.
    pub stats: Stats,
    /// Fields of one cycle on the finest grid.
    pub recording: Recording,
}

/// The states that the last solve ended with, one of each grid: where the solve of a similar motor starts.
///
/// A start changes how many rounds a solve takes, and its result by no more than the stated error.
#[derive(Default)]
pub struct Warm {
    levels: Vec<Level>,
}

impl std::fmt::Debug for Warm {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Warm").field("grids", &self.levels.len()).finish()
    }
}

/// Solves for the periodic state on each of the plan's grids, each started from the one before.
///
/// # Errors
/// [`MotorError`] if a film step or a contact problem has no solution to working precision.
pub fn periodic(
    motor: &Motor,
    plan: &Plan,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Periodic, MotorError> {
    periodic_from(&mut Warm::default(), motor, plan, observer, cancel)
}

/// As [`periodic`], each grid started from that of the last solve where `warm` holds one, and left there for the next.
///
/// # Errors
/// As [`periodic`].
pub fn periodic_from(
    warm: &mut Warm,
    motor: &Motor,
    plan: &Plan,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Periodic, MotorError> {
    let mut stats = Stats::default();
    let mut alphas = Vec::new();
    let mut levels: Vec<Level> = Vec::new();
    let mut status = Status::Cancelled;
    for (number, grid) in plan.grids.iter().enumerate() {
        let mut report = Reporter::new(&mut *observer, number, plan.grids.len(), plan.tolerance);
        let finest = number + 1 == plan.grids.len();
        let rounds = if finest { plan.round_limit } else { plan.round_limit.min(COARSE_ROUNDS) };
        // A motor too far from the last one is soon known, and started anew.
        if let Some(similar) = warm.levels.get(number).filter(|last| last.serves(motor, plan)) {
            let mut level = Level::new(motor, plan, grid);
            level.start_from(similar);
            let tried = level.converge(plan, WARM_ROUNDS, &mut stats, &mut report, cancel);
            match tried {
                Ok(Status::Converged) => {
                    status = Status::Converged;
                    alphas.push(level.alpha(motor));
                    levels.push(level);
                    continue;
                }
                Err(Stop::Cancelled) => {
                    status = Status::Cancelled;
                    alphas.push(level.alpha(motor));
                    levels.push(level);
                    break;
                }
                Ok(_) | Err(Stop::Failed(_)) => {}
            }
        }
        let mut level = Level::new(motor, plan, grid);
        match levels.last() {
            // A coarse grid without a periodic state says nothing about the next one.
            Some(coarse) if status == Status::Converged => level.start_from(coarse),
            _ => {
                alphas.clear();
                level.start(motor);
            }
        }
        status = match level.converge(plan, rounds, &mut stats, &mut report, cancel) {
            Ok(status) => status,
            Err(Stop::Cancelled) => Status::Cancelled,
            Err(Stop::Failed(error)) => return Err(error),
        };
        alphas.push(level.alpha(motor));
        levels.push(level);
        if status == Status::Cancelled {
            break;
        }
    }
    let found = finish(motor, plan, &levels, status, alphas, stats);
    if status == Status::Converged {
        warm.levels = levels;
    }
    Ok(found)
}

/// A motor from rest, cycle after cycle ([`crate::startup`]), on all grids of a plan at once.
pub struct Transient<'a> {
    motor: &'a Motor,
    plan: Plan,
    levels: Vec<Level>,
    stats: Stats,
}

impl std::fmt::Debug for Transient<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Transient").field("cycles", &self.stats.cycles).finish()
    }
}

impl<'a> Transient<'a> {
    /// At rest, every tooth by itself.
    ///
    /// # Errors
    /// [`MotorError::Contact`] if the teeth at rest have no solution to working precision.
    pub fn at_rest(motor: &'a Motor, plan: &Plan) -> Result<Self, MotorError> {
        let plan = Plan { every_tooth: true, trapped: false, ..plan.clone() };
        let mut levels: Vec<Level> = plan.grids.iter().map(|grid| Level::new(motor, &plan, grid)).collect();
        for level in &mut levels {
            level.rest()?;
        }
        Ok(Self { motor, plan, levels, stats: Stats::default() })
    }

    /// The next cycle, from the present instant on: means and extremes, the fields of the finest grid, and the largest change
    /// of ln Z over it. `None` if cancelled.
    ///
    /// # Errors
    /// [`MotorError`] if a film step or a contact problem has no solution to working precision.
    pub fn cycle(&mut self, cancel: &Cancel) -> Result<Option<(MotorResult, Recording, f64)>, MotorError> {
        let tolerance = 0.1 * self.plan.tolerance;
        let finest = self.levels.len() - 1;
        let mut alphas = Vec::with_capacity(self.levels.len());
        let mut last = (Recording::default(), f64::INFINITY);
        for (number, level) in self.levels.iter_mut().enumerate() {
            let maps = self.plan.maps && number == finest;
            last = match level.transient_cycle(self.motor, maps, tolerance, &mut self.stats, cancel) {
                Ok(cycle) => cycle,
                Err(Stop::Cancelled) => return Ok(None),
                Err(Stop::Failed(error)) => return Err(error),
            };
            alphas.push(level.alpha(self.motor));
            self.stats.film_nodes = level.film_nodes();
            self.stats.contact_nodes = level.contact_nodes();
            self.stats.steps_per_cycle = level.steps();
        }
        self.stats.cycles += 1;
        let (recording, change) = last;
        let mut result = summarise(self.motor, &recording);
        let estimate = extrapolate(&alphas);
        result.set_alpha(self.motor, if result.levitated { 1.0 } else { estimate.value });
        let left_out = if result.levitated { 0.0 } else { self.plan.left_out * estimate.value.abs() };
        result.alpha_error = estimate.error.min(1.0) + left_out + tolerance;
        Ok(Some((result, recording, change)))
    }

    /// What it has cost so far, all grids.
    pub fn stats(&self) -> Stats {
        self.stats
    }
}

/// The numbers, their error and the fields, from the finest grid and what each grid gave, coarse to fine.
fn finish(
    motor: &Motor,
    plan: &Plan,
    levels: &[Level],
    status: Status,
    alphas: Vec<f64>,
    mut stats: Stats,
) -> Periodic {
    let Some((level, coarser)) = levels.split_last() else {
        return Periodic { status, result: MotorResult::default(), alphas, stats, recording: Recording::default() };
    };
    let mut recording = level.recording(motor, plan.maps);
    // Those that α is extrapolated from.
    let usable = (alphas.len() - 1).min(coarser.len());
    recording.coarser = coarser[coarser.len() - usable..].iter().map(|level| level.line_loads(motor)).collect();
    let mut result = summarise(motor, &recording);
    let estimate = extrapolate(&alphas);
    // What floats carries the whole load, by balance.
    let alpha = if result.levitated { 1.0 } else { estimate.value.min(alphas.iter().copied().fold(1.0, f64::max)) };
    result.set_alpha(motor, alpha);
    let astray = if let Status::NotConverged { residual, .. } = status { residual.min(1.0) } else { 0.0 };
    let estimated = if estimate.error.is_finite() { estimate.error } else { 1.0 };
    // The trapped gas still changes by the residual, and its force with it; film and contact disagree about their shares.
    // (Twice the latter: calibrated, docs/validation.md.) What floats carries its load whatever that is, and whatever was
    // left out; only the height changes.
    let (repeating, left_out) = if result.levitated {
        (0.0, 0.0)
    } else {
        (level.residual().min(1.0) * level.gas_force() / motor.load, plan.left_out * estimate.value.abs())
    };
    result.alpha_error = estimated + astray + 2.0 * level.mean_imbalance() + repeating + left_out;
    stats.film_nodes = level.film_nodes();
    stats.contact_nodes = level.contact_nodes();
    stats.steps_per_cycle = level.steps();
    Periodic { status, result, alphas, stats, recording }
}

/// Cycle means and extremes of a recording.
pub fn summarise(motor: &Motor, recording: &Recording) -> MotorResult {
    let mean = |series: &[f64]| series.iter().sum::<f64>() / series.len() as f64;
    let least = |series: &[f64]| series.iter().copied().fold(f64::INFINITY, f64::min);
    let most = |series: &[f64]| series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut result = MotorResult {
        film_load_min: least(&recording.film_load),
        film_load_max: most(&recording.film_load),
        teeth_in_contact: recording.teeth_in_contact.iter().sum::<usize>() as f64 / recording.frames as f64,
        levitated: recording.teeth_in_contact.iter().all(|&teeth| teeth == 0),
        min_gap: least(&recording.min_film_thickness),
        max_pressure: most(&recording.max_pressure),
        ..MotorResult::default()
    };
    result.set_alpha(motor, mean(&recording.film_load) / motor.load);
    result
}

impl MotorResult {
    /// Sets α and what follows from it: the loads, which share L, and the torque of the ring.
    pub fn set_alpha(&mut self, motor: &Motor, alpha: f64) {
        self.alpha = alpha;
        self.film_load = alpha * motor.load;
        self.contact_load = (1.0 - alpha) * motor.load;
        let dry = motor.dry_friction * f64::from(motor.waves) * motor.load * motor.contact_radius;
        self.max_torque = dry * (1.0 - alpha).max(0.0);
    }
}
