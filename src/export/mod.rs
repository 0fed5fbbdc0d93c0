//! Results out of the program: the objects of `--json`, the tables and figures of `--out`, and how files get into a folder.

pub mod csv;
pub mod digits;
pub mod figure;
pub mod folder;
pub mod json;
pub mod stability;
pub mod sweep;
pub mod table1;
pub mod tradeoff;
