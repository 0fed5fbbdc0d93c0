//! Text of a solution for people: aligned, with a unit on every number and as many digits as its error justifies.

use super::columns::{Columns, paragraph};
use crate::analysis::decision::{exactness, sentences};
use crate::analysis::exact::{ExactComparison, units};
use crate::analysis::quantity::{Quantity, force_unit};
use crate::analysis::regime;
use crate::analysis::torque::TorqueCurves;
use crate::analysis::validity::{ExceededLimit, beside_headline};
use crate::digits::{as_given, duration, percent, short, significant};
use crate::dimensionless::Dimensionless;
use crate::estimate::Estimate;
use crate::export::json::{Summary, beside_limit, small_load_gap, status_name};
use crate::gas::species::IdealGas;
use crate::problem::{GRAVITY, Motor, Plate, Problem, Scenario};
use crate::scene::{Scene, show_text};
use crate::solution::{Accuracy, Floating, MotorResult, Outcome, Performance, PlateResult, Status, StoppedBy};
use std::fmt::Write as _;

/// Significant digits of numbers without an error of their own.
const DIGITS: usize = 4;

pub(super) fn text(scene: &Scene, summary: &Summary) -> String {
    let (problem, outcome) = (&summary.problem, &summary.outcome);
    let outside = beside_headline(&summary.validity).map_or_else(String::new, |words| format!("; {words}"));
    let mut text = paragraph(&format!("{}: {}{outside}", name(scene), status(summary)), "", "");
    if !scene.about.is_empty() {
        text.push_str(&paragraph(&scene.about, "", ""));
    }
    text.push('\n');
    let mut columns = Columns::new();
    match (&problem.scenario, outcome) {
        (Scenario::Motor(motor), Outcome::Motor(result)) => motor_rows(&mut columns, motor, result, summary),
        (Scenario::Plate(plate), Outcome::Plate(result)) => plate_rows(&mut columns, plate, result, summary),
        // Cannot happen: a solver returns an outcome of the same kind as the scenario.
        _ => {}
    }
    text.push_str(&columns.text(&[]));
    if let (Some(torque), Scenario::Motor(motor)) = (&summary.torque, &problem.scenario) {
        text.push('\n');
        let mut columns = Columns::new();
        torque_rows(&mut columns, motor, torque);
        text.push_str(&columns.text(&[]));
    }
    text.push('\n');
    let mut columns = Columns::new();
    gas_row(&mut columns, problem);
    number_rows(&mut columns, problem, outcome);
    text.push_str(&columns.text(&[]));
    text.push_str(&limits(&summary.validity));
    let model = &summary.model;
    // Writing to a String cannot fail.
    let _ = writeln!(text, "\nModelled: method {}, {}", model.method, exactness(&model.fidelity));
    for reason in sentences(model) {
        text.push_str(&paragraph(&reason, "  - ", "    "));
    }
    text.push_str(&cost(summary));
    text
}

fn name(scene: &Scene) -> String {
    if scene.name.is_empty() { "unnamed scene".to_owned() } else { show_text(&scene.name) }
}

fn status(summary: &Summary) -> String {
    match summary.status {
        Status::NotResolved { .. } => "NOT RESOLVED: the stated error is as large as the result".to_owned(),
        Status::NotConverged { residual, tolerance } if (residual + tolerance).is_finite() => {
            format!(
                "NOT CONVERGED: further rounds would still change the result by {}, {} is allowed",
                percent(residual),
                percent(tolerance)
            )
        }
        Status::Converged => "converged to the periodic steady state".to_owned(),
        status => status_name(&status).to_uppercase(),
    }
}

fn motor_rows(columns: &mut Columns, motor: &Motor, result: &MotorResult, summary: &Summary) {
    let alpha = summary.numbers.known(Quantity::Alpha);
    let dry = motor.friction_torque(motor.load);
    let negative = regime::sucks(alpha);
    let without = summary.torque.as_ref().map_or_else(String::new, |torque| {
        format!("; {} without film", in_unit(Some(torque.without_film.stall_torque), 1.0, "N·m"))
    });
    columns.row([
        "film share of the load  α",
        &alpha.to_string(),
        &format!(
            "of the {} N pressed on one wavelength{}",
            short(motor.load, 6),
            if negative { "; the film sucks" } else { "" }
        ),
    ]);
    film_load(columns, summary);
    columns.row([
        "contact load",
        &format!("{} N", summary.numbers.known(Quantity::ContactLoad)),
        "mean over the cycle, the rest of the load",
    ]);
    columns.row([
        "stall torque",
        &in_unit(summary.numbers.estimate(Quantity::StallTorque), 1.0, "N·m"),
        &format!("of the whole ring, the rotor held at rest{without}"),
    ]);
    columns.row([
        "maximum operating torque",
        &format!("{} N·m", summary.numbers.known(Quantity::MaxTorque)),
        &format!("the paper's bound μ_d (1 − α) waves L r; {} N·m without film", shown(dry)),
    ]);
    columns.row([
        "teeth in contact",
        &format!("{} of {}", summary.numbers.known(Quantity::TeethInContact), motor.teeth),
        "mean over the cycle",
    ]);
    columns.row(match result.levitated {
        true => ["levitated", "yes", "no tooth touches at any instant: the rotor floats on air"],
        false => ["levitated", "no", "teeth touch the rotor"],
    });
    let spacing = match motor.surface.asperities {
        Some(asperities) => format!("mean gap over asperities of {} nm rms", as_given(asperities.summits().rms * 1e9)),
        None => format!("the minimum spacing of {} nm included", as_given(motor.min_spacing * 1e9)),
    };
    extremes(columns, summary, &spacing, motor.gas.ambient_pressure);
}

/// Torque, power and efficiency over speed; the last column is the same motor in a vacuum.
fn torque_rows(columns: &mut Columns, motor: &Motor, torque: &TorqueCurves) {
    let (wet, dry) = (&torque.with_film, &torque.without_film);
    let mut row = |name: &str, factor: f64, unit: &str, value: &dyn Fn(&Performance) -> Option<Estimate>| {
        let of = |side| in_unit(value(side), factor, unit);
        columns.row([name, &of(wet), &format!("{} without film", of(dry))]);
    };
    let rpm = torque.rpm(1.0);
    row("no-load speed", rpm, "rpm", &|of| of.no_load_speed);
    row("greatest power", 1.0, "W", &|of| Some(of.max_power));
    row("  at", rpm, "rpm", &|of| of.max_power_speed);
    row("greatest efficiency", 100.0, "%", &|of| of.max_efficiency);
    row("  at", rpm, "rpm", &|of| of.max_efficiency_speed);
    if motor.rotor_speed != 0.0 {
        let speed = format!("torque at {} rpm", as_given(torque.rpm(wet.present.speed)));
        row(&speed, 1.0, "N·m", &|of| Some(of.present.torque));
    }
    columns.row([
        "power lost in the film",
        &in_unit(Some(torque.film_power), 1.0, "W"),
        "work of the stator on the film, mean over the cycle",
    ]);
    columns.row([
        "equivalent dry friction",
        in_unit(Some(torque.dry_equivalent), 1.0, "").trim_end(),
        &format!("gives without film the same maximum operating torque as {} with it", as_given(motor.dry_friction)),
    ]);
}

fn plate_rows(columns: &mut Columns, plate: &Plate, result: &PlateResult, summary: &Summary) {
    let area = if plate.is_strip() {
        "of p_a × length, mean over the cycle; an infinitely wide strip"
    } else {
        "of p_a × area, mean over the cycle"
    };
    if let Some((load, floating)) = plate.load.zip(result.floating) {
        floating_rows(columns, plate, load, &floating, force_unit(&summary.problem));
    }
    film_load(columns, summary);
    columns.row(["load ratio", &summary.numbers.known(Quantity::LoadRatio).to_string(), area]);
    let range = Estimate::range([Quantity::LoadRatioMin, Quantity::LoadRatioMax].map(|end| summary.numbers.known(end)));
    columns.row(["", &range, "least and greatest in the cycle"]);
    if let Some(exact) = &summary.exact {
        exact_rows(columns, exact, plate);
    }
    let gap = plate.mean_gap * 1e9;
    let mean =
        format!("the mean gap is {} nm", if plate.load.is_some() { shown(gap) } else { as_given(gap).to_string() });
    extremes(columns, summary, &mean, plate.gas.ambient_pressure);
}

/// How a plate floats, beside trapped gas.
fn floating_rows(columns: &mut Columns, plate: &Plate, load: f64, found: &Floating, unit: &str) {
    let [stiffness, _] = units(plate);
    let mass = as_given(load / GRAVITY * 1e3);
    let stable = match found.stability() {
        Some(true) => "stable",
        Some(false) => "not stable",
        None => "stability not known",
    };
    columns.row([
        "mean gap",
        &format!("{} µm", found.mean_gap * 1e6),
        &format!("at which the film carries the load of {} {unit}; {stable}", shown(load)),
    ]);
    columns.row([
        "",
        &format!("{} µm", shown(plate.trapped_gap(load) * 1e6)),
        &format!(
            "if the gas were trapped and did not slip; the small-load limit a √(1.25 p_a A/F) is {} µm",
            shown(small_load_gap(plate, load) * 1e6)
        ),
    ]);
    columns.row([
        "stiffness at this height",
        &format!("{} {stiffness}", found.stiffness),
        "fall of the mean load per unit of mean gap",
    ]);
    if found.is_stable() {
        let gram = if plate.is_strip() { "g/m" } else { "g" };
        let of = format!("of the mass whose weight is the load, {} {gram}, on that stiffness alone", shown(mass));
        columns.row(["natural frequency", &format!("{} Hz", found.natural_frequency), &of]);
    }
    let Some(slow) = found.slow else { return };
    columns.row([
        "damping of slow motion",
        &format!("{} {}", slow.damping, units(plate)[1]),
        "of motion so slow that gas has time to leave",
    ]);
    if let Some(time) = slow.creep_time {
        columns.row(["creeps back in", &format!("{} ms", time * 1e3), "time constant, after a push"]);
    }
    if let Some((frequency, decay)) = slow.swing_frequency.zip(slow.swing_decay) {
        columns.row([
            "swings at",
            &format!("{frequency} Hz"),
            "after a push; gas that has no time to leave is a spring too",
        ]);
        columns.row(["", &format!("{} ms", decay * 1e3), "time constant with which that dies out"]);
    }
}

/// Rows with the exact limits beside the computed values.
fn exact_rows(columns: &mut Columns, exact: &ExactComparison, plate: &Plate) {
    let mut row = |name: &str, solved: Estimate, unit: &str, known: f64, when: &str| {
        // With as many digits as the computed number beside it.
        let digits = (known / solved.error).abs().log10().ceil() + 1.0;
        let known = significant(known, if digits.is_finite() { digits.max(4.0) as usize } else { 4 });
        let solved = format!("{solved} {unit}");
        columns.row([name, solved.trim_end(), &format!("limit {when}: {known}")]);
    };
    if let Some((solved, absolute)) = exact.solved.zip(exact.stiffness_and_damping()) {
        let (linear, unit, [stiffness, damping]) = (exact.linear, exact.unit, units(plate));
        let small = &format!("for small amplitudes (here ε = {})", short(plate.amplitude / plate.mean_gap, 3));
        row("spring number S", solved.spring, "× p_a A ε", linear.spring, small);
        row("damping number D", solved.damping, "× p_a A ε", linear.damping, small);
        row("stiffness", absolute.spring, stiffness, linear.spring * unit.spring, small);
        row("damping coefficient", absolute.damping, damping, linear.damping * unit.damping, small);
    }
    row("mean pressure ratio", exact.mean_pressure, "", exact.trapped_mean_pressure, "for σ → ∞");
    if let Some(deviation) = exact.invariant_deviation {
        columns.row([
            "invariant of the cycle",
            &percent(deviation),
            "largest deviation at any point; zero for the exact solution",
        ]);
    }
}

/// A number with its error and unit; "none" if there is no number.
fn in_unit(found: Option<Estimate>, factor: f64, unit: &str) -> String {
    match found.filter(|found| found.value.is_finite()) {
        Some(found) => format!("{} {unit}", found * factor),
        None => "none".to_owned(),
    }
}

fn film_load(columns: &mut Columns, summary: &Summary) {
    let unit = force_unit(&summary.problem);
    columns.row(["film load", &format!("{} {unit}", summary.numbers.known(Quantity::FilmLoad)), "mean over the cycle"]);
    let range = Estimate::range([Quantity::FilmLoadMin, Quantity::FilmLoadMax].map(|end| summary.numbers.known(end)));
    columns.row(["", &format!("{range} {unit}"), "least and greatest in the cycle"]);
}

fn extremes(columns: &mut Columns, summary: &Summary, thickness: &str, ambient: f64) {
    columns.row(["least film thickness", &format!("{} nm", summary.numbers.known(Quantity::MinGap)), thickness]);
    let pressure = summary.numbers.known(Quantity::MaxPressure);
    columns.row([
        "highest pressure",
        &format!("{pressure} kPa"),
        &format!("{} × ambient", significant(pressure.value * 1e3 / ambient, 3)),
    ]);
}

/// Row with the viscosity and mean free path of a gas that the scene names.
fn gas_row(columns: &mut Columns, problem: &Problem) {
    let gas = match &problem.scenario {
        Scenario::Motor(motor) => &motor.gas,
        Scenario::Plate(plate) => &plate.gas,
    };
    if gas.ideal != IdealGas::UNNAMED {
        let [pressure, viscosity, path] = [gas.ambient_pressure / 1e3, gas.viscosity * 1e6, gas.mean_free_path * 1e9];
        let follows = format!(
            "at {} kPa: viscosity {} µPa·s, mean free path {} nm",
            shown(pressure),
            shown(viscosity),
            shown(path)
        );
        columns.row(["gas", &gas.ideal.to_string(), &follows]);
    }
}

fn number_rows(columns: &mut Columns, problem: &Problem, outcome: &Outcome) {
    let numbers = &Dimensionless::of(problem);
    columns.row(["squeeze number  σ", &shown(numbers.squeeze_number), &regime::squeeze(problem, outcome)]);
    columns.row(["", "", &regime::weight(problem, outcome)]);
    if let Scenario::Motor(_) = problem.scenario {
        columns.row(["bearing number  Λ", &shown(numbers.bearing_number), regime::bearing(numbers)]);
    }
    columns.row(["Knudsen number  Kn", &shown(numbers.knudsen_number), &regime::knudsen(problem, outcome)]);
}

/// Limits of the model that are exceeded; empty if none.
pub(super) fn limits(validity: &[ExceededLimit]) -> String {
    let mut text = String::new();
    for (i, excess) in validity.iter().enumerate() {
        if i == 0 {
            text.push_str("\nOutside the limits of the model:\n");
        }
        let line = format!("{}: {}. {}", excess.name, beside_limit(excess), excess.text);
        text.push_str(&paragraph(&line, "  - ", "    "));
    }
    text
}

/// `Cost: 42.6 ms for …`
fn cost(summary: &Summary) -> String {
    let stats = &summary.stats;
    let mut parts = vec![format!("{} film steps", stats.film_steps)];
    if stats.coupling_iterations > 0 {
        parts.push(format!("{} rounds of film and contact", stats.coupling_iterations));
        parts.push(format!("{} contact problems", stats.contact_solves));
    } else {
        parts.push(format!("{} cycles", stats.cycles));
    }
    let Accuracy { asked, stated, stopped_by } = summary.accuracy;
    if asked > 0.0 && stated.is_finite() {
        let why = match stopped_by {
            StoppedBy::Accuracy => "",
            StoppedBy::Budget => "; the time allowed was up",
            StoppedBy::Limit => "; finer grids would not reduce it, or would take too long",
        };
        // For a share α below 0.01 the accuracy is relative to a hundredth of the load.
        let of =
            if summary.numbers.known(Quantity::Alpha).value.abs() < 0.01 { " of a hundredth of the load" } else { "" };
        parts.push(format!("stated error {}{of} ({} asked for{why})", percent(stated), percent(asked)));
    }
    let grid = format!("finest grid {} film nodes × {} steps a cycle", stats.film_nodes, stats.steps_per_cycle);
    paragraph(&format!("Cost: {}: {}; {grid}", duration(summary.wall_s), parts.join(", ")), "\n", "  ")
}

fn shown(value: f64) -> String {
    significant(value, DIGITS)
}
