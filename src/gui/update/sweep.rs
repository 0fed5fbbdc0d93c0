//! What is asked of the sweep, carried out.

use super::updater::Updater;
use crate::analysis::sweep::{Row, Sweep, SweepError};
use crate::gui::command::SweepCommand;
use crate::gui::state::sweep::SweepMessage;
use crate::job::task::Task;
use crate::solve::Settings;
use std::sync::Arc;
use std::time::Duration;

/// Points are drawn as they come, but at most this often.
const REDRAW: Duration = Duration::from_millis(100);

/// A sweep, and the rows of it that are known.
type Known = (Arc<Sweep>, Vec<Row>);
/// How a sweep tells what it has.
type Tell<'a> = &'a (dyn Fn(SweepMessage) + Sync);

impl Updater {
    pub(super) fn sweep(&mut self, command: SweepCommand) {
        match command {
            SweepCommand::Start => self.start_sweep(),
            SweepCommand::Cancel => self.state.sweep.cancel(),
            SweepCommand::Continue => {
                if let Some(swept) = self.state.sweep.swept().filter(|swept| !swept.running()) {
                    let known = (Arc::clone(swept.sweep()), swept.rows().to_vec());
                    self.run_sweep(true, |_| Ok(known));
                }
            }
            SweepCommand::Open(point) => {
                // Every point is a scene: the sweep has made them all.
                let scene = self.state.sweep.swept().and_then(|swept| swept.sweep().scene_at(point).ok());
                if let Some(mut scene) = scene {
                    // A sweep says in its name what was changed; the present scene keeps its own.
                    let present = self.state.document.scene();
                    (scene.name, scene.about) = (present.name.clone(), present.about.clone());
                    self.change_scene(scene);
                }
            }
            SweepCommand::Draw(quantity) => self.state.sweep.draw(quantity),
            SweepCommand::Choose(axis, key) => {
                let scene = self.state.document.scene();
                self.state.sweep.edit(|form| form.choose(scene, axis, key));
            }
            SweepCommand::From(axis, text) => self.state.sweep.edit(|form| form.axis(axis).from = text),
            SweepCommand::To(axis, text) => self.state.sweep.edit(|form| form.axis(axis).to = text),
            SweepCommand::Count(axis, text) => self.state.sweep.edit(|form| form.axis(axis).count = text),
            SweepCommand::Log(axis, log) => self.state.sweep.edit(|form| form.axis(axis).log = log),
            SweepCommand::Second(second) => self.state.sweep.edit(|form| form.set_second(second)),
            SweepCommand::Fidelity(fidelity) => self.state.sweep.edit(|form| form.fidelity = fidelity),
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
        self.run_sweep(false, move |tell| {
            let sweep = Arc::new(Sweep::new(&swept, &vary, &settings)?);
            tell(SweepMessage::Built(Arc::clone(&sweep)));
            Ok((sweep, Vec::new()))
        });
    }

    /// Solves what `build` returns, on a thread of its own: there can be 100 000 points to make.
    fn run_sweep(&mut self, goes_on: bool, build: impl FnOnce(Tell<'_>) -> Result<Known, SweepError> + Send + 'static) {
        let task = Task::start("sweep", self.wake(REDRAW), move |cancel, tell| {
            let (sweep, done) = build(tell)?;
            let solve = || sweep.run(&done, cancel, &|row| tell(SweepMessage::Solved(Box::new(row.clone()))));
            // A pool of its own: an export or another task need not wait until this is done.
            Ok(match rayon::ThreadPoolBuilder::new().build() {
                Ok(pool) => pool.install(solve),
                Err(_) => solve(),
            })
        });
        match task {
            Ok(task) => self.state.sweep.begin(task, goes_on, self.now()),
            Err(error) => self.state.fail(format!("The sweep cannot be started: {error}")),
        }
    }
}
