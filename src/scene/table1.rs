//! Table I of Maeno and Bogy (1992): what the paper published, row by row.

use crate::estimate::Estimate;
use serde::Deserialize;

/// The rows as a CSV file, `row,change,published_load_n,published_alpha`.
pub const TABLE1_CSV: &str = include_str!("../../assets/table1.csv");

/// One row of the published table.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PublishedRow {
    /// Name of the row: `tooth_width_1.16mm`.
    pub row: String,
    /// The built-in preset of the row, `tooth-width-1.16mm`. It is not in the file, because it follows from the name of the row.
    #[serde(skip)]
    pub preset: String,
    /// Difference from the fundamental case: a key and its value, `stator.tooth_width_mm=1.157`, or words; empty in the first row.
    pub change: String,
    /// The film's load on one wavelength \[N\], mean over the cycle.
    pub published_load_n: f64,
    /// Ratio of the film's load to the axial load, α.
    pub published_alpha: f64,
}

impl PublishedRow {
    /// By how much a film load exceeds the published one \[%\].
    pub fn difference_percent(&self, film_load: Estimate) -> f64 {
        100.0 * (film_load.value / self.published_load_n - 1.0)
    }
}

/// The 14 rows, in the paper's order.
pub fn published() -> Vec<PublishedRow> {
    let mut reader = csv::Reader::from_reader(TABLE1_CSV.as_bytes());
    // The file is part of the program, and a test counts its rows: none is dropped here.
    let rows = reader.deserialize::<PublishedRow>().filter_map(Result::ok);
    rows.map(|row| PublishedRow { preset: row.row.replace('_', "-"), ..row }).collect()
}
