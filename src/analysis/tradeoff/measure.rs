//! Measures candidates by interleaved runs, timed by the caller's clock.

use super::candidates::Candidate;
use crate::analysis::attempt::{RunStatus, attempt};
use crate::analysis::quantity::Numbers;
use crate::control::{Cancel, Progress};
use crate::problem::Problem;
use serde::{Deserialize, Serialize};

/// Most repeats of one setting, if their number depends on the time.
const MOST_REPEATS: usize = 31;

/// A run that took less than this \[s\] is timed with its own data in the caches.
const QUICK: f64 = 0.02;

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Effort {
    /// Runs of every setting; `None`: as many as fit into `seconds`, at least one and at most 31.
    pub repeats: Option<usize>,
    /// Time for all runs together, shared equally \[s\]. Each setting has at least one run, whatever its time.
    pub seconds: f64,
    /// A run that takes longer than this \[s\] is given up.
    pub longest: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { repeats: None, seconds: 40.0, longest: 30.0 }
    }
}

/// One setting with its measured runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredSetting {
    /// The setting.
    pub candidate: Candidate,
    /// How its runs ended. They all end alike and differ only in their time.
    pub status: RunStatus,
    /// The numbers; none unless it converged or reached its limit.
    pub numbers: Numbers,
    /// Nodes of one tooth's film (or of the plate's), and steps in a cycle, of the finest grid.
    pub grid: (usize, usize),
    /// Time of each run \[s\].
    pub times: Vec<f64>,
}

/// Measures `candidates` on `problem`, one run at a time on the caller's thread. `clock` gives seconds since any start. `finished` is called
/// after every run with all runs so far and the share of the work that is done, 0 to 1; `Tradeoff::of` computes the curve from them. If
/// cancelled, the runs so far are returned.
pub fn measure(
    problem: &Problem,
    candidates: Vec<Candidate>,
    effort: &Effort,
    clock: &dyn Fn() -> f64,
    cancel: &Cancel,
    finished: &mut dyn FnMut(&[MeasuredSetting], f64),
) -> Vec<MeasuredSetting> {
    let count = candidates.len();
    let blank = |candidate| MeasuredSetting {
        candidate,
        status: RunStatus::Waiting,
        numbers: Numbers::default(),
        grid: (0, 0),
        times: Vec::new(),
    };
    let mut runs: Vec<MeasuredSetting> = candidates.into_iter().map(blank).collect();
    let mut round = 0;
    loop {
        let mut idle = true;
        for i in 0..count {
            if runs[i].times.len() != round || round >= wanted(&runs[i], effort, count) {
                continue;
            }
            idle = false;
            if !run_once(problem, &mut runs[i], effort, clock, cancel) {
                return runs;
            }
            let share = done(&runs, effort);
            finished(&runs, share);
        }
        if idle {
            return runs;
        }
        round += 1;
    }
}

/// The number of runs of a setting.
fn wanted(run: &MeasuredSetting, effort: &Effort, count: usize) -> usize {
    let Some(first) = run.times.first() else { return 1 };
    if matches!(run.status, RunStatus::Failed(_) | RunStatus::GivenUp) {
        return 1;
    }
    let affordable = || (effort.seconds / count as f64 / first.max(1e-9)) as usize;
    effort.repeats.unwrap_or_else(|| affordable().min(MOST_REPEATS)).max(1)
}

/// The share of the work that is done, by time; the first runs still to come are assumed to cost as much as those that are done.
fn done(runs: &[MeasuredSetting], effort: &Effort) -> f64 {
    let (mut spent, mut left, mut waiting) = (0.0, 0.0, 0.0);
    for run in runs {
        match run.times.first() {
            Some(first) => {
                spent += run.times.iter().sum::<f64>();
                left += first * (wanted(run, effort, runs.len()) - run.times.len()) as f64;
            }
            None => waiting += 1.0,
        }
    }
    let each = (spent + left) / (runs.len() as f64 - waiting).max(1.0);
    spent / (spent + left + waiting * each).max(f64::MIN_POSITIVE)
}

/// One run; false if it was cancelled.
fn run_once(
    problem: &Problem,
    run: &mut MeasuredSetting,
    effort: &Effort,
    clock: &dyn Fn() -> f64,
    cancel: &Cancel,
) -> bool {
    let problem = Problem { numerics: run.candidate.numerics, ..problem.clone() };
    let stop = cancel.child();
    if run.times.last().is_some_and(|last| *last < QUICK) {
        // The second of two runs is timed, because at the first the caches still hold other data.
        drop(attempt(&problem, &run.candidate.settings, &mut (), &stop));
    }
    let started = clock();
    let mut watch = |_: &Progress| {
        if clock() - started > effort.longest {
            stop.cancel();
        }
    };
    let solved = attempt(&problem, &run.candidate.settings, &mut watch, &stop);
    let time = clock() - started;
    if cancel.is_cancelled() {
        return false;
    }
    run.times.push(time);
    match solved {
        Ok(solution) => {
            run.status = solution.status.into();
            if run.status != RunStatus::GivenUp {
                run.numbers = Numbers::of(&problem, &solution);
            }
            run.grid = (solution.stats.film_nodes, solution.stats.steps_per_cycle);
        }
        Err(reason) => run.status = RunStatus::Failed(reason),
    }
    true
}
