//! The modal dialogs: an error, a question, a path prompt.

use super::dialogs::Purpose;
use super::document::Next;
use crate::scene::new_motor::Answers;
use std::path::PathBuf;

/// A modal.
#[derive(Clone, Debug)]
pub enum Modal {
    /// Something went wrong, and nothing was changed.
    Error(String),
    /// Unsaved changes of this scene.
    Unsaved {
        /// The scene's name, and that of its file.
        name: String,
        /// The action that would lose them.
        next: Next,
    },
    /// The file of the scene was changed by another program since it was opened or saved here. After saving, this follows.
    ChangedElsewhere(PathBuf, Option<Next>),
    /// Work that closing the window would end.
    Unfinished,
    /// A path to type.
    Path(PathPrompt),
    /// The questions about a new motor, as answered so far.
    NewMotor(Answers),
    /// About the program, and how it is cited.
    About,
}

/// A prompt for a path.
#[derive(Clone, Debug)]
pub struct PathPrompt {
    /// The purposes that the path may be used for; Enter chooses the first. There is only one if the prompt replaces a file dialog that
    /// could not be shown.
    pub purposes: Vec<Purpose>,
    /// The text typed so far.
    pub path: String,
    /// Whether it has not been drawn yet.
    pub fresh: bool,
    /// Why this path was refused.
    pub refused: Option<String>,
}
