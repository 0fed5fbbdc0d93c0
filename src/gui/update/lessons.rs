//! Carries out the commands of lessons.

use super::updater::Updater;
use crate::gui::command::{Command, HoldCommand, LessonCommand};
use crate::gui::state::running_lesson::RunningLesson;
use crate::gui::state::tour::STOPS;
use crate::gui::state::view::Tab;
use crate::gui::state::window::State;
use crate::lessons::work::{Stage, StepWork};
use crate::lessons::{Act, Prediction, Step};
use crate::platform::SystemTime;
use std::path::Path;

impl Updater {
    /// Adds the lessons of a folder, and shows errors about those that cannot be read.
    pub fn load_lessons(&mut self, folder: &Path) {
        if self.state.lessons.load(folder) {
            self.leave_lesson();
        }
        self.say_faults();
    }

    /// Reads all folders of lessons again; a running lesson stays at its step.
    fn reload_lessons(&mut self) {
        let place = self.state.lessons.running.as_ref().map(|running| (running.lesson, running.step));
        let changed = self.state.lessons.reload();
        if let (true, Some((lesson, step))) = (changed, place) {
            self.teach(LessonCommand::Open(lesson, Some(step)));
        }
        self.say_faults();
    }

    fn say_faults(&mut self) {
        let faults: Vec<String> = self.state.lessons.faults.iter().map(ToString::to_string).collect();
        if !faults.is_empty() {
            self.state.fail(faults.join("\n"));
        }
    }

    /// Checks the lesson against what is on screen, and records the time of completed tasks. Returns whether another frame is needed soon.
    pub fn observe(&mut self) -> bool {
        let soon = self.state.observe();
        let State { document, lessons, .. } = &mut self.state;
        if let Some(scene) = lessons.done_before(document) {
            self.change_scene(scene);
        }
        if let Ok(since) = (self.platform.date)().duration_since(SystemTime::UNIX_EPOCH) {
            self.state.lessons.note_times(since.as_secs());
        }
        soon
    }

    pub(super) fn teach(&mut self, command: LessonCommand) {
        let State { document, view, lessons, .. } = &mut self.state;
        let shows = command == LessonCommand::ShowMe;
        let (replaced, sets_up) = match command {
            LessonCommand::Open(lesson, step) => (lessons.open(lesson, step, document, view), true),
            LessonCommand::Again => (lessons.again(document, view), true),
            LessonCommand::Next => (lessons.turn(1, document, view), true),
            LessonCommand::Back => (lessons.turn(-1, document, view), true),
            LessonCommand::Leave => (lessons.leave(document, view), false),
            LessonCommand::SetUp => (lessons.set_up(document, view, true), true),
            LessonCommand::ShowMe => (lessons.show_me(document), false),
            LessonCommand::AllResults(all) => {
                lessons.running.iter_mut().for_each(|running| running.all_results = all);
                (false, false)
            }
            LessonCommand::Choose(choice) => return self.choose(choice),
            LessonCommand::GoOn => return self.go_on(),
            LessonCommand::Faults => return self.say_faults(),
            LessonCommand::Reload => return self.reload_lessons(),
            LessonCommand::Predict(_) | LessonCommand::Commit | LessonCommand::Observe(_) | LessonCommand::Hint => {
                if let Some((step, work)) = lessons.step_and_work() {
                    answer(&command, step, work);
                }
                (false, false)
            }
        };
        if replaced {
            self.scene_replaced();
        }
        if sets_up {
            self.put_to_rest();
        }
        if shows {
            self.state.lessons.acts().into_iter().for_each(|act| self.act(act));
        }
        self.tell_page();
    }

    /// Answers the present question of the step with one of its choices.
    fn choose(&mut self, choice: usize) {
        match self.state.lessons.stage() {
            Some(Stage::Question) => self.teach(LessonCommand::Predict(Prediction::Choice(choice))),
            Some(Stage::Observation) => {
                let now = self.now();
                self.state.lessons.running.iter_mut().for_each(|running| running.answered = Some(now));
                self.teach(LessonCommand::Observe(choice));
            }
            _ => {}
        }
    }

    /// Does the next thing in the tour, whose last stop leads to the first lesson, or in a lesson.
    fn go_on(&mut self) {
        if let Some(stop) = self.state.lessons.tour {
            return match stop + 1 < STOPS.len() {
                true => self.carry_out(Command::Tour(Some(stop + 1))),
                false => self.teach(LessonCommand::Open(0, Some(0))),
            };
        }
        match self.state.lessons.stage() {
            Some(Stage::Question) if !self.state.lessons.lacks_number() => self.teach(LessonCommand::Commit),
            Some(Stage::Question | Stage::Task) => {
                self.state.lessons.running.iter_mut().for_each(RunningLesson::enter_marked);
            }
            Some(Stage::Observation) => {}
            // Users press Enter after an answer out of habit.
            Some(Stage::Told) if self.state.lessons.has_just_answered(self.now()) => {}
            Some(Stage::Told) => self.teach(LessonCommand::Next),
            None => {
                if let Some(next) = self.state.lessons.following() {
                    self.teach(LessonCommand::Open(next, None));
                }
            }
        }
    }

    /// Puts the held plate to rest and clears the start-up, so that a step begins with neither.
    fn put_to_rest(&mut self) {
        if self.state.lessons.is_about(Tab::Hold) {
            self.hold(HoldCommand::Reset);
        }
        if self.state.lessons.is_about(Tab::Startup) {
            self.state.startup = None;
            self.state.dropped = None;
        }
    }

    /// Carries out an action of the example solution of a task in its tab.
    fn act(&mut self, act: Act) {
        match act {
            Act::Hold(gap) => {
                self.state.view.tab = Tab::Hold;
                self.update_hold();
                self.hold(HoldCommand::To(gap * 1e-6));
            }
            Act::StartUp => {
                self.state.view.tab = Tab::Startup;
                self.start_from_rest();
            }
        }
    }

    /// Restores the student's own scene, if a lesson has set it aside.
    pub(super) fn leave_lesson(&mut self) {
        let State { document, view, lessons, .. } = &mut self.state;
        if lessons.leave(document, view) {
            self.scene_replaced();
        }
    }
}

/// An answer, or a request for help, in a step.
fn answer(command: &LessonCommand, step: &Step, work: &mut StepWork) {
    match (command, &step.question, &step.observe, &step.task) {
        (LessonCommand::Predict(prediction), Some(question), ..) if question.answer.takes(*prediction) => {
            work.predict(*prediction);
        }
        (LessonCommand::Commit, Some(question), ..) => work.commit(question),
        (LessonCommand::Observe(choice), _, Some(observe), _)
            if work.stage(step) == Stage::Observation && observe.answer.takes(Prediction::Choice(*choice)) =>
        {
            work.observe(observe, *choice);
        }
        (LessonCommand::Hint, _, _, Some(task)) => work.hints = (work.hints + 1).min(task.hints.len()),
        _ => {}
    }
}
