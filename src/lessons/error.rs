//! Faults of lessons: file, line, and what is allowed instead. A fault never stops the program: the other lessons are read.

use std::path::PathBuf;

/// One fault of a lesson.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}:{} {what}", origin.display(), line.map_or_else(String::new, |line| format!("{line}:")))]
pub struct LessonError {
    /// The file or folder.
    pub origin: PathBuf,
    /// Line in the file, from 1.
    pub line: Option<usize>,
    /// Description of the fault, and of what is allowed or expected.
    pub what: String,
}
