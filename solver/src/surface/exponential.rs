//! Heights of summits that fall off as e^{−s}: what Greenwood and Williamson (1966) take for the highest tenth or so of real ones, because
//! the real area of contact and the number of contacts are then proportional to the load. Fₙ(u) = Γ(n + 1) e^{−u}.

use super::law::{Heights, Order};

pub(super) static HEIGHTS: Heights = Heights {
    name: "exponential",
    moment: |order, u| {
        // Γ(2), Γ(5/2) = ¾ √π, Γ(7/2) = 15/8 √π.
        let root = std::f64::consts::PI.sqrt();
        let gamma = match order {
            Order::One => 1.0,
            Order::ThreeHalves => 0.75 * root,
            Order::FiveHalves => 1.875 * root,
        };
        (gamma.ln() - u, -1.0)
    },
};
