//! Work in the background, as a tab has it.

use crate::job::task::{News, Task};

/// Work in the background, while it goes on.
#[derive(Debug)]
pub struct Background<M, R> {
    task: Option<Task<M, R>>,
    /// Whether the last one was told to end.
    pub cancelled: bool,
    /// Why the last one failed, if it did.
    pub failure: Option<String>,
}

impl<M, R> Default for Background<M, R> {
    fn default() -> Self {
        Self { task: None, cancelled: false, failure: None }
    }
}

impl<M, R> From<Task<M, R>> for Background<M, R> {
    fn from(task: Task<M, R>) -> Self {
        Self { task: Some(task), ..Self::default() }
    }
}

impl<M, R> Background<M, R> {
    /// Asks it to end.
    pub fn cancel(&mut self) {
        if let Some(task) = &self.task {
            task.cancel();
            self.cancelled = true;
        }
    }

    /// Whether it goes on.
    pub fn running(&self) -> bool {
        self.task.is_some()
    }
}

impl<M: Send + 'static, R: Send + 'static> Background<M, R> {
    /// What it has told since the last time; it does not go on after its end.
    pub(super) fn news(&mut self) -> News<M, R> {
        let news = self.task.as_ref().map_or(News { messages: Vec::new(), end: None }, Task::drain);
        if news.end.is_some() {
            self.task = None;
        }
        news
    }

    /// The same of work whose failure is told beside it: its messages, and what it found in the end.
    pub(super) fn found(&mut self) -> (Vec<M>, Option<R>) {
        let News { messages, end } = self.news();
        let found = end.and_then(|end| {
            end.unwrap_or_else(|why| {
                self.failure = Some(why);
                None
            })
        });
        (messages, found)
    }
}
