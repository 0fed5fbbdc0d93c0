//! One piece of work on a named thread of its own, that is cancelled and joined on drop. Whoever owns it passes a `wake`
//! function, called after every message and once at the end.

use super::worker::Worker;
use crate::control::Cancel;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Work under way, or ended; `M` is what it tells.
#[derive(Debug)]
pub struct Task<M> {
    told: Receiver<M>,
    worker: Worker,
}

impl<M: Send + 'static> Task<M> {
    /// Starts `work`, which looks at the flag and tells what it has through the function it is given. `wake` is called
    /// from that thread; its argument says whether it was the last time. A panic ends the work, and only that.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn start(
        name: &str,
        wake: impl Fn(bool) + Send + Sync + 'static,
        work: impl FnOnce(&Cancel, &(dyn Fn(M) + Sync)) + Send + 'static,
    ) -> std::io::Result<Self> {
        let (sender, told) = channel();
        let worker = Worker::start(name, move |cancel| {
            let tell = |message: M| {
                // Nobody may be left to listen: then the owner has cancelled it too.
                let _ = sender.send(message);
                wake(false);
            };
            // What it had to tell is told; that there is no more says that it has ended.
            let _ = catch_unwind(AssertUnwindSafe(|| work(cancel, &tell)));
            drop(sender);
            wake(true);
        })?;
        Ok(Self { told, worker })
    }

    /// What it has told since the last time, and whether nothing more will come.
    pub fn drain(&self) -> (Vec<M>, bool) {
        let mut messages = Vec::new();
        loop {
            match self.told.try_recv() {
                Ok(message) => messages.push(message),
                Err(TryRecvError::Empty) => return (messages, false),
                Err(TryRecvError::Disconnected) => return (messages, true),
            }
        }
    }

    /// Asks it to end; it tells when it has.
    pub fn cancel(&self) {
        self.worker.cancel();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Duration;

    fn all<M: Send + 'static>(task: &Task<M>) -> Vec<M> {
        let mut seen = Vec::new();
        for _ in 0..1000 {
            let (told, ended) = task.drain();
            seen.extend(told);
            if ended {
                return seen;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("it has not ended");
    }

    #[test]
    fn it_tells_and_ends_also_by_a_panic() {
        let woken = Arc::new(AtomicBool::new(false));
        let theirs = Arc::clone(&woken);
        let wake = move |ended: bool| theirs.store(ended, Ordering::Relaxed);
        let task = Task::start("test", wake, |_, tell| {
            tell(1);
            panic!("on purpose");
        });
        assert_eq!(all(&task.unwrap()), [1]);
        assert!(woken.load(Ordering::Relaxed), "the end is told too");
    }

    #[test]
    fn cancelling_and_dropping_end_it() {
        let endless = || {
            Task::start(
                "test",
                |_| (),
                |cancel, tell| {
                    while !cancel.is_cancelled() {
                        std::thread::sleep(Duration::from_millis(1));
                    }
                    tell("ended");
                },
            )
            .unwrap()
        };
        let task = endless();
        assert!(!task.drain().1);
        task.cancel();
        assert_eq!(all(&task), ["ended"]);
        drop(endless());
    }
}
