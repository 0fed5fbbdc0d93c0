//! Solves a motor or a plate: takes a problem and settings, and returns a solution. [`near`] solves neighbouring problems with one plan, so that
//! differences of their results are accurate.

pub mod near;

use crate::control::{Cancel, Observer};
use crate::digits::percent;
use crate::drive::{self, Scaled};
use crate::estimate::Estimate;
use crate::fidelity::{Fidelity, Spec};
use crate::film::cycle::Interrupted;
use crate::ladder::Periodic;
use crate::memory::{self, MemoryExcess};
use crate::motor::{self, MotorError, Warm};
use crate::paper;
use crate::plan::{Decision, Plan};
use crate::plate::floating::{FloatError, float};
use crate::plate::{self, harmonic};
use crate::problem::{Motor, Plate, Problem, Scenario};
use crate::recording::Recording;
use crate::solution::{Accuracy, Floating, Model, Outcome, PlateResult, Solution, Status, StoppedBy, settled};
use crate::surface::Surface;
use serde::{Deserialize, Serialize};

/// How to solve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// Our own method: only what the scene needs, at a fidelity.
    #[default]
    Auto,
    /// The paper's algorithm, literally.
    Paper,
}

impl Method {
    /// The name used on the command line and in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Paper => "paper",
        }
    }
}

/// Which fields are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Record {
    /// All of them.
    #[default]
    Everything,
    /// None: the numbers only, as a sweep needs them.
    Numbers,
}

/// Settings of a solve: accuracy, algorithm and what is recorded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// Accuracy of `Method::Auto`.
    pub fidelity: Fidelity,
    /// Algorithm.
    pub method: Method,
    /// Which fields are kept.
    pub record: Record,
}

/// Why there is no solution at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The motor.
    #[error(transparent)]
    Motor(#[from] MotorError),
    /// The plate.
    #[error("film, {0}")]
    Plate(#[from] Interrupted),
    /// A plate that does not float.
    #[error(transparent)]
    Float(#[from] FloatError),
    /// The paper has no plate.
    #[error("method = paper is for motors: it has no plate scene; allowed here: auto")]
    PaperPlate,
    /// The paper has a hard stop and smooth walls.
    #[error(
        "method = paper is for faces that meet at a minimum spacing, without flow factors; surface.model and surface.flow_factors need method = auto"
    )]
    PaperSurface,
    /// It needs more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryExcess),
}

impl SolveError {
    /// Whether the fault is in the input. [`check`] finds such faults before anything is solved, except that a plate does not float.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::PaperPlate | Self::PaperSurface | Self::Memory(_) => true,
            Self::Motor(MotorError::Rotor(rotor)) => !rotor.is_cancelled(),
            Self::Float(error) => matches!(error, FloatError::Rests { .. } | FloatError::High | FloatError::Memory(_)),
            Self::Motor(_) | Self::Plate(_) => false,
        }
    }
}

/// Whether `problem` may be solved so: whether the method has such a scene, the rotor has a compliance, and the memory is allowed.
///
/// # Errors
/// [`SolveError::PaperPlate`], [`SolveError::PaperSurface`], [`MotorError::Rotor`] or [`SolveError::Memory`].
pub fn check(problem: &Problem, settings: &Settings) -> Result<(), SolveError> {
    let (_, need) = planned(problem, settings, &settings.fidelity.spec(), &Cancel::new())?;
    Ok(memory::check(need)?)
}

/// The plan, unless the paper's method is used, and the memory that is needed.
fn planned(
    problem: &Problem,
    settings: &Settings,
    spec: &Spec,
    cancel: &Cancel,
) -> Result<(Option<Plan>, memory::Need), SolveError> {
    Ok(match (&problem.scenario, settings.method) {
        (Scenario::Motor(motor), Method::Auto) => {
            let plan = motor_plan(motor, problem, settings, spec, cancel)?;
            let need = memory::motor(motor, &plan);
            (Some(plan), need)
        }
        (Scenario::Plate(plate), Method::Auto) => {
            let plan = plate_plan(plate, problem, settings, spec);
            let need = memory::plate(plate, &plan);
            (Some(plan), need)
        }
        (Scenario::Motor(motor), Method::Paper) if motor.surface != Surface::default() => {
            return Err(SolveError::PaperSurface);
        }
        (Scenario::Motor(motor), Method::Paper) => {
            let paper::Mesh { nx, ny, n, steps } = paper::Mesh::of(&problem.numerics);
            // Resolved before anything is taken, and kept.
            motor.compliances(n / 2, cancel).map_err(MotorError::from)?;
            (None, memory::paper(motor, (nx, ny, n, steps)))
        }
        (Scenario::Plate(_), Method::Paper) => return Err(SolveError::PaperPlate),
    })
}

fn motor_plan(
    motor: &Motor,
    problem: &Problem,
    settings: &Settings,
    spec: &Spec,
    cancel: &Cancel,
) -> Result<Plan, MotorError> {
    let maps = settings.record == Record::Everything;
    let plan = Plan { maps, ..Plan::motor_to(motor, settings.fidelity, spec, &problem.numerics, cancel)? };
    Ok(memory::within(plan, |plan| memory::motor(motor, plan)))
}

fn plate_plan(plate: &Plate, problem: &Problem, settings: &Settings, spec: &Spec) -> Plan {
    let maps = settings.record == Record::Everything;
    let plan = Plan { maps, ..Plan::plate_to(plate, settings.fidelity, spec, &problem.numerics) };
    memory::within(plan, |plan| memory::plate(plate, plan))
}

/// Solves `problem` for its periodic steady state.
///
/// Reaching a limit or being cancelled is a [`Status`], not an error.
///
/// # Errors
/// [`SolveError`] when a step has no solution to working precision, the method does not apply, or it would need more memory
/// than is allowed ([`memory::allow`]).
pub fn solve(
    problem: &Problem,
    settings: &Settings,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Solution, SolveError> {
    solve_from(&mut Warm::default(), problem, settings, observer, cancel)
}

/// As [`solve`], started from what a similar problem at the same fidelity left in `warm`: fewer rounds, the same result
/// to the stated error.
///
/// # Errors
/// As [`solve`].
pub fn solve_from(
    warm: &mut Warm,
    problem: &Problem,
    settings: &Settings,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Solution, SolveError> {
    let mut solution = solve_on_best_grids(warm, problem, settings, observer, cancel)?;
    let Accuracy { asked, stated, stopped_by } = solution.accuracy;
    // An error larger than the result itself is negligible, or the result is not resolved.
    let matters = solution.status == Status::Converged && stated < 1.0;
    if matters && asked > 0.0 && stopped_by == StoppedBy::Limit {
        let [stated, asked] = [stated, asked].map(percent);
        let missed = format!("less accurate than asked for: the stated error is {stated}, not {asked}; {EXHAUSTED}");
        solution.warnings.push(missed);
    }
    Ok(solution)
}

/// As [`solve_from`], on the grids that are asked for or on those of a coarser level, if they state a smaller error.
fn solve_on_best_grids(
    warm: &mut Warm,
    problem: &Problem,
    settings: &Settings,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Solution, SolveError> {
    let found = solve_as_asked(warm, problem, settings, observer, cancel)?;
    let Some(coarser) = coarser(&found, settings, cancel) else { return Ok(found) };
    let rough = Settings { fidelity: coarser, ..*settings };
    // The progress of this solve is not reported, and its failure changes nothing.
    match solve_on_best_grids(&mut Warm::default(), problem, &rough, &mut (), cancel) {
        Ok(other) if other.status == Status::Converged && other.accuracy.stated < found.accuracy.stated => {
            Ok(in_place_of(found, other, coarser))
        }
        _ => Ok(found),
    }
}

/// The next coarser level, if the result `found` is less accurate than that level promises, so that it may do better: on finer grids
/// contact may open, or a coarse one have no periodic state.
fn coarser(found: &Solution, settings: &Settings, cancel: &Cancel) -> Option<Fidelity> {
    let Accuracy { asked, stated, stopped_by } = found.accuracy;
    let ended = matches!(found.status, Status::Converged | Status::NotResolved { .. });
    let short = ended && asked > 0.0 && stopped_by == StoppedBy::Limit && !cancel.has_budget();
    let levels = settings.fidelity.and_coarser();
    let (_, coarser) = levels.split_last().filter(|_| short && settings.method == Method::Auto)?;
    coarser.last().copied().filter(|level| stated > level.accuracy())
}

/// The result `other` of a `coarser` level, which states a smaller error than the one `found` at the level asked for.
fn in_place_of(found: Solution, mut other: Solution, coarser: Fidelity) -> Solution {
    let Accuracy { asked, .. } = found.accuracy;
    let stopped_by = if other.accuracy.stated <= asked { StoppedBy::Accuracy } else { StoppedBy::Limit };
    other.accuracy = Accuracy { asked, stopped_by, ..other.accuracy };
    other.stats.add_cost(&found.stats);
    // The level may have been replaced by a still coarser one itself.
    if other.model.remarks.is_empty() {
        other.model.remarks.push(format!(
            "grids: those of {coarser}, because finer ones, as asked for, left a larger error ({})",
            percent(found.accuracy.stated)
        ));
    }
    if found.status == Status::Converged {
        let missed = found.warnings.into_iter().filter(|warning| !other.warnings.contains(warning));
        other.warnings.extend(missed.collect::<Vec<_>>());
    }
    other.model.fidelity = found.model.fidelity;
    other
}

/// As [`solve_from`], on the grids of the fidelity that is asked for alone.
fn solve_as_asked(
    warm: &mut Warm,
    problem: &Problem,
    settings: &Settings,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Solution, SolveError> {
    // The time to compute a ring counts towards the budget, too.
    let cancel = &cancel.started();
    let spec = settings.fidelity.spec();
    let spec = if cancel.has_budget() { spec.from_coarse() } else { spec };
    let (plan, need) = planned(problem, settings, &spec, cancel)?;
    if let (Scenario::Plate(plate @ Plate { load: Some(load), .. }), Method::Auto) =
        (&problem.scenario, settings.method)
    {
        memory::check(need)?;
        return floated(plate, *load, problem, settings, &spec, observer, cancel);
    }
    let taken = memory::take(need, cancel)?;
    let mut solution = match (&problem.scenario, plan) {
        (Scenario::Motor(motor), Some(plan)) => {
            let warm_start = !warm.is_empty();
            let mut found = motor::periodic_from(warm, motor, &plan, observer, cancel)?;
            let other = touching(&mut found, motor, &plan, observer, cancel);
            let mut solution = of_motor(found, motor, &plan, cancel);
            solution.warnings.extend(other.as_ref().map(bistable));
            solution.stats.warm_start = warm_start;
            solution
        }
        (Scenario::Plate(plate), Some(plan)) => {
            let found = plate::periodic(plate, &plan, observer, cancel)?;
            of_plate(found, &plan, cancel)
        }
        (Scenario::Motor(motor), None) => {
            paper::solve(motor, &problem.numerics, observer, cancel).map_err(MotorError::from)?
        }
        (Scenario::Plate(_), None) => return Err(SolveError::PaperPlate),
    };
    if let Scenario::Motor(motor) = &problem.scenario {
        solution.warnings.extend(motor.compliance_not_covered());
    }
    if taken.bytes() > memory::REFINED {
        *warm = Warm::default();
    }
    let mut solution = performed(problem, solution);
    if settings.record == Record::Numbers {
        solution.recording = Recording::default();
    }
    Ok(solution)
}

fn of_motor(found: motor::Periodic, motor: &Motor, plan: &Plan, cancel: &Cancel) -> Solution {
    let (alpha, teeth) = (found.result.alpha, if plan.every_tooth { motor.teeth } else { 1 });
    solution(found, Outcome::Motor, accuracy(plan, alpha.error, motor::unit(alpha.value), cancel), plan, teeth)
}

fn of_plate(found: plate::Periodic, plan: &Plan, cancel: &Cancel) -> Solution {
    let load = found.result.film_load;
    solution(found, Outcome::Plate, accuracy(plan, load.error, load.value.abs(), cancel), plan, 1)
}

fn solution<R>(
    found: Periodic<R>,
    outcome: fn(R) -> Outcome,
    accuracy: Accuracy,
    plan: &Plan,
    teeth_solved: usize,
) -> Solution {
    Solution {
        warnings: warnings(&found.status, plan, &accuracy),
        accuracy,
        status: found.status,
        outcome: outcome(found.result),
        performance: None,
        harmonic: None,
        stats: found.stats,
        model: Model {
            fidelity: plan.fidelity.clone(),
            method: Method::Auto.name().to_owned(),
            teeth_solved,
            half_width: plan.half_width,
            shear: plan.shear,
            remarks: Vec::new(),
            decisions: plan.decisions.clone(),
        },
        recording: found.recording,
    }
}

/// Finds the gap at which a plate floats under its `load` \[N or N/m\].
fn floated(
    plate: &Plate,
    load: f64,
    problem: &Problem,
    settings: &Settings,
    spec: &Spec,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Solution, SolveError> {
    let rough = Settings { fidelity: Fidelity::Draft, record: Record::Numbers, ..*settings };
    let roughly = |plate: &Plate| plate_plan(plate, problem, &rough, &rough.fidelity.spec());
    let asked = |plate: &Plate| plate_plan(plate, problem, settings, spec);
    match float(plate, load, &roughly, &asked, observer, cancel) {
        Ok((periodic, plan)) => {
            let mut solution = of_plate(periodic, &plan, cancel);
            if let Outcome::Plate(PlateResult { floating: Some(floating), .. }) = solution.outcome {
                let Estimate { value, error } = floating.mean_gap;
                solution.accuracy = accuracy(&plan, error, value, cancel);
                solution.warnings.extend(unstable(&floating));
            }
            solution = performed(problem, solution);
            if settings.record == Record::Numbers {
                solution.recording = Recording::default();
            }
            Ok(solution)
        }
        Err(FloatError::Film(Interrupted::Cancelled)) => {
            Ok(of_plate(plate::Periodic::ended(Status::Cancelled), &asked(plate), cancel))
        }
        Err(error) => Err(error.into()),
    }
}

/// A warning that the plate does not float stably, or that its stability is not known.
fn unstable(floating: &Floating) -> Option<String> {
    let warning = match floating.stability() {
        Some(true) => return None,
        Some(false) => "not stable: where the film carries the load, it carries more at a greater gap",
        None => {
            "stability not known: the stated error of the stiffness at this height is as large as the stiffness itself; ask for more accuracy, or allow more time"
        }
    };
    Some(warning.to_owned())
}

/// The solution with what its fields tell: torque, power and efficiency of a motor, and the first harmonic of a plate's load.
fn performed(problem: &Problem, mut solution: Solution) -> Solution {
    let problem = &*settled(problem, &solution.outcome);
    match (&problem.scenario, &solution.outcome) {
        _ if solution.recording.frames == 0 => {}
        (Scenario::Motor(motor), Outcome::Motor(result)) => {
            let found = Scaled::with_film(motor, result, &solution.recording).performance(&[]);
            solution.warnings.extend(drive::warnings(motor, result, &found));
            solution.performance = Some(found);
        }
        (Scenario::Plate(plate), Outcome::Plate(result)) => {
            solution.harmonic = harmonic::solved(plate, result, &solution.recording);
        }
        // A solver answers in kind.
        (Scenario::Motor(_), Outcome::Plate(_)) | (Scenario::Plate(_), Outcome::Motor(_)) => {}
    }
    solution
}

/// How exact a headline with this error is, relative to `unit`, and why it is no more so.
pub(crate) fn accuracy(plan: &Plan, error: f64, unit: f64, cancel: &Cancel) -> Accuracy {
    let stated = if error == 0.0 { 0.0 } else { error / unit };
    let stopped_by = if stated <= plan.accuracy {
        StoppedBy::Accuracy
    } else if cancel.is_spent() {
        StoppedBy::Budget
    } else {
        StoppedBy::Limit
    };
    Accuracy { asked: plan.accuracy, stated, stopped_by }
}

/// α of the state in which teeth touch, if the one `found` floats, or nearly, and the motor has both. Looked for where fields are kept,
/// which a sweep does not, or nothing converged, and no budget of time is set; if `found` is less certain, it is replaced.
fn touching(
    found: &mut motor::Periodic,
    motor: &Motor,
    plan: &Plan,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Option<Estimate> {
    let floats = |alpha: f64| alpha > motor::NEARLY_FLOATS;
    let astray = matches!(found.status, Status::NotConverged { .. });
    let asked = (plan.maps || astray) && !cancel.has_budget();
    if !asked || !astray && !found.headlines.iter().any(|alpha| floats(*alpha)) {
        return None;
    }
    // The progress of this solve is reported only if its result is used.
    let mut nobody = ();
    let observer: &mut dyn Observer = if astray { observer } else { &mut nobody };
    let other = motor::touching(motor, plan, &mut found.stats, observer, cancel)?;
    let [here, there] = [&found.result, &other.result].map(|result| result.alpha);
    if found.status == Status::Converged && floats(here.value) {
        return Some(there).filter(|there| here.value - there.value > here.error + there.error);
    }
    if found.status != Status::Converged || there.error < here.error {
        *found = other;
    }
    None
}

fn bistable(other: &Estimate) -> String {
    format!(
        "bistable: in this result the rotor floats, or nearly; in another one the teeth carry more of the load, with alpha = {:.4} ± {:.4}; which of the two a motor is in depends on how it got there",
        other.value, other.error
    )
}

/// Relative error beyond which a result is reported as indistinguishable from zero.
const NOTHING: f64 = 1e6;
/// Share of a result that a switch leaves out, from which it is named.
const TOO_MUCH: f64 = 0.5;

/// Why a result is less accurate than asked for.
const EXHAUSTED: &str = "finer grids would not reduce it, or would take too long";

fn warnings(status: &Status, plan: &Plan, accuracy: &Accuracy) -> Vec<String> {
    match status {
        Status::Converged => Vec::new(),
        Status::NotConverged { residual, tolerance } => vec![format!(
            "not converged: further rounds would still change it by {residual:.1e}, allowed {tolerance:.0e}; the numbers are what was reached"
        )],
        Status::NotResolved { error } => {
            let size = match *error < NOTHING {
                true => format!("the stated error is {error:.1} times the result itself"),
                false => "the result cannot be told from zero".to_owned(),
            };
            let switch = plan.decisions.iter().find(|decision| decision.forced() >= TOO_MUCH).and_then(Decision::key);
            let advice = match switch {
                Some(key) => format!("{key} leaves out as much as there is: do without it"),
                None if accuracy.stopped_by == StoppedBy::Limit => EXHAUSTED.to_owned(),
                None => "ask for more accuracy".to_owned(),
            };
            vec![format!("not resolved: {size}; {advice}")]
        }
        Status::Cancelled => vec!["cancelled: the numbers are what was reached".to_owned()],
    }
}
