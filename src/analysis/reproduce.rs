//! Everything the paper shows and its text defines, solved twice: by the paper's algorithm on its own meshes, and converged.
//!
//! T. Maeno and D. B. Bogy, "Effect of the hydrodynamic bearing on rotor/stator contact in a ring-type ultrasonic motor",
//! IEEE Trans. UFFC 39 (1992): the 14 rows of Table I, the fields of Figs. 4, 6–9, 11 and 12, α over frequency of Fig. 10,
//! and two variations that the text speaks of without a number: no sliding, and a softer rotor. The paper's figures
//! themselves are not known to us, only its text and the table.

use super::attempt::attempt;
use crate::control::Cancel;
use crate::problem::{Numerics, Problem};
use crate::scene::table1::{PublishedRow, published};
use crate::scene::{Scene, SceneError, presets};
use crate::solution::{MotorResult, Outcome, Solution, Status};
use crate::solve::{Method, Record, Settings};
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// A figure of surfaces and pressures: its number, its preset, and what the paper calls it.
pub const FIELDS: [(u32, &str, &str); 7] = [
    (4, "fundamental", "the fundamental case"),
    (6, "min-spacing-100nm", "minimum air bearing spacing = 100 nm"),
    (7, "tooth-width-2.31mm", "tooth width = 2.31 mm"),
    (8, "rotor-width-0.6mm", "rotor spring width = 0.6 mm"),
    (9, "frequency-100khz", "stator vibrating frequency = 100 kHz"),
    (11, "tooth-radius-6.5m", "teeth radius = 6.5 m"),
    (12, "tooth-radius-3m", "teeth radius = 3 m"),
];

/// Frequencies of Fig. 10 \[kHz\]: first, last, and their number; they have equal ratios.
const FREQUENCIES: (f64, f64, usize) = (2.0, 120.0, 28);
/// Factor by which the softer rotor is more compliant.
pub const SOFTER: f64 = 1.2;

/// One scene, solved by both methods.
#[derive(Clone, Debug)]
pub struct Both {
    /// The scene, as converged: without meshes of its own.
    pub scene: Scene,
    /// The scene, checked and in SI units.
    pub problem: Problem,
    /// The result of the paper's algorithm on its own meshes, or why there is none.
    pub paper: Result<Solution, String>,
    /// The converged result, or why there is none.
    pub ours: Result<Solution, String>,
}

impl Both {
    /// The numbers of one of its solves.
    pub fn result(solved: &Result<Solution, String>) -> Option<&MotorResult> {
        solved.as_ref().ok()?.outcome.motor()
    }
}

/// A row of Table I by both methods.
#[derive(Clone, Debug)]
pub struct ReproducedRow {
    /// As published.
    pub published: PublishedRow,
    /// As computed here.
    pub both: Both,
}

/// α at a frequency, converged.
#[derive(Clone, Debug)]
pub struct FrequencyPoint {
    /// Frequency \[kHz\].
    pub frequency_khz: f64,
    /// The result, or why there is none.
    pub solved: Result<MotorResult, String>,
}

/// All results of the paper, computed again.
#[derive(Clone, Debug)]
pub struct Reproduction {
    /// The rows of Table I, in the paper's order.
    pub rows: Vec<ReproducedRow>,
    /// The fundamental case without sliding: the wedge term left out.
    pub no_sliding: Both,
    /// The fundamental case with a rotor [`SOFTER`] times as compliant.
    pub softer: Both,
    /// Fig. 10.
    pub frequencies: Vec<FrequencyPoint>,
    /// How the converged values were solved.
    pub settings: Settings,
}

impl Reproduction {
    /// The row of a preset.
    pub fn row(&self, preset: &str) -> Option<&ReproducedRow> {
        self.rows.iter().find(|row| row.published.preset == preset)
    }

    /// Number of solves that ended without a cycle that repeats.
    pub fn unsolved(&self) -> usize {
        let both = self.rows.iter().map(|row| &row.both).chain([&self.no_sliding, &self.softer]);
        let sound = |solved: &Result<Solution, String>| solved.as_ref().is_ok_and(|s| s.status == Status::Converged);
        let fields = both.flat_map(|both| [&both.paper, &both.ours]).filter(|solved| !sound(solved)).count();
        fields + self.frequencies.iter().filter(|point| point.solved.is_err()).count()
    }
}

/// How many solves there are.
pub fn number_of_solves() -> usize {
    2 * (published().len() + 2) + FREQUENCIES.2
}

/// Solves everything, several at a time on rayon's pool; the results do not depend on the number of threads. `finished` is called after
/// each solve, on any thread.
///
/// # Errors
/// None, because the built-in presets have none; a test reads them all.
pub fn reproduce(
    settings: &Settings,
    cancel: &Cancel,
    finished: &(dyn Fn(&str) + Sync),
) -> Result<Reproduction, SceneError> {
    let ours = Settings { method: Method::Auto, ..*settings };
    let paper = Settings { method: Method::Paper, ..*settings };
    let fundamental = presets::find("fundamental")?;
    let mut scenes = published().iter().map(|row| presets::find(&row.preset)).collect::<Result<Vec<_>, _>>()?;
    let no_sliding = fundamental.with([("film.shear", "false")])?;
    let softer = |key: &'static str| {
        let stiff = fundamental.get(key).and_then(|value| value.as_number()).unwrap_or(1.0);
        (key, (SOFTER * stiff).to_string())
    };
    let softer =
        fundamental.with(["rotor.point_compliance_um_per_n", "rotor.local_compliance_m2_per_n"].map(softer))?;
    scenes.extend([no_sliding.clone(), softer.clone()]);
    // What is solved, by which method, and what of the result is kept.
    let mut work: Vec<(Problem, Settings)> = Vec::new();
    for scene in &mut scenes {
        let shown = FIELDS.iter().any(|(_, preset, _)| presets::find(preset).as_ref() == Ok(&*scene));
        let record = if shown { Record::Everything } else { Record::Numbers };
        work.push((Problem::try_from(&*scene)?, Settings { record, ..paper }));
        scene.set_numerics(&Numerics::default())?;
        work.push((Problem::try_from(&*scene)?, Settings { record, ..ours }));
    }
    let mut frequencies = Vec::new();
    let (from, to, count) = FREQUENCIES;
    for i in 0..count {
        let frequency: f64 = from * (to / from).powf(i as f64 / (count - 1) as f64);
        let scene = fundamental.with([("stator.frequency_khz", frequency.to_string())])?;
        frequencies.push(frequency);
        work.push((Problem::try_from(&scene)?, Settings { record: Record::Numbers, ..ours }));
    }

    // The longest solves come first, and each free thread takes the next one, so that the pool is busy to the end.
    let mut order: Vec<_> = work.iter().enumerate().collect();
    let nodes = |problem: &Problem| problem.numerics.film_nodes_along.unwrap_or(0);
    order.sort_by_key(|(_, (problem, settings))| (settings.method == Method::Auto, Reverse(nodes(problem))));
    let solve = |(i, (problem, settings)): (usize, &(Problem, Settings))| {
        let result = attempt(problem, settings, &mut (), cancel);
        finished(&problem.name);
        (i, result)
    };
    let solved: BTreeMap<usize, _> = order.into_iter().par_bridge().map(solve).collect();
    let mut solved = solved.into_values();
    let mut next = || solved.next().unwrap_or_else(|| Err("not solved".to_owned()));

    // The results come in the order in which the solves were listed.
    let mut pair = |scene: Scene| -> Result<Both, SceneError> {
        let (paper, ours) = (next(), next());
        Ok(Both { problem: Problem::try_from(&scene)?, scene, paper, ours })
    };
    let row = |(published, scene)| Ok(ReproducedRow { published, both: pair(scene)? });
    let rows = published().into_iter().zip(scenes).map(row).collect::<Result<Vec<_>, SceneError>>()?;
    let (no_sliding, softer) = (pair(no_sliding)?, pair(softer)?);
    let point = |frequency_khz| {
        let solved = next().and_then(|solution| match (solution.status, solution.outcome) {
            (Status::Converged, Outcome::Motor(result)) => Ok(result),
            _ => Err("not converged".to_owned()),
        });
        FrequencyPoint { frequency_khz, solved }
    };
    let frequencies = frequencies.into_iter().map(point).collect();
    Ok(Reproduction { rows, no_sliding, softer, frequencies, settings: ours })
}
