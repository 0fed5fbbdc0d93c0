//! The settings that are measured: accuracies, grids, and the paper's meshes.

use crate::fidelity::Fidelity;
use crate::problem::{Numerics, Problem, Scenario};
use crate::solve::{Method, Settings};
use crate::surface::Surface;
use serde::{Deserialize, Serialize};

/// Accuracies between the named ones, in millionths.
const BETWEEN: [u32; 3] = [10_000, 2_000, 500];
/// Grids in addition to the accuracies: the fidelity that each is based on, film nodes along and across, steps in a cycle.
const GRIDS: [(Fidelity, usize, usize, usize); 6] = [
    (Fidelity::Draft, 9, 5, 36),
    (Fidelity::Draft, 25, 17, 72),
    (Fidelity::Standard, 17, 9, 108),
    (Fidelity::Standard, 33, 25, 216),
    (Fidelity::Fine, 33, 17, 180),
    (Fidelity::Fine, 65, 33, 180),
];
/// Meshes of the paper's method: film nodes along and across, contact nodes. They are the paper's mesh, and meshes half and twice as fine.
const PAPER_MESHES: [(&str, usize, usize, usize); 3] =
    [("paper, half its mesh", 26, 6, 91), ("paper", 51, 11, 181), ("paper, twice its mesh", 101, 21, 361)];

/// The origin of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    /// A requested accuracy, by its name or as a number.
    Fidelity,
    /// A grid of its own.
    Grid,
    /// The paper's method.
    Paper,
}

/// One way to solve the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// Its name.
    pub name: String,
    /// Its origin.
    pub family: Family,
    /// Fidelity and method.
    pub settings: Settings,
    /// All numerics of the scene as it is solved: its own switches, and the grid of the setting.
    pub numerics: Numerics,
    /// The options of the command line that choose it, added to those that make the scene.
    pub options: String,
}

impl Candidate {
    /// A candidate for a scene with the numerics `scene`.
    pub fn new(name: String, family: Family, settings: Settings, numerics: Numerics, scene: &Numerics) -> Self {
        let mut options = match settings.method {
            Method::Auto => settings.fidelity.option(),
            Method::Paper => "--method paper".to_owned(),
        };
        let grid = |of: &Numerics| {
            [
                ("film_nodes_along", of.film_nodes_along.map(|count| count.to_string())),
                ("film_nodes_across", of.film_nodes_across.map(|count| count.to_string())),
                ("contact_nodes", of.contact_nodes.map(|count| count.to_string())),
                ("steps_per_cycle", of.steps_per_cycle.map(|count| count.to_string())),
                ("tolerance", of.tolerance.map(|change| change.to_string())),
            ]
        };
        for ((key, value), (_, present)) in grid(&numerics).into_iter().zip(grid(scene)) {
            if value != present {
                options.push_str(&format!(" --set numerics.{key}={}", value.as_deref().unwrap_or("none")));
            }
        }
        Self { name, family, settings, numerics, options }
    }
}

/// The scene's numerics without its grid: the switches of the model, which every candidate keeps, and the contact nodes, which our own
/// method ignores.
pub fn without_grid(numerics: &Numerics) -> Numerics {
    Numerics { film_nodes_along: None, film_nodes_across: None, steps_per_cycle: None, tolerance: None, ..*numerics }
}

/// Settings worth measuring for a scene: every fidelity and some accuracies between them, some grids, the scene's own if it has one,
/// and for a motor with a hard stop the paper's method on three meshes.
pub fn candidates(problem: &Problem) -> Vec<Candidate> {
    let (scene, free) = (&problem.numerics, without_grid(&problem.numerics));
    let auto = |fidelity| Settings { fidelity, ..Settings::default() };
    let mut accuracies: Vec<Fidelity> = Fidelity::ALL.into_iter().chain(BETWEEN.map(Fidelity::To)).collect();
    accuracies.sort_by(|a, b| b.accuracy().total_cmp(&a.accuracy()));
    let named = |fidelity: Fidelity| match fidelity {
        Fidelity::To(_) => format!("accuracy {fidelity}"),
        _ => fidelity.to_string(),
    };
    let mut all: Vec<Candidate> = accuracies
        .into_iter()
        .map(|fidelity| Candidate::new(named(fidelity), Family::Fidelity, auto(fidelity), free, scene))
        .collect();
    let nodes = |along, across| Numerics { film_nodes_along: Some(along), film_nodes_across: Some(across), ..free };
    for (fidelity, along, across, steps) in GRIDS {
        let numerics = Numerics { steps_per_cycle: Some(steps), ..nodes(along, across) };
        let name = format!("{fidelity}, {along} × {across} × {steps}");
        all.push(Candidate::new(name, Family::Grid, auto(fidelity), numerics, scene));
    }
    if *scene != free {
        let name = "the scene's own grid".to_owned();
        all.push(Candidate::new(name, Family::Grid, Settings::default(), *scene, scene));
    }
    if matches!(&problem.scenario, Scenario::Motor(motor) if motor.surface == Surface::default()) {
        for (name, along, across, contact) in PAPER_MESHES {
            let numerics = Numerics { contact_nodes: Some(contact), ..nodes(along, across) };
            let settings = Settings { method: Method::Paper, ..Settings::default() };
            all.push(Candidate::new(name.to_owned(), Family::Paper, settings, numerics, scene));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    #[test]
    fn plates_have_no_paper_and_a_grid_of_the_scene_is_measured_beside_others() {
        let problem = |preset: &str| Problem::try_from(&presets::find(preset).unwrap()).unwrap();
        assert!(candidates(&problem("plate-viscous")).iter().all(|candidate| candidate.family != Family::Paper));
        let own = candidates(&problem("doubled-mesh"));
        let options = |name: &str| own.iter().find(|candidate| candidate.name == name).unwrap().options.as_str();
        assert_eq!(options("the scene's own grid"), "--fidelity standard");
        assert_eq!(
            options("draft"),
            "--fidelity draft --set numerics.film_nodes_along=none --set numerics.film_nodes_across=none"
        );
        assert_eq!(options("accuracy 0.2%").split(" --set").next(), Some("--accuracy 0.2%"));
    }

    #[test]
    fn every_candidate_keeps_the_switches_of_the_model() {
        let mut scene = presets::find("fundamental").unwrap();
        scene.set_all([("numerics.flow", "along"), ("numerics.steps_per_cycle", "72")]).unwrap();
        let problem = Problem::try_from(&scene).unwrap();
        assert!(candidates(&problem).iter().all(|candidate| candidate.numerics.flow == problem.numerics.flow));
        assert!(candidates(&problem).iter().all(|candidate| !candidate.options.contains("flow")));
    }
}
