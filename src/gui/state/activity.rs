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
    /// Residual at the start of this grid.
    first: f64,
}

impl Running {
    /// Progress between 0 and 1.
    pub fn fraction(&self) -> f32 {
        let Progress { level, levels, residual, tolerance, .. } = self.round;
        let fell = |to: f64| (self.first / to.max(f64::MIN_POSITIVE)).ln();
        let here = if fell(tolerance) > 0.0 { (fell(residual) / fell(tolerance)).clamp(0.0, 1.0) } else { 0.0 };
        // Each grid takes some four times as long as the one before.
        let before = |level: usize| 4f64.powi(level as i32) - 1.0;
        ((before(level) + here * (before(level + 1) - before(level))) / before(levels.max(1))) as f32
    }

    /// The progress in words.
    pub fn text(&self) -> String {
        let Progress { level, levels, iteration, residual, tolerance, .. } = self.round;
        let fidelity = self.fidelity;
        if level + 1 == levels && residual <= tolerance {
            // Of a rotor that floats, or nearly, this takes longer than all grids.
            return format!("solving {fidelity}, looking for other states");
        }
        format!("solving {fidelity}, grid {} of {levels}, round {iteration}", level + 1)
    }
}

impl Activity {
    /// Takes the progress of the request's solve at `fidelity`.
    pub fn advance(&mut self, fidelity: Fidelity, progress: &Progress) {
        let same = self.running.filter(|running| running.fidelity == fidelity && running.round.level == progress.level);
        let first = same.map_or(progress.residual.max(f64::MIN_POSITIVE), |running| running.first);
        self.running = Some(Running { fidelity, round: *progress, first });
    }
}
