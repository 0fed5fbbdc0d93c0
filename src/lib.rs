//! Squeezed air films in ultrasonic motors.
pub mod control;
pub mod paper;
pub mod problem;
pub mod recording;
pub mod rotor;
pub mod solution;
