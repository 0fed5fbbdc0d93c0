//! State of the sweep tab: the form, the progress, and the rows that are solved.

use crate::analysis::quantity::Quantity;
use crate::analysis::sweep::{Axis, MOST_VALUES, Sweep, SweepRow, Values, Vary};
use crate::analysis::table1::Published;
use crate::digits::rounded;
use crate::fidelity::Fidelity;
use crate::gui::derived::sliders::slider_range;
use crate::gui::derived::words::unused;
use crate::job::sweep::{SweepMessage, SweepWork};
use crate::job::task::{News, TaskOf};
use crate::platform::Instant;
use crate::problem::Problem;
use crate::scene::{Parameter, ParameterKind, Range, Scale, Scene, Value, quantity_text};
use std::sync::Arc;

/// Default keys along x and y, in order of preference. The first that the scene has is taken; if it has none of them, any key of the scene.
const FIRST: [&[&str]; 2] = [
    &["plate.frequency_khz", "film.min_spacing_nm", "surface.rms_nm"],
    &["plate.mean_gap_um", "motor.load_per_wave_n", "motor.load_n", "plate.amplitude_um"],
];
/// Default number of points of a line, and along each side of a map.
const LINE: usize = 25;
const SIDE: usize = 12;
/// A default logarithmic range extends from the present value divided by this factor to the value times it.
const REACH: f64 = 4.0;
/// Significant digits of its ends.
const DIGITS: usize = 2;
/// An end that the scene refuses is moved towards the present value in this many steps.
const STEPS: u32 = 24;

/// A varied parameter and its values, as typed.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisForm {
    /// Dotted key.
    pub key: &'static str,
    /// First value.
    pub from: String,
    /// Last value.
    pub to: String,
    /// Number of values.
    pub count: String,
    /// Equal ratios instead of equal steps.
    pub log: bool,
}

impl AxisForm {
    /// A useful range of `key` round its value in `scene`.
    pub fn around(scene: &Scene, key: &'static str, count: usize) -> Self {
        let mut form = Self { key, from: String::new(), to: String::new(), count: count.to_string(), log: false };
        let Some(parameter) = Parameter::find(key) else { return form };
        let (slider, log) = slider_range(scene, parameter);
        let present = scene.get(key).or(parameter.usual()).and_then(|value| value.as_number()).unwrap_or_default();
        // Values beyond the range of the slider are allowed.
        let range = if present == 0.0 { slider } else { scene.range(key).unwrap_or(slider) };
        let wanted = if log {
            [present / REACH, present * REACH]
        } else if present == 0.0 {
            [range.min, range.max]
        } else {
            [present - present.abs(), present + present.abs()]
        };
        let whole = matches!(parameter.kind, ParameterKind::Whole { .. });
        let [low, high] = wanted.map(|end| {
            let end = end.clamp(range.min, range.max);
            allowed(scene, key, present, if whole { end.round() } else { end }, whole, range)
        });
        (form.from, form.to, form.log) = (low.to_string(), high.to_string(), log && low > 0.0);
        if whole && high - low + 1.0 < count as f64 {
            form.count = format!("{}", high - low + 1.0);
        }
        form
    }

    /// Its ends and the spacing between them, or the fault of an end.
    pub fn ends(&self) -> Result<(f64, f64, Scale), String> {
        let parameter = Parameter::find(self.key).ok_or_else(|| format!("{} is not known", self.key))?;
        let scale = if self.log { Scale::Log } else { Scale::Linear };
        Ok((quantity_text::read(parameter, &self.from)?, quantity_text::read(parameter, &self.to)?, scale))
    }

    /// The axis of a sweep that it describes.
    ///
    /// # Errors
    /// A sentence on the first fault and on what is allowed.
    pub fn vary(&self, scene: &Scene) -> Result<Vary, String> {
        let (from, to, scale) = self.ends()?;
        let counted = self.count.trim().parse::<usize>();
        let count = counted.map_err(|_| format!("{} values: allowed 2 to {MOST_VALUES}", self.count.trim()))?;
        let vary = Vary { key: self.key.to_owned(), values: Values::Range { from, to, count, scale } };
        Axis::new(scene, &vary).map_err(|error| error.in_place())?;
        Ok(vary)
    }
}

/// The value nearest to `end` between `present` and `end` that the scene accepts, rounded to few digits.
fn allowed(scene: &Scene, key: &str, present: f64, end: f64, whole: bool, range: Range) -> f64 {
    let fits = |value: f64| {
        let mut next = scene.clone();
        range.contains(value) && next.set_value(key, Value::Number(value)).is_ok() && Problem::try_from(&next).is_ok()
    };
    for step in 0..STEPS {
        let value = end + (present - end) * f64::from(step) / f64::from(STEPS);
        let short = if whole { value.round() } else { rounded(value, DIGITS) };
        if let Some(found) = [short, value].into_iter().find(|value| fits(*value)) {
            return found;
        }
    }
    present
}

/// The form of the sweep tab.
#[derive(Clone, Debug, PartialEq)]
pub struct Form {
    /// Along x and, for a map, along y. The axis along y is kept while it is not used.
    pub axes: [AxisForm; 2],
    /// Whether a second parameter is varied.
    pub second: bool,
    /// Fidelity of every point.
    pub fidelity: Fidelity,
}

impl Form {
    /// A form with defaults for `scene`.
    pub fn of(scene: &Scene) -> Self {
        let keys: Vec<&str> = candidates(scene).map(|parameter| parameter.key).collect();
        let preferred = |axis: usize| FIRST[axis].iter().copied().filter(|key| keys.contains(key));
        let first = preferred(0).next().unwrap_or(FIRST[0][0]);
        let others = preferred(1).chain(keys.iter().copied());
        let second = others.into_iter().find(|key| *key != first).unwrap_or(first);
        let axes = [AxisForm::around(scene, first, LINE), AxisForm::around(scene, second, SIDE)];
        Self { axes, second: false, fidelity: Fidelity::default() }
    }

    /// The axes in use.
    pub fn axes(&self) -> &[AxisForm] {
        &self.axes[..if self.second { 2 } else { 1 }]
    }

    /// Default number of values along an axis.
    pub fn usual_count(&self) -> usize {
        if self.second { SIDE } else { LINE }
    }

    /// Sets whether a second parameter is varied.
    pub fn set_second(&mut self, second: bool) {
        // A map with as many points along x as a line would take too long.
        let usual = [LINE.to_string(), SIDE.to_string()];
        let [old, new] = if second { [&usual[0], &usual[1]] } else { [&usual[1], &usual[0]] };
        if self.axes[0].count == *old {
            self.axes[0].count.clone_from(new);
        }
        self.second = second;
    }
}

/// Whether the scene has a number of this key that can be varied.
pub fn varies(scene: &Scene, key: &str) -> bool {
    candidates(scene).any(|parameter| parameter.key == key)
}

/// Parameters that can be varied: numbers that have an effect in this scene.
pub fn candidates(scene: &Scene) -> impl Iterator<Item = &'static Parameter> + '_ {
    let number =
        |parameter: &&Parameter| matches!(parameter.kind, ParameterKind::Number { .. } | ParameterKind::Whole { .. });
    scene.parameters().filter(number).filter(|parameter| unused(scene, parameter).is_none())
}

/// A sweep that was begun.
#[derive(Debug)]
pub struct Swept {
    /// The sweep.
    pub sweep: Arc<Sweep>,
    /// The rows that are solved, in the order of the points.
    pub rows: Vec<SweepRow>,
    /// Published points of Table I in its plane.
    pub published: Vec<Published>,
    /// Its number in this window.
    pub number: u64,
    /// Whether it is running.
    pub running: bool,
    /// Why it ended too early, if it was not cancelled.
    pub failure: Option<String>,
    started: Instant,
    /// Number of rows when it was begun or continued.
    before: usize,
}

impl Swept {
    /// Whether every point is there.
    pub fn complete(&self) -> bool {
        self.rows.len() == self.sweep.len()
    }

    /// Share that is done, 0 to 1.
    pub fn share(&self) -> f64 {
        self.rows.len() as f64 / self.sweep.len().max(1) as f64
    }

    /// When it was begun or continued, and the share that has been done since.
    pub fn since(&self) -> (Instant, f64) {
        (self.started, self.rows.len().saturating_sub(self.before) as f64 / self.sweep.len().max(1) as f64)
    }

    /// Whether `scene` differs from the swept scene in more than the varied parameters.
    pub fn stale(&self, scene: &Scene) -> bool {
        let mut ours = self.sweep.scene().clone();
        (ours.name, ours.about) = (scene.name.clone(), scene.about.clone());
        for axis in self.sweep.axes() {
            let key = axis.parameter.key;
            let set = match scene.get(key) {
                Some(value) => ours.set_value(key, value),
                None => ours.unset(key),
            };
            if set.is_err() {
                return true;
            }
        }
        ours != *scene
    }

    /// The scene's values of the varied parameters, if it has them all.
    pub fn present(&self, scene: &Scene) -> Option<Vec<f64>> {
        self.sweep.axes().iter().map(|axis| scene.get(axis.parameter.key)?.as_number()).collect()
    }
}

/// State of the sweep tab.
#[derive(Debug, Default)]
pub struct SweepState {
    /// The form; `None` until a scene was shown.
    pub form: Option<Form>,
    /// The form for the other kind of scene, kept for a later return to it.
    before: Option<Form>,
    /// The scene that the form was checked with; none once the form has changed.
    checked: Option<Scene>,
    /// Fault of each axis in use; `None` if it is valid.
    pub faults: Vec<Option<String>>,
    quantity: Option<Quantity>,
    task: Option<(TaskOf<SweepWork>, Instant)>,
    /// The newest sweep that was begun.
    pub swept: Option<Swept>,
    /// Why the last requested sweep could not begin.
    pub refusal: Option<String>,
}

impl SweepState {
    /// Whether the points of a sweep are being built, before there is any row.
    pub fn building(&self) -> bool {
        self.task.is_some() && self.swept.as_ref().is_none_or(|swept| !swept.running)
    }

    /// The quantity to draw, one of `among`: the chosen one, or a default.
    pub fn quantity(&self, among: &[Quantity]) -> Quantity {
        let mut wanted = self.quantity.into_iter().chain(Quantity::HEADLINES);
        wanted.find(|wanted| among.contains(wanted)).unwrap_or(Quantity::FilmLoad)
    }

    /// Fits the form to `scene` and checks it, if either has changed.
    pub fn review(&mut self, scene: &Scene) {
        if self.checked.as_ref() == Some(scene) {
            return;
        }
        let form = self.form.get_or_insert_with(|| Form::of(scene));
        let fits = |form: &Form| form.axes.iter().all(|axis| varies(scene, axis.key));
        if !fits(form) {
            let next = Form { second: form.second, fidelity: form.fidelity, ..Form::of(scene) };
            let next = self.before.take().filter(fits).unwrap_or(next);
            self.before = Some(std::mem::replace(form, next));
        }
        self.faults = form.axes().iter().map(|axis| axis.vary(scene).err()).collect();
        self.checked = Some(scene.clone());
    }

    /// Chooses the quantity that is drawn.
    pub fn draw(&mut self, quantity: Quantity) {
        self.quantity = Some(quantity);
    }

    /// Replaces the form.
    pub fn ask(&mut self, form: Form) {
        (self.form, self.refusal, self.checked) = (Some(form), None, None);
        self.faults.clear();
    }

    /// The axes of the form, checked.
    ///
    /// # Errors
    /// The first fault of the form.
    pub fn asked(&self, scene: &Scene) -> Result<Vec<Vary>, String> {
        self.form.iter().flat_map(Form::axes).map(|axis| axis.vary(scene)).collect()
    }

    /// Starts to track `task`, a new sweep or, if `goes_on`, the rest of the present one.
    pub fn begin(&mut self, task: TaskOf<SweepWork>, goes_on: bool, now: Instant) {
        self.refusal = None;
        self.task = Some((task, now));
        if let Some(swept) = self.swept.as_mut().filter(|_| goes_on) {
            (swept.running, swept.started, swept.before, swept.failure) = (true, now, swept.rows.len(), None);
        }
    }

    /// Takes points and rows since the last call.
    pub fn drain(&mut self) {
        let Some((task, started)) = &self.task else { return };
        let (News { messages, end }, started) = (task.drain(), *started);
        let came_in = !messages.is_empty();
        for message in messages {
            match message {
                SweepMessage::Built(sweep) => {
                    let number = self.swept.as_ref().map_or(0, |swept| swept.number + 1);
                    let (rows, published) = (Vec::new(), sweep.published());
                    let (running, failure, before) = (true, None, 0);
                    self.swept = Some(Swept { sweep, rows, published, number, running, failure, started, before });
                }
                SweepMessage::Solved(row) => {
                    if let Some(swept) = &mut self.swept {
                        swept.rows.push(*row);
                    }
                }
            }
        }
        // All rows that have arrived are merged at once, because moving the rows of a large map for each of them takes long.
        if came_in {
            self.swept.iter_mut().for_each(|swept| swept.rows.sort_by_key(|row| row.point));
        }
        let Some(end) = end else { return };
        let building = self.building();
        self.task = None;
        match (end, &mut self.swept) {
            (Ok(rows), Some(swept)) if !building => {
                swept.running = false;
                rows.into_iter().for_each(|rows| swept.rows = rows);
            }
            (Ok(_), _) => {}
            (Err(why), Some(swept)) if !building => (swept.failure, swept.running) = (Some(why), false),
            (Err(why), _) => self.refusal = Some(why),
        }
    }

    /// Cancels the sweep.
    pub fn cancel(&self) {
        if let Some((task, _)) = &self.task {
            task.cancel();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;
    use crate::solve::Settings;

    fn ask(sweeps: &mut SweepState, change: impl Fn(&mut Form)) {
        let mut form = sweeps.form.as_ref().unwrap().clone();
        change(&mut form);
        sweeps.ask(form);
    }

    #[test]
    fn default_ranges_can_be_swept_and_hold_the_present_value() {
        for preset in ["fundamental", "tooth-radius-3m", "levitating", "plate-crossover", "plate-trapped"] {
            let scene = presets::find(preset).unwrap();
            for parameter in candidates(&scene) {
                let form = AxisForm::around(&scene, parameter.key, 7);
                let vary = form.vary(&scene).unwrap_or_else(|error| panic!("{preset}, {}: {error}", parameter.key));
                let sweep = Sweep::new(&scene, std::slice::from_ref(&vary), &Settings::default());
                assert!(sweep.is_ok(), "{preset}, {}: {form:?}: {}", parameter.key, sweep.unwrap_err());
                if let Some(present) = scene.get(parameter.key).and_then(|value| value.as_number()) {
                    let Values::Range { from, to, .. } = vary.values else { panic!("{vary:?}") };
                    assert!((from..=to).contains(&present), "{preset}, {}: {form:?}", parameter.key);
                }
            }
        }
    }

    #[test]
    fn what_is_typed_stays_whatever_kind_of_scene_it_is() {
        let mut whole_ring = presets::find("fundamental").unwrap();
        whole_ring.unset("motor.load_per_wave_n").unwrap();
        whole_ring.set_all([("motor.load_n", "17")]).unwrap();
        let presets = presets::BUILT_IN.iter().map(|preset| preset.scene().unwrap());
        for scene in presets.chain([whole_ring]) {
            let mut sweeps = SweepState::default();
            sweeps.review(&scene);
            ask(&mut sweeps, |form| form.axes[0].count = "9".to_owned());
            ask(&mut sweeps, |form| form.set_second(true));
            sweeps.review(&scene);
            assert_eq!(sweeps.form.as_ref().unwrap().axes[0].count, "9", "{}", scene.name);
            assert_eq!(sweeps.faults, [None, None], "{}", scene.name);
        }
    }

    #[test]
    fn bad_input_is_refused_with_what_is_allowed() {
        let scene = presets::find("fundamental").unwrap();
        let good = AxisForm::around(&scene, "film.min_spacing_nm", 9);
        let fault = |form: AxisForm| form.vary(&scene).unwrap_err();
        let text = str::to_owned;
        assert!(fault(AxisForm { from: text("3"), ..good.clone() }).contains("allowed 5 to 10000 nm"));
        assert!(fault(AxisForm { to: text("wide"), ..good.clone() }).contains("from 5 to 10000 nm"));
        assert!(fault(AxisForm { count: text("1"), ..good.clone() }).contains("allowed 2 to 10000"));
        assert!(fault(AxisForm { count: text("a few"), ..good.clone() }).contains("allowed 2 to 10000"));
        assert!(fault(AxisForm { to: good.from.clone(), ..good.clone() }).contains("differ"));
        let speed = AxisForm { log: true, ..AxisForm::around(&scene, "motor.rotor_speed_rpm", 9) };
        assert!(fault(speed).contains("above 0"));
        let vary = AxisForm { from: text(" 5,5"), ..good }.vary(&scene).unwrap();
        assert!(matches!(vary.values, Values::Range { from, .. } if from == 5.5), "{vary:?}");
    }

    #[test]
    fn another_kind_of_scene_has_other_parameters() {
        let (motor, plate) = (presets::find("fundamental").unwrap(), presets::find("plate-crossover").unwrap());
        let mut sweeps = SweepState::default();
        sweeps.review(&motor);
        ask(&mut sweeps, |form| form.axes[0].from = "50".to_owned());
        sweeps.review(&motor);
        assert_eq!(sweeps.form.as_ref().unwrap().axes[0].from, "50");
        assert_eq!(sweeps.faults, [None]);
        // What has no effect on a plate is not offered.
        assert!(varies(&motor, "film.min_spacing_nm") && !varies(&plate, "film.min_spacing_nm"));
        ask(&mut sweeps, |form| form.set_second(true));
        sweeps.review(&plate);
        let form = sweeps.form.as_ref().unwrap();
        assert!(form.axes[0].key == "plate.frequency_khz" && form.second, "{form:?}");
        assert!(sweeps.asked(&plate).is_ok_and(|axes| axes.len() == 2));
        // Back at a motor, its own form is there again.
        sweeps.review(&motor);
        assert_eq!(sweeps.form.as_ref().unwrap().axes[0].from, "50");
    }

    #[test]
    fn what_is_asked_for_is_checked_when_it_changes_and_not_at_every_redraw() {
        let scene = presets::find("fundamental").unwrap();
        let mut sweeps = SweepState::default();
        sweeps.review(&scene);
        // This text would be replaced by a check.
        let seen = vec![Some("checked before".to_owned())];
        sweeps.faults.clone_from(&seen);
        sweeps.draw(Quantity::FilmLoad);
        sweeps.review(&scene);
        assert_eq!(sweeps.faults, seen, "nothing has changed");
        ask(&mut sweeps, |form| form.axes[0].from = "wide".to_owned());
        sweeps.review(&scene);
        assert!(matches!(&sweeps.faults[..], [Some(fault)] if fault.contains("from 5 to 10000 nm")));
        sweeps.faults.clone_from(&seen);
        let mut edited = scene.clone();
        edited.set_all([("motor.waves", "8")]).unwrap();
        sweeps.review(&edited);
        assert_ne!(sweeps.faults, seen, "another scene may refuse what this one took");
    }
}
