use squeezefilm::{control::*, fidelity::*, motor, plan::*, problem::*, scene::*};
fn main() {
    let wide = std::env::args().nth(1).as_deref() == Some("wide");
    let n: u64 = std::env::args().nth(2).map_or(60, |s| s.parse().unwrap());
    let mut seed = 12345u64;
    let mut rnd = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut ratios: Vec<Vec<(f64, f64)>> = vec![vec![], vec![]];
    for i in 0..n {
        let s = if wide { 3.0 } else { 1.0 };
        let mut scene = presets::find("fundamental").unwrap();
        let log = |c: f64, dec: f64, u: f64| c * 10f64.powf(dec * (2.0 * u - 1.0));
        let teeth = if wide { 1 + (rnd() * 30.0) as u32 } else { 5 + (rnd() * 12.0) as u32 };
        let waves = 7.0;
        let pitch = std::f64::consts::TAU * 29.0 / waves / teeth as f64;
        let b = pitch * (0.15 + 0.84 * rnd());
        let sets: Vec<(&str, String)> = vec![
            ("stator.teeth_per_wave", teeth.to_string()),
            ("stator.tooth_width_mm", b.to_string()),
            ("film.min_spacing_nm", log(150.0, 0.45 * s, rnd()).clamp(5.0, 1e4).to_string()),
            ("stator.frequency_khz", log(30.0, 0.7 * s, rnd()).to_string()),
            ("motor.load_per_wave_n", log(2.45, 0.5 * s, rnd()).clamp(0.01, 100.0).to_string()),
            ("stator.normal_amplitude_um", log(1.3, 0.3 * s, rnd()).min(20.0).to_string()),
            ("rotor.contact_width_mm", log(0.3, 0.4 * s, rnd()).clamp(0.01, 10.0).to_string()),
            ("film.ambient_pressure_kpa", log(101.0, 0.3 * s, rnd()).to_string()),
            ("rotor.point_compliance_um_per_n", log(0.64, 0.4 * s, rnd()).to_string()),
            ("rotor.decay_length_mm", log(4.0, 0.2 * s, rnd()).to_string()),
        ];
        scene.set_all(sets.iter().map(|(a, b)| (*a, b.as_str()))).unwrap();
        let p = Problem::new(&scene).unwrap();
        let Scenario::Motor(m) = &p.scenario else { panic!() };
        let run = |f| {
            let plan = Plan::motor(m, f, &p.numerics);
            motor::periodic(m, &plan, &mut (), &Cancel::new())
        };
        let show = || sets.iter().map(|(k, v)| format!("{}={:.5}", k, v)).collect::<Vec<_>>().join(" ");
        let (d, s, f) = match (run(Fidelity::Draft), run(Fidelity::Standard), run(Fidelity::Fine)) {
            (Ok(a), Ok(b), Ok(c)) => (a, b, c),
            (a, b, c) => {
                println!("ERR {:?} {:?} {:?} {}", a.err(), b.err(), c.err(), show());
                continue;
            }
        };
        for (k, x) in [(0, &d), (1, &s)] {
            let t = (x.result.alpha - f.result.alpha).abs();
            ratios[k].push((x.result.alpha_error, t));
            if t > x.result.alpha_error
                || x.status != squeezefilm::solution::Status::Converged
                || x.result.alpha_error > 0.02
            {
                println!(
                    "{i} {} {:?} a {:.5} true {:.1e} stated {:.1e} rounds {} | {:?} fine {:?} {} {}",
                    ["draft", "std"][k],
                    x.status,
                    f.result.alpha,
                    t,
                    x.result.alpha_error,
                    x.stats.coupling_iterations,
                    x.alphas,
                    f.alphas,
                    f.result.alpha_error,
                    show()
                );
            }
        }
    }
    for (k, r) in ratios.iter().enumerate() {
        let ok = r.iter().filter(|(s, t)| t <= s).count();
        let mut q: Vec<f64> = r.iter().map(|(s, t)| s / t.max(1e-9)).collect();
        q.sort_by(f64::total_cmp);
        let mut tt: Vec<f64> = r.iter().map(|(_, t)| *t).collect();
        tt.sort_by(f64::total_cmp);
        println!(
            "{} covered {ok}/{} median stated/true {:.1} median true {:.1e} 90% true {:.1e} max {:.1e}",
            ["draft", "standard"][k],
            r.len(),
            q[q.len() / 2],
            tt[tt.len() / 2],
            tt[tt.len() * 9 / 10],
            tt[tt.len() - 1]
        );
    }
}
