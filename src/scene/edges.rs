//! Moves an edge of a part of a ring's cross-section.
//!
//! An edge that two parts share moves in both. The rim, for example, stays on its lining, and no edit separates the parts of the ring.

use super::value::Value;
use std::ops::RangeInclusive;

/// Lengths that differ by less than this are taken for equal \[mm\].
const SAME: f64 = 1e-6;

/// Inner and outer radius, bottom and top of a part or support \[mm\].
pub fn lengths(part: &[Value]) -> Option<[f64; 4]> {
    let numbers: Vec<f64> = part.iter().filter_map(Value::as_number).collect();
    numbers.try_into().ok()
}

/// The name of a part; a support has none.
pub fn name(part: &[Value]) -> Option<&str> {
    part.first()?.as_text().filter(|name| !name.is_empty())
}

/// The [`lengths`] of a box on the inner edge of the innermost of `parts` \[mm\]; `None` if there is no part.
pub fn inner_edge(parts: &[Vec<Value>]) -> Option<[f64; 4]> {
    let boxes = parts.iter().filter_map(|part| lengths(part));
    let [inner, _, bottom, top] = boxes.min_by(|one, other| one[0].total_cmp(&other[0]))?;
    Some([inner, inner, bottom, top])
}

/// The edges that move together with the edge `which` of the part `number`, itself first. An edge is the index of a part and of one of its
/// [`lengths`].
fn together(parts: &[Vec<Value>], (number, which): (usize, usize)) -> Vec<(usize, usize)> {
    let mut edges = vec![(number, which)];
    let boxes: Vec<_> = parts.iter().map(|part| lengths(part)).collect();
    if let Some(own) = boxes.get(number).copied().flatten() {
        // The ends of the edge are heights if it is vertical, and radii if it is horizontal.
        let ends = (which + 2) % 4 / 2 * 2;
        let shared = |other: &[f64; 4]| {
            (other[which ^ 1] - own[which]).abs() < SAME
                && own[ends].max(other[ends]) + SAME < own[ends + 1].min(other[ends + 1])
        };
        edges.extend((0..parts.len()).filter(|i| boxes[*i].as_ref().is_some_and(shared)).map(|i| (i, which ^ 1)));
    }
    edges
}

/// The range \[mm\] in which an edge can be moved. At its ends one of the parts that the edge bounds is as thin as `step`.
pub fn reach(parts: &[Vec<Value>], edge: (usize, usize), step: f64) -> RangeInclusive<f64> {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for (part, side) in together(parts, edge) {
        match lengths(&parts[part]) {
            Some(lengths) if side % 2 == 1 => low = low.max(lengths[side - 1] + step),
            Some(lengths) => high = high.min(lengths[side + 1] - step),
            None => {}
        }
    }
    low..=high.max(low)
}

/// The parts with an edge at `to` \[mm\].
pub fn with_edge(parts: &[Vec<Value>], edge: (usize, usize), to: f64) -> Vec<Vec<Value>> {
    let mut edited = parts.to_vec();
    for (part, side) in together(parts, edge) {
        if let Some(length) = edited[part].iter_mut().filter(|value| value.as_number().is_some()).nth(side) {
            *length = Value::Number(to);
        }
    }
    edited
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn a_shared_edge_moves_in_both_parts_and_no_other() {
        let scene = Scene::motor().with([("rotor.model", "ring")]).unwrap();
        let Some(Value::Records(parts)) = scene.get("rotor.part") else { panic!("no parts") };
        let moved = |edge, to| -> Vec<(usize, usize)> {
            let edited = with_edge(&parts, edge, to);
            let boxes = parts.iter().zip(&edited).map(|(a, b)| (lengths(a).unwrap(), lengths(b).unwrap()));
            let changed =
                boxes.enumerate().flat_map(|(i, (a, b))| (0..4).filter(move |k| a[*k] != b[*k]).map(move |k| (i, k)));
            changed.collect()
        };
        // Lining under rim; rim beside flange, which end at the same height; flange beside body.
        assert_eq!(moved((0, 3), 0.2), [(0, 3), (1, 2)]);
        assert_eq!(moved((1, 2), 0.2), [(0, 3), (1, 2)]);
        assert_eq!(moved((1, 3), 1.5), [(1, 3)]);
        assert_eq!(moved((3, 1), 26.0), [(2, 0), (3, 1)]);
        assert_eq!(inner_edge(&parts), Some([24.9, 24.9, 0.75, 5.75]));
        assert_eq!(inner_edge(&[]), None);
        let lining = reach(&parts, (0, 3), 0.01);
        assert!((lining.start() - 0.01).abs() < 1e-9 && (lining.end() - 1.19).abs() < 1e-9, "{lining:?}");
        let rim = reach(&parts, (1, 1), 0.01);
        assert!((rim.start() - 28.31).abs() < 1e-9 && *rim.end() == f64::INFINITY, "{rim:?}");
    }
}
