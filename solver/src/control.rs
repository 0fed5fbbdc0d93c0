//! A caller's control over a running solve: cancellation and progress. No clock, no terminal.

use serde::{Deserialize, Serialize};

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Says whether a budget is spent, or whether the flag counts as raised for another reason.
type Asked = Arc<dyn Fn() -> bool + Send + Sync>;

/// A flag that any thread may raise to cancel a solve; solvers check it in their inner loops. It may carry a time budget for each solve:
/// once that is spent, a solve that has a result does not refine it any further.
#[derive(Clone, Default)]
pub struct Cancel {
    flag: Arc<AtomicBool>,
    /// Starts the budget of a solve on the caller's clock.
    start: Option<Arc<dyn Fn() -> Asked + Send + Sync>>,
    /// The budget of the solve that is running.
    spent: Option<Asked>,
    /// The flag also counts as raised when this returns true.
    raised: Option<Asked>,
}

impl fmt::Debug for Cancel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Cancel").field("cancelled", &self.is_cancelled()).finish()
    }
}

impl Cancel {
    /// A flag that is not raised.
    pub fn new() -> Self {
        Self::default()
    }

    /// A flag that is raised when this one is, and that can also be raised without raising this one.
    pub fn child(&self) -> Self {
        self.or(|| false)
    }

    /// The same flag with a budget for each solve: `start` is called when a solve begins, and the function that it returns says whether the
    /// budget is spent.
    pub fn with_budget<S: Fn() -> bool + Send + Sync + 'static>(
        &self,
        start: impl Fn() -> S + Send + Sync + 'static,
    ) -> Self {
        Self { start: Some(Arc::new(move || Arc::new(start()))), ..self.child() }
    }

    /// The flag of a solve that begins now.
    pub fn started(&self) -> Self {
        Self { spent: self.start.as_ref().map(|start| start()), ..self.child() }
    }

    /// Whether there is a budget.
    pub fn has_budget(&self) -> bool {
        self.spent.is_some()
    }

    /// Whether the budget is spent; false if there is none.
    pub fn is_spent(&self) -> bool {
        self.spent.as_ref().is_some_and(|spent| spent())
    }

    /// A flag that is also raised once the budget is spent.
    pub fn within_budget(&self) -> Self {
        let solve = self.clone();
        self.or(move || solve.is_spent())
    }

    /// A flag that also counts as raised when `raised` returns true, which is called at every check by a solver.
    pub fn or(&self, raised: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        let above = self.clone();
        let raised: Asked = Arc::new(move || above.is_cancelled() || raised());
        Self { flag: Arc::default(), start: self.start.clone(), spent: self.spent.clone(), raised: Some(raised) }
    }

    /// Raises the flag.
    pub fn cancel(&self) {
        self.flag.store(true, Ordering::Relaxed);
    }

    /// Whether the flag is raised.
    pub fn is_cancelled(&self) -> bool {
        self.flag.load(Ordering::Relaxed) || self.raised.as_ref().is_some_and(|raised| raised())
    }
}

/// A solve's progress after one round of its outer iteration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Which grid is being solved, from 0.
    pub level: usize,
    /// How many grids there are.
    pub levels: usize,
    /// Round (or cycle) on this grid.
    pub iteration: usize,
    /// Change in this round, relative.
    pub residual: f64,
    /// Relative change below which the iteration ends.
    pub tolerance: f64,
    /// Film load on this grid so far \[N; of a strip N/m\].
    pub film_load: f64,
}

/// Each grid takes about this many times as long as the one before.
const COST_RATIO: f64 = 6.0;

impl Progress {
    /// The fraction of the work that is done, 0 to 1, on the assumption that the change falls by the same factor in every round.
    pub fn fraction(&self) -> f64 {
        let within = (self.residual.ln() / self.tolerance.ln()).clamp(0.0, 1.0);
        let cost = |level: usize| COST_RATIO.powi(i32::try_from(level).unwrap_or(i32::MAX));
        let before: f64 = (0..self.level).map(cost).sum();
        let all: f64 = (0..self.levels).map(cost).sum();
        let done = (before + cost(self.level) * if within.is_nan() { 0.0 } else { within }) / all;
        if done.is_nan() { 0.0 } else { done.clamp(0.0, 1.0) }
    }

    /// The part of `history` that belongs to the last of several solves, each of which starts from the coarsest grid.
    pub fn last_solve(history: &[Self]) -> &[Self] {
        let again = history.windows(2).rposition(|pair| pair[1].level < pair[0].level);
        &history[again.map_or(0, |before| before + 1)..]
    }

    /// The rounds of each grid, in the order in which the grids were solved.
    pub fn grids(history: &[Self]) -> impl Iterator<Item = &[Self]> {
        history.chunk_by(|round, next| next.level == round.level && next.iteration > round.iteration)
    }
}

/// Receives the progress of a solve. The unit type ignores it.
pub trait Observer {
    /// Called after each round.
    fn progress(&mut self, progress: &Progress);
}

impl Observer for () {
    fn progress(&mut self, _: &Progress) {}
}

impl<F: FnMut(&Progress)> Observer for F {
    fn progress(&mut self, progress: &Progress) {
        self(progress);
    }
}

/// Reports the rounds of one grid to an observer.
pub struct Reporter<'a> {
    observer: &'a mut dyn Observer,
    level: usize,
    levels: usize,
    tolerance: f64,
}

impl<'a> Reporter<'a> {
    /// A reporter for grid `level` of `levels`, whose change has to fall below `tolerance`.
    pub fn new(observer: &'a mut dyn Observer, level: usize, levels: usize, tolerance: f64) -> Self {
        Self { observer, level, levels, tolerance }
    }

    /// Reports one round.
    pub fn round(&mut self, iteration: usize, residual: f64, film_load: f64) {
        let Self { level, levels, tolerance, .. } = *self;
        self.observer.progress(&Progress { level, levels, iteration, residual, tolerance, film_load });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_done_grows_from_nothing_to_all() {
        let at = |level, residual| {
            Progress { level, levels: 3, iteration: 1, residual, tolerance: 1e-6, film_load: 0.0 }.fraction()
        };
        assert_eq!((at(0, 2.0), at(2, 1e-7)), (0.0, 1.0));
        assert!(at(0, 1e-3) < at(1, 1e-1) && at(1, 1e-1) < at(2, 1e-1));
        assert_eq!(at(0, f64::NAN), 0.0);
    }

    #[test]
    fn the_last_solve_begins_with_the_coarsest_grid() {
        let round = |level| Progress { level, levels: 3, iteration: 1, residual: 0.1, tolerance: 1e-6, film_load: 0.0 };
        let history = [0, 0, 1, 2, 0, 0, 1].map(round);
        assert_eq!(Progress::last_solve(&history), &history[4..]);
        assert_eq!(Progress::last_solve(&history[..3]), &history[..3]);
        assert!(Progress::last_solve(&[]).is_empty());
    }
}
