//! The solver of squeezefilm: what a few hundred nanometres of air do between the teeth of an ultrasonic motor and its rotor.
//!
//! It takes a [`problem::Problem`], checked and in SI units, and gives a [`solution::Solution`], plain data. It knows no file, no
//! clock, no terminal and no window: for those, and for presets from which a problem is made, see the crate `squeezefilm`, which
//! has all modules of this one under the same names.
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
//! Which module uses which is in `ARCHITECTURE.md`, the equations with their derivation are in `docs/theory.md`, measured errors in
//! `docs/validation.md`.

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
