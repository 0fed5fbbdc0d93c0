//! Text files from outside: presets, compliance tables, lessons. Nothing else in the program opens one.

use crate::platform::handed_over;
use std::io::Read;
use std::path::Path;

/// Why a file is not read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// The system refuses.
    #[error("cannot be read: {0}")]
    System(String),
    /// A folder, or something that may never end: a pipe, a device, a socket.
    #[error("cannot be read: it is {0}, not a regular file")]
    NotAFile(&'static str),
    /// Larger than anything of its kind.
    #[error("cannot be read: it is larger than {0} MB")]
    TooLarge(u64),
    /// Not UTF-8.
    #[error("cannot be read: it is not UTF-8 text")]
    NotText,
}

/// The text of a regular file of up to `limit` \[MB\]. Whatever else the path names is refused without being opened.
///
/// # Errors
///
/// [`ReadError`]: there is no such file, it is something else than a file, too large, or no text.
pub fn read_text(path: &Path, limit: u64) -> Result<String, ReadError> {
    let system = |error: std::io::Error| ReadError::System(error.to_string());
    if let Some(bytes) = handed_over(path) {
        return String::from_utf8(bytes).map_err(|_| ReadError::NotText);
    }
    let about = std::fs::metadata(path).map_err(system)?;
    if !about.is_file() {
        return Err(ReadError::NotAFile(if about.is_dir() { "a folder" } else { "a pipe or a device" }));
    }
    let most = limit * 1_000_000;
    let mut bytes = Vec::new();
    // Its length may be none, as under /proc, or change while it is read.
    if about.len() <= most {
        std::fs::File::open(path).map_err(system)?.take(most + 1).read_to_end(&mut bytes).map_err(system)?;
    }
    if about.len().max(bytes.len() as u64) > most {
        return Err(ReadError::TooLarge(limit));
    }
    String::from_utf8(bytes).map_err(|_| ReadError::NotText)
}
