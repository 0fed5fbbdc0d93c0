//! The running lesson, the progress in the others, the tour and the glossary.
//!
//! While a lesson runs, the student's own scene is set aside with its history, and brought back when the lesson ends.

use super::document::{Document, absolute};
use super::lesson_tabs::{OffTabs, OnScreen};
use super::running_lesson::{REVEALED, RunningLesson, StartingPoint};
use super::tour::STOPS;
use super::view::{Tab, View};
use crate::analysis::quantity::Numbers;
use crate::fidelity::Fidelity;
use crate::job::SolvedScene;
use crate::lessons::check::Reading;
use crate::lessons::live::Live;
use crate::lessons::record::{self, Record};
use crate::lessons::text::readings;
use crate::lessons::work::{Progress, Stage, StepWork};
use crate::lessons::{self, Act, Answer, Lesson, LessonError, Step, WindowNames};
use crate::platform::Instant;
use crate::scene::{Kind, Scene};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
/// How long Enter is ignored after an observation was answered by key, so that the reply can be read.
const UNREAD: Duration = Duration::from_secs(1);
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

/// The field for the number that a question asks for.
pub const NUMBER: &str = "your number";

/// Lessons, tour and glossary.
#[derive(Debug, Default)]
pub struct LessonState {
    /// Lessons that could be read.
    pub lessons: Vec<Lesson>,
    /// Faults of lessons that could not be read.
    pub faults: Vec<LessonError>,
    /// Folders that lessons were read from, as absolute paths, so that they can be read again.
    pub folders: Vec<PathBuf>,
    /// The running lesson.
    pub running: Option<RunningLesson>,
    progress: BTreeMap<String, Progress>,
    /// The stop of the tour.
    pub tour: Option<usize>,
    /// Search text of the glossary; `None` while it is closed.
    pub glossary: Option<String>,
    /// Whether to scroll to the highlighted parameters in this frame, and to open their group.
    pub reveal: bool,
    /// Widget to get the keyboard focus once it is drawn: a parameter, a part of the window, or [`NUMBER`].
    pub enter: Option<String>,
}

impl LessonState {
    /// The built-in lessons.
    pub fn new() -> Self {
        let (lessons, faults) = window_names(lessons::built_in);
        Self { lessons, faults, ..Self::default() }
    }

    /// Takes the progress that was stored ([`Self::progress_text`]).
    ///
    /// # Errors
    /// If it cannot be read; then there is no progress.
    pub fn restore(&mut self, text: &str) -> Result<(), serde_json::Error> {
        self.progress = serde_json::from_str(text)?;
        Ok(())
    }

    /// The step on screen, with its lesson.
    pub fn step(&self) -> Option<(&Lesson, &Step)> {
        let running = self.running.as_ref()?;
        let lesson = self.lessons.get(running.lesson)?;
        Some((lesson, lesson.steps.get(running.step)?))
    }

    /// Progress in a lesson: the step reached, and the answers and tasks done.
    pub fn progress(&self, lesson: &Lesson) -> Progress {
        self.progress.get(&lesson.id).cloned().unwrap_or_default()
    }

    /// The student's own scene: set aside during a lesson.
    pub fn student_document<'a>(&'a self, document: &'a Document) -> &'a Document {
        self.running.as_ref().map_or(document, |running| &running.student)
    }

    /// Adds the lessons of a folder; errors go to the faults. A lesson replaces an earlier one of the same name. Returns whether the
    /// running lesson was replaced by another text.
    pub fn load(&mut self, folder: &Path) -> bool {
        let folder = absolute(folder);
        let (lessons, faults) = window_names(|known| lessons::load(&folder, known));
        let mut replaced = false;
        for lesson in lessons {
            match self.lessons.iter().position(|other| other.id == lesson.id) {
                Some(place) => {
                    let followed = self.running.as_ref().is_some_and(|running| running.lesson == place);
                    replaced |= followed && self.lessons[place] != lesson;
                    self.lessons[place] = lesson;
                }
                None => self.lessons.push(lesson),
            }
        }
        self.faults = faults;
        if folder.is_dir() && !self.folders.contains(&folder) {
            self.folders.push(folder);
        }
        replaced
    }

    /// Reads all folders again. Returns whether the running lesson was replaced by another text.
    pub fn reload(&mut self) -> bool {
        let (mut replaced, mut faults) = (false, Vec::new());
        for folder in self.folders.clone() {
            replaced |= self.load(&folder);
            faults.append(&mut self.faults);
        }
        self.faults = faults;
        replaced
    }

    /// Progress and answers of all lessons, as text.
    pub fn progress_text(&self) -> String {
        // Names and plain data always convert to JSON.
        serde_json::to_string(&self.all_progress()).unwrap_or_default()
    }

    fn all_progress(&self) -> BTreeMap<String, Progress> {
        self.progress.clone().into_iter().chain(self.present()).collect()
    }

    /// Progress in the running lesson.
    fn present(&self) -> Option<(String, Progress)> {
        let running = self.running.as_ref()?;
        let lesson = self.lessons.get(running.lesson)?;
        let ended = running.step >= lesson.steps.len();
        let whole = |(work, step): (&StepWork, &Step)| work.left && work.stage(step) == Stage::Told;
        let done = self.progress(lesson).done || running.work.iter().zip(&lesson.steps).all(whole);
        let step = if ended { 0 } else { running.step };
        Some((lesson.id.clone(), Progress { step, done, work: running.work.clone() }))
    }

    /// Record of the answers and tasks of all lessons that were begun.
    pub fn records(&self) -> Vec<Record> {
        let all = self.all_progress();
        let begun = self.lessons.iter().filter_map(|lesson| Some((lesson, all.get(&lesson.id)?)));
        begun.flat_map(|(lesson, progress)| record::of(lesson, &progress.work)).collect()
    }

    /// Stamps the answers and tasks of the running lesson that have just been done with `now` \[s since 1970, UTC\].
    pub fn note_times(&mut self, now: u64) {
        self.running.iter_mut().flat_map(|running| &mut running.work).for_each(|work| work.note_times(now));
    }

    /// Stores the progress of the present lesson.
    fn keep(&mut self) {
        self.progress.extend(self.present());
    }

    /// A number quoted in a text, from the run of `scene` or, if `told` after a task, from the run that fulfilled it; "…" if unknown.
    pub fn quoted(&self, reading: &Reading, scene: &Scene, told: bool) -> String {
        let value = |running: &RunningLesson| {
            running.kept(reading).filter(|_| told).or_else(|| running.present(reading, scene))
        };
        self.running.as_ref().and_then(value).map_or_else(|| "…".to_owned(), |value| reading.text(value))
    }

    /// Whether the quoted numbers are from a run of another scene than `scene`.
    pub fn tells_of_another_run(&self, scene: &Scene) -> bool {
        let (Some(running), Some((_, step))) = (&self.running, self.step()) else { return false };
        readings(step.after_task()).any(|reading| {
            let (kept, present) = (running.kept(reading), running.present(reading, scene));
            kept.zip(present).is_some_and(|(kept, present)| reading.text(kept) != reading.text(present))
        })
    }

    /// The step on screen, and the student's work on it.
    pub fn step_and_work(&mut self) -> Option<(&Step, &mut StepWork)> {
        let running = self.running.as_mut()?;
        let step = self.lessons.get(running.lesson)?.steps.get(running.step)?;
        Some((step, running.work.get_mut(running.step)?))
    }

    /// Stage of the present step; `None` without a lesson.
    pub fn stage(&self) -> Option<Stage> {
        let (_, step) = self.step()?;
        let running = self.running.as_ref()?;
        Some(running.work.get(running.step)?.stage(step))
    }

    /// Whether the step on screen asks for a number, and either none was given or the number was refused.
    pub fn lacks_number(&self) -> bool {
        let (Some((_, step)), Some(running)) = (self.step(), &self.running) else { return false };
        let asked = step.question.as_ref().is_some_and(|question| matches!(question.answer, Answer::Number { .. }));
        asked && running.work.get(running.step).is_some_and(|work| work.prediction.is_none() || work.refused)
    }

    /// The run that the step began with, to be drawn beside the one on screen while the student changes the scene.
    pub fn compared(&self, scene: &Scene) -> Option<&Arc<SolvedScene>> {
        let running = self.running.as_ref()?;
        let (_, step) = self.step()?;
        let start = &running.start;
        start.run.as_ref().filter(|_| step.task.is_some() && start.scene != *scene)
    }

    /// Whether an observation was answered by key so shortly before `now` that the reply cannot have been read yet.
    pub fn has_just_answered(&self, now: Instant) -> bool {
        let answered = self.running.as_ref().and_then(|running| running.answered);
        answered.is_some_and(|answered| now.saturating_duration_since(answered) < UNREAD)
    }

    /// The lesson after the running one.
    pub fn following(&self) -> Option<usize> {
        let next = self.running.as_ref()?.lesson + 1;
        (next < self.lessons.len()).then_some(next)
    }

    /// Shows a stop of the tour; `None`, or a stop after the last, ends the tour.
    pub fn show_tour(&mut self, stop: Option<usize>, view: &mut View) {
        self.tour = stop.filter(|stop| *stop < STOPS.len());
        if self.tour.is_some() {
            (view.parameters, view.results, view.tab) = (true, true, Tab::Motion);
        }
    }

    /// Begins a lesson, by its index, at a step or at the step where it was left. Returns whether there is such a lesson.
    pub fn open(&mut self, lesson: usize, step: Option<usize>, document: &mut Document, view: &mut View) -> bool {
        self.leave(document, view);
        let Some(chosen) = self.lessons.get(lesson) else { return false };
        let Progress { step: last, mut work, .. } = self.progress(chosen);
        let step = step.unwrap_or(last);
        let step = if step < chosen.steps.len() { step } else { 0 };
        work.resize(chosen.steps.len(), StepWork::default());
        let scene = chosen.steps[step].scene.clone();
        let practice = Document::practice(scene.clone()).with_target(document.target());
        self.tour = None;
        self.running = Some(RunningLesson {
            lesson,
            step,
            work,
            all_results: false,
            student: std::mem::replace(document, practice),
            before: (view.tab, view.parameters, view.results),
            start: StartingPoint::of(scene),
            kept: None,
            newest: Numbers::default(),
            tabs: OffTabs::default(),
            reveal: 0,
            enter: false,
            answered: None,
        });
        self.set_up(document, view, true);
        true
    }

    /// Begins the running lesson again, without answers. Returns whether there is one.
    pub fn again(&mut self, document: &mut Document, view: &mut View) -> bool {
        let Some(running) = &mut self.running else { return false };
        running.work.fill(StepWork::default());
        let lesson = running.lesson;
        self.open(lesson, Some(0), document, view)
    }

    /// Goes `by` steps forward or back; after the last step comes the recap, and then the lesson ends. Returns whether the scene has to be
    /// solved again.
    pub fn turn(&mut self, by: isize, document: &mut Document, view: &mut View) -> bool {
        let Some(running) = &mut self.running else { return false };
        let Some(lesson) = self.lessons.get(running.lesson) else { return false };
        let Some(to) = running.step.checked_add_signed(by) else { return false };
        if to > lesson.steps.len() {
            return self.leave(document, view);
        }
        if let Some(work) = running.work.get_mut(running.step) {
            work.left |= by > 0;
        }
        running.step = to;
        running.all_results = false;
        let done = running.work.get(to).is_some_and(|work| work.fulfilled);
        let again = by < 0 || done || lesson.steps.get(to).is_some_and(|step| step.sets);
        // A step that sets no scene continues with the scene that fulfilled the previous task.
        let kept = running.kept.take().filter(|_| !again);
        let brought = kept.is_some_and(|scene| document.change(scene, document.target()));
        self.keep();
        self.set_up(document, view, again) || brought
    }

    /// Sets up the view of the present step and, if `scene`, its scene; the scene of a task that is done follows later
    /// ([`Self::done_before`]). Returns whether the scene has to be solved again.
    pub fn set_up(&mut self, document: &mut Document, view: &mut View, scene: bool) -> bool {
        let Some(running) = &mut self.running else { return false };
        let Some(lesson) = self.lessons.get(running.lesson) else { return false };
        let Some(step) = lesson.steps.get(running.step) else { return false };
        view.tab = tab_at(lesson, running.step).unwrap_or(view.tab);
        // Highlighted parameters have to be visible, and the lesson takes the place of the results.
        view.parameters |= !step.highlight_keys.is_empty();
        view.results = true;
        running.all_results = false;
        running.reveal = if step.highlight_keys.is_empty() { 0 } else { REVEALED };
        let changed = scene && *document.scene() != step.scene;
        if scene {
            document.practise(step.scene.clone());
        }
        running.start = StartingPoint::of(document.scene().clone());
        running.tabs = OffTabs::default();
        let done = running.work.get(running.step).filter(|work| scene && work.fulfilled);
        running.kept = done.and_then(|work| step.changed(&work.changes));
        changed
    }

    /// The scene that fulfilled the task of the step on screen, which was set up again: returned once the run that it is compared with is
    /// there. `None` if something else has been changed by then.
    pub fn done_before(&mut self, document: &Document) -> Option<Scene> {
        let running = self.running.as_mut().filter(|running| running.kept.is_some())?;
        let (start, lesson) = (&running.start, self.lessons.get(running.lesson)?);
        let torque = document.scene().kind() == Kind::Motor && tab_at(lesson, running.step) == Some(Tab::Torque);
        let good = document.target().min(Fidelity::Standard);
        let solved = start.run.as_ref().is_some_and(|run| run.fidelity >= good);
        let known = solved && (!torque || running.tabs.start.get(Live::Stall).is_some());
        if *document.scene() != start.scene {
            running.kept = None;
        }
        running.kept.take_if(|_| known)
    }

    /// Makes the changes that fulfil the task. Returns whether the scene has to be solved again.
    pub fn show_me(&mut self, document: &mut Document) -> bool {
        if let Some((_, work)) = self.step_and_work() {
            work.shown |= !work.fulfilled;
        }
        let Some(task) = self.step().and_then(|(_, step)| step.task.as_ref()) else { return false };
        let next = document.scene().with(&task.example.changes);
        next.is_ok_and(|next| document.change(next, document.target()))
    }

    /// Actions beyond changes of keys in the example solution of the step's task.
    pub fn acts(&self) -> Vec<Act> {
        let task = self.step().and_then(|(_, step)| step.task.as_ref());
        task.map(|task| task.example.acts.clone()).unwrap_or_default()
    }

    /// Whether the step on screen belongs to `tab`.
    pub fn is_about(&self, tab: Tab) -> bool {
        self.step().is_some_and(|(_, step)| step.tab.as_deref().and_then(Tab::named) == Some(tab))
    }

    /// Ends the lesson. Returns whether one was running.
    pub fn leave(&mut self, document: &mut Document, view: &mut View) -> bool {
        self.keep();
        let Some(running) = self.running.take() else { return false };
        *document = running.student.with_target(document.target());
        (view.tab, view.parameters, view.results) = running.before;
        true
    }

    /// Whether the parameter or the part of the window of this name is highlighted: by the step on screen or, without a lesson, by the tour.
    pub fn highlights(&self, name: &str) -> bool {
        let stop = self.tour.and_then(|stop| STOPS.get(stop)).filter(|_| self.running.is_none());
        self.highlighted().chain(stop.map(|stop| stop.place)).any(|part| part == name)
    }

    /// What the step on screen highlights: keys of parameters, then parts of the window.
    fn highlighted(&self) -> impl Iterator<Item = &str> {
        let step = self.step().map(|(_, step)| step);
        let keys = step.map_or(&[][..], |step| &step.highlight_keys).iter().map(|parameter| parameter.key);
        keys.chain(step.map_or(&[][..], |step| &step.highlight_parts).iter().map(String::as_str))
    }

    /// Checks the present step against what is on screen. Returns whether another frame is needed soon: scrolling to
    /// a parameter takes some frames.
    pub fn observe(&mut self, document: &Document, seen: OnScreen<'_>) -> bool {
        let asks = self.stage() == Some(Stage::Question);
        let marked = if asks { Some(NUMBER) } else { self.highlighted().next() };
        let marked = marked.map(str::to_owned);
        (self.reveal, self.enter) = (false, None);
        let Some(running) = &mut self.running else { return false };
        self.reveal = running.reveal > 0;
        running.reveal = running.reveal.saturating_sub(1);
        // This waits until the group has opened.
        if running.reveal == 0 && std::mem::take(&mut running.enter) {
            self.enter = marked;
        }
        if let Some(lesson) = self.lessons.get(running.lesson) {
            running.judge(lesson, document, seen);
        }
        self.reveal || self.enter.is_some()
    }
}

/// The tab that a step shows: its own or, if it has none, that of the last step before it that has one.
fn tab_at(lesson: &Lesson, step: usize) -> Option<Tab> {
    lesson.steps.iter().take(step + 1).rev().find_map(|step| Tab::named(step.tab.as_deref()?))
}

/// Calls `read` with the names of the window that lessons may use.
pub fn window_names<R>(read: impl FnOnce(WindowNames<'_>) -> R) -> R {
    let labels = |plate| -> Vec<&str> {
        Tab::ALL.iter().filter(|(tab, _)| tab.is_of(plate)).map(|(tab, _)| tab.label(plate)).collect()
    };
    let (motor, plate) = (labels(false), labels(true));
    read(WindowNames { tabs: [&motor, &plate], places: PLACES })
}
