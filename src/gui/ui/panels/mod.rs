//! The panels around the middle of the window.

pub mod exports;
pub mod field;
pub mod held;
pub mod lesson;
mod lesson_numbers;
mod lesson_parts;
pub mod menu;
pub mod model;
pub mod parameters;
pub mod records;
pub mod results;
pub mod timeline;
