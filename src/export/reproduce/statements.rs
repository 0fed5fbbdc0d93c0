//! Statements of the paper's text, beside the computed numbers.

use crate::analysis::reproduce::{Both, Reproduction};
use crate::digits::significant;
use crate::solution::MotorResult;
use serde::Serialize;

/// One statement of the paper's text, with the numbers that support it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Statement {
    /// The statement, in the paper's words or close to them.
    pub says: &'static str,
    /// The paper's own numbers for it.
    pub published: String,
    /// By its algorithm on its own meshes.
    pub paper: String,
    /// Converged.
    pub converged: String,
    /// Verdict: whether the computed numbers agree.
    pub verdict: &'static str,
}

/// The numbers of a scene by the paper's algorithm, or converged.
fn result(both: Option<&Both>, paper: bool) -> Option<&MotorResult> {
    let both = both?;
    Both::result(if paper { &both.paper } else { &both.ours })
}

/// Placeholder for a number that is not known.
const UNKNOWN: &str = "–";

/// α, with its error.
pub(super) fn share(result: Option<&MotorResult>) -> String {
    result.map_or(UNKNOWN.to_owned(), |result| result.alpha.to_string())
}

/// The statements of the text that have numbers.
pub fn statements(all: &Reproduction) -> Vec<Statement> {
    let both = |preset: &str| all.row(preset).map(|row| &row.both);
    let fundamental = both("fundamental");
    let load = |preset: &str, paper: bool| result(both(preset), paper).map(|result| result.film_load.value);
    let published = |preset: &str| all.row(preset).map_or(f64::NAN, |row| row.published.published_load_n);
    let words = |value: Option<f64>, unit: &str| {
        value.map_or(UNKNOWN.to_owned(), |value| format!("{}{unit}", significant(value, 3)))
    };
    let mut list = Vec::new();
    // `by`: the paper's algorithm, or converged.
    let mut say = |says, published: &str, by: &dyn Fn(bool) -> String, verdict| {
        let (paper, converged) = (by(true), by(false));
        list.push(Statement { says, published: published.to_owned(), paper, converged, verdict });
    };

    let doubled = || Some(1e3 * (load("doubled-mesh", true)? - load("fundamental", true)?));
    let remaining = || Some(1e3 * (load("fundamental", false)? - load("fundamental", true)?));
    say(
        "Doubling the mesh changes the film load by only 12\u{a0}mN, so the division number is large enough.",
        "12 mN",
        &|paper| match paper {
            true => words(doubled(), " mN"),
            false => format!("{} more without the mesh", words(remaining(), " mN")),
        },
        "The 12 mN are confirmed, the conclusion is not: the mesh leaves about 3 % of the film load out.",
    );
    say(
        "α of the fundamental case is 0.24.",
        "0.238",
        &|paper| share(result(fundamental, paper)),
        "Confirmed; 0.246 without the error of the mesh.",
    );
    say(
        "Neglecting the shear velocity, α is almost the same: squeeze is very much larger than wedge.",
        "almost the same",
        &|paper| share(result(Some(&all.no_sliding), paper)),
        "Confirmed: the difference is smaller than the error.",
    );
    say(
        "With a minimum spacing of 100\u{a0}nm, α is up to 0.48.",
        "0.481",
        &|paper| share(result(both("min-spacing-100nm"), paper)),
        "Confirmed: half the spacing, twice the share.",
    );
    let ratios = |of: &dyn Fn(&str) -> Option<f64>| {
        let ratio = |wide: &str, narrow: &str| Some(of(wide)? / of(narrow)?);
        let teeth = ratio("tooth-width-2.31mm", "tooth-width-1.16mm");
        teeth
            .zip(ratio("rotor-width-0.6mm", "fundamental"))
            .map_or(UNKNOWN.to_owned(), |(teeth, rotor)| format!("×\u{a0}{teeth:.2} teeth, ×\u{a0}{rotor:.2} rotor"))
    };
    say(
        "The film load is proportional to the interface area (teeth or rotor twice as wide).",
        &ratios(&|preset| Some(published(preset))),
        &|paper| ratios(&|preset| load(preset, paper)),
        "Confirmed for the teeth. For the rotor a little more than that: gas escapes from a wide face more slowly.",
    );
    let (soft, stiff) = (result(Some(&all.softer), false), result(fundamental, false));
    say(
        "A low rotor stiffness leads to a large contact area and large α (here: 1.2\u{a0}times as soft).",
        "larger",
        &|paper| {
            result(Some(&all.softer), paper).map_or(UNKNOWN.to_owned(), |found| {
                format!("{} on {:.2} teeth", share(Some(found)), found.teeth_in_contact.value)
            })
        },
        match (soft, stiff) {
            (Some(soft), Some(stiff)) if soft.teeth_in_contact.value <= stiff.teeth_in_contact.value => {
                "Not confirmed."
            }
            (Some(soft), Some(stiff)) if soft.alpha.value > stiff.alpha.value => "Confirmed.",
            (Some(_), Some(_)) => {
                "The larger contact area is confirmed. α falls: the fitted rotor follows the wave better, so its gaps change less. The \
                 paper gives no number, and its rotor is not known in full."
            }
            _ => "",
        },
    );
    let range = |presets: [&str; 2], paper: bool| match presets.map(|preset| result(both(preset), paper)) {
        [Some(from), Some(to)] => format!("{:.3} to {:.3}", from.alpha.value, to.alpha.value),
        _ => UNKNOWN.to_owned(),
    };
    say(
        "When the frequency is higher, α is larger (3 to 100\u{a0}kHz).",
        "0.078 to 0.257",
        &|paper| range(["frequency-3khz", "frequency-100khz"], paper),
        "Confirmed. The uniform mesh loses more at high frequency, where the boundary layer is thinner.",
    );
    say(
        "With crowned teeth (3 to 10\u{a0}m) the film's pressure and α scarcely change.",
        "0.235 to 0.239",
        &|paper| range(["tooth-radius-3m", "tooth-radius-10m"], paper),
        "Confirmed.",
    );
    let torque = |alpha: f64| 0.7 * (1.0 - alpha) * 14.7 * 0.029;
    say(
        "Eq. (12): T\u{a0}=\u{a0}μ\u{a0}(1\u{a0}−\u{a0}α)\u{a0}L\u{a0}r with μ\u{a0}=\u{a0}0.7, L\u{a0}=\u{a0}14.7\u{a0}N, r\u{a0}=\u{a0}29\u{a0}mm; measured 0.17\u{a0}N·m, which needs α\u{a0}≈\u{a0}0.43.",
        &format!("{:.3} N·m", torque(0.238)),
        &|paper| words(result(fundamental, paper).map(|result| torque(result.alpha.value)), " N·m"),
        "As the paper says: the film explains a part of the gap to the measured torque, not all of it.",
    );
    list
}
