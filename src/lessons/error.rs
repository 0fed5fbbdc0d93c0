//! What can be wrong with a lesson: file, line, and what is allowed instead. A fault never stops the program: the other lessons are read.

use super::text::TextError;
use crate::input::ReadError;
use std::path::PathBuf;

/// One fault of a lesson.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}:{} {kind}", origin.display(), line.map_or_else(String::new, |line| format!("{line}:")))]
pub struct LessonError {
    /// The file or folder.
    pub origin: PathBuf,
    /// Line in the file, from 1.
    pub line: Option<usize>,
    /// What is wrong.
    pub kind: LessonErrorKind,
}

/// What is wrong with a lesson.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LessonErrorKind {
    /// The file or folder cannot be read.
    #[error("{0}")]
    Unreadable(#[from] ReadError),
    /// Headings and blocks are not as a lesson has them; the message says what is expected.
    #[error("{0}")]
    Layout(String),
    /// Something is wrong with a key of a block.
    #[error("{block}.{key}{fault}")]
    Key {
        /// The block.
        block: &'static str,
        /// The key.
        key: String,
        /// What is wrong with it: the value as written, and what is allowed. It follows the key in the message.
        fault: String,
    },
    /// A text or a formula in it cannot be read.
    #[error("{0}")]
    Text(#[from] TextError),
}
