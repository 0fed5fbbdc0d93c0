//! An export under way, or what the last one wrote.

use super::background::Background;
use super::dialogs::Export;
use crate::job::export::{ExportTask, Files};
use crate::job::task::News;
use crate::job::work::Work;
use crate::platform::Instant;
use std::path::PathBuf;

/// An export under way.
#[derive(Debug)]
pub struct RunningExport {
    /// What is written.
    pub export: Export,
    /// It tells how many pictures of an animation are drawn.
    pub work: Background<<Files as Work>::Message, <Files as Work>::Found>,
    /// When it began.
    pub started: Instant,
    /// How many pictures are drawn, of how many.
    pub drawn: (usize, usize),
}

/// All that the window knows of exports.
#[derive(Debug, Default)]
pub struct ExportState {
    running: Option<RunningExport>,
    /// What the last one wrote.
    pub written: Option<Vec<PathBuf>>,
}

impl ExportState {
    /// The one under way.
    pub fn running(&self) -> Option<&RunningExport> {
        self.running.as_ref()
    }

    /// One has begun.
    pub fn begin(&mut self, export: Export, task: ExportTask, started: Instant) {
        self.written = None;
        self.running = Some(RunningExport { export, work: task.into(), started, drawn: (0, 0) });
    }

    /// Asks the one under way to end; nothing is written.
    pub fn cancel(&mut self) {
        self.running.iter_mut().for_each(|running| running.work.cancel());
    }

    /// Takes what has been told since the last time; an error is to be shown.
    pub fn drain(&mut self) -> Option<String> {
        let running = self.running.as_mut()?;
        let News { messages, end } = running.work.news();
        for (drawn, all) in messages {
            // Several threads count: the last to tell need not have counted last.
            running.drawn = (drawn.max(running.drawn.0), all);
        }
        let end = end?;
        self.running = None;
        end.map(|paths| self.written = paths).err()
    }
}
