use super::{GASES, atmosphere, find};

/// CRC Handbook of Chemistry and Physics, 84th edition, "Viscosity of gases" [µPa·s] at 200, 300, 400, 500 and 600 K. Its
/// sources are others than those of the fits: Kadoya et al. 1985 (air), Cole and Wakeham 1985 (nitrogen), Kestin et al. 1984
/// (helium, argon), Vesovic et al. 1990 (carbon dioxide), Assael et al. 1986 (hydrogen).
const HANDBOOK: [(&str, [f64; 5]); 6] = [
    ("air", [13.3, 18.6, 23.1, 27.1, 30.8]),
    ("nitrogen", [12.9, 17.9, 22.2, 26.1, 29.6]),
    ("helium", [15.3, 20.0, 24.4, 28.4, 32.3]),
    ("argon", [15.9, 22.9, 28.8, 34.2, 39.0]),
    ("carbon-dioxide", [10.0, 15.0, 19.7, 24.0, 28.0]),
    ("hydrogen", [6.8, 9.0, 10.9, 12.7, 14.4]),
];

#[test]
fn viscosities_are_the_published_ones() {
    assert_eq!(HANDBOOK.map(|(name, _)| name).to_vec(), GASES.iter().map(|gas| gas.name).collect::<Vec<_>>());
    for (name, published) in HANDBOOK {
        let gas = find(name).unwrap();
        for (value, temperature) in published.into_iter().zip([200.0, 300.0, 400.0, 500.0, 600.0]) {
            let found = 1e6 * (gas.viscosity)(temperature);
            // One unit of the last digit, and 0.8 %, the deviation of newer measurements.
            assert!((found - value).abs() < 0.05 + 0.008 * value, "{name} {temperature} K: {found}, published {value}");
        }
    }
}

#[test]
fn air_is_that_of_the_standard_atmosphere() {
    let air = find("air").unwrap();
    // U.S. Standard Atmosphere 1976, viscosity at 0, 5 and 11 km by Sutherland's law with 110.4 K.
    for temperature in [288.15_f64, 255.676, 216.774] {
        let sutherland = 1.458e-6 * temperature.powf(1.5) / (temperature + 110.4);
        assert!(((air.viscosity)(temperature) / sutherland - 1.0).abs() < 5e-3, "{temperature}");
    }
    // Jennings, J. Aerosol Sci. 19 (1988) 159: dry air at 20 °C.
    assert!((air.mean_free_path(101_325.0, 293.15) / 65.43e-9 - 1.0).abs() < 5e-3);
    assert_eq!(air.mean_free_path(1e4, 293.15), 10.0 * air.mean_free_path(1e5, 293.15));
}

#[test]
fn sound_travels_as_fast_as_published() {
    // [m/s] at 20 °C and 100 kPa by the reference equation of state of each (CoolProp 8.0).
    let published = [343.34, 349.10, 1007.88, 318.96, 266.57, 1304.66];
    for (gas, published) in GASES.iter().zip(published) {
        let found = gas.at(293.15).speed_of_sound();
        assert!((found / published - 1.0).abs() < 0.01, "{} {found}", gas.name);
    }
    let air = find("air").unwrap().at(288.15);
    assert!((air.density(101_325.0) / 1.225 - 1.0).abs() < 1e-3, "that of the standard atmosphere at sea level");
}

#[test]
fn the_atmosphere_has_its_published_pressures() {
    // U.S. Standard Atmosphere 1976, Table I, by geometric altitude [Pa].
    for (altitude, published) in [
        (-1000.0, 1.1393e5),
        (0.0, 1.01325e5),
        (1000.0, 8.9876e4),
        (2000.0, 7.9501e4),
        (5000.0, 5.4048e4),
        (10_000.0, 2.6500e4),
        (20_000.0, 5.5293e3),
        (30_000.0, 1.1970e3),
        (40_000.0, 2.8714e2),
        (50_000.0, 7.9779e1),
        (60_000.0, 2.1959e1),
    ] {
        let found = atmosphere::pressure(altitude);
        assert!((found / published - 1.0).abs() < 1e-4, "{altitude} m: {found} Pa, published {published}");
    }
}

#[test]
fn its_layers_begin_where_they_are_said_to() {
    // The same, by geopotential altitude: the feet of the layers [km], and their pressures [Pa].
    for (foot, published) in
        [(11.0, 22_632.1), (20.0, 5474.89), (32.0, 868.019), (47.0, 110.906), (51.0, 66.9389), (71.0, 3.95642)]
    {
        let found = atmosphere::pressure(6_356.766e3 * foot / (6_356.766 - foot));
        assert!((found / published - 1.0).abs() < 1e-5, "{foot} km: {found} Pa, published {published}");
    }
}

#[test]
fn the_pressure_of_the_atmosphere_falls_without_a_step() {
    let mut before = atmosphere::pressure(-1001.0);
    for altitude in (-1000..80_000).step_by(1) {
        let here = atmosphere::pressure(f64::from(altitude));
        assert!(here < before && here > 0.9995 * before, "{altitude}");
        before = here;
    }
}
