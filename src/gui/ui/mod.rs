//! The drawing code: it reads the state and pushes commands, and changes nothing.

pub mod cache;
pub mod chart;
pub mod context;
pub mod fidelity;
pub mod form;
pub mod formula;
pub mod glossary;
pub mod highlight;
pub mod hint;
pub mod keys;
pub mod layout;
pub mod modals;
pub mod paint;
pub mod panels;
pub mod parts;
pub mod plot;
pub mod rich;
pub mod tabs;
pub mod taps;
pub mod theme;
pub mod views;
