//! What is asked of the pins, carried out.

use super::App;
use crate::analysis::compare::Run;
use crate::analysis::compare::runs;
use crate::fidelity::Fidelity;
use crate::gui::modal::Modal;
use crate::gui::pinned::{Pinning, Pins, of_window};
use crate::job::task::Task;
use crate::scene::{Scene, presets};
use crate::solve::Settings;
use eframe::egui;

impl App {
    /// The pinned runs.
    pub fn pins(&self) -> &Pins {
        &self.pins
    }

    pub(super) fn pin(&mut self, ctx: &egui::Context, asked: Pinning) {
        match asked {
            Pinning::Shown => {
                if let Some(run) = &self.shown {
                    let label = run.scene.title(self.document.saved());
                    self.pins.add(Run { label, ..of_window(run) });
                }
            }
            Pinning::Preset(name) => self.pin_preset(ctx, name),
            Pinning::Forget(id) => self.pins.forget(id),
            Pinning::Rename(id, name) => self.pins.rename(id, &name),
            Pinning::Remove(id) => self.pins.remove(id),
            Pinning::Clear => self.pins.clear(),
            Pinning::Open(id) => {
                if let Some(scene) = self.pins.run(id).map(|run| run.scene.clone()) {
                    self.change_scene(scene);
                }
            }
            Pinning::Look(page) => self.pins.page = page,
            Pinning::AllParameters(all) => self.pins.all_parameters = all,
        }
    }

    fn pin_preset(&mut self, ctx: &egui::Context, name: &'static str) {
        let scene = match presets::find(name) {
            Ok(scene) => scene,
            Err(error) => {
                self.modal = Some(Modal::Error(error.to_string()));
                return;
            }
        };
        let fidelity = self.document.aim();
        match solve(ctx, &scene, fidelity) {
            Ok(task) => self.pins.wait(scene, fidelity, task),
            Err(error) => self.modal = Some(Modal::Error(format!("The preset cannot be solved: {error}"))),
        }
    }

    /// Solves again what was pinned in the last window: one after the other, and not before the scene on screen.
    pub(super) fn solve_pins(&mut self, ctx: &egui::Context) {
        let waits = self.shown.as_ref().is_none_or(|run| self.activity.stale(run)) && self.activity.failure.is_none();
        if waits || self.activity.running.is_some() {
            return;
        }
        let Some((id, scene, fidelity)) = self.pins.turn() else { return };
        match solve(ctx, scene, fidelity) {
            Ok(task) => self.pins.begin(id, task),
            Err(error) => {
                self.pins.forget(id);
                self.modal = Some(Modal::Error(format!("A pinned run cannot be solved again: {error}")));
            }
        }
    }

    /// Another scene, as one edit.
    pub(super) fn change_scene(&mut self, next: Scene) {
        if self.document.change(next, self.document.aim()) {
            self.comparison.edited();
            self.refusals.clear();
            self.refine();
        }
    }
}

/// Solves a scene to be pinned, in the background.
fn solve(ctx: &egui::Context, scene: &Scene, fidelity: Fidelity) -> std::io::Result<Task<Run>> {
    let settings = Settings { fidelity, ..Settings::default() };
    let (wake, scene) = (ctx.clone(), scene.clone());
    Task::start(
        "pin",
        move |_| wake.request_repaint(),
        move |cancel, tell| {
            // Every scene is solved by this method, and a run that was cancelled has nobody who waits for it.
            if let Ok(solved) = runs(&[scene], &settings, cancel, &|_| ())
                && !cancel.is_cancelled()
            {
                solved.into_iter().for_each(tell);
            }
        },
    )
}
