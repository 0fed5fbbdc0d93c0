//! A measured face as the window has it: read and judged in the background, and shown below the rotor.

use super::background::Background;
use crate::job::task::BackgroundTask;
use crate::surface::height_map::HeightMap;
use crate::surface::texture::{Pair, Texture};
use std::sync::Arc;

/// A measured face: its heights, levelled, and their statistics.
#[derive(Debug)]
pub struct Face {
    /// Name of the file.
    pub name: String,
    /// The heights.
    pub map: HeightMap,
    /// Two faces like it.
    pub pair: Pair,
    /// Its statistics.
    pub texture: Texture,
}

/// Reads a face: its heights and what they come to.
pub type FaceTask = BackgroundTask<(), (HeightMap, Texture)>;

/// The face that was opened last, and the one that is being read.
#[derive(Debug, Default)]
pub struct FaceState {
    /// The task that reads a file.
    pub work: Background<(), (HeightMap, Texture)>,
    /// Name of that file.
    name: String,
    /// The face.
    pub found: Option<Arc<Face>>,
}

impl FaceState {
    /// `task` reads the file of this name.
    pub fn begin(&mut self, name: String, task: FaceTask) {
        (self.work, self.name) = (task.into(), name);
    }

    /// Takes a face that was read since the last call; returns an error to be shown.
    pub fn drain(&mut self) -> Option<String> {
        let found = self.work.news().end?.map(|found| {
            let (map, texture) = found?;
            let (name, pair) = (self.name.clone(), Pair::of(&texture, &texture));
            Some(Arc::new(Face { name, map, pair, texture }))
        });
        found.map(|face| self.found = face.or(self.found.take())).err()
    }
}
