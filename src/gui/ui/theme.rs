//! Colours and sizes: the only place that has any.

use crate::export::figure::{Colour, Colours};
use eframe::egui::{self, Color32, FontData, FontFamily};

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
    if dark {
        Palette {
            stator: Color32::from_rgb(0x8c, 0x9a, 0xae),
            rotor: Color32::from_rgb(0xc9, 0xb0, 0x8c),
            film: Color32::from_rgb(0x56, 0xb4, 0xe9),
            contact: Color32::from_rgb(0xe6, 0x8a, 0x2e),
            accent: Color32::from_rgb(0xf0, 0xe4, 0x42),
            quiet: Color32::from_rgb(0x9a, 0xa2, 0xad),
            alarm: Color32::from_rgb(0xff, 0x6b, 0x5e),
            good: Color32::from_rgb(0x3f, 0xc7, 0x9a),
            canvas: Color32::from_rgb(0x14, 0x17, 0x1d),
        }
    } else {
        Palette {
            stator: Color32::from_rgb(0x6b, 0x77, 0x88),
            rotor: Color32::from_rgb(0xa9, 0x8a, 0x5c),
            film: Color32::from_rgb(0x00, 0x72, 0xb2),
            contact: Color32::from_rgb(0xd5, 0x5e, 0x00),
            accent: Color32::from_rgb(0x9b, 0x2f, 0xae),
            quiet: Color32::from_rgb(0x60, 0x66, 0x70),
            alarm: Color32::from_rgb(0xb0, 0x1c, 0x10),
            good: Color32::from_rgb(0x00, 0x75, 0x56),
            canvas: Color32::from_rgb(0xff, 0xff, 0xff),
        }
    }
}

/// Colours of runs laid over each other, in the order of those in printed figures.
pub const RUNS: usize = 7;

/// Colour of one of several runs; after [`RUNS`] they begin again.
pub fn run_colour(slot: usize, dark: bool) -> Color32 {
    const DARK: [[u8; 3]; RUNS] = [
        [0x56, 0xb4, 0xe9],
        [0xf0, 0x8a, 0x3c],
        [0x3f, 0xc7, 0x9a],
        [0xe3, 0x9a, 0xc6],
        [0xf0, 0xd4, 0x42],
        [0xa9, 0xb4, 0xff],
        [0xdf, 0xe3, 0xe9],
    ];
    const LIGHT: [[u8; 3]; RUNS] = [
        [0x00, 0x72, 0xb2],
        [0xd5, 0x5e, 0x00],
        [0x00, 0x8a, 0x64],
        [0xb0, 0x4c, 0x8a],
        [0xa6, 0x76, 0x00],
        [0x52, 0x5c, 0xc8],
        [0x22, 0x26, 0x2c],
    ];
    let [r, g, b] = if dark { DARK } else { LIGHT }[slot % RUNS];
    Color32::from_rgb(r, g, b)
}

/// Colour of a value between 0 and 1 in a field: perceptually uniform.
pub fn field_colour(value: f64) -> Color32 {
    let Colour(r, g, b) = Colours::Field.at(value);
    Color32::from_rgb(r, g, b)
}

/// `colour` on a face that has this much light, 0 to 1.
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

/// Greys with a little blue, so that panels and drawings are of one kind, and text that is read from the last row.
fn dress(visuals: &mut egui::Visuals, dark: bool) {
    let grey = |dark_value: [u8; 3], light_value: [u8; 3]| {
        let [r, g, b] = if dark { dark_value } else { light_value };
        Color32::from_rgb(r, g, b)
    };
    visuals.panel_fill = grey([0x1e, 0x21, 0x28], [0xf2, 0xf3, 0xf6]);
    visuals.window_fill = grey([0x24, 0x28, 0x30], [0xfd, 0xfd, 0xfe]);
    visuals.extreme_bg_color = grey([0x13, 0x15, 0x1a], [0xff, 0xff, 0xff]);
    visuals.window_stroke.color = grey([0x3d, 0x43, 0x4f], [0xc2, 0xc7, 0xcf]);
    visuals.selection.bg_fill = grey([0x1c, 0x67, 0x96], [0x9c, 0xcf, 0xee]);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke.color = grey([0x36, 0x3b, 0x46], [0xcf, 0xd3, 0xda]);
    widgets.noninteractive.fg_stroke.color = grey([0xb8, 0xbe, 0xc8], [0x3c, 0x41, 0x4a]);
    widgets.inactive.bg_fill = grey([0x3a, 0x40, 0x4c], [0xdd, 0xe0, 0xe6]);
    widgets.inactive.weak_bg_fill = grey([0x32, 0x37, 0x42], [0xe1, 0xe4, 0xe9]);
    widgets.hovered.bg_fill = grey([0x47, 0x4f, 0x5d], [0xcd, 0xd2, 0xda]);
    widgets.hovered.weak_bg_fill = grey([0x3f, 0x46, 0x53], [0xd3, 0xd8, 0xdf]);
    widgets.active.bg_fill = grey([0x50, 0x59, 0x69], [0xbf, 0xc6, 0xd0]);
    widgets.active.weak_bg_fill = grey([0x47, 0x4f, 0x5d], [0xc6, 0xcc, 0xd5]);
    widgets.open.weak_bg_fill = grey([0x2b, 0x30, 0x39], [0xdc, 0xe0, 0xe6]);
    widgets.inactive.fg_stroke.color = grey([0xd2, 0xd7, 0xdf], [0x2e, 0x33, 0x3b]);
}

/// Gives fields and boxes an outline: in the light theme their fill is nearly that of the panel.
pub fn outline_fields(ui: &mut egui::Ui) {
    let widgets = &mut ui.visuals_mut().widgets;
    widgets.inactive.bg_stroke = widgets.noninteractive.bg_stroke;
}

/// Installs the fonts: those of egui that text is written with, with fewer glyphs, its icons, and DejaVu Sans for the glyphs that they lack.
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

/// The ring round what is highlighted.
pub mod highlight {
    /// Between it and what it is round.
    pub const GAP: f32 = 3.0;
    /// Its width.
    pub const LINE: f32 = 2.0;
    /// The width of its glow.
    pub const GLOW: f32 = 6.0;
    /// Its corners.
    pub const CORNER: u8 = 6;
}

/// Sizes of formulas, relative to the text around them.
pub mod mathematics {
    /// A formula on its own.
    pub const DISPLAY: f32 = 1.2;
    /// Indices and exponents.
    pub const SCRIPT: f32 = 0.72;
    /// The sign of a sum on its own.
    pub const SUM: f32 = 1.5;
    /// What is over and under a line in the middle of a text.
    pub const FRACTION: f32 = 0.8;
    /// The smallest \[points\].
    pub const LEAST: f32 = 8.5;
    /// Height of the middle of + and − above the baseline.
    pub const AXIS: f32 = 0.27;
    /// Height of a letter above the baseline.
    pub const ASCENT: f32 = 0.74;
    /// Depth of a letter below it.
    pub const DESCENT: f32 = 0.21;
    /// Width of lines: of fractions and roots.
    pub const RULE: f32 = 0.07;
}
