//! What can be wrong with a lesson: file, line, and what is allowed instead. Never fatal: the other lessons go on.

use super::check::CheckError;
use super::text::TextError;
use crate::input::ReadError;
use crate::scene::SceneError;
use std::fmt;
use std::path::PathBuf;

/// One fault of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonError {
    /// The file or folder.
    pub origin: PathBuf,
    /// Line in the file, from 1.
    pub line: Option<usize>,
    /// What is wrong.
    pub kind: LessonErrorKind,
}

impl fmt::Display for LessonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.origin.display())?;
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        write!(f, " {}", self.kind)
    }
}

impl std::error::Error for LessonError {}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LessonErrorKind {
    /// The file or folder cannot be read.
    #[error("{0}")]
    Unreadable(ReadError),
    /// A folder without any lesson in it.
    #[error("holds no lesson: expected folders with a lesson.md in each, or a lesson.md itself")]
    NoLessons,
    /// There is no title.
    #[error("has no title: expected a line `# Title` before everything else")]
    NoTitle,
    /// There are no steps.
    #[error("has no steps: expected `## Step` below the title, once for each")]
    NoSteps,
    /// A heading without words.
    #[error("the heading is empty")]
    EmptyHeading,
    /// A block that is not closed.
    #[error("the block ```{0} is never closed: expected a line ``` below it")]
    OpenBlock(String),
    /// A block of another kind.
    #[error("a block ```{found} is not known: expected setup, question, task or observe")]
    UnknownBlock {
        /// Its kind.
        found: String,
    },
    /// A block outside of a step.
    #[error("a block ```{0} stands before the first step")]
    BlockOutside(&'static str),
    /// The second block of a kind in one step.
    #[error("this step has two blocks ```{0}: keep one")]
    BlockTwice(&'static str),
    /// What was seen is asked, and nothing was to be done.
    #[error("a block ```observe asks what was seen after a task, and this step has no ```task")]
    ObserveWithoutTask,
    /// Not TOML.
    #[error("is not valid TOML: {0}")]
    Syntax(String),
    /// Something is wrong with a key of a block.
    #[error("{block}.{key}{fault}")]
    Key {
        /// The block.
        block: &'static str,
        /// The key.
        key: String,
        /// What is wrong with it.
        fault: KeyFault,
    },
    /// The first step has no scene to begin with.
    #[error("setup.preset is missing: the first step has to name a preset, built in or a file beside lesson.md")]
    NoScene,
    /// A preset that is neither beside the lesson nor built in.
    #[error(
        "setup.preset = \"{name}\": there is no such file beside lesson.md, and no such built-in preset; squeezefilm presets lists those"
    )]
    NoPreset {
        /// As written.
        name: String,
    },
    /// A text or a formula in it cannot be read.
    #[error("{0}")]
    Text(#[from] TextError),
}

/// What is wrong with a key of a block.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum KeyFault {
    /// No block has it; the keys that this one has.
    #[error(" is not known: expected one of {0}")]
    Unknown(String),
    /// It has to be there, and what it is needed for.
    #[error(" is missing: {0}")]
    Missing(&'static str),
    /// The value as written is of another type than this.
    #[error(" = {0} is of the wrong type: expected {1}")]
    WrongType(String, &'static str),
    /// The value is none of those allowed.
    #[error(" = \"{0}\" is not known: expected one of {1}")]
    NotOneOf(String, String),
    /// The number is out of the range that is allowed.
    #[error(" = {0} is out of range: allowed {1}")]
    OutOfRange(String, String),
    /// It does not go together with another key.
    #[error(" does not go with {0}")]
    NotWith(&'static str),
    /// A preset or a change of it is not allowed: every fault of the scene.
    #[error(": {0}")]
    Scene(SceneError),
    /// A change without a value, as written.
    #[error(": \"{0}\" is no change: expected \"key = value\", as in \"film.min_spacing_nm = 100\"")]
    NoChange(String),
    /// The check as written cannot be read, and why.
    #[error(" = \"{0}\": {1}")]
    Check(String, CheckError),
    /// A text cannot be read.
    #[error(": {0}")]
    Text(TextError),
}
