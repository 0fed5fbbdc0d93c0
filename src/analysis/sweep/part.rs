//! Parts of a sweep, to be solved on several machines, and the chunks of which they consist. Both depend only on the axes.

use super::axis::{Axis, MOST_POINTS};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// A part of a sweep: `3/64` is the third of 64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SweepPart {
    number: usize,
    of: usize,
}

impl SweepPart {
    /// The whole sweep.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// All parts of a sweep in `of` parts, in order.
    pub fn all(of: usize) -> impl Iterator<Item = Self> {
        (1..=of).map(move |number| Self { number, of })
    }

    /// How many parts there are.
    pub fn of(self) -> usize {
        self.of
    }

    /// Its number, from 1.
    pub fn number(self) -> usize {
        self.number
    }

    /// The numbers of its chunks.
    pub(super) fn chunks(self, axes: &[Axis]) -> Range<usize> {
        let all = (count(axes) / line(axes)).saturating_mul(line(axes).div_ceil(CHUNK)) as u128;
        let start = |parts: usize| (parts as u128 * all / self.of as u128) as usize;
        start(self.number - 1)..start(self.number)
    }

    pub(super) fn points(self, axes: &[Axis]) -> Range<usize> {
        let chunks = self.chunks(axes);
        start(axes, chunks.start)..start(axes, chunks.end)
    }
}

/// Number of neighbours along the last axis that one thread solves one after the other.
pub(super) const CHUNK: usize = 4;

/// The number of points over these axes.
pub(super) fn count(axes: &[Axis]) -> usize {
    axes.iter().fold(1, |count, axis| count.saturating_mul(axis.values.len()))
}

/// The number of points along the last axis.
fn line(axes: &[Axis]) -> usize {
    axes.last().map_or(1, |axis| axis.values.len().max(1))
}

/// The first point of a chunk. Chunks are runs of neighbours along the last axis, and none goes beyond its end.
fn start(axes: &[Axis], chunk: usize) -> usize {
    let each = line(axes).div_ceil(CHUNK);
    chunk / each * line(axes) + chunk % each * CHUNK
}

pub(super) fn chunk(axes: &[Axis], number: usize) -> Range<usize> {
    start(axes, number)..start(axes, number + 1)
}

impl fmt::Display for SweepPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for SweepPart {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        match numbers {
            Some((number, of)) if (1..=of).contains(&number) && of <= MOST_POINTS => Ok(Self { number, of }),
            _ => Err(format!(
                "part = {text} is not allowed: a number and how many there are, 1/1 to {MOST_POINTS}/{MOST_POINTS}, as 3/64"
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::sweep::Sweep;
    use crate::scene::presets;
    use crate::solve::Settings;

    #[test]
    fn parts_cover_every_point_once_and_no_chunk_is_cut() {
        let vary = ["motor.waves=5:8:4", "film.min_spacing_nm=100:150:6"].map(|text| text.parse().unwrap());
        let sweep = Sweep::new(&presets::find("fundamental").unwrap(), &vary, &Settings::default()).unwrap();
        for of in [1, 2, 3, 7, 8, 9, 64] {
            let points: Vec<Range<usize>> = SweepPart::all(of).map(|part| sweep.points_of(part)).collect();
            assert_eq!(points.iter().cloned().flatten().collect::<Vec<_>>(), (0..sweep.len()).collect::<Vec<_>>());
            let starts: Vec<usize> =
                SweepPart::WHOLE.chunks(sweep.axes()).map(|number| start(sweep.axes(), number)).collect();
            assert!(points.iter().all(|points| points.is_empty() || starts.contains(&points.start)), "{points:?}");
        }
    }

    #[test]
    fn of_a_large_sweep_a_part_is_enough() {
        let scene = presets::find("fundamental").unwrap();
        let vary =
            ["motor.load_per_wave_n=1:5:1000", "film.min_spacing_nm=50:500:1000", "stator.frequency_khz=3:100:101"];
        let vary = vary.map(|text| text.parse().unwrap());
        let of = |part: &str| Sweep::of_part(&scene, &vary, &Settings::default(), part.parse().unwrap());
        let (first, last) = (of("1/2000").unwrap(), of("2000/2000").unwrap());
        assert_eq!((first.len(), first.fingerprint()), (101_000_000, last.fingerprint()));
        let points: Vec<Range<usize>> = SweepPart::all(2000).map(|part| first.points_of(part)).collect();
        assert!(points.windows(2).all(|pair| pair[0].end == pair[1].start && pair[0].len().abs_diff(50_500) < 101));
        assert_eq!((points[0].start, points[1999].end), (0, first.len()));
        assert_eq!(first.values(first.len() - 1), [5.0, 500.0, 100.0]);
        for (part, told) in
            [("1/1", "vary: 101000000 points: "), ("3/1000", "vary: 101000 points in one of 1000 parts: ")]
        {
            assert!(of(part).unwrap_err().to_string().starts_with(told), "{part}");
        }
    }

    #[test]
    fn what_is_no_part_is_told() {
        assert_eq!("3/64".parse::<SweepPart>().map(|part| part.to_string()), Ok("3/64".to_owned()));
        for wrong in ["0/4", "5/4", "3", "a/b", "1/0", "1/100001"] {
            assert!(wrong.parse::<SweepPart>().unwrap_err().starts_with(&format!("part = {wrong}")), "{wrong}");
        }
    }
}
