//! Computations that run while their tab is shown: a start-up, a held plate, torque over speed, and the rotor.

use super::updater::Updater;
use crate::fidelity::Fidelity;
use crate::gui::command::{HoldCommand, StartupCommand};
use crate::gui::state::hold::{FIRST_SECONDS, HoldState};
use crate::gui::state::startup::StartupState;
use crate::gui::state::transient::Dropped;
use crate::gui::state::view::Tab;
use crate::gui::state::window::State;
use crate::job::hold::{HeldPlate, slowed};
use crate::job::single::{RotorWork, TorqueWork};
use crate::job::transient::{DropWork, StartupWork};
use crate::job::work::Posed;
use crate::problem::Scenario;
use crate::startup;
use std::sync::Arc;
use std::time::Duration;

impl Updater {
    /// Advances animations by `elapsed` \[s\]. Returns whether anything moves.
    pub fn animate(&mut self, elapsed: f64) -> bool {
        let state = &mut self.state;
        if let Some(hold) = state.held() {
            return hold.animate(elapsed);
        }
        if !state.view.playing || state.on_timeline().is_none() {
            return false;
        }
        let on = state.view.phase + elapsed / state.view.seconds_per_cycle;
        state.view.phase = on.rem_euclid(1.0);
        state.view.cycles += on.div_euclid(1.0);
        if let (Tab::Startup, Some(startup), true) = (state.view.tab, &mut state.startup, on >= 1.0) {
            startup.next_cycle();
        }
        true
    }

    /// Computes torque over speed while its tab is shown.
    pub fn follow_torque(&mut self) {
        let (Tab::Torque, Some(run)) = (self.state.view.tab, self.state.run.clone()) else { return };
        if self.state.torque.lacks(&run) {
            let task = self.start_work("Torque cannot be computed", TorqueWork(Arc::clone(&run)), Duration::ZERO);
            self.state.torque.follow(run, task);
        }
    }

    /// Computes the rotor of the present scene while its tab is shown.
    pub fn follow_rotor(&mut self) {
        let Tab::Rotor = self.state.view.tab else { return };
        let Some(problem) = &self.state.problem else { return };
        let Scenario::Motor(motor) = &problem.scenario else { return };
        if self.state.rotor.lacks(motor) {
            let of = (motor.rotor.clone(), motor.wave());
            let posed = Posed { scene: self.state.document.scene().clone(), problem: problem.clone() };
            let task = self.start_work("The rotor cannot be computed", RotorWork(posed), Duration::ZERO);
            self.state.rotor.follow(of, task);
        }
    }

    /// Takes snapshots of the held plate; starts with another plate if the scene has changed.
    pub(super) fn update_hold(&mut self) {
        let state = &mut self.state;
        let scene = state.document.scene();
        // A plate that floats has its mean gap from the run, and waits for it.
        let run = state.run.as_ref().filter(|run| run.scene.same_model(scene));
        let problem = run.map(|run| &run.problem).or(state.problem.as_ref());
        let known = run.is_some() || !scene.floats() || !state.awaits_result();
        let plate = match problem.map(|problem| &problem.scenario) {
            // Without a run the mean gap is a guess above the true one. If even the guess is below the gap at which the plate rests, it
            // does not float.
            Some(Scenario::Plate(plate)) if known && scene.floats() && plate.mean_gap < plate.resting().mean_gap => {
                Some(plate.resting())
            }
            Some(Scenario::Plate(plate)) if known => Some(plate.clone()),
            _ => None,
        };
        // A run on finer grids gives a better mean gap; it is used unless the plate has been moved since.
        let known_better =
            |hold: &HoldState| plate.as_ref().is_some_and(|plate| *plate != hold.plate) && hold.is_untouched();
        if state.hold.as_ref().is_some_and(|hold| hold.stale(scene) || known_better(hold)) {
            state.hold = None;
        }
        if state.view.tab == Tab::Hold
            && state.hold.is_none()
            && let Some(plate) = plate
        {
            let wake = self.ctx.clone();
            let slow = slowed(&plate, FIRST_SECONDS);
            match HeldPlate::start(plate.clone(), slow, self.platform.now, move || wake.request_repaint()) {
                Ok(job) => state.hold = Some(HoldState::new(job, scene.clone(), plate)),
                Err(error) => {
                    state.view.tab = Tab::Motion;
                    state.fail(format!("The plate cannot be held: {error}"));
                }
            }
        }
        if let Some(hold) = &mut state.hold {
            hold.drain();
        }
    }

    pub(super) fn hold(&mut self, command: HoldCommand) {
        let Some(hold) = &mut self.state.hold else { return };
        let mean_gap = hold.plate.mean_gap;
        match command {
            HoldCommand::To(gap) => hold.move_to(gap),
            HoldCommand::By(share) => hold.move_to(hold.target + share * mean_gap),
            HoldCommand::LetGo { vibrates } => hold.let_go(vibrates),
            HoldCommand::Reset => hold.reset(),
            HoldCommand::Replay => hold.replay(),
            HoldCommand::Seconds(seconds) => hold.set_seconds(seconds),
        }
    }

    pub(super) fn start_up(&mut self, command: StartupCommand) {
        let State { startup, view, .. } = &mut self.state;
        match (command, startup) {
            (StartupCommand::Start, _) => self.start_from_rest(),
            (StartupCommand::Choose(number), Some(startup)) => startup.stay_at(number),
            (StartupCommand::Follow(follow), Some(startup)) => startup.follow(follow),
            (StartupCommand::Replay, Some(startup)) => {
                startup.stay_at(1);
                (view.phase, view.playing) = (0.0, true);
            }
            (_, None) => {}
        }
    }

    pub(super) fn start_from_rest(&mut self) {
        let Some(posed) = self.posed() else { return };
        // Every tooth is solved on three grids; a finer fidelity would take minutes.
        let fidelity = self.state.document.target().min(Fidelity::Standard);
        if posed.scene.floats() {
            let work = DropWork(posed.clone(), fidelity);
            if let Some(task) = self.start_work("The plate cannot be dropped", work, Duration::ZERO) {
                self.state.dropped = Some(Dropped::new(task, posed, fidelity));
            }
            return;
        }
        let settings = startup::Settings { fidelity, ..startup::Settings::default() };
        // Only one start-up runs at a time: the previous one is ended first.
        let count = self.state.startup.take().map_or(0, |last| last.count + 1);
        let work = StartupWork(posed.clone(), settings);
        if let Some(task) = self.start_work("The start-up cannot be started", work, Duration::ZERO) {
            self.state.startup = Some(StartupState::new(task, posed, fidelity, count));
        }
    }
}
