//! The numbers that tell the regime of a film, from the problem alone, without solving.
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
    /// Bearing number Λ = 6 μ U b / (p_a H²); 0 for a plate, which does not slide. It is what the motion gives, whether
    /// or not the scene asks for the wedge term.
    pub bearing_number: f64,
    /// Knudsen number m = λ_a / H, at ambient pressure.
    pub knudsen_number: f64,
    /// Λ/σ = U / (2 ω b): small means that the wedge term can be left out.
    pub bearing_to_squeeze: f64,
    /// Thickness of the layer at the edges into which the ambient pressure reaches in a cycle, sqrt(2D/ω) \[m\], with
    /// D = H² p_a Q / (12 μ) and Q = 1 + 6 m for first-order slip. The other laws: 1 without slip, 1 + 6 m + 6 m² for
    /// second order; Fukui and Kaneko's is estimated by the first-order one. Between rough faces D is that across the width.
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
        let smooth = Self::from_scales(&motor.gas, omega, fastest, motor.tooth_width, motor.min_spacing);
        match &motor.surface.flow {
            None => smooth,
            Some(roughness) => {
                let layer = roughness.at(motor.min_spacing).across.sqrt() * smooth.boundary_layer;
                Self { boundary_layer: layer, ..smooth }
            }
        }
    }

    /// The numbers of a plate.
    pub fn of_plate(plate: &Plate) -> Self {
        let omega = std::f64::consts::TAU * plate.frequency;
        Self::from_scales(&plate.gas, omega, 0.0, plate.squeezed_length(), plate.mean_gap)
    }

    /// From the angular frequency \[rad/s\], sliding speed \[m/s\], length b \[m\] and thickness H \[m\].
    fn from_scales(gas: &Gas, omega: f64, speed: f64, length: f64, thickness: f64) -> Self {
        let per_area = gas.viscosity / (gas.ambient_pressure * thickness * thickness);
        let m = gas.mean_free_path / thickness;
        let slip_factor = match gas.slip {
            Slip::None => 1.0,
            // Slip grows as 2/α − 1.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, presets};

    fn close(a: f64, b: f64) -> bool {
        (a / b - 1.0).abs() < 1e-12
    }

    #[test]
    fn fundamental_case_by_hand() {
        let numbers = Dimensionless::of(&Problem::new(&Scene::motor()).unwrap());
        let omega = std::f64::consts::TAU * 30e3;
        let sigma = 12.0 * 18.1e-6 * omega * 1.7353e-3 * 1.7353e-3 / (101_325.0 * 200e-9 * 200e-9);
        assert!(close(numbers.squeeze_number, sigma));
        assert!((numbers.squeeze_number - 30_418.0).abs() < 1.0, "{}", numbers.squeeze_number);
        let lambda = 6.0 * 18.1e-6 * (omega * 1e-6) * 1.7353e-3 / (101_325.0 * 200e-9 * 200e-9);
        assert!(close(numbers.bearing_number, lambda));
        assert!(close(numbers.bearing_to_squeeze, lambda / sigma));
        assert!(close(numbers.knudsen_number, 0.32));
        // D = (h² p + 6 λ p h)/(12 μ); about 24 µm, one cell of the paper's grid.
        let d = (200e-9 * 200e-9 * 101_325.0 + 6.0 * 64e-9 * 101_325.0 * 200e-9) / (12.0 * 18.1e-6);
        assert!(close(numbers.boundary_layer, (2.0 * d / omega).sqrt()));
    }

    #[test]
    fn the_rotor_adds_to_the_sliding_speed_whichever_way_it_turns() {
        let of = |rpm: &str| {
            let mut scene = Scene::motor();
            scene.set("motor.rotor_speed_rpm", rpm).unwrap();
            Dimensionless::of(&Problem::new(&scene).unwrap()).bearing_number
        };
        assert!(of("300") > 2.0 * of("0"));
        assert_eq!(of("300"), of("-300"));
    }

    #[test]
    fn slip_thickens_the_layer() {
        let of = |slip: &str| {
            let mut scene = Scene::plate();
            scene.set("film.slip", slip).unwrap();
            Dimensionless::of(&Problem::new(&scene).unwrap()).boundary_layer
        };
        assert!(close((of("first-order") / of("none")).powi(2), 1.384));
        assert!(of("second-order") > of("first-order"));
    }

    #[test]
    fn plate_presets_span_the_regimes() {
        let of = |name: &str| Dimensionless::of(&Problem::new(&presets::find(name).unwrap()).unwrap());
        assert!((0.25..0.35).contains(&of("plate-viscous").squeeze_number));
        assert!((10.0..20.0).contains(&of("plate-crossover").squeeze_number));
        assert!(of("plate-trapped").squeeze_number > 3000.0);
        assert_eq!(of("plate-trapped").bearing_number, 0.0);
    }
}
