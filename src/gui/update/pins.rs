//! What is asked of the pins, carried out.

use super::updater::Updater;
use crate::fidelity::Fidelity;
use crate::gui::command::PinCommand;
use crate::gui::state::pins::to_compare;
use crate::job::pin::{Compared, PinTask};
use crate::job::task::Task;
use crate::scene::{Scene, presets};
use std::time::Duration;

impl Updater {
    pub(super) fn pin(&mut self, command: PinCommand) {
        match command {
            PinCommand::Shown => {
                if let Some(run) = &self.state.run {
                    let mut run = to_compare(run);
                    let mut named = run.scene.clone();
                    named.retitle(self.state.document.saved());
                    // It may be called by what tells it from the others, but not described as what it is no longer.
                    (run.label, run.scene.about) = (named.name, named.about);
                    self.state.pins.add(run);
                }
            }
            PinCommand::Preset(name) => self.pin_preset(name),
            PinCommand::Forget(id) => self.state.pins.forget(id),
            PinCommand::Rename(id, name) => self.state.pins.rename(id, &name),
            PinCommand::Remove(id) => self.state.pins.remove(id),
            PinCommand::Clear => self.state.pins.clear(),
            PinCommand::Restore => self.state.pins.restore_cleared(),
            PinCommand::Open(id) => {
                if let Some(scene) = self.state.pins.run(id).map(|run| run.scene.clone()) {
                    self.change_scene(scene);
                }
            }
            PinCommand::Look(page) => self.state.pins.page = page,
            PinCommand::AllParameters(all) => self.state.pins.all_parameters = all,
        }
    }

    fn pin_preset(&mut self, name: &'static str) {
        let scene = match presets::find(name) {
            Ok(scene) => scene,
            Err(error) => return self.state.fail(error),
        };
        let fidelity = self.state.document.target();
        match self.solve_pin(scene.clone(), fidelity) {
            Ok(task) => self.state.pins.wait(scene, fidelity, task),
            Err(error) => self.state.fail(format!("The preset cannot be solved: {error}")),
        }
    }

    /// Solves again what was pinned in the last window: one after the other, and not before the scene on screen.
    pub(super) fn solve_pins(&mut self) {
        if self.state.awaits_result() || self.state.activity.running.is_some() {
            return;
        }
        let Some((id, scene, fidelity)) = self.state.pins.turn() else { return };
        match self.solve_pin(scene.clone(), fidelity) {
            Ok(task) => self.state.pins.begin(id, task),
            Err(error) => {
                self.state.pins.forget(id);
                self.state.fail(format!("A pinned run cannot be solved again: {error}"));
            }
        }
    }

    /// Solves a scene to be pinned, in the background.
    fn solve_pin(&self, scene: Scene, fidelity: Fidelity) -> std::io::Result<PinTask> {
        Task::of(Compared { scene, fidelity }, self.wake(Duration::ZERO))
    }
}
