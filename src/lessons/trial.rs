//! Tries the tasks of a lesson without a window: carries out the actions in `try` and `wrong`, and evaluates the check after each of them.

use super::check::{Ran, Reading};
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

/// What is wrong with a step, in words.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// The step cannot be done as it is.
    Error(String),
    /// Advice.
    Advice(String),
}

/// Tries every task of a lesson, until it is cancelled, and returns what is wrong, with the step. `each` is called with a step before it is tried.
pub fn lesson(lesson: &Lesson, each: &mut dyn FnMut(&Step), cancel: &Cancel) -> Vec<(usize, Finding)> {
    let mut findings = Vec::new();
    for (i, step) in lesson.steps.iter().enumerate() {
        if cancel.is_cancelled() {
            break;
        }
        each(step);
        let unsolved = |why: String| vec![Finding::Error(format!("the scene was not solved: {why}"))];
        let tried = step.task.iter().flat_map(|task| try_task(step, task, cancel).unwrap_or_else(unsolved));
        findings.extend(replies(step).into_iter().chain(tried).map(|finding| (i, finding)));
    }
    findings
}

/// Numbers quoted in the texts of a step, by the text between the braces.
#[derive(Clone, Debug, Default)]
pub struct Quoted {
    /// Numbers of the run that the step begins with, in the texts above the task.
    pub before: BTreeMap<String, f64>,
    /// Numbers of the run that fulfils the task, in the texts that are shown then.
    pub after: BTreeMap<String, f64>,
}

/// The numbers that the texts of a step quote, if its task is done as `try` says.
///
/// # Errors
/// Why a scene of it was not solved.
pub fn quoted(step: &Step, cancel: &Cancel) -> Result<Quoted, String> {
    if above(step).chain(readings(step.after_task())).next().is_none() {
        return Ok(Quoted::default());
    }
    let start = TrialRun::of(step, &step.scene, cancel)?;
    let (now, mut known) = (start.ran(&start.live), Quoted::default());
    known.before = above(step).filter_map(|of| Some((of.source.clone(), of.value(now, now)?))).collect();
    known.after = match &step.task {
        Some(task) if !task.example.is_empty() => act(step, task, &task.example, &start, cancel)?.known,
        _ => readings(step.after_task()).filter_map(|of| Some((of.source.clone(), of.value(now, now)?))).collect(),
    };
    Ok(known)
}

/// The numbers that the texts above the task quote.
fn above(step: &Step) -> impl Iterator<Item = &Reading> {
    readings(step.body.iter().chain(step.question.iter().flat_map(|question| &question.ask)))
}

/// Whether the check and the texts of a step use numbers of the tab Torque.
fn uses_torque(step: &Step) -> bool {
    let quoted = above(step).chain(readings(step.after_task()));
    let mut used = step.task.iter().flat_map(|task| task.check.live()).chain(quoted.flat_map(Reading::live));
    used.any(|live| live.tab() == Live::Stall.tab())
}

/// Wrong choices without a reply, of the question and of what is to be observed, if that has choices of its own.
fn replies(step: &Step) -> Vec<Finding> {
    let observe = step.observe.as_ref().filter(|observe| !observe.ask.is_empty());
    let mut findings = Vec::new();
    for (asked, of) in [(step.question.as_ref(), ""), (observe, " of observe")] {
        let Some(Answer::Choice { choices, right }) = asked.map(|question| &question.answer) else { continue };
        let silent = choices.iter().enumerate().filter(|(i, choice)| i != right && choice.reply.is_empty());
        let advice = |i: usize| Finding::Advice(format!("choice {}{of} is wrong and has no reply", i + 1));
        findings.extend(silent.map(|(i, _)| advice(i)));
    }
    findings
}

/// A run, and the numbers of the tabs that belong to it.
struct TrialRun {
    scene: Scene,
    problem: Problem,
    numbers: Numbers,
    live: Readings,
}

impl TrialRun {
    /// The run of `scene`, with what is used in `step`.
    fn of(step: &Step, scene: &Scene, cancel: &Cancel) -> Result<Self, String> {
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
            Scenario::Motor(_) if uses_torque(step) => {
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
struct TaskOutcome {
    /// Why the check does not hold; `None` if it held at any time.
    unmet: Option<String>,
    too_far: bool,
    /// The numbers that texts quote, at the time when the check held.
    known: BTreeMap<String, f64>,
}

fn try_task(step: &Step, task: &Task, cancel: &Cancel) -> Result<Vec<Finding>, String> {
    let start = TrialRun::of(step, &step.scene, cancel)?;
    let mut findings = Vec::new();
    let by_hand = task.check.live().any(Live::is_done_by_hand);
    if !by_hand && task.check.unmet(start.ran(&start.live), start.ran(&start.live)).is_none() {
        findings.push(Finding::Error("the check holds from the start: there is nothing to do".to_owned()));
    }
    if task.example.is_empty() {
        findings.push(Finding::Advice(
            "no try: the task cannot be shown to a student, and its check is not tested".to_owned(),
        ));
    } else {
        let done = act(step, task, &task.example, &start, cancel)?;
        match done.unmet {
            Some(unmet) => findings.push(Finding::Error(format!("try does not fulfil the check: {unmet}"))),
            None if done.too_far => findings.push(Finding::Error("try goes too far: too_far holds".to_owned())),
            None => {
                let unknown = readings(step.after_task()).filter(|reading| !done.known.contains_key(&reading.source));
                let words = |of: &Reading| format!("{{{}}} is not known in the run that fulfils the task", of.source);
                findings.extend(unknown.map(words).map(Finding::Error));
            }
        }
    }
    if task.wrong.is_empty() {
        findings.push(Finding::Advice("no wrong: it is not tested whether the check can fail".to_owned()));
    } else if act(step, task, &task.wrong, &start, cancel)?.unmet.is_none() {
        findings.push(Finding::Error("wrong fulfils the check".to_owned()));
    }
    Ok(findings)
}

/// Carries out actions, and evaluates the check whenever something has changed.
fn act(step: &Step, task: &Task, doing: &Doing, start: &TrialRun, cancel: &Cancel) -> Result<TaskOutcome, String> {
    let scene = step.scene.with(&doing.changes).map_err(|error| error.to_string())?;
    let run = TrialRun::of(step, &scene, cancel)?;
    let outcome = TaskOutcome { unmet: Some(String::new()), too_far: false, known: BTreeMap::new() };
    let mut look = TaskCheck { task, step, run: &run, start, began: start.live, outcome };
    look.at(&run.live);
    for act in &doing.acts {
        match act {
            Act::Hold(gap) => hold(&run, gap * 1e-6, &mut |live| look.at(live))?,
            Act::StartUp => start_up(&run, &mut look, cancel)?,
        }
    }
    Ok(look.outcome)
}

/// Evaluates the check while actions go on. Once it has held, the task is fulfilled.
struct TaskCheck<'a> {
    task: &'a Task,
    step: &'a Step,
    run: &'a TrialRun,
    start: &'a TrialRun,
    /// The numbers of the tabs when the step began.
    began: Readings,
    outcome: TaskOutcome,
}

impl TaskCheck<'_> {
    fn at(&mut self, live: &Readings) {
        if self.outcome.unmet.is_none() {
            return;
        }
        let (now, start) = (self.run.ran(live), self.start.ran(&self.began));
        let unmet = self.task.check.unmet(now, start);
        let too_far = self.task.too_far.as_ref().is_some_and(|(limit, _)| limit.unmet(now, start).is_none());
        let quoted = unmet.is_none().then(|| readings(self.step.after_task())).into_iter().flatten();
        let known = quoted.filter_map(|of| Some((of.source.clone(), of.value(now, start)?))).collect();
        self.outcome = TaskOutcome { unmet, too_far, known };
    }
}

/// Pushes the plate of a run to the gap `gap` \[m\] and holds it there.
fn hold(run: &TrialRun, gap: f64, look: &mut dyn FnMut(&Readings)) -> Result<(), String> {
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
fn start_up(run: &TrialRun, look: &mut TaskCheck<'_>, cancel: &Cancel) -> Result<(), String> {
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
