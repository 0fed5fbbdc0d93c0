//! A case inside each limit and one outside.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use squeezefilm::analysis::validity::{ExceededLimit, NAMES, mach, names, of_outcome, outside};
use squeezefilm::control::Cancel;
use squeezefilm::estimate::Estimate;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::film::slip::{FukuiKaneko, Mobility, SlipLaw};
use squeezefilm::plan::{Choice, Decision};
use squeezefilm::problem::{Gas, Problem, Scenario, Slip};
use squeezefilm::recording::Recording;
use squeezefilm::scene::{Scene, presets};
use squeezefilm::solution::{MotorResult, Outcome, Solution};
use squeezefilm::solve::{Settings, solve};

fn of(scene: &Scene, changes: &[(&str, &str)]) -> Vec<ExceededLimit> {
    of_outcome(&Problem::try_from(&scene.with(changes).unwrap()).unwrap(), None, &[])
}

/// 1 mm long, 1 µm ± 0.5 µm, 30 kHz, unless changed.
fn plate(changes: &[(&str, &str)]) -> Vec<ExceededLimit> {
    of(&Scene::plate(), changes)
}

fn motor(changes: &[(&str, &str)]) -> Vec<ExceededLimit> {
    of(&Scene::motor(), changes)
}

#[track_caller]
fn check(found: &[ExceededLimit], name: &str, value: f64, limit: f64) {
    let excess = found.iter().find(|excess| excess.name == name).unwrap_or_else(|| panic!("{name}: {found:?}"));
    assert!((excess.value / value - 1.0).abs() < 2e-3, "{excess:?}");
    assert!((excess.limit / limit - 1.0).abs() < 2e-3, "{excess:?}");
    assert!(NAMES.contains(&name));
    // One sentence.
    assert!(excess.text.ends_with('.') && !excess.text.contains(". "), "{excess:?}");
}

fn solve_draft(problem: &Problem) -> Solution {
    let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
    solve(problem, &settings, &mut (), &Cancel::new()).unwrap()
}

/// Of a motor whose film is `min_gap` thin, without contact.
fn solution(min_gap: f64) -> Solution {
    let mut solution = solve_draft(&Problem::try_from(&Scene::plate()).unwrap());
    solution.outcome =
        Outcome::Motor(MotorResult { min_film_thickness: Estimate::exact(min_gap), ..MotorResult::default() });
    solution.recording = Recording::default();
    solution
}

#[test]
fn density_heat_and_sound_are_those_of_the_gas() {
    let far = [("plate.mean_gap_um", "500"), ("plate.frequency_khz", "40"), ("film.gas", "helium")];
    let found = plate(&far);
    // 101325 Pa/(2077.3 J/(kg K) · 293.15 K) = 0.16639 kg/m³; 0.16639 · 251 327/s · (0.5 mm)²/(12 · 19.62 µPa·s).
    check(&found, "gas-inertia", 44.40, 0.1);
    // κ = 19.62e-6/(0.16639 · 0.664) = 1.776e-4 m²/s, depth 37.59 µm.
    check(&found, "isothermal", 500.0 / 37.59, 1.0);
    assert!(found[0].text.contains("helium at 20 °C"), "{found:?}");
    // Helium carries sound at 1007 m/s: a motor at Mach 1.2 in air is slow in it.
    let fast = [
        ("stator.frequency_khz", "100"),
        ("stator.tangential_amplitude_um", "0.66"),
        ("motor.rotor_speed_rpm", "3000"),
    ];
    let motor = |gas| {
        let scene = Scene::motor().with(fast.into_iter().chain([("film.gas", gas)])).unwrap();
        match Problem::try_from(&scene).unwrap().scenario {
            Scenario::Motor(motor) => mach(&motor),
            Scenario::Plate(_) => f64::NAN,
        }
    };
    assert!((motor("air") / motor("helium") - 1007.0 / 343.4).abs() < 5e-3);
}

#[test]
fn a_plate_far_above_a_wall() {
    let found = plate(&[("plate.mean_gap_um", "500"), ("plate.frequency_khz", "40")]);
    assert_eq!(names(&found), ["gas-inertia", "isothermal", "thinness"]);
    // 1.2041 kg/m³ · 251 327/s · (0.5 mm)²/(12 · 18.1 µPa·s).
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
    // However slow: Re/σ = 1.2041 · 101 325 · h⁴/(144 · (18.1 µPa·s)² · 1 mm²), 0.015 at 8.73 µm.
    let slow = |gap: &str| plate(&[("plate.frequency_khz", "0.01"), ("plate.mean_gap_um", gap)]);
    assert_eq!(names(&slow("8.7")), Vec::<&str>::new());
    let found = slow("17.5");
    // 62.83/s: Re = 1.2041 · 62.83 · 3.0625e-10/2.172e-4, σ = 2.172e-4 · 62.83 · 1e-6/(101 325 · 3.0625e-10).
    check(&found, "gas-inertia", 1.0667e-4, 0.015 * 4.3978e-4);
    assert!(found[0].text.contains("1.66 times the mean load"), "{found:?}");
}

fn names_of(found: Vec<ExceededLimit>) -> Vec<&'static str> {
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
        let gas = Gas { ambient_pressure: 1e5, viscosity: 18e-6, mean_free_path: 1.0, slip, ..Gas::default() };
        let off = |kn: f64| (SlipLaw::of(&gas).at(1.0 / kn).0 / exact.at(1.0 / kn).0 - 1.0).abs();
        let worst = (1..=500).map(|i| off(limit * f64::from(i) / 500.0)).fold(0.0, f64::max);
        assert!((0.06..0.1).contains(&worst), "{slip:?}: {worst}");
        assert!(off(2.0 * limit) > 0.1, "{slip:?}");
    }
}

#[test]
fn sound() {
    // 343.2 m/s over 100 kHz: 3.432 mm. Viscous at 1 µm: Re = 0.0035.
    let at = |length: &str| {
        plate(&[("film.slip", "fukui-kaneko"), ("plate.frequency_khz", "100"), ("plate.length_mm", length)])
    };
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
fn faces_that_are_pressed_into_each_other() {
    // 2.45 N on 9 × 1.7353 mm × 0.3 mm: 0.5229 MPa; K = 4/3 · 60 GPa · 10⁴/mm² · √(50 µm) · (0.1 µm)^{3/2}.
    let at = |modulus: &str| motor(&[("surface.model", "asperities"), ("surface.elastic_modulus_gpa", modulus)]);
    assert!(!names(&at("60")).contains(&"roughness"));
    // Summits of rubber carry it below the mean plane only.
    check(&at("0.03"), "roughness", 100.0, 2.0);
    // With a hard stop the flow factors judge the spacing itself.
    let flows = |rms: &str| motor(&[("surface.flow_factors", "patir-cheng"), ("surface.rms_nm", rms)]);
    assert!(!names(&flows("399")).contains(&"roughness"));
    check(&flows("500"), "roughness", 2.5, 2.0);
}

#[test]
fn a_contact_nearly_as_wide_as_its_ring() {
    let ring = [("motor.contact_radius_mm", "4.5"), ("stator.tooth_width_mm", "0.4")];
    let at = |width: &str| motor(&[&ring[..], &[("rotor.contact_width_mm", width)]].concat());
    assert!(!names(&at("0.9")).contains(&"curvature"));
    check(&at("9"), "curvature", 2.0, 0.2);
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
fn a_gas_that_is_no_longer_ideal() {
    let problem = Problem::try_from(&Scene::motor()).unwrap();
    let with = |pressure: f64| {
        let mut solution = solution(2e-7);
        let Outcome::Motor(result) = &mut solution.outcome else { panic!("a motor") };
        result.max_pressure.value = pressure;
        outside(&problem, &solution)
    };
    assert!(!names(&with(4.9e6)).contains(&"dense-gas"));
    check(&with(20e6), "dense-gas", 20.0, 5.0);
    let scene = presets::find("plate-trapped").unwrap().with([("plate.amplitude_um", "0.999")]).unwrap();
    let problem = Problem::try_from(&scene).unwrap();
    assert!(names(&outside(&problem, &solve_draft(&problem))).contains(&"dense-gas"));
}

#[test]
fn contact_against_yield() {
    let problem = Problem::try_from(&Scene::motor()).unwrap();
    // On 0.3 mm 82.8 kN/m are 276 MPa.
    let with = |contact: f64| {
        let mut solution = solution(2e-7);
        let Outcome::Motor(result) = &mut solution.outcome else { panic!("a motor") };
        result.max_contact = contact;
        outside(&problem, &solution)
    };
    assert!(!names(&with(82.7e3)).contains(&"contact-stress"));
    let found = with(120e3);
    check(&found, "contact-stress", 400.0, 276.0);
    assert_eq!(found.last().map(|excess| excess.unit), Some("MPa"));
    // Summits 50 µm round of faces 100 nm rough: E*/H √(σ/R) = 54/0.773 √0.002; as many of 0.5 mm that are 10 nm high stay elastic.
    let rough = |rms: &str, radius: &str| {
        let set = [("surface.rms_nm", rms), ("surface.summit_radius_um", radius)];
        let problem = Problem::try_from(&presets::find("asperities").unwrap().with(set).unwrap()).unwrap();
        let mut solution = solution(2e-7);
        let Outcome::Motor(result) = &mut solution.outcome else { panic!("a motor") };
        result.max_contact = 1.0;
        outside(&problem, &solution)
    };
    check(&rough("100", "50"), "contact-stress", 3.125, 1.0);
    assert!(!names(&rough("10", "500")).contains(&"contact-stress"));
    // Of a ring it is what its lowest part is made of.
    let scene = Scene::motor().with([("rotor.model", "ring")]).unwrap();
    let mut solution = solution(2e-7);
    let Outcome::Motor(result) = &mut solution.outcome else { panic!("a motor") };
    result.max_contact = 120e3;
    let found = outside(&Problem::try_from(&scene).unwrap(), &solution);
    let stress = found.iter().find(|excess| excess.name == "contact-stress").unwrap();
    assert!(stress.text.contains("PEEK yields at 98 MPa"), "{}", stress.text);
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
    let at = |amplitude: &str| plate(&[("film.slip", "fukui-kaneko"), ("plate.amplitude_um", amplitude)]);
    assert!(at("0.899").is_empty());
    let found = at("0.99");
    assert_eq!(names(&found), ["amplitude"]);
    check(&found, "amplitude", 0.99, 0.9);
    assert!(found[0].text.contains("within 10 nm"), "{found:?}");
    // Trapped gas: what 1 % of the amplitude changes there.
    let load = |e: f64| ((1.0 + 1.5 * e * e) / (1.0 - e * e)).sqrt() - 1.0;
    assert!((load(1.01 * 0.9) / load(0.9) - 1.073).abs() < 1e-3);
}

#[test]
fn a_floating_rotor_is_judged_where_it_floats() {
    let problem = Problem::try_from(&Scene::motor()).unwrap();
    assert_eq!(names(&outside(&problem, &solution(2e-7))), ["slip-law"]);
    assert_eq!(names(&outside(&problem, &solution(2e-6))), Vec::<&str>::new());
    // Re = 1.2041 · 188 496 · (21.3 µm)²/2.172e-4.
    let high = outside(&problem, &solution(20e-6));
    check(&high, "gas-inertia", 0.4741, 0.1);
    assert_eq!(names(&outside(&problem, &solution(f64::NAN))), ["slip-law"]);
}

/// First-order slip, the paper's, is outside its range in every motor of the paper, and under the plates that come within 500 nm; ground faces are
/// pressed flat; nothing else is outside.
#[test]
fn built_in_presets_show_what_they_should() {
    for preset in presets::BUILT_IN {
        let (name, problem) = (preset.name, Problem::try_from(&preset.scene().unwrap()).unwrap());
        // The published plate is one without slip, at Kn = 0.013; the law of Fukui and Kaneko holds at every spacing of a motor. Plates that
        // float are micrometres away.
        let slips = match &problem.scenario {
            Scenario::Motor(motor) => motor.gas.slip == Slip::FirstOrder,
            Scenario::Plate(plate) => plate.load.is_none(),
        };
        let closed: &[&str] = if slips { &["slip-law"] } else { &[] };
        assert_eq!(names(&of_outcome(&problem, None, &[])), closed, "{name}, unsolved");
        // A rotor that floats 0.74 µm high never closes the film.
        let expected = match name {
            "levitating" => &[],
            "asperities" | "rough-flow" => &["slip-law", "contact-stress"][..],
            _ => closed,
        };
        let found = outside(&problem, &solve_draft(&problem));
        assert_eq!(names(&found), expected, "{name}: {found:?}");
    }
}

#[test]
fn rotor_resonance() {
    let problem = Problem::try_from(&Scene::motor()).unwrap();
    // The wave's harmonics are at 30, 60 and 90 kHz.
    let judged = |natural: [f64; 3]| {
        let mut solved = solution(200e-9);
        let chosen = Choice::Rotor { error: 1e-3, ring: true, resonances: Some(natural) };
        solved.model.decisions = vec![Decision { chosen, overruled: false, effect: 1e-3, weighed: None }];
        outside(&problem, &solved).into_iter().find(|excess| excess.name == "rotor-resonance")
    };
    assert_eq!(judged([101e3, 250e3, 500e3]), None);
    let found = [judged([101e3, 150e3, 500e3]).unwrap()];
    check(&found, "rotor-resonance", 0.4, 0.3);
    assert!(found[0].text.contains("Harmonic 2 of the wave drives the rotor at 60 kHz"), "{found:?}");
    assert!(
        found[0].text.contains("14 waves round the ring, is 150 kHz") && found[0].text.contains("1.19 times"),
        "{found:?}"
    );
    assert!(judged([30.01e3, 1e6, 1e6]).unwrap().text.contains("its mass, which is left out, decides"));
    // A beam has no mass.
    assert!(!names(&outside(&problem, &solution(200e-9))).contains(&"rotor-resonance"));
}
