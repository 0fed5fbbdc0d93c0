//! A lesson as data: its steps, questions and tasks.

use super::check::{Check, Name};
use super::text::{Block, Inline, plain};
use crate::scene::{Parameter, Scene};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The names of the window that a lesson may use.
#[derive(Clone, Copy, Debug, Default)]
pub struct WindowNames<'a> {
    /// Names of the tabs of a motor, and of those of a plate.
    pub tabs: [&'a [&'a str]; 2],
    /// Names of the parts of the window that can be highlighted.
    pub places: &'a [&'a str],
}

/// A lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Lesson {
    /// The name of its folder, under which the student's progress is kept.
    pub id: String,
    /// Its title.
    pub title: String,
    /// Its subject, in a line or two.
    pub about: Vec<Block>,
    /// Its steps, at least one.
    pub steps: Vec<Step>,
}

/// One step of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Its heading.
    pub title: String,
    /// Its text.
    pub body: Vec<Block>,
    /// The scene of a student who begins with this step.
    pub scene: Scene,
    /// Whether the step sets its scene. If not, it goes on with the scene of the student.
    pub sets: bool,
    /// Parameters that are highlighted.
    pub highlight_keys: Vec<&'static Parameter>,
    /// Names of the parts of the window that are highlighted.
    pub highlight_parts: Vec<String>,
    /// The tab that is shown.
    pub tab: Option<String>,
    /// Results and keys that are shown beside the text.
    pub show: Vec<Name>,
    /// The question before the task.
    pub question: Option<Question>,
    /// The task.
    pub task: Option<Task>,
    /// The question about what was seen, after the task and before the explanation.
    pub observe: Option<Question>,
}

/// A question, answered before the answer is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// How the answer is found.
    pub kind: QuestionKind,
    /// The text of the question.
    pub ask: Vec<Block>,
    /// The answer.
    pub answer: Answer,
    /// Help after the first wrong calculation.
    pub hint: Vec<Block>,
    /// The explanation of the answer.
    pub why: Vec<Block>,
}

/// How an answer is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuestionKind {
    /// By a reasoned guess. There is one try, and a wrong guess has no consequences.
    Predict,
    /// By arithmetic. There are two tries.
    Calculate,
    /// By looking at the screen. The student looks again until the answer is right.
    Observe,
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// One of several choices.
    Choice {
        /// All choices.
        choices: Vec<Choice>,
        /// The index of the right one.
        right: usize,
    },
    /// A number.
    Number {
        /// The right number.
        value: f64,
        /// Its unit; empty for a pure number.
        unit: String,
        /// Relative deviation up to which an answer counts as right.
        within: f64,
    },
}

/// One of the choices of a question.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The choice in words.
    pub text: Vec<Inline>,
    /// The reply to a student who made this choice although it is wrong; may be empty.
    pub reply: Vec<Block>,
}

/// Changes of a scene: keys and values, as `--set` takes them.
pub type Changes = Vec<(String, String)>;

/// An action in a tab, which does not change the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Act {
    /// The held plate is moved to this gap \[µm\].
    Hold(f64),
    /// The start-up from rest is started.
    StartUp,
}

/// Actions tried on a task: changes of the scene, and actions in a tab.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Doing {
    /// Changes of the scene.
    pub changes: Changes,
    /// Actions in a tab.
    pub acts: Vec<Act>,
}

impl Doing {
    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty() && self.acts.is_empty()
    }
}

/// A task, and the check that it is fulfilled.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// The text of the task.
    pub ask: Vec<Block>,
    /// The check of the student's run.
    pub check: Check,
    /// A check that holds for runs that go beyond the aim, and the text that is shown then.
    pub too_far: Option<(Check, Vec<Block>)>,
    /// Hints, shown one after the other on request.
    pub hints: Vec<Vec<Block>>,
    /// Actions that fulfil the task, shown on request.
    pub example: Doing,
    /// Actions that must not fulfil the task, for tests.
    pub wrong: Doing,
    /// The text that is shown once the check holds.
    pub then: Vec<Block>,
}

impl Answer {
    /// Whether an answer is right.
    pub fn is_right(&self, given: Prediction) -> bool {
        match (self, given) {
            (Self::Choice { right, .. }, Prediction::Choice(choice)) => *right == choice,
            (Self::Number { value, within, .. }, Prediction::Number(number)) => {
                (number - value).abs() <= within * value.abs() * (1.0 + 1e-9)
            }
            _ => false,
        }
    }

    /// The right answer.
    pub fn right(&self) -> Prediction {
        match self {
            Self::Choice { right, .. } => Prediction::Choice(*right),
            Self::Number { value, .. } => Prediction::Number(*value),
        }
    }

    /// All choices; none if a number is asked for.
    pub fn choices(&self) -> &[Choice] {
        match self {
            Self::Choice { choices, .. } => choices,
            Self::Number { .. } => &[],
        }
    }

    fn choice(&self, given: Prediction) -> Option<&Choice> {
        if let Prediction::Choice(choice) = given { self.choices().get(choice) } else { None }
    }

    /// An answer in words.
    pub fn words(&self, given: Prediction) -> String {
        match (self, given) {
            (Self::Number { unit, .. }, Prediction::Number(number)) => format!("{number} {unit}").trim().to_owned(),
            _ => self.choice(given).map(|choice| plain(&choice.text)).unwrap_or_default(),
        }
    }

    /// Whether an answer is possible: a number where a number is asked for, or one of the choices.
    pub fn takes(&self, given: Prediction) -> bool {
        matches!((self, given), (Self::Number { .. }, Prediction::Number(_))) || self.choice(given).is_some()
    }

    /// The reply to this answer; empty if there is none.
    pub fn reply(&self, given: Prediction) -> &[Block] {
        self.choice(given).map_or(&[], |choice| &choice.reply)
    }
}

impl Step {
    /// The texts that are shown after the task: explanations and replies. They may quote numbers of the run that fulfilled it.
    pub fn after_task(&self) -> impl Iterator<Item = &Block> {
        let questions = [&self.question, &self.observe].into_iter().flatten();
        let said = questions.flat_map(|question| {
            question.why.iter().chain(question.answer.choices().iter().flat_map(|choice| &choice.reply))
        });
        said.chain(self.task.iter().flat_map(|task| &task.then))
    }

    /// How `scene` differs from the scene that the step begins with: values by key, as `--set` takes them.
    pub fn changes(&self, scene: &Scene) -> BTreeMap<String, String> {
        let text = |parameter: &Parameter| scene.given_text(parameter).unwrap_or_else(|| "none".to_owned());
        scene.changed(&self.scene).map(|parameter| (parameter.key.to_owned(), text(parameter))).collect()
    }

    /// The scene that the step begins with, with these changes; `None` if there are none, or if they are not allowed.
    pub fn changed(&self, changes: &BTreeMap<String, String>) -> Option<Scene> {
        self.scene.with(changes).ok().filter(|_| !changes.is_empty())
    }
}

/// A student's answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Prediction {
    /// The index of a choice.
    Choice(usize),
    /// A number, in the unit of the question.
    Number(f64),
}
