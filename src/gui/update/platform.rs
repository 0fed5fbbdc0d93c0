//! What the window takes from outside: the time, what file dialogs answer, and how much is measured. Tests bring their own.

use crate::analysis::tradeoff::{Candidate, Effort, candidates};
use crate::gui::state::dialogs::{Answer, Purpose};
use crate::problem::Problem;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// The clock, the file dialogs and the effort of measurements.
#[derive(Clone, Debug)]
pub struct Platform {
    /// The present moment.
    pub now: fn() -> Instant,
    /// Asks for a file; blocks until there is an answer.
    pub ask: fn(Purpose, &DialogStart) -> Answer,
    /// The file in which the window keeps what the next one begins with; none if it keeps nothing in a file.
    pub storage: Option<PathBuf>,
    /// What to measure for the trade-off, and how long.
    pub measure: fn(&Problem) -> (Vec<Candidate>, Effort),
}

/// What a file dialog begins with.
#[derive(Clone, Debug)]
pub struct DialogStart {
    /// Name of the file, if one is to be written.
    pub name: String,
    /// The system's dialog, with the window as its parent.
    pub native: rfd::FileDialog,
}

impl Default for Platform {
    fn default() -> Self {
        Self {
            now: Instant::now,
            ask: native_dialog,
            storage: None,
            measure: |problem| (candidates(problem), Effort::default()),
        }
    }
}

/// Nobody closes a dialog this soon: it was never there.
const TOO_SOON: Duration = Duration::from_millis(400);

/// Asks the system's own dialog.
fn native_dialog(purpose: Purpose, start: &DialogStart) -> Answer {
    let started = Instant::now();
    let (name, dialog) = (start.name.as_str(), start.native.clone());
    let dialog = match purpose {
        Purpose::Picture(_) => dialog.add_filter("Picture", &["png"]),
        Purpose::Export(export) => match export.filter() {
            Some((kind, extensions)) => dialog.add_filter(kind, extensions),
            None => dialog,
        },
        Purpose::Lessons => dialog,
        Purpose::Measurements => dialog.add_filter("Table", &["csv"]),
        Purpose::Heights => dialog.add_filter("Heights", &["csv", "txt"]),
        Purpose::Open | Purpose::Save(_) => dialog.add_filter("Preset", &["toml"]),
    };
    let path = match purpose {
        Purpose::Open => dialog.set_title("Open a preset").pick_file(),
        Purpose::Measurements => dialog.set_title("Open a table of measurements").pick_file(),
        Purpose::Heights => dialog.set_title("Open measured heights").pick_file(),
        Purpose::Export(export) if export.is_folder() => dialog.set_title(export.title()).pick_folder(),
        Purpose::Lessons => dialog.set_title("Open a folder of lessons").pick_folder(),
        Purpose::Export(export) => dialog.set_title(export.title()).set_file_name(name).save_file(),
        Purpose::Save(_) | Purpose::Picture(_) => dialog.set_title("Save").set_file_name(name).save_file(),
    };
    // Without a portal and without zenity the library answers as if the dialog had been closed, but at once.
    match path {
        Some(path) => Answer::Path(path),
        None if started.elapsed() < TOO_SOON => Answer::NoDialog,
        None => Answer::Cancelled,
    }
}
