//! A lesson as data: its steps, questions and tasks.

use super::check::{Check, Name};
use super::text::{Block, Inline};
use crate::scene::{Parameter, Scene};
use serde::{Deserialize, Serialize};

/// What a lesson may name in the window.
#[derive(Clone, Copy, Debug, Default)]
pub struct WindowNames<'a> {
    /// Names of the tabs in the middle that a motor has, and that a plate has.
    pub tabs: [&'a [&'a str]; 2],
    /// Names of what can be lit.
    pub places: &'a [&'a str],
}

/// A lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Lesson {
    /// The name of its folder: what its progress is kept under.
    pub id: String,
    /// Its title.
    pub title: String,
    /// A line or two on what it is about.
    pub about: Vec<Block>,
    /// Its steps, at least one.
    pub steps: Vec<Step>,
}

/// One step of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Its heading.
    pub title: String,
    /// What it says.
    pub body: Vec<Block>,
    /// The scene of a student who comes straight here.
    pub scene: Scene,
    /// Whether the scene is set up anew; otherwise the step goes on with what is there.
    pub sets: bool,
    /// Parameters that are lit.
    pub light: Vec<&'static Parameter>,
    /// Parts of the window that are lit.
    pub look: Vec<String>,
    /// The tab that is brought forward.
    pub tab: Option<String>,
    /// Results and keys that are shown beside the text.
    pub show: Vec<Name>,
    /// What is asked before anything is tried.
    pub question: Option<Question>,
    /// What is to be done.
    pub task: Option<Task>,
    /// What is asked once it is done, before anything is explained.
    pub observe: Option<Question>,
}

/// A question, answered before the answer is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// What the answer comes from.
    pub kind: Kind,
    /// What is asked.
    pub ask: Vec<Block>,
    /// The answer.
    pub answer: Answer,
    /// Help after a first wrong calculation.
    pub hint: Vec<Block>,
    /// Why it is so.
    pub why: Vec<Block>,
}

/// What an answer comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A guess with reasons: made once, and not held against anyone.
    Predict,
    /// Arithmetic: it has a second try.
    Calculate,
    /// What was seen on the screen: one looks again until it is right.
    Observe,
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// One of several.
    Choice {
        /// All.
        choices: Vec<Choice>,
        /// The right one.
        right: usize,
    },
    /// A number.
    Number {
        /// The right one.
        value: f64,
        /// Its unit; empty for a pure number.
        unit: String,
        /// How far a good answer may be off, relative.
        within: f64,
    },
}

/// One of several answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// In words.
    pub text: Vec<Inline>,
    /// What is said to whoever chose it, although it is wrong; may be empty.
    pub reply: Vec<Block>,
}

/// Changes of a scene, by key, as after `--set`.
pub type Changes = Vec<(String, String)>;

/// What a student does in a tab, which leaves the scene as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Act {
    /// Moves the held plate to this gap \[µm\].
    Hold(f64),
    /// Starts from rest.
    StartUp,
}

/// Actions tried on a task: changes of the scene, and actions in a tab.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Doing {
    /// Changes of the scene.
    pub changes: Changes,
    /// And in a tab.
    pub acts: Vec<Act>,
}

impl Doing {
    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty() && self.acts.is_empty()
    }
}

/// What is to be done, and how it is seen that it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// In words.
    pub ask: Vec<Block>,
    /// What the student's run is checked for.
    pub check: Check,
    /// What goes beyond the aim although the check holds, and what is said then.
    pub too_far: Option<(Check, Vec<Block>)>,
    /// Help, given one after the other on request.
    pub hints: Vec<Vec<Block>>,
    /// Actions that fulfil the task, shown on request.
    pub example: Doing,
    /// Actions that must not fulfil the task, for tests.
    pub wrong: Doing,
    /// What is said once it holds.
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

    /// Whether an answer is of this kind, and one of the choices.
    pub fn takes(&self, given: Prediction) -> bool {
        match (self, given) {
            (Self::Choice { choices, .. }, Prediction::Choice(choice)) => choice < choices.len(),
            (Self::Number { .. }, Prediction::Number(_)) => true,
            _ => false,
        }
    }

    /// What is said to whoever gave this wrong answer; empty if nothing is.
    pub fn reply(&self, given: Prediction) -> &[Block] {
        match (self, given) {
            (Self::Choice { choices, .. }, Prediction::Choice(choice)) => {
                choices.get(choice).map_or(&[], |choice| choice.reply.as_slice())
            }
            _ => &[],
        }
    }
}

impl Step {
    /// What is said once everything is done: it may quote numbers of the run that did it.
    pub fn told(&self) -> impl Iterator<Item = &Block> {
        let questions = [&self.question, &self.observe].into_iter().flatten();
        let said = questions.flat_map(|question| {
            let replies = match &question.answer {
                Answer::Choice { choices, .. } => choices.as_slice(),
                Answer::Number { .. } => &[],
            };
            question.why.iter().chain(replies.iter().flat_map(|choice| &choice.reply))
        });
        said.chain(self.task.iter().flat_map(|task| &task.then))
    }
}

/// What a student answers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Prediction {
    /// One of several.
    Choice(usize),
    /// A number, in the unit of the question.
    Number(f64),
}
