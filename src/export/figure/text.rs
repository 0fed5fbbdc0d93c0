//! Text of a figure: its width in the bundled font, and its raised and lowered parts.

use crate::platform::{dejavu, liberation};
use std::sync::LazyLock;
use ttf_parser::Face;

/// The fonts asked for in an SVG, best first.
pub(super) const FAMILIES: &str = "Liberation Sans, Arial, Helvetica, DejaVu Sans, sans-serif";
/// Size of raised and lowered text, relative to the text round it.
pub(super) const SMALL: f64 = 0.72;

/// Whether a piece of text is on the baseline, raised or lowered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Script {
    Normal,
    Raised,
    Lowered,
}

/// Splits text into pieces that are on the baseline, raised or lowered: `^{…}`, `_{…}`, the raised and lowered characters of Unicode, the
/// index of a symbol (`H_m`) and the exponent of a number (`10^-5`).
pub(super) fn pieces(text: &str) -> Vec<(Script, String)> {
    let mut pieces: Vec<(Script, String)> = Vec::new();
    let mut push = |script: Script, c: char| match pieces.last_mut() {
        Some((last, piece)) if *last == script => piece.push(c),
        _ => pieces.push((script, c.to_string())),
    };
    let chars: Vec<char> = text.chars().collect();
    let mut i = 0;
    while let Some(&c) = chars.get(i) {
        i += 1;
        let script = match c {
            '^' => Script::Raised,
            '_' => Script::Lowered,
            _ => Script::Normal,
        };
        if script != Script::Normal && chars.get(i) == Some(&'{') {
            let group = chars[i + 1..].iter().take_while(|c| **c != '}');
            i += 2 + group.clone().count();
            group.for_each(|c| push(script, *c));
            continue;
        }
        let bare = match script {
            Script::Normal => 0,
            Script::Raised => exponent(&chars[..i - 1], &chars[i..]),
            Script::Lowered => index(&chars[..i - 1], &chars[i..]),
        };
        if bare > 0 {
            chars[i..i + bare].iter().for_each(|c| push(script, if *c == '-' { '−' } else { *c }));
            i += bare;
            continue;
        }
        match shifted(c) {
            Some((script, plain)) => push(script, plain),
            // Neither XML nor fonts can show these characters.
            None if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => push(Script::Normal, ' '),
            None => push(Script::Normal, c),
        }
    }
    pieces
}

/// Number of characters of the exponent after a `^` that follows a digit; otherwise 0.
fn exponent(before: &[char], after: &[char]) -> usize {
    let sign = usize::from(matches!(after.first(), Some('-' | '−')));
    let digits = after[sign..].iter().take_while(|c| c.is_ascii_digit()).count();
    if digits > 0 && before.last().is_some_and(char::is_ascii_digit) { sign + digits } else { 0 }
}

/// Number of characters of the index after a `_` that follows a symbol of one letter; 0 in longer names.
fn index(before: &[char], after: &[char]) -> usize {
    let in_word = |c: &char| c.is_alphanumeric() && shifted(*c).is_none() || *c == '_';
    let symbol = match before {
        [letter] => letter.is_alphabetic(),
        [.., last, letter] => letter.is_alphabetic() && !in_word(last),
        [] => false,
    };
    let letters = after.iter().take_while(|c| in_word(c)).count();
    let is_index = matches!(letters, 1 | 2) && after[..letters].iter().all(|c| c.is_alphabetic());
    if symbol && is_index { letters } else { 0 }
}

fn shifted(c: char) -> Option<(Script, char)> {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻";
    const LOWERED: &str = "₀₁₂₃₄₅₆₇₈₉₊₋";
    const PLAIN: &str = "0123456789+−";
    let find = |set: &str| set.chars().position(|x| x == c).and_then(|i| PLAIN.chars().nth(i));
    find(RAISED).map(|p| (Script::Raised, p)).or_else(|| find(LOWERED).map(|p| (Script::Lowered, p)))
}

/// The text without marks for raised and lowered parts.
pub(super) fn plain(text: &str) -> String {
    pieces(text).into_iter().map(|(_, piece)| piece).collect()
}

/// Width \[pt\] of a text at a size \[pt\].
pub(super) fn width(text: &str, size: f64) -> f64 {
    pieces(text)
        .iter()
        .map(|(script, piece)| {
            let size = if *script == Script::Normal { size } else { size * SMALL };
            piece.chars().map(advance).sum::<f64>() * size
        })
        .sum()
}

/// Width of a character, relative to its size.
fn advance(c: char) -> f64 {
    static FACES: LazyLock<Vec<Face<'static>>> =
        LazyLock::new(|| [liberation(), dejavu()].into_iter().filter_map(|data| Face::parse(data, 0).ok()).collect());
    let found = FACES.iter().find_map(|face| {
        let glyph = face.glyph_index(c)?;
        Some(f64::from(face.glyph_hor_advance(glyph)?) / f64::from(face.units_per_em()))
    });
    found.unwrap_or(0.6)
}

/// Text broken at spaces into lines no wider than `most` \[pt\], unless a word is wider.
pub(super) fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(" ", size) + width(word, size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn raised_and_lowered_parts_are_found() {
        assert_eq!(pieces("m²"), [(Script::Normal, "m".into()), (Script::Raised, "2".into())]);
        assert_eq!(pieces("10^{−3}")[1], (Script::Raised, "−3".into()));
        assert_eq!(plain("p_{a} min_spacing 10⁻³"), "pa min_spacing 10−3");
        assert_eq!(
            plain("spacing H_m (nm), Q_pr, H_m², A_10, my_x, a_b_c, b_long: 10^-5 m^2"),
            "spacing Hm (nm), Qpr, Hm2, A_10, my_x, a_b_c, b_long: 10−5 m^2"
        );
        assert_eq!(pieces("^{open").len(), 1);
        assert!(pieces("").is_empty());
    }

    #[test]
    fn widths_are_those_of_the_font() {
        // Arial's digits are 556 units of 1000, to rounding of 2048.
        assert!((width("0000", 10.0) - 22.24).abs() < 0.01);
        assert!(width("10²", 8.0) < width("102", 8.0));
        assert!(width("∇⅓\u{10ffff}", 8.0) > 0.0);
    }

    #[test]
    fn long_text_is_broken_at_spaces() {
        let lines = wrapped("one two three four five", 8.0, 50.0);
        assert!(lines.len() > 1 && lines.iter().all(|line| width(line, 8.0) <= 50.0));
        assert_eq!(lines.join(" "), "one two three four five");
    }
}
