//! Presets with changes, which the tests of the solver solve.
#![allow(dead_code, reason = "no file of tests uses all of it")]

use squeezefilm::problem::{Motor, Plate, Problem};
use squeezefilm::scene::{Scene, presets};

/// The built-in preset of this name, with these keys changed.
pub(crate) fn scene(preset: &str, changes: &[(&str, &str)]) -> Scene {
    presets::find(preset).unwrap().with(changes).unwrap()
}

/// The problem of such a scene.
pub(crate) fn problem(preset: &str, changes: &[(&str, &str)]) -> Problem {
    Problem::try_from(&scene(preset, changes)).unwrap()
}

/// The motor of such a scene.
pub(crate) fn motor(preset: &str, changes: &[(&str, &str)]) -> Motor {
    problem(preset, changes).scenario.motor().unwrap().clone()
}

/// The plate of such a scene.
pub(crate) fn plate(preset: &str, changes: &[(&str, &str)]) -> Plate {
    problem(preset, changes).scenario.plate().unwrap().clone()
}
