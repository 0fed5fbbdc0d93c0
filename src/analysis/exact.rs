//! A solved plate beside exact results: both limits of the squeeze number, small amplitudes, and the invariant.
//!
//! The load is compared by its first harmonic. With the gap h = h₀(1 + ε cos τ) and the plate's area A,
//!
//! ```text
//! F = F₀ + p_a A ε (−S cos τ + D sin τ) + …
//! ```
//!
//! S is the *spring*, in phase with the approach, and D the *damping*, in phase with its speed. For ε → 0 both are known for
//! every σ (`film::exact`); slip enters by its factor Q at the mean gap, as σ/Q.

use crate::estimate::Estimate;
use crate::film::exact::viscous_force;
use crate::film::slip::{Mobility, SlipLaw};
use crate::film::trapped::edge_height;
use crate::plate::harmonic::{effective_squeeze_number, linear, solved};
use crate::problem::{Outline, Plate};
use crate::recording::Recording;
use crate::solution::{Harmonic, PlateResult};
use std::f64::consts::TAU;

/// Samples of a cycle for exact means, which converge spectrally.
const SAMPLES: usize = 1024;

/// Unit names of stiffness and damping of a plate; for a strip they are per metre of width.
pub fn units(plate: &Plate) -> [&'static str; 2] {
    if plate.is_strip() { ["N/m²", "N·s/m²"] } else { ["N/m", "N·s/m"] }
}

/// A solved plate beside exact results.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactComparison {
    /// σ/Q, with Q = 1 + 6m for first-order slip: the number on which the linear film depends.
    pub effective_squeeze_number: f64,
    /// For the solved load, extrapolated; `None` if nothing vibrates.
    pub solved: Option<Harmonic<Estimate>>,
    /// Exact for ε → 0.
    pub linear: Harmonic<f64>,
    /// Units of the spring and damping numbers \[N/m, N s/m; of a strip per metre of width\].
    pub unit: Harmonic<f64>,
    /// Cycle mean over the plate of the pressure ratio P = p/p_a, solved, with its error.
    pub mean_pressure: Estimate,
    /// Cycle mean over the plate of the pressure ratio P = p/p_a, in the limit σ → ∞ (Langlois 1962, Salbu 1964).
    pub trapped_mean_pressure: f64,
    /// Greatest deviation of ⟨hΦ⟩ from its exact value at any point of the film, relative; `None` without a pressure map.
    pub invariant_deviation: Option<f64>,
    /// Load over the cycle \[N, of a strip N/m\], at the frames of the recording, for σ → ∞: gas that cannot leave within a cycle, Boyle's law.
    pub boyle: Vec<f64>,
    /// As `boyle`, for σ → 0: gas that is not compressed.
    pub viscous: Vec<f64>,
    /// The greatest viscous load, also between frames.
    pub greatest_viscous: f64,
}

impl ExactComparison {
    /// Stiffness \[N/m\] and damping \[N s/m\] of the solved load, of a strip per metre of width; `None` if nothing vibrates.
    pub fn stiffness_and_damping(&self) -> Option<Harmonic<Estimate>> {
        self.solved.map(|solved| solved.times(self.unit))
    }

    /// The comparison for a solve of `plate`, from its numbers and its fields.
    pub fn of(plate: &Plate, result: &PlateResult, recording: &Recording) -> Self {
        let film_load = result.film_load;
        let force = plate.gas.ambient_pressure * plate.area();
        let effective = effective_squeeze_number(plate);
        let gaps = || (0..SAMPLES).map(|i| plate.gap(i as f64 / SAMPLES as f64));
        let mean_inverse = gaps().map(|gap| 1.0 / gap).sum::<f64>() / SAMPLES as f64;
        // Z of gas that cannot leave within a cycle [m], for any law of slip.
        let trapped = edge_height(SlipLaw::of(&plate.gas), gaps);
        let frames = recording.frames;
        let limits = |frame: usize| {
            let phase = frame as f64 / frames as f64;
            (force * (trapped / plate.gap(phase) - 1.0), viscous_load(plate, phase))
        };
        let (boyle, viscous) = (0..frames).map(limits).unzip();
        Self {
            effective_squeeze_number: effective,
            solved: solved(plate, result, recording),
            linear: linear(effective, plate.outline()),
            unit: Harmonic::unit(plate),
            mean_pressure: Estimate { value: 1.0 + film_load.value / force, error: film_load.error / force },
            trapped_mean_pressure: trapped * mean_inverse,
            invariant_deviation: invariant_deviation(plate, recording),
            boyle,
            viscous,
            greatest_viscous: greatest_viscous(plate),
        }
    }
}

/// Load \[N, of a strip N/m\] at a phase of the cycle if gas is not compressed.
fn viscous_load(plate: &Plate, phase: f64) -> f64 {
    viscous_force(plate, plate.gap(phase), -TAU * plate.frequency * plate.amplitude * (TAU * phase).sin())
}

/// The greatest of these loads; there is one peak, while the plate approaches.
fn greatest_viscous(plate: &Plate) -> f64 {
    let (mut low, mut high) = (0.0, 0.5);
    while high - low > 1e-9 {
        let third = (high - low) / 3.0;
        if viscous_load(plate, low + third) < viscous_load(plate, high - third) {
            low += third;
        } else {
            high -= third;
        }
    }
    viscous_load(plate, low)
}

/// σ/Q at which spring and damping of a small amplitude are about equal.
pub fn crossover(outline: Outline) -> f64 {
    match outline {
        Outline::Strip | Outline::Ring { .. } => 10.0,
        Outline::Disc => 6.0,
        Outline::Rectangle { aspect } => 10.0 * (1.0 + 1.0 / (aspect * aspect)),
    }
}

/// Greatest |⟨hΦ(Z)⟩ − ⟨hΦ(h)⟩| over the points of the pressure map, over ⟨h²ψ(h) − h³/2⟩, which for first-order slip is
/// ⟨h³/2 + 6λ_a h²⟩, the invariant itself.
fn invariant_deviation(plate: &Plate, recording: &Recording) -> Option<f64> {
    let (frames, size) = (recording.frames, recording.map_x.len() * recording.map_y.len());
    if frames == 0 || size == 0 || recording.pressure.len() < frames * size {
        return None;
    }
    let law = SlipLaw::of(&plate.gas);
    let ambient = plate.gas.ambient_pressure;
    let gaps: Vec<f64> = (0..frames).map(|m| plate.gap(m as f64 / frames as f64)).collect();
    let mut sums = vec![0.0; size];
    let (mut edge, mut scale) = (0.0, 0.0);
    for (gap, map) in gaps.iter().zip(recording.pressure.chunks_exact(size)) {
        let factor = gap / ambient;
        for (sum, pressure) in sums.iter_mut().zip(map) {
            *sum += gap * law.potential(factor * pressure);
        }
        edge += gap * law.potential(*gap);
        scale += gap * gap * (law.at(*gap).0 - 0.5 * gap);
    }
    Some(sums.iter().map(|sum| (sum - edge).abs()).fold(0.0, f64::max) / scale)
}
