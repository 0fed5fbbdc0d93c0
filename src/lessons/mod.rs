//! Lessons and the glossary, without a window: what they say, what scene each step starts from, what it asks.
//!
//! A lesson is a folder with a `lesson.md` and, beside it, any presets it uses. The format is described in
//! `docs/lessons.md`; the built-in lessons are in `assets/lessons`. Tabs and parts of the window are names here: the window
//! hands in those that it has.

pub mod check;
mod error;
pub mod formula;
pub mod glossary;
pub mod live;
mod read;
pub mod text;

pub use error::{LessonError, LessonErrorKind};

use crate::scene::{Parameter, Scene};
use check::{Check, Name};
use std::path::{Path, PathBuf};
use text::{Block, Inline};

/// Largest `lesson.md` read \[bytes\].
pub(crate) const LARGEST_FILE: u64 = 1 << 20;

/// What a lesson may name in the window.
#[derive(Clone, Copy, Debug, Default)]
pub struct WindowNames<'a> {
    /// Names of the tabs in the middle that a motor has, and that a plate has.
    pub tabs: [&'a [&'a str]; 2],
    /// Names of what can be lit.
    pub places: &'a [&'a str],
}

/// A lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Lesson {
    /// The name of its folder: what its progress is kept under.
    pub id: String,
    /// Its title.
    pub title: String,
    /// A line or two on what it is about.
    pub about: Vec<Block>,
    /// Its steps, at least one.
    pub steps: Vec<Step>,
}

/// One step of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Its heading.
    pub title: String,
    /// What it says.
    pub body: Vec<Block>,
    /// The scene of a student who comes straight here.
    pub scene: Scene,
    /// Whether the scene is set up anew; otherwise the step goes on with what is there.
    pub sets: bool,
    /// Parameters that are lit.
    pub light: Vec<&'static Parameter>,
    /// Parts of the window that are lit.
    pub look: Vec<String>,
    /// The tab that is brought forward.
    pub tab: Option<String>,
    /// Results and keys that are shown beside the text.
    pub show: Vec<Name>,
    /// What is asked before anything is tried.
    pub question: Option<Question>,
    /// What is to be done.
    pub task: Option<Task>,
}

/// A question, answered before the answer is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// What is asked.
    pub ask: Vec<Block>,
    /// The answer.
    pub answer: Answer,
    /// Why it is so.
    pub why: Vec<Block>,
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// One of several.
    Choice {
        /// All.
        choices: Vec<Vec<Inline>>,
        /// The right one.
        right: usize,
    },
    /// A number.
    Number {
        /// The right one.
        value: f64,
        /// Its unit; empty for a pure number.
        unit: String,
        /// How far a good prediction may be off, relative.
        within: f64,
    },
}

/// Changes of a scene, by key, as after `--set`.
pub type Changes = Vec<(String, String)>;

/// What a student does in a tab, which leaves the scene as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Act {
    /// Moves the held plate to this gap \[µm\].
    Hold(f64),
    /// Starts from rest.
    StartUp,
}

/// What does a task, or does not do it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Doing {
    /// Changes of the scene.
    pub changes: Changes,
    /// And in a tab.
    pub acts: Vec<Act>,
}

impl Doing {
    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty() && self.acts.is_empty()
    }
}

/// What is to be done, and how it is seen that it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// In words.
    pub ask: Vec<Block>,
    /// What the student's run is checked for.
    pub check: Check,
    /// Help while it does not hold.
    pub hint: Vec<Block>,
    /// What would do, shown on request.
    pub example: Doing,
    /// What would not do: for tests.
    pub wrong: Doing,
    /// What is said once it holds.
    pub then: Vec<Block>,
}

impl Answer {
    /// Whether a prediction is right.
    pub fn is_right(&self, prediction: Prediction) -> bool {
        match (self, prediction) {
            (Self::Choice { right, .. }, Prediction::Choice(choice)) => *right == choice,
            (Self::Number { value, within, .. }, Prediction::Number(number)) => {
                (number - value).abs() <= within * value.abs() * (1.0 + 1e-9)
            }
            _ => false,
        }
    }
}

/// What a student predicts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prediction {
    /// One of several.
    Choice(usize),
    /// A number, in the unit of the question.
    Number(f64),
}

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
];

/// The built-in lessons.
///
/// # Errors
/// A fault in one of them; a test reads them all.
pub fn built_in(names: WindowNames<'_>) -> (Vec<Lesson>, Vec<LessonError>) {
    collect(BUILT_IN.iter().map(|lesson| {
        let preset = |name: &str| {
            let found = lesson.presets.iter().find(|(file, _)| *file == name)?;
            Some(Scene::from_toml(found.1, name))
        };
        read::lesson(lesson.id, lesson.text, &Path::new(lesson.id).join(FILE), names, &preset)
    }))
}

/// The file of a lesson.
pub const FILE: &str = "lesson.md";

/// The lessons of a folder: of each folder in it, in the order of their names, or of itself.
pub fn load(folder: &Path, names: WindowNames<'_>) -> (Vec<Lesson>, Vec<LessonError>) {
    let fault = |kind| (Vec::new(), vec![LessonError { origin: folder.to_owned(), line: None, kind }]);
    if folder.join(FILE).is_file() {
        return collect([load_one(folder, names)]);
    }
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => return fault(LessonErrorKind::Unreadable(error.to_string())),
    };
    let mut folders: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| path.join(FILE).is_file()).collect();
    folders.sort();
    if folders.is_empty() {
        return fault(LessonErrorKind::NoLessons);
    }
    collect(folders.iter().map(|folder| load_one(folder, names)))
}

fn load_one(folder: &Path, names: WindowNames<'_>) -> Result<Lesson, Vec<LessonError>> {
    let path = folder.join(FILE);
    let fault = |kind| vec![LessonError { origin: path.clone(), line: None, kind }];
    let length = std::fs::metadata(&path).map_err(|error| fault(LessonErrorKind::Unreadable(error.to_string())))?.len();
    if length > LARGEST_FILE {
        return Err(fault(LessonErrorKind::TooLarge(LARGEST_FILE)));
    }
    let text = std::fs::read_to_string(&path).map_err(|error| fault(LessonErrorKind::Unreadable(error.to_string())))?;
    let absolute = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
    let id = absolute.file_name().map_or_else(|| "lesson".to_owned(), |name| name.to_string_lossy().into_owned());
    let preset = |name: &str| {
        let path = folder.join(name);
        // A name stays in the lesson's folder.
        let inside = Path::new(name).components().all(|part| matches!(part, std::path::Component::Normal(_)));
        (inside && path.is_file()).then(|| Scene::load(&path))
    };
    read::lesson(&id, &text, &path, names, &preset)
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
