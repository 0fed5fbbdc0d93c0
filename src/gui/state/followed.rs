//! What is computed in the background of what is on screen while its tab is shown, and kept until something else is on screen.

use crate::job::task::{News, Task};

/// What `task` has told since the last time; one that has ended is taken away.
pub(super) fn news<M: Send + 'static, R: Send + 'static>(task: &mut Option<Task<M, R>>) -> News<M, R> {
    let news = task.as_ref().map_or(News { messages: Vec::new(), end: None }, Task::drain);
    if news.end.is_some() {
        *task = None;
    }
    news
}

/// What is known of one `K`, and what is being computed; a task finds an `F`, of which a `T` is kept.
#[derive(Debug)]
pub struct Followed<K, F, T> {
    pub(super) asked: Option<K>,
    task: Option<Task<(), Option<Result<F, String>>>>,
    pub(super) known: Option<(K, Result<T, String>)>,
}

impl<K, F, T> Default for Followed<K, F, T> {
    fn default() -> Self {
        Self { asked: None, task: None, known: None }
    }
}

impl<K: Clone, F: Into<T> + Send + 'static, T> Followed<K, F, T> {
    /// `task` computes that of `of`. What was found before stays until then.
    pub(super) fn follow(&mut self, of: K, task: std::io::Result<Task<(), Option<Result<F, String>>>>) {
        self.asked = Some(of.clone());
        match task {
            Ok(task) => self.task = Some(task),
            Err(error) => self.known = Some((of, Err(format!("no thread can be started: {error}")))),
        }
    }

    /// Takes what was found since the last time.
    pub fn drain(&mut self) {
        if let (Some(end), Some(of)) = (news(&mut self.task).end, self.asked.clone()) {
            match end {
                Ok(Some(found)) => self.known = Some((of, found.map(Into::into))),
                Ok(None) => {}
                Err(panic) => self.known = Some((of, Err(format!("it failed: {panic}")))),
            }
        }
    }

    /// Whether something is being computed.
    pub(super) fn running(&self) -> bool {
        self.task.is_some()
    }

    /// The newest that is known.
    pub fn found(&self) -> Option<&Result<T, String>> {
        self.known.as_ref().map(|(_, found)| found)
    }
}
