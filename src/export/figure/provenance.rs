//! Where the numbers of a figure come from.

use crate::analysis::quantity::force_unit;
use crate::export::json::mark_of;
use crate::problem::Problem;
use crate::solution::{Outcome, Solution};
use serde::{Deserialize, Serialize};

/// Where the numbers of a figure come from. Empty fields are left out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// The scene's name, or the names of several.
    pub preset: String,
    /// Version of this program.
    pub version: String,
    /// `draft`, `standard`, …, or `paper mesh`.
    pub fidelity: String,
    /// The estimated numerical error, as a text.
    pub error: String,
    /// Anything else: `not converged`, the instant shown.
    pub note: String,
}

impl Provenance {
    /// The provenance for the scene of this name, solved by this program.
    pub fn named(preset: &str) -> Self {
        Self { preset: preset.to_owned(), version: env!("CARGO_PKG_VERSION").to_owned(), ..Self::default() }
    }

    /// The provenance for one solve.
    pub fn of(problem: &Problem, solution: &Solution) -> Self {
        let error = match &solution.outcome {
            Outcome::Motor(result) => format!("α = {}", result.alpha),
            Outcome::Plate(result) => {
                let unit = force_unit(problem);
                format!("film load {} {unit}", result.film_load)
            }
        };
        Self {
            fidelity: solution.model.fidelity.clone(),
            error,
            note: mark_of(solution),
            ..Self::named(&crate::scene::show_text(&problem.name))
        }
    }

    /// One line for people; empty if nothing is known.
    pub fn line(&self) -> String {
        let program = if self.version.is_empty() { String::new() } else { format!("squeezefilm {}", self.version) };
        let parts = [&self.preset, &self.fidelity, &self.error, &self.note, &program];
        parts.iter().filter(|part| !part.is_empty()).map(|part| part.as_str()).collect::<Vec<_>>().join(" · ")
    }
}
