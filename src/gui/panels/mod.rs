//! Panels: each is a function that reads state and pushes commands.

pub mod convergence;
pub mod field;
pub mod hint;
pub mod labels;
pub mod menu;
pub mod model;
pub mod parameters;
pub mod results;
pub mod sheet;
pub mod timeline;
