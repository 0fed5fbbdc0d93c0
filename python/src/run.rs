//! A solved scene.

use crate::scene::Scene;
use crate::{apart, apart_on_all_cores, scene_error, solve_error};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use squeezefilm::analysis::torque::TorqueCurves;
use squeezefilm::control::{Cancel, Progress};
use squeezefilm::export::fields::fields;
use squeezefilm::export::figure::{Figure, Format, to_bytes};
use squeezefilm::export::figures;
use squeezefilm::export::files::{self, Control, ExportError, Folder, Solved};
use squeezefilm::export::json::{self, Summary};
use squeezefilm::export::torque;
use squeezefilm::problem::Problem;
use squeezefilm::scene::Scene as Edited;
use squeezefilm::solution::{Solution, Status, settled};
use squeezefilm::solve::Settings;
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// A solved scene.
#[pyclass(frozen, module = "squeezefilm._squeezefilm")]
pub(crate) struct Run(Arc<Inner>);

struct Inner {
    scene: Edited,
    problem: Problem,
    settings: Settings,
    solution: Solution,
    history: Vec<Progress>,
    wall_s: f64,
    /// The summary with torque over speed, which is computed when it is first asked for.
    complete: OnceLock<Summary>,
}

impl Run {
    pub(crate) fn new(
        scene: Edited,
        problem: &Problem,
        settings: Settings,
        solution: Solution,
        history: Vec<Progress>,
        wall_s: f64,
    ) -> Self {
        let problem = settled(problem, &solution.outcome).into_owned();
        let complete = OnceLock::new();
        Self(Arc::new(Inner { scene, problem, settings, solution, history, wall_s, complete }))
    }
}

impl Inner {
    fn summary(&self) -> Summary {
        Summary::new(&self.problem, &self.solution, self.wall_s, &[])
    }

    /// The summary with torque over speed. The contact without film is solved for it.
    fn complete(&self, cancel: &Cancel) -> &Summary {
        self.complete.get_or_init(|| {
            let mut summary = self.summary();
            summary.add_torque(TorqueCurves::of(&self.problem, self.settings.fidelity, &self.solution, cancel));
            summary
        })
    }

    /// The figures, with their names. With `torque` the figure of torque over speed is among them.
    fn figures(&self, torque: Option<&TorqueCurves>) -> Vec<(&'static str, Figure)> {
        figures::of(&self.problem, &self.solution, &self.history, torque)
    }
}

/// Name of the figure of torque over speed.
const TORQUE: &str = "torque";
/// Among the formats of figures, the name of the format for the film at every instant.
const VTK: &str = "vtk";

/// The format with the name `name`, which the keyword argument `what` has. The message of an error lists `others` too.
fn known(what: &str, name: &str, others: &[&str]) -> PyResult<Format> {
    let found = Format::WRITTEN.iter().find(|format| format.name() == name).copied();
    let names = Format::WRITTEN.iter().map(|format| format.name()).chain(others.iter().copied());
    found.ok_or_else(|| {
        scene_error(format!("{what} = {name} is not allowed: one of {}", names.collect::<Vec<_>>().join(", ")))
    })
}

/// A value with its error, rounded to the digits that the error allows.
#[pyfunction]
#[pyo3(signature = (value, error))]
pub(crate) fn with_error(value: f64, error: Option<f64>) -> String {
    squeezefilm::digits::with_error(value, error.unwrap_or(f64::INFINITY))
}

#[pymethods]
impl Run {
    #[getter]
    fn converged(&self) -> bool {
        self.0.solution.status == Status::Converged
    }

    /// The object of `solve --json`, as text; if `torque` is true, with torque over speed.
    fn summary(&self, py: Python<'_>, torque: bool) -> PyResult<String> {
        if !torque {
            return Ok(json::text(&self.0.summary()));
        }
        let inner = Arc::clone(&self.0);
        apart(py, None, move |cancel, _| json::text(inner.complete(cancel)))
    }

    /// Torque over speed, of a motor, as CSV.
    fn torque_csv(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let inner = Arc::clone(&self.0);
        apart(py, None, move |cancel, _| {
            let Some(curves) = &inner.complete(cancel).torque else { return Ok(None) };
            let mut table = Vec::new();
            torque::write_csv(curves, &mut table).map_err(solve_error)?;
            Ok(Some(String::from_utf8_lossy(&table).into_owned()))
        })?
    }

    #[getter]
    fn scene(&self) -> Scene {
        Scene(self.0.scene.clone())
    }

    /// Name, axes and array of each field.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for field in fields(&self.0.problem, &self.0.solution.recording) {
            let values = PyArray1::from_vec(py, field.values.collect());
            let array = values.reshape(field.shape)?;
            all.set_item(field.name, (PyTuple::new(py, field.axes)?, array))?;
        }
        Ok(all)
    }

    /// Names of the figures.
    fn figures(&self) -> Vec<&'static str> {
        let motor = matches!(self.0.problem.scenario, squeezefilm::problem::Scenario::Motor(_));
        self.0.figures(None).into_iter().map(|(name, _)| name).chain(motor.then_some(TORQUE)).collect()
    }

    /// A figure as the bytes of a file.
    fn figure<'py>(&self, py: Python<'py>, name: String, format: &str) -> PyResult<Bound<'py, PyBytes>> {
        let format = known("format", format, &[])?;
        let inner = Arc::clone(&self.0);
        let drawn = apart(py, None, move |cancel, _| {
            let curves = if name == TORQUE { inner.complete(cancel).torque.as_ref() } else { None };
            let all = inner.figures(curves);
            match all.iter().find(|(known, _)| *known == name) {
                Some((_, figure)) => to_bytes(figure, format).map_err(solve_error),
                None => {
                    let names: Vec<&str> = all.iter().map(|(name, _)| *name).collect();
                    Err(scene_error(format!("figure = {name} is not there: one of {}", names.join(", "))))
                }
            }
        })?;
        Ok(PyBytes::new(py, &drawn?))
    }

    /// Writes what `solve --out` writes, and returns the paths.
    fn save(&self, py: Python<'_>, folder: String, formats: Vec<String>) -> PyResult<Vec<String>> {
        let inner = Arc::clone(&self.0);
        let (vtk, formats): (Vec<_>, Vec<_>) = formats.into_iter().partition(|name| name == VTK);
        let formats = formats.iter().map(|name| known("figures", name, &[VTK])).collect::<PyResult<Vec<_>>>()?;
        let written = apart_on_all_cores(py, None, move |cancel, _| {
            let summary = inner.complete(cancel);
            let solved = Solved {
                scene: &inner.scene,
                problem: &inner.problem,
                solution: &inner.solution,
                history: &inner.history,
            };
            let folder = Folder { path: Path::new(&folder), command: &[], formats, vtk: !vtk.is_empty() };
            files::solve(&folder, &solved, summary, &Control { cancel, drawn: &|_, _| () })
        })?;
        let paths = written.map_err(|error| match error {
            ExportError::Write(error) => pyo3::exceptions::PyOSError::new_err(error.to_string()),
            error => solve_error(error),
        })?;
        Ok(paths.iter().map(|path| path.display().to_string()).collect())
    }
}
