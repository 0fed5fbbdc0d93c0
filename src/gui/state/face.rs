//! A measured face as the window has it: read and judged in the background, and shown below the rotor.

use crate::export::surface::Object;
use crate::job::task::Task;
use crate::surface::height_map::HeightMap;
use crate::surface::texture::Pair;
use std::sync::Arc;

/// Measured heights, level, and what they come to.
#[derive(Debug)]
pub struct Face {
    /// Name of the file.
    pub name: String,
    /// The heights.
    pub map: HeightMap,
    /// Two faces like it.
    pub pair: Pair,
    /// Its statistics, in the units in which they are told.
    pub told: Object,
}

/// Reads a face: what it is, or why it is none.
pub type FaceTask = Task<(), Result<Face, String>>;

/// The face that was opened last, and the one that is being read.
#[derive(Debug, Default)]
pub struct FaceState {
    task: Option<FaceTask>,
    found: Option<Arc<Face>>,
}

impl FaceState {
    /// `task` reads one.
    pub fn begin(&mut self, task: FaceTask) {
        self.task = Some(task);
    }

    /// Takes what was read since the last time; why it was not is to be shown.
    pub fn drain(&mut self) -> Option<String> {
        let end = self.task.as_ref()?.drain().end?;
        self.task = None;
        match end {
            Ok(Ok(face)) => self.found = Some(Arc::new(face)),
            Ok(Err(why)) => return Some(why),
            Err(panic) => return Some(format!("The heights cannot be read: {panic}")),
        }
        None
    }

    /// Forgets it.
    pub fn forget(&mut self) {
        self.found = None;
    }

    /// Whether one is being read.
    pub fn running(&self) -> bool {
        self.task.is_some()
    }

    /// The face.
    pub fn found(&self) -> Option<&Arc<Face>> {
        self.found.as_ref()
    }
}
