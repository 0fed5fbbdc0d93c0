//! Converts an SVG to pixels (resvg) and to a page (svg2pdf), with the bundled fonts.

use super::drawing::Drawing;
use super::error::{FigureError, Pixels};
use super::svg::{Raster, Rect};
use crate::platform::{dejavu, liberation};

use pdf_writer::{Content, Filter, Finish, Name, Pdf, Ref, TextStr};
use resvg::tiny_skia::{Pixmap, PixmapPaint, Transform};
use resvg::usvg::{self, Tree, fontdb};
use std::collections::HashMap;
use std::io::Write as _;
use std::sync::{Arc, LazyLock};

/// Draws `drawing` in this many pixels across and down, with `scale` pixels per point. `svg` is its SVG without background and pictures.
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
    let pixels = pixmap.data().as_chunks::<4>().0;
    let mut rgb = vec![0; 3 * pixels.len()];
    for (colour, [r, g, b, _]) in rgb.as_chunks_mut().0.iter_mut().zip(pixels) {
        *colour = [*r, *g, *b];
    }
    Ok(Pixels { width: pixmap.width(), height: pixmap.height(), rgb })
}

/// The drawing as the renderers read it.
fn tree(svg: &str) -> Result<Tree, FigureError> {
    Tree::from_str(svg, &options()).map_err(|error| FigureError::Draw(error.to_string()))
}

/// Draws a picture at its position.
fn stamp(pixmap: &mut Pixmap, picture: &Raster, scale: f64) {
    let Rect { x, y, width, height } = picture.rect;
    let Pixels { width: columns, height: rows, rgb } = &picture.pixels;
    let Some(mut stamp) = Pixmap::new(*columns, *rows) else { return };
    for (pixel, rgb) in stamp.data_mut().chunks_exact_mut(4).zip(rgb.chunks_exact(3)) {
        pixel[..3].copy_from_slice(rgb);
        pixel[3] = 255;
    }
    let (sx, sy) = (width * scale / f64::from(*columns), height * scale / f64::from(*rows));
    let place = Transform::from_row(sx as f32, 0.0, 0.0, sy as f32, (x * scale) as f32, (y * scale) as f32);
    pixmap.draw_pixmap(0, 0, stamp.as_ref(), &PixmapPaint::default(), place, None);
}

/// Only the bundled fonts are used, so that a figure is the same everywhere.
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

/// Drawings as the pages of a PDF, each with its SVG without background and pictures. Text stays text.
pub(super) fn pdf(pages: &[(Drawing, String)], facts: &[(&str, String)]) -> Result<Vec<u8>, FigureError> {
    let failed = |error: &dyn std::fmt::Display| FigureError::Draw(error.to_string());
    let mut next = Ref::new(1);
    let [catalog, all, info] = [(); 3].map(|()| next.bump());
    let leaves: Vec<Ref> = pages.iter().map(|_| next.bump()).collect();
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(all);
    pdf.pages(all).kids(leaves.iter().copied()).count(i32::try_from(leaves.len()).unwrap_or(i32::MAX));
    for ((Drawing { size, pictures, .. }, svg), leaf) in pages.iter().zip(leaves) {
        let options = svg2pdf::ConversionOptions { pdfa: false, ..svg2pdf::ConversionOptions::default() };
        let (chunk, drawn) = svg2pdf::to_chunk(&tree(svg)?, options).map_err(|error| failed(&error))?;
        let mut renamed = HashMap::new();
        let content = next.bump();
        let chunk = chunk.renumber(|old| *renamed.entry(old).or_insert_with(|| next.bump()));
        let drawn = renamed.get(&drawn).copied().ok_or_else(|| failed(&"the drawing has no page"))?;
        let images: Vec<Ref> = pictures.iter().map(|_| next.bump()).collect();

        let [width, height] = size.map(|length| length as f32);
        let mut page = pdf.page(leaf);
        page.media_box(pdf_writer::Rect::new(0.0, 0.0, width, height)).parent(all).contents(content);
        let mut resources = page.resources();
        let mut objects = resources.x_objects();
        objects.pair(Name(b"Drawing"), drawn);
        let name = |i: usize| format!("Picture{i}");
        for (i, image) in images.iter().enumerate() {
            objects.pair(Name(name(i).as_bytes()), *image);
        }
        objects.finish();
        resources.finish();
        page.finish();

        let mut operations = Content::new();
        for (i, picture) in pictures.iter().enumerate() {
            let [x, y, w, h] =
                [picture.rect.x, picture.rect.bottom(), picture.rect.width, picture.rect.height].map(|c| c as f32);
            operations.save_state();
            operations.transform([w, 0.0, 0.0, h, x, height - y]);
            operations.x_object(Name(name(i).as_bytes()));
            operations.restore_state();
        }
        operations.transform([width, 0.0, 0.0, height, 0.0, 0.0]);
        operations.x_object(Name(b"Drawing"));
        pdf.stream(content, &operations.finish());
        for (image, Raster { pixels, .. }) in images.iter().zip(pictures) {
            let packed = deflated(&pixels.rgb).map_err(|error| failed(&error))?;
            let mut object = pdf.image_xobject(*image, &packed);
            object.filter(Filter::FlateDecode);
            let [columns, rows] = [pixels.width, pixels.height].map(|count| i32::try_from(count).unwrap_or(i32::MAX));
            object.width(columns).height(rows).bits_per_component(8).color_space().device_rgb();
        }
        pdf.extend(&chunk);
    }
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

fn deflated(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(bytes)?;
    encoder.finish()
}
