//! Accuracy levels: the grids from which a solve starts, and how exactly the cycle has to repeat. Four have names: draft, standard, fine
//! and reference.
//!
//! A scene is solved on three nested grids, each with half the intervals and steps of the next. The results are extrapolated to zero
//! spacing (the scheme is of second order in space and time), and the changes from grid to grid give the error estimate. Finer grids follow
//! until that error is the one asked for (`ladder`). The measured error and cost of each level are in `docs/validation.md`.

use serde::{Deserialize, Serialize};

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// Requested accuracy of a solve. Levels are ordered: a more accurate level is greater.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Fidelity {
    /// For dragging a slider: 2 %.
    Draft,
    /// For everyday use: 0.5 %.
    #[default]
    Standard,
    /// For figures: 0.1 %.
    Fine,
    /// For checking the other levels: 0.02 %.
    Reference,
    /// To a relative error of the headline in millionths.
    To(u32),
}

/// Requirements of a fidelity on the finest grid of its plan; `ladder` may refine further.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spec {
    /// Intervals along a tooth of ordinary width.
    pub along: usize,
    /// Unknown nodes of a polynomial across half the contact width, to begin with.
    pub across: usize,
    /// Intervals across half the contact width with finite volumes.
    pub volumes: usize,
    /// Steps in a cycle, at least.
    pub steps: usize,
    /// Film intervals per wavelength: a tooth gets at least this number times tooth width over wavelength.
    pub per_wave: usize,
    /// First interval at an ambient edge, in units of the film's boundary layer √(2D/ω) when closed.
    pub edge_fraction: f64,
    /// Rotor harmonics are kept until they fall below this fraction of the local compliance.
    pub harmonic_fraction: f64,
    /// Largest change of the trapped gas, and imbalance of the load, that counts as a repeating cycle; relative.
    pub tolerance: f64,
    /// Intervals across half a plate, each way.
    pub plate: usize,
    /// Steps in a cycle of a plate.
    pub plate_steps: usize,
    /// As `tolerance`, for a plate, which is smaller because a film without contact soon repeats almost exactly.
    pub plate_tolerance: f64,
    /// As `edge_fraction`, for a plate, whose fields are compared with exact solutions.
    pub plate_edge_fraction: f64,
    /// Relative error of α that the level aims at: terms of the model with a smaller effect are left out.
    pub target_error: f64,
    /// Least safety factor on the error estimated from a motor's grids.
    pub least_factor: f64,
}

/// Number of nested grids of a plan: the finest one, and those with half and a quarter of its intervals and steps.
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
            Self::To(_) => "accuracy",
        }
    }

    /// The level whose stated relative error of the headline is to be at most `accuracy`, from 1e-6 to 0.5.
    pub fn to(accuracy: f64) -> Self {
        Self::To((1e6 * accuracy.clamp(ACCURACY[0], ACCURACY[1])).round() as u32)
    }

    /// The coarser ones of the named levels, then this one.
    pub fn and_coarser(self) -> Vec<Self> {
        Self::ALL.into_iter().filter(|level| level.accuracy() > self.accuracy()).chain([self]).collect()
    }

    /// The command-line option that asks for this level.
    pub fn option(self) -> String {
        if let Self::To(_) = self { format!("--accuracy {self}") } else { format!("--fidelity {self}") }
    }

    /// Relative error of the headline that is asked for.
    pub fn accuracy(self) -> f64 {
        if let Self::To(millionths) = self { f64::from(millionths) / 1e6 } else { self.spec().target_error }
    }

    /// Grids and tolerances of the level. Between the named levels they are interpolated in the logarithm of the error.
    pub fn spec(self) -> Spec {
        match self {
            Self::Draft => Spec {
                along: 8,
                across: 3,
                volumes: 4,
                steps: 36,
                per_wave: 32,
                edge_fraction: 0.7,
                harmonic_fraction: 1e-1,
                tolerance: 4e-3,
                plate: 12,
                plate_steps: 32,
                plate_tolerance: 1e-4,
                plate_edge_fraction: 0.5,
                target_error: 2e-2,
                least_factor: 1.0,
            },
            Self::Standard => Spec {
                along: 12,
                per_wave: 64,
                edge_fraction: 0.85,
                harmonic_fraction: 3e-2,
                tolerance: 1e-3,
                plate_steps: 48,
                target_error: 5e-3,
                ..Self::Draft.spec()
            },
            Self::Fine => Spec {
                along: 24,
                across: 3,
                volumes: 8,
                steps: 72,
                per_wave: 128,
                edge_fraction: 0.5,
                harmonic_fraction: 1e-2,
                tolerance: 1e-4,
                plate: 16,
                plate_steps: 64,
                plate_tolerance: 1e-5,
                plate_edge_fraction: 0.4,
                target_error: 1e-3,
                least_factor: 1.0,
            },
            Self::Reference => Spec {
                along: 48,
                across: 4,
                volumes: 20,
                steps: 144,
                per_wave: 256,
                edge_fraction: 0.2,
                harmonic_fraction: 1e-3,
                tolerance: 1e-5,
                plate_tolerance: 1e-6,
                target_error: 2e-4,
                ..Self::Fine.spec()
            },
            Self::To(_) => {
                let target_error = self.accuracy();
                let after = Self::ALL.iter().position(|level| level.spec().target_error <= target_error);
                let after = after.unwrap_or(Self::ALL.len() - 1).max(1);
                let (coarse, fine) = (Self::ALL[after - 1].spec(), Self::ALL[after].spec());
                let share = (coarse.target_error / target_error).ln() / (coarse.target_error / fine.target_error).ln();
                coarse.towards(&fine, share.clamp(0.0, 1.0), target_error)
            }
        }
    }
}

/// Least and greatest relative error that can be asked for.
pub const ACCURACY: [f64; 2] = [1e-6, 0.5];

impl Spec {
    /// The specification at the fraction `share` of the way to a finer one, interpolated in logarithms, for an error of `target_error`.
    fn towards(&self, fine: &Self, share: f64, target_error: f64) -> Self {
        let real = |a: f64, b: f64| a * (b / a).powf(share);
        let count = |a: usize, b: usize| real(a as f64, b as f64).round() as usize;
        Self {
            along: count(self.along, fine.along),
            across: count(self.across, fine.across),
            volumes: count(self.volumes, fine.volumes),
            steps: count(self.steps, fine.steps),
            per_wave: count(self.per_wave, fine.per_wave),
            edge_fraction: real(self.edge_fraction, fine.edge_fraction),
            harmonic_fraction: real(self.harmonic_fraction, fine.harmonic_fraction),
            tolerance: real(self.tolerance, fine.tolerance),
            plate: count(self.plate, fine.plate),
            plate_steps: count(self.plate_steps, fine.plate_steps),
            plate_tolerance: real(self.plate_tolerance, fine.plate_tolerance),
            plate_edge_fraction: real(self.plate_edge_fraction, fine.plate_edge_fraction),
            target_error,
            least_factor: 1.0,
        }
    }

    /// The same target error, but starting from coarse grids, so that there is an early result to refine.
    pub fn from_coarse(&self) -> Self {
        let Self { across, tolerance, plate_tolerance, plate_edge_fraction, target_error, .. } = *self;
        Self {
            across,
            tolerance,
            plate_tolerance,
            plate_edge_fraction,
            target_error,
            least_factor: EARLY,
            ..Fidelity::Draft.spec()
        }
    }
}

/// Safety factor on the error estimated from the grids if the time may be up on the first of them. At a named level, other parts of the
/// stated error often make up for an estimate that is too small (calibrated: docs/validation.md).
const EARLY: f64 = 2.0;

impl Ord for Fidelity {
    fn cmp(&self, other: &Self) -> Ordering {
        // Of two levels of the same accuracy the numeric one is the greater, so that only identical levels compare as equal.
        let by_number = |level: &Self| matches!(level, Self::To(_));
        other.accuracy().total_cmp(&self.accuracy()).then_with(|| by_number(self).cmp(&by_number(other)))
    }
}

impl PartialOrd for Fidelity {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Parses an accuracy as people write it: `0.1%`, `0,1 %` or `0.001`.
///
/// # Errors
/// A message that names the value and the allowed range.
pub fn parse_accuracy(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    let value = number.trim().replace(',', ".").parse::<f64>().ok().map(|value| value * unit);
    match value {
        Some(value) if (ACCURACY[0]..=ACCURACY[1]).contains(&value) => Ok(value),
        _ => {
            let meant = value.filter(|value| unit == 1.0 && (0.5..=50.0).contains(value));
            let meant = meant.map_or_else(String::new, |value| format!("; did you mean {value}%?"));
            Err(format!(
                "accuracy = {text} is not allowed: a relative error from 0.0001% to 50%, as 0.1% or 0.001{meant}"
            ))
        }
    }
}

impl fmt::Display for Fidelity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::To(millionths) => write!(f, "{}%", f64::from(*millionths) / 1e4),
            _ => f.write_str(self.name()),
        }
    }
}

impl FromStr for Fidelity {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match Self::ALL.into_iter().find(|level| level.name() == text) {
            Some(level) => Ok(level),
            None if text.ends_with('%') => parse_accuracy(text).map(Self::to),
            None => Err(format!(
                "fidelity = {text} is not known: allowed draft, standard, fine, reference, or an accuracy as 0.1%"
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_accuracy_stands_between_the_names() {
        let to = |text: &str| Fidelity::to(parse_accuracy(text).unwrap());
        assert!(Fidelity::Draft < to("1 %") && to("1 %") < Fidelity::Standard && Fidelity::Reference < to("0,01%"));
        assert!(Fidelity::Fine < to("0.1%") && to("0.1%") < Fidelity::Reference && to("50%") < Fidelity::Draft);
        assert!(Fidelity::ALL.is_sorted());
        assert_eq!(to("0.3%").and_coarser(), [Fidelity::Draft, Fidelity::Standard, to("0.3%")]);
        assert_eq!(Fidelity::Fine.and_coarser(), [Fidelity::Draft, Fidelity::Standard, Fidelity::Fine]);
        assert_eq!(to("50%").and_coarser(), [to("50%")]);
    }

    #[test]
    fn what_is_shown_is_read() {
        for fidelity in Fidelity::ALL.into_iter().chain([1, 7, 3000, 7000, 500_000].map(Fidelity::To)) {
            assert_eq!(fidelity.to_string().parse(), Ok(fidelity));
        }
        assert_eq!(Fidelity::to(0.007).to_string(), "0.7%");
        assert!("0%".parse::<Fidelity>().is_err() && "0.1".parse::<Fidelity>().is_err());
    }

    #[test]
    fn whoever_forgets_the_per_cent_is_told() {
        assert!(parse_accuracy("5").unwrap_err().ends_with("; did you mean 5%?"));
        assert!(["5000", "60%", "-5", "much"].iter().all(|text| !parse_accuracy(text).unwrap_err().contains("mean")));
    }
}
