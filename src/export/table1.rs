//! Table I as JSON objects and as a CSV file, with the same names.

use super::estimates::finite;
use super::json::status_name;
use crate::analysis::table1::Row;
use crate::solve::{Method, Settings};
use serde::Serialize;

/// One row. What was not computed, or is not finite, is null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Object {
    /// Name of the row.
    pub row: String,
    /// The built-in preset.
    pub preset: String,
    /// What differs from the fundamental case.
    pub change: String,
    /// Film load as published \[N\].
    pub published_load_n: f64,
    /// Film load as computed \[N\].
    pub film_load_n: Option<f64>,
    /// Estimated numerical error of `film_load_n`, absolute \[N\].
    pub film_load_error_n: Option<f64>,
    /// α as published.
    pub published_alpha: f64,
    /// α as computed.
    pub alpha: Option<f64>,
    /// Estimated numerical error of `alpha`, absolute.
    pub alpha_error: Option<f64>,
    /// By how much the computed film load exceeds the published one \[%\].
    pub difference_percent: Option<f64>,
    /// The cycle repeats to the tolerance.
    pub converged: bool,
    /// `converged`, `not converged`, `cancelled`, or `failed: …`.
    pub status: String,
    /// `auto` or `paper`.
    pub method: &'static str,
    /// `draft`, `standard`, …; of method paper null.
    pub fidelity: Option<String>,
}

impl Object {
    /// The object of a row.
    pub fn new(row: &Row, settings: &Settings) -> Self {
        let published = row.published.clone();
        let computed = row.computed.as_ref().ok();
        Self {
            row: published.row,
            preset: published.preset,
            change: published.change,
            published_load_n: published.published_load_n,
            film_load_n: computed.and_then(|computed| finite(computed.result.film_load.value)),
            film_load_error_n: computed.and_then(|computed| finite(computed.result.film_load.error)),
            published_alpha: published.published_alpha,
            alpha: computed.and_then(|computed| finite(computed.result.alpha.value)),
            alpha_error: computed.and_then(|computed| finite(computed.result.alpha.error)),
            difference_percent: row.difference_percent().and_then(finite),
            converged: row.converged(),
            status: match &row.computed {
                Ok(computed) => status_name(&computed.status).to_owned(),
                Err(error) => format!("failed: {error}"),
            },
            method: settings.method.name(),
            fidelity: (settings.method == Method::Auto).then(|| settings.fidelity.to_string()),
        }
    }
}
