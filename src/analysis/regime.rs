//! The regime of a film in words, from its dimensionless numbers, and whether the film matters.

use super::validity::mach;
use crate::digits::{as_given, brief, rounded, significant};
use crate::dimensionless::Dimensionless;
use crate::estimate::Estimate;
use crate::film::slip::{Mobility, SlipLaw};
use crate::problem::{Motor, Plate, Problem, Scenario};
use crate::solution::{MotorResult, Outcome, PlateResult};
use std::f64::consts::SQRT_2;

/// A share of the load, or of ambient pressure times area, below which a film hardly matters.
const HARDLY: f64 = 1e-3;
/// The effect of any film is larger than this.
const NOTHING: f64 = 1e-6;
/// If the least gap of a plate is below this share of the mean gap, the film at the least gap is described, too.
const CLOSE: f64 = 0.5;

/// The regime of the film in words, spring or damper: the distance from the edges within which gas leaks in a cycle, compared with the
/// shorter side. For a rotor that floats, it is that of the place where the film is thinnest, because the gap never is the minimum spacing.
pub fn squeeze(problem: &Problem, outcome: &Outcome) -> String {
    if let (Scenario::Motor(motor), Outcome::Motor(result @ MotorResult { levitated: true, .. })) =
        (&problem.scenario, outcome)
    {
        let thinnest = result.min_film_thickness.value;
        let scenario = Scenario::Motor(Motor { min_spacing: thinnest, ..motor.clone() });
        let says = leaks(&Problem { scenario, ..problem.clone() });
        return format!("where the film is thinnest, {} nm, {says}", brief(thinnest * 1e9));
    }
    leaks(problem)
}

fn leaks(problem: &Problem) -> String {
    let (says, is) = film(problem);
    let Scenario::Plate(plate) = &problem.scenario else { return format!("in a cycle gas {says}: {is}") };
    // A plate with a large amplitude has a different squeeze number during part of the cycle.
    let least = plate.mean_gap - plate.amplitude;
    let scenario = Scenario::Plate(Plate { mean_gap: least, amplitude: 0.0, ..plate.clone() });
    match film(&Problem { scenario, ..problem.clone() }) {
        (then, other) if least < CLOSE * plate.mean_gap && other != is => {
            format!("in a cycle gas {says} at the mean gap: {is}; where it is closest, gas {then}: {other}")
        }
        _ => format!("in a cycle gas {says}: {is}"),
    }
}

/// How gas leaks in a cycle at the present gap, and whether that makes the film a spring or a damper.
fn film(problem: &Problem) -> (String, &'static str) {
    let shorter = match &problem.scenario {
        Scenario::Motor(motor) => motor.tooth_width.min(motor.contact_width),
        Scenario::Plate(plate) => plate.squeezed_length().min(plate.width.unwrap_or(f64::INFINITY)),
    };
    let layer = Dimensionless::of(problem).boundary_layer;
    let within = format!("within {} µm of the edges", significant(layer * 1e6, 2));
    match layer / shorter {
        share if share > SQRT_2 => ("flows out and back in everywhere".to_owned(), "the film is a damper"),
        share if share > SQRT_2 / 10.0 => (format!("leaks {within}"), "the film is both spring and damper"),
        _ => (format!("leaks only {within}"), "the film is a spring"),
    }
}

/// Whether the film matters here, by the load that it carries.
pub fn weight(problem: &Problem, outcome: &Outcome) -> String {
    let (Estimate { value: share, error }, of, rest) = match (&problem.scenario, outcome) {
        (Scenario::Motor(_), Outcome::Motor(result)) if result.levitated => {
            return "here it carries the whole load: the rotor floats".to_owned();
        }
        (Scenario::Motor(_), Outcome::Motor(result)) => (result.alpha, "the load", ", and contact the rest"),
        (Scenario::Plate(plate), Outcome::Plate(result)) => {
            let of = if plate.is_strip() { "p_a × length" } else { "p_a × area" };
            (result.film_load * PlateResult::ratio(1.0, plate), of, " in the mean")
        }
        // A solver returns the kind of result that belongs to the scene.
        _ => return String::new(),
    };
    // A share of nearly 100 % is not rounded to 100 %.
    let percent = match 100.0 * share.abs() {
        percent if percent > 99.0 && percent < 100.0 => format!("{} %", as_given(100.0 - rounded(100.0 - percent, 2))),
        percent => format!("{} %", rounded(percent, 2)),
    };
    match share {
        _ if !share.is_finite() => "what it carries here is not known".to_owned(),
        _ if sucks(Estimate { value: share, error }) => {
            let fast = match &problem.scenario {
                Scenario::Motor(motor) if mach(motor) > 1.0 => ", where the faces slide beyond the speed of sound",
                _ => "",
            };
            format!("here its mean pressure is below ambient{fast}: it pulls the faces together with {percent} of {of}")
        }
        _ if share.abs() <= error => "here its load cannot be distinguished from zero".to_owned(),
        _ if share < HARDLY => format!("here it hardly matters: it carries {percent} of {of}{rest}"),
        _ => format!("here it carries {percent} of {of}{rest}"),
    }
}

/// Whether a film load is truly negative: beyond its error, and by more than round-off.
pub fn sucks(load: Estimate) -> bool {
    load.value + load.error.abs() < -NOTHING
}

/// Meaning of the bearing number Λ in words, compared with the squeeze number.
pub fn bearing(numbers: &Dimensionless) -> &'static str {
    match (numbers.bearing_number, numbers.bearing_to_squeeze) {
        (0.0, _) => "nothing slides",
        (_, ratio) if ratio < 0.01 => "≪ σ: sliding drags in almost no gas",
        (_, ratio) if ratio < 0.3 => "< σ: sliding carries a small part of the gas that squeezing displaces",
        _ => "not ≪ σ: sliding carries about as much gas as squeezing displaces, or more",
    }
}

/// Meaning of the Knudsen number in words, and the place in the film for which it holds.
pub fn knudsen(problem: &Problem, outcome: &Outcome) -> String {
    let at = match (&problem.scenario, outcome) {
        (_, Outcome::Motor(MotorResult { levitated: true, .. })) => {
            "at the minimum spacing, above which the rotor floats"
        }
        (Scenario::Motor(Motor { surface, .. }), _) if surface.asperities.is_some() => {
            "at the mean gap if all teeth carried alike"
        }
        (Scenario::Motor(_), _) => "at the minimum spacing",
        (Scenario::Plate(_), _) => "at the mean gap",
    };
    let gas = match &problem.scenario {
        Scenario::Motor(motor) => &motor.gas,
        Scenario::Plate(plate) => &plate.gas,
    };
    let says = match Dimensionless::of(problem).knudsen_number {
        kn if kn < 0.01 => "slip at the walls hardly matters",
        kn if kn < 0.1 => "slip at the walls matters a little",
        kn if kn < 1.0 => "slip at the walls matters, and so does the choice of slip law",
        kn if (1.0..kn).contains(&SlipLaw::of(gas).knudsen_limit()) => {
            "the gas is so rarefied that its slip law is extrapolated"
        }
        _ => "the gas is rarefied; of the slip laws only fukui-kaneko is made for this",
    };
    format!("{at}: {says}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn words(alpha: f64, alpha_error: f64, changes: &[(&str, &str)]) -> String {
        let scene = Scene::motor().with(changes).unwrap();
        let result = MotorResult { alpha: Estimate { value: alpha, error: alpha_error }, ..MotorResult::default() };
        weight(&Problem::try_from(&scene).unwrap(), &Outcome::Motor(result))
    }

    #[test]
    fn words_follow_the_result() {
        for (alpha, error, said) in [
            (0.246, 1e-3, "here it carries 25 % of the load, and contact the rest"),
            (0.99717, 1e-4, "here it carries 99.72 % of the load, and contact the rest"),
            (4e-7, 1e-8, "here it hardly matters: it carries 0.00004 % of the load, and contact the rest"),
            (4e-7, 1e-6, "here its load cannot be distinguished from zero"),
            (-0.002, 0.0021, "here its load cannot be distinguished from zero"),
            (-0.02, 0.002, "here its mean pressure is below ambient: it pulls the faces together with 2 % of the load"),
            (f64::NAN, 0.0, "what it carries here is not known"),
        ] {
            assert_eq!(words(alpha, error, &[]), said);
        }
        let fast = [("motor.contact_radius_mm", "500"), ("motor.rotor_speed_rpm", "10000")];
        assert!(words(-0.02, 0.002, &fast).contains("beyond the speed of sound"));
        assert!(!words(0.02, 0.002, &fast).contains("pulls"));
    }

    #[test]
    fn words_follow_what_leaks() {
        let said = |scene: &Scene, key: &str, value: &str| {
            let problem = Problem::try_from(&scene.with([(key, value)]).unwrap()).unwrap();
            let outcome = match &problem.scenario {
                Scenario::Motor(_) => Outcome::Motor(MotorResult::default()),
                Scenario::Plate(_) => Outcome::Plate(PlateResult::default()),
            };
            squeeze(&problem, &outcome)
        };
        let (motor, strip) = (Scene::motor(), Scene::plate());
        for (scene, khz, within, is) in [
            // 24.04 µm of a contact width of 0.3 mm; it grows with 1/√f.
            (&motor, "30", "only within 24 µm", "a spring"),
            (&motor, "3", "within 76 µm", "both spring and damper"),
            (&motor, "0.05", "out and back in everywhere", "a damper"),
            (&strip, "30", "only within 83 µm", "a spring"),
        ] {
            let key = if std::ptr::eq(scene, &motor) { "stator.frequency_khz" } else { "plate.frequency_khz" };
            let words = said(scene, key, khz);
            assert!(words.contains(within) && words.ends_with(is), "{khz} kHz: {words}");
        }
        // √(h² + 6λh), from 200 nm to 749 nm.
        let floating = Problem::try_from(&motor).unwrap();
        let result =
            MotorResult { levitated: true, min_film_thickness: Estimate::exact(749e-9), ..MotorResult::default() };
        let words = squeeze(&floating, &Outcome::Motor(result));
        assert!(words.starts_with("where the film is thinnest, 749 nm,") && words.contains("within 65 µm"), "{words}");
        // A plate that nearly touches is a damper only during the part of the cycle when it is far away.
        let words = said(&strip, "plate.amplitude_um", "0.4999");
        assert!(words.ends_with("the film is a spring") && !words.contains("closest"), "{words}");
        let slow = Scene::plate().with([("plate.frequency_khz", "0.003"), ("plate.amplitude_um", "0.99")]).unwrap();
        let words = said(&slow, "plate.length_mm", "1");
        assert!(words.contains("a damper; where it is closest, gas leaks within"), "{words}");
        // In a narrow rectangle, gas leaks along the whole length.
        assert!(said(&strip, "plate.width_mm", "0.1").contains("both spring and damper"));
    }

    #[test]
    fn a_plate_is_measured_by_ambient_pressure() {
        let problem = Problem::try_from(&Scene::plate()).unwrap();
        // p_a × 1 mm = 101.325 N/m.
        let of = |film_load: f64| {
            let result =
                PlateResult { film_load: Estimate { value: film_load, error: 1e-6 }, ..PlateResult::default() };
            weight(&problem, &Outcome::Plate(result))
        };
        assert_eq!(of(10.1325), "here it carries 10 % of p_a × length in the mean");
        assert_eq!(of(0.0101325), "here it hardly matters: it carries 0.01 % of p_a × length in the mean");
    }
}
