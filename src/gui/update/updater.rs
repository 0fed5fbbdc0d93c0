//! The updater, which carries out commands. It owns the state, the solver and the file dialogs, and requests redraws.

use super::dialogs::Dialogs;
use super::platform::Platform;
use crate::fidelity::Fidelity;
use crate::gui::state::dialogs::Purpose;
use crate::gui::state::view::Tab;
use crate::gui::state::window::State;
use crate::job::export::Files;
use crate::job::task::{BackgroundTask, TaskOf};
use crate::job::work::{Posed, Work};
use crate::job::{Request, Solver};
use crate::platform::Instant;
use crate::platform::window::Parent;
use crate::scene::{Kind, Scene, Value};
use eframe::egui;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

/// Changes the state: by commands, by the results of background work, and over time.
#[derive(Debug)]
pub struct Updater {
    /// All that the window knows.
    pub state: State,
    /// The clock, the file dialogs and the effort of measurements.
    pub platform: Platform,
    pub(super) ctx: egui::Context,
    pub(super) solver: Solver,
    pub(super) dialogs: Dialogs,
    pub(super) pictures: (Sender<Arc<egui::ColorImage>>, Receiver<Arc<egui::ColorImage>>),
    /// Pictures of the window that are being written.
    pub(super) writing: Vec<TaskOf<Files>>,
}

impl Updater {
    /// Starts with `state`, and starts to solve its scene. `parent` is the window over which file dialogs are shown.
    pub fn start(ctx: &egui::Context, state: State, platform: Platform, parent: Parent) -> std::io::Result<Self> {
        let wake = ctx.clone();
        let solver = Solver::start(platform.now, move || wake.request_repaint())?;
        let dialogs = Dialogs::new(platform.ask, parent);
        let (ctx, pictures) = (ctx.clone(), channel());
        let mut updater = Self { state, platform, ctx, solver, dialogs, pictures, writing: Vec::new() };
        updater.apply_theme();
        // The zoom that the last window was left with already includes that of the lecture size.
        if updater.state.lecture && updater.ctx.zoom_factor() == 1.0 {
            updater.ctx.set_zoom_factor(LECTURE_ZOOM);
        }
        updater.refine();
        Ok(updater)
    }

    /// The present moment.
    pub fn now(&self) -> Instant {
        (self.platform.now)()
    }

    /// Starts `work`. The window is redrawn at most once in each interval `every`, and at once when the work ends. If it cannot be started,
    /// a message that begins with `failed` is shown.
    pub(super) fn start_work<W: Work>(&mut self, failed: &str, work: W, every: Duration) -> Option<TaskOf<W>> {
        let ctx = self.ctx.clone();
        let wake = move |ended: bool| if ended { ctx.request_repaint() } else { ctx.request_repaint_after(every) };
        BackgroundTask::of(work, wake).map_err(|error| self.state.fail(format!("{failed}: {error}"))).ok()
    }

    /// Shows an error about a file, whose path is suggested in the next prompt.
    pub(super) fn fail_at(&mut self, purpose: Purpose, path: &Path, error: impl ToString) {
        self.state.failed_path = Some((purpose, path.display().to_string()));
        self.state.fail(error);
    }

    /// The scene, with a title for its changes, and its problem; `None`, with an error message, if it is refused.
    pub(super) fn posed(&mut self) -> Option<Posed> {
        Posed::try_from(self.state.document.titled()).map_err(|error| self.state.fail(error)).ok()
    }

    /// Requests solves of the present scene, at draft first, then up to the wanted fidelity, within the time limit.
    pub(super) fn refine(&mut self) {
        let (target, budget) = (self.state.document.target(), self.state.budget);
        let mut fidelities = target.and_coarser();
        if budget.is_some() {
            // The solve at the last fidelity begins with coarse grids itself.
            fidelities.drain(1..fidelities.len().max(2) - 1);
        }
        self.solve(fidelities, budget);
    }

    /// Requests solves of the present scene at these fidelities, each within the time limit.
    pub(super) fn solve(&mut self, fidelities: Vec<Fidelity>, budget: Option<Duration>) {
        let State { document, problem, activity, .. } = &mut self.state;
        let posed = Posed::try_from(document.scene().clone());
        *problem = posed.as_ref().ok().map(|posed| posed.problem.clone());
        match posed {
            Ok(posed) => {
                activity.number = self.solver.submit(Request { posed, fidelities, budget });
                activity.failure = None;
            }
            Err(error) => activity.failure = Some(error.to_string()),
        }
    }

    /// Follows a change of the whole scene: clears messages about edits, leaves a tab that the new scene does not have, and solves the
    /// scene.
    pub(super) fn scene_replaced(&mut self) {
        if !self.state.view.tab.is_listed(self.state.document.scene().kind() == Kind::Plate) {
            self.state.view.tab = Tab::Motion;
        }
        self.state.rejected.clear();
        self.state.switches.edited();
        self.refine();
    }

    /// Replaces the scene, as one edit.
    pub(super) fn change_scene(&mut self, next: Scene) {
        let document = &mut self.state.document;
        if document.change(next, document.target()) {
            self.scene_replaced();
        }
    }

    /// Sets these values in the scene, by key, as one edit; shows an error if they are refused.
    pub(super) fn take_values<'k>(&mut self, values: impl IntoIterator<Item = (&'k str, f64)>) {
        let mut next = self.state.document.scene().clone();
        let set = values.into_iter().try_for_each(|(key, value)| next.set_value(key, Value::Number(value)));
        match set.and_then(|()| next.check()) {
            Ok(()) => self.change_scene(next),
            Err(error) => self.state.fail(error),
        }
    }

    /// Asks for a file or a folder, with a suggested name.
    pub(super) fn ask(&mut self, purpose: Purpose) {
        let wake = self.ctx.clone();
        let name = self.state.suggested_path(&purpose);
        let name = Path::new(&name).file_name().unwrap_or_default().to_string_lossy();
        if let Err(error) = self.dialogs.show(purpose, &name, move || wake.request_repaint()) {
            self.state.fail(format!("The file dialog cannot be shown: {error}"));
        }
    }

    pub(super) fn apply_theme(&self) {
        self.ctx.set_theme(if self.state.dark { egui::Theme::Dark } else { egui::Theme::Light });
    }
}

/// Least interval between redraws for progress.
pub(super) const REDRAW: Duration = Duration::from_millis(100);

/// Zoom of the lecture size, relative to the user's own.
pub(super) const LECTURE_ZOOM: f32 = 1.35;
