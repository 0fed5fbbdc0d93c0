//! What is computed while one looks: a start-up, and a plate in the hand.

use super::App;
use crate::fidelity::Fidelity;
use crate::gui::holding::Holding;
use crate::gui::modal::Modal;
use crate::gui::starting::{Ask, Starting};
use crate::gui::state::Tab;
use crate::job::startup::Transient;
use crate::problem::Problem;
use crate::startup;
use eframe::egui;

impl App {
    /// Moves the animation on by `elapsed` \[s\].
    pub(super) fn animate(&mut self, elapsed: f64) {
        let on = self.view.phase + elapsed / self.view.seconds_per_cycle;
        self.view.phase = on.rem_euclid(1.0);
        if let (Tab::Startup, Some(starting), true) = (self.view.tab, &mut self.starting, on >= 1.0) {
            starting.next_cycle();
        }
    }

    /// Takes what the held plate did, and takes another one in hand if the scene is another.
    pub(super) fn hold(&mut self, ctx: &egui::Context) {
        let scene = self.document.scene();
        if self.holding.as_ref().is_some_and(|holding| holding.stale(scene)) {
            self.holding = None;
        }
        if let (Tab::Hold, None, Ok(problem)) = (self.view.tab, &self.holding, Problem::new(scene)) {
            let wake = ctx.clone();
            match Holding::start(scene, &problem, self.world.now, move || wake.request_repaint()) {
                Ok(holding) => self.holding = holding,
                Err(error) => {
                    self.view.tab = Tab::Motion;
                    self.modal = Some(Modal::Error(format!("The plate cannot be held: {error}")));
                }
            }
        }
        if let Some(holding) = &mut self.holding {
            holding.drain();
        }
    }

    pub(super) fn start_up(&mut self, ctx: &egui::Context, ask: Ask) {
        if ask == Ask::Start {
            self.start_from_rest(ctx);
        }
        let Some(starting) = &mut self.starting else { return };
        match ask {
            Ask::Start => {}
            Ask::Cancel => starting.cancel(),
            Ask::Choose(number) => starting.stay_at(number),
            Ask::Follow(follow) => starting.follow(follow),
            Ask::Replay => {
                starting.stay_at(1);
                self.view.phase = 0.0;
                self.view.playing = true;
            }
        }
    }

    pub(super) fn start_from_rest(&mut self, ctx: &egui::Context) {
        let scene = self.document.scene().clone();
        let problem = match Problem::new(&scene) {
            Ok(problem) => problem,
            Err(error) => {
                self.modal = Some(Modal::Error(error.to_string()));
                return;
            }
        };
        // Three grids of every tooth: a finer one takes minutes.
        let fidelity = self.document.aim().min(Fidelity::Standard);
        let settings = startup::Settings { fidelity, ..startup::Settings::default() };
        let wake = ctx.clone();
        // One at a time: the last one is ended first.
        let count = self.starting.take().map_or(0, |last| last.count() + 1);
        match Transient::start(problem.clone(), settings, move || wake.request_repaint()) {
            Ok(job) => self.starting = Some(Starting::new(job, scene, problem, fidelity, count)),
            Err(error) => self.modal = Some(Modal::Error(format!("The start-up cannot be started: {error}"))),
        }
    }
}
