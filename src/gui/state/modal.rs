//! What is in the way until it is answered: an error, a question, a path to type.

use super::dialogs::Purpose;
use super::document::Next;
use crate::scene::new_motor::Answers;

/// A modal.
#[derive(Clone, Debug)]
pub enum Modal {
    /// Something went wrong; nothing changed.
    Error(String),
    /// Unsaved changes of this scene.
    Unsaved {
        /// The scene's name.
        name: String,
        /// What would lose them.
        next: Next,
    },
    /// Work that would end with the window: what it is.
    Unfinished(Vec<String>),
    /// A path to type.
    Path(PathPrompt),
    /// What is asked about a new motor, as answered so far.
    NewMotor(Answers),
    /// What the program is, and how it is cited.
    About,
}

/// A path, and what it may be used for.
#[derive(Clone, Debug)]
pub struct PathPrompt {
    /// What it may be used for, the first by Enter.
    pub purposes: Vec<Purpose>,
    /// What is typed so far.
    pub path: String,
    /// Whether it stands in for a file dialog that could not be shown.
    pub no_dialog: bool,
    /// Whether it has not been drawn yet.
    pub fresh: bool,
}
