//! A rotor from its cross-section: semi-analytic finite elements of a ring.
//!
//! The ring is the same all round, so that each Fourier component of its load in the angle θ deflects it on its own:
//!
//! ```text
//! u_r = U(r, z) cos mθ,   u_θ = V(r, z) sin mθ,   u_z = W(r, z) cos mθ
//! ```
//!
//! This leaves for each order m a plane problem in three fields on the cross-section ([`section`]), solved with
//! quadratic elements (`element`) on a mesh that is dense at the contact and at corners ([`mesh`]), and with a sparse
//! Cholesky factorisation (`solve`). From it follow the compliance of every harmonic of the wave ([`compliance`]) and
//! the natural frequencies ([`modes`]).
//!
//! Source: E. L. Wilson, "Structural analysis of axisymmetric solids", AIAA J. 3 (1965) 2269; O. C. Zienkiewicz and R. L. Taylor,
//! *The Finite Element Method for Solid and Structural Mechanics*, 6th ed. (2005), chapter 16.

pub mod compliance;
mod element;
pub mod mesh;
pub mod modes;
pub mod section;
mod solve;

pub use compliance::{Deflection, RingCompliances};
pub use mesh::{Element, Mesh};
pub use section::{Band, MATERIALS, Material, Part, RingError, Section, Support};
