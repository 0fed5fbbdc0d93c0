//! The line between a page and a worker: the page sends work, the worker sends messages and the result.

use super::work::{Sent, Work};
use crate::platform::worker::{News, Worker};
use std::cell::RefCell;
use std::io;
use std::rc::Rc;

/// Idle workers that are kept, because starting one takes longer than most work.
const SPARE: usize = 2;

type Listener = Box<dyn FnMut(News)>;

/// A worker, and the function that receives what it sends. On drop the worker is ended.
pub(super) struct Line {
    worker: Worker,
    listener: Rc<RefCell<Option<Listener>>>,
}

impl std::fmt::Debug for Line {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Line").finish_non_exhaustive()
    }
}

thread_local! {
    static IDLE: RefCell<Vec<Line>> = const { RefCell::new(Vec::new()) };
}

impl Line {
    /// A line to an idle worker.
    pub(super) fn open() -> io::Result<Self> {
        if let Some(line) = IDLE.with_borrow_mut(Vec::pop) {
            return Ok(line);
        }
        let listener: Rc<RefCell<Option<Listener>>> = Rc::default();
        let theirs = Rc::clone(&listener);
        let worker = Worker::start(move |news| {
            // It is taken out, because it may ask for more work.
            let taken = theirs.borrow_mut().take();
            if let Some(mut listen) = taken {
                listen(news);
                theirs.borrow_mut().get_or_insert(listen);
            }
        })?;
        Ok(Self { worker, listener })
    }

    /// Sends `work` to the worker. `told` is called with everything that the worker sends, or with the text of its failure, after which it
    /// has ended.
    pub(super) fn ask<W: Work>(
        &self,
        work: &W,
        mut told: impl FnMut(Result<Sent<W::Message, W::Output>, String>) + 'static,
    ) -> io::Result<()> {
        *self.listener.borrow_mut() = Some(Box::new(move |news| {
            told(match news {
                News::Failed(text) => Err(text),
                News::Message(bytes) => {
                    postcard::from_bytes(&bytes).map_err(|_| "what the worker said cannot be read".to_owned())
                }
            });
        }));
        let mut bytes = format!("{}\n", W::NAME).into_bytes();
        bytes.extend(postcard::to_stdvec(work).map_err(io::Error::other)?);
        self.worker.send(&bytes)
    }

    /// Returns a worker that has nothing to do any more.
    pub(super) fn give_back(self) {
        *self.listener.borrow_mut() = None;
        IDLE.with_borrow_mut(|idle| {
            if idle.len() < SPARE {
                idle.push(self);
            }
        });
    }
}
