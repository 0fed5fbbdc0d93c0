//! What is asked of the sweep, carried out.

use super::App;
use crate::analysis::sweep::{Row, Sweep};
use crate::gui::modal::Modal;
use crate::gui::sweeping::{Sweeping, Sweeps, Told};
use crate::job::task::Task;
use crate::solve::Settings;
use eframe::egui;
use std::sync::Arc;
use std::time::Duration;

/// Points are drawn as they come, but at most this often.
const REDRAW: Duration = Duration::from_millis(100);

impl App {
    /// The sweep.
    pub fn sweeps(&self) -> &Sweeps {
        &self.sweeps
    }

    pub(super) fn sweep(&mut self, ctx: &egui::Context, asked: Sweeping) {
        match asked {
            Sweeping::Start => self.start_sweep(ctx),
            Sweeping::Cancel => self.sweeps.cancel(),
            Sweeping::Continue => {
                if let Some(swept) = self.sweeps.swept().filter(|swept| !swept.running()) {
                    let (sweep, rows) = (Arc::clone(swept.sweep()), swept.rows().to_vec());
                    self.run_sweep(ctx, sweep, rows);
                }
            }
            Sweeping::Open(point) => {
                // Every point is a scene: the sweep has made them all.
                let scene = self.sweeps.swept().and_then(|swept| swept.sweep().scene_at(point).ok());
                if let Some(mut scene) = scene {
                    // A sweep says in its name what was changed; the present scene keeps its own.
                    let present = self.document.scene();
                    (scene.name, scene.about) = (present.name.clone(), present.about.clone());
                    self.change_scene(scene);
                }
            }
            edit => self.sweeps.edit(self.document.scene(), edit),
        }
    }

    fn start_sweep(&mut self, ctx: &egui::Context) {
        let scene = self.document.scene();
        let fidelity = self.sweeps.form().map(|form| form.fidelity).unwrap_or_default();
        // What is wrong with an axis is said at the axis.
        let Ok(vary) = self.sweeps.asked(scene) else { return };
        let mut swept = scene.clone();
        swept.retitle(self.document.saved());
        match Sweep::new(&swept, &vary, &Settings { fidelity, ..Settings::default() }) {
            Ok(sweep) => self.run_sweep(ctx, Arc::new(sweep), Vec::new()),
            Err(error) => self.sweeps.refuse(&error),
        }
    }

    fn run_sweep(&mut self, ctx: &egui::Context, sweep: Arc<Sweep>, done: Vec<Row>) {
        let wake = ctx.clone();
        let wake = move |ended: bool| {
            if ended { wake.request_repaint() } else { wake.request_repaint_after(REDRAW) }
        };
        let (theirs, before) = (Arc::clone(&sweep), done.clone());
        let task = Task::start("sweep", wake, move |cancel, tell| {
            let solve = || theirs.run(&before, cancel, &|row| tell(Told::Some(vec![row.clone()])));
            // A pool of its own: an export or another task need not wait until this is done.
            let rows = match rayon::ThreadPoolBuilder::new().build() {
                Ok(pool) => pool.install(solve),
                Err(_) => solve(),
            };
            tell(Told::All(rows));
        });
        match task {
            Ok(task) => self.sweeps.begin(sweep, done, task, (self.world.now)()),
            Err(error) => self.modal = Some(Modal::Error(format!("The sweep cannot be started: {error}"))),
        }
    }
}
