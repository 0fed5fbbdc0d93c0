//! The check of a student's run, as it is written in a lesson:
//!
//! ```text
//! alpha > 1.5 * start.alpha and film.min_spacing_nm <= 100
//! ```
//!
//! A check is one comparison, or several that are joined by `and`. A comparison has an operator, `< <= > >= =` or `about` (within 5 %),
//! between two arithmetic expressions of numbers, names of results (`Quantity::name`), numbers of tabs (`Live::name`) and keys of the scene.
//! `start.` before a name stands for its value when the step began. A key whose value is a word is compared by `=`: `film.slip = "none"`.

mod comparison;
mod name;
mod parse;

pub use name::{Name, Ran, name, results};

use super::live::Live;
use crate::digits::{short, significant};
use crate::scene::Scene;
use comparison::{Comparison, Expression};
use parse::{comparisons, expression, unexpected};

/// A check.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    comparisons: Vec<Comparison>,
}

impl Check {
    /// Reads a check for steps on `scene`.
    pub fn parse(source: &str, scene: &Scene) -> Result<Self, String> {
        Ok(Self { comparisons: comparisons(source, scene)? })
    }

    /// The numbers of tabs that it uses.
    pub fn live(&self) -> impl Iterator<Item = Live> {
        self.comparisons.iter().flat_map(|comparison| [&comparison.left, &comparison.right]).flat_map(Expression::live)
    }

    /// The first comparison that does not hold for the run `now`, in words; `None` if all hold. The step began with the run `start`.
    pub fn unmet(&self, now: Ran<'_>, start: Ran<'_>) -> Option<String> {
        self.comparisons.iter().find_map(|comparison| comparison.unmet(now, start))
    }
}

/// A number that a text quotes: an expression as in a comparison, and after a colon the number of significant digits.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// As written.
    pub source: String,
    expression: Expression,
    digits: usize,
}

impl Reading {
    /// Significant digits, unless the text gives another number.
    const DIGITS: usize = 3;

    /// Reads a number for steps on `scene`.
    pub fn parse(source: &str, scene: &Scene) -> Result<Self, String> {
        let (sum, digits) = match source.rsplit_once(':') {
            None => (source, Self::DIGITS),
            Some((sum, digits)) => match digits.trim().parse() {
                Ok(digits @ 1..=9) => (sum, digits),
                _ => return Err(unexpected(digits.trim(), "expected a number of digits, 1 to 9")),
            },
        };
        Ok(Self { source: source.trim().to_owned(), expression: expression(sum, scene)?, digits })
    }

    /// Its value for the run `now` of a step that began with the run `start`; `None` while that is not known.
    pub fn value(&self, now: Ran<'_>, start: Ran<'_>) -> Option<f64> {
        self.expression.value(now, start)
    }

    /// The numbers of tabs that it uses.
    pub fn live(&self) -> Vec<Live> {
        self.expression.live()
    }

    /// A value of it as text: a result with all its digits, a parameter as a person would type it.
    pub fn text(&self, value: f64) -> String {
        match self.expression {
            Expression::Name { name: Name::Key(_), .. } => short(value, self.digits),
            _ => significant(value, self.digits),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::quantity::{Numbers, Quantity};
    use crate::lessons::live::Readings;

    fn unmet(source: &str, set: &[(&str, &str)], alpha: f64) -> Option<String> {
        let start = Scene::motor();
        let now = start.with(set).unwrap();
        let numbers = |alpha: f64| {
            let mut numbers = Numbers::default();
            numbers.set(Quantity::Alpha, alpha);
            numbers
        };
        let check = Check::parse(source, &start).unwrap();
        let (before, after) = (numbers(0.25), numbers(alpha));
        let (rest, mut live) = (Readings::default(), Readings::default());
        live.set(Live::Cycles, 5.0);
        let now = Ran { scene: &now, numbers: &after, live: &live };
        check.unmet(now, Ran { scene: &start, numbers: &before, live: &rest })
    }

    #[test]
    fn comparisons_hold_or_say_why_not() {
        let (halved, words) = ([("film.min_spacing_nm", "100")], [("film.slip", "none"), ("film.shear", "false")]);
        let source = "alpha > 1.5 * start.alpha and film.min_spacing_nm <= start.film.min_spacing_nm / 2";
        let rough = [("film.min_spacing_nm", "150")];
        for (source, set, alpha, told) in [
            (source, &halved[..], 0.5, ""),
            (source, &halved, 0.3, "Film share of the load α is 0.3, and should be above 0.375"),
            (source, &rough, 0.5, "Minimum spacing H_m is 150 nm, and should be at most 100 nm"),
            ("alpha about 0.5", &[], 0.51, ""),
            ("alpha about 0.5", &[], 0.53, "Film share of the load α is 0.53, and should be about 0.5"),
            ("alpha about 0.5 within 0.1", &[], 0.53, ""),
            (
                "alpha about 0.5 within 0.02",
                &[],
                0.53,
                "Film share of the load α is 0.53, and should be about 0.5 to 2 %",
            ),
            // As many digits as tell them apart.
            ("alpha < 0.5", &[], 0.500_04, "Film share of the load α is 0.50004, and should be below 0.5"),
            ("abs(alpha - 1) < 0.1 and -(alpha) < 0", &[], 1.05, ""),
            // A number that is not there fulfils no comparison.
            ("film_load_n > 1", &[], 0.5, "Film load is not known for this scene"),
            ("alpha / (motor.waves - 7) > 0", &[], 0.5, "alpha / ( motor.waves - 7 ) is not known for this scene"),
            ("startup.cycles >= 5", &[], 0.5, ""),
            ("startup.cycles > 5", &[], 0.5, "Cycles since rest is 5, and should be above 5"),
            ("torque.stall_nm > 0", &[], 0.5, "Stall torque is not known yet: see the tab Torque"),
            ("film.slip = \"none\" and film.shear = false", &words, 0.5, ""),
            ("film.slip = \"none\"", &[], 0.5, "Slip at the walls is first-order, and should be none"),
            ("stator.tooth_radius_m = \"none\"", &[], 0.5, ""),
        ] {
            assert_eq!(unmet(source, set, alpha).unwrap_or_default(), told, "{source}");
        }
        assert_ne!(unmet("stator.tooth_radius_m = \"none\"", &[("stator.tooth_radius_m", "3")], 0.5), None);
    }

    #[test]
    fn numbers_that_a_text_quotes_are_those_of_the_run() {
        let start = Scene::motor();
        let scene = start.with([("film.min_spacing_nm", "100")]).unwrap();
        let (mut before, mut after) = (Numbers::default(), Numbers::default());
        before.set(Quantity::Alpha, 0.25);
        after.set(Quantity::Alpha, 0.5);
        let live = Readings::default();
        let now = Ran { scene: &scene, numbers: &after, live: &live };
        let start = Ran { scene: &start, numbers: &before, live: &live };
        let quoted = |source: &str| {
            let reading = Reading::parse(source, &scene).unwrap();
            reading.value(now, start).map(|value| reading.text(value))
        };
        assert_eq!(quoted("alpha").unwrap(), "0.500");
        assert_eq!(quoted("alpha / start.alpha : 2").unwrap(), "2.0");
        assert_eq!(quoted("-start.alpha:1").unwrap(), "−0.2");
        assert_eq!(quoted("film.min_spacing_nm").unwrap(), "100");
        assert_eq!(quoted("film_load_n"), None, "not known yet");
        for (source, part) in [
            ("alhpa", "did you mean alpha?"),
            ("alpha:0", "0 is not expected here: expected a number of digits"),
            ("alpha > 1", "> is not expected here: expected + - * /"),
            ("film.slip", "film.slip is no number"),
            ("hold.gap_um", "belongs to another kind of scene"),
        ] {
            let error = Reading::parse(source, &scene).unwrap_err().to_string();
            assert!(error.contains(part), "{source}: {error}");
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (source, part) in [
            ("alhpa > 1", "alhpa is neither a result nor a key of the scene: did you mean alpha?"),
            ("film.min_spacing > 1", "did you mean film.min_spacing_nm?"),
            ("zzz > 1", "results are called as in --json"),
            ("plate.length_mm > 1", "plate.length_mm belongs to another kind of scene; this step's is a motor"),
            ("mean_load_ratio > 1", "belongs to another kind of scene"),
            ("hold.gap_um > 1", "hold.gap_um belongs to another kind of scene; this step's is a motor"),
            ("startup.cycle > 1", "did you mean startup.cycles?"),
            ("alpha", "the end is not expected here: expected one of <"),
            ("alpha > ", "the end is not expected"),
            ("alpha > 1 alpha", "alpha is not expected here: expected and"),
            ("alpha > 1 and", "the end is not expected"),
            ("(alpha > 1", "> is not expected here: expected )"),
            ("alpha ~ 1", "~ is not expected"),
            ("1.2.3 < alpha", "1.2.3 is not expected"),
            ("film.slip > 1", "film.slip is no number"),
            ("film.slip = \"noen\"", "\"noen\" is not a value of film.slip: expected one of \"none\""),
            ("film.slip = \"none", "closing quote"),
            ("alpha = \"none\"", "\"none\" is not expected"),
            ("2 * film.slip > 1", "film.slip is no number"),
            ("", "the end is not expected"),
        ] {
            let error = Check::parse(source, &Scene::motor()).unwrap_err().to_string();
            assert!(error.contains(part), "{source}: {error}");
        }
        let deep = format!("{}alpha > 1", "(".repeat(10_000));
        assert!(Check::parse(&deep, &Scene::motor()).unwrap_err().to_string().contains("levels"));
    }
}
