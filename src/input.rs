//! Reads files from outside: presets, tables, lessons and their pictures. No other module opens such files.

use crate::digits::counted;
use crate::platform::handed_over;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

const MEGABYTE: u64 = 1_000_000;

/// The files that were read.
static READ: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The files that this process has read so far: no command replaces its own input.
pub fn read_so_far() -> Vec<PathBuf> {
    READ.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// Why a file is not read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// The operating system refuses; its reason.
    #[error("cannot be read: {0}")]
    System(String),
    /// It is a folder, or something that may never end, such as a pipe, a device or a socket.
    #[error("cannot be read: it is {0}, not a regular file")]
    NotAFile(&'static str),
    /// It is larger than the limit for files of its kind \[MB\].
    #[error("cannot be read: it is larger than {0} MB")]
    TooLarge(u64),
    /// It is neither UTF-8 nor UTF-16 with a byte order mark.
    #[error("cannot be read: it is not UTF-8 text")]
    NotText,
}

/// The bytes of a regular file of up to `limit` \[MB\]. If the path names anything else, it is not opened.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let system = |error: std::io::Error| ReadError::System(error.to_string());
    if let Some(bytes) = handed_over(path) {
        return Ok(bytes);
    }
    let about = std::fs::metadata(path).map_err(system)?;
    if !about.is_file() {
        return Err(ReadError::NotAFile(if about.is_dir() { "a folder" } else { "a pipe or a device" }));
    }
    if about.len() > limit * MEGABYTE {
        return Err(ReadError::TooLarge(limit));
    }
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if !read.iter().any(|other| other == path) {
        read.push(path.to_owned());
    }
    drop(read);
    // The limit is checked again, because the length may be zero, as under /proc, or change while the file is read.
    bytes_of(std::fs::File::open(path).map_err(system)?, limit)
}

fn bytes_of(source: impl Read, limit: u64) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    let read = source.take(limit * MEGABYTE + 1).read_to_end(&mut bytes);
    read.map_err(|error| ReadError::System(error.to_string()))?;
    if bytes.len() as u64 > limit * MEGABYTE { Err(ReadError::TooLarge(limit)) } else { Ok(bytes) }
}

/// The text of a regular file of up to `limit` \[MB\]. If the path names anything else, it is not opened.
pub fn read_text(path: &Path, limit: u64) -> Result<String, ReadError> {
    text(read_bytes(path, limit)?)
}

/// The text of standard input or another stream, of up to `limit` \[MB\].
pub fn read_stream(source: impl Read, limit: u64) -> Result<String, ReadError> {
    text(bytes_of(source, limit)?)
}

/// The text in the bytes of a file: UTF-8, or UTF-16 after a byte order mark, as `>` in PowerShell 5 writes it.
pub fn text(bytes: Vec<u8>) -> Result<String, ReadError> {
    let unit = match bytes.get(..2) {
        Some([0xff, 0xfe]) => u16::from_le_bytes,
        Some([0xfe, 0xff]) => u16::from_be_bytes,
        _ => return String::from_utf8(bytes).map_err(|_| ReadError::NotText),
    };
    let (pairs, rest) = bytes[2..].as_chunks();
    let units: Vec<u16> = pairs.iter().copied().map(unit).collect();
    if rest.is_empty() { String::from_utf16(&units).map_err(|_| ReadError::NotText) } else { Err(ReadError::NotText) }
}

/// The line of a record in the text of a CSV file, from 1. The reader's position is before the blank lines and comments that it skips.
pub fn csv_line(text: &str, at: Option<&csv::Position>) -> Option<u64> {
    let at = at?;
    let rest = text.get(usize::try_from(at.byte()).ok()?..)?;
    let skipped = rest.lines().take_while(|line| line.is_empty() || line.starts_with('#')).count();
    Some(at.line() + skipped as u64)
}

/// Why a line of a CSV file cannot be read, in plain words.
pub fn csv_fault(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            let cells = counted(usize::try_from(*len).unwrap_or(usize::MAX), "cell", "cells");
            format!("{cells}: expected {expected_len}, one for each column")
        }
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_either_byte_order_is_read() {
        let told = "h = 1 µm\r\n";
        let units =
            |bytes: fn(u16) -> [u8; 2]| ["\u{feff}", told].concat().encode_utf16().flat_map(bytes).collect::<Vec<_>>();
        for bytes in [told.into(), units(u16::to_le_bytes), units(u16::to_be_bytes)] {
            assert_eq!(read_stream(&bytes[..], 1).unwrap(), told);
        }
        for bytes in [&b"\xff\xfeh"[..], b"\xff\xfe\x00\xd8", b"\xff\xff"] {
            assert_eq!(read_stream(bytes, 1), Err(ReadError::NotText));
        }
    }
}
