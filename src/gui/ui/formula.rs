//! Sets formulas: every part is a box with a width, a height above the baseline and a depth below it.

use crate::lessons::formula::{Mark, Node, SUM};
use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2, pos2, vec2};

/// Sizes relative to the text: of indices and exponents, of the sum sign of a displayed formula, and of numerators and denominators within
/// text.
const SCRIPT: f32 = 0.72;
const SIGN_OF_SUM: f32 = 1.5;
const FRACTION: f32 = 0.8;
/// Smallest size of glyphs \[points\].
const LEAST: f32 = 8.5;
/// Heights above the baseline of the middle of + and −, and of a letter, and its depth below it, as shares of the size.
const AXIS: f32 = 0.27;
pub(super) const ASCENT: f32 = 0.74;
pub(super) const DESCENT: f32 = 0.21;
/// Width of lines, of fractions and roots, likewise.
const RULE: f32 = 0.07;
/// Letters without a stem.
const LOW: &str = "acegmnopqrsuvwxyzαγεηκμνπρστυχω";

/// A typeset formula. Positions are relative to the left end of its baseline.
#[derive(Clone, Debug, Default)]
pub(super) struct Typeset {
    pub(super) width: f32,
    pub(super) ascent: f32,
    pub(super) descent: f32,
    shapes: Vec<Shape>,
}

/// Style of a formula.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// Height of the text \[points\].
    pub(super) size: f32,
    pub(super) colour: Color32,
    /// Whether the formula is displayed on a line of its own: its fractions then have the full size.
    pub(super) display: bool,
}

impl Style {
    fn scaled(self, scale: f32) -> Self {
        Self { size: (scale * self.size).max(LEAST.min(self.size)), display: false, ..self }
    }

    /// Width of the lines of fractions, roots, brackets and bars.
    fn rule(self) -> f32 {
        (RULE * self.size).max(1.0)
    }

    /// A line of that width.
    fn line(self, points: Vec<Pos2>) -> Shape {
        Shape::line(points, Stroke::new(self.rule(), self.colour))
    }
}

impl Typeset {
    /// Sets `nodes` side by side.
    pub(super) fn of(painter: &Painter, nodes: &[Node], style: Style) -> Self {
        let mut row = Self::default();
        for (i, node) in nodes.iter().enumerate() {
            let sign = matches!(node, Node::Sign(_));
            // A minus sign at the beginning is a sign, not a difference.
            let unary = i == 0 || matches!(nodes[i - 1], Node::Sign(_));
            let room = if sign && !unary { 0.24 * style.size } else { 0.0 };
            row.width += room;
            row.append(Self::node(painter, node, style));
            row.width += room;
        }
        row
    }

    fn append(&mut self, part: Self) {
        let width = part.width;
        self.place(part, vec2(self.width, 0.0));
        self.width += width;
    }

    /// Adds `part`, shifted; a part that sticks out does not widen the whole.
    fn place(&mut self, part: Self, by: Vec2) {
        self.ascent = self.ascent.max(part.ascent - by.y);
        self.descent = self.descent.max(part.descent + by.y);
        self.shapes.extend(part.moved(by));
    }

    /// Sets a text on one line.
    pub(super) fn text(painter: &Painter, text: &str, Style { size, colour, .. }: Style, slanted: bool) -> Self {
        let font_id = FontId::proportional(size);
        let format = TextFormat { font_id, color: colour, italics: slanted, ..Default::default() };
        let mut job = LayoutJob::single_section(text.to_owned(), format);
        job.wrap.max_width = f32::INFINITY;
        let galley = painter.layout_job(job);
        let baseline = galley.rows.first().and_then(|row| Some(row.pos.y + row.row.glyphs.first()?.pos.y));
        Self {
            width: galley.size().x,
            ascent: ASCENT * size,
            descent: DESCENT * size,
            shapes: vec![Shape::galley(pos2(0.0, -baseline.unwrap_or_default()), galley, colour)],
        }
    }

    /// Draws a background of this colour behind a text, a little wider than the text.
    pub(super) fn with_ground(mut self, colour: Color32) -> Self {
        if let Some(Shape::Text(text)) = self.shapes.first() {
            let place = Rect::from_min_size(text.pos, text.galley.size()).expand2(vec2(2.0, 0.0));
            self.shapes.insert(0, Shape::rect_filled(place, 3.0, colour));
        }
        self
    }

    fn node(painter: &Painter, node: &Node, style: Style) -> Self {
        match node {
            Node::Letter(letter) => {
                let set = Self::text(painter, &letter.to_string(), style, true);
                Self { width: set.width + 0.04 * style.size, ..set }
            }
            Node::Upright(text) => Self::text(painter, text, style, false),
            Node::Sign(sign) => Self::text(painter, &sign.to_string(), style, false),
            Node::Space(room) => Self { width: room * style.size, ..Self::default() },
            Node::Fraction(over, under) => Self::fraction(painter, over, under, style),
            Node::Root(inside) => Self::root(painter, inside, style),
            Node::Script { base, index, exponent } => Self::script(painter, base, [index, exponent], style),
            Node::Bracketed(left, inside, right) => Self::bracketed(painter, *left, inside, *right, style),
            Node::Marked(mark, inside) => Self::marked(painter, *mark, inside, style),
        }
    }

    fn fraction(painter: &Painter, over: &[Node], under: &[Node], style: Style) -> Self {
        let inner = if style.display { Style { display: false, ..style } } else { style.scaled(FRACTION) };
        let (over, under) = (Self::of(painter, over, inner), Self::of(painter, under, inner));
        let (overhang, gap) = (0.12 * style.size, 0.14 * style.size + 0.5 * style.rule());
        let widest = over.width.max(under.width) + 2.0 * overhang;
        let side = 0.08 * style.size;
        let axis = -AXIS * style.size;
        let line = vec![pos2(side, axis), pos2(side + widest, axis)];
        let mut set = Self { width: widest + 2.0 * side, shapes: vec![style.line(line)], ..Self::default() };
        let middle = |part: &Self| side + 0.5 * (widest - part.width);
        let up = vec2(middle(&over), axis - gap - over.descent);
        let down = vec2(middle(&under), axis + gap + under.ascent);
        set.place(over, up);
        set.place(under, down);
        set
    }

    fn root(painter: &Painter, inside: &[Node], style: Style) -> Self {
        let inside = Self::of(painter, inside, style);
        let (gap, hook) = (0.14 * style.size, 0.55 * style.size);
        let (top, bottom) = (-inside.ascent - gap, inside.descent);
        let foot = 0.25 * style.size;
        let line = vec![
            pos2(0.04 * style.size, bottom - 0.42 * (bottom - top)),
            pos2(0.16 * style.size, bottom - 0.48 * (bottom - top)),
            pos2(0.5 * (foot + hook) - 0.06 * style.size, bottom),
            pos2(hook, top),
            pos2(hook + inside.width + 0.1 * style.size, top),
        ];
        let width = hook + inside.width + 0.16 * style.size;
        let mut set = Self { width, ascent: -top + style.rule(), shapes: vec![style.line(line)], ..Self::default() };
        set.place(inside, vec2(hook + 0.03 * style.size, 0.0));
        set
    }

    /// The sum sign of a displayed formula, with its lower limit below and its upper limit above.
    fn sum(painter: &Painter, [index, exponent]: [&[Node]; 2], style: Style) -> Self {
        let small = style.scaled(SCRIPT);
        let sign = Self::text(painter, SUM, Style { size: SIGN_OF_SUM * style.size, ..style }, false);
        // Its middle is on the line of + signs and fraction bars.
        let drop = 0.5 * (sign.ascent - sign.descent) - AXIS * style.size;
        let [below, above] = [index, exponent].map(|nodes| Self::of(painter, nodes, small));
        let width = sign.width.max(below.width).max(above.width);
        let gap = 0.1 * style.size;
        let (low, high) = (drop + sign.descent + gap + below.ascent, drop - sign.ascent - gap - above.descent);
        let mut set = Self { width: width + 0.1 * style.size, ..Self::default() };
        for (part, down) in [(below, low), (above, high), (sign, drop)] {
            if !part.shapes.is_empty() {
                let middle = 0.5 * (width - part.width);
                set.place(part, vec2(middle, down));
            }
        }
        set
    }

    fn script(painter: &Painter, base: &[Node], scripts: [&[Node]; 2], style: Style) -> Self {
        if style.display && matches!(base, [Node::Upright(sign)] if sign == SUM) {
            return Self::sum(painter, scripts, style);
        }
        let [index, exponent] = scripts;
        let small = style.scaled(SCRIPT);
        let mut set = Self::of(painter, base, style);
        let (base_ascent, base_descent, start) = (set.ascent, set.descent, set.width + 0.02 * style.size);
        let tall = base_ascent > 1.1 * style.size;
        for (nodes, below) in [(index, true), (exponent, false)] {
            if nodes.is_empty() {
                continue;
            }
            let part = Self::of(painter, nodes, small);
            let down = match (below, tall) {
                (true, true) => base_descent,
                (true, false) => 0.22 * style.size,
                (false, true) => -(base_ascent - 0.5 * part.ascent),
                (false, false) => -0.40 * style.size,
            };
            set.width = set.width.max(start + part.width);
            set.place(part, vec2(start, down));
        }
        set.width += 0.02 * style.size;
        set
    }

    fn bracketed(painter: &Painter, left: char, inside: &[Node], right: char, style: Style) -> Self {
        let inside = Self::of(painter, inside, style);
        let (top, bottom) = (-inside.ascent - 0.04 * style.size, inside.descent + 0.04 * style.size);
        let width = 0.34 * style.size;
        let opening = style.line(bracket(left, top, bottom, 0.06 * style.size, width - 0.1 * style.size));
        let mut set = Self { width, ascent: -top, descent: bottom, shapes: vec![opening] };
        set.append(inside);
        let from = set.width + 0.1 * style.size;
        set.shapes.push(style.line(bracket(right, top, bottom, from, from + width - 0.16 * style.size)));
        set.width += width;
        set
    }

    fn marked(painter: &Painter, mark: Mark, inside: &[Node], style: Style) -> Self {
        let mut set = Self::of(painter, inside, style);
        // Clear of a stem, and close above a letter without one.
        let low = matches!(inside, [Node::Letter(letter)] if LOW.contains(*letter));
        let top = if low { -0.68 * style.size } else { -set.ascent - 0.2 * style.size };
        set.shapes.push(match mark {
            Mark::Dot => Shape::circle_filled(pos2(0.58 * set.width, top), 0.065 * style.size, style.colour),
            Mark::Bar => style.line(vec![pos2(0.1 * set.width, top), pos2(set.width, top)]),
        });
        set.ascent = set.ascent.max(-top + 0.08 * style.size);
        set
    }

    /// The shapes, with the left end of the baseline at `by`.
    pub(super) fn moved(&self, by: Vec2) -> impl Iterator<Item = Shape> + '_ {
        self.shapes.iter().cloned().map(move |mut shape| {
            shape.translate(by);
            shape
        })
    }
}

/// A bracket between two heights and two widths.
fn bracket(kind: char, top: f32, bottom: f32, left: f32, right: f32) -> Vec<Pos2> {
    let middle = 0.5 * (top + bottom);
    let curve = |from: f32, to: f32| {
        let point = |i: u8| {
            let share = f32::from(i) / 12.0;
            let bow = 4.0 * share * (1.0 - share);
            pos2(from + (to - from) * bow, top + share * (bottom - top))
        };
        (0..=12).map(point).collect()
    };
    match kind {
        '(' => curve(right, left),
        ')' => curve(left, right),
        '[' => vec![pos2(right, top), pos2(left, top), pos2(left, bottom), pos2(right, bottom)],
        ']' => vec![pos2(left, top), pos2(right, top), pos2(right, bottom), pos2(left, bottom)],
        '⟨' => vec![pos2(right, top), pos2(left, middle), pos2(right, bottom)],
        '⟩' => vec![pos2(left, top), pos2(right, middle), pos2(left, bottom)],
        _ => vec![pos2(0.5 * (left + right), top), pos2(0.5 * (left + right), bottom)],
    }
}
