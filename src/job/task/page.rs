//! Work of a page: in a worker.

use crate::job::line::Line;
use crate::job::work::{News, Sent, Wake, Work};
use std::cell::RefCell;
use std::rc::Rc;

/// Work that is running or has ended. `M` is the type of its messages, `R` that of its result. On drop its worker is ended.
#[derive(Debug)]
pub struct BackgroundTask<M, R> {
    /// `None` once the worker has nothing to do any more.
    line: Rc<RefCell<Option<Line>>>,
    told: Rc<RefCell<News<M, R>>>,
}

impl<M: 'static, R: 'static> BackgroundTask<M, R> {
    /// Starts to do `work` in a worker; an error is that there is none for it.
    pub fn of<W: Work<Message = M, Output = R>>(work: W, wake: impl Wake) -> std::io::Result<Self> {
        let told = Rc::new(RefCell::new(News { messages: Vec::new(), end: None }));
        let line = Rc::new(RefCell::new(Some(Line::open()?)));
        let (theirs, used) = (Rc::clone(&told), Rc::clone(&line));
        let listen = move |news| {
            let mut told = theirs.borrow_mut();
            match news {
                Ok(Sent::Message(message)) => told.messages.push(message),
                Ok(Sent::End(found)) => {
                    told.end = Some(found);
                    used.borrow_mut().take().into_iter().for_each(Line::give_back);
                }
                Err(text) => {
                    told.end = Some(Err(format!("it failed: {text}")));
                    *used.borrow_mut() = None;
                }
            }
            let ended = told.end.is_some();
            drop(told);
            wake(ended);
        };
        line.borrow().as_ref().map_or(Ok(()), |line| line.ask(&work, listen))?;
        Ok(Self { line, told })
    }

    /// Messages and result since the last call.
    pub fn drain(&self) -> News<M, R> {
        let mut told = self.told.borrow_mut();
        News { messages: std::mem::take(&mut told.messages), end: told.end.take() }
    }
}

impl<M, R> BackgroundTask<M, R> {
    /// Ends it, and its worker.
    pub fn cancel(&self) {
        let worker = self.line.borrow_mut().take();
        if let Some(worker) = worker {
            drop(worker);
            self.told.borrow_mut().end = Some(Ok(None));
        }
    }
}

impl<M, R> Drop for BackgroundTask<M, R> {
    fn drop(&mut self) {
        *self.line.borrow_mut() = None;
    }
}
