//! Scales of the run that is drawn, kept from frame to frame.

use crate::fidelity::Fidelity;
use crate::gui::derived::scales::{Ranges, Scales};
use crate::gui::ui::cache::once;
use crate::job::SolvedScene;
use crate::problem::Scenario;
use eframe::egui::Ui;
use std::sync::Arc;

/// Those of `run`, computed when it is first seen; with the ranges `within`, if it is one cycle of several.
pub(super) fn scales_of(ui: &Ui, run: &SolvedScene, within: Option<&Ranges>) -> Arc<Scales> {
    let name = match run.problem.scenario {
        Scenario::Motor(_) => "motor scales",
        Scenario::Plate(_) => "plate scales",
    };
    let key: (u64, Fidelity, Option<Ranges>) = (run.number, run.fidelity, within.copied());
    once(ui, name, key, || Scales::new(&run.solution.recording).within(within))
}
