//! What is computed in the background of what is on screen while its tab is shown, and kept until something else is on screen.

use super::background::Background;
use crate::job::task::Task;

/// What is known of one `K`, and what is being computed; a task finds an `F`, of which a `T` is kept.
#[derive(Debug)]
pub struct Followed<K, F, T> {
    pub(super) asked: Option<K>,
    pub(super) work: Background<(), F>,
    pub(super) known: Option<(K, Result<T, String>)>,
}

impl<K, F, T> Default for Followed<K, F, T> {
    fn default() -> Self {
        Self { asked: None, work: Background::default(), known: None }
    }
}

impl<K: Clone, F: Into<T> + Send + 'static, T> Followed<K, F, T> {
    /// `task` computes that of `of`. What was found before stays until then.
    pub(super) fn follow(&mut self, of: K, task: Option<Task<(), F>>) {
        self.asked = Some(of);
        task.into_iter().for_each(|task| self.work = task.into());
    }

    /// Takes what was found since the last time.
    pub fn drain(&mut self) {
        if let (Some(end), Some(of)) = (self.work.news().end, self.asked.clone()) {
            let found = end.transpose().map(|found| (of, found.map(Into::into)));
            self.known = found.or(self.known.take());
        }
    }

    /// The newest that is known.
    pub fn found(&self) -> Option<&Result<T, String>> {
        self.known.as_ref().map(|(_, found)| found)
    }
}
