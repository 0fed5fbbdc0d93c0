//! The numbers of the paper's tables and figures as JSON and CSV.

use super::statements::statements;
use crate::analysis::reproduce::{Both, Point, Reproduction, Row};
use crate::export::estimates::{self, finite};
use serde::Serialize;
use serde_json::{Value, json};

/// A row of Table I. What was not computed is null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RowObject {
    /// Name of the row.
    pub row: String,
    /// The built-in preset.
    pub preset: String,
    /// Film load as published \[N\].
    pub published_load_n: f64,
    /// α as published.
    pub published_alpha: f64,
    /// Film load by the paper's algorithm on its own meshes \[N\].
    pub paper_load_n: Option<f64>,
    /// α by it.
    pub paper_alpha: Option<f64>,
    /// Its estimated error, absolute.
    pub paper_alpha_error: Option<f64>,
    /// By how much that load exceeds the published one \[%\].
    pub paper_difference_percent: Option<f64>,
    /// Film load, converged \[N\].
    pub film_load_n: Option<f64>,
    /// α, converged.
    pub alpha: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub alpha_error: Option<f64>,
    /// By how much that load exceeds the published one \[%\].
    pub difference_percent: Option<f64>,
}

impl RowObject {
    /// The object of a row.
    pub fn new(row: &Row) -> Self {
        let (paper, ours) = (Both::result(&row.both.paper), Both::result(&row.both.ours));
        let published = &row.published;
        let difference = |load: f64| 100.0 * (load / published.published_load_n - 1.0);
        Self {
            row: published.row.clone(),
            preset: published.preset.clone(),
            published_load_n: published.published_load_n,
            published_alpha: published.published_alpha,
            paper_load_n: paper.and_then(|r| finite(r.film_load.value)),
            paper_alpha: paper.and_then(|r| finite(r.alpha.value)),
            paper_alpha_error: paper.and_then(|r| finite(r.alpha.error)),
            paper_difference_percent: paper.and_then(|r| finite(difference(r.film_load.value))),
            film_load_n: ours.and_then(|r| finite(r.film_load.value)),
            alpha: ours.and_then(|r| finite(r.alpha.value)),
            alpha_error: ours.and_then(|r| finite(r.alpha.error)),
            difference_percent: ours.and_then(|r| finite(difference(r.film_load.value))),
        }
    }
}

/// The object of `--json`: Table I, Fig. 10, what the text says and what came of it, and how many solves did not converge. What was not
/// computed is null.
pub fn object(all: &Reproduction) -> Value {
    json!({
        "fidelity": all.settings.fidelity.to_string(),
        "table1": all.rows.iter().map(RowObject::new).collect::<Vec<_>>(),
        "fig10": all.frequencies.iter().map(point).collect::<Vec<_>>(),
        "statements": statements(all),
        "unsolved": all.unsolved(),
    })
}

/// A point of Fig. 10: α with its estimated numerical error, converged.
fn point(point: &Point) -> Value {
    let mut object = json!({ "frequency_khz": point.frequency_khz });
    estimates::add(&mut object, "alpha", "", point.solved.as_ref().ok().map(|result| result.alpha));
    object
}
