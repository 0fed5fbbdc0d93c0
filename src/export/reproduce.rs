//! The paper's tables and figures: published numbers beside those of its own algorithm and the converged ones, as JSON, CSV, sentences,
//! figures, and one report.

mod figures;
mod report;
mod statements;

pub use figures::figures;
pub use report::report;
pub use statements::{Statement, statements};

use crate::analysis::reproduce::{Both, FrequencyPoint, ReproducedRow, Reproduction};
use serde_json::{Value, json};

/// A row of Table I as published, by the paper's algorithm on its own meshes, and converged; differences are those of the film loads.
/// Numbers that were not computed are null.
pub fn row_object(row: &ReproducedRow) -> Value {
    let (paper, ours) = (Both::result(&row.both.paper), Both::result(&row.both.ours));
    let published = &row.published;
    json!({
        "row": published.row,
        "preset": published.preset,
        "published_load_n": published.published_load_n,
        "published_alpha": published.published_alpha,
        "paper_load_n": paper.map(|result| result.film_load.value),
        "paper_alpha": paper.map(|result| result.alpha.value),
        "paper_alpha_error": paper.map(|result| result.alpha.error),
        "paper_difference_percent": paper.map(|result| published.difference_percent(result.film_load)),
        "film_load_n": ours.map(|result| result.film_load.value),
        "alpha": ours.map(|result| result.alpha.value),
        "alpha_error": ours.map(|result| result.alpha.error),
        "difference_percent": ours.map(|result| published.difference_percent(result.film_load)),
    })
}

/// The object of `--json`: Table I, Fig. 10, the statements of the text with the computed numbers, and how many solves did not converge.
/// Numbers that were not computed are null.
pub fn object(all: &Reproduction) -> Value {
    json!({
        "fidelity": all.settings.fidelity.to_string(),
        "table1": all.rows.iter().map(row_object).collect::<Vec<_>>(),
        "fig10": all.frequencies.iter().map(point).collect::<Vec<_>>(),
        "statements": statements(all),
        "unsolved": all.unsolved(),
    })
}

/// A point of Fig. 10: α with its estimated numerical error, converged.
fn point(point: &FrequencyPoint) -> Value {
    let mut object = json!({ "frequency_khz": point.frequency_khz });
    super::estimates::add(&mut object, "alpha", "", point.solved.as_ref().ok().map(|result| result.alpha));
    object
}
