//! The library, as Python calls it. What Python sees is `squeezefilm/__init__.py`; here is what that cannot do by itself. Objects go
//! over as the JSON of the command line, fields as NumPy arrays.

use numpy::{PyArray1, PyArrayMethods};
use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use squeezefilm::analysis::sensitivity::{Sensitivity, Uncertainties};
use squeezefilm::analysis::sweep::{Sweep, Vary};
use squeezefilm::analysis::torque::TorqueCurves;
use squeezefilm::control::Cancel;
use squeezefilm::export::fields::fields;
use squeezefilm::export::json::{self, Summary};
use squeezefilm::export::sensitivity::Found;
use squeezefilm::export::sweep::write_csv;
use squeezefilm::fidelity::{self, Fidelity};
use squeezefilm::problem::Problem;
use squeezefilm::scene::presets::{self, BUILT_IN};
use squeezefilm::scene::{PARAMETERS, Scene as Edited};
use squeezefilm::solution::Solution;
use squeezefilm::solve::{Method, Record, Settings, check, solve};
use std::path::Path;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

create_exception!(
    _squeezefilm,
    SceneError,
    PyValueError,
    "A scene that cannot be solved: the key, its value and what is allowed."
);
create_exception!(_squeezefilm, SolveError, PyRuntimeError, "A solve that came to no end.");

fn scene_error(error: impl std::fmt::Display) -> PyErr {
    SceneError::new_err(error.to_string())
}

fn solve_error(error: impl std::fmt::Display) -> PyErr {
    SolveError::new_err(error.to_string())
}

/// How often Python is asked whether Ctrl-C was pressed.
const ASKED: Duration = Duration::from_millis(50);

/// Does `work` on a thread of its own, without Python's lock, until it is done or Ctrl-C is pressed. What `work` reports is given
/// to `told`, if there is one, in Python.
fn apart<T: Send + 'static>(
    py: Python<'_>,
    told: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Cancel, &(dyn Fn(f64) + Sync)) -> T + Send + 'static,
) -> PyResult<T> {
    enum Event<T> {
        Share(f64),
        Done(T),
    }
    let cancel = Cancel::new();
    let (sender, events) = channel();
    let (inside, shares) = (cancel.clone(), std::sync::Mutex::new(sender.clone()));
    std::thread::spawn(move || {
        let tell = |share: f64| {
            if let Ok(sender) = shares.lock() {
                let _ = sender.send(Event::Share(share));
            }
        };
        let done = work(&inside, &tell);
        let _ = sender.send(Event::Done(done));
    });
    let events = std::sync::Mutex::new(events);
    loop {
        let event = py.detach(|| events.lock().map_or(Err(RecvTimeoutError::Disconnected), |e| e.recv_timeout(ASKED)));
        match event {
            Ok(Event::Done(done)) => return Ok(done),
            Ok(Event::Share(share)) => {
                if let Some(told) = told {
                    told.call1((share,)).inspect_err(|_| cancel.cancel())?;
                }
            }
            Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| cancel.cancel())?,
            Err(RecvTimeoutError::Disconnected) => return Err(solve_error("the solver ended without a word")),
        }
    }
}

fn settings(accuracy: Option<&str>, fidelity: Option<&str>, method: &str, record: Record) -> PyResult<Settings> {
    let fidelity = match (accuracy, fidelity) {
        (Some(_), Some(_)) => return Err(PyValueError::new_err("accuracy and fidelity: give one of them")),
        (Some(accuracy), None) => Fidelity::to(fidelity::parse_accuracy(accuracy).map_err(PyValueError::new_err)?),
        (None, Some(name)) => name.parse().map_err(|error| PyValueError::new_err(format!("{error}")))?,
        (None, None) => Fidelity::default(),
    };
    let method = match method {
        "auto" => Method::Auto,
        "paper" => Method::Paper,
        other => return Err(PyValueError::new_err(format!("method = {other:?} is not allowed: auto or paper"))),
    };
    Ok(Settings { fidelity, method, record })
}

/// A motor or a plate.
#[pyclass(frozen, module = "squeezefilm._squeezefilm")]
struct Scene(Edited);

#[pymethods]
impl Scene {
    #[staticmethod]
    fn preset(name: &str) -> PyResult<Self> {
        if !BUILT_IN.iter().any(|built_in| built_in.name == name) {
            // The error that names the nearest one.
            return presets::find(name)
                .map_err(scene_error)
                .and_then(|_| Err(scene_error(format!("{name:?} is a file, no built-in preset: load it"))));
        }
        presets::find(name).map(Self).map_err(scene_error)
    }

    #[staticmethod]
    fn load(path: &str) -> PyResult<Self> {
        Edited::load(Path::new(path)).map(Self).map_err(scene_error)
    }

    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        Edited::from_toml(text, "text").map(Self).map_err(scene_error)
    }

    fn to_toml(&self) -> String {
        self.0.to_toml()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// With keys changed as `--set` changes them.
    fn changed(&self, pairs: Vec<(String, String)>) -> PyResult<Self> {
        let mut scene = self.0.clone();
        scene.set_all(pairs.iter().map(|(key, text)| (key.as_str(), text.as_str()))).map_err(scene_error)?;
        scene.retitle(&self.0);
        Ok(Self(scene))
    }

    /// The keys, each with its unit, what it is, and its value as text.
    fn keys(&self) -> Vec<(&'static str, String)> {
        self.0.parameters().map(|parameter| (parameter.key, parameter.words())).collect()
    }

    #[pyo3(signature = (accuracy=None, fidelity=None, method="auto", budget_ms=None))]
    fn solve(
        &self,
        py: Python<'_>,
        accuracy: Option<&str>,
        fidelity: Option<&str>,
        method: &str,
        budget_ms: Option<f64>,
    ) -> PyResult<Run> {
        let settings = settings(accuracy, fidelity, method, Record::Everything)?;
        let scene = self.0.clone();
        let problem = Problem::new(&scene).map_err(scene_error)?;
        check(&problem, &settings).map_err(scene_error)?;
        let (problem, solved, wall_s) = apart(py, None, move |cancel, _| {
            let started = Instant::now();
            let cancel = match budget_ms {
                Some(budget) => cancel.with_budget(move || {
                    let end = Instant::now() + Duration::from_secs_f64(1e-3 * budget.clamp(0.0, 1e9));
                    move || Instant::now() >= end
                }),
                None => cancel.clone(),
            };
            let solved = solve(&problem, &settings, &mut (), &cancel);
            (problem, solved, started.elapsed().as_secs_f64())
        })?;
        Ok(Run { scene, problem, settings, solution: solved.map_err(solve_error)?, wall_s })
    }
}

/// A solved scene.
#[pyclass(frozen, module = "squeezefilm._squeezefilm")]
struct Run {
    scene: Edited,
    problem: Problem,
    settings: Settings,
    solution: Solution,
    wall_s: f64,
}

#[pymethods]
impl Run {
    /// The object of `solve --json`, as text. `torque`: with torque over speed.
    fn summary(&self, torque: bool) -> String {
        let mut summary = Summary::new(&self.problem, &self.solution, self.wall_s, &[]);
        if torque {
            let cancel = Cancel::new();
            summary.add_torque(TorqueCurves::of_solve(&self.problem, self.settings.fidelity, &self.solution, &cancel));
        }
        summary.to_text()
    }

    #[getter]
    fn scene(&self) -> Scene {
        Scene(self.scene.clone())
    }

    /// Name, axes and array of each field.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for field in fields(&self.problem, &self.solution.recording) {
            let values = PyArray1::from_vec(py, field.values.collect());
            let array = values.reshape(field.shape)?;
            all.set_item(field.name, (PyTuple::new(py, field.axes)?, array))?;
        }
        Ok(all)
    }
}

/// A table of a sweep, as CSV.
#[pyfunction]
#[pyo3(signature = (scene, axes, accuracy=None, fidelity=None, told=None))]
fn sweep(
    py: Python<'_>,
    scene: &Scene,
    axes: Vec<(String, String)>,
    accuracy: Option<&str>,
    fidelity: Option<&str>,
    told: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let settings = settings(accuracy, fidelity, "auto", Record::Numbers)?;
    let vary =
        axes.into_iter().map(|(key, values)| format!("{key}={values}").parse::<Vary>()).collect::<Result<Vec<_>, _>>();
    let sweep = Sweep::new(&scene.0, &vary.map_err(scene_error)?, &settings).map_err(scene_error)?;
    apart(py, told, move |cancel, tell| {
        let done = std::sync::atomic::AtomicUsize::new(0);
        let rows = sweep.run(&[], cancel, &|_| {
            let done = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1;
            tell(done as f64 / sweep.len() as f64);
        });
        let mut table = Vec::new();
        write_csv(&sweep, &rows, &mut table).map(|()| String::from_utf8_lossy(&table).into_owned())
    })?
    .map_err(solve_error)
}

/// The object of `sensitivity --json`, as text.
#[pyfunction]
#[pyo3(signature = (scene, keys, uncertainties, draws, seed, accuracy=None, fidelity=None))]
fn sensitivity(
    py: Python<'_>,
    scene: &Scene,
    keys: Vec<String>,
    uncertainties: Vec<(String, String)>,
    draws: usize,
    seed: u64,
    accuracy: Option<&str>,
    fidelity: Option<&str>,
) -> PyResult<String> {
    let settings = settings(accuracy, fidelity, "auto", Record::Numbers)?;
    let given = uncertainties
        .into_iter()
        .map(|(key, amount)| Ok((key, amount.parse().map_err(scene_error)?)))
        .collect::<PyResult<Vec<_>>>()?;
    let uncertainties = Uncertainties::new(&scene.0, &given).map_err(scene_error)?;
    let scene = scene.0.clone();
    let found = apart(py, None, move |cancel, _| {
        let sensitivity = Sensitivity::of(&scene, &keys, &settings, cancel, &|_| ()).map_err(scene_error)?;
        let Some(sensitivity) = sensitivity else { return Err(solve_error("cancelled")) };
        let carlo = if draws > 0 { sensitivity.monte_carlo(&uncertainties, draws, seed, cancel, &|| ()) } else { None };
        let found = Found { sensitivity: &sensitivity, uncertainties: &uncertainties, carlo: carlo.as_ref() };
        Ok(json::document(&found.object(&settings.fidelity.to_string()), &[]))
    })?;
    found
}

/// Names of the built-in presets.
#[pyfunction]
fn built_in() -> Vec<&'static str> {
    BUILT_IN.iter().map(|built_in| built_in.name).collect()
}

/// Every key of a scene, with what it is.
#[pyfunction]
fn keys() -> Vec<(&'static str, String)> {
    PARAMETERS.iter().map(|parameter| (parameter.key, parameter.words())).collect()
}

#[pymodule]
fn _squeezefilm(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("SceneError", module.py().get_type::<SceneError>())?;
    module.add("SolveError", module.py().get_type::<SolveError>())?;
    module.add_class::<Scene>()?;
    module.add_class::<Run>()?;
    module.add_function(wrap_pyfunction!(sweep, module)?)?;
    module.add_function(wrap_pyfunction!(sensitivity, module)?)?;
    module.add_function(wrap_pyfunction!(built_in, module)?)?;
    module.add_function(wrap_pyfunction!(keys, module)?)
}
