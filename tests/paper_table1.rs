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


/// Row, published α, what changes.
type Row = (&'static str, f64, fn(&mut Motor));

const ROWS: [Row; 13] = [
    ("fundamental", 0.238, |_| ()),
    ("min_spacing_100nm", 0.481, |m| m.min_spacing = 100e-9),
    ("rotor_width_0.6mm", 0.466, |m| m.contact_width = 0.6e-3),
    ("tooth_width_1.16mm", 0.157, |m| m.tooth_width = 1.157e-3),
    ("tooth_width_2.31mm", 0.318, |m| m.tooth_width = 2.314e-3),
    ("frequency_3khz", 0.078, |m| m.frequency = 3e3),
    ("frequency_20khz", 0.224, |m| m.frequency = 20e3),
    ("frequency_40khz", 0.245, |m| m.frequency = 40e3),
    ("frequency_60khz", 0.251, |m| m.frequency = 60e3),
    ("frequency_100khz", 0.257, |m| m.frequency = 100e3),
    ("tooth_radius_3m", 0.235, |m| m.tooth_radius = Some(3.0)),
    ("tooth_radius_6.5m", 0.239, |m| m.tooth_radius = Some(6.5)),
    ("tooth_radius_10m", 0.239, |m| m.tooth_radius = Some(10.0)),
];

#[test]
fn explore() {
    for (name, published, change) in ROWS {
        let mut motor = fundamental();
        change(&mut motor);
        let t = std::time::Instant::now();
        let (s, r) = solve(&motor, &Numerics::default());
        println!("{name:20} {:.4} {published} {:+.2}% teeth {:.2} {:?} cycles {} rounds/step {:.2} {:?} {:?}", r.alpha, 100.0*(r.alpha/published-1.0), r.teeth_in_contact, t.elapsed(), s.stats.cycles, s.stats.coupling_iterations as f64/(s.stats.cycles as f64*180.0), s.status, s.warnings);
    }
    for (h, l) in [(80e-9, 2.45), (70e-9,2.45),(60e-9, 2.45), (50e-9, 2.45), (30e-9, 2.45), (20e-9, 2.45), (200e-9, 1.0),(200e-9,0.7), (200e-9, 0.5), (200e-9, 0.2)] {
        let mut motor = fundamental();
        motor.min_spacing = h; motor.load = l;
        let t = std::time::Instant::now();
        let (s, r) = solve(&motor, &Numerics::default());
        println!("{h:e} {l} {:.4} teeth {:.2} {:?} cycles {} rounds/step {:.2} {:?} {:?}", r.alpha, r.teeth_in_contact, t.elapsed(), s.stats.cycles, s.stats.coupling_iterations as f64/(s.stats.cycles as f64*180.0), s.status, s.warnings);
    }
}
