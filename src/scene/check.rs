//! The rules a scene must keep, those of single keys and those between keys.

use super::access::accept;
use super::error::{Fault, SceneError, What};
use super::parameter::{NARROWEST_TOOTH, ParameterKind, Range};
use super::{Kind, Parameter, RotorModel, Scene, compliance};
use crate::problem::Wedge;

/// A rule between keys that is broken, and the keys it is about.
pub(super) struct Broken {
    pub(super) what: What,
    pub(super) keys: &'static [&'static str],
}

impl Scene {
    /// Checks the whole scene: each key's range, and the rules between keys.
    ///
    /// # Errors
    ///
    /// All faults found.
    pub fn check(&self) -> Result<(), SceneError> {
        let mut whats = Vec::new();
        for parameter in self.parameters() {
            // The rows are checked below, all of them.
            if let (Some(value), false) = (self.get(parameter.key), parameter.kind == ParameterKind::Rows) {
                whats.extend(accept(parameter, value).err());
            }
        }
        if let Some(RotorModel::Table { compliance }) = self.rotor_model() {
            whats.extend(compliance::check_rows("rotor.compliance", compliance));
        }
        for broken in self.broken_rules() {
            if !whats.iter().any(|what| what.key().is_some_and(|key| broken.keys.contains(&key))) {
                whats.push(broken.what);
            }
        }
        SceneError::unless_empty(whats.into_iter().map(Fault::from).collect())
    }

    /// The range of a key in this scene: its own, narrowed by what the other keys leave. `None` for a key that is not a
    /// number or does not apply. The upper end of `plate.amplitude_um` is itself not allowed.
    pub fn range(&self, key: &str) -> Option<Range> {
        let parameter = Parameter::find(key)?;
        self.applies(parameter).ok()?;
        let own = parameter.range()?;
        let narrower = match (&self.kind, key) {
            (Kind::Motor { .. }, "stator.tooth_width_mm") => self.tooth_widths_mm()?,
            (Kind::Plate { plate, .. }, "plate.amplitude_um") => Range::new(0.0, plate.mean_gap_um),
            _ => own,
        };
        Some(Range::new(narrower.min.max(own.min), narrower.max.min(own.max)))
    }

    /// Rules between keys that are broken.
    pub(super) fn broken_rules(&self) -> Vec<Broken> {
        let mut broken = Vec::new();
        match &self.kind {
            Kind::Motor { motor, stator, film, .. } => {
                if !film.shear && self.numerics.wedge == Wedge::On {
                    broken.push(Broken { what: What::WedgeWithoutShear, keys: &["numerics.wedge", "film.shear"] });
                }
                let allowed = self.tooth_widths_mm().filter(|range| !range.contains(stator.tooth_width_mm));
                if let Some(range) = allowed {
                    broken.push(Broken {
                        what: What::ToothAndPitch {
                            width_mm: stator.tooth_width_mm,
                            range: rounded_inwards(range),
                            radius_mm: motor.contact_radius_mm,
                            waves: motor.waves,
                            teeth: stator.teeth_per_wave,
                        },
                        keys: &[
                            "stator.tooth_width_mm",
                            "motor.contact_radius_mm",
                            "motor.waves",
                            "stator.teeth_per_wave",
                        ],
                    });
                }
            }
            Kind::Plate { plate, .. } => {
                if plate.amplitude_um >= plate.mean_gap_um {
                    broken.push(Broken {
                        what: What::AmplitudeAndGap {
                            amplitude_um: plate.amplitude_um,
                            mean_gap_um: plate.mean_gap_um,
                        },
                        keys: &["plate.amplitude_um", "plate.mean_gap_um"],
                    });
                }
            }
        }
        broken
    }

    /// Tooth widths the pitch allows \[mm\].
    fn tooth_widths_mm(&self) -> Option<Range> {
        let Kind::Motor { stator, .. } = &self.kind else { return None };
        let pitch = self.wavelength() * 1e3 / f64::from(stator.teeth_per_wave);
        Some(Range::new(NARROWEST_TOOTH * pitch, pitch))
    }

    /// Wavelength \[m\] of a motor, 2πr/waves; 1 of a plate, which has no use for it.
    pub(super) fn wavelength(&self) -> f64 {
        match &self.kind {
            Kind::Motor { motor, .. } => {
                std::f64::consts::TAU * (motor.contact_radius_mm / 1e3) / f64::from(motor.waves)
            }
            Kind::Plate { .. } => 1.0,
        }
    }
}

/// The range to six digits, so rounded that what is shown is allowed.
fn rounded_inwards(range: Range) -> Range {
    let digits = |value: f64| 10f64.powi(5 - value.log10().floor() as i32);
    let (low, high) = (digits(range.min), digits(range.max));
    Range::new((range.min * low).ceil() / low, (range.max * high).floor() / high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shown_range_is_inside_the_real_one() {
        let range = Range::new(0.028_921_741_3, 2.892_174_13);
        assert_eq!(rounded_inwards(range), Range::new(0.028_921_8, 2.892_17));
    }

    #[test]
    fn the_range_of_a_key_follows_the_other_keys() {
        let mut scene = Scene::motor();
        let pitch = std::f64::consts::TAU * 29.0 / 63.0;
        let range = scene.range("stator.tooth_width_mm").unwrap();
        assert!((range.max / pitch - 1.0).abs() < 1e-14 && (range.min / pitch - 0.01).abs() < 1e-14);
        scene.set("stator.teeth_per_wave", "18").unwrap();
        assert!((scene.range("stator.tooth_width_mm").unwrap().max / pitch - 0.5).abs() < 1e-14);
        assert_eq!(scene.range("plate.amplitude_um"), None);
        assert_eq!(Scene::plate().range("plate.amplitude_um"), Some(Range::new(0.0, 1.0)));
        assert_eq!(scene.range("film.min_spacing_nm"), Some(Range::new(5.0, 10000.0)));
    }

    #[test]
    fn a_key_at_fault_hides_the_rules_about_it() {
        let mut scene = Scene::motor();
        if let Kind::Motor { motor, film, .. } = &mut scene.kind {
            motor.waves = 0;
            film.viscosity_upa_s = f64::NAN;
        }
        let message = scene.check().unwrap_err().to_string();
        assert_eq!(
            message,
            "motor.waves = 0 is out of range: allowed 1 to 100\n\
             film.viscosity_upa_s = NaN is not finite: expected a number from 1 to 1000 µPa s"
        );
    }
}
