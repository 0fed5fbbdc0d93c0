//! Derivatives and random scenes: computed.

use super::updater::{REDRAW, Updater};
use crate::gui::command::SensitivityCommand;
use crate::gui::state::sensitivity::SEED;
use crate::job::sensitivity::{Derivatives, Draws};
use crate::job::task::Task;
use crate::solve::Settings;
use std::sync::Arc;

impl Updater {
    /// Does what is asked about what the results depend on.
    pub(super) fn sensitivity(&mut self, command: SensitivityCommand) {
        let wake = self.wake(REDRAW);
        let document = &self.state.document;
        let (scene, fidelity) = (document.scene().clone(), document.target());
        let state = &mut self.state.sensitivity;
        match command {
            SensitivityCommand::Start => {
                let settings = Settings { fidelity, ..Settings::default() };
                state.begin(Task::of(Derivatives { scene, settings }, wake));
            }
            SensitivityCommand::Cancel => state.cancel(),
            SensitivityCommand::Look(output) => state.output = output,
            SensitivityCommand::Uncertainty(key, text) => state.type_uncertainty(key, text),
            SensitivityCommand::Draws(draws) => state.chosen_draws = Some(draws),
            SensitivityCommand::Draw => {
                let (Some(found), Some(uncertainties)) = (state.found.as_ref(), state.uncertainties.as_ref()) else {
                    return;
                };
                let (sensitivity, uncertainties) = (Arc::clone(found), uncertainties.clone());
                let draws = Draws { sensitivity, uncertainties, draws: state.draws(), seed: SEED };
                state.begin_drawing(Task::of(draws, wake));
            }
        }
    }
}
