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

/// Writes a cycle of `count` pictures of a size as an MP4, as often as [`LONG_ENOUGH`] asks. A program that was built without video cannot.
#[cfg_attr(not(feature = "video"), expect(unused_variables))]
pub(super) fn write(
    (size, count, seconds): ([u32; 2], usize, f64),
    picture: &Picture<'_>,
    source: &str,
    out: &mut dyn Write,
    done: &dyn Fn(),
    cancel: &Cancel,
) -> io::Result<()> {
    #[cfg(feature = "video")]
    {
        // A frame stays for the cycle's milliseconds in units that are as many to the millisecond as there are frames.
        let step = (1000.0 * seconds).round() as u32;
        let timescale = u32::try_from(1000 * count).map_err(io::Error::other)?;
        let cycles = (LONG_ENOUGH / seconds).ceil() as u32;
        let packets = encode(count, picture, size, [step, timescale], done, &|| cancel.is_cancelled())?;
        if cancel.is_cancelled() {
            return Err(io::ErrorKind::Interrupted.into());
        }
        mp4::write(&packets, &mp4::Timing { timescale, step, cycles }, source, out)
    }
    #[cfg(not(feature = "video"))]
    {
        let what = format!("{count} pictures of {} × {} pixels in {seconds} s", size[0], size[1]);
        Err(io::Error::other(format!("this program was built without video, and cannot write {what}")))
    }
}
