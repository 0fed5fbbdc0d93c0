//! The functions that carry out every command, and that take all results of background work.

use super::updater::{LECTURE_ZOOM, Updater};
use crate::analysis::tradeoff::Target;
use crate::citation;
use crate::fall::Fall;
use crate::gui::command::Command;
use crate::gui::state::activity::Running;
use crate::gui::state::background::Background;
use crate::gui::state::dialogs::{Answer, Purpose};
use crate::gui::state::document::{Document, Next};
use crate::gui::state::edits::Change;
use crate::gui::state::modal::{Modal, PathPrompt};
use crate::gui::state::view::Tab;
use crate::job::Event;
use crate::job::single::NewMotorWork;
use crate::scene::Parameter;
use std::path::PathBuf;
use std::time::Duration;

impl Updater {
    /// Carries out `command`.
    pub fn carry_out(&mut self, command: Command) {
        let state = &mut self.state;
        match command {
            Command::Set { key, value, dragging } => self.edit(key, dragging, Change::Value(value)),
            Command::SetText(key, text) => self.edit(key, false, Change::Text(text)),
            Command::Reset(key) => self.reset(key),
            Command::Use(target, numerics) => self.use_setting(target, numerics),
            Command::CopyLink => self.copy_link(),
            Command::About => state.modal = Some(Modal::About),
            Command::CopyCitation => self.ctx.copy_text(citation::bibtex()),
            Command::Undo => self.step_history(Document::undo),
            Command::Redo => self.step_history(Document::redo),
            Command::Proceed(next) => self.proceed(next),
            Command::NewMotor => state.modal = Some(Modal::NewMotor(state.new_motor.clone())),
            Command::MakeNewMotor(answers) => {
                state.new_motor = answers.clone();
                let task = self.start_work("The motor cannot be made", NewMotorWork(answers), Duration::ZERO);
                self.state.making = task.map(Background::from).unwrap_or_default();
            }
            Command::AnswerNewMotor(question, answer) => {
                if let Some(Modal::NewMotor(answers)) = &mut state.modal {
                    answers.insert(question.to_owned(), answer);
                }
            }
            Command::Ask(purpose) => self.ask(purpose),
            Command::Chosen(purpose, path) => self.chosen(purpose, path),
            Command::Typed(purpose, path) => self.typed(purpose, path),
            Command::OpenPathPrompt => self.prompt(vec![Purpose::Open, Purpose::Save(None)]),
            Command::Save(then) => self.save(then),
            Command::Replace(then) => self.replace(then),
            Command::QuitAnyway => self.proceed_with_document(Next::Quit),
            Command::DiscardThen(next) => self.discard_then(next),
            Command::CloseModal => state.modal = state.covered.take(),
            Command::TypePath(path) => {
                if let Some(Modal::Path(prompt)) = &mut state.modal {
                    let refused = prompt.refused.take().filter(|_| path == prompt.path);
                    (prompt.path, prompt.fresh, prompt.refused) = (path, false, refused);
                }
            }
            Command::Refine(fidelity) => self.solve(vec![fidelity], None),
            Command::Budget(budget) => {
                state.budget = budget;
                self.refine();
            }
            Command::CancelSolve => {
                self.solver.cancel();
                if state.activity.running.take().is_none() {
                    state.cancel_tab();
                }
            }
            Command::CancelTab => state.cancel_tab(),
            Command::Show(tab) => state.view.tab = tab,
            Command::Pin(command) => self.pin(command),
            Command::Sweep(command) => self.sweep(command),
            Command::Fit(command) => self.fit(command),
            Command::ForgetFace => state.face.found = None,
            Command::TakeRoughness => self.take_roughness(),
            Command::Hold(command) => self.hold(command),
            Command::Startup(command) => self.start_up(command),
            Command::Sensitivity(command) => self.sensitivity(command),
            Command::Lesson(command) => self.teach(command),
            Command::Measure => self.measure(),
            Command::Target(Target::Accuracy(share)) => state.view.accuracy = share,
            Command::Target(Target::Budget(seconds)) => state.view.budget = seconds,
            Command::CancelExport => state.exports.running.iter_mut().for_each(|running| running.work.cancel()),
            Command::CloseExportNote => state.exports.written = None,
            Command::TogglePlay => match state.held() {
                Some(hold) => hold.toggle_play(),
                None => state.view.playing = !state.view.playing,
            },
            Command::StepFrames(by) => {
                if let Some(hold) = state.held() {
                    hold.step(by);
                } else if let Some(phase) = state.on_timeline().map(|recording| state.view.stepped(recording, by)) {
                    state.view.playing = false;
                    state.view.phase = phase;
                }
            }
            Command::Hover(x) => state.view.cursor_x = x,
            Command::Seek(share) => match state.held() {
                Some(hold) => hold.seek(share),
                None => (state.view.playing, state.view.phase) = (false, share.rem_euclid(1.0)),
            },
            Command::SecondsPerCycle(seconds) => state.view.seconds_per_cycle = seconds,
            Command::FollowTooth(tooth) => state.view.tooth = tooth,
            Command::NextTooth(by) => {
                if let Some(teeth) = state.on_timeline().map(|recording| recording.teeth.max(1) as i64) {
                    state.view.tooth = (state.view.tooth as i64 + by).rem_euclid(teeth) as usize;
                }
            }
            Command::Orbit(orbit) => state.view.orbit = orbit,
            Command::ToggleTheme => {
                state.dark = !state.dark;
                self.apply_theme();
            }
            Command::ToggleLecture => {
                state.lecture = !state.lecture;
                // The user's own zoom is kept.
                let zoom = if state.lecture { LECTURE_ZOOM } else { LECTURE_ZOOM.recip() };
                self.ctx.set_zoom_factor(self.ctx.zoom_factor() * zoom);
            }
            Command::Screenshot => self.take_picture(),
            Command::ToggleParameters => state.view.parameters = !state.view.parameters,
            Command::ToggleResults => state.view.results = !state.view.results,
            // It must not be hidden by a dialog.
            Command::ToggleShortcuts => state.shortcuts = !state.shortcuts && state.modal.is_none(),
            Command::Tour(stop) => state.lessons.show_tour(stop, &mut state.view),
            Command::Glossary(shown) => state.lessons.glossary = shown.then(String::new),
            Command::SearchGlossary(query) => state.lessons.glossary = Some(query),
        }
    }

    /// Takes the messages and results of background work and the answers of dialogs.
    pub fn drain(&mut self) {
        let mut solved = false;
        let state = &mut self.state;
        for event in self.solver.drain() {
            match event {
                Event::Progress { number, fidelity, progress } if number == state.activity.number => {
                    state.activity.running = Some(Running { fidelity, round: progress });
                }
                // A result for an edit that is no longer the present one is still newer than the result on screen.
                Event::Solved(run) if state.run.as_ref().is_none_or(|shown| run.number >= shown.number) => {
                    if run.scene == *state.document.scene() {
                        state.switches.solved(&run);
                    }
                    state.view.tooth = state.view.tooth.min(run.solution.recording.teeth.saturating_sub(1));
                    state.run = Some(run);
                    solved = true;
                }
                Event::Failed { number, message } if number == state.activity.number => {
                    state.activity.failure = Some(message);
                }
                Event::Done { number } if number == state.activity.number => state.activity.running = None,
                _ => {}
            }
        }
        if solved {
            self.tell_page();
        }
        let now = self.now();
        let state = &mut self.state;
        state.tradeoff.iter_mut().for_each(|measured| measured.drain());
        if let Some(error) = state.exports.drain(now) {
            state.fail(error);
        }
        if let Some((purpose, path, error)) = state.face.drain() {
            self.fail_at(purpose, &path, error);
        }
        self.state.pins.drain();
        self.solve_pins();
        let state = &mut self.state;
        state.sweep.drain();
        if state.view.tab == Tab::Sweep {
            state.sweep.review(state.document.scene());
        }
        state.fit.drain();
        if state.view.tab == Tab::Fit {
            state.fit.review(state.document.scene());
        }
        state.torque.drain();
        state.rotor.drain();
        state.sensitivity.drain();
        let scene = state.document.scene();
        state.startup.iter_mut().for_each(|startup| startup.drain(scene));
        if let Some(dropped) = &mut state.dropped {
            let cycles = dropped.news(scene, Fall::cancelled);
            dropped.cycles.extend(cycles);
        }
        self.dialogs.drain().into_iter().for_each(|(purpose, answer)| self.answered(purpose, answer));
        match self.state.made() {
            Some(Ok(scene)) => self.proceed(Next::Given(Box::new(Document::made(scene)))),
            Some(Err(why)) => self.state.fail(why),
            None => {}
        }
        self.receive_pictures();
        self.update_hold();
    }

    /// Uses the chosen file or folder. A CSV file that is opened is a table of measurements, or a measured face.
    fn chosen(&mut self, purpose: Purpose, path: PathBuf) {
        let table = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
        match purpose {
            Purpose::Open if !table => self.open_file(path),
            Purpose::Open | Purpose::Measurements => self.load_measurements(purpose, path),
            Purpose::Heights => self.load_face(purpose, path),
            Purpose::Csv(key) => {
                let text = path.display().to_string();
                self.edit(key, false, Change::Text(text.clone()));
                if let Some(why) = self.state.rejected.of(key).map(str::to_owned) {
                    // The reason is shown at the key, unless the new scene does not have the key.
                    let scene = self.state.document.scene();
                    match Parameter::find(key).is_some_and(|parameter| scene.has(parameter)) {
                        true => self.state.failed_path = Some((purpose, text)),
                        false => self.fail_at(purpose, &path, why),
                    }
                }
            }
            Purpose::Lessons => {
                self.load_lessons(&path);
                if !path.is_dir() {
                    self.state.failed_path = Some((purpose, path.display().to_string()));
                }
            }
            Purpose::Save(then) => {
                if let Err(reason) = self.save_as(path.clone(), then) {
                    self.fail_at(Purpose::Save(None), &path, reason);
                }
            }
            Purpose::Picture(picture) => self.write_picture(picture, &path),
            Purpose::Export(export) => self.export(export, &path),
        }
    }

    /// As [`Self::chosen`], for a typed path: the prompt closes. If nothing can be saved there, the prompt stays open, with the reason and
    /// with what is to follow.
    fn typed(&mut self, purpose: Purpose, path: PathBuf) {
        let prompt = std::mem::replace(&mut self.state.modal, self.state.covered.take());
        match (purpose, prompt) {
            (Purpose::Save(then), Some(Modal::Path(prompt))) => {
                if let Err(reason) = self.save_as(path, then) {
                    let prompt = PathPrompt { fresh: true, refused: Some(reason), ..prompt };
                    self.state.covered = self.state.modal.replace(Modal::Path(prompt));
                }
            }
            (purpose, _) => self.chosen(purpose, path),
        }
    }

    fn answered(&mut self, purpose: Purpose, answer: Answer) {
        match answer {
            Answer::Path(path) => self.chosen(purpose, path),
            Answer::Cancelled => {}
            Answer::NoDialog => self.prompt(vec![purpose]),
        }
    }

    /// Opens the prompt for a path. It suggests the path at which such an action failed last, or the one for the last of `purposes`.
    fn prompt(&mut self, purposes: Vec<Purpose>) {
        let state = &mut self.state;
        // A path that was typed for one key is not suggested for another.
        let same = |failed: &Purpose, purpose: &Purpose| match failed {
            Purpose::Csv(_) => failed == purpose,
            _ => failed.is_like(purpose),
        };
        let like = |failed: &Purpose| purposes.iter().any(|purpose| same(failed, purpose));
        let failed = state.failed_path.take_if(|(failed, _)| like(failed)).map(|(_, path)| path);
        let suggested = || purposes.last().map(|purpose| state.suggested_path(purpose));
        let path = failed.or_else(suggested).unwrap_or_default();
        state.modal = Some(Modal::Path(PathPrompt { purposes, path, fresh: true, refused: None }));
    }
}
