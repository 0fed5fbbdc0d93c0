//! Where a method solves and where it does not: maps over a motor's parameters, up to the ends of their ranges.
//!
//! Each cell of a map is one scene, solved by itself and judged by the status that the solver reports and by whether its numbers are
//! physically possible. Cells are solved on rayon's pool, and the results do not depend on the number of threads.

use super::attempt::attempt;
use super::quantity::Numbers;
use super::sweep::spaced;
use crate::control::{Cancel, Progress};
use crate::estimate::Estimate;
use crate::problem::{Motor, Problem};
use crate::recording::Recording;
use crate::scene::{Parameter, ParameterKind, Range, Scale, Scene, SceneError};
use crate::solution::{MotorResult, Solution, Status};
use crate::solve::{Method, Settings};
use rayon::prelude::*;

/// A plane through the parameters of a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map {
    /// Its name on the command line and in files.
    pub name: &'static str,
    /// The keys along x and y. Each runs over its whole range, by equal ratios.
    pub axes: [&'static str; 2],
}

const SPACING: &str = "film.min_spacing_nm";
const NODES: &str = "numerics.film_nodes_along";
const STEPS: &str = "numerics.steps_per_cycle";
/// The upper end of the map for a key, if it is not the end of the range: a finer grid is not a different problem, but takes longer.
fn up_to(key: &str) -> Option<f64> {
    match key {
        STEPS => Some(720.0),
        NODES => Some(201.0),
        _ => None,
    }
}

/// For a range from zero, by equal ratios: the first value is zero, the next is this many decades below the upper end.
const DECADES_FROM_ZERO: i32 = 3;

/// The maps.
pub const MAPS: [Map; 5] = [
    Map { name: "spacing-frequency", axes: [SPACING, "stator.frequency_khz"] },
    Map { name: "load-amplitude", axes: ["motor.load_per_wave_n", "stator.normal_amplitude_um"] },
    Map { name: "pressure-width", axes: ["film.ambient_pressure_kpa", "rotor.contact_width_mm"] },
    Map { name: "steps-spacing", axes: [STEPS, SPACING] },
    Map { name: "grid-tooth", axes: [NODES, "stator.tooth_width_mm"] },
];

impl Map {
    /// The map with this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        MAPS.iter().find(|map| map.name == name)
    }

    /// The scene with the keys of the axes in place of alternative keys, such as the load on the whole ring.
    fn scene(&self, scene: &Scene) -> Result<Scene, SceneError> {
        let mut scene = scene.clone();
        for key in self.axes {
            if let Some(usual) = Parameter::find(key).and_then(Parameter::usual) {
                scene.set_value(key, usual)?;
            }
        }
        Ok(scene)
    }

    /// Why there is no such map for `scene`: the error for a key of its axes that the scene does not have.
    pub fn fault(&self, scene: &Scene) -> Option<SceneError> {
        self.scene(scene).err()
    }

    /// The values of one axis (0: x, 1: y): `count` of them, over the range that `scene` allows for the key. There are fewer for a key of
    /// whole numbers with a short range, and none if the scene has no such map.
    pub fn values(&self, axis: usize, scene: &Scene, count: usize) -> Vec<f64> {
        let key = self.axes[axis];
        let range = self.scene(scene).ok().and_then(|scene| scene.range(key));
        let Some(Range { min, max }) = range else { return Vec::new() };
        let max = up_to(key).unwrap_or(max).min(max);
        let spaced = |min: f64, count: usize| spaced(min, max, count, Scale::Log);
        let mut values = if min <= 0.0 {
            [vec![min], spaced(max * 10f64.powi(-DECADES_FROM_ZERO), count.saturating_sub(1))].concat()
        } else {
            spaced(min, count)
        };
        if matches!(Parameter::find(key).map(|p| p.kind), Some(ParameterKind::Whole { .. })) {
            values.iter_mut().for_each(|value| *value = value.round());
            values.dedup();
        }
        values
    }

    /// Keys and values of the scene of a cell. The other meshes are scaled with the nodes along a tooth.
    fn changes(&self, values: [f64; 2]) -> Vec<(&'static str, f64)> {
        let mut changes = vec![(self.axes[0], values[0]), (self.axes[1], values[1])];
        if self.axes[0] == NODES {
            let intervals = values[0] - 1.0;
            changes.push(("numerics.film_nodes_across", (2.0 * (0.1 * intervals).round()).max(2.0) + 1.0));
            changes.push(("numerics.contact_nodes", (3.6 * intervals).round().max(18.0) + 1.0));
        }
        changes
    }
}

/// Outcome of a cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Converged, with physically possible numbers.
    Solved,
    /// A limit was reached first, as the solver reports.
    NotConverged,
    /// Converged, with physically impossible numbers.
    NonPhysical,
    /// There is no solution, and why.
    Failed(String),
    /// The scene is not allowed, and why.
    Refused(String),
}

impl Verdict {
    /// Its name, without a reason.
    pub fn name(&self) -> &'static str {
        VERDICTS[self.number()]
    }

    /// Its place in [`VERDICTS`].
    pub fn number(&self) -> usize {
        match self {
            Self::Solved => 0,
            Self::NotConverged => 1,
            Self::NonPhysical => 2,
            Self::Failed(_) => 3,
            Self::Refused(_) => 4,
        }
    }
}

/// The names of all verdicts.
pub const VERDICTS: [&str; 5] = ["solved", "not converged", "non-physical", "failed", "refused"];

/// Relative difference between lengths or forces that counts as round-off.
const ROUND_OFF: f64 = 1e-9;
/// Tolerance of a share of the load, in addition to its stated error: the effect of any film is larger.
const SHARE: f64 = 1e-6;
/// Allowed difference at an instant between the load and the sum of film and contact, as a share of the load, in addition to the stated
/// error.
const BALANCE: f64 = 2e-3;

/// What is physically impossible in a motor's solution, in words.
fn violations(motor: &Motor, result: &MotorResult, recording: &Recording) -> Vec<String> {
    let numbers = [
        ("α", result.alpha.value),
        ("the error of α", result.alpha.error),
        ("the film load", result.film_load.value),
        ("the contact load", result.contact_load.value),
        ("the torque", result.max_torque.value),
        ("the least film thickness", result.min_film_thickness.value),
        ("the highest pressure", result.max_pressure.value),
    ];
    let wrong = numbers.into_iter().filter(|(_, value)| !value.is_finite());
    let mut violations: Vec<_> = wrong.map(|(name, _)| format!("{name} is not a finite number")).collect();
    let Estimate { value: alpha, error } = result.alpha;
    if alpha < -error - SHARE || alpha > 1.0 + error + SHARE {
        violations.push(format!("α = {alpha:.4} ± {error:.1e} is outside 0 … 1"));
    }
    // One NaN makes the least value NaN, which fails every comparison.
    let least =
        |values: &[f64]| values.iter().copied().fold(f64::INFINITY, |a, b| if a.is_nan() || b >= a { a } else { b });
    let pressure = least(&recording.pressure);
    if pressure <= 0.0 || pressure.is_nan() {
        violations.push(format!("the pressure falls to {pressure:.2e} Pa"));
    }
    let thickness = least(&[least(&recording.film_thickness), result.min_film_thickness.value]);
    let spacing = motor.least_thickness();
    if thickness < spacing * (1.0 - ROUND_OFF) || thickness.is_nan() {
        violations.push(format!("the film is {thickness:.3e} m thin, with a minimum spacing of {spacing:.3e} m"));
    }
    let contact = least(&recording.contact);
    if contact < -ROUND_OFF * motor.load / motor.wavelength() || contact.is_nan() {
        violations.push(format!("the contact pulls with {contact:.2e} N/m"));
    }
    let missed = recording
        .film_load
        .iter()
        .zip(&recording.contact_load)
        .map(|(film, contact)| ((film + contact) / motor.load - 1.0).abs())
        .fold(0.0, |a: f64, b| if a.is_nan() || b <= a { a } else { b });
    if missed > error + BALANCE || missed.is_nan() {
        violations.push(format!("film and contact together are off the load by {missed:.2e} of it"));
    }
    violations
}

/// The verdict on a solve, and what is physically impossible in its numbers.
fn judge(motor: &Motor, solved: &Result<Solution, String>) -> (Verdict, Vec<String>) {
    let solution = match solved {
        Err(reason) => return (Verdict::Failed(reason.clone()), Vec::new()),
        Ok(solution) => solution,
    };
    // A solver returns the kind of result that belongs to the scene.
    let found = solution.outcome.motor().map(|result| violations(motor, result, &solution.recording));
    let violations = found.unwrap_or_default();
    let verdict = match solution.status {
        Status::NotConverged { .. } | Status::Cancelled => Verdict::NotConverged,
        // `NotResolved`: the error is as large as the result, but the numbers are physical.
        Status::Converged | Status::NotResolved { .. } if violations.is_empty() => Verdict::Solved,
        Status::Converged | Status::NotResolved { .. } => Verdict::NonPhysical,
    };
    (verdict, violations)
}

/// One cell of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The map.
    pub map: &'static Map,
    /// How it was solved.
    pub method: Method,
    /// Its place: the index along x, and along y.
    pub place: [usize; 2],
    /// Keys and values that make its scene, those of the axes first.
    pub changes: Vec<(&'static str, f64)>,
    /// Verdict on its solve.
    pub verdict: Verdict,
    /// What is physically impossible in its numbers, in words.
    pub violations: Vec<String>,
    /// Its numbers; none if it failed or was refused.
    pub numbers: Numbers,
}

impl Cell {
    /// The options of the command line that solve this cell alone.
    pub fn options(&self) -> String {
        let mut options: Vec<String> = self.changes.iter().map(|(key, value)| format!("--set {key}={value}")).collect();
        if self.method == Method::Paper {
            options.push("--method paper".to_owned());
        }
        options.join(" ")
    }
}

/// Number of cycles after which the paper's method is stopped on its own mesh. On a finer mesh it is stopped after fewer, for the same
/// work, but not before [`FEWEST_CYCLES`]. The method's own limit of 200 cycles takes minutes if its rounds do not converge.
const PAPER_CYCLES: usize = 60;
const PAPER_WORK: usize = 51 * 11 * 180 * PAPER_CYCLES;
const FEWEST_CYCLES: usize = 30;
/// If a cycle still changes by more than this after so many cycles, the rounds will not converge.
const ASTRAY: (usize, f64) = (12, 0.1);

/// Solves cells, several at a time on rayon's pool, and returns them in their order; if it is cancelled, without the cells that were not
/// reached. `finished` is called after each cell, on any thread. A cell that fails has the reason in its verdict.
pub fn survey(
    scene: &Scene,
    cells: Vec<Cell>,
    settings: &Settings,
    cancel: &Cancel,
    finished: &(dyn Fn(&Cell) + Sync),
) -> Vec<Cell> {
    // Each thread takes one cell at a time, because some cells take a thousand times as long as others.
    let solved = cells.into_par_iter().with_max_len(1).map(|cell| {
        let cell = solve_cell(scene, cell, settings, cancel)?;
        finished(&cell);
        Some(cell)
    });
    solved.collect::<Vec<_>>().into_iter().flatten().collect()
}

/// The cells of maps of `scene`, `count` along each axis, for each method, not solved yet. They are in the order of maps, methods, y and x.
pub fn cells(scene: &Scene, maps: &[&'static Map], methods: &[Method], count: usize) -> Vec<Cell> {
    let mut cells = Vec::new();
    for map in maps {
        let (along, up) = (map.values(0, scene, count), map.values(1, scene, count));
        for method in methods {
            for (j, y) in up.iter().enumerate() {
                for (i, x) in along.iter().enumerate() {
                    cells.push(Cell {
                        map,
                        method: *method,
                        place: [i, j],
                        changes: map.changes([*x, *y]),
                        verdict: Verdict::Refused(String::new()),
                        violations: Vec::new(),
                        numbers: Numbers::default(),
                    });
                }
            }
        }
    }
    cells
}

/// Solves one cell; `None` if it was cancelled.
fn solve_cell(scene: &Scene, mut cell: Cell, settings: &Settings, cancel: &Cancel) -> Option<Cell> {
    if cancel.is_cancelled() {
        return None;
    }
    let problem = match changed(scene, &cell.changes) {
        Ok(problem) => problem,
        Err(error) => {
            cell.verdict = Verdict::Refused(error.to_string());
            return Some(cell);
        }
    };
    // The keys of a map are those of a motor.
    let motor = problem.scenario.motor()?;
    let cycles = most_cycles(&problem);
    let stop = Cancel::new();
    let mut watch = |progress: &Progress| {
        let astray = progress.iteration >= ASTRAY.0 && progress.residual > ASTRAY.1;
        let over = cell.method == Method::Paper && (astray || progress.iteration >= cycles);
        if over || cancel.is_cancelled() {
            stop.cancel();
        }
    };
    let settings = Settings { method: cell.method, ..*settings };
    let solved = attempt(&problem, &settings, &mut watch, &stop);
    if cancel.is_cancelled() {
        return None;
    }
    (cell.verdict, cell.violations) = judge(motor, &solved);
    if let Ok(solution) = &solved {
        cell.numbers = Numbers::of(&problem, solution);
    }
    Some(cell)
}

fn changed(scene: &Scene, changes: &[(&str, f64)]) -> Result<Problem, SceneError> {
    Problem::try_from(&scene.with_numbers(changes.iter().copied())?)
}

fn most_cycles(problem: &Problem) -> usize {
    let numerics = &problem.numerics;
    let work = numerics.film_nodes_along.unwrap_or(51)
        * numerics.film_nodes_across.unwrap_or(11)
        * numerics.steps_per_cycle.unwrap_or(180);
    (PAPER_WORK / work.max(1)).clamp(FEWEST_CYCLES, 2 * PAPER_CYCLES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Scenario;
    use crate::recording::LineLoads;
    use crate::scene::presets;
    use crate::solution::{Model, Outcome, Stats};

    fn motor() -> Motor {
        let Scenario::Motor(motor) = Problem::try_from(&Scene::motor()).unwrap().scenario else { unreachable!() };
        motor
    }

    /// A valid solution with one change to it.
    fn solution(change: impl FnOnce(&mut Solution, &mut MotorResult)) -> Result<Solution, String> {
        let mut result = MotorResult {
            alpha: Estimate { value: 0.25, error: 1e-3 },
            film_load: Estimate::exact(0.6125),
            contact_load: Estimate::exact(1.8375),
            max_torque: Estimate::exact(0.26),
            min_film_thickness: Estimate::exact(2e-7),
            max_pressure: Estimate::exact(5e5),
            ..MotorResult::default()
        };
        let recording = Recording {
            lines: LineLoads { film_thickness: vec![2e-7, 1e-6], contact: vec![0.0, 100.0], ..LineLoads::default() },
            pressure: vec![1e5, 5e5],
            film_load: vec![0.6, 0.625],
            contact_load: vec![1.85, 1.825],
            ..Recording::default()
        };
        let mut solution = Solution {
            status: Status::Converged,
            outcome: Outcome::Motor(result),
            performance: None,
            harmonic: None,
            stats: Stats::default(),
            accuracy: Default::default(),
            model: Model::default(),
            warnings: Vec::new(),
            recording,
        };
        change(&mut solution, &mut result);
        solution.outcome = Outcome::Motor(result);
        Ok(solution)
    }

    #[test]
    fn outcomes_are_judged() {
        let motor = motor();
        let limit = Status::NotConverged { residual: 1e-2, tolerance: 1e-6 };
        let verdict = |solved| judge(&motor, &solved);
        assert_eq!(verdict(solution(|_, _| ())), (Verdict::Solved, vec![]));
        assert_eq!(verdict(solution(|s, _| s.status = limit)).0, Verdict::NotConverged);
        assert_eq!(verdict(solution(|s, _| s.status = Status::Cancelled)).0, Verdict::NotConverged);
        assert_eq!(verdict(Err("no".to_owned())), (Verdict::Failed("no".to_owned()), vec![]));
        // A share may be out of range by less than its error.
        assert_eq!(verdict(solution(|_, r| r.alpha.value = 1.0005)).0, Verdict::Solved);
        type Change = fn(&mut Solution, &mut MotorResult);
        let [thin, thinner] = ["1.000e-7", "0.000e0"]
            .map(|film| format!("the film is {film} m thin, with a minimum spacing of 2.000e-7 m"));
        let wrong: [(Change, &str); 10] = [
            (|_, r| r.alpha.value = 1.2, "α = 1.2000 ± 1.0e-3 is outside 0 … 1"),
            (|_, r| r.alpha.value = -0.2, "α = -0.2000 ± 1.0e-3 is outside 0 … 1"),
            (|_, r| r.max_torque.value = f64::NAN, "the torque is not a finite number"),
            (|_, r| r.alpha.error = f64::INFINITY, "the error of α is not a finite number"),
            (|s, _| s.recording.pressure[1] = -3.0, "the pressure falls to -3.00e0 Pa"),
            (|s, _| s.recording.pressure[0] = f64::NAN, "the pressure falls to NaN Pa"),
            (|s, _| s.recording.film_thickness[1] = 1e-7, &thin),
            (|_, r| r.min_film_thickness.value = 0.0, &thinner),
            (|s, _| s.recording.contact[0] = -1.0, "the contact pulls with -1.00e0 N/m"),
            (|s, _| s.recording.contact_load[1] = 4.275, "film and contact together are off the load by 1.00e0 of it"),
        ];
        for (change, expected) in wrong {
            assert_eq!(verdict(solution(change)), (Verdict::NonPhysical, vec![expected.to_owned()]));
        }
    }

    #[test]
    fn maps_reach_the_edges_of_the_ranges_and_every_cell_is_a_scene() {
        let scene = Scene::motor();
        for map in &MAPS {
            for axis in 0..2 {
                let (values, range) = (map.values(axis, &scene, 5), scene.range(map.axes[axis]).unwrap());
                let last = up_to(map.axes[axis]).unwrap_or(range.max);
                assert_eq!((values.first(), values.last()), (Some(&range.min), Some(&last)), "{}", map.name);
                assert!(values.windows(2).all(|pair| pair[0] < pair[1]) && values.len() == 5);
            }
            for cell in cells(&scene, &[map], &[Method::Auto], 4) {
                assert!(changed(&scene, &cell.changes).is_ok(), "{}", cell.options());
            }
        }
        assert_eq!(cells(&scene, &[&MAPS[0], &MAPS[4]], &[Method::Auto, Method::Paper], 3).len(), 36);
    }

    #[test]
    fn a_map_varies_its_key_in_place_of_another_form_and_says_what_the_scene_does_not_have() {
        let plain = Scene::motor().with([("film.gas", "air")]).unwrap();
        let forms = [("motor.load_n", "20"), ("film.altitude_m", "1000"), ("stator.tooth_share", "0.5")];
        let scene = plain.with(forms).unwrap();
        for map in &MAPS {
            assert_eq!(map.fault(&scene), None, "{}", map.name);
            for axis in 0..2 {
                assert_eq!(map.values(axis, &scene, 4), map.values(axis, &plain, 4), "{}", map.name);
            }
            let cells = cells(&scene, &[map], &[Method::Auto], 3);
            assert_eq!(cells.len(), 9, "{}", map.name);
            for cell in cells {
                assert!(changed(&scene, &cell.changes).is_ok(), "{}", cell.options());
            }
        }
        let rough = presets::find("asperities").unwrap();
        let faults = MAPS.map(|map| map.fault(&rough).map(|fault| fault.to_string()));
        assert_eq!(faults.each_ref().map(Option::is_some), [true, false, false, true, false], "{faults:?}");
        assert!(faults.iter().flatten().all(|fault| fault.starts_with("film.min_spacing_nm belongs to")), "{faults:?}");
        assert!(cells(&rough, &[&MAPS[0]], &[Method::Auto], 3).is_empty());
    }
}
