//! Sheets of paper: headings, text, room to write in and axes to sketch in, as a PDF of A4 pages in two columns. Each sheet is set in the
//! largest type in which it fits on one page.

use super::colour::Colour;
use super::drawing::Drawing;
use super::error::FigureError;
use super::render;
use super::style::Style;
use super::svg::{Rect, Svg, Type};
use super::text::{FAMILIES, wrapped};
use serde::{Deserialize, Serialize};

/// A4 \[pt\].
const PAGE: [f64; 2] = [595.28, 841.89];
const MARGIN: f64 = 42.0;
const COLUMNS: usize = 2;
/// Distance between the columns.
const GUTTER: f64 = 22.0;
/// Sizes of type \[pt\], the largest first. A sheet that does not fit with the smallest one continues on another page.
const SIZES: [f64; 6] = [10.5, 9.8, 9.1, 8.4, 7.7, 7.0];
/// Heights relative to the size of type.
const LINE: f64 = 1.32;
const RULED: f64 = 1.9;
const AXES: f64 = 6.5;
const INDENT: f64 = 1.4;
/// Above a heading, a paragraph and a choice.
const ABOVE: [f64; 3] = [0.8, 0.25, 0.2];
const HEADING: f64 = 1.15;

/// A part of a sheet, below what comes before it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Piece {
    /// The title of the sheet.
    Title(String),
    /// A heading.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// A choice with a box, ticked or not.
    Choice(String, bool),
    /// A paragraph that stands out.
    Answer(String),
    /// Ruled lines to write on.
    Room(usize),
    /// Empty axes to sketch in, with the labels of both axes.
    Axes([String; 2]),
}

/// The sheets as a PDF, each beginning on a page of its own.
pub fn sheets_to_pdf(title: &str, sheets: &[Vec<Piece>]) -> Result<Vec<u8>, FigureError> {
    let mut pages = Vec::new();
    for sheet in sheets {
        let sheet = &sheet.iter().map(with_braces).collect::<Vec<_>>();
        let fitting = SIZES.iter().map(|size| set(sheet, *size)).find(|pages| pages.len() < 2);
        pages.extend(fitting.unwrap_or_else(|| set(sheet, SIZES[SIZES.len() - 1])));
    }
    let [width, height] = PAGE;
    let page = |body: String| {
        let svg = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="{FAMILIES}">{body}</svg>"#
        );
        (Drawing { size: PAGE, pictures: Vec::new(), body }, svg)
    };
    let pages: Vec<(Drawing, String)> = pages.into_iter().map(page).collect();
    render::pdf(&pages, &[("Title", title.to_owned()), ("Software", "squeezefilm".to_owned())])
}

/// Puts braces round indices and exponents of one character, as figures need them.
fn with_braces(piece: &Piece) -> Piece {
    let braced = |text: &str| {
        let mut out = String::with_capacity(text.len());
        let mut rest = text.chars().peekable();
        while let Some(c) = rest.next() {
            out.push(c);
            if matches!(c, '_' | '^')
                && let Some(next) = rest.next_if(|next| next.is_alphanumeric())
            {
                out.push_str(&format!("{{{next}}}"));
            }
        }
        out
    };
    match piece {
        Piece::Text(text) => Piece::Text(braced(text)),
        Piece::Answer(text) => Piece::Answer(braced(text)),
        Piece::Choice(text, ticked) => Piece::Choice(braced(text), *ticked),
        other => other.clone(),
    }
}

/// A sheet in type of this size: the content of each of its pages.
fn set(sheet: &[Piece], size: f64) -> Vec<String> {
    filled(sheet, size).pages.into_iter().map(|page| page.body).collect()
}

/// The setter after it has set the whole sheet in type of this size.
fn filled(sheet: &[Piece], size: f64) -> Setter {
    let mut setter = Setter { pages: vec![Svg::default()], column: 0, y: MARGIN, size };
    for (i, piece) in sheet.iter().enumerate() {
        let [heading, paragraph, choice] = ABOVE;
        setter.keep(together(&sheet[i..], size));
        match piece {
            Piece::Title(text) => setter.words(text, 0.0, 1.6, Colour::FILM, 0.0),
            Piece::Heading(text) => setter.words(text, 0.0, HEADING, Colour::BLACK, heading),
            Piece::Text(text) => setter.words(text, 0.0, 1.0, Colour::BLACK, paragraph),
            Piece::Answer(text) => setter.words(text, 0.0, 1.0, Colour::FILM, paragraph),
            Piece::Choice(text, ticked) => {
                let indent = INDENT * size;
                let colour = if *ticked { Colour::FILM } else { Colour::BLACK };
                setter.words(text, indent, 1.0, colour, choice);
                setter.tick(text, indent, *ticked);
            }
            Piece::Room(lines) => setter.ruled(*lines),
            Piece::Axes(names) => setter.axes(names),
        }
    }
    setter
}

/// The height \[pt\] of the first of these pieces together with those that must not be separated from it: a heading stays with what
/// follows, a paragraph with its choices, its axes or the room for the answer.
fn together(pieces: &[Piece], size: f64) -> f64 {
    let [heading, paragraph, choice] = ABOVE;
    let words = |text: &str, indent: f64, scale: f64, above: f64| {
        let lines = wrapped(text, scale * size, Setter::width() - indent * size).len();
        (above + lines as f64 * LINE * scale) * size
    };
    let Some((first, next)) = pieces.split_first() else { return 0.0 };
    match (first, next.first()) {
        (Piece::Heading(text), _) => words(text, 0.0, HEADING, heading) + together(next, size),
        (Piece::Text(text), Some(Piece::Choice(..) | Piece::Axes(_) | Piece::Room(_))) => {
            words(text, 0.0, 1.0, paragraph) + together(next, size)
        }
        (Piece::Text(text), _) => words(text, 0.0, 1.0, paragraph),
        (Piece::Choice(text, _), after) => {
            let rest = if let Some(Piece::Choice(..)) = after { together(next, size) } else { 0.0 };
            words(text, INDENT, 1.0, choice) + rest
        }
        (Piece::Axes(_), _) => (AXES + 2.0) * size,
        (Piece::Room(lines), _) => *lines as f64 * RULED * size,
        (Piece::Title(_) | Piece::Answer(_), _) => 0.0,
    }
}

struct Setter {
    pages: Vec<Svg>,
    column: usize,
    /// The vertical position where the next piece begins.
    y: f64,
    size: f64,
}

impl Setter {
    fn width() -> f64 {
        (PAGE[0] - 2.0 * MARGIN - (COLUMNS as f64 - 1.0) * GUTTER) / COLUMNS as f64
    }

    /// The left edge of the column.
    fn left(&self) -> f64 {
        MARGIN + self.column as f64 * (Self::width() + GUTTER)
    }

    /// Reserves this height, in the next column if this one does not have it. Returns where it begins.
    fn take(&mut self, height: f64) -> f64 {
        if self.y + height > PAGE[1] - MARGIN && self.y > MARGIN {
            self.y = MARGIN;
            self.column += 1;
            if self.column == COLUMNS {
                self.column = 0;
                self.pages.push(Svg::default());
            }
        }
        self.y += height;
        self.y - height
    }

    /// Moves to the next column if this one does not have this height left.
    fn keep(&mut self, height: f64) {
        let top = self.take(height);
        self.y = top;
    }

    fn draw(&mut self, draw: impl FnOnce(&mut Svg)) {
        if let Some(page) = self.pages.last_mut() {
            draw(page);
        }
    }

    /// Text in lines, with space above.
    fn words(&mut self, text: &str, indent: f64, scale: f64, colour: Colour, above: f64) {
        let size = scale * self.size;
        let lines = wrapped(text, size, Self::width() - indent);
        let above = above * self.size;
        let top = self.take(above + lines.len() as f64 * LINE * size) + above;
        let (left, style) = (self.left() + indent, Type { colour, ..Type::new(size, "start") });
        self.draw(|page| {
            for (i, line) in lines.iter().enumerate() {
                page.text([left, top + (i as f64 * LINE + 0.95) * size], line, &style);
            }
        });
    }

    /// A box in front of the text that was just written.
    fn tick(&mut self, text: &str, indent: f64, ticked: bool) {
        let size = self.size;
        let lines = wrapped(text, size, Self::width() - indent).len() as f64;
        let top = self.y - lines * LINE * size + 0.25 * size;
        let square = Rect { x: self.left(), y: top, width: 0.75 * size, height: 0.75 * size };
        let fill = ticked.then_some((Colour::FILM, 1.0));
        self.draw(|page| page.rect(&square, &Style::solid(Colour::QUIET).width(0.6), fill));
    }

    fn ruled(&mut self, lines: usize) {
        for _ in 0..lines {
            let y = self.take(RULED * self.size) + RULED * self.size;
            let (left, right) = (self.left(), self.left() + Self::width());
            self.draw(|page| page.segments(&[[left, y, right, y]], &Style::solid(Colour::QUIET).width(0.4)));
        }
        self.y += 0.3 * self.size;
    }

    fn axes(&mut self, [along, up]: &[String; 2]) {
        let size = self.size;
        let top = self.take((AXES + 2.0) * size) + 0.6 * size;
        let (left, bottom) = (self.left() + 0.5 * size, top + AXES * size);
        let right = self.left() + 0.9 * Self::width();
        self.draw(|page| {
            page.segments(
                &[[left, top, left, bottom], [left, bottom, right, bottom]],
                &Style::solid(Colour::BLACK).width(0.8),
            );
            page.text([right, bottom + size], along, &Type::new(0.85 * size, "end"));
            page.text([left + 0.5 * size, top + 0.6 * size], up, &Type::new(0.85 * size, "start"));
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_is_one_page_if_it_can_be() {
        let some = |count: usize| vec![Piece::Text("a line of words that is not long".to_owned()); count];
        assert_eq!(set(&some(80), SIZES[0]).len(), 1);
        assert!(set(&some(110), SIZES[0]).len() > 1 && set(&some(110), SIZES[5]).len() == 1);
        let pages = |sheets: &[Vec<Piece>]| {
            let pdf = sheets_to_pdf("Title", sheets).unwrap();
            assert!(pdf.starts_with(b"%PDF"));
            pdf.windows(12).filter(|part| *part == b"/Type /Page\n").count()
        };
        assert_eq!(pages(&[some(110), some(3)]), 2);
        assert_eq!(pages(&[some(200)]), 2);
        let others = vec![Piece::Axes(["x".into(), "y".into()]), Piece::Room(2), Piece::Choice("c".into(), true)];
        assert_eq!(pages(&[others]), 1);
    }

    #[test]
    fn what_is_kept_together_is_as_high_as_it_is_set() {
        let size = SIZES[1];
        // The texts have all lengths, so that some lines break because of an indent.
        for words in 1..60 {
            let text = || "seven ".repeat(words);
            let choice = || Piece::Choice(text(), false);
            let axes = Piece::Axes(["x".into(), "y".into()]);
            for pieces in [
                vec![Piece::Heading(text()), Piece::Text(text()), choice(), choice()],
                vec![Piece::Heading(text()), Piece::Text(text()), axes],
                vec![Piece::Text(text())],
            ] {
                let high = filled(&pieces, size).y - MARGIN;
                assert!((together(&pieces, size) - high).abs() < 1e-9, "{pieces:?}");
            }
        }
    }

    #[test]
    fn columns_and_gutters_fill_the_page_between_its_margins() {
        let columns = COLUMNS as f64;
        let across = columns * Setter::width() + (columns - 1.0) * GUTTER;
        assert!((across - (PAGE[0] - 2.0 * MARGIN)).abs() < 1e-9, "{across}");
    }

    #[test]
    fn the_axes_of_a_sketch_have_their_names_at_their_ends() {
        let size = SIZES[0];
        let page = &set(&[Piece::Axes(["along".to_owned(), "up".to_owned()])], size)[0];
        let ([right, along], [left, up]) = (place(page, "along"), place(page, "up"));
        assert!((along - up - (AXES + 0.4) * size).abs() < 0.1, "{along} {up}");
        assert!((right - left) / Setter::width() > 0.85 && right < MARGIN + Setter::width(), "{left} {right}");
    }

    #[test]
    fn a_heading_keeps_its_question_a_question_its_choices_and_a_sketch_its_axes() {
        let choices = ["one", "two", "three"].map(|choice| Piece::Choice(choice.to_owned(), false));
        let axes = [Piece::Axes(["along".to_owned(), "up".to_owned()])];
        let mut moved = false;
        for before in 30..75 {
            for (with, last) in [(&choices[..], "three"), (&axes[..], "up")] {
                let mut sheet = vec![Piece::Text("a line".to_owned()); before];
                sheet.extend([Piece::Heading("head".to_owned()), Piece::Text("ask".to_owned())]);
                sheet.extend_from_slice(with);
                let page = &set(&sheet, SIZES[0])[0];
                let in_second = |word: &str| place(page, word)[0] > 0.5 * PAGE[0];
                let parts = ["head", "ask", last].map(in_second);
                assert!(parts == [true; 3] || parts == [false; 3], "{last} after {before} lines: {parts:?}");
                moved |= in_second("ask");
            }
        }
        assert!(moved);
    }

    /// The values of this attribute of all elements `tag` of a page, in order.
    fn attributes(page: &str, tag: &str, name: &str) -> Vec<f64> {
        let begin = format!("<{tag} ");
        let tags = page.split(&begin).skip(1);
        let value =
            |tag: &str| tag.split(&format!("{name}=\"")).nth(1).and_then(|rest| rest.split('"').next()?.parse().ok());
        tags.filter_map(value).collect()
    }

    /// The position of the text that begins with this word.
    fn place(page: &str, word: &str) -> [f64; 2] {
        let until = &page[..page.find(&format!(">{word}")).unwrap()];
        ["x", "y"].map(|name| attributes(until, "text", name).pop().unwrap())
    }

    #[test]
    fn lines_stand_below_each_other_and_a_box_before_its_choice() {
        let long = "words that take more than one line of a column ".repeat(4);
        let size = SIZES[2];
        let page =
            set(&[Piece::Title(long.clone()), Piece::Text(long.clone()), Piece::Choice(long, true)], size).remove(0);
        let [x, y, sizes] = ["x", "y", "font-size"].map(|name| attributes(&page, "text", name));
        assert!(x.len() > 8 && y.iter().all(|y| (MARGIN..MARGIN + 30.0 * size).contains(y)), "{y:?}");
        for i in 1..y.len() {
            let apart = y[i] - y[i - 1];
            // Within a paragraph the lines are evenly spaced; between two paragraphs there is more space.
            let same = sizes[i] == sizes[i - 1] && x[i] == x[i - 1];
            assert!(if same { (apart - LINE * sizes[i]).abs() < 2e-3 } else { apart > LINE * size }, "{y:?}");
        }
        assert!(x[0] == MARGIN && (x[x.len() - 1] - MARGIN - INDENT * size).abs() < 1e-3, "{x:?}");
        let first = x.iter().position(|at| *at > MARGIN).unwrap();
        let [left, top, height] = ["x", "y", "height"].map(|name| attributes(&page, "rect", name)[0]);
        assert!(left == MARGIN && top < y[first] && top + height > y[first] - size && y[first] - top < size, "{page}");
    }

    #[test]
    fn ruled_lines_and_axes_leave_room_above_each_line_and_below_the_last() {
        let size = SIZES[0];
        let page =
            set(&[Piece::Room(3), Piece::Axes(["x".into(), "y".into()]), Piece::Text("text".into())], size).remove(0);
        let ends =
            |path: &str| -> Vec<f64> { path.split(['M', 'L', ' ']).filter_map(|end| end.parse().ok()).collect() };
        let paths: Vec<Vec<f64>> =
            page.split("d=\"").skip(1).map(|path| ends(path.split('"').next().unwrap())).collect();
        let right = MARGIN + Setter::width();
        for (i, line) in paths[..3].iter().enumerate() {
            let y = MARGIN + (i as f64 + 1.0) * RULED * size;
            assert!(line.iter().zip([MARGIN, y, right, y]).all(|(a, b)| (a - b).abs() < 1e-3), "{line:?}");
        }
        let [left, top, _, bottom, .., along, low] = paths[3][..] else { panic!("{paths:?}") };
        assert!(left > MARGIN && along < right && low == bottom && (bottom - top - AXES * size).abs() < 2e-3);
        assert!(top > paths[2][1] + 0.5 * size && attributes(&page, "text", "y")[2] > bottom + 2.0 * size);
    }
}
