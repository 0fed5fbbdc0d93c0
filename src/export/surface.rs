//! Measured faces: the object of `--json`, and the lines of a preset.

use crate::digits::rounded;
use crate::scene::Parameter;
use crate::scene::heights::keys_of;
use crate::surface::height_map::HeightMap;
use crate::surface::texture::{Pair, Texture};
use serde::Serialize;

/// The object of `squeezefilm surface --json`.
#[derive(Clone, Debug, Serialize)]
pub struct Object {
    /// The faces, the rotor's first; one alone is both.
    pub faces: Vec<Face>,
    /// H_m by the paper: mean of both peak-to-valley heights.
    pub min_spacing_nm: f64,
    /// Combined rms roughness √(σ₁² + σ₂²) \[nm\].
    pub rms_nm: f64,
    /// Summit radius R (McCool 1987) \[µm\].
    pub summit_radius_um: f64,
    /// Summits per area η (McCool 1987) \[1/mm²\].
    pub summit_density_per_mm2: f64,
    /// m₀m₄/m₂².
    pub bandwidth: f64,
    /// γ along x.
    pub lay: f64,
    /// The stator's share of the variance, 0 to 1.
    pub stator_share: f64,
    /// φ along x and across at h/σ = 1, 2, 3, 5.
    pub flow_factors: Vec<FlowFactors>,
    /// Lines to be pasted into a preset.
    pub preset: String,
}

/// Statistics of a face.
#[derive(Clone, Debug, Serialize)]
pub struct Face {
    /// Its file.
    pub file: String,
    /// Points along x and y.
    pub points: [usize; 2],
    /// Spacing along x and y.
    pub spacing_um: [f64; 2],
    /// Mean magnitude.
    pub sa_nm: f64,
    /// Standard deviation.
    pub sq_nm: f64,
    /// Peak to valley.
    pub sz_nm: f64,
    /// Skewness.
    pub ssk: f64,
    /// Kurtosis.
    pub sku: f64,
    /// Where the autocorrelation along x and y falls to ½; null where it does not.
    pub correlation_length_um: [Option<f64>; 2],
    /// The same for 0.2.
    pub correlation_length_fifth_um: [Option<f64>; 2],
    /// γ along x.
    pub lay: Option<f64>,
}

/// φ at one h/σ.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct FlowFactors {
    /// h/σ.
    pub gap_over_rms: f64,
    /// φ along x.
    pub along: f64,
    /// φ along y.
    pub across: f64,
}

/// h/σ at which flow factors are told.
const RATIOS: [f64; 4] = [1.0, 2.0, 3.0, 5.0];

impl Face {
    /// Of a levelled face.
    pub fn of(file: &str, map: &HeightMap, texture: &Texture) -> Self {
        let micrometres = |lengths: [Option<f64>; 2]| lengths.map(|length| length.map(|length| length * 1e6));
        Self {
            file: file.to_owned(),
            points: [map.nx, map.ny],
            spacing_um: map.spacing.map(|step| step * 1e6),
            sa_nm: texture.mean * 1e9,
            sq_nm: texture.rms * 1e9,
            sz_nm: texture.peak_to_valley * 1e9,
            ssk: texture.skewness,
            sku: texture.kurtosis,
            correlation_length_um: micrometres(texture.correlation),
            correlation_length_fifth_um: micrometres(texture.correlation_fifth),
            lay: texture.lay(),
        }
    }
}

impl Object {
    /// Of faces and what they come to together.
    pub fn new(faces: Vec<Face>, pair: &Pair) -> Self {
        let factors = |ratio: f64| {
            let [along, across] = pair.flow_factors(ratio);
            FlowFactors { gap_over_rms: ratio, along, across }
        };
        Self {
            faces,
            min_spacing_nm: pair.min_spacing * 1e9,
            rms_nm: pair.rms * 1e9,
            summit_radius_um: pair.summit_radius * 1e6,
            summit_density_per_mm2: pair.summit_density * 1e-6,
            bandwidth: pair.bandwidth,
            lay: pair.lay,
            stator_share: pair.stator_share,
            flow_factors: RATIOS.map(factors).to_vec(),
            preset: preset(pair),
        }
    }
}

/// The lines of a preset that follow, to four digits: the paper's way first, as comments the other. A value that its key does not allow
/// is moved to the end of the range, and says so.
pub fn preset(pair: &Pair) -> String {
    let line = |key: &str, value: f64| {
        let (mut value, mut note) = (rounded(value, 4), String::new());
        if let Some(range) = Parameter::find(key).and_then(Parameter::range).filter(|range| !range.contains(value)) {
            note = format!("  # measured {value}, allowed {range}");
            value = value.clamp(range.min, range.max);
        }
        let leaf = key.split_once('.').map_or(key, |(_, leaf)| leaf);
        format!("{leaf} = {value:?}{note}\n")
    };
    let spacing = line("film.min_spacing_nm", pair.min_spacing * 1e9);
    let [rms, radius, density, lay] = keys_of(pair).map(|(key, value)| line(key, value));
    let share = line("surface.stator_share", pair.stator_share);
    let other = format!(
        "or, in place of that:\n[surface]\nmodel = \"asperities\"\n{rms}{radius}{density}\
         elastic_modulus_gpa = 60.0  # of the materials: no height tells it\nflow_factors = \"patir-cheng\"\n{lay}{share}"
    );
    let commented: String = other.lines().map(|line| format!("# {line}\n")).collect();
    format!("[film]\n{spacing}\n{commented}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_units_of_their_names() {
        let (bandwidth, lay, stator_share) = (3.0, 1.5, 0.4);
        let pair = Pair {
            min_spacing: 2e-7,
            rms: 3e-8,
            summit_radius: 5e-6,
            summit_density: 2e10,
            bandwidth,
            lay,
            stator_share,
        };
        let told = Object::new(Vec::new(), &pair);
        let found = [told.min_spacing_nm, told.rms_nm, told.summit_radius_um, told.summit_density_per_mm2];
        assert!(found.iter().zip([200.0, 30.0, 5.0, 2e4]).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{found:?}");
        assert_eq!((told.bandwidth, told.lay, told.stator_share), (bandwidth, lay, stator_share));
        assert!(told.flow_factors.iter().zip(RATIOS).all(|(factors, ratio)| factors.gap_over_rms == ratio));
    }
}
