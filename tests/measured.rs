//! Measured faces: what is read of a file, and what is made of heights whose statistics are known.

// clippy.toml allows this inside #[test] functions; the helpers of this file are tests too.
#![allow(clippy::unwrap_used)]

use squeezefilm::digits::significant;
use squeezefilm::export::surface::{lay, lengths, preset};
use squeezefilm::surface::height_map::{HeightMap, HeightMapError};
use squeezefilm::surface::texture::{Pair, Texture, measured};
use std::f64::consts::{PI, TAU};

/// Numbers in 0 … 1 that are the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Waves of one length in all directions, stretched along x: a random face of normally distributed heights, rms 50 nm.
fn waves(points: usize, wavenumber: f64, stretched: f64) -> HeightMap {
    let mut random = Random(7);
    let waves: Vec<[f64; 3]> = (0..400)
        .map(|_| {
            let direction = TAU * random.next();
            [wavenumber * direction.cos() / stretched, wavenumber * direction.sin(), TAU * random.next()]
        })
        .collect();
    let amplitude = 50e-9 * (2.0 / waves.len() as f64).sqrt();
    let step = 1e-6;
    let height = |k: usize| {
        let (x, y) = ((k % points) as f64 * step, (k / points) as f64 * step);
        waves.iter().map(|[a, b, phase]| amplitude * (a * x + b * y + phase).cos()).sum()
    };
    HeightMap { nx: points, ny: points, spacing: [step; 2], heights: (0..points * points).map(height).collect() }
}

#[test]
fn a_random_face_of_one_wavelength_has_its_known_moments_and_summits() {
    let k = TAU / 16e-6;
    let face = waves(256, k, 1.0);
    let texture = Texture::of(&face.levelled(1));
    // 16 wavelengths by 16 of it: as many independent heights as that leaves.
    assert!((texture.rms / 50e-9 - 1.0).abs() < 0.06, "{}", texture.rms);
    assert!(texture.skewness.abs() < 0.1 && (texture.kurtosis - 3.0).abs() < 0.2, "{texture:?}");
    // Along a line, ⟨cos²⟩ = 1/2 and ⟨cos⁴⟩ = 3/8 of k² and k⁴; differences over a step Δ see sin(kΔ/2)/(kΔ/2) of a wave.
    let [m0, m2, m4] = texture.moments;
    assert!((m2 / (0.5 * k * k * m0) - 1.0).abs() < 0.05, "{m2}");
    assert!((m4 / (0.375 * k.powi(4) * m0) - 1.0).abs() < 0.08, "{m4}");
    let pair = Pair::of(&texture, &texture);
    // Two of them: variances add. η = (¾k²)/(6π√3), R = 3√π/(8√m₄).
    assert!((pair.rms / (2f64.sqrt() * texture.rms) - 1.0).abs() < 1e-12);
    assert!((pair.summit_density / (0.75 * k * k / (6.0 * PI * 3f64.sqrt())) - 1.0).abs() < 0.08);
    assert!((pair.summit_radius / (0.375 * PI.sqrt() / (2.0 * 0.375 * k.powi(4) * m0).sqrt()) - 1.0).abs() < 0.05);
    assert!((pair.bandwidth - 1.5).abs() < 0.06, "{}", pair.bandwidth);
    assert!((pair.stator_share - 0.5).abs() < 1e-12 && (pair.lay - 1.0).abs() < 0.2, "{pair:?}");
    // The autocorrelation of waves of all directions is the Bessel function J₀(k lag), which is ½ at k lag = 1.521.
    let [x, y] = texture.correlation;
    assert!((x.unwrap() * k - 1.521).abs() < 0.1 && (y.unwrap() * k - 1.521).abs() < 0.1, "{x:?} {y:?}");
}

#[test]
fn the_lay_is_by_how_much_a_face_is_stretched() {
    for stretched in [1.0 / 3.0, 2.0] {
        let texture = Texture::of(&waves(256, TAU / 20e-6, stretched).levelled(1));
        let lay = texture.lay().unwrap();
        assert!((lay / stretched - 1.0).abs() < 0.15, "{stretched}: {lay}");
        let [along, across] = Pair::of(&texture, &texture).flow_factors(2.0);
        assert_eq!(along > across, stretched > 1.0);
    }
}

#[test]
fn of_grooves_longer_than_the_face_the_lay_is_a_bound() {
    // Along y nothing changes; along x 8.5 µm from groove to groove, whose autocorrelation cos k lag falls to ½ at a sixth of that.
    let height = |k: usize| 50e-9 * (TAU * (k % 80) as f64 / 8.5).sin();
    let face = HeightMap { nx: 80, ny: 60, spacing: [1e-6; 2], heights: (0..80 * 60).map(height).collect() };
    let texture = Texture::of(&face.levelled(1));
    assert!(texture.correlation[1].is_none());
    let bound = 8.5 / 6.0 / 29.0;
    assert!((texture.lay().unwrap() / bound - 1.0).abs() < 0.1, "{:?} {bound}", texture.lay());
    let told = lengths(&texture, texture.correlation);
    assert!(told.starts_with("1.") && told.ends_with(" µm, longer than half the face"), "{told}");
    assert_eq!(lay(&texture).unwrap(), format!("at most {}", significant(texture.lay().unwrap(), 3)));
    // They keep the gas from flowing along x.
    let [along, across] = Pair::of(&texture, &texture).flow_factors(2.0);
    assert!(along < 0.9 && across > 1.1, "{along} {across}");
}

#[test]
fn levelling_takes_off_tilt_and_roundness_and_nothing_else() {
    let face = waves(96, TAU / 16e-6, 1.0);
    let flat = face.levelled(1);
    let tilted = |form: &dyn Fn(f64, f64) -> f64| {
        let heights =
            face.heights.iter().enumerate().map(|(k, z)| z + form((k % 96) as f64, (k / 96) as f64)).collect();
        HeightMap { heights, ..face.clone() }
    };
    let rms = |map: &HeightMap| Texture::of(map).rms;
    let plane = tilted(&|x, y| 3e-6 + 2e-8 * x - 5e-8 * y);
    assert!((rms(&plane.levelled(1)) / rms(&flat) - 1.0).abs() < 1e-9);
    let round = tilted(&|x, y| 1e-9 * (x - 20.0).powi(2) + 2e-9 * x * y - 4e-10 * y * y);
    assert!((rms(&round.levelled(2)) / rms(&face.levelled(2)) - 1.0).abs() < 1e-9);
    assert!(rms(&round.levelled(1)) > 3.0 * rms(&flat) && rms(&plane.levelled(0)) > 3.0 * rms(&flat));
}

#[test]
fn a_grid_and_a_profile_are_read() {
    let row = |iy: usize, point: &str| (0..20).map(|ix| format!("{}{point}5", ix * iy % 7)).collect::<Vec<_>>();
    let grid = |between: &str, point: &str| {
        let rows: Vec<String> = (0..16).map(|iy| row(iy, point).join(between)).collect();
        format!("# taken on a Tuesday\n# dx_um = 0.5\n# dy_mm = 0.001\n# height = nm\n{}\n", rows.join("\n"))
    };
    for (between, point) in [(",", "."), ("; ", "."), ("\t", "."), (" ", "."), ("; ", ","), ("\t", ",")] {
        let map = HeightMap::read(&grid(between, point)).unwrap();
        assert_eq!((map.nx, map.ny, map.spacing), (20, 16, [0.5e-6, 1e-6]), "{between:?}");
        assert!((map.heights[3 * 20 + 4] - 5.5e-9).abs() < 1e-20);
    }
    let pairs: String = (0..40).map(|i| format!("{},{}\n", 0.25 * f64::from(i), i % 5)).collect();
    let map = HeightMap::read(&format!("x_um,z_nm\n{pairs}")).unwrap();
    assert_eq!((map.nx, map.ny), (40, 1));
    assert!((map.spacing[0] - 0.25e-6).abs() < 1e-18 && (map.heights[7] - 2e-9).abs() < 1e-20);
    let texture = Texture::of(&map.levelled(2));
    assert!(texture.correlation[1].is_none() && texture.lay().is_none());
}

#[test]
fn what_cannot_be_read_names_line_and_what_is_allowed() {
    let said = |text: &str| HeightMap::read(text).unwrap_err().to_string();
    let head = "# dx_um = 1\n# dy_um = 1\n# height = nm\n";
    for (text, words) in [
        ("1,2,3\n".to_owned(), &["unit of the heights", "# height = nm"][..]),
        ("# height = nm\n# dx_um = 1\n1,2\n".to_owned(), &["spacing along y"]),
        (format!("{head}1,2,3\n1,2\n"), &["line 5", "2 heights: expected 3"]),
        (format!("{head}1,2,\n1,x,3\n"), &["line 5", "\"x\" is not a number"]),
        (format!("{head}1,,3\n"), &["line 4", "\"\" is not a number", "filled in"]),
        (format!("{head}1,nan\n"), &["line 4", "not a number"]),
        (format!("{head}1,1e300\n"), &["line 4", "below 1e10", "not measured"]),
        (format!("{head}1,5 2,5\n"), &["line 4", "\"5 2\""]),
        (format!("{head}# dx_um = 5\n"), &["line 4", "dx_um: given twice"]),
        ("# height = inch\n".to_owned(), &["line 1", "height = inch", "allowed m, mm, um or nm"]),
        ("# dx_um = -1\n".to_owned(), &["line 1", "out of range"]),
        (format!("{head}1,2\n3,4\n"), &["2 × 2 points", "16"]),
        ("x_um,y_um\n1,2\n".to_owned(), &["line 1", "x_um,z_nm"]),
        ("z_nm,x_um\n1,2\n".to_owned(), &["line 1", "x comes first", "x_um,z_nm"]),
        ("x_um,z_nm\n1,2,3\n".to_owned(), &["line 2", "expected 2"]),
        (format!("x_um,z_nm\n{}", "1,2\n".repeat(20)), &["line 2", "even steps"]),
        (String::new(), &["unit of the heights"]),
    ] {
        let message = said(&text);
        assert!(words.iter().all(|word| message.contains(word)), "{text:?}: {message}");
    }
    assert_eq!(HeightMap::read(head).unwrap_err(), HeightMapError::Size { nx: 0, ny: 0 });
    // A face without any roughness, lying level or not.
    let plane = |slope: f64| {
        let row =
            |j: usize| (0..16).map(|i| format!("{}", 0.1 + slope * (i + 2 * j) as f64)).collect::<Vec<_>>().join(",");
        format!("{head}{}\n", (0..16).map(row).collect::<Vec<_>>().join("\n"))
    };
    for slope in [0.0, 0.7] {
        assert_eq!(measured(&plane(slope), 1).unwrap_err(), HeightMapError::Flat);
    }
}

/// The lines that are to be pasted are a preset: as they stand, and with the other half in place of the first.
#[test]
fn the_lines_for_a_preset_are_taken() {
    let texture = Texture::of(&waves(128, TAU / 16e-6, 2.0).levelled(1));
    let pair = Pair::of(&texture, &texture);
    let lines = preset(&pair);
    let fundamental = include_str!("../presets/fundamental.toml").split("[film]").next().unwrap().to_owned();
    let scene = squeezefilm::scene::Scene::from_toml(&format!("{fundamental}{lines}"), "hard").unwrap();
    let spacing = scene.get("film.min_spacing_nm").unwrap().as_number().unwrap();
    assert!((spacing / (pair.min_spacing * 1e9) - 1.0).abs() < 1e-3);
    let rough: String = lines
        .split("in place of that:\n")
        .nth(1)
        .unwrap()
        .lines()
        .map(|line| format!("{}\n", line.trim_start_matches("# ")))
        .collect();
    let scene = squeezefilm::scene::Scene::from_toml(&format!("{fundamental}{rough}"), "rough").unwrap();
    let radius = scene.get("surface.summit_radius_um").unwrap().as_number().unwrap();
    assert!((radius / (pair.summit_radius * 1e6) - 1.0).abs() < 1e-3);
    // What no key allows is moved to the end of its range, and says so.
    let lines = preset(&Pair { rms: 1e-9, ..pair });
    assert!(lines.contains("rms_nm = 10.0  # measured 1, allowed 10 to 5000"), "{lines}");
}
