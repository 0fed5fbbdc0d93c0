//! What a student did in a lesson, step by step: answers, tasks, what was skipped. It is kept from window to window.

use super::lesson::{Answer, Kind, Prediction, Question, Step};
use super::text::plain;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Tries of a calculation.
const TRIES: usize = 2;

/// How far a lesson was followed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Progress {
    /// The step that comes next.
    pub step: usize,
    /// Whether everything in it was done, once.
    pub done: bool,
    /// What was done, by step.
    pub work: Vec<StepWork>,
}

/// What a student did in one step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct StepWork {
    /// What was answered, if anything yet.
    pub prediction: Option<Prediction>,
    /// Whether it was committed to.
    pub committed: bool,
    /// Calculations that were wrong.
    pub wrong: usize,
    /// Whether the task was fulfilled.
    pub fulfilled: bool,
    /// The student's answer to the observation, if any yet.
    pub observed: Option<usize>,
    /// Number of wrong answers to the observation.
    pub misread: usize,
    /// Hints that were asked for.
    pub hints: usize,
    /// Whether the program did the task.
    pub shown: bool,
    /// Whether the student went on from here.
    pub left: bool,
    /// Numbers of the run that fulfilled the task, as texts quote them.
    pub readings: BTreeMap<String, f64>,
    /// When it was done.
    pub times: Times,
    /// Why the task is not fulfilled, of the newest run.
    #[serde(skip)]
    pub unmet: Option<String>,
    /// Whether anything was tried.
    #[serde(skip)]
    pub tried: bool,
    /// Whether the newest run goes beyond what the task is about.
    #[serde(skip)]
    pub too_far: bool,
    /// Whether the answer is one that was found wrong already.
    #[serde(skip)]
    pub refused: bool,
}

/// When something was done in a step \[s since 1970, UTC\], as far as it was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Times {
    /// The answer was committed to.
    pub question: Option<u64>,
    /// The task was fulfilled.
    pub task: Option<u64>,
    /// It was said what was seen.
    pub observation: Option<u64>,
    /// The student went on.
    pub step: Option<u64>,
}

/// What a step waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// An answer.
    Question,
    /// Its task.
    Task,
    /// What was seen.
    Observation,
    /// Nothing: all of it is told.
    Told,
}

impl StepWork {
    /// What the step waits for.
    pub fn stage(&self, step: &Step) -> Stage {
        if step.question.is_some() && !self.committed {
            Stage::Question
        } else if step.task.is_some() && !self.fulfilled {
            Stage::Task
        } else if step.observe.as_ref().is_some_and(|observe| !self.has_seen(observe)) {
            Stage::Observation
        } else {
            Stage::Told
        }
    }

    /// Whether the student went on before everything was done.
    pub fn is_skipped(&self, step: &Step) -> bool {
        self.left && self.stage(step) != Stage::Told
    }

    fn has_seen(&self, observe: &Question) -> bool {
        self.observed.is_some_and(|choice| observe.answer.is_right(Prediction::Choice(choice)))
    }

    /// Notes that what is done, and was not when this was last asked for, was done at `now` \[s since 1970, UTC\].
    pub fn note_times(&mut self, now: u64) {
        let Times { question, task, observation, step } = &mut self.times;
        let observed = self.observed.is_some();
        let parts = [(self.committed, question), (self.fulfilled, task), (observed, observation), (self.left, step)];
        for (_, time) in parts.into_iter().filter(|(done, _)| *done) {
            time.get_or_insert(now);
        }
    }

    /// Gives the answer, for now.
    pub fn predict(&mut self, prediction: Prediction) {
        if !self.committed {
            self.refused &= self.prediction == Some(prediction);
            self.prediction = Some(prediction);
        }
    }

    /// Keeps to the answer. A calculation that is wrong has another try, with another number.
    pub fn commit(&mut self, question: &Question) {
        let Some(given) = self.prediction.filter(|_| !self.committed && !self.refused) else { return };
        let wrong = question.kind == Kind::Calculate && !question.answer.is_right(given);
        self.wrong += usize::from(wrong);
        self.refused = wrong;
        self.committed = !wrong || self.wrong >= TRIES;
    }

    /// Says what was seen.
    pub fn observe(&mut self, observe: &Question, choice: usize) {
        if !self.has_seen(observe) {
            self.observed = Some(choice);
            self.misread += usize::from(!self.has_seen(observe));
        }
    }
}

/// What came of a lesson.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Score {
    /// Predictions that came true, of all.
    pub predictions: [usize; 2],
    /// Calculations that were right, of all.
    pub calculations: [usize; 2],
    /// Observations that were right at the first look, of all.
    pub observations: [usize; 2],
    /// Tasks that the student did without being shown how, of all.
    pub tasks: [usize; 2],
    /// Steps that were skipped, of all.
    pub skipped: [usize; 2],
}

impl Score {
    /// Of all steps.
    pub fn of<'a>(steps: impl IntoIterator<Item = (&'a Step, &'a StepWork)>) -> Self {
        let mut score = Self::default();
        let count = |[good, all]: &mut [usize; 2], is_good: bool| {
            *good += usize::from(is_good);
            *all += 1;
        };
        for (step, work) in steps {
            if let Some(question) = &step.question {
                let right = work.committed && work.prediction.is_some_and(|given| question.answer.is_right(given));
                let calculated = question.kind == Kind::Calculate;
                count(if calculated { &mut score.calculations } else { &mut score.predictions }, right);
            }
            if let Some(observe) = &step.observe {
                count(&mut score.observations, work.has_seen(observe) && work.misread == 0);
            }
            if step.task.is_some() {
                count(&mut score.tasks, work.fulfilled && !work.shown);
            }
            count(&mut score.skipped, work.is_skipped(step));
        }
        score
    }

    /// Points, of all that can be had.
    pub fn points(&self) -> [usize; 2] {
        let parts = [self.predictions, self.calculations, self.observations, self.tasks];
        parts.into_iter().fold([0, 0], |[points, all], [good, of]| [points + good, all + of])
    }
}

/// The right answer in words: what a recap says of a step.
pub fn answer_words(question: &Question) -> String {
    match &question.answer {
        Answer::Choice { choices, right } => choices.get(*right).map(|choice| plain(&choice.text)).unwrap_or_default(),
        Answer::Number { value, unit, .. } => format!("{value} {unit}").trim().to_owned(),
    }
}
