//! Overlays: questions, the sheet of shortcuts, the tour, the glossary.

pub mod frame;
pub mod glossary;
mod new_motor;
pub mod question;
pub mod shortcuts;
pub mod tour;
