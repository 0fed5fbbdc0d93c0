//! A motor from what its data sheet has: questions, and a scene from their answers, with what had to be assumed and why.
//!
//! The command line and the window ask the same questions. One that is not needed has something to assume in its place.

use super::error::SceneError;
use super::quantity_text;
use super::value::{show_number, show_text};
use super::values::Scene;
use crate::atomic::{WriteError, write_file};
use crate::digits::as_given;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// One question.
#[derive(Debug)]
pub struct Question {
    /// Its name: as an option of the command line `--diameter-mm`.
    pub name: &'static str,
    /// What is asked for, in words.
    pub words: &'static str,
    /// The unit of a number; empty for a pure number and for words.
    pub unit: &'static str,
    /// What it accepts.
    pub accepts: Accepts,
    /// What is assumed without an answer; `None`: there has to be one.
    pub otherwise: Option<&'static str>,
}

/// What a question accepts.
#[derive(Clone, Copy, Debug)]
pub enum Accepts {
    /// A number from one to another.
    Number(f64, f64),
    /// A whole number from one to another.
    Whole(f64, f64),
    /// One of these.
    Choice(&'static [&'static str]),
    /// Any text.
    Text,
}

const GASES: &[&str] = &["air", "nitrogen", "helium", "argon", "carbon-dioxide", "hydrogen"];

/// All questions, in the order in which they are asked.
#[rustfmt::skip]
pub static QUESTIONS: &[Question] = &[
    Question { name: "name", words: "Name of the motor", unit: "", accepts: Accepts::Text, otherwise: Some("My motor") },
    Question { name: "diameter-mm", words: "Outer diameter of the stator", unit: "mm", accepts: Accepts::Number(2.0, 1000.0), otherwise: None },
    Question { name: "frequency-khz", words: "Frequency", unit: "kHz", accepts: Accepts::Number(0.001, 10000.0), otherwise: None },
    Question { name: "load-n", words: "Axial load on the rotor", unit: "N", accepts: Accepts::Number(0.01, 10000.0), otherwise: None },
    Question { name: "waves", words: "Wavelengths round the ring", unit: "", accepts: Accepts::Whole(1.0, 100.0), otherwise: Some("9") },
    Question { name: "teeth", words: "Teeth on the ring", unit: "", accepts: Accepts::Whole(1.0, 6400.0), otherwise: Some("8 on each wave") },
    Question { name: "stall-torque-nm", words: "Stall torque", unit: "N·m", accepts: Accepts::Number(1e-6, 1e4), otherwise: Some("a friction coefficient of 0.3") },
    Question { name: "no-load-speed-rpm", words: "No-load speed", unit: "rpm", accepts: Accepts::Number(0.01, 10000.0), otherwise: Some("a tangential amplitude of 1 µm") },
    Question { name: "normal-amplitude-um", words: "Normal amplitude of the stator", unit: "µm", accepts: Accepts::Number(0.0, 20.0), otherwise: Some("1.3 times the tangential one") },
    Question { name: "contact-width-mm", words: "Radial width of the contact", unit: "mm", accepts: Accepts::Number(0.01, 10.0), otherwise: Some("3 % of the diameter") },
    Question { name: "thickness-mm", words: "Thickness of the rotor's rim", unit: "mm", accepts: Accepts::Number(0.01, 100.0), otherwise: Some("a fortieth of the diameter") },
    Question { name: "elastic-modulus-gpa", words: "Elastic modulus of the rotor", unit: "GPa", accepts: Accepts::Number(0.01, 1000.0), otherwise: Some("70, aluminium") },
    Question { name: "min-spacing-nm", words: "Spacing that roughness leaves", unit: "nm", accepts: Accepts::Number(5.0, 10000.0), otherwise: Some("200") },
    Question { name: "gas", words: "Gas", unit: "", accepts: Accepts::Choice(GASES), otherwise: Some("air") },
    Question { name: "temperature-c", words: "Temperature", unit: "°C", accepts: Accepts::Number(-70.0, 500.0), otherwise: Some("20") },
    Question { name: "altitude-m", words: "Altitude", unit: "m", accepts: Accepts::Number(-1000.0, 60e3), otherwise: Some("sea level") },
];

impl Question {
    /// The question of a name.
    pub fn find(name: &str) -> Option<&'static Self> {
        QUESTIONS.iter().find(|question| question.name == name)
    }

    /// `Frequency, kHz`.
    pub fn title(&self) -> String {
        if self.unit.is_empty() { self.words.to_owned() } else { format!("{}, {}", self.words, self.unit) }
    }

    /// What it accepts, in words.
    pub fn allowed(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        match self.accepts {
            Accepts::Number(min, max) => format!("a number from {} to {}{unit}", show_number(min), show_number(max)),
            Accepts::Whole(min, max) => format!("a whole number from {min} to {max}"),
            Accepts::Choice(names) => format!("one of {}", names.join(", ")),
            Accepts::Text => "text".to_owned(),
        }
    }

    /// Checks an answer.
    ///
    /// # Errors
    /// The question, the answer and what is allowed.
    pub fn check(&self, answer: &str) -> Result<(), String> {
        let good = match self.accepts {
            Accepts::Number(min, max) => self.number(answer).is_some_and(|number| (min..=max).contains(&number)),
            Accepts::Whole(min, max) => {
                self.number(answer).is_some_and(|number| (min..=max).contains(&number) && number.fract() == 0.0)
            }
            Accepts::Choice(names) => names.contains(&answer),
            Accepts::Text => true,
        };
        let wrong = || format!("{} = {} is not accepted: expected {}", self.name, show_text(answer), self.allowed());
        if good { Ok(()) } else { Err(wrong()) }
    }

    fn number(&self, answer: &str) -> Option<f64> {
        quantity_text::number(self.unit, answer)
    }
}

/// Something that no answer gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Assumption {
    /// The key of the scene that it went into.
    pub key: &'static str,
    /// What it is now, with its unit.
    pub value: String,
    /// Why that.
    pub why: String,
}

/// A motor from answers.
#[derive(Clone, Debug, PartialEq)]
pub struct NewMotor {
    /// The motor.
    pub scene: Scene,
    /// What was assumed.
    pub assumed: Vec<Assumption>,
}

/// The answers so far, by the name of the question; what is missing or blank is not answered.
pub type Answers = BTreeMap<&'static str, String>;

/// What has gone into the scene so far.
struct Draft<'a> {
    answers: &'a Answers,
    pairs: Vec<(&'static str, String)>,
    assumed: Vec<Assumption>,
}

impl Draft<'_> {
    fn answer(&self, name: &str) -> Option<&str> {
        self.answers.get(name).map(|answer| answer.trim()).filter(|answer| !answer.is_empty())
    }

    fn number(&self, name: &str) -> Option<f64> {
        Question::find(name)?.number(self.answer(name)?)
    }

    fn give(&mut self, key: &'static str, value: f64) {
        self.pairs.push((key, show_number(as_given(value))));
    }

    fn assume(&mut self, key: &'static str, value: f64, unit: &str, why: &str) {
        let value = as_given(value);
        self.give(key, value);
        let value = format!("{} {unit}", show_number(value)).trim_end().to_owned();
        self.assumed.push(Assumption { key, value, why: why.to_owned() });
    }

    /// The answer to `name` as it is, or an assumption.
    fn take(&mut self, key: &'static str, name: &str, otherwise: f64, unit: &str, why: &str) {
        match self.number(name) {
            Some(value) => self.give(key, value),
            None => self.assume(key, otherwise, unit, why),
        }
    }
}

impl NewMotor {
    /// The motor that these answers describe.
    ///
    /// # Errors
    /// What is missing or wrong with the answers, a line each.
    pub fn of(answers: &Answers) -> Result<Self, String> {
        let mut wrong = Vec::new();
        for question in QUESTIONS {
            match answers.get(question.name).map(|answer| answer.trim()).filter(|answer| !answer.is_empty()) {
                Some(answer) => wrong.extend(question.check(answer).err()),
                None if question.otherwise.is_none() => {
                    wrong.push(format!(
                        "{} is missing: {}, {}",
                        question.name,
                        question.words.to_lowercase(),
                        question.allowed()
                    ));
                }
                None => {}
            }
        }
        if !wrong.is_empty() {
            return Err(wrong.join("\n"));
        }
        let mut draft = Draft { answers, pairs: Vec::new(), assumed: Vec::new() };
        let [diameter, frequency, load] =
            ["diameter-mm", "frequency-khz", "load-n"].map(|name| draft.number(name).unwrap_or(f64::NAN));
        let radius = 0.45 * diameter;
        draft.assume(
            "motor.contact_radius_mm",
            radius,
            "mm",
            "nine tenths of the outer radius, where the teeth of ring motors touch",
        );
        draft.give("stator.frequency_khz", frequency);
        draft.give("motor.load_n", load);
        draft.take("motor.waves", "waves", 9.0, "", "usual for rings of 60 mm; the wavelength follows from it");
        let waves = draft.number("waves").unwrap_or(9.0);
        match draft.number("teeth").map(|teeth| teeth / waves) {
            Some(teeth) if teeth.fract() == 0.0 => draft.give("stator.teeth_per_wave", teeth),
            Some(teeth) => {
                let why = "the nearest whole number: the model has as many teeth on every wave";
                draft.assume("stator.teeth_per_wave", teeth.round().max(1.0), "", why);
            }
            None => {
                draft.assume("stator.teeth_per_wave", 8.0, "", "usual; narrower teeth lose more air at their sides")
            }
        }
        draft.assume("stator.tooth_share", 0.75, "", "usual: the slots take a quarter of the pitch");
        match draft.number("stall-torque-nm").map(|torque| torque / (load * radius * 1e-3)) {
            Some(friction) => {
                let why = "stall torque over load and radius, as if no air took any: the least that it can be";
                draft.assume("motor.dry_friction", friction, "", why);
            }
            None => draft.assume("motor.dry_friction", 0.3, "", "a filled polymer on metal"),
        }
        let tangential = match draft.number("no-load-speed-rpm") {
            Some(speed) => {
                let amplitude = speed / 60.0 * radius / frequency;
                let why = "the crests of the wave move as fast as the rotor without load: the least that it can be";
                draft.assume("stator.tangential_amplitude_um", amplitude, "µm", why);
                amplitude
            }
            None => {
                draft.assume(
                    "stator.tangential_amplitude_um",
                    1.0,
                    "µm",
                    "as in the motor of Maeno and Bogy; the film hardly feels it",
                );
                1.0
            }
        };
        let why = "1.3 times the tangential one, as in the motor of Maeno and Bogy";
        draft.take("stator.normal_amplitude_um", "normal-amplitude-um", 1.3 * tangential, "µm", why);
        draft.take(
            "rotor.contact_width_mm",
            "contact-width-mm",
            0.03 * diameter,
            "mm",
            "3 % of the diameter: how wide the lip of a rotor is",
        );
        draft.pairs.push(("rotor.model", "section".to_owned()));
        draft.take(
            "rotor.thickness_mm",
            "thickness-mm",
            diameter / 40.0,
            "mm",
            "a fortieth of the diameter: a thin flange",
        );
        draft.take("rotor.elastic_modulus_gpa", "elastic-modulus-gpa", 70.0, "GPa", "aluminium");
        let width = draft.number("contact-width-mm").unwrap_or(0.03 * diameter);
        draft.assume("rotor.width_mm", 2.0 * width, "mm", "twice the contact: how much of the flange bends with it");
        draft.assume(
            "rotor.decay_length_mm",
            0.14 * radius,
            "mm",
            "0.14 of the radius, as in the rotor fitted to Maeno and Bogy",
        );
        draft.assume("rotor.local_compliance_m2_per_n", 1.05e-10, "m²/N", "as in the rotor fitted to Maeno and Bogy");
        let why = "as in the motor of Maeno and Bogy; the result depends on it more than on anything else here: measure the surfaces";
        draft.take("film.min_spacing_nm", "min-spacing-nm", 200.0, "nm", why);
        let gas = draft.answer("gas").unwrap_or("air").to_owned();
        if draft.answer("gas").is_none() {
            draft.assumed.push(Assumption {
                key: "film.gas",
                value: gas.clone(),
                why: "a motor that is not told otherwise".to_owned(),
            });
        }
        draft.pairs.push(("film.gas", gas));
        draft.take("film.temperature_c", "temperature-c", 20.0, "°C", "a room");
        draft.take("film.altitude_m", "altitude-m", 0.0, "m", "sea level");
        draft.pairs.push(("film.slip", "fukui-kaneko".to_owned()));
        let why = "the law that holds at every spacing; the paper's, first-order, ends where a film is ten mean free paths thick";
        draft.assumed.push(Assumption { key: "film.slip", value: "fukui-kaneko".to_owned(), why: why.to_owned() });
        draft.pairs.push(("name", draft.answer("name").unwrap_or("My motor").to_owned()));
        let keys: Vec<_> = draft.assumed.iter().map(|assumption| assumption.key).collect();
        draft.pairs.push(("about", format!("From a data sheet; assumed: {}.", keys.join(", "))));
        let mut scene = Scene::motor();
        let fault = |error: SceneError| error.to_string();
        scene.set_all(draft.pairs.iter().map(|(key, value)| (*key, value.as_str()))).map_err(fault)?;
        Ok(Self { scene, assumed: draft.assumed })
    }

    /// As a preset file, which says at its head what was assumed.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        for Assumption { key, value, why } in &self.assumed {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "# Assumed: {key} = {value}: {why}.");
        }
        format!("{text}\n{}", self.scene.to_toml())
    }

    /// Writes the preset file, whole or not at all.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), WriteError> {
        write_file(path, |out| out.write_all(self.to_toml().as_bytes()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{Problem, Scenario};

    fn answers(pairs: &[(&'static str, &str)]) -> Answers {
        pairs.iter().map(|(name, answer)| (*name, (*answer).to_owned())).collect()
    }

    const NEEDED: [(&str, &str); 3] = [("diameter-mm", "60"), ("frequency-khz", "40"), ("load-n", "150")];

    #[test]
    fn three_answers_are_enough_and_the_rest_is_said() {
        let motor = NewMotor::of(&answers(&NEEDED)).unwrap();
        let Scenario::Motor(found) = Problem::try_from(&motor.scene).unwrap().scenario else { panic!("a motor") };
        assert!((found.load * 9.0 / 150.0 - 1.0).abs() < 1e-9 && found.frequency == 40e3 && found.teeth == 8);
        // Whatever is assumed is in the scene, and all that the scene has beside the answers is assumed.
        for Assumption { key, value, why } in &motor.assumed {
            let shown = motor.scene.get(key).unwrap().to_string();
            assert!(value.split(' ').next() == Some(shown.as_str()) && !why.is_empty(), "{key}: {value}, {shown}");
        }
        let text = motor.to_toml();
        assert_eq!(Scene::from_toml(&text, "new").unwrap(), motor.scene);
        assert_eq!(text.matches("# Assumed: ").count(), motor.assumed.len());
        assert!(motor.scene.about.contains("film.min_spacing_nm"));
    }

    #[test]
    fn what_a_data_sheet_has_becomes_what_the_model_needs() {
        let all = [
            ("name", "Mine"),
            ("waves", "9"),
            ("teeth", "72"),
            ("stall-torque-nm", "1.215"),
            ("no-load-speed-rpm", "100"),
            ("normal-amplitude-um", "1500 nm"),
            ("contact-width-mm", "2"),
            ("thickness-mm", "1,5"),
            ("elastic-modulus-gpa", "110"),
            ("min-spacing-nm", "300"),
            ("gas", "helium"),
            ("temperature-c", "0"),
            ("altitude-m", "2000"),
        ];
        let motor = NewMotor::of(&answers(&[&NEEDED[..], &all].concat())).unwrap();
        let number = |key| motor.scene.get(key).and_then(|value| value.as_number()).unwrap();
        // 1.215 N·m over 150 N and 27 mm; 100 rpm at 27 mm are 282.7 mm/s, over 2π · 40 kHz.
        assert!((number("motor.dry_friction") - 0.3).abs() < 1e-9);
        assert!((number("stator.tangential_amplitude_um") - 1.125).abs() < 1e-9);
        assert_eq!(number("stator.normal_amplitude_um"), 1.5);
        assert_eq!(number("rotor.thickness_mm"), 1.5);
        assert_eq!(motor.scene.name, "Mine");
        let given = ["motor.waves", "stator.teeth_per_wave", "rotor.thickness_mm", "film.gas", "film.altitude_m"];
        assert!(!motor.assumed.iter().any(|assumption| given.contains(&assumption.key)));
        // 70 teeth are no whole number on each of 9 waves.
        let uneven = NewMotor::of(&answers(&[&NEEDED[..], &[("teeth", "70")]].concat())).unwrap();
        assert!(
            uneven
                .assumed
                .iter()
                .any(|assumption| assumption.key == "stator.teeth_per_wave" && assumption.value == "8")
        );
    }

    #[test]
    fn what_is_missing_or_wrong_is_named_with_what_is_allowed() {
        let wrong =
            [("diameter-mm", "60"), ("load-n", "heavy"), ("waves", "2.5"), ("gas", "steam"), ("temperature-c", " ")];
        assert_eq!(
            NewMotor::of(&answers(&wrong)).unwrap_err(),
            "frequency-khz is missing: frequency, a number from 0.001 to 10000 kHz\n\
             load-n = heavy is not accepted: expected a number from 0.01 to 10000 N\n\
             waves = 2.5 is not accepted: expected a whole number from 1 to 100\n\
             gas = steam is not accepted: expected one of air, nitrogen, helium, argon, carbon-dioxide, hydrogen"
        );
        // Each answer alone is allowed, and together they ask for a load on one wave that is not.
        let light = [("diameter-mm", "60"), ("frequency-khz", "40"), ("load-n", "0.05")];
        assert!(NewMotor::of(&answers(&light)).unwrap_err().contains("motor.load_per_wave_n"));
    }

    /// The ranges of the questions are those of the keys.
    #[test]
    fn questions_accept_what_their_keys_do() {
        use crate::scene::Parameter;
        let keys = [
            ("frequency-khz", "stator.frequency_khz"),
            ("load-n", "motor.load_n"),
            ("waves", "motor.waves"),
            ("normal-amplitude-um", "stator.normal_amplitude_um"),
            ("contact-width-mm", "rotor.contact_width_mm"),
            ("thickness-mm", "rotor.thickness_mm"),
            ("elastic-modulus-gpa", "rotor.elastic_modulus_gpa"),
            ("min-spacing-nm", "film.min_spacing_nm"),
            ("temperature-c", "film.temperature_c"),
            ("altitude-m", "film.altitude_m"),
        ];
        for (name, key) in keys {
            let (question, parameter) = (Question::find(name).unwrap(), Parameter::find(key).unwrap());
            let (Accepts::Number(min, max) | Accepts::Whole(min, max)) = question.accepts else { panic!("{name}") };
            let range = parameter.range().unwrap();
            assert_eq!((min, max, question.unit), (range.min, range.max, parameter.unit), "{name}");
        }
        assert_eq!(GASES, crate::gas::GASES.iter().map(|gas| gas.name).collect::<Vec<_>>());
    }
}
