//! What is over everything else: questions, the sheet of shortcuts, the tour, the glossary.

pub mod frame;
pub mod glossary;
pub mod question;
pub mod shortcuts;
pub mod tour;
