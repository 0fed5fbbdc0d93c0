//! The native part of the Python package, which calls the library. The interface that users see is in `squeezefilm/`. Objects are passed to
//! Python as the JSON of the command line, tables as its CSV, fields as NumPy arrays.

mod many;
mod run;
mod scene;
mod studies;

use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use squeezefilm::control::Cancel;
use squeezefilm::fidelity::{self, Fidelity};
use squeezefilm::job::work::pooled;
use squeezefilm::solve::{Method, Record, Settings};
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

create_exception!(
    _squeezefilm,
    SceneError,
    PyValueError,
    "A scene that cannot be solved, or another bad input: the key, its value and what is allowed."
);
create_exception!(_squeezefilm, SolveError, PyRuntimeError, "A solve that ended without a result.");

fn scene_error(error: impl std::fmt::Display) -> PyErr {
    SceneError::new_err(error.to_string())
}

fn solve_error(error: impl std::fmt::Display) -> PyErr {
    SolveError::new_err(error.to_string())
}

/// A [`SceneError`] for bad input, or else a [`SolveError`].
fn error_of(bad_input: bool, error: impl std::fmt::Display) -> PyErr {
    if bad_input { scene_error(error) } else { solve_error(error) }
}

/// The number of a keyword argument, if it is within the bounds that the command line has for it.
fn within<T: PartialOrd + std::fmt::Display>(name: &str, value: T, allowed: RangeInclusive<T>) -> PyResult<T> {
    if allowed.contains(&value) {
        return Ok(value);
    }
    let (least, most) = allowed.into_inner();
    Err(scene_error(format!("{name} = {value} is out of range: allowed {least} to {most}")))
}

/// How often Python is asked whether Ctrl-C was pressed.
const ASKED: Duration = Duration::from_millis(50);

/// Reports the share of the work that is done, 0 to 1, from any thread.
type Tell<'a> = &'a (dyn Fn(f64) + Sync);

/// Counts how many of many parts are done, and reports the shares in ascending order, from any thread.
#[derive(Default)]
struct Counted(Mutex<usize>);

impl Counted {
    fn one_more(&self, all: usize, tell: Tell<'_>) {
        let mut done = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *done += 1;
        tell(*done as f64 / all.max(1) as f64);
    }
}

/// Does `work` on a thread of its own, without Python's lock, until it is done or Ctrl-C is pressed. If there is a Python function `told`, it
/// is called with the shares that `work` reports.
fn apart<T: Send + 'static>(
    py: Python<'_>,
    told: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Cancel, Tell<'_>) -> T + Send + 'static,
) -> PyResult<T> {
    enum Event<T> {
        Share(f64),
        Done(T),
    }
    let cancel = Cancel::new();
    let (sender, events) = channel();
    let (inside, shares) = (cancel.clone(), Mutex::new(sender.clone()));
    let listens = told.is_some();
    std::thread::spawn(move || {
        let tell = |share: f64| {
            if listens && let Ok(sender) = shares.lock() {
                let _ = sender.send(Event::Share(share));
            }
        };
        let done = work(&inside, &tell);
        let _ = sender.send(Event::Done(done));
    });
    let events = Mutex::new(events);
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

/// Does `work` on this thread, without Python's lock, until it is done or Ctrl-C is pressed. Python is asked for Ctrl-C when `work` checks its
/// flag. This is for work of about a millisecond, a tenth of which a thread of its own would cost.
fn here<T: Send>(py: Python<'_>, work: impl FnOnce(&Cancel) -> T + Send) -> PyResult<T> {
    let pressed = Arc::new(OnceLock::new());
    let (started, asked) = (Instant::now(), AtomicU64::new(0));
    let signals = {
        let pressed = Arc::clone(&pressed);
        move || {
            let now = started.elapsed().as_millis() as u64;
            if now >= asked.load(Ordering::Relaxed) + ASKED.as_millis() as u64 {
                asked.store(now, Ordering::Relaxed);
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    let _ = pressed.set(error);
                }
            }
            pressed.get().is_some()
        }
    };
    let cancel = Cancel::new().or(signals);
    let done = py.detach(|| work(&cancel));
    drop(cancel);
    match Arc::into_inner(pressed).and_then(OnceLock::into_inner) {
        Some(error) => Err(error),
        None => Ok(done),
    }
}

/// As [`apart`], on all cores, in a thread pool of its own, because the global pool of a process does not work after a fork.
fn apart_on_all_cores<T: Send + 'static>(
    py: Python<'_>,
    told: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Cancel, Tell<'_>) -> T + Send + 'static,
) -> PyResult<T> {
    apart(py, told, |cancel, tell| pooled(|| work(cancel, tell)))
}

/// How to solve, as keyword arguments of Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct How {
    accuracy: Option<String>,
    fidelity: Option<String>,
    method: String,
}

impl How {
    fn settings(&self, record: Record) -> PyResult<Settings> {
        let fidelity = match (&self.accuracy, &self.fidelity) {
            (Some(_), Some(_)) => return Err(scene_error("accuracy and fidelity: give one of them")),
            (Some(accuracy), None) => Fidelity::to(fidelity::parse_accuracy(accuracy).map_err(scene_error)?),
            (None, Some(name)) => name.parse().map_err(scene_error)?,
            (None, None) => Fidelity::default(),
        };
        let method = match self.method.as_str() {
            "auto" => Method::Auto,
            "paper" => Method::Paper,
            other => return Err(scene_error(format!("method = {other} is not allowed: auto or paper"))),
        };
        Ok(Settings { fidelity, method, record })
    }

    /// The settings, if they ask for our own method; the error message begins with `what`.
    fn own(&self, what: &str) -> PyResult<Settings> {
        let settings = self.settings(Record::Numbers)?;
        match settings.method {
            Method::Auto => Ok(settings),
            Method::Paper => Err(scene_error(format!("method = paper: {what} of our own method; allowed here: auto"))),
        }
    }
}

#[pymodule]
fn _squeezefilm(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("SceneError", module.py().get_type::<SceneError>())?;
    module.add("SolveError", module.py().get_type::<SolveError>())?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<run::Run>()?;
    module.add_function(wrap_pyfunction!(scene::built_in, module)?)?;
    module.add_function(wrap_pyfunction!(scene::keys, module)?)?;
    module.add_function(wrap_pyfunction!(run::with_error, module)?)?;
    module.add_function(wrap_pyfunction!(many::sweep, module)?)?;
    module.add_function(wrap_pyfunction!(many::points, module)?)?;
    module.add_function(wrap_pyfunction!(many::part, module)?)?;
    module.add_function(wrap_pyfunction!(many::join, module)?)?;
    module.add_function(wrap_pyfunction!(studies::sensitivity, module)?)?;
    module.add_function(wrap_pyfunction!(studies::fit, module)?)?;
    module.add_function(wrap_pyfunction!(studies::optimise, module)?)?;
    module.add_function(wrap_pyfunction!(studies::startup, module)?)?;
    module.add_function(wrap_pyfunction!(studies::hold, module)?)
}
