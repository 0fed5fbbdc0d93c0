//! Start-up: the transient from rest, cycle after cycle, until it repeats.
//!
//! At t = 0 the wave stands still at its full amplitude, pressed against the rotor, and the gas is at ambient pressure; then it
//! travels. Every tooth is marched and nothing is accelerated, because the way is the result. A plate is at rest at its mean gap and
//! moves away from the wall first; its first cycle begins a quarter of a period later, where the gap is widest. It ends where the periodic
//! solve, which is made first, says: `tests/startup.rs` compares the two.
//!
//! The mean of a cycle that does not repeat is that of the trapezoidal rule, from its first instant to the first of the next. How exact a
//! start-up is, is judged by the headline of every cycle, as a share of the greatest of them. The way is marched to its end on the grids
//! that the periodic state needed; then the cycles up to the last that is not yet as accurate as was asked are marched again on grids of
//! half the spacing, and so on.

use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::fidelity::Fidelity;
use crate::ladder::{TransientCycle, error_across};
use crate::memory::{self, Need};
use crate::motor;
use crate::plan::{Decision, Grid, Plan};
use crate::plate;
use crate::problem::{Numerics, Problem, Scenario, Time};
use crate::recording::Recording;
use crate::solution::{Accuracy, Outcome, PlateResult, Solution, Stats, Status, settled};
use crate::solve::{self, Record, SolveError, accuracy, solve};
use serde::{Deserialize, Serialize};

/// Share of the error asked for that the nodes across may have.
const WIDTH_AIM: f64 = 0.3;

/// One cycle of the transient.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Cycle {
    /// Number of the cycle, from 1. A cycle with a number that was reported before is the same cycle on finer grids, and replaces it.
    pub number: usize,
    /// Means and extremes over this cycle, with the error that its grids show.
    pub outcome: Outcome,
    /// Largest change of ln Z from its beginning to its end.
    pub change: f64,
    /// By how much ln Z may still change until the cycle repeats, or α or a plate's mean load as a share of itself (of its unit, if it is
    /// smaller), if that is more: if changes go on to shrink as they did, and at least as far as the periodic state is away, beyond what
    /// either is inexact by. Infinite at first.
    pub remaining: f64,
    /// Fields; the first frame is the beginning of the cycle.
    pub recording: Recording,
}

impl Cycle {
    /// The same cycle with only the film load over the period of its fields.
    pub fn slim(&self) -> Self {
        let Recording { period, film_load, .. } = &self.recording;
        let recording = Recording { period: *period, film_load: film_load.clone(), ..Recording::default() };
        Self { recording, ..*self }
    }
}

/// How a start-up is computed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Accuracy of every cycle's headline, as a fraction of the greatest headline of any cycle.
    pub fidelity: Fidelity,
    /// Cycles at most.
    pub cycles: usize,
    /// The start-up ends once [`Cycle::remaining`] is below this.
    pub tolerance: f64,
    /// Cycles that the caller keeps at a time: the estimate of memory counts them.
    pub kept: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { fidelity: Fidelity::Standard, cycles: 300, tolerance: 1e-3, kept: 1 }
    }
}

/// How a start-up ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Startup {
    /// Converged: the cycle repeats, and film and contact agreed in every step on the way.
    pub status: Status,
    /// Cycles completed.
    pub cycles: usize,
    /// Result of the last cycle; zeros if there is none.
    pub outcome: Outcome,
    /// [`Cycle::remaining`] of the last cycle.
    pub remaining: f64,
    /// Accuracy of the cycle that is known the least exactly.
    pub accuracy: Accuracy,
    /// The headline of the periodic solve, α or a plate's mean load \[N or N/m\]: where it should end. `None` if that did not converge.
    pub steady: Option<Estimate>,
    /// Cost on all grids, without the periodic solve.
    pub stats: Stats,
    /// The decisions about the parts of the model.
    pub decisions: Vec<Decision>,
    /// Warnings about the scene for the user.
    pub warnings: Vec<String>,
}

impl Startup {
    /// A start-up that was cancelled before it had any result.
    pub fn cancelled() -> Self {
        Self {
            status: Status::Cancelled,
            cycles: 0,
            outcome: Outcome::Plate(PlateResult::default()),
            remaining: f64::INFINITY,
            accuracy: Accuracy::default(),
            steady: None,
            stats: Stats::default(),
            decisions: Vec::new(),
            warnings: Vec::new(),
        }
    }
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
    let numbers = solve::Settings { fidelity: settings.fidelity, record: Record::Numbers, ..Default::default() };
    let periodic = match solve(problem, &numbers, &mut (), cancel) {
        // There may be a transient although its end is not found at once.
        Err(SolveError::Motor(_) | SolveError::Plate(_)) => None,
        solved => Some(solved?),
    };
    // A plate under a load starts at the gap at which it floats.
    let found = periodic.as_ref().map(|periodic| settled(problem, &periodic.outcome));
    let problem = found.as_deref().unwrap_or(problem);
    let cancel = &cancel.started();
    let known = periodic.as_ref().filter(|_| !cancel.has_budget()).map_or(0, |known| known.stats.steps_per_cycle);
    let mut plan = plan(problem, settings, known, cancel)?;
    let mut run = StartupRun::new(problem, settings, periodic.as_ref(), each);
    let mut stopped = match run.march(&plan, None, cancel) {
        // A polynomial across may oscillate to negative pressure; finite volumes cannot.
        Err(SolveError::Motor(_) | SolveError::Plate(_)) if plan.spectral => {
            plan = plan.volumes();
            run.march(&plan, None, cancel)
        }
        marched => marched,
    }?;
    while !stopped && !cancel.is_spent() {
        let allowed = plan.accuracy * run.unit;
        let Some(cycles) = run.unresolved(allowed) else { break };
        let Some(finer) = finer(problem, &plan, settings.kept) else { break };
        plan = finer;
        let before = run.worst();
        match run.march(&plan, Some(cycles), &cancel.within_budget()) {
            Ok(cut) => stopped = cut && cancel.is_cancelled(),
            // The result of the coarser grids remains valid.
            Err(_) => break,
        }
        // The remaining grids would not be enough.
        let left = plan.most_grids.saturating_sub(plan.grids.len());
        if run.worst() * (run.worst() / before).powi(left as i32) > allowed {
            break;
        }
    }
    Ok(run.end(&plan, stopped, cancel))
}

/// The grids to begin with: the plan's own, or finer ones up to so many `steps` a cycle, with which the periodic state was as accurate as
/// was asked; coarse ones if there is a budget.
fn plan(problem: &Problem, settings: &Settings, steps: usize, cancel: &Cancel) -> Result<Plan, SolveError> {
    // A transient leaks, so the limit of trapped gas does not apply.
    let numerics = Numerics { time: Time::March, ..problem.numerics };
    let (fidelity, spec) = (settings.fidelity, settings.fidelity.spec());
    let spec = if cancel.has_budget() { spec.from_coarse() } else { spec };
    let mut plan = match &problem.scenario {
        Scenario::Motor(motor) => {
            Plan::motor_to(motor, fidelity, &spec, &numerics, cancel).map_err(motor::MotorError::from)?
        }
        Scenario::Plate(plate) => Plan::plate_to(plate, fidelity, &spec, &numerics),
    };
    let finest = |plan: &Plan| plan.grids.last().map_or(0, |grid| grid.steps);
    while finest(&plan) < steps {
        let Some(finer) = finer(problem, &plan, settings.kept) else { break };
        plan = finer;
    }
    Ok(plan)
}

/// The next finer grids; `None` if the plan allows no further one, or the memory does not.
fn finer(problem: &Problem, plan: &Plan, kept: usize) -> Option<Plan> {
    let finer = plan.finer();
    let bytes = need(problem, &finer, kept).bytes;
    (plan.most_grids > plan.grids.len() && bytes <= memory::REFINED.min(memory::allowed())).then_some(finer)
}

fn need(problem: &Problem, plan: &Plan, kept: usize) -> Need {
    match &problem.scenario {
        Scenario::Motor(motor) => memory::motor_startup(motor, plan, kept),
        Scenario::Plate(plate) => memory::plate_startup(plate, plan, kept),
    }
}

/// A start-up that is being marched.
struct StartupRun<'a> {
    problem: &'a Problem,
    settings: &'a Settings,
    each: &'a mut dyn FnMut(Cycle),
    /// What is known of it so far.
    found: Startup,
    /// Reference for relative errors, α or N: the greatest headline of any cycle, that of the periodic state included.
    unit: f64,
    /// Reference from the periodic state alone; 0 if it is not known.
    steady_unit: f64,
    /// Stated error of each cycle's headline, absolute, and what of it finer grids would leave.
    errors: Vec<(f64, f64)>,
    /// Largest residual of a step that did not settle, and what was allowed.
    unsettled: Option<(f64, f64)>,
}

impl<'a> StartupRun<'a> {
    fn new(
        problem: &'a Problem,
        settings: &'a Settings,
        periodic: Option<&Solution>,
        each: &'a mut dyn FnMut(Cycle),
    ) -> Self {
        let (nothing, warnings) = match &problem.scenario {
            Scenario::Motor(motor) => (Outcome::Motor(Default::default()), motor.compliance_not_covered()),
            Scenario::Plate(_) => (Outcome::Plate(Default::default()), None),
        };
        let unit = match periodic.map_or(nothing, |periodic| periodic.outcome) {
            Outcome::Motor(result) => motor::unit(result.alpha.value),
            Outcome::Plate(result) => {
                plate::unit(result.film_load.value, result.film_load_max.value - result.film_load_min.value)
            }
        };
        let converged = periodic.filter(|periodic| periodic.status == Status::Converged);
        let found = Startup {
            status: Status::NotConverged { residual: f64::INFINITY, tolerance: settings.tolerance },
            outcome: nothing,
            steady: converged.map(|periodic| headline(&periodic.outcome)),
            warnings: warnings.into_iter().collect(),
            ..Startup::cancelled()
        };
        let steady_unit = if periodic.is_some() { unit } else { 0.0 };
        Self { problem, settings, each, found, unit, steady_unit, errors: Vec::new(), unsettled: None }
    }

    /// Marches from rest by `plan`: to the end, or so many cycles `again`. Whether it was cut short.
    fn march(&mut self, plan: &Plan, again: Option<usize>, cancel: &Cancel) -> Result<bool, SolveError> {
        let _taken = memory::take(need(self.problem, plan, self.settings.kept), cancel)?;
        let mut stats = self.found.stats;
        let mut next = from_rest(self.problem, plan, self.unit, &mut stats, cancel)?;
        if again.is_none() {
            self.errors.clear();
        }
        let tolerance = self.settings.tolerance;
        let (mut last, mut before) = (f64::INFINITY, 0.0);
        // A last cycle that is marched again may turn out not to be the last.
        let again = again.filter(|cycles| *cycles < self.errors.len());
        for number in 1..=again.unwrap_or(self.settings.cycles) {
            let turned = next(&mut stats, cancel)?;
            self.found.stats = stats;
            let Some(TransientCycle { outcome, recording, change, elsewhere, unsettled }) = turned else {
                return Ok(true);
            };
            self.unsettled = [self.unsettled, unsettled].into_iter().flatten().max_by(|a, b| a.0.total_cmp(&b.0));
            let Estimate { value, error } = headline(&outcome);
            self.unit = self.unit.max(value.abs());
            // A small vibration hardly changes ln Z, and has a mean load that is smaller still.
            let moved = change.max((value - before).abs() / self.steady_unit.max(value.abs()));
            // The change of the next cycles, as a geometric series; a sudden fall is not trusted to go on.
            let ratio = (change / last).max(0.5);
            let remaining = if change == 0.0 {
                0.0
            } else if last.is_finite() && ratio < 1.0 {
                moved * ratio / (1.0 - ratio)
            } else {
                f64::INFINITY
            };
            let towards = self.found.steady.filter(|_| number > 1).map_or(0.0, |steady| {
                let (moving, left) = (value - before, steady.value - value);
                // A motor may have two states, and settle in the other one.
                let motor = matches!(self.problem.scenario, Scenario::Motor(_));
                let rests = moved < tolerance / self.settings.cycles as f64;
                let other = motor && (moving * left <= 0.0 || rests);
                let known = steady.error.abs() + error.min(self.unit);
                if other { 0.0 } else { (left.abs() - known).max(0.0) / self.steady_unit.max(value.abs()) }
            });
            let remaining = remaining.max(towards);
            (last, before) = (change, value);
            let error = (error, elsewhere);
            if number > self.errors.len() {
                self.errors.push(error);
            } else {
                self.errors[number - 1] = error;
            }
            if number == self.errors.len() {
                (self.found.outcome, self.found.remaining) = (outcome, remaining);
                self.found.status = Status::NotConverged { residual: remaining, tolerance };
            }
            let recording = Recording { transient: true, ..recording };
            (self.each)(Cycle { number, outcome, change, remaining, recording });
            if again.is_none() && number == self.errors.len() && remaining < tolerance {
                break;
            }
        }
        if self.found.remaining < tolerance {
            self.found.status = Status::Converged;
        }
        Ok(false)
    }

    /// The last cycle that needs finer grids, and that they would make as accurate as `allowed`.
    fn unresolved(&self, allowed: f64) -> Option<usize> {
        self.errors.iter().rposition(|(error, elsewhere)| *error > allowed && *elsewhere < allowed).map(|last| last + 1)
    }

    /// The largest error of a cycle's headline, absolute.
    fn worst(&self) -> f64 {
        self.errors.iter().map(|(error, _)| *error).fold(0.0, f64::max)
    }

    fn end(self, plan: &Plan, stopped: bool, cancel: &Cancel) -> Startup {
        let worst = if self.errors.is_empty() { f64::INFINITY } else { self.worst() };
        let unsettled = self.unsettled.map(|(residual, tolerance)| Status::NotConverged { residual, tolerance });
        Startup {
            status: if stopped { Status::Cancelled } else { unsettled.unwrap_or(self.found.status) },
            cycles: self.errors.len(),
            accuracy: accuracy(plan, worst, self.unit, cancel),
            decisions: plan.decisions.clone(),
            ..self.found
        }
    }
}

/// α, or a plate's mean load \[N or N/m\].
fn headline(outcome: &Outcome) -> Estimate {
    match outcome {
        Outcome::Motor(result) => result.alpha,
        Outcome::Plate(result) => result.film_load,
    }
}

/// The headline, least and greatest load \[N or N/m\], and highest pressure \[Pa\].
fn extremes(outcome: &Outcome) -> [f64; 4] {
    let others = match outcome {
        Outcome::Motor(result) => [result.film_load_min, result.film_load_max, result.max_pressure],
        Outcome::Plate(result) => [result.film_load_min, result.film_load_max, result.max_pressure],
    };
    let [least, greatest, pressure] = others.map(|found| found.value);
    [headline(outcome).value, least, greatest, pressure]
}

/// The next cycle of either scene; `None` if cancelled.
type March<'a> = Box<dyn FnMut(&mut Stats, &Cancel) -> Result<Option<TransientCycle>, SolveError> + 'a>;

/// From rest, with as many nodes across as the first cycle needs, which is the hardest; what that takes is added to `stats`.
fn from_rest<'a>(
    problem: &'a Problem,
    plan: &Plan,
    unit: f64,
    stats: &mut Stats,
    cancel: &Cancel,
) -> Result<March<'a>, SolveError> {
    if !plan.spectral || plan.grids.len() < 2 {
        return on(problem, plan, [0.0; 4], stats);
    }
    let coarsest = plan.grids[0];
    let with = |across: usize, grid: &Grid| Grid { across, ..*grid };
    let first = |across: usize| -> Result<[f64; 4], SolveError> {
        let grids = vec![with(across, &coarsest)];
        let (plan, mut stats) = (Plan { grids, maps: false, ..plan.clone() }, Stats::default());
        let cycle = on(problem, &plan, [0.0; 4], &mut stats)?(&mut stats, cancel)?;
        Ok(cycle.map_or([0.0; 4], |cycle| extremes(&cycle.outcome)))
    };
    let mut across = coarsest.across.max(2);
    let (mut narrower, mut before) = (first(across - 1)?, [0.0; 4]);
    let errors = loop {
        let wider = first(across)?;
        let changes: [f64; 4] = std::array::from_fn(|k| (wider[k] - narrower[k]).abs());
        let errors: [f64; 4] = std::array::from_fn(|k| error_across(changes[k], before[k]));
        if errors[0] <= WIDTH_AIM * plan.target_error * unit || across >= plan.most_across {
            break errors;
        }
        (narrower, before) = (wider, changes);
        across += 1;
    };
    let grids = plan.grids.iter().map(|grid| with(across, grid)).collect();
    on(problem, &Plan { grids, ..plan.clone() }, errors, stats)
}

/// From rest on the grids of `plan`; `width_errors` are those of the nodes across, of the headline and of the other [`extremes`].
fn on<'a>(
    problem: &'a Problem,
    plan: &Plan,
    width_errors: [f64; 4],
    stats: &mut Stats,
) -> Result<March<'a>, SolveError> {
    Ok(match &problem.scenario {
        Scenario::Motor(motor) => {
            let mut transient = motor::MotorTransient::at_rest(motor, plan, width_errors[0])?;
            Box::new(move |stats, cancel| Ok(transient.cycle(stats, cancel)?))
        }
        Scenario::Plate(plate) => {
            let mut transient = plate::PlateTransient::at_rest(plate, plan, width_errors, stats)?;
            Box::new(move |stats, cancel| Ok(transient.cycle(stats, cancel)?))
        }
    })
}
