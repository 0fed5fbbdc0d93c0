//! A measured face: its heights and their autocorrelation.

use super::unit::prefixed;
use crate::export::figure::{Axis, Colour, Figure, Grid, Line, Map, Mark, Panel, Provenance, Style};
use crate::surface::height_map::HeightMap;
use crate::surface::texture::Texture;

/// Greatest number of points of a map along a side.
const DRAWN: usize = 200;

/// The heights of a levelled face, and its autocorrelation.
pub fn figure(name: &str, map: &HeightMap, texture: &Texture) -> Figure {
    let (length_unit, length) = prefixed(map.nx as f64 * map.spacing[0], "m");
    let (height_unit, height) = prefixed(texture.peak_to_valley, "m");
    let heights = if map.ny > 1 {
        let step = [map.nx, map.ny].map(|points| points.div_ceil(DRAWN));
        let kept = |axis: usize| (0..[map.nx, map.ny][axis]).step_by(step[axis]);
        let place = |axis: usize| kept(axis).map(|i| i as f64 * map.spacing[axis] * length).collect();
        let values = kept(0).flat_map(|ix| kept(1).map(move |iy| map.heights[iy * map.nx + ix] * height)).collect();
        let colours = Map {
            label: "height".to_owned(),
            unit: height_unit,
            grid: Grid { x: place(0), y: place(1), values },
            ..Map::default()
        };
        Panel::new(
            "(a) heights",
            Axis::new("x, along the wave", length_unit.clone()),
            Axis::new("y", length_unit.clone()),
        )
        .layer(colours)
    } else {
        let step = map.nx.div_ceil(10 * DRAWN);
        let points = (0..map.nx).step_by(step).map(|i| [i as f64 * map.spacing[0] * length, map.heights[i] * height]);
        Panel::new("(a) heights", Axis::new("x", length_unit.clone()), Axis::new("height", height_unit))
            .layer(Line::new("", points, Style::solid(Colour::BLACK)))
    };
    let furthest =
        texture.autocorrelation.iter().filter_map(|curve| curve.last()).map(|(lag, _)| *lag).fold(0.0, f64::max);
    let (lag_unit, lag_scale) = prefixed(furthest, "m");
    let curves = texture.autocorrelation.iter().zip(["along x", "along y"]).enumerate();
    let curves = curves.filter(|(_, (curve, _))| !curve.is_empty()).map(|(index, (curve, name))| {
        Line::new(name, curve.iter().map(|(lag, value)| [lag * lag_scale, *value]), Style::nth(index))
    });
    let correlation = Panel::new("(b) autocorrelation", Axis::new("lag", lag_unit), Axis::new("autocorrelation", ""))
        .layer(Mark::horizontal(0.5, "½: correlation length"))
        .layers(curves);
    let caption = format!("Levelled heights of {name}, and their autocorrelation along both axes.");
    let figure = Figure { provenance: Provenance::named(name), caption, ..Figure::new(name) };
    figure.panel(heights).panel(correlation)
}
