//! A drawing as SVG, PNG and PDF, in memory and as a file.

use super::description::Figure;
use super::drawing::Drawing;
use super::placed::MM;
use super::svg::{Picture, Rect, coordinate, escaped};
use super::text::{FALLBACK, FAMILIES, SANS, plain};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Ref, TextStr};
use resvg::tiny_skia::{Pixmap, PixmapPaint, Transform};
use resvg::usvg::{self, Tree, fontdb};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};

/// Pixels of a point in print: 300 to the inch.
pub const PRINT: f64 = 300.0 / 72.0;
/// No picture is larger than this along a side.
const MOST: f64 = 20_000.0;

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

/// A figure that cannot be made or written.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The extension is none of those known.
    #[error("{}: figures are written as .svg, .png or .pdf", path.display())]
    Extension {
        /// The path asked for.
        path: PathBuf,
    },
    /// The drawing is not understood by the program that turns it into pixels or a page.
    #[error("the figure cannot be drawn: {0}")]
    Draw(String),
    /// It would have too many pixels, or none.
    #[error("a figure of {width:.0} × {height:.0} pixels cannot be drawn: 1 to {MOST} along a side")]
    Size {
        /// Pixels across.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] crate::atomic::WriteError),
}

/// The figure as an SVG.
pub fn to_svg(figure: &Figure) -> String {
    Drawing::new(figure).svg(figure, true)
}

/// The figure as a PNG of `scale` pixels to the point ([`PRINT`] for 300 to the inch).
pub fn to_png(figure: &Figure, scale: f64) -> Result<Vec<u8>, FigureError> {
    let pixels = pixels(figure, scale)?;
    png_bytes(&pixels, Some(scale), &facts(figure)).map_err(|error| FigureError::Draw(error.to_string()))
}

/// The figure as a PDF of one page, its text as text.
pub fn to_pdf(figure: &Figure) -> Result<Vec<u8>, FigureError> {
    let drawing = Drawing::new(figure);
    let tree = drawing.tree(figure)?;
    pdf(&drawing, &tree, figure).map_err(FigureError::Draw)
}

/// The figure in a format, a PNG in print's resolution.
pub fn to_bytes(figure: &Figure, format: Format) -> Result<Vec<u8>, FigureError> {
    match format {
        Format::Svg => Ok(to_svg(figure).into_bytes()),
        Format::Png => to_png(figure, PRINT),
        Format::Pdf => to_pdf(figure),
    }
}

/// Writes the figure in the format of the path's extension. The file has its name only when it is complete.
///
/// # Errors
/// [`FigureError`]; then no file is left, and an older one of that name is as it was.
pub fn write(figure: &Figure, path: &Path) -> Result<(), FigureError> {
    let bytes = to_bytes(figure, Format::of(path)?)?;
    crate::atomic::write_file(path, |out| out.write_all(&bytes))?;
    Ok(())
}

/// A figure in pixels.
pub(in crate::export) struct Pixels {
    pub(in crate::export) width: u32,
    pub(in crate::export) height: u32,
    /// Red, green, blue, row by row from the top.
    pub(in crate::export) rgb: Vec<u8>,
}

/// The figure in pixels, `scale` of them to the point.
pub(in crate::export) fn pixels(figure: &Figure, scale: f64) -> Result<Pixels, FigureError> {
    let drawing = Drawing::new(figure);
    let [width, height] = drawing.size.map(|length| (length * scale).round());
    if !((1.0..=MOST).contains(&width) && (1.0..=MOST).contains(&height)) {
        return Err(FigureError::Size { width, height });
    }
    let failed = || FigureError::Size { width, height };
    let mut pixmap = Pixmap::new(width as u32, height as u32).ok_or_else(failed)?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    for picture in &drawing.pictures {
        stamp(&mut pixmap, picture, scale);
    }
    let tree = drawing.tree(figure)?;
    let (sx, sy) = (width as f32 / tree.size().width(), height as f32 / tree.size().height());
    resvg::render(&tree, Transform::from_scale(sx, sy), &mut pixmap.as_mut());
    let rgb = pixmap.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    Ok(Pixels { width: pixmap.width(), height: pixmap.height(), rgb })
}

/// Puts a picture where it belongs.
fn stamp(pixmap: &mut Pixmap, picture: &Picture, scale: f64) {
    let Rect { x, y, width, height } = picture.rect;
    let [columns, rows] = picture.size;
    let Some(mut stamp) = Pixmap::new(columns as u32, rows as u32) else { return };
    for (pixel, rgb) in stamp.data_mut().chunks_exact_mut(4).zip(picture.rgb.chunks_exact(3)) {
        pixel[..3].copy_from_slice(rgb);
        pixel[3] = 255;
    }
    let (sx, sy) = (width * scale / columns as f64, height * scale / rows as f64);
    let place = Transform::from_row(sx as f32, 0.0, 0.0, sy as f32, (x * scale) as f32, (y * scale) as f32);
    pixmap.draw_pixmap(0, 0, stamp.as_ref(), &PixmapPaint::default(), place, None);
}

/// What the file says about itself, by the keywords of PNG.
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

/// Pixels as a PNG, with facts in it; `scale` pixels to the point.
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

/// The bundled fonts, and no others: a figure is the same everywhere.
fn options() -> usvg::Options<'static> {
    static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
        let mut fonts = fontdb::Database::new();
        fonts.load_font_data(SANS.to_vec());
        fonts.load_font_data(FALLBACK.to_vec());
        fonts.set_sans_serif_family("Liberation Sans");
        Arc::new(fonts)
    });
    usvg::Options { fontdb: Arc::clone(&FONTS), font_family: "Liberation Sans".to_owned(), ..usvg::Options::default() }
}

impl Drawing {
    /// The SVG; without background and pictures for those who put them under it themselves.
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

    /// The drawing without background and pictures, as the renderers read it.
    fn tree(&self, figure: &Figure) -> Result<Tree, FigureError> {
        Tree::from_str(&self.svg(figure, false), &options()).map_err(|error| FigureError::Draw(error.to_string()))
    }
}

/// A picture as an element, its pixels in it.
fn image(svg: &mut String, picture: &Picture) {
    let [width, height] = picture.size.map(|count| u32::try_from(count).unwrap_or(u32::MAX));
    let pixels = Pixels { width, height, rgb: picture.rgb.clone() };
    let Ok(bytes) = png_bytes(&pixels, None, &[]) else { return };
    let Rect { x, y, width, height } = picture.rect;
    let [x, y, width, height] = [x, y, width, height].map(coordinate);
    let _ = writeln!(
        svg,
        r#"<image x="{x}" y="{y}" width="{width}" height="{height}" preserveAspectRatio="none" href="data:image/png;base64,{}"/>"#,
        STANDARD.encode(bytes)
    );
}

/// A page: pictures, and the drawing over them.
fn pdf(drawing: &Drawing, tree: &Tree, figure: &Figure) -> Result<Vec<u8>, String> {
    let options = svg2pdf::ConversionOptions { pdfa: false, ..svg2pdf::ConversionOptions::default() };
    let (chunk, drawn) = svg2pdf::to_chunk(tree, options).map_err(|error| error.to_string())?;
    let mut next = Ref::new(1);
    let [catalog, pages, page, content, info] = [(); 5].map(|()| next.bump());
    let mut renamed = HashMap::new();
    let chunk = chunk.renumber(|old| *renamed.entry(old).or_insert_with(|| next.bump()));
    let drawn = renamed.get(&drawn).copied().ok_or("the drawing has no page")?;
    let images: Vec<Ref> = drawing.pictures.iter().map(|_| next.bump()).collect();

    let [width, height] = drawing.size.map(|length| length as f32);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let mut leaf = pdf.page(page);
    leaf.media_box(pdf_writer::Rect::new(0.0, 0.0, width, height)).parent(pages).contents(content);
    let mut resources = leaf.resources();
    let mut objects = resources.x_objects();
    objects.pair(Name(b"Drawing"), drawn);
    let name = |i: usize| format!("Picture{i}");
    for (i, image) in images.iter().enumerate() {
        objects.pair(Name(name(i).as_bytes()), *image);
    }
    objects.finish();
    resources.finish();
    leaf.finish();

    let mut operations = Content::new();
    for (i, picture) in drawing.pictures.iter().enumerate() {
        let [x, y, w, h] =
            [picture.rect.x, picture.rect.bottom(), picture.rect.width, picture.rect.height].map(|c| c as f32);
        operations.save_state();
        operations.transform([w, 0.0, 0.0, h, x, height - y]);
        operations.x_object(Name(name(i).as_bytes()));
        operations.restore_state();
    }
    operations.save_state();
    operations.transform([width, 0.0, 0.0, height, 0.0, 0.0]);
    operations.x_object(Name(b"Drawing"));
    operations.restore_state();
    pdf.stream(content, &operations.finish());
    for (image, picture) in images.iter().zip(&drawing.pictures) {
        let packed = deflated(&picture.rgb)?;
        let mut object = pdf.image_xobject(*image, &packed);
        object.filter(Filter::FlateDecode);
        let [columns, rows] = picture.size.map(|count| i32::try_from(count).unwrap_or(i32::MAX));
        object.width(columns).height(rows).bits_per_component(8).color_space().device_rgb();
    }
    pdf.extend(&chunk);
    let mut about = pdf.document_info(info);
    for (keyword, text) in facts(figure) {
        match keyword {
            "Title" => about.title(TextStr(&text)),
            "Description" => about.subject(TextStr(&text)),
            "Source" => about.keywords(TextStr(&text)),
            _ => about.creator(TextStr(&text)),
        };
    }
    about.finish();
    Ok(pdf.finish())
}

/// Pages of a size \[pt\], each the body of an SVG, as one PDF, their text as text.
pub(super) fn svg_pages(title: &str, [width, height]: [f64; 2], pages: &[String]) -> Result<Vec<u8>, FigureError> {
    let failed = |error: String| FigureError::Draw(error);
    let mut next = Ref::new(1);
    let [catalog, tree, info] = [(); 3].map(|()| next.bump());
    let leaves: Vec<Ref> = pages.iter().map(|_| next.bump()).collect();
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree);
    pdf.pages(tree).kids(leaves.iter().copied()).count(i32::try_from(leaves.len()).unwrap_or(i32::MAX));
    let [w, h] = [width, height].map(|length| length as f32);
    for (body, leaf) in pages.iter().zip(leaves) {
        let svg = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="{FAMILIES}">{body}</svg>"#
        );
        let drawing = Tree::from_str(&svg, &options()).map_err(|error| failed(error.to_string()))?;
        let settings = svg2pdf::ConversionOptions { pdfa: false, ..svg2pdf::ConversionOptions::default() };
        let (chunk, drawn) = svg2pdf::to_chunk(&drawing, settings).map_err(|error| failed(error.to_string()))?;
        let mut renamed = HashMap::new();
        let content = next.bump();
        let chunk = chunk.renumber(|old| *renamed.entry(old).or_insert_with(|| next.bump()));
        let drawn = renamed.get(&drawn).copied().ok_or_else(|| failed("the drawing has no page".to_owned()))?;
        let mut page = pdf.page(leaf);
        page.media_box(pdf_writer::Rect::new(0.0, 0.0, w, h)).parent(tree).contents(content);
        page.resources().x_objects().pair(Name(b"Drawing"), drawn);
        page.finish();
        let mut operations = Content::new();
        operations.transform([w, 0.0, 0.0, h, 0.0, 0.0]);
        operations.x_object(Name(b"Drawing"));
        pdf.stream(content, &operations.finish());
        pdf.extend(&chunk);
    }
    pdf.document_info(info).title(TextStr(title)).creator(TextStr("squeezefilm"));
    Ok(pdf.finish())
}

fn deflated(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).map_err(|error| error.to_string())
}
