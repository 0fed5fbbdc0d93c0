//! A student's work in a lesson, step by step: answers, tasks, and steps that were skipped. It is kept when the window is closed.

use super::lesson::{Prediction, Question, QuestionKind, Step};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Most tries of a calculation.
const TRIES: usize = 2;

/// How far a student has come in a lesson.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Progress {
    /// The step that comes next.
    pub step: usize,
    /// Whether the whole lesson was completed at least once.
    pub done: bool,
    /// The work in each step.
    pub work: Vec<StepWork>,
}

/// A student's work in one step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StepWork {
    /// The answer to the question, if there is one yet.
    pub prediction: Option<Prediction>,
    /// Whether the answer is final.
    pub committed: bool,
    /// Number of wrong calculations.
    pub wrong: usize,
    /// Whether the task was fulfilled.
    pub fulfilled: bool,
    /// The student's answer to the observation, if any yet.
    pub observed: Option<usize>,
    /// Number of wrong answers to the observation.
    pub misread: usize,
    /// Number of hints that were shown.
    pub hints: usize,
    /// Whether the program showed how to do the task.
    pub shown: bool,
    /// Whether the student has gone on to another step.
    pub left: bool,
    /// Numbers of the run that fulfilled the task, by their source in the texts that quote them.
    pub readings: BTreeMap<String, f64>,
    /// How the scene that fulfilled the task differs from that of the step: values by key, as `--set` takes them.
    pub changes: BTreeMap<String, String>,
    /// When the parts of the step were done.
    pub times: Times,
    /// Why the newest run does not fulfil the task.
    #[serde(skip)]
    pub unmet: Option<String>,
    /// Whether the student has tried anything.
    #[serde(skip)]
    pub tried: bool,
    /// Whether the newest run goes beyond what the task is about.
    #[serde(skip)]
    pub too_far: bool,
    /// Whether the answer was already found to be wrong.
    #[serde(skip)]
    pub refused: bool,
}

/// When the parts of a step were done \[s since 1970, UTC\]; `None` if they were not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Times {
    /// The answer became final.
    pub question: Option<u64>,
    /// The task was fulfilled.
    pub task: Option<u64>,
    /// The observation was answered.
    pub observation: Option<u64>,
    /// The student went on.
    pub step: Option<u64>,
}

/// The part of a step that comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The question.
    Question,
    /// The task.
    Task,
    /// The question about what was seen.
    Observation,
    /// Nothing is left: the explanation is shown.
    Told,
}

impl StepWork {
    /// The part of the step that comes next.
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

    /// Notes the time `now` \[s since 1970, UTC\] for every part that has been done since the last call.
    pub fn note_times(&mut self, now: u64) {
        let Times { question, task, observation, step } = &mut self.times;
        let observed = self.observed.is_some();
        let parts = [(self.committed, question), (self.fulfilled, task), (observed, observation), (self.left, step)];
        for (_, time) in parts.into_iter().filter(|(done, _)| *done) {
            time.get_or_insert(now);
        }
    }

    /// Sets the answer, until it is final.
    pub fn predict(&mut self, prediction: Prediction) {
        if !self.committed {
            self.refused &= self.prediction == Some(prediction);
            self.prediction = Some(prediction);
        }
    }

    /// Makes the answer final. After a first wrong calculation there is another try, with another number.
    pub fn commit(&mut self, question: &Question) {
        let Some(given) = self.prediction.filter(|_| !self.committed && !self.refused) else { return };
        let wrong = question.kind == QuestionKind::Calculate && !question.answer.is_right(given);
        self.wrong += usize::from(wrong);
        self.refused = wrong;
        self.committed = !wrong || self.wrong >= TRIES;
    }

    /// Answers the question about what was seen.
    pub fn observe(&mut self, observe: &Question, choice: usize) {
        if !self.has_seen(observe) {
            self.observed = Some(choice);
            self.misread += usize::from(!self.has_seen(observe));
        }
    }
}

/// The result of a lesson: of each kind of part, how many were good, and how many there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Score {
    /// Right predictions, of all.
    pub predictions: [usize; 2],
    /// Right calculations, of all.
    pub calculations: [usize; 2],
    /// Observations that were right at the first try, of all.
    pub observations: [usize; 2],
    /// Tasks that were done without being shown how, of all.
    pub tasks: [usize; 2],
    /// Steps that were skipped, of all.
    pub skipped: [usize; 2],
}

impl Score {
    /// The score of steps.
    pub fn of<'a>(steps: impl IntoIterator<Item = (&'a Step, &'a StepWork)>) -> Self {
        let mut score = Self::default();
        let count = |[good, all]: &mut [usize; 2], is_good: bool| {
            *good += usize::from(is_good);
            *all += 1;
        };
        for (step, work) in steps {
            if let Some(question) = &step.question {
                let right = work.committed && work.prediction.is_some_and(|given| question.answer.is_right(given));
                let calculated = question.kind == QuestionKind::Calculate;
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

    /// Points, and the most that can be reached.
    pub fn points(&self) -> [usize; 2] {
        let parts = [self.predictions, self.calculations, self.observations, self.tasks];
        parts.into_iter().fold([0, 0], |[points, all], [good, of]| [points + good, all + of])
    }
}
