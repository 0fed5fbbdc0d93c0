//! Parts of a sweep, for many machines.

use super::axis::MOST_POINTS;
use std::fmt;
use std::str::FromStr;

/// A part of a sweep: the third of 64 is `3/64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Part {
    number: usize,
    of: usize,
}

impl Part {
    /// The whole sweep.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// All parts of as many, in order.
    pub fn all(of: usize) -> impl Iterator<Item = Self> {
        (1..=of).map(move |number| Self { number, of })
    }

    /// How many parts there are.
    pub fn of(self) -> usize {
        self.of
    }

    /// Which of them it is, from 1.
    pub fn number(self) -> usize {
        self.number
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Part {
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
    use std::ops::Range;

    #[test]
    fn parts_cover_every_point_once_and_no_chunk_is_cut() {
        let vary = ["motor.waves=5:8:4", "film.min_spacing_nm=100:150:6"].map(|text| text.parse().unwrap());
        let sweep = Sweep::new(&presets::find("fundamental").unwrap(), &vary, &Settings::default()).unwrap();
        for of in [1, 2, 3, 7, 8, 9, 64] {
            let points: Vec<Range<usize>> = Part::all(of).map(|part| sweep.points_of(part)).collect();
            assert_eq!(points.iter().cloned().flatten().collect::<Vec<_>>(), (0..sweep.len()).collect::<Vec<_>>());
            let starts: Vec<usize> = sweep.chunks().iter().map(|chunk| chunk.start).collect();
            assert!(points.iter().all(|points| points.is_empty() || starts.contains(&points.start)), "{points:?}");
        }
    }

    #[test]
    fn what_is_no_part_is_told() {
        assert_eq!("3/64".parse::<Part>().map(|part| part.to_string()), Ok("3/64".to_owned()));
        for wrong in ["0/4", "5/4", "3", "a/b", "1/0", "1/100001"] {
            assert!(wrong.parse::<Part>().unwrap_err().starts_with(&format!("part = {wrong}")), "{wrong}");
        }
    }
}
