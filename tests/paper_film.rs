//! The factored film of the paper's method, on its own.
use squeezefilm::paper::FactoredFilm;
use std::f64::consts::TAU;

struct Face {
    length: f64,
    width: f64,
    mean_gap: f64,
    epsilon: f64,
    frequency: f64,
    mean_free_path: f64,
}
const P_A: f64 = 101_325.0;
const MU: f64 = 18.1e-6;

/// Mean gauge load [N] of the periodic state.
fn mean_load(face: &Face, nx: usize, ny: usize, steps: usize) -> f64 {
    let omega = TAU * face.frequency;
    let sigma = 12.0 * MU * omega * (face.length / face.mean_gap).powi(2) / P_A;
    let mut film = FactoredFilm::new(nx, ny, face.width / face.length, sigma, face.mean_free_path / face.mean_gap);
    let h = |step: usize| vec![1.0 + face.epsilon * (TAU * step as f64 / steps as f64).cos(); nx];
    let mut z = vec![h(0)[0]; nx * ny];
    let (mut z_new, mut p, mut line) = (z.clone(), z.clone(), vec![0.0; nx]);
    let mut before = f64::NAN;
    for _ in 0..400 {
        let mut sum = 0.0;
        for step in 0..steps {
            let h_new = h(step + 1);
            film.step(&z, &h(step), &h_new, None, TAU / steps as f64, &mut z_new);
            std::mem::swap(&mut z, &mut z_new);
            for (p, z) in p.iter_mut().zip(&z) {
                *p = z / h_new[0];
            }
            film.line_load(&p, &mut line);
            sum += film.integrate(&line);
        }
        let load = sum / steps as f64 * P_A * face.length * face.length;
        if (load / before - 1.0).abs() < 1e-8 {
            return load;
        }
        before = load;
    }
    panic!("not periodic in 400 cycles");
}

#[test]
fn explore() {
    for mfp in [0.0, 65e-9] {
        let face = Face { length: 1.735e-3, width: 0.3e-3, mean_gap: 1e-6, epsilon: 0.5, frequency: 30e3, mean_free_path: mfp };
        for (nx, ny) in [(51, 11), (101, 21), (201, 41), (401, 81)] {
            for steps in [90, 180, 360] {
                println!("{mfp:e} {nx}x{ny} {steps} {:.5} mN", 1e3 * mean_load(&face, nx, ny, steps));
            }
        }
    }
}
