//! The dimensionless numbers that characterise the regime of a film, from the problem alone, without a solve.
//!
//! With H the smallest film thickness of a motor (its minimum spacing H_m) or the mean gap of a plate, b the length
//! across which the gas escapes (tooth width or plate length; the radius of a disc, the difference of a ring's radii), and ω = 2πf:
//!
//! | number | definition | tells |
//! | --- | --- | --- |
//! | squeeze σ | 12 μ ω b² / (p_a H²) | small: gas flows out in a cycle, viscous; large: trapped, a spring |
//! | bearing Λ | 6 μ U b / (p_a H²) | what sliding drags in against what pressure drives out |
//! | Knudsen m | λ_a / H | slip at the walls |
//!
//! U is the largest sliding speed |V_R − V_St| over a cycle, V_St of amplitude ω B_S.

use crate::problem::{Gas, Motor, Plate, Problem, Scenario, Slip};

/// The dimensionless numbers of a problem, and the one length that goes with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensionless {
    /// Squeeze number σ = 12 μ ω b² / (p_a H²).
    pub squeeze_number: f64,
    /// Bearing number Λ = 6 μ U b / (p_a H²); 0 for a plate, which does not slide. It follows from the motion, whether or not the scene
    /// asks for the wedge term.
    pub bearing_number: f64,
    /// Knudsen number m = λ_a / H, at ambient pressure.
    pub knudsen_number: f64,
    /// Λ/σ = U / (2 ω b): small means that the wedge term can be left out.
    pub bearing_to_squeeze: f64,
    /// Thickness of the boundary layer at the edges, as far as the ambient pressure penetrates in a cycle, sqrt(2D/ω) \[m\], with D = H²
    /// p_a Q / (12 μ) and Q = 1 + 6 m for first-order slip. For the other laws Q is 1 without slip and 1 + 6 m + 6 m² for second order;
    /// that of Fukui and Kaneko is estimated as 1 + 6 m (2/α − 1), with α the accommodation coefficient. Between rough faces D is the
    /// diffusivity across the width.
    pub boundary_layer: f64,
}

impl Dimensionless {
    /// The numbers of `problem`. All are finite and at least 0.
    pub fn of(problem: &Problem) -> Self {
        match &problem.scenario {
            Scenario::Motor(motor) => Self::of_motor(motor),
            Scenario::Plate(plate) => Self::of_plate(plate),
        }
    }

    /// The numbers of a motor.
    pub fn of_motor(motor: &Motor) -> Self {
        let omega = std::f64::consts::TAU * motor.frequency;
        let fastest = motor.rotor_speed.abs() + omega * motor.tangential_amplitude;
        let mut numbers = Self::from_scales(&motor.gas, omega, fastest, motor.tooth_width, motor.min_spacing);
        if let Some(roughness) = &motor.surface.flow {
            numbers.boundary_layer *= roughness.at(motor.min_spacing).across.sqrt();
        }
        numbers
    }

    /// The numbers of a plate.
    pub fn of_plate(plate: &Plate) -> Self {
        let omega = std::f64::consts::TAU * plate.frequency;
        Self::from_scales(&plate.gas, omega, 0.0, plate.squeezed_length(), plate.mean_gap)
    }

    /// The numbers, from angular frequency \[rad/s\], sliding speed \[m/s\], length b \[m\] and thickness H \[m\].
    fn from_scales(gas: &Gas, omega: f64, speed: f64, length: f64, thickness: f64) -> Self {
        let per_area = gas.viscosity / (gas.ambient_pressure * thickness * thickness);
        let m = gas.mean_free_path / thickness;
        let slip_factor = match gas.slip {
            Slip::None => 1.0,
            // The slip term is proportional to 2/α − 1.
            Slip::FirstOrder | Slip::FukuiKaneko => 1.0 + 6.0 * m * (2.0 / gas.accommodation - 1.0),
            Slip::SecondOrder => 1.0 + 6.0 * m + 6.0 * m * m,
        };
        let diffusivity = slip_factor / (12.0 * per_area);
        Self {
            squeeze_number: 12.0 * per_area * omega * length * length,
            bearing_number: 6.0 * per_area * speed * length,
            knudsen_number: m,
            bearing_to_squeeze: speed / (2.0 * omega * length),
            boundary_layer: (2.0 * diffusivity / omega).sqrt(),
        }
    }
}
