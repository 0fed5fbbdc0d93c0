//! Contours with their values written into them.

use super::geometry::{along, distance};
use super::style::Style;
use super::svg::{Svg, Type};
use super::text;

/// Size of the values \[pt\].
const SIZE: f64 = 7.0;
/// Distance between the points of a line that are tried as places for its value.
const STEP: f64 = 1.0;
/// Least distance of a value from other lines, relative to its size.
const CLEAR: f64 = 0.75;
/// A line gets a value only if it is at least this many times as long as the value.
const LONGER: f64 = 3.0;

/// One piece of a contour.
pub(super) struct Isoline {
    /// Points close together, and whether each was a point of the original line.
    points: Vec<([f64; 2], bool)>,
    label: String,
    style: Style,
}

impl Isoline {
    /// A line that carries a value.
    pub(super) fn new(line: Vec<[f64; 2]>, label: &str, style: Style) -> Self {
        let mut points = Vec::new();
        for pair in line.windows(2) {
            points.extend(along(pair[0], pair[1], STEP).enumerate().map(|(i, point)| (point, i == 0)));
            // The end of a segment is the beginning of the next one.
            points.pop();
        }
        points.extend(line.last().map(|last| (*last, true)));
        Self { points, label: label.to_owned(), style }
    }

    /// The stretch for the value: straight, clear of other lines and values, and as near the middle as possible.
    fn stretch(&self, index: usize, lines: &[Self], values: &[[f64; 2]]) -> Option<(usize, usize)> {
        let need = text::width(&self.label, SIZE) + 4.0;
        let length = |from: usize, to: usize| (to - from) as f64 * STEP;
        let count = self.points.len();
        if length(0, count) < LONGER * need {
            return None;
        }
        let span = (need / STEP).ceil() as usize;
        let mut places: Vec<(f64, usize)> = (0..count.saturating_sub(span))
            .step_by(3)
            .filter_map(|from| {
                let (a, b) = (self.points[from].0, self.points[from + span].0);
                let bent = 1.0 - distance(a, b) / length(from, from + span);
                let off = ((from as f64 + 0.5 * span as f64) / count as f64 - 0.5).abs();
                // A value along the page is preferred to one up the page, so that it can be read without turning the head.
                let steep = (b[1] - a[1]).abs() / distance(a, b).max(1e-9);
                (bent < 0.15).then_some((4.0 * bent + 0.3 * off + 0.3 * steep, from))
            })
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let free = |from: usize| {
            let (a, b) = (self.points[from].0, self.points[from + span].0);
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let others = lines.iter().enumerate().filter(|(other, _)| *other != index);
            values.iter().all(|value| distance(*value, middle) > 1.3 * need)
                && others.flat_map(|(_, line)| &line.points).all(|(p, _)| off_segment(*p, a, b) > CLEAR * SIZE)
        };
        places.into_iter().map(|(_, from)| from).take(150).find(|from| free(*from)).map(|from| (from, from + span))
    }

    /// The original points of the line, from one place to another, both included.
    fn between(&self, from: usize, to: usize) -> Vec<[f64; 2]> {
        let kept = |i: &usize| *i == from || *i == to || self.points[*i].1;
        (from..=to).filter(kept).map(|i| self.points[i].0).collect()
    }
}

/// Distance of a point from a segment.
fn off_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let square = dx * dx + dy * dy;
    let t = if square > 0.0 { (((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    distance(p, [a[0] + t * dx, a[1] + t * dy])
}

/// Draws lines, each with its value in a gap where there is room for it.
pub(super) fn draw(svg: &mut Svg, lines: &[Isoline]) {
    let mut values: Vec<[f64; 2]> = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let Some(last) = line.points.len().checked_sub(1) else { continue };
        let Some((from, to)) = line.stretch(index, lines, &values) else {
            svg.polyline(&line.between(0, last), &line.style);
            continue;
        };
        svg.polyline(&line.between(0, from), &line.style);
        svg.polyline(&line.between(to, last), &line.style);
        let (a, b) = (line.points[from].0, line.points[to].0);
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        values.push(middle);
        let mut angle = (b[1] - a[1]).atan2(b[0] - a[0]);
        if angle.cos() < 0.0 {
            angle += std::f64::consts::PI;
        }
        let (sin, cos) = angle.sin_cos();
        let drop = 0.35 * SIZE;
        let at = [middle[0] - drop * sin, middle[1] + drop * cos];
        let style = Type { colour: line.style.colour, angle: angle.to_degrees(), ..Type::new(SIZE, "middle") };
        svg.text(at, &line.label, &style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::figure::Colour;

    fn level(y: f64) -> Isoline {
        Isoline::new(vec![[0.0, y], [100.0, y]], "12", Style::solid(Colour::BLACK).width(0.7))
    }

    #[test]
    fn a_point_is_as_far_off_a_segment_as_off_its_nearest_point() {
        let (a, b) = ([1.0, 2.0], [4.0, 6.0]);
        for (p, distance) in [([2.5, 4.0], 0.0), ([-1.5, 7.0], 5.0), ([-2.0, -2.0], 5.0), ([7.0, 10.0], 5.0)] {
            assert!((off_segment(p, a, b) - distance).abs() < 1e-12, "{p:?}");
        }
        assert_eq!(off_segment([4.0, 6.0], a, a), 5.0);
    }

    #[test]
    fn a_value_stands_in_a_gap_of_its_own_width() {
        let mut svg = Svg::default();
        draw(&mut svg, &[level(10.0), level(40.0)]);
        assert_eq!((svg.body.matches("<polyline").count(), svg.body.matches(">12<").count()), (4, 2));
    }

    #[test]
    fn a_line_less_than_three_times_as_long_as_its_value_has_none() {
        let need = text::width("12", SIZE) + 4.0;
        for (times, values) in [(2.7, 0), (3.2, 1)] {
            let line = vec![[0.0, 10.0], [times * need, 10.0]];
            let mut svg = Svg::default();
            draw(&mut svg, &[Isoline::new(line, "12", Style::solid(Colour::BLACK).width(0.7))]);
            assert_eq!(svg.body.matches(">12<").count(), values, "{times}");
        }
    }

    #[test]
    fn there_is_no_value_where_lines_are_close() {
        let mut svg = Svg::default();
        draw(&mut svg, &[level(10.0), level(12.0)]);
        assert_eq!((svg.body.matches("<polyline").count(), svg.body.matches("<text").count()), (2, 0));
        draw(&mut svg, &[Isoline::new(Vec::new(), "1", Style::solid(Colour::BLACK).width(1.0))]);
    }
}
