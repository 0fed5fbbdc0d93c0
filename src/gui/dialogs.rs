//! File dialogs, off the window's thread: they block, and answer later.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};

/// What a dialog is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Open a preset.
    Open,
    /// Save the preset.
    Save,
    /// Save a picture of the window.
    Screenshot,
}

/// A file chosen in a dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chosen {
    /// What for.
    pub purpose: Purpose,
    /// Which; `None`: cancelled, or no dialog could be shown.
    pub path: Option<PathBuf>,
}

/// Runs dialogs and collects their answers.
#[derive(Debug)]
pub struct Dialogs {
    sender: Sender<Chosen>,
    receiver: Receiver<Chosen>,
}

impl Default for Dialogs {
    fn default() -> Self {
        let (sender, receiver) = channel();
        Self { sender, receiver }
    }
}

impl Dialogs {
    /// Shows a dialog; its answer comes through [`Self::drain`], after a call of `wake`.
    ///
    /// # Errors
    /// If no thread can be started.
    pub fn show(&self, purpose: Purpose, name: &str, wake: impl Fn() + Send + 'static) -> std::io::Result<()> {
        let sender = self.sender.clone();
        let name = name.to_owned();
        std::thread::Builder::new().name("squeezefilm-dialog".to_owned()).spawn(move || {
            let dialog = match purpose {
                Purpose::Screenshot => rfd::FileDialog::new().add_filter("Picture", &["png"]),
                _ => rfd::FileDialog::new().add_filter("Preset", &["toml"]),
            };
            let path = match purpose {
                Purpose::Open => dialog.set_title("Open a preset").pick_file(),
                _ => dialog.set_title("Save").set_file_name(name).save_file(),
            };
            // The window may be gone: then nobody waits for the answer.
            let _ = sender.send(Chosen { purpose, path });
            wake();
        })?;
        Ok(())
    }

    /// Answers that have come.
    pub fn drain(&self) -> impl Iterator<Item = Chosen> + '_ {
        self.receiver.try_iter()
    }
}
