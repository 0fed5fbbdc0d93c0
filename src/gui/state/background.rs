//! Background work that belongs to a tab.

use crate::job::task::{BackgroundTask, News};
use crate::job::work::Work;

/// A background task and the outcome of the last one.
#[derive(Debug)]
pub struct Background<M, R> {
    task: Option<BackgroundTask<M, R>>,
    /// Whether the last task was cancelled.
    pub cancelled: bool,
    /// Why the last one failed, if it did.
    pub failure: Option<String>,
}

/// Background work of the kind `W`.
pub type BackgroundOf<W> = Background<<W as Work>::Message, <W as Work>::Output>;

impl<M, R> Default for Background<M, R> {
    fn default() -> Self {
        Self { task: None, cancelled: false, failure: None }
    }
}

impl<M, R> From<BackgroundTask<M, R>> for Background<M, R> {
    fn from(task: BackgroundTask<M, R>) -> Self {
        Self { task: Some(task), ..Self::default() }
    }
}

impl<M, R> Background<M, R> {
    /// Asks the task to end.
    pub fn cancel(&mut self) {
        if let Some(task) = &self.task {
            task.cancel();
            self.cancelled = true;
        }
    }

    /// Whether the task is running.
    pub fn running(&self) -> bool {
        self.task.is_some()
    }
}

impl<M: Send + 'static, R: Send + 'static> Background<M, R> {
    /// Messages and result since the last call; drops the task when it has ended.
    pub(super) fn news(&mut self) -> News<M, R> {
        let news = self.task.as_ref().map_or(News { messages: Vec::new(), end: None }, BackgroundTask::drain);
        if news.end.is_some() {
            self.task = None;
        }
        news
    }

    /// As [`Self::news`], but an error is kept in `failure`. Returns the messages, and the result if there is one.
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
