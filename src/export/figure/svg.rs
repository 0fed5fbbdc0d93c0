//! Builds an SVG: lines, areas, text and pictures, with coordinates in points from the upper left corner.

use super::colour::Colour;
use super::error::Pixels;
use super::style::{Dash, Marker, Shape, Style};
use super::text::{SMALL, Script, pieces, plain, width};
use std::fmt::Write as _;

/// A rectangle \[pt\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rect {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Rect {
    pub(super) fn right(&self) -> f64 {
        self.x + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.y + self.height
    }

    /// Points all over it, close together.
    pub(super) fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        let apart = 3.0;
        let [columns, rows] = [self.width, self.height].map(|length| (length / apart).ceil() as usize);
        let Self { x, y, width, height } = *self;
        let along = |from: f64, length: f64, i: usize, of: usize| from + length * i as f64 / of.max(1) as f64;
        (0..=columns)
            .flat_map(move |i| (0..=rows).map(move |j| [along(x, width, i, columns), along(y, height, j, rows)]))
    }

    pub(super) fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let slack = 1e-6;
        x >= self.x - slack && x <= self.right() + slack && y >= self.y - slack && y <= self.bottom() + slack
    }
}

/// A picture under the drawing.
pub(super) struct Raster {
    pub(super) rect: Rect,
    pub(super) pixels: Pixels,
}

/// Position and style of text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Type {
    pub(super) size: f64,
    pub(super) colour: Colour,
    /// `start`, `middle` or `end`.
    pub(super) anchor: &'static str,
    /// Degrees, clockwise.
    pub(super) angle: f64,
}

impl Type {
    pub(super) fn new(size: f64, anchor: &'static str) -> Self {
        Self { size, colour: Colour::BLACK, anchor, angle: 0.0 }
    }
}

/// The elements so far.
#[derive(Debug, Default)]
pub(super) struct Svg {
    pub(super) body: String,
}

/// A coordinate to a thousandth of a point; NaN gives a position far from the figure.
pub(super) fn coordinate(value: f64) -> String {
    let value = if value.is_finite() { value.clamp(-1e6, 1e6) } else { -1e6 };
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text for HTML and XML; characters that they do not allow are replaced.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' => out.push(c),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

// Writing to a String cannot fail: the results of `write!` are dropped below.
impl Svg {
    /// Opens a group with attributes, given as they are.
    pub(super) fn open(&mut self, attributes: &str) {
        let _ = writeln!(self.body, "<g {attributes}>");
    }

    pub(super) fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// Writes the attributes of the line style, and ends the element.
    fn stroke(&mut self, style: &Style) {
        let width = if style.width.is_finite() { style.width.clamp(0.1, 20.0) } else { 1.0 };
        let _ = write!(self.body, r#" stroke="{}" stroke-width="{}""#, style.colour.hex(), coordinate(width));
        let w = width.max(0.4);
        let dashes: &[f64] = match style.dash {
            Dash::Solid => &[],
            Dash::Dashed => &[4.5, 2.2],
            Dash::Dotted => &[1.0, 1.8],
            Dash::DashDot => &[5.5, 1.9, 1.0, 1.9],
        };
        if !dashes.is_empty() {
            let list: Vec<String> = dashes.iter().map(|part| coordinate(part * w)).collect();
            let _ = write!(self.body, r#" stroke-dasharray="{}""#, list.join(" "));
        }
        self.body.push_str("/>\n");
    }

    /// A line through points.
    pub(super) fn polyline(&mut self, points: &[[f64; 2]], style: &Style) {
        if points.len() < 2 {
            return;
        }
        self.body.push_str(r#"<polyline fill="none" stroke-linejoin="round" points=""#);
        self.points(points);
        self.body.push('"');
        self.stroke(style);
    }

    fn points(&mut self, points: &[[f64; 2]]) {
        for (i, [x, y]) in points.iter().enumerate() {
            let gap = if i == 0 { "" } else { " " };
            let _ = write!(self.body, "{gap}{},{}", coordinate(*x), coordinate(*y));
        }
    }

    /// A filled area.
    pub(super) fn polygon(&mut self, points: &[[f64; 2]], colour: Colour, opacity: f64) {
        if points.len() < 3 {
            return;
        }
        self.body.push_str(r#"<polygon points=""#);
        self.points(points);
        let _ = write!(self.body, r#"" fill="{}""#, colour.hex());
        if opacity < 1.0 {
            let _ = write!(self.body, r#" fill-opacity="{}""#, coordinate(opacity.max(0.0)));
        }
        self.body.push_str("/>\n");
    }

    /// A rectangle with an outline, with or without a filling.
    pub(super) fn rect(&mut self, rect: &Rect, style: &Style, fill: Option<(Colour, f64)>) {
        let [x, y, w, h] = [rect.x, rect.y, rect.width.max(0.0), rect.height.max(0.0)].map(coordinate);
        let _ = write!(self.body, r#"<rect x="{x}" y="{y}" width="{w}" height="{h}""#);
        match fill {
            Some((colour, opacity)) => {
                let _ = write!(self.body, r#" fill="{}" fill-opacity="{}""#, colour.hex(), coordinate(opacity));
            }
            None => self.body.push_str(r#" fill="none""#),
        }
        self.stroke(style);
    }

    /// Many short lines in one path, such as ticks.
    pub(super) fn segments(&mut self, segments: &[[f64; 4]], style: &Style) {
        if segments.is_empty() {
            return;
        }
        self.body.push_str(r#"<path fill="none" d=""#);
        for [x0, y0, x1, y1] in segments {
            let [x0, y0, x1, y1] = [*x0, *y0, *x1, *y1].map(coordinate);
            let _ = write!(self.body, "M{x0} {y0}L{x1} {y1}");
        }
        self.body.push('"');
        self.stroke(style);
    }

    /// The shape of a marker.
    pub(super) fn marker(&mut self, [x, y]: [f64; 2], marker: &Marker, colour: Colour) {
        let r = (if marker.size.is_finite() { marker.size.clamp(0.5, 50.0) } else { 4.0 }) / 2.0;
        // The shapes have equal areas, so that they look equally large.
        let shape: Vec<[f64; 2]> = match marker.shape {
            Shape::Circle => Vec::new(),
            Shape::Square => vec![[-0.89, -0.89], [0.89, -0.89], [0.89, 0.89], [-0.89, 0.89]],
            Shape::Triangle => vec![[0.0, -1.25], [1.13, 0.75], [-1.13, 0.75]],
            Shape::Diamond => vec![[0.0, -1.28], [1.28, 0.0], [0.0, 1.28], [-1.28, 0.0]],
            Shape::Cross => {
                let a = 0.9 * r;
                let strokes = [[x - a, y - a, x + a, y + a], [x - a, y + a, x + a, y - a]];
                return self.segments(&strokes, &Style::solid(colour).width(0.9));
            }
        };
        let (fill, outline) = match marker.hollow {
            true => (Colour::WHITE, Style::solid(colour).width(0.8)),
            false => (colour, Style::solid(Colour::WHITE).width(0.3)),
        };
        if shape.is_empty() {
            let [x, y, r] = [x, y, r].map(coordinate);
            let _ = write!(self.body, r#"<circle cx="{x}" cy="{y}" r="{r}" fill="{}""#, fill.hex());
        } else {
            self.body.push_str(r#"<polygon points=""#);
            let placed: Vec<[f64; 2]> = shape.iter().map(|[dx, dy]| [x + r * dx, y + r * dy]).collect();
            self.points(&placed);
            let _ = write!(self.body, r#"" fill="{}""#, fill.hex());
        }
        self.stroke(&outline);
    }

    /// Text with its baseline at a point.
    pub(super) fn text(&mut self, [x, y]: [f64; 2], text: &str, style: &Type) {
        let pieces = pieces(text);
        if plain(text).trim().is_empty() {
            return;
        }
        let [cx, cy] = [x, y].map(coordinate);
        let _ = write!(self.body, r#"<text x="{cx}" y="{cy}" font-size="{}""#, coordinate(style.size));
        if style.anchor != "start" {
            let _ = write!(self.body, r#" text-anchor="{}""#, style.anchor);
        }
        // If another font replaces the first one, the text is fitted into the width that was laid out. This is not done for a text of
        // several pieces, because readers of SVG interpret it differently.
        if pieces.len() == 1 {
            let place = coordinate(width(text, style.size));
            let _ = write!(self.body, r#" textLength="{place}" lengthAdjust="spacingAndGlyphs""#);
        }
        if style.colour != Colour::BLACK {
            let _ = write!(self.body, r#" fill="{}""#, style.colour.hex());
        }
        if style.angle != 0.0 {
            let _ = write!(self.body, r#" transform="rotate({} {cx} {cy})""#, coordinate(style.angle));
        }
        self.body.push('>');
        // dy shifts all text that follows, so every piece gets its distance from the one before.
        let mut at = 0.0;
        for (script, piece) in pieces {
            let (shift, size) = match script {
                Script::Normal => (0.0, style.size),
                Script::Raised => (-0.36 * style.size, SMALL * style.size),
                Script::Lowered => (0.18 * style.size, SMALL * style.size),
            };
            if shift == at && script == Script::Normal {
                self.body.push_str(&escaped(&piece));
            } else {
                let (dy, size) = (coordinate(shift - at), coordinate(size));
                let _ = write!(self.body, r#"<tspan dy="{dy}" font-size="{size}">{}</tspan>"#, escaped(&piece));
            }
            at = shift;
        }
        self.body.push_str("</text>\n");
    }
}
