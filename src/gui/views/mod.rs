//! Views: each draws one run at one phase of the cycle.

pub mod motor;
pub mod plate;
