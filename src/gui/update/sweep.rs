//! Carries out the commands of the sweep.

use super::updater::{REDRAW, Updater};
use crate::gui::command::SweepCommand;
use crate::job::sweep::SweepWork;
use crate::solve::Settings;
use std::sync::Arc;

impl Updater {
    pub(super) fn sweep(&mut self, command: SweepCommand) {
        match command {
            SweepCommand::Start => self.start_sweep(),
            SweepCommand::Continue => {
                if let Some(swept) = self.state.sweep.swept.as_ref().filter(|swept| !swept.running) {
                    self.begin_sweep(SweepWork::Known(Arc::clone(&swept.sweep), swept.rows.to_vec()));
                }
            }
            SweepCommand::Open(point) => {
                // The sweep has built the scenes of all its points, so each of them is valid.
                let scene = self.state.sweep.swept.as_ref().and_then(|swept| swept.sweep.scene_at(point).ok());
                if let Some(mut scene) = scene {
                    // The scene of a point has the changes in its name; the present scene keeps its own name.
                    let present = self.state.document.scene();
                    (scene.name, scene.about) = (present.name.clone(), present.about.clone());
                    self.change_scene(scene);
                }
            }
            SweepCommand::Draw(quantity) => self.state.sweep.draw(quantity),
            SweepCommand::Form(form) => self.state.sweep.ask(form),
        }
    }

    fn start_sweep(&mut self) {
        let scene = self.state.document.scene();
        let fidelity = self.state.sweep.form.as_ref().map(|form| form.fidelity).unwrap_or_default();
        // An error about an axis is shown at the axis.
        let Ok(vary) = self.state.sweep.asked(scene) else { return };
        let settings = Settings { fidelity, ..Settings::default() };
        self.begin_sweep(SweepWork::New(self.state.document.titled(), vary, settings));
    }

    fn begin_sweep(&mut self, points: SweepWork) {
        let goes_on = matches!(points, SweepWork::Known(..));
        if let Some(task) = self.start_work("The sweep cannot be started", points, REDRAW) {
            self.state.sweep.begin(task, goes_on, self.now());
        }
    }
}
