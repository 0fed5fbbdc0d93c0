//! Work of a page: in a worker, or, where it cannot be carried there, on the page, which then stands still.

use super::News;
use crate::control::Cancel;
use crate::job::line::{Line, Told};
use crate::job::work::Work;
use std::cell::RefCell;
use std::rc::Rc;
use wasm_bindgen_futures::spawn_local;

/// Work under way, or ended. `M` is what it tells on the way, `R` what it returns. Its worker is ended on drop.
#[derive(Debug)]
pub struct Task<M, R> {
    cancel: Cancel,
    /// None once its worker has nothing to do any more.
    line: Rc<RefCell<Option<Line>>>,
    told: Rc<RefCell<News<M, R>>>,
    /// What comes of it if its worker is ended.
    ended: Option<fn() -> R>,
}

impl<M: 'static, R: 'static> Task<M, R> {
    /// Starts to do `work` in a worker. `wake` is called after every message and at the end, then with `true`.
    ///
    /// # Errors
    /// If there is no worker for it.
    pub fn of<W: Work<Message = M, Found = R>>(
        work: W,
        wake: impl Fn(bool) + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        let told = Rc::new(RefCell::new(News { messages: Vec::new(), end: None }));
        let line = Rc::new(RefCell::new(Some(Line::open()?)));
        let (theirs, used) = (Rc::clone(&told), Rc::clone(&line));
        let listen = move |news| {
            let mut told = theirs.borrow_mut();
            match news {
                Told::Message(message) => told.messages.push(message),
                Told::End(found) => {
                    told.end = Some(Ok(found));
                    used.borrow_mut().take().into_iter().for_each(Line::give_back);
                }
                Told::Failed(text) => {
                    told.end = Some(Err(text));
                    *used.borrow_mut() = None;
                }
            }
            let ended = told.end.is_some();
            drop(told);
            wake(ended);
        };
        line.borrow().as_ref().map_or(Ok(()), |line| line.ask(&work, listen))?;
        Ok(Self { cancel: Cancel::new(), line, told, ended: Some(W::ended) })
    }

    /// Does `work` on the page, before the next frame.
    ///
    /// # Errors
    /// None.
    pub fn start(
        _: &str,
        wake: impl Fn(bool) + Send + Sync + 'static,
        work: impl FnOnce(&Cancel, &(dyn Fn(M) + Sync)) -> R + Send + 'static,
    ) -> std::io::Result<Self>
    where
        M: Send,
        R: Send,
    {
        let cancel = Cancel::new();
        let told = Rc::new(RefCell::new(News { messages: Vec::new(), end: None }));
        let (flag, theirs) = (cancel.clone(), Rc::clone(&told));
        spawn_local(async move {
            let messages = std::sync::Mutex::new(Vec::new());
            let tell = |message| messages.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push(message);
            let found = work(&flag, &tell);
            let messages = messages.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
            *theirs.borrow_mut() = News { messages, end: Some(Ok(found)) };
            wake(true);
        });
        Ok(Self { cancel, line: Rc::default(), told, ended: None })
    }

    /// What it has told since the last time.
    pub fn drain(&self) -> News<M, R> {
        let mut told = self.told.borrow_mut();
        News { messages: std::mem::take(&mut told.messages), end: told.end.take() }
    }
}

impl<M, R> Task<M, R> {
    /// Ends it, and its worker.
    pub fn cancel(&self) {
        self.cancel.cancel();
        let worker = self.line.borrow_mut().take();
        if let (Some(worker), Some(ended)) = (worker, self.ended) {
            drop(worker);
            self.told.borrow_mut().end = Some(Ok(ended()));
        }
    }
}

impl<M, R> Drop for Task<M, R> {
    fn drop(&mut self) {
        self.cancel.cancel();
        *self.line.borrow_mut() = None;
    }
}
