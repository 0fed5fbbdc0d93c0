//! Film, contact and rotor together: the periodic steady state of a motor.
//!
//! The unknown is the trapped gas ζ on every tooth at every step of the cycle. Given ζ, one contact problem per instant gives the film
//! thickness h (`contact`: the film is a spring of trapped gas, so that stiff films and a floating rotor need no special treatment). Given
//! h, one cycle of the film gives a new ζ, moved towards the periodic state by the slow shift of `film::cycle`. Anderson acceleration of ln
//! ζ drives both to the common periodic state at once.
//!
//! In the steady state tooth k at time t is tooth 0 at t + kT/n_t, because the wave travels towards −x and the rotor is the same
//! everywhere. One tooth, and the contact problems of the first T/n_t, therefore represent all. Solving every tooth gives the same result
//! (tested).

mod dry;
mod ending;
mod level;

pub use dry::without_film;
pub use ending::{MotorError, unit};

use crate::control::{Cancel, Observer, Reporter};
use crate::estimate::{Estimate, Mean, extrapolate_means};
use crate::ladder::{
    self, GridSolver, Marched, Nested, SolvedGrids, StartingState, TransientCycle, climb, climb_once, enough,
    march_cycle,
};
use crate::memory;
use crate::plan::{Grid, Plan};
use crate::problem::Motor;
use crate::recording::{LineLoads, Recording};
use crate::solution::{MotorResult, Outcome, Stats, Status};
use ending::{Stop, unless_cancelled};
use level::MotorLevel;

/// Most rounds of a solve that starts from another motor's state.
const WARM_ROUNDS: usize = 12;
/// The same, where the cycle has to repeat nearly to round-off.
const NEAR_ROUNDS: usize = 80;
/// Rounds after which a coarse grid is left for the next one.
const COARSE_ROUNDS: usize = 120;

/// Cycles of every tooth are marched one after the other only if the work of one on the finest grid, `Grid::work`, is at most this; on
/// asperities, whose contact problems cost many times as much, at most the second.
const MOST_MARCHED: [f64; 2] = [1e6, 2e5];

/// Share of the load on the film above which a rotor counts as floating, or nearly so.
pub const NEARLY_FLOATS: f64 = 0.95;
/// Loads, as multiples of its own load, through which the state of a motor whose teeth touch is followed.
const HEAVIER: [f64; 7] = [4.0, 2.8, 2.0, 1.5, 1.25, 1.1, 1.0];

/// Round-off error of α: an α this close to 1 is 1.
const ROUNDING: f64 = 1e-12;
/// Share of the load below which an error is no reason to call a result unresolved.
const NEGLIGIBLE: f64 = 1e-4;

/// A motor's periodic state; its headline is α.
pub type Periodic = ladder::Periodic<MotorResult>;

/// The final states of the last solve, from which the solve of a similar motor may start.
///
/// A start from them changes the number of rounds, and the result by no more than the stated error.
#[derive(Debug, Default)]
pub struct Warm {
    found: Option<SolvedGrids<MotorLevel>>,
}

impl Warm {
    /// Whether there is nothing to start from.
    pub fn is_empty(&self) -> bool {
        self.found.is_none()
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

/// As [`periodic`], with each grid started from the state that `warm` holds of the last solve, if any; the new states are left in `warm`.
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
    let last = warm.found.take().filter(|last| last.levels.first().is_some_and(|level| level.serves(motor, plan)));
    let mut solver = MotorSolver::new(motor, WARM_ROUNDS, observer, cancel, &mut stats);
    let found = climb(&mut solver, plan, last.as_ref(), cancel)?;
    if let Status::NotConverged { .. } = found.status {
        // A cycle may repeat on grids of half the spacing although it does not on those of the plan.
        let refined = (plan.most_grids > plan.grids.len()).then(|| plan.finer());
        for plan in [Some(plan), refined.as_ref()].into_iter().flatten() {
            if let Some(settled) = solver.march(plan) {
                return Ok(finish(motor, plan, &settled, stats));
            }
        }
    }
    let result = finish(motor, plan, &found, stats);
    if found.status == Status::Converged {
        warm.found = Some(found);
    }
    Ok(result)
}

/// As [`periodic`] with this plan only, starting from `near`, which is not changed. Returns the result of all grids and of all but the
/// finest, the state, and the plan pinned to the grids that converged.
///
/// # Errors
/// As [`periodic`].
pub fn periodic_near(
    near: &Warm,
    motor: &Motor,
    plan: &Plan,
    cancel: &Cancel,
) -> Result<(Nested<Periodic>, Warm, Plan), MotorError> {
    let (mut stats, mut nobody) = (Stats::default(), ());
    let last = near.found.as_ref().filter(|last| last.levels.first().is_some_and(|level| level.serves(motor, plan)));
    let mut solver = MotorSolver::new(motor, NEAR_ROUNDS, &mut nobody, cancel, &mut stats);
    let mut found = climb(&mut solver, plan, last, cancel)?;
    let pinned = found.pinned(plan);
    let nested = found.nested(|found| finish(motor, &pinned, found, stats));
    Ok((nested, Warm { found: Some(found) }, pinned))
}

/// The state with touching teeth of a motor that may also float, followed down from heavier loads under which it cannot float; `None` if
/// there is no such state, or it was not found. The cost is added to `stats`.
pub fn touching(
    motor: &Motor,
    plan: &Plan,
    stats: &mut Stats,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Option<Periodic> {
    let unrefined = Plan { most_grids: plan.grids.len(), ..plan.clone() };
    let mut last: Option<SolvedGrids<MotorLevel>> = None;
    for heavier in HEAVIER {
        let plan = if heavier > 1.0 { &unrefined } else { plan };
        let motor = Motor { load: heavier * motor.load, ..motor.clone() };
        let mut solver = MotorSolver::new(&motor, WARM_ROUNDS, observer, cancel, stats);
        solver.predicting = false;
        let found = climb_once(&mut solver, plan, last.as_ref(), cancel).ok()?;
        let floats = |level: &MotorLevel| level.alpha() > NEARLY_FLOATS;
        if found.status != Status::Converged || found.levels.last().is_some_and(floats) {
            return None;
        }
        last = Some(found);
    }
    last.map(|found| finish(motor, plan, &found, *stats))
}

/// One solve of a motor by a plan.
struct MotorSolver<'a> {
    motor: &'a Motor,
    /// Most rounds of a solve that starts from another motor's state.
    warm_rounds: usize,
    /// Whether such a start changes as the state on the grid before did. Where a rotor may float or not, that may lead from one state to the
    /// other.
    predicting: bool,
    /// Whether every tooth is marched cycle after cycle, instead of iterating over all instants at once.
    marching: bool,
    observer: &'a mut dyn Observer,
    cancel: &'a Cancel,
    stats: &'a mut Stats,
}

impl<'a> MotorSolver<'a> {
    fn new(
        motor: &'a Motor,
        warm_rounds: usize,
        observer: &'a mut dyn Observer,
        cancel: &'a Cancel,
        stats: &'a mut Stats,
    ) -> Self {
        Self { motor, warm_rounds, predicting: true, marching: false, observer, cancel, stats }
    }

    /// The state to which marching every tooth, cycle after cycle, converges on the grids of `plan`; `None` if it does not converge, or if
    /// work or memory exceed what a solve may take.
    fn march(&mut self, plan: &Plan) -> Option<SolvedGrids<MotorLevel>> {
        let plan = Plan { every_tooth: true, trapped: false, most_grids: plan.grids.len(), ..plan.clone() };
        let work = plan.grids.last()?.work() * self.motor.teeth as f64;
        let most = MOST_MARCHED[usize::from(self.motor.surface.asperities.is_some())];
        if work > most || memory::check(memory::motor(self.motor, &plan)).is_err() {
            return None;
        }
        let (observer, stats) = (&mut *self.observer, &mut *self.stats);
        let mut marching = MotorSolver { marching: true, observer, stats, ..*self };
        let found = climb_once(&mut marching, &plan, None, self.cancel).ok()?;
        (found.status == Status::Converged).then_some(found)
    }
}

impl GridSolver for MotorSolver<'_> {
    type Level = MotorLevel;
    type Error = MotorError;
    const WIDTH_AIM: f64 = 0.3;
    const MOST_WORK: f64 = 1e6;

    fn solve(
        &mut self,
        plan: &Plan,
        grid: &Grid,
        start: Option<StartingState<'_, MotorLevel>>,
        number: usize,
    ) -> Result<(Status, MotorLevel), MotorError> {
        let motor = self.motor;
        let limit = if number + 1 < plan.grids.len() { plan.round_limit.min(COARSE_ROUNDS) } else { plan.round_limit };
        let grids = plan.grids.len().max(number + 1);
        let mut report = Reporter::new(&mut *self.observer, number, grids, plan.tolerance);
        let mut level = MotorLevel::new(motor, plan, grid);
        if self.marching {
            match start {
                Some(StartingState::Coarser(other) | StartingState::Similar(other, _)) => level.march_on_from(other),
                None => level.rest()?,
            }
            let settled = level.settle(plan, self.stats, &mut report, &self.cancel.within_budget());
            return Ok((unless_cancelled(settled)?.unwrap_or(Status::Cancelled), level));
        }
        let mut rounds = limit;
        match start {
            Some(StartingState::Coarser(other)) => level.start_from(other),
            Some(StartingState::Similar(other, change)) => {
                rounds = self.warm_rounds;
                level.start_from_similar(other, change.filter(|_| self.predicting));
            }
            None => level.start(motor),
        }
        let cancel = if number < plan.grids.len() { self.cancel.clone() } else { self.cancel.within_budget() };
        let mut softened = false;
        let anew = || {
            let mut level = MotorLevel::new(motor, plan, grid);
            level.start(motor);
            level
        };
        loop {
            match level.converge(plan, rounds, self.stats, &mut report, &cancel) {
                Err(Stop::Cancelled) => return Ok((Status::Cancelled, level)),
                // A start too far from the solution is soon detected and replaced by a fresh start.
                Ok(Status::NotConverged { .. }) | Err(Stop::Failed(_)) if rounds < limit => {
                    level = anew();
                    rounds = limit;
                }
                // Gas that leaves within a step is not a spring; if all gas is treated as one, even many rounds do not reach the state.
                Ok(Status::NotConverged { .. }) if !softened && !level.is_soft() => {
                    level = anew();
                    level.soften();
                    softened = true;
                }
                Err(Stop::Failed(_)) if level.is_soft() => {
                    level = anew();
                    softened = true;
                }
                Ok(status) => return Ok((status, level)),
                Err(Stop::Failed(error)) => return Err(error),
            }
        }
    }

    fn settled(&self, plan: &Plan, found: &SolvedGrids<MotorLevel>) -> bool {
        // On asperities there is always some contact everywhere.
        if self.motor.surface.asperities.is_none() && may_open(found) {
            return false;
        }
        let headlines = found.headlines();
        let whole = stated(plan, found, &headlines);
        enough(whole.error, of_grids(plan, &headlines).error, plan.accuracy * unit(whole.value))
    }
}

/// A motor from rest, cycle after cycle ([`mod@crate::startup`]), on all grids of a plan at once.
#[derive(Debug)]
pub struct MotorTransient<'a> {
    motor: &'a Motor,
    plan: Plan,
    levels: Vec<MotorLevel>,
    width_error: f64,
}

impl<'a> MotorTransient<'a> {
    /// The motor at rest, with every tooth. `width_error` is the error of α due to the nodes across.
    ///
    /// # Errors
    /// [`MotorError::Contact`] if the teeth at rest have no solution to working precision.
    pub fn at_rest(motor: &'a Motor, plan: &Plan, width_error: f64) -> Result<Self, MotorError> {
        let plan = Plan { every_tooth: true, trapped: false, ..plan.clone() };
        let mut levels: Vec<MotorLevel> = plan.grids.iter().map(|grid| MotorLevel::new(motor, &plan, grid)).collect();
        levels.iter_mut().try_for_each(MotorLevel::rest)?;
        Ok(Self { motor, plan, levels, width_error })
    }

    /// Marches the next cycle from the present instant; its cost is added to `stats`. `None` if cancelled.
    ///
    /// # Errors
    /// [`MotorError`] if a film step or a contact problem has no solution to working precision.
    pub fn cycle(&mut self, stats: &mut Stats, cancel: &Cancel) -> Result<Option<TransientCycle>, MotorError> {
        let (motor, plan) = (self.motor, &self.plan);
        // Tolerance to which film and contact have to agree in every step, in ln ζ.
        let tolerance = 0.025 * plan.tolerance;
        let marched = march_cycle(
            &mut self.levels,
            stats,
            |level, stats, record| level.transient_cycle(tolerance, stats, cancel, record),
            |level| level.line_loads(motor),
            |level, coarser| level.recording(motor, plan, coarser),
        );
        let Some(Marched { mut recording, change, mean, end }) = unless_cancelled(marched)? else { return Ok(None) };
        let astray = self.levels.iter().map(|level| level.residual).fold(tolerance, f64::max);
        // A floating rotor carries its load whatever the gas and the terms left out.
        let floats = recording.teeth_in_contact.iter().all(|teeth| *teeth == 0);
        let left_out = match floats {
            true => plan.forced.min(1.0),
            false => plan.left_out * mean.value.abs() + self.width_error,
        };
        // The remaining disagreement between film and contact, as a force of the gas.
        let finest = self.levels.last().filter(|_| !floats);
        let gas = finest.map_or(1.0, |level| level.gas_force() / motor.load);
        let elsewhere = left_out + astray.min(1.0) * gas.max(1.0);
        // Converts a fraction of the load to a fraction of the gas's force.
        let of_gas = astray.min(1.0) + left_out / (gas + f64::MIN_POSITIVE);
        recording.judge_series(of_gas, of_gas.max(plan.left_out), UNEVEN * plan.irregular);
        recording.across = self.width_error / (mean.value.abs() + f64::MIN_POSITIVE);
        let mut result = summarise(motor, &recording);
        // The frames include the start of the cycle, but not its end.
        let grown = end - recording.film_load[0] / motor.load;
        let alpha = result.alpha.value + 0.5 * grown / recording.frames as f64;
        let grids = (mean.error * plan.irregular).min(1.0);
        let error = claimed(plan, alpha, grids + (alpha - mean.value).abs() + elsewhere);
        result.set_alpha(motor, Estimate { value: alpha, error });
        let unsettled = (astray > tolerance).then_some((astray, tolerance));
        Ok(Some(TransientCycle { outcome: Outcome::Motor(result), recording, change, elsewhere, unsettled }))
    }
}

/// Error of the load at an instant, as a multiple of the error of its mean, where contact begins and ends (calibrated: docs/validation.md).
const UNEVEN: f64 = 1.25;

/// Contact may open on finer grids where the least contact load falls from one grid to the next by more than this fraction of the remaining
/// load.
const OPENING: f64 = 0.5;

/// Whether every node touches at every instant on the finest grid, but the least contact load may vanish on finer ones. Such grids agree,
/// because α is 0 on all of them; only finer grids show the effect of the film where the faces part.
fn may_open(found: &SolvedGrids<MotorLevel>) -> bool {
    let [.., before, now] = &found.levels[..] else { return false };
    let now = now.least_contact();
    now > 0.0 && before.least_contact() - now > OPENING * now
}

/// α with the error that the grids show, from its `headlines` on each of them.
fn of_grids(plan: &Plan, headlines: &[Mean]) -> Estimate {
    let Estimate { value, error } = extrapolate_means(headlines);
    Estimate { value, error: error * plan.irregular }
}

/// α with its error, from its `headlines` on each grid.
fn stated(plan: &Plan, found: &SolvedGrids<MotorLevel>, headlines: &[Mean]) -> Estimate {
    let estimate = of_grids(plan, headlines);
    let Some(level) = found.levels.last() else { return estimate };
    // A floating rotor carries its load whatever the gas and the small terms left out; only the height changes.
    if level.floats() {
        let error = if found.status == Status::Converged { level.mean_imbalance() + plan.forced.min(1.0) } else { 1.0 };
        return Estimate { value: 1.0, error };
    }
    let astray = if let Status::NotConverged { residual, .. } = found.status { residual.min(1.0) } else { 0.0 };
    let value = headlines.iter().map(|mean| mean.all).fold(1.0, f64::max).min(estimate.value);
    let left_out = plan.left_out * value.abs();
    let error = estimate.error.min(1.0) + astray + level.astray() + found.width_error() + left_out;
    Estimate { value, error: claimed(plan, value, error) }
}

/// The `error` of α; at least a quarter of the error asked for if α is so small that the accuracy is not relative to it.
fn claimed(plan: &Plan, alpha: f64, error: f64) -> f64 {
    let small = plan.accuracy > 0.0 && unit(alpha) > alpha.abs();
    if small { error.max(0.25 * plan.target_error * unit(alpha)) } else { error }
}

/// The numbers, their error and the fields, from the finest grid and what each grid gave, coarse to fine.
fn finish(motor: &Motor, plan: &Plan, found: &SolvedGrids<MotorLevel>, stats: Stats) -> Periodic {
    let mut periodic: Periodic = found.reached(stats);
    let Some((level, coarser)) = found.levels.split_last() else { return periodic };
    let coarser: Vec<LineLoads> = coarser.iter().rev().take(2).rev().map(|level| level.line_loads(motor)).collect();
    let mut recording = level.recording(motor, plan, &coarser);
    let headlines = found.headlines();
    let estimate = stated(plan, found, &headlines);
    let elsewhere = (estimate.error - extrapolate_means(&headlines).error.min(1.0)).max(0.0);
    let of_gas = elsewhere * motor.load / (level.gas_force() + f64::MIN_POSITIVE);
    // The terms left out change a pressure even where they have no effect on the mean load.
    recording.judge_series(of_gas, of_gas.max(plan.left_out), UNEVEN * plan.irregular);
    recording.across = found.width_error() / (estimate.value.abs() + f64::MIN_POSITIVE);
    if motor.surface.asperities.is_some()
        && let Some(grid) = plan.grids.last()
    {
        recording.judge_short_waves(plan.harmonics(grid));
    }
    // The mean of the fields is the headline.
    let mut result = summarise(motor, &recording);
    // A small contact load may vanish by extrapolation. Asperities always carry some load.
    result.levitated &= motor.surface.asperities.is_some() || level.floats();
    let alpha = result.alpha.value;
    let error = estimate.error + (alpha - estimate.value).abs();
    result.set_alpha(motor, Estimate { value: alpha, error });
    let asked = (plan.accuracy * unit(alpha)).max(NEGLIGIBLE);
    if periodic.status == Status::Converged && error > asked.max(alpha.abs()) {
        periodic.status = Status::NotResolved { error: error / alpha.abs() };
    }
    Periodic { result, recording, ..periodic }
}

/// Cycle means and extremes of a recording; no error of the mean is known.
fn summarise(motor: &Motor, recording: &Recording) -> MotorResult {
    let frames = recording.frames as f64;
    let (loads, errors) = (&recording.film_load, &recording.film_load_error);
    let load = |greater| recording.extreme(LineLoads::film_loads, loads, errors, greater, f64::INFINITY);
    let (pressures, errors) = (&recording.max_pressure, &recording.max_pressure_error);
    let max_pressure = recording.extreme(LineLoads::max_pressures, pressures, errors, f64::max, f64::INFINITY);
    let (thicknesses, errors) = (&recording.min_film_thickness, &recording.min_film_thickness_error);
    let forced = recording.forced.min(1.0);
    let levitated = recording.teeth_in_contact.iter().all(|&teeth| teeth == 0);
    let touching = recording.teeth_in_contact.iter().sum::<usize>() as f64 / frames;
    let teeth_in_contact = Estimate {
        value: touching,
        // The beginning and the end of a tooth's contact are each known to half a frame. A tooth that nearly touches may in fact touch.
        error: if levitated {
            recording.touching_errors(motor.touching_thickness()).iter().sum::<f64>() / frames
        } else {
            recording.estimate(LineLoads::teeth_in_contact).error + motor.teeth as f64 / frames
        } + forced * if levitated { motor.teeth as f64 } else { touching },
    };
    let least =
        recording.extreme(LineLoads::min_film_thicknesses, thicknesses, errors, f64::min, motor.least_thickness());
    let mut result = MotorResult {
        film_load_min: load(f64::min),
        film_load_max: load(f64::max),
        teeth_in_contact,
        levitated,
        min_film_thickness: Estimate { error: least.error.max(forced * least.value), ..least },
        max_pressure,
        max_contact: recording.contact.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ..MotorResult::default()
    };
    let alpha = loads.iter().sum::<f64>() / frames / motor.load;
    // A floating rotor carries its load exactly, apart from round-off.
    result.set_alpha(motor, Estimate::exact(if (alpha - 1.0).abs() < ROUNDING { 1.0 } else { alpha }));
    result
}

impl MotorResult {
    /// Sets α and what follows from it: the loads, which share L, and the torque of the ring.
    pub fn set_alpha(&mut self, motor: &Motor, alpha: Estimate) {
        let contact = Estimate { value: 1.0 - alpha.value, ..alpha };
        self.alpha = alpha;
        self.film_load = alpha * motor.load;
        self.contact_load = contact * motor.load;
        self.max_torque = Estimate {
            value: motor.friction_torque(contact.value.max(0.0) * motor.load),
            error: motor.friction_torque(alpha.error * motor.load),
        };
    }
}
