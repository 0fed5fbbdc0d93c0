//! Measures the tables of `docs/validation.md` that are not printed by tests, in Markdown.
//!
//! ```text
//! cargo run --release --example validation [table1] [mesh] [grids] [fidelity] [spacing] [slip] [limits] [ranges]   (none: all)
//! cargo run --release --example validation memory LEVEL
//! ```

#![allow(clippy::print_stdout)]

use squeezefilm::control::Cancel;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::motor;
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Problem, Scenario};
use squeezefilm::scene::{presets, table1};
use squeezefilm::solution::{MotorResult, Outcome, Solution, Status};
use squeezefilm::solve::{Method, Settings, solve};
use std::error::Error;
use std::time::Instant;

type Outline = Result<(), Box<dyn Error>>;
/// A part of the page, by name.
type Part = (&'static str, fn() -> Outline);

fn main() -> Outline {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    if let [first, level] = &asked[..]
        && first == "memory"
    {
        return memory(level.parse()?);
    }
    let parts: [Part; 8] = [
        ("table1", table),
        ("mesh", mesh),
        ("grids", grids),
        ("fidelity", fidelities),
        ("spacing", spacing),
        ("slip", slip_laws),
        ("limits", limits),
        ("ranges", ranges),
    ];
    for (name, part) in parts {
        if asked.is_empty() || asked.iter().any(|a| a == name) {
            println!("\n## {name}\n");
            part()?;
        }
    }
    Ok(())
}

/// Solves a preset with some keys changed.
fn run(
    preset: &str,
    changes: &[(&str, &str)],
    method: Method,
    fidelity: Fidelity,
) -> Result<(Solution, MotorResult), Box<dyn Error>> {
    let mut scene = presets::find(preset)?;
    scene.set_all(changes.iter().copied())?;
    let solution =
        solve(&Problem::new(&scene)?, &Settings { fidelity, method, ..Settings::default() }, &mut (), &Cancel::new())?;
    match solution.outcome {
        Outcome::Motor(result) => Ok((solution, result)),
        Outcome::Plate(_) => Err("a plate has no share of a load".into()),
    }
}

fn mark(status: Status) -> &'static str {
    if status == Status::Converged { "" } else { ", not converged" }
}

/// Table I: published, the paper's method on the paper's meshes, and the mesh-independent value.
fn table() -> Outline {
    println!("| row | published [N] | paper's method [N] | | converged [N] | ± [N] | |");
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: |");
    for row in table1::published() {
        let (paper, on_mesh) = run(&row.preset, &[], Method::Paper, Fidelity::Standard)?;
        let (own, converged) = run(&row.preset, &[], Method::Auto, Fidelity::Fine)?;
        let off = |load: f64| 100.0 * (load / row.published_load_n - 1.0);
        println!(
            "| {} | {:.3} | {:.4}{} | {:+.1} % | {:.4}{} | {:.0e} | {:+.1} % |",
            row.row.replace('_', " "),
            row.published_load_n,
            on_mesh.film_load,
            mark(paper.status),
            off(on_mesh.film_load),
            converged.film_load,
            mark(own.status),
            converged.alpha_error * 2.45,
            off(converged.film_load),
        );
    }
    Ok(())
}

/// The paper's method on finer meshes, one direction at a time, and all together.
fn mesh() -> Outline {
    println!("| film nodes along × across | contact nodes | steps | load [N] | α |");
    println!("| --- | ---: | ---: | ---: | ---: |");
    for (along, across, contact, steps) in [
        (51, 11, 181, 180),
        (101, 11, 181, 180),
        (51, 11, 361, 180),
        (51, 11, 181, 360),
        (51, 21, 181, 180),
        (51, 41, 181, 180),
        (51, 81, 181, 180),
        (101, 21, 361, 180),
        (201, 41, 721, 180),
        (201, 81, 721, 360),
    ] {
        let changes = [
            ("numerics.film_nodes_along", along),
            ("numerics.film_nodes_across", across),
            ("numerics.contact_nodes", contact),
            ("numerics.steps_per_cycle", steps),
        ]
        .map(|(key, value)| (key, value.to_string()));
        let changes: Vec<(&str, &str)> = changes.iter().map(|(key, value)| (*key, value.as_str())).collect();
        let (solution, result) = run("fundamental", &changes, Method::Paper, Fidelity::Standard)?;
        println!(
            "| {along} × {across} | {contact} | {steps} | {:.4}{} | {:.5} |",
            result.film_load,
            mark(solution.status),
            result.alpha
        );
    }
    Ok(())
}

/// α on each of the nested grids, and what is made of them.
fn grids() -> Outline {
    println!("| fidelity | intervals along × across half the width, steps | α on the grid | extrapolated |");
    println!("| --- | --- | ---: | ---: |");
    let problem = Problem::new(&presets::find("fundamental")?)?;
    let Scenario::Motor(motor) = &problem.scenario else { return Err("the fundamental case is a motor".into()) };
    for fidelity in Fidelity::ALL {
        let plan = Plan::motor(motor, fidelity, &problem.numerics);
        let found = motor::periodic(motor, &plan, &mut (), &Cancel::new())?;
        for (number, (grid, alpha)) in plan.grids.iter().zip(&found.alphas).enumerate() {
            let name = if number == 0 { fidelity.name() } else { "" };
            let value = match number.checked_sub(1) {
                Some(before) => format!("{:.6}", alpha + (alpha - found.alphas[before]) / 3.0),
                None => String::new(),
            };
            println!("| {name} | {} × {}, {} | {alpha:.6} | {value} |", grid.along, grid.across, grid.steps);
        }
    }
    Ok(())
}

/// Shortest of a few runs \[s\].
fn shortest(runs: usize, mut run: impl FnMut() -> Outline) -> Result<f64, Box<dyn Error>> {
    let mut best = f64::INFINITY;
    for _ in 0..runs {
        let start = Instant::now();
        run()?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(best)
}

/// Error and cost of each fidelity in the fundamental case.
fn fidelities() -> Outline {
    let exact = run("fundamental", &[], Method::Auto, Fidelity::Reference)?.1.alpha;
    let paper_time = shortest(3, || run("fundamental", &[], Method::Paper, Fidelity::Standard).map(|_| ()))?;
    println!("| | α | stated error | true error | rounds | film steps | film solves | contact solves | time |");
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    let settings = Fidelity::ALL.map(|level| (level.name(), Method::Auto, level)).into_iter().chain([(
        "paper's method",
        Method::Paper,
        Fidelity::Standard,
    )]);
    for (name, method, level) in settings {
        let (solution, result) = run("fundamental", &[], method, level)?;
        let time = match (method, level) {
            (Method::Paper, _) => paper_time,
            (_, Fidelity::Reference) => shortest(1, || run("fundamental", &[], method, level).map(|_| ()))?,
            _ => shortest(5, || run("fundamental", &[], method, level).map(|_| ()))?,
        };
        let truth = if method == Method::Auto && level == Fidelity::Reference {
            "–".to_owned()
        } else {
            format!("{:.1e}", (result.alpha - exact).abs())
        };
        println!(
            "| {name} | {:.5} | {:.1e} | {truth} | {} | {} | {} | {} | {:.3} |",
            result.alpha,
            result.alpha_error,
            solution.stats.coupling_iterations,
            solution.stats.film_steps,
            solution.stats.film_solves,
            solution.stats.contact_solves,
            time / paper_time,
        );
    }
    println!("\nTime of the paper's method, and the unit of the last column: {:.0} ms.", 1e3 * paper_time);
    Ok(())
}

/// From rough faces to a rotor that floats. Below the 5 nm that a preset allows nothing is claimed.
fn spacing() -> Outline {
    println!("| H_m [nm] | α | stated error | 1 − α | teeth in contact | least h [nm] | rounds |");
    println!("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    for nm in
        ["1000", "700", "500", "400", "300", "200", "150", "100", "70", "50", "40", "30", "20", "15", "10", "7", "5"]
    {
        let (solution, result) = run("fundamental", &[("film.min_spacing_nm", nm)], Method::Auto, Fidelity::Standard)?;
        println!(
            "| {nm} | {:.5}{} | {:.1e} | {:.1e} | {:.2} | {:.1} | {} |",
            result.alpha,
            mark(solution.status),
            result.alpha_error,
            1.0 - result.alpha,
            result.teeth_in_contact,
            1e9 * result.min_gap,
            solution.stats.coupling_iterations,
        );
    }
    Ok(())
}

/// What the slip law and the wedge term change in the fundamental case.
fn slip_laws() -> Outline {
    println!("| change | α | |");
    println!("| --- | ---: | ---: |");
    let base = run("fundamental", &[], Method::Auto, Fidelity::Fine)?.1.alpha;
    for (what, key, value) in [
        ("none: first-order slip", "film.slip", "first-order"),
        ("no slip", "film.slip", "none"),
        ("second-order slip", "film.slip", "second-order"),
        ("Fukui and Kaneko", "film.slip", "fukui-kaneko"),
        ("no wedge term", "film.shear", "false"),
    ] {
        let alpha = run("fundamental", &[(key, value)], Method::Auto, Fidelity::Fine)?.1.alpha;
        println!("| {what} | {alpha:.5} | {:+.2} % |", 100.0 * (alpha / base - 1.0));
    }
    Ok(())
}

/// Corners of the allowed ranges that cost the most rounds, and a light load.
fn limits() -> Outline {
    println!("| change of the fundamental case | α | stated error | rounds on the three grids |");
    println!("| --- | ---: | ---: | ---: |");
    for changes in [
        &[("motor.load_per_wave_n", "0.1")][..],
        &[("motor.load_per_wave_n", "0.01")],
        &[("film.ambient_pressure_kpa", "1000")],
        &[("film.ambient_pressure_kpa", "1000"), ("motor.load_per_wave_n", "0.01")],
        &[("film.ambient_pressure_kpa", "1")],
        &[("stator.frequency_khz", "1000")],
        &[("stator.frequency_khz", "0.1")],
        &[("stator.normal_amplitude_um", "10")],
    ] {
        let words: Vec<String> = changes.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        match run("fundamental", changes, Method::Auto, Fidelity::Standard) {
            Ok((solution, result)) => println!(
                "| {} | {:.5}{} | {:.1e} | {} |",
                words.join(", "),
                result.alpha,
                mark(solution.status),
                result.alpha_error,
                solution.stats.coupling_iterations
            ),
            Err(error) => println!("| {} | {error} | | |", words.join(", ")),
        }
    }
    Ok(())
}

/// Motors drawn from nearly the whole of the allowed ranges: how many are solved at draft, and what the others are.
fn ranges() -> Outline {
    const MOTORS: usize = 400;
    let mut seed = 99u64;
    let mut random = |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let (mut solved, mut rounds) = (0, Vec::new());
    for _ in 0..MOTORS {
        let (teeth, waves) = (random(1.0, 25.0) as u32, random(1.0, 101.0) as u32);
        let (radius, fill) = (10f64.powf(random(0.0, 2.69)), random(0.0101, 0.999));
        let pitch = std::f64::consts::TAU * radius / f64::from(waves) / f64::from(teeth);
        let mut changes = vec![
            ("stator.teeth_per_wave", teeth.to_string()),
            ("motor.waves", waves.to_string()),
            ("motor.contact_radius_mm", radius.to_string()),
            ("stator.tooth_width_mm", (fill * pitch).to_string()),
            ("motor.rotor_speed_rpm", random(-1000.0, 1000.0).to_string()),
        ];
        for (key, low, high) in [
            ("motor.load_per_wave_n", -2.0, 2.0),
            ("stator.frequency_khz", -3.0, 4.0),
            ("stator.normal_amplitude_um", -3.0, 1.3),
            ("film.min_spacing_nm", 0.7, 4.0),
            ("rotor.contact_width_mm", -2.0, 1.0),
            ("film.ambient_pressure_kpa", -2.0, 3.0),
            ("rotor.decay_length_mm", -1.0, 2.0),
            ("rotor.point_compliance_um_per_n", -3.0, 2.0),
        ] {
            changes.push((key, 10f64.powf(random(low, high)).to_string()));
        }
        let words: Vec<(&str, &str)> = changes.iter().map(|(key, value)| (*key, value.as_str())).collect();
        let (solution, result) = run("fundamental", &words, Method::Auto, Fidelity::Draft)?;
        rounds.push(solution.stats.coupling_iterations);
        if solution.status == Status::Converged {
            solved += 1;
        } else {
            let sets: Vec<String> = words.iter().map(|(key, value)| format!("--set {key}={value}")).collect();
            println!("not converged: α = {:.3} ± {:.1e}: {}\n", result.alpha, result.alpha_error, sets.join(" "));
        }
    }
    rounds.sort_unstable();
    println!(
        "{solved} of {MOTORS} solved; rounds on the three grids: median {}, 95 % {}, most {}",
        rounds[MOTORS / 2],
        rounds[MOTORS * 95 / 100],
        rounds[MOTORS - 1]
    );
    Ok(())
}

/// One solve, then the greatest resident memory of this process (Linux).
fn memory(level: Fidelity) -> Outline {
    let (_, result) = run("fundamental", &[], Method::Auto, level)?;
    let status = std::fs::read_to_string("/proc/self/status")?;
    let peak = status.lines().find(|line| line.starts_with("VmHWM")).unwrap_or("VmHWM is not known here");
    println!("{level}: α = {:.5}, {peak}", result.alpha);
    Ok(())
}
