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
use super::spot::{self, Lit};
use super::state::{Tab, View};
use crate::analysis::quantity::Numbers;
use crate::fidelity::Fidelity;
use crate::job::Run;
use crate::lessons::check::{Ran, Verdict};
use crate::lessons::{self, Known, Lesson, LessonError, Prediction, Step, Task};
use crate::scene::Scene;
use crate::solution::Status;
use eframe::egui;
use std::collections::BTreeMap;
use std::path::Path;

/// Frames in which a lit parameter is scrolled to: a group takes some to open.
const REVEALED: u8 = 16;

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
}

/// A run that a step compares with.
#[derive(Clone, Debug)]
struct Start {
    scene: Scene,
    fidelity: Option<Fidelity>,
    numbers: Numbers,
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

    /// Adds the lessons of a folder; what cannot be read is in the faults. A lesson of a name that is there replaces it.
    pub fn load(&mut self, folder: &Path) {
        let (lessons, faults) = with_known(|known| lessons::load(folder, known));
        for lesson in lessons {
            match self.lessons.iter_mut().find(|other| other.id == lesson.id) {
                Some(other) => *other = lesson,
                None => self.lessons.push(lesson),
            }
        }
        self.faults = faults;
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
            start: Start { scene, fidelity: None, numbers: Numbers::default() },
            newest: None,
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
        if let Some(tab) = &step.tab
            && let Some((tab, _)) = Tab::ALL.iter().find(|(_, name)| name.eq_ignore_ascii_case(tab))
        {
            view.tab = *tab;
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
        running.start = Start { scene: stage.document.scene().clone(), fidelity: None, numbers: Numbers::default() };
        changed
    }

    fn show_me(&mut self, stage: Stage<'_>) -> bool {
        let Some(task) = self.step().and_then(|(_, step)| step.task.as_ref()) else { return false };
        let mut next = stage.document.scene().clone();
        let pairs = task.example.iter().map(|(key, value)| (key.as_str(), value.as_str()));
        if task.example.is_empty() || next.set_all(pairs).is_err() {
            return false;
        }
        let aim = stage.document.aim();
        stage.document.change(next, aim)
    }

    /// Ends the lesson; whether there was one.
    pub fn leave(&mut self, stage: Stage<'_>) -> bool {
        let Some(running) = self.running.take() else { return false };
        let aim = stage.document.aim();
        *stage.document = running.own.aiming(aim);
        (stage.view.tab, stage.view.parameters, stage.view.results) = running.looked;
        true
    }

    /// Looks at the run on screen: what the step began with, and whether its task is fulfilled.
    pub fn observe(&mut self, ctx: &egui::Context, document: &Document, shown: Option<&Run>) {
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
        let Some(run) = shown.filter(|run| run.scene == *document.scene() && run.solution.status == Status::Converged)
        else {
            return;
        };
        let numbers = Numbers::of(&run.problem, &run.solution);
        running.newest = Some(numbers);
        if run.scene == running.start.scene && running.start.fidelity.is_none_or(|found| found < run.fidelity) {
            running.start.fidelity = Some(run.fidelity);
            running.start.numbers = numbers;
        }
        let task = self.lessons.get(running.lesson).and_then(|lesson| lesson.steps.get(running.step)?.task.as_ref());
        let (Some(task), Some(work)) = (task, running.work.get_mut(running.step)) else { return };
        let asked =
            self.lessons.get(running.lesson).is_some_and(|lesson| lesson.steps[running.step].question.is_some());
        // A draft is good enough to look at, not to judge by.
        if run.fidelity < document.aim().min(Fidelity::Standard) || (asked && !work.committed) {
            return;
        }
        match verdict(task, &run.scene, &numbers, &running.start) {
            Verdict::Holds => (work.fulfilled, work.unmet) = (true, None),
            Verdict::Not(why) => work.unmet = Some(why),
        }
    }
}

fn verdict(task: &Task, scene: &Scene, numbers: &Numbers, start: &Start) -> Verdict {
    task.check.verdict(Ran { scene, numbers }, Ran { scene: &start.scene, numbers: &start.numbers })
}

/// Calls `read` with what the window has.
fn with_known<R>(read: impl FnOnce(Known<'_>) -> R) -> R {
    let tabs: Vec<&str> = Tab::ALL.iter().map(|(_, name)| *name).collect();
    read(Known { tabs: &tabs, places: spot::PLACES })
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
