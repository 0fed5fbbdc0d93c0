//! The solver of squeezefilm: what a few hundred nanometres of air do between the teeth of an ultrasonic motor and its rotor.
//!
//! It takes a [`problem::Problem`], which is checked and in SI units, and returns a [`solution::Solution`], which is plain data. It knows
//! no files, no clock, no terminal and no window: for those, and for the presets from which a problem is made, see the crate `squeezefilm`,
//! which re-exports all modules of this one under the same names.
//!
//! # Equations
//!
//! On every tooth the compressible Reynolds equation with slip; at every point of a tooth top a unilateral contact with a rotor of
//! compliance C(k); for every wavelength a load balance:
//!
//! ```text
//! ∂Z/∂t = ∇·[ p_a/(12μ) h² ψ(Z) ∇P ] − ∂x[ Z U/2 ],   P = p/p_a = 1 on the edges,   Z = hP   (film)
//! h = H_m + g,   g = W_R − W_S ≥ 0,   c ≥ 0,   c g = 0                                      (contact)
//! W_R = z₀ + Σ_n C(k_n) q_n,   q = c + film,   Σ q Δx = L                                   (rotor)
//! ```
//!
//! # Scaling
//!
//! Public numbers are in SI units, unless a name says otherwise. The film works with the pressure ratio P and with the trapped height Z =
//! hP in metres: the thickness of the layer that the gas above a point would form at ambient pressure. The numbers that characterise the
//! regime, σ, Λ and Kn, are in [`dimensionless`].
//!
//! `ARCHITECTURE.md` shows which module uses which, `docs/theory.md` derives the equations, and `docs/validation.md` gives the measured
//! errors.

pub mod budget;
pub mod contact;
pub mod control;
pub mod digits;
pub mod dimensionless;
pub mod drive;
pub mod estimate;
pub mod fall;
pub mod fidelity;
pub mod film;
pub mod gas;
pub mod hold;
pub mod ladder;
pub mod memory;
pub mod motor;
pub mod numerics;
pub mod paper;
pub mod plan;
pub mod plate;
pub mod problem;
pub mod recording;
pub mod rotor;
pub mod solution;
pub mod solve;
pub mod startup;
pub mod surface;
