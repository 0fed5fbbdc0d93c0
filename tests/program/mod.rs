//! The program as its users run it.
#![allow(dead_code, reason = "no file of tests uses all of it")]

use serde_json::Value;
use std::process::{Command, Output, Stdio};

/// The program with these arguments, and nothing on standard input.
pub(crate) fn squeezefilm(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_squeezefilm"));
    command.args(arguments).stdin(Stdio::null());
    command
}

pub(crate) fn run(arguments: &[&str]) -> Output {
    squeezefilm(arguments).output().unwrap()
}

/// Runs, and expects success.
#[track_caller]
pub(crate) fn done(arguments: &[&str]) -> Output {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    output
}

/// Runs, expects the status, nothing on standard output, and these words on standard error.
#[track_caller]
pub(crate) fn refused(arguments: &[&str], status: i32, words: &[&str]) {
    let output = run(arguments);
    let said = err(&output);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {said}");
    assert_eq!(out(&output), "", "{arguments:?}");
    for word in words {
        assert!(said.contains(word), "{arguments:?}: {word:?} is not in {said:?}");
    }
    assert!(!said.contains("panicked"), "{said}");
}

pub(crate) fn out(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

pub(crate) fn err(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

/// The whole of standard output, read as JSON.
pub(crate) fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}
