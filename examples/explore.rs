use squeezefilm::{control::*, fidelity::*, motor, plan::*, plate, problem::*, scene::*};
fn main() {
    let mut args = std::env::args().skip(1);
    let mut scene = presets::find(&args.next().unwrap()).unwrap();
    let mut fid = Fidelity::Standard;
    let mut sets: Vec<(String, String)> = vec![];
    for a in args {
        let (k, v) = a.split_once('=').unwrap();
        if k == "fid" { fid = v.parse().unwrap() } else { sets.push((k.into(), v.into())) }
    }
    scene.set_all(sets.iter().map(|(a, b)| (a.as_str(), b.as_str()))).unwrap();
    let p = Problem::new(&scene).unwrap();
    let v = std::env::var("V").is_ok();
    let mut obs = |p: &Progress| {
        if v {
            eprintln!("{p:?}")
        }
    };
    let t = std::time::Instant::now();
    match &p.scenario {
        Scenario::Motor(m) => {
            let plan = Plan::motor(m, fid, &p.numerics);
            match motor::periodic(m, &plan, &mut obs, &Cancel::new()) {
                Ok(r) => println!(
                    "{:?} {:?} alpha {:.7} ± {:.1e} teeth {:.2} h {:.1} nm p {:.0} kPa rounds {} solves {} {:.1} ms {:?}",
                    r.status,
                    plan.grids[2],
                    r.result.alpha,
                    r.result.alpha_error,
                    r.result.teeth_in_contact,
                    r.result.min_gap * 1e9,
                    r.result.max_pressure / 1e3,
                    r.stats.coupling_iterations,
                    r.stats.film_solves,
                    t.elapsed().as_secs_f64() * 1e3,
                    r.alphas
                ),
                Err(e) => println!("ERR {e}"),
            }
        }
        Scenario::Plate(m) => {
            let plan = Plan::plate(m, fid, &p.numerics);
            let r = plate::periodic(m, &plan, &mut obs, &Cancel::new()).unwrap();
            println!(
                "{:?} {:?} load {:.7e} ± {:.1e} rounds {} solves {} {:.1} ms {:?}",
                r.status,
                plan.grids[2],
                r.result.film_load,
                r.result.film_load_error,
                r.stats.cycles,
                r.stats.film_solves,
                t.elapsed().as_secs_f64() * 1e3,
                r.loads
            )
        }
    }
}
