//! Text in columns and paragraphs. Text from files is escaped, because a name may contain any character.

use crate::scene::escaped;
use comfy_table::{CellAlignment, Table};
use textwrap::{Options, WordSplitter};

/// Rows of cells; every column is as wide as its widest cell.
pub(super) struct Columns(Table);

impl Columns {
    /// No rows yet.
    pub(super) fn new() -> Self {
        let mut table = Table::new();
        table.load_style(comfy_table::presets::NOTHING);
        Self(table)
    }

    /// One row, which names the columns.
    pub(super) fn headed<S: Into<String>>(names: impl IntoIterator<Item = S>) -> Self {
        let mut columns = Self::new();
        columns.row(names);
        columns
    }

    pub(super) fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.0.add_row(cells.into_iter().map(|cell| escaped(&cell.into())).collect::<Vec<_>>());
    }

    /// The rows, one on each line, indented by two spaces and with two spaces between columns. The columns listed in `right` are aligned
    /// to the right.
    pub(super) fn text(mut self, right: &[usize]) -> String {
        for (i, column) in self.0.column_iter_mut().enumerate() {
            column.set_padding((0, 2));
            column.set_cell_alignment(if right.contains(&i) { CellAlignment::Right } else { CellAlignment::Left });
        }
        self.0.lines().map(|line| format!("  {line}").trim_end().to_owned() + "\n").collect()
    }
}

/// Heading of a table, with an empty line below.
pub(super) fn heading(words: &str) -> String {
    paragraph(words, "", "") + "\n"
}

/// The widest line of a paragraph.
const WIDTH: usize = 100;

/// A paragraph, wrapped at spaces. The first line begins with `first`, the others with `rest`. A number is never separated from its error
/// or its per cent sign.
pub(super) fn paragraph(words: &str, first: &str, rest: &str) -> String {
    let words = words.split_whitespace().map(escaped).collect::<Vec<_>>().join(" ");
    let words = words.replace(" %", "\u{a0}%").replace(" ± ", "\u{a0}±\u{a0}");
    let options = Options::new(WIDTH).initial_indent(first).subsequent_indent(rest).break_words(false);
    textwrap::fill(&words, options.word_splitter(WordSplitter::NoHyphenation)).replace('\u{a0}', " ") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let mut columns = Columns::headed(["α", "1.5", "x"]);
        columns.row(["load", "10.25", ""]);
        assert_eq!(columns.text(&[1]), "  α       1.5  x\n  load  10.25\n");
    }

    #[test]
    fn names_of_any_script_keep_the_columns_and_escape_what_cannot_be_seen() {
        let mut columns = Columns::headed(["超音波", "1"]);
        columns.row(["a\u{202e}\nb", "2"]);
        assert_eq!(columns.text(&[]), "  超音波        1\n  a\\u{202e}\\nb  2\n");
    }

    #[test]
    fn paragraphs_are_broken_at_spaces() {
        let text = paragraph(&"word ".repeat(50), "- ", "  ");
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH));
        assert!(text.starts_with("- word") && text.lines().nth(1).unwrap().starts_with("  word"));
        assert_eq!(text.split_whitespace().count(), 51);
        let long = "min-spacing-".repeat(20);
        assert_eq!(paragraph(&format!("a  {long}\u{1b}[1m"), "", ""), format!("a\n{long}\\u{{1b}}[1m\n"));
    }
}
