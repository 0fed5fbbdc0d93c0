//! Numbers as people type them: `250nm` for a key in micrometres, `0,3`, `2 × (1.5mm − 200um)`. The result is in the unit of the key.

use super::parameter::Parameter;
use super::value::show_text;

/// Units of one kind: their symbols (with `u` for µ), and their sizes relative to each other.
type Kind = &'static [(&'static str, f64)];

const KINDS: &[Kind] = &[
    &[("nm", 1e-9), ("um", 1e-6), ("mm", 1e-3), ("cm", 1e-2), ("m", 1.0), ("km", 1e3)],
    &[("Hz", 1.0), ("kHz", 1e3), ("MHz", 1e6)],
    &[
        ("Pa", 1.0),
        ("hPa", 1e2),
        ("kPa", 1e3),
        ("MPa", 1e6),
        ("GPa", 1e9),
        ("mbar", 1e2),
        ("bar", 1e5),
        ("atm", 101_325.0),
    ],
    &[("uN", 1e-6), ("mN", 1e-3), ("N", 1.0), ("kN", 1e3)],
    &[("uPas", 1e-6), ("mPas", 1e-3), ("Pas", 1.0)],
    &[("nm/N", 1e-9), ("um/N", 1e-6), ("mm/N", 1e-3), ("m/N", 1.0)],
    &[("mm2/N", 1e-6), ("m2/N", 1.0)],
    &[("mg", 1e-3), ("g", 1.0), ("kg", 1e3)],
    &[("rpm", 1.0)],
    &[("°C", 1.0), ("C", 1.0)],
    &[("ms", 1e-3), ("s", 1.0)],
    &[("%", 1.0)],
    &[("mm/s", 1e-3), ("m/s", 1.0)],
    // For answers in lessons.
    &[("mNm", 1e-3), ("Nm", 1.0), ("kNm", 1e3)],
    &[("mNs/m", 1e-3), ("Ns/m", 1.0)],
    // For limits on results.
    &[("mW", 1e-3), ("W", 1.0)],
    &[("N/m", 1.0), ("kN/m", 1e3), ("N/mm", 1e3), ("N/um", 1e6)],
    &[("1/um2", 1e12), ("1/mm2", 1e6), ("1/m2", 1.0)],
];

/// Longest text that is read \[bytes\]. It also limits how deep parentheses are nested.
const LONGEST: usize = 200;
/// Decimals to which a computed number is rounded, so that the conversion of units leaves no stray last bits.
const DECIMALS: usize = 13;

/// Reads `text` as a number for `parameter`, in its unit. The text may have a decimal point or comma, any unit of the same kind, and sums,
/// differences, products, quotients and parentheses. A number without a unit is in the unit of the key; in a sum with another unit it is refused.
///
/// # Errors
/// The text is not such a number; the message has the key, the text and what is allowed.
pub fn read(parameter: &Parameter, text: &str) -> Result<f64, String> {
    number(parameter.unit, text).ok_or_else(|| no_number(parameter, text))
}

/// Reads `text` as an end of a range of values of `key`, as [`read`] does. For a key that does not exist any number is accepted: the fault
/// of the key is reported where the scene is known.
pub fn end_of_range(key: &str, text: &str) -> Result<f64, String> {
    match Parameter::find(key) {
        Some(parameter) => read(parameter, text),
        None => number("", text).ok_or_else(|| format!("{key}: {} is not a number", show_text(text))),
    }
}

/// Message for a text that is not a number for `parameter`.
pub(super) fn no_number(parameter: &Parameter, text: &str) -> String {
    let kelvin = (parameter.unit == "°C").then_some("K");
    let units = kind_of(parameter.unit).iter().map(|(name, _)| *name).filter(|name| *name != "C");
    let units: Vec<&str> = units.chain(kelvin).collect();
    let units = if units.is_empty() {
        String::new()
    } else {
        format!(", in {}", units.join(", ").replace('u', "µ").replace("Pas", "Pa·s"))
    };
    let (key, text, accepts) = (parameter.key, text.trim(), parameter.accepts());
    if text == "none" && parameter.absent.is_none() {
        return format!("{key} = none: this key cannot be left out: expected {accepts}{units}");
    }
    let found = if text.is_empty() { "\"\"".to_owned() } else { show_text(text).to_string() };
    let sum = text.chars().skip(1).any(|c| "+-−".contains(c)) && text.contains(char::is_alphabetic);
    let sum = if sum && !units.is_empty() {
        format!(", where all terms of a sum have a unit if one has another than {}", parameter.unit)
    } else {
        String::new()
    };
    format!("{key} = {found} is not a number: expected {accepts}{units}, or a calculation such as (1 + 2) × 3{sum}")
}

fn kind_of(unit: &str) -> Kind {
    let unit = spelled(unit);
    KINDS.iter().find(|kind| kind.iter().any(|(name, _)| *name == unit)).copied().unwrap_or(&[])
}

/// The text without spaces, and with the same character for each sign that can be written in several ways. A product of units has no sign.
fn spelled(text: &str) -> String {
    let sign = |c: char| match c {
        'µ' | 'μ' => 'u',
        '²' => '2',
        '−' => '-',
        '×' | '·' => '*',
        '÷' => '/',
        ',' => '.',
        other => other,
    };
    let signs: Vec<char> = text.chars().filter(|c| !c.is_whitespace()).map(sign).collect();
    let letter = |at: usize| signs.get(at).is_some_and(|c| c.is_alphabetic());
    let of_units = |at: usize| signs[at] == '*' && at > 0 && letter(at - 1) && letter(at + 1);
    (0..signs.len()).filter(|at| !of_units(*at)).map(|at| signs[at]).collect()
}

/// Reads `text` as a number in `unit`, as [`read`] does; `None` if it is not one.
pub fn number(unit: &str, text: &str) -> Option<f64> {
    if text.len() > LONGEST {
        return None;
    }
    let parts: Vec<&str> = text.split_whitespace().collect();
    // "1 2" is two numbers, and not 12.
    let apart = |pair: &[&str]| {
        pair[0].ends_with(|c: char| c.is_ascii_digit()) && pair[1].starts_with(|c: char| c.is_ascii_digit())
    };
    if parts.windows(2).any(apart) {
        return None;
    }
    let text = spelled(text);
    if let Ok(plain) = text.parse::<f64>() {
        return plain.is_finite().then_some(plain);
    }
    // The two units that are not a factor times the unit of the key.
    match (unit, text.strip_suffix('%'), text.strip_suffix('K')) {
        ("", Some(per_cent), _) => return number("", per_cent).map(|found| found / 100.0),
        ("°C", _, Some(kelvin)) => return number("", &format!("{kelvin}-273.15")),
        _ => {}
    }
    let (units, unit) = (kind_of(unit), spelled(unit));
    let size = units.iter().find(|(name, _)| *name == unit).map_or(1.0, |(_, size)| *size);
    let mut calculation = Calculation { rest: &text, units, own: size, another: false, with_unit: false, unit: 1.0 };
    let found = calculation.sum()?;
    let power = i32::from(calculation.with_unit);
    let number = if power == 1 { found.number / size } else { found.number };
    let good = calculation.rest.is_empty() && found.power == power && number.is_finite();
    // Writing the number with limited digits and reading it back rounds it.
    if good { format!("{number:.DECIMALS$e}").parse().ok() } else { None }
}

/// A number and the power of its unit: 1 for a length in a sum of lengths.
#[derive(Clone, Copy)]
struct Term {
    number: f64,
    power: i32,
}

struct Calculation<'t> {
    rest: &'t str,
    units: Kind,
    /// Size of the unit of the key, and whether there was another one.
    own: f64,
    another: bool,
    /// Whether any number had a unit.
    with_unit: bool,
    /// Size of the last unit that was read.
    unit: f64,
}

impl Calculation<'_> {
    fn takes(&mut self, word: &str) -> bool {
        let rest = self.rest.strip_prefix(word);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn sum(&mut self) -> Option<Term> {
        let mut sum = self.product()?;
        while let Some(sign) = ["+", "-"].into_iter().find(|sign| self.takes(sign)) {
            let mut next = self.product()?;
            if next.power != sum.power {
                // "100 + 50 nm" is 150 nm if the key is in nanometres anyway.
                let bare = [&mut sum, &mut next].into_iter().find(|term| term.power == 0).filter(|_| !self.another)?;
                *bare = Term { number: bare.number * self.own, power: 1 };
            }
            if next.power != sum.power {
                return None;
            }
            sum.number += if sign == "+" { next.number } else { -next.number };
        }
        Some(sum)
    }

    fn product(&mut self) -> Option<Term> {
        let mut product = self.factor()?;
        let mut unitless = product.power == 0;
        while let Some(sign) = ["*", "/"].into_iter().find(|sign| self.takes(sign)) {
            let simple = self.rest.starts_with(|c: char| c.is_ascii_digit());
            let next = self.factor()?;
            product = match sign {
                "*" => Term { number: product.number * next.number, power: product.power + next.power },
                // "1/4 um" is a quarter of a micrometre.
                _ if unitless && simple && next.power == 1 => {
                    Term { number: product.number / next.number * self.unit * self.unit, power: 1 }
                }
                _ => Term { number: product.number / next.number, power: product.power - next.power },
            };
            unitless &= next.power == 0;
        }
        Some(product)
    }

    fn factor(&mut self) -> Option<Term> {
        if self.takes("-") {
            let factor = self.factor()?;
            return Some(Term { number: -factor.number, ..factor });
        }
        let term = if self.takes("(") {
            let inner = self.sum()?;
            self.takes(")").then_some(inner)?
        } else {
            Term { number: self.digits()?, power: 0 }
        };
        let longest =
            self.units.iter().filter(|(name, _)| self.rest.starts_with(name)).max_by_key(|(name, _)| name.len());
        let Some(&(name, size)) = longest else { return Some(term) };
        self.takes(name);
        (self.with_unit, self.unit) = (true, size);
        self.another |= size != self.own;
        Some(Term { number: term.number * size, power: term.power + 1 })
    }

    fn digits(&mut self) -> Option<f64> {
        let mantissa = self.rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(self.rest.len());
        let exponent = self.rest[mantissa..].strip_prefix(['e', 'E']).map_or(0, |power| {
            let unsigned = power.trim_start_matches(['+', '-']);
            let digits = unsigned.find(|c: char| !c.is_ascii_digit()).unwrap_or(unsigned.len());
            if digits == 0 { 0 } else { 1 + power.len() - unsigned.len() + digits }
        });
        let (number, rest) = self.rest.split_at(mantissa + exponent);
        self.rest = rest;
        number.parse().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::PARAMETERS;

    fn of(key: &str, text: &str) -> Result<f64, String> {
        read(Parameter::find(key).unwrap(), text)
    }

    #[test]
    fn answers_of_lessons_have_units() {
        for (unit, text, expected) in [
            ("N·m", "262 mN·m", Some(0.262)),
            ("N·m", "262mNm", Some(0.262)),
            ("N·m", "5 kHz", None),
            ("mN·s/m", "0.00164 N·s/m", Some(1.64)),
            ("N/µm", "2000 N/mm", Some(2.0)),
        ] {
            assert_eq!(number(unit, text), expected, "{text}");
        }
    }

    #[test]
    fn numbers_are_read_as_people_type_them() {
        for (key, text, expected) in [
            ("film.min_spacing_nm", "250nm", 250.0),
            ("film.min_spacing_nm", "0.2um", 200.0),
            ("film.min_spacing_nm", "0,25 µm", 250.0),
            ("film.min_spacing_nm", "200 + 50", 250.0),
            ("film.min_spacing_nm", "200 + 50 nm", 250.0),
            ("film.min_spacing_nm", "50 nm + 2 * (50 + 50 nm)", 250.0),
            ("film.min_spacing_nm", "50 nm * (2 + 3)", 250.0),
            ("film.min_spacing_nm", "2 × (150nm − 0.05 um) ÷ 4", 50.0),
            ("plate.mean_gap_um", "0,3", 0.3),
            ("plate.mean_gap_um", "0.001mm", 1.0),
            ("plate.mean_gap_um", "-(-1 + 1e-1)", 0.9),
            ("plate.mean_gap_um", "(1+2)um", 3.0),
            ("plate.mean_gap_um", "2um*3um/1um", 6.0),
            ("plate.mean_gap_um", "1/4 mm", 250.0),
            ("plate.mean_gap_um", "2 × 3/4 µm + 1/2 µm", 2.0),
            ("stator.frequency_khz", "40 000Hz", f64::NAN),
            ("stator.frequency_khz", "40000Hz", 40.0),
            ("stator.frequency_khz", "4e4 Hz", 40.0),
            ("film.ambient_pressure_kpa", "1 bar", 100.0),
            ("film.ambient_pressure_kpa", "1atm", 101.325),
            ("film.ambient_pressure_kpa", "1013.25 hPa", 101.325),
            ("motor.load_per_wave_n", "2450mN", 2.45),
            ("film.viscosity_upa_s", "0.0181 mPa s", 18.1),
            ("film.viscosity_upa_s", "18.1 µPa·s", 18.1),
            ("film.altitude_m", "2 km", 2000.0),
            ("film.temperature_c", "20 C", 20.0),
            ("film.temperature_c", "293,15 K", 20.0),
            ("motor.dry_friction", "30 %", 0.3),
            ("rotor.point_compliance_um_per_n", "640 nm/N", 0.64),
            ("rotor.local_compliance_m2_per_n", "1.05e-10 m²/N", 1.05e-10),
            ("motor.waves", "3 + 4", 7.0),
            // The last bits of a plain number are the user's.
            ("film.min_spacing_nm", "200.00000000000003", 200.000_000_000_000_03),
        ] {
            match of(key, text) {
                Ok(found) => assert_eq!(found, expected, "{key} = {text}"),
                Err(message) => assert!(expected.is_nan(), "{message}"),
            }
        }
    }

    #[test]
    fn what_is_no_number_of_this_kind_is_refused_with_what_is_allowed() {
        let nested = "(".repeat(150) + "1";
        let long = "1+".repeat(200) + "1";
        for text in [
            "",
            "wide",
            "250kHz",
            "0.25um + 3",
            "1um*1um",
            "1mm/1um",
            "1/(1mm+4um)",
            "1um/4um/4um",
            "1 2",
            "1.2.3",
            "(1",
            "1)",
            "1/0",
            "nan",
            "1e999",
            "+",
            "2nmm",
            &nested,
            &long,
        ] {
            let message = of("film.min_spacing_nm", text).unwrap_err();
            assert!(message.starts_with("film.min_spacing_nm = "), "{message}");
            assert!(message.contains("from 5 to 10000 nm, in nm, µm, mm, cm, m"), "{message}");
        }
        assert!(of("film.min_spacing_nm", "200 + 0.05 um").unwrap_err().ends_with("if one has another than nm"));
        assert!(of("film.min_spacing_nm", "0.3um - 20").unwrap_err().ends_with("if one has another than nm"));
        assert!(of("film.min_spacing_nm", " ").unwrap_err().starts_with("film.min_spacing_nm = \"\" is not a number"));
        assert!(of("film.ambient_pressure_kpa", "x").unwrap_err().contains("mbar, bar, atm, or"));
        assert!(of("film.temperature_c", "x").unwrap_err().contains("in °C, K, or"));
        assert!(of("motor.waves", "7 mm").unwrap_err().contains("a whole number from 1 to 100"));
    }

    #[test]
    fn every_unit_of_a_key_is_known() {
        for parameter in PARAMETERS.iter().filter(|parameter| !parameter.unit.is_empty()) {
            assert!(!kind_of(parameter.unit).is_empty(), "{}", parameter.key);
        }
    }
}
