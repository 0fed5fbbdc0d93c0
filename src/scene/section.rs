//! The cross-section of a ring as arrays of tables, in millimetres: its parts, and where it is held.
//!
//! ```toml
//! [rotor]
//! model = "ring"
//!
//! [[rotor.part]]
//! name = "flange"
//! r_inner_mm = 26.0
//! r_outer_mm = 29.5
//! z_bottom_mm = 1.0
//! z_top_mm = 1.5
//! material = "aluminium"
//!
//! [[rotor.support]]
//! r_inner_mm = 26.0
//! r_outer_mm = 26.0
//! z_bottom_mm = 1.0
//! z_top_mm = 1.5
//! fixed = "axial"
//! ```
//!
//! Radii are measured from the ring's axis. Heights grow away from the stator, which touches the lowest faces of the ring; their zero is
//! arbitrary.

use super::parameter::Belongs::Motor;
use super::parameter::{Parameter, Scale, choice, names, number, text};
use super::value::Value;
use crate::digits::as_given;
use crate::rotor::ring::MATERIALS;

/// The directions that a support may hold, and their combinations.
const FIXED: [&str; 7] =
    ["axial", "radial", "circumferential", "axial-radial", "axial-circumferential", "radial-circumferential", "all"];

/// The keys of a part.
pub(super) static PART: [Parameter; 6] = [
    text("name", "", "The name that messages and drawings use"),
    length("r_inner_mm", 0.05, "Inner radius").named("Inner radius"),
    length("r_outer_mm", 0.05, "Outer radius").named("Outer radius"),
    length("z_bottom_mm", -1000.0, "Height of its lower face").named("Bottom"),
    length("z_top_mm", -1000.0, "Height of its upper face").named("Top"),
    choice("material", Motor, names!(MATERIALS), "aluminium", "What it is made of").named("Material"),
];

/// The keys of a support.
pub(super) static SUPPORT: [Parameter; 5] = [
    length("r_inner_mm", 0.0, "Inner radius of the box").named("Inner radius"),
    length("r_outer_mm", 0.0, "Outer radius of the box").named("Outer radius"),
    length("z_bottom_mm", -1000.0, "Height of its lower edge").named("Bottom"),
    length("z_top_mm", -1000.0, "Height of its upper edge").named("Top"),
    choice("fixed", Motor, &FIXED, "axial", "Directions in which what lies in the box cannot move").named("Fixed"),
];

/// From the contact radius to either side of the default rim \[mm\].
const RIM: f64 = 0.7;
/// Radial width of the default flange \[mm\].
const FLANGE: f64 = 1.4;
/// Radial width of the default body \[mm\].
const BODY: f64 = 2.0;
/// The rim is wider than the lining by this much at least, on either side \[mm\].
const EDGE: f64 = 0.2;
/// Smallest inner radius of a lining \[mm\].
const INNERMOST: f64 = 0.2;

/// The default parts: a section plausible for the rotor of a camera lens. It is an aluminium ring with a rim on a thin flange, and a plastic
/// lining on the rim. Flange and lining are chosen so that the compliance is close to that of the beam fitted to Table I (docs/theory.md,
/// section 4).
pub(super) fn parts() -> Vec<Vec<Value>> {
    parts_at(29.0, 0.3)
}

/// The default parts moved to a contact of this radius and width \[mm\]. The lining is as wide as the contact, and the rim wider. Where they would take
/// more than half of the room towards the axis, rim, flange and body are narrower.
pub(super) fn parts_at(radius: f64, width: f64) -> Vec<Vec<Value>> {
    let half = 0.5 * width;
    let (inner, outer) = ((radius - half).max(INNERMOST), radius + half);
    let scale = (0.5 * inner / (RIM + FLANGE + BODY)).min(1.0);
    let beside = (scale * RIM - half).max(scale * EDGE);
    let [rim, flange, body] = [0.0, FLANGE, FLANGE + BODY].map(|within| inner - beside - scale * within);
    let part = |name: &str, radii: [f64; 2], heights: [f64; 2], material: &str| {
        let [name, material] = [name, material].map(|text| Value::Text(text.to_owned()));
        let [radii, heights] = [radii.map(as_given), heights].map(|ends| ends.map(Value::Number));
        [&[name][..], &radii, &heights, &[material]].concat()
    };
    vec![
        part("lining", [inner, outer], [0.0, 0.145], "peek"),
        part("rim", [rim, outer + beside], [0.145, 1.2], "aluminium"),
        part("flange", [flange, rim], [0.75, 1.2], "aluminium"),
        part("body", [body, flange], [0.75, 5.75], "aluminium"),
    ]
}

const fn length(key: &'static str, min: f64, about: &'static str) -> Parameter {
    let slider = (if min < 0.0 { -20.0 } else { min }, 60.0);
    number(key, "mm", Motor, (min, 1000.0), slider, Scale::Linear, 1.0, about)
}
