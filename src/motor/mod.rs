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
use crate::estimate::{Estimate, extrapolate};
use crate::film::cycle::Interrupted;
use crate::film::stepper::FilmError;
use crate::plan::{Grid, Plan};
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
/// Share of what the last polynomial across changed that is taken as the error of those left out (calibrated:
/// docs/validation.md), and the share of the accuracy asked for that it may have.
const WIDTH_SHARE: f64 = 0.15;
const WIDTH_AIM: f64 = 0.3;

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
    /// What the last polynomial across changed of α on the coarsest grid; 0 with finite volumes.
    pub across: f64,
    /// What it cost, all grids.
    pub stats: Stats,
    /// Fields of one cycle on the finest grid.
    pub recording: Recording,
}

/// The states that the last solve ended with: where the solve of a similar motor starts.
///
/// A start changes how many rounds a solve takes, and its result by no more than the stated error.
#[derive(Default)]
pub struct Warm {
    found: Option<Found>,
}

impl std::fmt::Debug for Warm {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Warm").field("grids", &self.found.as_ref().map_or(0, |found| found.levels.len())).finish()
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
    let last = warm.found.take();
    let found = Search { motor, plan, observer: &mut *observer, cancel, stats: &mut stats }.run(last.as_ref());
    let broken = match &found {
        Ok(found) => matches!(found.status, Status::NotConverged { .. }),
        Err(_) => true,
    };
    let (found, plan) = if broken && plan.spectral {
        // Polynomials across may swing below no pressure at all; finite volumes cannot.
        let volumes = plan.volumes();
        (Search { motor, plan: &volumes, observer, cancel, stats: &mut stats }.run(None)?, volumes)
    } else {
        (found?, plan.clone())
    };
    let result = finish(motor, &plan, &found, stats);
    if found.status == Status::Converged {
        warm.found = Some(found);
    }
    Ok(result)
}

/// What a solve went through: the grids that converged, coarse to fine, and how the last one ended.
struct Found {
    status: Status,
    levels: Vec<Level>,
    /// α on each.
    alphas: Vec<f64>,
    /// The coarsest grid with one polynomial less across, and by how much that changed α there; `None` with finite volumes.
    narrower: Option<(Level, f64)>,
}

/// One solve on a plan's grids, and on finer ones until the stated error is what was asked for.
struct Search<'a> {
    motor: &'a Motor,
    plan: &'a Plan,
    observer: &'a mut dyn Observer,
    cancel: &'a Cancel,
    stats: &'a mut Stats,
}

impl Search<'_> {
    fn run(&mut self, last: Option<&Found>) -> Result<Found, MotorError> {
        let (motor, plan) = (self.motor, self.plan);
        let last = last.filter(|last| last.levels.first().is_some_and(|level| level.serves(motor, plan)));
        let mut found =
            Found { status: Status::Converged, levels: Vec::new(), alphas: Vec::new(), narrower: None };
        let mut across = plan.grids.first().map_or(0, |grid| grid.across);
        if plan.spectral && plan.grids.len() > 1 {
            across = last.map_or(across, |last| last.levels[0].across());
            let Some(settled) = self.settle_across(across, last, &mut found)? else { return Ok(found) };
            across = settled;
        }
        let mut number = found.levels.len();
        let mut finest = plan.grids.last().copied();
        while let Some(mut grid) = plan.grids.get(number).copied().or(finest) {
            if plan.spectral {
                grid.across = across;
            }
            let enough = plan.grids.len().max(number + 1);
            let similar = last.and_then(|last| last.levels.get(number));
            let start = similar.or(found.levels.last());
            let (status, level) = self.level(&grid, start, similar.is_some(), number, enough)?;
            found.status = status;
            if status == Status::Converged || number + 1 >= plan.grids.len() {
                found.alphas.push(level.alpha(motor));
                found.levels.push(level);
            } else {
                // A coarse grid without a periodic state says nothing about the next one.
                found.alphas.clear();
                found.levels.clear();
            }
            number += 1;
            finest = Some(Grid { ..grid.finer(plan.spectral) });
            let more = number < plan.grids.len() || number < plan.most_grids && !precise_enough(motor, plan, &found);
            if status == Status::Cancelled || !more {
                break;
            }
        }
        Ok(found)
    }

    /// The coarsest grid with more and more polynomials across, until one less hardly matters; how many that are. `None` if
    /// cancelled, or if there is no periodic state.
    fn settle_across(
        &mut self,
        first: usize,
        last: Option<&Found>,
        found: &mut Found,
    ) -> Result<Option<usize>, MotorError> {
        let (motor, plan) = (self.motor, self.plan);
        let mut across = first.max(2);
        let coarsest = Grid { across: across - 1, ..plan.grids[0] };
        let start = last.and_then(|last| last.narrower.as_ref()).map(|(level, _)| level);
        let (mut status, mut narrower) = self.level(&coarsest, start, start.is_some(), 0, plan.grids.len())?;
        loop {
            if status != Status::Converged {
                break;
            }
            let grid = Grid { across, ..coarsest };
            let similar = last.map(|last| &last.levels[0]).filter(|level| level.across() == across);
            let level;
            (status, level) = self.level(&grid, similar.or(Some(&narrower)), similar.is_some(), 0, plan.grids.len())?;
            let (alpha, less) = (level.alpha(motor), narrower.alpha(motor));
            let change = (alpha - less).abs();
            found.status = status;
            found.alphas = vec![alpha];
            if status == Status::Converged
                && WIDTH_SHARE * change > WIDTH_AIM * plan.accuracy * unit(alpha)
                && across < plan.most_across
            {
                narrower = level;
                across += 1;
                continue;
            }
            found.levels = vec![level];
            found.narrower = Some((narrower, change));
            return Ok((status == Status::Converged).then_some(across));
        }
        found.status = status;
        found.alphas = vec![narrower.alpha(motor)];
        found.levels = vec![narrower];
        Ok(None)
    }

    /// Solves one grid, started from another's state: first within a few rounds, if that is another motor's.
    fn level(
        &mut self,
        grid: &Grid,
        start: Option<&Level>,
        similar: bool,
        number: usize,
        grids: usize,
    ) -> Result<(Status, Level), MotorError> {
        let (motor, plan) = (self.motor, self.plan);
        let limit = if number + 1 < plan.grids.len() { plan.round_limit.min(COARSE_ROUNDS) } else { plan.round_limit };
        let mut report = Reporter::new(&mut *self.observer, number, grids, plan.tolerance);
        let mut level = Level::new(motor, plan, grid);
        let mut rounds = limit;
        match start {
            Some(other) => level.start_from(other),
            None => level.start(motor),
        }
        if similar {
            rounds = WARM_ROUNDS;
        }
        loop {
            match level.converge(plan, rounds, self.stats, &mut report, self.cancel) {
                Err(Stop::Cancelled) => return Ok((Status::Cancelled, level)),
                // A motor too far from the last one is soon known, and started anew.
                Ok(Status::NotConverged { .. }) | Err(Stop::Failed(_)) if rounds < limit => {
                    level = Level::new(motor, plan, grid);
                    level.start(motor);
                    rounds = limit;
                }
                Ok(status) => return Ok((status, level)),
                Err(Stop::Failed(error)) => return Err(error),
            }
        }
    }
}

/// What an accuracy of α is relative to: α, or a hundredth of the load where the film carries less than that.
fn unit(alpha: f64) -> f64 {
    alpha.abs().max(0.01)
}

/// Whether the numbers so far are as exact as was asked.
fn precise_enough(motor: &Motor, plan: &Plan, found: &Found) -> bool {
    found.status == Status::Converged && {
        let estimate = stated(motor, plan, found);
        estimate.error <= plan.accuracy * unit(estimate.value)
    }
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

/// α with its error.
fn stated(motor: &Motor, plan: &Plan, found: &Found) -> Estimate {
    let estimate = extrapolate(&found.alphas);
    let Some(level) = found.levels.last() else { return estimate };
    // What floats carries its load whatever the gas is, and whatever was left out; only the height changes.
    if level.floats() {
        let error = if found.status == Status::Converged { level.mean_imbalance() } else { 1.0 };
        return Estimate { value: 1.0, error };
    }
    let astray = if let Status::NotConverged { residual, .. } = found.status { residual.min(1.0) } else { 0.0 };
    let value = estimate.value.min(found.alphas.iter().copied().fold(1.0, f64::max));
    // The trapped gas still changes by the residual, and its force with it; film and contact disagree about their shares.
    // (Twice the latter: calibrated, docs/validation.md.)
    let repeating = level.residual().min(1.0) * level.gas_force() / motor.load;
    let across = found.narrower.as_ref().map_or(0.0, |(_, change)| WIDTH_SHARE * change);
    let left_out = plan.left_out * value.abs();
    let error = estimate.error.min(1.0) + astray + 2.0 * level.mean_imbalance() + repeating + across + left_out;
    Estimate { value, error }
}

/// The numbers, their error and the fields, from the finest grid and what each grid gave, coarse to fine.
fn finish(motor: &Motor, plan: &Plan, found: &Found, mut stats: Stats) -> Periodic {
    let (status, alphas) = (found.status, found.alphas.clone());
    let across = found.narrower.as_ref().map_or(0.0, |(_, change)| *change);
    let Some((level, coarser)) = found.levels.split_last() else {
        return Periodic { status, result: MotorResult::default(), alphas, across, stats, recording: Recording::default() };
    };
    let mut recording = level.recording(motor, plan.maps);
    recording.coarser = coarser.iter().map(|level| level.line_loads(motor)).collect();
    let mut result = summarise(motor, &recording);
    let estimate = stated(motor, plan, found);
    result.set_alpha(motor, estimate.value);
    result.alpha_error = estimate.error;
    stats.film_nodes = level.film_nodes();
    stats.contact_nodes = level.contact_nodes();
    stats.steps_per_cycle = level.steps();
    Periodic { status, result, alphas, across, stats, recording }
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
