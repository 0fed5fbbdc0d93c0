//! A measured face in the window: read and analysed in the background, and shown below the rotor.

use super::background::BackgroundOf;
use super::dialogs::Purpose;
use crate::digits::rounded;
use crate::job::single::FaceWork;
use crate::job::task::TaskOf;
use crate::scene::Scene;
use crate::scene::heights::keys_of;
use crate::surface::height_map::HeightMap;
use crate::surface::texture::{Pair, Texture};
use std::path::PathBuf;
use std::sync::Arc;

/// A measured face: its heights, levelled, and their statistics.
#[derive(Debug)]
pub struct MeasuredFace {
    /// Name of the file.
    pub name: String,
    /// The heights.
    pub map: HeightMap,
    /// The statistics of a pair of faces like this one.
    pub pair: Pair,
    /// Its statistics.
    pub texture: Texture,
}

/// Key of the least gap that roughness leaves at a hard stop.
const SPACING: &str = "film.min_spacing_nm";

impl MeasuredFace {
    /// The roughness of a pair of faces like this one: those of its keys that `scene` has, with their values.
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
    /// That file, and the purpose for which it was opened.
    asked: Option<(Purpose, PathBuf)>,
    /// The face.
    pub found: Option<Arc<MeasuredFace>>,
}

impl FaceState {
    /// Starts to track `task`, which reads the file at this path for `purpose`.
    pub fn begin(&mut self, purpose: Purpose, path: PathBuf, task: TaskOf<FaceWork>) {
        (self.work, self.asked) = (task.into(), Some((purpose, path)));
    }

    /// Takes a face that was read since the last call. Returns the file that could not be read, the purpose for which it was opened, and
    /// the reason.
    pub fn drain(&mut self) -> Option<(Purpose, PathBuf, String)> {
        let end = self.work.news().end?;
        let (purpose, path) = self.asked.take()?;
        match end {
            Ok(found) => {
                let (map, texture) = found?;
                let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                let pair = Pair::of(&texture, &texture);
                self.found = Some(Arc::new(MeasuredFace { name, map, pair, texture }));
                None
            }
            Err(why) => Some((purpose, path, why)),
        }
    }
}
