//! The export in progress, and the files of the last one.

use super::background::BackgroundOf;
use super::dialogs::Export;
use crate::job::export::Files;
use crate::job::task::{News, TaskOf};
use crate::platform::Instant;
use std::path::PathBuf;
use std::time::Duration;

/// An export under way.
#[derive(Debug)]
pub struct RunningExport {
    /// The kind of export.
    pub export: Export,
    /// The task; its messages give the number of pictures of an animation that are drawn.
    pub work: BackgroundOf<Files>,
    /// When it began.
    pub started: Instant,
    /// Pictures drawn so far, and their total.
    pub drawn: (usize, usize),
}

/// State of exports.
#[derive(Debug, Default)]
pub struct ExportState {
    /// The export that is being written.
    pub running: Option<RunningExport>,
    /// Files written last, and when; shown as a note for a while.
    pub written: Option<(Vec<PathBuf>, Instant)>,
}

/// How long the note about written files is shown.
const TOLD: Duration = Duration::from_secs(10);

impl ExportState {
    /// Starts to track an export that has begun.
    pub fn begin(&mut self, export: Export, task: TaskOf<Files>, started: Instant) {
        self.written = None;
        self.running = Some(RunningExport { export, work: task.into(), started, drawn: (0, 0) });
    }

    /// Takes progress and results since the last call; returns an error to be shown.
    pub fn drain(&mut self, now: Instant) -> Option<String> {
        self.written.take_if(|(_, since)| now.saturating_duration_since(*since) > TOLD);
        let running = self.running.as_mut()?;
        let News { messages, end } = running.work.news();
        for (drawn, all) in messages {
            // Several threads draw: the last message need not have the highest count.
            running.drawn = (drawn.max(running.drawn.0), all);
        }
        let end = end?;
        self.running = None;
        end.map(|paths| paths.into_iter().for_each(|paths| self.written = Some((paths, now)))).err()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_told_for_a_while() {
        let (mut exports, now) = (ExportState::default(), Instant::now());
        exports.written = Some((vec![PathBuf::from("scene.toml")], now));
        exports.drain(now + TOLD);
        assert!(exports.written.is_some());
        exports.drain(now + 2 * TOLD);
        assert!(exports.written.is_none());
    }
}
