//! The window: an explorer that answers while the slider moves.
//!
//! `app` drains the solver's events and carries out commands; panels and views only read state, draw, and push commands.
//! The solver is reached through [`crate::job`] alone; the window's thread never solves.

pub mod command;
pub mod panels;
pub mod state;
pub mod theme;
pub mod views;
