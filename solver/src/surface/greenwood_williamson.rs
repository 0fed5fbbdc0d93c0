//! Spherical summits against a smooth plane (J. A. Greenwood and J. B. P. Williamson, Proc. R. Soc. Lond. A 295, 1966): each is pressed
//! in by Hertz's 4/3 E* √R w^{3/2}.

use super::law::{Law, Order};

pub(super) static LAW: Law = Law {
    name: "greenwood-williamson",
    order: Order::ThreeHalves,
    stiffness: |summits| 4.0 / 3.0 * summits.modulus * summits.density * summits.radius.sqrt() * summits.rms.powf(1.5),
};
