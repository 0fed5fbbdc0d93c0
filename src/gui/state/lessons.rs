//! The lesson that is followed, how far the others were, the tour and the glossary.
//!
//! While a lesson runs, the student's own scene is set aside with its history, and brought back when the lesson ends.

use super::document::Document;
use super::hold::HoldState;
use super::startup::{Point, StartupState};
use super::torque::TorqueState;
use super::tour::STOPS;
use super::view::{Tab, View};
use crate::analysis::exact;
use crate::analysis::quantity::Numbers;
use crate::fidelity::Fidelity;
use crate::job::SolvedScene;
use crate::lessons::check::Ran;
use crate::lessons::live::{Live, Readings};
use crate::lessons::{self, Act, Lesson, LessonError, Prediction, Step, WindowNames};
use crate::problem::{Plate, Scenario};
use crate::scene::Scene;
use crate::solution::{Outcome, PlateResult, Status};
use std::collections::BTreeMap;
use std::path::Path;

/// Frames in which a highlighted parameter is scrolled to: a group takes some to open.
const REVEALED: u8 = 16;
/// A held plate this near to its mean gap has not been moved, relative.
const AT_REST: f64 = 0.01;

/// Parts of the window that lessons can highlight.
pub const PLACES: &[&str] = &[
    "parameters",
    "wave",
    "gap",
    "pressure",
    "map",
    "tooth",
    "least gap",
    "loads",
    "loop",
    "held plate",
    "boyle",
    "start",
    "history",
    "torque",
    "numbers",
    "timeline",
    "tabs",
    "lessons",
];

/// What is highlighted in this frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Highlights {
    /// Parts of the window, and keys of parameters.
    names: Vec<String>,
    /// Whether highlighted parameters are scrolled to, and their group opened.
    pub reveal: bool,
}

impl Highlights {
    /// Whether `name` is highlighted.
    pub fn has(&self, name: &str) -> bool {
        self.names.iter().any(|other| other == name)
    }
}

/// How far a lesson was followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// The step that comes next.
    pub step: usize,
    /// Whether it was once followed to its end.
    pub done: bool,
}

/// What a student did in one step.
#[derive(Clone, Debug, Default)]
pub struct StepWork {
    /// What was answered, if anything yet.
    pub prediction: Option<Prediction>,
    /// Whether it was committed to.
    pub committed: bool,
    /// Whether the task was fulfilled.
    pub fulfilled: bool,
    /// Why it is not, of the newest run.
    pub unmet: Option<String>,
    /// Whether anything was tried.
    pub tried: bool,
}

/// The run that a step compares with.
#[derive(Clone, Debug)]
pub struct StartingPoint {
    /// The scene that the step began with.
    pub scene: Scene,
    fidelity: Option<Fidelity>,
    /// Its results.
    pub numbers: Numbers,
    /// What was read off the tabs.
    pub live: Readings,
}

impl StartingPoint {
    fn of(scene: Scene) -> Self {
        Self { scene, fidelity: None, numbers: Numbers::default(), live: Readings::default() }
    }
}

/// What the window shows, to be read by a check.
#[derive(Clone, Copy, Debug)]
pub struct OnScreen<'a> {
    /// The run on screen.
    pub run: Option<&'a SolvedScene>,
    /// Torque over speed.
    pub torque: &'a TorqueState,
    /// The start-up.
    pub startup: Option<&'a StartupState>,
    /// The plate in the hand.
    pub hold: Option<&'a HoldState>,
}

/// The lesson that is followed.
#[derive(Debug)]
pub struct RunningLesson {
    /// Its place in the list.
    pub lesson: usize,
    /// Its step.
    pub step: usize,
    /// What was done, by step.
    pub work: Vec<StepWork>,
    /// Whether all results are shown in place of the text.
    pub all_results: bool,
    /// The student's own scene.
    student: Document,
    /// What was shown before the lesson: the tab, and whether parameters and results were.
    before: (Tab, bool, bool),
    /// What the step began with.
    pub start: StartingPoint,
    /// The newest run of the present scene.
    pub newest: Option<Numbers>,
    /// What is read off the tabs now.
    pub live: Readings,
    /// Whether the held plate was at rest since the step was set up: what was done with it before does not count.
    rested: bool,
    reveal: u8,
}

/// Lessons, tour and glossary.
#[derive(Debug)]
pub struct LessonState {
    lessons: Vec<Lesson>,
    faults: Vec<LessonError>,
    running: Option<RunningLesson>,
    progress: BTreeMap<String, Progress>,
    /// The stop of the tour.
    pub tour: Option<usize>,
    /// What is looked for in the glossary, while it is shown.
    pub glossary: Option<String>,
    /// What is highlighted in this frame.
    pub highlights: Highlights,
}

impl LessonState {
    /// The built-in lessons, with the progress that was stored.
    pub fn new(progress: Option<String>) -> Self {
        let (lessons, faults) = with_known(lessons::built_in);
        let progress = progress.map(|text| read_progress(&text)).unwrap_or_default();
        Self { lessons, faults, running: None, progress, tour: None, glossary: None, highlights: Highlights::default() }
    }

    /// All lessons.
    pub fn lessons(&self) -> &[Lesson] {
        &self.lessons
    }

    /// What is wrong with lessons that could not be read.
    pub fn faults(&self) -> &[LessonError] {
        &self.faults
    }

    /// The lesson that is followed.
    pub fn running(&self) -> Option<&RunningLesson> {
        self.running.as_ref()
    }

    /// The step on screen, with its lesson.
    pub fn step(&self) -> Option<(&Lesson, &Step)> {
        let running = self.running.as_ref()?;
        let lesson = self.lessons.get(running.lesson)?;
        Some((lesson, lesson.steps.get(running.step)?))
    }

    /// How far a lesson was followed.
    pub fn progress(&self, lesson: &Lesson) -> Progress {
        self.progress.get(&lesson.id).copied().unwrap_or_default()
    }

    /// The student's own scene: set aside during a lesson.
    pub fn student_document<'a>(&'a self, document: &'a Document) -> &'a Document {
        self.running.as_ref().map_or(document, |running| &running.student)
    }

    /// Adds the lessons of a folder; what cannot be read is in the faults. A lesson of a name that is there replaces it. Whether
    /// the lesson that is followed was replaced.
    pub fn load(&mut self, folder: &Path) -> bool {
        let (lessons, faults) = with_known(|known| lessons::load(folder, known));
        let mut replaced = false;
        for lesson in lessons {
            match self.lessons.iter().position(|other| other.id == lesson.id) {
                Some(place) => {
                    replaced |= self.running.as_ref().is_some_and(|running| running.lesson == place);
                    self.lessons[place] = lesson;
                }
                None => self.lessons.push(lesson),
            }
        }
        self.faults = faults;
        replaced
    }

    /// What was wrong, a line each.
    pub fn fault_text(&self) -> String {
        let lines: Vec<String> = self.faults.iter().map(ToString::to_string).collect();
        lines.join("\n")
    }

    /// Progress as text, a line for each lesson.
    pub fn progress_text(&self) -> String {
        let line = |(id, progress): (&String, &Progress)| {
            format!("{} {} {id}", progress.step, if progress.done { "done" } else { "open" })
        };
        self.progress.iter().map(line).collect::<Vec<_>>().join("\n")
    }

    /// The student's work on the step on screen.
    pub fn work(&mut self) -> Option<&mut StepWork> {
        let running = self.running.as_mut()?;
        running.work.get_mut(running.step)
    }

    /// Shows all results in place of the lesson's text, or the text again.
    pub fn show_all_results(&mut self, all: bool) {
        if let Some(running) = &mut self.running {
            running.all_results = all;
        }
    }

    /// Shows a stop of the tour; none, and one after the last, ends it.
    pub fn show_tour(&mut self, stop: Option<usize>, view: &mut View) {
        self.tour = stop.filter(|stop| *stop < STOPS.len());
        if self.tour.is_some() {
            (view.parameters, view.results, view.tab) = (true, true, Tab::Motion);
        }
    }

    /// Begins a lesson, by its place in the list, at the step where it was left; whether there is such a lesson.
    pub fn open(&mut self, lesson: usize, document: &mut Document, view: &mut View) -> bool {
        self.leave(document, view);
        let Some(chosen) = self.lessons.get(lesson) else { return false };
        let progress = self.progress.get(&chosen.id).copied().unwrap_or_default();
        let step = if progress.step < chosen.steps.len() { progress.step } else { 0 };
        let (steps, scene) = (chosen.steps.len(), chosen.steps[step].scene.clone());
        let practice = Document::practice(scene.clone()).with_target(document.target());
        self.tour = None;
        self.running = Some(RunningLesson {
            lesson,
            step,
            work: vec![StepWork::default(); steps],
            all_results: false,
            student: std::mem::replace(document, practice),
            before: (view.tab, view.parameters, view.results),
            start: StartingPoint::of(scene),
            newest: None,
            live: Readings::default(),
            rested: false,
            reveal: 0,
        });
        self.set_up(document, view, true);
        true
    }

    /// To a step further on or back; whether the scene has to be solved anew.
    pub fn turn(&mut self, by: isize, document: &mut Document, view: &mut View) -> bool {
        let Some(running) = &mut self.running else { return false };
        let Some(lesson) = self.lessons.get(running.lesson) else { return false };
        let Some(to) = running.step.checked_add_signed(by) else { return false };
        let progress = self.progress.entry(lesson.id.clone()).or_default();
        if to >= lesson.steps.len() {
            *progress = Progress { step: 0, done: true };
            return self.leave(document, view);
        }
        running.step = to;
        progress.step = to;
        let again = by < 0 || lesson.steps[to].sets;
        self.set_up(document, view, again)
    }

    /// Sets up what the present step needs. `scene`: also its scene. Whether that has to be solved anew.
    pub fn set_up(&mut self, document: &mut Document, view: &mut View, scene: bool) -> bool {
        let Some(running) = &mut self.running else { return false };
        let Some(lesson) = self.lessons.get(running.lesson) else { return false };
        let Some(step) = lesson.steps.get(running.step) else { return false };
        if let Some(tab) = step.tab.as_deref().and_then(tab) {
            view.tab = tab;
        }
        // What is highlighted is to be seen, and the lesson stands where the results are.
        view.parameters |= !step.light.is_empty();
        view.results = true;
        running.all_results = false;
        running.reveal = if step.light.is_empty() { 0 } else { REVEALED };
        let changed = scene && *document.scene() != step.scene;
        if scene {
            document.change(step.scene.clone(), document.target());
        }
        running.start = StartingPoint::of(document.scene().clone());
        (running.live, running.rested) = (Readings::default(), false);
        changed
    }

    /// Makes the changes that fulfil the task; whether the scene has to be solved anew.
    pub fn show_me(&self, document: &mut Document) -> bool {
        let Some(task) = self.step().and_then(|(_, step)| step.task.as_ref()) else { return false };
        let mut next = document.scene().clone();
        let changes = &task.example.changes;
        let pairs = changes.iter().map(|(key, value)| (key.as_str(), value.as_str()));
        if changes.is_empty() || next.set_all(pairs).is_err() {
            return false;
        }
        document.change(next, document.target())
    }

    /// What else fulfils the task of the step.
    pub fn acts(&self) -> Vec<Act> {
        let task = self.step().and_then(|(_, step)| step.task.as_ref());
        task.map(|task| task.example.acts.clone()).unwrap_or_default()
    }

    /// Whether the step on screen is about what is done in `tab`.
    pub fn is_about(&self, tab: Tab) -> bool {
        self.step().is_some_and(|(_, step)| step.tab.as_deref().and_then(self::tab) == Some(tab))
    }

    /// Ends the lesson; whether there was one.
    pub fn leave(&mut self, document: &mut Document, view: &mut View) -> bool {
        let Some(running) = self.running.take() else { return false };
        *document = running.student.with_target(document.target());
        (view.tab, view.parameters, view.results) = running.before;
        true
    }

    /// Looks at what is on screen: what the step began with, and whether its task is fulfilled. Whether a parameter is still
    /// being scrolled to, which takes some frames.
    pub fn observe(&mut self, document: &Document, seen: OnScreen<'_>) -> bool {
        self.highlights = Highlights::default();
        if let Some((_, step)) = self.step() {
            let keys = step.light.iter().map(|parameter| parameter.key.to_owned());
            self.highlights.names = keys.chain(step.look.iter().cloned()).collect();
        }
        let Some(running) = &mut self.running else {
            let stop = self.tour.and_then(|stop| STOPS.get(stop));
            self.highlights.names.extend(stop.map(|stop| stop.place.to_owned()));
            return false;
        };
        self.highlights.reveal = running.reveal > 0;
        running.reveal = running.reveal.saturating_sub(1);
        self.judge(document, seen);
        self.highlights.reveal
    }

    fn judge(&mut self, document: &Document, seen: OnScreen<'_>) {
        let Some(running) = &mut self.running else { return };
        running.newest = None;
        running.live = Readings::default();
        let scene = document.scene();
        let Some(run) = seen.run.filter(|run| run.scene == *scene && run.solution.status == Status::Converged) else {
            return;
        };
        let numbers = Numbers::of(&run.problem, &run.solution);
        running.newest = Some(numbers);
        running.read_tabs(run, seen);
        if run.scene == running.start.scene && running.start.fidelity.is_none_or(|found| found <= run.fidelity) {
            running.start.fidelity = Some(run.fidelity);
            running.start.numbers = numbers;
            for live in Live::all().filter(|live| !live.is_done_by_hand()) {
                if let Some(value) = running.live.get(live) {
                    running.start.live.set(live, value);
                }
            }
        }
        let step = self.lessons.get(running.lesson).and_then(|lesson| lesson.steps.get(running.step));
        let Some((step, task)) = step.and_then(|step| Some((step, step.task.as_ref()?))) else { return };
        let Some(work) = running.work.get_mut(running.step) else { return };
        // A draft is good enough to look at, not to judge by.
        let asked = step.question.is_some() && !work.committed;
        if run.fidelity < document.target().min(Fidelity::Standard) || asked {
            return;
        }
        let (now, start) = (&running.live, &running.start);
        work.tried = run.scene != start.scene
            || task.check.live().any(|live| live.is_done_by_hand() && now.get(live) != start.live.get(live));
        let now = Ran { scene: &run.scene, numbers: &numbers, live: now };
        work.unmet = task.check.unmet(now, Ran { scene: &start.scene, numbers: &start.numbers, live: &start.live });
        work.fulfilled |= work.unmet.is_none();
    }
}

impl RunningLesson {
    /// Reads off the tabs what they show of `run`; of a start-up and of a held plate also what they began with.
    fn read_tabs(&mut self, run: &SolvedScene, seen: OnScreen<'_>) {
        let live = &mut self.live;
        if let Some(hold) = seen.hold.filter(|hold| !hold.stale(&run.scene)) {
            let (plate, now) = (hold.plate(), hold.now().reading);
            self.rested |= (now.gap / plate.mean_gap - 1.0).abs() < AT_REST;
            let rest = (plate.mean_gap, plate.gas.ambient_pressure);
            let present = if self.rested { (now.gap, now.mean_pressure) } else { rest };
            for (readings, (gap, pressure)) in [(&mut self.start.live, rest), (&mut *live, present)] {
                readings.set(Live::HeldGap, gap * 1e6);
                readings.set(Live::HeldPressure, pressure * 1e-3);
            }
        }
        if let Some(startup) = seen.startup.filter(|startup| !startup.stale(&run.scene)) {
            let points = startup.points();
            for (readings, point) in [(&mut self.start.live, points.first()), (&mut *live, points.last())] {
                point.into_iter().for_each(|point| read_cycle(readings, point, &run.problem.scenario));
            }
        }
        match (&run.problem.scenario, seen.torque.of(run)) {
            (Scenario::Plate(plate), _) => read_exact(live, run, plate),
            (Scenario::Motor(_), Some(merit)) => {
                let (with, without) = (&merit.with_film, &merit.without_film);
                live.set(Live::Stall, with.stall_torque.value);
                live.set(Live::PresentTorque, with.present.torque.value);
                live.set(Live::DryStall, without.stall_torque.value);
                live.set(Live::Output, with.max_power.value);
                live.set(Live::DryOutput, without.max_power.value);
                if let Some(speed) = with.no_load_speed {
                    live.set(Live::NoLoad, merit.rpm(speed.value));
                }
            }
            (Scenario::Motor(_), None) => {}
        }
    }
}

fn read_cycle(readings: &mut Readings, point: &Point, scenario: &Scenario) {
    readings.set(Live::Cycles, point.number as f64);
    readings.set(Live::Remaining, point.remaining);
    match (point.outcome, scenario) {
        (Outcome::Motor(result), _) => readings.set(Live::StartAlpha, result.alpha),
        (Outcome::Plate(result), Scenario::Plate(plate)) => {
            readings.set(Live::StartLoadRatio, PlateResult::ratio(result.film_load, plate));
        }
        _ => {}
    }
}

fn read_exact(readings: &mut Readings, run: &SolvedScene, plate: &Plate) {
    if let Some(found) = exact::solved(plate, &run.solution.recording) {
        readings.set(Live::Spring, found.spring.value);
        readings.set(Live::Damping, found.damping.value);
    }
}

/// The tab of a name in a lesson.
fn tab(name: &str) -> Option<Tab> {
    let named = |tab: Tab| [true, false].iter().any(|plate| tab.label(*plate).eq_ignore_ascii_case(name));
    Tab::ALL.iter().map(|(tab, _)| *tab).find(|tab| named(*tab))
}

/// Calls `read` with what the window has.
fn with_known<R>(read: impl FnOnce(WindowNames<'_>) -> R) -> R {
    let labels = |plate| -> Vec<&str> {
        Tab::ALL.iter().filter(|(tab, _)| tab.is_of(plate)).map(|(tab, _)| tab.label(plate)).collect()
    };
    let (motor, plate) = (labels(false), labels(true));
    read(WindowNames { tabs: [&motor, &plate], places: PLACES })
}

fn read_progress(text: &str) -> BTreeMap<String, Progress> {
    let line = |line: &str| {
        let mut parts = line.splitn(3, ' ');
        let step = parts.next()?.parse().ok()?;
        let done = parts.next()? == "done";
        Some((parts.next()?.to_owned(), Progress { step, done }))
    };
    text.lines().filter_map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_is_read_as_it_was_written() {
        let mut lessons_state = LessonState::new(None);
        lessons_state.progress.insert("a lesson with spaces".to_owned(), Progress { step: 3, done: false });
        lessons_state.progress.insert("b".to_owned(), Progress { step: 0, done: true });
        let read = LessonState::new(Some(lessons_state.progress_text()));
        assert_eq!(read.progress, lessons_state.progress);
        assert!(read_progress("nonsense\n\n3\nx open y").is_empty());
    }
}
