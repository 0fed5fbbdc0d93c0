//! The legend: the names of the layers, and its place.

use super::description::{Legend, Panel};
use super::geometry::{along, clipped_line};
use super::layers::{Band, Layer, Line};
use super::placed::{Entry, LEADING, MAJOR, NOTE, Placed, SPACE, Sign, fills};
use super::svg::Rect;

/// Distance between names in a row.
const APART: f64 = 10.0;
/// Distance between the axes and a legend inside them.
const INSET: f64 = 4.0;
/// Greatest share of the plotting area that a legend inside may cover.
const MOST: f64 = 0.45;

/// The names of a panel that has a legend, in the order of its layers.
fn entries(panel: &Panel) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    let mut push = |sign: Sign, name: &str| {
        let entry = Entry { sign, name: name.to_owned() };
        if !name.trim().is_empty() && !entries.contains(&entry) {
            entries.push(entry);
        }
    };
    for layer in panel.layers.iter().filter(|_| panel.legend != Legend::None) {
        match layer {
            Layer::Line(Line { name, style, .. }) => push(Sign::Line(*style), name),
            Layer::Band(Band { name, colour, opacity, .. }) => push(Sign::Patch(*colour, *opacity), name),
            Layer::Points(points) => push(Sign::Point(points.marker, points.colour), &points.name),
            Layer::Categories(kinds) => {
                let used = |kind: usize| kinds.values.contains(&kind);
                let shown = kinds.kinds.iter().enumerate().filter(|(kind, _)| used(*kind));
                shown.for_each(|(_, (name, colour))| push(Sign::Patch(*colour, 1.0), name));
            }
            _ => {}
        }
    }
    entries
}

/// Decides where the legend goes, while the plotting area still has its corner at the origin. A legend inside is placed at once, a legend
/// above the axes when the area has its place.
pub(super) fn choose(placed: &mut Placed<'_>) {
    let entries = entries(placed.panel);
    if entries.is_empty() || placed.panel.legend != Legend::Auto || fills(placed.panel) {
        return;
    }
    let line = LEADING * NOTE;
    let (width, height) =
        (entries.iter().map(Entry::width).fold(0.0, f64::max) + 2.0 * SPACE, entries.len() as f64 * line + SPACE);
    let area = placed.rect;
    if width + 2.0 * INSET > area.width || width * height > MOST * area.width * area.height || height > area.height {
        return;
    }
    let drawn = drawn(placed, true);
    let (left, right) = (INSET, area.width - INSET - width);
    let (top, bottom) = (INSET, area.height - INSET - height);
    // Corners are tried first, then places along the sides, then any place.
    let heights = [top, bottom, 0.5 * (top + bottom), 0.25 * bottom + 0.75 * top, 0.75 * bottom + 0.25 * top];
    let places = [right, left, 0.5 * (left + right)].into_iter().flat_map(|x| heights.map(|y| [x, y]));
    let mut places: Vec<[f64; 2]> = places.collect();
    places.sort_by_key(|[_, y]| *y != top && *y != bottom);
    let free = places.into_iter().map(|[x, y]| Rect { x, y, width, height }).find(|rect| covered(rect, &drawn) == 0);
    if let Some(rect) = free {
        placed.legend_box = Some(rect);
        placed.legend = entries
            .into_iter()
            .enumerate()
            .map(|(i, entry)| (entry, [rect.x + SPACE, rect.y + 0.5 * SPACE + (i as f64 + 0.5) * line]))
            .collect();
    }
}

/// How many of the points are in or near a rectangle.
pub(super) fn covered(rect: &Rect, points: &[[f64; 2]]) -> usize {
    let near = 2.0;
    let wide =
        Rect { x: rect.x - near, y: rect.y - near, width: rect.width + 2.0 * near, height: rect.height + 2.0 * near };
    points.iter().filter(|point| wide.holds(**point)).count()
}

/// Points along everything that is drawn, close together; with those of marks if `marks`.
pub(super) fn drawn(placed: &Placed<'_>, marks: bool) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    let mut path = |line: &mut dyn Iterator<Item = [f64; 2]>| {
        for part in clipped_line(line, &placed.rect) {
            for pair in part.windows(2) {
                points.extend(along(pair[0], pair[1], 3.0));
            }
        }
    };
    let mut single = Vec::new();
    for layer in &placed.panel.layers {
        match layer {
            Layer::Line(line) => path(&mut line.points.iter().map(|p| placed.at(*p, line.right))),
            Layer::Band(band) => {
                for [x, low, high] in &band.points {
                    path(&mut [*low, *high].map(|end| placed.at([*x, end], false)).into_iter());
                }
            }
            Layer::Points(cloud) => {
                for (i, [x, value]) in cloud.points.iter().enumerate() {
                    let error = cloud.error(i);
                    single.push(placed.at([*x, *value], false));
                    path(&mut [value - error, value + error].map(|end| placed.at([*x, end], false)).into_iter());
                }
            }
            Layer::Mark(mark) if marks => {
                path(&mut placed.mark_ends(mark).into_iter());
            }
            _ => {}
        }
    }
    points.extend(single);
    points
}

/// The names in rows that are as wide as the plotting area.
fn in_rows(entries: Vec<Entry>, width: f64) -> Vec<Vec<(Entry, f64)>> {
    let mut rows: Vec<Vec<(Entry, f64)>> = Vec::new();
    let mut x = 0.0;
    for entry in entries {
        let wide = entry.width();
        match rows.last_mut() {
            Some(row) if x + wide <= width => row.push((entry, x)),
            _ => {
                x = 0.0;
                rows.push(vec![(entry, 0.0)]);
            }
        }
        x += wide + APART;
    }
    rows
}

/// Height that a legend above the axes takes.
pub(super) fn height(placed: &Placed<'_>) -> f64 {
    if placed.legend_box.is_some() {
        return 0.0;
    }
    let rows = in_rows(entries(placed.panel), placed.rect.width).len();
    rows as f64 * LEADING * NOTE + if rows > 0 { 2.5 } else { 0.0 }
}

/// Places the legend now that the plotting area has its place.
pub(super) fn place(placed: &mut Placed<'_>) {
    let area = placed.rect;
    if let Some(rect) = &mut placed.legend_box {
        rect.x += area.x;
        rect.y += area.y;
        for (_, at) in &mut placed.legend {
            *at = [at[0] + area.x, at[1] + area.y];
        }
        return;
    }
    let rows = in_rows(entries(placed.panel), area.width);
    let (count, line) = (rows.len(), LEADING * NOTE);
    for (i, row) in rows.into_iter().enumerate() {
        let y = area.y - MAJOR - (count - i) as f64 * line + 0.5 * line;
        placed.legend.extend(row.into_iter().map(|(entry, x)| (entry, [area.x + x, y])));
    }
}
