//! Where the program runs: a process of an operating system, or a page in a browser. Both offer the same names, and nothing else in
//! the program asks which of them it is, apart from how background work is carried to where it is done ([`crate::job`]).

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

/// `cancel`, with so much time for each solve: when it is spent, the best so far is the result.
pub fn timed(cancel: &Cancel, budget: Duration) -> Cancel {
    cancel.with_budget(move || {
        let started = Instant::now();
        move || started.elapsed() >= budget
    })
}

/// What a file dialog asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// A file that is there.
    File,
    /// A folder.
    Folder,
    /// A file to write.
    NewFile,
}

/// A file dialog.
#[derive(Clone, Copy, Debug)]
pub struct FileDialog<'a> {
    /// What it asks for.
    pub asked: Asked,
    /// Its title.
    pub title: &'a str,
    /// Kind of file, and its extensions.
    pub filter: Option<(&'a str, &'a [&'a str])>,
    /// What is written is called this at first.
    pub name: &'a str,
}
