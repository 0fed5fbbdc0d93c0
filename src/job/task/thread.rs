//! Work of a process: on a thread of its own.

use crate::analysis::attempt::caught;
use crate::control::Cancel;
use crate::job::work::{News, Sent, Wake, Work};
use std::sync::mpsc::{Receiver, channel, sync_channel};
use std::thread::{Builder, JoinHandle};

/// Work that is running or has ended. `M` is the type of its messages, `R` that of its result. On drop it is cancelled and joined.
#[derive(Debug)]
pub struct BackgroundTask<M, R> {
    cancel: Cancel,
    /// `None` only during the drop, so that a thread that waits for its messages to be taken ends too.
    sent: Option<Receiver<Sent<M, R>>>,
    thread: Option<JoinHandle<()>>,
}

/// Sends to the owner. If nobody is left to receive it, the work is cancelled too.
type Line<M, R> = Box<dyn Fn(Sent<M, R>) + Send + Sync>;

impl<M: Send + 'static, R: Send + 'static> BackgroundTask<M, R> {
    /// Starts to do `work` on a thread of its own; an error is that no thread can be started.
    pub fn of<W: Work<Message = M, Output = R>>(work: W, wake: impl Wake) -> std::io::Result<Self> {
        Self::start(W::NAME, W::AHEAD, wake, |cancel, tell| work.run(cancel, tell))
    }

    /// Starts `work` on a thread `squeezefilm-name`. It looks at the flag, and sends messages through the function that it is given; where
    /// `ahead` is given, it waits while so many of its messages have not been taken.
    pub fn start(
        name: &str,
        ahead: Option<usize>,
        wake: impl Wake,
        work: impl FnOnce(&Cancel, &(dyn Fn(M) + Sync)) -> Result<Option<R>, String> + Send + 'static,
    ) -> std::io::Result<Self> {
        let (send, sent): (Line<M, R>, _) = match ahead {
            Some(most) => {
                let (sender, sent) = sync_channel(most);
                (Box::new(move |one| drop(sender.send(one))), sent)
            }
            None => {
                let (sender, sent) = channel();
                (Box::new(move |one| drop(sender.send(one))), sent)
            }
        };
        let cancel = Cancel::new();
        let theirs = cancel.clone();
        let thread = Builder::new().name(format!("squeezefilm-{name}")).spawn(move || {
            let tell = |message: M| {
                send(Sent::Message(message));
                wake(false);
            };
            let end = caught(|| work(&theirs, &tell));
            send(Sent::End(end.unwrap_or_else(|panic| Err(format!("it failed: {panic}")))));
            wake(true);
        })?;
        Ok(Self { cancel, sent: Some(sent), thread: Some(thread) })
    }

    /// Messages and result since the last call.
    pub fn drain(&self) -> News<M, R> {
        let mut news = News { messages: Vec::new(), end: None };
        for sent in self.sent.iter().flat_map(Receiver::try_iter) {
            match sent {
                Sent::Message(message) => news.messages.push(message),
                Sent::End(end) => news.end = Some(end),
            }
        }
        news
    }
}

impl<M, R> BackgroundTask<M, R> {
    /// Asks the work to end. Its result then comes like any other.
    pub fn cancel(&self) {
        self.cancel.cancel();
    }
}

impl<M, R> Drop for BackgroundTask<M, R> {
    fn drop(&mut self) {
        self.cancel.cancel();
        self.sent = None;
        if let Some(thread) = self.thread.take() {
            // A panic of the work was caught in the thread. After any other panic nothing is left to report.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Duration;

    /// All messages of a task and its end.
    fn to_the_end<M: Send + 'static, R: Send + 'static>(
        task: &BackgroundTask<M, R>,
    ) -> (Vec<M>, Result<Option<R>, String>) {
        let mut seen = Vec::new();
        for _ in 0..6000 {
            let News { messages, end } = task.drain();
            seen.extend(messages);
            if let Some(end) = end {
                return (seen, end);
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        panic!("it has not ended: {} messages", seen.len());
    }

    #[test]
    fn a_panic_ends_it_with_its_text() {
        let woken = Arc::new(AtomicBool::new(false));
        let theirs = Arc::clone(&woken);
        let wake = move |ended: bool| theirs.store(ended, Ordering::Relaxed);
        let task: BackgroundTask<i32, ()> = BackgroundTask::start("test", None, wake, |_, tell| {
            tell(1);
            panic!("on purpose, {}", 2);
        })
        .unwrap();
        assert_eq!(to_the_end(&task), (vec![1], Err("it failed: on purpose, 2".to_owned())));
        for _ in 0..1000 {
            if woken.load(Ordering::Relaxed) {
                return;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("nobody is woken at the end");
    }

    #[test]
    fn cancelling_and_dropping_end_it() {
        let endless = || -> BackgroundTask<&str, usize> {
            BackgroundTask::start(
                "test",
                None,
                |_| (),
                |cancel, tell| {
                    while !cancel.is_cancelled() {
                        std::thread::sleep(Duration::from_millis(1));
                    }
                    tell("cancelled");
                    Ok(Some(3))
                },
            )
            .unwrap()
        };
        let task = endless();
        assert!(task.drain().end.is_none());
        task.cancel();
        assert_eq!(to_the_end(&task), (vec!["cancelled"], Ok(Some(3))));
        drop(endless());
    }

    #[test]
    fn bounded_work_waits_and_still_ends_on_drop() {
        let sent = Arc::new(std::sync::atomic::AtomicUsize::new(0));
        let theirs = Arc::clone(&sent);
        let task: BackgroundTask<usize, ()> = BackgroundTask::start(
            "test",
            Some(2),
            |_| (),
            move |cancel, tell| {
                for i in 0.. {
                    if cancel.is_cancelled() {
                        break;
                    }
                    tell(i);
                    theirs.store(i + 1, Ordering::Relaxed);
                }
                Ok(None)
            },
        )
        .unwrap();
        std::thread::sleep(Duration::from_millis(100));
        assert!(sent.load(Ordering::Relaxed) <= 2);
        assert!(task.drain().messages.starts_with(&[0, 1]));
        drop(task);
    }
}
