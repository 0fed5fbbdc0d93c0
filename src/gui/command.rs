//! What a panel or a key asks the application to do. Panels push commands; only the application carries them out.

use super::dialogs::Export;
use super::exporting::Exporting;
use super::holding;
use super::lessons::Teach;
use super::pinned::Pinning;
use super::starting;
use super::state::Tab;
use super::sweeping::Sweeping;
use crate::analysis::tradeoff::Wish;
use crate::fidelity::Fidelity;
use crate::problem::Numerics;
use crate::scene::Value;
use std::path::PathBuf;

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
    SetText {
        /// Dotted key.
        key: &'static str,
        /// What was typed.
        text: String,
    },
    /// Back to the parameter's default (for an optional one: absent).
    Reset {
        /// Dotted key.
        key: &'static str,
    },
    /// Solves with these numerics, refined up to this fidelity, from now on: one edit.
    Use {
        /// The last fidelity that an edit is solved at.
        aim: Fidelity,
        /// All of the scene's numerics.
        numerics: Numerics,
    },
    /// Takes the last edit back.
    Undo,
    /// Makes it again.
    Redo,
    /// Opens a built-in preset.
    OpenBuiltIn(&'static str),
    /// Asks for a file to open.
    OpenDialog,
    /// Opens a file.
    OpenPath(PathBuf),
    /// Saves to the scene's file, or asks for one.
    Save,
    /// Asks for a file and saves there.
    SaveAs,
    /// Saves to this file.
    SavePath(PathBuf),
    /// Saves, asking for a file if there is none, then does this.
    SaveThen(Box<Command>),
    /// Gives unsaved changes up, then does this.
    DiscardThen(Box<Command>),
    /// A question was left unanswered.
    Dismissed,
    /// Refines the present scene up to this fidelity.
    Refine(Fidelity),
    /// Cancels the running solve.
    CancelSolve,
    /// Shows this in the middle of the window.
    Show(Tab),
    /// Asks something of the pinned runs.
    Pin(Pinning),
    /// Asks something of the sweep.
    Sweep(Sweeping),
    /// About the plate that is held.
    Hold(holding::Ask),
    /// About the start-up.
    Startup(starting::Ask),
    /// Measures error against time, now.
    Measure,
    /// Ends the measurement.
    CancelMeasure,
    /// What is asked of the trade-off.
    Wish(Wish),
    /// Asks where to write this, and writes it.
    Export(Export),
    /// Asks something of the export under way.
    Exporting(Exporting),
    /// Writes this to a file.
    WriteExport(Export, PathBuf),
    /// Play or pause.
    TogglePlay,
    /// Moves by this many frames, pausing.
    StepFrames(i64),
    /// Jumps to this phase of the cycle, 0 to 1, pausing.
    Seek(f64),
    /// Seconds on screen for one cycle.
    SecondsPerCycle(f64),
    /// Follows this tooth.
    FollowTooth(usize),
    /// Follows the tooth this many further on.
    NextTooth(i64),
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
    /// Saves the picture that was taken to this file.
    WritePicture(PathBuf),
    /// Shows or hides the sheet of shortcuts.
    ToggleShortcuts,
    /// Something of the lessons, the tour or the glossary.
    Teach(Teach),
    /// Closes the window.
    Quit,
}
