//! A cycle as an MP4.

#[cfg(feature = "video")]
use super::mp4;
use crate::control::Cancel;
#[cfg(feature = "video")]
use squeezefilm_video::{Picture, encode};
use std::io::{self, Write};

/// A video has whole cycles, and lasts at least this \[s\].
pub const LONG_ENOUGH: f64 = 12.0;

/// The picture of a frame: red, green, blue, row by row from the top.
#[cfg(not(feature = "video"))]
type Picture<'a> = dyn Fn(usize) -> io::Result<std::borrow::Cow<'a, [u8]>> + Sync + 'a;

/// A cycle as an MP4.
pub(super) struct Mp4Cycle {
    pub(super) size: [u32; 2],
    pub(super) count: usize,
    pub(super) seconds: f64,
}

impl Mp4Cycle {
    /// Writes it as often as [`LONG_ENOUGH`] asks.
    #[cfg(feature = "video")]
    pub(super) fn write(
        &self,
        picture: &Picture<'_>,
        source: &str,
        out: &mut dyn Write,
        done: &dyn Fn(),
        cancel: &Cancel,
    ) -> io::Result<()> {
        // A frame stays for the cycle's milliseconds in units that are as many to the millisecond as there are frames.
        let step = (1000.0 * self.seconds).round() as u32;
        let timescale = u32::try_from(1000 * self.count).map_err(io::Error::other)?;
        let cycles = (LONG_ENOUGH / self.seconds).ceil() as u32;
        let video = encode(self.count, picture, self.size, [step, timescale], done, &|| cancel.is_cancelled())?;
        if cancel.is_cancelled() {
            return Err(io::ErrorKind::Interrupted.into());
        }
        mp4::write(&video, &mp4::Timing { timescale, step, cycles }, source, out)
    }

    /// Nothing: the program was built without what encodes it.
    #[cfg(not(feature = "video"))]
    pub(super) fn write(
        &self,
        _: &Picture<'_>,
        _: &str,
        _: &mut dyn Write,
        _: &dyn Fn(),
        _: &Cancel,
    ) -> io::Result<()> {
        let Self { size: [width, height], count, seconds } = self;
        let what = format!("{count} pictures of {width} × {height} pixels in {seconds} s");
        Err(io::Error::other(format!("this program was built without video, and cannot write {what}")))
    }
}
