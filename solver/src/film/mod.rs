//! The gas film on one tooth (or plate): the transient compressible Reynolds equation with slip.
//!
//! With P = p/p_a and the trapped height Z = hP \[m\] (the gas above a point, as a layer at ambient pressure),
//!
//! ```text
//! ∂Z/∂t = ∇·[ M h² ψ(Z) ∇P ] − ∂x[ Z U/2 ],   M = p_a/(12μ),   P = 1 on every edge
//! ```
//!
//! ψ is the slip law's mobility (`slip`), h(x, t) does not depend on y, U is the sliding speed of the upper face seen
//! from the lower. A uniform pressure drives no flux whatever h does. `grid` holds the nodes, `stepper` one implicit
//! time step, `cycle` a whole cycle and the shortcut to the periodic state, `exact` the solutions to verify against,
//! `velocity` how the gas moves from wall to wall.

pub mod cycle;
pub mod exact;
pub mod grid;
pub mod slip;
pub mod stepper;
pub mod trapped;
pub mod velocity;
