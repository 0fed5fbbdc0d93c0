//! Plain words for the keys of a scene and for the names it can choose from.

use crate::digits::{capitalised, rounded, uncapitalised};
use crate::plan::Decision;
use crate::scene::{PARAMETERS, Parameter, Scene, Value};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Plain words for the names of choices that are not clear by themselves, by key and name.
const CHOICES: &[(&str, &str, &str)] = &[
    ("rotor.model", "beam", "Beam on a foundation"),
    ("rotor.model", "section", "Beam of a rectangular section"),
    ("rotor.model", "ring", "Ring, by its cross-section"),
    ("rotor.model", "table", "Table from a file"),
    ("rotor.model", "green", "Deflection from a file"),
    ("plate.shape", "rectangle", "Rectangle or strip"),
    ("material", "peek", "PEEK"),
    ("fixed", "axial", "Axially"),
    ("fixed", "radial", "Radially"),
    ("fixed", "circumferential", "Circumferentially"),
    ("fixed", "axial-radial", "Axially, radially"),
    ("fixed", "axial-circumferential", "Axially, circumferentially"),
    ("fixed", "radial-circumferential", "Radially, circumferentially"),
    ("fixed", "all", "In all directions"),
    ("film.slip", "none", "No slip"),
    ("film.slip", "first-order", "First-order"),
    ("film.slip", "second-order", "Second-order"),
    ("film.slip", "fukui-kaneko", "Fukui and Kaneko"),
    ("surface.model", "minimum-spacing", "A hard stop"),
    ("surface.contact_law", "greenwood-williamson", "Greenwood and Williamson"),
    ("surface.contact_law", "greenwood-tripp", "Greenwood and Tripp"),
    ("surface.flow_factors", "none", "As for smooth faces"),
    ("surface.flow_factors", "patir-cheng", "Patir and Cheng"),
    ("numerics.wedge", "on", "Solved"),
    ("numerics.wedge", "off", "Left out"),
    ("numerics.time", "march", "Marched"),
    ("numerics.time", "trapped", "None, gas trapped"),
];

/// Name in a scene of the choice that lets the plan decide.
pub const AUTO_NAME: &str = "auto";

/// The name of a parameter: its own, or its key in words with a capital letter.
pub fn label(parameter: &Parameter) -> &'static str {
    static WORDS: LazyLock<BTreeMap<&str, String>> =
        LazyLock::new(|| PARAMETERS.iter().map(|of| (of.key, capitalised(&of.words()))).collect());
    parameter.name.or_else(|| WORDS.get(parameter.key).map(String::as_str)).unwrap_or(parameter.key)
}

/// The name of a parameter in the context of `scene`: a ring has two radii.
pub fn label_in(scene: &Scene, parameter: &Parameter) -> &'static str {
    let ring = || scene.get("plate.shape") == Some(Value::Text("ring".to_owned()));
    if parameter.key == "plate.radius_mm" && ring() { "Outer radius" } else { label(parameter) }
}

/// A message with the words of the panels in place of keys: `Amplitude 0.01 µm` for `plate.amplitude_um = 0.01`.
pub fn without_keys(message: &str) -> String {
    let of_sentence = |c: char| matches!(c, ',' | ';' | ':' | '.');
    let mut words = message.split(' ').peekable();
    let mut told: Vec<String> = Vec::new();
    while let Some(word) = words.next() {
        let key = word.trim_end_matches(of_sentence);
        let Some(parameter) = Parameter::find(key).filter(|_| key.contains('.')) else {
            told.push(word.to_owned());
            continue;
        };
        let name = if told.is_empty() { label(parameter).to_owned() } else { parameter.words() };
        told.push(name + &word[key.len()..]);
        if key.len() < word.len() || words.next_if_eq(&"=").is_none() {
            continue;
        }
        let value = words.next().unwrap_or_default();
        let number = value.trim_end_matches(of_sentence);
        let unit = if number.parse::<f64>().is_ok() { parameter.unit } else { "" };
        let end = &value[number.len()..];
        told.push(if unit.is_empty() { value.to_owned() } else { format!("{number} {unit}{end}") });
    }
    told.join(" ")
}

/// Plain words for one name of a choice: those of the table, or the name itself with a capital letter.
pub fn choice(key: &str, name: &str) -> String {
    let found = CHOICES.iter().find(|(found, option, _)| *found == key && *option == name);
    match found {
        Some((_, _, words)) => (*words).to_owned(),
        None if name == AUTO_NAME => "Automatic".to_owned(),
        None => capitalised(&name.replace('-', " ")),
    }
}

/// A value as the window writes it, without its unit: a choice in words, a flag as on or off.
pub fn shown(key: &str, value: &Value) -> String {
    match value {
        Value::Text(name) => choice(key, name),
        Value::Flag(on) => (if *on { "on" } else { "off" }).to_owned(),
        value => value.to_string(),
    }
}

/// As [`choice`]; for an automatic choice, also what the `plan` has decided: "Auto: left out".
pub fn chosen(key: &str, name: &str, plan: &[Decision]) -> String {
    let found = plan.iter().find(|decision| decision.key() == Some(key));
    match found {
        Some(decision) if name == AUTO_NAME => automatic(key, decision.value()),
        _ => choice(key, name),
    }
}

/// Words for a choice made by the plan: "Auto: left out".
pub fn automatic(key: &str, name: &str) -> String {
    format!("Auto: {}", uncapitalised(&choice(key, name)))
}

/// The accessible name of the field in which a value is typed, beside the slider that carries the label.
pub fn field_name(parameter: &Parameter) -> String {
    match parameter.unit {
        "" => format!("{} as a number", label(parameter)),
        unit => format!("{} in {unit}", label(parameter)),
    }
}

/// A note on a parameter that has no effect in this scene; `None` if it has one.
pub fn unused(scene: &Scene, parameter: &Parameter) -> Option<&'static str> {
    match parameter.key {
        key if !scene.heeds(key) => Some("No effect on a plate"),
        "numerics.contact_nodes" => Some("Only for squeezefilm solve --method paper"),
        _ => None,
    }
}

/// The explanation shown when the pointer rests on a parameter: meaning, range, default, key.
pub fn explanation(scene: &Scene, parameter: &Parameter, default: Option<&Value>) -> String {
    let mut text = parameter.about.to_owned();
    if let Some(range) = scene.range(parameter.key) {
        let bound = |value: f64| Value::Number(rounded(value, 5));
        text.push_str(&format!("\n{} to {}", bound(range.min), parameter.with_unit(bound(range.max))));
    }
    match (parameter.absent, default) {
        (Some(meaning), _) => text.push_str(&format!("\nIf not given: {meaning}")),
        (None, Some(Value::Text(name))) => {
            text.push_str(&format!("\nDefault {}", choice(parameter.key, name)));
        }
        (None, Some(Value::Flag(on))) => text.push_str(if *on { "\nDefault on" } else { "\nDefault off" }),
        (None, Some(value)) => text.push_str(&format!("\nDefault {}", parameter.with_unit(value))),
        (None, None) => {}
    }
    text.push_str(&format!("\n{}", parameter.key));
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Choice;
    use crate::problem::Wedge;
    use crate::scene::ParameterKind;

    #[test]
    fn every_parameter_has_a_label() {
        for parameter in PARAMETERS {
            assert!(label(parameter).starts_with(char::is_uppercase), "{}", parameter.key);
            assert_ne!(parameter.name, Some(&*capitalised(&parameter.key_words())), "{}", parameter.key);
            assert_eq!(parameter.switch.is_empty(), parameter.absent.is_none(), "{}", parameter.key);
            if let ParameterKind::Choice { options, .. } = parameter.kind {
                let stale = CHOICES.iter().find(|(key, option, _)| *key == parameter.key && !options.contains(option));
                assert_eq!(stale, None, "{}", parameter.key);
                for option in options {
                    let words = choice(parameter.key, option);
                    assert!(words.starts_with(char::is_uppercase), "{}: {option}", parameter.key);
                }
            }
        }
        for (key, option, words) in CHOICES {
            assert_ne!(capitalised(&option.replace('-', " ")), *words, "{key}: {option} needs no words of its own");
        }
    }

    #[test]
    fn messages_have_words_in_place_of_keys() {
        let message = "plate.amplitude_um = 0.01: it does not float; film.min_spacing_nm = 200 allows less, of 0.5 µm";
        let told = "Amplitude 0.01 µm: it does not float; minimum spacing H_m 200 nm allows less, of 0.5 µm";
        assert_eq!(without_keys(message), told);
        let message = "a smaller plate.amplitude_um, or film.gas = helium: 5 = 5";
        assert_eq!(without_keys(message), "a smaller amplitude, or gas helium: 5 = 5");
        assert_eq!(without_keys("film, the name: about"), "film, the name: about");
    }

    #[test]
    fn what_is_left_to_the_plan_says_what_the_plan_chose() {
        let plan = [Decision { chosen: Choice::Wedge(Wedge::Off), overruled: false, effect: 1e-3, weighed: None }];
        assert_eq!(chosen("numerics.wedge", "auto", &plan), "Auto: left out");
        assert_eq!(chosen("numerics.wedge", "on", &plan), "Solved");
        assert_eq!(chosen("numerics.time", "auto", &plan), "Automatic");
    }

    #[test]
    fn labels_are_sentence_case_without_colons() {
        let named = PARAMETERS.iter().flat_map(|p| p.name.into_iter().chain(p.absent.map(|_| p.switch)));
        for words in named.chain(CHOICES.iter().map(|c| c.2)) {
            assert!(words.starts_with(char::is_uppercase) && !words.contains(':'), "{words}");
        }
    }
}
