//! Sweeps, at once or in parts on other machines.

use crate::scene::Scene;
use crate::{Counted, How, apart_on_all_cores, scene_error, solve_error};
use pyo3::prelude::*;
use squeezefilm::analysis::sweep::{Sweep, SweepPart, SweepRow, Vary};
use squeezefilm::control::Cancel;
use squeezefilm::export::saved;
use squeezefilm::export::sweep::write_csv;
use squeezefilm::solve::Record;

/// Keys with their values, as `--vary` takes them.
type Axes = Vec<(String, String)>;

fn sweep_of(scene: &Scene, axes: Axes, how: &How, part: SweepPart) -> PyResult<Sweep> {
    let settings = how.settings(Record::Numbers)?;
    let vary = axes.into_iter().map(|(key, values)| format!("{key}={values}").parse::<Vary>());
    let vary = vary.collect::<Result<Vec<_>, _>>().map_err(scene_error)?;
    Sweep::of_part(&scene.0, &vary, &settings, part).map_err(scene_error)
}

/// Solves a part of a sweep, and returns its rows. Reports the share that is done.
fn solved(sweep: &Sweep, part: SweepPart, cancel: &Cancel, tell: crate::Tell<'_>) -> Vec<SweepRow> {
    let (done, all) = (Counted::default(), sweep.points_of(part).len());
    sweep.run_part(part, &[], cancel, &|_| done.one_more(all, tell))
}

fn csv(sweep: &Sweep, rows: &[SweepRow]) -> PyResult<String> {
    let mut table = Vec::new();
    write_csv(sweep, rows, &mut table).map_err(solve_error)?;
    Ok(String::from_utf8_lossy(&table).into_owned())
}

/// A table of a sweep, as CSV.
#[pyfunction]
#[pyo3(signature = (scene, axes, how, told=None))]
pub(crate) fn sweep(
    py: Python<'_>,
    scene: &Scene,
    axes: Axes,
    how: How,
    told: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let sweep = sweep_of(scene, axes, &how, SweepPart::WHOLE)?;
    apart_on_all_cores(py, told, move |cancel, tell| csv(&sweep, &solved(&sweep, SweepPart::WHOLE, cancel, tell)))?
}

/// How many points a sweep has.
#[pyfunction]
pub(crate) fn points(scene: &Scene, axes: Axes, how: How) -> PyResult<usize> {
    sweep_of(scene, axes, &how, SweepPart::WHOLE).map(|sweep| sweep.len())
}

/// A part of a sweep, as text that [`join`] takes.
#[pyfunction]
pub(crate) fn part(py: Python<'_>, scene: &Scene, axes: Axes, how: How, part: &str) -> PyResult<String> {
    let part: SweepPart = part.parse().map_err(scene_error)?;
    let sweep = sweep_of(scene, axes, &how, part)?;
    apart_on_all_cores(py, None, move |cancel, tell| {
        let mut text = Vec::new();
        saved::write(&sweep, part, &solved(&sweep, part, cancel, tell), &[], &mut text).map_err(solve_error)?;
        Ok(String::from_utf8_lossy(&text).into_owned())
    })?
}

/// The table of all parts, as CSV.
#[pyfunction]
pub(crate) fn join(py: Python<'_>, parts: Vec<(String, String)>) -> PyResult<String> {
    py.detach(|| {
        let joined = saved::join(&parts).map_err(scene_error)?;
        csv(&joined.sweep, &joined.rows)
    })
}
