//! AV1 in an MP4 file: one track, with the index before the data, so that it can be played while it is loaded.
//!
//! A player does not repeat by itself, so the file contains the packets of a cycle several times. The provenance is a comment in the form
//! of Apple's programs, which nearly all readers know.

use crate::control::Cancel;
use shiguredo_mp4::bitstream::av1::{
    Av1ObuParseContext, Av1ObuType, Av1SampleEntryConfig, build_av01_box_from_config_obus, parse_obus,
};
use shiguredo_mp4::boxes::{Brand, FreeBox, FtypBox, SampleEntry, UnknownBox};
use shiguredo_mp4::mux::{Mp4FileMuxer, Mp4FileMuxerOptions, Sample, estimate_maximum_moov_box_size};
use shiguredo_mp4::{BoxSize, BoxType, Encode, TrackKind};
use squeezefilm_video::{FrameSource, encode};
use std::io::{self, Write};
use std::num::NonZeroU32;

/// Space for the boxes round a comment \[bytes\].
const ABOUT: usize = 256;
/// A box begins with its length and its name \[bytes\].
const HEADER: usize = 8;

/// A video consists of whole cycles, and has at least this duration \[s\].
const LONG_ENOUGH: f64 = 12.0;
/// Shortest cycle for which this holds \[s\]: shorter ones would have to be repeated too often.
const SHORTEST: f64 = 0.02;

/// Writes a cycle of `count` pictures, each requested by its number, as often as [`LONG_ENOUGH`] requires, with a comment. `done` is called
/// after each picture.
pub(super) fn write(
    (size, count, seconds): ([u32; 2], usize, f64),
    picture: &FrameSource<'_>,
    comment: &str,
    out: &mut dyn Write,
    done: &dyn Fn(),
    cancel: &Cancel,
) -> io::Result<()> {
    // Time is counted in units of 1/`count` of a millisecond. In these units a frame lasts as long as the cycle does in milliseconds.
    let step = (1000.0 * seconds).round() as u32;
    let timescale = u32::try_from(1000 * count).map_err(io::Error::other)?;
    let cycles = (LONG_ENOUGH / seconds.max(SHORTEST)).ceil() as u32;
    let packets = encode(count, picture, size, [step, timescale], done, &|| cancel.is_cancelled())?;
    if cancel.is_cancelled() {
        return Err(io::ErrorKind::Interrupted.into());
    }
    mux(&packets, [step, timescale], cycles, comment, out)
}

/// Writes the packets of a cycle `cycles` times, each with the duration `step` \[s\], a fraction.
fn mux(packets: &[Vec<u8>], step: [u32; 2], cycles: u32, comment: &str, out: &mut dyn Write) -> io::Result<()> {
    let samples = packets.iter().map(|packet| sample(packet)).collect::<io::Result<Vec<Vec<u8>>>>()?;
    let mut entry = Some(entry(samples.first().map_or(&[], Vec::as_slice))?);
    let timescale = NonZeroU32::new(step[1]).ok_or_else(|| io::Error::other("there is no unit of time"))?;
    let all = || (0..cycles).flat_map(|_| samples.iter().enumerate());
    let index = estimate_maximum_moov_box_size(&[all().count()]);
    let reserved_moov_box_size = index + comment.len() + ABOUT;
    let options = Mp4FileMuxerOptions { reserved_moov_box_size, ..Mp4FileMuxerOptions::default() };
    let mut muxer = Mp4FileMuxer::with_options(options).map_err(io::Error::other)?;
    let mut data_offset = muxer.initial_boxes_bytes().len() as u64;
    for (i, sample) in all() {
        let of_it = Sample {
            track_kind: TrackKind::Video,
            sample_entry: entry.take(),
            keyframe: i == 0,
            timescale,
            duration: step[0],
            composition_time_offset: None,
            data_offset,
            data_size: sample.len(),
        };
        muxer.append_sample(&of_it).map_err(io::Error::other)?;
        data_offset += sample.len() as u64;
    }
    let boxes = muxer.finalize().map_err(io::Error::other)?;
    let mut moov = boxes.moov_box().clone();
    moov.unknown_boxes.push(about(comment)?);
    let compatible_brands = vec![Brand::ISOM, Brand::ISO6, Brand::AV01, Brand::MP41];
    let ftyp = FtypBox { major_brand: Brand::ISOM, minor_version: 0x200, compatible_brands };
    let head = [bytes(ftyp)?, bytes(moov)?].concat();
    // The data begin where the index says; the reserved space that is not needed is filled.
    let (begin, data) = boxes.offset_and_bytes_pairs().last().unwrap_or_default();
    let free = (begin as usize).checked_sub(head.len() + HEADER);
    let payload = vec![0; free.ok_or_else(|| io::Error::other("the index of the video is too long"))?];
    [head, bytes(FreeBox { payload })?, data.to_vec()].iter().try_for_each(|part| out.write_all(part))?;
    all().try_for_each(|(_, sample)| out.write_all(sample))
}

/// A packet without delimiters, which are not needed in a container.
fn sample(packet: &[u8]) -> io::Result<Vec<u8>> {
    let obus = parse_obus(packet, Av1ObuParseContext::Sample).map_err(io::Error::other)?;
    let kept = obus.iter().filter(|obu| obu.obu_type != Av1ObuType::TemporalDelimiter);
    Ok(kept.map(|obu| obu.obu).collect::<Vec<_>>().concat())
}

/// Sample entry, which configures the decoder, made from the first packet.
fn entry(first: &[u8]) -> io::Result<SampleEntry> {
    let obus = parse_obus(first, Av1ObuParseContext::Sample).map_err(io::Error::other)?;
    let header = obus.iter().find(|obu| obu.obu_type == Av1ObuType::SequenceHeader).map_or(&[][..], |obu| obu.obu);
    let config = Av1SampleEntryConfig { initial_presentation_delay_minus_one: None };
    let mut entry = build_av01_box_from_config_obus(header, &config).map_err(io::Error::other)?;
    // As in the bitstream: BT.709, the transfer of sRGB, limited range.
    entry.unknown_boxes.push(plain(*b"colr", [b"nclx".as_slice(), &[0, 1, 0, 13, 0, 1, 0]].concat()));
    Ok(SampleEntry::Av01(entry))
}

fn about(comment: &str) -> io::Result<UnknownBox> {
    // Text in UTF-8, without a country.
    let text = [&[0, 0, 0, 1, 0, 0, 0, 0], comment.as_bytes()].concat();
    let item = plain(*b"\xa9cmt", bytes(plain(*b"data", text))?);
    let list = plain(*b"ilst", bytes(item)?);
    let handler = plain(*b"hdlr", [[0; 8].as_slice(), b"mdirappl", &[0; 9]].concat());
    let meta = plain(*b"meta", [vec![0; 4], bytes(handler)?, bytes(list)?].concat());
    Ok(plain(*b"udta", bytes(meta)?))
}

fn plain(kind: [u8; 4], payload: Vec<u8>) -> UnknownBox {
    let box_type = BoxType::Normal(kind);
    UnknownBox { box_type, box_size: BoxSize::with_payload_size(box_type, payload.len() as u64), payload }
}

fn bytes(of: impl Encode) -> io::Result<Vec<u8>> {
    of.encode_to_vec().map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packets_lose_their_delimiters_and_broken_ones_are_refused() {
        // A delimiter, a sequence header of three bytes, a frame of 130 (two digits of its size).
        let frame = [vec![0x32, 0x82, 0x01], vec![7; 130]].concat();
        let packet = [[0x12, 0x00, 0x0a, 0x03, 1, 2, 3].as_slice(), &frame].concat();
        assert_eq!(sample(&packet).unwrap(), packet[2..]);
        for broken in [&packet[..20], &[0x12], &[0x0a, 0xff, 0xff], &[0x12, 0], &frame] {
            mux(&[broken.to_vec()], [1, 1], 1, "", &mut Vec::new()).unwrap_err();
        }
    }
}
