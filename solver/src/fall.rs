//! A plate that is dropped onto the gas above its vibrating face: its height, cycle by cycle, until it floats at the gap of the periodic
//! solve or rests.
//!
//! The plate is the mass of [`mod@crate::hold`]. It falls from rest at twice the gap at which it floats, or at which it would rest, through
//! gas at ambient pressure, while the vibration builds up. The motion is marched with steps of one length and of half that length, and the
//! height is extrapolated from both, at second order. Its stated error has three parts: the difference of the two; a fraction of the
//! difference to a third march, on coarser grids; and the relative error of the gap at which the plate floats, times the height. A plate
//! that bounces may amplify errors, until its height is no longer resolved.

use crate::control::Cancel;
use crate::digits::counted;
use crate::estimate::{Estimate, extrapolate, left};
use crate::fidelity::Fidelity;
use crate::film::cycle::Interrupted;
use crate::hold::{Hold, STRUCK};
use crate::memory;
use crate::plan::Plan;
use crate::plate::floating::FloatError;
use crate::problem::{Plate, Problem, Scenario};
use crate::solution::{Outcome, PlateResult, Status, settled};
use crate::solve::{Record, Settings, SolveError, solve};
use serde::{Deserialize, Serialize};

/// Height from which the plate is dropped, as a multiple of the gap at which it floats or rests.
const FROM: f64 = 2.0;
/// Number of cycles within which a plate should have settled.
pub const CYCLES: usize = 5000;
/// Fraction of the difference to the coarser grids that counts as error of the height, and the largest relative error of a height up to
/// which the motion is followed.
const GRIDS_SHARE: f64 = 1.0 / 3.0;
const RESOLVED: f64 = 0.5;
/// Number of cycles over which the height must no longer change.
const SETTLED: usize = 32;
/// Where these changes shrink so slowly that their ratio is above `SLOWEST`, the distance to the final height may be `CREEP` times the last
/// change.
const SLOWEST: f64 = 0.95;
const CREEP: f64 = 20.0;

/// The plate at the end of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cycle {
    /// Number of the cycle, from 1; 0 is the initial state.
    pub number: usize,
    /// Time \[s\].
    pub time: f64,
    /// Height: the gap without the vibration \[m\].
    pub height: Estimate,
    /// Mean speed over the cycle, upwards \[m/s\].
    pub speed: f64,
    /// Whether it rested on its roughness in this cycle.
    pub rests: bool,
}

/// A warning about a plate that the face has struck and that did not come to rest on it; `None` otherwise.
pub fn struck(cycles: &[Cycle]) -> Option<String> {
    let hit = cycles.iter().filter(|cycle| cycle.rests).count();
    let rests = cycles.last().is_some_and(|cycle| cycle.rests);
    let cycles = counted(hit, "cycle", "cycles");
    (hit > 0 && !rests).then(|| format!("{STRUCK} (in {cycles})"))
}

/// How a fall ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fall {
    /// Converged: its height no longer changes. Not resolved: its error has become as large as half of it.
    pub status: Status,
    /// Cycles made.
    pub cycles: usize,
    /// Mean gap at which the plate floats by the periodic solve \[m\]; `Err` with the reason in words if it does not float.
    pub floats: Result<Estimate, String>,
    /// Result of the periodic solve; `None` if the plate does not float.
    pub outcome: Option<Outcome>,
}

impl Fall {
    /// A fall that was cancelled before it had any result.
    pub fn cancelled() -> Self {
        Self { status: Status::Cancelled, cycles: 0, floats: Err("cancelled".to_owned()), outcome: None }
    }
}

/// Drops the plate of `problem` and passes every cycle to the caller. It ends after so many `cycles`, when a budget is spent, or when the
/// height is within `tolerance` of its final value, as estimated from its changes over 32 cycles. `None` if the scene has no plate under a
/// load.
///
/// # Errors
/// [`SolveError`] if a step has no solution to working precision, or it would need more memory than is allowed.
pub fn fall(
    problem: &Problem,
    fidelity: Fidelity,
    cycles: usize,
    tolerance: f64,
    each: &mut dyn FnMut(Cycle),
    cancel: &Cancel,
) -> Result<Option<Fall>, SolveError> {
    let Scenario::Plate(plate @ Plate { load: Some(_), .. }) = &problem.scenario else { return Ok(None) };
    let settings = Settings { fidelity, record: Record::Numbers, ..Settings::default() };
    let (found, floats, outcome) = match solve(problem, &settings, &mut (), cancel) {
        Ok(solution) => {
            let floats = match solution.outcome {
                Outcome::Plate(PlateResult { floating: Some(floating), .. }) => Ok(floating.mean_gap),
                _ => Err("cancelled".to_owned()),
            };
            (settled(problem, &solution.outcome).into_owned(), floats, Some(solution.outcome))
        }
        Err(SolveError::Float(error @ FloatError::Rests { .. })) => {
            let scenario = Scenario::Plate(plate.resting());
            (Problem { scenario, ..problem.clone() }, Err(error.to_string()), None)
        }
        Err(error) => return Err(error),
    };
    let Scenario::Plate(found) = &found.scenario else { return Ok(None) };
    let cancel = &cancel.started();
    let gap = floats.clone().unwrap_or(Estimate::exact(found.mean_gap));
    let start = gap * FROM;
    let plan = Plan::plate(found, fidelity, &problem.numerics);
    // Each of three descents marches the finest grid of the plan and one twice as fine, and keeps no fields.
    let marched = Plan { most_grids: plan.grids.len() + 1, maps: false, ..plan.clone() };
    let need = memory::plate(found, &marched);
    let _taken = memory::take(memory::Need { bytes: 3 * need.bytes, ..need }, cancel)?;
    let coarse = Plan { grids: plan.grids[..plan.grids.len().saturating_sub(1).max(1)].to_vec(), ..plan.clone() };
    let mut ways = [(&plan, 1.0), (&plan, 2.0), (&coarse, 1.0)].map(|(plan, finer)| {
        let mut hold = Hold::new(found, plan).finer(finer);
        hold.rest_at(start.value);
        hold
    });
    let period = 1.0 / plate.frequency;
    let mut heights = vec![start.value];
    let mut status = Status::NotConverged { residual: f64::INFINITY, tolerance };
    let ended = |status, cycles| Ok(Some(Fall { status, cycles, floats, outcome }));
    each(Cycle { number: 0, time: 0.0, height: start, speed: 0.0, rests: false });
    for number in 1..=cycles {
        let rested = ways[1].free().rests;
        for way in &mut ways {
            if cancel.is_cancelled() {
                return ended(Status::Cancelled, number - 1);
            }
            let failed = |source| SolveError::Plate(Interrupted::Failed { step: number, source });
            way.fall(period, true).map_err(failed)?;
        }
        let [usual, finer, coarse] = &ways;
        let mut height = extrapolate(&[usual.height(), finer.height()]);
        height.error += GRIDS_SHARE * (usual.height() - coarse.height()).abs() + height.value * gap.error / gap.value;
        let rests = finer.free().rests > rested;
        let speed = (height.value - heights[number - 1]) / period;
        each(Cycle { number, time: finer.reading().time, height, speed, rests });
        heights.push(height.value);
        if height.error > RESOLVED * height.value {
            return ended(Status::NotResolved { error: height.error / height.value }, number);
        }
        if let Some(first) = heights.len().checked_sub(2 * SETTLED + 1) {
            let change = |heights: &[f64]| {
                let last = heights[SETTLED];
                heights.iter().map(|z| (z / last - 1.0).abs()).fold(0.0, f64::max)
            };
            let (before, after) = (change(&heights[first..=first + SETTLED]), change(&heights[first + SETTLED..]));
            let residual = after.max(left(before, after, SLOWEST, CREEP));
            if residual < tolerance {
                return ended(Status::Converged, number);
            }
            status = Status::NotConverged { residual, tolerance };
        }
        if cancel.is_spent() {
            return ended(status, number);
        }
    }
    ended(status, cycles)
}
