//! Nodes, weights and derivatives of polynomials on [−1, 1] (Canuto and others, Spectral Methods, Springer 2006).

/// Nodes, ascending, and weights of the Gauss–Lobatto–Legendre rule with the ends and `order` − 1 nodes between them: exact for polynomials
/// up to degree 2 order − 1. `order` ≥ 1.
pub fn lobatto(order: usize) -> (Vec<f64>, Vec<f64>) {
    let n = order as f64;
    let mut nodes = vec![0.0; order + 1];
    for i in 0..=order / 2 {
        // Newton's method on (1 − x²) P′ₙ = n (Pₙ₋₁ − x Pₙ), whose slope is −n (n + 1) Pₙ.
        let mut x = -(std::f64::consts::PI * i as f64 / n).cos();
        for _ in 0..if i == 0 { 0 } else { 50 } {
            let (last, before) = legendre(order, x);
            let step = (before - x * last) / ((n + 1.0) * last);
            x += step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        if 2 * i == order {
            x = 0.0;
        }
        (nodes[i], nodes[order - i]) = (x, -x);
    }
    let weights = nodes.iter().map(|x| 2.0 / (n * (n + 1.0) * legendre(order, *x).0.powi(2))).collect();
    (nodes, weights)
}

/// Pₙ and Pₙ₋₁ at `x`, n ≥ 1.
fn legendre(order: usize, x: f64) -> (f64, f64) {
    let (mut before, mut last) = (1.0, x);
    for n in 1..order {
        let n = n as f64;
        (before, last) = (last, ((2.0 * n + 1.0) * x * last - n * before) / (n + 1.0));
    }
    (last, before)
}

/// Derivative matrix: slopes at `nodes` of the polynomial through the values at `nodes`, `[node][value]`. Rows add up to 0.
pub fn derivative(nodes: &[f64]) -> Vec<f64> {
    let count = nodes.len();
    let product = |i: usize| (0..count).filter(|k| *k != i).map(|k| nodes[i] - nodes[k]).product::<f64>();
    let products: Vec<f64> = (0..count).map(product).collect();
    let mut matrix = vec![0.0; count * count];
    for i in 0..count {
        for j in (0..count).filter(|j| *j != i) {
            let entry = products[i] / (products[j] * (nodes[i] - nodes[j]));
            matrix[i * count + j] = entry;
            matrix[i * count + i] -= entry;
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_and_differentiated_exactly() {
        for order in 1..24 {
            let (nodes, weights) = lobatto(order);
            for power in 0..2 * order as i32 {
                let sum: f64 = nodes.iter().zip(&weights).map(|(x, w)| w * x.powi(power)).sum();
                let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((sum - exact).abs() < 1e-13, "{order} {power}: {sum}");
            }
            let slopes = derivative(&nodes);
            for (row, x) in slopes.chunks_exact(order + 1).zip(&nodes) {
                let found: f64 = row.iter().zip(&nodes).map(|(d, x)| d * x.powi(order as i32)).sum();
                let exact = order as f64 * x.powi(order as i32 - 1);
                assert!((found - exact).abs() < 1e-10 * (order * order) as f64, "{order} {x}: {found} {exact}");
            }
        }
    }
}
