//! The text of lessons and of the glossary, in a part of Markdown: paragraphs, lists, **strong**, *slanted*, `code`, formulas
//! `$…$` in a line and `$$…$$` on their own line, pictures, and `{…}`, a number of the run. A library such as pulldown-cmark would read
//! emphasis and lists; formulas, numbers and messages would still have to be read here.

use super::check::Reading;
use super::formula::Formula;
use super::picture::Picture;
use crate::scene::Scene;

/// A part of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Inline {
    /// Words.
    Text {
        /// The words.
        text: String,
        /// Their style.
        style: Style,
    },
    /// A formula.
    Math(Formula),
    /// A number of the run.
    Number(Reading),
}

/// Reads the picture in a file; the second argument describes it in words.
pub type Pictures<'a> = &'a dyn Fn(&str, &str) -> Result<Picture, String>;

/// What the text of a step may show beside words and formulas.
#[derive(Clone, Copy)]
pub struct Outside<'a> {
    /// The scene whose numbers it may quote.
    pub scene: &'a Scene,
    /// Pictures beside the text.
    pub pictures: Pictures<'a>,
}

/// The style of words.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Without emphasis.
    #[default]
    Plain,
    /// `**strong**`.
    Strong,
    /// `*slanted*`.
    Slanted,
    /// `` `code` ``.
    Code,
}

/// A part of a text. The parts are set below each other.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Paragraph(Vec<Inline>),
    /// An item of a list.
    Item(Vec<Inline>),
    /// A formula on its own.
    Formula(Formula),
    /// A picture.
    Picture(Picture),
}

/// Reads blocks from Markdown. An error comes with its line, from 0. Without `outside` a text has neither numbers of a run nor pictures.
pub fn blocks(source: &str, outside: Option<Outside<'_>>) -> Result<Vec<Block>, (usize, String)> {
    let mut blocks = Vec::new();
    let mut lines = source.lines().enumerate().peekable();
    while let Some((number, line)) = lines.next() {
        let line = line.trim();
        if line.is_empty() {
            continue;
        }
        if let Some(rest) = line.strip_prefix("$$") {
            let mut formula = rest.to_owned();
            while !formula.trim_end().ends_with("$$") {
                let Some((_, more)) = lines.next() else { return Err((number, DOLLAR.to_owned())) };
                formula.push(' ');
                formula.push_str(more.trim());
            }
            let formula = formula.trim_end().trim_end_matches("$$");
            let formula = Formula::parse(formula).map_err(|error| (number, error))?;
            blocks.push(Block::Formula(formula));
            continue;
        }
        if let (Some((alternative, file)), Some(outside)) = (picture(line), outside) {
            let read = (outside.pictures)(file, alternative);
            let read = read.map_err(|error| (number, format!("picture {file}: {error}")))?;
            blocks.push(Block::Picture(read));
            continue;
        }
        let item = line.strip_prefix("* ").or_else(|| line.strip_prefix("- "));
        let mut text = item.unwrap_or(line).to_owned();
        while let Some((_, next)) = lines.peek() {
            let next = next.trim();
            if next.is_empty() || next.starts_with("$$") || next.starts_with("* ") || next.starts_with("- ") {
                break;
            }
            text.push(' ');
            text.push_str(next);
            lines.next();
        }
        let inline = inline(&text, outside.map(|outside| outside.scene)).map_err(|error| (number, error))?;
        blocks.push(if item.is_some() { Block::Item(inline) } else { Block::Paragraph(inline) });
    }
    Ok(blocks)
}

/// The description and the file of a picture, from a line `![description](file.png)`.
fn picture(line: &str) -> Option<(&str, &str)> {
    line.strip_prefix("![")?.strip_suffix(')')?.split_once("](")
}

const DOLLAR: &str = "a formula begins with $ and does not end; write \\$ for the sign itself";
const BRACE: &str = "a number of the run begins with { and does not end; write \\{ for the brace itself";

/// Reads one line, which may quote numbers of a run of `scene`.
pub fn inline(source: &str, scene: Option<&Scene>) -> Result<Vec<Inline>, String> {
    let mut parts = Vec::new();
    let mut text = String::new();
    let mut style = Style::Plain;
    let flush = |text: &mut String, style: Style, parts: &mut Vec<Inline>| {
        if !text.is_empty() {
            parts.push(Inline::Text { text: std::mem::take(text), style });
        }
    };
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        if let Some(escaped) = rest.strip_prefix('\\').and_then(|after| after.chars().next()) {
            text.push(escaped);
            rest = &rest[1 + escaped.len_utf8()..];
            continue;
        }
        if let (true, Some(after)) = (style != Style::Code, rest.strip_prefix('$')) {
            let Some(end) = after.find('$') else { return Err(DOLLAR.to_owned()) };
            flush(&mut text, style, &mut parts);
            parts.push(Inline::Math(Formula::parse(&after[..end])?));
            rest = &after[end + 1..];
            continue;
        }
        if let (true, Some(scene), Some(after)) = (style != Style::Code, scene, rest.strip_prefix('{')) {
            let Some(end) = after.find('}') else { return Err(BRACE.to_owned()) };
            let number = after[..end].trim();
            flush(&mut text, style, &mut parts);
            let fault = |error: String| format!("{{{number}}}: {error}; write \\{{ for the brace itself");
            parts.push(Inline::Number(Reading::parse(number, scene).map_err(fault)?));
            rest = &after[end + 1..];
            continue;
        }
        let marks = [("**", Style::Strong), ("*", Style::Slanted), ("`", Style::Code)];
        let mark = marks.into_iter().find(|(mark, meant)| {
            rest.starts_with(mark) && (style == *meant || (style == Style::Plain && rest[mark.len()..].contains(mark)))
        });
        if let Some((mark, meant)) = mark {
            flush(&mut text, style, &mut parts);
            style = if style == meant { Style::Plain } else { meant };
            rest = &rest[mark.len()..];
            continue;
        }
        text.push(first);
        rest = &rest[first.len_utf8()..];
    }
    flush(&mut text, style, &mut parts);
    Ok(parts)
}

/// A line as plain text.
pub fn plain(parts: &[Inline]) -> String {
    parts
        .iter()
        .map(|part| match part {
            Inline::Text { text, .. } => text.clone(),
            Inline::Math(formula) => formula.plain(),
            Inline::Number(reading) => format!("{{{}}}", reading.source),
        })
        .collect()
}

/// `parts`, with each number replaced by the text that `value` returns for it.
pub fn filled(parts: &[Inline], value: &dyn Fn(&Reading) -> String) -> Vec<Inline> {
    let fill = |part: &Inline| match part {
        Inline::Number(reading) => Inline::Text { text: value(reading), style: Style::Plain },
        other => other.clone(),
    };
    parts.iter().map(fill).collect()
}

/// The numbers of the run that blocks quote.
pub fn readings<'a>(blocks: impl IntoIterator<Item = &'a Block>) -> impl Iterator<Item = &'a Reading> {
    let parts = blocks.into_iter().flat_map(|block| match block {
        Block::Paragraph(parts) | Block::Item(parts) => parts.as_slice(),
        Block::Formula(_) | Block::Picture(_) => &[],
    });
    parts.filter_map(|part| if let Inline::Number(reading) = part { Some(reading) } else { None })
}

/// Blocks as plain text, a line each.
pub fn plain_blocks(blocks: &[Block]) -> String {
    let lines: Vec<String> = blocks
        .iter()
        .map(|block| match block {
            Block::Paragraph(parts) | Block::Item(parts) => plain(parts),
            Block::Formula(formula) => formula.plain(),
            Block::Picture(picture) => picture.alternative.clone(),
        })
        .collect();
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_marks_of_a_line() {
        let parts = inline(r"a **b** *c* `d` $h_0$ 5 \$, 2 * 3", None).unwrap();
        assert_eq!(plain(&parts), "a b c d h_0 5 $, 2 * 3");
        let styles: Vec<Style> =
            parts.iter().filter_map(|p| if let Inline::Text { style, .. } = p { Some(*style) } else { None }).collect();
        assert_eq!(styles[1], Style::Strong);
        assert_eq!(styles[3], Style::Slanted);
        assert_eq!(styles[5], Style::Code);
        assert_eq!(inline("costs $5", None).unwrap_err(), DOLLAR);
    }

    #[test]
    fn blocks_of_a_text() {
        let read = blocks("One\nline.\n\n* first\n  and more\n* second\n\n$$ a =\nb $$\nlast", None).unwrap();
        assert_eq!(plain_blocks(&read), "One line.\nfirst and more\nsecond\na = b\nlast");
        assert!(matches!(read[3], Block::Formula(_)));
        assert_eq!(blocks("fine\n\n$x", None).unwrap_err().0, 2);
        assert_eq!(blocks("$$ x", None).unwrap_err(), (0, DOLLAR.to_owned()));
    }
}
