//! Ranges of the sliders, and the values that they set.

use crate::digits::rounded;
use crate::scene::{Parameter, ParameterKind, Range, Scale, Scene};

/// A whole number whose range spans more than this ratio gets a logarithmic slider.
const LOG_RATIO: f64 = 50.0;
/// Significant digits that a slider sets.
const SLIDER_DIGITS: usize = 4;
/// Relative distance of a slider from an end of the range that is itself not allowed.
const OPEN_END: f64 = 1e-3;

/// The range of a slider: the useful part of the parameter's range, within the limits that the other keys leave. Also whether it is
/// logarithmic.
pub fn slider_range(scene: &Scene, parameter: &Parameter) -> (Range, bool) {
    let allowed = scene.range(parameter.key).unwrap_or(Range::new(0.0, 1.0));
    let (wanted, logarithmic) = match parameter.kind {
        ParameterKind::Number { slider, scale, .. } => (slider, scale == Scale::Log),
        _ => (allowed, allowed.min > 0.0 && allowed.max > LOG_RATIO * allowed.min),
    };
    let mut range = Range::new(wanted.min.max(allowed.min), wanted.max.min(allowed.max));
    if range.min >= range.max {
        range = allowed;
    }
    if parameter.key == "plate.amplitude_um" && range.max >= allowed.max {
        range.max = allowed.max * (1.0 - OPEN_END);
    }
    (range, logarithmic && range.min > 0.0)
}

/// `value` to a few digits, within the range.
pub fn inside(value: f64, range: Range) -> f64 {
    rounded(value, SLIDER_DIGITS).clamp(range.min, range.max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Value;

    #[test]
    fn sliders_stay_within_what_is_allowed() {
        let scenes = [Scene::motor(), Scene::plate()];
        for scene in &scenes {
            let heeded = |parameter: &&Parameter| parameter.range().is_some() && scene.heeds(parameter.key);
            for parameter in scene.parameters().filter(|parameter| heeded(parameter)) {
                let (range, logarithmic) = slider_range(scene, parameter);
                assert!(range.min < range.max, "{}", parameter.key);
                assert!(!logarithmic || range.min > 0.0, "{}", parameter.key);
                for share in [0.0, 0.1234567, 0.5, 1.0] {
                    let value = inside(range.min + share * (range.max - range.min), range);
                    let mut changed = scene.clone();
                    let value =
                        if matches!(parameter.kind, ParameterKind::Whole { .. }) { value.round() } else { value };
                    changed.set_value(parameter.key, Value::Number(value)).unwrap();
                    // The keys that limit these two may leave too small a range for them, which is then refused.
                    if ["stator.tooth_width_mm", "plate.amplitude_um"].contains(&parameter.key) {
                        changed.check().unwrap();
                    }
                }
            }
        }
    }
}
