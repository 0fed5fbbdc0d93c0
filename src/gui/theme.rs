//! Colours and sizes: the only place that has any.

use eframe::egui::{self, Color32, FontData, FontDefinitions, FontFamily};
use std::sync::Arc;

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
            canvas: Color32::from_rgb(0x16, 0x19, 0x1f),
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
            canvas: Color32::from_rgb(0xfb, 0xfb, 0xfd),
        }
    }
}

/// Colour of a value between 0 and 1 in a field: perceptually uniform.
pub fn field_colour(value: f64) -> Color32 {
    let colour = colorous::VIRIDIS.eval_continuous(value.clamp(0.0, 1.0));
    Color32::from_rgb(colour.r, colour.g, colour.b)
}

/// Installs the fonts: egui's own, and DejaVu Sans for the glyphs that they lack.
pub fn install_fonts(ctx: &egui::Context) {
    let mut fonts = FontDefinitions::default();
    let dejavu = FontData::from_static(include_bytes!("../../assets/fonts/DejaVuSans.ttf"));
    fonts.font_data.insert("dejavu".to_owned(), Arc::new(dejavu));
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.entry(family).or_default().insert(1, "dejavu".to_owned());
    }
    ctx.set_fonts(fonts);
}
