//! Reports: one self-contained HTML file. Figures are inline SVG, pictures are data in the file, there is no script, and a policy in the
//! head forbids the browser to load anything.
//!
//! A page is well-formed XML as well as HTML, so that any XML reader can extract its numbers. Its look is defined here and in
//! `assets/report.css`, for all reports: a serif type for text and a sans type for figures and numbers, three colours (the film's, the
//! contact's, grey), and tables with rules but without boxes. It is wide enough for a projector and plain enough for print.

use super::figure::{Figure, escaped as xml_escaped, to_svg};
use crate::scene::escaped as shown;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write as _;

/// A page that is being written.
#[derive(Clone, Debug, Default)]
pub struct Page {
    title: String,
    head: String,
    body: String,
    /// Titles of the sections.
    contents: Vec<String>,
}

/// Alignment and look of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellKind {
    /// Text, on the left.
    Words,
    /// A number, on the right, with digits aligned.
    Number,
    /// A number that is most important.
    Strong,
    /// Secondary text.
    Quiet,
    /// An error or a warning.
    Alarm,
}

impl CellKind {
    fn class(self) -> &'static str {
        match self {
            Self::Words => "w",
            Self::Number => "n",
            Self::Strong => "n s",
            Self::Quiet => "q",
            Self::Alarm => "a",
        }
    }
}

/// A table: heads, then rows of cells.
#[derive(Clone, Debug, Default)]
pub struct Table {
    groups: Vec<(usize, String)>,
    heads: Vec<(CellKind, String)>,
    rows: Vec<Vec<(CellKind, String)>>,
}

impl Table {
    /// Adds heads above several columns: the number of columns, and the text.
    #[must_use]
    pub fn groups<S: Into<String>>(mut self, groups: impl IntoIterator<Item = (usize, S)>) -> Self {
        self.groups = groups.into_iter().map(|(columns, words)| (columns, words.into())).collect();
        self
    }

    /// Adds a head for each column.
    #[must_use]
    pub fn heads<S: Into<String>>(mut self, heads: impl IntoIterator<Item = (CellKind, S)>) -> Self {
        self.heads = heads.into_iter().map(|(kind, words)| (kind, words.into())).collect();
        self
    }

    /// Adds a row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = (CellKind, S)>) {
        self.rows.push(cells.into_iter().map(|(kind, words)| (kind, words.into())).collect());
    }
}

// Writing to a String cannot fail: the results of `write!` are dropped below.
impl Page {
    /// A page with its title, a line above it for the kind of page, and a few sentences below.
    pub fn new(kicker: &str, title: &str, lead: &str) -> Self {
        let head = format!(
            "<header>\n<p class=\"kicker\">{}</p>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n</header>\n",
            escaped(kicker),
            escaped(title),
            escaped(lead)
        );
        Self { title: title.to_owned(), head, ..Self::default() }
    }

    /// The most important numbers, in large type below the title: the number, and its description.
    pub fn highlights<S: AsRef<str>>(&mut self, numbers: impl IntoIterator<Item = (S, S)>) {
        self.body.push_str("<dl class=\"highlights\">\n");
        for (number, words) in numbers {
            let (number, words) = (escaped(number.as_ref()), escaped(words.as_ref()));
            let _ = writeln!(self.body, "<div><dd>{number}</dd><dt>{words}</dt></div>");
        }
        self.body.push_str("</dl>\n");
    }

    /// Begins a section, which appears in the contents.
    pub fn section(&mut self, title: &str) {
        self.close();
        self.contents.push(title.to_owned());
        let _ = writeln!(self.body, "<section id=\"s{}\">\n<h2>{}</h2>", self.contents.len(), escaped(title));
    }

    /// Ends the present section, if there is one.
    fn close(&mut self) {
        if !self.contents.is_empty() {
            self.body.push_str("</section>\n");
        }
    }

    /// A heading within a section.
    pub fn heading(&mut self, title: &str) {
        let _ = writeln!(self.body, "<h3>{}</h3>", escaped(title));
    }

    /// A paragraph.
    pub fn text(&mut self, words: &str) {
        let _ = writeln!(self.body, "<p>{}</p>", escaped(words));
    }

    /// A paragraph in smaller type.
    pub fn note(&mut self, words: &str) {
        let _ = writeln!(self.body, "<p class=\"note\">{}</p>", escaped(words));
    }

    /// A paragraph that stands out.
    pub fn warning(&mut self, words: &str) {
        let _ = writeln!(self.body, "<p class=\"warning\">{}</p>", escaped(words));
    }

    /// A list.
    pub fn list<S: AsRef<str>>(&mut self, items: impl IntoIterator<Item = S>) {
        self.body.push_str("<ul>\n");
        for item in items {
            let _ = writeln!(self.body, "<li>{}</li>", escaped(item.as_ref()));
        }
        self.body.push_str("</ul>\n");
    }

    /// Choices with a box to tick; one may be ticked.
    pub fn choices<S: AsRef<str>>(&mut self, items: impl IntoIterator<Item = (S, bool)>) {
        self.body.push_str("<ul class=\"choices\">\n");
        for (item, ticked) in items {
            let _ = writeln!(self.body, "<li>{} {}</li>", if ticked { "☑" } else { "☐" }, escaped(item.as_ref()));
        }
        self.body.push_str("</ul>\n");
    }

    /// Ruled lines to write on.
    pub fn room(&mut self, lines: usize) {
        for _ in 0..lines {
            self.body.push_str("<hr class=\"room\"/>\n");
        }
    }

    /// Preformatted text: a command or a file.
    pub fn code(&mut self, text: &str) {
        let _ = writeln!(self.body, "<pre>{}</pre>", escaped(text));
    }

    /// Preformatted text that is folded under a line.
    pub fn folded(&mut self, line: &str, text: &str) {
        let _ = writeln!(
            self.body,
            "<details><summary>{}</summary><pre>{}</pre></details>",
            escaped(line),
            escaped(text.trim_end())
        );
    }

    /// A table.
    pub fn table(&mut self, table: &Table) {
        // A wide table can also be scrolled with the keyboard.
        self.body.push_str("<div class=\"table\" tabindex=\"0\"><table>\n");
        self.body.push_str("<thead>\n");
        if !table.groups.is_empty() {
            self.body.push_str("<tr class=\"groups\">");
            for (columns, words) in &table.groups {
                let class = if words.is_empty() { "" } else { " class=\"g\"" };
                let _ = write!(self.body, "<th colspan=\"{columns}\"{class}>{}</th>", escaped(words));
            }
            self.body.push_str("</tr>\n");
        }
        self.cells("th", &table.heads);
        self.body.push_str("</thead>\n<tbody>\n");
        for row in &table.rows {
            self.cells("td", row);
        }
        self.body.push_str("</tbody>\n</table></div>\n");
    }

    fn cells(&mut self, tag: &str, cells: &[(CellKind, String)]) {
        self.body.push_str("<tr>");
        for (kind, words) in cells {
            let _ = write!(self.body, "<{tag} class=\"{}\">{}</{tag}>", kind.class(), escaped(words));
        }
        self.body.push_str("</tr>\n");
    }

    /// Figures side by side where there is room, each with its name in bold before its caption (the name may be empty).
    pub fn figures<'a, S: AsRef<str>>(&mut self, figures: impl IntoIterator<Item = (S, &'a Figure)>) {
        self.body.push_str("<div class=\"figures\">\n");
        for (name, figure) in figures {
            let wide = if figure.width.millimetres() > 125.0 { " class=\"wide\"" } else { "" };
            let _ = write!(self.body, "<figure{wide}>\n{}", to_svg(figure));
            self.caption(name.as_ref(), &figure.caption);
            self.body.push_str("</figure>\n");
        }
        self.body.push_str("</div>\n");
    }

    fn caption(&mut self, name: &str, caption: &str) {
        let name = if name.is_empty() { String::new() } else { format!("<b>{}</b> ", escaped(name)) };
        if !(name.is_empty() && caption.is_empty()) {
            let _ = writeln!(self.body, "<figcaption>{name}{}</figcaption>", escaped(caption));
        }
    }

    /// A GIF, embedded in the page.
    pub fn picture(&mut self, gif: &[u8], alternative: &str, name: &str, caption: &str) {
        let _ = write!(
            self.body,
            "<figure class=\"wide\">\n<img src=\"data:image/gif;base64,{}\" alt=\"{}\"/>\n",
            STANDARD.encode(gif),
            escaped(alternative)
        );
        self.caption(name, caption);
        self.body.push_str("</figure>\n");
    }

    /// The whole page, with a last line.
    pub fn finish(mut self, foot: &str) -> String {
        self.close();
        let mut contents = String::new();
        if self.contents.len() > 2 {
            contents.push_str("<nav>\n<ol>\n");
            for (title, number) in self.contents.iter().zip(1..) {
                let _ = writeln!(contents, "<li><a href=\"#s{number}\">{}</a></li>", escaped(title));
            }
            contents.push_str("</ol>\n</nav>\n");
        }
        // The contents are before the first section, after the introduction.
        let (lead, sections) = self.body.split_at(self.body.find("<section").unwrap_or(self.body.len()));
        format!(
            "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\"/>\n\
             <meta name=\"generator\" content=\"squeezefilm {}\"/>\n\
             <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{}{lead}{contents}{sections}\
             <footer><p>{}</p></footer>\n</main>\n</body>\n</html>\n",
            env!("CARGO_PKG_VERSION"),
            escaped(&self.title),
            self.head,
            escaped(foot),
        )
    }
}

/// Text for HTML. Control characters and direction marks are shown as escapes.
pub fn escaped(text: &str) -> String {
    text.split_inclusive(['\n', '\t']).fold(String::with_capacity(text.len()), |out, part| {
        let words = part.trim_end_matches(['\n', '\t']);
        out + &xml_escaped(&shown(words)) + &part[words.len()..]
    })
}

/// A command line with quotes for a shell.
pub fn shell<S: AsRef<str>>(words: &[S]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./:,+%@".contains(c);
    let quoted = |word: &S| {
        let word = word.as_ref();
        if !word.is_empty() && word.chars().all(plain) {
            word.to_owned()
        } else {
            format!("'{}'", word.replace('\'', r"'\''"))
        }
    };
    words.iter().map(quoted).collect::<Vec<_>>().join(" ")
}

/// It must contain neither `<` nor `&`, because it is read as XML too.
const STYLE: &str = include_str!("../../assets/report.css");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::figure::{Axis, Line, Panel, Style};

    #[test]
    fn a_page_is_well_formed_and_fetches_nothing() {
        let panel = Panel::new("", Axis::new("x <&>", "mm"), Axis::new("y", "")).layer(Line::new(
            "a",
            [[0.0, 1.0], [1.0, 2.0]],
            Style::nth(0),
        ));
        let mut page = Page::new("report", "A & B <i>\u{1}\u{202e}", "lead");
        page.highlights([("1", "one")]);
        for section in ["one", "two", "three"] {
            page.section(section);
            page.text("words");
        }
        let mut table =
            Table::default().groups([(1, ""), (1, "g")]).heads([(CellKind::Words, "h"), (CellKind::Number, "n")]);
        table.row([(CellKind::Words, "<b>"), (CellKind::Strong, "1")]);
        page.table(&table);
        page.figures([("Fig. 1", &Figure::new("f").panel(panel))]);
        page.picture(b"GIF89a", "\"a\"", "", "c");
        page.folded("line", "text\n");
        page.code("a\tb");
        let html = page.finish("foot");
        let options = roxmltree::ParsingOptions { allow_dtd: true, ..roxmltree::ParsingOptions::default() };
        let read = roxmltree::Document::parse_with_options(&html, options).unwrap();
        let count = |name: &str| read.descendants().filter(|node| node.tag_name().name() == name).count();
        assert_eq!((count("section"), count("svg"), count("table"), count("script"), count("link")), (3, 1, 1, 0, 0));
        assert_eq!(
            read.descendants().filter(|node| node.has_tag_name(("http://www.w3.org/1999/xhtml", "a"))).count(),
            3
        );
        let h1 = read.descendants().find(|node| node.tag_name().name() == "h1").unwrap();
        assert_eq!(h1.text(), Some("A & B <i>\\u{1}\\u{202e}"));
        assert!(!STYLE.contains(['<', '&']) && !STYLE.contains("]]") && !STYLE.contains("url("));
    }

    #[test]
    fn command_lines_can_be_pasted() {
        let words = ["squeezefilm", "compare", "a b.toml", "it's", "--set", "film.slip=none"].map(str::to_owned);
        assert_eq!(shell(&words), r"squeezefilm compare 'a b.toml' 'it'\''s' --set film.slip=none");
    }
}
