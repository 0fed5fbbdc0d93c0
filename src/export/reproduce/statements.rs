//! What the paper says in words, beside what comes of it.

use crate::analysis::reproduce::{Both, Reproduction};
use crate::digits::{significant, with_error};
use crate::solution::MotorResult;
use serde::Serialize;

/// One statement of the paper's text, with the numbers it stands on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Statement {
    /// The statement, in the paper's words or nearly.
    pub says: &'static str,
    /// What the paper gives for it.
    pub published: String,
    /// By its algorithm on its own meshes.
    pub paper: String,
    /// Converged.
    pub converged: String,
    /// What to make of it.
    pub verdict: &'static str,
}

/// The statements of the text that have numbers.
pub fn statements(all: &Reproduction) -> Vec<Statement> {
    let both = |preset: &str| all.row(preset).map(|row| &row.both);
    let load = |preset: &str, paper: bool| {
        let both = both(preset)?;
        Both::result(if paper { &both.paper } else { &both.ours }).map(|result| result.film_load)
    };
    let published = |preset: &str| all.row(preset).map_or(f64::NAN, |row| row.published.published_load_n);
    let alpha = |both: &Both, paper: bool| {
        Both::result(if paper { &both.paper } else { &both.ours }).map(|result| (result.alpha, result.alpha_error))
    };
    let words = |value: Option<f64>, unit: &str| {
        value.map_or("–".to_owned(), |value| format!("{}{unit}", significant(value, 3)))
    };
    let with = |value: Option<(f64, f64)>| value.map_or("–".to_owned(), |(value, error)| with_error(value, error));
    let fundamental = |paper| both("fundamental").and_then(|both| alpha(both, paper));
    let mut list = Vec::new();

    let doubled = |paper: bool| Some(1e3 * (load("doubled-mesh", paper)? - load("fundamental", paper)?));
    let remaining = load("fundamental", false).zip(load("fundamental", true)).map(|(ours, paper)| 1e3 * (ours - paper));
    list.push(Statement {
        says: "Doubling the mesh changes the film load by only 12\u{a0}mN, so the division number is large enough.",
        published: "12 mN".to_owned(),
        paper: words(doubled(true), " mN"),
        converged: format!("{} more without the mesh", words(remaining, " mN")),
        verdict: "The 12 mN are confirmed, the conclusion is not: the mesh leaves about 3 % of the film load out.",
    });
    list.push(Statement {
        says: "α of the fundamental case is 0.24.",
        published: "0.238".to_owned(),
        paper: with(fundamental(true)),
        converged: with(fundamental(false)),
        verdict: "Confirmed; 0.246 without the error of the mesh.",
    });
    let of = |both: &Both| (alpha(both, true), alpha(both, false));
    let (paper, ours) = of(&all.no_sliding);
    list.push(Statement {
        says: "Neglecting the shear velocity, α is almost the same: squeeze is very much larger than wedge.",
        published: "almost the same".to_owned(),
        paper: with(paper),
        converged: with(ours),
        verdict: "Confirmed: the difference is smaller than the error.",
    });
    list.push(Statement {
        says: "With a minimum spacing of 100\u{a0}nm, α is up to 0.48.",
        published: "0.481".to_owned(),
        paper: with(both("min-spacing-100nm").and_then(|both| alpha(both, true))),
        converged: with(both("min-spacing-100nm").and_then(|both| alpha(both, false))),
        verdict: "Confirmed: half the spacing, twice the share.",
    });
    let ratio = |of: &dyn Fn(&str) -> Option<f64>| {
        let (narrow, wide) = (of("tooth-width-1.16mm")?, of("tooth-width-2.31mm")?);
        Some((wide / narrow, of("rotor-width-0.6mm")? / of("fundamental")?))
    };
    let pair = |ratio: Option<(f64, f64)>| {
        ratio.map_or("–".to_owned(), |(teeth, rotor)| format!("×\u{a0}{teeth:.2} teeth, ×\u{a0}{rotor:.2} rotor"))
    };
    list.push(Statement {
        says: "The film load is proportional to the interface area (teeth or rotor twice as wide).",
        published: pair(ratio(&|preset| Some(published(preset)))),
        paper: pair(ratio(&|preset| load(preset, true))),
        converged: pair(ratio(&|preset| load(preset, false))),
        verdict: "Confirmed for the teeth. For the rotor a little more than that: gas escapes from a wide face more slowly.",
    });
    let (soft_paper, soft) = (Both::result(&all.softer.paper), Both::result(&all.softer.ours));
    let stiff = both("fundamental").and_then(|both| Both::result(&both.ours));
    let touching = |result: Option<&MotorResult>| {
        result.map_or("–".to_owned(), |result| {
            format!("{} on {:.2} teeth", with_error(result.alpha, result.alpha_error), result.teeth_in_contact)
        })
    };
    list.push(Statement {
        says: "A low rotor stiffness leads to a large contact area and large α (here: 1.2\u{a0}times as soft).",
        published: "larger".to_owned(),
        paper: touching(soft_paper),
        converged: touching(soft),
        verdict: match (soft, stiff) {
            (Some(soft), Some(stiff)) if soft.teeth_in_contact <= stiff.teeth_in_contact => "Not confirmed.",
            (Some(soft), Some(stiff)) if soft.alpha > stiff.alpha => "Confirmed.",
            (Some(_), Some(_)) => {
                "The larger contact area is confirmed. α falls: the fitted rotor follows the wave better, so its gaps change less. The \
                 paper gives no number, and its rotor is not known in full."
            }
            _ => "",
        },
    });
    let ends = |paper| {
        let at = |preset: &str| both(preset).and_then(|both| alpha(both, paper)).map(|(alpha, _)| alpha);
        at("frequency-3khz").zip(at("frequency-100khz"))
    };
    let range = |ends: Option<(f64, f64)>| ends.map_or("–".to_owned(), |(a, b)| format!("{a:.3} to {b:.3}"));
    list.push(Statement {
        says: "When the frequency is higher, α is larger (3 to 100\u{a0}kHz).",
        published: "0.078 to 0.257".to_owned(),
        paper: range(ends(true)),
        converged: range(ends(false)),
        verdict: "Confirmed. The uniform mesh loses more at high frequency, where the boundary layer is thinner.",
    });
    let radii = |paper| {
        let at = |preset: &str| both(preset).and_then(|both| alpha(both, paper)).map(|(alpha, _)| alpha);
        at("tooth-radius-3m").zip(at("tooth-radius-10m"))
    };
    list.push(Statement {
        says: "With crowned teeth (3 to 10\u{a0}m) the film's pressure and α scarcely change.",
        published: "0.235 to 0.239".to_owned(),
        paper: range(radii(true)),
        converged: range(radii(false)),
        verdict: "Confirmed.",
    });
    let torque = |paper: bool| fundamental(paper).map(|(alpha, _)| 0.7 * (1.0 - alpha) * 14.7 * 0.029);
    list.push(Statement {
        says: "Eq. (12): T\u{a0}=\u{a0}μ\u{a0}(1\u{a0}−\u{a0}α)\u{a0}L\u{a0}r with μ\u{a0}=\u{a0}0.7, L\u{a0}=\u{a0}14.7\u{a0}N, r\u{a0}=\u{a0}29\u{a0}mm; measured 0.17\u{a0}N·m, which needs α\u{a0}≈\u{a0}0.43.",
        published: format!("{:.3} N·m", 0.7 * (1.0 - 0.238) * 14.7 * 0.029),
        paper: words(torque(true), " N·m"),
        converged: words(torque(false), " N·m"),
        verdict: "As the paper says: the film explains a part of the gap to the measured torque, not all of it.",
    });
    list
}
