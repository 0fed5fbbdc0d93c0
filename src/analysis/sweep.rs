//! One scene for several values of one, two or three keys. Only numbers are kept, no fields.
//!
//! The points of a sweep are solved on rayon's pool, in chunks of neighbours. The chunks depend only on the points, so the results do not
//! depend on the number of threads, to the last bit, and each agrees with a single solve of its scene. A point that fails or does not
//! converge is marked in its row, and the others go on.
//!
//! A cancelled sweep keeps its rows. When they are passed to [`Sweep::run`] again, it solves the missing points, and the result is the same
//! as without the interruption. [`Sweep::fingerprint`] shows whether rows on disk belong to the same sweep. A [`SweepPart`] of a sweep can be
//! solved elsewhere; the rows of all parts are those of the whole.

mod axis;
mod part;

pub use axis::{Axis, MOST_KEYS, MOST_POINTS, MOST_VALUES, Values, Vary, spaced};
pub use part::SweepPart;
use part::{CHUNK, chunk, count};

use super::attempt::{RunStatus, error_in_words};
use super::error::AnalysisError;
use super::quantity::{Numbers, Quantity, force_unit};
use super::table1::{Published, published_at};
use super::validity;
use crate::control::Cancel;
use crate::motor::Warm;
use crate::problem::Problem;
use crate::scene::{Parameter, Scene, SceneError};
use crate::solution::{Status, StoppedBy};
use crate::solve::{Method, Record, Settings, check, solve_from};
use fnv::FnvHasher;
use rayon::prelude::*;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::hash::Hasher;
use std::ops::Range;
use std::time::Duration;

/// One point of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepRow {
    /// The index of the point, from 0; the last axis varies fastest.
    pub point: usize,
    /// The value of each axis there.
    pub values: Vec<f64>,
    /// How it ended.
    pub status: RunStatus,
    /// Why no finer grid was solved; `None` if it failed.
    #[serde(default)]
    pub stopped_by: Option<StoppedBy>,
    /// The numbers; none if it failed.
    pub numbers: Numbers,
    /// Names of the limits of the model that it exceeds; none if it failed.
    #[serde(deserialize_with = "validity::known_names")]
    pub outside: Vec<&'static str>,
}

/// The median of a quantity's stated errors over the rows that converged; 0 where it has none.
pub fn typical_error(rows: &[SweepRow], quantity: Quantity) -> f64 {
    let sound = rows.iter().filter(|row| row.status == RunStatus::Converged);
    let mut errors: Vec<f64> = sound.filter_map(|row| row.numbers.get(quantity.error()?)).collect();
    errors.sort_by(f64::total_cmp);
    errors.get(errors.len() / 2).copied().unwrap_or(0.0)
}

/// A sweep, checked: at least one of its points is a scene that can be solved.
#[derive(Clone, Debug)]
pub struct Sweep {
    scene: Scene,
    vary: Vec<Vary>,
    settings: Settings,
    axes: Vec<Axis>,
    /// The first point that can be solved.
    first: Problem,
    /// Time limit of each point, if there is one. The caller applies it, by the flag that ends each solve.
    pub budget: Option<Duration>,
}

/// A sweep is serialised as the arguments that it was made of.
impl Serialize for Sweep {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        (&self.scene, &self.vary, &self.settings).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Sweep {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let (scene, vary, settings) = <(Scene, Vec<Vary>, Settings)>::deserialize(from)?;
        Self::new(&scene, &vary, &settings).map_err(D::Error::custom)
    }
}

impl Sweep {
    /// A sweep of `scene` over one, two or three keys. For a key of whole numbers, the values are rounded, and each is used once. Points
    /// that break a rule between keys become rows that say so.
    ///
    /// # Errors
    /// [`AnalysisError`], with the key, the value and what is allowed; if no point can be solved, the error of the first.
    pub fn new(scene: &Scene, vary: &[Vary], settings: &Settings) -> Result<Self, AnalysisError> {
        Self::of_part(scene, vary, settings, SweepPart::WHOLE)
    }

    /// A sweep of which only one part is to be solved: the limit on the number of points applies to that part.
    pub fn of_part(scene: &Scene, vary: &[Vary], settings: &Settings, part: SweepPart) -> Result<Self, AnalysisError> {
        if !(1..=MOST_KEYS).contains(&vary.len()) {
            let found = vary.len();
            return Err(AnalysisError::Input(format!("vary: {found} keys given: allowed 1 to {MOST_KEYS}")));
        }
        // The range of a key may depend on a choice that is varied too: that of a temperature depends on the gas.
        let mut chosen = scene.clone();
        for Vary { key, values } in vary {
            if let Values::List(words) = values
                && Parameter::find(key).is_some_and(|parameter| parameter.range().is_none())
                && let Some(first) = words.first()
            {
                // An error in its values is reported for its axis.
                chosen.set(key, first).ok();
            }
        }
        let axes = vary.iter().map(|vary| Axis::new(&chosen, vary)).collect::<Result<Vec<_>, _>>()?;
        for (i, axis) in axes.iter().enumerate() {
            if axes[..i].iter().any(|other| other.parameter.key == axis.parameter.key) {
                let key = axis.parameter.key;
                return Err(AnalysisError::Field {
                    message: format!("vary {key}: given twice: the keys have to differ"),
                    in_place: "Both axes vary the same parameter: choose another".to_owned(),
                });
            }
        }
        let found = part.points(&axes).len();
        if found > MOST_POINTS {
            let parts = if part.of() == 1 { String::new() } else { format!(" in one of {} parts", part.of()) };
            let in_place = format!("{found} points{parts}: allowed up to {MOST_POINTS}");
            let message = format!("vary: {in_place}, or as many in each part of sweep --part");
            return Err(AnalysisError::Field { message, in_place });
        }
        let at = |point: usize| solvable(scene, &axes, &values_at(&axes, point), settings);
        // If the sweep is larger, a sample of points is checked, which is the same for every part.
        let mut others = (0..count(&axes)).step_by(count(&axes).div_ceil(MOST_POINTS)).skip(1);
        let first = at(0).or_else(|fault| others.find_map(|point| at(point).ok()).ok_or(fault))?;
        Ok(Self { first, scene: scene.clone(), vary: vary.to_vec(), settings: *settings, axes, budget: None })
    }

    /// The axes; the last varies fastest.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The scene that is varied.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The name of that scene above a figure, with the changes to it other than the varied keys.
    pub fn headline(&self) -> String {
        self.scene.headline_over(&self.axes.iter().map(|axis| axis.parameter).collect::<Vec<_>>())
    }

    /// Keys that are varied and their values, as they were given.
    pub fn vary(&self) -> &[Vary] {
        &self.vary
    }

    /// How it is solved.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The problem of the first point that can be solved; all points have the same kind of scene.
    pub fn problem(&self) -> &Problem {
        &self.first
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        count(&self.axes)
    }

    /// Always false: a sweep has points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The value of each axis at a point.
    pub fn values(&self, point: usize) -> Vec<f64> {
        values_at(&self.axes, point)
    }

    /// The scene of a point, for solving it alone.
    pub fn scene_at(&self, point: usize) -> Result<Scene, SceneError> {
        varied(&self.scene, &self.axes, &self.values(point))
    }

    /// Problem at a point, or why there is none.
    fn problem_at(&self, point: usize) -> Result<Problem, String> {
        let problem = self.scene_at(point).and_then(|scene| Problem::try_from(&scene));
        let problem = problem.map_err(|error| error.to_string())?;
        let (found, unit) = (force_unit(&problem), force_unit(&self.first));
        if found == unit {
            Ok(problem)
        } else {
            Err(format!("its forces are in {found}, those of the other points in {unit}"))
        }
    }

    /// The quantities its rows have.
    pub fn quantities(&self) -> Vec<Quantity> {
        Quantity::of(self.problem()).collect()
    }

    /// A hash as sixteen hexadecimal digits. It changes with everything that the results depend on: scene, axes, settings, budget and
    /// version.
    pub fn fingerprint(&self) -> String {
        let method = self.settings.method;
        // The paper's method has no fidelity.
        let fidelity = if method == Method::Auto { self.settings.fidelity.to_string() } else { String::new() };
        let mut texts =
            vec![env!("CARGO_PKG_VERSION").to_owned(), self.scene.to_toml(), method.name().to_owned(), fidelity];
        texts.push(CHUNK.to_string());
        texts.extend(self.budget.map(|budget| format!("{budget:?}")));
        for axis in &self.axes {
            texts.push(axis.parameter.key.to_owned());
            texts.extend(axis.values.iter().map(|value| format!("{value:?}")));
            texts.extend(axis.words.iter().cloned());
        }
        digest(texts.iter().map(String::as_str))
    }

    /// Published points of Table I whose scene is one of this sweep's but for the keys that are varied, at values of those inside the ranges that are
    /// swept.
    pub fn published(&self) -> Vec<Published> {
        if self.axes.iter().any(|axis| !axis.words.is_empty()) {
            return Vec::new();
        }
        let keys: Vec<&str> = self.axes.iter().map(|axis| axis.parameter.key).collect();
        let inside = |point: &Published| {
            self.axes.iter().zip(&point.values).all(|(axis, value)| {
                axis.values.iter().any(|swept| swept <= value) && axis.values.iter().any(|swept| value <= swept)
            })
        };
        published_at(&self.scene, &keys).into_iter().filter(inside).collect()
    }

    /// Solves every point that is not in `done`, several at a time on rayon's pool. Returns all rows, including those in `done`, in the
    /// order of the points; there are fewer than [`Sweep::len`] if it was cancelled. `finished` is called for each new row, on any thread.
    pub fn run(&self, done: &[SweepRow], cancel: &Cancel, finished: &(dyn Fn(&SweepRow) + Sync)) -> Vec<SweepRow> {
        self.run_part(SweepPart::WHOLE, done, cancel, finished)
    }

    /// The points of a part. A part consists of whole chunks, each of which is solved from one cold start, so the parts together give the
    /// same rows as the whole, to the last bit. A part of a small sweep can be empty.
    pub fn points_of(&self, part: SweepPart) -> Range<usize> {
        part.points(&self.axes)
    }

    /// As [`Sweep::run`], but only for the points of a part.
    pub fn run_part(
        &self,
        part: SweepPart,
        done: &[SweepRow],
        cancel: &Cancel,
        finished: &(dyn Fn(&SweepRow) + Sync),
    ) -> Vec<SweepRow> {
        let points = self.points_of(part);
        let mut rows: Vec<Option<SweepRow>> = vec![None; points.len()];
        for row in done {
            if let Some(place) = row.point.checked_sub(points.start).and_then(|place| rows.get_mut(place)) {
                *place = Some(row.clone());
            }
        }
        let solved: Vec<Vec<SweepRow>> = part
            .chunks(&self.axes)
            .into_par_iter()
            .map(|number| {
                let chunk = chunk(&self.axes, number);
                if rows[chunk.start - points.start..chunk.end - points.start].iter().all(Option::is_some) {
                    return Vec::new();
                }
                self.solve_chunk(chunk, cancel, &|row| {
                    if rows[row.point - points.start].is_none() {
                        finished(row);
                    }
                })
            })
            .collect();
        for row in solved.into_iter().flatten() {
            let place = row.point - points.start;
            rows[place] = Some(row);
        }
        rows.into_iter().flatten().collect()
    }

    /// Solves the points of a chunk one after the other; ends early if cancelled.
    ///
    /// The first point of a chunk starts cold, the others start from their neighbour: this takes fewer rounds, and the result is the same
    /// to a fraction of its stated error. A chunk that was interrupted is solved again from its first point, so that neither threads nor a
    /// cancelled run change a result.
    fn solve_chunk(&self, chunk: Range<usize>, cancel: &Cancel, finished: &dyn Fn(&SweepRow)) -> Vec<SweepRow> {
        let mut rows = Vec::new();
        let mut warm = Warm::default();
        let settings = Settings { record: Record::Numbers, ..self.settings };
        for point in chunk {
            if cancel.is_cancelled() {
                break;
            }
            let problem = self.problem_at(point);
            let mut row = SweepRow {
                point,
                values: self.values(point),
                status: RunStatus::Waiting,
                stopped_by: None,
                numbers: Numbers::default(),
                outside: Vec::new(),
            };
            let solved = problem.and_then(|problem| {
                let solution = error_in_words(|| solve_from(&mut warm, &problem, &settings, &mut (), cancel))?;
                Ok((problem, solution))
            });
            match solved {
                Ok((_, solution)) if solution.status == Status::Cancelled => break,
                Ok((problem, solution)) => {
                    row.status = solution.status.into();
                    row.stopped_by = Some(solution.accuracy.stopped_by);
                    row.numbers = Numbers::of(&problem, &solution);
                    row.outside = validity::names(&validity::outside(&problem, &solution));
                }
                // A point that was interrupted is not a failure.
                Err(_) if cancel.is_cancelled() => break,
                Err(reason) => row.status = RunStatus::Failed(reason),
            }
            finished(&row);
            rows.push(row);
        }
        rows
    }
}

fn values_at(axes: &[Axis], point: usize) -> Vec<f64> {
    let (mut rest, mut values) = (point, Vec::new());
    for axis in axes.iter().rev() {
        values.push(axis.values[rest % axis.values.len()]);
        rest /= axis.values.len();
    }
    values.reverse();
    values
}

/// The problem at these values, checked.
fn solvable(scene: &Scene, axes: &[Axis], values: &[f64], settings: &Settings) -> Result<Problem, AnalysisError> {
    let problem = Problem::try_from(&varied(scene, axes, values)?)?;
    check(&problem, &Settings { record: Record::Numbers, ..*settings })?;
    Ok(problem)
}

/// The scene with the varied keys at these values.
fn varied(scene: &Scene, axes: &[Axis], values: &[f64]) -> Result<Scene, SceneError> {
    scene.with(axes.iter().zip(values).map(|(axis, value)| (axis.parameter.key, axis.text(*value))))
}

/// Hash of the texts as sixteen hexadecimal digits, the same on every machine and with every compiler version.
pub fn digest<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    let mut hash = FnvHasher::default();
    for text in texts {
        hash.write(text.as_bytes());
        // This byte marks the end of a text, because UTF-8 never contains it.
        hash.write(&[0xff]);
    }
    format!("{:016x}", hash.finish())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fidelity::Fidelity;
    use crate::scene::{Scale, Value, presets};

    fn sweep(preset: &str, vary: &[&str]) -> Result<Sweep, AnalysisError> {
        let vary = vary.iter().map(|text| text.parse()).collect::<Result<Vec<Vary>, _>>()?;
        let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
        Sweep::new(&presets::find(preset).unwrap(), &vary, &settings)
    }

    #[test]
    fn values_are_spaced_and_short() {
        assert_eq!(spaced(10.0, 40.0, 4, Scale::Linear), [10.0, 20.0, 30.0, 40.0]);
        assert_eq!(spaced(0.1, 0.3, 3, Scale::Linear), [0.1, 0.2, 0.3]);
        assert_eq!(spaced(1.0, 1000.0, 4, Scale::Log), [1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(spaced(5.0, -5.0, 3, Scale::Linear), [5.0, 0.0, -5.0]);
        let teeth = sweep("fundamental", &["motor.waves=1:8:40:log"]).unwrap();
        assert_eq!(teeth.axes()[0].values, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        let units = sweep("fundamental", &["film.min_spacing_nm=0.05um,150,0.1 um"]).unwrap();
        assert_eq!((&units.axes()[0].values[..], units.axes()[0].words.len()), (&[50.0, 150.0, 100.0][..], 0));
        let units = sweep("fundamental", &["film.min_spacing_nm=0.05um:0.1um:3"]).unwrap();
        assert_eq!(units.axes()[0].values, [50.0, 75.0, 100.0]);
    }

    #[test]
    fn what_cannot_be_swept_is_told() {
        for (vary, words) in [
            (&["film.min_spacing_nm"][..], "expected key=from:to:count"),
            (&["film.min_spacing_nm=1:2"], "expected key=from:to:count"),
            (&["film.min_spacing_nm=100:x:3"], "film.min_spacing_nm = x is not a number"),
            (
                &["film.min_spacing_nm=0.1um:5kHz:3"],
                "5kHz is not a number: expected a number from 5 to 10000 nm, in nm, µm",
            ),
            (&["film.min_spacing_nm=100:200:3:cubic"], "expected key=from:to:count"),
            (&["film.min_spacing_nm=3:200:3"], "film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm"),
            (&["film.min_spacing_nm=100:NaN:3"], "film.min_spacing_nm = NaN is not a number"),
            (&["film.min_spacing_nm=100:200:1"], "count = 1 is out of range: allowed 2 to 10000"),
            (&["film.min_spacing_nm=100:200:-4"], "count = -4 is out of range"),
            (&["film.min_spacing_nm=100:100:3"], "the ends have to differ"),
            (&["stator.normal_amplitude_um=0:1:3:log"], "both ends have to be above 0"),
            (&["film.slip=0:1:3"], "film.slip: it accepts one of \"none\""),
            (&["film.gas=air:helium:2"], "has a range: give a list, such as film.gas=carbon-dioxide,hydrogen"),
            (&["film.slip=none"], "a list of two values or more"),
            (&["film.slip=none,second"], "film.slip"),
            (&["film.slip=none,none"], "none is listed twice"),
            (&["film.min_spacing_nm=100,0.1um"], "0.1um is listed twice"),
            (&["film.min_spacing_nm=100,3"], "film.min_spacing_nm = 3 is out of range"),
            (&["film.min_spacing=100:200:3"], "did you mean film.min_spacing_nm?"),
            (&["scene=1:2:3"], "scene cannot be changed"),
            (&["plate.length_mm=1:2:3"], "plate.length_mm belongs to scene = \"plate\""),
            (&["motor.waves=1.5:3:2"], "motor.waves = 1.5 is of the wrong type"),
            (&["stator.tooth_width_mm=2.95,3"], "stator.tooth_width_mm = 2.95 is out of range"),
            (&["motor.waves=1:4:2", "motor.waves=1:4:2"], "given twice"),
            (&[], "0 keys given"),
            (&["motor.load_per_wave_n=1:2:400", "film.min_spacing_nm=10:20:400"], "160000 points"),
        ] {
            let error = sweep("fundamental", vary).unwrap_err().to_string();
            assert!(error.contains(words), "{vary:?}: {error}");
        }
        // The window has no option --part.
        let many = sweep("fundamental", &["motor.load_per_wave_n=1:2:400", "film.min_spacing_nm=10:20:400"]);
        assert_eq!(many.unwrap_err().in_place(), "160000 points: allowed up to 100000");
    }

    #[test]
    fn words_and_numbers_are_listed_and_three_keys_make_a_grid() {
        let slip = sweep("fundamental", &["film.slip=first-order,fukui-kaneko"]).unwrap();
        assert_eq!((slip.len(), slip.axes()[0].text(1.0).as_str()), (2, "fukui-kaneko"));
        assert_eq!(slip.scene_at(1).unwrap().get("film.slip").unwrap().to_string(), "fukui-kaneko");
        // A temperature belongs to a gas; the preset names no gas, but every point of this sweep does.
        let gases = sweep("fundamental", &["film.temperature_c=0,50", "film.gas=air,helium"]).unwrap();
        assert_eq!(gases.scene_at(3).unwrap().get("film.temperature_c").unwrap().to_string(), "50");
        let spacing = sweep("fundamental", &["film.min_spacing_nm=300,100,200"]).unwrap();
        assert_eq!((&spacing.axes()[0].values[..], spacing.axes()[0].words.len()), (&[300.0, 100.0, 200.0][..], 0));
        // An optional key may be absent.
        let crown = sweep("fundamental", &["stator.tooth_radius_m=none,3"]).unwrap();
        let radius = |point: usize| crown.scene_at(point).unwrap().get("stator.tooth_radius_m");
        assert_eq!((radius(0), radius(1)), (None, Some(Value::Number(3.0))));
        assert_ne!(slip.fingerprint(), sweep("fundamental", &["film.slip=first-order,none"]).unwrap().fingerprint());
        let three = ["film.slip=none,first-order", "motor.waves=7:8:2", "film.min_spacing_nm=100:150:3"];
        let three = sweep("fundamental", &three).unwrap();
        assert_eq!((three.len(), three.values(10)), (12, vec![1.0, 8.0, 125.0]));
    }

    #[test]
    fn points_that_break_a_rule_between_keys_are_marked() {
        let sweep = sweep("fundamental", &["motor.waves=8:20:3"]).unwrap();
        let rows = sweep.run(&[], &Cancel::new(), &|_| ());
        let RunStatus::Failed(reason) = &rows[2].status else { panic!("{rows:?}") };
        assert!(reason.contains("stator.tooth_width_mm = 1.7353 is out of range"), "{reason}");
        assert_eq!((rows.len(), &rows[0].status), (3, &RunStatus::Converged));
        // A strip's forces are per metre, so they cannot be in one column with those of a plate.
        let strip = super::tests::sweep("plate-crossover", &["plate.width_mm=none,1"]).unwrap();
        let rows = strip.run(&[], &Cancel::new(), &|_| ());
        assert_eq!(
            rows[1].status,
            RunStatus::Failed("its forces are in N, those of the other points in N/m".to_owned())
        );
    }

    #[test]
    fn chunks_cover_every_point_once_and_stay_on_a_line() {
        let sweep = sweep("fundamental", &["motor.waves=1:3:3", "film.min_spacing_nm=100:150:6"]).unwrap();
        let chunks: Vec<Range<usize>> =
            SweepPart::WHOLE.chunks(sweep.axes()).map(|number| chunk(sweep.axes(), number)).collect();
        assert_eq!(chunks.iter().cloned().flatten().collect::<Vec<_>>(), (0..18).collect::<Vec<_>>());
        assert!(chunks.iter().all(|chunk| chunk.start / 6 == (chunk.end - 1) / 6));
        assert_eq!((sweep.values(0), sweep.values(7)), (vec![1.0, 100.0], vec![2.0, 110.0]));
    }

    #[test]
    fn what_a_plate_does_not_heed_is_not_varied() {
        let refused = |vary| sweep("plate-crossover", &[vary]).unwrap_err().to_string();
        assert!(refused("film.min_spacing_nm=100:200:3").starts_with("film.min_spacing_nm has no effect on a plate"));
        assert!(refused("numerics.contact_nodes=100:200:3").starts_with("numerics.contact_nodes has no effect"));
    }

    #[test]
    fn the_fingerprint_knows_scene_axes_and_settings() {
        let of = |preset, vary| sweep(preset, &[vary]).unwrap().fingerprint();
        let this = of("fundamental", "stator.frequency_khz=3:100:5");
        assert_eq!(this, of("fundamental", "stator.frequency_khz=3:100:5:lin"));
        assert_ne!(this, of("fundamental", "stator.frequency_khz=3:100:6"));
        assert_ne!(this, of("fundamental", "stator.frequency_khz=3:100:5:log"));
        assert_ne!(this, of("min-spacing-100nm", "stator.frequency_khz=3:100:5"));
    }

    #[test]
    fn published_points_are_those_in_the_plane_of_the_sweep() {
        let frequencies = |sweep: &Sweep| sweep.published().iter().map(|p| p.values[0]).collect::<Vec<_>>();
        let over = sweep("fundamental", &["stator.frequency_khz=3:100:5"]).unwrap();
        assert_eq!(frequencies(&over), [30.0, 30.0, 3.0, 20.0, 40.0, 60.0, 100.0]);
        assert_eq!(frequencies(&sweep("min-spacing-100nm", &["stator.frequency_khz=3:100:5"]).unwrap()), [30.0]);
        assert_eq!(frequencies(&sweep("fundamental", &["stator.frequency_khz=25:50:2"]).unwrap()), [30.0, 30.0, 40.0]);
        assert!(sweep("levitating", &["stator.frequency_khz=3:100:5"]).unwrap().published().is_empty());
        let crowned = sweep("fundamental", &["stator.tooth_radius_m=1:20:5"]).unwrap();
        assert_eq!(frequencies(&crowned), [3.0, 6.5, 10.0]);
        let both = sweep("fundamental", &["film.min_spacing_nm=50:400:3", "stator.frequency_khz=3:100:3"]).unwrap();
        assert_eq!(both.published().len(), 8);
        assert!(sweep("plate-viscous", &["plate.length_mm=1:2:3"]).unwrap().published().is_empty());
    }
}
