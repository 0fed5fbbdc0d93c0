//! One scene over values of one key, of two or of three: numbers only, no fields are kept.
//!
//! The points of a sweep are solved on rayon's pool, a chunk of neighbours at a time. Chunks follow from the points
//! alone, so that the results do not depend on the number of threads, to the last bit, and each equals a single solve of
//! its scene. A point that fails or does not converge says so in its row, and the others go on.
//!
//! A cancelled sweep keeps the rows it has; handed to [`Sweep::run`] again, it goes on with what is missing, and ends
//! as one that was never cancelled. [`Sweep::fingerprint`] tells whether rows on disk are of the same sweep.

use super::attempt::attempt_from;
use super::quantity::{Numbers, Quantity, force_unit};
use super::table1::{Published, published_at};
use crate::control::Cancel;
use crate::motor::Warm;
use crate::problem::Problem;
use crate::scene::{Parameter, ParameterKind, Scale, Scene, SceneError, Value};
use crate::solution::Status;
use crate::solve::{Method, Record, Settings, SolveError, check};
use rayon::prelude::*;
use std::ops::Range;
use std::str::FromStr;

/// Most values of one key.
pub const MOST_VALUES: usize = 10_000;
/// Most points of a sweep.
pub const MOST_POINTS: usize = 100_000;
/// Most keys that are varied at once.
pub const MOST_KEYS: usize = 3;
/// Neighbours along the last axis that one thread solves one after the other.
const CHUNK: usize = 4;

/// What to vary: `key=from:to:count`, `key=from:to:count:log` or `key=value,value,…`.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// Dotted key, as in `--set`.
    pub key: String,
    /// Its values.
    pub values: Values,
}

/// The values of a key that is varied.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers from one end to the other.
    Range {
        /// First value, in the unit of the key.
        from: f64,
        /// Last value, in the unit of the key.
        to: f64,
        /// How many values, both ends counted.
        count: usize,
        /// Equal steps or equal ratios.
        scale: Scale,
    },
    /// Each as in `--set`.
    List(Vec<String>),
}

impl FromStr for Vary {
    type Err = SweepError;

    fn from_str(text: &str) -> Result<Self, SweepError> {
        let syntax = || SweepError::Syntax { found: text.to_owned() };
        let (key, values) = text.split_once('=').ok_or_else(syntax)?;
        let key = key.trim().to_owned();
        if !values.contains(':') {
            return Ok(Self {
                key,
                values: Values::List(values.split(',').map(|word| word.trim().to_owned()).collect()),
            });
        }
        let parts: Vec<&str> = values.split(':').map(str::trim).collect();
        let (ends, scale) = match parts[..] {
            [from, to, count] | [from, to, count, "lin"] => ([from, to, count], Scale::Linear),
            [from, to, count, "log"] => ([from, to, count], Scale::Log),
            _ => return Err(syntax()),
        };
        let number = |text: &str| text.parse::<f64>().map_err(|_| syntax());
        let (from, to) = (number(ends[0])?, number(ends[1])?);
        let count = ends[2].parse().map_err(|_| SweepError::Count { key: key.clone(), found: ends[2].to_owned() })?;
        Ok(Self { key, values: Values::Range { from, to, count, scale } })
    }
}

/// One axis of a sweep: a key and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The key.
    pub parameter: &'static Parameter,
    /// Its values in the unit of the key, in the order they were asked for; of words their places in `words`.
    pub values: Vec<f64>,
    /// The values if they are not all numbers, as in `--set`; otherwise empty.
    pub words: Vec<String>,
    /// Equal steps or equal ratios.
    pub scale: Scale,
}

impl Axis {
    /// Checks what is to be varied against the scene, and spaces its values. The keys are not yet checked together.
    ///
    /// # Errors
    /// [`SweepError`], which names the key, the value and what is allowed.
    pub fn new(scene: &Scene, vary: &Vary) -> Result<Self, SweepError> {
        let key = &vary.key;
        let parameter = match Parameter::find(key) {
            Some(parameter) => parameter,
            // Setting it tells what is wrong with it.
            None => {
                return match scene.clone().set(key, "0") {
                    Err(error) => Err(error.into()),
                    Ok(()) => Err(SweepError::Syntax { found: key.clone() }),
                };
            }
        };
        let count = match &vary.values {
            Values::Range { count, .. } => *count,
            Values::List(words) => words.len(),
        };
        let allowed = (2..=MOST_VALUES).contains(&count);
        match &vary.values {
            Values::List(words) => {
                for (i, word) in words.iter().enumerate() {
                    scene.clone().set(key, word)?;
                    if words[..i].contains(word) {
                        return Err(SweepError::Repeated { key: key.clone(), value: word.clone() });
                    }
                }
                if !allowed {
                    return Err(SweepError::Syntax { found: format!("{key}={}", words.join(",")) });
                }
                let numbers: Result<Vec<f64>, _> = words.iter().map(|word| word.parse()).collect();
                Ok(match numbers {
                    Ok(values) => Self { parameter, values, words: Vec::new(), scale: Scale::Linear },
                    Err(_) => {
                        let values = (0..count).map(|place| place as f64).collect();
                        Self { parameter, values, words: words.clone(), scale: Scale::Linear }
                    }
                })
            }
            Values::Range { from, to, scale, .. } => {
                let whole = match parameter.kind {
                    ParameterKind::Number { .. } => false,
                    ParameterKind::Whole { .. } => true,
                    _ => return Err(SweepError::NotANumber { parameter }),
                };
                for end in [from, to] {
                    scene.clone().set_value(key, Value::Number(*end))?;
                }
                if !allowed {
                    return Err(SweepError::Count { key: key.clone(), found: count.to_string() });
                }
                if from == to {
                    return Err(SweepError::Nothing { key: key.clone(), at: *from });
                }
                if *scale == Scale::Log && (*from <= 0.0 || *to <= 0.0) {
                    return Err(SweepError::Log { key: key.clone(), from: *from, to: *to });
                }
                let mut values = spaced(*from, *to, count, *scale);
                if whole {
                    values.iter_mut().for_each(|value| *value = value.round());
                    values.dedup();
                }
                Ok(Self { parameter, values, words: Vec::new(), scale: *scale })
            }
        }
    }

    /// A value as it is written in `--set`.
    pub fn text(&self, value: f64) -> String {
        self.words.get(value as usize).cloned().unwrap_or_else(|| value.to_string())
    }
}

/// What cannot be swept. Found before anything is solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// Not of the form asked for.
    #[error(
        "vary {found}: expected key=from:to:count or key=from:to:count:log, as in film.min_spacing_nm=50:400:8:log, or a list of two \
         values or more, as in film.slip=none,first-order"
    )]
    Syntax {
        /// What was given.
        found: String,
    },
    /// Too few values, or too many.
    #[error("vary {key}: count = {found} is out of range: allowed 2 to {MOST_VALUES}")]
    Count {
        /// The key.
        key: String,
        /// The count given.
        found: String,
    },
    /// Both ends are the same.
    #[error("vary {key}: from {at} to {at} is no range: the ends have to differ")]
    Nothing {
        /// The key.
        key: String,
        /// Both ends.
        at: f64,
    },
    /// Equal ratios from or to zero or below.
    #[error("vary {key}: from {from} to {to} cannot be spaced by equal ratios: for :log both ends have to be above 0")]
    Log {
        /// The key.
        key: String,
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
    },
    /// A key whose values are not numbers.
    #[error("vary {}: it accepts {}, and only a number has a range; list its values, divided by commas", parameter.key, parameter.accepts())]
    NotANumber {
        /// The key.
        parameter: &'static Parameter,
    },
    /// A list with the same value twice.
    #[error("vary {key}: {value} is listed twice")]
    Repeated {
        /// The key.
        key: String,
        /// The value.
        value: String,
    },
    /// No axis, or more than [`MOST_KEYS`].
    #[error("vary: {found} keys given: allowed 1 to {MOST_KEYS}")]
    Axes {
        /// How many.
        found: usize,
    },
    /// Two axes with one key.
    #[error("vary {key}: given twice: the keys have to differ")]
    Twice {
        /// The key.
        key: String,
    },
    /// More points than anyone waits for.
    #[error("vary: {found} points: allowed up to {MOST_POINTS}")]
    Points {
        /// How many.
        found: usize,
    },
    /// A value outside its range, or a key that does not exist.
    #[error("{0}")]
    Scene(#[from] SceneError),
    /// A method that does not apply, or more memory than is allowed.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// How a point ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The cycle repeats to the tolerance.
    Converged,
    /// A limit was reached first; the numbers are what was reached.
    NotConverged,
    /// There is no solution, and why.
    Failed(String),
}

/// One point of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Which point, from 0; the last axis varies fastest.
    pub point: usize,
    /// The value of each axis there.
    pub values: Vec<f64>,
    /// How it ended.
    pub ending: Ending,
    /// The numbers; none if it failed.
    pub numbers: Numbers,
}

/// A sweep, checked: at least one of its points is a scene that can be solved.
#[derive(Clone, Debug)]
pub struct Sweep {
    scene: Scene,
    settings: Settings,
    axes: Vec<Axis>,
    points: Vec<Point>,
    /// The first point that can be solved.
    first: Problem,
}

/// The value of each axis, and what is to be solved there, or why nothing can be.
#[derive(Clone, Debug)]
struct Point {
    values: Vec<f64>,
    problem: Result<Problem, String>,
}

impl Sweep {
    /// A sweep of `scene` over one key, two or three. A key of whole numbers takes the nearest ones, each once. Points that break
    /// a rule between keys become rows that say so.
    ///
    /// # Errors
    /// [`SweepError`], which names the key, the value and what is allowed; if no point can be solved, that of the first.
    pub fn new(scene: &Scene, vary: &[Vary], settings: &Settings) -> Result<Self, SweepError> {
        if !(1..=MOST_KEYS).contains(&vary.len()) {
            return Err(SweepError::Axes { found: vary.len() });
        }
        let axes = vary.iter().map(|vary| Axis::new(scene, vary)).collect::<Result<Vec<_>, _>>()?;
        for (i, axis) in axes.iter().enumerate() {
            if axes[..i].iter().any(|other| other.parameter.key == axis.parameter.key) {
                return Err(SweepError::Twice { key: axis.parameter.key.to_owned() });
            }
        }
        let count = axes.iter().fold(1_usize, |count, axis| count.saturating_mul(axis.values.len()));
        if count > MOST_POINTS {
            return Err(SweepError::Points { found: count });
        }
        let numbers = Settings { record: Record::Numbers, ..*settings };
        let solvable = |values: &[f64]| -> Result<Problem, SweepError> {
            let problem = Problem::new(&varied(scene, &axes, values)?)?;
            check(&problem, &numbers)?;
            Ok(problem)
        };
        let values = (0..count).map(|point| values_at(&axes, point));
        let mut all: Vec<_> = values.map(|values| (solvable(&values), values)).collect();
        let Some(first) = all.iter().find_map(|(problem, _)| problem.as_ref().ok()).cloned() else {
            return Err(all.swap_remove(0).0.err().unwrap_or(SweepError::Axes { found: 0 }));
        };
        let unit = force_unit(&first);
        let points = all.into_iter().map(|(problem, values)| {
            let problem = match problem {
                Ok(problem) if force_unit(&problem) != unit => {
                    Err(format!("its forces are in {}, those of the other points in {unit}", force_unit(&problem)))
                }
                problem => problem.map_err(|error| error.to_string()),
            };
            Point { values, problem }
        });
        Ok(Self { scene: scene.clone(), settings: *settings, points: points.collect(), axes, first })
    }

    /// The axes; the last varies fastest.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The scene that is varied.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How it is solved.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The problem of the first point that can be solved: all are of one kind.
    pub fn problem(&self) -> &Problem {
        &self.first
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Never: a sweep has points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The value of each axis at a point.
    pub fn values(&self, point: usize) -> &[f64] {
        &self.points[point].values
    }

    /// The scene of a point, for solving it alone.
    ///
    /// # Errors
    /// The point breaks a rule between keys.
    pub fn scene_at(&self, point: usize) -> Result<Scene, SceneError> {
        varied(&self.scene, &self.axes, self.values(point))
    }

    /// The quantities its rows have.
    pub fn quantities(&self) -> Vec<Quantity> {
        Quantity::of(self.problem()).collect()
    }

    /// Sixteen digits that differ if anything differs that the results depend on: scene, axes, settings or version.
    pub fn fingerprint(&self) -> String {
        let mut hash = Fnv::default();
        hash.text(env!("CARGO_PKG_VERSION"));
        hash.text(&self.scene.to_toml());
        hash.text(self.settings.method.name());
        // The paper's method has no fidelity.
        hash.text(&if self.settings.method == Method::Auto {
            self.settings.fidelity.to_string()
        } else {
            String::new()
        });
        hash.text(&CHUNK.to_string());
        for axis in &self.axes {
            hash.text(axis.parameter.key);
            axis.values.iter().for_each(|value| hash.bytes(&value.to_bits().to_le_bytes()));
            axis.words.iter().for_each(|word| hash.text(word));
        }
        format!("{:016x}", hash.0)
    }

    /// Published points of Table I whose scene is one of this sweep's but for the keys that are varied, at any value of
    /// those.
    pub fn published(&self) -> Vec<Published> {
        if self.axes.iter().any(|axis| !axis.words.is_empty()) {
            return Vec::new();
        }
        let keys: Vec<&str> = self.axes.iter().map(|axis| axis.parameter.key).collect();
        published_at(&self.scene, &keys)
    }

    /// Solves every point that is not in `done`, several at a time on rayon's pool, and returns all rows there are, those
    /// in `done` included, in the order of the points: if it was cancelled, fewer than [`Sweep::len`]. `finished` is
    /// told of each new row, from whichever thread.
    pub fn run(&self, done: &[Row], cancel: &Cancel, finished: &(dyn Fn(&Row) + Sync)) -> Vec<Row> {
        let mut rows: Vec<Option<Row>> = vec![None; self.len()];
        for row in done {
            if let Some(place) = rows.get_mut(row.point) {
                *place = Some(row.clone());
            }
        }
        let solved: Vec<Vec<Row>> = self
            .chunks()
            .into_par_iter()
            .map(|chunk| {
                if rows[chunk.clone()].iter().all(Option::is_some) {
                    return Vec::new();
                }
                self.solve_chunk(chunk, cancel, &|row| {
                    if rows[row.point].is_none() {
                        finished(row);
                    }
                })
            })
            .collect();
        for row in solved.into_iter().flatten() {
            let place = row.point;
            rows[place] = Some(row);
        }
        rows.into_iter().flatten().collect()
    }

    /// The points in runs of neighbours along the last axis, none across its end.
    fn chunks(&self) -> Vec<Range<usize>> {
        let line = self.axes.last().map_or(1, |axis| axis.values.len());
        let mut chunks = Vec::new();
        for start in (0..self.len()).step_by(line.max(1)) {
            for from in (start..start + line).step_by(CHUNK) {
                chunks.push(from..(from + CHUNK).min(start + line));
            }
        }
        chunks
    }

    /// Solves the points of a chunk one after the other; ends early if cancelled.
    ///
    /// The first point of a chunk starts cold, the others from their neighbour: fewer rounds, the same result to a fraction
    /// of its stated error. A chunk that was cut short is solved again from its first point, so that neither threads nor
    /// a cancelled run change a result.
    fn solve_chunk(&self, chunk: Range<usize>, cancel: &Cancel, finished: &dyn Fn(&Row)) -> Vec<Row> {
        let mut rows = Vec::new();
        let mut warm = Warm::default();
        let settings = Settings { record: Record::Numbers, ..self.settings };
        for point in chunk {
            if cancel.is_cancelled() {
                break;
            }
            let Point { values, problem } = &self.points[point];
            let solved = problem
                .as_ref()
                .map_err(Clone::clone)
                .and_then(|problem| Ok((problem, attempt_from(&mut warm, problem, &settings, &mut (), cancel)?)));
            let (ending, numbers) = match solved {
                Ok((problem, solution)) => {
                    let ending = match solution.status {
                        Status::Converged => Ending::Converged,
                        Status::NotConverged { .. } | Status::NotResolved { .. } => Ending::NotConverged,
                        Status::Cancelled => break,
                    };
                    (ending, Numbers::of(problem, &solution))
                }
                Err(reason) => (Ending::Failed(reason), Numbers::default()),
            };
            let row = Row { point, values: values.clone(), ending, numbers };
            finished(&row);
            rows.push(row);
        }
        rows
    }
}

/// `count` values from `from` to `to`, both exact; those between to ten digits, so that they can be written down.
pub fn spaced(from: f64, to: f64, count: usize, scale: Scale) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1);
    let value = |i: usize| {
        let share = i as f64 / last as f64;
        match (i, scale) {
            (0, _) => from,
            (i, _) if i == last => to,
            (_, Scale::Linear) => short(from * (1.0 - share) + to * share),
            (_, Scale::Log) => short((from.ln() * (1.0 - share) + to.ln() * share).exp()),
        }
    };
    (0..count).map(value).collect()
}

fn short(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
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

/// The scene with the varied keys at these values.
fn varied(scene: &Scene, axes: &[Axis], values: &[f64]) -> Result<Scene, SceneError> {
    let mut scene = scene.clone();
    let texts: Vec<String> = axes.iter().zip(values).map(|(axis, value)| axis.text(*value)).collect();
    scene.set_all(axes.iter().zip(&texts).map(|(axis, text)| (axis.parameter.key, text.as_str())))?;
    Ok(scene)
}

/// Sixteen digits that differ if one of the texts does.
pub fn digest<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    let mut hash = Fnv::default();
    texts.into_iter().for_each(|text| hash.text(text));
    format!("{:016x}", hash.0)
}

/// The hash FNV-1a of 64 bits: the same on every machine and in every version of the compiler.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
        // Ends the text, as no byte of UTF-8 is this.
        self.bytes(&[0xff]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fidelity::Fidelity;
    use crate::scene::presets;

    fn sweep(preset: &str, vary: &[&str]) -> Result<Sweep, SweepError> {
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
    }

    #[test]
    fn what_cannot_be_swept_is_told() {
        for (vary, words) in [
            (&["film.min_spacing_nm"][..], "expected key=from:to:count"),
            (&["film.min_spacing_nm=1:2"], "expected key=from:to:count"),
            (&["film.min_spacing_nm=100:x:3"], "expected key=from:to:count"),
            (&["film.min_spacing_nm=100:200:3:cubic"], "expected key=from:to:count"),
            (&["film.min_spacing_nm=3:200:3"], "film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm"),
            (&["film.min_spacing_nm=100:NaN:3"], "film.min_spacing_nm = NaN is not finite"),
            (&["film.min_spacing_nm=100:200:1"], "count = 1 is out of range: allowed 2 to 10000"),
            (&["film.min_spacing_nm=100:200:-4"], "count = -4 is out of range"),
            (&["film.min_spacing_nm=100:100:3"], "the ends have to differ"),
            (&["stator.normal_amplitude_um=0:1:3:log"], "both ends have to be above 0"),
            (&["film.slip=0:1:3"], "film.slip: it accepts one of \"none\""),
            (&["film.slip=none"], "a list of two values or more"),
            (&["film.slip=none,second"], "film.slip"),
            (&["film.slip=none,none"], "none is listed twice"),
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
    }

    #[test]
    fn words_and_numbers_are_listed_and_three_keys_make_a_grid() {
        let slip = sweep("fundamental", &["film.slip=first-order,fukui-kaneko"]).unwrap();
        assert_eq!((slip.len(), slip.axes()[0].text(1.0).as_str()), (2, "fukui-kaneko"));
        assert_eq!(slip.scene_at(1).unwrap().get("film.slip").unwrap().to_string(), "fukui-kaneko");
        let spacing = sweep("fundamental", &["film.min_spacing_nm=300,100,200"]).unwrap();
        assert_eq!((&spacing.axes()[0].values[..], spacing.axes()[0].words.len()), (&[300.0, 100.0, 200.0][..], 0));
        // An optional key may be absent.
        let crown = sweep("fundamental", &["stator.tooth_radius_m=none,3"]).unwrap();
        let radius = |point: usize| crown.scene_at(point).unwrap().get("stator.tooth_radius_m");
        assert_eq!((radius(0), radius(1)), (None, Some(Value::Number(3.0))));
        assert_ne!(slip.fingerprint(), sweep("fundamental", &["film.slip=first-order,none"]).unwrap().fingerprint());
        let three = ["film.slip=none,first-order", "motor.waves=7:8:2", "film.min_spacing_nm=100:150:3"];
        let three = sweep("fundamental", &three).unwrap();
        assert_eq!((three.len(), three.values(10)), (12, &[1.0, 8.0, 125.0][..]));
    }

    #[test]
    fn points_that_break_a_rule_between_keys_are_marked() {
        let sweep = sweep("fundamental", &["motor.waves=8:20:3"]).unwrap();
        let rows = sweep.run(&[], &Cancel::new(), &|_| ());
        let Ending::Failed(reason) = &rows[2].ending else { panic!("{rows:?}") };
        assert!(reason.contains("stator.tooth_width_mm = 1.7353 is out of range"), "{reason}");
        assert_eq!((rows.len(), &rows[0].ending), (3, &Ending::Converged));
        // A strip's forces are per metre: they do not stand in one column with those of a plate.
        let strip = super::tests::sweep("plate-crossover", &["plate.width_mm=none,1"]).unwrap();
        let rows = strip.run(&[], &Cancel::new(), &|_| ());
        assert_eq!(rows[1].ending, Ending::Failed("its forces are in N, those of the other points in N/m".to_owned()));
    }

    #[test]
    fn chunks_cover_every_point_once_and_stay_on_a_line() {
        let sweep = sweep("fundamental", &["motor.waves=1:3:3", "film.min_spacing_nm=100:150:6"]).unwrap();
        let chunks = sweep.chunks();
        assert_eq!(chunks.iter().cloned().flatten().collect::<Vec<_>>(), (0..18).collect::<Vec<_>>());
        assert!(chunks.iter().all(|chunk| chunk.start / 6 == (chunk.end - 1) / 6));
        assert_eq!((sweep.values(0), sweep.values(7)), (&[1.0, 100.0][..], &[2.0, 110.0][..]));
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
        assert!(sweep("levitating", &["stator.frequency_khz=3:100:5"]).unwrap().published().is_empty());
        let crowned = sweep("fundamental", &["stator.tooth_radius_m=1:20:5"]).unwrap();
        assert_eq!(frequencies(&crowned), [3.0, 6.5, 10.0]);
        let both = sweep("fundamental", &["film.min_spacing_nm=50:400:3", "stator.frequency_khz=3:100:3"]).unwrap();
        assert_eq!(both.published().len(), 8);
        assert!(sweep("plate-viscous", &["plate.length_mm=1:2:3"]).unwrap().published().is_empty());
    }
}
