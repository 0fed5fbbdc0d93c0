//! Every number that a built-in lesson states, computed: a lesson must not say what the program does not.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use squeezefilm::analysis::quantity::{Numbers, Quantity};
use squeezefilm::analysis::torque::TorqueCurves;
use squeezefilm::control::{Cancel, Progress};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::film::exact;
use squeezefilm::hold::leak_time;
use squeezefilm::lessons::BUILT_IN;
use squeezefilm::plate::harmonic;
use squeezefilm::problem::{Outline, Problem, Scenario};
use squeezefilm::scene::{Scene, presets};
use squeezefilm::solution::{Harmonic, Performance, PlateResult, Solution};
use squeezefilm::solve::{Settings, solve};
use squeezefilm::startup;
use std::collections::BTreeMap;
use std::ops::Range;

/// What a lesson says, of which run, which number, its value, and how accurate it is meant, relative.
type Claim = (usize, &'static str, &'static str, &'static [&'static str], &'static str, f64, f64);

const SMALL: &str = "plate.amplitude_um=0.1";
const THIN: [&str; 3] = ["plate.mean_gap_um=0.2", "plate.amplitude_um=0.1", "plate.frequency_khz=0.4"];
const THICK: [&str; 4] =
    ["plate.mean_gap_um=5", "plate.amplitude_um=2.5", "plate.length_mm=5", "plate.frequency_khz=10"];

/// What lessons say of other runs than the one on screen: numbers of that one come from the run itself.
const CLAIMS: &[Claim] = &[
    (2, "In lesson 1 the same amplitude made 114 kPa", "plate-trapped", &[SMALL], "max_pressure_kpa", 114.0, 0.005),
    (3, "is 13.5 again", "plate-crossover", &[SMALL], "squeeze_number", 13.5, 0.005),
    (3, "the thinner film had 0.065", "plate-crossover", &[SMALL], "load_ratio_max", 0.065, 0.008),
    (4, "from 0.150", "plate-crossover", &[], "mean_load_ratio", 0.150, 0.004),
    (7, "the squeeze number is still 3000", "fundamental", &["stator.frequency_khz=3"], "squeeze_number", 3000.0, 0.02),
    (
        7,
        "is 0.274, only a tenth more than at 30 kHz",
        "fundamental",
        &["stator.frequency_khz=100"],
        "alpha",
        0.274,
        0.004,
    ),
    (8, "(1 - 0.246)", "fundamental", &[], "alpha", 0.246, 0.003),
    (8, "answer = 0.2625", "fundamental", &[], "max_torque_nm", 0.2625, 0.002),
    (
        8,
        "About a third of a micrometre is enough",
        "fundamental",
        &["film.min_spacing_nm=333"],
        "stall_torque_nm",
        0.30,
        0.01,
    ),
    (
        8,
        "try = [\"stator.frequency_khz = 5\"]",
        "fundamental",
        &["stator.frequency_khz=5"],
        "stall_torque_nm",
        0.305,
        0.005,
    ),
    (9, "At 300 g more than 1 µm is left", "floating-disc", &["plate.mass_g=300"], "min_gap_nm", 1938.0, 0.01),
    (
        9,
        "It is some 4 % more than the formula gives",
        "floating-disc",
        &["plate.amplitude_um=1.633"],
        "mean_gap_um",
        8.0,
        0.003,
    ),
    (9, "below 2.3 µm", "floating-finger-pad", &["plate.amplitude_um=0.58"], "min_gap_nm", 2255.0, 0.005),
];

fn problem(preset: &str, set: &[&str]) -> Problem {
    let set = set.iter().map(|change| change.split_once('=').unwrap());
    Problem::try_from(&presets::find(preset).unwrap().with(set).unwrap()).unwrap()
}

fn solved(preset: &str, set: &[&str]) -> (Problem, Solution) {
    let problem = problem(preset, set);
    let settings = Settings { fidelity: Fidelity::Fine, ..Settings::default() };
    let solution = solve(&problem, &settings, &mut |_: &Progress| (), &Cancel::new()).unwrap();
    (problem, solution)
}

fn numbers(preset: &str, set: &[&str]) -> Numbers {
    let (problem, solution) = solved(preset, set);
    Numbers::of(&problem, &solution)
}

fn number(preset: &str, set: &[&str], name: &str) -> f64 {
    let quantity = Quantity::all().find(|quantity| quantity.name() == name).unwrap();
    numbers(preset, set).get(quantity).unwrap()
}

/// The text of a lesson with line breaks as spaces.
fn text(lesson: usize) -> String {
    BUILT_IN[lesson - 1].text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn says(lesson: usize, words: &str) {
    assert!(text(lesson).contains(words), "lesson {lesson} no longer says “{words}”");
}

/// A lesson says `words`, and `computed` is what is `stated` there, to within a share of it.
fn states(lesson: usize, words: &str, computed: f64, stated: f64, within: f64) {
    says(lesson, words);
    assert!((computed / stated - 1.0).abs() < within, "lesson {lesson}, “{words}”: {computed}");
}

/// Likewise of a range.
fn between(lesson: usize, words: &str, computed: f64, range: Range<f64>) {
    says(lesson, words);
    assert!(range.contains(&computed), "lesson {lesson}, “{words}”: {computed}");
}

#[test]
fn numbers_of_lessons_are_those_of_the_program() {
    for (lesson, words, preset, set, name, stated, tolerance) in CLAIMS {
        states(*lesson, words, number(preset, set, name), *stated, *tolerance);
    }
}

#[test]
fn ratios_of_lessons_are_those_of_the_program() {
    let ratio = |preset, from: &[&str], to: &[&str], name| number(preset, to, name) / number(preset, from, name);
    let closer = [SMALL, "plate.mean_gap_um=0.5"];
    let pushed = |preset| ratio(preset, &[SMALL], &closer, "load_ratio_max");
    between(1, "It becomes two to two and a half times as large", pushed("plate-trapped"), 2.0..2.5);
    between(2, "It becomes seven or eight times as large", pushed("plate-viscous"), 6.5..8.0);
    let sticks = [SMALL, "film.slip=none"];
    let closer = [SMALL, "film.slip=none", "plate.mean_gap_um=0.5"];
    states(2, "without slip it would even be 9", ratio("plate-viscous", &sticks, &closer, "load_ratio_max"), 9.0, 0.03);
    let [sticks, slips] = [&["film.slip=none"][..], &[]].map(|set| number("plate-trapped", set, "mean_load_ratio"));
    let leaks = (0.354 - sticks) / (0.354 - slips);
    between(4, "The smaller part of what is missing leaks at the edges", leaks, 0.25..0.42);
    states(7, "only a tenth more", ratio("fundamental", &[], &["stator.frequency_khz=100"], "alpha"), 1.11, 0.01);
    let doubled = ratio("plate-trapped", &["plate.amplitude_um=0.25"], &[], "mean_load_ratio");
    between(4, "four times the force. It is even a little more", doubled, 4.0..5.0);
    let narrow = ratio("fundamental", &[], &["rotor.contact_width_mm=0.15"], "alpha");
    states(8, "about a third of", narrow, 0.35, 0.02);
    let viscous = numbers("plate-viscous", &[SMALL]);
    says(2, "less than a hundredth of either");
    let [mean, most] = [Quantity::LoadRatio, Quantity::LoadRatioMax].map(|quantity| viscous.get(quantity).unwrap());
    assert!(mean < 0.01 * most);
    let dry = number("fundamental", &[], "max_torque_nm") / (1.0 - number("fundamental", &[], "alpha"));
    states(8, "Without air this would be 0.348 N·m", dry, 0.348, 0.002);
    let carried = number("fundamental", &["motor.load_per_wave_n=0.6"], "film_load_n");
    between(8, "The air can carry about half a newton on each wave", carried, 0.45..0.65);
    states(
        5,
        "a fifth more",
        ratio("plate-crossover", &THIN, &["film.slip=none", THIN[0], THIN[1], THIN[2]], "mean_load_ratio"),
        1.22,
        0.02,
    );
    let thick = ["film.slip=none", THICK[0], THICK[1], THICK[2], THICK[3]];
    let same = ratio("plate-crossover", &THIN, &THICK, "squeeze_number");
    states(5, "with length and frequency chosen so that $\\sigma$ is the same", same, 1.0, 1e-3);
    let loses = ratio("plate-crossover", &THICK, &thick, "mean_load_ratio");
    between(5, "By a per cent or two", loses, 1.01..1.02);
}

#[test]
fn what_lessons_read_off_the_tabs_is_what_tabs_show() {
    let plate = |set: &[&str]| problem("plate-crossover", set).scenario.plate().unwrap().clone();
    // Hold: how long the air takes.
    let leak = 1e6 * leak_time(&plate(&[]), 1e-6);
    states(1, "the air needs about 160 µs", leak, 160.0, 0.03);
    states(2, "At the mean gap that takes about 160 µs", leak, 160.0, 0.03);
    states(2, "it takes three times as long", 1e6 * leak_time(&plate(&[]), 0.5e-6) / leak, 3.0, 0.06);
    states(2, "nearly three hundred leak times", 1e6 / 22.0 / leak, 290.0, 0.02);
    // Exact: slip, and where spring and damper meet.
    let small = ["plate.amplitude_um=0.1", "plate.frequency_khz=1.03"];
    let sigma = number("plate-crossover", &small, "squeeze_number");
    let slip = sigma / harmonic::effective_squeeze_number(&plate(&small));
    states(3, "$Q = 1.38$", slip, 1.38, 0.005);
    states(3, "$\\sigma/Q = 10$, so $\\sigma = 14$", sigma, 14.0, 0.02);
    says(3, "The leak time is then just $1/\\omega$.");
    let at_leak_time = sigma / (std::f64::consts::TAU * 1.03e-3 * leak);
    states(3, "$\\sigma$ is about 14, not 1, when the air needs as long as it has", at_leak_time, 14.0, 0.05);
    // Of the preset, at 1 kHz.
    states(3, "nearly so: $1/\\omega$ is 159 µs", 1e3 / std::f64::consts::TAU, 159.0, 2e-3);
    states(3, "nearly so: $1/\\omega$ is 159 µs", leak, 159.0, 0.03);
    says(3, "answer = 1.03");
    let before = number("plate-crossover", &["plate.frequency_khz=0.2"], "squeeze_number");
    states(3, "Here $\\\\sigma$ is 2.7, at 0.2 kHz", before, 2.7, 0.01);
    states(3, "That is five times the", sigma / before, 5.0, 0.05);
    assert!((sigma / slip / 10.0 - 1.0).abs() < 0.01);
    let linear = harmonic::linear(10.0, Outline::Strip);
    assert!((linear.spring / linear.damping - 1.0).abs() < 0.02, "{linear:?}");
    // Start-up: the first cycle, and the last.
    let cycles = |preset: &str| {
        let mut cycles = BTreeMap::new();
        let settings = startup::Settings::default();
        let mut each = |cycle: startup::Cycle| {
            cycles.insert(cycle.number, cycle.outcome);
        };
        startup::startup(&problem(preset, &[]), &settings, &mut each, &Cancel::new()).unwrap();
        cycles.into_values().collect::<Vec<_>>()
    };
    let trapped: Vec<f64> = cycles("plate-trapped")
        .iter()
        .map(|outcome| PlateResult::ratio(outcome.plate().unwrap().film_load.value, &plate(&[])))
        .collect();
    states(4, "In the first cycle the mean load ratio is 0.17", trapped[0], 0.17, 0.01);
    states(4, "startup.mean_load_ratio about 0.33", *trapped.last().unwrap(), 0.33, 0.005);
    assert!(trapped.windows(2).all(|pair| pair[1] > pair[0] - 1e-4), "it pumps up: {trapped:?}");
    states(4, "about two hundred cycles", trapped.len() as f64, 200.0, 0.1);
    let motor: Vec<f64> = cycles("fundamental").iter().map(|outcome| outcome.motor().unwrap().alpha.value).collect();
    states(7, "In the first cycle the air carries only 0.15", motor[0], 0.15, 0.02);
    states(7, "0.15, 0.22, 0.24: after five cycles", motor[1], 0.215, 0.02);
    states(7, "0.15, 0.22, 0.24: after five cycles", motor[2], 0.24, 0.02);
    assert!((motor[4] / motor.last().unwrap() - 1.0).abs() < 0.005 && (5.0 / 30e3 - 1e-3 / 6.0f64).abs() < 1e-9);
    // Torque: the ends of the lines, and the greatest power.
    let merit = |preset: &str, set: &[&str]| {
        let (problem, solution) = solved(preset, set);
        TorqueCurves::of(&problem, Fidelity::Fine, &solution, &Cancel::new()).unwrap().unwrap()
    };
    let usual = merit("fundamental", &[]);
    let idle = |of: &Performance| usual.rpm(of.no_load_speed.unwrap().value);
    let words = "it runs at 58 rpm with film and at 57 without";
    states(8, words, idle(&usual.with_film), 58.0, 0.009);
    states(8, words, idle(&usual.without_film), 57.0, 0.009);
    states(6, "as fast as a rotor at 62 rpm would be", usual.rpm(usual.stator_speed), 62.0, 0.005);
    says(8, "more load presses metal on metal");
    let polished = merit("min-spacing-100nm", &[]);
    let narrow = merit("min-spacing-100nm", &["rotor.contact_width_mm=0.12"]);
    assert!(narrow.with_film.max_power.value > 1.2 * polished.with_film.max_power.value);
    assert!(narrow.with_film.stall_torque.value > 0.30);
}

/// Stiffness \[N/m\] and damping \[N s/m\] of the film of lesson 10, and its Knudsen number.
fn sensor(set: &[&str]) -> [f64; 3] {
    let scene = Scene::from_toml(BUILT_IN[9].presets[0].1, "accelerometer").unwrap();
    let set = ["plate.mean_gap_um=4.73"].iter().chain(set).map(|change| change.split_once('=').unwrap());
    let problem = Problem::try_from(&scene.with(set).unwrap()).unwrap();
    let solution = solve(&problem, &Settings::default(), &mut |_: &Progress| (), &Cancel::new()).unwrap();
    let Scenario::Plate(plate) = &problem.scenario else { panic!("a plate") };
    let found = harmonic::solved(plate, &PlateResult::default(), &solution.recording).unwrap();
    let unit = Harmonic::unit(plate);
    let knudsen = Numbers::of(&problem, &solution).get(Quantity::KnudsenNumber).unwrap();
    [found.spring.value * unit.spring, found.damping.value * unit.damping, knudsen]
}

#[test]
fn what_lesson_9_says_of_a_plate_that_floats_is_right() {
    let disc = |set: &[&str], name| number("floating-disc", set, name);
    let doubled = disc(&["plate.mass_g=200"], "mean_gap_um") / disc(&[], "mean_gap_um");
    states(9, "takes away 29 %", doubled, 0.5f64.sqrt(), 0.028);
    let (force, weight) = (101_325.0 * std::f64::consts::PI * 0.008f64.powi(2), 0.1 * 9.80665);
    states(9, "$p_a A$ is 20.4 N and $F$ is 0.98 N", force, 20.4, 2e-3);
    states(9, "$p_a A$ is 20.4 N and $F$ is 0.98 N", weight, 0.98, 5e-3);
    states(9, "The square root is 5.1, and 8 µm over 5.1 is 1.57 µm", (1.25 * force / weight).sqrt(), 5.1, 0.005);
    let slower = disc(&["plate.frequency_khz=10"], "mean_gap_um") / disc(&[], "mean_gap_um");
    states(9, "Neither the frequency nor the viscosity is in the formula.", slower, 1.0, 0.02);
    says(9, "About 3 kg");
    assert!(disc(&["plate.mass_g=3000"], "min_gap_nm") > 200.0);
    says(9, "At a little over 3 kg the roughness touches.");
    let floats = |preset: &str, change: &str| {
        let problem = problem(preset, &[change]);
        solve(&problem, &Settings::default(), &mut |_: &Progress| (), &Cancel::new()).is_ok()
    };
    assert!(!floats("floating-disc", "plate.mass_g=3300"));
    says(9, "The amplitude is reduced from 1.5 µm to 0.5 µm, a third of it");
    assert!(!floats("floating-finger-pad", "plate.amplitude_um=0.5"));
    says(9, "Anything from 0.52 to 0.59 µm does.");
    assert!(floats("floating-finger-pad", "plate.amplitude_um=0.52"));
    assert!(number("floating-finger-pad", &["plate.amplitude_um=0.59"], "min_gap_nm") < 2300.0);
    let pad = number("floating-finger-pad", &[], "mean_gap_um") / 3.0;
    states(9, "In proportion to the amplitude the mean gap would be 2.4 µm.", pad, 2.4, 0.02);
}

#[test]
fn what_lesson_10_says_of_the_gas_in_a_sensor_is_right() {
    let mass = 2330.0 * (0.4e-3f64).powi(2) * 0.1e-3;
    states(10, "37 millionths of a gram", mass, 37e-9, 0.01);
    let omega = std::f64::consts::TAU * 5e3;
    states(10, "**1.64 mN·s/m**", 2f64.sqrt() * omega * mass, 1.64e-3, 0.02);
    states(10, "The springs of this mass have a stiffness of 37 N/m", mass * omega * omega, 37.0, 0.01);
    let [stiffness, damping, knudsen] = sensor(&[]);
    states(10, "the damping is 1.64 mN·s/m", damping, 1.64e-3, 0.01);
    assert!(stiffness < 2.0 && knudsen < 0.02, "{stiffness} {knudsen}");
    let halved = sensor(&["plate.mean_gap_um=2.5"])[1] / sensor(&["plate.mean_gap_um=5"])[1];
    between(10, "It becomes seven or eight times as large", halved, 7.0..8.0);
    let more = sensor(&["plate.mean_gap_um=4.63"])[1] / damping;
    states(10, "a tenth of a micrometre more or less changes the damping by 6 %", more, 1.06, 0.009);
    let thinner = sensor(&["film.ambient_pressure_kpa=50"])[1] / damping;
    between(10, "It falls by less than a tenth", thinner, 0.9..0.95);
    says(10, "Go back to 10 kPa and look: about half of the damping is still there.");
    let tenth = sensor(&["film.ambient_pressure_kpa=10"])[1] / damping;
    let [_, least, knudsen] = sensor(&["film.ambient_pressure_kpa=1"]);
    assert!((0.48..0.56).contains(&tenth) && least < 0.1 * damping && knudsen > 1.0, "{tenth} {least} {knudsen}");
    let hydrogen = sensor(&["film.gas=hydrogen"])[1] / damping;
    between(10, "It falls to less than half", hydrogen, 0.4..0.5);
    says(10, "Yet helium damps a little less");
    let [helium, argon] = ["film.gas=helium", "film.gas=argon"].map(|gas| sensor(&[gas])[1] / damping);
    assert!((0.9..1.0).contains(&helium) && argon > 1.1, "{helium} {argon}");
    says(10, "the gas is now stiffer than the silicon, though it still damps more than it springs");
    says(10, "At 300 kHz it is more spring than damper");
    let [[spring, damper], [faster, weaker]] = [50.0, 300.0].map(|kilohertz| {
        let [spring, damping, _] = sensor(&[format!("plate.frequency_khz={kilohertz}").as_str()]);
        [spring, std::f64::consts::TAU * 1e3 * kilohertz * damping]
    });
    assert!(spring > 2.0 * 37.0 && damper > 2.0 * spring && faster > weaker, "{spring} {damper} {faster} {weaker}");
}

#[test]
fn what_lessons_compute_by_hand_is_right() {
    // Lesson 1: a fingertip of air.
    states(1, "answer = 10.1", 101_325.0 * 1e-4 / 1e-6 * 1e-6, 10.1, 0.004);
    // Lesson 3: where damping is greatest, and where spring and damper are equal.
    says(3, "There $D$ is at its greatest, too");
    let strip = |sigma: f64| exact::linear_load(sigma, Outline::Strip);
    assert!((strip(10.0).re / strip(10.0).im - 1.0).abs() < 0.02, "{}", strip(10.0));
    let greatest = (1..2000).map(|i| f64::from(i) * 0.1);
    let greatest = greatest.max_by(|a, b| strip(*a).im.abs().total_cmp(&strip(*b).im.abs()));
    assert!((greatest.unwrap() - 10.0).abs() < 0.5, "{greatest:?}");
    // Lesson 4: the trapped limit.
    states(4, "answer = 0.354", ((1.0 + 1.5 * 0.25) / 0.75f64).sqrt() - 1.0, 0.354, 1.4e-3);
    states(4, "0.155 atmospheres", 1.0 / 0.75f64.sqrt() - 1.0, 0.155, 3e-3);
    // Lesson 1: heat reaches the walls. Lesson 2: the formula without slip.
    says(1, "in less than a tenth of a microsecond");
    let diffusivity = 2.2e-5;
    assert!(1e-6 * 1e-6 / diffusivity < 0.1e-6);
    let viscous = presets::find("plate-viscous").unwrap();
    let of = |key: &str| viscous.get(key).unwrap().as_number().unwrap();
    let speed = std::f64::consts::TAU * 1e3 * of("plate.frequency_khz") * 0.1e-6;
    let force = 1e-6 * of("film.viscosity_upa_s") * (1e-3 * of("plate.length_mm")).powi(2) * speed
        / (1e-6 * of("plate.mean_gap_um")).powi(3);
    states(2, "0.0025 of $p_a A$", force / (1e3 * of("film.ambient_pressure_kpa")), 0.0025, 0.02);
    // Lesson 5: hits on walls, v/2h a second, and on molecules, v/λ.
    let walls: f64 = 64.0 / (2.0 * 200.0);
    states(5, "every seventh collision of a molecule is with a wall", (1.0 + walls) / walls, 7.0, 0.05);
    // Lesson 5: the slip factor.
    states(5, "answer = 2.92", 1.0 + 6.0 * 0.32, 2.92, 1e-13);
    // Lesson 6: 63 teeth on 58 mm; lesson 7: how much lower a round tooth is at its edge, and the short way out.
    says(6, "All 63 of the ring");
    says(6, "a ring 58 mm across");
    let scene = presets::find("fundamental").unwrap();
    let get = |key: &str| scene.get(key).unwrap().as_number().unwrap();
    assert_eq!(get("motor.waves") * get("stator.teeth_per_wave"), 63.0);
    assert_eq!(2.0 * get("motor.contact_radius_mm"), 58.0);
    let half: f64 = 0.5 * get("stator.tooth_width_mm");
    states(7, "lower than its middle by 0.13 µm", half * half / (2.0 * 3.0), 0.13, 0.07);
    let ratio: f64 = get("stator.tooth_width_mm") / get("rotor.contact_width_mm");
    states(7, "thirty times smaller", ratio * ratio, 30.0, 0.15);
    says(7, "Slip takes another factor of three");
    let wavelength = std::f64::consts::TAU * get("motor.contact_radius_mm") / get("motor.waves");
    let longer = wavelength * 1e3 / get("stator.normal_amplitude_um");
    states(6, "20 000 times longer than its amplitude", longer, 20e3, 0.01);
    // The paper's values, as published.
    let published = include_str!("../assets/table1.csv");
    for (lesson, words, row) in [
        (6, "0.238 with wide teeth, 0.157 with these", "tooth_width_1.16mm,stator.tooth_width_mm=1.157,0.386,0.157"),
        (7, "The paper has 0.481", "min_spacing_100nm,film.min_spacing_nm=100,1.179,0.481"),
        (7, "The paper has 0.466", "rotor_width_0.6mm,rotor.contact_width_mm=0.6,1.141,0.466"),
        (7, "0.078 in the paper", "frequency_3khz,stator.frequency_khz=3,0.192,0.078"),
        (7, "0.235 for 0.238", "tooth_radius_3m,stator.tooth_radius_m=3,0.576,0.235"),
    ] {
        says(lesson, words);
        assert!(published.contains(row), "{row}");
    }
    // The wavelength over half a pitch of orders: 30 000 cycles of 33 µs, 4 µs at 250 kHz, 45 ms at 22 Hz.
    states(1, "A whole cycle takes 4 µs", 1.0 / 250e3, 4e-6, 2e-4);
    states(2, "the air has 45 ms", 1.0 / 22.0, 45e-3, 0.02);
}
