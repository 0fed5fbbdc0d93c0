//! A named thread with a flag to cancel it: both belong to whoever owns the work.

use crate::control::Cancel;
use std::thread::{Builder, JoinHandle};

/// A thread that is cancelled and joined on drop. Whoever keeps a receiver of what it tells declares it before the worker, so that
/// a thread that waits to be listened to ends too.
#[derive(Debug)]
pub(super) struct Worker {
    cancel: Cancel,
    thread: Option<JoinHandle<()>>,
}

impl Worker {
    /// Starts `work`, which looks at the flag, on a thread `squeezefilm-name`.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub(super) fn start(name: &str, work: impl FnOnce(&Cancel) + Send + 'static) -> std::io::Result<Self> {
        let cancel = Cancel::new();
        let theirs = cancel.clone();
        let thread = Builder::new().name(format!("squeezefilm-{name}")).spawn(move || work(&theirs))?;
        Ok(Self { cancel, thread: Some(thread) })
    }

    /// Asks it to end.
    pub(super) fn cancel(&self) {
        self.cancel.cancel();
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.cancel.cancel();
        if let Some(thread) = self.thread.take() {
            // Panics of what it runs are caught there; another would have nothing left to tell.
            let _ = thread.join();
        }
    }
}
