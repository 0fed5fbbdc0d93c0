//! Where the model is out of its depth: what it leaves out, as a number beside the limit up to which that is right.
//!
//! With h the gap in which the gas moves: the mean gap of a plate; of a motor, the least film thickness and the amplitude, which
//! is the mean gap under a rotor that rides on the crests. And with s the shorter side of plate or tooth top, over which the gas leaves:
//!
//! | name | number | limit | because |
//! | --- | --- | --- | --- |
//! | `gas-inertia` | Re = ωρh²/(12μ) | 0.1, or 0.015 σ if less | the flow lags the pressure by 1.2 Re; inertia adds 6.9 Re/σ to the mean load |
//! | `isothermal` | h/√(2κ/ω) | 1 | there the compressibility of the gas is off by 5 % |
//! | `slip-law` | Kn = λ_a/h, h closed | 0.01, 0.1, 0.6, 88.6 | within 10 % of the Boltzmann equation's flow; end of the fit |
//! | `sound` | s over the wavelength of sound | 1; ½ if Re is above its limit | the edges are at ambient pressure; waves stand in the film |
//! | `sound` | sliding speed over that of sound | 1 | shear heats the gas by 4 % |
//! | `contact-stress` | greatest contact pressure | 276 MPa | aluminium 6061-T6 yields |
//! | `thinness` | h/s | 0.025 | the gas beyond the edges adds 3 % to s, 10 % to the damping |
//! | `amplitude` | amplitude/mean gap of a plate | 0.9 | 1 % of the gap is 7 % of the load |
//!
//! Derivations and sources are in `docs/theory.md`, section 9. `rotor-resonance` is not judged: a compliance has no mass.
//!
//! **The gas is taken to be air at 20 °C** as far as density and sound go: a scene has no species yet. Kinetic theory gives
//! ρ = πμ²/(2 p_a λ_a²), which is air's within 3 % for the preset values; but λ_a may be 0, and stays what it was while pressure
//! is swept. The thermal diffusivity κ = μ/(ρ Pr) follows the viscosity that is given.

use crate::film::slip::{FukuiKaneko, Mobility, SlipLaw};
use crate::problem::{Gas, Motor, Plate, Problem, Scenario, Slip};
use crate::solution::{Outcome, Solution};
use std::f64::consts::{PI, TAU};

/// Specific gas constant of air \[J/(kg K)\].
const GAS_CONSTANT: f64 = 287.05;
/// 20 °C \[K\].
const TEMPERATURE: f64 = 293.15;
/// Ratio of the specific heats of air.
const HEAT_RATIO: f64 = 1.4;
/// Prandtl number of air.
const PRANDTL: f64 = 0.71;

/// Greatest Re.
const INERTIA: f64 = 0.1;
/// Greatest Re/σ: the mean load that inertia gives, over that of a viscous film, is [`INERTIAL_LOAD`] times that.
const INERTIA_TO_SQUEEZE: f64 = 0.015;
/// (1/14)/(1/96), the two mean loads of a strip as σ → 0.
const INERTIAL_LOAD: f64 = 48.0 / 7.0;
/// Greatest gap over the thermal depth.
const THERMAL_DEPTHS: f64 = 1.0;
/// Greatest side over the wavelength of sound, where the film is too viscous for waves …
const WAVELENGTHS: f64 = 1.0;
/// … and where it is not: half a wave stands under it.
const WAVELENGTHS_IN_THE_FILM: f64 = 0.5;
/// Greatest sliding speed over that of sound.
const MACH: f64 = 1.0;
/// Yield stress of aluminium 6061-T6 \[MPa\].
const YIELD_MPA: f64 = 276.0;
/// Greatest gap over the shorter side.
const THINNESS: f64 = 0.025;
/// By how much the gas beyond the edges lengthens a side, over the gap.
const ELONGATION: f64 = 1.3;
/// Greatest amplitude of a plate over its mean gap.
const AMPLITUDE: f64 = 0.9;

/// One limit that a scene exceeds.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Excess {
    /// Its name in JSON: `gas-inertia`.
    pub name: &'static str,
    /// The number, above …
    pub value: f64,
    /// … what it may be.
    pub limit: f64,
    /// Unit of both; empty for a pure number.
    pub unit: &'static str,
    /// What that means, in a sentence.
    pub text: String,
}

/// The limits that a scene exceeds; none if the model is within its depth. Without a solution: what the scene alone tells,
/// with a closed film of a motor at its minimum spacing, and no contact. The cost is a look at every recorded contact load.
pub fn outside(problem: &Problem, solution: Option<&Solution>) -> Vec<Excess> {
    match &problem.scenario {
        Scenario::Motor(motor) => of_motor(motor, solution),
        Scenario::Plate(plate) => of_plate(plate),
    }
}

/// Sliding speed of a motor's faces over the speed of sound, at its greatest.
pub fn mach(motor: &Motor) -> f64 {
    (motor.rotor_speed.abs() + TAU * motor.frequency * motor.tangential_amplitude) / speed_of_sound()
}

fn of_motor(motor: &Motor, solution: Option<&Solution>) -> Vec<Excess> {
    let reached = solution.and_then(|solution| match &solution.outcome {
        Outcome::Motor(result) => Some(result.min_gap),
        Outcome::Plate(_) => None,
    });
    let closed = reached.filter(|gap| gap.is_finite()).unwrap_or(motor.min_spacing);
    let film = Film {
        gas: &motor.gas,
        omega: TAU * motor.frequency,
        gap: closed + motor.normal_amplitude,
        closed,
        side: motor.tooth_width.min(motor.contact_width),
        amplitude: motor.normal_amplitude,
        body: "tooth top",
    };
    let contact = solution.map_or(0.0, |solution| solution.recording.contact.iter().copied().fold(0.0, f64::max));
    let found = [
        film.inertia(),
        film.heat(),
        film.slip(),
        film.sound(),
        sliding(motor),
        stress(contact / motor.contact_width),
        film.thinness(),
    ];
    found.into_iter().flatten().collect()
}

fn of_plate(plate: &Plate) -> Vec<Excess> {
    let film = Film {
        gas: &plate.gas,
        omega: TAU * plate.frequency,
        gap: plate.mean_gap,
        closed: plate.mean_gap,
        side: plate.width.map_or(plate.length, |width| width.min(plate.length)),
        amplitude: plate.amplitude,
        body: "plate",
    };
    let found = [film.inertia(), film.heat(), film.slip(), film.sound(), film.thinness(), nearness(plate)];
    found.into_iter().flatten().collect()
}

/// What most limits are about. In SI units.
struct Film<'a> {
    gas: &'a Gas,
    omega: f64,
    /// h.
    gap: f64,
    /// h closed, for the Knudsen number.
    closed: f64,
    /// s.
    side: f64,
    amplitude: f64,
    body: &'static str,
}

impl Film<'_> {
    fn density(&self) -> f64 {
        self.gas.ambient_pressure / (GAS_CONSTANT * TEMPERATURE)
    }

    /// Re.
    fn reynolds(&self) -> f64 {
        self.omega * self.density() * self.gap * self.gap / (12.0 * self.gas.viscosity)
    }

    fn inertia(&self) -> Option<Excess> {
        let value = self.reynolds();
        let sigma = 12.0 * self.gas.viscosity * self.omega * (self.side / self.gap).powi(2) / self.gas.ambient_pressure;
        let (limit, text) = if value > INERTIA {
            let text = format!(
                "The gas has inertia in a gap of {} µm (ωρh²/12μ = {}, air at 20 °C), which the film equation leaves out.",
                rounded(self.gap * 1e6),
                rounded(value)
            );
            (INERTIA, text)
        } else {
            let text = format!(
                "In so viscous a film (gap {} µm) the inertia of the gas, which the film equation leaves out, adds about {} times the \
                 mean load that is computed.",
                rounded(self.gap * 1e6),
                rounded(INERTIAL_LOAD * value / sigma)
            );
            (INERTIA_TO_SQUEEZE * sigma, text)
        };
        excess("gas-inertia", value, limit, "", text)
    }

    fn heat(&self) -> Option<Excess> {
        let diffusivity = self.gas.viscosity / (self.density() * PRANDTL);
        let depth = (2.0 * diffusivity / self.omega).sqrt();
        let value = self.gap / depth;
        let text = format!(
            "A gap of {} µm is {} times as wide as heat travels in a cycle ({} µm): the gas is warmed and cooled as it is squeezed, and \
             not isothermal.",
            rounded(self.gap * 1e6),
            rounded(value),
            rounded(depth * 1e6)
        );
        excess("isothermal", value, THERMAL_DEPTHS, "", text)
    }

    fn slip(&self) -> Option<Excess> {
        let gas = self.gas;
        let value = gas.mean_free_path / self.closed;
        let (limit, law) = match gas.slip {
            Slip::None => (0.01, "flow without slip"),
            Slip::FirstOrder => (0.1, "first-order slip"),
            Slip::SecondOrder => (0.6, "second-order slip"),
            // The fit begins at D = 0.01.
            Slip::FukuiKaneko => (50.0 * PI.sqrt(), ""),
        };
        let text = if gas.slip == Slip::FukuiKaneko {
            format!(
                "The fit of Fukui and Kaneko ends before Kn = {}; beyond, the flow is extrapolated.",
                rounded(value)
            )
        } else {
            let exact = FukuiKaneko { mean_free_path: gas.mean_free_path.max(f64::MIN_POSITIVE) };
            let ratio = SlipLaw::of(gas).at(self.closed).0 / exact.at(self.closed).0;
            format!(
                "At Kn = {} {law} lets {} % {} gas flow than the Boltzmann equation, which the law of Fukui and Kaneko (film.slip) follows.",
                rounded(value),
                (100.0 * (ratio - 1.0)).abs().round(),
                if ratio < 1.0 { "less" } else { "more" }
            )
        };
        excess("slip-law", value, limit, "", text)
    }

    fn sound(&self) -> Option<Excess> {
        let wavelength = TAU * speed_of_sound() / self.omega;
        let value = self.side / wavelength;
        let across = format!(
            "The {} is {} wavelengths of sound across ({} mm, air at 20 °C)",
            self.body,
            rounded(value),
            rounded(wavelength * 1e3)
        );
        let (limit, text) = if self.reynolds() > INERTIA {
            (WAVELENGTHS_IN_THE_FILM, format!("{across}: sound waves can stand in the film, and are left out."))
        } else {
            let pressure = 100.0 * HEAT_RATIO * TAU * self.amplitude / wavelength;
            let text = format!(
                "{across}: its edges are taken to be at ambient pressure, and the sound around it, up to {} % of that, is left out.",
                rounded(pressure)
            );
            (WAVELENGTHS, text)
        };
        excess("sound", value, limit, "", text)
    }

    fn thinness(&self) -> Option<Excess> {
        let value = self.gap / self.side;
        let text = format!(
            "A film {} µm thick is not thin under a {} {} mm across: the gas beyond the edges, which is left out, makes it act as if {} % \
             larger.",
            rounded(self.gap * 1e6),
            self.body,
            rounded(self.side * 1e3),
            rounded(100.0 * ELONGATION * value)
        );
        excess("thinness", value, THINNESS, "", text)
    }
}

fn sliding(motor: &Motor) -> Option<Excess> {
    let value = mach(motor);
    let text = format!(
        "The faces slide at up to {} m/s, {} times the speed of sound (air at 20 °C): shear warms the gas by some {} %, and it is not \
         isothermal.",
        rounded(value * speed_of_sound()),
        rounded(value),
        rounded(100.0 * PRANDTL * (HEAT_RATIO - 1.0) * value * value / 8.0)
    );
    excess("sound", value, MACH, "", text)
}

/// `pressure`: the greatest contact pressure \[Pa\].
fn stress(pressure: f64) -> Option<Excess> {
    let value = pressure * 1e-6;
    let text = format!(
        "Contact presses with up to {} MPa; a rotor of aluminium 6061-T6 yields at {YIELD_MPA} MPa, and the model is elastic.",
        rounded(value)
    );
    excess("contact-stress", value, YIELD_MPA, "MPa", text)
}

fn nearness(plate: &Plate) -> Option<Excess> {
    let text = format!(
        "The plate comes within {} nm of the wall: the load hangs on faces smoother and more parallel than that, and 1 % of gap or \
         amplitude is 7 % of it or more.",
        rounded((plate.mean_gap - plate.amplitude) * 1e9)
    );
    excess("amplitude", plate.amplitude / plate.mean_gap, AMPLITUDE, "", text)
}

fn speed_of_sound() -> f64 {
    (HEAT_RATIO * GAS_CONSTANT * TEMPERATURE).sqrt()
}

fn excess(name: &'static str, value: f64, limit: f64, unit: &'static str, text: String) -> Option<Excess> {
    (value > limit).then_some(Excess { name, value, limit, unit, text })
}

/// To three digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Cancel;
    use crate::fidelity::Fidelity;
    use crate::recording::Recording;
    use crate::scene::{Scene, presets};
    use crate::solution::MotorResult;
    use crate::solve::{Settings, solve};

    fn of(mut scene: Scene, changes: &[(&str, &str)]) -> Vec<Excess> {
        scene.set_all(changes.iter().copied()).unwrap();
        outside(&Problem::new(&scene).unwrap(), None)
    }

    /// 1 mm long, 1 µm ± 0.5 µm, 30 kHz, unless changed.
    fn plate(changes: &[(&str, &str)]) -> Vec<Excess> {
        of(Scene::plate(), changes)
    }

    fn motor(changes: &[(&str, &str)]) -> Vec<Excess> {
        of(Scene::motor(), changes)
    }

    fn names(found: &[Excess]) -> Vec<&str> {
        found.iter().map(|excess| excess.name).collect()
    }

    #[track_caller]
    fn check(found: &[Excess], name: &str, value: f64, limit: f64) {
        let excess = found.iter().find(|excess| excess.name == name).unwrap_or_else(|| panic!("{name}: {found:?}"));
        assert!((excess.value / value - 1.0).abs() < 2e-3, "{excess:?}");
        assert!((excess.limit / limit - 1.0).abs() < 2e-3, "{excess:?}");
        // One sentence.
        assert!(excess.text.ends_with('.') && !excess.text.contains(". "), "{excess:?}");
    }

    fn solve_draft(problem: &Problem) -> Solution {
        let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
        solve(problem, &settings, &mut (), &Cancel::new()).unwrap()
    }

    /// Of a motor whose film is `min_gap` thin, without contact.
    fn solution(min_gap: f64) -> Solution {
        let mut solution = solve_draft(&Problem::new(&Scene::plate()).unwrap());
        solution.outcome = Outcome::Motor(MotorResult { min_gap, ..MotorResult::default() });
        solution.recording = Recording::default();
        solution
    }

    #[test]
    fn a_plate_far_above_a_wall() {
        let found = plate(&[("plate.mean_gap_um", "500"), ("plate.frequency_khz", "40")]);
        assert_eq!(names(&found), ["gas-inertia", "isothermal", "thinness"]);
        // 1.2041 kg/m³ · 251 327/s · (0.5 mm)²/(12 · 18.1 µPa s).
        check(&found, "gas-inertia", 348.3, 0.1);
        // κ = 18.1e-6/(1.2041 · 0.71) = 2.117e-5 m²/s, depth 12.98 µm.
        check(&found, "isothermal", 500.0 / 12.98, 1.0);
        check(&found, "thinness", 0.5, 0.025);
        assert!(found[0].text.contains("500 µm") && found[1].text.contains("38.5 times"), "{found:?}");
    }

    #[test]
    fn gas_inertia() {
        // 1.2041 · 188 496 · h²/2.172e-4: 0.1 at 9.784 µm. σ = 2.172e-4 · 188 496 · 25e-6/(101 325 h²) = 106.
        let at = |gap: &str| names_of(plate(&[("plate.length_mm", "5"), ("plate.mean_gap_um", gap)]));
        assert_eq!(at("9.7"), Vec::<&str>::new());
        assert_eq!(at("9.9"), ["gas-inertia"]);
        // However slow: Re/σ = 1.2041 · 101 325 · h⁴/(144 · (18.1 µPa s)² · 1 mm²), 0.015 at 8.73 µm.
        let slow = |gap: &str| plate(&[("plate.frequency_khz", "0.01"), ("plate.mean_gap_um", gap)]);
        assert_eq!(names(&slow("8.7")), Vec::<&str>::new());
        let found = slow("17.5");
        // 62.83/s: Re = 1.2041 · 62.83 · 3.0625e-10/2.172e-4, σ = 2.172e-4 · 62.83 · 1e-6/(101 325 · 3.0625e-10).
        check(&found, "gas-inertia", 1.0667e-4, 0.015 * 4.3978e-4);
        assert!(found[0].text.contains("1.66 times the mean load"), "{found:?}");
    }

    fn names_of(found: Vec<Excess>) -> Vec<&'static str> {
        found.into_iter().map(|excess| excess.name).collect()
    }

    #[test]
    fn isothermal() {
        // Depth at 30 kHz √(2 · 2.117e-5/188 496) = 14.99 µm.
        let at = |gap: &str| plate(&[("plate.length_mm", "100"), ("plate.mean_gap_um", gap)]);
        assert!(!names(&at("14.9")).contains(&"isothermal"));
        check(&at("30"), "isothermal", 30.0 / 14.987, 1.0);
        // A gas of ten times the viscosity carries its heat ten times as fast.
        let thick = [("plate.length_mm", "100"), ("plate.mean_gap_um", "30"), ("film.viscosity_upa_s", "181")];
        assert!(!names(&plate(&thick)).contains(&"isothermal"));
    }

    #[test]
    fn knudsen_numbers_against_the_slip_law() {
        let at = |slip: &str, path: &str| motor(&[("film.slip", slip), ("film.mean_free_path_nm", path)]);
        // H_m = 200 nm.
        for (slip, inside, outside, value, limit) in [
            ("none", "1.9", "2.1", 0.0105, 0.01),
            ("first-order", "19.9", "64", 0.32, 0.1),
            ("second-order", "119", "128", 0.64, 0.6),
            ("fukui-kaneko", "17700", "17800", 89.0, 88.62),
        ] {
            assert_eq!(names(&at(slip, inside)), Vec::<&str>::new(), "{slip}");
            let found = at(slip, outside);
            assert_eq!(names(&found), ["slip-law"]);
            check(&found, "slip-law", value, limit);
        }
        assert!(at("none", "0").is_empty() && at("fukui-kaneko", "0").is_empty());
        let found = motor(&[("film.min_spacing_nm", "5")]);
        // 6 Q_P/D = 188.6 at D = 0.0692, and 1 + 6 · 12.8 = 77.8.
        check(&found, "slip-law", 12.8, 0.1);
        assert!(found[0].text.contains("59 % less"), "{found:?}");
    }

    #[test]
    fn up_to_their_limits_slip_laws_are_within_a_tenth_of_the_boltzmann_equation() {
        let exact = FukuiKaneko { mean_free_path: 1.0 };
        for (slip, limit) in [(Slip::None, 0.01), (Slip::FirstOrder, 0.1), (Slip::SecondOrder, 0.6)] {
            let gas = Gas { ambient_pressure: 1e5, viscosity: 18e-6, mean_free_path: 1.0, slip };
            let off = |kn: f64| (SlipLaw::of(&gas).at(1.0 / kn).0 / exact.at(1.0 / kn).0 - 1.0).abs();
            let worst = (1..=500).map(|i| off(limit * f64::from(i) / 500.0)).fold(0.0, f64::max);
            assert!((0.06..0.1).contains(&worst), "{slip:?}: {worst}");
            assert!(off(2.0 * limit) > 0.1, "{slip:?}");
        }
    }

    #[test]
    fn sound() {
        // 343.2 m/s over 100 kHz: 3.432 mm. Viscous at 1 µm: Re = 0.0035.
        let at = |length: &str| plate(&[("plate.frequency_khz", "100"), ("plate.length_mm", length)]);
        assert_eq!(names(&at("3.4")), Vec::<&str>::new());
        let found = at("34.32");
        assert_eq!(names(&found), ["sound"]);
        check(&found, "sound", 10.0, 1.0);
        // 1.4 · 2π · 0.5 µm/3.432 mm.
        assert!(found[0].text.contains("0.128 %"), "{found:?}");
        // Re = 0.35 · 4 at 20 µm: half a wave is enough. The shorter side counts.
        let wide = |length: &str| {
            let changes = [("plate.frequency_khz", "100"), ("plate.mean_gap_um", "20"), ("plate.width_mm", length)];
            plate(&[&changes[..], &[("plate.length_mm", "20")]].concat())
        };
        assert!(!names(&wide("1.7")).contains(&"sound"));
        check(&wide("3.432"), "sound", 1.0, 0.5);
    }

    #[test]
    fn sliding_faster_than_sound() {
        // 0.5 m · 10 000 rpm = 523.6 m/s, and 0.19 m/s of the stator; 343.2 m/s.
        let turning = |rpm: &str| motor(&[("motor.contact_radius_mm", "500"), ("motor.rotor_speed_rpm", rpm)]);
        let found = turning("-10000");
        check(&found, "sound", 1.5261, 1.0);
        // 0.71 · 0.4 · 1.5261²/8.
        assert!(found.iter().any(|excess| excess.text.contains("8.27 %")), "{found:?}");
        assert!(!names(&turning("6500")).contains(&"sound"));
    }

    #[test]
    fn contact_against_yield() {
        let problem = Problem::new(&Scene::motor()).unwrap();
        // On 0.3 mm 82.8 kN/m are 276 MPa.
        let with = |contact: f64| {
            let mut solution = solution(2e-7);
            solution.recording.contact = vec![0.0, contact, 1.0];
            outside(&problem, Some(&solution))
        };
        assert!(!names(&with(82.7e3)).contains(&"contact-stress"));
        let found = with(120e3);
        check(&found, "contact-stress", 400.0, 276.0);
        assert_eq!(found.last().map(|excess| excess.unit), Some("MPa"));
    }

    #[test]
    fn thinness() {
        // 1.5 µm over the shorter side of a tooth top: 60 µm.
        assert!(!names(&motor(&[("rotor.contact_width_mm", "0.0605")])).contains(&"thinness"));
        check(&motor(&[("rotor.contact_width_mm", "0.03")]), "thinness", 0.05, 0.025);
        // The plate's shorter side is its width.
        let narrow = plate(&[("plate.width_mm", "0.02")]);
        check(&narrow, "thinness", 0.05, 0.025);
        assert!(narrow.iter().any(|excess| excess.text.contains("6.5 %")), "{narrow:?}");
    }

    #[test]
    fn an_amplitude_near_the_gap() {
        assert!(plate(&[("plate.amplitude_um", "0.899")]).is_empty());
        let found = plate(&[("plate.amplitude_um", "0.99")]);
        assert_eq!(names(&found), ["amplitude"]);
        check(&found, "amplitude", 0.99, 0.9);
        assert!(found[0].text.contains("within 10 nm"), "{found:?}");
        // Trapped gas: what 1 % of the amplitude changes there.
        let load = |e: f64| ((1.0 + 1.5 * e * e) / (1.0 - e * e)).sqrt() - 1.0;
        assert!((load(1.01 * AMPLITUDE) / load(AMPLITUDE) - 1.073).abs() < 1e-3);
    }

    #[test]
    fn a_floating_rotor_is_judged_where_it_floats() {
        let problem = Problem::new(&Scene::motor()).unwrap();
        assert_eq!(names(&outside(&problem, Some(&solution(2e-7)))), ["slip-law"]);
        assert_eq!(names(&outside(&problem, Some(&solution(2e-6)))), Vec::<&str>::new());
        // Re = 1.2041 · 188 496 · (21.3 µm)²/2.172e-4.
        let high = outside(&problem, Some(&solution(20e-6)));
        check(&high, "gas-inertia", 0.4741, 0.1);
        assert_eq!(names(&outside(&problem, Some(&solution(f64::NAN)))), ["slip-law"]);
    }

    /// First-order slip, the paper's, is outside its range in every motor of the paper; nothing else is.
    #[test]
    fn built_in_presets_show_what_they_should() {
        for preset in presets::BUILT_IN {
            let (name, problem) = (preset.name, Problem::new(&preset.scene().unwrap()).unwrap());
            // The published plate is one without slip, at Kn = 0.013.
            let slips = matches!(problem.scenario, Scenario::Motor(_)) || name == "plate-mems";
            let closed: &[&str] = if slips { &["slip-law"] } else { &[] };
            assert_eq!(names(&outside(&problem, None)), closed, "{name}, unsolved");
            // A rotor that floats 0.74 µm high never closes the film.
            let expected = if name == "levitating" { &[] } else { closed };
            let found = outside(&problem, Some(&solve_draft(&problem)));
            assert_eq!(names(&found), expected, "{name}: {found:?}");
        }
    }
}
