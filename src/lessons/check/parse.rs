//! Reads the comparisons of a check.

use super::comparison::{ABOUT, Comparison, Expression, Operator};
use super::name::{Name, name};
use crate::scene::{ParameterKind, Scene};

/// Most levels of nested brackets.
const DEEPEST: usize = 32;
const OPERATORS: &str = "expected one of < <= > >= = about";
const VALUE: &str = "expected a number, the name of a result, a key of the scene, or a bracket";

/// The message of what is there, where something else was expected.
pub(super) fn unexpected(found: &str, expected: &str) -> String {
    format!("{found} is not expected here: {expected}")
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

/// Operators as they are written, and as they are shown in messages. Those of two characters come first.
const WRITTEN: [(&str, Operator, &str); 6] = [
    ("<=", Operator::AtMost, "<="),
    (">=", Operator::AtLeast, ">="),
    ("==", Operator::Equal, "="),
    ("<", Operator::Less, "<"),
    (">", Operator::More, ">"),
    ("=", Operator::Equal, "="),
];

fn tokens(source: &str) -> Result<Vec<Token>, String> {
    let mut tokens = Vec::new();
    let mut rest = source.trim_start();
    while let Some(first) = rest.chars().next() {
        let (token, length) = if let Some((written, operator, shown)) =
            WRITTEN.into_iter().find(|(written, ..)| rest.starts_with(written))
        {
            (Token::Operator(operator, shown), written.len())
        } else if "+-*/()".contains(first) {
            (Token::Sign(first), 1)
        } else if first == '"' {
            let Some(end) = rest[1..].find('"') else { return Err(unexpected(rest, "expected a closing quote")) };
            (Token::Text(rest[1..=end].to_owned()), end + 2)
        } else if first.is_ascii_digit() {
            let mut before = first;
            let text = leading(rest, |c| {
                let signed = matches!(before, 'e' | 'E') && matches!(c, '+' | '-');
                before = c;
                signed || c.is_ascii_alphanumeric() || c == '.'
            });
            let Ok(number) = text.parse() else { return Err(unexpected(text, VALUE)) };
            (Token::Number(number, text.to_owned()), text.len())
        } else {
            let token = match leading(rest, |c| c.is_ascii_alphanumeric() || matches!(c, '_' | '.')) {
                "and" => Token::And,
                "about" => Token::Operator(Operator::About, "about"),
                name if first.is_ascii_alphabetic() || first == '_' => Token::Name(name.to_owned()),
                _ => return Err(unexpected(&first.to_string(), VALUE)),
            };
            let length = token.text().len();
            (token, length)
        };
        tokens.push(token);
        rest = rest[length..].trim_start();
    }
    Ok(tokens)
}

/// The characters at the beginning of a text that are `inside` a token.
fn leading(text: &str, mut inside: impl FnMut(char) -> bool) -> &str {
    &text[..text.find(|c: char| !inside(c)).unwrap_or(text.len())]
}

/// Reads the comparisons of a check for steps on `scene`.
pub(super) fn comparisons(source: &str, scene: &Scene) -> Result<Vec<Comparison>, String> {
    let tokens = tokens(source)?;
    let mut reader = CheckReader { tokens: &tokens, at: 0, scene, depth: 0 };
    let mut comparisons = vec![reader.comparison()?];
    while reader.takes(&Token::And) {
        comparisons.push(reader.comparison()?);
    }
    if reader.at < tokens.len() {
        return Err(reader.unexpected("expected and, or the end of the check"));
    }
    Ok(comparisons)
}

/// Reads an expression for steps on `scene`.
pub(super) fn expression(source: &str, scene: &Scene) -> Result<Expression, String> {
    let tokens = tokens(source)?;
    let mut reader = CheckReader { tokens: &tokens, at: 0, scene, depth: 0 };
    let sum = reader.sum()?;
    if reader.at < tokens.len() {
        return Err(reader.unexpected("expected + - * / or the end of the number"));
    }
    numeric(&sum)?;
    Ok(sum)
}

struct CheckReader<'a> {
    tokens: &'a [Token],
    at: usize,
    scene: &'a Scene,
    depth: usize,
}

impl CheckReader<'_> {
    fn takes(&mut self, token: &Token) -> bool {
        let takes = self.tokens.get(self.at) == Some(token);
        self.at += usize::from(takes);
        takes
    }

    fn unexpected(&self, expected: &str) -> String {
        unexpected(&self.tokens.get(self.at).map_or_else(|| "the end".to_owned(), Token::text), expected)
    }

    fn comparison(&mut self) -> Result<Comparison, String> {
        let from = self.at;
        let left = self.sum()?;
        let words: Vec<String> = self.tokens[from..self.at].iter().map(Token::text).collect();
        let Some(Token::Operator(operator, _)) = self.tokens.get(self.at) else {
            return Err(self.unexpected(OPERATORS));
        };
        self.at += 1;
        let right = self.sum()?;
        let mut within = ABOUT;
        if *operator == Operator::About && self.takes(&Token::Name("within".to_owned())) {
            let Some(Token::Number(share, _)) = self.tokens.get(self.at) else {
                return Err(self.unexpected("expected a relative tolerance, as 0.02"));
            };
            self.at += 1;
            within = *share;
        }
        types(&left, *operator, &right)?;
        Ok(Comparison { left, operator: *operator, right, within, words: words.join(" ") })
    }

    fn sum(&mut self) -> Result<Expression, String> {
        self.chain("+-", |reader| reader.chain("*/", Self::factor))
    }

    /// Parts with these signs between them, from left to right.
    fn chain(&mut self, signs: &str, part: fn(&mut Self) -> Result<Expression, String>) -> Result<Expression, String> {
        let mut all = part(self)?;
        while let Some(Token::Sign(sign)) = self.tokens.get(self.at)
            && signs.contains(*sign)
        {
            self.at += 1;
            all = Expression::Pair(*sign, Box::new(all), Box::new(part(self)?));
        }
        Ok(all)
    }

    fn factor(&mut self) -> Result<Expression, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!("more than {DEEPEST} levels of brackets"));
        }
        let Some(token) = self.tokens.get(self.at) else { return Err(self.unexpected(VALUE)) };
        self.at += 1;
        let factor = match token {
            Token::Number(number, _) => Expression::Number(*number),
            Token::Text(text) => Expression::Text(text.clone()),
            Token::Name(text) if text == "true" || text == "false" => Expression::Text(text.clone()),
            Token::Name(text) if text == "abs" && self.takes(&Token::Sign('(')) => {
                Expression::Absolute(Box::new(self.bracketed()?))
            }
            Token::Name(text) => {
                let (start, text) = text.strip_prefix("start.").map_or((false, text.as_str()), |rest| (true, rest));
                let name = name(text)?;
                if !name.belongs(self.scene) {
                    let (name, scene) = (name.text(), self.scene.scene());
                    return Err(format!("{name} belongs to another kind of scene; this step's is a {scene}"));
                }
                Expression::Name { name, start }
            }
            Token::Sign('-') => Expression::Negative(Box::new(self.factor()?)),
            Token::Sign('(') => self.bracketed()?,
            Token::Sign(_) | Token::Operator(..) | Token::And => {
                self.at -= 1;
                return Err(self.unexpected(VALUE));
            }
        };
        self.depth -= 1;
        Ok(factor)
    }

    /// Reads the contents of an open bracket, and its closing one.
    fn bracketed(&mut self) -> Result<Expression, String> {
        let inside = self.sum()?;
        if self.takes(&Token::Sign(')')) { Ok(inside) } else { Err(self.unexpected("expected )")) }
    }
}

/// Checks the types of a comparison: a key whose value is a word is compared by `=` with one of its words, everything else with numbers.
fn types(left: &Expression, operator: Operator, right: &Expression) -> Result<(), String> {
    if let Expression::Name { name: Name::Key(parameter), start: false } = left
        && let (Operator::Equal, Expression::Text(value)) = (operator, right)
    {
        let fits = match parameter.kind {
            ParameterKind::Choice { options, .. } => options.contains(&value.as_str()),
            ParameterKind::Flag { .. } => ["true", "false"].contains(&value.as_str()),
            _ => parameter.absent.is_some() && value == "none",
        };
        let (name, expected) = (parameter.key, parameter.accepts());
        return if fits { Ok(()) } else { Err(format!("\"{value}\" is not a value of {name}: expected {expected}")) };
    }
    numeric(left).and_then(|()| numeric(right))
}

fn numeric(expression: &Expression) -> Result<(), String> {
    match expression {
        Expression::Number(_) => Ok(()),
        Expression::Text(text) => Err(unexpected(&format!("\"{text}\""), VALUE)),
        Expression::Name { name: Name::Key(parameter), .. } if parameter.range().is_none() => {
            Err(format!("{} is no number: compare it with = and {}", parameter.key, parameter.accepts()))
        }
        Expression::Name { .. } => Ok(()),
        Expression::Negative(inside) | Expression::Absolute(inside) => numeric(inside),
        Expression::Pair(_, left, right) => numeric(left).and_then(|()| numeric(right)),
    }
}
