//! The running lesson: its step, the student's work, and the run that the step began with.

use super::document::Document;
use super::lesson_tabs::{OffTabs, OnScreen};
use super::view::Tab;
use crate::analysis::quantity::Numbers;
use crate::fidelity::Fidelity;
use crate::job::SolvedScene;
use crate::lessons::Lesson;
use crate::lessons::check::{Ran, Reading};
use crate::lessons::live::{Live, Readings};
use crate::lessons::text::readings;
use crate::lessons::work::{Stage, StepWork};
use crate::platform::Instant;
use crate::scene::Scene;
use crate::solution::Status;
use std::sync::Arc;

/// Number of frames in which the window scrolls to a highlighted parameter: its group takes some frames to open.
pub(super) const REVEALED: u8 = 16;

/// The run that a step compares with.
#[derive(Clone, Debug)]
pub struct StartingPoint {
    /// The scene that the step began with.
    pub scene: Scene,
    /// Its run, the finest so far.
    pub run: Option<Arc<SolvedScene>>,
    /// Its results.
    pub numbers: Numbers,
}

impl StartingPoint {
    pub(super) fn of(scene: Scene) -> Self {
        Self { scene, run: None, numbers: Numbers::default() }
    }
}

/// The lesson that is followed.
#[derive(Debug)]
pub struct RunningLesson {
    /// Its place in the list.
    pub lesson: usize,
    /// Its step.
    pub step: usize,
    /// Answers and tasks done, by step.
    pub work: Vec<StepWork>,
    /// Whether all results are shown in place of the text.
    pub all_results: bool,
    /// The student's own scene.
    pub(super) student: Document,
    /// View before the lesson: the tab, and whether parameters and results were shown.
    pub(super) before: (Tab, bool, bool),
    /// Scene and run that the step began with.
    pub start: StartingPoint,
    /// The scene that fulfilled the task of a step that was set up again. It is restored when the run that it is compared with is there.
    pub(super) kept: Option<Scene>,
    /// The newest run of the present scene; none is known while there is no run.
    pub newest: Numbers,
    /// Numbers read off the tabs.
    pub tabs: OffTabs,
    pub(super) reveal: u8,
    /// Whether the marked widget, or the field for an answer, is to get the keyboard focus.
    pub(super) enter: bool,
    /// When a key last answered an observation: the reply has to be read before Enter leads on.
    pub answered: Option<Instant>,
}

impl RunningLesson {
    /// Gives the keyboard focus to the marked widget, or to the field for an answer.
    pub fn enter_marked(&mut self) {
        (self.enter, self.reveal) = (true, REVEALED);
    }

    /// The value in the run that fulfilled the task.
    pub(super) fn kept(&self, reading: &Reading) -> Option<f64> {
        self.work.get(self.step)?.readings.get(&reading.source).copied()
    }

    /// The value in the run of `scene`.
    pub(super) fn present(&self, reading: &Reading, scene: &Scene) -> Option<f64> {
        let [now, start] = self.ran(scene);
        reading.value(now, start)
    }

    /// The run of `scene`, and the one that the step began with.
    pub fn ran<'a>(&'a self, scene: &'a Scene) -> [Ran<'a>; 2] {
        let Self { start, newest, tabs, .. } = self;
        let now = Ran { scene, numbers: newest, live: &tabs.now };
        [now, Ran { scene: &start.scene, numbers: &start.numbers, live: &tabs.start }]
    }

    /// Checks the present step against the run on screen: its starting point, and whether its task is fulfilled.
    pub(super) fn judge(&mut self, lesson: &Lesson, document: &Document, seen: OnScreen<'_>) {
        (self.newest, self.tabs.now) = (Numbers::default(), Readings::default());
        let scene = document.scene();
        let Some(run) = seen.run.filter(|run| run.scene == *scene && run.solution.status == Status::Converged) else {
            // A verdict on another scene does not hold for this one.
            if let Some(work) = self.work.get_mut(self.step) {
                (work.unmet, work.too_far) = (None, false);
            }
            return;
        };
        self.newest = Numbers::of(&run.problem, &run.solution);
        self.tabs.read(run, seen);
        let start = &mut self.start;
        if run.scene == start.scene && start.run.as_ref().is_none_or(|found| found.fidelity <= run.fidelity) {
            (start.run, start.numbers) = (Some(Arc::clone(run)), self.newest);
            for live in Live::all().filter(|live| !live.is_done_by_hand()) {
                if let Some(value) = self.tabs.now.get(live) {
                    self.tabs.start.set(live, value);
                }
            }
        }
        let Some((step, task)) = lesson.steps.get(self.step).and_then(|step| Some((step, step.task.as_ref()?))) else {
            return;
        };
        // A draft is not accurate enough for a verdict, and a value counts only when the pointer has released the slider.
        let ready = run.fidelity >= document.target().min(Fidelity::Standard) && !document.is_dragging();
        let [now, before] = self.ran(scene);
        let unmet = task.check.unmet(now, before);
        let beyond = task.too_far.as_ref().is_some_and(|(limit, _)| limit.unmet(now, before).is_none());
        let does = ready && unmet.is_none() && !beyond;
        let moved = |live: Live| live.is_done_by_hand() && now.live.get(live) != before.live.get(live);
        let tried = now.scene != before.scene || task.check.live().any(moved);
        let told =
            readings(step.after_task()).filter_map(|of| Some((of.source.clone(), of.value(now, before)?))).collect();
        let Some(work) = self.work.get_mut(self.step) else { return };
        let open = work.stage(step) == Stage::Task;
        if open && ready {
            work.tried = tried;
            (work.too_far, work.unmet) = (unmet.is_none() && beyond, unmet);
            work.fulfilled |= does;
        }
        // The quoted numbers follow the run on screen, as long as it fulfils the task too. (A held plate has moved on.)
        if does && work.fulfilled && (open || !task.check.live().any(Live::is_done_by_hand)) {
            (work.readings, work.changes) = (told, step.changes(scene));
        }
    }
}
