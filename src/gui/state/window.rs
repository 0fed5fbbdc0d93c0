//! The state of the whole window.

use super::activity::Activity;
use super::background::Background;
use super::dialogs::{Export, PICTURE, Purpose};
use super::document::{Document, absolute, solved_alike};
use super::edits::RejectedEdits;
use super::exports::ExportState;
use super::face::FaceState;
use super::fit::{FitState, Opened};
use super::followed::{RotorState, TorqueState};
use super::hold::HoldState;
use super::lesson_tabs::OnScreen;
use super::lessons::LessonState;
use super::modal::Modal;
use super::pins::{Page, Pins};
use super::sensitivity::SensitivityState;
use super::startup::StartupState;
use super::sweep::SweepState;
use super::switch_effect::SwitchHistory;
use super::tradeoff::TradeoffState;
use super::transient::Dropped;
use super::view::{Tab, View};
use crate::job::SolvedScene;
use crate::platform::HAS_FILES;
use crate::problem::Problem;
use crate::recording::Recording;
use crate::scene::Scene;
use crate::scene::new_motor::Answers;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

const RECENT: usize = 10;

/// Everything that is drawn, and that commands change.
#[derive(Debug, Default)]
pub struct State {
    /// The scene being edited.
    pub document: Document,
    /// The problem that the scene poses, checked and in SI units; `None` if it is refused.
    pub problem: Option<Problem>,
    /// The time limit of a solve, if there is one; after it, the best result so far is shown.
    pub budget: Option<Duration>,
    /// Edits that were rejected.
    pub rejected: RejectedEdits,
    /// The run on screen.
    pub run: Option<Arc<SolvedScene>>,
    /// Progress of the background solver.
    pub activity: Activity,
    /// View of the results.
    pub view: View,
    /// Effects of the switches of the model.
    pub switches: SwitchHistory,
    /// Error against time, if it was measured.
    pub tradeoff: Option<TradeoffState>,
    /// The export in progress, and the files of the last one.
    pub exports: ExportState,
    /// Runs that were pinned to be compared.
    pub pins: Pins,
    /// The sweep.
    pub sweep: SweepState,
    /// Measurements, and the fit to them.
    pub fit: FitState,
    /// A measured face.
    pub face: FaceState,
    /// Torque over speed.
    pub torque: TorqueState,
    /// The rotor by itself.
    pub rotor: RotorState,
    /// The sensitivity analysis.
    pub sensitivity: SensitivityState,
    /// Lessons, tour and glossary.
    pub lessons: LessonState,
    /// The start-up, if one was asked for.
    pub startup: Option<StartupState>,
    /// The plate that was dropped on its vibration, if one was.
    pub dropped: Option<Dropped>,
    /// The plate that is held, once its tab was shown.
    pub hold: Option<HoldState>,
    /// Purpose and path of the last file that could not be opened or saved, to be suggested in the next prompt.
    pub failed_path: Option<(Purpose, String)>,
    /// Answers from which a new motor was last made.
    pub new_motor: Answers,
    /// The task that makes a motor from them.
    pub making: Background<(), Scene>,
    /// The modal dialog, if one is open.
    pub modal: Option<Modal>,
    /// The dialog below an error message; it is open again when the error is closed.
    pub covered: Option<Modal>,
    /// Whether the sheet of shortcuts is shown.
    pub shortcuts: bool,
    /// Files that were opened or saved, the newest first.
    pub recent: Vec<PathBuf>,
    /// Whether the theme is dark.
    pub dark: bool,
    /// Whether text is as large as a lecture room needs it.
    pub lecture: bool,
    /// Whether the window is about to close, with no question left to answer.
    pub quitting: bool,
}

impl State {
    /// A window on `document`, with nothing solved yet.
    pub fn new(document: Document) -> Self {
        Self { document, lessons: LessonState::new(), dark: true, ..Self::default() }
    }

    /// Shows an error message.
    pub fn fail(&mut self, message: impl ToString) {
        match self.modal.replace(Modal::Error(message.to_string())) {
            None | Some(Modal::Error(_)) => {}
            dialog => self.covered = dialog,
        }
    }

    /// Puts `path` first among the files remembered.
    pub fn remember(&mut self, path: &Path) {
        if !HAS_FILES {
            return;
        }
        let path = absolute(path);
        self.recent.retain(|other| *other != path);
        self.recent.insert(0, path);
        self.recent.truncate(RECENT);
    }

    /// Which scene is open.
    pub fn opened(&self) -> Opened {
        (self.view.opened, self.lessons.running.as_ref().map(|running| (running.lesson, running.step)))
    }

    /// The measured torques that are drawn over the curve, and how many are not.
    pub fn torques(&self) -> (Vec<[f64; 2]>, usize) {
        self.fit.torques(self.opened())
    }

    /// A motor that was made from the answers since the last call, or why it could not be made.
    pub fn made(&mut self) -> Option<Result<Scene, String>> {
        self.making.news().end?.transpose()
    }

    /// The held plate, if it is what is animated in the present tab.
    pub fn held(&mut self) -> Option<&mut HoldState> {
        self.hold.as_mut().filter(|_| self.view.tab == Tab::Hold)
    }

    /// Recording that is animated in the present tab, whose frames the timeline shows.
    pub fn on_timeline(&self) -> Option<&Recording> {
        let pinned = || self.pins.runs.iter().find_map(|run| run.solved.as_ref().ok()).map(|s| &s.recording);
        let recording = match self.view.tab {
            Tab::Motion => self.run.as_ref().map(|run| &run.solution.recording),
            // The charts of a plate that is dropped show its whole fall.
            Tab::Startup if self.document.scene().floats() => None,
            Tab::Startup => self.startup.as_ref().and_then(StartupState::run).map(|run| &run.solution.recording),
            Tab::Compare if self.pins.page == Page::Fields => pinned(),
            _ => None,
        };
        recording.filter(|recording| recording.frames > 0)
    }

    /// The shortest and the longest period of the runs that are animated with `recording` \[s\]: the periods of pinned runs may differ.
    pub fn periods(&self, recording: &Recording) -> [f64; 2] {
        let pinned = self.pins.runs.iter().filter(|_| self.view.tab == Tab::Compare);
        let periods = pinned.filter_map(|run| Some(run.solved.as_ref().ok()?.recording.period));
        periods.fold([recording.period; 2], |[low, high], period| [low.min(period), high.max(period)])
    }

    /// Whether `run` belongs to another scene than the present one.
    pub fn stale(&self, run: &SolvedScene) -> bool {
        !solved_alike(&run.scene, self.document.scene())
    }

    /// Whether the present scene has no result yet, and no reason for a missing one.
    pub fn awaits_result(&self) -> bool {
        self.run.as_ref().is_none_or(|run| run.number < self.activity.number) && self.activity.failure.is_none()
    }

    /// Cancels what was started in the tab that is shown.
    pub fn cancel_tab(&mut self) {
        match self.view.tab {
            Tab::Sweep => self.sweep.cancel(),
            Tab::Fit => self.fit.work.cancel(),
            Tab::Sensitivity => self.sensitivity.cancel(),
            Tab::Startup => {
                self.dropped.iter_mut().for_each(|dropped| dropped.work.cancel());
                self.startup.iter_mut().for_each(|startup| startup.transient.work.cancel());
            }
            Tab::Tradeoff => self.tradeoff.iter_mut().for_each(|measured| measured.work.cancel()),
            _ => {}
        }
    }

    /// Whether the data that `export` writes are there.
    pub fn can_export(&self, export: Export) -> bool {
        match export {
            Export::Data | Export::Figures | Export::Fields | Export::Report => self.run.is_some(),
            Export::Animation => cfg!(feature = "render") && self.run.is_some(),
            Export::Comparison | Export::ComparisonReport => self.pins.runs.len() > 1,
            Export::SweepTable | Export::SweepFigure | Export::Sweep => {
                self.sweep.swept.as_ref().is_some_and(|swept| !swept.rows.is_empty())
            }
            Export::Sensitivity => self.sensitivity.found.is_some(),
            Export::Fit => self.fit.found.is_some(),
            Export::Startup if self.document.scene().floats() => {
                self.dropped.as_ref().is_some_and(|dropped| matches!(dropped.ended, Some(Ok(_))))
            }
            Export::Startup => {
                self.startup.as_ref().is_some_and(|startup| matches!(startup.transient.ended, Some(Ok(_))))
            }
            Export::Answers => !self.lessons.records().is_empty(),
            Export::TradeoffTable | Export::TradeoffFigure => {
                self.tradeoff.as_ref().is_some_and(|measured| !measured.tradeoff.points.is_empty())
            }
        }
    }

    /// Descriptions of running work that would be lost if the window closed now.
    pub fn unfinished(&self) -> Vec<String> {
        let export = self.exports.running.as_ref().map(|running| format!("An export: {}", running.export.title()));
        let swept = self.sweep.swept.as_ref().filter(|swept| swept.running);
        let sweep = swept.map(|swept| format!("A sweep: {} of {} points", swept.rows.len(), swept.sweep.len()));
        let building = self.sweep.building().then(|| "A sweep: its points are being prepared".to_owned());
        let fit = self.fit.work.running().then(|| "A fit".to_owned());
        let measured = self.tradeoff.as_ref().is_some_and(|measured| measured.work.running());
        let tradeoff = measured.then(|| "A measurement of the trade-off".to_owned());
        let sensitivity = self.sensitivity.running().map(|_| "Derivatives or random scenes".to_owned());
        export.into_iter().chain(sweep).chain(building).chain(fit).chain(tradeoff).chain(sensitivity).collect()
    }

    /// The suggested file name for `purpose`; empty for a file that exists already.
    pub fn suggested_path(&self, purpose: &Purpose) -> String {
        match (purpose, self.document.path()) {
            (Purpose::Save(_), Some(path)) => path.display().to_string(),
            (Purpose::Save(_), None) => {
                let stem = self.document.scene().name.replace(|c: char| !c.is_alphanumeric(), "-");
                format!("{}.toml", stem.to_lowercase())
            }
            (Purpose::Picture(_), _) => PICTURE.to_owned(),
            (Purpose::Export(export), _) => export.described().file_name.to_owned(),
            (Purpose::Open | Purpose::Lessons | Purpose::Measurements | Purpose::Heights | Purpose::Csv(_), _) => {
                String::new()
            }
        }
    }

    /// Checks the lesson against what is on screen. Returns whether it needs another frame soon.
    pub fn observe(&mut self) -> bool {
        let Self { run, torque, startup, hold, document, lessons, .. } = self;
        let seen = OnScreen { run: run.as_ref(), torque, startup: startup.as_ref(), hold: hold.as_ref() };
        lessons.observe(document, seen)
    }
}
