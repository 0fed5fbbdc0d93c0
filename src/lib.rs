//! Squeezed air films in ultrasonic motors.
pub mod control;
pub mod dimensionless;
pub mod problem;
pub mod recording;
pub mod rotor;
pub mod scene;
pub mod solution;
