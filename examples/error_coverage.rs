//! Is the stated error of α, or of a plate's mean load ratio, honest? Random motors or plates, each solved at every fidelity, and within a
//! budget that is spent at once, which gives the first grids of any budget; the true error is taken to be the distance to reference.
//! Measured numbers are in `docs/validation.md`. Of any other result, named as in `--json`, errors are relative to the value at reference,
//! and scenes that do not have it are left out.
//!
//! ```text
//! cargo run --release --example error_coverage [mild|wide|plates|closing|rough|stiff] [COUNT] [RESULT]
//! ```
//!
//! `mild` draws parameters within a factor of up to 5 of the fundamental case, `wide` over up to two decades either
//! way; `plates` draws strips, rectangles and discs at squeeze numbers from 10⁻³ to 10⁶ and any amplitude below the gap, `closing` those that come
//! near to touching, at squeeze numbers from 10⁻² to 10²; `rough` are mild motors whose faces meet on asperities, `stiff` those
//! whose rotor has no local compliance, and a decay length from 0.3 to 10 mm. Every draw is the same on every run. Scenes whose error is not covered, or that do
//! not converge, are printed with the keys to repeat them.

#![allow(clippy::print_stdout, clippy::print_stderr)]

use squeezefilm::analysis::quantity::Quantity::{Alpha, LoadRatio};
use squeezefilm::analysis::quantity::{Numbers, Quantity};
use squeezefilm::control::Cancel;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::problem::Problem;
use squeezefilm::scene::presets;
use squeezefilm::solution::Status;
use squeezefilm::solve::{Settings, SolveError, solve};
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
/// The same of plates, but for shape and amplitude, which is a part of the gap.
const DRAWN_PLATES: [(&str, f64, f64, f64, f64); 5] = [
    ("plate.mean_gap_um", 3.0, 0.8, 1e-3, 1e3),
    ("plate.frequency_khz", 20.0, 1.0, 1e-3, 1e4),
    ("film.ambient_pressure_kpa", 101.0, 0.5, 0.01, 1e3),
    ("film.viscosity_upa_s", 18.0, 0.3, 1.0, 1e3),
    ("film.mean_free_path_nm", 64.0, 0.5, 1.0, 1e4),
];
/// An error of α that no one will mind.
const NEGLIGIBLE: f64 = 1e-6;
/// A result below which errors relative to it say nothing.
const LEAST_OTHER: f64 = 1e-4;
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
    let drawn = match arguments.first().map(String::as_str) {
        None | Some("mild") => |random: &mut Random| draw(random, 1.0),
        Some("wide") => |random: &mut Random| draw(random, WIDER),
        Some("plates") => draw_plate,
        Some("closing") => draw_closing,
        Some("rough") => draw_rough,
        Some("stiff") => draw_stiff,
        Some(other) => return Err(format!("{other}: expected mild, wide, plates, closing, rough or stiff").into()),
    };
    let count: u32 = arguments.get(1).map_or(Ok(200), |text| text.parse())?;
    let named = |key: &String| Quantity::all().find(|one| one.name() == key).ok_or_else(|| format!("{key}: no result"));
    let quantity = arguments.get(2).map(named).transpose()?;

    let mut random = Random(12345);
    let spent = Cancel::new().with_budget(|| || true);
    let named = [Fidelity::Draft, Fidelity::Standard, Fidelity::Fine].map(|one| (one.name(), one, Cancel::new()));
    let judged = [("no time", Fidelity::Reference, spent)].into_iter().chain(named);
    let mut judged: Vec<_> = judged.map(|(name, fidelity, cancel)| (Tally::new(name), fidelity, cancel)).collect();
    let mut uncovered = String::new();
    for _ in 0..count {
        let (preset, changes) = drawn(&mut random);
        let words: Vec<String> = changes.iter().map(|(key, value)| format!("--set {key}={value}")).collect();
        let words = format!("{preset} {}", words.join(" "));
        let solve = |fidelity, cancel: &Cancel| found(preset, &changes, fidelity, quantity, cancel);
        let reference = match solve(Fidelity::Reference, &Cancel::new())? {
            Ok(reference) => reference,
            Err(error) => {
                writeln!(uncovered, "reference: {error}: {words}")?;
                continue;
            }
        };
        if quantity.is_some() && !(reference.value.abs() > LEAST_OTHER && reference.error.is_finite()) {
            continue;
        }
        let unit = if quantity.is_some() { reference.value.abs() } else { 1.0 };
        for (tally, fidelity, cancel) in &mut judged {
            match solve(*fidelity, cancel)? {
                Ok(found) if found.value.is_nan() => {}
                Ok(found) => {
                    let covered = tally.add(&found.over(unit), &reference.over(unit));
                    let all_converged = [&found, &reference].iter().all(|one| one.status == Status::Converged);
                    if !covered || !all_converged {
                        let mark = if all_converged { "" } else { ", not converged" };
                        writeln!(
                            uncovered,
                            "{}{mark}: {:.5} ± {:.1e}, reference {:.5} ± {:.1e}: {words}",
                            tally.name, found.value, found.error, reference.value, reference.error,
                        )?;
                    }
                }
                Err(error) => writeln!(uncovered, "{}: {error}: {words}", tally.name)?,
            }
        }
    }
    let mut table =
        "| | scenes | not converged | covered | with reference's own | missed by more than 1e-6 | median true \
                     | 90 % | worst | median stated/true |\n\
                     | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n"
            .to_owned();
    for (tally, ..) in &mut judged {
        tally.print(&mut table)?;
    }
    Ok((table, uncovered))
}

/// A preset and its changes.
type Drawn = (&'static str, Vec<(&'static str, String)>);

/// A motor with a random set of values, over so many times the decades of the mild sample.
fn draw(random: &mut Random, wider: f64) -> Drawn {
    let teeth = if wider > 1.0 { 1 + random.below(30) } else { 5 + random.below(12) };
    // The pitch of the fundamental case's ring.
    let pitch = std::f64::consts::TAU * 29.0 / 7.0 / f64::from(teeth);
    let mut changes = vec![
        ("stator.teeth_per_wave", teeth.to_string()),
        ("stator.tooth_width_mm", (pitch * (0.15 + 0.84 * random.unit())).to_string()),
    ];
    changes.extend(values(random, &DRAWN, wider).map(|(key, value)| (key, value.to_string())));
    ("fundamental", changes)
}

/// A mild motor whose faces meet on asperities: heights vary as much as the spacing of the others.
fn draw_rough(random: &mut Random) -> Drawn {
    let (_, changes) = draw(random, 1.0);
    let rough = |(key, value)| (if key == DRAWN[0].0 { "surface.rms_nm" } else { key }, value);
    ("asperities", changes.into_iter().map(rough).collect())
}

/// Mild motors whose rotor has no local compliance, and a decay length from 0.3 to 10 mm.
fn draw_stiff(random: &mut Random) -> Drawn {
    let (preset, mut changes) = draw(random, 1.0);
    changes.retain(|(key, _)| *key != "rotor.decay_length_mm");
    changes.push(("rotor.decay_length_mm", (0.3 * 10f64.powf(1.5 * random.unit())).to_string()));
    changes.push(("rotor.local_compliance_m2_per_n", "0".into()));
    (preset, changes)
}

/// A strip, a rectangle or a disc.
fn draw_plate(random: &mut Random) -> Drawn {
    let shape = random.below(3);
    let excursion = random.unit();
    let drawn: Vec<(&str, f64)> = values(random, &DRAWN_PLATES, 1.0).collect();
    let mut changes: Vec<(&'static str, String)> = drawn.iter().map(|(key, value)| (*key, value.to_string())).collect();
    changes.push(("plate.amplitude_um", (0.99 * excursion * drawn[0].1).to_string()));
    changes.extend(outline(random, shape).1);
    ("plate-crossover", changes)
}

/// One of them, 5 µm above the wall, that leaves a fifth to a hundredth of its gap.
fn draw_closing(random: &mut Random) -> Drawn {
    let shape = random.below(3);
    let (excursion, squeeze_number) = (0.8 + 0.19 * random.unit(), 10f64.powf(4.0 * random.unit() - 2.0));
    let (length, mut changes) = outline(random, shape);
    let (pressure, viscosity, gap) = (101_325.0, 18.1e-6, 5e-6);
    let omega = squeeze_number * pressure * gap * gap / (12.0 * viscosity * (length * 1e-3).powi(2));
    changes.extend([
        ("plate.mean_gap_um", "5".to_owned()),
        ("plate.amplitude_um", (5.0 * excursion).to_string()),
        ("plate.frequency_khz", (omega / std::f64::consts::TAU * 1e-3).to_string()),
        ("film.viscosity_upa_s", "18.1".to_owned()),
    ]);
    ("plate-crossover", changes)
}

/// A length \[mm\], and the keys of a strip of that length, of a rectangle, or of a disc of that diameter.
fn outline(random: &mut Random, shape: u32) -> (f64, Vec<(&'static str, String)>) {
    let length = 10f64.powf(0.6 * (2.0 * random.unit() - 1.0));
    let width = length * (0.2 + 0.8 * random.unit());
    let keys = match shape {
        0 => vec![("plate.length_mm", length.to_string())],
        1 => vec![("plate.length_mm", length.to_string()), ("plate.width_mm", width.to_string())],
        _ => vec![("plate.shape", "disc".to_owned()), ("plate.radius_mm", (0.5 * length).to_string())],
    };
    (length, keys)
}

/// A value for each key.
fn values<'a>(
    random: &'a mut Random,
    drawn: &'a [(&'static str, f64, f64, f64, f64)],
    wider: f64,
) -> impl Iterator<Item = (&'static str, f64)> + 'a {
    drawn.iter().map(move |(key, middle, decades, least, greatest)| {
        let value = middle * 10f64.powf(wider * decades * (2.0 * random.unit() - 1.0));
        (*key, value.clamp(*least, *greatest))
    })
}

/// What a solve says of α, of the mean load ratio of a plate, or of what is asked for.
struct Found {
    value: f64,
    error: f64,
    status: Status,
}

impl Found {
    fn over(&self, unit: f64) -> Self {
        Self { value: self.value / unit, error: self.error / unit, status: self.status }
    }
}

fn found(
    preset: &str,
    changes: &[(&str, String)],
    fidelity: Fidelity,
    quantity: Option<Quantity>,
    cancel: &Cancel,
) -> Result<Result<Found, SolveError>, Box<dyn Error>> {
    let mut scene = presets::find(preset)?;
    scene.set_all(changes.iter().map(|(key, value)| (*key, value.as_str())))?;
    let problem = Problem::try_from(&scene)?;
    let settings = Settings { fidelity, ..Settings::default() };
    Ok(solve(&problem, &settings, &mut (), cancel).map(|solution| {
        let numbers = Numbers::of(&problem, &solution);
        let asked = quantity.unwrap_or(if numbers.get(Alpha).is_some() { Alpha } else { LoadRatio });
        let value = numbers.get(asked).unwrap_or(f64::NAN);
        let error = asked.error().and_then(|error| numbers.get(error)).unwrap_or(f64::INFINITY);
        Found { value, error, status: solution.status }
    }))
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
    fn add(&mut self, found: &Found, reference: &Found) -> bool {
        let error = (found.value - reference.value).abs();
        let stated = found.error;
        self.not_converged += usize::from(found.status != Status::Converged);
        self.covered += usize::from(error <= stated);
        self.covered_with_reference += usize::from(error <= stated + reference.error);
        self.missed += usize::from(error > stated && error > NEGLIGIBLE);
        self.true_errors.push(error);
        if error > NEGLIGIBLE {
            self.ratios.push(stated / error);
        }
        error <= stated
    }

    fn print(&mut self, table: &mut String) -> std::fmt::Result {
        let scenes = self.true_errors.len();
        if scenes == 0 {
            return Ok(());
        }
        self.true_errors.sort_by(f64::total_cmp);
        self.ratios.sort_by(f64::total_cmp);
        writeln!(
            table,
            "| {} | {scenes} | {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1} |",
            self.name,
            self.not_converged,
            self.covered,
            self.covered_with_reference,
            self.missed,
            self.true_errors[scenes / 2],
            self.true_errors[scenes * 9 / 10],
            self.true_errors[scenes - 1],
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
