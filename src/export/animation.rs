//! Animations of one cycle: GIF, APNG, MP4, or a folder of PNG files.
//!
//! Every frame is a [`Figure`], drawn as for print; the axes must not move from frame to frame. A GIF has one palette for all frames, so
//! that nothing flickers: the most common colours are kept, and the others are found by neural quantisation (Dekker 1994). GIF and APNG
//! store only what has changed from frame to frame. An MP4 contains AV1, encoded in Rust alone. If the solve has too few time steps for
//! smooth motion, an MP4 has additional frames between them, and because players do not repeat by themselves, it contains the cycle several
//! times. Each of the three formats has a comment that says where the numbers come from.

use super::error::ExportError;
use super::figure::{Figure, FigureError, Pixels, Provenance, pixels, png_bytes};
use super::figures;
#[cfg(feature = "video")]
use super::mp4;
use crate::atomic::{Staged, WriteError, write_file};
use crate::control::Cancel;
use crate::digits::rounded;
use crate::problem::{Problem, Scenario};
use crate::recording::Recording;
use crate::scene::show_text;
use crate::solution::Solution;
use color_quant::NeuQuant;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Options of an animation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Pixels across.
    pub width: u32,
    /// How long the cycle takes on screen \[s\].
    pub seconds: f64,
    /// Greatest number of frames. The number used divides the time steps of the solve evenly, so that the motion is even.
    pub frames: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { width: 720, seconds: 4.0, frames: 60 }
    }
}

/// Frames of one cycle, to be repeated.
#[derive(Clone, Debug)]
pub struct Movie {
    width: u32,
    height: u32,
    seconds: f64,
    /// Where the numbers come from.
    source: String,
    /// Red, green, blue, row by row from the top.
    frames: Vec<Vec<u8>>,
}

/// The format of an animation, by its path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Shown everywhere, 256 colours.
    Gif,
    /// An animated PNG: all colours, shown by browsers.
    Apng,
    /// A video, AV1: all colours, shown by browsers and players.
    Mp4,
    /// A PNG for each frame, in a folder, for use in other programs.
    Folder,
}

impl Format {
    /// The format of a path: `.gif`, `.png`, `.apng`, `.mp4`, or without extension a folder.
    pub fn of(path: &Path) -> Result<Self, ExportError> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("gif") => Ok(Self::Gif),
            Some("png" | "apng") => Ok(Self::Apng),
            Some("mp4") => Ok(Self::Mp4),
            None => Ok(Self::Folder),
            Some(_) if path.is_dir() => Ok(Self::Folder),
            Some(_) => Err(ExportError::Extension { path: path.to_owned() }),
        }
    }
}

/// Draws the cycle of a solve. `done` is called after each frame, from several threads.
pub fn cycle(
    problem: &Problem,
    solution: &Solution,
    options: &Options,
    done: &(dyn Fn() + Sync),
    cancel: &Cancel,
) -> Result<Movie, ExportError> {
    let recording = &solution.recording;
    let count = frames(recording, options.frames);
    Movie::of(count, options, &figure_of(problem, solution, recording, options), done, cancel)
}

/// Writes the cycle of a solve in the format of its path. A file has its name only when it is complete. `done` is called after each
/// frame, from several threads. Returns the paths of what was written.
pub fn write(
    path: &Path,
    problem: &Problem,
    solution: &Solution,
    options: &Options,
    done: &(dyn Fn() + Sync),
    cancel: &Cancel,
) -> Result<Vec<PathBuf>, ExportError> {
    let movie = || cycle(problem, solution, options, done, cancel);
    match Format::of(path)? {
        format @ (Format::Gif | Format::Apng) => {
            let (movie, encode) = (movie()?, if format == Format::Gif { Movie::gif } else { Movie::apng });
            write_file(path, |out| encode(&movie, out, cancel)).map_err(|error| stopped(error, cancel))?;
        }
        #[cfg(feature = "video")]
        Format::Mp4 => write_video(path, problem, solution, options, done, cancel)?,
        #[cfg(not(feature = "video"))]
        Format::Mp4 => {
            let source = io::Error::other("this program was built without video, and cannot write MP4");
            return Err(WriteError { path: path.to_owned(), source }.into());
        }
        Format::Folder => return movie()?.folder(path, cancel),
    }
    Ok(vec![path.to_owned()])
}

/// Writes an MP4. Each frame is drawn just before it is encoded.
#[cfg(feature = "video")]
fn write_video(
    path: &Path,
    problem: &Problem,
    solution: &Solution,
    options: &Options,
    done: &dyn Fn(),
    cancel: &Cancel,
) -> Result<(), ExportError> {
    let count = count(&solution.recording, options, Format::Mp4);
    if count == 0 {
        return Err(ExportError::NoCycle);
    }
    let mut recording = Cow::Borrowed(&solution.recording);
    if count != frames(&recording, options.frames) {
        recording = Cow::Owned(recording.resampled(count));
    }
    let options = Options { frames: count, ..*options };
    let figure = figure_of(problem, solution, &recording, &options);
    let first = drawn(&figure(0), &options)?;
    let shown = ([first.width, first.height], count, options.seconds);
    let picture = |frame: usize| Ok(Cow::Owned(drawn(&figure(frame), &options).map_err(io::Error::other)?.rgb));
    let source = Provenance::of(problem, solution).line();
    write_file(path, |out| mp4::write(shown, &picture, &source, out, done, cancel))
        .map_err(|error| stopped(error, cancel))
}

/// The file name of a frame in a folder; the first is number 1.
pub fn frame_name(number: usize) -> String {
    format!("frame-{number:04}.png")
}

/// Number of frames that [`write()`] makes. If the options ask for fewer than the default, an MP4 has no more frames than the other
/// formats.
pub fn count(recording: &Recording, options: &Options, format: Format) -> usize {
    let count = frames(recording, options.frames);
    if format != Format::Mp4 || count == 0 || options.frames < Options::default().frames {
        return count;
    }
    count.max((SMOOTH * options.seconds).ceil() as usize)
}

/// Frames per second that look like smooth motion.
const SMOOTH: f64 = 24.0;

/// The frames of a cycle as figures.
fn figure_of<'a>(
    problem: &'a Problem,
    solution: &'a Solution,
    recording: &'a Recording,
    options: &Options,
) -> impl Fn(usize) -> Figure + Sync + use<'a> {
    let count = frames(recording, options.frames);
    let slower = slow_motion(recording, options.seconds);
    move |frame: usize| {
        let frame = frame * recording.frames / count;
        let figure = match &problem.scenario {
            Scenario::Motor(motor) => figures::motor::moving(motor, recording, frame),
            Scenario::Plate(plate) => figures::plate::moving(plate, recording, frame),
        };
        let phase = frame as f64 / recording.frames as f64;
        let title = format!("{} · t/T = {phase:.2} · {slower}", show_text(&problem.name));
        Figure { title, provenance: Provenance::of(problem, solution), ..figure }
    }
}

fn drawn(figure: &Figure, options: &Options) -> Result<Pixels, FigureError> {
    pixels(figure, f64::from(options.width) / figure.width.points())
}

/// Why a file was not written.
pub(super) fn stopped(error: WriteError, cancel: &Cancel) -> ExportError {
    if cancel.is_cancelled() { ExportError::Cancelled } else { error.into() }
}

/// Number of frames of an animation with at most `most`: every second, third, … time step is used, if that gives nearly as many.
fn frames(recording: &Recording, most: usize) -> usize {
    figures::compare::common_frames(std::iter::once(recording), most)
}

/// `slowed down 91 000 times`
fn slow_motion(recording: &Recording, seconds: f64) -> String {
    // Two digits are enough here.
    match rounded(seconds / recording.period, 2) {
        times @ ..1e4 => format!("slowed down {times:.0} times"),
        times @ ..1e6 => format!("slowed down {:.0} 000 times", times / 1e3),
        times => format!("slowed down {:.*} million times", usize::from(times < 1e7), times / 1e6),
    }
}

impl Movie {
    /// Draws `count` frames that `figure` describes. `done` is called after each, from several threads.
    ///
    /// # Errors
    /// [`ExportError`]: cancelled, no frames, frames of several sizes, or one that cannot be drawn.
    pub fn of(
        count: usize,
        options: &Options,
        figure: &(dyn Fn(usize) -> Figure + Sync),
        done: &(dyn Fn() + Sync),
        cancel: &Cancel,
    ) -> Result<Self, ExportError> {
        if count == 0 {
            return Err(ExportError::NoCycle);
        }
        let draw = |frame: usize| {
            if cancel.is_cancelled() {
                return Err(ExportError::Cancelled);
            }
            let pixels = drawn(&figure(frame), options)?;
            done();
            Ok(pixels)
        };
        let drawn = (0..count).into_par_iter().map(draw).collect::<Result<Vec<Pixels>, _>>()?;
        let (width, height) = (drawn[0].width, drawn[0].height);
        if let Some(frame) = drawn.iter().position(|pixels| (pixels.width, pixels.height) != (width, height)) {
            return Err(ExportError::Size { frame });
        }
        let (seconds, source) = (options.seconds, figure(0).provenance.line());
        Ok(Self { width, height, seconds, source, frames: drawn.into_iter().map(|pixels| pixels.rgb).collect() })
    }

    /// Writes a PNG for each frame into a folder.
    fn folder(&self, path: &Path, cancel: &Cancel) -> Result<Vec<PathBuf>, ExportError> {
        let mut staged = Staged::new(path)?;
        for (i, rgb) in self.frames.iter().enumerate() {
            let pixels = Pixels { width: self.width, height: self.height, rgb: rgb.clone() };
            let write = |out: &mut dyn Write| {
                check(cancel)?;
                out.write_all(&png_bytes(&pixels, None, &[]).map_err(io::Error::other)?)
            };
            staged.add(frame_name(i + 1), write).map_err(|error| stopped(error, cancel))?;
        }
        Ok(staged.commit()?)
    }

    /// Writes a GIF that repeats for ever.
    pub fn gif(&self, out: &mut dyn Write, cancel: &Cancel) -> io::Result<()> {
        let (width, height) = (side(self.width)?, side(self.height)?);
        let mut palette = Palette::new(&self.frames);
        let mut encoder = gif::Encoder::new(out, width, height, &palette.bytes()).map_err(io::Error::other)?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(io::Error::other)?;
        let comment: Vec<&[u8]> = self.source.as_bytes().chunks(255).collect();
        encoder.write_raw_extension(gif::Extension::Comment.into(), &comment).map_err(io::Error::other)?;
        for (i, rgb) in self.frames.iter().enumerate() {
            check(cancel)?;
            let before = i.checked_sub(1).map(|i| self.frames[i].as_slice());
            let [left, top, right, bottom] = self.changed(before, rgb);
            let mut buffer = Vec::with_capacity((right - left) * (bottom - top));
            for y in top..bottom {
                for x in left..right {
                    let at = 3 * (y * self.width as usize + x);
                    let same = before.is_some_and(|before| before[at..at + 3] == rgb[at..at + 3]);
                    buffer.push(if same { TRANSPARENT } else { palette.index([rgb[at], rgb[at + 1], rgb[at + 2]]) });
                }
            }
            let frame = gif::Frame {
                delay: self.delay(i),
                dispose: gif::DisposalMethod::Keep,
                transparent: Some(TRANSPARENT),
                left: left as u16,
                top: top as u16,
                width: (right - left) as u16,
                height: (bottom - top) as u16,
                buffer: Cow::Owned(buffer),
                ..gif::Frame::default()
            };
            encoder.write_frame(&frame).map_err(io::Error::other)?;
        }
        Ok(())
    }

    /// Duration of a frame, in hundredths of a second; the durations add up to that of the cycle.
    fn delay(&self, frame: usize) -> u16 {
        let until = |frame: usize| (100.0 * self.seconds * frame as f64 / self.frames.len() as f64).round();
        (until(frame + 1) - until(frame)).clamp(2.0, 60_000.0) as u16
    }

    /// Writes an animated PNG that repeats for ever.
    fn apng(&self, out: &mut dyn Write, cancel: &Cancel) -> io::Result<()> {
        let count = u32::try_from(self.frames.len()).map_err(io::Error::other)?;
        let mut encoder = png::Encoder::new(out, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_animated(count, 0)?;
        encoder.set_frame_delay((1000.0 * self.seconds / f64::from(count)).round().clamp(1.0, 6e4) as u16, 1000)?;
        encoder.add_itxt_chunk("Source".to_owned(), self.source.clone())?;
        let mut writer = encoder.write_header()?;
        for (i, rgb) in self.frames.iter().enumerate() {
            check(cancel)?;
            let before = i.checked_sub(1).map(|i| self.frames[i].as_slice());
            let [left, top, right, bottom] = self.changed(before, rgb);
            if i > 0 {
                writer.reset_frame_position()?;
                writer.set_frame_dimension((right - left) as u32, (bottom - top) as u32)?;
                writer.set_frame_position(left as u32, top as u32)?;
            }
            let rows = (top..bottom).flat_map(|y| {
                let row = 3 * y * self.width as usize;
                rgb[row + 3 * left..row + 3 * right].iter().copied()
            });
            writer.write_image_data(&rows.collect::<Vec<u8>>())?;
        }
        writer.finish()?;
        Ok(())
    }

    /// Left, top, right and bottom of the area that differs from the previous frame: at least one pixel.
    fn changed(&self, before: Option<&[u8]>, rgb: &[u8]) -> [usize; 4] {
        let (width, height) = (self.width as usize, self.height as usize);
        let Some(before) = before else { return [0, 0, width, height] };
        let mut edges = [width, height, 0, 0];
        for (y, (old, new)) in before.chunks_exact(3 * width).zip(rgb.chunks_exact(3 * width)).enumerate() {
            if old == new {
                continue;
            }
            let differ = || old.iter().zip(new).map(|(old, new)| old != new);
            let [first, last] = [differ().position(|it| it), differ().rposition(|it| it)].map(|at| at.unwrap_or(0) / 3);
            edges = [edges[0].min(first), edges[1].min(y), edges[2].max(last + 1), y + 1];
        }
        if edges[2] == 0 { [0, 0, 1, 1] } else { edges }
    }
}

fn check(cancel: &Cancel) -> io::Result<()> {
    if cancel.is_cancelled() { Err(io::ErrorKind::Interrupted.into()) } else { Ok(()) }
}

fn side(length: u32) -> io::Result<u16> {
    u16::try_from(length).map_err(|_| io::Error::other("a GIF has at most 65535 pixels along a side"))
}

/// The palette index for pixels that have not changed.
const TRANSPARENT: u8 = 255;
/// Number of colours that are kept exactly.
const EXACT: usize = 96;
/// Number of pixels from which the palette is computed.
const SAMPLES: usize = 400_000;

/// 255 colours for all frames.
struct Palette {
    colours: Vec<[u8; 3]>,
    known: HashMap<[u8; 3], u8>,
    /// The last colour that was looked up: often the next one is the same.
    last: ([u8; 3], u8),
}

impl Palette {
    fn new(frames: &[Vec<u8>]) -> Self {
        let pixels: usize = frames.iter().map(|frame| frame.len() / 3).sum();
        let step = (pixels / SAMPLES).max(1);
        let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
        let all = frames.iter().flat_map(|frame| frame.chunks_exact(3));
        for pixel in all.step_by(step) {
            *counts.entry([pixel[0], pixel[1], pixel[2]]).or_default() += 1;
        }
        let mut common: Vec<([u8; 3], usize)> = counts.into_iter().collect();
        // Ties are decided by the colour, so that the file is the same every time.
        common.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let exact = if common.len() <= usize::from(TRANSPARENT) { common.len() } else { EXACT };
        let mut colours: Vec<[u8; 3]> = common[..exact].iter().map(|(colour, _)| *colour).collect();
        if exact < common.len() {
            // Rare colours count too, by the square root of their frequency; otherwise gradients would have steps.
            let weighted = common[exact..].iter().flat_map(|(colour, count)| {
                let times = (*count as f64).sqrt().ceil() as usize;
                std::iter::repeat_n([colour[0], colour[1], colour[2], 255], times)
            });
            let rest: Vec<u8> = weighted.flatten().collect();
            let network = NeuQuant::new(3, usize::from(TRANSPARENT) - exact, &rest);
            colours.extend(network.color_map_rgb().chunks_exact(3).map(|c| [c[0], c[1], c[2]]));
        }
        let known = colours.iter().zip(0..TRANSPARENT).map(|(colour, index)| (*colour, index)).collect();
        let last = (colours.first().copied().unwrap_or_default(), 0);
        Self { colours, known, last }
    }

    /// The 256 colours as they are written in the file.
    fn bytes(&self) -> Vec<u8> {
        let mut bytes: Vec<u8> = self.colours.iter().flatten().copied().collect();
        bytes.resize(768, 0);
        bytes
    }

    fn index(&mut self, colour: [u8; 3]) -> u8 {
        if self.last.0 == colour {
            return self.last.1;
        }
        let colours = &self.colours;
        let index = *self.known.entry(colour).or_insert_with(|| {
            let far = |other: &[u8; 3]| -> u32 { (0..3).map(|k| u32::from(colour[k].abs_diff(other[k])).pow(2)).sum() };
            let nearest = colours.iter().zip(0..TRANSPARENT).min_by_key(|(other, _)| far(other));
            nearest.map_or(0, |(_, index)| index)
        });
        self.last = (colour, index);
        index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_much_slower_is_said_in_two_digits() {
        let said = |period: f64, seconds: f64| slow_motion(&Recording { period, ..Recording::default() }, seconds);
        assert_eq!(said(1e-3, 0.2512), "slowed down 250 times");
        assert_eq!(said(1.0 / 30e3, 3.03), "slowed down 91 000 times");
        assert_eq!(said(1.0 / 30e3, 40.0), "slowed down 1.2 million times");
        assert_eq!(said(1e-9, 4.0), "slowed down 4000 million times");
    }

    #[test]
    fn a_gif_shows_every_frame_as_it_was_drawn() {
        // A block that moves over stripes; most of each frame is the same as in the previous one.
        let (width, height) = (7_usize, 5);
        let frame = |at: usize| -> Vec<u8> {
            let pixels = (0..width * height).map(|i| (i % width, i / width));
            let colour =
                |(x, y)| if (at..at + 2).contains(&x) && y == at { [200, 30, 10] } else { [0, 60 * y as u8, 90] };
            pixels.flat_map(colour).collect()
        };
        let frames: Vec<Vec<u8>> = (0..4).map(frame).collect();
        let movie =
            Movie { width: width as u32, height: height as u32, seconds: 1.0, source: "a test".to_owned(), frames };
        let mut bytes = Vec::new();
        movie.gif(&mut bytes, &Cancel::new()).unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(&bytes[..]).unwrap();
        let mut shown = vec![0; 3 * width * height];
        for drawn in &movie.frames {
            let read = decoder.read_next_frame().unwrap().unwrap();
            for (i, rgba) in read.buffer.chunks_exact(4).enumerate().filter(|(_, rgba)| rgba[3] > 0) {
                let (x, y) = (i % usize::from(read.width), i / usize::from(read.width));
                let at = 3 * ((usize::from(read.top) + y) * width + usize::from(read.left) + x);
                shown[at..at + 3].copy_from_slice(&rgba[..3]);
            }
            // As close as the palette allows.
            assert!(shown.iter().zip(drawn).all(|(a, b)| a.abs_diff(*b) <= 8), "{shown:?} {drawn:?}");
        }
        assert!(decoder.read_next_frame().unwrap().is_none());
    }
}
