//! Where a search starts: points spread over the unit cube, and the best of them.

/// Most starts of a search.
pub const MOST_STARTS: u16 = 10_000;
/// Most starts that are refined, in addition to the scene's own values.
const REFINED: usize = 3;
/// Least distance between starts in at least one direction: closer starts would lead to the same minimum.
const APART: f64 = 0.2;

/// `count` points that fill the unit cube evenly: the additive recurrence whose step is the generalised golden ratio, the root of φ^(d+1) =
/// φ + 1 (M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018). The points are the same every time.
pub(super) fn spread(dimensions: usize, count: usize) -> Vec<Vec<f64>> {
    let mut ratio = 2.0_f64;
    for _ in 0..64 {
        ratio = (1.0 + ratio).powf(1.0 / (dimensions as f64 + 1.0));
    }
    let point = |i: usize| {
        let along = |k: usize| (0.5 + i as f64 * ratio.powi(-(k as i32 + 1))).fract();
        (0..dimensions).map(along).collect()
    };
    (1..=count).map(point).collect()
}

/// The points with the least values, not too close to each other, best first: these are refined.
pub(super) fn best(mut judged: Vec<(f64, Vec<f64>)>) -> Vec<Vec<f64>> {
    judged.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut chosen: Vec<Vec<f64>> = Vec::new();
    for (_, point) in judged {
        if chosen.len() < REFINED && chosen.iter().all(|other| distance(other, &point) > APART) {
            chosen.push(point);
        }
    }
    chosen
}

/// The greatest difference between the coordinates of two points.
pub(super) fn distance(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_refined_is_good_and_apart() {
        let judged = [(2.0, 0.5), (1.0, 0.1), (1.1, 0.15), (3.0, 0.9), (1.2, 0.2), (9.0, 0.7)];
        let chosen = best(judged.map(|(cost, x)| (cost, vec![x, 0.5])).to_vec());
        assert_eq!(chosen.iter().map(|point| point[0]).collect::<Vec<_>>(), [0.1, 0.5, 0.9]);
    }

    #[test]
    fn every_part_of_the_cube_has_its_share_of_points() {
        for dimensions in 1..=4 {
            let points = spread(dimensions, 400);
            for k in 0..dimensions {
                for tenth in 0..10 {
                    let inside = points.iter().filter(|point| (point[k] * 10.0) as usize == tenth).count();
                    assert!((30..=50).contains(&inside), "{dimensions} {k} {tenth}: {inside}");
                }
            }
        }
        let both = spread(2, 400).iter().filter(|point| point[0] < 0.5 && point[1] < 0.5).count();
        assert!((94..=106).contains(&both), "{both}");
    }
}
