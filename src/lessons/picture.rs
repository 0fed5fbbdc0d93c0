//! Pictures in a lesson: PNG files in its folder.

use crate::input::read_bytes;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// Largest file \[MB\].
const LARGEST: u64 = 4;
/// Most pixels along a side.
const MOST: u32 = 4096;

/// A picture, with a description.
#[derive(Clone, PartialEq, Eq)]
pub struct Picture {
    /// Its description in words, for screen readers and paper.
    pub alternative: String,
    /// Width and height \[pixels\].
    pub size: [usize; 2],
    /// Red, green, blue and opacity of each pixel, row by row from the top.
    pub rgba: Arc<[u8]>,
}

impl fmt::Debug for Picture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Picture({}, {:?})", self.alternative, self.size)
    }
}

impl Picture {
    /// Reads a PNG file.
    pub fn load(path: &Path, alternative: &str) -> Result<Self, String> {
        let bytes = read_bytes(path, LARGEST).map_err(|error| error.to_string())?;
        let fault = |error: png::DecodingError| format!("is not a PNG picture: {error}");
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
        let mut reader = decoder.read_info().map_err(fault)?;
        let (width, height) = reader.info().size();
        let size = reader.output_buffer_size().filter(|_| width.max(height) <= MOST);
        let size = size.ok_or_else(|| format!("has {width} × {height} pixels: allowed are {MOST} along a side"))?;
        let mut pixels = vec![0; size];
        let frame = reader.next_frame(&mut pixels).map_err(fault)?;
        pixels.truncate(frame.buffer_size());
        let rgba: Vec<u8> = match frame.color_type {
            png::ColorType::GrayscaleAlpha => pixels.chunks_exact(2).flat_map(|p| [p[0], p[0], p[0], p[1]]).collect(),
            _ => pixels,
        };
        let size = [width, height].map(|side| side as usize);
        Ok(Self { alternative: alternative.to_owned(), size, rgba: rgba.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_read_and_anything_else_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        for (colour, bytes, first) in [
            (png::ColorType::Grayscale, vec![9; 6], [9, 9, 9, 255]),
            (png::ColorType::Rgb, vec![7; 18], [7, 7, 7, 255]),
            (png::ColorType::Rgba, vec![5; 24], [5, 5, 5, 5]),
        ] {
            let mut encoder = png::Encoder::new(std::fs::File::create(&path).unwrap(), 3, 2);
            encoder.set_color(colour);
            encoder.set_depth(png::BitDepth::Eight);
            encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
            let read = Picture::load(&path, "grey").unwrap();
            assert_eq!((read.size, read.rgba.len(), &read.rgba[..4]), ([3, 2], 24, &first[..]));
        }
        std::fs::write(&path, "no picture").unwrap();
        assert!(Picture::load(&path, "").unwrap_err().contains("is not a PNG picture"));
        assert!(Picture::load(folder.path(), "").unwrap_err().contains("a folder"));
    }
}
