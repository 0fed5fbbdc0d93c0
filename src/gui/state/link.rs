//! The part of an address after the `#`: a scene, as a built-in preset with changes, and the tab to show; or a step of a lesson.
//! `#fundamental&film.min_spacing_nm=100&tab=torque`, `#lesson=3&step=4`.
//!
//! Keys and values are those of `--set`, except that `%`, `&`, `#` and characters that an address cannot hold are written as `%` and two
//! digits. A link contains no file names.

use super::document::Document;
use super::view::Tab;
use crate::scene::Scene;
use crate::scene::presets::{BUILT_IN, BuiltIn};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use std::fmt::Write as _;

/// Target of a link.
#[derive(Clone, Debug, PartialEq)]
pub enum Link {
    /// A scene.
    Scene {
        /// A built-in preset, or a preset with the changes applied, which then is in no file and counts as unsaved.
        document: Box<Document>,
        /// The tab to show; `None` keeps the present one.
        tab: Option<Tab>,
    },
    /// A step of a lesson; both are counted from 1.
    Lesson {
        /// Number among the built-in lessons.
        lesson: usize,
        /// Number of the step.
        step: usize,
    },
}

impl Link {
    /// Whether `text` is a link to any address, rather than a preset or a path.
    pub fn is_link(text: &str) -> bool {
        text.starts_with('#') || text.contains("://") && text.contains('#')
    }

    /// Reads an address, or what follows its `#`.
    ///
    /// # Errors
    /// A message that names the wrong part, and what is allowed.
    pub fn read(address: &str) -> Result<Self, String> {
        let text = address.split_once('#').map_or(address, |(_, text)| text);
        let mut parts = text.split('&').map(|part| percent_decode_str(part).decode_utf8_lossy().into_owned());
        let first = parts.next().unwrap_or_default();
        if let Some(lesson) = first.strip_prefix("lesson=") {
            let (lesson, mut step) = (counted("lesson", lesson)?, 1);
            for part in parts {
                let Some(number) = part.strip_prefix("step=") else {
                    return Err(format!("{part:?} in a link to a lesson is not valid: expected step=NUMBER"));
                };
                step = counted("step", number)?;
            }
            return Ok(Self::Lesson { lesson, step });
        }
        let preset = BuiltIn::find(&first).ok_or_else(|| {
            let names = BUILT_IN.iter().map(|preset| preset.name).collect::<Vec<_>>().join(", ");
            format!(
                "a link begins with a built-in preset or with lesson=: {first:?} is neither; the presets are {names}"
            )
        })?;
        let (mut pairs, mut tab) = (Vec::new(), None);
        for part in parts {
            let (key, value) =
                part.split_once('=').ok_or_else(|| format!("{part:?} in a link is not valid: expected key=value"))?;
            if key == "tab" {
                tab = Some(Tab::named(value).ok_or_else(|| {
                    let tabs = Tab::ALL.iter().map(|(_, name)| name.to_lowercase()).collect::<Vec<_>>().join(", ");
                    format!("tab={value} in a link is not valid: expected one of {tabs}")
                })?);
            } else {
                pairs.push((key.to_owned(), value.to_owned()));
            }
        }
        let original = preset.scene().map_err(|error| error.to_string())?;
        let mut scene = original.with(&pairs).map_err(|error| error.to_string())?;
        scene.retitle(&original);
        let document = if scene == original { Document::opened(scene, None) } else { Document::made(scene) };
        Ok(Self::Scene { document: Box::new(document), tab })
    }

    /// A link to `scene`, based on the built-in preset with the fewest different keys.
    pub fn to(scene: &Scene, tab: Tab) -> String {
        let built_in = BUILT_IN.iter().filter_map(|preset| Some((preset.name, preset.scene().ok()?)));
        let alike = built_in.filter(|(_, original)| original.scene() == scene.scene());
        let nearest = alike.min_by_key(|(_, original)| (scene.changed(original).count(), original.name != scene.name));
        let Some((name, original)) = nearest else { return "#".to_owned() };
        let mut text = format!("#{name}");
        for parameter in scene.changed(&original) {
            // A key that the scene does not have either follows from other keys or is removed.
            let none = || parameter.absent.map(|_| "none".to_owned());
            if let Some(value) = scene.given_text(parameter).or_else(none) {
                let _ = write!(text, "&{}={}", parameter.key, utf8_percent_encode(&value, CODED));
            }
        }
        if tab != Tab::default() {
            let _ = write!(text, "&tab={}", tab.label(false).to_lowercase());
        }
        text
    }

    /// A link to a step of a built-in lesson; both are counted from 1.
    pub fn to_lesson(lesson: usize, step: usize) -> String {
        format!("#lesson={lesson}&step={step}")
    }
}

fn counted(key: &str, found: &str) -> Result<usize, String> {
    let number = found.parse().ok().filter(|number| *number > 0);
    number.ok_or_else(|| format!("{key}={found} in a link is not valid: expected a whole number of at least 1"))
}

/// Characters to be percent-encoded: all but letters, digits and a few signs.
#[rustfmt::skip]
const CODED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_').remove(b'~').remove(b':').remove(b',').remove(b';')
    .remove(b'(').remove(b')').remove(b'+').remove(b'*').remove(b'/').remove(b'=');

#[cfg(test)]
mod tests {
    use super::*;

    /// The scene of a link, which is unsaved if it differs from all presets, and the tab.
    fn read(text: &str) -> (Scene, Option<Tab>) {
        match Link::read(text).unwrap() {
            Link::Scene { document, tab } => {
                let built_in = BUILT_IN.iter().any(|preset| preset.scene().unwrap() == *document.scene());
                assert_eq!(document.is_dirty(), !built_in, "{text}");
                (document.scene().clone(), tab)
            }
            lesson => panic!("{lesson:?}"),
        }
    }

    #[test]
    fn a_link_is_a_preset_its_changes_and_a_tab() {
        let (scene, tab) = read("https://example.org/motor/#fundamental&film.min_spacing_nm=150&tab=torque");
        assert_eq!(tab, Some(Tab::Torque));
        let mut expected = crate::scene::presets::find("fundamental").unwrap();
        expected.set("film.min_spacing_nm", "150").unwrap();
        assert!(scene.same_model(&expected));
        assert_eq!(Link::to(&scene, Tab::Torque), "#fundamental&film.min_spacing_nm=150&tab=torque");
        assert_eq!(Link::read("#lesson=3&step=4").unwrap(), Link::Lesson { lesson: 3, step: 4 });
        assert_eq!(Link::read(&Link::to_lesson(3, 1)).unwrap(), Link::read("lesson=3").unwrap());
    }

    #[test]
    fn every_preset_and_any_change_of_it_comes_back() {
        for preset in BUILT_IN {
            let original = preset.scene().unwrap();
            let link = Link::to(&original, Tab::Motion);
            let (scene, tab) = read(&link);
            assert!(scene.same_model(&original) && tab.is_none(), "{link}");
            for (key, value) in [
                ("film.gas", "helium"),
                ("film.slip", "second-order"),
                ("film.ambient_pressure_kpa", "51.5"),
                ("stator.tooth_radius_m", "3"),
                ("rotor.model", "ring"),
                ("rotor.green", "[[0, 0.64], [4, 0.2], [14.5, -0.01]]"),
                ("surface.model", "asperities"),
                ("numerics.steps_per_cycle", "400"),
                ("plate.width_mm", "none"),
            ] {
                let mut changed = original.clone();
                if changed.set_all([(key, value)]).is_err() {
                    continue;
                }
                let link = Link::to(&changed, Tab::Sweep);
                let (scene, tab) = read(&link);
                assert!(scene.same_model(&changed) && scene.numerics() == changed.numerics(), "{link}");
                assert_eq!(tab, Some(Tab::Sweep));
            }
        }
    }

    #[test]
    fn what_is_wrong_is_named_with_what_is_allowed() {
        for (link, words) in [
            ("#fundemental", "fundamental, levitating"),
            ("#../etc/passwd", "begins with a built-in preset"),
            ("#fundamental&film.min_spacing_nm=-1", "film.min_spacing_nm"),
            ("#fundamental&tab=torqe", "motion, compare"),
            ("#fundamental&torque", "key=value"),
            ("#lesson=0", "at least 1"),
            ("#lesson=2&tab=hold", "step="),
        ] {
            let told = Link::read(link).unwrap_err();
            assert!(told.contains(words), "{link}: {told}");
        }
        assert_eq!(percent_decode_str("%25a%2").decode_utf8_lossy(), "%a%2");
        assert_eq!(utf8_percent_encode("µ & #=%", CODED).to_string(), "%C2%B5%20%26%20%23=%25");
    }
}
