//! The results whose sensitivity is computed.

use crate::analysis::quantity::{Numbers, Quantity};
use crate::estimate::Estimate;
use crate::problem::{Problem, Scenario};
use crate::solution::Solution;

/// The results of a problem whose sensitivity is computed, the headline first.
pub(super) fn outputs(problem: &Problem) -> &'static [Quantity] {
    use Quantity::{Alpha, Damping, FilmLoad, MeanGap, NoLoadSpeed, StallTorque, Stiffness};
    match &problem.scenario {
        Scenario::Motor(_) => &[Alpha, StallTorque, NoLoadSpeed],
        Scenario::Plate(plate) if plate.load.is_some() => &[MeanGap, Stiffness, Damping],
        Scenario::Plate(_) => &[FilmLoad, Stiffness, Damping],
    }
}

/// These results of a solution of `problem`, with their stated numerical errors; not finite where there is none.
pub(super) fn read(problem: &Problem, solution: &Solution) -> Vec<Estimate> {
    let numbers = Numbers::of(problem, solution);
    outputs(problem).iter().map(|output| numbers.known(*output)).collect()
}
