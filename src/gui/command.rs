//! The commands that panels and keys give. `ui` pushes commands, and only `update` carries them out.

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
    /// Resets the parameter to its default; an optional parameter becomes absent.
    Reset(&'static str),
    /// From now on solves edits up to this fidelity and with all of these numerics, as one edit.
    Use(Fidelity, Numerics),
    /// Limits the time of each solve from now on; `None` for no limit.
    Budget(Option<Duration>),
    /// Copies a link to the present view.
    CopyLink,
    /// Shows what the program is, and how to cite it.
    About,
    /// Copies the citation of the program.
    CopyCitation,
    /// Undoes the last edit.
    Undo,
    /// Redoes the edit that was undone last.
    Redo,
    /// Opens a preset, or closes the window: asks first if there are unsaved changes.
    Proceed(Next),
    /// Asks the questions about a new motor.
    NewMotor,
    /// Answers one of the questions about a new motor, by its name.
    AnswerNewMotor(&'static str, String),
    /// Makes the motor that the answers describe.
    MakeNewMotor(Answers),
    /// Asks for a file or a folder for this purpose.
    Ask(Purpose),
    /// Uses the file or the folder that was chosen for this purpose.
    Chosen(Purpose, PathBuf),
    /// Uses the path that was typed for this purpose. If nothing can be saved there, the prompt stays open and shows the reason.
    Typed(Purpose, PathBuf),
    /// Saves to the scene's file, or asks for one; then does this.
    Save(Option<Next>),
    /// Saves to the scene's file, whatever another program has written there; then does this.
    Replace(Option<Next>),
    /// Closes the window although work is running; asks about unsaved changes.
    QuitAnyway,
    /// Discards unsaved changes, then does this.
    DiscardThen(Next),
    /// Closes the modal.
    CloseModal,
    /// Sets the text of the path prompt.
    TypePath(String),
    /// Refines the present scene up to this fidelity.
    Refine(Fidelity),
    /// Cancels the running solve; if there is none, the work that was started in the tab on screen.
    CancelSolve,
    /// Cancels the work that was started in the tab on screen; its results so far stay.
    CancelTab,
    /// Shows this tab in the middle of the window.
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
    /// Sets the roughness of the scene from the measured face, as one edit.
    TakeRoughness,
    /// A command for the held plate.
    Hold(HoldCommand),
    /// A command for the start-up.
    Startup(StartupCommand),
    /// Starts to measure the error against the solve time.
    Measure,
    /// Sets a target of the trade-off: an accuracy or a time.
    Target(Target),
    /// Cancels the running export; nothing is written.
    CancelExport,
    /// Closes the note about the files of the last export.
    CloseExportNote,
    /// Plays or pauses the animation of the tab.
    TogglePlay,
    /// Moves by this many frames, pausing.
    StepFrames(i64),
    /// The pointer is at this x of a view \[m\]; `None` if it is in no view.
    Hover(Option<f64>),
    /// Jumps to this phase of the cycle, or to this share of the recording of a held plate, 0 to 1, and pauses.
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
    /// Changes between the light and the dark theme.
    ToggleTheme,
    /// Changes between large text, for a lecture room, and the usual size.
    ToggleLecture,
    /// Shows or hides the parameters. Without the panels the views take the whole window.
    ToggleParameters,
    /// Shows or hides the results.
    ToggleResults,
    /// Takes a picture of the window and asks where to save it.
    Screenshot,
    /// Shows or hides the sheet of shortcuts.
    ToggleShortcuts,
    /// A command for lessons.
    Lesson(LessonCommand),
    /// Shows the tour from this stop on; `None` ends it.
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
    /// Removes a pin, or a scene that is being solved or waits to be solved for one.
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
    /// Whether to follow the newest cycle.
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
    /// Sets the uncertainty of a key to the typed text; empty removes it.
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
    /// Lets go of the plate. Under a load it falls, or floats on the vibration; without a load it returns to its mean gap.
    LetGo {
        /// Whether the face below vibrates.
        vibrates: bool,
    },
    /// Puts the film to rest at the mean gap, and clears the charts.
    Reset,
    /// Plays what the charts hold again.
    Replay,
    /// Slow motion: the leak time takes this many seconds.
    Seconds(f64),
}

/// Commands for lessons.
#[derive(Clone, Debug, PartialEq)]
pub enum LessonCommand {
    /// Begins a lesson, by its index, at a step or at the step where it was left.
    Open(usize, Option<usize>),
    /// Begins the running lesson again, without answers.
    Again,
    /// Goes to the next step; after the last step comes the recap, and then the lesson ends.
    Next,
    /// Goes to the previous step.
    Back,
    /// Ends the lesson and brings the student's scene back.
    Leave,
    /// Sets the answer to the question of the step; it can still be changed.
    Predict(Prediction),
    /// Commits the answer.
    Commit,
    /// Answers what was observed, by the index of the choice.
    Observe(usize),
    /// Answers the present question with this choice.
    Choose(usize),
    /// Does the next thing in the step: commits an answer, goes to the marked parameter, or goes to the next step.
    GoOn,
    /// Asks for one more hint.
    Hint,
    /// Makes the changes that fulfil the task.
    ShowMe,
    /// Sets up the scene of the step again.
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
