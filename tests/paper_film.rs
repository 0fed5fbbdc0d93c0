//! The factored film of the paper's method, on its own.
use std::f64::consts::TAU;

use nalgebra::Complex;
use squeezefilm::paper::FactoredFilm;

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

/// Two meshes and two time steps, both halved and both errors of second order: the value in the limit.
fn extrapolated(face: &Face) -> f64 {
    let coarse = mean_load(face, 101, 21, 180);
    let fine = mean_load(face, 201, 41, 360);
    fine + (fine - coarse) / 3.0
}

#[test]
fn plate_benchmark_of_other_codes() {
    let face =
        Face { length: 1.735e-3, width: 0.3e-3, mean_gap: 1e-6, epsilon: 0.5, frequency: 30e3, mean_free_path: 0.0 };
    let plain = extrapolated(&face);
    let slip = extrapolated(&Face { mean_free_path: 65e-9, ..face });
    println!("{:.4} mN, with slip {:.4} mN", 1e3 * plain, 1e3 * slip);
    assert!((plain / 13.850e-3 - 1.0).abs() < 5e-4, "{plain}");
    assert!((slip / 12.26e-3 - 1.0).abs() < 5e-4, "{slip}");
}

/// A travelling, tilting film with slip and wedge: no term of the scheme is zero.
fn march_smooth(steps: usize) -> Vec<f64> {
    let (nx, ny) = (21, 11);
    let h = |step: usize| -> Vec<f64> {
        let tau = 1.5 * step as f64 / steps as f64;
        (0..nx)
            .map(|i| 2.0 + 0.8 * (tau + 2.0 * i as f64 / (nx - 1) as f64).cos() * (1.0 - (-tau * tau).exp()))
            .collect()
    };
    let mut film = FactoredFilm::new(nx, ny, 0.7, 30.0, 0.3);
    let mut z: Vec<f64> = h(0).iter().flat_map(|&h| vec![h; ny]).collect();
    let mut z_new = z.clone();
    for step in 0..steps {
        let tau = 1.5 * (step as f64 + 0.5) / steps as f64;
        let wedge: Vec<f64> = (0..nx).map(|i| 5.0 * tau.sin() * (0.1 * i as f64).cos()).collect();
        film.step(&z, &h(step), &h(step + 1), Some(&wedge), 1.5 / steps as f64, &mut z_new);
        std::mem::swap(&mut z, &mut z_new);
    }
    z
}

#[test]
fn second_order_in_time() {
    let exact = march_smooth(4096);
    let error = |steps| {
        let z = march_smooth(steps);
        z.iter().zip(&exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    };
    let errors = [error(32), error(64), error(128)];
    let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
    println!("{errors:?} {orders:?}");
    assert!(orders.iter().all(|order| (1.85..2.3).contains(order)), "{orders:?}");
}

/// A gas film between a tilted face and a sliding wall, infinitely wide: Z of the middle line in the steady state.
fn slider(nx: usize, lambda: f64, m: f64, inlet: f64) -> Vec<f64> {
    let ny = 3;
    let h: Vec<f64> = (0..nx).map(|i| inlet + (1.0 - inlet) * i as f64 / (nx - 1) as f64).collect();
    let wedge = vec![lambda; nx];
    let mut film = FactoredFilm::new(nx, ny, 1e5, 1.0, m);
    let mut z: Vec<f64> = h.iter().flat_map(|&h| [h; 3]).collect();
    let mut z_new = z.clone();
    for _ in 0..20_000 {
        film.step(&z, &h, &h, Some(&wedge), 2e-3, &mut z_new);
        std::mem::swap(&mut z, &mut z_new);
    }
    z.chunks_exact(ny).map(|column| column[1]).collect()
}

/// The same by shooting on the flux C: (Z + 6m)(h Z' − h' Z) − Λ Z = C, from Z = h at the inlet to Z = h at the outlet.
fn slider_by_shooting(lambda: f64, m: f64, inlet: f64, samples: usize) -> Vec<f64> {
    let slope = 1.0 - inlet;
    let per_sample = 100;
    let dx = 1.0 / ((samples - 1) * per_sample) as f64;
    let shoot = |flux: f64| {
        let rate = |x: f64, z: f64| {
            let h = inlet + slope * x;
            ((flux + lambda * z) / (z + 6.0 * m) + slope * z) / h
        };
        let mut z = inlet;
        let mut line = vec![z];
        for k in 0..(samples - 1) * per_sample {
            let x = k as f64 * dx;
            let a = rate(x, z);
            let b = rate(x + 0.5 * dx, z + 0.5 * dx * a);
            let c = rate(x + 0.5 * dx, z + 0.5 * dx * b);
            let d = rate(x + dx, z + dx * c);
            z += dx / 6.0 * (a + 2.0 * b + 2.0 * c + d);
            if z <= 0.0 {
                return (z, line);
            }
            if (k + 1) % per_sample == 0 {
                line.push(z);
            }
        }
        (z, line)
    };
    let (mut low, mut high) = (-10.0 * lambda, 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if shoot(middle).0 < 1.0 { low = middle } else { high = middle }
    }
    shoot(high).1
}

#[test]
fn gas_slider_with_slip_and_its_order_in_space() {
    let (lambda, m, inlet) = (10.0, 0.3, 2.0);
    let error = |nx: usize| {
        let z = slider(nx, lambda, m, inlet);
        let exact = slider_by_shooting(lambda, m, inlet, nx);
        assert_eq!(exact.len(), nx);
        z.iter().zip(&exact).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()))
    };
    let (coarse, fine) = (error(26), error(51));
    println!("{coarse:e} {fine:e} order {}", (coarse / fine).log2());
    assert!(fine < 2e-6);
    assert!((coarse / fine).log2() > 1.85, "{coarse} {fine}");
}

/// Small amplitude, infinite strip: load amplitude / (p_a × area × ε) = tanh(κ/2)/(κ/2) − 1, κ² = iσ/(1 + 6m).
#[test]
fn small_amplitude_strip() {
    let (nx, ny, steps, epsilon) = (201, 3, 400, 1e-4);
    for (sigma, m) in [(3.0, 0.0), (40.0, 0.0), (40.0, 0.5)] {
        let mut film = FactoredFilm::new(nx, ny, 1e5, sigma, m);
        let h = |step: usize| vec![1.0 + epsilon * (TAU * step as f64 / steps as f64).cos(); nx];
        let mut z = vec![h(0)[0]; nx * ny];
        let mut z_new = z.clone();
        let mut load = [0.0; 2];
        for _ in 0..12 {
            load = [0.0; 2];
            for step in 0..steps {
                film.step(&z, &h(step), &h(step + 1), None, TAU / steps as f64, &mut z_new);
                std::mem::swap(&mut z, &mut z_new);
                let line: Vec<f64> = z.chunks_exact(ny).map(|column| column[1] / h(step + 1)[0] - 1.0).collect();
                let phase = TAU * (step + 1) as f64 / steps as f64;
                let now = film.integrate(&line) / epsilon * 2.0 / steps as f64;
                load[0] += now * phase.cos();
                load[1] -= now * phase.sin();
            }
        }
        let half_kappa = Complex::new(0.0, sigma / (1.0 + 6.0 * m)).sqrt() * 0.5;
        let exact = half_kappa.tanh() / half_kappa - 1.0;
        println!("{sigma} {m}: {load:?} {exact}");
        assert!((load[0] - exact.re).hypot(load[1] - exact.im) < 2e-3 * exact.norm(), "{load:?} {exact}");
    }
}
