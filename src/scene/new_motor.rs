//! A motor from its data sheet: the questions that are asked, and the scene that follows from the answers, with the values that had
//! to be assumed and why.
//!
//! The command line and the window ask the same questions. A question without an answer has a value that is assumed, or is required.

use super::parameter::{Parameter, names};
use super::quantity_text;
use super::value::{Value, show_number, show_text};
use super::values::Scene;
use crate::atomic::{WriteError, write_file};
use crate::digits::{as_given, brief, rounded};
use crate::gas::GASES;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// One question.
#[derive(Debug)]
pub struct Question {
    /// Its name: as an option of the command line `--diameter-mm`.
    pub name: &'static str,
    /// The quantity asked for, in words.
    pub words: &'static str,
    /// Answers that it accepts.
    pub accepts: Accepts,
    /// Assumption if there is no answer, in words. `None` if an answer is required.
    pub otherwise: Option<&'static str>,
}

/// Answers that a question accepts.
#[derive(Clone, Copy, Debug)]
pub enum Accepts {
    /// A number in the range of this key of a scene, in the unit of the key.
    Key(&'static str),
    /// A number in a range, both ends included, and its unit.
    Number(f64, f64, &'static str),
    /// A whole number in a range, both ends included.
    Whole(f64, f64),
    /// One of these names.
    Choice(&'static [&'static str]),
    /// Any text.
    Text,
}

/// Digits of what follows from torque, speed and normal amplitude.
const DIGITS: usize = 4;
/// Normal amplitude over the tangential one, where only one of them is known.
const ELLIPSE: f64 = 1.3;
/// A coefficient of friction above this gets a remark.
const MUCH_FRICTION: f64 = 0.5;
/// Usual coefficients of friction, in words.
const USUAL: &str = "usual are 0.1 to 0.5, and 0.7 is that of Maeno and Bogy";

const fn question(
    name: &'static str,
    words: &'static str,
    accepts: Accepts,
    otherwise: Option<&'static str>,
) -> Question {
    Question { name, words, accepts, otherwise }
}

/// All questions, in the order in which they are asked.
#[rustfmt::skip]
pub static QUESTIONS: &[Question] = &[
    question("name", "Name of the motor", Accepts::Text, Some("My motor")),
    question("diameter-mm", "Outer diameter of the stator", Accepts::Number(2.25, 1000.0, "mm"), None),
    question("frequency-khz", "Frequency", Accepts::Key("stator.frequency_khz"), None),
    question("load-n", "Axial load on the rotor", Accepts::Key("motor.load_n"), None),
    question("waves", "Wavelengths round the ring", Accepts::Key("motor.waves"), Some("9")),
    question("teeth", "Teeth on the ring", Accepts::Whole(1.0, 6400.0), Some("8 on each wave")),
    question("tooth-width-mm", "Tooth width", Accepts::Key("stator.tooth_width_mm"), Some("three quarters of the pitch")),
    question("stall-torque-nm", "Stall torque", Accepts::Number(1e-6, 1e4, "N·m"), Some("a friction coefficient of 0.3")),
    question("no-load-speed-rpm", "No-load speed", Accepts::Number(0.01, 10000.0, "rpm"),
        Some("a tangential amplitude of 1 µm, or the normal amplitude divided by 1.3 if that is given")),
    question("normal-amplitude-um", "Normal amplitude of the stator", Accepts::Key("stator.normal_amplitude_um"),
        Some("1.3 times the tangential one")),
    question("contact-width-mm", "Radial width of the contact", Accepts::Key("rotor.contact_width_mm"), Some("3 % of the diameter, up to 10 mm")),
    question("thickness-mm", "Thickness of the rotor's rim", Accepts::Key("rotor.thickness_mm"), Some("a fortieth of the diameter")),
    question("elastic-modulus-gpa", "Elastic modulus of the rotor", Accepts::Key("rotor.elastic_modulus_gpa"), Some("70, aluminium")),
    question("min-spacing-nm", "Spacing that roughness leaves", Accepts::Key("film.min_spacing_nm"), Some("200")),
    question("gas", "Gas", Accepts::Choice(names!(GASES)), Some("air")),
    question("temperature-c", "Temperature", Accepts::Key("film.temperature_c"), Some("20")),
    question("altitude-m", "Altitude", Accepts::Key("film.altitude_m"), Some("sea level")),
];

impl Question {
    /// The question of a name.
    pub fn find(name: &str) -> Option<&'static Self> {
        QUESTIONS.iter().find(|question| question.name == name)
    }

    /// The key whose range and unit the answer has, if it is that of a key.
    fn parameter(&self) -> Option<&'static Parameter> {
        if let Accepts::Key(key) = self.accepts { Parameter::find(key) } else { None }
    }

    /// The unit of a number; empty for a pure number and for words.
    fn unit(&self) -> &'static str {
        match self.accepts {
            Accepts::Number(_, _, unit) => unit,
            _ => self.parameter().map_or("", |parameter| parameter.unit),
        }
    }

    /// `Frequency, kHz`.
    pub fn title(&self) -> String {
        if self.unit().is_empty() { self.words.to_owned() } else { format!("{}, {}", self.words, self.unit()) }
    }

    /// Accepted answers, in words.
    pub fn allowed(&self) -> String {
        match self.accepts {
            Accepts::Key(key) => self.parameter().map_or_else(|| key.to_owned(), Parameter::accepts_if_given),
            Accepts::Number(min, max, unit) => {
                format!("a number from {} to {} {unit}", show_number(min), show_number(max))
            }
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
        let number = self.number(answer);
        let good = match self.accepts {
            Accepts::Key(_) => {
                self.parameter().zip(number).is_some_and(|(key, number)| key.accept(Value::Number(number)).is_ok())
            }
            Accepts::Number(min, max, _) => number.is_some_and(|number| (min..=max).contains(&number)),
            Accepts::Whole(min, max) => {
                number.is_some_and(|number| (min..=max).contains(&number) && number.fract() == 0.0)
            }
            Accepts::Choice(names) => names.contains(&answer),
            Accepts::Text => true,
        };
        let wrong = || format!("{} = {} is not accepted: expected {}", self.name, show_text(answer), self.allowed());
        if good { Ok(()) } else { Err(wrong()) }
    }

    fn number(&self, answer: &str) -> Option<f64> {
        quantity_text::number(self.unit(), answer)
    }
}

/// A value of a scene that no answer gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Assumption {
    /// The key of the scene.
    pub key: &'static str,
    /// The value that it was given, with its unit.
    pub value: String,
    /// Why it was given that value.
    pub why: String,
}

/// A motor from answers.
#[derive(Clone, Debug, PartialEq)]
pub struct NewMotor {
    /// The motor.
    pub scene: Scene,
    /// Assumptions that were made, in the order of the questions.
    pub assumed: Vec<Assumption>,
    /// A sentence on each answer that the motor does not meet: a number of teeth that was changed, or a torque and speed for which no motor
    /// was found.
    pub unmet: Vec<String>,
}

/// Friction and tangential amplitude, as multiples of the least that torque and speed of the data sheet allow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Multiple of the least coefficient of friction.
    pub friction: f64,
    /// Multiple of the least tangential amplitude.
    pub amplitude: f64,
}

impl Factors {
    /// The least: the air takes no torque, and the rotor moves as fast as the crests of the wave.
    pub const LEAST: Self = Self { friction: 1.0, amplitude: 1.0 };
}

/// The answers so far, by the name of the question; a missing or blank one counts as not answered.
pub type Answers = BTreeMap<String, String>;

/// The answer to the question `name`, without the spaces around it.
fn answer<'a>(answers: &'a Answers, name: &str) -> Option<&'a str> {
    answers.get(name).map(|answer| answer.trim()).filter(|answer| !answer.is_empty())
}

/// The answer to the question `name`, for a number, in the unit of the question.
pub fn asked(answers: &Answers, name: &str) -> Option<f64> {
    Question::find(name)?.number(answer(answers, name)?)
}

/// The scene while it is being put together.
struct Draft<'a> {
    answers: &'a Answers,
    /// Keys and their values, as [`Scene::set_all`] takes them.
    pairs: Vec<(&'static str, String)>,
    assumed: Vec<Assumption>,
    unmet: Vec<String>,
}

impl Draft<'_> {
    fn number(&self, name: &str) -> Option<f64> {
        asked(self.answers, name)
    }

    fn give(&mut self, key: &'static str, value: f64) {
        self.pairs.push((key, show_number(as_given(value))));
    }

    fn assume(&mut self, key: &'static str, value: f64, why: &str) {
        self.assume_text(key, show_number(as_given(value)), why);
    }

    fn assume_text(&mut self, key: &'static str, value: String, why: &str) {
        let shown = Parameter::find(key).map_or_else(|| value.clone(), |parameter| parameter.with_unit(&value));
        self.assumed.push(Assumption { key, value: shown, why: why.to_owned() });
        self.pairs.push((key, value));
    }

    /// `value` of the answer to `name`, which `key` has to accept; `None` if there is no answer.
    fn following(&self, name: &str, key: &str, value: impl Fn(f64) -> f64) -> Result<Option<f64>, String> {
        let Some(value) = self.number(name).map(|answer| rounded(value(answer), DIGITS)) else { return Ok(None) };
        match Scene::motor().set_value(key, Value::Number(brief(value))) {
            Ok(()) => Ok(Some(value)),
            Err(fault) => Err(self.unsuited(name, &fault.to_string())),
        }
    }

    /// The message for an answer that does not go with the others.
    fn unsuited(&self, name: &str, why: &str) -> String {
        let given = answer(self.answers, name).unwrap_or_default();
        format!("{name} = {given} does not go with the other answers: {why}")
    }

    /// Gives a key the answer to `name` as it is, or else assumes `otherwise`.
    fn take(&mut self, key: &'static str, name: &str, otherwise: f64, why: &str) {
        match self.number(name) {
            Some(value) => self.give(key, value),
            None => self.assume(key, otherwise, why),
        }
    }
}

impl NewMotor {
    /// The motor that these answers describe.
    ///
    /// # Errors
    /// Answers that are missing or wrong, a line each.
    pub fn of(answers: &Answers) -> Result<Self, String> {
        Self::with(answers, Factors::LEAST)
    }

    /// The motor that these answers describe, with more friction and amplitude than the least.
    pub fn with(answers: &Answers, factors: Factors) -> Result<Self, String> {
        let fault = |question: &Question| match answer(answers, question.name) {
            Some(answer) => question.check(answer).err(),
            None if question.otherwise.is_some() => None,
            None => {
                let words = question.words.to_lowercase();
                Some(format!("{} is missing: {words}, {}", question.name, question.allowed()))
            }
        };
        let wrong: Vec<String> = QUESTIONS.iter().filter_map(fault).collect();
        if !wrong.is_empty() {
            return Err(wrong.join("\n"));
        }
        let mut draft = Draft { answers, pairs: Vec::new(), assumed: Vec::new(), unmet: Vec::new() };
        let [diameter, frequency, load] =
            ["diameter-mm", "frequency-khz", "load-n"].map(|name| draft.number(name).unwrap_or(f64::NAN));
        let radius = 0.45 * diameter;
        let why = "nine tenths of the outer radius, where the teeth of ring motors touch";
        draft.assume("motor.contact_radius_mm", radius, why);
        draft.give("stator.frequency_khz", frequency);
        draft.give("motor.load_n", load);
        draft.take("motor.waves", "waves", 9.0, "usual for rings of 60 mm; the wavelength follows from it");
        let waves = draft.number("waves").unwrap_or(9.0);
        match draft.number("teeth").map(|teeth| teeth / waves) {
            Some(teeth) if teeth.fract() == 0.0 => draft.give("stator.teeth_per_wave", teeth),
            Some(teeth) if teeth < 1.0 => {
                return Err(draft.unsuited("teeth", &format!("each of the {waves} waves has one tooth or more")));
            }
            Some(teeth) => {
                let (given, taken) = (teeth * waves, teeth.round() * waves);
                let why = format!(
                    "the nearest whole number, because the model has as many teeth on every wave: {taken} teeth on the ring, not {given:.0}"
                );
                draft.assume("stator.teeth_per_wave", teeth.round(), &why);
                draft.unmet.push(format!(
                    "The motor has {taken} teeth, not {given:.0}: the model has as many on each of the {waves} waves."
                ));
            }
            None => draft.assume("stator.teeth_per_wave", 8.0, "usual; narrower teeth lose more air at their sides"),
        }
        match draft.number("tooth-width-mm") {
            Some(width) => draft.give("stator.tooth_width_mm", width),
            None => draft.assume("stator.tooth_share", 0.75, "usual: the slots take a quarter of the pitch"),
        }
        let of_torque = |torque: f64| factors.friction * torque / (load * radius * 1e-3);
        match draft.following("stall-torque-nm", "motor.dry_friction", of_torque)? {
            Some(friction) => {
                let why = match factors {
                    Factors::LEAST => {
                        "stall torque over load and radius: the least that it can be, because the air takes some"
                    }
                    _ => "the solved motor has the stall torque of the data sheet, within 0.2 %",
                };
                let much = format!("{why}; {USUAL}: check the stall torque, the load and the diameter");
                draft.assume("motor.dry_friction", friction, if friction > MUCH_FRICTION { &much } else { why });
            }
            None => draft.assume("motor.dry_friction", 0.3, "a filled polymer on metal"),
        }
        let of_speed = |speed: f64| factors.amplitude * speed / 60.0 * radius / frequency;
        let amplitude = draft.following("no-load-speed-rpm", "stator.tangential_amplitude_um", of_speed)?;
        let (tangential, why) = match (amplitude, draft.number("normal-amplitude-um")) {
            (Some(amplitude), _) if factors == Factors::LEAST => {
                (amplitude, "the crests of the wave move as fast as the rotor without load: the least that it can be")
            }
            (Some(amplitude), _) => {
                (amplitude, "the solved motor has the speed without load of the data sheet, within 0.2 %")
            }
            (None, Some(normal)) => (
                rounded(normal / ELLIPSE, DIGITS),
                "the normal amplitude divided by 1.3, as in the motor of Maeno and Bogy",
            ),
            (None, None) => (1.0, "as in the motor of Maeno and Bogy; it hardly affects the film"),
        };
        draft.assume("stator.tangential_amplitude_um", tangential, why);
        let why = "1.3 times the tangential one, as in the motor of Maeno and Bogy";
        draft.take("stator.normal_amplitude_um", "normal-amplitude-um", ELLIPSE * tangential, why);
        let lip = (0.03 * diameter).min(10.0);
        let why = "3 % of the diameter, at most 10 mm: a typical width of a rotor's lip";
        draft.take("rotor.contact_width_mm", "contact-width-mm", lip, why);
        draft.pairs.push(("rotor.model", "section".to_owned()));
        let why = "a fortieth of the diameter: a thin flange";
        draft.take("rotor.thickness_mm", "thickness-mm", diameter / 40.0, why);
        draft.take("rotor.elastic_modulus_gpa", "elastic-modulus-gpa", 70.0, "aluminium");
        let width = draft.number("contact-width-mm").unwrap_or(lip);
        draft.assume("rotor.width_mm", 2.0 * width, "twice the contact: how much of the flange bends with it");
        let why = "0.14 of the radius, as in the rotor fitted to Maeno and Bogy";
        draft.assume("rotor.decay_length_mm", 0.14 * radius, why);
        draft.assume("rotor.local_compliance_m2_per_n", 1.05e-10, "as in the rotor fitted to Maeno and Bogy");
        let why = "as in the motor of Maeno and Bogy; the result depends on it more than on anything else here: measure the surfaces";
        draft.take("film.min_spacing_nm", "min-spacing-nm", 200.0, why);
        match answer(answers, "gas") {
            Some(gas) => draft.pairs.push(("film.gas", gas.to_owned())),
            None => draft.assume_text("film.gas", "air".to_owned(), "unless stated otherwise"),
        }
        draft.take("film.temperature_c", "temperature-c", 20.0, "room temperature");
        draft.take("film.altitude_m", "altitude-m", 0.0, "sea level");
        let why = "the law that holds at every spacing; the paper's, first-order, is inaccurate in films thinner than ten mean free paths";
        draft.assume_text("film.slip", "fukui-kaneko".to_owned(), why);
        draft.pairs.push(("name", answer(answers, "name").unwrap_or("My motor").to_owned()));
        let words = |assumption: &Assumption| Parameter::find(assumption.key).map(Parameter::words);
        let assumed: Vec<String> = draft.assumed.iter().filter_map(words).collect();
        draft.pairs.push(("about", format!("From a data sheet. Assumed: {}.", assumed.join(", "))));
        let scene = Scene::motor().with(&draft.pairs).map_err(|error| error.to_string())?;
        Ok(Self { scene, assumed: draft.assumed, unmet: draft.unmet })
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
    pub fn save(&self, path: &Path) -> Result<(), WriteError> {
        write_file(path, |out| out.write_all(self.to_toml().as_bytes()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{Problem, Scenario};

    fn answers(pairs: &[(&str, &str)]) -> Answers {
        pairs.iter().map(|(name, answer)| ((*name).to_owned(), (*answer).to_owned())).collect()
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
        let about = &motor.scene.about;
        assert!(
            about.starts_with("From a data sheet. Assumed: contact radius, waves round the ring, teeth on"),
            "{about}"
        );
        assert!(about.contains("minimum spacing H_m") && !about.contains("_nm"), "{about}");
    }

    #[test]
    fn what_a_data_sheet_has_becomes_what_the_model_needs() {
        let all = [
            ("name", "Mine"),
            ("waves", "9"),
            ("teeth", "72"),
            ("tooth-width-mm", "1.9"),
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
        assert_eq!([number("stator.tooth_width_mm"), number("rotor.thickness_mm")], [1.9, 1.5]);
        assert_eq!(motor.scene.name, "Mine");
        let given = [
            "motor.waves",
            "stator.teeth_per_wave",
            "stator.tooth_share",
            "rotor.thickness_mm",
            "film.gas",
            "film.altitude_m",
        ];
        assert!(!motor.assumed.iter().any(|assumption| given.contains(&assumption.key)));
        // 70 teeth are no whole number on each of 9 waves.
        let why = |more: (&'static str, &str), key: &str| {
            let motor = NewMotor::of(&answers(&[&NEEDED[..], &[more]].concat())).unwrap();
            motor
                .assumed
                .iter()
                .find(|assumption| assumption.key == key)
                .map(|it| format!("{}: {}", it.value, it.why))
                .unwrap()
        };
        let uneven = why(("teeth", "70"), "stator.teeth_per_wave");
        assert!(uneven.starts_with("8: ") && uneven.ends_with("72 teeth on the ring, not 70"), "{uneven}");
        let unmet = |teeth| NewMotor::of(&answers(&[&NEEDED[..], &[("teeth", teeth)]].concat())).unwrap().unmet;
        assert_eq!(unmet("10"), ["The motor has 9 teeth, not 10: the model has as many on each of the 9 waves."]);
        assert!(unmet("72").is_empty());
        // A normal amplitude alone leaves the shape of the ellipse to be assumed, not its size.
        let tangential = why(("normal-amplitude-um", "0.8"), "stator.tangential_amplitude_um");
        assert!(tangential.starts_with("0.6154 µm: the normal amplitude divided by 1.3"), "{tangential}");
        // More friction than is usual.
        let friction = |torque| why(("stall-torque-nm", torque), "motor.dry_friction");
        assert!(
            friction("2.5").contains("usual are 0.1 to 0.5") && !friction("1.2").contains("usual"),
            "{}",
            friction("2.5")
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
        let few = NewMotor::of(&answers(&[&NEEDED[..], &[("teeth", "5")]].concat())).unwrap_err();
        assert_eq!(few, "teeth = 5 does not go with the other answers: each of the 9 waves has one tooth or more");
        let wide = NewMotor::of(&answers(&[&NEEDED[..], &[("tooth-width-mm", "3")]].concat())).unwrap_err();
        assert!(wide.contains("1 % to 100 % of the tooth pitch"), "{wide}");
        // Each answer alone is allowed, and together they ask for a load on one wave that is not.
        let light = [("diameter-mm", "60"), ("frequency-khz", "40"), ("load-n", "0.05")];
        assert!(NewMotor::of(&answers(&light)).unwrap_err().contains("motor.load_per_wave_n"));
        let strong = NewMotor::of(&answers(&[&NEEDED[..], &[("stall-torque-nm", "72")]].concat())).unwrap_err();
        let named =
            "stall-torque-nm = 72 does not go with the other answers: motor.dry_friction = 17.8 is out of range";
        assert!(strong.starts_with(named), "{strong}");
    }

    #[test]
    fn questions_are_about_keys_that_there_are() {
        for question in QUESTIONS.iter().filter(|question| matches!(question.accepts, Accepts::Key(_))) {
            assert!(question.parameter().is_some_and(|parameter| parameter.range().is_some()), "{}", question.name);
        }
    }
}
