//! What the window takes from outside: the time, what file dialogs answer, and how much is measured. Tests bring their own.

use crate::analysis::tradeoff::{Candidate, Effort, candidates};
use crate::gui::state::dialogs::{Answer, Purpose};
use crate::problem::Problem;
use std::time::{Duration, Instant};

/// The clock, the file dialogs and the effort of measurements.
#[derive(Clone, Copy, Debug)]
pub struct Platform {
    /// The present moment.
    pub now: fn() -> Instant,
    /// Asks for a file, with a name to begin with; blocks until there is an answer.
    pub ask: fn(Purpose, &str) -> Answer,
    /// What to measure for the trade-off, and how long.
    pub measure: fn(&Problem) -> (Vec<Candidate>, Effort),
}

impl Default for Platform {
    fn default() -> Self {
        Self { now: Instant::now, ask: native_dialog, measure: |problem| (candidates(problem), Effort::default()) }
    }
}

/// Nobody closes a dialog this soon: it was never there.
const TOO_SOON: Duration = Duration::from_millis(400);

/// Asks the system's own dialog.
fn native_dialog(purpose: Purpose, name: &str) -> Answer {
    let started = Instant::now();
    let dialog = match purpose {
        Purpose::Screenshot => rfd::FileDialog::new().add_filter("Picture", &["png"]),
        Purpose::Export(export) => match export.filter() {
            Some((kind, extensions)) => rfd::FileDialog::new().add_filter(kind, extensions),
            None => rfd::FileDialog::new(),
        },
        Purpose::Lessons => rfd::FileDialog::new(),
        Purpose::Open | Purpose::Save => rfd::FileDialog::new().add_filter("Preset", &["toml"]),
    };
    let path = match purpose {
        Purpose::Open => dialog.set_title("Open a preset").pick_file(),
        Purpose::Export(export) if export.is_folder() => dialog.set_title(export.title()).pick_folder(),
        Purpose::Lessons => dialog.set_title("Open a folder of lessons").pick_folder(),
        Purpose::Export(export) => dialog.set_title(export.title()).set_file_name(name).save_file(),
        Purpose::Save | Purpose::Screenshot => dialog.set_title("Save").set_file_name(name).save_file(),
    };
    // Without a portal and without zenity the library answers as if the dialog had been closed, but at once.
    match path {
        Some(path) => Answer::Path(path),
        None if started.elapsed() < TOO_SOON => Answer::NoDialog,
        None => Answer::Cancelled,
    }
}
