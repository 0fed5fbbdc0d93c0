//! State of the trade-off tab: the measurement of error against time, its progress, and its results.

use super::background::BackgroundOf;
use crate::analysis::tradeoff::{Candidate, Family, Tradeoff, without_grid};
use crate::fidelity::Fidelity;
use crate::job::task::TaskOf;
use crate::job::tradeoff::TradeoffWork;
use crate::platform::Instant;
use crate::problem::Numerics;
use crate::scene::Scene;
use crate::solve::{Method, Settings};

/// Name of the window's present setting, if it is none of the listed ones.
const PRESENT: &str = "present setting";

/// A measurement, under way or ended.
#[derive(Debug)]
pub struct TradeoffState {
    /// The task; its messages are the settings measured so far.
    pub work: BackgroundOf<TradeoffWork>,
    /// The scene that is measured.
    pub scene: Scene,
    /// When it began.
    pub started: Instant,
    /// Share of the work that is done, 0 to 1.
    pub share: f64,
    /// The results so far.
    pub tradeoff: Tradeoff,
}

impl TradeoffState {
    /// A measurement of `scene` that began at `started`.
    pub fn new(task: TaskOf<TradeoffWork>, scene: Scene, started: Instant) -> Self {
        Self { work: task.into(), scene, started, share: 0.0, tradeoff: Tradeoff::of(&[]) }
    }

    /// Takes progress and results since the last call.
    pub fn drain(&mut self) {
        let (messages, found) = self.work.found();
        if let Some((runs, share)) = messages.into_iter().last() {
            (self.share, self.tradeoff) = (share, Tradeoff::of(&runs));
        }
        found.into_iter().for_each(|runs| self.tradeoff = Tradeoff::of(&runs));
    }

    /// Whether `scene` differs from the scene that was measured. Its grid does not matter, because each setting has its own.
    pub fn stale(&self, scene: &Scene) -> bool {
        !self.scene.same_model(scene) || without_grid(&self.scene.numerics()) != without_grid(&scene.numerics())
    }
}

/// Whether the window solves with exactly this setting: `target`, and a scene's `numerics`.
pub fn is_present(candidate: &Candidate, target: Fidelity, numerics: Numerics) -> bool {
    // The window never uses the contact nodes of the paper's method.
    let ours = |numerics: Numerics| Numerics { contact_nodes: None, ..numerics };
    let settings = candidate.settings;
    settings.method == Method::Auto && settings.fidelity == target && ours(candidate.numerics) == ours(numerics)
}

/// Adds the present setting to the settings to be measured, if it is not among them.
pub fn with_present(candidates: &mut Vec<Candidate>, target: Fidelity, numerics: Numerics) {
    if !candidates.iter().any(|candidate| is_present(candidate, target, numerics)) {
        let settings = Settings { fidelity: target, ..Settings::default() };
        candidates.push(Candidate::new(PRESENT.to_owned(), Family::Grid, settings, numerics, &numerics));
    }
}
