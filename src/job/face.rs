//! A measured face: its file is read, and its roughness computed, in the background.

use super::work::Work;
use crate::control::Cancel;
use crate::input::{read_bytes, text};
use crate::platform::handed_over;
use crate::scene::heights::LARGEST;
use crate::surface::height_map::HeightMap;
use crate::surface::texture::{Texture, measured};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A file of heights, as it is sent to the thread or worker that reads it. In a page its content goes with it, because a worker has no files.
#[derive(Debug, Serialize, Deserialize)]
pub struct FaceWork {
    path: PathBuf,
    bytes: Option<Vec<u8>>,
}

impl FaceWork {
    /// The file at this path.
    pub fn new(path: PathBuf) -> Self {
        Self { bytes: handed_over(&path), path }
    }
}

impl Work for FaceWork {
    const NAME: &'static str = "face";
    type Message = ();
    /// The heights after levelling, with roughness and summits.
    type Output = (HeightMap, Texture);

    fn run(self, _: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        let Self { path, bytes } = self;
        let bytes = bytes.map_or_else(|| read_bytes(&path, LARGEST), Ok);
        let found = bytes.and_then(text).map_err(|error| error.to_string());
        let found = found.and_then(|text| measured(&text, 1).map_err(|error| error.to_string()));
        found.map(Some).map_err(|reason| format!("{}: {reason}", path.display()))
    }
}
