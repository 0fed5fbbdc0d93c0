//! Successive grids, each of half the spacing of the one before, until the stated error is the one asked for.
//!
//! Two things are refined. Across the width the field is one polynomial: on the coarsest grid its nodes are increased one at a time until
//! the last one hardly changes the headline, and that number is used on every grid. Along and in time each grid has half the spacing of the
//! one before and starts from its state: first the grids of the plan, which an extrapolation needs, then as many more as the accuracy
//! takes.

use crate::control::Cancel;
use crate::estimate::{Estimate, Mean, extrapolate, extrapolate_means};
use crate::plan::{Grid, Plan};
use crate::recording::{LineLoads, Recording};
use crate::solution::{Outcome, Stats, Status};

/// The error of the nodes across that are missing is at least this fraction of the change due to the last one (calibrated:
/// docs/validation.md).
const WIDTH_SHARE: f64 = 0.15;
/// The change due to the last node is taken to be small by chance if it is below this fraction of the change before it; and the largest
/// ratio of successive changes that the error estimate assumes.
const BY_CHANCE: f64 = 0.1;
const SLOWEST_ACROSS: f64 = 0.6;
/// Requested relative error below which the coarsest grid is also solved with two nodes fewer across, so that the first change can be
/// compared with an earlier one.
pub const EXACTING: f64 = 4e-3;

/// The state of a scene on one grid.
pub trait GridState {
    /// The headline.
    fn headline(&self) -> Mean;

    /// The headline at instant 0: the present state, between two cycles of a transient.
    fn now(&self) -> f64;

    /// Reference of the relative error that is asked for.
    fn unit(&self) -> f64;

    /// Time steps in a cycle.
    fn steps(&self) -> usize;

    /// Unknown nodes across.
    fn across(&self) -> usize;

    /// Writes its numbers of nodes and steps to `stats`.
    fn count(&self, stats: &mut Stats);
}

/// A scene that can be solved on any grid.
pub trait GridSolver {
    /// Its state on one grid.
    type Level: GridState;
    /// Why a solve fails.
    type Error;
    /// Fraction of the error asked for that is allowed for the nodes across.
    const WIDTH_AIM: f64;
    /// Largest work of a round, `Grid::work`, on grids beyond those of the plan, times the square root of the error asked for.
    const MOST_WORK: f64;

    /// Solves on `grid` of `plan`. `number` counts the grids from 0.
    ///
    /// # Errors
    /// If a step has no solution to working precision.
    fn solve(
        &mut self,
        plan: &Plan,
        grid: &Grid,
        start: Option<StartingState<'_, Self::Level>>,
        number: usize,
    ) -> Result<(Status, Self::Level), Self::Error>;

    /// Whether the headline is as accurate as `plan` asks, or finer grids would not make it so.
    fn settled(&self, plan: &Plan, found: &SolvedGrids<Self::Level>) -> bool;
}

/// The state from which a grid is started.
#[derive(Debug)]
pub enum StartingState<'a, L> {
    /// That of the same scene on a coarser grid, or with fewer nodes across.
    Coarser(&'a L),
    /// That of a similar scene, and the states of that scene and of this one on the coarser grid before this one.
    Similar(&'a L, Option<[&'a L; 2]>),
}

/// Course of a solve: the grids that converged, coarse to fine, and how the last one ended.
#[derive(Debug)]
pub struct SolvedGrids<L> {
    /// How the last grid ended.
    pub status: Status,
    /// States on the grids that converged.
    pub levels: Vec<L>,
    /// The grids that converged.
    pub grids: Vec<Grid>,
    /// Whether fields are polynomials across the width.
    pub spectral: bool,
    /// The coarsest grid with one node fewer across, and the error of the headline due to missing nodes; `None` with finite volumes.
    pub narrower: Option<(L, f64)>,
    /// Change of the headline on that grid due to the last node but one; 0 if it is not known.
    before: f64,
}

/// A periodic state: the numbers, the course of the solve, and the fields.
#[derive(Clone, Debug)]
pub struct Periodic<R> {
    /// How the finest grid ended.
    pub status: Status,
    /// The numbers, with the error estimate.
    pub result: R,
    /// The headline on each grid, coarse to fine: α, or a plate's mean load \[N; of a strip N/m\].
    pub headlines: Vec<f64>,
    /// Cost on all grids.
    pub stats: Stats,
    /// Fields of one cycle on the finest grid.
    pub recording: Recording,
}

impl<R: Default> Periodic<R> {
    /// A result without numbers, for a solve that ended with `status` before any grid was solved.
    pub fn ended(status: Status) -> Self {
        Self {
            status,
            result: R::default(),
            headlines: Vec::new(),
            stats: Stats::default(),
            recording: Recording::default(),
        }
    }
}

impl<L: GridState> SolvedGrids<L> {
    /// The headline on each grid.
    pub fn headlines(&self) -> Vec<Mean> {
        self.levels.iter().map(L::headline).collect()
    }

    /// The course of the solve, without numbers and fields; `stats` is its cost.
    pub fn reached<R: Default>(&self, mut stats: Stats) -> Periodic<R> {
        if let Some(level) = self.levels.last() {
            level.count(&mut stats);
        }
        let headlines = self.headlines().iter().map(|mean| mean.all).collect();
        Periodic { headlines, stats, ..Periodic::ended(self.status) }
    }

    /// Estimated error of the headline due to the limited number of nodes across, absolute.
    pub fn width_error(&self) -> f64 {
        self.narrower.as_ref().map_or(0.0, |(_, error)| *error)
    }

    /// `plan`, by which this was found, pinned to exactly these grids: none is added or left out.
    pub fn pinned(&self, plan: &Plan) -> Plan {
        let plan = if plan.spectral && !self.spectral { plan.volumes() } else { plan.clone() };
        let (most_grids, most_across) = (self.grids.len(), self.grids.first().map_or(0, |grid| grid.across));
        Plan { grids: self.grids.clone(), most_grids, most_across, ..plan }
    }

    /// The value of `given` from all grids, and from all but the finest.
    pub fn nested<T>(&mut self, given: impl Fn(&Self) -> T) -> Nested<T> {
        let fine = given(self);
        if self.levels.len() < 2 {
            return Nested { fine, coarse: None };
        }
        let finest = (self.levels.pop(), self.grids.pop());
        let coarse = Some(given(self));
        self.levels.extend(finest.0);
        self.grids.extend(finest.1);
        Nested { fine, coarse }
    }
}

/// A result from all grids of a solve, and the same without the finest grid: the less the two differ, the more accurate both are.
#[derive(Clone, Debug, PartialEq)]
pub struct Nested<T> {
    /// From all grids.
    pub fine: T,
    /// From all but the finest; `None` if there is only one grid.
    pub coarse: Option<T>,
}

impl<T> Nested<T> {
    /// Applies `made` to each.
    pub fn map<U>(self, mut made: impl FnMut(T) -> U) -> Nested<U> {
        Nested { fine: made(self.fine), coarse: self.coarse.map(made) }
    }
}

/// Solves the grids of `plan`, and finer ones, starting from the result of a similar scene if there is one, until the error is small enough
/// or the budget of `cancel` is spent; the best result so far is then returned. A polynomial across the width can oscillate to negative
/// pressure. A scene that fails this way is solved with finite volumes, which keep the pressure positive.
pub fn climb<S: GridSolver>(
    scene: &mut S,
    plan: &Plan,
    last: Option<&SolvedGrids<S::Level>>,
    cancel: &Cancel,
) -> Result<SolvedGrids<S::Level>, S::Error> {
    let found = climb_once(scene, plan, last, cancel);
    if !plan.spectral || matches!(&found, Ok(found) if !matches!(found.status, Status::NotConverged { .. })) {
        return found;
    }
    drop(found);
    climb_once(scene, &plan.volumes(), None, cancel)
}

/// As [`climb`], with this plan only.
pub fn climb_once<S: GridSolver>(
    scene: &mut S,
    plan: &Plan,
    last: Option<&SolvedGrids<S::Level>>,
    cancel: &Cancel,
) -> Result<SolvedGrids<S::Level>, S::Error> {
    let (status, spectral) = (Status::Converged, plan.spectral);
    let (levels, grids) = (Vec::new(), Vec::new());
    let mut found = SolvedGrids { status, levels, grids, spectral, narrower: None, before: 0.0 };
    let mut across = plan.grids.first().map_or(0, |grid| grid.across);
    if plan.spectral && plan.grids.len() > 1 {
        let first = last.map_or(across, |last| last.levels[0].across()).max(2);
        across = settle_across(scene, plan, first, last, &mut found)?;
        if found.status != Status::Converged {
            return Ok(found);
        }
    }
    let mut number = found.levels.len();
    let mut finer = None;
    while let Some(grid) = plan.grids.get(number).copied().or(finer) {
        let grid = if plan.spectral { Grid { across, ..grid } } else { grid };
        let coarser = found.levels.last();
        let start = match last.and_then(|last| last.levels.get(number)) {
            Some(similar) => {
                let then = last.and_then(|last| last.levels.get(number.checked_sub(1)?));
                Some(StartingState::Similar(similar, then.zip(coarser).map(<[_; 2]>::from)))
            }
            None => coarser.map(StartingState::Coarser),
        };
        let (status, level) = scene.solve(plan, &grid, start, number)?;
        number += 1;
        if number > plan.grids.len() && status != Status::Converged {
            // The result of the coarser grids remains valid.
            if cancel.is_cancelled() {
                found.status = status;
            }
            break;
        }
        found.status = status;
        if status != Status::Converged && number < plan.grids.len() {
            // A coarse grid without a periodic state says nothing about the next one.
            found.levels.clear();
            found.grids.clear();
        } else {
            found.levels.push(level);
            found.grids.push(grid);
        }
        let next = grid.finer(plan.spectral);
        let worthwhile = || next.work() * plan.target_error.sqrt() <= S::MOST_WORK && !scene.settled(plan, &found);
        let more = number < plan.grids.len()
            || number < plan.most_grids && status == Status::Converged && !cancel.is_spent() && worthwhile();
        finer = Some(next);
        if status == Status::Cancelled || !more {
            break;
        }
    }
    Ok(found)
}

/// Whether to refine no further a headline with the error `whole`, of which `grids` is due to the grids: it is as accurate as `asked`, or a finer grid,
/// which leaves a quarter of its part, would neither make it so nor reduce the error by much.
pub fn enough(whole: f64, grids: f64, asked: f64) -> bool {
    whole <= asked || grids < 0.3 * whole && whole - 0.75 * grids > asked
}

/// One cycle of a transient, on all grids of a plan.
#[derive(Debug)]
pub struct TransientCycle {
    /// Means and extremes over it, with the error that its grids show.
    pub outcome: Outcome,
    /// Fields of the finest grid; the first frame is the beginning of the cycle.
    pub recording: Recording,
    /// Largest change of ln Z from its beginning to its end.
    pub change: f64,
    /// The part of the headline's error that finer grids would not reduce, absolute.
    pub elsewhere: f64,
    /// If film and contact did not agree in every step: the largest residual of a step, and the allowed one, in ln ζ.
    pub unsettled: Option<(f64, f64)>,
}

/// Result of one cycle of a transient on grids coarse to fine.
pub struct Marched {
    /// Fields of the finest grid.
    pub recording: Recording,
    /// Largest change of ln Z on the finest grid.
    pub change: f64,
    /// Mean of the headline over the cycle.
    pub mean: Estimate,
    /// The headline at the end of the cycle.
    pub end: f64,
}

/// Marches each of `levels`, coarse to fine, by one `cycle`, which passes on the state once its frames are known and returns the largest
/// change of ln Z; `lines` returns the fields of a coarser grid, and `recorded` makes those of the finest grid with them.
pub fn march_cycle<L: GridState, E>(
    levels: &mut [L],
    stats: &mut Stats,
    mut cycle: impl FnMut(&mut L, &mut Stats, &mut dyn FnMut(&L)) -> Result<f64, E>,
    lines: impl Fn(&L) -> LineLoads,
    recorded: impl Fn(&L, &[LineLoads]) -> Recording,
) -> Result<Marched, E> {
    let (mut means, mut ends, mut coarser) = (Vec::new(), Vec::new(), Vec::new());
    let (mut recording, mut change) = (Recording::default(), f64::INFINITY);
    let finest = levels.len() - 1;
    for (number, level) in levels.iter_mut().enumerate() {
        let start = level.now();
        change = cycle(level, stats, &mut |level| {
            if number < finest { coarser.push(lines(level)) } else { recording = recorded(level, &coarser) }
        })?;
        means.push(level.headline().from_to(start, level.now(), level.steps()));
        ends.push(level.now());
        level.count(stats);
    }
    stats.cycles += 1;
    Ok(Marched { recording, change, mean: extrapolate_means(&means), end: extrapolate(&ends).value })
}

/// Error due to missing nodes across, from the `change` due to the last node and the one due to the node `before` it, as a geometric
/// series. Where `before` is not known (0) or the last change is small by chance, the error is a fraction of the larger change.
pub fn error_across(change: f64, before: f64) -> f64 {
    if change < BY_CHANCE * before {
        return WIDTH_SHARE * before;
    }
    let ratio = if before > 0.0 { (change / before).min(SLOWEST_ACROSS) } else { 0.0 };
    change * WIDTH_SHARE.max(ratio / (1.0 - ratio))
}

/// Solves the coarsest grid with more and more nodes across, at least `first`, until the last node hardly matters. Returns the number of
/// nodes.
fn settle_across<S: GridSolver>(
    scene: &mut S,
    plan: &Plan,
    first: usize,
    last: Option<&SolvedGrids<S::Level>>,
    found: &mut SolvedGrids<S::Level>,
) -> Result<usize, S::Error> {
    let mut across = first;
    let coarsest = plan.grids[0];
    let similar = last.and_then(|last| last.narrower.as_ref()).map(|(level, _)| level);
    // A solve with two nodes fewer shows whether the next change is small by chance; if it fails, the estimate does without it.
    let mut two_less = None;
    if plan.target_error < EXACTING && similar.is_none() && across > 2 {
        let solved = scene.solve(plan, &Grid { across: across - 2, ..coarsest }, None, 0);
        two_less = solved.ok().filter(|(status, _)| *status == Status::Converged).map(|(_, level)| level);
    }
    let grid = Grid { across: across - 1, ..coarsest };
    let start = match similar {
        Some(similar) => Some(StartingState::Similar(similar, None)),
        None => two_less.as_ref().map(StartingState::Coarser),
    };
    let (mut status, mut narrower) = scene.solve(plan, &grid, start, 0)?;
    let mut before = last.map_or(0.0, |last| last.before);
    if let Some(level) = two_less {
        before = (narrower.headline().all - level.headline().all).abs();
    }
    while status == Status::Converged {
        let start = match last.map(|last| &last.levels[0]).filter(|level| level.across() == across) {
            Some(level) => StartingState::Similar(level, similar.map(|similar| [similar, &narrower])),
            None => StartingState::Coarser(&narrower),
        };
        let level;
        (status, level) = scene.solve(plan, &Grid { across, ..coarsest }, Some(start), 0)?;
        let change = (level.headline().all - narrower.headline().all).abs();
        let error = error_across(change, before);
        let matters = error > S::WIDTH_AIM * plan.target_error * level.unit();
        if status == Status::Converged && matters && across < plan.most_across {
            (narrower, before) = (level, change);
            across += 1;
            continue;
        }
        found.before = before;
        found.status = status;
        found.levels = vec![level];
        found.grids = vec![Grid { across, ..coarsest }];
        found.narrower = Some((narrower, error));
        return Ok(across);
    }
    found.status = status;
    found.levels = vec![narrower];
    found.grids = vec![Grid { across: across - 1, ..coarsest }];
    Ok(across)
}
