//! Panels: each is a function that reads state and pushes commands.

pub mod parameters;
pub mod results;
