//! A measured face as the window has it: read and judged in the background, and shown below the rotor.

use super::background::BackgroundOf;
use crate::digits::rounded;
use crate::job::face::FaceWork;
use crate::job::task::TaskOf;
use crate::scene::Scene;
use crate::scene::heights::keys_of;
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

/// Key of the least gap that roughness leaves at a hard stop.
const SPACING: &str = "film.min_spacing_nm";

impl Face {
    /// The roughness of two faces like this one: those keys that `scene` has, with their values.
    pub fn roughness(&self, scene: &Scene) -> Vec<(&'static str, f64)> {
        let spacing = (SPACING, rounded(self.pair.min_spacing * 1e9, 4));
        keys_of(&self.pair).into_iter().chain([spacing]).filter(|(key, _)| scene.get(key).is_some()).collect()
    }
}

/// The face that was opened last, and the one that is being read.
#[derive(Debug, Default)]
pub struct FaceState {
    /// The task that reads a file.
    pub work: BackgroundOf<FaceWork>,
    /// Name of that file.
    name: String,
    /// The face.
    pub found: Option<Arc<Face>>,
}

impl FaceState {
    /// `task` reads the file of this name.
    pub fn begin(&mut self, name: String, task: TaskOf<FaceWork>) {
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
