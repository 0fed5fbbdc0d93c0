//! Tries the tasks of a lesson without a window: carries out the actions in `try` and `wrong`, and evaluates the check after each of them.

use super::check::{Check, Ran, Reading};
use super::lesson::{Act, Answer, Doing, Lesson, Step, Task};
use super::live::{Live, Readings};
use super::text::readings;
use crate::analysis::quantity::Numbers;
use crate::analysis::torque::TorqueCurves;
use crate::control::{Cancel, Progress};
use crate::export::startup::CycleRow;
use crate::fidelity::Fidelity;
use crate::hold::{Hold, leak_time};
use crate::plan::Plan;
use crate::problem::{Numerics, Problem, Scenario};
use crate::scene::Scene;
use crate::solution::{Status, settled};
use crate::solve::{Settings, solve};
use crate::startup::{self, startup};
use std::collections::BTreeMap;

/// The fidelity of the runs that are checked, the same as in the window.
const FIDELITY: Fidelity = Fidelity::Fine;
/// Duration of a push by hand, in leak times of the film.
const PUSH: f64 = 0.1;
/// Duration of the hold after the push, in leak times.
const KEPT: f64 = 8.0;
/// Number of evaluations of the check during the hold.
const LOOKS: usize = 80;

/// A fault of a step, or advice about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Number of the step, from 1.
    pub step: usize,
    /// Its title.
    pub title: String,
    /// The fault.
    pub fault: StepFault,
}

/// A fault of a step.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepFault {
    /// The check holds for the scene that the step begins with.
    #[error("the check holds from the start: there is nothing to do")]
    TrueFromStart,
    /// The actions in `try` do not fulfil the check; the reason.
    #[error("try does not fulfil the check: {0}")]
    TryFails(String),
    /// The actions in `try` fulfil `too_far`.
    #[error("try goes too far: too_far holds")]
    TryTooFar,
    /// The actions in `wrong` fulfil the check.
    #[error("wrong fulfils the check")]
    WrongPasses,
    /// There is no `try`.
    #[error("no try: nobody can be shown how, and the check is not tried")]
    NoTry,
    /// There is no `wrong`.
    #[error("no wrong: it is not tried whether the check can fail")]
    NoWrong,
    /// A text quotes a number that the run does not have; the number as written.
    #[error("{{{0}}} is not known in the run that does the task")]
    Unknown(String),
    /// A wrong choice has no reply; which choice it is.
    #[error("{0} is wrong and has no reply")]
    NoReply(String),
    /// The scene could not be solved; the reason.
    #[error("the scene was not solved: {0}")]
    Unsolved(String),
}

impl StepFault {
    /// Whether the step cannot be done as it is. Every other fault is advice.
    pub fn is_error(&self) -> bool {
        !matches!(self, Self::NoTry | Self::NoWrong | Self::NoReply(_))
    }
}

/// Tries every task of a lesson, until it is cancelled. `each` is called with the index of a step before the step is tried.
pub fn lesson(lesson: &Lesson, each: &mut dyn FnMut(usize), cancel: &Cancel) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (i, step) in lesson.steps.iter().enumerate() {
        if cancel.is_cancelled() {
            break;
        }
        each(i);
        let tried = step
            .task
            .iter()
            .flat_map(|task| try_task(step, task, cancel).unwrap_or_else(|why| vec![StepFault::Unsolved(why)]));
        let faults = replies(step).into_iter().chain(tried);
        findings.extend(faults.map(|fault| Finding { step: i + 1, title: step.title.clone(), fault }));
    }
    findings
}

/// Numbers quoted in the texts of a step, by the text between the braces.
#[derive(Clone, Debug, Default)]
pub struct Quoted {
    /// Numbers of the run that the step begins with, in the texts above the task.
    pub before: BTreeMap<String, f64>,
    /// Numbers of the run that fulfils the task, in the texts that are shown then.
    pub told: BTreeMap<String, f64>,
}

/// The numbers that the texts of a step quote, if its task is done as `try` says.
///
/// # Errors
/// Why a scene of it was not solved.
pub fn quoted(step: &Step, cancel: &Cancel) -> Result<Quoted, String> {
    let asked = step.question.iter().flat_map(|question| &question.ask);
    let above: Vec<&Reading> = readings(step.body.iter().chain(asked)).collect();
    if above.is_empty() && readings(step.told()).next().is_none() {
        return Ok(Quoted::default());
    }
    let wanted = wanted(step);
    let start = Tried::of(&step.scene, &wanted, cancel)?;
    let (now, mut known) = (start.ran(&start.live), Quoted::default());
    known.before = above.into_iter().filter_map(|of| Some((of.source.clone(), of.value(now, now)?))).collect();
    known.told = match &step.task {
        Some(task) if !task.example.is_empty() => act(step, task, &task.example, &start, &wanted, cancel)?.known,
        _ => readings(step.told()).filter_map(|of| Some((of.source.clone(), of.value(now, now)?))).collect(),
    };
    Ok(known)
}

/// The numbers of tabs that the check and the texts of a step use.
fn wanted(step: &Step) -> Vec<Live> {
    let asked = step.question.iter().flat_map(|question| &question.ask);
    let quoted = readings(step.body.iter().chain(asked)).chain(readings(step.told()));
    step.task.iter().flat_map(|task| task.check.live()).chain(quoted.flat_map(Reading::live)).collect()
}

/// Wrong choices without a reply, of the question and of what is to be observed, if that has choices of its own.
fn replies(step: &Step) -> Vec<StepFault> {
    let observe = step.observe.as_ref().filter(|observe| !observe.ask.is_empty());
    let mut faults = Vec::new();
    for (asked, of) in [(step.question.as_ref(), ""), (observe, " of observe")] {
        let Some(Answer::Choice { choices, right }) = asked.map(|question| &question.answer) else { continue };
        let silent = choices.iter().enumerate().filter(|(i, choice)| i != right && choice.reply.is_empty());
        faults.extend(silent.map(|(i, _)| StepFault::NoReply(format!("choice {}{of}", i + 1))));
    }
    faults
}

/// A run, and the numbers of the tabs that belong to it.
struct Tried {
    scene: Scene,
    problem: Problem,
    numbers: Numbers,
    live: Readings,
}

impl Tried {
    fn of(scene: &Scene, wanted: &[Live], cancel: &Cancel) -> Result<Self, String> {
        let problem = Problem::try_from(scene).map_err(|error| error.to_string())?;
        let settings = Settings { fidelity: FIDELITY, ..Settings::default() };
        let solution = solve(&problem, &settings, &mut |_: &Progress| (), cancel).map_err(|error| error.to_string())?;
        if solution.status != Status::Converged {
            return Err("it did not converge".to_owned());
        }
        let numbers = Numbers::of(&problem, &solution);
        let problem = settled(&problem, &solution.outcome).into_owned();
        let mut live = Readings::default();
        match &problem.scenario {
            Scenario::Plate(plate) => {
                live.read_exact(plate, &solution.recording);
                live.read_held(plate.mean_gap, plate.gas.ambient_pressure);
            }
            Scenario::Motor(_) if wanted.iter().any(|live| live.tab() == Live::Stall.tab()) => {
                let curves = TorqueCurves::of(&problem, FIDELITY, &solution, cancel);
                if let Some(curves) = curves.map_err(|error| error.to_string())? {
                    live.read_torque(&curves);
                }
            }
            Scenario::Motor(_) => {}
        }
        Ok(Self { scene: scene.clone(), problem, numbers, live })
    }

    fn ran<'a>(&'a self, live: &'a Readings) -> Ran<'a> {
        Ran { scene: &self.scene, numbers: &self.numbers, live }
    }
}

/// The result of actions on a task.
struct Outcome {
    /// Why the check does not hold; `None` if it held at any time.
    unmet: Option<String>,
    too_far: bool,
    /// The numbers that texts quote, at the time when the check held.
    known: BTreeMap<String, f64>,
}

fn try_task(step: &Step, task: &Task, cancel: &Cancel) -> Result<Vec<StepFault>, String> {
    let wanted = wanted(step);
    let start = Tried::of(&step.scene, &wanted, cancel)?;
    let mut faults = Vec::new();
    let by_hand = task.check.live().any(Live::is_done_by_hand);
    if !by_hand && task.check.unmet(start.ran(&start.live), start.ran(&start.live)).is_none() {
        faults.push(StepFault::TrueFromStart);
    }
    if task.example.is_empty() {
        faults.push(StepFault::NoTry);
    } else {
        let done = act(step, task, &task.example, &start, &wanted, cancel)?;
        match done.unmet {
            Some(unmet) => faults.push(StepFault::TryFails(unmet)),
            None if done.too_far => faults.push(StepFault::TryTooFar),
            None => {
                let lacks = |reading: &&Reading| !done.known.contains_key(&reading.source);
                let unknown = readings(step.told()).filter(lacks).map(|reading| reading.source.clone());
                faults.extend(unknown.map(StepFault::Unknown));
            }
        }
    }
    if task.wrong.is_empty() {
        faults.push(StepFault::NoWrong);
    } else if act(step, task, &task.wrong, &start, &wanted, cancel)?.unmet.is_none() {
        faults.push(StepFault::WrongPasses);
    }
    Ok(faults)
}

/// Carries out actions, and evaluates the check whenever something has changed.
fn act(
    step: &Step,
    task: &Task,
    doing: &Doing,
    start: &Tried,
    wanted: &[Live],
    cancel: &Cancel,
) -> Result<Outcome, String> {
    let scene = step.scene.with(&doing.changes).map_err(|error| error.to_string())?;
    let run = Tried::of(&scene, wanted, cancel)?;
    let mut look = Look { task, step, run: &run, start, began: start.live, outcome: None };
    look.at(&run.live);
    for act in &doing.acts {
        match act {
            Act::Hold(gap) => hold(&run, gap * 1e-6, &mut |live| look.at(live))?,
            Act::StartUp => start_up(&run, &mut look, cancel)?,
        }
    }
    Ok(look.outcome.unwrap_or(Outcome { unmet: None, too_far: false, known: BTreeMap::new() }))
}

/// Evaluates the check while actions go on. Once it has held, the task is fulfilled.
struct Look<'a> {
    task: &'a Task,
    step: &'a Step,
    run: &'a Tried,
    start: &'a Tried,
    /// The numbers of the tabs when the step began.
    began: Readings,
    outcome: Option<Outcome>,
}

impl Look<'_> {
    fn at(&mut self, live: &Readings) {
        if self.outcome.as_ref().is_some_and(|outcome| outcome.unmet.is_none()) {
            return;
        }
        let (now, start) = (self.run.ran(live), self.start.ran(&self.began));
        let unmet = self.task.check.unmet(now, start);
        let holds = |limit: &Check| limit.unmet(now, start).is_none();
        let too_far = self.task.too_far.as_ref().is_some_and(|(limit, _)| holds(limit));
        let quoted = unmet.is_none().then(|| readings(self.step.told())).into_iter().flatten();
        let known = quoted.filter_map(|of| Some((of.source.clone(), of.value(now, start)?))).collect();
        self.outcome = Some(Outcome { unmet, too_far, known });
    }
}

/// Pushes the plate of a run to the gap `gap` \[m\] and holds it there.
fn hold(run: &Tried, gap: f64, look: &mut dyn FnMut(&Readings)) -> Result<(), String> {
    let Scenario::Plate(plate) = &run.problem.scenario else { return Err("a motor is not held".to_owned()) };
    let mut held = Hold::new(plate, &Plan::plate(plate, FIDELITY, &Numerics::default()));
    let leak = leak_time(plate, plate.mean_gap);
    let mut live = run.live;
    let mut time = PUSH * leak;
    for _ in 0..LOOKS {
        held.advance(gap, time).map_err(|error| error.to_string())?;
        let reading = held.reading();
        live.read_held(reading.gap, reading.mean_pressure);
        look(&live);
        time = KEPT * leak / LOOKS as f64;
    }
    Ok(())
}

/// Starts a run from rest.
fn start_up(run: &Tried, look: &mut Look<'_>, cancel: &Cancel) -> Result<(), String> {
    let settings = startup::Settings { fidelity: FIDELITY, ..startup::Settings::default() };
    // A cycle may be computed again on finer grids: it then replaces the earlier one.
    let mut cycles = BTreeMap::new();
    let mut each = |cycle: startup::Cycle| {
        cycles.insert(cycle.number, CycleRow::of(&run.problem, &cycle));
    };
    startup(&run.problem, &settings, &mut each, cancel).map_err(|error| error.to_string())?;
    for row in cycles.values() {
        let mut live = run.live;
        live.read_cycle(row);
        if row.cycle == 1 {
            look.began.read_cycle(row);
        }
        look.at(&live);
    }
    Ok(())
}
