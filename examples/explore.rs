use squeezefilm::{control::*, motor, numerics::grading::clustering, plan::*, problem::*};
pub fn fundamental() -> Motor {
    Motor { contact_radius: 29e-3, waves: 7, load: 2.45, dry_friction: 0.7, rotor_speed: 0.0, frequency: 30e3,
        normal_amplitude: 1.3e-6, tangential_amplitude: 1e-6, teeth: 9, tooth_width: 1.7353e-3, tooth_radius: None,
        contact_width: 0.3e-3, rotor: RotorCompliance::Beam { decay_length: 4e-3, point_compliance: 0.64e-6, local_compliance: 1.05e-10 },
        min_spacing: 200e-9, gas: Gas { ambient_pressure: 101325.0, viscosity: 18.1e-6, mean_free_path: 64e-9, slip: Slip::FirstOrder }, shear: true }
}
fn main() {
    let mut m = fundamental();
    let (mut along, mut across, mut per_tooth, mut levels, mut frac, mut ef, mut tol, mut every) = (32, 8, 20, 1, 1e-3, 0.5, 1e-6, false);
    let mut modes = 64; let mut shear = true; let mut uniform=false;
    for a in std::env::args().skip(1) {
        let (k, v) = a.split_once('=').unwrap();
        let f: f64 = v.parse().unwrap_or(0.0);
        match k {
            "a" => along = f as usize, "c" => across = f as usize, "s" => per_tooth = f as usize, "l" => levels = f as usize,
            "frac" => frac = f, "ef" => ef = f, "tol" => tol = f, "every" => every = f > 0.0, "modes" => modes = f as usize, "shear" => shear = f > 0.0,
            "uni" => uniform = f>0.0,
            "hm" => m.min_spacing = f * 1e-9, "f" => m.frequency = f * 1e3, "L" => m.load = f, "A" => m.normal_amplitude = f * 1e-6,
            "w" => m.contact_width = f * 1e-3, "b" => m.tooth_width = f * 1e-3, "R" => m.tooth_radius = Some(f), "pa" => m.gas.ambient_pressure = f * 1e3, "n" => m.teeth = f as usize,
            "mfp" => m.gas.mean_free_path = f*1e-9,
            _ => panic!("{k}"),
        }
    }
    let d = (m.min_spacing.powi(2) * m.gas.ambient_pressure + 6.0 * m.gas.mean_free_path * m.gas.ambient_pressure * m.min_spacing) / (12.0 * m.gas.viscosity);
    let delta = (2.0 * d / (std::f64::consts::TAU * m.frequency)).sqrt();
    let grids = (0..levels).rev().map(|l| { let k = 1 << l; Grid { along: along / k, across: (across / k).max(1), steps: m.teeth * per_tooth / k, most_harmonics: modes } }).collect::<Vec<_>>();
    let plan = Plan {
        clustering_along: if uniform {0.0} else {clustering(ef * delta * along as f64 / m.tooth_width)},
        clustering_across: if uniform {0.0} else {clustering(ef * delta * across as f64 / (0.5 * m.contact_width))},
        half_width: true, every_tooth: every, shear, harmonic_fraction: frac, tolerance: tol, round_limit: 100, grids };
    let t = std::time::Instant::now();
    let verbose = std::env::var("V").is_ok();
    let r = motor::periodic(&m, &plan, &mut |p: &Progress| { if verbose { eprintln!("  {p:?}") } }, &Cancel::new());
    match r {
        Ok(r) => let al=&r.alphas; let n=al.len(); if n>1 {let e2=al[n-1]+(al[n-1]-al[n-2])/3.0; let e1= if n>2 {al[n-2]+(al[n-2]-al[n-3])/3.0} else {f64::NAN}; print!("EXT {e2:.7} prev {e1:.7} ");} println!("{:?} alphas {:?} teeth {:.2} min h {:.1} nm pmax {:.0} kPa err {:.1e} {:?} {:.1} ms", r.status, r.alphas, r.result.teeth_in_contact, r.result.min_gap * 1e9, r.result.max_pressure / 1e3, r.result.alpha_error, r.stats, t.elapsed().as_secs_f64() * 1e3),
        Err(e) => println!("ERR {e}"),
    }
}
