//! Effect of a switch of the model: the results before it and after it, at one fidelity, beside the bound that the plan
//! had stated.

use crate::fidelity::Fidelity;
use crate::job::SolvedScene;
use crate::plan::Decision;
use crate::solution::Outcome;

/// Relative change below which its sign is not shown.
const NOTHING: f64 = 1e-12;

/// α at one fidelity, and the decisions that were made for it.
#[derive(Clone, Debug, PartialEq)]
struct Sample {
    fidelity: Fidelity,
    alpha: f64,
    error: f64,
    decisions: Vec<Decision>,
}

/// Effect of one switch on α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwitchEffect {
    /// The key that was switched.
    pub key: &'static str,
    /// The fidelity of both results.
    pub fidelity: Fidelity,
    /// α before.
    pub before: f64,
    /// α after.
    pub after: f64,
    /// The sum of the stated numerical errors of both results, absolute.
    pub errors: f64,
    /// Relative bound of the change, as stated by the plan; 0 is exact.
    pub bound: f64,
}

impl SwitchEffect {
    /// The change of α, relative to its value before.
    pub fn relative(&self) -> f64 {
        let change = (self.after - self.before) / self.before.abs().max(f64::MIN_POSITIVE);
        if change.abs() < NOTHING { 0.0 } else { change }
    }

    /// Whether the change is within the bound and the numerical errors.
    pub fn held(&self) -> bool {
        (self.after - self.before).abs() <= self.bound * self.before.abs() + self.errors
    }
}

/// Results of the present scene, and those before the last switch.
#[derive(Clone, Debug, Default)]
pub struct SwitchHistory {
    present: Vec<Sample>,
    switched: Option<(&'static str, Vec<Sample>)>,
}

impl SwitchHistory {
    /// Forgets all results, because the scene was changed by something other than a switch.
    pub fn edited(&mut self) {
        self.present.clear();
        self.switched = None;
    }

    /// Notes that only the model's `key` was switched.
    pub fn switched(&mut self, key: &'static str) {
        let before = std::mem::take(&mut self.present);
        match &self.switched {
            // If the key is switched again before there is a result, the results for comparison stay the same.
            Some((same, _)) if *same == key && before.is_empty() => {}
            _ => self.switched = Some((key, before)),
        }
    }

    /// Adds a result of the present scene.
    pub fn solved(&mut self, run: &SolvedScene) {
        let Outcome::Motor(result) = run.solution.outcome else { return };
        self.present.retain(|sample| sample.fidelity != run.fidelity);
        self.present.push(Sample {
            fidelity: run.fidelity,
            alpha: result.alpha.value,
            error: result.alpha.error,
            decisions: run.solution.model.decisions.clone(),
        });
    }

    /// Effect of the last switch, at the highest fidelity that both scenes were solved at.
    pub fn effect(&self) -> Option<SwitchEffect> {
        let (key, before) = self.switched.as_ref()?;
        let same = |sample: &&Sample| before.iter().any(|old| old.fidelity == sample.fidelity);
        let after = self.present.iter().filter(same).max_by_key(|sample| sample.fidelity)?;
        let before = before.iter().find(|old| old.fidelity == after.fidelity)?;
        // Each states the effect of what it leaves out; between two reductions both effects count.
        let effect = |sample: &Sample| {
            let decided = sample.decisions.iter().find(|decision| decision.key() == Some(*key));
            decided.map_or(0.0, |decision| decision.effect)
        };
        Some(SwitchEffect {
            key,
            fidelity: after.fidelity,
            before: before.alpha,
            after: after.alpha,
            errors: before.error + after.error,
            bound: effect(before) + effect(after),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Choice;
    use crate::problem::Wedge;

    const KEY: &str = "numerics.wedge";

    fn sample(fidelity: Fidelity, alpha: f64, effect: f64) -> Sample {
        let decision = Decision { chosen: Choice::Wedge(Wedge::Off), overruled: false, effect, weighed: None };
        Sample { fidelity, alpha, error: 1e-4, decisions: vec![decision] }
    }

    #[test]
    fn a_switch_is_compared_at_the_highest_common_fidelity() {
        let present = vec![sample(Fidelity::Draft, 0.2, 0.0), sample(Fidelity::Standard, 0.25, 0.0)];
        let mut history = SwitchHistory { present, switched: None };
        assert_eq!(history.effect(), None);
        history.switched(KEY);
        assert_eq!(history.effect(), None);
        history.present.push(sample(Fidelity::Draft, 0.21, 0.1));
        assert_eq!(history.effect().unwrap().fidelity, Fidelity::Draft);
        history.present.push(sample(Fidelity::Standard, 0.26, 0.05));
        history.present.push(sample(Fidelity::Fine, 0.27, 0.05));
        let change = history.effect().unwrap();
        assert_eq!((change.fidelity, change.before, change.after), (Fidelity::Standard, 0.25, 0.26));
        assert!((change.relative() - 0.04).abs() < 1e-12 && change.bound == 0.05 && change.held());
        assert!(!SwitchEffect { bound: 0.03, ..change }.held());

        // Switched twice in a row: the results before the first are still those to compare with.
        history.switched(KEY);
        history.switched(KEY);
        history.present.push(sample(Fidelity::Standard, 0.25, 0.0));
        assert_eq!(history.effect().unwrap().before, 0.26);
        history.edited();
        assert_eq!(history.effect(), None);
    }
}
