//! Flow of the gas between rough faces, averaged: the factors of N. Patir and H. S. Cheng (ASME J. Lubr. Technol. 100, 1978, and 101, 1979).
//!
//! With h the nominal gap, the separation of the mean planes, and H = h/σ, the mean mass flow is that of smooth faces with the flow driven by
//! pressure multiplied by φ, and what sliding drags in raised by σφ_s/h_T:
//!
//! ```text
//! φ = 1 − C e^{−rH}  (γ ≤ 1),   1 + C H^{−r}  (γ > 1)
//! φ_s = A₁ H^{α₁} e^{−α₂H + α₃H²}  (H ≤ 5),   A₂ e^{−0.25H}  (H > 5)
//! ```
//!
//! γ is the lay: how much longer the asperities are along the flow than across it. Across the width it is 1/γ.
//!
//! The factors were computed for H ≥ 0.5 and 1/9 ≤ γ ≤ 9, of some rows from a greater H on. Below, they stay what they are there. Between
//! the lays of the table they are interpolated over ln γ. They depend on the gap alone and leave the film's law of Z what it is: that slip and
//! roughness change the flow independently is an assumption (`docs/theory.md`).

use super::asperities::Asperities;

/// The roughness that the gas flows past, of a motor's two faces together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Standard deviation σ of the heights of both faces \[m\].
    pub rms: f64,
    /// Lay γ along the wave, 1/9 to 9.
    pub lay: f64,
    /// The stator's share of the variance σ².
    pub stator_share: f64,
    /// The asperities, if the film thickness is the mean gap over them; `None`: if it is the separation.
    pub asperities: Option<Asperities>,
}

/// Flow factors at one gap: the film's flow as a multiple of that between smooth faces as far apart as the film is thick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Flow along x driven by pressure.
    pub along: f64,
    /// Flow along y driven by pressure.
    pub across: f64,
    /// Flow dragged in by sliding.
    pub dragged: f64,
}

impl Factors {
    /// Those of smooth faces.
    pub const SMOOTH: Self = Self { along: 1.0, across: 1.0, dragged: 1.0 };
}

/// Least h/σ for which the factors were computed.
pub const LEAST_RATIO: f64 = 0.5;

/// Least and greatest lay for which they were.
pub const ROWS_LAY: [f64; 2] = [1.0 / 9.0, 9.0];

/// One lay of the tables.
struct Row {
    lay: f64,
    /// C and r of φ, and the least H.
    pressure: [f64; 3],
    /// A₁, α₁, α₂, α₃, A₂ of φ_s.
    shear: [f64; 5],
}

/// Tables 1 of both papers.
static ROWS: [Row; 7] = [
    Row { lay: 1.0 / 9.0, pressure: [1.48, 0.42, 1.0], shear: [2.046, 1.12, 0.78, 0.03, 1.856] },
    Row { lay: 1.0 / 6.0, pressure: [1.38, 0.42, 1.0], shear: [1.962, 1.08, 0.77, 0.03, 1.754] },
    Row { lay: 1.0 / 3.0, pressure: [1.18, 0.42, 0.75], shear: [1.858, 1.01, 0.76, 0.03, 1.561] },
    Row { lay: 1.0, pressure: [0.90, 0.56, 0.5], shear: [1.899, 0.98, 0.92, 0.05, 1.126] },
    Row { lay: 3.0, pressure: [0.225, 1.5, 0.5], shear: [1.560, 0.85, 1.13, 0.08, 0.556] },
    Row { lay: 6.0, pressure: [0.520, 1.5, 0.5], shear: [1.290, 0.62, 1.09, 0.08, 0.388] },
    Row { lay: 9.0, pressure: [0.870, 1.5, 0.5], shear: [1.011, 0.54, 1.07, 0.08, 0.295] },
];

impl Row {
    fn pressure(&self, ratio: f64) -> f64 {
        let [c, r, least] = self.pressure;
        let ratio = ratio.max(least);
        if self.lay > 1.0 { 1.0 + c * ratio.powf(-r) } else { 1.0 - c * (-r * ratio).exp() }
    }

    fn shear(&self, ratio: f64) -> f64 {
        let ([a1, power, first, second, a2], ratio) = (self.shear, ratio.max(LEAST_RATIO));
        if ratio > 5.0 {
            a2 * (-0.25 * ratio).exp()
        } else {
            a1 * ratio.powf(power) * (-first * ratio + second * ratio * ratio).exp()
        }
    }
}

/// A factor at a lay: between the rows of the table.
fn interpolated(lay: f64, factor: impl Fn(&Row) -> f64) -> f64 {
    let above = ROWS.partition_point(|row| row.lay < lay).clamp(1, ROWS.len() - 1);
    let (low, high) = (&ROWS[above - 1], &ROWS[above]);
    let share = ((lay / low.lay).ln() / (high.lay / low.lay).ln()).clamp(0.0, 1.0);
    let at = factor(low);
    at + share * (factor(high) - at)
}

/// φ at H = h/σ = `ratio` for a lay along the flow.
pub fn pressure_factor(ratio: f64, lay: f64) -> f64 {
    interpolated(lay, |row| row.pressure(ratio))
}

/// φ_s at H = h/σ = `ratio` of one rough face for a lay along the sliding.
fn shear_factor(ratio: f64, lay: f64) -> f64 {
    interpolated(lay, |row| row.shear(ratio))
}

impl Roughness {
    /// The factors of a film `thickness` \[m\] thick.
    pub fn at(&self, thickness: f64) -> Factors {
        let separation = self.asperities.map_or(thickness, |asperities| asperities.separation(thickness));
        let nominal = separation.max(LEAST_RATIO * self.rms);
        let ratio = nominal / self.rms;
        // The factors multiply the cube of the nominal gap; the film's own is that of its thickness.
        let cube = self.asperities.map_or(1.0, |asperities| (nominal / asperities.mean_gap(nominal).0).powi(3));
        // The rough rotor carries gas along in its valleys, the rough stator holds it back.
        let carried = (1.0 - 2.0 * self.stator_share) * self.rms / thickness;
        Factors {
            along: cube * pressure_factor(ratio, self.lay),
            across: cube * pressure_factor(ratio, 1.0 / self.lay),
            dragged: 1.0 + if carried == 0.0 { 0.0 } else { carried * shear_factor(ratio, self.lay) },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Read off the figures and tables of the papers.
    #[test]
    fn factors_are_the_published_ones() {
        for (ratio, lay, phi) in [
            (3.0, 1.0, 1.0 - 0.90 * (-1.68_f64).exp()),
            (1.0, 1.0, 0.4859),
            (3.0, 1.0 / 9.0, 0.5802),
            (1.0, 9.0, 1.870),
            (4.0, 3.0, 1.0 + 0.225 / 8.0),
        ] {
            assert!((pressure_factor(ratio, lay) - phi).abs() < 1e-4, "{ratio} {lay}: {}", pressure_factor(ratio, lay));
        }
        // Isotropic, H = 1 and 6: 1.899 e^{−0.87}, 1.126 e^{−1.5}.
        assert!((shear_factor(1.0, 1.0) - 0.7956).abs() < 1e-4 && (shear_factor(6.0, 1.0) - 0.2512).abs() < 1e-4);
        // Above 5 the second form takes over. That both agree there ties A₂ of each lay to its other constants.
        for row in &ROWS {
            let [below, above] = [row.shear(5.0), row.shear(5.0 + 1e-9)];
            assert!((below / above - 1.0).abs() < 1e-3, "{}: {below} {above}", row.lay);
        }
    }

    #[test]
    fn smooth_faces_have_none_and_no_factor_is_negative() {
        for lay in [1.0 / 9.0, 0.2, 0.5, 1.0, 2.0, 4.5, 9.0] {
            for ratio in [0.1, 0.5, 0.8, 1.0, 3.0, 20.0, 1e4] {
                let phi = pressure_factor(ratio, lay);
                assert!(phi > 0.02 && phi < 4.0, "{lay} {ratio}: {phi}");
            }
            assert!((pressure_factor(1e4, lay) - 1.0).abs() < 1e-5 && shear_factor(1e4, lay) < 1e-9);
            // Lay along the flow helps it.
            assert!(pressure_factor(2.0, lay) <= pressure_factor(2.0, (1.5 * lay).min(9.0)) + 1e-12);
        }
    }

    #[test]
    fn two_faces_of_one_roughness_drag_in_as_much_as_smooth_ones() {
        let faces = |stator_share| Roughness { rms: 1e-7, lay: 1.0, stator_share, asperities: None }.at(2e-7).dragged;
        assert_eq!(faces(0.5), 1.0);
        assert!((faces(0.0) - 1.0 + faces(1.0) - 1.0).abs() < 1e-12 && faces(0.0) > 1.2);
    }
}
