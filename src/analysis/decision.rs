//! The decisions of a plan in words: how each part of the model is solved, and why; and how accurate the solve is.

use crate::digits::{percent, short, significant};
use crate::plan::{Choice, Decision, Weighed};
use crate::problem::{Flow, Teeth, Time, Wedge, Width};
use crate::solution::Model;
use crate::solve::{Method, Settings};
use std::time::Duration;

/// The accuracy of a solve in words, from the name of its fidelity in results: `fidelity fine`, `accuracy 0.1 %`.
pub fn exactness(fidelity: &str) -> String {
    match fidelity.strip_suffix('%') {
        Some(accuracy) => format!("accuracy {accuracy} %"),
        None => format!("fidelity {fidelity}"),
    }
}

/// The accuracy of all solves of a command in words, for titles: `fidelity reference, in at most 2ms a solve`.
pub fn effort(settings: &Settings, budget: Option<Duration>) -> String {
    match (settings.method, budget) {
        (Method::Paper, _) => "the paper's algorithm".to_owned(),
        (Method::Auto, None) => exactness(&settings.fidelity.to_string()),
        (Method::Auto, Some(time)) => format!("{}, in at most {time:?} a solve", effort(settings, None)),
    }
}

/// A sentence for each decision of a solve.
pub fn sentences(model: &Model) -> Vec<String> {
    let decided = model.decisions.iter().map(|decision| format!("{}: {}", term(decision), words(decision)));
    decided.chain(model.remarks.iter().cloned()).collect()
}

/// The part of the model that the decision is about: "wedge term".
pub fn term(decision: &Decision) -> &'static str {
    match decision.chosen {
        Choice::Time(_) => "leakage",
        Choice::Flow(_) => "flow",
        Choice::Wedge(_) | Choice::NoShear => "wedge term",
        Choice::Teeth(..) => "teeth",
        Choice::Width(_) => "width",
        Choice::MotorGrid { .. } => "grid",
        Choice::PlateGrid { round: true, .. } => "radius",
        Choice::PlateGrid { across: Some(_), .. } => "plate",
        Choice::PlateGrid { across: None, .. } => "strip",
        Choice::Steps(..) => "time",
        Choice::Rotor { .. } => "rotor",
        Choice::NoLeaks => "leakage",
    }
}

/// A decision and its reason in words, to be read after [`term`].
pub fn words(decision: &Decision) -> String {
    let weighed = decision.weighed.map_or_else(String::new, |weighed| reason(decision.chosen, &weighed));
    match decision.chosen {
        Choice::Time(Time::Trapped) => format!("none, the gas is trapped (σ → ∞){weighed}"),
        Choice::Time(_) => format!("solved in time{weighed}"),
        Choice::Flow(Flow::Along) => format!("along the tooth only, none at its sides{weighed}"),
        Choice::Flow(Flow::Across) => format!("across the width only, none at the tooth's ends{weighed}"),
        Choice::Flow(_) => format!("in the plane of the film{weighed}"),
        Choice::NoShear => "left out: the scene says shear = false".to_owned(),
        Choice::Wedge(Wedge::Off) => format!("left out{weighed}"),
        Choice::Wedge(_) => format!("solved{weighed}"),
        Choice::Teeth(Teeth::All, teeth) => format!("all {teeth} solved, as asked"),
        Choice::Teeth(_, 1) => "the wave has one tooth, and it is solved".to_owned(),
        Choice::Teeth(_, teeth) => {
            format!("one of {teeth} solved; in the steady state tooth k at time t is tooth 0 at t + kT/{teeth} (exact)")
        }
        Choice::Width(Width::Full) => "all of it solved, as asked".to_owned(),
        Choice::Width(_) => {
            "half of it solved; the gap does not depend on y, so the other half is its mirror (exact)".to_owned()
        }
        Choice::MotorGrid { grid, layer, edge_fraction, middle, spectral } => format!(
            "{} intervals along a tooth, the first {} times the boundary layer of {} µm{}; across half the \
             width {}; {} steps a cycle; two coarser grids for the error estimate, and finer ones until it is small enough",
            grid.along,
            short(edge_fraction, 2),
            significant(layer * 1e6, 3),
            if middle { ", all of them densest where the crown is highest" } else { "" },
            if spectral {
                format!("a polynomial with {} nodes or more", grid.across)
            } else {
                format!("{} finite volumes, since the layer is thin", grid.across)
            },
            grid.steps
        ),
        Choice::PlateGrid { round: true, .. } => {
            "one radius solved; the film is the same all round the plate (exact)".to_owned()
        }
        Choice::PlateGrid { along, across: Some(across), .. } => {
            format!("a quarter of it solved, {along} × {across} intervals, and mirrored (exact)")
        }
        Choice::PlateGrid { along, across: None, .. } => {
            format!("one line across half its length solved, {along} intervals, and mirrored (exact)")
        }
        Choice::Steps(steps, follow) => {
            let follow = if follow { ", the shorter the closer the plate is" } else { "" };
            format!("{steps} steps a cycle{follow}; two coarser grids for the error estimate")
        }
        Choice::Rotor { error, ring, resonances } => {
            let of =
                if ring { "a ring of finite elements" } else { "a table of its deflection, turned into harmonics" };
            let (known, effect) = (percent(error), percent(decision.effect));
            let mass = match resonances {
                None if ring => {
                    "; its natural frequencies are not computed at this accuracy or within a budget, so rotor-resonance is not judged"
                }
                _ => "",
            };
            format!(
                "{of}; its smooth deflection under a point load is known to {known}, which changes α by less than {effect}{mass}"
            )
        }
        Choice::NoLeaks if decision.effect == 0.0 => "none, the plate does not move".to_owned(),
        Choice::NoLeaks => format!(
            "none, the gas is trapped (σ → ∞): leakage would change the load by less than {}",
            percent(decision.effect)
        ),
    }
}

/// `: Λ/σ = 1.7e-4; leaving it out changes α by less than 0.16 % (asked for: 0.020 %)`
fn reason(chosen: Choice, weighed: &Weighed) -> String {
    let layer = |of: &str| format!("the boundary layer is {} of the {of}", percent(weighed.number));
    let (measure, reduced) = match weighed.reduced {
        Choice::Wedge(_) => (format!("Λ/σ = {:.1e}", weighed.number), "leaving it out"),
        Choice::Flow(Flow::Along) => (layer("contact width"), "ignoring the sides"),
        Choice::Flow(_) => (layer("tooth width"), "ignoring the tooth's ends"),
        _ => (layer("shorter side"), "treating the gas as trapped"),
    };
    let asked = if weighed.asked { "as asked; " } else { "" };
    let (effect, aim) = (percent(weighed.effect), percent(weighed.target_error));
    let change = match weighed.effect {
        _ if chosen == weighed.reduced => format!("changes α by less than {effect}"),
        effect if effect >= 1.0 => "could change α completely".to_owned(),
        _ => format!("could change α by up to {effect}"),
    };
    let coarse = if weighed.unresolved > 0.0 {
        format!("; this grid is too coarse for it: solving it has an error of up to {}", percent(weighed.unresolved))
    } else {
        String::new()
    };
    format!(": {asked}{measure}; {reduced} {change} (asked for: {aim}){coarse}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fidelity::Fidelity;
    use crate::plan::Plan;
    use crate::problem::{Motor, Numerics, Problem, Scenario};
    use crate::scene::presets;

    #[test]
    fn every_decision_is_a_sentence_that_follows_the_plan() {
        let problem = Problem::try_from(&presets::find("fundamental").unwrap()).unwrap();
        let Scenario::Motor(motor) = &problem.scenario else { panic!("a motor") };
        let of = |numerics: Numerics| Plan::motor(motor, Fidelity::Standard, &numerics).unwrap().decisions;
        let wedge = |numerics: Numerics| words(of(numerics).iter().find(|d| term(d) == "wedge term").unwrap());
        let asked = |wedge| Numerics { wedge, ..Numerics::default() };
        let [on, off] = [Wedge::On, Wedge::Off].map(|chosen| wedge(asked(chosen)));
        assert!(on.starts_with("solved: as asked; Λ/σ = ") && on.contains("could change α by up to"), "{on}");
        assert!(off.starts_with("left out: as asked; ") && off.contains("changes α by less than"), "{off}");
        assert!(!wedge(Numerics::default()).contains("as asked"));
        let still = Motor { shear: false, ..motor.clone() };
        let still = Plan::motor(&still, Fidelity::Standard, &Numerics::default()).unwrap();
        let wedge = still.decisions.iter().find(|d| term(d) == "wedge term").unwrap();
        assert_eq!((wedge.key(), words(wedge).as_str()), (None, "left out: the scene says shear = false"));
    }
}
