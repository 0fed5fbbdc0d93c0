//! What draft, standard, fine and reference mean: how many nodes and steps, and how exactly the cycle has to repeat.
//!
//! Each level is solved on three nested grids, every one with half the intervals and steps of the next; the results are
//! extrapolated to zero spacing (the scheme is of second order in both) and the spread of the extrapolations is the
//! error estimate. The measured error and cost of each level are in `docs/validation.md`.

use std::fmt;
use std::str::FromStr;

/// How much accuracy to buy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Fidelity {
    /// For dragging a slider: about a per cent.
    Draft,
    /// For everyday use: a few tenths of a per cent.
    #[default]
    Standard,
    /// For figures: a few hundredths of a per cent.
    Fine,
    /// For judging the others.
    Reference,
}

/// What a fidelity asks of the finest grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spec {
    /// Intervals along a tooth of ordinary width.
    pub along: usize,
    /// Unknown nodes across half the contact width, to begin with, of a polynomial.
    pub across: usize,
    /// Intervals across half the contact width with finite volumes.
    pub volumes: usize,
    /// Steps in a cycle, at least.
    pub steps: usize,
    /// Nodes in one wavelength that a tooth as wide as the wave would have.
    pub per_wave: usize,
    /// First interval at an ambient edge, in units of the film's boundary layer √(2D/ω) when closed.
    pub edge_fraction: f64,
    /// Rotor harmonics are kept until they fall below this fraction of the local compliance.
    pub harmonic_fraction: f64,
    /// Harmonics kept at most.
    pub most_harmonics: usize,
    /// Largest change of the trapped gas, and imbalance of the load, that counts as a repeating cycle; relative.
    pub tolerance: f64,
    /// Intervals across half a plate, each way.
    pub plate: usize,
    /// Steps in a cycle of a plate.
    pub plate_steps: usize,
    /// As `tolerance`, for a plate: nothing but the film, whose cycle is soon exact.
    pub plate_tolerance: f64,
    /// As `edge_fraction`, for a plate: a film alone, whose fields are compared with exact ones.
    pub plate_edge_fraction: f64,
    /// Relative error in α at which the level aims: terms of the model with a smaller effect are left out.
    pub aim: f64,
}

/// How many times each fidelity's grid is halved.
pub const GRIDS: usize = 3;

impl Fidelity {
    /// All levels, coarse to fine.
    pub const ALL: [Self; 4] = [Self::Draft, Self::Standard, Self::Fine, Self::Reference];

    /// The name used on the command line and in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Draft => "draft",
            Self::Standard => "standard",
            Self::Fine => "fine",
            Self::Reference => "reference",
        }
    }

    /// What the level means.
    pub fn spec(self) -> Spec {
        match self {
            Self::Draft => Spec {
                along: 8,
                across: 2,
                volumes: 4,
                steps: 36,
                per_wave: 32,
                edge_fraction: 0.7,
                harmonic_fraction: 1e-1,
                most_harmonics: 24,
                tolerance: 2e-3,
                plate: 12,
                plate_steps: 32,
                plate_tolerance: 1e-4,
                plate_edge_fraction: 0.5,
                aim: 2e-2,
            },
            Self::Standard => Spec {
                along: 12,
                across: 2,
                volumes: 4,
                steps: 36,
                per_wave: 64,
                edge_fraction: 0.85,
                harmonic_fraction: 3e-2,
                most_harmonics: 32,
                tolerance: 1e-3,
                plate: 12,
                plate_steps: 48,
                plate_tolerance: 1e-4,
                plate_edge_fraction: 0.5,
                aim: 5e-3,
            },
            Self::Fine => Spec {
                along: 24,
                across: 3,
                volumes: 8,
                steps: 72,
                per_wave: 128,
                edge_fraction: 0.5,
                harmonic_fraction: 1e-2,
                most_harmonics: 64,
                tolerance: 1e-4,
                plate: 16,
                plate_steps: 64,
                plate_tolerance: 1e-5,
                plate_edge_fraction: 0.4,
                aim: 1e-3,
            },
            Self::Reference => Spec {
                along: 48,
                across: 4,
                volumes: 20,
                steps: 144,
                per_wave: 256,
                edge_fraction: 0.2,
                harmonic_fraction: 1e-3,
                most_harmonics: 96,
                tolerance: 1e-5,
                plate: 16,
                plate_steps: 64,
                plate_tolerance: 1e-6,
                plate_edge_fraction: 0.4,
                aim: 2e-4,
            },
        }
    }
}

impl fmt::Display for Fidelity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Fidelity {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL
            .into_iter()
            .find(|level| level.name() == text)
            .ok_or_else(|| format!("fidelity = {text} is not known: allowed draft, standard, fine, reference"))
    }
}
