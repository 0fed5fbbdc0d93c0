//! Values that follow from other keys where they are not given: the pressure from the altitude, viscosity and mean free path from the gas.
//! Some quantities of a motor have two keys, such as the load on one wavelength and the load on the whole ring ([`ALTERNATIVES`]). One of the
//! two is given, and the other follows from it.

use super::error::FaultKind;
use super::parameter::Parameter;
use super::values::Scene;
use crate::digits::as_given;
use crate::gas::species::Species;
use crate::gas::{self, atmosphere};
use std::f64::consts::TAU;

/// A key whose value may follow from others.
struct Following {
    key: &'static str,
    /// The key that it follows from: the one that is given instead, or the one that chooses a model.
    source: &'static str,
    /// The value in the unit of `key`, from the scene and `source`; `None` if the scene gives it.
    value: fn(&Scene, &str) -> Option<f64>,
}

/// `[numerator, denominator]` of a factor.
type Factor = fn(&Scene) -> Option<[f64; 2]>;

/// Keys that replace another key and are proportional to it. The factor, which depends on the scene, times the value of the replaced
/// key gives the value of the key.
const ALTERNATIVES: &[(&str, Factor)] = &[
    ("motor.load_n", |scene| Some([scene.number("motor.waves").ok()?, 1.0])),
    ("motor.rotor_speed_mm_per_s", |scene| Some([TAU * scene.number("motor.contact_radius_mm").ok()?, 60.0])),
    ("stator.tooth_share", |scene| Some([1.0, scene.pitch_mm().ok()?])),
];

static FOLLOWING: &[Following] = &[
    Following { key: "film.ambient_pressure_kpa", source: "film.altitude_m", value: pressure_at_altitude },
    Following { key: "film.viscosity_upa_s", source: "film.gas", value: viscosity },
    Following { key: "film.mean_free_path_nm", source: "film.gas", value: mean_free_path },
    Following { key: "motor.load_per_wave_n", source: "motor.load_n", value: Scene::replaced_by },
    Following { key: "motor.rotor_speed_rpm", source: "motor.rotor_speed_mm_per_s", value: Scene::replaced_by },
    Following { key: "stator.tooth_width_mm", source: "stator.tooth_share", value: Scene::replaced_by },
    Following { key: "rotor.point_compliance_um_per_n", source: "rotor.model", value: point_compliance },
];

impl Scene {
    /// The value of a key that is not given in this scene, and that follows from others; in the unit of the key.
    pub fn following(&self, key: &str) -> Option<f64> {
        let following = FOLLOWING.iter().find(|following| following.key == key && self.is_set(following.source))?;
        (following.value)(self, following.source)
    }

    /// The value \[in its own unit\] that an optional key would have, if the scene gives the key that it could replace. `None` if the
    /// scene gives the optional key itself, or if the two keys are not proportional.
    pub fn alternative(&self, parameter: &Parameter) -> Option<f64> {
        let given = parameter.instead_of.filter(|_| self.given(parameter.key).is_none())?;
        let [factor, divisor] = self.factor(parameter.key)?;
        Some(self.number(given).ok()? * factor / divisor)
    }

    /// The factor of a key in [`ALTERNATIVES`], as a fraction; `None` for any other key.
    pub(super) fn factor(&self, key: &str) -> Option<[f64; 2]> {
        ALTERNATIVES.iter().find(|(alternative, _)| *alternative == key)?.1(self)
    }

    /// Values that follow and are out of the range of their key: for each the key that it follows from, and what is wrong.
    pub(super) fn following_out_of_range(&self) -> impl Iterator<Item = (&'static [&'static str], FaultKind)> + '_ {
        FOLLOWING.iter().filter(|following| self.is_set(following.source)).filter_map(
            |Following { key, source, value }| {
                // To ten digits, as a person would write it.
                let (parameter, value) = (Parameter::find(key)?, as_given(value(self, source)?));
                let range = parameter.range().filter(|range| !range.contains(value))?;
                let given = self.get(source).map_or_else(String::new, |given| format!("{source} = {given} makes "));
                let unit = parameter.unit;
                let message = format!("{given}{key} = {value} {unit}, which is out of range: allowed {range} {unit}");
                Some((std::slice::from_ref(source), FaultKind::Rule { key: source, message }))
            },
        )
    }

    /// The value of the key that a key in [`ALTERNATIVES`] replaces, if that key is given.
    fn replaced_by(&self, key: &str) -> Option<f64> {
        let [factor, divisor] = self.factor(key)?;
        Some(divisor * self.given(key)? / factor)
    }

    /// The mean free path \[nm\] if it is given and matters. It then does not follow the pressure.
    pub fn given_mean_free_path(&self) -> Option<f64> {
        let slips = self.text("film.slip").is_ok_and(|law| law != "none");
        self.get("film.mean_free_path_nm").filter(|_| slips)?.as_number()
    }

    /// The gas of the film, if it has a name.
    pub(super) fn species(&self) -> Option<&'static Species> {
        gas::find(self.text("film.gas").ok()?)
    }

    /// A number of this scene in SI.
    pub(super) fn si(&self, key: &str) -> Result<f64, FaultKind> {
        Ok(self.parameter(key)?.si(self.number(key)?))
    }
}

/// C_p = ℓ³/(8 EI) of a beam on a foundation that lets its deflection die out over ℓ, with I = w t³/12.
fn point_compliance(scene: &Scene, _: &str) -> Option<f64> {
    if scene.text("rotor.model") != Ok("section") {
        return None;
    }
    let si = |key| scene.si(key).ok();
    let second_moment = si("rotor.width_mm")? * si("rotor.thickness_mm")?.powi(3) / 12.0;
    let bending = si("rotor.elastic_modulus_gpa")? * second_moment;
    Some(si("rotor.decay_length_mm")?.powi(3) / (8.0 * bending) * 1e6)
}

fn pressure_at_altitude(scene: &Scene, altitude: &str) -> Option<f64> {
    Some(atmosphere::pressure(scene.given(altitude)?) / 1e3)
}

fn viscosity(scene: &Scene, _: &str) -> Option<f64> {
    Some((scene.species()?.viscosity)(scene.si("film.temperature_c").ok()?) * 1e6)
}

fn mean_free_path(scene: &Scene, _: &str) -> Option<f64> {
    let [pressure, temperature] = ["film.ambient_pressure_kpa", "film.temperature_c"].map(|key| scene.si(key).ok());
    Some(scene.species()?.mean_free_path(pressure?, temperature?) * 1e9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_is_a_number_and_never_given_too() {
        for Following { key, source, .. } in FOLLOWING {
            assert!(Parameter::find(key).is_some_and(|parameter| parameter.range().is_some()), "{key}");
            assert!(Parameter::find(source).is_some(), "{source}");
        }
        let following = |scene: &Scene| -> Vec<_> {
            let follows = |key: &&str| scene.following(key).is_some();
            FOLLOWING.iter().map(|following| following.key).filter(follows).collect()
        };
        assert_eq!(following(&Scene::motor()), Vec::<&str>::new());
        let given = [
            ("film.gas", "air"),
            ("film.altitude_m", "2000"),
            ("motor.load_n", "20"),
            ("motor.rotor_speed_mm_per_s", "30"),
            ("stator.tooth_share", "0.5"),
            ("rotor.model", "section"),
        ];
        let scene = Scene::motor().with(given).unwrap();
        assert_eq!(following(&scene), FOLLOWING.iter().map(|following| following.key).collect::<Vec<_>>());
        assert!(FOLLOWING.iter().all(|following| scene.get(following.key).is_none()));
    }

    /// A key and the one that replaces it say the same, there and back.
    #[test]
    fn alternatives_agree() {
        for key in ["motor.load_n", "motor.rotor_speed_mm_per_s", "stator.tooth_share"] {
            let before = Scene::motor().with([("motor.rotor_speed_rpm", "40")]).unwrap();
            let parameter = Parameter::find(key).unwrap();
            let replaced = parameter.instead_of.unwrap();
            let value = before.alternative(parameter).unwrap();
            let scene = before.with([(key, value.to_string())]).unwrap();
            assert_eq!((scene.get(replaced), scene.alternative(parameter)), (None, None));
            let again = scene.following(replaced).unwrap();
            assert!((again / before.number(replaced).unwrap() - 1.0).abs() < 1e-14, "{key}: {again}");
        }
    }
}
