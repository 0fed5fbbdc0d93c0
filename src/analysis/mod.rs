//! Analyses built on solves: parameter sweeps, error against time, maps of where a method fails, published results beside computed ones,
//! and explanations of the numbers in words.
//!
//! They return plain data and use no files and no terminal; where time is measured, the caller passes the clock.

pub mod attempt;
pub mod compare;
pub mod data_sheet;
pub mod decision;
pub mod error;
pub mod exact;
pub mod fit;
pub mod quantity;
pub mod regime;
pub mod reproduce;
pub mod rotor;
pub mod sensitivity;
pub mod stability;
pub mod surface;
pub mod sweep;
pub mod table1;
pub mod torque;
pub mod tradeoff;
pub mod validity;
pub mod variation;
