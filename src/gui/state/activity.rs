//! What the solver is doing.

use crate::control::Progress;
use crate::fidelity::Fidelity;

/// What the solver is doing.
#[derive(Clone, Debug, Default)]
pub struct Activity {
    /// The newest request.
    pub number: u64,
    /// What is running.
    pub running: Option<Running>,
    /// Why there is no newer result.
    pub failure: Option<String>,
}

/// The fidelity being solved, and how far it is.
#[derive(Clone, Copy, Debug)]
pub struct Running {
    /// Which fidelity.
    pub fidelity: Fidelity,
    /// Grid, of how many, and round.
    pub level: (usize, usize, usize),
    /// ln residual at the start of this grid, now, and at the tolerance.
    pub decay: (f64, f64, f64),
}

impl Running {
    /// Progress between 0 and 1.
    pub fn fraction(&self) -> f32 {
        let (first, now, last) = self.decay;
        let here = if first > last { ((first - now) / (first - last)).clamp(0.0, 1.0) } else { 0.0 };
        ((self.level.0 as f64 + here) / self.level.1.max(1) as f64) as f32
    }

    /// In words.
    pub fn text(&self) -> String {
        format!("solving {}, grid {} of {}, round {}", self.fidelity, self.level.0 + 1, self.level.1, self.level.2)
    }
}

impl Activity {
    /// Takes the progress of the request's solve at `fidelity`.
    pub fn advance(&mut self, fidelity: Fidelity, progress: &Progress) {
        let now = progress.residual.max(f64::MIN_POSITIVE).ln();
        let same = self.running.filter(|running| running.fidelity == fidelity && running.level.0 == progress.level);
        self.running = Some(Running {
            fidelity,
            level: (progress.level, progress.levels, progress.iteration),
            decay: (same.map_or(now, |running| running.decay.0), now, progress.tolerance.ln()),
        });
    }
}
