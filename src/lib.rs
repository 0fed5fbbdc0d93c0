//! Squeezed air films in ultrasonic motors.
pub mod contact;
pub mod control;
pub mod film;
pub mod motor;
pub mod numerics;
pub mod plan;
pub mod problem;
pub mod recording;
pub mod rotor;
pub mod solution;
