//! State of the fit tab: the table of measurements, the form, and the result of a fit or of the search for an optimum.

use super::background::BackgroundOf;
use super::document::solved_alike;
use super::sweep::AxisForm;
use crate::analysis::fit::{Bounds, Goal, Limit, Measured, Observable, Unknown, measurable};
use crate::gui::derived::words::unused;
pub use crate::job::fit::FitResult;
use crate::job::fit::FitWork;
use crate::job::task::TaskOf;
use crate::problem::Problem;
use crate::scene::{Parameter, ParameterKind, Scene};
use std::sync::Arc;

/// Keys for the first unknown of a new form, in order of preference.
const FIRST: [&str; 2] = ["plate.mean_gap_um", "film.min_spacing_nm"];

/// Goal of the search: a fit or an optimum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sought {
    /// Best agreement with the measurements.
    #[default]
    Agreement,
    /// The greatest value of a number.
    Greatest,
    /// Its least value.
    Least,
}

/// Which scene is open, whatever edits were made to it: the number of scenes opened so far, and the lesson and step that have set up
/// another one.
pub type Opened = (u64, Option<(usize, usize)>);

/// The form, as typed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FitForm {
    /// The keys to be chosen.
    pub axes: Vec<AxisForm>,
    /// Goal of the search.
    pub sought: Sought,
    /// The number whose optimum is sought, by its name.
    pub quantity: Option<&'static str>,
    /// Limits on other numbers, as they are typed.
    pub limits: String,
}

/// The table, the form, and the fit.
#[derive(Debug, Default)]
pub struct FitState {
    /// The table.
    pub measured: Option<Arc<Measured>>,
    /// The scene that was open when the table was read.
    over: Opened,
    /// The form, as typed.
    pub form: FitForm,
    /// Fault of each key of the form, in order; `None` if it is valid.
    pub faults: Vec<Option<String>>,
    /// Numbers whose optimum can be sought: name, and words with the unit.
    pub quantities: Vec<(&'static str, String)>,
    /// Scene for which the form was last checked; `None` if it has changed since.
    judged: Option<Scene>,
    /// Fault of the limits; `None` if they are valid.
    pub goal_fault: Option<String>,
    /// The search; its messages carry the number of points tried and the best value so far.
    pub work: BackgroundOf<FitWork>,
    /// The scene for which the search runs.
    asked: Option<Scene>,
    /// Number of points tried, and the least χ² or the best value so far.
    pub told: Option<(usize, f64)>,
    /// The result, and the scene for which it was computed.
    pub found: Option<(Scene, Arc<FitResult>)>,
}

impl FitForm {
    /// The limits on other numbers. A comma followed by a digit is a decimal comma.
    fn limits(&self) -> Result<Vec<Limit>, String> {
        let mut limits: Vec<String> = Vec::new();
        for piece in self.limits.split(',') {
            match limits.last_mut() {
                Some(last) if piece.starts_with(|c: char| c.is_ascii_digit()) => *last = format!("{last},{piece}"),
                _ => limits.push(piece.to_owned()),
            }
        }
        let limits = limits.iter().map(|limit| limit.trim()).filter(|limit| !limit.is_empty());
        limits.map(str::parse::<Limit>).collect::<Result<_, _>>().map_err(|error| error.to_string())
    }

    /// Chooses one more key: the first that is not there.
    pub fn add(&mut self, scene: &Scene) {
        let taken = |key: &str| self.axes.iter().any(|axis| axis.key == key);
        let next = scene.parameters().find(|parameter| chooses(scene, parameter) && !taken(parameter.key));
        self.axes.extend(next.map(|parameter| AxisForm::around(scene, parameter.key, 2)));
    }
}

/// Whether this key can be chosen between two bounds.
pub fn chooses(scene: &Scene, parameter: &Parameter) -> bool {
    matches!(parameter.kind, ParameterKind::Number { .. })
        && parameter.table() != "numerics"
        && unused(scene, parameter).is_none()
        && scene.get(parameter.key).is_some()
}

impl FitState {
    /// Replaces the table by `measured`, which was read while the scene `over` was open.
    pub fn load(&mut self, measured: Measured, over: Opened) {
        (self.measured, self.over) = (Some(Arc::new(measured)), over);
        (self.work.failure, self.told) = (None, None);
    }

    /// The torques of the table that were measured on the present scene, which is `opened`: speed \[rpm\] and torque \[N m\]. Also the
    /// number of the other torques, which were measured with other values of some keys, or read while another scene was open.
    pub fn torques(&self, opened: Opened) -> (Vec<[f64; 2]>, usize) {
        let (mut torques, mut others) = (Vec::new(), 0);
        let Some(measured) = &self.measured else { return (torques, others) };
        for one in &measured.measurements {
            match one.what {
                Observable::Torque { .. } if self.over != opened || !measured.conditions[one.condition].is_empty() => {
                    others += 1;
                }
                Observable::Torque { speed_rpm } => torques.push([speed_rpm, one.value]),
                Observable::Number(_) => {}
            }
        }
        (torques, others)
    }

    /// Fits the form to `scene` and checks it, if either has changed.
    pub fn review(&mut self, scene: &Scene) {
        let Self { form: FitForm { axes, quantity, .. }, quantities: known, .. } = self;
        if self.judged.as_ref() == Some(scene) && self.faults.len() == axes.len() {
            return;
        }
        let has = |key: &str| Parameter::find(key).is_some_and(|parameter| chooses(scene, parameter));
        axes.retain(|axis| has(axis.key));
        if axes.is_empty() {
            axes.extend(FIRST.iter().find(|key| has(key)).map(|key| AxisForm::around(scene, key, 2)));
        }
        let fault = |(i, axis): (usize, &AxisForm)| {
            let twice = axes[..i].iter().any(|other| other.key == axis.key);
            if twice { Some("Chosen twice: take another key".to_owned()) } else { bounds(scene, axis).err() }
        };
        self.faults = axes.iter().enumerate().map(fault).collect();
        *known = quantities(scene);
        let present = quantity.filter(|name| known.iter().any(|(other, _)| other == name));
        *quantity = present.or_else(|| known.first().map(|(name, _)| *name));
        self.goal_fault = self.goal(scene).err();
        self.judged = Some(scene.clone());
    }

    /// Replaces the form.
    pub fn ask(&mut self, form: FitForm) {
        (self.form, self.judged) = (form, None);
    }

    /// The optimum that is sought; `None` for a fit.
    ///
    /// # Errors
    /// If a limit cannot be read, or the goal does not fit the scene.
    pub fn goal(&self, scene: &Scene) -> Result<Option<Goal>, String> {
        let FitForm { sought, quantity, .. } = &self.form;
        let (Some(name), true) = (*quantity, *sought != Sought::Agreement) else { return Ok(None) };
        let limits = self.form.limits()?;
        Goal::new(scene, name, *sought == Sought::Greatest, &limits).map(Some).map_err(|error| error.to_string())
    }

    /// Whether the form now asks for something other than the last result.
    pub fn asks_for_another(&self) -> bool {
        let FitForm { sought, quantity, .. } = &self.form;
        self.found.as_ref().is_some_and(|(_, found)| match &**found {
            FitResult::Fit(..) => *sought != Sought::Agreement,
            FitResult::Optimum(found) => {
                let Goal { quantity: of, greatest, limits } = &found.goal;
                let asked = if *greatest { Sought::Greatest } else { Sought::Least };
                let limits = limits.iter().map(|(limit, _)| limit.clone()).collect();
                (*sought, *quantity) != (asked, Some(of.name())) || self.form.limits() != Ok(limits)
            }
        })
    }

    /// The bounds given in the form.
    ///
    /// # Errors
    /// The first fault of the form.
    pub fn asked(&self, scene: &Scene) -> Result<Vec<Bounds>, String> {
        if let Some(fault) = self.faults.iter().flatten().chain(&self.goal_fault).next() {
            return Err(fault.clone());
        }
        self.form.axes.iter().map(|axis| bounds(scene, axis)).collect()
    }

    /// Starts to track `task`, a search for `scene`.
    pub fn begin(&mut self, scene: Scene, task: TaskOf<FitWork>) {
        (self.work, self.asked, self.told) = (task.into(), Some(scene), None);
    }

    /// Takes progress and results since the last call.
    pub fn drain(&mut self) {
        let (messages, found) = self.work.found();
        self.told = messages.into_iter().last().or(self.told);
        if let Some(found) = found {
            self.found = self.asked.take().map(|scene| (scene, Arc::new(found)));
        }
    }

    /// Whether `scene` differs both from the scene that was fitted and from the fitted scene.
    pub fn stale(&self, scene: &Scene) -> bool {
        let found = self.found.as_ref();
        found.is_some_and(|(asked, found)| !solved_alike(asked, scene) && !solved_alike(found.scene(), scene))
    }
}

fn quantities(scene: &Scene) -> Vec<(&'static str, String)> {
    let Ok(problem) = Problem::try_from(scene) else { return Vec::new() };
    measurable(&problem).into_iter().map(|quantity| (quantity.name(), quantity.label(&problem))).collect()
}

/// The bounds given in a line of the form.
fn bounds(scene: &Scene, axis: &AxisForm) -> Result<Bounds, String> {
    let (from, to, scale) = axis.ends()?;
    let bounds = Bounds { key: axis.key.to_owned(), from, to, scale: Some(scale) };
    Unknown::new(scene, &bounds).map_err(|error| error.to_string())?;
    Ok(bounds)
}
