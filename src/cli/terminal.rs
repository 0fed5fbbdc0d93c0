//! Standard output and standard error. Nothing else writes to them.

use super::exit::CliError;
use std::io::{self, ErrorKind, Write};

/// Writes data to standard output. A reader that has gone (`| head`) has all it wants: that is not an error.
pub(super) fn data(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::Output(error)),
        _ => Ok(()),
    }
}

/// Writes text to standard error as it is. If nobody can read it, nobody is told.
pub(super) fn note(text: &str) {
    let mut err = io::stderr().lock();
    let _ = err.write_all(text.as_bytes()).and_then(|()| if text.ends_with('\n') { Ok(()) } else { writeln!(err) });
}

/// Writes each line of an error to standard error, marked.
pub(super) fn error(text: &str) {
    for line in text.lines() {
        note(&format!("error: {line}"));
    }
}

/// Writes a warning to standard error, marked.
pub(super) fn warning(text: &str) {
    note(&format!("warning: {text}"));
}
