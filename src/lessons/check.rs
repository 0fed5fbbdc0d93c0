//! What a lesson asks of the student's own run, as it is written in a lesson:
//!
//! ```text
//! alpha > 1.5 * start.alpha and film.min_spacing_nm <= 100
//! ```
//!
//! Comparisons joined by `and`. A comparison is `< <= > >= =` or `about` (within 5 %) between two sums of numbers, names
//! of results ([`Quantity::name`]), what is read off a tab ([`Live::name`]) and keys of the scene; `start.` before a name is its
//! value when the step began. A key that is a name or a flag is compared with `=`: `film.slip = "none"`.

use super::live::{Live, Readings};
use crate::analysis::quantity::{Numbers, Quantity};
use crate::digits::short;
use crate::scene::{PARAMETERS, Parameter, ParameterKind, Scene, Value};

/// How near `about` is, relative.
pub const ABOUT: f64 = 0.05;
/// How near `=` is for numbers, relative: what a person typed.
const SAME: f64 = 1e-9;
/// Levels of brackets.
const DEEPEST: usize = 32;
/// Digits in a hint.
const DIGITS: usize = 3;

/// A check, as it was written and as it is evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// As written.
    pub source: String,
    comparisons: Vec<Comparison>,
}

#[derive(Clone, Debug, PartialEq)]
struct Comparison {
    left: Expression,
    operator: Operator,
    right: Expression,
    /// The left side as written.
    words: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operator {
    Less,
    AtMost,
    More,
    AtLeast,
    Equal,
    About,
}

#[derive(Clone, Debug, PartialEq)]
enum Expression {
    Number(f64),
    Text(String),
    Name { name: Name, start: bool },
    Negative(Box<Self>),
    Absolute(Box<Self>),
    Pair(char, Box<Self>, Box<Self>),
}

/// What a name in a check stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Name {
    /// A result.
    Quantity(Quantity),
    /// What is read off a tab.
    Live(Live),
    /// A key of the scene.
    Key(&'static Parameter),
}

/// A run to check: what was solved, and its numbers.
#[derive(Clone, Copy, Debug)]
pub struct Ran<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its results.
    pub numbers: &'a Numbers,
    /// What is read off the tabs.
    pub live: &'a Readings,
}

/// Why a check cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CheckError {
    /// A name that is neither a result nor a key.
    #[error("{name} is neither a result nor a key of the scene{}", suggestion(nearest.as_deref()))]
    Unknown {
        /// As written.
        name: String,
        /// The nearest name.
        nearest: Option<String>,
    },
    /// Something else was expected.
    #[error("{found} is not expected here: {expected}")]
    Unexpected {
        /// What is there.
        found: String,
        /// What may be there.
        expected: &'static str,
    },
    /// A result or key that the step's scene does not have.
    #[error("{name} belongs to another kind of scene; this step's is a {scene}")]
    NotHere {
        /// The name.
        name: &'static str,
        /// "motor" or "plate".
        scene: &'static str,
    },
    /// A name or flag in a sum, or compared with a number.
    #[error("{name} is no number: compare it with = and {expected}")]
    NoNumber {
        /// The key.
        name: &'static str,
        /// What it accepts.
        expected: String,
    },
    /// A text that is not one of the key's names.
    #[error("\"{value}\" is not a value of {name}: expected {expected}")]
    NoChoice {
        /// The key.
        name: &'static str,
        /// As written.
        value: String,
        /// What it accepts.
        expected: String,
    },
    /// Deeper than any check.
    #[error("more than {0} levels of brackets")]
    TooDeep(usize),
}

fn suggestion(nearest: Option<&str>) -> String {
    nearest.map_or_else(
        || {
            "; results are called as in --json (alpha, film_load_n, …), keys as in a preset (film.min_spacing_nm, …)"
                .to_owned()
        },
        |name| format!(": did you mean {name}?"),
    )
}

const OPERATORS: &str = "expected one of < <= > >= = about";
const VALUE: &str = "expected a number, the name of a result, a key of the scene, or a bracket";

/// The name of a result or a key.
///
/// # Errors
/// If there is none; with the nearest.
pub fn name(text: &str) -> Result<Name, CheckError> {
    if let Some(quantity) = Quantity::all().find(|quantity| quantity.name() == text) {
        return Ok(Name::Quantity(quantity));
    }
    if let Some(live) = Live::all().find(|live| live.name() == text) {
        return Ok(Name::Live(live));
    }
    if let Some(parameter) = Parameter::find(text) {
        return Ok(Name::Key(parameter));
    }
    let results = Quantity::all().map(Quantity::name).chain(Live::all().map(Live::name));
    let known = results.chain(PARAMETERS.iter().map(|parameter| parameter.key));
    let scored = known.map(|known| (strsim::jaro_winkler(text, known), known));
    let best = scored.reduce(|best, next| if next.0 > best.0 { next } else { best });
    let nearest = best.filter(|best| best.0 > 0.75).map(|best| best.1.to_owned());
    Err(CheckError::Unknown { name: text.to_owned(), nearest })
}

impl Name {
    /// As it is written in a check.
    pub fn text(self) -> &'static str {
        match self {
            Self::Quantity(quantity) => quantity.name(),
            Self::Live(live) => live.name(),
            Self::Key(parameter) => parameter.key,
        }
    }

    /// In words.
    pub fn words(self) -> String {
        match self {
            Self::Quantity(quantity) => quantity.words().to_owned(),
            Self::Live(live) => live.words().to_owned(),
            Self::Key(parameter) => parameter.words(),
        }
    }

    /// Its unit in this scene.
    pub fn unit(self, scene: &Scene) -> &'static str {
        match self {
            Self::Quantity(quantity) => {
                crate::problem::Problem::new(scene).map_or("", |problem| quantity.unit(&problem))
            }
            Self::Live(live) => live.unit(),
            Self::Key(parameter) => parameter.unit,
        }
    }

    /// Whether a scene has it.
    pub fn belongs(self, scene: &Scene) -> bool {
        let problem = || crate::problem::Problem::new(scene);
        match self {
            Self::Quantity(quantity) => problem().is_ok_and(|problem| Quantity::of(&problem).any(|q| q == quantity)),
            Self::Live(live) => problem().is_ok_and(|problem| live.belongs(&problem.scenario)),
            Self::Key(parameter) => scene.parameters().any(|other| other.key == parameter.key),
        }
    }

    fn number(self, ran: Ran<'_>) -> Option<f64> {
        match self {
            Self::Quantity(quantity) => ran.numbers.get(quantity),
            Self::Live(live) => ran.live.get(live),
            Self::Key(parameter) => ran.scene.get(parameter.key)?.as_number(),
        }
    }
}

/// What a check says of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Everything holds.
    Holds,
    /// The first that does not, in words.
    Not(String),
}

impl Check {
    /// Reads a check for steps on `scene`.
    ///
    /// # Errors
    /// Unknown names, names of another kind of scene, and what is no comparison.
    pub fn parse(source: &str, scene: &Scene) -> Result<Self, CheckError> {
        let tokens = tokens(source)?;
        let mut reader = Reader { tokens: &tokens, at: 0, scene, depth: 0 };
        let mut comparisons = vec![reader.comparison()?];
        while reader.takes(&Token::And) {
            comparisons.push(reader.comparison()?);
        }
        match reader.tokens.get(reader.at) {
            None => Ok(Self { source: source.trim().to_owned(), comparisons }),
            Some(token) => {
                Err(CheckError::Unexpected { found: token.text(), expected: "expected and, or the end of the check" })
            }
        }
    }

    /// What it reads off tabs.
    pub fn live(&self) -> impl Iterator<Item = Live> {
        let mut found = Vec::new();
        for comparison in &self.comparisons {
            comparison.left.live(&mut found);
            comparison.right.live(&mut found);
        }
        found.into_iter()
    }

    /// Whether it holds for `now`, when the step began with `start`.
    pub fn verdict(&self, now: Ran<'_>, start: Ran<'_>) -> Verdict {
        self.comparisons.iter().find_map(|comparison| comparison.unmet(now, start)).map_or(Verdict::Holds, Verdict::Not)
    }
}

impl Comparison {
    /// In words why it does not hold.
    fn unmet(&self, now: Ran<'_>, start: Ran<'_>) -> Option<String> {
        let subject = match &self.left {
            Expression::Name { name, start: false } => capitalised(&name.words()),
            _ => self.words.clone(),
        };
        if let (Expression::Name { name: Name::Key(key), .. }, Expression::Text(wanted)) = (&self.left, &self.right) {
            let present = match now.scene.get(key.key) {
                Some(Value::Text(text)) => text,
                Some(other) => other.to_string(),
                None => "none".to_owned(),
            };
            return (present != *wanted).then(|| format!("{subject} is {present}, and should be {wanted}"));
        }
        let (Some(left), Some(right)) = (self.left.value(now, start), self.right.value(now, start)) else {
            let tab = match &self.left {
                Expression::Name { name: Name::Live(live), .. } => format!("yet: see the tab {}", live.tab()),
                _ => "for this scene".to_owned(),
            };
            return Some(format!("{subject} is not known {tab}"));
        };
        let unit = match &self.left {
            Expression::Name { name, .. } => format!(" {}", name.unit(now.scene)).trim_end().to_owned(),
            _ => String::new(),
        };
        let shown = |value: f64| short(value, DIGITS).replace('-', "−");
        let words = match self.operator {
            Operator::Less => "below",
            Operator::AtMost => "at most",
            Operator::More => "above",
            Operator::AtLeast => "at least",
            Operator::Equal => "",
            Operator::About => "about",
        };
        let space = if words.is_empty() { "" } else { " " };
        let (is, wanted) = (shown(left), shown(right));
        (!self.operator.holds(left, right))
            .then(|| format!("{subject} is {is}{unit}, and should be {words}{space}{wanted}{unit}"))
    }
}

impl Operator {
    fn holds(self, left: f64, right: f64) -> bool {
        let off = (left - right).abs();
        match self {
            Self::Less => left < right,
            Self::AtMost => left <= right * (1.0 + SAME.copysign(right)),
            Self::More => left > right,
            Self::AtLeast => left >= right * (1.0 - SAME.copysign(right)),
            Self::Equal => off <= SAME * right.abs().max(f64::MIN_POSITIVE),
            Self::About => off <= ABOUT * right.abs(),
        }
    }
}

impl Expression {
    fn live(&self, found: &mut Vec<Live>) {
        match self {
            Self::Number(_) | Self::Text(_) => {}
            Self::Name { name, .. } => found.extend(if let Name::Live(live) = name { Some(*live) } else { None }),
            Self::Negative(inside) | Self::Absolute(inside) => inside.live(found),
            Self::Pair(_, left, right) => {
                left.live(found);
                right.live(found);
            }
        }
    }

    fn value(&self, now: Ran<'_>, begun: Ran<'_>) -> Option<f64> {
        let value = match self {
            Self::Number(number) => *number,
            Self::Text(_) => return None,
            Self::Name { name, start } => name.number(if *start { begun } else { now })?,
            Self::Negative(inside) => -inside.value(now, begun)?,
            Self::Absolute(inside) => inside.value(now, begun)?.abs(),
            Self::Pair(operator, left, right) => {
                let (left, right) = (left.value(now, begun)?, right.value(now, begun)?);
                match operator {
                    '+' => left + right,
                    '-' => left - right,
                    '*' => left * right,
                    _ => left / right,
                }
            }
        };
        value.is_finite().then_some(value)
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Number(f64, String),
    Name(String),
    Text(String),
    Operator(Operator, &'static str),
    Sign(char),
    And,
}

impl Token {
    fn text(&self) -> String {
        match self {
            Self::Number(_, text) | Self::Name(text) => text.clone(),
            Self::Text(text) => format!("\"{text}\""),
            Self::Operator(_, text) => (*text).to_owned(),
            Self::Sign(sign) => sign.to_string(),
            Self::And => "and".to_owned(),
        }
    }
}

fn tokens(source: &str) -> Result<Vec<Token>, CheckError> {
    let chars: Vec<char> = source.chars().collect();
    let mut tokens = Vec::new();
    let mut at = 0;
    let run = |from: usize, inside: &dyn Fn(char, char) -> bool| {
        let mut to = from + 1;
        while to < chars.len() && inside(chars[to - 1], chars[to]) {
            to += 1;
        }
        (chars[from..to].iter().collect::<String>(), to)
    };
    while at < chars.len() {
        let first = chars[at];
        let second = chars.get(at + 1).copied();
        let mut length = 1;
        match (first, second) {
            (space, _) if space.is_whitespace() => {}
            ('0'..='9', _) => {
                let (text, to) = run(at, &|before, c| {
                    c.is_ascii_alphanumeric() || c == '.' || (matches!(before, 'e' | 'E') && matches!(c, '+' | '-'))
                });
                let unexpected = || CheckError::Unexpected { found: text.clone(), expected: VALUE };
                let number = text.parse().map_err(|_| unexpected())?;
                tokens.push(Token::Number(number, text));
                length = to - at;
            }
            (letter, _) if letter.is_ascii_alphabetic() || letter == '_' => {
                let (text, to) = run(at, &|_, c| c.is_ascii_alphanumeric() || c == '_' || c == '.');
                tokens.push(match text.as_str() {
                    "and" => Token::And,
                    "about" => Token::Operator(Operator::About, "about"),
                    _ => Token::Name(text),
                });
                length = to - at;
            }
            ('"', _) => {
                let end = chars[at + 1..].iter().position(|c| *c == '"');
                let Some(end) = end else {
                    let found: String = chars[at..].iter().collect();
                    return Err(CheckError::Unexpected { found, expected: "expected a closing quote" });
                };
                tokens.push(Token::Text(chars[at + 1..at + 1 + end].iter().collect()));
                length = end + 2;
            }
            ('<', Some('=')) => (tokens.push(Token::Operator(Operator::AtMost, "<=")), length = 2).1,
            ('>', Some('=')) => (tokens.push(Token::Operator(Operator::AtLeast, ">=")), length = 2).1,
            ('=', Some('=')) => (tokens.push(Token::Operator(Operator::Equal, "=")), length = 2).1,
            ('<', _) => tokens.push(Token::Operator(Operator::Less, "<")),
            ('>', _) => tokens.push(Token::Operator(Operator::More, ">")),
            ('=', _) => tokens.push(Token::Operator(Operator::Equal, "=")),
            ('+' | '-' | '*' | '/' | '(' | ')', _) => tokens.push(Token::Sign(first)),
            _ => return Err(CheckError::Unexpected { found: first.to_string(), expected: VALUE }),
        }
        at += length;
    }
    Ok(tokens)
}

struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
    scene: &'a Scene,
    depth: usize,
}

impl Reader<'_> {
    fn takes(&mut self, token: &Token) -> bool {
        let takes = self.tokens.get(self.at) == Some(token);
        self.at += usize::from(takes);
        takes
    }

    fn unexpected(&self, expected: &'static str) -> CheckError {
        let found = self.tokens.get(self.at).map_or_else(|| "the end of the check".to_owned(), Token::text);
        CheckError::Unexpected { found, expected }
    }

    fn comparison(&mut self) -> Result<Comparison, CheckError> {
        let from = self.at;
        let left = self.sum()?;
        let words: Vec<String> = self.tokens[from..self.at].iter().map(Token::text).collect();
        let Some(Token::Operator(operator, _)) = self.tokens.get(self.at) else {
            return Err(self.unexpected(OPERATORS));
        };
        self.at += 1;
        let right = self.sum()?;
        let comparison = Comparison { left, operator: *operator, right, words: words.join(" ") };
        self.types(&comparison)?;
        Ok(comparison)
    }

    /// Names and flags are compared with `=` and one of their values; everything else with numbers.
    fn types(&self, comparison: &Comparison) -> Result<(), CheckError> {
        let accepted = |parameter: &Parameter| parameter.accepts();
        if let Expression::Name { name: Name::Key(parameter), start: false } = comparison.left {
            let is_number = parameter.range().is_some();
            match (&comparison.right, comparison.operator) {
                (Expression::Text(value), Operator::Equal) => {
                    let fits = match parameter.kind {
                        ParameterKind::Choice { options, .. } => options.contains(&value.as_str()),
                        ParameterKind::Flag { .. } => ["true", "false"].contains(&value.as_str()),
                        _ => parameter.absent.is_some() && value == "none",
                    };
                    let no_choice = || CheckError::NoChoice {
                        name: parameter.key,
                        value: value.clone(),
                        expected: accepted(parameter),
                    };
                    return if fits { Ok(()) } else { Err(no_choice()) };
                }
                _ if !is_number => {
                    return Err(CheckError::NoNumber { name: parameter.key, expected: accepted(parameter) });
                }
                _ => {}
            }
        }
        for side in [&comparison.left, &comparison.right] {
            numeric(side)?;
        }
        Ok(())
    }

    fn sum(&mut self) -> Result<Expression, CheckError> {
        let mut sum = self.product()?;
        while let Some(Token::Sign(sign @ ('+' | '-'))) = self.tokens.get(self.at) {
            self.at += 1;
            sum = Expression::Pair(*sign, Box::new(sum), Box::new(self.product()?));
        }
        Ok(sum)
    }

    fn product(&mut self) -> Result<Expression, CheckError> {
        let mut product = self.factor()?;
        while let Some(Token::Sign(sign @ ('*' | '/'))) = self.tokens.get(self.at) {
            self.at += 1;
            product = Expression::Pair(*sign, Box::new(product), Box::new(self.factor()?));
        }
        Ok(product)
    }

    fn factor(&mut self) -> Result<Expression, CheckError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(CheckError::TooDeep(DEEPEST));
        }
        let Some(token) = self.tokens.get(self.at) else { return Err(self.unexpected(VALUE)) };
        self.at += 1;
        let factor = match token {
            Token::Number(number, _) => Expression::Number(*number),
            Token::Text(text) => Expression::Text(text.clone()),
            Token::Name(text) if text == "true" || text == "false" => Expression::Text(text.clone()),
            Token::Name(text) if text == "abs" && self.takes(&Token::Sign('(')) => {
                let inside = self.sum()?;
                self.close()?;
                Expression::Absolute(Box::new(inside))
            }
            Token::Name(text) => {
                let (start, text) = text.strip_prefix("start.").map_or((false, text.as_str()), |rest| (true, rest));
                let name = name(text)?;
                if !name.belongs(self.scene) {
                    return Err(CheckError::NotHere { name: name.text(), scene: self.scene.scene() });
                }
                Expression::Name { name, start }
            }
            Token::Sign('-') => Expression::Negative(Box::new(self.factor()?)),
            Token::Sign('(') => {
                let inside = self.sum()?;
                self.close()?;
                inside
            }
            Token::Sign(_) | Token::Operator(..) | Token::And => {
                self.at -= 1;
                return Err(self.unexpected(VALUE));
            }
        };
        self.depth -= 1;
        Ok(factor)
    }

    fn close(&mut self) -> Result<(), CheckError> {
        if self.takes(&Token::Sign(')')) { Ok(()) } else { Err(self.unexpected("expected )")) }
    }
}

fn numeric(expression: &Expression) -> Result<(), CheckError> {
    match expression {
        Expression::Number(_) => Ok(()),
        Expression::Text(text) => Err(CheckError::Unexpected { found: format!("\"{text}\""), expected: VALUE }),
        Expression::Name { name: Name::Key(parameter), .. } if parameter.range().is_none() => {
            Err(CheckError::NoNumber { name: parameter.key, expected: parameter.accepts() })
        }
        Expression::Name { .. } => Ok(()),
        Expression::Negative(inside) | Expression::Absolute(inside) => numeric(inside),
        Expression::Pair(_, left, right) => numeric(left).and_then(|()| numeric(right)),
    }
}

fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(source: &str, set: &[(&str, &str)], alpha: f64) -> Verdict {
        let start = Scene::motor();
        let mut now = start.clone();
        now.set_all(set.iter().copied()).unwrap();
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
        check.verdict(now, Ran { scene: &start, numbers: &before, live: &rest })
    }

    #[test]
    fn comparisons_hold_or_say_why_not() {
        let halved = [("film.min_spacing_nm", "100")];
        let source = "alpha > 1.5 * start.alpha and film.min_spacing_nm <= start.film.min_spacing_nm / 2";
        assert_eq!(verdict(source, &halved, 0.5), Verdict::Holds);
        assert_eq!(
            verdict(source, &halved, 0.3),
            Verdict::Not("Film share of the load α is 0.3, and should be above 0.375".to_owned())
        );
        assert_eq!(
            verdict(source, &[("film.min_spacing_nm", "150")], 0.5),
            Verdict::Not("Min spacing is 150 nm, and should be at most 100 nm".to_owned())
        );
        assert_eq!(verdict("alpha about 0.5", &[], 0.51), Verdict::Holds);
        assert_ne!(verdict("alpha about 0.5", &[], 0.53), Verdict::Holds);
        assert_eq!(verdict("abs(alpha - 1) < 0.1 and -(alpha) < 0", &[], 1.05), Verdict::Holds);
        assert_ne!(verdict("film_load_n > 1", &[], 0.5), Verdict::Holds, "what is not there holds nothing");
        assert_ne!(verdict("alpha / (motor.waves - 7) > 0", &[], 0.5), Verdict::Holds);
        assert_eq!(verdict("startup.cycles >= 5", &[], 0.5), Verdict::Holds);
        assert_eq!(
            verdict("startup.cycles > 5", &[], 0.5),
            Verdict::Not("Cycles since rest is 5, and should be above 5".to_owned())
        );
        assert_eq!(
            verdict("torque.stall_nm > 0", &[], 0.5),
            Verdict::Not("Stall torque is not known yet: see the tab Torque".to_owned())
        );
        assert_eq!(
            verdict(
                "film.slip = \"none\" and film.shear = false",
                &[("film.slip", "none"), ("film.shear", "false")],
                0.5
            ),
            Verdict::Holds
        );
        assert_eq!(
            verdict("film.slip = \"none\"", &[], 0.5),
            Verdict::Not("Slip is first-order, and should be none".to_owned())
        );
        assert_eq!(verdict("stator.tooth_radius_m = \"none\"", &[], 0.5), Verdict::Holds);
        assert_ne!(verdict("stator.tooth_radius_m = \"none\"", &[("stator.tooth_radius_m", "3")], 0.5), Verdict::Holds);
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
            ("alpha", "the end of the check is not expected here: expected one of <"),
            ("alpha > ", "the end of the check is not expected"),
            ("alpha > 1 alpha", "alpha is not expected here: expected and"),
            ("alpha > 1 and", "the end of the check"),
            ("(alpha > 1", "> is not expected here: expected )"),
            ("alpha ~ 1", "~ is not expected"),
            ("1.2.3 < alpha", "1.2.3 is not expected"),
            ("film.slip > 1", "film.slip is no number"),
            ("film.slip = \"noen\"", "\"noen\" is not a value of film.slip: expected one of \"none\""),
            ("film.slip = \"none", "closing quote"),
            ("alpha = \"none\"", "\"none\" is not expected"),
            ("2 * film.slip > 1", "film.slip is no number"),
            ("", "the end of the check"),
        ] {
            let error = Check::parse(source, &Scene::motor()).unwrap_err().to_string();
            assert!(error.contains(part), "{source}: {error}");
        }
        let deep = format!("{}alpha > 1", "(".repeat(10_000));
        assert!(Check::parse(&deep, &Scene::motor()).unwrap_err().to_string().contains("levels"));
    }
}
