//! File dialogs, off the window's thread: they block, and answer later.

use crate::gui::state::dialogs::{Answer, Purpose};
use std::sync::mpsc::{Receiver, Sender, channel};

/// Runs dialogs and collects their answers.
#[derive(Debug)]
pub struct Dialogs {
    ask: fn(Purpose, &str) -> Answer,
    sender: Sender<(Purpose, Answer)>,
    receiver: Receiver<(Purpose, Answer)>,
}

impl Dialogs {
    /// Dialogs that are shown by `ask`.
    pub fn new(ask: fn(Purpose, &str) -> Answer) -> Self {
        let (sender, receiver) = channel();
        Self { ask, sender, receiver }
    }

    /// Shows a dialog; its answer comes through [`Self::drain`], after a call of `wake`.
    ///
    /// # Errors
    /// If no thread can be started.
    pub fn show(&self, purpose: Purpose, name: &str, wake: impl Fn() + Send + 'static) -> std::io::Result<()> {
        let (ask, sender) = (self.ask, self.sender.clone());
        let name = name.to_owned();
        std::thread::Builder::new().name("squeezefilm-dialog".to_owned()).spawn(move || {
            // The window may be gone: then nobody waits for the answer.
            let _ = sender.send((purpose, ask(purpose, &name)));
            wake();
        })?;
        Ok(())
    }

    /// Answers that have come.
    pub fn drain(&self) -> impl Iterator<Item = (Purpose, Answer)> + '_ {
        self.receiver.try_iter()
    }
}
