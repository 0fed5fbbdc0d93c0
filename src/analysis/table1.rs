//! Table I of Maeno and Bogy (1992), row by row, with published and computed values.
//!
//! With [`Method::Paper`] the rows are computed at the paper's own meshes. With [`Method::Auto`] they are
//! mesh-converged: a row's `[numerics]` table is dropped, so that `doubled-mesh` is then the fundamental case again.

use super::compare::{ComparedRun, each};
use crate::control::Cancel;
use crate::problem::{Numerics, Problem};
use crate::scene::table1::{PublishedRow, published};
use crate::scene::{Scene, SceneError, presets};
use crate::solution::MotorResult;
use crate::solve::{Method, Settings};

/// One row: the published values, and the computed ones.
#[derive(Clone, Debug)]
pub struct Table1Row {
    /// As published.
    pub published: PublishedRow,
    /// As computed, or why not.
    pub run: ComparedRun,
}

impl Table1Row {
    /// The numbers; `None` if it was not computed.
    pub fn result(&self) -> Option<&MotorResult> {
        self.run.solved.as_ref().ok()?.outcome.motor()
    }

    /// By how much the computed film load exceeds the published one \[%\].
    pub fn difference_percent(&self) -> Option<f64> {
        Some(self.published.difference_percent(self.result()?.film_load))
    }
}

/// Solves the 14 rows, several at a time (on rayon's pool), in the paper's order. `changes` are applied to every row's scene as by `--set`;
/// `finished` is called after each run, on any thread.
///
/// # Errors
/// Errors in `changes`, before anything is solved. A row that fails is a [`Table1Row`] that says so.
pub fn rows(
    changes: &[(String, String)],
    settings: &Settings,
    cancel: &Cancel,
    finished: &(dyn Fn(&ComparedRun) + Sync),
) -> Result<Vec<Table1Row>, SceneError> {
    let posed = |row: &PublishedRow| {
        let scene = scene_of(row, settings.method)?.with(changes)?;
        Ok((Problem::try_from(&scene)?, scene))
    };
    let (problems, scenes): (Vec<_>, Vec<_>) =
        published().iter().map(posed).collect::<Result<Vec<_>, SceneError>>()?.into_iter().unzip();
    let runs = each(&scenes, problems, settings, cancel, finished);
    Ok(published().into_iter().zip(runs).map(|(published, run)| Table1Row { published, run }).collect())
}

/// The scene of a row; with [`Method::Auto`] without its `[numerics]` table.
pub(super) fn scene_of(row: &PublishedRow, method: Method) -> Result<Scene, SceneError> {
    let mut scene = presets::find(&row.preset)?;
    if method == Method::Auto {
        scene.set_numerics(&Numerics::default())?;
    }
    Ok(scene)
}

/// Rows whose scene is `scene` except for `keys`, with their values of these keys. The descriptions and meshes of the rows are ignored,
/// because a published value stands for the model.
pub fn published_at(scene: &Scene, keys: &[&str]) -> Vec<Published> {
    let mut points = Vec::new();
    for row in published() {
        let Ok(theirs) = presets::find(&row.preset) else { continue };
        let values: Option<Vec<f64>> = keys.iter().map(|key| theirs.get(key)?.as_number()).collect();
        let Some(values) = values else { continue };
        let ours = scene.with_numbers(keys.iter().copied().zip(values.iter().copied()));
        if ours.is_ok_and(|ours| ours.same_model(&theirs)) {
            points.push(Published {
                row: row.row,
                values,
                film_load: row.published_load_n,
                alpha: row.published_alpha,
            });
        }
    }
    points
}

/// A published value, and its position on some keys.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Published {
    /// Name of the row.
    pub row: String,
    /// The value of each key there, in its unit.
    pub values: Vec<f64>,
    /// Film load as published \[N\].
    #[serde(rename = "film_load_n")]
    pub film_load: f64,
    /// α as published.
    pub alpha: f64,
}
