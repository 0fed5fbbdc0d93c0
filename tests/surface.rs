//! Rough faces: contact on asperities and flow between them, against limits and conservation laws.

// clippy.toml allows this inside #[test] functions; the helpers of this file are tests too.
#![allow(clippy::unwrap_used)]

mod scenes;

use proptest::prelude::*;
use squeezefilm::analysis::surface::SurfaceCurves;
use squeezefilm::contact::{Contact, Instant, Modes, Shape};
use squeezefilm::control::Cancel;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::film::cycle::FilmCycle;
use squeezefilm::film::grid::{Axis, FilmGrid, Start};
use squeezefilm::film::stepper::{Film, FilmState};
use squeezefilm::motor;
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Gas, Motor, Numerics, Problem, RotorCompliance, Scenario};
use squeezefilm::rotor::ring::Band;
use squeezefilm::rotor::{Compliances, Wave};
use squeezefilm::scene::{Scene, presets};
use squeezefilm::solution::{MotorResult, Outcome, Solution, Status};
use squeezefilm::solve::{Method, Settings, SolveError, solve};
use squeezefilm::surface::flow::Roughness;
use squeezefilm::surface::{Asperities, Summits, Surface};
use std::f64::consts::TAU;

const WAVE: f64 = 0.026;
const WIDTH: f64 = 3e-4;

fn asperities(rms: f64, modulus: f64, law: &str, heights: &str) -> Asperities {
    let summits = Summits { rms, radius: 5e-5, density: 1e10, modulus };
    Asperities::new(summits, Surface::law(law).unwrap(), Surface::heights(heights).unwrap())
}

fn plain(rms: f64) -> Asperities {
    asperities(rms, 54e9, "greenwood-williamson", "gaussian")
}

fn beam() -> Compliances {
    let rotor = RotorCompliance::Beam { decay_length: 4e-3, point_compliance: 0.64e-6, local_compliance: 1.05e-10 };
    rotor
        .resolve(&Wave { length: WAVE, waves: 7, band: Band { radius: 0.029, width: WIDTH } }, 200, &Cancel::new())
        .unwrap()
}

/// A wavelength of nodes without grooves, and the contact problem on it.
struct Bench {
    x: Vec<f64>,
    length: f64,
    contact: Contact,
}

const HARMONICS: usize = 24;

impl Bench {
    fn new(nodes: usize, film: bool, spacing: f64, surface: Option<Asperities>, load: f64) -> Self {
        let x: Vec<f64> = (0..nodes).map(|i| WAVE * i as f64 / nodes as f64).collect();
        let length = WAVE / nodes as f64;
        let widths = vec![if film { WIDTH } else { 0.0 }; nodes];
        let modes = Modes::new(&beam(), HARMONICS, 0.0, &x);
        let contact = Contact::new(modes, vec![length; nodes], &widths, 101_325.0, spacing, load).on(surface, WIDTH);
        Self { x, length, contact }
    }

    fn solve(&mut self, amplitude: f64, trapped: f64, shape: &mut Shape) -> Instant {
        let stator = self.stator(amplitude);
        let mut out = Instant::default();
        self.contact.solve(&stator, &vec![WIDTH * trapped; self.x.len()], shape, &mut out).unwrap();
        out
    }

    fn stator(&self, amplitude: f64) -> Vec<f64> {
        self.x.iter().map(|x| amplitude * (TAU * x / WAVE).cos()).collect()
    }
}

/// Flat faces on a rigid offset: every node carries the load's share, and the separation is that of the closed form.
#[test]
fn flat_faces_come_as_close_as_the_load_says() {
    for (law, heights) in [
        ("greenwood-williamson", "exponential"),
        ("greenwood-tripp", "exponential"),
        ("greenwood-williamson", "gaussian"),
    ] {
        let surface = asperities(1e-7, 54e9, law, heights);
        for load in [0.01, 2.45, 60.0] {
            let out = Bench::new(48, false, 1e-7, Some(surface), load).solve(0.0, 0.0, &mut Shape::default());
            // Exponential heights: p = K Γ(n + 1) e^{−d/σ}, so d = σ ln(p(0)/p).
            let pressure = load / (WAVE * WIDTH);
            let separation = match heights {
                "exponential" => 1e-7 * (surface.pressure(0.0).0 / pressure).ln(),
                _ => surface.separation_under(pressure),
            };
            for (h, c) in out.film_thickness.iter().zip(&out.contact) {
                assert!((h / surface.mean_gap(separation).0 - 1.0).abs() < 1e-11, "{law} {heights} {load}: {h}");
                assert!((c * WAVE / load - 1.0).abs() < 1e-12);
            }
        }
    }
}

/// At every node asperities carry what their separation says, the rotor's whole compliance gives that separation, and the loads add up.
#[test]
fn asperities_and_rotor_agree_at_every_node() {
    for (law, heights) in [("greenwood-williamson", "gaussian"), ("greenwood-tripp", "exponential")] {
        for (rms, trapped, load) in [(1.2e-7, 2e-7, 2.45), (3e-8, 1e-7, 0.3), (1e-6, 1e-6, 40.0)] {
            let surface = asperities(rms, 54e9, law, heights);
            let nodes = 2 * HARMONICS;
            let mut bench = Bench::new(nodes, true, rms, Some(surface), load);
            let out = bench.solve(1.3e-6, trapped, &mut Shape::default());
            let q: Vec<f64> = (0..nodes)
                .map(|i| out.contact[i] + 101_325.0 * WIDTH * (trapped / out.film_thickness[i] - 1.0))
                .collect();
            let total: f64 = q.iter().map(|q| q * bench.length).sum();
            let scale: f64 = q.iter().map(|q| q.abs() * bench.length).sum();
            assert!((total - load).abs() < 1e-12 * scale.max(load), "{total} {load}");
            // Deflection harmonic by harmonic, with nothing split off; the last one stands for all beyond.
            let rotor = beam();
            let stator = bench.stator(1.3e-6);
            let offset = |i: usize| {
                let deflection: f64 = (0..nodes)
                    .map(|j| {
                        let term = |n: usize| {
                            let parts = if 2 * n == nodes { 1.0 } else { 2.0 };
                            parts / WAVE * rotor.harmonic(n) * (TAU * (n * (i + nodes - j)) as f64 / nodes as f64).cos()
                        };
                        // The mean is the rigid offset's; the local part acts on it too.
                        q[j] * bench.length
                            * ((1..=nodes / 2).map(term).sum::<f64>() + rotor.harmonic(HARMONICS) / WAVE)
                    })
                    .sum();
                surface.separation(out.film_thickness[i]) - deflection + stator[i]
            };
            for i in 0..nodes {
                let h = out.film_thickness[i];
                if h > 1.001 * surface.least_gap() {
                    let carried = WIDTH * surface.pressure(surface.separation(h)).0;
                    assert!((out.contact[i] - carried).abs() < 1e-8 * carried + 1e-9 * load / WAVE, "{i}: {carried}");
                    assert!((offset(i) - offset(nodes / 2)).abs() < 1e-13, "{i}: {} {}", offset(i), offset(nodes / 2));
                }
            }
        }
    }
}

#[test]
fn the_answer_does_not_depend_on_the_start() {
    let mut bench = Bench::new(120, true, 1e-7, Some(plain(1.2e-7)), 2.45);
    let cold = bench.solve(1.3e-6, 2e-7, &mut Shape::default());
    for (amplitude, trapped) in [(2e-5, 1e-8), (0.0, 1e-5), (-1.3e-6, 1e-7)] {
        let mut shape = Shape::default();
        bench.solve(amplitude, trapped, &mut shape);
        let warm = bench.solve(1.3e-6, 2e-7, &mut shape);
        for (a, b) in warm.contact.iter().zip(&cold.contact) {
            assert!((a - b).abs() < 1e-10 * 2.45 / WAVE, "{a} {b}");
        }
    }
}

/// Ever stiffer summits, so far apart that they carry the load at one height, are a hard stop there.
#[test]
fn stiff_asperities_are_a_hard_stop() {
    let (load, spacing) = (2.45, 2e-7);
    let hard = Bench::new(120, true, spacing, None, load).solve(1.3e-6, 3e-7, &mut Shape::default());
    let mut last = f64::INFINITY;
    for u in [6.0, 12.0, 24.0, 36.0] {
        // Summits whose reach, u σ, is the spacing at the mean pressure of the contact.
        let rms = spacing / u;
        let touching = hard.contact.iter().filter(|c| **c > 0.0).count() as f64 / 120.0;
        let soft = asperities(rms, 1.0, "greenwood-williamson", "gaussian").pressure(spacing).0;
        let surface = asperities(rms, load / (WAVE * WIDTH * touching) / soft, "greenwood-williamson", "gaussian");
        let out = Bench::new(120, true, spacing, Some(surface), load).solve(1.3e-6, 3e-7, &mut Shape::default());
        let apart: f64 =
            out.contact.iter().zip(&hard.contact).map(|(a, b)| (a - b).abs()).sum::<f64>() * WAVE / 120.0 / load;
        assert!(apart < 0.6 * last, "{u}: {apart} {last}");
        last = apart;
    }
    assert!(last < 0.02, "{last}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    /// Any asperities, gas and load: the problem is solved, nothing pulls, and the load is balanced.
    #[test]
    fn any_asperities_are_solved(
        rms in -8.0f64..-5.3, radius in -7.0f64..-2.0, density in 6.0f64..13.0, modulus in 7.0f64..12.0, law in 0usize..2, heights in 0usize..2,
        load in -2.0f64..2.0, amplitude in -9.0f64..-4.7, pressure in 1.0f64..6.0, trapped in -9.0f64..-5.0, seed in 0u32..1000,
    ) {
        let ten = |e: f64| 10f64.powf(e);
        let summits = Summits { rms: ten(rms), radius: ten(radius), density: ten(density), modulus: ten(modulus) };
        let surface = Asperities::new(summits, squeezefilm::surface::LAWS[law], squeezefilm::surface::HEIGHTS[heights]);
        let nodes = 120;
        let x: Vec<f64> = (0..nodes).map(|i| WAVE * (i as f64 + 0.3) / nodes as f64).collect();
        let load = ten(load);
        let modes = Modes::new(&beam(), HARMONICS, 0.0, &x);
        let length = WAVE / nodes as f64;
        let mut contact = Contact::new(modes, vec![length; nodes], &vec![WIDTH; nodes], ten(pressure), ten(rms), load).on(Some(surface), WIDTH);
        let stator: Vec<f64> = x.iter().map(|x| ten(amplitude) * (TAU * x / WAVE + f64::from(seed)).cos()).collect();
        let gas: Vec<f64> = (0..nodes).map(|i| WIDTH * ten(trapped) * (1.0 + 0.9 * (i as f64 * f64::from(seed)).sin())).collect();
        let mut out = Instant::default();
        let solved = contact.solve(&stator, &gas, &mut Shape::default(), &mut out);
        prop_assert!(solved.is_ok(), "{solved:?}");
        let (mut total, mut scale) = (0.0, load);
        for i in 0..nodes {
            let (c, h) = (out.contact[i], out.film_thickness[i]);
            prop_assert!(c >= 0.0 && h >= surface.least_gap() * (1.0 - 1e-12), "{} {}", c, h);
            let force = (c + ten(pressure) * (gas[i] / h - WIDTH)) * length;
            total += force;
            scale += force.abs();
        }
        prop_assert!((total - load).abs() < 1e-10 * scale, "Σf = {}, L = {}, scale {}", total, load, scale);
    }
}

/// Under a gap that is even in space, ⟨φ h Φ(Z)⟩ is the same at every node as on the edge, because φ depends on the gap alone: the
/// invariant of the smooth film (docs/theory.md, section 12) with the flow factor in it.
#[test]
fn the_films_invariant_holds_with_flow_factors() {
    let gas = Gas::default();
    let slip = 6.0 * gas.mean_free_path;
    for asperities in [None, Some(plain(2e-7))] {
        let roughness = Roughness { rms: 2e-7, lay: 1.0, stator_share: 0.5, asperities };
        let axis = || Axis::clustered(0.25e-3, Start::Mirror, 8, 0.0);
        let (grid, steps) = (FilmGrid { x: axis(), y: axis() }, 64);
        let (nx, unknowns) = (grid.x.len(), grid.unknowns());
        let gap = |step: usize| 6e-7 + 4e-7 * (TAU * step as f64 / steps as f64).cos();
        let h: Vec<f64> = (0..steps * nx).map(|i| gap(i / nx)).collect();
        let mut film = Film::new(grid, &gas);
        film.roughen(Some(roughness));
        let mut film = FilmCycle::new(film, steps);
        let mut state = FilmState::at_rest(vec![6e-7; unknowns]);
        let mut line = vec![0.0; steps * nx];
        for _ in 0..60 {
            let before = state.clone();
            film.march(&h, None, |_| 1.0 / 30e3 / steps as f64, &mut state, &mut line, &Cancel::new()).unwrap();
            if state.change_since(&before) < 1e-12 {
                break;
            }
            film.shift(&mut state);
        }
        let weighed = |z: &dyn Fn(usize) -> f64| -> f64 {
            let potential = |step: usize| z(step) * (0.5 * z(step) + slip);
            (0..steps).map(|step| roughness.at(gap(step)).along * gap(step) * potential(step)).sum()
        };
        let edge = weighed(&gap);
        for k in 0..unknowns {
            let here = weighed(&|step| gap(step) * film.pressure(step)[k]);
            assert!((here / edge - 1.0).abs() < 1e-9, "node {k}: {here} {edge}");
        }
        // The factor matters: without it the sums are not the same.
        let bare = |z: &dyn Fn(usize) -> f64| (0..steps).map(|s| gap(s) * z(s) * (0.5 * z(s) + slip)).sum::<f64>();
        assert!((bare(&|step| gap(step) * film.pressure(step)[0]) / bare(&gap) - 1.0).abs() > 1e-3);
    }
}

fn solved(preset: &str, changes: &[(&str, &str)]) -> (Scene, Solution, MotorResult) {
    let scene = scenes::scene(preset, changes);
    let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
    let solution = solve(&Problem::try_from(&scene).unwrap(), &settings, &mut (), &Cancel::new()).unwrap();
    assert_eq!(solution.status, Status::Converged, "{changes:?}");
    let result = *solution.outcome.motor().unwrap();
    (scene, solution, result)
}

#[test]
fn both_presets_are_solved_and_film_and_contact_carry_the_load() {
    for preset in ["asperities", "rough-flow"] {
        let (_, solution, result) = solved(preset, &[]);
        // Chosen so: near the fundamental case.
        assert!((result.alpha.value - 0.246).abs() < 0.025, "{preset}: {}", result.alpha);
        assert!((2.0..6.0).contains(&result.teeth_in_contact.value) && !result.levitated);
        let recording = &solution.recording;
        for frame in 0..recording.frames {
            let total = recording.film_load[frame] + recording.contact_load[frame];
            assert!((total / 2.45 - 1.0).abs() < 5e-3, "{preset} {frame}: {total}");
        }
        assert!(recording.contact.iter().all(|c| *c >= 0.0) && recording.touching_from > 0.0);
    }
}

#[test]
fn the_curves_of_the_faces_reach_as_far_as_they_say() {
    let problem = scenes::problem("asperities", &[("surface.flow_factors", "patir-cheng")]);
    let Scenario::Motor(motor) = &problem.scenario else { panic!("a motor") };
    let curves = SurfaceCurves::of(motor);
    let law = motor.surface.asperities.unwrap();
    let rms = law.summits().rms;
    // Contact from touching means on to where the mean gap is four times the height of the asperities, flow to eight times.
    let [first, last] = [curves.contact[0], curves.contact[curves.contact.len() - 1]];
    assert_eq!([first[0], first[1]], [law.mean_gap(0.0).0, law.pressure(0.0).0]);
    assert!((last[0] / rms - 4.0).abs() < 0.01 && last[1] < 1e-3 * first[1], "{last:?} {rms}");
    assert!(curves.contact.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] > pair[1][1]));
    let flow = &curves.flow;
    let reach = motor.surface.flow.unwrap().rms;
    assert!((flow[flow.len() - 1][0] / reach - 8.0).abs() < 1e-12 && flow[0][0] < reach, "{:?}", flow[flow.len() - 1]);
    let even = curves.even.unwrap();
    let tops = motor.teeth as f64 * motor.tooth_width * motor.contact_width;
    assert!((even[1] * tops / motor.load - 1.0).abs() < 1e-12);
}

#[test]
fn rougher_faces_stay_further_apart_and_hold_less_pressure() {
    let at = |rms: &str| solved("asperities", &[("surface.rms_nm", rms)]).2;
    let (fine, coarse, rough) = (at("50"), at("100"), at("200"));
    assert!(fine.alpha.value > coarse.alpha.value + 0.05 && coarse.alpha.value > rough.alpha.value + 0.05);
    let [thin, middle, thick] = [&fine, &coarse, &rough].map(|result| result.min_film_thickness.value);
    assert!(thin < middle && middle < thick);
    // Greenwood and Tripp's summits on both faces are fewer that meet: at this density, softer.
    let (_, _, tripp) = solved("asperities", &[("surface.contact_law", "greenwood-tripp")]);
    assert!(tripp.min_film_thickness.value < middle);
}

#[test]
fn every_tooth_by_itself_gives_the_same() {
    let one = solved("asperities", &[("numerics.tolerance", "1e-6")]).2;
    let all = solved("asperities", &[("numerics.tolerance", "1e-6"), ("numerics.teeth", "all")]).2;
    assert!((one.alpha.value - all.alpha.value).abs() < 1e-5, "{} {}", one.alpha, all.alpha);
}

#[test]
fn under_a_light_load_the_rotor_floats_over_the_asperities() {
    let result = solved("asperities", &[("motor.load_per_wave_n", "0.1"), ("surface.rms_nm", "50")]).2;
    assert!(result.levitated && result.teeth_in_contact.value == 0.0, "{result:?}");
    assert!((result.alpha.value - 1.0).abs() < 1e-2 + result.alpha.error, "{result:?}");
}

/// A motor on summits so stiff and so far apart that they all carry at one height has the film share of the hard stop there.
#[test]
fn a_motor_on_stiff_asperities_is_the_one_with_the_hard_stop() {
    let hard = scenes::motor("fundamental", &[]);
    let alpha = |motor: &Motor| {
        let plan = Plan::motor(motor, Fidelity::Draft, &Numerics::default()).unwrap();
        let found = motor::periodic(motor, &plan, &mut (), &Cancel::new()).unwrap();
        assert_eq!(found.status, Status::Converged);
        found.result.alpha.value
    };
    let exact = alpha(&hard);
    let mut last = f64::INFINITY;
    for u in [9.0, 18.0, 36.0] {
        let rms = hard.min_spacing / u;
        // Three of nine teeth carry it.
        let pressure = hard.load / (3.0 * hard.tooth_width * hard.contact_width);
        let soft = asperities(rms, 1.0, "greenwood-williamson", "gaussian").pressure(hard.min_spacing).0;
        let stiff = asperities(rms, pressure / soft, "greenwood-williamson", "gaussian");
        let motor = Motor { surface: Surface { asperities: Some(stiff), flow: None }, ..hard.clone() };
        let off = (alpha(&motor) / exact - 1.0).abs();
        assert!(off < 0.7 * last, "{u}: {off} {last}");
        last = off;
    }
    assert!(last < 0.02, "{last}");
}

#[test]
fn flow_factors_matter_where_gas_has_time_to_leave_and_vanish_with_the_roughness() {
    let at = |changes: &[(&str, &str)]| solved("rough-flow", changes).2.alpha.value;
    let slow = |lay: &str| at(&[("stator.frequency_khz", "3"), ("surface.lay", lay)]);
    let (across, even, along) = (slow("0.2"), slow("1"), slow("5"));
    // Grooves along the wave are walls to what leaves at the sides.
    assert!(across < 0.9 * even && even < 0.95 * along, "{across} {even} {along}");
    let smooth = solved("fundamental", &[]).2.alpha.value;
    let fine = [("surface.flow_factors", "patir-cheng"), ("surface.rms_nm", "10")];
    assert!((solved("fundamental", &fine).2.alpha.value / smooth - 1.0).abs() < 1e-4);
    let rough = [("surface.flow_factors", "patir-cheng"), ("surface.rms_nm", "100")];
    assert!((solved("fundamental", &rough).2.alpha.value / smooth - 1.0).abs() > 0.01);
}

#[test]
fn the_film_is_as_thin_as_is_said_to_within_its_error() {
    let motor = |fidelity| {
        let problem = scenes::problem("asperities", &[]);
        solve(&problem, &Settings { fidelity, ..Settings::default() }, &mut (), &Cancel::new()).unwrap().recording
    };
    let exact = motor(Fidelity::Reference);
    for fidelity in [Fidelity::Draft, Fidelity::Standard, Fidelity::Fine] {
        let found = motor(fidelity);
        let every = exact.frames / found.frames;
        for (frame, thickness) in found.min_film_thickness.iter().enumerate() {
            let (error, off) =
                (found.min_film_thickness_error[frame], (thickness - exact.min_film_thickness[frame * every]).abs());
            assert!(off <= error && error < 3e-9, "{fidelity} {frame}: {off:e} {error:e}");
        }
    }
}

#[test]
fn teeth_that_seem_to_float_may_touch_within_the_error() {
    // Loads at which a coarse grid just misses the contact, on asperities and on a hard stop.
    for (preset, load, fidelity) in [
        ("asperities", "0.2071206", Fidelity::Draft),
        ("asperities", "0.2071956", Fidelity::Standard),
        ("fundamental", "0.4882669", Fidelity::Standard),
    ] {
        let motor = |fidelity| {
            let problem = scenes::problem(preset, &[("motor.load_per_wave_n", load)]);
            let solution = solve(&problem, &Settings { fidelity, ..Settings::default() }, &mut (), &Cancel::new());
            let Outcome::Motor(result) = solution.unwrap().outcome else { panic!("{preset} is a motor") };
            result
        };
        let (found, exact) = (motor(fidelity), motor(Fidelity::Reference));
        assert!(found.teeth_in_contact.value == 0.0 && !exact.levitated, "{preset} {load}: {found:?} {exact:?}");
        // On the hard stop the finest grid tells.
        assert_eq!(found.levitated, preset == "asperities", "{found:?}");
        assert!(exact.teeth_in_contact.value <= found.teeth_in_contact.error, "{preset} {load}: {found:?} {exact:?}");
    }
}

#[test]
fn what_a_surface_rules_out_is_refused_by_name() {
    let mut scene = presets::find("asperities").unwrap();
    let message = scene.set("film.min_spacing_nm", "100").unwrap_err().to_string();
    assert!(message.contains("surface.model") && message.contains("minimum-spacing"), "{message}");
    let message = presets::find("fundamental").unwrap().set("surface.rms_nm", "100").unwrap_err().to_string();
    assert!(message.contains("surface.model") && message.contains("asperities"), "{message}");
    let paper = Settings { method: Method::Paper, ..Settings::default() };
    let refused = solve(&Problem::try_from(&scene).unwrap(), &paper, &mut (), &Cancel::new()).unwrap_err();
    assert!(matches!(refused, SolveError::PaperSurface) && refused.is_bad_input());
    let mut scene = presets::find("rough-flow").unwrap();
    scene.set("numerics.time", "trapped").unwrap();
    let message = Problem::try_from(&scene).unwrap_err().to_string();
    assert!(message.contains("surface.flow_factors"), "{message}");
    // Back to the hard stop: what belongs to asperities is gone, and the roughness of the flow stays.
    scene.set("surface.model", "minimum-spacing").unwrap();
    assert!(scene.get("surface.summit_radius_um").is_none() && scene.get("surface.rms_nm").is_some());
}
