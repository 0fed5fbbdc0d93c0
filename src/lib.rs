//! Squeezed air films in ultrasonic motors.
//!
//! Between the vibrating teeth of a ring-type ultrasonic motor and its rotor a film of air is squeezed tens of thousands
//! of times a second. It carries part of the axial load, the share α, and takes that much friction away. This crate
//! solves the gas film, the elastic rotor and their unilateral contact together, for the periodic steady state.
//!
//! ```
//! use squeezefilm::control::Cancel;
//! use squeezefilm::fidelity::Fidelity;
//! use squeezefilm::problem::Problem;
//! use squeezefilm::scene::presets;
//! use squeezefilm::solution::{Outcome, Status};
//! use squeezefilm::solve::{Settings, solve};
//!
//! let problem = Problem::try_from(&presets::find("fundamental")?)?;
//! let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
//! let solution = solve(&problem, &settings, &mut (), &Cancel::new())?;
//!
//! assert_eq!(solution.status, Status::Converged);
//! let Outcome::Motor(result) = solution.outcome else { unreachable!("the preset is a motor") };
//! assert!((0.24..0.25).contains(&result.alpha.value));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The solver is a crate of its own, `squeezefilm-solver`, whose modules are here under the same names. The layout of the code is described in
//! `ARCHITECTURE.md`, the equations with their derivation are in `docs/theory.md`, measured errors in `docs/validation.md`.

pub mod analysis;
pub mod atomic;
pub mod citation;
pub mod cli;
pub mod export;
#[cfg(feature = "gui")]
pub mod gui;
pub mod input;
pub mod job;
pub mod lessons;
pub mod platform;
pub mod scene;
pub mod ticks;

pub use squeezefilm_solver::{
    budget, contact, control, digits, dimensionless, drive, estimate, fall, fidelity, film, gas, hold, ladder, memory,
    motor, numerics, paper, plan, plate, problem, recording, rotor, solution, solve, startup, surface,
};
