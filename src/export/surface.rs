//! Measured faces: the object of `--json`, and the lines of a preset.

use crate::digits::{rounded, significant};
use crate::scene::Parameter;
use crate::scene::heights::keys_of;
use crate::surface::height_map::HeightMap;
use crate::surface::texture::{Pair, Texture};
use serde_json::{Value, json};

/// h/σ at which flow factors are listed.
pub const RATIOS: [f64; 4] = [1.0, 2.0, 3.0, 5.0];

/// The object of `squeezefilm surface --json`: the faces, each with the name of its file, and the values for the pair; a single face counts
/// as both. Values along x come before values along y. A correlation length is where the autocorrelation falls to ½ or to 0.2; it is null
/// if it does not. H_m is the mean of both peak-to-valley heights, as in the paper; summits are those of McCool (1987); `preset` has the
/// lines to be pasted into a preset.
pub fn object<'a>(faces: impl Iterator<Item = (&'a str, &'a HeightMap, &'a Texture)>, pair: &Pair) -> Value {
    let micrometres = |lengths: [Option<f64>; 2]| lengths.map(|length| length.map(|length| length * 1e6));
    let face = |(file, map, texture): (&str, &HeightMap, &Texture)| {
        json!({
            "file": file,
            "points": [map.nx, map.ny],
            "spacing_um": map.spacing.map(|step| step * 1e6),
            "sa_nm": texture.mean * 1e9,
            "sq_nm": texture.rms * 1e9,
            "sz_nm": texture.peak_to_valley * 1e9,
            "ssk": texture.skewness,
            "sku": texture.kurtosis,
            "correlation_length_um": micrometres(texture.correlation),
            "correlation_length_fifth_um": micrometres(texture.correlation_fifth),
            "lay": texture.lay(),
        })
    };
    let factors = |ratio: f64| {
        let [along, across] = pair.flow_factors(ratio);
        json!({ "gap_over_rms": ratio, "along": along, "across": across })
    };
    json!({
        "faces": faces.map(face).collect::<Vec<_>>(),
        "min_spacing_nm": pair.min_spacing * 1e9,
        "rms_nm": pair.rms * 1e9,
        "summit_radius_um": pair.summit_radius * 1e6,
        "summit_density_per_mm2": pair.summit_density * 1e-6,
        // m₀m₄/m₂².
        "bandwidth": pair.bandwidth,
        // γ along x.
        "lay": pair.lay,
        // Of the variance, 0 to 1.
        "stator_share": pair.stator_share,
        "flow_factors": RATIOS.map(factors),
        "preset": preset(pair),
    })
}

/// The lines of a preset that follow, to four digits: those of the paper's model first, those of the other model as comments. A value that
/// its key does not allow is moved to the end of the range, with a note.
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

/// Two `lengths` \[m\] of a face, along x and y, in words; of a profile one.
pub fn lengths(face: &Texture, lengths: [Option<f64>; 2]) -> String {
    let longer = "longer than half the face";
    let number = |length: f64| significant(length * 1e6, 3);
    match lengths {
        [Some(x), Some(y)] => format!("{}, {} µm", number(x), number(y)),
        [None, Some(y)] => format!("{longer}, {} µm", number(y)),
        [Some(x), None] if face.autocorrelation[1].is_empty() => format!("{} µm", number(x)),
        [Some(x), None] => format!("{} µm, {longer}", number(x)),
        [None, None] => longer.to_owned(),
    }
}

/// The lay of a face in words; `None` if it is not known.
pub fn lay(face: &Texture) -> Option<String> {
    let bound = match face.correlation {
        [Some(_), None] => "at most ",
        [None, Some(_)] => "at least ",
        _ => "",
    };
    face.lay().map(|lay| format!("{bound}{}", significant(lay, 3)))
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
        let told = object(std::iter::empty(), &pair);
        for (name, expected) in [
            ("min_spacing_nm", 200.0),
            ("rms_nm", 30.0),
            ("summit_radius_um", 5.0),
            ("summit_density_per_mm2", 2e4),
            ("bandwidth", bandwidth),
            ("lay", lay),
            ("stator_share", stator_share),
        ] {
            assert!((told[name].as_f64().unwrap() / expected - 1.0).abs() < 1e-12, "{name}: {told}");
        }
        let factors = told["flow_factors"].as_array().unwrap();
        assert!(factors.iter().zip(RATIOS).all(|(factors, ratio)| factors["gap_over_rms"] == ratio), "{told}");
    }
}
