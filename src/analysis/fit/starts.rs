//! Where a search starts: points spread over the unit cube, and the best of them.

/// Most starts of a search.
pub const MOST_STARTS: u16 = 10_000;
/// Starts that are refined, beside that of the scene's own values.
const REFINED: usize = 3;

/// `count` points that fill the unit cube of so many dimensions evenly: the additive recurrence whose step is the generalised golden
/// ratio, the root of φ^(d+1) = φ + 1 (M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018). The same ones every time.
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

/// The points with the least numbers, best first: those that are refined.
pub(super) fn best(mut judged: Vec<(f64, Vec<f64>)>) -> Vec<Vec<f64>> {
    judged.sort_by(|a, b| a.0.total_cmp(&b.0));
    judged.into_iter().take(REFINED).map(|(_, point)| point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

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
