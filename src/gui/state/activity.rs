//! Progress of the background solver, as the window shows it.

use crate::control::Progress;
use crate::fidelity::Fidelity;

/// State of the background solver: the newest request and how far it is.
#[derive(Clone, Debug, Default)]
pub struct Activity {
    /// The newest request.
    pub number: u64,
    /// The solve in progress; `None` while the solver is idle.
    pub running: Option<Running>,
    /// Why there is no newer result.
    pub failure: Option<String>,
}

/// The fidelity being solved, and how far it is.
#[derive(Clone, Copy, Debug)]
pub struct Running {
    /// The fidelity being solved.
    pub fidelity: Fidelity,
    /// State after the newest round.
    pub round: Progress,
}

impl Running {
    /// The progress in words.
    pub fn text(&self) -> String {
        let Progress { level, levels, iteration, residual, tolerance, .. } = self.round;
        let fidelity = self.fidelity;
        if level + 1 == levels && residual <= tolerance {
            // For a rotor that floats, or nearly floats, this takes longer than the solves on all grids.
            return format!("solving {fidelity}, looking for other states");
        }
        format!("solving {fidelity}, grid {} of {levels}, round {iteration}", level + 1)
    }
}
