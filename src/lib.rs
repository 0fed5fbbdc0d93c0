//! Squeezed air films in ultrasonic motors.
pub mod contact;
pub mod control;
pub mod dimensionless;
pub mod estimate;
pub mod fidelity;
pub mod film;
pub mod motor;
pub mod numerics;
pub mod paper;
pub mod plan;
pub mod plate;
pub mod problem;
pub mod recording;
pub mod rotor;
pub mod scene;
pub mod solution;
pub mod solve;
