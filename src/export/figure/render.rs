//! An SVG in pixels (resvg) and on a page (svg2pdf), with the bundled fonts.

use super::drawing::Drawing;
use super::error::{FigureError, Pixels};
use super::svg::{Picture, Rect};
use super::text::FAMILIES;
use crate::platform::{dejavu, liberation};

use pdf_writer::{Content, Filter, Finish, Name, Pdf, Ref, TextStr};
use resvg::tiny_skia::{Pixmap, PixmapPaint, Transform};
use resvg::usvg::{self, Tree, fontdb};
use std::collections::HashMap;
use std::io::Write as _;
use std::sync::{Arc, LazyLock};

/// `drawing`, whose SVG without background and pictures is `svg`, in so many pixels across and down, `scale` of them to the point.
pub(super) fn pixels(
    drawing: &Drawing,
    svg: &str,
    scale: f64,
    [width, height]: [f64; 2],
) -> Result<Pixels, FigureError> {
    let mut pixmap = Pixmap::new(width as u32, height as u32).ok_or(FigureError::Size { width, height })?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    for picture in &drawing.pictures {
        stamp(&mut pixmap, picture, scale);
    }
    let tree = tree(svg)?;
    let (sx, sy) = (width as f32 / tree.size().width(), height as f32 / tree.size().height());
    resvg::render(&tree, Transform::from_scale(sx, sy), &mut pixmap.as_mut());
    let rgb = pixmap.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    Ok(Pixels { width: pixmap.width(), height: pixmap.height(), rgb })
}

/// The same as a PDF of one page, its text as text.
pub(super) fn pdf(drawing: &Drawing, svg: &str, facts: &[(&'static str, String)]) -> Result<Vec<u8>, FigureError> {
    page(drawing, &tree(svg)?, facts).map_err(FigureError::Draw)
}

/// The drawing as the renderers read it.
fn tree(svg: &str) -> Result<Tree, FigureError> {
    Tree::from_str(svg, &options()).map_err(|error| FigureError::Draw(error.to_string()))
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

/// The bundled fonts, and no others: a figure is the same everywhere.
fn options() -> usvg::Options<'static> {
    static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
        let mut fonts = fontdb::Database::new();
        fonts.load_font_data(liberation().to_vec());
        fonts.load_font_data(dejavu().to_vec());
        fonts.set_sans_serif_family("Liberation Sans");
        Arc::new(fonts)
    });
    usvg::Options { fontdb: Arc::clone(&FONTS), font_family: "Liberation Sans".to_owned(), ..usvg::Options::default() }
}

/// A page: pictures, and the drawing over them.
fn page(drawing: &Drawing, tree: &Tree, facts: &[(&'static str, String)]) -> Result<Vec<u8>, String> {
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
    for (keyword, text) in facts {
        match *keyword {
            "Title" => about.title(TextStr(text)),
            "Description" => about.subject(TextStr(text)),
            "Source" => about.keywords(TextStr(text)),
            _ => about.creator(TextStr(text)),
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
