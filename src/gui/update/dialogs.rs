//! File dialogs, shown outside the window's thread, because they block until they are answered.

use super::platform::DialogStart;
use crate::gui::state::dialogs::{Answer, Purpose};
use crate::platform::aside;
use crate::platform::window::Parent;
use std::sync::mpsc::{Receiver, Sender, channel};

/// Shows a file dialog; blocks until there is an answer.
type AskDialog = fn(Purpose, &DialogStart) -> Answer;

/// Runs dialogs and collects their answers.
#[derive(Debug)]
pub struct Dialogs {
    ask: AskDialog,
    /// The window that dialogs are shown over.
    parent: Parent,
    /// Purposes of the open dialogs.
    open: Vec<Purpose>,
    sender: Sender<(Purpose, Answer)>,
    receiver: Receiver<(Purpose, Answer)>,
}

impl Dialogs {
    /// Dialogs that `ask` shows over the window `parent`.
    pub fn new(ask: AskDialog, parent: Parent) -> Self {
        let (sender, receiver) = channel();
        Self { ask, parent, open: Vec::new(), sender, receiver }
    }

    /// Shows a dialog, unless one like it is open. `wake` is called when there is an answer, and [`Self::drain`] returns it.
    ///
    /// # Errors
    /// If no thread can be started.
    pub fn show(&mut self, purpose: Purpose, name: &str, wake: impl Fn() + Send + 'static) -> std::io::Result<()> {
        if self.open.iter().any(|open| open.is_like(&purpose)) {
            return Ok(());
        }
        let (ask, sender, theirs) = (self.ask, self.sender.clone(), purpose.clone());
        let start = DialogStart { name: name.to_owned(), parent: self.parent.clone() };
        aside("dialog", move || {
            let answer = ask(theirs.clone(), &start);
            // The window may be closed already; then nobody waits for the answer.
            let _ = sender.send((theirs, answer));
            wake();
        })?;
        self.open.push(purpose);
        Ok(())
    }

    /// The answers since the last call.
    pub fn drain(&mut self) -> Vec<(Purpose, Answer)> {
        let answers: Vec<(Purpose, Answer)> = self.receiver.try_iter().collect();
        self.open.retain(|open| answers.iter().all(|(answered, _)| !open.is_like(answered)));
        answers
    }
}
