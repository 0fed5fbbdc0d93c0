//! A drawing as SVG, PNG and PDF, in memory and as a file.

use super::description::Figure;
use super::drawing::Drawing;
use super::error::{FigureError, MOST, Pixels};
use super::placed::MM;
use super::plane::PRINT;
use super::render;
use super::svg::{Raster, Rect, coordinate, escaped};
use super::text::{FAMILIES, plain};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write as _;
use std::path::Path;

/// A format of figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// Scalable, for the web and for editing.
    Svg,
    /// Pixels at 300 to the inch.
    Png,
    /// Scalable, for LaTeX.
    Pdf,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Pdf];
    /// The formats that this program writes: without the feature `render` it can draw neither pixels nor pages.
    pub const WRITTEN: &[Self] = if cfg!(feature = "render") { &Self::ALL } else { &[Self::Svg] };

    /// Its name, which is also its extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
        }
    }

    /// The format of a path, by its extension in either case.
    pub fn of(path: &Path) -> Result<Self, FigureError> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        let found = Self::ALL.into_iter().find(|format| extension.as_deref() == Some(format.name()));
        found.ok_or_else(|| FigureError::Extension { path: path.to_owned() })
    }
}

/// The figure as an SVG.
pub fn to_svg(figure: &Figure) -> String {
    Drawing::new(figure).svg(figure, true)
}

/// The figure as a PNG with `scale` pixels per point ([`PRINT`] for 300 per inch).
pub fn to_png(figure: &Figure, scale: f64) -> Result<Vec<u8>, FigureError> {
    let pixels = pixels(figure, scale)?;
    png_bytes(&pixels, Some(scale), &facts(figure)).map_err(|error| FigureError::Draw(error.to_string()))
}

/// The figure as a PDF of one page, its text as text.
pub fn to_pdf(figure: &Figure) -> Result<Vec<u8>, FigureError> {
    let drawing = Drawing::new(figure);
    let svg = drawing.svg(figure, false);
    render::pdf(&[(drawing, svg)], &facts(figure))
}

/// The figure in a format; a PNG has the resolution of print.
pub fn to_bytes(figure: &Figure, format: Format) -> Result<Vec<u8>, FigureError> {
    match format {
        Format::Svg => Ok(to_svg(figure).into_bytes()),
        Format::Png => to_png(figure, PRINT),
        Format::Pdf => to_pdf(figure),
    }
}

/// Writes the figure in the format of the path's extension. The file has its name only when it is complete.
pub fn write(figure: &Figure, path: &Path) -> Result<(), FigureError> {
    let bytes = to_bytes(figure, Format::of(path)?)?;
    crate::atomic::write_file(path, |out| out.write_all(&bytes))?;
    Ok(())
}

/// The figure in pixels, with `scale` pixels per point.
pub(in crate::export) fn pixels(figure: &Figure, scale: f64) -> Result<Pixels, FigureError> {
    let drawing = Drawing::new(figure);
    let [width, height] = drawing.size.map(|length| (length * scale).round());
    if !((1.0..=MOST).contains(&width) && (1.0..=MOST).contains(&height)) {
        return Err(FigureError::Size { width, height });
    }
    render::pixels(&drawing, &drawing.svg(figure, false), scale, [width, height])
}

/// Metadata of the file, with the keywords of PNG.
fn facts(figure: &Figure) -> Vec<(&'static str, String)> {
    let software = if figure.provenance.version.is_empty() {
        "squeezefilm".to_owned()
    } else {
        format!("squeezefilm {}", figure.provenance.version)
    };
    let facts = [
        ("Title", plain(&figure.title)),
        ("Description", plain(&figure.caption)),
        ("Source", plain(&figure.provenance.line())),
        ("Software", software),
    ];
    facts.into_iter().filter(|(_, text)| !text.is_empty()).collect()
}

/// Pixels as a PNG, with metadata; `scale` pixels per point.
pub(in crate::export) fn png_bytes(
    pixels: &Pixels,
    scale: Option<f64>,
    facts: &[(&str, String)],
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, pixels.width, pixels.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    if let Some(scale) = scale {
        let per_metre = (scale * 72.0 / 0.0254).round() as u32;
        let unit = png::Unit::Meter;
        encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit }));
    }
    for (keyword, text) in facts {
        encoder.add_itxt_chunk((*keyword).to_owned(), text.clone())?;
    }
    encoder.write_header()?.write_image_data(&pixels.rgb)?;
    Ok(bytes)
}

impl Drawing {
    /// The SVG; if not `whole`, without background and pictures, which the caller then puts under it.
    fn svg(&self, figure: &Figure, whole: bool) -> String {
        let [width, height] = self.size;
        let millimetres = |points: f64| coordinate(points / MM);
        // Writing to a String cannot fail.
        let mut svg = String::with_capacity(self.body.len() + 2000);
        let _ = writeln!(
            svg,
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{}mm" height="{}mm" viewBox="0 0 {} {}" font-family="{FAMILIES}">"#,
            millimetres(width),
            millimetres(height),
            coordinate(width),
            coordinate(height),
        );
        for (keyword, text) in facts(figure) {
            let _ = match keyword {
                "Title" => writeln!(svg, "<title>{}</title>", escaped(&text)),
                "Description" => writeln!(svg, "<desc>{}</desc>", escaped(&text)),
                _ => Ok(()),
            };
        }
        let provenance = serde_json::to_string(&figure.provenance).unwrap_or_default();
        let _ = writeln!(svg, "<metadata>{}</metadata>", escaped(&provenance));
        if whole {
            let _ = writeln!(svg, r##"<rect width="100%" height="100%" fill="#ffffff"/>"##);
            for picture in &self.pictures {
                image(&mut svg, picture);
            }
        }
        svg.push_str(&self.body);
        svg.push_str("</svg>\n");
        svg
    }
}

/// A picture as an SVG element that contains its pixels.
fn image(svg: &mut String, picture: &Raster) {
    let Ok(bytes) = png_bytes(&picture.pixels, None, &[]) else { return };
    let Rect { x, y, width, height } = picture.rect;
    let [x, y, width, height] = [x, y, width, height].map(coordinate);
    let _ = writeln!(
        svg,
        r#"<image x="{x}" y="{y}" width="{width}" height="{height}" preserveAspectRatio="none" href="data:image/png;base64,{}"/>"#,
        STANDARD.encode(bytes)
    );
}
