//! Carries out the commands for measurements, measured faces, and fits.

use super::updater::{REDRAW, Updater};
use crate::analysis::fit::{LARGEST_TABLE, Measured};
use crate::gui::command::FitCommand;
use crate::gui::state::dialogs::Purpose;
use crate::gui::state::view::Tab;
use crate::input::{ReadError, read_text};
use crate::job::fit::FitWork;
use crate::job::single::FaceWork;
use crate::scene::Kind;
use crate::solve::{Method, Settings};
use crate::surface::height_map::begins_as_heights;
use std::path::PathBuf;
use std::time::Duration;

impl Updater {
    pub(super) fn fit(&mut self, command: FitCommand) {
        let state = &mut self.state;
        match command {
            FitCommand::Forget => state.fit.measured = None,
            FitCommand::Form(form) => state.fit.ask(form),
            FitCommand::Start => self.start_fit(),
            FitCommand::Take => {
                let Some((_, found)) = state.fit.found.as_ref() else { return };
                let values = found.values();
                self.take_values(values);
            }
        }
    }

    /// Reads a table of measurements, or a measured face, as `purpose` asks. In the torque tab, measured torques are drawn over the curve;
    /// otherwise the fit tab is shown.
    pub(super) fn load_measurements(&mut self, purpose: Purpose, path: PathBuf) {
        // The limit is lower than that for heights: no table of measurements is that large.
        let heights = match read_text(&path, LARGEST_TABLE) {
            Ok(text) => begins_as_heights(&text),
            Err(error) => matches!(error, ReadError::TooLarge(_)),
        };
        if heights {
            return self.load_face(purpose, path);
        }
        let state = &mut self.state;
        match Measured::find(&path.to_string_lossy(), state.document.scene(), Method::Auto) {
            Ok(measured) => {
                let opened = state.opened();
                state.fit.load(measured, opened);
                let (torques, others) = state.torques();
                if state.view.tab != Tab::Torque || torques.is_empty() && others == 0 {
                    state.view.tab = Tab::Fit;
                }
            }
            Err(error) => self.fail_at(purpose, &path, error),
        }
    }

    /// Reads a measured face, as `purpose` asks.
    pub(super) fn load_face(&mut self, purpose: Purpose, path: PathBuf) {
        if self.state.document.scene().kind() == Kind::Plate {
            let text = "These are measured heights, and only a motor has rough faces: open a motor first.";
            return self.state.fail(text);
        }
        self.state.view.tab = Tab::Rotor;
        let work = FaceWork::new(path.clone());
        if let Some(task) = self.start_work("The heights cannot be read", work, Duration::ZERO) {
            self.state.face.begin(purpose, path, task);
        }
    }

    /// Sets the roughness of the scene to that of two faces like this one; only the keys that the scene has are set.
    pub(super) fn take_roughness(&mut self) {
        let Some(face) = self.state.face.found.as_ref() else { return };
        let values = face.roughness(self.state.document.scene());
        self.take_values(values);
    }

    fn start_fit(&mut self) {
        if self.state.fit.work.running() {
            return;
        }
        let scene = self.state.document.titled();
        // An error about a key is shown at the key.
        let state = &self.state.fit;
        let (Ok(bounds), Ok(goal)) = (state.asked(&scene), state.goal(&scene)) else { return };
        let measured = state.measured.clone();
        if measured.is_none() && goal.is_none() {
            return;
        }
        let settings = Settings { fidelity: self.state.document.target(), ..Settings::default() };
        let asked = scene.clone();
        let work = FitWork { scene, measured, bounds, goal, settings };
        if let Some(task) = self.start_work("The fit cannot be started", work, REDRAW) {
            self.state.fit.begin(asked, task);
        }
    }
}
