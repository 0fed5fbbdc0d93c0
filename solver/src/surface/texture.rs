//! Statistics of a measured face: heights, lengths, spectral moments, and the keys of a preset that follow.
//!
//! Sa, Sq, Sz, Ssk and Sku are those of ISO 25178-2 of the levelled heights. The correlation length along an axis is where the
//! autocorrelation first falls to ½; the lay γ is the ratio of both, or a bound of it where one is longer than half the face
//! (Peklenik 1968, as in Patir and Cheng 1978). Summits follow from the mean squares of height, slope and curvature along a line, m₀, m₂,
//! m₄ (J. I. McCool, ASME J. Tribol. 109, 1987), those of two faces together being the sums:
//!
//! ```text
//! η = (m₄/m₂)/(6π√3)      R = 3√π/(8√m₄)      bandwidth m₀m₄/m₂²
//! ```

use super::flow::{ROWS_LAY, pressure_factor};
use super::height_map::{HeightMap, HeightMapError};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A face's statistics, in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Texture {
    /// Mean magnitude Sa \[m\].
    pub mean: f64,
    /// Standard deviation Sq \[m\].
    pub rms: f64,
    /// Peak to valley Sz \[m\].
    pub peak_to_valley: f64,
    /// Skewness Ssk.
    pub skewness: f64,
    /// Kurtosis Sku; 3 if normally distributed.
    pub kurtosis: f64,
    /// Lengths along x and y at which the autocorrelation falls to ½ \[m\]; `None` where it does not, and along y of a profile.
    pub correlation: [Option<f64>; 2],
    /// Likewise for the threshold 0.2 of ISO 25178-2.
    pub correlation_fifth: [Option<f64>; 2],
    /// Mean squares of height m₀ \[m²\], slope m₂ \[–\] and curvature m₄ \[1/m²\]; m₂ and m₄ are means over both directions.
    pub moments: [f64; 3],
    /// Autocorrelation along x and y: `(lag [m], value)`, up to half the face.
    pub autocorrelation: [Vec<(f64, f64)>; 2],
}

/// Points of an autocorrelation that are kept beyond its fall to 0.2.
const TAIL: usize = 3;
/// Round-off in levelled heights, relative to the largest height.
const ROUNDING: f64 = 1e-12;
/// Most lags of an autocorrelation.
const MOST_LAGS: usize = 2000;

/// A measured face from its text, less the polynomial of this degree that is closest to it, and its statistics.
///
/// # Errors
/// [`HeightMapError`] if the text is no face, or if it is flat.
pub fn measured(text: &str, degree: usize) -> Result<(HeightMap, Texture), HeightMapError> {
    let read = HeightMap::read(text)?;
    let largest = read.heights.iter().fold(0.0, |largest: f64, height| largest.max(height.abs()));
    let map = read.levelled(degree);
    let texture = Texture::of(&map);
    let rough = texture.rms > ROUNDING * largest && texture.moments.iter().all(|moment| *moment > 0.0);
    if rough { Ok((map, texture)) } else { Err(HeightMapError::Flat) }
}

impl Texture {
    /// Of a levelled face.
    pub fn of(face: &HeightMap) -> Self {
        let count = face.heights.len() as f64;
        let middle = face.heights.iter().sum::<f64>() / count;
        let power = |n: i32| face.heights.iter().map(|z| (z - middle).powi(n)).sum::<f64>() / count;
        let rms = power(2).sqrt();
        let (low, high) =
            face.heights.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(*z), h.max(*z)));
        let directions = if face.ny > 1 { 2 } else { 1 };
        let autocorrelation =
            [0, 1].map(|axis| if axis < directions { autocorrelation(face, axis, middle) } else { Vec::new() });
        let falls = |to: f64| [0, 1].map(|axis| falls_to(&autocorrelation[axis], to));
        let moments = |of: fn(&HeightMap, usize) -> f64| {
            (0..directions).map(|axis| of(face, axis)).sum::<f64>() / directions as f64
        };
        Self {
            mean: face.heights.iter().map(|z| (z - middle).abs()).sum::<f64>() / count,
            rms,
            peak_to_valley: high - low,
            skewness: power(3) / rms.powi(3),
            kurtosis: power(4) / rms.powi(4),
            correlation: falls(0.5),
            correlation_fifth: falls(0.2),
            moments: [power(2), moments(slope), moments(curvature)],
            autocorrelation,
        }
    }

    /// γ: how much longer asperities are along x than along y. Of a length beyond half the face that half is taken, so that γ is a bound;
    /// `None` of a profile, and where both are.
    pub fn lay(&self) -> Option<f64> {
        let longest = |axis: usize| self.autocorrelation[axis].last().map(|(lag, _)| *lag).filter(|lag| *lag > 0.0);
        let [x, y] = [0, 1].map(|axis| self.correlation[axis].or_else(|| longest(axis)));
        (self.correlation != [None, None]).then_some(x? / y?)
    }
}

/// Mean of `of` a point and the stride to the next one, over all points along an axis that have `reach` points behind them.
fn mean_along(face: &HeightMap, axis: usize, reach: usize, of: impl Fn(usize, usize) -> f64) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    let (lines, next, points, stride) =
        if axis == 0 { (face.ny, face.nx, face.nx, 1) } else { (face.nx, 1, face.ny, face.nx) };
    for line in 0..lines {
        for i in 0..points.saturating_sub(reach) {
            sum += of(line * next + i * stride, stride);
            count += 1;
        }
    }
    sum / f64::from(count.max(1))
}

fn slope(face: &HeightMap, axis: usize) -> f64 {
    let z = &face.heights;
    mean_along(face, axis, 1, |k, stride| (z[k + stride] - z[k]).powi(2)) / face.spacing[axis].powi(2)
}

fn curvature(face: &HeightMap, axis: usize) -> f64 {
    let z = &face.heights;
    mean_along(face, axis, 2, |k, stride| (z[k + 2 * stride] - 2.0 * z[k + stride] + z[k]).powi(2))
        / face.spacing[axis].powi(4)
}

fn autocorrelation(face: &HeightMap, axis: usize, middle: f64) -> Vec<(f64, f64)> {
    let z = &face.heights;
    let points = if axis == 0 { face.nx } else { face.ny };
    let (mut found, mut beyond): (Vec<(f64, f64)>, usize) = (Vec::new(), 0);
    let whole = mean_along(face, axis, 0, |k, _| (z[k] - middle).powi(2));
    for lag in 0..(points / 2).min(MOST_LAGS) {
        let value = mean_along(face, axis, lag, |k, stride| (z[k] - middle) * (z[k + lag * stride] - middle)) / whole;
        found.push((lag as f64 * face.spacing[axis], value));
        beyond += usize::from(value < 0.2 || beyond > 0);
        // Beyond its fall, the autocorrelation is computed over as many lags again.
        if beyond > found.len() / 2 + TAIL {
            break;
        }
    }
    found
}

/// Where it first falls to `level`, between two lags.
fn falls_to(autocorrelation: &[(f64, f64)], level: f64) -> Option<f64> {
    autocorrelation.windows(2).find(|pair| pair[1].1 < level).map(|pair| {
        let [(a, high), (b, low)] = [pair[0], pair[1]];
        a + (b - a) * (high - level) / (high - low)
    })
}

/// Two faces that meet, and the keys that follow.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pair {
    /// H_m as the paper takes it: the mean of the peak-to-valley roughness of both \[m\].
    pub min_spacing: f64,
    /// √(σ₁² + σ₂²) \[m\].
    pub rms: f64,
    /// R \[m\].
    pub summit_radius: f64,
    /// η \[1/m²\].
    pub summit_density: f64,
    /// Bandwidth m₀m₄/m₂²: at least 1.5 for an isotropic face of random heights.
    pub bandwidth: f64,
    /// γ along x of both faces, limited to the range of the flow factors; a face whose lay is not known counts as γ = 1.
    pub lay: f64,
    /// The stator's share of the variance.
    pub stator_share: f64,
}

impl Pair {
    /// The rotor's face and the stator's.
    pub fn of(rotor: &Texture, stator: &Texture) -> Self {
        let [m0, m2, m4] = [0, 1, 2].map(|n| rotor.moments[n] + stator.moments[n]);
        // Each face's lay counts as its variance does.
        let lays = [rotor, stator].map(|face| face.lay().map_or(0.0, f64::ln) * face.moments[0] / m0);
        let [shortest, longest] = ROWS_LAY;
        Self {
            min_spacing: 0.5 * (rotor.peak_to_valley + stator.peak_to_valley),
            rms: m0.sqrt(),
            summit_radius: 0.375 * PI.sqrt() / m4.sqrt(),
            summit_density: m4 / m2 / (6.0 * PI * 3f64.sqrt()),
            bandwidth: m0 * m4 / (m2 * m2),
            lay: lays.iter().sum::<f64>().exp().clamp(shortest, longest),
            stator_share: stator.moments[0] / m0,
        }
    }

    /// φ along the wave and across it where the faces are `ratio` times the rms roughness apart.
    pub fn flow_factors(&self, ratio: f64) -> [f64; 2] {
        [self.lay, 1.0 / self.lay].map(|lay| pressure_factor(ratio, lay))
    }
}
