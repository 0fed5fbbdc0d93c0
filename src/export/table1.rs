//! Table I as JSON objects and as a CSV file, with the same names.

use super::compare::status;
use crate::analysis::table1::Row;
use crate::solve::{Method, Settings};
use serde_json::{Value, json};

/// A row. Errors are estimated numerical ones, absolute; a difference is that of the film loads. What was not computed, or is not finite, is null.
pub fn object(row: &Row, settings: &Settings) -> Value {
    let published = &row.published;
    let result = row.result();
    json!({
        "row": published.row,
        "preset": published.preset,
        "change": published.change,
        "published_load_n": published.published_load_n,
        "film_load_n": result.map(|result| result.film_load.value),
        "film_load_error_n": result.map(|result| result.film_load.error),
        "published_alpha": published.published_alpha,
        "alpha": result.map(|result| result.alpha.value),
        "alpha_error": result.map(|result| result.alpha.error),
        "difference_percent": row.difference_percent(),
        "converged": row.run.converged(),
        "status": status(&row.run),
        "method": settings.method.name(),
        // The paper's method has none.
        "fidelity": (settings.method == Method::Auto).then(|| settings.fidelity.to_string()),
    })
}
