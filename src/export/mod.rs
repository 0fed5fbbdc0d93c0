//! A solution as numbers for people, as JSON, as CSV files, as figures and animations, and into a folder all at once.

pub mod animation;
pub mod csv;
pub mod digits;
pub mod figure;
pub mod figures;
pub mod folder;
pub mod json;
pub mod table1;
