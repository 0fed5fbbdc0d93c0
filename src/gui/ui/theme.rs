//! Colours, dashes and fonts.

use crate::export::figure::Colour;
use eframe::egui::{self, Color32, FontData, FontFamily};
use egui_plot::LineStyle;

/// Colours with a meaning, for one of the two themes. Distinguishable with the common colour deficiencies (Okabe–Ito).
#[derive(Clone, Copy, Debug)]
pub struct Palette {
    /// The stator and its teeth.
    pub stator: Color32,
    /// The rotor.
    pub rotor: Color32,
    /// Film pressure and film load.
    pub film: Color32,
    /// Contact pressure and contact load.
    pub contact: Color32,
    /// Cursor, selected tooth.
    pub accent: Color32,
    /// Secondary text.
    pub quiet: Color32,
    /// Something is wrong.
    pub alarm: Color32,
    /// Something is as it should be.
    pub good: Color32,
    /// Background of drawings.
    pub canvas: Color32,
}

/// The palette of the present theme.
pub fn palette(dark: bool) -> Palette {
    let colour = |in_dark: u32, in_light: u32| rgb(if dark { in_dark } else { in_light });
    Palette {
        stator: colour(0x8c9aae, 0x6b7788),
        rotor: colour(0xc9b08c, 0xa98a5c),
        film: colour(0x56b4e9, 0x0072b2),
        contact: colour(0xe68a2e, 0xd55e00),
        accent: colour(0xf0e442, 0x9b2fae),
        quiet: colour(0x9aa2ad, 0x606670),
        alarm: colour(0xff6b5e, 0xb01c10),
        good: colour(0x3fc79a, 0x007556),
        canvas: colour(0x14171d, 0xffffff),
    }
}

/// Colour of one of several overlaid runs, in the same order as in printed figures; after the last colour the first follows.
pub fn run_colour(slot: usize, dark: bool) -> Color32 {
    const DARK: [u32; 7] = [0x56b4e9, 0xf08a3c, 0x3fc79a, 0xe39ac6, 0xf0d442, 0xa9b4ff, 0xdfe3e9];
    const LIGHT: [u32; 7] = [0x0072b2, 0xd55e00, 0x008a64, 0xb04c8a, 0xa67600, 0x525cc8, 0x22262c];
    let colours = if dark { DARK } else { LIGHT };
    rgb(colours[slot % colours.len()])
}

/// Dashes of that run: runs with the same colour have different dashes.
pub fn run_dash(slot: usize) -> LineStyle {
    let dashes = [LineStyle::Solid, LineStyle::dashed_loose(), LineStyle::dotted_dense(), LineStyle::dashed_dense()];
    dashes[slot / Colour::CYCLE.len() % dashes.len()]
}

/// Stands for the accent colour of the window in the description of a chart.
pub const ACCENT: Colour = Colour(0xf0, 0xe4, 0x42);

/// The colour of the window that corresponds to this colour on paper.
pub fn on_screen(colour: Colour, visuals: &egui::Visuals) -> Color32 {
    let palette = palette(visuals.dark_mode);
    let own = [
        (Colour::BLACK, visuals.strong_text_color()),
        (Colour::FILM, palette.film),
        (Colour::CONTACT, palette.contact),
        (Colour::ROTOR, palette.rotor),
        (Colour::STATOR, palette.stator),
        (Colour::QUIET, palette.quiet),
        (ACCENT, palette.accent),
    ];
    let runs = (0..).zip(Colour::CYCLE).map(|(slot, of)| (of, run_colour(slot, visuals.dark_mode)));
    let known = own.into_iter().chain(runs).find(|(of, _)| *of == colour);
    known.map_or(Color32::from_rgb(colour.0, colour.1, colour.2), |(_, found)| found)
}

/// The colour of six hexadecimal digits.
fn rgb(digits: u32) -> Color32 {
    let [_, red, green, blue] = digits.to_be_bytes();
    Color32::from_rgb(red, green, blue)
}

/// `colour` on a surface with this brightness, 0 to 1.
pub fn lit(colour: Color32, light: f32) -> Color32 {
    let [r, g, b] = [colour.r(), colour.g(), colour.b()].map(|part| (f32::from(part) * light.clamp(0.0, 1.0)) as u8);
    Color32::from_rgb(r, g, b)
}

/// Installs fonts and the colours of both themes.
pub fn install(ctx: &egui::Context) {
    install_fonts(ctx);
    for theme in [egui::Theme::Dark, egui::Theme::Light] {
        let dark = theme == egui::Theme::Dark;
        ctx.style_mut_of(theme, |style| dress(&mut style.visuals, dark));
    }
}

/// Greys with a little blue, so that panels and drawings match, and text that is legible from the last row.
fn dress(visuals: &mut egui::Visuals, dark: bool) {
    let grey = |in_dark: u32, in_light: u32| rgb(if dark { in_dark } else { in_light });
    visuals.panel_fill = grey(0x1e2128, 0xf2f3f6);
    visuals.window_fill = grey(0x242830, 0xfdfdfe);
    visuals.extreme_bg_color = grey(0x13151a, 0xffffff);
    visuals.window_stroke.color = grey(0x3d434f, 0xc2c7cf);
    visuals.selection.bg_fill = grey(0x1c6796, 0x9ccfee);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke.color = grey(0x363b46, 0xcfd3da);
    widgets.noninteractive.fg_stroke.color = grey(0xb8bec8, 0x3c414a);
    widgets.inactive.bg_fill = grey(0x3a404c, 0xdde0e6);
    widgets.inactive.weak_bg_fill = grey(0x323742, 0xe1e4e9);
    widgets.hovered.bg_fill = grey(0x474f5d, 0xcdd2da);
    widgets.hovered.weak_bg_fill = grey(0x3f4653, 0xd3d8df);
    widgets.active.bg_fill = grey(0x505969, 0xbfc6d0);
    widgets.active.weak_bg_fill = grey(0x474f5d, 0xc6ccd5);
    widgets.open.weak_bg_fill = grey(0x2b3039, 0xdce0e6);
    widgets.inactive.fg_stroke.color = grey(0xd2d7df, 0x2e333b);
}

/// Gives fields and boxes an outline, because in the light theme their fill is nearly the colour of the panel.
pub fn outline_fields(ui: &mut egui::Ui) {
    let widgets = &mut ui.visuals_mut().widgets;
    widgets.inactive.bg_stroke = widgets.noninteractive.bg_stroke;
}

/// Installs the fonts: those of egui that are needed for text, reduced to fewer glyphs, egui's icons, and DejaVu Sans for missing glyphs.
pub fn install_fonts(ctx: &egui::Context) {
    use FontFamily::{Monospace, Proportional};
    const UBUNTU: &[u8] = include_bytes!("../../../assets/fonts/reduced/Ubuntu-Light.ttf");
    const HACK: &[u8] = include_bytes!("../../../assets/fonts/reduced/Hack-Regular.ttf");
    let mut fonts = egui::FontDefinitions::empty();
    for (name, font, families) in [
        ("Hack", HACK, &[Monospace][..]),
        ("Ubuntu-Light", UBUNTU, &[Proportional]),
        ("dejavu", crate::platform::dejavu(), &[Proportional, Monospace]),
        ("egui-icons", epaint_default_fonts::EGUI_ICONS, &[Proportional, Monospace]),
    ] {
        fonts.font_data.insert(name.to_owned(), FontData::from_static(font).into());
        for family in families {
            fonts.families.entry(family.clone()).or_default().push(name.to_owned());
        }
    }
    ctx.set_fonts(fonts);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_one_colour_have_other_dashes() {
        for dark in [false, true] {
            let looks: Vec<_> = (0..28).map(|slot| (run_colour(slot, dark), run_dash(slot))).collect();
            assert!(looks[..7].iter().all(|(_, dash)| *dash == LineStyle::Solid));
            assert!(looks.iter().enumerate().all(|(i, look)| !looks[..i].contains(look)));
        }
    }
}
