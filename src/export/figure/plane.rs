//! Fields over a plane as pictures: from nodes to pixels.

use super::colour::{Colour, Colours};
use super::error::Pixels;
use super::layers::{Categories, Grid, Map, Shading};
use super::scale::Scaled;
use super::svg::{Raster, Rect};

/// Pixels per point in print: 300 per inch.
pub const PRINT: f64 = 300.0 / 72.0;
/// Greatest number of pixels along a side.
const MOST: f64 = 4000.0;

/// Whether the numbers of nodes and values agree, and the nodes ascend.
pub(super) fn fits(x: &[f64], y: &[f64], values: usize) -> bool {
    let ascends = |nodes: &[f64]| nodes.iter().all(|v| v.is_finite()) && nodes.windows(2).all(|w| w[0] < w[1]);
    !x.is_empty() && !y.is_empty() && x.len().checked_mul(y.len()) == Some(values) && ascends(x) && ascends(y)
}

/// The ends of the area that the nodes cover: the first and last node, or half a cell beyond them.
pub(super) fn ends(nodes: &[f64], cells: bool, log: bool) -> Vec<f64> {
    let ([first, second, ..], [.., before, last]) = (nodes, nodes) else { return nodes.to_vec() };
    if !cells {
        return vec![*first, *last];
    }
    if log && *first > 0.0 {
        return vec![first * (first / second).sqrt(), last * (last / before).sqrt()];
    }
    vec![first - 0.5 * (second - first), last + 0.5 * (last - before)]
}

/// For each of `count` pixels along an axis: the node below and the weight of the next; none outside.
fn places(nodes: &[f64], axis: &Scaled, count: usize, shading: Shading, flipped: bool) -> Vec<Option<(usize, f64)>> {
    let at: Vec<f64> = nodes.iter().map(|node| axis.fraction(*node)).collect();
    let (Some(first), Some(last)) = (at.first().copied(), at.last().copied()) else { return vec![None; count] };
    let place = |i: usize| {
        let f = (i as f64 + 0.5) / count as f64;
        let f = if flipped { 1.0 - f } else { f };
        if at.len() == 1 {
            // A single line of values fills its axis.
            return Some((0, 0.0));
        }
        let right = at.partition_point(|node| *node <= f);
        if shading == Shading::Smooth && (f < first || f > last) {
            return None;
        }
        let right = right.clamp(1, at.len() - 1);
        let weight = (f - at[right - 1]) / (at[right] - at[right - 1]);
        match shading {
            Shading::Smooth => Some((right - 1, weight.clamp(0.0, 1.0))),
            Shading::Cells if (-0.5..=1.5).contains(&weight) => Some((right - 1 + usize::from(weight >= 0.5), 0.0)),
            Shading::Cells => None,
        }
    };
    (0..count).map(place).collect()
}

/// Pixels of a rectangle, row by row; `colour` gives the colour at the positions along x and y of each.
fn paint(
    rect: &Rect,
    axes: [(&[f64], &Scaled); 2],
    shading: Shading,
    colour: impl Fn((usize, f64), (usize, f64)) -> Option<Colour>,
) -> Raster {
    let size = [rect.width, rect.height].map(|length| (length * PRINT).round().clamp(1.0, MOST) as usize);
    let [(x, x_axis), (y, y_axis)] = axes;
    let columns = places(x, x_axis, size[0], shading, false);
    let rows = places(y, y_axis, size[1], shading, true);
    let mut rgb = Vec::with_capacity(3 * size[0] * size[1]);
    for row in &rows {
        for column in &columns {
            let found = column.zip(*row).and_then(|(column, row)| colour(column, row));
            let Colour(r, g, b) = found.unwrap_or(Colour::WHITE);
            rgb.extend([r, g, b]);
        }
    }
    let [width, height] = size.map(|count| count as u32);
    Raster { rect: *rect, pixels: Pixels { width, height, rgb } }
}

/// The picture of a map; `None` if its nodes and values do not agree.
pub(super) fn map(map: &Map, rect: &Rect, x: &Scaled, y: &Scaled, range: &Scaled) -> Option<Raster> {
    let Grid { x: xs, y: ys, values } = &map.grid;
    if !fits(xs, ys, values.len()) {
        return None;
    }
    let ny = ys.len();
    let finite = |value: f64| if value.is_finite() { range.fraction(value) } else { f64::NAN };
    let fractions: Vec<f64> = values.iter().map(|value| finite(*value)).collect();
    let at = |i: usize, (j, weight): (usize, f64)| {
        let value = fractions[i * ny + j];
        if weight > 0.0 { value + weight * (fractions[i * ny + j + 1] - value) } else { value }
    };
    Some(paint(rect, [(xs, x), (ys, y)], map.shading, |(i, weight), row| {
        let near = at(i, row);
        let value = if weight > 0.0 { near + weight * (at(i + 1, row) - near) } else { near };
        (!value.is_nan()).then(|| map.colours.at(value))
    }))
}

/// The picture of categories; `None` if nodes and values do not agree.
pub(super) fn categories(kinds: &Categories, rect: &Rect, x: &Scaled, y: &Scaled) -> Option<Raster> {
    if !fits(&kinds.x, &kinds.y, kinds.values.len()) {
        return None;
    }
    let ny = kinds.y.len();
    Some(paint(rect, [(&kinds.x, x), (&kinds.y, y)], Shading::Cells, |(i, _), (j, _)| {
        kinds.kinds.get(kinds.values[i * ny + j]).map(|(_, colour)| *colour)
    }))
}

/// The picture of a colour bar, from left to right or from bottom to top.
pub(super) fn bar(colours: Colours, rect: &Rect, upright: bool) -> Raster {
    let count = 256;
    let mut ramp: Vec<Colour> = (0..count).map(|i| colours.at((f64::from(i) + 0.5) / f64::from(count))).collect();
    if upright {
        ramp.reverse();
    }
    let (width, height) = if upright { (1, count) } else { (count, 1) };
    let rgb = ramp.into_iter().flat_map(|Colour(r, g, b)| [r, g, b]).collect();
    Raster { rect: *rect, pixels: Pixels { width, height, rgb } }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::figure::axis::Scale;

    const UNIT: Scaled = Scaled { from: 0.0, to: 1.0, scale: Scale::Linear };
    const RECT: Rect = Rect { x: 0.0, y: 0.0, width: 24.0, height: 12.0 };

    fn pixel(picture: &Raster, x: f64, y: f64) -> Colour {
        let Pixels { width, height, rgb } = &picture.pixels;
        let (i, j) = ((x * f64::from(*width)) as usize, ((1.0 - y) * f64::from(*height)) as usize);
        let at = 3 * (j * *width as usize + i);
        Colour(rgb[at], rgb[at + 1], rgb[at + 2])
    }

    #[test]
    fn a_field_runs_from_node_to_node_and_stops_at_what_is_unknown() {
        let grid = Grid { x: vec![0.0, 0.2, 1.0], y: vec![0.0, 1.0], values: vec![0.0, 0.0, 1.0, 1.0, f64::NAN, 1.0] };
        let field = Map { grid, ..Map::default() };
        let picture = map(&field, &RECT, &UNIT, &UNIT, &UNIT).unwrap();
        assert_eq!([picture.pixels.width, picture.pixels.height], [100, 50]);
        assert_eq!(pixel(&picture, 0.105, 0.5), Colours::Field.at(0.525));
        assert_eq!(pixel(&picture, 0.6, 0.5), Colour::WHITE);
        // Between nodes along y as well.
        let grid = Grid { x: vec![0.0, 1.0], y: vec![0.0, 1.0], values: vec![0.2, 0.6, 0.2, 0.6] };
        let upright = map(&Map { grid, ..Map::default() }, &RECT, &UNIT, &UNIT, &UNIT).unwrap();
        assert_eq!(pixel(&upright, 0.5, 0.25), Colours::Field.at(0.2 + 0.4 * 0.25));
        let cells = Map { shading: Shading::Cells, ..field };
        let picture = map(&cells, &RECT, &UNIT, &UNIT, &UNIT).unwrap();
        assert_eq!(pixel(&picture, 0.05, 0.2), Colours::Field.at(0.0));
        assert_eq!(pixel(&picture, 0.15, 0.2), Colours::Field.at(1.0));
        assert_eq!(pixel(&picture, 0.9, 0.2), Colour::WHITE);
        assert_eq!(pixel(&picture, 0.9, 0.8), Colours::Field.at(1.0));
    }

    #[test]
    fn what_does_not_fit_is_not_drawn() {
        let grid = Grid { x: vec![0.0, 1.0], y: vec![0.0], values: vec![1.0] };
        assert!(map(&Map { grid, ..Map::default() }, &RECT, &UNIT, &UNIT, &UNIT).is_none());
        let grid = Grid { x: vec![1.0, 0.0], y: vec![0.0], values: vec![1.0, 2.0] };
        assert!(map(&Map { grid, ..Map::default() }, &RECT, &UNIT, &UNIT, &UNIT).is_none());
        assert!(categories(&Categories::default(), &RECT, &UNIT, &UNIT).is_none());
    }

    #[test]
    fn cells_reach_half_a_cell_beyond() {
        assert_eq!(ends(&[1.0, 2.0, 4.0], true, false), [0.5, 5.0]);
        assert_eq!(ends(&[1.0, 4.0], true, true), [0.5, 8.0]);
        assert_eq!(ends(&[1.0, 4.0], false, true), [1.0, 4.0]);
        assert_eq!(ends(&[3.0], true, true), [3.0]);
        assert!(ends(&[], true, true).is_empty());
    }
}
