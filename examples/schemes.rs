//! What two choices of the discretisation bring: a polynomial across the width in place of finite volumes, and results extrapolated from three
//! nested grids in place of those of the finest grid alone. The fundamental case, on the first grids of *standard* and *fine*; the error is
//! the distance to a solve that is known to five millionths. Measured numbers are in `docs/performance.md`.
//!
//! ```text
//! cargo run --release --example schemes
//! ```

#![allow(clippy::print_stdout)]

use squeezefilm::control::Cancel;
use squeezefilm::digits::{duration, percent};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::motor;
use squeezefilm::plan::{Grid, Plan};
use squeezefilm::problem::{Problem, Scenario};
use squeezefilm::scene::presets;
use std::error::Error;
use std::fmt::Write;
use std::time::Instant;

/// Solves of which the median is taken.
const REPEATS: usize = 15;

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report()?);
    Ok(())
}

/// The table.
pub(crate) fn report() -> Result<String, Box<dyn Error>> {
    let problem = Problem::try_from(&presets::find("fundamental")?)?;
    let Scenario::Motor(motor) = &problem.scenario else { return Err("no motor".into()) };
    let solve = |plan: &Plan| motor::periodic(motor, plan, &mut (), &Cancel::new());
    let plan = |fidelity| Plan::motor(motor, fidelity, &problem.numerics);
    let exact = solve(&plan(Fidelity::to(5e-6))?)?.result.alpha.value;

    let mut table = String::from(
        "| first grids of | across half the width | error, finest grid | time | error, extrapolated | time |\n\
         | --- | --- | ---: | ---: | ---: | ---: |\n",
    );
    for fidelity in [Fidelity::Standard, Fidelity::Fine] {
        let planned = Plan { most_grids: 3, ..plan(fidelity)? };
        let polynomial = |nodes| {
            let grids = planned.grids.iter().map(|grid| Grid { across: nodes, ..*grid }).collect();
            (format!("polynomial, {nodes} nodes"), Plan { grids, most_across: nodes, ..planned.clone() })
        };
        let volumes = |intervals| {
            let robust = (intervals, planned.robust.1);
            (format!("{intervals} finite volumes"), Plan { robust, ..planned.clone() }.volumes())
        };
        for (across, plan) in [2, 3, 4].map(polynomial).into_iter().chain([4, 8, 16].map(volumes)) {
            write!(table, "| *{fidelity}* | {across} |")?;
            for plan in [plan.on_one_grid(), plan] {
                let mut times = Vec::new();
                let mut alpha = 0.0;
                for _ in 0..REPEATS {
                    let started = Instant::now();
                    alpha = solve(&plan)?.result.alpha.value;
                    times.push(started.elapsed().as_secs_f64());
                }
                times.sort_by(f64::total_cmp);
                write!(table, " {} | {} |", percent((alpha / exact - 1.0).abs()), duration(times[REPEATS / 2]))?;
            }
            table.push('\n');
        }
    }
    Ok(table)
}
