//! The film step under abuse: whatever the gap does, pressure stays positive, mass is kept and nothing rings.

use proptest::prelude::*;
use squeezefilm::film::grid::{Axis, FilmGrid, Start};
use squeezefilm::film::stepper::{Film, FilmState};
use squeezefilm::numerics::grading::clustering;
use squeezefilm::problem::{Gas, Slip};

fn air(slip: Slip) -> Gas {
    Gas { ambient_pressure: 101_325.0, viscosity: 18.1e-6, mean_free_path: 64e-9, slip, ..Gas::default() }
}

/// An axis of `intervals` whose intervals at an ambient edge are `edge_spacing` [m], or uniform, if that is smaller.
fn graded(half: f64, start: Start, intervals: usize, edge_spacing: f64) -> Axis {
    let length = if start == Start::Mirror { half } else { 2.0 * half };
    Axis::clustered(half, start, intervals, clustering(edge_spacing * intervals as f64 / length))
}

fn tooth(along: usize, across: usize) -> FilmGrid {
    FilmGrid { x: graded(0.87e-3, Start::Ambient, along, 10e-6), y: graded(0.15e-3, Start::Mirror, across, 10e-6) }
}

fn start(film: &Film, h: &[f64]) -> FilmState {
    let (ux, uy) = (film.grid().x.unknown(), film.grid().y.unknown());
    FilmState::at_rest(ux.flat_map(|ix| std::iter::repeat_n(h[ix], uy.len())).collect())
}

/// Total of a field at unknown nodes × area.
fn total(film: &Film, field: &[f64]) -> f64 {
    let grid = film.grid();
    let mut line = vec![0.0; grid.x.len()];
    grid.line_integral(field, &mut line);
    grid.x.copies() * line.iter().zip(&grid.x.lengths).map(|(l, w)| l * w).sum::<f64>()
}

#[test]
fn a_gap_that_doubles_or_grows_a_thousandfold_in_a_step_leaves_positive_pressure() {
    let round = |hole: f64| FilmGrid { x: Axis::radial(hole, 0.87e-3, 24, 2.0), y: Axis::single(1.0) };
    for (slip, grid) in [Slip::None, Slip::FirstOrder, Slip::SecondOrder, Slip::FukuiKaneko]
        .into_iter()
        .flat_map(|slip| [tooth(24, 6), round(0.0), round(0.5e-3)].map(|grid| (slip, grid)))
    {
        for factor in [2.0, 30.0, 1000.0] {
            for dt in [1e-12, 1e-7, 1e-3] {
                let mut film = Film::new(grid.clone(), &air(slip));
                let mut h = vec![5e-9; 25];
                let mut state = start(&film, &h);
                for step in 0..12 {
                    let gap = if step % 3 == 2 { 5e-9 * factor } else { 5e-9 };
                    h.fill(gap);
                    film.step(&h, None, dt, &mut state, None).unwrap();
                    assert!(film.pressure().iter().all(|p| *p > 0.0 && p.is_finite()), "{slip:?} {factor} {dt} {step}");
                    assert!(state.carried.iter().all(|w| *w > 0.0));
                }
            }
        }
    }
}

#[test]
fn pressure_after_a_contact_decays_without_ringing() {
    // The gap closes from 2 µm to 200 nm within one step and stays: the trapped gas, at ten atmospheres, leaks out. With
    // steps from a thousandth of the leak time (about 0.1 ms) to a thousand times it the load may not alternate (a
    // Crank–Nicolson step keeps ±100 % for ever), and may undershoot once, by a few per cent, where BDF2's roots are
    // complex.
    for dt in [1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1] {
        let mut film = Film::new(tooth(32, 8), &air(Slip::FirstOrder));
        let mut h = vec![2e-6; 33];
        let mut state = start(&film, &h);
        h.fill(200e-9);
        let full = 9.0 * 101_325.0 * 1.74e-3 * 0.3e-3;
        let mut line = vec![0.0; 33];
        let (mut last, mut lowest, mut turns) = (f64::INFINITY, f64::INFINITY, 0);
        for _ in 0..200 {
            film.step(&h, None, dt, &mut state, None).unwrap();
            film.grid().line_integral(&state.trapped, &mut line);
            let load: f64 = (1..32)
                .map(|ix| (line[ix] / h[ix] - film.grid().interior_width()) * film.grid().x.lengths[ix])
                .sum::<f64>()
                * 101_325.0
                / full;
            turns += u32::from(load * last < 0.0 && load.abs() > 1e-6);
            lowest = lowest.min(load);
            last = load;
        }
        assert!(lowest > -0.03 && turns <= 2, "dt = {dt}: lowest {lowest}, {turns} changes of sign");
        assert!(dt < 1e-4 || last.abs() < 1e-6, "dt = {dt}: {last} left");
    }
}

#[test]
fn mass_leaves_only_through_the_edges() {
    // In one step W changes by what the edge faces carry away, to round-off, even where the step was limited.
    let gas = air(Slip::FirstOrder);
    let mut film = Film::new(tooth(20, 6), &gas);
    let mut h: Vec<f64> = film.grid().x.nodes.iter().map(|x| 300e-9 + (x / 1e-3).powi(2) * 1e-6).collect();
    let mut state = start(&film, &h);
    let mut limited = 0;
    for step in 0..60 {
        let scale = if step % 10 == 5 {
            12.0
        } else if step % 10 == 6 {
            1.0 / 12.0
        } else {
            1.01
        };
        h.iter_mut().for_each(|h| *h *= scale);
        let before = total(&film, &state.carried);
        let dt = 2e-6;
        limited += film.step(&h, None, dt, &mut state, None).unwrap().limited;
        let change = total(&film, &state.carried) - before;
        let outflow = edge_outflow(&film, &h, &gas) * dt;
        let scale = before.max(total(&film, &state.carried));
        assert!((change + outflow).abs() < 1e-12 * scale, "step {step}: {change:e} {outflow:e}");
    }
    assert!(limited > 0, "the limiter was not exercised");
}

#[test]
fn a_periodic_cycle_takes_in_what_it_gives_out() {
    // Cycles of a strongly squeezed tooth until they repeat: the outflow of the last one sums up to the change of mass
    // in it, to round-off, and both are nothing against what flowed in and out.
    let gas = air(Slip::FirstOrder);
    let mut film = Film::new(tooth(20, 6), &gas);
    let steps = 90;
    let gap = |step: usize| 200e-9 + 1e-6 * (1.0 + (std::f64::consts::TAU * step as f64 / steps as f64).cos());
    let mut h = vec![gap(0); 21];
    let mut state = start(&film, &h);
    let dt = 1.0 / (3e3 * steps as f64);
    let (mut net, mut gross, mut before) = (0.0, 0.0, 0.0);
    for _ in 0..40 {
        (net, gross, before) = (0.0, 0.0, total(&film, &state.carried));
        for step in 1..=steps {
            h.fill(gap(step));
            film.step(&h, None, dt, &mut state, None).unwrap();
            let out = edge_outflow(&film, &h, &gas) * dt;
            net += out;
            gross += out.abs();
        }
    }
    let change = total(&film, &state.carried) - before;
    assert!((change + net).abs() < 1e-12 * gross, "{change:e} {net:e} {gross:e}");
    assert!(net.abs() < 1e-9 * gross, "{net:e} {gross:e}");
}

/// Flow of Z through all edges \[m³/s\], by the scheme's own face fluxes written out again.
fn edge_outflow(film: &Film, h: &[f64], gas: &Gas) -> f64 {
    let (x, y) = (&film.grid().x, &film.grid().y);
    let (nx, ny) = (x.len(), y.len());
    let mobility = gas.ambient_pressure / (12.0 * gas.viscosity);
    let flux = |[gap, edge]: [f64; 2], inner: f64, spacing: f64| {
        let psi = 0.5 * (gap * inner + edge) + 6.0 * gas.mean_free_path;
        mobility * gap * edge * psi * (inner - 1.0) / spacing
    };
    let mut sum = 0.0;
    for ix in x.unknown() {
        let inner = film.pressure()[ix * ny + ny - 2];
        sum += y.copies() * x.lengths[ix] * flux([h[ix]; 2], inner, y.nodes[ny - 1] - y.nodes[ny - 2]);
    }
    for iy in y.unknown() {
        for (edge, inner) in [(0, 1), (nx - 1, nx - 2)] {
            let spacing = (x.nodes[edge] - x.nodes[inner]).abs();
            sum += y.copies() * y.lengths[iy] * flux([h[inner], h[edge]], film.pressure()[inner * ny + iy], spacing);
        }
    }
    sum
}

#[test]
fn the_mirrored_half_is_the_whole() {
    let gas = air(Slip::FirstOrder);
    let x = graded(0.87e-3, Start::Ambient, 16, 10e-6);
    let half = FilmGrid { x: x.clone(), y: Axis::clustered(0.15e-3, Start::Mirror, 6, 1.0) };
    let whole = FilmGrid { x, y: Axis::clustered(0.15e-3, Start::Ambient, 12, 1.0) };
    let (mut half, mut whole) = (Film::new(half, &gas), Film::new(whole, &gas));
    let h0 = vec![1e-6; 17];
    let (mut a, mut b) = (start(&half, &h0), start(&whole, &h0));
    for step in 1..40 {
        let h: Vec<f64> = (0..17).map(|i| 1e-6 * (1.0 + 0.7 * (0.3 * step as f64 + 0.2 * i as f64).sin())).collect();
        half.step(&h, None, 1e-6, &mut a, None).unwrap();
        whole.step(&h, None, 1e-6, &mut b, None).unwrap();
    }
    assert!((total(&half, &a.trapped) / total(&whole, &b.trapped) - 1.0).abs() < 1e-12);
    assert!((half.pressure()[8 * 7] - whole.pressure()[8 * 13 + 6]).abs() < 1e-12);
}

#[test]
fn a_step_allocates_nothing() {
    let mut film = Film::new(tooth(24, 6), &air(Slip::FirstOrder));
    let mut h = vec![1e-6; 25];
    let speed = vec![0.2; 25];
    let mut state = start(&film, &h);
    let info = allocation_counter::measure(|| {
        for step in 0..50 {
            h.fill(1e-6 * (1.5 + (0.4 * f64::from(step)).cos()));
            film.step(&h, Some(&speed), 1e-6, &mut state, None).unwrap();
        }
    });
    assert_eq!((info.count_total, info.bytes_total), (0, 0));
    let control = allocation_counter::measure(|| drop(std::hint::black_box(vec![0.0; 3])));
    assert_eq!(control.count_total, 1, "the counter counts");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// Any gas, gap history, sliding speed and step over the documented ranges: the step succeeds, pressure and W are
    /// positive and finite.
    #[test]
    fn any_step_has_a_positive_solution(
        pressure in 1.0f64..7.0, path in 0usize..4, slip in 0usize..4, dt in -11.0f64..-1.0,
        gaps in proptest::collection::vec((-8.3f64..-4.7, -8.3f64..-4.7), 6), speed in -40.0f64..40.0,
        width in -5.0f64..-2.0, length in -6.0f64..-0.5,
    ) {
        let gas = Gas {
            ambient_pressure: 10f64.powf(pressure),
            viscosity: 18.1e-6,
            mean_free_path: [0.0, 1e-9, 64e-9, 1e-3][path],
            slip: [Slip::None, Slip::FirstOrder, Slip::SecondOrder, Slip::FukuiKaneko][slip],
            ..Gas::default()
        };
        let grid = FilmGrid {
            x: graded(10f64.powf(length), Start::Ambient, 12, 1e-6),
            y: graded(10f64.powf(width), Start::Mirror, 4, 1e-6),
        };
        let mut film = Film::new(grid, &gas);
        let mut state = start(&film, &[1e-6; 13]);
        for (left, right) in gaps {
            let h: Vec<f64> = (0..13).map(|i| 10f64.powf(left + (right - left) * f64::from(i) / 12.0)).collect();
            let slide = vec![speed; 13];
            let cost = film.step(&h, Some(&slide), 10f64.powf(dt), &mut state, None);
            prop_assert!(cost.is_ok(), "{cost:?}");
            prop_assert!(film.pressure().iter().all(|p| p.is_finite() && *p > 0.0));
            prop_assert!(state.carried.iter().all(|w| w.is_finite() && *w > 0.0));
        }
    }
}
