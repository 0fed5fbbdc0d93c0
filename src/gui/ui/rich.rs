//! Text with formulas in it, broken into lines.

use super::formula::{ASCENT, DESCENT, Style as MathStyle, Typeset};
use crate::gui::ui::cache::once;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::theme::palette;
use crate::lessons::picture::Picture;
use crate::lessons::text::{Block, Inline, Style, plain};
use eframe::egui::{self, Color32, FontId, Response, Sense, TextStyle, Ui, pos2, vec2};

/// Size of a formula on its own, as a share of the text's.
const DISPLAY: f32 = 1.2;

/// How a text looks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    /// Height of the text \[points\].
    pub(super) size: f32,
    pub(super) colour: Color32,
}

impl Look {
    /// The usual text of this ui.
    pub(super) fn usual(ui: &Ui) -> Self {
        Self { size: TextStyle::Body.resolve(ui.style()).size, colour: ui.visuals().text_color() }
    }

    /// A little larger than the usual text, for longer texts.
    pub(super) fn reading(ui: &Ui) -> Self {
        let usual = Self::usual(ui);
        Self { size: 1.08 * usual.size, colour: ui.visuals().strong_text_color().lerp_to_gamma(usual.colour, 0.35) }
    }

    pub(super) fn coloured(self, colour: Color32) -> Self {
        Self { colour, ..self }
    }
}

/// Shows blocks below each other.
pub(super) fn blocks(ui: &mut Ui, blocks: &[Block], look: Look) {
    for (i, block) in blocks.iter().enumerate() {
        if i > 0 {
            ui.add_space(0.45 * look.size);
        }
        match block {
            Block::Paragraph(parts) => drop(paragraph(ui, parts, look)),
            Block::Item(parts) => drop(item(ui, parts, look)),
            Block::Picture(picture) => shown(ui, picture),
            Block::Formula(formula) => {
                let room = ui.available_width();
                let style = MathStyle { size: DISPLAY * look.size, colour: look.colour, display: true };
                let mut formula_set = Typeset::of(ui.painter(), &formula.nodes, style);
                if formula_set.width > room {
                    let size = style.size * ((room / formula_set.width) * 0.98);
                    formula_set = Typeset::of(ui.painter(), &formula.nodes, MathStyle { size, ..style });
                }
                let height = formula_set.ascent + formula_set.descent + 0.5 * look.size;
                let (area, response) = ui.allocate_exact_size(vec2(room, height), Sense::hover());
                let left = area.left() + (0.5 * (room - formula_set.width)).max(0.0);
                let at = pos2(left, area.top() + 0.25 * look.size + formula_set.ascent);
                ui.painter().extend(formula_set.moved(at.to_vec2()));
                response.called(egui::Role::Label, &formula.plain());
            }
        }
    }
}

/// A picture, in its own width or in the available width, whichever is less.
fn shown(ui: &mut Ui, picture: &Picture) {
    let place = picture.rgba.as_ptr() as usize;
    let texture = once(ui, &format!("picture at {place}"), (place, picture.size), || {
        let image = egui::ColorImage::from_rgba_unmultiplied(picture.size, &picture.rgba);
        ui.ctx().load_texture("picture of a lesson", image, egui::TextureOptions::LINEAR)
    });
    let image = egui::Image::new(texture.as_ref()).max_width(ui.available_width()).alt_text(&picture.alternative);
    ui.add(image);
}

/// A piece of text that is not broken between lines.
struct Atom {
    set: Typeset,
    /// Space before it, unless it begins a line; `None` if nothing separates it from the piece before.
    space: Option<f32>,
    /// Whether it stays on one line with the piece before: a unit with its number, groups of digits with each other.
    glued: bool,
}

/// Shows one paragraph; its response contains the whole text.
pub(super) fn paragraph(ui: &mut Ui, parts: &[Inline], look: Look) -> Response {
    let atoms = atoms(ui, parts, look);
    let room = ui.available_width();
    let mut lines: Vec<Vec<&Atom>> = vec![Vec::new()];
    let mut at = 0.0;
    // Pieces that stay together are moved together.
    for unit in atoms.chunk_by(|_, next| next.space.is_none() || next.glued) {
        let inside: f32 = unit.iter().skip(1).filter_map(|atom| atom.space).sum();
        let width = inside + unit.iter().map(|atom| atom.set.width).sum::<f32>();
        let space = unit[0].space.unwrap_or_default();
        if at > 0.0 && at + space + width > room {
            lines.push(Vec::new());
            at = 0.0;
        }
        at += if at > 0.0 { space + width } else { width };
        if let Some(line) = lines.last_mut() {
            line.extend(unit);
        }
    }
    let lead = 0.36 * look.size;
    let (ascent, descent) = (ASCENT * look.size, DESCENT * look.size);
    let heights: Vec<(f32, f32)> = lines
        .iter()
        .map(|line| line.iter().map(|atom| &atom.set))
        .map(|sets| sets.fold((ascent, descent), |(a, d), set| (a.max(set.ascent), d.max(set.descent))))
        .collect();
    let height: f32 = heights.iter().map(|(ascent, descent)| ascent + descent + lead).sum();
    let (area, response) = ui.allocate_exact_size(vec2(room, height), Sense::hover());
    let response = response.called(egui::Role::Label, &plain(parts));
    if ui.is_rect_visible(area) {
        let mut top = area.top();
        for (line, (ascent, descent)) in lines.iter().zip(&heights) {
            let writing = top + 0.5 * lead + ascent;
            let mut x = area.left();
            for (i, atom) in line.iter().enumerate() {
                if i > 0 {
                    x += atom.space.unwrap_or_default();
                }
                ui.painter().extend(atom.set.moved(vec2(x, writing)));
                x += atom.set.width;
            }
            top += ascent + descent + lead;
        }
    }
    response
}

fn item(ui: &mut Ui, parts: &[Inline], look: Look) -> Response {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let (dot, _) = ui.allocate_exact_size(vec2(0.95 * look.size, look.size), Sense::hover());
        let middle = dot.left_center() + vec2(0.4 * look.size, 0.08 * look.size);
        ui.painter().circle_filled(middle, 0.13 * look.size, look.colour);
        ui.vertical(|ui| paragraph(ui, parts, look)).inner
    })
    .inner
}

/// How far the top of a slanted word leans beyond its end, as a share of the height of the text.
const LEAN: f32 = 0.15;

fn atoms(ui: &Ui, parts: &[Inline], look: Look) -> Vec<Atom> {
    let painter = ui.painter();
    let blank = painter.layout_no_wrap(" ".to_owned(), FontId::proportional(look.size), look.colour);
    let space = blank.size().x.max(0.25 * look.size);
    let style = |colour: Color32| MathStyle { size: look.size, colour, display: false };
    let mut atoms = Vec::new();
    // These say whether white space came before, and before that a number. A slanted word leans over the one after it.
    let (mut apart, mut number, mut lean) = (true, false, 0.0);
    for part in parts {
        match part {
            // The caller, who knows the run, has filled in the numbers.
            Inline::Number(_) => {}
            Inline::Math(formula) => {
                let set = Typeset::of(painter, &formula.nodes, style(look.colour));
                atoms.push(Atom { set, space: apart.then_some(space + lean), glued: false });
                (apart, number, lean) = (false, false, 0.0);
            }
            Inline::Text { text, style: kind } => {
                let mut rest = text.as_str();
                while !rest.is_empty() {
                    let trimmed = rest.trim_start();
                    apart |= trimmed.len() < rest.len();
                    let end = trimmed.find(char::is_whitespace).unwrap_or(trimmed.len());
                    let (word, after) = trimmed.split_at(end);
                    rest = after;
                    if word.is_empty() {
                        break;
                    }
                    let set = |colour| Typeset::text(painter, word, style(colour), *kind == Style::Slanted);
                    let set = match kind {
                        Style::Plain | Style::Slanted => set(look.colour),
                        // The fonts have one weight, so strong text has a colour instead.
                        Style::Strong => set(palette(ui.visuals().dark_mode).film),
                        Style::Code => set(look.colour).with_ground(ui.visuals().extreme_bg_color),
                    };
                    let glued = number && (word.starts_with(|c: char| c.is_ascii_digit()) || is_unit(word));
                    let before = if *kind == Style::Slanted { 0.0 } else { lean };
                    atoms.push(Atom { set, space: apart.then_some(space + before), glued });
                    lean = if *kind == Style::Slanted { LEAN * look.size } else { 0.0 };
                    (apart, number) = (false, word.ends_with(|c: char| c.is_ascii_digit()));
                }
            }
        }
    }
    atoms
}

/// Whether a word, without punctuation after it, is a unit.
fn is_unit(word: &str) -> bool {
    const UNITS: &str = "nm µm mm cm m mm/s g kg N N/m N·m N·s/m mN·s/m Pa kPa W Hz kHz µs ms s rpm %";
    let word = word.trim_end_matches(['.', ',', ':', ';', '?', ')']);
    UNITS.split(' ').any(|unit| unit == word)
}
