//! Summits on both faces, which meet at their flanks too (J. A. Greenwood and J. H. Tripp, Proc. Inst. Mech. Eng. 185, 1970): the load
//! of paraboloids that miss each other by any distance, averaged over it.

use super::law::{Law, Order};
use std::f64::consts::{PI, SQRT_2};

pub(super) static LAW: Law = Law {
    name: "greenwood-tripp",
    order: Order::FiveHalves,
    stiffness: |summits| {
        let rough = summits.density * summits.radius * summits.rms;
        16.0 * SQRT_2 * PI / 15.0 * rough * rough * (summits.rms / summits.radius).sqrt() * summits.modulus
    },
};
