//! State of the sensitivity tab: the derivatives of the results, the typed uncertainties, and the random scenes.

use super::background::{Background, BackgroundOf};
use super::document::solved_alike;
use crate::analysis::sensitivity::{MonteCarlo, Sensitivity, Uncertainties, Uncertainty};
use crate::job::sensitivity::{Derivatives, Draws};
use crate::job::task::TaskOf;
use crate::scene::Scene;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Default number of random scenes.
const DRAWS: usize = 500;
/// Seed of the random scenes: the same draws every time.
pub const SEED: u64 = 1;

/// Derivatives, uncertainties and random scenes.
#[derive(Debug, Default)]
pub struct SensitivityState {
    derivatives: BackgroundOf<Derivatives>,
    drawing: BackgroundOf<Draws>,
    share: f64,
    /// Results and derivatives.
    pub found: Option<Arc<Sensitivity>>,
    /// Typed uncertainties by key, none of them empty, each with the reason if it was refused.
    typed: BTreeMap<&'static str, (String, Option<String>)>,
    /// The valid uncertainties; there may be none. `None` before anything was computed.
    pub uncertainties: Option<Uncertainties>,
    /// Results of random scenes with these uncertainties.
    pub carlo: Option<MonteCarlo>,
    /// Results of random scenes with earlier uncertainties, and these uncertainties.
    pub earlier: Option<(MonteCarlo, Uncertainties)>,
    /// Index of the result that is shown.
    pub output: usize,
    /// Number of random scenes; `None` for the default.
    pub chosen_draws: Option<usize>,
}

impl SensitivityState {
    /// Number of random scenes to solve.
    pub fn draws(&self) -> usize {
        self.chosen_draws.unwrap_or(DRAWS)
    }

    /// Starts to track `task`, which computes the derivatives. The previous ones stay until it has ended.
    pub fn begin(&mut self, task: TaskOf<Derivatives>) {
        (self.share, self.derivatives, self.drawing) = (0.0, task.into(), Background::default());
    }

    /// Starts to track `task`, which solves random scenes.
    pub fn begin_drawing(&mut self, task: TaskOf<Draws>) {
        (self.share, self.derivatives.failure, self.drawing) = (0.0, None, task.into());
    }

    /// Takes progress and results since the last call.
    pub fn drain(&mut self) {
        let (shares, found) = self.derivatives.found();
        if let Some(found) = found {
            (self.found, self.carlo, self.earlier) = (Some(found.into()), None, None);
            self.judge();
        }
        let (drawn, carlo) = self.drawing.found();
        if carlo.is_some() {
            (self.carlo, self.earlier) = (carlo, None);
        }
        self.share = shares.into_iter().chain(drawn).last().unwrap_or(self.share);
    }

    /// Why the last work gave no result.
    pub fn failure(&self) -> Option<&String> {
        self.derivatives.failure.as_ref().or(self.drawing.failure.as_ref())
    }

    /// Cancels the running work; earlier results stay.
    pub fn cancel(&mut self) {
        self.derivatives.cancel();
        self.drawing.cancel();
    }

    /// The share of the work that is done, while it goes on.
    pub fn running(&self) -> Option<f64> {
        (self.derivatives.running() || self.drawing.running()).then_some(self.share)
    }

    /// Whether the results belong to another scene than this.
    pub fn stale(&self, scene: &Scene) -> bool {
        self.found.as_ref().is_some_and(|found| !solved_alike(found.scene(), scene))
    }

    /// Sets the uncertainty of a key from typed text. Results of random scenes are then [`Self::earlier`] ones.
    pub fn type_uncertainty(&mut self, key: &'static str, text: String) {
        self.typed.remove(key);
        if !text.trim().is_empty() {
            self.typed.insert(key, (text, None));
        }
        self.earlier = self.carlo.take().zip(self.uncertainties.take()).or(self.earlier.take());
        self.drawing = Background::default();
        self.judge();
    }

    /// The random scenes on screen, with their uncertainties, and whether these are earlier ones.
    pub fn drawn(&self) -> Option<(&MonteCarlo, &Uncertainties, bool)> {
        let present = self.carlo.as_ref().zip(self.uncertainties.as_ref()).map(|(carlo, by)| (carlo, by, false));
        present.or_else(|| self.earlier.as_ref().map(|(carlo, by)| (carlo, by, true)))
    }

    /// Typed uncertainty of a key; empty if there is none.
    pub fn typed(&self, key: &str) -> &str {
        self.typed.get(key).map_or("", |(text, _)| text.as_str())
    }

    /// Why the uncertainty of a key is refused; `None` if it is valid.
    pub fn refused(&self, key: &str) -> Option<&str> {
        self.typed.get(key)?.1.as_deref()
    }

    /// Reasons why uncertainties of keys of this scene are refused.
    pub fn all_refused<'a>(&'a self, scene: &'a Scene) -> impl Iterator<Item = &'a str> {
        let shown = self.typed.iter().filter(|(key, _)| scene.get(key).is_some());
        shown.filter_map(|(_, (_, refused))| refused.as_deref())
    }

    /// Determines which of the typed uncertainties are valid for the scene that was solved.
    fn judge(&mut self) {
        let Some(found) = &self.found else { return };
        let mut given: Vec<(&str, Uncertainty)> = Vec::new();
        for (key, (text, refused)) in &mut self.typed {
            let alone = text.parse::<Uncertainty>().map_err(|error| error.to_string()).and_then(|amount| {
                Uncertainties::new(found.scene(), &[(*key, amount)]).map_err(|error| error.to_string())?;
                Ok((*key, amount))
            });
            // A key that this scene does not have is not shown either.
            *refused = alone.map(|one| given.push(one)).err();
        }
        self.uncertainties = Uncertainties::new(found.scene(), &given).ok();
    }
}
