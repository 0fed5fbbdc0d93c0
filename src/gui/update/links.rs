//! Links: copies links to the present view, and follows links.

use super::updater::Updater;
use crate::analysis::quantity::{Numbers, Quantity, force_unit};
use crate::gui::command::{Command, LessonCommand};
use crate::gui::derived::format::uncertain;
use crate::gui::state::document::Next;
use crate::gui::state::link::Link;
use crate::lessons::text::plain_blocks;
use crate::platform::HAS_FILES;
use crate::platform::window::{page, publish};
use crate::solution::Outcome;

impl Updater {
    /// Copies a link to the step of the lesson that runs, or to the scene.
    pub(super) fn copy_link(&mut self) {
        let state = &self.state;
        let link = match state.lessons.running.as_ref() {
            Some(running) => {
                // The recap after the last step has no number.
                let steps = state.lessons.lessons[running.lesson].steps.len();
                Link::to_lesson(running.lesson + 1, (running.step + 1).min(steps))
            }
            None => Link::to(state.document.scene(), state.view.tab),
        };
        self.ctx.copy_text(format!("{}{link}", page()));
    }

    /// Gives the page the run on screen, and a text about it and about the lesson for screen readers.
    pub(super) fn tell_page(&self) {
        let Some(run) = self.state.run.as_ref().filter(|_| !HAS_FILES) else { return };
        let known = Numbers::of(&run.problem, &run.solution);
        let numbers =
            Quantity::all().filter_map(|quantity| Some((quantity.name().to_owned(), known.get(quantity)?.into())));
        let result = match run.solution.outcome {
            Outcome::Motor(found) => format!("α {}", uncertain(found.alpha)),
            Outcome::Plate(found) => {
                format!("film load {} {}", uncertain(found.film_load), force_unit(&run.problem))
            }
        };
        let lessons = &self.state.lessons;
        let lesson = lessons.running.as_ref().zip(lessons.step()).map(|(running, (lesson, step))| {
            let (number, of) = (running.step + 1, lesson.steps.len());
            format!("{}, step {number} of {of}: {}. {}", lesson.title, step.title, plain_blocks(&step.body))
        });
        publish(serde_json::json!({
            "scene": run.scene.name,
            "fidelity": run.fidelity.to_string(),
            "numbers": numbers.collect::<serde_json::Map<_, _>>(),
            "said": format!("{}: {result}, {}", run.scene.name, run.fidelity),
            "lesson": lesson,
        }));
    }

    /// Opens the target of a link; asks first if that would lose unsaved changes.
    pub fn follow(&mut self, link: Link) {
        self.carry_out(Command::Tour(None));
        match link {
            Link::Scene { document, tab } => {
                self.carry_out(Command::Proceed(Next::Given(document)));
                tab.into_iter().for_each(|tab| self.carry_out(Command::Show(tab)));
            }
            Link::Lesson { lesson, step } => {
                let Some(found) = self.state.lessons.lessons.get(lesson - 1) else {
                    let most = self.state.lessons.lessons.len();
                    return self
                        .state
                        .fail(format!("there is no lesson {lesson}: the lessons are numbered from 1 to {most}"));
                };
                let most = found.steps.len();
                if step > most {
                    return self.state.fail(format!("step {step}: lesson {lesson} has {most} steps"));
                }
                self.carry_out(LessonCommand::Open(lesson - 1, Some(step - 1)).into());
            }
        }
    }

    /// Opens the target of an address that the user has entered, or shows an error if it cannot be read.
    pub fn visit(&mut self, address: &str) {
        match Link::read(address) {
            Ok(link) => self.follow(link),
            Err(error) => self.state.fail(error),
        }
    }
}
