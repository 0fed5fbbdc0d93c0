//! What is done with solves: published results beside computed ones, and what the numbers mean in words.

pub mod regime;
pub mod table1;
