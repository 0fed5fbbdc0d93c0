//! What the window uses of its surroundings: clock and date, file dialogs, and the effort of measurements. Tests replace them.

use super::storage::StoragePlace;
use crate::analysis::tradeoff::{Candidate, Effort, candidates};
use crate::gui::state::dialogs::{Answer, Purpose};
use crate::platform::window::Parent;
use crate::platform::{DialogKind, FileDialog, HAS_FILES, Instant, SystemTime};
use crate::problem::Problem;
use std::time::Duration;

/// The clock, the file dialogs and the effort of measurements.
#[derive(Clone, Debug)]
pub struct Platform {
    /// The present moment.
    pub now: fn() -> Instant,
    /// The present date, for records that outlive the window.
    pub date: fn() -> SystemTime,
    /// Asks for a file; blocks until there is an answer.
    pub ask: fn(Purpose, &DialogStart) -> Answer,
    /// Where the state is kept for the next window.
    pub storage: StoragePlace,
    /// Settings to measure for the trade-off, and the effort.
    pub measure: fn(&Problem) -> (Vec<Candidate>, Effort),
}

/// Initial state of a file dialog.
#[derive(Clone, Debug)]
pub struct DialogStart {
    /// Name of the file, if one is to be written.
    pub name: String,
    /// The window that it is shown over.
    pub parent: Parent,
}

impl Default for Platform {
    fn default() -> Self {
        Self {
            now: Instant::now,
            date: SystemTime::now,
            ask: native_dialog,
            storage: StoragePlace::Browser,
            measure: |problem| (candidates(problem), Effort::default()),
        }
    }
}

/// Without a portal and zenity, rfd returns `None` at once. A `None` within this time therefore means that no dialog was shown.
const TOO_SOON: Duration = Duration::from_millis(400);

/// Asks the system's own dialog.
fn native_dialog(purpose: Purpose, start: &DialogStart) -> Answer {
    let started = Instant::now();
    let filter = purpose.filter();
    // The buttons of the system's dialog say what it is for.
    let title = if matches!(purpose, Purpose::Picture(_) | Purpose::Save(_)) { "Save" } else { purpose.title() };
    let asked = match (filter, purpose.writes()) {
        (None, _) => DialogKind::Folder,
        (Some(_), true) => DialogKind::NewFile,
        (Some(_), false) => DialogKind::File,
    };
    match start.parent.ask(&FileDialog { asked, title, filter, name: &start.name }) {
        Some(path) => Answer::Path(path),
        None if HAS_FILES && started.elapsed() < TOO_SOON => Answer::NoDialog,
        None => Answer::Cancelled,
    }
}
