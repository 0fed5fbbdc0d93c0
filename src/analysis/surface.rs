//! The faces of a motor by themselves: the contact pressure of their asperities and their flow factors, over the mean gap.

use crate::problem::Motor;
use crate::surface::Surface;

/// Points of a curve.
const POINTS: usize = 120;
/// Greatest separation of the contact curve, and of the flow curves, over σ.
const FURTHEST: [f64; 2] = [4.0, 8.0];

/// Curves over the mean gap; empty where the faces have no such law.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceCurves {
    /// `[mean gap [m], contact pressure [Pa]]`.
    pub contact: Vec<[f64; 2]>,
    /// `[film thickness [m], flow along x, flow across]`, as multiples of that between smooth faces.
    pub flow: Vec<[f64; 3]>,
    /// Mean gap \[m\] and pressure \[Pa\] if the load is spread evenly over the tooth tops.
    pub even: Option<[f64; 2]>,
}

impl SurfaceCurves {
    /// The curves for the faces of a motor.
    pub fn of(motor: &Motor) -> Self {
        let Surface { asperities, flow } = motor.surface;
        let share = |i: usize| i as f64 / (POINTS - 1) as f64;
        let contact = asperities.map_or_else(Vec::new, |law| {
            let reach = FURTHEST[0] * law.summits().rms;
            (0..POINTS).map(|i| share(i) * reach).map(|d| [law.mean_gap(d).0, law.pressure(d).0]).collect()
        });
        let flow = flow.map_or_else(Vec::new, |rough| {
            let least = rough.asperities.map_or(0.5 * rough.rms, |law| law.least_gap());
            let gaps = (0..POINTS).map(|i| least + share(i) * (FURTHEST[1] * rough.rms - least));
            gaps.map(|h| (h, rough.at(h))).map(|(h, factors)| [h, factors.along, factors.across]).collect()
        });
        let even = asperities.map(|_| {
            let tops = motor.teeth as f64 * motor.tooth_width * motor.contact_width;
            [motor.min_spacing, motor.load / tops]
        });
        Self { contact, flow, even }
    }
}
