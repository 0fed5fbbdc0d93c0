//! Where the program runs: in a process of an operating system, or in a page of a browser. Both modules have the same functions and types.
//! No other module distinguishes the two, except for the files of [`crate::job`] that send background work to a thread or a worker.

#[cfg(not(target_arch = "wasm32"))]
mod native;
#[cfg(target_arch = "wasm32")]
mod web;

#[cfg(not(target_arch = "wasm32"))]
pub use native::*;
#[cfg(target_arch = "wasm32")]
pub use web::*;
pub use web_time::{Instant, SystemTime};

use crate::control::Cancel;
use std::time::Duration;

/// `cancel`, with a time limit `budget` for each solve. After it, the best result so far is taken.
pub fn timed(cancel: &Cancel, budget: Duration) -> Cancel {
    cancel.with_budget(move || {
        let started = Instant::now();
        move || started.elapsed() >= budget
    })
}

/// The kind of file that a dialog asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DialogKind {
    /// A file that exists.
    File,
    /// A folder.
    Folder,
    /// A file to be written.
    NewFile,
}

/// A file dialog.
#[derive(Clone, Copy, Debug)]
pub struct FileDialog<'a> {
    /// The kind of file that it asks for.
    pub asked: DialogKind,
    /// Its title.
    pub title: &'a str,
    /// The name of a file format, and its extensions.
    pub filter: Option<(&'a str, &'a [&'a str])>,
    /// The name that is suggested for a new file.
    pub name: &'a str,
}
