//! Standard output and standard error. Nothing else writes to them.

use super::exit::CliError;
use crate::scene::escaped;
use crate::solution::Solution;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// `--quiet` was given.
static QUIET: AtomicBool = AtomicBool::new(false);
/// The first thing that went wrong with standard output.
static FAULT: Mutex<Option<io::Error>> = Mutex::new(None);

/// Turns notes and progress off.
pub(super) fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Whether notes and progress are off.
pub(super) fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Writes data to standard output unchanged. An error is reported at the end, by [`ended`], because the files of `--out` still have
/// to be written.
pub(super) fn data(text: &str) {
    let mut fault = FAULT.lock().unwrap_or_else(PoisonError::into_inner);
    if fault.is_none() {
        let mut out = io::stdout().lock();
        *fault = out.write_all(text.as_bytes()).and_then(|()| out.flush()).err();
    }
}

/// Writes text for people to standard output.
pub(super) fn text(text: &str) {
    data(&lines(text));
}

/// Writes a result to standard output: its object for programs, or its text for people.
pub(super) fn result(json: bool, object: impl FnOnce() -> String, human: impl FnOnce() -> String) {
    if json { data(&object()) } else { text(&human()) }
}

/// Whether all data were written.
pub(super) fn ended() -> Result<(), CliError> {
    match FAULT.lock().unwrap_or_else(PoisonError::into_inner).take() {
        Some(error) => Err(CliError::Output(error)),
        None => Ok(()),
    }
}

/// Text with control characters escaped.
fn lines(text: &str) -> String {
    text.split('\n').map(escaped).collect::<Vec<_>>().join("\n")
}

/// Writes text to standard error. If that fails, the failure is ignored.
pub(super) fn say(text: &str) {
    let text = lines(text);
    let _ = io::stderr().lock().write_all(format!("{}\n", text.trim_end_matches('\n')).as_bytes());
}

/// Writes a note to standard error, unless `--quiet` was given.
pub(super) fn note(text: &str) {
    if !is_quiet() {
        say(text);
    }
}

/// A note on files: `wrote to results: summary.json, scene.toml, …`
pub(super) fn wrote(folder: &Path, paths: &[PathBuf]) {
    let names: Vec<_> = paths.iter().filter_map(|path| path.file_name()).map(|name| name.to_string_lossy()).collect();
    note(&format!("wrote to {}: {}", folder.display(), names.join(", ")));
}

/// Writes a question to standard error; the answer is typed on the same line.
pub(super) fn prompt(text: &str) {
    let mut out = io::stderr().lock();
    let _ = out.write_all(escaped(text).as_bytes()).and_then(|()| out.flush());
}

/// Writes each line of an error to standard error, marked.
pub(super) fn error(text: &str) {
    text.lines().for_each(|line| say(&format!("error: {line}")));
}

/// Writes a warning to standard error, marked.
pub(super) fn warning(text: &str) {
    say(&format!("warning: {text}"));
}

/// Writes why the run `label` has no solution, or the warnings of its solution.
pub(super) fn warnings(label: &str, solved: &Result<Arc<Solution>, String>) {
    match solved {
        Err(reason) => error(&format!("{label}: {reason}")),
        Ok(solution) => solution.warnings.iter().for_each(|words| warning(&format!("{label}: {words}"))),
    }
}
