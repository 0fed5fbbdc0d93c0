//! Carries out the commands of the sensitivity analysis.

use super::updater::{REDRAW, Updater};
use crate::gui::command::SensitivityCommand;
use crate::gui::state::sensitivity::SEED;
use crate::job::sensitivity::{Derivatives, Draws};
use crate::solve::Settings;
use std::sync::Arc;

impl Updater {
    pub(super) fn sensitivity(&mut self, command: SensitivityCommand) {
        let document = &self.state.document;
        let (scene, fidelity) = (document.titled(), document.target());
        let state = &mut self.state.sensitivity;
        match command {
            SensitivityCommand::Start => {
                let settings = Settings { fidelity, ..Settings::default() };
                let task =
                    self.start_work("The sensitivities cannot be computed", Derivatives { scene, settings }, REDRAW);
                task.into_iter().for_each(|task| self.state.sensitivity.begin(task));
            }
            SensitivityCommand::Look(output) => state.output = output,
            SensitivityCommand::Uncertainty(key, text) => state.type_uncertainty(key, text),
            SensitivityCommand::Draws(draws) => state.chosen_draws = Some(draws),
            SensitivityCommand::Draw => {
                let (Some(found), Some(uncertainties)) = (state.found.as_ref(), state.uncertainties.as_ref()) else {
                    return;
                };
                let (sensitivity, uncertainties) = (Arc::clone(found), uncertainties.clone());
                let draws = Draws { sensitivity, uncertainties, draws: state.draws(), seed: SEED };
                let task = self.start_work("Random scenes cannot be solved", draws, REDRAW);
                task.into_iter().for_each(|task| self.state.sensitivity.begin_drawing(task));
            }
        }
    }
}
