//! Lessons and the glossary, without a window: their texts, the scene that each step starts from, and its questions and tasks.
//!
//! A lesson is a folder with a `lesson.md` and, beside it, the presets and pictures that it uses. The format is described in
//! `docs/lessons.md`; the built-in lessons are in `assets/lessons`. This module knows tabs and parts of the window only by name: the window
//! passes the names that it has.

pub mod check;
mod error;
pub mod formula;
pub mod glossary;
pub mod handout;
mod lesson;
pub mod live;
pub mod picture;
mod read;
pub mod record;
pub mod text;
pub mod trial;
pub mod work;

pub use error::LessonError;
pub use lesson::{
    Act, Answer, Changes, Choice, Doing, Lesson, Prediction, Question, QuestionKind, Step, Task, WindowNames,
};

use crate::input::{self, ReadError};
use crate::scene::Scene;
use picture::Picture;
use read::Beside;
use std::path::{Path, PathBuf};

const NO_PICTURE: &str = "there is no such file beside lesson.md";
/// Largest `lesson.md` read \[MB\].
const LARGEST_FILE: u64 = 1;

/// One built-in lesson: its folder, its text, and its presets by file name.
#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    /// Name of the folder in `assets/lessons`.
    pub id: &'static str,
    /// `lesson.md`.
    pub text: &'static str,
    /// File names and contents of presets beside it.
    pub presets: &'static [(&'static str, &'static str)],
}

macro_rules! built_in {
    ($($id:literal: [$($preset:literal),*]),* $(,)?) => {
        &[$(BuiltIn {
            id: $id,
            text: include_str!(concat!("../../assets/lessons/", $id, "/lesson.md")),
            presets: &[$(($preset, include_str!(concat!("../../assets/lessons/", $id, "/", $preset)))),*],
        }),*]
    };
}

/// The built-in lessons, in the order of a course.
pub static BUILT_IN: &[BuiltIn] = built_in![
    "1-trapped-air": [],
    "2-air-that-leaves": [],
    "3-squeeze-number": [],
    "4-mean-force": [],
    "5-thin-gaps": [],
    "6-travelling-wave": [],
    "7-contact-and-air": [],
    "8-lost-torque": [],
    "9-floating": [],
    "10-accelerometers": ["accelerometer.toml"],
];

/// The built-in lessons, and the faults in them. There are no faults if the window has the names that they use: a test reads them all.
pub fn built_in(names: WindowNames<'_>) -> (Vec<Lesson>, Vec<LessonError>) {
    collect(BUILT_IN.iter().map(|lesson| {
        let preset = |name: &str| {
            let found = lesson.presets.iter().find(|(file, _)| *file == name)?;
            Some(Scene::from_toml(found.1, name))
        };
        let pictures = |_: &str, _: &str| Err(NO_PICTURE.to_owned());
        let beside = Beside { preset: &preset, pictures: &pictures };
        read::lesson(lesson.id, lesson.text, &Path::new(lesson.id).join(FILE), names, beside)
    }))
}

/// The file of a lesson.
pub const FILE: &str = "lesson.md";

/// The lessons of a folder, and the faults in them. The folder is a lesson itself, or each folder in it is one, in the order of their names.
pub fn load(folder: &Path, names: WindowNames<'_>) -> (Vec<Lesson>, Vec<LessonError>) {
    let fault = |what| (Vec::new(), vec![LessonError { origin: folder.to_owned(), line: None, what }]);
    if folder.join(FILE).is_file() {
        return collect([load_one(folder, names)]);
    }
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => return fault(ReadError::System(error.to_string()).to_string()),
    };
    let mut folders: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| path.join(FILE).is_file()).collect();
    folders.sort_by_cached_key(|folder| in_order(folder));
    if folders.is_empty() {
        let none = "holds no lesson: expected folders with a lesson.md in each, or a lesson.md itself";
        return fault(none.to_owned());
    }
    collect(folders.iter().map(|folder| load_one(folder, names)))
}

/// The key by which folders are sorted: the number at the beginning of the name, then the name, so that 2 comes before 10.
fn in_order(folder: &Path) -> (u64, PathBuf) {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let digits = name.len() - name.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    (name[..digits].parse().unwrap_or(u64::MAX), folder.to_owned())
}

fn load_one(folder: &Path, names: WindowNames<'_>) -> Result<Lesson, Vec<LessonError>> {
    let path = folder.join(FILE);
    let fault = |error: ReadError| vec![LessonError { origin: path.clone(), line: None, what: error.to_string() }];
    let text = input::read_text(&path, LARGEST_FILE).map_err(fault)?;
    let absolute = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
    let id = absolute.file_name().map_or_else(|| "lesson".to_owned(), |name| name.to_string_lossy().into_owned());
    // A name cannot lead out of the lesson's folder.
    let inside = |name: &str| {
        let inside = Path::new(name).components().all(|part| matches!(part, std::path::Component::Normal(_)));
        Some(folder.join(name)).filter(|path| inside && path.is_file())
    };
    let preset = |name: &str| inside(name).map(|path| Scene::load(&path));
    let pictures = |name: &str, alternative: &str| match inside(name) {
        Some(path) => Picture::load(&path, alternative),
        None => Err(NO_PICTURE.to_owned()),
    };
    read::lesson(&id, &text, &path, names, Beside { preset: &preset, pictures: &pictures })
}

fn collect(results: impl IntoIterator<Item = Result<Lesson, Vec<LessonError>>>) -> (Vec<Lesson>, Vec<LessonError>) {
    let (mut lessons, mut faults) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(lesson) => lessons.push(lesson),
            Err(found) => faults.extend(found),
        }
    }
    (lessons, faults)
}
