//! The commands that panels and keys can give. `ui` pushes commands; `update` alone carries them out.

use super::state::dialogs::Purpose;
use super::state::document::Next;
use super::state::fit::FitForm;
use super::state::pins::Page;
use super::state::sweep::Form;
use super::state::view::Tab;
use crate::analysis::quantity::Quantity;
use crate::analysis::tradeoff::Target;
use crate::fidelity::Fidelity;
use crate::gui::derived::ring::Orbit;
use crate::lessons::Prediction;
use crate::problem::Numerics;
use crate::scene::Value;
use crate::scene::new_motor::Answers;
use std::path::PathBuf;
use std::time::Duration;

/// One request of the user.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Sets a scene parameter. `dragging`: part of one continuous edit, undone as one.
    Set {
        /// Dotted key, as in the preset file.
        key: &'static str,
        /// The new value.
        value: Value,
        /// Whether the pointer still holds the slider.
        dragging: bool,
    },
    /// Sets a scene parameter from typed text; refused text becomes a message at the parameter.
    SetText(&'static str, String),
    /// Back to the parameter's default (for an optional one: absent).
    Reset(&'static str),
    /// Solves edits up to this fidelity, with all of these numerics, from now on: one edit.
    Use(Fidelity, Numerics),
    /// The most time that a solve may take from now on, if that is limited.
    Budget(Option<Duration>),
    /// Copies a link to the present view.
    CopyLink,
    /// Tells what the program is, and how it is cited.
    About,
    /// Copies its citation.
    CopyCitation,
    /// Undoes the last edit.
    Undo,
    /// Redoes the edit that was undone last.
    Redo,
    /// Opens a preset, or closes the window: asks first if there are unsaved changes.
    Proceed(Next),
    /// Asks about a new motor.
    NewMotor,
    /// Answers one of the questions about it, by its name.
    AnswerNewMotor(&'static str, String),
    /// Makes the motor that the answers describe.
    MakeNewMotor(Answers),
    /// Asks for a file or a folder to do this with.
    Ask(Purpose),
    /// Does this with the file or the folder that was chosen.
    Chosen(Purpose, PathBuf),
    /// Does this with the path that was typed. If nothing can be saved there the prompt stays, with the reason.
    Typed(Purpose, PathBuf),
    /// Saves to the scene's file, or asks for one; then does this.
    Save(Option<Next>),
    /// Saves to the scene's file, whatever another program has written there; then does this.
    Replace(Option<Next>),
    /// Closes the window although work goes on; asks about unsaved changes.
    QuitAnyway,
    /// Discards unsaved changes, then does this.
    DiscardThen(Next),
    /// Closes the modal.
    CloseModal,
    /// Sets the text of the path prompt.
    TypePath(String),
    /// Refines the present scene up to this fidelity.
    Refine(Fidelity),
    /// Cancels the running solve; if there is none, what was started in the tab that is shown.
    CancelSolve,
    /// Cancels what was started in the tab that is shown; what there is of it stays.
    CancelTab,
    /// Shows this in the middle of the window.
    Show(Tab),
    /// A command for the pinned runs.
    Pin(PinCommand),
    /// A command for the sweep.
    Sweep(SweepCommand),
    /// A command for the sensitivity analysis.
    Sensitivity(SensitivityCommand),
    /// A command for measurements and fits.
    Fit(FitCommand),
    /// Forgets the measured face.
    ForgetFace,
    /// Gives the scene the roughness that follows from the measured face: one edit.
    TakeRoughness,
    /// A command for the held plate.
    Hold(HoldCommand),
    /// A command for the start-up.
    Startup(StartupCommand),
    /// Measures error against time, now.
    Measure,
    /// Sets a target of the trade-off: an accuracy or a time.
    Target(Target),
    /// Ends the export under way; nothing is written.
    CancelExport,
    /// Closes the note about the files of the last export.
    CloseExportNote,
    /// Play or pause what moves in the middle.
    TogglePlay,
    /// Moves by this many frames, pausing.
    StepFrames(i64),
    /// The pointer is at this x of a view \[m\], or in none.
    Hover(Option<f64>),
    /// Jumps to this phase of the cycle, or share of what is recorded of a held plate, 0 to 1, pausing.
    Seek(f64),
    /// Seconds on screen for one cycle.
    SecondsPerCycle(f64),
    /// Follows this tooth.
    FollowTooth(usize),
    /// Follows the tooth this many further on.
    NextTooth(i64),
    /// Sets the direction that the ring is seen from.
    Orbit(Orbit),
    /// Shows a prompt for a path to open.
    OpenPathPrompt,
    /// Light or dark.
    ToggleTheme,
    /// Large text, for a lecture room, or the usual size.
    ToggleLecture,
    /// Shows or hides the parameters: without panels the views have the whole window.
    ToggleParameters,
    /// Shows or hides the results.
    ToggleResults,
    /// Takes a picture of the window and asks where to save it.
    Screenshot,
    /// Shows or hides the sheet of shortcuts.
    ToggleShortcuts,
    /// A command for lessons.
    Lesson(LessonCommand),
    /// The tour, from this stop on; none ends it.
    Tour(Option<usize>),
    /// Shows or hides the glossary.
    Glossary(bool),
    /// Searches the glossary for this text.
    SearchGlossary(String),
}

/// Commands for the pinned runs.
#[derive(Clone, Debug, PartialEq)]
pub enum PinCommand {
    /// Pins the run on screen.
    Shown,
    /// Solves a built-in preset in the background and pins it.
    Preset(&'static str),
    /// Renames a pin.
    Rename(u64, String),
    /// Removes a pin, or one that is being solved, or will be.
    Remove(u64),
    /// Removes all pins.
    Clear,
    /// Brings back the pins that were removed last, by `Remove` or `Clear`.
    Restore,
    /// Makes the scene of a pin the present scene: one edit.
    Open(u64),
    /// Shows this page of the comparison.
    Look(Page),
    /// Lists all parameters, or only those that differ.
    AllParameters(bool),
}

/// Commands for the sweep.
#[derive(Clone, Debug, PartialEq)]
pub enum SweepCommand {
    /// Replaces the form.
    Form(Form),
    /// Chooses the quantity that is drawn.
    Draw(Quantity),
    /// Starts a new sweep.
    Start,
    /// Continues a cancelled sweep.
    Continue,
    /// Makes the scene of a point the present scene: one edit.
    Open(usize),
}

/// Commands for measurements and fits.
#[derive(Clone, Debug, PartialEq)]
pub enum FitCommand {
    /// Forgets the table.
    Forget,
    /// Replaces the form.
    Form(FitForm),
    /// Starts the fit or the search.
    Start,
    /// Gives the scene the values that were found: one edit.
    Take,
}

/// Commands for the start-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartupCommand {
    /// Starts from rest.
    Start,
    /// Shows this cycle, or the nearest one that is kept.
    Choose(usize),
    /// Whether the newest cycle is looked at.
    Follow(bool),
    /// Plays from the first cycle on.
    Replay,
}

/// Commands for the sensitivity analysis.
#[derive(Clone, Debug, PartialEq)]
pub enum SensitivityCommand {
    /// Computes the derivatives.
    Start,
    /// Shows this result, by its index.
    Look(usize),
    /// The uncertainty of a key, as it is typed; empty for none.
    Uncertainty(&'static str, String),
    /// Sets the number of random scenes.
    Draws(usize),
    /// Solves random scenes.
    Draw,
}

/// Commands for the held plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HoldCommand {
    /// Holds it at this gap \[m\].
    To(f64),
    /// Moves it by this share of its mean gap.
    By(f64),
    /// Lets it go: it falls, or floats on the vibration; without a load it goes back to its mean gap.
    LetGo {
        /// Whether the face below vibrates.
        vibrates: bool,
    },
    /// Puts the film to rest at the mean gap, and clears the charts.
    Reset,
    /// Plays what the charts hold once more.
    Replay,
    /// Slow motion: the leak time takes this many seconds.
    Seconds(f64),
}

/// Commands for lessons.
#[derive(Clone, Debug, PartialEq)]
pub enum LessonCommand {
    /// Begins a lesson, by its place in the list, at a step or where it was left.
    Open(usize, Option<usize>),
    /// Begins the lesson that is followed once more, with nothing answered.
    Again,
    /// The step after this one; after the last comes the recap, and then the lesson ends.
    Next,
    /// The step before this one.
    Back,
    /// Ends the lesson and brings the student's scene back.
    Leave,
    /// Answers the question of the step, for now.
    Predict(Prediction),
    /// Keeps to that answer.
    Commit,
    /// Answers what was observed, by the index of the choice.
    Observe(usize),
    /// Answers what is asked now with this choice.
    Choose(usize),
    /// Does what comes next: commits an answer, goes to the marked parameter, or goes to the next step.
    GoOn,
    /// Asks for one more hint.
    Hint,
    /// Makes the changes that fulfil the task.
    ShowMe,
    /// Sets the step's scene up again.
    SetUp,
    /// Shows all results in place of the lesson's text, or the text again.
    AllResults(bool),
    /// Reads the lessons of all folders again.
    Reload,
    /// Shows again the faults found in lessons.
    Faults,
}

macro_rules! commands_of {
    ($($variant:ident($part:ty)),*) => {
        $(impl From<$part> for Command {
            fn from(part: $part) -> Self {
                Self::$variant(part)
            }
        })*
    };
}

commands_of!(Pin(PinCommand), Sweep(SweepCommand), Startup(StartupCommand), Hold(HoldCommand), Lesson(LessonCommand));
commands_of!(Proceed(Next), Sensitivity(SensitivityCommand), Fit(FitCommand));

impl Command {
    /// The parameter that it edits.
    pub fn edited(&self) -> Option<&'static str> {
        match self {
            Self::Set { key, .. } | Self::SetText(key, _) => Some(key),
            _ => None,
        }
    }
}
