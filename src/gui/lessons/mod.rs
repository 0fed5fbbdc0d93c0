//! Lessons, the tour and the glossary in the window: their state, and what they ask the application to do.
//!
//! While a lesson runs, the student's own scene is set aside with its history, and brought back when the lesson ends.

mod formula;
pub mod glossary;
mod panel;
pub(in crate::gui) mod rich;
pub mod tour;

pub use panel::show;

use super::document::Document;
use super::holding::Holding;
use super::merits::Merits;
use super::spot::{self, Lit};
use super::starting::{Point, Starting};
use super::state::{Tab, View};
use crate::analysis::exact;
use crate::analysis::quantity::Numbers;
use crate::fidelity::Fidelity;
use crate::job::Run;
use crate::lessons::check::Ran;
use crate::lessons::live::{Live, Readings};
use crate::lessons::{self, Act, Lesson, LessonError, Prediction, Step, WindowNames};
use crate::problem::{Plate, Scenario};
use crate::scene::Scene;
use crate::solution::{Outcome, PlateResult, Status};
use eframe::egui;
use std::collections::BTreeMap;
use std::path::Path;

/// Frames in which a lit parameter is scrolled to: a group takes some to open.
const REVEALED: u8 = 16;
/// A held plate this near to its mean gap has not been moved, relative.
const AT_REST: f64 = 0.01;

/// What is asked of lessons, tour and glossary.
#[derive(Clone, Debug, PartialEq)]
pub enum Teach {
    /// Begins a lesson, by its place in the list, at the step where it was left.
    Open(usize),
    /// The step after this one; after the last, the lesson is done.
    Next,
    /// The step before this one.
    Back,
    /// Ends the lesson and brings the student's scene back.
    Leave,
    /// Answers the question of the step, for now.
    Predict(Prediction),
    /// Keeps to that answer.
    Commit,
    /// Makes the changes that fulfil the task.
    ShowMe,
    /// Sets the step's scene up again.
    SetUp,
    /// Shows all results in place of the lesson's text, or the text again.
    AllResults(bool),
    /// Asks for a folder of lessons.
    ChooseFolder,
    /// Loads the lessons of this folder, beside those that are there.
    LoadFolder(std::path::PathBuf),
    /// Says again what was wrong with lessons.
    Faults,
    /// The tour, from this stop on; none ends it.
    Tour(Option<usize>),
    /// Shows or hides the glossary.
    Glossary(bool),
    /// What is looked for in the glossary.
    Search(String),
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
pub struct Work {
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

/// A run that a step compares with.
#[derive(Clone, Debug)]
struct Start {
    scene: Scene,
    fidelity: Option<Fidelity>,
    numbers: Numbers,
    live: Readings,
}

impl Start {
    fn of(scene: Scene) -> Self {
        Self { scene, fidelity: None, numbers: Numbers::default(), live: Readings::default() }
    }
}

/// What the window shows, to be read by a check.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The run on screen.
    pub run: Option<&'a Run>,
    /// Torque over speed.
    pub merits: &'a Merits,
    /// The start-up.
    pub starting: Option<&'a Starting>,
    /// The plate in the hand.
    pub holding: Option<&'a Holding>,
}

/// The lesson that is followed.
#[derive(Debug)]
pub struct Running {
    /// Its place in the list.
    pub lesson: usize,
    /// Its step.
    pub step: usize,
    /// What was done, by step.
    pub work: Vec<Work>,
    /// Whether all results are shown in place of the text.
    pub all_results: bool,
    /// The student's own scene.
    own: Document,
    /// The tab, and whether parameters and results were shown.
    looked: (Tab, bool, bool),
    start: Start,
    /// The newest run of the present scene.
    newest: Option<Numbers>,
    /// What is read off the tabs now.
    live: Readings,
    /// Whether the held plate was at rest since the step was set up: what was done with it before does not count.
    rested: bool,
    reveal: u8,
}

/// What a command of a lesson works on.
pub struct Stage<'a> {
    /// The scene on the table.
    pub document: &'a mut Document,
    /// How it is looked at.
    pub view: &'a mut View,
}

/// Lessons, tour and glossary.
#[derive(Debug)]
pub struct Teaching {
    lessons: Vec<Lesson>,
    faults: Vec<LessonError>,
    running: Option<Running>,
    progress: BTreeMap<String, Progress>,
    /// The stop of the tour.
    pub tour: Option<usize>,
    /// What is looked for in the glossary, while it is shown.
    pub glossary: Option<String>,
}

impl Teaching {
    /// The built-in lessons, with the progress that was stored.
    pub fn new(progress: Option<String>) -> Self {
        let (lessons, faults) = with_known(lessons::built_in);
        let progress = progress.map(|text| read_progress(&text)).unwrap_or_default();
        Self { lessons, faults, running: None, progress, tour: None, glossary: None }
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
    pub fn running(&self) -> Option<&Running> {
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
    pub fn own<'a>(&'a self, document: &'a Document) -> &'a Document {
        self.running.as_ref().map_or(document, |running| &running.own)
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

    /// Carries a command out; whether the scene has to be solved anew.
    pub fn carry_out(&mut self, teach: Teach, stage: Stage<'_>) -> bool {
        match teach {
            Teach::Open(lesson) => self.open(lesson, stage),
            Teach::Next => self.turn(1, stage),
            Teach::Back => self.turn(-1, stage),
            Teach::Leave => self.leave(stage),
            Teach::SetUp => self.set_up(stage, true),
            Teach::ShowMe => self.show_me(stage),
            Teach::Predict(prediction) => {
                if let Some(work) = self.work().filter(|work| !work.committed) {
                    work.prediction = Some(prediction);
                }
                false
            }
            Teach::Commit => {
                if let Some(work) = self.work().filter(|work| work.prediction.is_some()) {
                    work.committed = true;
                }
                false
            }
            Teach::AllResults(all) => {
                if let Some(running) = &mut self.running {
                    running.all_results = all;
                }
                false
            }
            Teach::Tour(stop) => {
                self.tour = stop.filter(|stop| *stop < tour::STOPS.len());
                if self.tour.is_some() {
                    (stage.view.parameters, stage.view.results, stage.view.tab) = (true, true, Tab::Motion);
                }
                false
            }
            Teach::Glossary(shown) => {
                self.glossary = shown.then(String::new);
                false
            }
            Teach::Search(query) => {
                self.glossary = Some(query);
                false
            }
            // The application asks for folders, and says what is wrong.
            Teach::ChooseFolder | Teach::LoadFolder(_) | Teach::Faults => false,
        }
    }

    fn work(&mut self) -> Option<&mut Work> {
        let running = self.running.as_mut()?;
        running.work.get_mut(running.step)
    }

    fn open(&mut self, lesson: usize, mut stage: Stage<'_>) -> bool {
        self.leave(Stage { document: stage.document, view: stage.view });
        let Some(chosen) = self.lessons.get(lesson) else { return false };
        let progress = self.progress.get(&chosen.id).copied().unwrap_or_default();
        let step = if progress.step < chosen.steps.len() { progress.step } else { 0 };
        let (steps, scene) = (chosen.steps.len(), chosen.steps[step].scene.clone());
        let lent = Document::lent(scene.clone()).aiming(stage.document.aim());
        let view = &mut stage.view;
        self.tour = None;
        self.running = Some(Running {
            lesson,
            step,
            work: vec![Work::default(); steps],
            all_results: false,
            own: std::mem::replace(stage.document, lent),
            looked: (view.tab, view.parameters, view.results),
            start: Start::of(scene),
            newest: None,
            live: Readings::default(),
            rested: false,
            reveal: 0,
        });
        self.set_up(stage, true);
        true
    }

    /// To a step further on or back.
    fn turn(&mut self, by: isize, stage: Stage<'_>) -> bool {
        let Some(running) = &mut self.running else { return false };
        let Some(lesson) = self.lessons.get(running.lesson) else { return false };
        let Some(to) = running.step.checked_add_signed(by) else { return false };
        let progress = self.progress.entry(lesson.id.clone()).or_default();
        if to >= lesson.steps.len() {
            *progress = Progress { step: 0, done: true };
            return self.leave(stage);
        }
        running.step = to;
        progress.step = to;
        let again = by < 0 || lesson.steps[to].sets;
        self.set_up(stage, again)
    }

    /// Sets up what the present step needs. `scene`: also its scene.
    fn set_up(&mut self, stage: Stage<'_>, scene: bool) -> bool {
        let Some(running) = &mut self.running else { return false };
        let Some(lesson) = self.lessons.get(running.lesson) else { return false };
        let Some(step) = lesson.steps.get(running.step) else { return false };
        let view = stage.view;
        if let Some(tab) = step.tab.as_deref().and_then(tab) {
            view.tab = tab;
        }
        // What is lit is to be seen, and the lesson stands where the results are.
        view.parameters |= !step.light.is_empty();
        view.results = true;
        running.all_results = false;
        running.reveal = if step.light.is_empty() { 0 } else { REVEALED };
        let changed = scene && *stage.document.scene() != step.scene;
        if scene {
            let aim = stage.document.aim();
            stage.document.change(step.scene.clone(), aim);
        }
        running.start = Start::of(stage.document.scene().clone());
        (running.live, running.rested) = (Readings::default(), false);
        changed
    }

    fn show_me(&mut self, stage: Stage<'_>) -> bool {
        let Some(task) = self.step().and_then(|(_, step)| step.task.as_ref()) else { return false };
        let mut next = stage.document.scene().clone();
        let changes = &task.example.changes;
        let pairs = changes.iter().map(|(key, value)| (key.as_str(), value.as_str()));
        if changes.is_empty() || next.set_all(pairs).is_err() {
            return false;
        }
        let aim = stage.document.aim();
        stage.document.change(next, aim)
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
    pub fn leave(&mut self, stage: Stage<'_>) -> bool {
        let Some(running) = self.running.take() else { return false };
        let aim = stage.document.aim();
        *stage.document = running.own.aiming(aim);
        (stage.view.tab, stage.view.parameters, stage.view.results) = running.looked;
        true
    }

    /// Looks at what is on screen: what the step began with, and whether its task is fulfilled.
    pub fn observe(&mut self, ctx: &egui::Context, document: &Document, seen: Seen<'_>) {
        let mut lit = Lit::default();
        if let Some((_, step)) = self.step() {
            lit.names =
                step.light.iter().map(|parameter| parameter.key.to_owned()).chain(step.look.iter().cloned()).collect();
        }
        let Some(running) = &mut self.running else {
            if let Some(stop) = self.tour.and_then(|stop| tour::STOPS.get(stop)) {
                lit.names.push(stop.place.to_owned());
            }
            spot::light(ctx, lit);
            return;
        };
        if running.reveal > 0 {
            running.reveal -= 1;
            lit.reveal = true;
            ctx.request_repaint();
        }
        spot::light(ctx, lit);
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
        if run.fidelity < document.aim().min(Fidelity::Standard) || asked {
            return;
        }
        let (now, start) = (&running.live, &running.start);
        work.tried = run.scene != start.scene
            || task.check.live().any(|live| live.is_done_by_hand() && now.get(live) != start.live.get(live));
        let now = Ran { scene: &run.scene, numbers: &numbers, live: now };
        let start = Ran { scene: &start.scene, numbers: &start.numbers, live: &start.live };
        work.unmet = task.check.unmet(now, start);
        work.fulfilled |= work.unmet.is_none();
    }
}

impl Running {
    /// Reads off the tabs what they show of `run`; of a start-up and of a held plate also what they began with.
    fn read_tabs(&mut self, run: &Run, seen: Seen<'_>) {
        let live = &mut self.live;
        if let Some(holding) = seen.holding.filter(|holding| !holding.stale(&run.scene)) {
            let (plate, now) = (holding.plate(), holding.now().reading);
            self.rested |= (now.gap / plate.mean_gap - 1.0).abs() < AT_REST;
            let rest = (plate.mean_gap, plate.gas.ambient_pressure);
            let present = if self.rested { (now.gap, now.mean_pressure) } else { rest };
            for (readings, (gap, pressure)) in [(&mut self.start.live, rest), (&mut *live, present)] {
                readings.set(Live::HeldGap, gap * 1e6);
                readings.set(Live::HeldPressure, pressure * 1e-3);
            }
        }
        if let Some(starting) = seen.starting.filter(|starting| !starting.stale(&run.scene)) {
            let points = starting.points();
            for (readings, point) in [(&mut self.start.live, points.first()), (&mut *live, points.last())] {
                point.into_iter().for_each(|point| read_cycle(readings, point, &run.problem.scenario));
            }
        }
        match (&run.problem.scenario, seen.merits.of(run)) {
            (Scenario::Plate(plate), _) => read_exact(live, run, plate),
            (Scenario::Motor(_), Some(merit)) => {
                let (with, without) = (&merit.with_film, &merit.without_film);
                live.set(Live::Stall, with.stall_torque.value);
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

fn read_exact(readings: &mut Readings, run: &Run, plate: &Plate) {
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
    read(WindowNames { tabs: [&motor, &plate], places: spot::PLACES })
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
        let mut teaching = Teaching::new(None);
        teaching.progress.insert("a lesson with spaces".to_owned(), Progress { step: 3, done: false });
        teaching.progress.insert("b".to_owned(), Progress { step: 0, done: true });
        let read = Teaching::new(Some(teaching.progress_text()));
        assert_eq!(read.progress, teaching.progress);
        assert!(read_progress("nonsense\n\n3\nx open y").is_empty());
    }
}
