//! Clipping of lines and areas to the axes, and lines of equal value, in points on paper.

use super::svg::Rect;
use std::collections::BTreeMap;

/// Points closer than this \[pt\] to the one before are left out of a line.
const RESOLUTION: f64 = 0.04;
/// Greatest distance of a point from the paper \[pt\].
const FARTHEST: f64 = 1e9;

/// The parts of a line inside `rect`. A NaN point interrupts the line.
pub(super) fn clipped_line(points: impl Iterator<Item = [f64; 2]>, rect: &Rect) -> Vec<Vec<[f64; 2]>> {
    let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut part: Vec<[f64; 2]> = Vec::new();
    let mut last: Option<[f64; 2]> = None;
    for point in points {
        if point.iter().any(|c| c.is_nan()) {
            parts.push(std::mem::take(&mut part));
            last = None;
            continue;
        }
        let point = point.map(|c| c.clamp(-FARTHEST, FARTHEST));
        let Some(before) = last.replace(point) else { continue };
        let Some((from, to)) = clipped_segment(before, point, rect) else { continue };
        let joined = part.last().is_some_and(|end| distance(*end, from) < 1e-6);
        if !joined {
            parts.push(std::mem::take(&mut part));
            part.push(from);
        }
        part.push(to);
    }
    parts.push(part);
    parts.into_iter().filter(|part| part.len() > 1).map(|part| thinned(&part)).collect()
}

/// The line without points that lie too close to the one before; the ends stay.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        let end = i == 0 || i + 1 == points.len();
        if end || kept.last().is_none_or(|last| distance(*last, *point) >= RESOLUTION) {
            kept.push(*point);
        }
    }
    kept
}

pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Points from `a` to `b`, both included, at a distance of at most `apart`.
pub(super) fn along(a: [f64; 2], b: [f64; 2], apart: f64) -> impl Iterator<Item = [f64; 2]> {
    let steps = (distance(a, b) / apart).ceil().max(1.0);
    (0..=steps as usize).map(move |i| [0, 1].map(|k| a[k] + i as f64 / steps * (b[k] - a[k])))
}

/// The part of a segment inside `rect` (Liang and Barsky 1984).
fn clipped_segment(a: [f64; 2], b: [f64; 2], rect: &Rect) -> Option<([f64; 2], [f64; 2])> {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let sides = [(-dx, a[0] - rect.x), (dx, rect.right() - a[0]), (-dy, a[1] - rect.y), (dy, rect.bottom() - a[1])];
    for (p, q) in sides {
        if p == 0.0 {
            // The line is parallel to this side, and on its wrong side; what is on the side except for rounding counts as inside.
            if q < -1e-6 {
                return None;
            }
        } else if p < 0.0 {
            enter = enter.max(q / p);
        } else {
            leave = leave.min(q / p);
        }
    }
    if enter > leave {
        return None;
    }
    let at = |t: f64| match t {
        0.0 => a,
        1.0 => b,
        t => [a[0] + t * dx, a[1] + t * dy],
    };
    Some((at(enter), at(leave)))
}

/// The part of an area inside `rect` (Sutherland and Hodgman 1974).
pub(super) fn clipped_area(points: &[[f64; 2]], rect: &Rect) -> Vec<[f64; 2]> {
    let mut area: Vec<[f64; 2]> = points.iter().map(|point| point.map(|c| c.clamp(-FARTHEST, FARTHEST))).collect();
    // A side: which coordinate, its value, and the direction of the inside.
    for (axis, at, sign) in [(0, rect.x, 1.0), (0, rect.right(), -1.0), (1, rect.y, 1.0), (1, rect.bottom(), -1.0)] {
        let depth = |point: &[f64; 2]| sign * (point[axis] - at);
        let mut inside = Vec::with_capacity(area.len() + 4);
        for i in 0..area.len() {
            let (a, b) = (area[i], area[(i + 1) % area.len()]);
            let (da, db) = (depth(&a), depth(&b));
            if da >= 0.0 {
                inside.push(a);
            }
            if (da >= 0.0) != (db >= 0.0) {
                let t = da / (da - db);
                inside.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
            }
        }
        area = inside;
    }
    thinned(&area)
}

/// Least distance of a contour from either end of the range, as a share of the range.
const NEAR_END: f64 = 0.02;

/// Whether a value at this fraction of the range of a map gets a contour: near an end the contour would follow the error, not the field.
pub(crate) fn is_contour(fraction: f64) -> bool {
    (NEAR_END..=1.0 - NEAR_END).contains(&fraction)
}

/// The contours on which values at the nodes `x` × `y` (`[ix][iy]`) equal `level`, each in one piece. Cells with a NaN value have none.
pub(crate) fn contour(x: &[f64], y: &[f64], values: &[f64], level: f64) -> Vec<Vec<[f64; 2]>> {
    let (nx, ny) = (x.len(), y.len());
    if nx < 2 || ny < 2 || values.len() != nx * ny {
        return Vec::new();
    }
    // An edge is identified by its lower node and its direction; every edge joins at most two pieces of a line.
    let mut places: BTreeMap<Edge, [f64; 2]> = BTreeMap::new();
    let mut joined: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
    for i in 0..nx - 1 {
        for j in 0..ny - 1 {
            for (a, b) in crossings(values, ny, i, j, level) {
                for (from, to) in [(a, b), (b, a)] {
                    places.entry(from).or_insert_with(|| from.place(x, y, values, level));
                    joined.entry(from).or_default().push(to);
                }
            }
        }
    }
    let mut lines = Vec::new();
    // Open lines are joined first, from their ends; the remaining ones are closed.
    let ends: Vec<Edge> = joined.iter().filter(|(_, to)| to.len() == 1).map(|(edge, _)| *edge).collect();
    let all: Vec<Edge> = joined.keys().copied().collect();
    for start in ends.into_iter().chain(all) {
        let mut line = Vec::new();
        let mut at = start;
        while let Some(next) = joined.get_mut(&at).and_then(Vec::pop) {
            if line.is_empty() {
                line.push(places[&at]);
            }
            if let Some(back) = joined.get_mut(&next)
                && let Some(index) = back.iter().position(|edge| *edge == at)
            {
                back.swap_remove(index);
            }
            line.push(places[&next]);
            at = next;
        }
        if line.len() > 1 {
            lines.push(line);
        }
    }
    lines
}

/// A grid edge from node `(i, j)` along x or y.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Edge {
    i: usize,
    j: usize,
    along_x: bool,
}

impl Edge {
    fn place(self, x: &[f64], y: &[f64], values: &[f64], level: f64) -> [f64; 2] {
        let Self { i, j, along_x } = self;
        let ny = y.len();
        let a = values[i * ny + j];
        let b = if along_x { values[(i + 1) * ny + j] } else { values[i * ny + j + 1] };
        let t = if b == a { 0.5 } else { ((level - a) / (b - a)).clamp(0.0, 1.0) };
        if along_x { [x[i] + t * (x[i + 1] - x[i]), y[j]] } else { [x[i], y[j] + t * (y[j + 1] - y[j])] }
    }
}

/// The pieces of line in the cell above node `(i, j)`: pairs of its edges (marching squares; a saddle is decided by the
/// mean of its corners).
fn crossings(values: &[f64], ny: usize, i: usize, j: usize, level: f64) -> Vec<(Edge, Edge)> {
    let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| values[i * ny + j]);
    if corners.iter().any(|value| !value.is_finite()) {
        return Vec::new();
    }
    let edge = |i: usize, j: usize, along_x: bool| Edge { i, j, along_x };
    let sides = [edge(i, j, true), edge(i + 1, j, false), edge(i, j + 1, true), edge(i, j, false)];
    let above = corners.map(|value| value >= level);
    let cut: Vec<Edge> = (0..4).filter(|k| above[*k] != above[(*k + 1) % 4]).map(|k| sides[k]).collect();
    match cut[..] {
        [a, b] => vec![(a, b)],
        [a, b, c, d] => {
            let middle = corners.iter().map(|value| value / 4.0).sum::<f64>() >= level;
            if middle == above[0] { vec![(a, b), (c, d)] } else { vec![(d, a), (b, c)] }
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECT: Rect = Rect { x: 0.0, y: 0.0, width: 10.0, height: 10.0 };

    #[test]
    fn a_line_is_cut_where_it_leaves() {
        let parts = clipped_line([[-5.0, 5.0], [5.0, 5.0], [5.0, 25.0], [15.0, 5.0]].into_iter(), &RECT);
        assert_eq!(parts, [vec![[0.0, 5.0], [5.0, 5.0], [5.0, 10.0]]]);
        let parts = clipped_line([[1.0, 1.0], [2.0, 2.0], [f64::NAN, 3.0], [4.0, 4.0], [5.0, 5.0]].into_iter(), &RECT);
        assert_eq!(parts.len(), 2);
        assert!(clipped_line([[f64::INFINITY, 1.0]].into_iter(), &RECT).is_empty());
        assert_eq!(clipped_line([[1.0, f64::NEG_INFINITY], [1.0, f64::INFINITY]].into_iter(), &RECT).len(), 1);
    }

    #[test]
    fn an_area_is_cut_where_it_leaves() {
        let area = clipped_area(&[[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]], &RECT);
        let sum: f64 = (0..area.len())
            .map(|i| {
                let (a, b) = (area[i], area[(i + 1) % area.len()]);
                0.5 * (a[0] * b[1] - b[0] * a[1])
            })
            .sum();
        assert!((sum.abs() - 25.0).abs() < 1e-9);
        assert!(clipped_area(&[[20.0, 20.0], [30.0, 20.0], [30.0, 30.0]], &RECT).is_empty());
    }

    #[test]
    fn contours_of_a_cone_are_closed_circles() {
        let nodes: Vec<f64> = (0..41).map(|i| f64::from(i) / 10.0 - 2.0).collect();
        let values: Vec<f64> = nodes.iter().flat_map(|x| nodes.iter().map(move |y| x.hypot(*y))).collect();
        let lines = contour(&nodes, &nodes, &values, 1.23);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        assert!(lines[0].iter().all(|p| (p[0].hypot(p[1]) - 1.23).abs() < 2e-3));
    }

    #[test]
    fn a_saddle_and_a_hole_do_not_confuse() {
        let nodes = [0.0, 1.0];
        assert_eq!(contour(&nodes, &nodes, &[1.0, 0.0, 0.0, 1.0], 0.5).len(), 2);
        assert!(contour(&nodes, &nodes, &[1.0, f64::NAN, 0.0, 1.0], 0.5).is_empty());
        assert!(contour(&nodes, &nodes, &[1.0; 4], 1.0).is_empty());
        assert!(contour(&nodes, &nodes, &[1.0; 3], 0.5).is_empty());
        assert!(contour(&[], &[], &[], 0.5).is_empty());
    }
}
