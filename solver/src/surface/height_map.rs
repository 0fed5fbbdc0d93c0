//! A measured face: heights on an even grid or along a line, as text.
//!
//! A *grid* begins with its spacings, each on a line of its own as `# dx_um = 0.5` and `# dy_um = 0.5`, and the unit of the heights,
//! `# height = nm`; then a line of numbers for each y, from x = 0 on. A *profile* has a line `x_um,z_nm` and then a pair on each line.
//! Units are m, mm, um and nm; numbers are separated by commas, blanks, or semicolons or tabs. A comma that separates nothing is a decimal sign.
//! x is along the wave.

use serde::{Deserialize, Serialize};

/// Heights of a face on an even grid; a profile is a grid of one row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeightMap {
    /// Points along x.
    pub nx: usize,
    /// Points along y.
    pub ny: usize,
    /// Spacings along x and y \[m\].
    pub spacing: [f64; 2],
    /// Heights \[m\], `[iy][ix]`.
    pub heights: Vec<f64>,
}

/// Why a measured face cannot be read or used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HeightMapError {
    /// A line does not say what it has to.
    #[error("line {line}: {what}")]
    Line {
        /// Its number, from 1 on.
        line: usize,
        /// The fault, and what is expected.
        what: String,
    },
    /// The lines do not say how the heights lie.
    #[error(
        "no {0}: a grid needs lines like \"# dx_um = 0.5\", \"# dy_um = 0.5\" and \"# height = nm\" before its heights, a profile a line like \"x_um,z_nm\""
    )]
    Missing(&'static str),
    /// A plane, or too smooth to have summits.
    #[error("nothing is left of the heights once they are level")]
    Flat,
    /// Too few points, or too many.
    #[error(
        "{nx} × {ny} points: allowed {FEWEST} to {MOST} along a profile, and from {FEWEST} × {FEWEST} on a grid, {POINTS} in all"
    )]
    Size {
        /// Points along x.
        nx: usize,
        /// Points along y.
        ny: usize,
    },
}

/// Fewest points along a side.
pub const FEWEST: usize = 16;
/// Most points along a profile.
pub const MOST: usize = 1_000_000;
/// Most points of a grid.
pub const POINTS: usize = 16_000_000;
/// Numbers of this size, in any unit, stand for points that were not measured.
const LARGEST: f64 = 1e10;
/// Largest deviation from uniform spacing of a profile's points, as a fraction of a step.
const UNEVEN: f64 = 0.02;

/// Whether text begins as heights do: with a spacing or a unit of heights, or with the columns of a profile.
pub fn begins_as_heights(text: &str) -> bool {
    let mut lines = text.trim_start_matches('\u{feff}').lines().map(str::trim).filter(|line| !line.is_empty());
    let key = |line: &str| line.strip_prefix('#').and_then(|line| Some(line.split_once('=')?.0.trim().to_owned()));
    let unit =
        |line: &str| key(line).is_some_and(|key| key == "height" || key.starts_with("dx_") || key.starts_with("dy_"));
    let head = lines.by_ref().take_while(|line| line.starts_with('#') || line.starts_with("x_"));
    head.into_iter()
        .any(|line| unit(line) || line.starts_with("x_") && cells(line).nth(1).is_some_and(|z| z.starts_with("z_")))
}

/// Metres in a unit.
fn metres(unit: &str) -> Option<f64> {
    [("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6), ("nm", 1e-9)]
        .iter()
        .find(|(name, _)| *name == unit)
        .map(|(_, m)| *m)
}

fn cells(line: &str) -> impl Iterator<Item = &str> {
    let separators: &[char] = match line {
        _ if line.contains([';', '\t']) => &[';', '\t'],
        _ if line.contains(',') => &[','],
        _ => &[' '],
    };
    line.trim_end_matches(separators)
        .split(separators)
        .map(str::trim)
        .filter(move |cell| !cell.is_empty() || separators != [' '])
}

fn number(cell: &str, line: usize) -> Result<f64, HeightMapError> {
    let what = || {
        format!(
            "\"{}\" is not a number below {LARGEST:e}; points that were not measured have to be filled in",
            shown(cell)
        )
    };
    let value = cell.replace(',', ".").parse().ok().filter(|value: &f64| value.abs() < LARGEST);
    value.ok_or_else(|| HeightMapError::Line { line, what: what() })
}

/// The first characters of a cell, without invisible ones.
fn shown(cell: &str) -> String {
    cell.chars().filter(|c| !c.is_control()).take(20).collect()
}

impl HeightMap {
    /// Reads a face from text.
    ///
    /// # Errors
    /// [`HeightMapError`] with the line that is at fault.
    pub fn read(text: &str) -> Result<Self, HeightMapError> {
        let at = |line: usize, what: String| HeightMapError::Line { line, what };
        let mut spacing = [None, None];
        let mut unit = None;
        let mut profile: Option<[f64; 2]> = None;
        let (mut heights, mut places, mut nx, mut ny) = (Vec::new(), Vec::new(), 0, 0);
        for (line, words) in
            text.trim_start_matches('\u{feff}').lines().map(str::trim).enumerate().map(|(i, words)| (i + 1, words))
        {
            if words.is_empty() {
                continue;
            }
            if let Some(comment) = words.strip_prefix('#') {
                let Some((key, value)) = comment.split_once('=').map(|(key, value)| (key.trim(), value.trim())) else {
                    continue;
                };
                let allowed = || at(line, format!("{} = {}: allowed m, mm, um or nm", shown(key), shown(value)));
                let twice = || at(line, format!("{}: given twice", shown(key)));
                if key == "height" {
                    if unit.replace(metres(value).ok_or_else(allowed)?).is_some() {
                        return Err(twice());
                    }
                } else if let Some((axis, length)) = key.split_once('_').filter(|(axis, _)| ["dx", "dy"].contains(axis))
                {
                    let length = metres(length).ok_or_else(|| {
                        at(line, format!("{}: allowed dx_um, dx_mm, dx_nm, dx_m and dy_… likewise", shown(key)))
                    })?;
                    let step = number(value, line)? * length;
                    if step <= 0.0 {
                        return Err(at(line, format!("{key} = {value} is out of range: allowed above 0")));
                    }
                    if spacing[usize::from(axis == "dy")].replace(step).is_some() {
                        return Err(twice());
                    }
                }
                continue;
            }
            let begins = heights.is_empty() && profile.is_none();
            if begins && words.starts_with("z_") {
                let what = "x comes first: the columns of a profile are named like \"x_um,z_nm\"";
                return Err(at(line, what.to_owned()));
            }
            if begins && words.starts_with("x_") {
                let units: Vec<f64> = cells(words)
                    .zip(["x_", "z_"])
                    .filter_map(|(cell, prefix)| metres(cell.strip_prefix(prefix)?))
                    .collect();
                profile = match (units[..].try_into(), cells(words).count()) {
                    (Ok(units), 2) => Some(units),
                    _ => return Err(at(line, "the columns of a profile are named like \"x_um,z_nm\"".to_owned())),
                };
                continue;
            }
            let before = heights.len();
            for cell in cells(words) {
                heights.push(number(cell, line)?);
            }
            let here = heights.len() - before;
            if let Some([x, z]) = profile {
                if here != 2 {
                    return Err(at(line, format!("{here} numbers: expected 2, x and z")));
                }
                let height = heights.pop().unwrap_or(0.0) * z;
                places.push((line, heights.pop().unwrap_or(0.0) * x));
                heights.push(height);
            } else {
                if ny > 0 && here != nx {
                    return Err(at(line, format!("{here} heights: expected {nx}, as in the lines before")));
                }
                (nx, ny) = (here, ny + 1);
            }
            if heights.len() > POINTS {
                return Err(HeightMapError::Size { nx: heights.len(), ny: ny.max(1) });
            }
        }
        if profile.is_some() {
            return Self::profile(heights, &places);
        }
        let unit = unit.ok_or(HeightMapError::Missing("unit of the heights"))?;
        let spacing = match spacing {
            [Some(dx), Some(dy)] => [dx, dy],
            [None, _] => return Err(HeightMapError::Missing("spacing along x")),
            _ => return Err(HeightMapError::Missing("spacing along y")),
        };
        if nx.min(ny) < FEWEST {
            return Err(HeightMapError::Size { nx, ny });
        }
        heights.iter_mut().for_each(|height| *height *= unit);
        Ok(Self { nx, ny, spacing, heights })
    }

    fn profile(heights: Vec<f64>, places: &[(usize, f64)]) -> Result<Self, HeightMapError> {
        let nx = heights.len();
        let [(_, first), .., (_, last)] = places else { return Err(HeightMapError::Size { nx, ny: 1 }) };
        if !(FEWEST..=MOST).contains(&nx) {
            return Err(HeightMapError::Size { nx, ny: 1 });
        }
        let step = (last - first) / (nx - 1) as f64;
        for (i, (line, x)) in places.iter().enumerate() {
            if !(step > 0.0 && (x - first - i as f64 * step).abs() <= UNEVEN * step) {
                let what = "x has to rise by even steps; resample the profile".to_owned();
                return Err(HeightMapError::Line { line: *line, what });
            }
        }
        Ok(Self { nx, ny: 1, spacing: [step, step], heights })
    }

    /// x and y of a point, each from −1 to 1.
    fn place(&self, k: usize) -> [f64; 2] {
        let at = |i: usize, n: usize| if n > 1 { 2.0 * i as f64 / (n - 1) as f64 - 1.0 } else { 0.0 };
        [at(k % self.nx, self.nx), at(k / self.nx, self.ny)]
    }

    /// The heights less their least-squares polynomial of this degree in x and y: 0 removes the mean, 1 also the tilt, 2 also the
    /// curvature.
    pub fn levelled(&self, degree: usize) -> Self {
        let powers: Vec<[i32; 2]> = (0..=degree as i32)
            .flat_map(|whole| (0..=whole).map(move |y| [whole - y, y]))
            .filter(|[_, y]| self.ny > 1 || *y == 0)
            .collect();
        let terms = |k: usize| {
            let [x, y] = self.place(k);
            powers.iter().map(move |[i, j]| x.powi(*i) * y.powi(*j))
        };
        let count = powers.len();
        let mut matrix = nalgebra::DMatrix::<f64>::zeros(count, count);
        let mut right = nalgebra::DVector::<f64>::zeros(count);
        for (k, height) in self.heights.iter().enumerate() {
            for (a, ta) in terms(k).enumerate() {
                right[a] += ta * height;
                for (b, tb) in terms(k).enumerate() {
                    matrix[(a, b)] += ta * tb;
                }
            }
        }
        let fit = matrix.lu().solve(&right).unwrap_or_else(|| nalgebra::DVector::zeros(count));
        let form = |k: usize| terms(k).zip(&fit).map(|(term, factor)| term * factor).sum::<f64>();
        let heights = self.heights.iter().enumerate().map(|(k, height)| height - form(k)).collect();
        Self { heights, ..self.clone() }
    }
}
