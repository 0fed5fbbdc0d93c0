//! What is asked of measurements and fits, carried out.

use super::updater::Updater;
use crate::analysis::fit::Measured;
use crate::gui::command::FitCommand;
use crate::gui::state::dialogs::Purpose;
use crate::gui::state::fit::Asked;
use crate::gui::state::sweep::AxisForm;
use crate::gui::state::view::Tab;
use crate::job;
use crate::scene::Value;
use crate::solve::{Method, Settings};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Progress is drawn at most this often.
const REDRAW: Duration = Duration::from_millis(100);

impl Updater {
    pub(super) fn fit(&mut self, command: FitCommand) {
        let state = &mut self.state;
        let scene = state.document.scene();
        match command {
            FitCommand::Choose => self.ask(Purpose::Measurements, ""),
            FitCommand::Load(path) => self.load_measurements(&path),
            FitCommand::Forget => state.fit.forget(),
            FitCommand::Key(line, key) => {
                let axis = AxisForm::around(scene, key, 2);
                state.fit.edit(line, |line| *line = axis);
            }
            FitCommand::From(line, text) => state.fit.edit(line, |line| line.from = text),
            FitCommand::To(line, text) => state.fit.edit(line, |line| line.to = text),
            FitCommand::Log(line, log) => state.fit.edit(line, |line| line.log = log),
            FitCommand::Add => state.fit.add(scene),
            FitCommand::Remove(line) => state.fit.remove(line),
            FitCommand::Start => self.start_fit(),
            FitCommand::Cancel => state.fit.cancel(),
            FitCommand::Take => {
                let Some((_, found)) = state.fit.found() else { return };
                let mut next = scene.clone();
                let set = found
                    .unknowns
                    .iter()
                    .try_for_each(|found| next.set_value(found.unknown.parameter.key, Value::Number(found.value)));
                match set.and_then(|()| next.check()) {
                    Ok(()) => self.change_scene(next),
                    Err(error) => self.state.fail(error),
                }
            }
        }
    }

    /// Reads a table of measurements. On the torque tab torques are drawn over the curve; anything else shows the fit.
    fn load_measurements(&mut self, path: &Path) {
        let state = &mut self.state;
        match Measured::find(&path.to_string_lossy(), state.document.scene(), Method::Auto) {
            Ok(measured) => {
                state.fit.load(measured);
                let (torques, others) = state.fit.torques();
                if state.view.tab != Tab::Torque || torques.is_empty() && others == 0 {
                    state.view.tab = Tab::Fit;
                }
            }
            Err(error) => state.fail(error),
        }
    }

    fn start_fit(&mut self) {
        if self.state.fit.running() {
            return;
        }
        let scene = self.state.document.scene().clone();
        // What is wrong with a key is said at the key.
        let (Some(measured), Ok(bounds)) = (self.state.fit.measured().cloned(), self.state.fit.asked(&scene)) else {
            return;
        };
        let settings = Settings { fidelity: self.state.document.target(), ..Settings::default() };
        let asked = Asked { scene: scene.clone(), measured: Arc::clone(&measured) };
        let task = job::fit::start(scene, measured, bounds, settings, self.wake(REDRAW));
        match task {
            Ok(task) => self.state.fit.begin(asked, task),
            Err(error) => self.state.fail(format!("The fit cannot be started: {error}")),
        }
    }
}
