//! A quantity in another of its forms ([`Parameter::instead_of`]): the load on one wave as that on the whole ring, a pressure as an altitude,
//! a mass as its weight. Where a plate floats, its mean gap and its load say the same too, once it is solved.

use super::parameter::{Parameter, Range};
use super::value::Value;
use super::values::Scene;
use crate::digits::rounded;
use crate::gas::atmosphere;
use crate::problem::GRAVITY;

/// Digits of a value in another form, as the fields of the window show them.
const DIGITS: usize = 6;
/// If rounding to these digits would change a value by more than this share, it gets one more digit, so that converting it back gives the
/// six digits that it came from.
const SAME: f64 = 5e-7;
/// Altitudes are rounded to millimetres: so many steps in a metre.
const STEPS: f64 = 1e3;
/// Number of bisections that find an altitude.
const HALVINGS: usize = 60;

/// What a solve found about a plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolvedPlate {
    /// Mean gap at which it floats \[µm\]; `None` if its gap is given.
    pub mean_gap_um: Option<f64>,
    /// Mean load that the film carries \[N, of a strip N/m\].
    pub load_n: f64,
}

impl Scene {
    /// The value \[in its own unit\] with which `parameter` would say the same as the form of its quantity that the scene gives. A pressure
    /// that no altitude has gives the nearest altitude. Without a `solved` plate, a mean gap is one that the amplitude allows, and for a
    /// plate whose gap is given the load is `None`.
    pub fn restated(&self, parameter: &'static Parameter, solved: Option<SolvedPlate>) -> Option<f64> {
        let range = parameter.range()?;
        let value = match parameter.key {
            "film.altitude_m" => return Some(altitude(self.number("film.ambient_pressure_kpa").ok()?, range)),
            "plate.load_n" => self.load_on_plate(solved)?,
            "plate.mass_g" => self.load_on_plate(solved)? / GRAVITY * 1e3,
            "plate.mean_gap_um" => self.clear_gap(solved)?,
            key => self.following(key).or_else(|| self.alternative(parameter))?,
        };
        let [short, exact] = [shortened(value), value].map(|value| value.clamp(range.min, range.max));
        // Rounding must not make a tooth that is as wide as the pitch wider than it.
        let mut tried = self.clone();
        tried.put(parameter, Some(Value::Number(short)));
        Some(if tried.check().is_ok() { short } else { exact })
    }

    /// Load on a plate \[N, of a strip N/m\]: as given, or the weight of its mass, or what the film carries at the gap that is given.
    fn load_on_plate(&self, solved: Option<SolvedPlate>) -> Option<f64> {
        let weight = self.given("plate.mass_g").map(|mass| mass / 1e3 * GRAVITY);
        let carried = solved.map(|solved| solved.load_n).filter(|load| *load > 0.0);
        self.given("plate.load_n").or(weight).or(carried)
    }

    /// A mean gap \[µm\] that the amplitude allows: the one at which the plate floats, or else the default or twice the amplitude.
    fn clear_gap(&self, solved: Option<SolvedPlate>) -> Option<f64> {
        let amplitude = self.number("plate.amplitude_um").ok()?;
        let floating = solved.and_then(|solved| solved.mean_gap_um).filter(|gap| *gap > amplitude);
        let usual = Parameter::find("plate.mean_gap_um")?.usual()?.as_number()?;
        Some(floating.unwrap_or_else(|| usual.max(2.0 * amplitude)))
    }
}

/// The altitude \[m\] in `range` with this pressure \[kPa\], or the nearest to it.
fn altitude(pressure: f64, range: Range) -> f64 {
    let Range { min: mut low, max: mut high } = range;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if atmosphere::pressure(middle) > 1e3 * pressure {
            low = middle;
        } else {
            high = middle;
        }
    }
    // Adding 0 turns a negative zero at sea level into zero.
    (0.5 * (low + high) * STEPS).round() / STEPS + 0.0
}

/// A value rounded to the digits that fields show, or to one more.
fn shortened(value: f64) -> f64 {
    let short = rounded(value, DIGITS);
    if (short - value).abs() <= SAME * value.abs() { short } else { rounded(value, DIGITS + 1) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::PARAMETERS;

    /// What a key would say, and the scene that says it so.
    fn restated(scene: &Scene, key: &str, solved: Option<SolvedPlate>) -> (f64, Scene) {
        let parameter = Parameter::find(key).unwrap();
        let value = scene.restated(parameter, solved).unwrap();
        let mut next = scene.clone();
        next.set_value(key, Value::Number(value)).unwrap();
        next.check().unwrap();
        assert!(next.has(parameter), "{key}");
        (value, next)
    }

    #[test]
    fn every_form_says_the_same_there_and_back() {
        let air = Scene::motor().with([("film.gas", "air")]).unwrap();
        let solved = Some(SolvedPlate { mean_gap_um: Some(4.25), load_n: 12.5 });
        let cases = [
            (&air, "motor.load_per_wave_n", "5", "motor.load_n", 35.0),
            (&air, "motor.load_per_wave_n", "9.85714", "motor.load_n", 69.0),
            (&air, "motor.rotor_speed_rpm", "20", "motor.rotor_speed_mm_per_s", 60.737_46),
            (&air, "motor.rotor_speed_rpm", "0", "motor.rotor_speed_mm_per_s", 0.0),
            (&air, "stator.tooth_width_mm", "1.767", "stator.tooth_share", 0.610_959),
            (&air, "film.ambient_pressure_kpa", "60", "film.altitude_m", 4209.2),
            (&air, "film.ambient_pressure_kpa", "101.325", "film.altitude_m", 0.0),
            (&Scene::plate(), "plate.mean_gap_um", "4.25", "plate.load_n", 12.5),
            (&Scene::plate(), "plate.mean_gap_um", "4.25", "plate.mass_g", 1274.65),
        ];
        for (base, key, text, form, expected) in cases {
            let before = base.with([(key, text)]).unwrap();
            let (value, there) = restated(&before, form, solved);
            assert!((value - expected).abs() <= 1e-4 * expected, "{form} = {value}");
            assert_eq!(restated(&there, key, solved).1, before, "{form} = {value}");
        }
        let forms = PARAMETERS.iter().filter(|parameter| parameter.instead_of.is_some());
        assert!(forms.map(|form| form.key).all(|form| cases.iter().any(|case| case.3 == form)));
        let (load, weight) = restated(&Scene::plate().with([("plate.mass_g", "100")]).unwrap(), "plate.load_n", None);
        assert_eq!((load, restated(&weight, "plate.mass_g", None).0), (0.980_665, 100.0));
    }

    #[test]
    fn what_another_form_cannot_say_is_the_nearest_that_is_allowed() {
        let air = |key, value| Scene::motor().with([("film.gas", "air"), (key, value)]).unwrap();
        for (pressure, altitude) in [("500", -1000.0), ("0.01", 60e3)] {
            assert_eq!(restated(&air("film.ambient_pressure_kpa", pressure), "film.altitude_m", None).0, altitude);
        }
        // As wide as the pitch, 2.7925268 mm, which to seven digits is wider.
        let wide = Scene::motor().with([("motor.contact_radius_mm", "28"), ("stator.tooth_share", "1")]).unwrap();
        assert!(restated(&wide, "stator.tooth_width_mm", None).0 < 2.792_527);
        let floating = Scene::plate().with([("plate.mass_g", "100"), ("plate.amplitude_um", "1")]).unwrap();
        let pressed = SolvedPlate { mean_gap_um: Some(0.9), load_n: 1.0 };
        assert_eq!([None, Some(pressed)].map(|solved| restated(&floating, "plate.mean_gap_um", solved).0), [2.0; 2]);
        let load = Parameter::find("plate.load_n").unwrap();
        assert_eq!(Scene::plate().restated(load, Some(SolvedPlate { mean_gap_um: None, load_n: -1.0 })), None);
    }
}
