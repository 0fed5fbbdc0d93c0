//! A motor from its data sheet whose solution has the torque and the speed that the data sheet states.

use super::quantity::{Numbers, Quantity};
use crate::control::Cancel;
use crate::digits::significant;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::scene::new_motor::{Answers, Factors, NewMotor, asked};
use crate::solution::Status;
use crate::solve::{Record, Settings, solve};

/// Greatest number of solves to find friction and amplitude. The torque is proportional to the friction, the speed nearly to the amplitude.
const SOLVES: usize = 40;
/// Relative accuracy with which torque and speed have to agree.
const CLOSE: f64 = 2e-3;

/// The motor of `answers`, with the friction and the amplitude that give the solution the stall torque and the no-load speed of the data
/// sheet. If no solution has them, both are the least possible values, as in [`NewMotor::of`], and the description says so.
pub fn agreeing(answers: &Answers, cancel: &Cancel) -> Result<NewMotor, String> {
    let mut least = NewMotor::of(answers)?;
    let wanted = [(Quantity::StallTorque, "stall-torque-nm"), (Quantity::NoLoadSpeed, "no-load-speed-rpm")]
        .map(|(quantity, name)| Some((quantity, asked(answers, name)?)));
    if wanted == [None, None] {
        return Ok(least);
    }
    let (mut motor, mut factors) = (least.clone(), Factors::LEAST);
    for _ in 0..SOLVES {
        let Some(solved) = solved(&motor.scene, cancel) else { break };
        // A rotor that floats has no torque, and more friction does not change that.
        let missed = wanted.map(|wanted| {
            let Some((quantity, asked)) = wanted else { return Some(1.0) };
            let found = solved.estimate(quantity).filter(|found| found.value > 0.0 && found.error < found.value)?;
            Some(asked / found.value)
        });
        let [Some(torque), Some(speed)] = missed else { break };
        if (torque - 1.0).abs().max((speed - 1.0).abs()) < CLOSE {
            return Ok(motor);
        }
        factors.friction *= torque;
        factors.amplitude *= speed;
        let Ok(next) = NewMotor::with(answers, factors) else { break };
        motor = next;
    }
    // If the time limit was reached, this is not known.
    let has = solved(&least.scene, cancel).map_or_else(String::new, |numbers| {
        let resolved = |quantity| numbers.estimate(quantity).filter(|found| found.error < found.value);
        match [Quantity::StallTorque, Quantity::NoLoadSpeed].map(resolved) {
            _ if numbers.get(Quantity::NoLoadSpeed).is_none() => ": solved, this one is not driven".to_owned(),
            [Some(torque), Some(speed)] => {
                let [torque, speed] = [torque, speed].map(|found| significant(found.value, 3));
                format!(": solved, this one has {torque} N·m and {speed} rpm")
            }
            _ => ": of this one, torque or speed are not known".to_owned(),
        }
    });
    let unmet = format!("No motor was found that agrees with the data sheet{has}.");
    least.scene.about = format!("{} {unmet}", least.scene.about);
    least.unmet.push(unmet);
    Ok(least)
}

fn solved(scene: &Scene, cancel: &Cancel) -> Option<Numbers> {
    let problem = Problem::try_from(scene).ok()?;
    let settings = Settings { record: Record::Numbers, ..Settings::default() };
    let solution = solve(&problem, &settings, &mut (), cancel).ok()?;
    (solution.status == Status::Converged).then(|| Numbers::of(&problem, &solution))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motor_has_the_torque_and_the_speed_of_its_data_sheet() {
        let with = |others: &[(&str, &str)]| -> Answers {
            let sheet = [("diameter-mm", "60"), ("frequency-khz", "40"), ("load-n", "160")];
            sheet.iter().chain(others).map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect()
        };
        let asked = [("stall-torque-nm", "1"), ("no-load-speed-rpm", "150")];
        let answers = with(&asked);
        let of = |motor: &NewMotor| {
            let numbers = solved(&motor.scene, &Cancel::new()).unwrap();
            [Quantity::StallTorque, Quantity::NoLoadSpeed].map(|quantity| numbers.get(quantity).unwrap())
        };
        let [torque, speed] = of(&NewMotor::of(&answers).unwrap());
        assert!(torque < 0.7 && speed < 147.0, "{torque} {speed}");
        let motor = agreeing(&answers, &Cancel::new()).unwrap();
        let [torque, speed] = of(&motor);
        assert!((torque - 1.0).abs() < CLOSE && (speed / 150.0 - 1.0).abs() < CLOSE, "{torque} {speed}");
        // A motor that is loaded so lightly that its rotor floats has no torque.
        let same_but_told = |answers: &Answers, told: &str| {
            let (found, least) = (agreeing(answers, &Cancel::new()).unwrap(), NewMotor::of(answers).unwrap());
            assert!(found.scene.same_model(&least.scene));
            let unmet = found.unmet.last().unwrap().as_str();
            assert!(found.scene.about.ends_with(unmet) && unmet.ends_with(told), "{unmet}");
        };
        same_but_told(&with(&[asked[0], asked[1], ("load-n", "20")]), "this one is not driven.");
        // A motor that would need more friction than allowed keeps the least friction.
        same_but_told(&with(&[("stall-torque-nm", "8.5")]), "rpm.");
        // If the film leaves the speed unknown, it cannot agree with the data sheet.
        let unknown = with(&[("load-n", "20"), ("frequency-khz", "10000"), ("no-load-speed-rpm", "10000")]);
        let unmet = agreeing(&unknown, &Cancel::new()).unwrap().unmet.pop().unwrap();
        assert!(unmet.ends_with("not known."), "{unmet}");
        // Under a load so heavy that all teeth touch, torque and speed depend on both.
        let heavy = with(&[
            ("diameter-mm", "68.57"),
            ("frequency-khz", "75.08"),
            ("load-n", "184.2"),
            ("stall-torque-nm", "0.9401"),
            ("no-load-speed-rpm", "49.29"),
        ]);
        let [torque, speed] = of(&agreeing(&heavy, &Cancel::new()).unwrap());
        assert!((torque / 0.9401 - 1.0).abs() < CLOSE && (speed / 49.29 - 1.0).abs() < CLOSE, "{torque} {speed}");
    }
}
