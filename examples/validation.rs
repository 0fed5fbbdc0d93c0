//! Measures, in Markdown, what docs/validation.md shows and no command of the program prints.
//!
//! ```text
//! cargo run --release --example validation grids|mesh|slip
//! ```

#![allow(clippy::print_stdout)]

use squeezefilm::control::Cancel;
use squeezefilm::digits::signed;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::motor;
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Problem, Scenario};
use squeezefilm::scene::presets;
use squeezefilm::solution::{MotorResult, Outcome, Status};
use squeezefilm::solve::{Method, Settings, solve};
use std::error::Error;
use std::fmt::Write;

/// Film load that the paper publishes for the fundamental case \[N\].
const PUBLISHED: f64 = 0.583;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    print!("{}", report(&arguments)?);
    Ok(())
}

/// The table that the arguments name.
pub(crate) fn report(arguments: &[String]) -> Result<String, Box<dyn Error>> {
    match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["grids"] => grids(),
        ["mesh"] => mesh(),
        ["slip"] => slip_laws(),
        other => Err(format!("{other:?}: expected grids, mesh or slip").into()),
    }
}

/// Solves the fundamental case with some keys changed; not to converge is an error.
fn run(changes: &[(&str, &str)], method: Method, fidelity: Fidelity) -> Result<MotorResult, Box<dyn Error>> {
    let mut scene = presets::find("fundamental")?;
    scene.set_all(changes.iter().copied())?;
    let settings = Settings { fidelity, method, ..Settings::default() };
    let solution = solve(&Problem::try_from(&scene)?, &settings, &mut (), &Cancel::new())?;
    match (solution.outcome, solution.status) {
        (Outcome::Motor(result), Status::Converged) => Ok(result),
        (_, status) => Err(format!("{changes:?}: {status:?}").into()),
    }
}

/// α on each of the nested grids, and the result that is extrapolated from them.
fn grids() -> Result<String, Box<dyn Error>> {
    let mut text = "| fidelity | film nodes along × across half the width, steps | α on the grid | result |\n\
                    | --- | --- | ---: | ---: |\n"
        .to_owned();
    let problem = Problem::try_from(&presets::find("fundamental")?)?;
    let Scenario::Motor(motor) = &problem.scenario else { return Err("the fundamental case is a motor".into()) };
    let mut sentence = String::new();
    for fidelity in Fidelity::ALL {
        let plan = Plan::motor(motor, fidelity, &problem.numerics)?;
        let found = motor::periodic(motor, &plan, &mut (), &Cancel::new())?;
        let mut grid = plan.grids[0];
        let finest = grid.along << (found.headlines.len() - 1);
        let across = found.stats.film_nodes / (finest + 1);
        for (number, alpha) in found.headlines.iter().enumerate() {
            let name = if number == 0 { fidelity.name() } else { "" };
            let last = number + 1 == found.headlines.len();
            let result = if last { found.result.alpha.to_string() } else { String::new() };
            writeln!(text, "| {name} | {} × {across}, {} | {alpha:.6} | {result} |", grid.along + 1, grid.steps)?;
            grid = grid.finer(true);
        }
        let result = found.result;
        sentence = format!(
            "\nSo α = {} and the film load is {} N, {:.1} % more than the {PUBLISHED} N of the paper.\n",
            result.alpha,
            result.film_load,
            100.0 * (result.film_load.value / PUBLISHED - 1.0)
        );
    }
    Ok(text + &sentence)
}

/// The paper's method on finer meshes, one direction at a time, and all together.
fn mesh() -> Result<String, Box<dyn Error>> {
    let mut text =
        "| film nodes along × across | contact nodes | steps | load [N] | α | load against the first row |\n\
                    | --- | ---: | ---: | ---: | ---: | ---: |\n"
            .to_owned();
    let mut first = None;
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
    ] {
        let changes = [
            ("numerics.film_nodes_along", along),
            ("numerics.film_nodes_across", across),
            ("numerics.contact_nodes", contact),
            ("numerics.steps_per_cycle", steps),
        ]
        .map(|(key, value)| (key, value.to_string()));
        let changes: Vec<(&str, &str)> = changes.iter().map(|(key, value)| (*key, value.as_str())).collect();
        let result = run(&changes, Method::Paper, Fidelity::Standard)?;
        let first = *first.get_or_insert(result.film_load.value);
        writeln!(
            text,
            "| {along} × {across} | {contact} | {steps} | {:.4} | {:.5} | {} % |",
            result.film_load.value,
            result.alpha.value,
            signed(format!("{:+.1}", 100.0 * (result.film_load.value / first - 1.0)))
        )?;
    }
    let own = run(&[], Method::Auto, Fidelity::Reference)?;
    let first = first.ok_or("no meshes")?;
    writeln!(
        text,
        "| our method, reference | | | {:.4} | {:.5} | {} % |",
        own.film_load.value,
        own.alpha.value,
        signed(format!("{:+.1}", 100.0 * (own.film_load.value / first - 1.0)))
    )?;
    Ok(text)
}

/// What the slip law and the wedge term change in the fundamental case.
fn slip_laws() -> Result<String, Box<dyn Error>> {
    let mut text = "| change | α | |\n| --- | ---: | ---: |\n".to_owned();
    let base = run(&[], Method::Auto, Fidelity::Reference)?.alpha.value;
    for (what, key, value) in [
        ("none: first-order slip", "film.slip", "first-order"),
        ("no slip", "film.slip", "none"),
        ("second-order slip", "film.slip", "second-order"),
        ("Fukui and Kaneko", "film.slip", "fukui-kaneko"),
        ("no wedge term", "film.shear", "false"),
    ] {
        let result = run(&[(key, value)], Method::Auto, Fidelity::Reference)?;
        let alpha = result.alpha;
        let change = signed(format!("{:+.2}", 100.0 * (result.alpha.value / base - 1.0)));
        writeln!(text, "| {what} | {alpha} | {change} % |")?;
    }
    Ok(text)
}
