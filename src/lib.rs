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
//! let problem = Problem::new(&presets::find("fundamental")?)?;
//! let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
//! let solution = solve(&problem, &settings, &mut (), &Cancel::new())?;
//!
//! assert_eq!(solution.status, Status::Converged);
//! let Outcome::Motor(result) = solution.outcome else { unreachable!("the preset is a motor") };
//! assert!((0.24..0.25).contains(&result.alpha));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Equations
//!
//! On every tooth the compressible Reynolds equation with slip; at every point of a tooth top a unilateral contact with a
//! rotor of compliance C(k); for every wavelength a balance of load:
//!
//! ```text
//! ∂Z/∂t = ∇·[ p_a/(12μ) h² ψ(Z) ∇P ] − ∂x[ Z U/2 ],   P = p/p_a = 1 on the edges,   Z = hP   (film)
//! h = H_m + g,   g = W_R − W_S ≥ 0,   c ≥ 0,   c g = 0                                      (contact)
//! W_R = z₀ + Σ_n C(k_n) q_n,   q = c + film,   Σ q Δx = L                                   (rotor)
//! ```
//!
//! # Scaling
//!
//! Public numbers are in SI units, unless a name says otherwise. The film works with the pressure ratio P and with the
//! trapped height Z = hP in metres: the layer that the gas above a point would make at ambient pressure. The numbers that
//! tell the regime, σ, Λ and Kn, are in [`dimensionless`].
//!
//! # Map
//!
//! Each module may use those above it in this table, and none below.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`numerics`] | five-point systems, graded nodes, Anderson acceleration; no physics |
//! | [`platform`] | where the program runs: a process or a page |
//! | [`control`], [`digits`] | cancellation and progress; numbers for people |
//! | [`budget`] | the memory that all solves of the process share |
//! | [`atomic`] | files that appear whole or not at all; locks between processes |
//! | [`gas`] | gases by name: viscosity, mean free path; the standard atmosphere |
//! | [`surface`] | rough faces: what their asperities carry, how gas flows between them |
//! | [`problem`] | what is to be solved: checked, in SI units |
//! | [`scene`] | what a person edits: files, units, ranges, presets |
//! | [`dimensionless`] | σ, Λ and Kn without solving |
//! | [`film`] | the gas film: slip laws, one time step, one cycle, exact results |
//! | [`rotor`], [`contact`] | the compliance; contact and load balance at one instant |
//! | [`fidelity`], [`plan`], [`estimate`] | how much accuracy; what this scene needs; the error that is left |
//! | [`recording`], [`solution`] | what a solve returns: plain data |
//! | [`drive`] | torque, power and efficiency over speed, from where the contact load is |
//! | [`memory`] | what a solve needs of it |
//! | [`motor`], [`plate`] | the periodic state of either scene |
//! | [`mod@paper`] | the algorithm of Maeno and Bogy (1992), literally |
//! | [`mod@solve`] | one call for all of it |
//! | [`mod@startup`], [`hold`] | the transient from rest; a plate held by hand |
//! | [`analysis`], [`export`] | several solves; CSV, JSON, NumPy, figures, animations, reports |
//! | [`citation`] | how the program is cited |
//! | [`lessons`] | lessons and the glossary: their texts, scenes, questions and checks |
//! | [`cli`] | the command line |
//!
//! The equations with their derivation are in `docs/theory.md`, measured errors in `docs/validation.md`.

pub mod analysis;
pub mod atomic;
pub mod budget;
pub mod citation;
pub mod cli;
pub mod contact;
pub mod control;
pub mod digits;
pub mod dimensionless;
pub mod drive;
pub mod estimate;
pub mod export;
pub mod fall;
pub mod fidelity;
pub mod film;
pub mod gas;
#[cfg(feature = "gui")]
pub mod gui;
pub mod hold;
pub mod input;
pub mod job;
pub mod ladder;
pub mod lessons;
pub mod memory;
pub mod motor;
pub mod numerics;
pub mod paper;
pub mod plan;
pub mod plate;
pub mod platform;
pub mod problem;
pub mod recording;
pub mod rotor;
pub mod scene;
pub mod solution;
pub mod solve;
pub mod startup;
pub mod surface;
