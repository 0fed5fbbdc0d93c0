//! Studies that need many solves, or a transient. They return the objects of `--json`, as text.

use crate::scene::{Scene, cancelled, checked};
use crate::{Counted, How, apart_on_all_cores, error_of, scene_error, solve_error, within};
use pyo3::prelude::*;
use squeezefilm::analysis::error::AnalysisError;
use squeezefilm::analysis::fit::{self as fitting, Bounds, ErrorSize, Goal, Limit, MOST_STARTS, Measured};
use squeezefilm::analysis::sensitivity::{Sensitivity, Uncertainties};
use squeezefilm::control::Cancel;
use squeezefilm::export::sensitivity::SensitivityStudy;
use squeezefilm::export::{fall as fallen, fit as fitted, json, startup as export};
use squeezefilm::fall::{Cycle as Fallen, fall};
use squeezefilm::hold::{Hold, REACH};
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Problem, Scenario};
use squeezefilm::solution::settled;
use squeezefilm::solve::{Settings, solve};
use squeezefilm::startup as transient;
use std::str::FromStr;
use std::time::Instant;

fn parsed<T: FromStr<Err: std::fmt::Display>>(texts: &[String]) -> PyResult<Vec<T>> {
    texts.iter().map(|text| text.parse().map_err(scene_error)).collect()
}

/// The object of `sensitivity --json`.
#[pyfunction]
#[pyo3(signature = (scene, keys, uncertainties, carlo, how, told=None))]
pub(crate) fn sensitivity(
    py: Python<'_>,
    scene: &Scene,
    keys: Vec<String>,
    uncertainties: Vec<(String, String)>,
    carlo: (i64, u64),
    how: How,
    told: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let settings = how.own("sensitivities are those")?;
    let given = uncertainties
        .into_iter()
        .map(|(key, amount)| Ok((key, amount.parse().map_err(scene_error)?)))
        .collect::<PyResult<Vec<_>>>()?;
    let uncertainties = Uncertainties::new(&scene.0, &given).map_err(scene_error)?;
    let (scene, seed) = (scene.0.clone(), carlo.1);
    let draws = if carlo.0 == 0 { 0 } else { within("draws", carlo.0, 2..=1_000_000)? as usize };
    apart_on_all_cores(py, told, move |cancel, tell| {
        let (solved, drawn) = (Counted::default(), Counted::default());
        let found = Sensitivity::of(&scene, &keys, &settings, cancel, &|all| solved.one_more(all, tell));
        let found = found.map_err(analysis_error)?.ok_or_else(cancelled)?;
        let one_more = || drawn.one_more(draws, tell);
        let carlo = match draws {
            0 => None,
            _ => {
                let carlo = found.monte_carlo(&uncertainties, draws, seed, cancel, &one_more);
                Some(carlo.filter(|_| !cancel.is_cancelled()).ok_or_else(cancelled)?)
            }
        };
        let found = SensitivityStudy { sensitivity: &found, uncertainties: &uncertainties, carlo: carlo.as_ref() };
        Ok(json::document(&found.object(), &[]))
    })?
}

fn starts_of(starts: i64) -> PyResult<usize> {
    within("starts", starts, 1..=i64::from(MOST_STARTS)).map(|starts| starts as usize)
}

fn analysis_error(error: AnalysisError) -> PyErr {
    error_of(error.is_bad_input(), error)
}

/// The object of `fit --json`, and the scene with the values that were found. `data` is `table1` or a path, or else a name and the text of a
/// table.
#[pyfunction]
#[pyo3(signature = (scene, data, vary, lists, starts, how, told=None))]
pub(crate) fn fit(
    py: Python<'_>,
    scene: &Scene,
    data: (String, Option<String>),
    vary: Vec<String>,
    lists: (Vec<String>, Vec<String>),
    starts: i64,
    how: How,
    told: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Scene)> {
    let settings = how.settings(squeezefilm::solve::Record::Numbers)?;
    let (scene, bounds) = (scene.0.clone(), parsed::<Bounds>(&vary)?);
    let (errors, skip, starts) = (parsed::<ErrorSize>(&lists.0)?, lists.1, starts_of(starts)?);
    let measured = match data {
        (name, Some(text)) => Measured::from_csv(&text, &name, &Problem::try_from(&scene).map_err(scene_error)?),
        (name, None) => Measured::find(&name, &scene, settings.method),
    };
    let measured =
        measured.and_then(|measured| measured.without(&skip)?.with_errors(&errors)).map_err(analysis_error)?;
    apart_on_all_cores(py, told, move |cancel, tell| {
        let told = |points: usize, _: f64| tell(points as f64);
        let found = fitting::fit(&scene, &bounds, &measured, &settings, (starts, cancel, &told));
        let found = found.map_err(analysis_error)?.ok_or_else(cancelled)?;
        let object = json::document(&fitted::object(&scene.name, &found, &measured), &[]);
        Ok((object, Scene(found.scene)))
    })?
}

/// The object of `fit --maximise --json`, and the scene with the values that were found.
#[pyfunction]
#[pyo3(signature = (scene, goal, vary, limits, starts, how, told=None))]
pub(crate) fn optimise(
    py: Python<'_>,
    scene: &Scene,
    goal: (String, bool),
    vary: Vec<String>,
    limits: Vec<String>,
    starts: i64,
    how: How,
    told: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Scene)> {
    let settings = how.settings(squeezefilm::solve::Record::Numbers)?;
    let (scene, bounds, limits) = (scene.0.clone(), parsed::<Bounds>(&vary)?, parsed::<Limit>(&limits)?);
    let goal = Goal::new(&scene, &goal.0, goal.1, &limits).map_err(analysis_error)?;
    let starts = starts_of(starts)?;
    apart_on_all_cores(py, told, move |cancel, tell| {
        let told = |points: usize, _: f64| tell(points as f64);
        let found = fitting::optimise(&scene, &bounds, &goal, &settings, (starts, cancel, &told));
        let found = found.map_err(analysis_error)?.ok_or_else(cancelled)?;
        Ok((json::document(&fitted::optimum(&scene.name, &found), &[]), Scene(found.scene)))
    })?
}

/// The object of `startup --json`.
#[pyfunction]
#[pyo3(signature = (scene, cycles, tolerance, how, told=None))]
pub(crate) fn startup(
    py: Python<'_>,
    scene: &Scene,
    cycles: i64,
    tolerance: f64,
    how: How,
    told: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let problem = checked(scene)?;
    let fidelity = how.own("a start-up is")?.fidelity;
    let cycles = within("cycles", cycles, 1..=100_000)? as usize;
    let tolerance = within("tolerance", tolerance, 1e-8..=0.1)?;
    let settings = transient::Settings { fidelity, cycles, tolerance, ..Default::default() };
    apart_on_all_cores(py, told, move |cancel, tell| {
        let began = Instant::now();
        let mut seen = Vec::new();
        let mut each = |cycle: Fallen| {
            tell(cycle.number as f64 / cycles as f64);
            seen.push(cycle);
        };
        let fell = fall(&problem, fidelity, cycles, tolerance, &mut each, cancel);
        if let Some(ended) = fell.map_err(|error| error_of(error.is_bad_input(), error))? {
            let wall_s = began.elapsed().as_secs_f64();
            let object = fallen::object(&problem, fidelity, &ended, &seen, wall_s);
            return Ok(json::document(&object, &[]));
        }
        let mut rows = Vec::new();
        let mut each = |cycle: transient::Cycle| {
            let row = export::CycleRow::of(&problem, &cycle);
            tell(row.share(&settings));
            export::place(&mut rows, cycle.number, row);
        };
        let ended = transient::startup(&problem, &settings, &mut each, cancel);
        let ended = ended.map_err(|error| error_of(error.is_bad_input(), error))?;
        let wall_s = began.elapsed().as_secs_f64();
        let object = export::object(&problem, &settings, &ended, &rows, wall_s);
        Ok(json::document(&object, &[]))
    })?
}

/// Force and pressure under a plate that is moved through gaps \[µm\] at given times \[s\]: the names and values of the columns.
#[pyfunction]
pub(crate) fn hold(
    py: Python<'_>,
    scene: &Scene,
    time_s: Vec<f64>,
    gap_um: Vec<f64>,
    how: How,
) -> PyResult<Vec<(&'static str, Vec<f64>)>> {
    let (problem, settings) = (checked(scene)?, how.own("a held plate is")?);
    if time_s.len() != gap_um.len() || time_s.is_empty() {
        return Err(scene_error("time_s and gap_um: expected as many gaps as instants, one or more"));
    }
    if !time_s.windows(2).all(|pair| pair[0] < pair[1]) || !time_s.iter().all(|time| time.is_finite()) {
        return Err(scene_error("time_s: expected ascending instants"));
    }
    apart_on_all_cores(py, None, move |cancel, _| held(&problem, &settings, (&time_s, &gap_um), cancel))?
}

fn held(
    problem: &Problem,
    settings: &Settings,
    (times, gaps): (&[f64], &[f64]),
    cancel: &Cancel,
) -> PyResult<Vec<(&'static str, Vec<f64>)>> {
    let Scenario::Plate(plate) = &problem.scenario else {
        return Err(scene_error("scene = motor is not allowed: only a plate is held"));
    };
    let found = match plate.load {
        // Where it floats says how far it can be moved.
        Some(_) => solve(problem, settings, &mut (), cancel).map(|found| settled(problem, &found.outcome).into_owned()),
        None => Ok(problem.clone()),
    };
    let found = found.map_err(|error| error_of(error.is_bad_input(), error))?;
    let Scenario::Plate(plate) = &found.scenario else { return Err(cancelled()) };
    let [least, most] = REACH.map(|share| share * plate.mean_gap * 1e6);
    if let Some(gap) = gaps.iter().find(|gap| !(least..=most).contains(*gap)) {
        return Err(scene_error(format!("gap_um = {gap} is out of range: allowed {least} to {most} µm")));
    }
    let mut hold = Hold::new(plate, &Plan::plate(plate, settings.fidelity, &problem.numerics));
    hold.rest_at(1e-6 * gaps[0]);
    let force = if plate.is_strip() { ["force_n_per_m", "force_error_n_per_m"] } else { ["force_n", "force_error_n"] };
    let names = ["time_s", "gap_um", force[0], force[1], "load_ratio", "mean_pressure_kpa"];
    let mut columns = names.map(|name| (name, Vec::with_capacity(times.len())));
    for (i, (time, gap)) in times.iter().zip(gaps).enumerate() {
        if cancel.is_cancelled() {
            return Err(cancelled());
        }
        if i > 0 {
            hold.advance(1e-6 * gap, time - times[i - 1]).map_err(solve_error)?;
        }
        let at = hold.reading();
        let values = [*time, 1e6 * at.gap, at.force, at.error, at.ratio, 1e-3 * at.mean_pressure];
        columns.iter_mut().zip(values).for_each(|(column, value)| column.1.push(value));
    }
    Ok(columns.into())
}
