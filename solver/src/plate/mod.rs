//! The plate: the film alone, under a prescribed gap, uniform in space and harmonic in time.

pub mod floating;
mod frames;
pub mod harmonic;
mod level;
mod result;
mod slow;
mod transient;

pub(crate) use level::film_grid;
pub use level::unit;
pub use transient::PlateTransient;

use crate::control::{Cancel, Observer, Reporter};
use crate::estimate::{Estimate, extrapolate_smooth};
use crate::film::cycle::Interrupted;
use crate::ladder::{self, GridSolver, GridState, Nested, SolvedGrids, StartingState, climb, enough};
use crate::plan::{Grid, Plan};
use crate::problem::Plate;
use crate::solution::{PlateResult, Stats, Status};
use level::PlateLevel;
use result::{add_errors, numbers};
use std::borrow::Cow;

/// Rounding of a mean load over the force of the gas.
const ROUNDING: f64 = 1e-15;

/// A plate's periodic state; its headline is the mean load \[N; of a strip N/m\].
pub type Periodic = ladder::Periodic<PlateResult>;

/// Solves for the periodic state on each of the plan's grids.
///
/// # Errors
/// [`Interrupted::Failed`] if a film step has no solution to working precision.
pub fn periodic(
    plate: &Plate,
    plan: &Plan,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Periodic, Interrupted> {
    let plate = &turned(plate, plan);
    let mut stats = Stats::default();
    let found = climb(&mut PlateSolver { plate, observer, cancel, stats: &mut stats }, plan, None, cancel)?;
    Ok(finish(plate, plan, &found, stats))
}

/// As [`periodic`]: what all grids give, and what all but the finest; and the plan pinned to the grids that converged.
///
/// # Errors
/// As [`periodic`].
pub fn periodic_near(plate: &Plate, plan: &Plan, cancel: &Cancel) -> Result<(Nested<Periodic>, Plan), Interrupted> {
    let plate = &turned(plate, plan);
    let mut stats = Stats::default();
    let mut found =
        climb(&mut PlateSolver { plate, observer: &mut (), cancel, stats: &mut stats }, plan, None, cancel)?;
    let pinned = found.pinned(plan);
    Ok((found.nested(|found| finish(plate, &pinned, found, stats)), pinned))
}

/// The plate as the plan solves it.
fn turned<'a>(plate: &'a Plate, plan: &Plan) -> Cow<'a, Plate> {
    if plan.turned { Cow::Owned(plate.turned()) } else { Cow::Borrowed(plate) }
}

/// The numbers, their error and the fields of a plate, turned as the plan says, from what each grid gave, coarse to fine.
fn finish(plate: &Plate, plan: &Plan, found: &SolvedGrids<PlateLevel>, stats: Stats) -> Periodic {
    let mut periodic: Periodic = found.reached(stats);
    let Some((level, coarser)) = found.levels.split_last() else { return periodic };
    let coarser: Vec<_> = coarser.iter().rev().take(2).rev().map(|level| level.fields(plate, false).0).collect();
    let mut recording = level.recording(plate, plan, &coarser);
    let estimate = stated(plate, plan, found);
    let elsewhere = (estimate.error - of_grids(plan, found).error).max(0.0);
    // Gas that fails to leak causes an error in proportion to the swing of the load, whatever its mean is.
    let swing = recording.film_load.iter().fold(0.0_f64, |swing, load| swing.max(load.abs()));
    let widths = width_errors(plate, found);
    let of_gas = elsewhere.max(plan.left_out * swing).max(widths[0]).max(widths[1]) / gas_force(plate, estimate.value);
    recording.judge_series(of_gas, of_gas.max(plan.left_out), 1.0);
    // The mean of the fields is the headline.
    let mut result = PlateResult::of(&recording);
    add_errors(&mut result, widths);
    let force = result.film_load.value;
    let error = estimate.error + (force - estimate.value).abs() + beyond_limits(plate, force);
    result.film_load.error = error;
    if periodic.status == Status::Converged && error > level.unit().max(force.abs()) {
        periodic.status = Status::NotResolved { error: error / force.abs() };
    }
    Periodic { result, recording, ..periodic }
}

/// Least and greatest mean load \[N\] that the equations allow: Z is nowhere less than the least gap and nowhere more than the greatest
/// (its equation has a maximum principle), so the mean of P = Z/H is within (1 ± ε)⟨1/H⟩ = √((1 ± ε)/(1 ∓ ε)).
fn limits(plate: &Plate) -> [f64; 2] {
    let most = ((plate.mean_gap + plate.amplitude) / (plate.mean_gap - plate.amplitude)).sqrt();
    [1.0 / most, most].map(|ratio| (ratio - 1.0) * plate.gas.ambient_pressure * plate.area())
}

/// By how much a mean load \[N\] is outside what the equations allow.
fn beyond_limits(plate: &Plate, load: f64) -> f64 {
    let [least, greatest] = limits(plate);
    (load - greatest).max(least - load).max(0.0)
}

/// Mean force of the gas alone \[N\], without the ambient pressure on the other side: what an error of Z is relative to.
fn gas_force(plate: &Plate, load: f64) -> f64 {
    plate.gas.ambient_pressure * plate.area() + load.abs()
}

/// Mean load \[N\] with the error of its grids alone.
fn of_grids(plan: &Plan, found: &SolvedGrids<PlateLevel>) -> Estimate {
    let found = extrapolate_smooth(&found.headlines(), found.levels.last().map_or(0.0, PlateLevel::unit));
    Estimate { error: found.error * plan.irregular, ..found }
}

/// Mean load with its error \[N\].
fn stated(plate: &Plate, plan: &Plan, found: &SolvedGrids<PlateLevel>) -> Estimate {
    let estimate = of_grids(plan, found);
    let Some(level) = found.levels.last() else { return estimate };
    let astray = if let Status::NotConverged { residual, .. } = found.status { residual.min(1.0) } else { 0.0 };
    let rounding = if plate.amplitude > 0.0 { ROUNDING } else { 0.0 };
    let repeating = (level.residual + astray + rounding) * gas_force(plate, estimate.value);
    let left_out = plan.left_out * estimate.value.abs();
    let beyond = beyond_limits(plate, estimate.value);
    let mut error = estimate.error + repeating + left_out + found.width_error();
    if astray > 0.0 {
        // The load is within its limits whatever its error.
        let [least, greatest] = limits(plate);
        error = error.min(greatest - least);
    }
    Estimate { error: error + beyond, ..estimate }
}

/// One solve of a plate by a plan.
struct PlateSolver<'a> {
    plate: &'a Plate,
    observer: &'a mut dyn Observer,
    cancel: &'a Cancel,
    stats: &'a mut Stats,
}

impl GridSolver for PlateSolver<'_> {
    type Level = PlateLevel;
    type Error = Interrupted;
    /// Small, so that spring and damping are as accurate as the mean.
    const WIDTH_AIM: f64 = 0.02;
    /// Large, because without contact a few rounds are enough.
    const MOST_WORK: f64 = 1.8e6;

    fn solve(
        &mut self,
        plan: &Plan,
        grid: &Grid,
        start: Option<StartingState<'_, PlateLevel>>,
        number: usize,
    ) -> Result<(Status, PlateLevel), Interrupted> {
        let mut level = PlateLevel::new(self.plate, plan, grid);
        if let Some(StartingState::Coarser(other) | StartingState::Similar(other, _)) = start {
            level.start_from(other);
        }
        let cancel = if number < plan.grids.len() { self.cancel.clone() } else { self.cancel.within_budget() };
        let grids = plan.grids.len().max(number + 1);
        let mut report = Reporter::new(&mut *self.observer, number, grids, plan.tolerance);
        match level.converge(plan, self.stats, &mut report, &cancel) {
            Ok(status) => Ok((status, level)),
            Err(Interrupted::Cancelled) => Ok((Status::Cancelled, level)),
            Err(failed) => Err(failed),
        }
    }

    fn settled(&self, plan: &Plan, found: &SolvedGrids<PlateLevel>) -> bool {
        let whole = stated(self.plate, plan, found);
        let unit = found.levels.last().map_or(0.0, PlateLevel::unit);
        enough(whole.error, of_grids(plan, found).error, plan.accuracy * unit)
    }
}

/// Changes of [`numbers`] on the coarsest grid with one node less across.
fn width_errors(plate: &Plate, found: &SolvedGrids<PlateLevel>) -> [f64; 5] {
    let (Some((narrower, _)), Some(coarsest)) = (&found.narrower, found.levels.first()) else { return [0.0; 5] };
    let of = |level: &PlateLevel| {
        let (lines, _) = level.fields(plate, false);
        numbers(&lines.film_loads(), &lines.max_pressures())
    };
    let (less, more) = (of(narrower), of(coarsest));
    std::array::from_fn(|k| (more[k] - less[k]).abs())
}
