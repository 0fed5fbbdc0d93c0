//! Table I of the paper by the paper's own method (`src/paper`), on the paper's own meshes.
use squeezefilm::control::Cancel;
use squeezefilm::paper;
use squeezefilm::problem::{Gas, Motor, Numerics, RotorCompliance, Slip};
use squeezefilm::solution::{MotorResult, Outcome, Solution};

fn fundamental() -> Motor {
    Motor {
        contact_radius: 29e-3,
        waves: 7,
        load: 2.45,
        dry_friction: 0.7,
        rotor_speed: 0.0,
        frequency: 30e3,
        normal_amplitude: 1.30e-6,
        tangential_amplitude: 1.0e-6,
        teeth: 9,
        tooth_width: 1.7353e-3,
        tooth_radius: None,
        contact_width: 0.3e-3,
        rotor: RotorCompliance::Beam {
            decay_length: 4.0e-3,
            point_compliance: 0.64e-6,
            local_compliance: 1.05e-10,
        },
        min_spacing: 200e-9,
        gas: Gas {
            ambient_pressure: 101_325.0,
            viscosity: 18.1e-6,
            mean_free_path: 64e-9,
            slip: Slip::FirstOrder,
        },
        shear: true,
    }
}

fn solve(motor: &Motor, numerics: &Numerics) -> (Solution, MotorResult) {
    let solution = paper::solve(motor, numerics, &mut (), &Cancel::new());
    match solution.outcome {
        Outcome::Motor(result) => (solution, result),
        Outcome::Plate(_) => panic!("a motor's solution"),
    }
}

#[test]
fn explore() {
    for spc in [90, 180, 360] {
        let t = std::time::Instant::now();
        let (s, r) = solve(&fundamental(), &Numerics { steps_per_cycle: Some(spc), ..Default::default() });
        println!("{spc} {:?} {:?}\n {:?}\n {:?} {:?}", t.elapsed(), s.status, r, s.stats, s.warnings);
    }
    let t = std::time::Instant::now();
    let (s, r) = solve(&fundamental(), &Numerics { film_nodes_along: Some(101), film_nodes_across: Some(21), contact_nodes: Some(361), ..Default::default() });
    println!("doubled {:?} {:?}\n {:?}\n {:?} {:?}", t.elapsed(), s.status, r, s.stats, s.warnings);
}
