//! Series, maps and nodes of a recording in the form that figures draw.

use crate::export::figure::{Grid, Map, Mark, Range, Style, extent};
use crate::recording::Recording;

/// Least and greatest of the finite values and `including`.
pub(super) fn span(values: impl Iterator<Item = f64>, including: f64) -> [f64; 2] {
    extent(values.filter(|value| value.is_finite()).chain([including]))
}

/// A range with a margin at both ends; an end at zero stays there.
pub(super) fn with_margin([low, high]: [f64; 2], part: f64) -> [f64; 2] {
    let margin = part * (high - low);
    [if low == 0.0 { low } else { low - margin }, if high == 0.0 { high } else { high + margin }]
}

/// A thin line at zero or ambient.
pub(super) fn rest(at: f64, label: &str) -> Mark {
    Mark { style: Style::quiet().width(0.4), ..Mark::horizontal(at, label) }
}

/// Phase of a frame, t/T.
pub(super) fn phase(recording: &Recording, frame: usize) -> f64 {
    frame as f64 / recording.frames.max(1) as f64
}

/// A series of one value per frame as a closed curve over 0 ≤ t/T ≤ 1.
pub(super) fn over_cycle<'a>(series: &'a [f64], scale: f64) -> impl Iterator<Item = [f64; 2]> + 'a {
    let count = series.len();
    let at = move |i: usize| [i as f64 / count.max(1) as f64, series[i % count] * scale];
    (0..if count == 0 { 0 } else { count + 1 }).map(at)
}

/// A value at every node of every tooth at a frame, with gaps at the grooves. `metre` is the length of a metre on the axis.
pub(super) fn along(recording: &Recording, frame: usize, metre: f64, value: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for tooth in 0..recording.teeth {
        let line = recording.line_offset(tooth, frame);
        let middle = tooth as f64 * recording.pitch;
        points.extend(recording.x.iter().enumerate().map(|(i, xi)| [(middle + xi) * metre, value(line + i)]));
        points.push([f64::NAN; 2]);
    }
    points
}

/// As `along`, for a load: where a tooth does not touch, there is a gap rather than a line at zero.
pub(super) fn along_where_not_zero(
    recording: &Recording,
    frame: usize,
    metre: f64,
    value: impl Fn(usize) -> f64,
) -> Vec<[f64; 2]> {
    let mut points = along(recording, frame, metre, value);
    let teeth = points.split_mut(|[x, _]| !x.is_finite());
    teeth.filter(|tooth| tooth.iter().all(|[_, y]| *y == 0.0)).for_each(|tooth| tooth.fill([f64::NAN; 2]));
    points
}

/// The pressure map of tooth `tooth` at a frame, `[ix][iy]` as stored. If only the first tooth is stored, this is its map at the time when
/// it was in the same state, interpolated between frames if necessary.
pub(super) fn tooth_map(recording: &Recording, tooth: usize, frame: usize) -> Vec<f64> {
    let (frames, teeth) = (recording.frames.max(1), recording.teeth.max(1));
    let size = recording.map_x.len() * recording.map_y.len();
    let shift = tooth * frames;
    let (first, weight) = ((frame + shift / teeth) % frames, (shift % teeth) as f64 / teeth as f64);
    let plane = |frame: usize| recording.pressure.get(frame * size..(frame + 1) * size);
    match (plane(first), plane((first + 1) % frames)) {
        (Some(now), Some(next)) => now.iter().zip(next).map(|(a, b)| a + weight * (b - a)).collect(),
        _ => vec![f64::NAN; size],
    }
}

/// A plane of pressures, stored `[ix][iy]`, extended to both halves \[mm\]; `scale` converts from pascal.
pub(super) fn whole_plane(recording: &Recording, plane: &[f64], scale: f64) -> Grid {
    let x = mirrored(&recording.map_x, recording.half_length);
    let y = mirrored(&recording.map_y, recording.half_width);
    let ny = recording.map_y.len();
    let at = |i: usize, j: usize| plane.get(i * ny + j).map_or(f64::NAN, |p| p * scale);
    let values = x.iter().flat_map(|(_, i)| y.iter().map(move |(_, j)| (*i, *j))).map(|(i, j)| at(i, j)).collect();
    let millimetres = |nodes: Vec<(f64, usize)>| nodes.into_iter().map(|(node, _)| node * 1e3).collect();
    Grid { values, x: millimetres(x), y: millimetres(y) }
}

/// A map of absolute pressures in `unit`.
pub(super) fn pressure_map(grid: Grid, unit: &str, range: Range) -> Map {
    Map { label: "absolute pressure".to_owned(), unit: unit.to_owned(), grid, range, ..Map::default() }
}

/// Nodes over the whole width (or length) from those of one half, each with the index of the stored node.
pub(in crate::export) fn mirrored(nodes: &[f64], half: bool) -> Vec<(f64, usize)> {
    let all = nodes.iter().copied().enumerate();
    let stored = all.clone().map(|(i, node)| (node, i));
    if !half {
        return stored.collect();
    }
    all.rev().filter(|(_, node)| *node > 0.0).map(|(i, node)| (-node, i)).chain(stored).collect()
}
