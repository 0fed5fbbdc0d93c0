//! Formulas of lessons and of the glossary, in a part of LaTeX. They are read into a tree that the window draws.
//!
//! There are fractions, roots, indices and exponents, Greek letters, some operators, named functions, brackets that grow, dots and
//! bars over a letter, and upright text. An unknown command is an error that names it, so that no formula is drawn wrong.

/// A part of a formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// A letter that stands for a quantity, in italics.
    Letter(char),
    /// Upright text: numbers, units, names of functions.
    Upright(String),
    /// A sign with space on both sides, such as = + ≪.
    Sign(char),
    /// A fraction.
    Fraction(Vec<Self>, Vec<Self>),
    /// A square root.
    Root(Vec<Self>),
    /// Nodes with an index, an exponent, or both.
    Script {
        /// The nodes that carry them.
        base: Vec<Self>,
        /// The index; may be empty.
        index: Vec<Self>,
        /// The exponent; may be empty.
        exponent: Vec<Self>,
    },
    /// Brackets as high as the nodes between them.
    Bracketed(char, Vec<Self>, char),
    /// A mark over a letter.
    Marked(Mark, Vec<Self>),
    /// A horizontal space, as a multiple of the font size.
    Space(f32),
}

/// A mark over a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A dot: the rate of change.
    Dot,
    /// A bar: the mean.
    Bar,
}

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// Its parts, from left to right.
    pub nodes: Vec<Node>,
}

/// The sign of a sum. In a formula on its own line its index is set below it.
pub const SUM: &str = "∑";

const OPEN_BRACE: &str = "{ is never closed";

/// Most levels of nested groups.
const DEEPEST: usize = 24;

/// Commands and the letters they stand for, in turn.
const LETTERS: &str = "alpha α beta β gamma γ delta δ epsilon ε varepsilon ε zeta ζ eta η theta θ kappa κ lambda λ mu μ nu ν \
                       xi ξ pi π rho ρ sigma σ tau τ phi φ varphi φ chi χ psi ψ omega ω ell ℓ";

/// Commands that stand for upright text: capitals, and signs that are not letters.
const SYMBOLS: &str = "Gamma Γ Delta Δ Theta Θ Lambda Λ Phi Φ Psi Ψ Sigma Σ Omega Ω partial ∂ nabla ∇ infty ∞ int ∫ sum ∑ \
                       langle ⟨ rangle ⟩ dots … ldots … circ ° % % $ $ { { } }";

/// Commands that stand for signs with space on both sides.
const SIGNS: &str =
    "approx ≈ le ≤ leq ≤ ge ≥ geq ≥ ne ≠ neq ≠ ll ≪ gg ≫ pm ± cdot · times × propto ∝ sim ∼ to → equiv ≡";

/// The sign that a command stands for, from one of these tables.
fn meaning(table: &str, command: &str) -> Option<char> {
    let mut words = table.split(' ');
    while let (Some(known), Some(sign)) = (words.next(), words.next()) {
        if known == command {
            return sign.chars().next();
        }
    }
    None
}

const FUNCTIONS: &[&str] = &["sin", "cos", "tan", "tanh", "sinh", "cosh", "ln", "log", "exp", "max", "min"];

const SPACES: &[(&str, f32)] = &[(",", 0.17), (":", 0.22), (";", 0.28), (" ", 0.25), ("quad", 1.0), ("qquad", 2.0)];

impl Formula {
    /// Reads a formula; `source` is without its dollars.
    pub fn parse(source: &str) -> Result<Self, String> {
        let mut reader = FormulaReader { rest: source.chars().collect(), at: 0 };
        Ok(Self { nodes: reader.row(End::Text, 0)? })
    }

    /// The formula as one line of plain text, for screen readers, search and messages.
    pub fn plain(&self) -> String {
        plain(&self.nodes).trim().to_owned()
    }
}

fn plain(nodes: &[Node]) -> String {
    let group = |nodes: &[Node]| {
        let text = plain(nodes);
        if nodes.len() > 1 { format!("({text})") } else { text }
    };
    nodes.iter().fold(String::new(), |mut text, node| {
        match node {
            Node::Letter(letter) => text.push(*letter),
            Node::Upright(upright) => text.push_str(upright),
            // A minus at the beginning belongs to the term that follows, without a space.
            Node::Sign(sign) if text.is_empty() || text.ends_with(' ') => text.push(*sign),
            Node::Sign(sign) => text.push_str(&format!(" {sign} ")),
            Node::Fraction(over, under) => text.push_str(&format!("{}/{}", group(over), group(under))),
            Node::Root(inside) => text.push_str(&format!("√({})", plain(inside))),
            Node::Script { base, index, exponent } => {
                text.push_str(&plain(base));
                if !index.is_empty() {
                    text.push_str(&format!("_{}", group(index)));
                }
                if !exponent.is_empty() {
                    text.push_str(&format!("^{}", group(exponent)));
                }
            }
            Node::Bracketed(left, inside, right) => text.push_str(&format!("{left}{}{right}", plain(inside))),
            Node::Marked(Mark::Dot, inside) => text.push_str(&format!("d{}/dt", plain(inside))),
            Node::Marked(Mark::Bar, inside) => text.push_str(&format!("mean {}", plain(inside))),
            Node::Space(room) if *room > 0.0 && !text.ends_with(' ') => text.push(' '),
            Node::Space(_) => {}
        }
        text
    })
}

/// The end of a row: that of the text, `}` or `\right`.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Text,
    Brace,
    Right,
}

struct FormulaReader {
    rest: Vec<char>,
    at: usize,
}

impl FormulaReader {
    fn peek(&self) -> Option<char> {
        self.rest.get(self.at).copied()
    }

    fn next(&mut self) -> Option<char> {
        let next = self.peek();
        self.at += usize::from(next.is_some());
        next
    }

    fn skip_spaces(&mut self) {
        while self.peek().is_some_and(char::is_whitespace) {
            self.at += 1;
        }
    }

    /// The name of a command, after its backslash.
    fn name(&mut self) -> String {
        let mut name = String::new();
        while let Some(letter) = self.peek().filter(char::is_ascii_alphabetic) {
            name.push(letter);
            self.at += 1;
        }
        if name.is_empty() {
            name.extend(self.next());
        }
        name
    }

    /// The nodes until `end`, which is consumed.
    fn row(&mut self, end: End, depth: usize) -> Result<Vec<Node>, String> {
        if depth > DEEPEST {
            return Err(format!("more than {DEEPEST} levels of brackets and scripts"));
        }
        let mut nodes = Vec::new();
        loop {
            self.skip_spaces();
            match self.next() {
                None => {
                    return match end {
                        End::Text => Ok(nodes),
                        End::Brace => Err(OPEN_BRACE.to_owned()),
                        End::Right => Err("\\left is never closed".to_owned()),
                    };
                }
                Some('}') if end == End::Brace => return Ok(nodes),
                Some('}') => return Err("} closes nothing".to_owned()),
                Some(script @ ('^' | '_')) => {
                    let content = self.argument(&script.to_string(), depth)?;
                    let base = nodes.pop();
                    nodes.push(scripted(base, script, content));
                }
                Some('\\') => match self.name().as_str() {
                    "right" if end == End::Right => return Ok(nodes),
                    "right" => return Err("\\right closes nothing".to_owned()),
                    name => nodes.push(self.command(name, depth)?),
                },
                Some(first) => nodes.push(self.single(first, depth)?),
            }
        }
    }

    /// The argument of the command or script `after`: a group in braces, or one item.
    fn argument(&mut self, after: &str, depth: usize) -> Result<Vec<Node>, String> {
        if depth > DEEPEST {
            return Err(format!("more than {DEEPEST} levels of brackets and scripts"));
        }
        self.skip_spaces();
        match self.next() {
            None | Some('}' | '^' | '_') => Err(nothing(after)),
            Some('{') => self.row(End::Brace, depth + 1),
            Some('\\') => match self.name().as_str() {
                "right" => Err(nothing(after)),
                name => Ok(vec![self.command(name, depth + 1)?]),
            },
            // One digit, as in LaTeX.
            Some(digit) if digit.is_ascii_digit() => Ok(vec![Node::Upright(digit.to_string())]),
            Some(first) => Ok(vec![self.single(first, depth + 1)?]),
        }
    }

    /// What begins with a character that is no command: a letter, a number, a sign, a group.
    fn single(&mut self, first: char, depth: usize) -> Result<Node, String> {
        Ok(match first {
            '{' => {
                let inside = self.row(End::Brace, depth + 1)?;
                Node::Script { base: inside, index: Vec::new(), exponent: Vec::new() }
            }
            '0'..='9' => {
                let mut number = String::from(first);
                loop {
                    match (self.peek(), self.rest.get(self.at + 1)) {
                        (Some(digit), _) if digit.is_ascii_digit() => number.push(digit),
                        (Some('.'), Some(next)) if next.is_ascii_digit() => number.push('.'),
                        _ => break,
                    }
                    self.at += 1;
                }
                Node::Upright(number)
            }
            letter if letter.is_ascii_alphabetic() => Node::Letter(letter),
            letter if LETTERS.contains(letter) => Node::Letter(letter),
            '-' | '−' => Node::Sign('−'),
            sign @ ('=' | '+' | '<' | '>' | ':') => Node::Sign(sign),
            '*' => Node::Sign('·'),
            other @ ('(' | ')' | '[' | ']' | '|' | '/' | ',' | '.' | '!' | '°' | '…' | '∂' | '∞' | '%') => {
                Node::Upright(other.to_string())
            }
            '\'' => Node::Upright("′".to_owned()),
            other => return Err(strange(other)),
        })
    }

    fn command(&mut self, name: &str, depth: usize) -> Result<Node, String> {
        if let Some(letter) = meaning(LETTERS, name) {
            return Ok(Node::Letter(letter));
        }
        if let Some(sign) = meaning(SIGNS, name) {
            return Ok(Node::Sign(sign));
        }
        if let Some(symbol) = meaning(SYMBOLS, name) {
            return Ok(Node::Upright(symbol.to_string()));
        }
        if FUNCTIONS.contains(&name) {
            return Ok(Node::Upright(format!("{name}\u{2009}")));
        }
        if let Some((_, room)) = SPACES.iter().find(|(known, _)| *known == name) {
            return Ok(Node::Space(*room));
        }
        let after = format!("\\{name}");
        Ok(match name {
            "frac" => {
                let over = self.argument(&after, depth)?;
                Node::Fraction(over, self.argument(&after, depth)?)
            }
            "sqrt" => Node::Root(self.argument(&after, depth)?),
            "dot" => Node::Marked(Mark::Dot, self.argument(&after, depth)?),
            "bar" => Node::Marked(Mark::Bar, self.argument(&after, depth)?),
            "text" | "mathrm" => {
                self.skip_spaces();
                if self.next() != Some('{') {
                    return Err(nothing(&after));
                }
                let mut text = String::new();
                loop {
                    match self.next() {
                        None => return Err(OPEN_BRACE.to_owned()),
                        Some('}') => break,
                        Some(letter) if letter.is_control() => return Err(strange(letter)),
                        Some(letter) => text.push(letter),
                    }
                }
                Node::Upright(text)
            }
            "left" => {
                let left = self.bracket(&after)?;
                let inside = self.row(End::Right, depth + 1)?;
                let right = self.bracket("\\right")?;
                Node::Bracketed(left, inside, right)
            }
            _ => return Err(unknown(name)),
        })
    }

    fn bracket(&mut self, after: &str) -> Result<char, String> {
        self.skip_spaces();
        match self.next() {
            Some('\\') => match self.name().as_str() {
                "langle" => Ok('⟨'),
                "rangle" => Ok('⟩'),
                name => Err(unknown(name)),
            },
            Some(bracket @ ('(' | ')' | '[' | ']' | '|' | '⟨' | '⟩')) => Ok(bracket),
            Some(other) => Err(strange(other)),
            None => Err(nothing(after)),
        }
    }
}

fn unknown(command: &str) -> String {
    format!(
        "\\{command} is not known in formulas: allowed are letters, digits, \\frac, \\sqrt, \\left( \\right), \\text, \\dot, \\bar, ^, _, Greek letters, and signs such as \\approx, \\le, \\ll, \\cdot, \\partial, \\infty"
    )
}

/// The window's font may not have it.
fn strange(character: char) -> String {
    format!("the character {character:?} is not allowed in formulas")
}

fn nothing(after: &str) -> String {
    format!("nothing follows {after}")
}

/// `base` with one more script.
fn scripted(base: Option<Node>, script: char, content: Vec<Node>) -> Node {
    let (base, mut index, mut exponent) = match base {
        Some(Node::Script { base, index, exponent })
            if !(index.is_empty() && exponent.is_empty())
                && (if script == '_' { index.is_empty() } else { exponent.is_empty() }) =>
        {
            (base, index, exponent)
        }
        Some(node) => (vec![node], Vec::new(), Vec::new()),
        None => (Vec::new(), Vec::new(), Vec::new()),
    };
    if script == '_' {
        index = content
    } else {
        exponent = content
    }
    Node::Script { base, index, exponent }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(source: &str) -> String {
        Formula::parse(source).map_or_else(|error| error, |formula| formula.plain())
    }

    #[test]
    fn formulas_of_the_field_are_read() {
        for (source, expected) in [
            (r"\sigma = \frac{12 \mu \omega b^2}{p_a h_0^2}", "σ = (12μωb^2)/(p_ah_0^2)"),
            (r"p = p_a \frac{h_0}{h}", "p = p_ah_0/h"),
            (
                r"\langle P \rangle = \sqrt{\frac{1 + \frac{3}{2}\varepsilon^2}{1 - \varepsilon^2}}",
                "⟨P⟩ = √((1 + 3/2ε^2)/(1 − ε^2))",
            ),
            (r"F = -\frac{\mu b^3 \dot h}{h^3}", "F = −(μb^3dh/dt)/h^3"),
            (r"T_\text{max} = \mu_d (1 - \alpha) L r", "T_max = μ_d(1 − α)Lr"),
            (r"\left( 1 + \frac{6 \lambda_a}{h} \right)", "(1 + (6λ_a)/h)"),
            (r"x^10", "x^10"),
            (r"\sum_{n\text{ odd}} \frac{1}{n^2}", "∑_(n odd)1/n^2"),
            (r"\left\langle H \right\rangle", "⟨H⟩"),
        ] {
            assert_eq!(read(source), expected, "{source}");
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (source, part) in [
            (r"\begin{x}", "\\begin is not known"),
            (r"\frac{1}", "nothing follows \\frac"),
            ("{a", "{ is never closed"),
            ("a}", "} closes nothing"),
            (r"\left( a", "\\left is never closed"),
            (r"a \right)", "\\right closes nothing"),
            ("a^", "nothing follows ^"),
            ("a & b", "'&' is not allowed"),
            ("ø", "'ø' is not allowed"),
        ] {
            assert!(read(source).contains(part), "{source}: {}", read(source));
        }
        assert!(read(&"{".repeat(1000)).contains("levels"));
        assert!(read(&"x^".repeat(1000)).contains("nothing follows"));
        assert!(read(&r"\sqrt".repeat(1000)).contains("levels"));
    }
}
