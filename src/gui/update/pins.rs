//! Carries out the commands for the pins.

use super::updater::Updater;
use crate::analysis::compare::ComparedRun;
use crate::gui::command::PinCommand;
use crate::gui::state::pins::told_apart;
use crate::job::single::PinWork;
use crate::scene::presets;
use std::time::Duration;

impl Updater {
    pub(super) fn pin(&mut self, command: PinCommand) {
        match command {
            PinCommand::Shown => {
                if let Some(mut run) = self.shown() {
                    let mut named = run.scene.clone();
                    named.retitle(self.state.document.saved());
                    // The pin may be named by the keys that distinguish it from others, but must not keep a description that is no longer
                    // true.
                    let told_apart = told_apart(&run.scene, self.state.document.saved());
                    let label = told_apart.filter(|_| named.name != run.scene.name).unwrap_or(named.name);
                    run.scene.about = named.about;
                    self.state.pins.add(ComparedRun::new(label, run.scene, run.problem, Ok(run.solution)));
                }
            }
            PinCommand::Preset(name) => self.pin_preset(name),
            PinCommand::Rename(id, name) => self.state.pins.rename(id, &name),
            PinCommand::Remove(id) => self.state.pins.remove(id),
            PinCommand::Clear => self.state.pins.clear(),
            PinCommand::Restore => self.state.pins.bring_back(),
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
        let work = PinWork(scene.clone(), fidelity);
        if let Some(task) = self.start_work("The preset cannot be solved", work, Duration::ZERO) {
            self.state.pins.wait(scene, fidelity, task);
        }
    }

    /// Solves the pins of the last window again, one after the other, after the scene on screen.
    pub(super) fn solve_pins(&mut self) {
        if self.state.awaits_result() || self.state.activity.running.is_some() {
            return;
        }
        let Some((id, scene, fidelity)) = self.state.pins.turn() else { return };
        let work = PinWork(scene.clone(), fidelity);
        match self.start_work("A pinned run cannot be solved again", work, Duration::ZERO) {
            Some(task) => self.state.pins.begin(id, task),
            None => self.state.pins.remove(id),
        }
    }
}
