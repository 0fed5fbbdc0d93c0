//! Scales of the run that is drawn, kept from frame to frame.

use crate::fidelity::Fidelity;
use crate::gui::derived::scales::{Ranges, Scales};
use crate::gui::state::view::View;
use crate::gui::ui::cache::once;
use crate::job::SolvedScene;
use crate::problem::Scenario;
use crate::recording::Recording;
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

/// The run that another one is compared with, at the same phase of its own cycle: drawn in grey behind it.
pub(super) struct FirstRun<'a> {
    pub(super) recording: &'a Recording,
    pub(super) scenario: &'a Scenario,
    pub(super) scales: Arc<Scales>,
    /// The instant, in frames.
    pub(super) place: f64,
}

impl<'a> FirstRun<'a> {
    /// `run` at the phase that the views show.
    pub(super) fn new(ui: &Ui, run: &'a SolvedScene, view: &View) -> Self {
        let recording = &run.solution.recording;
        let scales = once(ui, "scales of the first run", (run.number, run.fidelity), || Scales::new(recording));
        Self { recording, scenario: &run.problem.scenario, scales, place: view.place(recording) }
    }
}

/// Ranges that hold both runs.
pub(super) fn in_common(ui: &Ui, run: &SolvedScene, first: &SolvedScene) -> Ranges {
    let key = (run.number, run.fidelity, first.number, first.fidelity);
    *once(ui, "ranges in common", key, || {
        Ranges::of(&first.solution.recording).and(Ranges::of(&run.solution.recording))
    })
}
