//! What is asked of the sweep, carried out.

use super::updater::{REDRAW, Updater};
use crate::gui::command::SweepCommand;
use crate::job::sweep::{Points, SweepTask};
use crate::job::task::Task;
use crate::solve::Settings;
use std::sync::Arc;

impl Updater {
    pub(super) fn sweep(&mut self, command: SweepCommand) {
        match command {
            SweepCommand::Start => self.start_sweep(),
            SweepCommand::Cancel => self.state.sweep.cancel(),
            SweepCommand::Continue => {
                if let Some(swept) = self.state.sweep.swept().filter(|swept| !swept.running) {
                    let points = Points::Known(Arc::clone(&swept.sweep), swept.rows.to_vec());
                    self.begin_sweep(Task::of(points, self.wake(REDRAW)), true);
                }
            }
            SweepCommand::Open(point) => {
                // Every point is a scene: the sweep has made them all.
                let scene = self.state.sweep.swept().and_then(|swept| swept.sweep.scene_at(point).ok());
                if let Some(mut scene) = scene {
                    // A sweep says in its name what was changed; the present scene keeps its own.
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
        let fidelity = self.state.sweep.form().map(|form| form.fidelity).unwrap_or_default();
        // What is wrong with an axis is said at the axis.
        let Ok(vary) = self.state.sweep.asked(scene) else { return };
        let mut swept = scene.clone();
        swept.retitle(self.state.document.saved());
        let settings = Settings { fidelity, ..Settings::default() };
        let task = Task::of(Points::New(swept, vary, settings), self.wake(REDRAW));
        self.begin_sweep(task, false);
    }

    fn begin_sweep(&mut self, task: std::io::Result<SweepTask>, goes_on: bool) {
        match task {
            Ok(task) => self.state.sweep.begin(task, goes_on, self.now()),
            Err(error) => self.state.fail(format!("The sweep cannot be started: {error}")),
        }
    }
}
