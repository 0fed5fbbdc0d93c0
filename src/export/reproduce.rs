//! The paper's tables and figures: published numbers beside those of its own algorithm and the converged ones, as JSON and CSV, in
//! sentences, as figures, and as one report.

mod figures;
mod objects;
mod report;
mod statements;

pub use figures::figures;
pub use objects::{object, row_object};
pub use report::report;
pub use statements::{Statement, statements};
