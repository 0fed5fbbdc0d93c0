//! An export under way, or what the last one wrote.

use super::dialogs::Export;
use crate::job::export::ExportTask;
use crate::job::task::News;
use crate::platform::Instant;
use std::path::PathBuf;
use std::time::Duration;

/// An export under way.
#[derive(Debug)]
pub struct RunningExport {
    /// What is written.
    pub export: Export,
    task: ExportTask,
    /// When it began.
    pub started: Instant,
    /// How many pictures are drawn, of how many.
    pub drawn: (usize, usize),
    /// Whether it was told to end.
    pub cancelled: bool,
}

/// All that the window knows of exports.
#[derive(Debug, Default)]
pub struct ExportState {
    running: Option<RunningExport>,
    /// What was written last, and when: a note for a while.
    written: Option<(Vec<PathBuf>, Instant)>,
}

/// How long what was written is told.
const TOLD: Duration = Duration::from_secs(10);

impl ExportState {
    /// The one under way.
    pub fn running(&self) -> Option<&RunningExport> {
        self.running.as_ref()
    }

    /// One has begun.
    pub fn begin(&mut self, export: Export, task: ExportTask, started: Instant) {
        self.written = None;
        self.running = Some(RunningExport { export, task, started, drawn: (0, 0), cancelled: false });
    }

    /// Asks the one under way to end; nothing is written.
    pub fn cancel(&mut self) {
        if let Some(running) = &mut self.running {
            running.task.cancel();
            running.cancelled = true;
        }
    }

    /// What was written last, as long as that is told.
    pub fn written(&self) -> Option<&[PathBuf]> {
        self.written.as_ref().map(|(paths, _)| paths.as_slice())
    }

    /// Files were written.
    pub fn wrote(&mut self, paths: Vec<PathBuf>, now: Instant) {
        self.written = Some((paths, now));
    }

    /// What was written has been read.
    pub fn close_note(&mut self) {
        self.written = None;
    }

    /// Takes what has been told since the last time; an error is to be shown.
    pub fn drain(&mut self, now: Instant) -> Option<String> {
        self.written.take_if(|(_, since)| now.saturating_duration_since(*since) > TOLD);
        let running = self.running.as_mut()?;
        let News { messages, end } = running.task.drain();
        for (drawn, all) in messages {
            // Several threads count: the last to tell need not have counted last.
            running.drawn = (drawn.max(running.drawn.0), all);
        }
        let end = end?;
        self.running = None;
        match end {
            Ok(Ok(paths)) => {
                self.wrote(paths, now);
                None
            }
            Ok(Err(reason)) => reason,
            Err(panic) => Some(format!("The export failed; nothing was written: {panic}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_told_for_a_while() {
        let (mut exports, now) = (ExportState::default(), Instant::now());
        exports.wrote(vec![PathBuf::from("scene.toml")], now);
        exports.drain(now + TOLD);
        assert!(exports.written().is_some());
        exports.drain(now + 2 * TOLD);
        assert!(exports.written().is_none());
    }
}
