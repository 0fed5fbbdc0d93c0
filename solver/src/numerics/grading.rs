//! Graded node positions that cluster at the ends of an interval or in its middle, by a smooth map.
//!
//! η ∈ [−1, 1] ↦ tanh(βη)/tanh β for β > 0: the spacing at the ends is 2β/sinh 2β times the uniform one. For β < 0,
//! sinh(βη)/sinh β: the spacing in the middle is β/sinh β times the uniform one. The map is smooth and does not depend on the
//! number of nodes, so central differences on it keep their second order, and a grid of half as many intervals consists of
//! every other node.

/// β of the map whose end spacing is `ratio` times the uniform one; 0 (no grading) for `ratio` ≥ 1.
pub fn clustering(ratio: f64) -> f64 {
    0.5 * inverse(ratio)
}

/// β of the map whose spacing in the middle is `ratio` times the uniform one; 0 (no grading) for `ratio` ≥ 1.
pub fn middle_clustering(ratio: f64) -> f64 {
    -inverse(ratio)
}

/// s ≥ 0 with s/sinh s = `ratio`; 0 for `ratio` ≥ 1.
fn inverse(ratio: f64) -> f64 {
    if ratio >= 1.0 {
        return 0.0;
    }
    // s/sinh s falls monotonically from 1; 700 keeps sinh finite.
    let (mut low, mut high) = (0.0_f64, 700.0_f64);
    loop {
        let s = 0.5 * (low + high);
        if s <= low || s >= high {
            return s;
        }
        if s / s.sinh() > ratio { low = s } else { high = s }
    }
}

/// The map: η ∈ [−1, 1] to [−1, 1].
pub fn map(beta: f64, eta: f64) -> f64 {
    if beta.abs() < 1e-9 {
        eta
    } else if beta > 0.0 {
        (beta * eta).tanh() / beta.tanh()
    } else {
        (beta * eta).sinh() / beta.sinh()
    }
}

/// The derivative of the map at η.
pub fn slope(beta: f64, eta: f64) -> f64 {
    if beta.abs() < 1e-9 {
        1.0
    } else if beta > 0.0 {
        beta / ((beta * eta).cosh().powi(2) * beta.tanh())
    } else {
        beta * (beta * eta).cosh() / beta.sinh()
    }
}

/// `intervals + 1` nodes from −half to half \[m\], clustered as β says, symmetric to the last bit.
pub fn two_sided(half: f64, intervals: usize, beta: f64) -> Vec<f64> {
    (0..=intervals)
        .map(|i| {
            let eta = (2.0 * i as f64 - intervals as f64) / intervals as f64;
            half * map(beta, eta)
        })
        .collect()
}

/// `intervals + 1` nodes from 0 to half \[m\], clustered at `half`.
pub fn one_sided(half: f64, intervals: usize, beta: f64) -> Vec<f64> {
    (0..=intervals).map(|i| half * map(beta, i as f64 / intervals as f64)).collect()
}

/// Length that each node stands for: half of the intervals on either side (trapezoid weights), same unit as `nodes`.
pub fn node_lengths(nodes: &[f64]) -> Vec<f64> {
    let last = nodes.len() - 1;
    (0..=last).map(|i| 0.5 * (nodes[(i + 1).min(last)] - nodes[i.saturating_sub(1)])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn end_spacing_is_the_one_asked_for() {
        let intervals = 4000;
        let nodes = one_sided(1.0, intervals, clustering(0.1));
        let end = (nodes[intervals] - nodes[intervals - 1]) * intervals as f64;
        assert!((end - 0.1).abs() < 1e-3, "{end}");
    }

    #[test]
    fn middle_spacing_is_the_one_asked_for() {
        let intervals = 4000;
        let nodes = two_sided(0.5, intervals, middle_clustering(0.1));
        let middle = (nodes[intervals / 2 + 1] - nodes[intervals / 2]) * intervals as f64;
        assert!((middle - 0.1).abs() < 1e-3, "{middle}");
        assert_eq!((nodes[0], nodes[intervals], middle_clustering(2.0)), (-0.5, 0.5, 0.0));
        assert_eq!(one_sided(0.5, intervals / 2, middle_clustering(0.1))[..], nodes[intervals / 2..]);
    }

    #[test]
    fn a_grid_of_half_the_intervals_is_every_other_node() {
        let beta = clustering(0.03);
        let (fine, coarse) = (two_sided(2.0, 16, beta), two_sided(2.0, 8, beta));
        for (i, x) in coarse.iter().enumerate() {
            assert_eq!(*x, fine[2 * i]);
        }
        assert_eq!(clustering(1.5), 0.0);
        let total: f64 = node_lengths(&fine).iter().sum();
        assert!((total - 4.0).abs() < 1e-14);
    }
}
