//! What must never panic, whatever the bytes: a preset file, and `--set` strings. Shared by `tests/mutations.rs` and by the
//! targets in `fuzz/`.

use squeezefilm::control::{Cancel, Progress};
use squeezefilm::fidelity::Fidelity;
use squeezefilm::plan::Plan;
use squeezefilm::problem::{Motor, Problem, RotorCompliance, Scenario};
use squeezefilm::scene::{Scene, SceneError};
use squeezefilm::solution::Outcome;
use squeezefilm::solve::{Settings, solve};

/// Rounds of a solve before it is cancelled.
const ROUNDS: usize = 4;
/// Film unknowns × steps of a cycle beyond which a scene is not solved: it would be no other problem, but a longer one.
const LARGEST: usize = 100_000;

/// Reads `bytes` as a preset file. `solved`: goes on to a solve if it is a scene.
pub(crate) fn preset(bytes: &[u8], solved: bool) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    // Which file that is would be left to chance.
    if text.contains("csv") {
        return false;
    }
    try_on(Scene::from_toml(text, "fuzzed.toml"), solved)
}

/// Reads each line of `bytes` as the KEY=VALUE of a `--set`, for a motor and for a plate.
pub(crate) fn set(bytes: &[u8], solved: bool) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    if text.contains("csv") {
        return false;
    }
    let pairs = || text.lines().map(|line| line.split_once('=').unwrap_or((line, "")));
    let mut any = false;
    for base in [Scene::motor(), Scene::plate()] {
        let mut scene = base.clone();
        for (key, value) in pairs() {
            let _ = scene.set(key, value).map_err(|error| error.to_string());
        }
        any |= try_on(scene.check().map(|()| scene), solved);
        let mut scene = base;
        any |= try_on(scene.set_all(pairs()).map(|()| scene), solved);
    }
    any
}

/// A scene, or why it is none, as far as it goes; whether it is a problem that can be solved.
fn try_on(scene: Result<Scene, SceneError>, solved: bool) -> bool {
    let scene = match scene {
        Ok(scene) => scene,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return false;
        }
    };
    let problem = match Problem::try_from(&scene) {
        Ok(problem) => problem,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return false;
        }
    };
    let plan = match &problem.scenario {
        // A ring takes its time.
        Scenario::Motor(Motor { rotor: RotorCompliance::Ring(_), .. }) if !solved => return true,
        Scenario::Motor(motor) => match Plan::motor(motor, Fidelity::Draft, &problem.numerics) {
            Ok(plan) => plan,
            Err(error) => {
                assert!(!error.to_string().is_empty());
                return true;
            }
        },
        Scenario::Plate(plate) => Plan::plate(plate, Fidelity::Draft, &problem.numerics),
    };
    let size = plan.grids.iter().map(|grid| grid.along * (grid.across + 1) * grid.steps).sum::<usize>();
    let size =
        size * if let (Scenario::Motor(motor), true) = (&problem.scenario, plan.every_tooth) { motor.teeth } else { 1 };
    // (One interval on the coarsest grid leaves nothing to solve along a tooth: tests/extremes.rs.)
    let nothing = matches!(problem.scenario, Scenario::Motor(_)) && plan.grids.iter().any(|grid| grid.along < 2);
    if solved && size <= LARGEST && !nothing {
        solve_a_little(&problem);
    }
    true
}

fn solve_a_little(problem: &Problem) {
    let cancel = Cancel::new();
    let flag = cancel.clone();
    let mut rounds = 0;
    let mut watch = |_: &Progress| {
        rounds += 1;
        if rounds == ROUNDS {
            flag.cancel();
        }
    };
    let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
    if let Ok(solution) = solve(problem, &settings, &mut watch, &cancel) {
        let load = match solution.outcome {
            Outcome::Motor(result) => result.alpha.value,
            Outcome::Plate(result) => result.film_load.value,
        };
        assert!(load.is_finite(), "{load} after {rounds} rounds of {problem:?}");
    }
}
