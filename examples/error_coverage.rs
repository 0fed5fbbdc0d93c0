//! Is the stated error of α honest? Random motors, each solved at every fidelity; the true error of the others is taken to
//! be the distance to reference. Measured numbers are in `docs/validation.md`.
//!
//! ```text
//! cargo run --release --example error_coverage [mild|wide] [COUNT]
//! ```
//!
//! `mild` draws parameters within a factor of up to 5 of the fundamental case, `wide` over up to two decades either
//! way. Every draw is the same on every run. Motors whose error is
//! not covered, or that do not converge, are printed with the keys to repeat them.

#![allow(clippy::print_stdout, clippy::print_stderr)]

use squeezefilm::control::Cancel;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::motor::{self, MotorError, Periodic};
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Problem, Scenario};
use squeezefilm::scene::presets;
use squeezefilm::solution::Status;
use std::error::Error;
use std::fmt::Write;

/// Key, middle of the range, decades either way in the mild sample, least and greatest value allowed.
const DRAWN: [(&str, f64, f64, f64, f64); 8] = [
    ("film.min_spacing_nm", 150.0, 0.45, 5.0, 1e4),
    ("stator.frequency_khz", 30.0, 0.7, 1e-3, 1e4),
    ("motor.load_per_wave_n", 2.45, 0.5, 0.01, 100.0),
    ("stator.normal_amplitude_um", 1.3, 0.3, 0.0, 20.0),
    ("rotor.contact_width_mm", 0.3, 0.4, 0.01, 10.0),
    ("film.ambient_pressure_kpa", 101.0, 0.3, 0.01, 1e3),
    ("rotor.point_compliance_um_per_n", 0.64, 0.4, 1e-3, 100.0),
    ("rotor.decay_length_mm", 4.0, 0.2, 0.1, 100.0),
];
/// An error of α that no one will mind.
const NEGLIGIBLE: f64 = 1e-6;
/// Decades of the wide sample over those of the mild one.
const WIDER: f64 = 3.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (table, uncovered) = report(&arguments)?;
    eprint!("{uncovered}");
    print!("{table}");
    Ok(())
}

/// The table, and the motors whose error is not covered or that do not converge, with the keys to repeat them.
pub(crate) fn report(arguments: &[String]) -> Result<(String, String), Box<dyn Error>> {
    let wide = match arguments.first().map(String::as_str) {
        None | Some("mild") => false,
        Some("wide") => true,
        Some(other) => return Err(format!("{other}: expected mild or wide").into()),
    };
    let count: u32 = arguments.get(1).map_or(Ok(200), |text| text.parse())?;

    let mut random = Random(12345);
    let judged = [Fidelity::Draft, Fidelity::Standard, Fidelity::Fine];
    let mut tallies = judged.map(|fidelity| Tally::new(fidelity.name()));
    let mut uncovered = String::new();
    for _ in 0..count {
        let changes = draw(&mut random, wide);
        let words: Vec<String> = changes.iter().map(|(key, value)| format!("--set {key}={value}")).collect();
        let words = words.join(" ");
        let solve = |fidelity| solve(&changes, fidelity);
        let reference = match solve(Fidelity::Reference)? {
            Ok(reference) => reference,
            Err(error) => {
                writeln!(uncovered, "reference: {error}: {words}")?;
                continue;
            }
        };
        for (tally, fidelity) in tallies.iter_mut().zip(judged) {
            match solve(fidelity)? {
                Ok(found) => {
                    let covered = tally.add(&found, &reference);
                    let all_converged = [&found, &reference].iter().all(|one| one.status == Status::Converged);
                    if !covered || !all_converged {
                        let mark = if all_converged { "" } else { ", not converged" };
                        writeln!(
                            uncovered,
                            "{fidelity}{mark}: α = {:.5} ± {:.1e}, reference {:.5} ± {:.1e}: {words}",
                            found.result.alpha,
                            found.result.alpha_error,
                            reference.result.alpha,
                            reference.result.alpha_error,
                        )?;
                    }
                }
                Err(error) => writeln!(uncovered, "{fidelity}: {error}: {words}")?,
            }
        }
    }
    let mut table =
        "| | motors | not converged | covered | with reference's own | missed by more than 1e-6 | median true \
                     | 90 % | worst | median stated/true |\n\
                     | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n"
            .to_owned();
    for tally in &mut tallies {
        tally.print(&mut table)?;
    }
    Ok((table, uncovered))
}

/// A motor with a random set of values.
fn draw(random: &mut Random, wide: bool) -> Vec<(&'static str, String)> {
    let teeth = if wide { 1 + random.below(30) } else { 5 + random.below(12) };
    // The pitch of the fundamental case's ring.
    let pitch = std::f64::consts::TAU * 29.0 / 7.0 / f64::from(teeth);
    let mut changes = vec![
        ("stator.teeth_per_wave", teeth.to_string()),
        ("stator.tooth_width_mm", (pitch * (0.15 + 0.84 * random.unit())).to_string()),
    ];
    for (key, middle, decades, least, greatest) in DRAWN {
        let decades = if wide { WIDER * decades } else { decades };
        let value = middle * 10f64.powf(decades * (2.0 * random.unit() - 1.0));
        changes.push((key, value.clamp(least, greatest).to_string()));
    }
    changes
}

fn solve(changes: &[(&str, String)], fidelity: Fidelity) -> Result<Result<Periodic, MotorError>, Box<dyn Error>> {
    let mut scene = presets::find("fundamental")?;
    scene.set_all(changes.iter().map(|(key, value)| (*key, value.as_str())))?;
    let problem = Problem::new(&scene)?;
    let Scenario::Motor(motor) = &problem.scenario else { return Err("the fundamental case is a motor".into()) };
    Ok(motor::periodic(motor, &Plan::motor(motor, fidelity, &problem.numerics)?, &mut (), &Cancel::new()))
}

/// Stated and true errors of one fidelity.
struct Tally {
    name: &'static str,
    not_converged: usize,
    covered: usize,
    covered_with_reference: usize,
    /// Not covered, and off by more than `NEGLIGIBLE`.
    missed: usize,
    true_errors: Vec<f64>,
    ratios: Vec<f64>,
}

impl Tally {
    fn new(name: &'static str) -> Self {
        Self {
            name,
            not_converged: 0,
            covered: 0,
            covered_with_reference: 0,
            missed: 0,
            true_errors: Vec::new(),
            ratios: Vec::new(),
        }
    }

    /// Whether the stated error covers the true one.
    fn add(&mut self, found: &Periodic, reference: &Periodic) -> bool {
        let error = (found.result.alpha - reference.result.alpha).abs();
        let stated = found.result.alpha_error;
        self.not_converged += usize::from(found.status != Status::Converged);
        self.covered += usize::from(error <= stated);
        self.covered_with_reference += usize::from(error <= stated + reference.result.alpha_error);
        self.missed += usize::from(error > stated && error > NEGLIGIBLE);
        self.true_errors.push(error);
        if error > NEGLIGIBLE {
            self.ratios.push(stated / error);
        }
        error <= stated
    }

    fn print(&mut self, table: &mut String) -> std::fmt::Result {
        let motors = self.true_errors.len();
        if motors == 0 {
            return Ok(());
        }
        self.true_errors.sort_by(f64::total_cmp);
        self.ratios.sort_by(f64::total_cmp);
        writeln!(
            table,
            "| {} | {motors} | {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1} |",
            self.name,
            self.not_converged,
            self.covered,
            self.covered_with_reference,
            self.missed,
            self.true_errors[motors / 2],
            self.true_errors[motors * 9 / 10],
            self.true_errors[motors - 1],
            self.ratios.get(self.ratios.len() / 2).copied().unwrap_or(f64::NAN),
        )
    }
}

/// Knuth's 64-bit linear congruence: the same draws on every machine.
struct Random(u64);

impl Random {
    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A whole number below `limit`.
    fn below(&mut self, limit: u32) -> u32 {
        (self.unit() * f64::from(limit)) as u32
    }
}
