//! A scene.

use crate::run::Run;
use crate::{How, here, scene_error, solve_error, within};
use pyo3::prelude::*;
use squeezefilm::platform::timed;
use squeezefilm::problem::Problem;
use squeezefilm::scene::presets::{self, BUILT_IN};
use squeezefilm::scene::{PARAMETERS, Scene as Edited, Value};
use squeezefilm::solve::{Record, solve};
use std::path::Path;
use std::time::{Duration, Instant};

/// A key, its value, its unit and its meaning.
type Entry = (&'static str, Py<PyAny>, &'static str, String);

/// A motor or a plate.
#[pyclass(frozen, module = "squeezefilm._squeezefilm")]
pub(crate) struct Scene(pub(crate) Edited);

#[pymethods]
impl Scene {
    #[staticmethod]
    fn preset(name: &str) -> PyResult<Self> {
        if !BUILT_IN.iter().any(|built_in| built_in.name == name) {
            // The error that names the nearest one.
            return presets::find(name)
                .map_err(scene_error)
                .and_then(|_| Err(scene_error(format!("{name} is a file, no built-in preset: load it"))));
        }
        presets::find(name).map(Self).map_err(scene_error)
    }

    #[staticmethod]
    fn load(path: &str) -> PyResult<Self> {
        Edited::load(Path::new(path)).map(Self).map_err(scene_error)
    }

    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        Edited::from_toml(text, "scene").map(Self).map_err(scene_error)
    }

    fn to_toml(&self) -> String {
        self.0.to_toml()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// A copy with changed keys, as `--set` changes them.
    fn changed(&self, pairs: Vec<(String, String)>) -> PyResult<Self> {
        let mut scene = self.0.clone();
        scene.set_all(pairs.iter().map(|(key, text)| (key.as_str(), text.as_str()))).map_err(scene_error)?;
        scene.retitle(&self.0);
        Ok(Self(scene))
    }

    /// The keys, each with its value, its unit and its meaning.
    fn values(&self, py: Python<'_>) -> PyResult<Vec<Entry>> {
        let value = |value: Option<Value>| -> PyResult<Py<PyAny>> {
            Ok(match value {
                None => py.None(),
                Some(Value::Number(number)) => number.into_pyobject(py)?.into_any().unbind(),
                Some(Value::Whole(whole)) => whole.into_pyobject(py)?.into_any().unbind(),
                Some(Value::Flag(flag)) => flag.into_pyobject(py)?.to_owned().into_any().unbind(),
                Some(Value::Rows(rows)) => rows.into_pyobject(py)?.into_any().unbind(),
                Some(other) => other.to_string().into_pyobject(py)?.into_any().unbind(),
            })
        };
        let parameters = self.0.parameters();
        parameters.map(|p| Ok((p.key, value(self.0.get(p.key))?, p.unit, p.words()))).collect()
    }

    #[pyo3(signature = (how, budget_ms=None))]
    fn solve(&self, py: Python<'_>, how: How, budget_ms: Option<f64>) -> PyResult<Run> {
        let settings = how.settings(Record::Everything)?;
        let budget = budget_ms.map(|time| within("budget_ms", time, 0.001..=86_400_000.0)).transpose()?;
        let budget = budget.map(|time| Duration::from_secs_f64(1e-3 * time));
        let scene = self.0.clone();
        let problem = Problem::try_from(&scene).map_err(scene_error)?;
        let (history, solution, wall_s) = here(py, |cancel| -> PyResult<_> {
            let started = Instant::now();
            let cancel = budget.map_or(cancel.clone(), |budget| timed(cancel, budget));
            let mut history = Vec::new();
            let mut observer = |progress: &_| history.push(*progress);
            let solved = solve(&problem, &settings, &mut observer, &cancel);
            let wall_s = started.elapsed().as_secs_f64();
            Ok((history, solved.map_err(|error| crate::error_of(error.is_bad_input(), error))?, wall_s))
        })??;
        Ok(Run::new(scene, &problem, settings, solution, history, wall_s))
    }
}

/// Names of the built-in presets.
#[pyfunction]
pub(crate) fn built_in() -> Vec<&'static str> {
    BUILT_IN.iter().map(|built_in| built_in.name).collect()
}

/// Every key of a scene, with its unit and its meaning.
#[pyfunction]
pub(crate) fn keys() -> Vec<(&'static str, &'static str, String)> {
    PARAMETERS.iter().map(|parameter| (parameter.key, parameter.unit, parameter.words())).collect()
}

/// The checked problem of a scene.
pub(crate) fn checked(scene: &Scene) -> PyResult<Problem> {
    Problem::try_from(&scene.0).map_err(scene_error)
}

/// The error of a solve that was cancelled without Ctrl-C.
pub(crate) fn cancelled() -> PyErr {
    solve_error("cancelled")
}
